//! What code must keep to, looked through once more after it is made: every place that an instruction names is there, nothing
//! is written among inputs and constants, and every tick ends. A way through code that leads back to where it was gives the
//! tick away, or counts its rounds towards an end that stands.
//!
//! [`Program::verify`] takes no word for anything from what the checker has shown of a script. How often a counted loop goes round
//! is not looked at here; the bill of a mission tells that. [`Program::verify_ranges`] computes the ranges of numbers anew, from
//! nothing but what the checker takes a unit's variables to be, which it holds to it.

mod claims;
mod effects;
mod known;
mod pieces;
mod ranges;
mod slots;
mod written;

pub use claims::{Claim, Claims, Unit};

use crate::{ABSOLUTE, Addr, AreaOp, Compute, ListOp, Op, Program, Slot, When};
use albacore_arithmetic::Operator;
use std::collections::{BTreeMap, BTreeSet};
use written::{goes_on, written};

/// Code that must not be run, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsound {
    /// The instruction.
    pub at: Addr,
    /// What is wrong with it.
    pub why: &'static str,
}

impl Program {
    /// Looks through all code.
    pub fn verify(&self) -> Result<(), Unsound> {
        for (at, op) in self.ops.iter().enumerate() {
            let unsound = |why| Unsound { at: at as Addr, why };
            if op.jump().is_some_and(|to| to as usize >= self.ops.len()) {
                return Err(unsound("it leads to where there is no code"));
            }
            for (to, words) in written(op) {
                if to & ABSOLUTE != 0 {
                    return Err(unsound("it writes among inputs and constants"));
                }
                if u64::from(to) + u64::from(words) > u64::from(self.words) {
                    return Err(unsound("it writes beyond the words of a run"));
                }
            }
            let is_there = match op {
                Op::Enter { call } | Op::Step { call, .. } | Op::Cut { call, .. } => {
                    (*call as usize) < self.calls.len()
                }
                Op::PutOn { overlay } | Op::TakeOff { overlay } => (*overlay as usize) < self.overlays.len(),
                Op::Report { site } => (*site as usize) < self.reports.len(),
                Op::Tell { statement } => (*statement as usize) < self.statements.len(),
                Op::Log { text } | Op::Abort { why: text } => (*text as usize) < self.texts.len(),
                Op::AskPayload { action, .. } => (*action as usize) < self.asks.len(),
                Op::Changed { memory } => (*memory as usize) < self.memories.len(),
                Op::Age { input, .. } | Op::IsNew { input, .. } | Op::Hits { input, .. } => {
                    (*input as usize) < self.inputs.len()
                }
                _ => true,
            };
            if !is_there {
                return Err(unsound("it names what is not there"));
            }
        }
        self.every_tick_ends((0..self.ops.len() as Addr).collect())
    }

    /// Where code may go on in the same tick.
    fn next(&self, at: Addr) -> [Option<Addr>; 2] {
        let op = &self.ops[at as usize];
        let goes_on = goes_on(op) && !matches!(op, Op::Yield);
        [op.jump(), (goes_on && (at as usize + 1) < self.ops.len()).then_some(at + 1)]
    }

    /// Whether no way among these instructions leads round and round in one tick. What counts a loop's rounds is taken out, and
    /// what is left is looked at again: the loops in it must have counters of their own.
    fn every_tick_ends(&self, code: BTreeSet<Addr>) -> Result<(), Unsound> {
        let mut open = vec![code];
        while let Some(code) = open.pop() {
            for ring in self.rings(&code) {
                let counters: Vec<Addr> = ring.iter().copied().filter(|&at| self.counts(at, &ring)).collect();
                if counters.is_empty() {
                    let at = ring.first().copied().unwrap_or_default();
                    return Err(Unsound { at, why: "it goes round without taking time" });
                }
                open.push(ring.into_iter().filter(|at| !counters.contains(at)).collect());
            }
        }
        Ok(())
    }

    /// Whether an instruction counts the rounds of a ring: it adds one to a word that nothing else in the ring writes, and the
    /// ring is left when that word has come to its end, which nothing in the ring writes either.
    fn counts(&self, at: Addr, ring: &BTreeSet<Addr>) -> bool {
        let Op::Compute(Compute::Two { operator: Operator::AddInt, to, a, b }) = self.ops[at as usize] else {
            return false;
        };
        let stands = |slot: Slot, except: Option<Addr>| {
            ring.iter()
                .filter(|&&other| Some(other) != except)
                .all(|&other| !written(&self.ops[other as usize]).any(|(to, words)| slot >= to && slot - to < words))
        };
        if to != a || !self.is_one(b, at) || !stands(to, Some(at)) {
            return false;
        }
        let leaves = |at: Addr| !ring.contains(&at);
        let looks = |other: Addr| match self.ops[other as usize] {
            Op::Compute(Compute::Jump { when: When::Less(a, b) | When::AtMost(a, b), .. }) => {
                a == to && stands(b, None) && leaves(other + 1)
            }
            Op::Compute(Compute::Jump { when: When::NotLess(a, b) | When::NotAtMost(a, b), to: end }) => {
                a == to && stands(b, None) && leaves(end)
            }
            Op::List(ListOp::At { list: of, index, .. }) | Op::Area(AreaOp::RowAt { rows: of, index, .. }) => {
                let next = self.ops.get(other as usize + 1);
                let is_left =
                    matches!(next, Some(Op::Compute(Compute::Jump { when: When::False(_), to })) if leaves(*to));
                index == to && stands(of, None) && is_left
            }
            _ => false,
        };
        // Every round that is counted is looked at.
        let unlooked: BTreeSet<Addr> = ring.iter().copied().filter(|&other| !looks(other)).collect();
        self.rings(&unlooked).iter().all(|ring| !ring.contains(&at))
    }

    /// Whether a word is one: a constant, or set so by the instruction before.
    fn is_one(&self, slot: Slot, at: Addr) -> bool {
        if slot & ABSOLUTE != 0 {
            let inputs: u32 = self.inputs.iter().map(crate::Input::words).sum();
            let index = (slot & !ABSOLUTE).checked_sub(inputs);
            return index.is_some_and(|index| self.constants.get(index as usize) == Some(&1.0));
        }
        let before = at.checked_sub(1).and_then(|at| self.ops.get(at as usize));
        matches!(before, Some(Op::Compute(Compute::Const { to, value })) if *to == slot && *value == 1.0)
    }

    /// The sets of instructions each of which leads to every other of its set (Tarjan's, without calling itself).
    fn rings(&self, code: &BTreeSet<Addr>) -> Vec<BTreeSet<Addr>> {
        let mut rings = Vec::new();
        let mut index: BTreeMap<Addr, (usize, usize)> = BTreeMap::new();
        let mut waiting: Vec<Addr> = Vec::new();
        let mut is_waiting: BTreeSet<Addr> = BTreeSet::new();
        for &root in code {
            if index.contains_key(&root) {
                continue;
            }
            let mut path: Vec<(Addr, usize)> = vec![(root, 0)];
            while let Some((at, way)) = path.pop() {
                if way == 0 {
                    let n = index.len();
                    index.insert(at, (n, n));
                    waiting.push(at);
                    is_waiting.insert(at);
                }
                let next = self.next(at);
                if let Some(&to) = next.get(way) {
                    path.push((at, way + 1));
                    match to.filter(|to| code.contains(to)) {
                        Some(to) if !index.contains_key(&to) => path.push((to, 0)),
                        Some(to) if is_waiting.contains(&to) => lower(&mut index, at, to),
                        _ => {}
                    }
                    continue;
                }
                if let Some(&(from, _)) = path.last() {
                    lower(&mut index, from, at);
                }
                if index.get(&at).is_some_and(|(n, low)| n == low) {
                    let begin = waiting.iter().rposition(|&other| other == at).unwrap_or(0);
                    let ring: BTreeSet<Addr> = waiting.drain(begin..).collect();
                    ring.iter().for_each(|other| _ = is_waiting.remove(other));
                    if ring.len() > 1 || next.contains(&Some(at)) {
                        rings.push(ring);
                    }
                }
            }
        }
        rings
    }
}

/// What one instruction reaches the other reaches too.
fn lower(index: &mut BTreeMap<Addr, (usize, usize)>, at: Addr, to: Addr) {
    let reached = index.get(&to).map_or(usize::MAX, |(_, low)| *low);
    if let Some((_, low)) = index.get_mut(&at) {
        *low = (*low).min(reached);
    }
}
