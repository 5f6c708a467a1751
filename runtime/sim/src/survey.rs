//! The plume at one moment, for looks at as many places as one likes: for pictures and statistics.

use crate::plume::Index;
use crate::water::FlowFrame;
use albacore_geometry::Point;

/// The chemical in the water at one moment. Making it costs about as much as one step of the plume; a look, next to nothing.
#[derive(Clone, Debug)]
pub struct Survey {
    pub(crate) frame: FlowFrame,
    /// None where there is no plume.
    pub(crate) index: Option<Index>,
}

impl Survey {
    /// What a perfect chemical sensor without saturation would read at a point and a height above the bottom (m): a ratio of
    /// full scale.
    pub fn concentration(&self, p: Point, height: f64) -> f64 {
        let (x, y) = self.frame.to_local(p);
        self.index.as_ref().map_or(0.0, |index| index.reading([x, y, height]))
    }

    /// How many filaments are alive.
    pub fn filaments(&self) -> usize {
        self.index.as_ref().map_or(0, Index::len)
    }
}
