//! What instruments tell.

use super::{driven, names, scenario};
use crate::world;
use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::{
    Adcp, Bottom, Environment, Flow, Lbl, Looks, Navigation, Pit, Scenario, Simulator, Sounder, UpperFlow, Waves,
};
use albacore_vehicle::{Command, Snapshot, Vehicle, Vertical};
use std::error::Error;

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
    layered.environment.flow.upper =
        Some(UpperFlow { mean: Vector::new(0.2, 0.0), above: 2.5, ..UpperFlow::default() });
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!((last[0] - 0.2).abs() < 0.02 && last[1].abs() < 0.02, "{last:?}");
    layered.environment.flow.upper =
        Some(UpperFlow { mean: Vector::new(0.2, 0.0), above: 3.5, ..UpperFlow::default() });
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!(last[0].abs() < 0.02 && (last[1] - 0.1).abs() < 0.02, "{last:?}");
}

/// The remedy: what is below the vehicle is in the same layer as the vehicle, as long as there is a bin above the bottom.
#[test]
fn a_downward_look_is_not_deceived_by_a_low_boundary() {
    let upper = UpperFlow { mean: Vector::new(0.2, 0.0), above: 2.5, ..UpperFlow::default() };
    let mut layered = scenario();
    layered.environment.flow.upper = Some(upper);
    layered.instruments.adcp.looks = Looks::Down;
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!(last[0].abs() < 0.02 && (last[1] - 0.1).abs() < 0.02, "{last:?}");
    layered.instruments.adcp.looks = Looks::Both;
    let last = *driven(&layered, 400, "flow").unwrap().last().unwrap();
    assert!((last[0] - 0.1).abs() < 0.02 && (last[1] - 0.05).abs() < 0.02, "of neither layer: {last:?}");
    // It begins at 2 m: nothing of the 2 m below can be measured, once the vehicle is down there.
    layered.instruments.adcp = Adcp { blanking: 2.0, looks: Looks::Down, ..Adcp::default() };
    layered.vehicle.depth = 8.0;
    assert_eq!(driven(&layered, 400, "flow").unwrap(), Vec::<[f64; 4]>::new());
}

/// What a late instrument tells is what a prompt one told so much earlier.
#[test]
fn late_instruments_tell_what_was() {
    let measurements = ["heading", "speed", "course", "depth", "altitude", "flow"];
    let prompt = scenario();
    let (late, delay) = (15, 1.5);
    let mut tardy = prompt.clone();
    tardy.instruments.compass.delay = delay;
    tardy.instruments.dvl.delay = delay;
    tardy.instruments.pressure.delay = delay;
    tardy.instruments.sounder.delay = delay;
    tardy.instruments.adcp.delay = delay;
    for measurement in measurements {
        let [before, after] = [&prompt, &tardy].map(|scenario| driven(scenario, 60, measurement).unwrap());
        // The last flow of a minute is told at 58 s.
        let fewer = if measurement == "flow" { 0 } else { late };
        assert!(
            before.len() > 15 && before.len() - fewer == after.len(),
            "{measurement}: {} {}",
            before.len(),
            after.len()
        );
        assert_eq!(before[..after.len()], after[..], "{measurement}");
    }
}

#[test]
fn a_profiler_looks_as_often_as_told_and_a_log_errs_ahead() {
    let mut scenario = scenario();
    (scenario.instruments.adcp.rate, scenario.instruments.adcp.looks) = (2.0, Looks::Both);
    let flows = driven(&scenario, 60, "flow").unwrap().len();
    assert!((100..=112).contains(&flows), "two a second, once ten are heard under way: {flows}");
    let speed = |bias| {
        let mut scenario = scenario.clone();
        scenario.instruments.dvl.bias = bias;
        driven(&scenario, 60, "speed").unwrap()[599][0]
    };
    assert!((speed(0.1) - speed(0.0) - 0.1).abs() < 1e-3);
}

#[test]
fn a_fix_makes_the_position_jump() {
    let lbl = Lbl { every: 60.0, ..Lbl::default() };
    let mut navigated = scenario();
    navigated.instruments.navigation = Some(Navigation { lbl: Some(lbl), ..Navigation::default() });
    let positions = driven(&navigated, 100, "position").unwrap();
    assert_eq!(positions[0][2], 0.0);
    assert!((positions[599][2] - 0.05 * 59.9_f64.sqrt()).abs() < 1e-9);
    assert_eq!(positions[600][2], 2.0);
    let perfect = driven(&scenario(), 100, "position").unwrap();
    assert!(perfect.iter().all(|p| p[2] == 0.0));
}

#[test]
fn a_fast_chemical_sensor_gives_several_samples_a_tick() {
    let mut fast = world::flat();
    fast.instruments.fluorometer.rate = 50.0;
    assert_eq!(driven(&fast, 10, "chemical").unwrap().len(), 496, "0 to 9.9 s");
}

#[test]
fn over_a_pit_the_water_is_deeper_and_echoes_are_as_noisy_as_told() {
    let pit = Pit { at: Point::new(60.0, 3.0), depth: 2.0, radius: 15.0, ..Pit::default() };
    let bottom = Bottom { pits: vec![pit], ..Bottom::flat(10.0) };
    let mut over = Scenario { environment: Environment { bottom, ..scenario().environment }, ..scenario() };
    let exact = driven(&over, 60, "water_depth").unwrap();
    let deepest = exact.iter().map(|sample| sample[0]).fold(0.0, f64::max);
    assert!((deepest - 12.0).abs() < 0.02 && (exact[0][0] - 10.0).abs() < 0.01, "{deepest}");

    over.instruments.sounder = Sounder { noise: 0.05, ..Sounder::default() };
    let errors: Vec<f64> = driven(&over, 60, "water_depth")
        .unwrap()
        .iter()
        .zip(&exact)
        .map(|(noisy, exact)| noisy[0] - exact[0])
        .collect();
    let deviation = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    assert!((deviation - 0.05).abs() < 0.005, "{deviation}");
}

/// Of a vehicle that is to hold 10 m under waves: how far at most its gauge and the truth are from that, m.
fn off_depth_in_waves(height: f64) -> Result<[f64; 2], Box<dyn Error>> {
    let waves = Waves { height, period: 12.0, toward: Heading::NORTH };
    let flow = Flow { waves: Some(waves), ..Flow::default() };
    let environment = Environment { flow, bottom: Bottom::flat(21.0), ..Environment::default() };
    let mut simulator = Simulator::new(&Scenario { environment, ..Scenario::default() }, 1)?;
    let mut snapshot = Snapshot::default();
    simulator.take_over()?;
    simulator.command(&Command::new(Heading::NORTH, 2.0, Vertical::Depth(10.0)))?;
    let mut off = [0.0_f64; 2];
    for tick in 0..6000 {
        simulator.sense(&mut snapshot)?;
        let told =
            snapshot.samples.iter().find(|s| simulator.measurements()[usize::from(s.measurement)].name == "depth");
        if tick > 600 {
            off[0] = off[0].max((told.ok_or("no depth")?.reading[0] - 10.0).abs());
            off[1] = off[1].max((simulator.truth().depth - 10.0).abs());
        }
    }
    Ok(off)
}

/// A vehicle holds its depth by its own gauge, which takes waves for depth: it follows what the gauge tells, and not the truth.
#[test]
fn under_waves_a_vehicle_follows_its_gauge() {
    let [gauge, truth] = off_depth_in_waves(1.0).unwrap();
    assert!(gauge < 0.1 && truth > 0.3, "{gauge} {truth}");
    assert_eq!(off_depth_in_waves(0.0).unwrap(), [0.0, 0.0]);
}
