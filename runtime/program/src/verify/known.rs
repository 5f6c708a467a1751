//! What is known of words at one place in the code.

use super::claims::{Claim, Claims, Unit};
use crate::{ABSOLUTE, Program, Slot};
use albacore_arithmetic::{INT_MAX, Interval, LARGEST};
use std::collections::BTreeMap;

/// What is known of a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word {
    pub range: Interval,
    pub is_whole: bool,
}

impl Word {
    pub const ANY: Word = Word { range: Interval::ANY, is_whole: false };
    pub const TRUTH: Word = Word { range: Interval { low: 0.0, high: 1.0, least: 0.0 }, is_whole: true };

    pub fn of(range: Interval) -> Self {
        Word { range, is_whole: false }
    }

    pub fn exactly(value: f64) -> Self {
        Word { range: Interval::exactly(value), is_whole: value.fract() == 0.0 && value.abs() <= INT_MAX }
    }

    /// The same where it is among other values too; none where it cannot be.
    pub fn and(self, range: Interval) -> Option<Self> {
        let mut both = self.range.and(range);
        if self.is_whole {
            let least = both.least.ceil();
            both = Interval::new(both.low.ceil(), both.high.floor()).without_below(least);
        }
        (both.low <= both.high).then_some(Word { range: both, ..self })
    }

    pub fn or(self, other: Word) -> Self {
        Word { range: self.range.or(other.range), is_whole: self.is_whole && other.is_whole }
    }

    pub fn is_zero(self) -> bool {
        self.range.constant() == Some(0.0)
    }
}

/// What is known of other words when a word is not 0, and when it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Implications {
    pub when: Vec<(Slot, Interval)>,
    pub unless: Vec<(Slot, Interval)>,
}

impl Implications {
    fn mentions(&self, slot: Slot) -> bool {
        self.when.iter().chain(&self.unless).any(|(of, _)| *of == slot)
    }

    fn forget(&mut self, is_gone: impl Fn(Slot) -> bool) {
        self.when.retain(|(of, _)| !is_gone(*of));
        self.unless.retain(|(of, _)| !is_gone(*of));
    }
}

/// What holds at the beginning of every piece of code of a unit.
pub(super) struct Ground<'p> {
    program: &'p Program,
    input_words: u32,
    words: BTreeMap<Slot, Claim>,
    /// What claims and timers tell.
    implications: BTreeMap<Slot, Implications>,
}

impl<'p> Ground<'p> {
    pub fn new(program: &'p Program, claims: &Claims, unit: &Unit) -> Self {
        let input_words = program.inputs.iter().map(crate::Input::words).sum();
        let mut ground = Ground { program, input_words, words: BTreeMap::new(), implications: BTreeMap::new() };
        for claim in claims.inputs.iter().chain(&unit.claims) {
            ground.words.insert(claim.slot, *claim);
            if let Some(flag) = claim.present {
                ground.implications.entry(flag).or_default().when.push((claim.slot, claim.range));
            }
        }
        ground
    }

    /// What a timer shows when it is true.
    pub fn timer(&mut self, timer: Slot, shows: Vec<(Slot, Interval)>) {
        self.implications.entry(timer).or_default().when = shows;
    }

    fn word(&self, slot: Slot) -> Word {
        if slot & ABSOLUTE != 0 {
            let index = (slot & !ABSOLUTE).checked_sub(self.input_words);
            if let Some(value) = index.and_then(|index| self.program.constants.get(index as usize)) {
                return Word::exactly(*value);
            }
        }
        match self.words.get(&slot) {
            Some(claim) if claim.present.is_none() => Word { range: claim.range, is_whole: claim.is_whole },
            Some(claim) => Word { is_whole: claim.is_whole, ..Word::ANY },
            None => Word::ANY,
        }
    }
}

/// What is known at one place, beyond what the ground says.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Known {
    words: BTreeMap<Slot, Word>,
    implications: BTreeMap<Slot, Implications>,
}

/// So many words at most are compared for what a word that differs tells of them.
const COMPARED_MAX: usize = 64;

impl Known {
    pub fn word(&self, ground: &Ground, slot: Slot) -> Word {
        self.words.get(&slot).copied().unwrap_or_else(|| ground.word(slot))
    }

    pub fn range(&self, ground: &Ground, slot: Slot) -> Interval {
        self.word(ground, slot).range
    }

    pub fn implications(&self, ground: &Ground, slot: Slot) -> Implications {
        self.implications.get(&slot).or_else(|| ground.implications.get(&slot)).cloned().unwrap_or_default()
    }

    /// Words that are more, or other, than the ground says.
    pub fn is_tracked(&self, slot: Slot) -> bool {
        self.words.contains_key(&slot)
    }

    /// A word is written.
    pub fn set(&mut self, ground: &Ground, slot: Slot, word: Word, implications: Implications) {
        self.forget(ground, slot, 1);
        self.words.insert(slot, word);
        if implications != Implications::default() {
            self.implications.insert(slot, implications);
        }
    }

    /// Words are written of which nothing is known.
    pub fn forget(&mut self, ground: &Ground, from: Slot, words: u32) {
        let to = from.saturating_add(words);
        let is_gone = |slot: Slot| (from..to).contains(&slot);
        self.drop_words(is_gone, from, to);
        for (slot, claim) in ground.words.range(from..to) {
            self.words.insert(*slot, Word { is_whole: claim.is_whole, ..Word::ANY });
        }
        for (flag, implications) in &ground.implications {
            let touched =
                is_gone(*flag) || (from..to).len() < COMPARED_MAX && (from..to).any(|slot| implications.mentions(slot));
            if touched && !self.implications.contains_key(flag) {
                let mut left = if is_gone(*flag) { Implications::default() } else { implications.clone() };
                left.forget(is_gone);
                self.implications.insert(*flag, left);
            }
        }
    }

    fn drop_words(&mut self, is_gone: impl Fn(Slot) -> bool + Copy, from: Slot, to: Slot) {
        let gone: Vec<Slot> = self.words.range(from..to).map(|(slot, _)| *slot).collect();
        gone.into_iter().for_each(|slot| _ = self.words.remove(&slot));
        self.implications.retain(|slot, implications| {
            implications.forget(is_gone);
            !is_gone(*slot)
        });
    }

    /// Words that are as the ground says again: others may have written them, and have kept to it.
    pub fn grounded(&mut self, is_grounded: impl Fn(Slot) -> bool) {
        self.words.retain(|slot, _| !is_grounded(*slot));
        self.implications.retain(|slot, implications| {
            implications.forget(&is_grounded);
            !is_grounded(*slot)
        });
    }

    /// Words of a list of unknown length.
    pub fn forget_from(&mut self, ground: &Ground, from: Slot) {
        self.grounded(|slot| slot >= from && slot & ABSOLUTE == 0 && !ground.words.contains_key(&slot));
    }

    /// Copies words with all that is known of them.
    pub fn copy(&mut self, ground: &Ground, from: Slot, to: Slot, words: u32) {
        let end = from.saturating_add(words);
        let slots = self.words.range(from..end).map(|(slot, _)| *slot);
        let mut slots: Vec<Slot> = slots.chain(ground.words.range(from..end).map(|(slot, _)| *slot)).collect();
        if words <= 2 {
            slots.extend(from..end);
        }
        slots.extend(self.implications.range(from..end).map(|(slot, _)| *slot));
        slots.sort_unstable();
        slots.dedup();
        let moved = |slot: Slot| if (from..end).contains(&slot) { slot - from + to } else { slot };
        let copied: Vec<(Slot, Word, Implications)> = slots
            .into_iter()
            .map(|slot| {
                let mut implications = self.implications(ground, slot);
                implications.when.iter_mut().chain(&mut implications.unless).for_each(|(of, _)| *of = moved(*of));
                (moved(slot), self.word(ground, slot), implications)
            })
            .collect();
        self.forget(ground, to, words);
        for (slot, word, _) in &copied {
            self.words.insert(*slot, *word);
        }
        for (slot, _, mut implications) in copied {
            // What was copied over is known no more; what was copied is known where it is now.
            implications.forget(|of| (to..to.saturating_add(words)).contains(&of) && !self.words.contains_key(&of));
            self.implications.insert(slot, implications);
        }
    }

    /// A word is among some values; false where it cannot be.
    #[must_use]
    pub fn learn(&mut self, ground: &Ground, slot: Slot, range: Interval) -> bool {
        let Some(word) = self.word(ground, slot).and(range) else { return false };
        self.words.insert(slot, word);
        true
    }

    /// A word is not 0, or it is; false where that cannot be.
    #[must_use]
    pub fn assume(&mut self, ground: &Ground, slot: Slot, holds: bool) -> bool {
        let implications = self.implications(ground, slot);
        let (range, implied) =
            if holds { (Interval::NOT_ZERO, implications.when) } else { (Interval::exactly(0.0), implications.unless) };
        self.learn(ground, slot, range) && implied.into_iter().all(|(of, range)| self.learn(ground, of, range))
    }

    /// The values of a word where another is not 0; none where that cannot be.
    pub fn range_where(&self, ground: &Ground, slot: Slot, flag: Slot) -> Option<Interval> {
        self.word(ground, flag).and(Interval::NOT_ZERO)?;
        let mut word = self.word(ground, slot);
        for (of, range) in self.implications(ground, flag).when {
            let known = if of == slot { &mut word } else { &mut self.word(ground, of) };
            *known = known.and(range)?;
        }
        Some(word.range)
    }

    /// What is known where two ways meet. Where a word differs between them, its value tells which way was gone.
    pub fn join(&self, other: &Known, ground: &Ground) -> Known {
        let mut joined = Known::default();
        let mut slots: Vec<Slot> = self.words.keys().chain(other.words.keys()).copied().collect();
        slots.sort_unstable();
        slots.dedup();
        let mut differing = Vec::new();
        let mut deciding: Vec<Slot> = self.implications.keys().chain(other.implications.keys()).copied().collect();
        for slot in slots {
            let (a, b) = (self.word(ground, slot), other.word(ground, slot));
            joined.words.insert(slot, a.or(b));
            if a != b {
                differing.push(slot);
            }
            if a.is_zero() != b.is_zero() && (a.range.excludes_zero() || b.range.excludes_zero())
                || a.is_zero() != b.is_zero() && (a.range.high <= 1.0 && b.range.high <= 1.0)
            {
                deciding.push(slot);
            }
        }
        differing.truncate(COMPARED_MAX);
        deciding.sort_unstable();
        deciding.dedup();
        for slot in deciding {
            let implications = Implications {
                when: self.implied(other, ground, &joined, slot, true, &differing),
                unless: self.implied(other, ground, &joined, slot, false, &differing),
            };
            joined.implications.insert(slot, implications);
        }
        joined
    }

    /// What a word tells of others where two ways meet, when it holds or when it does not.
    fn implied(
        &self,
        other: &Known,
        ground: &Ground,
        joined: &Known,
        slot: Slot,
        holds: bool,
        differing: &[Slot],
    ) -> Vec<(Slot, Interval)> {
        let ways: Vec<(&Known, Vec<(Slot, Interval)>)> = [self, other]
            .into_iter()
            .filter(|way| {
                let range = way.range(ground, slot);
                if holds { range.constant() != Some(0.0) } else { !range.excludes_zero() }
            })
            .map(|way| {
                let implications = way.implications(ground, slot);
                (way, if holds { implications.when } else { implications.unless })
            })
            .collect();
        let mut of: Vec<Slot> = ways.iter().flat_map(|(_, implied)| implied.iter().map(|(of, _)| *of)).collect();
        if ways.len() == 1 {
            of.extend(differing);
        }
        of.sort_unstable();
        of.dedup();
        of.into_iter()
            .filter_map(|of| {
                let range = ways
                    .iter()
                    .map(|(way, implied)| {
                        let range = way.range(ground, of);
                        implied
                            .iter()
                            .filter(|(slot, _)| *slot == of)
                            .fold(range, |range, (_, implied)| range.and(*implied))
                    })
                    .reduce(Interval::or)?;
                (range != joined.range(ground, of)).then_some((of, range))
            })
            .collect()
    }

    /// Words that are more than they were at this place before are taken to grow to the next of a few bounds.
    pub fn widen(&mut self, before: &Known) {
        for (slot, word) in &mut self.words {
            if let Some(was) = before.words.get(slot).filter(|was| was.range != word.range) {
                word.range = widened(word.range, was.range);
            }
        }
    }

    /// What is told that differs from what was told at this place before is told no more, so that an end is found.
    pub fn settle(&mut self, before: &Known) {
        for (slot, implications) in &mut self.implications {
            let told = before.implications.get(slot).cloned().unwrap_or_default();
            implications.when.retain(|implied| told.when.contains(implied));
            implications.unless.retain(|implied| told.unless.contains(implied));
        }
    }
}

/// A result that grows from round to round is taken to grow to the next of a few bounds.
pub(super) fn widened(range: Interval, was: Interval) -> Interval {
    const BOUNDS: [f64; 5] = [0.0, 1.0, 1e6, INT_MAX, LARGEST];
    let up = |x: f64| BOUNDS.into_iter().find(|bound| x <= *bound).unwrap_or(LARGEST);
    let down = |x: f64| BOUNDS.into_iter().rev().find(|bound| x >= *bound).unwrap_or(0.0);
    let both = range.or(was);
    let low = match both.low < was.low {
        true if both.low >= 0.0 => down(both.low),
        true => -up(-both.low),
        false => both.low,
    };
    let high = match both.high > was.high {
        true if both.high <= 0.0 => -down(-both.high),
        true => up(both.high),
        false => both.high,
    };
    let least = if both.least < was.least { down(both.least) } else { both.least };
    Interval::new(low, high).without_below(least)
}
