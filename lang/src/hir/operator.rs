//! Which arithmetic a built-in operation is: the checker asks its rule, the machine executes it.

use super::Builtin;
use albacore_arithmetic::Operator;

impl Builtin {
    /// The arithmetic of a built-in operation; none of one whose result is no number of its operands.
    pub fn operator(self) -> Option<Operator> {
        use Builtin as B;
        Some(match self {
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
            B::Exp => Operator::Exp,
            B::Ln => Operator::Ln,
            B::Atan2 => Operator::Atan2,
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
            B::Direction | B::Gap | B::EdgeGap | B::EdgeDistance | B::EdgeTangent => return None,
            B::Rectangle | B::Polygon | B::Hull | B::Center | B::Corner | B::Scattered | B::NearestEdge | B::Exit => {
                return None;
            }
            B::Top | B::At | B::Map | B::Cell | B::VectorQuotient | B::LineVector | B::Run => return None,
        })
    }
}
