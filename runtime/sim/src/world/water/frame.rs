//! Coordinates along the mean flow: x down-flow and y to its right, from the up-flow left corner of a box round the region.

use crate::world::water::{Flow, Meander};
use albacore_geometry::{Area, Heading, Point, Vector};

/// A box aligned with the mean flow, and its coordinates.
#[derive(Clone, Debug)]
pub struct FlowFrame {
    corner: Point,
    along: Vector,
    /// Length along the flow, m.
    pub length: f64,
    /// Width across it, m.
    pub width: f64,
}

impl FlowFrame {
    /// The smallest such box that holds the region and the margin round it; no more than a point without a region.
    pub fn new(flow: &Flow, region: Option<&Area>) -> Self {
        let direction: Heading = flow.mean.toward();
        let margin = flow.meander.as_ref().map_or(Meander::default().margin, |m| m.margin);
        let mut frame = FlowFrame { corner: Point::ORIGIN, along: direction.unit(), length: 0.0, width: 0.0 };
        let Some(region) = region else { return frame };
        let (mut low, mut high) = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        for &corner in region.corners() {
            let (x, y) = frame.to_local(corner);
            low = (low.0.min(x), low.1.min(y));
            high = (high.0.max(x), high.1.max(y));
        }
        let (corner_x, corner_y) = (low.0 - margin, low.1 - margin);
        frame.corner = frame.to_point(corner_x, corner_y);
        frame.length = high.0 + margin - corner_x;
        frame.width = high.1 + margin - corner_y;
        frame
    }

    /// Metres down-flow and to the right of the box's corner.
    pub fn to_local(&self, p: Point) -> (f64, f64) {
        self.of_vector(p - self.corner)
    }

    /// The components of a vector along the flow and to its right.
    pub fn of_vector(&self, d: Vector) -> (f64, f64) {
        (d.dot(self.along), d.east * self.along.north - d.north * self.along.east)
    }

    /// The point at coordinates of the box.
    pub fn to_point(&self, x: f64, y: f64) -> Point {
        self.corner + self.to_vector(x, y)
    }

    /// The vector with components along and to the right of the flow.
    pub fn to_vector(&self, u: f64, v: f64) -> Vector {
        Vector::new(u * self.along.north - v * self.along.east, u * self.along.east + v * self.along.north)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let flow = Flow { mean: 0.125 * Heading::from_degrees(140.0).unit(), ..Flow::default() };
        let region = Area::rectangle(Point::new(3.0, 4.0), Heading::from_degrees(140.0), 1094.0, 367.0);
        let frame = FlowFrame::new(&flow, Some(&region));
        assert!((frame.length - 1214.0).abs() < 1e-9 && (frame.width - 487.0).abs() < 1e-9);
        let (x, y) = frame.to_local(Point::new(3.0, 4.0));
        assert!((x - 607.0).abs() < 1e-9 && (y - 243.5).abs() < 1e-9);
        let p = Point::new(-70.0, 200.0);
        let (x, y) = frame.to_local(p);
        assert!(frame.to_point(x, y).distance(p) < 1e-9);
        assert!((frame.to_vector(0.125, 0.0) - flow.mean).length() < 1e-12);
        assert!(frame.to_vector(0.0, 1.0).right_of(flow.mean.toward()) > 0.999);
    }
}
