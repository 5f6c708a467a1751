//! What belongs to overlays alone: `amend`, and the channel that one sets.

use super::{Checker, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Body, Decl, Kind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, Clause, ClauseKind};
use crate::types::Type;

impl<'t> Checker<'t> {
    /// An overlay does one thing, and so does all that it calls: one that owns a channel keeps that, one that amends amends. It puts
    /// nothing in force.
    pub(super) fn overlay_does_one_thing(&mut self, hir: &hir::Hir, id: usize) {
        let overlay = &hir.activities[id];
        let kind = overlay.kind;
        let (message, help) = match kind {
            Kind::Sets(axis) => (
                format!("an overlay that sets the {} does nothing else", axis.name()),
                format!("it holds statements such as `{}` and `wait`", axis.example()),
            ),
            _ => (
                "an overlay that amends the course does nothing else".to_string(),
                "put on both overlays where this one is put on: `with A(…), B(…)`".to_string(),
            ),
        };
        for (place, foreign) in foreign_in(hir, id, kind) {
            let finding = Diagnostic::error(Code::ChannelsOther, place, message.clone()).help(help.clone());
            self.report(match foreign {
                Some(foreign) => finding.label(foreign, "this is called here"),
                None => finding,
            });
        }
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

/// What does not belong into an overlay of a kind: its own statements, and its calls of what holds some, with the first of those.
fn foreign_in(hir: &hir::Hir, id: usize, kind: Kind) -> Vec<(Span, Option<Span>)> {
    let activity = &hir.activities[id];
    let mut found: Vec<(Span, Option<Span>)> = put_on(activity).map(|span| (span, None)).collect();
    let Body::Sequence(block) = &activity.body else { return found };
    block.each(&mut |stmt| {
        if let hir::StmtKind::Timed(timed) = &stmt.kind
            && let hir::Action::Call(called, _) = &timed.action
            && timed.at.is_empty()
        {
            let first = hir.called_from(*called).into_iter().find_map(|id| {
                let activity = &hir.activities[id];
                let mut first = put_on(activity).next();
                if let Body::Sequence(block) = &activity.body {
                    block.each(&mut |stmt| {
                        if first.is_none() && is_foreign(stmt, kind) {
                            first = Some(stmt.span);
                        }
                    });
                }
                first
            });
            found.extend(first.map(|first| (stmt.span, Some(first))));
        } else if is_foreign(stmt, kind) {
            found.push((stmt.span, None));
        }
    });
    found
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
        hir::Action::Call(..) => false,
        hir::Action::Watch | hir::Action::Override(_) => true,
    };
    is_foreign || !timed.at.is_empty()
}
