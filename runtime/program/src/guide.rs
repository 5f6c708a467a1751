//! The guidance laws: one table of what a script writes for each, how it steers, what it needs, and how it ends.

use crate::senses::{COURSE, HEADING, POSITION};
use albacore_arithmetic::Interval;
use albacore_guidance::parameters::ARRIVAL_RADIUS;
use albacore_guidance::{FollowLine, Goto, GotoPose, LawOverWords, Loiter};
use serde::{Deserialize, Serialize};

/// The words that a guidance law keeps while its statement lasts: the most that any of them needs.
pub const GUIDANCE_WORDS: u32 = 32;
/// The least radius, of arrival, of a turn or of a circle, m.
const RADIUS_MIN: Interval = Interval::at_least(0.1);

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct GuidanceLaw {
    /// The word that its statement begins with. Of several laws with one verb the label of the first argument decides; without one
    /// it is the first of them.
    pub verb: &'static str,
    /// What is written after the verb.
    pub params: &'static [Param],
    /// What it makes of that, each tick.
    pub steering: Steering,
    /// How it ends by itself.
    pub ends: Ends,
    /// The inputs that it reads.
    pub inputs: &'static [&'static str],
    /// Whether somebody must have set a depth or an altitude.
    pub needs_vertical: bool,
    /// Whether somebody must have set a speed.
    pub needs_speed: bool,
    /// Whether it may stand in an overlay that sets a channel.
    pub is_for_overlays: bool,
}

/// How a law steers.
#[derive(Clone, Copy, Debug)]
pub enum Steering {
    /// By a law of the guidance, which keeps a state: its arguments are computed once.
    Law(LawOverWords),
    /// Along its argument, which is computed at every tick: a course over ground, or a heading through the water.
    Along {
        /// Whether it is a course over ground.
        over_ground: bool,
    },
    /// As asked for before; setpoints that are in force now are asked for.
    AsBefore,
    /// At the place where it began.
    Station,
    /// Nothing is asked for.
    Nothing,
}

/// How a law ends by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// When the vehicle has arrived.
    Arrives,
    /// After as many turns as this parameter says; never, if that is 0.
    Turns(&'static str),
    /// Never.
    Never,
}

/// What a statement takes after its verb.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// Its label.
    pub name: &'static str,
    /// Its type.
    pub kind: ParamKind,
    /// What holds when it is left out.
    pub omitted: Omitted,
    /// The values that it may have, if it may not have all.
    pub range: Option<Interval>,
    /// What it is, for the reference.
    pub meaning: &'static str,
}

/// The type of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each variant is the type of its name")]
pub enum ParamKind {
    Point,
    Line,
    Heading,
    Length,
    Number,
    Bool,
}

/// What holds when an argument is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Omitted {
    /// It cannot be.
    Refused,
    /// This value.
    Is(f64),
    /// The radius that speed, flow and turn rate allow. It stands as 0 among the arguments, outside the range of what is written.
    TightestTurn,
}

impl Param {
    const fn needed(name: &'static str, kind: ParamKind, meaning: &'static str) -> Self {
        Param { name, kind, omitted: Omitted::Refused, range: None, meaning }
    }

    const fn or(self, value: f64) -> Self {
        Param { omitted: Omitted::Is(value), ..self }
    }

    const fn or_tightest_turn(self) -> Self {
        Param { omitted: Omitted::TightestTurn, ..self }
    }

    const fn within(self, range: Interval) -> Self {
        Param { range: Some(range), ..self }
    }

    /// The number that stands among the arguments when it is left out.
    pub fn default(&self) -> Option<f64> {
        match self.omitted {
            Omitted::Refused => None,
            Omitted::Is(value) => Some(value),
            Omitted::TightestTurn => Some(0.0),
        }
    }

    /// Whether all of some numbers may be its argument.
    pub(crate) fn admits(&self, range: Interval) -> bool {
        self.range.is_none_or(|own| own.covers(range))
            || self.default().is_some_and(|default| range.constant() == Some(default))
    }
}

impl ParamKind {
    /// How many words an argument of it takes.
    pub(crate) fn words(self) -> u32 {
        match self {
            ParamKind::Line => 4,
            ParamKind::Point => 2,
            ParamKind::Heading | ParamKind::Length | ParamKind::Number | ParamKind::Bool => 1,
        }
    }

    /// Whether it is a place to go to.
    pub fn is_place(self) -> bool {
        matches!(self, ParamKind::Point | ParamKind::Line)
    }
}

impl GuidanceLaw {
    /// One that leads somewhere and arrives there.
    const fn leading(verb: &'static str, law: LawOverWords, params: &'static [Param]) -> Self {
        assert!(law.words <= GUIDANCE_WORDS as usize, "a statement has room for the state of its law");
        GuidanceLaw {
            verb,
            params,
            steering: Steering::Law(law),
            ends: Ends::Arrives,
            inputs: &[POSITION, COURSE, HEADING],
            needs_vertical: true,
            needs_speed: true,
            is_for_overlays: false,
        }
    }

    const fn ending(self, ends: Ends) -> Self {
        GuidanceLaw { ends, ..self }
    }

    /// One that keeps a direction, for ever.
    const fn along(over_ground: bool, params: &'static [Param]) -> Self {
        GuidanceLaw {
            verb: "steer",
            params,
            steering: Steering::Along { over_ground },
            ends: Ends::Never,
            inputs: &[HEADING],
            needs_vertical: true,
            needs_speed: true,
            is_for_overlays: false,
        }
    }

    /// Whether its arguments are computed anew at every tick.
    pub fn reads_arguments_anew(&self) -> bool {
        matches!(self.steering, Steering::Along { .. })
    }

    /// How many words its arguments take.
    pub fn args_words(&self) -> u32 {
        self.params.iter().map(|param| param.kind.words()).sum()
    }

    /// Each parameter, and how many words of arguments stand before it.
    pub(crate) fn placed_params(&self) -> impl Iterator<Item = (u32, &'static Param)> {
        self.params.iter().scan(0, |words, param| {
            let at = *words;
            *words += param.kind.words();
            Some((at, param))
        })
    }
}

/// The rows, and each law's name: its place among them.
macro_rules! laws {
    ($($(#[$doc:meta])* $guide:ident: $row:expr;)*) => {
        /// A guidance law, by its place in the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Guide { $($(#[$doc])* $guide),* }

        impl Guide {
            /// All of them.
            pub const ALL: [Guide; [$(Guide::$guide),*].len()] = [$(Guide::$guide),*];

            /// Its row.
            pub const fn law(self) -> &'static GuidanceLaw {
                match self {
                    $(Guide::$guide => {
                        const LAW: GuidanceLaw = $row;
                        &LAW
                    })*
                }
            }
        }
    };
}

laws! {
    /// Drives straight at a point.
    Goto: GuidanceLaw::leading("goto", LawOverWords::of::<_, Goto>(), &[
        Param::needed("point", ParamKind::Point, "the place to go to"),
        Param::needed("radius", ParamKind::Length, "the distance at which the vehicle has arrived")
            .or(ARRIVAL_RADIUS).within(RADIUS_MIN),
    ]);
    /// Drives along a line.
    Follow: GuidanceLaw::leading("follow", LawOverWords::of::<_, FollowLine>(), &[
        Param::needed("line", ParamKind::Line, "the line, driven from its start to its end"),
        Param::needed("radius", ParamKind::Length, "the radius of the turns onto the line").or_tightest_turn().within(RADIUS_MIN),
    ]);
    /// Drives to a point so as to arrive there on a heading.
    Dubins: GuidanceLaw::leading("dubins", LawOverWords::of::<_, GotoPose>(), &[
        Param::needed("point", ParamKind::Point, "the place to go to"),
        Param::needed("heading", ParamKind::Heading, "the heading on which to arrive there"),
        Param::needed("radius", ParamKind::Length, "the radius of the turns").or_tightest_turn().within(RADIUS_MIN),
        Param::needed("all_words", ParamKind::Bool, "whether paths of three arcs are tried too").or(0.0),
    ]);
    /// Keeps a course over ground.
    Steer: GuidanceLaw::along(true, &[
        Param::needed("course", ParamKind::Heading, "the course over ground"),
    ]);
    /// Keeps a heading through the water.
    SteerHeading: GuidanceLaw::along(false, &[
        Param::needed("heading", ParamKind::Heading, "the heading through the water; its label is written"),
    ]);
    /// Keeps course; the setpoint that is written after it says the rest.
    Keep: GuidanceLaw {
        verb: "keep",
        params: &[],
        steering: Steering::AsBefore,
        ends: Ends::Never,
        inputs: &[HEADING],
        needs_vertical: false,
        needs_speed: false,
        is_for_overlays: true,
    };
    /// Stays at the place where it began.
    Hold: GuidanceLaw {
        verb: "hold",
        params: &[],
        steering: Steering::Station,
        ends: Ends::Never,
        inputs: &[HEADING],
        needs_vertical: true,
        needs_speed: false,
        is_for_overlays: false,
    };
    /// Goes on as commanded last.
    Wait: GuidanceLaw {
        verb: "wait",
        params: &[],
        steering: Steering::Nothing,
        ends: Ends::Never,
        inputs: &[],
        needs_vertical: false,
        needs_speed: false,
        is_for_overlays: true,
    };
    /// Circles a point.
    Loiter: GuidanceLaw::leading("loiter", LawOverWords::of::<_, Loiter>(), &[
        Param::needed("center", ParamKind::Point, "the point to circle"),
        Param::needed("radius", ParamKind::Length, "the radius of the circle").within(RADIUS_MIN),
        Param::needed("turns", ParamKind::Number, "how many turns; 0: no end").or(0.0).within(Interval::NOT_NEGATIVE),
        Param::needed("clockwise", ParamKind::Bool, "the direction, seen from above").or(1.0),
    ]).ending(Ends::Turns("turns"));
}

impl Guide {
    /// The laws of a verb.
    pub fn of_verb(verb: &str) -> impl Iterator<Item = Guide> {
        Guide::ALL.into_iter().filter(move |guide| guide.law().verb == verb)
    }

    /// The law that a verb means with the label of its first argument, if that has one.
    pub fn named(verb: &str, label: Option<&str>) -> Option<Guide> {
        let labelled = |guide: &Guide| guide.law().params.first().map(|param| param.name) == label;
        Guide::of_verb(verb).find(labelled).or_else(|| Guide::of_verb(verb).next())
    }

    /// Whether a word is a verb with arguments.
    pub fn takes_arguments(verb: &str) -> bool {
        Guide::of_verb(verb).any(|guide| !guide.law().params.is_empty())
    }
}
