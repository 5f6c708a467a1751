//! What a run leaves on the disk: all of it, whatever ends the run; and what happens when the disk will not take it.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

use crate::shell::behind;
use albacore_trace::journal::{Ending, Journal};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

const BOX: &str = "missions/box.alb";

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

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn albacore(script: &str, out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["run", script, "--out"]).arg(out).current_dir(env!("CARGO_MANIFEST_DIR"));
    command.env("NO_COLOR", "1").stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn journal(out: &Path) -> Journal {
    Journal::read(&std::fs::read(out.join("journal")).unwrap()).unwrap()
}

/// Starts the long mission, and comes back when its journal has some bytes.
fn long_run(out: &Path, bytes: u64) -> Child {
    long_run_in(&[], out, bytes)
}

fn long_run_in(env: &[(&str, &str)], out: &Path, bytes: u64) -> Child {
    let script = out.with_extension("alb");
    std::fs::write(&script, LONG).unwrap();
    let child = albacore(&script.display().to_string(), out).envs(env.iter().copied()).spawn().unwrap();
    for _ in 0..20_000 {
        if std::fs::metadata(out.join("journal")).is_ok_and(|m| m.len() >= bytes) {
            return child;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the journal does not grow: {}", stderr(&child.wait_with_output().unwrap()));
}

/// A program that can begin no thread cannot be asked to end in good order: a signal ends it as it does any other.
#[test]
fn a_run_without_threads_is_ended_by_a_signal() {
    let out = empty("no-threads");
    // More stack for each thread than any machine has.
    let child = long_run_in(&[("RUST_MIN_STACK", "1000000000000000")], &out, 10_000);
    send("-TERM", &child);
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.signal(), Some(15), "{}", stderr(&ended));
}

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn a_run_leaves_journal_trace_and_picture() {
    let out = empty("leaves");
    let output = albacore(BOX, &out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert!(trace.starts_with("mission box  scenario tidal_stream  seed 1"), "{trace}");
    assert!(std::fs::read_to_string(out.join("run.svg")).unwrap().contains("</svg>"));
    let Ending::Complete(end) = journal(&out).ending else { panic!("the journal is not complete") };
    assert!(String::from_utf8_lossy(&output.stdout).contains(&format!("digest {:016x}", end.ending().unwrap().digest)));
}

#[test]
fn equal_runs_leave_equal_journals_however_the_script_is_named() {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(BOX).display().to_string();
    let journals = [BOX, "./missions/box.alb", "missions/../missions/box.alb", &whole].map(|script| {
        let out = empty("named");
        let output = albacore(script, &out).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{script}: {}", stderr(&output));
        std::fs::read(out.join("journal")).unwrap()
    });
    assert!(journals.iter().all(|journal| *journal == journals[0]));
}

#[test]
fn who_interrupts_a_run_has_all_of_it_up_to_there() {
    for signal in ["-INT", "-TERM"] {
        let out = empty(&format!("interrupted{signal}"));
        let child = long_run(&out, 10_000);
        send(signal, &child);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{signal}: {}", stderr(&output));
        let journal = journal(&out);
        let Ending::Complete(end) = journal.ending else { panic!("{signal}: {:?}", journal.ending) };
        let ending = end.ending().unwrap();
        assert_eq!((ending.outcome.name(), end.tick), ("interrupted", journal.ticks.len() as u64));
        let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
        assert!(trace.contains("interrupted"), "{signal}: {trace}");
        assert!(trace.contains(&format!("{:016x}", ending.digest)), "{signal}: {trace}");
        assert!(out.join("run.svg").exists());
    }
}

#[test]
fn who_kills_a_run_has_a_valid_prefix() {
    for (round, bytes) in [1, 5_000, 50_000, 500_000].into_iter().enumerate() {
        let out = empty(&format!("killed-{round}"));
        let mut child = long_run(&out, bytes);
        child.kill().unwrap();
        child.wait().unwrap();
        let journal = journal(&out);
        assert!(matches!(journal.ending, Ending::CutShort(_)), "{:?}", journal.ending);
        assert_eq!(journal.header.mission, "long");
        assert!(bytes < 5_000 || !journal.ticks.is_empty());
    }
}

#[test]
fn a_full_disk_is_said_once_and_the_mission_goes_on() {
    // The journal is the only file as long as this. The signal that comes with a limit ends nothing either.
    for limit in ["ulimit -f 200", "trap '' XFSZ; ulimit -f 200"] {
        let out = empty("full");
        let output = behind(limit, &albacore(BOX, &out)).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{said}");
        assert_eq!(said.matches("error: ").count(), 1, "{said}");
        assert!(said.contains("full/journal` cannot be written: "), "{said}");
        assert!(String::from_utf8_lossy(&output.stdout).contains("completed"));
        assert!(out.join("trace.txt").exists() && out.join("run.svg").exists());
    }
}

/// What could not be written is told where the outcome is: whoever finds the folder later has not seen the messages.
#[test]
fn a_record_tells_what_could_not_be_written() {
    let out = empty("lost");
    assert_eq!(albacore(BOX, &out).output().unwrap().status.code(), Some(0));
    assert!(lost(&out, "completed").is_empty());
    // A file may grow to 32 KiB: only the journal needs more.
    let out = empty("lost-full");
    let output = behind("ulimit -f 64", &albacore(BOX, &out)).output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert_eq!(lost(&out, "completed"), ["journal"]);
    let out = empty("lost-picture");
    let child = long_run(&out, 10_000);
    std::fs::create_dir(out.join("run.svg")).unwrap();
    send("-TERM", &child);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("run.svg` cannot be written: "), "{}", stderr(&output));
    assert_eq!(lost(&out, "interrupted"), ["run.svg"]);
    assert!(out.join("trace.txt").exists());
}

/// The files that a run's record says were lost, of which it says why; the run has ended so.
fn lost(out: &Path, outcome: &str) -> Vec<String> {
    let text = std::fs::read_to_string(out.join("run.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(record["outcome"], outcome);
    let lost = record["lost"].as_object().unwrap();
    assert!(lost.values().all(|why| why.as_str().is_some_and(|why| !why.is_empty())), "{record}");
    // No digest is told of a file that is not there.
    let is_told = |name: &&String| *name != "journal" && record["files"][name.as_str()].is_string();
    assert!(!lost.keys().any(|name| is_told(&name)), "{record}");
    lost.keys().cloned().collect()
}

/// A mission of days is not begun without what was asked to be kept of it.
#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_first_tick() {
    let script = empty("before").join("long.alb");
    std::fs::write(&script, LONG).unwrap();
    let output = albacore(&script.display().to_string(), Path::new("Cargo.toml/out")).output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert_eq!(said.matches("error: ").count(), 1, "{said}");
    assert!(said.contains("`Cargo.toml/out` cannot be written") && said.contains("--no-out"), "{said}");
    assert!(output.stdout.is_empty());
}

/// A journal that the disk has cut, and into which another program has written since, is told as both.
#[test]
fn a_journal_that_was_cut_and_written_into_is_told_as_both() {
    let out = empty("cut-and-written-into");
    let script = out.with_extension("alb");
    std::fs::write(&script, LONG).unwrap();
    let run = behind("trap '' XFSZ; ulimit -f 16", &albacore(&script.display().to_string(), &out))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let (path, mut before) = (out.join("journal"), 0);
    // Until it grows no more.
    for _ in 0..2_000 {
        std::thread::sleep(Duration::from_millis(100));
        let now = std::fs::metadata(&path).map_or(0, |m| m.len());
        if now > 4_000 && now == before {
            break;
        }
        before = now;
    }
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle..middle + 8].copy_from_slice(b"my notes");
    std::io::Write::write_all(&mut std::fs::OpenOptions::new().write(true).open(&path).unwrap(), &bytes).unwrap();
    send("-TERM", &run);
    let output = run.wait_with_output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(
        said.contains("journal` cannot be written: ") && said.contains("another program has written into it"),
        "{said}"
    );
    let record: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("run.json")).unwrap()).unwrap();
    let why = record["lost"]["journal"].as_str().unwrap();
    assert!(why.contains("os error") && why.ends_with("; another program has written into it"), "{why}");
}
