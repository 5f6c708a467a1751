//! The water's motion: a mean flow, and the field of its meanders where a scenario asks for one.

mod cells;
mod coloured_noise;
mod field;
mod frame;
mod mesh;

pub use cells::Cells;
pub use frame::FlowFrame;
pub use mesh::mesh_fault;

use crate::scenario::Flow;
use albacore_geometry::{Area, Point, Vector};
use field::Field;

/// The water of a run.
#[derive(Clone, Debug)]
pub struct Water {
    mean: Vector,
    frame: FlowFrame,
    field: Option<Field>,
}

impl Water {
    /// The water of a scenario, spun up and ready from `begin` seconds (0 or before) on.
    pub fn new(flow: &Flow, region: Option<&Area>, begin: f64, seed: u64) -> Self {
        let frame = FlowFrame::new(flow, region);
        let field = flow.meander.as_ref().map(|meander| Field::new(meander, &frame, begin, flow.mean.length(), seed));
        Water { mean: flow.mean, frame, field }
    }

    /// The coordinates along the mean flow that the field and the plume live in.
    pub fn frame(&self) -> &FlowFrame {
        &self.frame
    }

    /// Computes the field up to a time, s. Times up to one field step before it stay known.
    pub fn advance_to(&mut self, time: f64) {
        if let Some(field) = &mut self.field {
            field.advance_to(time);
        }
    }

    /// The velocity at a point and time, m/s toward; beyond the grid, that of its nearest edge.
    pub fn velocity(&self, p: Point, time: f64) -> Vector {
        match &self.field {
            None => self.mean,
            Some(field) => {
                let (x, y) = self.frame.to_local(p);
                let (u, v) = field.velocity(x, y, time);
                self.frame.to_vector(u, v)
            }
        }
    }

    /// The field frozen at a time, made for many look-ups.
    pub fn frozen(&self, time: f64, cells: &mut Cells) {
        match &self.field {
            None => cells.uniform(self.mean.length()),
            Some(field) => field.frozen(time, cells),
        }
    }
}
