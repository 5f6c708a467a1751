//! From the type that a value has to the one that is asked for: the few conversions there are, and what to say of others.

use super::advice::{scaling_help, unit_help};
use super::expr::article;
use super::quantity::{ANY_UNIT, is_zero};
use super::{Checker, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind, Interval};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_arithmetic::INT_MAX;

impl<'t> Checker<'t> {
    /// An expression of a type that is asked for; `what` names what asks.
    pub(super) fn expr_as(&mut self, e: &tree::Expr, ty: &Type, what: &str) -> Expr {
        let value = self.expr(e, Some(ty));
        self.coerce(value, ty, what)
    }

    /// Makes a value of the type that is asked for, where the language allows it, or says why not.
    pub(super) fn coerce(&mut self, value: Expr, ty: &Type, what: &str) -> Expr {
        if value.ty == Type::Unknown || *ty == Type::Unknown {
            return value;
        }
        // It is shown as what asks for it shows it: as a share or as a number.
        if value.ty == *ty {
            return Expr { ty: ty.clone(), ..value };
        }
        let span = value.span;
        if let Type::Optional(inner) = ty {
            if value.ty == Type::None {
                return Expr { ty: ty.clone(), ..value };
            }
            if !value.ty.is_optional() {
                let value = self.coerce(value, inner, what);
                return self.make(ExprKind::Present(Box::new(value)), ty.clone(), span);
            }
        }
        let constant = value.range.constant();
        let is_constant =
            constant.is_some() || matches!(value.kind, ExprKind::Var(id) if self.scope.vars[id].walks_constants);
        match (&value.ty, ty) {
            (Type::Int | Type::Sign, Type::Quantity(d)) if d.is_none() => return Expr { ty: ty.clone(), ..value },
            (_, Type::Quantity(d)) if d.is_of_quantity() && is_zero(&value) => return Expr { ty: ty.clone(), ..value },
            (Type::Sign, Type::Int) => return Expr { ty: ty.clone(), ..value },
            (Type::Int, Type::Sign) if constant.is_some_and(|x| x.abs() == 1.0) => {
                return Expr { ty: Type::Sign, ..value };
            }
            (Type::Quantity(d), Type::Int)
                if d.is_none() && constant.is_some_and(|x| x.fract() == 0.0 && x.abs() <= INT_MAX) =>
            {
                return Expr { ty: Type::Int, ..value };
            }
            (Type::Quantity(d), Type::Heading) if *d == Dimension::ANGLE && is_constant => {
                if let Some(angle) = constant {
                    self.within_a_turn(angle, span);
                }
                return self.operation(Builtin::Heading, vec![value], Type::Heading, span);
            }
            (Type::Quantity(d), Type::Depth | Type::Altitude) if *d == Dimension::LENGTH && is_constant => {
                self.below_the_surface(&value, ty, what);
                return Expr { ty: ty.clone(), ..value };
            }
            (Type::List(a, n), Type::List(b, m)) if n <= m => {
                if let ExprKind::List(elements) = value.kind {
                    if elements.first().is_some_and(|first| !span.holds(first.span)) {
                        return self.coerce_constant(elements, ty, what, span);
                    }
                    let elements = elements.into_iter().map(|e| self.coerce(e, b, what)).collect();
                    return Expr { kind: ExprKind::List(elements), ty: ty.clone(), span, range: Interval::ANY };
                }
                if a == b && n == m {
                    return value;
                }
            }
            _ => {}
        }
        self.mismatch(&value, ty, what);
        Expr { ty: Type::Unknown, ..value }
    }

    /// A list that is a constant: what is wrong with its elements is told once, where it is read.
    fn coerce_constant(&mut self, elements: Vec<Expr>, ty: &Type, what: &str, span: Span) -> Expr {
        let Type::List(wanted, _) = ty else { return self.unknown(span) };
        let mut coerced = Vec::new();
        for element in elements {
            let element = self.coerce(Expr { span, ..element }, wanted, what);
            if element.ty == Type::Unknown {
                return self.unknown(span);
            }
            coerced.push(element);
        }
        Expr { kind: ExprKind::List(coerced), ty: ty.clone(), span, range: Interval::ANY }
    }

    fn mismatch(&mut self, value: &Expr, wanted: &Type, what: &str) {
        let (has, wants) = (self.type_name(&value.ty), self.type_name(wanted));
        let finding = Diagnostic::error(
            Code::TypesMismatch,
            value.span,
            format!("{what} is {}, this is {}", article(&wants), article(&has)),
        )
        .here(format!("`{has}`"));
        if has == wants {
            let message = format!("{what} is of one `{wants}`, and this of another that is declared under that name");
            let finding = Diagnostic::error(Code::TypesMismatch, value.span, message);
            return self.report(finding.help(self.namesakes()));
        }
        let help = self.help_with_place(value, wanted).or_else(|| self.help_with_unit(value, wanted));
        self.report(match help {
            Some(help) => finding.help(help),
            None => finding,
        });
    }

    /// The help where a place, a direction, or a value that may be absent is taken for something else.
    fn help_with_place(&self, value: &Expr, wanted: &Type) -> Option<String> {
        let constant = value.range.constant();
        let wants = self.type_name(wanted);
        let variable = match value.kind {
            ExprKind::Var(id) => Some(&self.scope.vars[id].name),
            _ => None,
        };
        // What has a name is declared as what it is counted from.
        let counted = |name: &str, origin: &str| {
            if self.scope.setting == Setting::Constant {
                return format!(
                    "{} is counted from the {origin}: declare what it is computed from as {}",
                    article(&wants),
                    article(&wants)
                );
            }
            let declared = variable.map_or(String::new(), |variable| format!("declare it `{variable}: {wants}`, or "));
            format!("{} is counted from the {origin}: {declared}write `{name} + LENGTH` or a constant", article(&wants))
        };
        Some(match (&value.ty, wanted) {
            (Type::Optional(inner), w) if **inner == *w && Self::is_quotient(value) => {
                "when the divisor is zero there is no quotient: write `(… else VALUE)`, or test it with `if` before"
                    .into()
            }
            (Type::Optional(inner), w) if **inner == *w => {
                "it may be absent: write `(… else VALUE)`, or test it with `if` before".into()
            }
            (Type::Quantity(_), Type::Heading) if value.ty.dimension() == Some(Dimension::ANGLE) => {
                "an angle is measured from something: write `HEADING + ANGLE`, such as `north + x`".into()
            }
            (Type::Heading, Type::Quantity(d)) if *d == Dimension::ANGLE => {
                "an angle lies between two headings: write `HEADING - HEADING`".into()
            }
            (Type::Quantity(d), Type::Depth) if *d == Dimension::LENGTH => counted("depth", "surface"),
            (Type::Quantity(d), Type::Altitude) if *d == Dimension::LENGTH => counted("altitude", "bottom"),
            (Type::Int | Type::Quantity(_), Type::Heading) if value.ty.dimension() == Some(Dimension::NONE) => {
                match constant {
                    Some(x) => format!("give it a unit: `{x} deg`"),
                    None => "give it a unit: `north + 1 deg * x`".into(),
                }
            }
            (Type::Int | Type::Quantity(_), Type::Depth | Type::Altitude)
                if value.ty.dimension() == Some(Dimension::NONE) =>
            {
                unit_help(constant, "m")
            }
            (Type::Point, Type::Heading) => {
                "to go to a point write `goto POINT`; the direction to it is `(POINT - position).toward`".into()
            }
            (Type::Vector(_), Type::Heading) => "the direction of a vector is its `.toward`".into(),
            (Type::Heading, Type::Point) => {
                "a place is asked for, such as `position`; to go in a direction write `steer HEADING`".into()
            }
            (Type::Quantity(d), Type::Point) if *d == Dimension::ANGLE => {
                "to go in a direction write `steer HEADING`".into()
            }
            (Type::List(inner, _), Type::List(other, _)) | (Type::Map(inner, _), Type::Map(other, _))
                if inner != other =>
            {
                match variable {
                    Some(variable) => format!("what is in it becomes nothing else: declare `{variable}: {wants}`"),
                    None => {
                        format!("what is in it becomes nothing else: it is declared as `{}`", self.type_name(&value.ty))
                    }
                }
            }
            (Type::Point, Type::Line) => "to go to a point write `goto POINT`; a line is `line(start, end)`".into(),
            _ => return None,
        })
    }

    /// The help where a quantity is of another kind or lacks its unit.
    fn help_with_unit(&self, value: &Expr, wanted: &Type) -> Option<String> {
        let constant = value.range.constant();
        Some(match (&value.ty, wanted) {
            (Type::List(a, n), Type::List(b, m)) if a == b && n < m && !matches!(value.kind, ExprKind::List(_)) => {
                format!("lists of different capacities are of different types: declare it with room for {m}")
            }
            (Type::List(a, _), Type::List(b, m)) if a == b || matches!(value.kind, ExprKind::List(_)) => {
                format!("it holds {m} at most: leave elements out, or declare it longer")
            }
            (Type::Int | Type::Quantity(_), Type::Quantity(d)) if value.ty.dimension() == Some(Dimension::NONE) => {
                match d.is_of_quantity() {
                    true => ANY_UNIT.into(),
                    false => unit_help(constant, &d.unit()),
                }
            }
            (Type::Quantity(has), Type::Quantity(wants)) => scaling_help(*has, *wants, "it", constant.is_some()),
            (Type::Vector(has), Type::Vector(wants)) => scaling_help(*has, *wants, "it", false),
            (Type::Quantity(_), Type::Heading) if constant.is_some() => "write it in `deg`".into(),
            (Type::Quantity(_), Type::Depth | Type::Altitude) if constant.is_some() => "write it in `m`".into(),
            (Type::Depth | Type::Altitude, Type::Quantity(d)) if *d == Dimension::LENGTH => {
                "how far one is from another is a Length: write `depth - top`, the difference of two".into()
            }
            (Type::Vector(d), Type::Point) if *d == Dimension::LENGTH => {
                "a vector leads from one point to another: write `POINT + VECTOR`".into()
            }
            (Type::Point, Type::Vector(_)) => "a vector leads from one point to another: write `POINT - POINT`".into(),
            (Type::Depth, Type::Altitude) | (Type::Altitude, Type::Depth) => {
                "depth is counted from the surface and altitude from the bottom; `water_depth` is both together".into()
            }
            (Type::Text, _) => "a text cannot be calculated with: leave the quotes out".into(),
            _ => return self.example(wanted),
        })
    }

    /// A condition: a `Bool`, or an optional, which then means "is present".
    pub(super) fn condition(&mut self, e: &tree::Expr) -> Expr {
        let value = self.expr(e, Some(&Type::Bool));
        self.truth(value)
    }

    pub(super) fn truth(&mut self, value: Expr) -> Expr {
        let span = value.span;
        match &value.ty {
            Type::Bool | Type::Unknown => value,
            Type::Optional(_) | Type::None => self.make(ExprKind::IsPresent(Box::new(value)), Type::Bool, span),
            other => {
                let name = self.type_name(other);
                let finding = match &value.kind {
                    ExprKind::Unwrap(_) => {
                        let message = format!("this is known to be present here: it is {}", article(&name));
                        Diagnostic::error(Code::TypesCondition, span, message)
                            .help("leave the test out, or compare it with something")
                    }
                    _ => {
                        let message = format!("this is {}, no condition", article(&name));
                        let is_time = matches!(other, Type::Quantity(dimension) if *dimension == Dimension::TIME);
                        let truth = match other {
                            Type::Record(id) => self.types.records[*id].fields.iter().find(|(_, ty)| *ty == Type::Bool),
                            _ => None,
                        };
                        Diagnostic::error(Code::TypesCondition, span, message).help(match truth {
                            Some((field, _)) => format!("ask for its field that is one: `x.{field}`"),
                            None if *other == Type::Date => "compare it with the vehicle's clock: `utc >= DATE`".into(),
                            None if is_time => {
                                "how long something lasts is written with `for` or `within`: `wait for 10 s`".into()
                            }
                            None => "compare it with something, such as `x > 0 m`".to_string(),
                        })
                    }
                };
                self.report(finding.here(format!("`{name}`")));
                self.unknown(span)
            }
        }
    }
}
