//! Scenarios and tests: the world of a simulated run, and what must hold in it.

use super::{ActivityId, Expr, Var, VarId};
use crate::dimension::Dimension;
use crate::source::Span;
use crate::types::Type;

/// A scenario: clauses with their arguments.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// Its name with that of its module, as [`super::Activity::full_name`].
    pub full_name: String,
    /// What the script that is run calls it: with the module that it imports it from, alone if it is its own or every script's.
    pub path: String,
    /// Where it is declared.
    pub span: Span,
    /// Its parameters.
    pub vars: Vec<Var>,
    /// Their defaults.
    pub defaults: Vec<Option<Expr>>,
    /// The scenario that it is derived from.
    pub base: Option<usize>,
    /// What it says, in order.
    pub clauses: Vec<ClauseUse>,
}

/// A clause of a scenario.
#[derive(Clone, Debug)]
pub struct ClauseUse {
    /// Which.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// Its arguments by the names of the clause's parameters, defaults included.
    pub args: Vec<(String, ClauseArg)>,
}

/// An argument of a clause.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum ClauseArg {
    Value(Expr),
    Nested(ClauseUse),
}

/// What a test gives the mission.
#[derive(Clone, Debug)]
pub struct Row {
    /// Where it stands, in a table.
    pub span: Option<Span>,
    /// The mission's arguments.
    pub args: Vec<Expr>,
}

/// A test.
#[derive(Clone, Debug)]
pub struct Test {
    /// What it is called.
    pub name: String,
    /// Where its name stands.
    pub span: Span,
    /// The mission that it runs.
    pub mission: ActivityId,
    /// What the mission is given: once, or for each row of a table of parameters.
    pub rows: Vec<Row>,
    /// The parameters of the mission that expectations speak of, by their places, and the variables of their values.
    pub params: Vec<(usize, VarId)>,
    /// The scenario, by its index.
    pub scenario: usize,
    /// The seeds, both ends included.
    pub seeds: (u64, u64),
    /// What must hold.
    pub expects: Vec<Expect>,
    /// The seeds whose switches are compared with a snapshot.
    pub snapshots: Vec<u64>,
    /// The variables that expectations speak of.
    pub vars: Vec<Var>,
    /// Which of them is what.
    pub known: TestNames<VarId>,
    /// The points whose true water depth is asked for, and where the answers go; what one asks with comes before it.
    pub depths: Vec<(Expr, VarId)>,
}

/// What the expectations of a test speak of: variables here, the words that hold them once lowered.
#[derive(Clone, Debug)]
pub struct TestNames<T> {
    /// The vehicle's true position.
    pub position: T,
    /// The true source nearest to the latest report, else to the vehicle, if there are any.
    pub nearest_source: T,
    /// Where the vehicle started.
    pub start: T,
    /// The deepest point of the mission's area, if one is deeper than the others.
    pub deepest: T,
    /// Seconds since the run began.
    pub time: T,
    /// How the mission ended, for each of [`OUTCOMES`].
    pub outcomes: [T; OUTCOMES.len()],
    /// Whether it was aborted and why: the reasons that are asked for.
    pub reasons: Vec<(String, T)>,
    /// The mission's areas, the operating area first.
    pub areas: Vec<T>,
    /// What was reported, by name.
    pub reports: Vec<(ReportPart, String, T)>,
    /// How often something was done, by what it is called.
    pub counts: Vec<(Counted, String, T)>,
    /// The true place of a source, by its name, if there is one.
    pub sources: Vec<(String, T)>,
    /// The true outline of a spill, by its name, else of the nearest one, if there is one.
    pub boundaries: Vec<(Option<String>, T)>,
    /// Where the beacon truly is, if there is one and that is asked for.
    pub beacon: Option<T>,
    /// What inputs would truly tell, where that is asked for.
    pub inputs: Vec<(TrueInput, T)>,
}

/// How a run of a test may have ended, by the names of the outcomes. One that has failed holds to nothing.
pub const OUTCOMES: [&str; 7] =
    ["completed", "timed_out", "aborted", "refused", "released_by_vehicle", "link_lost", "aground"];

/// What a test asks of how the vehicle truly lies and moves, and of the water there: by the name of the input that tells it with errors; and
/// how far off the vehicle's navigation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum TrueInput {
    Depth,
    Altitude,
    Heading,
    Course,
    Speed,
    Temperature,
    Salinity,
    Chemical,
    Flow,
    PositionError,
    HeadingError,
    RollError,
    PitchError,
    DepthError,
    GyroBiasError,
    AccelerometerBiasError,
    PositionSigma,
}

impl TrueInput {
    /// All of them.
    pub const ALL: [TrueInput; 17] = [
        TrueInput::Depth,
        TrueInput::Altitude,
        TrueInput::Heading,
        TrueInput::Course,
        TrueInput::Speed,
        TrueInput::Temperature,
        TrueInput::Salinity,
        TrueInput::Chemical,
        TrueInput::Flow,
        TrueInput::PositionError,
        TrueInput::HeadingError,
        TrueInput::RollError,
        TrueInput::PitchError,
        TrueInput::DepthError,
        TrueInput::GyroBiasError,
        TrueInput::AccelerometerBiasError,
        TrueInput::PositionSigma,
    ];

    /// As it stands after `truth`.
    pub const fn name(self) -> &'static str {
        match self {
            TrueInput::Depth => "depth",
            TrueInput::Altitude => "altitude",
            TrueInput::Heading => "heading",
            TrueInput::Course => "course",
            TrueInput::Speed => "speed",
            TrueInput::Temperature => "temperature",
            TrueInput::Salinity => "salinity",
            TrueInput::Chemical => "chemical",
            TrueInput::Flow => "flow",
            TrueInput::PositionError => "position_error",
            TrueInput::HeadingError => "heading_error",
            TrueInput::RollError => "roll_error",
            TrueInput::PitchError => "pitch_error",
            TrueInput::DepthError => "depth_error",
            TrueInput::GyroBiasError => "gyro_bias_error",
            TrueInput::AccelerometerBiasError => "accelerometer_bias_error",
            TrueInput::PositionSigma => "position_sigma",
        }
    }

    /// The type of its value.
    pub fn ty(self) -> Type {
        let of_navigator = |dimension| Type::Quantity(dimension).optional();
        match self {
            TrueInput::Depth | TrueInput::Altitude => Type::Quantity(Dimension::LENGTH),
            TrueInput::Heading | TrueInput::Course => Type::Heading,
            TrueInput::Speed => Type::Quantity(Dimension::SPEED),
            TrueInput::Temperature => Type::Quantity(Dimension::TEMPERATURE),
            TrueInput::Salinity => Type::Quantity(Dimension::SALINITY),
            TrueInput::Chemical => Type::Quantity(Dimension::NONE),
            TrueInput::Flow => Type::Vector(Dimension::SPEED),
            TrueInput::PositionError => Type::Quantity(Dimension::LENGTH),
            TrueInput::HeadingError | TrueInput::RollError | TrueInput::PitchError => of_navigator(Dimension::ANGLE),
            TrueInput::DepthError | TrueInput::PositionSigma => of_navigator(Dimension::LENGTH),
            TrueInput::GyroBiasError => of_navigator(Dimension::TURN_RATE),
            TrueInput::AccelerometerBiasError => of_navigator(Dimension::ACCELERATION),
        }
    }
}

/// What a test counts besides reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// How often a payload was asked, by its action.
    Asks,
    /// How many samples of an input were recorded, by its name.
    Recorded,
}

/// What a test asks of a report.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ReportPart {
    /// Where it was, if it was a place.
    Place(Which),
    /// The seconds until it was, if it was.
    Time(Which),
    /// What stood behind a label; without a label the value itself.
    Value(Which, String),
    /// How often it was.
    Count,
}

/// One of the reports of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Which {
    /// In their order, from 1 on.
    Number(u32),
    /// The last so far.
    Last,
}

impl Which {
    /// The first of all.
    pub const FIRST: Which = Which::Number(1);
}

/// An expectation.
#[derive(Clone, Debug)]
pub struct Expect {
    /// When it must hold.
    pub when: When<ActivityId>,
    /// The condition.
    pub holds: Expr,
    /// What it takes for granted: variables that may be absent, and what to say when they are.
    pub needs: Vec<(VarId, String)>,
    /// Where it stands.
    pub span: Span,
}

/// When an expectation must hold; `A` stands for an activity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When<A> {
    /// At the end of this share of the runs.
    AtTheEnd(f64),
    /// At every tick of every run.
    Always,
    /// At some tick of every run.
    Once,
    /// At every tick in which a behavior or a strategy is active.
    While(A),
}

impl<T: Copy> TestNames<T> {
    /// The same names for something else.
    pub fn map<U>(&self, f: impl Fn(T) -> U) -> TestNames<U> {
        let report = |(part, name, x): &(ReportPart, String, T)| (part.clone(), name.clone(), f(*x));
        TestNames {
            position: f(self.position),
            nearest_source: f(self.nearest_source),
            start: f(self.start),
            deepest: f(self.deepest),
            time: f(self.time),
            outcomes: self.outcomes.map(&f),
            reasons: self.reasons.iter().map(|(why, x)| (why.clone(), f(*x))).collect(),
            areas: self.areas.iter().map(|x| f(*x)).collect(),
            reports: self.reports.iter().map(report).collect(),
            counts: self.counts.iter().map(|(counted, name, x)| (*counted, name.clone(), f(*x))).collect(),
            sources: self.sources.iter().map(|(name, x)| (name.clone(), f(*x))).collect(),
            boundaries: self.boundaries.iter().map(|(name, x)| (name.clone(), f(*x))).collect(),
            beacon: self.beacon.map(&f),
            inputs: self.inputs.iter().map(|(input, x)| (*input, f(*x))).collect(),
        }
    }
}

/// The name of a test as that of a file: its letters and digits, the words apart.
pub fn test_file_name(test: &str) -> String {
    let plain: String =
        test.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    let words: Vec<&str> = plain.split('_').filter(|w| !w.is_empty()).collect();
    words.join("_")
}
