//! One measurement by itself: silence, numbers that are none or cannot be, jumps, and a noisy value that stands still.

use super::noise::Noise;
use super::{Anomalies, Anomaly, Credible};
use albacore_vehicle::measurements::{MeasurementInfo, info};
use albacore_vehicle::{Quantity, Reading, TICK_S};

/// Samples from whose times the period is learnt.
const PERIOD_SAMPLES: u64 = 10;
/// Silence is so many periods long, and at least so many ticks: 2 s.
const SILENT_PERIODS: u64 = 5;
const SILENT_TICKS: u64 = 20;
/// A measurement is noisy where it has never rested for more samples than this: a link may repeat what a slow sensor told.
const NOISE_REST_MAX: u64 = 12;
/// A noisy value stands still when it is the same for so many ticks, and in more samples than so many times what it has ever rested for. At
/// an end of its scale a sensor may well rest for a while.
const STUCK_TICKS: u64 = 50;
const STUCK_RESTS: u64 = 3;
const STUCK_AT_END_SAMPLES: u64 = 200;
/// A mean changes with every sample, but for so many that may be refused in a row.
const MEAN_SAMPLES: u64 = 60;
const MEAN_SAME_MAX: u64 = 7;

/// A measurement and what is remembered of it.
#[derive(Clone, Debug)]
pub(super) struct Watched {
    /// Its number, and what it measures.
    number: u16,
    of: &'static MeasurementInfo,
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

impl Watched {
    pub fn new(number: u16) -> Self {
        Watched {
            number,
            of: info(number),
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
        let numbers = &reading[..self.of.quantity.width()];
        if numbers.iter().any(|x| !x.is_finite()) {
            anomalies.see(Anomaly::NotANumber(self.number));
            return None;
        }
        if !self.of.quantity.can_be(reading) {
            anomalies.see(Anomaly::OutOfRange(self.number));
            return None;
        }
        let Some((before, since)) = self.reading else {
            self.reading = Some((reading, tick));
            return Some(Credible { reading, same: 0, lively: false });
        };
        let follows = self.of.can_follow(reading, before, gap as f64 * TICK_S);
        if before == reading {
            self.same += 1;
            // It is well again when it changes, not when it happens to fit what it says.
            if anomalies.last_seen(Anomaly::Stuck(self.number)).is_some_and(|last| last >= since) {
                anomalies.see(Anomaly::Stuck(self.number));
            }
        } else {
            // A rest that was told of says nothing of how long it rests when all is well, and its end nothing of its noise; nor
            // does what no vehicle can do.
            if !anomalies.sees(Anomaly::Stuck(self.number)) {
                self.same_most = self.same_most.max(self.same);
                if follows && self.learns {
                    self.noise.learn(self.of.quantity.step(reading, before));
                }
            }
            self.same = 0;
        }
        let since = if self.same > 0 { since } else { tick };
        self.reading = Some((reading, since));
        // That a flow stands still is asked elsewhere: its profiler may not measure.
        let is_flow = self.of.quantity == Quantity::Flow;
        let lively = is_flow && self.is_lively();
        if !is_flow && self.same > 0 && self.same >= self.stuck_samples(reading[0]) && self.is_lively() {
            anomalies.see(Anomaly::Stuck(self.number));
        }
        if !follows {
            anomalies.see(Anomaly::Jumps(self.number));
            return None;
        }
        Some(Credible { reading, same: tick - since, lively })
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
            anomalies.see(Anomaly::Silent(self.number));
        }
    }

    /// Whether the measurement has shown that it never stays the same for long.
    fn is_lively(&self) -> bool {
        match self.of.quantity {
            // Whether it stands still under way is asked elsewhere; at rest it may.
            Quantity::Position => false,
            Quantity::Flow => self.samples >= MEAN_SAMPLES && self.same_most <= MEAN_SAME_MAX,
            quantity => {
                let is_steered = matches!(quantity, Quantity::Direction | Quantity::Speed);
                !self.moves && self.same_most <= NOISE_REST_MAX && self.noise.is_shown(self.period_ticks(), is_steered)
            }
        }
    }

    fn stuck_samples(&self, value: f64) -> u64 {
        match self.of.quantity {
            // At full scale it may rest as long as the water is full of it.
            Quantity::Ratio if value >= 1.0 => u64::MAX,
            Quantity::Ratio | Quantity::Height if value <= 0.0 => STUCK_AT_END_SAMPLES,
            _ => (STUCK_TICKS / self.period_ticks()).max(STUCK_RESTS * (self.same_most + 1) + 1),
        }
    }

    /// Ticks between samples; 1 until it is learnt.
    fn period_ticks(&self) -> u64 {
        self.period.unwrap_or(1).max(1)
    }
}
