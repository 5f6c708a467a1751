//! What a test has shown: that an optional is present, that a number is not zero.

use crate::hir::{Builtin, Expr, ExprKind, InputId, InputPart, Interval, Var, VarId, VarKind};

/// Something of which facts can be known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// What is known here.
#[derive(Clone, Debug, Default)]
pub(super) struct Facts {
    known: Vec<Fact>,
}

impl Facts {
    pub fn learn(&mut self, facts: Vec<Fact>) {
        self.known.extend(facts);
    }

    pub fn is_present(&self, place: Place) -> bool {
        self.known.iter().any(|f| matches!(f, Fact::Present(p) if *p == place))
    }

    /// A known range, made narrower by what tests have shown.
    pub fn narrowed(&self, place: Place, mut range: Interval) -> Interval {
        for fact in &self.known {
            if let Fact::Within(p, shown) = fact
                && *p == place
            {
                range = Interval {
                    low: range.low.max(shown.low),
                    high: range.high.min(shown.high),
                    not_zero: range.not_zero || shown.not_zero,
                };
            }
        }
        range
    }

    /// An assignment: nothing is known of the variable any more.
    pub fn forget(&mut self, var: VarId) {
        self.known.retain(|f| f.place() != Place::Var(var));
    }

    /// Time goes by: only what cannot change is known still.
    pub fn forget_changeable(&mut self, vars: &[Var]) {
        self.known.retain(|f| match f.place() {
            Place::Var(v) => matches!(vars[v].kind, VarKind::Param | VarKind::Let | VarKind::Loop | VarKind::Area),
            Place::Input(_) => false,
        });
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
pub(super) fn shown(condition: &Expr, holds: bool) -> Vec<Fact> {
    match &condition.kind {
        ExprKind::IsPresent(inner) if holds => place(inner).map(Fact::Present).into_iter().collect(),
        ExprKind::Do(Builtin::Not, operands) => shown(&operands[0], !holds),
        // Both hold, or neither: otherwise one of them could be the other way.
        ExprKind::Do(Builtin::And, operands) if holds => both(operands, holds),
        ExprKind::Do(Builtin::Or, operands) if !holds => both(operands, holds),
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
            let range = Interval { not_zero: true, ..Interval::ANY };
            place(other).map(|p| Fact::Within(p, range)).into_iter().collect()
        }
        ExprKind::HeldFor(inner, _) if holds => shown(inner, true),
        ExprKind::Becomes(inner) if holds => shown(inner, true),
        _ => Vec::new(),
    }
}

fn both(operands: &[Expr], holds: bool) -> Vec<Fact> {
    operands.iter().flat_map(|o| shown(o, holds)).collect()
}

/// `a < b` or `a <= b`, or its contrary.
fn compared(a: &Expr, b: &Expr, holds: bool, strict: bool) -> Vec<Fact> {
    let (low, high) = if holds { (a, b) } else { (b, a) };
    let strict = strict == holds;
    let mut facts = Vec::new();
    if let Some(place) = place(high) {
        let not_zero = strict && low.range.low >= 0.0;
        facts.push(Fact::Within(place, Interval { low: low.range.low, high: f64::INFINITY, not_zero }));
    }
    if let Some(place) = place(low) {
        let not_zero = strict && high.range.high <= 0.0;
        facts.push(Fact::Within(place, Interval { low: f64::NEG_INFINITY, high: high.range.high, not_zero }));
    }
    facts
}
