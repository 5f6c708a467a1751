//! The regulators on both plants: which signs stabilise them, how they settle, and how the law of the leg keeps to it.

use super::*;
use crate::craft::hull::trial::{Trial, response};
use crate::craft::hull::{
    Controls, Crossflow, Fossen, Gains, Load, Misjudged, Motion, Plant, Prestero, Settings, StartPose, State,
    Submersible, attitude_of,
};
use crate::craft::setup::{HullSetup, SubmersibleHull};
use albacore_geometry::math::{PI, degrees, radians};
use albacore_geometry::{Point, Vector};
use albacore_vehicle::{Command, TICK_S, Vertical};
use nalgebra::{SMatrix, SVector, Vector4, Vector6};

const LQR: Controller = Controller::Lqr2016(LqrGains {
    elevator: [0.5110, -4.1867, -6.6161, 3.1698, 0.0035],
    rudder: [0.3137, -0.9071, -1.1180],
    depth_error_max: 0.6,
});

fn fossen() -> HullSetup {
    HullSetup::Fossen(SubmersibleHull { controller: LQR, ..SubmersibleHull::fossen() })
}

fn prestero() -> HullSetup {
    HullSetup::Prestero(SubmersibleHull { controller: LQR, ..SubmersibleHull::prestero() }, Crossflow::Corrected)
}

/// A hull by its name.
type Named = (&'static str, fn() -> HullSetup);
const HULLS: [Named; 2] = [("fossen", fossen), ("prestero", prestero)];

/// The closed loops about a straight and level run: heave, rate of pitch, pitch, depth, integral of depth and the elevator; and sway,
/// rate of yaw, yaw and the rudder. `sign` is that of the law, 1 as printed; fins follow with the lag `lag`, s.
struct Loops<P> {
    plant: P,
    speed: f64,
    rpm: f64,
    sign: f64,
    lag: f64,
}

impl<P: Plant> Loops<P> {
    fn rates_in_the_vertical(&self, x: Vector6<f64>) -> Vector6<f64> {
        let [w, q, theta, z, integral, fin] = x.into();
        let mut law = Lqr { integral, ..Lqr::new(LqrGains::default(), PI, 0.0) };
        law.head_for(Goal { depth: 5.0, ..Goal::default() });
        let sensed = Sensed { pitch: theta, pitch_rate: q, heave: w, depth: 5.0 + z, ..self.level() };
        let asked = -self.sign * law.elevator(&sensed);
        let controls = Controls { stern: fin, rpm: self.rpm, ..Controls::default() };
        let attitude = attitude_of(&Vector6::new(0.0, 0.0, 0.0, 0.0, theta, 0.0));
        let velocity = Vector6::new(self.speed, 0.0, w, 0.0, q, 0.0);
        let a = self.plant.acceleration(&attitude, &velocity, &controls, Vector::ZERO, Load::default());
        let [_, _, down] = attitude.to_ned([self.speed, 0.0, w]);
        Vector6::new(a[2], a[4], q, down, z, (asked - fin) / self.lag)
    }

    fn rates_in_the_horizontal(&self, x: Vector4<f64>) -> Vector4<f64> {
        let [v, r, psi, fin] = x.into();
        let mut law = Lqr::new(LqrGains::default(), PI, 0.0);
        law.head_for(Goal::default());
        let sensed = Sensed { heading: Heading::from_radians(psi), yaw_rate: r, sway: v, ..self.level() };
        let asked = self.sign * law.rudder(&sensed);
        let controls = Controls { rudder: fin, rpm: self.rpm, ..Controls::default() };
        let velocity = Vector6::new(self.speed, v, 0.0, 0.0, 0.0, r);
        let level = attitude_of(&Vector6::zeros());
        let a = self.plant.acceleration(&level, &velocity, &controls, Vector::ZERO, Load::default());
        Vector4::new(a[1], a[5], r, (asked - fin) / self.lag)
    }

    fn level(&self) -> Sensed {
        let ahead = State { velocity: Vector6::new(self.speed, 0.0, 0.0, 0.0, 0.0, 0.0), ..State::default() };
        Sensed::of(&ahead, Vector::ZERO, 50.0)
    }

    /// The greatest real part of an eigenvalue of both, 1/s.
    fn fastest(&self) -> [f64; 2] {
        let vertical = slopes(|x| self.rates_in_the_vertical(x)).complex_eigenvalues().map(|value| value.re);
        let horizontal = slopes(|x| self.rates_in_the_horizontal(x)).complex_eigenvalues().map(|value| value.re);
        [vertical.max(), horizontal.max()]
    }
}

/// The slopes of a field of rates about 0.
fn slopes<const N: usize>(rates: impl Fn(SVector<f64, N>) -> SVector<f64, N>) -> SMatrix<f64, N, N> {
    let step = 1e-6;
    let mut slopes = SMatrix::<f64, N, N>::zeros();
    for j in 0..N {
        let mut x = SVector::<f64, N>::zeros();
        x[j] = step;
        slopes.set_column(j, &((rates(x) - rates(-x)) / (2.0 * step)));
    }
    slopes
}

/// Turns that hold a speed on the plant after Prestero, 1/min.
fn prestero_rpm(speed: f64) -> f64 {
    1500.0 * speed / 1.543
}

#[test]
fn as_printed_the_laws_stabilise_both_plants_and_turned_round_they_do_not() {
    for speed in [1.0, 1.54, 2.0, 2.5] {
        for crossflow in [Crossflow::Corrected, Crossflow::AsPrinted] {
            for lag in [0.001, 0.1] {
                let loops = |sign: f64| {
                    let plant = Prestero::new(crossflow).neutral();
                    Loops { plant, speed, rpm: prestero_rpm(speed), sign, lag }.fastest()
                };
                let ([vertical, horizontal], wrong) = (loops(1.0), loops(-1.0));
                println!(
                    "prestero {crossflow:?} {speed} m/s, lag {lag} s: {vertical:.4} and {horizontal:.4}, else {wrong:.1?}"
                );
                // At 1 m/s a lag of the fins lets the nose waver.
                let most = if speed > 1.0 {
                    -0.1
                } else if lag < 0.1 {
                    -0.01
                } else {
                    0.1
                };
                assert!((-0.002..0.0).contains(&vertical) && horizontal < most, "{speed}: {vertical}, {horizontal}");
                assert!(wrong.iter().all(|fastest| *fastest > 1.0), "{speed}: {wrong:?}");
            }
        }
    }
    for (speed, rpm) in [(1.506, 900.0), (2.009, 1200.0), (2.554, 1525.0)] {
        for lag in [0.001, 0.1] {
            let loops = |sign: f64| Loops { plant: Fossen::new(), speed, rpm, sign, lag }.fastest();
            let ([vertical, horizontal], wrong) = (loops(1.0), loops(-1.0));
            println!("fossen {speed} m/s, lag {lag} s: {vertical:.5} and {horizontal:.5}, else {wrong:.2?}");
            // A sway that the published plant hardly damps is left.
            assert!((-0.002..0.0).contains(&vertical) && horizontal < 0.0, "{speed}: {vertical}, {horizontal}");
            assert!(wrong.iter().all(|fastest| *fastest > 0.1), "{speed}: {wrong:?}");
        }
    }
}

#[test]
fn a_positive_angle_gives_a_positive_moment() {
    let ahead = Vector6::new(1.5, 0.0, 0.0, 0.0, 0.0, 0.0);
    let level = attitude_of(&Vector6::zeros());
    // A hull that is too deep, and points to port of where it is to go.
    let state = State { pose: Vector6::new(0.0, 0.0, 6.0, 0.0, 0.0, -0.2), velocity: ahead };
    let mut law = Lqr::new(LqrGains::default(), 1.0, 0.01);
    law.head_for(Goal { depth: 5.0, ..Goal::default() });
    let sensed = Sensed::of(&state, Vector::ZERO, 50.0);
    let (elevator, rudder) = (law.elevator(&sensed), law.rudder(&sensed));
    assert!((elevator - 3.1698 * 0.6).abs() < 1e-3 && (rudder - 1.118 * 0.2).abs() < 1e-12, "{elevator}, {rudder}");
    let turned = |plant: &dyn Plant| {
        let controls = Controls { rudder: 0.1 * rudder, stern: -0.1 * elevator, rpm: 0.0 };
        let with = plant.acceleration(&level, &ahead, &controls, Vector::ZERO, Load::default());
        with - plant.acceleration(&level, &ahead, &Controls::default(), Vector::ZERO, Load::default())
    };
    for a in [turned(&Fossen::new()), turned(&Prestero::default())] {
        assert!(a[4] > 0.0 && a[5] > 0.0, "nose up and to starboard: {a}");
    }
}

/// A step of depth by 10 m: when it is within 20 cm for good, s, how far it went beyond, m, and its least pitch, degrees.
fn depth_step(hull: HullSetup, speed: f64) -> [f64; 3] {
    let mut trial = Trial::new(hull);
    trial.go(0.0, speed, Vertical::Depth(5.0), 240.0);
    let way = trial.go(0.0, speed, Vertical::Depth(15.0), 120.0);
    let (settled, over) = response(way.iter().map(|m| m.depth), 15.0, 0.2);
    [settled, over, degrees(way.iter().map(|m| m.pitch).fold(0.0, f64::min))]
}

#[test]
fn ten_metres_deeper_settle_within_the_bands_of_others() {
    for (name, hull) in HULLS {
        for fin_max in [15.0, 60.0].map(radians) {
            for clip in [0.5, 0.6, 0.73] {
                let controller = Controller::Lqr2016(LqrGains { depth_error_max: clip, ..LqrGains::default() });
                let set = |hull: SubmersibleHull| SubmersibleHull { fin_max, controller, ..hull };
                let hull = match hull() {
                    HullSetup::Prestero(hull, crossflow) => HullSetup::Prestero(set(hull), crossflow),
                    HullSetup::Fossen(hull) => HullSetup::Fossen(set(hull)),
                    other @ HullSetup::Kinematic(_) => other,
                };
                let [settled, over, least] = depth_step(hull, 1.54);
                println!(
                    "{name}, fins {:.0} deg, clip {clip} m: to 0.2 m in {settled:.1} s, {over:.2} m over, pitch {least:.1} deg",
                    degrees(fin_max)
                );
                assert!((20.0..36.0).contains(&settled) && over < 0.3, "{name}: {settled} s, {over} m over");
                assert!((-27.0..-12.0).contains(&least), "{name}: {least} deg");
            }
        }
    }
}

/// The clip is what keeps the light hull from standing on its nose.
#[test]
fn without_a_clip_ten_metres_are_a_dive_on_the_nose() {
    let controller = Controller::Lqr2016(LqrGains { depth_error_max: 1e3, ..LqrGains::default() });
    let hull = SubmersibleHull { controller, fin_max: PI / 3.0, ..SubmersibleHull::prestero() };
    let [_, over, least] = depth_step(HullSetup::Prestero(hull, Crossflow::Corrected), 1.54);
    println!("without a clip: {over:.1} m over, pitch {least:.0} deg");
    assert!(least < -60.0, "{least} deg");
}

#[test]
fn a_quarter_turn_settles() {
    for ((name, hull), within) in HULLS.into_iter().zip([27.0, 13.0]) {
        for speed in [1.54, 2.0, 2.5] {
            let mut trial = Trial::new(hull());
            trial.go(0.0, speed, Vertical::Depth(5.0), 120.0);
            let way = trial.go(90.0, speed, Vertical::Depth(5.0), 60.0);
            let east = Heading::from_degrees(90.0);
            let (settled, over) = response(way.iter().map(|m| degrees(m.heading - east)), 0.0, 2.0);
            let astray = way.iter().map(|m| (m.depth - 5.0).abs()).fold(0.0, f64::max);
            println!(
                "{name} at {speed} m/s: 90 deg to 2 deg in {settled:.1} s, {over:.2} deg over; depth off by {astray:.2} m"
            );
            assert!(settled < within && over < 8.0 && astray < 0.2, "{name}: {settled} s, {over} deg, {astray} m");
        }
    }
}

#[test]
fn two_metres_above_a_slope_are_kept() {
    for (name, hull) in HULLS {
        let mut trial = Trial::new(hull());
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
fn it_dives_from_the_surface_and_comes_back_to_it() {
    for (name, hull) in HULLS {
        for speed in [1.2, 1.54, 2.0] {
            let mut trial = Trial::at(hull(), 0.0);
            let dived = trial.go(0.0, speed, Vertical::Depth(3.0), 120.0);
            let deepest = dived.iter().map(|m| m.depth).fold(0.0, f64::max);
            let end = dived[dived.len() - 1].depth;
            let back = *trial.go(0.0, speed, Vertical::Depth(0.0), 120.0).last().unwrap();
            println!("{name} at {speed} m/s: {deepest:.2} m at most, then {end:.2} m; back at {:.2} m", back.depth);
            assert!(deepest < 4.5 && (end - 3.0).abs() < 0.2, "{name} at {speed} m/s: {deepest} m, {end} m");
            assert!(back.depth < 0.3 && back.pitch.abs() < radians(15.0), "{name}: {back:?}");
        }
    }
}

/// Below 1.1 m/s the fins do not hold the hull after Prestero down at its nose: it makes steerage way as with the cascade.
#[test]
fn a_hull_that_goes_slowly_sinks_by_little() {
    for (name, hull) in HULLS {
        for slow in [0.0, 0.3, 0.6, 0.8, 1.0, 1.2] {
            let mut trial = Trial::at(hull(), 10.0);
            trial.go(0.0, 1.54, Vertical::Depth(10.0), 90.0);
            let way = trial.go(0.0, slow, Vertical::Depth(10.0), 600.0);
            let deepest = way.iter().map(|m| m.depth).fold(0.0, f64::max);
            let highest = way.iter().map(|m| m.depth).fold(f64::INFINITY, f64::min);
            println!("{name} at {slow} m/s told 10 m: {highest:.2} to {deepest:.2} m");
            assert!(deepest < 12.0, "{name} at {slow} m/s: {deepest} m");
        }
    }
}

#[test]
fn without_a_command_its_fins_are_neutral_and_it_comes_to_rest() {
    for (name, hull) in HULLS {
        let mut trial = Trial::cruising(hull());
        let end = *trial.obey(None, 120.0).last().unwrap();
        let now = trial.hull.actuators_mut().unwrap().now;
        assert!(end.speed.abs() < 0.2, "{name}: {end:?}");
        assert!(now.rudder.abs() + now.stern.abs() + now.rpm.abs() < 1e-6, "{name}: {now:?}");
        let again = *trial.go(90.0, 1.54, Vertical::Depth(5.0), 240.0).last().unwrap();
        assert!((again.depth - 5.0).abs() < 0.2 && (again.heading.degrees() - 90.0).abs() < 2.0, "{name}: {again:?}");
    }
}

#[test]
fn on_the_bottom_it_lies_still_and_comes_free() {
    for (name, hull) in HULLS {
        let mut trial = Trial::cruising(hull());
        trial.bottom = |_| 20.0;
        let aground = *trial.go(0.0, 1.54, Vertical::Depth(30.0), 120.0).last().unwrap();
        assert!(aground.aground && aground.depth <= 20.0, "{name}: {aground:?}");
        let free = *trial.go(0.0, 1.54, Vertical::Depth(5.0), 120.0).last().unwrap();
        assert!(!free.aground && (free.depth - 5.0).abs() < 0.2, "{name}: {free:?}");
    }
}

/// (19) has no integral of the heading: what rolls the hull and what it is trimmed with leave an offset. Slower than 1.2 m/s the nose of the
/// hull after Prestero wavers by a degree.
#[test]
fn a_heading_is_held_to_a_degree() {
    for (name, hull) in HULLS {
        for speed in [1.0, 1.1, 1.2, 1.54, 2.0, 2.5] {
            let mut trial = Trial::new(hull());
            trial.go(0.0, speed, Vertical::Depth(5.0), 240.0);
            let way = trial.go(0.0, speed, Vertical::Depth(5.0), 60.0);
            let off = |m: &Motion| degrees(m.heading - Heading::NORTH);
            let (least, most) = way.iter().map(off).fold((9.0, -9.0), |(a, b), off| (off.min(a), off.max(b)));
            println!("{name} at {speed} m/s: nose off by {least:.2} to {most:.2} deg");
            let wide = if speed < 1.2 { 3.0 } else { 1.0 };
            assert!(least > -wide && most < wide, "{name} at {speed} m/s: {least} to {most} deg");
        }
    }
}

/// What a navigation filter would put in the place of the truth: the hull goes by it.
#[test]
fn it_goes_by_what_it_is_told() {
    for controller in [Controller::Cascade, LQR] {
        let hull = SubmersibleHull { controller, ..SubmersibleHull::prestero() };
        let plant = Prestero::default();
        let body = plant.body();
        let settings =
            Settings { steps: 10, speed_max: 2.5, limits: hull.limits(), gains: Gains::PRESTERO, controller };
        let mut hull = Submersible::new(plant, &body, &settings, &StartPose { depth: 5.0, ..StartPose::default() });
        let command = Command::new(Heading::NORTH, 1.54, Vertical::Depth(5.0));
        hull.misjudged = Misjudged { heading: 0.1, depth: -1.0, ..Misjudged::default() };
        (0..1200).for_each(|_| hull.step(Some(&command), Vector::ZERO, |_| 50.0, None).unwrap());
        let Motion { heading, depth, .. } = *hull.motion();
        assert!(
            (heading - Heading::NORTH + 0.1).abs() < 0.02 && (depth - 6.0).abs() < 0.2,
            "{controller:?}: {heading:?}, {depth} m"
        );
    }
}

/// The law of the leg, (19) to (21): what is commanded to go from a point to another, 1.118 is |rk3|.
struct Leg {
    start: Point,
    end: Point,
    sign: f64,
    integral: f64,
}

impl Leg {
    fn heading(&mut self, position: Point) -> Heading {
        let off = (position - self.start).right_of((self.end - self.start).toward());
        self.integral += off * TICK_S;
        let aside = self.sign * (0.01 * off + 0.00001 * self.integral);
        (self.end - position).toward() + -aside / 1.118
    }
}

/// How far a leg of 2400 m north is left to either side in a current, m: at most, and on its last quarter; and how near it comes to its end.
fn swim_leg(hull: HullSetup, sign: f64) -> [f64; 3] {
    let mut trial = Trial::new(hull);
    trial.flow = Vector::new(0.2, 0.4);
    let mut leg = Leg { start: Point::ORIGIN, end: Point::new(2400.0, 0.0), sign, integral: 0.0 };
    let mut way: Vec<Motion> = vec![];
    let mut nearest = f64::INFINITY;
    while way.len() < 24_000 && nearest > 1.0 {
        let heading = leg.heading(trial.hull.motion().position);
        way.extend(trial.go(heading.degrees(), 1.54, Vertical::Depth(5.0), TICK_S));
        nearest = trial.hull.motion().position.distance(leg.end).min(nearest);
    }
    let off = |from: f64| {
        let after = way.iter().filter(|m| m.position.north >= from);
        after.map(|m| m.position.east.abs()).fold(0.0, f64::max)
    };
    [off(f64::NEG_INFINITY), off(1800.0), nearest]
}

#[test]
fn a_leg_in_a_current_from_the_side_is_kept_to_within_26_m() {
    for (name, hull) in HULLS {
        let [most, late, nearest] = swim_leg(hull(), 1.0);
        let [without, ..] = swim_leg(hull(), 0.0);
        let [wrong, ..] = swim_leg(hull(), -1.0);
        println!(
            "{name}: off by {most:.1} m, {late:.1} m on the last quarter, {nearest:.2} m at its end; without {without:.0} m, turned round {wrong:.0} m"
        );
        assert!(most < 26.0 && late < 11.0 && nearest <= 1.0, "{name}: {most} m, {late} m, {nearest} m");
        assert!(without > 150.0 && wrong > 300.0, "{name}: {without} m, {wrong} m");
    }
}

/// In water that rises at 0.3 m/s a depth that is kept is one that sinks at 0.3 m/s in the water's own frame; and so the other way.
#[test]
fn a_current_from_below_leaves_a_small_offset_of_depth() {
    for (name, hull) in HULLS {
        for down in [0.3, -0.3] {
            let mut trial = Trial::at(hull(), 250.0);
            trial.bottom = |_| 1000.0;
            let mut depth = 250.0;
            trial.go(0.0, 1.54, Vertical::Depth(depth), 120.0);
            let mut last = Motion::default();
            let mut offsets = vec![];
            for tick in 0..6000 {
                depth -= down * TICK_S;
                last = trial.go(0.0, 1.54, Vertical::Depth(depth), TICK_S)[0];
                if tick % 1200 == 1199 {
                    offsets.push(last.depth - depth);
                }
            }
            println!(
                "{name}, {down} m/s down: off by {offsets:.2?} m every 2 min, pitch {:.1} deg",
                degrees(last.pitch)
            );
            assert!(offsets.iter().all(|off: &f64| (0.15..0.46).contains(&off.abs())), "{name}: {offsets:?}");
        }
    }
}
