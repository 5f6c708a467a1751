//! What the world costs with some 9,000 filaments alive: `cargo bench -p albacore-sim --bench world`.

#![expect(clippy::print_stdout, reason = "a benchmark tells what it measured")]
#![expect(clippy::unwrap_used, reason = "a benchmark whose world cannot be has nothing to measure")]

mod common;
#[path = "../tests/world/mod.rs"]
mod worlds;

use albacore_sim::{Environment, Noise, Plume, Scenario, Simulator, Stream};
use albacore_vehicle::{Command, Snapshot, TICK_S, Vehicle, Vertical};
use common::{cost, stretches};
use std::hint::black_box;

/// What the source releases a second. At the 1.0 of the trial some 8,000 filaments are alive.
const RATE: f64 = 1.13;
/// Of the filaments alive, one in this many is a place to look.
const PLACES_EVERY: usize = 9;
/// Samples a second of the sensor whose samples are measured: so many that all else of a tick is little beside them.
const FAST_HZ: f64 = 1000.0;

/// A plume that is the same at every height, and one that rises.
#[derive(Clone, Copy, Debug)]
enum Duck {
    Flat,
    Layered,
}

impl Duck {
    fn scenario(self) -> Scenario {
        let mut scenario = match self {
            Duck::Flat => worlds::flat(),
            Duck::Layered => worlds::layered(),
        };
        scenario.environment.sources[0].rate = RATE;
        scenario
    }
}

fn main() {
    for duck in [Duck::Flat, Duck::Layered] {
        let simulator = Simulator::new(&duck.scenario(), 1).unwrap();
        println!("{duck:?}: {} filaments alive", simulator.filaments().count());
        let [step, limit, increment] = step_limit_and_increment(duck);
        println!("  one step of one filament           {step:6.2} ns");
        println!("  the same by the limit kernel       {limit:6.2} ns: {:.2} times as long", step / limit);
        println!("  of these its increment             {increment:6.2} ns: {:.0} %", 100.0 * increment / step);
        println!("  one concentration under way        {:6.1} ns", concentration_underway(duck));
        println!("  one concentration anywhere         {:6.1} ns", concentration_anywhere(&simulator));
        println!("  the index, for each filament       {:6.1} ns", index(&simulator));
    }
}

/// One step of a filament, the same by the limit kernel, and its increment alone, which take turns. With steps of one tick for all of them,
/// a tick is a step and little else. An increment is one draw.
fn step_limit_and_increment(duck: Duck) -> [f64; 3] {
    let scenario = duck.scenario();
    let plume = scenario.environment.plume.clone().map(|plume| Plume { step: TICK_S, graded: false, ..plume });
    let mut begin =
        Simulator::new(&Scenario { environment: Environment { plume, ..scenario.environment }, ..scenario }, 1)
            .unwrap();
    begin.sense(&mut Snapshot::default()).unwrap();
    let filaments = begin.filaments().count() as u64;
    let noise = Noise::new(1, Stream::Diffusion);
    let mut step = || {
        let (mut simulator, mut snapshot) = (begin.clone(), Snapshot::default());
        stretches(20, 10, || simulator.sense(&mut snapshot).unwrap())
    };
    let mut limit = || {
        let mut kernel = LimitKernel::new(filaments);
        stretches(20, 10, || kernel.step())
    };
    let mut increment = || {
        stretches(20, 10, || {
            let draws = black_box(0)..black_box(filaments);
            black_box(draws.fold([0.0; 3], |[x, y, z], filament| {
                let [dx, dy, dz] = noise.nearly_gaussian_triple(filament << 32 | 7);
                [x + dx, y + dy, z + dz]
            }));
        })
    };
    cost([&mut step, &mut limit, &mut increment]).map(|ns| ns / filaments as f64)
}

/// The least that a step of filaments in a field can be: a bilinear velocity from a grid of 42 x 112 nodes, two nearly Gaussian numbers of one
/// draw of a counter-based generator, and growth, in arrays of numbers of one kind.
struct LimitKernel {
    x: Vec<f64>,
    y: Vec<f64>,
    squared_radius: Vec<f64>,
    u: Vec<f64>,
    v: Vec<f64>,
    noise: Noise,
    steps: u64,
}

impl LimitKernel {
    const COLUMNS: usize = 112;
    const ROWS: usize = 42;

    fn new(filaments: u64) -> Self {
        let noise = Noise::new(1, Stream::Diffusion);
        let nodes = Self::COLUMNS * Self::ROWS;
        let spread = |width: usize, offset: u64| {
            (0..filaments).map(|i| noise.uniform(2 * i + offset) * 0.9 * (width - 1) as f64).collect()
        };
        LimitKernel {
            x: spread(Self::COLUMNS, 0),
            y: spread(Self::ROWS, 1),
            squared_radius: vec![0.04; filaments as usize],
            u: (0..nodes as u64).map(|i| 0.1 + 0.01 * noise.uniform(i)).collect(),
            v: (0..nodes as u64).map(|i| 0.01 * noise.uniform(i)).collect(),
            noise,
            steps: 0,
        }
    }

    fn step(&mut self) {
        self.steps += 1;
        let filaments = self.x.iter_mut().zip(&mut self.y).zip(&mut self.squared_radius);
        for (number, ((x, y), squared_radius)) in (0u64..).zip(filaments) {
            let (column, row) = (*x as usize, *y as usize);
            let (fx, fy) = (*x - column as f64, *y - row as f64);
            let node = (row * Self::COLUMNS + column).min(self.u.len() - Self::COLUMNS - 2);
            let bilinear = |f: &[f64]| {
                let near = f[node] + fx * (f[node + 1] - f[node]);
                let far = f[node + Self::COLUMNS];
                let far = far + fx * (f[node + Self::COLUMNS + 1] - far);
                near + fy * (far - near)
            };
            let [nx, ny, _] = self.noise.nearly_gaussian_triple(number << 32 | self.steps);
            *x += 1e-4 * (bilinear(&self.u) + nx);
            *y += 1e-4 * (bilinear(&self.v) + ny);
            *squared_radius += 1e-5;
        }
    }
}

/// A sample on the way down the middle of the plume, noise included; those of a tick share a search.
fn concentration_underway(duck: Duck) -> f64 {
    let mut scenario = duck.scenario();
    scenario.vehicle.start = scenario.environment.sources[0].at;
    scenario.vehicle.depth = 4.0;
    scenario.instruments.fluorometer.rate = FAST_HZ;
    let heading = scenario.environment.flow.mean.toward();
    let mut begin = Simulator::new(&scenario, 1).unwrap();
    begin.take_over().unwrap();
    begin.command(&Command::new(heading, 2.0, Vertical::Altitude(2.0))).unwrap();
    let [tick] = cost([&mut || {
        let (mut simulator, mut snapshot) = (begin.clone(), Snapshot::default());
        stretches(80, 50, || simulator.sense(&mut snapshot).unwrap())
    }]);
    tick / (FAST_HZ * TICK_S)
}

/// One look at a place anywhere in the plume, in an index made before.
fn concentration_anywhere(simulator: &Simulator) -> f64 {
    let places: Vec<_> = simulator.filaments().map(|(place, _)| place).step_by(PLACES_EVERY).collect();
    let survey = simulator.survey();
    let [all] = cost([&mut || {
        stretches(20, 5, || places.iter().for_each(|&place| _ = black_box(survey.concentration(black_box(place), 2.0))))
    }]);
    all / places.len() as f64
}

/// The index itself.
fn index(simulator: &Simulator) -> f64 {
    let [all] = cost([&mut || stretches(20, 5, || _ = black_box(simulator.survey()))]);
    all / simulator.filaments().count() as f64
}
