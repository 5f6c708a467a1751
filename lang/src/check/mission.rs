//! What belongs to a mission alone: limits, what it requires, its time, area and recovery.

use super::timed::setpoint_type;
use super::{Checker, Temporal};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expr, ExprKind, Interval, Mission, Require};
use crate::source::Spanned;
use crate::syntax::tree::{self, ActivityKind, ClauseKind};
use crate::types::Type;
use albacore_program::{Axis, Channel, LIMIT_FRESH_S, LIMIT_PATIENCE_S, TURN_RATE_MIN};
use albacore_wording::listed;

/// The limits that are no channel's.
const TURN_RATE: &str = "turn_rate";
const LATENCY: &str = "latency";

impl Checker<'_> {
    /// `altitude >= 1.5 m`.
    pub(super) fn limit(&mut self, limit: &tree::Expr, mission: &mut Mission) {
        let help = "for example `altitude >= 1.5 m`, `depth <= 30 m`, `speed <= 2.6 m/s`, `turn_rate <= 6 deg/s` or \
                    `latency <= 2 s`";
        let tree::ExprKind::Binary(op, left, right) = &limit.kind else {
            self.report(Diagnostic::error(Code::MissionsLimit, limit.span, "a limit is a comparison").help(help));
            return;
        };
        if matches!(&left.kind, tree::ExprKind::Name(name) if name == TURN_RATE) {
            return self.turn_rate(limit, op, right, mission);
        }
        if matches!(&left.kind, tree::ExprKind::Name(name) if name == LATENCY) {
            return self.latency(limit, op, right, mission);
        }
        let named = match &left.kind {
            tree::ExprKind::Name(name) => Channel::named(name),
            _ => None,
        };
        let Some(channel) = named else {
            let mut names: Vec<&str> = Channel::ALL.iter().map(|channel| channel.row().name).collect();
            names.sort_unstable();
            let message = format!("limits hold `{}`, `{TURN_RATE}` and `{LATENCY}`", names.join("`, `"));
            self.report(Diagnostic::error(Code::MissionsLimit, left.span, message).help(help));
            return;
        };
        let least = match op.node {
            tree::Binary::Ge => true,
            tree::Binary::Le => false,
            _ => {
                self.report(
                    Diagnostic::error(
                        Code::MissionsLimit,
                        op.span,
                        "a limit is `>=` the least or `<=` the greatest value",
                    )
                    .help(help),
                );
                return;
            }
        };
        let value = self.instant(Temporal::No, |c| c.expr_as(right, &setpoint_type(channel), "the limit"));
        self.sensible_setpoint(channel, &value, "the limit");
        let row = channel.row();
        if !row.may_be_negative && value.range.high >= 0.0 && value.range.low < 0.0 && value.ty != Type::Unknown {
            let finding = Diagnostic::error(
                Code::MissionsLimit,
                value.span,
                "this limit may be negative, and would hold nothing",
            );
            let unit = row.unit;
            self.report(
                finding.help(format!("give what it is computed from a range of its own: `in 1 {unit}..3 {unit}`")),
            );
        }
        if let Some((_, _, other)) = mission.limits.iter().find(|(c, l, _)| *c == channel && *l != least) {
            let (low, high) = if least { (&value, other) } else { (other, &value) };
            if low.range.high > high.range.low && low.ty != Type::Unknown && high.ty != Type::Unknown {
                let is_so = low.range.low > high.range.high;
                let verb = if is_so { "is" } else { "may be" };
                let message = format!("the least `{}` {verb} more than the greatest", channel.row().name);
                let finding =
                    Diagnostic::error(Code::MissionsLimit, value.span, message).label(other.span, "the other limit");
                let help = if is_so {
                    "write a least value that is below the greatest"
                } else {
                    "give what they are computed from ranges of their own that do not overlap: `in 0.5 m/s..1 m/s`"
                };
                self.report(finding.help(help));
            }
        }
        if let Some((_, _, first)) = mission.limits.iter().find(|(c, l, _)| *c == channel && *l == least) {
            let finding = Diagnostic::error(Code::MissionsTwice, limit.span, "this limit is set twice")
                .label(first.span, "the first")
                .help("keep one of them");
            self.report(finding);
        }
        mission.limits.push((channel, least, value));
    }

    /// `turn_rate <= 6 deg/s`.
    fn turn_rate(&mut self, limit: &tree::Expr, op: &Spanned<tree::Binary>, right: &tree::Expr, mission: &mut Mission) {
        if op.node != tree::Binary::Le {
            let message = "a vehicle may always turn more slowly: its rate of turn has a greatest value alone";
            self.report(Diagnostic::error(Code::MissionsLimit, op.span, message).help("write `turn_rate <= 6 deg/s`"));
            return;
        }
        let rate = Type::Quantity(Dimension::TURN_RATE);
        let value = self.instant(Temporal::No, |c| c.expr_as(right, &rate, "the limit"));
        if value.range.high <= 0.0 {
            let finding = Diagnostic::error(Code::MissionsLimit, value.span, "a vehicle with this limit never turns");
            self.report(finding.help("give what it can turn in a second: `turn_rate <= 6 deg/s`"));
        } else if value.range.low < TURN_RATE_MIN && value.ty != Type::Unknown {
            let finding = Diagnostic::error(Code::MissionsLimit, value.span, "this limit may be less than 0.1 deg/s");
            let help = "a vehicle needs that much to go anywhere: write a larger one, or give what it is computed from a range of its own, \
                        `in 1 deg/s..10 deg/s`";
            self.report(finding.help(help));
        }
        if let Some(first) = &mission.turn_rate {
            let finding = Diagnostic::error(Code::MissionsTwice, limit.span, "this limit is set twice")
                .label(first.span, "the first")
                .help("keep one of them");
            self.report(finding);
        }
        mission.turn_rate = Some(value);
    }

    /// `latency <= 2 s`.
    fn latency(&mut self, limit: &tree::Expr, op: &Spanned<tree::Binary>, right: &tree::Expr, mission: &mut Mission) {
        if op.node != tree::Binary::Le {
            let message = "a link may always be quicker: its round trip has a greatest value alone";
            self.report(Diagnostic::error(Code::MissionsLimit, op.span, message).help("write `latency <= 2 s`"));
            return;
        }
        let value = self.duration(right, "the limit");
        if let Some(first) = &mission.latency {
            let finding = Diagnostic::error(Code::MissionsTwice, limit.span, "this limit is set twice")
                .label(first.span, "the first")
                .help("keep one of them");
            self.report(finding);
        }
        mission.latency = Some(value);
    }

    pub(super) fn require(&mut self, require: &tree::Require, mission: &mut Mission) {
        let fresh = self.duration(&require.fresh, "the time after `fresh`");
        let hold_for = require.hold_for.as_ref().map(|e| self.duration(e, "the time after `hold for`"));
        let at_first = require.at_first.as_ref().filter(|value| self.is_of_one_type(require, value));
        for name in &require.inputs {
            let Some(input) = self.input_named(name, Code::MissionsRequires) else { continue };
            if mission.requires.iter().any(|r| r.input == input) {
                let message = format!("`{}` is required twice", name.node);
                let finding = Diagnostic::error(Code::MissionsTwice, name.span, message);
                self.report(finding.help("keep one of them"));
            }
            let ty = self.hir.inputs[input].ty.clone();
            let at_first = at_first.map(|e| {
                self.instant(Temporal::No, |c| c.expr_as(e, &ty, &format!("the value at first of `{}`", name.node)))
            });
            let (fresh, hold_for) = (fresh.clone(), hold_for.clone());
            mission.requires.push(Require { input, span: name.span, fresh, at_first, hold_for });
        }
    }

    /// Whether a value at first can be that of all inputs of an entry.
    fn is_of_one_type(&mut self, require: &tree::Require, value: &tree::Expr) -> bool {
        let known = |name: &&Spanned<String>| self.hir.inputs.iter().find(|input| input.name == name.node);
        let mut types = require.inputs.iter().filter_map(|name| known(&name)).map(|input| &input.ty);
        let first = types.next();
        if types.all(|ty| Some(ty) == first) {
            return true;
        }
        let names: Vec<&str> = require.inputs.iter().map(|name| name.node.as_str()).collect();
        let message = format!("one value at first for {}, which are of different types", listed(&names));
        let help = "write an entry for each input that has a value at first, such as `flow fresh 30 s, at first 0 m/s toward north, else abort`";
        self.report(Diagnostic::error(Code::TypesMismatch, value.span, message).help(help));
        false
    }

    /// Limits of depth and altitude are held by what is known of the depth: a mission that has one requires that input, whether it
    /// says so or not.
    pub(super) fn require_for_limits(&self, mission: &mut Mission) {
        let vertical = mission.limits.iter().find(|(channel, ..)| channel.row().axis == Axis::Vertical);
        let Some((_, _, Expr { span, .. })) = vertical else { return };
        let Some(input) = self.hir.inputs.iter().position(|input| input.name == "depth") else { return };
        if mission.requires.iter().any(|require| require.input == input) {
            return;
        }
        let span = *span;
        let seconds = |value: f64| Expr {
            kind: ExprKind::Number(value),
            ty: Type::Quantity(Dimension::TIME),
            span,
            range: Interval::exactly(value),
        };
        let (fresh, hold_for) = (seconds(LIMIT_FRESH_S), Some(seconds(LIMIT_PATIENCE_S)));
        mission.requires.push(Require { input, span, fresh, at_first: None, hold_for });
    }

    pub(super) fn mission_header(&mut self, a: &tree::Activity, mission: &mut Mission) {
        let ActivityKind::Mission { scenario, within } = &a.kind else { return };
        mission.within = within.as_ref().map(|e| self.time_limit(e, "the mission's time limit"));
        if let Some(path) = scenario {
            mission.scenario = Some(path.text());
            self.scenario_named(path);
        }
        let missing = [
            (mission.within.is_none(), Code::MissionsWithin, "a time limit", "write `within 2 h` after its name"),
            (mission.areas.is_empty(), Code::MissionsArea, "an operating area", "write `area op = rectangle(…)`"),
            (
                mission.recovery.is_none(),
                Code::MissionsRecovery,
                "a recovery",
                "write `recovery within 10 min { goto … }`: what the vehicle does after an abort",
            ),
            (
                !a.body.clauses.iter().any(|clause| limits_something(&clause.kind)),
                Code::MissionsLimits,
                "limits",
                "write `limits { altitude >= 2 m, depth <= 30 m, speed <= 2 m/s }`, as the water and the vehicle allow",
            ),
        ];
        for (is_missing, code, what, help) in missing {
            if is_missing {
                let message = format!(
                    "the mission `{}` has no {}",
                    a.name.node,
                    what.trim_start_matches("a ").trim_start_matches("an ")
                );
                self.report(Diagnostic::warning(code, a.name.span, message).help(help));
            }
        }
    }
}

fn limits_something(clause: &ClauseKind) -> bool {
    matches!(clause, ClauseKind::Limits(limits) if !limits.is_empty())
}
