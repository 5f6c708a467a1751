//! Behaviors, strategies, overlays and missions: their declarations, and what each kind may hold.

use super::expr::article;
use super::{Checker, Driving, Setting, Temporal, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Body, Builtin, Decl, Expr, ExprKind, Kind, Mission, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, ActivityKind, Clause, ClauseKind};
use crate::types::Type;
use albacore_program::Axis;
use albacore_wording::either;

/// The parts of an activity, gathered clause by clause.
#[derive(Default)]
struct Parts {
    decls: Vec<Decl>,
    aborts: Vec<(Vec<hir::TextPart>, Expr)>,
    reactions: Vec<(Expr, hir::Block)>,
    recordings: Vec<hir::Recording>,
    mission: Mission,
}

impl<'t> Checker<'t> {
    pub(super) fn check_activity(&mut self, m: usize, id: usize, a: &'t tree::Activity) {
        if self.baseless.contains(&a.name.span) {
            return;
        }
        self.declared_activity(m, id, a);
    }

    /// An activity whose parameters are declared; `owner` is the strategy in which a behavior is nested.
    pub(super) fn activity(&mut self, id: usize, a: &'t tree::Activity, owner: Option<usize>) -> hir::Activity {
        let kind = self.kind(a);
        let result = match owner {
            Some(_) => None,
            None => self.activity_signature(id).result.clone(),
        };
        self.scope.finish = match kind {
            Kind::Behavior | Kind::Mission => Some(result.clone()),
            _ => None,
        };
        let (declarations, statements) = split(&a.body.clauses);
        let mut parts = Parts::default();
        for clause in declarations {
            self.in_part(clause.span, |c| c.declaration(clause, kind, &mut parts));
        }
        let is_table = statements
            .iter()
            .any(|c| matches!(c.kind, ClauseKind::Rule(_) | ClauseKind::Start(_) | ClauseKind::Behavior(_)))
            || kind == Kind::Strategy;
        let body = match kind {
            Kind::AmendsCourse => self.amend(a, &statements),
            _ if is_table => self.table(id, a, result.as_ref(), &statements),
            _ => {
                let block = self.in_block(|c| hir::Block { stmts: c.stmts(&statements), value: None });
                self.sequence_ends(a, result.as_ref(), &block);
                Body::Sequence(block)
            }
        };
        if kind == Kind::Mission {
            self.require_for_limits(&mut parts.mission);
            self.mission_header(a, &mut parts.mission);
        }
        hir::Activity {
            kind,
            span: a.name.span,
            owner,
            result,
            decls: parts.decls,
            aborts: parts.aborts,
            reactions: parts.reactions,
            recordings: parts.recordings,
            body,
            mission: (kind == Kind::Mission).then_some(parts.mission),
            ..hir::Activity::empty(&a.name.node, a.name.span)
        }
    }

    fn kind(&mut self, a: &tree::Activity) -> Kind {
        match &a.kind {
            ActivityKind::Behavior => Kind::Behavior,
            ActivityKind::Strategy { .. } => Kind::Strategy,
            ActivityKind::Mission { .. } => Kind::Mission,
            ActivityKind::Overlay { does: None } => Kind::Beside,
            ActivityKind::Overlay { does: Some((verb, channel)) } => {
                match (verb.node.as_str(), channel.node.as_str()) {
                    ("amends", "course") => Kind::AmendsCourse,
                    ("sets", axis) if Axis::named(axis).is_some() => {
                        Axis::named(axis).map_or(Kind::AmendsCourse, Kind::Sets)
                    }
                    _ => {
                        self.report(
                            Diagnostic::error(
                                Code::ChannelsUnknown,
                                channel.span,
                                format!("an overlay cannot {} `{}`", verb.node.trim_end_matches('s'), channel.node),
                            )
                            .help(format!(
                                "an overlay {}; one that only looks on says nothing of it",
                                either(Axis::overlay_words())
                            )),
                        );
                        Kind::AmendsCourse
                    }
                }
            }
        }
    }

    fn declaration(&mut self, clause: &'t Clause, kind: Kind, parts: &mut Parts) {
        match &clause.kind {
            ClauseKind::Area { .. } | ClauseKind::Limits(_) | ClauseKind::Requires(_) | ClauseKind::Recovery { .. } => {
                self.mission_part(clause, kind, parts);
            }
            ClauseKind::Recording { inputs, rate } => {
                if !matches!(kind, Kind::Behavior | Kind::Strategy | Kind::Mission) {
                    return self.misplaced(
                        clause.span,
                        "an overlay records nothing",
                        "move it to the mission, or to the behavior beside which the overlay runs",
                    );
                }
                let recording = self.recording(inputs, rate, &parts.recordings);
                parts.recordings.extend(recording);
            }
            ClauseKind::With(items) => {
                let with = self.with_setting(Setting::Instant, |c| c.with_items(items));
                parts.decls.push(Decl::With(with));
            }
            ClauseKind::Signal { name, ty, value } => parts.decls.push(self.signal(name, ty.as_ref(), value)),
            ClauseKind::Memory { name, ty, init } => parts.decls.push(self.memory(name, ty, init.as_ref())),
            ClauseKind::Reaction { on, block } => parts.reactions.push(self.reaction(on, block)),
            ClauseKind::Abort { why, on: Some(on) } => {
                let condition = self.instant(Temporal::Yes, |c| c.condition(on));
                let why = self.told(why);
                parts.aborts.push((why, condition));
            }
            _ => {}
        }
    }

    /// What a mission alone says of itself.
    fn mission_part(&mut self, clause: &'t Clause, kind: Kind, parts: &mut Parts) {
        if kind != Kind::Mission {
            return self.misplaced(
                clause.span,
                "this stands in a mission only",
                "move it to the mission; behaviors take what they need as parameters",
            );
        }
        match &clause.kind {
            ClauseKind::Area { name, value } => self.area(name, value, parts),
            ClauseKind::Limits(limits) => limits.iter().for_each(|limit| self.limit(limit, &mut parts.mission)),
            ClauseKind::Requires(requires) => {
                requires.iter().for_each(|require| self.require(require, &mut parts.mission));
            }
            ClauseKind::Recovery { within, block } => {
                self.recovery(within.as_ref(), block, clause.span, &mut parts.mission);
            }
            _ => {}
        }
    }

    fn signal(&mut self, name: &tree::Name, ty: Option<&tree::Ty>, value: &tree::Expr) -> Decl {
        let value = self.instant(Temporal::Yes, |c| match ty {
            Some(ty) => {
                let ty = c.written_type(c.scope.module, ty);
                c.expr_as(value, &ty, &format!("`{}`", name.node))
            }
            None => c.expr(value, None),
        });
        if value.ty == Type::None {
            self.report(Diagnostic::error(Code::TypesNone, value.span, "this signal is always absent"));
        }
        let id = self.declare(name, VarKind::Signal, value.ty.clone());
        self.scope.vars[id].is_momentary = self.is_momentary(&value);
        Decl::Signal(id, value)
    }

    fn memory(&mut self, name: &tree::Name, ty: &tree::Ty, init: Option<&tree::Expr>) -> Decl {
        let written = self.kept_type(self.scope.module, ty);
        let init = init.map(|e| {
            let what = format!("`{}`", name.node);
            self.instant(Temporal::No, |c| c.expr_as(e, &written, &what))
        });
        let empty_is_plain = matches!(written, Type::List(..) | Type::Optional(_) | Type::Unknown);
        if init.is_none() && !empty_is_plain {
            self.report(
                Diagnostic::error(Code::TypesMemory, name.span, format!("with what does `{}` begin?", name.node))
                    .help("write `= VALUE`; only lists begin empty and optionals absent"),
            );
        }
        let id = self.declare(name, VarKind::Memory, written);
        if let Some(range) = Self::implied_range(&self.scope.vars[id].ty) {
            self.scope.vars[id].range = range;
        }
        if let Some(init) = &init {
            self.assigned_in_range(id, init);
        }
        self.list_order(id, ty);
        Decl::Memory(id, init)
    }

    fn reaction(&mut self, on: &tree::Expr, block: &tree::Block) -> (Expr, hir::Block) {
        let condition = self.instant(Temporal::Reaction, |c| c.condition(on));
        let facts = self.shown(&condition, true);
        let block = self.with_setting(Setting::Instant, |c| {
            c.in_block(|c| {
                c.learn(facts);
                c.block(block)
            })
        });
        (condition, block)
    }

    /// The operating area, and regions of it.
    fn area(&mut self, name: &tree::Name, value: &tree::Expr, parts: &mut Parts) {
        let value = self.instant(Temporal::No, |c| c.expr_as(value, &Type::Area, "the area"));
        let id = self.declare(name, VarKind::Area, Type::Area);
        parts.mission.areas.push(id);
        parts.decls.push(Decl::Area(id, value));
    }

    fn recovery(&mut self, within: Option<&tree::Expr>, block: &tree::Block, span: Span, mission: &mut Mission) {
        if mission.recovery.is_some() {
            let finding = Diagnostic::error(Code::MissionsTwice, span, "a mission has one recovery");
            self.report(finding.help("keep one of them"));
        }
        let within = within.map(|e| self.time_limit(e, "the time of the recovery"));
        if within.is_none() {
            let word = Span { end: span.start + "recovery".len() as u32, ..span };
            self.report(
                Diagnostic::error(Code::MissionsEndless, word, "this recovery may go on for ever")
                    .here("no `within` bounds it")
                    .help("write `recovery within 10 min { … }`: the mission's own time does not bound it"),
            );
        }
        let finish = self.scope.finish.take();
        self.scope.driving = Some(Driving::Recovery);
        let block = self.in_block(|c| c.block(block));
        self.scope.driving = None;
        self.scope.finish = finish;
        if let Some(place) = flow::aborts(&block) {
            self.report(
                Diagnostic::error(
                    Code::MissionsRecovery,
                    place,
                    "a recovery cannot abort: the mission is over already",
                )
                .help("leave it out: the recovery ends with its last statement, or with its `within`"),
            );
        }
        mission.recovery = Some((within, block));
    }

    /// Works where code is instantaneous.
    pub(super) fn instant<T>(&mut self, temporal: Temporal, work: impl FnOnce(&mut Self) -> T) -> T {
        self.with_setting(Setting::Instant, |c| c.with_temporal(temporal, work))
    }

    /// A body's end: what must finish does.
    fn sequence_ends(&mut self, a: &tree::Activity, result: Option<&Type>, block: &hir::Block) {
        if let Some(result) = result
            && !flow::leaves(block)
        {
            let ty = self.type_name(result);
            self.report(
                Diagnostic::error(
                    Code::FlowResult,
                    a.name.span,
                    format!("`{}` can end without its result, {}", a.name.node, article(&ty)),
                )
                .help("end every path with `finish VALUE`; for a result that may be absent declare it with `?`"),
            );
        }
    }

    /// A condition of a rule, in whose context `done` may stand.
    pub(super) fn rule_condition(&mut self, e: &tree::Expr) -> Expr {
        self.instant(Temporal::Rule, |c| c.condition(e))
    }

    /// `not X`, for the checks of the table.
    pub(super) fn is_just_done(guard: &Expr) -> bool {
        match &guard.kind {
            ExprKind::Done => true,
            ExprKind::Do(Builtin::Or, operands) => operands.iter().any(Self::is_just_done),
            _ => false,
        }
    }
}

/// Declarations, and the statements or the table after them.
fn split(clauses: &[Clause]) -> (Vec<&Clause>, Vec<&Clause>) {
    let is_declaration = |kind: &ClauseKind| {
        matches!(
            kind,
            ClauseKind::Signal { .. }
                | ClauseKind::Memory { .. }
                | ClauseKind::Reaction { .. }
                | ClauseKind::Abort { on: Some(_), .. }
                | ClauseKind::Area { .. }
                | ClauseKind::Limits(_)
                | ClauseKind::Requires(_)
                | ClauseKind::Recovery { .. }
                | ClauseKind::Recording { .. }
        )
    };
    // `with` is a declaration until the first statement: later it holds for the rest of its block only.
    let first = clauses
        .iter()
        .position(|c| !is_declaration(&c.kind) && !matches!(c.kind, ClauseKind::With(_)))
        .unwrap_or(clauses.len());
    let mut declarations = Vec::new();
    let mut statements = Vec::new();
    for (i, clause) in clauses.iter().enumerate() {
        if is_declaration(&clause.kind) || (i < first && matches!(clause.kind, ClauseKind::With(_))) {
            declarations.push(clause);
        } else {
            statements.push(clause);
        }
    }
    (declarations, statements)
}
