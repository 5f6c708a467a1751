//! How each hull meets the bottom, and comes free of it: through the port alone.

#![expect(clippy::unwrap_used, reason = "a simulator that cannot go on has failed its test")]

use albacore_geometry::{Heading, Point};
use albacore_sim::hull::Crossflow;
use albacore_sim::{Bottom, Environment, Grid, Ground, HullSetup, Scenario, Simulator, SubmersibleHull, VehicleSetup};
use albacore_vehicle::{Command, Snapshot, Truth, Vehicle, Vertical};
use std::sync::Arc;

fn hulls() -> [(&'static str, HullSetup); 3] {
    [
        ("kinematic", HullSetup::default()),
        ("fossen", HullSetup::Fossen(SubmersibleHull::fossen())),
        ("prestero", HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected)),
    ]
}

/// Depths that change northward alone, a metre from one to the next, the middle one at the origin.
fn northward(depth_at: impl Fn(f64) -> f64) -> Bottom {
    let metres = -200..=200;
    let depths: Vec<f64> = metres.clone().flat_map(|north| [depth_at(f64::from(north)); 2]).collect();
    let corner = Point::new(200.0, 200.0);
    let south_west = Point::new(-corner.north, -corner.east);
    let grid = Grid { south_west, north_east: corner, rows: metres.count() as u32, columns: 2, depths };
    Bottom { ground: Ground::Grid(Arc::new(grid)), pits: Vec::new() }
}

/// A hull under way, and what was told of it.
struct Trial {
    simulator: Simulator,
    told: Vec<String>,
}

impl Trial {
    fn new(hull: &HullSetup, bottom: &Bottom, start: Point, depth: f64) -> Self {
        let vehicle = VehicleSetup { hull: hull.clone(), start, depth, ..VehicleSetup::default() };
        let mut simulator = Simulator::new(
            &Scenario {
                environment: Environment { bottom: bottom.clone(), ..Environment::default() },
                vehicle,
                ..Scenario::default()
            },
            1,
        )
        .unwrap();
        simulator.take_over().unwrap();
        Trial { simulator, told: Vec::new() }
    }

    /// What is so after some seconds of a command at 2 m/s, and how often it grounded and came free in them.
    fn go(&mut self, heading_deg: f64, vertical: Vertical, seconds: u32) -> (Truth, [usize; 2]) {
        let heading = Heading::from_degrees(heading_deg);
        self.simulator.command(&Command::new(heading, 2.0, vertical)).unwrap();
        let mut snapshot = Snapshot::default();
        self.told.clear();
        for _ in 0..seconds * 10 {
            self.simulator.sense(&mut snapshot).unwrap();
            self.told.extend(self.simulator.notices());
            let truth = self.simulator.truth();
            assert!(truth.altitude >= -1e-9 || truth.depth < 0.3, "never in the ground: {truth:?}");
        }
        let count = |what: &str| self.told.iter().filter(|notice| notice.starts_with(what)).count();
        (self.simulator.truth(), [count("grounded"), count("came free")])
    }
}

#[test]
fn land_stops_it() {
    for land_m in [50.0, 150.0] {
        let island = northward(|north| if (-25.0..land_m).contains(&north) { -5.0 } else { 10.0 });
        for (name, hull) in hulls() {
            let mut trial = Trial::new(&hull, &island, Point::new(-90.0, 0.0), 0.0);
            let (end, told) = trial.go(0.0, Vertical::Depth(0.0), 300);
            assert!((-30.0..-24.0).contains(&end.position.north), "{name}: {end:?}");
            assert_eq!((end.speed_over_ground, told), (0.0, [1, 0]), "{name}");
            let (end, told) = trial.go(180.0, Vertical::Depth(0.0), 60);
            assert!(end.position.north < -60.0 && told == [0, 1], "{name}: {told:?}, {end:?}");
        }
    }
}

fn cliff() -> Bottom {
    northward(|north| if north < 0.0 { 30.0 } else { 2.0 })
}

#[test]
fn a_cliff_stops_it_and_it_comes_free_upward_and_away() {
    for (name, hull) in hulls() {
        for (heading, depth, seconds) in [(180.0, 20.0, 120), (120.0, 20.0, 60), (0.0, 1.0, 240)] {
            let mut trial = Trial::new(&hull, &cliff(), Point::new(-80.0, 0.0), 20.0);
            let (stopped, told) = trial.go(0.0, Vertical::Depth(20.0), 240);
            assert!((-1.3..0.0).contains(&stopped.position.north), "{name}: {stopped:?}");
            assert!((stopped.depth - 20.0).abs() < 0.6, "{name}: {stopped:?}");
            assert_eq!((stopped.speed_over_ground, told), (0.0, [1, 0]), "{name}");
            let (end, told) = trial.go(heading, Vertical::Depth(depth), seconds);
            assert_eq!(told, [0, 1], "{name}, {heading}: {end:?}");
            assert!((end.depth - depth).abs() < 0.6, "{name}, {heading}: {end:?}");
            assert!(end.position.distance(stopped.position) > 40.0, "{name}, {heading}: {end:?}");
        }
    }
}

#[test]
fn on_a_level_bottom_it_lies_still_and_rises_when_it_is_told_to() {
    for (name, hull) in hulls() {
        let mut trial = Trial::new(&hull, &Bottom::flat(10.0), Point::ORIGIN, 5.0);
        let (_, told) = trial.go(0.0, Vertical::Depth(15.0), 60);
        assert_eq!(told, [1, 0], "{name}");
        let lain = trial.simulator.truth();
        let (still, told) = trial.go(30.0, Vertical::Depth(15.0), 900);
        assert_eq!((still.position, still.speed_over_ground, told), (lain.position, 0.0, [0, 0]), "{name}");
        assert!((still.depth - 10.0).abs() < 0.2 && still.pitch.abs() < 1e-9, "{name}: {still:?}");
        let (free, told) = trial.go(30.0, Vertical::Depth(3.0), 120);
        assert_eq!(told, [0, 1], "{name}: {free:?}");
        assert!((free.depth - 3.0).abs() < 0.3 && free.speed_over_ground > 1.9, "{name}: {free:?}");
    }
}

#[test]
fn a_slope_that_rises_ahead_stops_it_and_it_comes_free_upward_and_away() {
    // A metre in ten, from 20 m of water at 100 m south of the origin to the shore at 100 m north of it.
    let beach = northward(|north| 10.0 - 0.1 * north);
    for (name, hull) in hulls() {
        for (heading, depth) in [(180.0, 7.0), (0.0, 4.0)] {
            let mut trial = Trial::new(&hull, &beach, Point::new(-60.0, 0.0), 7.0);
            let (stopped, told) = trial.go(0.0, Vertical::Depth(7.0), 120);
            assert!((stopped.position.north - 30.0).abs() < 4.0, "{name}: {stopped:?}");
            assert_eq!((stopped.speed_over_ground, told), (0.0, [1, 0]), "{name}");
            let (end, told) = trial.go(heading, Vertical::Depth(depth), 25);
            assert!(told[1] >= 1 && end.position.distance(stopped.position) > 5.0, "{name}: {told:?}, {end:?}");
        }
        let mut trial = Trial::new(&hull, &beach, Point::new(-60.0, 0.0), 7.0);
        let (end, told) = trial.go(0.0, Vertical::Depth(7.0), 900);
        assert_eq!(told, [1, 0], "{name}: {end:?}");
    }
}

#[test]
fn over_a_step_it_keeps_its_altitude_again() {
    for (name, hull) in hulls() {
        for (height, altitude) in [(1.0, 0.8), (6.0, 2.0), (8.0, 1.0)] {
            let step = northward(|north| if north < 0.0 { 10.0 } else { 10.0 - height });
            let mut trial = Trial::new(&hull, &step, Point::new(-80.0, 0.0), 5.0);
            let (end, told) = trial.go(0.0, Vertical::Altitude(altitude), 150);
            assert!(end.position.north > 20.0 && (end.altitude - altitude).abs() < 0.3, "{name}, {height} m: {end:?}");
            assert!(told[0] == told[1] && told[0] <= 3, "{name}, {height} m: {:?}", trial.told);
        }
    }
}
