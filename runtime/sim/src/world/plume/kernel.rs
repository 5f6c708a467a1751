//! What one filament adds to the reading at a point.

use crate::world::plume::block::folded;
use crate::world::plume::{Filament, Plume};
use albacore_geometry::math::exp;

/// A filament ends at this many radii: what is cut off is below 4e-6 of its peak.
pub const CUT_RADII: f64 = 5.0;

/// The Gaussian of a source's filaments, as a ratio of the sensor's full scale.
#[derive(Clone, Debug)]
pub struct Kernel {
    peak: f64,
    /// Squared radius at release and its growth, m2 and m2/s.
    initial: f64,
    growth: f64,
    /// Squared radius at the age that `peak` is for.
    reference: f64,
    layer: Option<f64>,
}

impl Kernel {
    /// The kernel of filaments that read `peak` in their middle at an age (s), in a plume.
    pub fn new(peak: f64, reference_age: f64, plume: &Plume) -> Self {
        let initial = plume.initial_radius * plume.initial_radius;
        let reference = initial + plume.growth * reference_age;
        Kernel { peak, initial, growth: plume.growth, reference, layer: plume.layer }
    }

    /// Squared radius at an age, m2: r2 = R0^2 + gamma age.
    pub fn squared_radius(&self, age: f64) -> f64 {
        self.initial + self.growth * age
    }

    /// The reading in the middle of a filament of a squared radius, m2, that no wall is near.
    ///
    /// Flat: peak r2_ref / r2. In a layer: peak (r2_ref / r2)^1.5.
    pub fn strength(&self, r2: f64) -> f64 {
        let thinning = self.reference / r2;
        if self.layer.is_some() { self.peak * thinning * thinning.sqrt() } else { self.peak * thinning }
    }

    /// The reading of a filament at a place (m), `before` seconds before the time it stands at and at an age.
    pub fn reading(&self, filament: &Filament, before: f64, age: f64, place: [f64; 3]) -> f64 {
        let r2 = self.squared_radius(age);
        let [x, y, z] = filament.at(before);
        let share = share([x, y, self.layer.map_or(z, |ceiling| folded(z, ceiling))], r2, self.layer, place);
        if share > 0.0 { self.strength(r2) * share } else { 0.0 }
    }
}

/// What share of its strength a filament at `center`, of squared radius `r2`, reads at a place.
///
/// Flat: exp(-d2 / 2 r2). In a layer of height H: the sum of that over the filament and its mirror images at -z and 2H - z, and
/// theirs in turn.
#[inline]
pub fn share(center: [f64; 3], r2: f64, layer: Option<f64>, place: [f64; 3]) -> f64 {
    let [x, y, z] = center;
    let (dx, dy) = (x - place[0], y - place[1]);
    let d2 = dx * dx + dy * dy;
    let far = CUT_RADII * CUT_RADII * r2;
    if d2 > far {
        return 0.0;
    }
    let Some(ceiling) = layer else { return exp(-d2 / (2.0 * r2)) };
    let mut sum = 0.0;
    for image in [z, -z, 2.0 * ceiling - z, 2.0 * ceiling + z, z - 2.0 * ceiling] {
        let dz = image - place[2];
        let squared = d2 + dz * dz;
        if squared <= far {
            sum += exp(-squared / (2.0 * r2));
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filament(z: f64) -> Filament {
        Filament { source: 0, number: 0, birth: 0.0, x: 10.0, y: 20.0, z, velocity: [0.125, 0.0, 0.0] }
    }

    #[test]
    fn a_far_end_filament_peaks_at_twice_the_threshold() {
        let kernel = Kernel::new(0.08, 8752.0, &Plume::default());
        let at = |place, age| kernel.reading(&filament(0.2), 0.0, age, place);
        assert!((at([10.0, 20.0, 0.0], 8752.0) - 0.08).abs() < 1e-12);
        let radius = (0.04_f64 + 1e-4 * 8752.0).sqrt();
        assert!((at([10.0 + radius, 20.0, 0.0], 8752.0) - 0.08 * exp(-0.5)).abs() < 1e-12);
        assert!((at([10.0, 20.0, 0.0], 0.0) - 0.08 * 0.9152 / 0.04).abs() < 1e-12);
        assert_eq!(at([10.0 + 5.01 * radius, 20.0, 0.0], 8752.0), 0.0);
        assert!((kernel.reading(&filament(0.2), 0.8, 8752.0, [9.9, 20.0, 0.0]) - 0.08).abs() < 1e-12, "0.8 s ago");
    }

    /// Whatever its height, a filament in a layer holds the same amount: the images give back what the walls cut off.
    #[test]
    fn images_conserve_the_amount() {
        let plume = Plume { layer: Some(3.5), ..Plume::default() };
        let kernel = Kernel::new(0.08, 8752.0, &plume);
        for age in [0.0, 2000.0, 9000.0] {
            let amount = |z: f64| {
                let steps = 700;
                let dz = 3.5 / f64::from(steps);
                (0..steps)
                    .map(|i| kernel.reading(&filament(z), 0.0, age, [10.0, 20.0, (f64::from(i) + 0.5) * dz]))
                    .sum::<f64>()
                    * dz
            };
            let middle = amount(1.75);
            for z in [0.0, 0.2, 1.0, 3.4] {
                assert!((amount(z) / middle - 1.0).abs() < 1e-3, "{z} m at {age} s: {} of {middle}", amount(z));
            }
        }
    }
}
