//! No run overwrites another: each has a folder of its own, and says in it what it was and when.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

use albacore_trace::journal::{Ending, Journal};
use serde_json::Value;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A mission that goes on for days.
const LONG: &str = "
mission long in still within 200 h {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    wait for 199 h
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}
";

/// A folder of a test's own, with two missions.
fn project(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("runs").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::copy("missions/box.alb", folder.join("box.alb")).unwrap();
    std::fs::write(folder.join("long.alb"), LONG).unwrap();
    folder
}

fn run(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.arg("run").args(words.split(' ')).current_dir(folder).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Exit code, standard output and standard error.
fn ran(folder: &Path, words: &str) -> (Option<i32>, String, String) {
    let output = run(folder, words).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The folder that a run says it wrote.
fn folder_of(told: &str) -> String {
    serde_json::from_str::<Value>(told).unwrap()["folder"].as_str().unwrap().to_string()
}

fn record(folder: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join("run.json")).unwrap()).unwrap()
}

/// All files of a folder with their bytes.
fn bytes(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    names(folder).into_iter().map(|name| (name.clone(), std::fs::read(folder.join(name)).unwrap())).collect()
}

fn is_whole(folder: &Path) -> bool {
    let journal = Journal::read(&std::fs::read(folder.join("journal")).unwrap()).unwrap();
    matches!(journal.ending, Ending::Complete(_))
}

/// Starts the long mission, and comes back when it is under way.
fn long_run(project: &Path, out: &str) -> Child {
    let child = run(project, &format!("long.alb --out {out}")).spawn().unwrap();
    for _ in 0..20_000 {
        let folder = project.join(out.split(' ').next().unwrap());
        if std::fs::metadata(folder.join("journal")).is_ok_and(|m| m.len() > 5_000) {
            break;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

/// Asks a run to end, and gives its exit code, standard output and standard error.
fn ended(child: Child) -> (Option<i32>, String, String) {
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn end(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn each_run_has_a_folder_of_its_own() {
    let project = project("own");
    let mut children: Vec<Child> = (0..4).map(|_| run(&project, "box.alb --json").spawn().unwrap()).collect();
    children.push(run(&project, "box.alb --json --seed 2").spawn().unwrap());
    let mut folders = Vec::new();
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        folders.push(project.join(folder_of(&String::from_utf8_lossy(&output.stdout))));
    }
    let journal = |folder: &PathBuf| std::fs::read(folder.join("journal")).unwrap();
    assert!(folders[..4].iter().all(|folder| journal(folder) == journal(&folders[0])));
    assert!(folders.iter().all(|folder| is_whole(folder)));
    let made = names(&project.join("albacore-runs/box"));
    assert_eq!(made.len(), 5);
    for (name, folder) in made.iter().zip(&folders) {
        assert_eq!(names(folder), ["journal", "run.json", "run.svg", "trace.txt"]);
        let shape: String = name.chars().map(|c| if c.is_ascii_digit() { '0' } else { c }).collect();
        assert_eq!(shape, "0000-00-00T00-00-00Z-0");
    }
}

/// Why a file is left alone: it is not a run's, or nothing beside it tells that it is.
fn because(has_journal: bool) -> &'static str {
    if has_journal { "is not as a run left it" } else { "beside it no `journal`" }
}

#[test]
fn a_folder_that_holds_a_run_is_refused() {
    let project = project("refused");
    assert_eq!(ran(&project, "box.alb --out out").0, Some(0));
    let out = project.join("out");
    std::fs::write(out.join("notes.txt"), "mine").unwrap();
    let before = bytes(&out);
    // It is said before the vehicle is called, and before a long mission begins.
    for words in ["box.alb --out out", "long.alb --out out", "box.alb --seed 2 --out out/"] {
        let (code, _, said) = ran(&project, words);
        assert!(code == Some(2) && said.contains("holds a run already") && said.contains("--replace"), "{said}");
        assert_eq!(bytes(&out), before, "{words}");
    }
    // What no run left so stays, and a link does.
    for name in ["journal", "run.json", "trace.txt", "run.svg", "recorded.csv"] {
        let out = project.join(format!("only-{name}"));
        std::fs::create_dir(&out).unwrap();
        std::os::unix::fs::symlink("../out/notes.txt", out.join(name)).unwrap();
        let words = format!("box.alb --out only-{name}");
        for words in [&words, &format!("{words} --replace")] {
            let (code, _, said) = ran(&project, words);
            let why = format!("`only-{name}/{name}` is there already, and {}", because(name == "journal"));
            assert!(code == Some(2) && said.contains(&why), "{words}: {said}");
            assert!(names(&out) == [name] && out.join(name).is_symlink(), "{words}");
        }
    }
    assert_eq!(bytes(&out), before);
    let (code, _, said) = ran(&project, "box.alb --replace");
    assert!(code == Some(2) && said.contains("--out"), "{said}");
}

#[test]
fn who_replaces_a_run_removes_only_its_files() {
    let project = project("replaced");
    let out = project.join("out");
    assert_eq!(ran(&project, "box.alb --out out").0, Some(0));
    let before = bytes(&out);
    std::fs::write(out.join("notes.txt"), "mine").unwrap();
    assert_eq!(ran(&project, "box.alb --seed 2 --out out --replace").0, Some(0));
    assert_eq!(names(&out), ["journal", "notes.txt", "run.json", "run.svg", "trace.txt"]);
    assert_eq!(std::fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
    assert!(is_whole(&out) && bytes(&out)["journal"] != before["journal"]);
    assert_eq!(record(&out)["seed"], 2);
}

/// A file of a run's name that no run wrote, alone or beside a run, and what was edited since.
#[test]
fn who_replaces_a_run_removes_nothing_that_no_run_made() {
    let project = project("theirs");
    for name in ["journal", "run.json", "trace.txt", "run.svg", "recorded.csv"] {
        for is_alone in [true, false] {
            let out = project.join(format!("{name}-{is_alone}"));
            std::fs::create_dir(&out).unwrap();
            let words = format!("box.alb --out {name}-{is_alone}");
            if !is_alone {
                assert_eq!(ran(&project, &words).0, Some(0));
            }
            std::fs::write(out.join(name), "my notes").unwrap();
            let before = bytes(&out);
            let (code, _, said) = ran(&project, &format!("{words} --replace"));
            let why = format!("{name}` is there already, and {}", because(name == "journal" || !is_alone));
            assert!(code == Some(2) && said.contains(&why), "{words}: {said}");
            assert!(bytes(&out) == before, "{words}");
        }
    }
    let out = project.join("edited");
    for name in ["trace.txt", "run.svg", "run.json", "journal"] {
        assert_eq!(ran(&project, "box.alb --out edited --replace").0, Some(0));
        let made = std::fs::read(out.join(name)).unwrap();
        let at = made.windows(3).position(|word| word == b"box").unwrap();
        let edited = [&made[..at], b"f", &made[at + 1..]].concat();
        for theirs in [edited, [&made[..], b"my notes"].concat()] {
            std::fs::write(out.join(name), &theirs).unwrap();
            assert_eq!(ran(&project, "box.alb --out edited --replace").0, Some(2), "{name}");
            assert!(std::fs::read(out.join(name)).unwrap() == theirs);
        }
        std::fs::write(out.join(name), made).unwrap();
    }
    // What a run that was killed leaves is its own.
    end(long_run(&project, "killed"));
    let journal = std::fs::read(project.join("killed/journal")).unwrap();
    std::fs::write(project.join("killed/journal"), &journal[..journal.len() / 2]).unwrap();
    assert_eq!(ran(&project, "box.alb --out killed --replace").0, Some(0));
}

/// A file of another run in the folder is not this run's, whatever its mark.
#[test]
fn who_replaces_a_run_removes_no_file_of_another() {
    let project = project("another");
    for (seed, out) in [(3, "a"), (4, "b")] {
        assert_eq!(ran(&project, &format!("box.alb --seed {seed} --out {out}")).0, Some(0));
    }
    for name in ["trace.txt", "run.svg", "journal"] {
        let (theirs, ours) = (project.join("a").join(name), project.join("b").join(name));
        let own = std::fs::read(&ours).unwrap();
        std::fs::copy(&theirs, &ours).unwrap();
        let (code, _, said) = ran(&project, "box.alb --seed 5 --out b --replace");
        assert_eq!(code, Some(2), "{name}: {said}");
        assert!(said.contains(&format!("`b/{name}` is there already, and is not as a run left it")), "{said}");
        assert_eq!(std::fs::read(&ours).unwrap(), std::fs::read(&theirs).unwrap());
        std::fs::write(&ours, own).unwrap();
    }
    assert_eq!(ran(&project, "box.alb --seed 5 --out b --replace").0, Some(0));
}

/// What a run left is its own wherever it is moved.
#[test]
fn no_diagram_takes_the_place_of_what_a_run_left() {
    let project = project("moved");
    assert_eq!(ran(&project, "box.alb --out a").0, Some(0));
    for name in ["run.svg", "trace.txt"] {
        let moved = project.join(format!("moved-{name}"));
        std::fs::rename(project.join("a").join(name), &moved).unwrap();
        let before = std::fs::read(&moved).unwrap();
        let mut graph = Command::new(env!("CARGO_BIN_EXE_albacore"));
        let output = graph.args(["graph", "box.alb", "--out"]).arg(&moved).current_dir(&project).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(4) && said.contains("is not as Albacore made it"), "{said}");
        assert_eq!(std::fs::read(&moved).unwrap(), before);
    }
}

/// What somebody puts into a run's folder while it goes on is no file of the run.
#[test]
fn a_run_replaces_nothing_that_came_while_it_went_on() {
    let project = project("came");
    let (out, child) = (project.join("out"), long_run(&project, "out"));
    std::fs::write(out.join("trace.txt"), "my notes").unwrap();
    let (code, _, said) = ended(child);
    assert!(code == Some(4) && said.contains("`out/trace.txt` cannot be written: "), "{code:?} {said}");
    assert_eq!(std::fs::read_to_string(out.join("trace.txt")).unwrap(), "my notes");
    assert!(out.join("run.svg").exists() && record(&out)["lost"]["trace.txt"].is_string());
}

#[test]
fn a_run_under_way_is_not_replaced() {
    let project = project("locked");
    let child = long_run(&project, "out");
    let (code, _, said) = ran(&project, "box.alb --out out --replace");
    assert!(code == Some(2) && said.contains("another run is writing into `out`"), "{code:?} {said}");
    assert_eq!(record(&project.join("out"))["outcome"], "running");
    end(child);
    // Its lock ended with it. What it left says that it has not ended itself.
    let left = record(&project.join("out"));
    assert_eq!((&left["outcome"], &left["ended"], &left["mission"]), (&"running".into(), &Value::Null, &"long".into()));
    assert_eq!(ran(&project, "box.alb --out out").0, Some(2));
    assert_eq!(ran(&project, "box.alb --out out --replace").0, Some(0));
    assert!(is_whole(&project.join("out")));
}

#[test]
fn of_many_runs_in_one_folder_one_has_it() {
    let project = project("many");
    for more in std::iter::once("").chain([" --replace"; 20]) {
        let words = |seed| format!("box.alb --out out{more} --seed {seed}");
        let children: Vec<Child> = (1..=12).map(|seed| run(&project, &words(seed)).spawn().unwrap()).collect();
        let outputs: Vec<_> = children.into_iter().map(|child| child.wait_with_output().unwrap()).collect();
        let ended = |code| outputs.iter().filter(|output| output.status.code() == Some(code)).count();
        // Whoever comes after the first has ended may replace it.
        assert!(if more.is_empty() { ended(0) == 1 } else { ended(0) >= 1 });
        let failed: Vec<_> = outputs.iter().filter(|output| !matches!(output.status.code(), Some(0 | 2))).collect();
        assert!(failed.is_empty(), "{failed:?}");
        let out = project.join("out");
        assert!(is_whole(&out));
        let journal = Journal::read(&std::fs::read(out.join("journal")).unwrap()).unwrap();
        assert_eq!(record(&out)["seed"], journal.header.seed);
        assert_eq!(record(&out)["outcome"], "completed");
        let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
        assert!(trace.contains(&format!("seed {}  tick", journal.header.seed)), "{trace}");
    }
}

/// Its folder was removed, and another run has one of the same name.
#[test]
fn a_run_writes_into_no_folder_but_its_own() {
    let project = project("gone");
    let (out, child) = (project.join("out"), long_run(&project, "out"));
    std::fs::remove_dir_all(&out).unwrap();
    assert_eq!(ran(&project, "box.alb --seed 2 --out out").0, Some(0));
    let before = bytes(&out);
    let (code, _, said) = ended(child);
    assert!(code == Some(4) && said.contains("`out` is not this run's folder any more"), "{code:?} {said}");
    assert_eq!(bytes(&out), before);
}

#[test]
fn a_run_whose_folder_is_moved_says_there_how_it_ended() {
    let project = project("moved");
    let child = long_run(&project, "out --json");
    std::fs::rename(project.join("out"), project.join("elsewhere")).unwrap();
    let (code, told, said) = ended(child);
    assert!(code == Some(4) && said.contains("it was moved or removed"), "{code:?} {said}");
    assert!(said.contains("not written: trace.txt, run.svg"), "{said}");
    assert!(!told.contains("\"folder\""), "{told}");
    assert!(!project.join("out").exists());
    let moved = project.join("elsewhere");
    assert_eq!(names(&moved), ["journal", "run.json"]);
    assert!(is_whole(&moved) && record(&moved)["outcome"] == "interrupted");
}

/// An editor that saves puts another file in the place of the one that it read.
#[test]
fn a_record_that_was_replaced_is_told_and_left_alone() {
    for (name, other) in [("record-gone", None), ("record-replaced", Some("mine"))] {
        let project = project(name);
        let (out, child) = (project.join("out"), long_run(&project, "out"));
        std::fs::remove_file(out.join("run.json")).unwrap();
        other.into_iter().for_each(|text| std::fs::write(out.join("run.json"), text).unwrap());
        let (code, _, said) = ended(child);
        assert!(code == Some(4) && said.contains("`out/run.json` is not this run's any more"), "{code:?} {said}");
        assert!(said.contains("interrupted"), "{said}");
        assert_eq!(std::fs::read_to_string(out.join("run.json")).ok().as_deref(), other);
        assert!(is_whole(&out) && out.join("trace.txt").exists() && out.join("run.svg").exists());
    }
}

/// An editor that writes into the very file, and a shell that empties it.
#[test]
fn what_others_write_into_the_files_of_a_run_is_told() {
    let project = project("written-into");
    let (out, child) = (project.join("record"), long_run(&project, "record"));
    std::fs::write(out.join("run.json"), "my notes").unwrap();
    let (code, _, said) = ended(child);
    assert!(
        code == Some(4) && said.contains("`record/run.json` cannot be written: another program"),
        "{code:?} {said}"
    );
    assert!(said.contains("the run ended: interrupted"), "{said}");
    assert_eq!(std::fs::read_to_string(out.join("run.json")).unwrap(), "my notes");
    for text in ["", "my notes"] {
        let (out, child) = (project.join("journal"), long_run(&project, "journal"));
        std::fs::write(out.join("journal"), text).unwrap();
        std::thread::sleep(Duration::from_millis(100));
        let (code, _, said) = ended(child);
        assert!(code == Some(4) && said.contains("`journal/journal` cannot be written: another program"), "{said}");
        // A block that was on its way when it was looked at last may stand behind, and no other.
        let left = std::fs::read(out.join("journal")).unwrap();
        assert!(left.starts_with(text.as_bytes()) && left.len() < 5_000, "{text:?}: {} bytes", left.len());
        assert!(record(&out)["lost"]["journal"].is_string());
        std::fs::remove_dir_all(&out).unwrap();
    }
}

/// As long as it was, and with other bytes.
#[test]
fn a_journal_that_was_overwritten_is_told() {
    for (name, at) in [("head", 0), ("middle", 1500)] {
        let project = project(&format!("overwritten-{name}"));
        let (out, child) = (project.join("out"), long_run(&project, "out"));
        let journal = std::fs::OpenOptions::new().write(true).open(out.join("journal")).unwrap();
        std::os::unix::fs::FileExt::write_all_at(&journal, b"XXXX", at).unwrap();
        let (code, _, said) = ended(child);
        assert!(code == Some(4) && said.contains("`out/journal` is not as this run wrote it"), "{code:?} {said}");
        assert!(record(&out)["lost"]["journal"].is_string());
    }
}

#[test]
fn a_journal_that_was_removed_is_told() {
    let project = project("journal-gone");
    let (out, child) = (project.join("out"), long_run(&project, "out"));
    std::fs::remove_file(out.join("journal")).unwrap();
    let (code, _, said) = ended(child);
    assert!(code == Some(4) && said.contains("`out/journal` is not this run's any more"), "{code:?} {said}");
    let lost = record(&out)["lost"].clone();
    assert!(["journal", "trace.txt", "run.svg"].iter().all(|name| lost[name].is_string()), "{lost}");
    assert_eq!(names(&out), ["run.json"]);
}

/// What would stand in the way is said before anything of the run that was there is gone.
#[test]
fn a_run_that_cannot_be_replaced_is_left_as_it_is() {
    let project = project("irreplaceable");
    let out = project.join("out");
    assert_eq!(ran(&project, "box.alb --out out").0, Some(0));
    std::fs::remove_file(out.join("run.json")).unwrap();
    let before = bytes(&out);
    std::fs::create_dir(out.join("run.json")).unwrap();
    let (code, _, said) = ran(&project, "box.alb --out out --replace");
    assert!(
        code == Some(2) && said.contains("`out/run.json` is there already, and is not as a run left it"),
        "{code:?} {said}"
    );
    std::fs::remove_dir(out.join("run.json")).unwrap();
    assert_eq!(bytes(&out), before);
}

#[test]
fn a_run_says_what_it_was_and_when() {
    let project = project("record");
    let (code, _, _) = ran(&project, "box.alb --in nowhere");
    assert_eq!(code, Some(2));
    assert!(!project.join("albacore-runs").exists(), "a run that never began left a folder");
    let fault = "flow,off,from:10min";
    let words = format!("box.alb --json --seed 3 --set round.patience=9min --fault fault({fault}) --rate 1000");
    let (code, told, said) = ran(&project, &words);
    assert_eq!(code, Some(0), "{told} {said}");
    let record = record(&project.join(folder_of(&told)));
    let told: Value = serde_json::from_str(&told).unwrap();
    for field in ["mission", "scenario", "seed", "outcome", "reason", "ticks", "digest"] {
        assert_eq!(record[field], told[field], "{field}");
    }
    assert_eq!((&record["link"], &record["rate"]), (&Value::Null, &1000.0.into()));
    assert_eq!(
        (&record["set"][0], &record["fault"][0]),
        (&"round.patience=9min".into(), &format!("fault({fault})").into())
    );
    assert_eq!(record["scripts"][0]["name"], "box.alb");
    assert_eq!(record["scripts"][0]["digest"].as_str().unwrap().len(), 16);
    assert_eq!(record["albacore"], env!("CARGO_PKG_VERSION"));
    let times = ["started", "first_tick", "ended"].map(|field| record[field].as_str().unwrap().to_string());
    assert!(times.is_sorted() && times.iter().all(|time| time.len() == 24 && time.ends_with('Z')), "{times:?}");
}

/// A vehicle that is never heard: the run that was made before stays.
/// A name of a file is bytes, and need be no text.
#[test]
fn a_run_in_a_folder_without_a_readable_name_is_told() {
    let project = project("unreadable-name");
    let mut run = run(&project, "box.alb --json --out");
    let output = run.arg(OsStr::from_bytes(b"a\xff")).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(folder_of(&String::from_utf8_lossy(&output.stdout)), "a\u{fffd}");
}

#[test]
fn a_run_that_hears_nothing_costs_no_other_run() {
    let project = project("silent");
    assert_eq!(ran(&project, "box.alb").0, Some(0));
    let runs = project.join("albacore-runs/box");
    let first = runs.join(&names(&runs)[0]);
    let before = bytes(&first);
    let nobody = std::net::UdpSocket::bind("127.0.0.1:0").unwrap();
    let link = format!("box.alb --link udp:{}?dialect=recon", nobody.local_addr().unwrap());
    let child = run(&project, &link).spawn().unwrap();
    let pid = child.id().to_string();
    for _ in 0..20_000 {
        if names(&runs).len() == 2 {
            break;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let _ = child.wait_with_output().unwrap();
    assert_eq!(names(&runs).len(), 2);
    assert_eq!(bytes(&first), before);
    // Nor the one that it was to replace.
    let replacing = format!("{link} --replace --out {}", first.display());
    for is_interrupted in [true, false] {
        let (code, _, said) = if is_interrupted {
            let child = run(&project, &replacing).spawn().unwrap();
            std::thread::sleep(Duration::from_secs(1));
            ended(child)
        } else {
            ran(&project, &replacing)
        };
        assert_eq!(code, Some(if is_interrupted { 1 } else { 4 }), "{said}");
        assert!(said.contains("was touched") && bytes(&first) == before, "{said}");
    }
}
