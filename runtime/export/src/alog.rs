//! A log as MOOS writes it (`.alog`): a line for each value that came, with its time, its variable, who wrote it and what it is. Angles
//! are degrees clockwise from north, as MOOS has them; `NAV_X` is east and `NAV_Y` north.

use crate::csv::told;
use crate::exported::{Column, Exported, Place, Reported, Role, Values, name_in_programs};
use crate::text;
use albacore_program::calendar;
use std::fmt::Write;

/// Who writes every line.
const SOURCE: &str = "albacore";
/// The lines about the head have so many `%`.
const RULE: usize = 56;

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut out = head(run);
    let names: Vec<String> = run.columns.iter().map(variable).collect();
    // What holds until it changes is told when it does.
    let mut latest: Vec<Option<String>> = vec![None; names.len()];
    run.each_moment(|moment| {
        let time = text::seconds(moment.tick);
        let mut tell = |name: &str, value: &str| {
            // Memory takes everything.
            let _ = writeln!(out, "{time:<15} {name:<24} {SOURCE:<12} {value}");
        };
        for (at, column) in run.columns.iter().enumerate() {
            let Some(value) = moment.row.and_then(|row| value(column, row)) else { continue };
            let holds = matches!(column.values, Values::Texts(..));
            if !holds || latest[at].as_ref() != Some(&value) {
                tell(&names[at], &value);
            }
            latest[at] = Some(value).filter(|_| holds);
        }
        for report in moment.reports {
            tell("REPORT", &told(report));
            if let Some(point) = view_point(report) {
                tell("VIEW_POINT", &point);
            }
        }
        moment.events.iter().for_each(|event| tell("EVENT", format!("{} {}", event.verb, event.text).trim_end()));
    });
    out.into_bytes()
}

fn head(run: &Exported) -> String {
    let rule = "%".repeat(RULE);
    let (opened, began) = (text::moment(run.about.moment_ms(0)), run.about.moment_ms(0));
    let start = format!("{}.{:03}", began.div_euclid(1000), began.rem_euclid(1000));
    let facts: String = run.about.facts().iter().map(|(name, fact)| format!("%% {name}: {fact}\n")).collect();
    format!(
        "{rule}\n%% LOG FILE:       track.alog\n%% FILE OPENED ON  {opened}\n%% LOGSTART           {start}\n{facts}{rule}\n"
    )
}

/// The variable of a column: what MOOS calls it, else its own name in capitals.
fn variable(column: &Column) -> String {
    match column.role {
        Some(Role::East) => "NAV_X",
        Some(Role::North) => "NAV_Y",
        Some(Role::Latitude) => "NAV_LAT",
        Some(Role::Longitude) => "NAV_LONG",
        Some(Role::Depth) => "NAV_DEPTH",
        Some(Role::Altitude) => "NAV_ALTITUDE",
        Some(Role::Heading) => "NAV_HEADING",
        Some(Role::Speed) => "NAV_SPEED",
        Some(Role::CommandedHeading) => "DESIRED_HEADING",
        Some(Role::CommandedSpeed) => "DESIRED_SPEED",
        Some(Role::CommandedDepth) => "DESIRED_DEPTH",
        Some(Role::CommandedAltitude) => "DESIRED_ALTITUDE",
        Some(Role::Behavior) => "MODE",
        None => return name_in_programs(&column.name).to_ascii_uppercase(),
    }
    .to_string()
}

fn value(column: &Column, row: usize) -> Option<String> {
    match (&column.values, column.role) {
        (Values::Texts(..), Some(Role::Behavior)) => column.values.text(row).map(|chain| chain.replace(" > ", ":")),
        (Values::Texts(..), _) => column.values.text(row).map(str::to_string),
        (Values::Dates(_), _) => column.values.number(row).map(calendar::written_to_tenths),
        (_, Some(Role::Latitude | Role::Longitude)) => column.values.number(row).map(text::degrees),
        _ => column.values.number(row).and_then(text::number),
    }
}

/// A report as a viewer draws it.
fn view_point(report: &Reported) -> Option<String> {
    let Place { north, east, .. } = report.place?;
    Some(format!("x={},y={},label={}", text::number(east)?, text::number(north)?, name_in_programs(&report.name)))
}
