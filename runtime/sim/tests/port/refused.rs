//! What no simulator can be made of.

use super::{scenario, shoal};
use crate::world;
use albacore_geometry::{Point, Vector};
use albacore_sim::hull::Crossflow;
use albacore_sim::{
    Bottom, Environment, Grid, Ground, HullSetup, Pit, Plane, Scenario, Source, SubmersibleHull, Times,
};
use albacore_vehicle::Limits;
use std::sync::Arc;

#[test]
fn impossible_plumes_are_refused() {
    let fault = |change: &dyn Fn(&mut Scenario)| {
        let mut scenario = world::layered();
        change(&mut scenario);
        scenario.validate().unwrap_err().to_string()
    };
    for (fault, expected) in [
        (fault(&|s| s.environment.flow.mean = Vector::ZERO), "needs a `flow` that carries it"),
        (fault(&|s| s.environment.region = None), "`plume` needs a `region`"),
        (fault(&|s| s.environment.plume = None), "a `source` needs a `plume`"),
        (fault(&|s| s.environment.sources[0].at = Point::new(5000.0, 0.0)), "outside the `region`"),
        (fault(&|s| s.environment.sources[0].height = 4.0), "and the `layer` of the plume 3.5 m high"),
        (fault(&|s| s.environment.sources[0].rate = 1000.0), "filaments are alive at a time"),
        (fault(&|s| s.environment.plume.as_mut().unwrap().layer = None), "`vertical` of `plume` needs a `layer`"),
        (fault(&|s| s.environment.plume.as_mut().unwrap().step = 0.25), "`step` of `plume` is 0.25 s"),
        (
            fault(&|s| s.environment.flow.meander.as_mut().unwrap().viscosity = 1.0),
            "too little for cells of 20 m in a flow of up to",
        ),
        (fault(&|s| s.environment.flow.meander.as_mut().unwrap().cell = Some(1.0)), "make more than 40000 nodes"),
    ] {
        assert!(fault.contains(expected), "{fault}");
    }
    assert_eq!(world::layered().validate(), Ok(()));
    assert_eq!(world::flat().validate(), Ok(()));
}

/// The clauses and parameters that a scenario's objections name.
fn objected(scenario: &Scenario) -> Vec<(&'static str, usize, Option<&'static str>)> {
    let faults = scenario.validate().err().map_or_else(Vec::new, |error| error.faults);
    faults.iter().map(|fault| (fault.clause, fault.nth, fault.param)).collect()
}

#[test]
fn chemical_where_there_is_no_water_is_refused() {
    let changed = |change: &dyn Fn(&mut Scenario)| {
        let mut scenario = world::layered();
        change(&mut scenario);
        objected(&scenario)
    };
    let layer = |s: &mut Scenario, high| s.environment.plume.as_mut().unwrap().layer = Some(high);
    assert_eq!(changed(&|s| layer(s, 1e9)), [("plume", 0, Some("layer"))]);
    assert_eq!(changed(&|s| s.environment.sources[0].height = 500.0), [("source", 0, Some("height"))]);
    let twin = |s: &mut Scenario, aside: f64| {
        let to = s.environment.sources[0].at + Vector::new(aside, 0.0);
        s.environment.sources.extend([Source { to: Some(to), ..s.environment.sources[0].clone() }]);
    };
    assert_eq!(changed(&|s| twin(s, 1.0)), [("leak", 0, Some("name"))]);
    assert_eq!(changed(&|s| twin(s, 0.0)), [("leak", 0, Some("name")), ("leak", 0, Some("to"))]);
    // What has always released may have ceased before the run; what begins later may not.
    assert_eq!(changed(&|s| s.environment.sources[0].when.ends = Some(-1000.0)), []);
    let backward = |s: &mut Scenario| {
        s.environment.sources[0].when = Times { begins: Some(10.0), ends: Some(5.0), ..Times::default() }
    };
    assert_eq!(changed(&backward), [("source", 0, Some("ends"))]);
    let ashore = Scenario { limits: Some(Limits { altitude: 100.0, ..Limits::default() }), ..scenario() };
    assert_eq!(objected(&ashore), [("limits", 0, Some("altitude"))]);
    let mut stepped = world::layered();
    stepped.environment.plume.as_mut().unwrap().step = 1000.0;
    assert_eq!(objected(&stepped), [("plume", 0, Some("step"))], "and nothing of a step that no script can say");
}

#[test]
fn impossible_hulls_and_limits_are_refused() {
    let mut bad = scenario();
    let hull = SubmersibleHull { speed_max: 2.6, step: 0.03, ..SubmersibleHull::fossen() };
    bad.vehicle.hull = HullSetup::Fossen(hull);
    let said = bad.validate().unwrap_err();
    assert_eq!(said.faults.len(), 2, "{said}");
    for expected in ["its `turns_max` of 25.42 Hz gives 2.55 m/s at most", "`step` of `fossen` is 30 ms"] {
        assert!(said.to_string().contains(expected), "{said}");
    }
    for hull in [
        HullSetup::Fossen(SubmersibleHull::fossen()),
        HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::AsPrinted),
    ] {
        bad.vehicle.hull = hull;
        assert_eq!(bad.validate(), Ok(()));
    }
}

#[test]
fn shafts_and_starts_below_the_bottom_are_refused() {
    let mut bad = scenario();
    bad.environment.bottom.pits = vec![Pit { depth: 100.0, radius: 1.0, ..Pit::default() }];
    bad.environment.bottom.ground = Ground::Plane(Plane { from: 10.0, to: 4.0, ..Plane::default() });
    bad.vehicle.depth = 5.0;
    let said = bad.validate().unwrap_err();
    assert!(!said.to_string().contains("below the bottom"), "it starts where the water is 7 m: {said}");
    bad.vehicle.start_spread = 600.0;
    let said = bad.validate().unwrap_err();
    assert_eq!(said.faults.len(), 2, "{said}");
    assert!(said.to_string().contains("is a shaft") && said.to_string().contains("below the bottom"), "{said}");
}

#[test]
fn grids_that_cannot_be_and_starts_on_land_are_refused() {
    let on = |grid: Grid| Bottom { ground: Ground::Grid(Arc::new(grid)), pits: Vec::new() };
    let said = |bad: &Scenario| bad.validate().unwrap_err().to_string();
    let mut bad =
        Scenario { environment: Environment { bottom: on(shoal()), ..Environment::default() }, ..Scenario::default() };
    assert_eq!(bad.validate(), Ok(()));
    bad.vehicle.start = Point::new(60.0, 0.0);
    assert!(said(&bad).contains("on land"), "{}", said(&bad));
    bad.vehicle.start = Point::ORIGIN;
    bad.vehicle.start_spread = 10.0;
    assert!(said(&bad).contains("on land"), "a cell of land has a part in the depths about it: {}", said(&bad));
    bad.vehicle.start_spread = 0.0;
    bad.vehicle.depth = 6.0;
    assert!(said(&bad).contains("below the bottom"));
    for wrong in [
        Grid { depths: vec![20.0; 3], ..shoal() },
        Grid { rows: 1, columns: 4, ..shoal() },
        Grid { depths: vec![20.0, f64::NAN, 1.0, 1.0], ..shoal() },
        Grid { north_east: Point::new(-100.0, 100.0), ..shoal() },
    ] {
        let bad = Scenario {
            environment: Environment { bottom: on(wrong), ..Environment::default() },
            ..Scenario::default()
        };
        assert!(bad.validate().unwrap_err().faults.iter().any(|f| f.clause == "bottom_grid"), "{}", said(&bad));
    }
}
