//! From metres to pixels: the extent of the chart, its scale, and the round steps of grid and scale bar.

use super::svg::scale::round_up;
use albacore_geometry::Point;
use albacore_program::number::fixed;

/// The chart is at most so wide and so high, in pixels.
const CHART_MAX: (f64, f64) = (700.0, 640.0);
/// The shorter side of a chart is at least this part of the longer: an edge-on track is no chart.
const ASPECT_MIN: f64 = 0.45;
/// Nothing is magnified beyond this extent, in metres.
const EXTENT_MIN_M: f64 = 20.0;
/// The margin around what is shown, as a part of its longer side.
const MARGIN: f64 = 0.05;
/// Lines of the grid are at least so far apart, in pixels.
const GRID_MIN: f64 = 80.0;
/// Room on the left for the name of the axis, and beside it for each letter of the labels of the grid.
const LEFT: f64 = 48.0;
const LETTER: f64 = 7.5;

/// Where the chart lies on the page, and which stretch of water it shows.
pub struct Frame {
    /// Pixels from the left of the page.
    pub left: f64,
    /// Pixels from the top of the page.
    pub top: f64,
    /// Pixels.
    pub width: f64,
    /// Pixels.
    pub height: f64,
    /// Pixels in a metre, the same both ways.
    pub scale: f64,
    north_max: f64,
    east_min: f64,
}

impl Frame {
    /// The frame that shows all points, as large as it can.
    pub fn fit(points: impl Iterator<Item = Point>, top: f64) -> Self {
        let (mut low, mut high) = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        for p in points {
            low = (low.0.min(p.north), low.1.min(p.east));
            high = (high.0.max(p.north), high.1.max(p.east));
        }
        if high.0 < low.0 {
            (low, high) = ((-50.0, -50.0), (50.0, 50.0));
        }
        let middle = ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0);
        let longer = (high.0 - low.0).max(high.1 - low.1).max(EXTENT_MIN_M);
        let span = |low: f64, high: f64| (high - low).max(longer * ASPECT_MIN) + 2.0 * MARGIN * longer;
        let (north, east) = (span(low.0, high.0), span(low.1, high.1));
        let scale = (CHART_MAX.0 / east).min(CHART_MAX.1 / north);
        let longest = (middle.0.abs() + north / 2.0).floor();
        let letters = fixed(-longest, 0).len().max(4);
        Frame {
            left: LEFT + LETTER * letters as f64,
            top,
            width: east * scale,
            height: north * scale,
            scale,
            north_max: middle.0 + north / 2.0,
            east_min: middle.1 - east / 2.0,
        }
    }

    /// The right edge, in pixels.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// The lower edge, in pixels.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Where a point lies on the page. North is up.
    pub fn place(&self, p: Point) -> (f64, f64) {
        (self.left + (p.east - self.east_min) * self.scale, self.top + (self.north_max - p.north) * self.scale)
    }

    /// Whether a place on the page is on the chart.
    pub fn shows(&self, (x, y): (f64, f64)) -> bool {
        (self.left..=self.right()).contains(&x) && (self.top..=self.bottom()).contains(&y)
    }

    /// The grid: metres between its lines, the north coordinates of those across, the east coordinates of those up.
    pub fn grid(&self) -> (f64, Vec<f64>, Vec<f64>) {
        let step = round_up(GRID_MIN / self.scale);
        let lines = |low: f64, span_px: f64| {
            let high = low + span_px / self.scale;
            let first = (low / step).ceil();
            let count = ((high / step).floor() - first).clamp(-1.0, 100.0) + 1.0;
            (0..count as u32).map(|i| (first + f64::from(i)) * step).collect::<Vec<_>>()
        };
        (step, lines(self.north_max - self.height / self.scale, self.height), lines(self.east_min, self.width))
    }
}
