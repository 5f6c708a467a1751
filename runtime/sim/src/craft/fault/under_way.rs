//! The faults of a run: which are in force in a tick, what is said of it, and what they do.

use super::filter::Filter;
use super::{Fault, FaultKind, to_tick};
use crate::craft::sensors::{RawSample, water_depth};
use albacore_geometry::Vector;
use albacore_vehicle::measurements::WATER_DEPTH;
use albacore_vehicle::{Sample, TICK_S};

/// What the vehicle itself suffers from in a tick: all that a hull and a computer need to know of faults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VehicleFaults {
    /// It hears no commands.
    pub deaf: bool,
    /// Water has got in. It stays in when the fault is over.
    pub leaks: bool,
    /// So much water is in the hull, kg. It stays in, too.
    pub water: f64,
    /// Where the rudder is stuck: a share of its greatest deflection, positive to starboard.
    pub rudder: Option<f64>,
    /// Current beside that of the water, m/s toward.
    pub current: Vector,
}

/// All faults of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faults {
    all: Vec<Known>,
    ailing: VehicleFaults,
    notices: Vec<String>,
}

/// A fault, and how it stands with it.
#[derive(Clone, Debug)]
struct Known {
    fault: Fault,
    in_force: bool,
    /// What it does to what is told, and to what a navigator takes as it is measured.
    filter: Option<Filter<Sample>>,
    raw: Option<Filter<RawSample>>,
}

impl Faults {
    /// Those of a scenario, in its order. Where a navigator takes what its sensors measure, their faults are in what it makes of it, and
    /// in nothing else that is told.
    pub fn new(faults: &[Fault], takes_raw: bool, seed: u64) -> Self {
        let known = faults.iter().zip(0..).map(|(&fault, number)| {
            let (filter, raw) = match fault.trouble {
                FaultKind::Sensor(sensor, disorder) => (
                    sensor
                        .measurement()
                        .filter(|_| !takes_raw || sensor.raw().is_none())
                        .map(|_| Filter::new(sensor, disorder, seed, number)),
                    sensor.raw().map(|_| Filter::new(sensor, disorder, seed, number)),
                ),
                _ => (None, None),
            };
            Known { fault, in_force: false, filter, raw }
        });
        Faults { all: known.collect(), ..Faults::default() }
    }

    /// Begins and ends what begins and ends with a tick.
    pub fn advance_to(&mut self, tick: u64) {
        let mut ailing = VehicleFaults { leaks: self.ailing.leaks, ..VehicleFaults::default() };
        for known in &mut self.all {
            let (from, to) = (to_tick(known.fault.from), known.fault.to.map_or(f64::INFINITY, to_tick));
            let in_force = (from..to).contains(&(tick as f64));
            if in_force != known.in_force {
                let what = if in_force { "fault" } else { "fault over" };
                self.notices.push(format!("{what}: {}", known.fault));
            }
            known.in_force = in_force;
            match known.fault.trouble {
                FaultKind::Flooding { water, within } => {
                    ailing.water += water * filled((tick as f64).min(to) - from, within / TICK_S);
                }
                _ if !in_force => {}
                FaultKind::Sensor(..) => {}
                FaultKind::IgnoredCommands => ailing.deaf = true,
                FaultKind::Leak => ailing.leaks = true,
                FaultKind::StuckRudder(share) => ailing.rudder = Some(share),
                FaultKind::StrongCurrent(current) => ailing.current = ailing.current + current,
            }
        }
        self.ailing = ailing;
    }

    /// What the vehicle suffers from in this tick.
    pub fn ailing(&self) -> &VehicleFaults {
        &self.ailing
    }

    /// Makes of a tick's samples what who drives is told.
    pub fn filter(&mut self, tick: u64, samples: &mut Vec<Sample>) {
        let mut water_depth_fails = false;
        for known in &mut self.all {
            let Some(filter) = &mut known.filter else { continue };
            if known.in_force {
                filter.apply(tick, samples);
                water_depth_fails |=
                    matches!(known.fault.trouble, FaultKind::Sensor(sensor, _) if sensor.is_source_of(WATER_DEPTH));
            } else {
                filter.watch(tick, samples);
            }
        }
        if water_depth_fails {
            add_up(samples);
        }
    }

    /// Makes of a tick's raw samples what a navigator takes.
    pub fn filter_raw(&mut self, tick: u64, samples: &mut Vec<RawSample>) {
        for known in &mut self.all {
            match &mut known.raw {
                Some(filter) if known.in_force => filter.apply(tick, samples),
                Some(filter) => filter.watch(tick, samples),
                None => {}
            }
        }
    }

    /// What has begun and ended since this was last asked.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }
}

/// The share of the water that is in after so many ticks, when all of it is in `within` so many.
fn filled(after: f64, within: f64) -> f64 {
    if after < within { (after / within).max(0.0) } else { f64::from(u8::from(after >= 0.0)) }
}

/// The depth of the water as it is told with depth and altitude that fail.
fn add_up(samples: &mut Vec<Sample>) {
    let sum = water_depth(samples);
    samples.retain_mut(|sample| match (sample.measurement, sum) {
        (WATER_DEPTH, Some(sum)) => {
            sample.reading[0] = sum;
            true
        }
        (WATER_DEPTH, None) => false,
        _ => true,
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::craft::fault::{Sensor, SensorFault};
    use albacore_vehicle::Snapshot;
    use albacore_vehicle::measurements::{ALTITUDE, DEPTH, FLOW, SPEED};

    fn fault(trouble: FaultKind, from: f64, to: Option<f64>) -> Fault {
        Fault { trouble, from, to }
    }

    #[test]
    fn begin_and_end_are_told_to_the_tick() {
        let trouble = FaultKind::Sensor(Sensor::of(FLOW).unwrap(), SensorFault::NotANumber);
        let mut faults =
            Faults::new(&[fault(trouble, 0.3, Some(0.5)), fault(FaultKind::IgnoredCommands, 0.4, None)], false, 1);
        let told: Vec<(u64, String)> = (0..10)
            .flat_map(|tick| {
                faults.advance_to(tick);
                faults.take_notices().into_iter().map(move |notice| (tick, notice))
            })
            .collect();
        let expected = [
            (3, "fault: flow not a number".to_string()),
            (4, "fault: ignored commands".to_string()),
            (5, "fault over: flow not a number".to_string()),
        ];
        assert_eq!(told, expected);
        assert!(faults.ailing().deaf && !faults.ailing().leaks);
    }

    #[test]
    fn a_leak_stays_and_currents_add_up() {
        let current = |north| FaultKind::StrongCurrent(Vector::new(north, 0.0));
        let list =
            [fault(FaultKind::Leak, 0.0, Some(0.1)), fault(current(1.0), 0.0, None), fault(current(0.5), 0.0, None)];
        let mut faults = Faults::new(&list, false, 1);
        (0..5).for_each(|tick| faults.advance_to(tick));
        assert!(faults.ailing().leaks);
        assert_eq!(faults.ailing().current, Vector::new(1.5, 0.0));
    }

    #[test]
    fn a_hull_fills_evenly_and_what_is_in_stays_in() {
        let flooding = |water, within| FaultKind::Flooding { water, within };
        let list = [
            fault(flooding(2.0, 1.0), 0.5, None),
            fault(flooding(4.0, 1.0), 0.5, Some(1.0)),
            fault(flooding(8.0, 0.0), 2.0, Some(2.1)),
        ];
        let mut faults = Faults::new(&list, false, 1);
        let water: Vec<f64> = (0..30)
            .map(|tick| {
                faults.advance_to(tick);
                faults.ailing().water
            })
            .collect();
        for (tick, kilograms) in [(0, 0.0), (5, 0.0), (8, 1.8), (10, 3.0), (15, 4.0), (19, 4.0), (20, 12.0), (29, 12.0)]
        {
            assert!((water[tick] - kilograms).abs() < 1e-12, "{tick}: {}", water[tick]);
        }
    }

    #[test]
    fn the_waters_depth_fails_with_either_part() {
        let told = |measurement, disorder| {
            let sensor = Sensor::of(measurement).unwrap();
            let mut faults = Faults::new(&[fault(FaultKind::Sensor(sensor, disorder), 0.0, None)], false, 1);
            faults.advance_to(0);
            let mut snapshot = Snapshot::default();
            for (measurement, metres) in [(DEPTH, 3.0), (ALTITUDE, 5.0), (WATER_DEPTH, 8.0)] {
                snapshot.push(measurement, &[metres]);
            }
            faults.filter(0, &mut snapshot.samples);
            snapshot.samples.iter().find(|s| s.measurement == WATER_DEPTH).map(|s| s.reading[0])
        };
        assert_eq!(told(DEPTH, SensorFault::Off), None);
        assert_eq!(told(ALTITUDE, SensorFault::Wrong(1.0)), Some(10.0));
        assert_eq!(told(SPEED, SensorFault::Off), Some(8.0));
        assert!(told(DEPTH, SensorFault::NotANumber).is_some_and(|sum| !sum.is_finite()));
    }
}
