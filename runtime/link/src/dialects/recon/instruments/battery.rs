//! `#B`: capacity, what is left of it, and the same in per cent. The sources give no unit of the first two; ours sends watt hours.

use super::Instrument;
use crate::dialects::recon::fields::{fixed, ranges};
use albacore_vehicle::measurements::BATTERY;

/// The battery of a REMUS 100, Wh.
const CAPACITY_WH: f64 = 1000.0;

pub static INSTRUMENT: Instrument = Instrument {
    letter: 'B',
    measures: &[BATTERY],
    read: |fields| {
        fields.number("C").and(fields.number("A"))?;
        Some([fields.within("P", ranges::CHARGES)? / 100.0, 0.0, 0.0, 0.0])
    },
    write: |[charge, ..], _| {
        let [capacity, available, percent] = [CAPACITY_WH, CAPACITY_WH * charge, 100.0 * charge].map(|x| fixed(x, 1));
        format!("C{capacity},A{available},P{percent}")
    },
};
