//! Worlds for tests and benchmarks: as large as the one of the 2005 paper's trial, of no script.

use albacore_geometry::{Area, Heading, Point};
use albacore_sim::{
    Bottom, Environment, Flow, Ground, HullSetup, InstrumentSetup, KinematicHull, Lbl, Meander, Navigation, Plane,
    Plume, Scenario, Source, VehicleSetup,
};

/// Where the mean flow goes, degrees.
const FLOW_TOWARD_DEG: f64 = 140.0;

/// A plume that is the same at every height, in a current that meanders over a slope; a vehicle at a down-flow corner of the region.
pub fn flat() -> Scenario {
    let down_flow = Heading::from_degrees(FLOW_TOWARD_DEG);
    let across = down_flow + Heading::from_degrees(90.0).radians();
    let place = |x: f64, y: f64| Point::ORIGIN + x * down_flow.unit() + y * across.unit();
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, down_flow, 1094.0, 367.0)),
            flow: Flow { mean: 0.125 * down_flow.unit(), meander: Some(Meander::default()), ..Flow::default() },
            bottom: Bottom {
                ground: Ground::Plane(Plane { from: 4.0, to: 8.0, toward: Heading::from_degrees(50.0), across: 367.0 }),
                pits: Vec::new(),
            },
            plume: Some(Plume::default()),
            sources: vec![Source { name: String::from("dye"), at: place(-427.0, 0.0), ..Source::default() }],
            ..Environment::default()
        },
        vehicle: VehicleSetup { start: place(527.0, -163.5), ..VehicleSetup::default() },
        instruments: InstrumentSetup {
            navigation: Some(Navigation { lbl: Some(Lbl::default()), ..Navigation::default() }),
            ..InstrumentSetup::default()
        },
        ..Scenario::default()
    }
}

/// The same with a plume that rises slowly in a bottom layer, and a vehicle that wobbles about its altitude.
pub fn layered() -> Scenario {
    let flat = flat();
    Scenario {
        environment: Environment {
            plume: Some(Plume { vertical: 1e-3, layer: Some(3.5), ..Plume::default() }),
            ..flat.environment
        },
        vehicle: VehicleSetup {
            hull: HullSetup::Kinematic(KinematicHull { altitude_jitter: 0.3, ..KinematicHull::default() }),
            ..flat.vehicle
        },
        ..flat
    }
}
