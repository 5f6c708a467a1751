//! What chemical truly lies within, as it is and as it was before: light, so that track and reports are seen on it.

use super::chart::{self, outline};
use super::frame::Frame;
use super::svg::Svg;
use albacore_geometry::Point;

/// The colour of names: the plume's, darker.
pub const COLOUR: &str = "#7d6115";
/// One of whose corners none has moved so far, in pixels, is drawn once.
const MOVED: f64 = 5.0;

/// An outline within which chemical is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrueOutline {
    /// Its name.
    pub name: String,
    /// Its corners.
    pub corners: Vec<Point>,
    /// Where each of them was when the run began; none where that is not shown.
    pub before: Vec<Point>,
}

impl TrueOutline {
    /// Whether any of it is on the chart, by the box about it: a chart may lie within it.
    pub(super) fn is_seen(&self, frame: &Frame) -> bool {
        let corners = outline(&self.corners, frame);
        let span = |of: fn(&(f64, f64)) -> f64| {
            let along = corners.iter().map(of);
            along.map(|x| (x, x)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        };
        let Some((x, y)) = span(|at| at.0).zip(span(|at| at.1)) else { return false };
        x.0 < frame.right() && frame.left < x.1 && y.0 < frame.bottom() && frame.top < y.1
    }

    /// Whether it is to be seen that it was another before.
    pub(super) fn has_moved(&self, frame: &Frame) -> bool {
        self.corners.iter().zip(&self.before).any(|(now, before)| now.distance(*before) * frame.scale >= MOVED)
    }

    /// Draws it, and beneath it as it was.
    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        if self.has_moved(frame) {
            before(svg, &outline(&self.before, frame));
        }
        now(svg, &outline(&self.corners, frame));
    }
}

fn now(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 2 {
        let colour = chart::PLUME;
        let attributes = format!("fill=\"{colour}\" fill-opacity=\"0.14\" stroke=\"{colour}\" stroke-width=\"1.6\"");
        svg.path(corners, true, &attributes);
    }
}

fn before(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 2 {
        let colour = chart::PLUME;
        let attributes = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"0.9\" stroke-dasharray=\"5 3\"");
        svg.path(corners, true, &attributes);
    }
}

/// A rounded shape of the legend.
fn shape((x, y): (f64, f64)) -> [(f64, f64); 8] {
    let half =
        [(-13.0, 1.0), (-8.0, -5.0), (2.0, -6.0), (11.0, -4.0), (13.0, 1.0), (7.0, 6.0), (-3.0, 4.0), (-9.0, 6.0)];
    half.map(|(dx, dy)| (x + dx, y + dy))
}

/// One in the legend.
pub fn mark(svg: &mut Svg, at: (f64, f64)) {
    now(svg, &shape(at));
}

/// One that was before, in the legend.
pub fn mark_before(svg: &mut Svg, at: (f64, f64)) {
    before(svg, &shape(at));
}
