//! The record in `missions/recorded`, played back, against what its makers say of it.

use super::*;
use crate::probe::{Band, Probe};
use albacore_formats::recording::{RecordedKernel, Recording, RecordingHeader};
use albacore_geometry::{Heading, Point};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

const KERNELS: [(RecordedKernel, &str); 2] = [(RecordedKernel::Pompy, "pompy"), (RecordedKernel::Flat, "flat")];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/recorded")
}

fn text() -> String {
    fs::read_to_string(folder().join("case_a.json")).unwrap()
}

fn binary() -> Vec<u8> {
    fs::read(folder().join("case_a.bin")).unwrap()
}

fn record() -> Arc<Recording> {
    static RECORD: OnceLock<Arc<Recording>> = OnceLock::new();
    let read = || Arc::new(RecordingHeader::read(&text()).unwrap().decode(&binary()).unwrap());
    Arc::clone(RECORD.get_or_init(read))
}

fn header() -> Value {
    serde_json::from_str(&text()).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64, what: &str) {
    // To a millionth, and to 1e-6 where it is small.
    assert!((found - expected).abs() <= 1e-6 * expected.abs().max(1.0), "{what}: {found}, not {expected}");
}

/// The 56 single queries that its makers computed with another reader.
#[test]
fn it_reads_what_its_makers_read() {
    let (record, header) = (record(), header());
    let checks = header["checks"].as_array().unwrap();
    assert_eq!(checks.len(), 56);
    let mut interval = interval::Interval::default();
    for check in checks {
        let number = |name: &str| check[name].as_f64().unwrap();
        let (time, p) = (number("t"), Point::new(number("north"), number("east")));
        assert_eq!(record.alive(time).count() as f64, number("alive"), "alive after {time} s");
        for (kernel, name) in KERNELS {
            let expected = number(&format!("c_{name}"));
            near(record.concentration(kernel, p, time), expected, name);
            interval.turn_to(&record, time);
            near(interval.concentration(&record, kernel, p, time), expected, name);
            assert_eq!(interval.alive(time) as f64, number("alive"));
        }
        let flow = record.flow(p, time);
        near(flow.north, number("v_north"), "flow north");
        near(flow.east, number("v_east"), "flow east");
    }
}

/// Its table of a probe up the centreline: on-fraction within 0.01, median gap within a sample of 0.1 s.
#[test]
fn a_probe_meets_what_its_makers_met() {
    let (record, header) = (record(), header());
    for (kernel, name) in KERNELS {
        for met in probe(&record, kernel) {
            let band = format!("{}-{} m", met.from, met.to);
            let expected = &header["expected"]["probe"][name][&band];
            let number = |name: &str| expected[name].as_f64().unwrap();
            let (on, gap) = (met.on_fraction(), met.gap(0.5));
            assert!((on - number("on_fraction")).abs() < 0.01, "{name}, {band}: on {on}");
            assert!((gap - number("gap_median_s")).abs() < 0.1 + 1e-9, "{name}, {band}: median gap {gap} s");
        }
    }
}

/// A 2 m/s, 10 Hz probe in four bands, as the README of the record defines it: up every 20th frame.
fn probe(record: &Arc<Recording>, kernel: RecordedKernel) -> Vec<Band> {
    let mut probe = Probe::new(&[20.0, 100.0, 300.0, 600.0, 950.0]);
    for frame in (0..=1080).step_by(20) {
        let still =
            Still::new(&RecordedPlume { kernel, ..RecordedPlume::new(Arc::clone(record)) }, f64::from(frame) * 5.0);
        let places = record.alive(f64::from(frame) * 5.0).map(|(place, _)| place);
        probe.fly(record.source(), Heading::from_degrees(180.0), places, |p| still.reading(p) > 0.04);
    }
    probe.bands
}

/// The index leaves out nothing that counts, at any place and in any order of times.
#[test]
fn the_index_reads_what_all_filaments_read() {
    let record = record();
    let mut interval = interval::Interval::default();
    let mut read = 0;
    for k in 0..600 {
        let time = f64::from(k * 7919 % 5400) + 0.1 * f64::from(k % 10);
        // Along the plume, beside it and beyond it.
        let p = Point::new(600.0 - 2.0 * f64::from(k), f64::from(k % 41) - 30.0);
        for (kernel, name) in KERNELS {
            let all = record.concentration(kernel, p, time);
            interval.turn_to(&record, time);
            near(interval.concentration(&record, kernel, p, time), all, name);
            read += usize::from(all > 1e-3);
        }
    }
    assert!(read > 300, "{read} places with chemical");
}

#[test]
fn seeds_begin_at_their_own_moments_and_end_with_the_record() {
    let spread = RecordedPlume { start: 100.0, start_spread: 3000.0, ..RecordedPlume::new(record()) };
    let p = Point::new(331.7, -35.0);
    let begins: Vec<f64> = (0..200)
        .map(|seed| {
            let playback = Playback::new(&spread, seed);
            let reaches = |time: &f64| playback.end_before(*time).is_none();
            // Whole seconds that are left of it.
            (0..5401).map(f64::from).take_while(reaches).last().map(|left| 5400.0 - left).unwrap()
        })
        .collect();
    let mean = begins.iter().sum::<f64>() / 200.0;
    assert!(begins.iter().all(|begin| (100.0..=3101.0).contains(begin)), "{begins:?}");
    assert!((mean - 1600.0).abs() < 150.0, "{mean}");
    let mut fixed = Playback::new(&RecordedPlume { start: 100.0, ..RecordedPlume::new(record()) }, 1);
    let expected = 0.04 * record().concentration(RecordedKernel::Pompy, p, 107.3);
    assert!((fixed.reading(p, 7.3) - expected).abs() < 1e-9 && (fixed.look_up(p, 7.3) - expected).abs() < 1e-12);
    assert_eq!(fixed.end_before(5300.0), None);
    assert_eq!(
        fixed.end_before(5300.1).unwrap(),
        "the recorded plume ends after 5400 s, 5300.0 s from the start of the run"
    );
}
