//! The behavior trace of a run.

use super::{Recorder, Sensor, missed};
use crate::plan::Plan;
use albacore_geometry::Heading;
use albacore_program::senses;
use albacore_trace::{BehaviorTrace, Header};
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::{Measurement, TICK_S};

/// Writes the trace.
pub(crate) struct Trace {
    lines: BehaviorTrace,
    heading: Sensor,
    depth: Sensor,
}

impl Trace {
    pub fn new(plan: &Plan, seed: u64, measurements: &[Measurement]) -> Self {
        let header = Header {
            mission: plan.program.mission.name.clone(),
            scenario: plan.scenario_name.clone(),
            seed,
            tick_s: TICK_S,
        };
        Trace {
            lines: BehaviorTrace::new(&plan.program, &header),
            heading: Sensor::new(measurements, senses::HEADING),
            depth: Sensor::new(measurements, senses::DEPTH),
        }
    }

    pub fn lines(&self) -> &BehaviorTrace {
        &self.lines
    }

    fn hear(&mut self, record: &TickRecord) {
        record.notices.iter().for_each(|notice| self.lines.vehicle(record.tick, notice));
    }

    /// What happened in a tick, and now and then where the vehicle is.
    fn note(&mut self, record: &TickRecord) {
        let TickRecord { tick, truth, believed, snapshot, events, .. } = record;
        self.lines.tick(*tick, *believed, events);
        let sensed = || self.heading.latest(snapshot).map(Heading::from_radians);
        let heading = truth.map(|truth| truth.heading).or_else(sensed);
        let depth = truth.map(|truth| truth.depth).or_else(|| self.depth.latest(snapshot));
        self.lines.sample(*tick, *believed, heading, depth);
    }
}

impl Recorder for Trace {
    fn take(&mut self, record: &TickRecord) {
        match &record.step {
            Step::Wait => self.hear(record),
            Step::Tick => {
                self.hear(record);
                self.note(record);
            }
            Step::End(ending) => {
                if !record.events.is_empty() {
                    self.note(record);
                }
                self.hear(record);
                self.lines.finish(ending.outcome, ending.release, record.tick, ending.digest);
            }
        }
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        self.lines.vehicle(tick, &missed(steps));
    }
}
