//! Conditions to jumps: a comparison that decides where to go on is one instruction, and what no longer matters is skipped.
//!
//! Expressions have no effects and no failures, and temporal operators are updated on their own, so that skipping the right
//! side of `and` and `or` changes nothing but the time it takes.

use super::Lowering;
use crate::hir::{Builtin, Expr, ExprKind};
use albacore_program::{Addr, Compute, Slot, When};

impl<'a> Lowering<'a> {
    /// Code that goes on behind itself when a condition holds; gives the jumps that are taken when it does not.
    pub(super) fn jumps_unless(&mut self, condition: &Expr) -> Vec<Addr> {
        self.scratch(|l| l.jumps(condition, false))
    }

    /// Code that goes on behind itself when a condition does not hold; gives the jumps that are taken when it does.
    pub(super) fn jumps_if(&mut self, condition: &Expr) -> Vec<Addr> {
        self.scratch(|l| l.jumps(condition, true))
    }

    /// `a and b`, `a or b` as a value. It is written last, as what is written may be read inside.
    pub(super) fn and_or_into(&mut self, is_or: bool, a: &Expr, b: &Expr, to: Slot) {
        let decided = self.scratch(|l| l.jumps(a, is_or));
        self.expr_into(b, to);
        let end = self.emit(Compute::jump(0));
        self.land_all(decided);
        self.emit(Compute::Const { to, value: f64::from(u8::from(is_or)) });
        self.land(end);
    }

    pub(super) fn land_all(&mut self, jumps: Vec<Addr>) {
        for jump in jumps {
            self.land(jump);
        }
    }

    /// Jumps that are taken when a condition is `when`.
    fn jumps(&mut self, condition: &Expr, when: bool) -> Vec<Addr> {
        let taken = match &condition.kind {
            ExprKind::Do(Builtin::Not, operands) if operands.len() == 1 => return self.jumps(&operands[0], !when),
            ExprKind::Do(op @ (Builtin::And | Builtin::Or), operands) if operands.len() == 2 => {
                // `or` that is to jump when it holds, and `and` that is to jump when it does not: either side decides.
                if (*op == Builtin::Or) == when {
                    let mut jumps = self.jumps(&operands[0], when);
                    jumps.extend(self.jumps(&operands[1], when));
                    return jumps;
                }
                let decided = self.jumps(&operands[0], !when);
                let jumps = self.jumps(&operands[1], when);
                self.land_all(decided);
                return jumps;
            }
            ExprKind::Do(op @ (Builtin::Lt | Builtin::Le), operands) if operands.len() == 2 => {
                let (a, b) = (self.expr(&operands[0]), self.expr(&operands[1]));
                match (*op == Builtin::Lt, when) {
                    (true, true) => When::Less(a, b),
                    (true, false) => When::NotLess(a, b),
                    (false, true) => When::AtMost(a, b),
                    (false, false) => When::NotAtMost(a, b),
                }
            }
            _ => {
                let value = self.expr(condition);
                if when { When::True(value) } else { When::False(value) }
            }
        };
        vec![self.emit(Compute::Jump { to: 0, when: taken })]
    }
}
