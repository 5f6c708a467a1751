//! A run that is over, read back from its journal: the records that it left feed the same recorders that it fed as it went.

use crate::plan::Plan;
use crate::recorders::{InMemory, Recorder, RunFile, WorldAtEnd};
use crate::summary::Summary;
use albacore_geometry::Point;
use albacore_machine::Event;
use albacore_program::{ActivityId, Body, Program, senses};
use albacore_trace::journal::{Ending, Entry, JournalHeader, Reader, Unreadable};
use albacore_trace::{Active, BehaviorTrace, Step, TickRecord};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A run that is over.
pub struct PastRun {
    memory: InMemory,
    header: JournalHeader,
    ending: Ending,
    in_simulation: bool,
}

impl PastRun {
    /// Reads the journal of a run of a plan, as far as it is whole. What the plan has no names for, since its script has changed, has `?`.
    pub fn read(plan: &Plan, journal: &[u8]) -> Result<Self, Unreadable> {
        let mut reader = Reader::new(journal)?;
        let header = reader.header().clone();
        let mut memory = InMemory::new(plan, header.seed, &header.measurements, header.start);
        let mut derived = Derived::new(plan, &header);
        let mut in_simulation = false;
        // Nobody knows of a tick that it was the last one before what follows it is read.
        let mut held: Option<Box<TickRecord>> = None;
        for entry in reader.by_ref() {
            match entry {
                Entry::Step(mut record) => {
                    derived.complete(&mut record);
                    in_simulation |= record.truth.is_some();
                    let is_end = record.ending().is_some();
                    if let Some(mut before) = held.replace(record) {
                        before.is_last = is_end;
                        memory.take(&before);
                    }
                }
                Entry::Gap(gap) => {
                    held.take().iter().for_each(|before| memory.take(before));
                    memory.miss(gap.last - gap.first + 1, gap.state.tick);
                    derived.lose();
                }
            }
        }
        held.iter().for_each(|last| memory.take(last));
        Ok(PastRun { memory, header, ending: reader.into_ending(), in_simulation })
    }

    /// What was run.
    pub fn header(&self) -> &JournalHeader {
        &self.header
    }

    /// How its journal ends.
    pub fn ending(&self) -> &Ending {
        &self.ending
    }

    /// The result; how long it took by the clock is not in the journal.
    pub fn summary(&self) -> Summary {
        self.memory.summary(0.0)
    }

    /// The behavior trace.
    pub fn trace(&self) -> &BehaviorTrace {
        self.memory.trace.lines()
    }

    /// One of the files that the run has left. A picture is without the plume: a journal holds what the vehicle met of it alone.
    pub fn file(&self, file: &RunFile) -> String {
        (file.make)(&self.memory, &WorldAtEnd { in_simulation: self.in_simulation, ..WorldAtEnd::default() })
    }
}

/// What of a record follows from those before it, and is not in the journal.
struct Derived {
    program: Arc<Program>,
    position: Option<usize>,
    active: Active,
    /// Overlays, and the behaviors of their tables: they run beside what is active.
    beside: BTreeSet<ActivityId>,
    believed: Option<Point>,
}

impl Derived {
    fn new(plan: &Plan, header: &JournalHeader) -> Self {
        Derived {
            program: Arc::clone(&plan.program),
            position: header.measurements.iter().position(|measurement| measurement.name == senses::POSITION),
            active: Active::default(),
            beside: beside(&plan.program),
            believed: None,
        }
    }

    fn complete(&mut self, record: &mut TickRecord) {
        for sample in &record.snapshot.samples {
            if Some(usize::from(sample.input_measurement())) == self.position {
                self.believed = Some(Point::new(sample.reading[0], sample.reading[1]));
            }
        }
        let is_beside = |event: &&Event| match event {
            Event::Entered(id) | Event::Left(id, _) | Event::Suspended(id) | Event::Resumed(id) => {
                self.beside.contains(id)
            }
            _ => false,
        };
        let of_chain = record.events.iter().filter(|event| !is_beside(event));
        of_chain.for_each(|event| self.active.follow(event, &self.program));
        if !matches!(record.step, Step::Wait) {
            record.believed = self.believed;
            record.active = self.active.chain().to_vec();
        }
    }

    /// What happened meanwhile is not known.
    fn lose(&mut self) {
        self.active = Active::default();
    }
}

/// The activities that overlays are, and those of their tables.
fn beside(program: &Program) -> BTreeSet<ActivityId> {
    let mut beside = BTreeSet::new();
    let mut ahead: Vec<ActivityId> = program.overlays.iter().map(|site| site.activity).collect();
    while let Some(id) = ahead.pop() {
        if beside.insert(id)
            && let Some(Body::Table(table)) = program.activities.get(id as usize).map(|activity| &activity.body)
        {
            ahead.extend(table.behaviors.iter().map(|behavior| behavior.activity));
        }
    }
    beside
}
