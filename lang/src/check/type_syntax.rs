//! Types and units as they are written.

use super::maps::MAP_CELLS_MAX;
use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::{self, Dimension, Unit};
use crate::source::Span;
use crate::syntax::tree::{self, Ty, TyKind};
use crate::types::Type;
use albacore_wording::nearest;

/// Lists hold this many elements at most.
pub(super) const LIST_CAPACITY_MAX: u32 = 1024;

impl<'t> Checker<'t> {
    /// The unit that a word names in a module, if it names one.
    pub(super) fn unit_if(&self, module: usize, word: &str) -> Option<Unit> {
        dimension::unit(word, &|name| self.own_unit(module, name))
    }

    /// What is meant by a unit with digits in it: `1h30min`, `0x1f`.
    fn digits_in_unit(&self, module: usize, word: &str) -> Option<String> {
        if word.strip_prefix('x').is_some_and(|digits| digits.chars().all(|c| c.is_ascii_hexdigit())) && word.len() > 1
        {
            return Some("numbers are decimal: write this one with the digits 0 to 9".to_string());
        }
        let (unit, rest) = word.split_at(word.find(|c: char| c.is_ascii_digit())?);
        let (number, other) = rest.split_at(rest.find(|c: char| !c.is_ascii_digit())?);
        (self.unit_if(module, unit).is_some() && self.unit_if(module, other).is_some())
            .then(|| format!("add them: `… {unit} + {number} {other}`"))
    }

    /// The unit that a word names in a module.
    pub(super) fn unit(&mut self, module: usize, word: &tree::Name) -> Option<Unit> {
        let found = self.unit_if(module, &word.node);
        // A unit may be made of several: `fathom/s`.
        let mut start = word.span.start;
        for part in word.node.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_') {
            let name = part.trim_end_matches(|c: char| !c.is_alphanumeric() && c != '_');
            let at = Span { start, end: start + name.len() as u32, ..word.span };
            self.refer_to(at, module, name, |def| matches!(def, Def::Unit(_)));
            start += part.len() as u32;
        }
        if found.is_none() {
            let known: Vec<&str> = dimension::UNITS.iter().map(|(name, ..)| *name).collect();
            let finding = Diagnostic::error(Code::UnitsUnknown, word.span, format!("`{}` is no unit", word.node))
                .here("unknown unit");
            let finding = if let Some((unit, name)) = word.node.split_once('/')
                && self.unit_if(module, unit).is_some()
            {
                match nearest_unit(name, &known).filter(|_| name.len() > 1) {
                    Some(near) => finding.help(format!("did you mean `{unit}/{near}`?")),
                    None => finding.help(format!("to divide by a variable, write a blank: `{unit} / {name}`")),
                }
            } else if let Some(habit) = self.digits_in_unit(module, &word.node) {
                finding.help(habit)
            } else if matches!(word.node.as_str(), "N" | "E" | "W" | "°N" | "°S" | "°E" | "°W") {
                finding.help("a position is its latitude, a blank and its longitude: `36.18°N 75.74°W`")
            } else if word.node == "rpm" {
                finding.help("turns are counted in `Hz`, turns a second: 60 of them a minute are `1 Hz`")
            } else if matches!(word.node.as_str(), "K" | "kelvin" | "degF") {
                finding.help("temperatures are in `degC`: 0 degC is 273.15 K and 32 degF")
            } else if word.node == "M" {
                finding.help("metres are `m`, nautical miles `nmi`")
            } else if matches!(word.node.as_str(), "bar" | "dbar" | "mbar" | "Pa" | "kPa") {
                finding.help("a depth is written in metres: 1 dbar is about 1 m of water")
            } else if let Some(near) = nearest_unit(&word.node, &known) {
                finding.help(format!("did you mean `{near}`?"))
            } else {
                finding.help("units are m, cm, km, nmi, ft, s, min, h, deg, rad, m/s, kn, Hz, %, kg, g, degC, psu and what they make, such as m2/s")
            };
            self.report(finding);
        }
        found
    }

    /// The type that is written, of what is not kept in order.
    pub(super) fn written_type(&mut self, m: usize, ty: &Ty) -> Type {
        if let TyKind::List { order: Some((_, key)), .. } = &ty.kind {
            let message = "only a list that a `memory` or a `var` holds is kept in order";
            self.report(Diagnostic::error(Code::TypesKey, key.span, message).help(
                "leave `by …` out here; what is given such a list puts it in order itself: `var sorted: [Point; 6] by most KEY = places`",
            ));
        }
        self.kept_type(m, ty)
    }

    /// The same of a `memory` or a `var`, whose list may be kept in order.
    pub(super) fn kept_type(&mut self, m: usize, ty: &Ty) -> Type {
        let inner = match &ty.kind {
            TyKind::List { element, capacity, .. } => {
                let element = self.written_type(m, element);
                match self.capacity(m, capacity, LIST_CAPACITY_MAX, "a list's capacity is a constant") {
                    Some(n) => Type::List(Box::new(element), n),
                    None => Type::Unknown,
                }
            }
            TyKind::Map { element, cells } => {
                let element = self.written_type(m, element);
                match self.capacity(m, cells, MAP_CELLS_MAX, "how many cells a map has at most is a constant") {
                    Some(n) => Type::Map(Box::new(element), n),
                    None => Type::Unknown,
                }
            }
            TyKind::Named { path, factors } => self.named_type(m, path, factors),
            TyKind::Behavior(..) => {
                let message = "a behavior is no value";
                let finding = Diagnostic::error(Code::TypesBehavior, ty.span, message);
                self.report(
                    finding.help("only a parameter of a behavior or a strategy can be one: `at_each: behavior(Point)`"),
                );
                Type::Unknown
            }
        };
        if ty.optional { inner.optional() } else { inner }
    }

    /// How much a list or a map holds at most.
    fn capacity(&mut self, m: usize, written: &tree::Expr, most: u32, message: &str) -> Option<u32> {
        let scope = Scope { capacities: self.scope.capacities.clone(), ..Scope::new(m, Setting::Constant) };
        let (capacity, _) = self.within(scope, |c| c.expr_as(written, &Type::Int, "the capacity"));
        let known = capacity.range.constant().filter(|n| (1.0..=f64::from(most)).contains(n));
        if known.is_none() && capacity.ty != Type::Unknown {
            let finding = Diagnostic::error(Code::TypesCapacity, capacity.span, message);
            self.report(finding.help(format!("a whole number from 1 to {most}")));
        }
        known.map(|n| n as u32)
    }

    fn named_type(&mut self, m: usize, path: &tree::Path, factors: &[(tree::Name, f64)]) -> Type {
        let name = path.text();
        if !self.quantity_is_known(path, factors) {
            return Type::Unknown;
        }
        if !factors.is_empty() {
            let mut dimension = self.dimension_of(&path.parts[0]).unwrap_or(Dimension::NONE);
            for (factor, power) in factors {
                let Some(d) = self.dimension_of(factor) else { continue };
                let raised = d.power(*power).and_then(|d| dimension.times(d));
                let Some(raised) = self.writable(raised, "type", factor.span) else { return Type::Unknown };
                dimension = raised;
            }
            return Type::Quantity(dimension);
        }
        let simple = match name.as_str() {
            "Bool" => Some(Type::Bool),
            "Int" => Some(Type::Int),
            "Sign" => Some(Type::Sign),
            "Text" => Some(Type::Text),
            "Heading" => Some(Type::Heading),
            "Depth" => Some(Type::Depth),
            "Altitude" => Some(Type::Altitude),
            "Date" => Some(Type::Date),
            "Point" => Some(Type::Point),
            "Vector" => Some(Type::Vector(Dimension::LENGTH)),
            "Velocity" => Some(Type::Vector(Dimension::SPEED)),
            "Direction" => Some(Type::Vector(Dimension::NUMBER)),
            "Area" => Some(Type::Area),
            "Edge" => Some(Type::Edge),
            "Line" => Some(Type::Line),
            other => Dimension::of_type(other).map(Type::Quantity),
        };
        if let Some(ty) = simple {
            return ty;
        }
        match self.resolve(m, path).cloned() {
            Some(Def::Record(id)) => Type::Record(id),
            Some(Def::Enum(id)) => Type::Enum(id),
            Some(def) => {
                self.report(Diagnostic::error(
                    Code::TypesUnknown,
                    path.span,
                    format!("`{name}` is {}, no type", def.what()),
                ));
                Type::Unknown
            }
            None => {
                let mut known: Vec<&str> = dimension::NAMED.iter().map(|(n, _)| *n).collect();
                known.extend(SIMPLE_TYPES);
                let declared = self.names[m].iter().filter(|(_, d)| matches!(d, Def::Record(_) | Def::Enum(_)));
                known.extend(declared.map(|(n, _)| n.as_str()));
                let finding = Diagnostic::error(Code::TypesUnknown, path.span, format!("there is no type `{name}`"));
                let elsewhere = self.import_with(m, &name, |def| matches!(def, Def::Record(_) | Def::Enum(_)));
                let finding = match self.nearest(&name, known) {
                    _ if name == "Map" => {
                        finding.help("say what a cell holds, and how many there are at most: `Map[Ratio; 900]`")
                    }
                    _ if let Some(module) = elsewhere => finding.help(format!("write `{module}.{name}`")),
                    Some(near) => finding.help(format!("did you mean `{near}`?")),
                    None => finding.help("types are Length, Duration, Speed, Angle, Heading, Depth, Altitude, Point, Vector, Int, Bool, … and the records and enums declared"),
                };
                self.report(finding);
                Type::Unknown
            }
        }
    }

    fn dimension_of(&mut self, name: &tree::Name) -> Option<Dimension> {
        let found = Dimension::of_type(&name.node);
        if found.is_none() {
            self.report(
                Diagnostic::error(Code::TypesUnknown, name.span, format!("`{}` is no quantity", name.node))
                    .help("only quantities such as Length and Duration can be multiplied and divided"),
            );
        }
        found
    }
}

const SIMPLE_TYPES: [&str; 15] = [
    "Bool",
    "Int",
    "Sign",
    "Text",
    "Heading",
    "Depth",
    "Altitude",
    "Date",
    "Point",
    "Vector",
    "Velocity",
    "Direction",
    "Area",
    "Edge",
    "Line",
];

/// Whether a name is that of a type which every script knows.
pub(super) fn is_type(name: &str) -> bool {
    SIMPLE_TYPES.contains(&name) || name == "Map" || Dimension::of_type(name).is_some()
}

/// The unit that a word was probably meant to be: what people write elsewhere, then what is spelt alike.
fn nearest_unit<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let meant = match word {
        "sec" | "secs" | "second" | "seconds" => "s",
        "minute" | "minutes" | "mins" => "min",
        "hour" | "hours" | "hr" | "hrs" => "h",
        "metre" | "metres" | "meter" | "meters" => "m",
        "degree" | "degrees" | "°" => "deg",
        "radian" | "radians" => "rad",
        "kt" | "kts" => "kn",
        "percent" => "%",
        "nm" | "NM" | "nmile" | "nmiles" => "nmi",
        "°C" | "℃" | "celsius" | "Celsius" | "C" => "degC",
        "ppt" | "‰" | "PSU" | "pss" | "PSS" => "psu",
        "mps" => return Some("m/s"),
        "kmh" | "kph" | "kmph" => return Some("km/h"),
        "feet" | "foot" => "ft",
        _ => return nearest(word, known.iter().copied()),
    };
    known.iter().copied().find(|k| *k == meant)
}
