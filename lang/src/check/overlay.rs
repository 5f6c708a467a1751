//! What belongs to overlays alone: `amend`, and the channel that one sets.

use super::{Checker, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Body, VarKind};
use crate::syntax::tree::{self, Clause, ClauseKind};
use crate::types::Type;
use albacore_program::Axis;

impl<'t> Checker<'t> {
    /// An overlay that owns a channel has nothing to say of the others.
    pub(super) fn sets_only(&mut self, axis: Axis, block: &hir::Block) {
        let mut found = Vec::new();
        block.each(&mut |stmt| {
            let hir::StmtKind::Timed(timed) = &stmt.kind else { return };
            let foreign = match &timed.action {
                hir::Action::Keep(kept, _) => kept.row().axis != axis,
                hir::Action::Guide(guide, _) => !guide.law().is_for_overlays,
                hir::Action::Call(..) => false,
                hir::Action::Watch | hir::Action::Override(_) => true,
            };
            if foreign || !timed.at.is_empty() {
                found.push(stmt.span);
            }
        });
        let (name, setpoint) = (axis.name(), axis.example());
        for span in found {
            self.report(
                Diagnostic::error(
                    Code::ChannelsOther,
                    span,
                    format!("an overlay that sets the {name} does nothing else"),
                )
                .help(format!("it holds statements such as `{setpoint}` and `wait`")),
            );
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
