//! Where nothing is wrong the watch says nothing, and all that is sensed is believed: in simulation, and over both ends of a link
//! joined by a queue of bytes.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_geometry::{Geodetic, TangentFrame};
use albacore_link::{Controller, Rows, Server, recon};
use albacore_session::{Outcome, Plan, Run, load};
use albacore_sim::Simulator;
use albacore_vehicle::{Command, Measurement, Snapshot, Vehicle, VehicleError, Vertical};
use rayon::prelude::*;
use std::path::Path;

/// Missions by their file, their name, and the scenario where it is not their own.
const MISSIONS: [(&str, &str, Option<&str>); 21] = [
    ("missions/box.alb", "box", None),
    ("missions/deepest_point.alb", "deepest_point", None),
    ("missions/duck_single.alb", "duck_single", None),
    ("missions/duck_single_2005.alb", "duck_single_2005", None),
    ("missions/round_a_wreck.alb", "round_a_wreck", None),
    ("missions/thermocline.alb", "thermocline", None),
    ("tests/faults/survey.alb", "survey", None),
    ("tests/watch/yoyo.alb", "yoyo", None),
    ("tests/watch/yoyo.alb", "yoyo", Some("bay_fossen")),
    ("tests/watch/yoyo.alb", "yoyo", Some("bay_prestero")),
    ("tests/watch/yoyo.alb", "overlaid", None),
    ("tests/watch/yoyo.alb", "overlaid", Some("bay_fossen")),
    ("tests/watch/yoyo.alb", "overlaid", Some("bay_prestero")),
    ("tests/watch/yoyo.alb", "surfacing", None),
    ("tests/watch/late_depth.alb", "late_depth", None),
    ("tests/watch/late_depth.alb", "late_depth", Some("noisy")),
    ("tests/watch/still.alb", "still", None),
    ("tests/watch/turns.alb", "turns", None),
    ("tests/watch/turns.alb", "turns", Some("bay_fossen")),
    ("tests/watch/turns.alb", "turns", Some("bay_prestero")),
    ("tests/watch/turns.alb", "turns", Some("bay_slow")),
];

/// A vehicle is met when it has swum for so long.
const UNDER_WAY_TICKS: u32 = 100;

/// What a run ends with, and the lines of its trace in which something is doubted.
fn doubts(mut run: Run) -> (Outcome, Vec<String>) {
    let outcome = run.to_end();
    let doubted =
        |line: &&str| ["detected:", "rejected:", "believed:", "altitude unknown"].iter().any(|w| line.contains(w));
    (outcome, run.trace().switches().lines().filter(doubted).map(str::to_string).collect())
}

fn plan((file, mission, scenario): (&str, &str, Option<&str>)) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    let script = load(&path, None, &[]).unwrap();
    assert!(script.is_sound(), "{file}: {:?}", script.findings);
    Plan::new(&script, file, Some(mission), scenario).unwrap()
}

/// What is told of runs, which share the processors, in the order of missions and seeds.
fn told(run: impl Fn(&Plan, u64) -> Run + Sync, seeds: u64) -> Vec<String> {
    let runs: Vec<_> = MISSIONS.into_iter().flat_map(|of| (1..=seeds).map(move |seed| (of, seed))).collect();
    let told = runs.into_par_iter().with_max_len(1).filter_map(|(of, seed)| {
        let (outcome, lines) = doubts(run(&plan(of), seed));
        let is_told = outcome != Outcome::Completed || !lines.is_empty();
        is_told.then(|| format!("{of:?}, seed {seed}, {}: {}", outcome.name(), lines.join("\n")))
    });
    told.collect()
}

/// More of them by `WATCH_SEEDS=20 cargo test --release -p albacore-session --test simulated watch::`.
fn seeds() -> u64 {
    std::env::var("WATCH_SEEDS").ok().map_or(1, |text| text.parse().unwrap())
}

#[test]
fn nothing_is_doubted_in_simulation() {
    let told = told(|plan, seed| Run::new(plan, seed).unwrap(), seeds());
    assert!(told.is_empty(), "{}", told.join("\n"));
}

#[test]
fn nothing_is_doubted_on_a_link() {
    let told = told(|plan, seed| Run::on_link(plan, seed, Box::new(Pair::new(plan, seed))).unwrap(), seeds());
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// Both ends of a link, in one thread and without a clock.
struct Pair {
    vehicle: Server<Simulator>,
    controller: Controller,
    to_vehicle: Vec<u8>,
}

impl Pair {
    fn new(plan: &Plan, seed: u64) -> Self {
        let simulator = Simulator::new(&plan.scenario, seed).unwrap();
        let somewhere = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
        let (frame, start) = (plan.frame().unwrap_or(somewhere), simulator.truth());
        let vertical = Vertical::Depth(start.depth.max(1.0));
        let rows: Rows = "200x30x6".parse().unwrap();
        let vehicle =
            Server::new(recon::server(), simulator, frame, &rows.into(), (start.position, start.heading), vertical);
        let mut pair =
            Pair { vehicle, controller: Controller::new(recon::controller(), frame), to_vehicle: Vec::new() };
        // Under way in its own mission: one that stands still has no course.
        for _ in 0..UNDER_WAY_TICKS {
            pair.sense(&mut Snapshot::default()).unwrap();
        }
        pair
    }

    fn tick(&mut self) -> Result<(), VehicleError> {
        self.vehicle.tick(&std::mem::take(&mut self.to_vehicle))?;
        self.controller.hear(&self.vehicle.take_output());
        Ok(())
    }

    fn send(&mut self) {
        self.to_vehicle.extend(self.controller.take_output());
    }
}

impl Vehicle for Pair {
    fn measurements(&self) -> &[Measurement] {
        self.controller.measurements()
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        while !self.controller.is_due() {
            self.tick()?;
        }
        self.controller.sense(snapshot);
        self.send();
        Ok(())
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.controller.take_over();
        self.send();
        Ok(())
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        self.controller.command(command);
        self.send();
        Ok(())
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.controller.give_back();
        self.send();
        Ok(())
    }

    fn release(&mut self) -> Result<(), VehicleError> {
        while !self.controller.release() {
            self.send();
            self.tick()?;
        }
        Ok(())
    }

    fn notices(&mut self) -> Vec<String> {
        self.controller.take_notices()
    }
}
