//! A run as files that other programs read. [`Exported`] is all that is known of a run, as plain columns, tracks, reports and events;
//! each format is a pure function from it to bytes. [`FORMATS`] is the one table of them.

mod alog;
mod csv;
mod exported;
mod geojson;
mod gpx;
mod kml;
mod mcap;
mod netcdf;
mod text;

pub use exported::{
    About, Column, Exported, Happened, Outline, Place, Reported, Role, TICK_MS, Track, Values, name_in_programs,
};
pub use text::no_formula;

/// A format.
#[derive(Clone, Copy)]
pub struct Format {
    /// Its name, which is the option of the command line.
    pub name: &'static str,
    /// What it is, as `--help` says it.
    pub about: &'static str,
    /// How its file is called.
    pub file: &'static str,
    /// Whether it has places on the globe alone: a mission in a plane of its own cannot be written in it.
    pub is_on_globe: bool,
    /// Whether it tells when by the clock something was.
    pub has_clock: bool,
    /// The file's bytes.
    pub make: fn(&Exported) -> Vec<u8>,
}

/// All of them, in the order in which they are written.
pub const FORMATS: [Format; 7] = [
    Format {
        name: "csv",
        about: "A table with a row for each tick: all samples, commands, behaviors, reports and, in simulation, the truth",
        file: "track.csv",
        is_on_globe: false,
        has_clock: false,
        make: csv::make,
    },
    Format {
        name: "geojson",
        about: "Track, areas and reports as GeoJSON, for QGIS and web maps",
        file: "track.geojson",
        is_on_globe: true,
        has_clock: true,
        make: geojson::make,
    },
    Format {
        name: "kml",
        about: "Track in time, areas and reports as KML, for Google Earth",
        file: "track.kml",
        is_on_globe: true,
        has_clock: true,
        make: kml::make,
    },
    Format {
        name: "gpx",
        about: "Track in time, areas and reports as GPX, for chart plotters",
        file: "track.gpx",
        is_on_globe: true,
        has_clock: true,
        make: gpx::make,
    },
    Format {
        name: "netcdf",
        about: "All columns as a trajectory by the CF conventions, in NetCDF classic",
        file: "track.nc",
        is_on_globe: false,
        has_clock: true,
        make: netcdf::make,
    },
    Format {
        name: "mcap",
        about: "All columns and events as MCAP with JSON messages, for Foxglove",
        file: "track.mcap",
        is_on_globe: false,
        has_clock: true,
        make: mcap::make,
    },
    Format {
        name: "alog",
        about: "All columns and events as a log of MOOS",
        file: "track.alog",
        is_on_globe: false,
        has_clock: true,
        make: alog::make,
    },
];

#[cfg(test)]
mod tests;
