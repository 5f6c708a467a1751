//! Fins and propeller: how far and how fast they follow what they are told, and what may go wrong with them.

use super::six_dof::Controls;
use albacore_geometry::math::{PI, exp};

/// What fins and propeller can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActuatorLimits {
    /// The greatest angle of a fin to either side, rad.
    pub fin: f64,
    /// The greatest turns of the propeller either way, 1/min.
    pub rpm: f64,
    /// Time constant with which a fin follows, s.
    pub fin_time: f64,
    /// Time constant with which the propeller follows, s.
    pub propeller_time: f64,
}

impl Default for ActuatorLimits {
    /// Those of the published model (PythonVehicleSimulator, `remus100.py`).
    fn default() -> Self {
        ActuatorLimits { fin: 15.0 * PI / 180.0, rpm: 1525.0, fin_time: 0.1, propeller_time: 1.0 }
    }
}

/// Actuators that no longer do as they are told: where each of them is stuck, if it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stuck {
    /// Angle of the rudder, rad.
    pub rudder: Option<f64>,
    /// Angle of the stern plane, rad.
    pub stern: Option<f64>,
    /// Turns of the propeller, 1/min.
    pub rpm: Option<f64>,
}

/// The actuators: lags of first order within limits.
#[derive(Clone, Debug)]
pub struct Actuators {
    limits: ActuatorLimits,
    /// What of the distance to its goal a fin and the propeller have left after half a step, and after a whole one.
    fin_left: [f64; 2],
    propeller_left: [f64; 2],
    /// Where they are.
    pub now: Controls,
    /// Which of them are stuck, and where.
    pub stuck: Stuck,
}

impl Actuators {
    /// At rest, neutral, for steps of `h` seconds.
    pub fn new(limits: ActuatorLimits, h: f64) -> Self {
        let left = |time_constant: f64| [exp(-0.5 * h / time_constant), exp(-h / time_constant)];
        Actuators {
            limits,
            fin_left: left(limits.fin_time),
            propeller_left: left(limits.propeller_time),
            now: Controls::default(),
            stuck: Stuck::default(),
        }
    }

    /// What they can do.
    pub fn limits(&self) -> &ActuatorLimits {
        &self.limits
    }

    /// The nearest to `wanted` that they can do: within their limits, and where they are stuck.
    pub fn within_limits(&self, wanted: &Controls) -> Controls {
        let ActuatorLimits { fin, rpm, .. } = self.limits;
        Controls {
            rudder: self.stuck.rudder.unwrap_or(wanted.rudder).clamp(-fin, fin),
            stern: self.stuck.stern.unwrap_or(wanted.stern).clamp(-fin, fin),
            rpm: self.stuck.rpm.unwrap_or(wanted.rpm).clamp(-rpm, rpm),
        }
    }

    /// Lets a step go by toward a goal within the limits: where they are at its beginning, in its middle and at its end.
    /// Exact for a goal that is held, and so as good as a Runge-Kutta step would be or better.
    #[inline]
    pub fn step(&mut self, goal: &Controls) -> [Controls; 3] {
        let from = Controls {
            rudder: self.stuck.rudder.map_or(self.now.rudder, |_| goal.rudder),
            stern: self.stuck.stern.map_or(self.now.stern, |_| goal.stern),
            rpm: self.stuck.rpm.map_or(self.now.rpm, |_| goal.rpm),
        };
        let after = |half: usize| Controls {
            rudder: goal.rudder + self.fin_left[half] * (from.rudder - goal.rudder),
            stern: goal.stern + self.fin_left[half] * (from.stern - goal.stern),
            rpm: goal.rpm + self.propeller_left[half] * (from.rpm - goal.rpm),
        };
        let (middle, end) = (after(0), after(1));
        self.now = end;
        [from, middle, end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(actuators: &mut Actuators, wanted: Controls, steps: u32) -> Controls {
        let goal = actuators.within_limits(&wanted);
        for _ in 0..steps {
            actuators.step(&goal);
        }
        actuators.now
    }

    #[test]
    fn they_follow_within_their_limits_with_their_time_constants() {
        let mut actuators = Actuators::new(ActuatorLimits::default(), 0.01);
        let hard = Controls { rudder: 1.0, stern: -0.1, rpm: 9000.0 };
        let soon = moved(&mut actuators, hard, 10);
        let share = 1.0 - exp(-1.0);
        assert!((soon.rudder - 15.0 * PI / 180.0 * share).abs() < 1e-12, "after one time constant");
        assert!((soon.stern + 0.1 * share).abs() < 1e-12);
        let late = moved(&mut actuators, hard, 2000);
        assert!((late.rpm - 1525.0).abs() < 1e-4 && (late.rudder - 15.0 * PI / 180.0).abs() < 1e-12);
    }

    #[test]
    fn half_a_step_twice_is_a_step() {
        let goal = Controls { rudder: 0.2, stern: 0.1, rpm: 1000.0 };
        let mut whole = Actuators::new(ActuatorLimits::default(), 0.02);
        let mut halves = Actuators::new(ActuatorLimits::default(), 0.01);
        let [_, middle, end] = whole.step(&goal);
        let (first, second) = (halves.step(&goal)[2], halves.step(&goal)[2]);
        for (a, b) in [(middle, first), (end, second)] {
            assert!((a.rudder - b.rudder).abs() < 1e-15 && (a.rpm - b.rpm).abs() < 1e-10);
        }
    }

    #[test]
    fn what_is_stuck_stays_whatever_it_is_told_and_is_free_again() {
        let mut actuators = Actuators::new(ActuatorLimits::default(), 0.01);
        actuators.stuck = Stuck { rudder: Some(0.1), rpm: Some(0.0), ..Stuck::default() };
        let wanted = Controls { rudder: -0.2, stern: 0.2, rpm: 1500.0 };
        let now = moved(&mut actuators, wanted, 500);
        assert_eq!((now.rudder, now.rpm), (0.1, 0.0));
        assert!((now.stern - 0.2).abs() < 1e-12, "the other fin obeys");
        actuators.stuck = Stuck::default();
        assert!((moved(&mut actuators, wanted, 500).rudder + 0.2).abs() < 1e-12);
    }
}
