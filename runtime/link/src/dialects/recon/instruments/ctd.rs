//! `#c`: temperature (degrees Celsius), conductivity (the sources give no unit; ours sends S/m), practical salinity, depth (m) and the
//! speed of sound (m/s). Only temperature and salinity are read.

use super::{Instrument, seawater};
use crate::dialects::recon::fields::fixed;
use albacore_vehicle::measurements::{SALINITY, TEMPERATURE};

pub static INSTRUMENT: Instrument = Instrument {
    letter: 'c',
    measures: &[TEMPERATURE, SALINITY],
    read: |fields| {
        fields.number("C").and(fields.sensor_number("D")).and(fields.number("V"))?;
        Some([fields.number("T")?, fields.number("S")?, 0.0, 0.0])
    },
    write: |[temperature, salinity, ..], senses| {
        let conductivity = seawater::conductivity(temperature, salinity, senses.depth);
        let sound_speed = seawater::sound_speed(temperature, salinity, senses.depth);
        format!(
            "T{},C{},S{},D{},V{}",
            fixed(temperature, 3),
            fixed(conductivity, 3),
            fixed(salinity, 3),
            fixed(senses.depth, 2),
            fixed(sound_speed, 2)
        )
    },
};
