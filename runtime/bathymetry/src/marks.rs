//! Values that stand for nothing although nobody has said so.
//!
//! Who cuts a grid out of another leaves -9999 in its holes, and an elevation of -9999 m is water that could be. Such a value is
//! known by two signs: it is one of those that programs are used to write, and it lies far apart from all the others.

/// What programs write where they know nothing, without its sign; what no depth can be is refused anyway.
const MARKS: [f64; 9] = [999.0, 999.9, 9_998.0, 9_999.0, 9_999.9, 32_766.0, 32_767.0, 32_768.0, 99_999.0];

/// A mark lies at least by this share of the others' whole span beyond them. Depths that were measured follow each other more
/// closely: in the two cuts of ETOPO5 by 20 % of the span at most.
const APART: f64 = 0.25;

/// The marks among the values, each once, that lie apart from all others.
pub(crate) fn undeclared(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values.filter(|value| value.is_finite()) {
        if !is_mark(value) {
            (low, high) = (low.min(value), high.max(value));
        } else if !found.contains(&value) {
            found.push(value);
        }
    }
    // Where there is nothing else, nothing was measured.
    let beyond = APART * (high - low);
    found.retain(|mark| low > high || *mark < low - beyond || *mark > high + beyond);
    found
}

/// In single precision the same marks are a little off.
fn is_mark(value: f64) -> bool {
    let size = value.abs();
    MARKS.iter().any(|mark| size == *mark || size == f64::from(*mark as f32))
}

#[cfg(test)]
mod tests {
    fn undeclared(values: &[f64]) -> Vec<f64> {
        super::undeclared(values.iter().copied())
    }

    #[test]
    fn a_mark_is_one_only_where_it_lies_apart() {
        assert_eq!(undeclared(&[-12.0, -9_999.0, -14.0, -9_999.0, f64::NAN]), [-9_999.0]);
        assert_eq!(undeclared(&[-12.0, 999.0, f64::from(-9_999.9_f32)]), [999.0, f64::from(-9_999.9_f32)]);
        assert_eq!(undeclared(&[-9_999.0, -9_999.0]), [-9_999.0], "nothing but marks");
        // In a trench it is a depth like any.
        assert!(undeclared(&[-40.0, -9_999.0, -9_990.0, -10_010.0]).is_empty());
        assert!(undeclared(&[-40.0, -950.0, -999.0]).is_empty(), "not far beyond the deepest");
        assert_eq!(undeclared(&[-40.0, -760.0, -999.0]), [-999.0]);
        assert!(undeclared(&[-40.0, -9_997.0, f64::NAN, f64::INFINITY]).is_empty(), "others are for others to judge");
    }
}
