//! Why a run did what it did: the conditions that decided, with what they were made of, at the ticks of its journal.

use crate::plan::{Plan, PlanError};
use crate::recorders::Recorder;
use crate::recorders::trace::Trace;
use crate::replay::{Replay, ReplayedStep};
use albacore_machine::{Machine, Phase};
use albacore_program::number;
use albacore_trace::journal::{Ending, Reader};
use albacore_trace::{Step, TriedCondition, is_decision};
use albacore_vehicle::{COMMANDED, Command, TICK_S};
use serde::Serialize;
use std::ops::RangeInclusive;

/// What a run decided, and why.
#[derive(Debug, Serialize)]
pub struct Explanation {
    /// The ticks in which something was decided, of those that were asked for.
    pub decisions: Vec<Decision>,
    /// How things were at the first tick that was asked for.
    pub moment: Option<Moment>,
    /// The line of the decision before those ticks.
    pub before: Option<String>,
    /// The line of the first decision after them.
    pub after: Option<String>,
    /// How many ticks the journal holds.
    pub ticks: u64,
    /// The first tick in which its scripts do not do what it says: what is told from there on is not of the run.
    pub differs_at: Option<u64>,
    /// How it ends.
    #[serde(rename = "journal", serialize_with = "crate::replay::as_text")]
    pub ending: Ending,
}

/// A tick in which something was decided.
#[derive(Debug, Serialize)]
pub struct Decision {
    /// The tick.
    pub tick: u64,
    /// What the trace says of it.
    pub lines: Vec<String>,
    /// The conditions that were tried in it, in their order: those that held are why.
    pub conditions: Vec<TriedCondition>,
    /// What was known of the inputs that they read, or that was too old.
    pub inputs: Vec<InputAge>,
}

/// How things were in a tick.
#[derive(Debug, Serialize)]
pub struct Moment {
    /// The tick.
    pub tick: u64,
    /// What was active, from outside in, and the statement that was under way.
    pub under_way: Vec<String>,
    /// Whether the mission was held: something that it requires was too old.
    pub held: bool,
    /// What was commanded.
    pub command: Option<String>,
    /// The conditions that were tried in it, in their order.
    pub conditions: Vec<TriedCondition>,
    /// What was known of each input.
    pub inputs: Vec<InputAge>,
}

/// What was known of an input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputAge {
    /// Its name.
    pub name: String,
    /// Its latest value.
    pub value: Option<String>,
    /// How old that was, s.
    pub age_s: Option<f64>,
    /// How old it may be, s, where the mission requires it.
    pub fresh_s: Option<f64>,
}

/// Explains some ticks of a run, or all that was decided in it.
pub fn explain(journal: Reader<'_>, plan: &Plan, ticks: Option<RangeInclusive<u64>>) -> Result<Explanation, PlanError> {
    let asked = ticks.clone().unwrap_or(0..=u64::MAX);
    let header = journal.header().clone();
    let mut replay = Replay::new(journal, plan, plan)?.asking(asked.clone());
    let mut trace = Trace::new(plan, header.seed, &header.measurements);
    let (mut decisions, mut moment, mut before, mut after, mut count) = (Vec::new(), None, None, None, 0);
    let mut differs_at = None;
    while let Some(step) = replay.next() {
        let ReplayedStep { mut record, command, events, tried, .. } = step;
        if matches!(record.step, Step::Wait) {
            continue;
        }
        let is_tick = matches!(record.step, Step::Tick);
        count += u64::from(is_tick);
        if events != record.events || (is_tick && command != record.command) {
            differs_at.get_or_insert(record.tick);
        }
        let known = trace.lines().len();
        record.believed = replay.machine().position();
        trace.take(&record);
        let lines = trace.lines().since(known).filter(|line| is_decision(line)).map(|line| line.trim().to_string());
        let lines: Vec<String> = lines.collect();
        if record.tick < *asked.start() {
            before = lines.last().cloned().or(before);
            continue;
        }
        if record.tick > *asked.end() {
            after = lines.into_iter().next();
            if after.is_some() {
                break;
            }
            continue;
        }
        let conditions = trace.lines().tried(&tried);
        let inputs = inputs(replay.machine());
        if moment.is_none() && ticks.is_some() && is_tick {
            let (under_way, command) = (trace.lines().under_way(), command.map(|command| told(&command, 0)));
            let (conditions, inputs) = (conditions.clone(), inputs.clone());
            let held = matches!(replay.machine().state().phase, Phase::Holding(_));
            moment = Some(Moment { tick: record.tick, under_way, held, command, conditions, inputs });
        }
        if !lines.is_empty() {
            let inputs = inputs.into_iter().filter(|input| is_read(input, &conditions) || input.is_stale()).collect();
            decisions.push(Decision { tick: record.tick, lines, conditions, inputs });
        }
    }
    let ending = replay.into_ending();
    Ok(Explanation { decisions, moment, before, after, ticks: count, differs_at, ending })
}

impl InputAge {
    /// Whether it was too old.
    pub fn is_stale(&self) -> bool {
        self.age_s.zip(self.fresh_s).is_some_and(|(age, fresh)| age > fresh)
    }
}

/// What is known of each input.
fn inputs(machine: &Machine) -> Vec<InputAge> {
    let p = machine.program();
    let seconds = |ticks: f64| ticks * TICK_S;
    let told = machine.heard().filter_map(|heard| {
        let input = p.inputs.get(heard.at)?;
        Some(InputAge {
            name: input.name.clone(),
            value: heard.age.map(|_| number::value_with(&p.texts, &input.shape, heard.words)),
            age_s: heard.age.map(seconds),
            fresh_s: heard.fresh.map(seconds),
        })
    });
    told.collect()
}

/// Whether a condition that held names an input.
fn is_read(input: &InputAge, conditions: &[TriedCondition]) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let names = |values: &str| values.split(|c: char| !is_word(c)).any(|word| word == input.name);
    conditions.iter().filter(|condition| condition.holds).any(|condition| names(&condition.values))
}

/// A command in words, with so many digits more than usual.
pub(crate) fn told(command: &Command, more: u8) -> String {
    let said = COMMANDED.iter().filter_map(|part| {
        let (before, after) = part.said;
        Some(format!("{before}{}{after}", number::fixed((part.value)(command)?, part.digits + more)))
    });
    said.collect::<Vec<_>>().join(", ")
}
