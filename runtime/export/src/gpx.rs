//! GPX 1.1: reports as waypoints, areas as closed routes, also those that were reported, tracks with times. Its `ele` is the height above the surface.

use crate::csv::told;
use crate::exported::{Exported, Place};
use crate::text::{self, xml};
use std::fmt::Write;

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut out = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <gpx version=\"1.1\" creator=\"Albacore\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n",
    );
    let time = |tick: u64| format!("<time>{}</time>", text::moment(run.about.moment_ms(tick)));
    let facts: Vec<String> = run.about.facts().iter().map(|(name, fact)| format!("{name}: {fact}")).collect();
    // Memory takes everything, here and below.
    let _ = writeln!(
        out,
        "<metadata><name>{}</name><desc>{}</desc>{}</metadata>",
        xml(&run.about.mission),
        xml(&facts.join("; ")),
        time(0)
    );
    for report in &run.reports {
        let Some(place) = report.place.filter(Place::is_on_globe) else { continue };
        let _ = writeln!(
            out,
            "<wpt {}>{}{}<name>{}</name><desc>{}</desc></wpt>",
            at(&place),
            height(&place),
            time(report.tick),
            xml(&report.name),
            xml(&told(report))
        );
    }
    for outline in run.outlines.iter().chain(run.reports.iter().flat_map(|report| &report.areas)) {
        let Some(ring) = outline.ring() else { continue };
        let _ = writeln!(out, "<rte><name>{}</name>", xml(&outline.name));
        for corner in ring {
            let _ = writeln!(out, "<rtept {}/>", at(corner));
        }
        out.push_str("</rte>\n");
    }
    for (name, track) in run.tracks() {
        let _ = writeln!(out, "<trk><name>{name}</name><trkseg>");
        for (tick, place) in run.points(track) {
            let _ = writeln!(out, "<trkpt {}>{}{}</trkpt>", at(place), height(place), time(tick));
        }
        out.push_str("</trkseg></trk>\n");
    }
    out.push_str("</gpx>\n");
    out.into_bytes()
}

fn at(place: &Place) -> String {
    format!("lat=\"{}\" lon=\"{}\"", text::degrees(place.latitude), text::degrees(place.longitude))
}

fn height(place: &Place) -> String {
    text::number(0.0 - place.depth).map(|height| format!("<ele>{height}</ele>")).unwrap_or_default()
}
