//! How a vehicle meets a plume: what a straight probe reads on its way up the centreline of a plume frozen in time.

use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point};

/// Distance between samples, m: a 2 m/s vehicle with a sensor of 10 Hz.
pub const SAMPLE_M: f64 = 0.2;
/// Time between samples, s.
pub const SAMPLE_S: f64 = 0.1;
/// The centreline is the mean of the filaments in bins of this length along the flow, m.
const BIN_M: f64 = 20.0;

/// What probes met, by distance from the source.
#[derive(Clone, Debug, Default)]
pub struct Probe {
    /// One for each band, nearest first.
    pub bands: Vec<Band>,
}

/// What probes met in one band of distances.
#[derive(Clone, Debug, Default)]
pub struct Band {
    /// Distances from the source along the flow, m.
    pub from: f64,
    /// To here, which is not in it.
    pub to: f64,
    /// Samples taken.
    pub samples: u32,
    /// Of these above the threshold.
    pub on: u32,
    /// Times from one sample above the threshold to the next, where at least one between them was not: in samples.
    pub gaps: Vec<u32>,
}

impl Probe {
    /// Nothing met yet, in bands that begin where the one before ends.
    pub fn new(edges: &[f64]) -> Self {
        let bands = edges.windows(2).map(|edge| Band { from: edge[0], to: edge[1], ..Band::default() });
        Probe { bands: bands.collect() }
    }

    /// One way from the farthest band to the source. `filaments` are where they are, `reads` says whether a place reads above
    /// the threshold.
    pub fn fly(
        &mut self,
        source: Point,
        down_flow: Heading,
        filaments: impl Iterator<Item = Point>,
        mut reads: impl FnMut(Point) -> bool,
    ) {
        let (Some(first), Some(last)) = (self.bands.first(), self.bands.last()) else { return };
        let (near, far) = ((first.from / SAMPLE_M).round() as u32, (last.to / SAMPLE_M).round() as u32);
        let mut bins = vec![(0.0, 0.0); (last.to / BIN_M) as usize + 1];
        for place in filaments {
            let d = place - source;
            if let Some((sum, n)) = bins.get_mut((d.along(down_flow).max(0.0) / BIN_M) as usize) {
                (*sum, *n) = (*sum + d.right_of(down_flow), *n + 1.0);
            }
        }
        let (along, across) = (down_flow.unit(), (down_flow + PI / 2.0).unit());
        let mut last = None;
        for sample in (near..far).rev() {
            let distance = f64::from(sample) * SAMPLE_M;
            let (sum, n) = bins[(distance / BIN_M) as usize];
            let Some(band) = self.bands.iter_mut().find(|b| b.from <= distance && distance < b.to) else { continue };
            band.samples += 1;
            // Where there is no filament there is no centreline, and nothing to read.
            if n > 0.0 && reads(source + distance * along + (sum / n) * across) {
                band.on += 1;
                band.gaps.extend(last.map(|last: u32| last - sample).filter(|&gap| gap > 1));
                last = Some(sample);
            }
        }
    }
}

impl Band {
    /// The share of the samples above the threshold.
    pub fn on_fraction(&self) -> f64 {
        f64::from(self.on) / f64::from(self.samples.max(1))
    }

    /// The gap that a share of them is shorter than, s.
    pub fn gap(&self, share: f64) -> f64 {
        let mut gaps = self.gaps.clone();
        gaps.sort_unstable();
        let rank = ((gaps.len() as f64 * share) as usize).min(gaps.len().saturating_sub(1));
        gaps.get(rank).map_or(f64::NAN, |&gap| f64::from(gap) * SAMPLE_S)
    }
}
