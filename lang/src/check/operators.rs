//! Operators between two operands: the whole table of what can be calculated with what.

use super::Checker;
use super::args::NUMBER;
use super::expr::article;
use super::quantity::with_zero;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind, InputPart, Interval};
use crate::source::{Span, Spanned};
use crate::syntax::tree::{self, Binary};
use crate::types::Type;
use albacore_arithmetic::{Div, Operation, Pow};

pub(super) const ANGLE: Type = Type::Quantity(Dimension::ANGLE);
const LENGTH: Type = Type::Quantity(Dimension::LENGTH);
const TIME: Type = Type::Quantity(Dimension::TIME);
const VECTOR: Type = Type::Vector(Dimension::LENGTH);

impl<'t> Checker<'t> {
    pub(super) fn binary(
        &mut self,
        op: &Spanned<Binary>,
        left: &tree::Expr,
        right: &tree::Expr,
        expected: Option<&Type>,
        span: Span,
    ) -> Expr {
        match op.node {
            Binary::And | Binary::Or => self.logical(op, left, right, span),
            Binary::Else => self.otherwise(left, right, expected, span),
            _ => {
                if self.chained(op, left) {
                    return self.unknown(span);
                }
                let (a, b) = (self.expr(left, None), self.expr(right, None));
                let (a, b) = self.as_meant(a, b);
                if a.ty == Type::Unknown || b.ty == Type::Unknown {
                    return self.unknown(span);
                }
                if op.node != Binary::Eq
                    && op.node != Binary::Ne
                    && let Some(absent) = [&a, &b].into_iter().find(|e| e.ty.is_optional())
                {
                    let finding = self.absent(absent);
                    self.report(finding);
                    return self.unknown(span);
                }
                let is_of_one_kind = !matches!(op.node, Binary::Mul | Binary::Div | Binary::Pow | Binary::Toward);
                let (a, b) = if is_of_one_kind { with_zero(a, b) } else { (a, b) };
                let of_constants = [&a, &b].into_iter().all(|e| matches!(e.kind, ExprKind::Number(_)));
                let value = match op.node {
                    Binary::Add => self.sum(op, a, b, span),
                    Binary::Sub => self.difference(op, a, b, span),
                    Binary::Mul => self.product(op, a, b, span),
                    Binary::Div => self.quotient(op, a, b, span),
                    Binary::Pow => self.power(op, a, b, span),
                    Binary::Toward => self.toward(op, a, b, span),
                    _ => self.comparison(op, a, b, span),
                };
                // A variable that is known to be at the end of its range has come there by itself.
                if of_constants { self.sensible_result(value) } else { value }
            }
        }
    }

    /// `a < b < c` reads like mathematics and means something else.
    fn chained(&mut self, op: &Spanned<Binary>, left: &tree::Expr) -> bool {
        if let tree::ExprKind::Binary(inner, ..) = &left.kind
            && op.node.compares()
            && inner.node.compares()
        {
            self.report(
                Diagnostic::error(Code::SyntaxChain, op.span, "comparisons cannot be chained")
                    .label(inner.span, "the first comparison")
                    .help("write `a < b and b < c`"),
            );
            return true;
        }
        false
    }

    /// Whether a value is absent because of a division by what may be zero.
    pub(super) fn is_quotient(value: &Expr) -> bool {
        matches!(&value.kind, ExprKind::Do(Builtin::Quotient | Builtin::VectorQuotient, _))
    }

    pub(super) fn absent(&self, value: &Expr) -> Diagnostic {
        let name = self.type_name(&value.ty);
        let why = match &value.kind {
            _ if Self::is_quotient(value) => "the divisor may be zero, and then there is no quotient",
            ExprKind::Do(Builtin::At, _) => "the list may be shorter",
            _ => "it may be absent",
        };
        Diagnostic::error(Code::AbsentUsed, value.span, format!("this is {}: {why}", article(&name)))
            .here(format!("`{name}`"))
            .help("write `(… else VALUE)`, or test it first: `let x = …` then `if x { … }`")
    }

    fn logical(&mut self, op: &Spanned<Binary>, left: &tree::Expr, right: &tree::Expr, span: Span) -> Expr {
        for side in [left, right] {
            // `becomes a or b` could mean either: rule 14 asks for parentheses.
            if let tree::ExprKind::Unary(word, _) = &side.kind
                && word.node == tree::Unary::Becomes
            {
                self.report(
                    Diagnostic::error(
                        Code::TimeAmbiguous,
                        side.span,
                        format!("`becomes` beside `{}` needs parentheses", op.node.symbol()),
                    )
                    .help(format!("write `(becomes …) {0} …`, or `becomes (… {0} …)`", op.node.symbol())),
                );
            }
        }
        let a = self.condition(left);
        let shown = self.shown(&a, op.node == Binary::And);
        let b = self.in_block(|c| {
            c.learn(shown);
            c.condition(right)
        });
        let builtin = if op.node == Binary::And { Builtin::And } else { Builtin::Or };
        self.operation(builtin, vec![a, b], Type::Bool, span)
    }

    fn otherwise(&mut self, left: &tree::Expr, right: &tree::Expr, expected: Option<&Type>, span: Span) -> Expr {
        let may_be_absent = expected.map(|ty| ty.clone().optional());
        let a = self.expr(left, may_be_absent.as_ref());
        let inner = match &a.ty {
            Type::Optional(inner) => (**inner).clone(),
            Type::Unknown => {
                self.expr(right, expected);
                return self.unknown(span);
            }
            _ => {
                let name = self.type_name(&a.ty);
                self.report(
                    Diagnostic::error(
                        Code::AbsentElse,
                        a.span,
                        format!("this is never absent: it is {}", article(&name)),
                    )
                    .help("leave out `else …`"),
                );
                self.expr(right, expected);
                return a;
            }
        };
        let b = self.expr(right, Some(&inner));
        self.adds_to_zero(left, right);
        let ty = if b.ty.is_optional() { a.ty.clone() } else { inner };
        let b = self.coerce(b, &ty, "what comes before `else`");
        self.make(ExprKind::Else(Box::new(a), Box::new(b)), ty, span)
    }

    /// `x else 0 + 1` reads as `x else (0 + 1)`: who adds to zero means the parentheses elsewhere.
    fn adds_to_zero(&mut self, left: &tree::Expr, right: &tree::Expr) {
        let tree::ExprKind::Binary(op, zero, _) = &right.kind else { return };
        let is_zero = matches!(&zero.kind, tree::ExprKind::Number { value, .. } if *value == 0.0);
        if !matches!(op.node, Binary::Add | Binary::Sub) || !is_zero {
            return;
        }
        let finding = Diagnostic::warning(Code::AbsentElse, right.span, "the whole sum stands for what is absent");
        let sign = op.node.symbol();
        self.report(
            finding
                .label(left.span, "where this is present nothing is added")
                .help(format!("write `(… else 0) {sign} …`")),
        );
    }

    fn sum(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        use Type::*;
        let (op_, ty) = match (&a.ty, &b.ty) {
            (Int | Sign, Int | Sign) => (Builtin::AddInt, Int),
            (Heading, t) | (t, Heading) if *t == ANGLE => {
                let sum = self.operation(Builtin::Add, vec![a, b], ANGLE, span);
                return self.operation(Builtin::Heading, vec![sum], Heading, span);
            }
            (Depth, t) | (t, Depth) if *t == LENGTH => (Builtin::Add, Depth),
            (Altitude, t) | (t, Altitude) if *t == LENGTH => (Builtin::Add, Altitude),
            (Date, t) | (t, Date) if *t == TIME => (Builtin::Add, Date),
            (Point, t) | (t, Point) if *t == VECTOR => (Builtin::AddVector, Point),
            (Vector(x), Vector(y)) if x == y => (Builtin::AddVector, Vector(*x)),
            (x, y) => match (x.dimension(), y.dimension()) {
                (Some(d), Some(e)) if d == e => (Builtin::Add, Quantity(d.beside(e))),
                _ => return self.no_such(op, &a, &b, span),
            },
        };
        self.operation(op_, vec![a, b], ty, span)
    }

    fn difference(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        use Type::*;
        let (op_, ty) = match (&a.ty, &b.ty) {
            (Int | Sign, Int | Sign) => (Builtin::SubInt, Int),
            (Heading, Heading) => {
                let difference = self.operation(Builtin::Sub, vec![a, b], ANGLE, span);
                return self.operation(Builtin::Angle, vec![difference], ANGLE, span);
            }
            (Heading, t) if *t == ANGLE => {
                let difference = self.operation(Builtin::Sub, vec![a, b], ANGLE, span);
                return self.operation(Builtin::Heading, vec![difference], Heading, span);
            }
            (Depth, Depth) | (Altitude, Altitude) => (Builtin::Sub, LENGTH),
            (Depth, t) if *t == LENGTH => (Builtin::Sub, Depth),
            (Altitude, t) if *t == LENGTH => (Builtin::Sub, Altitude),
            (Date, Date) => (Builtin::Sub, TIME),
            (Date, t) if *t == TIME => (Builtin::Sub, Date),
            (Point, Point) => (Builtin::SubVector, VECTOR),
            (Point, t) if *t == VECTOR => (Builtin::SubVector, Point),
            (Vector(x), Vector(y)) if x == y => (Builtin::SubVector, Vector(*x)),
            (x, y) => match (x.dimension(), y.dimension()) {
                (Some(d), Some(e)) if d == e => (Builtin::Sub, Quantity(d.beside(e))),
                _ => return self.no_such(op, &a, &b, span),
            },
        };
        self.operation(op_, vec![a, b], ty, span)
    }

    fn product(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        if let (Type::Int | Type::Sign, Type::Int | Type::Sign) = (&a.ty, &b.ty) {
            return self.operation(Builtin::MulInt, vec![a, b], Type::Int, span);
        }
        let (of_vectors, dimensions) = match (&a.ty, &b.ty) {
            (Type::Vector(v), t) | (t, Type::Vector(v)) => (true, t.dimension().map(|d| (*v, d))),
            (x, y) => (false, x.dimension().zip(y.dimension())),
        };
        let Some((d, e)) = dimensions else { return self.no_such(op, &a, &b, span) };
        let Some(d) = self.writable(d.times(e), "product", span) else { return self.unknown(span) };
        match (of_vectors, matches!(a.ty, Type::Vector(_))) {
            (false, _) => self.operation(Builtin::Mul, vec![a, b], Type::Quantity(d), span),
            (true, true) => self.operation(Builtin::Scale, vec![a, b], Type::Vector(d), span),
            (true, false) => self.operation(Builtin::Scale, vec![b, a], Type::Vector(d), span),
        }
    }

    /// A dimension that a value can have, or an error.
    pub(super) fn writable(&mut self, dimension: Option<Dimension>, of: &str, span: Span) -> Option<Dimension> {
        if dimension.is_none() {
            let message = format!("the dimension of this {of} cannot be written");
            let finding = Diagnostic::error(Code::TypesPower, span, message);
            self.report(finding.help("powers of units are whole or halves, such as `m/s^0.5`, and no higher than 50"));
        }
        dimension
    }

    /// Division: by what may be zero it may have no result.
    fn quotient(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        let Some(divisor) = b.ty.dimension() else { return self.no_such(op, &a, &b, span) };
        if b.range.constant() == Some(0.0) {
            self.report(
                Diagnostic::error(Code::RangesZero, b.span, "this divides by zero")
                    .help("divide by something else, or leave the division out"),
            );
            return self.unknown(span);
        }
        let (of_vector, dividend) = match &a.ty {
            Type::Vector(v) => (true, Some(*v)),
            t => (false, t.dimension()),
        };
        let Some(dividend) = dividend else { return self.no_such(op, &a, &b, span) };
        let Some(d) = self.writable(dividend.over(divisor), "quotient", span) else { return self.unknown(span) };
        let ty = if of_vector { Type::Vector(d) } else { Type::Quantity(d) };
        if !Div::is_defined([a.range, b.range]) {
            let quotient = if of_vector { Builtin::VectorQuotient } else { Builtin::Quotient };
            return self.operation(quotient, vec![a, b], ty.optional(), span);
        }
        if !of_vector {
            return self.operation(Builtin::Div, vec![a, b], ty, span);
        }
        let one = self.make(ExprKind::Number(1.0), Type::Int, span);
        let inverse = self.operation(Builtin::Div, vec![one, b], NUMBER, span);
        self.operation(Builtin::Scale, vec![a, inverse], ty, span)
    }

    fn power(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        let Some((d, _)) = a.ty.dimension().zip(b.ty.dimension()).filter(|(_, power)| power.is_none()) else {
            return self.no_such(op, &a, &b, span);
        };
        let Some(power) = b.range.constant() else {
            self.report(
                Diagnostic::error(Code::TypesPower, b.span, "a power must be a constant")
                    .help("the dimension of the result depends on it"),
            );
            return self.unknown(span);
        };
        if !Pow::is_defined([a.range, b.range]) {
            self.report(
                Diagnostic::error(Code::TypesPower, b.span, "this power has no value for some bases")
                    .help("use a positive whole power, `sqrt(x)`, or divide"),
            );
            return self.unknown(span);
        }
        match self.writable(d.power(power), "power", span) {
            Some(d) => self.operation(Builtin::Pow, vec![a, b], Type::Quantity(d), span),
            None => self.unknown(span),
        }
    }

    fn toward(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        let are_exchanged = a.ty == ANGLE && b.ty.dimension().is_some() && b.ty != ANGLE;
        let Some(d) = a.ty.dimension().filter(|_| !are_exchanged) else { return self.no_such(op, &a, &b, span) };
        let b = self.coerce(b, &Type::Heading, "the direction after `toward`");
        self.operation(Builtin::Toward, vec![a, b], Type::Vector(d), span)
    }

    fn comparison(&mut self, op: &Spanned<Binary>, a: Expr, b: Expr, span: Span) -> Expr {
        use Type::*;
        let equality = matches!(op.node, Binary::Eq | Binary::Ne);
        let of_heading = |x: &Type, y: &Type| *x == Heading && (*y == Heading || *y == ANGLE);
        if !equality && (of_heading(&a.ty, &b.ty) || of_heading(&b.ty, &a.ty)) {
            let message = "headings have no order: 350 deg is just left of 10 deg";
            let finding = Diagnostic::error(Code::TypesOrder, op.span, message)
                .here(format!("`{}`", op.node.symbol()))
                .label(a.span, format!("`{}`", self.type_name(&a.ty)))
                .label(b.span, format!("`{}`", self.type_name(&b.ty)))
                .help("compare the angle between two, `abs(heading - north) < 3 deg`");
            self.report(finding);
            return self.unknown(span);
        }
        if !are_comparable(&a, &b, equality) {
            return self.no_such(op, &a, &b, span);
        }
        // A constant angle beside a heading is a heading as it is elsewhere: -90 deg points where 270 deg does.
        let (a, b) = match (&a.ty, &b.ty) {
            (Heading, Quantity(_)) => (a, self.coerce(b, &Heading, "the other side")),
            (Quantity(_), Heading) => (self.coerce(a, &Heading, "the other side"), b),
            _ => (a, b),
        };
        // `p != none` is `p` as a condition, and narrows as that does.
        if let Some(optional) = match (&a.ty, &b.ty) {
            (Optional(_), None) => Some(a.clone()),
            (None, Optional(_)) => Some(b.clone()),
            _ => Option::None,
        } {
            let present = self.truth(Expr { span, ..optional });
            return if op.node == Binary::Eq {
                self.operation(Builtin::Not, vec![present], Bool, span)
            } else {
                present
            };
        }
        self.sensible_ratio(&a, &b);
        // `x == none`: both sides are of one size, or what lies beside `none` would be compared.
        let (a, b) = match (a.ty.is_optional() && a.ty != None, b.ty.is_optional() && b.ty != None) {
            (true, false) => {
                let ty = a.ty.clone();
                let b = self.coerce(b, &ty, "the other side");
                (a, b)
            }
            (false, true) => {
                let ty = b.ty.clone();
                let a = self.coerce(a, &ty, "the other side");
                (a, b)
            }
            _ => (a, b),
        };
        let (builtin, operands, negate) = match op.node {
            Binary::Lt => (Builtin::Lt, vec![a, b], false),
            Binary::Le => (Builtin::Le, vec![a, b], false),
            Binary::Gt => (Builtin::Lt, vec![b, a], false),
            Binary::Ge => (Builtin::Le, vec![b, a], false),
            Binary::Ne => (Builtin::Eq, vec![a, b], true),
            _ => (Builtin::Eq, vec![a, b], false),
        };
        let compared = Expr { kind: ExprKind::Do(builtin, operands), ty: Bool, span, range: Interval::ANY };
        if negate { self.operation(Builtin::Not, vec![compared], Bool, span) } else { compared }
    }

    /// `battery < 10`: an input that is a ratio, and a number that was meant as percent.
    fn sensible_ratio(&mut self, a: &Expr, b: &Expr) {
        for (read, number) in [(a, b), (b, a)] {
            let is_ratio = matches!(read.kind, ExprKind::Input(_, InputPart::Value | InputPart::Peak))
                && read.ty == Type::Quantity(Dimension::NONE);
            if let Some(x) = number.range.constant().filter(|x| is_ratio && *x > 1.0 && number.ty == Type::Int) {
                let message = format!("a ratio of {x} is {} %", x * 100.0);
                self.report(
                    Diagnostic::warning(Code::RangesRatio, number.span, message).help(format!("write `{x} %`")),
                );
            }
        }
    }

    /// Two operands that an operator does not take: each is labelled with what it is.
    fn no_such(&mut self, op: &Spanned<Binary>, a: &Expr, b: &Expr, span: Span) -> Expr {
        let (left, right) = (self.type_name(&a.ty), self.type_name(&b.ty));
        let symbol = op.node.symbol();
        let (code, verb) = match op.node {
            Binary::Add => (Code::TypesSum, "cannot be added"),
            Binary::Sub => (Code::TypesDifference, "cannot be subtracted from one another"),
            Binary::Mul => (Code::TypesProduct, "cannot be multiplied"),
            Binary::Div => (Code::TypesQuotient, "cannot be divided"),
            Binary::Toward => (Code::TypesToward, "make no vector"),
            Binary::Pow => (Code::TypesPower, "make no power"),
            _ => (Code::TypesComparison, "cannot be compared"),
        };
        // Those that can be compared otherwise are of one type.
        let has_no_order = op.node.compares() && a.ty == b.ty;
        let message = match has_no_order {
            true => format!("{} has no order", article(&left)),
            false => format!("{} and {} {verb}", article(&left), article(&right)),
        };
        let finding = Diagnostic::error(code, op.span, message)
            .here(format!("`{symbol}`"))
            .label(a.span, format!("`{left}`"))
            .label(b.span, format!("`{right}`"));
        let help = match (left == right, a.ty == b.ty) {
            _ if has_no_order => Some("only `==` and `!=` compare two of them".to_string()),
            (true, false) => Some(self.namesakes().to_string()),
            _ => self.operator_help(op.node, a, b),
        };
        self.report(match help {
            Some(help) => finding.help(help),
            None => finding,
        });
        self.unknown(span)
    }
}

/// Whether values of two types can be compared, by their order or only by `==` and `!=`.
fn are_comparable(a: &Expr, b: &Expr, equality: bool) -> bool {
    use Type::*;
    match (&a.ty, &b.ty) {
        (x, y) if x == y => equality || matches!(x, Quantity(_) | Int | Depth | Altitude | Date),
        (Depth | Altitude, t) if *t == LENGTH => b.range.constant().is_some(),
        (t, Depth | Altitude) if *t == LENGTH => a.range.constant().is_some(),
        (Heading, t) if *t == ANGLE && equality => b.range.constant().is_some(),
        (t, Heading) if *t == ANGLE && equality => a.range.constant().is_some(),
        (Optional(x), y) | (y, Optional(x)) if **x == *y && equality => true,
        (Optional(_), None) | (None, Optional(_)) if equality => true,
        (x, y) => matches!((x.dimension(), y.dimension()), (Some(d), Some(e)) if d == e),
    }
}
