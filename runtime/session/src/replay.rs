//! A run once more: a machine is fed with what a journal has of the vehicle, and held against what it did then.

use crate::plan::{Plan, PlanError};
use crate::recorders::Recorder;
use crate::recorders::digest::RunDigest;
use albacore_machine::{Event, Machine, Outcome, Tried};
use albacore_program::Program;
use albacore_trace::journal::{Ending, Entry, Gap, JournalHeader, Reader};
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::Command;
use serde::{Serialize, Serializer};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Feeds a machine with what a journal holds.
pub struct Replay<'a> {
    reader: Reader<'a>,
    machine: Machine,
    /// The machine is not the journal's: from its checkpoints it cannot go on.
    is_changed: bool,
    /// The ticks of which is asked why.
    asked: Option<RangeInclusive<u64>>,
    /// A gap that the machine could not go on behind.
    stopped_at: Option<Gap>,
}

/// A step of the journal, and what the machine did in it.
pub struct ReplayedStep {
    /// The step as it was.
    pub record: Box<TickRecord>,
    /// What the machine commanded.
    pub command: Option<Command>,
    /// What happened in it.
    pub events: Vec<Event>,
    /// The conditions that were tried, in the ticks that were asked for.
    pub tried: Vec<Tried>,
    /// The machine's mission was over before this step: nothing of it is replayed.
    pub is_beyond: bool,
}

impl<'a> Replay<'a> {
    /// Begins with the first tick. `original` is the plan as it was run, `plan` the one that is replayed.
    pub fn new(reader: Reader<'a>, original: &Plan, plan: &Plan) -> Result<Self, PlanError> {
        let machine = Machine::new(Arc::clone(&plan.program), &reader.header().measurements)
            .map_err(|missing| PlanError::Asked(missing.to_string(), None))?
            .with_chart(plan.chart());
        let is_changed = original.program != plan.program;
        Ok(Replay { reader, machine, is_changed, asked: None, stopped_at: None })
    }

    /// The same, with the conditions that are tried in some ticks.
    pub fn asking(self, ticks: RangeInclusive<u64>) -> Self {
        Replay { asked: Some(ticks), ..self }
    }

    /// What was run.
    pub fn header(&self) -> &JournalHeader {
        self.reader.header()
    }

    /// The program that is replayed.
    pub fn program(&self) -> &Arc<Program> {
        self.machine.program()
    }

    /// The machine, as it is after the last step.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Ticks that are not in the journal, at which a changed mission cannot go on.
    pub fn stopped_at(&self) -> Option<&Gap> {
        self.stopped_at.as_ref()
    }

    /// How the journal ends; reads on to there.
    pub fn into_ending(self) -> Ending {
        self.reader.into_ending()
    }

    fn replayed(&mut self, record: Box<TickRecord>) -> ReplayedStep {
        let is_beyond = self.machine.outcome().is_some();
        let mut step = ReplayedStep { record, command: None, events: Vec::new(), tried: Vec::new(), is_beyond };
        match &step.record.step {
            Step::Wait => {}
            Step::Tick if is_beyond => {}
            Step::Tick => {
                let snapshot = &step.record.snapshot;
                if self.asked.as_ref().is_some_and(|asked| asked.contains(&step.record.tick)) {
                    (step.command, step.tried) = self.machine.step_asked(snapshot);
                } else {
                    step.command = self.machine.step(snapshot);
                }
                step.events.extend_from_slice(self.machine.events());
            }
            Step::End(ending) => {
                // From outside, or since it lay on the bottom when it was given back. A mission that was changed may go on beyond the
                // end to which the run's own came.
                if !is_beyond && !step.record.events.is_empty() {
                    step.events.extend_from_slice(self.machine.end(ending.outcome));
                }
                if ending.outcome == Outcome::Aground && self.machine.end_aground().is_some() {
                    step.events.extend_from_slice(self.machine.events());
                }
            }
        }
        step
    }
}

impl Iterator for Replay<'_> {
    type Item = ReplayedStep;

    fn next(&mut self) -> Option<ReplayedStep> {
        while self.stopped_at.is_none() {
            match self.reader.next()? {
                Entry::Step(record) => return Some(self.replayed(record)),
                Entry::Gap(gap) if self.is_changed => self.stopped_at = Some(gap),
                Entry::Gap(gap) => self.machine.restore(*gap.state),
            }
        }
        None
    }
}

/// What a replay as it was comes to.
#[derive(Debug, Serialize)]
pub struct Repeated {
    /// The ticks that were replayed.
    pub ticks: u64,
    /// The first of them in which the machine did otherwise than the journal says.
    pub differs_at: Option<u64>,
    /// The digest of what was replayed, as a run tells it.
    #[serde(serialize_with = "as_hex")]
    pub digest: u64,
    /// Whether ticks are missing, so that the digest is not that of the run.
    pub has_gaps: bool,
    /// How the journal ends: `complete`, or where it is cut short or damaged.
    #[serde(rename = "journal", serialize_with = "as_text")]
    pub ending: Ending,
}

/// A digest as a run tells it: readers of JSON round numbers as large.
fn as_hex<S: Serializer>(digest: &u64, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(&format_args!("{digest:016x}"))
}

/// How a journal ends, in words.
pub(crate) fn as_text<S: Serializer>(ending: &Ending, to: S) -> Result<S::Ok, S::Error> {
    match ending {
        Ending::Complete(_) => to.serialize_str("complete"),
        Ending::CutShort(flaw) => to.collect_str(&format_args!("cut short {flaw}")),
        Ending::Damaged(flaw) => to.collect_str(&format_args!("damaged {flaw}")),
    }
}

impl Repeated {
    /// The digest of the run, if the journal has its end.
    pub fn run_digest(&self) -> Option<u64> {
        match &self.ending {
            Ending::Complete(end) => end.ending().map(|ending| ending.digest),
            Ending::CutShort(_) | Ending::Damaged(_) => None,
        }
    }

    /// Whether all that was replayed is as it was.
    pub fn is_same(&self) -> bool {
        self.differs_at.is_none() && (self.has_gaps || self.run_digest().is_none_or(|digest| digest == self.digest))
    }
}

/// Replays a journal by the plan that it was made with.
pub fn repeat(journal: Reader<'_>, plan: &Plan) -> Result<Repeated, PlanError> {
    let mut replay = Replay::new(journal, plan, plan)?;
    let (mut digest, mut ticks, mut differs_at, mut expected) = (RunDigest::default(), 0, None, 0);
    let mut has_gaps = false;
    for ReplayedStep { mut record, command, events, .. } in replay.by_ref() {
        if matches!(record.step, Step::Wait) {
            continue;
        }
        let is_tick = matches!(record.step, Step::Tick);
        has_gaps |= is_tick && record.tick != expected;
        expected = record.tick + 1;
        ticks += u64::from(is_tick);
        if record.events != events || (is_tick && record.command != command) {
            differs_at.get_or_insert(record.tick);
        }
        record.events = events;
        record.command = command;
        digest.take(&record);
    }
    Ok(Repeated { ticks, differs_at, digest: digest.value(), has_gaps, ending: replay.into_ending() })
}
