//! The verbs that read what a run left: `replay`, `why`, `diff`.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A folder of a test's own, with the script that is run.
fn project(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("past").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::copy("tests/past/patrol.alb", folder.join("patrol.alb")).unwrap();
    folder
}

/// Exit code, standard output and standard error.
fn albacore(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn told(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, said) = albacore(folder, arguments);
    let code = code.unwrap();
    format!("$ albacore {}\n{out}{said}exit {code}\n\n", arguments.join(" "))
}

fn has_run(folder: &Path, arguments: &[&str]) {
    let (code, _, said) = albacore(folder, &[&["run", "patrol.alb", "--out"], arguments].concat());
    assert_eq!(code, Some(0), "{said}");
}

/// The same without the time of day at which a run was made.
fn without_clock(text: &str) -> String {
    let line = |line: &str| match line.strip_prefix("at ").and_then(|rest| rest.split_once("Z: ")) {
        Some((before, after)) => format!("at {}[clock]: {after}\n", &before[..before.len() - "hh:mm:ss".len()]),
        None => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// Two runs, and all that is asked of them.
#[test]
fn what_a_run_left_is_read() {
    let folder = project("read");
    has_run(&folder, &["held", "--fault", "position, off, from: 10 s, to: 16 s"]);
    has_run(&folder, &["hasty", "--set", "patience=18s"]);
    // The script is changed afterwards: what was run is in the journal.
    let script = std::fs::read_to_string(folder.join("patrol.alb")).unwrap();
    std::fs::write(folder.join("patrol.alb"), script.replace("legs >= turns", "legs > turns")).unwrap();
    let asked: [&[&str]; 9] = [
        &["replay", "held"],
        &["replay", "held/journal"],
        &["replay", "held", "--set", "patience=18s"],
        &["replay", "held", "--script", "patrol.alb"],
        &["why", "held"],
        &["why", "held", "--at", "24s"],
        &["why", "hasty", "--at", "5.0s"],
        &["diff", "held", "hasty"],
        &["diff", "held", "held"],
    ];
    let all: String = asked.iter().map(|arguments| told(&folder, arguments)).collect();
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!("what_a_run_left", without_clock(&all));
    });
}

/// The moment may be given by the clock.
#[test]
fn a_moment_is_given_by_the_clock() {
    let folder = project("clock");
    has_run(&folder, &["held"]);
    let record = std::fs::read_to_string(folder.join("held/run.json")).unwrap();
    let told: serde_json::Value = serde_json::from_str(&record).unwrap();
    let first = told["first_tick"].as_str().unwrap();
    let clock = &first[11..16];
    let (code, out, said) = albacore(&folder, &["why", "held", "--at", clock, "--json"]);
    assert_eq!(code, Some(0), "{said}");
    let why: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(why["moment"]["tick"], 0, "a minute in which the run began counts from its first tick: {first}");

    std::fs::remove_file(folder.join("held/run.json")).unwrap();
    let (code, _, said) = albacore(&folder, &["why", "held", "--at", clock]);
    assert_eq!(code, Some(2));
    assert!(said.contains("no clock is known of this run") && said.contains("751s"), "{said}");
}

/// What is no run, or none that can be read, is said with its mend.
#[test]
fn what_is_no_run_is_said() {
    let folder = project("no_run");
    has_run(&folder, &["held"]);
    std::fs::create_dir(folder.join("empty")).unwrap();
    let journal = std::fs::read(folder.join("held/journal")).unwrap();
    std::fs::write(folder.join("cut"), &journal[..journal.len() / 2]).unwrap();
    let mut damaged = journal.clone();
    damaged[journal.len() / 2] ^= 1;
    std::fs::write(folder.join("damaged"), damaged).unwrap();
    let mut other = journal.clone();
    other[4] = 5;
    std::fs::write(folder.join("other"), other).unwrap();
    std::fs::write(folder.join("picture"), "<svg/>").unwrap();
    // A program that was killed leaves a record of its beginning.
    let killed = folder.join("killed");
    std::fs::create_dir(&killed).unwrap();
    std::fs::copy(folder.join("cut"), killed.join("journal")).unwrap();
    let began = r#"{"started": "2026-11-29T12:35:32.665Z", "first_tick": null, "outcome": "running"}"#;
    std::fs::write(killed.join("run.json"), began).unwrap();
    let asked: [&[&str]; 21] = [
        &["why", "cut", "--at", "50s"],
        &["replay", "."],
        &["why", "empty"],
        &["why", "none"],
        &["diff", "held", "picture"],
        &["replay", "other"],
        &["replay", "cut"],
        &["replay", "damaged"],
        &["why", "held", "--at", "2h"],
        &["why", "held", "--at", "noon"],
        &["replay", "held", "--set", "patience=90s"],
        &["replay", "held", "--script", "none.alb"],
        &["replay", "held", "--mission", "none"],
        &["replay", "damaged", "--json"],
        &["diff", "held", "cut"],
        &["why", "killed", "--at", "12:35:50"],
        &["why", "killed", "--at", "11:00"],
        &["why", "killed", "--at", "20s"],
        &["why", "cut", "--at", "11:00"],
        &["export", "killed", "--netcdf", "--out", "killed_too"],
        &["export", "cut", "--netcdf", "--out", "cut_too"],
    ];
    let all: String = asked.iter().map(|arguments| told(&folder, arguments)).collect();
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!("what_is_no_run", all) });
}

/// A journal holds its scripts, and not the files of data that they read: those may have been moved since.
#[test]
fn files_of_data_that_were_moved_are_asked_for() {
    let folder = project("moved");
    std::fs::copy("tests/scenario/bay.csv", folder.join("bay.csv")).unwrap();
    std::fs::write(folder.join("bay.alb"), BAY).unwrap();
    let (code, _, said) = albacore(&folder, &["run", "bay.alb", "--out", "dive"]);
    assert_eq!(code, Some(0), "{said}");
    std::fs::create_dir(folder.join("kept")).unwrap();
    std::fs::rename(folder.join("bay.csv"), folder.join("kept/bay.csv")).unwrap();
    for verb in ["replay", "why", "report"] {
        let (code, _, said) = albacore(&folder, &[verb, "dive"]);
        assert!(code == Some(3) && said.contains("there is no file `bay.csv`"), "{verb}: {said}");
        assert!(said.contains("`--project FOLDER` names the folder"), "{verb}: {said}");
        let (code, _, said) = albacore(&folder, &[verb, "dive", "--project", "kept"]);
        assert_eq!(code, Some(0), "{verb}: {said}");
    }
    let (_, _, said) = albacore(&folder, &["replay", "dive", "--project", "kept", "--set", "depht=3m"]);
    assert!(!said.contains("--project"), "{said}");
}

const BAY: &str = r#"
mission look in bay within 2 min {
    area op = rectangle(center: 36°10.7'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 1 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    with depth 2 m, speed 2 m/s
    steer 0 deg for 5 s
}

scenario bay {
    bottom_grid("bay.csv")
    vehicle(kinematic, start: 36°10.7'N 75°44.4'W, depth: 2 m)
}
"#;

/// A log of the field, from another recorder: its columns by their names, on the globe, and as a log of MOOS.
#[test]
fn a_log_of_the_field_is_played_through_a_mission() {
    let folder = project("field");
    let (mut table, mut moos) = ("t,Lat,Lon,HDG,COG,Depth_m,Alt,note\n".to_string(), "%% LOGSTART 1\n".to_string());
    for fifth in 0..500 {
        let time = f64::from(fifth) / 5.0;
        let north = if time < 70.0 { 1.5 * time } else { 210.0 - 1.5 * time };
        let (latitude, heading) = (36.18 + north / 110_970.0, if time < 70.0 { 0 } else { 180 });
        table += &format!("{time:.1},{latitude:.7},-75.74,{heading},{heading},3.0,10.1,\"a, b\"\n");
        for (name, value) in [("NAV_X", 0.0), ("NAV_Y", north), ("NAV_HEADING", f64::from(heading))] {
            moos += &format!("{time:.3} {name} uSim {value}\n");
        }
        moos += &format!("{time:.3} NAV_DEPTH uSim 3\n{time:.3} NAV_ALTITUDE uSim 10.1\n{time:.3} MODE helm ACTIVE\n");
    }
    std::fs::write(folder.join("dive.csv"), &table).unwrap();
    std::fs::write(folder.join("dive.alog"), &moos).unwrap();
    let names = "# what the recorder calls them\ntime (s) = t\nlatitude (deg) = Lat\nlongitude (deg) = Lon\n\
                 heading (deg) = HDG\ncourse (deg) = COG\ndepth (m) = Depth_m\naltitude (m) = Alt\n";
    std::fs::write(folder.join("columns.txt"), names).unwrap();
    std::fs::write(folder.join("moos.txt"), "course (deg) = NAV_HEADING\n").unwrap();
    std::fs::write(folder.join("wrong.txt"), "depth\n").unwrap();
    std::fs::write(folder.join("misspelt.txt"), format!("{names}headng (deg) = HDG\n")).unwrap();
    std::fs::write(folder.join("missing.txt"), format!("{names}speed (m/s) = SOG\n")).unwrap();
    std::fs::write(folder.join("twice.txt"), format!("{names}depth (m) = Alt\n")).unwrap();
    // The clock of the recorder stood elsewhere, and heading and course are one column.
    let late = |line: &str| match line.split_once(',') {
        Some((time, rest)) => {
            time.parse().map_or(format!("{line}\n"), |time: f64| format!("{:.1},{rest}\n", time + 300.0))
        }
        None => format!("{line}\n"),
    };
    std::fs::write(folder.join("late.csv"), table.lines().map(late).collect::<String>()).unwrap();
    std::fs::write(folder.join("one.txt"), names.replace("= COG", "= HDG")).unwrap();
    std::fs::write(folder.join("cut.alog"), "12.0 NAV_X\nx y z 3\n").unwrap();
    std::fs::write(folder.join("torn.csv"), table.replace("12.0,", "noon,")).unwrap();
    let asked: [&[&str]; 15] = [
        &["run", "patrol.alb", "--log", "late.csv", "--columns", "one.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "misspelt.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "missing.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "twice.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "columns.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.alog", "--columns", "moos.txt", "--out", "moos"],
        &["replay", "moos"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "columns.txt", "--set", "turns=10", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.alog", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--columns", "wrong.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "cut.alog", "--no-out"],
        &["run", "patrol.alb", "--log", "torn.csv", "--columns", "columns.txt", "--no-out"],
        &["run", "patrol.alb", "--log", "none.csv", "--no-out"],
        &["run", "patrol.alb", "--log", "dive.csv", "--in", "calm"],
    ];
    let all: String = asked.iter().map(|arguments| told(&folder, arguments)).collect();
    // How long it took is no matter of the run.
    let without_time = |line: &str| match line.split_once("of the vehicle's time in ") {
        Some((before, after)) => {
            let after = after.split_once(" s, ").map_or("", |(_, after)| after);
            format!("{before}of the vehicle's time in [time], {after}\n")
        }
        None => format!("{line}\n"),
    };
    let all: String = all.lines().map(without_time).collect();
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!("a_log_of_the_field", all) });
}
