//! The plume as a 2 m/s probe meets it: how often above the threshold, and for how long not.

use crate::library::scenario;
use albacore_sim::probe::{Band, Probe};
use albacore_sim::{Scenario, ScenarioError, Simulator};

const THRESHOLD: f64 = 0.04;

/// Edges of the bands, m from the source.
const BANDS: [f64; 5] = [20.0, 100.0, 300.0, 600.0, 950.0];

/// Straight up the centreline of the plume at time 0, over some seeds.
fn probe(scenario: &Scenario, seeds: u64) -> Result<Vec<Band>, ScenarioError> {
    let mut probe = Probe::new(&BANDS);
    for seed in 0..seeds {
        let simulator = Simulator::new(scenario, seed)?;
        let places = simulator.filaments().map(|(place, _)| place);
        let survey = simulator.survey();
        let reads = |p| survey.concentration(p, 2.0) > THRESHOLD;
        probe.fly(scenario.environment.sources[0].at, scenario.environment.flow.mean.toward(), places, reads);
    }
    Ok(probe.bands)
}

/// `duck_2003_flat` against what an independent simulator measured with the same numbers (notes/plume-and-cpt.md, 1.3).
#[test]
fn the_flat_plume_reads_what_it_promises() {
    let met = probe(&scenario("duck_2003_flat").unwrap(), 12).unwrap();
    for (met, (on, gap)) in met.iter().zip([(0.68, 0.6), (0.66, 0.8), (0.67, 1.0), (0.65, 1.1)]) {
        assert!((met.on_fraction() - on).abs() < 0.07, "on {}, not {on}", met.on_fraction());
        assert!((met.gap(0.5) / gap - 1.0).abs() < 0.3, "median gap {} s, not {gap} s", met.gap(0.5));
    }
}

/// Two other plumes of the same table: fewer and larger filaments, and filaments as thin as they come.
#[test]
fn other_plumes_read_what_they_should() {
    for (name, expected) in [("farrell_scaled", [0.71, 0.79, 0.88, 0.88]), ("sparse", [0.25, 0.25, 0.25, 0.22])] {
        for (met, on) in probe(&scenario(name).unwrap(), 12).unwrap().iter().zip(expected) {
            assert!((met.on_fraction() - on).abs() < 0.09, "on {}, not {on}", met.on_fraction());
        }
    }
}
