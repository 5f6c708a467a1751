//! What a test has shown: that an optional is present, that a number lies in a range.
//!
//! A fact is of the value that is read next: an assignment takes it away, wherever in a block it stands, and so does time that
//! goes by. What is computed on other ticks than the one on which it stands, such as a condition over time, is read without
//! what a test beside it has shown.

use crate::hir::{Builtin, Expr, ExprKind, InputId, InputPart, Interval, Var, VarId, VarKind};
use crate::types::Type;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Something of which facts can be known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    Var(VarId),
    Input(InputId),
}

/// A fact.
#[derive(Clone, Debug)]
pub(super) enum Fact {
    Present(Place),
    Within(Place, Interval),
}

impl Fact {
    fn place(&self) -> Place {
        match self {
            Fact::Present(place) | Fact::Within(place, _) => *place,
        }
    }
}

/// Why something is known no more.
#[derive(Clone, Copy, Debug)]
enum Change {
    Assigned(VarId),
    Time,
}

/// What is known of a place.
#[derive(Clone, Copy, Debug)]
struct Known {
    is_present: bool,
    range: Interval,
}

const NOTHING: Known = Known { is_present: false, range: Interval::ANY };

/// A range made narrower by a fact. One that contradicts it stands where nothing is reached: it shows nothing.
fn narrow(range: Interval, fact: Interval) -> Interval {
    let narrowed = range.and(fact);
    if narrowed.is_empty() { range } else { narrowed }
}

/// What is known in a block beside what is known outside it. Blocks are entered and left by the thousand, and what is known outside
/// is not copied for them.
#[derive(Clone, Debug, Default)]
struct Layer {
    outside: Option<Rc<Layer>>,
    /// Of what cannot change, and of what can as time goes by or by an assignment.
    fixed: BTreeMap<Place, Known>,
    changeable: BTreeMap<Place, Known>,
    /// Of what is known outside, nothing is known any more that can change.
    time_went_by: bool,
}

impl Layer {
    fn get(&self, place: Place) -> Known {
        let (mut layer, mut changeable_too) = (Some(self), true);
        while let Some(Layer { outside, fixed, changeable, time_went_by }) = layer {
            let known = fixed.get(&place).or_else(|| changeable.get(&place).filter(|_| changeable_too));
            if let Some(known) = known {
                return *known;
            }
            changeable_too &= !time_went_by;
            layer = outside.as_deref();
        }
        NOTHING
    }
}

/// What is known here.
#[derive(Debug, Default)]
pub(super) struct Facts {
    known: Rc<Layer>,
    /// What has changed since the block began that is being looked at.
    changes: Vec<Change>,
}

impl Facts {
    pub fn learn(&mut self, facts: Vec<Fact>, vars: &[Var]) {
        for fact in facts {
            let place = fact.place();
            let before = self.known.get(place);
            let known = match fact {
                Fact::Present(_) => Known { is_present: true, ..before },
                Fact::Within(_, range) => Known { range: narrow(before.range, range), ..before },
            };
            let is_fixed = matches!(place, Place::Var(v) if vars[v].kind.is_fixed());
            let layer = Rc::make_mut(&mut self.known);
            if is_fixed { &mut layer.fixed } else { &mut layer.changeable }.insert(place, known);
        }
    }

    pub fn is_present(&self, place: Place) -> bool {
        self.known.get(place).is_present
    }

    /// A known range, made narrower by what tests have shown.
    pub fn narrowed(&self, place: Place, range: Interval) -> Interval {
        narrow(range, self.known.get(place).range)
    }

    /// An assignment: nothing is known of the variable any more.
    pub fn forget(&mut self, var: VarId) {
        Rc::make_mut(&mut self.known).changeable.insert(Place::Var(var), NOTHING);
        self.changes.push(Change::Assigned(var));
    }

    /// Time goes by: only what cannot change is known still.
    pub fn forget_changeable(&mut self) {
        let layer = Rc::make_mut(&mut self.known);
        layer.changeable.clear();
        layer.time_went_by = true;
        if !matches!(self.changes.last(), Some(Change::Time)) {
            self.changes.push(Change::Time);
        }
    }

    /// The same knowledge, for another place.
    pub fn known(&self) -> Facts {
        Facts { known: Rc::clone(&self.known), changes: Vec::new() }
    }

    /// Begins a block; gives what is known outside it.
    pub fn enter(&mut self) -> Facts {
        let outside = Rc::clone(&self.known);
        let inside = Layer { outside: Some(Rc::clone(&outside)), ..Layer::default() };
        self.known = Rc::new(inside);
        Facts { known: outside, changes: std::mem::take(&mut self.changes) }
    }

    /// Ends a block: of what is known outside it, all stays known that did not change in it.
    pub fn leave(&mut self, outside: Facts) {
        let Facts { known, changes } = std::mem::replace(self, outside);
        // What is known outside is held by nobody else then, and changed where it stands.
        drop(known);
        for change in changes {
            match change {
                Change::Assigned(var) => self.forget(var),
                Change::Time => self.forget_changeable(),
            }
        }
    }
}

fn place(expr: &Expr) -> Option<Place> {
    match &expr.kind {
        ExprKind::Var(var) => Some(Place::Var(*var)),
        ExprKind::Input(input, InputPart::Value) => Some(Place::Input(*input)),
        _ => None,
    }
}

/// What is known when a condition holds, or when it does not.
pub(super) fn shown(condition: &Expr, holds: bool, vars: &[Var]) -> Vec<Fact> {
    match &condition.kind {
        ExprKind::IsPresent(inner) if holds => place(inner).map(Fact::Present).into_iter().collect(),
        ExprKind::Do(Builtin::Not, operands) => shown(&operands[0], !holds, vars),
        // Both hold, or neither: otherwise one of them could be the other way.
        ExprKind::Do(Builtin::And, operands) if holds => both(operands, holds, vars),
        ExprKind::Do(Builtin::Or, operands) if !holds => both(operands, holds, vars),
        ExprKind::Do(Builtin::Lt, operands) => compared(&operands[0], &operands[1], holds, true),
        ExprKind::Do(Builtin::Le, operands) => compared(&operands[0], &operands[1], holds, false),
        ExprKind::Do(Builtin::Eq, operands) if !holds => {
            let zero = |e: &Expr| e.range.constant() == Some(0.0);
            let other = if zero(&operands[1]) {
                &operands[0]
            } else if zero(&operands[0]) {
                &operands[1]
            } else {
                return Vec::new();
            };
            let range = if other.ty == Type::Int { Interval::INT.without_below(1.0) } else { Interval::NOT_ZERO };
            place(other).map(|p| Fact::Within(p, range)).into_iter().collect()
        }
        // Both were updated at the beginning of the tick: what has been assigned since is not what they have seen.
        ExprKind::HeldFor(inner, _) | ExprKind::Becomes(inner) if holds => {
            let mut facts = shown(inner, true, vars);
            facts.retain(|fact| match fact.place() {
                Place::Var(v) => !matches!(vars[v].kind, VarKind::Memory | VarKind::Var),
                Place::Input(_) => true,
            });
            facts
        }
        _ => Vec::new(),
    }
}

fn both(operands: &[Expr], holds: bool, vars: &[Var]) -> Vec<Fact> {
    operands.iter().flat_map(|o| shown(o, holds, vars)).collect()
}

/// `a < b` or `a <= b`, or its contrary.
fn compared(a: &Expr, b: &Expr, holds: bool, strict: bool) -> Vec<Fact> {
    let (low, high) = if holds { (a, b) } else { (b, a) };
    let strict = strict == holds;
    let mut facts = Vec::new();
    if let Some(place) = place(high) {
        let bound = low.range.low;
        let bound = match (strict, &high.ty) {
            (true, Type::Int) => bound.floor() + 1.0,
            (true, _) => bound.next_up(),
            (false, _) => bound,
        };
        facts.push(Fact::Within(place, Interval::at_least(bound)));
    }
    if let Some(place) = place(low) {
        let bound = high.range.high;
        let bound = match (strict, &low.ty) {
            (true, Type::Int) => bound.ceil() - 1.0,
            (true, _) => bound.next_down(),
            (false, _) => bound,
        };
        facts.push(Fact::Within(place, Interval::at_most(bound)));
    }
    facts
}
