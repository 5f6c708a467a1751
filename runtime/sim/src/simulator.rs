//! The simulator: one world, one vehicle in it, behind the port.

use crate::craft::fault::Faults;
use crate::craft::hull::{Hull, StartPose, Track};
use crate::craft::incidents::Incidents;
use crate::craft::payload::PayloadBay;
use crate::craft::sensors::{Instruments, Step, Surroundings};
use crate::scenario::{Scenario, ScenarioError};
use crate::world::World;
use crate::world::survey::Survey;
use albacore_front_seat::{FrontSeat, Known};
use albacore_geometry::{Point, Vector};
use albacore_navigation::Estimate;
use albacore_vehicle::measurements::VEHICLE_MODE;
use albacore_vehicle::{
    Beyond, Command, Control, LimitWatch, Limits, Measurement, NavigationErrors, REQUEST_TICKS, Snapshot, TICK_S,
    Truth, Vehicle, VehicleError, Vertical,
};

/// Ticks between what the vehicle tells of its own mission.
const MODE_TICKS: u64 = 10;

/// What a vehicle lets go of that gives up, kg in the water: it floats up then though it be as heavy as the water.
const DROP_WEIGHT_KG: f64 = 2.0;

/// A simulated vehicle in a simulated world.
#[derive(Clone, Debug)]
pub struct Simulator {
    measurements: Vec<Measurement>,
    world: World,
    vehicle: Hull,
    /// How the hull moved within the last tick, where an inertial unit feels it.
    track: Option<Track>,
    instruments: Instruments,
    endurance: f64,
    /// The battery is empty.
    spent: bool,
    front_seat: FrontSeat,
    watch: LimitWatch,
    control: Control,
    /// When somebody asked to drive, ticks.
    asked: u64,
    /// The same as it was told last.
    told: Control,
    command: Option<Command>,
    /// What it did in the last tick, whoever wanted it.
    did: Option<Command>,
    truth: Truth,
    /// Where the chemical sensor's intake is, and its height above the bottom, m.
    intake: (Point, f64),
    incidents: Incidents,
    faults: Faults,
    payload: PayloadBay,
    /// The tick last sensed; none before the first.
    tick: Option<u64>,
}

impl Simulator {
    /// The world of a scenario before its first tick.
    pub fn new(scenario: &Scenario, seed: u64) -> Result<Self, ScenarioError> {
        scenario.validate()?;
        let world = World::new(scenario, seed);
        let vehicle = scenario.vehicle.placed(seed);
        let start = vehicle.start;
        let altitude = world.water_depth(start) - vehicle.depth;
        let flow = world.flow(start, altitude, 0.0);
        let berth = StartPose::of(&vehicle, flow);
        let takes_raw = scenario.instruments.inertial().is_some();
        let mut simulator = Simulator {
            measurements: scenario.measurements(),
            vehicle: Hull::new(&vehicle, flow, seed),
            track: takes_raw.then(Track::default),
            instruments: Instruments::new(
                (&scenario.instruments, &vehicle.hull),
                &scenario.limits(),
                &world,
                &berth,
                seed,
            ),
            world,
            endurance: vehicle.endurance,
            spent: false,
            front_seat: FrontSeat::new(
                scenario.own_mission.as_ref().map(|own| (&own.route, own.vertical)),
                scenario.handover.clone().unwrap_or_default(),
                (start, vehicle.heading),
                scenario.limits().speed.unwrap_or(f64::INFINITY),
            ),
            watch: LimitWatch::new(scenario.limits()),
            control: Control::Disconnected,
            asked: 0,
            told: Control::Disconnected,
            command: None,
            did: None,
            truth: Truth::default(),
            intake: (start, 0.0),
            incidents: Incidents::new(&scenario.environment.no_go),
            faults: Faults::new(&scenario.faults, takes_raw, seed),
            payload: PayloadBay::new(&scenario.payloads, seed),
            tick: None,
        };
        simulator.observe();
        Ok(simulator)
    }

    /// What is so at the tick last sensed.
    pub fn truth(&self) -> Truth {
        self.truth
    }

    /// What the vehicle's inertial navigator believes beside what is so, where it has one.
    pub fn navigation(&self) -> Option<NavigationErrors> {
        self.instruments.navigation_errors(self.track.as_ref()?.states.last()?)
    }

    /// Seconds since tick 0, at the tick last sensed.
    pub fn time_s(&self) -> f64 {
        self.tick.unwrap_or(0) as f64 * TICK_S
    }

    /// The water's true depth at a point, m.
    pub fn water_depth(&self, p: Point) -> f64 {
        self.world.water_depth(p)
    }

    /// The water's velocity now at a point and a height above the bottom (m), m/s toward.
    pub fn flow(&self, p: Point, height: f64) -> Vector {
        self.world.flow(p, height, self.time_s())
    }

    /// The flow that carries the plume, m/s toward, at a point: below the upper layer, without waves.
    pub fn carrying_flow(&self, p: Point) -> Vector {
        self.world.carrying_flow(p, self.time_s())
    }

    /// The plume's filaments now: where they are, and their radii (standard deviations of Gaussians) in metres.
    pub fn filaments(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        self.world.filaments(self.time_s())
    }

    /// What a perfect chemical sensor without saturation would read now at a point and a height above the bottom (m): a ratio
    /// of full scale; the vehicle's own is in [`Simulator::truth`]. It searches the whole plume: for more than a few places take
    /// [`Simulator::survey`].
    pub fn concentration(&self, p: Point, height: f64) -> f64 {
        self.world.look_up(p, height, self.time_s())
    }

    /// The chemical now, for looks at many places.
    pub fn survey(&self) -> Survey {
        self.world.survey(self.time_s())
    }

    /// Moves the world from the last tick to this one.
    fn advance(&mut self, tick: u64) -> Result<(), VehicleError> {
        self.world.advance_to(tick);
        let ailing = *self.faults.ailing();
        let flow = self.world.flow(self.vehicle.motion().position, self.truth.altitude, (tick as f64 - 0.5) * TICK_S);
        let flow = flow + ailing.current;
        let command = match self.control {
            _ if self.gives_up() => Some(self.float_up()),
            Control::InControl => self.command,
            // A fix, or a fault: it stays where it is.
            Control::Suspended => None,
            _ => self.front_seat.steer(self.known(), &mut |_| {}),
        };
        let water_depth = self.water_depth_here();
        let command = command.map(|command| self.watch.clamp_command(tick, &command, water_depth));
        self.did = command;
        self.vehicle.stick_rudder(ailing.rudder);
        self.vehicle.flood(ailing.water - if self.gives_up() { DROP_WEIGHT_KG } else { 0.0 });
        let weighed = command.map(|command| self.by_weight(&command, tick));
        self.vehicle
            .step(tick, weighed.as_ref(), flow, |p| self.world.water_depth(p), self.track.as_mut())
            .map_err(|why| VehicleError(why.to_string()))?;
        let motion = self.vehicle.motion();
        let altitude = self.world.water_depth(motion.position) - motion.depth;
        let step = Step { tick, motion, altitude, track: self.track.as_ref() };
        self.instruments.step(&step, &self.world, &mut self.faults);
        let end = self.track.as_ref().and_then(|track| track.states.last());
        if let Some(misjudged) = end.and_then(|state| self.instruments.misjudged(state)) {
            self.vehicle.misjudge(&misjudged);
        }
        Ok(())
    }

    /// The true depth that a command comes to. A hull holds a depth by the weight of the water over it, as its gauge tells it: under a
    /// wave's crest it holds one that is less. At the surface it stays.
    fn by_weight(&self, command: &Command, tick: u64) -> Command {
        let Truth { position, altitude, .. } = self.truth;
        let head = || self.world.wave_head(position, altitude, (tick as f64 - 1.0) * TICK_S);
        let vertical = match command.vertical {
            Vertical::Depth(depth) if depth > 0.0 => Vertical::Depth((depth - head()).max(0.0)),
            vertical => vertical,
        };
        Command { vertical, ..*command }
    }

    /// How deep the water is where the vehicle is, m.
    fn water_depth_here(&self) -> f64 {
        self.truth.depth + self.truth.altitude
    }

    /// Whether nobody can drive it any more.
    fn gives_up(&self) -> bool {
        self.faults.ailing().leaks || self.spent
    }

    /// What a vehicle does that gives up.
    fn float_up(&self) -> Command {
        Command::still(self.truth.heading, 0.0)
    }

    /// What the front seat knows.
    fn known(&self) -> Known {
        Known {
            position: self.instruments.position(self.truth.position),
            course: self.truth.course,
            heading: self.truth.heading,
            flow: self.instruments.flow(),
        }
    }

    /// What its own mission is about, as the library's `enum VehicleMode` numbers it; none without one.
    fn mode(&self) -> Option<f64> {
        self.front_seat.plan()?;
        Some(match self.control {
            Control::Suspended => 2.0,
            _ if self.front_seat.is_over() => 3.0,
            _ => 1.0,
        })
    }

    /// Notes what is so now.
    fn observe(&mut self) {
        let v = self.vehicle.motion();
        let time = self.time_s();
        let altitude = self.world.water_depth(v.position) - v.depth;
        self.intake = self.instruments.intake(v, &self.world);
        let (intake, height) = self.intake;
        self.truth = Truth {
            position: v.position,
            heading: v.heading,
            pitch: v.pitch,
            roll: v.roll,
            course: v.ground_velocity.toward(),
            speed_over_ground: v.ground_velocity.length(),
            depth: v.depth,
            altitude,
            flow: self.world.flow(v.position, altitude, time) + self.faults.ailing().current,
            concentration: self.world.concentration(intake, height, time),
        };
    }

    /// Notes what befell the vehicle.
    fn note_incidents(&mut self) {
        let Truth { position, depth, altitude, .. } = self.truth;
        self.incidents.observe(position, depth + altitude, self.vehicle.motion().aground || altitude <= 0.0);
    }

    /// Adds what it tells at a tick.
    fn measure(&mut self, tick: u64, snapshot: &mut Snapshot) {
        let mut around = Surroundings {
            tick,
            world: &mut self.world,
            truth: &self.truth,
            intake: self.intake,
            ground_velocity: self.vehicle.motion().ground_velocity,
            current: self.faults.ailing().current,
            charge: (1.0 - tick as f64 * TICK_S / self.endurance).max(0.0),
            compass: self.truth.heading,
            believed: Estimate { position: self.truth.position, sigma: 0.0 },
        };
        self.instruments.measure(&mut around, snapshot);
        if tick.is_multiple_of(MODE_TICKS)
            && let Some(mode) = self.mode()
        {
            snapshot.push(VEHICLE_MODE, &[mode]);
        }
    }
}

impl Vehicle for Simulator {
    fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        let tick = self.tick.map_or(0, |tick| tick + 1);
        if let Some(why) = self.world.end_before(tick) {
            return Err(VehicleError(why));
        }
        self.faults.advance_to(tick);
        if tick > 0 {
            self.advance(tick)?;
        }
        self.tick = Some(tick);
        self.observe();
        self.note_incidents();
        if !self.spent && self.time_s() >= self.endurance {
            self.spent = true;
            self.incidents.notice("the battery is empty: the vehicle floats up");
        }
        if self.gives_up() {
            // Who has asked, and has not been told yet that he drives, is to have an answer.
            let drives = matches!(self.told, Control::InControl | Control::Suspended);
            let has_asked = matches!(self.control, Control::Requesting | Control::InControl);
            let is_refused = self.control == Control::Refused || has_asked && !drives;
            self.control = if is_refused { Control::Refused } else { Control::Released };
        } else if self.control != Control::Released {
            if self.control == Control::Requesting && tick.saturating_sub(self.asked) > REQUEST_TICKS {
                let seconds = REQUEST_TICKS as f64 * TICK_S;
                self.incidents.notice(&format!("the vehicle did not let us drive for {seconds} s: it did not answer"));
                self.front_seat.turn_away();
            }
            self.control = self.front_seat.answer(tick as f64 * TICK_S, self.known().position);
        }
        snapshot.samples.clear();
        snapshot.answers.clear();
        self.payload.answer(tick, &mut snapshot.answers);
        snapshot.control = self.control;
        snapshot.aground = self.incidents.is_aground();
        self.told = self.control;
        self.measure(tick, snapshot);
        self.faults.filter(tick, &mut snapshot.samples);
        self.instruments.hear(&snapshot.samples);
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.command = None;
        if self.gives_up() {
            self.control = Control::Refused;
            return Ok(());
        }
        if self.control != Control::Requesting {
            self.asked = self.tick.unwrap_or_default();
        }
        self.control = self.front_seat.ask(self.time_s(), self.known().position);
        Ok(())
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        if self.control != Control::InControl {
            return Err(VehicleError(String::from("the vehicle was given a command before control of it was taken")));
        }
        if !command.is_finite() {
            return Err(VehicleError(String::from("the vehicle was given a command that is not a finite number")));
        }
        if !self.faults.ailing().deaf {
            self.command = Some(*command);
        }
        Ok(())
    }

    fn ask(&mut self, id: u64, action: &str) -> Result<(), VehicleError> {
        // One that gives up has let go of all else.
        if !self.gives_up() {
            self.payload.ask(self.tick.unwrap_or_default(), id, action);
        }
        Ok(())
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.front_seat.leave(self.known().position);
        self.control = Control::Monitoring;
        self.command = None;
        Ok(())
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        self.front_seat.leave(self.known().position);
        self.control = Control::Released;
        self.command = None;
        Ok(())
    }

    fn limits(&self) -> Limits {
        self.watch.limits().clone()
    }

    fn clamp_command(&self, asked: &Command, report: &mut dyn FnMut(Beyond)) {
        self.watch.limits().clamp_command(asked, Some(self.water_depth_here()), report);
    }

    fn held(&self) -> Option<Command> {
        match (self.control, &self.command) {
            // It was told since the last tick.
            (Control::InControl, Some(command)) if !self.gives_up() => {
                Some(self.watch.limits().clamp_command(command, Some(self.water_depth_here()), &mut |_| {}))
            }
            _ => self.did,
        }
    }

    fn notices(&mut self) -> Vec<String> {
        let mut notices = self.faults.take_notices();
        notices.extend(self.watch.take_notices());
        notices.extend(self.instruments.take_notices());
        notices.append(&mut self.incidents.take());
        notices
    }
}
