//! Clauses in words: the name of each parameter and its value, as a person writes it.

use super::{ShownClause, ValueSource};
use albacore_geometry::{Point, TangentFrame, Vector};
use albacore_lang::{ScenarioClause, ScenarioValue};
use albacore_program::seen::one_line;
use albacore_program::{AREA_CORNER_WORDS, Display, Shape, number};
use albacore_sim::Grid;

/// Tells clauses of one scenario.
pub(super) struct ClauseFormatter<'a> {
    /// The words that their arguments point into.
    pub words: &'a [f64],
    /// Where the scenario lies on the globe, if it does.
    pub frame: Option<TangentFrame>,
}

impl ClauseFormatter<'_> {
    /// Adds a clause, and after it the clauses that are its values.
    pub fn push_clause(&self, clause: &ScenarioClause, outer: &str, source: ValueSource, shown: &mut Vec<ShownClause>) {
        let name = if outer.is_empty() { clause.name.clone() } else { format!("{outer} {}", clause.name) };
        let values = clause.args.iter().filter_map(|arg| {
            let text = self.value(&arg.value)?;
            Some((arg.name.clone(), text, if arg.is_default { ValueSource::Default } else { source }))
        });
        shown.push(ShownClause { name: name.clone(), source, values: values.collect() });
        for arg in &clause.args {
            if let ScenarioValue::Clause(nested) = &arg.value
                && !nested.args.is_empty()
            {
                self.push_clause(nested, &name, source, shown);
            }
        }
    }

    fn value(&self, value: &ScenarioValue) -> Option<String> {
        match value {
            ScenarioValue::Text(text) => Some(format!("\"{}\"", one_line(text))),
            ScenarioValue::Words(slot, shape) => {
                let words = self.words.get(*slot as usize..).unwrap_or(&[]);
                Some(self.text(shape, words.get(..shape.words() as usize).unwrap_or(words)))
            }
            // What has no parameters is said by its name.
            ScenarioValue::Clause(value) => value.args.is_empty().then(|| value.name.clone()),
        }
    }

    fn text(&self, shape: &Shape, words: &[f64]) -> String {
        match (shape, words) {
            (Shape::Vector(display), &[north, east]) => vector(display, Vector::new(north, east)),
            (Shape::Point, &[north, east]) => self.point(Point::new(north, east)),
            (Shape::Area(_), [count, corners @ ..]) => {
                let corners = corners.chunks(AREA_CORNER_WORDS as usize).take(*count as usize);
                self.area(corners.map(|c| Point::new(c[0], c[1])))
            }
            (Shape::List(item, _), [count, items @ ..]) => {
                let items = items.chunks(item.words().max(1) as usize).take(*count as usize);
                items.map(|words| self.text(item, words)).collect::<Vec<_>>().join("\n")
            }
            _ => number::brief(&[], shape, words),
        }
    }

    /// What a survey came to be: where its corners lie, how large it is, and how deep.
    pub fn survey(&self, grid: &Grid) -> Vec<(String, String, ValueSource)> {
        let Grid { south_west, north_east, rows, columns, depths } = grid;
        let size = *north_east - *south_west;
        let length = |m: f64| if m < 10_000.0 { format!("{m:.1} m") } else { format!("{:.1} km", m / 1000.0) };
        let (step, across) = (size.north / f64::from(rows - 1), size.east / f64::from(columns - 1));
        let ends = |(low, high): (f64, f64), depth: &f64| (low.min(*depth), high.max(*depth));
        let (least, most) = depths.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        let land = depths.iter().filter(|depth| **depth <= 0.0).count();
        let on_land = if land == 0 { String::new() } else { format!(", {land} cells on land") };
        let told = [
            ("south-west", self.point(*south_west)),
            ("north-east", self.point(*north_east)),
            ("size", format!("{} north, {} east", length(size.north), length(size.east))),
            ("cells", format!("{rows} x {columns}, each {} x {}", length(step), length(across))),
            ("depths", format!("{least:.1} m to {most:.1} m{on_land}")),
        ];
        told.into_iter().map(|(name, value)| (name.to_string(), value, ValueSource::Said)).collect()
    }

    /// Each corner on a line.
    pub fn area(&self, corners: impl Iterator<Item = Point>) -> String {
        corners.map(|corner| self.point(corner)).collect::<Vec<_>>().join("\n")
    }

    /// A place in the frame, and on the globe if it lies there.
    pub fn point(&self, p: Point) -> String {
        let local = number::point(p);
        match self.frame {
            Some(frame) => format!("{} {local}", frame.to_geodetic(p)),
            None => local,
        }
    }
}

/// How fast, and whither.
pub(super) fn vector(display: &Display, vector: Vector) -> String {
    let size = number::brief(&[], &Shape::Quantity(display.clone()), &[vector.length()]);
    let toward = number::brief(&[], &Shape::Heading, &[vector.toward().radians()]);
    format!("{size} toward {toward}")
}
