//! Round numbers for axes and scale bars.

/// Numbers of the kind 1, 2 or 5 times a power of ten, from a millimetre to beyond all charts.
fn round_numbers() -> impl Iterator<Item = f64> {
    let powers = std::iter::successors(Some(1.0), |power| Some(power * 10.0)).take(14);
    // Whole thousandths, so that each is the nearest float to what it is meant to be.
    powers.flat_map(|power| [1.0, 2.0, 5.0].map(|round| round * power / 1000.0))
}

/// The least round number that is not below `x`.
pub fn round_up(x: f64) -> f64 {
    round_numbers().find(|round| x <= *round).unwrap_or(1e12)
}

/// The greatest round number that is not above `x`.
pub fn round_down(x: f64) -> f64 {
    round_numbers().take_while(|round| *round <= x).last().unwrap_or(1e-3)
}

/// Marks of an axis that begins at a number and spans another over so many pixels: a round step, and its multiples, which are so many pixels
/// apart at least.
pub fn marks((from, span): (f64, f64), pixels: f64, apart: f64) -> (f64, Vec<f64>) {
    let step = round_up(apart * span / pixels);
    // What a float makes of a round number is no step less.
    let first = (from / step - 1e-9).ceil();
    let count = (((from + span) / step + 1e-9).floor() - first).clamp(-1.0, 100.0) + 1.0;
    (step, (0..count as u32).map(|i| (first + f64::from(i)) * step).collect())
}

/// The decimals that multiples of a round step need.
pub fn decimals(step: f64) -> u8 {
    [1.0, 0.1, 0.01].iter().take_while(|least| step < 0.999 * **least).count() as u8
}

#[cfg(test)]
mod tests {
    use super::{decimals, marks, round_down, round_up};

    #[test]
    fn steps_are_round_and_need_few_decimals() {
        assert_eq!([0.0, 0.3, 1.0, 21.0].map(round_up), [0.001, 0.5, 1.0, 50.0]);
        assert_eq!([0.3, 1.0, 49.0].map(round_down), [0.2, 1.0, 20.0]);
        assert_eq!([0.001, 0.05, 0.1, 0.5, 1.0, 20.0].map(decimals), [3, 2, 1, 1, 0, 0]);
    }

    #[test]
    fn both_ends_of_an_axis_are_marked_where_they_are_round() {
        assert_eq!(marks((0.0, 60.0), 360.0, 50.0), (10.0, vec![0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]));
        assert_eq!(marks((-0.3, 1.0), 100.0, 40.0).1, [0.0, 0.5]);
    }
}
