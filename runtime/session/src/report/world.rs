//! The world of a run as its page shows it: areas, the bottom, sources, the true outlines of spills with how they move, and the plume as it
//! moved, which is simulated once more from the run's seed.

use super::series::packed;
use crate::boundary::room;
use crate::plan::Plan;
use crate::recorders::results::Results;
use albacore_geometry::{Point, TangentFrame};
use albacore_program::seen::one_line;
use albacore_sim::{Slick, World};
use albacore_vehicle::seconds;
use serde::Serialize;

/// Cells of the bottom along each side of the map.
const BOTTOM_CELLS: usize = 80;
/// Filaments of a moment, and of all, that a page has.
const FILAMENTS_MAX: usize = 500;
const FILAMENTS_IN_ALL: usize = 150_000;
/// Seconds between two moments of the plume at least; of a long run more.
const FRAME_S: u64 = 20;
/// No plume is simulated for longer, ticks: 100 h.
const TICKS_MAX: u64 = 3_600_000;
/// Moments at most.
const FRAMES_MAX: u64 = 300;
/// The plume is shown this far beyond what else there is, in parts of its size.
const BEYOND: f64 = 0.25;
/// Places on the globe are told at so many points along each side of the map, between which a page interpolates.
const GLOBE_POINTS: usize = 3;

/// Corners of an outline, m, north and east by turns.
type Corners = Vec<f64>;

/// A name and an outline or a place.
#[derive(Clone, Debug, Serialize)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// North and east by turns, m.
    pub at: Corners,
}

/// What is known of the world of a run.
#[derive(Clone, Debug, Serialize)]
pub struct KnownWorld {
    /// The least and the greatest north and east of all that is to be seen, m.
    pub extent: Extent,
    /// Latitude and longitude, degrees, at points of the extent: rows of north, each of east.
    pub globe: Option<Vec<(f64, f64)>>,
    /// The operating area and its regions.
    pub areas: Vec<Named>,
    /// Areas that were reported.
    pub outlines: Vec<Named>,
    /// Where the vehicle must not be.
    pub no_go: Vec<Named>,
    /// True sources; of one that is a line both its ends.
    pub sources: Vec<Named>,
    /// The true outlines of spills.
    pub true_outlines: Vec<MovingOutline>,
    /// The deepest point, where it is sought, m.
    pub deepest: Option<(f64, f64)>,
    /// Where the vehicle started, m.
    pub start: Option<(f64, f64)>,
    /// The bottom, where it is not level.
    pub bottom: Option<BottomCells>,
    /// The mean flow, m/s north and east, if any.
    pub flow: Option<(f64, f64)>,
    /// Whether the truth is known.
    pub is_simulated: bool,
}

/// The true outline of a spill. Each of its corners moves along a straight line, so that a page has it at any moment.
#[derive(Clone, Debug, Serialize)]
pub struct MovingOutline {
    /// Its name.
    pub name: String,
    /// North and east of its corners when the run begins, dm, in two packed lists.
    pub at: [Vec<Option<i64>>; 2],
    /// How fast they move north and east, um/s, in two packed lists.
    pub moves: [Vec<Option<i64>>; 2],
    /// In what time half of the chemical is gone, s; none where it stays.
    pub half_life_s: Option<f64>,
}

impl MovingOutline {
    fn new(slick: &Slick) -> Self {
        let whole = |x: f64, scale: f64| x.is_finite().then(|| (x * scale).round() as i64);
        let (corners, motion) = (slick.corners(0.0), slick.motion());
        let moves: Vec<_> = motion.map(|v| (whole(v.north, 1e6), whole(v.east, 1e6))).collect();
        MovingOutline {
            name: one_line(slick.name()),
            at: [
                packed(corners.iter().map(|p| whole(p.north, 10.0))),
                packed(corners.iter().map(|p| whole(p.east, 10.0))),
            ],
            moves: [packed(moves.iter().map(|v| v.0)), packed(moves.iter().map(|v| v.1))],
            half_life_s: slick.half_life(),
        }
    }
}

/// The depth of the water in cells.
#[derive(Clone, Debug, Serialize)]
pub struct BottomCells {
    /// Cells along north and along east.
    pub cells: usize,
    /// Depths at the middles of the cells of the extent, dm, from south to north, each row from west to east, packed.
    pub depths: Vec<Option<i64>>,
}

/// The plume at some moments.
#[derive(Clone, Debug, Serialize)]
pub struct PlumeFrames {
    /// Seconds between them.
    pub every_s: u64,
    /// Of each moment north, east (m) and radius (dm) of its filaments, in three packed lists.
    pub frames: Vec<[Vec<Option<i64>>; 3]>,
}

/// The same, and the filaments of the end.
pub(super) struct SimulatedPlume {
    pub data: PlumeFrames,
    pub at_end: Vec<(Point, f64)>,
}

/// A rectangle of the map, m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Extent {
    south: f64,
    west: f64,
    north: f64,
    east: f64,
}

impl Extent {
    fn of(points: impl Iterator<Item = Point>, reach: Option<Extent>) -> Self {
        let around = points.filter_map(Extent::at_point).fold(reach, |of, p| Some(p.with(of)));
        // Of a vehicle that was nowhere there is some water about the origin.
        around.map_or(Extent::default().widened(50.0), |around| around.widened(10.0))
    }

    /// A point that can be on a map.
    pub(super) fn at_point(p: Point) -> Option<Self> {
        let can_be = p.north.abs() < 1e7 && p.east.abs() < 1e7;
        can_be.then_some(Extent { south: p.north, west: p.east, north: p.north, east: p.east })
    }

    /// The least that holds both.
    pub(super) fn with(self, other: Option<Extent>) -> Self {
        let other = other.unwrap_or(self);
        Extent {
            south: self.south.min(other.south),
            west: self.west.min(other.west),
            north: self.north.max(other.north),
            east: self.east.max(other.east),
        }
    }

    /// Whether all of another is in it.
    pub(super) fn covers(&self, other: &Extent) -> bool {
        self.with(Some(*other)) == *self
    }

    /// With room around it, in parts of its size.
    pub(super) fn roomy(self, share: f64) -> Self {
        self.widened(share * (self.north - self.south).max(self.east - self.west))
    }

    fn widened(self, by: f64) -> Self {
        Extent { south: self.south - by, west: self.west - by, north: self.north + by, east: self.east + by }
    }

    fn holds(&self, p: Point) -> bool {
        (self.south..=self.north).contains(&p.north) && (self.west..=self.east).contains(&p.east)
    }

    /// The point at some shares of both sides.
    fn at(&self, north: f64, east: f64) -> Point {
        Point::new(self.south + north * (self.north - self.south), self.west + east * (self.east - self.west))
    }
}

/// All that must be on the map, so far.
pub(super) fn extent(results: &Results, reach: Option<Extent>, is_simulated: bool) -> Extent {
    let sources = results.plan.scenario.environment.sources.iter().map(|source| source.at);
    let reports = results.reports.listed.iter().filter_map(|report| Some(Point::new(report.north_m?, report.east_m?)));
    let areas = results.area.iter().chain(results.regions.iter().flat_map(|(_, corners)| corners)).copied();
    let reported = results.areas.values().flatten().copied();
    let shown = Extent::of(areas.chain(sources).chain(reports).chain(reported).chain(results.start), reach);
    let slicks = results.slicks.iter().filter(|_| is_simulated);
    let outlines: Vec<_> =
        slicks.flat_map(|slick| [0.0, seconds(results.ticks)].map(|time| slick.corners(time))).collect();
    let room = room([shown.at(0.0, 0.0), shown.at(1.0, 1.0)].into_iter(), outlines.iter().map(Vec::as_slice));
    room.into_iter().filter_map(Extent::at_point).fold(shown, |shown, p| p.with(Some(shown)))
}

/// What is known of the world beside the plume.
pub(super) fn known(results: &Results, extent: Extent, is_simulated: bool, bottom: Option<BottomCells>) -> KnownWorld {
    let environment = &results.plan.scenario.environment;
    let name = results.plan.program.mission.areas.first().map_or("", |area| &area.name);
    let own = (!results.area.is_empty()).then(|| named(name, &results.area));
    let pair = |p: Point| (metres(p.north), metres(p.east));
    let sources = environment.sources.iter().map(|source| {
        let ends: Vec<Point> = std::iter::once(source.at).chain(source.to).collect();
        named(&source.name, &ends)
    });
    let mean = environment.flow.mean;
    KnownWorld {
        extent,
        globe: results.plan.frame().map(|frame| globe(frame, &extent)),
        areas: own.into_iter().chain(results.regions.iter().map(|(name, at)| named(name, at))).collect(),
        outlines: results.areas.iter().map(|(name, at)| named(name, at)).collect(),
        no_go: environment.no_go.iter().map(|zone| named(&zone.name, zone.area.corners())).collect(),
        sources: sources.collect(),
        true_outlines: results.slicks.iter().filter(|_| is_simulated).map(MovingOutline::new).collect(),
        deepest: results.deepest_sought().map(pair),
        start: results.start.map(pair),
        bottom,
        flow: (is_simulated && mean.length() > 0.0).then_some((mean.north, mean.east)),
        is_simulated,
    }
}

/// The bottom of a simulated world, where it is not level.
pub(super) fn bottom(results: &Results, extent: Extent, is_simulated: bool) -> Option<BottomCells> {
    let bottom = &results.plan.scenario.environment.bottom;
    (is_simulated && !bottom.is_level()).then(|| {
        let share = |i: usize| (i as f64 + 0.5) / BOTTOM_CELLS as f64;
        let cells = (0..BOTTOM_CELLS * BOTTOM_CELLS).map(|i| (i / BOTTOM_CELLS, i % BOTTOM_CELLS));
        let depth = |(n, e)| bottom.depth_at(extent.at(share(n), share(e)));
        let whole = |depth: f64| depth.is_finite().then(|| (depth * 10.0).round() as i64);
        BottomCells { cells: BOTTOM_CELLS, depths: packed(cells.map(depth).map(whole)) }
    })
}

fn globe(frame: TangentFrame, extent: &Extent) -> Vec<(f64, f64)> {
    let share = |i: usize| i as f64 / (GLOBE_POINTS - 1) as f64;
    let places = (0..GLOBE_POINTS * GLOBE_POINTS).map(|i| extent.at(share(i / GLOBE_POINTS), share(i % GLOBE_POINTS)));
    places.map(|p| frame.to_geodetic(p)).map(|globe| (globe.latitude_deg(), globe.longitude_deg())).collect()
}

fn named(name: &str, corners: &[Point]) -> Named {
    let at = corners.iter().flat_map(|p| [metres(p.north), metres(p.east)]).collect();
    Named { name: one_line(name), at }
}

/// Metres as a page needs them.
fn metres(x: f64) -> f64 {
    if x.is_finite() { (x * 10.0).round() / 10.0 } else { 0.0 }
}

/// The plume of a run, simulated once more from its seed. None where its scenario has no filaments.
pub(super) fn plume(plan: &Plan, seed: u64, ticks: u64, extent: Extent) -> Option<SimulatedPlume> {
    let (scenario, ticks) = (&plan.scenario, ticks.min(TICKS_MAX));
    if !scenario.has_filaments() || scenario.validate().is_err() {
        return None;
    }
    let lasts = seconds(ticks) as u64;
    let every_s = FRAME_S.max(lasts.div_ceil(FRAMES_MAX).div_ceil(10) * 10);
    let of_moment = FILAMENTS_MAX.min(FILAMENTS_IN_ALL / (lasts / every_s + 1) as usize);
    let beyond = BEYOND * (extent.north - extent.south).max(extent.east - extent.west);
    let shown = extent.widened(beyond);
    let mut world = World::new(scenario, seed);
    let (mut frames, mut at_end) = (Vec::new(), Vec::new());
    // Tick by tick, as the run itself went.
    for tick in 0..=ticks {
        if world.end_before(tick).is_some() {
            break;
        }
        world.advance_to(tick);
        let is_end = tick == ticks;
        if !(tick.is_multiple_of(every_s * 10) || is_end) {
            continue;
        }
        let there: Vec<(Point, f64)> = world.filaments(seconds(tick)).collect();
        if tick.is_multiple_of(every_s * 10) {
            frames.push(frame(&there, shown, of_moment));
        }
        if is_end {
            at_end = there;
        }
    }
    Some(SimulatedPlume { data: PlumeFrames { every_s, frames }, at_end })
}

/// A moment of the plume, thinned.
fn frame(there: &[(Point, f64)], shown: Extent, most: usize) -> [Vec<Option<i64>>; 3] {
    let inside: Vec<&(Point, f64)> = there.iter().filter(|(p, _)| shown.holds(*p)).collect();
    let step = inside.len().div_ceil(most.max(1)).max(1);
    // Counted from the youngest, which are last: those beside a source are few and seen first.
    let kept: Vec<&(Point, f64)> = inside.into_iter().rev().step_by(step).collect();
    let list = |of: fn(&(Point, f64)) -> f64| packed(kept.iter().map(|filament| Some(of(filament).round() as i64)));
    [list(|(p, _)| p.north), list(|(p, _)| p.east), list(|(_, radius)| radius * 10.0)]
}
