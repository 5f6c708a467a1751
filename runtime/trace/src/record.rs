//! All that came in, went out and happened in one step of a run, as one value: a driver makes it, recorders fold over it, a journal
//! keeps it.

use crate::behavior::Release;
use crate::journal::snapshot;
use albacore_geometry::Point;
use albacore_machine::{Event, Outcome};
use albacore_program::{AREA_CORNER_WORDS, ActivityId};
use albacore_vehicle::{Command, NavigationErrors, Snapshot, Truth};
use serde::{Deserialize, Serialize};

/// One step of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TickRecord {
    /// The tick it belongs to; for the end, the one that would have come next.
    pub tick: u64,
    /// What kind of step it was.
    pub step: Step,
    /// All that came from the vehicle.
    #[serde(with = "snapshot")]
    pub snapshot: Snapshot,
    /// What it was told.
    pub command: Option<Command>,
    /// What happened.
    pub events: Vec<Event>,
    /// What a person should hear of the vehicle and the link, before the events in time; at the end, after them.
    pub notices: Vec<String>,
    /// What is so, whatever the sensors say: known in simulation only.
    pub truth: Option<Truth>,
    /// How far off its inertial navigator is, once a second: known in simulation only.
    pub navigation: Option<Box<NavigationErrors>>,
    /// The words of the mission's areas, one after another: in the first tick that knows them, and at the end again.
    pub areas: Vec<f64>,
    /// Where the mission believes the vehicle to be. It follows from the samples: no journal keeps it.
    #[serde(skip)]
    pub believed: Option<Point>,
    /// The active activities, from outside in. They follow from the events: no journal keeps them.
    #[serde(skip)]
    pub active: Vec<ActivityId>,
    /// Whether the run's end follows at once. No journal keeps it.
    #[serde(skip)]
    pub is_last: bool,
}

/// What kind of step it was.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    pub digest: u64,
}

impl TickRecord {
    /// Nothing yet, at a tick; keeps its memory.
    pub fn clear(&mut self, tick: u64) {
        fn emptied<T>(list: &mut Vec<T>) -> Vec<T> {
            list.clear();
            std::mem::take(list)
        }
        let samples = emptied(&mut self.snapshot.samples);
        *self = TickRecord {
            tick,
            snapshot: Snapshot { samples, ..Snapshot::default() },
            events: emptied(&mut self.events),
            notices: emptied(&mut self.notices),
            areas: emptied(&mut self.areas),
            active: emptied(&mut self.active),
            ..TickRecord::default()
        };
    }

    /// About how much memory it takes, bytes.
    pub fn bytes(&self) -> usize {
        let events: usize = self.events.iter().map(|event| size_of::<Event>() + said(event)).sum();
        let notices: usize = self.notices.iter().map(|notice| size_of::<String>() + notice.len()).sum();
        let Snapshot { samples, answers, .. } = &self.snapshot;
        size_of::<Self>() + size_of_val(samples.as_slice()) + size_of_val(answers.as_slice()) + events + notices
    }

    /// How the run ended, if this is its end.
    pub fn ending(&self) -> Option<&Ending> {
        match &self.step {
            Step::End(ending) => Some(ending),
            Step::Wait | Step::Tick => None,
        }
    }

    /// The corners of each of the mission's areas, where their words are told: the operating area comes first.
    pub fn corners(&self) -> Vec<Vec<Point>> {
        let place = |words: &[f64]| Point::new(words[0], words[1]);
        let corners = |area: &[f64]| area[1..].chunks_exact(AREA_CORNER_WORDS as usize).map(place).collect();
        areas(&self.areas).into_iter().map(corners).collect()
    }

    /// Where the vehicle is, as well as that is known.
    pub fn here(&self) -> Option<Point> {
        self.truth.map(|truth| truth.position).or(self.believed)
    }
}

/// The words of each of some areas that stand one after another; what is cut off is none.
pub fn areas(mut words: &[f64]) -> Vec<&[f64]> {
    let mut areas = Vec::new();
    while let Some((&corners, _)) = words.split_first() {
        // A journal may say any number: it is no more than there is.
        let width = (corners as usize).saturating_mul(AREA_CORNER_WORDS as usize).saturating_add(1);
        let Some((area, rest)) = words.split_at_checked(width) else { break };
        areas.push(area);
        words = rest;
    }
    areas
}

/// The bytes of what an event has to say.
fn said(event: &Event) -> usize {
    match event {
        Event::Logged(text) | Event::Aborted(text) => text.len(),
        Event::Reported(_, words)
        | Event::Remembered(_, words)
        | Event::Began(_, words)
        | Event::Finished(_, words)
        | Event::Switched { values: words, .. } => size_of_val(words.as_slice()),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::areas;

    #[test]
    fn areas_are_told_apart_and_what_is_cut_off_or_cannot_be_is_none() {
        let words = [1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 2.0, 5.0];
        assert_eq!(areas(&words), [&words[..5], &words[5..6]]);
        for corners in [f64::INFINITY, 4e9, 1e300] {
            assert!(areas(&[corners, 0.0]).is_empty(), "{corners}");
        }
        assert_eq!(areas(&[f64::NAN, -1.0]).len(), 2);
    }
}
