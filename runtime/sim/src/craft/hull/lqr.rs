//! The fins by the linear quadratic regulators of the 2016 paper (Jayasiri et al., Sec. 3.1), (18) and (19) with the gains of
//! (21).
//!
//! ```text
//! delta_e = ek1 w + ek2 q + ek3 theta + ek4 z_err + ek5 int z_err      (18), z_err = z - WP_z
//! delta_r = rk1 v + rk2 r + rk3 psi_err                                (19), psi_err = psi - psi_d
//! ```
//!
//! What the paper leaves open or prints otherwise, and how it is read here:
//!
//! - A positive angle gives a positive moment, nose up and to starboard: so (18) and (19) stabilise Prestero's plant as they are
//!   printed. With the signs of its own fins, whose `Muuds` and `Nuudr` are below 0, they would have poles at +4 and more. For Prestero that
//!   makes `ds = -delta_e` and `dr = -delta_r`, for Fossen `ds = -delta_e` and `dr = +delta_r`.
//! - `ek4` is printed with `z`, by which a hull that is to be 10 m deep stays at 1 m: it is taken with `z_err`.
//! - `z_err` is clipped where it is multiplied by `ek4`. Without, a step of 10 m asks for a pitch of 4.8 rad, and the hull stands on its
//!   nose. Clipped at 0.6 m it asks for 16 degrees.
//! - The integral counts only while the error is not clipped and the fin has something left, and comes to no more than the clipped error
//!   does: on its way to another depth a hull has no error that lasts.
//! - `v` and `w` are through the water: see [`Sensed`].
//! - Over a bottom that falls, `theta` is counted from its slope, as the cascade does.
//!
//! The part of (19) that goes by the distance from the leg is guidance: `stdlib/waypoints_2016.alb` has it.

use super::autopilot::{AT_SURFACE, Sensed};
use albacore_geometry::Heading;
use serde::Deserialize;

/// What moves the fins of a hull.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
pub enum Controller {
    /// Depth by pitch, pitch by the stern plane, heading by the rudder: [`super::Gains`].
    #[default]
    #[serde(rename = "cascade")]
    Cascade,
    /// The regulators of the 2016 paper.
    #[serde(rename = "lqr_2016")]
    Lqr2016(LqrGains),
}

/// The gains of both regulators, in SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "LqrClause")]
pub struct LqrGains {
    /// ek1 to ek5: of heave, rate of pitch, pitch, error of depth and its integral.
    pub elevator: [f64; 5],
    /// rk1 to rk3: of sway, rate of yaw and error of heading.
    pub rudder: [f64; 3],
    /// No more of an error of depth is taken with ek4, m.
    pub depth_error_max: f64,
}

impl Default for LqrGains {
    /// (21), and a clip of ours.
    fn default() -> Self {
        LqrGains {
            elevator: [0.5110, -4.1867, -6.6161, 3.1698, 0.0035],
            rudder: [0.3137, -0.9071, -1.1180],
            depth_error_max: 0.6,
        }
    }
}

/// The same as a script says it, in lists that may be too short.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LqrClause {
    elevator: Vec<f64>,
    rudder: Vec<f64>,
    depth_error_max: f64,
}

impl TryFrom<LqrClause> for LqrGains {
    type Error = &'static str;

    fn try_from(clause: LqrClause) -> Result<Self, Self::Error> {
        Ok(LqrGains {
            elevator: clause.elevator.try_into().map_err(|_| "`elevator` has no five gains\nwrite ek1 to ek5")?,
            rudder: clause.rudder.try_into().map_err(|_| "`rudder` has no three gains\nwrite rk1 to rk3")?,
            depth_error_max: clause.depth_error_max,
        })
    }
}

/// Where to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// psi_d.
    pub heading: Heading,
    /// WP_z, m.
    pub depth: f64,
    /// How steep the way there leads down already, rad.
    pub slope: f64,
}

/// Both regulators, at every step of the integration: their loop runs at 100 Hz in the paper, and is too fast for 10 Hz.
#[derive(Clone, Debug)]
pub struct Lqr {
    gains: LqrGains,
    /// The greatest angle of a fin, rad.
    fin_max: f64,
    /// From one step to the next, s.
    step: f64,
    goal: Option<Goal>,
    /// Of the error of depth, m s.
    integral: f64,
}

impl Lqr {
    /// For fins that move so far, rad, every `step` seconds.
    pub fn new(gains: LqrGains, fin_max: f64, step: f64) -> Self {
        Lqr { gains, fin_max, step, goal: None, integral: 0.0 }
    }

    /// Takes a goal in place of the one before.
    pub fn head_for(&mut self, goal: Goal) {
        self.goal = Some(goal);
    }

    /// Whether there is a goal.
    pub fn is_under_way(&self) -> bool {
        self.goal.is_some()
    }

    /// The depth that is wanted, m.
    pub fn wanted_depth(&self) -> Option<f64> {
        self.goal.map(|goal| goal.depth)
    }

    /// Forgets goal and integral.
    pub fn start_afresh(&mut self) {
        (self.goal, self.integral) = (None, 0.0);
    }

    /// (18): the angle asked of the elevator, rad, whether it can reach that or not; positive lifts the nose.
    pub fn elevator(&mut self, sensed: &Sensed) -> f64 {
        let Some(goal) = self.goal else { return 0.0 };
        let LqrGains { elevator: [ek1, ek2, ek3, ek4, ek5], depth_error_max, .. } = self.gains;
        let error = sensed.depth - goal.depth;
        let near = error.clamp(-depth_error_max, depth_error_max);
        let state = ek1 * sensed.heave + ek2 * sensed.pitch_rate + ek3 * (sensed.pitch + goal.slope) + ek4 * near;
        let asked = state + ek5 * self.integral;
        let is_spent = asked.abs() > self.fin_max && asked * ek5 * error > 0.0;
        let may_rise = error < 0.0 || sensed.depth > AT_SURFACE;
        if near == error && !is_spent && may_rise {
            let most = if ek5 == 0.0 { 0.0 } else { (ek4 * depth_error_max / ek5).abs() };
            self.integral = (self.integral + error * self.step).clamp(-most, most);
        }
        state + ek5 * self.integral
    }

    /// (19) without its part for the distance from the leg: the angle asked of the rudder, rad; positive turns to starboard.
    pub fn rudder(&self, sensed: &Sensed) -> f64 {
        let Some(goal) = self.goal else { return 0.0 };
        let [rk1, rk2, rk3] = self.gains.rudder;
        rk1 * sensed.sway + rk2 * sensed.yaw_rate + rk3 * (sensed.heading - goal.heading)
    }
}

#[cfg(test)]
mod tests;
