//! Blocks that are values: they compute, and do nothing else.
//!
//! So it does not matter in what order the parts of an expression are computed, how often, or whether at all, and what a
//! condition has shown is so behind it. Everything that lowers an expression or learns from one relies on that.

use super::{Checker, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl<'t> Checker<'t> {
    /// Works on the blocks of an `if` or `match` that is a value. One that is all of a block's value, which itself is nobody's
    /// operand, as at the end of a function, may assign what that block may: nothing is computed after it.
    pub(super) fn as_value<T>(&mut self, is_tail: bool, work: impl FnOnce(&mut Self) -> T) -> T {
        if is_tail {
            return work(self);
        }
        let outer = self.scope.value_from.replace(self.scope.vars.len());
        let setting = match self.scope.setting {
            Setting::Body => Setting::Instant,
            setting => setting,
        };
        let result = self.with_setting(setting, work);
        self.scope.value_from = outer;
        result
    }

    /// Whether a block that is a value does something here, which is then told.
    pub(super) fn is_done_in_value(&mut self, span: Span) -> bool {
        let is_done = self.scope.value_from.is_some();
        if is_done {
            let finding = Diagnostic::error(Code::FlowValue, span, "this is done where a value is computed");
            self.report(finding.help("do it in a statement of its own, before or after"));
        }
        is_done
    }

    /// Whether a block that is a value assigns what was declared outside it, which is then told.
    pub(super) fn is_assigned_in_value(&mut self, id: usize, span: Span) -> bool {
        let is_outside = self.scope.value_from.is_some_and(|from| id < from);
        if is_outside {
            let var = &self.scope.vars[id];
            let message = format!("`{}` is assigned where a value is computed", var.name);
            let finding = Diagnostic::error(Code::FlowValue, span, message)
                .label(var.span, "declared here")
                .help("assign it in a statement of its own, before or after");
            self.report(finding);
        }
        is_outside
    }
}
