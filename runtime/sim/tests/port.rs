//! The simulator as a machine sees it: through the port alone.

use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::hull::Crossflow;
use albacore_sim::{
    Adcp, Bottom, Fault, Flow, Fluorometer, Grid, Ground, HullSetup, KinematicHull, Lbl, Limits, Looks, Navigation,
    Pit, Plane, Scenario, Simulator, Sounder, Source, SubmersibleHull, Times, Trouble, UpperFlow, VehicleSetup,
    presets,
};
use albacore_vehicle::{Command, Control, Snapshot, Vehicle, Vertical};
use std::error::Error;
use std::sync::Arc;

fn scenario() -> Scenario {
    Scenario {
        flow: Flow { mean: Vector::new(0.0, 0.1), ..Flow::default() },
        bottom: Bottom::flat(10.0),
        ..Scenario::default()
    }
}

/// The readings of a channel in some seconds of driving at 2 m/s and 2 m above the bottom.
fn driven(scenario: &Scenario, seconds: u32, channel: &str) -> Result<Vec<[f64; 4]>, Box<dyn Error>> {
    let mut simulator = Simulator::new(scenario, 1)?;
    let mut snapshot = Snapshot::default();
    let mut readings = Vec::new();
    simulator.take_over()?;
    simulator.command(&Command { heading: Heading::NORTH, speed: 2.0, vertical: Vertical::Altitude(2.0) })?;
    for _ in 0..seconds * 10 {
        simulator.sense(&mut snapshot)?;
        let wanted = snapshot.samples.iter().filter(|s| simulator.channels()[usize::from(s.channel)].name == channel);
        readings.extend(wanted.map(|s| s.reading));
    }
    Ok(readings)
}

fn names(simulator: &Simulator, snapshot: &Snapshot) -> Vec<String> {
    snapshot.samples.iter().map(|s| simulator.channels()[usize::from(s.channel)].name.clone()).collect()
}

#[test]
fn drifts_until_taken_over_and_after_release() {
    let mut simulator = Simulator::new(&scenario(), 1).unwrap();
    let mut snapshot = Snapshot::default();
    let command = Command { heading: Heading::NORTH, speed: 2.0, vertical: Vertical::Altitude(2.0) };

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

#[test]
fn each_channel_at_its_own_rate() {
    let mut simulator = Simulator::new(&scenario(), 1).unwrap();
    let mut snapshot = Snapshot::default();
    let mut counts = std::collections::BTreeMap::<String, usize>::new();
    for _ in 0..=600 {
        simulator.sense(&mut snapshot).unwrap();
        for name in names(&simulator, &snapshot) {
            *counts.entry(name).or_default() += 1;
        }
    }
    for name in ["position", "course", "heading", "speed", "depth", "altitude", "water_depth", "chemical"] {
        assert_eq!(counts[name], 601, "{name}");
    }
    assert_eq!(counts["battery"], 7);
}

#[test]
fn impossible_scenarios_are_refused_with_every_reason() {
    let mut bad = scenario();
    bad.vehicle.hull = HullSetup::Kinematic(KinematicHull { turn_rate: 0.0, ..KinematicHull::default() });
    bad.vehicle.depth = 11.0;
    bad.fluorometer.noise = f64::NAN;
    let error = Simulator::new(&bad, 1).unwrap_err();
    assert_eq!(error.faults.len(), 3, "{error}");
    assert!(error.to_string().contains("`turn_rate` of `kinematic` is 0: it must be 0.0017"), "{error}");
}

#[test]
fn the_flow_is_estimated_once_the_vehicle_moves() {
    let flows = driven(&scenario(), 400, "flow").unwrap();
    // Messages every 2 s; valid from 0.4 m/s over ground on, reached within 2 s; ten are needed.
    assert!((188..=191).contains(&flows.len()), "{}", flows.len());
    let last = flows.last().unwrap();
    assert!(last[0].abs() < 0.02 && (last[1] - 0.1).abs() < 0.02, "the mean of 100 with 0.05 m/s each: {last:?}");
}

/// The 2005 paper's own trouble: near the boundary of two currents the upward profiler reads the upper one.
#[test]
fn a_low_boundary_deceives_the_profiler() {
    let mut layered = scenario();
    layered.flow.upper = Some(UpperFlow { mean: Vector::new(0.2, 0.0), above: 2.5, ..UpperFlow::default() });
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!((last[0] - 0.2).abs() < 0.02 && last[1].abs() < 0.02, "{last:?}");
    layered.flow.upper = Some(UpperFlow { mean: Vector::new(0.2, 0.0), above: 3.5, ..UpperFlow::default() });
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!(last[0].abs() < 0.02 && (last[1] - 0.1).abs() < 0.02, "{last:?}");
}

/// The remedy: what is below the vehicle is in the same layer as the vehicle, as long as there is a bin above the bottom.
#[test]
fn a_downward_look_is_not_deceived_by_a_low_boundary() {
    let upper = UpperFlow { mean: Vector::new(0.2, 0.0), above: 2.5, ..UpperFlow::default() };
    let mut layered = scenario();
    layered.flow.upper = Some(upper);
    layered.adcp.looks = Looks::Down;
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!(last[0].abs() < 0.02 && (last[1] - 0.1).abs() < 0.02, "{last:?}");
    layered.adcp.looks = Looks::Both;
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!((last[0] - 0.1).abs() < 0.02 && (last[1] - 0.05).abs() < 0.02, "of neither layer: {last:?}");
    // It begins at 2 m: nothing of the 2 m below can be measured, once the vehicle is down there.
    layered.adcp = Adcp { blanking: 2.0, looks: Looks::Down, ..Adcp::default() };
    layered.vehicle.depth = 8.0;
    assert_eq!(driven(&layered, 400, "flow").unwrap(), Vec::<[f64; 4]>::new());
}

#[test]
fn an_impossible_profiler_is_refused() {
    let adcp = Adcp { bias: f64::NAN, blanking: -1.0, bin: 0.0, count: 0, ..Adcp::default() };
    let error = Simulator::new(&Scenario { adcp, ..scenario() }, 1).unwrap_err();
    assert_eq!(error.faults.len(), 4, "{error}");
    assert!(error.to_string().contains("`bin` of `adcp` is 0: it must be 0.1 to 100"), "{error}");
}

/// What a late instrument tells is what a prompt one told so much earlier.
#[test]
fn late_instruments_tell_what_was() {
    let channels = ["heading", "speed", "course", "depth", "altitude", "flow"];
    let prompt = scenario();
    let (late, delay) = (15, 1.5);
    let mut tardy = prompt.clone();
    tardy.compass.delay = delay;
    tardy.dvl.delay = delay;
    tardy.pressure.delay = delay;
    tardy.sounder.delay = delay;
    tardy.adcp.delay = delay;
    for channel in channels {
        let [before, after] = [&prompt, &tardy].map(|scenario| driven(scenario, 60, channel).unwrap());
        // The last flow of a minute is told at 58 s.
        let fewer = if channel == "flow" { 0 } else { late };
        assert!(
            before.len() > 15 && before.len() - fewer == after.len(),
            "{channel}: {} {}",
            before.len(),
            after.len()
        );
        assert_eq!(before[..after.len()], after[..], "{channel}");
    }
}

/// It lets go of a weight: a hull that is as heavy as the water would stay where it is.
#[test]
fn whatever_moves_it_a_vehicle_that_leaks_floats_up_and_refuses_who_asks() {
    let leak = |from| Fault { trouble: Trouble::Leak, from, to: None };
    for hull in [
        HullSetup::Kinematic(KinematicHull::default()),
        HullSetup::Fossen(SubmersibleHull::fossen()),
        HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected),
    ] {
        let vehicle = VehicleSetup { hull, depth: 6.0, ..VehicleSetup::default() };
        let world = Scenario { bottom: Bottom::flat(30.0), vehicle, ..Scenario::default() };
        let mut snapshot = Snapshot::default();
        let mut simulator = Simulator::new(&Scenario { faults: vec![leak(10.0)], ..world.clone() }, 1).unwrap();
        simulator.sense(&mut snapshot).unwrap();
        simulator.take_over().unwrap();
        simulator.command(&Command { heading: Heading::NORTH, speed: 1.5, vertical: Vertical::Depth(6.0) }).unwrap();
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
fn a_profiler_looks_as_often_as_told_and_a_log_errs_ahead() {
    let scenario = Scenario { adcp: Adcp { rate: 2.0, looks: Looks::Both, ..Adcp::default() }, ..scenario() };
    let flows = driven(&scenario, 60, "flow").unwrap().len();
    assert!((100..=112).contains(&flows), "two a second, once ten are heard under way: {flows}");
    let speed = |bias| {
        let mut scenario = scenario.clone();
        scenario.dvl.bias = bias;
        driven(&scenario, 60, "speed").unwrap()[599][0]
    };
    assert!((speed(0.1) - speed(0.0) - 0.1).abs() < 1e-3);
}

#[test]
fn a_fix_makes_the_position_jump() {
    let lbl = Lbl { every: 60.0, ..Lbl::default() };
    let navigated = Scenario { navigation: Some(Navigation { walk: 0.05, lbl: Some(lbl) }), ..scenario() };
    let positions = driven(&navigated, 100, "position").unwrap();
    assert_eq!(positions[0][2], 0.0);
    assert!((positions[599][2] - 0.05 * 59.9_f64.sqrt()).abs() < 1e-9);
    assert_eq!(positions[600][2], 2.0);
    let perfect = driven(&scenario(), 100, "position").unwrap();
    assert!(perfect.iter().all(|p| p[2] == 0.0));
}

#[test]
fn a_fast_chemical_sensor_gives_several_samples_a_tick() {
    let fast =
        Scenario { fluorometer: Fluorometer { rate: 50.0, ..Fluorometer::default() }, ..presets::duck_2003_flat() };
    assert_eq!(driven(&fast, 10, "chemical").unwrap().len(), 496, "0 to 9.9 s");
}

#[test]
fn impossible_plumes_are_refused() {
    let fault = |change: &dyn Fn(&mut Scenario)| {
        let mut scenario = presets::duck_2003();
        change(&mut scenario);
        scenario.validate().unwrap_err().to_string()
    };
    for (fault, expected) in [
        (fault(&|s| s.flow.mean = Vector::ZERO), "needs a `flow` that carries it"),
        (fault(&|s| s.region = None), "`plume` needs a `region`"),
        (fault(&|s| s.plume = None), "a `source` needs a `plume`"),
        (fault(&|s| s.sources[0].at = Point::new(5000.0, 0.0)), "outside the `region`"),
        (fault(&|s| s.sources[0].height = 4.0), "and the `layer` of the plume 3.5 m high"),
        (fault(&|s| s.sources[0].rate = 1000.0), "filaments are alive at a time"),
        (fault(&|s| s.plume.as_mut().unwrap().layer = None), "`vertical` of `plume` needs a `layer`"),
        (fault(&|s| s.plume.as_mut().unwrap().step = 0.25), "`step` of `plume` is 0.25 s"),
        (
            fault(&|s| s.flow.meander.as_mut().unwrap().viscosity = 1.0),
            "too little for cells of 20 m in a flow of up to",
        ),
        (fault(&|s| s.flow.meander.as_mut().unwrap().cell = 1.0), "make more than 40000 nodes"),
        (fault(&|s| s.flow.meander.as_mut().unwrap().damping = 1.0), "`damping` of `flow` is 1"),
    ] {
        assert!(fault.contains(expected), "{fault}");
    }
    assert_eq!(presets::duck_2003().validate(), Ok(()));
    assert_eq!(presets::duck_2003_flat().validate(), Ok(()));
}

/// The clauses and parameters that a scenario's objections name.
fn objected(scenario: &Scenario) -> Vec<(&'static str, usize, Option<&'static str>)> {
    let faults = scenario.validate().err().map_or_else(Vec::new, |error| error.faults);
    faults.iter().map(|fault| (fault.clause, fault.nth, fault.param)).collect()
}

#[test]
fn chemical_where_there_is_no_water_is_refused() {
    let changed = |change: &dyn Fn(&mut Scenario)| {
        let mut scenario = presets::duck_2003();
        change(&mut scenario);
        objected(&scenario)
    };
    let layer = |s: &mut Scenario, high| s.plume.as_mut().unwrap().layer = Some(high);
    assert_eq!(changed(&|s| layer(s, 1e9)), [("plume", 0, Some("layer"))]);
    assert_eq!(changed(&|s| s.sources[0].height = 500.0), [("source", 0, Some("height"))]);
    let twin = |s: &mut Scenario| s.sources.extend([Source { to: Some(s.sources[0].at), ..s.sources[0].clone() }]);
    assert_eq!(changed(&twin), [("leak", 0, Some("name"))]);
    // What has always released may have ceased before the run; what begins later may not.
    assert_eq!(changed(&|s| s.sources[0].when.ends = -1000.0), []);
    let backward = |s: &mut Scenario| s.sources[0].when = Times { begins: 10.0, ends: 5.0, ..Times::default() };
    assert_eq!(changed(&backward), [("source", 0, Some("ends"))]);
    let ashore = Scenario { limits: Some(Limits { altitude: 100.0, ..Limits::default() }), ..scenario() };
    assert_eq!(objected(&ashore), [("limits", 0, Some("altitude"))]);
    let mut stepped = presets::duck_2003();
    stepped.plume.as_mut().unwrap().step = 1000.0;
    assert_eq!(objected(&stepped), [("plume", 0, Some("step"))], "and nothing of a step that no script can say");
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
fn over_a_pit_the_water_is_deeper_and_echoes_are_as_noisy_as_told() {
    let pit = Pit { at: Point::new(60.0, 3.0), depth: 2.0, radius: 15.0, ..Pit::default() };
    let bottom = Bottom { pits: vec![pit], ..Bottom::flat(10.0) };
    let mut over = Scenario { bottom, ..scenario() };
    let exact = driven(&over, 60, "water_depth").unwrap();
    let deepest = exact.iter().map(|sample| sample[0]).fold(0.0, f64::max);
    assert!((deepest - 12.0).abs() < 0.02 && (exact[0][0] - 10.0).abs() < 0.01, "{deepest}");

    over.sounder = Sounder { noise: 0.05, ..Sounder::default() };
    let errors: Vec<f64> = driven(&over, 60, "water_depth")
        .unwrap()
        .iter()
        .zip(&exact)
        .map(|(noisy, exact)| noisy[0] - exact[0])
        .collect();
    let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    assert!((deviation - 0.05).abs() < 0.005, "{deviation}");
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
        simulator.command(&Command { heading: Heading::NORTH, speed, vertical }).unwrap();
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
        let rising = Scenario { bottom: bottom.clone(), limits: Some(limits.clone()), vehicle, ..scenario() };
        let mut simulator = Simulator::new(&rising, 1).unwrap();
        let mut snapshot = Snapshot::default();
        simulator.take_over().unwrap();
        simulator.command(&Command { heading: Heading::NORTH, speed: 2.0, vertical: Vertical::Depth(8.0) }).unwrap();
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

#[test]
fn impossible_hulls_and_limits_are_refused() {
    let mut bad = scenario();
    let hull = SubmersibleHull { speed_max: 2.6, fin_max: 2.0, step: 0.03, ..SubmersibleHull::fossen() };
    bad.vehicle.hull = HullSetup::Fossen(hull);
    bad.limits = Some(Limits { depth: Some(-1.0), altitude: f64::NAN, speed: None });
    let said = bad.validate().unwrap_err();
    assert_eq!(said.faults.len(), 5, "{said}");
    for expected in [
        "its `turns_max` of 25.42 Hz gives 2.55 m/s at most",
        "`step` of `fossen` is 30 ms",
        "`depth` of `limits` is -1",
    ] {
        assert!(said.to_string().contains(expected), "{said}");
    }
    for hull in [
        HullSetup::Fossen(SubmersibleHull::fossen()),
        HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::AsPrinted),
    ] {
        bad.vehicle.hull = hull;
        bad.limits = None;
        assert_eq!(bad.validate(), Ok(()));
    }
}

#[test]
fn hulls_and_instruments_have_bounds() {
    let fossen =
        |turns_max, speed_max| HullSetup::Fossen(SubmersibleHull { turns_max, speed_max, ..SubmersibleHull::fossen() });
    let kinematic = KinematicHull { speed_max: 1e6, acceleration: 1e11, ..KinematicHull::default() };
    let lbl = Lbl { drift: Vector::new(10.0, 0.0), sigma: 1e9, gate: 1e9, every: 1e9, ..Lbl::default() };
    let sensors = Scenario {
        navigation: Some(Navigation { walk: 1e6, lbl: Some(lbl) }),
        fluorometer: Fluorometer { noise: 1e6, ahead: 1e9, ..Fluorometer::default() },
        limits: Some(Limits { altitude: 1e9, ..Limits::default() }),
        ..scenario()
    };
    let with = |hull| Scenario { vehicle: VehicleSetup { hull, ..VehicleSetup::default() }, ..scenario() };
    for (bad, faults) in [
        (with(fossen(3000.0, 80.0)), 2),
        (with(fossen(300.0, 16.0)), 2),
        (with(fossen(f64::NAN, f64::NAN)), 2),
        (with(HullSetup::Kinematic(kinematic)), 2),
        (sensors, 8),
    ] {
        let said = bad.validate().unwrap_err();
        assert_eq!(said.faults.len(), faults, "{said}");
        assert!(said.faults.iter().all(|fault| fault.to_string().contains("it must be")), "{said}");
    }
}

#[test]
fn impossible_pits_and_starts_are_refused() {
    let mut bad = scenario();
    bad.bottom.pits = vec![Pit { depth: -1.0, radius: 0.0, ..Pit::default() }];
    bad.bottom.ground = Ground::Plane(Plane { from: 10.0, to: 4.0, ..Plane::default() });
    bad.vehicle.depth = 5.0;
    assert!(!bad.validate().unwrap_err().to_string().contains("below the bottom"), "it starts where the water is 7 m");
    bad.vehicle.start_spread = 50.0;
    bad.sounder.noise = f64::NAN;
    let said = bad.validate().unwrap_err();
    assert_eq!(said.faults.len(), 4, "{said}");
    assert!(said.to_string().contains("`depth` of `pit` is -1") && said.to_string().contains("below the bottom"));
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
    let scenario = Scenario { bottom, flow: still, ..Scenario::default() };
    let mut simulator = Simulator::new(&scenario, 1).unwrap();
    let mut snapshot = Snapshot::default();
    simulator.take_over().unwrap();
    let mut told = Vec::new();
    for (heading, vertical) in [(0.0, Vertical::Depth(2.0)), (180.0, Vertical::Depth(0.5))] {
        let command = Command { heading: Heading::from_degrees(heading), speed: 2.0, vertical };
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

#[test]
fn grids_that_cannot_be_and_starts_on_land_are_refused() {
    let on = |grid: Grid| Bottom { ground: Ground::Grid(Arc::new(grid)), pits: Vec::new() };
    let said = |bad: &Scenario| bad.validate().unwrap_err().to_string();
    let mut bad = Scenario { bottom: on(shoal()), ..Scenario::default() };
    assert_eq!(bad.validate(), Ok(()));
    bad.vehicle.start = Point::new(60.0, 0.0);
    assert!(said(&bad).contains("on land"), "{}", said(&bad));
    bad.vehicle.start = Point::ORIGIN;
    bad.vehicle.start_spread = 10.0;
    assert!(said(&bad).contains("on land"), "a cell of land has a part in the depths about it: {}", said(&bad));
    bad.vehicle.start_spread = 0.0;
    bad.vehicle.depth = 6.0;
    assert!(said(&bad).contains("below the bottom"));
    for wrong in [
        Grid { depths: vec![20.0; 3], ..shoal() },
        Grid { rows: 1, columns: 4, ..shoal() },
        Grid { depths: vec![20.0, f64::NAN, 1.0, 1.0], ..shoal() },
        Grid { north_east: Point::new(-100.0, 100.0), ..shoal() },
    ] {
        let bad = Scenario { bottom: on(wrong), ..Scenario::default() };
        assert!(bad.validate().unwrap_err().faults.iter().any(|f| f.clause == "bottom_grid"), "{}", said(&bad));
    }
}
