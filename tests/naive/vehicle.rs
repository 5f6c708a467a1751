//! A vehicle that goes where it is told, ten times as fast as it should, and whose sensors and link are as bad as chance has it.

use crate::host::{Host, PLAN};
use crate::random::Random;
use albacore_geometry::{Heading, Point};
use albacore_vehicle::{
    Answer, Command, Control, Measurement, Snapshot, TICK_S, Vehicle, VehicleError, Vertical, measurements,
};

/// So much faster than life: what takes minutes at sea takes some dozens of ticks.
const HASTE: f64 = 10.0;
const BOTTOM_M: f64 = 20.0;
/// When it begins: 2026-08-14T05:00:10Z, in seconds since 1970.
const DATE_S: f64 = 1_786_683_610.0;

/// What sensors may tell that nobody would believe.
const ABSURD: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.5,
    3.0,
    5e-324,
    1e-150,
    9007199254740992.0,
    -9007199254740992.0,
    9007199254740994.0,
    1e150,
    -1e150,
    1.1e150,
    f64::INFINITY,
    f64::NAN,
];

pub struct Chance {
    /// Whether its sensors tell absurd numbers.
    is_absurd: bool,
    measurements: Vec<Measurement>,
    random: Random,
    tick: u64,
    position: Point,
    command: Command,
    depth: f64,
    chemical: f64,
    /// Until which tick each measurement is silent, and the link suspended.
    silent: Vec<u64>,
    suspended: u64,
    /// How it ends, if by the vehicle, and when.
    end: Option<(u64, Control)>,
    first_driven: u64,
    /// What its payload will answer, and in which tick.
    answers: Vec<(u64, Answer)>,
    whim: Random,
    /// It runs a plan of its own, and is driven when it likes.
    host: Option<Host>,
    told: Control,
}

impl Chance {
    /// One whose sensors tell absurd numbers, and on a measurement `told` four of them.
    pub fn absurd(seed: u64) -> Self {
        let mut vehicle = Chance { is_absurd: true, ..Chance::new(seed) };
        vehicle.measurements.push(Measurement { name: "told".to_string(), ..vehicle.measurements[0].clone() });
        vehicle
    }

    /// One with a plan of its own.
    pub fn host(seed: u64) -> Self {
        Chance { host: Some(Host::new(seed)), first_driven: 0, ..Chance::new(seed) }
    }

    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed, 2);
        let measurements = measurements::all();
        let ends = [Control::Released, Control::TimedOut, Control::Disconnected, Control::Refused];
        let end = random.percent(8).then(|| (1 + random.bits() % 150, ends[random.below(ends.len())]));
        Chance {
            is_absurd: false,
            silent: (0..measurements.len()).map(|_| if random.percent(15) { random.bits() % 12 } else { 0 }).collect(),
            measurements,
            tick: 0,
            position: Point::new(40.0 * random.uniform() - 20.0, 40.0 * random.uniform() - 20.0),
            command: Command {
                heading: Heading::from_degrees(360.0 * random.uniform()),
                speed: 0.0,
                vertical: Vertical::Depth(3.0),
            },
            depth: 3.0,
            chemical: 0.0,
            suspended: 0,
            end,
            first_driven: 1 + random.bits() % 3,
            answers: Vec::new(),
            whim: Random::new(seed, 3),
            host: None,
            told: Control::Monitoring,
            random,
        }
    }

    fn live(&mut self) {
        if self.host.is_some() && !matches!(self.told, Control::InControl | Control::Suspended) {
            self.command = PLAN;
        }
        let way = HASTE * self.command.speed * TICK_S;
        self.position += way * self.command.heading.unit();
        let goal = match self.command.vertical {
            Vertical::Depth(metres) => metres,
            Vertical::Altitude(metres) => BOTTOM_M - metres,
        };
        self.depth += (goal - self.depth).clamp(-0.5, 0.5);
        if self.random.percent(20) {
            self.chemical = 0.1 * self.random.uniform();
        }
        for silent in &mut self.silent {
            if self.random.bits().is_multiple_of(300) {
                *silent = self.tick + self.random.bits() % 25;
            }
        }
        if self.random.bits().is_multiple_of(250) {
            self.suspended = self.tick + self.random.bits() % 10;
        }
    }
}

impl Vehicle for Chance {
    fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        snapshot.samples.clear();
        snapshot.answers.clear();
        let come = self.answers.iter().filter(|(tick, _)| *tick == self.tick);
        snapshot.answers.extend(come.map(|(_, answer)| *answer));
        self.live();
        let mut say = |vehicle: &mut Self, measurement: u16, numbers: &[f64]| {
            if vehicle.tick >= vehicle.silent[usize::from(measurement)] {
                snapshot.push(measurement, numbers);
            }
        };
        let heading = self.command.heading.radians();
        let sigma = 5.0 * self.random.uniform();
        say(self, measurements::POSITION, &[self.position.north, self.position.east, sigma]);
        say(self, measurements::COURSE, &[heading]);
        say(self, measurements::HEADING, &[heading]);
        say(self, measurements::SPEED, &[self.command.speed]);
        say(self, measurements::DEPTH, &[self.depth]);
        say(self, measurements::ALTITUDE, &[BOTTOM_M - self.depth]);
        if self.random.percent(60) {
            say(self, measurements::WATER_DEPTH, &[BOTTOM_M]);
        }
        if self.tick.is_multiple_of(5) {
            let flow = [0.4 * self.random.uniform() - 0.2, 0.4 * self.random.uniform() - 0.2];
            say(self, measurements::FLOW, &flow);
        }
        for _ in 0..self.random.below(4) {
            let noise = if self.random.percent(3) { f64::NAN } else { 0.02 * self.random.uniform() };
            let chemical = self.chemical + noise;
            say(self, measurements::CHEMICAL, &[chemical]);
        }
        if self.tick.is_multiple_of(10) {
            let utc = DATE_S + self.tick as f64 * TICK_S;
            say(self, measurements::UTC, &[utc]);
        }
        if self.tick.is_multiple_of(7) {
            let battery = 1.0 - self.tick as f64 / 400.0;
            say(self, measurements::BATTERY, &[battery]);
        }
        if self.is_absurd {
            snapshot.push(self.measurements.len() as u16 - 1, &[0.0; 4]);
            for number in snapshot.samples.iter_mut().flat_map(|sample| &mut sample.reading) {
                if self.random.percent(30) {
                    *number = ABSURD[self.random.below(ABSURD.len())];
                }
            }
        }
        snapshot.control = match self.end {
            Some((tick, control)) if self.tick >= tick => control,
            _ if self.tick < self.first_driven => Control::Monitoring,
            _ if self.host.is_some() => self.host.as_mut().map_or(Control::InControl, Host::tick),
            _ if self.tick < self.suspended => Control::Suspended,
            _ => Control::InControl,
        };
        self.told = snapshot.control;
        self.tick += 1;
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.host.iter_mut().for_each(Host::take_over);
        Ok(())
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.command = *command;
        let is_ours = self.told == Control::InControl;
        is_ours.then_some(()).ok_or_else(|| VehicleError("a command, and nobody has let us drive".to_string()))
    }

    /// One in five is never answered, and some are answered twice, or by what nobody asked.
    fn ask(&mut self, id: u64, _: &str) -> Result<(), VehicleError> {
        let value = [Some(true), Some(false), None][self.whim.below(3)];
        let at = self.tick + self.whim.bits() % 12;
        match self.whim.below(10) {
            0 | 1 => {}
            2 => self.answers.extend([(at, Answer { id, value }), (at + 1, Answer { id, value: None })]),
            3 => self.answers.extend([(at, Answer { id: id + 7, value }), (at, Answer { id, value })]),
            _ => self.answers.push((at, Answer { id, value })),
        }
        Ok(())
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.host.iter_mut().for_each(Host::give_back);
        Ok(())
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }
}
