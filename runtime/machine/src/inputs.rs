//! Samples into the blocks of words where programs read them.

use crate::state::{Run, Senses};
use albacore_arithmetic::{Age, Operation};
use albacore_geometry::{Heading, Point, Vector};
use albacore_program::{Input, Program, Slot, senses};
use albacore_vehicle::measurements::{ALTITUDE, POSITION};
use albacore_vehicle::{Measurement, Sample, TICK_S};

/// An input that a mission requires or records, and the vehicle does not deliver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingInput {
    /// The input.
    pub name: String,
    /// What the mission does with it.
    pub wanted: &'static str,
    /// What the vehicle delivers.
    pub delivered: Vec<String>,
}

impl std::fmt::Display for MissingInput {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the mission {} `{}`, which this vehicle does not deliver; it delivers {}",
            self.wanted,
            self.name,
            self.delivered.join(", ")
        )
    }
}

impl std::error::Error for MissingInput {}

/// How the measurements of a vehicle reach the inputs of a program. It holds in a few bytes what every sample needs of its input.
#[derive(Clone)]
pub(crate) struct Wiring {
    /// For each measurement the input that reads it.
    wires: Vec<Option<Wire>>,
    /// Where the blocks of all inputs are.
    blocks: Vec<Slot>,
}

/// The input that reads a measurement.
#[derive(Clone, Copy)]
struct Wire {
    /// Its place among the program's.
    input: u32,
    /// Where its block is, and the layout of that.
    at: Slot,
    end: Slot,
    width: u32,
    kept: u32,
    /// Whether it holds what is counted, which not every number can be.
    counts: bool,
}

/// The wiring of a program, if the vehicle delivers what its mission needs.
pub(crate) fn wiring(program: &Program, measurements: &[Measurement]) -> Result<Wiring, MissingInput> {
    // What has a value at first can do without a sample.
    let required = program.mission.requires.iter().filter(|require| require.at_first.is_none());
    let required = required.map(|require| (require.input, "requires"));
    let recorded =
        program.recordings.iter().flat_map(|recording| &recording.inputs).map(|(input, _)| (*input, "records"));
    for (input, wanted) in required.chain(recorded) {
        let name = &program.inputs[input as usize].name;
        if !senses::ALWAYS_THERE.contains(&&**name) && !measurements.iter().any(|c| c.name == *name) {
            let delivered = measurements.iter().map(|c| c.name.clone()).filter(|name| !name.is_empty()).collect();
            return Err(MissingInput { name: name.clone(), wanted, delivered });
        }
    }
    let wire = |measurement: &Measurement| {
        let place = program.inputs.iter().position(|input| input.name == measurement.name)?;
        let input = &program.inputs[place];
        let Input { at, width, kept, .. } = *input;
        Some(Wire { input: place as u32, at, end: at + input.words(), width, kept, counts: input.counts() })
    };
    let wires = measurements.iter().map(wire).collect();
    Ok(Wiring { wires, blocks: program.inputs.iter().map(|input| input.at).collect() })
}

/// Where guidance finds what it reads.
pub(crate) fn senses(program: &Program) -> Senses {
    let at = |name: &str| program.inputs.iter().find(|i| i.name == name).map(|i| i.at);
    Senses {
        position: at(senses::POSITION),
        course: at(senses::COURSE),
        heading: at(senses::HEADING),
        flow: at(senses::FLOW),
        depth: at(senses::DEPTH),
        altitude: at(senses::ALTITUDE),
        control: at(senses::CONTROL),
        elapsed: at(senses::ELAPSED),
    }
}

impl Run {
    /// Lets an input that no measurement brings have a value in this tick; `at` is its block.
    pub fn tell(&mut self, at: Slot, value: f64) {
        self.set(at + Input::VALUE, value);
        self.set(at + Input::PEAK, value);
        self.set(at + Input::STAMP, self.state.tick as f64);
    }

    /// Lets the input `elapsed` show how long the mission has lasted: since the first tick on which we drive.
    pub fn tell_elapsed(&mut self) {
        if let Some(at) = self.senses.elapsed {
            let ticks = self.state.drives_since.map_or(0, |since| self.state.tick - since);
            self.tell(at, ticks as f64 * TICK_S);
        }
    }

    /// Takes in the samples of a tick. A sample that no value of its input can be is as if it had not come: the checker's
    /// ranges hold for what is taken in.
    pub fn take_in(&mut self, program: &Program, wiring: &Wiring, samples: &[Sample]) {
        // Until a sample comes the peak is the latest value.
        if std::mem::take(&mut self.peaks_differ) {
            for &at in &wiring.blocks {
                let value = self.get(at + Input::VALUE);
                self.set(at + Input::PEAK, value);
            }
        }
        let tick = self.state.tick as f64;
        let mut is_echo = true;
        for sample in samples {
            match sample.origin() {
                ALTITUDE if sample.is_doubted() => {
                    self.doubt_sounding();
                    is_echo = false;
                }
                POSITION => self.state.bottom.doubt_place(sample.is_doubted()),
                _ => {}
            }
            let Some(Some(wire)) = wiring.wires.get(sample.input_measurement() as usize) else { continue };
            let numbers = &sample.reading[..(wire.width as usize).min(sample.reading.len())];
            if !Input::is_bounded(numbers) || wire.counts && !program.inputs[wire.input as usize].admits(numbers) {
                continue;
            }
            // The block is found once, not anew for each of its words.
            let block = self.state.words.get_mut(wire.at as usize..wire.end as usize);
            let Some([stamp, peak, count, first, rest @ ..]) = block else { continue };
            let number = numbers[0];
            if *stamp == tick {
                *peak = peak.max(number);
                self.peaks_differ = true;
            } else {
                *peak = number;
            }
            (*stamp, *first) = (tick, number);
            // Few are more than one number: a copy of any length would be called, for two.
            for (word, number) in numbers.iter().enumerate().skip(1) {
                rest[word - 1] = *number;
            }
            if wire.kept > 0 {
                let place = (*count as u64 % u64::from(wire.kept)) as usize;
                rest[wire.width as usize - 1 + place] = number;
            }
            *count += 1.0;
        }
        self.sound(is_echo);
    }

    pub fn has_sample(&self, input: &Input) -> bool {
        self.get(input.at + Input::STAMP) >= 0.0
    }

    /// Ticks since the latest sample was taken: since its stamp, and the most that it can have been on its way.
    pub fn age_ticks(&self, input: &Input) -> f64 {
        self.state.tick as f64 - self.get(input.at + Input::STAMP) + self.state.lag.round_trip as f64
    }

    pub fn age_s(&self, input: &Input) -> f64 {
        Age::execute([if self.has_sample(input) { self.age_ticks(input) } else { -1.0 }])
    }

    /// Whether a sample has come in this tick.
    pub fn is_new(&self, input: &Input) -> bool {
        self.get(input.at + Input::STAMP) == self.state.tick as f64
    }

    /// How many of the last `of` samples reached a limit.
    pub fn hits(&self, input: &Input, limit: f64, of: u32) -> f64 {
        let count = self.get(input.at + Input::COUNT) as u64;
        let kept = u64::from(input.kept);
        let look = u64::from(of).min(count).min(kept);
        let ring = self.slice(input.at + input.ring(), input.kept);
        (1..=look).filter(|back| ring[((count - back) % kept) as usize] >= limit).count() as f64
    }

    fn value(&self, at: Option<Slot>) -> Option<Slot> {
        at.filter(|at| self.get(at + Input::STAMP) >= 0.0).map(|at| at + Input::VALUE)
    }

    pub fn position(&self) -> Point {
        self.value(self.senses.position).map_or(Point::ORIGIN, |at| Point::new(self.get(at), self.get(at + 1)))
    }

    pub fn heading(&self) -> Heading {
        self.value(self.senses.heading).map_or(Heading::NORTH, |at| Heading::from_radians(self.get(at)))
    }

    /// Over ground; the heading when no course is sensed.
    pub fn course(&self) -> Heading {
        self.value(self.senses.course).map_or_else(|| self.heading(), |at| Heading::from_radians(self.get(at)))
    }

    /// The flow as the program knows it: also what `at first` says.
    pub fn flow(&self) -> Vector {
        match self.senses.flow {
            Some(at) => Vector::new(self.get(at + Input::VALUE), self.get(at + Input::VALUE + 1)),
            None => Vector::ZERO,
        }
    }

    pub fn depth(&self) -> f64 {
        self.value(self.senses.depth).map_or(0.0, |at| self.get(at))
    }
}
