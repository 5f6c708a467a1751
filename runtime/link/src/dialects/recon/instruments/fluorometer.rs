//! `#F`: the fluorometer's gain, and its value at that gain.

use super::Instrument;
use crate::dialects::recon::fields::fixed;
use albacore_vehicle::measurements::CHEMICAL;

/// Full scale: 5 V, as the 2003 trials' Seapoint gives. The sources give no unit.
const FULL_SCALE_VOLTS: f64 = 5.0;
/// What a simulated vehicle sends.
const GAIN: &str = "1";

pub static INSTRUMENT: Instrument = Instrument {
    letter: 'F',
    measures: &[CHEMICAL],
    read: |fields| {
        fields.number("G")?;
        Some([fields.number("V")? / FULL_SCALE_VOLTS, 0.0, 0.0, 0.0])
    },
    write: |[chemical, ..], _| format!("G{GAIN},V{}", fixed(chemical * FULL_SCALE_VOLTS, 4)),
};
