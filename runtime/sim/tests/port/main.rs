//! The simulator as a machine sees it: through the port alone.

mod instruments;
mod recorded;
mod refused;
#[path = "../world/mod.rs"]
mod world;

use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::hull::Crossflow;
use albacore_sim::{
    Bottom, Environment, Fault, FaultKind, Flow, Grid, Ground, HullSetup, KinematicHull, Plane, Scenario, Simulator,
    SubmersibleHull, VehicleSetup,
};
use albacore_vehicle::{Command, Control, Limits, Snapshot, Vehicle, Vertical};
use std::error::Error;
use std::sync::Arc;

fn scenario() -> Scenario {
    Scenario {
        environment: Environment {
            flow: Flow { mean: Vector::new(0.0, 0.1), ..Flow::default() },
            bottom: Bottom::flat(10.0),
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// The readings of a measurement in some seconds of driving at 2 m/s and 2 m above the bottom.
fn driven(scenario: &Scenario, seconds: u32, measurement: &str) -> Result<Vec<[f64; 4]>, Box<dyn Error>> {
    let mut simulator = Simulator::new(scenario, 1)?;
    let mut snapshot = Snapshot::default();
    let mut readings = Vec::new();
    simulator.take_over()?;
    simulator.command(&Command::new(Heading::NORTH, 2.0, Vertical::Altitude(2.0)))?;
    for _ in 0..seconds * 10 {
        simulator.sense(&mut snapshot)?;
        let wanted = snapshot
            .samples
            .iter()
            .filter(|s| simulator.measurements()[usize::from(s.measurement)].name == measurement);
        readings.extend(wanted.map(|s| s.reading));
    }
    Ok(readings)
}

fn names(simulator: &Simulator, snapshot: &Snapshot) -> Vec<String> {
    snapshot.samples.iter().map(|s| simulator.measurements()[usize::from(s.measurement)].name.clone()).collect()
}

#[test]
fn drifts_until_taken_over_and_after_release() {
    let mut simulator = Simulator::new(&scenario(), 1).unwrap();
    let mut snapshot = Snapshot::default();
    let command = Command::new(Heading::NORTH, 2.0, Vertical::Altitude(2.0));

    simulator.sense(&mut snapshot).unwrap();
    assert_eq!((simulator.time_s(), snapshot.control), (0.0, Control::Monitoring));
    assert!(simulator.command(&command).is_err());
    (0..100).for_each(|_| simulator.sense(&mut snapshot).unwrap());
    assert!(simulator.truth().position.distance(Point::new(0.0, 1.0)) < 1e-9);

    simulator.take_over().unwrap();
    simulator.command(&command).unwrap();
    (0..1000).for_each(|_| simulator.sense(&mut snapshot).unwrap());
    assert_eq!(snapshot.control, Control::InControl);
    let truth = simulator.truth();
    assert!(truth.position.distance(Point::new(192.0, 11.0)) < 1e-6, "8 s to reach 2 m/s, then 92 s at it: {truth:?}");
    assert!((truth.speed_over_ground - (4.0_f64 + 0.01).sqrt()).abs() < 1e-9);
    assert!((truth.altitude - 2.0).abs() < 1e-9);

    simulator.release().unwrap();
    (0..1000).for_each(|_| simulator.sense(&mut snapshot).unwrap());
    assert_eq!(snapshot.control, Control::Released);
    assert!((simulator.truth().position.north - 200.0).abs() < 1e-6, "stops within 8 m");
}

/// It lets go of a weight: a hull that is as heavy as the water would stay where it is.
#[test]
fn whatever_moves_it_a_vehicle_that_leaks_floats_up_and_refuses_who_asks() {
    let leak = |from| Fault { trouble: FaultKind::Leak, from, to: None };
    for hull in [
        HullSetup::Kinematic(KinematicHull::default()),
        HullSetup::Fossen(SubmersibleHull::fossen()),
        HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected),
    ] {
        let vehicle = VehicleSetup { hull, depth: 6.0, ..VehicleSetup::default() };
        let world = Scenario {
            environment: Environment { bottom: Bottom::flat(30.0), ..Environment::default() },
            vehicle,
            ..Scenario::default()
        };
        let mut snapshot = Snapshot::default();
        let mut simulator = Simulator::new(&Scenario { faults: vec![leak(10.0)], ..world.clone() }, 1).unwrap();
        simulator.sense(&mut snapshot).unwrap();
        simulator.take_over().unwrap();
        simulator.command(&Command::new(Heading::NORTH, 1.5, Vertical::Depth(6.0))).unwrap();
        (0..3000).for_each(|_| simulator.sense(&mut snapshot).unwrap());
        assert_eq!(snapshot.control, Control::Released);
        assert!(simulator.truth().depth < 0.5, "{} m deep", simulator.truth().depth);

        for from in [0.0, 0.1] {
            let leaking = Scenario { faults: vec![leak(from)], ..world.clone() };
            let mut simulator = Simulator::new(&leaking, 1).unwrap();
            simulator.sense(&mut snapshot).unwrap();
            simulator.take_over().unwrap();
            for _ in 0..3 {
                simulator.sense(&mut snapshot).unwrap();
                assert_eq!(snapshot.control, Control::Refused, "who asks is not kept waiting: from {from} s");
            }
        }
    }
}

#[test]
fn a_vehicle_whose_battery_is_empty_floats_up() {
    let mut short = scenario();
    short.vehicle.endurance = 10.0;
    short.vehicle.depth = 3.0;
    let mut simulator = Simulator::new(&short, 1).unwrap();
    let mut snapshot = Snapshot::default();
    simulator.take_over().unwrap();
    let mut released = Vec::new();
    for tick in 0..300 {
        simulator.sense(&mut snapshot).unwrap();
        released.extend((snapshot.control == Control::Released).then_some(tick));
    }
    assert_eq!(released.first(), Some(&100));
    assert_eq!(simulator.notices(), ["the battery is empty: the vehicle floats up"]);
    assert_eq!(simulator.truth().depth, 0.0);
    simulator.take_over().unwrap();
    simulator.sense(&mut snapshot).unwrap();
    assert_eq!(snapshot.control, Control::Refused);
}

#[test]
fn its_own_limits_hold_whatever_it_is_told_and_the_refusals_are_told_once() {
    let limits = Limits { depth: Some(6.0), altitude: 3.0, speed: Some(1.2) };
    let limited = Scenario { limits: Some(limits), ..scenario() };
    let mut simulator = Simulator::new(&limited, 1).unwrap();
    let mut snapshot = Snapshot::default();
    simulator.take_over().unwrap();
    let mut told = Vec::new();
    for (speed, vertical) in [(2.0, Vertical::Depth(9.0)), (1.0, Vertical::Altitude(1.0))] {
        simulator.command(&Command::new(Heading::NORTH, speed, vertical)).unwrap();
        for _ in 0..600 {
            simulator.sense(&mut snapshot).unwrap();
            let truth = simulator.truth();
            assert!(truth.depth <= 6.0 + 1e-9 && truth.altitude >= 3.0 && truth.speed_over_ground < 1.21, "{truth:?}");
            told.extend(simulator.notices());
        }
    }
    // Altitude 1 m is both too deep and too low, but too deep it was asked to go all along.
    assert_eq!(
        told,
        ["is asked to go deeper than 6.00 m: it stays there", "is asked to go faster than 1.20 m/s: it goes no faster",]
    );
    assert!((simulator.truth().depth - 6.0).abs() < 1e-6);
}

#[test]
fn the_least_altitude_lifts_it_over_a_rise() {
    let plane = Plane { from: 12.0, to: 4.0, toward: Heading::NORTH, across: 200.0 };
    let bottom = Bottom { ground: Ground::Plane(plane), ..Bottom::default() };
    let limits = Limits { altitude: 2.0, ..Limits::default() };
    for hull in [
        HullSetup::default(),
        HullSetup::Fossen(SubmersibleHull::fossen()),
        HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected),
    ] {
        let vehicle = VehicleSetup { hull, start: Point::new(-250.0, 0.0), ..VehicleSetup::default() };
        let rising = Scenario {
            environment: Environment { bottom: bottom.clone(), ..scenario().environment },
            limits: Some(limits.clone()),
            vehicle,
            ..scenario()
        };
        let mut simulator = Simulator::new(&rising, 1).unwrap();
        let mut snapshot = Snapshot::default();
        simulator.take_over().unwrap();
        simulator.command(&Command::new(Heading::NORTH, 2.0, Vertical::Depth(8.0))).unwrap();
        let mut lowest = f64::INFINITY;
        for _ in 0..2500 {
            simulator.sense(&mut snapshot).unwrap();
            lowest = lowest.min(simulator.truth().altitude);
        }
        // A hull with forces may come a little nearer as the rise begins.
        assert!(lowest > 1.7, "{:?}: {lowest}", rising.vehicle.hull);
        assert!((simulator.truth().altitude - 2.0).abs() < 0.05);
        let told = simulator.notices();
        assert!(told.len() == 1 && told[0].contains("nearer to the bottom than 2.00 m"), "{told:?}");
    }
}

/// Four cells of a bottom that rises northward out of the water.
fn shoal() -> Grid {
    let corners = (Point::new(-100.0, -100.0), Point::new(100.0, 100.0));
    Grid { south_west: corners.0, north_east: corners.1, rows: 2, columns: 2, depths: vec![20.0, 20.0, -10.0, -10.0] }
}

#[test]
fn over_a_surveyed_shoal_it_grounds_and_says_so_once() {
    let bottom = Bottom { ground: Ground::Grid(Arc::new(shoal())), pits: Vec::new() };
    let still = Flow::default();
    let scenario =
        Scenario { environment: Environment { bottom, flow: still, ..Environment::default() }, ..Scenario::default() };
    let mut simulator = Simulator::new(&scenario, 1).unwrap();
    let mut snapshot = Snapshot::default();
    simulator.take_over().unwrap();
    let mut told = Vec::new();
    for (heading, vertical) in [(0.0, Vertical::Depth(2.0)), (180.0, Vertical::Depth(0.5))] {
        let command = Command::new(Heading::from_degrees(heading), 2.0, vertical);
        simulator.command(&command).unwrap();
        for _ in 0..600 {
            simulator.sense(&mut snapshot).unwrap();
            let time = simulator.time_s();
            told.extend(simulator.notices().into_iter().map(|notice| (time, notice)));
        }
    }
    // 5 m of water at the origin, 15 cm less each metre northward: 2 m of it 20 m away, which 2 m/s come to in 14 s.
    let times: Vec<f64> = told.iter().map(|(time, _)| *time).collect();
    assert!(matches!(times.as_slice(), [13.5..14.5, 60.0..60.2]), "{told:?}");
    assert_eq!(told[0].1, "grounded at 20.0 m north, 0.0 m east, in 2.0 m of water");
    assert_eq!(told[1].1, "came free of the bottom at 20.0 m north, 0.0 m east, in 2.0 m of water");
    assert!(simulator.truth().position.north < -70.0);
}
