//! A vehicle with nothing but kinematics: it turns at most so fast, and the current carries it.

#![allow(dead_code, reason = "each test file uses its own part of this one")]

use albacore_geometry::math::{TAU, degrees, radians};
use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::dubins::Pose;
use albacore_guidance::parameters::TURN_RATE_MAX;
use albacore_guidance::{CommandFilter, Guidance, through_water, turning_radius};

/// The control period.
pub const DT: f64 = 0.1;
/// The survey speed of the 2005 paper, in m/s.
pub const SPEED: f64 = 2.0;
/// What the vehicle can do through the water, in m/s.
pub const SPEED_MAX: f64 = 2.5;
/// The path radius at that speed and 10 degrees per second: 12.6 m.
pub fn radius() -> f64 {
    turning_radius(SPEED, radians(10.0))
}
/// How far ahead turns are commanded, in metres.
pub fn lead() -> f64 {
    SPEED * albacore_guidance::parameters::TURN_LEAD_TIME
}

#[derive(Clone, Copy, Debug)]
pub struct Vehicle {
    pub position: Point,
    pub heading: Heading,
    /// Course over ground: what guidance is told.
    pub course: Heading,
    pub current: Vector,
    /// Whether the current is known and compensated for.
    pub compensated: bool,
    pub rate_max: f64,
    filter: CommandFilter,
}

impl Vehicle {
    pub fn at(position: Point, heading: Heading) -> Self {
        let (current, filter) = (Vector::ZERO, CommandFilter::new(heading));
        let rate_max = radians(10.0);
        Vehicle { position, heading, course: heading, current, compensated: true, rate_max, filter }
    }

    /// In a current: if it is known, the vehicle is already on its course, otherwise already carried off it.
    pub fn in_current(mut self, current: Vector, compensated: bool) -> Self {
        self.current = current;
        self.compensated = compensated;
        if compensated {
            self.heading = through_water(self.course, SPEED, current, SPEED_MAX).heading;
        } else {
            self.course = (SPEED * self.heading.unit() + current).toward();
        }
        self
    }

    pub fn pose(&self) -> Pose {
        Pose { point: self.position, heading: self.course }
    }

    /// One control period behind the command filter and, if the current is known, its compensation.
    pub fn drive(&mut self, commanded: Heading) {
        let filtered = self.filter.step(commanded, TURN_RATE_MAX, DT);
        let flow = if self.compensated { self.current } else { Vector::ZERO };
        let asked = through_water(filtered, SPEED, flow, SPEED_MAX);
        let turn = (asked.heading - self.heading).clamp(-self.rate_max * DT, self.rate_max * DT);
        // The middle of the turn, so that a steady turn is a circle.
        let velocity = asked.speed * (self.heading + turn / 2.0).unit() + self.current;
        self.heading = self.heading + turn;
        self.position += DT * velocity;
        self.course = (asked.speed * self.heading.unit() + self.current).toward();
    }

    /// Drives until guidance says it arrived: the seconds it took, or `None` beyond `limit` seconds. `watch` sees
    /// every tick.
    pub fn run(
        &mut self,
        limit: f64,
        mut guide: impl FnMut(Point, Heading) -> Guidance,
        mut watch: impl FnMut(&mut Vehicle),
    ) -> Option<f64> {
        for tick in 0..(limit / DT) as u32 {
            let guidance = guide(self.position, self.course);
            if guidance.arrived {
                return Some(f64::from(tick) * DT);
            }
            self.drive(guidance.course);
            watch(self);
        }
        None
    }
}

/// Spread-out numbers in [0, 1): multiples of an irrational, so that nothing is random and nothing lines up.
pub fn spread(i: u32, k: u32) -> f64 {
    let step = [0.618_033_988_749_894_8, 0.754_877_666_246_692_7, 0.569_840_290_998_053_2, 0.819_172_513_396_164_4];
    (f64::from(i + 1) * step[k as usize % 4] + 0.37 * f64::from(k)).fract()
}

/// A heading and a point within `reach` metres north and east of the origin.
pub fn scattered(i: u32, k: u32, reach: f64) -> Pose {
    let across = |k: u32| reach * (2.0 * spread(i, k) - 1.0);
    Pose { point: Point::new(across(k), across(k + 1)), heading: Heading::from_radians(TAU * spread(i, k + 2)) }
}

/// The angle between two headings in degrees, without sign.
pub fn apart_deg(a: Heading, b: Heading) -> f64 {
    degrees(a - b).abs()
}

/// What no path can be kept by: a radius in m, degrees per second of the hull, a current toward the east in m/s, and whether it
/// is known.
pub const BEYOND_ANY_PATH: [(f64, f64, f64, bool); 10] = [
    (0.1, 10.0, 0.0, true),
    (0.1, 2.0, 0.0, true),
    (0.1, 0.5, 0.0, true),
    (12.6, 2.0, 0.0, true),
    (12.6, 1.0, 0.0, true),
    (12.6, 0.2, 0.0, true),
    (12.6, 10.0, 1.5, true),
    (12.6, 10.0, 1.8, true),
    (12.6, 10.0, 1.5, false),
    (12.6, 10.0, 1.8, false),
];
