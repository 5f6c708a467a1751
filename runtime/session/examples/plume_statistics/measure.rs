//! What is measured of the plumes: by probes, by the filaments' own scatter, by integrals, and of the flow.

use albacore_formats::recording::{RecordedKernel, Recording};
use albacore_geometry::math::PI;
use albacore_geometry::{Area, Heading, Point, Vector};
use albacore_sim::probe::{Band, Probe};
use albacore_sim::{Environment, Flow, Plume, RecordedPlume, Scenario, ScenarioError, Simulator, Source, Still};
use albacore_vehicle::{Snapshot, TICK_S, Vehicle, VehicleError};
use std::error::Error;
use std::sync::Arc;

/// Edges of the bands, m from the source.
pub const BANDS: [f64; 5] = [20.0, 100.0, 300.0, 600.0, 950.0];
/// A reading above this is a detection, ratio of full scale.
pub const THRESHOLD: f64 = 0.04;
/// Height of the probe above the bottom, m.
const ALTITUDE: f64 = 2.0;

/// A simulator after so many seconds.
pub fn after(scenario: &Scenario, seed: u64, seconds: f64) -> Result<Simulator, Box<dyn Error>> {
    let mut simulator = Simulator::new(scenario, seed)?;
    run(&mut simulator, seconds)?;
    Ok(simulator)
}

/// Lets seconds go by.
pub fn run(simulator: &mut Simulator, seconds: f64) -> Result<(), VehicleError> {
    let mut snapshot = Snapshot::default();
    (0..(seconds / TICK_S).round() as u64).try_for_each(|_| simulator.sense(&mut snapshot))
}

/// A probe up the centreline of a plume as it is now.
pub fn fly(probe: &mut Probe, scenario: &Scenario, simulator: &Simulator) {
    let places = simulator.filaments().map(|(place, _)| place);
    let survey = simulator.survey();
    let reads = |p| survey.concentration(p, ALTITUDE) > THRESHOLD;
    probe.fly(scenario.environment.sources[0].at, scenario.environment.flow.mean.toward(), places, reads);
}

/// What probes meet at the start of runs with some seeds.
pub fn bands(scenario: &Scenario, seeds: u64) -> Result<Vec<Band>, ScenarioError> {
    let mut probe = Probe::new(&BANDS);
    for seed in 0..seeds {
        fly(&mut probe, scenario, &Simulator::new(scenario, seed)?);
    }
    Ok(probe.bands)
}

/// What probes meet in a recorded plume: one way every 100 s.
pub fn recorded_bands(recording: &Arc<Recording>, kernel: RecordedKernel) -> Vec<Band> {
    let plume = RecordedPlume { kernel, ..RecordedPlume::new(Arc::clone(recording)) };
    let mut probe = Probe::new(&BANDS);
    for frame in 0..=(recording.duration() / 100.0) as u32 {
        let time = 100.0 * f64::from(frame);
        let places = recording.alive(time).map(|(place, _)| place);
        let still = Still::new(&plume, time);
        probe.fly(recording.source(), Heading::from_degrees(180.0), places, |p| still.reading(p) > THRESHOLD);
    }
    probe.bands
}

/// What probes meet once nothing of the spin-up is left: from one transit on, every 500 s.
pub fn bands_under_way(scenario: &Scenario, seeds: u64) -> Result<Vec<Band>, Box<dyn Error>> {
    let mut probe = Probe::new(&BANDS);
    for seed in 0..seeds {
        let mut simulator = after(scenario, seed, 9000.0)?;
        for _ in 0..4 {
            run(&mut simulator, 500.0)?;
            fly(&mut probe, scenario, &simulator);
        }
    }
    Ok(probe.bands)
}

/// A class of ages, s, and the mean over its filaments.
#[derive(Clone, Copy, Default)]
pub struct Aged {
    /// Their mean age, s.
    pub age: f64,
    /// Their variances about where the flow alone would have carried them, along it and across, m2.
    pub along: f64,
    pub across: f64,
    /// Their mean squared radius, m2.
    pub squared_radius: f64,
    count: f64,
}

/// The scatter of filaments in a uniform flow. There the age is known from the squared radius, which grows evenly.
pub fn scatter(seeds: u64, classes: usize) -> Result<Vec<Aged>, ScenarioError> {
    let scenario = uniform(Plume::default(), 2.0);
    let (source, plume) = (scenario.environment.sources[0].at, Plume::default());
    let oldest = 1900.0 / 0.2;
    let mut aged = vec![Aged::default(); classes];
    for seed in 0..seeds {
        for (place, radius) in Simulator::new(&scenario, seed)?.filaments() {
            let squared = radius * radius;
            let age = (squared - plume.initial_radius * plume.initial_radius) / plume.growth;
            let Some(class) = aged.get_mut((age / oldest * classes as f64) as usize) else { continue };
            let off = place - (source + Vector::new(0.2 * age, 0.0));
            class.age += age;
            class.along += off.north * off.north;
            class.across += off.east * off.east;
            class.squared_radius += squared;
            class.count += 1.0;
        }
    }
    for class in &mut aged {
        let n = class.count.max(1.0);
        for sum in [&mut class.age, &mut class.along, &mut class.across, &mut class.squared_radius] {
            *sum /= n;
        }
    }
    Ok(aged)
}

/// The amounts of single filaments of several ages, integrals of what they read, over the law's: age (s) and ratio.
pub fn amounts(layer: Option<f64>) -> Result<Vec<(f64, f64)>, ScenarioError> {
    let plume = Plume { layer, vertical: layer.map_or(0.0, |_| 1e-3), ..Plume::default() };
    let scenario = uniform(plume.clone(), 2e-3);
    let source = &scenario.environment.sources[0];
    let simulator = Simulator::new(&scenario, 5)?;
    let survey = simulator.survey();
    let reference = plume.initial_radius * plume.initial_radius + plume.growth * source.reference_age;
    // 2 pi r2 peak (ref / r2); in a layer (2 pi r2)^1.5 peak (ref / r2)^1.5, of which the images keep all within it.
    let flat = 2.0 * PI * source.peak * reference;
    let law = if layer.is_some() { flat * (2.0 * PI * reference).sqrt() } else { flat };
    let mut amounts = Vec::new();
    for (place, radius) in simulator.filaments() {
        // Alone within its reach and its neighbours'.
        let alone = simulator.filaments().filter(|(other, r)| other.distance(place) < 6.0 * (r + radius)).count() == 1;
        if !alone {
            continue;
        }
        let (step, heights) = (0.25 * radius, layer.map_or(1, |layer| (layer / (0.25 * radius)).ceil() as i32));
        let thick = layer.map_or(1.0, |layer| layer / f64::from(heights));
        let mut sum = 0.0;
        for (i, j) in (-24..=24).flat_map(|i| (-24..=24).map(move |j| (i, j))) {
            let p = place + step * Vector::new(f64::from(i), f64::from(j));
            for k in 0..heights {
                sum += survey.concentration(p, (f64::from(k) + 0.5) * thick);
            }
        }
        let age = (radius * radius - plume.initial_radius * plume.initial_radius) / plume.growth;
        amounts.push((age, sum * step * step * thick / law));
    }
    Ok(amounts)
}

/// A uniform flow of 0.2 m/s with one source.
fn uniform(plume: Plume, rate: f64) -> Scenario {
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, Heading::NORTH, 2000.0, 600.0)),
            flow: Flow { mean: Vector::new(0.2, 0.0), ..Flow::default() },
            plume: Some(plume),
            sources: vec![Source { at: Point::new(-900.0, 0.0), rate, ..Source::default() }],
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// Standard deviations of the flow, m/s.
#[derive(Default)]
pub struct Meanders {
    /// At the corners of the field, along the mean flow and across it.
    pub corners: (f64, f64),
    /// In the middles of its edges.
    pub edges: (f64, f64),
    /// Within the region.
    pub inside: (f64, f64),
    /// Of the direction there, degrees.
    pub direction: f64,
}

/// The deviations of a scenario's flow: over seeds, and every 800 s of each.
pub fn meanders(scenario: &Scenario, seeds: u64) -> Result<Meanders, Box<dyn Error>> {
    let ahead = scenario.environment.flow.mean.toward();
    let across = ahead + PI / 2.0;
    let place = |x: f64, y: f64| Point::ORIGIN + x * ahead.unit() + y * across.unit();
    // The box of the field: the region, and 60 m more on every side.
    let (x, y) = (547.0 + 60.0, 183.5 + 60.0);
    let corners = [place(-x, -y), place(-x, y), place(x, -y), place(x, y)];
    let edges = [place(-x, 0.0), place(x, 0.0), place(0.0, -y), place(0.0, y)];
    let inside: Vec<Point> =
        (0..60).map(|i| place(-500.0 + 111.0 * f64::from(i % 10), -150.0 + 60.0 * f64::from(i / 10))).collect();
    let quiet = Scenario {
        environment: Environment { plume: None, sources: Vec::new(), ..scenario.environment.clone() },
        ..scenario.clone()
    };
    let (mut sums, mut turned, mut n) = ([(0.0, 0.0); 3], 0.0, 0.0);
    for seed in 0..seeds {
        let mut simulator = Simulator::new(&quiet, seed)?;
        for _ in 0..10 {
            run(&mut simulator, 800.0)?;
            n += 1.0;
            for (places, sum) in [&corners[..], &edges, &inside].into_iter().zip(&mut sums) {
                for p in places {
                    let off = simulator.flow(*p, ALTITUDE) - scenario.environment.flow.mean;
                    let (u, v) = (off.along(ahead), off.right_of(ahead));
                    sum.0 += u * u / places.len() as f64;
                    sum.1 += v * v / places.len() as f64;
                }
            }
            turned += inside
                .iter()
                .map(|p| {
                    let off = simulator.flow(*p, ALTITUDE).toward() - ahead;
                    off * off / inside.len() as f64
                })
                .sum::<f64>();
        }
    }
    let [corners, edges, inside] = sums.map(|(u, v)| ((u / n).sqrt(), (v / n).sqrt()));
    Ok(Meanders { corners, edges, inside, direction: (turned / n).sqrt() * 180.0 / PI })
}

/// The direction of the flow in the middle of the region over time: degrees off the mean, every 60 s.
pub fn directions(scenario: &Scenario, seed: u64, seconds: f64) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let quiet = Scenario {
        environment: Environment { plume: None, sources: Vec::new(), ..scenario.environment.clone() },
        ..scenario.clone()
    };
    let mut simulator = Simulator::new(&quiet, seed)?;
    let mut found = Vec::new();
    while simulator.time_s() < seconds {
        run(&mut simulator, 60.0)?;
        let off = simulator.flow(Point::ORIGIN, ALTITUDE).toward() - scenario.environment.flow.mean.toward();
        found.push((simulator.time_s() / 3600.0, off * 180.0 / PI));
    }
    Ok(found)
}

/// The same in a record, off its own mean.
pub fn recorded_directions(recording: &Recording) -> Vec<(f64, f64)> {
    let mean = recording.mean_flow().toward();
    let minutes = (recording.duration() / 60.0) as u32;
    let at = |minute: u32| {
        let off = recording.flow(Point::ORIGIN, 60.0 * f64::from(minute)).toward() - mean;
        (f64::from(minute) / 60.0, off * 180.0 / PI)
    };
    (0..=minutes).map(at).collect()
}
