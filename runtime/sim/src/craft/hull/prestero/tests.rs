//! What is known of the published plant, and what physics asks of it.

use super::*;
use crate::craft::hull::six_dof::{State, Surroundings, attitude_of, runge_kutta};
use albacore_geometry::math::{asin, degrees, radians};

fn run(plant: &Prestero, start: State, controls: Controls, around: &Surroundings, seconds: f64) -> State {
    let h = 0.01;
    (0..(seconds / h) as u32).fold(start, |state, _| runge_kutta(plant, &state, &[controls; 3], around, h))
}

fn ahead(speed: f64) -> State {
    State { velocity: Vector6::new(speed, 0.0, 0.0, 0.0, 0.0, 0.0), ..State::default() }
}

/// Revolutions that hold 1.54 m/s.
const CRUISE: Controls = Controls { rudder: 0.0, stern: 0.0, rpm: 1500.0 };

/// Rate of yaw, speed and radius of a steady turn: without trim to distract, and held level, as the table's runs were.
fn turn(crossflow: Crossflow, rudder_deg: f64) -> (f64, f64, f64) {
    let controls = Controls { rudder: radians(rudder_deg), ..CRUISE };
    let end = run(&Prestero::new(crossflow).neutral(), ahead(1.54), controls, &Surroundings::default(), 120.0);
    let [u, v, _, _, _, r] = end.velocity.into();
    let speed = (u * u + v * v).sqrt();
    (degrees(r), speed, speed / r)
}

#[test]
fn it_turns_as_tightly_as_others_computed() {
    for (crossflow, rudder_deg, rate, radius) in [
        (Crossflow::Corrected, 5.0, 11.6, 5.5),
        (Crossflow::Corrected, 15.0, 12.8, 4.3),
        (Crossflow::AsPrinted, 5.0, 9.5, 8.4),
        (Crossflow::AsPrinted, 15.0, 12.4, 5.9),
    ] {
        let (r, speed, wide) = turn(crossflow, rudder_deg);
        println!("{crossflow:?} {rudder_deg}: {r:.2} deg/s at {speed:.2} m/s, {wide:.2} m");
        assert!((r - rate).abs() < 0.15 && (wide - radius).abs() < 0.15, "{crossflow:?} {rudder_deg}");
    }
}

#[test]
fn its_buoyancy_asks_for_the_trim_of_others() {
    // Level flight at 1.54 m/s: heave and pitch balance for one angle of pitch and one of the stern plane.
    let plant = Prestero::default();
    let unbalanced = |pitch: f64, stern: f64| {
        let attitude = attitude_of(&Vector6::new(0.0, 0.0, 0.0, 0.0, pitch, 0.0));
        let [u, v, w] = attitude.to_body([1.54, 0.0, 0.0]);
        let controls = Controls { stern, ..CRUISE };
        let a = plant.acceleration(
            &attitude,
            &Vector6::new(u, v, w, 0.0, 0.0, 0.0),
            &controls,
            Vector::ZERO,
            Load::default(),
        );
        (a[2], a[4])
    };
    // Newton's method on two nearly linear equations.
    let (mut pitch, mut stern) = (0.0, 0.0);
    for _ in 0..20 {
        let (z, m) = unbalanced(pitch, stern);
        let step = 1e-6;
        let ((z_p, m_p), (z_s, m_s)) = (unbalanced(pitch + step, stern), unbalanced(pitch, stern + step));
        let (a, b, c, d) = ((z_p - z) / step, (z_s - z) / step, (m_p - m) / step, (m_s - m) / step);
        let determinant = a * d - b * c;
        pitch -= (d * z - b * m) / determinant;
        stern -= (a * m - c * z) / determinant;
    }
    assert!((degrees(pitch) + 2.5).abs() < 0.1, "{}", degrees(pitch));
    assert!((degrees(stern) + 8.7).abs() < 0.1, "{}", degrees(stern));
}

#[test]
fn left_alone_it_does_not_run_straight() {
    // Sway and yaw about a straight run at 1.54 m/s, linearised: one of the two grows, e-fold in a second.
    let plant = Prestero::default().neutral();
    let level = attitude_of(&Vector6::zeros());
    let rates = |v: f64, r: f64| {
        let a = plant.acceleration(
            &level,
            &Vector6::new(1.54, v, 0.0, 0.0, 0.0, r),
            &CRUISE,
            Vector::ZERO,
            Load::default(),
        );
        (a[1], a[5])
    };
    let (step, rest) = (1e-6, rates(0.0, 0.0));
    let slope = |(v, r): (f64, f64)| ((v - rest.0) / step, (r - rest.1) / step);
    let ((a, c), (b, d)) = (slope(rates(step, 0.0)), slope(rates(0.0, step)));
    let half = 0.5 * (a + d);
    let fastest = half + (half * half - (a * d - b * c)).sqrt();
    assert!((fastest - 0.99).abs() < 0.02, "{fastest}");
}

#[test]
fn it_holds_its_speed_at_1500_rpm() {
    let end = run(&Prestero::default().neutral(), ahead(1.0), CRUISE, &Surroundings::default(), 5.0);
    assert!(end.velocity[0] > 1.0);
    let a = Prestero::default().neutral().acceleration(
        &attitude_of(&Vector6::zeros()),
        &ahead(1.543).velocity,
        &CRUISE,
        Vector::ZERO,
        Load::default(),
    );
    assert!(a[0].abs() < 1e-3, "{}", a[0]);
}

#[test]
fn a_uniform_current_carries_it_as_a_whole() {
    let plant = Prestero::default();
    let controls = Controls { rudder: 0.1, stern: -0.1, rpm: 1500.0 };
    let current = Vector::new(0.3, -0.4);
    let water = Surroundings { current, ..Surroundings::default() };
    let mut carried = ahead(1.5);
    carried.velocity[0] += current.north;
    carried.velocity[1] += current.east;
    let still = run(&plant, ahead(1.5), controls, &Surroundings::default(), 60.0);
    let carried = run(&plant, carried, controls, &water, 60.0);
    let drift = Vector6::new(60.0 * current.north, 60.0 * current.east, 0.0, 0.0, 0.0, 0.0);
    let apart = carried.pose - still.pose - drift;
    assert!(apart.amax() < 1e-5, "{apart}");
}

#[test]
fn port_and_starboard_are_mirror_images_to_the_bit() {
    let mirror = |s: State| {
        let ([x, y, z, roll, pitch, yaw], [u, v, w, p, q, r]) = (s.pose.into(), s.velocity.into());
        State { pose: Vector6::new(x, -y, z, -roll, pitch, -yaw), velocity: Vector6::new(u, -v, w, -p, q, -r) }
    };
    let start = State {
        pose: Vector6::new(0.0, 0.0, 5.0, 0.2, -0.1, 0.0),
        velocity: Vector6::new(1.5, 0.2, 0.1, 0.1, -0.1, 0.2),
    };
    let fins = |rudder: f64| Controls { rudder, stern: 0.05, rpm: 0.0 };
    let still = Surroundings::default();
    let one = run(&Prestero::default(), start, fins(0.1), &still, 20.0);
    assert_eq!(mirror(one), run(&Prestero::default(), mirror(start), fins(-0.1), &still, 20.0));
}

#[test]
fn it_rights_itself_and_floats_up() {
    let heeled = State { pose: Vector6::new(0.0, 0.0, 50.0, 0.3, 0.3, 0.0), ..State::default() };
    let controls = Controls::default();
    let soon = run(&Prestero::default(), heeled, controls, &Surroundings::default(), 0.01);
    assert!(soon.velocity[3] < 0.0 && soon.velocity[4] < 0.0);
    let late = run(&Prestero::default(), heeled, controls, &Surroundings::default(), 60.0);
    // 7 N lift it at the speed at which its drag is as much: sqrt(7 / 131) = 0.23 m/s, some less as it lies on the slant.
    assert!(late.pose[2] < 45.0 && asin(late.velocity[2]).abs() < 0.5, "{late:?}");
}

/// Motion and height of the centre of gravity, of the hull that neither rises nor sinks, J.
fn energy(state: &State) -> f64 {
    let [u, v, w, p, q, r] = state.velocity.into();
    let moving = (MASS - X_UDOT) * u * u
        + (MASS - Y_VDOT) * v * v
        + (MASS - Z_WDOT) * w * w
        + (INERTIA[0] - K_PDOT) * p * p
        + (INERTIA[1] - M_QDOT) * q * q
        + (INERTIA[2] - N_RDOT) * r * r
        + 2.0 * MASS * Z_G * (u * q - v * p)
        - 2.0 * (Y_RDOT * v * r + Z_QDOT * w * q);
    let attitude = attitude_of(&state.pose);
    0.5 * moving + Z_G * WEIGHT * (1.0 - attitude.cos_pitch * attitude.cos_roll)
}

#[test]
fn energy_is_only_ever_lost_without_propeller_and_current() {
    // Fitted coefficients owe nobody that: but it is unstable by what its way ahead gives, not out of nothing.
    let plant = Prestero::default().neutral();
    let heeled = Vector6::new(0.0, 0.0, 50.0, 0.4, -0.3, 1.0);
    for start in [
        ahead(1.5),
        State { velocity: Vector6::new(1.5, 0.01, -0.02, 0.03, 0.02, -0.04), ..State::default() },
        State { velocity: Vector6::new(0.3, 0.8, 0.4, 0.1, 0.1, 0.5), ..State::default() },
        State { pose: heeled, velocity: Vector6::new(1.5, 0.3, -0.2, 0.3, 0.2, -0.4) },
    ] {
        let (mut state, first) = (start, energy(&start));
        let mut last = first;
        for _ in 0..6000 {
            state = runge_kutta(&plant, &state, &[Controls::default(); 3], &Surroundings::default(), 0.01);
            let now = energy(&state);
            assert!(now <= last + 1e-12, "{now} after {last}");
            last = now;
        }
        assert!(last < 0.05 * first, "{last} of {first}");
    }
}
