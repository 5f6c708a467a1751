//! A log of MOOS, `.alog`: a line for each value that a variable had, with its time, its name, who wrote it, and the value.
//!
//! ```text
//! %% LOGSTART 1696500000.0
//! 12.301  NAV_DEPTH  uSimMarine  3.02
//! ```

use crate::fault::{Faults, Unreadable, shortened};
use std::collections::BTreeMap;

/// No mission lasts so long, s: a later time counts from another beginning. What came before the log began has a time below 0.
const TIME_MAX_S: f64 = 3.6e7;

/// The numbers that each variable had, with their times, s, in the order of the log. What is no number is passed over.
pub type Variables = BTreeMap<String, Vec<(f64, f64)>>;

/// Reads a log. Lines that begin with `%%` are remarks.
pub fn read(bytes: &[u8]) -> Result<Variables, Unreadable> {
    let (mut faults, mut variables) = (Faults::default(), Variables::new());
    for (line, text) in (1..).zip(String::from_utf8_lossy(bytes).lines()) {
        let text = text.trim();
        if text.is_empty() || text.starts_with('%') {
            continue;
        }
        let mut cells = text.split_whitespace();
        let time = cells.next().and_then(|cell| cell.parse::<f64>().ok());
        let Some(time) = time.filter(|time| time.abs() <= TIME_MAX_S) else {
            let help = "each line of an alog begins with its time in seconds since the log began";
            faults.add(format!("line {line} begins with no time: `{}`", shortened(text)), help);
            continue;
        };
        let (Some(name), Some(_source)) = (cells.next(), cells.next()) else {
            let help = "each line of an alog has a time, a variable, who wrote it, and a value";
            faults.add(format!("line {line} is cut short: `{}`", shortened(text)), help);
            continue;
        };
        let value = cells.next().and_then(|cell| cell.parse::<f64>().ok()).filter(|value| value.is_finite());
        if let (Some(value), None) = (value, cells.next()) {
            variables.entry(name.to_string()).or_default().push((time, value));
        }
    }
    // Programs write into a log as they come to it.
    variables.values_mut().for_each(|values| values.sort_by(|a, b| a.0.total_cmp(&b.0)));
    match faults.into_unreadable() {
        Some(unreadable) => Err(unreadable),
        None => Ok(variables),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_log_are_read_and_texts_passed_over() {
        let log =
            b"%% LOG FILE\n1.5 NAV_X sim 3\n1.5  MODE  helm  \"ACTIVE 3\"\n2.0 NAV_X sim -4.5e1\n2.1 NAV_X sim nan\n";
        let read = read(log).unwrap();
        assert_eq!(read.into_iter().collect::<Vec<_>>(), [("NAV_X".to_string(), vec![(1.5, 3.0), (2.0, -45.0)])]);
    }

    #[test]
    fn each_wrong_line_is_told() {
        let told = read(b"now NAV_X sim 3\n2.0 NAV_X\n\xff\n").unwrap_err().faults;
        assert!(told[0].message.contains("line 1") && told[0].message.contains("line 3"), "{told:?}");
        assert!(told[1].message.contains("line 2 is cut short"), "{told:?}");
    }
}
