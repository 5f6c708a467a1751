//! One channel by itself: silence, numbers that are none or cannot be, jumps, and a noisy value that stands still.

use super::noise::Noise;
use super::{Anomalies, Anomaly, Credible};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};
use albacore_vehicle::{Reading, TICK_S};

/// Samples from whose times the period is learnt.
const PERIOD_SAMPLES: u64 = 10;
/// Silence is so many periods long, and at least so many ticks: 2 s.
const SILENT_PERIODS: u64 = 5;
const SILENT_TICKS: u64 = 20;
/// A channel is noisy where it has never rested for more samples than this: a link may repeat what a slow sensor told.
const NOISE_REST_MAX: u64 = 12;
/// A noisy value stands still when it is the same for so many ticks, and in more samples than so many times what it has ever rested for. At
/// an end of its scale a sensor may well rest for a while.
const STUCK_TICKS: u64 = 50;
const STUCK_RESTS: u64 = 3;
const STUCK_AT_END_SAMPLES: u64 = 200;
/// A mean changes with every sample, but for so many that may be refused in a row.
const MEAN_SAMPLES: u64 = 60;
const MEAN_SAME_MAX: u64 = 7;

/// What a channel tells of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Where the vehicle believes to be, and its standard deviation.
    Position,
    /// The direction over ground.
    Course,
    /// Where the nose points.
    Heading,
    /// The speed over ground.
    Speed,
    /// The depth.
    Depth,
    /// The height above the bottom.
    Altitude,
    /// The current.
    Flow,
    /// The chemical sensor.
    Chemical,
    /// What is left in the battery.
    Battery,
}

impl Kind {
    /// The channel's name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Position => "position",
            Kind::Course => "course",
            Kind::Heading => "heading",
            Kind::Speed => "speed",
            Kind::Depth => "depth",
            Kind::Altitude => "altitude",
            Kind::Flow => "flow",
            Kind::Chemical => "chemical",
            Kind::Battery => "battery",
        }
    }

    fn width(self) -> usize {
        match self {
            Kind::Position => 3,
            Kind::Flow => 2,
            _ => 1,
        }
    }

    /// Whether a reading can be: the ocean is 11 km deep, no tide runs at 10 m/s, no vehicle of ours at 15.
    pub(crate) fn can_be(self, reading: Reading) -> bool {
        let [a, b, c, _] = reading;
        match self {
            Kind::Position => a.abs() <= 1e5 && b.abs() <= 1e5 && c >= 0.0,
            Kind::Course | Kind::Heading => a.abs() <= 2.0 * PI,
            Kind::Speed => (-1.0..=15.0).contains(&a),
            Kind::Depth | Kind::Altitude => (-1.0..=11_000.0).contains(&a),
            Kind::Flow => Point::new(a, b).distance(Point::ORIGIN) <= 10.0,
            Kind::Chemical | Kind::Battery => (-0.1..=1.1).contains(&a),
        }
    }

    /// Whether one reading can follow another after some seconds.
    pub(crate) fn can_follow(self, now: Reading, before: Reading, time: f64) -> bool {
        let change = (now[0] - before[0]).abs();
        match self {
            Kind::Position => {
                // A fix may correct what both expect of their errors: six standard deviations, and 5 m for who tells none. The
                // later is no excuse for itself: its own error is no larger here than that of the one before.
                let own = now[2].min(before[2]);
                let error = (own * own + before[2] * before[2]).sqrt();
                let moved = Point::new(now[0], now[1]).distance(Point::new(before[0], before[1]));
                moved <= 10.0 * time + 6.0 * error + 5.0
            }
            Kind::Heading => {
                let turn = Heading::from_radians(now[0]) - Heading::from_radians(before[0]);
                turn.abs() <= PI / 3.0 * time + PI / 12.0
            }
            Kind::Speed => change <= 2.0 * time + 1.0,
            Kind::Depth => change <= 3.0 * time + 1.0,
            Kind::Altitude => change <= 5.0 * time + 1.2,
            Kind::Flow => Point::new(now[0], now[1]).distance(Point::new(before[0], before[1])) <= 1.0,
            // A gauge is coarse; a battery that is empty in a quarter of an hour is none of ours.
            Kind::Battery => change <= 0.001 * time + 0.1,
            // At rest the course is any, and the edge of a plume is sharp.
            Kind::Course | Kind::Chemical => true,
        }
    }
}

/// A channel and what is remembered of it.
#[derive(Clone, Debug)]
pub(super) struct Channel {
    kind: Kind,
    /// Samples so far, and the ticks of the first and of the last.
    samples: u64,
    first: u64,
    last: u64,
    /// Ticks between samples, once it is learnt.
    period: Option<u64>,
    /// The last reading that could be believed, and when it was first told.
    reading: Option<(Reading, u64)>,
    /// So many samples are the same as that, and so many were at most.
    same: u64,
    same_most: u64,
    noise: Noise,
    /// What changes is the vehicle, not the noise of its sensor.
    moves: bool,
    /// What changes may be the noise of its sensor.
    learns: bool,
}

impl Channel {
    pub fn new(kind: Kind) -> Self {
        Channel {
            kind,
            samples: 0,
            first: 0,
            last: 0,
            period: None,
            reading: None,
            same: 0,
            same_most: 0,
            noise: Noise::default(),
            moves: false,
            learns: true,
        }
    }

    /// A sample has come; given on when it can be believed by itself.
    pub fn hear(&mut self, tick: u64, reading: Reading, anomalies: &mut Anomalies) -> Option<Credible> {
        let gap = tick - self.last.min(tick);
        if self.samples == 0 {
            self.first = tick;
        }
        (self.samples, self.last) = (self.samples + 1, tick);
        if self.samples == PERIOD_SAMPLES + 1 {
            self.period = Some((tick - self.first) / PERIOD_SAMPLES);
        }
        let numbers = &reading[..self.kind.width()];
        if numbers.iter().any(|x| !x.is_finite()) {
            anomalies.see(Anomaly::NotANumber(self.kind));
            return None;
        }
        if !self.kind.can_be(reading) {
            anomalies.see(Anomaly::OutOfRange(self.kind));
            return None;
        }
        let Some((before, since)) = self.reading else {
            self.reading = Some((reading, tick));
            return Some(Credible { reading, same: 0, lively: false });
        };
        let follows = self.kind.can_follow(reading, before, gap as f64 * TICK_S);
        if before == reading {
            self.same += 1;
            // It is well again when it changes, not when it happens to fit what it says.
            if anomalies.last_seen(Anomaly::Stuck(self.kind)).is_some_and(|last| last >= since) {
                anomalies.see(Anomaly::Stuck(self.kind));
            }
        } else {
            // A rest that was told of says nothing of how long it rests when all is well, and its end nothing of its noise; nor
            // does what no vehicle can do.
            if !anomalies.sees(Anomaly::Stuck(self.kind)) {
                self.same_most = self.same_most.max(self.same);
                if follows && self.learns {
                    self.noise.learn(reading[0] - before[0]);
                }
            }
            self.same = 0;
        }
        let since = if self.same > 0 { since } else { tick };
        self.reading = Some((reading, since));
        let lively = self.is_lively();
        if lively && self.kind != Kind::Flow && self.same >= self.stuck_samples(reading[0]) {
            anomalies.see(Anomaly::Stuck(self.kind));
        }
        if !follows {
            anomalies.see(Anomaly::Jumps(self.kind));
            return None;
        }
        Some(Credible { reading, same: tick - since, lively })
    }

    pub fn is_of(&self, kind: Kind) -> bool {
        self.kind == kind
    }

    /// It may well be silent now, or tell the same again and again.
    pub fn excuse(&mut self, tick: u64) {
        (self.last, self.same) = (self.last.max(tick), 0);
    }

    /// Whether its changes are those of the vehicle.
    pub fn moves(&mut self, moves: bool) {
        self.moves = moves;
    }

    /// For how many ticks it has told the same.
    pub fn rests(&self, tick: u64) -> u64 {
        self.reading.map_or(0, |(_, since)| tick - since.min(tick))
    }

    /// Whether its changes tell of the noise of its sensor now.
    pub fn learns(&mut self, learns: bool) {
        self.learns = learns;
    }

    /// A tick has gone by.
    pub fn wait(&self, tick: u64, anomalies: &mut Anomalies) {
        let Some(period) = self.period else { return };
        if tick > self.last + (SILENT_PERIODS * period).max(SILENT_TICKS) {
            anomalies.see(Anomaly::Silent(self.kind));
        }
    }

    /// Whether the channel has shown that it never stays the same for long.
    fn is_lively(&self) -> bool {
        match self.kind {
            // Whether it stands still under way is asked elsewhere; at rest it may.
            Kind::Position => false,
            Kind::Flow => self.samples >= MEAN_SAMPLES && self.same_most <= MEAN_SAME_MAX,
            _ => !self.moves && self.same_most <= NOISE_REST_MAX && self.noise.is_shown(self.period_ticks()),
        }
    }

    fn stuck_samples(&self, value: f64) -> u64 {
        match self.kind {
            // At full scale it may rest as long as the water is full of it.
            Kind::Chemical if value >= 1.0 => u64::MAX,
            Kind::Chemical | Kind::Altitude | Kind::Depth if value <= 0.0 => STUCK_AT_END_SAMPLES,
            _ => (STUCK_TICKS / self.period_ticks()).max(STUCK_RESTS * (self.same_most + 1) + 1),
        }
    }

    /// Ticks between samples; 1 until it is learnt.
    fn period_ticks(&self) -> u64 {
        self.period.unwrap_or(1).max(1)
    }
}
