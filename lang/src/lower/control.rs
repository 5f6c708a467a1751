//! `override { … }`: an activity of its own, which shares the frame of the body that it stands in, so that it can stand still
//! and be left like any other. Its code asks for control first; whatever ends it, leaving it gives control back.

use super::Lowering;
use super::stmt::Running;
use crate::hir;
use albacore_program::{ActivityKind, CallSite, Cause, Compute, Op, OverrideEnd, Slot};

impl<'a> Lowering<'a> {
    /// The first tick of an override: it is entered, and asks.
    pub(super) fn begin_override(&mut self, o: &hir::Override, setpoints: Slot) -> Running {
        let (end, taken) = (self.lasting(1), self.lasting(1));
        self.emit(Compute::Const { to: end, value: OverrideEnd::Completed.number() });
        // Who has not asked lacks no answer.
        self.emit(Compute::Const { to: taken, value: f64::from(u8::from(o.offered)) });
        let over = self.emit(Compute::jump(0));
        let caller = self.frame.header;
        let activity = self.block_activity("override", ActivityKind::Override, |l, header| {
            l.ask(o, header, end);
            l.emit(Compute::Const { to: taken, value: 1.0 });
            l.stmts(&o.block.stmts);
        });
        self.land(over);
        self.program.calls.push(CallSite { activity, caller, base: 0, setpoints });
        let call = self.program.calls.len() as u32 - 1;
        self.emit(Op::Enter { call });
        Running::Override { call, end, taken }
    }

    /// Every later tick: while the vehicle suspends us the block stands still, and when it takes control back it is left.
    pub(super) fn step_override(&mut self, call: u32, end: Slot, ended: Slot) {
        self.scratch(|l| {
            let (suspended, lost) = (l.temp(1), l.temp(1));
            l.emit(Op::Driven { suspended, lost });
            l.emit(Compute::Const { to: ended, value: 0.0 });
            let stands = l.emit(Compute::jump_if(suspended, 0));
            let goes_on = l.emit(Compute::jump_unless(lost, 0));
            l.emit(Compute::Const { to: end, value: OverrideEnd::TakenBack.number() });
            l.emit(Op::Cut { call, cause: Cause::TakenBack });
            l.emit(Compute::Const { to: ended, value: 1.0 });
            let left = l.emit(Compute::jump(0));
            l.land(goes_on);
            l.emit(Op::Step { call, ended });
            for (why, cause) in [(OverrideEnd::Refused, Cause::Refused), (OverrideEnd::NoAnswer, Cause::NoAnswer)] {
                let is = l.temp(1);
                l.emit(Compute::Const { to: is, value: why.number() });
                l.emit(Compute::Eq { to: is, a: is, b: end, words: 1 });
                let other = l.emit(Compute::jump_unless(is, 0));
                l.emit(Op::Cut { call, cause });
                l.emit(Compute::Const { to: ended, value: 1.0 });
                l.land(other);
            }
            l.land(stands);
            l.land(left);
        });
    }

    /// Asks for control, and waits for the answer.
    fn ask(&mut self, o: &hir::Override, owner: Slot, end: Slot) {
        let begun = self.lasting(1);
        self.emit(Compute::Now { to: begun, owner });
        let patience = o.answer.as_ref().map(|e| self.frozen_ticks(e));
        let (ours, refused) = (self.lasting(1), self.lasting(1));
        self.emit(Op::Ask { offered: o.offered });
        let wait = self.emit(Op::Yield);
        self.emit(Op::Answer { ours, refused, offered: o.offered });
        let taken = self.emit(Compute::jump_if(ours, 0));
        let denied = self.emit(Compute::jump_if(refused, 0));
        let silent = patience.map(|ticks| self.jump_if_elapsed(begun, ticks, owner));
        self.emit(Compute::jump(wait));
        for (jump, why) in [(Some(denied), OverrideEnd::Refused), (silent, OverrideEnd::NoAnswer)] {
            let Some(jump) = jump else { continue };
            self.land(jump);
            // Who called it leaves it for this in the same tick.
            self.emit(Compute::Const { to: end, value: why.number() });
            self.emit(Op::Yield);
        }
        self.land(taken);
        self.emit(Op::Take);
    }
}
