//! What `albacore test` tells besides what passed: coverage, results for programs, the runs that failed, and snapshots one by one.

use super::{Project, SCRIPT};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

const COVERED: &str = include_str!("covered.alb");

/// A project with a script of its own.
fn project(name: &str, script: &str) -> Project {
    let project = Project::new(name, "10 s", "5 m");
    std::fs::write(project.0.join("north.alb"), script).unwrap();
    project
}

/// A verb in the folder of a project; the folder is told by its name alone.
fn albacore(project: &Project, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(arguments).current_dir(&project.0).env("NO_COLOR", "1").stdin(Stdio::null());
    command
}

/// What a verb ends with and says.
fn said(mut command: Command) -> (Option<i32>, String, String) {
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The same with lines from a pipe; what is said comes in one text.
fn answered(project: &Project, arguments: &[&str], lines: &str) -> (Option<i32>, String) {
    let out = project.0.join("said.txt");
    let both = std::fs::File::create(&out).unwrap();
    let mut command = albacore(project, arguments);
    command.stdin(Stdio::piped()).stdout(both.try_clone().unwrap()).stderr(both);
    let mut child = command.spawn().unwrap();
    // Who quits reads no more.
    let _ = child.stdin.take().unwrap().write_all(lines.as_bytes());
    let code = child.wait().unwrap().code();
    (code, std::fs::read_to_string(out).unwrap())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn coverage_tells_what_no_run_has_come_to() {
    let project = project("coverage", &COVERED.replace("time < 40 s", "time < 70 s"));
    project.test(&["--accept"]);
    let (code, told, errors) = said(albacore(&project, &["test", "north.alb", "--coverage"]));
    assert_eq!((code, errors.as_str()), (Some(0), ""), "{told}");
    insta::assert_snapshot!(told);
    // Behaviors are 80 % and transitions 40 %: the lesser counts.
    for (threshold, expected) in [("40", Some(0)), ("41", Some(1)), ("81", Some(1)), ("0", Some(0))] {
        let (code, _, errors) = said(albacore(&project, &["test", ".", "--coverage", "--threshold", threshold]));
        assert_eq!(code, expected, "{threshold}: {errors}");
        assert_eq!(errors.contains("of the transitions 2 of 5 (40.0 %) fired"), expected == Some(1), "{errors}");
        assert_eq!(errors.contains("of the behaviors 4 of 5 (80.0 %) were entered"), threshold == "81", "{errors}");
    }
    // The library is counted where that is asked for.
    let arguments = ["test", "north.alb", "--coverage", "--library", "--json"];
    let (_, told, _) = said(albacore(&project, &arguments));
    let whole = json(&told)["coverage"].take();
    assert_eq!((&whole["behaviors"]["of"], &whole["transitions"]["percent"]), (&6.into(), &40.0.into()), "{whole:#}");
    assert_eq!(whole["standard_library"], serde_json::json!([]), "{whole:#}");
    for wrong in [&["--threshold", "80"][..], &["--coverage", "--threshold", "101"], &["--library"]] {
        assert_eq!(said(albacore(&project, &[&["test", "."], wrong].concat())).0, Some(2), "{wrong:?}");
    }
}

/// What two scripts import is counted once, and one of them may come to what the other does not.
#[test]
fn coverage_is_merged_by_places() {
    let project = project("merged", "");
    let (_, strategy) = COVERED.split_once("strategy legs").unwrap();
    let (strategy, _) = strategy.split_once("scenario still").unwrap();
    let strategy = strategy.replace("position.north > 10 km", "position.north > limit");
    let legs =
        format!("strategy legs{}", strategy.replace("(lasting: Duration)", "(lasting: Duration, limit: Length)"));
    std::fs::write(project.0.join("legs.alb"), legs).unwrap();
    std::fs::write(project.0.join("albacore.toml"), "[project]\nname = \"merged\"\n").unwrap();
    for (name, limit) in [("north.alb", "10 km"), ("far.alb", "3 m")] {
        let text = SCRIPT.replace("steer 0 deg for SECONDS", &format!("legs.legs(4 s, {limit}) for 20 s"));
        let text = text.replace("SECONDS", "20 s").replace("METRES", "1 km").replace("snapshot switches of seed 2", "");
        std::fs::write(project.0.join(name), format!("use legs\n{text}")).unwrap();
    }
    let covered = |paths: &[&str]| {
        let (code, told, errors) = said(albacore(&project, &[&["test", "--coverage", "--json"], paths].concat()));
        assert_eq!(code, Some(0), "{told}{errors}");
        let coverage = json(&told)["coverage"].take();
        let count = |part: &str| (coverage[part]["count"].as_u64().unwrap(), coverage[part]["of"].as_u64().unwrap());
        (count("behaviors"), count("transitions"))
    };
    let (near, far, both) = (covered(&["north.alb"]), covered(&["far.alb"]), covered(&["north.alb", "far.alb"]));
    assert_eq!((near.0.1, near.1.1), (4, 5), "{near:?}");
    assert_eq!(near.1.1, far.1.1);
    // The strategy itself is called by two missions, and is one.
    assert_eq!((both.0.1, both.1.1), (4, 5), "{both:?}");
    assert!(both.1.0 > near.1.0 && both.1.0 > far.1.0, "{near:?} {far:?} {both:?}");
    assert_eq!(both, covered(&["far.alb", "north.alb"]));
}

#[test]
fn results_are_the_same_on_any_number_of_threads() {
    let project = project("threads", &COVERED.replace("seeds 1..4", "seeds 1..9"));
    let run = |threads: &str| said(albacore(&project, &["test", ".", "--json", "--coverage", "--threads", threads]));
    let one = run("1");
    assert!(one.0 == Some(1) && one.2.is_empty(), "{one:?}");
    assert_eq!(one, run("4"));
    assert_eq!(one, run("3"));
    assert_eq!(run("0").0, Some(2));
}

#[test]
fn results_are_told_to_programs() {
    let script =
        COVERED.replace("seeds 1..4\n    with", "seeds 1..2\n    with").replace("& \\\"wide", "&\\n]]> \\\"wide");
    let project = project("programs", &script);
    let (code, told, errors) = said(albacore(&project, &["test", "north.alb", "--json", "--junit", "out.xml"]));
    assert_eq!((code, errors.as_str()), (Some(1), ""));
    insta::assert_snapshot!("as_json", told);
    let file = project.0.join("out.xml");
    let xml = std::fs::read_to_string(&file).unwrap();
    insta::assert_snapshot!("as_junit", xml);
    assert!(!xml.chars().any(|c| c.is_control() && c != '\n'), "{xml}");
    // The same again, as it was made; what somebody else wrote is left.
    assert_eq!(said(albacore(&project, &["test", "north.alb", "--junit", "out.xml", "--no-keep"])).0, Some(1));
    std::fs::write(&file, "mine").unwrap();
    let (code, _, errors) = said(albacore(&project, &["test", "north.alb", "--junit", "out.xml"]));
    assert!(code == Some(4) && errors.contains("`out.xml` cannot be written"), "{code:?} {errors}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    // What is left out is skipped, and a script with errors is an error.
    std::fs::write(project.0.join("wrong.alb"), "mission wrong {\n").unwrap();
    let fault = ["--fault", "fault(heading, stuck, from: 1 h)", "--junit", "left.xml"];
    let (code, ..) = said(albacore(&project, &[&["test", "."], &fault[..]].concat()));
    assert_eq!(code, Some(3));
    let xml = std::fs::read_to_string(project.0.join("left.xml")).unwrap();
    assert!(xml.contains("errors=\"1\"") && xml.contains("<skipped") && xml.contains("<error"), "{xml}");
}

/// The folder of a test's first failing run, as `albacore run` would leave it.
fn kept(project: &Project) -> PathBuf {
    project.0.join("albacore-runs/tests/north-goes_north-seed1")
}

#[test]
fn the_first_run_that_fails_is_kept() {
    let project = Project::new("kept", "10 s", "10 cm");
    let (code, said_of_it) = project.test(&["--no-keep"]);
    assert!(code == Some(1) && !said_of_it.contains("kept"), "{said_of_it}");
    let (code, said_of_it) = project.test(&[]);
    assert!(code == Some(1) && said_of_it.contains("albacore why albacore-runs/tests/north-goes_north-seed1"));
    assert_eq!(names(&kept(&project)), ["journal", "run.json", "run.svg", "trace.txt"]);
    let folder = "albacore-runs/tests/north-goes_north-seed1";
    assert_eq!(said(albacore(&project, &["replay", folder])).0, Some(0));
    let (code, why, _) = said(albacore(&project, &["why", folder]));
    assert!(code == Some(0) && why.contains("completed"), "{why}");
    // A later failure takes its place, and nothing that is not as a run left it.
    project.write("14 s", "10 cm");
    project.test(&[]);
    assert!(std::fs::read_to_string(kept(&project).join("trace.txt")).unwrap().contains("for 14 s"));
    std::fs::write(kept(&project).join("trace.txt"), "mine").unwrap();
    let (code, said_of_it) = project.test(&[]);
    assert!(code == Some(1) && said_of_it.contains("the run of seed 1 is not kept"), "{said_of_it}");
    assert!(said_of_it.contains("--no-keep") && !said_of_it.contains("albacore why"), "{said_of_it}");
    assert_eq!(std::fs::read_to_string(kept(&project).join("trace.txt")).unwrap(), "mine");
    let (code, said_of_it) = project.test(&["--keep", "runs of mine"]);
    assert!(code == Some(1) && said_of_it.contains("albacore why 'runs of mine/north-goes_north-seed1'"));
    assert!(project.0.join("runs of mine/north-goes_north-seed1/journal").exists());
}

#[test]
fn nothing_is_kept_of_what_passes() {
    let project = Project::new("kept-none", "10 s", "5 m");
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    assert_eq!(project.test(&[]).0, Some(0));
    assert!(!project.0.join("albacore-runs").exists());
    // The run that is not as its snapshot is the one that is kept.
    project.write("12 s", "5 m");
    assert_eq!(project.test(&[]).0, Some(1));
    assert_eq!(names(&project.0.join("albacore-runs/tests")), ["north-goes_north-seed2"]);
}

/// What a mission is given in a test is kept with its run, and so are the scripts, whichever of them the mission stands in.
#[test]
fn a_run_that_is_kept_can_be_looked_into() {
    let project = project("kept-rows", COVERED);
    let (module, tests) = COVERED.split_once("test \"").unwrap();
    std::fs::write(project.0.join("albacore.toml"), "[project]\nname = \"rows\"\n").unwrap();
    std::fs::write(project.0.join("parts.alb"), module).unwrap();
    let tests = format!("test \"{tests}").replace("run north", "run parts.north").replace("in still", "in parts.still");
    std::fs::write(project.0.join("imported.alb"), format!("use parts\n{tests}")).unwrap();
    for script in ["north", "imported"] {
        let (code, told, errors) = said(albacore(&project, &["test", &format!("{script}.alb")]));
        assert_eq!((code, errors.as_str()), (Some(1), ""), "{told}");
        for test in ["goes_north-seed2", "goes_far_wide.1-seed1"] {
            let folder = format!("albacore-runs/tests/{script}-{test}");
            let (code, told, errors) = said(albacore(&project, &["replay", &folder]));
            assert_eq!((code, errors.as_str()), (Some(0), ""), "{folder}: {told}");
            assert_eq!(said(albacore(&project, &["why", &folder])).0, Some(0));
        }
    }
    // Two scripts of one name have two folders.
    std::fs::create_dir(project.0.join("other")).unwrap();
    std::fs::copy(project.0.join("north.alb"), project.0.join("other/north.alb")).unwrap();
    said(albacore(&project, &["test", "north.alb", "other/north.alb", "--filter", "north", "--keep", "runs"]));
    assert_eq!(names(&project.0.join("runs")), ["north-goes_north-seed2", "north-goes_north-seed2-2"]);
}

/// Two snapshots, of which one is to be accepted.
fn reviewed(name: &str) -> Project {
    let more = "\ntest \"goes on\" {\n    run north in still seeds 1..2\n    expect completed\n    snapshot switches of seed 1\n}\n";
    let script = SCRIPT.replace("SECONDS", "10 s").replace("METRES", "5 m");
    project(name, &(script + more))
}

#[test]
fn snapshots_are_reviewed_one_by_one() {
    let project = reviewed("review");
    let (code, told) = answered(&project, &["test", "north.alb", "--review"], "what\ny\nn\n");
    assert_eq!(code, Some(1), "{told}");
    insta::assert_snapshot!(told);
    assert_eq!(names(&project.0.join("snapshots")), ["north-goes_north-2.trace"]);
    // A change is shown as a difference, and what was accepted is what `--accept` would have written.
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    std::fs::write(project.0.join("north.alb"), script.replace("10 s", "11 s")).unwrap();
    let (code, told) = answered(&project, &["test", "north.alb", "--review"], "y\ny\n");
    assert!(code == Some(0) && told.contains("2 passed, 0 failed"), "{told}");
    assert!(told.contains("-     0.1 s  begin") && told.contains("+     0.1 s  begin"), "{told}");
    assert_eq!(project.test(&[]).0, Some(0));
    let reviewed = project.snapshot();
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    assert_eq!(project.snapshot(), reviewed);
}

#[test]
fn who_quits_a_review_leaves_the_rest() {
    let project = reviewed("review-quit");
    for lines in ["q\n", ""] {
        let (code, told) = answered(&project, &["test", "north.alb", "--review"], lines);
        assert_eq!(code, Some(1), "{told}");
        assert!(told.contains("the review was ended") && !told.contains("goes on"), "{told}");
        assert!(!project.0.join("snapshots").exists());
    }
    // What fails is not asked about.
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    std::fs::write(project.0.join("north.alb"), script.replace("< 5 m", "< 1 cm")).unwrap();
    let (code, told) = answered(&project, &["test", "north.alb", "--review", "--filter", "goes north"], "y\n");
    assert!(code == Some(1) && told.contains("what fails is not accepted") && !told.contains("accept it?"), "{told}");
    for other in [&["--accept"][..], &["--fault", "leak"], &["--junit", "f.xml"], &["--json"]] {
        let (code, told) = answered(&project, &[&["test", "--review"], other].concat(), "");
        assert!(code == Some(2) && told.contains("cannot be used with"), "{told}");
    }
}

/// Ends by itself, whatever becomes of the test.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn who_interrupts_is_told_what_was_done() {
    let script = SCRIPT.replace("SECONDS", "10 s").replace("METRES", "5 m").replace("snapshot switches of seed 2", "");
    let long = "\ntest \"lasts\" {\n    run north in still seeds 1..900000\n    expect completed\n}\n";
    let project = project("interrupted", &(script + long));
    let mut command = albacore(&project, &["test", "north.alb", "--junit", "out.xml"]);
    let mut child = Ended(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap());
    let mut told = BufReader::new(child.0.stdout.take().unwrap());
    let mut first = String::new();
    told.read_line(&mut first).unwrap();
    assert!(first.starts_with("ok      north.alb:17"), "{first}");
    assert!(Command::new("kill").args(["-INT", &child.0.id().to_string()]).status().unwrap().success());
    let rest = std::io::read_to_string(told).unwrap();
    let errors = std::io::read_to_string(child.0.stderr.take().unwrap()).unwrap();
    assert_eq!(child.0.wait().unwrap().code(), Some(1), "{rest}{errors}");
    assert_eq!(rest, "1 passed, 0 failed\n");
    assert!(errors.contains("error: interrupted"), "{errors}");
    assert!(!errors.contains("900000 of"), "what was broken off is not over: {errors}");
    assert!(errors.contains("1 test was run, and `out.xml` is not written"), "{errors}");
    assert_eq!(names(&project.0), ["north.alb"]);
}

/// What others called their files and tests is shown, and never obeyed.
#[test]
fn results_hold_nothing_unseen() {
    let evil = "e\u{1b}[2J\u{202e}\u{9b}31mvil";
    let project = project("unseen", "");
    let script = COVERED.replace("goes north", "goes\\nnorth");
    std::fs::write(project.0.join(format!("{evil}.alb")), script).unwrap();
    std::fs::write(project.0.join("north.alb"), format!("mission {evil} {{\n")).unwrap();
    let (code, told, errors) = said(albacore(&project, &["test", ".", "--json", "--coverage", "--junit", "out.xml"]));
    let xml = std::fs::read_to_string(project.0.join("out.xml")).unwrap_or_default();
    assert_eq!(code, Some(3), "{told}{errors}");
    assert!(xml.contains("errors=\"1\"") && xml.contains("failures=\"2\""), "{xml}");
    for text in [told, errors, xml] {
        let unseen = text.chars().find(|c| albacore_session::seen::is_unseen(*c) && *c != '\n');
        assert_eq!(unseen, None, "{}", text.escape_debug());
    }
}
