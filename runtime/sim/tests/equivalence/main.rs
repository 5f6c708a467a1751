//! The fast plume is the plume: what a probe meets in it is what it meets in one that takes no short cut.
//!
//! The simulator may use coarse steps, cheap random numbers, an index, and may move filaments late; [`brute`] does none of it.
//! Both are probed at several times of several seeds, and at each range two things are compared by a two-sample
//! Kolmogorov-Smirnov test: the shares of a way above the threshold, and the gaps between detections. The seeds are fixed: it
//! says the same every day. What it would catch is shown by a plume whose diffusivity is doubled, and by one that grows twice as
//! fast.

#![expect(clippy::unwrap_used, reason = "a test whose plume cannot be computed has failed")]

mod brute;

use albacore_geometry::math::TAU;
use albacore_geometry::{Area, Heading, Point};
use albacore_sim::probe::Probe;
use albacore_sim::{Environment, Flow, Meander, Plume, Scenario, Simulator, Source};
use albacore_vehicle::{Snapshot, TICK_S, Vehicle};
use brute::{Brute, Law};
use std::collections::BTreeMap;
use std::thread;

const THRESHOLD: f64 = 0.04;
/// Edges of the bands, m from the source.
const BANDS: [f64; 4] = [20.0, 100.0, 250.0, 400.0];
const SEEDS: u64 = 10;
/// Each seed is probed so often.
const LOOKS: usize = 4;
/// At these times after each other, s: the flow goes 50 m.
const BETWEEN_S: f64 = 400.0;
/// The source is so far inside the box round region and margin, m.
const SOURCE: [f64; 2] = [110.0, 185.0];
/// Seeds of the plain plume begin here, so that it shares no draw with the fast one.
const OTHER_SEEDS: u64 = 1 << 40;

/// What probes met in one band: the share above the threshold of each way, and all gaps (samples).
#[derive(Default)]
struct Met {
    shares: Vec<f64>,
    gaps: Vec<f64>,
}

/// A smaller world than that of Duck, of the same make.
fn scenario(change: impl Fn(&mut Plume)) -> Scenario {
    let mut plume = Plume::default();
    change(&mut plume);
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, Heading::NORTH, 500.0, 250.0)),
            flow: Flow { mean: 0.125 * Heading::NORTH.unit(), meander: Some(Meander::default()), ..Flow::default() },
            plume: Some(plume),
            sources: vec![Source { at: Point::new(SOURCE[0] - 310.0, SOURCE[1] - 185.0), ..Source::default() }],
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// The same in the plain plume's words.
fn law() -> Law {
    let (plume, source, meander) = (Plume::default(), Source::default(), Meander::default());
    let law = Law {
        length: 620.0,
        width: 370.0,
        speed: 0.125,
        meander_sigma: 0.0,
        bandwidth: 0.0,
        damping: 0.0,
        viscosity: 0.0,
        cell: 0.0,
        source: SOURCE,
        rate: source.rate,
        diffusivity: plume.diffusivity,
        initial_radius: plume.initial_radius,
        growth: plume.growth,
        peak: source.peak,
        peak_age: source.reference_age,
    };
    law.with_meander(&meander, TAU / meander.period)
}

/// What is met with all seeds, in their order: they share the processors.
fn of_seeds(met_with: impl Fn(u64) -> Vec<Met> + Sync) -> Vec<Met> {
    let threads = thread::available_parallelism().map_or(1, |n| n.get());
    let share = |first| (first..SEEDS).step_by(threads).map(|seed| (seed, met_with(seed))).collect::<Vec<_>>();
    let by_seed: BTreeMap<u64, Vec<Met>> = thread::scope(|scope| {
        let shares: Vec<_> = (0..threads as u64).map(|first| scope.spawn(move || share(first))).collect();
        shares.into_iter().flat_map(|share| share.join().unwrap()).collect()
    });
    let mut all: Vec<Met> = BANDS.windows(2).map(|_| Met::default()).collect();
    for met in by_seed.into_values() {
        for (all, one) in all.iter_mut().zip(met) {
            all.shares.extend(one.shares);
            all.gaps.extend(one.gaps);
        }
    }
    all
}

fn fast(change: impl Fn(&mut Plume)) -> Vec<Met> {
    let scenario = scenario(change);
    let source = scenario.environment.sources[0].at;
    of_seeds(|seed| {
        let (mut met, mut snapshot) = (Vec::new(), Snapshot::default());
        let mut simulator = Simulator::new(&scenario, seed).unwrap();
        for _ in 0..LOOKS {
            for _ in 0..(BETWEEN_S / TICK_S) as u64 {
                simulator.sense(&mut snapshot).unwrap();
            }
            let places = simulator.filaments().map(|(place, _)| place);
            let survey = simulator.survey();
            look(&mut met, source, places, |p| survey.concentration(p, 2.0));
        }
        met
    })
}

fn plain() -> Vec<Met> {
    let at = |(x, y): (f64, f64)| Point::new(x, y);
    of_seeds(|seed| {
        let mut met = Vec::new();
        let mut brute = Brute::new(law(), OTHER_SEEDS + seed);
        brute.advance(1.15 * (620.0 - SOURCE[0]) / 0.125);
        for _ in 0..LOOKS {
            brute.advance(BETWEEN_S);
            look(&mut met, at((SOURCE[0], SOURCE[1])), brute.filaments().map(at), |p| {
                brute.concentration(p.north, p.east)
            });
        }
        met
    })
}

/// One way of a probe through a plume that flows north.
fn look(met: &mut Vec<Met>, source: Point, places: impl Iterator<Item = Point>, reading: impl Fn(Point) -> f64) {
    let mut probe = Probe::new(&BANDS);
    probe.fly(source, Heading::NORTH, places, |p| reading(p) > THRESHOLD);
    met.resize_with(probe.bands.len(), Met::default);
    for (met, band) in met.iter_mut().zip(&probe.bands) {
        met.shares.push(band.on_fraction());
        met.gaps.extend(band.gaps.iter().map(|&gap| f64::from(gap)));
    }
}

/// The largest distance between two empirical distribution functions, in units of what chance makes of it: above 1.95 once in a
/// thousand pairs of independent samples of the same law.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let sorted = |x: &[f64]| {
        let mut x = x.to_vec();
        x.sort_by(f64::total_cmp);
        x
    };
    let (a, b) = (sorted(a), sorted(b));
    let below = |x: &[f64], value: f64| x.partition_point(|&v| v <= value) as f64 / x.len() as f64;
    let largest = a.iter().chain(&b).map(|&v| (below(&a, v) - below(&b, v)).abs()).fold(0.0, f64::max);
    let (n, m) = (a.len() as f64, b.len() as f64);
    largest * (n * m / (n + m)).sqrt()
}

/// The largest distances over all bands: of the shares, and of the gaps.
fn compared(a: &[Met], b: &[Met]) -> (f64, f64) {
    let largest =
        |of: &dyn Fn(&Met) -> &[f64]| a.iter().zip(b).map(|(a, b)| distance(of(a), of(b))).fold(0.0, f64::max);
    (largest(&|met| &met.shares), largest(&|met| &met.gaps))
}

#[test]
fn the_fast_plume_is_the_plain_one() {
    let plain = plain();
    let (shares, gaps) = compared(&fast(|_| ()), &plain);
    let (wide_shares, wide_gaps) = compared(&fast(|plume| plume.diffusivity *= 2.0), &plain);
    let (thin_shares, _) = compared(&fast(|plume| plume.growth *= 2.0), &plain);
    assert!(shares < 1.95 && gaps < 1.95, "the shares are {shares} apart, the gaps {gaps}");
    // Twice the diffusivity, twice the growth: caught, each by more than chance ever makes.
    assert!(wide_shares > 3.0 && wide_gaps > 3.0, "{wide_shares} {wide_gaps}");
    assert!(thin_shares > 3.0, "{thin_shares}");
}
