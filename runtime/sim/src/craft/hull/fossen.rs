//! The REMUS 100 after Fossen: dynamics from the shape of the hull.
//!
//! Facts are those of `remus100.py` in PythonVehicleSimulator (commit c717e073, with the propeller's advance speed through the
//! water, its pull request 23), which implements T. I. Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control,
//! 2nd ed. 2021. Tests hold the plant to time series computed with that program.

mod cross_flow;

use super::GRAVITY;
use super::mass::InverseMass;
use super::six_dof::{Controls, Load, Plant, Six};
use super::surface::Body;
use albacore_geometry::math::{PI, atan2, exp, ln};
use albacore_geometry::{Attitude, Vector};
use cross_flow::CrossFlow;
use nalgebra::{Matrix6, Vector3, Vector6};

/// Density of the water, kg/m3.
const DENSITY: f64 = 1026.0;
/// Length and diameter of the hull, m.
const LENGTH: f64 = 1.6;
const DIAMETER: f64 = 0.19;
/// The centre of gravity is so far below that of buoyancy, m.
const METACENTRE: f64 = 0.02;
/// Drag coefficient of the hull's front, and Oswald's efficiency of the hull as a wing.
const FRONT_DRAG: f64 = 0.42;
const OSWALD: f64 = 0.7;
/// Time constants of sway, heave and yaw, s; damping ratios of roll and pitch.
const SURGE_TIME: f64 = 20.0;
const SWAY_TIME: f64 = 20.0;
const HEAVE_TIME: f64 = 20.0;
const YAW_TIME: f64 = 1.0;
const ROLL_DAMPING: f64 = 0.3;
const PITCH_DAMPING: f64 = 0.8;
/// Added moment of inertia in roll, of the hull's own.
const ADDED_ROLL: f64 = 0.3;
/// Linear damping of surge and sway fades with speed: exp(-3 U).
const DAMPING_FADE: f64 = 3.0;
/// Two fins of each kind: area in m2, lift coefficients of rudder and stern plane, and where they are, m.
const FIN_AREA: f64 = 2.0 * 0.00665;
const RUDDER_LIFT: f64 = 0.5;
const STERN_LIFT: f64 = 0.7;
const FIN_AT: f64 = -LENGTH / 2.0;
/// Propeller: diameter, m; coefficients of thrust and torque at rest and at the greatest advance ratio, and that ratio.
const PROPELLER: f64 = 0.14;
const THRUST_AT_REST: f64 = 0.4566;
const THRUST_SLOPE: f64 = (0.1798 - THRUST_AT_REST) / 0.6632;
const TORQUE_AT_REST: f64 = 0.0700;
const TORQUE_SLOPE: f64 = (0.0312 - TORQUE_AT_REST) / 0.6632;
/// The water at the propeller follows the hull: of the speed and of the thrust so much is left. The torque on the hull is a
/// tenth of the propeller's, and positive as published (later releases of MSS turn it round).
const WAKE: f64 = 0.944;
const THRUST_LEFT: f64 = 0.9;
const TORQUE_LEFT: f64 = 0.1;

/// The plant, with everything precomputed that does not change.
#[derive(Clone, Debug)]
pub struct Fossen {
    mass: f64,
    /// Moments of inertia about the origin, kg m2.
    inertia: Vector3<f64>,
    /// Mass times the depth of its centre, kg m.
    moment: f64,
    /// Added mass and inertia: a diagonal.
    added: Six,
    inverse: InverseMass,
    /// Linear damping at rest: a diagonal.
    damping: Six,
    /// Half the density times the area that lift and drag of the hull are counted by.
    wing: f64,
    lift_slope: f64,
    drag: f64,
    induced_drag: f64,
    cross_flow: CrossFlow,
}

impl Default for Fossen {
    fn default() -> Self {
        Fossen::new()
    }
}

impl Fossen {
    /// The REMUS 100.
    pub fn new() -> Self {
        let (a, b) = (LENGTH / 2.0, DIAMETER / 2.0);
        let mass = 4.0 / 3.0 * PI * DENSITY * a * b * b;
        let (roll, pitch) = (0.4 * mass * b * b, 0.2 * mass * (a * a + b * b));
        let offset = mass * METACENTRE * METACENTRE;
        let inertia = Vector3::new(roll + offset, pitch + offset, pitch);
        let moment = mass * METACENTRE;

        // Added mass of a prolate spheroid, Lamb's k-factors (Fossen 2021, eqs. 6.35-6.41).
        let e2 = 1.0 - (b / a) * (b / a);
        let e = e2.sqrt();
        let e3 = e * e2;
        let logarithm = ln((1.0 + e) / (1.0 - e));
        let alpha = 2.0 * (1.0 - e2) / e3 * (0.5 * logarithm - e);
        let beta = 1.0 / e2 - (1.0 - e2) / (2.0 * e3) * logarithm;
        let (k1, k2) = (alpha / (2.0 - alpha), beta / (2.0 - beta));
        let k = e2 * e2 * (beta - alpha) / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * (beta - alpha)));
        let added = Vector6::new(mass * k1, mass * k2, mass * k2, ADDED_ROLL * roll, k * pitch, k * pitch);

        let rigid = Vector6::new(mass, mass, mass, inertia.x, inertia.y, inertia.z);
        let mut matrix = Matrix6::from_diagonal(&(rigid + added));
        (matrix[(0, 4)], matrix[(4, 0)]) = (moment, moment);
        (matrix[(1, 3)], matrix[(3, 1)]) = (-moment, -moment);

        // Roll and pitch are pendulums: w = sqrt(W (z_g - z_b) / I).
        let pendulum = |inertia: f64| (mass * GRAVITY * METACENTRE / inertia).sqrt();
        let swing = |i: usize, ratio: f64| matrix[(i, i)] * 2.0 * ratio * pendulum(matrix[(i, i)]);
        let damping = Vector6::new(
            matrix[(0, 0)] / SURGE_TIME,
            matrix[(1, 1)] / SWAY_TIME,
            matrix[(2, 2)] / HEAVE_TIME,
            swing(3, ROLL_DAMPING),
            swing(4, PITCH_DAMPING),
            matrix[(5, 5)] / YAW_TIME,
        );

        // The hull as a wing of low aspect ratio (Beard & McLain 2012).
        let area = 0.7 * LENGTH * DIAMETER;
        let aspect = DIAMETER * DIAMETER / area;
        let half = 0.5 * aspect;
        Fossen {
            mass,
            inertia,
            moment,
            added,
            inverse: InverseMass::of(&matrix),
            damping,
            wing: 0.5 * DENSITY * area,
            lift_slope: PI * aspect / (1.0 + (1.0 + half * half).sqrt()),
            drag: FRONT_DRAG * PI * b * b / area,
            induced_drag: 1.0 / (PI * OSWALD * aspect),
            cross_flow: CrossFlow::new(DENSITY, LENGTH, DIAMETER),
        }
    }

    /// What the surface makes of it.
    pub fn body(&self) -> Body {
        let heave_mass = self.mass + self.added[2];
        Body { weight: self.weight(), length: LENGTH, diameter: DIAMETER, heave_mass }
    }

    /// Its weight, and its buoyancy, N.
    fn weight(&self) -> f64 {
        self.mass * GRAVITY
    }

    /// Surge force and roll moment of the propeller, N and N m, at a speed through the water.
    #[inline]
    fn propeller(rpm: f64, speed: f64) -> (f64, f64) {
        let n = rpm / 60.0;
        let square = n.abs() * n;
        let advance = if n > 0.0 { WAKE * speed / PROPELLER * n } else { 0.0 };
        let scale = DENSITY * PROPELLER * PROPELLER * PROPELLER * PROPELLER;
        let thrust = scale * (THRUST_AT_REST * square + THRUST_SLOPE * advance);
        let torque = scale * PROPELLER * (TORQUE_AT_REST * square + TORQUE_SLOPE * advance);
        (THRUST_LEFT * thrust, TORQUE_LEFT * torque)
    }

    /// Coriolis and centripetal forces of the rigid body: (w x a, v x a + w x b) of its momenta a and b.
    #[inline]
    fn rigid_coriolis(&self, [u, v, w]: [f64; 3], [p, q, r]: [f64; 3]) -> Six {
        let (m, g) = (self.mass, self.moment);
        let a = [m * u + g * q, m * v - g * p, m * w];
        let b = [self.inertia[0] * p - g * v, self.inertia[1] * q + g * u, self.inertia[2] * r];
        Vector6::new(
            q * a[2] - r * a[1],
            r * a[0] - p * a[2],
            p * a[1] - q * a[0],
            v * a[2] - w * a[1] + q * b[2] - r * b[1],
            w * a[0] - u * a[2] + r * b[0] - p * b[2],
            u * a[1] - v * a[0] + p * b[1] - q * b[0],
        )
    }

    /// Those of the added mass. The published model leaves out eight elements of the matrix, by which an ellipsoid in a
    /// potential flow would be unstable in yaw and pitch.
    #[inline]
    fn added_coriolis(&self, [v, w]: [f64; 2], [p, q, r]: [f64; 3]) -> Six {
        let m_a = &self.added;
        let b = [m_a[3] * p, m_a[4] * q, m_a[5] * r];
        Vector6::new(
            0.0,
            -m_a[2] * w * p,
            m_a[1] * v * p,
            (m_a[2] - m_a[1]) * v * w + q * b[2] - r * b[1],
            r * b[0] - p * b[2],
            p * b[1] - q * b[0],
        )
    }
}

impl Plant for Fossen {
    #[inline]
    fn acceleration(
        &self,
        attitude: &Attitude,
        velocity: &Six,
        controls: &Controls,
        current: Vector,
        load: Load,
    ) -> Six {
        let [_, _, w, p, q, r] = (*velocity).into();
        // The published model turns the current with yaw alone, as if the hull were level.
        let current_ahead = current.north * attitude.cos_yaw + current.east * attitude.sin_yaw;
        let current_right = current.east * attitude.cos_yaw - current.north * attitude.sin_yaw;
        let (u, v) = (velocity[0] - current_ahead, velocity[1] - current_right);
        let across2 = u * u + w * w;
        let speed2 = across2 + v * v;
        let speed = speed2.sqrt();

        let rigid = self.rigid_coriolis([u, v, w], [p, q, r]);
        let added = self.added_coriolis([v, w], [p, q, r]);
        let fade = exp(-DAMPING_FADE * speed);
        let d = &self.damping;
        let damping = Vector6::new(d[0] * fade * u, d[1] * fade * v, d[2] * w, d[3] * p, d[4] * q, d[5] * r);

        // Lift and drag of the hull at its angle of attack.
        let (sin_attack, cos_attack) = if across2 > 0.0 {
            let across = across2.sqrt();
            (w / across, u / across)
        } else {
            (0.0, 1.0)
        };
        let lift = self.lift_slope * atan2(w, u);
        let drag = self.drag + self.induced_drag * lift * lift;
        let pressure = self.wing * speed2;
        let (lift, drag) = (pressure * lift, pressure * drag);

        let (sway_drag, yaw_drag) = self.cross_flow.drag(v, r);
        let (thrust, torque) = Fossen::propeller(controls.rpm, speed);
        let fin = -0.5 * DENSITY * FIN_AREA;
        let rudder = fin * RUDDER_LIFT * (u * u + v * v) * controls.rudder;
        let stern = fin * STERN_LIFT * across2 * controls.stern;

        // The centre of gravity below that of buoyancy rights it; weight that has become more acts at the origin.
        let heel = attitude.cos_pitch * attitude.sin_roll;
        let righting = METACENTRE * self.weight();
        let force = Vector6::new(
            thrust + rudder * controls.rudder + stern * controls.stern - cos_attack * drag + sin_attack * lift
                - load.down * attitude.sin_pitch,
            rudder - sway_drag + load.down * heel,
            stern - sin_attack * drag - cos_attack * lift + load.down * attitude.cos_pitch * attitude.cos_roll,
            torque - righting * heel,
            load.pitch - FIN_AT * stern - righting * attitude.sin_pitch,
            FIN_AT * rudder - yaw_drag,
        );
        let mut acceleration = self.inverse.accelerate(&(force - rigid - added - damping));
        // The current, seen from a frame that turns.
        acceleration[0] += r * current_right;
        acceleration[1] -= r * current_ahead;
        acceleration
    }
}

#[cfg(test)]
mod tests;
