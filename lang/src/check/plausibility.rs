//! Values that nobody can mean: times that run backwards, speeds and depths below zero, headings of more than a turn.
//! What is known of a value is its range: one that is wholly senseless is refused, one that only may be is not.

use super::Checker;
use super::result_range::of_type;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expr, Interval};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_arithmetic::{INT_MAX, LARGEST, Operation, Ticks};
use albacore_program::Channel;
use std::f64::consts::TAU;

/// A quantity is this large at most, in metres, seconds and what they make: the sun is nearer.
pub(super) const QUANTITY_MAX: f64 = 1e12;

/// A turn, and what radians lose in being written as degrees.
const TURN: f64 = TAU + 1e-9;

/// The range of a `var` of the prompt, by that of the value it is declared with: what is assigned later is held to its type only.
pub(crate) fn range_of_var(ty: &Type, value: Interval) -> Interval {
    Checker::implied_range(ty).filter(|implied| implied.covers(value)).unwrap_or_else(|| of_type(ty))
}

impl<'t> Checker<'t> {
    /// The duration of `for T`, `within T`, `fresh T` and `after T`.
    pub(super) fn duration(&mut self, e: &tree::Expr, what: &str) -> Expr {
        let value = self.expr_as(e, &Type::Quantity(Dimension::TIME), what);
        if value.ty != Type::Unknown {
            self.not_backwards(&value, what);
        }
        value
    }

    fn not_backwards(&mut self, value: &Expr, what: &str) {
        if value.range.high <= 0.0 {
            let how = match value.range {
                Interval { high, .. } if high < 0.0 => "negative",
                Interval { low, .. } if low < 0.0 => "never more than 0 s",
                _ => "zero",
            };
            self.report(
                Diagnostic::error(Code::RangesDuration, value.span, format!("{what} is {how}"))
                    .help("write a time longer than 0 s"),
            );
        } else if !Ticks::is_defined([value.range]) {
            self.report(
                Diagnostic::error(Code::RangesDuration, value.span, format!("{what} may be negative"))
                    .here("how short can this be?")
                    .help("write `max(0 s, …)`: 0 s is one tick, the shortest time there is"),
            );
        }
    }

    /// The time after which a mission or its recovery is over: nothing would be left of one that may be 0 s.
    pub(super) fn time_limit(&mut self, e: &tree::Expr, what: &str) -> Expr {
        let value = self.expr_as(e, &Type::Quantity(Dimension::TIME), what);
        let may_be_over = value.range.low <= 0.0 && value.range.high > 0.0;
        if value.ty != Type::Unknown && !may_be_over {
            self.not_backwards(&value, what);
        } else if value.ty != Type::Unknown {
            let how = if value.range.low < 0.0 { "negative" } else { "zero" };
            self.report(
                Diagnostic::error(Code::RangesDuration, value.span, format!("{what} may be {how}"))
                    .here("how short can this be?")
                    .help("give the parameter a range, `in 1 min..2 h`, or write `max(1 min, …)`"),
            );
        }
        value
    }

    /// The range of an activity's parameter that has none of its own, and of a memory: a time is not negative. What is given or
    /// assigned is held to it, so that it can be waited for wherever it is read.
    pub(super) fn implied_range(ty: &Type) -> Option<Interval> {
        (*ty == Type::Quantity(Dimension::TIME)).then_some(Interval::NOT_NEGATIVE)
    }

    /// A setpoint or a limit.
    pub(super) fn sensible_setpoint(&mut self, channel: Channel, value: &Expr, what: &str) {
        if !channel.row().may_be_negative {
            self.not_negative(value, what);
        }
    }

    /// What is counted from 0 on: a depth, an altitude, a speed.
    fn not_negative(&mut self, value: &Expr, what: &str) {
        if value.range.high < 0.0 {
            let help = match value.ty {
                Type::Depth => "depths are counted from the surface down: write it without the sign",
                Type::Altitude => "altitudes are counted from the bottom up: write it without the sign",
                _ => "a speed has no direction: leave the sign out, and steer the other way",
            };
            self.report(Diagnostic::error(Code::RangesNegative, value.span, format!("{what} is negative")).help(help));
        }
    }

    /// The default of a parameter that has no range of its own; tells whether it was refused.
    pub(super) fn sensible_default(&mut self, value: &Expr, param: &str) -> bool {
        if value.range.high >= 0.0 {
            return false;
        }
        let what = match value.ty {
            Type::Quantity(d) if d == Dimension::TIME => "Duration",
            Type::Quantity(d) if d == Dimension::SPEED => "Speed",
            _ => return false,
        };
        self.report(
            Diagnostic::error(Code::RangesNegative, value.span, format!("`{param}` is a {what}, and this is negative"))
                .help("leave the sign out; a range of its own, `in LOW..HIGH`, would let it be negative"),
        );
        true
    }

    /// A constant angle where a heading is expected.
    pub(super) fn within_a_turn(&mut self, angle: f64, span: Span) {
        if angle.abs() > TURN {
            let shown = |x: f64| self.shown_number(x, &Type::Heading);
            let wrapped = albacore_geometry::Heading::from_radians(angle).radians();
            let (angle, wrapped) = (shown(angle), shown(wrapped));
            self.report(
                Diagnostic::warning(
                    Code::RangesHeading,
                    span,
                    format!("a heading of {angle} is more than a whole turn"),
                )
                .help(format!("write `{wrapped}`: that is where it points")),
            );
        }
    }

    /// A length that is a constant where a depth or an altitude is expected.
    pub(super) fn below_the_surface(&mut self, value: &Expr, ty: &Type, what: &str) {
        let value = Expr { ty: ty.clone(), ..value.clone() };
        self.not_negative(&value, what);
    }

    /// A constant that was calculated: one too large to be written is too large to be calculated with.
    pub(super) fn sensible_result(&mut self, value: Expr) -> Expr {
        let Some(x) = value.range.constant() else { return value };
        let (largest, shown) = match value.ty {
            Type::Int => (INT_MAX, format!("whole numbers go to {INT_MAX}")),
            // What is computed from quantities may be far from what any is: only what is no number any more is refused.
            _ => (LARGEST, format!("numbers go to {LARGEST:e}")),
        };
        // What would be larger has been held to the largest.
        if x.abs() < largest {
            return value;
        }
        self.report(
            Diagnostic::error(Code::TypesNumber, value.span, "this comes to a number too large to be calculated with")
                .help(format!("{shown}: look for a factor that is too much")),
        );
        self.unknown(value.span)
    }

    /// Whether a number with its unit, in SI, is one to calculate with.
    pub(super) fn sensible_quantity(&mut self, value: f64, span: Span) -> bool {
        // Written so that what is no number is refused too.
        let sensible = value.abs() <= QUANTITY_MAX;
        if !sensible {
            self.report(
                Diagnostic::error(Code::TypesNumber, span, "this is too large to be meant")
                    .help(format!("quantities go to {QUANTITY_MAX:e} in metres, seconds and what they make")),
            );
        }
        sensible
    }
}
