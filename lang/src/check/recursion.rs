//! What calls itself. There is no recursion in the language: what can ever be active is known before launch, and so is the
//! memory that it takes.

use super::Checker;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::calls_in;
use crate::source::Span;

impl<'t> Checker<'t> {
    /// Reports what calls itself, each circle once; tells whether there is one.
    pub(super) fn recursion(&mut self) -> bool {
        let activities: Vec<Vec<usize>> = self.hir.activities.iter().map(|a| a.calls()).collect();
        const OF_ACTIVITIES: &str = "what can be active must be known before launch: use `loop` or `while`";
        const OF_FNS: &str = "a function goes round in a `for` with a bound: `for i in 1..10 { … }`";
        let of_activities = circles(&activities).into_iter().map(|circle| {
            circle
                .iter()
                .map(|&id| (self.hir.activities[id].name.clone(), self.hir.activities[id].span))
                .collect::<Vec<_>>()
        });
        let fns: Vec<Vec<usize>> = self.hir.fns.iter().map(|f| calls_in(&f.body)).collect();
        let of_fns = circles(&fns).into_iter().map(|circle| {
            circle.iter().map(|&id| (self.hir.fns[id].name.clone(), self.fn_signatures[id].span)).collect::<Vec<_>>()
        });
        let of_activities = of_activities.map(|circle| finding(&circle, OF_ACTIVITIES));
        let findings: Vec<Diagnostic> = of_activities.chain(of_fns.map(|circle| finding(&circle, OF_FNS))).collect();
        let found = !findings.is_empty();
        findings.into_iter().for_each(|finding| self.report(finding));
        found
    }
}

fn finding(circle: &[(String, Span)], help: &str) -> Diagnostic {
    let (first, span) = &circle[0];
    let others: Vec<String> = circle[1..].iter().map(|(name, _)| format!("`{name}`")).collect();
    let through = if others.is_empty() { String::new() } else { format!(" through {}", others.join(", ")) };
    let mut finding =
        Diagnostic::error(Code::FlowRecursion, *span, format!("`{first}` calls itself{through}")).help(help);
    for (i, (_, span)) in circle.iter().enumerate().skip(1) {
        finding = finding.label(*span, format!("is called by `{}`", circle[i - 1].0));
    }
    finding
}

/// The circles among calls: from each node that is part of one and of no circle found before, the way back to it.
fn circles(calls: &[Vec<usize>]) -> Vec<Vec<usize>> {
    #[derive(Clone, Copy, PartialEq)]
    enum Seen {
        Not,
        /// On the way from where the search began.
        OnTheWay,
        Done,
    }
    let mut seen = vec![Seen::Not; calls.len()];
    let mut circles = Vec::new();
    for start in 0..calls.len() {
        if seen[start] != Seen::Not {
            continue;
        }
        // The way so far: each node with how many of its calls were looked at.
        let mut way = vec![(start, 0)];
        seen[start] = Seen::OnTheWay;
        while let Some((node, looked)) = way.last_mut() {
            let Some(&next) = calls[*node].get(*looked) else {
                seen[*node] = Seen::Done;
                way.pop();
                continue;
            };
            *looked += 1;
            match seen[next] {
                Seen::Not => {
                    seen[next] = Seen::OnTheWay;
                    way.push((next, 0));
                }
                Seen::OnTheWay => {
                    let from = way.iter().position(|(node, _)| *node == next).unwrap_or_default();
                    circles.push(way[from..].iter().map(|(node, _)| *node).collect());
                }
                Seen::Done => {}
            }
        }
    }
    circles
}
