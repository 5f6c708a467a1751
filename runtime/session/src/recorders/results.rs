//! The result of a run: how it ended, what it reported and how far that is from what there is to be found, and the way it took.

use super::Recorder;
use super::account::Account;
use super::navigation::NavigationAccount;
use crate::boundary::true_outline;
use crate::plan::Plan;
use crate::reported::{Reader, areas, corners, fields};
use crate::summary::{Origin, Report, Summary};
use albacore_geometry::{Area, Point, Vector};
use albacore_machine::{Event, Outcome};
use albacore_program::{Shape, number};
use albacore_sim::Slick;
use albacore_trace::{Cells, Ending, Release, Step, TickRecord};
use albacore_vehicle::seconds;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Reports that a result lists; of more only the first of each place of the program that reports, and their number.
const REPORTS_LISTED_MAX: usize = 10_000;
/// Words of reports that it lists, in the same way: maps are large.
const REPORTED_WORDS_MAX: usize = 1_000_000;
/// Areas of different names that are drawn.
const AREAS_DRAWN_MAX: usize = 40;
/// A link's positions are 0.2 m fine: shorter steps than this, m, would count its rounding as a way.
const LINK_GRAIN: f64 = 2.0;

/// What a run has reported so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reports {
    /// The first ones, and the first of each place of the program.
    pub listed: Vec<Report>,
    /// How many there were beside those.
    pub more: u64,
    /// The words of those that are listed.
    words: usize,
    /// The place that was reported last.
    pub latest: Option<Point>,
    sites: BTreeSet<u32>,
    /// All of them, those that are not listed too, by their names.
    named: BTreeMap<String, Named>,
    /// Which of a name are kept beside the first and the last.
    wanted: BTreeMap<String, BTreeSet<u64>>,
}

/// Something that was reported: when, and where, if it was a place.
#[derive(Clone, Debug)]
pub(crate) struct Reported {
    pub t_s: f64,
    pub place: Option<Point>,
    /// Which place of the program reported it.
    site: u32,
    words: Arc<[f64]>,
}

/// The reports of a name.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    pub first: Reported,
    pub last: Reported,
    pub count: u64,
    /// Those that are wanted by their numbers.
    numbered: BTreeMap<u64, Reported>,
}

impl Named {
    /// The report of a number, from 1 on, if there is one and it was wanted.
    pub fn number(&self, number: u64) -> Option<&Reported> {
        if number == 1 { Some(&self.first) } else { self.numbered.get(&number) }
    }
}

impl Reports {
    /// What was reported by a name, if anything was.
    pub fn named(&self, name: &str) -> Option<&Named> {
        self.named.get(name)
    }

    /// Keeps the report of a number of a name, when it comes.
    pub fn want(&mut self, name: &str, number: u64) {
        self.wanted.entry(name.to_string()).or_default().insert(number);
    }

    fn count(&mut self, name: &str, reported: Reported) {
        match self.named.get_mut(name) {
            Some(named) => {
                named.count += 1;
                if self.wanted.get(name).is_some_and(|numbers| numbers.contains(&named.count)) {
                    named.numbered.insert(named.count, reported.clone());
                }
                named.last = reported;
            }
            None => {
                let named = Named { first: reported.clone(), last: reported, count: 1, numbered: BTreeMap::new() };
                self.named.insert(name.to_string(), named);
            }
        }
    }

    /// How many there were.
    pub fn in_all(&self) -> u64 {
        self.listed.len() as u64 + self.more
    }

    /// Whether there is room for one more, of a place of the program and of so many words.
    fn admits(&mut self, site: u32, words: usize) -> bool {
        let first = self.sites.insert(site);
        let is_room = self.listed.len() < REPORTS_LISTED_MAX && self.words + words <= REPORTED_WORDS_MAX;
        let admits = first || is_room;
        self.words += if admits { words } else { 0 };
        self.more += u64::from(!admits);
        admits
    }
}

/// Metres driven, from position to position.
struct Odometer {
    last: Option<Point>,
    /// Steps shorter than this are not counted until they add up to it, m.
    grain: f64,
    length: f64,
}

impl Odometer {
    /// Of a vehicle that starts there; where that is not known it is at the end of a link.
    fn new(start: Option<Point>) -> Self {
        Odometer { last: start, grain: if start.is_some() { 0.0 } else { LINK_GRAIN }, length: 0.0 }
    }

    /// The vehicle is here now: so far on, m, as it is counted.
    fn reach(&mut self, here: Point) -> f64 {
        let step = here.distance(self.last.unwrap_or(here));
        let counted = if step >= self.grain { step } else { 0.0 };
        if step >= self.grain || self.last.is_none() {
            self.last = Some(here);
        }
        self.length += counted;
        counted
    }
}

/// Gathers the result.
pub(crate) struct Results {
    pub plan: Plan,
    pub seed: u64,
    pub reports: Reports,
    /// The corners of the mission's operating area, once it has one.
    pub area: Vec<Point>,
    /// Those of its other areas, by their names.
    pub regions: Vec<(String, Vec<Point>)>,
    /// The deepest point of that, once it has one; none where the water is equally deep everywhere.
    pub deepest: Option<Point>,
    /// The areas that were reported, each as it was last, by their names.
    pub areas: BTreeMap<String, Vec<Point>>,
    /// The map that was reported last.
    pub map: Option<Cells>,
    /// The spills of its world.
    pub slicks: Vec<Slick>,
    /// Where the vehicle was first.
    pub start: Option<Point>,
    /// Ticks so far.
    pub ticks: u64,
    /// How the run ended, once it has.
    pub ending: Option<Ending>,
    switches: u64,
    odometer: Odometer,
    account: Account,
    navigation: NavigationAccount,
}

impl Results {
    pub fn new(plan: &Plan, seed: u64, start: Option<Point>) -> Self {
        Results {
            plan: plan.clone(),
            seed,
            reports: Reports::default(),
            area: Vec::new(),
            regions: Vec::new(),
            deepest: None,
            areas: BTreeMap::new(),
            map: None,
            slicks: Slick::all(&plan.scenario.environment.spills, seed),
            start,
            ticks: 0,
            ending: None,
            switches: 0,
            odometer: Odometer::new(start),
            account: Account::new(&plan.program),
            navigation: NavigationAccount::default(),
        }
    }

    /// How the run ended, once it has.
    pub fn outcome(&self) -> Option<Outcome> {
        self.ending.as_ref().map(|ending| ending.outcome)
    }

    /// Why it ended so, in words.
    pub fn reason(&self) -> &str {
        self.ending.as_ref().map_or("", |ending| &ending.reason)
    }

    /// Whether the vehicle has not said that it took control back at the end.
    pub fn release_failed(&self) -> bool {
        self.ending.as_ref().is_some_and(|ending| ending.release == Release::Failed)
    }

    /// The result; `wall_s` is measured by who ran it.
    pub fn summary(&self, wall_s: f64) -> Summary {
        Summary { reports: self.reports.listed.clone(), ..self.brief(wall_s) }
    }

    /// The same without the reports, of which there may be many.
    pub fn brief(&self, wall_s: f64) -> Summary {
        Summary {
            mission: self.plan.program.mission.name.clone(),
            scenario: self.plan.scenario_name.clone(),
            origin: self.plan.program.mission.origin.map(Origin::from),
            seed: self.seed,
            outcome: self.outcome().map_or("running", Outcome::name),
            reason: self.reason().to_string(),
            ticks: self.ticks,
            sim_time_s: seconds(self.ticks),
            wall_s,
            path_length_m: self.odometer.length,
            switches: self.switches,
            holds: self.account.holds(),
            result: self.account.finished().cloned(),
            behaviors: self.account.behaviors(),
            reports: Vec::new(),
            more_reports: self.reports.more,
            navigation: self.navigation.summary(),
            recorded_rows: None,
            recorded_rows_left_out: 0,
            digest: self.ending.as_ref().map(|ending| format!("{:016x}", ending.digest)).unwrap_or_default(),
        }
    }

    /// What stands behind a label of a report, as an optional; as many words where there is none.
    pub fn labelled(&self, name: &str, label: &str, report: Option<&Reported>) -> Vec<f64> {
        let sites = &self.plan.program.reports;
        let own = report.and_then(|report| Some((sites.get(report.site as usize)?, &report.words)));
        if let Some((site, words)) = own
            && let Some((.., words)) = fields(site, words).find(|(other, ..)| *other == label)
        {
            return [&[1.0], words].concat();
        }
        let labels = sites.iter().filter(|site| site.name == name).flat_map(|site| &site.fields);
        let width = labels.filter(|(other, _)| other == label).map(|(_, value)| value.shape.words()).max();
        vec![0.0; 1 + width.unwrap_or(0) as usize]
    }

    /// Where a source truly is, by its name; of a leak where it begins.
    pub fn source(&self, name: &str) -> Option<Point> {
        let sources = &self.plan.scenario.environment.sources;
        sources.iter().find(|source| source.name == name).map(|source| source.at)
    }

    /// The true source nearest to a place.
    pub fn nearest_source(&self, to: Point) -> Option<Point> {
        let sources = self.plan.scenario.environment.sources.iter().map(|source| source.nearest(to));
        sources.min_by(|a, b| a.distance(to).total_cmp(&b.distance(to)))
    }

    /// The deepest point, where that is what is sought: there are hollows to be found, and no sources.
    pub fn deepest_sought(&self) -> Option<Point> {
        let world = &self.plan.scenario;
        self.deepest.filter(|_| world.environment.sources.is_empty() && world.environment.bottom.has_hollows())
    }

    /// What there is to be found, as far as anybody knows: the place that is nearest to another, and what it is.
    fn sought(&self, to: Point) -> Option<(Point, &'static str)> {
        let source = match self.plan.scenario.environment.sources.as_slice() {
            [_] => "the source",
            _ => "the nearest source",
        };
        let nearest = self.nearest_source(to).map(|at| (at, source));
        nearest.or(self.deepest_sought().map(|at| (at, "the deepest point of the area")))
    }

    /// How far the outline of an area that was reported is from that of the spill which it is meant to be of, m, and how large that truly is, m2.
    fn off_the_spill(&self, found: &Area, t_s: f64) -> Option<(f64, f64)> {
        let outline = true_outline(&self.slicks, None, found.center(), t_s)?;
        Some((found.mean_distance(&outline), outline.surface()))
    }

    /// The direction of the mean flow, as it is when the run begins; none where there is none.
    fn down_flow(&self) -> Option<Vector> {
        let mean = self.plan.scenario.environment.flow.mean;
        (mean.length() > 0.0).then(|| (1.0 / mean.length()) * mean)
    }

    /// Takes down what was reported at a place of the program.
    fn report(&mut self, tick: u64, site: u32, words: &[f64]) {
        let program = Arc::clone(&self.plan.program);
        // A journal may be of a script that has changed since.
        let (id, Some(site)) = (site, program.reports.get(site as usize)) else { return };
        let at = site.fields.first().and_then(|(_, value)| value.shape.first_point());
        let place = at.and_then(|at| Some(Point::new(*words.get(at)?, *words.get(at + 1)?)));
        self.reports.latest = place.or(self.reports.latest);
        let t_s = seconds(tick);
        self.reports.count(&site.name, Reported { t_s, place, site: id, words: words.into() });
        let frame = self.plan.frame();
        let reader = Reader { program: &program, frame };
        for (label, shape, words) in fields(site, words) {
            let name = if label.is_empty() { &site.name } else { label };
            self.map = reader.cells(name, shape, words).or(self.map.take());
            for (name, corners) in areas(name, shape, words) {
                if self.areas.len() < AREAS_DRAWN_MAX || self.areas.contains_key(&name) {
                    self.areas.insert(name, corners);
                }
            }
        }
        if !self.reports.admits(id, words.len()) {
            return;
        }
        let globe = place.and_then(|p| frame.map(|f| f.to_geodetic(p)));
        let sought = place.and_then(|p| self.sought(p));
        let mut outlines = fields(site, words).filter_map(|(_, shape, words)| corners(shape, words));
        let found =
            outlines.next().filter(|_| !self.slicks.is_empty()).and_then(|corners| Area::polygon(&corners).ok());
        let spill = found.and_then(|found| self.off_the_spill(&found, t_s));
        let values = fields(site, words).map(|(label, shape, words)| (label.to_string(), reader.json(shape, words)));
        let areas = fields(site, words)
            .flat_map(|(label, shape, words)| areas(if label.is_empty() { &site.name } else { label }, shape, words));
        let areas = areas.collect();
        let is_own_place = |label: &str, shape: &Shape| label.is_empty() && *shape == Shape::Point;
        let told = fields(site, words).filter(|(label, shape, _)| !is_own_place(label, shape));
        let told = told.map(|(label, shape, words)| match (label, number::value_with(&program.texts, shape, words)) {
            ("", value) => value,
            (label, value) => format!("{label} = {value}"),
        });
        let told = told.collect::<Vec<_>>().join(", ");
        let mut values: BTreeMap<_, _> = values.collect();
        self.reports.listed.push(Report {
            name: site.name.clone(),
            nth: self.reports.named(&site.name).map_or(0, |named| named.count - 1),
            site: id,
            t_s,
            north_m: place.map(|p| p.north),
            east_m: place.map(|p| p.east),
            latitude_deg: globe.map(|g| g.latitude_deg()),
            longitude_deg: globe.map(|g| g.longitude_deg()),
            true_north_m: sought.map(|(at, _)| at.north),
            true_east_m: sought.map(|(at, _)| at.east),
            error_m: spill.map(|(off, _)| off).or(place.zip(sought).map(|(p, (sought, _))| sought.distance(p))),
            true_surface_m2: spill.map(|(_, surface)| surface),
            error_along_m: place.zip(sought).and_then(|(p, (at, _))| Some((p - at).dot(self.down_flow()?))),
            error_across_m: place.zip(sought).and_then(|(p, (at, _))| {
                let down = self.down_flow()?;
                Some((p - at).dot(Vector::new(-down.east, down.north)))
            }),
            error_from: spill.map(|_| "the outline of the spill").or(sought.map(|(_, what)| what)),
            told,
            areas,
            value: values.remove("").unwrap_or_default(),
            labelled: values,
        });
    }

    /// Where the vehicle is, and what happened.
    fn note(&mut self, record: &TickRecord) {
        let here = record.here();
        self.start = self.start.or(here);
        let way = here.map_or(0.0, |here| self.odometer.reach(here));
        self.account.take(record, way);
        if let Some(errors) = &record.navigation {
            self.navigation.take(seconds(record.tick), errors);
        }
        for event in &record.events {
            match event {
                Event::Switched { .. } => self.switches += 1,
                Event::Reported(site, words) => self.report(record.tick, *site, words),
                _ => {}
            }
        }
    }
}

impl Recorder for Results {
    fn miss(&mut self, _steps: u64, _tick: u64) {
        self.account.lose();
    }

    fn take(&mut self, record: &TickRecord) {
        if self.area.is_empty() && !record.areas.is_empty() {
            let names = self.plan.program.mission.areas.iter().map(|area| area.name.clone());
            let mut areas = names.zip(record.corners());
            self.area = areas.next().map(|(_, corners)| corners).unwrap_or_default();
            self.regions = areas.collect();
            let (bottom, area) = (&self.plan.scenario.environment.bottom, Area::polygon(&self.area).ok());
            self.deepest = area.filter(|_| !bottom.is_level()).map(|area| self.plan.deepest(area));
        }
        match &record.step {
            Step::Wait => {}
            Step::Tick => {
                self.note(record);
                self.ticks = record.tick + 1;
            }
            Step::End(ending) => {
                if !record.events.is_empty() {
                    self.note(record);
                }
                self.ticks = record.tick;
                self.ending = Some(ending.clone());
            }
        }
    }
}
