//! What all activations of a run share: the clock, what is sensed, what is asked for, what has happened.

use super::control::{Controlled, Place};
use super::timed::Setpoints;
use super::value::Value;
use albacore_geometry::{Heading, Point, TangentFrame, Vector};
use albacore_guidance::CommandFilter;
use albacore_guidance::parameters::{STATION_POSITION_AGE_MAX, TURN_RATE_MAX};
use albacore_lang::hir::{Activity, Expr, Hir, InputPart, Stmt};
use albacore_lang::source::Sources;
use albacore_lang::types::{Type, TypeTable};
use albacore_machine::{LINE_BYTES, LINES_A_TICK_MAX, LINES_AT_ONCE_MAX};
use albacore_program::{Shape, Text, TextPart};
use albacore_vehicle::{Answer, Measurement, Sample, TICK_S, Vertical};
use std::collections::BTreeMap;

/// What a statement asks for.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    pub course: Heading,
    pub over_ground: bool,
    pub speed: f64,
    pub vertical: Vertical,
}

/// What has been sensed of an input.
#[derive(Clone, Debug, Default)]
pub struct Sensed {
    pub stamp: Option<u64>,
    pub latest: Vec<f64>,
    pub peak: f64,
    /// The first number of every sample there was.
    pub all: Vec<f64>,
}

pub struct World<'p> {
    pub hir: &'p Hir,
    pub types: &'p TypeTable,
    pub sources: &'p Sources,
    pub frame: Option<TangentFrame>,
    pub inputs: Vec<Sensed>,
    pub tick: u64,
    pub asked: Asked,
    /// The way back to a place that is kept, of this tick.
    pub way_back: Option<(Heading, f64)>,
    /// A law went by a position that has not come for a while.
    pub is_lost: bool,
    /// The mission's limit of speed.
    pub fastest: f64,
    /// The fastest turn that is commanded, rad/s.
    pub turn_rate: f64,
    /// What overlays that own a measurement keep in this tick.
    pub kept: Setpoints,
    /// Rule 17: the recovery runs without aborts.
    pub is_recovering: bool,
    /// What was computed and done in this tick, as `check --cost` counts it.
    pub steps: u64,
    /// The texts that values stand for.
    pub texts: Vec<Text>,
    /// What happened in this tick, one line each.
    pub events: Vec<String>,
    /// Lines that may still be written, what was not written since there were none, and which statements have reported.
    pub lines: i64,
    pub unwritten: u64,
    pub reported: Vec<*const Stmt>,
    /// How many questions were put to payloads in this tick, and the first answer to each question of the run.
    pub questions: u64,
    pub answers: BTreeMap<u64, Option<bool>>,
    /// Who drives, and an activity without anything: of each override.
    pub control: Controlled,
    pub override_block: &'p Activity,
    /// The course behind the command filter.
    pub filter: CommandFilter,
    /// Whether the trace has been told that a limit holds a channel, and which overlays amend the course, inner ones first.
    pub limited: [bool; 3],
    pub amending: BTreeMap<Place, String>,
    /// How many `with` there have been.
    pub withs: u64,
}

/// Rule 1: whole ticks, rounded up, at least one; a hair above a whole number is rounding.
pub fn ticks(seconds: f64) -> u64 {
    (seconds / TICK_S - 1e-6).ceil().max(1.0) as u64
}

impl<'p> World<'p> {
    pub fn new(
        (hir, types, sources): (&'p Hir, &'p TypeTable, &'p Sources),
        frame: Option<TangentFrame>,
        control: Controlled,
        override_block: &'p Activity,
    ) -> Self {
        let width = |ty: &Type| types.words(ty) as usize;
        let inputs = hir.inputs.iter().map(|input| {
            let fields: usize = input.fields.iter().map(|(_, ty)| width(ty)).sum();
            Sensed { latest: vec![0.0; width(&input.ty) + fields], ..Sensed::default() }
        });
        let asked = Asked { course: Heading::NORTH, over_ground: false, speed: 0.0, vertical: Vertical::Depth(0.0) };
        World {
            inputs: inputs.collect(),
            hir,
            types,
            sources,
            frame,
            tick: 0,
            asked,
            way_back: None,
            is_lost: false,
            fastest: f64::MAX,
            turn_rate: TURN_RATE_MAX,
            kept: Setpoints::default(),
            is_recovering: false,
            steps: 0,
            texts: Vec::new(),
            events: Vec::new(),
            lines: LINES_AT_ONCE_MAX,
            unwritten: 0,
            reported: Vec::new(),
            questions: 0,
            answers: BTreeMap::new(),
            control,
            override_block,
            filter: CommandFilter::new(Heading::NORTH),
            limited: [false; 3],
            amending: BTreeMap::new(),
            withs: 0,
        }
    }

    /// The place of a text, which is the same whenever it is met.
    pub fn met(&mut self, text: String) -> usize {
        let text = Text { parts: vec![TextPart::Literal(text)] };
        self.texts.iter().position(|known| *known == text).unwrap_or_else(|| {
            self.texts.push(text);
            self.texts.len() - 1
        })
    }

    /// The number of a new question: its tick, and how manieth of that it is.
    pub fn question(&mut self) -> u64 {
        self.questions += 1;
        self.tick * 65536 + self.questions - 1
    }

    /// Takes in what payloads have answered. What nobody has asked by then is no answer.
    pub fn hear(&mut self, answers: &[Answer]) {
        for answer in answers {
            if answer.id < self.tick * 65536 {
                self.answers.entry(answer.id).or_insert(answer.value);
            }
        }
    }

    pub fn say(&mut self, line: String) {
        self.events.push(line);
    }

    /// A tick more to write in; who has written too much is heard again with a tenth of what may be written at once.
    pub fn earn(&mut self) {
        self.lines = (self.lines + LINES_A_TICK_MAX).min(LINES_AT_ONCE_MAX);
        if 10 * self.lines >= LINES_AT_ONCE_MAX {
            self.tell_unwritten();
        }
    }

    pub fn tell_unwritten(&mut self) {
        if self.unwritten > 0 {
            self.say(format!("unwritten {}", self.unwritten));
        }
        self.unwritten = 0;
    }

    /// Whether a `log` or `report` may be written; what it costs is taken with [`World::pay`].
    pub fn may_write(&mut self) -> bool {
        if self.lines > 0 && self.unwritten == 0 {
            return true;
        }
        if self.unwritten == 0 {
            self.say("silenced".into());
        }
        self.unwritten += 1;
        false
    }

    /// The first report of a statement is always written.
    pub fn may_report(&mut self, stmt: &Stmt) -> bool {
        if self.reported.contains(&std::ptr::from_ref(stmt)) {
            return self.may_write();
        }
        self.reported.push(std::ptr::from_ref(stmt));
        true
    }

    pub fn pay(&mut self, bytes: usize) {
        self.lines -= bytes.div_ceil(LINE_BYTES).max(1) as i64;
    }

    pub fn shape(&self, ty: &Type) -> Shape {
        self.types.shape(ty)
    }

    /// Rule 2: every input is sampled once a tick. A sample with something in it that cannot be counts as none.
    pub fn sense(&mut self, measurements: &[Measurement], samples: &[Sample]) {
        for (input, sensed) in self.hir.inputs.iter().zip(&mut self.inputs) {
            let own = |sample: &&Sample| measurements[sample.measurement as usize].name == input.name;
            let width = sensed.latest.len().min(4);
            let valid = samples.iter().filter(own).map(|sample| &sample.reading[..width]);
            let types = std::iter::once(&input.ty).chain(input.fields.iter().map(|(_, ty)| ty));
            let can_be = |numbers: &&[f64]| {
                let mut words = numbers.iter();
                numbers.iter().all(|x| x.abs() <= 1e150)
                    && types.clone().all(|ty| {
                        let mut words = words.by_ref().take(self.types.words(ty) as usize);
                        let below = |count: f64| move |x: &f64| x.fract() == 0.0 && (0.0..count).contains(x);
                        match ty {
                            Type::Bool => words.all(below(2.0)),
                            Type::Enum(id) => words.all(below(self.types.enums[*id].variants.len() as f64)),
                            Type::Int | Type::Sign => words.all(|x| x.fract() == 0.0 && x.abs() <= 9007199254740992.0),
                            _ => words.count() < usize::MAX,
                        }
                    })
            };
            let valid: Vec<&[f64]> = valid.filter(can_be).collect();
            sensed.peak = sensed.latest[0];
            let Some(latest) = valid.last() else { continue };
            sensed.peak = valid.iter().map(|numbers| numbers[0]).fold(f64::NEG_INFINITY, f64::max);
            sensed.all.extend(valid.iter().map(|numbers| numbers[0]));
            sensed.latest[..width].copy_from_slice(latest);
            sensed.stamp = Some(self.tick);
        }
    }

    /// Rules 1 and 18: how long the mission has lasted, and who drives, as its script may read them.
    pub fn tell_elapsed(&mut self, ticks: u64) {
        self.tell("elapsed", ticks as f64 * TICK_S);
        self.tell("control", f64::from(self.control.shown as u8));
    }

    fn tell(&mut self, name: &str, value: f64) {
        if let Some(id) = self.hir.inputs.iter().position(|input| input.name == name) {
            let sensed = &mut self.inputs[id];
            (sensed.peak, sensed.latest[0], sensed.stamp) = (value, value, Some(self.tick));
        }
    }

    /// What is read of an input; `limit` is that of `hits`.
    pub fn input(&self, id: usize, part: &InputPart, limit: f64, ty: &Type) -> Value {
        let sensed = &self.inputs[id];
        match part {
            InputPart::Value => Value::read(&self.shape(ty), &sensed.latest),
            InputPart::Field(at) => Value::read(&self.shape(ty), &sensed.latest[*at as usize..]),
            InputPart::Peak => Value::Number(sensed.peak),
            InputPart::Age => {
                Value::Number(sensed.stamp.map_or(1e9, |stamp| (self.tick as f64 - stamp as f64) * TICK_S))
            }
            InputPart::IsNew => Value::truth(sensed.stamp == Some(self.tick)),
            InputPart::Hits(_, of) => {
                let last = sensed.all.iter().rev().take(*of as usize);
                Value::Number(last.filter(|&&x| x >= limit).count() as f64)
            }
        }
    }

    /// The latest sample of an input that guidance reads.
    fn sample(&self, name: &str) -> Option<&[f64]> {
        let id = self.hir.inputs.iter().position(|input| input.name == name)?;
        self.inputs[id].stamp.map(|_| self.inputs[id].latest.as_slice())
    }

    pub fn position(&self) -> Point {
        self.sample("position").map_or(Point::ORIGIN, |words| Point::new(words[0], words[1]))
    }

    /// The position, unless it is too old to tell where a vehicle drifts.
    pub fn known_position(&self) -> Option<Point> {
        let id = self.hir.inputs.iter().position(|input| input.name == "position")?;
        let age = self.tick - self.inputs[id].stamp?;
        (age as f64 * TICK_S <= STATION_POSITION_AGE_MAX).then(|| self.position())
    }

    pub fn heading(&self) -> Heading {
        self.sample("heading").map_or(Heading::NORTH, |words| Heading::from_radians(words[0]))
    }

    pub fn course(&self) -> Heading {
        self.sample("course").map_or_else(|| self.heading(), |words| Heading::from_radians(words[0]))
    }

    pub fn depth(&self) -> Option<f64> {
        self.sample("depth").map(|words| words[0])
    }

    pub fn knows_heading(&self) -> bool {
        self.sample("heading").is_some()
    }

    /// An input that guidance reads, if it has been told within so many ticks.
    pub fn lately(&self, name: &str, ticks: u64) -> Option<f64> {
        let id = self.hir.inputs.iter().position(|input| input.name == name)?;
        let stamp = self.inputs[id].stamp?;
        (self.tick - stamp <= ticks).then(|| self.inputs[id].latest[0])
    }

    /// Where the vehicle is, if that has been told within so many ticks.
    pub fn place(&self, ticks: u64) -> Option<Point> {
        self.lately("position", ticks)?;
        let id = self.hir.inputs.iter().position(|input| input.name == "position")?;
        Some(Point::new(self.inputs[id].latest[0], self.inputs[id].latest[1]))
    }

    /// Also what `at first` says.
    pub fn flow(&self) -> Vector {
        let id = self.hir.inputs.iter().position(|input| input.name == "flow");
        id.map_or(Vector::ZERO, |id| Vector::new(self.inputs[id].latest[0], self.inputs[id].latest[1]))
    }

    pub fn written(&self, e: &Expr) -> String {
        self.sources.text(e.span).to_string()
    }
}

/// The depths that come while a mission waits: the first may be wrong, and nothing tells it but the next one.
#[derive(Default)]
pub struct FirstDepths {
    before: Option<(f64, u64)>,
    agree: bool,
}

impl FirstDepths {
    /// Takes in the latest depth; whether it is further than 1 m and 3 m/s from the one before.
    pub fn are_contradicted(&mut self, w: &World) -> bool {
        let Some(id) = w.hir.inputs.iter().position(|input| input.name == "depth") else { return false };
        let (Some(stamp), now) = (w.inputs[id].stamp, w.depth().unwrap_or(0.0)) else { return false };
        let before = self.before.replace((now, stamp));
        let Some((before, then)) = before.filter(|(_, then)| *then != stamp) else { return false };
        self.agree = (now - before).abs() <= 1.0 + 3.0 * (stamp - then) as f64 * TICK_S;
        !self.agree
    }

    /// Whether two have agreed, or one came and no second one in time.
    pub fn are_known(&self, is_late: bool) -> bool {
        self.before.is_some() && (self.agree || is_late)
    }
}
