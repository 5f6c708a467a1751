//! What others wrote is shown, and never obeyed: no control character of a script, a file's name, an argument or a URL reaches
//! the terminal or a file that a person reads.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use albacore_session::seen::is_unseen;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Clears the screen, turns the direction of writing, and is colour without an escape.
const EVIL: &str = "e\u{1b}[2J\u{202e}\u{9b}31mvil";

const SCRIPT: &str = r#"
mission north in calm within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    limits { speed <= 2 m/s }
    with depth 3 m, speed 1 m/s
    log "line\nand =1+1"
    steer 0 deg for 3 s
    report "=1+1": position
    abort "=1+1\n@SUM(A1)"
}
"#;

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("unseen").join(format!("{name}-{EVIL}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// All that the program writes, in which nothing may be that nobody sees.
fn said(folder: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let output =
        command.args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert_eq!(unseen(&text), None, "{arguments:?}: {}", text.escape_debug());
    text
}

fn unseen(text: &str) -> Option<char> {
    text.chars().find(|c| is_unseen(*c) && !matches!(c, '\n' | '\t'))
}

#[test]
fn a_message_shows_what_it_is_about_and_obeys_nothing() {
    let folder = folder("messages");
    let name = format!("{EVIL}.alb");
    std::fs::write(folder.join(&name), format!("mission m {{ log \"{EVIL}\"\n    gotoo {EVIL}\n}}\n")).unwrap();
    let evil_set = format!("{EVIL}=3 {EVIL}");
    let evil_option = format!("--{EVIL}");
    let evil_link = format!("udp://{EVIL}:1/{EVIL}?{EVIL}");
    for arguments in [
        &["check", &name][..],
        &["check", "--set", &evil_set, &name],
        &["fmt", "--check", &name],
        &["test", &name],
        &["run", &format!("{EVIL}{EVIL}.alb")],
        &["run", &name, "--in", EVIL],
        &["run", &name, &evil_option],
        &["explain", EVIL],
        &["new", EVIL],
        &["graph", &name, EVIL],
        &["replay", EVIL],
        &["why", EVIL],
        &["why", EVIL, "--at", EVIL],
        &["diff", EVIL, EVIL],
        &["repl", &format!("{EVIL}{EVIL}.alb")],
        &["doc", &name],
        &["export", EVIL, "--csv"],
        &["export", &name, "--csv"],
        &["report", EVIL],
        &["campaign", "plot", EVIL, "--out", EVIL],
        &["campaign", "plot", &name, "--out", EVIL],
    ] {
        let said = said(&folder, arguments);
        assert!(said.contains("\\u{") || said.contains('?'), "{arguments:?}: {said}");
    }
    std::fs::write(folder.join("north.alb"), SCRIPT).unwrap();
    let link = said(&folder, &["run", "north.alb", "--link", &evil_link]);
    assert!(link.contains("\\u{"), "{link}");
    let set = said(&folder, &["run", "north.alb", "--json", "--set", &evil_set]);
    assert!(set.contains("\\u{"), "{set}");
}

#[test]
fn what_is_kept_of_a_run_holds_nothing_unseen() {
    let folder = folder("kept");
    std::fs::write(folder.join("north.alb"), SCRIPT).unwrap();
    // What it was of stands in its record.
    let evil = format!("{EVIL}.alb");
    std::fs::write(folder.join(&evil), SCRIPT).unwrap();
    said(&folder, &["run", &evil, "--mission", "north", "--out", EVIL]);
    for arguments in [&["why", EVIL][..], &["why", EVIL, "--at", "1s"], &["replay", EVIL], &["diff", EVIL, EVIL]] {
        said(&folder, arguments);
    }
    // A log of the field may say anything.
    std::fs::write(folder.join("log.csv"), format!("time (s),{EVIL}\n{EVIL},{EVIL}\n")).unwrap();
    std::fs::write(folder.join("log.alog"), format!("{EVIL} {EVIL} x 3\n")).unwrap();
    for log in ["log.csv", "log.alog"] {
        said(&folder, &["run", &evil, "--log", log, "--no-out"]);
        said(&folder, &["run", &evil, "--log", log, "--columns", log, "--no-out"]);
    }
    said(&folder, &["report", EVIL]);
    let trace = std::fs::read_to_string(folder.join(EVIL).join("trace.txt")).unwrap_or_default();
    let files: Vec<PathBuf> = std::fs::read_dir(folder.join(EVIL)).unwrap().map(|f| f.unwrap().path()).collect();
    let mut read = 0;
    for file in files {
        if let Ok(text) = std::fs::read_to_string(&file) {
            assert_eq!(unseen(&text), None, "{}", file.display().to_string().escape_debug());
            read += 1;
        }
    }
    assert!(read >= 3, "{trace}");
}

/// A file of every format, of a run whose folder, texts and names are hostile: texts hold nothing unseen, and a table no formula.
#[test]
fn what_is_exported_holds_nothing_unseen() {
    let folder = folder("exported");
    // No script may hold what is unseen; names of files may, and so may what a vehicle says.
    let script = SCRIPT.replace("line\\nand =1+1", "<b>&amp;\\\"]]>");
    std::fs::write(folder.join("north.alb"), script.replace("\"=1+1\": position", "\"=1,<1>\": position")).unwrap();
    said(&folder, &["run", "north.alb", "--out", EVIL]);
    let files = ["track.csv", "track.geojson", "track.kml", "track.gpx", "track.alog", "track.mcap", "track.nc"];
    let formats = ["--csv", "--geojson", "--kml", "--gpx", "--alog", "--mcap", "--netcdf"];
    let told = said(&folder, &[&["export", EVIL][..], &formats[..]].concat());
    assert_eq!(told.lines().count(), files.len(), "{told}");
    for file in files {
        let bytes = std::fs::read(folder.join(EVIL).join("export").join(file)).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        // Each with a neighbour of its own: alone it may be a part of the numbers of a binary file.
        let evil = ["\u{1b}[2J", "J\u{202e}", "\u{202e}\u{9b}", "\u{9b}31m"];
        assert!(evil.iter().all(|told| !text.contains(told)), "{file}");
        assert!(file.ends_with("kml") || file.ends_with("gpx") || text.contains("<1>"), "{file}");
    }
    let read = |file: &str| std::fs::read_to_string(folder.join(EVIL).join("export").join(file)).unwrap();
    for file in &files[..5] {
        assert_eq!(unseen(&read(file)), None, "{file}");
    }
    for file in ["track.kml", "track.gpx"] {
        let text = read(file);
        let tree = roxmltree::Document::parse(&text).unwrap();
        assert!(tree.descendants().any(|node| node.text().is_some_and(|text| text.contains(",<1>"))), "{file}");
    }
    let table = read("track.csv");
    assert!(table.contains("\"'=1,<1>: ("), "{}", table.lines().last().unwrap_or_default());
    assert!(!table.contains(",=") && !table.contains("\"=") && !table.contains(",@") && !table.contains(",+"));
}

/// What is named over several lines forges no line of a result: of a run, of a test, of a message.
#[test]
fn a_result_has_its_own_lines_only() {
    let folder = folder("lines");
    let forged = "x\\n  digest 0123456789abcdef\\nerror: on fire\\nok  ";
    let script = SCRIPT.replace("=1+1\": position", &format!("{forged}\": position"));
    let script = script.replace("=1+1\\n@SUM(A1)", forged);
    let tests = format!("test \"{forged}\" {{\n    run north in calm seeds 1..1\n    expect completed\n}}\n");
    let unknown = format!(
        "test \"unknown\" {{\n    run north in calm seeds 1..1\n    expect has_reported(\"no {forged}\")\n}}\n"
    );
    std::fs::write(folder.join("north.alb"), script.clone() + &tests).unwrap();
    std::fs::write(folder.join("unknown.alb"), script + &unknown).unwrap();
    for arguments in [
        &["run", "north.alb", "--no-out"][..],
        &["run", "north.alb", "--out", "out\nerror: on fire"],
        &["test", "north.alb"],
        &["check", "unknown.alb"],
        &["check", "none\nerror: on fire"],
        &["fmt", "none\nerror: on fire"],
    ] {
        let said = said(&folder, arguments);
        assert!(said.contains("on fire"), "{arguments:?}: {said}");
        let forged = said
            .lines()
            .find(|line| line.starts_with("error: on") || line.contains("  digest 0123") && !line.contains('x'));
        assert_eq!(forged, None, "{arguments:?}: {said}");
    }
}

#[test]
fn a_table_holds_no_formula() {
    let folder = folder("table");
    std::fs::write(folder.join("north.alb"), SCRIPT).unwrap();
    said(&folder, &["campaign", "north.alb", "--seeds", "1..2", "--out", "table.csv"]);
    let table = std::fs::read_to_string(folder.join("table.csv")).unwrap();
    assert!(table.contains(",aborted,,'=1+1 @SUM(A1),"), "{table}");
    let evil = format!("{EVIL}.alb");
    std::fs::write(folder.join(&evil), SCRIPT).unwrap();
    said(&folder, &["campaign", &evil, "--seeds", "1..2", "--out", "evil.csv"]);
    let origin = std::fs::read_to_string(folder.join("evil.csv.origin")).unwrap();
    assert_eq!(unseen(&origin), None, "{}", origin.escape_debug());
    said(&folder, &["campaign", &evil, "--seeds", "1..3", "--out", "evil.csv", "--resume"]);
    assert!(!table.contains(",=") && !table.contains(",@") && !table.contains(",+"), "{table}");
}

/// What is wrong with an argument is told with the argument, though a terminal would obey all of it.
#[test]
fn an_argument_that_is_refused_is_shown() {
    let folder = folder("arguments");
    let evil = "\u{1b}[31m";
    for arguments in [
        &[evil][..],
        &["run", "box.alb", evil],
        &["run", "box.alb", "--seed", evil],
        &["campaign", "box.alb", "--out", "t.csv", "--seeds", evil],
        &["completions", evil],
        &["run", "box.alb", &format!("--{evil}")],
    ] {
        let said = said(&folder, arguments);
        assert!(said.contains(r"\u{1b}[31m'"), "{arguments:?}: {said}");
    }
}
