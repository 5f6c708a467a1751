//! What is known of a run, in no format: the one structure that all formats are made of. Its texts are fit to be seen already; what
//! a format has to escape it escapes itself.

use albacore_vehicle::TICK_S;
use serde_json::Value;
use std::collections::BTreeSet;
use std::ops::Range;

/// A tick in milliseconds, in which all times are counted.
pub const TICK_MS: i64 = 100;
const _: () = assert!(TICK_S * 1000.0 == TICK_MS as f64);

/// Maps have a point for each second: so many ticks.
const POINT_EVERY_TICKS: u64 = 10;

/// A run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exported {
    /// What was run.
    pub about: About,
    /// The tick of each row, rising.
    pub ticks: Vec<u64>,
    /// Columns with a value for each row.
    pub columns: Vec<Column>,
    /// Where the mission believes the vehicle to be.
    pub believed: Track,
    /// Where it is, in simulation.
    pub truth: Option<Track>,
    /// The mission's area, then its regions.
    pub outlines: Vec<Outline>,
    /// What in simulation chemical truly lies within, when the run ended.
    pub true_outlines: Vec<Outline>,
    /// What was reported, in the order of time.
    pub reports: Vec<Reported>,
    /// The lines of the trace, in the order of time.
    pub events: Vec<Happened>,
}

/// What was run, and how it ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The version of Albacore that exports it.
    pub version: String,
    /// The mission.
    pub mission: String,
    /// The scenario, or the link.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// `completed`, `timed_out`, …; empty where the journal does not tell.
    pub outcome: String,
    /// Why, when there is something to say.
    pub reason: String,
    /// The digest of the run; empty where the journal does not tell.
    pub digest: String,
    /// The first tick, milliseconds since the beginning of 1970, UTC; none where nobody knows.
    pub epoch_ms: Option<i64>,
    /// Whether the mission's plane lies on the globe.
    pub is_on_globe: bool,
}

impl About {
    /// What is told of a run in every format that has room for it, by name.
    pub fn facts(&self) -> Vec<(&'static str, String)> {
        let mut facts = vec![
            ("mission", self.mission.clone()),
            ("scenario", self.scenario.clone()),
            ("seed", self.seed.to_string()),
            ("outcome", self.outcome.clone()),
            ("reason", self.reason.clone()),
            ("digest", self.digest.clone()),
            ("exported_by", format!("Albacore {}", self.version)),
        ];
        if self.epoch_ms.is_none() {
            let remark = "when the run was is not known: its first tick is told as 1970-01-01T00:00:00Z";
            facts.push(("remark", remark.to_string()));
        }
        facts.retain(|(_, fact)| !fact.is_empty());
        facts
    }

    /// When a tick was, milliseconds since the beginning of 1970; where nobody knows the first was then.
    pub fn moment_ms(&self, tick: u64) -> i64 {
        let since = i64::try_from(tick).unwrap_or(i64::MAX).saturating_mul(TICK_MS);
        self.epoch_ms.unwrap_or(0).saturating_add(since)
    }
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, such as `depth` or `flow.north`.
    pub name: String,
    /// The unit of its numbers, as Albacore writes it; empty where they have none.
    pub unit: &'static str,
    /// What it is, in words.
    pub meaning: String,
    /// What it is to other programs, if they have a name of their own for it.
    pub role: Option<Role>,
    /// Its standard name by the CF conventions, if there is one.
    pub standard_name: Option<&'static str>,
    /// Its values.
    pub values: Values,
}

impl Column {
    /// Its name with its unit, as a table has it.
    pub fn head(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }
}

/// What other programs have a name of their own for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is what its name says")]
pub enum Role {
    North,
    East,
    Latitude,
    Longitude,
    Depth,
    Altitude,
    Heading,
    Speed,
    CommandedHeading,
    CommandedSpeed,
    CommandedDepth,
    CommandedAltitude,
    Behavior,
}

/// A value for each row.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers; what is not finite is absent.
    Numbers(Vec<f64>),
    /// Seconds since the beginning of 1970, UTC; what is not finite is absent.
    Dates(Vec<f64>),
    /// The texts that there are, and for each row the place of its own; beyond them where it has none.
    Texts(Vec<String>, Vec<u32>),
}

impl Values {
    /// The number of a row, if it has one.
    pub fn number(&self, row: usize) -> Option<f64> {
        match self {
            Values::Numbers(numbers) | Values::Dates(numbers) => {
                numbers.get(row).copied().filter(|number| number.is_finite())
            }
            Values::Texts(..) => None,
        }
    }

    /// The text of a row, if it has one.
    pub fn text(&self, row: usize) -> Option<&str> {
        match self {
            Values::Texts(texts, rows) => texts.get(*rows.get(row)? as usize).map(String::as_str),
            Values::Numbers(_) | Values::Dates(_) => None,
        }
    }
}

/// A place; numbers that nobody knows are none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Metres north of the mission's origin.
    pub north: f64,
    /// Metres east of it.
    pub east: f64,
    /// Degrees.
    pub latitude: f64,
    /// Degrees.
    pub longitude: f64,
    /// Metres below the surface.
    pub depth: f64,
}

impl Place {
    /// A place that nobody knows.
    pub const UNKNOWN: Place =
        Place { north: f64::NAN, east: f64::NAN, latitude: f64::NAN, longitude: f64::NAN, depth: f64::NAN };

    /// Whether it can be put on a map.
    pub fn is_on_globe(&self) -> bool {
        self.latitude.is_finite() && self.longitude.is_finite()
    }
}

/// A way: a place for each row, held from one that is known to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track(pub Vec<Place>);

/// An area.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its name.
    pub name: String,
    /// Its corners; the first is not told twice.
    pub corners: Vec<Place>,
}

impl Outline {
    /// The corners that can be put on a map, and the first once more; none of what is no area there.
    pub(crate) fn ring(&self) -> Option<Vec<&Place>> {
        let mut ring: Vec<&Place> = self.corners.iter().filter(|corner| corner.is_on_globe()).collect();
        if ring.len() < 3 {
            return None;
        }
        ring.push(ring[0]);
        Some(ring)
    }
}

/// What was reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Reported {
    /// When.
    pub tick: u64,
    /// Its name.
    pub name: String,
    /// What, in words.
    pub told: String,
    /// Where, if a place was reported.
    pub place: Option<Place>,
    /// The areas in it.
    pub areas: Vec<Outline>,
    /// What, for a program: an object.
    pub value: Value,
}

/// A line of the trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Happened {
    /// When.
    pub tick: u64,
    /// What kind: the trace's word for it.
    pub verb: String,
    /// What.
    pub text: String,
}

/// All that belongs to one tick.
pub(crate) struct Moment<'a> {
    pub tick: u64,
    pub row: Option<usize>,
    pub reports: &'a [Reported],
    pub events: &'a [Happened],
}

impl Exported {
    /// All ticks of which anything is known, in order. `see` takes each.
    pub(crate) fn each_moment(&self, mut see: impl FnMut(Moment)) {
        let (mut row, mut report, mut event) = (0, 0, 0);
        loop {
            let nexts = [
                self.ticks.get(row).copied(),
                self.reports.get(report).map(|report| report.tick),
                self.events.get(event).map(|event| event.tick),
            ];
            let Some(tick) = nexts.into_iter().flatten().min() else { break };
            let reports = until(report, self.reports.len(), |at| self.reports[at].tick <= tick);
            let events = until(event, self.events.len(), |at| self.events[at].tick <= tick);
            let is_row = self.ticks.get(row) == Some(&tick);
            (report, event) = (reports.end, events.end);
            see(Moment {
                tick,
                row: is_row.then_some(row),
                reports: &self.reports[reports],
                events: &self.events[events],
            });
            row += usize::from(is_row);
        }
    }

    /// The points of a track for a map: each with its tick, one a second and the last.
    pub(crate) fn points<'a>(&'a self, track: &'a Track) -> impl Iterator<Item = (u64, &'a Place)> {
        let last = self.ticks.len().saturating_sub(1);
        let rows = self.ticks.iter().copied().zip(&track.0).enumerate();
        let is_due = move |row: usize, tick: u64| row == last || tick.is_multiple_of(POINT_EVERY_TICKS);
        rows.filter(move |(row, (tick, place))| is_due(*row, *tick) && place.is_on_globe()).map(|(_, point)| point)
    }

    /// When the run ended: its last tick.
    pub(crate) fn end(&self) -> u64 {
        self.ticks.last().copied().unwrap_or_default()
    }

    /// The tracks with their names.
    pub(crate) fn tracks(&self) -> impl Iterator<Item = (&'static str, &Track)> {
        std::iter::once(("track", &self.believed)).chain(self.truth.iter().map(|truth| ("true track", truth)))
    }

    /// For each column a name that programs can have, none of which is among those that are taken.
    pub(crate) fn names_in_programs(&self, taken: &[&str]) -> Vec<String> {
        let mut known: BTreeSet<String> = taken.iter().map(|name| name.to_string()).collect();
        let named = self.columns.iter().map(|column| {
            let base = name_in_programs(&column.name);
            let numbered = (2u32..).map(|number| format!("{base}_{number}"));
            let free = std::iter::once(base.clone()).chain(numbered).find(|name| !known.contains(name));
            let name = free.unwrap_or(base);
            known.insert(name.clone());
            name
        });
        named.collect()
    }
}

/// The places from one on for which something holds.
fn until(from: usize, end: usize, holds: impl Fn(usize) -> bool) -> Range<usize> {
    from..(from..end).find(|at| !holds(*at)).unwrap_or(end)
}

/// A name as programs can have it: letters, digits and `_`, and no digit at its beginning.
pub fn name_in_programs(name: &str) -> String {
    let mut out: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !out.starts_with(|c: char| c.is_ascii_alphabetic()) {
        out.insert_str(0, "x_");
    }
    out
}
