//! The plume as a 2 m/s probe meets it: how often above the threshold, and how long not.

use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::{Plume, Scenario, ScenarioError, Simulator, presets};

const THRESHOLD: f64 = 0.04;
/// A 2 m/s probe sampled at 10 Hz.
const SAMPLE_M: f64 = 0.2;
const BIN_M: f64 = 20.0;

/// Distances from the source, m.
const BANDS: [(f64, f64); 4] = [(20.0, 100.0), (100.0, 300.0), (300.0, 600.0), (600.0, 950.0)];

/// What a probe met in each band.
struct Met {
    /// Share of samples above the threshold.
    on: f64,
    /// Median time between detections that are not neighbours, s.
    gap: f64,
}

/// Straight up the centreline of the plume at time 0, over some seeds: the mean of the filaments in bins of 20 m.
fn probe(scenario: &Scenario, seeds: u64) -> Result<[Met; 4], ScenarioError> {
    let source = scenario.sources[0].at;
    let down_flow: Heading = scenario.flow.mean.toward();
    let across = (down_flow + std::f64::consts::FRAC_PI_2).unit();
    let mut samples = [0.0; 4];
    let mut on = [0.0; 4];
    let mut gaps: [Vec<f64>; 4] = Default::default();
    for seed in 0..seeds {
        let simulator = Simulator::new(scenario, seed)?;
        let mut bins = vec![(0.0, 0.0); 60];
        for (place, _) in simulator.filaments() {
            let d: Vector = place - source;
            if let Some((sum, n)) = bins.get_mut((d.along(down_flow).max(0.0) / BIN_M) as usize) {
                *sum += d.right_of(down_flow);
                *n += 1.0;
            }
        }
        let mut last = None;
        for i in (100..4750).rev() {
            let distance = f64::from(i) * SAMPLE_M;
            let Some(band) = BANDS.iter().position(|b| b.0 <= distance && distance < b.1) else { continue };
            let (sum, n) = bins[(distance / BIN_M) as usize];
            let place: Point = source + distance * down_flow.unit() + (sum / n) * across;
            samples[band] += 1.0;
            if simulator.concentration(place, 2.0) > THRESHOLD {
                on[band] += 1.0;
                if let Some(gap) = last.map(|last: i32| last - i).filter(|&gap| gap > 1) {
                    gaps[band].push(f64::from(gap) * 0.1);
                }
                last = Some(i);
            }
        }
    }
    Ok(std::array::from_fn(|band| {
        gaps[band].sort_by(f64::total_cmp);
        Met { on: on[band] / samples[band], gap: gaps[band][gaps[band].len() / 2] }
    }))
}

/// The preset against what an independent simulator measured with the same numbers (notes/plume-and-cpt.md, 1.3).
#[test]
fn the_preset_reads_what_it_promises() {
    let met = probe(&presets::duck_2003_flat(), 12).unwrap();
    for (met, (on, gap)) in met.iter().zip([(0.68, 0.6), (0.66, 0.8), (0.67, 1.0), (0.65, 1.1)]) {
        assert!((met.on - on).abs() < 0.07, "on {}, not {on}", met.on);
        assert!((met.gap / gap - 1.0).abs() < 0.3, "median gap {} s, not {gap} s", met.gap);
    }
}

/// Two other plumes of the same table: fewer and larger filaments, and filaments as thin as they come.
#[test]
fn other_plumes_read_what_they_should() {
    let mut scaled = presets::duck_2003_flat();
    (scaled.sources[0].rate, scaled.sources[0].peak) = (0.114, 0.12);
    scaled.plume = Some(Plume { growth: 0.00137, ..Plume::default() });
    let mut sparse = presets::duck_2003_flat();
    sparse.plume = Some(Plume { growth: 3e-5, initial_radius: 0.1, ..Plume::default() });
    for (scenario, expected) in [(scaled, [0.71, 0.79, 0.88, 0.88]), (sparse, [0.25, 0.25, 0.25, 0.22])] {
        for (met, on) in probe(&scenario, 12).unwrap().iter().zip(expected) {
            assert!((met.on - on).abs() < 0.09, "on {}, not {on}", met.on);
        }
    }
}
