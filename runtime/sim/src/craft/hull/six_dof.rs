//! Six degrees of freedom: where a rigid body is and how it moves, in steps of the classic Runge-Kutta method.
//!
//! Notation and frames are those of T. I. Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control: the pose in the
//! north-east-down frame with Euler angles zyx, the velocity over ground in the body's own frame, x forward, y to starboard, z
//! down.

use super::surface::Surface;
use albacore_geometry::Vector;
use albacore_geometry::math::sin_cos;
use nalgebra::{Vector3, Vector6};

/// Six numbers of a body: three of translation, three of rotation.
pub type Six = Vector6<f64>;

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// North, east and down, m; roll, pitch and yaw, rad. Yaw is not wrapped.
    pub pose: Six,
    /// Surge, sway and heave over ground, m/s; rates of roll, pitch and yaw, rad/s; in the body's frame.
    pub velocity: Six,
}

/// What the actuators do at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls {
    /// Angle of the rudder, rad; positive turns to starboard.
    pub rudder: f64,
    /// Angle of the stern plane, rad; positive pitches the nose down.
    pub stern: f64,
    /// Turns of the propeller, 1/min.
    pub rpm: f64,
}

/// What acts on a body from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// The water's velocity, m/s toward; level.
    pub current: Vector,
    /// Buoyancy that has been lost, N: by water that came in.
    pub buoyancy_loss: f64,
    /// The surface; none: the water has no end above.
    pub surface: Option<Surface>,
}

/// What weighs on a hull besides its own weight and buoyancy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// A force down at the origin, N.
    pub down: f64,
    /// A moment that lifts the nose, N m.
    pub pitch: f64,
}

/// The dynamics of a hull: what accelerates it.
pub trait Plant {
    /// The acceleration of the body, in its own frame: m/s2 and rad/s2.
    fn acceleration(
        &self,
        attitude: &Attitude,
        velocity: &Six,
        controls: &Controls,
        current: Vector,
        load: Load,
    ) -> Six;
}

/// Sines and cosines of the Euler angles.
#[derive(Clone, Copy, Debug)]
pub struct Attitude {
    /// Of roll.
    pub sin_roll: f64,
    /// Of roll.
    pub cos_roll: f64,
    /// Of pitch.
    pub sin_pitch: f64,
    /// Of pitch.
    pub cos_pitch: f64,
    /// Of yaw.
    pub sin_yaw: f64,
    /// Of yaw.
    pub cos_yaw: f64,
}

/// Nose up or down by a right angle, roll and yaw are one: the cosine of pitch is held off 0 by this.
const COS_PITCH_MIN: f64 = 1e-6;

impl Attitude {
    /// Of a pose.
    #[inline]
    pub fn of(pose: &Six) -> Self {
        let ((sin_roll, cos_roll), (sin_pitch, cos_pitch), (sin_yaw, cos_yaw)) =
            (sin_cos(pose[3]), sin_cos(pose[4]), sin_cos(pose[5]));
        Attitude { sin_roll, cos_roll, sin_pitch, cos_pitch, sin_yaw, cos_yaw }
    }

    /// A vector of the body in the frame of north, east and down.
    #[inline]
    pub fn to_ned(self, v: Vector3<f64>) -> Vector3<f64> {
        // Roll, then pitch, then yaw.
        let starboard = self.cos_roll * v.y - self.sin_roll * v.z;
        let down = self.sin_roll * v.y + self.cos_roll * v.z;
        let ahead = self.cos_pitch * v.x + self.sin_pitch * down;
        Vector3::new(
            self.cos_yaw * ahead - self.sin_yaw * starboard,
            self.sin_yaw * ahead + self.cos_yaw * starboard,
            self.cos_pitch * down - self.sin_pitch * v.x,
        )
    }

    /// A vector of north, east and down in the frame of the body.
    #[inline]
    pub fn to_body(self, v: Vector3<f64>) -> Vector3<f64> {
        let ahead = self.cos_yaw * v.x + self.sin_yaw * v.y;
        let starboard = self.cos_yaw * v.y - self.sin_yaw * v.x;
        let below = self.sin_pitch * ahead + self.cos_pitch * v.z;
        Vector3::new(
            self.cos_pitch * ahead - self.sin_pitch * v.z,
            self.cos_roll * starboard + self.sin_roll * below,
            self.cos_roll * below - self.sin_roll * starboard,
        )
    }

    /// How fast the pose changes: (2) of the 2016 paper, Fossen's J.
    #[inline]
    fn rates(self, velocity: &Six) -> Six {
        let [u, v, w, p, q, r] = (*velocity).into();
        let over_ground = self.to_ned(Vector3::new(u, v, w));
        let cos_pitch = if self.cos_pitch.abs() < COS_PITCH_MIN { COS_PITCH_MIN } else { self.cos_pitch };
        let yaw = (self.sin_roll * q + self.cos_roll * r) / cos_pitch;
        let (roll, pitch) = (p + self.sin_pitch * yaw, self.cos_roll * q - self.sin_roll * r);
        Vector6::new(over_ground.x, over_ground.y, over_ground.z, roll, pitch, yaw)
    }
}

/// The rate of change of a state.
#[inline]
fn derivative<P: Plant>(plant: &P, state: &State, controls: &Controls, around: &Surroundings) -> State {
    let attitude = Attitude::of(&state.pose);
    let pose = attitude.rates(&state.velocity);
    let lost = around.surface.as_ref().map_or(Load::default(), |surface| surface.load(&attitude, state.pose[2], &pose));
    let load = Load { down: lost.down + around.buoyancy_loss, ..lost };
    State { pose, velocity: plant.acceleration(&attitude, &state.velocity, controls, around.current, load) }
}

/// The state after `h` seconds, by the classic Runge-Kutta method of fourth order; `controls` are those at the beginning, in
/// the middle and at the end of the step.
#[inline]
pub fn runge_kutta<P: Plant>(
    plant: &P,
    state: &State,
    controls: &[Controls; 3],
    around: &Surroundings,
    h: f64,
) -> State {
    let k1 = derivative(plant, state, &controls[0], around);
    let k2 = derivative(plant, &moved(state, &k1, 0.5 * h), &controls[1], around);
    let k3 = derivative(plant, &moved(state, &k2, 0.5 * h), &controls[1], around);
    let k4 = derivative(plant, &moved(state, &k3, h), &controls[2], around);
    let mean = |k1: Six, k2: Six, k3: Six, k4: Six| k1 + (k2 + k3) * 2.0 + k4;
    State {
        pose: state.pose + mean(k1.pose, k2.pose, k3.pose, k4.pose) * (h / 6.0),
        velocity: state.velocity + mean(k1.velocity, k2.velocity, k3.velocity, k4.velocity) * (h / 6.0),
    }
}

/// A state moved along its rate of change.
#[inline]
fn moved(state: &State, rate: &State, time: f64) -> State {
    State { pose: state.pose + rate.pose * time, velocity: state.velocity + rate.velocity * time }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frames_turn_into_one_another() {
        let attitude = Attitude::of(&Vector6::new(0.0, 0.0, 0.0, 0.3, -0.4, 2.0));
        let v = Vector3::new(1.0, -2.0, 3.0);
        let back = attitude.to_body(attitude.to_ned(v));
        assert!((back - v).amax() < 1e-14, "{back:?}");
    }

    #[test]
    fn a_nose_that_points_up_climbs_and_one_that_points_east_goes_there() {
        let nose =
            |pitch: f64, yaw: f64| Attitude::of(&Vector6::new(0.0, 0.0, 0.0, 0.0, pitch, yaw)).to_ned(Vector3::x());
        assert!((nose(0.1, 0.0).z + 0.1).abs() < 1e-3, "down is positive");
        assert!((nose(0.0, std::f64::consts::FRAC_PI_2).y - 1.0).abs() < 1e-15);
    }

    /// A body that nothing accelerates, but that turns: the frame of the body turns with it.
    struct Free;
    impl Plant for Free {
        fn acceleration(&self, _: &Attitude, velocity: &Six, _: &Controls, _: Vector, _: Load) -> Six {
            let [u, v, _, _, _, r] = (*velocity).into();
            Vector6::new(r * v, -r * u, 0.0, 0.0, 0.0, 0.0)
        }
    }

    #[test]
    fn the_method_is_of_fourth_order() {
        let start = State { velocity: Vector6::new(2.0, 0.0, 0.0, 0.0, 0.0, 1.0), ..State::default() };
        let error = |steps: u32| {
            let h = 4.0 / f64::from(steps);
            let still = (&[Controls::default(); 3], &Surroundings::default());
            let end = (0..steps).fold(start, |state, _| runge_kutta(&Free, &state, still.0, still.1, h));
            ((end.pose[0] - 8.0).abs() + end.pose[1].abs(), end.pose[5])
        };
        let (coarse, yaw) = error(40);
        assert!((yaw - 4.0).abs() < 1e-12);
        assert!((coarse / error(80).0 - 16.0).abs() < 1.0, "{} {}", coarse, error(80).0);
    }
}
