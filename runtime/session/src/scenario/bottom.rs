//! A bottom that was surveyed: its file, and whether the vehicle starts over it.

use super::clause::Clause;
use super::{Understood, Wrong};
use crate::files::Files;
use albacore_formats::survey::{FILE_BYTES_MAX, Placing};
use albacore_geometry::{Point, TangentFrame};
use albacore_lang::ScenarioProgram;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_sim::{Grid, Ground, Scenario};
use serde::Deserialize;
use std::sync::Arc;

/// `bottom_grid(…)`: what was surveyed.
#[derive(Deserialize)]
pub struct BottomGrid {
    file: String,
    at: Option<Point>,
    northward: f64,
    eastward: f64,
    scale: f64,
    depth_scale: f64,
}

/// Reads the survey.
pub fn grid(
    understood: &mut Understood,
    clause: BottomGrid,
    files: &Files,
    frame: Option<TangentFrame>,
) -> Result<(), Wrong> {
    let BottomGrid { file: path, at, northward, eastward, scale, depth_scale } = clause;
    let placing = Placing { at, share: (northward, eastward), scale };
    let bytes = files.data(&path, FILE_BYTES_MAX)?;
    let survey = albacore_formats::survey::read(&bytes).map_err(|wrong| Wrong::in_file(&path, wrong.faults))?;
    let extent = survey.extent(&placing, frame).map_err(|fault| Wrong::in_file(&path, vec![fault]))?;
    understood.world.environment.bottom.ground = Ground::Grid(Arc::new(Grid {
        south_west: extent.south_west,
        north_east: extent.north_east,
        rows: survey.north.count,
        columns: survey.east.count,
        depths: survey.depths.iter().map(|depth| depth * depth_scale).collect(),
    }));
    understood.note_file(path, &bytes);
    Ok(())
}

/// A vehicle that starts beyond its survey would swim over the depth of the nearest edge, which nobody means.
pub fn elsewhere(program: &ScenarioProgram, world: &Scenario) -> Option<Diagnostic> {
    let Ground::Grid(grid) = &world.environment.bottom.ground else { return None };
    let clause = program.clauses.iter().find(|clause| clause.name == "bottom_grid")?;
    let (start, Grid { south_west, north_east, .. }) = (world.vehicle.start, grid.as_ref());
    let nearest = Point::new(
        start.north.clamp(south_west.north, north_east.north.max(south_west.north)),
        start.east.clamp(south_west.east, north_east.east.max(south_west.east)),
    );
    let away = start.distance(nearest);
    // A survey that was laid by its edge may end a rounding before it.
    if away < 1e-3 {
        return None;
    }
    let message = format!(
        "the vehicle starts {} outside this survey, which lies {:.0} to {:.0} m north and {:.0} to {:.0} m east",
        if away < 10_000.0 { format!("{away:.1} m") } else { format!("{:.0} km", away / 1000.0) },
        south_west.north,
        north_east.north,
        south_west.east,
        north_east.east,
    );
    let survey = Clause { clause, words: &super::words(program) }.read::<BottomGrid>();
    let is_laid = survey.is_ok_and(|survey| survey.at.is_some());
    let finding = Diagnostic::error(Code::ScenariosClause, clause.span, message);
    Some(match program.clauses.iter().find(|clause| clause.name == "vehicle") {
        Some(vehicle) => finding.label(vehicle.span, "the vehicle"),
        None => finding,
    }
    .help(if is_laid {
        "move the one to the other: `at:` says where the middle of the survey lies"
    } else {
        "without `at` it lies where it was surveyed: say where its middle is to lie, such as `at: point(north: 0 m, east: 0 m)`"
    }))
}
