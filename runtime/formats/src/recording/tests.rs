//! Records: that in `missions/recorded` against what its makers say of it, and spoilt ones against what is said of them.

use super::*;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

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

/// At a frame and between frames nothing jumps but by birth and by leaving.
#[test]
fn filaments_move_without_a_jump() {
    let record = record();
    for time in [5.0, 2500.0, 5395.0] {
        let at = |time: f64| -> Vec<(Point, f64)> { record.alive(time).collect() };
        let (before, after) = (at(time - 1e-6), at(time));
        // Whoever's last frame this is still counts; whoever is born in it is at the source.
        let born = after.len() - before.len();
        assert!(after[before.len()..].iter().all(|(p, _)| p.distance(record.source()) < 1.0), "{born} at {time} s");
        for (a, b) in before.iter().zip(&after) {
            assert!(a.0.distance(b.0) < 1e-5, "{a:?} {b:?} at {time} s");
        }
    }
}

#[test]
fn it_says_what_it_is() {
    let record = record();
    assert_eq!((record.name(), record.duration(), record.source()), ("case_a", 5400.0, Point::new(431.7, -27.3)));
    let corners = record.area().corners();
    assert!(corners.iter().all(|c| c.north.abs() == 547.0 && c.east.abs() == 183.5), "{corners:?}");
    let mean = record.mean_flow();
    assert!((mean.north + 0.12448).abs() < 1e-4 && (mean.east - 0.00347).abs() < 1e-4, "{mean:?}");
}

/// A record of two filaments in three frames, of which a test spoils a part.
fn small() -> (Value, Vec<u8>) {
    let mut header: Value = serde_json::from_str(&text()).unwrap();
    let mut binary = Vec::new();
    let mut sections = Vec::new();
    let mut add = |name: &str, dtype: &str, shape: &[usize], bytes: &[u8]| {
        let (offset, size) = (binary.len(), bytes.len());
        sections.push(json!({"name": name, "dtype": dtype, "shape": shape, "offset": offset, "bytes": size}));
        binary.extend_from_slice(bytes);
    };
    let ints = |numbers: [i32; 2]| numbers.map(i32::to_le_bytes).concat();
    add("id", "<i4", &[2], &ints([7, 9]));
    add("birth_s", "<f4", &[2], &[-20.0_f32, 3.0].map(f32::to_le_bytes).concat());
    add("first_frame", "<i4", &[2], &ints([0, 1]));
    add("n_frames", "<i4", &[2], &ints([2, 2]));
    add("north0", "<i4", &[2], &ints([3200, 13800]));
    add("east0", "<i4", &[2], &ints([-960, -864]));
    add("step", "|i1", &[2, 2], &[(-32_i8).cast_unsigned(), 0, (-16_i8).cast_unsigned(), 4]);
    add("flow", "<f4", &[3, 2, 2, 2], &[-0.125_f32, 0.01].map(f32::to_le_bytes).concat().repeat(12));
    header["record"] = json!({
        "frame_interval_s": 5, "n_frames": 3, "duration_s": 10, "quantum_m": 0.03125, "filaments": 2, "filament_frames": 4
    });
    header["flow_grid"] = json!({"north_m": [547.0, -547.0], "east_m": [-183.5, 183.5]});
    header["sections"] = json!(sections);
    header["sha256"] = json!("");
    (header, binary)
}

/// What is said of a small record once it is spoilt; its hash is made anew where it was not spoilt itself.
fn said(spoil: impl Fn(&mut Value, &mut Vec<u8>)) -> String {
    use sha2::Digest;
    let (mut header, mut binary) = small();
    spoil(&mut header, &mut binary);
    if header["sha256"] == "" {
        let hash = sha2::Sha256::digest(&binary);
        header["sha256"] = json!(hash.iter().map(|b| format!("{b:02x}")).collect::<String>());
    }
    let read = RecordingHeader::read(&header.to_string()).and_then(|header| header.decode(&binary));
    read.map_or_else(|error| error.to_string(), |record| format!("read, {} s", record.duration()))
}

/// Puts four bytes into a section of the small record: a number in its place.
fn put(binary: &mut [u8], word: usize, bytes: [u8; 4]) {
    binary[4 * word..4 * word + 4].copy_from_slice(&bytes);
}

#[test]
fn spoilt_records_are_refused_with_the_reason() {
    assert_eq!(said(|_, _| ()), "read, 10 s");
    for (said, expected) in [
        (said(|h, _| h["format"] = json!("movie")), "the header's format is `movie`"),
        (said(|h, _| h["version"] = json!(2)), "the record is of version 2; version 1 is read"),
        (said(|h, _| h["version"] = json!("new")), "is not one of a recorded plume"),
        (said(|h, _| h["record"] = json!(3)), "the header lacks something"),
        (said(|h, _| h["binary"] = json!("../case_a.bin")), "must be the name of a file beside the header"),
        (said(|h, _| h["byte_order"] = json!("big")), "it must be `little`"),
        (said(|h, _| h["sha256"] = json!("abc")), "it must be 64 hexadecimal digits"),
        (said(|h, _| h["sha256"] = json!("0".repeat(64))), "is not the file that the header was written for"),
        (
            said(|h, _| h["record"]["frame_interval_s"] = json!(0)),
            "`record.frame_interval_s` is 0.0: it must be above 0",
        ),
        (said(|h, _| h["record"]["n_frames"] = json!(1)), "it must be 2 to"),
        (
            said(|h, _| h["record"]["duration_s"] = json!(15)),
            "`record.duration_s` is 15.0: 3 frames every 5.0 s last 10.0 s",
        ),
        (said(|h, _| h["record"]["filament_frames"] = json!(1)), "each of 2 filaments has a frame at least"),
        (
            said(|h, _| h["record"]["filaments"] = json!(3)),
            "the section `id` has the shape [2]: the counts ask for [3]",
        ),
        (said(|h, _| h["flow_grid"]["north_m"] = json!([1, 2])), "must be two or more numbers that fall"),
        (said(|h, _| h["frame"]["operation_area_m"]["east"] = json!([5, 5])), "each pair must rise"),
        (said(|h, _| h["sections"][0]["dtype"] = json!("<i8")), "the section `id` is of type `<i8`: it must be `<i4`"),
        (said(|h, _| h["sections"][1]["name"] = json!("birth")), "must describe the section `birth_s` once"),
        (said(|h, _| h["sections"][6]["bytes"] = json!(5)), "the section `step` has 5 bytes"),
        (said(|h, _| h["sections"][7]["offset"] = json!(u64::MAX)), "the section `flow` ends beyond"),
        (
            said(|h, _| h["record"]["quantum_m"] = json!(1e20)),
            "`record.quantum_m` is 1e20: it must be above 0, and 1 at most",
        ),
        (said(|h, _| h["parameters"]["r0_m"] = json!(1e200)), "`parameters.r0_m` is 1e200: it must be above 0"),
        (
            said(|h, _| h["parameters"]["growth_m2_s"] = json!(1e308)),
            "`parameters.growth_m2_s` is 1e308: it must be 0 to",
        ),
        (said(|h, _| h["parameters"]["growth_m2_s"] = json!(1e-300)), "no filament grows to `concentration.r2_far`"),
        (said(|h, _| h["flow_grid"]["east_m"] = json!([0, 1e9])), "reaches farther than 1000000 m"),
        (said(|h, _| h["source"]["north_m"] = json!(548)), "`source` lies outside of `frame.operation_area_m`"),
        (said(|h, _| h["case"] = json!("")), "`case` has 0 letters"),
        (
            said(|h, _| h["sections"][5]["offset"] = h["sections"][4]["offset"].clone()),
            "the sections `north0` and `east0` overlap",
        ),
        (said(|h, _| h["sections"][4]["offset"] = json!(33)), "the sections `north0` and `east0` overlap"),
        (said(|_, b| put(b, 2, f32::NEG_INFINITY.to_le_bytes())), "filament 7 was released after -inf s: it is older"),
        (
            said(|_, b| [8, 9, 10, 11].into_iter().for_each(|word| put(b, word, 900_000_i32.to_le_bytes()))),
            "no filament ever comes into `frame.operation_area_m`",
        ),
        (said(|_, b| b.truncate(100)), "is cut short: it has 100 bytes of 148"),
        (said(|_, b| b.push(0)), "has 149 bytes: the header knows of 148"),
        (said(|_, b| put(b, 1, 7_i32.to_le_bytes())), "the ids do not ascend: 7 comes after 7"),
        (said(|_, b| put(b, 2, f32::NAN.to_le_bytes())), "filament 7 was released after NaN s"),
        (said(|_, b| put(b, 4, (-1_i32).to_le_bytes())), "filament 7 has a negative count of frames"),
        (said(|_, b| put(b, 5, 2_i32.to_le_bytes())), "filament 9 has 2 frames from 2 on: there are 3"),
        (said(|_, b| put(b, 7, 1_i32.to_le_bytes())), "the filaments have 3 frames together"),
        (said(|_, b| put(b, 8, i32::MAX.to_le_bytes())), "strays more than 16777216 quanta"),
        (said(|_, b| put(b, 15, 99.0_f32.to_le_bytes())), "number 2 of `flow` is 99"),
    ] {
        assert!(said.contains(expected), "{said}, not {expected}");
    }
    // Both filaments there from the first frame on but released after each other's frames.
    let order = said(|_, b| {
        put(b, 2, 3.0_f32.to_le_bytes());
        put(b, 4, 1_i32.to_le_bytes());
        put(b, 3, (-1.0_f32).to_le_bytes());
        put(b, 5, 0_i32.to_le_bytes());
    });
    assert!(order.contains("filament 9 is seen before one that was released before it"), "{order}");
    let both = said(|_, b| {
        put(b, 0, 9_i32.to_le_bytes());
        put(b, 6, 0_i32.to_le_bytes());
    });
    assert!(both.contains("do not ascend") && both.contains("filament 9 has 0 frames"), "{both}");
}

/// A header may hold a text of its full size wherever one stands.
#[test]
fn messages_do_not_grow_with_the_header() {
    let long = json!("e".repeat(1_000_000));
    let shape = json!(vec![7; 500_000]);
    let mut spoilt: Vec<Value> = Vec::new();
    for text in ["format", "case", "binary", "byte_order", "sha256", "version", "record"] {
        let (mut header, _) = small();
        header[text] = long.clone();
        spoilt.push(header);
    }
    for (part, value) in [("dtype", &long), ("shape", &shape)] {
        let (mut header, _) = small();
        header["sha256"] = json!("0".repeat(64));
        header["sections"][0][part] = value.clone();
        spoilt.push(header);
    }
    for header in spoilt {
        let error = RecordingHeader::read(&header.to_string()).unwrap_err();
        assert!(error.to_string().len() < 400 && !error.help.is_empty(), "{} letters", error.to_string().len());
    }
}

/// The laws between frames, on numbers that can be followed by hand.
#[test]
fn the_small_record_follows_the_rules_between_frames() {
    let (mut header, binary) = small();
    header["sha256"] = json!("");
    let read = |h: &Value| RecordingHeader::read(&h.to_string());
    assert!(read(&header).is_err());
    use sha2::Digest;
    let hash = sha2::Sha256::digest(&binary);
    header["sha256"] = json!(hash.iter().map(|b| format!("{b:02x}")).collect::<String>());
    let record = read(&header).unwrap().decode(&binary).unwrap();
    let at = |time: f64| -> Vec<Point> { record.alive(time).map(|(place, _)| place).collect() };
    assert_eq!(at(0.0), [Point::new(100.0, -30.0)]);
    assert_eq!(at(2.5), [Point::new(99.5, -30.0)], "half-way between frames");
    // Released after 3 s, half-way between source and first frame after 4 s.
    assert!(at(4.0)[1].distance(Point::new((431.7 + 431.25) / 2.0, (-27.3 - 27.0) / 2.0)) < 1e-9);
    assert_eq!(at(5.0), [Point::new(99.0, -30.0), Point::new(431.25, -27.0)], "in its last frame it still counts");
    assert_eq!(at(5.1).len(), 1);
    assert_eq!(at(10.0), [Point::new(430.75, -26.875)]);
    let radii: Vec<f64> = record.alive(2.0).map(|(_, r2)| r2).collect();
    assert!((radii[0] - (0.04 + 1e-4 * 22.0)).abs() < 1e-12);
    let flow = record.flow(Point::new(9000.0, 0.0), 99.0);
    assert!((flow - Vector::new(-0.125, 0.01)).length() < 1e-8, "{flow:?}");
}
