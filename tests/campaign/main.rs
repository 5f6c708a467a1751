//! Campaigns through the binary: the same table on any number of threads and after any interruption, never a mixed one.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

mod account;
mod changed;
mod compare;
mod deeds;
mod merge;
mod plot;
#[path = "../shell/mod.rs"]
mod shell;
mod sources;
mod sweep;

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

const BOX: &str = "missions/box.alb";

/// More seeds than a test waits for.
const FOREVER: &str = "1..3000";

/// A mission that reports under two names, one of them three times in each run, and depends on its seed.
const REPORTING: &str = r#"
mission reporting(leg: Duration = 10 s) in choppy within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
    for bearing in [0 deg, 90 deg, 180 deg] {
        steer bearing for leg
        report "turn": position
    }
    report "end, of \"all\"": position
}

scenario choppy {
    bottom(from: 20 m, to: 20 m)
    region(rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m))
    flow(10 cm/s toward 90 deg)
    plume(growth: 1e-4 m2/s)
    source("vent", at: point(north: 30 m, east: 0 m))
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
    navigation(dead_reckoning(walk: 0.1 m/s^0.5))
}
"#;

/// A mission that ends badly, for a reason that no table likes, but on which no run is lost.
const ABORTING: &str = "
mission aborting in still within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position fresh 5 s, else abort }
    with depth 3 m, speed 1 m/s
    wait for 1 s
    abort \"no, \\\"never\\\"\" on true
    wait for 1 min
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}
";

/// One that takes as long as it is told to.
const SWAPPED: &str = "
mission lasting(long: Duration = 20 s in 1 s..1 min) in still within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    steer north for long
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}
";

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaign").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn command(script: &str, seeds: &str, out: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["campaign", script, "--seeds", seeds, "--out"]).arg(out).args(more);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs a campaign that must end well; gives its table.
#[track_caller]
fn table(script: &str, seeds: &str, out: &Path, more: &[&str]) -> String {
    let output = command(script, seeds, out, more).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    std::fs::read_to_string(out).unwrap()
}

/// Runs a campaign that must not, and leave the file as it is.
#[track_caller]
fn refused(script: &str, seeds: &str, out: &Path, more: &[&str], code: i32, said: &str) {
    let before = std::fs::read(out).ok();
    let output = command(script, seeds, out, more).output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{seeds} {more:?}: {text}");
    assert!(text.contains(said), "{seeds} {more:?} should say `{said}`: {text}");
    assert_eq!(std::fs::read(out).ok(), before, "{seeds} {more:?}: the file was changed");
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Writes a script into a folder.
fn script(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// Starts a campaign that takes its time, and comes back when its table has some rows.
fn under_way(out: &Path, seeds: &str, rows: usize) -> Child {
    let child = command(BOX, seeds, out, &["--threads", "2"]).spawn().unwrap();
    for _ in 0..20_000 {
        if std::fs::read(out).is_ok_and(|text| text.iter().filter(|b| **b == b'\n').count() > rows) {
            return child;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the table does not grow: {}", stderr(&child.wait_with_output().unwrap()));
}

/// How many whole rows a table has.
fn rows(text: &str) -> usize {
    text.matches('\n').count().saturating_sub(1)
}

#[test]
fn the_box_with_three_seeds() {
    insta::assert_snapshot!(table(BOX, "1..3", &empty("box").join("box.csv"), &[]));
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let folder = empty("threads");
    let one = table(BOX, "1..40", &folder.join("one.csv"), &["--threads", "1"]);
    assert_eq!(rows(&one), 40);
    assert_eq!(one, table(BOX, "1..40", &folder.join("two.csv"), &["--threads", "2"]));
    assert_eq!(one, table(BOX, "1..<41", &folder.join("seven.csv"), &["--threads", "7"]));
    assert_eq!(one.lines().nth(7), table(BOX, "7", &folder.join("seed.csv"), &[]).lines().nth(1));
}

#[test]
fn who_kills_a_campaign_and_resumes_it_has_the_same_bytes() {
    let folder = empty("killed");
    for kept in [0, 1, 25] {
        let out = folder.join(format!("{kept}.csv"));
        let mut child = under_way(&out, FOREVER, kept);
        child.kill().unwrap();
        child.wait().unwrap();
        let prefix = std::fs::read_to_string(&out).unwrap();
        let seeds = format!("1..{}", rows(&prefix) + 5);
        let resumed = table(BOX, &seeds, &out, &["--resume"]);
        assert!(resumed.starts_with(&prefix));
        assert_eq!(resumed, table(BOX, &seeds, &folder.join(format!("{kept}-whole.csv")), &[]));
        // Once more there is nothing to do.
        assert_eq!(resumed, table(BOX, &seeds, &out, &["--resume"]));
    }
}

#[test]
fn who_interrupts_a_campaign_is_told_how_to_go_on() {
    for signal in ["-INT", "-TERM"] {
        let out = empty(&format!("interrupted{signal}")).join("box.csv");
        let child = under_way(&out, FOREVER, 5);
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{signal}: {said}");
        let text = std::fs::read_to_string(&out).unwrap();
        assert!(text.ends_with('\n'), "{signal}: the last row is torn");
        assert!(said.contains(&format!("has {} of 3000 runs", rows(&text))) && said.contains("--resume"), "{said}");
    }
}

#[test]
fn a_table_holds_one_campaign() {
    let folder = empty("one");
    let (out, other) = (folder.join("a.csv"), folder.join("b.csv"));
    let mission = script(&folder, "reporting.alb", REPORTING);
    let set = ["--resume", "--set", "leg=5s"];
    table(&mission, "1..3", &out, &[]);
    refused(&mission, "1..5", &out, &[], 2, "--resume");
    refused(&mission, "1..5", &out, &set, 2, "was begun with `no --set`, not `--set leg=5s`");
    refused(&mission, "1..5", &out, &["--resume", "--reports", "2"], 2, "has other columns");
    refused(&mission, "1..5", &out, &["--resume", "--in", "duck_2003"], 2, "the scenario `choppy`, not `duck_2003`");
    refused(BOX, "1..5", &out, &["--resume"], 2, "the mission `reporting`, not `box`");
    refused(&mission, "2..5", &out, &["--resume"], 2, "was begun with the first seed `1`, not `2`");
    refused(&mission, "1..2", &out, &["--resume"], 2, "line 4: this has seed 3");
    std::fs::copy(&out, &other).unwrap();
    refused(&mission, "1..5", &other, &["--resume"], 2, "`.origin`");
    script(&folder, "reporting.alb", &REPORTING.replace("speed 1 m/s", "speed 1.1 m/s"));
    refused(&mission, "1..5", &out, &["--resume"], 2, "reporting.alb` was changed");
}

/// A scenario of the mission's own file is the same one when it is named by that file.
#[test]
fn a_campaign_knows_its_scenario_by_either_name() {
    let folder = empty("named");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let named = ["--resume", "--in", &format!("{mission}#choppy")];
    let whole = table(&mission, "1..4", &folder.join("whole.csv"), &[]);
    let out = folder.join("a.csv");
    table(&mission, "1..2", &out, &[]);
    assert_eq!(table(&mission, "1..4", &out, &named), whole);
    let out = folder.join("b.csv");
    table(&mission, "1..2", &out, &named[1..]);
    assert_eq!(table(&mission, "1..4", &out, &["--resume"]), whole);
    // Text that another file adds is another origin.
    let other = script(&folder, "other.alb", &REPORTING.replace("mission reporting", "mission other"));
    refused(&mission, "1..4", &out, &["--resume", "--in", &format!("{other}#choppy")], 2, "was begun");
}

#[test]
fn no_two_columns_have_one_name() {
    let folder = empty("columns");
    let report = "report \"=1\": position\n    report \"'=1\": position\n    report \"a b\": position";
    let mission =
        script(&folder, "columns.alb", &REPORTING.replace("report \"end, of \\\"all\\\"\": position", report));
    let table = table(&mission, "1", &folder.join("t.csv"), &[]);
    let mut names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let fixed_reports_and_recovery = 19 + 4 * 4 + 2;
    assert_eq!(names.len(), fixed_reports_and_recovery, "{names:?}");
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), fixed_reports_and_recovery, "{names:?}");
}

#[test]
fn two_campaigns_do_not_write_one_table() {
    let out = empty("two").join("box.csv");
    let mut child = under_way(&out, FOREVER, 1);
    let output = command(BOX, "1..3000", &out, &["--resume"]).output().unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("another campaign is writing"), "{}", stderr(&output));
}

#[test]
fn further_reports_have_columns_of_their_own() {
    let folder = empty("reports");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let out = folder.join("all.csv");
    let output = command(&mission, "1..2", &out, &["--reports", "3", "--json"]).output().unwrap();
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    insta::assert_snapshot!(std::fs::read_to_string(out).unwrap());
    // With fewer columns it is said that there were more.
    let output = command(&mission, "1..2", &folder.join("few.csv"), &[]).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let said = "warning: 2 of 2 runs reported more often than the table has columns for";
    assert!(stderr(&output).contains(said), "{}", stderr(&output));
}

#[test]
fn the_summary_is_of_all_rows() {
    let folder = empty("summary");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let out = folder.join("table.csv");
    table(&mission, "1..2", &out, &[]);
    let output = command(&mission, "1..8", &out, &["--resume", "--json"]).output().unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&summary["runs"], &summary["outcomes"]["completed"]), (&8.into(), &8.into()));
    assert_eq!((&summary["reported"]["count"], &summary["within"][1]["m"]), (&8.into(), &30.0.into()));
    assert!(summary["error_m"]["median"].as_f64().unwrap() <= summary["error_m"]["p90"].as_f64().unwrap());
    let text = String::from_utf8(command(&mission, "1..8", &out, &["--resume"]).output().unwrap().stdout).unwrap();
    assert!(text.contains("reporting in choppy, seeds 1..8: 8 completed"), "{text}");
    assert!(text.contains("reported      8 of 8: 100.0 % (67.6 to 100.0)"), "{text}");
}

#[test]
fn runs_that_end_badly_are_rows_too() {
    let folder = empty("badly");
    let mission = script(&folder, "aborting.alb", ABORTING);
    let text = table(&mission, "0..1", &folder.join("table.csv"), &[]);
    let row = text.lines().nth(1).unwrap();
    assert!(row.starts_with(r#"still,0,aborted,,"no, ""never""",,,"#), "{row}");
}

#[test]
fn what_cannot_be_is_said_before_a_file_is_begun() {
    let folder = empty("usage");
    let out = folder.join("table.csv");
    for seeds in ["3..1", "5..<5", "1-3", "", "1..", "one", "1..2000000", "18446744073709551616"] {
        refused(BOX, seeds, &out, &[], 2, "--seeds");
    }
    refused(BOX, "1", &out, &["--threads", "0"], 2, "--threads");
    refused(BOX, "1", &out, &["--in", "tidal_steam"], 2, "did you mean `tidal_stream`?");
    refused("missions/bix.alb", "1", &out, &[], 2, "did you mean `missions/box.alb`?");
    refused("tests/diagnostics/ten_mistakes.alb", "1", &out, &[], 3, "10 errors");
    refused("missions/duck_single.alb", "1", &out, &["--in", "tidal_steam"], 2, "tidal_steam");
    assert!(std::fs::read_dir(&folder).unwrap().next().is_none());
}

#[test]
fn a_disk_that_fails_is_said_at_once() {
    refused(BOX, "1..3", Path::new("Cargo.toml/table.csv"), &[], 4, "`Cargo.toml/table.csv` cannot be written");
    refused(
        BOX,
        "1..3",
        Path::new("Cargo.toml/table.csv"),
        &["--resume"],
        4,
        "`Cargo.toml/table.csv` cannot be written",
    );
    refused(BOX, "1..3", &empty("nowhere").join("no/table.csv"), &[], 4, "cannot be written");
    let folder = empty("folder");
    let output = command(BOX, "1", &folder, &["--resume"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("no ordinary file"), "{}", stderr(&output));
}

#[test]
fn a_disk_that_is_full_leaves_rows_that_can_be_gone_on_with() {
    let folder = empty("full");
    let whole = table(BOX, "1..100", &folder.join("whole.csv"), &[]);
    for blocks in [3, 4, 5] {
        let out = folder.join(format!("table-{blocks}.csv"));
        let limit = format!("trap '' XFSZ; ulimit -f {blocks}");
        let output = shell::behind(&limit, &command(BOX, "1..100", &out, &[])).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{said}");
        assert_eq!(said.matches("error: ").count(), 1, "{said}");
        assert!(said.contains(".csv` cannot be written: ") && said.contains("--resume"), "{said}");
        // A row that is cut looks real, and what it says is wrong.
        let left = std::fs::read_to_string(&out).unwrap();
        assert!(rows(&left) > 1 && left.ends_with('\n') && whole.starts_with(&left), "{left}");
        assert_eq!(table(BOX, "1..100", &out, &["--resume"]), whole);
    }
}

#[test]
fn a_closed_pipe_is_silent() {
    let out = empty("pipe").join("table.csv");
    let mut child = command(BOX, "1..3", &out, &["--json"]).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    assert_eq!(output.status.code(), Some(0));
}
