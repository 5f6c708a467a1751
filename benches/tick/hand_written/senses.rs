//! The latest samples, and whether they are fresh enough.

use albacore_geometry::{Heading, Point, Vector};
use albacore_vehicle::{Sample, measurements};

/// The latest valid samples, and the ticks on which they came.
#[derive(Clone)]
pub struct Senses {
    pub position: Point,
    pub course: Heading,
    pub heading: Heading,
    pub flow: Vector,
    pub water_depth: Option<f64>,
    /// The largest concentration since the last tick.
    pub chemical_peak: f64,
    chemical: f64,
    position_at: Option<u64>,
    course_at: Option<u64>,
    heading_at: Option<u64>,
    flow_at: Option<u64>,
    chemical_at: Option<u64>,
}

impl Senses {
    pub fn new() -> Self {
        Senses {
            position: Point::ORIGIN,
            course: Heading::NORTH,
            heading: Heading::NORTH,
            // What holds before the first sample.
            flow: 0.12 * Heading::from_degrees(140.0).unit(),
            water_depth: None,
            chemical_peak: 0.0,
            chemical: 0.0,
            position_at: None,
            course_at: None,
            heading_at: None,
            flow_at: None,
            chemical_at: None,
        }
    }

    /// Whether all has come that has no value before its first sample.
    pub fn complete(&self) -> bool {
        self.position_at.is_some()
            && self.course_at.is_some()
            && self.heading_at.is_some()
            && self.chemical_at.is_some()
    }

    /// Takes in the samples of a tick.
    pub fn take_in(&mut self, tick: u64, samples: &[Sample]) {
        self.chemical_peak = self.chemical;
        for sample in samples {
            let [a, b, ..] = sample.reading;
            if !a.is_finite() || !b.is_finite() {
                continue;
            }
            match sample.measurement {
                measurements::POSITION => {
                    self.position = Point::new(a, b);
                    self.position_at = Some(tick);
                }
                measurements::COURSE => {
                    self.course = Heading::from_radians(a);
                    self.course_at = Some(tick);
                }
                measurements::HEADING => {
                    self.heading = Heading::from_radians(a);
                    self.heading_at = Some(tick);
                }
                measurements::FLOW => {
                    self.flow = Vector::new(a, b);
                    self.flow_at = Some(tick);
                }
                measurements::CHEMICAL => {
                    let first = self.chemical_at != Some(tick);
                    self.chemical_peak = if first { a } else { self.chemical_peak.max(a) };
                    self.chemical = a;
                    self.chemical_at = Some(tick);
                }
                measurements::WATER_DEPTH => self.water_depth = Some(a),
                _ => {}
            }
        }
    }
}

/// What the mission does about what it requires.
#[derive(PartialEq)]
pub enum Verdict {
    Fresh,
    Hold,
    Abort,
}

/// Since when a required input has been too old.
#[derive(Clone, Default)]
pub struct Freshness {
    held_since: Option<u64>,
}

impl Freshness {
    /// position, course, heading fresh 5 s, else abort; chemical fresh 2 s, else hold for 30 s; flow fresh 30 s, else hold
    /// for 60 s.
    pub fn check(&mut self, senses: &Senses, tick: u64) -> Verdict {
        let required = [
            (senses.position_at, 50, 0),
            (senses.course_at, 50, 0),
            (senses.heading_at, 50, 0),
            (senses.chemical_at, 20, 300),
            (senses.flow_at, 300, 600),
        ];
        let mut patience = None;
        for (came, fresh, held) in required {
            if came.is_some_and(|came| tick - came > fresh) {
                patience = Some(patience.map_or(held, |p: u64| p.min(held)));
            }
        }
        let Some(patience) = patience else {
            self.held_since = None;
            return Verdict::Fresh;
        };
        let since = *self.held_since.get_or_insert(tick);
        if tick - since >= patience { Verdict::Abort } else { Verdict::Hold }
    }
}
