//! How to make of what was written what is asked for: by what to multiply it, in which unit to write it, what one looks like.

use super::Checker;
use super::expr::article;
use super::operators::ANGLE;
use super::quantity::ANY_UNIT;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind, InputPart};
use crate::syntax::tree::Binary;
use crate::types::{RecordInfo, Type};
use albacore_wording::listed;

/// A number that has no unit, and needs one.
pub(super) fn unit_help(constant: Option<f64>, unit: &str) -> String {
    match constant {
        Some(x) => format!("give it a unit, such as `{x} {unit}`"),
        None => format!("give it a unit: multiply it by `1 {unit}`"),
    }
}

/// By what a quantity must be multiplied or divided to become another; a constant may as well be written in another unit.
pub(super) fn scaling_help(has: Dimension, wants: Dimension, what: &str, is_constant: bool) -> String {
    let unit = wants.unit();
    let written =
        if unit.is_empty() { format!("write {what} without a unit") } else { format!("write {what} in `{unit}`") };
    match (scaling(has, wants), is_constant) {
        _ if has == Dimension::TIME && wants == Dimension::FREQUENCY => {
            "a rate is how often a second: once in 10 s is `0.1 Hz`".into()
        }
        _ if has == Dimension::FREQUENCY && wants == Dimension::TIME => {
            "a time is asked for: 10 Hz is once in `100 ms`".into()
        }
        (None, _) if has.is_of_quantity() || wants.is_of_quantity() => ANY_UNIT.into(),
        (Some(Scaling { verb, by }), _) if wants.is_of_quantity() => format!("{verb} {what} by {by}"),
        (Some(scaling), true) => format!("{written}, or {} it by {}", scaling.verb, scaling.by),
        (Some(scaling), false) => format!("{} {what} by {}", scaling.verb, scaling.by),
        (None, _) => written,
    }
}

/// How a quantity becomes one of another dimension.
struct Scaling {
    /// `multiply` or `divide`.
    verb: &'static str,
    /// By what.
    by: String,
}

/// By what a quantity must be multiplied or divided, when that has a name. A time is said as a time, not as its inverse.
fn scaling(has: Dimension, wants: Dimension) -> Option<Scaling> {
    let named = |d: Option<Dimension>| {
        let name = d?.type_name().filter(|name| *name != "Frequency")?;
        Some(format!("{} `{name}`", article(name).split(' ').next().unwrap_or_default()))
    };
    let (factor, divisor) = (named(wants.over(has)), named(has.over(wants)));
    match (divisor, factor) {
        (Some(by), _) => Some(Scaling { verb: "divide", by }),
        (None, Some(by)) => Some(Scaling { verb: "multiply", by }),
        (None, None) => None,
    }
}

/// Two quantities that should be of one dimension: which side to change, and how. What is written as a number is changed
/// more easily than what is computed.
fn sides_help(a: &Expr, d: Dimension, b: &Expr, e: Dimension) -> String {
    let (left, right) = (a.range.constant().is_some(), b.range.constant().is_some());
    if left && !right {
        scaling_help(d, e, "the left-hand side", true)
    } else if right || scaling(e, d).is_some() {
        scaling_help(e, d, "the right-hand side", right)
    } else if d.is_of_quantity() || e.is_of_quantity() {
        ANY_UNIT.into()
    } else {
        let is = |d: Dimension| match d.display().unit {
            unit if unit.is_empty() => "a number".to_string(),
            unit => format!("in `{unit}`"),
        };
        format!(
            "only quantities of one kind go together: the left-hand side is {}, the right-hand side {}",
            is(d),
            is(e)
        )
    }
}

/// What goes with a type in an operation, when nothing closer can be said.
fn partner(op: Binary, a: &Type, b: &Type) -> Option<&'static str> {
    let of = |ty: &Type| {
        Some(match ty {
            Type::Depth => "a depth is changed by a length: `depth + 2 m`",
            Type::Altitude => "an altitude is changed by a length: `altitude + 2 m`",
            Type::Date => "a date is changed by a time, `utc + 2 h`; from one to another is `DATE - DATE`",
            Type::Heading => "a heading is turned by an angle: `heading + 20 deg`",
            Type::Point => "a point is moved by a vector, `POINT + VECTOR`; from one to another leads `POINT - POINT`",
            Type::Vector(_) => "vectors are added to points, and to vectors of their own kind",
            Type::Area => "an area is not calculated with: its middle is `AREA.center`",
            _ => return None,
        })
    };
    match op {
        Binary::Add | Binary::Sub => of(a).or_else(|| of(b)),
        Binary::Mul | Binary::Div => Some("numbers and quantities are multiplied and divided, and vectors by them"),
        Binary::Toward => Some("a length and a heading make a vector: `10 m toward north`"),
        Binary::Pow => Some("a quantity is raised to a number: `x^2`"),
        _ if op.compares() => Some("only what is of one kind can be compared: two lengths, two points"),
        _ => None,
    }
}

/// What a date is calculated with.
fn of_dates(is_compared: bool) -> String {
    match is_compared {
        true => {
            "a date is compared with a date, such as `2026-08-14T05:00Z`; how long it is since is `utc - DATE`".into()
        }
        false => "a date is changed by a time: `utc + 2 h`; `DATE - DATE` is a time".into(),
    }
}

/// A number that was meant in metres.
fn in_metres(side: &str, number: &Expr) -> String {
    match number.range.constant() {
        Some(x) => format!("give the number on the {side} a unit: `{x} m`"),
        None => format!("give the number on the {side} a unit, such as `m`"),
    }
}

/// A number on one side that has no unit, beside what has a dimension.
fn unit_of_side(side: &str, other: Dimension) -> String {
    match other.is_of_quantity() {
        true => ANY_UNIT.into(),
        false => format!("give the number on the {side} a unit, such as `{}`", other.unit()),
    }
}

/// Whether a vector is written as a length toward a heading.
fn is_toward(vector: &Expr) -> bool {
    match &vector.kind {
        ExprKind::Do(Builtin::Toward, _) => true,
        ExprKind::Do(Builtin::AddVector | Builtin::SubVector, parts) => parts.iter().any(is_toward),
        _ => false,
    }
}

impl Checker<'_> {
    /// With what a place, or a word of an enum, is compared.
    fn compared_help(&self, a: &Expr, b: &Expr) -> Option<String> {
        match (&a.ty, &b.ty) {
            (Type::None | Type::Heading, _) | (_, Type::None | Type::Heading) => None,
            (Type::Point, Type::Quantity(d)) | (Type::Quantity(d), Type::Point) if *d == Dimension::LENGTH => {
                Some("how far one place is from another is `distance(PLACE, PLACE)`".into())
            }
            (word @ Type::Enum(_), _) | (_, word @ Type::Enum(_)) => self.example(word),
            _ => None,
        }
    }

    /// What to write instead of an operation that its operands do not have.
    pub(super) fn operator_help(&self, op: Binary, a: &Expr, b: &Expr) -> Option<String> {
        use Type::*;
        let takes_metres = op.compares() || matches!(op, Binary::Add | Binary::Sub);
        let is_number = |x: &Type| x.dimension().is_some_and(Dimension::is_none);
        if let Some(help) = self.compared_help(a, b).filter(|_| op.compares()) {
            return Some(help);
        }
        Some(match (op, &a.ty, &b.ty) {
            (Binary::Add, Text, _) | (Binary::Add, _, Text) => {
                "write one text, with values between `{` and `}`: `\"{a} and {b}\"`".into()
            }
            (Binary::Add | Binary::Sub, Heading, x) | (Binary::Add, x, Heading)
                if x.dimension() == Some(Dimension::NONE) =>
            {
                "give the number a unit: `deg`".into()
            }
            (_, None, _) | (_, _, None) if op.compares() => self.never_absent(if a.ty == None { b } else { a }),
            (_, Heading, _) | (_, _, Heading) if op.compares() => {
                "a heading is a direction: compare the angle between two, `abs(heading - north) < 3 deg`".into()
            }
            (Binary::Add, Heading, Heading) => {
                "a heading is turned by an angle: `HEADING + ANGLE`; the angle between two is `HEADING - HEADING`"
                    .into()
            }
            (Binary::Mul, Heading, Quantity(d)) | (Binary::Mul, Quantity(d), Heading) if *d == Dimension::LENGTH => {
                "so far in a direction is `LENGTH toward HEADING`".into()
            }
            (Binary::Mul | Binary::Div, Heading, _) | (Binary::Mul, _, Heading) => {
                "a heading is turned by an angle: `HEADING + ANGLE`".into()
            }
            (Binary::Mul | Binary::Div, Point, _) | (Binary::Mul, _, Point) => {
                "the way between two points, `POINT - POINT`, is a vector, which can be multiplied and divided".into()
            }
            (Binary::Add | Binary::Sub, Point, Quantity(d)) if *d == Dimension::LENGTH => {
                "say in which direction: `POINT + LENGTH toward HEADING`".into()
            }
            (Binary::Add | Binary::Sub, Point | Vector(_), Vector(d))
            | (Binary::Add | Binary::Sub, Vector(d), Point | Vector(_))
                if d.is_none() =>
            {
                "a direction alone has no length: give the number before `toward` a unit, such as `8 m toward north`"
                    .into()
            }
            (Binary::Add | Binary::Sub, Point | Vector(_), t) if *t == ANGLE => self.beside_angle(op, a),
            (Binary::Sub, Vector(_), Point) => "the vector from one point to another is `POINT - POINT`".into(),
            (Binary::Add, Point, Point) => {
                "a point is moved by a vector: `POINT + VECTOR`; `POINT - POINT` is a vector".into()
            }
            (_, Date, _) | (_, _, Date) if takes_metres => of_dates(op.compares()),
            (_, Depth, Altitude) | (_, Altitude, Depth) => {
                "depth is counted from the surface and altitude from the bottom; `water_depth` is both together".into()
            }
            (Binary::Add, Depth, Depth) | (Binary::Add, Altitude, Altitude) => {
                "it is changed by a length: `depth + 2 m`; the difference of two is a length".into()
            }
            (_, Depth | Altitude, Quantity(d)) | (_, Quantity(d), Depth | Altitude)
                if op.compares() && *d == Dimension::LENGTH =>
            {
                "compare with a depth or an altitude, such as `top + 1 m`, or with a constant".into()
            }
            (_, Depth | Altitude, x) if takes_metres && is_number(x) => in_metres("right", b),
            (_, x, Depth | Altitude) if takes_metres && is_number(x) => in_metres("left", a),
            (Binary::Add | Binary::Sub, x, y)
            | (Binary::Lt | Binary::Le | Binary::Gt | Binary::Ge | Binary::Eq | Binary::Ne, x, y) => {
                let (Some(d), Some(e)) = (x.dimension(), y.dimension()) else {
                    return partner(op, x, y).map(str::to_string);
                };
                if d.is_none() {
                    return Some(unit_of_side("left", e));
                }
                if e.is_none() {
                    return Some(unit_of_side("right", d));
                }
                sides_help(a, d, b, e)
            }
            (op, x, y) => return partner(op, x, y).map(str::to_string),
        })
    }

    /// A place or a vector, beside which an angle stands.
    fn beside_angle(&self, op: Binary, place: &Expr) -> String {
        match place.ty {
            _ if is_toward(place) => {
                "`toward` holds tighter than `+` and `-`: write `LENGTH toward (HEADING + ANGLE)`".into()
            }
            Type::Point => {
                "an angle turns a direction: `HEADING + ANGLE`; the direction to a place is `(PLACE - position).toward`"
                    .into()
            }
            _ => self.turned(op, place),
        }
    }

    /// How a value is called in a mend: by its name, where it has one.
    fn called<'a>(&'a self, value: &Expr, otherwise: &'a str) -> &'a str {
        match value.kind {
            ExprKind::Input(id, InputPart::Value) => &self.hir.inputs[id].name,
            ExprKind::Var(id) => &self.scope.vars[id].name,
            _ => otherwise,
        }
    }

    /// Two types of one name.
    pub(super) fn namesakes(&self) -> &'static str {
        match self.known_at_prompt() {
            Some(_) => "the type was declared again since: make the older value anew",
            None => "give one of the two types another name",
        }
    }

    /// A vector that an angle was to turn.
    pub(super) fn turned(&self, op: Binary, vector: &Expr) -> String {
        let name = self.called(vector, "VECTOR");
        format!("an angle turns the direction of a vector: `{name}.toward {} ANGLE`", op.symbol())
    }

    /// What was compared with `none`, and always has a value.
    pub(super) fn never_absent(&self, value: &Expr) -> String {
        let help = "it is never absent: leave the test out";
        match value.kind {
            ExprKind::Input(..) => {
                let name = self.called(value, "INPUT");
                format!("{help}, or ask how old the last sample is: `{name}.age > 5 s`")
            }
            _ => help.to_string(),
        }
    }

    /// What a value of a type looks like.
    pub(super) fn example(&self, ty: &Type) -> Option<String> {
        let example = match ty {
            Type::Bool => "a condition is asked for, such as `x > 3 m`, or `true`",
            Type::Int => "a whole number is asked for, such as `3`; `round(x)` makes one of another number",
            Type::Sign => "write `+1` or `-1`",
            Type::Text => "a text stands between quotes",
            Type::Heading => "a direction is asked for, such as `90 deg`, `north` or `flow.toward`",
            Type::Depth => "a depth is asked for, such as `3 m` or `depth + 1 m`",
            Type::Altitude => "an altitude is asked for, such as `3 m` or `altitude + 1 m`",
            Type::Date => "a date is asked for, such as `2026-08-14T05:00Z`, `utc` or `utc + 2 h`",
            Type::Point => {
                "a place is asked for, such as `position`, `op.center`, `36.18°N 75.74°W` or `point(north: 4 m, east: 2 m)`"
            }
            Type::Vector(_) => "a vector is asked for, such as `10 m toward north` or `POINT - POINT`",
            Type::Area => "an area is asked for: the mission's own, by its name, or `rectangle(…)`",
            Type::Line => "a line is asked for: `line(start, end)`",
            Type::Edge => "an edge is asked for: one of `area.edges`, or `area.nearest_edge(point)`",
            Type::Quantity(d) => return Some(quantity(*d)),
            Type::Record(id) => {
                let RecordInfo { name, module, .. } = &self.types.records[*id];
                let is_own = *module == self.modules[self.scope.module].name;
                let made = if is_own { name.clone() } else { format!("{module}.{name}") };
                return Some(format!("make one: `{made}(…)`"));
            }
            Type::Enum(id) => {
                let variants: Vec<&str> = self.types.enums[*id].variants.iter().map(String::as_str).collect();
                return Some(format!("there is {}", listed(&variants)));
            }
            Type::Optional(inner) => return self.example(inner),
            Type::List(..) => "a list is asked for, such as `[a, b]`",
            Type::Map(..) => "a map is asked for, such as `map(over: op, each: 0)`",
            Type::None | Type::Unknown => return None,
        };
        Some(example.to_string())
    }
}

fn quantity(d: Dimension) -> String {
    let example = match d.type_name() {
        Some("Ratio" | "Number") => "a number is asked for, such as `0.5` or `5 %`",
        Some("Length") => "a length is asked for, such as `10 m`",
        Some("Duration") => "a time is asked for, such as `30 s`",
        Some("Angle") => "an angle is asked for, such as `15 deg`",
        Some("Speed") => "a speed is asked for, such as `1.5 m/s`",
        _ if d.is_of_quantity() => "a quantity is asked for, such as `10 m` or `0.5`",
        _ => return format!("a quantity in `{}` is asked for", d.display().unit),
    };
    example.to_string()
}
