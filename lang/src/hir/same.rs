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
        return !any_of(b, Builtin::Or, &mut |b| !same_condition(a, b));
    }
    if is(a, Builtin::And) {
        return !any_of(a, Builtin::And, &mut |a| !same_condition(a, b));
    }
    // `a or c` holds whenever `a` does, `b and c` only when `b` does.
    if is(a, Builtin::Or) || is(b, Builtin::And) {
        return any_of(a, Builtin::Or, &mut |a| any_of(b, Builtin::And, &mut |b| same_condition(a, b)));
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

/// Whether something is so of any of what `and` or `or` joins, however often. Nothing is kept of it: each two rules of a behavior are compared.
fn any_of(e: &Expr, joint: Builtin, is_so: &mut dyn FnMut(&Expr) -> bool) -> bool {
    match &e.kind {
        ExprKind::Do(op, operands) if *op == joint => operands.iter().any(|e| any_of(e, joint, is_so)),
        _ => is_so(e),
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
