//! The water's depth: what a scenario says of it, and what of that cannot be.

use crate::scenario::{Scenario, ScenarioIssues, number};
use albacore_geometry::{Area, Heading, Point};
use serde::Deserialize;
use std::sync::Arc;

/// The bottom: its ground, with pits in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bottom {
    /// Its shape at large. Default a level plane.
    pub ground: Ground,
    /// Where it is deeper than that. Default none.
    pub pits: Vec<Pit>,
}

/// The shape of a bottom at large.
#[derive(Clone, Debug, PartialEq)]
pub enum Ground {
    /// A plane.
    Plane(Plane),
    /// What was surveyed.
    Grid(Arc<Grid>),
}

impl Default for Ground {
    fn default() -> Self {
        Ground::Plane(Plane::default())
    }
}

/// A plane bottom, level beyond either end of its slope.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// Water depth where the slope begins, m. Default 20.
    pub from: f64,
    /// Water depth where it ends, m. Default 20.
    pub to: f64,
    /// The direction in which depth goes `from` .. `to`. Default north.
    pub toward: Heading,
    /// The length of the slope, m, centred on the frame's origin. Default 1000.
    pub across: f64,
}

impl Default for Plane {
    fn default() -> Self {
        Plane { from: 20.0, to: 20.0, toward: Heading::NORTH, across: 1000.0 }
    }
}

/// Depths of the water on an even grid; beyond it each is that of the nearest edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The place of the first depth.
    pub south_west: Point,
    /// The place of the last.
    pub north_east: Point,
    /// So many rows run from south to north: two or more.
    pub rows: u32,
    /// So many depths make a row, from west to east: two or more.
    pub columns: u32,
    /// Depths of the water, m, row after row. Of land they are 0 or less.
    pub depths: Vec<f64>,
}

impl Grid {
    /// Where it lies; none if it has no extent.
    pub fn area(&self) -> Option<Area> {
        let (south_west, north_east) = (self.south_west, self.north_east);
        let south_east = Point { north: south_west.north, east: north_east.east };
        let north_west = Point { north: north_east.north, east: south_west.east };
        Area::polygon(&[south_west, south_east, north_east, north_west]).ok()
    }
}

/// A smooth round hollow in the bottom: a Gaussian.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pit {
    /// What it is called.
    pub name: String,
    /// Its middle. Default the frame's origin.
    pub at: Point,
    /// How much deeper than the ground it is in its middle, m. Default 1.
    pub depth: f64,
    /// The standard deviation of its Gaussian, m: there it is 61 % as deep as in its middle. Default 20.
    pub radius: f64,
}

impl Default for Pit {
    fn default() -> Self {
        Pit { name: String::from("pit"), at: Point::ORIGIN, depth: 1.0, radius: 20.0 }
    }
}

/// A place where the vehicle must not be: a wreck, a mooring, a shipping lane. The water does not know of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoGo {
    /// What it is called.
    pub name: String,
    /// Where it is.
    pub area: Area,
}

/// The deepest trench, m.
pub(crate) const DEEPEST_M: f64 = 11_000.0;
/// The depth of a hollow over its radius: beyond it a slope is steeper than 80 degrees.
const STEEPEST: f64 = 10.0;

/// What of the bottom cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    if let Ground::Grid(grid) = &scenario.environment.bottom.ground {
        check_grid(grid, objections);
    }
    for (i, pit) in scenario.environment.bottom.pits.iter().enumerate() {
        let mut of = objections.nth("pit", i);
        of.name(&pit.name, &scenario.environment.bottom.pits[..i].iter().map(|p| p.name.as_str()).collect::<Vec<_>>());
        of.unless(
            Some("radius"),
            pit.depth <= STEEPEST * pit.radius,
            format!("a pit {} m deep with a radius of {} m is a shaft", number(pit.depth), number(pit.radius)),
            format!("make `radius` {} m at least", number(pit.depth / STEEPEST)),
        );
        let deepest = scenario.environment.bottom.depth_at(pit.at);
        of.unless(
            Some("depth"),
            deepest <= DEEPEST_M,
            format!("here, with all pits, the water is {deepest:.0} m deep: no sea is"),
            format!("make them shallower: {DEEPEST_M} m at most"),
        );
    }
    for (i, zone) in scenario.environment.no_go.iter().enumerate() {
        let others: Vec<&str> = scenario.environment.no_go[..i].iter().map(|z| z.name.as_str()).collect();
        objections.nth("no_go", i).name(&zone.name, &others);
    }
}

fn check_grid(grid: &Grid, objections: &mut ScenarioIssues) {
    let (south_west, size) = (grid.south_west, grid.north_east - grid.south_west);
    let mut of = objections.of("bottom_grid");
    of.unless(
        None,
        south_west.north.is_finite() && south_west.east.is_finite(),
        "the grid lies nowhere: its south-western corner is not finite",
        "give it a place with `at:`",
    );
    of.unless(
        None,
        size.north > 0.0 && size.east > 0.0 && size.north.is_finite() && size.east.is_finite(),
        format!("the grid is {} m long northward and {} m eastward", number(size.north), number(size.east)),
        "it must have an extent: look at its axes and at `scale`",
    );
    let cells = u64::from(grid.rows) * u64::from(grid.columns);
    of.unless(
        None,
        grid.rows >= 2 && grid.columns >= 2 && cells == grid.depths.len() as u64,
        format!("the grid has {} depths in {} rows of {}", grid.depths.len(), grid.rows, grid.columns),
        "it must have two rows of two at least, and all of them",
    );
    of.unless(
        None,
        grid.depths.iter().all(|depth| depth.is_finite()),
        "the grid has a depth that is not a finite number",
        "look for it in the file",
    );
    let deepest = grid.depths.iter().copied().fold(0.0, f64::max);
    of.unless(
        None,
        deepest <= DEEPEST_M || !deepest.is_finite(),
        format!("this survey is {deepest:.0} m deep: no sea is"),
        format!("look at `depth_scale` and at the unit of the file: {DEEPEST_M} m are the most"),
    );
    of.unless(
        None,
        grid.depths.iter().any(|depth| *depth > 0.0 || !depth.is_finite()),
        "all of the grid is land: no number of the file is below the surface",
        "numbers are heights above the surface unless the file says that they are depths: write the word `depth` in the head \
         line of a CSV file, or give the variable of a NetCDF file `positive = \"down\"`",
    );
}
