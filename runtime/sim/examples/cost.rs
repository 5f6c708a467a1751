//! What the world costs: `cargo run --release -p albacore-sim --example cost`.

#![expect(clippy::print_stdout, reason = "a report is this program's purpose")]

use albacore_geometry::Heading;
use albacore_sim::{Plume, Scenario, Simulator, presets};
use albacore_vehicle::{Command, Snapshot, Vehicle, Vertical};
use std::hint::black_box;

/// Wall time of a piece of work, s.
#[expect(clippy::disallowed_methods, reason = "wall time is what is measured; nothing of it enters the world")]
fn seconds<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = std::time::Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

fn run(simulator: &mut Simulator, ticks: u32) {
    let mut snapshot = Snapshot::default();
    for _ in 0..ticks {
        // The simulator's port never fails.
        let _ = simulator.sense(&mut snapshot);
        black_box(&snapshot);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (name, scenario) in [("duck_2003_flat", presets::duck_2003_flat()), ("duck_2003", presets::duck_2003())] {
        let (simulator, spin_up) = seconds(|| Simulator::new(&scenario, 1));
        let simulator = simulator?;
        let alive = simulator.filaments().count();

        // A mission in the plume: up its middle and back, sampled at 10 Hz.
        let mut mission = simulator.clone();
        mission.take_over()?;
        let ((), up) = seconds(|| {
            for leg in 0..18 {
                let heading = Heading::from_degrees(if leg % 2 == 0 { 300.0 } else { 110.0 });
                let _ = mission.command(&Command { heading, speed: 2.0, vertical: Vertical::Altitude(2.0) });
                run(&mut mission, 1000);
            }
        });
        println!("{name}: {alive} filaments; spin-up {spin_up:.3} s, 1,800 s of mission {up:.3} s");

        // Steps alone: ten times as many, so that they dominate. The vehicle drifts beyond the plume.
        let plume = scenario.plume.clone().map(|plume| Plume { step: 0.1, ..plume });
        let fine = Scenario { plume, ..scenario.clone() };
        let mut fine = Simulator::new(&fine, 1)?;
        let ((), steps) = seconds(|| run(&mut fine, 5000));
        println!("    {:.1} ns a filament step, all else included", steps * 1e9 / 5000.0 / alive as f64);

        // Queries alone: down the plume at 2 m/s, with a sensor a hundred times as fast.
        let mut along = scenario.clone();
        along.vehicle.start = scenario.sources[0].at;
        along.vehicle.depth = 4.0;
        let mut walls = Vec::new();
        for rate in [10.0, 1000.0] {
            along.fluorometer.rate = rate;
            let mut probe = Simulator::new(&along, 1)?;
            probe.take_over()?;
            let down_flow = along.flow.mean.toward();
            probe.command(&Command { heading: down_flow, speed: 2.0, vertical: Vertical::Altitude(2.0) })?;
            walls.push(seconds(|| run(&mut probe, 4000)).1);
        }
        let places: Vec<_> = simulator.filaments().map(|(place, _)| place).step_by(9).collect();
        let ((), search) = seconds(|| {
            for &place in &places {
                black_box(simulator.concentration(black_box(place), 2.0));
            }
        });
        println!(
            "    {:.2} us a sample, noise included, and {:.2} us for the search that the 10 of a step share",
            (walls[1] - walls[0]) * 1e6 / 396_000.0,
            search * 1e6 / places.len() as f64
        );
    }
    let (still, spin_up) = seconds(|| Simulator::new(&Scenario::default(), 1));
    let mut still = still?;
    let ((), ticks) = seconds(|| run(&mut still, 1_000_000));
    println!("no plume: {spin_up:.6} s to begin, {:.0} ns a tick", ticks * 1e9 / 1e6);
    Ok(())
}
