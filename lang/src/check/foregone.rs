//! What a condition comes to without a run, as far as its form tells. It proves no theorems: what is not seen here is taken to depend on
//! the run.

use crate::hir::{Block, Builtin, Expr, ExprKind, Interval, TestNames, VarId, VarKind, same_value};
use crate::types::Type;

/// Why an expectation says nothing.
pub(super) enum Empty {
    /// It holds in every run.
    Holds,
    /// It reads constants alone: it is the same in every run.
    Constant,
}

/// A few sums are rounded by less, in shares of the largest of their numbers.
const ROUNDED: f64 = 1e-12;

/// The expectations of a test.
pub(super) struct Expectations<'a> {
    /// What they speak of.
    pub names: &'a TestNames<usize>,
    /// The kinds of their variables.
    pub kind: &'a dyn Fn(VarId) -> VarKind,
}

impl Expectations<'_> {
    /// Why an expectation says nothing, if it does. One that never holds says so by itself.
    pub fn empty(&self, e: &Expr) -> Option<Empty> {
        match self.holds(e) {
            _ if has_fault(e) => None,
            Some(true) => Some(Empty::Holds),
            None if !self.reads_run(e) => Some(Empty::Constant),
            _ => None,
        }
    }

    /// Whether something of a run is read. An area of the mission is none: it is the same in all.
    fn reads_run(&self, e: &Expr) -> bool {
        let is_read = |id: VarId| (self.kind)(id) == VarKind::Signal && !self.names.areas.contains(&id);
        e.contains(|e| matches!(e.kind, ExprKind::Var(id) if is_read(id)))
    }

    /// Whether a condition holds, where that is known without a run.
    fn holds(&self, e: &Expr) -> Option<bool> {
        match &e.kind {
            ExprKind::Number(x) if e.ty == Type::Bool => Some(*x != 0.0),
            ExprKind::If(condition, a, b) => match self.holds(condition) {
                Some(true) => self.value(a),
                Some(false) => self.value(b),
                None => self.all([a, b].into_iter()),
            },
            ExprKind::Match(_, arms, otherwise) => self.all(arms.iter().map(|(_, block)| block).chain(otherwise)),
            ExprKind::Do(Builtin::Not, x) => self.holds(x.first()?).map(|holds| !holds),
            ExprKind::Do(op @ (Builtin::And | Builtin::Or), _) => self.joined(e, *op),
            ExprKind::Do(op, operands) => match operands.as_slice() {
                [a, b] => self.compared(*op, a, b),
                _ => None,
            },
            _ => None,
        }
    }

    fn value(&self, block: &Block) -> Option<bool> {
        self.holds(block.value.as_deref()?)
    }

    /// What all ways come to.
    fn all<'e>(&self, mut ways: impl Iterator<Item = &'e Block>) -> Option<bool> {
        let first = self.value(ways.next()?)?;
        ways.all(|way| self.value(way) == Some(first)).then_some(first)
    }

    /// A row of `or` holds when one of it does, or when of two one is what the other is not; of `and` the other way about.
    fn joined(&self, e: &Expr, op: Builtin) -> Option<bool> {
        let settles = op == Builtin::Or;
        let mut row = Vec::new();
        terms(e, op, &mut row);
        let known: Vec<Option<bool>> = row.iter().map(|e| self.holds(e)).collect();
        let denied = |e: &&Expr| match &e.kind {
            ExprKind::Do(Builtin::Not, x) => x.first().is_some_and(|x| row.iter().any(|y| same_value(x, y))),
            _ => false,
        };
        if known.contains(&Some(settles)) || row.iter().any(denied) {
            return Some(settles);
        }
        known.iter().all(Option::is_some).then_some(!settles)
    }

    fn compared(&self, op: Builtin, a: &Expr, b: &Expr) -> Option<bool> {
        let is_compared = matches!(op, Builtin::Lt | Builtin::Le | Builtin::Eq);
        if is_compared && same_value(a, b) {
            return Some(op != Builtin::Lt);
        }
        // The range of an optional is that of its value, where it has one.
        if a.ty.is_optional() || b.ty.is_optional() {
            return None;
        }
        // `x < x + 1 s` is a matter of the constants alone, where the sums keep what is added.
        let ((base, more), (other, other_more)) = (shifted(a), shifted(b));
        let (a, b) = match is_compared && same_value(base, other) && is_felt(more - other_more, base.range) {
            true => (Interval::exactly(more), Interval::exactly(other_more)),
            false => (self.range(a), self.range(b)),
        };
        match op {
            Builtin::Lt => parted(a.high < b.low, a.low >= b.high),
            Builtin::Le => parted(a.high <= b.low, a.low > b.high),
            Builtin::Eq => {
                let same = a.constant().is_some() && a.constant() == b.constant();
                parted(same, a.high < b.low || b.high < a.low)
            }
            _ => None,
        }
    }

    fn range(&self, e: &Expr) -> Interval {
        match &e.kind {
            // The count of a list that is written out.
            ExprKind::Part(list, 0) if e.ty == Type::Int => match &list.kind {
                ExprKind::List(elements) => Interval::exactly(elements.len() as f64),
                _ => e.range,
            },
            _ => e.range,
        }
    }
}

/// Whether something in it was not understood, which has been told.
fn has_fault(e: &Expr) -> bool {
    e.contains(|e| e.ty == Type::Unknown)
}

/// What `and` or `or` joins, however often.
fn terms<'e>(e: &'e Expr, joint: Builtin, row: &mut Vec<&'e Expr>) {
    match &e.kind {
        ExprKind::Do(op, operands) if *op == joint => operands.iter().for_each(|e| terms(e, joint, row)),
        _ => row.push(e),
    }
}

/// A number as another and a constant that is added to it.
fn shifted(e: &Expr) -> (&Expr, f64) {
    let ExprKind::Do(op, operands) = &e.kind else { return (e, 0.0) };
    let (sign, [a, b]) = (if matches!(op, Builtin::Sub | Builtin::SubInt) { -1.0 } else { 1.0 }, operands.as_slice())
    else {
        return (e, 0.0);
    };
    match (op, a.range.constant(), b.range.constant()) {
        (Builtin::Add | Builtin::AddInt | Builtin::Sub | Builtin::SubInt, _, Some(more)) => {
            let (base, other) = shifted(a);
            (base, other + sign * more)
        }
        (Builtin::Add | Builtin::AddInt, Some(more), _) => {
            let (base, other) = shifted(b);
            (base, other + more)
        }
        _ => (e, 0.0),
    }
}

/// Whether a difference is more than sums with a number of a range are rounded by.
fn is_felt(difference: f64, range: Interval) -> bool {
    difference.abs() > ROUNDED * range.low.abs().max(range.high.abs()).max(1.0)
}

fn parted(holds: bool, fails: bool) -> Option<bool> {
    match (holds, fails) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}
