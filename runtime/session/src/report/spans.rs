//! When each activity was active, by how deep it was nested.

use albacore_machine::Event;
use albacore_program::ActivityId;
use albacore_trace::TickRecord;
use serde::Serialize;

/// More stretches than these are not shown.
const SPANS_MAX: usize = 50_000;

/// Stretches of time in which activities were active, in the order of their beginnings.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Spans {
    /// Of each stretch the activity: an index into the names.
    pub activity: Vec<usize>,
    /// How deep it was nested: the mission 0.
    pub level: Vec<usize>,
    /// Its first tick, each as the difference from the one before.
    pub from: Vec<u64>,
    /// How many ticks it lasted.
    pub ticks: Vec<u64>,
}

/// An activity that is active.
struct Open {
    id: ActivityId,
    place: usize,
    from: u64,
}

/// Follows what is active.
#[derive(Default)]
pub(super) struct SpanFold {
    spans: Spans,
    open: Vec<Open>,
    last_from: u64,
    /// The places of those that have ended, in the order of their ends.
    closed: Vec<usize>,
}

/// What has come to the stretches since a moment.
#[derive(Clone, Debug, Default, Serialize)]
pub struct NewSpans {
    /// Of each new stretch the activity: an index into the names.
    pub activity: Vec<usize>,
    /// How deep it is nested.
    pub level: Vec<usize>,
    /// Its first tick.
    pub from: Vec<u64>,
    /// Stretches that have ended: each its place among all, and how many ticks it lasted.
    pub closed: Vec<(usize, u64)>,
}

impl SpanFold {
    /// Takes in what is active in a tick. `name` gives an activity its index.
    pub fn take(&mut self, record: &TickRecord, name: &mut impl FnMut(ActivityId) -> usize) {
        let same = self.open.iter().zip(&record.active).take_while(|(open, id)| open.id == **id).count();
        // What is entered anew in the tick in which it was left begins a stretch of its own.
        let is_entered = |id: &ActivityId| record.events.contains(&Event::Entered(*id));
        let anew = record.active.iter().take(same).position(is_entered).unwrap_or(same);
        self.close(anew, record.tick);
        // Ticks go on, whatever a journal says.
        let tick = record.tick.max(self.last_from);
        for (level, &id) in record.active.iter().enumerate().skip(anew) {
            if self.spans.from.len() >= SPANS_MAX {
                return;
            }
            self.open.push(Open { id, place: self.spans.from.len(), from: tick });
            self.spans.activity.push(name(id));
            self.spans.level.push(level);
            self.spans.from.push(tick - self.last_from);
            self.spans.ticks.push(0);
            self.last_from = tick;
        }
    }

    /// All end: what follows is not known, or nothing follows.
    pub fn lose(&mut self, tick: u64) {
        self.close(0, tick);
    }

    /// How many stretches there are, and how many of them have ended.
    pub fn counts(&self) -> (usize, usize) {
        (self.spans.from.len(), self.closed.len())
    }

    /// What has come since there were so many stretches, and so many of them had ended.
    pub fn since(&self, known: usize, closed: usize) -> NewSpans {
        let Spans { activity, level, from, ticks } = &self.spans;
        let firsts = from.iter().scan(0, |tick, step| {
            *tick += step;
            Some(*tick)
        });
        let lasted = |place: &usize| Some((*place, *ticks.get(*place)?));
        NewSpans {
            activity: activity.iter().skip(known).copied().collect(),
            level: level.iter().skip(known).copied().collect(),
            from: firsts.skip(known).collect(),
            closed: self.closed.iter().skip(closed).filter_map(lasted).collect(),
        }
    }

    pub fn finish(mut self, tick: u64) -> Spans {
        self.close(0, tick);
        self.spans
    }

    fn close(&mut self, level: usize, tick: u64) {
        let level = level.min(self.open.len());
        for open in self.open.drain(level..) {
            if let Some(ticks) = self.spans.ticks.get_mut(open.place) {
                *ticks = tick.saturating_sub(open.from);
                self.closed.push(open.place);
            }
        }
    }
}
