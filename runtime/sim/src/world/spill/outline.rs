//! The outlines of spills: how far they are from their centre in each direction.

use crate::noise::Noise;
use albacore_geometry::math::{TAU, cos, degrees, sin};
use albacore_geometry::{Heading, OUTLINE_CORNERS, Vector};
use serde::Deserialize;

/// Directions in which the distance is known: each degree, as in Eq. 23.
pub(super) const DIRECTIONS: usize = OUTLINE_CORNERS as usize;
/// An outline comes no nearer to its centre than this share of its radius: one that was drawn so is drawn anew.
const NEAREST: f64 = 0.1;
/// After so many draws in vain the amplitudes are halved.
const DRAWS_MAX: u64 = 200;

/// The shape of an outline.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the standard library says what each parameter is")]
pub enum Outline {
    /// An ellipse.
    Ellipse { length: f64, width: f64, along: Heading },
    /// A circle that is deformed by Fourier orders, drawn for each seed.
    Fourier { radius: f64, order: u32, amplitude: f64 },
}

/// How far an outline is from its centre, m, in each direction from north on, clockwise.
#[derive(Clone, Debug)]
pub(super) struct Radii(pub(super) Vec<f64>);

impl Radii {
    pub fn new(shape: &Outline, noise: Noise) -> Self {
        match *shape {
            Outline::Ellipse { length, width, along } => {
                let (long, wide) = (0.5 * length, 0.5 * width);
                Radii::of(|angle| {
                    let (s, c) = (sin(angle - along.radians()), cos(angle - along.radians()));
                    long * wide / ((wide * c) * (wide * c) + (long * s) * (long * s)).sqrt()
                })
            }
            Outline::Fourier { radius, order, amplitude } => {
                let mut most = amplitude * radius;
                let mut drawn = Radii::fourier(radius, order, most, noise, 0);
                for draw in 1.. {
                    if drawn.0.iter().all(|r| *r >= NEAREST * radius) {
                        break;
                    }
                    most *= if draw % DRAWS_MAX == 0 { 0.5 } else { 1.0 };
                    drawn = Radii::fourier(radius, order, most, noise, draw);
                }
                drawn
            }
        }
    }

    /// Eq. 23, with an amplitude of each order between plus and minus so much, m: the draw of a number.
    fn fourier(radius: f64, order: u32, most: f64, noise: Noise, draw: u64) -> Self {
        let first = draw * 2 * (u64::from(order) + 1);
        let uniform = |index: u64| 2.0 * noise.uniform(first + index) - 1.0;
        let orders: Vec<(f64, f64, f64)> = (0..=order)
            .map(|i| (f64::from(i), most * uniform(2 * u64::from(i)), 0.5 * TAU * uniform(2 * u64::from(i) + 1)))
            .collect();
        Radii::of(|angle| radius + orders.iter().map(|(i, a, phase)| a * cos(i * angle + phase)).sum::<f64>())
    }

    fn of(radius: impl Fn(f64) -> f64) -> Self {
        Radii((0..DIRECTIONS).map(|i| radius(TAU * i as f64 / DIRECTIONS as f64)).collect())
    }

    /// The corners of the outline from its centre, m.
    pub fn corners(&self) -> impl Iterator<Item = Vector> + '_ {
        self.0.iter().enumerate().map(|(i, r)| *r * Heading::from_radians(TAU * i as f64 / DIRECTIONS as f64).unit())
    }

    /// How far inside the outline a place is, m; outside less than 0. Straight across the outline, as long as that is not far.
    pub fn inside(&self, from_centre: Vector) -> f64 {
        let angle = degrees(from_centre.toward().radians()) * (DIRECTIONS as f64 / 360.0);
        let (whole, part) = (angle as usize, angle.fract());
        let (here, next) = (self.0[whole % DIRECTIONS], self.0[(whole + 1) % DIRECTIONS]);
        let radius = here + part * (next - here);
        let slope = (next - here) * DIRECTIONS as f64 / TAU / radius;
        (radius - from_centre.length()) / (1.0 + slope * slope).sqrt()
    }
}
