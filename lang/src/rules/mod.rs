//! What only a whole mission shows: every statement has its setpoints, every input that is read is required.

mod channels;
mod inputs;
mod limits;
mod overlaps;
mod places;
mod unreached;

pub use overlaps::check as overlaps;
pub use unreached::check as unreached;

pub use inputs::read as inputs_read;

use crate::diagnostic::Diagnostic;
use crate::hir::Hir;

/// The findings of a mission with all that it calls.
pub fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let mut findings = channels::check(hir, mission);
    findings.extend(inputs::check(hir, mission));
    findings.extend(places::check(hir, mission));
    findings
}
