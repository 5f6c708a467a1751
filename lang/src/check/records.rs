//! Records with other values in some of their fields.

use super::Checker;
use super::expr::article;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, ExprKind};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_wording::listed;

impl<'t> Checker<'t> {
    /// `RECORD with (field: value)`.
    pub(super) fn changed(&mut self, base: &tree::Expr, fields: &[tree::Arg], span: Span) -> Expr {
        let base = self.expr(base, None);
        let Some(id) = self.record_of(&base) else {
            for field in fields {
                self.expr(&field.value, None);
            }
            return self.unknown(span);
        };
        let record = self.types.records[id].clone();
        if fields.is_empty() {
            let message = format!("no field of this `{}` is changed", record.name);
            let finding = Diagnostic::error(Code::ArgsMissing, span, message);
            self.report(finding.help("write which, each with its value: `RECORD with (field: VALUE)`"));
        }
        let names: Vec<&str> = record.fields.iter().map(|(name, _)| name.as_str()).collect();
        let mut changed: Vec<(u32, Expr)> = Vec::new();
        let mut seen: Vec<&str> = Vec::new();
        for field in fields {
            let Some(label) = &field.label else {
                let message = "a field that is changed stands with its name";
                let finding = Diagnostic::error(Code::ArgsLabel, field.value.span, message);
                self.report(finding.help(format!("write `FIELD: VALUE`; {} has {}", record.name, listed(&names))));
                self.expr(&field.value, None);
                continue;
            };
            let Some(at) = record.fields.iter().position(|(name, _)| *name == label.node) else {
                let message = format!("`{}` has no field `{}`", record.name, label.node);
                let finding = Diagnostic::error(Code::ArgsLabel, label.span, message);
                self.report(match self.suggestion(&label.node, names.iter().copied()) {
                    Some(help) => finding.help(help),
                    None => finding.help(format!("it has {}", listed(&names))),
                });
                self.expr(&field.value, None);
                continue;
            };
            if let Some(place) = record.places.get(at) {
                self.names_used.refer(label.span, *place);
            }
            let (name, ty) = &record.fields[at];
            if seen.contains(&name.as_str()) {
                let message = format!("`{name}` is given twice");
                self.report(Diagnostic::error(Code::ArgsTwice, label.span, message).help("leave one of them out"));
            }
            seen.push(name);
            let value = self.expr_as(&field.value, ty, &format!("`{name}` of `{}`", record.name));
            let words = record.fields[..at].iter().map(|(_, ty)| self.types.words(ty));
            changed.push((words.fold(0, u32::saturating_add), value));
        }
        self.make(ExprKind::Changed(Box::new(base), changed), Type::Record(id), span)
    }

    /// The record that a value is; of what is none that is told.
    fn record_of(&mut self, value: &Expr) -> Option<usize> {
        let finding = match &value.ty {
            Type::Record(id) => return Some(*id),
            Type::Unknown => return None,
            Type::Optional(inner) if matches!(**inner, Type::Record(_)) => self.absent(value),
            other => {
                let name = self.type_name(other);
                let message = format!("only a record is taken `with` other values, this is {}", article(&name));
                let finding = Diagnostic::error(Code::TypesMismatch, value.span, message).here(format!("`{name}`"));
                finding.help("`with` and what stands behind it are for records: `sighting with (at: position)`")
            }
        };
        self.report(finding);
        None
    }
}
