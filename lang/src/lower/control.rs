//! `override { … }`: an activity of its own, which shares the frame of the body that it stands in, so that it can stand still
//! and be left like any other. Its code asks for control first; whatever ends it, leaving it gives control back.

use super::Lowering;
use super::stmt::Running;
use crate::hir;
use albacore_program::{ActivityKind, CallSite, Cause, Op, OverrideEnd, Slot};

impl<'a> Lowering<'a> {
    /// The first tick of an override: it is entered, and asks.
    pub(super) fn begin_override(&mut self, o: &hir::Override, setpoints: Slot) -> Running {
        let end = self.lasting(1);
        self.emit(Op::Const { to: end, value: OverrideEnd::Completed.number() });
        let over = self.emit(Op::Jump { to: 0 });
        let caller = self.frame.header;
        let activity = self.block_activity("override", ActivityKind::Override, |l, header| {
            l.ask(o, header, end);
            l.stmts(&o.block.stmts);
        });
        self.land(over);
        self.program.calls.push(CallSite { activity, caller, base: 0, setpoints });
        let call = self.program.calls.len() as u32 - 1;
        self.emit(Op::Enter { call });
        Running::Override { call, end }
    }

    /// Every later tick: while the vehicle suspends us the block stands still, and when it takes control back it is left.
    pub(super) fn step_override(&mut self, call: u32, end: Slot, ended: Slot) {
        self.scratch(|l| {
            let (suspended, lost) = (l.temp(1), l.temp(1));
            l.emit(Op::Driven { suspended, lost });
            l.emit(Op::Const { to: ended, value: 0.0 });
            let stands = l.emit(Op::JumpIf { if_: suspended, to: 0 });
            let goes_on = l.emit(Op::JumpUnless { unless: lost, to: 0 });
            l.emit(Op::Const { to: end, value: OverrideEnd::TakenBack.number() });
            l.emit(Op::Cut { call, cause: Cause::TakenBack });
            l.emit(Op::Const { to: ended, value: 1.0 });
            let left = l.emit(Op::Jump { to: 0 });
            l.land(goes_on);
            l.emit(Op::Step { call, ended });
            for (why, cause) in [(OverrideEnd::Refused, Cause::Refused), (OverrideEnd::NoAnswer, Cause::NoAnswer)] {
                let is = l.temp(1);
                l.emit(Op::Const { to: is, value: why.number() });
                l.emit(Op::Eq { to: is, a: is, b: end, words: 1 });
                let other = l.emit(Op::JumpUnless { unless: is, to: 0 });
                l.emit(Op::Cut { call, cause });
                l.emit(Op::Const { to: ended, value: 1.0 });
                l.land(other);
            }
            l.land(stands);
            l.land(left);
        });
    }

    /// Asks for control, and waits for the answer.
    fn ask(&mut self, o: &hir::Override, owner: Slot, end: Slot) {
        let begun = self.lasting(1);
        self.emit(Op::Now { to: begun, owner });
        let patience = o.answer.as_ref().map(|e| self.frozen_ticks(e));
        let (ours, refused) = (self.lasting(1), self.lasting(1));
        self.emit(Op::Ask { offered: o.offered });
        let wait = self.emit(Op::Yield);
        self.emit(Op::Answer { ours, refused, offered: o.offered });
        let taken = self.emit(Op::JumpIf { if_: ours, to: 0 });
        let denied = self.emit(Op::JumpIf { if_: refused, to: 0 });
        let silent = patience.map(|ticks| self.jump_if_elapsed(begun, ticks, owner));
        self.emit(Op::Jump { to: wait });
        for (jump, why) in [(Some(denied), OverrideEnd::Refused), (silent, OverrideEnd::NoAnswer)] {
            let Some(jump) = jump else { continue };
            self.land(jump);
            // Who called it leaves it for this in the same tick.
            self.emit(Op::Const { to: end, value: why.number() });
            self.emit(Op::Yield);
        }
        self.land(taken);
        self.emit(Op::Take);
    }
}
