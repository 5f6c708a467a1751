//! The instructions that need nothing but words: most of what a tick executes.
//!
//! They are apart from the others so that words and frame are found once for a row of instructions, and not anew for every
//! operand.

use crate::execute::truth;
use crate::trig::Trig;
use albacore_arithmetic::{Div, Dot, Operation, bounded};
use albacore_geometry::{Edge, Line, Point, Vector};
use albacore_program::{ABSOLUTE, AREA_CORNER_WORDS, Compute, Op, Slot, When, header};

/// The words of a run, as code sees them.
pub(crate) struct Frame<'a, O> {
    pub words: &'a mut [f64],
    pub operands: O,
}

/// How operands say which words they are.
pub(crate) trait Operands: Copy {
    /// Where a slot is among all words.
    fn at(self, slot: Slot) -> usize;
}

/// From the base of a frame on.
#[derive(Clone, Copy)]
pub(crate) struct OfFrame(pub Slot);

/// From the first word of the run on: of code that is bound to its frame.
#[derive(Clone, Copy)]
pub(crate) struct OfRun;

impl Operands for OfFrame {
    #[inline]
    fn at(self, slot: Slot) -> usize {
        place(slot, self.0) as usize
    }
}

impl Operands for OfRun {
    #[inline]
    fn at(self, slot: Slot) -> usize {
        slot as usize
    }
}

/// Where a slot of a frame is among all words.
#[inline]
pub(crate) fn place(slot: Slot, base: Slot) -> Slot {
    if slot & ABSOLUTE == 0 { slot + base } else { slot & !ABSOLUTE }
}

impl<O: Operands> Frame<'_, O> {
    #[inline]
    fn at(&self, slot: Slot) -> usize {
        self.operands.at(slot)
    }

    #[inline]
    fn get(&self, slot: Slot) -> f64 {
        self.words[self.at(slot)]
    }

    #[inline]
    fn set(&mut self, slot: Slot, value: f64) {
        let at = self.at(slot);
        self.words[at] = value;
    }

    fn slice(&self, slot: Slot, words: u32) -> &[f64] {
        let at = self.at(slot);
        &self.words[at..at + words as usize]
    }

    fn clear(&mut self, slot: Slot, words: u32) {
        let at = self.at(slot);
        self.words[at..at + words as usize].fill(0.0);
    }

    #[inline]
    fn copy(&mut self, to: Slot, from: Slot, words: u32) {
        // Most are points and vectors: two words are copied sooner than a copy of any length is called.
        if words == 2 {
            let (a, b) = (self.get(from), self.get(from + 1));
            self.set(to, a);
            self.set(to + 1, b);
        } else {
            let (to, from) = (self.at(to), self.at(from));
            self.words.copy_within(from..from + words as usize, to);
        }
    }

    fn point(&self, slot: Slot) -> Point {
        Point::ORIGIN + self.vector(slot)
    }

    #[inline]
    fn vector(&self, slot: Slot) -> Vector {
        Vector::new(self.get(slot), self.get(slot + 1))
    }

    #[inline]
    fn set_vector(&mut self, slot: Slot, v: Vector) {
        self.set(slot, bounded(v.north));
        self.set(slot + 1, bounded(v.east));
    }

    #[inline]
    fn age(&self, owner: Slot) -> f64 {
        self.get(owner + header::AGE)
    }

    /// The edge of an index. An edge is a point, the next point, and the normal.
    fn edge_at(&mut self, to: Slot, area: Slot, index: Slot) {
        let (corner, corners) = (self.get(index) as u32, self.get(area) as u32);
        let next = if corner + 1 < corners { corner + 1 } else { 0 };
        let (here, there) = (area + 1 + AREA_CORNER_WORDS * corner, area + 1 + AREA_CORNER_WORDS * next);
        self.copy(to, here, 2);
        self.copy(to + 2, there, 2);
        self.copy(to + 4, here + 2, 2);
    }

    fn edge_gap(&mut self, to: Slot, edge: Slot, point: Slot) {
        let line = Line { start: self.point(edge), end: self.point(edge + 2) };
        let gap = Edge { line, normal: self.vector(edge + 4) }.gap(self.point(point));
        self.set(to, bounded(gap));
    }

    #[inline]
    fn held_for(&mut self, to: Slot, x: Slot, since: Slot, age: f64, ticks: f64) {
        let holds = self.get(x) != 0.0;
        let began = match (holds, self.get(since)) {
            (false, _) => -1.0,
            (true, since) if since < 0.0 => age,
            (true, since) => since,
        };
        self.set(since, began);
        self.set(to, truth(holds && age - began >= ticks));
    }

    #[inline]
    fn becomes(&mut self, to: Slot, x: Slot, before: Slot) {
        let holds = self.get(x) != 0.0;
        self.set(to, truth(holds && self.get(before) == 0.0));
        self.set(before, truth(holds));
    }

    #[inline]
    fn jumps(&self, when: When) -> bool {
        let less = |a, b| self.get(a) < self.get(b);
        let at_most = |a, b| self.get(a) <= self.get(b);
        match when {
            When::Always => true,
            When::True(word) => self.get(word) != 0.0,
            When::False(word) => self.get(word) == 0.0,
            When::Less(a, b) => less(a, b),
            When::NotLess(a, b) => !less(a, b),
            When::AtMost(a, b) => at_most(a, b),
            When::NotAtMost(a, b) => !at_most(a, b),
        }
    }
}

#[inline]
fn dot(a: Vector, b: Vector) -> f64 {
    Dot::execute([a.north, a.east, b.north, b.east])
}

/// Executes instructions up to the first that needs more than words, and gives its address.
#[inline]
pub(crate) fn compute<O: Operands>(ops: &[Op], f: &mut Frame<O>, trig: &mut Trig, from: usize) -> usize {
    let mut pc = from;
    while let Some(Op::Compute(op)) = ops.get(pc) {
        pc += 1;
        match *op {
            Compute::Const { to, value } => f.set(to, value),
            Compute::Copy { to, from } => f.set(to, f.get(from)),
            Compute::CopyMany { to, from, words } => f.copy(to, from, words),
            Compute::Clear { to, words } => f.clear(to, words),

            Compute::One { operator, to, a } => f.set(to, operator.execute(&[f.get(a)])),
            Compute::Two { operator, to, a, b } => f.set(to, operator.execute(&[f.get(a), f.get(b)])),
            Compute::Quotient { to, a, b } => {
                let operands = [f.get(a), f.get(b)];
                f.set(to, truth(operands[1] != 0.0));
                f.set(to + 1, Div::execute(operands));
            }

            Compute::Lt { to, a, b } => f.set(to, truth(f.get(a) < f.get(b))),
            Compute::Le { to, a, b } => f.set(to, truth(f.get(a) <= f.get(b))),
            Compute::Eq { to, a, b, words } => f.set(to, truth(f.slice(a, words) == f.slice(b, words))),
            Compute::Not { to, a } => f.set(to, truth(f.get(a) == 0.0)),
            Compute::And { to, a, b } => f.set(to, truth(f.get(a) != 0.0 && f.get(b) != 0.0)),
            Compute::Or { to, a, b } => f.set(to, truth(f.get(a) != 0.0 || f.get(b) != 0.0)),

            Compute::AddVector { to, a, b } => f.set_vector(to, f.vector(a) + f.vector(b)),
            Compute::SubVector { to, a, b } => f.set_vector(to, f.vector(a) - f.vector(b)),
            Compute::Scale { to, vector, by } => f.set_vector(to, f.get(by) * f.vector(vector)),
            Compute::Toward { to, length, heading } => {
                let v = f.get(length) * trig.unit(f.get(heading));
                f.set_vector(to, v);
            }
            Compute::Direction { to, vector } => f.set(to, trig.toward(f.vector(vector))),
            Compute::Dot { to, a, b } => f.set(to, dot(f.vector(a), f.vector(b))),
            Compute::Along { to, vector, heading } => f.set(to, dot(f.vector(vector), trig.unit(f.get(heading)))),
            Compute::EdgeAt { to, area, index } => f.edge_at(to, area, index),
            Compute::EdgeGap { to, edge, point } => f.edge_gap(to, edge, point),

            Compute::HeldFor { to, x, since, ticks, owner } => f.held_for(to, x, since, f.age(owner), f.get(ticks)),
            Compute::Becomes { to, x, before } => f.becomes(to, x, before),
            Compute::Elapsed { to, from, ticks, owner } => {
                f.set(to, truth(f.age(owner) - f.get(from) >= f.get(ticks)));
            }
            Compute::Now { to, owner } => f.set(to, f.age(owner)),

            Compute::Jump { to, when } => {
                if f.jumps(when) {
                    pc = to as usize;
                }
            }
        }
    }
    pc
}
