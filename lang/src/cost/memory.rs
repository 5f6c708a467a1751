//! The memory of a mission: numbers of eight bytes, all laid out before its first tick.

use super::places;
use crate::hir::Hir;
use crate::source::Sources;
use albacore_program::{Input, Program};
use std::collections::BTreeMap;

/// The bytes of a number.
const WORD: u64 = 8;

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
    /// For how many places that begin it: each has room of its own.
    pub places: u64,
    /// The bytes of all of them; what it calls is not among them.
    pub bytes: u64,
}

/// `units` are the words of each activity's frame, what it calls included.
pub(super) fn of_mission(
    hir: &Hir,
    sources: &Sources,
    mission: usize,
    program: &Program,
    units: &BTreeMap<usize, u32>,
) -> Memory {
    let mut places: BTreeMap<usize, u64> = BTreeMap::new();
    count(hir, mission, 1, &mut places);
    let words = |id: usize| u64::from(units.get(&id).copied().unwrap_or(0));
    let mut held: Vec<Held> = places
        .iter()
        .map(|(&id, &places)| {
            let inside: u64 = places::begun(hir, id).into_iter().map(words).sum();
            let activity = &hir.activities[id];
            let bytes = places.saturating_mul(words(id).saturating_sub(inside)).saturating_mul(WORD);
            Held { name: activity.full_name.clone(), place: sources.place(activity.span), places, bytes }
        })
        .collect();
    held.sort_by(|a, b| b.bytes.cmp(&a.bytes).then_with(|| a.name.cmp(&b.name)));
    let inputs = program.inputs.iter().map(Input::words).map(u64::from).sum::<u64>() * WORD;
    let constants = program.constants.len() as u64 * WORD;
    Memory { bytes: u64::from(program.words) * WORD, inputs, constants, held }
}

/// Counts the places that begin each activity, through all that begins them.
fn count(hir: &Hir, id: usize, times: u64, places: &mut BTreeMap<usize, u64>) {
    let sum = places.entry(id).or_default();
    *sum = sum.saturating_add(times);
    let mut inside: BTreeMap<usize, u64> = BTreeMap::new();
    for begun in places::begun(hir, id) {
        *inside.entry(begun).or_default() += 1;
    }
    for (begun, sites) in inside {
        count(hir, begun, times.saturating_mul(sites), places);
    }
}
