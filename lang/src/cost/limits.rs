//! What a mission may cost at most. A program beyond these limits is refused with the part of the bill that is dearest, before
//! anything large is laid out.

use super::work::{self, Tally};
use super::{Parts, grouped, memory};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::Hir;
use crate::lower::Lowered;
use crate::source::{Sources, Span};
use crate::types::TypeTable;

/// The steps of a tick. Some tens of milliseconds on the small computer of a vehicle, of the 100 that a tick has.
pub const STEPS_MAX: u64 = 1_000_000;
/// The instructions of a mission.
pub const INSTRUCTIONS_MAX: usize = 1_000_000;
/// The numbers that a mission keeps.
pub const WORDS_MAX: u32 = 4_000_000;

/// Of the bill so many lines are shown.
const SHOWN: usize = 3;
/// And of them those that make up this share of it.
const SHARE: u64 = 4;

/// The finding for a mission that has ticks of too many steps.
pub(crate) fn steps(hir: &Hir, types: &TypeTable, sources: &Sources, mission: usize) -> Option<Diagnostic> {
    let tally = work::of_mission(hir, types, sources, mission);
    let steps = tally.bill.total();
    let activity = &hir.activities[mission];
    let finding = exceeded(&format!("a tick of the mission `{}`", activity.name), activity.span, steps)?;
    Some(with_bill(finding, hir, &tally, steps))
}

/// The same for a scenario, which is computed once.
pub(crate) fn scenario_steps(hir: &Hir, types: &TypeTable, scenario: usize) -> Option<Diagnostic> {
    let tally = work::of_scenario(hir, types, scenario);
    let scenario = &hir.scenarios[scenario];
    let finding = exceeded(&format!("the scenario `{}`", scenario.name), scenario.span, tally.apart)?;
    Some(with_bill(finding, hir, &tally, tally.apart))
}

/// The same for what a test expects, which may be looked at on every tick.
pub(crate) fn test_steps(hir: &Hir, types: &TypeTable, test: usize) -> Option<Diagnostic> {
    let tally = work::of_test(hir, types, test);
    let test = &hir.tests[test];
    let finding = exceeded("what this test expects", test.span, tally.apart)?;
    Some(with_bill(finding, hir, &tally, tally.apart))
}

fn exceeded(what: &str, span: Span, steps: u64) -> Option<Diagnostic> {
    (steps > STEPS_MAX).then(|| {
        let message = format!("{what} may take {} steps, more than {}", counted(steps), grouped(STEPS_MAX));
        Diagnostic::error(Code::LimitsSteps, span, message)
    })
}

/// Points at what is dearest: loops that go round at once, functions, and without either the activities.
fn with_bill(mut finding: Diagnostic, hir: &Hir, tally: &Tally, whole: u64) -> Diagnostic {
    let dear = |steps: u64| steps >= whole.min(STEPS_MAX) / SHARE;
    let loops = tally.loops.iter().filter(|round| dear(round.steps)).take(SHOWN);
    let functions = tally.functions.iter().filter(|(_, steps)| dear(*steps)).take(SHOWN);
    let mut lines: Vec<(Span, String)> = Vec::new();
    for round in loops {
        let (rounds, each) = (grouped(round.rounds), counted(round.steps / round.rounds.max(1)));
        lines.push((round.span, format!("{rounds} rounds in one tick, each of {each} steps")));
    }
    for (id, steps) in functions {
        lines.push((hir.fns[*id].span, format!("{} steps each time that it is called", counted(*steps))));
    }
    if lines.is_empty() {
        let mut shares: Vec<(usize, u64)> = tally.bill.shares().collect();
        shares.sort_by_key(|(id, steps)| (std::cmp::Reverse(*steps), *id));
        for (id, steps) in shares.into_iter().take(SHOWN) {
            lines.push((hir.activities[id].span, format!("{} of the steps", counted(steps))));
        }
    }
    let own = finding.span();
    for (span, line) in lines {
        finding = if span == own { finding.here(line) } else { finding.label(span, line) };
    }
    finding.help("do less at once: shorter lists and ranges, fewer calls, or `wait for 1 s` in a loop; `albacore check --cost` shows the bill")
}

/// The findings for a mission that is too large to be held.
pub(crate) fn size(hir: &Hir, sources: &Sources, mission: usize, lowered: &Lowered) -> Vec<Diagnostic> {
    let activity = &hir.activities[mission];
    let what = "the mission";
    let mut findings = Vec::new();
    if lowered.words > u64::from(WORDS_MAX) {
        let bill = memory::of_mission(hir, sources, mission, lowered);
        let dear = bill
            .held
            .iter()
            .filter(|held| held.span != activity.span && held.bytes >= bill.bytes / (2 * SHARE))
            .take(SHOWN);
        let finding =
            dear.fold(too_much_memory(activity.span, what, &activity.name, lowered.words), |finding, held| {
                let times =
                    if held.places > 1 { format!(" in {} places", counted(held.places)) } else { String::new() };
                finding.label(held.span, format!("{} of them{times}", millions(held.bytes / memory::WORD)))
            });
        findings.push(finding);
    }
    if lowered.instructions > INSTRUCTIONS_MAX as u64 {
        let finding = too_much_code(activity.span, what, &activity.name, lowered.instructions);
        let parts = Parts::of_code(hir, sources, lowered);
        let others = parts.0.iter().filter(|part| part.span != activity.span);
        let dear = others.filter(|part| part.steps >= lowered.instructions / (2 * SHARE)).take(SHOWN);
        findings.push(
            dear.fold(finding, |finding, part| finding.label(part.span, format!("{} of them", grouped(part.steps)))),
        );
    }
    findings
}

/// The same for what is computed apart from missions.
pub(crate) fn of_values(span: Span, what: &str, name: &str, words: u64, instructions: u64) -> Option<Diagnostic> {
    if words > u64::from(WORDS_MAX) {
        return Some(too_much_memory(span, what, name, words));
    }
    (instructions > INSTRUCTIONS_MAX as u64).then(|| too_much_code(span, what, name, instructions))
}

fn too_much_memory(span: Span, what: &str, name: &str, words: u64) -> Diagnostic {
    Diagnostic::error(Code::LimitsMemory, span, format!("{what} `{name}` needs too much memory"))
        .here(format!("{} numbers, more than {}", millions(words), millions(u64::from(WORDS_MAX))))
        .help("make its lists shorter, or call fewer behaviors from one another")
}

fn too_much_code(span: Span, what: &str, name: &str, instructions: u64) -> Diagnostic {
    Diagnostic::error(Code::LimitsInstructions, span, format!("{what} `{name}` has too many instructions"))
        .here(format!("{}, more than {}", counted(instructions), grouped(INSTRUCTIONS_MAX as u64)))
        .help("make a part of it a function, or a behavior, that is written once and called")
}

fn millions(n: u64) -> String {
    if n == u64::MAX { "countless".to_string() } else { format!("{:.1} million", n as f64 / 1e6) }
}

/// A sum that may have left the numbers.
fn counted(n: u64) -> String {
    if n == u64::MAX { "countless".to_string() } else { grouped(n) }
}
