//! The plain structure that a page of a run shows. Lists of numbers are whole numbers, each as its difference from the one before: a
//! mission of hours fits into a few megabytes.

pub use super::happenings::{Happening, Why};
pub use super::live::Increment;
pub use super::recorder::NewParts;
pub use super::series::Series;
pub use super::spans::{NewSpans, Spans};
pub use super::world::{BottomCells, Extent, KnownWorld, MovingOutline, Named, PlumeFrames};
use crate::summary::Report;
use albacore_program::seen::one_line;
use serde::Serialize;

/// All that the page of a run shows.
#[derive(Clone, Debug, Serialize)]
pub struct ReportData {
    /// What was run, and how it ended.
    pub head: Head,
    /// What was reported.
    pub reports: Vec<ReportedRow>,
    /// How many reports there were beside those.
    pub more_reports: u64,
    /// What is known of the world.
    pub world: KnownWorld,
    /// The plume as it moved, if there is one that can be simulated again.
    pub plume: Option<PlumeFrames>,
    /// From this share of full scale on chemical is detected; none where there is nothing to detect.
    pub detection: Option<f64>,
    /// Seconds between the numbers of a series.
    pub every_s: u64,
    /// What was sensed, commanded and true, over time.
    pub series: Vec<Series>,
    /// What the track is coloured by at each of these times: an index into `activities`, packed.
    pub colours: Vec<Option<i64>>,
    /// The names of what was active, and where each is declared.
    pub activities: Vec<ActivityName>,
    /// When each was active.
    pub spans: Spans,
    /// The switching tables that ran, drawn.
    pub diagrams: Vec<RunDiagram>,
    /// The lines of the trace.
    pub happenings: Vec<Happening>,
    /// How many lines there were beside those.
    pub happenings_left_out: u64,
}

/// What was run, and how it ended.
#[derive(Clone, Debug, Serialize)]
pub struct Head {
    /// The mission.
    pub mission: String,
    /// The scenario; of a vehicle at the end of a link its URL.
    pub scenario: String,
    /// Whether it was such a vehicle.
    pub is_link: bool,
    /// The seed.
    pub seed: u64,
    /// The parameters that were changed.
    pub set: Vec<String>,
    /// How it ended, in words.
    pub outcome: String,
    /// Why, when there is something to say.
    pub reason: String,
    /// Ticks lived.
    pub ticks: u64,
    /// The same in seconds.
    pub time_s: f64,
    /// The way over ground, m.
    pub path_m: f64,
    /// How many rules fired.
    pub switches: u64,
    /// How often the mission was held.
    pub holds: u64,
    /// Where the mission's frame lies on the globe, if it does.
    pub origin: Option<String>,
    /// The digest of the full-rate run; empty where its end is not known.
    pub digest: String,
    /// Where the journal ends too early, if it does.
    pub cut: Option<String>,
    /// When the mission's clock was at 0, by the wall clock, if that is known.
    pub first_tick: Option<String>,
}

/// A report, as a table shows it.
#[derive(Clone, Debug, Serialize)]
pub struct ReportedRow {
    /// Its name.
    pub name: String,
    /// When, s.
    pub t: f64,
    /// Where, m, if a place was reported.
    pub north: Option<f64>,
    /// Where, m.
    pub east: Option<f64>,
    /// Where on the globe, as scripts write it.
    pub globe: Option<String>,
    /// How far from what there was to be found, m, where that is known.
    pub error: Option<f64>,
    /// What that is.
    pub error_from: Option<&'static str>,
    /// What was reported, in words.
    pub told: String,
}

impl ReportedRow {
    pub(super) fn new(report: &Report) -> Self {
        ReportedRow {
            name: one_line(&report.name),
            t: report.t_s,
            north: report.north_m,
            east: report.east_m,
            globe: report.position(),
            error: report.error_m,
            error_from: report.error_from,
            told: one_line(&report.told),
        }
    }
}

/// What was active, by name.
#[derive(Clone, Debug, Serialize)]
pub struct ActivityName {
    /// Its name.
    pub name: String,
    /// Where it is declared, `file:line`; empty for a block of the mission.
    pub place: String,
}

/// A switching table, drawn.
#[derive(Clone, Debug, Serialize)]
pub struct RunDiagram {
    /// The strategy: an index into the activities.
    pub activity: usize,
    /// Its behaviors in the order of the diagram: indices into the activities; none of what never was active.
    pub behaviors: Vec<Option<usize>>,
    /// The picture as SVG; none where it is too large to be drawn.
    pub svg: Option<String>,
}
