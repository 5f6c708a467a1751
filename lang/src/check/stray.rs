//! Statements where none belong: beside the behaviors and rules of a switching table.

use super::Checker;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree::{self, Clause, ClauseKind};

/// What is said of a statement beside behaviors and rules.
pub(super) const NO_STATEMENTS: &str = "a switching table has no statements";

impl<'t> Checker<'t> {
    /// Says that a behavior is declared among statements, where no rule and no `start` makes a table of them.
    pub(super) fn is_no_table(&mut self, a: &tree::Activity, clauses: &[&'t Clause]) -> bool {
        let Some(inner) = among_statements(clauses) else { return false };
        let message = format!("the behavior `{}` stands among the statements of `{}`", inner.node, a.name.node);
        let finding = Diagnostic::error(Code::RulesStart, inner.span, message);
        self.report(finding.help(format!(
            "declare it before `{}`; with `start {}` and rules in place of the statements it is a switching table",
            a.name.node, inner.node
        )));
        true
    }

    /// Says where the statements among the clauses of a table belong.
    pub(super) fn stray_statements(&mut self, clauses: &[&Clause]) {
        for (nth, clause) in clauses.iter().enumerate() {
            let (message, help) = match clause.kind {
                // Behind a statement that is what is wrong, and has been told.
                ClauseKind::With(_) if nth > 0 => continue,
                ClauseKind::With(_) => {
                    ("a `with` of a switching table stands before its behaviors and rules", "move it up there")
                }
                ClauseKind::Let { .. } | ClauseKind::Var { .. } => (
                    NO_STATEMENTS,
                    "what changes is a `memory` of the table, what does not a `const` of the file or a parameter",
                ),
                _ => (NO_STATEMENTS, "move it into a behavior, and name that behavior in the table"),
            };
            self.misplaced(clause.span, message, help);
        }
    }
}

/// A name that stands alone, as after a `start` that was left out.
pub(super) fn alone(clause: &Clause) -> Option<(&str, Span)> {
    match &clause.kind {
        ClauseKind::Timed(timed) if !timed.is_modified() => match &timed.action {
            tree::Action::Expr(tree::Expr { kind: tree::ExprKind::Name(name), .. }) => Some((name, clause.span)),
            _ => None,
        },
        _ => None,
    }
}

/// Such a behavior.
fn among_statements<'t>(clauses: &[&'t Clause]) -> Option<&'t tree::Name> {
    let is_table =
        |clause: &&Clause| matches!(clause.kind, ClauseKind::Start(_) | ClauseKind::Rule(_)) || alone(clause).is_some();
    let is_other = |clause: &&Clause| !matches!(clause.kind, ClauseKind::Behavior(_) | ClauseKind::With(_));
    if clauses.iter().any(is_table) || !clauses.iter().any(is_other) {
        return None;
    }
    clauses.iter().find_map(|clause| match &clause.kind {
        ClauseKind::Behavior(behavior) => Some(&behavior.name),
        _ => None,
    })
}
