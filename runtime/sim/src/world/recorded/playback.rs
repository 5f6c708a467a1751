//! A record played back in a run.

use super::RecordedPlume;
use super::interval::Interval;
use crate::noise::{Noise, Stream};
use albacore_formats::recording::Recording;
use albacore_geometry::{Point, Vector};
use std::sync::Arc;

/// A record as one run meets it: its clock is the run's, its readings are ratios of the sensor's full scale.
#[derive(Clone, Debug)]
pub struct Playback {
    plume: RecordedPlume,
    /// The moment of the record at which the run began, s.
    begin: f64,
    interval: Interval,
}

/// A record at one moment.
#[derive(Clone, Debug)]
pub struct Still {
    plume: RecordedPlume,
    time: f64,
    interval: Interval,
}

impl Playback {
    /// A record begun where this seed begins it: evenly within the spread.
    pub fn new(plume: &RecordedPlume, seed: u64) -> Self {
        let mut begin = plume.start;
        if plume.start_spread > 0.0 {
            begin += plume.start_spread * Noise::new(seed, Stream::RecordStart).uniform(0);
        }
        Playback { plume: plume.clone(), begin, interval: Interval::default() }
    }

    /// The record.
    pub fn recording(&self) -> &Arc<Recording> {
        &self.plume.recording
    }

    /// Why a run cannot go on to a time (s): it is over when its record is, which is neither begun again nor frozen.
    pub fn end_before(&self, time: f64) -> Option<String> {
        let duration = self.plume.recording.duration();
        let left = duration - self.begin;
        (time > left)
            .then(|| format!("the recorded plume ends after {duration} s, {left:.1} s from the start of the run"))
    }

    /// The water's velocity at a point and a time of the run (s), m/s toward.
    pub fn flow(&self, p: Point, time: f64) -> Vector {
        self.plume.recording.flow(p, self.begin + time)
    }

    /// The reading at a point and a time of the run (s), ratio of full scale. It is not limited to full scale.
    pub fn reading(&mut self, p: Point, time: f64) -> f64 {
        let (RecordedPlume { recording, kernel, threshold, .. }, time) = (&self.plume, self.begin + time);
        self.interval.turn_to(recording, time);
        threshold * self.interval.concentration(recording, *kernel, p, time)
    }

    /// The record at a time of the run (s), for looks at many places.
    pub fn still(&self, time: f64) -> Still {
        Still::new(&self.plume, self.begin + time)
    }

    /// The same without an index: it adds up all filaments for each look-up.
    pub fn look_up(&self, p: Point, time: f64) -> f64 {
        let RecordedPlume { recording, kernel, threshold, .. } = &self.plume;
        threshold * recording.concentration(*kernel, p, self.begin + time)
    }

    /// The filaments alive at a time of the run (s): where they are and their radii, m.
    pub fn filaments(&self, time: f64) -> impl Iterator<Item = (Point, f64)> + '_ {
        self.plume.recording.alive(self.begin + time).map(|(place, r2)| (place, r2.sqrt()))
    }
}

impl Still {
    /// A record at one of its times, s.
    pub fn new(plume: &RecordedPlume, time: f64) -> Self {
        let mut interval = Interval::default();
        interval.turn_to(&plume.recording, time);
        Still { plume: plume.clone(), time, interval }
    }

    /// The reading at a point, ratio of full scale.
    pub fn reading(&self, p: Point) -> f64 {
        let RecordedPlume { recording, kernel, threshold, .. } = &self.plume;
        threshold * self.interval.concentration(recording, *kernel, p, self.time)
    }

    /// How many filaments are alive.
    pub fn filaments(&self) -> usize {
        self.interval.alive(self.time)
    }
}
