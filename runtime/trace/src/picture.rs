//! The picture of a run: a chart of the track, the plume and what was found, and the depth over time, as an SVG that needs nothing else.

mod cells;
mod chart;
mod contours;
mod frame;
mod labels;
mod panel;
mod profile;
mod track;
mod true_outline;

use albacore_geometry::{Point, Vector};
use albacore_svg::{self as svg, PALETTE, Svg};
pub use cells::Cells;
pub use contours::Depths;
use frame::Frame;
pub use profile::{Profile, Sounding};
pub use true_outline::TrueOutline;

/// Beyond this a coordinate is no place that a vehicle goes to.
const COORDINATE_MAX_M: f64 = 1e8;

/// Margins in pixels, around the chart.
const TOP: f64 = 52.0;
const SUBTITLE_LINE: f64 = 18.0;
/// The page is so wide that all that stands beneath the title has room, but for the sake of lines that are longer than this.
const SUBTITLE_MAX: f64 = 840.0;
const BOTTOM: f64 = 54.0;
const PANEL_GAP: f64 = 24.0;
const EDGE: f64 = 20.0;
/// Between the chart and the panel under it.
const PROFILE_GAP: f64 = 8.0;

/// All that the picture shows. Positions are north and east in metres; those that are not finite are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The heading.
    pub title: String,
    /// Lines beneath it.
    pub subtitle: Vec<String>,
    /// Corners of the water that is to be seen, whatever is in it.
    pub water: Vec<Point>,
    /// The corners of the operating area.
    pub area: Vec<Point>,
    /// What the legend calls it; empty: the operating area.
    pub area_name: String,
    /// Regions that the mission names: names and corners.
    pub regions: Vec<(String, Vec<Point>)>,
    /// Where the vehicle must not be: names and corners. They may leave the chart.
    pub no_go: Vec<(String, Vec<Point>)>,
    /// Where the vehicle goes by itself: the corners of its way, in order.
    pub route: Vec<Point>,
    /// Filaments of the plume: where, and how wide (radius in metres).
    pub plume: Vec<(Point, f64)>,
    /// Where the vehicle went, each with an index into `behaviors`.
    pub track: Vec<(Point, u16)>,
    /// The names of the behaviors.
    pub behaviors: Vec<String>,
    /// Where the rounds of loops began, by name, such as `row 7`.
    pub rounds: Vec<(String, Point)>,
    /// Where chemical was detected.
    pub detections: Vec<Point>,
    /// What the mission reported, by name.
    pub reports: Vec<(String, Point)>,
    /// The true sources, by name.
    pub sources: Vec<(String, Point)>,
    /// What chemical truly lies within. They may leave the chart.
    pub true_outlines: Vec<TrueOutline>,
    /// Of sources that are lines both ends; the first is the place of the source.
    pub leaks: Vec<[Point; 2]>,
    /// The bottom's shape, where it is what is searched.
    pub depths: Depths,
    /// Areas that were reported: names and corners.
    pub outlines: Vec<(String, Vec<Point>)>,
    /// The map that was reported last.
    pub map: Option<Cells>,
    /// The deepest point of the operating area, where it is what is searched.
    pub deepest: Option<Point>,
    /// Where the vehicle started.
    pub start: Option<Point>,
    /// Where it was at the end.
    pub end: Option<Point>,
    /// How deep it was over time.
    pub profile: Profile,
    /// The flow of each layer by its name, in m/s; still water has no arrow.
    pub flows: Vec<(String, Vector)>,
}

impl Picture {
    /// The picture as an SVG document. The same picture gives the same bytes on every machine.
    pub fn svg(&self) -> String {
        let top = TOP + SUBTITLE_LINE * self.subtitle.len() as f64;
        let frame = Frame::fit(self.extent(), top);
        let runs = track::runs(&self.track, &frame);
        let panel = panel::Panel::new(self, &frame);
        let right = frame.right() + PANEL_GAP + panel.width();
        let (under, beside) = (frame.bottom() + BOTTOM + PROFILE_GAP, frame.top + panel.height());
        // Where the legend leaves room, time has the whole width.
        let across = if beside + PROFILE_GAP < under { right } else { frame.right() } - frame.left;
        let profile = profile::Panel::new(&self.profile, frame.left, under, across);
        let told = self.subtitle.iter().map(|line| svg::text_width(line, 13.0)).fold(0.0, f64::max);
        let width = right.max(EDGE + told.min(SUBTITLE_MAX)) + EDGE;
        let end = profile.as_ref().map_or(frame.bottom() + BOTTOM, profile::Panel::end);
        let height = end.max(beside + EDGE);

        let mut svg = Svg::new(width, height);
        self.heading(&mut svg, width);
        chart::draw(&mut svg, self, &frame, &runs);
        panel.draw(&mut svg, frame.right() + PANEL_GAP, frame.top);
        profile.iter().for_each(|profile| profile.draw(&mut svg));
        svg.finish()
    }

    fn heading(&self, svg: &mut Svg, width: f64) {
        let room = width - 2.0 * EDGE;
        svg.text(
            (EDGE, 36.0),
            "font-size=\"20\" font-weight=\"bold\" fill=\"#1a1a1a\"",
            &svg::shortened(&self.title, room, 21.0),
        );
        for (i, line) in self.subtitle.iter().enumerate() {
            let y = 57.0 + SUBTITLE_LINE * i as f64;
            svg.text((EDGE, y), "font-size=\"13\" fill=\"#555\"", &svg::shortened(line, room, 13.0));
        }
    }

    /// All points that must be on the chart. The plume may leave it, and so may true outlines.
    pub fn extent(&self) -> impl Iterator<Item = Point> {
        let places = self.reports.iter().chain(&self.sources).map(|(_, p)| *p);
        let all = self
            .area
            .iter()
            .chain(&self.water)
            .chain(self.regions.iter().chain(&self.outlines).flat_map(|(_, corners)| corners))
            .chain(self.leaks.iter().flatten())
            .copied()
            .chain(self.route.iter().copied())
            .chain(self.track.iter().map(|(p, _)| *p))
            .chain(places)
            .chain(self.start)
            .chain(self.end)
            .chain(self.deepest);
        all.filter(|p| is_place(*p))
    }
}

/// Whether a position can be drawn.
fn is_place(p: Point) -> bool {
    p.north.abs() <= COORDINATE_MAX_M && p.east.abs() <= COORDINATE_MAX_M
}

/// The colour of a behavior, and the dashes that tell it from the others of that colour.
fn style(behavior: u16) -> (&'static str, &'static str) {
    let at = usize::from(behavior);
    let dashes = [" ", " stroke-dasharray=\"7 3\" ", " stroke-dasharray=\"2 3\" "];
    (PALETTE[at % PALETTE.len()], dashes[(at / PALETTE.len()).min(dashes.len() - 1)])
}
