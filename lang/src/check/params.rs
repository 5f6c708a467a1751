//! Parameters: their types, ranges and defaults, and what `--set` puts in place of a default.

use super::{Checker, ParamInfo, Scope, Setting};
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{self, Interval};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;

/// A parameter set from outside, as by `--set cpt_2005.beta=30deg`.
#[derive(Clone, Debug)]
pub struct Override {
    /// The declaration, by its own name or with its module, and the parameter.
    pub declaration: String,
    /// The parameter.
    pub param: String,
    /// The value.
    pub value: tree::Expr,
    /// The declaration that has it, by its full name, once that is found.
    pub found: Option<String>,
}

impl<'t> Checker<'t> {
    pub(super) fn mission_params(&mut self, mission: &tree::Activity) {
        for param in mission.params.iter().filter(|p| p.default.is_none()) {
            self.report(
                Diagnostic::error(
                    "missions::default",
                    param.name.span,
                    format!("the mission's parameter `{}` has no default", param.name.node),
                )
                .help(format!(
                    "write `{}: … = VALUE`; `--set {}=VALUE` then changes it",
                    param.name.node, param.name.node
                )),
            );
        }
    }

    pub(super) fn params(&mut self, m: usize, params: &'t [tree::Param], owner: Option<&str>) -> Vec<ParamInfo> {
        let mut infos: Vec<ParamInfo> = Vec::new();
        for param in params {
            if let Some(earlier) = infos.iter().find(|i| i.name == param.name.node) {
                let finding = Diagnostic::error(
                    "names::twice",
                    param.name.span,
                    format!("there are two parameters `{}`", param.name.node),
                )
                .label(earlier.span, "the first")
                .help("choose another name, or leave it out");
                self.report(finding);
            }
            let ty = self.written_type(m, &param.ty);
            let range = param.range.as_ref().and_then(|r| self.constant_range(m, r, &ty));
            let replaced = owner.and_then(|owner| self.take_override(m, owner, &param.name.node));
            let default = replaced.as_ref().or(param.default.as_ref()).map(|written| {
                let scope = Scope::new(m, Setting::Constant);
                let (value, _) = self.within(scope, |c| c.expr_as(written, &ty, "the default"));
                value
            });
            match (&default, range) {
                (Some(default), Some(range)) => self.in_range(default, range, &param.name.node, param.name.span),
                (Some(default), None) if owner.is_some() => self.sensible_default(default, &param.name.node),
                _ => {}
            }
            infos.push(ParamInfo { name: param.name.node.clone(), ty, default, range, span: param.name.span });
        }
        infos
    }

    fn take_override(&mut self, m: usize, owner: &str, param: &str) -> Option<tree::Expr> {
        let full = format!("{}.{owner}", self.modules[m].name);
        let found = self
            .overrides
            .iter_mut()
            .find(|o| o.param == param && (o.declaration == owner || o.declaration == full))?;
        found.found = Some(if self.modules[m].name.is_empty() { owner.to_string() } else { full });
        Some(found.value.clone())
    }

    pub(super) fn unknown_override(&mut self, unused: &Override) {
        let mut all: Vec<String> = Vec::new();
        for signature in &self.activity_signatures {
            let short = signature.name.rsplit('.').next().unwrap_or("");
            if unused.declaration == short || unused.declaration == signature.name {
                all.extend(signature.params.iter().map(|p| p.name.clone()));
            }
        }
        for scenario in &self.hir.scenarios {
            if unused.declaration == scenario.name {
                all.extend(scenario.vars.iter().map(|v| v.name.clone()));
            }
        }
        let finding = Diagnostic::error(
            "set::unknown",
            unused.value.span,
            format!("`{}` has no parameter `{}`", unused.declaration, unused.param),
        );
        let finding = match self.suggestion(&unused.param, all.iter().map(String::as_str)) {
            Some(help) => finding.help(help),
            None => finding.help(format!("nothing named `{}` takes parameters", unused.declaration)),
        };
        self.report(finding);
    }

    fn constant_range(&mut self, m: usize, range: &tree::Range, ty: &Type) -> Option<Interval> {
        let scope = Scope::new(m, Setting::Constant);
        let ((first, last), _) =
            self.within(scope, |c| (c.expr_as(&range.first, ty, "the range"), c.expr_as(&range.last, ty, "the range")));
        match (first.range.constant(), last.range.constant()) {
            (Some(low), Some(high)) if low <= high => Some(Interval::new(low, high)),
            (Some(_), Some(_)) => {
                self.report(
                    Diagnostic::error(
                        "ranges::empty",
                        range.first.span.to(range.last.span),
                        "this range holds nothing",
                    )
                    .help("the smaller bound comes first"),
                );
                None
            }
            _ => None,
        }
    }

    /// Checks that a value is in a parameter's range, as far as the value is known.
    pub(super) fn in_range(&mut self, value: &hir::Expr, range: Interval, param: &str, declared: Span) {
        if value.ty == Type::Unknown || (value.range.low >= range.low && value.range.high <= range.high) {
            return;
        }
        let show = |x: f64| self.shown_number(x, &value.ty);
        let (bounds, among) = match (range.low.is_finite(), range.high.is_finite()) {
            (true, false) => (format!("{} or more", show(range.low)), "of"),
            (false, true) => (format!("{} or less", show(range.high)), "of"),
            _ => (format!("{}..{}", show(range.low), show(range.high)), "in"),
        };
        let finding = match value.range.constant() {
            Some(x) => Diagnostic::error(
                "ranges::outside",
                value.span,
                format!("{} is outside the range of `{param}`", show(x)),
            )
            .help(format!("choose a value {among} {bounds}")),
            None => Diagnostic::error(
                "ranges::unproved",
                value.span,
                format!("this may be outside the range of `{param}`, {bounds}"),
            )
            .help("give what it is computed from a range of its own, or hold it with `clamp(x, low, high)`"),
        };
        self.report(
            finding.label(declared, format!("`{param}` is {}{bounds}", if among == "in" { "in " } else { "" })),
        );
    }

    pub(super) fn shown_number(&self, x: f64, ty: &Type) -> String {
        let display = match ty {
            Type::Quantity(d) if !d.is_none() => d.display(),
            Type::Heading => Dimension::ANGLE.display(),
            Type::Depth | Type::Altitude => Dimension::LENGTH.display(),
            _ => return format!("{x}"),
        };
        // As a person writes it: rounded where radians come back as degrees.
        let value = (x / display.scale * 1e6).round() / 1e6;
        format!("{value} {}", display.unit)
    }
}
