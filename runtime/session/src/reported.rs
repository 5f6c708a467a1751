//! What a report holds, as a table of values that other programs read, and as the cells of a picture.

use albacore_geometry::{Area, Grid, Heading, Point, TangentFrame, Vector};
use albacore_program::{AREA_CORNER_WORDS, Display, GRID_WORDS, Program, ReportSite, Shape, calendar, number};
use albacore_trace::Cells;
use serde_json::{Map, Value, json};

/// Reads the words of reports.
pub(crate) struct Reader<'a> {
    pub program: &'a Program,
    /// Where the mission lies on the globe, if it does.
    pub frame: Option<TangentFrame>,
}

/// The values of a report in their order: the label, which is empty for the first, the shape, and the words.
pub(crate) fn fields<'a>(
    site: &'a ReportSite,
    words: &'a [f64],
) -> impl Iterator<Item = (&'a str, &'a Shape, &'a [f64])> {
    let mut rest = words;
    site.fields.iter().map(move |(label, value)| {
        let (field, after) = rest.split_at((value.shape.words() as usize).min(rest.len()));
        rest = after;
        (label.as_str(), &value.shape, field)
    })
}

impl Reader<'_> {
    /// A value as JSON. A quantity says its unit: `{"value": 12.5, "unit": "m"}`, and so does a list of them. Names of a record, of points and
    /// of maps are keys.
    pub fn json(&self, shape: &Shape, words: &[f64]) -> Value {
        match (self.bare(shape, words), unit(shape)) {
            (Value::Null, _) => Value::Null,
            (value, Some(unit)) => json!({ "value": value, "unit": unit }),
            (value, None) => value,
        }
    }

    fn bare(&self, shape: &Shape, words: &[f64]) -> Value {
        let word = |i: usize| words.get(i).copied().unwrap_or(f64::NAN);
        let place = |i: usize| self.place(Point::new(word(i), word(i + 1)));
        match shape {
            Shape::Bool => json!(word(0) != 0.0),
            Shape::Int => json!(word(0) as i64),
            Shape::Quantity(display) => json!(shown(word(0), display)),
            Shape::Heading => json!(Heading::from_radians(word(0)).degrees()),
            Shape::Depth | Shape::Altitude => json!(word(0)),
            Shape::Date => json!(calendar::written(word(0))),
            Shape::Point => place(0),
            Shape::Vector(display) => {
                json!({ "north": shown(word(0), display), "east": shown(word(1), display) })
            }
            Shape::Line | Shape::Edge => json!({ "start": place(0), "end": place(2) }),
            Shape::Area(_) => {
                let corners = corners(shape, words).unwrap_or_default();
                let surface = Area::polygon(&corners).map(|area| area.surface()).ok();
                let corners: Vec<Value> = corners.into_iter().map(|corner| self.place(corner)).collect();
                json!({ "corners": corners, "surface_m2": surface })
            }
            Shape::Text => json!(number::plain(&self.program.texts, word(0))),
            Shape::Enum(variants) => json!(variants.get(word(0) as usize)),
            Shape::Record(_, fields) => {
                let mut rest = words;
                let mut object = Map::new();
                for (label, shape) in fields {
                    let (field, after) = rest.split_at((shape.words() as usize).min(rest.len()));
                    rest = after;
                    object.insert(label.clone(), self.json(shape, field));
                }
                Value::Object(object)
            }
            Shape::Optional(_) if word(0) == 0.0 => Value::Null,
            Shape::Optional(shape) => self.bare(shape, words.get(1..).unwrap_or_default()),
            Shape::List(shape, _) => Value::Array(self.elements(shape, words).collect()),
            Shape::Map(shape, _) => {
                let grid = grid(words);
                json!({
                    "rows": grid.rows,
                    "columns": grid.columns,
                    "cell_m": grid.cell,
                    "corner": self.place(grid.corner),
                    "along_deg": grid.along.toward().degrees(),
                    "cells": self.elements(shape, words.get(GRID_WORDS as usize..).unwrap_or_default()).collect::<Vec<_>>(),
                })
            }
        }
    }

    fn elements<'w>(&'w self, shape: &'w Shape, words: &'w [f64]) -> impl Iterator<Item = Value> + 'w {
        let count = words.first().copied().unwrap_or(0.0) as usize;
        let width = (shape.words() as usize).max(1);
        words.get(1..).unwrap_or_default().chunks_exact(width).take(count).map(|element| self.bare(shape, element))
    }

    fn place(&self, p: Point) -> Value {
        let mut place = json!({ "north_m": p.north, "east_m": p.east });
        if let (Some(globe), Value::Object(place)) = (self.frame.as_ref().map(|frame| frame.to_geodetic(p)), &mut place)
        {
            place.insert("latitude_deg".to_string(), json!(globe.latitude_deg()));
            place.insert("longitude_deg".to_string(), json!(globe.longitude_deg()));
        }
        place
    }

    /// The cells of a map for a picture; none of what is no map, or holds no numbers.
    pub fn cells(&self, name: &str, shape: &Shape, words: &[f64]) -> Option<Cells> {
        let Shape::Map(element, _) = shape else { return None };
        let grid = grid(words);
        let cells = words.get(GRID_WORDS as usize + 1..)?.chunks_exact((element.words() as usize).max(1));
        let numbers: Vec<_> =
            cells.take((grid.rows * grid.columns) as usize).map(|cell| element.first_number(cell)).collect();
        let of = numbers.iter().flatten().map(|(shape, _)| *shape).next()?;
        let values = numbers.iter().map(|found| found.map_or(f64::NAN, |(_, x)| x)).collect();
        let cells = Cells { legend: String::new(), grid, values };
        let (low, high) = cells.range()?;
        let [low, high] = [low, high].map(|x| number::value(of, &[x]));
        let legend = if low == high { format!("{name}: {low} everywhere") } else { format!("{name}: {low} to {high}") };
        Some(Cells { legend, ..cells })
    }
}

/// The corners of an area; none of what is no area.
pub(crate) fn corners(shape: &Shape, words: &[f64]) -> Option<Vec<Point>> {
    let Shape::Area(_) = shape else { return None };
    let count = words.first().copied().unwrap_or(0.0) as usize;
    let corners = words.get(1..)?.chunks_exact(AREA_CORNER_WORDS as usize).take(count);
    Some(corners.map(|corner| Point::new(corner[0], corner[1])).collect())
}

/// The areas in a value, also those of a record or an optional, each with its name.
pub(crate) fn areas(name: &str, shape: &Shape, words: &[f64]) -> Vec<(String, Vec<Point>)> {
    match shape {
        Shape::Area(_) => corners(shape, words).map(|corners| (name.to_string(), corners)).into_iter().collect(),
        Shape::Optional(_) if words.first() != Some(&1.0) => Vec::new(),
        Shape::Optional(shape) => areas(name, shape, words.get(1..).unwrap_or_default()),
        Shape::Record(_, fields) => {
            let mut rest = words;
            let field = |(label, shape): &(String, Shape)| {
                let (field, after) = rest.split_at((shape.words() as usize).min(rest.len()));
                rest = after;
                areas(&format!("{name}.{label}"), shape, field)
            };
            fields.iter().flat_map(field).collect()
        }
        _ => Vec::new(),
    }
}

fn grid(words: &[f64]) -> Grid {
    let word = |i: usize| words.get(i).copied().unwrap_or(0.0);
    Grid {
        cell: word(0),
        corner: Point::new(word(1), word(2)),
        along: Vector::new(word(3), word(4)),
        rows: word(5) as u32,
        columns: word(6) as u32,
    }
}

fn shown(si: f64, display: &Display) -> f64 {
    if display.unit == "%" { si } else { si / display.scale }
}

/// The unit of a quantity, or of all that a list or map holds. A share of one has none.
pub(crate) fn unit(shape: &Shape) -> Option<String> {
    match shape {
        Shape::Quantity(display) | Shape::Vector(display) => {
            (!display.unit.is_empty() && display.unit != "%").then(|| display.unit.clone())
        }
        Shape::Heading => Some("deg".to_string()),
        Shape::Depth | Shape::Altitude => Some("m".to_string()),
        Shape::Optional(shape) | Shape::List(shape, _) | Shape::Map(shape, _) => unit(shape),
        _ => None,
    }
}
