//! Expressions: names, literals, conversions, conditions.

use super::facts::{self, Fact, Place};
use super::{Checker, Def, Setting, Temporal};
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Block, Builtin, Expr, ExprKind, InputPart, Interval, TextPart, VarKind};
use crate::source::Span;
use crate::suggest;
use crate::syntax::tree::{self, Condition, Unary};
use crate::types::Type;

/// Beyond this, 2^53, adding one changes nothing.
pub(super) const INT_MAX: f64 = 9_007_199_254_740_992.0;

/// What a path of names leads to.
pub(super) enum Found {
    Def(Def),
    Nothing,
}

impl<'t> Checker<'t> {
    pub(super) fn unknown(&self, span: Span) -> Expr {
        Expr { kind: ExprKind::None, ty: Type::Unknown, span, range: Interval::ANY }
    }

    pub(super) fn make(&self, kind: ExprKind, ty: Type, span: Span) -> Expr {
        let range = match &kind {
            ExprKind::Number(x) => Interval::exactly(*x),
            ExprKind::Do(op, operands) => {
                let ranges: Vec<Interval> = operands.iter().map(|o| o.range).collect();
                super::constant::range(*op, &ranges)
            }
            ExprKind::Present(inner) | ExprKind::Unwrap(inner) => inner.range,
            ExprKind::If(_, a, b) => match (&a.value, &b.value) {
                (Some(a), Some(b)) => Interval {
                    low: a.range.low.min(b.range.low),
                    high: a.range.high.max(b.range.high),
                    not_zero: a.range.excludes_zero() && b.range.excludes_zero(),
                },
                _ => Interval::ANY,
            },
            _ => Interval::ANY,
        };
        // What can be only one number is that number.
        let kind = match (range.constant(), &kind, ty.present()) {
            (
                Some(x),
                ExprKind::Do(..),
                Type::Quantity(_) | Type::Int | Type::Heading | Type::Depth | Type::Altitude,
            ) if !ty.is_optional() => ExprKind::Number(x),
            _ => kind,
        };
        Expr { kind, ty, span, range }
    }

    pub(super) fn operation(&self, op: Builtin, operands: Vec<Expr>, ty: Type, span: Span) -> Expr {
        self.make(ExprKind::Do(op, operands), ty, span)
    }

    /// An expression of a type that is asked for; `what` names what asks.
    pub(super) fn expr_as(&mut self, e: &tree::Expr, ty: &Type, what: &str) -> Expr {
        let value = self.expr(e, Some(ty));
        self.coerce(value, ty, what)
    }

    /// Makes a value of the type that is asked for, where the language allows it, or says why not.
    pub(super) fn coerce(&mut self, value: Expr, ty: &Type, what: &str) -> Expr {
        if value.ty == *ty || value.ty == Type::Unknown || *ty == Type::Unknown {
            return value;
        }
        let span = value.span;
        if let Type::Optional(inner) = ty {
            if value.ty == Type::None {
                return Expr { ty: ty.clone(), ..value };
            }
            if !value.ty.is_optional() {
                let value = self.coerce(value, inner, what);
                return self.make(ExprKind::Present(Box::new(value)), ty.clone(), span);
            }
        }
        let constant = value.range.constant();
        let is_constant =
            constant.is_some() || matches!(value.kind, ExprKind::Var(id) if self.scope.vars[id].walks_constants);
        match (&value.ty, ty) {
            (Type::Int | Type::Sign, Type::Quantity(d)) if d.is_none() => return Expr { ty: ty.clone(), ..value },
            (Type::Sign, Type::Int) => return Expr { ty: ty.clone(), ..value },
            (Type::Int, Type::Sign) if constant.is_some_and(|x| x.abs() == 1.0) => {
                return Expr { ty: Type::Sign, ..value };
            }
            (Type::Quantity(d), Type::Int) if d.is_none() && constant.is_some_and(|x| x.fract() == 0.0) => {
                return Expr { ty: Type::Int, ..value };
            }
            (Type::Quantity(d), Type::Heading) if *d == Dimension::ANGLE && is_constant => {
                return self.operation(Builtin::Heading, vec![value], Type::Heading, span);
            }
            (Type::Quantity(d), Type::Depth | Type::Altitude) if *d == Dimension::LENGTH && is_constant => {
                return Expr { ty: ty.clone(), ..value };
            }
            (Type::List(a, n), Type::List(b, m)) if n <= m => {
                if let ExprKind::List(elements) = value.kind {
                    let elements = elements.into_iter().map(|e| self.coerce(e, b, what)).collect();
                    return Expr { kind: ExprKind::List(elements), ty: ty.clone(), span, range: Interval::ANY };
                }
                if a == b && n == m {
                    return value;
                }
            }
            _ => {}
        }
        self.mismatch(&value, ty, what);
        Expr { ty: Type::Unknown, ..value }
    }

    fn mismatch(&mut self, value: &Expr, wanted: &Type, what: &str) {
        let (has, wants) = (self.type_name(&value.ty), self.type_name(wanted));
        let finding = Diagnostic::error(
            "types::mismatch",
            value.span,
            format!("{what} is {}, this is {}", article(&wants), article(&has)),
        )
        .here(format!("`{has}`"));
        let finding = match (&value.ty, wanted) {
            (Type::Optional(inner), w) if **inner == *w => {
                finding.help("it may be absent: write `… else VALUE`, or test it with `if` before".to_string())
            }
            (Type::Quantity(_), Type::Heading) if value.ty.dimension() == Some(Dimension::ANGLE) => {
                finding.help("an angle is measured from something: write `HEADING + ANGLE`, such as `north + x`")
            }
            (Type::Heading, Type::Quantity(d)) if *d == Dimension::ANGLE => {
                finding.help("an angle lies between two headings: write `HEADING - HEADING`")
            }
            (Type::Quantity(d), Type::Depth) if *d == Dimension::LENGTH => {
                finding.help("a depth is counted from the surface: write `depth + LENGTH`, or a constant")
            }
            (Type::Quantity(d), Type::Altitude) if *d == Dimension::LENGTH => {
                finding.help("an altitude is counted from the bottom: write `altitude + LENGTH`, or a constant")
            }
            (Type::Int | Type::Quantity(_), Type::Quantity(d)) if value.ty.dimension() == Some(Dimension::NONE) => {
                finding.help(format!("give it a unit, such as `{}`", d.display().unit))
            }
            (Type::Quantity(has), Type::Quantity(wants)) => finding.help(scaling_help(*has, *wants)),
            (Type::Vector(d), Type::Point) if *d == Dimension::LENGTH => {
                finding.help("a vector leads from one point to another: write `POINT + VECTOR`")
            }
            (Type::Point, Type::Vector(_)) => {
                finding.help("a vector leads from one point to another: write `POINT - POINT`")
            }
            (Type::Depth, Type::Altitude) | (Type::Altitude, Type::Depth) => finding
                .help("depth is counted from the surface and altitude from the bottom; `water_depth` is both together"),
            (Type::Text, _) => finding.help("a text cannot be calculated with: leave the quotes out"),
            _ => finding,
        };
        self.report(finding);
    }

    /// A condition: a `Bool`, or an optional, which then means "is present".
    pub(super) fn condition(&mut self, e: &tree::Expr) -> Expr {
        let value = self.expr(e, Some(&Type::Bool));
        self.truth(value)
    }

    pub(super) fn truth(&mut self, value: Expr) -> Expr {
        let span = value.span;
        match &value.ty {
            Type::Bool | Type::Unknown => value,
            Type::Optional(_) | Type::None => self.make(ExprKind::IsPresent(Box::new(value)), Type::Bool, span),
            other => {
                let name = self.type_name(other);
                self.report(
                    Diagnostic::error("types::condition", span, format!("this is {}, no condition", article(&name)))
                        .here(format!("`{name}`"))
                        .help("compare it with something, such as `x > 0 m`"),
                );
                self.unknown(span)
            }
        }
    }

    /// An expression of whatever type it has; the expected one settles what could be several.
    pub(super) fn expr(&mut self, e: &tree::Expr, expected: Option<&Type>) -> Expr {
        use tree::ExprKind as K;
        let span = e.span;
        match &e.kind {
            K::Number { value, unit } => self.number(*value, unit.as_ref(), span),
            K::Geodetic { latitude_deg, longitude_deg } => {
                if latitude_deg.abs() > 90.0 || longitude_deg.abs() > 180.0 {
                    self.report(
                        Diagnostic::error("types::position", span, "there is no such place on the globe")
                            .help("latitudes go to 90° and longitudes to 180°"),
                    );
                }
                let kind = ExprKind::Geodetic { latitude_deg: *latitude_deg, longitude_deg: *longitude_deg };
                self.make(kind, Type::Point, span)
            }
            K::Text(parts) => {
                let parts = self.text(parts);
                self.make(ExprKind::Text(parts), Type::Text, span)
            }
            K::Bool(b) => {
                let number = ExprKind::Number(f64::from(u8::from(*b)));
                Expr { kind: number, ty: Type::Bool, span, range: Interval::ANY }
            }
            K::None => self.make(ExprKind::None, Type::None, span),
            K::Done => self.done(span),
            K::Name(name) => self.name(name, span),
            K::Paren(inner) => {
                let inner = self.expr(inner, expected);
                Expr { span, ..inner }
            }
            K::Member(base, member) => self.member(base, member, span),
            K::Call(callee, args) => self.call(callee, args, span, expected),
            K::Index(base, index) => self.index(base, index, span),
            K::List(elements) => self.list(elements, expected, span),
            K::Unary(op, operand) => self.unary(op, operand, span),
            K::Binary(op, left, right) => self.binary(op, left, right, expected, span),
            K::HasHeldFor(holds, duration) => self.held_for(holds, duration, span),
            K::If { condition, then, otherwise } => self.if_value(condition, then, otherwise.as_ref(), expected, span),
            K::Match { on, arms } => self.match_value(on, arms, expected, span),
        }
    }

    fn number(&mut self, value: f64, unit: Option<&tree::Name>, span: Span) -> Expr {
        if !value.is_finite() {
            self.report(Diagnostic::error("types::number", span, "this number is too large to be calculated with"));
            return self.unknown(span);
        }
        if unit.is_none() && value.abs() > INT_MAX {
            self.report(
                Diagnostic::error("types::number", span, "this whole number is too large to be counted exactly")
                    .help(format!("whole numbers go to {INT_MAX}")),
            );
            return self.unknown(span);
        }
        match unit {
            None if value.fract() == 0.0 => self.make(ExprKind::Number(value), Type::Int, span),
            None => self.make(ExprKind::Number(value), Type::Quantity(Dimension::NONE), span),
            Some(word) => match self.unit(self.scope.module, word) {
                Some(unit) => self.make(ExprKind::Number(value * unit.scale), Type::Quantity(unit.dimension), span),
                None => self.unknown(span),
            },
        }
    }

    pub(super) fn text(&mut self, parts: &[tree::TextPart]) -> Vec<TextPart> {
        let mut out = Vec::new();
        for part in parts {
            match part {
                tree::TextPart::Literal(text) => out.push(TextPart::Literal(text.clone())),
                tree::TextPart::Hole(e) => out.push(TextPart::Hole(self.expr(e, None))),
            }
        }
        out
    }

    fn done(&mut self, span: Span) -> Expr {
        if self.scope.temporal != Temporal::Rule {
            self.report(
                Diagnostic::error("rules::done", span, "`done` means something in a switching rule only")
                    .help("in a body, what follows a statement runs when it is done"),
            );
        }
        Expr { kind: ExprKind::Done, ty: Type::Bool, span, range: Interval::ANY }
    }

    /// A variable as it can be used here: without its `?` where it is known to be present.
    pub(super) fn variable(&self, id: usize, span: Span) -> Expr {
        let var = &self.scope.vars[id];
        let place = Place::Var(id);
        let range = self.scope.facts.narrowed(place, var.range);
        let value = Expr { kind: ExprKind::Var(id), ty: var.ty.clone(), span, range };
        match &var.ty {
            Type::Optional(inner) if self.scope.facts.is_present(place) => {
                Expr { ty: (**inner).clone(), kind: ExprKind::Unwrap(Box::new(value)), span, range }
            }
            _ => value,
        }
    }

    fn name(&mut self, name: &str, span: Span) -> Expr {
        if let Some(id) = self.local(name) {
            return self.variable(id, span);
        }
        let found = self.lookup(self.scope.module, name).cloned();
        match found {
            Some(def) => self.def_value(&def, name, span),
            None => {
                self.unknown_name(name, span);
                self.unknown(span)
            }
        }
    }

    /// The value that a module's name stands for.
    pub(super) fn def_value(&mut self, def: &Def, name: &str, span: Span) -> Expr {
        match def {
            Def::Const(id) => Expr { span, ..self.constant(*id) },
            Def::Signal(id) => {
                let value = self.module_signal(*id);
                if self.scope.setting == Setting::Function || self.scope.setting == Setting::Constant {
                    self.no_inputs_here(name, span);
                }
                Expr { span, ..value }
            }
            Def::Variant(id, variant) => {
                Expr { kind: ExprKind::Number(*variant as f64), ty: Type::Enum(*id), span, range: Interval::ANY }
            }
            Def::Input(id) => {
                if self.scope.setting == Setting::Function || self.scope.setting == Setting::Constant {
                    self.no_inputs_here(name, span);
                }
                let input = &self.hir.inputs[*id];
                let range = self.scope.facts.narrowed(Place::Input(*id), Interval::ANY);
                Expr { kind: ExprKind::Input(*id, InputPart::Value), ty: input.ty.clone(), span, range }
            }
            other => {
                let what = other.what();
                let finding = Diagnostic::error("names::value", span, format!("`{name}` is {what}, no value"));
                let finding = match other {
                    Def::Fn(_) | Def::Record(_) => finding.help(format!("write `{name}(…)`")),
                    Def::Activity(_) => finding.help(format!("call it as a statement: `{name}(…)`")),
                    _ => finding,
                };
                self.report(finding);
                self.unknown(span)
            }
        }
    }

    fn no_inputs_here(&mut self, name: &str, span: Span) {
        let finding = if self.scope.setting == Setting::Function {
            Diagnostic::error("names::input", span, format!("a function cannot read the input `{name}`"))
                .help("give the function a parameter, and pass the input as its argument")
        } else {
            Diagnostic::error("names::input", span, format!("`{name}` is known only when the vehicle moves"))
                .here("a constant is needed here")
        };
        self.report(finding);
    }

    fn unknown_name(&mut self, name: &str, span: Span) {
        let finding = Diagnostic::error("names::unknown", span, format!("nothing is named `{name}` here"));
        let finding = if self.modules[self.scope.module].imports.contains_key(name) {
            Diagnostic::error("names::module", span, format!("`{name}` is a module, no value"))
                .help(format!("write `{name}.NAME`"))
        } else if let Some(near) = suggest::nearest(name, self.known_names().iter().map(String::as_str)) {
            finding.help(format!("did you mean `{near}`?"))
        } else if let Some(module) = self.module_that_has(name) {
            finding.help(format!("the module `{module}` has one: write `{module}.{name}`"))
        } else {
            finding
        };
        self.report(finding);
    }

    fn module_that_has(&self, name: &str) -> Option<&str> {
        let imports = &self.modules[self.scope.module].imports;
        imports.iter().find(|(_, i)| self.names[**i].contains_key(name)).map(|(module, _)| module.as_str())
    }

    fn known_names(&self) -> Vec<String> {
        let mut names: Vec<String> = self.scope.visible.iter().map(|(n, _)| n.clone()).collect();
        let modules = (0..self.modules.len()).filter(|&m| m == self.scope.module || self.modules[m].prelude);
        for m in modules {
            let values =
                self.names[m].iter().filter(|(_, d)| !matches!(d, Def::Scenario(_) | Def::Clause(_) | Def::Unit(_)));
            names.extend(values.map(|(n, _)| n.clone()));
        }
        names
    }

    /// What `module.name` or `name` before parentheses leads to, when its head is no variable.
    pub(super) fn find(&self, e: &tree::Expr) -> Found {
        use tree::ExprKind as K;
        match &e.kind {
            K::Name(name) => {
                let callable = self.lookup_if(self.scope.module, name, Def::can_be_called);
                callable.cloned().map_or(Found::Nothing, Found::Def)
            }
            K::Member(base, member) => match &base.kind {
                K::Name(module) if self.local(module).is_none() => {
                    let def = self.imported(self.scope.module, module, &member.node);
                    def.cloned().map_or(Found::Nothing, Found::Def)
                }
                _ => Found::Nothing,
            },
            _ => Found::Nothing,
        }
    }

    /// The module that a name stands for, when it is no value.
    pub(super) fn module_named(&self, e: &tree::Expr) -> Option<usize> {
        match &e.kind {
            tree::ExprKind::Name(name) if self.local(name).is_none() => {
                self.modules[self.scope.module].imports.get(name).copied()
            }
            _ => None,
        }
    }

    fn list(&mut self, elements: &[tree::Expr], expected: Option<&Type>, span: Span) -> Expr {
        let wanted = match expected.map(Type::present) {
            Some(Type::List(inner, _)) => Some((**inner).clone()),
            _ => None,
        };
        let mut checked: Vec<Expr> = Vec::new();
        let mut common = wanted;
        for element in elements {
            let value = match &common {
                Some(ty) => self.expr_as(element, &ty.clone(), "an element of this list"),
                None => self.expr(element, None),
            };
            if common.is_none() && value.ty != Type::Unknown {
                common = Some(value.ty.clone());
            }
            checked.push(value);
        }
        let ty = match common {
            Some(inner) => Type::List(Box::new(inner), checked.len().max(1) as u32),
            None => Type::Unknown,
        };
        self.make(ExprKind::List(checked), ty, span)
    }

    fn index(&mut self, base: &tree::Expr, index: &tree::Expr, span: Span) -> Expr {
        let list = self.expr(base, None);
        let index = self.expr_as(index, &Type::Int, "an index");
        match list.ty.clone() {
            Type::List(inner, _) => self.operation(Builtin::At, vec![list, index], inner.optional(), span),
            Type::Unknown => self.unknown(span),
            other => {
                let name = self.type_name(&other);
                self.report(Diagnostic::error(
                    "types::index",
                    base.span,
                    format!("{} has no elements to index", article(&name)),
                ));
                self.unknown(span)
            }
        }
    }

    fn held_for(&mut self, holds: &tree::Expr, duration: &tree::Expr, span: Span) -> Expr {
        if let tree::ExprKind::Binary(op, left, right) = &holds.kind
            && matches!(op.node, tree::Binary::And | tree::Binary::Or)
        {
            let _ = left;
            self.report(
                Diagnostic::error(
                    "time::ambiguous",
                    span,
                    format!("`for` beside `{}` needs parentheses", op.node.symbol()),
                )
                .label(right.span, "for this alone?")
                .help(format!(
                    "write `(… {0} …) for T` when both together must have held, `… {0} (… for T)` when only the last must",
                    op.node.symbol()
                )),
            );
        }
        self.temporal_allowed(span, "for");
        let holds = self.condition(holds);
        let duration = self.expr_as(duration, &Type::Quantity(Dimension::TIME), "the time after `for`");
        self.make(ExprKind::HeldFor(Box::new(holds), Box::new(duration)), Type::Bool, span)
    }

    pub(super) fn temporal_allowed(&mut self, span: Span, word: &str) {
        if self.scope.temporal == Temporal::No {
            self.report(
                Diagnostic::error("time::here", span, format!("`{word}` has no beginning to count from here"))
                    .help("it stands in rules, in `on`, `until` and `abort … on`, and in a `signal`; name it there"),
            );
        }
    }

    fn unary(&mut self, op: &crate::source::Spanned<Unary>, operand: &tree::Expr, span: Span) -> Expr {
        match op.node {
            Unary::Not | Unary::No => {
                // `no X for T` is `(not X) for T`: the grammar has made it so.
                let value = self.condition(operand);
                self.operation(Builtin::Not, vec![value], Type::Bool, span)
            }
            Unary::Becomes => {
                self.temporal_allowed(span, "becomes");
                let value = self.condition(operand);
                self.make(ExprKind::Becomes(Box::new(value)), Type::Bool, span)
            }
            Unary::After => {
                self.temporal_allowed(span, "after");
                let time = self.expr_as(operand, &Type::Quantity(Dimension::TIME), "the time after `after`");
                self.make(ExprKind::After(Box::new(time)), Type::Bool, span)
            }
            Unary::Pos => {
                let value = self.expr(operand, None);
                self.signed(value, operand, span, false)
            }
            Unary::Neg => {
                let value = self.expr(operand, None);
                self.signed(value, operand, span, true)
            }
        }
    }

    fn signed(&mut self, value: Expr, operand: &tree::Expr, span: Span, negative: bool) -> Expr {
        let ty = match value.ty.clone() {
            ty @ (Type::Int | Type::Sign | Type::Quantity(_)) => ty,
            Type::Vector(d) => {
                if !negative {
                    return value;
                }
                let minus = self.make(ExprKind::Number(-1.0), Type::Int, span);
                return self.operation(Builtin::Scale, vec![value, minus], Type::Vector(d), span);
            }
            Type::Unknown => return self.unknown(span),
            other => {
                let name = self.type_name(&other);
                let sign = if negative { "-" } else { "+" };
                let finding =
                    Diagnostic::error("types::sign", operand.span, format!("{} has no `{sign}`", article(&name)));
                let finding = if matches!(other, Type::Heading) {
                    finding.help("for the opposite direction write `HEADING + 180 deg`")
                } else {
                    finding
                };
                self.report(finding);
                return self.unknown(span);
            }
        };
        if negative { self.operation(Builtin::Neg, vec![value], ty, span) } else { Expr { span, ..value } }
    }

    /// `if` as a value: both blocks must end in one.
    fn if_value(
        &mut self,
        condition: &Condition,
        then: &tree::Block,
        otherwise: Option<&tree::Block>,
        expected: Option<&Type>,
        span: Span,
    ) -> Expr {
        let Some(otherwise) = otherwise else {
            self.report(
                Diagnostic::error("types::if_value", span, "this `if` has no value when its condition does not hold")
                    .help("add `else { … }`"),
            );
            return self.unknown(span);
        };
        let Condition::Holds(condition) = condition else {
            self.report(
                Diagnostic::error("types::if_let", span, "`if let` is a statement, no value")
                    .help("name the optional with `let` before, and test it with `if NAME`"),
            );
            return self.unknown(span);
        };
        let condition = self.with_temporal(Temporal::No, |c| c.condition(condition));
        let mut then_block = self.block_knowing(facts::shown(&condition, true), then, expected);
        let mut else_block = self.block_knowing(facts::shown(&condition, false), otherwise, expected);
        let ty = self.join(&mut then_block, &mut else_block, span);
        self.make(ExprKind::If(Box::new(condition), then_block, else_block), ty, span)
    }

    /// A block as a value, with what its condition has shown.
    pub(super) fn block_knowing(&mut self, facts: Vec<Fact>, block: &tree::Block, expected: Option<&Type>) -> Block {
        self.in_block(|c| {
            c.scope.facts.learn(facts);
            c.value_block(block, expected)
        })
    }

    /// Makes two blocks end in values of one type.
    fn join(&mut self, a: &mut Block, b: &mut Block, span: Span) -> Type {
        let (Some(x), Some(y)) = (a.value.take(), b.value.take()) else {
            self.report(
                Diagnostic::error("types::if_value", span, "both blocks must end in a value")
                    .help("end each block with an expression"),
            );
            return Type::Unknown;
        };
        let ty = match (&x.ty, &y.ty) {
            (Type::None, other) | (other, Type::None) => other.clone().optional(),
            (Type::Optional(_), _) => x.ty.clone(),
            (_, Type::Optional(_)) => y.ty.clone(),
            (Type::Quantity(_), Type::Int | Type::Sign) | (_, Type::Unknown) => x.ty.clone(),
            (Type::Int | Type::Sign, Type::Quantity(_)) => y.ty.clone(),
            (Type::Int, Type::Int) if [&x, &y].iter().all(|v| v.range.constant().is_some_and(|n| n.abs() == 1.0)) => {
                Type::Sign
            }
            (Type::Heading, _) | (_, Type::Heading) => Type::Heading,
            _ => x.ty.clone(),
        };
        a.value = Some(Box::new(self.coerce(*x, &ty, "the value of the other block")));
        b.value = Some(Box::new(self.coerce(*y, &ty, "the value of the other block")));
        ty
    }

    fn match_value(&mut self, on: &tree::Expr, arms: &[tree::MatchArm], expected: Option<&Type>, span: Span) -> Expr {
        let (on, mut arms, mut otherwise) = self.match_arms(on, arms, expected, true, span);
        let mut ty: Option<Type> = None;
        for block in arms.iter_mut().map(|(_, b)| b).chain(otherwise.iter_mut()) {
            match block.value.take() {
                Some(value) => {
                    let wanted = ty.get_or_insert_with(|| value.ty.clone()).clone();
                    block.value = Some(Box::new(self.coerce(*value, &wanted, "the value of the other blocks")));
                }
                None => self.report(
                    Diagnostic::error("types::if_value", span, "every block of this `match` must end in a value")
                        .help("end each block with an expression"),
                ),
            }
        }
        self.make(ExprKind::Match(Box::new(on), arms, otherwise), ty.unwrap_or(Type::Unknown), span)
    }

    /// The arms of a `match` over an enum: each variant once, none forgotten.
    #[allow(clippy::type_complexity, reason = "the three parts of a match, taken apart at once by both callers")]
    pub(super) fn match_arms(
        &mut self,
        on: &tree::Expr,
        arms: &[tree::MatchArm],
        expected: Option<&Type>,
        as_value: bool,
        span: Span,
    ) -> (Expr, Vec<(Vec<usize>, Block)>, Option<Block>) {
        let on = self.expr(on, None);
        let variants = match &on.ty {
            Type::Enum(id) => self.types.enums[*id].variants.clone(),
            Type::Unknown => Vec::new(),
            other => {
                let name = self.type_name(other);
                self.report(
                    Diagnostic::error(
                        "types::match",
                        on.span,
                        format!("`match` chooses between the variants of an enum, this is {}", article(&name)),
                    )
                    .help("use `if`"),
                );
                Vec::new()
            }
        };
        let mut seen: Vec<usize> = Vec::new();
        let mut checked = Vec::new();
        let mut otherwise = None;
        for arm in arms {
            let mut indices = Vec::new();
            for name in &arm.names {
                match variants.iter().position(|v| *v == name.node) {
                    Some(i) if seen.contains(&i) => self.report(Diagnostic::error(
                        "types::match",
                        name.span,
                        format!("`{}` is matched already", name.node),
                    )),
                    Some(i) => {
                        seen.push(i);
                        indices.push(i);
                    }
                    None if variants.is_empty() => {}
                    None => {
                        let finding = Diagnostic::error(
                            "types::match",
                            name.span,
                            format!("there is no variant `{}`", name.node),
                        );
                        let finding = match suggest::help(&name.node, variants.iter().map(String::as_str)) {
                            Some(help) => finding.help(help),
                            None => finding,
                        };
                        self.report(finding);
                    }
                }
            }
            let block =
                self.in_block(|c| if as_value { c.value_block(&arm.block, expected) } else { c.block(&arm.block) });
            if arm.names.is_empty() { otherwise = Some(block) } else { checked.push((indices, block)) }
        }
        let missing: Vec<&str> =
            variants.iter().enumerate().filter(|(i, _)| !seen.contains(i)).map(|(_, v)| v.as_str()).collect();
        if otherwise.is_none() && !missing.is_empty() {
            let finding = Diagnostic::error(
                "types::match",
                span,
                format!("this `match` says nothing of {}", suggest::listed(&missing)),
            )
            .help("add an arm for each, or `else { … }`");
            self.report(finding);
        }
        (on, checked, otherwise)
    }

    /// Whether a variable may be assigned here.
    pub(super) fn assignable(&mut self, name: &tree::Name) -> Option<usize> {
        let Some(id) = self.local(&name.node) else {
            match self.lookup(self.scope.module, &name.node) {
                Some(def) => {
                    let what = def.what();
                    self.report(Diagnostic::error(
                        "names::assign",
                        name.span,
                        format!("`{}` is {what} and cannot be assigned", name.node),
                    ));
                }
                None => self.unknown_name(&name.node, name.span),
            }
            return None;
        };
        let var = &self.scope.vars[id];
        let (what, help) = match var.kind {
            VarKind::Memory if self.scope.setting == Setting::Function => {
                ("a memory, and functions are pure", "return the new value")
            }
            VarKind::Memory | VarKind::Var => return Some(id),
            VarKind::Let => ("fixed where it stands", "declare it with `memory`, or with `var` in instantaneous code"),
            VarKind::Param => ("a parameter", "declare a `memory` that begins with its value"),
            VarKind::Signal => ("a signal, computed anew at every tick", "declare a `memory`"),
            VarKind::Loop => ("set by its loop", "declare a `memory`"),
            VarKind::Area => ("the mission's area", "declare a `memory`"),
        };
        let finding =
            Diagnostic::error("names::assign", name.span, format!("`{}` is {what}: it cannot be assigned", name.node))
                .label(var.span, "declared here")
                .help(help);
        self.report(finding);
        None
    }
}

/// `a` or `an` before a type's name.
pub(super) fn article(name: &str) -> String {
    match name.chars().next() {
        Some('a') if name.starts_with("a ") => name.to_string(),
        _ if name == "none" => "`none`".to_string(),
        Some('A' | 'E' | 'I' | 'O') => format!("an {name}"),
        _ => format!("a {name}"),
    }
}

/// By what a quantity must be multiplied or divided to become another.
fn scaling_help(has: Dimension, wants: Dimension) -> String {
    let (factor, divisor) = (wants / has, has / wants);
    if let Some(name) = divisor.type_name() {
        format!("divide it by {}", article(name))
    } else if let Some(name) = factor.type_name() {
        format!("multiply it by {}", article(name))
    } else {
        format!("`{has}` and `{wants}` are different things")
    }
}
