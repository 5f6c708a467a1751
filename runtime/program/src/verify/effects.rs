//! What one instruction makes of what is known.

use super::Unsound;
use super::known::{Implications, Known, Word, widened};
use super::ranges::{PATIENCE, Ranges};
use super::written::written;
use crate::{ABSOLUTE, Addr, GUIDANCE_WORDS, Guide, Op, Param, Slot};
use albacore_arithmetic::{Div, Interval, Operation, Operator, Pow, Sqrt, Ticks, counted};
use albacore_geometry::AREA_WIDTH_MIN_M;

impl Ranges<'_> {
    /// One instruction that does not jump.
    pub(super) fn execute(&mut self, entry: Addr, at: Addr, op: &Op, known: &mut Known) -> Result<(), Unsound> {
        let unsound = |why| Unsound { at, why };
        let must = |holds: bool, why| if holds || !self.holds_to_it { Ok(()) } else { Err(unsound(why)) };
        let range = |known: &Known, slot: Slot| known.range(&self.ground, slot);
        let nothing = Implications::default;
        match *op {
            Op::Div { b, .. } => must(Div::is_defined([Interval::ANY, range(known, b)]), "it may divide by zero")?,
            Op::Sqrt { a, .. } => {
                must(Sqrt::is_defined([range(known, a)]), "it may take the root of a negative number")?
            }
            Op::Pow { a, b, .. } => {
                must(Pow::is_defined([range(known, a), range(known, b)]), "a power may have no value")?;
            }
            Op::Ticks { a, .. } => must(Ticks::is_defined([range(known, a)]), "a time may be negative")?,
            Op::Rectangle { length, width, .. } => {
                let has_size = [length, width].iter().all(|side| range(known, *side).low >= AREA_WIDTH_MIN_M);
                must(has_size, "a rectangle may be too thin")?;
            }
            Op::Rows { step, .. } => must(range(known, step).low > 0.0, "rows may lie no distance apart")?,
            Op::Begin { guide, args, .. } => {
                let is_admitted = |(at, param): (u32, &Param)| param.admits(range(known, args + at));
                must(guide.law().placed_params().all(is_admitted), "an argument of guidance may be outside its range")?;
            }
            _ => {}
        }
        match *op {
            Op::Const { to, value } => known.set(&self.ground, to, Word::exactly(value), nothing()),
            Op::Copy { to, from } => known.copy(&self.ground, from, to, 1),
            Op::CopyMany { to, from, words } => known.copy(&self.ground, from, to, words),
            Op::Clear { to, words } => {
                known.forget(&self.ground, to, words);
                known.set(&self.ground, to, Word::exactly(0.0), nothing());
            }
            Op::Quotient { to, a, b } => {
                let (a, b) = (range(known, a), range(known, b));
                known.forget(&self.ground, to, 2);
                if Div::is_defined([a, b]) {
                    known.set(&self.ground, to, Word::exactly(1.0), nothing());
                    known.set(&self.ground, to + 1, Word::of(Div::rule([a, b])), nothing());
                } else {
                    let quotient = Div::rule([a, b.and(Interval::NOT_ZERO)]);
                    known.set(&self.ground, to + 1, Word::of(quotient.or(Interval::exactly(0.0))), nothing());
                    let implications = Implications { when: vec![(to + 1, quotient)], unless: Vec::new() };
                    known.set(&self.ground, to, Word::TRUTH, implications);
                }
            }
            Op::Lt { to, a, b } | Op::Le { to, a, b } => {
                let strict = matches!(op, Op::Lt { .. });
                let implied = |holds| self.comparison(known, a, b, strict, holds).to_vec();
                let implications = Implications { when: implied(true), unless: implied(false) };
                known.set(&self.ground, to, Word::TRUTH, without(implications, to));
            }
            Op::Eq { to, a, b, words: 1 } => {
                let (left, right) = (range(known, a), range(known, b));
                let not_zero =
                    |of, other: Interval| (other.constant() == Some(0.0)).then_some((of, Interval::NOT_ZERO));
                let unless = [not_zero(a, right), not_zero(b, left)].into_iter().flatten().collect();
                let implications = Implications { when: vec![(a, right), (b, left)], unless };
                known.set(&self.ground, to, Word::TRUTH, without(implications, to));
            }
            Op::Not { to, a } => {
                let Implications { when, unless } = known.implications(&self.ground, a);
                known.set(&self.ground, to, Word::TRUTH, without(Implications { when: unless, unless: when }, to));
            }
            Op::And { to, a, b } | Op::Or { to, a, b } => {
                let (mut left, right) = (known.implications(&self.ground, a), known.implications(&self.ground, b));
                left.when.extend(right.when);
                left.unless.extend(right.unless);
                match op {
                    Op::And { .. } => left.unless.clear(),
                    _ => left.when.clear(),
                }
                known.set(&self.ground, to, Word::TRUTH, without(left, to));
            }
            Op::Age { to, .. } => {
                known.set(&self.ground, to, Word::of(Operator::Age.rule(&[])), nothing());
            }
            Op::Hits { to, of, .. } => {
                known.set(&self.ground, to, Word { range: counted(of), is_whole: true }, nothing());
            }
            Op::HeldFor { to, x, since, .. } => {
                self.shown(to, known.implications(&self.ground, x).when);
                known.forget(&self.ground, since, 1);
                self.timer(known, to);
            }
            Op::Becomes { to, x, before } => {
                self.shown(to, known.implications(&self.ground, x).when);
                known.set(&self.ground, before, Word::TRUTH, nothing());
                self.timer(known, to);
            }
            Op::Elapsed { to, .. } => known.set(&self.ground, to, Word::TRUTH, nothing()),
            Op::At { to, list, words, .. } => {
                let element = self.element(known, list, words);
                known.forget(&self.ground, to, words.saturating_add(1));
                known.set(&self.ground, to, Word::TRUTH, nothing());
                for (slot, word) in (to.saturating_add(1)..).zip(element) {
                    known.set(&self.ground, slot, word, nothing());
                }
            }
            Op::Sort { .. } | Op::PushSorted { .. } | Op::Remove { .. } | Op::Push { .. } | Op::Top { .. } => {
                self.list_changes(op, known);
            }
            Op::Call { code, base } => match self.arguments(at, known, code, base)? {
                Some(_) => self.runs(entry, at, known, code, base)?,
                None => self.writes(code).into_iter().for_each(|(slot, words)| self.forget(known, slot, words)),
            },
            Op::Enter { call } => {
                if let Some((activity, base)) = self.called(call) {
                    self.arguments(at, known, activity.entry, base)?;
                    self.runs(entry, at, known, activity.entry, base)?;
                }
            }
            Op::Step { call, ended } => {
                if let Some((activity, base)) = self.called(call) {
                    self.runs(entry, at, known, activity.entry, base)?;
                }
                known.set(&self.ground, ended, Word::TRUTH, nothing());
            }
            Op::Cut { call, .. } => {
                if let Some((activity, base)) = self.called(call) {
                    self.runs(entry, at, known, activity.entry, base)?;
                }
            }
            Op::PutOn { overlay } => {
                if let Some(site) = self.program.overlays.get(overlay as usize)
                    && let Some(activity) = self.program.activities.get(site.activity as usize)
                {
                    self.arguments(at, known, activity.entry, site.base)?;
                    self.runs(entry, at, known, activity.entry, site.base)?;
                }
            }
            Op::Yield => {
                self.keeps_claims(at, known)?;
                self.time_passes(entry, known);
            }
            Op::Begin { state, .. } => known.forget(&self.ground, state, GUIDANCE_WORDS),
            Op::Guide { guide, state, ended, .. } => {
                let words = if guide == Guide::Keep { 1 } else { GUIDANCE_WORDS };
                known.forget(&self.ground, state, words);
                known.set(&self.ground, ended, Word::TRUTH, nothing());
            }
            _ => self.computed(at, op, known),
        }
        Ok(())
    }

    fn timer(&self, known: &mut Known, to: Slot) {
        known.forget(&self.ground, to, 1);
        // What it shows is known of the ground, where it has been seen.
        known.grounded(|slot| slot == to);
    }

    /// What a timer shows when it is true: as much as whatever updates it.
    fn shown(&mut self, timer: Slot, mut shows: Vec<(Slot, Interval)>) {
        let stands = |slot: Slot| self.unit.standing.iter().any(|(at, words)| slot >= *at && slot - at < *words);
        shows.retain(|(of, _)| of & ABSOLUTE != 0 || stands(*of));
        let known = self.timers.entry(timer).or_insert_with(|| Some(shows.clone()));
        if let Some(known) = known {
            known.retain_mut(|(of, range)| match shows.iter().find(|(other, _)| other == of) {
                Some((_, other)) => {
                    *range = range.or(*other);
                    true
                }
                None => false,
            });
        }
    }

    fn forget(&self, known: &mut Known, slot: Slot, words: u32) {
        if slot.saturating_add(words) >= ABSOLUTE {
            known.forget_from(&self.ground, slot);
        } else {
            known.forget(&self.ground, slot, words);
        }
    }

    fn list_changes(&self, op: &Op, known: &mut Known) {
        let count = |known: &Known, list| known.range(&self.ground, list).high.clamp(0.0, f64::from(u32::MAX));
        let (of, most) = match *op {
            Op::Push { list, capacity, .. } | Op::PushSorted { list, capacity, .. } => (list, f64::from(capacity)),
            Op::Sort { list, .. } | Op::Remove { list, .. } => (list, count(known, list)),
            Op::Top { to, list, .. } => (to, count(known, list)),
            _ => return,
        };
        for (slot, words) in written(op) {
            known.forget(&self.ground, slot, words);
        }
        match *op {
            Op::Sort { list, key, .. } => {
                let (list, words) = self.list(list);
                self.forget(known, list, words);
                self.writes(key).into_iter().for_each(|(slot, words)| self.forget(known, slot, words));
            }
            Op::Remove { list, .. } => {
                let (list, words) = self.list(list);
                self.forget(known, list, words);
            }
            Op::PushSorted { sort, .. } => {
                self.writes(sort).into_iter().for_each(|(slot, words)| self.forget(known, slot, words));
            }
            _ => {}
        }
        known.set(&self.ground, of, Word { range: Interval::new(0.0, most), is_whole: true }, Implications::default());
    }

    /// An operation of the arithmetic, by its rule; of anything else that writes nothing is known.
    fn computed(&mut self, at: Addr, op: &Op, known: &mut Known) {
        let word = |slot: Slot| known.word(&self.ground, slot);
        let two = |operator: Operator, a, b| operator.rule(&[word(a).range, word(b).range]);
        let one = |operator: Operator, a| operator.rule(&[word(a).range]);
        let whole = |a, b| word(a).is_whole && word(b).is_whole;
        let (to, range, is_whole) = match *op {
            Op::Add { to, a, b } => (to, two(Operator::Add, a, b), false),
            Op::Sub { to, a, b } => (to, two(Operator::Sub, a, b), false),
            Op::Mul { to, a, b } => (to, two(Operator::Mul, a, b), false),
            Op::Div { to, a, b } => (to, two(Operator::Div, a, b), false),
            Op::Pow { to, a, b } => (to, two(Operator::Pow, a, b), false),
            Op::AddInt { to, a, b } => (to, two(Operator::AddInt, a, b), true),
            Op::SubInt { to, a, b } => (to, two(Operator::SubInt, a, b), true),
            Op::MulInt { to, a, b } => (to, two(Operator::MulInt, a, b), true),
            Op::Min { to, a, b } => (to, two(Operator::Min, a, b), whole(a, b)),
            Op::Max { to, a, b } => (to, two(Operator::Max, a, b), whole(a, b)),
            Op::Neg { to, a } => (to, one(Operator::Neg, a), whole(a, a)),
            Op::Abs { to, a } => (to, one(Operator::Abs, a), whole(a, a)),
            Op::Sqrt { to, a } => (to, one(Operator::Sqrt, a), false),
            Op::Floor { to, a } => (to, one(Operator::Floor, a), true),
            Op::Ceil { to, a } => (to, one(Operator::Ceil, a), true),
            Op::Round { to, a } => (to, one(Operator::Round, a), true),
            Op::Sin { to, a } => (to, one(Operator::Sin, a), false),
            Op::Cos { to, a } => (to, one(Operator::Cos, a), false),
            Op::WrapHeading { to, a } => (to, one(Operator::WrapHeading, a), false),
            Op::WrapAngle { to, a } => (to, one(Operator::WrapAngle, a), false),
            Op::Ticks { to, a } => (to, one(Operator::Ticks, a), true),
            Op::Length { to, vector } => (to, two(Operator::Length, vector, vector + 1), false),
            Op::Spread { to, .. } => (to, Operator::Spread.rule(&[]), false),
            Op::Now { to, .. } => (to, Interval::NOT_NEGATIVE, true),
            Op::Eq { to, .. } => (to, Word::TRUTH.range, true),
            _ => {
                for (slot, words) in written(op) {
                    known.forget(&self.ground, slot, words);
                }
                return;
            }
        };
        let (was, times) = self.results.get(&at).copied().unwrap_or((range, 0));
        let range = if times < PATIENCE { range } else { widened(range, was) };
        self.results.insert(at, (range, times + 1));
        known.set(&self.ground, to, Word { range, is_whole }, Implications::default());
    }
}

/// Implications without those of the word that is being written.
fn without(mut implications: Implications, slot: Slot) -> Implications {
    implications.when.retain(|(of, _)| *of != slot);
    implications.unless.retain(|(of, _)| *of != slot);
    implications
}
