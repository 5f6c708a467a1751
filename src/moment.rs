//! A moment of a run, as it is written: `751s`, `12min31s`, or by the clock, `14:31` or `14:31:05`.

use crate::clock::Utc;
use std::ops::RangeInclusive;

/// Ticks in a second.
const TICKS_PER_S: f64 = 10.0;
/// A mission lasts no longer than this, s.
const LAST_S: f64 = 1e9;
const DAY_S: f64 = 86_400.0;

/// A stretch of time as exact as it was written: `14:31` is a minute, `751s` a second, `751.3s` a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// Seconds of the mission's time, and how long.
    OfMission(f64, f64),
    /// Seconds of the day, Coordinated Universal Time, and how long.
    OfDay(f64, f64),
}

impl Moment {
    /// Reads it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no time: write `751s` or `12min31s` of the run, or `14:31` or `14:31:05` of the clock (UTC)"
            )
        };
        let trimmed = text.trim();
        let moment = if trimmed.contains(':') { of_day(trimmed) } else { of_mission(trimmed) };
        moment.filter(Moment::is_possible).ok_or_else(wrong)
    }

    /// Whether it is one of the clock.
    pub fn is_of_clock(self) -> bool {
        matches!(self, Moment::OfDay(..))
    }

    fn is_possible(&self) -> bool {
        match self {
            Moment::OfMission(at, _) => (0.0..=LAST_S).contains(at),
            Moment::OfDay(at, _) => (0.0..DAY_S).contains(at),
        }
    }

    /// The ticks of it; none by the clock of a run whose clock is not known, or before its first tick. A run may last for days: of the
    /// day on which it began, or the next.
    pub fn ticks(self, first_tick: Option<Utc>) -> Option<RangeInclusive<u64>> {
        let (from, lasting) = match self {
            Moment::OfMission(from, lasting) => (from, lasting),
            Moment::OfDay(of_day, lasting) => {
                let began = first_tick?.second_of_day();
                let from = of_day - began;
                // A minute in which the run began counts from there.
                let from = if from + lasting <= 0.0 { from + DAY_S } else { from };
                (from.max(0.0), (from + lasting).min(lasting))
            }
        };
        let first = (from * TICKS_PER_S).round();
        let last = ((from + lasting) * TICKS_PER_S).round() - 1.0;
        Some(first as u64..=last.max(first) as u64)
    }
}

/// `14:31`, `14:31:05`, with a `Z` or without.
fn of_day(text: &str) -> Option<Moment> {
    let parts: Vec<&str> = text.trim_end_matches('Z').split(':').collect();
    let whole = |text: &str, below: f64| text.parse::<u32>().ok().map(f64::from).filter(|number| *number < below);
    match parts.as_slice() {
        [hour, minute] => Some(Moment::OfDay(whole(hour, 24.0)? * 3600.0 + whole(minute, 60.0)? * 60.0, 60.0)),
        [hour, minute, second] => {
            let at = whole(hour, 24.0)? * 3600.0 + whole(minute, 60.0)? * 60.0;
            let exact = second.parse::<f64>().ok().filter(|second| (0.0..60.0).contains(second))?;
            Some(Moment::OfDay(at + exact, exactness(second, 1.0)))
        }
        _ => None,
    }
}

/// `751s`, `12min31s`, `1.5 h`; a number alone is seconds.
fn of_mission(text: &str) -> Option<Moment> {
    let (mut rest, mut at, mut lasting) = (text, 0.0, None);
    while !rest.is_empty() {
        let number = rest.trim_start();
        let end = number.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(number.len());
        let (number, after) = number.split_at(end);
        let after = after.trim_start();
        let end = after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len());
        let (unit, after) = after.split_at(end);
        let unit = match unit {
            "" | "s" => 1.0,
            "min" => 60.0,
            "h" => 3600.0,
            _ => return None,
        };
        at += number.parse::<f64>().ok()? * unit;
        lasting = Some(exactness(number, if unit > 60.0 { 60.0 } else { unit }));
        rest = after.trim_start();
    }
    Some(Moment::OfMission(at, lasting?))
}

/// How long a time is that was written so: as long as its unit, or, with a fraction, a tick of seconds and a second of others.
fn exactness(number: &str, unit: f64) -> f64 {
    match number.contains('.') {
        true if unit > 1.0 => 1.0,
        true => 1.0 / TICKS_PER_S,
        false => unit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(text: &str) -> Option<RangeInclusive<u64>> {
        Moment::parse(text).ok()?.ticks(Utc::read("2026-11-29T14:20:30.5Z"))
    }

    #[test]
    fn a_moment_is_as_exact_as_it_was_written() {
        assert_eq!(ticks("751s"), Some(7510..=7519));
        assert_eq!(ticks(" 751 "), Some(7510..=7519));
        assert_eq!(ticks("751.3 s"), Some(7513..=7513));
        assert_eq!(ticks("12min31s"), Some(7510..=7519));
        assert_eq!(ticks("12 min"), Some(7200..=7799));
        assert_eq!(ticks("1.5h"), Some(54_000..=54_009));
        assert_eq!(ticks("14:31"), Some(6295..=6894));
        assert_eq!(ticks("14:31:05Z"), Some(6345..=6354));
        assert_eq!(ticks("14:20"), Some(0..=294), "from its first tick on");
        assert_eq!(ticks("02:00"), Some(419_695..=420_294), "on the next day");
        for wrong in ["", "s", "now", "1.2.3s", "-5s", "5 m", "25:00", "14:60", "14:31:5:6", "1e400h", "é", "5s:"] {
            assert!(Moment::parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(Moment::parse("14:31").unwrap().ticks(None), None);
    }
}
