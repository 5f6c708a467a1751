//! The instructions that need more of a run than its words.

use crate::Event;
use crate::allowance::TEXT_BYTES_MAX;
use crate::compute::{Frame, OfFrame, OfRun, compute, place};
use crate::lists::Order;
use crate::state::Run;
use albacore_geometry::{Area, Heading, Point};
use albacore_program::{Addr, AreaOp, Channel, ListOp, Op, OverrideEnd, Program, Slot, Text, TextPart, number};

/// Why code stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
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

    /// Sets an area that may be absent, with room for so many corners.
    pub fn set_area(&mut self, slot: Slot, room: u32, area: Option<&Area>) {
        self.run.state.words[slot as usize] = truth(area.is_some());
        self.run.set_area(slot + 1, room, area);
    }
}

impl Run {
    /// Runs code with a frame's base until it stops.
    #[inline]
    pub fn execute(&mut self, p: &Program, entry: Addr, base: Slot) -> Stop {
        // Much of what an activity may have is empty: no signals, no reactions, no timers.
        if let Some(Op::Return) = p.ops.get(entry as usize) {
            return Stop::Return;
        }
        self.execute_all(p, entry, base)
    }

    /// Most pieces of code are a row of instructions on words, and a return: what else there is stands apart, so that those are begun
    /// and ended quickly.
    #[inline(never)]
    fn execute_all(&mut self, p: &Program, entry: Addr, base: Slot) -> Stop {
        let mut pc = entry as usize;
        loop {
            pc = if self.bound.holds(pc, base) || self.bound.bind(p, pc as Addr, base) {
                let mut frame = Frame { words: &mut self.state.words, operands: OfRun };
                compute(self.bound.ops(), &mut frame, &mut self.trig, pc)
            } else {
                self.compute_in_frame(p, pc, base)
            };
            let op = &p.ops[pc];
            pc += 1;
            match op {
                Op::Return => return Stop::Return,
                Op::Yield => return Stop::Yield(pc as Addr),
                Op::End | Op::Finish => return Stop::End,
                op => {
                    if let Some(stop) = self.execute_one(p, op, base) {
                        return stop;
                    }
                }
            }
        }
    }

    /// Computes in a frame that the code is not bound to.
    #[inline(never)]
    fn compute_in_frame(&mut self, p: &Program, from: usize, base: Slot) -> usize {
        let mut frame = Frame { words: &mut self.state.words, operands: OfFrame(base) };
        compute(&p.ops, &mut frame, &mut self.trig, from)
    }

    /// Executes an instruction that needs more than words, and does not end its piece of code.
    #[inline(never)]
    fn execute_one(&mut self, p: &Program, op: &Op, base: Slot) -> Option<Stop> {
        let b = |slot: Slot| place(slot, base);
        match *op {
            Op::Compute(_) | Op::Return | Op::Yield | Op::End | Op::Finish => {}
            Op::Area(op) => self.on_area(op, base),
            Op::List(op) => self.on_list(p, op, base),
            Op::Map(op) => self.on_map(op, base),
            Op::IsNew { to, input } => self.set(b(to), truth(self.is_new(&p.inputs[input as usize]))),
            Op::Age { to, input } => self.set(b(to), self.age_s(&p.inputs[input as usize])),
            Op::Hits { to, input, limit, of } => {
                let hits = self.hits(&p.inputs[input as usize], self.get(b(limit)), of);
                self.set(b(to), hits);
            }
            Op::Call { code, base: frame } => _ = self.execute(p, code, b(frame)),
            Op::Abort { why } => {
                self.abort = Some(self.filled(&p.texts[why as usize], base, p));
                return Some(Stop::Abort);
            }

            Op::Begin { guide, args, state, setpoints } => self.begin(guide, b(args), b(state), b(setpoints)),
            Op::Guide { guide, args, state, setpoints, ended } => {
                let arrived = self.guide(guide, b(args), b(state), b(setpoints));
                self.set(b(ended), truth(arrived));
            }
            Op::Keep { channel, value } => self.keep(channel, b(value)),
            Op::Enter { call } => {
                self.enter_call(p, call, base);
                if self.abort.is_some() {
                    return Some(Stop::Abort);
                }
            }
            Op::Step { call, ended } => {
                let over = self.step_call(p, call, base);
                if self.abort.is_some() {
                    return Some(Stop::Abort);
                }
                self.set(b(ended), truth(over));
            }
            Op::Cut { call, cause } => self.cut_call(p, call, base, cause),
            Op::PutOn { overlay } => self.put_on(p, overlay, base),
            Op::TakeOff { overlay } => self.take_off(p, overlay, base, albacore_program::Cause::Done),

            Op::Ask { offered } => self.ask_for_control(offered),
            Op::Answer { ours, refused, offered } => {
                let (is_ours, is_refused) = self.answer(offered);
                self.set(b(ours), truth(is_ours));
                self.set(b(refused), truth(is_refused));
            }
            Op::Take => self.take(),
            Op::Driven { suspended, lost } => {
                let (is_suspended, is_lost) = self.driven();
                self.set(b(suspended), truth(is_suspended));
                self.set(b(lost), truth(is_lost));
            }
            Op::Desert { end } => {
                if self.desert(OverrideEnd::from_number(self.get(b(end)))) {
                    return Some(Stop::Abort);
                }
            }

            Op::AskPayload { action, id } => self.ask_payload(action, b(id)),
            Op::Heard { id, answer, ended } => self.hear(b(id), b(answer), b(ended)),
            Op::Unanswered { id } => self.unanswered(b(id)),

            Op::Tell { statement } => self.tell_beginning(p, statement, base),
            Op::Report { site } => self.report(p, site, base),
            Op::Log { text } => self.log(p, text, base),
            Op::Changed { memory } => self.remember(p, memory, base),
        }
        None
    }

    fn on_area(&mut self, op: AreaOp, base: Slot) {
        let b = |slot: Slot| place(slot, base);
        match op {
            AreaOp::Rectangle { to, room, center, along, length, width } => {
                let (length, width) = (self.get(b(length)), self.get(b(width)));
                let area = Area::rectangle(self.point(b(center)), self.heading_at(b(along)), length, width);
                self.set_area(b(to), room, Some(&area));
            }
            AreaOp::Polygon { to, room, points, ok } => {
                let count = self.get(b(points)) as u32;
                let corners: Vec<Point> = (0..count).map(|i| self.point(b(points) + 1 + 2 * i)).collect();
                let area = Area::polygon(&corners).ok().filter(|_| count <= room);
                self.set_area(b(to), room, area.as_ref());
                self.set(b(ok), truth(area.is_some()));
            }
            AreaOp::Hull { to, room, area } => self.set_hull(b(to), room, b(area)),
            AreaOp::Center { to, area } => self.set_point(b(to), self.center(b(area))),
            AreaOp::Gap { to, area, point } => self.set(b(to), self.gap(b(area), self.point(b(point)))),
            AreaOp::Corner { to, area, heading, near } => {
                let corner = self.farthest_corner(b(area), self.heading_at(b(heading)), self.point(b(near)));
                self.set_point(b(to), corner);
            }
            AreaOp::Rows { to, area, step, along, near } => {
                let along = along.map(|along| self.heading_at(b(along)));
                let rows = self.rows_across(b(area), self.get(b(step)), along, self.point(b(near)));
                self.set_rows(b(to), rows);
            }
            AreaOp::RowAt { to, place, rows, area, .. } => self.take_row(b(to), b(place), b(rows), b(area)),
            AreaOp::NearestEdge { to, area, point } => {
                let edge = self.nearest_edge(b(area), self.point(b(point)));
                self.set_edge(b(to), edge);
            }
            AreaOp::EdgeDistance { to, edge, point } => {
                let distance = self.distance_of_edge(b(edge), self.point(b(point)));
                self.set(b(to), distance);
            }
            AreaOp::EdgeTangent { to, edge, heading } => {
                let tangent = self.edge(b(edge)).tangent(self.heading_at(b(heading)));
                self.set(b(to), tangent.radians());
            }
            AreaOp::Scattered { to, area, index, seed } => {
                let place = self.scattered(b(area), self.get(b(index)), self.get(b(seed)));
                self.set_point(b(to), place);
            }
            AreaOp::Exit { to, area, point, heading } => {
                let exit = self.exit(b(area), self.point(b(point)), self.heading_at(b(heading)));
                self.set_point(b(to), exit);
            }
        }
    }

    fn on_list(&mut self, p: &Program, op: ListOp, base: Slot) {
        let b = |slot: Slot| place(slot, base);
        match op {
            ListOp::Push { list, item, words, capacity } => self.push(b(list), b(item), words, capacity),
            ListOp::Sort { list, words, it, key, value, most } => {
                let by = Order { it: b(it), key, value: b(value), most };
                self.sort(p, base, b(list), words, by);
            }
            ListOp::PushSorted { list, item, words, capacity, sort } => {
                self.push_sorted(p, b(list), b(item), words, capacity, (sort, base));
            }
            ListOp::Replace { list, index, item, words } => self.replace(b(list), b(index), b(item), words),
            ListOp::Remove { list, item, words } => self.remove(b(list), b(item), words),
            ListOp::At { to, list, index, words } => self.element(b(to), b(list), b(index), words),
            ListOp::Top { to, list, count, words } => self.top(b(to), b(list), b(count), words),
            ListOp::Spread { to, list, heading } => {
                let unit = self.trig.unit(self.get(b(heading)));
                let spread = self.spread(b(list), unit);
                self.set(b(to), spread);
            }
        }
    }

    /// In an overlay: its channel's setpoint.
    fn keep(&mut self, channel: Channel, value: Slot) {
        if !self.in_overlay {
            return;
        }
        let value = self.get(value);
        self.state.overridden.set(channel, value);
    }

    fn remember(&mut self, p: &Program, memory: u32, base: Slot) {
        let value = &p.memories[memory as usize].value;
        let words = self.slice(place(value.slot, base), value.shape.words()).to_vec();
        self.events.push(Event::Remembered(memory, words));
    }

    fn report(&mut self, p: &Program, site: u32, base: Slot) {
        if !self.state.allowance.admits_report(site, &mut self.events) {
            return;
        }
        let mut words = Vec::new();
        for (_, valued) in &p.reports[site as usize].fields {
            words.extend_from_slice(self.slice(place(valued.slot, base), valued.shape.words()));
        }
        self.state.allowance.pay(size_of_val(words.as_slice()));
        self.events.push(Event::Reported(site, words));
    }

    fn log(&mut self, p: &Program, text: u32, base: Slot) {
        if !self.state.allowance.admits(&mut self.events) {
            return;
        }
        let text = self.filled(&p.texts[text as usize], base, p);
        self.state.allowance.pay(text.len());
        self.events.push(Event::Logged(text));
    }

    fn heading_at(&self, slot: Slot) -> Heading {
        Heading::from_radians(self.get(slot))
    }

    /// A text with its holes filled; what is too long for anybody to read is cut.
    pub fn filled(&self, text: &Text, base: Slot, p: &Program) -> String {
        let mut out = String::new();
        for part in &text.parts {
            match part {
                TextPart::Literal(literal) => out.push_str(literal),
                TextPart::Hole(valued) => {
                    let words = self.slice(valued.slot + base, valued.shape.words());
                    out.push_str(&number::within_text(&p.texts, &valued.shape, words));
                }
            }
        }
        cut(&mut out, TEXT_BYTES_MAX);
        out
    }
}

/// Cuts a text that is too long, between two of its characters, and shows that it is.
fn cut(text: &mut String, bytes_max: usize) {
    if text.len() > bytes_max {
        let end = (0..=bytes_max).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        text.truncate(end);
        text.push_str(" …");
    }
}

pub(crate) fn truth(b: bool) -> f64 {
    if b { 1.0 } else { 0.0 }
}
