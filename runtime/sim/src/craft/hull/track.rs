//! How a hull moved within a tick, step by step: what an inertial unit feels.

use super::Motion;
use super::six_dof::{Controls, State};
use albacore_geometry::{Attitude, Vector, wrap_angle};
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

    /// A tick of a hull that stays level and has no steps of its own, from one motion to the next, in which it sank so fast before it and in
    /// it, m/s. Its velocity over ground changes at once when the tick begins, for over a tick it is one.
    pub(super) fn level(&mut self, before: &Motion, after: &Motion, sinks: [f64; 2]) {
        let turn = after.heading - before.heading;
        let yaw_rate = turn / TICK_S;
        self.states.clear();
        self.controls.clear();
        for step in 0..=LEVEL_STEPS {
            let share = f64::from(step) / f64::from(LEVEL_STEPS);
            let yaw = wrap_angle(before.heading.radians() + share * turn);
            let place = before.position + share * (after.position - before.position);
            let (motion, sinks) = if step == 0 { (before, sinks[0]) } else { (after, sinks[1]) };
            let Vector { north, east } = motion.ground_velocity;
            let [u, v, w] = Attitude::of(0.0, 0.0, yaw).to_body([north, east, sinks]);
            let depth = before.depth + share * (after.depth - before.depth);
            self.states.push(State {
                pose: Vector6::new(place.north, place.east, depth, 0.0, 0.0, yaw),
                velocity: Vector6::new(u, v, w, 0.0, 0.0, yaw_rate),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::{Heading, Point};

    #[test]
    fn the_velocity_of_a_level_tick_leads_to_where_it_ends() {
        let before = Motion { ground_velocity: Vector::new(1.0, 0.0), depth: 5.0, ..Motion::default() };
        let after = Motion {
            position: Point::new(0.1, 0.05),
            heading: Heading::from_degrees(1.0),
            ground_velocity: Vector::new(1.0, 0.5),
            depth: 5.02,
            ..before
        };
        let mut track = Track::default();
        track.level(&before, &after, [0.0, 0.2]);
        assert_eq!((track.states.len(), track.steps(), track.step_s()), (11, 10, 0.01));
        let way = track.states[1..].iter().fold([0.0; 3], |way, state| {
            let [u, v, w, ..] = std::array::from_fn::<f64, 6, _>(|i| state.velocity[i]);
            let step = Attitude::of(0.0, 0.0, state.pose[5]).to_ned([u, v, w]);
            std::array::from_fn(|i| way[i] + 0.01 * step[i])
        });
        assert!((way[0] - 0.1).abs() < 1e-12 && (way[1] - 0.05).abs() < 1e-12 && (way[2] - 0.02).abs() < 1e-12);
    }
}
