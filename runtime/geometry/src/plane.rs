//! Points, vectors and lines in the north/east tangent plane.

use crate::heading::Heading;
use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A position in the local tangent plane, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Metres north of the frame's origin.
    pub north: f64,
    /// Metres east of the frame's origin.
    pub east: f64,
}

/// A displacement (m) or a velocity (m/s) in the north/east plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Vector {
    /// The component toward north.
    pub north: f64,
    /// The component toward east.
    pub east: f64,
}

/// A straight line that is followed from its start to its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
}

impl Point {
    /// The origin of the frame.
    pub const ORIGIN: Point = Point { north: 0.0, east: 0.0 };

    /// A point by its coordinates in metres.
    pub const fn new(north: f64, east: f64) -> Self {
        Point { north, east }
    }

    /// The coordinate along a direction, in metres from the origin.
    pub fn along(self, direction: Heading) -> f64 {
        (self - Point::ORIGIN).dot(direction.unit())
    }

    /// Metres to another point.
    pub fn distance(self, other: Point) -> f64 {
        (self - other).length()
    }
}

impl Vector {
    /// The null vector.
    pub const ZERO: Vector = Vector { north: 0.0, east: 0.0 };

    /// A vector by its components.
    pub const fn new(north: f64, east: f64) -> Self {
        Vector { north, east }
    }

    /// The scalar product.
    pub fn dot(self, other: Vector) -> f64 {
        self.north * other.north + self.east * other.east
    }

    /// Its length.
    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// Its component along a direction.
    pub fn along(self, direction: Heading) -> f64 {
        self.dot(direction.unit())
    }

    /// Its component to the right of a direction.
    pub fn right_of(self, direction: Heading) -> f64 {
        self.right_of_unit(direction.unit())
    }

    /// Its component to the right of the direction of a unit vector.
    pub fn right_of_unit(self, unit: Vector) -> f64 {
        self.east * unit.north - self.north * unit.east
    }

    /// The direction it points to; north for the null vector.
    pub fn toward(self) -> Heading {
        Heading::of(self)
    }
}

impl Line {
    /// The direction from start to end; north when they coincide.
    pub fn heading(self) -> Heading {
        (self.end - self.start).toward()
    }

    /// Its length in metres.
    pub fn length(self) -> f64 {
        (self.end - self.start).length()
    }
}

impl Add<Vector> for Point {
    type Output = Point;
    fn add(self, v: Vector) -> Point {
        Point::new(self.north + v.north, self.east + v.east)
    }
}

impl AddAssign<Vector> for Point {
    fn add_assign(&mut self, v: Vector) {
        *self = *self + v;
    }
}

impl Sub<Vector> for Point {
    type Output = Point;
    fn sub(self, v: Vector) -> Point {
        Point::new(self.north - v.north, self.east - v.east)
    }
}

impl Sub for Point {
    type Output = Vector;
    fn sub(self, other: Point) -> Vector {
        Vector::new(self.north - other.north, self.east - other.east)
    }
}

impl Add for Vector {
    type Output = Vector;
    fn add(self, other: Vector) -> Vector {
        Vector::new(self.north + other.north, self.east + other.east)
    }
}

impl Sub for Vector {
    type Output = Vector;
    fn sub(self, other: Vector) -> Vector {
        Vector::new(self.north - other.north, self.east - other.east)
    }
}

impl Neg for Vector {
    type Output = Vector;
    fn neg(self) -> Vector {
        Vector::new(-self.north, -self.east)
    }
}

impl Mul<Vector> for f64 {
    type Output = Vector;
    fn mul(self, v: Vector) -> Vector {
        Vector::new(self * v.north, self * v.east)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_of_north_is_east() {
        let v = Vector::new(3.0, 4.0);
        assert_eq!(v.right_of(Heading::NORTH), 4.0);
        assert_eq!(v.along(Heading::NORTH), 3.0);
        assert_eq!(v.length(), 5.0);
    }
}
