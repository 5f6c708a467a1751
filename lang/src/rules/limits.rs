//! The mission's limits, and setpoints that lie beyond them whatever happens: the vehicle would never get there.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, Hir, Interval};
use crate::source::Span;
use albacore_arithmetic::LARGEST;
use albacore_program::{Channel, Setpoint};

/// A limit with its number.
pub(super) struct Limit {
    channel: Channel,
    /// Whether it is the least value, else the greatest.
    least: bool,
    /// Of one that is computed, the most that it allows.
    value: f64,
    span: Span,
}

/// The limits of a mission that are known before it runs.
pub(super) fn of(hir: &Hir, mission: usize) -> Vec<Limit> {
    let parts = hir.activities[mission].mission.iter();
    parts
        .flat_map(|m| &m.limits)
        .map(|(channel, least, e)| {
            let value = if *least { e.range.low } else { e.range.high };
            Limit { channel: *channel, least: *least, value, span: e.span }
        })
        .filter(|limit| limit.value.abs() < LARGEST)
        .collect()
}

/// The finding for a setpoint that lies beyond a limit: an error when all its values do, a warning when some of a range do
/// that somebody has written. `range` is what is known of the setpoint here.
pub(super) fn beyond(limits: &[Limit], channel: Channel, setpoint: &Expr, range: Interval) -> Option<Diagnostic> {
    // Speed 0 is always allowed.
    let may_rest = channel == Channel::Speed && range.holds(0.0);
    if may_rest && range.high <= 0.0 {
        return None;
    }
    let of_channel = || limits.iter().filter(|limit| limit.channel == channel);
    let wholly = |l: &&Limit| if l.least { range.high < l.value && !may_rest } else { range.low > l.value };
    let partly = |l: &&Limit| {
        let end = if l.least { range.low } else { range.high };
        end.abs() < LARGEST && if l.least { end < l.value } else { end > l.value }
    };
    let Setpoint { name, unit, .. } = channel.row();
    let told = |finding: Diagnostic, limit: &Limit| {
        let bound = if limit.least { "least" } else { "greatest" };
        finding.label(limit.span, format!("the {bound} {name}"))
    };
    if let Some(limit) = of_channel().find(wholly) {
        let than = if limit.least { "less" } else { "more" };
        let message = format!("this {name} is {than} than the mission's limit of {} {unit}", limit.value);
        let finding = Diagnostic::error(Code::LimitsSetpoint, setpoint.span, message);
        let help = "the vehicle would be held at the limit: choose a setpoint within it, or change the limit";
        return Some(told(finding, limit).help(help));
    }
    let limit = of_channel().find(partly)?;
    let (end, bound) = if limit.least { (range.low, "least") } else { (range.high, "most") };
    let (end, value) = (round(end), limit.value);
    let message = if may_rest && limit.least {
        format!(
            "this {name} may be less than {value} {unit}, the mission's limit, and more than 0 {unit}, which is always allowed"
        )
    } else {
        format!("this {name} may be {end} {unit}, and the mission's limit is {value} {unit} at {bound}")
    };
    let side = if limit.least { "begins at" } else { "ends at" };
    let help = format!("give what it is made of a range that {side} {value} {unit}, or change the limit");
    Some(told(Diagnostic::warning(Code::LimitsRange, setpoint.span, message), limit).help(help))
}

/// As a person writes it.
fn round(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}
