//! The picture of a scenario: its world when a run begins.

use crate::boundary::drawn;
use crate::picture;
use albacore_geometry::Point;
use albacore_sim::{Ground, Scenario, Simulator, Slick};
use albacore_trace::{Depths, Picture};

/// A picture without region and survey shows so much water around the vehicle, m to each side.
const AROUND_M: f64 = 100.0;

/// The world at the start of a run with a seed, as SVG.
pub(super) fn svg(name: &str, scenario: &Scenario, simulator: &Simulator, seed: u64) -> String {
    let start = simulator.truth().position;
    let legs = scenario.own_mission.iter().flat_map(|own| own.route.legs(start, scenario.vehicle.heading));
    let route: Vec<Point> = legs.flat_map(|leg| [leg.start, leg.end]).collect();
    let surveyed = match &scenario.environment.bottom.ground {
        Ground::Grid(grid) => grid.area(),
        Ground::Plane(_) => None,
    };
    let known = scenario.environment.region.as_ref().map(|region| (region, "region"));
    let known = known.or(surveyed.as_ref().map(|area| (area, "survey")));
    let (area, area_name) = known.map_or_else(Default::default, |(area, name)| (area.corners().to_vec(), name));
    let true_outlines = drawn(&Slick::all(&scenario.environment.spills, seed), 0.0);
    let mut water = if area.is_empty() { near(start, &route, scenario) } else { area.clone() };
    water.extend(true_outlines.iter().flat_map(|named| &named.corners));
    Picture {
        title: format!("scenario {name}"),
        subtitle: vec![format!("as it is when a run with seed {seed} begins")],
        depths: Depths::sound(&water, |p| simulator.water_depth(p)),
        water,
        true_outlines,
        area,
        area_name: area_name.into(),
        route,
        plume: simulator.filaments().collect(),
        start: Some(start),
        ..picture::of_world(scenario, simulator.carrying_flow(start))
    }
    .svg()
}

/// Corners of the water about the vehicle, its way, and where it must not be.
fn near(start: Point, route: &[Point], scenario: &Scenario) -> Vec<Point> {
    let around = [-AROUND_M, AROUND_M].map(|away| Point::new(start.north + away, start.east + away));
    let no_go = scenario.environment.no_go.iter().flat_map(|zone| zone.area.corners());
    around.iter().chain(route).chain(no_go).copied().collect()
}
