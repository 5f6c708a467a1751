//! The ranges of numbers, computed from the code itself by the rules that stand beside what the machine executes.
//!
//! Each piece of code begins with what its unit claims of its variables, follows every way through jumps, learns from those that
//! compare, and is held to the claims wherever others could read what it has written. Nothing is taken from the checker but the
//! claims; a division by what may be zero, the root of what may be negative, a negative time, or a claim that is not kept, is
//! unsound code.

use super::Unsound;
use super::claims::{Claims, Unit};
use super::known::{Ground, Known, Word};
use super::written::{goes_on, written};
use crate::{ABSOLUTE, Activity, Addr, Body, Compute, ListOp, Op, Program, Slot, When};
use albacore_arithmetic::Interval;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// So often a result, and what ways into a place tell, is taken as it is; then what still grows is widened.
pub(super) const PATIENCE: u32 = 3;

/// So often a place is come to with words that are more than before; then what still grows is widened, wherever it comes from.
const ROUNDS_MAX: u32 = 64;

/// What an operation has given in the rounds that were followed.
#[derive(Clone, Copy)]
pub(super) struct Results {
    /// Of what: an operand that was not always the same can be any.
    pub of: [Interval; 2],
    /// All of it.
    pub given: Interval,
    /// How often it grew.
    pub grown: u32,
}

impl Program {
    /// Computes all ranges anew, and holds the code to what is claimed.
    pub fn verify_ranges(&self, claims: &Claims) -> Result<(), Unsound> {
        let pieces: BTreeSet<Addr> = self.pieces().into_iter().chain(claims.pieces.iter().copied()).collect();
        for unit in &claims.units {
            let mut own: Vec<Addr> = pieces.range(unit.code.clone()).copied().collect();
            let guards = self.guards(unit);
            own.extend(guards.keys());
            own.extend(guards.values().flat_map(|(_, rules)| rules).flat_map(|rule| self.follow(*rule)));
            own.sort_unstable();
            own.dedup();
            let mut ranges = Ranges::new(self, claims, unit, &own);
            // What a timer shows is known when all code has been seen once, and of what watches a timer once more for each.
            let is_timer = |op: &Op| matches!(op, Op::Compute(Compute::HeldFor { .. } | Compute::Becomes { .. }));
            let has_timers = self.ops[code_of(self, unit)].iter().any(is_timer);
            let looks: &[bool] = if has_timers { &[false, false, false, true] } else { &[true] };
            for &holds_to_it in looks {
                ranges.holds_to_it = holds_to_it;
                ranges.unit_code(&own, &guards)?;
            }
        }
        Ok(())
    }

    /// The guards of a unit's rules by where they begin: where their value is, and whose they are.
    fn guards(&self, unit: &Unit) -> Guards {
        let tables = self.activities.iter().filter_map(|activity| match &activity.body {
            Body::Table(table) if unit.code.contains(&activity.entry) => Some(table),
            _ => None,
        });
        let mut guards = Guards::new();
        for exit in tables.flat_map(|table| &table.behaviors).flat_map(|behavior| &behavior.exits) {
            for code in [Some(exit.guard), exit.guard_done].into_iter().flatten() {
                guards.entry(code.entry).or_insert((code.value, Vec::new())).1.push(exit.rule);
            }
        }
        guards
    }
}

/// The instructions of a unit.
fn code_of(program: &Program, unit: &Unit) -> Range<usize> {
    let end = (unit.code.end as usize).min(program.ops.len());
    (unit.code.start as usize).min(end)..end
}

type Guards = BTreeMap<Addr, (Slot, Vec<u32>)>;

/// The ranges of one unit.
pub(super) struct Ranges<'p> {
    pub(super) program: &'p Program,
    pub(super) claims: &'p Claims,
    pub(super) unit: &'p Unit,
    pub(super) ground: Ground<'p>,
    typed: BTreeMap<Addr, Vec<(Slot, Word)>>,
    /// Where ways meet.
    meets: BTreeSet<Addr>,
    /// Who writes each word of the unit.
    writers: Vec<Writer>,
    /// What timers show, as far as it is known.
    pub(super) timers: BTreeMap<Slot, Option<Vec<(Slot, Interval)>>>,
    /// What operations of the piece at hand have given.
    pub(super) results: BTreeMap<Addr, Results>,
    /// What is known where the blocks of overrides begin.
    pub(super) entered: BTreeMap<Addr, Known>,
    pub(super) holds_to_it: bool,
}

/// The pieces of code that write a word.
#[derive(Clone, Copy)]
enum Writer {
    Nobody,
    One(Addr),
    Several,
}

impl<'p> Ranges<'p> {
    fn new(program: &'p Program, claims: &'p Claims, unit: &'p Unit, own: &[Addr]) -> Self {
        let meets = program.ops[code_of(program, unit)].iter().filter_map(Op::jump).collect();
        let mut typed: BTreeMap<Addr, Vec<(Slot, Word)>> = BTreeMap::new();
        for (at, claim) in &claims.typed {
            let word = Word { range: claim.range, is_whole: claim.is_whole };
            typed.entry(*at).or_default().push((claim.slot, word));
        }
        let ground = Ground::new(program, claims, unit);
        let mut ranges = Ranges {
            program,
            claims,
            unit,
            ground,
            typed,
            meets,
            writers: vec![Writer::Nobody; unit.words as usize],
            timers: BTreeMap::new(),
            results: BTreeMap::new(),
            entered: BTreeMap::new(),
            holds_to_it: false,
        };
        // The parameters of a mission are written before anything else runs, and never again.
        for &piece in own.iter().filter(|piece| **piece != program.mission.params) {
            for (slot, words) in ranges.writes(piece) {
                let end = slot.saturating_add(words).min(unit.words) as usize;
                for writer in ranges.writers.get_mut(slot as usize..end).unwrap_or_default() {
                    *writer = match writer {
                        Writer::Nobody => Writer::One(piece),
                        Writer::One(other) if *other == piece => Writer::One(piece),
                        _ => Writer::Several,
                    };
                }
            }
        }
        ranges
    }

    /// All words that a piece of code writes, with the subroutines of its own frame.
    pub(super) fn writes(&self, piece: Addr) -> Vec<(Slot, u32)> {
        let mut seen = BTreeSet::new();
        let mut open = vec![piece];
        let mut writes = Vec::new();
        while let Some(at) = open.pop() {
            let Some(op) = self.program.ops.get(at as usize).filter(|_| seen.insert(at)) else { continue };
            match *op {
                // As many elements as before, in another order.
                Op::List(ListOp::Sort { list, words, it, key, .. }) => {
                    open.push(key);
                    let (list, length) = self.list(list);
                    writes.extend([(it, words), (list.saturating_add(1), length.saturating_sub(1))]);
                }
                Op::List(ListOp::Replace { list, .. }) => {
                    let (list, length) = self.list(list);
                    writes.push((list.saturating_add(1), length.saturating_sub(1)));
                }
                Op::List(ListOp::Remove { list, .. }) => writes.push(self.list(list)),
                _ => writes.extend(written(op)),
            }
            match *op {
                Op::List(ListOp::PushSorted { sort, .. }) => open.push(sort),
                Op::Call { code, base: 0 } if self.unit.code.contains(&code) => open.push(code),
                _ => {}
            }
            open.extend(op.jump());
            if goes_on(op) {
                open.push(at + 1);
            }
        }
        merged(writes)
    }

    /// The words of a list: of a variable its own, of any other as many as there may be.
    pub(super) fn list(&self, list: Slot) -> (Slot, u32) {
        self.unit.lists.iter().copied().find(|(slot, _)| *slot == list).unwrap_or((list, ABSOLUTE - list))
    }

    /// What is known of the words of any element of a list: nothing where its length is not known here.
    pub(super) fn element(&self, known: &Known, list: Slot, words: u32) -> Vec<Word> {
        let length = known.range(&self.ground, list).constant().unwrap_or(0.0);
        let word = |of: u32, word: u32| {
            let slot = list.saturating_add(1).saturating_add(of.saturating_mul(words)).saturating_add(word);
            known.word(&self.ground, slot)
        };
        let of_all = |of_element| (0..length as u32).map(|of| word(of, of_element)).reduce(Word::or);
        (0..words).map_while(of_all).collect()
    }

    fn unit_code(&mut self, own: &[Addr], guards: &Guards) -> Result<(), Unsound> {
        let mut after: BTreeMap<u32, Known> = BTreeMap::new();
        self.entered.clear();
        for (&guard, (value, rules)) in guards {
            let Some(mut known) = self.piece(guard, Known::default())? else { continue };
            if !known.assume(&self.ground, *value, true) {
                continue;
            }
            for &rule in rules {
                let known = match after.get(&rule) {
                    Some(other) => other.join(&known, &self.ground),
                    None => known.clone(),
                };
                after.insert(rule, known);
            }
        }
        let following: BTreeSet<Addr> =
            guards.values().flat_map(|(_, rules)| rules).flat_map(|rule| self.program.follow(*rule)).collect();
        // Whoever enters another begins before it.
        for &piece in own.iter().filter(|at| !guards.contains_key(at) && !following.contains(at)) {
            let start = self.entered.remove(&piece).unwrap_or_default();
            self.piece(piece, start)?;
        }
        for (rule, known) in after {
            let pieces: Vec<Addr> = self.program.follow(rule).collect();
            for piece in pieces {
                self.piece(piece, known.clone())?;
            }
        }
        for (timer, shows) in std::mem::take(&mut self.timers) {
            self.ground.timer(timer, shows.unwrap_or_default());
        }
        Ok(())
    }

    /// Follows a piece of code along every way; gives what is known where it returns.
    fn piece(&mut self, entry: Addr, start: Known) -> Result<Option<Known>, Unsound> {
        let mut met: BTreeMap<Addr, (Known, u32)> = BTreeMap::new();
        let mut open: BTreeMap<Addr, Known> = BTreeMap::from([(entry, start)]);
        let mut returned: Option<Known> = None;
        self.results.clear();
        while let Some((begin, known)) = open.pop_first() {
            let (mut at, mut known) = (begin, known);
            loop {
                if self.meets.contains(&at) || at == entry {
                    let joined = match met.get(&at) {
                        None => known,
                        Some((before, times)) => {
                            let mut joined = before.join(&known, &self.ground);
                            if *times >= PATIENCE {
                                joined.settle(before, &self.ground);
                            }
                            if *times >= ROUNDS_MAX {
                                joined.widen(before);
                            }
                            if joined == *before {
                                break;
                            }
                            joined
                        }
                    };
                    let times = met.get(&at).map_or(0, |(_, times)| times + 1);
                    met.insert(at, (joined.clone(), times));
                    known = joined;
                }
                let Some(op) = self.program.ops.get(at as usize) else { break };
                if let Op::Compute(Compute::Jump { to, when }) = *op {
                    let mut jumped = known.clone();
                    if self.jumps(when, &mut jumped, true) {
                        let jumped = match open.get(&to) {
                            Some(other) => other.join(&jumped, &self.ground),
                            None => jumped,
                        };
                        open.insert(to, jumped);
                    }
                    if !self.jumps(when, &mut known, false) {
                        break;
                    }
                } else {
                    self.execute(entry, at, op, &mut known)?;
                    for (slot, word) in self.typed.get(&at).into_iter().flatten() {
                        let word = Word { is_whole: word.is_whole, ..known.word(&self.ground, *slot) }
                            .and(word.range)
                            .unwrap_or(*word);
                        let implications = known.implications(&self.ground, *slot);
                        known.set(&self.ground, *slot, word, implications);
                    }
                    if matches!(op, Op::Return | Op::End | Op::Finish | Op::Abort { .. }) {
                        self.keeps_claims(at, &known)?;
                        returned = Some(match returned {
                            Some(other) => other.join(&known, &self.ground),
                            None => known,
                        });
                        break;
                    }
                }
                at += 1;
            }
        }
        Ok(returned)
    }

    /// What a jump implies when it is taken, or not; false where it cannot be.
    fn jumps(&self, when: When, known: &mut Known, taken: bool) -> bool {
        match when {
            When::Always => taken,
            When::True(word) => known.assume(&self.ground, word, taken),
            When::False(word) => known.assume(&self.ground, word, !taken),
            When::Less(a, b) => self.compared(known, a, b, true, taken),
            When::NotLess(a, b) => self.compared(known, a, b, true, !taken),
            When::AtMost(a, b) => self.compared(known, a, b, false, taken),
            When::NotAtMost(a, b) => self.compared(known, a, b, false, !taken),
        }
    }

    fn compared(&self, known: &mut Known, a: Slot, b: Slot, strict: bool, holds: bool) -> bool {
        self.comparison(known, a, b, strict, holds).into_iter().all(|(of, range)| known.learn(&self.ground, of, range))
    }

    /// What is known when `a < b`, or `a <= b`, holds, or does not.
    pub(super) fn comparison(
        &self,
        known: &Known,
        a: Slot,
        b: Slot,
        strict: bool,
        holds: bool,
    ) -> [(Slot, Interval); 2] {
        let (low, high) = if holds { (a, b) } else { (b, a) };
        let strict = strict == holds;
        let (lower, higher) = (known.word(&self.ground, low), known.word(&self.ground, high));
        let up = match (strict, higher.is_whole) {
            (true, true) => lower.range.low.floor() + 1.0,
            (true, false) => lower.range.low.next_up(),
            (false, _) => lower.range.low,
        };
        let down = match (strict, lower.is_whole) {
            (true, true) => higher.range.high.ceil() - 1.0,
            (true, false) => higher.range.high.next_down(),
            (false, _) => higher.range.high,
        };
        [(high, Interval::at_least(up)), (low, Interval::at_most(down))]
    }

    /// Everything that others could read is as it is claimed.
    pub(super) fn keeps_claims(&self, at: Addr, known: &Known) -> Result<(), Unsound> {
        if !self.holds_to_it {
            return Ok(());
        }
        for claim in &self.unit.claims {
            let is_written = known.is_tracked(claim.slot) || claim.present.is_some_and(|flag| known.is_tracked(flag));
            if is_written && !self.keeps(known, claim.slot, claim.present, claim.range) {
                return Err(Unsound { at, why: "a variable may be outside the range that is claimed of it" });
            }
        }
        Ok(())
    }

    fn keeps(&self, known: &Known, slot: Slot, present: Option<Slot>, claimed: Interval) -> bool {
        match present {
            Some(flag) => known.range_where(&self.ground, slot, flag).is_none_or(|range| claimed.covers(range)),
            None => claimed.covers(known.range(&self.ground, slot)),
        }
    }

    /// What is called has its arguments as it claims them.
    pub(super) fn arguments(
        &self,
        at: Addr,
        known: &Known,
        code: Addr,
        base: Slot,
    ) -> Result<Option<&'p Unit>, Unsound> {
        let called = self.claims.units.iter().find(|unit| unit.code.contains(&code));
        let Some(called) = called.filter(|called| called.code != self.unit.code) else { return Ok(None) };
        for claim in called.claims.iter().filter(|claim| claim.is_param && self.holds_to_it) {
            let present = claim.present.map(|flag| base.saturating_add(flag));
            if !self.keeps(known, base.saturating_add(claim.slot), present, claim.range) {
                return Err(Unsound { at, why: "an argument may be outside the range of its parameter" });
            }
        }
        Ok(Some(called))
    }

    pub(super) fn called(&self, call: u32) -> Option<(&Activity, Slot)> {
        let site = self.program.calls.get(call as usize)?;
        Some((self.program.activities.get(site.activity as usize)?, site.base))
    }

    /// An override's block, which shares the frame, begins in the same tick, with what is known where it is entered.
    pub(super) fn enter(&mut self, block: Addr, known: &Known) {
        let known = match self.entered.get(&block) {
            Some(other) => other.join(known, &self.ground),
            None => known.clone(),
        };
        self.entered.insert(block, known);
    }

    /// What is called runs: its frame is its own, and what others of this unit write may be written.
    pub(super) fn runs(&self, entry: Addr, at: Addr, known: &mut Known, code: Addr, base: Slot) -> Result<(), Unsound> {
        self.keeps_claims(at, known)?;
        match self.claims.units.iter().find(|unit| unit.code.contains(&code)) {
            Some(called) if called.code != self.unit.code => {
                let frame = base..base.saturating_add(called.words);
                known.grounded(|slot| frame.contains(&slot));
            }
            _ => self.time_passes(entry, known),
        }
        Ok(())
    }

    /// Other code may run: what it writes is as claimed, and samples may come.
    pub(super) fn time_passes(&self, entry: Addr, known: &mut Known) {
        let is_foreign = |slot: Slot| match self.writers.get(slot as usize) {
            Some(Writer::One(piece)) => *piece != entry,
            Some(Writer::Several) => true,
            Some(Writer::Nobody) | None => false,
        };
        known.grounded(|slot| slot & ABSOLUTE != 0 || is_foreign(slot));
    }
}

/// Rows of words in their order, those that touch made one.
fn merged(mut rows: Vec<(Slot, u32)>) -> Vec<(Slot, u32)> {
    rows.sort_unstable();
    let mut merged: Vec<(Slot, u32)> = Vec::new();
    for (from, words) in rows {
        match merged.last_mut() {
            Some((begin, length)) if from <= begin.saturating_add(*length) => {
                *length = (*length).max(from.saturating_add(words) - *begin);
            }
            _ => merged.push((from, words)),
        }
    }
    merged
}
