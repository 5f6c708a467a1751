//! The bottom, as a hull feels it that forces move.
//!
//! Ours: enough to hold a hull where it struck and to let it come free, no model of a stranding. A hull that lies still does not
//! answer its fins, so that none would ever come free by them: until it has way again it turns as if on a pivot, and its
//! propeller and its buoyancy take it from there.

use super::autopilot::PITCH_MAX;
use super::six_dof::{Six, State, attitude_of};
use albacore_geometry::math::{PI, sin_cos};
use albacore_geometry::{Heading, Point, wrap_angle};
use albacore_vehicle::{Command, TICK_S, Vertical};
use nalgebra::Vector6;

/// How fast a hull turns upon the bottom, rad/s.
const PIVOT_RATE: f64 = 10.0 * PI / 180.0;
/// Told to go up by less than this, m, it is told to keep its depth: it never keeps it better than so.
const KEEPS_DEPTH: f64 = 0.5;
/// A hull that has not touched the bottom for so long is free, s: it has come to a speed at which its fins can steer it.
const FREE_AFTER_S: f64 = 5.0;

/// A hull that has struck the bottom and has not come free since.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grounding {
    /// For so long it has not touched it, s.
    clear_s: f64,
}

impl Grounding {
    /// How the bottom holds a hull that moved from `before` to `state` in a tick, if it struck the bottom then or before. Where
    /// it would come to lie on it, or in it, it stays where it was and can only rise from there.
    pub fn after(
        grounding: Option<Grounding>,
        before: &Six,
        state: &mut State,
        water_depth: impl Fn(Point) -> f64,
    ) -> Option<Grounding> {
        let [north, east, down, roll, pitch, yaw] = state.pose.into();
        if down.max(0.0) >= water_depth(Point::new(north, east)) {
            let (north, east) = (before[0], before[1]);
            let down = down.min(water_depth(Point::new(north, east)));
            state.pose = Vector6::new(north, east, down, roll, pitch, yaw);
            let attitude = attitude_of(&state.pose);
            let [u, v, w, p, q, r] = state.velocity.into();
            let sinking = attitude.to_ned([u, v, w])[2];
            let [u, v, w] = attitude.to_body([0.0, 0.0, sinking.min(0.0)]);
            state.velocity = Vector6::new(u, v, w, p, q, r);
            return Some(Grounding { clear_s: 0.0 });
        }
        let clear_s = grounding?.clear_s + TICK_S;
        (clear_s < FREE_AFTER_S).then_some(Grounding { clear_s })
    }

    /// Where a command would have it go: a length ahead of its nose, dive or climb as it may.
    pub fn intent(&self, pose: &Six, command: &Command, length: f64, water_depth: impl Fn(Point) -> f64) -> Intent {
        let (here, depth) = (Point::new(pose[0], pose[1]), pose[2].max(0.0));
        let reach = if command.speed > 0.0 { length } else { 0.0 };
        let ahead = water_depth(here + reach * Heading::from_radians(pose[5]).unit());
        let wanted = match command.vertical {
            Vertical::Depth(depth) => depth,
            Vertical::Altitude(altitude) => ahead.min(water_depth(here)) - altitude,
        };
        let (sin, cos) = sin_cos(PITCH_MAX);
        let clear = wanted.max(0.0).min(depth + reach * sin / cos) < ahead;
        if self.clear_s == 0.0 && !clear && wanted >= depth - KEEPS_DEPTH {
            Intent::Stay
        } else if wanted < depth {
            Intent::Up
        } else {
            Intent::Away
        }
    }
}

/// What a command means to a hull that is aground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intent {
    /// To stay where the bottom is, or to go into it.
    Stay,
    /// To rise.
    Up,
    /// To go where the water is deeper.
    Away,
}

/// Lets a hull that had the pose `from` a tick ago turn upon the bottom since: upright, toward the heading that it is told, and
/// with its nose up if it `climbs`. Its velocity over ground is what it was.
pub fn pivot(state: &mut State, from: &Six, heading: Option<Heading>, climbs: bool) {
    let turned = |from: f64, to: f64| {
        let step = PIVOT_RATE * TICK_S;
        from + wrap_angle(to - from).clamp(-step, step)
    };
    let [_, _, _, roll, pitch, yaw] = (*from).into();
    let [u, v, w, ..]: [f64; 6] = state.velocity.into();
    let over_ground = attitude_of(&state.pose).to_ned([u, v, w]);
    let heading = heading.map_or(yaw, Heading::radians);
    let nose_up = if climbs { PITCH_MAX } else { 0.0 };
    (state.pose[3], state.pose[4]) = (turned(roll, 0.0), turned(pitch, nose_up));
    state.pose[5] = wrap_angle(turned(yaw, heading));
    let [u, v, w] = attitude_of(&state.pose).to_body(over_ground);
    state.velocity = Vector6::new(u, v, w, 0.0, 0.0, 0.0);
}
