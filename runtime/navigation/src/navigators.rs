//! The table of navigators: a module for each, and how scenarios name them.

mod dead_reckoning;
mod inertial;
mod reported;
mod unscented;

pub use dead_reckoning::DeadReckoning;
pub use inertial::{ErrorEllipse, Inertial, Nis, Settings as InertialSettings};
pub use reported::Reported;
pub use unscented::Unscented;

use crate::navigator::Navigator;
use crate::ukf::{Ins15Setup, InsState};
use albacore_geometry::Point;
use serde::Deserialize;

/// Those that a scenario can name: each is a clause of the standard library that gives a `navigator`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NavigatorSetup {
    /// [`DeadReckoning`].
    DeadReckoning {
        /// Growth of the position error, m/s^0.5: its standard deviation an axis after t seconds is this times the root of t.
        walk: f64,
    },
    /// The filter of `ukf`.
    #[serde(rename = "ukf")]
    Unscented(unscented::Settings),
    /// [`Inertial`].
    Inertial(inertial::Settings),
}

/// Where a navigator begins, and with which instruments.
#[derive(Clone, Debug, PartialEq)]
pub struct Departure {
    /// The place, for one that knows it exactly.
    pub position: Point,
    /// The start as an inertial one knows it, the standard deviations of its errors, and its instruments.
    pub state: InsState,
    /// See there.
    pub sigma: InsState,
    /// See there.
    pub setup: Ins15Setup,
    /// Whether the pressure is measured without noise, so that it may stay the same; and the velocity.
    pub exact_pressure: bool,
    /// See there.
    pub exact_velocity: bool,
}

impl Default for NavigatorSetup {
    fn default() -> Self {
        NavigatorSetup::DeadReckoning { walk: 0.05 }
    }
}

impl NavigatorSetup {
    /// One that begins there.
    pub fn begin(&self, departure: &Departure) -> Box<dyn Navigator> {
        let start = departure.position;
        // No script makes a filter that cannot be: ranges leave it out.
        let without = |walk: f64| Box::new(DeadReckoning::new(start, walk));
        match self {
            NavigatorSetup::DeadReckoning { walk } => without(*walk),
            NavigatorSetup::Unscented(settings) => match Unscented::new(start, settings) {
                Ok(filter) => Box::new(filter),
                Err(_) => without(settings.walk),
            },
            NavigatorSetup::Inertial(settings) => match Inertial::new(departure, settings) {
                Ok(filter) => Box::new(filter),
                Err(_) => without(0.0),
            },
        }
    }

    /// What an inertial one is told, where it is one.
    pub fn inertial(&self) -> Option<&InertialSettings> {
        match self {
            NavigatorSetup::Inertial(settings) => Some(settings),
            _ => None,
        }
    }

    /// The white noise that the velocity which it is given has in simulation, as the random walk that it integrates to, m/s^0.5.
    pub fn velocity_walk(&self) -> f64 {
        match self {
            NavigatorSetup::DeadReckoning { walk } => *walk,
            NavigatorSetup::Unscented(settings) => settings.walk,
            // It is given no velocity but that of its instruments.
            NavigatorSetup::Inertial(_) => 0.0,
        }
    }
}
