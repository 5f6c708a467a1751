//! Executes a lowered mission tick by tick, by the numbered rules of time (`docs/language.md`, shown in `tests/rules`).
//!
//! The whole state of a run is one plain value, [`State`]: cloned, compared, serialised. The machine knows no vehicle:
//! it takes what was sensed and gives what to command.

mod activity;
mod aground;
mod allowance;
mod area;
mod bottom;
mod bound;
mod clocks;
mod command;
mod compute;
mod control;
mod event;
mod execute;
mod guide;
mod inputs;
mod least;
mod lift;
mod lists;
mod maps;
mod mission;
mod payload;
mod requirements;
mod rest;
mod sinking;
mod slope;
mod state;
mod tell;
mod tried;
mod trig;

pub use allowance::{LINE_BYTES, LINES_A_TICK_MAX, LINES_AT_ONCE_MAX, TEXT_BYTES_MAX};
pub use bottom::Chart;
pub use event::{Event, Heard, Outcome};
pub use execute::Evaluation;
pub use inputs::MissingInput;
pub use mission::{HeardInput, Machine};
pub use state::{ControlRequest, Phase, State};
pub use tried::{Condition, Tried};
