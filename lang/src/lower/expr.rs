//! Expressions to code.

use super::{FnCode, Lowering};
use crate::hir::{Block, Builtin, Expr, ExprKind, InputPart, TextPart, without_holes};
use crate::types::Type;
use albacore_arithmetic::Operator;
use albacore_program::{ABSOLUTE, AreaOp, Code, Compute, Input, ListOp, Op, Slot, Text, Valued};

impl<'a> Lowering<'a> {
    /// Code that leaves an expression's value somewhere; a variable's stays where it is.
    pub(super) fn expr(&mut self, e: &Expr) -> Slot {
        match &e.kind {
            ExprKind::Var(id) => self.frame.vars[*id],
            ExprKind::Unwrap(inner) => self.expr(inner) + 1,
            ExprKind::Part(inner, at) => self.expr(inner) + at,
            ExprKind::IsPresent(inner) => self.expr(inner),
            ExprKind::Number(value) => self.number(*value),
            ExprKind::Input(id, InputPart::Value) => self.input_slot(*id, Input::VALUE),
            ExprKind::Input(id, InputPart::Field(offset)) => self.input_slot(*id, Input::VALUE + offset),
            ExprKind::Input(id, InputPart::Peak) => self.input_slot(*id, Input::PEAK),
            _ => {
                let to = self.temp(self.words(&e.ty).max(1));
                self.expr_into(e, to);
                to
            }
        }
    }

    /// A number where operands can be.
    pub(super) fn number(&mut self, value: f64) -> Slot {
        self.constant(value).unwrap_or_else(|| {
            let to = self.temp(1);
            self.emit(Compute::Const { to, value });
            to
        })
    }

    fn input_slot(&self, id: usize, offset: u32) -> Slot {
        ABSOLUTE | self.program.inputs[id].at.saturating_add(offset)
    }

    pub(super) fn copy(&mut self, to: Slot, from: Slot, words: u32) {
        if to != from {
            match words {
                0 => return,
                1 => self.emit(Compute::Copy { to, from }),
                _ => self.emit(Compute::CopyMany { to, from, words }),
            };
        }
    }

    /// Code that leaves an expression's value in a slot.
    pub(super) fn expr_into(&mut self, e: &Expr, to: Slot) {
        self.must_have_type(e);
        let words = self.words(&e.ty).max(1);
        match &e.kind {
            ExprKind::Number(value) => _ = self.emit(Compute::Const { to, value: *value }),
            ExprKind::Geodetic { latitude_deg, longitude_deg } => {
                let point = self.place(e.span, *latitude_deg, *longitude_deg);
                self.emit(Compute::Const { to, value: point.north });
                self.emit(Compute::Const { to: to + 1, value: point.east });
            }
            ExprKind::Text(parts) => {
                let text = self.text(parts);
                self.emit(Compute::Const { to, value: f64::from(text) });
            }
            ExprKind::None => _ = self.emit(Compute::Clear { to, words }),
            ExprKind::Done => _ = self.emit(Compute::Const { to, value: f64::from(u8::from(self.frame.done)) }),
            ExprKind::Var(_) | ExprKind::Unwrap(_) | ExprKind::Part(..) | ExprKind::IsPresent(_) => self.scratch(|l| {
                let from = l.expr(e);
                l.copy(to, from, words);
            }),
            ExprKind::Input(id, part) => self.input(*id, part, to, words),
            ExprKind::Present(inner) => {
                self.expr_into(inner, to + 1);
                self.emit(Compute::Const { to, value: 1.0 });
            }
            ExprKind::Else(a, b) => self.scratch(|l| {
                let value = l.expr(a);
                let absent = l.emit(Compute::jump_unless(value, 0));
                // `a else b` where b may be absent too keeps a's presence.
                let from = if e.ty.is_optional() { value } else { value + 1 };
                l.copy(to, from, words);
                let present = l.emit(Compute::jump(0));
                l.land(absent);
                l.expr_into(b, to);
                l.land(present);
            }),
            ExprKind::Do(op @ (Builtin::And | Builtin::Or), operands) if operands.len() == 2 => {
                self.and_or_into(*op == Builtin::Or, &operands[0], &operands[1], to);
            }
            ExprKind::Do(op, operands) => self.scratch(|l| l.builtin(*op, operands, &e.ty, to)),
            ExprKind::Call(id, args) => self.scratch(|l| l.call(*id, args, to, words)),
            ExprKind::Record(fields) => self.side_by_side(fields, to),
            ExprKind::Changed(whole, fields) => {
                self.expr_into(whole, to);
                for (at, field) in fields {
                    self.expr_into(field, to.saturating_add(*at));
                }
            }
            ExprKind::List(elements) => {
                self.emit(Compute::Clear { to, words });
                self.emit(Compute::Const { to, value: elements.len() as f64 });
                let mut at = to + 1;
                for element in elements {
                    self.expr_into(element, at);
                    at = at.saturating_add(self.words(&element.ty));
                }
            }
            ExprKind::If(condition, then, otherwise) => {
                let unless = self.jumps_unless(condition);
                self.block_into(then, to);
                let end = self.emit(Compute::jump(0));
                self.land_all(unless);
                self.block_into(otherwise, to);
                self.land(end);
            }
            ExprKind::Match(on, arms, otherwise) => {
                let ends = self.match_arms(on, arms, otherwise.as_ref(), |l, block| l.block_into(block, to));
                for end in ends {
                    self.land(end);
                }
            }
            ExprKind::HeldFor(..) | ExprKind::Becomes(_) | ExprKind::After(_) | ExprKind::Every(_) => {
                let address = std::ptr::from_ref(e) as usize;
                let from = self.frame.timers.get(&address).copied().unwrap_or(to);
                self.copy(to, from, 1);
            }
        }
    }

    /// A block whose value goes to a slot.
    pub(super) fn block_into(&mut self, block: &Block, to: Slot) {
        self.stmts(&block.stmts);
        if let Some(value) = &block.value {
            self.expr_into(value, to);
        }
    }

    /// The arms of a `match`; gives the jumps that must land after it.
    pub(super) fn match_arms(
        &mut self,
        on: &Expr,
        arms: &[(Vec<usize>, Block)],
        otherwise: Option<&Block>,
        mut body: impl FnMut(&mut Self, &Block),
    ) -> Vec<u32> {
        // A name for the value: arms may take time, and temporaries do not outlive a tick.
        let value = self.lasting(1);
        self.scratch(|l| l.expr_into(on, value));
        let mut ends = Vec::new();
        for (variants, block) in arms {
            let mut hits = Vec::new();
            for &variant in variants {
                self.scratch(|l| {
                    let wanted = l.number(variant as f64);
                    let equal = l.temp(1);
                    l.emit(Compute::Eq { to: equal, a: value, b: wanted, words: 1 });
                    hits.push(l.emit(Compute::jump_if(equal, 0)));
                });
            }
            let next = self.emit(Compute::jump(0));
            for hit in hits {
                self.land(hit);
            }
            body(self, block);
            ends.push(self.emit(Compute::jump(0)));
            self.land(next);
        }
        if let Some(block) = otherwise {
            body(self, block);
        }
        ends
    }

    fn input(&mut self, id: usize, part: &InputPart, to: Slot, words: u32) {
        match part {
            InputPart::Value => self.copy(to, self.input_slot(id, Input::VALUE), words),
            InputPart::Field(offset) => self.copy(to, self.input_slot(id, Input::VALUE + offset), words),
            InputPart::Peak => self.copy(to, self.input_slot(id, Input::PEAK), 1),
            InputPart::Age => _ = self.emit(Op::Age { to, input: id as u32 }),
            InputPart::IsNew => _ = self.emit(Op::IsNew { to, input: id as u32 }),
            InputPart::Hits(limit, of) => self.scratch(|l| {
                let limit = l.expr(limit);
                l.emit(Op::Hits { to, input: id as u32, limit, of: *of });
            }),
        }
    }

    fn call(&mut self, id: usize, args: &[Expr], to: Slot, words: u32) {
        let code = self.function(id);
        if self.is_inlined(id, code) {
            self.inline(id, args, to);
            return;
        }
        // Arguments first: a call inside an argument must not disturb those already in place.
        let slots: Vec<(Slot, u32)> = args.iter().map(|a| (self.expr(a), self.words(&a.ty))).collect();
        let base = self.temp_frame(code.words);
        let mut at = base;
        for (from, words) in slots {
            self.copy(at, from, words);
            at = at.saturating_add(words);
        }
        self.emit(Op::Call { code: code.entry, base });
        self.typed(base + code.result, &self.hir.fns[id].result);
        self.copy(to, base + code.result, words);
    }

    /// The code of a function, lowered when first called.
    pub(super) fn function(&mut self, id: usize) -> FnCode {
        if let Some(code) = self.fns.get(&id) {
            return *code;
        }
        let function = &self.hir.fns[id];
        self.prepare_block(&function.body);
        for order in function.vars.iter().filter_map(|v| v.order.as_ref()) {
            self.prepare(&order.key);
        }
        let before = self.emitted;
        let entry = std::cell::Cell::new(0);
        let result = std::cell::Cell::new(0);
        let words = self.twice(&function.vars, |l| {
            l.sorters(&function.vars);
            entry.set(l.here());
            let to = l.lasting(l.words(&function.result));
            result.set(to);
            l.block_into(&function.body, to);
            l.emit(Op::Return);
        });
        let code = FnCode { entry: entry.get(), result: result.get(), words, ops: self.emitted - before };
        self.fns.insert(id, code);
        code
    }

    fn builtin(&mut self, op: Builtin, operands: &[Expr], ty: &Type, to: Slot) {
        use Builtin as B;
        if op == B::Pair || op == B::Line {
            return self.side_by_side(operands, to);
        }
        let slots: Vec<Slot> = operands.iter().map(|o| self.expr(o)).collect();
        let a = slots.first().copied().unwrap_or(to);
        let b = slots.get(1).copied().unwrap_or(a);
        let c = slots.get(2).copied().unwrap_or(a);
        let d = slots.get(3).copied().unwrap_or(a);
        let element_words = |l: &Self| operands[0].ty.element().map_or(1, |inner| l.words(inner));
        if op == B::Top {
            // Lists are compared word by word, what is beyond their count too.
            let words = self.words(&operands[0].ty);
            self.emit(Compute::Clear { to, words });
        }
        // `number(angle)` has one operand: it is the angle.
        if op == B::Add && operands.len() == 1 {
            return self.copy(to, a, 1);
        }
        if let Some(operator) = of_numbers(op) {
            let one = Compute::One { operator, to, a };
            self.emit(if operands.len() == 1 { one } else { Compute::two(operator, to, a, b) });
            return;
        }
        let op: Op = match op {
            B::Quotient => Compute::Quotient { to, a, b }.into(),
            B::VectorQuotient => self.vector_quotient(to, a, b),
            B::Lt => Compute::Lt { to, a, b }.into(),
            B::Le => Compute::Le { to, a, b }.into(),
            B::Eq => Compute::Eq { to, a, b, words: self.words(&operands[0].ty) }.into(),
            B::Not => Compute::Not { to, a }.into(),
            B::And => Compute::And { to, a, b }.into(),
            B::Or => Compute::Or { to, a, b }.into(),
            B::AddVector => Compute::AddVector { to, a, b }.into(),
            B::SubVector => Compute::SubVector { to, a, b }.into(),
            B::Scale => Compute::Scale { to, vector: a, by: b }.into(),
            B::Toward => Compute::Toward { to, length: a, heading: b }.into(),
            B::Direction => Compute::Direction { to, vector: a }.into(),
            B::Length => Compute::two(Operator::Length, to, a, a + 1).into(),
            B::Dot => Compute::Dot { to, a, b }.into(),
            B::Along => Compute::Along { to, vector: a, heading: b }.into(),
            // Emitted above.
            B::Pair | B::Line | B::Add | B::Sub | B::Mul | B::Div | B::AddInt | B::SubInt | B::MulInt => return,
            B::Pow | B::Min | B::Max | B::Neg | B::Abs | B::Sqrt | B::Floor | B::Ceil | B::Round => return,
            B::Exp | B::Ln | B::Atan2 | B::Sin | B::Cos | B::Heading | B::Angle => return,
            B::Rectangle => {
                AreaOp::Rectangle { to, room: self.types.area_room, center: a, along: b, length: c, width: d }.into()
            }
            B::Polygon => AreaOp::Polygon { to: to + 1, room: self.types.area_room, points: a, ok: to }.into(),
            B::LineVector => Compute::SubVector { to, a: a + 2, b: a }.into(),
            B::Hull => AreaOp::Hull { to, room: self.types.area_room, area: a }.into(),
            B::Center => AreaOp::Center { to, area: a }.into(),
            B::Gap => AreaOp::Gap { to, area: a, point: b }.into(),
            B::Corner => {
                let near = if slots.len() > 2 { c } else { self.center_of(a) };
                AreaOp::Corner { to, area: a, heading: b, near }.into()
            }
            B::Scattered => {
                let seed = if slots.len() > 2 { c } else { self.number(0.0) };
                AreaOp::Scattered { to, area: a, index: b, seed }.into()
            }
            B::NearestEdge => AreaOp::NearestEdge { to, area: a, point: b }.into(),
            B::EdgeGap => Compute::EdgeGap { to, edge: a, point: b }.into(),
            B::EdgeDistance => AreaOp::EdgeDistance { to, edge: a, point: b }.into(),
            B::EdgeTangent => AreaOp::EdgeTangent { to, edge: a, heading: b }.into(),
            B::Exit => AreaOp::Exit { to, area: a, point: b, heading: c }.into(),
            B::Run => self.run(to, a, b, c),
            B::Top => ListOp::Top { to, list: a, count: b, words: element_words(self) }.into(),
            B::At => match &operands[0].ty {
                Type::List(inner, _) => return self.element(to, a, b, inner),
                _ => return,
            },
            B::Map => return self.lay_map(to, a, b, ty),
            B::Cell => return self.cell(to, a, b, &operands[0].ty),
            B::Spread => ListOp::Spread { to, list: a, heading: b }.into(),
        };
        self.emit(op);
    }

    /// Values one after the other.
    fn side_by_side(&mut self, values: &[Expr], to: Slot) {
        let mut at = to;
        for value in values {
            self.expr_into(value, at);
            at = at.saturating_add(self.words(&value.ty));
        }
    }

    /// A vector over a number that may be zero.
    fn vector_quotient(&mut self, to: Slot, vector: Slot, by: Slot) -> Op {
        let (one, inverse) = (self.number(1.0), self.temp(2));
        self.emit(Compute::Quotient { to: inverse, a: one, b: by });
        self.emit(Compute::Copy { to, from: inverse });
        Compute::Scale { to: to + 1, vector, by: inverse + 1 }.into()
    }

    /// The way from a point to where it leaves an area.
    fn run(&mut self, to: Slot, area: Slot, point: Slot, heading: Slot) -> Op {
        let exit = self.temp(2);
        self.emit(AreaOp::Exit { to: exit, area, point, heading });
        Compute::SubVector { to, a: exit, b: point }.into()
    }

    fn center_of(&mut self, area: Slot) -> Slot {
        let to = self.temp(2);
        self.emit(AreaOp::Center { to, area });
        to
    }

    /// A text with its holes computed into slots of their own.
    pub(super) fn text(&mut self, parts: &[TextPart]) -> u32 {
        if let Some(text) = without_holes(parts) {
            return self.plain_text(text);
        }
        let mut lowered = Vec::new();
        for part in parts {
            lowered.push(match part {
                TextPart::Literal(text) => albacore_program::TextPart::Literal(text.clone()),
                TextPart::Hole(e) => albacore_program::TextPart::Hole(self.valued(e)),
            });
        }
        self.program.texts.push(Text { parts: lowered });
        self.program.texts.len() as u32 - 1
    }

    /// A text without holes, which stands once: two are the same where their places are.
    pub(super) fn plain_text(&mut self, text: String) -> u32 {
        let texts = &mut self.program.texts;
        *self.texts.entry(text).or_insert_with_key(|text| {
            texts.push(Text { parts: vec![albacore_program::TextPart::Literal(text.clone())] });
            texts.len() as u32 - 1
        })
    }

    /// A value in a slot of its own, with its shape.
    pub(super) fn valued(&mut self, e: &Expr) -> Valued {
        let slot = self.lasting(self.words(&e.ty));
        self.scratch(|l| l.expr_into(e, slot));
        Valued { slot, shape: self.shape(&e.ty) }
    }

    /// An expression as a piece of code of its own, its value in a slot of its own.
    pub(super) fn code(&mut self, e: &Expr) -> Code {
        if let ExprKind::Var(id) = e.kind {
            // A variable needs no code: its value is where it is.
            return Code { entry: self.emit(Op::Return), value: self.frame.vars[id] };
        }
        let value = self.lasting(self.words(&e.ty).max(1));
        let entry = self.here();
        self.scratch(|l| l.expr_into(e, value));
        self.emit(Op::Return);
        Code { entry, value }
    }

    /// A duration in ticks, as a piece of code of its own.
    pub(super) fn ticks_code(&mut self, e: &Expr) -> Code {
        let value = self.lasting(1);
        let entry = self.here();
        self.scratch(|l| {
            let seconds = l.expr(e);
            l.emit(Compute::One { operator: Operator::Ticks, to: value, a: seconds });
        });
        self.emit(Op::Return);
        Code { entry, value }
    }
}

/// The arithmetic of an operation that is of one or two numbers, and always gives one.
fn of_numbers(op: Builtin) -> Option<Operator> {
    let is_of_others =
        matches!(op, Builtin::Quotient | Builtin::Length | Builtin::Dot | Builtin::Along | Builtin::Spread);
    op.operator().filter(|_| !is_of_others)
}
