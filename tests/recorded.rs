//! What a mission records is left in the run's folder, is counted, and is taken for the run's own as long as nobody has changed it.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const MISSION: &str = "missions/gallery/lawn_mower_and_record.alb";

/// A folder that is not there yet.
fn out(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

/// Exit code, standard output and standard error of a run of the gallery's mission.
fn run(out: &Path, words: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let output = command.args(["run", MISSION, "--out"]).arg(out).args(words).stdin(Stdio::null()).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_run_leaves_what_it_recorded_and_says_how_much() {
    let out = out("left");
    let (code, told, said) = run(&out, &["--json"]);
    assert_eq!(code, Some(0), "{said}");
    let told: Value = serde_json::from_str(&told).unwrap();
    let table = std::fs::read_to_string(out.join("recorded.csv")).unwrap();
    assert_eq!(told["recorded_rows"], table.lines().count() - 1);
    let head = "time (s),utc,north (m),east (m),latitude (deg),longitude (deg),depth (m),altitude (m),flow.north (m/s),flow.east (m/s),battery (%)\
                ,temperature (degC),salinity (psu)";
    assert_eq!(table.lines().next(), Some(head));
    let record: Value = serde_json::from_str(&std::fs::read_to_string(out.join("run.json")).unwrap()).unwrap();
    assert!(
        record["files"]["recorded.csv"].is_string() && record["lost"].as_object().is_some_and(|lost| lost.is_empty()),
        "{record}"
    );
    // Nothing in it is a formula to a spreadsheet, and no row is longer than its head.
    let columns = head.split(',').count();
    for row in table.lines().skip(1) {
        assert_eq!(row.split(',').count(), columns, "{row}");
        let is_number = |cell: &str| cell.is_empty() || cell.parse::<f64>().is_ok_and(f64::is_finite);
        assert!(row.split(',').enumerate().all(|(at, cell)| at == 1 || is_number(cell)), "{row}");
        assert!(
            row.split(',').nth(1).is_some_and(|utc| utc.starts_with("2026-08-14T0") && utc.ends_with('Z')),
            "{row}"
        );
    }
    let (_, told, _) = run(&out, &["--replace"]);
    assert!(
        told.contains(&format!(
            "  recorded {} rows, in {}\n",
            table.lines().count() - 1,
            out.join("recorded.csv").display()
        )),
        "{told}"
    );
}

const TWICE: &str = "behavior leg {
    record temperature at 0.5 Hz
    wait for 8 s
}
mission twice in w within 20 min {
    area op = rectangle(center: point(0 m, 0 m), along: 0 deg, length: 400 m, width: 400 m)
    limits { speed <= 2.5 m/s }
    requires { heading, position fresh 5 s, else abort }
    recovery within 5 min { wait for 1 s }
    record temperature at 1 Hz
    leg()
}
scenario w = still_water with { played(\"temperature\", file: \"--set t.csv\") }
";

/// An attack: of two clauses that record one input the slower one wrote a sample again. And a file of data that is called like an option was
/// none of those that a run was made from.
#[test]
fn a_sample_stands_once_and_every_file_is_named() {
    let folder = out("twice");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("albacore.toml"), "").unwrap();
    std::fs::write(folder.join("twice.alb"), TWICE).unwrap();
    std::fs::write(folder.join("--set t.csv"), "time (s),temperature (degC)\n0.8,11\n5.3,12\n").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["run", "twice.alb", "--out", "run"]).current_dir(&folder).stdin(Stdio::null());
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let table = std::fs::read_to_string(folder.join("run/recorded.csv")).unwrap();
    let told = table.lines().skip(1).filter_map(|row| row.rsplit(',').next()).filter(|cell| !cell.is_empty());
    assert_eq!(told.collect::<Vec<_>>(), ["11", "12"], "{table}");
    let record = std::fs::read_to_string(folder.join("run/run.json")).unwrap();
    assert!(record.contains("\"--set t.csv\""), "{record}");
}

/// A table holds rows alone: the mark that others have in themselves stands in `run.json`.
#[test]
fn a_table_that_was_changed_is_replaced_by_no_run() {
    let out = out("changed");
    assert_eq!(run(&out, &[]).0, Some(0));
    let path = out.join("recorded.csv");
    let made = std::fs::read_to_string(&path).unwrap();
    for theirs in [made.replacen(",14", ",41", 1), format!("{made}my notes\n"), made[..made.len() / 2].to_string()] {
        std::fs::write(&path, &theirs).unwrap();
        let (code, _, said) = run(&out, &["--replace"]);
        assert!(
            code == Some(2) && said.contains("recorded.csv` is there already, and is not as a run left it"),
            "{said}"
        );
        assert_eq!(std::fs::read_to_string(&path).unwrap(), theirs);
    }
    std::fs::write(&path, &made).unwrap();
    let (code, _, said) = run(&out, &["--seed", "2", "--replace"]);
    assert!(code == Some(0) && std::fs::read_to_string(&path).unwrap() != made, "{said}");
}
