//! Six degrees of freedom: where a rigid body is and how it moves, in steps of the classic Runge-Kutta method.
//!
//! Notation and frames are those of T. I. Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control: the pose in the
//! north-east-down frame with Euler angles zyx, the velocity over ground in the body's own frame, x forward, y to starboard, z
//! down.

use super::surface::Surface;
use albacore_geometry::{Attitude, Vector};
use nalgebra::Vector6;

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

/// The attitude of a pose.
#[inline]
pub fn attitude_of(pose: &Six) -> Attitude {
    Attitude::of(pose[3], pose[4], pose[5])
}

/// How fast the pose changes: (2) of the 2016 paper, Fossen's J.
#[inline]
fn rates(attitude: Attitude, velocity: &Six) -> Six {
    let [u, v, w, p, q, r] = (*velocity).into();
    let [north, east, down] = attitude.to_ned([u, v, w]);
    let yaw = (attitude.sin_roll * q + attitude.cos_roll * r) / attitude.divisor();
    let (roll, pitch) = (p + attitude.sin_pitch * yaw, attitude.cos_roll * q - attitude.sin_roll * r);
    Vector6::new(north, east, down, roll, pitch, yaw)
}

/// The rate of change of a state.
#[inline]
fn derivative<P: Plant>(plant: &P, state: &State, controls: &Controls, around: &Surroundings) -> State {
    let attitude = attitude_of(&state.pose);
    let pose = rates(attitude, &state.velocity);
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
