//! What belongs to overlays alone: `amend`, and the channel that one sets.

use super::ends::{Known, can_end};
use super::{Checker, Setting, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Action, ActivityId, Body, Decl, First, Kind, StmtKind, Target, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, Clause, ClauseKind};
use crate::types::Type;
use albacore_program::Axis;
use std::collections::BTreeMap;

impl<'t> Checker<'t> {
    /// An overlay does one thing, and so does all that it calls: one that owns a channel keeps that, one that amends amends. It puts
    /// nothing in force.
    pub(super) fn overlays_do_one_thing(&mut self, hir: &hir::Hir, known_ends: &mut Known) {
        // What does not belong into overlays of each kind, in all that they call.
        let mut foreign = BTreeMap::new();
        let mut aborts = First::new(hir, own_abort);
        let mut firsts = Firsts::default();
        let mut records = First::new(hir, own_record);
        for &id in &self.overlay_ids.clone() {
            let overlay = &hir.activities[id];
            let kind = overlay.kind;
            if let Some(place) = records.of(id) {
                let finding = Diagnostic::error(Code::MissionsRecord, place, "what an overlay calls records nothing");
                self.report(
                    finding
                        .label(overlay.span, "this overlay")
                        .help("move it to the mission, or to the behavior beside which the overlay runs"),
                );
            }
            let known =
                foreign.entry(kind).or_insert_with(|| First::new(hir, move |activity| first_foreign(activity, kind)));
            let has_foreign = self.foreign_in(hir, id, known);
            let what = match kind {
                Kind::Sets(axis) => format!("that sets the {}", axis.name()),
                Kind::Beside => "that runs beside".to_string(),
                _ => continue,
            };
            if let Some(place) = aborts.of(id) {
                let message = format!("an overlay {what} cannot say `abort` in its body");
                self.report(
                    Diagnostic::error(Code::ChannelsOther, place, message)
                        .label(overlay.span, "this overlay")
                        .help("write `abort \"why\" on CONDITION` at its top: in the recovery the overlay goes on, without it"),
                );
            }
            if kind == Kind::Beside && matches!(overlay.body, Body::Table { .. }) && can_end(id, hir, known_ends) {
                let message = format!("`{}` ends, and what it is put on goes on", overlay.name);
                self.report(
                    Diagnostic::error(Code::ChannelsEnds, overlay.span, message)
                        .help("let the last behavior of its table `wait`, and leave the `finish` out"),
                );
            }
            let Kind::Sets(axis) = kind else { continue };
            if can_end(id, hir, known_ends) {
                self.report(
                    Diagnostic::error(
                        Code::ChannelsEnds,
                        overlay.span,
                        format!("`{}` ends and leaves its channel to nobody", overlay.name),
                    )
                    .help("write its statements in a `loop { … }`"),
                );
            }
            // What does not belong there was told of, and is not waited for.
            if let (FirstTimed::Waits(place), false) = (firsts.of_activity(id, hir), has_foreign) {
                let message = format!("`{}` waits before it sets the {}", overlay.name, axis.name());
                self.report(
                    Diagnostic::error(Code::ChannelsUnset, place, message)
                        .here("until this ends nobody sets it")
                        .label(overlay.span, "this overlay owns it as soon as it is put on")
                        .help(format!("begin with what it keeps, such as `{}`", axis.example())),
                );
            }
        }
    }

    /// Reports what does not belong into an overlay; tells whether there is any.
    fn foreign_in(
        &mut self,
        hir: &hir::Hir,
        id: usize,
        known: &mut First<'_, impl Fn(&hir::Activity) -> Option<Span>>,
    ) -> bool {
        let overlay = &hir.activities[id];
        let kind = overlay.kind;
        let (message, help) = match kind {
            Kind::Sets(axis) => (
                format!("an overlay that sets the {} does nothing else", axis.name()),
                format!("it holds statements such as `{}` and `wait`", axis.example()),
            ),
            Kind::Beside => (
                "an overlay without a channel commands nothing".to_string(),
                format!(
                    "it holds `wait`, `log`, `report` and what takes no time; one that commands {}",
                    albacore_wording::either(Axis::overlay_words())
                ),
            ),
            _ => (
                "an overlay that amends the course does nothing else".to_string(),
                "put on both overlays where this one is put on: `with A(…), B(…)`".to_string(),
            ),
        };
        let mut found: Vec<(Span, Option<Span>)> = put_on(overlay).map(|span| (span, None)).collect();
        overlay.body.each(&mut |stmt| match called(stmt) {
            Some(called) => found.extend(known.of(called).map(|first| (stmt.span, Some(first)))),
            None if is_foreign(stmt, kind) => found.push((stmt.span, None)),
            None => {}
        });
        if let Body::Table { behaviors, .. } = &overlay.body {
            found.extend(behaviors.iter().filter_map(|behavior| known.of(*behavior)).map(|first| (first, None)));
        }
        let is_any = !found.is_empty();
        for (place, foreign) in found {
            let finding = Diagnostic::error(Code::ChannelsOther, place, message.clone()).help(help.clone());
            self.report(match foreign {
                Some(foreign) => finding.label(foreign, "this is called here"),
                None => finding,
            });
        }
        is_any
    }

    pub(super) fn amend(&mut self, a: &'t tree::Activity, statements: &[&'t Clause]) -> Body {
        let asked_name = tree::Name { node: "asked".to_string(), span: a.name.span };
        let mut found = None;
        for clause in statements {
            match &clause.kind {
                ClauseKind::Amend(block) if found.is_none() => found = Some((block, clause.span)),
                ClauseKind::Amend(_) => {
                    self.report(Diagnostic::error(Code::SyntaxMisplaced, clause.span, "an overlay has one `amend`"));
                }
                _ => self.misplaced(
                    clause.span,
                    "an overlay that amends the course has no body",
                    "write it inside `amend { … }`",
                ),
            }
        }
        let Some((block, span)) = found else {
            self.report(
                Diagnostic::error(Code::ChannelsAmend, a.name.span, format!("`{}` amends nothing", a.name.node))
                    .help("write `amend { … }`: its value is the new course, `asked` the one asked for"),
            );
            return Body::Sequence(hir::Block::default());
        };
        let (asked, block) = self.in_block(|c| {
            let asked = c.declare(&asked_name, VarKind::Let, Type::Heading);
            // An overlay may lead elsewhere whatever is asked.
            c.names_used.read(asked_name.span);
            let block = c.with_setting(Setting::Instant, |c| {
                let mut block = c.value_block(block, Some(&Type::Heading));
                match block.value.take() {
                    Some(value) => block.value = Some(Box::new(c.coerce(*value, &Type::Heading, "the amended course"))),
                    None => c.report(
                        Diagnostic::error(Code::ChannelsAmend, span, "`amend` must end in a course")
                            .help("end it with a heading; `asked` leaves the course as it is"),
                    ),
                }
                block
            });
            (asked, block)
        });
        Body::Amend { asked, block }
    }
}

/// What a statement calls that gives it no setpoints of its own.
fn called(stmt: &hir::Stmt) -> Option<ActivityId> {
    match &stmt.kind {
        StmtKind::Timed(timed) if timed.at.is_empty() => match timed.action {
            Action::Call(called, _) => Some(called),
            _ => None,
        },
        _ => None,
    }
}

/// The first of an activity's own that does not belong into overlays of a kind.
fn first_foreign(activity: &hir::Activity, kind: Kind) -> Option<Span> {
    put_on(activity).next().or_else(|| activity.body.first(|stmt| is_foreign(stmt, kind)))
}

/// The first place where an activity says `abort` by itself, as a statement or as where a rule leads.
fn own_abort(activity: &hir::Activity) -> Option<Span> {
    let rules = if let Body::Table { rules, .. } = &activity.body { rules.as_slice() } else { &[] };
    let rule = rules.iter().find(|rule| matches!(rule.target, Target::Abort(_))).map(|rule| rule.span);
    rule.or_else(|| activity.body.first(|stmt| matches!(stmt.kind, StmtKind::Abort(_))))
}

/// The first place where an activity says by itself what is recorded.
fn own_record(activity: &hir::Activity) -> Option<Span> {
    activity.recordings.iter().find_map(|recording| recording.inputs.first()).map(|(_, span)| *span)
}

/// What comes first of what takes time.
#[derive(Clone, Copy)]
enum FirstTimed {
    /// A setpoint is kept, on every way.
    Keeps,
    /// On some way something else comes before a setpoint is kept, here.
    Waits(Span),
    /// On some way nothing takes time.
    Nothing,
}

/// What comes first in each activity of which that is known.
#[derive(Default)]
struct Firsts(BTreeMap<ActivityId, FirstTimed>);

impl Firsts {
    fn of_block(&mut self, block: &hir::Block, hir: &hir::Hir) -> FirstTimed {
        let firsts = block.stmts.iter().map(|stmt| self.of_stmt(stmt, hir));
        firsts.into_iter().find(|first| !matches!(first, FirstTimed::Nothing)).unwrap_or(FirstTimed::Nothing)
    }

    fn of_stmt(&mut self, stmt: &hir::Stmt, hir: &hir::Hir) -> FirstTimed {
        match &stmt.kind {
            StmtKind::Timed(timed) => match &timed.action {
                Action::Keep(..) => FirstTimed::Keeps,
                Action::Call(id, _) => match self.of_activity(*id, hir) {
                    FirstTimed::Waits(_) => FirstTimed::Waits(stmt.span),
                    first => first,
                },
                _ => FirstTimed::Waits(stmt.span),
            },
            StmtKind::Finish(_) | StmtKind::Abort(_) => FirstTimed::Keeps,
            kind => {
                let goes_round = match kind {
                    StmtKind::ForRange { first, last, inclusive, .. } => flow::goes_round(first, last, *inclusive),
                    StmtKind::ForEdges { .. } | StmtKind::Loop(_) | StmtKind::With(..) | StmtKind::If(..) => true,
                    StmtKind::Match(..) => true,
                    _ => false,
                };
                let blocks = stmt.blocks().into_iter().map(|block| self.of_block(block, hir));
                let first = blocks.fold(None, |first, block| Some(either(first.unwrap_or(block), block)));
                match first {
                    Some(FirstTimed::Keeps) if !goes_round => FirstTimed::Nothing,
                    first => first.unwrap_or(FirstTimed::Nothing),
                }
            }
        }
    }

    fn of_activity(&mut self, id: ActivityId, hir: &hir::Hir) -> FirstTimed {
        if let Some(first) = self.0.get(&id) {
            return *first;
        }
        let first = match &hir.activities[id].body {
            Body::Sequence(block) => self.of_block(block, hir),
            Body::Table { start, behaviors, .. } => {
                behaviors.get(*start).map_or(FirstTimed::Nothing, |start| self.of_activity(*start, hir))
            }
            Body::Amend { .. } => FirstTimed::Nothing,
        };
        self.0.insert(id, first);
        first
    }
}

/// What comes first where one of two ways is gone.
fn either(a: FirstTimed, b: FirstTimed) -> FirstTimed {
    match (a, b) {
        (FirstTimed::Waits(_), _) => a,
        (_, FirstTimed::Waits(_)) => b,
        (FirstTimed::Keeps, FirstTimed::Keeps) => a,
        _ => FirstTimed::Nothing,
    }
}

/// The setpoints and overlays that the declarations of an activity put in force.
fn put_on(activity: &hir::Activity) -> impl Iterator<Item = Span> {
    let items = activity.decls.iter().filter_map(|decl| if let Decl::With(items) = decl { Some(items) } else { None });
    items.flatten().map(|item| match item {
        hir::With::Setpoint(_, e) => e.span,
        hir::With::Overlay(_, _, place) => *place,
    })
}

/// Whether an overlay of a kind has nothing to do with a statement.
fn is_foreign(stmt: &hir::Stmt, kind: Kind) -> bool {
    let hir::StmtKind::Timed(timed) = &stmt.kind else { return matches!(stmt.kind, hir::StmtKind::With(..)) };
    let is_foreign = match &timed.action {
        hir::Action::Keep(kept, _) => kind != Kind::Sets(kept.row().axis),
        hir::Action::Guide(guide, _) => !guide.law().is_for_overlays,
        hir::Action::Call(..) | hir::Action::Ask(..) => false,
        hir::Action::Watch | hir::Action::Override(_) => true,
    };
    is_foreign || !timed.at.is_empty()
}
