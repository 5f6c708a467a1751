//! Dimensions and units. The angle is a dimension of its own, so that radians are never taken for numbers; and so is practical
//! salinity, which is no share of anything. Temperatures are degrees Celsius: a unit is a factor, and knows no other zero.

use albacore_program::Display;
use albacore_program::number::{RATIO_DECIMALS, scaled};
use std::fmt;

/// Powers of length, time, angle, mass, temperature, salinity and what a function calls `Quantity`, in halves: `m/s^0.5` has one.
#[derive(Clone, Copy, Debug)]
pub struct Dimension {
    halves: [i8; BASES.len()],
    /// Of what has no dimension: it is no share, and shown as a number. Two dimensions are equal whatever they say of it.
    is_plain: bool,
}

impl PartialEq for Dimension {
    fn eq(&self, other: &Self) -> bool {
        self.halves == other.halves
    }
}

/// No power of a dimension is above this, in halves, nor below its negative.
const HALVES_MAX: i8 = 100;

/// The symbol of each base, and its type.
const BASES: [(&str, &str); 7] = [
    ("m", "Length"),
    ("s", "Duration"),
    ("rad", "Angle"),
    ("kg", "Mass"),
    ("degC", "Temperature"),
    ("psu", "Salinity"),
    ("Quantity", "Quantity"),
];
/// The place of `Quantity` among them.
const QUANTITY: usize = BASES.len() - 1;

impl Dimension {
    /// No dimension: a share, shown in percent.
    pub const NONE: Dimension = Dimension::of([0; BASES.len()]);
    /// The same where it is a plain number, such as a gain.
    pub const NUMBER: Dimension = Dimension { is_plain: true, ..Dimension::NONE };
    /// Metres.
    pub const LENGTH: Dimension = Dimension::of([2, 0, 0, 0, 0, 0, 0]);
    /// Seconds.
    pub const TIME: Dimension = Dimension::of([0, 2, 0, 0, 0, 0, 0]);
    /// Radians.
    pub const ANGLE: Dimension = Dimension::of([0, 0, 2, 0, 0, 0, 0]);
    /// Kilograms.
    pub const MASS: Dimension = Dimension::of([0, 0, 0, 2, 0, 0, 0]);
    /// Degrees Celsius.
    pub const TEMPERATURE: Dimension = Dimension::of([0, 0, 0, 0, 2, 0, 0]);
    /// Practical salinity (PSS-78).
    pub const SALINITY: Dimension = Dimension::of([0, 0, 0, 0, 0, 2, 0]);
    /// Metres per second.
    pub const SPEED: Dimension = Dimension::of([2, -2, 0, 0, 0, 0, 0]);
    /// Metres per second squared.
    pub const ACCELERATION: Dimension = Dimension::of([2, -4, 0, 0, 0, 0, 0]);
    /// Radians per second.
    pub const TURN_RATE: Dimension = Dimension::of([0, -2, 2, 0, 0, 0, 0]);
    /// Hertz.
    pub const FREQUENCY: Dimension = Dimension::of([0, -2, 0, 0, 0, 0, 0]);

    /// Any one quantity: `Quantity` in a function, whichever it is given. No unit has this dimension, so that what can be calculated with
    /// it can be with every other.
    pub const QUANTITY: Dimension = Dimension { is_plain: true, ..Dimension::of([0, 0, 0, 0, 0, 0, 2]) };

    const fn of(halves: [i8; BASES.len()]) -> Dimension {
        Dimension { halves, is_plain: false }
    }

    /// Whether `Quantity` is in it.
    pub fn is_of_quantity(self) -> bool {
        self.halves[QUANTITY] != 0
    }

    /// The rest of it, and the halves of `Quantity` in it.
    fn without_quantity(self) -> (Dimension, i8) {
        let mut rest = self;
        let halves = std::mem::take(&mut rest.halves[QUANTITY]);
        (rest, halves)
    }

    /// This dimension where `Quantity` is another, unless a power in it is too high.
    pub fn with_quantity(self, quantity: Dimension) -> Option<Dimension> {
        let (rest, halves) = self.without_quantity();
        rest.times(quantity.power(f64::from(halves) / 2.0)?)
    }

    /// What `Quantity` is where this dimension is another.
    pub fn quantity_in(self, given: Dimension) -> Option<Dimension> {
        let (rest, halves) = self.without_quantity();
        let mut quantity = given.over(rest)?;
        for power in &mut quantity.halves {
            let twice = i16::from(*power) * 2;
            *power = (twice.checked_rem(halves.into())? == 0).then(|| twice / i16::from(halves))?.try_into().ok()?;
        }
        Some(quantity)
    }

    /// This dimension to a power, when its halves stay whole and are not too many.
    pub fn power(self, power: f64) -> Option<Dimension> {
        let mut halves = [0; BASES.len()];
        for (to, from) in halves.iter_mut().zip(self.halves) {
            let raised = f64::from(from) * power;
            if raised.fract() != 0.0 || raised.abs() > f64::from(HALVES_MAX) {
                return None;
            }
            *to = raised as i8;
        }
        Some(Dimension { halves, ..self })
    }

    /// The dimension of a product, unless a power in it is too high.
    pub fn times(self, other: Dimension) -> Option<Dimension> {
        let mut halves = self.halves;
        for (to, by) in halves.iter_mut().zip(other.halves) {
            *to = to.checked_add(by).filter(|sum| (-HALVES_MAX..=HALVES_MAX).contains(sum))?;
        }
        Some(Dimension { halves, ..self.beside(other) })
    }

    /// This dimension as that of what is made of one and another of it, such as a sum: of a share and a number, a share.
    pub fn beside(self, other: Dimension) -> Dimension {
        Dimension { is_plain: self.is_plain && other.is_plain, ..self }
    }

    /// The dimension of a quotient, unless a power in it is too high.
    pub fn over(self, other: Dimension) -> Option<Dimension> {
        self.times(other.power(-1.0)?)
    }

    /// Whether it has no dimension.
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// The name of the type whose dimension this is, if it has one.
    pub fn type_name(self) -> Option<&'static str> {
        let is_its = |d: Dimension| d == self && (d.is_plain == self.is_plain || !self.is_none());
        NAMED.iter().find(|(_, d)| is_its(*d)).map(|(name, _)| *name)
    }

    /// The dimension of a type's name.
    pub fn of_type(name: &str) -> Option<Dimension> {
        NAMED.iter().find(|(n, _)| *n == name).map(|(_, d)| *d)
    }

    /// How a value of this dimension is shown.
    pub fn display(self) -> Display {
        let shown = |unit: &str, scale: f64, decimals: u8| Display { unit: unit.to_string(), scale, decimals };
        match self {
            d if d == Self::NONE && d.is_plain => shown("", 1.0, RATIO_DECIMALS),
            d if d == Self::NONE => shown("%", 0.01, 1),
            d if d == Self::LENGTH => shown("m", 1.0, 1),
            d if d == Self::TIME => shown("s", 1.0, 1),
            d if d == Self::ANGLE => shown("deg", std::f64::consts::PI / 180.0, 1),
            d if d == Self::SPEED => shown("m/s", 1.0, 2),
            d if d == Self::TEMPERATURE => shown("degC", 1.0, 2),
            d if d == Self::SALINITY => shown("psu", 1.0, 2),
            d if d == Self::TURN_RATE => shown("deg/s", std::f64::consts::PI / 180.0, 1),
            d if d == Self::FREQUENCY => shown("Hz", 1.0, 4),
            d => shown(&d.symbol(), 1.0, 4),
        }
    }

    /// A unit of this dimension as a script writes it: units are divided, and not multiplied.
    pub fn unit(self) -> String {
        let shown = self.display().unit;
        if !shown.contains(' ') && !shown.starts_with("1/") {
            return shown;
        }
        let mut parts: Vec<(&str, i8)> = self.bases().map(|((symbol, _), halves)| (symbol, halves)).collect();
        parts.sort_by_key(|(_, halves)| *halves < 0);
        let word = |(i, (symbol, halves)): (usize, &(&str, i8))| {
            format!("{symbol}{}", power(if i == 0 { *halves } else { -halves }))
        };
        parts.iter().enumerate().map(word).collect::<Vec<_>>().join("/")
    }

    /// The bases that it has, each with its power in halves.
    fn bases(self) -> impl Iterator<Item = ((&'static str, &'static str), i8)> {
        BASES.into_iter().zip(self.halves).filter(|(_, halves)| *halves != 0)
    }

    /// As a script writes the type of what has no other name: `Quantity^2/Duration`.
    fn product_of_types(self) -> String {
        let factor = |((_, name), halves): ((&str, &str), i8)| format!("{name}{}", power(halves.abs()));
        let mut above: Vec<String> = self.bases().filter(|(_, halves)| *halves > 0).map(factor).collect();
        // What a function is given comes first.
        above.reverse();
        let below = self.bases().filter(|(_, halves)| *halves < 0).map(factor);
        let above = if above.is_empty() { "Ratio".to_string() } else { above.join("*") };
        below.fold(above, |product, factor| format!("{product}/{factor}"))
    }

    fn symbol(self) -> String {
        let part = |positive: bool| {
            let mut parts = Vec::new();
            for ((symbol, _), halves) in self.bases() {
                let halves = if positive { halves } else { -halves };
                match halves {
                    h if h <= 0 => {}
                    2 => parts.push(symbol.to_string()),
                    h if h % 2 == 0 => parts.push(format!("{symbol}{}", h / 2)),
                    h => parts.push(format!("{symbol}^{}", f64::from(h) / 2.0)),
                }
            }
            parts
        };
        match (part(true).as_slice(), part(false).as_slice()) {
            ([], []) => String::new(),
            (above, []) => above.join(" "),
            ([], below) => format!("1/{}", below.join("/")),
            (above, below) => format!("{}/{}", above.join(" "), below.join("/")),
        }
    }
}

/// A power in halves, as it is written behind what is raised to it.
fn power(halves: i8) -> String {
    match halves {
        2 => String::new(),
        h if h % 2 == 0 => format!("^{}", h / 2),
        h => format!("^{}", f64::from(h) / 2.0),
    }
}

/// The type's name where it has one, else its units.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.type_name() {
            Some(name) => f.write_str(name),
            None if self.is_of_quantity() => f.write_str(&self.product_of_types()),
            None => write!(f, "a quantity in {}", self.symbol()),
        }
    }
}

/// Types that are a dimension and nothing more. The first name of a dimension is the one that messages use.
pub const NAMED: [(&str, Dimension); 16] = [
    ("Ratio", Dimension::NONE),
    ("Number", Dimension::NUMBER),
    ("Length", Dimension::LENGTH),
    ("Duration", Dimension::TIME),
    ("Angle", Dimension::ANGLE),
    ("Mass", Dimension::MASS),
    ("Temperature", Dimension::TEMPERATURE),
    ("Salinity", Dimension::SALINITY),
    ("Speed", Dimension::SPEED),
    ("Acceleration", Dimension::of([2, -4, 0, 0, 0, 0, 0])),
    ("TurnRate", Dimension::TURN_RATE),
    ("Frequency", Dimension::FREQUENCY),
    ("Surface", Dimension::of([4, 0, 0, 0, 0, 0, 0])),
    ("Diffusivity", Dimension::of([4, -2, 0, 0, 0, 0, 0])),
    ("RandomWalk", Dimension::of([2, -1, 0, 0, 0, 0, 0])),
    ("Quantity", Dimension::QUANTITY),
];

/// A unit: how many SI units one of it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Its dimension.
    pub dimension: Dimension,
    /// SI units in one of it.
    pub scale: f64,
}

impl Unit {
    /// A number of it in SI units.
    pub fn si(self, number: f64) -> f64 {
        scaled(number, self.scale)
    }
}

/// A degree, rad.
pub const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The units that every script knows, by the word that names them.
pub const UNITS: [(&str, Dimension, f64); 27] = [
    ("%", Dimension::NONE, 0.01),
    ("m", Dimension::LENGTH, 1.0),
    ("mm", Dimension::LENGTH, 0.001),
    ("cm", Dimension::LENGTH, 0.01),
    ("km", Dimension::LENGTH, 1000.0),
    ("nmi", Dimension::LENGTH, 1852.0),
    ("ft", Dimension::LENGTH, 0.3048),
    ("s", Dimension::TIME, 1.0),
    ("ms", Dimension::TIME, 0.001),
    ("us", Dimension::TIME, 1e-6),
    ("min", Dimension::TIME, 60.0),
    ("h", Dimension::TIME, 3600.0),
    ("deg", Dimension::ANGLE, DEGREE),
    ("rad", Dimension::ANGLE, 1.0),
    ("mrad", Dimension::ANGLE, 0.001),
    ("kn", Dimension::SPEED, 1852.0 / 3600.0),
    ("knot", Dimension::SPEED, 1852.0 / 3600.0),
    ("knots", Dimension::SPEED, 1852.0 / 3600.0),
    ("Hz", Dimension::FREQUENCY, 1.0),
    ("kHz", Dimension::FREQUENCY, 1000.0),
    ("mHz", Dimension::FREQUENCY, 0.001),
    ("kg", Dimension::MASS, 1.0),
    ("g", Dimension::MASS, 0.001),
    ("mg", Dimension::MASS, 1e-6),
    ("ppm", Dimension::NONE, 1e-6),
    ("degC", Dimension::TEMPERATURE, 1.0),
    ("psu", Dimension::SALINITY, 1.0),
];

/// A word of a unit with its power: `m2`, `s^0.5`, `deg`.
fn word(text: &str, known: &dyn Fn(&str) -> Option<Unit>) -> Option<Unit> {
    if let Some(unit) = known(text) {
        return Some(unit);
    }
    let split = text.find(|c: char| c.is_ascii_digit() || c == '^')?;
    let power: f64 = text[split..].trim_start_matches('^').parse().ok()?;
    let base = known(&text[..split])?;
    Some(Unit { dimension: base.dimension.power(power)?, scale: albacore_geometry::math::pow(base.scale, power) })
}

/// The words of a unit such as `m2/s`, without their powers, and each that has one with it too.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split('/').flat_map(|word| {
        let power = word.find(|c: char| c.is_ascii_digit() || c == '^');
        [Some(word), power.map(|at| &word[..at])].into_iter().flatten()
    })
}

/// The unit that a text such as `cm/s` names; `own` knows the units that the script declares.
pub fn unit(text: &str, own: &dyn Fn(&str) -> Option<Unit>) -> Option<Unit> {
    let known = |name: &str| {
        own(name)
            .or_else(|| UNITS.iter().find(|(n, ..)| *n == name).map(|&(_, dimension, scale)| Unit { dimension, scale }))
    };
    let mut words = text.split('/');
    let mut product = word(words.next()?, &known)?;
    for below in words {
        let below = word(below, &known)?;
        product = Unit { dimension: product.dimension.over(below.dimension)?, scale: product.scale / below.scale };
    }
    Some(product)
}
