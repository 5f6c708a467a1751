//! A run that is over, read back from its journal: the records that it left feed the same recorders that it fed as it went.

use crate::plan::Plan;
use crate::recorders::{InMemory, Recorder, RunFile, WorldAtEnd};
use crate::summary::Summary;
use albacore_geometry::Point;
use albacore_program::{Program, senses};
use albacore_trace::journal::{Ending, Entry, JournalHeader, Reader, Unreadable};
use albacore_trace::{Active, BehaviorTrace, Step, TickRecord};
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
        Self::read_with(plan, journal, |_| None::<InMemory>).map(|(past, _)| past)
    }

    /// The same with one more recorder, which is made of what was run.
    pub(crate) fn read_with<R: Recorder>(
        plan: &Plan,
        journal: &[u8],
        more: impl FnOnce(&JournalHeader) -> R,
    ) -> Result<(Self, R), Unreadable> {
        let header = Reader::new(journal)?.header().clone();
        let memory = InMemory::new(plan, header.seed, &header.measurements, header.start);
        let mut recorders = (memory, more(&header));
        let mut in_simulation = false;
        let ending = fold(plan, journal, &mut recorders, |record| in_simulation |= record.truth.is_some())?;
        let (memory, more) = recorders;
        Ok((PastRun { memory, header, ending, in_simulation }, more))
    }

    /// What its recorders have kept.
    pub(crate) fn memory(&self) -> &InMemory {
        &self.memory
    }

    /// Whether its journal tells the truth of a simulated world.
    pub(crate) fn in_simulation(&self) -> bool {
        self.in_simulation
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

/// Feeds the records of a journal, as far as it is whole, to a recorder, and shows each; gives how it ends.
pub(crate) fn fold(
    plan: &Plan,
    journal: &[u8],
    recorder: &mut impl Recorder,
    mut see: impl FnMut(&TickRecord),
) -> Result<Ending, Unreadable> {
    let mut reader = Reader::new(journal)?;
    let mut derived = Derived::new(plan, reader.header());
    // Nobody knows of a tick that it was the last one before what follows it is read.
    let mut held: Option<Box<TickRecord>> = None;
    for entry in reader.by_ref() {
        match entry {
            Entry::Step(mut record) => {
                derived.complete(&mut record);
                see(&record);
                let is_end = record.ending().is_some();
                if let Some(mut before) = held.replace(record) {
                    before.is_last = is_end;
                    recorder.take(&before);
                }
            }
            Entry::Gap(gap) => {
                held.take().iter().for_each(|before| recorder.take(before));
                recorder.miss(gap.last - gap.first + 1, gap.state.tick);
                derived.lose();
            }
        }
    }
    held.iter().for_each(|last| recorder.take(last));
    Ok(reader.into_ending())
}

/// What of a record follows from those before it, and is not in the journal.
struct Derived {
    program: Arc<Program>,
    position: Option<usize>,
    active: Active,
    believed: Option<Point>,
}

impl Derived {
    fn new(plan: &Plan, header: &JournalHeader) -> Self {
        Derived {
            program: Arc::clone(&plan.program),
            position: header.measurements.iter().position(|measurement| measurement.name == senses::POSITION),
            active: Active::default(),
            believed: None,
        }
    }

    fn complete(&mut self, record: &mut TickRecord) {
        for sample in &record.snapshot.samples {
            if Some(usize::from(sample.input_measurement())) == self.position {
                self.believed = Some(Point::new(sample.reading[0], sample.reading[1]));
            }
        }
        record.events.iter().for_each(|event| self.active.follow(event, &self.program));
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
