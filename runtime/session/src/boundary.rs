//! The true outlines of a run's spills.

use albacore_geometry::{Area, Point};
use albacore_sim::Slick;

/// The outline of a spill at a time, s of the run: by its name, else of that which a place lies in or is nearest to. None where there is no such spill, or
/// its outline makes no area any more.
pub(crate) fn true_outline(slicks: &[Slick], name: Option<&str>, near: Point, time: f64) -> Option<Area> {
    let named = slicks.iter().filter(|slick| name.is_none_or(|name| slick.name() == name));
    let outlines = named.filter_map(|slick| slick.outline(time)).map(|area| ((-area.gap(near)).max(0.0), area));
    outlines.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, area)| area)
}
