//! The fixed words of a trace.

use albacore_program::Cause;
use albacore_vehicle::Control;

/// Nesting is shown by so many blanks a level.
pub const INDENT: usize = 2;

/// A name as deep as it is nested.
pub fn indented(depth: usize, what: &str) -> String {
    format!("{:width$}{what}", "", width = depth * INDENT)
}

/// Why an activity was left.
pub fn cause_name(cause: Cause) -> &'static str {
    match cause {
        Cause::Done => "done",
        Cause::Rule => "by rule",
        Cause::Until => "for or until",
        Cause::TimedOut => "timed out",
        Cause::Preempted => "pre-empted",
        Cause::Aborted => "aborted",
        Cause::Refused => "refused",
        Cause::NoAnswer => "no answer",
        Cause::TakenBack => "taken back",
    }
}

/// Who drives.
pub fn control_name(control: Control) -> &'static str {
    match control {
        Control::Disconnected => "disconnected",
        Control::Monitoring => "monitoring",
        Control::Offered => "offered",
        Control::Requesting => "requesting",
        Control::InControl => "in control",
        Control::Released => "released",
        Control::Refused => "refused",
        Control::Suspended => "suspended",
        Control::TimedOut => "no answer",
    }
}
