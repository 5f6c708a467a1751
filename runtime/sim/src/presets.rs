//! Two worlds for tests and benchmarks: the June 2003 trial at Duck, with and without its vertical part.

use crate::craft::sensors::{InstrumentSetup, Lbl, Navigation};
use crate::craft::setup::{HullSetup, KinematicHull, VehicleSetup};
use crate::scenario::Scenario;
use crate::world::bottom::{Bottom, Ground, Plane};
use crate::world::plume::{Plume, Source};
use crate::world::water::{Flow, Meander};
use albacore_geometry::{Area, Heading, Point};

/// Where the mean flow of the trial goes, degrees.
const FLOW_TOWARD_DEG: f64 = 140.0;

/// The trial in two dimensions: 1094 m by 367 m along the flow, 12.5 cm/s, one source 120 m inside the up-flow edge, the
/// vehicle at a down-flow corner. Numbers beyond the 2005 paper's are those that reproduce its intermittency: with a threshold
/// of 4 % of full scale, a straight probe at 2 m/s reads above it two thirds of the time.
pub fn duck_2003_flat() -> Scenario {
    let down_flow = Heading::from_degrees(FLOW_TOWARD_DEG);
    let across = down_flow + Heading::from_degrees(90.0).radians();
    let place = |x: f64, y: f64| Point::ORIGIN + x * down_flow.unit() + y * across.unit();
    Scenario {
        region: Some(Area::rectangle(Point::ORIGIN, down_flow, 1094.0, 367.0)),
        flow: Flow { mean: 0.125 * down_flow.unit(), meander: Some(Meander::default()), ..Flow::default() },
        bottom: Bottom {
            ground: Ground::Plane(Plane { from: 4.0, to: 8.0, toward: Heading::from_degrees(50.0), across: 367.0 }),
            pits: Vec::new(),
        },
        plume: Some(Plume::default()),
        sources: vec![Source { name: String::from("dye"), at: place(-427.0, 0.0), ..Source::default() }],
        vehicle: VehicleSetup { start: place(527.0, -163.5), ..VehicleSetup::default() },
        instruments: InstrumentSetup {
            navigation: Some(Navigation { lbl: Some(Lbl::default()), ..Navigation::default() }),
            ..InstrumentSetup::default()
        },
        ..Scenario::default()
    }
}

/// The trial: the plume rises slowly in a bottom layer, and the vehicle wobbles about its altitude.
pub fn duck_2003() -> Scenario {
    let flat = duck_2003_flat();
    Scenario {
        plume: Some(Plume { vertical: 1e-3, layer: Some(3.5), ..Plume::default() }),
        vehicle: VehicleSetup {
            hull: HullSetup::Kinematic(KinematicHull { altitude_jitter: 0.3, ..KinematicHull::default() }),
            ..flat.vehicle
        },
        ..flat
    }
}
