//! Areas and what lies over them: polygons, regions of a mission, maps of shares; and what is recorded.

use super::{Generator, Ty};
use crate::random::Random;

/// Areas that are made of others, and maps.
pub fn operation_of_place(random: &mut Random, ty: Ty) -> &'static str {
    match ty {
        Ty::Area => random.of(&[
            "(polygon([$P, $P, $P]) else $Z)",
            "(outline($q) else $Z)",
            "$Z.hull",
            "rectangle(center: $P, along: $H, length: clamp($L, 2 m, 60 m), width: 20 m)",
        ]),
        Ty::Marks => random.of(&["marked($Z, $F)", "moved($N, $V)"]),
        _ => random.of(&["scaled($C, $R)", "shares($C)", "decayed($C, $T, 3 s)", "even($Z, $R)"]),
    }
}

impl Generator {
    /// As the library's `maps` has them; a generated script imports nothing.
    pub(super) fn functions_of_maps(&mut self) {
        for line in [
            "fn even(over: Area, each: Ratio) -> Map[Ratio; 12] { map(over: over, each: each) }",
            "fn marked(over: Area, each: Found) -> Map[Found; 4] { map(over: over, each: each) }",
            "fn moved(marks: Map[Found; 4], way: Vector) -> Map[Found; 4] {",
            "    var moved = marks",
            "    for mark at place in marks { moved[place] = mark with (at: mark.at + way) }",
            "    moved",
            "}",
            "fn outline(corners: [Point; n]) -> Area? { polygon(corners) }",
            "fn total(cells: Map[Ratio; n]) -> Ratio {",
            "    var sum = 0.0",
            "    for x in cells { sum = sum + x }",
            "    sum",
            "}",
            "fn peak(cells: Map[Ratio; n]) -> Point? {",
            "    var most: Ratio? = none",
            "    var there: Point? = none",
            "    for x at place in cells {",
            "        if not most or x > most {",
            "            most = x",
            "            there = place",
            "        }",
            "    }",
            "    there",
            "}",
            "fn centroid(cells: Map[Ratio; n]) -> Point? {",
            "    let origin = point(0 m, 0 m)",
            "    var sum = vector(0 m, 0 m)",
            "    for x at place in cells { sum = sum + x * (place - origin) }",
            "    let mean = sum / total(cells)",
            "    if mean { origin + mean } else { none }",
            "}",
            "fn scaled(cells: Map[Ratio; n], factor: Ratio) -> Map[Ratio; n] {",
            "    var scaled = cells",
            "    for x at place in cells { scaled[place] = factor * x }",
            "    scaled",
            "}",
            "fn decayed(cells: Map[Ratio; n], age: Duration, half_life: Duration in 1 s..1 h) -> Map[Ratio; n] {",
            "    scaled(cells, exp(-ln(2) * (age / half_life)))",
            "}",
            "fn shares(cells: Map[Ratio; n]) -> Map[Ratio; n] { scaled(cells, 1 / total(cells) else 1) }",
            "fn entropy(shares: Map[Ratio; n]) -> Ratio {",
            "    var sum = 0.0",
            "    for p in shares {",
            "        if p > 0 { sum = sum - p * ln(p) }",
            "    }",
            "    sum",
            "}",
        ] {
            self.line(line);
        }
    }

    pub(super) fn leaf_of_place(&mut self, ty: Ty) -> String {
        match ty {
            Ty::Area => "rectangle(center: $P, along: $H, length: 40 m, width: 20 m)".to_string(),
            Ty::Marks => "marked($Z, $F)".to_string(),
            _ => "even($Z, $R)".to_string(),
        }
    }

    /// An area, which may be a polygon that is written in place.
    pub(super) fn area(&mut self) -> String {
        match self.random.below(3) {
            0 => {
                self.count("polygon");
                self.filled("(polygon([$P, position, $P]) else $Z)", 1)
            }
            1 => {
                self.count("polygon of a list");
                self.filled("(outline($q) else $Z)", 1)
            }
            _ => self.expr(Ty::Area, 1),
        }
    }

    /// A part of a mission's area that has a name.
    pub(super) fn region(&mut self) {
        if self.random.percent(50) {
            self.count("named area");
            let name = self.fresh("bay");
            let corners = ["point(10 m, -9 m), point(12 m, 15 m), point(-20 m, 4 m)", "$P, $P, point(-30 m, 30 m)"];
            let corners = corners[self.random.below(2)];
            self.is_pure = true;
            let area = self.filled(
                &format!("(polygon([{corners}]) else rectangle(center: $P, along: $H, length: 9 m, width: 5 m))"),
                0,
            );
            self.is_pure = false;
            self.line(&format!("area {name} = {area}"));
            self.declare(&name, Ty::Area, false);
        }
    }

    pub(super) fn memory_of_shares(&mut self) {
        if self.random.percent(40) {
            self.count("map of records");
            let (name, map) = (self.fresh("marks"), self.expr(Ty::Marks, 2));
            self.line(&format!("memory {name}: {} = {map}", Ty::Marks.name()));
            return self.declare(&name, Ty::Marks, true);
        }
        self.count("map of shares");
        let name = self.fresh("shares");
        let map = match self.random.below(2) {
            0 => self.filled("map(over: $Z, each: $R)", 1),
            _ => self.expr(Ty::Shares, 2),
        };
        self.line(&format!("memory {name}: {} = {map}", Ty::Shares.name()));
        self.declare(&name, Ty::Shares, true);
    }

    /// What is recorded steers nothing.
    pub(super) fn records(&mut self) {
        if self.random.percent(30) {
            self.count("record");
            let inputs = self.random.clone().of(&["chemical", "temperature, flow", "utc, depth, position"]);
            let rate = self.random.clone().of(&["10 Hz", "1 Hz", "0.3 Hz"]);
            self.line(&format!("record {inputs} at {rate}"));
        }
    }
}
