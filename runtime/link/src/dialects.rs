//! The table of dialects: a module and a row for each.

pub mod recon;

use crate::dialect::Dialect;

/// All of them. The first stands in examples.
pub static ALL: [&Dialect; 1] = [&recon::DIALECT];
