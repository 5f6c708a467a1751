//! What a mission reports, and how far it is from what there is to be found.

use super::recorder::Recorder;
use crate::summary::Report;
use albacore_geometry::Point;
use albacore_vehicle::TICK_S;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Reports that a result lists; of more only the first of each place of the program that reports, and their number.
const REPORTS_LISTED_MAX: usize = 10_000;

/// What a run has reported so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reports {
    /// The first ones, and the first of each place of the program.
    pub listed: Vec<Report>,
    /// How many there were beside those.
    pub more: u64,
    /// The place that was reported last.
    pub latest: Option<Point>,
    sites: BTreeSet<u32>,
}

impl Reports {
    /// Whether there is room for one more, of a place of the program.
    fn admits(&mut self, site: u32) -> bool {
        let first = self.sites.insert(site);
        let admits = first || self.listed.len() < REPORTS_LISTED_MAX;
        self.more += u64::from(!admits);
        admits
    }
}

impl Recorder {
    /// Takes down what was reported at a place of the program.
    pub(super) fn report(&mut self, tick: u64, site: u32, words: &[f64]) {
        let program = Arc::clone(&self.plan.program);
        let (id, site) = (site, &program.reports[site as usize]);
        let at = site.fields.first().and_then(|(_, value)| value.shape.first_point());
        let place = at.and_then(|at| Some(Point::new(*words.get(at)?, *words.get(at + 1)?)));
        self.reports.latest = place.or(self.reports.latest);
        if !self.reports.admits(id) {
            return;
        }
        let frame = self.plan.frame();
        let globe = place.and_then(|p| frame.map(|f| f.to_geodetic(p)));
        let sought = place.and_then(|p| self.sought(p));
        self.reports.listed.push(Report {
            name: site.name.clone(),
            t_s: tick as f64 / (1.0 / TICK_S),
            north_m: place.map(|p| p.north),
            east_m: place.map(|p| p.east),
            latitude_deg: globe.map(|g| g.latitude_deg()),
            longitude_deg: globe.map(|g| g.longitude_deg()),
            error_m: place.zip(sought).map(|(p, (sought, _))| sought.distance(p)),
            error_from: sought.map(|(_, what)| what),
        });
    }

    /// The place of a true source that is nearest to another.
    pub(crate) fn nearest_source(&self, to: Point) -> Option<Point> {
        let sources = self.plan.scenario.sources.iter().map(|source| source.nearest(to));
        sources.min_by(|a, b| a.distance(to).total_cmp(&b.distance(to)))
    }

    /// What there is to be found, as far as anybody knows: the place that is nearest to another, and what it is.
    fn sought(&self, to: Point) -> Option<(Point, &'static str)> {
        let source = match self.plan.scenario.sources.as_slice() {
            [_] => "the source",
            _ => "the nearest source",
        };
        let nearest = self.nearest_source(to).map(|at| (at, source));
        nearest.or(self.deepest_sought().map(|at| (at, "the deepest point of the area")))
    }
}
