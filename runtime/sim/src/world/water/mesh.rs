//! The grid of a flow field: its nodes, its spacing, and the step that is stable on it.

use crate::scenario::{number, rounded_down};
use crate::world::water::Meander;
use crate::world::water::frame::FlowFrame;

/// A grid has at most this many nodes.
const NODES_MAX: f64 = 40_000.0;
/// A field step is cut into at most this many explicit ones.
const SUBSTEPS_MAX: f64 = 50.0;
/// The most nodes that are computed, step after step, before a run begins: some seconds of work.
const SPIN_UP_WORK_MAX: f64 = 2e9;
/// Share of the explicit scheme's stability limit that a sub-step uses.
const STABILITY: f64 = 0.8;
/// The grid of a field: nodes with their spacing, and the step that is stable on it.
#[derive(Clone, Copy, Debug)]
pub struct Mesh {
    /// Nodes along the flow and across it.
    pub columns: usize,
    pub rows: usize,
    /// Metres between them.
    pub dx: f64,
    pub dy: f64,
    /// Explicit steps in a step of the field, a whole number.
    pub substeps: f64,
}

/// Velocities at the nodes, m/s along and to the right of the mean flow; row after row along the flow.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    pub u: Vec<f64>,
    pub v: Vec<f64>,
}

/// Why a meander cannot be computed on its grid.
pub struct MeshFault {
    /// The parameter of a scenario's `flow` that is to be changed.
    pub param: &'static str,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub mend: String,
}

/// Why a meander cannot be computed on its grid, if it cannot.
pub fn mesh_fault(meander: &Meander, frame: &FlowFrame, mean_speed: f64) -> Option<MeshFault> {
    let fault = |param: &'static str, message: String, mend: String| Some(MeshFault { param, message, mend });
    let (fastest, cell) = (meander.fastest(mean_speed), meander.side(mean_speed));
    let least = fastest * cell;
    if meander.viscosity < least {
        let message = format!(
            "`viscosity` of `flow` is {} m2/s: too little for cells of {} m in a flow of up to {fastest:.2} m/s",
            number(meander.viscosity),
            number(cell)
        );
        let (enough, smaller) = ((least * 10.0).ceil() / 10.0, rounded_down(meander.viscosity / fastest));
        return fault("viscosity", message, format!("make it {enough} m2/s or more, or `cell` {smaller} m or less"));
    }
    let nodes = (frame.length / cell + 1.0) * (frame.width / cell + 1.0);
    if nodes > NODES_MAX {
        let cell = number(cell);
        let message = format!("cells of {cell} m over the region make more than {NODES_MAX} nodes");
        return fault("cell", message, "make `cell` larger, or the region smaller".into());
    }
    let mesh = Mesh::new(meander, frame, mean_speed);
    if mesh.substeps > SUBSTEPS_MAX {
        let message = format!("a flow that meanders so needs more than {SUBSTEPS_MAX} sub-steps to be stable");
        return fault("cell", message, "make `cell` larger, or `viscosity` smaller".into());
    }
    let transit = frame.length / mean_speed;
    let work = transit / meander.step() * mesh.substeps * mesh.nodes() as f64;
    if work > SPIN_UP_WORK_MAX {
        let message = format!(
            "the flow is so slow that it takes {} to cross the region: its meander is computed for as long before a run",
            about(transit)
        );
        return fault("mean", message, "make it faster, `cell` larger, or the region smaller".into());
    }
    None
}

/// A time in words.
fn about(seconds: f64) -> String {
    match seconds / 3600.0 {
        hours if hours < 1000.0 => format!("{hours:.0} h"),
        hours if hours < 1e6 => format!("{:.0} days", hours / 24.0),
        _ => "many years".into(),
    }
}

impl Mesh {
    /// The mesh of a meander over a box.
    pub fn new(meander: &Meander, frame: &FlowFrame, speed: f64) -> Self {
        let cell = meander.side(speed);
        let count = |length: f64| (length / cell).round().max(2.0);
        let (nx, ny) = (count(frame.length), count(frame.width));
        let (dx, dy) = (frame.length / nx, frame.width / ny);
        let d = 0.5 * meander.viscosity;
        // Forward in time, centred in space: 2 D dt (1/dx^2 + 1/dy^2) <= 1 and u^2 dt <= 2 D.
        let speed = meander.fastest(speed);
        let rate = (2.0 * d * (1.0 / (dx * dx) + 1.0 / (dy * dy))).max(2.0 * speed * speed / (2.0 * d));
        let substeps = (meander.step() * rate / STABILITY).ceil().max(1.0);
        Mesh { columns: nx as usize + 1, rows: ny as usize + 1, dx, dy, substeps }
    }

    /// How many nodes it has.
    pub fn nodes(&self) -> usize {
        self.columns * self.rows
    }
}
