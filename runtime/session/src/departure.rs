//! Where a mission that was changed departs from a run, fed with what the run's vehicle sensed.

use crate::difference::{DeedDifference, deed_differences};
use crate::plan::{Plan, PlanError};
use crate::recorders::Recorder;
use crate::recorders::trace::Trace;
use crate::replay::Replay;
use crate::why::told;
use albacore_machine::Tried;
use albacore_trace::journal::{Ending, JournalHeader, Reader};
use albacore_trace::{Step, TickRecord, TriedCondition, deeds};
use albacore_vehicle::Command;
use serde::Serialize;

/// So many digits more than usual tell two commands apart.
const COMMAND_DIGITS_MAX: u8 = 13;

/// What a mission that was changed would have done.
#[derive(Debug, Serialize)]
pub struct Departure {
    /// How many ticks were replayed.
    pub ticks: u64,
    /// The first tick in which it would have commanded something else, and what each commands.
    pub commanded: Option<(u64, [String; 2])>,
    /// Where it would first have done something else.
    pub decided: Option<Parting>,
    /// What one alone does, or at another time: the run is the first.
    pub deeds: Vec<DeedDifference>,
    /// Behind which tick it could not be replayed: ticks are missing in the journal.
    pub stopped_at: Option<u64>,
    /// How the replayed mission ended by the end of the journal, if it did.
    pub outcome: Option<&'static str>,
    /// How the journal ends: `complete`, or where it is cut short or damaged.
    #[serde(rename = "journal", serialize_with = "crate::replay::as_text")]
    pub ending: Ending,
}

/// A tick in which a run and its replay do not do the same.
#[derive(Debug, Default, Serialize)]
pub struct Parting {
    /// The tick.
    pub tick: u64,
    /// What the trace says of each.
    pub lines: [Vec<String>; 2],
    /// What is active in each afterwards.
    pub under_way: [Vec<String>; 2],
    /// The conditions that did not come out the same: of each those that it tried.
    pub conditions: [Vec<TriedCondition>; 2],
}

/// What is told of the steps of a side: of the run, or of its replay.
struct Side {
    trace: Trace,
    /// What the last step did, without its numbers, and the lines that say so.
    said: Vec<String>,
    lines: Vec<String>,
}

impl Side {
    fn new(plan: &Plan, header: &JournalHeader) -> Self {
        Side { trace: Trace::new(plan, header.seed, &header.measurements), said: Vec::new(), lines: Vec::new() }
    }

    fn take(&mut self, record: &TickRecord) {
        let known = self.trace.lines().len();
        self.trace.take(record);
        let new: Vec<&str> = self.trace.lines().since(known).collect();
        let text = new.join("\n");
        (self.said, self.lines) = deeds(&text).map(|(_, deed, line)| (deed.said, line.to_string())).unzip();
    }
}

/// Replays a journal by a plan that was changed, and holds it against the run.
pub fn depart(journal: &[u8], original: &Plan, changed: &Plan) -> Result<Departure, PlanError> {
    let mut replay = Replay::new(reader(journal)?, original, changed)?;
    let header = replay.header().clone();
    let mut sides = [Side::new(original, &header), Side::new(changed, &header)];
    let (mut commanded, mut decided, mut ticks) = (None, None::<Parting>, 0);
    while let Some(step) = replay.next() {
        let is_tick = matches!(step.record.step, Step::Tick);
        // An end to which the mission came by itself was in the tick before it.
        if !is_tick && step.record.events.is_empty() {
            continue;
        }
        ticks += u64::from(is_tick);
        let mut theirs = (*step.record).clone();
        if is_tick && commanded.is_none() && theirs.command != step.command {
            commanded = Some((theirs.tick, told_apart([theirs.command, step.command])));
        }
        // The end of the run is none of a mission that goes on, or was over before.
        let mut ours = TickRecord { events: step.events, command: step.command, ..theirs.clone() };
        let position = replay.machine().position();
        (theirs.believed, ours.believed) = (position, position);
        sides[0].take(&theirs);
        if step.is_beyond {
            (sides[1].said, sides[1].lines) = Default::default();
        } else {
            sides[1].take(&ours);
        }
        if decided.is_none() && sides[0].said != sides[1].said {
            let lines = sides.each_ref().map(|side| side.lines.clone());
            let under_way = sides.each_ref().map(|side| side.trace.lines().under_way());
            decided = Some(Parting { tick: theirs.tick, lines, under_way, ..Parting::default() });
        }
    }
    if let Some(parting) = &mut decided {
        parting.conditions = differing([
            conditions(journal, original, original, parting.tick, &sides[0])?,
            conditions(journal, original, changed, parting.tick, &sides[1])?,
        ]);
    }
    let traces = sides.each_ref().map(|side| side.trace.lines().to_string());
    Ok(Departure {
        ticks,
        commanded,
        decided,
        deeds: deed_differences(&traces).0,
        stopped_at: replay.stopped_at().map(|gap| gap.first),
        outcome: replay.machine().outcome().map(albacore_machine::Outcome::name),
        ending: replay.into_ending(),
    })
}

/// Two commands in words, with as many digits as it takes to see that they differ.
fn told_apart(both: [Option<Command>; 2]) -> [String; 2] {
    let words = |digits| both.map(|command| command.map_or("nothing".to_string(), |command| told(&command, digits)));
    let different = (0..COMMAND_DIGITS_MAX).map(words).find(|[run, replay]| run != replay);
    different.unwrap_or_else(|| words(COMMAND_DIGITS_MAX))
}

fn reader(journal: &[u8]) -> Result<Reader<'_>, PlanError> {
    Reader::new(journal).map_err(|unreadable| PlanError::Asked(unreadable.to_string(), None))
}

/// The conditions that a plan's machine tries in a tick.
fn conditions(
    journal: &[u8],
    original: &Plan,
    plan: &Plan,
    tick: u64,
    side: &Side,
) -> Result<Vec<TriedCondition>, PlanError> {
    let mut replay = Replay::new(reader(journal)?, original, plan)?.asking(tick..=tick);
    let is_it = |record: &TickRecord| record.tick == tick && matches!(record.step, Step::Tick);
    let tried: Vec<Tried> = replay.find(|step| is_it(&step.record)).map(|step| step.tried).unwrap_or_default();
    Ok(side.trace.lines().tried(&tried))
}

/// Of two lists the conditions of what one decided and the other did not.
fn differing(both: [Vec<TriedCondition>; 2]) -> [Vec<TriedCondition>; 2] {
    let decided = both.each_ref().map(|side| {
        let held = side.iter().filter(|condition| condition.holds);
        held.map(|condition| condition.decides.clone()).collect::<Vec<_>>()
    });
    both.map(|side| {
        let is_ours = |condition: &TriedCondition| {
            decided[0].contains(&condition.decides) != decided[1].contains(&condition.decides)
        };
        side.into_iter().filter(is_ours).collect()
    })
}
