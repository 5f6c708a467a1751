//! How a hull moved within a tick, step by step: what an inertial unit feels.

use super::Motion;
use super::six_dof::{Controls, State};
use albacore_geometry::{Attitude, wrap_angle};
use albacore_vehicle::TICK_S;
use nalgebra::Vector6;

/// The steps of a tick: where the hull was and how it moved before the first and after each, and what its actuators did in each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// One more than steps.
    pub states: Vec<State>,
    /// As many as steps; none of a hull without actuators.
    pub controls: Vec<Controls>,
}

/// Steps of a hull that has none of its own.
pub(crate) const LEVEL_STEPS: u32 = 10;

impl Track {
    /// Begins a tick at a state.
    pub(super) fn begin(&mut self, state: &State) {
        self.states.clear();
        self.controls.clear();
        self.states.push(*state);
    }

    /// A step with these controls has led to a state.
    pub(super) fn push(&mut self, controls: &Controls, state: &State) {
        self.controls.push(*controls);
        self.states.push(*state);
    }

    /// The tick ended in another state than its steps led to: where the bottom stopped it.
    pub(super) fn end_in(&mut self, state: &State) {
        match self.states.last_mut() {
            Some(last) if last != state => *last = *state,
            _ => {}
        }
    }

    /// Seconds of a step.
    pub fn step_s(&self) -> f64 {
        TICK_S / self.steps() as f64
    }

    /// So many steps.
    pub fn steps(&self) -> usize {
        self.states.len().saturating_sub(1).max(1)
    }

    /// A tick of a hull that stays level and has no steps of its own, from one motion to the next. Its velocity goes evenly from the mean
    /// over the tick before to that over this one: the same way in the end, half a tick late.
    pub(super) fn level(&mut self, before: &Motion, after: &Motion, sinks: [f64; 2]) {
        let turn = after.heading - before.heading;
        let yaw_rate = turn / TICK_S;
        self.states.clear();
        self.controls.clear();
        for step in 0..=LEVEL_STEPS {
            let share = f64::from(step) / f64::from(LEVEL_STEPS);
            let yaw = wrap_angle(before.heading.radians() + share * turn);
            let between = |from: f64, to: f64| from + share * (to - from);
            let place = before.position + share * (after.position - before.position);
            let over_ground = [
                between(before.ground_velocity.north, after.ground_velocity.north),
                between(before.ground_velocity.east, after.ground_velocity.east),
                between(sinks[0], sinks[1]),
            ];
            let [u, v, w] = Attitude::of(0.0, 0.0, yaw).to_body(over_ground);
            let depth = between(before.depth, after.depth);
            self.states.push(State {
                pose: Vector6::new(place.north, place.east, depth, 0.0, 0.0, yaw),
                velocity: Vector6::new(u, v, w, 0.0, 0.0, yaw_rate),
            });
        }
    }
}
