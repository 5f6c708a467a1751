//! What a scenario says of a plume that was computed elsewhere.

use super::clause::Clause;
use super::{Understood, Wrong};
use crate::files::Files;
use albacore_geometry::{Area, Point};
use albacore_sim::{RecordedKernel, RecordedPlume, RecordingError, RecordingHeader, Scenario};
use albacore_trace::Digest;
use albacore_trace::journal::SourceDigest;
use std::sync::Arc;

/// A header is no larger than this, bytes.
const HEADER_BYTES_MAX: u64 = 4 * 1024 * 1024;

/// The clauses that a record takes the place of.
pub const BROUGHT: [&str; 8] = ["flow", "turning", "tide", "region", "plume", "source", "leak", "patch"];

/// `recorded_plume(…)`: the record, and all that it brings.
pub fn recorded_plume(understood: &mut Understood, c: &Clause, files: &Files) -> Result<(), Wrong> {
    let path = c.text("file")?;
    let header = files.data(&path, HEADER_BYTES_MAX)?;
    let header = String::from_utf8(header).map_err(|_| format!("`{path}` is no text in UTF-8"))?;
    let header = RecordingHeader::read(&header).map_err(|e| told(&path, &e))?;
    // The binary lies beside its header.
    let folder = path.rfind('/').map_or("", |slash| &path[..=slash]);
    let binary = format!("{folder}{}", header.binary());
    let bytes = files.data(&binary, header.bytes() as u64)?;
    let recording = header.decode(&bytes).map_err(|error| told(&path, &error))?;
    let kernel = match c.clause("kernel").map(|kernel| kernel.clause.name.as_str()) {
        Some("flat") => RecordedKernel::Flat,
        _ => RecordedKernel::Pompy,
    };
    let recorded = RecordedPlume {
        recording: Arc::new(recording),
        kernel,
        start: c.number("start")?,
        start_spread: c.number("start_spread")?,
        threshold: c.number("threshold")?,
    };
    let mut digest = Digest::new();
    digest.text(recorded.recording.sha256());
    understood.files.push(SourceDigest { name: path, digest: digest.value() });
    let scenario = &mut understood.world;
    scenario.region = Some(recorded.recording.area().clone());
    scenario.flow.mean = recorded.recording.mean_flow();
    scenario.sources = vec![recorded.source()];
    scenario.recording = Some(recorded);
    Ok(())
}

/// What of a mission's area a record does not cover.
pub(crate) struct Uncovered {
    /// All of it.
    pub all: bool,
    pub message: String,
    pub help: String,
}

/// Areas that reach no further beyond a record than this, m, are meant to be its own.
const MARGIN: f64 = 0.5;

/// What the area of a mission has beyond the record of its world, if anything.
pub(crate) fn uncovered(world: &Scenario, mission: &str, area: &Area) -> Option<Uncovered> {
    let region = world.recording.as_ref()?.recording.area();
    let out = area.corners().iter().map(|&corner| -region.gap(corner)).fold(0.0, f64::max);
    let all = !region.overlaps(area);
    let of = |along: fn(&Point) -> f64| {
        let all = region.corners().iter().map(along);
        let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), x| (l.min(x), m.max(x)));
        format!("{least:.0} m to {most:.0} m")
    };
    let reach = format!("{} north and {} east of the origin", of(|p| p.north), of(|p| p.east));
    let what = "beyond it there is no chemical, and the flow is that of its edge";
    if all {
        let message = format!("no part of the area of the mission `{mission}` lies in the region of the record");
        return Some(Uncovered { all, message, help: format!("move it there: the record lies {reach}; {what}") });
    }
    (out > MARGIN).then(|| Uncovered {
        all,
        message: format!("the area of the mission `{mission}` reaches {out:.0} m beyond the region of the record"),
        help: format!("the record lies {reach}; {what}"),
    })
}

fn told(path: &str, error: &RecordingError) -> String {
    format!("`{path}`: {error}")
}
