//! A record as the world of a scenario.

use crate::scenario::{Scenario, ScenarioIssues, number};
use crate::world::plume::Source;
use albacore_formats::recording::{RecordedKernel, Recording};
use std::sync::Arc;

/// The papers' threshold of detection, ratio of full scale: with it a record saturates the sensor at 25 thresholds.
const THRESHOLD: f64 = 0.04;

/// A record, and how a run meets it.
#[derive(Clone, Debug)]
pub struct RecordedPlume {
    /// The record.
    pub recording: Arc<Recording>,
    /// How its filaments read. Default as in the model that made it.
    pub kernel: RecordedKernel,
    /// The moment of the record at which a run begins, s. Default 0.
    pub start: f64,
    /// Each seed begins at a moment of its own, evenly from `start` to so much later, s. Default 0: all then.
    pub start_spread: f64,
    /// What the chemical sensor reads where the record is at its own threshold of detection, ratio of full scale.
    /// Default 0.04.
    pub threshold: f64,
}

impl RecordedPlume {
    /// A record from its beginning, read as its makers do.
    pub fn new(recording: Arc<Recording>) -> Self {
        RecordedPlume {
            recording,
            kernel: RecordedKernel::default(),
            start: 0.0,
            start_spread: 0.0,
            threshold: THRESHOLD,
        }
    }

    /// What releases its chemical.
    pub fn source(&self) -> Source {
        let (peak, reference_age) = self.recording.far_peak();
        Source {
            name: self.recording.name().to_string(),
            at: self.recording.source(),
            rate: self.recording.release_rate(),
            peak: self.threshold * peak,
            reference_age,
            ..Source::default()
        }
    }
}

/// Two are the same if their data are.
impl PartialEq for RecordedPlume {
    fn eq(&self, other: &Self) -> bool {
        self.recording.sha256() == other.recording.sha256()
            && (self.kernel, self.start, self.start_spread, self.threshold)
                == (other.kernel, other.start, other.start_spread, other.threshold)
    }
}

/// What of a recorded plume cannot be in a scenario.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(recorded) = &scenario.environment.recording else { return };
    let flow = &scenario.environment.flow;
    let own_flow = flow.meander.is_some() || flow.turning != 0.0 || !flow.tides.is_empty();
    let mut of = objections.of("recorded_plume");
    of.unless(
        None,
        scenario.environment.plume.is_none() && !own_flow,
        "`recorded_plume` brings its own plume and its own flow",
        "leave out `plume`, and all of `flow` but an upper layer and waves",
    );
    let (latest, duration) = (recorded.start + recorded.start_spread, recorded.recording.duration());
    of.unless(
        Some("start"),
        latest < duration,
        format!("the run begins up to {} s into the record, and that ends at {} s", number(latest), number(duration)),
        "make `start` and `start_spread` smaller",
    );
}
