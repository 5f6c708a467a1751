//! What a map of the mission holds, as cells the darker the more is in them.

use super::frame::Frame;
use super::svg::{Svg, px};
use albacore_geometry::Grid;
use std::fmt::Write;

/// The colour of cells.
pub const COLOUR: &str = "#6a3d9a";
/// Shades that are told apart, the lightest of which is not drawn.
const SHADES: usize = 16;
/// How dark the darkest is: what lies beneath can still be seen.
const DARKEST: f64 = 0.75;

/// A map: its cells, and a number for each of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// What the legend says of it.
    pub legend: String,
    /// Where the cells lie.
    pub grid: Grid,
    /// What they hold, row by row; what is not finite is not drawn.
    pub values: Vec<f64>,
}

impl Cells {
    /// The least and the greatest number in them; none where there is no number.
    pub fn range(&self) -> Option<(f64, f64)> {
        let finite = self.values.iter().copied().filter(|x| x.is_finite());
        finite.map(|x| (x, x)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// Draws the cells, all of one shade as one element.
    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let Some((low, high)) = self.range().filter(|(low, high)| low < high) else { return };
        let mut shades = vec![String::new(); SHADES];
        for (i, x) in self.values.iter().enumerate().filter(|(_, x)| x.is_finite()) {
            let share = (x - low) / (high - low);
            let Some(shade) = shades.get_mut(((SHADES as f64 * share) as usize).min(SHADES - 1)) else { continue };
            let [a, b, c, d] = self.grid.corners(i as u32).map(|p| frame.place(p)).map(|(x, y)| (px(x), px(y)));
            // Writing to a string cannot fail.
            let _ = write!(shade, "M{} {}L{} {} {} {} {} {}Z", a.0, a.1, b.0, b.1, c.0, c.1, d.0, d.1);
        }
        svg.raw(&format!("<g fill=\"{COLOUR}\">"));
        for (i, shade) in shades.iter().enumerate().skip(1).filter(|(_, shade)| !shade.is_empty()) {
            let opacity = DARKEST * i as f64 / (SHADES - 1) as f64;
            svg.raw(&format!("<path d=\"{shade}\" fill-opacity=\"{opacity:.2}\"/>"));
        }
        svg.raw("</g>");
    }
}

/// Three cells of the legend.
pub fn mark(svg: &mut Svg, (x, y): (f64, f64)) {
    for (dx, opacity) in [(-9.0, "0.2"), (0.0, "0.45"), (9.0, "0.75")] {
        let (left, right, top, bottom) = (px(x + dx - 4.5), px(x + dx + 4.5), px(y - 4.5), px(y + 4.5));
        svg.raw(&format!(
            "<path d=\"M{left} {top}H{right}V{bottom}H{left}Z\" fill=\"{COLOUR}\" fill-opacity=\"{opacity}\"/>"
        ));
    }
}
