//! What a mission records steers nothing, and follows from the journal.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{PastRun, Plan, RECORDED, Run, Source, load_text};
use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex};

const GALLERY: &str = "../../missions/gallery/lawn_mower_and_record.alb";

fn gallery() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(GALLERY)).unwrap()
}

fn plan(text: &str) -> Plan {
    let script = load_text(Source { name: "recording.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:?}", script.findings);
    Plan::new(&script, "recording.alb", None, None).unwrap()
}

#[derive(Clone, Default)]
struct Sink(Arc<Mutex<Vec<u8>>>);

impl io::Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A run of a text to its end, with its journal.
fn run(text: &str) -> (Run, Plan, Vec<u8>) {
    let plan = plan(text);
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    run.to_end();
    let bytes = sink.0.lock().unwrap().clone();
    (run, plan, bytes)
}

#[test]
fn what_is_recorded_changes_nothing_else() {
    let without: String = gallery()
        .lines()
        .filter(|line| !line.trim_start().starts_with("record "))
        .map(|line| format!("{line}\n"))
        .collect();
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
