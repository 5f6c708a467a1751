//! The panel beside the chart: north, flow, scale bar, and what the colours and marks mean.

use super::{
    Picture, cells, chart, contours, frame::Frame, is_place, profile, style, svg, svg::Svg, svg::px,
    svg::scale::round_down, true_outline,
};
use albacore_geometry::Vector;
use albacore_program::number;

/// The panel's width in pixels: at least, and at most for the sake of long names.
const WIDTH_MIN: f64 = 190.0;
const WIDTH_MAX: f64 = 320.0;
/// Where names begin, in pixels from the left of the panel.
const NAMES: f64 = 36.0;
/// Where the flow's arrows have their middle, in pixels from the left of the panel.
const FLOW_AT: f64 = 108.0;
/// A line of the legend, in pixels.
const LINE: f64 = 21.0;
/// So many behaviors are named at most.
const BEHAVIORS_MAX: usize = 24;
/// The length of the longest scale bar, in pixels.
const BAR_MAX: f64 = 150.0;
/// Heights of the parts, in pixels: north by itself, each layer's flow, the scale bar.
const NORTH: f64 = 88.0;
const FLOW: f64 = 122.0;
const BAR: f64 = 56.0;

const HEAD: &str = "font-size=\"13\" font-weight=\"bold\" fill=\"#1a1a1a\"";
const ENTRY: &str = "font-size=\"13\" fill=\"#222\"";

/// What a mark of the legend looks like, drawn about its centre.
type Mark = fn(&mut Svg, (f64, f64));

/// What the panel will hold.
pub struct Panel<'a> {
    picture: &'a Picture,
    scale: f64,
    behaviors: Vec<u16>,
    marks: Vec<(String, Mark)>,
}

impl<'a> Panel<'a> {
    /// The panel for a picture: it names only what is to be seen.
    pub fn new(picture: &'a Picture, frame: &Frame) -> Self {
        let seen: std::collections::BTreeSet<u16> = picture.track.iter().map(|(_, behavior)| *behavior).collect();
        let depths = picture.depths.legend();
        let map = picture.map.as_ref().map_or("", |map| map.legend.as_str());
        let area = if picture.area_name.is_empty() { "operating area" } else { &picture.area_name };
        let bottom = picture.profile.bottom_name();
        let outlines = || picture.true_outlines.iter().filter(|named| named.is_seen(frame));
        let there = [
            (picture.start.is_some(), "start", chart::start_mark as Mark),
            (picture.end.is_some(), "end", chart::end_mark),
            (!picture.area.is_empty(), area, area_mark),
            (!picture.regions.is_empty(), "region", region_mark),
            (!picture.route.is_empty(), "its own mission", route_mark),
            (!picture.no_go.is_empty(), "no-go zone", no_go_mark),
            (!picture.outlines.is_empty(), "reported area", reported_area_mark),
            (!picture.plume.is_empty(), "plume", plume_mark),
            (outlines().next().is_some(), "true outline", true_outline::mark),
            (outlines().any(|named| named.has_moved(frame)), "true outline at the start", true_outline::mark_before),
            (!chart::legs(&picture.rounds, frame).is_empty(), "round of a loop begins", chart::round_mark),
            (picture.detections.iter().any(|p| is_place(*p)), "detection", detection_mark),
            (!picture.reports.is_empty(), "report", chart::report_mark),
            (!picture.sources.is_empty(), "true source", chart::source_mark),
            (!picture.leaks.is_empty(), "leak", leak_mark),
            (picture.deepest.is_some(), "truly deepest", chart::source_mark),
            (!depths.is_empty(), &depths, depth_mark),
            (!map.is_empty(), map, cells::mark),
            (!bottom.is_empty(), bottom, profile::bottom_mark),
        ];
        let marks =
            there.into_iter().filter(|(there, ..)| *there).map(|(_, name, mark)| (name.to_string(), mark)).collect();
        Panel { picture, scale: frame.scale, behaviors: seen.into_iter().collect(), marks }
    }

    /// How wide it is, in pixels.
    pub fn width(&self) -> f64 {
        let names = self.behaviors.iter().map(|behavior| svg::text_width(&self.name(*behavior), 13.0));
        let flows = self.flows().map(|(name, flow)| FLOW_AT + svg::text_width(&speed(name, flow), 13.0) / 2.0);
        let marks = self.marks.iter().map(|(name, _)| svg::text_width(name, 13.0));
        names.chain(marks).map(|name| NAMES + name).chain(flows).fold(WIDTH_MIN, f64::max).min(WIDTH_MAX)
    }

    /// How high it is, in pixels.
    pub fn height(&self) -> f64 {
        let entries = self.behaviors.len().min(BEHAVIORS_MAX + 1) + self.marks.len();
        self.compass() + BAR + LINE * (entries as f64 + 1.5)
    }

    /// Draws it with its upper left corner there.
    pub fn draw(&self, svg: &mut Svg, left: f64, top: f64) {
        north(svg, (left + 20.0, top + 34.0));
        for (i, (name, flow)) in self.flows().enumerate() {
            flow_arrow(svg, (left + FLOW_AT, top + 34.0 + FLOW * i as f64), name, flow);
        }
        self.bar(svg, left, top + self.compass() + 8.0);
        let mut y = top + self.compass() + BAR + LINE / 2.0;
        if !self.behaviors.is_empty() {
            svg.text((left, y), HEAD, "behavior");
            y += LINE;
        }
        for &behavior in self.behaviors.iter().take(BEHAVIORS_MAX) {
            let (colour, dashes) = style(behavior);
            svg.line(
                (left, y - 4.5),
                (left + 26.0, y - 4.5),
                &format!("stroke=\"{colour}\" stroke-width=\"3\"{}", dashes.trim_end()),
            );
            let name = self.name(behavior);
            svg.text((left + NAMES, y), ENTRY, &svg::shortened(&name, self.width() - NAMES, 13.0));
            y += LINE;
        }
        if BEHAVIORS_MAX < self.behaviors.len() {
            svg.text((left + NAMES, y), ENTRY, &format!("and {} more", self.behaviors.len() - BEHAVIORS_MAX));
            y += LINE;
        }
        y += LINE / 2.0;
        for (name, mark) in &self.marks {
            mark(svg, (left + 13.0, y - 4.5));
            svg.text((left + NAMES, y), ENTRY, name);
            y += LINE;
        }
    }

    fn name(&self, behavior: u16) -> String {
        let name = self.picture.behaviors.get(usize::from(behavior));
        name.map_or_else(|| format!("behavior {behavior}"), String::clone)
    }

    /// The flows that can be drawn.
    fn flows(&self) -> impl Iterator<Item = (&str, Vector)> {
        let flows = self.picture.flows.iter().map(|(name, flow)| (name.as_str(), *flow));
        flows.filter(|(_, flow)| flow.length().is_finite() && flow.length() > 0.0)
    }

    /// North, and the flows beside it and below.
    fn compass(&self) -> f64 {
        NORTH.max(FLOW * self.flows().count() as f64)
    }

    fn bar(&self, svg: &mut Svg, left: f64, y: f64) {
        let length = round_down(BAR_MAX / self.scale);
        let right = left + length * self.scale;
        let d = [(left, y - 5.0), (left, y), (right, y), (right, y - 5.0)];
        svg.path(&d, false, "fill=\"none\" stroke=\"#1a1a1a\" stroke-width=\"1.6\"");
        let text = if length < 1000.0 { format!("{} m", px(length)) } else { format!("{} km", px(length / 1000.0)) };
        svg.text((left, y + 17.0), ENTRY, &text);
    }
}

fn north(svg: &mut Svg, (x, y): (f64, f64)) {
    svg.path(
        &[(x, y - 30.0), (x + 8.0, y + 8.0), (x, y + 1.0)],
        true,
        "fill=\"#1a1a1a\" stroke=\"#1a1a1a\" stroke-width=\"1\" stroke-linejoin=\"round\"",
    );
    svg.path(
        &[(x, y - 30.0), (x - 8.0, y + 8.0), (x, y + 1.0)],
        true,
        "fill=\"#fff\" stroke=\"#1a1a1a\" stroke-width=\"1\" stroke-linejoin=\"round\"",
    );
    svg.text((x, y + 27.0), "font-size=\"15\" font-weight=\"bold\" fill=\"#1a1a1a\" text-anchor=\"middle\"", "N");
}

fn flow_arrow(svg: &mut Svg, (x, y): (f64, f64), name: &str, flow: Vector) {
    let unit = flow.toward().unit();
    // On the page east is right and north is up.
    let at = |along: f64, across: f64| {
        (x + along * unit.east + across * unit.north, y - along * unit.north + across * unit.east)
    };
    let colour = "#2a6f97";
    svg.line(at(-27.0, 0.0), at(18.0, 0.0), &format!("stroke=\"{colour}\" stroke-width=\"3\""));
    svg.path(&[at(29.0, 0.0), at(14.0, 7.5), at(14.0, -7.5)], true, &format!("fill=\"{colour}\""));
    let attributes = format!("font-size=\"13\" fill=\"{colour}\" text-anchor=\"middle\"");
    svg.text((x, y + 48.0), &attributes, &speed(name, flow));
    svg.text((x, y + 63.0), &attributes, &format!("toward {}°", whole_degrees(flow)));
}

fn speed(name: &str, flow: Vector) -> String {
    format!("{name} {} cm/s", number::fixed(flow.length() * 100.0, 1))
}

fn whole_degrees(flow: Vector) -> String {
    let degrees = number::fixed(flow.toward().degrees(), 0);
    if degrees == "360" { "0".to_string() } else { degrees }
}

fn area_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    let corners = [(x - 13.0, y - 6.0), (x + 13.0, y - 6.0), (x + 13.0, y + 6.0), (x - 13.0, y + 6.0)];
    svg.path(&corners, true, "fill=\"none\" stroke=\"#333\" stroke-width=\"1.3\" stroke-dasharray=\"5 3\"");
}

fn region_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    chart::region(svg, &[(x - 13.0, y - 6.0), (x + 13.0, y - 6.0), (x + 13.0, y + 6.0), (x - 13.0, y + 6.0)]);
}

fn route_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    chart::route(svg, &[(x - 13.0, y), (x + 13.0, y)]);
}

fn no_go_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    chart::no_go(svg, &[(x - 13.0, y - 6.0), (x + 13.0, y - 6.0), (x + 13.0, y + 6.0), (x - 13.0, y + 6.0)]);
}

fn reported_area_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    chart::reported_area(svg, &[(x - 13.0, y - 6.0), (x + 13.0, y - 6.0), (x + 13.0, y + 6.0), (x - 13.0, y + 6.0)]);
}

fn leak_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    chart::leak(svg, &[(x - 10.0, y), (x + 10.0, y)]);
}

fn depth_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    for (dy, opacity) in [(-4.0, "0.4"), (0.0, "0.7"), (4.0, "1")] {
        let attributes = format!("stroke=\"{}\" stroke-opacity=\"{opacity}\"", contours::COLOUR);
        svg.line((x - 13.0, y + dy), (x + 13.0, y + dy), &attributes);
    }
}

fn plume_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    for (dx, dy, radius) in [(-8.0, 1.0, 3.5), (-1.0, -1.0, 5.0), (7.0, 1.0, 6.0)] {
        svg.circle((x + dx, y + dy), radius, &format!("fill=\"{}\" fill-opacity=\"0.4\"", chart::PLUME));
    }
}

fn detection_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    let attributes = format!("stroke=\"{}\" stroke-width=\"1.2\"", chart::DETECTION);
    svg.line((x - 3.5, y - 3.5), (x + 3.5, y + 3.5), &attributes);
    svg.line((x - 3.5, y + 3.5), (x + 3.5, y - 3.5), &attributes);
}
