//! The velocity that the hull's own equations give where the Doppler log tells none: (10) and (11) of Jayasiri et al. (2016).

use crate::craft::hull::{Controls, Fossen, Load, Plant, Prestero, Six, Track};
use crate::craft::setup::HullSetup;
use albacore_geometry::{Attitude, Vector};
use albacore_navigation::Inertial;
use albacore_navigation::ukf::Velocity;
use albacore_vehicle::TICK_S;
use nalgebra::{Matrix3, Vector3};

/// The covariance of the controls, Eq. (11): 0.01 for each, rudder and stern plane in rad and the propeller in turns a second.
const CONTROL_VARIANCE: f64 = 0.01;
/// The model speaks when the log has been silent for so many ticks ...
const SILENT_TICKS: u32 = 5;
/// ... and as often as the log does, every so many ticks.
const SPEAKS_TICKS: u64 = 2;
/// The current is averaged over so long, s.
const CURRENT_S: f64 = 100.0;
/// What the model is off by beside what its controls are, m/s on each axis: mostly the current, which changes on the way.
const MODEL_SIGMA: f64 = 0.03;
/// It is off by the same for so long, s. A filter takes each sample for a new draw: so many times the variance is told as are of one draw.
const STEADY_S: f64 = 20.0;
/// No velocity of a model is worse than this, m/s.
const SIGMA_MAX: f64 = 2.0;

/// The equations of a hull.
#[derive(Clone, Debug)]
enum HullModel {
    Fossen(Fossen),
    Prestero(Prestero),
}

/// A model in a run.
#[derive(Clone, Debug)]
pub struct VelocityModel {
    hull: HullModel,
    /// Through the water, m/s, body.
    velocity: Vector3<f64>,
    /// The current as it was measured while the log told, m/s: north, east and down.
    current: Vector3<f64>,
    /// For how long that was, s.
    measured: f64,
    /// Ticks since the log told a velocity last.
    silent: u32,
    /// The covariance of the model's velocity, Eq. (11), m2/s2.
    covariance: Matrix3<f64>,
}

impl VelocityModel {
    /// That of a hull that forces move; none of another.
    pub fn new(hull: &HullSetup) -> Option<Self> {
        let hull = match hull {
            HullSetup::Kinematic(_) => return None,
            HullSetup::Fossen(_) => HullModel::Fossen(Fossen::new()),
            HullSetup::Prestero(_, crossflow) => HullModel::Prestero(Prestero::new(*crossflow)),
        };
        let (velocity, current, covariance) = (Vector3::zeros(), Vector3::zeros(), Matrix3::zeros());
        Some(VelocityModel { hull, velocity, current, measured: 0.0, silent: 0, covariance })
    }

    /// Goes on by a tick, in which the actuators did so; `told` says whether the log told a velocity. Roll, pitch, yaw and the rates of turn are
    /// those that the navigator believes.
    pub fn step(&mut self, track: &Track, navigator: &Inertial, told: bool) {
        let state = navigator.state();
        let [roll, pitch, yaw] = state.attitude;
        let attitude = Attitude::of(roll, pitch, yaw);
        let rates = navigator.rates().unwrap_or_default();
        for controls in &track.controls {
            self.velocity += self.acceleration(&attitude, self.velocity, rates, controls) * track.step_s();
        }
        if !self.velocity.iter().all(|speed| speed.abs() < 20.0) {
            self.velocity = Vector3::zeros();
        }
        let over_ground = Vector3::from(attitude.to_ned(state.velocity));
        let through_water = Vector3::from(attitude.to_ned(self.velocity.into()));
        if told {
            self.silent = 0;
            self.measured = (self.measured + TICK_S).min(CURRENT_S);
            self.current += (over_ground - through_water - self.current) * (TICK_S / self.measured);
            self.covariance = Matrix3::zeros();
        } else {
            self.silent += 1;
            self.spread(&attitude, rates, track.controls.last().copied().unwrap_or_default());
        }
    }

    /// Eq. (11), over a tick.
    fn spread(&mut self, attitude: &Attitude, rates: [f64; 3], controls: Controls) {
        const SMALL: f64 = 1e-4;
        let here = self.acceleration(attitude, self.velocity, rates, &controls);
        let slope = |there: Vector3<f64>, by: f64| (there - here) / by;
        let (mut keeps, mut pushes) = (Matrix3::identity(), Matrix3::zeros());
        for axis in 0..3 {
            let mut velocity = self.velocity;
            velocity[axis] += SMALL;
            let column = slope(self.acceleration(attitude, velocity, rates, &controls), SMALL);
            keeps.set_column(axis, &(keeps.column(axis) + column * TICK_S));
            let moved = match axis {
                0 => Controls { rudder: controls.rudder + SMALL, ..controls },
                1 => Controls { stern: controls.stern + SMALL, ..controls },
                _ => Controls { rpm: controls.rpm + 60.0 * SMALL, ..controls },
            };
            let column = slope(self.acceleration(attitude, self.velocity, rates, &moved), SMALL);
            pushes.set_column(axis, &(column * TICK_S));
        }
        let grown = keeps * self.covariance * keeps.transpose() + pushes * pushes.transpose() * CONTROL_VARIANCE;
        // Eq. (11) has no end where the model is not stable.
        let most = SIGMA_MAX * SIGMA_MAX;
        self.covariance = if grown.trace() < 3.0 * most { grown } else { Matrix3::identity() * most };
    }

    /// What it tells at a tick: a velocity over ground, while the log is silent.
    pub fn velocity(&self, tick: u64, navigator: &Inertial) -> Option<Velocity> {
        if self.silent < SILENT_TICKS || self.measured < CURRENT_S || !tick.is_multiple_of(SPEAKS_TICKS) {
            return None;
        }
        let [roll, pitch, yaw] = navigator.state().attitude;
        let carried = Vector3::from(Attitude::of(roll, pitch, yaw).to_body(self.current.into()));
        let draws = STEADY_S / (SPEAKS_TICKS as f64 * TICK_S);
        let noise = (self.covariance + Matrix3::identity() * (MODEL_SIGMA * MODEL_SIGMA)) * draws;
        Some(Velocity { value: (self.velocity + carried).into(), noise: noise.data.0 })
    }

    /// The acceleration through the water, m/s2, body.
    fn acceleration(
        &self,
        attitude: &Attitude,
        velocity: Vector3<f64>,
        rates: [f64; 3],
        controls: &Controls,
    ) -> Vector3<f64> {
        let six = Six::new(velocity.x, velocity.y, velocity.z, rates[0], rates[1], rates[2]);
        let of = |plant: &dyn Plant| plant.acceleration(attitude, &six, controls, Vector::ZERO, Load::default());
        let accelerated = match &self.hull {
            HullModel::Fossen(plant) => of(plant),
            HullModel::Prestero(plant) => of(plant),
        };
        accelerated.fixed_rows::<3>(0).into()
    }
}
