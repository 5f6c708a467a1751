//! One fault of a sensor at work: what becomes of the samples of each tick.

use super::sensor::Failing;
use super::{Sensor, SensorFault};
use crate::noise::{Noise, Stream};
use albacore_geometry::Heading;
use albacore_geometry::math::{PI, ln};
use albacore_vehicle::TICK_S;
use std::collections::VecDeque;

/// A sensor has this many measurements at most.
const CHANNELS_MAX: usize = 2;

/// A fault of a sensor, with what it must remember.
#[derive(Clone, Debug)]
pub(crate) struct Filter<S> {
    sensor: Sensor,
    disorder: SensorFault,
    noise: Noise,
    /// Draws made so far.
    draws: u64,
    /// Where a wrong position or flow is off.
    toward: Heading,
    /// The last sample of each measurement from before.
    last: Vec<S>,
    /// Samples on their way, and the tick at which each arrives.
    delayed: VecDeque<(u64, S)>,
    /// The tick from which on the next sample passes, where they are slow; the tick of the next turn, where they come and go.
    next: u64,
    passes: bool,
    /// What the gyroscope has missed, rad, and the heading that it should have had.
    missed: f64,
    turned_to: Option<(u64, f64)>,
}

impl<S: Failing> Filter<S> {
    /// The fault of this number of a run.
    pub fn new(sensor: Sensor, disorder: SensorFault, seed: u64, number: u32) -> Self {
        let direction = Noise::sub(seed, Stream::FaultDirection, number).uniform(0);
        Filter {
            sensor,
            disorder,
            noise: Noise::sub(seed, Stream::Fault, number),
            draws: 0,
            toward: Heading::from_radians(2.0 * PI * direction),
            last: Vec::with_capacity(CHANNELS_MAX),
            delayed: VecDeque::new(),
            next: 0,
            passes: true,
            missed: 0.0,
            turned_to: None,
        }
    }

    /// A tick before the fault, or after it: what was on its way is lost.
    pub fn watch(&mut self, tick: u64, samples: &[S]) {
        self.delayed.clear();
        (self.next, self.passes, self.missed) = (0, true, 0.0);
        for sample in samples.iter().filter(|s| s.is_of(self.sensor)) {
            self.last.retain(|known| !known.is_like(sample));
            self.last.push(*sample);
            if let Some(heading) = sample.heading() {
                self.turned_to = Some((tick, heading));
            }
        }
    }

    /// A tick of the fault.
    pub fn apply(&mut self, tick: u64, samples: &mut Vec<S>) {
        self.take_turns(tick);
        let mut came = false;
        let sensor = self.sensor;
        if let SensorFault::Saturated(rate) = self.disorder {
            self.turn(tick, rate, samples);
        }
        samples.retain_mut(|sample| {
            if !sample.is_of(sensor) {
                return true;
            }
            came = true;
            self.passes(tick, sample)
        });
        if let SensorFault::Slow(every) = self.disorder
            && came
            && tick >= self.next
        {
            self.next = tick + ticks(every);
        }
        while self.delayed.front().is_some_and(|(due, _)| *due <= tick) {
            samples.extend(self.delayed.pop_front().map(|(_, sample)| sample));
        }
    }

    /// Whether a sample passes, and as what.
    fn passes(&mut self, tick: u64, sample: &mut S) -> bool {
        match self.disorder {
            SensorFault::Off => return false,
            SensorFault::Stuck => match self.last.iter_mut().find(|last| last.is_like(sample)) {
                Some(last) => sample.numbers().copy_from_slice(last.numbers()),
                None => self.last.push(*sample),
            },
            SensorFault::Garbage => {
                let most = sample.garbage();
                for number in sample.numbers() {
                    *number = most * (2.0 * self.draw() - 1.0);
                }
            }
            SensorFault::Wrong(size) => sample.be_wrong(size, self.toward),
            SensorFault::Slow(_) => return tick >= self.next,
            SensorFault::Delayed(by) => {
                self.delayed.push_back((tick + ticks(by), *sample));
                return false;
            }
            SensorFault::Intermittent { .. } => return self.passes,
            SensorFault::NotANumber => {
                for number in sample.numbers() {
                    *number = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][(3.0 * self.draw()) as usize % 3];
                }
            }
            SensorFault::Jump(by) => sample.numbers().iter_mut().zip([by.north, by.east]).for_each(|(x, by)| *x += by),
            SensorFault::Saturated(_) => sample.miss(self.missed),
        }
        true
    }

    /// Samples come and stay away by turns.
    fn take_turns(&mut self, tick: u64) {
        let SensorFault::Intermittent { on, off } = self.disorder else { return };
        while tick >= self.next {
            let first = self.next == 0;
            self.passes = !first && !self.passes;
            let mean = if self.passes { on } else { off };
            // The inverse of the exponential distribution; 1 - u is never 0.
            let length = -mean * ln(1.0 - self.draw());
            self.next = self.next.max(tick) + ticks(length);
        }
    }

    /// What the gyroscope misses of the turn since the last heading.
    fn turn(&mut self, tick: u64, rate: f64, samples: &[S]) {
        let Some(heading) = samples.iter().find_map(Failing::heading) else { return };
        if let Some((before, from)) = self.turned_to {
            let turn = Heading::from_radians(heading) - Heading::from_radians(from);
            let most = rate * (tick - before) as f64 * TICK_S;
            self.missed += turn - turn.clamp(-most, most);
        }
        self.turned_to = Some((tick, heading));
    }

    fn draw(&mut self) -> f64 {
        self.draws += 1;
        self.noise.uniform(self.draws - 1)
    }
}

/// Whole ticks, one at least. A time beyond all runs saturates.
fn ticks(seconds: f64) -> u64 {
    ((seconds / TICK_S).round() as u64).clamp(1, u64::from(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_geometry::Vector;
    use albacore_vehicle::Snapshot;
    use albacore_vehicle::measurements::{COURSE, DEPTH, HEADING, POSITION};

    fn of(measurement: u16) -> Sensor {
        Sensor::of(measurement).unwrap()
    }

    /// Depths 0, 1, 2 … a tick, faulty from tick 100 to 199: what came of each, by tick.
    fn depths(disorder: SensorFault) -> Vec<(u64, f64)> {
        let mut filter = Filter::new(of(DEPTH), disorder, 1, 0);
        let mut came = Vec::new();
        for tick in 0..300 {
            let mut snapshot = Snapshot::default();
            snapshot.push(DEPTH, &[tick as f64]);
            snapshot.push(COURSE, &[1.0]);
            if (100..200).contains(&tick) {
                filter.apply(tick, &mut snapshot.samples);
            } else {
                filter.watch(tick, &snapshot.samples);
            }
            assert_eq!(snapshot.samples.iter().filter(|s| s.measurement == COURSE).count(), 1, "of another sensor");
            let depth = snapshot.samples.iter().filter(|s| s.measurement == DEPTH);
            came.extend(depth.map(|s| (tick, s.reading[0])));
        }
        let outside = came.iter().filter(|(tick, _)| !(100..200).contains(tick));
        assert!(outside.clone().all(|(tick, depth)| *tick as f64 == *depth) && outside.count() == 200);
        came.retain(|(tick, _)| (100..200).contains(tick));
        came
    }

    #[test]
    fn each_disorder_does_what_it_says() {
        assert_eq!(depths(SensorFault::Off), []);
        let stuck = depths(SensorFault::Stuck);
        assert!(stuck.len() == 100 && stuck.iter().all(|(_, depth)| *depth == 99.0));
        let wrong = depths(SensorFault::Wrong(1.5));
        assert!(wrong.len() == 100 && wrong.iter().all(|(tick, depth)| *depth == *tick as f64 + 3.0));
        let slow: Vec<u64> = depths(SensorFault::Slow(3.0)).iter().map(|(tick, _)| *tick).collect();
        assert_eq!(slow, [100, 130, 160, 190]);
        let delayed = depths(SensorFault::Delayed(2.0));
        assert!(delayed.len() == 80 && delayed.iter().all(|(tick, depth)| *depth == *tick as f64 - 20.0));
        let nothing = depths(SensorFault::NotANumber);
        assert!(nothing.len() == 100 && nothing.iter().all(|(_, depth)| !depth.is_finite()));
        assert!(
            nothing.iter().any(|(_, depth)| depth.is_nan()) && nothing.iter().any(|(_, depth)| depth.is_infinite())
        );
        let garbage: Vec<f64> = depths(SensorFault::Garbage).iter().map(|(_, depth)| *depth).collect();
        assert!(garbage.iter().any(|d| *d < 0.0) && garbage.iter().any(|d| *d > 11_000.0));
        assert_eq!(garbage.len(), 100);
    }

    #[test]
    fn intermittent_samples_come_and_stay_away_by_turns() {
        let disorder = SensorFault::Intermittent { on: 5.0, off: 15.0 };
        let mut filter = Filter::new(of(DEPTH), disorder, 3, 0);
        let (mut came, mut turns, mut before) = (0, 0, true);
        for tick in 0..1_000_000 {
            let mut snapshot = Snapshot::default();
            snapshot.push(DEPTH, &[1.0]);
            filter.apply(tick, &mut snapshot.samples);
            let comes = !snapshot.samples.is_empty();
            assert!(tick > 0 || !comes, "it begins with none");
            came += u32::from(comes);
            turns += u32::from(comes != before);
            before = comes;
        }
        assert!((f64::from(came) / 1e6 - 0.25).abs() < 0.02, "{came}");
        assert!((f64::from(turns) / 10_000.0 - 1.0).abs() < 0.05, "two turns in 20 s: {turns}");
    }

    #[test]
    fn a_saturated_gyroscope_misses_fast_turns_for_good() {
        let mut filter = Filter::new(of(HEADING), SensorFault::Saturated(0.1), 1, 0);
        let mut heading = 0.0;
        let mut read = (0.0, 0.0);
        for tick in 0..400 {
            heading += match tick {
                100..200 => 0.02, // 0.2 rad/s: half of it is missed
                200..300 => 0.005,
                _ => 0.0,
            };
            let mut snapshot = Snapshot::default();
            snapshot.push(HEADING, &[Heading::from_radians(heading).radians()]);
            snapshot.push(COURSE, &[Heading::from_radians(heading + 0.1).radians()]);
            if (50..350).contains(&tick) {
                filter.apply(tick, &mut snapshot.samples);
            } else {
                filter.watch(tick, &snapshot.samples);
            }
            let of = |measurement| snapshot.samples.iter().find(|s| s.measurement == measurement).unwrap().reading[0];
            read = (of(HEADING), of(COURSE));
            if tick == 349 {
                assert!((read.0 - 1.5).abs() < 1e-9 && (read.1 - 1.6).abs() < 1e-9, "{read:?}");
            }
        }
        assert!((read.0 - 2.5).abs() < 1e-9, "over: {read:?}");
    }

    #[test]
    fn a_jump_and_a_wrong_position_are_off_by_what_they_say() {
        let position = |disorder| {
            let mut filter = Filter::new(of(POSITION), disorder, 9, 0);
            let mut snapshot = Snapshot::default();
            snapshot.push(POSITION, &[10.0, 20.0, 2.0]);
            filter.apply(5, &mut snapshot.samples);
            snapshot.samples[0].reading
        };
        assert_eq!(position(SensorFault::Jump(Vector::new(0.0, 500.0))), [10.0, 520.0, 2.0, 0.0]);
        let [north, east, sigma, _] = position(SensorFault::Wrong(2.0));
        assert!((Vector::new(north - 10.0, east - 20.0).length() - 100.0).abs() < 1e-9 && sigma == 2.0);
    }
}
