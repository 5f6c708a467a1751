//! Positions on the globe that are written as two numbers, in the place of one point.

use super::ParamInfo;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree::{Arg, Binary, Expr, ExprKind, Unary};
use crate::types::Type;

/// What to say of arguments among which latitude and longitude are two numbers: one mistake, and one finding.
pub(super) fn two_numbers(what: &str, params: &[ParamInfo], args: &[Arg]) -> Option<Diagnostic> {
    if let ("point", [north, east]) = (what, args) {
        // Two counts too: a point has no other numbers.
        let (latitude, longitude) = (degrees(&north.value)?, degrees(&east.value)?);
        let finding = written(north.value.span.to(east.value.span), latitude, longitude)?;
        let (Some(x), Some(y)) = (bare(&north.value), bare(&east.value)) else {
            let has_degrees = in_degrees(&north.value) && in_degrees(&east.value);
            return has_degrees.then_some(finding);
        };
        let position = finding.help.clone().unwrap_or_default();
        return Some(finding.help(format!("{position}; if these are metres, `point({x} m, {y} m)`")));
    }
    args.iter().enumerate().find_map(|(at, arg)| {
        let param = match &arg.label {
            Some(label) => params.iter().find(|param| param.name == label.node),
            None => params.get(at),
        };
        param.filter(|param| param.ty == Type::Point)?;
        match &arg.value.kind {
            ExprKind::Binary(sign, north, east) if sign.node == Binary::Sub => {
                written(arg.value.span, degrees(north)?, -degrees(east)?)
            }
            _ => args.get(at + 1).filter(|next| next.label.is_none()).and_then(|next| pair(&arg.value, &next.value)),
        }
    })
}

/// Two numbers side by side, unless both are counts.
fn pair(north: &Expr, east: &Expr) -> Option<Diagnostic> {
    let (latitude, longitude) = (degrees(north)?, degrees(east)?);
    let is_count = |degrees: f64| degrees.fract() == 0.0 && degrees >= 0.0;
    let are_counts = is_count(latitude) && is_count(longitude);
    if are_counts { None } else { written(north.span.to(east.span), latitude, longitude) }
}

fn written(span: Span, latitude_deg: f64, longitude_deg: f64) -> Option<Diagnostic> {
    let half = |degrees: f64, letters: [char; 2]| format!("{}°{}", degrees.abs(), letters[usize::from(degrees < 0.0)]);
    let (north, east) = (half(latitude_deg, ['N', 'S']), half(longitude_deg, ['E', 'W']));
    (latitude_deg.abs() <= 90.0 && longitude_deg.abs() <= 180.0).then(|| {
        Diagnostic::error(Code::TypesMismatch, span, "a position on the globe is one value, not two numbers")
            .help(format!("if this is a latitude and a longitude write `{north} {east}`"))
    })
}

/// A number without a unit, with its sign.
fn bare(e: &Expr) -> Option<f64> {
    if in_degrees(e) { None } else { degrees(e) }
}

fn in_degrees(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Number { unit, .. } => unit.as_ref().is_some_and(|unit| matches!(unit.node.as_str(), "deg" | "°")),
        ExprKind::Unary(_, inside) => in_degrees(inside),
        _ => false,
    }
}

/// A number without a unit, or in degrees.
fn degrees(e: &Expr) -> Option<f64> {
    match &e.kind {
        ExprKind::Number { value, unit, .. } if unit.is_none() || in_degrees(e) => Some(*value),
        ExprKind::Unary(sign, inside) if sign.node == Unary::Neg => Some(-degrees(inside)?),
        ExprKind::Unary(sign, inside) if sign.node == Unary::Pos => degrees(inside),
        _ => None,
    }
}
