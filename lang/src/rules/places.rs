//! Where things are: a scenario that begins outside the area of its mission, or has a source there, or a no-go zone far from it,
//! is seldom meant.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Builtin, ClauseArg, ClauseUse, Expr, ExprKind, Hir};
use crate::source::Span;
use albacore_geometry::{Area, Edge, Geodetic, Heading, Point, TangentFrame};

/// A no-go zone or a region may well lie beside the area; one that is farther from it than this, m, is nothing to the mission.
const FAR_M: f64 = 10_000.0;

/// The findings for the scenario that a mission names, as far as its places and the area are constants.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some(parts) = &activity.mission else { return Vec::new() };
    let Some(path) = &parts.scenario else { return Vec::new() };
    let name = path.rsplit('.').next().unwrap_or(path);
    let Some(scenario) = hir.scenarios.iter().find(|s| s.name == name) else { return Vec::new() };
    let Some((area, written, frame)) = of_mission(hir, mission) else { return Vec::new() };
    let far = |clause: &ClauseUse| {
        let what = match clause.name.as_str() {
            "no_go" => "this no-go zone is",
            "region" => "this region is",
            _ => return None,
        };
        let (_, value) = clause.args.iter().find(|(name, _)| name == "area")?;
        let ClauseArg::Value(e) = value else { return None };
        let out = beyond(&area, &self::area(e, frame)?);
        (out > FAR_M).then(|| finding(&activity.name, written, e.span, what, out))
    };
    let outside = |clause: &ClauseUse| {
        let (what, param) = match clause.name.as_str() {
            "vehicle" => ("the vehicle starts", "start"),
            "source" => ("this source is", "at"),
            _ => return None,
        };
        let place = clause.args.iter().find(|(name, _)| name == param)?;
        let ClauseArg::Value(e) = &place.1 else { return None };
        let out = -area.gap(point(e, frame)?);
        (out > 0.0).then(|| finding(&activity.name, written, e.span, what, out))
    };
    scenario.clauses.iter().filter_map(|clause| outside(clause).or_else(|| far(clause))).collect()
}

/// How far an area lies wholly beyond an edge of another, m; less than nothing where they meet.
fn beyond(area: &Area, other: &Area) -> f64 {
    let of_edge = |edge: Edge| other.corners().iter().map(|corner| -edge.gap(*corner)).fold(f64::INFINITY, f64::min);
    area.edges().map(of_edge).fold(f64::NEG_INFINITY, f64::max)
}

/// The area of a mission and where it is written, if it is made of constants.
pub fn operating_area(hir: &Hir, mission: usize) -> Option<(Area, Span)> {
    of_mission(hir, mission).map(|(area, written, _)| (area, written))
}

/// The same, and the frame that it lies in.
fn of_mission(hir: &Hir, mission: usize) -> Option<(Area, Span, Option<TangentFrame>)> {
    let written = hir.activities[mission].decls.iter().find_map(|decl| match decl {
        crate::hir::Decl::Area(_, e) => Some(e),
        _ => None,
    })?;
    let frame = crate::lower::origin_of(written).map(|origin| TangentFrame { origin });
    Some((area(written, frame)?, written.span, frame))
}

fn finding(mission: &str, area: Span, place: Span, what: &str, out_m: f64) -> Diagnostic {
    let out = if out_m < 10_000.0 { format!("{out_m:.0} m") } else { format!("{:.0} km", out_m / 1000.0) };
    let message = format!("{what} {out} outside the area of the mission `{mission}`, which runs in this scenario");
    Diagnostic::warning(Code::ScenariosOutside, place, message)
        .label(area, "the area")
        .help("move it into the area, or the area to it: look for minutes exchanged, and for north and east")
}

/// An area of constants.
fn area(e: &Expr, frame: Option<TangentFrame>) -> Option<Area> {
    match &e.kind {
        ExprKind::Do(Builtin::Rectangle, operands) => {
            let [center, along, length, width] = operands.as_slice() else { return None };
            let [along, length, width] = [along, length, width].map(|e| e.range.constant());
            Area::rectangle(point(center, frame)?, Heading::from_radians(along?), length?, width?).ok()
        }
        ExprKind::Do(Builtin::Polygon, operands) => match operands.as_slice() {
            [Expr { kind: ExprKind::List(corners), .. }] => {
                let corners: Option<Vec<Point>> = corners.iter().map(|corner| point(corner, frame)).collect();
                Area::polygon(&corners?).ok()
            }
            _ => None,
        },
        // `area_file(…)`
        ExprKind::Unwrap(inner) => area(inner, frame),
        // `polygon(…) else rectangle(…)`
        ExprKind::Else(first, second) => area(first, frame).or_else(|| area(second, frame)),
        _ => None,
    }
}

/// A point of constants.
fn point(e: &Expr, frame: Option<TangentFrame>) -> Option<Point> {
    match &e.kind {
        ExprKind::Geodetic { latitude_deg, longitude_deg } => {
            Some(frame?.to_point(Geodetic::from_degrees(*latitude_deg, *longitude_deg)))
        }
        ExprKind::Do(Builtin::Pair, operands) => match operands.as_slice() {
            [north, east] => Some(Point::new(north.range.constant()?, east.range.constant()?)),
            _ => None,
        },
        ExprKind::Present(inner) => point(inner, frame),
        _ => None,
    }
}
