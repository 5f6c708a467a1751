//! What the picture of a run is made of: what is known of its world, and what is gathered while it goes.

use crate::boundary::{drawn, drawn_since_start, room};
use crate::recorders::{InMemory, WorldAtEnd};
use crate::summary::{Report, Summary};
use albacore_geometry::{Geodetic, Point, Vector};
use albacore_program::number;
use albacore_sim::Scenario;
use albacore_trace::{Depths, Picture};
use albacore_vehicle::{TICK_S, seconds};
use std::ops::RangeInclusive;

/// What is so in a world before any run, with the flow that carries its plume, m/s.
pub(crate) fn of_world(scenario: &Scenario, carrying: Vector) -> Picture {
    let upper = scenario.environment.flow.upper.as_ref();
    let below = if upper.is_some() { "lower layer:" } else { "flow" };
    let flows = [
        Some((below.to_string(), carrying)),
        upper.map(|upper| (format!("above {}:", number::metres(upper.above)), upper.mean)),
    ];
    Picture {
        no_go: scenario
            .environment
            .no_go
            .iter()
            .map(|zone| (zone.name.clone(), zone.area.corners().to_vec()))
            .collect(),
        sources: scenario.environment.sources.iter().map(|source| (source.name.clone(), source.at)).collect(),
        leaks: scenario.environment.sources.iter().filter_map(|source| Some([source.at, source.to?])).collect(),
        flows: flows.into_iter().flatten().collect(),
        ..Picture::default()
    }
}

/// Reports that are told beside the picture; all of them are in the trace.
const TOLD_MAX: usize = 8;

/// The picture of a run as SVG: in the world that is known, with the plume's filaments as they are at its end. Of a vehicle at the end of a
/// link nobody knows how deep the water is.
pub(crate) fn of_run(run: &InMemory, world: &WorldAtEnd) -> String {
    let InMemory { results, track, .. } = run;
    let (summary, scenario) = (results.summary(0.0), &results.plan.scenario);
    let deepest = results.deepest_sought();
    let sounded = if deepest.is_some() { results.area.as_slice() } else { &[] };
    let depth = |p| if world.in_simulation { scenario.environment.bottom.depth_at(p) } else { f64::NAN };
    if let Some(ticks) = &track.zoom {
        return of_a_time(run, world, ticks).svg();
    }
    let place = |report: &Report| Some((report.name.clone(), Point::new(report.north_m?, report.east_m?)));
    let slicks = if world.in_simulation { results.slicks.as_slice() } else { &[] };
    let mut picture = Picture {
        title: summary.mission.clone(),
        subtitle: subtitle(&summary, results.plan.program.mission.origin),
        depths: Depths::sound(sounded, depth),
        area: results.area.clone(),
        regions: results.regions.clone(),
        plume: world.plume.clone(),
        deepest,
        map: results.map.clone(),
        outlines: results.areas.clone().into_iter().collect(),
        true_outlines: drawn_since_start(slicks, seconds(results.ticks)),
        start: results.start,
        track: track.points.clone(),
        behaviors: track.behaviors.clone(),
        rounds: track.rounds.clone(),
        detections: track.detections.clone(),
        end: track.end,
        profile: track.profile.clone(),
        reports: summary.reports.iter().filter_map(place).collect(),
        ..of_world(scenario, scenario.environment.flow.mean)
    };
    let outlines = picture.true_outlines.iter().flat_map(|named| [named.corners.as_slice(), &named.before]);
    picture.water = room(picture.extent(), outlines);
    picture.svg()
}

/// A source so near to the track is shown beside it, m.
const BESIDE_M: f64 = 30.0;

/// The picture of a time of a run, in ticks: the track and what was detected and reported in it, in what of the true outlines is there at its end. The plume is
/// known as it is at the end of the run alone.
fn of_a_time(run: &InMemory, world_at_end: &WorldAtEnd, ticks: &RangeInclusive<u64>) -> Picture {
    let InMemory { results, track, .. } = run;
    let (summary, scenario) = (results.summary(0.0), &results.plan.scenario);
    let from_to = [ticks.start(), ticks.end()].map(|tick| number::seconds(*tick).trim().to_string());
    let nothing = if track.points.is_empty() { ": the run was over before" } else { "" };
    let mut subtitle = subtitle(&summary, results.plan.program.mission.origin);
    subtitle.truncate(2);
    subtitle.push(format!("shown: {}{nothing}", from_to.join(" to ")));
    let is_then = |report: &&Report| ticks.contains(&((report.t_s / TICK_S).round() as u64));
    let place = |report: &Report| Some((report.name.clone(), Point::new(report.north_m?, report.east_m?)));
    let world = of_world(scenario, scenario.environment.flow.mean);
    let is_beside = |(_, source): &(String, Point)| track.points.iter().any(|(at, _)| at.distance(*source) < BESIDE_M);
    let slicks = if world_at_end.in_simulation { results.slicks.as_slice() } else { &[] };
    Picture {
        title: summary.mission.clone(),
        subtitle,
        true_outlines: drawn(slicks, seconds(results.ticks.min(*ticks.end()))),
        track: track.points.clone(),
        behaviors: track.behaviors.clone(),
        rounds: track.rounds.clone(),
        detections: track.detections.clone(),
        end: track.end,
        profile: track.profile.clone(),
        reports: summary.reports.iter().filter(is_then).filter_map(place).collect(),
        sources: world.sources.into_iter().filter(is_beside).collect(),
        no_go: world.no_go,
        flows: world.flows,
        ..Picture::default()
    }
}

/// What a picture says of its run, about an origin on the globe if there is one.
fn subtitle(summary: &Summary, origin: Option<Geodetic>) -> Vec<String> {
    let mut subtitle = vec![format!(
        "scenario {}, seed {}: {} after {}",
        summary.scenario,
        summary.seed,
        summary.outcome.replace('_', " "),
        number::seconds(summary.ticks).trim()
    )];
    subtitle.extend(origin.map(|origin| format!("origin (0, 0) at {origin}")));
    for report in summary.reports.iter().take(TOLD_MAX) {
        let error = report.error_m.zip(report.error_from);
        let error = error.map(|(e, from)| format!(", {} from {from}", number::metres(e))).unwrap_or_default();
        let position = report.position().map(|position| format!(", {position}")).unwrap_or_default();
        let at = number::fixed(report.t_s, 1);
        subtitle.push(format!("reported \"{}\" at {at} s{position}{error}", report.name));
    }
    match summary.reports_beyond(TOLD_MAX) {
        0 => {}
        more => subtitle.push(format!("and {more} more reports, in the trace")),
    }
    subtitle
}
