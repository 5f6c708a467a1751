//! The instructions, one by one.

use crate::Event;
use crate::lists::Order;
use crate::state::Run;
use albacore_geometry::{Area, Heading, Point, math, wrap_angle};
use albacore_program::{ABSOLUTE, Addr, Channel, Op, Program, Slot, Text, TextPart, header, number};
use albacore_vehicle::{TICK_S, Vertical};

/// The largest number that arithmetic gives: its square is a number still.
const LARGEST: f64 = 1e150;

/// Why code stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// A piece of code came to its end.
    Return,
    /// The body gives the tick away, and goes on at this address.
    Yield(Addr),
    /// The body came to its end, or finished.
    End,
    /// The mission is aborted: [`Run::abort`] says why.
    Abort,
}

/// Code that needs no vehicle, such as that of a scenario or of a test's expectations, with the words it works on.
pub struct Evaluation {
    run: Run,
}

impl Evaluation {
    /// Words of a program, all zero.
    pub fn new(program: &Program) -> Self {
        Evaluation { run: Run::new(program) }
    }

    /// Runs a piece of code.
    pub fn run(&mut self, program: &Program, entry: Addr) {
        self.run.execute(program, entry, 0);
    }

    /// Words from a slot on.
    pub fn words(&self, slot: Slot, words: u32) -> &[f64] {
        self.run.slice(slot, words)
    }

    /// Sets words from a slot on.
    pub fn set(&mut self, slot: Slot, words: &[f64]) {
        self.run.state.words[slot as usize..slot as usize + words.len()].copy_from_slice(words);
    }
}

impl Run {
    /// Runs code with a frame's base until it stops.
    #[inline]
    pub fn execute(&mut self, p: &Program, entry: Addr, base: Slot) -> Flow {
        // Much of what an activity may have is empty: no signals, no reactions, no timers.
        if let Some(Op::Return) = p.ops.get(entry as usize) {
            return Flow::Return;
        }
        self.execute_all(p, entry, base)
    }

    fn execute_all(&mut self, p: &Program, entry: Addr, base: Slot) -> Flow {
        let mut pc = entry as usize;
        let b = |slot: Slot| if slot & ABSOLUTE == 0 { slot + base } else { slot & !ABSOLUTE };
        loop {
            let op = p.ops[pc];
            pc += 1;
            match op {
                Op::Const { to, value } => self.set(b(to), value),
                Op::Copy { to, from } => self.set(b(to), self.get(b(from))),
                Op::CopyMany { to, from, words } => self.copy(b(to), b(from), words),
                Op::Clear { to, words } => self.state.words[b(to) as usize..(b(to) + words) as usize].fill(0.0),

                Op::Add { to, a, b: c } => self.set(b(to), bounded(self.get(b(a)) + self.get(b(c)))),
                Op::Sub { to, a, b: c } => self.set(b(to), bounded(self.get(b(a)) - self.get(b(c)))),
                Op::Mul { to, a, b: c } => self.set(b(to), bounded(self.get(b(a)) * self.get(b(c)))),
                Op::Div { to, a, b: c } => {
                    let divisor = self.get(b(c));
                    self.set(b(to), if divisor == 0.0 { 0.0 } else { bounded(self.get(b(a)) / divisor) });
                }
                Op::Min { to, a, b: c } => self.set(b(to), self.get(b(a)).min(self.get(b(c)))),
                Op::Max { to, a, b: c } => self.set(b(to), self.get(b(a)).max(self.get(b(c)))),
                Op::Pow { to, a, b: c } => self.set(b(to), bounded(math::pow(self.get(b(a)), self.get(b(c))))),
                Op::Neg { to, a } => self.set(b(to), math::canonical_zero(-self.get(b(a)))),
                Op::Abs { to, a } => self.set(b(to), self.get(b(a)).abs()),
                Op::Sqrt { to, a } => self.set(b(to), self.get(b(a)).max(0.0).sqrt()),
                Op::Floor { to, a } => self.set(b(to), self.get(b(a)).floor()),
                Op::Ceil { to, a } => self.set(b(to), self.get(b(a)).ceil()),
                Op::Round { to, a } => self.set(b(to), self.get(b(a)).round()),
                Op::Sin { to, a } => self.set(b(to), math::sin(self.get(b(a)))),
                Op::Cos { to, a } => self.set(b(to), math::cos(self.get(b(a)))),
                Op::WrapHeading { to, a } => self.set(b(to), Heading::from_radians(self.get(b(a))).radians()),
                Op::WrapAngle { to, a } => self.set(b(to), wrap_angle(self.get(b(a)))),
                Op::Ticks { to, a } => self.set(b(to), ticks(self.get(b(a)))),

                Op::Lt { to, a, b: c } => self.set(b(to), truth(self.get(b(a)) < self.get(b(c)))),
                Op::Le { to, a, b: c } => self.set(b(to), truth(self.get(b(a)) <= self.get(b(c)))),
                Op::Eq { to, a, b: c, words } => {
                    let equal = self.slice(b(a), words) == self.slice(b(c), words);
                    self.set(b(to), truth(equal));
                }
                Op::Not { to, a } => self.set(b(to), truth(self.get(b(a)) == 0.0)),
                Op::And { to, a, b: c } => self.set(b(to), truth(self.get(b(a)) != 0.0 && self.get(b(c)) != 0.0)),
                Op::Or { to, a, b: c } => self.set(b(to), truth(self.get(b(a)) != 0.0 || self.get(b(c)) != 0.0)),

                Op::AddVector { to, a, b: c } => self.set_vector(b(to), self.vector(b(a)) + self.vector(b(c))),
                Op::SubVector { to, a, b: c } => self.set_vector(b(to), self.vector(b(a)) - self.vector(b(c))),
                Op::Scale { to, vector, by } => self.set_vector(b(to), self.get(b(by)) * self.vector(b(vector))),
                Op::Toward { to, length, heading } => {
                    let v = self.get(b(length)) * self.trig.unit(self.get(b(heading)));
                    self.set_vector(b(to), v);
                }
                Op::Direction { to, vector } => {
                    let direction = self.trig.toward(self.vector(b(vector)));
                    self.set(b(to), direction);
                }
                Op::Length { to, vector } => self.set(b(to), bounded(self.vector(b(vector)).length())),
                Op::Dot { to, a, b: c } => self.set(b(to), bounded(self.vector(b(a)).dot(self.vector(b(c))))),
                Op::Along { to, vector, heading } => {
                    let along = self.vector(b(vector)).dot(self.trig.unit(self.get(b(heading))));
                    self.set(b(to), along);
                }

                Op::Rectangle { to, center, along, length, width } => {
                    let (length, width) = (self.get(b(length)), self.get(b(width)));
                    let area = Area::rectangle(self.point(b(center)), self.heading_at(b(along)), length, width).ok();
                    self.set_area(b(to), area.as_ref());
                }
                Op::Polygon { to, points, ok } => {
                    let count = self.get(b(points)) as u32;
                    let corners: Vec<Point> = (0..count).map(|i| self.point(b(points) + 1 + 2 * i)).collect();
                    let area = Area::polygon(&corners).ok();
                    self.set_area(b(to), area.as_ref());
                    self.set(b(ok), truth(area.is_some()));
                }
                Op::Center { to, area } => self.set_point(b(to), self.center(b(area))),
                Op::Gap { to, area, point } => self.set(b(to), self.gap(b(area), self.point(b(point)))),
                Op::Corner { to, area, heading, near } => {
                    let corner = self.farthest_corner(b(area), self.heading_at(b(heading)), self.point(b(near)));
                    self.set_point(b(to), corner);
                }
                Op::EdgeAt { to, area, index } => {
                    let edge = self.edge_of(b(area), self.get(b(index)) as u32);
                    self.set_edge(b(to), edge);
                }
                Op::RowAt { to, there, area, step, index } => {
                    let row = self.row_of(b(area), self.get(b(step)), self.get(b(index)) as u32);
                    self.set(b(there), truth(row.is_some()));
                    if let Some(row) = row {
                        self.set_line(b(to), row);
                    }
                }
                Op::NearestEdge { to, area, point } => {
                    let edge = self.nearest_edge(b(area), self.point(b(point)));
                    self.set_edge(b(to), edge);
                }
                Op::EdgeGap { to, edge, point } => self.set(b(to), self.edge(b(edge)).gap(self.point(b(point)))),
                Op::EdgeTangent { to, edge, heading } => {
                    let tangent = self.edge(b(edge)).tangent(self.heading_at(b(heading)));
                    self.set(b(to), tangent.radians());
                }
                Op::Exit { to, area, point, heading } => {
                    let exit = self.exit(b(area), self.point(b(point)), self.heading_at(b(heading)));
                    self.set_point(b(to), exit);
                }

                Op::Push { list, item, words, capacity } => self.push(b(list), b(item), words, capacity),
                Op::Sort { list, words, it, key, value, most } => {
                    let by = Order { it: b(it), key, value: b(value), most };
                    self.sort(p, base, b(list), words, by);
                }
                Op::PushSorted { list, item, words, capacity, sort } => {
                    self.push_sorted(p, b(list), b(item), words, capacity, (sort, base));
                }
                Op::Remove { list, item, words } => self.remove(b(list), b(item), words),
                Op::At { to, list, index, words } => self.element(b(to), b(list), b(index), words),
                Op::Top { to, list, count, words } => self.top(b(to), b(list), b(count), words),
                Op::Spread { to, list, heading } => {
                    let unit = self.trig.unit(self.get(b(heading)));
                    let spread = self.spread(b(list), unit);
                    self.set(b(to), spread);
                }

                Op::Age { to, input } => self.set(b(to), self.age_s(&p.inputs[input as usize])),
                Op::Hits { to, input, limit, of } => {
                    let hits = self.hits(&p.inputs[input as usize], self.get(b(limit)), of);
                    self.set(b(to), hits);
                }

                Op::HeldFor { to, x, since, ticks, owner } => {
                    let age = self.age(b(owner));
                    let holds = self.get(b(x)) != 0.0;
                    let began = match (holds, self.get(b(since))) {
                        (false, _) => -1.0,
                        (true, since) if since < 0.0 => age,
                        (true, since) => since,
                    };
                    self.set(b(since), began);
                    self.set(b(to), truth(holds && age - began >= self.get(b(ticks))));
                }
                Op::Becomes { to, x, before } => {
                    let holds = self.get(b(x)) != 0.0;
                    self.set(b(to), truth(holds && self.get(b(before)) == 0.0));
                    self.set(b(before), truth(holds));
                }
                Op::Elapsed { to, from, ticks, owner } => {
                    let elapsed = self.age(b(owner)) - self.get(b(from)) >= self.get(b(ticks));
                    self.set(b(to), truth(elapsed));
                }
                Op::Now { to, owner } => self.set(b(to), self.age(b(owner))),

                Op::Jump { to } => pc = to as usize,
                Op::JumpIf { if_, to } => {
                    if self.get(b(if_)) != 0.0 {
                        pc = to as usize;
                    }
                }
                Op::JumpUnless { unless, to } => {
                    if self.get(b(unless)) == 0.0 {
                        pc = to as usize;
                    }
                }
                Op::JumpIfLess { a, b: c, to } => {
                    if self.get(b(a)) < self.get(b(c)) {
                        pc = to as usize;
                    }
                }
                Op::JumpUnlessLess { a, b: c, to } => {
                    let less = self.get(b(a)) < self.get(b(c));
                    if !less {
                        pc = to as usize;
                    }
                }
                Op::JumpIfAtMost { a, b: c, to } => {
                    if self.get(b(a)) <= self.get(b(c)) {
                        pc = to as usize;
                    }
                }
                Op::JumpUnlessAtMost { a, b: c, to } => {
                    let at_most = self.get(b(a)) <= self.get(b(c));
                    if !at_most {
                        pc = to as usize;
                    }
                }
                Op::Call { code, base: frame } => _ = self.execute(p, code, b(frame)),
                Op::Return => return Flow::Return,

                Op::Yield => return Flow::Yield(pc as Addr),
                Op::Begin { guide, args, state, setpoints } => self.begin(guide, b(args), b(state), b(setpoints)),
                Op::Guide { guide, args, state, setpoints, ended } => {
                    let arrived = self.guide(guide, b(args), b(state), b(setpoints));
                    self.set(b(ended), truth(arrived));
                }
                Op::Enter { call } => {
                    self.enter_call(p, call, base);
                    if self.abort.is_some() {
                        return Flow::Abort;
                    }
                }
                Op::Step { call, ended } => {
                    let over = self.step_call(p, call, base);
                    if self.abort.is_some() {
                        return Flow::Abort;
                    }
                    self.set(b(ended), truth(over));
                }
                Op::Cut { call, cause } => self.cut_call(p, call, base, cause),
                Op::PutOn { overlay } => {
                    self.put_on(p, overlay, base);
                    if self.abort.is_some() {
                        return Flow::Abort;
                    }
                }
                Op::TakeOff { overlay } => self.take_off(p, overlay, base, albacore_program::Cause::Done),
                Op::Keep { channel, value } => {
                    if self.in_overlay {
                        let value = self.get(b(value));
                        let overridden = &mut self.state.overridden;
                        match channel {
                            Channel::Depth => overridden.vertical = Some(Vertical::Depth(value)),
                            Channel::Altitude => overridden.vertical = Some(Vertical::Altitude(value)),
                            Channel::Speed => overridden.speed = Some(value),
                        }
                    }
                }
                Op::End | Op::Finish => return Flow::End,
                Op::Abort { why } => {
                    self.abort = Some(self.filled(&p.texts[why as usize], base, p));
                    return Flow::Abort;
                }

                Op::Report { site } => {
                    let mut words = Vec::new();
                    for (_, valued) in &p.reports[site as usize].fields {
                        words.extend_from_slice(self.slice(b(valued.slot), valued.shape.words()));
                    }
                    self.events.push(Event::Reported(site, words));
                }
                Op::Log { text } => {
                    let text = self.filled(&p.texts[text as usize], base, p);
                    self.events.push(Event::Logged(text));
                }
                Op::Changed { memory } => {
                    let value = &p.memories[memory as usize].value;
                    let words = self.slice(b(value.slot), value.shape.words()).to_vec();
                    self.events.push(Event::Remembered(memory, words));
                }
            }
        }
    }

    fn heading_at(&self, slot: Slot) -> Heading {
        Heading::from_radians(self.get(slot))
    }

    fn age(&self, owner: Slot) -> f64 {
        self.get(owner + header::AGE)
    }

    /// A text with its holes filled.
    pub fn filled(&self, text: &Text, base: Slot, p: &Program) -> String {
        let mut out = String::new();
        for part in &text.parts {
            match part {
                TextPart::Literal(literal) => out.push_str(literal),
                TextPart::Hole(valued) => {
                    let words = self.slice(valued.slot + base, valued.shape.words());
                    out.push_str(&number::value_with(&p.texts, &valued.shape, words));
                }
            }
        }
        out
    }
}

/// What would be too large for a number is the largest: no arithmetic fails in the water.
pub(crate) fn bounded(x: f64) -> f64 {
    if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) }
}

fn truth(b: bool) -> f64 {
    if b { 1.0 } else { 0.0 }
}

/// Rule 1: whole ticks, rounded up, at least one. A hair above a whole number of ticks is rounding, not a longer time.
pub(crate) fn ticks(seconds: f64) -> f64 {
    (seconds / TICK_S - 1e-6).ceil().max(1.0)
}
