//! What folds over the records of a run. Each recorder keeps one thing; a run, a campaign, a test and a journal that is read back
//! feed the same ones.

pub(crate) mod account;
pub(crate) mod covered;
pub(crate) mod digest;
pub(crate) mod expectations;
pub(crate) mod exported;
pub(crate) mod journal;
mod navigation;
pub(crate) mod notices;
pub(crate) mod recorded;
pub(crate) mod results;
pub(crate) mod status;
pub(crate) mod trace;
pub(crate) mod track;

use crate::picture;
use crate::plan::Plan;
use crate::summary::Summary;
use albacore_geometry::Point;
use albacore_trace::TickRecord;
use albacore_vehicle::{Measurement, Snapshot};
use notices::Notices;
use recorded::Recorded;
use results::Results;
use status::Status;
use trace::Trace;
use track::Track;

/// Folds over the records of a run.
pub(crate) trait Recorder {
    /// Takes in a step.
    fn take(&mut self, record: &TickRecord);

    /// So many steps before a tick were not taken in.
    fn miss(&mut self, _steps: u64, _tick: u64) {}
}

impl<A: Recorder, B: Recorder> Recorder for (A, B) {
    fn take(&mut self, record: &TickRecord) {
        self.0.take(record);
        self.1.take(record);
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        self.0.miss(steps, tick);
        self.1.miss(steps, tick);
    }
}

impl<R: Recorder> Recorder for Option<R> {
    fn take(&mut self, record: &TickRecord) {
        if let Some(recorder) = self {
            recorder.take(record);
        }
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        if let Some(recorder) = self {
            recorder.miss(steps, tick);
        }
    }
}

/// A file that is made of what was kept of a run, when it has ended.
#[derive(Clone, Copy)]
pub struct RunFile {
    /// What it is called in the run's folder.
    pub name: &'static str,
    /// Whether a run leaves it.
    pub(crate) is_left: fn(&InMemory) -> bool,
    pub(crate) make: fn(&InMemory, &WorldAtEnd) -> String,
}

/// What the mission did.
pub const TRACE: RunFile =
    RunFile { name: "trace.txt", is_left: |_| true, make: |run, _| run.trace.lines().to_string() };
/// Where it went.
pub const PICTURE: RunFile = RunFile { name: "run.svg", is_left: |_| true, make: picture::of_run };
/// What it recorded.
pub const RECORDED: RunFile = RunFile {
    name: "recorded.csv",
    is_left: |run| run.recorded.is_wanted(),
    make: |run, _| run.recorded.text().to_string(),
};
/// All of them, in the order in which they are written.
pub const RUN_FILES: [RunFile; 3] = [TRACE, PICTURE, RECORDED];

/// What is known of the world in which a run has ended, beside the records.
#[derive(Default)]
pub(crate) struct WorldAtEnd {
    pub in_simulation: bool,
    /// The filaments of its plume, each with its radius, m.
    pub plume: Vec<(Point, f64)>,
}

/// All that is kept of a run in memory.
pub(crate) struct InMemory {
    pub results: Results,
    pub trace: Trace,
    pub track: Track,
    pub recorded: Recorded,
    pub notices: Notices,
    pub status: Status,
}

impl InMemory {
    /// Of a run with a seed, on a vehicle with these measurements, that starts there if that is known.
    pub fn new(plan: &Plan, seed: u64, measurements: &[Measurement], start: Option<Point>) -> Self {
        InMemory {
            results: Results::new(plan, seed, start),
            trace: Trace::new(plan, seed, measurements),
            track: Track::new(plan, measurements),
            recorded: Recorded::new(plan, measurements),
            notices: Notices::default(),
            status: Status::new(measurements),
        }
    }

    /// The result; `wall_s` is measured by who ran it.
    pub fn summary(&self, wall_s: f64) -> Summary {
        let (rows, left_out) = self.recorded.rows();
        let recorded_rows = self.recorded.is_wanted().then_some(rows);
        Summary { recorded_rows, recorded_rows_left_out: left_out, ..self.results.summary(wall_s) }
    }
}

impl Recorder for InMemory {
    fn take(&mut self, record: &TickRecord) {
        self.results.take(record);
        self.trace.take(record);
        self.track.take(record);
        self.recorded.take(record);
        self.notices.take(record);
        self.status.take(record);
    }

    fn miss(&mut self, steps: u64, tick: u64) {
        self.results.miss(steps, tick);
        self.trace.miss(steps, tick);
        self.track.miss(steps, tick);
        self.recorded.miss(steps, tick);
        self.notices.miss(steps, tick);
    }
}

/// What is said of steps that were not taken in.
pub(crate) fn missed(steps: u64) -> String {
    format!("{steps} ticks before this are not in trace, picture and what is recorded: the host was too slow")
}

/// A measurement of the vehicle by its name.
struct Sensor(Option<usize>);

impl Sensor {
    fn new(measurements: &[Measurement], name: &str) -> Self {
        Sensor(measurements.iter().position(|measurement| measurement.name == name))
    }

    /// The latest number of it in a tick, believed or not.
    fn latest(&self, snapshot: &Snapshot) -> Option<f64> {
        let is_ours = |sample: &&albacore_vehicle::Sample| Some(usize::from(sample.input_measurement())) == self.0;
        snapshot.samples.iter().rev().find(is_ours).map(|sample| sample.reading[0])
    }
}
