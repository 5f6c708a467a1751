//! The time of a run that its picture shows, as it is written: `2400s..2600s`, `40min..45min`.

use std::ops::RangeInclusive;

/// Ticks in a second.
const TICKS_PER_S: f64 = 10.0;
/// A mission lasts no longer than this, s.
const LAST_S: f64 = 1e9;

/// Reads the ticks from one time of the run to another.
pub fn parse(text: &str) -> Result<RangeInclusive<u64>, String> {
    let (from, to) = text.split_once("..").ok_or("two times with `..` between them are wanted: `2400s..2600s`")?;
    let ticks = |time: &str| seconds(time).map(|time| (time * TICKS_PER_S).round() as u64);
    let (from, to) = (ticks(from)?, ticks(to)?);
    if to <= from {
        return Err("it is shorter than a tick: the earlier time comes first, as in `2400s..2600s`".to_string());
    }
    Ok(from..=to)
}

fn seconds(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let number = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let unit = match text[number.len()..].trim() {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return Err(format!("`{text}` is no time: write `2400s`, `40min` or `1.5h`")),
    };
    let time = number.trim().parse::<f64>().ok().map(|number| number * unit);
    time.filter(|time| (0.0..=LAST_S).contains(time))
        .ok_or_else(|| format!("`{text}` is no time of a run: write `2400s`, `40min` or `1.5h`"))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn times_are_read_in_ticks() {
        assert_eq!(parse("2400s..2600s"), Ok(24_000..=26_000));
        assert_eq!(parse("0.5 min..1h"), Ok(300..=36_000));
        for wrong in [
            "",
            "5s",
            "5..6",
            "5s..5s",
            "6s..5s",
            "-1s..5s",
            "nans..5s",
            "5s..1e300h",
            "0s..0.04s",
            "5 m..6 m",
            "5s..é",
        ] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
