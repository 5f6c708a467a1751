//! What only a whole mission shows: every statement has its setpoints and stands where the vehicle is ours, every input that
//! is read is required.

mod channels;
mod control;
mod findings;
mod fixed;
mod inputs;
mod levels;
mod limits;
mod livelock;
mod overlaps;
mod overrides;
mod places;
mod reports;
mod swapped;

pub use livelock::check as livelocks;
pub use overlaps::check as overlaps;
pub use overrides::{RunIn, check as overrides};
pub use places::{FAR_M, operating_area};
pub use reports::check as tests_reports;
pub use swapped::{hemisphere, of_mission as swapped};

pub use inputs::{read as inputs_read, recorded as inputs_recorded};

use crate::diagnostic::Diagnostic;
use crate::hir::Hir;
use crate::types::TypeTable;

/// The findings of a mission with all that it calls.
pub fn check(hir: &Hir, types: &TypeTable, mission: usize) -> Vec<Diagnostic> {
    let mut findings = channels::check(hir, mission);
    findings.extend(control::check(hir, mission));
    findings.extend(inputs::check(hir, mission));
    findings.extend(places::check(hir, mission));
    findings.extend(places::unusable(hir, mission));
    match swapped::check(hir, mission) {
        Some(swapped) => findings.push(swapped),
        None => {
            findings.extend(places::regions(hir, mission));
            findings.extend(places::goals(hir, types, mission));
        }
    }
    findings
}
