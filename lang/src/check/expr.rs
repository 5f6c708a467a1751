//! Expressions: names, literals, conversions, conditions.

use super::args::NUMBER;
use super::choice::wider;
use super::facts::Place;
use super::result_range::of_type;
use super::{Checker, Temporal};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Builtin, Expr, ExprKind, InputPart, Interval, TextPart};
use crate::source::Span;
use crate::syntax::tree::{self, Unary};
use crate::types::Type;
use albacore_arithmetic::INT_MAX;

impl<'t> Checker<'t> {
    pub(super) fn unknown(&self, span: Span) -> Expr {
        Expr { kind: ExprKind::None, ty: Type::Unknown, span, range: Interval::ANY }
    }

    pub(super) fn make(&self, kind: ExprKind, ty: Type, span: Span) -> Expr {
        let range = match &kind {
            ExprKind::Number(x) => Interval::exactly(*x),
            ExprKind::Do(op, operands) => {
                let ranges: Vec<Interval> = operands.iter().map(|o| o.range).collect();
                super::result_range::range(*op, &ranges).unwrap_or_else(|| of_type(&ty))
            }
            ExprKind::Present(inner) => inner.range,
            ExprKind::If(_, a, b) => match (&a.value, &b.value) {
                (Some(a), Some(b)) => a.range.or(b.range),
                _ => Interval::ANY,
            },
            ExprKind::Match(_, arms, otherwise) => {
                let values = arms.iter().map(|(_, block)| block).chain(otherwise).map(|block| block.value.as_ref());
                let ranges = values.map(|value| value.map_or(Interval::ANY, |value| value.range));
                ranges.reduce(Interval::or).unwrap_or(Interval::ANY)
            }
            ExprKind::Else(a, b) => a.range.or(b.range),
            _ => of_type(&ty),
        };
        // What can be only one number is that number.
        let kind = match (range.constant(), &kind, ty.present()) {
            (
                Some(x),
                ExprKind::Do(..),
                Type::Quantity(_) | Type::Int | Type::Heading | Type::Depth | Type::Altitude | Type::Date,
            ) if !ty.is_optional() => ExprKind::Number(x),
            _ => kind,
        };
        Expr { kind, ty, span, range }
    }

    pub(super) fn operation(&self, op: Builtin, operands: Vec<Expr>, ty: Type, span: Span) -> Expr {
        self.make(ExprKind::Do(op, operands), ty, span)
    }

    /// An expression of whatever type it has; the expected one settles what could be several.
    pub(super) fn expr(&mut self, e: &tree::Expr, expected: Option<&Type>) -> Expr {
        use tree::ExprKind as K;
        let span = e.span;
        match &e.kind {
            K::Number { value, whole, is_counted, unit } => {
                self.number(*value, (*whole, *is_counted), unit.as_ref(), span)
            }
            K::Geodetic { latitude_deg, longitude_deg } => {
                if latitude_deg.abs() > 90.0 || longitude_deg.abs() > 180.0 {
                    self.report(
                        Diagnostic::error(Code::TypesPosition, span, "there is no such place on the globe")
                            .help("latitudes go to 90° and longitudes to 180°"),
                    );
                }
                let kind = ExprKind::Geodetic { latitude_deg: *latitude_deg, longitude_deg: *longitude_deg };
                self.make(kind, Type::Point, span)
            }
            K::Date(seconds) => self.make(ExprKind::Number(*seconds), Type::Date, span),
            K::Text(parts) => self.text_value(parts, span),
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
            K::Changed(base, fields) => self.changed(base, fields, span),
            K::List(elements) => self.list(elements, expected, span),
            K::Unary(op, operand) => self.unary(op, operand, span),
            K::Binary(op, left, right) => self.binary(op, left, right, expected, span),
            K::HasHeldFor(holds, duration) => self.held_for(holds, duration, span),
            K::If { condition, then, otherwise } => self.if_value(condition, then, otherwise.as_ref(), expected, span),
            K::Match { on, arms } => self.match_value(on, arms, expected, span),
        }
    }

    /// A number: its value, the whole number that it is and whether it is spelt as one, and its unit.
    fn number(
        &mut self,
        value: f64,
        (whole, is_counted): (Option<u64>, bool),
        unit: Option<&tree::Name>,
        span: Span,
    ) -> Expr {
        let can_be_counted = value <= INT_MAX && whole.is_none_or(|whole| whole <= INT_MAX as u64);
        if !value.is_finite() {
            let finding = Diagnostic::error(Code::TypesNumber, span, "this number is too large to be held");
            self.report(finding.help("the largest is about 1e150"));
            return self.unknown(span);
        }
        if unit.is_none() && !can_be_counted {
            let what = if is_counted {
                "whole number is too large to be counted exactly"
            } else {
                "number is too large to be meant"
            };
            let finding = Diagnostic::error(Code::TypesNumber, span, format!("this {what}"));
            self.report(finding.help(format!(
                "numbers without a unit go to {INT_MAX}; a quantity has one, and large ones a large unit: `3 km`"
            )));
            return self.unknown(span);
        }
        if unit.is_none() && whole.is_none() && value.fract() == 0.0 {
            self.report(
                Diagnostic::error(
                    Code::TypesNumber,
                    span,
                    format!("no number so close to a whole one can be held: this would be {value}"),
                )
                .help(format!("write `{value}`, or fewer digits: a number holds about 16")),
            );
            return self.unknown(span);
        }
        match unit {
            None if is_counted => self.make(ExprKind::Number(value), Type::Int, span),
            None => self.make(ExprKind::Number(value), NUMBER, span),
            Some(word) => match self.unit(self.scope.module, word) {
                Some(unit) if self.sensible_quantity(unit.si(value), span) => {
                    self.make(ExprKind::Number(unit.si(value)), Type::Quantity(unit.dimension), span)
                }
                _ => self.unknown(span),
            },
        }
    }

    /// A text as a value: the same for good. What holds values is computed where it is told, and nowhere else.
    fn text_value(&mut self, parts: &[tree::TextPart], span: Span) -> Expr {
        let parts = self.text(parts);
        if parts.iter().any(|part| matches!(part, TextPart::Hole(_))) {
            self.report(
                Diagnostic::error(
                    Code::TypesText,
                    span,
                    "a text with values in `{ }` stands only in `log` and `abort`",
                )
                .here("it is made where it is told")
                .help("write it there, and pass on what stands between `{` and `}`; a `report` gives values as labels"),
            );
            return self.unknown(span);
        }
        self.make(ExprKind::Text(parts), Type::Text, span)
    }

    /// What is told: a text with the values in it, or a value.
    pub(super) fn told(&mut self, e: &tree::Expr) -> Vec<TextPart> {
        match &e.kind {
            tree::ExprKind::Text(parts) => self.text(parts),
            tree::ExprKind::Paren(inner) => self.told(inner),
            tree::ExprKind::Name(name) if self.is_unknown(name) => {
                self.bare_text(name, e.span);
                Vec::new()
            }
            _ => vec![TextPart::Hole(self.expr(e, None))],
        }
    }

    fn text(&mut self, parts: &[tree::TextPart]) -> Vec<TextPart> {
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
                Diagnostic::error(Code::RulesDone, span, "`done` means something in a switching rule only")
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
            Type::Optional(_) if self.scope.facts.is_present(place) => value.unwrapped(),
            _ => value,
        }
    }

    fn list(&mut self, elements: &[tree::Expr], expected: Option<&Type>, span: Span) -> Expr {
        let wanted = match expected.map(Type::present) {
            Some(Type::List(inner, _)) => Some((**inner).clone()),
            _ => None,
        };
        let mut common = wanted.clone().or_else(|| self.unit_of_some(elements));
        let mut checked: Vec<Expr> = Vec::new();
        for element in elements {
            // What another is like says what an empty list would hold, and nothing else.
            let is_empty = matches!(&element.kind, tree::ExprKind::List(elements) if elements.is_empty());
            let value = self.expr(element, wanted.as_ref().or(common.as_ref().filter(|_| is_empty)));
            if common.is_none() && value.ty != Type::Unknown {
                common = Some(value.ty.clone());
            }
            checked.push(value);
        }
        // Whatever comes first, all become what all can be.
        if wanted.is_none() {
            common = common.map(|first| checked.iter().map(|value| value.ty.clone()).fold(first, wider));
        }
        if let Some(ty) = &common {
            checked = checked.into_iter().map(|value| self.coerce(value, ty, "an element of this list")).collect();
        }
        let ty = match common {
            Some(Type::None) => self.untold(span, "what would these be if they were present?"),
            None if checked.is_empty() => self.untold(span, "of what is this list empty?"),
            Some(inner) => Type::List(Box::new(inner), checked.len().max(1) as u32),
            None => Type::Unknown,
        };
        self.make(ExprKind::List(checked), ty, span)
    }

    /// Of a list that begins with a number without a unit: the type of the first number that has one, which the others want.
    fn unit_of_some(&self, elements: &[tree::Expr]) -> Option<Type> {
        let unit = |e: &tree::Expr| match &e.kind {
            tree::ExprKind::Number { unit: Some(unit), .. } => self.unit_if(self.scope.module, &unit.node),
            _ => None,
        };
        let is_bare = |e: &tree::Expr| matches!(e.kind, tree::ExprKind::Number { unit: None, .. });
        elements.first().filter(|e| is_bare(e))?;
        let unit = elements.iter().find_map(unit).filter(|unit| !unit.dimension.is_none())?;
        Some(Type::Quantity(unit.dimension))
    }

    /// The type of a list that says nothing of its elements, where nothing else does.
    fn untold(&mut self, span: Span, question: &str) -> Type {
        let finding = Diagnostic::error(Code::TypesEmpty, span, question);
        self.report(finding.help(
            "say it where the list is named: `let places: [Point; 6] = []`; whether a list is empty tells its `count`: `places.count == 0`",
        ));
        Type::Unknown
    }

    fn index(&mut self, base: &tree::Expr, index: &tree::Expr, span: Span) -> Expr {
        let list = self.expr(base, None);
        if let Type::Map(inner, _) = list.ty.clone() {
            let place = self.expr_as(index, &Type::Point, "the place in a map");
            return self.operation(Builtin::Cell, vec![list, place], inner.optional(), span);
        }
        let index = match list.ty {
            // What is wrong with it has been told, and it may be a map.
            Type::Unknown => self.expr(index, None),
            _ => self.index_of_element(index),
        };
        match list.ty.clone() {
            Type::List(inner, _) => self.operation(Builtin::At, vec![list, index], inner.optional(), span),
            Type::Unknown => self.unknown(span),
            other => {
                let name = self.type_name(&other);
                let message = format!("{} has no elements to index", article(&name));
                let finding = Diagnostic::error(Code::TypesIndex, base.span, message).here(format!("`{name}`"));
                self.report(
                    finding.help("only a list and a map have elements; what else a value has stands after a dot"),
                );
                self.unknown(span)
            }
        }
    }

    fn held_for(&mut self, holds: &tree::Expr, duration: &tree::Expr, span: Span) -> Expr {
        if let tree::ExprKind::Binary(op, left, right) = &holds.kind
            && matches!(op.node, tree::Binary::And | tree::Binary::Or)
        {
            self.report(
                Diagnostic::error(
                    Code::TimeAmbiguous,
                    right.span.to(duration.span),
                    format!("`for` beside `{}` needs parentheses", op.node.symbol()),
                )
                .here("this alone for so long?")
                .label(left.span, "or with this?")
                .help(format!(
                    "write `(… {0} …) for T` when both together must have held, `… {0} (… for T)` when only the last must",
                    op.node.symbol()
                )),
            );
        }
        // `a for 5 s or b`: what stands after the time would be read as part of it.
        if let tree::ExprKind::Binary(op, time, other) = &duration.kind
            && matches!(op.node, tree::Binary::And | tree::Binary::Or)
        {
            let word = op.node.symbol();
            self.report(
                Diagnostic::error(
                    Code::TimeAmbiguous,
                    holds.span.to(time.span),
                    format!("`for` beside `{word}` needs parentheses"),
                )
                .here("this alone for so long?")
                .label(other.span, "or together with this?")
                .help(format!("write `(… for T) {word} …`, or `(… {word} …) for T` when both together must have held")),
            );
            return self.unknown(span);
        }
        let (holds, duration) = self.watched(|c| {
            let holds = match &holds.kind {
                tree::ExprKind::Unary(op, absent) if matches!(op.node, Unary::No) => c.negated(absent, holds.span),
                tree::ExprKind::Unary(op, _) if matches!(op.node, Unary::Not) => {
                    let message = "`not` before `for` can be read in two ways";
                    let finding = Diagnostic::error(Code::TimeAmbiguous, op.span, message);
                    c.report(finding.help("write `no X for T` for what has been absent for so long, `not (X for T)` for what has not been there for so long"));
                    c.condition(holds)
                }
                _ => c.condition(holds),
            };
            (holds, c.duration(duration, "the time after `for`"))
        });
        if duration.range.low > 0.0 && self.is_momentary(&holds) {
            self.report(
                Diagnostic::error(
                    Code::TimeMomentary,
                    holds.span,
                    "this holds for one tick at a time, and never for longer",
                )
                .help("write `becomes (X for T)` for the moment at which X has held for so long, or leave `for` out"),
            );
        }
        self.temporal("for", ExprKind::HeldFor(Box::new(holds), Box::new(duration)), span)
    }

    /// Whether a condition holds for one tick at a time: what becomes true, and what comes to its end.
    pub(super) fn is_momentary(&self, e: &Expr) -> bool {
        match &e.kind {
            ExprKind::Becomes(_) | ExprKind::Done => true,
            ExprKind::Var(id) => self.scope.vars[*id].is_momentary,
            ExprKind::Do(Builtin::And, operands) => operands.iter().any(|e| self.is_momentary(e)),
            _ => false,
        }
    }

    /// Works on what a temporal operator watches: it is computed on every tick, whatever stands beside it.
    fn watched<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let standing = self.scope.standing.known();
        let beside = std::mem::replace(&mut self.scope.facts, standing);
        let is_watched = std::mem::replace(&mut self.scope.is_watched, true);
        let result = self.on_later_ticks(work);
        self.scope.is_watched = is_watched;
        self.scope.facts = beside;
        result
    }

    /// A condition over time, where one may stand.
    fn temporal(&mut self, word: &str, condition: ExprKind, span: Span) -> Expr {
        if self.scope.temporal == Temporal::No {
            self.report(
                Diagnostic::error(Code::TimeHere, span, format!("`{word}` has no beginning to count from here"))
                    .help("it stands in rules, in `on`, `until` and `abort … on`, and in a `signal`; name it there"),
            );
            return self.unknown(span);
        }
        self.make(condition, Type::Bool, span)
    }

    /// `every T`, where something fires by which it begins anew.
    fn rhythm(&mut self, time: Expr, span: Span) -> Expr {
        if !matches!(self.scope.temporal, Temporal::Reaction | Temporal::Rule) || self.scope.is_watched {
            self.report(
                Diagnostic::error(Code::TimeRhythm, span, "`every` counts from when its `on` last fired, and here nothing fires")
                    .help("write it in the condition of a rule or of a reaction, `on every T { … }`, alone or beside `and` and `or`; elsewhere write `after T`"),
            );
            return self.unknown(span);
        }
        self.make(ExprKind::Every(Box::new(time)), Type::Bool, span)
    }

    fn unary(&mut self, op: &crate::source::Spanned<Unary>, operand: &tree::Expr, span: Span) -> Expr {
        match op.node {
            Unary::Not => self.negated(operand, span),
            Unary::No => {
                let finding =
                    Diagnostic::error(Code::TimeAbsence, op.span, "`no` says that something is absent for a time");
                self.report(finding.help("write `no X for T`; what does not hold now is `not X`"));
                self.negated(operand, span)
            }
            Unary::Becomes => {
                let value = self.watched(|c| c.condition(operand));
                if matches!(value.kind, ExprKind::Input(_, InputPart::IsNew)) {
                    let message =
                        "of an input that is sampled in every tick this never holds: there is no tick without a sample";
                    let finding = Diagnostic::warning(Code::TimeMomentary, span, message);
                    self.report(finding.help("`new X` holds in the ticks in which a sample came: leave `becomes` out"));
                }
                self.temporal("becomes", ExprKind::Becomes(Box::new(value)), span)
            }
            Unary::After => {
                let time = self.watched(|c| c.duration(operand, "the time after `after`"));
                self.temporal("after", ExprKind::After(Box::new(time)), span)
            }
            Unary::Every => {
                let time = self.watched(|c| c.duration(operand, "the time after `every`"));
                self.rhythm(time, span)
            }
            Unary::New => self.new_sample(operand, span),
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

    /// `not X`, and what has to hold for so long in `no X for T`.
    fn negated(&mut self, operand: &tree::Expr, span: Span) -> Expr {
        let is_watched = std::mem::replace(&mut self.scope.is_watched, true);
        let value = self.condition(operand);
        self.scope.is_watched = is_watched;
        self.operation(Builtin::Not, vec![value], Type::Bool, span)
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
                    Diagnostic::error(Code::TypesSign, operand.span, format!("{} has no `{sign}`", article(&name)));
                self.report(match (&other, &value.kind) {
                    (Type::Heading, _) => finding.help("for the opposite direction write `HEADING + 180 deg`"),
                    (_, ExprKind::Geodetic { .. }) => {
                        finding.help("south and west are written with a letter: `36.18°S 75.74°W`")
                    }
                    _ => finding,
                });
                return self.unknown(span);
            }
        };
        if negative { self.operation(Builtin::Neg, vec![value], ty, span) } else { Expr { span, ..value } }
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
