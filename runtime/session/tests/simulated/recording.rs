//! What a mission records steers nothing, and follows from the journal.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use crate::sink::Sink;
use albacore_session::{PastRun, Plan, RECORDED, Run, Source, load_text};
use std::path::Path;

const GALLERY: &str = "../../missions/gallery/lawn_mower_and_record.alb";

/// The script without its tests, which ask what was recorded.
fn gallery() -> String {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(GALLERY)).unwrap();
    text.split("\ntest ").next().unwrap_or_default().to_string()
}

fn plan(text: &str) -> Plan {
    let script = load_text(Source { name: "recording.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:?}", script.findings);
    Plan::new(&script, "recording.alb", None, None).unwrap()
}

/// A run of a text to its end, with its journal.
fn run(text: &str) -> (Run, Plan, Vec<u8>) {
    let plan = plan(text);
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    run.to_end();
    let bytes = sink.bytes();
    (run, plan, bytes)
}

#[test]
fn what_is_recorded_changes_nothing_else() {
    // All else stays on its line: the trace tells where statements stand.
    let kept = |line: &str| if line.trim_start().starts_with("record ") { "\n".into() } else { format!("{line}\n") };
    let without: String = gallery().lines().map(kept).collect();
    let ((with, ..), (without, ..)) = (run(&gallery()), run(&without));
    assert!(with.summary(0.0).recorded_rows.is_some_and(|rows| rows > 1000));
    assert_eq!(without.summary(0.0).recorded_rows, None);
    assert!(!without.files().any(|file| file.name == RECORDED.name) && without.file(&RECORDED).is_empty());
    assert_eq!(with.summary(0.0).digest, without.summary(0.0).digest);
    assert_eq!(with.trace().to_string(), without.trace().to_string());
}

#[test]
fn a_journal_that_is_read_back_gives_the_same_table() {
    let (run, plan, journal) = run(&gallery());
    let past = PastRun::read(&plan, &journal).unwrap();
    assert_eq!(past.file(&RECORDED), run.file(&RECORDED));
    assert_eq!(past.summary(), run.summary(0.0));
    let half = PastRun::read(&plan, &journal[..journal.len() / 2]).unwrap().file(&RECORDED);
    assert!(half.lines().count() > 300 && run.file(&RECORDED).starts_with(&half), "{half}");
    // Its script may have changed since: what it has no names for has no cells.
    let other =
        PastRun::read(&self::plan(&gallery().replace("record temperature, salinity", "record speed")), &journal);
    assert_eq!(other.unwrap().summary().recorded_rows, run.summary(0.0).recorded_rows);
}

/// An instrument that fails leaves empty cells, and no sample stands in two rows.
#[test]
fn a_sensor_that_is_silent_leaves_empty_cells() {
    let slow = gallery().replace("ctd(temperature_noise: 0.01 degC)", "ctd(rate: 0.5 Hz)");
    let table = run(&slow).0.file(&RECORDED);
    let cells: Vec<&str> = table.lines().skip(1).filter_map(|row| row.split(',').nth(11)).collect();
    let told = cells.iter().filter(|cell| !cell.is_empty()).count();
    assert!(cells.len() > 1000 && told > 500 && told <= cells.len() / 2 + 1, "{told} of {}", cells.len());
}

/// What is recorded in the recovery of a mission is recorded too, and where a vehicle is when nobody has told for long is not.
#[test]
fn a_mission_records_in_its_recovery() {
    let text = gallery().replace("in shelf_front within 2 h", "in shelf_front within 3 min");
    let table = run(&text).0.file(&RECORDED);
    let times = table.lines().skip(1).filter_map(|row| row.split(',').next()?.parse::<f64>().ok());
    let late: Vec<f64> = times.filter(|time| *time > 181.0).collect();
    assert!(late.len() > 3 && late.windows(2).all(|pair| (pair[1] - pair[0] - 10.0).abs() < 1e-6), "{late:?}");
}

/// A strategy that is derived records what its base does, but for what it records itself.
#[test]
fn a_derived_strategy_records_its_own_in_place_of_its_bases() {
    let text = "
        strategy survey(row: Line) {
            record temperature, salinity at 1 Hz
            behavior drive { follow row }
            start drive
            drive -> finish on done
        }
        strategy closer = survey with { record temperature at 5 Hz }
        mission both in shelf_front within 2 h {
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
            limits { altitude >= 3 m, speed <= 2 m/s }
            requires { position, course, heading fresh 5 s, else abort }
            recovery within 10 min { goto op.center }
            with depth 5 m, speed 1.5 m/s
            survey(line(op.center, op.center + 50 m toward north))
            closer(line(op.center, op.center + 50 m toward north))
        }
        scenario shelf_front = still_water with { ctd(); vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 5 m) }";
    let (run, plan, _) = run(text);
    let program = &plan.program;
    let mut recorded: Vec<(&str, f64, Vec<&str>)> = Vec::new();
    for recording in &program.recordings {
        let inputs = recording.inputs.iter().map(|(input, _)| program.inputs[*input as usize].name.as_str());
        recorded.push((&program.activities[recording.activity as usize].name, recording.rate, inputs.collect()));
    }
    recorded.sort_by_key(|(of, rate, _)| (*of, *rate as u64));
    let of_base = ("survey", 1.0, vec!["temperature", "salinity"]);
    assert_eq!(recorded, [("closer", 1.0, vec!["salinity"]), ("closer", 5.0, vec!["temperature"]), of_base]);
    assert!(run.file(&RECORDED).lines().count() > 6 * 30, "five rows a second on the second leg");
}

/// What an overlay does by turns is no matter of what is recorded beside it.
#[test]
fn an_overlay_beside_a_record_changes_nothing_when_a_journal_is_read_back() {
    let text = "
        overlay phases {
            behavior slow { wait }
            behavior quick { wait for 2 s }
            start slow
            slow -> quick on every 5 s then back
        }
        behavior drive(row: Line) {
            record altitude, heading at 2 Hz
            follow row
        }
        mission beside in calm within 2 h {
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
            limits { altitude >= 3 m, speed <= 2 m/s }
            requires { position, course, heading fresh 5 s, else abort }
            recovery within 10 min { goto op.center }
            with depth 5 m, speed 1.5 m/s, phases()
            drive(line(op.center, op.center + 50 m toward north))
        }";
    let (run, plan, journal) = run(text);
    let past = PastRun::read(&plan, &journal).unwrap();
    assert!(run.file(&RECORDED).lines().count() > 60, "{}", run.trace());
    assert_eq!(past.file(&RECORDED), run.file(&RECORDED));
}
