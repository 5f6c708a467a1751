//! A vehicle's own computer, in its front seat: the plan that it follows by itself, and how it answers who asks to drive.
//!
//! A simulated vehicle has one, and one serves a vehicle at the far end of a link: both are this. Nothing here knows how
//! commands come, nor how a hull moves. Positions are metres north and east, times seconds since tick 0.

mod control_arbiter;
mod own_plan;

pub use control_arbiter::Handover;
pub use own_plan::{Milestone, OwnPlan};

use albacore_geometry::{Heading, Point, Vector};
use albacore_guidance::{Route, through_water};
use albacore_vehicle::{Command, Control, Vertical};
use control_arbiter::ControlArbiter;

/// What the computer knows of its vehicle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// Where it believes to be.
    pub position: Point,
    /// Its course over ground.
    pub course: Heading,
    /// Its heading.
    pub heading: Heading,
    /// The latest estimate of the current, m/s.
    pub flow: Vector,
}

/// The computer.
#[derive(Clone, Debug)]
pub struct FrontSeat {
    plan: Option<OwnPlan>,
    vertical: Vertical,
    speed_max: f64,
    arbiter: ControlArbiter,
}

impl FrontSeat {
    /// One that follows a route, if it has any, from where the vehicle starts, and holds a depth or an altitude on it. `speed_max`:
    /// the greatest speed through the water, m/s.
    pub fn new(
        own: Option<(&Route, Vertical)>,
        handover: Handover,
        start: (Point, Heading),
        speed_max: f64,
    ) -> FrontSeat {
        let plan = own.map(|(route, _)| OwnPlan::new(route, start.0, start.1));
        let vertical = own.map_or(Vertical::Depth(0.0), |(_, vertical)| vertical);
        FrontSeat { plan, vertical, speed_max, arbiter: ControlArbiter::new(handover) }
    }

    /// The same, answering so who asks to drive.
    pub fn answering(self, handover: Handover) -> Self {
        FrontSeat { arbiter: ControlArbiter::new(handover), ..self }
    }

    /// Its own plan; none without a mission of its own.
    pub fn plan(&self) -> Option<&OwnPlan> {
        self.plan.as_ref()
    }

    /// What it holds on its own plan.
    pub fn vertical(&self) -> Vertical {
        self.vertical
    }

    /// Whether its own plan is done.
    pub fn is_over(&self) -> bool {
        self.plan.as_ref().is_some_and(OwnPlan::is_over)
    }

    /// Whether a guest drives.
    pub fn is_driven(&self) -> bool {
        self.arbiter.is_passed()
    }

    /// After a guest has left, it returns to the closest point of its leg, or to where the guest took over.
    pub fn return_to_closest_point(&mut self, closest: bool) {
        if let Some(plan) = &mut self.plan {
            plan.return_to_closest_point(closest);
        }
    }

    /// Somebody asks to drive; without conditions the computer gives way at once.
    pub fn ask(&mut self, now: f64, position: Point) -> Control {
        self.arbiter.ask(now);
        if self.arbiter.is_open() { self.answer(now, position) } else { Control::Requesting }
    }

    /// Who asks has waited long enough, and takes that for a no.
    pub fn turn_away(&mut self) {
        self.arbiter.turn_away();
    }

    /// The guest has given the vehicle back, or is heard no more.
    pub fn leave(&mut self, position: Point) {
        self.arbiter.leave();
        self.go_back(position);
    }

    /// Who drives now.
    pub fn answer(&mut self, now: f64, position: Point) -> Control {
        let was_driven = self.is_driven();
        let control = self.arbiter.answer(now, self.is_over());
        match (was_driven, self.is_driven(), &mut self.plan) {
            (false, true, Some(plan)) => _ = plan.leave(position),
            (true, false, _) => self.go_back(position),
            _ => {}
        }
        control
    }

    fn go_back(&mut self, position: Point) {
        if let Some(plan) = &mut self.plan {
            plan.go_back(position);
        }
    }

    /// What its own plan asks for in the coming tick; none without a plan. A plan that is done floats up and waits to be found.
    pub fn steer(&mut self, known: Known, report: &mut dyn FnMut(Milestone)) -> Option<Command> {
        let plan = self.plan.as_mut()?;
        let speed = plan.speed();
        Some(match plan.step(known.position, known.course, report) {
            Some(course) => {
                let water = through_water(course, speed, known.flow, self.speed_max);
                Command::new(water.heading, water.speed, self.vertical)
            }
            None => Command::still(known.heading, 0.0),
        })
    }
}
