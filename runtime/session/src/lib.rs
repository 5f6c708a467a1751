//! Load, check and step a mission: the few types that the command line, the tests and the prompt all use.

mod bounded;
pub mod campaign;
mod check;
mod compatibility;
mod data;
mod faults;
mod files;
mod kept;
mod link;
mod link_faults;
mod past;
mod picture;
mod plan;
pub mod prompt;
mod recorders;
mod replay;
mod report;
mod reported;
mod run;
mod run_vehicle;
mod scenario;
mod served_vehicle;
mod shown;
mod summary;
mod tests;
pub mod threads;
mod wanted;

pub use albacore_diagram as diagram;
pub use albacore_lang::code::Code;
pub use albacore_lang::cost::{Cost, grouped};
pub use albacore_lang::diagnostic::{Diagnostic, Severity, settle};
pub use albacore_lang::doc;
pub use albacore_lang::fmt::format;
pub use albacore_lang::source::{FileId, SOURCE_BYTES_MAX, Source, Sources, Span};
pub use albacore_lang::{Script, is_setpoint};
pub use albacore_link::{Dialect, Faulty, HostClock, LinkError, LinkFault, Rows, Transport, Url, WrittenUrl, serve};
pub use albacore_machine::Outcome;
pub use albacore_program::seen;
pub use albacore_trace::journal;
pub use albacore_trace::journal::SourceDigest;
pub use albacore_trace::{Difference, Digest, first_difference, first_foreign_line, same_behavior};
pub use albacore_wording::nearest;
pub use bounded::{Unread, read_all, read_file};
pub use check::{findings, findings_in};
pub use faults::{Faults, load_faults};
pub use files::{
    FileError, Files, is_known_everywhere, load, load_for, load_library, load_or_module, load_text, read, read_input,
    standard_modules,
};
pub use kept::Changes;
pub use link::{Called, call};
pub use link_faults::{link_faults, load_link_faults};
pub use past::PastRun;
pub use plan::{Plan, PlanError};
pub use recorders::journal::{Sink, is_journal, is_journal_as_left};
pub use recorders::recorded::RECORDED_BYTES_MAX;
pub use recorders::{PICTURE, RECORDED, RUN_FILES, RunFile, TRACE};
pub use replay::{Repeated, Replay, ReplayedStep, repeat};
pub use report::{RunReport, data as report_data, report};
pub use run::{LiveOptions, LiveRun, LiveUpdate, Run, Running, WAITING_BYTES};
pub use served_vehicle::{FarEnd, ServedVehicle};
pub use shown::{Shown, ShownClause, ValueSource};
pub use summary::{Report, Summary};
pub use tests::{Failure, TestResult, TestRun, run_test};
pub use wanted::Wanted;
