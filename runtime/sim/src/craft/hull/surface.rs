//! The surface, as a hull feels it that comes out of the water.

use super::six_dof::{Load, Six};
use albacore_geometry::Attitude;

/// Parts of the hull that come out one by one, along its length.
const PARTS: [f64; 3] = [-1.0 / 3.0, 0.0, 1.0 / 3.0];

/// A part that is out of the water is pressed back by the weight that the water no longer carries, and slowed by the waves that
/// it makes. Ours: enough to keep a hull in the water and level there, no model of a sea. At depth 0 a hull is just covered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    length: f64,
    /// Weight that a metre out of the water adds to a part, N/m.
    stiffness: f64,
    /// Damping of a part while it is out, N/(m/s).
    damping: f64,
}

/// The body of a hull, as far as it matters at the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Weight, N.
    pub weight: f64,
    /// Length, m.
    pub length: f64,
    /// Diameter, m.
    pub diameter: f64,
    /// Mass with what it moves of the water up and down, kg.
    pub heave_mass: f64,
}

impl Surface {
    /// Over one diameter a hull loses all its buoyancy; critically damped, so that it does not bob.
    pub fn new(body: &Body) -> Self {
        let stiffness = body.weight / body.diameter;
        let damping = 2.0 * (stiffness * body.heave_mass).sqrt();
        let parts = PARTS.len() as f64;
        Surface { length: body.length, stiffness: stiffness / parts, damping: damping / parts }
    }

    /// What it weighs more at a depth, in m, and with an attitude that change so fast.
    #[inline]
    pub fn load(&self, attitude: &Attitude, depth: f64, rates: &Six) -> Load {
        let mut load = Load::default();
        if depth > self.length {
            return load;
        }
        for part in PARTS {
            let ahead = part * self.length;
            let deep = depth - ahead * attitude.sin_pitch;
            if deep < 0.0 {
                let sinking = rates[2] - ahead * attitude.cos_pitch * rates[4];
                let down = -self.stiffness * deep - self.damping * sinking;
                load.down += down;
                load.pitch -= ahead * attitude.cos_pitch * down;
            }
        }
        load
    }
}

#[cfg(test)]
mod tests {
    use super::super::six_dof::attitude_of;
    use super::*;
    use nalgebra::Vector6;

    const SURFACE: Surface = Surface { length: 1.6, stiffness: 500.0, damping: 100.0 };

    fn load(depth: f64, pitch: f64, sinking: f64) -> Load {
        let attitude = attitude_of(&Vector6::new(0.0, 0.0, depth, 0.0, pitch, 0.0));
        SURFACE.load(&attitude, depth, &Vector6::new(0.0, 0.0, sinking, 0.0, 0.0, 0.0))
    }

    #[test]
    fn in_the_water_nothing_is_felt_and_out_of_it_the_weight() {
        assert_eq!(load(0.0, 0.0, -1.0), Load::default());
        assert_eq!(load(5.0, 1.0, -1.0), Load::default());
        let out = load(-0.02, 0.0, 0.0);
        assert!((out.down - 30.0).abs() < 1e-12 && out.pitch.abs() < 1e-12, "{out:?}");
        assert!(load(-0.02, 0.0, -0.1).down > out.down, "it slows what rises");
    }

    #[test]
    fn a_nose_that_is_out_falls_and_a_tail_that_is_out_lifts_it() {
        let nose = load(0.05, 0.3, 0.0);
        let tail = load(0.05, -0.3, 0.0);
        assert!(nose.down > 0.0 && nose.pitch < 0.0, "{nose:?}");
        assert!((tail.down - nose.down).abs() < 1e-12 && (tail.pitch + nose.pitch).abs() < 1e-12);
    }
}
