//! The filaments between two frames, sorted by north, so that a query looks at those near it only.

use super::header::Kernel;
use super::{RecordedKernel, Recording};
use albacore_geometry::Point;

/// A filament ends at this many radii. The checks of a record are good to a millionth of the smallest reading that counts,
/// 1e-6: what is cut off is 1e-14 of a filament's peak.
const CUT_RADII: f64 = 8.0;
/// Width of a strip, m.
const STRIP_M: f64 = 4.0;
/// No more strips than this, however far the filaments lie apart.
const STRIPS_MAX: f64 = 4096.0;

/// A filament on its straight way through the interval.
#[derive(Clone, Copy, Debug)]
struct Passage {
    /// Where it is at `since`, m.
    place: Point,
    /// How it moves, m/s north and east.
    velocity: [f64; 2],
    since: f64,
    until: f64,
    birth: f64,
}

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
        let frame = (time / recording.header.record.frame_interval_s).floor().max(0.0) as usize;
        if self.frame != Some(frame) {
            self.fill(recording, frame);
        }
    }

    /// The concentration at a point and a time (s) of the interval, in thresholds of detection.
    pub fn concentration(&self, recording: &Recording, kernel: RecordedKernel, p: Point, time: f64) -> f64 {
        let law = recording.kernel();
        self.near(p).iter().map(|passage| passage.reading(law, kernel, p, time)).sum()
    }

    /// How many filaments are alive at a time (s) of the interval.
    pub fn alive(&self, time: f64) -> usize {
        self.passages.iter().filter(|passage| passage.lives(time)).count()
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
        let r = &recording.header.record;
        let (begin, end) = (frame as f64 * r.frame_interval_s, (frame + 1) as f64 * r.frame_interval_s);
        let passages: Vec<Passage> = recording
            .tracks
            .iter()
            // Released in order: none after the first that is born too late.
            .take_while(|track| track.first <= frame + 1)
            .filter(|track| track.last >= frame)
            .map(|track| {
                let (since, from) = if track.first > frame {
                    (track.birth, recording.source())
                } else {
                    (begin, recording.in_frame(track, frame))
                };
                let place = from;
                // In its last frame it still counts, and is gone after.
                let (until, velocity) = if track.last > frame && end > since {
                    let way = recording.in_frame(track, frame + 1) - from;
                    (end, [way.north / (end - since), way.east / (end - since)])
                } else {
                    (begin, [0.0; 2])
                };
                Passage { place, velocity, since, until, birth: track.birth }
            })
            .collect();
        self.sort(passages, end, recording.kernel());
    }

    /// Sorts passages into strips by the middles of their ways: a counting sort, which keeps the order of release.
    fn sort(&mut self, passages: Vec<Passage>, end: f64, law: &Kernel) {
        let middles: Vec<f64> = passages.iter().map(Passage::middle).collect();
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

impl Passage {
    /// North of the middle of its way, m.
    fn middle(&self) -> f64 {
        self.place.north + 0.5 * self.velocity[0] * (self.until - self.since)
    }

    fn lives(&self, time: f64) -> bool {
        self.since <= time && time <= self.until
    }

    fn reading(&self, law: &Kernel, kernel: RecordedKernel, p: Point, time: f64) -> f64 {
        if !self.lives(time) {
            return 0.0;
        }
        let gone = time - self.since;
        let north = self.place.north + gone * self.velocity[0] - p.north;
        let east = self.place.east + gone * self.velocity[1] - p.east;
        let (d2, r2) = (north * north + east * east, law.squared_radius(time - self.birth));
        if d2 > CUT_RADII * CUT_RADII * r2 {
            return 0.0;
        }
        law.reading(kernel, d2, r2)
    }
}
