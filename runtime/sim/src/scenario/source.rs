//! What releases chemical, or has released it: what a scenario says of it, and what of that cannot be.

use crate::plume::spin_up_begin;
use crate::scenario::{Objections, Scenario};
use albacore_geometry::Point;
use serde::{Deserialize, Serialize};

/// What releases chemical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    /// What it is called.
    pub name: String,
    /// Where it stands. Default the frame's origin.
    pub at: Point,
    /// The other end of a leak that is a line, where each place releases as much. Default none: a point.
    pub to: Option<Point>,
    /// Metres above the bottom. Default 0.2.
    pub height: f64,
    /// Filaments released a second, on average; the moments are a Poisson process. Default 1.
    pub rate: f64,
    /// What the sensor reads in the middle of one single filament of age `reference_age`, as a ratio of full scale.
    /// Default 0.08: twice a 4 % threshold.
    pub peak: f64,
    /// The age that `peak` is for, s. Default 8752: 1094 m at 12.5 cm/s.
    pub reference_age: f64,
    /// When it releases. Default always.
    pub when: Times,
}

/// When a source releases. Seconds after tick 0; 0 stands for no such time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Times {
    /// It begins then. Default long before the run.
    pub begins: f64,
    /// It ends then. Default never.
    pub ends: f64,
    /// It is on for so long at a time, the first from `begins` or tick 0. Default all the time.
    pub on: f64,
    /// And then off for so long.
    pub off: f64,
}

impl Times {
    /// Whether it releases at a time, s.
    pub fn hold(&self, time: f64) -> bool {
        let begun = self.begins == 0.0 || time >= self.begins;
        let ended = self.ends != 0.0 && time >= self.ends;
        let round = self.on + self.off;
        let on = self.off == 0.0 || {
            let turns = (time - self.begins) / round;
            (turns - turns.floor()) * round < self.on
        };
        begun && !ended && on
    }
}

/// Chemical that was left in the water before the run: a round cloud of filaments, Gaussian in the horizontal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
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
    pub reference_age: f64,
}

impl Default for Patch {
    fn default() -> Self {
        let Source { at, height, peak, reference_age, .. } = Source::default();
        let name = String::from("patch");
        Patch { name, at, radius: 10.0, height, filaments: 100, age: 3600.0, peak, reference_age }
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

/// What of the sources cannot be, once region and flow are sound.
pub(crate) fn check(scenario: &Scenario, objections: &mut Objections) {
    // A record's source is there to be told of.
    let sources = !scenario.sources.is_empty() && scenario.recording.is_none();
    for (some, what) in [(sources, "sources"), (!scenario.patches.is_empty(), "patches")] {
        objections
            .unless(!some || scenario.plume.is_some(), format!("`{what}` need a `plume`: without one nothing spreads"));
    }
    let before = objections.0.len();
    let layer = scenario.plume.as_ref().and_then(|plume| plume.layer);
    let place = |what: &str, at: Point, height: f64, objections: &mut Objections| {
        objections.finite(&format!("{what}: at"), [at.north, at.east]);
        objections.not_negative(&format!("{what}: height"), height);
        if let Some(region) = &scenario.region {
            let gap = region.gap(at);
            objections.unless(gap >= 0.0 || gap.is_nan(), format!("{what} is {:.1} m outside the `region`", -gap));
        }
        if let Some(layer) = layer {
            objections.unless(
                height <= layer || height.is_nan(),
                format!("{what} is {height} m above the bottom, over the `plume.layer` of {layer} m"),
            );
        }
    };
    for source in &scenario.sources {
        let name = format!("source `{}`", source.name);
        place(&name, source.at, source.height, objections);
        if let Some(to) = source.to {
            place(&format!("the other end of {name}"), to, source.height, objections);
        }
        objections.positive(&format!("{name}: rate"), source.rate);
        objections.positive(&format!("{name}: peak"), source.peak);
        objections.not_negative(&format!("{name}: reference_age"), source.reference_age);
        let times = &source.when;
        objections.finite(&format!("{name}: begins"), [times.begins, 0.0]);
        objections.unless(
            times.ends == 0.0 || times.ends > times.begins,
            format!("{name} ends at {} s, before it begins", times.ends),
        );
        objections.not_negative(&format!("{name}: on"), times.on);
        objections.not_negative(&format!("{name}: off"), times.off);
        objections.unless(
            times.off == 0.0 || times.on > 0.0,
            format!("{name} is off for {} s at a time and never on: say for how long it is `on`", times.off),
        );
    }
    for patch in &scenario.patches {
        let name = format!("patch `{}`", patch.name);
        place(&name, patch.at, patch.height, objections);
        objections.not_negative(&format!("{name}: radius"), patch.radius);
        objections.not_negative(&format!("{name}: age"), patch.age);
        objections.positive(&format!("{name}: peak"), patch.peak);
        objections.not_negative(&format!("{name}: reference_age"), patch.reference_age);
    }
    if objections.0.len() == before && scenario.plume.is_some() && scenario.flow.speed() > 0.0 {
        check_size(scenario, objections);
    }
}

/// Whether there is more plume than can be computed.
fn check_size(scenario: &Scenario, objections: &mut Objections) {
    let transit = -spin_up_begin(scenario);
    objections.unless(
        transit <= SPIN_UP_MAX_S,
        format!("the flow is so slow that the plume takes {transit:.0} s to cross the region: at most {SPIN_UP_MAX_S} s are simulated"),
    );
    let released = transit * scenario.sources.iter().map(|source| source.rate).sum::<f64>();
    let filaments = released + scenario.patches.iter().map(|patch| f64::from(patch.filaments)).sum::<f64>();
    objections.unless(
        filaments <= FILAMENTS_MAX,
        format!(
            "the sources' `rate` makes about {filaments:.0} filaments at a time: at most {FILAMENTS_MAX} are simulated"
        ),
    );
}

/// The longest spin-up of a plume, s.
pub(crate) const SPIN_UP_MAX_S: f64 = 200_000.0;
/// The most filaments alive, by estimate.
const FILAMENTS_MAX: f64 = 200_000.0;
