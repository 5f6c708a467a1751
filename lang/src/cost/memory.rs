//! The memory of a mission: numbers of eight bytes, all laid out before its first tick.

use super::places;
use crate::hir::Hir;
use crate::lower::Lowered;
use crate::source::{Sources, Span};
use std::collections::{BTreeMap, BTreeSet};

/// The bytes of a number.
pub(super) const WORD: u64 = 8;

/// What a mission keeps from tick to tick, in bytes.
#[derive(Clone, Debug)]
pub struct Memory {
    /// All of it.
    pub bytes: u64,
    /// The latest samples of the inputs, and those that `hits` counts.
    pub inputs: u64,
    /// The numbers of its code.
    pub constants: u64,
    /// What activities keep, the most first.
    pub held: Vec<Held>,
}

/// What an activity keeps.
#[derive(Clone, Debug)]
pub struct Held {
    /// Its name, with its module.
    pub name: String,
    /// Where it is declared, `file:line`.
    pub place: String,
    /// And in the source.
    pub span: Span,
    /// For how many places that begin it: each has room of its own.
    pub places: u64,
    /// The bytes of all of them; what it calls is not among them.
    pub bytes: u64,
}

pub(super) fn of_mission(hir: &Hir, sources: &Sources, mission: usize, lowered: &Lowered) -> Memory {
    let words = |id: usize| lowered.units.get(&id).map_or(0, |(words, _)| *words);
    let mut held: Vec<Held> = places(hir, mission)
        .into_iter()
        .map(|(id, places)| {
            let inside = places::begun(hir, id).into_iter().map(words).fold(0, u64::saturating_add);
            let activity = &hir.activities[id];
            let bytes = places.saturating_mul(words(id).saturating_sub(inside)).saturating_mul(WORD);
            let place = sources.place(activity.span);
            Held { name: activity.full_name.clone(), place, span: activity.span, places, bytes }
        })
        .collect();
    held.sort_by(|a, b| b.bytes.cmp(&a.bytes).then_with(|| a.name.cmp(&b.name)));
    let program = &lowered.program;
    let inputs = program.inputs.iter().map(|input| u64::from(input.words())).sum::<u64>().saturating_mul(WORD);
    let constants = program.constants.len() as u64 * WORD;
    Memory { bytes: lowered.words.saturating_mul(WORD), inputs, constants, held }
}

/// How many places begin each activity, through all that begins them.
fn places(hir: &Hir, mission: usize) -> BTreeMap<usize, u64> {
    let mut order = Vec::new();
    callees_first(hir, mission, &mut BTreeSet::new(), &mut order);
    let mut places = BTreeMap::from([(mission, 1)]);
    // Callers first: what an activity begins is counted when all that begin it are.
    for id in order.into_iter().rev() {
        let times = places.get(&id).copied().unwrap_or(0);
        for begun in places::begun(hir, id) {
            let sum: &mut u64 = places.entry(begun).or_default();
            *sum = sum.saturating_add(times);
        }
    }
    places
}

fn callees_first(hir: &Hir, id: usize, seen: &mut BTreeSet<usize>, order: &mut Vec<usize>) {
    if seen.insert(id) {
        places::begun(hir, id).into_iter().for_each(|begun| callees_first(hir, begun, seen, order));
        order.push(id);
    }
}
