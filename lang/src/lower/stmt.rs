//! Statements to code. Whatever a statement keeps while time goes by lives on in the frame.

use super::{Lowering, Sorter};
use crate::hir::{Action, Block, Expr, Stmt, StmtKind, Timed, With};
use crate::source::Span;
use crate::types::Type;
use albacore_arithmetic::Operator;
use albacore_program::{
    ANSWER_WORDS, CallSite, Cause, Channel, Compute, GRID_WORDS, GUIDANCE_WORDS, Guide, ListOp, Mark, Op, OverlaySite,
    OverrideEnd, ReportSite, Slot, header, setpoints,
};

impl<'a> Lowering<'a> {
    pub(super) fn stmts(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            self.scratch(|l| l.stmt(stmt));
        }
    }

    pub(super) fn body(&mut self, block: &Block) {
        self.stmts(&block.stmts);
    }

    fn stmt(&mut self, stmt: &Stmt) {
        match &stmt.kind {
            StmtKind::Set(var, e) => self.set(*var, e),
            StmtKind::Insert(var, e) => self.insert(*var, e),
            StmtKind::Remove(var, e) => {
                let (list, item, words) = (self.frame.vars[*var], self.expr(e), self.words(&e.ty));
                self.emit(ListOp::Remove { list, item, words });
            }
            StmtKind::Clear(var) => {
                // All of it: lists are compared word by word, what is beyond their count too.
                let (to, words) = (self.frame.vars[*var], self.words(&self.vars[*var].ty));
                self.emit(Compute::Clear { to, words });
            }
            StmtKind::Replace(var, index, e) => {
                let (list, words) = (self.frame.vars[*var], self.words(&e.ty));
                let (list, index) = match self.vars[*var].ty {
                    Type::Map(..) => (list.saturating_add(GRID_WORDS), self.cell_of(list, index)),
                    _ => (list, self.expr(index)),
                };
                let item = self.expr(e);
                self.emit(ListOp::Replace { list, index, item, words });
                self.sort(*var);
            }
            StmtKind::If(condition, then, otherwise) => {
                let unless = self.jumps_unless(condition);
                self.body(then);
                if otherwise.stmts.is_empty() {
                    self.land_all(unless);
                    return;
                }
                let end = self.emit(Compute::jump(0));
                self.land_all(unless);
                self.body(otherwise);
                self.land(end);
            }
            StmtKind::Match(on, arms, otherwise) => {
                let ends = self.match_arms(on, arms, otherwise.as_ref(), |l, block| l.body(block));
                for end in ends {
                    self.land(end);
                }
            }
            StmtKind::ForRange { var, first, last, inclusive, body } => {
                self.for_range(*var, first, last, *inclusive, body)
            }
            StmtKind::ForList { var, place, list, body } => self.for_list((*var, *place), list, body),
            StmtKind::ForEdges { var, area, body } => self.for_edges(*var, area, body),
            StmtKind::ForRows { var, rows, body } => self.for_rows(*var, rows, body),
            StmtKind::While { condition, bind, body } => self.while_loop(condition, *bind, body),
            StmtKind::Loop(body) => {
                let begun = self.rounds_begun(body);
                let top = self.here();
                self.going_round(begun, body);
                self.emit(Compute::jump(top));
            }
            StmtKind::With(items, body) => self.with(items, body),
            StmtKind::Timed(timed) => self.timed(timed, stmt.span),
            StmtKind::Finish(value) => {
                if let Some(e) = value {
                    let to = self.frame.result;
                    self.expr_into(e, to);
                }
                self.emit(Op::Finish);
            }
            StmtKind::Abort(why) => {
                let why = self.text(why);
                self.emit(Op::Abort { why });
            }
            StmtKind::Report { name, fields } => {
                let fields = fields.iter().map(|(label, e)| (label.clone(), self.valued(e))).collect();
                self.program.reports.push(ReportSite { name: name.clone(), fields });
                let site = self.program.reports.len() as u32 - 1;
                self.emit(Op::Report { site });
            }
            StmtKind::Log(parts) => {
                let text = self.text(parts);
                self.emit(Op::Log { text });
            }
        }
    }

    fn set(&mut self, var: usize, e: &Expr) {
        let to = self.frame.vars[var];
        // `x = x.something` may read what it writes: by way of a temporary.
        if self.words(&e.ty) > 1 {
            let from = self.expr(e);
            let words = self.words(&e.ty);
            self.copy(to, from, words);
        } else {
            self.expr_into(e, to);
        }
        self.sort(var);
    }

    fn insert(&mut self, var: usize, e: &Expr) {
        let (list, item, words) = (self.frame.vars[var], self.expr(e), self.words(&e.ty));
        let capacity = self.capacity(var);
        match self.frame.sorters.get(&var).cloned() {
            Some(Sorter { entry: sort, it, element, .. }) => {
                self.emit(ListOp::PushSorted { list, item, words, capacity, sort });
                self.typed(it, &element);
            }
            None => _ = self.emit(ListOp::Push { list, item, words, capacity }),
        }
    }

    fn while_loop(&mut self, condition: &Expr, bind: Option<usize>, body: &Block) {
        let begun = self.rounds_begun(body);
        let top = self.here();
        let unless = self.scratch(|l| {
            let value = l.expr(condition);
            let unless = l.emit(Compute::jump_unless(value, 0));
            if let Some(var) = bind {
                let (to, words) = (l.frame.vars[var], l.words(condition.ty.present()));
                l.copy(to, value + 1, words);
            }
            unless
        });
        self.going_round(begun, body);
        self.emit(Compute::jump(top));
        self.land(unless);
    }

    /// Puts a list in order whose variable has one.
    pub(super) fn sort(&mut self, var: usize) {
        if let Some(sorter) = self.frame.sorters.get(&var).cloned() {
            self.sort_by(&sorter);
        }
    }

    fn capacity(&self, var: usize) -> u32 {
        match self.vars.get(var).map(|v| &v.ty) {
            Some(Type::List(_, capacity)) => *capacity,
            _ => 1,
        }
    }

    /// Puts setpoints and overlays in force; gives what must be undone.
    pub(super) fn put_on(&mut self, items: &[With]) -> Vec<u32> {
        let mut worn = Vec::new();
        for item in items {
            match item {
                With::Setpoint(channel, e) => {
                    let at = self.frame.header + header::SETPOINTS;
                    self.scratch(|l| l.setpoint(*channel, e, at));
                }
                With::Overlay(id, args, _) => {
                    let unit = self.units[id];
                    let base = self.lasting_frame(unit.words);
                    self.scratch(|l| l.args(args, base));
                    self.program.overlays.push(OverlaySite { activity: unit.activity, base });
                    let overlay = self.program.overlays.len() as u32 - 1;
                    self.emit(Op::PutOn { overlay });
                    worn.push(overlay);
                }
            }
        }
        worn
    }

    /// Arguments straight into the callee's frame, whose variables begin with its parameters.
    fn args(&mut self, args: &[Expr], base: Slot) {
        let mut at = base;
        for arg in args {
            self.expr_into(arg, at);
            at = at.saturating_add(self.words(&arg.ty));
        }
    }

    fn setpoint(&mut self, channel: Channel, e: &Expr, at: Slot) {
        self.expr_into(e, at + channel.row().word);
        self.mark_set(channel, at);
    }

    /// Where one word tells which of several channels is set.
    fn mark_set(&mut self, channel: Channel, at: Slot) {
        if let Mark::Word(word, value) = channel.row().mark {
            self.emit(Compute::Const { to: at + word, value });
        }
    }

    fn with(&mut self, items: &[With], body: &Block) {
        let at = self.frame.header + header::SETPOINTS;
        let saved = self.lasting(setpoints::WORDS);
        self.copy(saved, at, setpoints::WORDS);
        let worn = self.put_on(items);
        self.body(body);
        // What is put on inside has been noted already: inner blocks amend first, whatever their order on the page.
        self.frame.overlays.extend(&worn);
        for overlay in worn {
            self.emit(Op::TakeOff { overlay });
        }
        self.copy(at, saved, setpoints::WORDS);
    }

    fn timed(&mut self, timed: &Timed, span: Span) {
        let owner = self.frame.header;
        let begun = self.lasting(1);
        self.emit(Compute::Now { to: begun, owner });
        let setpoints = self.own_setpoints(&timed.at, owner + header::SETPOINTS);
        let duration = timed.duration.as_ref().map(|e| self.frozen_ticks(e));
        let within = timed.within.as_ref().map(|e| self.frozen_ticks(e));
        let timers = self.place_timers(&timed.until);
        self.reset_timers(&timers);
        self.update_timers(&timers, owner, Some(begun));
        let ended = self.lasting(1);
        let result = timed.result.map(|var| self.frame.vars[var]);

        self.tell(timed, span);
        let action = self.begin(&timed.action, setpoints, ended);
        let wait = self.emit(Op::Yield);
        self.update_timers(&timers, owner, Some(begun));
        self.go_on(&action, &timed.action, setpoints, ended);
        let mut done = vec![self.emit(Compute::jump_if(ended, 0))];
        let mut cut_normally = Vec::new();
        let mut cut_off = None;
        if let Some(until) = &timed.until {
            cut_normally.extend(self.jumps_if(until));
        }
        if let Some(ticks) = duration {
            cut_normally.push(self.jump_if_elapsed(begun, ticks, owner));
        }
        if let Some(ticks) = within {
            cut_off = Some(self.jump_if_elapsed(begun, ticks, owner));
        }
        self.emit(Compute::jump(wait));

        // Its own end, then `for` and `until`, then `within`: each leaves the outcome where `let` wants it.
        let cut = timed.duration.is_some() || timed.until.is_some() || timed.within.is_some();
        self.land(done.remove(0));
        if let (Some(to), Running::Ask { answer, .. }) = (result, &action) {
            self.copy(to, *answer, ANSWER_WORDS);
        }
        if let Some(to) = result
            && !matches!(action, Running::Override { .. } | Running::Ask { .. })
        {
            self.outcome_of_end(&action, timed.value.as_ref(), cut, to);
        }
        let mut ends = Vec::new();
        for (jumps, cause) in [(cut_normally, Cause::Until), (cut_off.into_iter().collect(), Cause::TimedOut)] {
            if !jumps.is_empty() {
                ends.push(self.emit(Compute::jump(0)));
                self.land_all(jumps);
                self.cut(&action, cause, result, timed.value.as_ref());
            }
        }
        self.land_all(ends);
        if let Running::Override { end, .. } = action {
            match result {
                Some(to) => self.copy(to, end, 1),
                None => _ = self.emit(Op::Desert { end }),
            }
        }
    }

    /// Setpoints of a statement's own are frozen as it begins; without them those in force are used where they are.
    fn own_setpoints(&mut self, at: &[(Channel, Expr)], in_force: Slot) -> Slot {
        if at.is_empty() {
            return in_force;
        }
        let own = self.lasting(setpoints::WORDS);
        self.copy(own, in_force, setpoints::WORDS);
        for (channel, e) in at {
            self.scratch(|l| l.setpoint(*channel, e, own));
        }
        own
    }

    /// Ends what runs, from outside; its outcome goes where `let` wants it.
    fn cut(&mut self, action: &Running, cause: Cause, result: Option<Slot>, value: Option<&Type>) {
        // `for` and `until` are normal ends; only `within` cuts off.
        let is_normal = cause == Cause::Until;
        if let Running::Call { call, .. } | Running::Override { call, .. } = *action {
            self.emit(Op::Cut { call, cause });
        }
        if let Running::Override { end, taken, .. } = *action {
            let value = if is_normal { OverrideEnd::Completed } else { OverrideEnd::TimedOut };
            self.emit(Compute::Const { to: end, value: value.number() });
            if is_normal {
                let was_taken = self.emit(Compute::jump_if(taken, 0));
                self.emit(Compute::Const { to: end, value: OverrideEnd::NoAnswer.number() });
                self.land(was_taken);
            }
            return;
        }
        if let Running::Ask { id, .. } = *action {
            self.emit(Op::Unanswered { id });
            if let Some(to) = result {
                self.emit(Compute::Clear { to: to + 1, words: ANSWER_WORDS - 1 });
                self.emit(Compute::Const { to, value: OverrideEnd::NoAnswer.number() });
            }
            return;
        }
        match (result, value) {
            (Some(to), Some(ty)) => {
                let words = self.words(&ty.clone().optional());
                self.emit(Compute::Clear { to, words });
            }
            (Some(to), None) => _ = self.emit(Compute::Const { to, value: f64::from(u8::from(is_normal)) }),
            (None, _) => {}
        }
    }

    pub(super) fn frozen_ticks(&mut self, duration: &Expr) -> Slot {
        let ticks = self.lasting(1);
        self.scratch(|l| {
            let seconds = l.expr(duration);
            l.emit(Compute::One { operator: Operator::Ticks, to: ticks, a: seconds });
        });
        ticks
    }

    pub(super) fn jump_if_elapsed(&mut self, from: Slot, ticks: Slot, owner: Slot) -> u32 {
        self.scratch(|l| {
            let elapsed = l.temp(1);
            l.emit(Compute::Elapsed { to: elapsed, from, ticks, owner });
            l.emit(Compute::jump_if(elapsed, 0))
        })
    }

    fn outcome_of_end(&mut self, action: &Running, value: Option<&Type>, cut: bool, to: Slot) {
        match (action, value) {
            (Running::Call { result, .. }, Some(ty)) => {
                let words = self.words(ty);
                if cut && !ty.is_optional() {
                    self.emit(Compute::Const { to, value: 1.0 });
                    self.copy(to + 1, *result, words);
                    self.typed(to + 1, ty);
                } else {
                    self.copy(to, *result, words);
                    self.typed(to, ty);
                }
            }
            _ => _ = self.emit(Compute::Const { to, value: 1.0 }),
        }
    }

    /// The first tick of a statement.
    fn begin(&mut self, action: &Action, setpoints: Slot, ended: Slot) -> Running {
        match action {
            Action::Guide(guide, args) => {
                let words: u64 = args.iter().map(|a| u64::from(self.words(&a.ty))).sum();
                let slots = self.lasting_frame(words.max(1));
                self.scratch(|l| l.args(args, slots));
                let state = self.lasting(GUIDANCE_WORDS);
                self.emit(Op::Begin { guide: *guide, args: slots, state, setpoints });
                self.emit(Op::Guide { guide: *guide, args: slots, state, setpoints, ended });
                Running::Guide { guide: *guide, args: slots, state }
            }
            Action::Keep(channel, e) => {
                let own = self.lasting(setpoints::WORDS);
                let value = self.lasting(1);
                let state = self.lasting(1);
                let running = Running::Keep { channel: *channel, value, own, state };
                self.keep(&running, e, setpoints, ended);
                running
            }
            Action::Call(id, args) => {
                let unit = self.units[id];
                let base = self.lasting_frame(unit.words);
                self.scratch(|l| l.args(args, base));
                self.program.calls.push(CallSite {
                    activity: unit.activity,
                    caller: self.frame.header,
                    base,
                    setpoints,
                });
                let call = self.program.calls.len() as u32 - 1;
                self.emit(Op::Enter { call });
                let called = self.program.activities.get(unit.activity as usize);
                let result = called.and_then(|called| called.result.as_ref()).map_or(0, |r| r.slot);
                Running::Call { call, result: base + result }
            }
            Action::Watch => Running::Watch,
            Action::Override(o) => self.begin_override(o, setpoints),
            Action::Ask(payload, action) => {
                let action = self.asked(*payload, *action);
                let (id, answer) = (self.lasting(1), self.lasting(ANSWER_WORDS));
                self.emit(Op::AskPayload { action, id });
                Running::Ask { id, answer }
            }
        }
    }

    /// The place of what is asked of a payload among all that the program asks.
    fn asked(&mut self, payload: usize, action: usize) -> u32 {
        let action = self.hir.payloads[payload].action(action);
        let asks = &mut self.program.asks;
        let known = asks.iter().position(|other| *other == action);
        known.unwrap_or_else(|| {
            asks.push(action);
            asks.len() - 1
        }) as u32
    }

    /// Every later tick: what tells whether it has come to its own end.
    fn go_on(&mut self, running: &Running, action: &Action, setpoints: Slot, ended: Slot) {
        match (running, action) {
            (Running::Guide { guide, args, state }, Action::Guide(_, written)) => {
                if guide.law().reads_arguments_anew() {
                    self.scratch(|l| l.args(written, *args));
                }
                self.emit(Op::Guide { guide: *guide, args: *args, state: *state, setpoints, ended });
            }
            (Running::Keep { .. }, Action::Keep(_, e)) => self.keep(running, e, setpoints, ended),
            (Running::Call { call, .. }, _) => _ = self.emit(Op::Step { call: *call, ended }),
            (Running::Override { call, end, .. }, _) => self.step_override(*call, *end, ended),
            (Running::Ask { id, answer }, _) => _ = self.emit(Op::Heard { id: *id, answer: *answer, ended }),
            _ => {}
        }
    }

    /// `keep` reads its setpoint at every tick. In an overlay it is the channel's; in a behavior it keeps course as well.
    fn keep(&mut self, running: &Running, e: &Expr, setpoints: Slot, ended: Slot) {
        let Running::Keep { channel, value, own, state } = *running else { return };
        self.scratch(|l| l.expr_into(e, value));
        self.copy(own, setpoints, setpoints::WORDS);
        self.copy(own + channel.row().word, value, 1);
        self.mark_set(channel, own);
        self.emit(Op::Keep { channel, value });
        self.emit(Op::Guide { guide: Guide::Keep, args: value, state, setpoints: own, ended });
    }
}

/// A statement under way: where its parts are.
pub(super) enum Running {
    Guide { guide: Guide, args: Slot, state: Slot },
    Keep { channel: Channel, value: Slot, own: Slot, state: Slot },
    Call { call: u32, result: Slot },
    Watch,
    Override { call: u32, end: Slot, taken: Slot },
    Ask { id: Slot, answer: Slot },
}
