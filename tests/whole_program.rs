//! The binary as a person or a script uses it: one run, one result, one exit code for each way it can go.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use std::process::{Command, Output, Stdio};

const BOX: &str = "missions/box.alb";

/// Runs the binary at the root of the repository.
fn albacore(args: &[&str]) -> Output {
    command(args).output().unwrap()
}

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1").stdin(Stdio::null());
    command
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
fn ends_with(args: &[&str], code: i32, said: &str) {
    let output = albacore(args);
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {text}");
    assert!(text.contains(said), "{args:?} should say `{said}`: {text}");
}

#[test]
fn a_run_gives_one_json_object_with_the_fixed_fields() {
    let output = albacore(&["run", BOX, "--json", "--no-out"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let names = |value: &serde_json::Value| {
        let mut names: Vec<String> = value.as_object().unwrap().keys().cloned().collect();
        names.sort();
        names
    };
    assert_eq!(
        names(&result),
        [
            "behaviors",
            "digest",
            "holds",
            "mission",
            "origin",
            "outcome",
            "path_length_m",
            "reason",
            "reports",
            "result",
            "scenario",
            "seed",
            "sim_time_s",
            "switches",
            "ticks",
            "wall_s"
        ]
    );
    assert_eq!(
        names(&result["reports"][0]),
        [
            "east_m",
            "error_across_m",
            "error_along_m",
            "error_m",
            "labelled",
            "latitude_deg",
            "longitude_deg",
            "name",
            "north_m",
            "t_s",
            "true_east_m",
            "true_north_m",
            "true_surface_m2",
            "value"
        ]
    );
    assert_eq!((&result["mission"], &result["outcome"]), (&"box".into(), &"completed".into()));
    assert_eq!((&result["seed"], &result["switches"], &result["holds"]), (&1.into(), &2.into(), &0.into()));
    assert_eq!(names(&result["behaviors"][0]), ["entered", "name", "path_length_m", "time_s"]);
    assert_eq!(names(&result["result"]), ["end", "of", "value", "word"]);
}

#[test]
fn what_is_reported_is_told_whole() {
    let output = albacore(&["run", "tests/whole_program/reported.alb", "--json", "--no-out"]);
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    insta::assert_snapshot!(serde_json::to_string_pretty(&result["reports"]).unwrap());
}

#[test]
fn a_good_run_ends_with_0() {
    ends_with(&["run", BOX, "--no-out"], 0, "");
    ends_with(&["check", BOX], 0, "");
}

#[test]
fn a_mission_that_does_not_end_well_ends_with_1() {
    ends_with(&["run", "tests/rules/17_time_limit.alb", "--no-out"], 1, "");
    ends_with(&["run", "tests/rules/11_abort.alb", "--no-out"], 1, "");
}

/// An attack: 9 of these 60 runs were aborted for want of a fresh position.
#[test]
fn satellite_fixes_that_scatter_end_no_mission() {
    ends_with(&["test", "tests/whole_program/fixes_that_scatter.alb"], 0, "");
}

#[test]
fn a_vehicle_that_leaves_in_the_recovery_is_told_as_that() {
    let output = albacore(&["run", "tests/whole_program/left_in_recovery.alb", "--json", "--no-out"]);
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let ended = (&result["outcome"], &result["reason"]);
    assert_eq!(ended, (&"released_by_vehicle".into(), &"in the recovery after an abort: enough".into()));
}

#[test]
fn wrong_usage_ends_with_2() {
    ends_with(&["run", "missions/bix.alb"], 2, "did you mean `missions/box.alb`?");
    ends_with(&["check", "missions/bix.alb"], 2, "did you mean `missions/box.alb`?");
    ends_with(&["run", "nowhere/box.alb"], 2, "there is no folder `nowhere`");
    ends_with(&["run", "missions"], 2, "`missions` is a folder");
    ends_with(&["run", BOX, "--mission", "bax"], 2, "did you mean `box`?");
    ends_with(&["run", BOX, "--in", "tidal_steam"], 2, "did you mean `tidal_stream`?");
    ends_with(&["run", BOX, "--speed", "2"], 2, "--speed");
    ends_with(&["rum", BOX], 2, "run");
}

#[test]
fn a_broken_script_ends_with_3() {
    ends_with(&["run", "tests/diagnostics/ten_mistakes.alb", "--no-out"], 3, "10 errors");
    ends_with(&["check", "tests/diagnostics/ten_mistakes.alb"], 3, "10 errors");
}

#[test]
fn a_closed_pipe_is_silent() {
    for args in [&["run", BOX, "--json", "--no-out"][..], &["run", BOX, "--no-out"], &["--help"]] {
        let mut child = command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.stderr.is_empty(), "{args:?}: {}", stderr(&output));
        assert_eq!(output.status.code(), Some(0), "{args:?}");
    }
}

#[test]
fn a_scenario_of_another_file_is_named_with_its_file() {
    let output = albacore(&["run", BOX, "--in", "missions/box.alb#tidal_stream", "--no-out"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    ends_with(
        &["run", BOX, "--in", "missions/bax.alb#tidal_stream", "--no-out"],
        2,
        "there is no file `missions/bax.alb`",
    );
    ends_with(&["run", BOX, "--in", "missions/box.alb#tidal_steam", "--no-out"], 2, "did you mean `tidal_stream`?");
}

/// A device that never ends.
#[cfg(target_os = "linux")]
#[test]
fn standard_input_has_a_bound() {
    for (args, code, said) in
        [(&["fmt", "-"][..], 2, "standard input is larger than"), (&["repl"], 3, "is longer than")]
    {
        let zeros = std::fs::File::open("/dev/zero").unwrap();
        let output = command(args).stdin(zeros).stdout(Stdio::null()).output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
}

/// A device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn a_result_that_cannot_be_written_is_said_and_a_failure() {
    let verbs = [&["run", BOX, "--no-out"][..], &["run", BOX, "--no-out", "--json"], &["test", BOX]];
    let others = [&["graph", "cpt", "cpt_2005"][..], &["--help"], &["--version"], &["run", "--help"]];
    for args in verbs.into_iter().chain(others) {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(args).stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(4), "{args:?}: {}", stderr(&output));
        assert_eq!(stderr(&output).matches("cannot be written to standard output").count(), 1, "{args:?}");
    }
}

/// What is no seed and no rate is told as such, a negative number too.
#[test]
fn seeds_and_rates_say_what_they_are() {
    let seed = "a seed is a whole number from 0 on, such as `7`";
    for (args, expected) in [
        (["--seed", "-1"], seed),
        (["--seed", "1.5"], seed),
        (["--seed", "-1.5"], seed),
        (["--rate", "-1"], "write a number from 0.1 to 1000"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
            .args(["run", "missions/duck_single.alb"])
            .args(args)
            .stdin(Stdio::null())
            .output()
            .unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && told.contains(expected), "{args:?}: {told}");
    }
}
