//! From the checked program to the machine's: names become slots, types vanish, every frame gets its place.
//!
//! Each declaration at the left margin, with the behaviors nested in it, is a *unit* with one frame: first what lives on,
//! then temporaries. A unit is lowered twice: the first time only to learn how much lives on. Callees come before callers,
//! so that the place of every frame inside its caller's is known.

mod activity;
mod condition;
mod control;
mod expr;
mod inline;
mod loops;
mod prepare;
mod scenario;
mod stmt;
mod table;
mod test;
mod watch;

pub use test::{ExpectProgram, TestProgram, TestSlots, test};

pub use scenario::{ScenarioArg, ScenarioClause, ScenarioProgram, ScenarioValue, scenario};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Hir};
use crate::source::{Sources, Span};
use crate::types::TypeTable;
use albacore_geometry::{Geodetic, Point, TangentFrame};
use albacore_program::{ABSOLUTE, Addr, Input, Op, Program, Shape, Slot};
use std::collections::BTreeMap;

/// Where the frame about an area touches the globe: in the middle of the positions that it is made of.
pub fn origin_of(area: &hir::Expr) -> Option<Geodetic> {
    let mut found = Vec::new();
    watch::positions(area, &mut found);
    activity::middle(&found)
}

/// A run's words at most: a program that needs more is refused.
const WORDS_MAX: u32 = 4_000_000;

/// A lowered function.
#[derive(Clone, Copy)]
struct FnCode {
    entry: Addr,
    result: Slot,
    words: u32,
    /// How many instructions it has.
    ops: u32,
}

/// The subroutine that puts an ordered list in order.
#[derive(Clone)]
struct Sorter {
    entry: Addr,
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
    words: u32,
}

/// Lowers one mission and what it needs.
struct Lowering<'a> {
    hir: &'a Hir,
    types: &'a TypeTable,
    sources: &'a Sources,
    program: Program,
    origin: Option<Geodetic>,
    fns: BTreeMap<usize, FnCode>,
    units: BTreeMap<usize, UnitCode>,
    /// The names of what is being lowered, outermost first.
    path: Vec<String>,
    frame: Frame,
    findings: Vec<Diagnostic>,
    /// What a test gives the mission in place of its defaults.
    mission_args: Option<&'a [hir::Expr]>,
    /// Where constants have their absolute slots: only a mission has room for them.
    constants_at: Option<Slot>,
}

/// The frame of the unit that is being lowered.
#[derive(Clone, Default)]
struct Frame {
    /// Where each variable is.
    vars: Vec<Slot>,
    /// Words that live on, so far.
    lasting: u32,
    /// Where temporaries begin.
    temp_base: u32,
    /// The temporaries in use, and the most there were.
    temp: u32,
    temp_most: u32,
    /// The values of temporal operators, by the address of their node.
    timers: BTreeMap<usize, Slot>,
    /// The header of the activity whose code is being lowered, and its result.
    header: Slot,
    result: Slot,
    /// The overlays of the activity whose code is being lowered: of its statements, innermost first, and of its
    /// declarations.
    overlays: Vec<u32>,
    declared_overlays: Vec<u32>,
    /// In a guard: whether the body has come to its end.
    done: bool,
    /// The subroutine that sorts a variable that is an ordered list.
    sorters: BTreeMap<usize, Sorter>,
}

/// Lowers a mission. The findings are errors that only the whole program shows.
pub fn mission(hir: &Hir, types: &TypeTable, sources: &Sources, mission: usize) -> Result<Program, Vec<Diagnostic>> {
    mission_with(hir, types, sources, mission, None)
}

/// Lowers a mission, and tells the words of each activity's frame, with those of what it calls.
pub fn mission_units(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    mission: usize,
) -> Result<(Program, BTreeMap<usize, u32>), Vec<Diagnostic>> {
    let mut lowering = Lowering::new(hir, types, sources);
    lowering.mission(mission);
    if !lowering.findings.is_empty() {
        return Err(lowering.findings);
    }
    Ok((lowering.program, lowering.units.into_iter().map(|(id, unit)| (id, unit.words)).collect()))
}

/// Lowers the mission that is a line of the prompt, in the frame of the vehicle that it drives.
pub fn line(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    mission: usize,
    origin: Option<Geodetic>,
) -> Result<Program, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(hir, types, sources);
    lowering.origin = origin;
    lowering.mission(mission);
    if lowering.findings.is_empty() { Ok(lowering.program) } else { Err(lowering.findings) }
}

/// The same with arguments in place of the parameters' defaults.
fn mission_with(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    mission: usize,
    args: Option<&[hir::Expr]>,
) -> Result<Program, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(hir, types, sources);
    lowering.mission_args = args;
    lowering.mission(mission);
    if lowering.findings.is_empty() { Ok(lowering.program) } else { Err(lowering.findings) }
}

impl<'a> Lowering<'a> {
    fn new(hir: &'a Hir, types: &'a TypeTable, sources: &'a Sources) -> Self {
        Lowering {
            hir,
            types,
            sources,
            program: Program::default(),
            origin: None,
            fns: BTreeMap::new(),
            units: BTreeMap::new(),
            path: Vec::new(),
            frame: Frame::default(),
            findings: Vec::new(),
            mission_args: None,
            constants_at: None,
        }
    }

    fn emit(&mut self, op: Op) -> Addr {
        self.program.ops.push(op);
        self.program.ops.len() as Addr - 1
    }

    fn here(&self) -> Addr {
        self.program.ops.len() as Addr
    }

    /// Makes a jump that was emitted before its target was known lead here.
    fn land(&mut self, jump: Addr) {
        let here = self.here();
        if let Some(
            Op::Jump { to }
            | Op::JumpIf { to, .. }
            | Op::JumpUnless { to, .. }
            | Op::JumpIfLess { to, .. }
            | Op::JumpUnlessLess { to, .. }
            | Op::JumpIfAtMost { to, .. }
            | Op::JumpUnlessAtMost { to, .. },
        ) = self.program.ops.get_mut(jump as usize)
        {
            *to = here;
        }
    }

    /// Words that live as long as the frame.
    fn lasting(&mut self, words: u32) -> Slot {
        let slot = self.frame.lasting;
        self.frame.lasting += words;
        slot
    }

    /// Words that live to the end of the statement.
    fn temp(&mut self, words: u32) -> Slot {
        let slot = self.frame.temp_base + self.frame.temp;
        self.frame.temp += words;
        self.frame.temp_most = self.frame.temp_most.max(self.frame.temp);
        slot
    }

    /// Frees the temporaries of what is done inside.
    fn scratch<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let temp = self.frame.temp;
        let result = work(self);
        self.frame.temp = temp;
        result
    }

    /// Lowers a unit twice, the second time with temporaries after all that lives on. Gives the words of its frame.
    fn twice(&mut self, vars: &[hir::Var], first: u32, work: impl Fn(&mut Self)) -> u32 {
        let outer = std::mem::take(&mut self.frame);
        // Callees must be complete before the first pass, so that both passes emit the same: the first pass lowers them.
        let mut temp_base = 0;
        for pass in 0..2 {
            let mark = self.mark();
            let mut frame = Frame { lasting: first, temp_base, ..Frame::default() };
            for var in vars {
                frame.vars.push(frame.lasting);
                frame.lasting += self.types.words(&var.ty);
            }
            self.frame = frame;
            work(self);
            temp_base = self.frame.lasting;
            if pass == 0 {
                self.back_to(&mark);
            }
        }
        let words = self.frame.lasting + self.frame.temp_most;
        self.frame = outer;
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
            reports: p.reports.len(),
            texts: p.texts.len(),
            memories: p.memories.len(),
            findings: self.findings.len(),
        }
    }

    fn back_to(&mut self, mark: &Mark) {
        let p = &mut self.program;
        p.ops.truncate(mark.ops);
        p.activities.truncate(mark.activities);
        p.calls.truncate(mark.calls);
        p.overlays.truncate(mark.overlays);
        p.rules.truncate(mark.rules);
        p.reports.truncate(mark.reports);
        p.texts.truncate(mark.texts);
        p.memories.truncate(mark.memories);
        self.findings.truncate(mark.findings);
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
        let mut at = 0;
        for input in &self.hir.inputs {
            let width =
                self.types.words(&input.ty) + input.fields.iter().map(|(_, ty)| self.types.words(ty)).sum::<u32>();
            let shape = self.types.shape(&input.ty);
            let lowered = Input { name: input.name.clone(), at, width, kept: 0, shape };
            at += lowered.words();
            self.program.inputs.push(lowered);
        }
    }

    /// `hits` may need more samples than were kept: the blocks are laid out before any code, so the most is taken first.
    fn keep_samples(&mut self) {
        let mut kept = vec![0; self.hir.inputs.len()];
        watch::samples_counted(self.hir, &mut kept);
        let mut at = 0;
        for (input, kept) in self.program.inputs.iter_mut().zip(kept) {
            input.kept = kept;
            input.at = at;
            at += input.words();
        }
    }

    /// The absolute slot of a constant, the same for the same bits; none where there is no room.
    fn constant(&mut self, value: f64) -> Option<Slot> {
        let at = self.constants_at?;
        let constants = &mut self.program.constants;
        let known = constants.iter().position(|known| known.to_bits() == value.to_bits());
        let index = known.unwrap_or_else(|| {
            constants.push(value);
            constants.len() - 1
        });
        Some(ABSOLUTE | (at + index as Slot))
    }

    fn input_words(&self) -> u32 {
        self.program.inputs.iter().map(Input::words).sum()
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
    reports: usize,
    texts: usize,
    memories: usize,
    findings: usize,
}
