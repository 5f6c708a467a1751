//! Expressions of a wanted type. Every operation stands in parentheses: precedence is the parser's business.

use super::area::operation_of_place;
use super::{Generator, Ty};
use crate::random::Random;

/// What makes a truth.
const CONDITIONS: [&str; 25] = [
    "($E > $E)",
    "($T < $T)",
    "($Z.contains($P))",
    "($C == $C)",
    "($E == $E)",
    "($L < $L)",
    "($L >= $L)",
    "($R > $R)",
    "($I == $I)",
    "($I != $I)",
    "(not $B)",
    "($B and $B)",
    "($B or $B)",
    "($H == $H)",
    "($M == $M)",
    // Alone it would show that what is tested by `if let` afterwards is never absent.
    "(($p != none) or $B)",
    "($D > $D)",
    "($S <= $S)",
    "($P == $P)",
    "($A < $A)",
    "($F == $F)",
    "($i == $i)",
    "($l == $l)",
    "($q != $q)",
    "($i.count > 1)",
];

/// What makes a whole number.
const INTS: [&str; 12] = [
    "($I + $I)",
    "($I - $I)",
    "($I * 2)",
    "$i.count",
    "min($I, $I)",
    "floor($R)",
    "round($R * 3)",
    "($i.first else $I)",
    "($i[abs($I)] else $I)",
    "$q.count",
    "$i.top($I).count",
    "many($I, $M)",
];

/// What makes a length.
const LENGTHS: [&str; 22] = [
    "$Z.gap($P)",
    "$Z.run($P, toward: $H)",
    "$C.cell",
    "($L + $L)",
    "($L - $L)",
    "($R * $L)",
    "abs($L)",
    "distance($P, $P)",
    "$P.north",
    "($V).length",
    "$P.along($H)",
    "max($L, $L)",
    "clamp($L, 1 m, 30 m)",
    "($l else $L)",
    "($D - $D)",
    "$F.size",
    "$q.spread($H)",
    "line($P, $P).length",
    "sqrt(abs($L) * 4 m)",
    "twice($L, $I)",
    "nearer($L, $L)",
    "middle([$L, $L])",
];

/// What makes a ratio.
const RATIOS: [&str; 20] = [
    "(($E - $E) / 7 s)",
    "($T / 2 s)",
    "total($C)",
    "entropy($C)",
    "($C[$P] else $R)",
    "($R + $R)",
    "($R - $R)",
    "($R * $R)",
    "($L / 7 m)",
    "share($L, $L)",
    "nearer($R, $R)",
    "middle([$R, $L / 1 m, $R])",
    "sin($A)",
    "cos($A)",
    "exp($R)",
    "ln(max(abs($R), 1e-9))",
    "($I / 3)",
    "max($R, $R)",
    "(-$R)",
    "(abs($R) ^ 0.5)",
];

impl Generator {
    /// An expression of a type, so many operations deep.
    pub(super) fn expr(&mut self, ty: Ty, deep: usize) -> String {
        if self.random.percent(35)
            && let Some(name) = self.named(|name| name.ty == ty)
        {
            return name.text;
        }
        if deep > 0 && !matches!(ty, Ty::Ints | Ty::Points) && self.random.percent(8) {
            self.count("if value");
            let (condition, then, otherwise) =
                (self.expr(Ty::Bool, deep - 1), self.expr(ty, deep - 1), self.expr(ty, deep - 1));
            return format!("(if {condition} {{ {then} }} else {{ {otherwise} }})");
        }
        if deep > 0 && ty == Ty::Length && self.random.percent(5) {
            self.count("match value");
            let mode = self.expr(Ty::Mode, 0);
            let (a, b) = (self.expr(ty, deep - 1), self.expr(ty, deep - 1));
            return format!("(match {mode} {{ calm, wild {{ {a} }}; else {{ {b} }} }})");
        }
        if deep > 0
            && ty == Ty::Int
            && self.random.percent(10)
            && let Some(map) = self.named(|name| name.ty == Ty::Cells)
        {
            self.count("cell");
            let place = self.expr(Ty::Point, deep - 1);
            return format!("({}[{place}] else {}.count)", map.text, map.text);
        }
        let simple = deep == 0 || self.random.percent(30);
        let choice = if simple { self.leaf(ty) } else { self.operation(ty) };
        self.filled(&choice, deep.saturating_sub(1))
    }

    /// A value for a variable or parameter of a type: one that may be absent is made of one that is there, or of none.
    pub(super) fn given(&mut self, ty: Ty, deep: usize) -> String {
        match (ty.inside(), self.random.below(4)) {
            (Some(_), 0) => "none".to_string(),
            (Some(inside), 1) => self.expr(inside, deep),
            _ => self.expr(ty, deep),
        }
    }

    /// A pattern with its holes filled: `$L` is a length.
    pub(super) fn filled(&mut self, pattern: &str, deep: usize) -> String {
        let mut out = String::new();
        let mut rest = pattern;
        while let Some(at) = rest.find('$') {
            out.push_str(&rest[..at]);
            let ty = match rest.as_bytes()[at + 1] {
                b'B' => Ty::Bool,
                b'I' => Ty::Int,
                b'L' => Ty::Length,
                b'R' => Ty::Ratio,
                b'A' => Ty::Angle,
                b'H' => Ty::Heading,
                b'P' => Ty::Point,
                b'V' => Ty::Vector,
                b'S' => Ty::Speed,
                b'D' => Ty::Depth,
                b'M' => Ty::Mode,
                b'F' => Ty::Found,
                b'l' => Ty::MaybeLength,
                b'p' => Ty::MaybePoint,
                b'E' => Ty::Date,
                b'T' => Ty::Time,
                b'Z' => Ty::Area,
                b'C' => Ty::Shares,
                b'N' => Ty::Marks,
                b'i' => Ty::Ints,
                b'q' => Ty::Points,
                other => panic!("no type for `{}`", char::from(other)),
            };
            let text = if matches!(ty, Ty::Ints | Ty::Points) { self.list(ty) } else { self.expr(ty, deep) };
            out.push_str(&text);
            rest = &rest[at + 2..];
        }
        out.push_str(rest);
        out
    }

    /// A list that has a name, or is written out.
    fn list(&mut self, ty: Ty) -> String {
        match self.named(|name| name.ty == ty) {
            Some(name) => name.text,
            None if ty == Ty::Ints => "[1, 2, 3]".to_string(),
            None => self.filled("[$P, $P]", 0),
        }
    }

    fn leaf(&mut self, ty: Ty) -> String {
        let senses = !self.is_pure;
        let number = |g: &mut Self, low: usize, high: usize| low + g.random.below(high - low);
        match ty {
            Ty::Bool => self.random.of(&["true", "false", "$I == $I", "$L < $L"]).to_string(),
            Ty::Int => self.random.of(&["0", "2", "3", "4", "5"]).to_string(),
            Ty::Length if senses && self.random.percent(30) => "position.sigma".to_string(),
            Ty::Length => format!("{} m", number(self, 1, 40)),
            Ty::Ratio if senses => self.random.of(&["chemical", "battery", "4 %", "0.5", "chemical.peak"]).to_string(),
            Ty::Ratio => "0.25".to_string(),
            Ty::Angle => format!("{} deg", number(self, 1, 90)),
            Ty::Heading if senses => self.random.of(&["heading", "course", "north", "east", "flow.toward"]).to_string(),
            Ty::Heading => self.random.of(&["north", "south", "west"]).to_string(),
            Ty::Point if senses && self.has_area && self.random.percent(30) => "op.center".to_string(),
            Ty::Point if senses && self.random.percent(50) => "position".to_string(),
            Ty::Point => format!("point(north: {} m, east: -{} m)", number(self, 1, 30), number(self, 1, 30)),
            Ty::Vector => "$L toward $H".to_string(),
            Ty::Speed if senses && self.random.percent(40) => self.random.of(&["speed", "flow.length"]).to_string(),
            Ty::Speed => format!("{}.{} m/s", number(self, 0, 2), number(self, 1, 8)),
            Ty::Depth if senses && self.random.percent(40) => "depth".to_string(),
            Ty::Depth => self.random.of(&["shallow", "middling", "deep"]).to_string(),
            Ty::Mode => self.random.of(&["calm", "eager", "wild"]).to_string(),
            Ty::Found => "Found(at: $P, size: $L, mode: $M)".to_string(),
            Ty::MaybeLength => "near($P, $L)".to_string(),
            Ty::MaybePoint => "$q.first".to_string(),
            Ty::MaybeFound => "found_if($B, $F)".to_string(),
            Ty::Ints => "$i".to_string(),
            Ty::Points => "$q".to_string(),
            Ty::Cells => panic!("a map is made where it is kept"),
            Ty::Date | Ty::Time => self.leaf_of_time(ty),
            Ty::Area | Ty::Shares | Ty::Marks => self.leaf_of_place(ty),
        }
    }

    fn operation(&mut self, ty: Ty) -> String {
        let r = &mut self.random;
        let senses = !self.is_pure;
        match ty {
            Ty::Bool if senses && r.percent(5) => "(new chemical)",
            Ty::Bool => r.of(&CONDITIONS),
            Ty::Int if senses && r.percent(30) => "chemical.hits($R, of: 4)",
            Ty::Int => r.of(&INTS),
            Ty::Length => r.of(&LENGTHS),
            Ty::Ratio if senses && r.percent(10) => "(elapsed / 7 s)",
            Ty::Ratio if senses && r.percent(20) => "(chemical.age / 3 s)",
            Ty::Ratio => r.of(&RATIOS),
            Ty::Angle => r.of(&[
                "($A + $A)",
                "atan2($L, $L)",
                "($A - $A)",
                "($H - $H)",
                "($R * $A)",
                "(-$A)",
                "clamp($A, -30 deg, 40 deg)",
            ]),
            Ty::Heading => r.of(&["($H + $A)", "($H - $A)", "($V).toward", "($P - $P).toward", "turned($H, $M)"]),
            Ty::Point if self.has_area && senses && r.percent(30) => r.of(&[
                "op.corner(toward: $H)",
                "op.scattered($I, seed: $I)",
                "op.hull.exit($P, toward: $H)",
                "op.exit($P, toward: $H)",
                "op.nearest_edge($P).line.end",
            ]),
            Ty::Point => r.of(&[
                "($P + $V)",
                "($P - $V)",
                "point(north: $L, east: $L)",
                "($p else $P)",
                "($q.first else $P)",
                "$F.at",
                "($q[abs($I)] else $P)",
                "$Z.center",
                "$Z.corner(toward: $H)",
            ]),
            Ty::Vector if senses && r.percent(20) => "(flow * 20 s)",
            Ty::Vector => {
                r.of(&["($L toward $H)", "($V + $V)", "($P - $P)", "($R * $V)", "vector(north: $L, east: $L)"])
            }
            Ty::Speed => r.of(&[
                "clamp($S, 0.4 m/s, 2.2 m/s)",
                "max($S, 0.3 m/s)",
                "min($S + 0.2 m/s, 1.7 m/s)",
                "clamp(abs($L / 9 s), 0.1 m/s, 1.7 m/s)",
            ]),
            Ty::Depth => r.of(&["max($D, 2 m)", "min($D, 15 m)", "clamp($D, 1 m, 12 m)", "($D + position.sigma)"]),
            Ty::Mode => "mode_of($I)",
            Ty::Found => r.of(&[
                "($N[$P] else $F)",
                "Found(at: $P, size: $L, mode: $M)",
                "($F with (size: $L))",
                "($F with (mode: $M, at: $P))",
            ]),
            Ty::MaybeLength => r.of(&["near($P, $L)", "near($q[abs($I)] else $P, $L)", "one_of([$L, none, $l], $I)"]),
            Ty::MaybePoint => r.of(&[
                "peak($C)",
                "centroid($C)",
                "$q.first",
                "$q[abs($I)]",
                "$q.top($I)[abs($I)]",
                "place_of([$p, $P, none], $I)",
            ]),
            Ty::MaybeFound => r.of(&["found_if($B, $F)", "$N[$P]"]),
            Ty::Ints => "$i",
            Ty::Points => "$q",
            Ty::Cells => panic!("a map is made where it is kept"),
            Ty::Date | Ty::Time => operation_of_time(r, ty),
            Ty::Area | Ty::Shares | Ty::Marks => operation_of_place(r, ty),
        }
        .to_string()
    }

    fn leaf_of_time(&mut self, ty: Ty) -> String {
        let senses = !self.is_pure;
        let second = self.random.below(60);
        match ty {
            Ty::Date if senses && self.random.percent(50) => {
                self.count("utc");
                "utc".to_string()
            }
            Ty::Date => {
                self.count("date");
                format!("2026-08-14T05:00:{second:02}Z")
            }
            _ if senses && self.random.percent(40) => {
                self.count("elapsed");
                "elapsed".to_string()
            }
            _ => format!("{second} s"),
        }
    }

    /// Some ticks.
    pub(super) fn time(&mut self) -> String {
        match self.random.below(6) {
            0 => self.filled("clamp(abs($L) / (10 m/s), 100 ms, 900 ms)", 1),
            1 => self.filled("max($I * 200 ms, 50 ms)", 0),
            2 if self.random.percent(50) => self.filled("clamp($T, 100 ms, 900 ms)", 1),
            _ => format!("{} ms", 50 + 50 * self.random.below(30)),
        }
    }

    /// A condition, over time perhaps (rule 14).
    pub(super) fn condition(&mut self) -> String {
        let (x, y, time) = (self.expr(Ty::Bool, 2), self.expr(Ty::Bool, 1), self.time());
        let (feature, text) = match self.random.below(12) {
            0 => ("becomes", format!("becomes {x}")),
            1 => ("for", format!("{x} for {time}")),
            2 => ("not", format!("not {x}")),
            3 => ("no for", format!("no {x} for {time}")),
            4 => ("after", format!("after {time}")),
            5 => ("false and", format!("({x} for {time}) and {y}")),
            6 => ("or over time", format!("{y} or (becomes {x})")),
            7 => ("becomes after", format!("becomes after {time}")),
            8 => ("becomes of for", format!("becomes ({x} for {time})")),
            _ => ("plain", x),
        };
        self.count(feature);
        text
    }
}

/// Dates, and times that are never negative.
fn operation_of_time(random: &mut Random, ty: Ty) -> &'static str {
    match ty {
        Ty::Date => random.of(&["($E + $T)", "($E - $T)", "max($E, $E)", "min($E, $E)", "clamp($E, $E, $E)"]),
        _ => random.of(&[
            "($T + $T)",
            "max(0 s, $E - $E)",
            "abs($E - $E)",
            "clamp($T, 0 s, 9 s)",
            "min($T, $T)",
            "abs($L / (2 m/s))",
            "(abs($R) * $T)",
        ]),
    }
}
