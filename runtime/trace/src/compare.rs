//! Whether two traces tell of the same behavior: the same switches by the same rules, whatever the numbers.

use std::collections::BTreeMap;

/// Where two traces part for the first time: the line of each, or none where one is at its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The line of the first trace.
    pub left: Option<String>,
    /// The line of the second.
    pub right: Option<String>,
}

/// What a line says was done, without its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deed {
    /// Verb and what.
    pub said: String,
    /// The file and the line of the rule.
    rule: Option<(String, String)>,
}

impl Deed {
    /// What was done without its verb, where that goes without saying: `track_in -> track_out`.
    pub fn short(&self) -> &str {
        self.said.strip_prefix("switch ").unwrap_or(&self.said)
    }
}

/// All that a trace tells was done, each with its tick and its line.
pub fn deeds(trace: &str) -> impl Iterator<Item = (u64, Deed, &str)> {
    trace.lines().filter_map(|line| {
        let (time, _) = line.trim_start().split_once(" s  ")?;
        // The last digit is that of a tick.
        let tick = time.replace('.', "").parse().ok()?;
        Some((tick, deed(line)?, line.trim()))
    })
}

/// Whether two traces, or their event lines alone, tell of the same sequence of enterings, leavings, switches, reports,
/// changes of control, aborts and ends. See [`first_difference`].
pub fn same_behavior(a: &str, b: &str) -> bool {
    first_difference(a, b).is_none()
}

/// Where the behavior of two traces first differs.
///
/// Times, positions, values, samples, digests, logs, memories, the beginnings of statements, and the coming and going of overlays' amendments and of
/// limits are no part of it. Rules are matched one to one by file: a comment above a rule moves its line and changes nothing.
pub fn first_difference(a: &str, b: &str) -> Option<Difference> {
    let mut lefts = a.lines().filter_map(|line| Some((line, deed(line)?)));
    let mut rights = b.lines().filter_map(|line| Some((line, deed(line)?)));
    let (mut there, mut back) = (BTreeMap::new(), BTreeMap::new());
    loop {
        match (lefts.next(), rights.next()) {
            (None, None) => return None,
            (Some((_, left)), Some((_, right)))
                if left.said == right.said && paired(&left, &right, &mut there, &mut back) => {}
            (left, right) => {
                let line = |side: Option<(&str, Deed)>| side.map(|(line, _)| line.trim().to_string());
                return Some(Difference { left: line(left), right: line(right) });
            }
        }
    }
}

/// Whether a line of a trace tells of something that was decided: a switch, a hold, an abort, who drives, or the end.
pub fn is_decision(line: &str) -> bool {
    let verb = timed(line).and_then(|rest| rest.split("  ").next()).map(str::trim);
    let decided = ["switch", "resume", "stale", "fresh", "wait", "link", "abort", "timeout", "control", "end"];
    verb.is_some_and(|verb| decided.contains(&verb))
}

type Rule = (String, String);

/// Whether two deeds are by rules that can be one and the same, given the pairs so far.
fn paired(left: &Deed, right: &Deed, there: &mut BTreeMap<Rule, Rule>, back: &mut BTreeMap<Rule, Rule>) -> bool {
    match (&left.rule, &right.rule) {
        (None, None) => true,
        (Some(l), Some(r)) => {
            l.0 == r.0
                && *there.entry(l.clone()).or_insert_with(|| r.clone()) == *r
                && *back.entry(r.clone()).or_insert_with(|| l.clone()) == *l
        }
        _ => false,
    }
}

/// What a merge leaves at the beginning of a line.
const MERGED: [&str; 4] = ["<<<<<<<", "|||||||", "=======", ">>>>>>>"];

/// Whether a text is a trace, whatever it tells: as it was written, stale, or with the marks of a merge in it. Else the number of the
/// first line that is none of a trace, from 1; of a text without the line that a trace begins with, that is the first.
pub fn first_foreign_line(text: &str) -> Option<usize> {
    let is_head = |line: &str| line.starts_with("mission ") && line.contains("  seed ") && line.contains("  tick ");
    let is_end = |line: &str| line.starts_with("digest ") || line.ends_with(" more lines not written");
    let is_merged = |line: &str| MERGED.iter().any(|mark| line.starts_with(mark));
    let is_ours = |line: &str| {
        line.trim().is_empty() || is_head(line) || timed(line).is_some() || is_end(line) || is_merged(line)
    };
    if !text.lines().any(is_head) {
        return Some(1);
    }
    (1..).zip(text.lines()).find(|(_, line)| !is_ours(line)).map(|(number, _)| number)
}

/// What stands behind the time of a line, if it has one.
fn timed(line: &str) -> Option<&str> {
    let (time, rest) = line.trim_start().split_once(" s  ")?;
    time.bytes().all(|b| b.is_ascii_digit() || b == b'.').then_some(rest)
}

/// Reads an event line back; none for lines that are not about behavior.
fn deed(line: &str) -> Option<Deed> {
    let rest = timed(line)?;
    let mut columns = rest.split("  ").map(str::trim).filter(|column| !column.is_empty());
    let verb = columns.next()?;
    let what = columns.next().unwrap_or_default();
    let mut rule = None;
    let said = match verb {
        "switch" => {
            // The position, then the rule's place.
            rule = columns.nth(1).and_then(|place| place.rsplit_once(':')).map(|(f, l)| (f.to_string(), l.to_string()));
            what.to_string()
        }
        "leave" => format!("{what}, {}", columns.next().unwrap_or_default()),
        "report" => what.split(" = ").next().unwrap_or_default().to_string(),
        "abort" => what.chars().filter(|c| !c.is_ascii_digit()).collect(),
        "enter" | "suspend" | "resume" | "stale" | "fresh" | "control" | "timeout" | "end" => what.to_string(),
        _ => return None,
    };
    Some(Deed { said: format!("{verb} {said}"), rule })
}
