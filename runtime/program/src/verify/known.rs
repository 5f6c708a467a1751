//! What is known of words at one place in the code.

use super::claims::{Claim, Claims, Unit};
use super::slots::{Slots, of_both};
use crate::{ABSOLUTE, Program, Slot};
use albacore_arithmetic::{INT_MAX, Interval, LARGEST};
use std::ops::Range;
use std::rc::Rc;

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
    fn mentions(&self, is_it: impl Fn(Slot) -> bool) -> bool {
        self.when.iter().chain(&self.unless).any(|(of, _)| is_it(*of))
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
    words: Slots<Claim>,
    /// What claims and timers tell.
    implications: Slots<Rc<Implications>>,
    /// What nothing is known of.
    nothing: Rc<Implications>,
}

impl<'p> Ground<'p> {
    pub fn new(program: &'p Program, claims: &Claims, unit: &Unit) -> Self {
        let input_words = program.inputs.iter().map(crate::Input::words).sum();
        let mut ground = Ground {
            program,
            input_words,
            words: Slots::default(),
            implications: Slots::default(),
            nothing: Rc::default(),
        };
        for claim in claims.inputs.iter().chain(&unit.claims) {
            ground.words.insert(claim.slot, *claim);
            if let Some(flag) = claim.present {
                ground.tell(flag, |told| told.push((claim.slot, claim.range)));
            }
        }
        ground
    }

    /// Changes what a word tells when it is true.
    fn tell(&mut self, flag: Slot, change: impl FnOnce(&mut Vec<(Slot, Interval)>)) {
        let mut told = self.implications.get(flag).map_or_else(Implications::default, |told| (**told).clone());
        change(&mut told.when);
        self.implications.insert(flag, Rc::new(told));
    }

    /// What a word tells of which nothing is known.
    pub fn nothing(&self) -> Rc<Implications> {
        Rc::clone(&self.nothing)
    }

    /// What a timer shows when it is true.
    pub fn timer(&mut self, timer: Slot, shows: Vec<(Slot, Interval)>) {
        self.tell(timer, |told| *told = shows);
    }

    fn word(&self, slot: Slot) -> Word {
        if slot & ABSOLUTE != 0 {
            let index = (slot & !ABSOLUTE).checked_sub(self.input_words);
            if let Some(value) = index.and_then(|index| self.program.constants.get(index as usize)) {
                return Word::exactly(*value);
            }
        }
        match self.words.get(slot) {
            Some(claim) if claim.present.is_none() => Word { range: claim.range, is_whole: claim.is_whole },
            Some(claim) => Word { is_whole: claim.is_whole, ..Word::ANY },
            None => Word::ANY,
        }
    }
}

/// What is known at one place, beyond what the ground says.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Known {
    words: Slots<Word>,
    implications: Slots<Rc<Implications>>,
}

/// So many words at most are compared for what a word that differs tells of them.
const COMPARED_MAX: usize = 64;

impl Known {
    pub fn word(&self, ground: &Ground, slot: Slot) -> Word {
        self.words.get(slot).copied().unwrap_or_else(|| ground.word(slot))
    }

    pub fn range(&self, ground: &Ground, slot: Slot) -> Interval {
        self.word(ground, slot).range
    }

    pub fn implications(&self, ground: &Ground, slot: Slot) -> Rc<Implications> {
        let told = self.implications.get(slot).or_else(|| ground.implications.get(slot));
        Rc::clone(told.unwrap_or(&ground.nothing))
    }

    /// Words that are more, or other, than the ground says.
    pub fn is_tracked(&self, slot: Slot) -> bool {
        self.words.contains(slot)
    }

    /// A word is written.
    pub fn set(&mut self, ground: &Ground, slot: Slot, word: Word, implications: Rc<Implications>) {
        self.forget(ground, slot, 1);
        self.words.insert(slot, word);
        if *implications != Implications::default() {
            self.implications.insert(slot, implications);
        }
    }

    /// Words are written of which nothing is known.
    pub fn forget(&mut self, ground: &Ground, from: Slot, words: u32) {
        let gone = from..from.saturating_add(words);
        self.words.remove(gone.clone());
        self.forget_implications(|slot| gone.contains(&slot));
        for (slot, claim) in ground.words.range(gone.clone()) {
            self.words.insert(*slot, Word { is_whole: claim.is_whole, ..Word::ANY });
        }
        for (flag, implications) in ground.implications.iter() {
            let is_gone = |slot: Slot| gone.contains(&slot);
            let touched = is_gone(*flag) || gone.len() < COMPARED_MAX && implications.mentions(is_gone);
            if touched && !self.implications.contains(*flag) {
                let mut left = if is_gone(*flag) { Implications::default() } else { (**implications).clone() };
                left.forget(is_gone);
                self.implications.insert(*flag, Rc::new(left));
            }
        }
    }

    /// What words tell that are gone, and what others tell of them, is not known any more.
    fn forget_implications(&mut self, is_gone: impl Fn(Slot) -> bool) {
        self.implications.retain(|slot, implications| {
            if is_gone(slot) {
                return false;
            }
            if implications.mentions(&is_gone) {
                Rc::make_mut(implications).forget(&is_gone);
            }
            true
        });
    }

    /// Words that are as the ground says again: others may have written them, and have kept to it.
    pub fn grounded(&mut self, is_grounded: impl Fn(Slot) -> bool) {
        self.words.retain(|slot, _| !is_grounded(slot));
        self.forget_implications(is_grounded);
    }

    /// Words of a list of unknown length.
    pub fn forget_from(&mut self, ground: &Ground, from: Slot) {
        self.grounded(|slot| slot >= from && slot & ABSOLUTE == 0 && !ground.words.contains(slot));
    }

    /// Copies words with all that is known of them.
    pub fn copy(&mut self, ground: &Ground, from: Slot, to: Slot, words: u32) {
        let range: Range<Slot> = from..from.saturating_add(words);
        let mut slots: Vec<Slot> = self.words.range(range.clone()).iter().map(|(slot, _)| *slot).collect();
        slots.extend(ground.words.range(range.clone()).iter().map(|(slot, _)| *slot));
        if words <= 2 {
            slots.extend(range.clone());
        }
        for implications in [&self.implications, &ground.implications] {
            slots.extend(implications.range(range.clone()).iter().map(|(slot, _)| *slot));
        }
        slots.sort_unstable();
        slots.dedup();
        let moved = |slot: Slot| if range.contains(&slot) { slot - from + to } else { slot };
        let copied: Vec<(Slot, Word, Rc<Implications>)> = slots
            .into_iter()
            .map(|slot| {
                let mut implications = self.implications(ground, slot);
                if implications.mentions(|of| range.contains(&of)) {
                    let told = Rc::make_mut(&mut implications);
                    told.when.iter_mut().chain(&mut told.unless).for_each(|(of, _)| *of = moved(*of));
                }
                (moved(slot), self.word(ground, slot), implications)
            })
            .collect();
        self.forget(ground, to, words);
        for (slot, word, _) in &copied {
            self.words.insert(*slot, *word);
        }
        for (slot, _, mut implications) in copied {
            // What was copied over is known no more; what was copied is known where it is now.
            let is_gone = |of: Slot| (to..to.saturating_add(words)).contains(&of) && !self.words.contains(of);
            if implications.mentions(is_gone) {
                Rc::make_mut(&mut implications).forget(is_gone);
            }
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
        let (range, implied) = match holds {
            true => (Interval::NOT_ZERO, &implications.when),
            false => (Interval::exactly(0.0), &implications.unless),
        };
        self.learn(ground, slot, range) && implied.iter().all(|(of, range)| self.learn(ground, *of, *range))
    }

    /// The values of a word where another is not 0; none where that cannot be.
    pub fn range_where(&self, ground: &Ground, slot: Slot, flag: Slot) -> Option<Interval> {
        self.word(ground, flag).and(Interval::NOT_ZERO)?;
        let mut word = self.word(ground, slot);
        for (of, range) in &self.implications(ground, flag).when {
            let known = if *of == slot { &mut word } else { &mut self.word(ground, *of) };
            *known = known.and(*range)?;
        }
        Some(word.range)
    }

    /// What is known where two ways meet. Where a word differs between them, its value tells which way was gone.
    pub fn join(&self, other: &Known, ground: &Ground) -> Known {
        let mut joined = Known::default();
        let mut differing = Vec::new();
        let mut deciding = of_both(&self.implications, &other.implications);
        for slot in of_both(&self.words, &other.words) {
            let (a, b) = (self.word(ground, slot), other.word(ground, slot));
            joined.words.push(slot, a.or(b));
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
            joined.implications.push(slot, Rc::new(implications));
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
        let told = [self, other].map(|way| way.implications(ground, slot));
        let ways: Vec<(&Known, &[(Slot, Interval)])> = [self, other]
            .into_iter()
            .zip(&told)
            .filter(|(way, _)| {
                let range = way.range(ground, slot);
                if holds { range.constant() != Some(0.0) } else { !range.excludes_zero() }
            })
            .map(|(way, told)| (way, if holds { told.when.as_slice() } else { &told.unless }))
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
        for (slot, word) in self.words.iter_mut() {
            if let Some(was) = before.words.get(*slot).filter(|was| was.range != word.range) {
                word.range = widened(word.range, was.range);
            }
        }
    }

    /// What is told that is more than was told at this place before grows at once as far as whole numbers go, or without end, so that an end is found. What went without saying
    /// there, because a word was known by itself or the other could not be so, may be told now.
    pub fn settle(&mut self, before: &Known, ground: &Ground) {
        for (slot, implications) in self.implications.iter_mut() {
            let told = before.implications(ground, *slot);
            let flag = before.range(ground, *slot);
            let implications = Rc::make_mut(implications);
            let settled = |now: &mut Vec<(Slot, Interval)>, told: &[(Slot, Interval)]| {
                for (of, range) in now.iter_mut() {
                    let known = told.iter().filter(|(other, _)| other == of);
                    let was = known.fold(before.range(ground, *of), |was, (_, range)| was.and(*range));
                    *range = if was == *range { *range } else { grown(*range, was) };
                }
            };
            if flag.constant() != Some(0.0) {
                settled(&mut implications.when, &told.when);
            }
            if !flag.excludes_zero() {
                settled(&mut implications.unless, &told.unless);
            }
        }
    }
}

/// Where a range grows it reaches as far as whole numbers do, or without end.
fn grown(range: Interval, was: Interval) -> Interval {
    let far = |x: f64| if x <= INT_MAX { INT_MAX } else { LARGEST };
    let both = range.or(was);
    let low = if both.low >= was.low { both.low } else { -far(-both.low) };
    let high = if both.high <= was.high { both.high } else { far(both.high) };
    Interval::new(low, high)
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
