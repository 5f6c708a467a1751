//! What one instruction makes of what is known.

use super::Unsound;
use super::known::{Implications, Known, Word, widened};
use super::ranges::{PATIENCE, Ranges, Results};
use super::written::written;
use crate::{ABSOLUTE, ActivityKind, Addr, AreaOp, Body, Compute, ListOp, MapOp, Op, OverrideEnd, Param, Slot};
use albacore_arithmetic::{Div, Interval, Operation, Operator, counted};
use albacore_geometry::AREA_WIDTH_MIN_M;
use std::rc::Rc;

impl Ranges<'_> {
    /// One instruction that does not jump.
    pub(super) fn execute(&mut self, entry: Addr, at: Addr, op: &Op, known: &mut Known) -> Result<(), Unsound> {
        if self.holds_to_it {
            self.holds(op, known).map_err(|why| Unsound { at, why })?;
        }
        match *op {
            Op::Compute(computed) => self.compute(at, op, computed, known),
            Op::List(list) => self.on_list(op, list, known),
            Op::Map(MapOp::CellOf { to, .. }) => {
                self.set(known, to, Word { range: Interval::new(-1.0, Interval::INT.high), is_whole: true });
            }
            Op::Map(_) | Op::Area(_) | Op::Keep { .. } | Op::Answer { .. } | Op::Driven { .. } => {
                self.unknown(op, known)
            }
            Op::AskPayload { .. } => self.unknown(op, known),
            Op::Heard { answer, ended, .. } => {
                self.set(
                    known,
                    answer,
                    Word { range: Interval::new(0.0, OverrideEnd::NoAnswer.number()), is_whole: true },
                );
                [answer + 1, ended].into_iter().for_each(|slot| self.set(known, slot, Word::TRUTH));
            }
            Op::IsNew { to, .. } => self.set(known, to, Word::TRUTH),
            Op::Age { to, .. } => self.set(known, to, Word::of(Operator::Age.rule(&[]))),
            Op::Hits { to, of, .. } => self.set(known, to, Word { range: counted(of), is_whole: true }),
            Op::Begin { .. } => self.unknown(op, known),
            Op::Guide { ended, .. } => {
                self.unknown(op, known);
                self.set(known, ended, Word::TRUTH);
            }
            Op::Call { .. } | Op::Enter { .. } | Op::Step { .. } | Op::Cut { .. } | Op::PutOn { .. } | Op::Yield => {
                self.others_run(entry, at, op, known)?
            }
            Op::Return
            | Op::TakeOff { .. }
            | Op::Ask { .. }
            | Op::Take
            | Op::Unanswered { .. }
            | Op::Desert { .. }
            | Op::End
            | Op::Finish
            | Op::Abort { .. }
            | Op::Tell { .. }
            | Op::Report { .. }
            | Op::Log { .. }
            | Op::Changed { .. } => {}
        }
        Ok(())
    }

    /// What must hold of the operands of an instruction.
    fn holds(&self, op: &Op, known: &Known) -> Result<(), &'static str> {
        let range = |slot: Slot| known.range(&self.ground, slot);
        let must = |holds: bool, why| if holds { Ok(()) } else { Err(why) };
        match *op {
            Op::Compute(Compute::One { operator, a, .. }) => {
                must(operator.is_defined(&[range(a)]), without_result(operator))
            }
            Op::Compute(Compute::Two { operator, a, b, .. }) => {
                must(operator.is_defined(&[range(a), range(b)]), without_result(operator))
            }
            Op::Area(AreaOp::Rectangle { length, width, .. }) => {
                let has_size = [length, width].iter().all(|side| range(*side).low >= AREA_WIDTH_MIN_M);
                must(has_size, "a rectangle may be too thin")
            }
            Op::Area(AreaOp::Rows { step, .. }) => must(range(step).low > 0.0, "rows may lie no distance apart"),
            Op::Begin { guide, args, .. } => {
                let is_admitted = |(at, param): (u32, &Param)| param.admits(range(args + at));
                must(guide.law().placed_params().all(is_admitted), "an argument of guidance may be outside its range")
            }
            _ => Ok(()),
        }
    }

    fn set(&self, known: &mut Known, to: Slot, word: Word) {
        known.set(&self.ground, to, word, self.ground.nothing());
    }

    /// Of all that an instruction writes nothing is known.
    fn unknown(&self, op: &Op, known: &mut Known) {
        for (slot, words) in written(op) {
            known.forget(&self.ground, slot, words);
        }
    }

    /// What needs nothing but words.
    fn compute(&mut self, at: Addr, op: &Op, computed: Compute, known: &mut Known) {
        let range = |known: &Known, slot: Slot| known.range(&self.ground, slot);
        let word = |known: &Known, slot: Slot| known.word(&self.ground, slot);
        match computed {
            Compute::Const { to, value } => self.set(known, to, Word::exactly(value)),
            Compute::Copy { to, from } => known.copy(&self.ground, from, to, 1),
            Compute::CopyMany { to, from, words } => known.copy(&self.ground, from, to, words),
            Compute::Clear { to, words } => {
                known.forget(&self.ground, to, words);
                self.set(known, to, Word::exactly(0.0));
            }
            Compute::One { operator, to, a } => {
                let a = word(known, a);
                let range = self.result(at, operator, [a.range, Interval::ANY]);
                self.set(known, to, Word { range, is_whole: is_whole(operator, a.is_whole) });
            }
            Compute::Two { operator, to, a, b } => {
                let (a, b) = (word(known, a), word(known, b));
                let range = self.result(at, operator, [a.range, b.range]);
                self.set(known, to, Word { range, is_whole: is_whole(operator, a.is_whole && b.is_whole) });
            }
            Compute::Quotient { to, a, b } => self.quotient(known, to, range(known, a), range(known, b)),
            Compute::Lt { .. }
            | Compute::Le { .. }
            | Compute::Eq { .. }
            | Compute::Not { .. }
            | Compute::And { .. }
            | Compute::Or { .. } => self.test(computed, known),
            Compute::HeldFor { to, x, since, .. } => {
                self.shown(to, x, known);
                known.forget(&self.ground, since, 1);
                self.timer(known, to);
            }
            Compute::Becomes { to, x, before } => {
                self.shown(to, x, known);
                self.set(known, before, Word::TRUTH);
                self.timer(known, to);
            }
            Compute::Elapsed { to, .. } => self.set(known, to, Word::TRUTH),
            Compute::Now { to, .. } => {
                self.set(known, to, Word { range: Interval::NOT_NEGATIVE, is_whole: true });
            }
            Compute::AddVector { .. }
            | Compute::SubVector { .. }
            | Compute::Scale { .. }
            | Compute::Toward { .. }
            | Compute::Direction { .. }
            | Compute::Dot { .. }
            | Compute::Along { .. }
            | Compute::EdgeAt { .. }
            | Compute::EdgeGap { .. } => self.unknown(op, known),
            // Those who follow the ways through code see to it.
            Compute::Jump { .. } => {}
        }
    }

    fn quotient(&self, known: &mut Known, to: Slot, a: Interval, b: Interval) {
        known.forget(&self.ground, to, 2);
        if Div::is_defined([a, b]) {
            self.set(known, to, Word::exactly(1.0));
            self.set(known, to + 1, Word::of(Div::rule([a, b])));
        } else {
            let quotient = Div::rule([a, b.and(Interval::NOT_ZERO)]);
            self.set(known, to + 1, Word::of(quotient.or(Interval::exactly(0.0))));
            let implications = Implications { when: vec![(to + 1, quotient)], unless: Vec::new() };
            known.set(&self.ground, to, Word::TRUTH, Rc::new(implications));
        }
    }

    /// A test, and what its outcome tells of what it looks at.
    fn test(&mut self, test: Compute, known: &mut Known) {
        let (to, implications) = match test {
            Compute::Lt { to, a, b } | Compute::Le { to, a, b } => {
                let strict = matches!(test, Compute::Lt { .. });
                let implied = |holds| self.comparison(known, a, b, strict, holds).to_vec();
                (to, Implications { when: implied(true), unless: implied(false) })
            }
            Compute::Eq { to, a, b, words: 1 } => {
                let (left, right) = (known.range(&self.ground, a), known.range(&self.ground, b));
                let not_zero =
                    |of, other: Interval| (other.constant() == Some(0.0)).then_some((of, Interval::NOT_ZERO));
                let unless = [not_zero(a, right), not_zero(b, left)].into_iter().flatten().collect();
                (to, Implications { when: vec![(a, right), (b, left)], unless })
            }
            Compute::Eq { to, .. } => return self.set(known, to, Word::TRUTH),
            Compute::Not { to, a } => {
                let Implications { when, unless } = (*known.implications(&self.ground, a)).clone();
                (to, Implications { when: unless, unless: when })
            }
            Compute::And { to, a, b } | Compute::Or { to, a, b } => {
                let mut left = (*known.implications(&self.ground, a)).clone();
                let right = known.implications(&self.ground, b);
                left.when.extend_from_slice(&right.when);
                left.unless.extend_from_slice(&right.unless);
                match test {
                    Compute::And { .. } => left.unless.clear(),
                    _ => left.when.clear(),
                }
                (to, left)
            }
            _ => return,
        };
        known.set(&self.ground, to, Word::TRUTH, Rc::new(without(implications, to)));
    }

    /// The range of an operation's result, widened where it keeps growing from round to round: but no further than its operands can
    /// bring it that have stayed as they were, such as a constant.
    fn result(&mut self, at: Addr, operator: Operator, operands: [Interval; 2]) -> Interval {
        let range = operator.rule(&operands);
        let before = self.results.get(&at).copied();
        let Results { of, given, grown } = before.unwrap_or(Results { of: operands, given: range, grown: 0 });
        let of = [0, 1].map(|i| if of[i] == operands[i] { of[i] } else { Interval::ANY });
        let grows = !given.covers(range);
        let range = match grows && grown >= PATIENCE {
            true => widened(range, given).and(operator.rule(&of)),
            false => range,
        };
        self.results.insert(at, Results { of, given: given.or(range), grown: grown + u32::from(grows) });
        range
    }

    /// Where other code runs, or time passes.
    fn others_run(&mut self, entry: Addr, at: Addr, op: &Op, known: &mut Known) -> Result<(), Unsound> {
        match *op {
            Op::Call { code, base } => match self.arguments(at, known, code, base)? {
                Some(_) => self.runs(entry, at, known, code, base)?,
                None => self.writes(code).into_iter().for_each(|(slot, words)| self.forget(known, slot, words)),
            },
            Op::Enter { call } | Op::Step { call, .. } | Op::Cut { call, .. } => {
                if let Some((activity, base)) = self.called(call) {
                    let block = match activity.body {
                        Body::Sequence(block) if activity.kind == ActivityKind::Override => Some(block),
                        _ => None,
                    };
                    let code = activity.entry;
                    if matches!(op, Op::Enter { .. }) {
                        self.arguments(at, known, code, base)?;
                        block.into_iter().for_each(|block| self.enter(block, known));
                    }
                    self.runs(entry, at, known, code, base)?;
                }
                if let Op::Step { ended, .. } = *op {
                    self.set(known, ended, Word::TRUTH);
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
            _ => {}
        }
        Ok(())
    }

    fn timer(&self, known: &mut Known, to: Slot) {
        known.forget(&self.ground, to, 1);
        // What it shows is known of the ground, where it has been seen.
        known.grounded(|slot| slot == to);
    }

    /// What a timer shows when it is true: as much as whatever updates it.
    fn shown(&mut self, timer: Slot, x: Slot, known: &Known) {
        // Where what is watched does not hold, neither does the timer: that way it shows nothing.
        if known.word(&self.ground, x).is_zero() {
            return;
        }
        let implications = known.implications(&self.ground, x);
        let implied = implications.when.iter().copied();
        let stands = |slot: Slot| self.unit.standing.iter().any(|(at, words)| slot >= *at && slot - at < *words);
        let mut shows: Vec<(Slot, Interval)> = Vec::new();
        for (of, range) in implied.filter(|(of, _)| of & ABSOLUTE != 0 || stands(*of)) {
            match shows.iter_mut().find(|(other, _)| *other == of) {
                Some((_, known)) => *known = known.and(range),
                None => shows.push((of, range)),
            }
        }
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

    fn on_list(&mut self, op: &Op, of: ListOp, known: &mut Known) {
        let count = |known: &Known, list| known.range(&self.ground, list).high.clamp(0.0, f64::from(u32::MAX));
        let (list, most) = match of {
            ListOp::At { to, list, words, .. } => {
                let element = self.element(known, list, words);
                known.forget(&self.ground, to, words.saturating_add(1));
                self.set(known, to, Word::TRUTH);
                for (slot, word) in (to.saturating_add(1)..).zip(element) {
                    self.set(known, slot, word);
                }
                return;
            }
            ListOp::Spread { to, .. } => {
                return self.set(known, to, Word::of(Operator::Spread.rule(&[])));
            }
            ListOp::Push { list, capacity, .. } | ListOp::PushSorted { list, capacity, .. } => {
                (list, f64::from(capacity))
            }
            ListOp::Sort { list, .. } | ListOp::Remove { list, .. } | ListOp::Replace { list, .. } => {
                (list, count(known, list))
            }
            ListOp::Top { to, list, .. } => (to, count(known, list)),
        };
        self.unknown(op, known);
        if let ListOp::Sort { list, .. } | ListOp::Remove { list, .. } | ListOp::Replace { list, .. } = of {
            let (list, words) = self.list(list);
            self.forget(known, list, words);
        }
        if let ListOp::Sort { key: code, .. } | ListOp::PushSorted { sort: code, .. } = of {
            self.writes(code).into_iter().for_each(|(slot, words)| self.forget(known, slot, words));
        }
        self.set(known, list, Word { range: Interval::new(0.0, most), is_whole: true });
    }
}

/// What is wrong with operands that an operation gives no result for.
fn without_result(operator: Operator) -> &'static str {
    match operator {
        Operator::Div => "it may divide by zero",
        Operator::Sqrt => "it may take the root of a negative number",
        Operator::Ln => "it may take the logarithm of what is not positive",
        Operator::Pow => "a power may have no value",
        Operator::Ticks => "a time may be negative",
        _ => "an operation may have no result",
    }
}

/// Whether the result of an operation is whole, where its operands are or are not.
fn is_whole(operator: Operator, are_whole: bool) -> bool {
    match operator {
        Operator::AddInt | Operator::SubInt | Operator::MulInt => true,
        Operator::Floor | Operator::Ceil | Operator::Round | Operator::Ticks => true,
        Operator::Min | Operator::Max | Operator::Neg | Operator::Abs => are_whole,
        _ => false,
    }
}

/// Implications without those of the word that is being written.
fn without(mut implications: Implications, slot: Slot) -> Implications {
    implications.when.retain(|(of, _)| *of != slot);
    implications.unless.retain(|(of, _)| *of != slot);
    implications
}
