//! Fields and methods of values: what stands after a dot.

use super::expr::article;
use super::names::Found;
use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind, InputPart, Interval};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::{RecordInfo, Type, TypeTable};
use albacore_arithmetic::{Age, Operation, counted};
use albacore_program::GRID_WORDS;
use albacore_wording::listed;

const LENGTH: Type = Type::Quantity(Dimension::LENGTH);
const VECTOR: Type = Type::Vector(Dimension::LENGTH);
/// `hits` counts at most this many samples back.
const HITS_MAX: f64 = 1000.0;

/// A method: its name, its parameters with labels, what the machine does.
struct Method {
    name: &'static str,
    params: &'static [(&'static str, Type)],
    op: Builtin,
    result: Type,
}

const HEADING_PARAM: &[(&str, Type)] = &[("heading", Type::Heading)];
const POINT_PARAM: &[(&str, Type)] = &[("point", Type::Point)];

/// The methods of a type.
fn methods(ty: &Type) -> Vec<Method> {
    let method = |name, params, op, result| Method { name, params, op, result };
    match ty {
        Type::Point => vec![method("along", HEADING_PARAM, Builtin::Along, LENGTH)],
        Type::Vector(d) => vec![method("along", HEADING_PARAM, Builtin::Along, Type::Quantity(*d))],
        Type::Area => vec![
            method("gap", POINT_PARAM, Builtin::Gap, LENGTH),
            method("nearest_edge", POINT_PARAM, Builtin::NearestEdge, Type::Edge),
            method("exit", &[("point", Type::Point), ("toward", Type::Heading)], Builtin::Exit, Type::Point),
        ],
        Type::Edge => vec![
            method("gap", POINT_PARAM, Builtin::EdgeGap, LENGTH),
            method("distance", POINT_PARAM, Builtin::EdgeDistance, LENGTH),
            method("tangent", &[("nearest", Type::Heading)], Builtin::EdgeTangent, Type::Heading),
        ],
        _ => Vec::new(),
    }
}

/// The names after a dot, for suggestions.
pub(crate) fn member_names(types: &TypeTable, ty: &Type) -> Vec<String> {
    let mut names: Vec<String> = methods(ty).iter().map(|m| m.name.to_string()).collect();
    let more: &[&str] = match ty {
        Type::Point => &["north", "east"],
        Type::Vector(_) => &["north", "east", "length", "toward", "dot"],
        Type::Area => &["center", "hull", "edges", "rows", "corner", "scattered", "contains", "run"],
        Type::Edge => &["normal", "line"],
        Type::Line => &["start", "end", "length", "heading"],
        Type::Map(..) => &["count", "cell"],
        Type::List(..) => &["count", "first", "top", "spread", "insert", "remove", "clear"],
        Type::Record(id) => {
            names.extend(types.records[*id].fields.iter().map(|(n, _)| n.clone()));
            &[]
        }
        _ => &[],
    };
    names.extend(more.iter().map(|n| (*n).to_string()));
    names
}

/// Whether samples of a type reach a limit, or not.
fn has_order(ty: &Type) -> bool {
    matches!(ty, Type::Quantity(_) | Type::Int | Type::Depth | Type::Altitude)
}

impl<'t> Checker<'t> {
    pub(super) fn member(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Expr {
        // Half typed, which has been told: what stands before the dot is looked at all the same.
        if member.node.is_empty() {
            if self.module_named(base).is_none() {
                self.expr(base, None);
            }
            return self.unknown(span);
        }
        if let Some(value) = self.test_member(base, member, span) {
            return value;
        }
        if let Some(module) = self.module_named(base) {
            return match self.defined_in(module, member).cloned() {
                Some(def) => {
                    let module = if let tree::ExprKind::Name(name) = &base.kind { name } else { "" };
                    self.def_value(&def, &format!("{module}.{}", member.node), span)
                }
                None => {
                    self.no_such_name(module, member);
                    self.unknown(span)
                }
            };
        }
        if let Some(value) = self.variant_of(base, member, span) {
            return value;
        }
        let value = match self.reported_record(base, &member.node) {
            Some(record) => record,
            None => self.expr(base, None),
        };
        if let Some(part) = self.input_part(&value, member, span) {
            return part;
        }
        if value.ty == Type::Unknown {
            return value;
        }
        let part = |c: &Self, value: Expr, at: u32, ty: Type| c.make(ExprKind::Part(Box::new(value), at), ty, span);
        match (value.ty.clone(), member.node.as_str()) {
            (Type::Point, "north") => part(self, value, 0, LENGTH),
            (Type::Point, "east") => part(self, value, 1, LENGTH),
            (Type::Vector(d), "north") => part(self, value, 0, Type::Quantity(d)),
            (Type::Vector(d), "east") => part(self, value, 1, Type::Quantity(d)),
            (Type::Vector(d), "length") => self.operation(Builtin::Length, vec![value], Type::Quantity(d), span),
            (Type::Vector(_), "toward") => self.operation(Builtin::Direction, vec![value], Type::Heading, span),
            (Type::Area, "center") => self.operation(Builtin::Center, vec![value], Type::Point, span),
            (Type::Area, "hull") => self.operation(Builtin::Hull, vec![value], Type::Area, span),
            (Type::Area, "edges") => self.only_walked("edges", "write `for edge in area.edges { … }`", span),
            (Type::Edge, "line") => part(self, value, 0, Type::Line),
            (Type::Edge, "normal") => part(self, value, 4, Type::Vector(Dimension::NUMBER)),
            (Type::Line, "start") => part(self, value, 0, Type::Point),
            (Type::Line, "end") => part(self, value, 2, Type::Point),
            (Type::Line, "heading" | "length") => {
                let along = self.operation(Builtin::LineVector, vec![value], VECTOR, span);
                let (op, ty) = if member.node == "heading" {
                    (Builtin::Direction, Type::Heading)
                } else {
                    (Builtin::Length, LENGTH)
                };
                self.operation(op, vec![along], ty, span)
            }
            (Type::List(_, n), "count") => Expr { range: counted(n), ..part(self, value, 0, Type::Int) },
            (Type::Map(_, n), "count") => Expr { range: counted(n), ..part(self, value, GRID_WORDS, Type::Int) },
            (Type::Map(..), "cell") => part(self, value, 0, LENGTH),
            (Type::List(inner, _), "first") => {
                let zero = self.make(ExprKind::Number(0.0), Type::Int, span);
                self.operation(Builtin::At, vec![value, zero], inner.optional(), span)
            }
            (Type::Record(id), _) => self.record_field(id, value, member, span),
            (Type::Optional(_), _) => {
                let finding = self.absent(&value);
                self.report(finding);
                self.unknown(span)
            }
            _ => {
                self.no_such_member(&value, member);
                self.unknown(span)
            }
        }
    }

    fn record_field(&mut self, id: usize, value: Expr, member: &tree::Name, span: Span) -> Expr {
        let RecordInfo { fields, places, .. } = self.types.records[id].clone();
        let mut at = 0;
        for ((name, ty), place) in fields.into_iter().zip(places) {
            if name == member.node {
                self.names_used.refer(member.span, place);
                return self.make(ExprKind::Part(Box::new(value), at), ty, span);
            }
            at += self.types.words(&ty);
        }
        self.no_such_member(&value, member);
        self.unknown(span)
    }

    fn only_walked(&mut self, name: &str, help: &str, span: Span) -> Expr {
        let finding = Diagnostic::error(Code::TypesWalked, span, format!("`{name}` can only be walked"));
        self.report(finding.help(help));
        self.unknown(span)
    }

    /// `Colour.Blue`: variants are written without their enum.
    fn variant_of(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let tree::ExprKind::Name(name) = &base.kind else { return None };
        let &Def::Enum(id) = self.lookup(self.scope.module, name).filter(|_| self.local(name).is_none())? else {
            return None;
        };
        let variants = self.types.enums[id].variants.clone();
        let known: Vec<&str> = variants.iter().map(String::as_str).collect();
        let finding = if known.contains(&member.node.as_str()) {
            Diagnostic::error(Code::NamesValue, span, format!("a variant of `{name}` is written without it"))
                .help(format!("write `{}`", member.node))
        } else {
            Diagnostic::error(Code::NamesUnknown, member.span, format!("`{name}` has no variant `{}`", member.node))
                .help(match self.nearest(&member.node, known.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`? it is written without `{name}.`"),
                    None => format!("its variants are written alone: {}", listed(&known)),
                })
        };
        self.report(finding);
        Some(self.unknown(span))
    }

    /// `x.age`, `x.peak` and the fields of inputs.
    fn input_part(&mut self, value: &Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let ExprKind::Input(id, InputPart::Value) = value.kind else { return None };
        let input = self.hir.inputs[id].clone();
        let read =
            |part: InputPart, ty: Type| Some(Expr { kind: ExprKind::Input(id, part), ty, span, range: Interval::ANY });
        match member.node.as_str() {
            "age" => {
                return Some(Expr {
                    range: Age::rule([Interval::ANY]),
                    ..read(InputPart::Age, Type::Quantity(Dimension::TIME))?
                });
            }
            "peak" if matches!(input.ty, Type::Quantity(_)) => return read(InputPart::Peak, input.ty),
            _ => {}
        }
        let mut at = self.types.words(&input.ty);
        for ((name, ty), place) in input.fields.into_iter().zip(input.places) {
            if name == member.node {
                self.names_used.refer(member.span, place);
                return read(InputPart::Field(at), ty);
            }
            at += self.types.words(&ty);
        }
        None
    }

    /// `new INPUT`.
    pub(super) fn new_sample(&mut self, input: &tree::Expr, span: Span) -> Expr {
        let value = self.expr(input, None);
        match value.kind {
            ExprKind::Input(id, InputPart::Value) => {
                Expr { kind: ExprKind::Input(id, InputPart::IsNew), ty: Type::Bool, span, range: Interval::ANY }
            }
            _ if value.ty == Type::Unknown => value,
            _ => {
                let finding =
                    Diagnostic::error(Code::TimeSample, input.span, "this is no input, and no sample of it comes");
                self.report(finding.help("name an input: `new chemical`; for what comes to hold write `becomes …`"));
                self.unknown(span)
            }
        }
    }

    pub(super) fn no_such_name(&mut self, module: usize, name: &tree::Name) {
        let finding = Diagnostic::error(
            Code::NamesUnknown,
            name.span,
            format!("the module `{}` has no `{}`", self.modules[module].name, name.node),
        );
        let public = self.names[module].iter().filter(|(_, def)| !matches!(def, Def::Unit(_)));
        let names: Vec<String> = public.map(|(name, _)| name.clone()).collect();
        let finding = match self.suggestion(&name.node, names.iter().map(String::as_str)) {
            Some(help) => finding.help(help),
            None => finding,
        };
        self.report(finding);
    }

    fn no_such_member(&mut self, value: &Expr, member: &tree::Name) {
        let ty = self.type_name(&value.ty);
        let names = member_names(&self.types, &value.ty);
        if member.node == "hits" && matches!(value.kind, ExprKind::Input(_, InputPart::Value)) && has_order(&value.ty) {
            let message = "`hits` of an input is called: it counts the samples of the last few that reach a limit";
            let finding = Diagnostic::error(Code::NamesMember, member.span, message);
            return self.report(finding.help("write the limit and how many samples: `.hits(LIMIT, of: 10)`"));
        }
        if names.contains(&member.node) {
            let brackets = if member.node == "clear" { "()" } else { "(…)" };
            let message = format!("`{}` of {} is called", member.node, article(&ty));
            let finding =
                Diagnostic::error(Code::NamesMember, member.span, message).label(value.span, format!("`{ty}`"));
            return self.report(finding.help(format!("write it with brackets: `.{}{brackets}`", member.node)));
        }
        let finding =
            Diagnostic::error(Code::NamesMember, member.span, format!("{} has no `{}`", article(&ty), member.node))
                .label(value.span, format!("`{ty}`"));
        let is_input = matches!(value.kind, ExprKind::Input(_, InputPart::Value));
        let of_inputs: &[&str] = match is_input {
            true if matches!(value.ty, Type::Quantity(_)) => &["age", "peak"],
            true => &["age"],
            false => &[],
        };
        let finding =
            match self.suggestion(&member.node, names.iter().map(String::as_str).chain(of_inputs.iter().copied())) {
                _ if of_inputs.contains(&"peak") && member.node.starts_with("max") => {
                    finding.help("the largest sample of a tick is its `.peak`; to keep the largest of all, a `memory`")
                }
                Some(help) => finding.help(help),
                None => finding,
            };
        self.report(finding);
    }

    /// A call of whatever stands before the parentheses.
    pub(super) fn call(
        &mut self,
        callee: &tree::Expr,
        args: &[tree::Arg],
        span: Span,
        expected: Option<&Type>,
    ) -> Expr {
        if let tree::ExprKind::Member(base, member) = &callee.kind
            && self.module_named(base).is_none()
        {
            return self.method(base, member, args, span);
        }
        let found = self.find(callee);
        match found {
            Found::Def(def) => self.call_def(&def, callee, args, span),
            Found::Nothing => match &callee.kind {
                tree::ExprKind::Name(name) => self.call_builtin(name, callee.span, args, span, expected),
                tree::ExprKind::Member(base, member) => {
                    if let Some(module) = self.module_named(base) {
                        self.no_such_name(module, member);
                    }
                    self.unknown(span)
                }
                _ => {
                    self.report(
                        Diagnostic::error(Code::NamesCall, callee.span, "this cannot be called")
                            .help("an operator is missing before the `(`, or leave the brackets out"),
                    );
                    self.unknown(span)
                }
            },
        }
    }

    fn method(&mut self, base: &tree::Expr, member: &tree::Name, args: &[tree::Arg], span: Span) -> Expr {
        if let Some(value) = self.test_method(base, member, args, span) {
            return value;
        }
        let value = self.expr(base, None);
        if value.ty == Type::Unknown {
            for arg in args {
                self.expr(&arg.value, None);
            }
            return value;
        }
        let ordered = has_order(&value.ty);
        if let (ExprKind::Input(id, InputPart::Value), "hits", true) = (&value.kind, member.node.as_str(), ordered) {
            return self.hits(*id, &value.ty.clone(), args, span);
        }
        if let Some(method) = methods(&value.ty).into_iter().find(|m| m.name == member.node) {
            let mut operands = vec![value];
            let Some(given) = self.simple_args(method.name, method.params, args, span) else {
                return self.unknown(span);
            };
            operands.extend(given);
            return self.operation(method.op, operands, method.result, span);
        }
        match (value.ty.clone(), member.node.as_str()) {
            (Type::Vector(d), "dot") => self.dot(value, d, args, span),
            (Type::Area, "rows") => self.only_walked("rows", "write `for row in area.rows(step) { … }`; how many there are counts a `var` of a function that walks them", span),
            (Type::Area, name @ ("contains" | "run" | "corner" | "scattered")) => self.area_method(value, name, args, span),
            (Type::List(inner, n), "top") => {
                let Some([count]) = self.positional::<1>("top", args, span) else { return self.unknown(span) };
                let count = self.expr_as(&count, &Type::Int, "the argument of `top`");
                self.operation(Builtin::Top, vec![value, count], Type::List(inner, n), span)
            }
            (Type::List(inner, _), "spread") if *inner == Type::Point => {
                let Some(given) = self.simple_args("spread", HEADING_PARAM, args, span) else {
                    return self.unknown(span);
                };
                self.operation(Builtin::Spread, [vec![value], given].concat(), LENGTH, span)
            }
            (Type::List(..), "insert" | "remove" | "clear") => {
                self.report(
                    Diagnostic::error(
                        Code::TypesStatement,
                        span,
                        format!("`{}` is a statement, no value", member.node),
                    )
                    .help("write it on a line of its own"),
                );
                self.unknown(span)
            }
            (Type::Optional(_), _) => {
                let finding = self.absent(&value);
                self.report(finding);
                self.unknown(span)
            }
            (ty, name) if member_names(&self.types, &ty).iter().any(|known| known == name) => {
                let message = format!("`{name}` of {} takes no arguments", article(&self.type_name(&ty)));
                let finding = Diagnostic::error(Code::NamesCall, member.span, message);
                self.report(finding.help(format!("write `.{name}`, without brackets")));
                self.unknown(span)
            }
            _ => {
                self.no_such_member(&value, member);
                self.unknown(span)
            }
        }
    }

    fn dot(&mut self, vector: Expr, dimension: Dimension, args: &[tree::Arg], span: Span) -> Expr {
        let Some([arg]) = self.positional::<1>("dot", args, span) else { return self.unknown(span) };
        let other = self.expr(&arg, None);
        match other.ty {
            Type::Vector(e) => match self.writable(dimension.times(e), "product", span) {
                Some(d) => self.operation(Builtin::Dot, vec![vector, other], Type::Quantity(d), span),
                None => self.unknown(span),
            },
            Type::Unknown => other,
            _ => {
                let message = format!("`dot` takes another vector, this is {}", article(&self.type_name(&other.ty)));
                self.report(Diagnostic::error(Code::TypesMismatch, other.span, message));
                self.unknown(span)
            }
        }
    }

    /// The methods of an area that are more than one operation of the machine.
    fn area_method(&mut self, area: Expr, name: &str, args: &[tree::Arg], span: Span) -> Expr {
        let toward = ("toward", Type::Heading);
        let params: &[(&str, Type)] = match name {
            "contains" => POINT_PARAM,
            "run" => &[("point", Type::Point), toward],
            "scattered" if args.len() < 2 => &[("index", Type::Int)],
            "scattered" => &[("index", Type::Int), ("seed", Type::Int)],
            // Without `near` the machine takes the centre.
            _ if args.len() < 2 => &[toward],
            _ => &[toward, ("near", Type::Point)],
        };
        let Some(given) = self.simple_args(name, params, args, span) else { return self.unknown(span) };
        let operands = [vec![area], given].concat();
        match name {
            "contains" => {
                let gap = self.operation(Builtin::Gap, operands, LENGTH, span);
                let zero = self.make(ExprKind::Number(0.0), LENGTH, span);
                Expr { kind: ExprKind::Do(Builtin::Le, vec![zero, gap]), ty: Type::Bool, span, range: Interval::ANY }
            }
            "run" => {
                // How far one can go in a direction before the edge.
                let run = self.operation(Builtin::Run, operands, VECTOR, span);
                self.operation(Builtin::Length, vec![run], LENGTH, span)
            }
            "scattered" => self.operation(Builtin::Scattered, operands, Type::Point, span),
            _ => self.operation(Builtin::Corner, operands, Type::Point, span),
        }
    }

    /// `chemical.hits(4 %, of: 10)`.
    fn hits(&mut self, input: usize, ty: &Type, args: &[tree::Arg], span: Span) -> Expr {
        let params = &[("limit", ty.clone()), ("of", Type::Int)];
        let Some(given) = self.simple_args("hits", params, args, span) else { return self.unknown(span) };
        let [limit, of] = given.as_slice() else { return self.unknown(span) };
        let count = match of.range.constant() {
            Some(n) if (1.0..=HITS_MAX).contains(&n) => n as u32,
            _ if of.ty == Type::Unknown => return self.unknown(span),
            known => {
                let message = match known {
                    Some(n) => format!("{n} samples cannot be counted"),
                    None => "how many samples are counted must be a constant".to_string(),
                };
                let finding = Diagnostic::error(Code::TypesHits, of.span, message);
                self.report(finding.help(format!("a whole number from 1 to {HITS_MAX}")));
                return self.unknown(span);
            }
        };
        let part = InputPart::Hits(Box::new(limit.clone()), count);
        Expr { kind: ExprKind::Input(input, part), ty: Type::Int, span, range: counted(count) }
    }
}
