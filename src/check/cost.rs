//! `check --cost`: a table for each mission.

use crate::output;
use albacore_session::{Cost, Script, grouped as number};

/// Shares and loops beneath this many lines are summed up.
const LINES: usize = 8;

/// Tells what the missions of a script cost, but for those with other mistakes than their cost.
pub fn print(script: &Script) {
    if script.missions().next().is_none() && script.is_sound() {
        output::print("no mission stands here: what a mission costs is told with the script that it stands in\n");
    }
    for mission in script.missions().filter(|mission| script.mission_is_sound(&mission.name)) {
        if let Some(Ok(cost)) = script.cost(&mission.name) {
            output::print(&table(&mission.name, &cost));
        }
    }
}

fn table(mission: &str, cost: &Cost) -> String {
    let mut out = format!(
        "{mission}: at most {} steps a tick, {} of memory, {} instructions\n",
        number(cost.steps),
        bytes(cost.memory.bytes),
        number(cost.instructions)
    );
    let rows = cost
        .parts
        .iter()
        .map(|part| (number(part.steps), percent(part.steps, cost.steps), part.name.clone(), part.place.clone()));
    section(&mut out, "steps of the dearest tick", rows.collect());
    let rows = cost.functions.iter();
    let rows = rows.map(|part| (number(part.steps), String::new(), part.name.clone(), part.place.clone()));
    section(&mut out, "functions, the steps of a call", rows.collect());
    let rows = cost.loops.iter().map(|round| {
        let name = format!("a loop, {} rounds at most", number(round.rounds));
        (number(round.steps), String::new(), name, round.place.clone())
    });
    section(&mut out, "loops that go round within a tick", rows.collect());
    let inputs = ("inputs".to_string(), cost.memory.inputs, String::new());
    let constants = ("constants".to_string(), cost.memory.constants, String::new());
    let held = cost.memory.held.iter().map(|held| {
        let times = if held.places > 1 { format!(", in {} places", held.places) } else { String::new() };
        (format!("{}{times}", held.name), held.bytes, held.place.clone())
    });
    let mut rows: Vec<(String, u64, String)> = held.chain([inputs, constants]).collect();
    rows.sort_by_key(|row| std::cmp::Reverse(row.1));
    let rows = rows.into_iter().map(|(name, size, place)| (bytes(size), percent(size, cost.memory.bytes), name, place));
    section(&mut out, "memory", rows.collect());
    out
}

/// Lines of a figure, its share, what it is of and where that stands; the lesser ones are left out, and counted.
fn section(out: &mut String, title: &str, rows: Vec<(String, String, String, String)>) {
    if rows.is_empty() {
        return;
    }
    out.push_str(&format!("  {title}\n"));
    let shown = &rows[..rows.len().min(LINES)];
    let width = |of: fn(&(String, String, String, String)) -> &str| {
        shown.iter().map(|row| of(row).chars().count()).max().unwrap_or(0)
    };
    let (figures, names) = (width(|row| &row.0), width(|row| &row.2));
    for (figure, share, name, place) in shown {
        let line = format!("    {figure:>figures$}  {share:>4}  {name:<names$}  {place}");
        out.push_str(line.trim_end());
        out.push('\n');
    }
    if rows.len() > LINES {
        out.push_str(&format!("    and {} more\n", rows.len() - LINES));
    }
}

fn percent(part: u64, whole: u64) -> String {
    format!("{:.0} %", 100.0 * part as f64 / whole.max(1) as f64)
}

fn bytes(n: u64) -> String {
    match n {
        0..10_000 => format!("{} B", number(n)),
        10_000..10_000_000 => format!("{:.1} kB", n as f64 / 1e3),
        _ => format!("{:.1} MB", n as f64 / 1e6),
    }
}
