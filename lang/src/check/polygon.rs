//! `polygon(corners)`: an area made of a list, and what is known of it before the launch.

use super::{Checker, ParamInfo};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Builtin, Expr, ExprKind};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_geometry::{AREA_CORNERS_MAX, Area, AreaError, Geodetic, Point, TangentFrame};

impl Checker<'_> {
    /// An area if the corners make one; where an area is asked for, corners that are known before the launch must.
    pub(super) fn polygon(&mut self, args: &[tree::Arg], expected: Option<&Type>, span: Span) -> Expr {
        // A list of any capacity: which type it is asked for is seen when it is known.
        let any =
            ParamInfo { name: "corners".into(), ty: Type::Unknown, default: None, range: None, behavior: None, span };
        let Some(mut values) = self.arguments("polygon", &[any], args, span, None) else { return self.unknown(span) };
        let Some(list) = values.pop() else { return self.unknown(span) };
        let capacity = if let Type::List(_, capacity) = list.ty { capacity } else { AREA_CORNERS_MAX as u32 };
        let points = Type::List(Box::new(Type::Point), capacity);
        let list = self.coerce(list, &points, "the argument `corners` of `polygon`");
        let unknown = |e: &Expr| e.ty == Type::Unknown;
        if unknown(&list) || matches!(&list.kind, ExprKind::List(corners) if corners.iter().any(unknown)) {
            return self.unknown(span);
        }
        let known = known_corners(&list).map(|corners| Area::polygon(&corners));
        let (is_known, is_asked_for) = (known.is_some(), expected == Some(&Type::Area));
        if let ExprKind::List(corners) = &list.kind
            && (1..3).contains(&corners.len())
        {
            self.no_area(corners, AreaError::TooFewCorners, true, span);
            return self.unknown(span);
        }
        if let (ExprKind::List(corners), Some(Err(error))) = (&list.kind, known) {
            self.no_area(corners, error, is_asked_for, span);
            if is_asked_for {
                return self.unknown(span);
            }
        }
        let area = self.area_of(list, span);
        if is_known && is_asked_for { area.unwrapped() } else { area }
    }

    /// The area of a list of corners, if they make one.
    pub(super) fn area_of(&mut self, list: Expr, span: Span) -> Expr {
        if let Type::List(_, capacity) = list.ty {
            self.types.corners = self.types.corners.max(capacity);
        }
        self.operation(Builtin::Polygon, vec![list], Type::Area.optional(), span)
    }

    /// What keeps constants from making an area: that their outline crosses itself is always told, anything else where one is asked for.
    fn no_area(&mut self, corners: &[Expr], error: AreaError, is_asked_for: bool, span: Span) {
        let n = corners.len();
        let edge = |i: usize| format!("the edge from corner {} to {}", i + 1, (i + 1) % n + 1);
        match error {
            AreaError::Crossed(a, b) => self.report(
                Diagnostic::error(Code::AreasCrossed, corners[a].span, format!("{} meets {}", edge(a), edge(b)))
                    .here("one begins here")
                    .label(corners[b].span, "and the other here")
                    .help("put the corners in their order round the area, either way"),
            ),
            error if is_asked_for => self.report(
                Diagnostic::error(Code::AreasSmall, span, format!("these corners make no area: {error}"))
                    .help("look for a unit, and for corners that are nearly in one place or on one line"),
            ),
            _ => {}
        }
    }
}

/// Where corners lie in the plane about them, if they are constants.
fn known_corners(list: &Expr) -> Option<Vec<Point>> {
    let ExprKind::List(corners) = &list.kind else { return None };
    let frame = hir::middle(&list.positions()).map(|origin| TangentFrame { origin });
    corners.iter().map(|corner| constant(corner, frame)).collect()
}

/// A corner on the globe, or in metres.
fn constant(corner: &Expr, frame: Option<TangentFrame>) -> Option<Point> {
    match (&corner.kind, frame) {
        (ExprKind::Geodetic { latitude_deg, longitude_deg }, Some(frame)) => {
            Some(frame.to_point(Geodetic::from_degrees(*latitude_deg, *longitude_deg)))
        }
        (ExprKind::Do(Builtin::Pair, parts), None) => match parts.as_slice() {
            [north, east] => Some(Point::new(north.range.constant()?, east.range.constant()?)),
            _ => None,
        },
        _ => None,
    }
}
