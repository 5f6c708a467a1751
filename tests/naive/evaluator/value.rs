//! Values as a reader of the language would think of them.

use albacore_geometry::{Edge, Grid, Heading, Line, Point, Vector};
use albacore_program::{AREA_CORNER_WORDS, Shape};

/// A value. What is true or false, a variant and a direction are numbers too.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    /// A text, by its place among those that were met.
    Text(usize),
    /// The parts of a point, vector, line, edge or record.
    Parts(Vec<Value>),
    Maybe(Option<Box<Value>>),
    List(Vec<Value>),
    Area(Vec<Edge>),
    /// Cells, and what each of them holds.
    Map(Grid, Vec<Value>),
}

use Value::{Maybe, Number, Parts};

impl Value {
    pub fn truth(holds: bool) -> Self {
        Number(f64::from(u8::from(holds)))
    }

    pub fn pair(north: f64, east: f64) -> Self {
        Parts(vec![Number(north), Number(east)])
    }

    pub fn of_point(p: Point) -> Self {
        Value::pair(p.north, p.east)
    }

    pub fn of_line(line: Line) -> Self {
        Parts(vec![Value::of_point(line.start), Value::of_point(line.end)])
    }

    pub fn of_edge(edge: Edge) -> Self {
        Parts(vec![Value::of_line(edge.line), Value::pair(edge.normal.north, edge.normal.east)])
    }

    pub fn present(self) -> Self {
        Maybe(Some(Box::new(self)))
    }

    pub fn number(&self) -> f64 {
        match self {
            Number(x) => *x,
            other => panic!("no number: {other:?}"),
        }
    }

    /// In a condition an optional means that it is present (rule 11).
    pub fn holds(&self) -> bool {
        match self {
            Maybe(value) => value.is_some(),
            other => other.number() != 0.0,
        }
    }

    pub fn heading(&self) -> Heading {
        Heading::from_radians(self.number())
    }

    pub fn part(&self, index: usize) -> &Value {
        match self {
            Parts(parts) => &parts[index],
            other => panic!("no parts: {other:?}"),
        }
    }

    pub fn point(&self) -> Point {
        Point::new(self.part(0).number(), self.part(1).number())
    }

    pub fn vector(&self) -> Vector {
        Vector::new(self.part(0).number(), self.part(1).number())
    }

    pub fn line(&self) -> Line {
        Line { start: self.part(0).point(), end: self.part(1).point() }
    }

    pub fn edge(&self) -> Edge {
        Edge { line: self.part(0).line(), normal: self.part(1).vector() }
    }

    pub fn list(&self) -> &[Value] {
        match self {
            Value::List(elements) => elements,
            other => panic!("no list: {other:?}"),
        }
    }

    pub fn map(&self) -> (Grid, &[Value]) {
        match self {
            Value::Map(grid, cells) => (*grid, cells),
            other => panic!("no map: {other:?}"),
        }
    }

    pub fn edges(&self) -> &[Edge] {
        match self {
            Value::Area(edges) => edges,
            other => panic!("no area: {other:?}"),
        }
    }

    /// A value as the program's shapes lay it out: what the printer of numbers takes, and what `Part` counts in.
    pub fn words(&self, shape: &Shape) -> Vec<f64> {
        let mut words = match (self, shape) {
            (Number(x), _) => vec![*x],
            (Value::Text(i), _) => vec![*i as f64],
            (Parts(fields), Shape::Record(_, shapes)) => {
                fields.iter().zip(shapes).flat_map(|(field, (_, shape))| field.words(shape)).collect()
            }
            (Parts(_), _) => self.numbers(),
            (Maybe(Some(value)), Shape::Optional(shape)) => [vec![1.0], value.words(shape)].concat(),
            (Value::List(elements), Shape::List(shape, _)) => {
                let elements = elements.iter().flat_map(|element| element.words(shape));
                std::iter::once(self.list().len() as f64).chain(elements).collect()
            }
            (Value::Area(edges), _) => std::iter::once(edges.len() as f64)
                .chain(
                    edges.iter().flat_map(|e| [e.line.start.north, e.line.start.east, e.normal.north, e.normal.east]),
                )
                .collect(),
            (Value::Map(grid, cells), Shape::Map(shape, _)) => {
                let Grid { cell, corner, along, rows, columns } = *grid;
                let grid =
                    [cell, corner.north, corner.east, along.north, along.east, f64::from(rows), f64::from(columns)];
                grid.into_iter()
                    .chain([cells.len() as f64])
                    .chain(cells.iter().flat_map(|cell| cell.words(shape)))
                    .collect()
            }
            _ => Vec::new(),
        };
        words.resize(shape.words() as usize, 0.0);
        words
    }

    /// The numbers of what is made of nothing else.
    fn numbers(&self) -> Vec<f64> {
        match self {
            Parts(parts) => parts.iter().flat_map(Value::numbers).collect(),
            other => vec![other.number()],
        }
    }

    /// A value read from words.
    pub fn read(shape: &Shape, words: &[f64]) -> Value {
        let pair = |at: usize| Value::pair(words[at], words[at + 1]);
        match shape {
            Shape::Point | Shape::Vector(_) => pair(0),
            Shape::Line => Parts(vec![pair(0), pair(2)]),
            Shape::Edge => Parts(vec![Parts(vec![pair(0), pair(2)]), pair(4)]),
            Shape::Record(_, fields) => {
                let mut left = words;
                let mut field = |shape: &Shape| {
                    let (own, rest) = left.split_at(shape.words() as usize);
                    left = rest;
                    Value::read(shape, own)
                };
                Parts(fields.iter().map(|(_, shape)| field(shape)).collect())
            }
            Shape::Optional(shape) => Maybe((words[0] != 0.0).then(|| Box::new(Value::read(shape, &words[1..])))),
            Shape::List(shape, _) => {
                let elements = words[1..].chunks(shape.words() as usize).take(words[0] as usize);
                Value::List(elements.map(|words| Value::read(shape, words)).collect())
            }
            Shape::Map(shape, _) => {
                let corner = Point::new(words[1], words[2]);
                let along = Vector::new(words[3], words[4]);
                let grid = Grid { cell: words[0], corner, along, rows: words[5] as u32, columns: words[6] as u32 };
                let cells = words[8..].chunks(shape.words() as usize).take(words[7] as usize);
                Value::Map(grid, cells.map(|words| Value::read(shape, words)).collect())
            }
            Shape::Area(_) => {
                let corners: Vec<&[f64]> =
                    words[1..].chunks(AREA_CORNER_WORDS as usize).take(words[0] as usize).collect();
                let corner = |i: usize| Point::new(corners[i % corners.len()][0], corners[i % corners.len()][1]);
                let edge = |i: usize| Edge {
                    line: Line { start: corner(i), end: corner(i + 1) },
                    normal: Vector::new(corners[i][2], corners[i][3]),
                };
                Value::Area((0..corners.len()).map(edge).collect())
            }
            _ => Number(words[0]),
        }
    }

    /// What a variable without a value has: nothing, none, zero.
    pub fn nothing(shape: &Shape) -> Value {
        Value::read(shape, &vec![0.0; shape.words() as usize])
    }
}
