//! What the world costs with some 8,000 filaments alive: `cargo bench -p albacore-sim`.

#![expect(clippy::unwrap_used, reason = "a benchmark whose world cannot be has nothing to measure")]

use albacore_sim::{Noise, Plume, Scenario, Simulator, Stream, presets};
use albacore_vehicle::{Command, Snapshot, TICK_S, Vehicle, Vertical};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

/// Of the filaments alive, one in this many is a place to look.
const PLACES_EVERY: usize = 9;
/// Samples a second of the sensor whose samples are measured: so many that all else of a tick is little beside them.
const FAST_HZ: f64 = 1000.0;

/// The trial as published, with the same plume at every height and with one that rises.
#[derive(Clone, Copy, Debug)]
enum Duck {
    Flat,
    Layered,
}

impl Duck {
    fn scenario(self) -> Scenario {
        match self {
            Duck::Flat => presets::duck_2003_flat(),
            Duck::Layered => presets::duck_2003(),
        }
    }
}

fn main() {
    divan::main();
}

/// One step of every filament: with steps of one tick, a tick is a step and little else. The items are filaments.
#[divan::bench(args = [Duck::Flat, Duck::Layered], sample_count = 100, sample_size = 20)]
fn filament_step(bencher: Bencher, duck: Duck) {
    let scenario = duck.scenario();
    let plume = scenario.plume.clone().map(|plume| Plume { step: TICK_S, graded: false, ..plume });
    let mut simulator = Simulator::new(&Scenario { plume, ..scenario }, 1).unwrap();
    let mut snapshot = Snapshot::default();
    simulator.sense(&mut snapshot).unwrap();
    bencher.counter(ItemsCount::new(simulator.filaments().count())).bench_local(|| simulator.sense(&mut snapshot));
}

/// The increments of such a step alone: of each filament one draw for the horizontal, and in a layer one more for the vertical.
/// The items are filaments.
#[divan::bench(args = [Duck::Flat, Duck::Layered], sample_count = 100, sample_size = 20)]
fn increment(bencher: Bencher, duck: Duck) {
    let filaments = Simulator::new(&duck.scenario(), 1).unwrap().filaments().count() as u64;
    let (horizontal, vertical) = (Noise::new(1, Stream::Diffusion), Noise::new(1, Stream::VerticalDiffusion));
    bencher.counter(ItemsCount::new(filaments as usize)).bench_local(|| {
        let draws = black_box(0)..black_box(filaments);
        draws.fold([0.0; 3], |[x, y, z], filament| {
            let index = filament << 32 | 7;
            let (dx, dy) = horizontal.nearly_gaussian_pair(index);
            let dz = match duck {
                Duck::Flat => 0.0,
                Duck::Layered => vertical.nearly_gaussian_pair(index).0,
            };
            [x + dx, y + dy, z + dz]
        })
    });
}

/// One look at a place anywhere in the plume, in an index made before.
#[divan::bench(args = [Duck::Flat, Duck::Layered], sample_count = 100, sample_size = 1000)]
fn concentration_anywhere(bencher: Bencher, duck: Duck) {
    let simulator = Simulator::new(&duck.scenario(), 1).unwrap();
    let places: Vec<_> = simulator.filaments().map(|(place, _)| place).step_by(PLACES_EVERY).collect();
    let survey = simulator.survey();
    let mut next = places.iter().cycle();
    bencher.bench_local(|| next.next().map(|&place| survey.concentration(black_box(place), 2.0)));
}

/// The index itself. The items are filaments.
#[divan::bench(args = [Duck::Flat, Duck::Layered], sample_count = 100, sample_size = 20)]
fn index(bencher: Bencher, duck: Duck) {
    let simulator = Simulator::new(&duck.scenario(), 1).unwrap();
    bencher.counter(ItemsCount::new(simulator.filaments().count())).bench_local(|| simulator.survey());
}

/// A tick of samples on the way down the middle of the plume, which share a search. The items are samples, noise included.
#[divan::bench(args = [Duck::Flat, Duck::Layered], sample_count = 100, sample_size = 40)]
fn concentration_underway(bencher: Bencher, duck: Duck) {
    let mut scenario = duck.scenario();
    scenario.vehicle.start = scenario.sources[0].at;
    scenario.vehicle.depth = 4.0;
    scenario.fluorometer.rate = FAST_HZ;
    let heading = scenario.flow.mean.toward();
    let mut simulator = Simulator::new(&scenario, 1).unwrap();
    simulator.take_over().unwrap();
    simulator.command(&Command { heading, speed: 2.0, vertical: Vertical::Altitude(2.0) }).unwrap();
    let mut snapshot = Snapshot::default();
    bencher.counter(ItemsCount::new((FAST_HZ * TICK_S) as u64)).bench_local(|| simulator.sense(&mut snapshot));
}
