//! A vehicle that sinks while it is slower than its fins need, over a bottom that rises or falls, and whose depth, altitude and link are
//! lost for a while, or tell what they told before.

use crate::random::Random;
use albacore_geometry::{Point, math};
use albacore_vehicle::{
    Command, Control, Measurement, Snapshot, TICK_S, Vehicle, VehicleError, Vertical, measurements,
};
use std::ops::Range;

pub struct Heavy {
    measurements: Vec<Measurement>,
    tick: u64,
    command: Option<Command>,
    position: Point,
    depth: f64,
    /// How fast it sinks, the speed at which its fins bite, and how fast they lift it, m/s.
    sinks: f64,
    fins_bite: f64,
    lifts: f64,
    /// The depth of the bottom at the start, m, and how much less it becomes in a metre to the north.
    bottom: f64,
    slope: f64,
    waves: f64,
    /// The ticks in which depth and altitude are lost, and those in which they are stuck.
    lost: [Range<u64>; 2],
    stuck: [Range<u64>; 2],
    told: [f64; 2],
    /// The ticks in which somebody else drives.
    suspended: Range<u64>,
}

impl Heavy {
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed, 4);
        let mut at_times = |percent: usize| {
            let from = random.bits() % 500;
            let lasts = if random.percent(percent) { 10 + random.bits() % 190 } else { 0 };
            from..from + lasts
        };
        let (lost, stuck) = ([at_times(15), at_times(30)], [at_times(25), at_times(15)]);
        let suspended = at_times(30);
        Heavy {
            measurements: measurements::all(),
            tick: 0,
            command: None,
            position: Point::ORIGIN,
            depth: [1.0, 4.0, 9.0, 13.0][random.below(4)],
            sinks: [0.0, 0.05, 0.15, 0.3, 0.6, 1.5][random.below(6)],
            // Some are never lifted.
            fins_bite: [0.5, 1.0, 1.5, 9.0][random.below(4)],
            lifts: [0.03, 0.3, 1.0][random.below(3)],
            bottom: 14.0 + 6.0 * random.uniform(),
            slope: 0.2 * random.uniform() - 0.1,
            waves: if random.percent(30) { 0.4 * random.uniform() } else { 0.0 },
            lost,
            stuck,
            told: [0.0; 2],
            suspended,
        }
    }

    fn live(&mut self) {
        let water = self.bottom - self.slope * self.position.north;
        if let Some(command) = self.command.filter(|_| !self.suspended.contains(&self.tick)) {
            self.position += command.speed * TICK_S * command.heading.unit();
            let goal = match command.vertical {
                Vertical::Depth(metres) => metres,
                Vertical::Altitude(metres) => water - metres,
            };
            let (up, down) = (self.lifts * TICK_S, TICK_S);
            self.depth +=
                if command.speed < self.fins_bite { self.sinks * TICK_S } else { (goal - self.depth).clamp(-up, down) };
        }
        self.depth = self.depth.clamp(0.0, water.max(0.0));
        let depth = self.depth + self.waves * math::sin(self.tick as f64 * TICK_S);
        for (i, now) in [depth, water - self.depth].into_iter().enumerate() {
            if !self.stuck[i].contains(&self.tick) {
                self.told[i] = now;
            }
        }
    }
}

impl Vehicle for Heavy {
    fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        snapshot.samples.clear();
        self.live();
        snapshot.push(measurements::POSITION, &[self.position.north, self.position.east, 1.0]);
        let heading = self.command.map_or(0.0, |command| command.heading.radians());
        snapshot.push(measurements::COURSE, &[heading]);
        snapshot.push(measurements::HEADING, &[heading]);
        for (i, measurement) in [measurements::DEPTH, measurements::ALTITUDE].into_iter().enumerate() {
            if !self.lost[i].contains(&self.tick) {
                snapshot.push(measurement, &[self.told[i]]);
            }
        }
        snapshot.control = if self.suspended.contains(&self.tick) { Control::Suspended } else { Control::InControl };
        self.tick += 1;
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.command = Some(*command);
        Ok(())
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        Ok(())
    }
}
