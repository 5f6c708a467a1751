//! Ranges of numbers: what an operation can give for what its operands can be. The rules are those of the arithmetic that the
//! machine executes; here is which built-in operation is which of them.

use crate::hir::{Builtin, Interval};
use crate::types::Type;
use albacore_arithmetic::Operator;

/// The arithmetic of a built-in operation; none of one whose result is no number of its operands.
pub(super) fn operator(op: Builtin) -> Option<Operator> {
    use Builtin as B;
    Some(match op {
        B::Add => Operator::Add,
        B::Sub => Operator::Sub,
        B::Mul => Operator::Mul,
        B::AddInt => Operator::AddInt,
        B::SubInt => Operator::SubInt,
        B::MulInt => Operator::MulInt,
        B::Div | B::Quotient => Operator::Div,
        B::Pow => Operator::Pow,
        B::Neg => Operator::Neg,
        B::Abs => Operator::Abs,
        B::Min => Operator::Min,
        B::Max => Operator::Max,
        B::Sqrt => Operator::Sqrt,
        B::Floor => Operator::Floor,
        B::Ceil => Operator::Ceil,
        B::Round => Operator::Round,
        B::Sin => Operator::Sin,
        B::Cos => Operator::Cos,
        B::Heading => Operator::WrapHeading,
        B::Angle => Operator::WrapAngle,
        // Of vectors, whose components are not followed.
        B::Length => Operator::Length,
        B::Dot | B::Along => Operator::Dot,
        B::Spread => Operator::Spread,
        B::Lt | B::Le | B::Eq | B::Not | B::And | B::Or => return None,
        B::AddVector | B::SubVector | B::Scale | B::Toward | B::Pair | B::Line => return None,
        B::Direction | B::Gap | B::EdgeGap | B::EdgeTangent => return None,
        B::Rectangle | B::Polygon | B::Center | B::Corner | B::NearestEdge | B::Exit => return None,
        B::Top | B::At | B::VectorQuotient | B::LineVector | B::Run => return None,
    })
}

/// The range of a built-in operation's result; none where nothing is known but its type.
pub(super) fn range(op: Builtin, operands: &[Interval]) -> Option<Interval> {
    let operator = operator(op)?;
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
