//! What a vehicle is told besides its course: one table of the channels of a command, and of the words in which setpoints stand.

use crate::{Slot, number};
use serde::{Deserialize, Serialize};

/// What is set by one of several channels: the vehicle follows one of an axis at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Axis {
    /// How deep: by depth or by altitude.
    Vertical,
    /// How fast.
    Speed,
}

impl Axis {
    /// All of them.
    pub const ALL: [Axis; 2] = [Axis::Vertical, Axis::Speed];

    /// Its name in `overlay … sets NAME`.
    pub const fn name(self) -> &'static str {
        match self {
            Axis::Vertical => "vertical",
            Axis::Speed => "speed",
        }
    }

    /// What an overlay may say that it commands.
    pub fn overlay_words() -> impl Iterator<Item = String> {
        let sets = Axis::ALL.into_iter().map(|axis| format!("sets {}", axis.name()));
        std::iter::once("amends course".to_string()).chain(sets)
    }

    /// What messages call it.
    pub const fn title(self) -> &'static str {
        match self {
            Axis::Vertical => "vertical channel",
            Axis::Speed => "speed",
        }
    }

    /// A statement that sets it.
    pub const fn example(self) -> &'static str {
        match self {
            Axis::Vertical => "keep depth D",
            Axis::Speed => "keep speed V",
        }
    }

    /// The axis of a name.
    pub fn named(name: &str) -> Option<Axis> {
        Axis::ALL.into_iter().find(|axis| axis.name() == name)
    }
}

/// The words in which vertical and speed setpoints are kept.
pub mod setpoints {
    /// [`UNSET`], [`DEPTH`] or [`ALTITUDE`].
    pub const VERTICAL: u32 = 0;
    /// Metres.
    pub const METRES: u32 = 1;
    /// Metres per second, or [`NO_SPEED`].
    pub const SPEED: u32 = 2;
    /// How many words that is.
    pub const WORDS: u32 = 3;

    /// No speed setpoint: below whatever a script can compute.
    pub const NO_SPEED: f64 = f64::NEG_INFINITY;
    /// No vertical setpoint.
    pub const UNSET: f64 = 0.0;
    /// The metres are a depth.
    pub const DEPTH: f64 = 1.0;
    /// The metres are an altitude.
    pub const ALTITUDE: f64 = 2.0;

    /// The words where nobody has set anything.
    pub const NONE: [f64; WORDS as usize] = [UNSET, 0.0, NO_SPEED];
}

/// The type of a setpoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SetpointKind {
    /// A depth, counted from the surface down.
    Depth,
    /// An altitude, counted from the bottom up.
    Altitude,
    /// A quantity, by the name that the language has for its type.
    Quantity(&'static str),
}

/// What tells that a setpoint is set.
#[derive(Clone, Copy, Debug)]
pub enum Mark {
    /// Another word holds this number: it tells which channel of the axis is set.
    Word(Slot, f64),
    /// Its own word does not hold this one.
    Unless(f64),
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Setpoint {
    /// The word for it, in `at`, `with`, `keep` and limits.
    pub name: &'static str,
    /// What it sets.
    pub axis: Axis,
    /// Its type.
    pub kind: SetpointKind,
    /// Its unit, that of SI: messages put numbers beside it as they are.
    pub unit: &'static str,
    /// What one of that unit means.
    pub meaning: &'static str,
    /// What is more of it.
    pub more: &'static str,
    /// What is less of it.
    pub less: &'static str,
    /// How it is printed.
    pub print: fn(f64) -> String,
    /// The word of [`setpoints`] in which it stands.
    pub word: Slot,
    /// What tells that it is set.
    pub mark: Mark,
    /// Whether 0 is within any limits: a vehicle may always stand still.
    pub is_free_at_zero: bool,
    /// Whether less than 0 means something.
    pub may_be_negative: bool,
}

/// The rows, and each channel's name: its place among them.
macro_rules! setpoints {
    ($($(#[$doc:meta])* $channel:ident: $row:expr;)*) => {
        /// A channel of the command, by its place in the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Channel { $($(#[$doc])* $channel),* }

        impl Channel {
            /// All of them.
            pub const ALL: [Channel; [$(Channel::$channel),*].len()] = [$(Channel::$channel),*];

            /// Its row.
            pub const fn row(self) -> &'static Setpoint {
                match self {
                    $(Channel::$channel => {
                        const ROW: Setpoint = $row;
                        &ROW
                    })*
                }
            }
        }
    };
}

setpoints! {
    /// Metres below the surface.
    Depth: Setpoint {
        name: "depth",
        axis: Axis::Vertical,
        kind: SetpointKind::Depth,
        unit: "m",
        meaning: "1 m below the surface",
        more: "deeper",
        less: "higher",
        print: number::metres,
        word: setpoints::METRES,
        mark: Mark::Word(setpoints::VERTICAL, setpoints::DEPTH),
        is_free_at_zero: false,
        may_be_negative: false,
    };
    /// Metres above the bottom.
    Altitude: Setpoint {
        name: "altitude",
        axis: Axis::Vertical,
        kind: SetpointKind::Altitude,
        unit: "m",
        meaning: "1 m above the bottom",
        more: "higher",
        less: "deeper",
        print: number::metres,
        word: setpoints::METRES,
        mark: Mark::Word(setpoints::VERTICAL, setpoints::ALTITUDE),
        is_free_at_zero: false,
        may_be_negative: false,
    };
    /// Metres per second.
    Speed: Setpoint {
        name: "speed",
        axis: Axis::Speed,
        kind: SetpointKind::Quantity("Speed"),
        unit: "m/s",
        meaning: "that speed",
        more: "faster",
        less: "slower",
        print: number::metres_per_second,
        word: setpoints::SPEED,
        mark: Mark::Unless(setpoints::NO_SPEED),
        is_free_at_zero: true,
        may_be_negative: false,
    };
}

impl Channel {
    /// The channel of a name.
    pub fn named(name: &str) -> Option<Channel> {
        Channel::ALL.into_iter().find(|channel| channel.row().name == name)
    }

    /// Its setpoint, if that is in force in some words of [`setpoints`].
    pub fn in_force(self, words: &[f64]) -> Option<f64> {
        let row = self.row();
        let value = *words.get(row.word as usize)?;
        let is_set = match row.mark {
            Mark::Word(word, mark) => words.get(word as usize) == Some(&mark),
            Mark::Unless(unset) => value != unset,
        };
        is_set.then_some(value)
    }
}
