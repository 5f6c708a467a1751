//! What a driver hands on: all that came in, went out and happened in one step, as one value that recorders fold over.

use albacore_geometry::Point;
use albacore_machine::{Event, Outcome};
use albacore_program::{AREA_CORNER_WORDS, ActivityId};
use albacore_sim::Truth;
use albacore_trace::{Digest, Release};
use albacore_vehicle::{Command, Snapshot};

/// One step of a run.
#[derive(Clone, Debug, Default)]
pub struct TickRecord {
    /// The tick it belongs to; for the end, the one that would have come next.
    pub tick: u64,
    /// What kind of step it was.
    pub step: Step,
    /// All that came from the vehicle.
    pub snapshot: Snapshot,
    /// What it was told.
    pub command: Option<Command>,
    /// What happened.
    pub events: Vec<Event>,
    /// What a person should hear of the vehicle and the link, before the events in time; at the end, after them.
    pub notices: Vec<String>,
    /// What is so, whatever the sensors say: known in simulation only.
    pub truth: Option<Truth>,
    /// Where the mission believes the vehicle to be.
    pub believed: Option<Point>,
    /// The active activities, from outside in.
    pub active: Vec<ActivityId>,
    /// The words of the mission's area: in the first tick that knows it, and at the end again.
    pub area: Vec<f64>,
    /// Whether the run's end follows at once.
    pub is_last: bool,
}

/// What kind of step it was.
#[derive(Clone, Debug, Default)]
pub enum Step {
    /// The vehicle's time has not come to the next tick: there may be notices.
    #[default]
    Wait,
    /// A tick.
    Tick,
    /// The end of the run, after the vehicle was given back. Its events are those of an end that came from outside.
    End(Ending),
}

/// How a run ended.
#[derive(Clone, Debug)]
pub struct Ending {
    /// The outcome.
    pub outcome: Outcome,
    /// Why, in words; empty when there is nothing to say.
    pub reason: String,
    /// How the vehicle was given back.
    pub release: Release,
    /// Why it was not, if so.
    pub trouble: Option<String>,
    /// The digest of the full-rate run.
    pub digest: Digest,
}

impl TickRecord {
    /// Nothing yet, at a tick; keeps its memory.
    pub(super) fn clear(&mut self, tick: u64) {
        self.tick = tick;
        self.step = Step::Wait;
        self.snapshot.samples.clear();
        self.snapshot.aground = false;
        self.command = None;
        self.events.clear();
        self.notices.clear();
        self.truth = None;
        self.believed = None;
        self.active.clear();
        self.area.clear();
        self.is_last = false;
    }

    /// About how much memory it takes.
    pub(super) fn bytes(&self) -> usize {
        let events: usize = self.events.iter().map(|event| size_of::<Event>() + said(event)).sum();
        let notices: usize = self.notices.iter().map(|notice| size_of::<String>() + notice.len()).sum();
        size_of::<Self>() + size_of_val(self.snapshot.samples.as_slice()) + events + notices
    }

    /// Where the vehicle is, as well as that is known.
    pub(crate) fn here(&self) -> Option<Point> {
        self.truth.map(|truth| truth.position).or(self.believed)
    }
}

/// The corners of an area, of its words.
pub(crate) fn corners(area: &[f64]) -> Vec<Point> {
    let count = area.first().map_or(0, |count| *count as usize);
    let corners = area.get(1..).unwrap_or_default().chunks_exact(AREA_CORNER_WORDS as usize);
    corners.take(count).map(|words| Point::new(words[0], words[1])).collect()
}

/// The bytes of what an event has to say.
fn said(event: &Event) -> usize {
    match event {
        Event::Logged(text) | Event::Aborted(text) => text.len(),
        Event::Reported(_, words) | Event::Remembered(_, words) | Event::Switched { values: words, .. } => {
            size_of_val(words.as_slice())
        }
        _ => 0,
    }
}
