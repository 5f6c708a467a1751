//! The temperature and the salinity of the water, over its depth and across a front: what a scenario says of them, and what of
//! that cannot be.

use crate::scenario::{Scenario, ScenarioIssues};
use crate::world::front::Front;
use albacore_geometry::Point;
use albacore_geometry::math::tanh;
use serde::Deserialize;
use std::ops::RangeInclusive;

/// Two water masses, one above the other, and the layer between them in which the one passes into the other: everywhere and
/// always the same, but across a front. Between them temperature and salinity go as the hyperbolic tangent of the depth, the
/// profile of the mixing layer in the stability theory of stratified flows (Hazel 1972, J. Fluid Mech. 51, 39-61).
///
/// The default is mixed water of 10 degrees and a practical salinity of 35.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stratification {
    /// Temperature far above the thermocline, degrees Celsius.
    pub surface: f64,
    /// And far below it.
    pub bottom: f64,
    /// Practical salinity (PSS-78) far above the thermocline.
    pub surface_salinity: f64,
    /// And far below it.
    pub bottom_salinity: f64,
    /// The depth of its middle, m.
    pub thermocline: f64,
    /// Its thickness, m: in its middle the temperature changes as if all of the change were evenly spread over so much.
    pub thickness: f64,
    /// A front in both of them, which has a clause of its own.
    #[serde(skip)]
    pub front: Option<Front>,
}

impl Default for Stratification {
    fn default() -> Self {
        Stratification {
            surface: 10.0,
            bottom: 10.0,
            surface_salinity: 35.0,
            bottom_salinity: 35.0,
            thermocline: 10.0,
            thickness: 4.0,
            front: None,
        }
    }
}

impl Stratification {
    /// Temperature (degrees Celsius) and practical salinity at a place, a depth (m) and a time (s of the run).
    pub fn at(&self, p: Point, depth: f64, time: f64) -> (f64, f64) {
        let (temperature, salinity) = self.layers(depth);
        let (warmer, saltier) = self.front.as_ref().map_or((0.0, 0.0), |front| front.adds(p, time));
        (temperature + warmer, salinity + saltier)
    }

    /// The same without a front.
    fn layers(&self, depth: f64) -> (f64, f64) {
        // How much of the lower water it is, 0 to 1; the slope of half the tangent of 2 x / h is 1 / h in the middle.
        let lower = 0.5 * (1.0 + tanh(2.0 * (depth - self.thermocline) / self.thickness));
        let between = |above: f64, below: f64| above + lower * (below - above);
        (between(self.surface, self.bottom), between(self.surface_salinity, self.bottom_salinity))
    }
}

/// What water can have, degrees Celsius and practical salinity: as the ranges of `stratification` say it of each layer.
const TEMPERATURES: RangeInclusive<f64> = -2.0..=40.0;
const SALINITIES: RangeInclusive<f64> = 0.0..=42.0;

/// What of the water's layers cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let s = &scenario.environment.stratification;
    let other = s.front.as_ref().map(|front| (front.warmer, front.saltier));
    if let Some((warmer, saltier)) = other {
        let warm = [s.surface + warmer, s.bottom + warmer];
        let salty = [s.surface_salinity + saltier, s.bottom_salinity + saltier];
        let (mut front, mend) = (objections.of("front"), "make the difference smaller, or change `stratification`");
        for (param, there, water, unit) in
            [("warmer", warm, &TEMPERATURES, "degC"), ("saltier", salty, &SALINITIES, "psu")]
        {
            if let Some(there) = there.into_iter().find(|there| !water.contains(there)) {
                let (least, most) = (water.start(), water.end());
                let message = format!(
                    "far to starboard the water has {there} {unit}: it is to have {least} {unit} to {most} {unit}"
                );
                front.unless(Some(param), false, message, mend);
            }
        }
    }
    for (warmer, saltier) in std::iter::once((0.0, 0.0)).chain(other) {
        let of = |temperature: f64, salinity: f64| density(temperature + warmer, (salinity + saltier).max(0.0));
        let (above, below) = (of(s.surface, s.surface_salinity), of(s.bottom, s.bottom_salinity));
        objections.of("stratification").unless(
            None,
            below >= above - SAME_DENSITY,
            format!("this water is lighter below ({below:.1} kg/m3) than above ({above:.1} kg/m3): it would turn over"),
            "make it colder below, or saltier",
        );
    }
}

/// The density of sea water at the surface, kg/m3, at a temperature (degrees Celsius) and a practical salinity: the one-atmosphere
/// equation of EOS-80 (Millero & Poisson 1981, Deep-Sea Res. 28A, 625-629).
fn density(temperature: f64, salinity: f64) -> f64 {
    let polynomial = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * temperature + c);
    let pure = polynomial(&[999.842594, 6.793952e-2, -9.095290e-3, 1.001685e-4, -1.120083e-6, 6.536332e-9]);
    let linear = polynomial(&[8.24493e-1, -4.0899e-3, 7.6438e-5, -8.2467e-7, 5.3875e-9]);
    let root = polynomial(&[-5.72466e-3, 1.0227e-4, -1.6546e-6]);
    pure + salinity * (linear + root * salinity.sqrt() + 4.8314e-4 * salinity)
}

/// Water is not told to turn over for less, kg/m3.
const SAME_DENSITY: f64 = 0.01;

#[cfg(test)]
mod tests {
    use super::*;

    /// The check values that UNESCO printed with the equation (Technical Papers in Marine Science 44, 1983).
    #[test]
    fn the_density_is_the_printed_one() {
        for (salinity, temperature, printed) in
            [(0.0, 5.0, 999.966_75), (0.0, 25.0, 997.047_96), (35.0, 5.0, 1_027.675_47), (35.0, 25.0, 1_023.343_06)]
        {
            assert!((density(temperature, salinity) - printed).abs() < 1e-5, "{salinity} {temperature}");
        }
    }

    #[test]
    fn the_water_is_that_of_the_surface_far_above_and_falls_as_steeply_as_it_says_in_the_middle() {
        let water = Stratification { surface: 18.0, bottom: 10.0, surface_salinity: 31.0, ..Stratification::default() };
        assert_eq!(water.layers(10.0), (14.0, 33.0));
        let ((warm, fresh), (cold, salt)) = (water.layers(0.0), water.layers(20.0));
        assert!((warm - 18.0).abs() < 1e-3 && (fresh - 31.0).abs() < 1e-3, "{warm} {fresh}");
        assert!((cold - 10.0).abs() < 1e-3 && (salt - 35.0).abs() < 1e-3, "{cold} {salt}");
        let slope = (water.layers(10.01).0 - water.layers(9.99).0) / 0.02;
        assert!((slope - -8.0 / 4.0).abs() < 1e-4, "{slope}");
        assert_eq!(Stratification::default().at(Point::ORIGIN, 3.0, 0.0), (10.0, 35.0));
    }
}
