//! The filaments between two frames, sorted by north, so that a query looks at those near it only.

use albacore_formats::recording::{Kernel, Passage, RecordedKernel, Recording};
use albacore_geometry::Point;

/// A filament ends at this many radii. The checks of a record are good to a millionth of the smallest reading that counts,
/// 1e-6: what is cut off is 1e-14 of a filament's peak.
const CUT_RADII: f64 = 8.0;
/// Width of a strip, m.
const STRIP_M: f64 = 4.0;
/// No more strips than this, however far the filaments lie apart.
const STRIPS_MAX: f64 = 4096.0;

/// All filaments alive at some time of an interval.
#[derive(Clone, Debug, Default)]
pub(super) struct Interval {
    /// The frame that it begins with; none before the first query.
    frame: Option<usize>,
    /// Strip after strip from the south.
    passages: Vec<Passage>,
    /// Where each strip begins; one more at the end.
    strips: Vec<u32>,
    southmost: f64,
    width: f64,
    /// How far from the middle of its way a filament can matter, m.
    reach: f64,
}

impl Interval {
    /// Makes it the interval that holds a time of the record, s.
    pub fn turn_to(&mut self, recording: &Recording, time: f64) {
        let frame = (time / recording.frame_interval()).floor().max(0.0) as usize;
        if self.frame != Some(frame) {
            self.fill(recording, frame);
        }
    }

    /// The concentration at a point and a time (s) of the interval, in thresholds of detection.
    pub fn concentration(&self, recording: &Recording, kernel: RecordedKernel, p: Point, time: f64) -> f64 {
        let law = recording.kernel();
        self.near(p).iter().map(|passage| reading(passage, law, kernel, p, time)).sum()
    }

    /// How many filaments are alive at a time (s) of the interval.
    pub fn alive(&self, time: f64) -> usize {
        self.passages.iter().filter(|passage| lives(passage, time)).count()
    }

    /// The passages of the strips that a query can reach.
    fn near(&self, p: Point) -> &[Passage] {
        let last = self.strips.len().saturating_sub(1);
        // The casts saturate: what is south of every strip is 0, what is north of them is cut to the last.
        let strip = |north: f64| ((north - self.southmost) / self.width).floor();
        let (low, high) = (strip(p.north - self.reach) as usize, strip(p.north + self.reach) + 1.0);
        let (low, high) = (low.min(last), (high as usize).min(last));
        match (self.strips.get(low), self.strips.get(high)) {
            (Some(&low), Some(&high)) => &self.passages[low as usize..high as usize],
            _ => &[],
        }
    }

    /// Makes it the interval that begins with a frame.
    fn fill(&mut self, recording: &Recording, frame: usize) {
        self.frame = Some(frame);
        let end = (frame + 1) as f64 * recording.frame_interval();
        self.sort(recording.passages(frame).collect(), end, recording.kernel());
    }

    /// Sorts passages into strips by the middles of their ways: a counting sort, which keeps the order of release.
    fn sort(&mut self, passages: Vec<Passage>, end: f64, law: &Kernel) {
        let middles: Vec<f64> = passages.iter().map(middle).collect();
        let (south, north) = middles.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(s, n), &m| (s.min(m), n.max(m)));
        let span = (north - south).max(0.0);
        self.southmost = south;
        self.width = STRIP_M.max(span / STRIPS_MAX);
        let oldest = passages.iter().map(|p| end - p.birth).fold(0.0, f64::max);
        let longest = passages.iter().map(|p| (p.velocity[0] * (p.until - p.since)).abs()).fold(0.0, f64::max);
        self.reach = CUT_RADII * law.squared_radius(oldest).sqrt() + 0.5 * longest;
        let count = if passages.is_empty() { 0 } else { (span / self.width) as usize + 1 };
        let strip = |middle: f64| (((middle - south) / self.width) as usize).min(count.saturating_sub(1));
        self.strips.clear();
        self.strips.resize(count + 1, 0);
        for &middle in &middles {
            self.strips[strip(middle) + 1] += 1;
        }
        for i in 0..count {
            self.strips[i + 1] += self.strips[i];
        }
        let mut next = self.strips.clone();
        self.passages.clone_from(&passages);
        for (passage, &middle) in passages.iter().zip(&middles) {
            let slot = &mut next[strip(middle)];
            self.passages[*slot as usize] = *passage;
            *slot += 1;
        }
    }
}

/// North of the middle of its way, m.
fn middle(passage: &Passage) -> f64 {
    passage.place.north + 0.5 * passage.velocity[0] * (passage.until - passage.since)
}

fn lives(passage: &Passage, time: f64) -> bool {
    passage.since <= time && time <= passage.until
}

fn reading(passage: &Passage, law: &Kernel, kernel: RecordedKernel, p: Point, time: f64) -> f64 {
    if !lives(passage, time) {
        return 0.0;
    }
    let gone = time - passage.since;
    let north = passage.place.north + gone * passage.velocity[0] - p.north;
    let east = passage.place.east + gone * passage.velocity[1] - p.east;
    let (d2, r2) = (north * north + east * east, law.squared_radius(time - passage.birth));
    if d2 > CUT_RADII * CUT_RADII * r2 {
        return 0.0;
    }
    law.reading(kernel, d2, r2)
}
