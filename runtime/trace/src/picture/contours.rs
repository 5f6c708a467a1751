//! Lines of equal water depth, so that a search for a deep place shows what it searched.

use super::{frame::Frame, is_place, labels::Labels, labels::Region, svg, svg::Svg, svg::scale::round_up};
use albacore_geometry::Point;
use albacore_program::number::fixed;
use std::collections::BTreeSet;

/// Points of the grid along the longer side of what is sounded.
const POINTS: u32 = 96;
/// There are about so many lines.
const LINES: f64 = 15.0;
/// Lines so near to the greatest and the least depth, in parts of what they are apart, are left out.
const EDGE: f64 = 1e-3;
/// Lines are looked at in squares of so many pixels.
const CELL: f64 = 6.0;
/// The size of labels, in pixels, and how many there are at most.
const LABEL: f64 = 11.0;
const LABELS_MAX: usize = 16;
/// A second label of a line is at least so far from the first, in pixels.
const AGAIN: f64 = 200.0;
/// The colour of the lines.
pub(super) const COLOUR: &str = "#5b7f95";
/// That of their labels.
pub(super) const LABEL_COLOUR: &str = "#3f5f73";

/// Water depths on a square grid, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Depths {
    south_west: Point,
    step: f64,
    /// Rows from south to north, each from west to east.
    rows: Vec<Vec<f64>>,
}

impl Depths {
    /// Sounds a box, somewhat beyond its sides; none where there is no box.
    pub fn sound(corners: &[Point], depth: impl Fn(Point) -> f64) -> Self {
        let mut corners = corners.iter().filter(|p| is_place(**p));
        let Some(&first) = corners.next() else { return Depths::default() };
        let (low, high) = corners.fold((first, first), |(low, high), p| {
            let low = Point::new(low.north.min(p.north), low.east.min(p.east));
            (low, Point::new(high.north.max(p.north), high.east.max(p.east)))
        });
        let longer = (high.north - low.north).max(high.east - low.east);
        let step = 1.2 * longer / f64::from(POINTS);
        let south_west = Point::new(low.north - 0.1 * longer, low.east - 0.1 * longer);
        let count = |span: f64| ((span + 0.2 * longer) / step).ceil() as u32;
        let at =
            |i: u32, j: u32| Point::new(south_west.north + f64::from(i) * step, south_west.east + f64::from(j) * step);
        let row = |i: u32| (0..=count(high.east - low.east)).map(|j| depth(at(i, j))).collect();
        let rows = if longer > 0.0 { (0..=count(high.north - low.north)).map(row).collect() } else { Vec::new() };
        Depths { south_west, step, rows }
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.apart().is_none()
    }

    /// What the legend says of the lines.
    pub fn legend(&self) -> String {
        self.apart().map_or_else(String::new, |apart| format!("depth, every {} m", fixed(apart, 1)))
    }

    /// Metres of depth from one line to the next: round, and a tenth at least.
    fn apart(&self) -> Option<f64> {
        let (low, high) = self.range();
        (high > low && (high - low).is_finite()).then(|| round_up((high - low) / LINES).max(0.1))
    }

    fn range(&self) -> (f64, f64) {
        let all = || self.rows.iter().flatten().copied();
        (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max))
    }

    /// The depths of the lines.
    fn levels(&self) -> impl Iterator<Item = f64> {
        let (low, high) = self.range();
        let apart = self.apart();
        let first = apart.map_or(0.0, |apart| (low / apart).ceil());
        let count = apart.map_or(0.0, |apart| ((high / apart).floor() - first + 1.0).clamp(0.0, 100.0)) as u32;
        let apart = apart.unwrap_or_default();
        // The edge of a plain is no line of equal depth: all of the plain is.
        (0..count)
            .map(move |i| (first + f64::from(i)) * apart)
            .filter(move |level| EDGE * apart <= (high - level).min(level - low))
    }

    /// Draws the lines, the deeper the darker.
    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        if self.is_empty() {
            return;
        }
        let (low, high) = self.range();
        svg.raw(&format!("<g fill=\"none\" stroke=\"{COLOUR}\" stroke-width=\"1\">"));
        for level in self.levels() {
            let lines: Vec<_> = self.crossings(level).map(|line| line.map(|p| frame.place(p))).collect();
            let share = (level - low) / (high - low);
            let opacity = fixed(0.35 + 0.65 * share, 2);
            svg.paths(lines.iter().map(|line| line.as_slice()), &format!("stroke-opacity=\"{opacity}\""));
        }
        svg.raw("</g>");
    }

    /// Writes the depth of a line on it, where nothing else is: the labels of lines side by side stand as near to each other as they can. A line
    /// that goes far has a second one.
    pub(super) fn label(&self, svg: &mut Svg, frame: &Frame, labels: &mut Labels) {
        let Some(apart) = self.apart() else { return };
        let decimals = if apart < 1.0 { 1 } else { 0 };
        let middle = |[a, b]: [Point; 2]| frame.place(a + 0.5 * (b - a));
        let middles: Vec<Vec<(f64, f64)>> =
            self.levels().map(|level| self.crossings(level).map(middle).collect()).collect();
        let inked: Vec<BTreeSet<(i32, i32)>> =
            middles.iter().map(|places| places.iter().map(|p| cell(*p)).collect()).collect();
        let mut last = (frame.left + 0.5 * frame.width, frame.top + 0.5 * frame.height);
        let mut written: Vec<(usize, (f64, f64))> = Vec::new();
        for (i, (level, places)) in
            self.levels().zip(&middles).enumerate().chain(self.levels().zip(&middles).enumerate())
        {
            let text = fixed(level, decimals);
            let half = (svg::text_width(&text, LABEL) / 2.0 + 2.0, LABEL * 0.6);
            let region = |(x, y): (f64, f64)| (x - half.0, y - half.1, x + half.0, y + half.1);
            let is_alone = |at: (f64, f64)| {
                let others = inked.iter().enumerate().filter(|(j, _)| *j != i);
                others.into_iter().all(|(_, cells)| !is_inked(cells, region(at)))
            };
            let is_far = |at: (f64, f64)| {
                written.iter().filter(|(j, _)| *j == i).all(|(_, own)| away(*own, at) >= AGAIN * AGAIN)
            };
            let free =
                places.iter().copied().filter(|at| is_far(*at) && labels.is_free(frame, region(*at)) && is_alone(*at));
            let Some(at) = free.min_by(|a, b| away(*a, last).total_cmp(&away(*b, last))) else { continue };
            if written.len() < LABELS_MAX {
                labels.write(svg, region(at), &text);
                written.push((i, at));
                last = at;
            }
        }
    }

    /// The pieces of a line of equal depth: one through each triangle, half a square of the grid, that it crosses.
    fn crossings(&self, level: f64) -> impl Iterator<Item = [Point; 2]> {
        let squares = self.rows.windows(2).enumerate().flat_map(|(i, rows)| {
            let columns = rows[0].windows(2).zip(rows[1].windows(2)).enumerate();
            columns.map(move |(j, (south, north))| (i, j, [south[0], south[1], north[1], north[0]]))
        });
        squares.flat_map(move |(i, j, [sw, se, ne, nw])| {
            let at = |di: usize, dj: usize| {
                let (north, east) = ((i + di) as f64 * self.step, (j + dj) as f64 * self.step);
                Point::new(self.south_west.north + north, self.south_west.east + east)
            };
            let (sw, se, ne, nw) = ((at(0, 0), sw), (at(0, 1), se), (at(1, 1), ne), (at(1, 0), nw));
            [[sw, se, ne], [sw, ne, nw]].into_iter().filter_map(move |triangle| through(triangle, level))
        })
    }
}

/// The square in which a place on the page lies.
fn cell((x, y): (f64, f64)) -> (i32, i32) {
    ((x / CELL).floor() as i32, (y / CELL).floor() as i32)
}

/// Whether a line that goes through some squares goes through a rectangle.
fn is_inked(cells: &BTreeSet<(i32, i32)>, r: Region) -> bool {
    let (low, high) = (cell((r.0, r.1)), cell((r.2, r.3)));
    (low.0..=high.0).any(|column| cells.range((column, low.1)..=(column, high.1)).next().is_some())
}

/// The square of the way between two places.
fn away(a: (f64, f64), b: (f64, f64)) -> f64 {
    let (right, down) = (a.0 - b.0, a.1 - b.1);
    right * right + down * down
}

/// Where a level crosses the sides of a triangle, if it does.
fn through(corners: [(Point, f64); 3], level: f64) -> Option<[Point; 2]> {
    let mut sides = (0..3).filter_map(|i| {
        let ((a, depth), (b, other)) = (corners[i], corners[(i + 1) % 3]);
        ((depth < level) != (other < level)).then(|| a + (level - depth) / (other - depth) * (b - a))
    });
    Some([sides.next()?, sides.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_round_a_pit_is_a_circle_and_closed() {
        let corners = [Point::new(-100.0, -60.0), Point::new(100.0, 60.0)];
        let depths = Depths::sound(&corners, |p| 5.0 - 0.02 * p.distance(Point::ORIGIN));
        let pieces: Vec<_> = depths.crossings(4.2).collect();
        assert!(pieces.len() > 30);
        assert!(pieces.iter().flatten().all(|p| (p.distance(Point::ORIGIN) - 40.0).abs() < 1.0));
        let length: f64 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
        assert!((length / (2.0 * std::f64::consts::PI * 40.0) - 1.0).abs() < 0.02, "{length}");
    }

    #[test]
    fn nothing_is_drawn_of_level_water_or_no_box() {
        let corners = [Point::new(0.0, 0.0), Point::new(10.0, 10.0)];
        assert!(Depths::sound(&corners, |_| 4.0).is_empty());
        assert!(Depths::sound(&[], |p| p.north).is_empty());
        assert!(Depths::sound(&[Point::ORIGIN], |p| p.north).is_empty());
        assert!(!Depths::sound(&corners, |p| p.north).is_empty());
    }
}
