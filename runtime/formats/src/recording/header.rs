//! What a record says of itself, and whether its parts fit together.

use super::{RecordingError, shortened};
use albacore_geometry::math::exp;
use albacore_geometry::{AREA_WIDTH_MIN_M, Area, Heading, Point};
use serde::Deserialize;
use std::ops::Range;

/// What a header of ours begins with.
const FORMAT: &str = "recorded filament plume";
/// The version of the format that is read.
const VERSION: u32 = 1;
/// A header is no larger than this, bytes.
const HEADER_BYTES_MAX: usize = 4 * 1024 * 1024;
/// A record has no more frames than this.
const FRAMES_MAX: usize = 1_000_000;
/// Nothing of a record lies farther from the origin, m.
const FARTHEST_M: f64 = 1e6;
/// No filament is older when the record begins, and each has grown to `r2_far` at this age, s: a year.
pub(super) const AGE_MAX: f64 = 31_536_000.0;
/// Its name is no longer than this, characters.
const NAME_MAX: usize = 60;
/// What the duration that a header says may lose in decimals, as a share.
const DURATION_ROUNDING: f64 = 1e-6;
/// The mend of a header that cannot be.
const MEND: &str = "correct it where the record is made, or fetch header and binary again";

/// The header of a record whose parts fit together.
#[derive(Clone, Debug)]
pub struct RecordingHeader {
    name: String,
    binary: String,
    sha256: String,
    pub(super) record: Record,
    pub(super) source: Source,
    pub(super) kernel: Kernel,
    pub(super) release_rate: f64,
    pub(super) grid: Grid,
    pub(super) area: Area,
    pub(super) layout: Layout,
}

/// Where each section lies in the binary.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    pub id: Range<usize>,
    pub birth_s: Range<usize>,
    pub first_frame: Range<usize>,
    pub n_frames: Range<usize>,
    pub north0: Range<usize>,
    pub east0: Range<usize>,
    pub step: Range<usize>,
    pub flow: Range<usize>,
    /// Bytes of the whole binary.
    pub bytes: usize,
}

/// How a filament thins as it grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RecordedKernel {
    /// With its radius cubed: a Gaussian in three dimensions, the kernel of the model that made the record.
    #[default]
    Pompy,
    /// With its radius squared: a Gaussian in two, as in a flat plume of the simulator's own.
    Flat,
}

/// How a filament reads: c = q (r2_far / r2)^p exp(-d2 / 2 r2), where r2 = r0^2 + growth age.
#[derive(Clone, Debug)]
pub struct Kernel {
    peak: f64,
    far: f64,
    initial: f64,
    pub(super) growth: f64,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct Record {
    pub frame_interval_s: f64,
    pub n_frames: usize,
    duration_s: Option<f64>,
    pub quantum_m: f64,
    pub filaments: usize,
    pub filament_frames: usize,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct Source {
    north_m: f64,
    east_m: f64,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct Grid {
    pub north_m: Vec<f64>,
    pub east_m: Vec<f64>,
}

/// Which format a file is, whatever else is in it.
#[derive(Deserialize)]
struct Mark {
    format: String,
    version: u32,
}

#[derive(Deserialize)]
struct Raw {
    case: String,
    binary: String,
    byte_order: String,
    sha256: String,
    frame: Frame,
    record: Record,
    source: Source,
    concentration: Concentration,
    parameters: Parameters,
    flow_grid: Grid,
    sections: Vec<Section>,
}

#[derive(Deserialize)]
struct Frame {
    operation_area_m: Extent,
}

#[derive(Deserialize)]
struct Extent {
    north: [f64; 2],
    east: [f64; 2],
}

#[derive(Deserialize)]
struct Concentration {
    r2_far: f64,
    q: f64,
}

#[derive(Deserialize)]
struct Parameters {
    r0_m: f64,
    growth_m2_s: f64,
    release_per_s: f64,
}

#[derive(Deserialize)]
struct Section {
    name: String,
    dtype: String,
    shape: Vec<u64>,
    offset: u64,
    bytes: u64,
}

impl RecordingHeader {
    /// A binary is no larger than this, bytes; in memory it takes about four times as much.
    pub const BINARY_BYTES_MAX: u64 = 256 * 1024 * 1024;

    /// Reads a header; else all that is wrong with it.
    pub fn read(text: &str) -> Result<Self, RecordingError> {
        let alone = |fault: String| RecordingError { faults: vec![fault], help: MEND };
        if text.len() > HEADER_BYTES_MAX {
            return Err(alone(format!("the header is larger than {HEADER_BYTES_MAX} bytes")));
        }
        let mark: Mark = serde_json::from_str(text)
            .map_err(|error| alone(format!("the header is not one of a recorded plume: {}", unread(&error))))?;
        if mark.format != FORMAT {
            return Err(alone(format!("the header's format is `{}`, not `{FORMAT}`", shortened(&mark.format))));
        }
        if mark.version != VERSION {
            return Err(alone(format!("the record is of version {}; version {VERSION} is read", mark.version)));
        }
        let raw: Raw = serde_json::from_str(text)
            .map_err(|error| alone(format!("the header lacks something: {}", unread(&error))))?;
        raw.checked()
    }

    /// What the record is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file of the binary, in the folder of the header.
    pub fn binary(&self) -> &str {
        &self.binary
    }

    /// How large the binary is, bytes.
    pub fn bytes(&self) -> usize {
        self.layout.bytes
    }

    /// Where so many quanta north and east are.
    pub(super) fn place(&self, [north, east]: [i32; 2]) -> Point {
        let quantum = self.record.quantum_m;
        Point::new(f64::from(north) * quantum, f64::from(east) * quantum)
    }

    /// The SHA-256 of the binary, in lower-case hexadecimal digits.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }
}

/// Why a text is no header; of the text itself the beginning.
fn unread(error: &serde_json::Error) -> String {
    let (text, place) = (error.to_string(), format!(" at line {} column {}", error.line(), error.column()));
    shortened(text.strip_suffix(&place).unwrap_or(&text)) + &place
}

/// What is found wrong with a header.
#[derive(Default)]
struct Faults(Vec<String>);

impl Faults {
    fn unless(&mut self, holds: bool, fault: String) {
        if !holds {
            self.0.push(fault);
        }
    }
}

impl Raw {
    fn checked(self) -> Result<RecordingHeader, RecordingError> {
        let mut faults = Faults::default();
        self.check_names(&mut faults);
        self.check_amounts(&mut faults);
        self.check_counts(&mut faults);
        let area = self.checked_area(&mut faults);
        let Faults(mut faults) = faults;
        let layout = if faults.is_empty() { self.layout(&mut faults) } else { Layout::default() };
        let Some(area) = area.filter(|_| faults.is_empty()) else { return Err(RecordingError { faults, help: MEND }) };
        Ok(RecordingHeader {
            name: self.case,
            binary: self.binary,
            sha256: self.sha256.to_ascii_lowercase(),
            kernel: Kernel {
                peak: self.concentration.q,
                far: self.concentration.r2_far,
                initial: self.parameters.r0_m * self.parameters.r0_m,
                growth: self.parameters.growth_m2_s,
            },
            release_rate: self.parameters.release_per_s,
            record: self.record,
            source: self.source,
            grid: self.flow_grid,
            area,
            layout,
        })
    }

    fn check_names(&self, faults: &mut Faults) {
        let letters = self.case.chars().count();
        faults.unless(
            (1..=NAME_MAX).contains(&letters),
            format!("`case` has {letters} letters: it must have 1 to {NAME_MAX}"),
        );
        let plain = !self.binary.is_empty() && !self.binary.starts_with('.') && !self.binary.contains(['/', '\\']);
        faults.unless(
            plain,
            format!("`binary` is `{}`: it must be the name of a file beside the header", shortened(&self.binary)),
        );
        let order = shortened(&self.byte_order);
        faults.unless(self.byte_order == "little", format!("`byte_order` is `{order}`: it must be `little`"));
        let hexadecimal = self.sha256.len() == 64 && self.sha256.bytes().all(|b| b.is_ascii_hexdigit());
        let digits = shortened(&self.sha256);
        faults.unless(hexadecimal, format!("`sha256` is `{digits}`: it must be 64 hexadecimal digits"));
    }

    /// What is beyond these is no plume in water: it would come to numbers that are none, or to a plume of nothing.
    fn check_amounts(&self, faults: &mut Faults) {
        for (name, value, most) in [
            ("record.frame_interval_s", self.record.frame_interval_s, 86_400.0),
            ("record.quantum_m", self.record.quantum_m, 1.0),
            ("concentration.r2_far", self.concentration.r2_far, 1e8),
            ("concentration.q", self.concentration.q, 1e9),
            ("parameters.r0_m", self.parameters.r0_m, 1e3),
            ("parameters.release_per_s", self.parameters.release_per_s, 1e6),
        ] {
            faults.unless(
                value > 0.0 && value <= most,
                format!("`{name}` is {value:?}: it must be above 0, and {most} at most"),
            );
        }
        let growth = self.parameters.growth_m2_s;
        faults.unless(
            (0.0..=1e4).contains(&growth),
            format!("`parameters.growth_m2_s` is {growth:?}: it must be 0 to 10000"),
        );
        faults.unless(
            growth == 0.0 || self.concentration.r2_far <= growth * AGE_MAX,
            format!(
                "`parameters.growth_m2_s` is {growth:?}: with it no filament grows to `concentration.r2_far` in a year"
            ),
        );
    }

    fn check_counts(&self, faults: &mut Faults) {
        let r = &self.record;
        faults.unless(
            (2..=FRAMES_MAX).contains(&r.n_frames),
            format!("`record.n_frames` is {}: it must be 2 to {FRAMES_MAX}", r.n_frames),
        );
        // It is said twice: by the number of frames, and in seconds.
        let duration = r.n_frames.saturating_sub(1) as f64 * r.frame_interval_s;
        let said = r.duration_s.unwrap_or(duration);
        faults.unless(
            (said - duration).abs() <= DURATION_ROUNDING * duration,
            format!(
                "`record.duration_s` is {said:?}: {} frames every {:?} s last {duration:?} s",
                r.n_frames, r.frame_interval_s
            ),
        );
        faults.unless(r.filaments > 0, String::from("`record.filaments` is 0: there is no plume"));
        faults.unless(
            r.filament_frames >= r.filaments,
            format!(
                "`record.filament_frames` is {}: each of {} filaments has a frame at least",
                r.filament_frames, r.filaments
            ),
        );
    }

    /// The area of operation, with what is wrong with it, with the grid of the flow and with the place of the source.
    fn checked_area(&self, faults: &mut Faults) -> Option<Area> {
        let grid = &self.flow_grid;
        faults.unless(
            grid.north_m.len() >= 2 && grid.north_m.windows(2).all(|w| w[0] > w[1]),
            String::from("`flow_grid.north_m` must be two or more numbers that fall"),
        );
        faults.unless(
            grid.east_m.len() >= 2 && grid.east_m.windows(2).all(|w| w[0] < w[1]),
            String::from("`flow_grid.east_m` must be two or more numbers that rise"),
        );
        let area = self.frame.operation_area_m.area();
        faults.unless(area.is_some(), String::from("`frame.operation_area_m` is no area: each pair must rise"));
        let Extent { north, east } = self.frame.operation_area_m;
        faults.unless(
            grid.north_m.iter().chain(&grid.east_m).chain(&north).chain(&east).all(|m| m.abs() <= FARTHEST_M),
            format!("`flow_grid` or `frame.operation_area_m` reaches farther than {FARTHEST_M} m"),
        );
        faults.unless(
            area.as_ref().is_none_or(|area| area.gap(self.source.place()) >= 0.0),
            String::from("`source` lies outside of `frame.operation_area_m`"),
        );
        area
    }

    /// Where each section lies, if each is there once, of the type and shape that the counts ask for.
    fn layout(&self, faults: &mut Vec<String>) -> Layout {
        let (each, all) = (self.record.filaments as u64, self.record.filament_frames as u64);
        let grid = [self.flow_grid.north_m.len() as u64, self.flow_grid.east_m.len() as u64];
        let mut section =
            |name: &str, dtype: &str, width: u64, shape: &[u64]| match self.section(name, dtype, width, shape) {
                Ok(range) => range,
                Err(fault) => {
                    faults.push(fault);
                    0..0
                }
            };
        let mut layout = Layout {
            id: section("id", "<i4", 4, &[each]),
            birth_s: section("birth_s", "<f4", 4, &[each]),
            first_frame: section("first_frame", "<i4", 4, &[each]),
            n_frames: section("n_frames", "<i4", 4, &[each]),
            north0: section("north0", "<i4", 4, &[each]),
            east0: section("east0", "<i4", 4, &[each]),
            step: section("step", "|i1", 1, &[all - each, 2]),
            flow: section("flow", "<f4", 4, &[self.record.n_frames as u64, grid[0], grid[1], 2]),
            bytes: 0,
        };
        for fault in layout.overlaps() {
            faults.push(fault);
        }
        layout.bytes = layout.ranges().iter().map(|(_, range)| range.end).max().unwrap_or(0);
        layout
    }

    fn section(&self, name: &str, dtype: &str, width: u64, shape: &[u64]) -> Result<Range<usize>, String> {
        let mut named = self.sections.iter().filter(|section| section.name == name);
        let (Some(section), None) = (named.next(), named.next()) else {
            return Err(format!("the header must describe the section `{name}` once"));
        };
        if section.dtype != dtype {
            let found = shortened(&section.dtype);
            return Err(format!("the section `{name}` is of type `{found}`: it must be `{dtype}`"));
        }
        if section.shape != shape {
            let found = shortened(&format!("{:?}", section.shape));
            return Err(format!("the section `{name}` has the shape {found}: the counts ask for {shape:?}"));
        }
        let bytes = shape.iter().try_fold(width, |bytes, n| bytes.checked_mul(*n));
        if bytes != Some(section.bytes) {
            return Err(format!("the section `{name}` has {} bytes, which do not hold its shape", section.bytes));
        }
        let end = section.offset.checked_add(section.bytes).filter(|end| *end <= RecordingHeader::BINARY_BYTES_MAX);
        let (Ok(begin), Some(Ok(end))) = (usize::try_from(section.offset), end.map(usize::try_from)) else {
            let most = RecordingHeader::BINARY_BYTES_MAX;
            return Err(format!("the section `{name}` ends beyond {most} bytes, the most that is read"));
        };
        Ok(begin..end)
    }
}

impl Layout {
    fn ranges(&self) -> [(&'static str, &Range<usize>); 8] {
        let Layout { id, birth_s, first_frame, n_frames, north0, east0, step, flow, .. } = self;
        [
            ("id", id),
            ("birth_s", birth_s),
            ("first_frame", first_frame),
            ("n_frames", n_frames),
            ("north0", north0),
            ("east0", east0),
            ("step", step),
            ("flow", flow),
        ]
    }

    /// No byte is of two sections.
    fn overlaps(&self) -> Vec<String> {
        let mut ranges = self.ranges();
        ranges.sort_by_key(|(_, range)| (range.start, range.end));
        let overlap = ranges.windows(2).filter(|pair| pair[0].1.end > pair[1].1.start);
        overlap.map(|pair| format!("the sections `{}` and `{}` overlap", pair[0].0, pair[1].0)).collect()
    }
}

impl Extent {
    fn area(&self) -> Option<Area> {
        let ([south, north], [west, east]) = (self.north, self.east);
        let center = Point::new(0.5 * (south + north), 0.5 * (west + east));
        let (length, width) = (north - south, east - west);
        let is_area = length >= AREA_WIDTH_MIN_M && width >= AREA_WIDTH_MIN_M;
        is_area.then(|| Area::rectangle(center, Heading::NORTH, length, width))
    }
}

impl Source {
    pub fn place(&self) -> Point {
        Point::new(self.north_m, self.east_m)
    }
}

impl Kernel {
    /// Squared radius at an age (s), m2.
    pub fn squared_radius(&self, age: f64) -> f64 {
        self.initial + self.growth * age
    }

    /// The peak that the record is scaled by, in thresholds of detection, and the age (s) of a filament that has it.
    pub fn far_peak(&self) -> (f64, f64) {
        let age = if self.growth > 0.0 { (self.far - self.initial) / self.growth } else { 0.0 };
        (self.peak, age.max(0.0))
    }

    /// What a filament of a squared radius (m2) reads at a squared distance (m2), in thresholds of detection.
    pub fn reading(&self, kernel: RecordedKernel, d2: f64, r2: f64) -> f64 {
        let thinning = self.far / r2;
        let peak = match kernel {
            RecordedKernel::Pompy => self.peak * thinning * thinning.sqrt(),
            RecordedKernel::Flat => self.peak * thinning,
        };
        peak * exp(-d2 / (2.0 * r2))
    }
}
