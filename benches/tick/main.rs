//! What one control tick of plume tracing costs, and how often as long that is as the same written by hand:
//! `cargo bench --bench tick`.

#![expect(clippy::unwrap_used, reason = "a benchmark whose mission cannot run has nothing to measure")]
#![expect(clippy::print_stdout, reason = "this is what it is for")]

mod hand_written;
mod recording;

use albacore_vehicle::Snapshot;
use divan::{Bencher, black_box};
use hand_written::{Guided, Mission};
use recording::Recording;
use std::time::Instant;

/// How often the recording is replayed.
const ROUNDS: usize = 40;
/// Machine and hand take turns at stretches of so many ticks, so that both meet the same load of the computer.
const STRETCH: usize = 500;

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

    let guided = guidance(&recording, by_hand.clone());
    let stretches: Vec<&[Snapshot]> = recording.ticks().chunks(STRETCH).collect();
    let mut machine_ns = vec![Vec::new(); stretches.len()];
    let mut hand_ns = vec![Vec::new(); stretches.len()];
    let mut guided_ns = vec![Vec::new(); stretches.len()];
    for _ in 0..ROUNDS {
        let mut machine = recording.machine.clone();
        machine.restore(recording.state.clone());
        let mut by_hand = by_hand.clone();
        for (i, (stretch, guided)) in stretches.iter().zip(guided.chunks(STRETCH)).enumerate() {
            machine_ns[i].push(nanoseconds(stretch, |snapshot| _ = black_box(machine.step(snapshot))));
            hand_ns[i].push(nanoseconds(stretch, |snapshot| _ = black_box(by_hand.step(snapshot))));
            guided_ns[i].push(nanoseconds(guided, Guided::step));
        }
    }
    let ticks = recording.ticks().len();
    let (machine, hand) = (Figures::of(machine_ns, ticks), Figures::of(hand_ns, ticks));
    let guidance = Figures::of(guided_ns, ticks);
    println!("cpt_2005, {ticks} ticks of a run; ns a tick   median   fastest");
    println!("  by the machine                        {:6.0}    {:6.0}", machine.median, machine.fastest);
    println!("  written by hand                       {:6.0}    {:6.0}", hand.median, hand.fastest);
    let (median, fastest) = (machine.median / hand.median, machine.fastest / hand.fastest);
    println!("  ratio                                 {median:6.2}    {fastest:6.2}");
    println!("  of either, guidance by the same crate {:6.0}    {:6.0}", guidance.median, guidance.fastest);
    let without = |of: fn(&Figures) -> f64| (of(&machine) - of(&guidance)) / (of(&hand) - of(&guidance));
    println!("  ratio without it                      {:6.2}    {:6.2}", without(|f| f.median), without(|f| f.fastest));
}

/// The guidance of each tick of the strategy, which the mission by hand has come to.
fn guidance(recording: &Recording, mut by_hand: Mission) -> Vec<Guided> {
    let of_tick = |snapshot| {
        by_hand.step(snapshot);
        by_hand.guided()
    };
    recording.ticks().iter().map(of_tick).collect()
}

#[expect(clippy::disallowed_methods, reason = "a benchmark measures the time of its computer")]
fn nanoseconds<T>(stretch: &[T], mut step: impl FnMut(&T)) -> f64 {
    let begin = Instant::now();
    for tick in stretch {
        step(black_box(tick));
    }
    begin.elapsed().as_nanos() as f64
}

/// Nanoseconds a tick: of each stretch the median and the fastest of all rounds, over all stretches.
struct Figures {
    median: f64,
    fastest: f64,
}

impl Figures {
    fn of(samples: Vec<Vec<f64>>, ticks: usize) -> Self {
        let mut sum = Figures { median: 0.0, fastest: 0.0 };
        for mut stretch in samples {
            stretch.sort_by(f64::total_cmp);
            sum.median += stretch[stretch.len() / 2] / ticks as f64;
            sum.fastest += stretch[0] / ticks as f64;
        }
        sum
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
