//! The true outlines of a run's spills.

use albacore_geometry::{Area, Point};
use albacore_program::number;
use albacore_sim::Slick;
use albacore_trace::TrueOutline;

/// A map may become so many times as large, for the sake of an outline, as it is without.
const WIDER_MAX: f64 = 3.0;
/// A map is at least so large, m.
const MAP_MIN_M: f64 = 100.0;

/// The outline of a spill at a time, s of the run: by its name, else of that which a place lies in or is nearest to. None where there is no such spill, or
/// its outline makes no area any more.
pub(crate) fn true_outline(slicks: &[Slick], name: Option<&str>, near: Point, time: f64) -> Option<Area> {
    let named = slicks.iter().filter(|slick| name.is_none_or(|name| slick.name() == name));
    let outlines = named.filter_map(|slick| slick.outline(time)).map(|area| ((-area.gap(near)).max(0.0), area));
    outlines.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, area)| area)
}

/// The outlines of all spills as a picture has them at a time, s of the run, without what was before.
pub(crate) fn drawn(slicks: &[Slick], time: f64) -> Vec<TrueOutline> {
    let name = |slick: &Slick| match slick.left(time).filter(|_| time > 0.0) {
        Some(left) => format!("{}, {} % left", slick.name(), number::fixed(100.0 * left, 0)),
        None => slick.name().to_string(),
    };
    let of = |slick: &Slick| TrueOutline { name: name(slick), corners: slick.corners(time), before: Vec::new() };
    slicks.iter().map(of).collect()
}

/// The same, with what they were when the run began.
pub(crate) fn drawn_since_start(slicks: &[Slick], time: f64) -> Vec<TrueOutline> {
    let before = slicks.iter().map(|slick| slick.corners(0.0));
    drawn(slicks, time).into_iter().zip(before).map(|(now, before)| TrueOutline { before, ..now }).collect()
}

/// Corners that a map of some places has to show, so that true outlines are on it: of each outline all, unless it is far away or too large for that. Then the
/// map shows of it what lies among the places.
pub(crate) fn room<'a>(places: impl Iterator<Item = Point>, outlines: impl Iterator<Item = &'a [Point]>) -> Vec<Point> {
    type Span = ((f64, f64), (f64, f64));
    let one = |p: Point| ((p.north, p.north), (p.east, p.east));
    let both = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    let joined = |a: Span, b: Span| (both(a.0, b.0), both(a.1, b.1));
    let size = |(north, east): Span| (north.1 - north.0).max(east.1 - east.0).max(MAP_MIN_M);
    let Some(shown) = places.map(one).reduce(joined) else { return outlines.flatten().copied().collect() };
    let has_room = |outline: &&[Point]| {
        let with = outline.iter().copied().map(one).fold(shown, joined);
        size(with) <= WIDER_MAX * size(shown)
    };
    outlines.filter(has_room).flatten().copied().collect()
}
