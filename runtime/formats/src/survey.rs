//! Surveys of the bottom: from the bytes of a file to depths on an even grid, on the globe or in local metres.
//!
//! Two formats are read: text, as `csv.rs` tells, and NetCDF classic by the COARDS and CF conventions, as
//! `conventions.rs` tells. The classic format is read by hand: it is small, and the only crate for it that is alive
//! (`netcdf3`) makes room for as many dimensions and attributes as a header announces before it has looked whether the bytes
//! are there. Whatever the bytes are, reading them ends, allocates a small multiple of their number at most, and gives a
//! whole survey or all that is wrong with it.

mod axis;
mod classic;
mod conventions;
mod csv;
mod grid;
mod marks;

pub use axis::Axis;
pub use grid::{Extent, Kind, Placing, Survey};

use crate::fault::{Fault, Faults, Unreadable};

/// A file has at most this many bytes: a survey of [`CELLS_MAX`] cells as numbers of eight bytes, and a little more.
pub const FILE_BYTES_MAX: u64 = 40_000_000;
/// A grid has at most this many cells: 2000 a side.
pub const CELLS_MAX: u64 = 4_000_000;

/// The mend of a grid that is too large.
const CUT_IT: &str =
    "cut out the part that is needed, such as with `ncks -d lat,10.,12. -d lon,140.,143. IN.nc OUT.nc`";

/// What an HDF5 file begins with, behind a block of the user's own if it has one.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
/// The smallest such block, bytes; each larger one is twice as large (HDF5 File Format Specification, II.A).
const USER_BLOCK: usize = 512;

/// Files that are neither text nor NetCDF classic by how they begin, what they are, and what makes a file of them that is.
const FOREIGN: [(&[u8], &str, &str); 7] = [
    (HDF5, "a NetCDF-4 (HDF5) file", "convert it with `nccopy -k classic IN.nc OUT.nc`"),
    (b"CDF\x05", "a NetCDF file with 64-bit data (CDF-5)", "convert it with `nccopy -k classic IN.nc OUT.nc`"),
    (b"II*\0", "a TIFF file", "convert it with `gdal_translate -of netCDF -co FORMAT=NC IN.tif OUT.nc`"),
    (b"MM\0*", "a TIFF file", "convert it with `gdal_translate -of netCDF -co FORMAT=NC IN.tif OUT.nc`"),
    (b"ncols", "an Esri ASCII grid", "convert it with `gdal_translate -of netCDF -co FORMAT=NC IN.asc OUT.nc`"),
    (b"\x1f\x8b", "a compressed file", "unpack it with `gunzip`"),
    (b"PK\x03\x04", "an archive", "unpack it with `unzip`"),
];

/// Reads a survey, else tells all that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<Survey, Unreadable> {
    let mut faults = Faults::default();
    let survey = read_into(bytes, &mut faults);
    match (survey, faults.into_unreadable()) {
        (Some(survey), None) => Ok(survey),
        (_, Some(unreadable)) => Err(unreadable),
        (None, None) => Err(Unreadable::of(Fault::new(
            "the file holds no survey",
            "the language's reference tells under scenarios what one looks like",
        ))),
    }
}

fn read_into(bytes: &[u8], faults: &mut Faults) -> Option<Survey> {
    if bytes.len() as u64 > FILE_BYTES_MAX {
        let megabytes = bytes.len() as f64 / 1e6;
        let most = FILE_BYTES_MAX as f64 / 1e6;
        faults.add(format!("the file has {megabytes:.1} MB: {most} MB are read at most"), CUT_IT);
        return None;
    }
    if let Some((_, what, mend)) = FOREIGN.iter().find(|(magic, ..)| begins(bytes, magic)) {
        faults.add(format!("this is {what}: only CSV and NetCDF classic are read"), *mend);
        return None;
    }
    if bytes.starts_with(b"CDF") { conventions::read(bytes, faults) } else { csv::read(bytes, faults) }
}

/// Whether a file begins so, in letters of either case.
fn begins(bytes: &[u8], magic: &[u8]) -> bool {
    let at = |place: usize| bytes.get(place..).is_some_and(|rest| rest.starts_with(magic));
    let mut user_blocks =
        std::iter::successors(Some(USER_BLOCK), |size| Some(2 * size)).take_while(|size| *size < bytes.len());
    bytes.get(..magic.len()).is_some_and(|first| first.eq_ignore_ascii_case(magic))
        || (magic == HDF5 && user_blocks.any(at))
}
