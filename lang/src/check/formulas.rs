//! Functions of formulas: those that not every number has a result of, and those of two parts.

use super::Checker;
use super::args::NUMBER;
use super::expr::article;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_arithmetic::{Ln, Operation, Sqrt};

impl<'t> Checker<'t> {
    pub(super) fn square_root(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let Some([x]) = self.positional::<1>("sqrt", args, span) else { return self.unknown(span) };
        let x = self.expr(&x, None);
        let Some(root) = x.ty.dimension().and_then(|d| d.power(0.5)) else {
            if x.ty != Type::Unknown {
                let name = self.type_name(&x.ty);
                self.report(Diagnostic::error(
                    Code::TypesMismatch,
                    x.span,
                    format!("{} has no square root", article(&name)),
                ));
            }
            return self.unknown(span);
        };
        if !Sqrt::is_defined([x.range]) {
            self.report(
                Diagnostic::error(Code::RangesNegative, x.span, "this may be negative, and then it has no square root")
                    .help("write `sqrt(max(x, 0))`, or `sqrt(abs(x))`"),
            );
        }
        self.operation(Builtin::Sqrt, vec![x], Type::Quantity(root), span)
    }

    pub(super) fn logarithm(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let Some([x]) = self.positional::<1>("ln", args, span) else { return self.unknown(span) };
        let x = self.expr_as(&x, &NUMBER, "the operand of `ln`");
        if x.ty == NUMBER && !Ln::is_defined([x.range]) {
            let message = "this may be zero or negative, and then it has no logarithm";
            self.report(
                Diagnostic::error(Code::RangesNegative, x.span, message)
                    .help("write `ln(max(x, 1e-9))` with the least that counts, or look first: `if x > 0 { … }`"),
            );
        }
        self.operation(Builtin::Ln, vec![x], NUMBER, span)
    }

    /// `atan2(y, x)`, of two parts of one dimension.
    pub(super) fn angle_of_parts(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let Some([y, x]) = self.positional::<2>("atan2", args, span) else { return self.unknown(span) };
        let y = self.expr(&y, None);
        let Some(dimension) = y.ty.dimension() else {
            if y.ty != Type::Unknown {
                let name = self.type_name(&y.ty);
                let message = format!("`atan2` takes two numbers or quantities, this is {}", article(&name));
                let finding = Diagnostic::error(Code::TypesMismatch, y.span, message);
                self.report(finding.help("which way a vector points is its `.toward`: `(there - here).toward`"));
            }
            return self.unknown(span);
        };
        let of_parts = Type::Quantity(dimension);
        let y = self.coerce(y, &of_parts, "the first part");
        let x = self.expr_as(&x, &of_parts, "the second part of `atan2`");
        self.operation(Builtin::Atan2, vec![y, x], Type::Quantity(Dimension::ANGLE), span)
    }
}
