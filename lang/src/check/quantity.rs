//! Functions and clauses of any quantity: `fn mean(values: [Quantity; n]) -> Quantity?`. `Quantity` has a dimension of its own, which no unit has: what holds of
//! it holds of every quantity, and as all are kept in SI units, one body serves them all. Which one it is, each call says.

use super::args::Given;
use super::{Checker, ParamInfo};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expr, ExprKind};
use crate::source::Span;
use crate::syntax::tree::{self, Ty, TyKind};
use crate::types::Type;

/// What is said where something of a known unit stands beside a `Quantity`.
pub(super) const ANY_UNIT: &str =
    "a `Quantity` may be in any unit: what goes with it is made of another `Quantity`, or is 0 without a unit";

/// Whether a type is written with `Quantity`.
pub(super) fn names_quantity(ty: &Ty) -> bool {
    match &ty.kind {
        TyKind::List { element, .. } | TyKind::Map { element, .. } => names_quantity(element),
        TyKind::Named { path, factors } => quantity_named(path, factors).is_some(),
        TyKind::Behavior(..) => false,
    }
}

/// Where the name `Quantity` stands in a product of types.
fn quantity_named<'a>(path: &'a tree::Path, factors: &'a [(tree::Name, f64)]) -> Option<&'a tree::Name> {
    let only = path.parts.first().filter(|_| path.parts.len() == 1);
    let is_it = |name: &&tree::Name| Dimension::of_type(&name.node) == Some(Dimension::QUANTITY);
    only.into_iter().chain(factors.iter().map(|(name, _)| name)).find(is_it)
}

/// What `Quantity` is in a type where a value of another is given for it. What is counted from somewhere counts as its difference, which is
/// then said to be asked for.
fn quantity_in(declared: &Type, given: &Type) -> Option<Dimension> {
    match (declared, given) {
        (Type::Quantity(declared), given) if declared.is_of_quantity() => declared.quantity_in(match given {
            Type::Depth | Type::Altitude => Dimension::LENGTH,
            Type::Heading => Dimension::ANGLE,
            Type::Date => Dimension::TIME,
            other => other.dimension()?,
        }),
        (Type::Optional(declared), given) => quantity_in(declared, given.present()),
        (declared, Type::Optional(given)) => quantity_in(declared, given),
        (Type::List(declared, _), Type::List(given, _)) | (Type::Map(declared, _), Type::Map(given, _)) => {
            quantity_in(declared, given)
        }
        _ => None,
    }
}

/// A type where `Quantity` is something; none where its dimension cannot be written.
fn with_quantity(ty: &Type, quantity: Dimension) -> Option<Type> {
    let inner = |ty: &Type| Some(Box::new(with_quantity(ty, quantity)?));
    Some(match ty {
        Type::Quantity(d) => Type::Quantity(d.with_quantity(quantity)?),
        Type::Optional(ty) => Type::Optional(inner(ty)?),
        Type::List(ty, capacity) => Type::List(inner(ty)?, *capacity),
        Type::Map(ty, cells) => Type::Map(inner(ty)?, *cells),
        other => other.clone(),
    })
}

/// Whether `Quantity` is in a type.
pub(super) fn is_of_quantity(ty: &Type) -> bool {
    match ty {
        Type::Quantity(d) => d.is_of_quantity(),
        Type::Optional(ty) | Type::List(ty, _) | Type::Map(ty, _) => is_of_quantity(ty),
        _ => false,
    }
}

/// Whether an empty list is written: of what it is empty, what stands beside it says.
pub(super) fn is_empty_list(written: &tree::Expr) -> bool {
    matches!(&written.kind, tree::ExprKind::List(elements) if elements.is_empty())
}

/// Whether a value is the 0 without a unit that is the zero of any quantity.
pub(super) fn is_zero(value: &Expr) -> bool {
    value.ty.dimension() == Some(Dimension::NONE) && matches!(value.kind, ExprKind::Number(0.0))
}

/// Two operands, of which one is the zero of the other.
pub(super) fn with_zero(a: Expr, b: Expr) -> (Expr, Expr) {
    match (is_of_quantity(&a.ty), is_of_quantity(&b.ty)) {
        (true, false) if is_zero(&b) => {
            let ty = a.ty.clone();
            (a, Expr { ty, ..b })
        }
        (false, true) if is_zero(&a) => (Expr { ty: b.ty.clone(), ..a }, b),
        _ => (a, b),
    }
}

impl Checker<'_> {
    /// Refuses `Quantity` where no parameter says which one it is.
    pub(super) fn quantity_is_known(&mut self, path: &tree::Path, factors: &[(tree::Name, f64)]) -> bool {
        let Some(name) = quantity_named(path, factors).filter(|_| !self.scope.takes_quantity) else { return true };
        let message = "nothing says which quantity `Quantity` is here";
        let finding = Diagnostic::error(Code::TypesQuantity, name.span, message);
        self.report(finding.help(
            "write the one that is meant, such as `Length`; only a function takes any, and says so in its parameters: `fn mean(values: [Quantity; n]) -> Quantity?`",
        ));
        false
    }

    /// What is written for a parameter; for one of any quantity it is looked at before it is known which one that is.
    pub(super) fn given_for<'e>(&mut self, written: &'e tree::Expr, ty: &Type) -> Given<'e> {
        match is_of_quantity(ty) && !is_empty_list(written) {
            true => Given::Known(self.expr(written, None)),
            false => Given::Written(written),
        }
    }

    /// The arguments of a clause, which may be of any quantity, or of none where it is given nothing that has one.
    pub(super) fn arguments_of_clause(
        &mut self,
        what: &str,
        params: &[ParamInfo],
        args: &[tree::Arg],
        span: Span,
    ) -> Option<Vec<Expr>> {
        if !params.iter().any(|param| is_of_quantity(&param.ty)) {
            return self.arguments(what, params, args, span, None);
        }
        let (written, failed) = self.by_parameter(what, params, args, false);
        let written = written.into_iter().zip(params);
        let given: Vec<Option<Given>> =
            written.map(|(written, param)| written.map(|written| self.given_for(written, &param.ty))).collect();
        let quantity = self.quantity_given(params, &given);
        let (params, _) = self.signature_of_quantity(params.to_vec(), Type::Unknown, quantity, span)?;
        self.values(what, &params, given, failed, (span, None))
    }

    /// What `Quantity` is by what is given for some parameters: a bare number may only lack its unit.
    pub(super) fn quantity_given(&self, params: &[ParamInfo], given: &[Option<Given>]) -> Option<Dimension> {
        let mut found = params.iter().zip(given).filter_map(|(param, given)| match given {
            Some(Given::Known(value)) => quantity_in(&param.ty, &value.ty),
            _ => None,
        });
        let first = found.next()?;
        Some(if first.is_none() { found.find(|quantity| !quantity.is_none()).unwrap_or(first) } else { first })
    }

    /// Parameters and a result where `Quantity` is something. `None` when a dimension cannot be written, which has been told.
    pub(super) fn signature_of_quantity(
        &mut self,
        mut params: Vec<ParamInfo>,
        result: Type,
        quantity: Option<Dimension>,
        span: Span,
    ) -> Option<(Vec<ParamInfo>, Type)> {
        let Some(quantity) = quantity else { return Some((params, result)) };
        let mut written = |ty: &Type, of: &str| {
            let ty = with_quantity(ty, quantity);
            if ty.is_none() {
                self.writable(None, of, span);
            }
            ty
        };
        for param in &mut params {
            param.ty = written(&param.ty, "parameter")?;
            if let Some(default) = &mut param.default {
                default.ty = written(&default.ty, "default")?;
            }
        }
        let result = written(&result, "result")?;
        Some((params, result))
    }

    /// Nothing that is given has a quantity.
    pub(super) fn quantity_not_given(&mut self, what: &str, params: &[ParamInfo], span: Span) {
        let message = format!("nothing that is given to `{what}` says of which quantity it is");
        let finding = Diagnostic::error(Code::TypesQuantity, span, message);
        self.report(match params.iter().find(|param| is_of_quantity(&param.ty)) {
            Some(param) => {
                finding.label(param.span, "declared here").help(format!("write `{}: …`, with its unit", param.name))
            }
            None => finding,
        });
    }
}
