//! How words are read: the shape of a value, for traces, texts and the values of a scenario.

use albacore_arithmetic::Interval;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a run of words means.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// 0 or 1.
    Bool,
    /// A whole number.
    Int,
    /// An SI quantity.
    Quantity(Display),
    /// Radians clockwise from north.
    Heading,
    /// Metres below the surface.
    Depth,
    /// Metres above the bottom.
    Altitude,
    /// Seconds since the beginning of 1970, UTC.
    Date,
    /// North and east, in metres.
    Point,
    /// North and east components.
    Vector(Display),
    /// Start and end.
    Line,
    /// A line and its outward normal.
    Edge,
    /// A count of corners, then room for so many: for each its point and the outward normal of the edge that begins there.
    Area(u32),
    /// Index into [`crate::Program::texts`].
    Text,
    /// The index of a variant.
    Enum(Arc<[String]>),
    /// Named fields, one after the other.
    Record(String, Vec<(String, Shape)>),
    /// 1 or 0, then the value, which means nothing after a 0.
    Optional(Box<Shape>),
    /// A count, then room for so many elements.
    List(Box<Shape>, u32),
    /// A grid: the side of a cell, the corner of the first, which way a row goes, rows, columns. Then the list of what so many cells at most
    /// hold, row by row.
    Map(Box<Shape>, u32),
}

/// How a quantity is shown to a person.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Display {
    /// The unit, as it is written.
    pub unit: String,
    /// SI units in one of it.
    pub scale: f64,
    /// Digits after the point.
    pub decimals: u8,
}

/// An area's words for each corner: its point and the outward normal of the edge that begins there.
pub const AREA_CORNER_WORDS: u32 = 4;
/// Words of an area that has room for so many corners.
pub const fn area_words(corners: u32) -> u32 {
    1 + AREA_CORNER_WORDS * corners
}
/// Words of an edge.
pub(crate) const EDGE_WORDS: u32 = 6;
/// Words of the rows across an area: what of them does not change from one to the next.
pub const ROWS_WORDS: u32 = 11;
/// Words of a place among rows.
pub const ROW_PLACE_WORDS: u32 = 3;
/// Words of a map's grid: the list of its cells is behind them.
pub const GRID_WORDS: u32 = 7;

impl Shape {
    /// Whether a text is in it, which means something only beside the texts of its program.
    pub fn has_text(&self) -> bool {
        match self {
            Shape::Text => true,
            Shape::Record(_, fields) => fields.iter().any(|(_, shape)| shape.has_text()),
            Shape::Optional(shape) | Shape::List(shape, _) | Shape::Map(shape, _) => shape.has_text(),
            _ => false,
        }
    }

    /// The point that a value of it is, or begins with: the first field of a record that is one. Gives the word where it stands.
    pub fn first_point(&self) -> Option<usize> {
        match self {
            Shape::Point => Some(0),
            Shape::Record(_, fields) => {
                let first = fields.iter().position(|(_, shape)| matches!(shape, Shape::Point))?;
                Some(fields[..first].iter().map(|(_, shape)| shape.words() as usize).sum())
            }
            _ => None,
        }
    }

    /// The number that a value of it is, or that the first field of a record is which is one; none of what is absent.
    pub fn first_number<'a>(&'a self, words: &[f64]) -> Option<(&'a Shape, f64)> {
        match self {
            Shape::Bool | Shape::Int | Shape::Quantity(_) | Shape::Heading | Shape::Depth | Shape::Altitude => {
                Some((self, *words.first()?))
            }
            Shape::Optional(shape) if words.first().is_some_and(|there| *there != 0.0) => {
                shape.first_number(words.get(1..)?)
            }
            Shape::Record(_, fields) => {
                let mut rest = words;
                fields.iter().find_map(|(_, shape)| {
                    let (field, after) = rest.split_at((shape.words() as usize).min(rest.len()));
                    rest = after;
                    shape.first_number(field)
                })
            }
            _ => None,
        }
    }

    /// Whether some of its words count something, or say whether: not every number is such a value.
    pub fn counts(&self) -> bool {
        match self {
            Shape::Bool | Shape::Int | Shape::Enum(_) => true,
            Shape::Record(_, fields) => fields.iter().any(|(_, shape)| shape.counts()),
            Shape::Optional(shape) | Shape::List(shape, _) | Shape::Map(shape, _) => shape.counts(),
            _ => false,
        }
    }

    /// Whether words can be such a value: what is counted is whole, and no number is larger than is kept.
    pub fn admits(&self, words: &[f64]) -> bool {
        let whole = |x: f64, range: Interval| x.fract() == 0.0 && range.holds(x);
        match (self, words) {
            (Shape::Bool, [x]) => *x == 0.0 || *x == 1.0,
            (Shape::Int, [x]) => whole(*x, Interval::INT),
            (Shape::Enum(variants), [x]) => whole(*x, Interval::new(0.0, variants.len().max(1) as f64 - 1.0)),
            (Shape::Record(_, fields), _) => {
                let mut rest = words;
                fields.iter().all(|(_, shape)| {
                    let (field, after) = rest.split_at((shape.words() as usize).min(rest.len()));
                    rest = after;
                    shape.admits(field)
                })
            }
            _ => words.iter().all(|x| Interval::ANY.holds(*x)),
        }
    }

    /// How many words it takes.
    pub fn words(&self) -> u32 {
        match self {
            Shape::Bool | Shape::Int | Shape::Quantity(_) | Shape::Heading => 1,
            Shape::Depth | Shape::Altitude | Shape::Date => 1,
            Shape::Text | Shape::Enum(_) => 1,
            Shape::Point | Shape::Vector(_) => 2,
            Shape::Line => 4,
            Shape::Edge => EDGE_WORDS,
            Shape::Area(corners) => area_words(*corners),
            Shape::Record(_, fields) => {
                fields.iter().fold(0, |words: u32, (_, shape)| words.saturating_add(shape.words()))
            }
            Shape::Optional(shape) => shape.words().saturating_add(1),
            Shape::List(shape, capacity) => shape.words().saturating_mul(*capacity).saturating_add(1),
            Shape::Map(shape, cells) => shape.words().saturating_mul(*cells).saturating_add(1 + GRID_WORDS),
        }
    }
}
