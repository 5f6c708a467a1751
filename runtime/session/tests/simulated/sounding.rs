//! What an echo sounder can tell, from a script to where the vehicle goes: one that hears itself leads nowhere, and one that scatters
//! is believed.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Outcome, Plan, Run, Source, load_text};
use albacore_sim::Simulator;
use albacore_vehicle::measurements::{ALTITUDE, WATER_DEPTH};
use albacore_vehicle::{Command, Measurement, Snapshot, Vehicle, VehicleError};
use std::sync::{Arc, Mutex};

/// What is asked of the vertical, over which bottom, with which sounder, and what a mission forbids.
fn plan(limits: &str, asked: &str, world: &str) -> Plan {
    of(&format!(
        "mission dive in bay within 10 min {{
            area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 4000 m, width: 4000 m)
            limits {{ {limits}, speed <= 2.5 m/s }}
            requires {{ position, course, heading fresh 5 s, else abort }}
            recovery within 2 min {{ goto op.center }}
            with {asked}, speed 1.5 m/s
            steer 0 deg for 8 min
        }}
        scenario bay {{
            vehicle(kinematic, start: point(north: -100 m, east: -40 m), depth: 3 m)
            {world}
        }}"
    ))
}

fn of(text: &str) -> Plan {
    let script = load_text(Source { name: "dive.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:#?}", script.findings);
    Plan::new(&script, "dive.alb", None, None).unwrap()
}

/// What the sounder tells in a tick, of the true altitude.
type Tells = Box<dyn FnMut(u64, f64) -> f64 + Send>;

/// A vehicle whose sounder tells what it likes, and how deep it has been.
struct Liar {
    vehicle: Simulator,
    tells: Tells,
    tick: u64,
    deepest: Arc<Mutex<f64>>,
}

impl Vehicle for Liar {
    fn measurements(&self) -> &[Measurement] {
        self.vehicle.measurements()
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        self.vehicle.sense(snapshot)?;
        self.tick += 1;
        let depth = self.vehicle.truth().depth;
        let mut deepest = self.deepest.lock().unwrap();
        *deepest = deepest.max(depth);
        snapshot.samples.retain(|sample| sample.measurement != WATER_DEPTH);
        for sample in snapshot.samples.iter_mut().filter(|sample| sample.measurement == ALTITUDE) {
            sample.reading[0] = (self.tells)(self.tick, sample.reading[0]);
        }
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.vehicle.take_over()
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.vehicle.command(command)
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.vehicle.give_back()
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        self.vehicle.release()
    }

    fn notices(&mut self) -> Vec<String> {
        self.vehicle.notices()
    }
}

fn run(plan: &Plan, seed: u64, tells: Tells) -> (Outcome, String, f64) {
    let deepest = Arc::new(Mutex::new(0.0));
    let vehicle = Simulator::new(&plan.scenario, seed).unwrap();
    let liar = Liar { vehicle, tells, tick: 0, deepest: Arc::clone(&deepest) };
    let mut run = Run::on_link(plan, seed, Box::new(liar)).unwrap();
    let outcome = run.to_end();
    let deepest = *deepest.lock().unwrap();
    (outcome, run.trace().switches().to_string(), deepest)
}

/// Even numbers between -1 and 1, other ones for each seed.
fn even(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Of what it tells by itself, by the name of the way.
fn liar(how: &str, seed: u64) -> Tells {
    let mut even = even(seed);
    match how {
        "same" => Box::new(|_, _| 10.0),
        "normal 0.3" => Box::new(move |_, _| 10.0 + 0.3 * (0..12).map(|_| even()).sum::<f64>() / 2.0),
        "even 0.3" => Box::new(move |_, _| 10.0 + 0.3 * even()),
        "even 1" => Box::new(move |_, _| 10.0 + even()),
        // With the tick in it, for no two of them are the same.
        "wave" => Box::new(move |tick, _| 10.0 + 0.5 * wave(tick, 400)),
        "slow wave" => Box::new(move |tick, _| 10.0 + 0.5 * wave(tick, 1500)),
        "quick wave" => Box::new(move |tick, _| 10.0 + 0.5 * wave(tick, 100)),
        "steps" => Box::new(move |tick, _| if tick / 170 % 2 == 0 { 10.0 } else { 10.7 } + 0.01 * even()),
        _ => unreachable!("{how}"),
    }
}

fn wave(tick: u64, period: u64) -> f64 {
    albacore_geometry::math::sin(tick as f64 / period as f64 * 2.0 * albacore_geometry::math::PI)
}

/// The attack: it went down to the bottom, by 1.5 m every 15 s.
#[test]
fn a_sounder_that_hears_itself_leads_nowhere() {
    let mut faults = Vec::new();
    for asked in ["depth 40 m", "altitude 5 m"] {
        let plan = plan("altitude >= 3 m, depth <= 100 m", asked, "bottom(from: 20 m, to: 20 m)");
        for how in ["same", "normal 0.3", "even 0.3", "even 1", "wave", "slow wave", "quick wave", "steps"] {
            for seed in 1..=5 {
                let (outcome, trace, deepest) = run(&plan, seed, liar(how, seed));
                if deepest > 12.0 || outcome == Outcome::Aground {
                    faults.push(format!("{asked}, {how}, seed {seed}: {outcome:?}, {deepest:.1} m\n{trace}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// To scatter is no fault, nor is a bottom that falls away or rises.
#[test]
fn a_sounder_that_scatters_is_believed() {
    let mut faults = Vec::new();
    for bottom in ["bottom(from: 30 m, to: 30 m)", "bottom(from: 100 m, to: 40 m, toward: 0 deg)"] {
        for sounder in ["noise: 5 cm", "noise: 30 cm", "noise: 30 cm, rate: 1 Hz", "noise: 30 cm, dropouts: 50 %"] {
            for asked in ["depth 15 m", "altitude 5 m"] {
                let plan = plan("altitude >= 3 m, depth <= 100 m", asked, &format!("{bottom}\nsounder({sounder})"));
                for seed in 1..=3 {
                    let (_, trace, deepest) = run(&plan, seed, Box::new(|_, altitude| altitude));
                    let rejected = trace.contains("no less after a dive");
                    if rejected || deepest < 14.0 {
                        faults.push(format!("{bottom}, {sounder}, {asked}, seed {seed}: {deepest:.1} m\n{trace}"));
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// A bottom that falls away as fast as the vehicle dives looks like a sounder that hears nothing. It costs a rise, and no mission:
/// what is doubted is no late input.
#[test]
fn a_dive_down_a_slope_costs_time_and_no_mission() {
    for (across, hull) in [("1000 m", "fossen"), ("1300 m", "fossen"), ("1000 m", "kinematic")] {
        let plan = of(&format!(
            "mission dive in bay within 10 min {{
                area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 8000 m, width: 8000 m)
                limits {{ altitude >= 3 m, speed <= 2.5 m/s }}
                requires {{ position, course, heading fresh 5 s, else abort
                    depth, altitude fresh 5 s, else hold for 30 s then abort }}
                recovery within 2 min {{ goto op.center }}
                with depth 30 m, speed 1.5 m/s
                steer 0 deg for 8 min
            }}
            scenario bay {{
                vehicle({hull}, start: point(north: 0 m, east: 0 m), depth: 1 m)
                bottom(from: 12 m, to: 210 m, across: {across}, toward: 0 deg)
            }}"
        ));
        let (outcome, trace, deepest) = run(&plan, 1, Box::new(|_, altitude| altitude));
        assert_eq!(outcome, Outcome::Completed, "{hull}, {across}\n{trace}");
        assert!(deepest > 29.0, "{hull}, {across}: {deepest} m\n{trace}");
    }
}

/// A dive down a slope that is as steep as itself is stopped; what is found by the rise after it goes on.
#[test]
fn a_sounder_that_was_right_is_believed_by_the_next_rise() {
    let plan = plan("altitude >= 3 m, depth <= 100 m", "depth 15 m", "bottom(from: 30 m, to: 30 m)");
    let (_, trace, deepest) = run(&plan, 1, Box::new(|tick, altitude| if tick < 100 { 27.0 } else { altitude }));
    assert!(trace.contains("rejected: altitude, no less") && trace.contains("believed: altitude, grows"), "{trace}");
    assert!(deepest > 14.0, "{deepest}\n{trace}");
}

/// One that is wrong by a constant is found out when the vehicle lies on the bottom.
#[test]
fn what_is_told_on_the_bottom_is_no_echo_and_the_recovery_leads_up() {
    let plan = plan("altitude >= 3 m, depth <= 100 m", "depth 40 m", "bottom(from: 20 m, to: 20 m)");
    let (_, trace, _) = run(&plan, 1, Box::new(|_, altitude| altitude + 10.0));
    assert!(trace.contains("rejected: altitude, 10.0 m of a vehicle on the bottom"), "{trace}");
    assert!(trace.contains("came free of the bottom"), "{trace}");
}

#[test]
fn a_recovery_leads_off_the_bottom_whatever_it_is_asked() {
    let plan = plan("depth <= 30 m", "depth 26 m", "bottom(from: 20 m, to: 20 m)");
    let (outcome, trace, _) = run(&plan, 1, Box::new(|_, altitude| altitude + 10.0));
    assert_eq!(outcome, Outcome::Aground, "{trace}");
    let (_, recovery) = trace.split_once("aground for 30 s").unwrap();
    assert!(recovery.contains("came free of the bottom") && !recovery.contains("grounded at"), "{trace}");
}

/// A dive towards a level bottom 20 m deep.
fn hull_dives(hull: &str, altitude: &str, asked: &str, fault: &str) -> Plan {
    of(&format!(
        "mission dive in bay within 10 min {{
            area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 8000 m, width: 8000 m)
            limits {{ altitude >= {altitude}, speed <= 2.5 m/s }}
            requires {{ position, course, heading fresh 5 s, else abort }}
            recovery within 2 min {{ goto op.center }}
            with {asked}
            steer 0 deg for 4 min
        }}
        scenario bay {{
            vehicle({hull}, start: point(north: 0 m, east: 0 m), depth: 3 m)
            bottom(from: 20 m, to: 20 m)
            {fault}
        }}"
    ))
}

/// What `docs/language.md` says of hulls that overshoot.
#[test]
fn three_metres_keep_every_hull_off_a_level_bottom() {
    let grounds = |hull: &str, altitude: &str, speed: &str| {
        let plan = hull_dives(hull, altitude, &format!("depth 60 m, speed {speed}"), "");
        run(&plan, 1, Box::new(|_, altitude| altitude)).1.contains("grounded")
    };
    for hull in ["kinematic", "fossen", "prestero"] {
        for speed in ["1.2 m/s", "1.8 m/s", "2.5 m/s"] {
            assert!(!grounds(hull, "3 m", speed), "{hull} at {speed}");
        }
    }
    assert!(grounds("prestero", "1 m", "1.8 m/s"), "if it is better than that now, say so in the docs");
}

/// It hid how late it was in the silence with which it began, and led to the bottom.
#[test]
fn what_becomes_late_in_a_dive_leads_to_no_bottom() {
    for (hull, late, from) in
        [("kinematic", 6, 5), ("kinematic", 7, 20), ("fossen", 5, 5), ("prestero", 3, 5), ("prestero", 7, 10)]
    {
        let fault = format!("fault(altitude, delayed(by: {late} s), from: {from} s)");
        let plan = hull_dives(hull, "3 m", "depth 60 m, speed 1.8 m/s", &fault);
        let (_, trace, _) = run(&plan, 1, Box::new(|_, altitude| altitude));
        assert!(!trace.contains("grounded"), "{hull}, {fault}:\n{trace}");
    }
}

#[test]
fn a_silence_in_a_dive_costs_a_rise() {
    let plan =
        hull_dives("kinematic", "3 m", "depth 15 m, speed 1.8 m/s", "fault(altitude, off, from: 10 s, to: 14 s)");
    let (_, trace, deepest) = run(&plan, 1, Box::new(|_, altitude| altitude));
    assert!(
        trace.contains("rejected: altitude, silent in a dive of 2.1 m") && trace.contains("believed: altitude, grows"),
        "{trace}"
    );
    assert!(deepest > 14.0, "{deepest}\n{trace}");
}

/// The depth tells of no dive then, and the altitude that stands still too was believed.
#[test]
fn a_depth_that_is_known_to_be_stuck_leads_up() {
    let plan = of("mission dive in bay within 20 min {
            area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 3000 m, width: 3000 m)
            limits { altitude >= 3 m, speed <= 2.5 m/s }
            requires { position, course, heading fresh 5 s, else abort }
            recovery within 2 min { goto op.center at depth 1 m, speed 1.5 m/s }
            steer 0 deg for 60 s at depth 10 m, speed 1.5 m/s
            steer 0 deg for 60 s at depth 2 m, speed 1.5 m/s
            steer 0 deg for 45 s at depth 30 m, speed 1.5 m/s
            steer 180 deg for 60 s at depth 3 m, speed 1.5 m/s
        }
        scenario bay {
            bottom(from: 20 m, to: 20 m)
            vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 2 m)
            fault(depth, stuck, from: 50 s)
            fault(altitude, stuck, from: 115 s)
        }");
    let (_, trace, _) = run(&plan, 1, Box::new(|_, altitude| altitude));
    assert!(trace.contains("detected: depth stuck") && !trace.contains("grounded"), "{trace}");
}
