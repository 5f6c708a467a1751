//! A plume that was computed elsewhere: filaments on their way, and the flow that carried them.
//!
//! A record is a header, which is JSON, and a binary: the tracks of all filaments frame by frame, and the flow on a grid.
//! [`RecordingHeader`] says what the binary must be, [`Recording`] is both together.

mod decode;
mod flow;
mod header;
#[cfg(test)]
mod tests;

pub use header::{Kernel, RecordedKernel, RecordingHeader};

use albacore_geometry::{Area, Point, Vector};
use flow::FlowRecord;

/// Why a record cannot be used: every fault found in the part that was looked at.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", faults.join("; "))]
pub struct RecordingError {
    /// One sentence each.
    pub faults: Vec<String>,
    /// The mend of them all.
    pub help: &'static str,
}

/// So many characters of a record's own text stand in a message at most.
const QUOTED_MAX: usize = 60;

/// The beginning of a record's own text, for a message.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(QUOTED_MAX) {
        None => text.to_string(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// A recorded plume, read and checked.
#[derive(Debug)]
pub struct Recording {
    header: RecordingHeader,
    area: Area,
    tracks: Vec<Track>,
    /// Where each filament is in each of its frames, in quanta north and east: track after track.
    places: Vec<[i32; 2]>,
    flow: FlowRecord,
}

/// One filament's life.
#[derive(Clone, Copy, Debug)]
struct Track {
    /// When it was released, s.
    birth: f64,
    /// The first frame in which it is alive, and the last.
    first: usize,
    last: usize,
    /// Where its places begin.
    row: usize,
}

impl Recording {
    /// What it is called.
    pub fn name(&self) -> &str {
        self.header.name()
    }

    /// The SHA-256 of its binary, in hexadecimal digits.
    pub fn sha256(&self) -> &str {
        self.header.sha256()
    }

    /// How long it lasts, s: it is known from 0 to here.
    pub fn duration(&self) -> f64 {
        (self.header.record.n_frames - 1) as f64 * self.header.record.frame_interval_s
    }

    /// Where the chemical comes from.
    pub fn source(&self) -> Point {
        self.header.source.place()
    }

    /// Filaments that it releases a second, on average.
    pub fn release_rate(&self) -> f64 {
        self.header.release_rate
    }

    /// Radius of a filament when it is released, m: the standard deviation of its Gaussian.
    pub fn initial_radius(&self) -> f64 {
        self.header.kernel.squared_radius(0.0).sqrt()
    }

    /// Growth of a filament's squared radius, m2/s.
    pub fn growth(&self) -> f64 {
        self.header.kernel.growth
    }

    /// What a filament reads in its middle when it is as old as it gets on its way through the area at the mean flow, in
    /// thresholds of detection; and that age, s.
    pub fn far_peak(&self) -> (f64, f64) {
        self.header.kernel.far_peak()
    }

    /// The area that the record covers.
    pub fn area(&self) -> &Area {
        &self.area
    }

    /// Filaments alive at a time, s: where they are, and their squared radii (m2). Straight from the tracks, all of them.
    pub fn alive(&self, time: f64) -> impl Iterator<Item = (Point, f64)> + '_ {
        let frames = time / self.header.record.frame_interval_s;
        let living = self.tracks.iter().filter(move |t| t.birth <= time && frames <= t.last as f64);
        living.map(move |track| (self.place(track, time), self.header.kernel.squared_radius(time - track.birth)))
    }

    /// The concentration at a point and time (s), in thresholds of detection: the sum over every filament alive, one by one.
    /// The reference that a player is held to.
    pub fn concentration(&self, kernel: RecordedKernel, p: Point, time: f64) -> f64 {
        let one = |(place, r2): (Point, f64)| {
            let d = place - p;
            self.kernel().reading(kernel, d.dot(d), r2)
        };
        self.alive(time).map(one).sum()
    }

    /// The water's velocity at a point and time (s), m/s toward: bilinear in space, linear in time; beyond the grid that of
    /// its edge.
    pub fn flow(&self, p: Point, time: f64) -> Vector {
        self.flow.at(p, time / self.header.record.frame_interval_s)
    }

    /// The mean of the flow over the grid and all frames, m/s toward.
    pub fn mean_flow(&self) -> Vector {
        self.flow.mean()
    }

    /// Where a filament is at a time of its life: on a straight line from frame to frame, and from the source to its first.
    fn place(&self, track: &Track, time: f64) -> Point {
        let interval = self.header.record.frame_interval_s;
        let frames = time / interval;
        if frames < track.first as f64 {
            let (first, source) = (self.in_frame(track, track.first), self.source());
            let share = (time - track.birth) / (track.first as f64 * interval - track.birth);
            return source + share * (first - source);
        }
        let early = (frames.floor() as usize).min(track.last);
        let here = self.in_frame(track, early);
        let next = self.in_frame(track, (early + 1).min(track.last));
        here + (frames - early as f64) * (next - here)
    }

    /// The filaments that are alive at some time from a frame to the next, in the order of their release, each on its straight way.
    pub fn passages(&self, frame: usize) -> impl Iterator<Item = Passage> + '_ {
        let interval = self.header.record.frame_interval_s;
        let (begin, end) = (frame as f64 * interval, (frame + 1) as f64 * interval);
        // Released in order: none after the first that is born too late.
        let begun = self.tracks.iter().take_while(move |track| track.first <= frame + 1);
        begun.filter(move |track| track.last >= frame).map(move |track| {
            let (since, from) =
                if track.first > frame { (track.birth, self.source()) } else { (begin, self.in_frame(track, frame)) };
            let place = from;
            // In its last frame it still counts, and is gone after.
            let (until, velocity) = if track.last > frame && end > since {
                let way = self.in_frame(track, frame + 1) - from;
                (end, [way.north / (end - since), way.east / (end - since)])
            } else {
                (begin, [0.0; 2])
            };
            Passage { place, velocity, since, until, birth: track.birth }
        })
    }

    /// Seconds from frame to frame.
    pub fn frame_interval(&self) -> f64 {
        self.header.record.frame_interval_s
    }

    /// Where a filament is in a frame of its life.
    fn in_frame(&self, track: &Track, frame: usize) -> Point {
        self.header.place(self.places[track.row + frame - track.first])
    }

    /// How its filaments read.
    pub fn kernel(&self) -> &Kernel {
        &self.header.kernel
    }
}

/// A filament on its straight way from a frame to the next.
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// Where it is at `since`, m.
    pub place: Point,
    /// How it moves, m/s north and east.
    pub velocity: [f64; 2],
    /// From when on it is on that way, s.
    pub since: f64,
    /// Until when, s.
    pub until: f64,
    /// When it was released, s.
    pub birth: f64,
}
