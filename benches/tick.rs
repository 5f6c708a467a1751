//! What one control tick of the plume tracing strategy costs: `cargo bench --bench tick`.

#![expect(clippy::unwrap_used, reason = "a benchmark whose mission cannot run has nothing to measure")]

use albacore_machine::{Machine, State};
use albacore_session::{Plan, load};
use albacore_sim::Simulator;
use albacore_vehicle::{Snapshot, Vehicle};
use divan::{Bencher, black_box};
use std::path::Path;
use std::sync::Arc;

const MISSION: &str = "missions/duck_single.alb";
const STRATEGY: &str = "trace_plume";

/// The ticks of a run in which the strategy was active.
struct Recording {
    /// A machine as it was before the first of them.
    machine: Machine,
    begin: State,
    snapshots: Vec<Snapshot>,
}

impl Recording {
    fn new() -> Self {
        let script = load(Path::new(MISSION), None, &[]).unwrap();
        let plan = Plan::new(&script, MISSION, None, None).unwrap();
        let mut vehicle = Simulator::new(&plan.scenario, 1).unwrap();
        let mut machine = Machine::new(Arc::clone(&plan.program), vehicle.channels()).unwrap();
        let mut begin = None;
        let mut snapshots = Vec::new();
        let mut snapshot = Snapshot::default();
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.take_over().unwrap();
        while machine.outcome().is_none() {
            if let Some(command) = machine.step(&snapshot) {
                vehicle.command(&command).unwrap();
            }
            vehicle.sense(&mut snapshot).unwrap();
            let active = machine.active().iter().any(|&id| plan.program.activities[id as usize].name == STRATEGY);
            if active {
                begin.get_or_insert_with(|| machine.state().clone());
                snapshots.push(snapshot.clone());
            } else if begin.is_some() {
                break;
            }
        }
        let begin = begin.unwrap();
        machine.restore(begin.clone());
        Recording { machine, begin, snapshots }
    }
}

fn main() {
    divan::main();
}

/// One tick, no simulator in it. A sample is a stretch of a thousand ticks: slowest and fastest are stretches too.
#[divan::bench(sample_count = 100, sample_size = 1000)]
fn tick(bencher: Bencher) {
    let Recording { mut machine, begin, snapshots } = Recording::new();
    let mut next = 0;
    bencher.bench_local(|| {
        if next == snapshots.len() {
            machine.restore(begin.clone());
            next = 0;
        }
        let command = machine.step(black_box(&snapshots[next]));
        next += 1;
        command
    });
}
