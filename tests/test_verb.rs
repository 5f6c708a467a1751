//! `albacore test`: what it says, writes and ends with, for each way a test can go.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

mod accepting;
mod whole;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// North for a while, and a test of it; `SECONDS` and `METRES` are for each test to choose.
const SCRIPT: &str = r#"
mission north in still within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    steer 0 deg for SECONDS
    report "there": position
    report "seconds": SECONDS
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}

test "goes north" {
    run north in still seeds 1..4
    expect in 75 % of runs: distance(reported("there"), point(north: 10 m, east: 0 m)) < METRES
    expect has_reported("there") and has_reported("seconds")
    expect always north.op.gap(truth.position) > 0 m
    snapshot switches of seed 2
}
"#;

/// A script in an empty folder of a test's own.
struct Project(PathBuf);

impl Project {
    fn new(name: &str, seconds: &str, metres: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("test-verb-{name}"));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let project = Project(folder);
        project.write(seconds, metres);
        project
    }

    fn write(&self, seconds: &str, metres: &str) {
        std::fs::write(self.0.join("north.alb"), SCRIPT.replace("SECONDS", seconds).replace("METRES", metres)).unwrap();
    }

    fn snapshot(&self) -> Option<String> {
        std::fs::read_to_string(self.0.join("snapshots/north-goes_north-2.trace")).ok()
    }

    /// What `albacore test` ends with, prints and says.
    fn test(&self, more: &[&str]) -> (Option<i32>, String) {
        self.test_with(&[], more)
    }

    /// The same with variables of the environment.
    fn test_with(&self, variables: &[(&str, &str)], more: &[&str]) -> (Option<i32>, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.arg("test").arg(&self.0).args(more).env("NO_COLOR", "1").envs(variables.iter().copied());
        // What is kept of runs goes there.
        command.stdin(Stdio::null()).current_dir(&self.0);
        let output = command.output().unwrap();
        let said = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8_lossy(&said).replace(&self.0.display().to_string(), "."))
    }
}

#[test]
fn a_test_without_its_snapshot_fails_and_writes_none() {
    let project = Project::new("missing", "10 s", "5 m");
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
    assert_eq!(project.snapshot(), None);
}

#[test]
fn a_changed_behavior_is_shown_and_the_snapshot_kept() {
    let project = Project::new("changed", "10 s", "5 m");
    project.test(&["--accept"]);
    let accepted = project.snapshot();
    project.write("11 s", "5 m");
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
    assert_eq!(project.snapshot(), accepted);
}

#[test]
fn an_expectation_that_fails_says_where_how_often_and_what_was_found() {
    let project = Project::new("fails", "10 s", "5 m");
    project.test(&["--accept"]);
    project.write("10 s", "10 cm");
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
}

#[test]
fn tests_are_run_with_what_goes_wrong_and_without_their_snapshots() {
    let project = Project::new("faults", "10 s", "5 m");
    // Without a snapshot, and with one that is of a run without the fault.
    for accept in [false, true] {
        if accept {
            project.test(&["--accept"]);
        }
        let (code, said) = project.test(&["--fault", "compass, off"]);
        assert_eq!((code, said.contains("takes no `compass`")), (Some(3), true), "{said}");
        let (code, said) = project.test(&["--fault", "fault(heading, stuck, from: 1 s)"]);
        assert_eq!((code, said.contains("1 passed, 0 failed")), (Some(0), true), "{said}");
        let (code, said) = project.test(&["--fault", "strong_current(1 m/s toward 90 deg)"]);
        assert_eq!((code, said.contains("held in 0 of 4 runs, 75 % wanted")), (Some(1), true), "{said}");
        assert!(!said.contains("snapshot"), "{said}");
    }
    // One that expects nothing is held to nothing.
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    let silent: String =
        script.lines().filter(|line| !line.trim().starts_with("expect ")).map(|l| format!("{l}\n")).collect();
    assert!(silent.len() < script.len() && silent.contains("snapshot"), "{silent}");
    std::fs::write(project.0.join("north.alb"), silent).unwrap();
    let (code, said) = project.test(&["--fault", "fault(heading, stuck, from: 1 s)"]);
    assert_eq!((code, said.contains("0 passed, 0 failed, 1 left out")), (Some(2), true), "{said}");
    assert!(said.contains("it expects nothing") && said.contains("nothing was tested"), "{said}");
    assert_eq!(project.test(&[]).0, Some(0));
    let accepted = project.snapshot();
    let (code, said) = project.test(&["--accept", "--fault", "leak"]);
    assert_eq!((code, said.contains("cannot be used with")), (Some(2), true), "{said}");
    assert_eq!(project.snapshot(), accepted);
}

#[test]
fn what_was_to_go_wrong_after_the_end_is_told() {
    let project = Project::new("never", "10 s", "5 m");
    let verb = |words: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.args(words).current_dir(&project.0).stdin(Stdio::null()).env("NO_COLOR", "1");
        String::from_utf8(command.output().unwrap().stderr).unwrap()
    };
    let never = "warning: `leak` never began: from";
    // The last tick that the mission lives is that of 10.1 s.
    for (from, begins) in [("10.1 s", true), ("10.2 s", false), ("1 h", false)] {
        let fault = format!("leak, from: {from}");
        let said = verb(&["run", "north.alb", "--no-out", "--fault", &fault]);
        assert_eq!(said.contains(never), !begins, "{said}");
        assert_eq!(said.contains("vehicle: fault: leak"), begins, "{said}");
        let (code, said) = project.test(&["--filter", "goes", "--fault", &fault]);
        assert_eq!(said.contains("1 left out") && code == Some(2), !begins, "{said}");
        assert_eq!(said.contains("its runs are over before anything of `--fault` begins"), !begins, "{said}");
    }
    let said = verb(&["campaign", "north.alb", "--seeds", "1..3", "--out", "t.csv", "--fault", "leak, from: 1 h"]);
    assert_eq!(said.matches(never).count(), 1, "{said}");
    assert!(said.contains("from 3600 s, and the mission lasted 10.2 s"), "{said}");
}

#[test]
fn a_filter_that_leaves_nothing_says_so() {
    let project = Project::new("filter", "10 s", "5 m");
    let (code, said) = project.test(&["--filter", "south"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("no test's name contains `south`"), "{said}");
    project.test(&["--accept"]);
    let (code, said) = project.test(&["--filter", "north"]);
    assert_eq!(code, Some(0), "{said}");
}

/// What only the simulator knows: tests may ask for it, of what was reported and of what it told them before.
const TRUTHS: &str = r#"
mission north in pitted within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    steer 0 deg for 60 s
    report "there": position
    if op.gap(position) < -1 km { report "nowhere": position }
}

scenario pitted {
    bottom(from: 10 m, to: 10 m)
    pit("one", at: point(north: 58 m, east: 3 m), depth: 2 m, radius: 20 m)
    pit("deeper, and not in the area", at: point(north: 500 m, east: 3 m), depth: 5 m, radius: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m, spread: 5 m)
}

test "truths" {
    run north in pitted seeds 1..4
    expect distance(truth.start, point(north: 0 m, east: 0 m)) < 5 m
    expect distance(truth.deepest, point(north: 58 m, east: 3 m)) < 10 cm
    expect truth.depth_at(truth.deepest) > 11.99 m and truth.depth_at(truth.deepest + 20 m toward east) < 11.3 m
    expect truth.depth_at(reported("there")) > 95 % * truth.depth_at(truth.deepest)
    expect truth.depth_at(truth.deepest + 10 * truth.depth_at(truth.deepest) toward east) < 10.01 m
    expect always truth.depth_at(truth.position) > 9.9 m
    expect truth.depth_at(reported("nowhere")) > 0 m
    expect truth.depth_at(truth.start) > 11 m
}
"#;

#[test]
fn what_is_true_can_be_asked_for() {
    let project = Project::new("truths", "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), TRUTHS).unwrap();
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
}

/// Each expectation holds, or does not, as its test is called.
const REPORTS: &str = r#"
mission north(far: Bool = true) in still within 31 s {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    abort "too far" on distance(position, op.center) > 1 km
    steer 0 deg for 30 s
    if far { report "fix": position }
    report "all": 3 m
    if far { abort "as it was told" }
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}

test "holds" {
    run north in still seeds 1..2
    expect has_reported("fix") and reported_at("fix") > 29 s
    expect reported_at("fix") > 29 s and reported_at("fix") == reported_at("all")
    expect not has_reported("fix") or distance(reported("fix"), point(north: 28 m, east: 0 m)) < 2 m
    expect if has_reported("fix") { reported_at("fix") < 31 s } else { completed }
    expect always not has_reported("fix") or reported_at("fix") < time + 1 s
    expect has_reported("all") and has_reported("fix") and has_reported("fix") and reported_at("fix") > 29 s
}

test "holds without a report" {
    run north(far: false) in still seeds 1..2
    expect not has_reported("fix") or distance(reported("fix"), point(north: 0 m, east: 0 m)) > 3 km
    expect has_reported("all") and (not has_reported("fix") or reported_at("fix") > 10 min)
}

test "fails each time" {
    run north in still seeds 1..2
    expect has_reported("fix") and reported_at("fix") < 5 s
    expect not has_reported("fix") or reported_at("fix") < 5 s
    expect completed
    expect distance(reported("fix"), truth.nearest_source) < 30 m
    expect distance(reported("fix"), truth.deepest) < 30 m
    expect always reported_at("fix") > 29 s
}

test "fails without a report" {
    run north(far: false) in still seeds 1..2
    expect reported_at("fix") > 0 s
    expect not (distance(reported("fix"), point(north: 0 m, east: 0 m)) < 3 m)
    expect not completed
}
"#;

/// The last report of a name, how many there were, how the mission ended, and a source by its name.
const ENDINGS: &str = r#"
mission north(lasting: Duration = 35 s) in dyed within 1 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { depth <= 10 m, speed <= 2.5 m/s }
    requires { position, heading fresh 5 s, else abort }
    recovery within 10 s { wait }
    with depth 3 m, speed 1.5 m/s
    on every 10 s { report "tick": position }
    abort "for long enough" on after lasting
    steer north
}

scenario dyed = still_water with {
    region(rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m))
    flow(10 cm/s toward 90 deg)
    plume()
    source("north", at: point(north: 100 m, east: 0 m))
}

test "holds" {
    run north in dyed seeds 1..2
    expect aborted and not completed and not timed_out
    expect times_reported("tick") == 3
    expect last_reported_at("tick") > 30 s and last_reported_at("tick") < 31 s
    expect distance(last_reported("tick"), reported("tick")) > 25 m
    expect has_reported("tick") and last_reported("tick").north > reported("tick").north
    expect always times_reported("tick") <= 3
    expect truth.source("north").north == 100 m
}

test "holds at the end of its time" {
    run north(lasting: 2 min) in dyed seeds 1..2
    expect timed_out and not aborted
}

test "fails" {
    run north in dyed seeds 1..2
    expect completed and time > 1 s
    expect timed_out or aground
    expect truth.source("south").north == 100 m
    expect times_reported("tick") == 4
}
"#;

#[test]
fn how_it_ended_and_what_was_reported_last_can_be_asked_for() {
    let project = Project::new("endings", "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), ENDINGS).unwrap();
    let (code, said) = project.test(&["--filter", "holds"]);
    assert_eq!((code, said.contains("2 passed, 0 failed")), (Some(0), true), "{said}");
    let (code, said) = project.test(&["--filter", "fails"]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
}

/// What `albacore test` says of the tests of a script that fail, beside so many that hold.
fn failed_beside(name: &str, script: &str, holding: usize) -> String {
    let project = Project::new(name, "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), script).unwrap();
    let (code, said) = project.test(&["--filter", "holds"]);
    assert_eq!((code, said.contains(&format!("{holding} passed, 0 failed"))), (Some(0), true), "{said}");
    let (code, said) = project.test(&["--filter", "fails"]);
    assert_eq!(code, Some(1), "{said}");
    said
}

#[test]
fn what_holds_while_a_behavior_is_active_is_looked_at_then_alone() {
    insta::assert_snapshot!(failed_beside("while", include_str!("test_verb/while_active.alb"), 2));
}

#[test]
fn how_the_vehicle_truly_moves_is_held_to_tolerances() {
    insta::assert_snapshot!(failed_beside("control", include_str!("test_verb/control.alb"), 1));
}

#[test]
fn the_water_is_asked_for_without_an_instrument() {
    insta::assert_snapshot!(failed_beside("water", include_str!("test_verb/water.alb"), 1));
}

/// A behavior that is entered where another is given it was said never to be, and a list of records with a text could not be counted.
#[test]
fn behaviors_that_are_given_are_known_and_so_are_records_with_texts() {
    insta::assert_snapshot!(failed_beside("given", include_str!("test_verb/given.alb"), 1));
}

/// `refused` was the outcome of the run beside the end of a question too, and could not be compared with it.
#[test]
fn variants_are_meant_beside_a_value_that_can_be_one() {
    insta::assert_snapshot!(failed_beside("outcomes", include_str!("test_verb/outcomes.alb"), 1));
}

#[test]
fn why_a_mission_was_aborted_can_be_asked_for() {
    insta::assert_snapshot!(failed_beside("reasons", include_str!("test_verb/reasons.alb"), 1));
}

#[test]
fn each_row_of_a_table_is_held_to_all_that_is_expected() {
    insta::assert_snapshot!(failed_beside("rows", include_str!("test_verb/rows.alb"), 2));
}

#[test]
fn what_must_hold_once_is_awaited() {
    insta::assert_snapshot!(failed_beside("once", include_str!("test_verb/once.alb"), 1));
}

#[test]
fn the_values_of_reports_and_of_their_labels_can_be_asked_for() {
    insta::assert_snapshot!(failed_beside("labelled", include_str!("test_verb/labelled.alb"), 1));
}

/// An attack: `0.9 s` was told of what was more than that by the last bit, and what had failed seemed to hold.
#[test]
fn what_is_nearly_a_round_number_is_told_whole() {
    insta::assert_snapshot!(failed_beside("rounded", include_str!("test_verb/rounded.alb"), 1));
}

#[test]
fn what_was_reported_and_when_is_known_behind_a_has_reported_too() {
    let project = Project::new("reports", "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), REPORTS).unwrap();
    let (code, said) = project.test(&["--filter", "holds"]);
    assert_eq!((code, said.contains("2 passed, 0 failed")), (Some(0), true), "{said}");
    let (code, said) = project.test(&["--filter", "fails"]);
    assert_eq!(code, Some(1), "{said}");
    insta::assert_snapshot!(said);
}

#[test]
fn a_share_of_the_runs_is_of_one_at_least() {
    let project = Project::new("share", "10 s", "10 cm");
    let file = project.0.join("north.alb");
    for (share, told) in [("1e-9", "0.000000001"), ("0.001", "0.001"), ("7", "7"), ("33.3", "33.3")] {
        project.write("10 s", "10 cm");
        let text = std::fs::read_to_string(&file).unwrap();
        std::fs::write(&file, text.replace("in 75 %", &format!("in {share} %"))).unwrap();
        let (code, said) = project.test(&["--accept"]);
        let held = format!("held in 0 of 4 runs, {told} % wanted");
        assert_eq!((code, said.contains(&held), project.snapshot()), (Some(1), true, None), "{said}");
    }
}

/// A hull of which the simulator cannot compute the motion: a current takes it out of all bounds.
const FAILING: &str = r#"
scenario torn {
    vehicle(fossen(step: 50 ms, fin_max: 45 deg, turns_max: 60 Hz, speed_max: 6 m/s), start: point(north: 0 m, east: 0 m),
        depth: 3 m)
    fault(flooding(water: 0 kg, within: 0 s), from: 5 s)
    fault(strong_current(current: 10 m/s toward east), from: 10 s, to: 60 s)
}

mission zigzag in torn within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 20 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 2.4 m/s
    for i in 0..5 {
        steer east for 5 s
        steer west for 5 s
    }
}

test "passes by its expectations alone" {
    run zigzag in torn seeds 1..2
    expect time > 0 s
    expect not completed
    expect in 50 % of runs: time > 0 s
    expect always zigzag.op.gap(truth.position) > -10 km
    snapshot switches of seed 1
}
"#;

#[test]
fn a_run_that_could_not_go_on_fails_its_test_whatever_it_expects() {
    let project = Project::new("failed", "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), FAILING).unwrap();
    for more in [&[][..], &["--accept"]] {
        let (code, said) = project.test(more);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains("2 of 2 runs failed"), "{said}");
        assert!(said.contains("seed 1: the motion of the hull cannot be computed"), "{said}");
        assert!(!project.0.join("snapshots").exists(), "{said}");
    }
}

/// Two files of one name are told apart.
#[test]
fn a_test_is_told_by_as_much_of_its_path_as_tells_it_from_others() {
    let project = Project::new("places", "10 s", "10 cm");
    let other = project.0.join("other");
    std::fs::create_dir(&other).unwrap();
    std::fs::copy(project.0.join("north.alb"), other.join("north.alb")).unwrap();
    std::fs::copy(project.0.join("north.alb"), other.join("south.alb")).unwrap();
    let (code, said) = project.test(&[&other.display().to_string()]);
    assert_eq!(code, Some(1), "{said}");
    for line in
        ["FAILED  ./north.alb:17", "        ./north.alb:19", "FAILED  ./other/north.alb:17", "FAILED  south.alb:17"]
    {
        assert!(said.contains(&format!("{line}  ")), "{line}: {said}");
    }
}

/// Where the system starts no thread, here for want of memory for its stack, one thread runs all seeds.
#[test]
fn tests_are_run_where_no_thread_can_be_started() {
    let project = Project::new("alone", "20 s", "100 m");
    let told = project.test(&["--accept"]);
    let alone = project.test_with(&[("RUST_MIN_STACK", "1000000000000000")], &[]);
    let again = project.test(&[]);
    assert!(alone == again && alone.0 == Some(0), "{told:?}\n{alone:?}\n{again:?}");
    for odd in [("RUST_MIN_STACK", "1"), ("RAYON_NUM_THREADS", "20000")] {
        assert_eq!(project.test_with(&[odd], &[]), again, "{odd:?}");
    }
}
