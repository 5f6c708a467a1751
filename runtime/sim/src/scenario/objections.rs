//! Which scenarios are impossible, and how that is said: in the words of a scenario's script, of its clauses and their
//! parameters, so that whoever has the script can show the place.

use albacore_geometry::Vector;
use albacore_vehicle::TICK_S;
use std::fmt;
use std::ops::RangeInclusive;

/// Why a scenario cannot be simulated: all that was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
pub struct ScenarioError {
    /// One for each thing that cannot be.
    pub faults: Vec<Objection>,
}

/// Something in a scenario that cannot be.
#[derive(Clone, Debug, PartialEq)]
pub struct Objection {
    /// The clause that says it, by its name in a script.
    pub clause: &'static str,
    /// Which of the clauses of that name, from 0: a scenario may have several sources.
    pub nth: usize,
    /// The clause's parameter, or one of a clause that is its value; none: all of the clause.
    pub param: Option<&'static str>,
    /// What is wrong with it.
    pub why: Why,
}

/// What is wrong with a clause or a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// A number, in SI units and radians, is not within its bounds.
    Outside(f64, Bounds),
    /// What is wrong, and the mend.
    Said(String, String),
}

/// Bounds of a number, in SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bounds {
    /// Greater than this.
    Above(f64),
    /// This or more.
    AtLeast(f64),
    /// This or less.
    AtMost(f64),
    /// From the one to the other, both among them.
    Within(f64, f64),
    /// From the one, which is not among them, to the other, which is.
    UpTo(f64, f64),
}

impl Bounds {
    fn hold(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Bounds::Above(low) => x > low,
                Bounds::AtLeast(low) => x >= low,
                Bounds::AtMost(high) => x <= high,
                // What was computed to be one of them is within them, but for rounding.
                Bounds::Within(low, high) => {
                    let slack = ROUNDING * low.abs().max(high.abs());
                    x >= low - slack && x <= high + slack
                }
                Bounds::UpTo(low, high) => x > low && x <= high,
            }
    }

    /// In words, its numbers written as `number` writes them.
    pub fn told(self, number: impl Fn(f64) -> String) -> String {
        match self {
            Bounds::Above(low) => format!("above {}", number(low)),
            Bounds::AtLeast(low) => format!("{} or more", number(low)),
            Bounds::AtMost(high) => format!("{} at most", number(high)),
            Bounds::Within(low, high) => format!("{} to {}", number(low), number(high)),
            Bounds::UpTo(low, high) => format!("above {} and {} at most", number(low), number(high)),
        }
    }
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.why {
            Why::Outside(value, bounds) => {
                let (param, must) = (self.param.unwrap_or_default(), bounds.told(told));
                write!(f, "`{param}` of `{}` is {}: it must be {must}", self.clause, told(*value))
            }
            Why::Said(message, _) => f.write_str(message),
        }
    }
}

/// Collects what cannot be in a scenario.
#[derive(Default)]
pub(crate) struct Objections(pub Vec<Objection>);

/// Collects what cannot be in one of its clauses.
pub(crate) struct OfClause<'a> {
    all: &'a mut Vec<Objection>,
    clause: &'static str,
    nth: usize,
}

impl Objections {
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

    fn add(&mut self, param: Option<&'static str>, why: Why) {
        self.all.push(Objection { clause: self.clause, nth: self.nth, param, why });
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
            self.add(param, Why::Said(message.into(), mend.into()));
        }
    }

    pub fn bounds(&mut self, param: &'static str, value: f64, bounds: Bounds) {
        if !bounds.hold(value) {
            self.add(Some(param), Why::Outside(value, bounds));
        }
    }

    pub fn positive(&mut self, param: &'static str, value: f64) {
        self.bounds(param, value, Bounds::Above(0.0));
    }

    pub fn not_negative(&mut self, param: &'static str, value: f64) {
        self.bounds(param, value, Bounds::AtLeast(0.0));
    }

    pub fn within(&mut self, param: &'static str, value: f64, bounds: RangeInclusive<f64>) {
        let (low, high) = bounds.into_inner();
        self.bounds(param, value, Bounds::Within(low, high));
    }

    /// Samples a second of what is read at ticks: one a tick at most.
    pub fn rate(&mut self, param: &'static str, rate: f64) {
        self.bounds(param, rate, Bounds::UpTo(0.0, 1.0 / TICK_S));
    }

    /// A share of a whole.
    pub fn share(&mut self, param: &'static str, value: f64) {
        self.bounds(param, value, Bounds::Within(0.0, 1.0));
    }

    /// The way from a sensor to who reads it, s.
    pub fn delay(&mut self, param: &'static str, value: f64) {
        self.bounds(param, value, Bounds::Within(0.0, DELAY_MAX_S));
    }

    pub fn finite(&mut self, param: &'static str, values: [f64; 2]) {
        let message = format!("`{param}` of `{}` is not finite", self.clause);
        self.unless(Some(param), values.iter().all(|v| v.is_finite()), message, "give a number");
    }

    pub fn flow(&mut self, param: &'static str, flow: Vector) {
        self.bounds(param, flow.length(), Bounds::AtMost(FLOW_MAX));
    }
}

/// The longest delay of a sensor, s.
const DELAY_MAX_S: f64 = 600.0;
/// The fastest flow, m/s: tidal races reach 8.
pub(crate) const FLOW_MAX: f64 = 10.0;
/// What units of a script may lose, as a share.
const ROUNDING: f64 = 1e-12;

/// A number as a person writes it: four decimals at most, and no zeros at the end.
pub(crate) fn told(x: f64) -> String {
    let text = format!("{x:.4}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    // What four decimals do not show is shown whole.
    if short.trim_start_matches('-') == "0" && x != 0.0 { format!("{x:e}") } else { short.to_string() }
}

/// The greatest number of one decimal, and for what is smaller of three, that is not greater.
pub(crate) fn rounded_down(x: f64) -> String {
    let decimals = if x.abs() < 1.0 { 1000.0 } else { 10.0 };
    told((x * decimals).floor() / decimals)
}
