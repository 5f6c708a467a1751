//! Missions that are driven over links that lose, corrupt, split, repeat, reorder, delay and cut, by seed, and are judged at the far
//! end. More seeds than those of every day, or another part of them, by
//!
//! ```text
//! ATTACK_SEEDS=1000 cargo test --release --test attack -- --nocapture
//! ATTACK_FIRST=41 ATTACK_SEEDS=1 ATTACK_TOLD=1 cargo test --test attack -- --nocapture
//! ```
//!
//! The second prints the trace of each run.
//!
//! - No command is sent that is not finite or outside the mission's limits, and the vehicle holds none outside its own.
//! - What is sent is what the mission commands at that moment: nothing old, and not much at once.
//! - The run ends, whatever the link does, and its journal can be read to its end.
//! - After its end, and after a controller that dies, the vehicle soon drives itself again.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test that cannot load its mission has failed; figures are printed"
)]
#![cfg(unix)]

mod binaries;
mod desk;
mod judge;
mod weather;

use albacore_link::{LinkVehicle, Url};
use albacore_session::{Outcome, Plan, Run, Running, ServedVehicle, load};
use desk::{Desk, Line};
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::{Arc, Mutex};
use weather::{Fate, Weather};

const ATTACK: &str = "tests/attack/attack.alb";
/// Steps of a run at most: its 90 s, the recovery, and all that it may wait for.
const STEPS_MAX: usize = 6_000;
/// Ticks after which the vehicle drives itself again at the latest: what is under way arrives, then come 5 s of silence.
const PEACE_TICKS: usize = 150;

/// A journal in memory.
#[derive(Clone, Default)]
struct Kept(Arc<Mutex<Vec<u8>>>);

impl Write for Kept {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// How an attack ended, for the figures, and what it broke.
struct Attacked {
    end: String,
    broken: Vec<String>,
}

fn attack(seed: u64) -> Attacked {
    let weather = Weather::of(seed);
    let mission = Some(weather.mission);
    let script = load(ATTACK.as_ref(), mission, &[]).unwrap();
    let url = Url::parse("serial:/dev/desk?dialect=recon").unwrap();
    let plan = Plan::on_link(&script, ATTACK, mission, &url.to_string()).unwrap();
    let vehicle = ServedVehicle::new(&script, ATTACK, Some("bay")).unwrap();
    let desk = Arc::new(Mutex::new(Desk::new(vehicle.far_end(&url, seed, None).unwrap())));
    let line = Line::new(&desk, weather.faults.clone(), seed);
    let clock = Arc::clone(&desk);
    let clock = Box::new(move || clock.lock().unwrap().now());
    let vehicle = LinkVehicle::new(url, Box::new(line.clone()), plan.frame().unwrap(), 1.0, clock).unwrap();
    let mut run = Run::on_link(&plan, seed, Box::new(vehicle)).unwrap();
    let kept = Kept::default();
    run.with_journal(Box::new(kept.clone()), &[]);
    let outcome = drive(&mut run, &desk, weather.fate);
    let failed = run.release_failed();
    let summary = run.summary(0.0);
    if std::env::var_os("ATTACK_TOLD").is_some() {
        println!(
            "seed {seed} ({weather})\n    {} after {} s: {}\n{}",
            summary.outcome,
            summary.sim_time_s,
            summary.reason,
            run.trace()
        );
    }
    drop(run);
    (0..PEACE_TICKS).for_each(|_| line.wait());
    let bytes = kept.0.lock().unwrap().clone();
    let broken = judge::broken(&desk.lock().unwrap(), &bytes, outcome, weather.fate);
    let release = if failed { ", release not seen" } else { "" };
    let end = outcome.map_or("killed".to_string(), |outcome| outcome.name().to_string());
    Attacked { end: format!("{} {end}{release}", weather.mission), broken }
}

/// Steps until the run ends, or something ends it; none if it does not end by itself.
fn drive(run: &mut Run, desk: &Mutex<Desk>, fate: Fate) -> Option<Outcome> {
    for step in 0..STEPS_MAX {
        desk.lock().unwrap().mission_tick = run.tick();
        let running = match fate {
            Fate::Killed(at) if step == at => return None,
            Fate::Interrupted(at) if step == at => run.interrupt(),
            _ => run.step(),
        };
        if let Running::Over(outcome) = running {
            return Some(outcome);
        }
    }
    None
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn no_link_makes_a_vehicle_do_what_it_must_not() {
    let first = number("ATTACK_FIRST", 1);
    let seeds = first..first + number("ATTACK_SEEDS", 30);
    let mut ends: BTreeMap<String, u64> = BTreeMap::new();
    let mut broken = Vec::new();
    for seed in seeds.clone() {
        let attacked = attack(seed);
        *ends.entry(attacked.end).or_default() += 1;
        broken.extend(attacked.broken.into_iter().map(|what| format!("seed {seed} ({}): {what}", Weather::of(seed))));
    }
    for (end, count) in &ends {
        println!("{count:6}  {end}");
    }
    // A harness in which no mission gets through tests no commands.
    let through = ends.iter().filter(|(end, _)| end.ends_with("completed") || end.ends_with("timed_out")).count();
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
    assert!(through > 0 || seeds.end - seeds.start < 30, "{ends:?}");
}

#[test]
fn the_same_seed_is_the_same_attack() {
    for seed in [3, 5] {
        assert_eq!(attack(seed).end, attack(seed).end);
    }
}
