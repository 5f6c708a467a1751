//! A run on a link is held by nothing but its vehicle: not by a terminal that takes nothing, not by a pause; and every signal
//! that ends a program gives the vehicle back.
//!
//! Nothing is timed: what is waited for is waited for long.

#![expect(clippy::unwrap_used, reason = "a test that cannot start its own programs has failed")]
#![cfg(target_os = "linux")]

use crate::far_end::*;
use crate::shell::behind;
use albacore_trace::journal::{Ending, Journal};
use nix::fcntl::OFlag;
use nix::pty::{PtyMaster, grantpt, posix_openpt, ptsname_r, unlockpt};
use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Stdio};

/// A terminal with somebody at it, who reads nothing unless asked.
pub struct Terminal {
    person: PtyMaster,
    line: File,
}

impl Terminal {
    pub fn new() -> Self {
        let person = posix_openpt(OFlag::O_RDWR | OFlag::O_NOCTTY).unwrap();
        grantpt(&person).unwrap();
        unlockpt(&person).unwrap();
        let path = ptsname_r(&person).unwrap();
        let line = File::options().read(true).write(true).custom_flags(OFlag::O_NOCTTY.bits()).open(path).unwrap();
        Terminal { person, line }
    }

    pub fn line(&self) -> Stdio {
        self.line.try_clone().unwrap().into()
    }

    pub fn types(&mut self, keys: &str) {
        self.person.write_all(keys.as_bytes()).unwrap();
    }

    fn ctrl_s(&mut self) {
        self.types("\x13");
    }

    /// Reads until this was said.
    pub fn says(&mut self, what: &str) {
        let mut said = Vec::new();
        let mut part = [0; 1024];
        while !String::from_utf8_lossy(&said).contains(what) {
            let count = self.person.read(&mut part).unwrap();
            assert!(count > 0, "{}", String::from_utf8_lossy(&said));
            said.extend_from_slice(&part[..count]);
        }
    }
}

#[track_caller]
fn ended(child: &mut Child) -> std::process::ExitStatus {
    eventually("the end of the run", || child.try_wait().unwrap())
}

#[test]
fn a_frozen_terminal_holds_neither_commands_nor_the_end() {
    let folder = empty("frozen");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let mut terminal = Terminal::new();
    let out = folder.join("run");
    let mut run = vehicle.mission(&["--mission", "stay", "--out"]);
    let mut run = run.arg(&out).stdout(terminal.line()).stderr(terminal.line()).spawn().unwrap();
    vehicle.says("override taken");
    // The progress is drawn ten times a second.
    terminal.says("stay");
    terminal.ctrl_s();
    let journal = out.join("journal");
    let bytes = std::fs::metadata(&journal).unwrap().len();
    // Some two minutes of the vehicle's time, which leaves who is silent for 5 s.
    grown(&journal, bytes + 150_000);
    assert!(!vehicle.said().contains("timed out"), "{}", vehicle.said());
    assert!(run.try_wait().unwrap().is_none());
    send("-TERM", &run);
    assert_eq!(ended(&mut run).code(), Some(4), "its result was told to nobody");
    vehicle.says("override released");
    assert!(!vehicle.said().contains("timed out"), "{}", vehicle.said());
    let journal = Journal::read(&std::fs::read(journal).unwrap()).unwrap();
    assert!(matches!(journal.ending, Ending::Complete(_)), "{:?}", journal.ending);
    assert!(out.join("trace.txt").exists() && out.join("run.svg").exists());
}

#[test]
fn a_frozen_terminal_does_not_hold_the_served_vehicle() {
    let folder = empty("frozen-vehicle");
    let mut terminal = Terminal::new();
    let mut command = albacore(&["vehicle", &format!("{EXCURSION}#bay"), "--link", "udp:127.0.0.1:0?dialect=recon"]);
    let mut vehicle = command.args(RATE).stderr(terminal.line()).spawn().unwrap();
    let mut said = String::new();
    let mut part = [0; 1024];
    while !said.contains("?dialect=recon") {
        let count = terminal.person.read(&mut part).unwrap();
        said.push_str(&String::from_utf8_lossy(&part[..count]));
    }
    terminal.ctrl_s();
    let link = said.split("link open at ").nth(1).unwrap().split_whitespace().next().unwrap().to_string();
    let out = folder.join("run");
    let mut run = albacore(&["run", EXCURSION, "--link", &link, "--out"]);
    let output = run.args([&out.display().to_string(), RATE[0], RATE[1]]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    send("-TERM", &vehicle);
    assert_eq!(ended(&mut vehicle).code(), Some(4), "what it had to say was told to nobody");
}

/// What is said before the first tick waits like the rest: of the script, of the link, and what the progress draws.
#[test]
fn a_terminal_that_is_frozen_before_the_start_holds_neither_end() {
    let folder = empty("frozen-before");
    let free = std::net::UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let link = format!("udp:127.0.0.1:{free}?dialect=recon");
    let mut terminals = [Terminal::new(), Terminal::new()];
    terminals.iter_mut().for_each(Terminal::ctrl_s);
    let mut vehicle = albacore(&["vehicle", &format!("{EXCURSION}#bay"), "--link", &link]);
    let mut vehicle = vehicle.args(RATE).stderr(terminals[0].line()).spawn().unwrap();
    let out = folder.join("run");
    let mut run = albacore(&["run", EXCURSION, "--link", &link, "--out", &out.display().to_string()]);
    let mut run = run.args(RATE).stdout(terminals[1].line()).stderr(terminals[1].line()).spawn().unwrap();
    assert_eq!(ended(&mut run).code(), Some(4), "its result was told to nobody");
    assert!(std::fs::read_to_string(out.join("run.json")).unwrap().contains("\"outcome\": \"completed\""));
    send("-TERM", &vehicle);
    assert_eq!(ended(&mut vehicle).code(), Some(4), "what it had to say was told to nobody");
}

#[test]
fn every_signal_that_ends_a_program_gives_the_vehicle_back() {
    let folder = empty("signals");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let signals = ["INT", "TERM", "QUIT", "HUP", "USR1", "USR2", "ALRM", "VTALRM", "PROF", "IO", "ABRT", "XCPU"]
        .into_iter()
        .chain(["TRAP", "SYS", "PWR", "STKFLT", "34", "50", "64", "ILL", "FPE", "SEGV", "BUS", "XFSZ"])
        .filter(|signal| !is_ignored(signal));
    for (count, signal) in (1..).zip(signals) {
        let mut run = vehicle.mission(&["--mission", "stay", "--no-out"]).spawn().unwrap();
        eventually(signal, || (vehicle.said().matches("override taken").count() == count).then_some(()));
        send(&format!("-{signal}"), &run);
        let status = ended(&mut run);
        assert_eq!((status.code(), status.signal()), (Some(1), None), "{signal}: {}", vehicle.said());
        eventually(signal, || (vehicle.said().matches("override released").count() == count).then_some(()));
    }
    let (_, said) = vehicle.stop();
    assert!(!said.contains("timed out"), "{said}");
}

/// Whether who began the tests wants them, and all that they begin, to be deaf to a signal: a shell does in the background, and `nohup`.
fn is_ignored(signal: &str) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap();
    let mask = u64::from_str_radix(mask.trim(), 16).unwrap();
    ["HUP", "QUIT"].iter().zip([1, 3]).any(|(name, number)| *name == signal && mask >> (number - 1) & 1 == 1)
}

/// A file that may grow no further is the disk's trouble, and no reason to end a mission, though the system sends a signal with it.
#[test]
fn a_limit_of_a_file_ends_nothing() {
    let folder = empty("limit");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let run = vehicle.mission(&["--out", &out.display().to_string()]);
    let mut limited = behind("ulimit -f 12", &run);
    let output = limited.output().unwrap();
    let (said, told) = (stderr(&output), String::from_utf8_lossy(&output.stdout));
    assert!(output.status.code() == Some(4) && said.contains("journal` cannot be written"), "{said}");
    assert!(told.contains("completed"), "{told}");
    assert!(std::fs::read_to_string(out.join("run.json")).unwrap().contains("\"outcome\": \"completed\""));
    vehicle.says("override released");
}

#[test]
fn what_is_to_be_ignored_ends_nothing() {
    let folder = empty("nohup");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let run = vehicle.mission(&["--mission", "stay", "--no-out"]);
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]).arg(run.get_program()).args(run.get_args());
    shell.current_dir(env!("CARGO_MANIFEST_DIR")).stdout(Stdio::null()).stderr(Stdio::null());
    let mut run = shell.spawn().unwrap();
    vehicle.says("override taken");
    send("-HUP", &run);
    send("-HUP", &run);
    std::thread::sleep(std::time::Duration::from_millis(500));
    assert!(run.try_wait().unwrap().is_none() && !vehicle.said().contains("override released"));
    send("-TERM", &run);
    assert_eq!(ended(&mut run).code(), Some(1));
}

/// Who began the program may have blocked signals: that is passed on, and nobody means it.
#[test]
fn signals_that_were_blocked_are_heard() {
    let folder = empty("blocked");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    for (count, signal) in (1..).zip(["TERM", "HUP", "64"]) {
        let run = vehicle.mission(&["--mission", "stay", "--no-out"]);
        let mut blocking = std::process::Command::new("env");
        blocking.arg("--block-signal").arg(run.get_program()).args(run.get_args());
        blocking.current_dir(env!("CARGO_MANIFEST_DIR")).stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = blocking.spawn().unwrap();
        eventually(signal, || (vehicle.said().matches("override taken").count() == count).then_some(()));
        send(&format!("-{signal}"), &run);
        assert_eq!(ended(&mut run).code(), Some(1), "{signal}");
        eventually(signal, || (vehicle.said().matches("override released").count() == count).then_some(()));
    }
}

/// Without a file to hear signals with, nothing would give the vehicle back: it is not taken.
#[test]
fn a_run_that_would_hear_no_signal_takes_no_vehicle() {
    let folder = empty("deaf");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let mut said = String::new();
    // How many files are open before depends on who began the tests.
    let is_told = (4..20).any(|files| {
        let run = vehicle.mission(&["--no-out"]);
        let output = behind(&format!("ulimit -n {files}"), &run).stdin(Stdio::null()).output().unwrap();
        let told = stderr(&output).contains("signals cannot be heard");
        assert!(!told || output.status.code() == Some(4), "{}", stderr(&output));
        said += &stderr(&output);
        told
    });
    assert!(is_told && !vehicle.said().contains("override taken"), "{said}");
}

/// Where nobody listens to signals either, the request to terminate ends what was begun with it ignored.
#[test]
fn what_is_to_be_ignored_is_not_the_request_to_terminate() {
    for verb in [&["repl"][..], &["fmt", "-"]] {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", "trap '' INT TERM; exec \"$0\" \"$@\""]).arg(env!("CARGO_BIN_EXE_albacore")).args(verb);
        let mut child = shell.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // It waits for what is typed: who asks again and again asks once when it does.
        let status = eventually("the end", || {
            send("-TERM", &child);
            child.try_wait().unwrap()
        });
        assert_eq!(status.signal(), Some(15), "{verb:?}");
    }
}

/// A variable of the environment that makes stacks small would overflow them once the vehicle is ours.
#[test]
fn no_environment_makes_a_stack_too_small() {
    let folder = empty("stack");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let output = vehicle.mission(&["--no-out"]).env("RUST_MIN_STACK", "1").output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    vehicle.says("override released");
}

#[test]
fn ctrl_z_leaves_no_vehicle_without_commands() {
    let folder = empty("ctrl-z");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let log = folder.join("run.log");
    let mut run = vehicle.mission(&["--mission", "stay", "--no-out"]);
    let mut run = run.stderr(File::create(&log).unwrap()).spawn().unwrap();
    vehicle.says("override taken");
    send("-TSTP", &run);
    eventually("a word on Ctrl-Z", || {
        std::fs::read_to_string(&log).unwrap().contains("Ctrl-Z would leave the vehicle").then_some(())
    });
    send("-INT", &run);
    assert_eq!(ended(&mut run).code(), Some(1));
    assert!(!vehicle.said().contains("timed out"), "{}", vehicle.said());
}

#[test]
fn after_a_pause_nothing_is_sent_to_a_vehicle_that_has_left() {
    std::thread::scope(|scope| {
        for (name, link) in [("pause-pty", "pty:?dialect=recon"), ("pause-udp", "udp:127.0.0.1:0?dialect=recon")] {
            scope.spawn(move || after_a_pause(name, link));
        }
    });
}

fn after_a_pause(name: &str, link: &str) {
    let folder = empty(name);
    let vehicle = Vehicle::serve(link, &folder);
    let mut run = vehicle.driven(&["--no-out"]);
    send("-STOP", &run);
    vehicle.says("override timed out");
    vehicle.says("returns");
    send("-CONT", &run);
    let code = ended(&mut run).code();
    let said = vehicle.said();
    // A line may be full meanwhile, and the vehicle's last word lost: then it is silent, and lost.
    assert!(matches!(code, Some(1 | 4)), "{name}: {code:?} {said}");
    assert!(!said.contains("refused"), "a command to a vehicle that nobody drives: {said}");
}

#[test]
fn a_second_signal_ends_a_program_that_is_held() {
    let mut terminal = Terminal::new();
    terminal.ctrl_s();
    let mut run = albacore(&["run", "missions/box.alb", "--no-out"]);
    let mut run = run.stdout(terminal.line()).stderr(terminal.line()).spawn().unwrap();
    // A simulated run waits for its terminal; the first signal asks it to end, and it does not come to that.
    let status = eventually("an end at last", || {
        send("-TERM", &run);
        std::thread::sleep(std::time::Duration::from_millis(400));
        run.try_wait().unwrap()
    });
    assert!(status.code() == Some(128 + 15) || status.signal() == Some(15), "{status:?}");
}

/// The attack: a campaign that had its table, and whose result nobody took, heard the first request to end and went on waiting.
#[test]
fn the_first_signal_ends_a_program_whose_result_nobody_takes() {
    let mut terminal = Terminal::new();
    let folder = empty("result-held");
    let table = folder.join("t.csv");
    terminal.ctrl_s();
    let words = ["campaign", "missions/box.alb", "--seeds", "1..2", "--json", "--out"];
    let mut campaign = albacore(&words);
    let mut campaign = campaign.arg(&table).stdout(terminal.line()).stderr(Stdio::null()).spawn().unwrap();
    eventually("a table", || std::fs::read_to_string(&table).ok().filter(|rows| rows.lines().count() == 3));
    std::thread::sleep(std::time::Duration::from_millis(1500));
    assert!(campaign.try_wait().unwrap().is_none(), "it waits for its terminal");
    send("-TERM", &campaign);
    let status = eventually("an end", || campaign.try_wait().unwrap());
    assert!(status.code() == Some(128 + 15) || status.signal() == Some(15), "{status:?}");
}
