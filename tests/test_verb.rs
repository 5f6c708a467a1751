//! `albacore test`: what it says, writes and ends with, for each way a test can go.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

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
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.arg("test").arg(&self.0).args(more).env("NO_COLOR", "1").stdin(Stdio::null());
        let output = command.output().unwrap();
        let said = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8_lossy(&said).replace(&self.0.display().to_string(), "."))
    }
}

#[test]
fn a_snapshot_that_cannot_be_read_is_said() {
    let project = Project::new("unreadable", "20 s", "30 m");
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let no_file = "cannot be read: it is no ordinary file";
    std::fs::write(&file, b"\xff\xfe").unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains("cannot be read: it is no text in UTF-8"), "{said}");
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(1) && said.contains("is there already, and it is no text in UTF-8"), "{said}");
    assert_eq!(std::fs::read(&file).unwrap(), b"\xff\xfe");
    std::fs::remove_file(&file).unwrap();
    assert!(Command::new("mkfifo").arg(&file).status().unwrap().success());
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains(no_file), "{said}");
    std::fs::remove_file(&file).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &file).unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains(no_file) && !said.contains("there is no snapshot"), "{said}");
}

#[test]
fn what_was_accepted_passes() {
    let project = Project::new("accepted", "10 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("wrote ./snapshots/north-goes_north-2.trace"), "{said}");
    assert!(project.snapshot().unwrap().contains("report"));
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("1 passed, 0 failed"), "{said}");
}

/// A file's name cannot be as long as a test's may be.
#[test]
fn a_test_with_a_long_name_has_its_snapshot() {
    let project = Project::new("long", "10 s", "5 m");
    for (first, second, script) in [("a", "b", "north.alb"), ("c", "d", "LONG.alb")] {
        let long = "a very long name ".repeat(20);
        let text = SCRIPT.replace("SECONDS", "10 s").replace("METRES", "5 m");
        let (head, test) = text.split_once("test \"goes north\"").unwrap();
        let both = format!("{head}test \"{long}{first}\"{test}");
        let both = format!("{both}\ntest \"{long}{second}\"{test}");
        let _ = std::fs::remove_dir_all(project.0.join("snapshots"));
        std::fs::remove_file(project.0.join("north.alb")).unwrap_or_default();
        std::fs::write(project.0.join(script.replace("LONG", &"ö".repeat(120))), both).unwrap();
        let (code, said) = project.test(&["--accept"]);
        assert!(code == Some(0) && said.contains("2 passed"), "{said}");
        assert_eq!(std::fs::read_dir(project.0.join("snapshots")).unwrap().count(), 2);
        assert_eq!(project.test(&[]).0, Some(0));
    }
}

/// What has the name of a snapshot and is none is somebody's own.
#[test]
fn what_is_no_trace_is_not_written_over() {
    let project = Project::new("theirs", "10 s", "5 m");
    std::fs::create_dir(project.0.join("snapshots")).unwrap();
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    std::fs::write(&file, "my notes").unwrap();
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(1) && said.contains("is there already, and its line 1 is none of a trace"), "{said}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "my notes");
}

/// A file that begins like a snapshot may be somebody's notes on it; one that a merge left with its marks is a snapshot.
#[test]
fn what_somebody_wrote_into_a_snapshot_is_not_written_over() {
    let project = Project::new("annotated", "10 s", "5 m");
    project.test(&["--accept"]);
    let accepted = project.snapshot().unwrap();
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let (head, rest) = accepted.split_once('\n').unwrap();
    let stale = rest.replace("end", "END").replace("0.1 s", "0.2 s");
    for (text, line) in [
        (format!("{head}\nmy notes\n"), Some(2)),
        (format!("{accepted}# it turns too late\n"), Some(accepted.lines().count() + 1)),
        (format!("{head}\n    1.x s  at\n"), Some(2)),
        (format!("{head}\n{stale}"), None),
        (format!("{head}\n<<<<<<< ours\n{rest}||||||| base\n=======\n{stale}>>>>>>> theirs\n"), None),
        (format!("<<<<<<< ours\r\n{head}\r\n=======\r\n{head}1\r\n>>>>>>> theirs\r\n\r\n{rest}"), None),
        (String::new(), None),
    ] {
        std::fs::write(&file, &text).unwrap();
        // Nobody is advised to do what is refused.
        let (code, said) = project.test(&[]);
        let same = text.starts_with(&accepted);
        if let Some(line) = line {
            let what = format!("line {line} of `./snapshots/north-goes_north-2.trace` is none of a trace");
            assert!(code == Some(1) && said.contains(&what) && !said.contains("--accept"), "{text}: {said}");
            assert_eq!(said.contains("behaved differently"), !same, "{text}: {said}");
            assert!(!said.contains("numerically different"), "{text}: {said}");
        }
        let (code, said) = project.test(&["--accept"]);
        match line {
            Some(line) => {
                let why = format!("is there already, and its line {line} is none of a trace");
                assert!(code == Some(1) && said.contains(&why) && said.contains("move it away"), "{text}: {said}");
                assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
                std::fs::rename(&file, file.with_extension("mine")).unwrap();
                assert_eq!(project.test(&["--accept"]).0, Some(0), "the fix that is offered works");
            }
            None => assert_eq!(code, Some(0), "{text}: {said}"),
        }
        assert_eq!(project.snapshot().as_deref(), Some(accepted.as_str()), "{text}");
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
fn the_snapshot_of_a_test_that_fails_is_not_accepted() {
    let project = Project::new("accept-fails", "10 s", "10 cm");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!((code, said.contains("what fails is not accepted")), (Some(1), true), "{said}");
    assert_eq!(project.snapshot(), None);
    // Nor does it replace one that was accepted.
    project.write("10 s", "5 m");
    project.test(&["--accept"]);
    let accepted = project.snapshot();
    project.write("11 s", "10 cm");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(1), "{said}");
    assert_eq!((project.snapshot().is_some(), project.snapshot()), (true, accepted));
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

/// Version control may write other line ends than these, and an editor may leave the last one out.
#[test]
fn the_ends_of_lines_are_no_part_of_a_snapshot() {
    let project = Project::new("line-ends", "10 s", "5 m");
    project.test(&["--accept"]);
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let accepted = project.snapshot().unwrap();
    let short = accepted.trim_end().to_string();
    for text in [accepted.replace('\n', "\r\n"), short.replace('\n', "\r\n"), short] {
        std::fs::write(&file, &text).unwrap();
        let (code, said) = project.test(&[]);
        assert_eq!(code, Some(0), "{said}");
    }
    // What else differs is shown, though it be a blank line.
    std::fs::write(&file, format!("{accepted}\n")).unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains("- (an empty line)") && said.contains("+ (nothing more)"), "{said}");
}

/// The command that a message gives accepts what the message is of, typed as it stands, and nothing else: whatever the paths are
/// called, and wherever they are.
#[test]
fn the_command_that_is_given_accepts_what_was_looked_at() {
    let project = Project::new("advice", "10 s", "5 m");
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    let odd = "o'er $HOME `there`";
    for folder in ["missions", "other", odd, "-x"] {
        std::fs::create_dir(project.0.join(folder)).unwrap();
        std::fs::write(project.0.join(folder).join("fast.alb"), &script).unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_albacore"));
    let run = |mut command: Command| {
        let output = command.current_dir(&project.0).env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        (output.status.code(), said)
    };
    let test = |arguments: &[&str]| {
        let mut command = Command::new(program);
        command.arg("test").args(arguments);
        run(command)
    };
    let snapshot = |folder: &str| project.0.join(folder).join("snapshots/fast-goes_north-2.trace");
    // A regression that nobody has looked at.
    assert_eq!(test(&["missions", "--accept"]).0, Some(0));
    let accepted = std::fs::read_to_string(snapshot("missions")).unwrap().replace("enter", "ENTER");
    std::fs::write(snapshot("missions"), &accepted).unwrap();
    for (arguments, folder, words) in [
        (&["other/fast.alb"][..], "other", "other/fast.alb"),
        (&[odd], odd, r"'o'\''er $HOME `there`'"),
        (&["--filter", "goes north", "other/fast.alb"], "other", "--filter='goes north' other/fast.alb"),
        (&["--", "-x"], "-x", "-- -x"),
    ] {
        for is_there in [false, true] {
            match is_there {
                false => drop(std::fs::remove_dir_all(snapshot(folder).parent().unwrap())),
                true => std::fs::write(snapshot(folder), accepted.replace("ENTER", "leave")).unwrap(),
            }
            let (code, said) = test(arguments);
            let before = if is_there { "when this is right: `" } else { "look at the run, then `" };
            let advice = said.lines().find_map(|line| line.trim().strip_prefix(before)).unwrap_or_default();
            let advice = advice.strip_suffix('`').unwrap_or_default();
            assert_eq!((code, advice), (Some(1), format!("albacore test --accept {words}").as_str()), "{said}");
            let mut shell = Command::new("sh");
            let path = std::env::join_paths([program.parent().unwrap(), Path::new("/usr/bin"), Path::new("/bin")]);
            shell.args(["-c", advice]).env("PATH", path.unwrap());
            let (code, said) = run(shell);
            assert_eq!(code, Some(0), "{advice}: {said}");
            assert_eq!(test(arguments).0, Some(0), "{advice}");
            assert_eq!(std::fs::read_to_string(snapshot("missions")).unwrap(), accepted, "{advice}");
        }
    }
    // Where nothing was named nothing is.
    let (code, said) = test(&[]);
    assert!(code == Some(1) && said.contains("when this is right: `albacore test --accept`\n"), "{said}");
    // What a terminal obeys is written so that a shell reads it.
    std::fs::rename(project.0.join("-x"), project.0.join("e\u{1b}'")).unwrap();
    std::fs::remove_dir_all(project.0.join("e\u{1b}'/snapshots")).unwrap();
    let (code, said) = test(&["e\u{1b}'"]);
    assert!(code == Some(1) && said.contains(r"`albacore test --accept $'e\x1b\''`"), "{said}");
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

/// A snapshot may be kept elsewhere: what a link leads to is the snapshot, and the link stays.
#[test]
fn a_snapshot_behind_a_link_is_accepted_behind_it() {
    let project = Project::new("linked", "10 s", "5 m");
    project.test(&["--accept"]);
    let (file, kept) = (project.0.join("snapshots/north-goes_north-2.trace"), project.0.join("kept.trace"));
    std::fs::rename(&file, &kept).unwrap();
    std::os::unix::fs::symlink("../kept.trace", &file).unwrap();
    project.write("11 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(file.is_symlink() && std::fs::read_to_string(&kept).unwrap().contains("11.1 s  report"), "{said}");
    assert_eq!(project.test(&[]).0, Some(0));
    // One that leads nowhere is left, and so is another name of the file before.
    std::fs::hard_link(&kept, project.0.join("named.trace")).unwrap();
    project.write("10 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(0) && said.contains("trace` had another name (a hard link)"), "{said}");
    assert!(std::fs::read_to_string(project.0.join("named.trace")).unwrap().contains("11.1 s  report"));
    std::fs::remove_file(&kept).unwrap();
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(1) && said.contains("is a link that leads nowhere") && file.is_symlink(), "{said}");
}
