//! The lines of the trace, each with its tick, and of a switch why it was.

use crate::plan::Plan;
use crate::recorders::missed;
use crate::why::Decision;
use albacore_machine::Event;
use albacore_program::seen::one_line;
use albacore_program::{ActivityId, Body, Entry, Program, Target, number};
use albacore_trace::{BehaviorTrace, Header, Step, TickRecord, TriedCondition};
use albacore_vehicle::TICK_S;
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Lines that a page has; beyond these only switches and what holds, ends or reports.
const LINES_MAX: usize = 20_000;
/// ... and not many more of those.
const LINES_END: usize = 60_000;
/// A longer line is nobody's to read on a page.
const LETTERS_MAX: usize = 400;

/// A line of the trace.
#[derive(Clone, Debug, Serialize)]
pub struct Happening {
    /// Its tick.
    pub tick: u64,
    /// Its verb: `switch`, `report`, `limit`.
    pub verb: String,
    /// What it says.
    pub text: String,
    /// Of a switch, why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<Why>,
}

/// Why a rule fired, or a mission was aborted.
#[derive(Clone, Debug, Serialize)]
pub struct Why {
    /// The rule as it is written.
    pub rule: String,
    /// Where, `file:line`.
    pub place: String,
    /// The values that its guard looked at, by name.
    pub values: Vec<(String, String)>,
    /// The conditions that were tried in this tick, in their order: whether each held, and which of its terms.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tried: Vec<String>,
    /// The strategy, the behavior that was left and the one that was entered, by their places in the diagram.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge: Option<(usize, usize, usize)>,
}

/// Gathers the lines.
pub(super) struct HappeningFold {
    program: Arc<Program>,
    trace: BehaviorTrace,
    /// Where each behavior stands: its strategy, and its place in the table.
    seats: BTreeMap<ActivityId, (ActivityId, usize)>,
    lines: Vec<Happening>,
    left_out: u64,
}

impl HappeningFold {
    pub fn new(plan: &Plan, seed: u64) -> Self {
        let program = Arc::clone(&plan.program);
        let mut seats = BTreeMap::new();
        for (strategy, activity) in (0..).zip(&program.activities) {
            if let Body::Table(table) = &activity.body {
                seats.extend(table.behaviors.iter().enumerate().map(|(at, entry)| (entry.activity, (strategy, at))));
            }
        }
        let (mission, scenario) = (program.mission.name.clone(), plan.scenario_name.clone());
        let header = Header { mission, scenario, seed, tick_s: TICK_S };
        let trace = BehaviorTrace::new(&program, &header).with_samples_every(0);
        HappeningFold { program, trace, seats, lines: Vec::new(), left_out: 0 }
    }

    /// Takes in a step. `name` gives a strategy its index.
    pub fn take(&mut self, record: &TickRecord, name: &mut impl FnMut(ActivityId) -> usize) {
        let before = self.trace.len();
        if let Step::End(ending) = &record.step {
            if !record.events.is_empty() {
                self.trace.tick(record.tick, record.believed, &record.events);
            }
            record.notices.iter().for_each(|notice| self.trace.vehicle(record.tick, notice));
            self.trace.finish(ending.outcome, ending.release, record.tick, ending.digest);
        } else {
            record.notices.iter().for_each(|notice| self.trace.vehicle(record.tick, notice));
            if matches!(record.step, Step::Tick) {
                self.trace.tick(record.tick, record.believed, &record.events);
            }
        }
        self.tell(before, record.tick, &record.events, name);
    }

    pub fn miss(&mut self, steps: u64, tick: u64) {
        let before = self.trace.len();
        self.trace.vehicle(tick, &missed(steps));
        self.tell(before, tick, &[], &mut |_| 0);
    }

    /// How many lines there are.
    pub fn count(&self) -> usize {
        self.lines.len()
    }

    /// The lines after the first so many, and how many were left out in all.
    pub fn since(&self, known: usize) -> (Vec<Happening>, u64) {
        (self.lines.iter().skip(known).cloned().collect(), self.left_out)
    }

    pub fn finish(self) -> (Vec<Happening>, u64) {
        (self.lines, self.left_out)
    }

    /// Takes over the lines that have come to the trace.
    fn tell(&mut self, before: usize, tick: u64, events: &[Event], name: &mut impl FnMut(ActivityId) -> usize) {
        let mut switches = events.iter().filter(|event| matches!(event, Event::Switched { .. }));
        let mut aborts = events.iter().filter(|event| matches!(event, Event::Aborted(_)));
        let told: Vec<(String, String)> = self.trace.since(before).filter_map(parted).collect();
        for (verb, text) in told {
            let why = match verb.as_str() {
                "switch" => switches.next().and_then(|event| self.why(event, name)),
                "abort" => aborts.next().and_then(|event| self.why_aborted(event)),
                _ => None,
            };
            let is_detail = matches!(verb.as_str(), "begin" | "enter" | "leave" | "amend" | "log" | "memory" | "limit");
            if self.lines.len() < LINES_MAX || (!is_detail && self.lines.len() < LINES_END) {
                self.lines.push(Happening { tick, verb, text, why });
            } else {
                self.left_out += 1;
            }
        }
    }

    fn entry(&self, behavior: ActivityId) -> Option<&Entry> {
        let (strategy, at) = self.seats.get(&behavior)?;
        match &self.program.activities.get(*strategy as usize)?.body {
            Body::Table(table) => table.behaviors.get(*at),
            _ => None,
        }
    }

    /// Why a rule fired: the rule as it is written, and the values that the trace prints of its guard.
    fn why(&self, event: &Event, name: &mut impl FnMut(ActivityId) -> usize) -> Option<Why> {
        let Event::Switched { rule, from, exit, values } = event else { return None };
        let rule = self.program.rules.get(*rule as usize)?;
        let exit = self.entry(*from).and_then(|entry| entry.exits.get(*exit as usize));
        let mut rest = values.as_slice();
        let mut told = Vec::new();
        for watched in exit.map_or(&[][..], |exit| &exit.watched) {
            let (words, after) = rest.split_at((watched.shape.words() as usize).min(rest.len()));
            rest = after;
            told.push((
                one_line(&watched.name),
                one_line(&number::value_with(&self.program.texts, &watched.shape, words)),
            ));
        }
        let edge = match (rule.target, self.seats.get(from)) {
            (Target::Behavior(to), Some((strategy, at))) => Some((name(*strategy), *at, to as usize)),
            _ => None,
        };
        let left = self.program.activities.get(*from as usize).map_or("?", |activity| &activity.name);
        let rule_text = one_line(&format!("{left} {}", rule.text));
        Some(Why { rule: rule_text, place: one_line(&rule.place), values: told, tried: Vec::new(), edge })
    }

    /// The `abort` of the script that says the same, if one does.
    fn why_aborted(&self, event: &Event) -> Option<Why> {
        let Event::Aborted(why) = event else { return None };
        let says_so = |text: &u32| {
            let text = self.program.texts.get(*text as usize).and_then(albacore_program::Text::plain);
            text.as_ref() == Some(why)
        };
        let mut aborts = self.program.activities.iter().flat_map(|activity| &activity.aborts);
        let abort = aborts.find(|abort| says_so(&abort.why))?;
        let rule = format!("abort \"{why}\" on {}", abort.text);
        Some(Why {
            rule: one_line(&rule),
            place: one_line(&abort.place),
            values: Vec::new(),
            tried: Vec::new(),
            edge: None,
        })
    }
}

/// Adds to each switch and abort the conditions that were tried in its tick.
pub(super) fn add_tried(happenings: &mut [Happening], decisions: &[Decision]) {
    for decision in decisions {
        let lines = || decision.conditions.iter().flat_map(TriedCondition::terms_alone);
        let tried: Vec<String> = lines().map(|line| one_line(&line).chars().take(LETTERS_MAX).collect()).collect();
        let first = happenings.partition_point(|happening| happening.tick < decision.tick);
        let same_tick = happenings[first..].iter_mut().take_while(|happening| happening.tick == decision.tick);
        same_tick.filter_map(|happening| happening.why.as_mut()).for_each(|why| why.tried.clone_from(&tried));
    }
}

/// The verb of a line of the trace, and what it says; none of a line that has no time.
fn parted(line: &str) -> Option<(String, String)> {
    let (time, rest) = line.split_once(" s  ")?;
    time.trim().parse::<f64>().ok()?;
    let (verb, text) = rest.split_once("  ").unwrap_or((rest, ""));
    let mut text = text.trim().to_string();
    if text.chars().count() > LETTERS_MAX {
        text = text.chars().take(LETTERS_MAX).chain(['…']).collect();
    }
    Some((verb.trim().to_string(), text))
}
