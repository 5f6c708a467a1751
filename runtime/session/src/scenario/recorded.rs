//! What a scenario says of a plume that was computed elsewhere.

use super::{Fault, Understood, Wrong};
use crate::files::Files;
use albacore_formats::recording::{RecordedKernel, RecordingError, RecordingHeader};
use albacore_sim::RecordedPlume;
use albacore_trace::Digest;
use albacore_trace::journal::SourceDigest;
use serde::Deserialize;
use std::sync::Arc;

/// A header is no larger than this, bytes.
const HEADER_BYTES_MAX: u64 = 4 * 1024 * 1024;

/// The clauses that a record takes the place of.
pub const BROUGHT: [&str; 8] = ["flow", "turning", "tide", "region", "plume", "source", "leak", "patch"];

/// `recorded_plume(…)`.
#[derive(Deserialize)]
pub struct RecordedPlumeClause {
    file: String,
    kernel: RecordedKernel,
    start: f64,
    start_spread: f64,
    threshold: f64,
}

/// Reads the record, and all that it brings.
pub fn recorded_plume(understood: &mut Understood, clause: RecordedPlumeClause, files: &Files) -> Result<(), Wrong> {
    let RecordedPlumeClause { file: path, kernel, start, start_spread, threshold } = clause;
    let header = files.data(&path, HEADER_BYTES_MAX)?;
    let text = String::from_utf8(header).map_err(|_| not_utf8(&path))?;
    let header = RecordingHeader::read(&text).map_err(|e| wrong(&path, e))?;
    // The binary lies beside its header.
    let folder = path.rfind('/').map_or("", |slash| &path[..=slash]);
    let binary = format!("{folder}{}", header.binary());
    let bytes = files.data(&binary, RecordingHeader::BINARY_BYTES_MAX)?;
    let recording = header.decode(&bytes).map_err(|error| wrong(&path, error))?;
    let recorded = RecordedPlume { recording: Arc::new(recording), kernel, start, start_spread, threshold };
    // The header says as much of the world as the binary.
    let mut digest = Digest::new();
    digest.text(&text);
    digest.text(recorded.recording.sha256());
    understood.files.push(SourceDigest { name: path, digest: digest.value() });
    let scenario = &mut understood.world;
    scenario.environment.region = Some(recorded.recording.area().clone());
    scenario.environment.flow.mean = recorded.recording.mean_flow();
    scenario.environment.sources = vec![recorded.source()];
    scenario.environment.recording = Some(recorded);
    Ok(())
}

fn wrong(path: &str, error: RecordingError) -> Wrong {
    let fault = |fault| Fault { message: format!("`{path}`: {fault}"), help: Some(error.help.into()), param: None };
    Wrong(error.faults.into_iter().map(fault).collect())
}

fn not_utf8(path: &str) -> Wrong {
    let help = "name the header of a record, which is JSON, not its binary".to_string();
    Wrong(vec![Fault { message: format!("`{path}` is no text in UTF-8"), help: Some(help), param: None }])
}
