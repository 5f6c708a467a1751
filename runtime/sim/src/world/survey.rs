//! The plume at one moment, for looks at as many places as one likes: for pictures and statistics.

use crate::world::plume::Index;
use crate::world::recorded::Still;
use crate::world::spill::Slick;
use crate::world::water::FlowFrame;
use albacore_geometry::Point;

/// The chemical in the water at one moment. Making it costs about as much as one step of the plume; a look, next to nothing.
#[derive(Clone, Debug)]
pub struct Survey {
    carried: Chemical,
    spilled: Vec<Slick>,
    time: f64,
}

#[derive(Clone, Debug)]
enum Chemical {
    None,
    Simulated(FlowFrame, Index),
    Recorded(Still),
}

impl Survey {
    /// Of a plume in the frame of its flow, if there is one, and of spills.
    pub(crate) fn simulated(frame: &FlowFrame, index: Option<Index>, slicks: &[Slick], time: f64) -> Self {
        let carried = index.map_or(Chemical::None, |index| Chemical::Simulated(frame.clone(), index));
        Survey { carried, spilled: slicks.to_vec(), time }
    }

    /// Of a recorded plume.
    pub(crate) fn recorded(still: Still) -> Self {
        Survey { carried: Chemical::Recorded(still), spilled: Vec::new(), time: 0.0 }
    }

    /// What a perfect chemical sensor without saturation would read at a point and a height above the bottom (m): a ratio of
    /// full scale.
    pub fn concentration(&self, p: Point, height: f64) -> f64 {
        let carried = match &self.carried {
            Chemical::None => 0.0,
            Chemical::Simulated(frame, index) => {
                let (x, y) = frame.to_local(p);
                index.reading([x, y, height])
            }
            Chemical::Recorded(still) => still.reading(p),
        };
        carried + self.spilled.iter().map(|slick| slick.concentration(p, self.time)).sum::<f64>()
    }

    /// How many filaments are alive.
    pub fn filaments(&self) -> usize {
        match &self.carried {
            Chemical::None => 0,
            Chemical::Simulated(_, index) => index.len(),
            Chemical::Recorded(still) => still.filaments(),
        }
    }
}
