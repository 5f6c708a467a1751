//! Arguments: by position or by label, defaults for the rest; and the functions that every script knows.

use super::choice::wider;
use super::expr::article;
use super::quantity::{is_of_quantity, is_zero};
use super::{Checker, Def, ParamInfo, globe};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_geometry::{AREA_REACH_MAX_M, AREA_WIDTH_MIN_M};
use albacore_program::{Channel, Guide};
use albacore_wording::listed;

/// What is said of an area that is meant to be round.
pub(super) const ROUND: &str =
    "an area has corners: `rectangle(center: POINT, along: 0 deg, length: 400 m, width: 400 m)`";

/// How a time limit is called elsewhere, where it is an argument.
const TIME_LIMITS: [&str; 5] = ["timeout", "time_limit", "time", "duration", "within"];

const LENGTH: Type = Type::Quantity(Dimension::LENGTH);
pub(super) const NUMBER: Type = Type::Quantity(Dimension::NUMBER);

/// The functions that every script knows.
pub(super) const BUILTINS: [&str; 22] = [
    "point",
    "vector",
    "line",
    "rectangle",
    "polygon",
    "area_file",
    "map",
    "distance",
    "abs",
    "min",
    "max",
    "clamp",
    "sqrt",
    "exp",
    "ln",
    "floor",
    "ceil",
    "round",
    "sin",
    "cos",
    "atan2",
    "number",
];

/// What is given for a parameter.
pub(super) enum Given<'e> {
    Written(&'e tree::Expr),
    /// It has been looked at already.
    Known(Expr),
}

impl<'t> Checker<'t> {
    /// Puts arguments in the order of the parameters. `None` when that failed and has been reported.
    pub(super) fn arguments(
        &mut self,
        what: &str,
        params: &[ParamInfo],
        args: &[tree::Arg],
        span: Span,
        declared: Option<Span>,
    ) -> Option<Vec<Expr>> {
        if let Some(finding) = globe::two_numbers(what, params, args) {
            self.report(finding);
            return None;
        }
        let (given, failed) = self.by_parameter(what, params, args, declared.is_some());
        let given = given.into_iter().map(|written| written.map(Given::Written)).collect();
        self.values(what, params, given, failed, (span, declared))
    }

    /// The values of parameters, of which some may be known already; `places` are those of the call and of what is called, if that is
    /// declared. `None` when that failed, or had before, and has been reported.
    pub(super) fn values(
        &mut self,
        what: &str,
        params: &[ParamInfo],
        given: Vec<Option<Given>>,
        mut failed: bool,
        places: (Span, Option<Span>),
    ) -> Option<Vec<Expr>> {
        let mut values = Vec::new();
        for (param, given) in params.iter().zip(given) {
            let asked = || format!("`{}` of `{what}`", param.name);
            let value = match (given, &param.default) {
                (Some(Given::Written(written)), _) => self.expr_as(written, &param.ty, &asked()),
                (Some(Given::Known(value)), _) => self.coerce(value, &param.ty, &asked()),
                (None, Some(default)) => {
                    values.push(self.default(default));
                    continue;
                }
                (None, None) => {
                    if !failed {
                        self.missing_argument(what, param, places.0, places.1);
                    }
                    failed = true;
                    continue;
                }
            };
            if let Some(range) = param.range {
                self.in_range(&value, range, &param.name, param.span);
            }
            values.push(value);
        }
        (!failed).then_some(values)
    }

    pub(super) fn missing_argument(&mut self, what: &str, param: &ParamInfo, span: Span, declared: Option<Span>) {
        let ty = self.type_name(&param.ty);
        let message = format!("`{what}` needs `{}`, {}", param.name, article(&ty));
        let finding = Diagnostic::error(Code::ArgsMissing, span, message);
        // What a behavior that is given takes has no names.
        let finding = match param.name.contains(' ') {
            true => finding.help(format!("write it between the parentheses: `{what}(…)`")),
            false => finding.help(format!("write `{}: …`", param.name)),
        };
        self.report(match declared {
            Some(_) => finding.label(param.span, "declared here"),
            None => finding,
        });
    }

    /// What is written for each parameter, and whether something fitted none.
    pub(super) fn by_parameter<'e>(
        &mut self,
        what: &str,
        params: &[ParamInfo],
        args: &'e [tree::Arg],
        is_declared: bool,
    ) -> (Vec<Option<&'e tree::Expr>>, bool) {
        let mut given: Vec<Option<&tree::Expr>> = vec![None; params.len()];
        let mut failed = false;
        let mut next = 0;
        for arg in args {
            let index = match &arg.label {
                Some(label) => params.iter().position(|p| p.name == label.node),
                None => {
                    let index = (next < params.len()).then_some(next);
                    next += 1;
                    index
                }
            };
            match (index, &arg.label) {
                (Some(i), label) => match given[i].replace(&arg.value) {
                    Some(first) => {
                        failed = true;
                        given[i] = Some(first);
                        let message = format!("`{}` of `{what}` is given twice", params[i].name);
                        let finding = Diagnostic::error(Code::ArgsTwice, arg.value.span, message);
                        self.report(finding.label(first.span, "the first").help("leave one of them out"));
                    }
                    None => {
                        if let Some(label) = label.as_ref().filter(|_| is_declared) {
                            self.names_used.refer(label.span, params[i].span);
                        }
                    }
                },
                (None, Some(label)) => {
                    failed = true;
                    self.no_such_parameter(what, params, label);
                }
                // A label that fits nothing, or one too many, is the mistake; what is then missing is its echo.
                (None, None) => {
                    failed = true;
                    self.too_many_arguments(what, params, args, arg.value.span);
                    break;
                }
            }
        }
        (given, failed)
    }

    fn no_such_parameter(&mut self, what: &str, params: &[ParamInfo], label: &tree::Name) {
        let message = format!("`{what}` has no parameter `{}`", label.node);
        let finding = Diagnostic::error(Code::ArgsLabel, label.span, message);
        let is_setpoint = Channel::named(&label.node).is_some();
        // Of guidance, setpoints stand after `at` and time limits after `within`, not among its arguments.
        let finding = match self.suggestion(&label.node, params.iter().map(|p| p.name.as_str())) {
            _ if is_setpoint && Guide::takes_arguments(what) => {
                finding.help(format!("what it keeps follows `at`: `{what} … at {} …`", label.node))
            }
            _ if TIME_LIMITS.contains(&&*label.node) && Guide::takes_arguments(what) => {
                finding.help(format!("a time limit follows: `{what} … within 5 min`"))
            }
            _ if params.iter().all(|param| param.name.contains(' ')) => {
                finding.help("leave it out: what a behavior that is given takes has its order only")
            }
            Some(help) => finding.help(help),
            None => finding,
        };
        self.report(finding);
    }

    fn too_many_arguments(&mut self, what: &str, params: &[ParamInfo], args: &[tree::Arg], span: Span) {
        let message = format!("`{what}` takes {}, not {}", count(params.len()), args.len());
        let finding = Diagnostic::error(Code::ArgsMany, span, message);
        let names: Vec<&str> = params.iter().map(|p| p.name.as_str()).collect();
        self.report(match names.as_slice() {
            [] => finding.help(format!("write `{what}()`")),
            ["corners"] => finding.help("it takes a list: `polygon([a, b, c])`"),
            _ if params.iter().all(|param| param.name.contains(' ')) => finding.help("leave out what is too much"),
            names => finding.help(format!("leave out what is too much: it takes {}", listed(names))),
        });
    }

    /// Arguments of a built-in method or function, all needed.
    pub(super) fn simple_args(
        &mut self,
        what: &str,
        params: &[(&str, Type)],
        args: &[tree::Arg],
        span: Span,
    ) -> Option<Vec<Expr>> {
        let infos: Vec<ParamInfo> = params
            .iter()
            .map(|(name, ty)| ParamInfo {
                name: (*name).to_string(),
                ty: ty.clone(),
                default: None,
                range: None,
                behavior: None,
                span,
            })
            .collect();
        self.arguments(what, &infos, args, span, None)
    }

    /// Arguments that have their order only: a label would not move them.
    fn unlabelled(&mut self, what: &str, args: &[tree::Arg]) {
        for label in args.iter().filter_map(|arg| arg.label.as_ref()) {
            self.report(
                Diagnostic::error(Code::ArgsLabel, label.span, format!("the arguments of `{what}` have no labels"))
                    .help("leave it out, and mind their order"),
            );
        }
    }

    /// So many arguments without labels, unchecked as yet.
    pub(super) fn positional<const N: usize>(
        &mut self,
        what: &str,
        args: &[tree::Arg],
        span: Span,
    ) -> Option<[tree::Expr; N]> {
        self.unlabelled(what, args);
        let values: Vec<tree::Expr> = args.iter().map(|a| a.value.clone()).collect();
        match values.try_into() {
            Ok(array) => Some(array),
            Err(_) => {
                self.report(Diagnostic::error(
                    Code::ArgsMany,
                    span,
                    format!("`{what}` takes {}, not {}", count(N), args.len()),
                ));
                None
            }
        }
    }

    /// A call of something declared.
    pub(super) fn call_def(&mut self, def: &Def, callee: &tree::Expr, args: &[tree::Arg], span: Span) -> Expr {
        match def {
            Def::Fn(id) => {
                let signature = self.fn_signature(*id);
                if self.is_template(*id) {
                    return self.call_of_template(*id, args, span);
                }
                // That its defaults lead back to it has been told.
                if signature.result.is_none() {
                    return self.unknown(span);
                }
                match self.arguments(&signature.name, &signature.params, args, span, Some(signature.span)) {
                    Some(values) => {
                        let ty = signature.result.unwrap_or(Type::Unknown);
                        self.make(ExprKind::Call(*id, values), ty, span)
                    }
                    None => self.unknown(span),
                }
            }
            Def::Record(id) => {
                let record = self.types.records[*id].clone();
                let params: Vec<(&str, Type)> = record.fields.iter().map(|(n, t)| (n.as_str(), t.clone())).collect();
                for label in args.iter().filter_map(|arg| arg.label.as_ref()) {
                    if let Some(field) = params.iter().position(|(name, _)| *name == label.node) {
                        self.names_used.refer(label.span, record.places[field]);
                    }
                }
                match self.simple_args(&record.name, &params, args, span) {
                    Some(values) => self.make(ExprKind::Record(values), Type::Record(*id), span),
                    None => self.unknown(span),
                }
            }
            Def::Activity(id) => {
                let name = self.activity_signature(*id).name.clone();
                self.takes_time(&name, callee.span);
                self.unknown(span)
            }
            other => {
                self.report(Diagnostic::error(
                    Code::NamesCall,
                    callee.span,
                    format!("this is {} and cannot be called", other.what()),
                ));
                self.unknown(span)
            }
        }
    }

    /// A call of a function that every script knows.
    pub(super) fn call_builtin(
        &mut self,
        name: &str,
        name_span: Span,
        args: &[tree::Arg],
        span: Span,
        expected: Option<&Type>,
    ) -> Expr {
        if let Some(value) = self.test_call(name, args, span) {
            return value;
        }
        let simple = |c: &mut Self, params: &[(&str, Type)], op: Builtin, ty: Type| match c
            .simple_args(name, params, args, span)
        {
            Some(values) => c.operation(op, values, ty, span),
            None => c.unknown(span),
        };
        match name {
            "point" => simple(self, &[("north", LENGTH), ("east", LENGTH)], Builtin::Pair, Type::Point),
            "vector" => {
                let d = match expected.map(Type::present) {
                    Some(Type::Vector(d)) => *d,
                    _ => Dimension::LENGTH,
                };
                let params = [("north", Type::Quantity(d)), ("east", Type::Quantity(d))];
                simple(self, &params, Builtin::Pair, Type::Vector(d))
            }
            "line" => simple(self, &[("start", Type::Point), ("end", Type::Point)], Builtin::Line, Type::Line),
            "rectangle" => {
                let params = [("center", Type::Point), ("along", Type::Heading), ("length", LENGTH), ("width", LENGTH)];
                let Some(values) = self.simple_args(name, &params, args, span) else { return self.unknown(span) };
                values[2..].iter().for_each(|side| self.side(side));
                self.operation(Builtin::Rectangle, values, Type::Area, span)
            }
            "polygon" => self.polygon(args, expected, span),
            "area_file" => self.area_file(args, span),
            "map" => self.map_call(args, span, expected),
            "distance" => {
                let Some(values) = self.simple_args(name, &[("from", Type::Point), ("to", Type::Point)], args, span)
                else {
                    return self.unknown(span);
                };
                let vector = self.operation(Builtin::SubVector, values, Type::Vector(Dimension::LENGTH), span);
                self.operation(Builtin::Length, vec![vector], LENGTH, span)
            }
            "sin" | "cos" => {
                let op = if name == "sin" { Builtin::Sin } else { Builtin::Cos };
                simple(self, &[("angle", Type::Quantity(Dimension::ANGLE))], op, NUMBER)
            }
            "number" => {
                // An angle or a ratio as a plain number: for formulas that need radians.
                simple(self, &[("angle", Type::Quantity(Dimension::ANGLE))], Builtin::Add, NUMBER)
            }
            "floor" | "ceil" | "round" => {
                let op = match name {
                    "floor" => Builtin::Floor,
                    "ceil" => Builtin::Ceil,
                    _ => Builtin::Round,
                };
                simple(self, &[("x", NUMBER)], op, Type::Int)
            }
            "exp" => simple(self, &[("x", NUMBER)], Builtin::Exp, NUMBER),
            "ln" => self.logarithm(args, span),
            "sqrt" => self.square_root(args, span),
            "atan2" => self.angle_of_parts(args, span),
            "abs" | "min" | "max" | "clamp" => self.ordered(name, args, span),
            _ => {
                self.no_such_function(name, name_span, expected);
                for arg in args {
                    self.expr(&arg.value, None);
                }
                self.unknown(span)
            }
        }
    }

    /// Says what is wrong with a rectangle's side.
    fn side(&mut self, side: &Expr) {
        let (low, high) = (side.range.low, side.range.high);
        let finding = if low == high && low > 0.0 && low < AREA_WIDTH_MIN_M {
            let message = format!("this side is {low} m long, and no area is thinner than {AREA_WIDTH_MIN_M} m");
            Diagnostic::error(Code::AreasSmall, side.span, message).help("look at its unit")
        } else if low < AREA_WIDTH_MIN_M {
            let message = format!("a rectangle's sides must be {AREA_WIDTH_MIN_M} m long or more");
            Diagnostic::error(Code::RangesSide, side.span, message).help(
                "use a positive constant, a parameter with a range such as `in 1 m..10 km`, or `clamp(x, 1 m, 10 km)`",
            )
        } else if high > AREA_REACH_MAX_M {
            let may_be = if low > AREA_REACH_MAX_M { "is" } else { "may be" };
            let message = format!("a rectangle's side {may_be} longer than 100 km, and no plane is so large");
            Diagnostic::error(Code::AreasLarge, side.span, message)
                .help("look at its unit; of a parameter give a range that ends at 100 km or less")
        } else {
            return;
        };
        self.report(finding);
    }

    /// `abs`, `min`, `max`, `clamp`: of anything that has an order.
    fn ordered(&mut self, name: &str, args: &[tree::Arg], span: Span) -> Expr {
        let wanted = match name {
            "abs" => 1,
            "clamp" => 3,
            _ => 2,
        };
        if args.len() != wanted {
            let message = format!("`{name}` takes {}, not {}", count(wanted), args.len());
            self.report(Diagnostic::error(Code::ArgsMany, span, message).help(match name {
                "abs" => "write `abs(x)`".to_string(),
                "clamp" => "write `clamp(x, LOW, HIGH)`".to_string(),
                _ => format!("write `{name}(a, b)`, of three `{name}(a, {name}(b, c))`"),
            }));
            return self.unknown(span);
        }
        self.unlabelled(name, args);
        let first = self.expr(&args[0].value, None);
        let ordered = matches!(first.ty, Type::Int | Type::Sign | Type::Quantity(_))
            || name != "abs" && matches!(first.ty, Type::Depth | Type::Altitude | Type::Date);
        if !ordered {
            if first.ty != Type::Unknown {
                let ty = self.type_name(&first.ty);
                self.report(Diagnostic::error(
                    Code::TypesMismatch,
                    first.span,
                    format!("`{name}` takes numbers and quantities, this is {}", article(&ty)),
                ));
            }
            return self.unknown(span);
        }
        let mut ty = if first.ty == Type::Sign { Type::Int } else { first.ty.clone() };
        let mut values = vec![first];
        for arg in &args[1..] {
            let value = self.expr(&arg.value, Some(&ty));
            if is_of_quantity(&value.ty) && values.iter().all(is_zero) {
                ty = value.ty.clone();
                values.iter_mut().for_each(|zero| zero.ty = ty.clone());
            }
            if matches!((&ty, &value.ty), (Type::Int | Type::Quantity(_), Type::Quantity(d)) if ty.dimension() == Some(*d))
            {
                ty = wider(ty, value.ty.clone());
            }
            let value = self.coerce(value, &ty, &format!("the first argument of `{name}`"));
            values.push(value);
        }
        match name {
            "abs" => self.operation(Builtin::Abs, values, ty, span),
            "min" => self.operation(Builtin::Min, values, ty, span),
            "max" => self.operation(Builtin::Max, values, ty, span),
            _ => {
                let high = values.pop().unwrap_or_else(|| self.unknown(span));
                let low = self.operation(Builtin::Max, values, ty.clone(), span);
                self.operation(Builtin::Min, vec![low, high], ty, span)
            }
        }
    }
}

fn count(n: usize) -> String {
    match n {
        0 => "no arguments".to_string(),
        1 => "one argument".to_string(),
        n => format!("{n} arguments"),
    }
}
