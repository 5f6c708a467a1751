//! The language once more, as directly as can be: it reads the checked program, knows nothing of how that is lowered, and can
//! be read beside the rules of time, whose numbers stand where they are followed. It may be slow, and it clones what it likes.
//!
//! It shares geometry, guidance, the printer of numbers, the vehicle's types and a few limits with the machine, and nothing else.

mod activation;
mod aground;
mod body;
mod bottom;
mod control;
mod expr;
mod lift;
mod mission;
mod origin;
mod rest;
mod rise;
mod sinking;
mod table;
mod timed;
mod value;
mod watch;
mod world;

pub use activation::recovery;
pub use control::{Request, override_block};
pub use expr::exactly;
pub use mission::Evaluator;
