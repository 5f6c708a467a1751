//! The chart itself, from the bottom up: water, grid, depths, plume, area, track, detections, marks, labels.

use super::{Picture, frame::Frame, is_place, labels::Labels, style, svg::Svg, svg::px, track::Run, true_outline};
use albacore_geometry::Point;
use albacore_program::number::fixed;
use std::{collections::BTreeSet, fmt::Write};

/// At most so many filaments are drawn: evenly spaced in the order they are given.
const FILAMENTS_MAX: usize = 2_400;
/// Detections closer than this on the page, in pixels, are one cross.
const DETECTION_CELL: f64 = 6.0;
/// At most so many crosses.
const DETECTIONS_MAX: usize = 2_000;

/// Reports of one name closer than this on the page, in pixels, are one dot.
const REPORT_CELL: f64 = 6.0;
/// At most so many dots.
const REPORTS_MAX: usize = 2_000;
/// At most so many of them are named: more could not be read.
const LABELS_MAX: usize = 60;

/// At most so many beginnings of rounds are marked, evenly spaced in the order they are given.
const ROUNDS_MAX: usize = 40;
/// Of the beginnings of rounds of one name only one is marked in such a square, in pixels: who surveys a place again begins where he did.
const ROUND_CELL: f64 = 40.0;
/// A round that begins nearer than this, in pixels, to the one before or after it is a turn of a maneuver, and no leg of a survey.
const LEG_MIN: f64 = 80.0;

/// The colour of the plume.
pub const PLUME: &str = "#b08d2f";
/// The colour of detections.
pub const DETECTION: &str = "#333";
/// The colour of places where the vehicle must not be.
const NO_GO: &str = "#b3001b";
/// The colour of regions that a mission names.
const REGION: &str = "#555";
/// The colour of areas that were reported.
const OUTLINE: &str = "#111";
/// The colour of true sources.
const SOURCE: &str = "#7a0019";
/// The colour of the beginnings of rounds.
const ROUND: &str = "#555";
/// The radius of the ring round a true source, in pixels.
const RING: f64 = 10.0;

/// Draws everything inside the frame, and the grid's labels around it.
pub fn draw(svg: &mut Svg, picture: &Picture, frame: &Frame, runs: &[Run]) {
    let (x, y, w, h) = (px(frame.left), px(frame.top), px(frame.width), px(frame.height));
    svg.raw(&format!("<clipPath id=\"chart\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>"));
    svg.raw(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"#f6f9fb\"/>"));
    svg.raw("<g clip-path=\"url(#chart)\">");
    area(svg, picture, frame, "fill=\"#fff\"");
    grid(svg, frame);
    picture.depths.draw(svg, frame);
    picture.map.iter().for_each(|map| map.draw(svg, frame));
    plume(svg, picture, frame);
    picture.true_outlines.iter().for_each(|true_outline| true_outline.draw(svg, frame));
    area(svg, picture, frame, "fill=\"none\" stroke=\"#333\" stroke-width=\"1.3\" stroke-dasharray=\"8 5\"");
    for (_, corners) in &picture.regions {
        region(svg, &outline(corners, frame));
    }
    for (_, corners) in &picture.no_go {
        no_go(svg, &outline(corners, frame));
    }
    for (_, corners) in &picture.outlines {
        reported_area(svg, &outline(corners, frame));
    }
    route(svg, &outline(&picture.route, frame));
    leaks(&picture.leaks, frame).iter().for_each(|ends| leak(svg, ends));
    detections(svg, picture, frame);
    track(svg, runs);
    marks(svg, picture, frame, runs);
    svg.raw("</g>");
    svg.raw(&format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1\"/>"
    ));
    axes(svg, frame);
}

/// The corners that can be drawn, on the page.
pub fn outline(corners: &[Point], frame: &Frame) -> Vec<(f64, f64)> {
    corners.iter().filter(|p| is_place(**p)).map(|p| frame.place(*p)).collect()
}

/// A dashed outline, finer than that of the operating area.
pub fn region(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 2 {
        svg.path(
            corners,
            true,
            &format!("fill=\"none\" stroke=\"{REGION}\" stroke-width=\"1\" stroke-dasharray=\"4 3\""),
        );
    }
}

/// A filled outline.
pub fn no_go(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 2 {
        let attributes = format!("fill=\"{NO_GO}\" fill-opacity=\"0.12\" stroke=\"{NO_GO}\" stroke-width=\"1.3\"");
        svg.path(corners, true, &attributes);
    }
}

/// An outline that was reported.
pub fn reported_area(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 2 {
        svg.path(
            corners,
            true,
            &format!("fill=\"{OUTLINE}\" fill-opacity=\"0.08\" stroke=\"{OUTLINE}\" stroke-width=\"1.6\""),
        );
    }
}

/// A source that is a line.
pub fn leak(svg: &mut Svg, ends: &[(f64, f64)]) {
    let attributes = |colour: &str, width: f64| {
        format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"")
    };
    svg.path(ends, false, &attributes("#fff", 8.0));
    svg.path(ends, false, &attributes(SOURCE, 5.0));
}

/// Those with two ends that can be drawn.
fn leaks(leaks: &[[Point; 2]], frame: &Frame) -> Vec<Vec<(f64, f64)>> {
    leaks.iter().map(|ends| outline(ends, frame)).filter(|ends| ends.len() == 2).collect()
}

/// The way that a vehicle goes by itself.
pub fn route(svg: &mut Svg, corners: &[(f64, f64)]) {
    if corners.len() > 1 {
        svg.path(corners, false, "fill=\"none\" stroke=\"#6b6b6b\" stroke-width=\"1.6\" stroke-dasharray=\"2 4\"");
    }
}

fn area(svg: &mut Svg, picture: &Picture, frame: &Frame, attributes: &str) {
    let corners = outline(&picture.area, frame);
    if corners.len() > 2 {
        svg.path(&corners, true, attributes);
    }
}

fn grid(svg: &mut Svg, frame: &Frame) {
    let (_, norths, easts) = frame.grid();
    svg.raw("<g stroke=\"#dfe5ea\" stroke-width=\"1\">");
    for north in norths {
        let y = frame.place(Point::new(north, 0.0)).1;
        svg.line((frame.left, y), (frame.right(), y), "");
    }
    for east in easts {
        let x = frame.place(Point::new(0.0, east)).0;
        svg.line((x, frame.top), (x, frame.bottom()), "");
    }
    svg.raw("</g>");
}

fn axes(svg: &mut Svg, frame: &Frame) {
    let (step, norths, easts) = frame.grid();
    let decimals = if step < 1.0 { 1 } else { 0 };
    svg.raw("<g font-size=\"12\" fill=\"#444\" stroke=\"none\">");
    for north in norths {
        let y = frame.place(Point::new(north, 0.0)).1;
        svg.text((frame.left - 7.0, y + 4.0), "text-anchor=\"end\"", &fixed(north, decimals));
    }
    for east in easts {
        let x = frame.place(Point::new(0.0, east)).0;
        svg.text((x, frame.bottom() + 17.0), "text-anchor=\"middle\"", &fixed(east, decimals));
    }
    let middle = ((frame.left + frame.right()) / 2.0, (frame.top + frame.bottom()) / 2.0);
    svg.text((middle.0, frame.bottom() + 38.0), "text-anchor=\"middle\"", "east (m)");
    let turned = format!("text-anchor=\"middle\" transform=\"rotate(-90 26 {})\"", px(middle.1));
    svg.text((26.0, middle.1), &turned, "north (m)");
    svg.raw("</g>");
}

fn plume(svg: &mut Svg, picture: &Picture, frame: &Frame) {
    let shown: Vec<_> = picture.plume.iter().filter(|(p, r)| is_place(*p) && r.is_finite()).collect();
    svg.raw(&format!("<g fill=\"{PLUME}\" fill-opacity=\"0.16\">"));
    for i in chosen(shown.len(), FILAMENTS_MAX) {
        let (p, radius) = shown[i];
        let at = frame.place(*p);
        if frame.shows(at) {
            svg.circle(at, (radius * frame.scale).clamp(1.3, 60.0), "");
        }
    }
    svg.raw("</g>");
}

/// Which of `count` are shown when at most `most` may be.
fn chosen(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let shown = count.min(most);
    (0..shown).map(move |i| i * count / shown)
}

/// The track, coloured by behavior.
pub fn track(svg: &mut Svg, runs: &[Run]) {
    svg.raw("<g fill=\"none\" stroke-width=\"1.8\" stroke-linejoin=\"round\" stroke-linecap=\"round\">");
    // One element for each behavior, not for each stretch: a table that switches every second must not fill the file.
    for behavior in runs.iter().map(|run| run.behavior).collect::<BTreeSet<_>>() {
        let (colour, dashes) = style(behavior);
        let own = runs.iter().filter(|run| run.behavior == behavior).map(|run| run.points.as_slice());
        svg.paths(own, &format!("stroke=\"{colour}\"{}", dashes.trim_end()));
    }
    svg.raw("</g>");
}

fn detections(svg: &mut Svg, picture: &Picture, frame: &Frame) {
    let mut cells = BTreeSet::new();
    let mut crosses = Vec::new();
    for p in picture.detections.iter().filter(|p| is_place(**p)) {
        let (x, y) = frame.place(*p);
        if frame.shows((x, y)) && cells.insert(((x / DETECTION_CELL) as i64, (y / DETECTION_CELL) as i64)) {
            crosses.push((x, y));
        }
    }
    let mut d = String::new();
    for i in chosen(crosses.len(), DETECTIONS_MAX) {
        let (x, y) = crosses[i];
        // Writing to a string cannot fail.
        let _ = write!(d, "M{} {}l7 7m-7 0l7-7", px(x - 3.5), px(y - 3.5));
    }
    if !d.is_empty() {
        svg.raw(&format!("<path d=\"{d}\" fill=\"none\" stroke=\"{DETECTION}\" stroke-width=\"0.9\"/>"));
    }
}

/// Where there is a dot for what has a name, such as a report: of one name one in each square of so many pixels, and so many at most.
fn dots<'a>(named: &'a [(String, Point)], frame: &Frame, cell: f64, most: usize) -> Vec<(&'a str, (f64, f64))> {
    let mut cells = BTreeSet::new();
    let mut apart = Vec::new();
    for (name, p) in named.iter().filter(|(_, p)| is_place(*p)) {
        let (x, y) = frame.place(*p);
        if cells.insert((name, (x / cell) as i64, (y / cell) as i64)) {
            apart.push((name.as_str(), (x, y)));
        }
    }
    chosen(apart.len(), most).map(|i| apart[i]).collect()
}

/// The beginnings of rounds that are legs on this chart.
pub fn legs(rounds: &[(String, Point)], frame: &Frame) -> Vec<(String, Point)> {
    let is_far = |a: &(String, Point), b: &(String, Point)| {
        let (a, b) = (frame.place(a.1), frame.place(b.1));
        let (right, down) = (a.0 - b.0, a.1 - b.1);
        right * right + down * down >= LEG_MIN * LEG_MIN
    };
    let is_leg = |i: &usize| {
        let before = i.checked_sub(1).and_then(|before| rounds.get(before));
        let beside = before.into_iter().chain(rounds.get(i + 1));
        rounds.get(*i).is_some_and(|round| beside.into_iter().all(|other| is_far(round, other)))
    };
    (0..rounds.len()).filter(is_leg).map(|i| rounds[i].clone()).collect()
}

fn marks(svg: &mut Svg, picture: &Picture, frame: &Frame, runs: &[Run]) {
    let places = |named: &'_ [(String, Point)]| -> Vec<(String, (f64, f64))> {
        named.iter().filter(|(_, p)| is_place(*p)).map(|(name, p)| (name.clone(), frame.place(*p))).collect()
    };
    let sources = places(&picture.sources);
    let reports = dots(&picture.reports, frame, REPORT_CELL, REPORTS_MAX);
    let legs = legs(&picture.rounds, frame);
    let rounds = dots(&legs, frame, ROUND_CELL, ROUNDS_MAX);
    let [start, end, deepest] =
        [picture.start, picture.end, picture.deepest].map(|p| p.filter(|p| is_place(*p)).map(|p| frame.place(p)));
    let mut taken: Vec<_> = sources.iter().map(|(_, at)| (*at, RING)).collect();
    taken.extend(deepest.map(|at| (at, RING)));
    taken
        .extend(reports.iter().map(|(_, at)| (*at, 6.0)).chain([start, end].into_iter().flatten().map(|at| (at, 8.0))));
    taken.extend(rounds.iter().map(|(_, at)| (*at, 4.0)));
    let mut around = outline(&picture.area, frame);
    around.extend(around.first().copied());
    let leaks = leaks(&picture.leaks, frame);
    let chemical: Vec<_> = picture.true_outlines.iter().map(|named| outline(&named.corners, frame)).collect();
    let lines = runs.iter().map(|run| run.points.as_slice()).chain([around.as_slice()]);
    let lines = lines.chain(leaks.iter().chain(&chemical).map(Vec::as_slice));
    let mut labels = Labels::new(lines, &taken);

    rounds.iter().for_each(|(_, at)| round_mark(svg, *at));
    end.into_iter().for_each(|at| end_mark(svg, at));
    start.into_iter().for_each(|at| start_mark(svg, at));
    sources.iter().map(|(_, at)| *at).chain(deepest).for_each(|at| source_mark(svg, at));
    reports.iter().for_each(|(_, at)| report_mark(svg, *at));
    let no_go = picture.no_go.iter().map(|(name, corners)| (name, corners, NO_GO));
    let reported = picture.outlines.iter().map(|(name, corners)| (name, corners, OUTLINE));
    let regions = picture.regions.iter().map(|(name, corners)| (name, corners, REGION));
    for (name, corners, colour) in no_go.chain(reported).chain(regions) {
        let corners = outline(corners, frame);
        let share = 1.0 / corners.len().max(1) as f64;
        let middle = corners.iter().fold((0.0, 0.0), |(x, y), corner| (x + share * corner.0, y + share * corner.1));
        if frame.shows(middle) {
            labels.put(svg, frame, middle, name, colour);
        }
    }
    let mut named = BTreeSet::new();
    let (first, again): (Vec<_>, Vec<_>) = reports.iter().take(LABELS_MAX).partition(|(name, _)| named.insert(*name));
    for (name, at) in first {
        labels.put(svg, frame, at, name, "#111");
    }
    for (name, at) in &sources {
        labels.put(svg, frame, *at, name, SOURCE);
    }
    for (named, corners) in picture.true_outlines.iter().zip(&chemical) {
        // At its northernmost corner: the middle is where the track and what is reported lie.
        let top = corners.iter().filter(|at| frame.shows(**at)).min_by(|a, b| a.1.total_cmp(&b.1));
        top.into_iter().for_each(|at| labels.put(svg, frame, *at, &named.name, true_outline::COLOUR));
    }
    start.into_iter().for_each(|at| labels.put(svg, frame, at, "start", "#111"));
    end.into_iter().for_each(|at| labels.put(svg, frame, at, "end", "#111"));
    for (name, at) in again {
        labels.put_again(svg, frame, at, name, "#111");
    }
    for (name, at) in rounds {
        labels.put(svg, frame, at, name, ROUND);
    }
    picture.depths.label(svg, frame, &mut labels);
}

/// A small open dot.
pub fn round_mark(svg: &mut Svg, at: (f64, f64)) {
    svg.circle(at, 3.0, &format!("fill=\"#fff\" stroke=\"{ROUND}\" stroke-width=\"1.2\""));
}

/// A white triangle.
pub fn start_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    let corners = [(x, y - 7.0), (x + 6.5, y + 5.0), (x - 6.5, y + 5.0)];
    svg.path(&corners, true, "fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\" stroke-linejoin=\"round\"");
}

/// A white square with a dot.
pub fn end_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    let corners = [(x - 6.0, y - 6.0), (x + 6.0, y - 6.0), (x + 6.0, y + 6.0), (x - 6.0, y + 6.0)];
    svg.path(&corners, true, "fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\" stroke-linejoin=\"round\"");
    svg.circle((x, y), 2.6, "fill=\"#111\"");
}

/// A star in a ring.
pub fn source_mark(svg: &mut Svg, (x, y): (f64, f64)) {
    svg.circle((x, y), RING, "fill=\"#fff\" fill-opacity=\"0.75\" stroke=\"#7a0019\" stroke-width=\"1.6\"");
    // A five-pointed star, outer radius 8 and inner 3.4, as offsets: exact on every machine.
    let half = [(0.0, -8.0), (2.0, -2.75), (7.61, -2.47), (3.23, 1.05), (4.7, 6.47), (0.0, 3.4)];
    let right = half.iter().map(|(dx, dy)| (x + dx, y + dy));
    let left = half[1..5].iter().rev().map(|(dx, dy)| (x - dx, y + dy));
    svg.path(&right.chain(left).collect::<Vec<_>>(), true, "fill=\"#ffc20a\" stroke=\"#7a0019\" stroke-width=\"0.9\"");
}

/// A dark dot.
pub fn report_mark(svg: &mut Svg, at: (f64, f64)) {
    svg.circle(at, 4.2, "fill=\"#111\" stroke=\"#fff\" stroke-width=\"1.4\"");
}
