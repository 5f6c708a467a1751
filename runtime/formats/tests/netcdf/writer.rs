//! Writes NetCDF classic files, right ones and wrong ones, after the format's specification.

/// A value of an attribute, or the values of a variable.
#[derive(Clone)]
pub enum Values {
    Text(&'static str),
    Shorts(Vec<i16>),
    Floats(Vec<f32>),
    Doubles(Vec<f64>),
}

use Values::{Doubles, Floats, Shorts, Text};

/// A variable: its name, its dimensions by their index, its attributes and its values.
#[derive(Clone)]
pub struct Variable {
    pub name: &'static str,
    pub dimensions: Vec<u32>,
    pub attributes: Vec<(&'static str, Values)>,
    pub values: Values,
}

/// A file.
#[derive(Clone)]
pub struct File {
    pub dimensions: Vec<(&'static str, u32)>,
    pub variables: Vec<Variable>,
}

impl Values {
    fn kind(&self) -> u32 {
        match self {
            Text(_) => 2,
            Shorts(_) => 3,
            Floats(_) => 5,
            Doubles(_) => 6,
        }
    }

    fn count(&self) -> usize {
        match self {
            Text(text) => text.len(),
            Shorts(values) => values.len(),
            Floats(values) => values.len(),
            Doubles(values) => values.len(),
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let bytes: Vec<u8> = match self {
            Text(text) => text.bytes().collect(),
            Shorts(values) => values.iter().flat_map(|v| v.to_be_bytes()).collect(),
            Floats(values) => values.iter().flat_map(|v| v.to_be_bytes()).collect(),
            Doubles(values) => values.iter().flat_map(|v| v.to_be_bytes()).collect(),
        };
        padded(&bytes)
    }
}

impl File {
    /// `elevation(y, x)` in metres: two rows of three cells.
    pub fn small() -> File {
        let axis = |name, dimension, places: &[f64]| Variable {
            name,
            dimensions: vec![dimension],
            attributes: vec![("units", Text("m"))],
            values: Doubles(places.to_vec()),
        };
        let elevation = Variable {
            name: "elevation",
            dimensions: vec![0, 1],
            attributes: vec![("units", Text("m"))],
            values: Doubles(vec![-1.0, -2.0, -3.0, -4.0, -5.5, 6.0]),
        };
        let variables = vec![axis("y", 0, &[-5.0, 5.0]), axis("x", 1, &[0.0, 10.0, 20.0]), elevation];
        File { dimensions: vec![("y", 2), ("x", 3)], variables }
    }

    /// The same with one variable changed.
    pub fn with(mut self, variable: &str, change: impl FnOnce(&mut Variable)) -> File {
        self.variables.iter_mut().find(|v| v.name == variable).map(change);
        self
    }

    /// Its bytes, of version 1 or 2.
    pub fn bytes(&self, version: u8) -> Vec<u8> {
        // The places of the values follow from the length of the header, which does not depend on them.
        let header = self.header(version, 0).len() as u64;
        let mut bytes = self.header(version, header);
        self.variables.iter().for_each(|v| bytes.extend(v.values.bytes()));
        bytes
    }

    fn header(&self, version: u8, mut begin: u64) -> Vec<u8> {
        let mut bytes = vec![b'C', b'D', b'F', version, 0, 0, 0, 0];
        list(&mut bytes, 0x0A, self.dimensions.len());
        for (name, length) in &self.dimensions {
            text(&mut bytes, name);
            word(&mut bytes, *length);
        }
        list(&mut bytes, 0, 0);
        list(&mut bytes, 0x0B, self.variables.len());
        for variable in &self.variables {
            text(&mut bytes, variable.name);
            word(&mut bytes, variable.dimensions.len() as u32);
            variable.dimensions.iter().for_each(|d| word(&mut bytes, *d));
            list(&mut bytes, 0x0C, variable.attributes.len());
            for (name, values) in &variable.attributes {
                text(&mut bytes, name);
                word(&mut bytes, values.kind());
                word(&mut bytes, values.count() as u32);
                bytes.extend(values.bytes());
            }
            let size = variable.values.bytes().len() as u64;
            word(&mut bytes, variable.values.kind());
            word(&mut bytes, size as u32);
            if version == 1 {
                word(&mut bytes, begin as u32)
            } else {
                bytes.extend(begin.to_be_bytes())
            }
            begin += size;
        }
        bytes
    }
}

fn list(bytes: &mut Vec<u8>, mark: u32, count: usize) {
    word(bytes, if count == 0 { 0 } else { mark });
    word(bytes, count as u32);
}

fn text(bytes: &mut Vec<u8>, text: &str) {
    word(bytes, text.len() as u32);
    bytes.extend(padded(text.as_bytes()));
}

fn word(bytes: &mut Vec<u8>, word: u32) {
    bytes.extend(word.to_be_bytes());
}

fn padded(bytes: &[u8]) -> Vec<u8> {
    let mut padded = bytes.to_vec();
    padded.resize(bytes.len().next_multiple_of(4), 0);
    padded
}
