//! Statements that take time: guidance, calls, and the modifiers that bound them; `with`.

use super::args::NUMBER;
use super::expr::article;
use super::names::Found;
use super::{Checker, Def, Driving, ParamInfo, Setting, Temporal};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{self, Action, ExprKind, Interval, Stmt, StmtKind, Timed, VarId, VarKind, With};
use crate::source::Span;
use crate::syntax::tree::{self, WithItem};
use crate::types::Type;
use albacore_program::{Channel, Ends, Guide, Param, ParamKind, SetpointKind};
use albacore_wording::nearest;

/// The enum of an override's ends, in the library's inputs.
const OVERRIDE_END: &str = "OverrideEnd";

impl<'t> Checker<'t> {
    /// The behavior or strategy that an expression calls.
    pub(super) fn called_activity(&self, e: &tree::Expr) -> Option<usize> {
        let tree::ExprKind::Call(callee, _) = &e.kind else { return None };
        if let tree::ExprKind::Name(name) = &callee.kind
            && let Some(given) = self.given_behavior(name)
        {
            return Some(given.id());
        }
        match self.find(callee) {
            Found::Def(Def::Activity(id)) => Some(id),
            _ => None,
        }
    }

    /// A statement that may take time; `bind` is the name of `let`.
    pub(super) fn timed_stmt(
        &mut self,
        timed: &tree::Timed,
        bind: Option<(&tree::Name, Option<&tree::Ty>)>,
        span: Span,
    ) -> Option<Stmt> {
        if let Some(repeated) = timed.repeated {
            let finding = Diagnostic::error(Code::SyntaxModifier, repeated, "this modifier is written twice");
            self.report(finding.help("keep one of them"));
        }
        if let tree::Action::Expr(e) = &timed.action
            && self.called_activity(e).is_none()
        {
            return if timed.is_modified() {
                self.modified_instant(e, timed.span, span)
            } else {
                self.expr_stmt(e, span)
            };
        }
        if self.scope.setting != Setting::Body && !self.is_done_in_value(timed.span) {
            let finding = Diagnostic::error(
                Code::TimeInstant,
                timed.span,
                "this takes time, and here everything is instantaneous",
            )
            .help("move it into the body of a behavior; a reaction can set a `memory` for a rule to see");
            self.report(finding);
        }
        self.has_one_end(timed);
        let done = match &timed.action {
            tree::Action::Ask(ask) => self.ask(ask, timed).map(|action| (action, true, None)),
            action => self.action(action, timed.span),
        };
        let Some((action, ends, value)) = done else {
            // What is wrong with it has been told: its name is no second mistake.
            if let Some((name, _)) = bind {
                self.declare(name, VarKind::Let, Type::Unknown);
            }
            return None;
        };
        let duration = timed.duration.as_ref().map(|e| self.duration(e, "the time after `for`"));
        let within = timed.within.as_ref().map(|e| self.duration(e, "the time after `within`"));
        if let (tree::Action::Wait | tree::Action::Watch, Some(first)) = (&timed.action, timed.at.first()) {
            let message = "this goes on as it does: nothing is held at what follows `at`";
            let finding = Diagnostic::error(Code::TimeModifier, first.channel.span.to(first.value.span), message);
            self.report(
                finding.help("keep the place with `hold at …`, or the heading with `steer heading: heading at …`"),
            );
        }
        let at = self.setpoints(&timed.at);
        self.time_passes();
        // It is first tried on the tick after the statement began.
        let until = timed.until.as_ref().map(|e| self.with_temporal(Temporal::Yes, |c| c.condition(e)));
        let is_bounded = duration.is_some() || until.is_some() || within.is_some();
        let result = bind.map(|(name, ty)| {
            let found = match (&action, &value) {
                (Action::Call(..), Some(ty)) if is_bounded => ty.clone().optional(),
                (Action::Call(..), Some(ty)) => ty.clone(),
                (Action::Override(_), _) => self.override_end(),
                (Action::Ask(..), _) => self.answer_type(),
                _ => Type::Bool,
            };
            self.bound_outcome(name, ty, found)
        });
        if within.is_some() && result.is_none() && !matches!(action, Action::Override(_) | Action::Ask(..)) {
            self.report(
                Diagnostic::warning(Code::TimeUnread, timed.span, "nobody learns whether this was cut off")
                    .help("write `let ok = …`, or `until after T` when either end will do"),
            );
        }
        if !ends && bind.is_some() && !is_bounded {
            let message = "this never ends by itself: its outcome is never known";
            let finding = Diagnostic::error(Code::FlowEndless, timed.span, message);
            self.report(finding.help("bound it with `for T`, `until X` or `within T`"));
        }
        let timed = Timed { action, duration, until, within, at, value, result };
        Some(Stmt { kind: StmtKind::Timed(Box::new(timed)), span })
    }

    fn has_one_end(&mut self, timed: &tree::Timed) {
        if let (Some(duration), Some(until)) = (&timed.duration, &timed.until) {
            self.report(
                Diagnostic::error(Code::TimeModifier, until.span, "`for` and `until` cannot both end this")
                    .label(duration.span, "the other end")
                    .help("write `until X` with `within T` to cut it off, or `until X or after T`"),
            );
        }
    }

    /// An expression with a modifier, where only what takes time can have one.
    fn modified_instant(&mut self, e: &tree::Expr, timed: Span, span: Span) -> Option<Stmt> {
        if self.misspelt_statement(e) {
            return None;
        }
        // What is called may be misspelt: then nobody knows whether it takes time.
        let known = self.findings.len();
        let stmt = self.expr_stmt(e, span);
        if self.findings.len() == known {
            let message = "this takes no time: nothing to end or to cut off";
            let finding = Diagnostic::error(Code::TimeModifier, timed, message);
            self.report(finding.help("`for`, `until`, `within` and `at` belong to statements that take time"));
        }
        stmt
    }

    /// The name that a statement's outcome is given, with the type that is written for it.
    fn bound_outcome(&mut self, name: &tree::Name, ty: Option<&tree::Ty>, found: Type) -> VarId {
        if let Some(ty) = ty {
            let written = self.written_type(self.scope.module, ty);
            if written != found {
                let (has, wants) = (self.type_name(&found), self.type_name(&written));
                let message = format!("this gives {}, not {}", article(&has), article(&wants));
                let finding = Diagnostic::error(Code::TypesMismatch, ty.span, message);
                self.report(finding.help(format!("write `{has}`, or leave the type out")));
            }
        }
        self.declare(name, VarKind::Let, found)
    }

    /// `wiat for 10 s` reads as a value named `wiat`: when a word of the language is near, that was meant.
    fn misspelt_statement(&mut self, e: &tree::Expr) -> bool {
        let tree::ExprKind::Name(name) = &e.kind else { return false };
        if self.local(name).is_some() || self.lookup(self.scope.module, name).is_some() {
            return false;
        }
        let Some(near) = nearest(name, ["wait", "hold", "watch"]) else { return false };
        self.report(
            Diagnostic::error(Code::SyntaxClause, e.span, format!("`{name}` begins no statement"))
                .help(format!("did you mean `{near}`?")),
        );
        true
    }

    /// What is done, whether it ends by itself, and the result it has.
    fn action(&mut self, action: &tree::Action, span: Span) -> Option<(Action, bool, Option<Type>)> {
        Some(match action {
            tree::Action::Guide { verb, args } => return self.guidance(verb, args, span),
            tree::Action::Keep(setpoint) => {
                let (channel, value) = self.on_later_ticks(|c| c.setpoint(setpoint))?;
                (Action::Keep(channel, value), false, None)
            }
            tree::Action::Hold => (Action::Guide(Guide::Hold, Vec::new()), false, None),
            tree::Action::Wait => (Action::Guide(Guide::Wait, Vec::new()), false, None),
            tree::Action::Watch => {
                self.not_driving(span, "watch");
                (Action::Watch, false, None)
            }
            tree::Action::Override(o) => {
                self.not_driving(span, "override");
                let answer = o.answer.as_ref().map(|e| self.duration(e, "the time after `within`"));
                self.time_passes();
                let outer = self.scope.driving.replace(Driving::Override(span));
                let block = self.in_block(|c| c.block(&o.block));
                self.scope.driving = outer;
                (Action::Override(hir::Override { offered: o.offered, answer, block }), true, None)
            }
            // Its modifiers are its own.
            tree::Action::Ask(_) => return None,
            tree::Action::Expr(e) => {
                let id = self.called_activity(e)?;
                let tree::ExprKind::Call(callee, args) = &e.kind else { return None };
                let given = match &callee.kind {
                    tree::ExprKind::Name(name) => self.use_given(name, callee.span),
                    _ => None,
                };
                let signature = self.activity_signature(id).clone();
                if self.overlay_ids.contains(&id) || self.mission_ids.contains(&id) {
                    let (what, help) = if self.overlay_ids.contains(&id) {
                        ("an overlay", format!("put it on: `with {}(…)`", signature.name))
                    } else {
                        ("a mission", "only the person starts missions; make what both need a behavior".to_string())
                    };
                    self.report(
                        Diagnostic::error(
                            Code::TimeCall,
                            e.span,
                            format!("`{}` is {what}, no statement", signature.name),
                        )
                        .label(signature.span, "declared here")
                        .help(help),
                    );
                    return None;
                }
                let (call, result) = self.call_of_activity(id, args, e.span)?;
                // Of a behavior that is given only what its parameter says is known, whatever it is.
                (call, true, given.map_or(result, |given| given.result().cloned()))
            }
        })
    }

    /// What an `override` ended with.
    fn override_end(&self) -> Type {
        let known = self.types.enums.iter().position(|e| e.name == OVERRIDE_END);
        known.map_or(Type::Unknown, Type::Enum)
    }

    /// Who drives already can neither watch nor take over.
    fn not_driving(&mut self, span: Span, what: &str) {
        let Some(driving) = self.scope.driving else { return };
        let finding =
            Diagnostic::error(Code::TimeControl, span, format!("the vehicle is ours here: nothing to {what}"));
        self.report(match driving {
            Driving::Override(outer) => finding
                .label(outer, "since this `override`")
                .help(format!("end that block first: write `{what}` after it")),
            Driving::Recovery => finding.help("a recovery runs in control, and the vehicle is released after it"),
        });
    }

    fn guidance(&mut self, verb: &tree::Name, args: &[tree::Arg], span: Span) -> Option<(Action, bool, Option<Type>)> {
        let label = args.first().and_then(|arg| arg.label.as_ref()).map(|label| label.node.as_str());
        let guide = Guide::named(&verb.node, label)?;
        let params: Vec<ParamInfo> =
            guide.law().params.iter().map(|param| param_info(param, verb.span, span)).collect();
        let read = |c: &mut Self| c.arguments(&verb.node, &params, args, span, None);
        let values = if guide.law().reads_arguments_anew() { self.on_later_ticks(read) } else { read(self) }?;
        self.ends_or_not(guide, &values);
        let ends = guidance_ends(guide, &values);
        Some((Action::Guide(guide, values), ends, None))
    }

    /// A number of turns that may be 0 would make guidance that comes to an end, or none, as it happens.
    fn ends_or_not(&mut self, guide: Guide, args: &[hir::Expr]) {
        let Some(turns) = turns(guide, args) else { return };
        // What may be negative has been told.
        if turns.ty == Type::Unknown || turns.range.constant().is_some() || turns.range.low != 0.0 {
            return;
        }
        let message = "this may be 0, and then it goes on without end";
        self.report(Diagnostic::error(Code::RangesUnproved, turns.span, message).help(
            "give what it is computed from a range above 0, such as `turns: Ratio = 1 in 0.5..10`, or hold it with `max(x, 0.5)`",
        ));
    }

    pub(super) fn setpoints(&mut self, written: &[tree::Setpoint]) -> Vec<(Channel, hir::Expr)> {
        let mut setpoints: Vec<(Channel, hir::Expr)> = Vec::new();
        let mut spans: Vec<Span> = Vec::new();
        for setpoint in written {
            let Some((channel, value)) = self.setpoint(setpoint) else { continue };
            if let Some(i) = setpoints.iter().position(|(c, _)| c.row().axis == channel.row().axis) {
                let earlier = spans[i];
                self.report(owned_twice(setpoint.span, earlier, channel));
            }
            setpoints.push((channel, value));
            spans.push(setpoint.span);
        }
        setpoints
    }

    fn setpoint(&mut self, setpoint: &tree::Setpoint) -> Option<(Channel, hir::Expr)> {
        let channel = Channel::named(&setpoint.channel.node)?;
        let ty = setpoint_type(channel);
        // `keep depth + 1 m` reads as "keep depth plus one", and would mean "at a depth of +1 m".
        let mut written = &setpoint.value;
        let row = channel.row();
        if let tree::ExprKind::Unary(op, unsigned) = &written.kind
            && (op.node == tree::Unary::Pos || op.node == tree::Unary::Neg && !row.may_be_negative)
        {
            let more = op.node == tree::Unary::Pos;
            let (name, unit, meaning) = (row.name, row.unit, row.meaning);
            let (sign, change) = if more { ('+', row.more) } else { ('-', row.less) };
            let help =
                format!("`{name} 1 {unit}` is {meaning}, `{name} {name} {sign} 1 {unit}` 1 {unit} {change} than now");
            self.report(Diagnostic::error(Code::SyntaxSetpoint, op.span, "no setpoint begins with a sign").help(help));
            written = unsigned;
        }
        let what = format!("the {} setpoint", setpoint.channel.node);
        let value = self.expr_as(written, &ty, &what);
        self.sensible_setpoint(channel, &value, &what);
        (value.ty != Type::Unknown).then_some((channel, value))
    }

    pub(super) fn with_items(&mut self, items: &[WithItem]) -> Vec<With> {
        let mut with = Vec::new();
        let mut owned: Vec<(Channel, Span)> = Vec::new();
        for item in items {
            match item {
                WithItem::Setpoint(setpoint) => {
                    let Some((channel, value)) = self.setpoint(setpoint) else { continue };
                    if let Some((_, earlier)) = owned.iter().find(|(c, _)| c.row().axis == channel.row().axis) {
                        self.report(owned_twice(setpoint.span, *earlier, channel));
                    }
                    owned.push((channel, setpoint.span));
                    with.push(With::Setpoint(channel, value));
                }
                WithItem::Overlay(e) => {
                    let Some(id) = self.called_activity(e) else {
                        if let Found::Def(Def::Activity(id)) = self.find(e)
                            && self.overlay_ids.contains(&id)
                        {
                            let name = &self.activity_signature(id).name;
                            let message = format!("the arguments of `{name}` are missing");
                            let help = format!("write them behind it, `{name}(…)`, or `{name}()` if there are none");
                            self.report(Diagnostic::error(Code::TypesOverlay, e.span, message).help(help));
                            continue;
                        }
                        // A wrong name is reported where it is looked up.
                        let value = self.expr(e, None);
                        if value.ty != Type::Unknown {
                            self.report(
                                Diagnostic::error(Code::TypesOverlay, e.span, "`with` puts on overlays and setpoints")
                                    .help("for example `with safety.cage(op), altitude 2 m, speed 2 m/s`"),
                            );
                        }
                        continue;
                    };
                    let tree::ExprKind::Call(_, args) = &e.kind else { continue };
                    let signature = self.activity_signature(id).clone();
                    if !self.overlay_ids.contains(&id) {
                        self.report(
                            Diagnostic::error(
                                Code::TypesOverlay,
                                e.span,
                                format!("`{}` is no overlay", signature.name),
                            )
                            .label(signature.span, "declared here")
                            .help("call it as a statement"),
                        );
                        continue;
                    }
                    if let Some(values) =
                        self.arguments(&signature.name, &signature.params, args, e.span, Some(signature.span))
                    {
                        with.push(With::Overlay(id, values, e.span));
                    }
                }
            }
        }
        with
    }
}

/// A parameter of a guidance law, written at `place`; a value that stands in for it belongs to the statement.
fn param_info(param: &Param, place: Span, statement: Span) -> ParamInfo {
    let ty = match param.kind {
        ParamKind::Point => Type::Point,
        ParamKind::Line => Type::Line,
        ParamKind::Heading => Type::Heading,
        ParamKind::Length => Type::Quantity(Dimension::LENGTH),
        ParamKind::Number => NUMBER,
        ParamKind::Bool => Type::Bool,
    };
    let default = param.default().map(|value| {
        let range = if ty == Type::Bool { Interval::ANY } else { Interval::exactly(value) };
        hir::Expr { kind: ExprKind::Number(value), ty: ty.clone(), span: statement, range }
    });
    ParamInfo { name: param.name.to_string(), ty, default, range: param.range, behavior: None, span: place }
}

/// Whether guidance comes to an end of its own.
pub(super) fn guidance_ends(guide: Guide, args: &[hir::Expr]) -> bool {
    match guide.law().ends {
        Ends::Arrives => true,
        Ends::Turns(_) => turns(guide, args).is_none_or(|turns| turns.range.constant() != Some(0.0)),
        Ends::Never => false,
    }
}

/// How many turns guidance makes, where it ends after so many; after 0 it does not.
fn turns(guide: Guide, args: &[hir::Expr]) -> Option<&hir::Expr> {
    let law = guide.law();
    let Ends::Turns(name) = law.ends else { return None };
    law.params.iter().zip(args).find(|(param, _)| param.name == name).map(|(_, turns)| turns)
}

/// The type of a setpoint.
pub(super) fn setpoint_type(channel: Channel) -> Type {
    match channel.row().kind {
        SetpointKind::Depth => Type::Depth,
        SetpointKind::Altitude => Type::Altitude,
        SetpointKind::Quantity(name) => Dimension::of_type(name).map_or(Type::Unknown, Type::Quantity),
    }
}

fn owned_twice(span: Span, earlier: Span, channel: Channel) -> Diagnostic {
    Diagnostic::error(Code::ChannelsTwice, span, format!("the {} is set twice", channel.row().axis.title()))
        .label(earlier, "already set here")
        .help("keep one of them")
}
