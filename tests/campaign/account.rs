//! What the table tells of a run beside its outcome: what the strategy finished with, where that was and how far off along and across the
//! flow, how long each behavior took, how often the mission was held; and the misses with the command that runs one.

use crate::{command, empty, script, table};
use std::collections::BTreeMap;

/// Goes east for a while, and finds a place, nothing, or no end, as it is told to.
pub const SEEKING: &str = r#"
enum Luck { good, bad, none_yet }

strategy seek(luck: Luck) -> Point? {
    behavior look { steer east }
    behavior ponder { hold for 3 s }
    start look
    look   -> ponder         on after 10 s
    ponder -> finish position on done and luck == good
    ponder -> finish none    on done and luck == bad
    ponder -> look           on done
}

mission seeking(luck: Luck = good) in stream within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position fresh 5 s, else hold for 1 min then abort; course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
    let found = seek(luck) within 1 min
    if found { report "vent": found }
}

scenario stream {
    bottom(from: 20 m, to: 20 m)
    region(rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m))
    flow(10 cm/s toward 90 deg)
    plume(growth: 1e-4 m2/s)
    source("vent", at: point(north: 60 m, east: 5 m))
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m, heading: 90 deg)
}
"#;

/// The first row of a table, by the names of its columns.
fn row(text: &str) -> BTreeMap<String, String> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    names.iter().zip(&row).map(|(name, cell)| (name.to_string(), cell.to_string())).collect()
}

#[test]
fn a_table_tells_what_was_found_where_and_in_what_time() {
    let folder = empty("account");
    let mission = script(&folder, "seeking.alb", SEEKING);
    let row = row(&table(&mission, "1", &folder.join("t.csv"), &[]));
    let number = |name: &str| row[name].parse::<f64>().unwrap();
    assert_eq!((row["outcome"].as_str(), row["result"].as_str(), row["holds"].as_str()), ("completed", "place", "0"));
    assert_eq!((number("true_north_m"), number("true_east_m")), (60.0, 5.0));
    assert_eq!(row["declared_east_m"], row["vent_east_m"]);
    // The flow goes east: what lies east of the source lies down-flow, what lies south of it to the right.
    let (along, across) = (number("declared_east_m") - 5.0, 60.0 - number("declared_north_m"));
    assert!(
        (number("error_along_m") - along).abs() < 2e-3 && (number("error_across_m") - across).abs() < 2e-3,
        "{row:?}"
    );
    assert!((number("error_m") - (along * along + across * across).sqrt()).abs() < 2e-3, "{row:?}");
    // What a strategy calls counts for both.
    assert_eq!((number("look_s"), number("ponder_s"), number("seek_s")), (10.0, 3.0, 13.0));
    assert!(
        (number("look_m") + number("ponder_m") - number("seek_m")).abs() < 0.5 && number("look_m") > 8.0,
        "{row:?}"
    );
    assert_eq!((row["recovery_s"].as_str(), row["recovery_m"].as_str()), ("0.0", "0.000"));
}

/// A behavior within one of its name is active once, what a table's behavior calls is a result, and a quantity is a number.
#[test]
fn what_is_called_within_counts_once_and_tells() {
    let folder = empty("account_within");
    let nested = r#"
behavior look(deep: Bool) { steer east for 4 s; if deep { inner.look() } }
behavior measured() -> Length { look(true); finish -3.25 m }
mission nested in calm within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
    behavior survey {
        let deep = measured()
        log "{deep}"
    }
    start survey
    survey -> finish on done
}
"#;
    script(&folder, "inner.alb", "behavior look() { steer south for 2 s }\n");
    let mission = script(&folder, "nested.alb", &format!("use inner\n{nested}"));
    let row = row(&table(&mission, "1", &folder.join("t.csv"), &[]));
    let number = |name: &str| row[name].parse::<f64>().unwrap();
    assert_eq!((number("look_s"), row["result"].as_str()), (6.0, "-3.25"), "{row:?}");
}

#[test]
fn what_is_declared_is_the_first_place_that_is_reported() {
    let folder = empty("account_first_place");
    let found = "if found { report \"vent\": found }";
    let with_a_count = SEEKING.replace(found, &format!("report \"looks\": 1; {found}"));
    let mission = script(&folder, "seeking.alb", &with_a_count);
    let row = row(&table(&mission, "1", &folder.join("t.csv"), &[]));
    assert_eq!((&row["declared_east_m"], &row["error_m"]), (&row["vent_east_m"], &row["vent_error_m"]));
    assert!(!row["error_m"].is_empty(), "{row:?}");
    let row = self::row(&table(&mission, "1", &folder.join("u.csv"), &["--set", "luck=bad"]));
    assert_eq!([&row["report_t_s"], &row["error_m"], &row["reports"], &row["looks"]], ["", "", "1", "1"]);
}

#[test]
fn what_is_called_a_source_is_declared_whatever_is_reported_before() {
    let folder = empty("account_source");
    let found = "if found { report \"vent\": found }";
    let both = SEEKING.replace(found, "report \"corner\": op.center; if found { report \"source\": found }");
    let mission = script(&folder, "seeking.alb", &both);
    let row = row(&table(&mission, "1", &folder.join("t.csv"), &[]));
    assert_eq!((&row["declared_east_m"], &row["error_m"]), (&row["source_east_m"], &row["source_error_m"]));
    let row = self::row(&table(&mission, "1", &folder.join("u.csv"), &["--set", "luck=bad"]));
    assert_eq!((row["error_m"].as_str(), row["reports"].as_str()), ("", "1"), "a corner is no source");
}

#[test]
fn of_a_mission_that_reports_no_place_nothing_is_said_to_be_far_off() {
    let folder = empty("account_no_place");
    let found = "if found { report \"vent\": found }";
    for (name, report, is_told) in [("number", "report \"looks\": 1", false), ("place", found, true)] {
        let mission = script(&folder, "seeking.alb", &SEEKING.replace(found, report));
        let out = folder.join(format!("{name}.csv"));
        let text = String::from_utf8(command(&mission, "1..2", &out, &[]).output().unwrap().stdout).unwrap();
        assert_eq!(text.contains("within 15 m"), is_told, "{text}");
    }
}

#[test]
fn what_was_not_found_is_told_from_what_was_cut_off() {
    let folder = empty("account_missed");
    let mission = script(&folder, "seeking.alb", SEEKING);
    for (luck, result) in [("bad", "none"), ("none_yet", "timed_out")] {
        let out = folder.join(format!("{luck}.csv"));
        let row = row(&table(&mission, "1", &out, &["--set", &format!("luck={luck}")]));
        let told = ["outcome", "result", "report_t_s", "true_north_m"].map(|name| row[name].as_str());
        assert_eq!(told, ["completed", result, "", ""]);
    }
    // One that is held, and one that is aborted after it.
    let out = folder.join("held.csv");
    let held = "fault(position, off, from: 5 s, to: 15 s)";
    let row = row(&table(&mission, "1", &out, &["--fault", held]));
    assert_eq!((row["holds"].as_str(), row["result"].as_str()), ("1", "place"));
}

#[test]
fn misses_are_listed_by_cause_with_a_command_that_runs_one() {
    let folder = empty("account_causes");
    let mission = script(&folder, "seeking.alb", SEEKING);
    let more = ["--set", "luck=bad", "--fault", "fault(leak, from: 10 min)", "--json"];
    let output = command(&mission, "1..7", &folder.join("t.csv"), &more).output().unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let run = format!("albacore run {mission} --set luck=bad --fault 'fault(leak, from: 10 min)' --seed 1");
    assert_eq!(
        summary["missed"],
        serde_json::json!([{ "why": "nothing declared: none", "count": 7, "seeds": [1, 2, 3, 4, 5], "command": run }])
    );
    assert_eq!(summary["results"], serde_json::json!({ "none": 7 }));
    let text = String::from_utf8(command(&mission, "1..7", &folder.join("u.csv"), &more[..2]).output().unwrap().stdout)
        .unwrap();
    assert!(text.contains("  missed        7, nothing declared: none: seeds 1, 2, 3, 4, 5, …\n"), "{text}");
    assert!(text.contains(&format!("                albacore run {mission} --set luck=bad --seed 1\n")), "{text}");
    // North of it by 60 m.
    let text =
        String::from_utf8(command(&mission, "1..2", &folder.join("v.csv"), &[]).output().unwrap().stdout).unwrap();
    assert!(text.contains("  missed        2, more than 50 m off: seeds 1, 2\n"), "{text}");
    assert!(text.contains("  result        2 place\n"), "{text}");
}
