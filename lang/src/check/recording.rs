//! What is recorded: inputs, and how often.

use super::{Checker, Def, Temporal};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{InputId, Recording};
use crate::syntax::tree;
use crate::types::Type;
use albacore_program::{RECORD_RATE_MAX, senses};

impl Checker<'_> {
    /// `record a, b at 1 Hz`, beside what the same activity records already.
    pub(super) fn recording(
        &mut self,
        inputs: &[tree::Name],
        rate: &tree::Expr,
        others: &[Recording],
    ) -> Option<Recording> {
        let mut named: Vec<(InputId, _)> = Vec::new();
        for name in inputs {
            let Some(input) = self.input_named(name, Code::MissionsRecord) else { continue };
            let before = others.iter().flat_map(|other| &other.inputs).chain(&named).find(|(other, _)| *other == input);
            if let Some((_, first)) = before {
                let finding =
                    Diagnostic::error(Code::MissionsTwice, name.span, format!("`{}` is recorded twice", name.node));
                self.report(finding.label(*first, "the first").help("keep one of them"));
            } else if senses::ALWAYS_THERE.contains(&name.node.as_str()) {
                let message = format!("`{}` is no measurement", name.node);
                let help = "leave it out: each row has its time, and the trace says who drives";
                self.report(Diagnostic::error(Code::MissionsRecord, name.span, message).help(help));
            } else {
                named.push((input, name.span));
            }
        }
        let rate = self.recording_rate(rate)?;
        Some(Recording { inputs: named, rate })
    }

    /// How often, Hz: a number that is known before the mission begins, for no more than a tick sees.
    fn recording_rate(&mut self, rate: &tree::Expr) -> Option<f64> {
        let frequency = Type::Quantity(Dimension::FREQUENCY);
        let value = self.instant(Temporal::No, |c| c.expr_as(rate, &frequency, "the rate"));
        if value.ty == Type::Unknown {
            return None;
        }
        let (message, help) = match value.range.constant() {
            Some(rate) if rate > 0.0 && rate <= RECORD_RATE_MAX => return Some(rate),
            Some(rate) if rate > RECORD_RATE_MAX => (
                format!("there are {RECORD_RATE_MAX} ticks in a second, and no more rows can be"),
                format!("write `at {RECORD_RATE_MAX} Hz`, which is every tick"),
            ),
            Some(_) => ("at this rate nothing is ever recorded".to_string(), "for example `at 1 Hz`".to_string()),
            None => (
                "this rate is no number that is known here".to_string(),
                "write it as a number, or as a constant that is made of numbers by operators alone".to_string(),
            ),
        };
        self.report(Diagnostic::error(Code::MissionsRecord, value.span, message).help(help));
        None
    }

    /// An input by its name. What is none is told with a code.
    pub(super) fn input_named(&mut self, name: &tree::Name, code: Code) -> Option<InputId> {
        let message = match self.lookup(self.scope.module, &name.node) {
            Some(Def::Input(id)) => {
                self.refer_to(name.span, self.scope.module, &name.node, |_| true);
                return Some(*id);
            }
            Some(other) => format!("`{}` is {}, no input", name.node, other.what()),
            None => format!("there is no input `{}`", name.node),
        };
        let finding = Diagnostic::error(code, name.span, message);
        let known: Vec<String> = self.hir.inputs.iter().map(|input| input.name.clone()).collect();
        self.report(match self.nearest(&name.node, known.iter().map(String::as_str)) {
            Some(near) => finding.help(format!("did you mean `{near}`?")),
            None if code == Code::MissionsRecord => {
                finding.help("what is sensed is recorded, such as `temperature`; anything else is reported: `report \"NAME\": VALUE`")
            }
            None => finding,
        });
        None
    }
}
