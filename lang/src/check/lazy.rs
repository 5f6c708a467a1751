//! Constants and signals of files: each is checked when it is first read, and stands wherever it is read.

use super::{Checker, Scope, Setting, Signature};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir;
use crate::syntax::tree;

/// Operands and operators of a file's signal at most, with those of the signals that it reads.
const SIGNAL_PARTS_MAX: usize = 256;
/// A constant waits for so many others at most that are declared after it.
const WAITING_MAX: usize = 16;

/// Parts of a constant or a default at most, but for those that its own text spells out.
const CONSTANT_PARTS_MAX: usize = 4096;
/// Parts of constants and defaults that are read, each counted wherever it is: they stand for their values there.
const PARTS_READ_MAX: usize = 1 << 20;

/// A constant or a module's signal: checked when first needed.
pub(super) enum Lazy<'t> {
    Unchecked { module: usize, name: &'t tree::Name, ty: Option<&'t tree::Ty>, value: &'t tree::Expr },
    InProgress(&'t tree::Name),
    Done(hir::Expr),
}

impl<'t> Checker<'t> {
    /// The signature of a function, read when first needed: defaults and ranges of parameters may call other functions. It has
    /// no result where that leads back to it.
    pub(super) fn fn_signature(&mut self, id: usize) -> Signature {
        if let Some(&(m, function)) = self.fns_ahead.get(&id) {
            self.read_signature(id, m, function);
        } else if self.fn_signatures[id].result.is_none() {
            let Signature { name, span, .. } = &self.fn_signatures[id];
            let message = format!("`{name}` is called where its own parameters are declared");
            let finding = Diagnostic::error(Code::NamesRecursive, *span, message);
            self.report(finding.help("give the parameter a default and a range that do not lead back to the function"));
        }
        self.fn_signatures[id].clone()
    }

    fn read_signature(&mut self, id: usize, m: usize, function: &'t tree::Function) {
        if self.waiting > WAITING_MAX {
            let message = format!(
                "the parameters of `{}` call more than {WAITING_MAX} functions, one in another",
                function.name.node
            );
            let finding = Diagnostic::error(Code::LimitsConstants, function.name.span, message);
            // Its turn comes yet.
            return self.report(finding.help("declare first what others call"));
        }
        self.fns_ahead.remove(&id);
        self.waiting += 1;
        let (params, result) = self.take_template(id, m, function);
        self.waiting -= 1;
        let signature = &mut self.fn_signatures[id];
        signature.params = params;
        signature.result = Some(result);
    }

    /// The value of a constant, checked when first needed.
    pub(super) fn constant(&mut self, id: usize) -> hir::Expr {
        let value = self.lazy(id, true);
        self.stands_here(value)
    }

    /// The default of a parameter for which no argument is given.
    pub(super) fn default(&mut self, default: &hir::Expr) -> hir::Expr {
        self.stands_here(default.clone())
    }

    /// A constant or a default where it is read: it stands there with all its parts.
    fn stands_here(&mut self, value: hir::Expr) -> hir::Expr {
        if matches!(value.kind, hir::ExprKind::Number(_)) {
            return value;
        }
        let is_told = self.parts_read > PARTS_READ_MAX;
        self.parts_read = self.parts_read.saturating_add(value.parts());
        if self.parts_read <= PARTS_READ_MAX {
            return value;
        }
        if !is_told {
            let message = format!("with this more than {PARTS_READ_MAX} parts of constants and defaults are read");
            let finding = Diagnostic::error(Code::LimitsConstants, value.span, message);
            self.report(finding.help("name it once with `let` where it is read, or make lists of constants shorter"));
        }
        self.unknown(value.span)
    }

    /// The expression of a module's signal.
    pub(super) fn module_signal(&mut self, id: usize) -> hir::Expr {
        self.lazy(id, false)
    }

    fn lazy(&mut self, id: usize, is_const: bool) -> hir::Expr {
        let table = if is_const { &mut self.consts } else { &mut self.signals };
        match &table[id] {
            Lazy::Done(value) => value.clone(),
            &Lazy::InProgress(name) => {
                let message = format!("`{}` is made of itself", name.node);
                self.report(
                    Diagnostic::error(Code::NamesRecursive, name.span, message).help("give it a value of its own"),
                );
                self.unknown(name.span)
            }
            &Lazy::Unchecked { name, .. } if self.waiting > WAITING_MAX => {
                let message =
                    format!("more than {WAITING_MAX} others that are declared before `{}` wait for it", name.node);
                let finding = Diagnostic::error(Code::LimitsConstants, name.span, message);
                self.report(finding.help("declare first what others are made of"));
                self.unknown(name.span)
            }
            &Lazy::Unchecked { module, name, ty, value } => {
                table[id] = Lazy::InProgress(name);
                self.waiting += 1;
                let setting = if is_const { Setting::Constant } else { Setting::Instant };
                let (checked, _) = self.within(Scope::new(module, setting), |c| match ty {
                    Some(ty) => {
                        let ty = c.written_type(module, ty);
                        c.expr_as(value, &ty, &format!("`{}`", name.node))
                    }
                    None => c.expr(value, None),
                });
                self.waiting -= 1;
                let checked =
                    if is_const { self.small_constant(name, checked) } else { self.short_signal(name, checked) };
                let table = if is_const { &mut self.consts } else { &mut self.signals };
                table[id] = Lazy::Done(checked.clone());
                checked
            }
        }
    }

    /// The expression of a file's signal, which stands wherever it is read: of signals that read others twice, each
    /// would otherwise be twice as long.
    fn short_signal(&mut self, name: &tree::Name, value: hir::Expr) -> hir::Expr {
        if value.is_within(SIGNAL_PARTS_MAX) {
            return value;
        }
        let message = format!(
            "`{}` is made of more than {SIGNAL_PARTS_MAX} parts, with those of the signals that it reads",
            name.node
        );
        let finding = Diagnostic::error(Code::LimitsSignal, name.span, message);
        self.report(finding.help(
            "declare such signals in the behavior or mission that reads them: there each is computed once a tick",
        ));
        self.unknown(name.span)
    }

    /// The value of a constant or a default, which stands wherever it is read: of those that hold others twice, each would otherwise
    /// be twice as long.
    pub(super) fn small_constant(&mut self, name: &tree::Name, value: hir::Expr) -> hir::Expr {
        // No part is written with less than a byte.
        let written = (value.span.end - value.span.start) as usize;
        if value.is_within(CONSTANT_PARTS_MAX.max(written)) {
            return value;
        }
        let message = format!(
            "`{}` has more than {CONSTANT_PARTS_MAX} parts, with those of constants and defaults in it",
            name.node
        );
        let finding = Diagnostic::error(Code::LimitsConstants, name.span, message);
        self.report(finding.help(
            "hold fewer of them in one another: each stands for all that it is made of, wherever it is read; write the number \
             that it comes to, or declare it with `let` in a mission or a behavior",
        ));
        self.unknown(name.span)
    }
}
