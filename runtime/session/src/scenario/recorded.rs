//! What a scenario says of a plume that was computed elsewhere.

use super::clause::Clause;
use super::{Fault, Understood, Wrong};
use crate::files::{FileError, Files};
use albacore_lang::ScenarioProgram;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_sim::{RecordedKernel, RecordedPlume, RecordingError, RecordingHeader};
use albacore_trace::Digest;
use albacore_trace::journal::SourceDigest;
use std::sync::Arc;

/// A header is no larger than this, bytes.
const HEADER_BYTES_MAX: u64 = 4 * 1024 * 1024;
/// The clauses that a record takes the place of.
const BROUGHT: [&str; 8] = ["flow", "turning", "tide", "region", "plume", "source", "leak", "patch"];

/// `recorded_plume(…)`: the record, and all that it brings.
pub fn recorded_plume(understood: &mut Understood, c: &Clause, files: &Files) -> Result<(), Wrong> {
    let path = c.text("file")?;
    let faulty = |error: RecordingError| {
        let told = |fault| Fault { message: format!("`{path}`: {fault}"), help: None };
        Wrong(error.faults.into_iter().map(told).collect())
    };
    let header = files.data(&path, HEADER_BYTES_MAX).map_err(unread)?;
    let header = RecordingHeader::read(&String::from_utf8_lossy(&header)).map_err(faulty)?;
    // The binary lies beside its header.
    let folder = path.rfind('/').map_or("", |slash| &path[..=slash]);
    let binary = files.data(&format!("{folder}{}", header.binary()), header.bytes() as u64).map_err(unread)?;
    let recording = header.decode(&binary).map_err(faulty)?;
    let kernel = match c.clause("kernel").map(|kernel| kernel.clause.name.as_str()) {
        Some("flat") => RecordedKernel::Flat,
        _ => RecordedKernel::Pompy,
    };
    let recorded = RecordedPlume {
        recording: Arc::new(recording),
        kernel,
        start: c.number("start")?,
        start_spread: c.number("start_spread")?,
        threshold: c.number("threshold")?,
    };
    let world = &mut understood.world;
    world.region = Some(recorded.recording.area().clone());
    world.flow.mean = recorded.recording.mean_flow();
    world.sources = vec![recorded.source()];
    let mut digest = Digest::new();
    digest.text(recorded.recording.sha256());
    understood.files.push(SourceDigest { name: path, digest: digest.value() });
    world.recording = Some(recorded);
    Ok(())
}

/// What stands beside a record and is brought by it.
pub fn brought(program: &ScenarioProgram) -> Option<Diagnostic> {
    let record = program.clauses.iter().find(|clause| clause.name == "recorded_plume")?;
    let own = program.clauses.iter().find(|clause| BROUGHT.contains(&clause.name.as_str()))?;
    let message = format!("the record brings its own `{}`", own.name);
    let finding = Diagnostic::error(Code::ScenariosClause, own.span, message).label(record.span, "the record");
    Some(finding.help(format!("leave out `{}`, or the record", own.name)))
}

fn unread(error: FileError) -> Wrong {
    Wrong(vec![Fault { message: error.message, help: error.help }])
}
