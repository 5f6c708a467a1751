//! Small functions in place of their calls: arguments that are variables or inputs stay where they are, so that an area is
//! not copied to ask whether a point is near its edge.

use super::{FnCode, Lowering};
use crate::hir::Expr;
use albacore_program::Slot;

/// A function of more instructions is called. The instructions of what it calls in place count, so that code cannot grow
/// without end.
const INLINED_OPS_MAX: u64 = 100;

impl<'a> Lowering<'a> {
    pub(super) fn is_inlined(&self, id: usize, code: FnCode) -> bool {
        code.ops <= INLINED_OPS_MAX && self.hir.fns[id].vars.iter().all(|var| var.order.is_none())
    }

    /// A function's block where it is called. Nothing outside it changes while it runs, and it assigns no parameter.
    pub(super) fn inline(&mut self, id: usize, args: &[Expr], to: Slot) {
        let function = &self.hir.fns[id];
        let mut vars: Vec<Slot> = args.iter().map(|arg| self.expr(arg)).collect();
        for var in function.vars.iter().skip(args.len()) {
            vars.push(self.temp(self.words(&var.ty)));
        }
        let outer = std::mem::replace(&mut self.frame.vars, vars);
        let outer_vars = std::mem::replace(&mut self.vars, &function.vars);
        // The lists that are kept in order are the caller's, under numbers that here mean other variables.
        let sorters = std::mem::take(&mut self.frame.sorters);
        self.block_into(&function.body, to);
        self.frame.sorters = sorters;
        self.vars = outer_vars;
        self.frame.vars = outer;
    }
}
