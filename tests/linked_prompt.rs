//! The prompt of a vehicle at the end of a link: it drives while nobody types, is held by no terminal, and gives the vehicle back however
//! it ends.

#![expect(clippy::panic, clippy::unwrap_used, reason = "a test that cannot start its own programs has failed")]
#![cfg(target_os = "linux")]

use crate::far_end::*;
use crate::held::Terminal;
use std::io::Write;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Output, Stdio};

fn vehicle(folder: &Path) -> Vehicle {
    Vehicle::serve_at(SLOW_RATE, &format!("{EXCURSION}#bay"), "udp:127.0.0.1:0?dialect=recon", folder)
}

fn prompt(vehicle: &Vehicle, more: &[&str]) -> Command {
    let mut command = albacore(&["repl", EXCURSION, "--link", &vehicle.link]);
    command.args(SLOW_RATE).args(more);
    command
}

/// A session that begins with these lines, and its input, which stays open.
fn begun(mut prompt: Command, lines: &str) -> (Child, ChildStdin) {
    let mut child = prompt.stdin(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(lines.as_bytes()).unwrap();
    (child, input)
}

/// A session of these lines, to the end of its input.
fn session(vehicle: &Vehicle, more: &[&str], lines: &str) -> Output {
    let (child, _) = begun(prompt(vehicle, more), lines);
    child.wait_with_output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[track_caller]
fn in_order(said: &str, parts: &[&str]) {
    let mut rest = said;
    for part in parts {
        let (_, after) = rest.split_once(part).unwrap_or_else(|| panic!("`{part}` is missing in\n{said}"));
        rest = after;
    }
}

#[test]
fn a_vehicle_is_driven_line_by_line_and_given_back() {
    let folder = empty("prompt");
    let vehicle = vehicle(&folder);
    let lines = "let home = position\nsteer 90 deg\nrun 10 s\nwhy\nstop\nrun 5 s\nplot heading\nstart\nrun 3 s\nwhy\nrelease\nrun 2 s\nquit\n";
    let output = session(&vehicle, &[], lines);
    assert_eq!((output.status.code(), stderr(&output).lines().count()), (Some(0), 1), "{}", stderr(&output));
    let said = stdout(&output);
    let parts = [
        "home = (",
        "depth 3.0 m",
        "steer 90 deg\nno rule was there to be tried",
        "  stopped",
        "heading",
        "still under way",
        "excursion\nno rule was there to be tried",
        "the vehicle is given back: its own computer drives it, and we listen",
        "depth",
    ];
    in_order(&said, &parts[..5]);
    in_order(&said, &parts[6..]);
    // When these come is the vehicle's to say.
    for part in [
        "control  in control",
        "goes on while you type: `stop` ends it",
        "excursion begins, and goes on",
        "enter    excursion",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    vehicle.says("override taken");
    vehicle.says("override released");
    // Who only listens asks for nothing.
    let (before, output) = (vehicle.said(), session(&vehicle, &[], "depth\nrun 2 s\nchemical\n"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("3 m\n") && stdout(&output).ends_with(" %\n"), "{}", stdout(&output));
    assert!(!vehicle.said()[before.len()..].contains("override taken"));
}

#[test]
fn what_only_a_simulated_vehicle_does_is_refused() {
    let folder = empty("prompt-refused");
    let vehicle = vehicle(&folder);
    let output =
        session(&vehicle, &[], "back 3 s\nfork a\nsave test \"it\" to it.alb\nstart\nset lambda = 4 s\nreload\nquit\n");
    assert_eq!(output.status.code(), Some(3));
    let said = stderr(&output);
    let parts = [
        "does not go back in time",
        "does not go back in time",
        "is no test",
        "a mission under way on a vehicle is not changed",
        "a mission under way on a vehicle is not changed",
    ];
    in_order(&said, &parts);
    let long = "1 + ".repeat(20_000) + "1\n";
    let asks =
        "payload camera { start() -> Bool }\nsteer 90 deg\nlet shot = ask camera.start() within 10 s\nbehavior\n";
    let output = session(&vehicle, &[], &(asks.to_string() + &long));
    in_order(&stderr(&output), &["no link carries that", "65536 bytes at most"]);
    in_order(&stdout(&output), &["goes on while you type", "steer 90 deg\n"]);
    let nothing = empty("prompt-usage");
    for words in
        [vec!["repl", "--link", "udp:127.0.0.1:1"], vec!["repl", EXCURSION, "--link", "udp:127.0.0.1:1", "--in", "bay"]]
    {
        let output = albacore(&words).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    }
    let output = albacore(&["repl", &nothing.display().to_string(), "--link", "udp:127.0.0.1:1"]).output().unwrap();
    assert!(output.status.code() == Some(2) && stderr(&output).contains("has no link"), "{}", stderr(&output));
}

/// A guest's mission gives the vehicle back between its overrides, at the prompt too.
#[test]
fn a_guest_drives_in_its_overrides_alone_at_the_prompt() {
    let folder = empty("prompt-guest");
    let vehicle = vehicle(&folder);
    let output = session(&vehicle, &["--mission", "visit"], "start\nrun until depth > 2 m\nrun\nquit\n");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // It watches for 5 s, in which the vehicle is not ours.
    in_order(&stdout(&output), &["depth > 2 m\n", "control  in control"]);
    assert_eq!(vehicle.said().matches("override taken").count(), 2, "{}", vehicle.said());
    assert_eq!(vehicle.said().matches("override released").count(), 2, "{}", vehicle.said());
    in_order(&stdout(&output), &["completed, the vehicle is", "completed, the vehicle is", "end      completed"]);
}

#[test]
fn a_vehicle_that_goes_away_is_told_at_the_prompt() {
    let folder = empty("prompt-away");
    let mut vehicle = vehicle(&folder);
    let (child, mut input) = begun(prompt(&vehicle, &[]), "steer 90 deg\n");
    vehicle.says("override taken");
    vehicle.child.kill().unwrap();
    input.write_all(b"run 10 min\nsteer 3 deg\nplot depth\nquit\n").unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    in_order(&stderr(&output), &["the link is lost", "the link is lost", "did not say that it has taken control back"]);
    in_order(&stdout(&output), &["end      link_lost", "depth"]);
}

/// The next of lines that nobody types would set the vehicle in motion again.
#[test]
fn ctrl_c_ends_a_session_of_a_pipe() {
    let folder = empty("prompt-pipe");
    let vehicle = vehicle(&folder);
    let lines = "goto point(north: 150 m, east: 0 m)\ngoto point(north: 0 m, east: 0 m)\n";
    let (child, _input) = begun(prompt(&vehicle, &[]), lines);
    vehicle.says("override taken");
    std::thread::sleep(std::time::Duration::from_millis(300));
    send("-INT", &child);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    in_order(&stdout(&output), &["  stopped", "the vehicle has taken control back"]);
    vehicle.says("override released");
}

/// Wherever it comes: while nothing is waited for, too.
#[test]
fn ctrl_c_between_two_lines_ends_a_session_of_a_pipe() {
    let folder = empty("prompt-between");
    let vehicle = vehicle(&folder);
    let (mut child, _input) = begun(prompt(&vehicle, &[]), "steer 90 deg\n");
    vehicle.says("override taken");
    send("-INT", &child);
    // Nobody has closed its input.
    assert_eq!(eventually("the end", || child.try_wait().unwrap()).code(), Some(1));
    vehicle.says("override released");
    assert_eq!(vehicle.said().matches("override taken").count(), 1, "{}", vehicle.said());
}

/// A vehicle that has not answered yet is not taken any more, and what is not ours is not said to be stopped.
#[test]
fn stop_withdraws_a_request_for_control() {
    let folder = empty("prompt-withdrawn");
    let world = folder.join("slow.alb");
    let text = std::fs::read_to_string(EXCURSION).unwrap();
    let start = "start: 36°10.746'N 75°44.427'W";
    let text = text.replace("start: point(north: -100 m, east: -40 m)", start);
    let slow = "\nscenario slow = bay with { handover(after: 10 s) }\n";
    std::fs::write(&world, text + slow).unwrap();
    let world = format!("{}#slow", world.display());
    let vehicle = Vehicle::serve_at(SLOW_RATE, &world, "udp:127.0.0.1:0?dialect=recon", &folder);
    let output = session(&vehicle, &[], "stop\nsteer 90 deg\nrun 2 s\nstop\nrun 15 s\nquit\n");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let parts = ["nothing of ours is under way", "goes on while you type", "control is not asked for any more"];
    in_order(&stdout(&output), &parts);
    assert!(!vehicle.said().contains("override taken"), "{}", vehicle.said());
}

#[test]
fn what_was_named_is_plotted_as_it_was_and_the_frame_stays_where_it_is() {
    let folder = empty("prompt-named");
    let vehicle = vehicle(&folder);
    let script = folder.join("excursion.alb");
    let text = std::fs::read_to_string(EXCURSION).unwrap();
    std::fs::write(&script, &text).unwrap();
    let mut command = albacore(&["repl", script.to_str().unwrap(), "--link", &vehicle.link]);
    command.args(SLOW_RATE);
    let (child, mut input) = begun(command, "steer 90 deg\nvar x = 1\nrun 5 s\nx = 5\nrun 5 s\nplot x\nstop\n");
    vehicle.says("override taken");
    std::fs::write(&script, text.replace("36°10.8'N", "36°10.83'N")).unwrap();
    input.write_all(b"reload\nquit\n").unwrap();
    let output = child.wait_with_output().unwrap();
    let said = stdout(&output);
    let has = |value: &str| said.lines().any(|line| line.starts_with(&format!("       {value} ")));
    assert!(has("5") && has("1"), "from 1 to 5:\n{said}");
    assert!(stderr(&output).contains("where the mission's frame lies on the globe"), "{}", stderr(&output));
}

/// A session at a terminal, once it drives.
fn driving(vehicle: &Vehicle, terminal: &mut Terminal) -> Child {
    let mut command = prompt(vehicle, &[]);
    // Ctrl-Z is for all that a shell began together.
    command.process_group(0).stdin(terminal.line()).stdout(terminal.line()).stderr(terminal.line());
    let child = command.env("TERM", "xterm").spawn().unwrap();
    terminal.says("> ");
    terminal.types("steer 90 deg\r");
    vehicle.says("override taken");
    terminal.says("goes on while you type");
    child
}

#[test]
fn what_happens_is_printed_above_the_line_and_ctrl_c_stops_the_motion() {
    let folder = empty("prompt-typed");
    let vehicle = vehicle(&folder);
    let mut terminal = Terminal::new();
    let mut child = driving(&vehicle, &mut terminal);
    terminal.types("\x03");
    terminal.says("stopped");
    // What was pasted behind a line that is stopped is not done.
    terminal.types("goto point(north: 150 m, east: 0 m)\rgoto point(north: -150 m, east: 0 m)\r");
    std::thread::sleep(std::time::Duration::from_secs(1));
    // As Ctrl-C does while nothing is typed: this terminal is no shell's.
    send("-INT", &child);
    terminal.says("stopped");
    // What is typed before the editor is there is dropped, too.
    std::thread::sleep(std::time::Duration::from_millis(500));
    terminal.types("position.north > -130 m\r");
    // Who had gone on to the second goal would be answered there, at -145 m.
    terminal.says("true");
    terminal.types("start\r");
    terminal.says("begin      goto point(north: -20 m");
    terminal.types("\x1a");
    terminal.types("position\r");
    terminal.says("Ctrl-Z would leave the vehicle without commands");
    std::thread::sleep(std::time::Duration::from_millis(500));
    terminal.types("\x04");
    assert_eq!(eventually("the end", || child.try_wait().unwrap()).code(), Some(0));
    vehicle.says("override released");
    assert!(!vehicle.said().contains("timed out"), "{}", vehicle.said());
}

#[test]
fn a_frozen_terminal_holds_no_prompt_and_a_signal_gives_the_vehicle_back() {
    let folder = empty("prompt-frozen");
    let vehicle = vehicle(&folder);
    for signal in ["-TERM", "-HUP"] {
        let before = vehicle.said().matches("override released").count();
        let mut terminal = Terminal::new();
        let mut child = driving(&vehicle, &mut terminal);
        terminal.types("start\r");
        terminal.says("excursion begins");
        terminal.types("\x13");
        // Some ten seconds of the vehicle's time, which leaves who is silent for 5 s.
        std::thread::sleep(std::time::Duration::from_secs(2));
        assert!(!vehicle.said().contains("timed out"), "{}", vehicle.said());
        send(signal, &child);
        assert_eq!(eventually("the end", || child.try_wait().unwrap()).code(), Some(1));
        eventually("a release", || {
            Some(vehicle.said()).filter(|said| said.matches("override released").count() > before)
        });
    }
}
