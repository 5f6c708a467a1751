//! The panel under the chart: how deep the vehicle was over time, and the bottom beneath it.

use super::track::{self, Run};
use super::{chart, svg::Svg, svg::px, svg::scale};
use albacore_program::number::fixed;

/// The height of the panel, in pixels.
const HEIGHT: f64 = 130.0;
/// Room beneath it for the time, in pixels.
const BENEATH: f64 = 50.0;
/// A depth that is no depth of water, m.
const DEPTH_MAX_M: f64 = 20_000.0;
/// The axis of depth spans at least so much, m.
const SPAN_MIN_M: f64 = 2.0;
/// The axis begins at the surface, unless the vehicle stays deeper than this part of it.
const SHALLOW: f64 = 0.6;
/// A bottom that is deeper than so many times the vehicle is not shown whole.
const BOTTOM_MAX: f64 = 8.0;
/// The axis of time spans at least so much, min.
const TIME_MIN: f64 = 0.01;
/// What begins so early begins with the run, min.
const BEGINNING_MIN: f64 = 1.0 / 60.0;
/// Lines of the grid are at least so far apart, in pixels: of depth and of time.
const APART: (f64, f64) = (26.0, 70.0);
/// Points in all, of the vehicle and of the bottom: what keeps the file small.
const POINTS_MAX: usize = 3_000;
/// A corner of the bottom nearer to the line than this, in pixels, is not seen.
const TOLERANCE_PX: f64 = 0.5;
/// The colour of the bottom.
const BOTTOM: &str = "#8a6d3b";

/// How deep a vehicle was at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sounding {
    /// Seconds since the run began.
    pub t_s: f64,
    /// The depth that was sensed, m.
    pub depth: f64,
    /// The depth of the bottom beneath, m; not a number where it is not known.
    pub bottom: f64,
    /// An index into the behaviors of the picture.
    pub behavior: u16,
}

/// How deep a vehicle was over a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// In the order of time.
    pub soundings: Vec<Sounding>,
    /// Whether the bottom is the true one, and not what was sensed.
    pub is_bottom_true: bool,
}

impl Profile {
    /// What the legend says of the bottom; empty where it is not shown.
    pub fn bottom_name(&self) -> &'static str {
        match Panel::new(self, 0.0, 0.0, 1.0) {
            Some(panel) if panel.sees_bottom() => match self.is_bottom_true {
                true => "true bottom",
                false => "bottom, by altitude",
            },
            _ => "",
        }
    }

    fn known(&self) -> impl Iterator<Item = &Sounding> {
        self.soundings.iter().filter(|sounding| sounding.t_s.is_finite() && sounding.depth.abs() <= DEPTH_MAX_M)
    }
}

/// The panel: where it lies on the page, and what it shows.
pub struct Panel<'a> {
    profile: &'a Profile,
    left: f64,
    top: f64,
    width: f64,
    /// Minutes at its left, and over its width.
    time: (f64, f64),
    /// Metres at its top, and over its height.
    depth: (f64, f64),
}

impl<'a> Panel<'a> {
    /// The panel with its upper left corner there; none without a depth at two times.
    pub fn new(profile: &'a Profile, left: f64, top: f64, width: f64) -> Option<Self> {
        let range =
            |values: &mut dyn Iterator<Item = f64>| values.map(|x| (x, x)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let time = range(&mut profile.known().map(|sounding| sounding.t_s / 60.0)).filter(|(from, to)| from < to)?;
        let own = range(&mut profile.known().map(|sounding| sounding.depth.max(0.0)))?;
        let bottoms = profile.known().map(|sounding| sounding.bottom);
        let bottom = range(&mut bottoms.filter(|bottom| bottom.abs() <= DEPTH_MAX_M));
        let reach = BOTTOM_MAX * own.1.max(SPAN_MIN_M);
        // Of a bottom that falls off the part near the vehicle is shown; of one that is far below it, nothing.
        let deepest = match bottom {
            Some((_, deepest)) if deepest <= reach => own.1.max(deepest),
            Some((shallowest, _)) if 2.0 * shallowest <= reach => own.1.max(2.0 * shallowest),
            _ => own.1,
        };
        let deepest = deepest.max(SPAN_MIN_M);
        let shown = deepest - own.0;
        let above = own.0 - (0.2 * shown).max((SPAN_MIN_M - shown) / 2.0);
        let top_m = if own.0 < SHALLOW * deepest { 0.0 } else { above.max(0.0) };
        let span = (1.08 * (deepest - top_m)).max(SPAN_MIN_M);
        let from = if (0.0..=BEGINNING_MIN).contains(&time.0) { 0.0 } else { time.0 };
        Some(Panel { profile, left, top, width, time: (from, (time.1 - from).max(TIME_MIN)), depth: (top_m, span) })
    }

    /// Where it ends on the page, what stands beneath it included.
    pub fn end(&self) -> f64 {
        self.bottom() + BENEATH
    }

    fn bottom(&self) -> f64 {
        self.top + HEIGHT
    }

    fn right(&self) -> f64 {
        self.left + self.width
    }

    fn x(&self, minutes: f64) -> f64 {
        self.left + (minutes - self.time.0) / self.time.1 * self.width
    }

    fn y(&self, depth: f64) -> f64 {
        self.top + (depth - self.depth.0) / self.depth.1 * HEIGHT
    }

    fn sees_bottom(&self) -> bool {
        self.profile.known().any(|sounding| sounding.bottom <= self.depth.0 + self.depth.1)
    }

    /// Draws it.
    pub fn draw(&self, svg: &mut Svg) {
        let (x, y, w, h) = (px(self.left), px(self.top), px(self.width), px(HEIGHT));
        let rect = |attributes: &str| format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{attributes}/>");
        svg.raw(&format!("<clipPath id=\"profile\">{}</clipPath>", rect("")));
        svg.raw(&rect(" fill=\"#f6f9fb\""));
        svg.raw("<g clip-path=\"url(#profile)\">");
        let (times, depths) = (self.times(), self.depths());
        svg.raw("<g stroke=\"#dfe5ea\" stroke-width=\"1\">");
        times.1.iter().for_each(|t| svg.line((self.x(*t), self.top), (self.x(*t), self.bottom()), ""));
        depths.1.iter().for_each(|d| svg.line((self.left, self.y(*d)), (self.right(), self.y(*d)), ""));
        svg.raw("</g>");
        if self.sees_bottom() {
            self.draw_bottom(svg);
        }
        let places = self.profile.known().map(|at| ((self.x(at.t_s / 60.0), self.y(at.depth)), at.behavior));
        chart::track(svg, &track::stretches(places, POINTS_MAX));
        svg.raw("</g>");
        svg.raw(&rect(" fill=\"none\" stroke=\"#333\" stroke-width=\"1\""));
        self.axes(svg, times, depths);
    }

    fn draw_bottom(&self, svg: &mut Svg) {
        let floor = self.bottom() + 2.0;
        let mut known: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
        for at in self.profile.known() {
            let is_known = at.bottom.abs() <= DEPTH_MAX_M;
            match known.last_mut() {
                Some(last) if is_known => last.push((self.x(at.t_s / 60.0), self.y(at.bottom).min(floor))),
                Some(last) if !last.is_empty() => known.push(Vec::new()),
                _ => {}
            }
        }
        let lines =
            known.iter().filter(|line| line.len() > 1).map(|points| Run { behavior: 0, points: points.clone() });
        for Run { points, .. } in track::thin(lines.collect(), TOLERANCE_PX, POINTS_MAX) {
            let ends = points.first().zip(points.last()).map(|(first, last)| [(last.0, floor), (first.0, floor)]);
            let around: Vec<_> = points.iter().copied().chain(ends.into_iter().flatten()).collect();
            svg.path(&around, true, &format!("fill=\"{BOTTOM}\" fill-opacity=\"0.18\""));
            svg.path(&points, false, &format!("fill=\"none\" stroke=\"{BOTTOM}\" stroke-width=\"1.4\""));
        }
    }

    /// Minutes between the lines of the grid, and where they are.
    fn times(&self) -> (f64, Vec<f64>) {
        scale::marks(self.time, self.width, APART.1)
    }

    fn depths(&self) -> (f64, Vec<f64>) {
        scale::marks(self.depth, HEIGHT, APART.0)
    }

    fn axes(&self, svg: &mut Svg, times: (f64, Vec<f64>), depths: (f64, Vec<f64>)) {
        svg.raw("<g font-size=\"12\" fill=\"#444\" stroke=\"none\">");
        for depth in depths.1 {
            let text = fixed(depth, scale::decimals(depths.0));
            svg.text((self.left - 7.0, self.y(depth) + 4.0), "text-anchor=\"end\"", &text);
        }
        for time in times.1 {
            let text = fixed(time, scale::decimals(times.0));
            svg.text((self.x(time), self.bottom() + 17.0), "text-anchor=\"middle\"", &text);
        }
        let middle = ((self.left + self.right()) / 2.0, (self.top + self.bottom()) / 2.0);
        svg.text((middle.0, self.bottom() + 38.0), "text-anchor=\"middle\"", "time (min)");
        let turned = format!("text-anchor=\"middle\" transform=\"rotate(-90 26 {})\"", px(middle.1));
        svg.text((26.0, middle.1), &turned, "depth (m)");
        svg.raw("</g>");
    }
}

/// The bottom in the legend.
pub fn bottom_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    let corners = [(x - 13.0, y - 4.0), (x + 13.0, y - 4.0), (x + 13.0, y + 5.0), (x - 13.0, y + 5.0)];
    svg.path(&corners, true, &format!("fill=\"{BOTTOM}\" fill-opacity=\"0.18\""));
    svg.line(corners[0], corners[1], &format!("stroke=\"{BOTTOM}\" stroke-width=\"1.4\""));
}
