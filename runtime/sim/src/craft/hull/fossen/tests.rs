//! The plant's numbers, and what physics asks of it whatever its numbers are.

use super::*;
use crate::craft::hull::six_dof::{State, Surroundings, attitude_of, runge_kutta};
use albacore_geometry::math::{degrees, radians};

const NEUTRAL: [Controls; 3] = [Controls { rudder: 0.0, stern: 0.0, rpm: 0.0 }; 3];

/// The states after each of so many steps of 10 ms with actuators neutral.
fn glide(start: State, around: &Surroundings, steps: u32) -> Vec<State> {
    let plant = Fossen::new();
    let mut state = start;
    (0..steps)
        .map(|_| {
            state = runge_kutta(&plant, &state, &NEUTRAL, around, 0.01);
            state
        })
        .collect()
}

/// A hull that moves and lies as it likes.
fn tumbling() -> State {
    State { pose: Vector6::new(0.0, 0.0, 50.0, 0.4, -0.3, 1.0), velocity: Vector6::new(1.5, 0.3, -0.2, 0.3, 0.2, -0.4) }
}

#[test]
fn the_numbers_are_the_published_ones() {
    let plant = Fossen::new();
    let near = |value: f64, published: f64| assert!((value / published - 1.0).abs() < 1e-6, "{value} {published}");
    near(plant.mass, 31.029_385);
    for (value, published) in plant.added.iter().zip([0.838_909, 29.437_637, 29.437_637, 0.033_605, 3.426_21, 3.426_21])
    {
        assert!((value - published).abs() < 1e-6, "{value} {published}");
    }
    near(plant.moment, 0.620_588);
    for (value, published) in plant.inertia.iter().zip([0.124_428, 4.040_181, 4.027_769]) {
        assert!((value - published).abs() < 1e-6, "{value} {published}");
    }
    for (value, published) in
        plant.damping.iter().zip([1.593_415, 3.023_351, 3.023_351, 0.588_519, 10.787_267, 7.453_980])
    {
        near(*value, published);
    }
    assert!((plant.drag - 0.055_959_6).abs() < 1e-7);
    assert!((plant.lift_slope - 0.265_997).abs() < 1e-6);
}

/// Motion and height of the centre of gravity, J.
fn energy(plant: &Fossen, state: &State) -> f64 {
    let [u, v, w, p, q, r] = state.velocity.into();
    let m = plant.mass;
    let a = &plant.added;
    let moving = (m + a[0]) * u * u
        + (m + a[1]) * v * v
        + (m + a[2]) * w * w
        + (plant.inertia[0] + a[3]) * p * p
        + (plant.inertia[1] + a[4]) * q * q
        + (plant.inertia[2] + a[5]) * r * r
        + 2.0 * plant.moment * (u * q - v * p);
    let attitude = attitude_of(&state.pose);
    0.5 * moving + METACENTRE * plant.weight() * (1.0 - attitude.cos_pitch * attitude.cos_roll)
}

#[test]
fn energy_is_only_ever_lost_without_propeller_and_current() {
    let plant = Fossen::new();
    let way = glide(tumbling(), &Surroundings::default(), 6000);
    let mut last = energy(&plant, &tumbling());
    let first = last;
    for state in &way {
        let now = energy(&plant, state);
        assert!(now <= last + 1e-12, "{now} after {last}");
        last = now;
    }
    assert!(last < 0.05 * first, "{last} of {first}");
}

/// In a perfect fluid, where nothing drags and nothing lifts, no energy is lost either: the inertial forces do no work.
#[test]
fn energy_is_kept_where_nothing_drags() {
    let mut plant = Fossen { damping: Vector6::zeros(), wing: 0.0, ..Fossen::new() };
    plant.cross_flow = CrossFlow::new(0.0, LENGTH, DIAMETER);
    let first = energy(&plant, &tumbling());
    let mut state = tumbling();
    for _ in 0..6000 {
        state = runge_kutta(&plant, &state, &NEUTRAL, &Surroundings::default(), 0.01);
        let off = energy(&plant, &state) / first - 1.0;
        assert!(off.abs() < 1e-6, "{off}");
    }
}

#[test]
fn a_hull_at_rest_stays_at_rest_at_any_depth_and_place() {
    let rest = State { pose: Vector6::new(100.0, -40.0, 30.0, 0.0, 0.0, 2.0), ..State::default() };
    assert_eq!(glide(rest, &Surroundings::default(), 1000).last(), Some(&rest));
}

#[test]
fn where_it_is_changes_nothing() {
    let (here, mut there) = (tumbling(), tumbling());
    there.pose += Vector6::new(1000.0, -500.0, 30.0, 0.0, 0.0, 0.0);
    let ends = [here, there].map(|start| *glide(start, &Surroundings::default(), 3000).last().unwrap());
    assert_eq!(ends[0].velocity, ends[1].velocity);
    let moved: Vec<f64> = (0..3).map(|i| ends[1].pose[i] - ends[0].pose[i]).collect();
    assert!((moved[0] - 1000.0).abs() < 1e-9 && (moved[1] + 500.0).abs() < 1e-9 && (moved[2] - 30.0).abs() < 1e-9);
}

#[test]
fn port_and_starboard_are_mirror_images_to_the_bit() {
    // The propeller's torque is what tells them apart: it is off.
    let mirror = |s: State| {
        let ([x, y, z, roll, pitch, yaw], [u, v, w, p, q, r]) = (s.pose.into(), s.velocity.into());
        State { pose: Vector6::new(x, -y, z, -roll, pitch, -yaw), velocity: Vector6::new(u, -v, w, -p, q, -r) }
    };
    let plant = Fossen::new();
    let fins = |rudder: f64| [Controls { rudder, stern: 0.05, rpm: 0.0 }; 3];
    let (mut one, mut other) = (tumbling(), mirror(tumbling()));
    for _ in 0..3000 {
        one = runge_kutta(&plant, &one, &fins(0.2), &Surroundings::default(), 0.01);
        other = runge_kutta(&plant, &other, &fins(-0.2), &Surroundings::default(), 0.01);
        assert_eq!(mirror(one), other);
    }
}

#[test]
fn it_rights_itself() {
    for (axis, name) in [(3, "roll"), (4, "pitch")] {
        for sign in [1.0, -1.0] {
            let mut heeled = State::default();
            heeled.pose[axis] = sign * 0.3;
            let after = glide(heeled, &Surroundings::default(), 1)[0];
            assert!(after.velocity[axis] * sign < 0.0, "{name}: {}", after.velocity[axis]);
            let late = *glide(heeled, &Surroundings::default(), 6000).last().unwrap();
            assert!(late.pose[axis].abs() < 1e-3, "{name}: {}", late.pose[axis]);
        }
    }
}

#[test]
fn a_current_carries_a_level_hull_as_a_whole() {
    // Level and turning about the vertical alone, the published turning of the current by yaw alone is exact: the hull is
    // accelerated as in still water, seen from a frame that moves with the water. With roll and pitch it is not.
    let plant = Fossen::new();
    let attitude = attitude_of(&Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.7));
    let (current, r) = (Vector::new(0.3, -0.4), 0.2);
    let [ahead, right, _] = attitude.to_body([current.north, current.east, 0.0]);
    let controls = Controls { rudder: 0.1, stern: -0.1, rpm: 1200.0 };
    let still = plant.acceleration(
        &attitude,
        &Vector6::new(1.5, 0.2, 0.1, 0.0, 0.0, r),
        &controls,
        Vector::ZERO,
        Load::default(),
    );
    let over_ground = Vector6::new(1.5 + ahead, 0.2 + right, 0.1, 0.0, 0.0, r);
    let carried = plant.acceleration(&attitude, &over_ground, &controls, current, Load::default());
    let turning = [r * right, -r * ahead, 0.0, 0.0, 0.0, 0.0];
    for i in 0..6 {
        assert!((carried[i] - turning[i] - still[i]).abs() < 1e-13, "{i}: {} {}", carried[i], still[i]);
    }
}

#[test]
fn it_turns_as_widely_as_others_computed() {
    for (rpm, rudder_deg, rate, radius) in
        [(1200.0, 5.0, 2.66, 43.0), (1200.0, 10.0, 4.39, 26.0), (1200.0, 15.0, 5.82, 19.4), (1525.0, 15.0, 7.77, 18.5)]
    {
        let plant = Fossen::new();
        let controls = [Controls { rudder: radians(rudder_deg), stern: 0.0, rpm }; 3];
        let still = Surroundings::default();
        let end = (0..12_000).fold(State::default(), |state, _| runge_kutta(&plant, &state, &controls, &still, 0.01));
        let [u, v, _, _, _, r] = end.velocity.into();
        let wide = (u * u + v * v).sqrt() / r;
        println!("{rpm} rpm, {rudder_deg} deg: {:.2} deg/s, {wide:.1} m", degrees(r));
        assert!((degrees(r) - rate).abs() < 0.02 && (wide - radius).abs() < 0.6, "{rpm} {rudder_deg}");
    }
}
