//! Whether a world has what a mission needs that runs in it: a place near its area, sensors for what it requires, and anything
//! known of its area.

use albacore_geometry::{Area, Geodetic, Point, TangentFrame};
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::source::Span;
use albacore_lang::{FAR_M, SAME_PLANE_M, Script};
use albacore_program::senses;
use albacore_sim::{Ground, NoGo, Scenario};
use albacore_vehicle::measurements;
use albacore_wording::distance;

/// A world in which a mission is to run.
pub(crate) struct Held<'a> {
    /// Its name.
    pub name: &'a str,
    /// The world, in the frame of the mission.
    pub world: &'a Scenario,
    /// Its own positions on the globe.
    pub places: &'a [Geodetic],
    /// Where the frame of the mission touches the globe.
    pub origin: Option<Geodetic>,
}

/// What a mission misses in a world.
pub(crate) fn findings(script: &Script, mission: &str, held: &Held) -> Vec<Diagnostic> {
    let (name, world) = (held.name, held.world);
    let mut findings = unsensed(script, mission, name, world);
    findings.extend(unanswered(script, mission, name, world));
    findings.extend(unmeasured(script, mission, name, world));
    findings.extend(awaited(script, mission, name, world));
    match elsewhere(script, mission, held) {
        Some(finding) => findings.push(finding),
        None => {
            findings.extend(uncovered(script, mission, name, world));
            findings.extend(far_zones(script, mission, name, world));
        }
    }
    findings
}

/// A world whose region does not meet the area of the mission, or whose vehicle starts far from it: an error.
fn elsewhere(script: &Script, mission: &str, held: &Held) -> Option<Diagnostic> {
    let (area, written) = script.operating_area(mission)?;
    let (name, world) = (held.name, held.world);
    // Far apart on the globe both are as far apart as it says: no plane reaches from the one to the other.
    let nearest = held.origin.and_then(|here| {
        held.places.iter().map(|there| (there.great_circle(here), *there, here)).min_by(|a, b| a.0.total_cmp(&b.0))
    });
    let start = -area.gap(world.vehicle.start);
    // A record is its own region, and `uncovered` says more of it.
    let region = world.environment.region.as_ref().filter(|_| world.environment.recording.is_none());
    let on_globe = |point| held.origin.map(|origin| TangentFrame { origin }.to_geodetic(point));
    let (message, what, there) = match (nearest.filter(|(apart, ..)| *apart > SAME_PLANE_M), region) {
        (Some((apart, there, _)), _) => {
            let message = format!("`{name}` lies {:.0} km from the area of the mission `{mission}`", apart / 1000.0);
            (message, format!("`{name}`"), Some(there))
        }
        (None, Some(region)) if !region.overlaps(&area) => {
            let away = distance(area.distance(region));
            let message = format!(
                "the region of `{name}` does not meet the area of the mission `{mission}`: it lies {away} away"
            );
            (message, "the region".to_string(), on_globe(region.center()))
        }
        _ if start > FAR_M => {
            let message =
                format!("the vehicle of `{name}` starts {} from the area of the mission `{mission}`", distance(start));
            (message, "the start".to_string(), on_globe(world.vehicle.start))
        }
        _ => return None,
    };
    if let Some(swapped) = script.swapped_area(mission, held.places) {
        return Some(swapped);
    }
    let places = match nearest.and_then(|(_, _, here)| Some((here, there?))) {
        Some((here, there)) => {
            let asked = albacore_lang::hemisphere(here, there).map_or(String::new(), |asked| format!(" ({asked})"));
            format!("the area lies about {here}{asked}, {what} about {there}")
        }
        None => "both are in metres from one origin".to_string(),
    };
    let own = script.own_scenario(mission);
    let mend = match own {
        Some(own) if own != name => format!("run it in a scenario that lies there, such as its own, `--in {own}`"),
        _ => format!("move the one to the other, or write `mission {mission} in SCENARIO` with one that lies there"),
    };
    Some(Diagnostic::error(Code::ScenariosOutside, written, message).help(format!("{places}: {mend}")))
}

/// No-go zones of a world far from the area of the mission, which cannot keep it from anything. Those of its own scenario are told
/// where they are written.
fn far_zones(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Vec<Diagnostic> {
    let own = script.own_scenario(mission);
    let Some((area, written)) = script.operating_area(mission).filter(|_| own != Some(scenario)) else {
        return Vec::new();
    };
    let far = |zone: &NoGo| {
        let out = area.distance(&zone.area);
        let what = format!("the no-go zone \"{}\" of `{scenario}`", zone.name);
        let message = format!("{what} is {} outside the area of the mission `{mission}`", distance(out));
        let help = "look for minutes exchanged in its corners, and for north and east";
        (out > FAR_M).then(|| Diagnostic::warning(Code::ScenariosOutside, written, message).help(help))
    };
    world.environment.no_go.iter().filter_map(far).collect()
}

/// What the mission requires or records, and the vehicle has no sensor for.
fn unsensed(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Vec<Diagnostic> {
    let told = world.measurements();
    let is_told =
        |input: &str| senses::ALWAYS_THERE.contains(&input) || told.iter().any(|measurement| measurement.name == input);
    let finding = |(input, span): (&str, Span)| {
        let message = format!("the vehicle of `{scenario}` has no sensor for `{input}`");
        let instrument = measurements::ALL.iter().find(|row| row.name == input).and_then(|row| row.instrument);
        let help = match instrument {
            Some(clause) => {
                let of_clause = measurements::ALL.iter().filter(|row| row.instrument == Some(clause));
                let brings: Vec<&str> = of_clause.map(|row| row.name).collect();
                let itself = if is_of_data_sheet(input) {
                    format!("; or let the mission say it: `{input} fresh 5 s, at first VALUE, else abort`")
                } else {
                    String::new()
                };
                format!("{}, which tells {}{itself}", given(script, scenario, clause), brings.join(" and "))
            }
            None => "no simulated vehicle has one: run the mission on a vehicle that tells it".to_string(),
        };
        Diagnostic::error(Code::ScenariosWorld, span, message).help(help)
    };
    // What a data sheet would tell a mission may say itself: `turn_radius fresh 5 s, at first 12.6 m, else abort`.
    let awaited = script.awaited(mission);
    let is_given = |input: &str| is_of_data_sheet(input) && awaited.iter().all(|(other, _)| *other != input);
    let required = script.requirements(mission);
    let is_required = |input: &str| required.iter().any(|(other, _)| *other == input);
    let recorded = script.recorded(mission).into_iter().filter(|(input, _)| !is_required(input));
    required
        .iter()
        .copied()
        .filter(|(input, _)| !is_given(input))
        .chain(recorded)
        .filter(|(input, _)| !is_told(input))
        .map(finding)
        .collect()
}

fn is_of_data_sheet(input: &str) -> bool {
    measurements::ALL.iter().any(|row| row.name == input && row.is_of_data_sheet())
}

/// How a scenario is given a clause: one of another file stays as it is, and is that of which another is derived.
fn given(script: &Script, scenario: &str, clause: &str) -> String {
    if script.own_scenarios().any(|own| own == scenario) {
        return format!("give `{scenario}` the clause `{clause}`");
    }
    let clause = if clause.ends_with(')') { clause.to_string() } else { format!("{clause}(…)") };
    format!("run it in `scenario NAME = {scenario} with {{ {clause} }}`")
}

/// What the mission asks, and no payload of the vehicle answers.
fn unanswered(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Vec<Diagnostic> {
    let finding = |(action, span): (String, Span)| {
        let message = format!("the vehicle of `{scenario}` has no payload that answers `{action}`");
        let help = given(script, scenario, &format!("payload(\"{action}\", after: 1 s)"));
        Diagnostic::error(Code::ScenariosWorld, span, message).help(help)
    };
    let has = |action: &str| world.payloads.iter().any(|payload| payload.is_of(action));
    script.asked(mission).into_iter().filter(|(action, _)| !has(action)).map(finding).collect()
}

/// A flow that the mission requires, and that the profiler takes for an error.
fn unmeasured(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Option<Diagnostic> {
    let (_, span) = script.requirements(mission).into_iter().find(|(input, _)| *input == senses::FLOW)?;
    let above = world.environment.flow.upper.as_ref().map_or(0.0, |upper| upper.mean.length());
    let (speed, fastest) = (world.environment.flow.speed().max(above), world.instruments.adcp.gates.fastest);
    let message = format!(
        "the flow of `{scenario}` is {speed:.2} m/s, and its profiler takes {fastest:.2} m/s and more for an error: `flow` \
         will be missing, or too slow"
    );
    let help = format!("let `{scenario}` have a profiler for such a flow: `adcp(fastest: {:.1} m/s)`", 2.0 * speed);
    (speed >= fastest).then(|| Diagnostic::warning(Code::ScenariosWorld, span, message).help(help))
}

/// What the mission waits for before it begins, and the vehicle does not tell where it waits.
fn awaited(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Vec<Diagnostic> {
    let told = world.measurements();
    let finding = |(input, span): (&str, Span)| {
        let why = world.silence_at_start(input).filter(|_| told.iter().any(|measurement| measurement.name == input))?;
        let message = format!(
            "`{mission}` begins with the first sample of `{input}`, and in `{scenario}` none comes before: {why}"
        );
        let help = match input {
            senses::FLOW => {
                "give it a value until then: `flow fresh 30 s, at first 0 m/s toward north, else abort`, on a line of its own".to_string()
            }
            _ => format!(
                "give it a value until then, `{input} fresh T, at first VALUE, else …`, or let the vehicle start where its sensor tells it"
            ),
        };
        Some(Diagnostic::warning(Code::ScenariosWorld, span, message).help(help))
    };
    script.awaited(mission).into_iter().filter_map(finding).collect()
}

/// Areas that reach no further beyond what is known than this, m, are meant to be its own.
const MARGIN: f64 = 0.5;

/// What the area of the mission has beyond a surveyed bottom or a recorded plume, where what the vehicle meets is made up. All of it is
/// an error.
fn uncovered(script: &Script, mission: &str, scenario: &str, world: &Scenario) -> Vec<Diagnostic> {
    let Some((area, written)) = script.operating_area(mission) else { return Vec::new() };
    let finding = |(what, region, beyond): (&str, Area, &str)| {
        let out = area.corners().iter().map(|&corner| -region.gap(corner)).fold(0.0, f64::max);
        let lies = format!("the {what} lies {}", reach(&region));
        if !region.overlaps(&area) {
            let message = format!("no part of the area of the mission `{mission}` lies in the {what} of `{scenario}`");
            let finding = Diagnostic::error(Code::ScenariosOutside, written, message);
            return Some(finding.help(format!("move it there: {lies}; {beyond}")));
        }
        let message =
            format!("the area of the mission `{mission}` reaches {out:.0} m beyond the {what} of `{scenario}`");
        let finding = Diagnostic::warning(Code::ScenariosOutside, written, message);
        (out > MARGIN).then(|| finding.help(format!("{lies}; {beyond}")))
    };
    known(world).into_iter().filter_map(finding).collect()
}

/// What of a world was measured or computed elsewhere: what it is, where that is, and what is beyond.
fn known(world: &Scenario) -> Vec<(&'static str, Area, &'static str)> {
    let record = world.environment.recording.as_ref().map(|recorded| recorded.recording.area().clone());
    let record =
        record.map(|area| ("record", area, "beyond it there is no chemical, and the flow is that of its edge"));
    let survey = match &world.environment.bottom.ground {
        Ground::Plane(_) => None,
        Ground::Grid(grid) => grid.area(),
    };
    let survey = survey.map(|area| ("survey", area, "beyond it the water is as deep as at its nearest edge"));
    record.into_iter().chain(survey).collect()
}

/// Where an area lies, in words.
fn reach(area: &Area) -> String {
    let of = |along: fn(&Point) -> f64| {
        let all = area.corners().iter().map(along);
        let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), x| (l.min(x), m.max(x)));
        // Not "-0 m".
        let whole = |x: f64| x.round() + 0.0;
        format!("{:.0} m to {:.0} m", whole(least), whole(most))
    };
    format!("{} north and {} east of the origin", of(|p| p.north), of(|p| p.east))
}
