//! The instructions that need nothing but words: most of what a tick executes.
//!
//! They are apart from the others so that words and frame are found once for a row of instructions, and not anew for every
//! operand.

use crate::execute::truth;
use crate::trig::Trig;
use albacore_arithmetic::{
    Abs, Add, AddInt, Ceil, Cos, Div, Dot, Floor, Length, Max, Min, Mul, MulInt, Neg, Operation, Pow, Round, Sin, Sqrt,
    Sub, SubInt, Ticks, WrapAngle, WrapHeading, bounded,
};
use albacore_geometry::{Edge, Line, Point, Vector};
use albacore_program::{ABSOLUTE, AREA_CORNER_WORDS, Op, Slot, header};

/// The words of a run, as code with a frame's base sees them.
pub(crate) struct Frame<'a> {
    pub words: &'a mut [f64],
    pub base: Slot,
}

/// Where a slot of a frame is among all words.
#[inline]
pub(crate) fn place(slot: Slot, base: Slot) -> Slot {
    if slot & ABSOLUTE == 0 { slot + base } else { slot & !ABSOLUTE }
}

impl Frame<'_> {
    #[inline]
    fn at(&self, slot: Slot) -> usize {
        place(slot, self.base) as usize
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

    fn age(&self, owner: Slot) -> f64 {
        self.get(owner + header::AGE)
    }
}

#[inline]
fn dot(a: Vector, b: Vector) -> f64 {
    Dot::execute([a.north, a.east, b.north, b.east])
}

/// Executes instructions up to the first that needs more than words, and gives its address.
pub(crate) fn compute(ops: &[Op], f: &mut Frame, trig: &mut Trig, from: usize) -> usize {
    let mut pc = from;
    while let Some(&op) = ops.get(pc) {
        match op {
            Op::Const { to, value } => f.set(to, value),
            Op::Copy { to, from } => f.set(to, f.get(from)),
            Op::CopyMany { to, from, words } => f.copy(to, from, words),
            Op::Clear { to, words } => f.clear(to, words),

            Op::Add { to, a, b: c } => f.set(to, Add::execute([f.get(a), f.get(c)])),
            Op::Sub { to, a, b: c } => f.set(to, Sub::execute([f.get(a), f.get(c)])),
            Op::Mul { to, a, b: c } => f.set(to, Mul::execute([f.get(a), f.get(c)])),
            Op::Div { to, a, b: c } => f.set(to, Div::execute([f.get(a), f.get(c)])),
            Op::Quotient { to, a, b: c } => {
                let operands = [f.get(a), f.get(c)];
                f.set(to, truth(operands[1] != 0.0));
                f.set(to + 1, Div::execute(operands));
            }
            Op::AddInt { to, a, b: c } => f.set(to, AddInt::execute([f.get(a), f.get(c)])),
            Op::SubInt { to, a, b: c } => f.set(to, SubInt::execute([f.get(a), f.get(c)])),
            Op::MulInt { to, a, b: c } => f.set(to, MulInt::execute([f.get(a), f.get(c)])),
            Op::Min { to, a, b: c } => f.set(to, Min::execute([f.get(a), f.get(c)])),
            Op::Max { to, a, b: c } => f.set(to, Max::execute([f.get(a), f.get(c)])),
            Op::Pow { to, a, b: c } => f.set(to, Pow::execute([f.get(a), f.get(c)])),
            Op::Neg { to, a } => f.set(to, Neg::execute([f.get(a)])),
            Op::Abs { to, a } => f.set(to, Abs::execute([f.get(a)])),
            Op::Sqrt { to, a } => f.set(to, Sqrt::execute([f.get(a)])),
            Op::Floor { to, a } => f.set(to, Floor::execute([f.get(a)])),
            Op::Ceil { to, a } => f.set(to, Ceil::execute([f.get(a)])),
            Op::Round { to, a } => f.set(to, Round::execute([f.get(a)])),
            Op::Sin { to, a } => f.set(to, Sin::execute([f.get(a)])),
            Op::Cos { to, a } => f.set(to, Cos::execute([f.get(a)])),
            Op::WrapHeading { to, a } => f.set(to, WrapHeading::execute([f.get(a)])),
            Op::WrapAngle { to, a } => f.set(to, WrapAngle::execute([f.get(a)])),
            Op::Ticks { to, a } => f.set(to, Ticks::execute([f.get(a)])),

            Op::Lt { to, a, b: c } => f.set(to, truth(f.get(a) < f.get(c))),
            Op::Le { to, a, b: c } => f.set(to, truth(f.get(a) <= f.get(c))),
            Op::Eq { to, a, b: c, words } => {
                let equal = f.slice(a, words) == f.slice(c, words);
                f.set(to, truth(equal));
            }
            Op::Not { to, a } => f.set(to, truth(f.get(a) == 0.0)),
            Op::And { to, a, b: c } => f.set(to, truth(f.get(a) != 0.0 && f.get(c) != 0.0)),
            Op::Or { to, a, b: c } => f.set(to, truth(f.get(a) != 0.0 || f.get(c) != 0.0)),

            Op::AddVector { to, a, b: c } => f.set_vector(to, f.vector(a) + f.vector(c)),
            Op::SubVector { to, a, b: c } => f.set_vector(to, f.vector(a) - f.vector(c)),
            Op::Scale { to, vector, by } => f.set_vector(to, f.get(by) * f.vector(vector)),
            Op::Toward { to, length, heading } => {
                let v = f.get(length) * trig.unit(f.get(heading));
                f.set_vector(to, v);
            }
            Op::Direction { to, vector } => {
                let direction = trig.toward(f.vector(vector));
                f.set(to, direction);
            }
            Op::Length { to, vector } => f.set(to, Length::execute([f.get(vector), f.get(vector + 1)])),
            Op::Dot { to, a, b: c } => f.set(to, dot(f.vector(a), f.vector(c))),
            Op::Along { to, vector, heading } => {
                let along = dot(f.vector(vector), trig.unit(f.get(heading)));
                f.set(to, along);
            }

            // An edge is a point, the next point, and the normal.
            Op::EdgeAt { to, area, index } => {
                let (corner, corners) = (f.get(index) as u32, f.get(area) as u32);
                let next = if corner + 1 < corners { corner + 1 } else { 0 };
                let (here, there) = (area + 1 + AREA_CORNER_WORDS * corner, area + 1 + AREA_CORNER_WORDS * next);
                f.copy(to, here, 2);
                f.copy(to + 2, there, 2);
                f.copy(to + 4, here + 2, 2);
            }
            Op::EdgeGap { to, edge, point } => {
                let line = Line { start: f.point(edge), end: f.point(edge + 2) };
                let gap = Edge { line, normal: f.vector(edge + 4) }.gap(f.point(point));
                f.set(to, bounded(gap));
            }

            Op::HeldFor { to, x, since, ticks, owner } => {
                let age = f.age(owner);
                let holds = f.get(x) != 0.0;
                let began = match (holds, f.get(since)) {
                    (false, _) => -1.0,
                    (true, since) if since < 0.0 => age,
                    (true, since) => since,
                };
                f.set(since, began);
                f.set(to, truth(holds && age - began >= f.get(ticks)));
            }
            Op::Becomes { to, x, before } => {
                let holds = f.get(x) != 0.0;
                f.set(to, truth(holds && f.get(before) == 0.0));
                f.set(before, truth(holds));
            }
            Op::Elapsed { to, from, ticks, owner } => {
                let elapsed = f.age(owner) - f.get(from) >= f.get(ticks);
                f.set(to, truth(elapsed));
            }
            Op::Now { to, owner } => f.set(to, f.age(owner)),

            Op::Jump { to } => {
                pc = to as usize;
                continue;
            }
            Op::JumpIf { if_, to } => {
                if f.get(if_) != 0.0 {
                    pc = to as usize;
                    continue;
                }
            }
            Op::JumpUnless { unless, to } => {
                if f.get(unless) == 0.0 {
                    pc = to as usize;
                    continue;
                }
            }
            Op::JumpIfLess { a, b: c, to } => {
                if f.get(a) < f.get(c) {
                    pc = to as usize;
                    continue;
                }
            }
            Op::JumpUnlessLess { a, b: c, to } => {
                let less = f.get(a) < f.get(c);
                if !less {
                    pc = to as usize;
                    continue;
                }
            }
            Op::JumpIfAtMost { a, b: c, to } => {
                if f.get(a) <= f.get(c) {
                    pc = to as usize;
                    continue;
                }
            }
            Op::JumpUnlessAtMost { a, b: c, to } => {
                let at_most = f.get(a) <= f.get(c);
                if !at_most {
                    pc = to as usize;
                    continue;
                }
            }

            _ => return pc,
        }
        pc += 1;
    }
    pc
}
