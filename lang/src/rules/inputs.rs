//! Inputs that a mission reads without requiring them: before their first sample they have no value, and nobody has said how old
//! they may be. And what is computed before any sample has come.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{
    Action, Activity, Block, Body, Decl, Expr, ExprKind, Hir, InputPart, Mission, StmtKind, VarKind, With,
};
use crate::source::Span;
use albacore_program::{Guide, Steering, senses};
use albacore_wording::listed;
use std::collections::{BTreeMap, BTreeSet};

/// Inputs that the machine reads without being asked: to go over ground in moving water, and to hold a vertical limit.
const BY_THE_MACHINE: [&str; 4] = [senses::FLOW, senses::DEPTH, senses::ALTITUDE, senses::WATER_DEPTH];

/// Inputs that a `hold` keeps its place by, where they have come; without them it lies still.
const BY_HOLD: [&str; 2] = [senses::POSITION, senses::COURSE];

/// Inputs that are never too old: they tell how things stand with the mission and its vehicle, and that of one not heard from as well.
const NEVER_OLD: [&str; 3] = [senses::CONTROL, senses::ELAPSED, senses::VEHICLE_MODE];

/// So many places are shown where an input is read.
const PLACES_MAX: usize = 3;

struct Walk<'a> {
    hir: &'a Hir,
    seen: BTreeSet<usize>,
    /// For each input that is read the first place where it is.
    read: BTreeMap<usize, Read>,
    /// For each that is recorded the first place where that is said.
    recorded: BTreeMap<usize, Span>,
    /// Whether it holds anywhere.
    holds: bool,
}

/// Where an input is read.
#[derive(Clone, Copy, Default)]
struct Read {
    /// The first where its value is: age and count are known before the first sample, its value is not.
    value: Option<Span>,
    /// The first where a field beside its value is.
    field: Option<Span>,
}

/// Finds the inputs that a mission reads, with all that it calls, and does not require.
pub(super) fn check(hir: &Hir, mission: usize) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let Some(parts) = &activity.mission else { return Vec::new() };
    let mut findings = computed_first(activity, parts);
    let Walk { read, recorded, holds, .. } = walk(hir, mission);
    let known = |input: &usize| NEVER_OLD.contains(&hir.inputs[*input].name.as_str());
    let mut unrequired = Vec::new();
    for (&input, read) in read.iter().filter(|(input, _)| !known(input)) {
        let name = hir.inputs[input].name.as_str();
        match (parts.requires.iter().find(|r| r.input == input), read.value, read.field) {
            (None, Some(span), _) => unrequired.push((name, span)),
            (Some(require), _, Some(span)) if require.at_first.is_some() => findings.push(
                Diagnostic::error(
                    Code::MissionsUnrequired,
                    require.span,
                    format!("`{name}` has a value at first, and what else it tells has none"),
                )
                .label(span, "read here")
                .help("leave `at first` out: the mission then waits for the first sample"),
            ),
            _ => {}
        }
    }
    findings.extend(missing(activity, &unrequired, !parts.requires.is_empty()));
    let is_used = |input| read.contains_key(input) || recorded.contains_key(input);
    for require in parts.requires.iter().filter(|require| !is_used(&require.input)) {
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

/// An entry of `requires` for each input that comes seldom or late, so that a mission which takes it over waits long enough.
const SELDOM: [(&str, &str); 2] = [
    (senses::BATTERY, "battery fresh 1 min, else abort"),
    (senses::FLOW, "flow fresh 30 s, at first 0 m/s toward north, else abort"),
];

/// Entries of `requires` for inputs, which can be pasted.
fn entries(names: &[&str]) -> Vec<String> {
    let (seldom, often): (Vec<&str>, Vec<&str>) =
        names.iter().partition(|name| SELDOM.iter().any(|(seldom, _)| seldom == *name));
    let together = (!often.is_empty()).then(|| format!("{} fresh 5 s, else abort", often.join(", ")));
    let own = SELDOM.iter().filter(|(name, _)| seldom.contains(name)).map(|(_, entry)| (*entry).to_string());
    together.into_iter().chain(own).collect()
}

/// All that a mission reads and does not require, as one finding: its help can be pasted.
fn missing(activity: &Activity, unrequired: &[(&str, Span)], requires_others: bool) -> Option<Diagnostic> {
    if unrequired.is_empty() {
        return None;
    }
    let names: Vec<&str> = unrequired.iter().map(|(name, _)| *name).collect();
    let (reads, them) = (listed(&names), if names.len() == 1 { "it" } else { "them" });
    let message = format!("the mission `{}` reads {reads} and does not require {them}", activity.name);
    let help = match (requires_others, entries(&names).as_slice()) {
        (true, [entry]) => format!("add to its `requires {{ … }}`, on a line of its own: `{entry}`"),
        (false, [entry]) => format!("say it in the mission: `requires {{ {entry} }}`"),
        (true, several) => {
            format!("add to its `requires {{ … }}`, each on a line of its own: {}", listed(several))
        }
        (false, several) => {
            format!("give the mission `requires {{ … }}`, in it, each on a line of its own: {}", listed(several))
        }
    };
    let finding = Diagnostic::error(Code::MissionsUnrequired, activity.span, message).help(help);
    // The places in the mission's own file: those that its calls lead to would fill pages.
    let own = unrequired.iter().filter(|(_, span)| span.file == activity.span.file);
    let shown = if own.clone().count() == 0 { &unrequired[..1] } else { &[] };
    let labels = own.take(PLACES_MAX).chain(shown);
    Some(labels.fold(finding, |finding, (name, span)| finding.label(*span, format!("`{name}` is read here"))))
}

/// The inputs whose values a mission reads, with all that it calls, and for each the first place where it does.
pub fn read(hir: &Hir, mission: usize) -> BTreeMap<usize, Span> {
    walk(hir, mission).read.into_iter().filter_map(|(input, read)| Some((input, read.value?))).collect()
}

/// The inputs that a mission records, with all that it calls, and for each the first place where it says so.
pub fn recorded(hir: &Hir, mission: usize) -> BTreeMap<usize, Span> {
    walk(hir, mission).recorded
}

fn walk(hir: &Hir, mission: usize) -> Walk<'_> {
    let mut walk = Walk { hir, seen: BTreeSet::new(), read: BTreeMap::new(), recorded: BTreeMap::new(), holds: false };
    walk.activity(mission);
    walk
}

/// What is computed while the first samples are awaited: it can be made of constants and of parameters alone.
fn computed_first(activity: &Activity, parts: &Mission) -> Vec<Diagnostic> {
    let is_sensed = |e: &Expr| match e.kind {
        ExprKind::Input(..) => true,
        ExprKind::Var(id) => activity.vars.get(id).is_some_and(|v| v.kind != VarKind::Param),
        _ => false,
    };
    let mut found = Vec::new();
    let requires = parts.requires.iter();
    let numbers = requires.flat_map(|r| [Some(&r.fresh), r.at_first.as_ref(), r.hold_for.as_ref()]).flatten();
    for number in numbers.chain(&parts.within) {
        number.visit(&mut |e| {
            found.extend(is_sensed(e).then_some(e.span));
            !is_sensed(e)
        });
    }
    // An entry for several inputs is written once.
    found.sort();
    found.dedup();
    let told = found.into_iter().map(|span| {
        Diagnostic::error(Code::MissionsRequires, span, "this is computed before the mission has sensed anything")
            .here("it has no value yet")
            .help("use constants and parameters of the mission here")
    });
    told.collect()
}

impl Walk<'_> {
    /// What guidance reads by itself.
    fn note(&mut self, name: &str, span: Span) {
        if let Some(id) = self.hir.inputs.iter().position(|i| i.name == name) {
            self.reads(id, &InputPart::Value, span);
        }
    }

    fn reads(&mut self, input: usize, part: &InputPart, span: Span) {
        let read = self.read.entry(input).or_default();
        match part {
            InputPart::Value | InputPart::Peak => _ = read.value.get_or_insert(span),
            InputPart::Field(_) => {
                read.value.get_or_insert(span);
                read.field.get_or_insert(span);
            }
            InputPart::Age | InputPart::IsNew | InputPart::Hits(..) => {}
        }
    }

    pub(super) fn activity(&mut self, id: usize) {
        if !self.seen.insert(id) {
            return;
        }
        let activity = &self.hir.activities[id];
        // Functions read no inputs, and signals of a module are written out where they are used.
        activity.visit(&mut |e| {
            if let ExprKind::Input(id, part) = &e.kind {
                self.reads(*id, part, e.span);
            }
            true
        });
        for (input, span) in activity.recordings.iter().flat_map(|recording| &recording.inputs) {
            self.recorded.entry(*input).or_insert(*span);
        }
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

    /// Guidance reads inputs of its own, and calls lead on.
    fn block(&mut self, block: &Block) {
        block.each(&mut |stmt| match &stmt.kind {
            StmtKind::With(items, _) => self.with(items),
            StmtKind::Timed(timed) => match &timed.action {
                Action::Call(id, _) => self.activity(*id),
                Action::Guide(guide, _) => {
                    self.holds |= matches!(guide.law().steering, Steering::Station);
                    self.guidance(*guide, stmt.span);
                }
                Action::Keep(..) => self.guidance(Guide::Keep, stmt.span),
                Action::Watch | Action::Override(_) | Action::Ask(..) => {}
            },
            _ => {}
        });
    }

    fn guidance(&mut self, guide: Guide, span: Span) {
        guide.law().inputs.iter().for_each(|input| self.note(input, span));
    }
}
