//! The computer in the vehicle's front seat: the plan that it follows by itself, and how it answers who asks to drive.

use crate::scenario::OwnMission;
use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::{OwnPlan, through_water};
use albacore_vehicle::{Command, Control, ControlArbiter, Handover, TICK_S, Vertical};

/// What the computer knows of its vehicle.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Known {
    pub position: Point,
    pub course: Heading,
    pub heading: Heading,
    /// The latest estimate of the current.
    pub flow: Vector,
}

/// The computer.
#[derive(Clone, Debug)]
pub(crate) struct Computer {
    plan: Option<OwnPlan>,
    vertical: Vertical,
    speed_max: f64,
    gate: ControlArbiter,
}

impl Computer {
    /// One that follows a plan, if it has any, from where the vehicle starts.
    pub fn new(
        own: Option<&OwnMission>,
        handover: Option<&Handover>,
        start: (Point, Heading),
        speed_max: f64,
    ) -> Computer {
        let plan = own.map(|own| OwnPlan::new(&own.route, start.0, start.1));
        let vertical = own.map_or(Vertical::Depth(0.0), |own| own.vertical);
        Computer { plan, vertical, speed_max, gate: ControlArbiter::new(handover.cloned().unwrap_or_default()) }
    }

    /// Somebody asks to drive; without a delay the computer gives way at once.
    pub fn ask(&mut self, now: f64, position: Point) -> Control {
        self.gate.ask(now);
        if self.gate.is_open() { self.answer(now, position) } else { Control::Requesting }
    }

    /// The guest gives the vehicle back.
    pub fn take_back(&mut self, position: Point) {
        self.gate.leave();
        if let Some(plan) = &mut self.plan {
            plan.go_back(position);
        }
    }

    /// Who drives now.
    pub fn answer(&mut self, now: f64, position: Point) -> Control {
        let was_driven = self.gate.is_passed();
        let is_over = self.plan.as_ref().is_some_and(OwnPlan::is_over);
        let control = self.gate.answer(now, is_over);
        if let Some(plan) = &mut self.plan {
            match (was_driven, self.gate.is_passed()) {
                (false, true) => _ = plan.leave(position),
                (true, false) => plan.go_back(position),
                _ => {}
            }
        }
        control
    }

    /// What its own plan asks for in the coming tick; none without a plan.
    pub fn steer(&mut self, known: Known) -> Option<Command> {
        let plan = self.plan.as_mut()?;
        let speed = plan.speed();
        Some(match plan.step(known.position, known.course, &mut |_| {}) {
            Some(course) => {
                let water = through_water(course, speed, known.flow, self.speed_max);
                Command { heading: water.heading, speed: water.speed, vertical: self.vertical }
            }
            // A plan that is done floats up and waits to be found.
            None => Command { heading: known.heading, speed: 0.0, vertical: Vertical::Depth(0.0) },
        })
    }

    /// What the plan is about, as the library's `enum VehicleMode` numbers it; none without a plan.
    pub fn mode(&self, control: Control) -> Option<f64> {
        let plan = self.plan.as_ref()?;
        Some(match control {
            Control::Suspended => 2.0,
            _ if plan.is_over() => 3.0,
            _ => 1.0,
        })
    }
}

/// Seconds after tick 0.
pub(crate) fn seconds(tick: u64) -> f64 {
    tick as f64 * TICK_S
}
