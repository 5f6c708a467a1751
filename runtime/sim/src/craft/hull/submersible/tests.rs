//! How both hulls answer their autopilots, and what becomes of them when something fails.

use crate::craft::hull::trial::{Trial, response};
use crate::craft::hull::{Controller, Crossflow, LqrGains, Motion, Stuck};
use crate::craft::setup::{HullSetup, SubmersibleHull};
use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::{Command, TICK_S, Vertical};

/// The hull after Fossen.
fn fossen() -> HullSetup {
    HullSetup::Fossen(SubmersibleHull::fossen())
}

/// The hull after Prestero.
fn prestero() -> HullSetup {
    HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected)
}

/// A hull by its name.
type Named = (&'static str, fn() -> HullSetup);
const HULLS: [Named; 2] = [("fossen", fossen), ("prestero", prestero)];

#[test]
fn a_quarter_turn_settles_without_much_overshoot() {
    for ((name, hull), within) in HULLS.into_iter().zip([20.0, 10.0]) {
        let way = Trial::cruising(hull()).go(90.0, 2.0, Vertical::Depth(5.0), 60.0);
        let (settled, over) = response(way.iter().map(|m| m.heading.degrees()), 90.0, 2.0);
        let astray = way.iter().map(|m| (m.depth - 5.0).abs()).fold(0.0, f64::max);
        println!("{name}: 90 deg to 2 deg in {settled:.1} s, {over:.2} deg over; depth off by {astray:.2} m");
        assert!(settled < within && over < 9.0 && astray < 0.5, "{name}: {settled} s, {over} deg, {astray} m");
    }
}

#[test]
fn a_turn_to_port_is_as_good() {
    for (name, hull) in HULLS {
        let end = *Trial::cruising(hull()).go(270.0, 2.0, Vertical::Depth(5.0), 60.0).last().unwrap();
        assert!((end.heading.degrees() - 270.0).abs() < 1.0, "{name}: {end:?}");
    }
}

#[test]
fn ten_metres_deeper_settles_without_much_overshoot() {
    for ((name, hull), within) in HULLS.into_iter().zip([20.0, 20.0]) {
        let way = Trial::cruising(hull()).go(0.0, 2.0, Vertical::Depth(15.0), 120.0);
        let (settled, over) = response(way.iter().map(|m| m.depth), 15.0, 0.3);
        println!("{name}: 10 m deeper to 0.3 m in {settled:.1} s, {over:.2} m over");
        assert!(settled < within && over < 1.0, "{name}: {settled} s, {over} m");
    }
}

#[test]
fn two_metres_above_a_slope_are_kept() {
    for (name, hull) in HULLS {
        let mut trial = Trial::new(hull());
        // 3 m in 100 m, downward and, coming back, upward.
        trial.bottom = |p| 20.0 + 0.03 * p.north;
        trial.go(0.0, 2.0, Vertical::Altitude(2.0), 120.0);
        for heading in [0.0, 180.0] {
            trial.go(heading, 2.0, Vertical::Altitude(2.0), 60.0);
            let way = trial.go(heading, 2.0, Vertical::Altitude(2.0), 60.0);
            let off = way.iter().map(|m| ((trial.bottom)(m.position) - m.depth - 2.0).abs()).fold(0.0, f64::max);
            println!("{name}, {heading}: {off:.3} m off");
            assert!(off < 0.1, "{name}, {heading}: {off} m");
        }
    }
}

#[test]
fn speed_is_reached_and_kept_in_a_turn() {
    for ((name, hull), within) in HULLS.into_iter().zip([5.0, 10.0]) {
        let mut trial = Trial::cruising(hull());
        let way = trial.go(0.0, 1.5, Vertical::Depth(5.0), 60.0);
        let (settled, _) = response(way.iter().map(|m| m.speed), 1.5, 0.05);
        println!("{name}: from 2 to 1.5 m/s in {settled:.1} s");
        assert!(settled < within, "{name}: {settled} s");
        let end = way.last().unwrap();
        assert!((end.speed - 1.5).abs() < 0.01, "{name}: {}", end.speed);
        let circling: Vec<Motion> = (0..600)
            .map(|_| {
                let ahead = trial.hull.motion().heading.degrees() + 10.0;
                trial.go(ahead, 1.5, Vertical::Depth(5.0), TICK_S)[0]
            })
            .collect();
        let slowest = circling[300..].iter().map(|m| m.speed).fold(f64::INFINITY, f64::min);
        assert!(slowest > 1.4, "{name}: {slowest}");
    }
}

#[test]
fn a_much_lower_speed_is_hardly_undershot() {
    for (name, hull) in HULLS {
        for wanted in [1.2, 0.8] {
            let mut trial = Trial::new(hull());
            trial.go(0.0, 2.4, Vertical::Depth(5.0), 60.0);
            let way = trial.go(0.0, wanted, Vertical::Depth(5.0), 90.0);
            let every_5_s: Vec<String> = way.iter().skip(49).step_by(50).map(|m| format!("{:.2}", m.speed)).collect();
            let slowest = way.iter().map(|m| m.speed).fold(f64::INFINITY, f64::min);
            println!("{name}: from 2.4 to {wanted} m/s: {}; {slowest:.2} at least", every_5_s.join(" "));
            // Below 1.2 m/s the buoyant hull is up against more than its speed: it stands on its nose to stay down, and goes
            // faster to lift it.
            let (under, off) = if name == "prestero" && wanted < 1.2 { (0.35, 0.4) } else { (0.1, 0.02) };
            assert!(slowest > wanted - under, "{name}: {slowest} m/s");
            let end = way.last().unwrap().speed;
            assert!((end - wanted).abs() < off, "{name}: {end} m/s in the end");
        }
    }
}

#[test]
fn it_dives_from_the_surface_and_comes_back_to_it() {
    for (name, hull) in HULLS {
        let mut trial = Trial::at(hull(), 0.0);
        let dived = *trial.go(0.0, 2.0, Vertical::Depth(3.0), 90.0).last().unwrap();
        assert!((dived.depth - 3.0).abs() < 0.1, "{name}: {dived:?}");
        let back = *trial.go(0.0, 2.0, Vertical::Depth(0.0), 90.0).last().unwrap();
        assert!(back.depth < 0.2 && back.pitch.abs() < radians(15.0), "{name}: {back:?}");
    }
}

#[test]
fn the_buoyant_hull_needs_some_speed_to_stay_down() {
    let mut trial = Trial::cruising(prestero());
    for (speed, stays) in [(1.2, true), (1.0, false)] {
        let way = trial.go(0.0, speed, Vertical::Depth(5.0), 300.0);
        let off = way[1500..].iter().map(|m| (m.depth - 5.0).abs()).fold(0.0, f64::max);
        assert_eq!(off < 0.3, stays, "{speed} m/s: {off} m");
    }
}

#[test]
fn a_current_is_no_matter_to_its_way_through_the_water() {
    for (name, hull) in HULLS {
        let mut trial = Trial::new(hull());
        trial.flow = Vector::new(0.0, 0.4);
        let way = trial.go(0.0, 2.0, Vertical::Depth(5.0), 120.0);
        let end = way.last().unwrap();
        assert!((end.heading - Heading::NORTH).abs() < radians(0.5), "{name}: {}", end.heading.degrees());
        assert!((end.speed - 2.0).abs() < 0.01, "{name}: {}", end.speed);
        assert!((end.ground_velocity.east - 0.4).abs() < 0.05, "{name}: {:?}", end.ground_velocity);
    }
}

#[test]
fn without_a_command_it_comes_to_rest() {
    for (name, hull) in HULLS {
        let mut trial = Trial::cruising(hull());
        let end = *trial.obey(None, 120.0).last().unwrap();
        assert!(end.speed.abs() < 0.2, "{name}: {end:?}");
        let now = trial.hull.actuators_mut().unwrap().now;
        assert!(now.rudder.abs() + now.stern.abs() + now.rpm.abs() < 1e-6, "{name}: {now:?}");
    }
}

#[test]
fn a_stuck_rudder_turns_it_in_circles_whatever_it_is_told() {
    for (name, hull) in HULLS {
        let mut trial = Trial::cruising(hull());
        trial.hull.stick_rudder(Some(0.5));
        let way = trial.go(0.0, 2.0, Vertical::Depth(5.0), 60.0);
        let turned: f64 = way.windows(2).map(|m| m[1].heading - m[0].heading).sum();
        assert!(degrees(turned) > 180.0, "{name}: {} deg to starboard", degrees(turned));
        trial.hull.stick_rudder(None);
        let end = *trial.go(0.0, 2.0, Vertical::Depth(5.0), 60.0).last().unwrap();
        assert!((end.heading - Heading::NORTH).abs() < radians(2.0), "{name}: free again, {}", end.heading.degrees());
    }
}

#[test]
fn a_stuck_propeller_and_stern_plane_stay_where_they_are() {
    let mut trial = Trial::cruising(fossen());
    let actuators = trial.hull.actuators_mut().unwrap();
    actuators.stuck = Stuck { rpm: Some(actuators.now.rpm), stern: Some(radians(5.0)), ..Stuck::default() };
    let end = *trial.go(0.0, 0.5, Vertical::Depth(5.0), 20.0).last().unwrap();
    assert!(end.speed > 1.8 && end.depth > 10.0, "neither slower nor held: {end:?}");
}

#[test]
fn a_flooded_hull_sinks_to_the_bottom_where_it_lies() {
    for (name, hull) in HULLS {
        let mut trial = Trial::new(hull());
        trial.hull.flood(3.0);
        let way = trial.obey(None, 300.0);
        let end = way.last().unwrap();
        assert_eq!(end.depth, 50.0, "{name}");
        assert!(way.iter().all(|m| m.depth <= 50.0), "{name}");
        assert!(end.ground_velocity.length() < 0.05, "{name}: {end:?}");
    }
}

/// A hull that no scenario can have, for its bounds forbid it.
#[test]
fn equations_that_run_away_are_an_error_and_no_number() {
    let wild = |hull: SubmersibleHull| SubmersibleHull { turns_max: 3000.0, speed_max: 80.0, fin_max: 0.78, ..hull };
    for hull in [
        HullSetup::Fossen(wild(SubmersibleHull::fossen())),
        HullSetup::Prestero(wild(SubmersibleHull::prestero()), Crossflow::Corrected),
    ] {
        let mut trial = Trial::new(hull);
        let command = |heading| Command::new(Heading::from_degrees(heading), 80.0, Vertical::Depth(9.0));
        let ran_away = (0..600_u32).find_map(|tick| {
            let told = command(f64::from(tick) * 7.0);
            trial.hull.step(u64::from(tick), Some(&told), Vector::ZERO, trial.bottom, None).err()
        });
        assert!(ran_away.is_some_and(|why| why.to_string().contains("take a shorter `step`")));
        let Motion { position, depth, speed, .. } = *trial.hull.motion();
        assert!([position.north, position.east, depth, speed].iter().all(|n| n.abs() < 1e4));
    }
}

/// At the corners of what a scenario can ask for.
#[test]
fn within_its_bounds_no_hull_runs_away() {
    for controller in [Controller::Cascade, Controller::Lqr2016(LqrGains::default())] {
        for step in [0.001, 0.01, 0.05] {
            for fin_max in [radians(1.0), radians(45.0)] {
                let (turns_max, speed_max) = (*SubmersibleHull::TURNS_MAX.end(), *SubmersibleHull::SPEED_MAX.end());
                let corner = SubmersibleHull { step, fin_max, turns_max, speed_max, controller };
                swims_to_and_fro(HullSetup::Fossen(corner.clone()));
                swims_to_and_fro(HullSetup::Prestero(corner.clone(), Crossflow::Corrected));
                swims_to_and_fro(HullSetup::Prestero(corner, Crossflow::AsPrinted));
            }
        }
    }
}

/// Up and down, and round, as fast as it can.
fn swims_to_and_fro(hull: HullSetup) {
    let mut trial = Trial::new(hull.clone());
    for leg in 0..20_u32 {
        let depth = if leg % 2 == 0 { 45.0 } else { 0.0 };
        for m in trial.go(f64::from(leg) * 100.0, 20.0, Vertical::Depth(depth), 10.0) {
            assert!(m.speed.abs() < 10.0 && m.ground_velocity.length() < 10.0, "{hull:?}: {m:?}");
        }
    }
}

#[test]
fn the_state_of_a_hull_is_small() {
    assert!(size_of::<super::Submersible<crate::craft::hull::Fossen>>() < 1024);
    assert!(size_of::<super::Submersible<crate::craft::hull::Prestero>>() < 1024);
}

#[test]
fn nothing_that_is_asked_makes_a_number_none() {
    for (name, hull) in HULLS {
        for (speed, vertical) in [
            (0.0, Vertical::Depth(40.0)),
            (-5.0, Vertical::Depth(-40.0)),
            (1e9, Vertical::Altitude(1e9)),
            (0.3, Vertical::Altitude(-1e9)),
        ] {
            let mut trial = Trial::at(hull(), 0.0);
            trial.flow = Vector::new(-3.0, 2.0);
            for heading in [10.0, 170.0, 300.0] {
                for m in trial.go(heading, speed, vertical, 60.0) {
                    let numbers = [m.position.north, m.position.east, m.depth, m.pitch, m.roll, m.speed];
                    assert!(numbers.iter().all(|n| n.is_finite()), "{name}, {speed}, {vertical:?}: {m:?}");
                    assert!((0.0..=50.0).contains(&m.depth));
                }
            }
        }
    }
}

/// Below steerage way the fins of the light hull hold neither its nose nor its depth: it swam down nose first, by 17 m and more.
#[test]
fn a_hull_that_goes_slowly_sinks_by_little() {
    let depth = Vertical::Depth(10.0);
    for (name, hull) in HULLS {
        for slow in [0.0, 0.3, 0.6, 0.8, 1.0, 1.2] {
            for (fast_for, slow_for) in
                [(3.0, 3.0), (5.0, 6.0), (8.0, 8.0), (5.0, 20.0), (30.0, 30.0), (60.0, 120.0), (1.0, 600.0)]
            {
                let mut trial = Trial::at(hull(), 10.0);
                trial.go(0.0, 1.5, depth, 90.0);
                let rounds = (1200.0 / (fast_for + slow_for)) as u32;
                let way: Vec<Motion> = (0..rounds.max(6))
                    .flat_map(|_| [trial.go(0.0, slow, depth, slow_for), trial.go(0.0, 1.5, depth, fast_for)].concat())
                    .collect();
                let deepest = way.iter().map(|m| m.depth).fold(0.0, f64::max);
                assert!(deepest < 11.6, "{name}, {slow} m/s for {slow_for} s after {fast_for} s: {deepest} m");
            }
        }
    }
}

/// At less than 1.3 m/s the light hull stayed at the surface for good, and the other at 0.3 m/s.
#[test]
fn a_hull_that_goes_slowly_leaves_the_surface() {
    for (name, hull) in HULLS {
        for speed in [0.8, 1.0, 1.2, 1.5] {
            for depth in [0.5, 1.0, 3.0, 10.0] {
                let mut trial = Trial::at(hull(), 0.0);
                let way = trial.go(0.0, speed, Vertical::Depth(depth), 600.0);
                let deepest = way.iter().map(|m| m.depth).fold(0.0, f64::max);
                let last = way[way.len() - 1].depth;
                println!("{name} at {speed} m/s to {depth} m: {deepest:.2} m at most, then {last:.2} m");
                assert!(
                    deepest > 0.9 * depth && deepest < depth + 2.5,
                    "{name} at {speed} m/s to {depth} m: {deepest} m"
                );
                assert!((last - depth).abs() < 1.0, "{name} at {speed} m/s to {depth} m: {last} m");
            }
        }
    }
}

/// On the way down an error of depth is none that lasts: what it added to the trim in a long dive led 3 m too deep for a minute.
#[test]
fn a_long_dive_ends_where_a_short_one_does() {
    for (name, hull) in HULLS {
        for speed in [1.2, 1.5, 2.0] {
            let mut trial = Trial::at(hull(), 3.0);
            let deepest =
                trial.go(0.0, speed, Vertical::Depth(40.0), 300.0).iter().map(|m| m.depth).fold(0.0, f64::max);
            println!("a dive to 40 m at {speed} m/s: {name} {:.1} m over", deepest - 40.0);
            assert!(deepest < 41.0, "{name} at {speed} m/s: {deepest} m");
        }
    }
}

/// Who turns, rises, dives, stops and goes on as it comes is less than 3 m below the deepest that was asked for.
#[test]
fn no_hull_sinks_by_3_m_whatever_is_asked_of_it() {
    let mut steps = Steps(1);
    for (name, hull) in HULLS {
        for shallow in [10.0, 9.0, 5.0] {
            for _ in 0..60 {
                let mut trial = Trial::at(hull(), 10.0);
                let legs: Vec<[f64; 4]> = (0..20)
                    .map(|_| {
                        [
                            90.0 * steps.of(4),
                            0.2 * steps.of(11),
                            [10.0, shallow][steps.of(2) as usize],
                            2.0 + steps.of(30),
                        ]
                    })
                    .collect();
                for (leg, [heading, speed, depth, seconds]) in legs.iter().enumerate() {
                    let way = trial.go(*heading, *speed, Vertical::Depth(*depth), *seconds);
                    let deepest = way.iter().map(|m| m.depth).fold(0.0, f64::max);
                    assert!(deepest < 13.0, "{name}: {deepest} m on {:?}", &legs[..=leg]);
                }
            }
        }
    }
}

/// Pseudo-random whole numbers (Knuth's linear congruential generator, TAOCP 3.3.4).
struct Steps(u64);

impl Steps {
    /// One of 0 to `n` - 1.
    fn of(&mut self, n: u64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % n) as f64
    }
}
