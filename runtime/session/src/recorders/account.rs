//! What a mission did with its time: how long each behavior was active and how far the vehicle went meanwhile, how often an input that is
//! required was too old, and what its strategies came to.

use crate::reported::Reader;
use crate::summary::{BehaviorSummary, Finished};
use albacore_machine::Event;
use albacore_program::{Activity, ActivityId, ActivityKind, Cause, Program, Shape, number};
use albacore_trace::{Active, TickRecord};
use albacore_vehicle::seconds;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The names under which an account is kept: of behaviors, strategies and the recovery, each once, in the order of the program.
pub(crate) fn behavior_names(program: &Program) -> Vec<&str> {
    let mut known = BTreeSet::new();
    let names =
        program.activities.iter().filter(|activity| is_behavior(activity)).map(|activity| activity.name.as_str());
    names.filter(|name| known.insert(*name)).collect()
}

fn is_behavior(activity: &Activity) -> bool {
    matches!(activity.kind, ActivityKind::Behavior | ActivityKind::Strategy | ActivityKind::Recovery)
}

/// What was spent in the behaviors of a name.
#[derive(Clone, Default)]
struct Spent {
    entered: u64,
    ticks: u64,
    metres: f64,
    /// The tick that was counted last: one that calls another of its name is active once.
    counted: Option<u64>,
}

/// Keeps the account.
pub(crate) struct Account {
    program: Arc<Program>,
    active: Active,
    /// What was spent in each behavior.
    spent: Vec<Spent>,
    /// For each activity where its behavior is among those.
    places: Vec<Option<usize>>,
    /// How many of the required inputs are too old, and the link among them.
    late: u64,
    holds: u64,
    /// The words of what is about to be left.
    result: Option<(ActivityId, Vec<f64>)>,
    finished: Option<Finished>,
}

impl Account {
    pub fn new(program: &Arc<Program>) -> Self {
        let names = behavior_names(program);
        let known: BTreeMap<&str, usize> = names.iter().copied().zip(0..).collect();
        let place = |activity: &Activity| known.get(activity.name.as_str()).copied().filter(|_| is_behavior(activity));
        Account {
            places: program.activities.iter().map(place).collect(),
            spent: vec![Spent::default(); names.len()],
            program: Arc::clone(program),
            active: Active::default(),
            late: 0,
            holds: 0,
            result: None,
            finished: None,
        }
    }

    /// How often the mission was held because an input was too old, or the link too slow.
    pub fn holds(&self) -> u64 {
        self.holds
    }

    /// What the last strategy, or behavior with a result, came to that was in no other.
    pub fn finished(&self) -> Option<&Finished> {
        self.finished.as_ref()
    }

    /// The behaviors that were entered.
    pub fn behaviors(&self) -> Vec<BehaviorSummary> {
        let spent = behavior_names(&self.program).into_iter().zip(&self.spent);
        let summary = |(name, spent): (&str, &Spent)| BehaviorSummary {
            name: name.to_string(),
            entered: spent.entered,
            time_s: seconds(spent.ticks),
            path_length_m: spent.metres,
        };
        spent.map(summary).filter(|behavior| behavior.entered > 0).collect()
    }

    /// Takes in a step on which the vehicle went so far, m.
    pub fn take(&mut self, record: &TickRecord, way: f64) {
        for event in &record.events {
            match event {
                Event::Entered(id) => {
                    if let Some(spent) = self.place(*id) {
                        spent.entered += 1;
                    }
                }
                Event::Finished(id, words) => self.result = Some((*id, words.clone())),
                Event::Left(id, cause) => self.leave(*id, *cause),
                Event::Stale(_) | Event::Lagging(..) => {
                    self.holds += u64::from(self.late == 0);
                    self.late += 1;
                }
                Event::Fresh(_) | Event::LaggingEnded => self.late = self.late.saturating_sub(1),
                _ => {}
            }
            self.active.follow(event, &self.program);
        }
        for id in &record.active {
            if let Some(spent) = self.place(*id)
                && spent.counted.replace(record.tick) != Some(record.tick)
            {
                spent.ticks += 1;
                spent.metres += way;
            }
        }
    }

    /// What happened meanwhile is not known.
    pub fn lose(&mut self) {
        self.active = Active::default();
    }

    fn place(&mut self, id: ActivityId) -> Option<&mut Spent> {
        let place = self.places.get(id as usize).copied().flatten()?;
        self.spent.get_mut(place)
    }

    fn leave(&mut self, id: ActivityId, cause: Cause) {
        let result = self.result.take().filter(|(of, _)| *of == id);
        let Some(activity) = self.program.activities.get(id as usize) else { return };
        // What is in another that tells is a part of that.
        let around = &self.active.chain()[..self.active.depth(id)];
        let is_part = around.iter().filter_map(|id| self.program.activities.get(*id as usize)).any(tells);
        if !tells(activity) || is_part {
            return;
        }
        let reader = Reader { program: &self.program, frame: None };
        let value = activity.result.as_ref().zip(result).map(|(of, (_, words))| {
            let value = reader.json(&of.shape, &words);
            (word(&self.program, &of.shape, &words, &value), value)
        });
        let end = match cause {
            Cause::Done => "done",
            Cause::TimedOut => "timed_out",
            Cause::Aborted => "aborted",
            _ => "cut",
        };
        let (word, value) = value.unwrap_or_else(|| (end.to_string(), serde_json::Value::Null));
        self.finished = Some(Finished { of: activity.name.clone(), end, value, word });
    }
}

/// Whether what an activity comes to is told: of a strategy, and of a behavior with a result.
fn tells(activity: &Activity) -> bool {
    activity.kind == ActivityKind::Strategy || is_behavior(activity) && activity.result.is_some()
}

/// A result in one word: `none`, a number, a word; of what holds more, what it is.
fn word(program: &Program, shape: &Shape, words: &[f64], value: &serde_json::Value) -> String {
    // A quantity is a number in the unit that its value has.
    if let Some(number) = value.get("value").and_then(serde_json::Value::as_f64) {
        return number::digits(number);
    }
    match shape {
        Shape::Optional(_) if words.first() != Some(&1.0) => "none".to_string(),
        Shape::Optional(shape) => word(program, shape, words.get(1..).unwrap_or_default(), value),
        Shape::Quantity(_) => number::digits(value.as_f64().unwrap_or(f64::NAN)),
        Shape::Point => "place".to_string(),
        Shape::Vector(_) => "vector".to_string(),
        Shape::Line | Shape::Edge => "line".to_string(),
        Shape::Area(_) => "area".to_string(),
        Shape::List(..) => "list".to_string(),
        Shape::Map(..) => "map".to_string(),
        Shape::Record(name, _) => name.clone(),
        _ => number::within_text(&program.texts, shape, words),
    }
}
