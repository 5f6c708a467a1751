//! What can be said of conditions from their form alone.

use super::{Builtin, Expr, ExprKind, InputPart};

/// Whether a condition speaks of the end of a body.
pub fn mentions_done(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Done => true,
        ExprKind::Do(_, operands) => operands.iter().any(mentions_done),
        ExprKind::HeldFor(inner, _) | ExprKind::Becomes(inner) => mentions_done(inner),
        _ => false,
    }
}

/// Whether one condition holds whenever another does; of values, whether they are the same. `false` when in doubt.
pub fn same_condition(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Done, ExprKind::Done) => true,
        (ExprKind::Var(x), ExprKind::Var(y)) => x == y,
        (ExprKind::Number(x), ExprKind::Number(y)) => x == y,
        (ExprKind::Input(x, p), ExprKind::Input(y, q)) => x == y && same_part(p, q),
        (ExprKind::IsPresent(x), ExprKind::IsPresent(y)) | (ExprKind::Unwrap(x), ExprKind::Unwrap(y)) => {
            same_condition(x, y)
        }
        // `a or b` holds whenever `a` does.
        (ExprKind::Do(Builtin::Or, ors), _) if ors.iter().any(|o| same_condition(o, b)) => true,
        // `a and b` holds only when `a` does.
        (_, ExprKind::Do(Builtin::And, ands)) if ands.iter().any(|o| same_condition(a, o)) => true,
        // What holds only when all of several do holds only when each does; not the other way about.
        (ExprKind::Do(Builtin::Not, xs), ExprKind::Do(Builtin::Not, ys)) => {
            xs.iter().zip(ys).all(|(x, y)| same_condition(y, x))
        }
        (ExprKind::Do(op, xs), ExprKind::Do(other, ys)) => {
            op == other && xs.len() == ys.len() && xs.iter().zip(ys).all(|(x, y)| same_condition(x, y))
        }
        _ => false,
    }
}

fn same_part(a: &InputPart, b: &InputPart) -> bool {
    match (a, b) {
        (InputPart::Value, InputPart::Value)
        | (InputPart::Peak, InputPart::Peak)
        | (InputPart::Age, InputPart::Age) => true,
        (InputPart::Field(x), InputPart::Field(y)) => x == y,
        (InputPart::Hits(x, n), InputPart::Hits(y, m)) => n == m && same_condition(x, y),
        _ => false,
    }
}
