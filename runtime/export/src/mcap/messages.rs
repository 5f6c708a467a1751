//! The messages of a log for Foxglove, and their schemas.

use crate::exported::{Exported, Happened, Moment, Place, Reported, Values};
use crate::text::{self, Members, quoted};

/// The schemas, by the names that Foxglove knows.
pub const SCHEMAS: [&str; 4] = ["foxglove.LocationFix", "foxglove.Log", "albacore.State", "albacore.Report"];
const FIX: usize = 0;
const LOG: usize = 1;
const STATE: usize = 2;
const REPORT: usize = 3;

/// The channels: topic and schema.
pub const CHANNELS: [(&str, usize); 5] =
    [("/position", FIX), ("/truth", FIX), ("/state", STATE), ("/reports", REPORT), ("/log", LOG)];
const POSITION: usize = 0;
const TRUTH: usize = 1;
const STATES: usize = 2;
const REPORTS: usize = 3;
const EVENTS: usize = 4;

/// Levels of `foxglove.Log`.
const INFO: u8 = 2;
const WARNING: u8 = 3;
const ERROR: u8 = 4;
/// What the trace's words for what happens are, if they are more than information.
const LEVELS: [(&str, u8); 7] = [
    ("abort", ERROR),
    ("vehicle", WARNING),
    ("stale", WARNING),
    ("limit", WARNING),
    ("link", WARNING),
    ("rules", WARNING),
    ("timeout", WARNING),
];

/// Makes the messages.
pub struct Messages<'a> {
    run: &'a Exported,
    /// The members of a state, one for each column.
    names: Vec<String>,
}

impl<'a> Messages<'a> {
    pub fn new(run: &'a Exported) -> Self {
        Messages { run, names: run.names_in_programs(&["time_s"]) }
    }

    /// Those of a tick, each with its channel.
    pub fn of(&self, moment: &Moment) -> Vec<(usize, String)> {
        let mut messages = Vec::new();
        let timestamp = timestamp(self.run.about.moment_ms(moment.tick));
        if let Some(row) = moment.row {
            let here = self.run.believed.0.get(row).and_then(|place| fix(&timestamp, place));
            messages.extend(here.map(|fix| (POSITION, fix)));
            let truth = self.run.truth.as_ref().and_then(|truth| fix(&timestamp, truth.0.get(row)?));
            messages.extend(truth.map(|fix| (TRUTH, fix)));
            messages.push((STATES, self.state(&timestamp, moment.tick, row)));
        }
        messages.extend(moment.reports.iter().map(|report| (REPORTS, reported(&timestamp, report))));
        messages.extend(moment.events.iter().map(|event| (EVENTS, log(&timestamp, event))));
        messages
    }

    /// All that came in a tick: what did not is not in it.
    fn state(&self, timestamp: &str, tick: u64, row: usize) -> String {
        let mut members = Members::default();
        members.raw("timestamp", timestamp);
        members.raw("time_s", &text::seconds(tick));
        for (column, name) in self.run.columns.iter().zip(&self.names) {
            if let Some(number) = column.values.number(row) {
                members.number(name, number);
            } else if let Some(text) = column.values.text(row) {
                members.text(name, text);
            }
        }
        members.object()
    }
}

fn timestamp(ms: i64) -> String {
    format!("{{\"sec\":{},\"nsec\":{}}}", ms.div_euclid(1000), ms.rem_euclid(1000) * 1_000_000)
}

/// Where it is on the globe, if that is known.
fn fix(timestamp: &str, place: &Place) -> Option<String> {
    if !place.is_on_globe() {
        return None;
    }
    let mut members = Members::default();
    members.raw("timestamp", timestamp);
    members.text("frame_id", "earth");
    members.raw("latitude", &text::degrees(place.latitude));
    members.raw("longitude", &text::degrees(place.longitude));
    members.raw("altitude", &text::number(0.0 - place.depth).unwrap_or_else(|| "0".to_string()));
    members.raw("position_covariance", "[0,0,0,0,0,0,0,0,0]");
    // Nobody knows it.
    members.raw("position_covariance_type", "0");
    Some(members.object())
}

fn reported(timestamp: &str, report: &Reported) -> String {
    let mut members = Members::default();
    members.raw("timestamp", timestamp);
    members.raw("time_s", &text::seconds(report.tick));
    members.text("name", &report.name);
    members.text("told", &report.told);
    if let Some(place) = report.place {
        members.number("north_m", place.north);
        members.number("east_m", place.east);
        if place.is_on_globe() {
            members.raw("latitude_deg", &text::degrees(place.latitude));
            members.raw("longitude_deg", &text::degrees(place.longitude));
        }
    }
    members.raw("report", &report.value.to_string());
    members.object()
}

fn log(timestamp: &str, event: &Happened) -> String {
    let level = LEVELS.iter().find(|(verb, _)| *verb == event.verb).map_or(INFO, |(_, level)| *level);
    let mut members = Members::default();
    members.raw("timestamp", timestamp);
    members.raw("level", &level.to_string());
    members.text("message", format!("{} {}", event.verb, event.text).trim_end());
    members.text("name", "albacore");
    members.text("file", "");
    members.raw("line", "0");
    members.object()
}

/// A schema as JSON Schema has it.
pub fn schema(run: &Exported, at: usize) -> String {
    let mut members = Members::default();
    members.raw("timestamp", "{\"type\":\"object\",\"title\":\"time\",\"properties\":{\"sec\":{\"type\":\"integer\"},\"nsec\":{\"type\":\"integer\"}}}");
    let of_kind = |members: &mut Members, kind: &str, names: &[&str]| {
        names.iter().for_each(|name| members.raw(name, &format!("{{\"type\":\"{kind}\"}}")));
    };
    match at {
        FIX => {
            of_kind(&mut members, "string", &["frame_id"]);
            of_kind(&mut members, "number", &["latitude", "longitude", "altitude"]);
            members.raw(
                "position_covariance",
                "{\"type\":\"array\",\"items\":{\"type\":\"number\"},\"minItems\":9,\"maxItems\":9}",
            );
            of_kind(&mut members, "integer", &["position_covariance_type"]);
        }
        LOG => {
            of_kind(&mut members, "integer", &["level"]);
            of_kind(&mut members, "string", &["message", "name", "file"]);
            of_kind(&mut members, "integer", &["line"]);
        }
        STATE => {
            of_kind(&mut members, "number", &["time_s"]);
            for (column, name) in run.columns.iter().zip(run.names_in_programs(&["time_s"])) {
                let kind = if matches!(column.values, Values::Texts(..)) { "string" } else { "number" };
                let unit = if column.unit.is_empty() { String::new() } else { format!(", {}", column.unit) };
                let what = quoted(&format!("{}{unit}", column.meaning));
                members.raw(&name, &format!("{{\"type\":\"{kind}\",\"description\":{what}}}"));
            }
        }
        _ => {
            of_kind(&mut members, "number", &["time_s", "north_m", "east_m", "latitude_deg", "longitude_deg"]);
            of_kind(&mut members, "string", &["name", "told"]);
            of_kind(&mut members, "object", &["report"]);
        }
    }
    let title = SCHEMAS.get(at).copied().unwrap_or_default();
    format!("{{\"title\":\"{title}\",\"type\":\"object\",\"properties\":{}}}", members.object())
}
