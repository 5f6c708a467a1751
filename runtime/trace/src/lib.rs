//! What a run leaves behind: the journal, the behavior trace, the digest of the full-rate run, the picture.
//!
//! Everything here is a pure function of what it is given: the same run gives the same bytes on every machine.

mod active;
mod beginnings;
mod behavior;
mod compare;
mod condition;
mod digest;
pub mod journal;
mod names;
mod picture;
mod record;
mod wording;
mod words;

pub use active::Active;
pub use behavior::{BehaviorTrace, Header, Release};
pub use compare::{Deed, Difference, deeds, first_difference, first_foreign_line, is_decision, same_behavior};
pub use condition::{TriedCondition, TriedTerm};
pub use digest::Digest;
pub use picture::{Cells, Depths, Picture, Profile, Sounding, TrueOutline};
pub use record::{Ending, Step, TickRecord, areas};
pub use words::control_name;
