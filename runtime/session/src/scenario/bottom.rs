//! What a scenario says of the water's depth, and of where the vehicle must not be.

use super::clause::Clause;
use super::{Fault, Understood, Wrong};
use crate::files::Files;
use albacore_bathymetry::{FILE_BYTES_MAX, Placing};
use albacore_geometry::TangentFrame;
use albacore_sim::{Grid, Ground, NoGo, Pit, Plane, Scenario};
use albacore_trace::Digest;
use albacore_trace::journal::SourceDigest;
use std::sync::Arc;

/// `bottom(…)`: a plane.
pub fn bottom(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.bottom.ground = Ground::Plane(Plane {
        from: c.number("from")?,
        to: c.number("to")?,
        toward: c.heading("toward")?,
        across: c.number("across")?,
    });
    Ok(())
}

/// `bottom_grid(…)`: what was surveyed.
pub fn grid(understood: &mut Understood, c: &Clause, files: &Files, frame: Option<TangentFrame>) -> Result<(), Wrong> {
    let path = c.text("file")?;
    let depth_scale = c.number("depth_scale")?;
    let placing = Placing {
        at: c.optional_point("at")?,
        share: (c.number("northward")?, c.number("eastward")?),
        scale: c.number("scale")?,
    };
    let bytes = files.data(&path, FILE_BYTES_MAX)?;
    let in_file = |fault: albacore_bathymetry::Fault| Fault {
        message: format!("`{path}`: {}", fault.message),
        help: Some(fault.help),
    };
    let survey = albacore_bathymetry::read(&bytes)
        .map_err(|unreadable| Wrong(unreadable.faults.into_iter().map(in_file).collect()))?;
    let extent = survey.extent(&placing, frame).map_err(|fault| Wrong(vec![in_file(fault)]))?;
    understood.world.bottom.ground = Ground::Grid(Arc::new(Grid {
        south_west: extent.south_west,
        north_east: extent.north_east,
        rows: survey.north.count,
        columns: survey.east.count,
        depths: survey.depths.iter().map(|depth| depth * depth_scale).collect(),
    }));
    let mut digest = Digest::new();
    digest.bytes(&bytes);
    understood.files.push(SourceDigest { name: path, digest: digest.value() });
    Ok(())
}

/// `pit(…)`: a hollow in the ground.
pub fn pit(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.bottom.pits.push(Pit {
        name: c.text("name")?,
        at: c.point("at")?,
        depth: c.number("depth")?,
        radius: c.number("radius")?,
    });
    Ok(())
}

/// `no_go(…)`: where the vehicle must not be.
pub fn no_go(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    scenario.no_go.push(NoGo { name: c.text("name")?, area: c.area("area")? });
    Ok(())
}
