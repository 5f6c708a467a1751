//! The measured part of `docs/faults.md`: of each fault whether it was detected, as what and when, and how the missions ended.

use super::Told;
use std::collections::BTreeMap;
use std::path::Path;

const BEGIN: &str = "<!-- measured: begin -->\n";
const END: &str = "<!-- measured: end -->";

/// The row of a fault.
pub fn row(fault: &str, told: &[Told]) -> String {
    let detected = told.iter().filter(|t| !t.detected.is_empty()).count();
    let mut firsts: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut outcomes: BTreeMap<String, usize> = BTreeMap::new();
    for told in told {
        if let Some((what, after)) = told.detected.first() {
            firsts.entry(what).or_default().push(*after);
        }
        let why = if told.reason.is_empty() { String::new() } else { format!(" ({})", told.reason) };
        *outcomes.entry(format!("{}{why}", told.outcome.name().replace('_', " "))).or_default() += 1;
    }
    let mut firsts: Vec<(&str, Vec<f64>)> = firsts.into_iter().collect();
    firsts.sort_by_key(|(_, after)| std::cmp::Reverse(after.len()));
    let firsts: Vec<String> = firsts.into_iter().take(3).map(|(what, after)| as_seen(what, after)).collect();
    let mut outcomes: Vec<(String, usize)> = outcomes.into_iter().collect();
    outcomes.sort_by_key(|(_, runs)| std::cmp::Reverse(*runs));
    let outcomes: Vec<String> = outcomes.into_iter().take(3).map(|(what, runs)| format!("{runs} {what}")).collect();
    format!("| `{fault}` | {detected} of {} | {} | {} |", told.len(), firsts.join("; "), outcomes.join("; "))
}

/// What was seen first, in how many runs, and after how long in half of them.
fn as_seen(what: &str, mut after: Vec<f64>) -> String {
    after.sort_by(f64::total_cmp);
    let median = after[after.len() / 2];
    format!("{what} ({} after {median:.1} s)", after.len())
}

/// Puts the rows where the page has a place for them.
pub fn write(page: &Path, rows: &[String], seeds: u64) {
    let text = std::fs::read_to_string(page).unwrap();
    let (before, rest) = text.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let head = format!(
        "Of {seeds} seeds each.\n\n| fault | detected | first, and in half of those runs after | the mission |\n|---|---|---|---|\n"
    );
    std::fs::write(page, format!("{before}{BEGIN}{head}{}\n{END}{after}", rows.join("\n"))).unwrap();
}
