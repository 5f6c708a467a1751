//! Ranges of numbers: what an operation can give for what its operands can be. The rules are those of the arithmetic that the
//! machine executes.

use crate::hir::{Builtin, Interval};
use crate::types::Type;

/// The range of a built-in operation's result; none where nothing is known but its type.
pub(super) fn range(op: Builtin, operands: &[Interval]) -> Option<Interval> {
    let operator = op.operator()?;
    match (op, operands) {
        // Where it is present its divisor is not zero.
        (Builtin::Quotient, [a, b]) => Some(operator.rule(&[*a, b.and(Interval::NOT_ZERO)])),
        // `number(angle)`: the same number.
        (Builtin::Add, [only]) => Some(*only),
        (Builtin::Length | Builtin::Dot | Builtin::Along | Builtin::Spread, _) => Some(operator.rule(&[])),
        _ => Some(operator.rule(operands)),
    }
}

/// The values of a type, where they are numbers.
pub(super) fn of_type(ty: &Type) -> Interval {
    match ty {
        Type::Int => Interval::INT,
        Type::Sign => Interval::SIGN,
        _ => Interval::ANY,
    }
}
