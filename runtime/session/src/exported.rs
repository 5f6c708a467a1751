//! A run that is over, as other programs are given it.

use crate::past::fold;
use crate::plan::Plan;
use crate::recorders::exported::ForExport;
use albacore_export::Exported;
use albacore_trace::journal::{Ending, Reader, Unreadable};

/// All of a run, and what of it could not be had.
pub struct ExportedRun {
    /// What can be exported.
    pub run: Exported,
    /// How its journal ends.
    pub ending: Ending,
    /// Samples for which there is no column.
    pub samples_left_out: u64,
    /// Reports beside those that are listed.
    pub more_reports: u64,
}

/// Reads the journal of a run of a plan, as far as it is whole. `epoch_ms` is when its first tick was, in milliseconds since the beginning
/// of 1970, if somebody knows.
pub fn exported(plan: &Plan, journal: &[u8], epoch_ms: Option<i64>) -> Result<ExportedRun, Unreadable> {
    let header = Reader::new(journal)?.header().clone();
    let mut recorder = ForExport::new(plan, &header);
    let ending = fold(plan, journal, &mut recorder, |_| {})?;
    let (samples_left_out, more_reports) = (recorder.left_out(), recorder.more_reports());
    Ok(ExportedRun { run: recorder.exported(epoch_ms), ending, samples_left_out, more_reports })
}
