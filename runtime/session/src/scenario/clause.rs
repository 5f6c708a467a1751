//! Reads a checked clause with its numbers computed into any type that serde can make: its parameters are fields, a clause is a
//! variant of its name. What a parameter is called, its default and its range stand in its declaration.

use super::{Wrong, cannot_be};
use albacore_lang::{ScenarioClause, ScenarioValue};
use albacore_program::{AREA_CORNER_WORDS, Shape, Slot};
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use std::fmt;

/// A clause, and the words that its arguments point into.
#[derive(Clone, Copy)]
pub struct Clause<'a> {
    pub clause: &'a ScenarioClause,
    pub words: &'a [f64],
}

impl<'a> Clause<'a> {
    /// What it says.
    pub fn read<T: Deserialize<'a>>(self) -> Result<T, Wrong> {
        T::deserialize(self).map_err(|Unreadable { what, mend }| match mend {
            Some(mend) => Wrong::with(what, mend),
            None => cannot_be(&what),
        })
    }
}

/// What of a clause is not as it has to be, and its mend if that is known.
#[derive(Debug)]
pub struct Unreadable {
    what: String,
    mend: Option<String>,
}

impl de::Error for Unreadable {
    /// A second line is the mend.
    fn custom<T: fmt::Display>(what: T) -> Self {
        let what = what.to_string();
        match what.split_once('\n') {
            Some((what, mend)) => Unreadable { what: what.into(), mend: Some(mend.into()) },
            None => Unreadable { what, mend: None },
        }
    }

    fn unknown_variant(variant: &str, _: &'static [&'static str]) -> Self {
        let mend =
            "it knows those of the standard library: see `albacore doc world`, `craft`, `instruments` and `faults`";
        Unreadable { what: format!("the simulator knows no `{variant}`"), mend: Some(mend.into()) }
    }

    fn missing_field(field: &'static str) -> Self {
        Unreadable { what: format!("it has no `{field}`"), mend: None }
    }
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

impl std::error::Error for Unreadable {}

/// The fields of a struct, else the name of a clause without any.
impl<'a> Deserializer<'a> for Clause<'a> {
    type Error = Unreadable;

    fn deserialize_any<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_map(Fields { clause: self, next: 0 })
    }

    fn deserialize_option<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'a>>(self, _: &'static str, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'a>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Unreadable> {
        visitor.visit_enum(self)
    }

    fn deserialize_str<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_borrowed_str(&self.clause.name)
    }

    fn deserialize_string<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        self.deserialize_str(visitor)
    }

    forward_to_deserialize_any! {
        <V: Visitor<'a>>
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char bytes byte_buf unit unit_struct seq tuple tuple_struct map
        struct identifier ignored_any
    }
}

impl<'a> EnumAccess<'a> for Clause<'a> {
    type Error = Unreadable;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'a>>(self, seed: S) -> Result<(S::Value, Self), Unreadable> {
        Ok((seed.deserialize(StrDeserializer::new(&self.clause.name))?, self))
    }
}

impl<'a> VariantAccess<'a> for Clause<'a> {
    type Error = Unreadable;

    fn unit_variant(self) -> Result<(), Unreadable> {
        Ok(())
    }

    fn newtype_variant_seed<S: DeserializeSeed<'a>>(self, seed: S) -> Result<S::Value, Unreadable> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'a>>(self, _: usize, visitor: V) -> Result<V::Value, Unreadable> {
        self.deserialize_any(visitor)
    }

    fn struct_variant<V: Visitor<'a>>(self, _: &'static [&'static str], visitor: V) -> Result<V::Value, Unreadable> {
        self.deserialize_any(visitor)
    }
}

/// The arguments of a clause by the names of its parameters.
struct Fields<'a> {
    clause: Clause<'a>,
    next: usize,
}

impl<'a> MapAccess<'a> for Fields<'a> {
    type Error = Unreadable;

    fn next_key_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<Option<S::Value>, Unreadable> {
        let arg = self.clause.clause.args.get(self.next);
        arg.map(|arg| seed.deserialize(StrDeserializer::new(&arg.name))).transpose()
    }

    fn next_value_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<S::Value, Unreadable> {
        let Clause { clause, words } = self.clause;
        let arg = clause.args.get(self.next).ok_or_else(|| de::Error::custom("it has no such argument"))?;
        self.next += 1;
        match &arg.value {
            ScenarioValue::Clause(clause) => seed.deserialize(Clause { clause, words }),
            ScenarioValue::Text(text) => seed.deserialize(Written(text)),
            ScenarioValue::Words(slot, shape) => {
                let read = seed.deserialize(Value { words, slot: *slot, shape });
                read.map_err(|e: Unreadable| Unreadable { what: format!("`{}`: {}", arg.name, e.what), ..e })
            }
        }
    }
}

/// A text that is written out, for a parameter that may be absent too.
struct Written<'a>(&'a str);

impl<'a> Deserializer<'a> for Written<'a> {
    type Error = Unreadable;

    fn deserialize_any<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_borrowed_str(self.0)
    }

    fn deserialize_option<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_some(self)
    }

    forward_to_deserialize_any! {
        <V: Visitor<'a>>
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct newtype_struct seq
        tuple tuple_struct map struct enum identifier ignored_any
    }
}

/// A value in words.
#[derive(Clone, Copy)]
struct Value<'a> {
    words: &'a [f64],
    slot: Slot,
    shape: &'a Shape,
}

impl<'a> Value<'a> {
    fn word(self, at: Slot) -> f64 {
        self.words.get((self.slot + at) as usize).copied().unwrap_or(0.0)
    }

    fn at(self, at: Slot) -> Self {
        Value { slot: self.slot + at, ..self }
    }

    /// The value inside an optional one.
    fn present(self) -> Option<Self> {
        match self.shape {
            Shape::Optional(shape) => (self.word(0) != 0.0).then_some(Value { shape, ..self.at(1) }),
            _ => Some(self),
        }
    }
}

impl<'a> IntoDeserializer<'a, Unreadable> for Value<'a> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// A number, a truth, north and east, corners, or a list: as the shape says.
impl<'a> Deserializer<'a> for Value<'a> {
    type Error = Unreadable;

    fn deserialize_any<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        let count = self.word(0) as u32;
        match self.shape {
            Shape::Bool => visitor.visit_bool(self.word(0) != 0.0),
            Shape::Int => visitor.visit_i64(self.word(0) as i64),
            Shape::Quantity(_) | Shape::Heading | Shape::Depth | Shape::Altitude | Shape::Date => {
                visitor.visit_f64(self.word(0))
            }
            Shape::Point | Shape::Vector(_) => visitor.visit_map(Components { value: self, names: &["north", "east"] }),
            Shape::Area(_) => visitor.visit_map(Corners(Some(Items {
                value: self.at(1),
                left: count,
                shape: &Shape::Point,
                step: AREA_CORNER_WORDS,
            }))),
            Shape::List(shape, _) => {
                visitor.visit_seq(Items { value: self.at(1), left: count, shape, step: shape.words() })
            }
            Shape::Optional(_) => self.deserialize_option(visitor),
            Shape::Text => Err(Unreadable {
                what: "a text is written out here".into(),
                mend: Some("write it between quotes: a parameter of the type `Text` is no part of any clause".into()),
            }),
            Shape::Line | Shape::Edge | Shape::Enum(_) | Shape::Record(..) | Shape::Map(..) => {
                Err(de::Error::custom("no clause takes such a value"))
            }
        }
    }

    fn deserialize_option<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Unreadable> {
        match self.present() {
            Some(value) => visitor.visit_some(value),
            None => visitor.visit_none(),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'a>>(self, _: &'static str, visitor: V) -> Result<V::Value, Unreadable> {
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        <V: Visitor<'a>>
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map struct enum identifier ignored_any
    }
}

/// The components of a point or a vector.
struct Components<'a> {
    value: Value<'a>,
    names: &'static [&'static str],
}

impl<'a> MapAccess<'a> for Components<'a> {
    type Error = Unreadable;

    fn next_key_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<Option<S::Value>, Unreadable> {
        self.names.first().map(|name| seed.deserialize(StrDeserializer::new(name))).transpose()
    }

    fn next_value_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<S::Value, Unreadable> {
        let number = self.value.word(0);
        (self.value, self.names) = (self.value.at(1), self.names.get(1..).unwrap_or_default());
        seed.deserialize(number.into_deserializer())
    }
}

/// The corners of an area, as its one field.
struct Corners<'a>(Option<Items<'a>>);

impl<'a> MapAccess<'a> for Corners<'a> {
    type Error = Unreadable;

    fn next_key_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<Option<S::Value>, Unreadable> {
        self.0.as_ref().map(|_| seed.deserialize(StrDeserializer::new("corners"))).transpose()
    }

    fn next_value_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<S::Value, Unreadable> {
        let corners = self.0.take().ok_or_else(|| de::Error::custom("it has no corners"))?;
        seed.deserialize(de::value::SeqAccessDeserializer::new(corners))
    }
}

/// Values one after the other.
struct Items<'a> {
    value: Value<'a>,
    left: u32,
    shape: &'a Shape,
    /// Words from one to the next.
    step: u32,
}

impl<'a> SeqAccess<'a> for Items<'a> {
    type Error = Unreadable;

    fn next_element_seed<S: DeserializeSeed<'a>>(&mut self, seed: S) -> Result<Option<S::Value>, Unreadable> {
        if self.left == 0 {
            return Ok(None);
        }
        let value = Value { shape: self.shape, ..self.value };
        (self.left, self.value) = (self.left - 1, self.value.at(self.step));
        seed.deserialize(value).map(Some)
    }
}
