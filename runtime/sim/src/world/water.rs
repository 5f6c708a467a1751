//! The water's motion: a mean flow with its tides, and the field of its meanders where a scenario asks for one.

mod cells;
mod coloured_noise;
mod current;
mod field;
mod frame;
mod mesh;
mod settings;
mod waves;

pub use cells::Cells;
pub use current::Current;
pub use frame::FlowFrame;
pub use mesh::mesh_fault;
pub use settings::{Flow, MeanFlow, Meander, Tide, Turning, UpperFlow, Waves};
pub(crate) use settings::{check, check_meander};
pub use waves::Sea;

use albacore_geometry::{Area, Point, Vector};
use field::Field;

/// The water of a run.
#[derive(Clone, Debug)]
pub struct Water {
    mean: Vector,
    /// What the whole water does beyond the mean, if it does.
    current: Option<Current>,
    frame: FlowFrame,
    field: Option<Field>,
}

impl Water {
    /// The water of a scenario, spun up and ready from `begin` seconds (0 or before) on. Times up to `behind` seconds before the newest
    /// that was asked for stay known.
    pub fn new(flow: &Flow, region: Option<&Area>, begin: f64, behind: f64, seed: u64) -> Self {
        let frame = FlowFrame::new(flow, region);
        let current = Some(Current::new(flow)).filter(|current| !current.is_steady());
        let mut water = Water { mean: flow.mean, current, frame, field: None };
        if let Some(meander) = &flow.meander {
            let mut field = Field::new(meander, &water.frame, begin, behind, flow, seed);
            field.advance_to(begin, |time| water.carried(time));
            water.field = Some(field);
        }
        water
    }

    /// The coordinates along the mean flow that the field and the plume live in.
    pub fn frame(&self) -> &FlowFrame {
        &self.frame
    }

    /// Computes the field up to a time, s.
    pub fn advance_to(&mut self, time: f64) {
        let Some(mut field) = self.field.take() else { return };
        field.advance_to(time, |time| self.carried(time));
        self.field = Some(field);
    }

    /// The velocity at a point and time, m/s toward; beyond the grid, that of its nearest edge.
    pub fn velocity(&self, p: Point, time: f64) -> Vector {
        let local = match &self.field {
            None => self.mean,
            Some(field) => {
                let (x, y) = self.frame.to_local(p);
                let (u, v) = field.velocity(x, y, time);
                self.frame.to_vector(u, v)
            }
        };
        self.current.as_ref().map_or(local, |current| local + current.beyond_mean(time))
    }

    /// The whole flow frozen at a time, made for many look-ups.
    pub fn frozen(&self, time: f64, cells: &mut Cells) {
        match &self.field {
            None => cells.uniform(self.mean.length()),
            Some(field) => field.frozen(time, cells),
        }
        cells.carry(self.carried(time));
    }

    /// What the whole water does beyond the mean at a time, along the mean flow and to its right, m/s.
    fn carried(&self, time: f64) -> (f64, f64) {
        self.current.as_ref().map_or((0.0, 0.0), |current| self.frame.of_vector(current.beyond_mean(time)))
    }
}
