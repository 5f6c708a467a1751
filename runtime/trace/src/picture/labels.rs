//! Labels on the chart, each put where it covers least.

use super::{frame::Frame, svg, svg::Svg};
use std::collections::{BTreeMap, BTreeSet};

/// The size of labels, in pixels.
const SIZE: f64 = 13.0;
/// How far from its mark a label may be, nearest first, in pixels.
const DISTANCES: [f64; 5] = [13.0, 26.0, 44.0, 68.0, 96.0];
/// A label farther away than this gets a line to its mark.
const LEADER_FROM: f64 = 20.0;
/// Directions in order of liking: right, left, above, below, and between.
const DIRECTIONS: [(f64, f64); 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (0.7, -0.7), (0.7, 0.7), (-0.7, -0.7), (-0.7, 0.7)];

/// The chart is looked at in squares of so many pixels: with a line in it, or without.
const CELL: f64 = 6.0;

/// A rectangle on the page: left, top, right, bottom.
pub type Region = (f64, f64, f64, f64);

/// Labels and marks are found by squares of so many pixels: a mission may have thousands of areas.
const SQUARE: f64 = 60.0;

/// What is on the chart already, so that labels keep off it.
pub struct Labels {
    /// Labels and marks.
    taken: Taken,
    /// Labels alone.
    written: Taken,
    inked: BTreeSet<(i32, i32)>,
}

/// Labels and marks, each in all squares that it touches.
#[derive(Default)]
struct Taken(BTreeMap<(i32, i32), Vec<Region>>);

impl Taken {
    fn add(&mut self, region: Region) {
        squares(region).for_each(|square| self.0.entry(square).or_default().push(region));
    }

    /// How many a region overlaps: each counts in the square where what they share begins.
    fn overlaps(&self, r: Region) -> usize {
        let overlaps = |t: &Region| r.0 < t.2 && t.0 < r.2 && r.1 < t.3 && t.1 < r.3;
        let begins = |t: &Region| square(r.0.max(t.0), r.1.max(t.1));
        let here =
            |square| self.0.get(&square).into_iter().flatten().filter(move |t| overlaps(t) && begins(t) == square);
        squares(r).map(|square| here(square).count()).sum()
    }
}

fn square(x: f64, y: f64) -> (i32, i32) {
    ((x / SQUARE).floor() as i32, (y / SQUARE).floor() as i32)
}

fn squares(r: Region) -> impl Iterator<Item = (i32, i32)> {
    let ((left, top), (right, bottom)) = (square(r.0, r.1), square(r.2, r.3));
    (left..=right).flat_map(move |x| (top..=bottom).map(move |y| (x, y)))
}

/// The line from a mark to its label.
fn leader(mark: (f64, f64), region: Region) -> [(f64, f64); 2] {
    let end = (mark.0.clamp(region.0, region.2), mark.1.clamp(region.1, region.3));
    let (dx, dy) = (end.0 - mark.0, end.1 - mark.1);
    let length = (dx * dx + dy * dy).sqrt().max(1.0);
    [(mark.0 + dx * 9.0 / length, mark.1 + dy * 9.0 / length), end]
}

/// Points of a line, from its first, so near to each other.
fn between(a: (f64, f64), b: (f64, f64), apart: f64) -> impl Iterator<Item = (f64, f64)> {
    let steps = (((b.0 - a.0).abs() + (b.1 - a.1).abs()) / apart).ceil().clamp(1.0, 500.0);
    (0..steps as u32).map(move |i| {
        let part = f64::from(i) / steps;
        (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1))
    })
}

impl Labels {
    /// No labels yet, on a chart with lines and marks of a radius.
    pub fn new<'a>(lines: impl Iterator<Item = &'a [(f64, f64)]>, marks: &[((f64, f64), f64)]) -> Self {
        let mut inked = BTreeSet::new();
        for segment in lines.flat_map(|line| line.windows(2)) {
            let line = between(segment[0], segment[1], CELL);
            inked.extend(line.map(|(x, y)| ((x / CELL) as i32, (y / CELL) as i32)));
        }
        let mut taken = Taken::default();
        marks.iter().for_each(|((x, y), r)| taken.add((x - r, y - r, x + r, y + r)));
        Labels { taken, written: Taken::default(), inked }
    }

    /// Puts a label near a mark, unless there is room on other labels alone.
    pub fn put(&mut self, svg: &mut Svg, frame: &Frame, mark: (f64, f64), text: &str, colour: &str) {
        self.put_within(svg, frame, mark, (text, colour), DISTANCES.as_slice());
    }

    /// The same for what is said of another mark already: near its mark, on no other, or not at all.
    pub fn put_again(&mut self, svg: &mut Svg, frame: &Frame, mark: (f64, f64), text: &str, colour: &str) {
        self.put_within(svg, frame, mark, (text, colour), &DISTANCES[..2]);
    }

    fn put_within(
        &mut self,
        svg: &mut Svg,
        frame: &Frame,
        mark: (f64, f64),
        (text, colour): (&str, &str),
        distances: &[f64],
    ) {
        let text = svg::shortened(text, 260.0, SIZE);
        let width = svg::text_width(&text, SIZE);
        let mut best: Option<(f64, Region, f64, f64)> = None;
        for &distance in distances {
            for (i, (dx, dy)) in DIRECTIONS.iter().enumerate() {
                let (x, y) = (mark.0 + dx * distance, mark.1 + dy * distance);
                // Beside the mark the label begins or ends there; above and below it is centred.
                let left = x - width * (1.0 - dx.signum() * f64::from(*dx != 0.0)) / 2.0;
                let region = (left, y - SIZE * 0.62, left + width, y + SIZE * 0.62);
                let cost = self.cost(frame, region) + self.leader_cost(mark, region, distance);
                let cost = cost + distance / 4.0 + i as f64 / 8.0;
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, region, distance, *dx));
                }
            }
        }
        let Some((_, region, distance, side)) = best else { return };
        // Two texts on each other are none. A label beside its mark touches that.
        let is_again = distances.len() < DISTANCES.len();
        if self.written.overlaps(region) > 0 || is_again && self.taken.overlaps(region) > 1 {
            return;
        }
        if LEADER_FROM < distance {
            let [start, end] = leader(mark, region);
            svg.line(start, end, "stroke=\"#fff\" stroke-width=\"3\" opacity=\"0.8\"");
            svg.line(start, end, "stroke=\"#333\" stroke-width=\"0.8\"");
            self.inked.extend(between(start, end, CELL).map(|(x, y)| ((x / CELL) as i32, (y / CELL) as i32)));
        }
        // Letters are narrower than estimated in most fonts: the side that faces the mark is the one that is exact.
        let (anchor, x) = match side {
            side if side > 0.0 => ("start", region.0),
            side if side < 0.0 => ("end", region.2),
            _ => ("middle", (region.0 + region.2) / 2.0),
        };
        let at = (x, region.3 - SIZE * 0.27);
        let attributes = format!(
            "font-size=\"{SIZE}\" text-anchor=\"{anchor}\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"3.5\" \
             stroke-linejoin=\"round\" paint-order=\"stroke\""
        );
        svg.text(at, &attributes, &text);
        self.add(region);
    }

    fn add(&mut self, label: Region) {
        self.taken.add(label);
        self.written.add(label);
    }

    /// Whether a label would cover nothing there.
    pub fn is_free(&self, frame: &Frame, region: Region) -> bool {
        self.cost(frame, region) == 0.0
    }

    /// Writes the depth of a line into a rectangle.
    pub fn write(&mut self, svg: &mut Svg, region: Region, text: &str) {
        let at = ((region.0 + region.2) / 2.0, (region.1 + region.3) / 2.0 + 4.0);
        let attributes = format!(
            "font-size=\"11\" text-anchor=\"middle\" fill=\"{}\" stroke=\"#fff\" stroke-width=\"3\" \
             stroke-linejoin=\"round\" paint-order=\"stroke\"",
            super::contours::LABEL_COLOUR
        );
        svg.text(at, &attributes, text);
        self.add(region);
    }

    /// What the line from a label to its mark would cross: a text is as bad as a label on one.
    fn leader_cost(&self, mark: (f64, f64), region: Region, distance: f64) -> f64 {
        if distance <= LEADER_FROM {
            return 0.0;
        }
        let [start, end] = leader(mark, region);
        let crossed =
            between(start, end, 4.0).filter(|(x, y)| self.written.overlaps((x - 1.0, y - 1.0, x + 1.0, y + 1.0)) > 0);
        200.0 * crossed.count().min(1) as f64
    }

    /// What a label would cover: another one or a mark is the worst but for leaving the chart; a line is bad.
    fn cost(&self, frame: &Frame, r: Region) -> f64 {
        let inside = frame.shows((r.0 - 3.0, r.1 - 3.0)) && frame.shows((r.2 + 3.0, r.3 + 3.0));
        let overlaps = self.taken.overlaps(r);
        let cell = |at: f64| (at / CELL).floor() as i32;
        let middle = |cell: i32| (f64::from(cell) + 0.5) * CELL;
        let column = |x| self.inked.range((x, cell(r.1))..=(x, cell(r.3)));
        let columns = (cell(r.0)..=cell(r.2)).filter(|x| (r.0..=r.2).contains(&middle(*x)));
        let inked = columns.flat_map(column).filter(|(_, y)| (r.1..=r.3).contains(&middle(*y))).count();
        f64::from(!inside) * 1000.0 + overlaps as f64 * 200.0 + inked as f64 * 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::{Region, SQUARE, Taken};

    #[test]
    fn each_that_is_overlapped_counts_once() {
        // Regions that lie in one square, across several, side by side, and on the edges of squares.
        let at = |i: usize| (i * 37 % 400) as f64 - 100.0;
        let size = |i: usize| [0.0, 5.0, SQUARE, 130.0][i % 4];
        let region = |i: usize| (at(i), at(i * 3 + 1), at(i) + size(i), at(i * 3 + 1) + size(i / 4));
        let regions: Vec<Region> = (0..300).map(region).collect();
        let mut taken = Taken::default();
        regions.iter().for_each(|region| taken.add(*region));
        for r in &regions {
            let one_by_one = regions.iter().filter(|t| r.0 < t.2 && t.0 < r.2 && r.1 < t.3 && t.1 < r.3).count();
            assert_eq!(taken.overlaps(*r), one_by_one, "{r:?}");
        }
    }
}
