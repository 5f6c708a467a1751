//! The report of a run that goes on: the same data as that of a run that is over, folded as records come, and told piece by piece.
//!
//! A thread of its own folds. Who asks for what is new holds up that thread alone: the driver hands its records to a queue, and what
//! finds no room in it is left out and counted.

use super::data::{Head, ReportData, ReportedRow, RunDiagram, Spans};
use super::recorder::{Counts, Fold, NewParts};
use super::world::{BottomCells, KnownWorld};
use super::{REPORTS_MAX, diagrams, head, world};
use crate::plan::Plan;
use crate::recorders::Recorder;
use crate::recorders::results::Results;
use albacore_diagram::Diagram;
use albacore_lang::Script;
use albacore_trace::TickRecord;
use albacore_trace::journal::{JournalHeader, World};
use serde::Serialize;
use std::fmt;
use std::str::FromStr;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Ticks between two looks whether there is more of the world to be seen.
const WORLD_TICKS: u64 = 10;
/// A map that has become too small has so much room about what is to be seen, in parts of its size.
const ROOM: f64 = 0.25;

/// The report of a run that goes on.
pub struct LiveReport(Mutex<State>);

/// What somebody knows of it already: it is told as numbers with points between them, `1.420.3.57.50.112.0.4`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cursor {
    counts: Counts,
    reports: u64,
    world: u64,
}

/// What has come since somebody asked before.
#[derive(Clone, Debug, Serialize)]
pub struct Increment {
    /// What is to be said to be told only what comes after this.
    pub cursor: String,
    /// Whether all that was told before is to be forgotten: of numbers there are half as many now, or nothing was known.
    pub anew: bool,
    /// Whether the run has ended: nothing comes after this.
    pub ended: bool,
    /// What is run, and how it stands.
    pub head: Head,
    /// The world, if more of it is known.
    pub world: Option<KnownWorld>,
    /// From this share of full scale on chemical is detected.
    pub detection: Option<f64>,
    /// Seconds between the numbers of a series.
    pub every_s: u64,
    /// The slot from which the numbers are told.
    pub slot: usize,
    /// What is new of all that grows.
    #[serde(flatten)]
    pub parts: NewParts,
    /// The switching tables that have run, if there are more, or more of their behaviors have been active.
    pub diagrams: Option<Vec<RunDiagram>>,
    /// What was reported, all of it, if there is more.
    pub reports: Option<Vec<ReportedRow>>,
    /// How many reports there are beside those.
    pub more_reports: u64,
    /// Ticks that are not in it: the host was too slow.
    pub missed: u64,
}

struct State {
    fold: Fold,
    results: Results,
    set: Vec<String>,
    is_link: bool,
    is_simulated: bool,
    known_diagrams: Vec<Diagram>,
    /// The diagrams of what had run when so many activities had names.
    diagrams: (usize, Vec<RunDiagram>),
    world: KnownWorld,
    bottom: Option<BottomCells>,
    /// How often the world has been another.
    world_version: u64,
    /// When it was made, so many reports there were, and whether areas and the start were known.
    world_of: (u64, bool, bool),
    missed: u64,
    has_ended: bool,
}

impl LiveReport {
    /// Of a run that begins.
    pub(crate) fn new(script: &Script, plan: &Plan, header: &JournalHeader) -> Self {
        let results = Results::new(plan, header.seed, header.start);
        let is_link = matches!(header.world, World::Link);
        let extent = world::extent(&results, None, !is_link);
        let bottom = world::bottom(&results, extent, !is_link);
        LiveReport(Mutex::new(State {
            fold: Fold::new(plan, header),
            world: world::known(&results, extent, !is_link, bottom.clone()),
            bottom,
            results,
            set: header.set.clone(),
            is_link,
            is_simulated: !is_link,
            known_diagrams: script.diagrams().collect(),
            diagrams: (0, Vec::new()),
            world_version: 1,
            world_of: (0, false, !is_link),
            missed: 0,
            has_ended: false,
        }))
    }

    /// Takes in a step; so many before it were left out.
    pub(crate) fn take(&self, unseen: u64, record: &TickRecord) {
        self.state().take(unseen, record);
    }

    /// A report in which nothing has happened yet: with this a page begins.
    pub fn beginning(&self) -> ReportData {
        let state = self.state();
        ReportData {
            head: state.head(),
            reports: Vec::new(),
            more_reports: 0,
            world: state.world.clone(),
            plume: None,
            detection: state.fold.detection(),
            every_s: 1,
            series: Vec::new(),
            colours: Vec::new(),
            activities: Vec::new(),
            spans: Spans::default(),
            diagrams: Vec::new(),
            happenings: Vec::new(),
            happenings_left_out: 0,
        }
    }

    /// What has come since somebody knew that much; all there is for who knows nothing.
    pub fn since(&self, known: Option<Cursor>) -> Increment {
        self.state().since(known)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn take(&mut self, unseen: u64, record: &TickRecord) {
        if unseen > 0 {
            self.missed += unseen;
            self.fold.miss(unseen, record.tick);
            self.results.miss(unseen, record.tick);
        }
        self.fold.take(record);
        self.results.take(record);
        self.has_ended |= record.ending().is_some();
        let (names, _) = self.diagrams;
        let named = self.fold.counts().names;
        if named > names {
            let tables = self.fold.tables();
            self.diagrams = (named, diagrams::of_run(&self.known_diagrams, &self.results.plan.program, &tables));
        }
        if self.has_ended || record.tick.is_multiple_of(WORLD_TICKS) {
            self.look_about();
        }
    }

    /// Follows what is known of the world. While the run goes on a map has room, so that it is seldom made anew; in the end it is as that
    /// of any report.
    fn look_about(&mut self) {
        let needed = world::extent(&self.results, self.fold.reach(), self.is_simulated);
        let results = &self.results;
        let (shown, of) =
            (self.world.extent, (results.reports.in_all(), !results.area.is_empty(), results.start.is_some()));
        let fits = if self.has_ended { shown == needed } else { shown.covers(&needed) };
        if fits && of == self.world_of {
            return;
        }
        let extent = match () {
            () if fits => shown,
            () if self.has_ended => needed,
            () => needed.roomy(ROOM),
        };
        if !fits {
            self.bottom = world::bottom(&self.results, extent, self.is_simulated);
        }
        self.world = world::known(&self.results, extent, self.is_simulated, self.bottom.clone());
        self.world_of = of;
        self.world_version += 1;
    }

    fn head(&self) -> Head {
        head(&self.results.brief(0.0), self.results.seed, &self.set, self.is_link, &None, None)
    }

    fn since(&self, known: Option<Cursor>) -> Increment {
        let now =
            Cursor { counts: self.fold.counts(), reports: self.results.reports.in_all(), world: self.world_version };
        // Who knows more than there is knows of another run.
        let known = known.filter(|known| known.counts.every_s == now.counts.every_s && known.is_before(&now));
        let from = known.unwrap_or_default();
        let listed = || self.results.reports.listed.iter().take(REPORTS_MAX).map(ReportedRow::new).collect();
        Increment {
            cursor: now.to_string(),
            anew: known.is_none(),
            ended: self.has_ended,
            head: self.head(),
            world: (from.world < now.world).then(|| self.world.clone()),
            detection: self.fold.detection(),
            every_s: now.counts.every_s,
            slot: from.counts.slot,
            parts: self.fold.since(&from.counts),
            diagrams: (from.counts.names < now.counts.names).then(|| self.diagrams.1.clone()),
            reports: (from.reports < now.reports || known.is_none()).then(listed),
            more_reports: now.reports - (self.results.reports.listed.len().min(REPORTS_MAX) as u64),
            missed: self.missed,
        }
    }
}

impl Cursor {
    fn numbers(&self) -> [u64; 8] {
        let Counts { every_s, slot, names, spans, closed, lines } = self.counts;
        let [slot, names, spans, closed, lines] = [slot, names, spans, closed, lines].map(|count| count as u64);
        [every_s, slot, names, spans, closed, lines, self.reports, self.world]
    }

    fn is_before(&self, now: &Cursor) -> bool {
        self.numbers().iter().zip(now.numbers()).all(|(known, now)| *known <= now)
    }
}

impl fmt::Display for Cursor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.numbers().map(|number| number.to_string()).join("."))
    }
}

/// A text that is no cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoCursor;

impl FromStr for Cursor {
    type Err = NoCursor;

    fn from_str(text: &str) -> Result<Self, NoCursor> {
        let numbers: Vec<u64> =
            text.split('.').map(|part| part.parse().map_err(|_| NoCursor)).collect::<Result<_, _>>()?;
        let [every_s, slot, names, spans, closed, lines, reports, world] = numbers[..] else { return Err(NoCursor) };
        let count = |number: u64| usize::try_from(number).map_err(|_| NoCursor);
        let counts = Counts {
            every_s,
            slot: count(slot)?,
            names: count(names)?,
            spans: count(spans)?,
            closed: count(closed)?,
            lines: count(lines)?,
        };
        Ok(Cursor { counts, reports, world })
    }
}

#[cfg(test)]
mod tests {
    use super::{Counts, Cursor, NoCursor};

    #[test]
    fn a_cursor_is_read_back_and_nothing_else_is_one() {
        let counts = Counts { every_s: 2, slot: 420, names: 3, spans: 57, closed: 50, lines: 112 };
        let cursor = Cursor { counts, reports: 0, world: 4 };
        assert_eq!(cursor.to_string(), "2.420.3.57.50.112.0.4");
        assert_eq!(cursor.to_string().parse(), Ok(cursor));
        for text in [
            "",
            "1",
            "1.2.3.4.5.6.7",
            "1.2.3.4.5.6.7.8.9",
            "1.2.3.4.5.6.7.-8",
            "1.2.3.4.5.6.7.x",
            "99999999999999999999999.0.0.0.0.0.0.0",
        ] {
            assert_eq!(text.parse::<Cursor>(), Err(NoCursor), "{text}");
        }
        let later = Cursor { counts: Counts { lines: 113, ..counts }, ..cursor };
        assert!(cursor.is_before(&later) && !later.is_before(&cursor));
    }
}
