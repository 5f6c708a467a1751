//! What releases chemical, or has released it: what a scenario says of it, and what of that cannot be.

use crate::scenario::{OfClause, Scenario, ScenarioIssues, number, rounded_down};
use crate::world::Environment;
use crate::world::plume::spin_up_begin;
use crate::world::water::Flow;
use albacore_geometry::Point;
use serde::Deserialize;

/// What releases chemical.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Source {
    /// What it is called.
    pub name: String,
    /// Where it stands. Default the frame's origin.
    pub at: Point,
    /// The other end of a leak that is a line, where each place releases as much. Default none: a point.
    #[serde(skip)]
    pub to: Option<Point>,
    /// Metres above the bottom. Default 0.2.
    pub height: f64,
    /// Filaments released a second, on average; the moments are a Poisson process. Default 1.
    pub rate: f64,
    /// What the sensor reads in the middle of one single filament of age `reference_age`, as a ratio of full scale.
    /// Default 0.08: twice a 4 % threshold.
    pub peak: f64,
    /// The age that `peak` is for, s. Default 8752: 1094 m at 12.5 cm/s.
    #[serde(rename = "peak_age")]
    pub reference_age: f64,
    /// When it releases. Default always.
    #[serde(flatten)]
    pub when: Times,
}

/// What releases chemical along a line.
#[derive(Clone, Debug, Deserialize)]
pub struct Leak {
    from: Point,
    to: Point,
    #[serde(flatten)]
    source: Released,
}

/// What a source and a leak have in common.
#[derive(Clone, Debug, Deserialize)]
struct Released {
    name: String,
    height: f64,
    rate: f64,
    peak: f64,
    peak_age: f64,
    #[serde(flatten)]
    when: Times,
}

impl From<Leak> for Source {
    fn from(leak: Leak) -> Self {
        let Released { name, height, rate, peak, peak_age, when } = leak.source;
        Source { name, at: leak.from, to: Some(leak.to), height, rate, peak, reference_age: peak_age, when }
    }
}

/// When a source releases. Seconds after tick 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
pub struct Times {
    /// It begins then; none: long before the run.
    pub begins: Option<f64>,
    /// It ends then; none: never.
    pub ends: Option<f64>,
    /// It is on for so long at a time, the first from `begins` or tick 0; none: all the time.
    pub on: Option<f64>,
    /// And then off for so long.
    pub off: Option<f64>,
}

impl Times {
    /// Whether it releases at a time, s.
    pub fn hold(&self, time: f64) -> bool {
        let begun = self.begins.is_none_or(|begins| time >= begins);
        let ended = self.ends.is_some_and(|ends| time >= ends);
        let (on, off) = (self.on.unwrap_or(0.0), self.off.unwrap_or(0.0));
        let is_on = off == 0.0 || {
            let round = on + off;
            let turns = (time - self.begins.unwrap_or(0.0)) / round;
            (turns - turns.floor()) * round < on
        };
        begun && !ended && is_on
    }
}

/// Chemical that was left in the water before the run: a round cloud of filaments, Gaussian in the horizontal.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Patch {
    /// What it is called.
    pub name: String,
    /// Its middle at tick 0. Default the frame's origin.
    pub at: Point,
    /// The standard deviation of its filaments' places, m an axis. Default 10.
    pub radius: f64,
    /// Height of the filaments above the bottom, m. Default 0.2.
    pub height: f64,
    /// How many they are. Default 100.
    pub filaments: u32,
    /// How old they are at tick 0, s: older ones are wider and thinner. Default 3600.
    pub age: f64,
    /// As of a source. Default 0.08.
    pub peak: f64,
    /// As of a source. Default 8752.
    #[serde(rename = "peak_age")]
    pub reference_age: f64,
}

impl Default for Patch {
    fn default() -> Self {
        let Source { at, height, peak, reference_age, .. } = Source::default();
        let name = String::from("patch");
        Patch { name, at, radius: 10.0, height, filaments: 100, age: 3600.0, peak, reference_age }
    }
}

impl Source {
    /// The place of it that is nearest to another: of a leak anywhere along it.
    pub fn nearest(&self, place: Point) -> Point {
        let Some(to) = self.to else { return self.at };
        let (way, aside) = (to - self.at, place - self.at);
        let share = aside.dot(way) / way.dot(way);
        if share.is_nan() { self.at } else { self.at + share.clamp(0.0, 1.0) * way }
    }
}

impl Default for Source {
    fn default() -> Self {
        Source {
            name: String::from("source"),
            at: Point::ORIGIN,
            to: None,
            height: 0.2,
            rate: 1.0,
            peak: 0.08,
            reference_age: 8752.0,
            when: Times::default(),
        }
    }
}

/// What of the sources cannot be, once region, flow and bottom are sound.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    // A record's source is there to be told of.
    if scenario.environment.recording.is_some() {
        return;
    }
    let before = objections.0.len();
    let mut names = Vec::new();
    for (i, source) in scenario.environment.sources.iter().enumerate() {
        // A script tells them apart, each with its own count.
        let is_leak = |source: &&Source| source.to.is_some();
        let leaks = scenario.environment.sources[..i].iter().filter(is_leak).count();
        let (clause, nth) = if is_leak(&source) { ("leak", leaks) } else { ("source", i - leaks) };
        let mut of = objections.nth(clause, nth);
        check_source(source, &mut of);
        of.name(&source.name, &names);
        names.push(source.name.as_str());
        let first = if source.to.is_some() { "from" } else { "at" };
        check_place(scenario, &mut of, first, source.at, source.height);
        if let Some(to) = source.to {
            check_place(scenario, &mut of, "to", to, source.height);
            let (message, mend) = ("this leak ends where it begins", "write a `source` for a single place");
            of.unless(Some("to"), to != source.at, message, mend);
        }
    }
    for (i, patch) in scenario.environment.patches.iter().enumerate() {
        let mut of = objections.nth("patch", i);
        of.name(&patch.name, &names);
        names.push(patch.name.as_str());
        check_place(scenario, &mut of, "at", patch.at, patch.height);
    }
    check_layer(scenario, objections);
    if objections.0.len() == before && scenario.environment.plume.is_some() && scenario.environment.flow.speed() > 0.0 {
        check_size(scenario, objections);
    }
}

/// A source by itself.
fn check_source(source: &Source, of: &mut OfClause) {
    let times = &source.when;
    // One that has begun long before the run may have ended before it.
    if let (Some(begins), Some(ends)) = (times.begins, times.ends) {
        of.unless(
            Some("ends"),
            ends > begins,
            format!("`{}` ends at {} s, and begins at {} s", source.name, number(ends), number(begins)),
            "let it begin before it ends",
        );
    }
    if let Some(off) = times.off {
        of.unless(
            Some("off"),
            off == 0.0 || times.on.is_some_and(|on| on > 0.0),
            format!("`{}` is off for {} s at a time, and never on", source.name, number(off)),
            "say for how long it is `on`, such as `on: 5 min`",
        );
    }
}

/// Whether chemical can be at a place, so high above the bottom.
fn check_place(scenario: &Scenario, of: &mut OfClause, param: &'static str, at: Point, height: f64) {
    of.unless(
        None,
        scenario.environment.plume.is_some(),
        format!("a `{}` needs a `plume`: without one nothing spreads", of.clause()),
        "add `plume()` to the scenario",
    );
    if let Some(region) = &scenario.environment.region {
        let gap = region.gap(at);
        of.unless(
            Some(param),
            gap >= 0.0,
            format!("this is {:.1} m outside the `region`", -gap),
            "move it into the region, or make that larger: outside nothing spreads",
        );
    }
    let water = scenario.environment.bottom.depth_at(at);
    of.unless(Some(param), water > 0.0 || water.is_nan(), "this is on land", "move it into the water");
    of.unless(
        Some("height"),
        height <= water || water <= 0.0,
        format!("this is {} m above the bottom, where the water is {} m deep", number(height), rounded_down(water)),
        format!("make `height` {} m at most", rounded_down(water)),
    );
    if let Some(layer) = scenario.environment.plume.as_ref().and_then(|plume| plume.layer) {
        of.unless(
            Some("height"),
            height <= layer || height > water,
            format!(
                "this is {} m above the bottom, and the `layer` of the plume {} m high",
                number(height),
                number(layer)
            ),
            "make `height` smaller, or the layer higher",
        );
    }
}

/// Whether the layer that holds the plume is below the surface where the chemical comes from.
fn check_layer(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(layer) = scenario.environment.plume.as_ref().and_then(|plume| plume.layer) else { return };
    let sources = scenario.environment.sources.iter().map(|source| (&source.name, source.at));
    let places = sources.chain(scenario.environment.patches.iter().map(|patch| (&patch.name, patch.at)));
    let mut waters = places.map(|(name, at)| (name, scenario.environment.bottom.depth_at(at)));
    if let Some((name, water)) = waters.find(|(_, water)| *water > 0.0 && layer > *water) {
        let most = rounded_down(water);
        objections.of("plume").unless(
            Some("layer"),
            false,
            format!("the `layer` of the plume is {} m high: at `{name}` the water is {most} m deep", number(layer)),
            format!("make it {most} m at most, or leave `layer` and `vertical` out for a flat plume"),
        );
    }
}

/// Whether there is more plume than can be computed.
fn check_size(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let transit = -spin_up_begin(scenario);
    if transit > SPIN_UP_MAX_S {
        return never_crossed(scenario, objections);
    }
    let released = transit * scenario.environment.sources.iter().map(|source| source.rate).sum::<f64>();
    let filaments = released + scenario.environment.patches.iter().map(|patch| f64::from(patch.filaments)).sum::<f64>();
    objections.of("plume").unless(
        None,
        filaments <= FILAMENTS_MAX,
        format!("the sources release so much that about {filaments:.0} filaments are alive at a time"),
        format!("make their `rate` smaller, or the region: {FILAMENTS_MAX} filaments are simulated at most"),
    );
}

/// A plume takes too long to leave its region: the flow is slow, or turns round before it is there.
fn never_crossed(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let straight = Scenario {
        environment: Environment {
            flow: Flow { turning: 0.0, ..scenario.environment.flow.clone() },
            ..scenario.environment.clone()
        },
        ..scenario.clone()
    };
    if -spin_up_begin(&straight) <= SPIN_UP_MAX_S {
        return objections.of("turning").unless(
            Some("rate"),
            false,
            "the flow turns so quickly that the plume goes round in the region and does not leave it",
            format!("make it turn slower, or the region smaller: {SPIN_UP_MAX_S} s are simulated at most"),
        );
    }
    objections.of("flow").unless(
        Some("mean"),
        false,
        format!("the flow is so slow that the plume takes more than {SPIN_UP_MAX_S} s to cross the region"),
        "make it faster, or the region smaller: so long is simulated at most",
    );
}

/// The longest spin-up of a plume, s.
pub(crate) const SPIN_UP_MAX_S: f64 = 200_000.0;
/// The most filaments alive, by estimate.
const FILAMENTS_MAX: f64 = 200_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leak_is_near_along_all_of_it() {
        let dye = Source { at: Point::new(-200.0, -100.0), ..Source::default() };
        let pipe = Source { to: Some(Point::new(200.0, -100.0)), ..dye.clone() };
        assert_eq!(dye.nearest(Point::new(190.0, -90.0)), dye.at);
        assert_eq!(pipe.nearest(Point::new(190.0, -90.0)), Point::new(190.0, -100.0));
        assert_eq!(pipe.nearest(Point::new(900.0, -90.0)), Point::new(200.0, -100.0));
        let spot = Source { to: Some(dye.at), ..dye.clone() };
        assert_eq!(spot.nearest(Point::new(190.0, -90.0)), dye.at);
    }
}
