//! The result of a run, as `run --json` prints it.

use albacore_geometry::{Geodetic, Point};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The result of a run. Names and units are fixed (DESIGN of the command line): scripts rely on them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The mission's name.
    pub mission: String,
    /// The scenario's name.
    pub scenario: String,
    /// Where the mission's frame lies on the globe, if it does.
    pub origin: Option<Origin>,
    /// The seed.
    pub seed: u64,
    /// `completed`, `timed_out`, `aborted`, …
    pub outcome: &'static str,
    /// Why, when there is something to say.
    pub reason: String,
    /// Ticks lived.
    pub ticks: u64,
    /// The same in seconds.
    pub sim_time_s: f64,
    /// Seconds on the wall, measured by who ran it; no part of the digest.
    pub wall_s: f64,
    /// The way over ground, in metres.
    pub path_length_m: f64,
    /// What the last strategy, or behavior with a result, came to that was in no other.
    pub result: Option<Finished>,
    /// How many rules fired.
    pub switches: u64,
    /// How often the mission was held because a required input was too old, or the link too slow.
    pub holds: u64,
    /// The behaviors and strategies that were entered, in the order of the program.
    pub behaviors: Vec<BehaviorSummary>,
    /// What was reported.
    pub reports: Vec<Report>,
    /// How many reports there were beside those that are listed: of very many only the first are.
    #[serde(skip_serializing_if = "is_zero")]
    pub more_reports: u64,
    /// How good its inertial navigator was, of a simulated vehicle with one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub navigation: Option<NavigationSummary>,
    /// How many rows were recorded, by a mission that records anything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded_rows: Option<u64>,
    /// How many rows there were beyond what is kept of them.
    #[serde(skip_serializing_if = "is_zero")]
    pub recorded_rows_left_out: u64,
    /// The digest of the full-rate run.
    pub digest: String,
}

/// How far off an inertial navigator was, looked at once a second, and whether it knew. Errors but those of the position are of 30 s on.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "each field is what it says")]
pub struct NavigationSummary {
    pub position_error_mean_m: f64,
    pub position_error_max_m: f64,
    pub depth_error_rms_m: f64,
    pub depth_error_max_m: f64,
    /// 99 % of the errors are smaller.
    pub roll_error_99_deg: f64,
    pub pitch_error_99_deg: f64,
    pub yaw_error_99_deg: f64,
    /// The greatest of any axis.
    pub gyro_bias_error_max_deg_s: f64,
    pub accelerometer_bias_error_max_m_s2: f64,
    /// Shares of errors within three of the expected standard deviations: attitude, gyro biases, position, velocity, accelerometer biases.
    pub within_3_sigma: [f64; 5],
    /// The error's square by its covariance, of each state: the mean, 1 where the filter is right, and the share between the bounds of 95 %.
    pub nees: [f64; 2],
    /// The innovations' squares by theirs, of each number, likewise: attitude, pressure, velocity, times of arrival.
    pub nis: [Option<[f64; 2]>; 4],
    /// For so long the place was farther off than expected: by more than four standard deviations.
    pub beyond_s: f64,
    /// For so long of that the navigator told of nothing.
    pub unnoticed_s: f64,
}

impl Summary {
    /// How many reports there were beyond the first so many.
    pub fn reports_beyond(&self, told: usize) -> u64 {
        self.reports.len().saturating_sub(told) as u64 + self.more_reports
    }
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl Report {
    /// Where on the globe, as scripts write it.
    pub fn position(&self) -> Option<String> {
        Some(Geodetic::from_degrees(self.latitude_deg?, self.longitude_deg?).to_string())
    }
}

/// Where a mission's frame lies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Origin {
    /// Its latitude, degrees.
    pub latitude_deg: f64,
    /// Its longitude, degrees.
    pub longitude_deg: f64,
}

impl From<Geodetic> for Origin {
    fn from(origin: Geodetic) -> Self {
        Origin { latitude_deg: origin.latitude_deg(), longitude_deg: origin.longitude_deg() }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Geodetic::from_degrees(self.latitude_deg, self.longitude_deg).fmt(f)
    }
}

/// What an activity came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finished {
    /// Its name.
    pub of: String,
    /// `done`, `timed_out` where `within` cut it off, `aborted` with the mission, else `cut`.
    pub end: &'static str,
    /// What it finished with, as the value of a report; nothing where it was cut off, has no result, or finished with `none`.
    pub value: serde_json::Value,
    /// The same in one word, as tables have it: `none`, `true`, `place`; of what was cut off how it ended.
    pub word: String,
}

/// What a run did in a behavior.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BehaviorSummary {
    /// Its name; behaviors of one name are one.
    pub name: String,
    /// How often it was entered.
    pub entered: u64,
    /// How long it was active, s: what it called, too.
    pub time_s: f64,
    /// The way over ground meanwhile, m.
    pub path_length_m: f64,
}

/// Something that was reported.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Its name.
    pub name: String,
    /// When, in seconds.
    pub t_s: f64,
    /// Where, in the mission's frame, when a position was reported.
    pub north_m: Option<f64>,
    /// Where, in the mission's frame.
    pub east_m: Option<f64>,
    /// Where on the globe, when the frame lies on it.
    pub latitude_deg: Option<f64>,
    /// Where on the globe.
    pub longitude_deg: Option<f64>,
    /// In simulation the distance to the nearest true source; without sources, to the deepest point of the mission's area
    /// where the bottom has pits or was surveyed. Of an area, in a world with spills, the mean distance of its outline from that of the nearest spill.
    pub error_m: Option<f64>,
    /// That source, or deepest point, in the mission's frame.
    pub true_north_m: Option<f64>,
    /// That source, or deepest point, in the mission's frame.
    pub true_east_m: Option<f64>,
    /// How large that spill truly is, of an area.
    pub true_surface_m2: Option<f64>,
    /// How far down-flow of it, by the mean flow of the scenario as a run begins; none without one.
    pub error_along_m: Option<f64>,
    /// How far to the right of it, looking down-flow.
    pub error_across_m: Option<f64>,
    /// What was reported: a number, a text, a list, a record, a place, an area, a map; a quantity is `{"value": …, "unit": …}`.
    pub value: serde_json::Value,
    /// What was reported beside it, by its labels.
    pub labelled: BTreeMap<String, serde_json::Value>,
    /// Which of those of its name it is, from 0.
    #[serde(skip)]
    pub nth: u64,
    /// Which of the program's reporting statements it is of.
    #[serde(skip)]
    pub site: u32,
    /// What was reported and beside it, in words, but for the place of its own.
    #[serde(skip)]
    pub told: String,
    /// The corners of the areas in it, in the mission's frame, by their names: its own, else its labels.
    #[serde(skip)]
    pub areas: Vec<(String, Vec<Point>)>,
    /// What that distance is from, in words.
    #[serde(skip)]
    pub error_from: Option<&'static str>,
}
