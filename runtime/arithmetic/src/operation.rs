//! What an operation is, and the list of all of them.

use crate::Interval;
use crate::{
    Abs, Add, AddInt, Age, Atan2, Ceil, Cos, Div, Dot, Exp, Floor, Length, Ln, Max, Min, Mul, MulInt, Neg, Pow, Round,
    Sin, Spread, Sqrt, Sub, SubInt, Ticks, WrapAngle, WrapHeading,
};
use serde::{Deserialize, Serialize};

/// An operation on numbers: what the machine does, and what is known of it before.
pub trait Operation<const N: usize> {
    /// What is executed.
    fn execute(operands: [f64; N]) -> f64;

    /// All that `execute` can give for operands of these ranges.
    fn rule(operands: [Interval; N]) -> Interval;

    /// Whether all operands of these ranges have a result. For others `execute` gives a stand-in, which `rule` holds too: a
    /// program is refused, or asks first, where one could be meant.
    fn is_defined(_operands: [Interval; N]) -> bool {
        true
    }
}

macro_rules! operators {
    ($($name:ident of $count:literal),* $(,)?) => {
        /// Every operation by its name, for whoever chooses one while running.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[allow(missing_docs, reason = "each variant is the operation of its name")]
        pub enum Operator { $($name),* }

        impl Operator {
            /// All of them.
            pub const ALL: &[Operator] = &[$(Operator::$name),*];

            /// How many operands it has.
            pub fn operands(self) -> usize {
                match self { $(Operator::$name => $count),* }
            }

            /// What is executed; a missing operand is 0. Where it is called the number of operands is known, and nothing is asked of it.
            #[inline(always)]
            pub fn execute(self, operands: &[f64]) -> f64 {
                match self { $(Operator::$name => <$name as Operation<$count>>::execute(filled(operands, 0.0))),* }
            }

            /// All that `execute` can give for operands of these ranges; a missing one can be any.
            pub fn rule(self, operands: &[Interval]) -> Interval {
                match self { $(Operator::$name => <$name as Operation<$count>>::rule(filled(operands, Interval::ANY))),* }
            }

            /// Whether all operands of these ranges have a result.
            pub fn is_defined(self, operands: &[Interval]) -> bool {
                match self { $(Operator::$name => <$name as Operation<$count>>::is_defined(filled(operands, Interval::ANY))),* }
            }
        }
    };
}

operators! {
    Add of 2, Sub of 2, Mul of 2, Div of 2, Pow of 2, Neg of 1, Abs of 1, Min of 2, Max of 2, Sqrt of 1,
    AddInt of 2, SubInt of 2, MulInt of 2, Floor of 1, Ceil of 1, Round of 1,
    Exp of 1, Ln of 1, Atan2 of 2, Sin of 1, Cos of 1, WrapHeading of 1, WrapAngle of 1,
    Length of 2, Dot of 4, Spread of 2, Age of 1, Ticks of 1,
}

fn filled<T: Copy, const N: usize>(operands: &[T], missing: T) -> [T; N] {
    std::array::from_fn(|i| operands.get(i).copied().unwrap_or(missing))
}
