//! GeoJSON (RFC 7946): track, areas and reports as features, the areas of a report as features of their own. A third coordinate is the height above the surface, which is negative
//! below it.

use crate::exported::{Exported, Outline, Place, Reported, Track};
use crate::text::{self, Members};
use serde_json::Value;

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let tracks = run.tracks().filter_map(|(name, track)| way(run, name, track));
    let outlines = run.outlines.iter().enumerate().filter_map(|(at, outline)| area(at, outline));
    let truth = run.true_outlines.iter().filter_map(|outline| true_outline(run, outline));
    let reports = run.reports.iter().flat_map(|report| {
        let areas = report.areas.iter().filter_map(|outline| reported_area(run, report, outline));
        point(run, report).into_iter().chain(areas)
    });
    let features: Vec<String> = tracks.chain(outlines).chain(truth).chain(reports).collect();
    format!("{{\"type\":\"FeatureCollection\",\"features\":[\n{}\n]}}\n", features.join(",\n")).into_bytes()
}

fn way(run: &Exported, name: &str, track: &Track) -> Option<String> {
    let points: Vec<_> = run.points(track).collect();
    let coordinates: Vec<String> = points.iter().map(|(_, place)| position(place)).collect();
    let geometry = match coordinates.as_slice() {
        [] => return None,
        // A line has two points at least.
        [only] => format!("{{\"type\":\"Point\",\"coordinates\":{only}}}"),
        several => format!("{{\"type\":\"LineString\",\"coordinates\":[{}]}}", several.join(",")),
    };
    let mut properties = Members::default();
    properties.text("kind", "track");
    properties.text("name", name);
    run.about.facts().iter().for_each(|(fact, told)| properties.text(fact, told));
    let times = points.iter().map(|(tick, _)| text::quoted(&text::moment(run.about.moment_ms(*tick))));
    properties.raw("times", &format!("[{}]", times.collect::<Vec<_>>().join(",")));
    Some(feature(&geometry, &properties))
}

fn area(at: usize, outline: &Outline) -> Option<String> {
    let mut properties = Members::default();
    properties.text("kind", if at == 0 { "area" } else { "region" });
    properties.text("name", &outline.name);
    Some(feature(&polygon(outline)?, &properties))
}

/// What nobody has measured says so in its kind and its name.
fn true_outline(run: &Exported, outline: &Outline) -> Option<String> {
    let mut properties = Members::default();
    properties.text("kind", "true outline");
    properties.text("name", &format!("true outline of {}", outline.name));
    when(run, run.end(), &mut properties);
    Some(feature(&polygon(outline)?, &properties))
}

fn reported_area(run: &Exported, report: &Reported, outline: &Outline) -> Option<String> {
    let mut properties = Members::default();
    properties.text("kind", "reported area");
    properties.text("name", &outline.name);
    properties.text("reported", &report.name);
    when(run, report.tick, &mut properties);
    properties.text("told", &report.told);
    properties.raw("report", &without_corners(&report.value).to_string());
    Some(feature(&polygon(outline)?, &properties))
}

fn polygon(outline: &Outline) -> Option<String> {
    let mut ring = outline.ring()?;
    if is_clockwise(&ring) {
        ring.reverse();
    }
    let ring: Vec<String> = ring.into_iter().map(position).collect();
    Some(format!("{{\"type\":\"Polygon\",\"coordinates\":[[{}]]}}", ring.join(",")))
}

/// Without what the geometry tells.
fn without_corners(value: &Value) -> Value {
    match value {
        Value::Object(members) => {
            let others = members.iter().filter(|(name, of)| *name != "corners" || !of.is_array());
            Value::Object(others.map(|(name, of)| (name.clone(), without_corners(of))).collect())
        }
        other => other.clone(),
    }
}

fn when(run: &Exported, tick: u64, properties: &mut Members) {
    properties.raw("time_s", &text::seconds(tick));
    properties.text("time", &text::moment(run.about.moment_ms(tick)));
}

fn point(run: &Exported, report: &Reported) -> Option<String> {
    let place = report.place.filter(Place::is_on_globe)?;
    let mut properties = Members::default();
    properties.text("kind", "report");
    properties.text("name", &report.name);
    when(run, report.tick, &mut properties);
    properties.number("north_m", place.north);
    properties.number("east_m", place.east);
    properties.text("told", &report.told);
    properties.raw("report", &report.value.to_string());
    Some(feature(&format!("{{\"type\":\"Point\",\"coordinates\":{}}}", position(&place)), &properties))
}

fn feature(geometry: &str, properties: &Members) -> String {
    format!("{{\"type\":\"Feature\",\"geometry\":{geometry},\"properties\":{}}}", properties.object())
}

fn position(place: &Place) -> String {
    let height = text::number(0.0 - place.depth).map(|height| format!(",{height}")).unwrap_or_default();
    format!("[{},{}{height}]", text::degrees(place.longitude), text::degrees(place.latitude))
}

/// Whether corners go round with the clock, as a map with north above shows them.
fn is_clockwise(corners: &[&Place]) -> bool {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.north * b.east - a.east * b.north).sum::<f64>() > 0.0
}
