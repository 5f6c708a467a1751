//! What a mission costs: the most work that one of its ticks can be, the memory that it needs, and where both come from.
//!
//! Work is counted in *steps*: an expression computed, a statement done, an activity stepped, each counts as one, and what
//! walks a list or the corners of an area as many as these can hold. The count follows the checked program, every loop with
//! the most rounds that it can make within a tick and every branch the dearer way, so that no tick takes more.

mod bill;
pub(crate) mod limits;
mod memory;
mod places;
pub(crate) mod together;
mod weight;
mod work;

pub use memory::{Held, Memory};
pub use work::Round;

use crate::diagnostic::Diagnostic;
use crate::hir::Hir;
use crate::lower::{self, Lowered};
use crate::source::{Sources, Span};
use crate::types::TypeTable;

/// What a mission costs.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The most steps of one tick.
    pub steps: u64,
    /// Whose they are in that tick, the most first; the functions that one calls are its own.
    pub parts: Vec<Part>,
    /// What a call of each function takes, the dearest first.
    pub functions: Vec<Part>,
    /// The loops that go round within a tick, the dearest first.
    pub loops: Vec<Round>,
    /// What is kept from tick to tick.
    pub memory: Memory,
    /// Instructions.
    pub instructions: u64,
    /// Whose they are, the most first.
    pub code: Vec<Part>,
}

/// What something takes of a whole.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name, with its module.
    pub name: String,
    /// Where it is declared, `file:line`.
    pub place: String,
    /// And in the source.
    pub span: Span,
    /// Its own steps, or instructions; what it calls has a part of its own.
    pub steps: u64,
}

/// Parts of a whole, the largest first.
struct Parts(Vec<Part>);

impl Parts {
    fn sorted(mut parts: Vec<Part>) -> Self {
        parts.sort_by(|a, b| b.steps.cmp(&a.steps).then_with(|| a.name.cmp(&b.name)));
        Parts(parts)
    }

    fn of_activities(hir: &Hir, sources: &Sources, shares: impl Iterator<Item = (usize, u64)>) -> Vec<Part> {
        shares
            .map(|(id, steps)| {
                let activity = &hir.activities[id];
                let name = activity.full_name.clone();
                Part { name, place: sources.place(activity.span), span: activity.span, steps }
            })
            .collect()
    }

    fn of_functions(hir: &Hir, sources: &Sources, shares: impl Iterator<Item = (usize, u64)>) -> Vec<Part> {
        shares
            .map(|(id, steps)| {
                let function = &hir.fns[id];
                let place = sources.place(function.span);
                Part { name: function.name.clone(), place, span: function.span, steps }
            })
            .collect()
    }

    /// Whose the instructions of a mission are.
    fn of_code(hir: &Hir, sources: &Sources, lowered: &Lowered) -> Self {
        let units = lowered.units.iter().map(|(id, (_, ops))| (*id, *ops));
        let fns = lowered.fns.iter().map(|(id, ops)| (*id, *ops));
        let mut parts = Parts::of_activities(hir, sources, units);
        parts.extend(Parts::of_functions(hir, sources, fns));
        Parts::sorted(parts)
    }
}

/// The cost of a mission that is sound, however much it is.
pub(crate) fn of(hir: &Hir, types: &TypeTable, sources: &Sources, mission: usize) -> Result<Cost, Vec<Diagnostic>> {
    let lowered = lower::mission_parts(hir, types, sources, mission)?;
    let tally = work::of_mission(hir, types, sources, mission);
    Ok(Cost {
        steps: tally.bill.total(),
        parts: Parts::sorted(Parts::of_activities(hir, sources, tally.bill.shares())).0,
        functions: Parts::of_functions(hir, sources, tally.functions.into_iter()),
        loops: tally.loops,
        memory: memory::of_mission(hir, sources, mission, &lowered),
        instructions: lowered.instructions,
        code: Parts::of_code(hir, sources, &lowered).0,
    })
}

/// A number with its thousands apart.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
