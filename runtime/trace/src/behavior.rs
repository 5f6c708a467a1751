//! The behavior trace: a line for everything that happened, short enough to read and stable enough to compare.

use crate::active::Active;
use crate::beginnings::Beginnings;
use crate::condition::TriedCondition;
use crate::wording::Wording;
use albacore_geometry::{Heading, Point};
use albacore_machine::{Event, Outcome, Tried};
use albacore_program::number;
use albacore_program::seen::one_line;
use albacore_program::{Cause, Program};
use serde::{Deserialize, Serialize};

/// Ticks between samples unless told otherwise: a minute.
const SAMPLE_EVERY_TICKS: u64 = 600;
/// A trace has at most this many lines, and its end: ten a second for more than a day.
const LINES_MAX: usize = 1_000_000;
/// What a trace says of its run at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The mission's name.
    pub mission: String,
    /// The scenario's name; empty on a real vehicle.
    pub scenario: String,
    /// The run's seed.
    pub seed: u64,
    /// The length of a tick, in seconds.
    pub tick_s: f64,
}

/// What a line is, so that parts of a trace can be taken out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Header,
    Event,
    Sample,
    Digest,
}

/// How a run gave its vehicle back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Release {
    /// It did.
    Done,
    /// The vehicle could not be told.
    Failed,
    /// There was nothing to give back: a guest that did not drive.
    NotOurs,
}

/// The trace of one run, as it grows.
#[derive(Clone, Debug)]
pub struct BehaviorTrace {
    wording: Wording,
    lines: Vec<(Kind, String)>,
    active: Active,
    beginnings: Beginnings,
    sample_every_ticks: u64,
    next_sample: u64,
    ended: Option<Outcome>,
    last_event: u64,
    /// Lines that would have been too many.
    left_out: u64,
}

impl BehaviorTrace {
    /// A trace that has nothing but its header.
    pub fn new(program: &Program, header: &Header) -> Self {
        let mut trace = BehaviorTrace {
            wording: Wording::new(program),
            lines: Vec::new(),
            active: Active::default(),
            beginnings: Beginnings::new(program.statements.len()),
            sample_every_ticks: SAMPLE_EVERY_TICKS,
            next_sample: 0,
            ended: None,
            last_event: 0,
            left_out: 0,
        };
        let scenario =
            if header.scenario.is_empty() { String::new() } else { format!("  scenario {}", header.scenario) };
        let tick = number::fixed(header.tick_s, 1);
        // What places in metres are counted from.
        let origin = program.mission.origin.map_or_else(String::new, |origin| format!("  about {origin}"));
        let line = format!("mission {}{scenario}  seed {}  tick {tick} s{origin}", header.mission, header.seed);
        trace.lines.push((Kind::Header, one_line(&line)));
        trace
    }

    /// The same with another interval between samples; 0 for none.
    pub fn with_samples_every(self, ticks: u64) -> Self {
        BehaviorTrace { sample_every_ticks: ticks, ..self }
    }

    /// Adds what happened in a tick, at the vehicle's estimate of its position.
    pub fn tick(&mut self, tick: u64, position: Option<Point>, events: &[Event]) {
        let is_end = events.iter().any(|event| matches!(event, Event::Ended(_)));
        self.count_beginnings(tick, (!is_end).then_some(tick));
        if events.is_empty() {
            return;
        }
        self.last_event = tick;
        let said = self.said_by_others(events);
        for (at, (event, said)) in events.iter().zip(said).enumerate() {
            let said = said || matches!(event, Event::Began(statement, _) if !self.begins(*statement, tick));
            if let (false, Some((verb, line))) = (said, self.wording.line(at, events, &self.active, position)) {
                self.say(Kind::Event, tick, verb, &line);
            }
            self.follow(event);
        }
    }

    /// Whether the beginning of a statement is told. That of a call is, by what it enters.
    fn begins(&mut self, statement: u32, tick: u64) -> bool {
        let is_call = self.wording.names.program.statements.get(statement as usize).is_some_and(|s| s.is_call);
        is_call || self.beginnings.begin(statement, tick)
    }

    /// Adds how many beginnings were not told of what has come to rest by a tick, or of all.
    fn count_beginnings(&mut self, tick: u64, by: Option<u64>) {
        for (statement, count) in self.beginnings.come_to_rest(by) {
            let line = self.wording.begun_again(statement, count, self.active.chain().len());
            self.say(Kind::Event, tick, "begin", &line);
        }
    }

    /// Adds what the vehicle or the link to it gave notice of: a command refused or ignored, an error.
    pub fn vehicle(&mut self, tick: u64, notice: &str) {
        self.last_event = tick;
        self.say(Kind::Event, tick, "vehicle", &one_line(notice));
    }

    /// Adds a sample when one is due. Called on every tick, after [`Self::tick`].
    pub fn sample(&mut self, tick: u64, position: Option<Point>, heading: Option<Heading>, depth_m: Option<f64>) {
        if self.sample_every_ticks == 0 || tick < self.next_sample {
            return;
        }
        self.next_sample = tick.saturating_add(self.sample_every_ticks);
        let position = position.map_or_else(|| "?".to_string(), number::point);
        let heading = number::compass(heading.map_or(f64::NAN, Heading::radians));
        let depth = number::metres(depth_m.unwrap_or(f64::NAN));
        // The mission is in the header; it is named only where nothing else is active.
        let chain = self.active.chain();
        let path: Vec<&str> = chain.get(1..).unwrap_or(&[]).iter().map(|&id| self.wording.names.name(id)).collect();
        let path = if path.is_empty() {
            chain.first().map_or("", |&id| self.wording.names.name(id)).to_string()
        } else {
            path.join(" > ")
        };
        let line = format!("{position:<21}  heading {heading:>5} deg  depth {depth:>7}  {path}");
        self.say(Kind::Sample, tick, "at", &line);
    }

    /// Ends the trace: with the outcome, unless an event has told it, whether the vehicle was given back, the length of the
    /// run, and the digest of all of it.
    pub fn finish(&mut self, outcome: Outcome, release: Release, ticks: u64, digest: u64) {
        self.count_beginnings(ticks, None);
        if self.ended != Some(outcome) {
            self.say(Kind::Event, ticks, "end", outcome.name());
            self.last_event = ticks;
        }
        match release {
            Release::Done => self.say(Kind::Event, self.last_event, "control", "released"),
            Release::Failed => {
                self.say(Kind::Event, self.last_event, "control", "not released: the vehicle could not be told");
            }
            Release::NotOurs => {}
        }
        if self.left_out > 0 {
            self.lines.push((Kind::Digest, format!("{} more lines not written", self.left_out)));
        }
        self.lines.push((Kind::Digest, format!("digest {digest:016x}  {ticks} ticks")));
    }

    /// The event lines alone: no header, no samples, no digest.
    pub fn switches(&self) -> String {
        self.lines.iter().filter(|(kind, _)| *kind == Kind::Event).map(|(_, line)| format!("{line}\n")).collect()
    }

    /// What is active, from outside in, and the statement that is under way.
    pub fn under_way(&self) -> Vec<String> {
        self.active.under_way(&self.wording.names.program)
    }

    /// Conditions that were tried, in words.
    pub fn tried(&self, tried: &[Tried]) -> Vec<TriedCondition> {
        tried.iter().map(|tried| self.wording.tried(tried)).collect()
    }

    /// How many lines there are.
    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Whether there is not even a header.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// The lines from one on, by its number: what has come since there were so many.
    pub fn since(&self, line: usize) -> impl Iterator<Item = &str> {
        self.lines.iter().skip(line).map(|(_, text)| text.as_str())
    }

    /// Keeps track of what is active.
    fn follow(&mut self, event: &Event) {
        self.active.follow(event, &self.wording.names.program);
        if let Event::Ended(outcome) = event {
            self.ended = Some(*outcome);
        }
    }

    /// Which events of a tick go without a line of their own: a switch implies that its source is left, or waits, and that
    /// its target is entered; a resumption that the behavior in between is left.
    fn said_by_others(&self, events: &[Event]) -> Vec<bool> {
        let mut said = vec![false; events.len()];
        let mut absorb = |implied: &dyn Fn(&Event) -> bool| {
            if let Some(at) = (0..events.len()).find(|&i| !said[i] && implied(&events[i])) {
                said[at] = true;
            }
        };
        for event in events {
            match event {
                Event::Switched { rule, from, .. } => {
                    absorb(
                        &|e| matches!(e, Event::Left(id, Cause::Rule | Cause::Done) | Event::Suspended(id) if id == from),
                    );
                    if let Some(to) = self.wording.names.target(*from, *rule) {
                        absorb(&|e| matches!(e, Event::Entered(id) if *id == to));
                    }
                }
                Event::Resumed(id) => {
                    absorb(&|e| matches!(e, Event::Left(left, _) if self.wording.names.share_table(*left, *id)))
                }
                _ => {}
            }
        }
        said
    }

    fn say(&mut self, kind: Kind, tick: u64, verb: &str, line: &str) {
        if self.lines.len() < LINES_MAX || verb == "end" || verb == "control" {
            let line = format!("{}  {verb:<7}  {line}", number::seconds(tick));
            self.lines.push((kind, one_line(line.trim_end())));
        } else {
            self.left_out += 1;
        }
    }
}

/// The whole trace.
impl std::fmt::Display for BehaviorTrace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.lines.iter().try_for_each(|(_, line)| writeln!(f, "{line}"))
    }
}
