//! The water's depth: what a scenario says of it, and what of that cannot be.

use crate::scenario::{Objections, Scenario};
use albacore_geometry::{Heading, Point};
use serde::{Deserialize, Serialize};

/// A plane bottom, level beyond either end of its slope, with pits in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bottom {
    /// Water depth where the slope begins, m. Default 20.
    pub from: f64,
    /// Water depth where it ends, m. Default 20.
    pub to: f64,
    /// The direction in which depth goes `from` .. `to`. Default north.
    pub toward: Heading,
    /// The length of the slope, m, centred on the frame's origin. Default 1000.
    pub across: f64,
    /// Where it is deeper than the plane. Default none.
    pub pits: Vec<Pit>,
}

impl Default for Bottom {
    fn default() -> Self {
        Bottom { from: 20.0, to: 20.0, toward: Heading::NORTH, across: 1000.0, pits: Vec::new() }
    }
}

/// A smooth round hollow in the bottom: a Gaussian.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pit {
    /// What it is called.
    pub name: String,
    /// Its middle. Default the frame's origin.
    pub at: Point,
    /// How much deeper than the plane it is in its middle, m. Default 1.
    pub depth: f64,
    /// The standard deviation of its Gaussian, m: there it is 61 % as deep as in its middle. Default 20.
    pub radius: f64,
}

impl Default for Pit {
    fn default() -> Self {
        Pit { name: String::from("pit"), at: Point::ORIGIN, depth: 1.0, radius: 20.0 }
    }
}

/// What of the bottom cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    objections.positive("bottom.from", scenario.bottom.from);
    objections.positive("bottom.to", scenario.bottom.to);
    objections.positive("bottom.across", scenario.bottom.across);
    objections.finite("bottom.toward", [scenario.bottom.toward.radians(), 0.0]);
    for pit in &scenario.bottom.pits {
        let name = &pit.name;
        objections.finite(&format!("pit {name}: at"), [pit.at.north, pit.at.east]);
        // A pit only deepens, so that the water is nowhere shallower than the plane.
        objections.positive(&format!("pit {name}: depth"), pit.depth);
        objections.positive(&format!("pit {name}: radius"), pit.radius);
    }
}
