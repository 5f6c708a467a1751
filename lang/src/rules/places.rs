//! Where things are: a scenario that begins outside the area of its mission, or has a source there, or a no-go zone far from it,
//! is seldom meant. Nor is a goal outside the area.

use super::fixed::Fixed;
use super::swapped;
use super::swapped::hemisphere;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Action, Builtin, ClauseArg, ClauseUse, Expr, ExprKind, Hir, StmtKind};
use crate::source::Span;
use crate::types::TypeTable;
use albacore_formats::area::SWAPPED;
use albacore_geometry::{
    AREA_REACH_MAX_M, AREA_WIDTH_MIN_M, Area, AreaError, Geodetic, Heading, Point, TangentFrame, goes_round_a_pole,
};
use albacore_wording::distance;
use std::collections::BTreeSet;

/// What is farther from the area than this, m, is nothing to the mission: a no-go zone may well lie beside it, and a vehicle start
/// there.
pub const FAR_M: f64 = 10_000.0;

/// Goals no farther outside than this, m, are meant to be on the edge: a thousandth of a minute is 1.9 m.
const GOAL_MARGIN_M: f64 = 2.0;

/// What is no farther outside than this, m, is on the edge: no better do two ways to write one place agree.
const EDGE_MARGIN_M: f64 = 0.01;

/// The findings for the scenario that a mission names, as far as its places and the area are constants.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some(parts) = &activity.mission else { return Vec::new() };
    let Some(path) = &parts.scenario else { return Vec::new() };
    let Some(scenario) = hir.scenarios.iter().find(|s| s.path == *path) else { return Vec::new() };
    let Some((area, written, frame)) = of_mission(hir, mission) else { return Vec::new() };
    let far = |clause: &ClauseUse| {
        let what = match clause.name.as_str() {
            "no_go" => "this no-go zone is",
            _ => return None,
        };
        let (_, value) = clause.args.iter().find(|(name, _)| name == "area")?;
        let ClauseArg::Value(e) = value else { return None };
        let out = area.distance(&self::area(e, frame)?);
        let mut far = (out > FAR_M).then(|| finding(&activity.name, written, e.span, what, out))?;
        if frame.is_some_and(|frame| swapped::would_be_near(e, &[frame.origin])) {
            far.help = Some(SWAPPED.into());
        }
        Some(far)
    };
    let outside = |clause: &ClauseUse| {
        let (what, param) = match clause.name.as_str() {
            "vehicle" => ("the vehicle starts", "start"),
            "source" => ("this source is", "at"),
            _ => return None,
        };
        // A start far away is an error in every world: the session tells it.
        let most = if param == "start" { FAR_M } else { f64::INFINITY };
        let place = clause.args.iter().find(|(name, _)| name == param)?;
        let ClauseArg::Value(e) = &place.1 else { return None };
        let out = -area.gap(point(e, frame)?);
        (out > EDGE_MARGIN_M && out <= most).then(|| finding(&activity.name, written, e.span, what, out))
    };
    scenario.clauses.iter().filter_map(|clause| outside(clause).or_else(|| far(clause))).collect()
}

/// An area of constants in which no mission can be planned: round a pole, too thin to work in, or reaching farther than a plane can
/// be taken for the sea.
pub(super) fn unusable(hir: &Hir, mission: usize) -> Option<Diagnostic> {
    let (area, written, frame) = of_mission(hir, mission)?;
    if goes_round_a_pole(&longitudes(written_area(hir, mission)?)) {
        return Some(
            Diagnostic::error(
                Code::AreasPole,
                written,
                "this area goes round a pole, where no longitude is its middle",
            )
            .help("cut it into areas that have no pole in them, or give corners in metres"),
        );
    }
    if let Some(width) = too_thin(written_area(hir, mission)?, frame) {
        let message = format!("this area is {width:.3} m wide where it is thinnest");
        return Some(Diagnostic::error(Code::AreasSmall, written, message).help(format!(
            "no area is thinner than {AREA_WIDTH_MIN_M} m: look for a unit, and for corners that are nearly on one line"
        )));
    }
    let reach = area.reach();
    (reach > AREA_REACH_MAX_M).then(|| {
        let (far, most) = (distance(reach), distance(AREA_REACH_MAX_M));
        let message =
            format!("a corner of this area lies {far} from its middle, and no plane reaches farther than {most}");
        Diagnostic::error(Code::AreasLarge, written, message)
            .help("look for a sign or a digit that is wrong in its corners")
    })
}

/// Goals of a mission and of what it calls that are made of constants and lie outside its area.
pub(super) fn goals(hir: &Hir, types: &TypeTable, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some((area, written, frame)) = of_mission(hir, mission) else { return Vec::new() };
    let mut fixed = Fixed::of(hir, types, mission, frame);
    let mut outside: Vec<(Span, f64, Span, Option<String>)> = Vec::new();
    let asked = |place| frame.and_then(|frame| hemisphere(frame.to_geodetic(place), frame.origin));
    for id in hir.called_from(mission) {
        let unit = fixed.unit(id);
        for block in hir.activities[id].blocks() {
            block.each(&mut |stmt| {
                let StmtKind::Timed(timed) = &stmt.kind else { return };
                let Action::Guide(guide, args) = &timed.action else { return };
                for (_, goal) in guide.law().params.iter().zip(args).filter(|(param, _)| param.kind.is_place()) {
                    let places = fixed.places(unit, goal).into_iter();
                    let places = places.map(|(span, place)| (span, -area.gap(place), goal.span, asked(place)));
                    outside.extend(places.filter(|(_, out, ..)| *out > GOAL_MARGIN_M));
                }
            });
        }
    }
    // One that several statements go to is one mistake.
    let mut told = BTreeSet::new();
    outside.retain(|(span, ..)| told.insert(*span));
    outside
        .into_iter()
        .map(|(span, out, goal, asked)| {
            let message = format!("this goal is {} outside the area of the mission `{}`", distance(out), activity.name);
            let finding = Diagnostic::warning(Code::AreasGoal, span, message).label(written, "the area");
            let contains = goal.file == span.file && goal.start <= span.start && span.end <= goal.end;
            let finding = if contains { finding } else { finding.label(goal, "the vehicle goes there") };
            finding.help(asked.unwrap_or_else(|| {
                "if the vehicle shall not go there, look for minutes exchanged, and for north and east; else widen the area"
                    .to_string()
            }))
        })
        .collect()
}

/// Areas of a mission that are made of constants and reach outside the first, its operating area.
pub(super) fn regions(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some((whole, written, frame)) = of_mission(hir, mission) else { return Vec::new() };
    let outside = |e: &Expr| {
        let region = area(e, frame)?;
        let out = region.corners().iter().map(|&corner| -whole.gap(corner)).fold(0.0, f64::max);
        let message = format!(
            "this area reaches {} outside the operating area of the mission `{}`",
            distance(out),
            activity.name
        );
        let finding = Diagnostic::warning(Code::AreasGoal, e.span, message).label(written, "the operating area");
        let help = "the first `area` is where the vehicle may be, and the others are regions of it: widen the first, or move this one into it";
        (out > GOAL_MARGIN_M).then(|| finding.help(help))
    };
    activity.areas().skip(1).filter_map(outside).collect()
}

/// The area of a mission and where that is written, if it is made of constants.
pub fn operating_area(hir: &Hir, mission: usize) -> Option<(Area, Span)> {
    of_mission(hir, mission).map(|(area, written, _)| (area, written))
}

/// The longitudes of an area's corners where they are written on the globe.
fn longitudes(area: &Expr) -> Vec<f64> {
    let longitude = |corner: &Expr| match corner.kind {
        ExprKind::Geodetic { longitude_deg, .. } => Some(longitude_deg),
        _ => None,
    };
    match &area.kind {
        ExprKind::Unwrap(inner) | ExprKind::Else(inner, _) => longitudes(inner),
        ExprKind::Do(Builtin::Polygon, operands) => match operands.as_slice() {
            [Expr { kind: ExprKind::List(corners), .. }] => corners.iter().filter_map(longitude).collect(),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

/// The operating area of a mission as it is written.
pub(super) fn written_area(hir: &Hir, mission: usize) -> Option<&Expr> {
    hir.activities[mission].areas().next()
}

/// The same, and the frame that it lies in.
fn of_mission(hir: &Hir, mission: usize) -> Option<(Area, Span, Option<TangentFrame>)> {
    let written = written_area(hir, mission)?;
    let frame = hir.activities[mission].origin().map(|origin| TangentFrame { origin });
    Some((area(written, frame)?, written.span, frame))
}

fn finding(mission: &str, area: Span, place: Span, what: &str, out_m: f64) -> Diagnostic {
    let out = distance(out_m);
    let message = format!("{what} {out} outside the area of the mission `{mission}`, which runs in this scenario");
    Diagnostic::warning(Code::ScenariosOutside, place, message)
        .label(area, "the area")
        .help("move it into the area, or the area to it: look for minutes exchanged, and for north and east")
}

/// An area of constants.
pub(super) fn area(e: &Expr, frame: Option<TangentFrame>) -> Option<Area> {
    match &e.kind {
        ExprKind::Do(Builtin::Rectangle, operands) => {
            let [center, along, length, width] = operands.as_slice() else { return None };
            let [along, length, width] = [along, length, width].map(|e| e.range.constant());
            Some(Area::rectangle(point(center, frame)?, Heading::from_radians(along?), length?, width?))
        }
        ExprKind::Do(Builtin::Polygon, operands) => polygon(operands, frame)?.ok(),
        // `area_file(…)`
        ExprKind::Unwrap(inner) => area(inner, frame),
        // `polygon(…) else rectangle(…)`
        ExprKind::Else(first, second) => area(first, frame).or_else(|| area(second, frame)),
        _ => None,
    }
}

fn polygon(operands: &[Expr], frame: Option<TangentFrame>) -> Option<Result<Area, AreaError>> {
    let [Expr { kind: ExprKind::List(corners), .. }] = operands else { return None };
    let corners: Option<Vec<Point>> = corners.iter().map(|corner| point(corner, frame)).collect();
    Some(Area::polygon(&corners?))
}

/// How wide a polygon of constants is that is too thin for an area, m.
fn too_thin(area: &Expr, frame: Option<TangentFrame>) -> Option<f64> {
    match &area.kind {
        ExprKind::Unwrap(inner) | ExprKind::Else(inner, _) => too_thin(inner, frame),
        ExprKind::Do(Builtin::Polygon, operands) => match polygon(operands, frame)? {
            Err(AreaError::TooThin(width)) => Some(width),
            _ => None,
        },
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
