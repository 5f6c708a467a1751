//! The table of navigators: a module for each, and how scenarios name them.

mod dead_reckoning;
mod reported;
mod unscented;

pub use dead_reckoning::DeadReckoning;
pub use reported::Reported;
pub use unscented::Unscented;

use crate::navigator::Navigator;
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
}

impl Default for NavigatorSetup {
    fn default() -> Self {
        NavigatorSetup::DeadReckoning { walk: 0.05 }
    }
}

impl NavigatorSetup {
    /// One that begins at a known point.
    pub fn begin(&self, start: Point) -> Box<dyn Navigator> {
        match self {
            NavigatorSetup::DeadReckoning { walk } => Box::new(DeadReckoning::new(start, *walk)),
            NavigatorSetup::Unscented(settings) => match Unscented::new(start, settings) {
                Ok(filter) => Box::new(filter),
                // No script says so: its ranges leave out what makes no filter.
                Err(_) => Box::new(DeadReckoning::new(start, settings.walk)),
            },
        }
    }

    /// The white noise that the velocity which it is given has in simulation, as the random walk that it integrates to, m/s^0.5.
    pub fn velocity_walk(&self) -> f64 {
        match self {
            NavigatorSetup::DeadReckoning { walk } => *walk,
            NavigatorSetup::Unscented(settings) => settings.walk,
        }
    }
}
