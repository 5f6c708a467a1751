//! What a mission costs: the most work that one of its ticks can be, the memory that it needs, and where both come from.
//!
//! Work is counted in *steps*: an expression computed, a statement done, an activity stepped, each counts as one, and what
//! walks a list or the corners of an area as many as these can hold. The count follows the checked program, every loop with
//! the most rounds that it can make within a tick and every branch the dearer way, so that no tick takes more.

mod bill;
mod memory;
mod places;
mod work;

pub use memory::{Held, Memory};
pub use work::Round;

use crate::diagnostic::Diagnostic;
use crate::hir::Hir;
use crate::lower;
use crate::source::Sources;
use crate::types::TypeTable;

/// What a mission costs.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The most steps of one tick.
    pub steps: u64,
    /// Whose they are in that tick, the most first; the functions that one calls are its own.
    pub parts: Vec<Part>,
    /// The loops that go round within a tick, the dearest first.
    pub loops: Vec<Round>,
    /// What is kept from tick to tick.
    pub memory: Memory,
    /// Instructions.
    pub instructions: usize,
}

/// What an activity takes of the dearest tick.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name, with its module.
    pub name: String,
    /// Where it is declared, `file:line`.
    pub place: String,
    /// Its own steps; what it calls has a part of its own.
    pub steps: u64,
}

/// The cost of a mission that is sound.
pub(crate) fn of(hir: &Hir, types: &TypeTable, sources: &Sources, mission: usize) -> Result<Cost, Vec<Diagnostic>> {
    let (program, units) = lower::mission_units(hir, types, sources, mission)?;
    let (bill, loops) = work::of_mission(hir, sources, mission);
    let mut parts: Vec<Part> = bill
        .shares()
        .map(|(id, steps)| {
            let activity = &hir.activities[id];
            Part { name: activity.full_name.clone(), place: sources.place(activity.span), steps }
        })
        .collect();
    parts.sort_by(|a, b| b.steps.cmp(&a.steps).then_with(|| a.name.cmp(&b.name)));
    Ok(Cost {
        steps: bill.total(),
        parts,
        loops,
        memory: memory::of_mission(hir, sources, mission, &program, &units),
        instructions: program.ops.len(),
    })
}
