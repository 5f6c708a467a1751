//! The two ends of a link as two programs: a mission drives a vehicle over a real pseudo terminal and over UDP, and what each
//! says when the other goes away.
//!
//! Time runs fifty times faster than real time, and nothing is timed: what is waited for is waited for long.

#![expect(clippy::unwrap_used, reason = "a test that cannot start its own programs has failed")]
#![cfg(unix)]

use crate::far_end::*;
use albacore_trace::journal::{Ending, Journal};
use std::net::UdpSocket;
use std::process::Output;
use std::time::Duration;

/// A mission takes over, drives, gives back; the vehicle returns to where it was taken and goes on with its row.
fn there_and_back(name: &str, link: &str) {
    let folder = empty(name);
    let vehicle = Vehicle::serve(link, &folder);
    let out = folder.join("run");
    let output = vehicle.mission(&["--json", "--out"]).arg(&out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}\n{}", stderr(&output), vehicle.said());
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&result["outcome"], &result["scenario"]), (&"completed".into(), &vehicle.link.clone().into()));
    let end = &result["reports"][0];
    let metres = |name: &str| end[name].as_f64().unwrap();
    assert!((metres("north_m") - 30.0).abs() < 20.0 && (metres("east_m") - 60.0).abs() < 20.0, "{end}");
    assert!(end["error_m"].is_null(), "nobody knows the truth");
    let way = result["path_length_m"].as_f64().unwrap();
    assert!((50.0..1500.0).contains(&way), "{way} m");
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert!(trace.contains("control  in control") && trace.contains("end      completed"), "{trace}");
    assert!(out.join("run.svg").exists());
    let journal = Journal::read(&std::fs::read(out.join("journal")).unwrap()).unwrap();
    assert!(matches!(journal.ending, Ending::Complete(_)), "{:?}", journal.ending);
    // Other programs are given it as they are a simulated one, without a truth.
    let exported = albacore(&["export"]).arg(&out).args(["--csv", "--netcdf", "--mcap"]).output().unwrap();
    assert_eq!((exported.status.code(), stderr(&exported).as_str()), (Some(0), ""));
    let table = std::fs::read_to_string(out.join("export/track.csv")).unwrap();
    assert_eq!(table.lines().count(), journal.ticks.len() + 1);
    assert!(table.starts_with("time (s),north (m),east (m),latitude (deg)") && !table.contains("truth."));
    let mut replay = std::process::Command::new(env!("CARGO_BIN_EXE_albacore"));
    let replayed = replay.arg("replay").arg(&out).output().unwrap();
    let told = String::from_utf8_lossy(&replayed.stdout).into_owned();
    assert!(told.contains("the same to the bit") && replayed.status.success(), "{told}{}", stderr(&replayed));
    vehicle.says("override released");
    vehicle.says("resumes leg");
    // It can be had again.
    let again = vehicle.mission(&["--no-out"]).output().unwrap();
    assert_eq!(again.status.code(), Some(0), "{}\n{}", stderr(&again), vehicle.said());
    let (code, said) = vehicle.stop();
    assert_eq!(code, Some(0));
    assert!(!said.contains("timed out") && !said.contains("could not be read"), "{said}");
}

#[test]
fn a_mission_drives_a_vehicle_over_a_pseudo_terminal() {
    there_and_back("pty", "pty:?dialect=recon");
}

#[test]
fn a_mission_drives_a_vehicle_over_udp() {
    there_and_back("udp", "udp:127.0.0.1:0?dialect=recon");
}

#[test]
fn a_guest_drives_in_its_overrides_alone() {
    let folder = empty("guest");
    let vehicle = Vehicle::serve_at(SLOW_RATE, &format!("{EXCURSION}#bay"), "pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let output = vehicle.mission(&["--mission", "visit", "--out"]).arg(&out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}\n{}", stderr(&output), vehicle.said());
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert_eq!(trace.matches("completed, the vehicle is in_mission").count(), 2, "{trace}");
    assert_eq!(trace.matches("control  in control").count(), 2, "{trace}");
    assert!(!trace.contains("released"), "nothing is left to give back: {trace}");
    let (code, said) = vehicle.stop();
    assert_eq!(code, Some(0));
    assert_eq!(said.matches("override taken").count(), 2, "{said}");
    assert_eq!(said.matches("override released").count(), 2, "{said}");
    assert!(!said.contains("timed out"), "{said}");
}

/// What a scenario says of the handover holds at the end of a link too.
#[test]
fn a_vehicle_is_slow_to_give_way_and_takes_itself_back() {
    let folder = empty("slow");
    let vehicle = Vehicle::serve_world(&format!("{EXCURSION}#slow_to_trust"), "pty:?dialect=recon", &folder);
    let run = vehicle.driven(&["--no-out"]);
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("released by vehicle"), "{output:?}");
    vehicle.says("override taken back");
}

/// ... and may be asked once more in the same tick.
#[test]
fn a_vehicle_that_has_taken_itself_back_is_asked_again() {
    let folder = empty("again");
    let vehicle = Vehicle::serve_world(&format!("{EXCURSION}#slow_to_trust"), "pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let output = vehicle.mission(&["--mission", "once_more", "--out"]).arg(&out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}\n{}", stderr(&output), vehicle.said());
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert!(trace.contains("taken_back, completed"), "{trace}");
}

/// A guest that is held lives on all the same.
#[test]
fn a_vehicle_takes_itself_back_from_a_guest_that_is_held() {
    let folder = empty("held");
    let vehicle = Vehicle::serve_world(&format!("{EXCURSION}#held_and_taken"), "pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let output = vehicle.mission(&["--mission", "held", "--out"]).arg(&out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}\n{}", stderr(&output), vehicle.said());
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert!(trace.contains("stale") && trace.contains("log      taken_back"), "{trace}");
}

#[test]
fn a_vehicle_whose_guest_is_killed_goes_back_to_its_legs() {
    let folder = empty("killed");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let mut run = vehicle.driven(&["--out", &out.display().to_string()]);
    grown(&out.join("journal"), 2000);
    run.kill().unwrap();
    run.wait().unwrap();
    vehicle.says("override timed out: no message for 5 s");
    vehicle.says("resumes leg");
    let journal = Journal::read(&std::fs::read(out.join("journal")).unwrap()).unwrap();
    assert!(matches!(journal.ending, Ending::CutShort(_)), "{:?}", journal.ending);
}

/// The person who cleans up in the wrong window is told while the mission lasts.
#[test]
fn files_that_go_away_under_a_run_are_told_at_once() {
    let folder = empty("gone");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    for gone in ["journal", "run.json", ""] {
        let (out, said) = (folder.join("run"), folder.join("said"));
        let mut run = vehicle.mission(&["--mission", "stay", "--out"]);
        let mut run = run.arg(&out).stderr(std::fs::File::create(&said).unwrap()).spawn().unwrap();
        grown(&out.join("journal"), 2000);
        let moved = folder.join("moved");
        std::fs::rename(out.join(gone), &moved).unwrap();
        let said = || std::fs::read_to_string(&said).unwrap();
        eventually(gone, || said().contains("this run's any more: it was removed or replaced").then_some(()));
        assert!(said().contains("the mission goes on") && run.try_wait().unwrap().is_none(), "{}", said());
        send("-INT", &run);
        assert_eq!(run.wait().unwrap().code(), Some(4), "{}", said());
        for left in [&moved, &out] {
            let _ = if left.is_dir() { std::fs::remove_dir_all(left) } else { std::fs::remove_file(left) };
        }
    }
}

#[test]
fn who_interrupts_a_mission_gives_the_vehicle_back() {
    let folder = empty("interrupted");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let run = vehicle.driven(&["--no-out"]);
    send("-INT", &run);
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("interrupted"));
    vehicle.says("override released");
    vehicle.says("resumes leg");
    let (code, said) = vehicle.stop();
    assert_eq!(code, Some(0));
    assert!(!said.contains("timed out"), "{said}");
}

#[test]
fn a_vehicle_that_goes_away_is_told_with_4() {
    let folder = empty("gone");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let run = vehicle.driven(&["--no-out"]);
    assert_eq!(vehicle.stop().0, Some(0));
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("is gone"), "{}", stderr(&output));
}

#[test]
fn what_goes_beyond_a_vehicles_limits_is_in_the_trace() {
    let folder = empty("refused");
    let vehicle = Vehicle::serve_world(&format!("{EXCURSION}#with_limits"), "pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let heard = folder.join("run.log");
    let mut run = vehicle.mission(&["--mission", "dive", "--out", &out.display().to_string()]);
    let mut run = run.stderr(std::fs::File::create(&heard).unwrap()).spawn().unwrap();
    // A computer that is late commands nothing for a while, and what it did not command is not doubted.
    eventually("a doubt", || std::fs::read_to_string(&heard).unwrap().contains("does not follow").then_some(()));
    send("-INT", &run);
    assert_eq!(run.wait().unwrap().code(), Some(1));
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    let error = "s  vehicle  the vehicle says: error 2, is asked to go deeper than 18.50 m: it stays there";
    assert!(trace.contains(error), "{trace}");
    assert!(trace.contains("s  vehicle  the vehicle does not follow `#C,Depth,Altitude,0.50`"), "{trace}");
}

#[test]
fn a_vehicle_that_falls_silent_is_told_with_4() {
    let folder = empty("silent");
    let vehicle = Vehicle::serve("udp:127.0.0.1:0?dialect=recon", &folder);
    let out = folder.join("run");
    let run = vehicle.driven(&["--out", &out.display().to_string()]);
    grown(&out.join("journal"), 20_000);
    assert_eq!(vehicle.stop().0, Some(0));
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("link lost"), "{}", stderr(&output));
    assert!(stderr(&output).contains("leaves override by itself"), "{}", stderr(&output));
}

/// Runs the mission against a peer that says the same line again and again.
fn against(line: Option<&str>) -> Output {
    let peer = UdpSocket::bind("127.0.0.1:0").unwrap();
    peer.set_read_timeout(Some(Duration::from_millis(50))).unwrap();
    let link = format!("udp:127.0.0.1:{}?dialect=recon", peer.local_addr().unwrap().port());
    let mut run = albacore(&["run", EXCURSION, "--no-out", "--link", &link]).spawn().unwrap();
    let mut guest = None;
    let ended = eventually("the end of the run", || {
        let mut buffer = [0; 1024];
        guest = peer.recv_from(&mut buffer).ok().map(|(_, from)| from).or(guest);
        if let (Some(line), Some(guest)) = (line, guest) {
            let _ = peer.send_to(line.as_bytes(), guest);
        }
        run.try_wait().unwrap()
    });
    assert_eq!(ended.code(), Some(4));
    run.wait_with_output().unwrap()
}

#[test]
fn silence_another_dialect_and_a_stopped_clock_are_told_apart() {
    // Each takes 5 s of silence: all at once.
    let told = [
        None,
        Some("$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n"),
        Some("#V,Sep 14 2011, 13:17:09,*81\n"),
    ];
    let [silent, other, version] =
        std::thread::scope(|scope| told.map(|told| scope.spawn(move || against(told))).map(|run| run.join().unwrap()));
    assert!(silent.stdout.is_empty(), "there is no result: {}", String::from_utf8_lossy(&silent.stdout));
    let silent = stderr(&silent);
    assert!(silent.contains("nothing came from `udp:127.0.0.1:"), "{silent}");
    assert_eq!(silent.matches("check that the vehicle is on").count(), 1, "{silent}");
    let other = stderr(&other);
    assert!(other.contains("none of them can be read as `recon`"), "{other}");
    let version = stderr(&version);
    assert!(version.contains("no state (`#S`)"), "{version}");
}

#[track_caller]
fn ends_with(args: &[&str], code: i32, said: &str) {
    let output = albacore(args).output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {text}");
    assert!(text.contains(said), "{args:?} should say `{said}`: {text}");
}

#[test]
fn what_is_asked_for_wrongly_is_told() {
    let run =
        |link: &str, code: i32, said: &str| ends_with(&["run", EXCURSION, "--no-out", "--link", link], code, said);
    run("/dev/ttyUSB0", 2, "is no link");
    run("udp:10.0.0.1?dialect=recon", 2, "has no port");
    run("serial:/dev/x?dialect=rekon", 2, "did you mean `recon`?");
    run("serial:/dev/there-is-no-such-port?dialect=recon", 4, "there is no port");
    run("tcp:10.0.0.1:23456?dialect=recon", 2, "not built yet");
    run("serial:/dev/x?dialect=recon&baud=0", 2, "0 baud");
    run("udp:127.0.0.1:0?dialect=recon", 4, "at port 0");
    ends_with(&["vehicle", "duck_2003", "--link", "tcp:x"], 2, "not built yet");
    run("pty:?dialect=recon", 4, "at which no vehicle waits");
    let serve = |world: &str, said: &str| ends_with(&["vehicle", world, "--link", "pty:?dialect=recon"], 2, said);
    serve("dock_2003", "did you mean `duck_2003`?");
    serve(&format!("{EXCURSION}#bey"), "did you mean `bay`?");
    serve("tests/link/excursions.alb#bay", "there is no file");
    let rows = ["vehicle", "duck_2003", "--link", "pty:?dialect=recon", "--rows", "6"];
    ends_with(&rows, 2, "LENGTHxSPACINGxCOUNT");
    ends_with(&["run", EXCURSION, "--rate", "0"], 2, "from 0.1 to 1000");
    ends_with(
        &["run", "tests/rules/11_abort.alb", "--no-out", "--link", "pty:?dialect=recon"],
        2,
        "no place on the globe",
    );
    // Before it has taken over: no vehicle need be there.
    ends_with(
        &["run", "tests/link/dated.alb", "--no-out", "--link", "udp:127.0.0.1:47812?dialect=recon"],
        2,
        "the mission requires `utc`, which this vehicle does not deliver; it delivers position, course,",
    );
}

/// The vehicle's own declaration says what it speaks, to both ends.
#[test]
fn the_dialect_of_a_vehicle_is_taken_where_the_url_is_silent() {
    let folder = empty("dialect");
    let script = "tests/link/remus.alb";
    let vehicle = Vehicle::serve_world(&format!("{script}#quay"), "pty:", &folder);
    assert!(vehicle.link.ends_with("?dialect=recon"), "{}", vehicle.link);
    let silent = vehicle.link.trim_end_matches("?dialect=recon");
    let run = albacore(&["run", script, "--no-out", "--link", silent]).args(RATE).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert!(stderr(&run).contains(&format!("link open to {}", vehicle.link)), "{}", stderr(&run));
    ends_with(&["run", script, "--no-out", "--link", "serial:/dev/x?dialect=rekon"], 2, "did you mean `recon`?");
    ends_with(&["run", EXCURSION, "--no-out", "--link", "serial:/dev/x"], 2, "or `dialect(recon)` in the `vehicle`");
    ends_with(&["vehicle", "duck_2003", "--link", "pty:"], 2, "does not say what the vehicle speaks");
    let wrong = folder.join("wrong.alb");
    for (speaks, said) in [
        ("semaphore", "there is no protocol named `semaphore`"),
        ("\"recon\"", "`dialect` takes no such thing: it takes a protocol"),
    ] {
        let vehicle = format!("vehicle v {{\n    kinematic\n    dialect({speaks})\n}}\n");
        std::fs::write(&wrong, vehicle + "scenario s {\n    vehicle(v, start: point(0 m, 0 m))\n}\n").unwrap();
        ends_with(&["check", wrong.to_str().unwrap()], 3, said);
    }
}

#[test]
fn a_port_that_is_in_use_is_told_with_4() {
    let folder = empty("busy");
    let vehicle = Vehicle::serve("pty:?dialect=recon", &folder);
    let run = vehicle.driven(&["--no-out"]);
    let second = vehicle.mission(&["--no-out"]).output().unwrap();
    assert_eq!(second.status.code(), Some(4));
    assert!(stderr(&second).contains("is in use by another program"), "{}", stderr(&second));
    send("-INT", &run);
    assert_eq!(run.wait_with_output().unwrap().status.code(), Some(1), "the first is not disturbed");
}

/// Another controller, and someone who babbles, do not take the vehicle from the mission that drives it.
#[test]
fn a_vehicle_that_is_driven_over_udp_hears_nobody_else() {
    let folder = empty("udp-busy");
    let vehicle = Vehicle::serve("udp:127.0.0.1:0?dialect=recon", &folder);
    let mut run = vehicle.driven(&["--no-out"]);
    let at = vehicle.link.trim_start_matches("udp:").split('?').next().unwrap();
    let stray = UdpSocket::bind("127.0.0.1:0").unwrap();
    for _ in 0..2000 {
        let _ = stray.send_to(&[b'x'; 200], at);
        std::thread::sleep(Duration::from_micros(100));
    }
    let second = vehicle.mission(&["--no-out"]).output().unwrap();
    assert_eq!(second.status.code(), Some(4));
    assert!(stderr(&second).contains("no other controller drives it"), "{}", stderr(&second));
    assert!(run.try_wait().unwrap().is_none(), "the first drives on: {}", vehicle.said());
    send("-INT", &run);
    assert_eq!(run.wait_with_output().unwrap().status.code(), Some(1));
    vehicle.says("override released");
    let (_, said) = vehicle.stop();
    assert!(!said.contains("timed out"), "{said}");
}

/// A vehicle without an echo sounder tells altitude 0, which is no altitude: a least altitude then allows no descent.
#[test]
fn a_vehicle_that_always_tells_altitude_0_is_taken_no_deeper() {
    let folder = empty("no-echo");
    let vehicle = Vehicle::serve_world(&format!("{EXCURSION}#no_echo"), "pty:?dialect=recon", &folder);
    let out = folder.join("run");
    let output = vehicle.mission(&["--mission", "deep", "--out"]).arg(&out).output().unwrap();
    let trace = std::fs::read_to_string(out.join("trace.txt")).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}\n{trace}", stderr(&output));
    assert!(trace.contains("altitude unknown: no deeper than 0.0 m"), "{trace}");
    assert!(!trace.contains("aground") && !vehicle.said().contains("aground"), "{trace}");
}
