//! The mutator: reads a script as words with their places, and makes of each place what somebody might have written there.

use super::slips;
use std::collections::BTreeMap;

/// A kind of mix-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    UnitDropped,
    OtherDimension,
    SpeedForLength,
    KnotsForMetres,
    RadiansForDegrees,
    ShareForPercent,
    OutOfRange,
    BeyondLimit,
    DepthForAltitude,
    HeadingForAngle,
    PointForVector,
    OtherType,
    OtherBehavior,
    PayloadAction,
    Recorded,
    MapCell,
    Corners,
    DateForDuration,
    Rhythm,
    Derived,
    WithField,
    Reported,
    Exchanged,
    PeriodForRate,
    VariantOfOther,
    AbsentForgotten,
}

impl Kind {
    /// All kinds, and how many of each are made.
    pub const ALL: [(Kind, usize); 26] = [
        (Kind::UnitDropped, 14),
        (Kind::OtherDimension, 16),
        (Kind::SpeedForLength, 8),
        (Kind::KnotsForMetres, 6),
        (Kind::RadiansForDegrees, 5),
        (Kind::ShareForPercent, 3),
        (Kind::OutOfRange, 7),
        (Kind::BeyondLimit, 4),
        (Kind::DepthForAltitude, 8),
        (Kind::HeadingForAngle, 7),
        (Kind::PointForVector, 6),
        (Kind::OtherType, 16),
        (Kind::OtherBehavior, 7),
        (Kind::PayloadAction, 9),
        (Kind::Recorded, 6),
        (Kind::MapCell, 7),
        (Kind::Corners, 6),
        (Kind::DateForDuration, 8),
        (Kind::Rhythm, 6),
        (Kind::Derived, 7),
        (Kind::WithField, 5),
        (Kind::Reported, 9),
        (Kind::Exchanged, 4),
        (Kind::PeriodForRate, 3),
        (Kind::VariantOfOther, 3),
        (Kind::AbsentForgotten, 2),
    ];

    pub fn title(self) -> &'static str {
        match self {
            Kind::UnitDropped => "A number without its unit",
            Kind::OtherDimension => "A unit of another dimension: metres for seconds, degrees for metres",
            Kind::SpeedForLength => "A speed for a length, a length for a speed",
            Kind::KnotsForMetres => "Knots for metres",
            Kind::RadiansForDegrees => "Radians outside a range in degrees",
            Kind::ShareForPercent => "A share for a percentage, outside its range",
            Kind::OutOfRange => {
                "A unit of the same dimension, outside a range: centimetres for metres, minutes for seconds"
            }
            Kind::BeyondLimit => "Metres a second for knots, beyond the mission's limit",
            Kind::DepthForAltitude => "Depth for altitude",
            Kind::HeadingForAngle => "A heading for an angle, an angle for a heading",
            Kind::PointForVector => "A point for a vector, a vector for a point",
            Kind::OtherType => "A variable of another type",
            Kind::OtherBehavior => "A behavior that takes something else, or is none",
            Kind::PayloadAction => "A payload that is asked what it has not, and an answer that is read for another",
            Kind::Recorded => "What is no input is recorded, or at what is no rate",
            Kind::MapCell => "A cell of another type, a place that is none",
            Kind::Corners => "Too few corners, or one that is no place",
            Kind::DateForDuration => "A date for a time, a time for a date",
            Kind::Rhythm => "Every of what is no time, or where nothing fires",
            Kind::Derived => "A strategy or scenario like one that it is not",
            Kind::WithField => "A field that is not there, or of another type",
            Kind::Reported => "A report that is not made so",
            Kind::Exchanged => "Two that are exchanged",
            Kind::PeriodForRate => "A period for a rate, a rate for a period",
            Kind::VariantOfOther => "A name that is none of the enum",
            Kind::AbsentForgotten => "What may be absent, taken as there",
        }
    }
}

/// A script.
pub struct Text {
    pub path: &'static str,
    text: String,
    words: Vec<Word>,
}

/// A number or date, a name or unit, a text, or a sign.
struct Word {
    start: usize,
    end: usize,
    line: usize,
}

/// One mix-up: `from` at a place becomes `to`.
#[derive(Clone, Debug)]
pub struct Edit {
    pub text: usize,
    pub line: usize,
    pub from: String,
    pub to: String,
    /// What a slip writes: each is chosen once.
    slip: Option<&'static str>,
    start: usize,
    end: usize,
}

/// Units, each with the dimension that it is of.
const UNITS: [(&str, &str); 10] = [
    ("m", "length"),
    ("cm", "length"),
    ("s", "time"),
    ("min", "time"),
    ("h", "time"),
    ("deg", "angle"),
    ("m/s", "speed"),
    ("cm/s", "speed"),
    ("kn", "speed"),
    ("%", "share"),
];

impl Edit {
    pub fn of(self, slip: &'static str) -> Self {
        Edit { slip: Some(slip), ..self }
    }
}

impl Text {
    pub fn new(path: &'static str, text: String) -> Self {
        let words = words(&text);
        Text { path, text, words }
    }

    /// The script with one mix-up in it.
    pub fn with(&self, edit: &Edit) -> String {
        format!("{}{}{}", &self.text[..edit.start], edit.to, &self.text[edit.end..])
    }

    pub fn len(&self) -> usize {
        self.words.len()
    }

    pub fn line(&self, index: usize) -> usize {
        self.words[index].line
    }

    pub fn word(&self, index: usize) -> &str {
        self.words.get(index).map_or("", |w| &self.text[w.start..w.end])
    }

    pub fn edit(&self, text: usize, first: usize, last: usize, to: &str) -> Edit {
        let (start, end) = (self.words[first].start, self.words[last].end);
        Edit {
            text,
            line: self.words[first].line,
            from: self.text[start..end].to_string(),
            to: to.to_string(),
            slip: None,
            start,
            end,
        }
    }

    /// Whether nothing on its line tells what is wanted there, so that a mix-up shows later: a value that a name without
    /// a type stands for, a factor, what is recorded, and what people read.
    fn is_untold(&self, index: usize) -> bool {
        let line = self.words[index].line;
        let first = self.words.partition_point(|w| w.line < line);
        let factor = ["*", "/", "^"];
        let named = matches!(self.word(first), "let" | "signal" | "const") && self.word(first + 2) != ":";
        let shown = (first..index).any(|i| self.word(i) == "report");
        named
            || shown
            || matches!(self.word(first), "record" | "log" | "}" | "flow" | "plume")
            || factor.contains(&self.word(index + 1))
            || index > 0 && factor.contains(&self.word(index - 1))
    }

    /// The types of the names that an item's words may stand for: its parameters, and what is declared in it with a type.
    fn types_at(&self, index: usize) -> BTreeMap<&str, &str> {
        let heads = ["behavior", "strategy", "overlay", "mission", "fn", "scenario", "test", "record", "enum", "use"];
        let is_head = |i: usize| self.is_at_margin(i) && heads.contains(&self.word(i));
        let from = (0..=index).rev().find(|&i| is_head(i)).unwrap_or(0);
        let to = (index + 1..self.words.len()).find(|&i| is_head(i)).unwrap_or(self.words.len());
        let mut types = BTreeMap::new();
        for i in from..to {
            let is_type = self.word(i + 2).starts_with(|c: char| c.is_ascii_uppercase());
            // What is declared further in is not known everywhere: parameters and what stands one level in are.
            let indent = self.words[i].start - self.text[..self.words[i].start].rfind('\n').map_or(0, |n| n + 1);
            let is_outer = !matches!(self.word(i.wrapping_sub(1)), "memory" | "let") || indent <= 12;
            let is_name = !self.word(i).starts_with('"');
            if is_name && self.word(i + 1) == ":" && is_type && is_outer && self.word(i + 3) != "?" {
                types.insert(self.word(i), self.word(i + 2));
            }
        }
        types
    }

    fn is_in_function(&self, index: usize) -> bool {
        let mut heads =
            (0..=index).rev().filter(|&i| self.is_at_margin(i) && self.word(i) != "}" && self.word(i) != ")");
        heads.next().is_some_and(|i| self.word(i) == "fn")
    }

    fn is_at_margin(&self, index: usize) -> bool {
        let start = self.words[index].start;
        start == 0 || self.text.as_bytes()[start - 1] == b'\n'
    }

    /// All mix-ups of a kind.
    fn edits(&self, kind: Kind, text: usize) -> Vec<Edit> {
        let mut edits = slips::edits(kind, text, self);
        for i in 0..self.words.len() {
            if !self.is_untold(i) {
                self.quantity(kind, text, i, &mut edits);
                self.name(kind, text, i, &mut edits);
            }
        }
        edits
    }

    /// Mix-ups of a number and its unit.
    fn quantity(&self, kind: Kind, text: usize, i: usize, edits: &mut Vec<Edit>) {
        let number = self.word(i);
        if !number.starts_with(|c: char| c.is_ascii_digit()) || self.is_untold(i + 1) {
            return;
        }
        let Some((unit, dimension)) = UNITS.iter().find(|(unit, _)| *unit == self.word(i + 1)) else { return };
        let mut unit_becomes = |to: &str| edits.push(self.edit(text, i + 1, i + 1, to));
        // `= 20 deg in 20 deg..70 deg`: the default of a parameter with a range, after its first bound.
        let ranged = self.word(i + 2) == "in" && self.word(i.wrapping_sub(1)) == "=";
        let is_speed = self.word(i.wrapping_sub(1)) == "speed";
        let least = self.word(i + 3).parse::<f64>().unwrap_or(0.0);
        match (kind, *dimension) {
            // `4 %` is 0.04, and `4` is a number too: only a range tells.
            (Kind::UnitDropped, d) if d != "share" => edits.push(self.edit(text, i, i + 1, number)),
            (Kind::OtherDimension, "length") => unit_becomes("s"),
            (Kind::OtherDimension, "time") => unit_becomes("m"),
            (Kind::OtherDimension, "angle") => unit_becomes("m"),
            (Kind::OtherDimension, "speed") => unit_becomes("deg"),
            (Kind::OtherDimension, "share") => unit_becomes("m"),
            (Kind::SpeedForLength, "length") => unit_becomes("m/s"),
            (Kind::SpeedForLength, "speed") => unit_becomes("m"),
            (Kind::KnotsForMetres, "length") => unit_becomes("kn"),
            (Kind::RadiansForDegrees, "angle") if ranged => unit_becomes("rad"),
            (Kind::ShareForPercent, "share") if ranged => edits.push(self.edit(text, i, i + 1, number)),
            (Kind::OutOfRange, _) if ranged && least > 0.0 => match *unit {
                "m" => unit_becomes("cm"),
                // Of a range that ends hours later minutes may be in it.
                "s" if self.word(i + 7) != "h" => unit_becomes("min"),
                "min" => unit_becomes("s"),
                _ => {}
            },
            // Limits are of metres a second: 4 kn keep 2.6 m/s, and 4 m/s do not.
            (Kind::BeyondLimit, "speed") if *unit == "kn" && (is_speed || ranged) => unit_becomes("m/s"),
            _ => {}
        }
    }

    /// Mix-ups of a name with another.
    fn name(&self, kind: Kind, text: usize, i: usize, edits: &mut Vec<Edit>) {
        let kinds = [Kind::DepthForAltitude, Kind::HeadingForAngle, Kind::PointForVector, Kind::OtherType];
        if !kinds.contains(&kind) {
            return;
        }
        let name = self.word(i);
        let is_place = self.word(i + 1) == ":" || matches!(self.word(i + 1), "=" | "." | "(" | "->");
        let after = self.word(i.wrapping_sub(1));
        let setpoint = matches!(after, "at" | "keep" | "with" | "," | "{")
            || self.words[i].line != self.words[i.saturating_sub(1)].line;
        if is_place || matches!(after, "." | "memory" | "let" | "->" | "fn" | "behavior" | "area" | "amends") {
            return;
        }
        let types = self.types_at(i);
        // Inputs are known everywhere; a parameter of the same name is a label only.
        let inputs = [
            ("depth", "Depth"),
            ("altitude", "Altitude"),
            ("heading", "Heading"),
            ("course", "Heading"),
            ("position", "Point"),
        ];
        let input = inputs.iter().find(|(input, _)| *input == name && !setpoint).map(|(_, ty)| *ty);
        let Some(ty) = types.get(name).copied().or(input) else { return };
        let others = types.iter().filter(|(other, _)| **other != name).map(|(other, ty)| (*other, *ty));
        // A function reads no inputs, and a line cannot speak of what it declares.
        let inputs = inputs.iter().copied().filter(|_| !self.is_in_function(i));
        let declared = self.word(self.words.partition_point(|w| w.line < self.words[i].line) + 1);
        let others: Vec<(&str, &str)> = others.chain(inputs).filter(|(other, _)| *other != declared).collect();
        let told = |kind: Kind, other: &str| match kind {
            Kind::DepthForAltitude => matches!((ty, other), ("Depth", "Altitude") | ("Altitude", "Depth")),
            Kind::HeadingForAngle => matches!((ty, other), ("Heading", "Angle") | ("Angle", "Heading")),
            Kind::PointForVector => matches!((ty, other), ("Point", "Vector") | ("Vector", "Point")),
            // Numbers without a dimension stand for one another.
            Kind::OtherType => ty != other && !(is_number(ty) && is_number(other)),
            _ => false,
        };
        for (other, _) in others.iter().filter(|(_, other)| told(kind, other)) {
            edits.push(self.edit(text, i, i, other));
        }
    }
}

fn is_number(ty: &str) -> bool {
    matches!(ty, "Int" | "Ratio" | "Number" | "Sign")
}

/// The words of a script, without its comments and texts.
fn words(text: &str) -> Vec<Word> {
    let mut words = Vec::new();
    for (n, line) in text.split_inclusive('\n').enumerate() {
        let offset = line.as_ptr() as usize - text.as_ptr() as usize;
        let mut at = 0;
        while let Some(c) = line[at..].chars().next() {
            let rest = &line[at..];
            let length = match c {
                '/' if rest.starts_with("//") => break,
                '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
                c if c.is_whitespace() => c.len_utf8(),
                c if c.is_ascii_digit() => number(rest),
                c if c.is_alphabetic() || c == '_' => unit_or_name(rest),
                _ if rest.starts_with("->") || rest.starts_with("..") => 2,
                c => c.len_utf8(),
            };
            if !c.is_whitespace() {
                words.push(Word { start: offset + at, end: offset + at + length, line: n + 1 });
            }
            at += length;
        }
    }
    words
}

fn number(rest: &str) -> usize {
    let whole = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let fraction = rest[whole..].strip_prefix('.').filter(|f| f.starts_with(|c: char| c.is_ascii_digit()));
    // A date is one word, and so is a position on the globe.
    let date = rest
        .find('Z')
        .filter(|end| *end >= 16 && rest[..*end].bytes().all(|c| c.is_ascii_digit() || b"-T:".contains(&c)));
    if let Some(end) = date {
        return end + 1;
    }
    let geodetic = rest[whole..].starts_with('°').then(|| rest.find([',', ')']).unwrap_or(rest.len()));
    geodetic.unwrap_or(match fraction {
        Some(f) => whole + 1 + f.find(|c: char| !c.is_ascii_digit()).unwrap_or(f.len()),
        None => whole,
    })
}

fn unit_or_name(rest: &str) -> usize {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
    let speed = ["m/s", "cm/s"].into_iter().find(|unit| rest.starts_with(unit) && rest[..length].len() < unit.len());
    speed.map_or(length, |unit| if rest[unit.len()..].starts_with('^') { length } else { unit.len() })
}

/// So many mix-ups of a kind, spread over all scripts, and always the same.
pub fn choose(kind: Kind, texts: &[Text], wanted: usize) -> Vec<Edit> {
    let mut edits: Vec<Edit> = texts.iter().enumerate().flat_map(|(i, text)| text.edits(kind, i)).collect();
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64 ^ (kind as u64);
    let mut chosen: Vec<Edit> = Vec::new();
    while chosen.len() < wanted && !edits.is_empty() {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        let edit = edits.swap_remove((seed % edits.len() as u64) as usize);
        // One place is mixed up once.
        let is_same = |c: &Edit| match edit.slip {
            Some(slip) => c.slip == Some(slip),
            None => (c.text, c.start) == (edit.text, edit.start),
        };
        if !chosen.iter().any(is_same) {
            chosen.push(edit);
        }
    }
    chosen.sort_by_key(|edit| (edit.text, edit.start));
    chosen
}
