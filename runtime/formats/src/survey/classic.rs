//! NetCDF classic, CDF-1 and CDF-2: dimensions, attributes and variables, as its format specification lays them out.
//!
//! Unidata, "The NetCDF Classic Format Specification": a header of big-endian numbers and padded names, then the values of
//! each variable at the place that the header tells. Names and values stay in the file's bytes until they are asked for, so
//! that no header can announce more than it has.

mod bytes;

use crate::fault::{Fault, counted, shortened};
use crate::survey::CELLS_MAX;
use crate::survey::CUT_IT;
use bytes::Bytes;
use std::collections::BTreeSet;

/// The marks that begin a list.
const DIMENSIONS: u32 = 0x0A;
const VARIABLES: u32 = 0x0B;
const ATTRIBUTES: u32 = 0x0C;
/// A count of records that was not known when the file was begun.
const STREAMING: u32 = u32::MAX;
/// A variable has at most this many dimensions: NC_MAX_VAR_DIMS.
const VARIABLE_DIMENSIONS_MAX: u64 = 1024;
/// An attribute that is read for its numbers has at most this many.
const NUMBERS_MAX: u64 = 16;

/// A file that was understood; its values are not read yet.
#[derive(Debug)]
pub(crate) struct Classic<'a> {
    bytes: &'a [u8],
    pub dimensions: Vec<Dimension<'a>>,
    pub variables: Vec<Variable<'a>>,
}

#[derive(Debug)]
pub(crate) struct Dimension<'a> {
    pub name: &'a str,
    /// None: it grows with the file's records.
    pub length: Option<u64>,
}

#[derive(Debug)]
pub(crate) struct Variable<'a> {
    pub name: &'a str,
    /// Indices into the file's dimensions, the slowest first.
    pub dimensions: Vec<usize>,
    attributes: Vec<Attribute<'a>>,
    pub kind: Kind,
    /// Whether its whole numbers have no sign: `_Unsigned`.
    unsigned: bool,
    begin: u64,
}

#[derive(Debug)]
struct Attribute<'a> {
    name: &'a str,
    kind: Kind,
    bytes: &'a [u8],
}

/// What a value is, by its number in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Byte,
    Char,
    Short,
    Int,
    Float,
    Double,
}

impl Kind {
    fn of(number: u32) -> Option<Kind> {
        use Kind::{Byte, Char, Double, Float, Int, Short};
        [Byte, Char, Short, Int, Float, Double].get((number as usize).checked_sub(1)?).copied()
    }

    fn size(self) -> u64 {
        match self {
            Kind::Byte | Kind::Char => 1,
            Kind::Short => 2,
            Kind::Int | Kind::Float => 4,
            Kind::Double => 8,
        }
    }

    /// What stands where nothing was written, unless the variable says otherwise: NC_FILL_SHORT and its like. Bytes have none
    /// that is not also a value.
    fn fill(self) -> Option<f64> {
        match self {
            Kind::Byte | Kind::Char => None,
            Kind::Short => Some(-32_767.0),
            Kind::Int => Some(-2_147_483_647.0),
            Kind::Float => Some(f64::from(9.969_21e36_f32)),
            Kind::Double => Some(9.969_209_968_386_869e36),
        }
    }

    /// How `ncatted` calls it.
    pub fn letter(self) -> char {
        match self {
            Kind::Byte => 'b',
            Kind::Char => 'c',
            Kind::Short => 's',
            Kind::Int => 'l',
            Kind::Float => 'f',
            Kind::Double => 'd',
        }
    }

    /// Whether it is a whole number.
    pub fn is_whole(self) -> bool {
        matches!(self, Kind::Byte | Kind::Short | Kind::Int)
    }

    /// A whole number of this size as it reads without a sign.
    fn without_sign(self, value: f64) -> f64 {
        let turn = match self {
            Kind::Byte => 256.0,
            Kind::Short => 65_536.0,
            Kind::Int => 4_294_967_296.0,
            Kind::Char | Kind::Float | Kind::Double => 0.0,
        };
        if value < 0.0 { value + turn } else { value }
    }

    fn values(self, bytes: &[u8]) -> Vec<f64> {
        match self {
            Kind::Byte | Kind::Char => bytes.iter().map(|&b| f64::from(b as i8)).collect(),
            Kind::Short => each(bytes, |b| f64::from(i16::from_be_bytes(b))),
            Kind::Int => each(bytes, |b| f64::from(i32::from_be_bytes(b))),
            Kind::Float => each(bytes, |b| f64::from(f32::from_be_bytes(b))),
            Kind::Double => each(bytes, f64::from_be_bytes),
        }
    }
}

fn each<const SIZE: usize>(bytes: &[u8], value: impl Fn([u8; SIZE]) -> f64) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|chunk| value(*chunk)).collect()
}

impl<'a> Classic<'a> {
    /// Understands the header.
    pub fn read(file: &'a [u8]) -> Result<Classic<'a>, Fault> {
        let mut bytes = Bytes::new(file);
        let magic = bytes.take(4, "the magic number")?;
        let wide = match magic {
            b"CDF\x01" => false,
            b"CDF\x02" => true,
            _ => {
                let message = format!("byte 3: NetCDF of version {} is none that is read", magic[3]);
                return Err(Fault::new(message, "convert it with `nccopy -k classic IN.nc OUT.nc`"));
            }
        };
        let records = bytes.word("the number of records")?;
        if records != STREAMING && records > i32::MAX as u32 {
            return Err(bytes.wrong(format!("the number of records is {records}")));
        }
        let dimensions = bytes.list(DIMENSIONS, "dimensions", |bytes| {
            let name = bytes.name("a dimension")?;
            let length = bytes.count("the length of a dimension")?;
            Ok(Dimension { name, length: (length > 0).then_some(length) })
        })?;
        each_once(&bytes, "dimensions", dimensions.iter().map(|dimension| dimension.name))?;
        attributes(&mut bytes)?;
        let variables = bytes.list(VARIABLES, "variables", |bytes| Variable::read(bytes, dimensions.len(), wide))?;
        each_once(&bytes, "variables", variables.iter().map(|variable| variable.name))?;
        Ok(Classic { bytes: file, dimensions, variables })
    }

    pub fn variable(&self, name: &str) -> Option<&Variable<'a>> {
        self.variables.iter().find(|variable| variable.name == name)
    }

    /// The names of a variable's dimensions, in order.
    pub fn dimension_names(&self, variable: &Variable) -> Vec<&'a str> {
        variable.dimensions.iter().filter_map(|&i| self.dimensions.get(i)).map(|d| d.name).collect()
    }

    /// All values of a variable, as they are stored; its dimensions are of fixed length.
    pub fn values(&self, variable: &Variable) -> Result<Vec<f64>, Fault> {
        if variable.kind == Kind::Char {
            let message = format!("`{}` holds text, and no numbers", shortened(variable.name));
            return Err(Fault::new(message, "write it again with numbers, such as `float` or `short`"));
        }
        let mut count: u64 = 1;
        for dimension in variable.dimensions.iter().filter_map(|&i| self.dimensions.get(i)) {
            let Some(length) = dimension.length else {
                let (name, dimension) = (shortened(variable.name), shortened(dimension.name));
                let message = format!("`{name}` has `{dimension}`, a dimension without a fixed length");
                return Err(Fault::new(message, "fix it with `nccopy -u -k classic IN.nc OUT.nc`"));
            };
            count = count.saturating_mul(length);
        }
        if count > CELLS_MAX {
            let message = format!("`{}` has {count} values: {CELLS_MAX} are read at most", shortened(variable.name));
            return Err(Fault::new(message, CUT_IT));
        }
        let end = count.saturating_mul(variable.kind.size()).saturating_add(variable.begin);
        let held = self.bytes.len() as u64;
        match self.bytes.get(variable.begin as usize..end as usize) {
            Some(bytes) if end <= held => {
                let mut values = variable.kind.values(bytes);
                values.iter_mut().for_each(|value| *value = variable.sign(*value));
                Ok(values)
            }
            _ => {
                let (name, begin) = (shortened(variable.name), variable.begin);
                let message = format!(
                    "the file is cut off: the {count} values of `{name}` are bytes {begin} to {end}, and it has {held}"
                );
                Err(Fault::new(message, bytes::FETCH_AGAIN))
            }
        }
    }
}

impl<'a> Variable<'a> {
    fn read(bytes: &mut Bytes<'a>, dimensions_known: usize, wide: bool) -> Result<Variable<'a>, Fault> {
        let name = bytes.name("a variable")?;
        let count = bytes.count("the number of a variable's dimensions")?;
        if count > VARIABLE_DIMENSIONS_MAX {
            return Err(bytes.wrong(format!("the variable `{}` has {count} dimensions", shortened(name))));
        }
        let mut dimensions = Vec::new();
        for _ in 0..count {
            let index = bytes.count("a variable's dimension")? as usize;
            if index >= dimensions_known {
                let name = shortened(name);
                return Err(bytes.wrong(format!("the variable `{name}` has dimension {index} of {dimensions_known}")));
            }
            dimensions.push(index);
        }
        let attributes = attributes(bytes)?;
        let kind = kind(bytes)?;
        // Its size follows from its dimensions; where it does not fit into a word the file says something else.
        bytes.word("the size of a variable")?;
        let begin =
            if wide { bytes.long("the place of a variable")? } else { bytes.count("the place of a variable")? };
        let mut variable = Variable { name, dimensions, attributes, kind, unsigned: false, begin };
        variable.unsigned = variable.text("_Unsigned").is_some_and(|said| said.eq_ignore_ascii_case("true"));
        Ok(variable)
    }

    /// An attribute that is a text, without the blanks and zeros that pad it.
    pub fn text(&self, name: &str) -> Option<&'a str> {
        let attribute = self.attributes.iter().find(|a| a.name == name && a.kind == Kind::Char)?;
        Some(std::str::from_utf8(attribute.bytes).ok()?.trim_matches(['\0', ' ', '\n', '\t']))
    }

    /// An attribute that is one number or several; none where there is no such attribute. It is read as the values are if it
    /// is of their kind.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, Fault> {
        let Some(attribute) = self.attributes.iter().find(|a| a.name == name) else { return Ok(Vec::new()) };
        let variable = shortened(self.name);
        if attribute.kind == Kind::Char {
            let text = String::from_utf8_lossy(attribute.bytes);
            let text = shortened(text.trim_matches(['\0', ' ', '\n', '\t']));
            let help = match text.parse::<f64>() {
                Ok(_) => format!("write the number: `ncatted -a {name},{variable},o,d,{text} FILE.nc`"),
                Err(_) => format!("take it away with `ncatted -a {name},{variable},d,, FILE.nc`"),
            };
            return Err(Fault::new(format!("`{variable}:{name}` is the text `{text}`, where numbers belong"), help));
        }
        let count = attribute.bytes.len() as u64 / attribute.kind.size();
        if count > NUMBERS_MAX {
            let message = format!("`{variable}:{name}` has {}: {NUMBERS_MAX} are the most", counted(count, "value"));
            return Err(Fault::new(message, format!("take it away with `ncatted -a {name},{variable},d,, FILE.nc`")));
        }
        let mut numbers = attribute.kind.values(attribute.bytes);
        if attribute.kind == self.kind {
            numbers.iter_mut().for_each(|number| *number = self.sign(*number));
        }
        Ok(numbers)
    }

    /// What an attribute is made of.
    pub fn kind_of(&self, name: &str) -> Option<Kind> {
        self.attributes.iter().find(|a| a.name == name).map(|a| a.kind)
    }

    /// What stands where nothing was written, unless the variable says otherwise.
    pub fn fill(&self) -> Option<f64> {
        self.kind.fill().map(|value| self.sign(value))
    }

    /// A stored number with the sign that it is meant to have.
    fn sign(&self, value: f64) -> f64 {
        if self.unsigned { self.kind.without_sign(value) } else { value }
    }
}

fn attributes<'a>(bytes: &mut Bytes<'a>) -> Result<Vec<Attribute<'a>>, Fault> {
    let attributes = bytes.list(ATTRIBUTES, "attributes", |bytes| {
        let name = bytes.name("an attribute")?;
        let kind = kind(bytes)?;
        let count = bytes.count("the number of an attribute's values")?;
        Ok(Attribute { name, kind, bytes: bytes.padded(count * kind.size(), "an attribute")? })
    })?;
    each_once(bytes, "attributes", attributes.iter().map(|attribute| attribute.name))?;
    Ok(attributes)
}

/// No two of one name: nobody can tell which is meant.
fn each_once<'n>(bytes: &Bytes, what: &str, names: impl Iterator<Item = &'n str>) -> Result<(), Fault> {
    let mut known = BTreeSet::new();
    for name in names {
        if !known.insert(name) {
            return Err(bytes.wrong(format!("two {what} are called `{}`", shortened(name))));
        }
    }
    Ok(())
}

fn kind(bytes: &mut Bytes) -> Result<Kind, Fault> {
    let number = bytes.word("a type")?;
    Kind::of(number).ok_or_else(|| bytes.wrong(format!("there is no type {number}")))
}
