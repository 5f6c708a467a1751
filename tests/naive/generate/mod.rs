//! Sound scripts by chance, over all that the rules of time speak of.

mod activity;
mod area;
mod derived;
mod expr;
mod given;
mod guest;
mod overlay;
mod stmt;

use crate::random::Random;
use std::collections::BTreeMap;

/// The types that generated scripts have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ty {
    Bool,
    Int,
    Length,
    Ratio,
    Angle,
    Heading,
    Point,
    Vector,
    Speed,
    Depth,
    Mode,
    Found,
    MaybeLength,
    MaybePoint,
    MaybeFound,
    Ints,
    Points,
    Cells,
    Date,
    Time,
    Area,
    Shares,
    Marks,
}

const VALUES: [Ty; 16] = [
    Ty::Bool,
    Ty::Int,
    Ty::Length,
    Ty::Ratio,
    Ty::Angle,
    Ty::Heading,
    Ty::Point,
    Ty::Vector,
    Ty::Found,
    Ty::Mode,
    Ty::MaybeLength,
    Ty::MaybePoint,
    Ty::MaybeFound,
    Ty::Date,
    Ty::Time,
    Ty::Area,
];

impl Ty {
    fn name(self) -> &'static str {
        match self {
            Ty::MaybeLength => "Length?",
            Ty::MaybePoint => "Point?",
            Ty::MaybeFound => "Found?",
            Ty::Ints => "[Int; 4]",
            Ty::Points => "[Point; 3]",
            Ty::Cells => "Map[Int; 6]",
            Ty::Shares => "Map[Ratio; 12]",
            Ty::Marks => "Map[Found; 4]",
            Ty::Date => "Date",
            Ty::Time => "Duration",
            Ty::Area => "Area",
            Ty::Bool => "Bool",
            Ty::Int => "Int",
            Ty::Length => "Length",
            Ty::Ratio => "Ratio",
            Ty::Angle => "Angle",
            Ty::Heading => "Heading",
            Ty::Point => "Point",
            Ty::Vector => "Vector",
            Ty::Speed => "Speed",
            Ty::Depth => "Depth",
            Ty::Mode => "Mode",
            Ty::Found => "Found",
        }
    }

    /// What a map holds.
    fn cell(self) -> Option<Ty> {
        match self {
            Ty::Cells => Some(Ty::Int),
            Ty::Shares => Some(Ty::Ratio),
            Ty::Marks => Some(Ty::Found),
            _ => None,
        }
    }

    fn or_length(self) -> Ty {
        if self == Ty::Time { Ty::Length } else { self }
    }

    /// What `T?` holds.
    fn inside(self) -> Option<Ty> {
        match self {
            Ty::MaybeLength => Some(Ty::Length),
            Ty::MaybePoint => Some(Ty::Point),
            Ty::MaybeFound => Some(Ty::Found),
            _ => None,
        }
    }

    fn maybe(self) -> Ty {
        match self {
            Ty::Length => Ty::MaybeLength,
            Ty::Point => Ty::MaybePoint,
            Ty::Found => Ty::MaybeFound,
            other => other,
        }
    }
}

/// A name in sight.
#[derive(Clone, Debug)]
struct Name {
    text: String,
    ty: Ty,
    is_memory: bool,
}

/// Something that can be called or put on, with the types of its parameters.
#[derive(Clone, Debug)]
struct Callable {
    name: String,
    params: Vec<Ty>,
    /// How many of them have no default.
    needed: usize,
    result: Option<Ty>,
}

pub struct Generator {
    random: Random,
    out: String,
    depth: usize,
    names: Vec<Name>,
    next: usize,
    behaviors: Vec<Callable>,
    guests: Vec<Callable>,
    bends: Vec<Callable>,
    verticals: Vec<Callable>,
    /// Its mission is a guest of the vehicle.
    is_guest: bool,
    /// Those that take behaviors, and what can be given to them.
    takers: Vec<given::Taker>,
    givables: Vec<given::Givable>,
    /// Strategies from which others can be derived.
    bases: Vec<derived::Base>,
    /// Functions read no inputs.
    is_pure: bool,
    /// A mission's area can be read.
    has_area: bool,
    /// What the body finishes with, when `finish` may stand in it.
    finish: Option<Option<Ty>>,
    may_abort: bool,
    /// An overlay owns the vertical channel.
    vertical_is_taken: bool,
    /// How deep statements are nested, and how many there are: the size of a script is bounded.
    nested: usize,
    budget: usize,
    pub features: BTreeMap<&'static str, usize>,
}

/// A script and what is in it.
pub fn script(seed: u64) -> (String, BTreeMap<&'static str, usize>) {
    let mut g = Generator {
        random: Random::new(seed, 1),
        out: String::new(),
        depth: 0,
        names: Vec::new(),
        next: 0,
        behaviors: Vec::new(),
        guests: Vec::new(),
        bends: Vec::new(),
        verticals: Vec::new(),
        is_guest: seed % 3 == 1,
        takers: Vec::new(),
        givables: Vec::new(),
        bases: Vec::new(),
        is_pure: false,
        has_area: false,
        finish: None,
        may_abort: false,
        vertical_is_taken: false,
        nested: 0,
        budget: 60,
        features: BTreeMap::new(),
    };
    g.file();
    (g.out, g.features)
}

impl Generator {
    fn any_type(&mut self) -> Ty {
        VALUES[self.random.below(VALUES.len())]
    }

    fn line(&mut self, line: &str) {
        self.out.push_str(&"    ".repeat(self.depth));
        self.out.push_str(line);
        self.out.push('\n');
    }

    /// `HEAD {`, what is inside, `}`. Names declared inside are gone after it.
    fn braces(&mut self, head: &str, inside: impl FnOnce(&mut Self)) {
        self.line(&format!("{head} {{"));
        self.until_brace(inside);
    }

    /// What is inside of braces that are open, and the closing one.
    fn until_brace(&mut self, inside: impl FnOnce(&mut Self)) {
        let names = self.names.clone();
        self.depth += 1;
        self.nested += 1;
        inside(self);
        self.nested -= 1;
        self.depth -= 1;
        self.names = names;
        self.line("}");
    }

    fn count(&mut self, feature: &'static str) {
        *self.features.entry(feature).or_default() += 1;
    }

    fn fresh(&mut self, what: &str) -> String {
        self.next += 1;
        format!("{what}{}", self.next)
    }

    /// A value after a label, in every other place.
    fn perhaps(&mut self, label: &str, ty: Ty) -> String {
        if self.random.percent(50) { format!("{label}{}", self.expr(ty, 1)) } else { String::new() }
    }

    fn declare(&mut self, text: &str, ty: Ty, is_memory: bool) {
        self.names.push(Name { text: text.to_string(), ty, is_memory });
    }

    /// A name of a type, if there is one.
    fn named(&mut self, wanted: impl Fn(&Name) -> bool) -> Option<Name> {
        let found: Vec<Name> = self.names.iter().filter(|name| wanted(name)).cloned().collect();
        (!found.is_empty()).then(|| found[self.random.below(found.len())].clone())
    }
}
