//! The binary of a record made into tracks and flow, every number looked at.

use super::flow::FlowRecord;
use super::header::AGE_MAX;
use super::{Recording, RecordingError, RecordingHeader, Track};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// No filament is farther than this from the origin, in quanta: half a million metres at 1/32 m.
const QUANTA_MAX: i64 = 1 << 24;
/// No recorded flow is faster than this, m/s.
const FLOW_MAX: f32 = 10.0;
/// The mends of a binary that is another, and of one that cannot be.
const FETCH_AGAIN: &str = "fetch header and binary again, both of one record";
const MAKE_AGAIN: &str = "mend it where the record is made: header and binary do not fit together";
/// So many faults of the data are told; the others are counted.
const FAULTS_MAX: usize = 8;

/// Faults of the data, of which only the first are told.
#[derive(Default)]
struct Faults {
    told: Vec<String>,
    more: usize,
}

impl RecordingHeader {
    /// The record of this header and its binary; else all that is wrong with the binary.
    pub fn decode(self, binary: &[u8]) -> Result<Recording, RecordingError> {
        let alone = |fault: String| RecordingError { faults: vec![fault], help: FETCH_AGAIN };
        let (wanted, given) = (self.bytes(), binary.len());
        if given < wanted {
            return Err(alone(format!("`{}` is cut short: it has {given} bytes of {wanted}", self.binary())));
        }
        if given > wanted {
            return Err(alone(format!("`{}` has {given} bytes: the header knows of {wanted}", self.binary())));
        }
        let found = hexadecimal(&Sha256::digest(binary));
        if found != self.sha256() {
            let (file, wanted) = (self.binary(), self.sha256());
            return Err(alone(format!(
                "`{file}` is not the file that the header was written for: its SHA-256 is {found}, not {wanted}"
            )));
        }
        let mut faults = Faults::default();
        let tracks = self.tracks(binary, &mut faults);
        let places = if faults.told.is_empty() { self.places(binary, &tracks, &mut faults) } else { Vec::new() };
        if faults.told.is_empty() && !places.iter().any(|place| self.area.gap(self.place(*place)) >= 0.0) {
            faults.push(String::from("no filament ever comes into `frame.operation_area_m`: the plume is empty there"));
        }
        let velocities = floats(&binary[self.layout.flow.clone()]);
        let wild = velocities.iter().position(|v| !v.is_finite() || v.abs() > FLOW_MAX);
        if let Some(at) = wild {
            faults.push(format!("number {at} of `flow` is {}: a flow is {FLOW_MAX} m/s at most", velocities[at]));
        }
        faults.none()?;
        let flow = FlowRecord::new(&self.grid, velocities);
        let area = self.area.clone();
        Ok(Recording { header: self, area, tracks, places, flow })
    }

    /// The lives of the filaments, in the order of their release.
    fn tracks(&self, binary: &[u8], faults: &mut Faults) -> Vec<Track> {
        let (l, r) = (&self.layout, &self.record);
        let (ids, births) = (ints(&binary[l.id.clone()]), floats(&binary[l.birth_s.clone()]));
        let (firsts, counts) = (ints(&binary[l.first_frame.clone()]), ints(&binary[l.n_frames.clone()]));
        let mut row = 0;
        let mut tracks: Vec<Track> = Vec::with_capacity(ids.len());
        for (i, (((&id, &birth), &first), &count)) in ids.iter().zip(&births).zip(&firsts).zip(&counts).enumerate() {
            if i > 0 && id <= ids[i - 1] {
                faults.push(format!("the ids do not ascend: {id} comes after {}", ids[i - 1]));
            }
            let (Ok(first), Ok(count)) = (usize::try_from(first), usize::try_from(count)) else {
                faults.push(format!("filament {id} has a negative count of frames"));
                continue;
            };
            if count == 0 || first.saturating_add(count) > r.n_frames {
                faults.push(format!("filament {id} has {count} frames from {first} on: there are {}", r.n_frames));
                continue;
            }
            let birth = f64::from(birth);
            if birth < -AGE_MAX {
                faults.push(format!("filament {id} was released after {birth} s: it is older than a year"));
            }
            // The first frame after its release, or that in which the record begins.
            let frames = birth / r.frame_interval_s;
            if !(frames <= first as f64 && (first == 0 || frames >= first as f64 - 1.0)) {
                faults.push(format!("filament {id} was released after {birth} s, which frame {first} does not follow"));
            }
            if tracks.last().is_some_and(|before| first < before.first) {
                faults.push(format!("filament {id} is seen before one that was released before it"));
            }
            tracks.push(Track { birth, first, last: first + count - 1, row });
            row += count;
        }
        if faults.told.is_empty() && row != r.filament_frames {
            let told = r.filament_frames;
            faults.push(format!("the filaments have {row} frames together: `record.filament_frames` says {told}"));
        }
        tracks
    }

    /// Where each filament is in each of its frames: the running sums of its steps.
    fn places(&self, binary: &[u8], tracks: &[Track], faults: &mut Faults) -> Vec<[i32; 2]> {
        let l = &self.layout;
        let (norths, easts) = (ints(&binary[l.north0.clone()]), ints(&binary[l.east0.clone()]));
        let mut steps = binary[l.step.clone()].as_chunks::<2>().0.iter();
        let mut places = Vec::with_capacity(self.record.filament_frames);
        for (number, (track, (&north, &east))) in tracks.iter().zip(norths.iter().zip(&easts)).enumerate() {
            let mut place = [i64::from(north), i64::from(east)];
            let mut astray = false;
            for frame in track.first..=track.last {
                if frame > track.first {
                    let Some(step) = steps.next() else { break };
                    place[0] += i64::from(step[0].cast_signed());
                    place[1] += i64::from(step[1].cast_signed());
                }
                astray |= place.iter().any(|quanta| quanta.abs() > QUANTA_MAX);
                places.push(place.map(|quanta| quanta as i32));
            }
            if astray {
                faults.push(format!(
                    "the filament in place {number} strays more than {QUANTA_MAX} quanta from the origin"
                ));
            }
        }
        places
    }
}

impl Faults {
    fn push(&mut self, fault: String) {
        if self.told.len() < FAULTS_MAX {
            self.told.push(fault);
        } else {
            self.more += 1;
        }
    }

    fn none(mut self) -> Result<(), RecordingError> {
        if self.more > 0 {
            self.told.push(format!("and {} more", self.more));
        }
        if self.told.is_empty() { Ok(()) } else { Err(RecordingError { faults: self.told, help: MAKE_AGAIN }) }
    }
}

fn ints(bytes: &[u8]) -> Vec<i32> {
    bytes.as_chunks::<4>().0.iter().map(|four| i32::from_le_bytes(*four)).collect()
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.as_chunks::<4>().0.iter().map(|four| f32::from_le_bytes(*four)).collect()
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
