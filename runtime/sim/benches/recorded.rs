//! What a recorded plume costs to ask, and to go on: `cargo bench -p albacore-sim --bench recorded`.

#![expect(clippy::unwrap_used, reason = "a benchmark without its record has nothing to measure")]

use albacore_formats::recording::RecordingHeader;
use albacore_geometry::Point;
use albacore_sim::{Playback, RecordedPlume};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use std::fs;
use std::sync::Arc;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../missions/recorded");
/// Between two frames of the record, s.
const MOMENT_S: f64 = 2702.5;
/// One filament in this many is a place to ask for.
const PLACES_EVERY: usize = 7;

fn main() {
    divan::main();
}

fn plume() -> RecordedPlume {
    let header = RecordingHeader::read(&fs::read_to_string(format!("{FOLDER}/case_a.json")).unwrap()).unwrap();
    RecordedPlume::new(Arc::new(header.decode(&fs::read(format!("{FOLDER}/case_a.bin")).unwrap()).unwrap()))
}

fn places(plume: &RecordedPlume) -> Vec<Point> {
    plume.recording.alive(MOMENT_S).map(|(place, _)| place).step_by(PLACES_EVERY).collect()
}

/// The header and the binary: hash, checks and running sums.
#[divan::bench(sample_count = 20)]
fn read(bencher: Bencher) {
    let header = RecordingHeader::read(&fs::read_to_string(format!("{FOLDER}/case_a.json")).unwrap()).unwrap();
    let binary = fs::read(format!("{FOLDER}/case_a.bin")).unwrap();
    bencher.bench_local(|| header.clone().decode(black_box(&binary)).unwrap());
}

/// Readings in the midst of filaments, where they cost most. The items are readings.
#[divan::bench(sample_count = 100)]
fn query(bencher: Bencher) {
    let plume = plume();
    let (places, mut playback) = (places(&plume), Playback::new(&plume, 1));
    bencher
        .counter(ItemsCount::new(places.len()))
        .bench_local(|| places.iter().map(|p| playback.reading(black_box(*p), MOMENT_S)).sum::<f64>());
}

/// The first reading after a frame, which makes the index of the next interval: once in 5 s of a run.
#[divan::bench(sample_count = 100)]
fn next_interval(bencher: Bencher) {
    let plume = plume();
    let (place, mut playback) = (places(&plume)[0], Playback::new(&plume, 1));
    let mut time = 0.0;
    bencher.bench_local(|| {
        time = if time > 5000.0 { 0.0 } else { time + 5.0 };
        playback.reading(place, time)
    });
}
