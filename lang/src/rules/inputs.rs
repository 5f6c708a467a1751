//! Inputs that are read and not required: nobody has said how old they may be.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{
    Action, Activity, Block, Body, Decl, Expr, ExprKind, Hir, StmtKind, With, activity_children, children,
};
use crate::source::Span;
use crate::suggest;
use albacore_program::Guide;
use std::collections::{BTreeMap, BTreeSet};

/// Inputs that the machine reads without being asked: to go over ground in moving water, and to hold a vertical limit.
const BY_THE_MACHINE: [&str; 4] = ["flow", "depth", "altitude", "water_depth"];

/// Inputs that a `hold` keeps its place by, where they have come; without them it lies still.
const BY_HOLD: [&str; 2] = ["position", "course"];

/// Inputs that are never too old: they tell how things stand with the vehicle, and that of one not heard from as well.
const OF_THE_LINK: [&str; 2] = ["control", "vehicle_mode"];

/// So many places are shown where an input is read.
const PLACES_MAX: usize = 3;

struct Walk<'a> {
    hir: &'a Hir,
    seen: BTreeSet<usize>,
    /// For each input that is read the first place where it is.
    read: BTreeMap<usize, Span>,
    /// Whether it holds anywhere.
    holds: bool,
}

/// Finds the inputs that a mission reads, with all that it calls, and does not require.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some(parts) = &activity.mission else { return Vec::new() };
    let mut findings = Vec::new();
    let Walk { read, holds, .. } = walk(hir, mission);
    let unrequired = |(input, _): &(&usize, &Span)| {
        let name = hir.inputs[**input].name.as_str();
        !parts.requires.iter().any(|r| r.input == **input) && !OF_THE_LINK.contains(&name)
    };
    let unrequired: Vec<(&str, Span)> =
        read.iter().filter(unrequired).map(|(&input, &span)| (hir.inputs[input].name.as_str(), span)).collect();
    findings.extend(missing(activity, &unrequired, !parts.requires.is_empty()));
    for require in parts.requires.iter().filter(|require| !read.contains_key(&require.input)) {
        let name = &hir.inputs[require.input].name;
        if BY_THE_MACHINE.contains(&name.as_str()) || holds && BY_HOLD.contains(&name.as_str()) {
            continue;
        }
        let message = format!("the mission `{}` requires `{name}`, and nothing in it reads it", activity.name);
        findings.push(
            Diagnostic::warning(Code::MissionsUnread, require.span, message)
                .here("required here")
                .help("leave it out: a sensor that nobody needs would abort the mission when it falls silent"),
        );
    }
    findings
}

/// All that a mission reads and does not require, as one finding: its help can be pasted.
fn missing(activity: &Activity, unrequired: &[(&str, Span)], requires_others: bool) -> Option<Diagnostic> {
    if unrequired.is_empty() {
        return None;
    }
    let names: Vec<&str> = unrequired.iter().map(|(name, _)| *name).collect();
    let (reads, old) = (suggest::listed(&names), if names.len() == 1 { "it" } else { "they" });
    let message = format!("the mission `{}` reads {reads} and does not say how old {old} may be", activity.name);
    let entry = format!("{} fresh 5 s, else abort", names.join(", "));
    let help = match requires_others {
        true => format!("add to its `requires {{ … }}`, on a line of its own: `{entry}`"),
        false => format!("say it in the mission: `requires {{ {entry} }}`"),
    };
    let finding = Diagnostic::warning(Code::MissionsUnrequired, activity.span, message).help(help);
    // The places in the mission's own file: those that its calls lead to would fill pages.
    let own = unrequired.iter().filter(|(_, span)| span.file == activity.span.file);
    let shown = if own.clone().count() == 0 { &unrequired[..1] } else { &[] };
    let labels = own.take(PLACES_MAX).chain(shown);
    Some(labels.fold(finding, |finding, (name, span)| finding.label(*span, format!("`{name}` is read here"))))
}

/// The inputs that a mission reads, with all that it calls, and for each the first place where it does.
pub fn read(hir: &Hir, mission: usize) -> BTreeMap<usize, Span> {
    walk(hir, mission).read
}

fn walk(hir: &Hir, mission: usize) -> Walk<'_> {
    let mut walk = Walk { hir, seen: BTreeSet::new(), read: BTreeMap::new(), holds: false };
    walk.activity(mission);
    walk
}

impl Walk<'_> {
    fn note(&mut self, name: &str, span: Span) {
        if let Some(id) = self.hir.inputs.iter().position(|i| i.name == name) {
            self.read.entry(id).or_insert(span);
        }
    }

    pub(super) fn activity(&mut self, id: usize) {
        if !self.seen.insert(id) {
            return;
        }
        let activity = &self.hir.activities[id];
        activity_children(activity, &mut |e| self.expr(e));
        for decl in &activity.decls {
            if let Decl::With(items) = decl {
                self.with(items);
            }
        }
        match &activity.body {
            Body::Sequence(block) => self.block(block),
            Body::Table { behaviors, .. } => behaviors.iter().for_each(|&b| self.activity(b)),
            Body::Amend { .. } => {}
        }
        if let Some((_, block)) = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()) {
            self.block(block);
        }
    }

    fn with(&mut self, items: &[With]) {
        for item in items {
            if let With::Overlay(id, ..) = item {
                self.activity(*id);
            }
        }
    }

    fn expr(&mut self, e: &Expr) {
        if let ExprKind::Input(id, _) = &e.kind {
            self.read.entry(*id).or_insert(e.span);
        }
        // Functions read no inputs, and signals of a module are written out where they are used.
        children(e, &mut |child| self.expr(child));
    }

    /// Guidance reads inputs of its own, and calls lead on.
    fn block(&mut self, block: &Block) {
        block.each(&mut |stmt| match &stmt.kind {
            StmtKind::With(items, _) => self.with(items),
            StmtKind::Timed(timed) => match &timed.action {
                Action::Call(id, _) => self.activity(*id),
                Action::Guide(Guide::Goto | Guide::Follow | Guide::Dubins | Guide::Loiter, _) => {
                    self.note("position", stmt.span);
                    self.note("course", stmt.span);
                    self.note("heading", stmt.span);
                }
                Action::Guide(Guide::Hold, _) => {
                    self.holds = true;
                    self.note("heading", stmt.span);
                }
                Action::Guide(Guide::Wait, _) | Action::Watch | Action::Override(_) => {}
                _ => self.note("heading", stmt.span),
            },
            _ => {}
        });
    }
}
