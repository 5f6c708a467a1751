//! A clause of a scenario with its numbers computed.

use albacore_geometry::{Area, Heading, Point, Vector};
use albacore_lang::{ScenarioClause, ScenarioValue};
use albacore_program::{AREA_CORNER_WORDS, Slot};

/// A clause, and the words that its arguments point into.
pub struct Clause<'a> {
    pub clause: &'a ScenarioClause,
    pub words: &'a [f64],
}

impl<'a> Clause<'a> {
    fn value(&self, name: &str) -> Option<&'a ScenarioValue> {
        self.clause.args.iter().find(|arg| arg.name == name).map(|arg| &arg.value)
    }

    fn slot(&self, name: &str) -> Result<Slot, String> {
        match self.value(name) {
            Some(ScenarioValue::Words(slot, _)) => Ok(*slot),
            _ => Err(format!("`{}` has no `{name}`", self.clause.name)),
        }
    }

    fn word(&self, slot: Slot) -> f64 {
        self.words.get(slot as usize).copied().unwrap_or(0.0)
    }

    pub fn number(&self, name: &str) -> Result<f64, String> {
        Ok(self.word(self.slot(name)?))
    }

    pub fn heading(&self, name: &str) -> Result<Heading, String> {
        Ok(Heading::from_radians(self.number(name)?))
    }

    pub fn point(&self, name: &str) -> Result<Point, String> {
        let at = self.slot(name)?;
        Ok(Point::new(self.word(at), self.word(at + 1)))
    }

    /// A list of points: how many there are, then each.
    pub fn points(&self, name: &str) -> Result<Vec<Point>, String> {
        let at = self.slot(name)?;
        let slots = (0..self.word(at) as u32).map(|i| at + 1 + 2 * i);
        Ok(slots.map(|slot| Point::new(self.word(slot), self.word(slot + 1))).collect())
    }

    /// A point that may be absent.
    pub fn optional_point(&self, name: &str) -> Result<Option<Point>, String> {
        let at = self.slot(name)?;
        Ok((self.word(at) != 0.0).then(|| Point::new(self.word(at + 1), self.word(at + 2))))
    }

    pub fn vector(&self, name: &str) -> Result<Vector, String> {
        let at = self.slot(name)?;
        Ok(Vector::new(self.word(at), self.word(at + 1)))
    }

    pub fn area(&self, name: &str) -> Result<Area, String> {
        let at = self.slot(name)?;
        let corners: Vec<Point> = (0..self.word(at) as u32)
            .map(|i| at + 1 + AREA_CORNER_WORDS * i)
            .map(|slot| Point::new(self.word(slot), self.word(slot + 1)))
            .collect();
        Area::polygon(&corners).map_err(|error| format!("`{name}`: {error}"))
    }

    pub fn text(&self, name: &str) -> Result<String, String> {
        match self.value(name) {
            Some(ScenarioValue::Text(text)) => Ok(text.clone()),
            _ => Err(format!("`{}` has no `{name}`", self.clause.name)),
        }
    }

    pub fn clause(&self, name: &str) -> Option<Clause<'a>> {
        match self.value(name) {
            Some(ScenarioValue::Clause(clause)) => Some(Clause { clause, ..*self }),
            _ => None,
        }
    }
}
