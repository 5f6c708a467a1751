//! What holds a hull with fins on its course: heading by the rudder, depth by pitch and pitch by the stern plane, speed by the
//! propeller.
//!
//! Which law moves the fins is a [`Controller`]; what is asked of the propeller, at the surface, over a bottom and of a hull that
//! stalls is the same with each.
//!
//! The law that is here is classical cascaded control (Fossen 2021, ch. 15), ours in its numbers. A hull answers its fins the faster
//! the faster it swims: lengths and angles of its motion stay the same, times shrink. So gains on angles are constant, and gains on
//! rates fall as one over speed.

use super::lqr::{Controller, Goal, Lqr};
use super::six_dof::{Controls, Load, Plant, State, attitude_of};
use super::submersible::Settings;
use albacore_geometry::math::{PI, sin};
use albacore_geometry::{Heading, Vector};
use albacore_vehicle::{Command, TICK_S, Vertical};
use nalgebra::Vector6;

/// The gains of a hull's autopilot. Angles of fins in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    /// Rudder for an error of heading, 1.
    pub heading: f64,
    /// Rudder against a rate of yaw at 1 m/s, s.
    pub yaw_rate: f64,
    /// Rudder for an error of heading that lasts, 1/s.
    pub heading_integral: f64,
    /// Stern plane for an error of pitch, 1.
    pub pitch: f64,
    /// Stern plane against a rate of pitch at 1 m/s, s.
    pub pitch_rate: f64,
    /// Stern plane that holds the sine of a pitch against the hull's own righting, at 1 m/s.
    pub righting: f64,
    /// Pitch for an error of depth, rad/m.
    pub depth: f64,
    /// Pitch for an error of depth that lasts, rad/(m s).
    pub depth_integral: f64,
    /// Steerage way: what a stalled hull makes, to bring its nose up by the stern plane, m/s.
    pub steerage: f64,
    /// What it makes to leave the surface, m/s: a light hull does not come under at less.
    pub dive: f64,
}

impl Gains {
    /// For the plant after Fossen.
    pub const FOSSEN: Gains = Gains {
        heading: 0.7,
        yaw_rate: 1.2,
        heading_integral: 0.02,
        pitch: 0.7,
        pitch_rate: 1.2,
        righting: 1.6,
        depth: 0.1,
        depth_integral: 0.006,
        steerage: 1.2,
        dive: 1.0,
    };
    /// For the plant after Prestero, which is unstable without.
    pub const PRESTERO: Gains = Gains {
        heading: 0.8,
        yaw_rate: 3.0,
        heading_integral: 0.05,
        pitch: 1.0,
        pitch_rate: 2.5,
        righting: 0.95,
        depth: 0.1,
        depth_integral: 0.01,
        steerage: 1.2,
        dive: 1.5,
    };
}

/// The steepest pitch asked for, rad.
pub(super) const PITCH_MAX: f64 = 25.0 * PI / 180.0;
/// The most that lasting errors may come to: rudder, and pitch, rad.
const RUDDER_TRIM_MAX: f64 = 5.0 * PI / 180.0;
const PITCH_TRIM_MAX: f64 = 15.0 * PI / 180.0;
/// Of a larger error only so much is counted as one that lasts: it is on its way. Heading in rad, depth in m, speed in m/s.
const HEADING_LASTS: f64 = 5.0 * PI / 180.0;
const DEPTH_LASTS: f64 = 0.25;
const SPEED_LASTS: f64 = 0.2;
/// Turns for an error of speed are asked for as if so many times the error were to be gone faster.
const SPEED_GAIN: f64 = 1.0;
/// The same for an error that lasts, 1/s.
const SPEED_INTEGRAL: f64 = 0.1;
/// Gains are no higher than at this speed, m/s: a hull at rest does not answer its fins at all.
const SPEED_MIN: f64 = 0.8;
/// Over so long, in s, the slope of the bottom is smoothed; steeper than this, in m/s, is a step and no slope.
const BOTTOM_TIME: f64 = 1.0;
const FALL_MAX: f64 = 0.5;
/// Less deep than this a hull is at the surface, m.
pub(super) const AT_SURFACE: f64 = 0.1;
/// One that is to be deeper than that has left it when it is this deep, m, or as deep as it is to be.
const LEFT_SURFACE: f64 = 1.0;
/// A hull this much too deep, in m, has stalled where its stern plane can do no more and its nose is still this much down,
/// in rad: the light one after Prestero sinks so, nose down, at 0.8 m/s. It has recovered when it is no more than this too deep.
const STALLED: f64 = 0.2;
const STALLED_PITCH: f64 = 5.0 * PI / 180.0;
const RECOVERED: f64 = 0.1;
/// The speed at which turns and speed are compared, m/s.
const MAP_SPEED: f64 = 2.0;

/// What the autopilot knows of its hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Where the nose points.
    pub heading: Heading,
    /// Nose up, rad.
    pub pitch: f64,
    /// How fast it pitches, rad/s, in the frame of the body.
    pub pitch_rate: f64,
    /// How fast it yaws, likewise.
    pub yaw_rate: f64,
    /// Depth, m.
    pub depth: f64,
    /// Depth of the water, m.
    pub water_depth: f64,
    /// Speed ahead through the water, m/s.
    pub speed: f64,
    /// To starboard in the frame of the body, m/s; through the water, as forces are those of the water's flow past the hull: over
    /// ground a steady current from the side would look like a sway that never ends.
    pub sway: f64,
    /// Down in the frame of the body, through the water, m/s.
    pub heave: f64,
}

impl Sensed {
    /// What perfect instruments tell of a state, in water that moves with `flow` and is so deep.
    pub fn of(state: &State, flow: Vector, water_depth: f64) -> Self {
        let [_, _, depth, _, pitch, yaw] = state.pose.into();
        let [u, v, w, _, pitch_rate, yaw_rate] = state.velocity.into();
        let [ahead, aside, down] = attitude_of(&state.pose).to_body([flow.north, flow.east, 0.0]);
        Sensed {
            heading: Heading::from_radians(yaw),
            pitch,
            pitch_rate,
            yaw_rate,
            depth,
            water_depth,
            speed: u - ahead,
            sway: v - aside,
            heave: w - down,
        }
    }
}

/// What an autopilot takes for so is so much more than what is so: the errors of its navigation. Velocities through the water are as
/// they are: an inertial navigator has those over ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Misjudged {
    /// rad, clockwise.
    pub heading: f64,
    /// rad, nose up.
    pub pitch: f64,
    /// rad/s, body.
    pub pitch_rate: f64,
    /// rad/s, body.
    pub yaw_rate: f64,
    /// m.
    pub depth: f64,
}

impl Sensed {
    /// The same with errors.
    pub fn off_by(self, errors: &Misjudged) -> Self {
        Sensed {
            heading: self.heading + errors.heading,
            pitch: self.pitch + errors.pitch,
            pitch_rate: self.pitch_rate + errors.pitch_rate,
            yaw_rate: self.yaw_rate + errors.yaw_rate,
            depth: self.depth + errors.depth,
            ..self
        }
    }
}

/// The autopilot of a hull, once a tick.
#[derive(Clone, Debug)]
pub struct Autopilot {
    gains: Gains,
    /// What moves the fins in place of the cascade.
    lqr: Option<Box<Lqr>>,
    fin_max: f64,
    rpm_max: f64,
    speed_max: f64,
    /// Turns for each m/s, straight and level, 1/min.
    rpm_per_speed: f64,
    /// The depth of the water a tick ago, m, and how fast it has lately been growing, m/s.
    bottom: Option<f64>,
    bottom_falls: f64,
    /// What lasting errors have come to: rudder (rad), pitch down (rad), speed (m/s).
    rudder_trim: f64,
    pitch_trim: f64,
    speed_trim: f64,
    /// Whether it sinks against its fins for want of way.
    stalled: bool,
    /// Whether it is on its way from the surface.
    leaves_surface: bool,
}

impl Autopilot {
    /// For a plant, with what is set for it.
    pub fn new<P: Plant>(plant: &P, settings: &Settings) -> Self {
        let Settings { gains, limits, speed_max, .. } = *settings;
        let lqr = match settings.controller {
            Controller::Cascade => None,
            Controller::Lqr2016(gains) => Some(Box::new(Lqr::new(gains, limits.fin, settings.step()))),
        };
        Autopilot {
            gains,
            lqr,
            fin_max: limits.fin,
            rpm_max: limits.rpm,
            speed_max,
            rpm_per_speed: rpm_per_speed(plant),
            bottom: None,
            bottom_falls: 0.0,
            rudder_trim: 0.0,
            pitch_trim: 0.0,
            speed_trim: 0.0,
            stalled: false,
            leaves_surface: false,
        }
    }

    /// What fins and propeller are to do in the coming tick. Without a command the propeller stops and the fins are neutral.
    pub fn steer(&mut self, sensed: &Sensed, command: Option<&Command>) -> Controls {
        self.watch_bottom(sensed.water_depth);
        let Some(command) = command else {
            self.start_afresh();
            return Controls::default();
        };
        let speed = sensed.speed.max(SPEED_MIN);
        let (wanted_depth, sinking) = match command.vertical {
            Vertical::Depth(depth) => (depth, 0.0),
            Vertical::Altitude(altitude) => (sensed.water_depth - altitude, self.bottom_falls),
        };
        let slope = sinking / speed;
        let (rudder, stern) = match &mut self.lqr {
            Some(lqr) => {
                lqr.head_for(Goal { heading: command.heading, depth: wanted_depth.max(0.0), slope });
                self.fins_by_lqr(sensed)
            }
            None => {
                let stern = self.stern(wanted_depth.max(0.0) - sensed.depth, slope, sensed, speed);
                (self.rudder(command.heading - sensed.heading, sensed.yaw_rate, speed), stern)
            }
        };
        self.leaves_surface = match self.leaves_surface {
            true => sensed.depth < wanted_depth.min(LEFT_SURFACE),
            false => sensed.depth < AT_SURFACE && wanted_depth > 2.0 * AT_SURFACE,
        };
        let least = match (self.stalled, self.leaves_surface) {
            (_, true) => self.gains.dive,
            (true, false) => self.gains.steerage,
            (false, false) => 0.0,
        };
        // A hull that is to make no way keeps none, unless it swims down: what it has of buoyancy takes it up.
        let way = if command.speed > 0.0 || self.stalled { command.speed.max(least) } else { command.speed };
        Controls { rudder, stern, rpm: self.rpm(way.clamp(0.0, self.speed_max), sensed.speed) }
    }

    /// Whether its law moves the fins at every step of the integration, and not once a tick.
    pub fn steers_within_a_tick(&self) -> bool {
        self.lqr.is_some()
    }

    /// What is to be done at a later step of a tick, at whose beginning that was `wanted`.
    pub fn steer_on(&mut self, sensed: &Sensed, wanted: &Controls) -> Controls {
        if !self.lqr.as_ref().is_some_and(|lqr| lqr.is_under_way()) {
            return *wanted;
        }
        let (rudder, stern) = self.fins_by_lqr(sensed);
        Controls { rudder, stern, ..*wanted }
    }

    /// Rudder and stern plane within their limits. The law's angles are such that a positive one gives a positive moment: for the
    /// rudder that is ours, and Prestero's plant turns it round once more; the stern plane of either plant presses the nose down.
    fn fins_by_lqr(&mut self, sensed: &Sensed) -> (f64, f64) {
        let Some(lqr) = &mut self.lqr else { return (0.0, 0.0) };
        let (rudder, stern) = (lqr.rudder(sensed), -lqr.elevator(sensed));
        let error = lqr.wanted_depth().unwrap_or(sensed.depth) - sensed.depth;
        self.watch_stall(error, stern, sensed.pitch);
        (rudder.clamp(-self.fin_max, self.fin_max), stern.clamp(-self.fin_max, self.fin_max))
    }

    /// Forgets what errors have lasted: of what held the hull meanwhile nothing is to be held against it.
    pub fn start_afresh(&mut self) {
        (self.rudder_trim, self.pitch_trim, self.speed_trim) = (0.0, 0.0, 0.0);
        (self.stalled, self.leaves_surface) = (false, false);
        if let Some(lqr) = &mut self.lqr {
            lqr.start_afresh();
        }
    }

    fn rudder(&mut self, error: f64, rate: f64, speed: f64) -> f64 {
        let asked = self.gains.heading * error - self.gains.yaw_rate / speed * rate;
        // At its limit a fin can do no more: to go on counting would only wind the trim up.
        if (asked + self.rudder_trim).abs() < self.fin_max {
            let lasting = error.clamp(-HEADING_LASTS, HEADING_LASTS);
            let trim = self.rudder_trim + self.gains.heading_integral * lasting * TICK_S;
            self.rudder_trim = trim.clamp(-RUDDER_TRIM_MAX, RUDDER_TRIM_MAX);
        }
        (asked + self.rudder_trim).clamp(-self.fin_max, self.fin_max)
    }

    /// How the bottom goes up and down under the hull, smoothed.
    fn watch_bottom(&mut self, depth: f64) {
        let falls = (depth - self.bottom.unwrap_or(depth)) / TICK_S;
        self.bottom = Some(depth);
        self.bottom_falls += (falls.clamp(-FALL_MAX, FALL_MAX) - self.bottom_falls) * TICK_S / BOTTOM_TIME;
    }

    /// `error` is how much deeper it is to be, m, and `slope` that of its way down. Pitch is positive nose up, and the stern
    /// plane nose down.
    fn stern(&mut self, error: f64, slope: f64, sensed: &Sensed, speed: f64) -> f64 {
        let gains = self.gains;
        let wanted = gains.depth * error + slope + self.pitch_trim;
        let down = wanted.clamp(-PITCH_MAX, PITCH_MAX);
        let hold = gains.righting / (speed * speed) * sin(down);
        let asked = hold + gains.pitch * (down + sensed.pitch) + gains.pitch_rate / speed * sensed.pitch_rate;
        let stern = asked.clamp(-self.fin_max, self.fin_max);
        self.watch_stall(error, asked, sensed.pitch);
        // Where fin or pitch is at its limit on the way there, an error tells nothing of the trim: to go on counting would only wind it up.
        let more = |asked: f64, given: f64| asked != given && (asked > 0.0) == (error > 0.0);
        // Nor where it has no way by which its fins lift it.
        let helps = !more(asked, stern) && !more(wanted, down);
        // At the surface it can rise no further.
        if helps && (error > 0.0 || sensed.depth > AT_SURFACE) {
            let lasting = error.clamp(-DEPTH_LASTS, DEPTH_LASTS);
            let trim = self.pitch_trim + gains.depth_integral * lasting * TICK_S;
            self.pitch_trim = trim.clamp(-PITCH_TRIM_MAX, PITCH_TRIM_MAX);
        }
        stern
    }

    /// Whether it sinks against a stern plane of which `asked` is asked; `error` is how much deeper it is to be.
    fn watch_stall(&mut self, error: f64, asked: f64, pitch: f64) {
        self.stalled = match self.stalled {
            true => error < -RECOVERED,
            false => error < -STALLED && asked < -self.fin_max && pitch < -STALLED_PITCH,
        };
    }

    fn rpm(&mut self, wanted: f64, speed: f64) -> f64 {
        if wanted <= 0.0 {
            self.speed_trim = 0.0;
            return 0.0;
        }
        let error = wanted - speed;
        let asked = self.rpm_per_speed * (wanted + SPEED_GAIN * error + self.speed_trim);
        // At full turns it can go no faster; and what is too fast by much slows down by its drag alone, however few they are.
        if (asked < self.rpm_max || error < 0.0) && error > -SPEED_LASTS {
            self.speed_trim += SPEED_INTEGRAL * error.min(SPEED_LASTS) * TICK_S;
        }
        asked.clamp(0.0, self.rpm_max)
    }
}

/// The speed that so many turns a minute give, straight and level, m/s.
pub(crate) fn speed_possible<P: Plant>(plant: &P, rpm: f64) -> f64 {
    rpm / rpm_per_speed(plant)
}

/// The turns a minute for each m/s, straight and level: where thrust and drag balance. Both grow as a square, so that the
/// quotient is hardly another at another speed.
fn rpm_per_speed<P: Plant>(plant: &P) -> f64 {
    let level = attitude_of(&Vector6::zeros());
    let ahead = Vector6::new(MAP_SPEED, 0.0, 0.0, 0.0, 0.0, 0.0);
    let surge = |rpm: f64| {
        let controls = Controls { rpm, ..Controls::default() };
        plant.acceleration(&level, &ahead, &controls, Vector::ZERO, Load::default())[0]
    };
    // Bisection: more turns, more thrust.
    let (mut low, mut high) = (0.0, RPM_HIGH);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if surge(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high) / MAP_SPEED
}

/// Where the search for turns begins, and how often its interval is halved.
const RPM_HIGH: f64 = 20_000.0;
const BISECTIONS: u32 = 60;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::craft::hull::actuators::ActuatorLimits;
    use crate::craft::hull::{Controller, Crossflow, Fossen, Prestero};

    /// Turns asked for at a speed, after half a minute in which the hull was far too fast for them.
    fn after_coasting(mut autopilot: Autopilot) -> [f64; 2] {
        let before = autopilot.rpm(0.8, 0.8);
        (0..300).for_each(|_| assert!(autopilot.rpm(0.8, 2.4) <= 0.0));
        [before, autopilot.rpm(0.8, 0.8)]
    }

    #[test]
    fn what_only_drag_can_mend_is_not_counted() {
        let settings = |gains: Gains| Settings {
            steps: 10,
            speed_max: 2.5,
            limits: ActuatorLimits { rpm: 2500.0, ..ActuatorLimits::default() },
            gains,
            controller: Controller::Cascade,
        };
        let fossen = Autopilot::new(&Fossen::new(), &settings(Gains::FOSSEN));
        let prestero = Autopilot::new(&Prestero::new(Crossflow::Corrected), &settings(Gains::PRESTERO));
        for [before, after] in [after_coasting(fossen), after_coasting(prestero)] {
            assert!((before - after).abs() < 1e-9 && before > 100.0, "{before} and {after} turns a minute");
        }
    }
}
