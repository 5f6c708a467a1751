//! Names that nothing has which can be called.

use super::args::{BUILTINS, ROUND};
use super::{Checker, Def, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::types::Type;
use albacore_syntax::other_languages;

impl Checker<'_> {
    /// Says that a behavior is called where a value stands.
    pub(super) fn takes_time(&mut self, name: &str, span: Span) {
        let finding = Diagnostic::error(Code::TimeCall, span, format!("`{name}` takes time: it is no value"));
        self.report(finding.help(format!("call it as a statement, `{name}(…)`, or `let x = {name}(…)`")));
    }

    /// Says that nothing has the name of a call, and what was meant by it.
    pub(super) fn no_such_function(&mut self, name: &str, span: Span, expected: Option<&Type>) {
        if self.use_given(name, span).is_some() {
            return self.takes_time(name, span);
        }
        let finding = Diagnostic::error(Code::NamesUnknown, span, format!("nothing named `{name}` can be called"));
        let known = BUILTINS.iter().copied().chain(self.callable_names());
        // No area is round, and elsewhere `circle` is driven.
        let round = (name == "circle" && expected == Some(&Type::Area)).then_some(ROUND);
        let value = round.or_else(|| other_languages::called(name));
        let is_too_long = value.is_none() && self.scope.setting == Setting::Instant;
        let foreign = value.or_else(|| other_languages::help(name));
        let finding = match (foreign, self.nearest(name, known)) {
            (Some(help), _) if is_too_long => {
                finding.help(format!("{help}, in the body of a behavior: here everything is instantaneous"))
            }
            (Some(help), _) => finding.help(help),
            (None, Some(near)) => finding.help(format!("did you mean `{near}`?")),
            (None, None) => match self.import_with(self.scope.module, name, Def::can_be_called) {
                Some(module) => finding.help(format!("write `{module}.{name}(…)`: it is of the module `{module}`")),
                None => {
                    finding.help("functions, behaviors and strategies of other modules are written `module.name(…)`")
                }
            },
        };
        self.report(finding);
    }
}
