//! What one control tick of plume tracing costs, and how often as long that is as the same written by hand:
//! `cargo bench --bench tick`.

#![expect(clippy::unwrap_used, reason = "a benchmark whose mission cannot run has nothing to measure")]
#![expect(clippy::print_stdout, reason = "this is what it is for")]

mod hand_written;
mod recording;

use albacore_machine::Machine;
use divan::{Bencher, black_box};
use hand_written::Mission;
use recording::Recording;
use std::time::Instant;

/// Passes over the recording, the machine's and the other's in turn, so that both meet the same machine load.
const ROUNDS: usize = 100;

fn main() {
    compare();
    divan::main();
}

/// The strategy as printed, by the machine and by hand.
fn compare() {
    let recording = Recording::new("missions/duck_single_2005.alb", "cpt_2005");
    let mut by_hand = Mission::new().unwrap();
    for (tick, (snapshot, command)) in recording.snapshots.iter().zip(&recording.commands).enumerate() {
        assert_eq!(by_hand.step(snapshot), *command, "tick {tick}");
    }
    let mut by_hand = Mission::new().unwrap();
    recording.snapshots[..recording.begin].iter().for_each(|snapshot| _ = by_hand.step(snapshot));

    let (mut machine_ns, mut hand_ns) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        machine_ns.push(machine_pass(&recording));
        hand_ns.push(hand_pass(&recording, &by_hand));
    }
    let ticks = recording.ticks().len();
    println!("cpt_2005, {ticks} ticks, ns a tick    median  fastest");
    let (machine, hand) = (Figures::of(machine_ns), Figures::of(hand_ns));
    println!("  by the machine                   {:6.0}   {:6.0}", machine.median, machine.fastest);
    println!("  written by hand                  {:6.0}   {:6.0}", hand.median, hand.fastest);
    println!(
        "  ratio                            {:6.2}   {:6.2}",
        machine.median / hand.median,
        machine.fastest / hand.fastest
    );
}

fn machine_pass(recording: &Recording) -> f64 {
    let mut machine: Machine = recording.machine.clone();
    machine.restore(recording.state.clone());
    let begin = Instant::now();
    for snapshot in recording.ticks() {
        black_box(machine.step(black_box(snapshot)));
    }
    begin.elapsed().as_nanos() as f64 / recording.ticks().len() as f64
}

fn hand_pass(recording: &Recording, mission: &Mission) -> f64 {
    let mut mission = mission.clone();
    let begin = Instant::now();
    for snapshot in recording.ticks() {
        black_box(mission.step(black_box(snapshot)));
    }
    begin.elapsed().as_nanos() as f64 / recording.ticks().len() as f64
}

struct Figures {
    median: f64,
    fastest: f64,
}

impl Figures {
    fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        Figures { median: samples[samples.len() / 2], fastest: samples[0] }
    }
}

/// One tick of the better strategy, no simulator in it. A sample is a stretch of a thousand ticks: slowest and fastest are
/// stretches too.
#[divan::bench(sample_count = 100, sample_size = 1000)]
fn tick(bencher: Bencher) {
    let recording = Recording::new("missions/duck_single.alb", "trace_plume");
    let mut machine = recording.machine.clone();
    let mut next = recording.ticks().len();
    bencher.bench_local(|| {
        if next == recording.ticks().len() {
            machine.restore(recording.state.clone());
            next = 0;
        }
        let command = machine.step(black_box(&recording.ticks()[next]));
        next += 1;
        command
    });
}
