//! Findings of a walk through all that a mission calls, with the calls that lead to each.

use crate::diagnostic::Diagnostic;
use crate::hir::{ActivityId, Hir};
use crate::source::Span;

/// A finding names this many places at most.
const PLACES_MAX: usize = 4;

/// What has been found, and the calls that lead to where the walk is.
#[derive(Default)]
pub(super) struct Findings {
    path: Vec<(String, Span)>,
    findings: Vec<Diagnostic>,
}

impl Findings {
    /// Goes into what is called at a place, and comes back.
    pub fn called(&mut self, hir: &Hir, id: ActivityId, place: Span) {
        self.path.push((hir.activities[id].full_name.clone(), place));
    }

    pub fn back(&mut self) {
        self.path.pop();
    }

    /// Tells a finding. The same at several places is one mistake, shown where it first tells and in some more places.
    pub fn report(&mut self, mut finding: Diagnostic) {
        let span = finding.span();
        if let Some(known) = self.findings.iter_mut().find(|f| f.code == finding.code && f.message == finding.message) {
            if known.labels.len() < PLACES_MAX && !known.labels.iter().any(|(s, _)| *s == span) {
                known.labels.push((span, "and here".to_string()));
            }
            return;
        }
        for (name, span) in self.path.iter().rev() {
            finding = finding.label(*span, format!("`{name}` is called here"));
        }
        self.findings.push(finding);
    }

    pub fn into_vec(self) -> Vec<Diagnostic> {
        self.findings
    }
}
