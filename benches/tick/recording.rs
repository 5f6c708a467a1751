//! A run of a mission, to be replayed without the simulator.

use albacore_machine::{Machine, State};
use albacore_session::{Plan, load};
use albacore_sim::Simulator;
use albacore_vehicle::{Command, Snapshot, Vehicle};
use std::path::Path;
use std::sync::Arc;

/// A run from its first tick to the end of its strategy.
pub struct Recording {
    pub snapshots: Vec<Snapshot>,
    /// What the machine commanded at each.
    pub commands: Vec<Option<Command>>,
    /// The tick on which the strategy is first stepped.
    pub begin: usize,
    /// A machine, and its state at that tick.
    pub machine: Machine,
    pub state: State,
}

impl Recording {
    /// Seed 1 of a mission that calls a strategy.
    pub fn new(mission: &str, strategy: &str) -> Self {
        let script = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(mission), None, &[]).unwrap();
        let plan = Plan::new(&script, mission, None, None).unwrap();
        let mut vehicle = Simulator::new(&plan.scenario, 1).unwrap();
        let mut machine = Machine::new(Arc::clone(&plan.program), vehicle.measurements()).unwrap();
        let mut began: Option<(usize, State)> = None;
        let (mut snapshots, mut commands) = (Vec::new(), Vec::new());
        let mut snapshot = Snapshot::default();
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.take_over().unwrap();
        loop {
            let command = machine.step(&snapshot);
            if let Some(command) = &command {
                vehicle.command(command).unwrap();
            }
            let active = machine.active().iter().any(|&id| plan.program.activities[id as usize].name == strategy);
            if let (false, Some((begin, state))) = (active, began.clone()) {
                return Recording { snapshots, commands, begin, machine, state };
            }
            snapshots.push(snapshot.clone());
            commands.push(command);
            vehicle.sense(&mut snapshot).unwrap();
            if active && began.is_none() {
                began = Some((snapshots.len(), machine.state().clone()));
            }
            assert!(machine.outcome().is_none(), "{mission} ends without {strategy}");
        }
    }

    /// The ticks of the strategy.
    pub fn ticks(&self) -> &[Snapshot] {
        &self.snapshots[self.begin..]
    }
}
