//! From the checked program to the machine's: names become slots, types vanish, every frame gets its place.
//!
//! Each declaration at the left margin, with the behaviors nested in it, is a *unit* with one frame: first what lives on,
//! then temporaries. A unit is lowered twice: the first time only to learn how much lives on. Callees come before callers,
//! so that the place of every frame inside its caller's is known.

mod activity;
mod claims;
mod condition;
mod control;
mod expr;
mod inline;
mod loops;
mod maps;
mod prepare;
mod scenario;
mod stmt;
mod table;
mod tell;
mod terms;
mod test;
mod watch;

pub use test::{ExpectProgram, NamedValue, RowProgram, TestProgram, TestSlots, test};

pub use scenario::{SAME_PLANE_M, ScenarioArg, ScenarioClause, ScenarioProgram, ScenarioValue, scenario};

use crate::code::Code;
use crate::cost::limits::{self, INSTRUCTIONS_MAX, WORDS_MAX};
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Hir};
use crate::source::{Sources, Span};
use crate::types::Type;
use crate::types::TypeTable;
use albacore_geometry::{Geodetic, Point, TangentFrame};
use albacore_program::{ABSOLUTE, ActivityId, Addr, Claims, Input, Op, Program, Shape, Slot, Text, TextPart};
use std::collections::BTreeMap;

/// A lowered function.
#[derive(Clone, Copy)]
struct FnCode {
    entry: Addr,
    result: Slot,
    words: u64,
    /// How many instructions it has.
    ops: u64,
}

/// The subroutine that puts an ordered list in order.
#[derive(Clone)]
struct Sorter {
    entry: Addr,
    /// Where its key finds an element, and what that is.
    it: Slot,
    element: Type,
    /// What the list's key is made of beside the element; none when that cannot be compared.
    sorted_by: Option<Vec<SortedBy>>,
}

/// Words that a key reads, and where they are kept as they were when the list was last put in order.
#[derive(Clone, Copy)]
struct SortedBy {
    read: Slot,
    words: u32,
    then: Slot,
}

/// A lowered activity of the left margin.
#[derive(Clone, Copy)]
struct UnitCode {
    activity: u32,
    words: u64,
    /// How many instructions it has.
    ops: u64,
}

/// A lowered mission, and what it is made of.
pub struct Lowered {
    /// The mission.
    pub program: Program,
    /// The places of its texts without holes.
    pub texts: BTreeMap<String, u32>,
    /// What the checker takes its variables to be.
    pub claims: Claims,
    /// All its words, of which the program says no more than it can hold.
    pub words: u64,
    /// All its instructions, of which the program has no more than it can hold.
    pub instructions: u64,
    /// The words of each activity's frame, with those of what it calls, and its own instructions.
    pub units: BTreeMap<usize, (u64, u64)>,
    /// The instructions of each function that is called.
    pub fns: BTreeMap<usize, u64>,
    /// Where each activity stands among the program's.
    pub activities: BTreeMap<usize, ActivityId>,
}

/// Lowers one mission and what it needs.
struct Lowering<'a> {
    hir: &'a Hir,
    types: &'a TypeTable,
    sources: &'a Sources,
    program: Program,
    claims: Claims,
    origin: Option<Geodetic>,
    fns: BTreeMap<usize, FnCode>,
    units: BTreeMap<usize, UnitCode>,
    /// Where each activity stands among the program's.
    activities: BTreeMap<usize, ActivityId>,
    /// The variables of what is being lowered: a function's or a unit's.
    vars: &'a [hir::Var],
    frame: Frame,
    findings: Vec<Diagnostic>,
    /// What a test gives the mission in place of its defaults.
    mission_args: Option<&'a [hir::Expr]>,
    /// Where constants have their absolute slots: only a mission has room for them.
    constants_at: Option<Slot>,
    /// The places of constants among the program's, by their bits.
    constants: BTreeMap<u64, Slot>,
    /// The places of texts without holes among the program's.
    texts: BTreeMap<String, u32>,
    /// How many instructions there are. Those past the most that a program can hold are counted only: it is refused.
    emitted: u64,
}

/// The frame of the unit that is being lowered.
#[derive(Clone, Default)]
struct Frame {
    /// Where each variable is.
    vars: Vec<Slot>,
    /// Words that live on, so far. They may be more than any program can hold, which is then refused: what it holds of
    /// them has slots that mean nothing.
    lasting: u64,
    /// Where temporaries begin.
    temp_base: u64,
    /// The temporaries in use, and the most there were.
    temp: u64,
    temp_most: u64,
    /// The values of temporal operators, by the address of their node.
    timers: BTreeMap<usize, Slot>,
    /// The age at which what an `every` stands in fired last, by the address of its node.
    rhythms: BTreeMap<usize, Slot>,
    /// The header of the activity whose code is being lowered, and its result.
    header: Slot,
    result: Slot,
    /// The overlays of the activity whose code is being lowered: of its statements, innermost first, and of its
    /// declarations.
    overlays: Vec<u32>,
    declared_overlays: Vec<u32>,
    /// The loops around what is being lowered, from outside in, and whether it needs no telling when it begins.
    loops: Vec<tell::Around>,
    told_by_name: bool,
    /// In a guard: whether the body has come to its end.
    done: bool,
    /// The subroutine that sorts a variable that is an ordered list.
    sorters: BTreeMap<usize, Sorter>,
}

/// Lowers a mission. The findings are errors that only the whole program shows.
pub fn mission(hir: &Hir, types: &TypeTable, sources: &Sources, mission: usize) -> Result<Program, Vec<Diagnostic>> {
    Ok(within_limits(Lowering::new(hir, types, sources), mission)?.program)
}

/// Lowers a mission however large it is, and tells what it is made of.
pub fn mission_parts(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    mission: usize,
) -> Result<Lowered, Vec<Diagnostic>> {
    Lowering::new(hir, types, sources).whole(mission)
}

/// Lowers the mission that is a line of the prompt, in the frame of the vehicle that it drives.
pub fn line(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    mission: usize,
    origin: Option<Geodetic>,
) -> Result<Program, Vec<Diagnostic>> {
    Ok(within_limits(Lowering { origin, ..Lowering::new(hir, types, sources) }, mission)?.program)
}

/// The same with arguments in place of the parameters' defaults, and the texts of another program where that has them.
fn mission_with(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    (mission, args): (usize, &[hir::Expr]),
    texts: &BTreeMap<String, u32>,
) -> Result<Lowered, Vec<Diagnostic>> {
    let lowering = Lowering { mission_args: Some(args), ..Lowering::new(hir, types, sources) };
    within_limits(lowering.with_texts(texts), mission)
}

/// A program that a machine can hold, and whose ticks end in time.
fn within_limits(lowering: Lowering<'_>, mission: usize) -> Result<Lowered, Vec<Diagnostic>> {
    let (hir, types, sources) = (lowering.hir, lowering.types, lowering.sources);
    // Steps first: they are counted without any code.
    if let Some(finding) = limits::steps(hir, types, sources, mission) {
        return Err(vec![finding]);
    }
    let lowered = lowering.whole(mission)?;
    let findings = limits::size(hir, sources, mission, &lowered);
    if !findings.is_empty() {
        return Err(findings);
    }
    // What the checker has let through is looked through again, in every test.
    debug_assert_eq!(lowered.program.verify(), Ok(()));
    debug_assert_eq!(lowered.program.verify_ranges(&lowered.claims), Ok(()));
    Ok(lowered)
}

impl<'a> Lowering<'a> {
    fn new(hir: &'a Hir, types: &'a TypeTable, sources: &'a Sources) -> Self {
        Lowering {
            hir,
            types,
            sources,
            program: Program::default(),
            claims: Claims::default(),
            origin: None,
            fns: BTreeMap::new(),
            units: BTreeMap::new(),
            activities: BTreeMap::new(),
            vars: &[],
            frame: Frame::default(),
            findings: Vec::new(),
            mission_args: None,
            constants_at: None,
            constants: BTreeMap::new(),
            texts: BTreeMap::new(),
            emitted: 0,
        }
    }

    /// The texts without holes of another program keep their places, so that a text of it is the same here.
    fn with_texts(mut self, known: &BTreeMap<String, u32>) -> Self {
        let places = known.values().max().map_or(0, |last| *last as usize + 1);
        self.program.texts.resize(places, Text { parts: Vec::new() });
        for (text, place) in known {
            self.program.texts[*place as usize].parts.push(TextPart::Literal(text.clone()));
        }
        self.texts.clone_from(known);
        self
    }

    /// A mission with what it is made of.
    fn whole(mut self, mission: usize) -> Result<Lowered, Vec<Diagnostic>> {
        let words = self.mission(mission);
        if !self.findings.is_empty() {
            return Err(self.findings);
        }
        Ok(Lowered {
            program: self.program,
            texts: self.texts,
            claims: self.claims,
            words,
            instructions: self.emitted,
            units: self.units.into_iter().map(|(id, unit)| (id, (unit.words, unit.ops))).collect(),
            fns: self.fns.into_iter().map(|(id, code)| (id, code.ops)).collect(),
            activities: self.activities,
        })
    }

    fn emit(&mut self, op: impl Into<Op>) -> Addr {
        self.emitted += 1;
        // With room for the terms of a condition, which are counted while they are made.
        if self.emitted <= 2 * INSTRUCTIONS_MAX as u64 {
            self.program.ops.push(op.into());
        }
        self.program.ops.len() as Addr - 1
    }

    fn here(&self) -> Addr {
        self.program.ops.len() as Addr
    }

    /// Makes a jump that was emitted before its target was known lead here.
    fn land(&mut self, jump: Addr) {
        let here = self.here();
        if let Some(to) = self.program.ops.get_mut(jump as usize).and_then(Op::jump_mut) {
            *to = here;
        }
    }

    /// Words that live as long as the frame.
    fn lasting(&mut self, words: u32) -> Slot {
        self.lasting_frame(u64::from(words))
    }

    /// The same for the frame of something that is called, which may be larger than any program can hold.
    fn lasting_frame(&mut self, words: u64) -> Slot {
        let at = self.frame.lasting;
        self.frame.lasting = at.saturating_add(words);
        slot(at)
    }

    /// Words that live to the end of the statement.
    fn temp(&mut self, words: u32) -> Slot {
        self.temp_frame(u64::from(words))
    }

    /// The same for the frame of a function.
    fn temp_frame(&mut self, words: u64) -> Slot {
        let at = self.frame.temp_base.saturating_add(self.frame.temp);
        self.frame.temp = self.frame.temp.saturating_add(words);
        self.frame.temp_most = self.frame.temp_most.max(self.frame.temp);
        slot(at)
    }

    /// Frees the temporaries of what is done inside.
    fn scratch<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let temp = self.frame.temp;
        let result = work(self);
        self.frame.temp = temp;
        result
    }

    /// Lowers a unit twice, the second time with temporaries after all that lives on. Gives the words of its frame.
    fn twice(&mut self, vars: &'a [hir::Var], work: impl Fn(&mut Self)) -> u64 {
        let outer = std::mem::take(&mut self.frame);
        let outer_vars = std::mem::replace(&mut self.vars, vars);
        // Callees must be complete before the first pass, so that both passes emit the same: the first pass lowers them.
        let mut temp_base = 0;
        let begin = self.here();
        for pass in 0..2 {
            let mark = self.mark();
            self.frame = Frame { temp_base, ..Frame::default() };
            for var in vars {
                let at = self.lasting(self.words(&var.ty));
                self.frame.vars.push(at);
            }
            work(self);
            temp_base = self.frame.lasting;
            if pass == 0 {
                self.back_to(&mark);
            }
        }
        let words = self.frame.lasting.saturating_add(self.frame.temp_most);
        let slots = std::mem::replace(&mut self.frame, outer).vars;
        self.vars = outer_vars;
        self.claim_unit(begin, words, vars, &slots);
        words
    }

    /// What the first pass adds after its callees is taken back. Callees are lowered ahead of their caller's first
    /// operation, in `prepare`, so nothing of theirs is lost.
    fn mark(&self) -> Mark {
        let p = &self.program;
        Mark {
            ops: p.ops.len(),
            activities: p.activities.len(),
            calls: p.calls.len(),
            overlays: p.overlays.len(),
            rules: p.rules.len(),
            recordings: p.recordings.len(),
            reports: p.reports.len(),
            statements: p.statements.len(),
            texts: p.texts.len(),
            memories: p.memories.len(),
            areas: p.mission.areas.len(),
            findings: self.findings.len(),
            typed: self.claims.typed.len(),
            emitted: self.emitted,
        }
    }

    fn back_to(&mut self, mark: &Mark) {
        let p = &mut self.program;
        p.ops.truncate(mark.ops);
        p.activities.truncate(mark.activities);
        p.calls.truncate(mark.calls);
        p.overlays.truncate(mark.overlays);
        p.rules.truncate(mark.rules);
        p.recordings.truncate(mark.recordings);
        p.reports.truncate(mark.reports);
        p.statements.truncate(mark.statements);
        // Each by itself: to look through all would take the more the more activities a mission has.
        for text in p.texts.drain(mark.texts..) {
            if let [TextPart::Literal(text)] = text.parts.as_slice() {
                self.texts.remove(text);
            }
        }
        p.memories.truncate(mark.memories);
        p.mission.areas.truncate(mark.areas);
        self.findings.truncate(mark.findings);
        self.claims.typed.truncate(mark.typed);
        self.emitted = mark.emitted;
    }

    /// What has no type has been reported, and is not lowered. Where it was not, nothing that is known by types holds of the program.
    fn must_have_type(&mut self, e: &hir::Expr) {
        if e.ty == Type::Unknown {
            let finding = Diagnostic::error(Code::TypesEmpty, e.span, "the type of this cannot be told");
            self.findings.push(finding.help("give it a name with its type: `let x: TYPE = …`"));
        }
    }

    /// The frame's origin: the middle of the geodetic positions that the mission's area is made of.
    fn place(&mut self, span: Span, latitude_deg: f64, longitude_deg: f64) -> Point {
        let position = Geodetic::from_degrees(latitude_deg, longitude_deg);
        match self.origin {
            Some(origin) => TangentFrame { origin }.to_point(position),
            None => {
                self.findings.push(
                    Diagnostic::error(
                        Code::MissionsOrigin,
                        span,
                        "this place on the globe lies nowhere in the mission's frame",
                    )
                    .here("a position on the globe")
                    .help(
                        "give the mission an `area` with a position on the globe, or write `point(north: …, east: …)`",
                    ),
                );
                Point::ORIGIN
            }
        }
    }

    /// Input blocks come first in the words of a run, then constants.
    fn inputs(&mut self) {
        for input in &self.hir.inputs {
            let fields = input.fields.iter().map(|(_, ty)| self.words(ty));
            let width = fields.fold(self.words(&input.ty), u32::saturating_add).min(WORDS_MAX);
            let shape = self.types.shape(&input.ty);
            let fields = input.fields.iter().map(|(_, ty)| self.types.shape(ty)).collect();
            self.program.inputs.push(Input { name: input.name.clone(), at: 0, width, kept: 0, shape, fields });
        }
    }

    /// `hits` may need more samples than were kept: the blocks are laid out before any code, so the most is taken first.
    fn keep_samples(&mut self, mission: usize) {
        let mut kept = vec![0; self.hir.inputs.len()];
        for id in self.hir.called_from(mission) {
            watch::samples_counted(&self.hir.activities[id], &mut kept);
        }
        let mut at = 0;
        for (input, kept) in self.program.inputs.iter_mut().zip(kept) {
            input.kept = kept;
            input.at = slot(at);
            at += u64::from(input.words());
        }
    }

    /// The absolute slot of a constant, the same for the same bits; none where there is no room.
    fn constant(&mut self, value: f64) -> Option<Slot> {
        let at = self.constants_at?;
        let index = *self.constants.entry(value.to_bits()).or_insert_with(|| {
            self.program.constants.push(value);
            self.program.constants.len() as Slot - 1
        });
        Some(ABSOLUTE | (at + index))
    }

    fn input_words(&self) -> u64 {
        self.program.inputs.iter().map(|input| u64::from(input.words())).sum()
    }

    fn shape(&self, ty: &crate::types::Type) -> Shape {
        self.types.shape(ty)
    }

    fn words(&self, ty: &crate::types::Type) -> u32 {
        self.types.words(ty)
    }
}

/// How far the tables of a program went.
struct Mark {
    ops: usize,
    activities: usize,
    calls: usize,
    overlays: usize,
    rules: usize,
    recordings: usize,
    reports: usize,
    statements: usize,
    texts: usize,
    memories: usize,
    areas: usize,
    findings: usize,
    typed: usize,
    emitted: u64,
}

/// A place in a frame. What no program can hold has a place all the same, until it is refused.
fn slot(at: u64) -> Slot {
    at.min(u64::from(WORDS_MAX)) as Slot
}
