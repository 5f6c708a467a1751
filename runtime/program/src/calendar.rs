//! Dates: seconds since the beginning of 1970, UTC, and the Gregorian calendar (ISO 8601). No leap second counts, as in POSIX time.

/// The years that a script may write: one beyond them is a slip.
pub const YEARS: std::ops::RangeInclusive<i64> = 1970..=2199;

const DAY_S: f64 = 86_400.0;

/// The days of a year before each of its months, of one without a 29 February.
const DAYS_BEFORE: [i64; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];

/// The seconds of a date as it is written, `2026-08-14T05:00Z` or `2026-08-14T05:00:30Z`; else what is wrong with it.
pub fn read(text: &str) -> Result<f64, String> {
    const FORM: &str = "a date is written `2026-08-14T05:00Z`: year, month, day, and the time in UTC";
    let (day, time) = text.split_once('T').ok_or(FORM)?;
    let time = time.strip_suffix('Z').ok_or_else(|| format!("{FORM}; `Z` stands for UTC, and there is no other"))?;
    let numbers = |text: &str, by: char, widths: &[usize]| -> Option<Vec<i64>> {
        let parts: Vec<&str> = text.split(by).collect();
        let is_of_width = parts.iter().zip(widths).all(|(part, width)| part.len() == *width);
        (is_of_width && parts.len() <= widths.len()).then(|| parts.iter().map(|part| part.parse().ok()).collect())?
    };
    let (Some(day), Some(time)) = (numbers(day, '-', &[4, 2, 2]), numbers(time, ':', &[2, 2, 2])) else {
        return Err(FORM.to_string());
    };
    let ([year, month, day], [hour, minute, rest @ ..]) = (&day[..], &time[..]) else { return Err(FORM.to_string()) };
    let second = rest.first().copied().unwrap_or(0);
    if !YEARS.contains(year) {
        return Err(format!("years are {} to {}", YEARS.start(), YEARS.end()));
    }
    if !(1..=12).contains(month) {
        return Err(format!("there is no month {month}"));
    }
    if !(1..=days_of(*year, *month)).contains(day) {
        return Err(format!("there is no day {day} in that month"));
    }
    if *hour > 23 || *minute > 59 || second > 59 {
        return Err("a day has 24 hours, from 00:00 to 23:59".to_string());
    }
    let days = days_before_year(*year) + days_before_month(*year, *month) + day - 1;
    Ok((days * 86_400 + hour * 3600 + minute * 60 + second) as f64)
}

/// A date to the second below, as [`read`] reads it; `?` for what is none.
pub fn written(seconds: f64) -> String {
    let days = (seconds / DAY_S).floor();
    // Years of four digits.
    if !(-719_528.0..2_932_897.0).contains(&days) {
        return "?".to_string();
    }
    let of_day = (seconds - days * DAY_S) as i64;
    let days = days as i64;
    // One year too early at most, and some before 1970.
    let mut year = 1969 + days.div_euclid(if days < 0 { 365 } else { 366 });
    while days_before_year(year + 1) <= days {
        year += 1;
    }
    let of_year = days - days_before_year(year);
    let month = (1..=12).rev().find(|month| days_before_month(year, *month) <= of_year).unwrap_or(1);
    let day = of_year - days_before_month(year, month) + 1;
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// A date to the nearest tenth of a second: `2026-08-14T05:00:30.2Z`.
pub fn written_to_tenths(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round();
    let whole = (tenths / 10.0).floor();
    match written(whole).strip_suffix('Z') {
        Some(text) => format!("{text}.{}Z", tenths - whole * 10.0),
        None => written(whole),
    }
}

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

fn days_of(year: i64, month: i64) -> i64 {
    let next = if month == 12 { 365 + i64::from(is_leap(year)) } else { days_before_month(year, month + 1) };
    next - days_before_month(year, month)
}

/// The days of a year before a month of it, which are 1 to 12.
fn days_before_month(year: i64, month: i64) -> i64 {
    let before = DAYS_BEFORE.get((month - 1) as usize).copied().unwrap_or(0);
    before + i64::from(month > 2 && is_leap(year))
}

/// The days from 1970 to a year.
fn days_before_year(year: i64) -> i64 {
    let leaps = |year: i64| year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    365 * (year - 1970) + leaps(year - 1) - leaps(1969)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for (text, seconds) in [
            ("1970-01-01T00:00:00Z", 0.0),
            ("1970-12-31T23:59:59Z", 31_535_999.0),
            ("2000-02-29T12:00:00Z", 951_825_600.0),
            ("2001-09-09T01:46:40Z", 1e9),
            ("2026-08-14T05:00:00Z", 1_786_683_600.0),
            ("2100-03-01T00:00:00Z", 4_107_542_400.0),
            ("2199-12-31T23:59:59Z", 7_258_118_399.0),
        ] {
            assert_eq!((read(text), written(seconds)), (Ok(seconds), text.to_string()));
            assert_eq!(written(seconds + 0.9), text);
        }
        assert_eq!(written(-1.0), "1969-12-31T23:59:59Z");
        assert_eq!(written(-3.6e9), "1855-12-03T08:00:00Z");
        assert_eq!(written(-62_135_596_800.0), "0001-01-01T00:00:00Z");
        assert_eq!(read("2026-08-14T05:00Z"), read("2026-08-14T05:00:00Z"));
        for day in (0..84_000).map(|day| f64::from(day) * DAY_S) {
            assert_eq!(read(&written(day)), Ok(day));
        }
    }

    #[test]
    fn what_is_no_date_is_told() {
        for (text, why) in [
            ("2026-13-14T05:00Z", "no month 13"),
            ("2026-02-29T05:00Z", "no day 29"),
            ("2100-02-29T05:00Z", "no day 29"),
            ("2026-08-14T24:00Z", "24 hours"),
            ("2026-08-14T05:00", "`Z` stands for UTC"),
            ("2026-08-14T05:00+02:00", "`Z` stands for UTC"),
            ("0026-08-14T05:00Z", "years are 1970 to 2199"),
            ("2026-8-14T5:00Z", "is written `2026-08-14T05:00Z`"),
            ("2026-08-14T05Z", "is written `2026-08-14T05:00Z`"),
            ("2026-08-14T05:00:00:00Z", "is written `2026-08-14T05:00Z`"),
        ] {
            assert!(read(text).is_err_and(|said| said.contains(why)), "{text}: {:?}", read(text));
        }
        assert_eq!((written(1e30), written(f64::NAN)), ("?".to_string(), "?".to_string()));
    }
}
