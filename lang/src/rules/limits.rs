//! The mission's limits, and setpoints that lie beyond them whatever happens: the vehicle would never get there.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, Hir};
use crate::source::Span;
use albacore_program::Channel;

/// A limit with its number.
pub(super) struct Limit {
    channel: Channel,
    /// Whether it is the least value, else the greatest.
    least: bool,
    value: f64,
    span: Span,
}

/// The limits of a mission that are known before it runs.
pub(super) fn of(hir: &Hir, mission: usize) -> Vec<Limit> {
    let parts = hir.activities[mission].mission.iter();
    parts
        .flat_map(|m| &m.limits)
        .filter_map(|(channel, least, e)| {
            e.range.constant().map(|value| Limit { channel: *channel, least: *least, value, span: e.span })
        })
        .collect()
}

/// The finding for a setpoint all of whose values lie beyond a limit.
pub(super) fn beyond(limits: &[Limit], channel: Channel, setpoint: &Expr) -> Option<Diagnostic> {
    let range = setpoint.range;
    let limit = limits.iter().find(|limit| {
        let outside = if limit.least { range.high < limit.value } else { range.low > limit.value };
        limit.channel == channel && outside
    })?;
    let (name, unit) = match channel {
        Channel::Depth => ("depth", "m"),
        Channel::Altitude => ("altitude", "m"),
        Channel::Speed => ("speed", "m/s"),
    };
    let (than, bound) = if limit.least { ("less", "least") } else { ("more", "greatest") };
    Some(
        Diagnostic::error(
            Code::LimitsSetpoint,
            setpoint.span,
            format!("this {name} is {than} than the mission's limit of {} {unit}", limit.value),
        )
        .label(limit.span, format!("the {bound} {name}"))
        .help("the vehicle would be held at the limit: choose a setpoint within it, or change the limit"),
    )
}
