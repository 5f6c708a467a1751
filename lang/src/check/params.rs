//! Parameters: their types, ranges and defaults, and what `--set` puts in place of a default.

use super::expr::article;
use super::quantity::is_of_quantity;
use super::{Checker, ParamInfo, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{self, Interval};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_arithmetic::LARGEST;
use albacore_program::calendar;
use std::collections::BTreeMap;

/// A parameter set from outside, as by `--set cpt_2005.beta=30deg`.
#[derive(Clone, Debug)]
pub struct Override {
    /// The declarations that may be meant, each by its own name or with its module.
    pub declarations: Vec<String>,
    /// The parameter.
    pub param: String,
    /// Where both are named.
    pub place: Span,
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
                    Code::MissionsDefault,
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
        let mut firsts: BTreeMap<&str, Span> = BTreeMap::new();
        for param in params {
            self.names_used.define(&param.name, "a parameter");
            let first = *firsts.entry(&param.name.node).or_insert(param.name.span);
            if first != param.name.span {
                let finding = Diagnostic::error(
                    Code::NamesTwice,
                    param.name.span,
                    format!("there are two parameters `{}`", param.name.node),
                )
                .label(first, "the first")
                .help("choose another name, or leave it out");
                self.report(finding);
            }
            // That of another strategy is written in the module of that.
            let home = self.home(param.name.span, m);
            if let Some(behavior) = owner.and_then(|_| self.behavior_param(home, param)) {
                let (name, span, behavior) = (param.name.node.clone(), param.name.span, Some(behavior));
                infos.push(ParamInfo { name, ty: Type::Unknown, default: None, range: None, behavior, span });
                continue;
            }
            let ty = self.written_type(home, &param.ty);
            let written = param.range.as_ref().and_then(|r| self.constant_range(home, r, &ty));
            let replaced = owner.and_then(|owner| self.take_override(m, owner, &param.name.node));
            let what = if replaced.is_some() { "the value" } else { "the default" };
            let written_default = replaced.as_ref().or(param.default.as_ref());
            let default = written_default.map(|written| self.constant_of(home, &param.name, &ty, written, what));
            // A function may well be given the negative difference of two times; what takes time may not.
            let range = written.or_else(|| owner.and_then(|_| Self::implied_range(&ty)));
            if let Some(default) = &default {
                let is_told = written.is_none() && owner.is_some() && self.sensible_default(default, &param.name.node);
                if let (false, Some(range)) = (is_told, range) {
                    self.in_range(default, range, &param.name.node, param.name.span);
                }
            }
            let (name, span) = (param.name.node.clone(), param.name.span);
            infos.push(ParamInfo { name, ty, default, range, behavior: None, span });
        }
        infos
    }

    /// What `--set` puts in place of the default of a parameter that a scenario has of another.
    pub(super) fn inherited_default(&mut self, m: usize, owner: &str, param: &hir::Var) -> Option<hir::Expr> {
        let written = self.take_override(m, owner, &param.name)?;
        let name = tree::Name { node: param.name.clone(), span: param.span };
        let value = self.constant_of(m, &name, &param.ty, &written, "the value");
        self.in_range(&value, param.range, &param.name, param.span);
        Some(value)
    }

    /// The value of a parameter as it is written in a module.
    fn constant_of(&mut self, m: usize, param: &tree::Name, ty: &Type, written: &tree::Expr, what: &str) -> hir::Expr {
        let (value, _) = self.within(Scope::new(m, Setting::Constant), |c| c.expr_as(written, ty, what));
        self.small_constant(param, value)
    }

    fn take_override(&mut self, m: usize, owner: &str, param: &str) -> Option<tree::Expr> {
        let full = format!("{}.{owner}", self.modules[m].name);
        let is_meant = |o: &Override| o.param == param && o.declarations.iter().any(|d| *d == owner || *d == full);
        let at = self.overrides.iter().position(is_meant)?;
        self.overrides[at].found = Some(self.full_name(m, owner));
        Some(self.overrides[at].value.clone())
    }

    /// What a module declares, by its name with that of the module.
    pub(super) fn full_name(&self, m: usize, name: &str) -> String {
        let module = &self.modules[m].name;
        if module.is_empty() { name.to_string() } else { format!("{module}.{name}") }
    }

    /// What the script that is run calls what a module declares.
    pub(super) fn path_from_script(&self, m: usize, name: &str) -> String {
        let imported = self.modules.first().and_then(|script| script.imports.iter().find(|(_, module)| **module == m));
        match imported {
            _ if m == 0 || self.modules[m].prelude => name.to_string(),
            Some((module, _)) => format!("{module}.{name}"),
            None => self.full_name(m, name),
        }
    }

    /// A parameter that is to be set and that nothing has.
    pub(super) fn unknown_override(&mut self, unused: &Override) {
        let mut owners: Vec<(String, Vec<String>)> = Vec::new();
        for signature in self.activity_signatures.iter().filter(|s| !s.params.is_empty()) {
            owners.push((signature.name.clone(), signature.params.iter().map(|p| p.name.clone()).collect()));
        }
        for scenario in self.hir.scenarios.iter().filter(|s| !s.vars.is_empty()) {
            owners.push((scenario.name.clone(), scenario.vars.iter().map(|v| v.name.clone()).collect()));
        }
        let short = |full: &str| full.rsplit('.').next().unwrap_or_default().to_string();
        let is_meant = |owner: &str| unused.declarations.iter().any(|d| d == owner || *d == short(owner));
        let params: Vec<&str> =
            owners.iter().filter(|(o, _)| is_meant(o)).flat_map(|(_, params)| params).map(String::as_str).collect();
        let named = |names: &[String]| names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(" nor ");
        let Override { declarations, param, place, .. } = unused;
        let is_again = |o: &&Override| o.found.is_some() && o.param == *param && o.declarations == *declarations;
        if let Some(first) = self.overrides.iter().find(is_again) {
            let finding = Diagnostic::error(Code::ArgsTwice, *place, format!("`{param}` is set twice"));
            let finding = finding.label(first.place, "the first").help("leave one of them out");
            return self.report(finding);
        }
        let finding = |message: String| Diagnostic::error(Code::SetUnknown, *place, message);
        let is_plain = place.end as usize == param.len();
        let finding = match declarations.as_slice() {
            [] => finding(format!("whose parameter is `{param}`?"))
                .help("choose the mission with `--mission`, or write `--set DECLARATION.PARAMETER=VALUE`"),
            [only] if params.is_empty() && !is_plain => {
                let known: Vec<String> = owners.iter().map(|(owner, _)| short(owner)).collect();
                let help = self.suggestion(&short(only), known.iter().map(String::as_str));
                let help =
                    help.unwrap_or_else(|| "it names a declaration with parameters, and one of them".to_string());
                finding(format!("nothing named `{only}` takes parameters")).help(help)
            }
            several => {
                let neither = if several.len() > 1 { "neither " } else { "" };
                let negated = if several.len() > 1 { "has" } else { "has no" };
                let what = if several.len() > 1 { "a parameter" } else { "parameter" };
                let help = self.suggestion(param, params.iter().copied());
                let help = help.unwrap_or_else(|| {
                    "a parameter of another declaration is written `--set DECLARATION.PARAMETER=VALUE`".to_string()
                });
                finding(format!("{neither}{} {negated} {what} `{param}`", named(several))).help(help)
            }
        };
        self.report(finding);
    }

    fn constant_range(&mut self, m: usize, range: &tree::Range, ty: &Type) -> Option<Interval> {
        if is_of_quantity(ty) {
            let place = range.first.span.to(range.last.span);
            let finding = Diagnostic::error(Code::RangesConstant, place, "no range can hold this parameter");
            let finding = finding.here("a `Quantity` may be in any unit");
            self.report(
                finding.help("leave the range out, and hold what is computed with it with `clamp(x, low, high)`"),
            );
            return None;
        }
        let scope = Scope::new(m, Setting::Constant);
        let ((first, last), _) =
            self.within(scope, |c| (c.expr_as(&range.first, ty, "the range"), c.expr_as(&range.last, ty, "the range")));
        if !range.inclusive && *ty != Type::Int && last.ty != Type::Unknown {
            self.report(
                Diagnostic::error(Code::RangesOpen, last.span, "only whole numbers have a last before the end")
                    .help("write `..`, which holds both ends"),
            );
        }
        if first.ty != Type::Unknown && last.ty != Type::Unknown && !can_have_a_range(ty) {
            let ty = self.type_name(ty);
            let finding = Diagnostic::error(
                Code::RangesConstant,
                range.first.span.to(range.last.span),
                "no range can hold this parameter",
            );
            self.report(
                finding
                    .here(format!("{} is no number", article(&ty)))
                    .help("leave the range out, and test the value where it is used"),
            );
            return None;
        }
        let without_last = if range.inclusive { 0.0 } else { 1.0 };
        match (first.range.constant(), last.range.constant().map(|last| last - without_last)) {
            // What is of another type has been told of.
            _ if first.ty == Type::Unknown || last.ty == Type::Unknown => None,
            // A whole turn ends where it begins.
            (Some(low), Some(high)) if *ty == Type::Heading && low == high => {
                let finding = Diagnostic::error(
                    Code::RangesEmpty,
                    range.first.span.to(range.last.span),
                    "this range holds one heading alone",
                );
                self.report(finding.help("leave the range out: a parameter without one takes any heading"));
                None
            }
            (Some(low), Some(high)) if low <= high => Some(Interval::new(low, high)),
            (Some(_), Some(_)) => {
                self.report(
                    Diagnostic::error(
                        Code::RangesEmpty,
                        range.first.span.to(range.last.span),
                        "this range holds nothing",
                    )
                    .help(match *ty == Type::Heading {
                        true => "no range goes across north: leave it out, and test the heading where it is used",
                        false => "the smaller bound comes first",
                    }),
                );
                None
            }
            (low, _) => {
                let unknown = if low.is_none() { first.span } else { last.span };
                let finding = Diagnostic::error(
                    Code::RangesConstant,
                    unknown,
                    "this end of a range is no number that is known here",
                );
                self.report(
                    finding.help("write it as a number, or as a constant that is made of numbers by operators alone"),
                );
                None
            }
        }
    }

    /// Checks that a value can be assigned: a memory whose range is assumed where it is read is held to it.
    pub(super) fn assigned_in_range(&mut self, id: hir::VarId, value: &hir::Expr) {
        let hir::Var { kind, range, name, span, ty, .. } = &self.scope.vars[id];
        if *kind == hir::VarKind::Memory && Self::implied_range(ty).is_some() {
            let (range, name, span) = (*range, name.clone(), *span);
            self.in_range(value, range, &name, span);
        }
    }

    /// Checks that a value is in a parameter's range, as far as the value is known.
    pub(super) fn in_range(&mut self, value: &hir::Expr, range: Interval, param: &str, declared: Span) {
        let is_absent = matches!(value.kind, hir::ExprKind::None);
        if value.ty == Type::Unknown || is_absent || range.covers(value.range) {
            return;
        }
        // Where a range ends at 1 or before, it is of shares: `4 %`.
        let is_share = value.ty.dimension() == Some(Dimension::NONE) && range.high <= 1.0 && range.high.fract() != 0.0;
        let show = |x: f64| match is_share {
            true => format!("{} %", short(significant(x * 100.0))),
            false => self.shown_number(x, &value.ty),
        };
        // One that lies just outside is not told as the bound.
        let apart = |x: f64| match show(x) {
            shown if shown == show(range.low) || shown == show(range.high) => self.exact_number(x, &value.ty),
            shown => shown,
        };
        // Who wrote `4` for `4 %`; what is a share already is none of it.
        let percent = value.range.constant().filter(|x| *x >= 1.0).map(|x| x * 0.01);
        let percent = percent.filter(|x| *x >= range.low && *x <= range.high);
        let (bounds, among) = match (range.low > -LARGEST, range.high < LARGEST) {
            (true, false) => (format!("{} or more", show(range.low)), "of"),
            (false, true) => (format!("{} or less", show(range.high)), "of"),
            _ => (format!("{}..{}", show(range.low), show(range.high)), "in"),
        };
        let finding = match value.range.constant() {
            Some(x) => Diagnostic::error(
                Code::RangesOutside,
                value.span,
                format!("{} is outside the range of `{param}`", apart(x)),
            )
            .help(match (percent.filter(|_| is_share), &value.ty) {
                (Some(meant), _) => format!("choose a value {among} {bounds}: `{}`, perhaps?", show(meant)),
                (None, Type::Quantity(d)) if *d == Dimension::ANGLE => {
                    format!("choose a value {among} {bounds}; a radian is 57.2958 deg")
                }
                _ if value.ty.is_optional() => format!("choose a value {among} {bounds}, or leave it out"),
                _ => format!("choose a value {among} {bounds}"),
            }),
            None => Diagnostic::error(
                Code::RangesUnproved,
                value.span,
                format!("this may be outside the range of `{param}`, {bounds}"),
            )
            .help(match range == Interval::NOT_NEGATIVE && value.ty == Type::Quantity(Dimension::TIME) {
                true => "no time is negative: write `max(0 s, …)`",
                false if value.ty == Type::Heading => "give what it is computed from a range of its own",
                false => "give what it is computed from a range of its own, or hold it with `clamp(x, low, high)`",
            }),
        };
        self.report(
            finding.label(declared, format!("`{param}` is {}{bounds}", if among == "in" { "in " } else { "" })),
        );
    }

    pub(super) fn shown_number(&self, x: f64, ty: &Type) -> String {
        self.number_in_digits(x, ty, significant)
    }

    /// The same with all its digits.
    fn exact_number(&self, x: f64, ty: &Type) -> String {
        self.number_in_digits(x, ty, |x| x)
    }

    fn number_in_digits(&self, x: f64, ty: &Type, digits: fn(f64) -> f64) -> String {
        let display = match ty.present() {
            // Whole hours and minutes, as they are spoken of.
            Type::Quantity(d) if *d == Dimension::TIME && x >= 36_000.0 && x % 3600.0 == 0.0 => {
                return format!("{} h", x / 3600.0);
            }
            Type::Quantity(d) if *d == Dimension::TIME && x >= 120.0 && x % 60.0 == 0.0 => {
                return format!("{} min", x / 60.0);
            }
            Type::Quantity(d) if !d.is_none() => d.display(),
            Type::Heading => Dimension::ANGLE.display(),
            Type::Depth | Type::Altitude => Dimension::LENGTH.display(),
            Type::Date => return calendar::written(x),
            _ => return short(x),
        };
        format!("{} {}", short(digits(x / display.scale)), display.unit)
    }
}

/// Whether the values of a type lie in an order, so that a range can hold them.
fn can_have_a_range(ty: &Type) -> bool {
    matches!(ty.present(), Type::Int | Type::Quantity(_) | Type::Heading | Type::Depth | Type::Altitude | Type::Date)
}

/// A number without rows of zeros.
fn short(x: f64) -> String {
    if x != 0.0 && !(1e-6..1e16).contains(&x.abs()) { format!("{x:e}") } else { format!("{x}") }
}

/// As a person writes it: six digits, so that radians come back as the degrees that they were.
fn significant(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}
