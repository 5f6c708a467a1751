//! KML 2.2: the track in time (`gx:Track`), areas as polygons, also those that were reported, reports of places as points.

use crate::csv::told;
use crate::exported::{Exported, Outline, Place};
use crate::text::{self, xml};
use std::fmt::Write;

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
    <kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n";
/// A line of the style, orange for what is believed and green for what is so; KML writes alpha, blue, green, red.
const STYLES: &str = "<Style id=\"track\"><LineStyle><color>ff0080ff</color><width>2</width></LineStyle></Style>\n\
    <Style id=\"true_track\"><LineStyle><color>ff40a000</color><width>1</width></LineStyle></Style>\n\
    <Style id=\"true_outline\"><LineStyle><color>ff40a000</color></LineStyle><PolyStyle><fill>0</fill></PolyStyle></Style>\n\
    <Style id=\"reported_area\"><LineStyle><color>ff0080ff</color></LineStyle><PolyStyle><color>300080ff</color></PolyStyle></Style>\n\
    <Style id=\"area\"><LineStyle><color>ffffffff</color></LineStyle><PolyStyle><fill>0</fill></PolyStyle></Style>\n";

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut out = String::from(HEAD);
    let facts: Vec<String> = run.about.facts().iter().map(|(name, fact)| format!("{name}: {fact}")).collect();
    // Memory takes everything, here and below.
    let _ = writeln!(
        out,
        "<name>{}</name>\n<description>{}</description>",
        xml(&run.about.mission),
        xml(&facts.join("\n"))
    );
    out.push_str(STYLES);
    for outline in &run.outlines {
        polygon(&mut out, outline, &outline.name, "", "area");
    }
    for outline in &run.true_outlines {
        // What nobody has measured says so in its name.
        let name = format!("true outline of {}", outline.name);
        polygon(&mut out, outline, &name, &stamp(run, run.end()), "true_outline");
    }
    for report in &run.reports {
        for outline in &report.areas {
            let about = format!("<description>{}</description>{}", xml(&told(report)), stamp(run, report.tick));
            polygon(&mut out, outline, &outline.name, &about, "reported_area");
        }
        let Some(place) = report.place.filter(Place::is_on_globe) else { continue };
        let _ = writeln!(
            out,
            "<Placemark><name>{}</name><description>{}</description>{}<Point>\
             <coordinates>{}</coordinates></Point></Placemark>",
            xml(&report.name),
            xml(&told(report)),
            stamp(run, report.tick),
            position(&place, ",")
        );
    }
    for (name, track) in run.tracks() {
        let style = name.replace(' ', "_");
        let _ = writeln!(
            out,
            "<Placemark><name>{name}</name><styleUrl>#{style}</styleUrl><gx:Track><altitudeMode>absolute</altitudeMode>"
        );
        for (tick, _) in run.points(track) {
            let _ = writeln!(out, "<when>{}</when>", text::moment(run.about.moment_ms(tick)));
        }
        for (_, place) in run.points(track) {
            let _ = writeln!(out, "<gx:coord>{}</gx:coord>", position(place, " "));
        }
        out.push_str("</gx:Track></Placemark>\n");
    }
    out.push_str("</Document>\n</kml>\n");
    out.into_bytes()
}

fn stamp(run: &Exported, tick: u64) -> String {
    format!("<TimeStamp><when>{}</when></TimeStamp>", text::moment(run.about.moment_ms(tick)))
}

/// An area; what is said about it is written already.
fn polygon(out: &mut String, outline: &Outline, name: &str, about: &str, style: &str) {
    let Some(ring) = outline.ring() else { return };
    let ring: Vec<String> = ring.into_iter().map(|corner| position(corner, ",")).collect();
    // Memory takes everything.
    let _ = writeln!(
        out,
        "<Placemark><name>{}</name>{about}<styleUrl>#{style}</styleUrl><Polygon><outerBoundaryIs><LinearRing><coordinates>{}\
         </coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>",
        xml(name),
        ring.join(" ")
    );
}

/// Longitude, latitude and height above the surface; a depth that nobody knows is none.
fn position(place: &Place, between: &str) -> String {
    let height = text::number(0.0 - place.depth).unwrap_or_else(|| "0".to_string());
    [text::degrees(place.longitude), text::degrees(place.latitude), height].join(between)
}
