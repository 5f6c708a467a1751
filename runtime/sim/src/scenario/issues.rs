//! Which scenarios are impossible, and how that is said: in the words of a scenario's script, of its clauses and their
//! parameters, so that whoever has the script can show the place.

use albacore_geometry::Vector;
use std::fmt;

/// Why a scenario cannot be simulated: all that was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
pub struct ScenarioError {
    /// One for each thing that cannot be.
    pub faults: Vec<ScenarioIssue>,
}

/// Something in a scenario that cannot be.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioIssue {
    /// The clause that says it, by its name in a script.
    pub clause: &'static str,
    /// Which of the clauses of that name, from 0: a scenario may have several sources.
    pub nth: usize,
    /// The clause's parameter, or one of a clause that is its value; none: all of the clause.
    pub param: Option<&'static str>,
    /// What is wrong with it.
    pub why: IssueCause,
}

/// What is wrong with a clause or a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum IssueCause {
    /// A size, in SI units, is greater than it may be.
    Over(f64, f64),
    /// What is wrong, and the mend.
    Said(String, String),
}

impl fmt::Display for ScenarioIssue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.why {
            IssueCause::Over(value, most) => {
                let (param, value, most) = (self.param.unwrap_or_default(), number(*value), number(*most));
                write!(f, "`{param}` of `{}` is {value}: it must be {most} at most", self.clause)
            }
            IssueCause::Said(message, _) => f.write_str(message),
        }
    }
}

/// Collects what cannot be in a scenario.
#[derive(Default)]
pub(crate) struct ScenarioIssues(pub Vec<ScenarioIssue>);

/// Collects what cannot be in one of its clauses.
pub(crate) struct OfClause<'a> {
    all: &'a mut Vec<ScenarioIssue>,
    clause: &'static str,
    nth: usize,
}

impl ScenarioIssues {
    /// Of a clause that stands once.
    pub fn of(&mut self, clause: &'static str) -> OfClause<'_> {
        self.nth(clause, 0)
    }

    /// Of one of several clauses of a name.
    pub fn nth(&mut self, clause: &'static str, nth: usize) -> OfClause<'_> {
        OfClause { all: &mut self.0, clause, nth }
    }
}

impl OfClause<'_> {
    /// The clause's name in a script.
    pub fn clause(&self) -> &'static str {
        self.clause
    }

    /// Things of a kind each have a name of their own; `others` are those that came before.
    pub fn name(&mut self, name: &str, others: &[&str]) {
        self.unless(Some("name"), !name.is_empty(), "this has no name", "give it one: traces and pictures call it so");
        let message = format!("there is a `{name}` already");
        self.unless(Some("name"), name.is_empty() || !others.contains(&name), message, "give each a name of its own");
    }

    fn add(&mut self, param: Option<&'static str>, why: IssueCause) {
        self.all.push(ScenarioIssue { clause: self.clause, nth: self.nth, param, why });
    }

    /// What is wrong unless something holds, and how to mend it; of a parameter or of the clause as a whole.
    pub fn unless(
        &mut self,
        param: Option<&'static str>,
        holds: bool,
        message: impl Into<String>,
        mend: impl Into<String>,
    ) {
        if !holds {
            self.add(param, IssueCause::Said(message.into(), mend.into()));
        }
    }

    /// The size of a vector, in SI units.
    pub fn at_most(&mut self, param: &'static str, size: f64, most: f64) {
        if size > most * (1.0 + ROUNDING) {
            self.add(Some(param), IssueCause::Over(size, most));
        }
    }

    pub fn flow(&mut self, param: &'static str, flow: Vector) {
        self.at_most(param, flow.length(), FLOW_MAX);
    }
}

/// The fastest flow, m/s: tidal races reach 8.
pub(crate) const FLOW_MAX: f64 = 10.0;
/// What units of a script may lose, as a share.
const ROUNDING: f64 = 1e-12;

/// A number as a person writes it: four decimals at most, and no zeros at the end.
pub(crate) fn number(x: f64) -> String {
    let text = format!("{x:.4}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    // What four decimals do not show is shown whole.
    if short.trim_start_matches('-') == "0" && x != 0.0 { format!("{x:e}") } else { short.to_string() }
}

/// The greatest number of one decimal, and for what is smaller of three, that is not greater.
pub(crate) fn rounded_down(x: f64) -> String {
    let decimals = if x.abs() < 1.0 { 1000.0 } else { 10.0 };
    number((x * decimals).floor() / decimals)
}
