//! The bytes of NetCDF classic (CDF-1, and CDF-2 where places do not fit into 31 bits): a header of big-endian numbers and padded names,
//! then the values of each variable, one after the other.

/// The marks that begin a list.
const DIMENSIONS: u32 = 0x0A;
const VARIABLES: u32 = 0x0B;
const ATTRIBUTES: u32 = 0x0C;
/// Kinds of values.
const CHAR: u32 = 2;
const DOUBLE: u32 = 6;
/// Everything begins at a multiple of so many bytes.
const ALIGNED: usize = 4;

/// A dimension, by its place.
#[derive(Clone, Copy)]
pub struct Dimension(usize);

/// What is said of a file or a variable.
pub enum Attribute {
    Text(String),
    Double(f64),
}

/// The values of a variable.
pub enum Data<'a> {
    Numbers(Vec<f64>),
    /// Texts, each in so many bytes.
    Texts(Vec<&'a str>, usize),
}

/// A variable.
pub struct Variable<'a> {
    pub name: String,
    pub attributes: Vec<(&'static str, Attribute)>,
    dimensions: Vec<Dimension>,
    data: Data<'a>,
}

impl<'a> Variable<'a> {
    /// A number for each place of a dimension.
    pub fn numbers(name: String, along: Dimension, numbers: Vec<f64>) -> Self {
        Variable { name, attributes: Vec::new(), dimensions: vec![along], data: Data::Numbers(numbers) }
    }

    /// Texts of so many bytes, the last dimension.
    pub fn texts(name: String, dimensions: Vec<Dimension>, texts: Vec<&'a str>, width: usize) -> Self {
        Variable { name, attributes: Vec::new(), dimensions, data: Data::Texts(texts, width) }
    }

    /// Adds an attribute that is a text.
    pub fn says(&mut self, name: &'static str, text: &str) {
        self.attributes.push((name, Attribute::Text(text.to_string())));
    }

    fn kind(&self) -> u32 {
        match self.data {
            Data::Numbers(_) => DOUBLE,
            Data::Texts(..) => CHAR,
        }
    }

    /// Bytes of its values, with what pads them.
    fn size(&self) -> usize {
        let bytes = match &self.data {
            Data::Numbers(numbers) => size_of_val(numbers.as_slice()),
            Data::Texts(texts, width) => texts.len() * width,
        };
        bytes.next_multiple_of(ALIGNED)
    }

    fn write(&self, out: &mut Vec<u8>) {
        match &self.data {
            Data::Numbers(numbers) => numbers.iter().for_each(|number| out.extend(number.to_be_bytes())),
            Data::Texts(texts, width) => {
                for text in texts {
                    let bytes = text.as_bytes();
                    let bytes = bytes.get(..*width).unwrap_or(bytes);
                    out.extend_from_slice(bytes);
                    out.resize(out.len() + width - bytes.len(), 0);
                }
            }
        }
        out.resize(out.len().next_multiple_of(ALIGNED), 0);
    }
}

/// A file in the making.
pub struct File<'a> {
    attributes: Vec<(&'static str, Attribute)>,
    pub variables: Vec<Variable<'a>>,
    dimensions: Vec<(String, usize)>,
}

impl File<'_> {
    /// One without variables.
    pub fn new(attributes: Vec<(&'static str, Attribute)>) -> Self {
        File { attributes, variables: Vec::new(), dimensions: Vec::new() }
    }

    /// Adds a dimension. One of no length would be that of records, which has none either in a file without records.
    pub fn dimension(&mut self, name: &str, length: usize) -> Dimension {
        self.dimensions.push((name.to_string(), length));
        Dimension(self.dimensions.len() - 1)
    }

    /// All of it.
    pub fn bytes(&self) -> Vec<u8> {
        let values: usize = self.variables.iter().map(Variable::size).sum();
        let narrow = self.header(false, 0);
        let is_wide = i32::try_from(narrow.len() + values).is_err();
        let length = if is_wide { self.header(true, 0).len() } else { narrow.len() };
        let mut out = self.header(is_wide, length);
        out.reserve(values);
        self.variables.iter().for_each(|variable| variable.write(&mut out));
        out
    }

    /// The header, behind which values begin at a place.
    fn header(&self, is_wide: bool, values_at: usize) -> Vec<u8> {
        let mut out = Vec::from(if is_wide { *b"CDF\x02" } else { *b"CDF\x01" });
        word(&mut out, 0);
        list(&mut out, DIMENSIONS, self.dimensions.len());
        for (dimension, length) in &self.dimensions {
            name(&mut out, dimension);
            word(&mut out, *length);
        }
        attributes(&mut out, &self.attributes);
        list(&mut out, VARIABLES, self.variables.len());
        let mut at = values_at;
        for variable in &self.variables {
            name(&mut out, &variable.name);
            word(&mut out, variable.dimensions.len());
            variable.dimensions.iter().for_each(|dimension| word(&mut out, dimension.0));
            attributes(&mut out, &variable.attributes);
            word(&mut out, variable.kind() as usize);
            word(&mut out, variable.size());
            if is_wide {
                out.extend((at as u64).to_be_bytes())
            } else {
                word(&mut out, at)
            }
            at += variable.size();
        }
        out
    }
}

/// A number of four bytes; one that is larger is told as the largest, which the format takes for it.
fn word(out: &mut Vec<u8>, number: usize) {
    out.extend(u32::try_from(number).unwrap_or(u32::MAX).to_be_bytes());
}

/// The beginning of a list; an empty one has no mark.
fn list(out: &mut Vec<u8>, mark: u32, length: usize) {
    word(out, if length == 0 { 0 } else { mark as usize });
    word(out, length);
}

fn name(out: &mut Vec<u8>, name: &str) {
    word(out, name.len());
    padded(out, name.as_bytes());
}

fn padded(out: &mut Vec<u8>, bytes: &[u8]) {
    out.extend_from_slice(bytes);
    out.resize(out.len().next_multiple_of(ALIGNED), 0);
}

fn attributes(out: &mut Vec<u8>, attributes: &[(&'static str, Attribute)]) {
    list(out, ATTRIBUTES, attributes.len());
    for (attribute, value) in attributes {
        name(out, attribute);
        match value {
            Attribute::Text(text) => {
                word(out, CHAR as usize);
                word(out, text.len());
                padded(out, text.as_bytes());
            }
            Attribute::Double(number) => {
                word(out, DOUBLE as usize);
                word(out, 1);
                out.extend(number.to_be_bytes());
            }
        }
    }
}
