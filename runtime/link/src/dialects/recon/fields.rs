//! Fields: numbers, positions and times as they stand in a message.

use crate::controller::DAY_MS;
use albacore_geometry::Geodetic;
use albacore_geometry::math::{degrees, radians};
use std::ops::RangeInclusive;

/// Ten-thousandths of a minute of arc in a degree: the grain of a position, about 0.2 m.
const GRAINS: f64 = 600_000.0;

/// No number of the dialect is greater: what four hundred digits stand for is none.
const GREATEST: f64 = 1e9;
/// ... and none that a sensor tells counts for more.
const SENSOR_NUMBER_MAX: f64 = 1e8;

/// Where numbers lie, in the units of the message. The sources state no ranges: ours are wider than any vehicle's, and their
/// sums and products stay numbers. A message with a number outside is no message, but for what a sensor tells: a sounder that hears
/// nothing may say anything.
pub mod ranges {
    use std::ops::RangeInclusive;

    /// Depths and heights above the bottom, m: the deepest ocean, and a gauge that is out by ten bars.
    pub const HEIGHTS: RangeInclusive<f64> = -100.0..=12_000.0;
    /// Speeds and currents, m/s.
    pub const SPEEDS: RangeInclusive<f64> = -50.0..=50.0;
    /// Turns of the propeller a minute.
    pub const TURNS: RangeInclusive<f64> = -100_000.0..=100_000.0;
    /// Angles, degrees.
    pub const ANGLES: RangeInclusive<f64> = -360.0..=360.0;
    /// Rates of turn, degrees a second.
    pub const TURN_RATES: RangeInclusive<f64> = -3_600.0..=3_600.0;
    /// What is left in a battery, per cent.
    pub const CHARGES: RangeInclusive<f64> = 0.0..=100.0;
}

fn plain(text: &str) -> Option<f64> {
    let is_plain = text.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+'));
    text.parse().ok().filter(|_| is_plain)
}

/// A plain decimal number of a size that means something. What Rust reads besides (`inf`, `nan`, `1e9`) is none.
pub fn number(text: &str) -> Option<f64> {
    plain(text).filter(|x| x.abs() <= GREATEST)
}

/// What a sensor tells, however absurd: a plain decimal number, and no greater than one that has sums. Whether it can be is for who
/// believes it to say, and the rest of its line is as true as ever.
pub fn sensor_number(text: &str) -> Option<f64> {
    plain(text).map(|x| x.clamp(-SENSOR_NUMBER_MAX, SENSOR_NUMBER_MAX))
}

/// A plain decimal number in a range.
pub fn within(text: &str, range: RangeInclusive<f64>) -> Option<f64> {
    number(text).filter(|x| range.contains(x))
}

/// A number with so many decimals; a zero has no sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| matches!(b, b'0' | b'.')) => rest.to_string(),
        _ => text,
    }
}

/// The same, and no greater than the value.
pub fn fixed_down(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    let half = (0..decimals).fold(0.5, |half, _| half / 10.0);
    // The text is the nearest number: where that is greater, the one before it is not.
    if text.parse::<f64>().is_ok_and(|nearest| nearest > value) { fixed(value - half, decimals) } else { text }
}

/// The same, and no less than the value.
pub fn fixed_up(value: f64, decimals: usize) -> String {
    let text = fixed_down(-value, decimals);
    text.strip_prefix('-').map_or_else(|| fixed(-text.parse().unwrap_or(0.0), decimals), str::to_string)
}

/// Degrees and minutes, as in `39N30.5553`; radians, north and east positive. `beyond` is the largest number of degrees.
pub fn angle(text: &str, signs: [char; 2], beyond: f64) -> Option<f64> {
    let at = text.find(signs)?;
    let (whole, minutes) = (number(&text[..at])?, number(&text[at + 1..])?);
    let magnitude = whole + minutes / 60.0;
    let sound = whole >= 0.0 && (0.0..60.0).contains(&minutes) && magnitude <= beyond;
    sound.then(|| radians(if text[at..].starts_with(signs[0]) { magnitude } else { -magnitude }))
}

/// The text of an angle in radians, with so many digits for its degrees.
fn angle_text(angle_rad: f64, signs: [char; 2], width: usize) -> String {
    let grains = (degrees(angle_rad).abs() * GRAINS).round();
    let whole = (grains / GRAINS).floor();
    let minutes = (grains - whole * GRAINS) / 10_000.0;
    let sign = if angle_rad < 0.0 { signs[1] } else { signs[0] };
    format!("{whole:0width$.0}{sign}{minutes:07.4}")
}

/// `39N30.5553` and `74W19.4386`.
pub fn position_texts(position: Geodetic) -> (String, String) {
    (angle_text(position.latitude_rad, ['N', 'S'], 2), angle_text(position.longitude_rad, ['E', 'W'], 2))
}

/// A position from its two texts.
pub fn position(latitude: &str, longitude: &str) -> Option<Geodetic> {
    let latitude_rad = angle(latitude, ['N', 'S'], 90.0)?;
    let longitude_rad = angle(longitude, ['E', 'W'], 180.0)?;
    Some(Geodetic { latitude_rad, longitude_rad })
}

/// `15:08:37.672` as milliseconds of the day.
pub fn time(text: &str) -> Option<u32> {
    let mut parts = text.split(':').map(number);
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next()??);
    let sound = (0.0..24.0).contains(&hours) && (0.0..60.0).contains(&minutes) && (0.0..60.0).contains(&seconds);
    let whole = hours.fract() == 0.0 && minutes.fract() == 0.0 && parts.next().is_none();
    (sound && whole).then(|| ((hours * 3600.0 + minutes * 60.0 + seconds) * 1000.0).round() as u32 % DAY_MS)
}

/// The text of milliseconds of the day.
pub fn time_text(ms: u32) -> String {
    let s = ms / 1000;
    format!("{:02}:{:02}:{:02}.{:03}", s / 3600 % 24, s / 60 % 60, s % 60, ms % 1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain() {
        assert_eq!(number("-0.10"), Some(-0.1));
        let nines = "9".repeat(400);
        for none in ["", "inf", "-inf", "NaN", "1e9", "1e308", "1.2.3", "--1", "0x1", " 1", "-", "1,5", &nines] {
            assert_eq!(number(none), None, "{none}");
        }
        assert_eq!((fixed(-0.001, 2).as_str(), fixed(-0.1, 2).as_str()), ("0.00", "-0.10"));
    }

    #[test]
    fn goals_are_rounded_to_one_side() {
        for (value, down, up) in [
            (3.996, "3.99", "4.00"),
            (1.995, "1.99", "2.00"),
            (3.004, "3.00", "3.01"),
            (4.35, "4.35", "4.35"),
            (3.0, "3.00", "3.00"),
            (0.0, "0.00", "0.00"),
            (-0.0, "0.00", "0.00"),
            (0.004, "0.00", "0.01"),
            (-0.004, "-0.01", "0.00"),
            (-1.5, "-1.50", "-1.50"),
            (11_999.999, "11999.99", "12000.00"),
        ] {
            assert_eq!((fixed_down(value, 2).as_str(), fixed_up(value, 2).as_str()), (down, up), "{value}");
        }
        for i in 0..100_000 {
            let value = f64::from(i) * 0.000_77 - 5.0;
            let number = |text: String| text.parse::<f64>().unwrap();
            let (down, up) = (number(fixed_down(value, 2)), number(fixed_up(value, 2)));
            assert!(down <= value && value <= up && up - down < 0.010_001, "{value}: {down}, {up}");
        }
    }

    #[test]
    fn positions_carry_into_the_next_degree() {
        let nearly = Geodetic::from_degrees(39.999_999_99, -75.999_999_99);
        assert_eq!(position_texts(nearly), ("40N00.0000".into(), "76W00.0000".into()));
        assert_eq!(position("39N60.0000", "74W19.4386"), None);
        assert_eq!(position("91N00.0000", "74W19.4386"), None);
        assert_eq!(position("39N30.5553", "181W00.0000"), None);
        assert_eq!(position("-39N30.5553", "74W19.4386"), None);
    }

    #[test]
    fn times_are_of_the_day() {
        assert_eq!(time("15:08:37.672"), Some(54_517_672));
        assert_eq!(time_text(54_517_672), "15:08:37.672");
        for none in ["24:00:00", "1:60:00", "1:2", "1:2:3:4", "1.5:2:3", "x"] {
            assert_eq!(time(none), None, "{none}");
        }
    }
}
