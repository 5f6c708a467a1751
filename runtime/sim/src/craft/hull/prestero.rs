//! The REMUS 100 after Prestero: dynamics from measured and fitted coefficients.
//!
//! T. Prestero, Verification of a Six-Degree of Freedom Simulation Model for the REMUS AUV, MIT/WHOI 2001, which the 2016 paper
//! cites as its reference 14. The thesis itself was not at hand: the numbers are those of three implementations of it that agree (Ariza's,
//! Sgarioto's, Sarhadi's). What is odd in them is kept, but for `Yvv`, and told here:
//!
//! - `Yvv` is printed as -1310, and `Zww` as -131. The hull is round and its fins are a cross, so that they must be equal, and
//!   Prestero's own formula gives -134: [`Crossflow::Corrected`] takes -131, [`Crossflow::AsPrinted`] -1310.
//! - `Mqq` (-188) and `Nrr` (-94) should be equal too, and about -9; `Kpp` (-0.13) about -0.006. They are said to be tuned.
//! - It is 7 N light: it needs a trim of -2.5 degrees of pitch and -8.7 degrees of stern plane at 1.54 m/s, and more than its
//!   fins can give below 1.2 m/s.
//! - In yaw and in pitch it is unstable: left alone it does not run straight.

use super::mass::InverseMass;
use super::six_dof::{Controls, Load, Plant, Six};
use super::surface::Body;
use albacore_geometry::math::TAU;
use albacore_geometry::{Attitude, Vector};
use nalgebra::{Matrix6, Vector6};
use serde::{Deserialize, Serialize};

/// Weight and buoyancy, N; mass, kg.
const WEIGHT: f64 = 299.0;
const BUOYANCY: f64 = 306.0;
const MASS: f64 = 30.48;
/// Moments of inertia, kg m2.
const INERTIA: [f64; 3] = [0.177, 3.45, 3.45];
/// The centre of gravity is so far below the origin, the centre of buoyancy, m.
const Z_G: f64 = 0.0196;
/// Length and diameter, m.
const LENGTH: f64 = 1.33;
const DIAMETER: f64 = 0.191;

// Coefficients by force and moment, with the motion that they belong to.
const X_UU: f64 = -1.62;
const X_UDOT: f64 = -0.93;
const X_WQ: f64 = -35.5;
const X_QQ: f64 = -1.93;
const X_VR: f64 = 35.5;
const X_RR: f64 = -1.93;
const Y_RR: f64 = 0.632;
const Y_UV: f64 = -28.6;
const Y_VDOT: f64 = -35.5;
const Y_RDOT: f64 = 1.93;
const Y_UR: f64 = 5.22;
const Y_WP: f64 = 35.5;
const Y_PQ: f64 = 1.93;
const Y_RUDDER: f64 = 9.64;
const Z_WW: f64 = -131.0;
const Z_QQ: f64 = -0.632;
const Z_UW: f64 = -28.6;
const Z_WDOT: f64 = -35.5;
const Z_QDOT: f64 = -1.93;
const Z_UQ: f64 = -5.22;
const Z_VP: f64 = -35.5;
const Z_RP: f64 = 1.93;
const Z_STERN: f64 = -9.64;
const K_PP: f64 = -0.130;
const K_PDOT: f64 = -0.0704;
const M_WW: f64 = 3.18;
const M_QQ: f64 = -188.0;
const M_UW: f64 = 24.0;
const M_WDOT: f64 = -1.93;
const M_QDOT: f64 = -4.88;
const M_UQ: f64 = -2.0;
const M_VP: f64 = -1.93;
const M_RP: f64 = 4.86;
const M_STERN: f64 = -6.15;
const N_VV: f64 = -3.18;
const N_RR: f64 = -94.0;
const N_UV: f64 = -24.0;
const N_VDOT: f64 = 1.93;
const N_RDOT: f64 = -4.88;
const N_UR: f64 = -2.0;
const N_WP: f64 = -1.93;
const N_PQ: f64 = -4.86;
const N_RUDDER: f64 = -6.15;
/// Propeller: thrust and torque over the square of its turns in rad/s. 3.86 N at 1500 rpm hold 1.54 m/s.
const THRUST: f64 = 1.5698e-4;
const TORQUE: f64 = -2.242e-5;

/// Which drag of the water flowing across the hull in sway.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Crossflow {
    /// `Yvv` = -131, like `Zww`.
    #[default]
    Corrected,
    /// `Yvv` = -1310, as printed.
    AsPrinted,
}

/// The plant.
#[derive(Clone, Debug)]
pub struct Prestero {
    y_vv: f64,
    buoyancy: f64,
    inverse: InverseMass,
}

impl Default for Prestero {
    fn default() -> Self {
        Prestero::new(Crossflow::default())
    }
}

impl Prestero {
    /// The REMUS 100.
    pub fn new(crossflow: Crossflow) -> Self {
        #[rustfmt::skip]
        let matrix = Matrix6::new(
            MASS - X_UDOT, 0.0, 0.0, 0.0, MASS * Z_G, 0.0,
            0.0, MASS - Y_VDOT, 0.0, -MASS * Z_G, 0.0, -Y_RDOT,
            0.0, 0.0, MASS - Z_WDOT, 0.0, -Z_QDOT, 0.0,
            0.0, -MASS * Z_G, 0.0, INERTIA[0] - K_PDOT, 0.0, 0.0,
            MASS * Z_G, 0.0, -M_WDOT, 0.0, INERTIA[1] - M_QDOT, 0.0,
            0.0, -N_VDOT, 0.0, 0.0, 0.0, INERTIA[2] - N_RDOT,
        );
        let y_vv = match crossflow {
            Crossflow::Corrected => -131.0,
            Crossflow::AsPrinted => -1310.0,
        };
        Prestero { y_vv, buoyancy: BUOYANCY, inverse: InverseMass::of(&matrix) }
    }

    /// The same, ballasted until it neither rises nor sinks.
    pub fn neutral(self) -> Self {
        Prestero { buoyancy: WEIGHT, ..self }
    }

    /// What the surface makes of it.
    pub fn body(&self) -> Body {
        Body { weight: WEIGHT, length: LENGTH, diameter: DIAMETER, heave_mass: MASS - Z_WDOT }
    }
}

impl Plant for Prestero {
    #[inline]
    fn acceleration(
        &self,
        attitude: &Attitude,
        velocity: &Six,
        controls: &Controls,
        current: Vector,
        load: Load,
    ) -> Six {
        let [_, _, _, p, q, r] = (*velocity).into();
        let water = attitude.to_body([current.north, current.east, 0.0]);
        let (u, v, w) = (velocity[0] - water[0], velocity[1] - water[1], velocity[2] - water[2]);

        // Down at the origin, and down at the centre of gravity.
        let heavy = WEIGHT - self.buoyancy + load.down;
        let righting = Z_G * WEIGHT;
        let heel = attitude.cos_pitch * attitude.sin_roll;
        let turns = controls.rpm * (TAU / 60.0);
        let turns2 = turns.abs() * turns;
        // The printed rudder turns to port when positive; ours to starboard.
        let (rudder, stern) = (-u * u * controls.rudder, u * u * controls.stern);

        let force = Vector6::new(
            -heavy * attitude.sin_pitch
                + X_UU * u * u.abs()
                + (X_WQ - MASS) * w * q
                + X_QQ * q * q
                + (X_VR + MASS) * v * r
                + X_RR * r * r
                - MASS * Z_G * p * r
                + THRUST * turns2,
            heavy * heel
                + self.y_vv * v * v.abs()
                + Y_RR * r * r.abs()
                + Y_UV * u * v
                + (Y_WP + MASS) * w * p
                + (Y_UR - MASS) * u * r
                - MASS * Z_G * q * r
                + Y_PQ * p * q
                + Y_RUDDER * rudder,
            heavy * attitude.cos_pitch * attitude.cos_roll
                + Z_WW * w * w.abs()
                + Z_QQ * q * q.abs()
                + Z_UW * u * w
                + (Z_UQ + MASS) * u * q
                + (Z_VP - MASS) * v * p
                + MASS * Z_G * (p * p + q * q)
                + Z_RP * r * p
                + Z_STERN * stern,
            -righting * heel + K_PP * p * p.abs() - (INERTIA[2] - INERTIA[1]) * q * r - MASS * Z_G * (w * p - u * r)
                + TORQUE * turns2,
            load.pitch - righting * attitude.sin_pitch
                + M_WW * w * w.abs()
                + M_QQ * q * q.abs()
                + (M_RP - (INERTIA[0] - INERTIA[2])) * r * p
                + MASS * Z_G * (v * r - w * q)
                + M_UQ * u * q
                + M_UW * u * w
                + M_VP * v * p
                + M_STERN * stern,
            N_VV * v * v.abs()
                + N_RR * r * r.abs()
                + N_UV * u * v
                + (N_PQ - (INERTIA[1] - INERTIA[0])) * p * q
                + N_WP * w * p
                + N_UR * u * r
                + N_RUDDER * rudder,
        );
        let mut acceleration = self.inverse.accelerate(&force);
        // The current, seen from a frame that turns: -w x c.
        acceleration[0] += r * water[1] - q * water[2];
        acceleration[1] += p * water[2] - r * water[0];
        acceleration[2] += q * water[0] - p * water[1];
        acceleration
    }
}

#[cfg(test)]
mod tests;
