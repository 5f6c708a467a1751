//! What can be said of conditions from their form alone.

use super::{Builtin, Expr, ExprKind, InputPart};

/// Whether a condition speaks of the end of a body.
pub fn mentions_done(e: &Expr) -> bool {
    e.contains(|e| matches!(e.kind, ExprKind::Done))
}

/// Whether one condition holds whenever another does; of values, whether they are the same. `false` when in doubt.
///
/// Rows of `and` and `or` are taken apart once, so that the work is no more than each part of one beside each of the other.
pub fn same_condition(a: &Expr, b: &Expr) -> bool {
    // `b or c` is enough for what each of the two is enough for.
    if is(b, Builtin::Or) {
        return row(b, Builtin::Or).into_iter().all(|b| same_condition(a, b));
    }
    if is(a, Builtin::And) {
        return row(a, Builtin::And).into_iter().all(|a| same_condition(a, b));
    }
    // `a or c` holds whenever `a` does, `b and c` only when `b` does.
    if is(a, Builtin::Or) || is(b, Builtin::And) {
        let (ors, ands) = (row(a, Builtin::Or), row(b, Builtin::And));
        return ors.iter().any(|a| ands.iter().any(|b| same_condition(a, b)));
    }
    match (&a.kind, &b.kind) {
        // What does not hold: the other way about.
        (ExprKind::Do(Builtin::Not, xs), ExprKind::Do(Builtin::Not, ys)) => {
            xs.iter().zip(ys).all(|(x, y)| same_condition(y, x))
        }
        _ => same_value(a, b),
    }
}

/// Whether two expressions surely have one value.
pub fn same_value(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Done, ExprKind::Done) => true,
        (ExprKind::Var(x), ExprKind::Var(y)) => x == y,
        (ExprKind::Number(x), ExprKind::Number(y)) => x == y,
        (ExprKind::Input(x, p), ExprKind::Input(y, q)) => x == y && same_part(p, q),
        (ExprKind::IsPresent(x), ExprKind::IsPresent(y))
        | (ExprKind::Unwrap(x), ExprKind::Unwrap(y))
        | (ExprKind::Present(x), ExprKind::Present(y)) => same_value(x, y),
        (ExprKind::Else(x, a), ExprKind::Else(y, b)) => same_value(x, y) && same_value(a, b),
        // A function gives the same for the same.
        (ExprKind::Call(f, xs), ExprKind::Call(g, ys)) => f == g && all_same(xs, ys),
        (ExprKind::List(xs), ExprKind::List(ys)) | (ExprKind::Record(xs), ExprKind::Record(ys)) => all_same(xs, ys),
        (ExprKind::Part(x, p), ExprKind::Part(y, q)) => p == q && same_value(x, y),
        (ExprKind::Do(op, xs), ExprKind::Do(other, ys)) => op == other && all_same(xs, ys),
        _ => false,
    }
}

fn all_same(xs: &[Expr], ys: &[Expr]) -> bool {
    xs.len() == ys.len() && xs.iter().zip(ys).all(|(x, y)| same_value(x, y))
}

fn is(e: &Expr, joint: Builtin) -> bool {
    matches!(&e.kind, ExprKind::Do(op, _) if *op == joint)
}

/// What `and` or `or` joins, however often.
fn row(e: &Expr, joint: Builtin) -> Vec<&Expr> {
    match &e.kind {
        ExprKind::Do(op, operands) if *op == joint => operands.iter().flat_map(|e| row(e, joint)).collect(),
        _ => vec![e],
    }
}

fn same_part(a: &InputPart, b: &InputPart) -> bool {
    match (a, b) {
        (InputPart::Value, InputPart::Value)
        | (InputPart::Peak, InputPart::Peak)
        | (InputPart::Age, InputPart::Age)
        | (InputPart::IsNew, InputPart::IsNew) => true,
        (InputPart::Field(x), InputPart::Field(y)) => x == y,
        (InputPart::Hits(x, n), InputPart::Hits(y, m)) => n == m && same_value(x, y),
        _ => false,
    }
}
