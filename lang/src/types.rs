//! Types: what keeps a heading from being taken for an angle, and a point for a vector.

use crate::dimension::Dimension;
use crate::source::Span;
use albacore_program::{GRID_WORDS, Shape};
use std::sync::Arc;

/// Index of a record declaration.
pub type RecordId = usize;
/// Index of an enum declaration.
pub type EnumId = usize;

/// The type of a value.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant is the type of its name in the language")]
pub enum Type {
    Bool,
    Int,
    /// +1 or -1.
    Sign,
    Text,
    Quantity(Dimension),
    Heading,
    Depth,
    Altitude,
    /// A moment, counted from the beginning of 1970, UTC.
    Date,
    Point,
    Vector(Dimension),
    Area,
    Edge,
    Line,
    Record(RecordId),
    Enum(EnumId),
    Optional(Box<Type>),
    List(Box<Type>, u32),
    /// A grid of so many cells at most, and what each holds.
    Map(Box<Type>, u32),
    /// The type of `none`, which is of every optional type.
    None,
    /// Of what has been reported already: fits everything, so that no mistake is told twice.
    Unknown,
}

/// A record as the checker knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordInfo {
    /// Its name.
    pub name: String,
    /// The module that declares it; empty for the file that is run.
    pub module: String,
    /// Its fields.
    pub fields: Vec<(String, Type)>,
    /// Where they are declared.
    pub places: Vec<Span>,
}

/// An enum as the checker knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct EnumInfo {
    /// Its name.
    pub name: String,
    /// The module that declares it; empty for the file that is run.
    pub module: String,
    /// Its variants.
    pub variants: Arc<[String]>,
}

/// A name that several modules declare, as it is written where they are imported.
fn qualified(module: &str, name: &str) -> String {
    if module.is_empty() { name.to_string() } else { format!("{module}.{name}") }
}

/// An area has room for so many corners at least, which few that are written by hand have.
pub const AREA_ROOM: u32 = 16;

/// The declared types of a program.
#[derive(Clone, Debug)]
pub struct TypeTable {
    /// Records, by [`RecordId`].
    pub records: Vec<RecordInfo>,
    /// Enums, by [`EnumId`].
    pub enums: Vec<EnumInfo>,
    /// For how many corners any area of the program has room: for those of the largest.
    pub area_room: u32,
    /// How many corners the largest that it can make has.
    pub corners: u32,
}

impl Type {
    /// `T?`; an optional of an optional is one, and what is always absent may be.
    pub fn optional(self) -> Type {
        match self {
            Type::Optional(_) | Type::None | Type::Unknown => self,
            other => Type::Optional(Box::new(other)),
        }
    }

    /// The type inside `T?`, or the type itself.
    pub fn present(&self) -> &Type {
        match self {
            Type::Optional(inner) => inner,
            other => other,
        }
    }

    /// What an element of a list or a cell of a map is.
    pub fn element(&self) -> Option<&Type> {
        match self {
            Type::List(inner, _) | Type::Map(inner, _) => Some(inner),
            _ => None,
        }
    }

    /// Whether it may be absent.
    pub fn is_optional(&self) -> bool {
        matches!(self, Type::Optional(_) | Type::None)
    }

    /// A number that can be calculated with: its dimension.
    pub fn dimension(&self) -> Option<Dimension> {
        match self {
            Type::Int | Type::Sign => Some(Dimension::NUMBER),
            Type::Quantity(d) => Some(*d),
            _ => None,
        }
    }
}

impl TypeTable {
    /// Without any declared type.
    pub fn new(area_room: u32) -> Self {
        TypeTable { records: Vec::new(), enums: Vec::new(), area_room, corners: 0 }
    }

    /// A type as a script writes it.
    pub fn name(&self, ty: &Type) -> String {
        match ty {
            Type::Bool => "Bool".into(),
            Type::Int => "Int".into(),
            Type::Sign => "Sign".into(),
            Type::Text => "Text".into(),
            Type::Quantity(d) => d.to_string(),
            Type::Heading => "Heading".into(),
            Type::Depth => "Depth".into(),
            Type::Altitude => "Altitude".into(),
            Type::Date => "Date".into(),
            Type::Point => "Point".into(),
            Type::Vector(d) if *d == Dimension::LENGTH => "Vector".into(),
            Type::Vector(d) if *d == Dimension::SPEED => "Velocity".into(),
            Type::Vector(d) if d.is_none() => "Direction".into(),
            Type::Vector(d) => format!("a vector of {d}"),
            Type::Area => "Area".into(),
            Type::Edge => "Edge".into(),
            Type::Line => "Line".into(),
            Type::Record(id) => {
                let RecordInfo { name, module, .. } = &self.records[*id];
                let twice = self.records.iter().filter(|other| other.name == *name).count() > 1;
                if twice { qualified(module, name) } else { name.clone() }
            }
            Type::Enum(id) => {
                let EnumInfo { name, module, .. } = &self.enums[*id];
                let twice = self.enums.iter().filter(|other| other.name == *name).count() > 1;
                if twice { qualified(module, name) } else { name.clone() }
            }
            Type::Optional(inner) => format!("{}?", self.name(inner)),
            Type::List(inner, capacity) => format!("[{}; {capacity}]", self.name(inner)),
            Type::Map(inner, cells) => format!("Map[{}; {cells}]", self.name(inner)),
            Type::None => "none".into(),
            Type::Unknown => "?".into(),
        }
    }

    /// The shape of a type's words.
    pub fn shape(&self, ty: &Type) -> Shape {
        match ty {
            Type::Bool => Shape::Bool,
            Type::Int | Type::Sign => Shape::Int,
            Type::Text => Shape::Text,
            Type::Quantity(d) => Shape::Quantity(d.display()),
            Type::Heading => Shape::Heading,
            Type::Depth => Shape::Depth,
            Type::Altitude => Shape::Altitude,
            Type::Date => Shape::Date,
            Type::Point => Shape::Point,
            Type::Vector(d) => Shape::Vector(d.display()),
            Type::Area => Shape::Area(self.area_room),
            Type::Edge => Shape::Edge,
            Type::Line => Shape::Line,
            Type::Record(id) => {
                let record = &self.records[*id];
                let fields = record.fields.iter().map(|(name, ty)| (name.clone(), self.shape(ty))).collect();
                Shape::Record(record.name.clone(), fields)
            }
            Type::Enum(id) => Shape::Enum(self.enums[*id].variants.clone()),
            Type::Optional(inner) => Shape::Optional(Box::new(self.shape(inner))),
            Type::List(inner, capacity) => Shape::List(Box::new(self.shape(inner)), *capacity),
            Type::Map(inner, cells) => Shape::Map(Box::new(self.shape(inner)), *cells),
            Type::None | Type::Unknown => Shape::Bool,
        }
    }

    /// How many words a value of a type takes. What no program can hold takes the most that can be counted.
    pub fn words(&self, ty: &Type) -> u32 {
        match ty {
            Type::Record(id) => {
                let fields = self.records[*id].fields.iter();
                fields.fold(0, |words: u32, (_, ty)| words.saturating_add(self.words(ty)))
            }
            Type::Optional(inner) => self.words(inner).saturating_add(1),
            Type::List(inner, capacity) => self.words(inner).saturating_mul(*capacity).saturating_add(1),
            Type::Map(inner, cells) => self.words(inner).saturating_mul(*cells).saturating_add(1 + GRID_WORDS),
            simple => self.shape(simple).words(),
        }
    }

    /// Whether a type is made of so few parts: its fields, and theirs.
    pub fn has_parts_at_most(&self, ty: &Type, most: usize) -> bool {
        let mut left = most;
        let mut ahead = vec![ty];
        while let Some(ty) = ahead.pop() {
            if left == 0 {
                return false;
            }
            left -= 1;
            match ty {
                Type::Record(id) => ahead.extend(self.records[*id].fields.iter().map(|(_, ty)| ty)),
                Type::Optional(inner) | Type::List(inner, _) | Type::Map(inner, _) => ahead.push(inner),
                _ => {}
            }
        }
        true
    }
}

/// Whether values of a type are one number each, of which a range is known.
pub fn is_number(ty: &Type) -> bool {
    matches!(ty, Type::Int | Type::Sign | Type::Quantity(_) | Type::Heading | Type::Depth | Type::Altitude | Type::Date)
}
