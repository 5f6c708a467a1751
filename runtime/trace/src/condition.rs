//! Conditions that were tried, in words.

use crate::wording::Wording;
use albacore_machine::{Condition, Tried};
use albacore_program::Target;
use serde::Serialize;

/// A condition that was tried in a tick.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TriedCondition {
    /// What it decides: `track_in -> track_out`, or `abort "no fix"`.
    pub decides: String,
    /// As it is written.
    pub condition: String,
    /// `file:line`.
    pub place: String,
    /// Whether the body of the behavior had come to its end.
    pub done: bool,
    /// Whether it held.
    pub holds: bool,
    /// The names in it and their values: `contact = false, lambda = 5.0 s`.
    pub values: String,
    /// What it is made of; empty where it is one term itself.
    pub terms: Vec<TriedTerm>,
}

/// A term of a condition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TriedTerm {
    /// As it is written.
    pub text: String,
    /// How deep it is in terms before it: in one that it is held by over time, or in a signal.
    pub depth: u32,
    /// Whether it held; none where those before it had decided.
    pub holds: Option<bool>,
}

/// Terms within terms stand so many columns to the right.
const TERM_INDENT: usize = 5;

impl TriedCondition {
    /// In lines: whether it held, what it decides, and what it is made of.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = self.terms_alone();
        if !self.values.is_empty() {
            lines.push(format!("         with {}", self.values));
        }
        lines
    }

    /// The same without the values.
    pub fn terms_alone(&self) -> Vec<String> {
        let TriedCondition { decides, place, condition, .. } = self;
        // A rule with `done` is tried once more when the behavior has come to its end.
        let at_end = if self.done { "  (at its end)" } else { "" };
        let mut lines = vec![format!("  {}  {decides}  {place}  on {condition}{at_end}", yes(Some(self.holds)))];
        for term in &self.terms {
            let indent = term.depth as usize * TERM_INDENT;
            lines.push(format!("         {:indent$}{}  {}", "", yes(term.holds), term.text));
        }
        lines
    }
}

fn yes(holds: Option<bool>) -> &'static str {
    match holds {
        Some(true) => "yes",
        Some(false) => "no ",
        None => "-  ",
    }
}

impl Wording {
    /// A condition that was tried.
    pub fn tried(&self, tried: &Tried) -> TriedCondition {
        let p = &self.names.program;
        let (watched, terms) = tried.condition.told(p, tried.done);
        let named = watched.iter().map(|watched| (watched.name.as_str(), &watched.shape));
        let holds = |word: &f64| (*word >= 0.0).then_some(*word != 0.0);
        let texts = terms.map_or(&[][..], |terms| &terms.texts);
        let terms = texts.iter().zip(&tried.terms).map(|((text, depth), word)| TriedTerm {
            text: one_line(text),
            depth: *depth,
            holds: holds(word),
        });
        let (decides, condition, place) = self.decides(tried.condition);
        TriedCondition {
            decides,
            condition: one_line(&condition),
            place,
            done: tried.done,
            holds: tried.holds,
            values: self.values_in_full(named, &tried.values),
            terms: terms.collect(),
        }
    }

    /// What a condition decides, how it is written, and where.
    fn decides(&self, condition: Condition) -> (String, String, String) {
        let p = &self.names.program;
        match condition {
            Condition::Exit(behavior, _) => {
                let Some(exit) = condition.exit(p) else { return Default::default() };
                let Some(rule) = p.rules.get(exit.rule as usize) else { return Default::default() };
                let guard = rule.text.split_once(" on ").map_or("", |(_, guard)| guard);
                let label = match rule.target {
                    Target::Abort(why) => format!("{} -> abort{}", self.names.name(behavior), self.quoted(why)),
                    _ => self.names.switch_label(behavior, exit.rule),
                };
                (label, guard.to_string(), rule.place.clone())
            }
            Condition::Abort(activity, at) => {
                let activity = p.activities.get(activity as usize);
                let Some(abort) = activity.and_then(|activity| activity.aborts.get(at as usize)) else {
                    return Default::default();
                };
                (format!("abort{}", self.quoted(abort.why)), abort.text.clone(), abort.place.clone())
            }
        }
    }

    /// A reason as it is written, where it has no holes.
    fn quoted(&self, text: u32) -> String {
        let plain = self.names.program.texts.get(text as usize).and_then(|text| text.plain());
        plain.map(|text| format!(" \"{}\"", one_line(&text))).unwrap_or_default()
    }
}

/// A condition may stand on several lines of its script.
fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    albacore_program::seen::one_line(&words.join(" "))
}
