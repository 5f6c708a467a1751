//! The use of a clause: which one it is, whether it may stand there, and its arguments, some of which are clauses themselves.

use super::names::Found;
use super::scenario::Standing;
use super::{Checker, ClauseInfo, Def, ParamInfo, vehicle};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{ClauseArg, ClauseUse};
use crate::source::Span;
use crate::syntax::tree::{self, ExprKind};
use albacore_syntax::other_languages;
use albacore_wording::listed;

/// The arguments of a clause, as far as they have been looked at.
#[derive(Default)]
struct Given {
    /// The clauses among them, each with the parameter that it is given to.
    clauses: Vec<(String, ClauseArg)>,
    /// The others, unchecked as yet.
    plain: Vec<tree::Arg>,
    /// What is wrong with one has been told: whatever is missing may be its echo.
    failed: bool,
}

impl<'t> Checker<'t> {
    /// `flow(12 cm/s toward 140 deg, meander: 8 deg)`, or as an argument `lbl(every: 120 s)`.
    pub(super) fn clause_use(&mut self, e: &'t tree::Expr, standing: Standing) -> Option<ClauseUse> {
        let (callee, args): (&'t tree::Expr, &'t [tree::Arg]) = match &e.kind {
            ExprKind::Call(callee, args) => (callee, args),
            ExprKind::Name(_) | ExprKind::Member(..) => (e, &[]),
            _ => {
                self.misplaced(e.span, "a scenario holds clauses such as `flow(…)`", "write `NAME(…)`");
                return None;
            }
        };
        let is_value = standing == Standing::Value;
        let id = self
            .clause_of_kind(callee, |kind| kind.is_some() == is_value)
            .or_else(|| self.clause_of_kind(callee, |_| true));
        let Some(id) = id else {
            self.no_such_clause(callee, standing);
            return None;
        };
        let clause = self.clauses[id].clone();
        if !self.may_stand(standing, clause.kind.as_ref()) {
            self.cannot_stand(&clause, e.span, standing);
            return None;
        }
        // Clauses as arguments are taken out first: the rest are arguments like any.
        let mut given = Given::default();
        for arg in args {
            self.clause_arg(&clause, arg, &mut given);
        }
        self.clauses_by_default(&clause, &mut given);
        self.plain_args(&clause, given, e.span)
    }

    /// Whether a clause of a kind may stand there.
    fn may_stand(&self, standing: Standing, kind: Option<&String>) -> bool {
        kind.is_some() == (standing == Standing::Value) || self.is_line_of(standing, kind)
    }

    /// Whether what is else the value of a clause stands on a line there: a vehicle says how it moves.
    fn is_line_of(&self, standing: Standing, kind: Option<&String>) -> bool {
        standing == Standing::Vehicle && kind.is_some_and(|kind| self.vehicle_kinds().contains(kind))
    }

    fn no_such_clause(&mut self, callee: &tree::Expr, standing: Standing) {
        let name = written_name(callee);
        let message = format!("`{name}` is no clause of a {}", standing.whole());
        let finding = Diagnostic::error(Code::ScenariosClause, callee.span, message);
        let known = self.clauses.iter().filter(|c| self.may_stand(standing, c.kind.as_ref()));
        let foreign = foreign_clause(name, standing).map(str::to_string);
        let finding = match foreign.or_else(|| self.suggestion(name, known.map(|c| c.signature.name.as_str()))) {
            Some(help) => finding.help(help),
            None => finding,
        };
        self.report(finding);
    }

    fn cannot_stand(&mut self, clause: &ClauseInfo, span: Span, standing: Standing) {
        let name = &clause.signature.name;
        let kind = clause.kind.as_ref();
        let takes = self.clauses.iter().find(|c| kind.is_some() && c.takes(kind));
        let help = match takes {
            _ if let Some(help) = foreign_clause(name, standing) => help.to_string(),
            Some(clause) => format!("it is a value of another clause: `{}({name}…)`", clause.signature.name),
            None => "it stands on a line of its own".to_string(),
        };
        self.report(Diagnostic::error(Code::ScenariosClause, span, format!("`{name}` cannot stand here")).help(help));
    }

    /// An argument of a clause: a vehicle, another clause, or a value like those of any call.
    fn clause_arg(&mut self, clause: &ClauseInfo, arg: &'t tree::Arg, given: &mut Given) {
        let params = &clause.signature.params;
        if let Some(label) = &arg.label
            && let Some(param) = params.iter().find(|param| param.name == label.node)
        {
            self.names_used.refer(label.span, param.span);
        }
        let head = match &arg.value.kind {
            ExprKind::Call(callee, _) => callee.as_ref(),
            _ => &arg.value,
        };
        if let Some(vehicle) = self.vehicle_named(head) {
            let of_vehicle = self.of_vehicle(vehicle, head.span, params, &clause.nested);
            // What is wrong with a vehicle that gives nothing has been told.
            given.failed |= of_vehicle.is_empty();
            given.clauses.extend(of_vehicle);
            return;
        }
        if clause.nested.iter().any(Option::is_some) && self.misses_vehicle(head) {
            given.failed = true;
            return;
        }
        let takes = |kind: Option<&String>| kind.is_some() && clause.takes(kind);
        // A parameter of the scenario goes before a clause of its name, but where just such a clause is wanted.
        let is_local = matches!(&head.kind, ExprKind::Name(name) if self.local(name).is_some());
        let any = |_: Option<&String>| !is_local;
        if let Some(inner) = self.clause_of_kind(head, takes).or_else(|| self.clause_of_kind(head, any)) {
            self.nested_clause(clause, inner, arg, given);
        } else if let Some(kind) = self.misspelt_clause(head, arg, clause) {
            given.failed = true;
            self.no_such_value(&clause.signature.name, &kind, head);
        } else {
            given.plain.push(arg.clone());
        }
    }

    /// A clause as an argument goes to the parameter of its label, else to the first whose type it is.
    fn nested_clause(&mut self, clause: &ClauseInfo, inner: usize, arg: &'t tree::Arg, given: &mut Given) {
        let name = &clause.signature.name;
        let inner = &self.clauses[inner];
        let is_labelled = |param: &ParamInfo| arg.label.as_ref().is_none_or(|label| label.node == param.name);
        let place = clause.typed_params().find(|(p, n)| n.is_some() && **n == inner.kind && is_labelled(p));
        let Some((param, _)) = place else {
            let message = format!("`{name}` takes no `{}`", inner.signature.name);
            return self.report(Diagnostic::error(Code::ScenariosClause, arg.value.span, message));
        };
        if let Some((_, first)) = given.clauses.iter().find(|(given, _)| *given == param.name) {
            let message = format!("`{}` of `{name}` is given twice", param.name);
            let mut finding = Diagnostic::error(Code::ArgsTwice, arg.value.span, message);
            if let ClauseArg::Nested(first) = first {
                finding = finding.label(first.span, "the first");
            }
            self.report(finding.help(format!("leave one of them out, or write a `{name}` for each")));
            given.failed = true;
        } else if let Some(used) = self.clause_use(&arg.value, Standing::Value) {
            given.clauses.push((param.name.clone(), ClauseArg::Nested(used)));
        }
    }

    /// Parameters that take a clause and are given none have the one of their declaration.
    fn clauses_by_default(&mut self, clause: &ClauseInfo<'t>, given: &mut Given) {
        for ((param, nested), &otherwise) in clause.typed_params().zip(&clause.otherwise) {
            let is_given = given.clauses.iter().any(|(given, _)| *given == param.name);
            if let Some(otherwise) = otherwise.filter(|_| nested.is_some() && !is_given && !given.failed) {
                let used = self.clause_use(otherwise, Standing::Value);
                given.clauses.extend(used.map(|used| (param.name.clone(), ClauseArg::Nested(used))));
            }
        }
    }

    /// The arguments that are no clauses, and with them the whole.
    fn plain_args(&mut self, clause: &ClauseInfo, given: Given, span: Span) -> Option<ClauseUse> {
        let name = clause.signature.name.clone();
        let plain: Vec<ParamInfo> =
            clause.typed_params().filter(|(_, n)| n.is_none()).map(|(p, _)| p.clone()).collect();
        if let (true, [arg, ..]) = (plain.is_empty() && !clause.nested.is_empty(), given.plain.as_slice()) {
            self.takes_clauses_only(clause, arg);
            return None;
        }
        let checked = self.arguments_of_clause(&name, &plain, &given.plain, span).filter(|_| !given.failed)?;
        let mut args = given.clauses;
        args.extend(plain.into_iter().map(|p| p.name).zip(checked.into_iter().map(ClauseArg::Value)));
        Some(ClauseUse { name, span, args })
    }

    /// What is no clause fits nothing where only clauses do.
    fn takes_clauses_only(&mut self, clause: &ClauseInfo, arg: &tree::Arg) {
        let kinds: Vec<String> = clause.nested.iter().flatten().cloned().collect();
        let fits = self.clauses.iter().filter(|c| c.kind.as_ref().is_some_and(|kind| kinds.contains(kind)));
        let fits: Vec<&str> = fits.map(|c| c.signature.name.as_str()).collect();
        let message = format!("`{}` takes no such thing: it takes a {}", clause.signature.name, kinds.join(" or a "));
        let finding = Diagnostic::error(Code::ScenariosClause, arg.value.span, message);
        let help = format!("there is {}", listed(&fits));
        self.report(finding.help(help));
    }

    fn no_such_value(&mut self, clause: &str, kind: &str, head: &tree::Expr) {
        let written = written_name(head);
        let or_vehicle = if clause == vehicle::CLAUSE { " and no vehicle" } else { "" };
        let message = format!("there is no {kind}{or_vehicle} named `{written}`");
        let finding = Diagnostic::error(Code::ScenariosClause, head.span, message);
        let finding = match self.help_with_value(clause, kind, written) {
            Some(help) => finding.help(help),
            None => finding,
        };
        self.report(finding);
    }

    /// What may be meant by a name that no value of a clause has.
    fn help_with_value(&self, clause: &str, kind: &str, written: &str) -> Option<String> {
        let of_kind = |c: &&ClauseInfo| c.kind.as_deref() == Some(kind);
        let known: Vec<&str> = self.clauses.iter().filter(of_kind).map(|c| c.signature.name.as_str()).collect();
        if clause == vehicle::CLAUSE && self.vehicle_kinds().iter().any(|k| k == kind) {
            self.help_with_vehicle(written, &known)
        } else {
            self.suggestion(written, known)
        }
    }

    /// The clause that an expression names, of a kind that fits: `flow` is a clause, and in `fault(flow, off)` a sensor.
    fn clause_of_kind(&self, e: &tree::Expr, fits: impl Fn(Option<&String>) -> bool) -> Option<usize> {
        let ExprKind::Name(name) = &e.kind else {
            return match self.find(e) {
                Found::Def(Def::Clause(id)) => Some(id),
                _ => None,
            };
        };
        let is_wanted = |def: &Def| matches!(def, Def::Clause(id) if fits(self.clauses[*id].kind.as_ref()));
        match self.lookup_if(self.scope.module, name, is_wanted) {
            Some(Def::Clause(id)) => {
                self.refer_to(e.span, self.scope.module, name, is_wanted);
                Some(*id)
            }
            _ => None,
        }
    }

    /// The kind of clause that a name which nobody has stands for: of those that its parameter takes, or that the clause takes
    /// where it has no label, the one that has a name like it, else the first.
    fn misspelt_clause(&self, head: &tree::Expr, arg: &tree::Arg, clause: &ClauseInfo) -> Option<String> {
        let ExprKind::Name(name) = &head.kind else { return None };
        if self.local(name).is_some() || self.lookup(self.scope.module, name).is_some() {
            return None;
        }
        let fits = |p: &ParamInfo| arg.label.as_ref().is_none_or(|label| label.node == p.name);
        let kinds: Vec<&String> =
            clause.typed_params().filter(|(p, _)| fits(p)).filter_map(|(_, k)| k.as_ref()).collect();
        let fitting = self.clauses.iter().filter(|c| c.kind.as_ref().is_some_and(|kind| kinds.contains(&kind)));
        let near = self.nearest(name, fitting.clone().map(|c| c.signature.name.as_str()));
        let nearest = near.and_then(|near| fitting.clone().find(|c| c.signature.name == near)?.kind.clone());
        nearest.or_else(|| kinds.first().map(|kind| (*kind).clone()))
    }
}

impl ClauseInfo<'_> {
    /// Whether a clause of a kind is the value of one of its parameters.
    fn takes(&self, kind: Option<&String>) -> bool {
        self.nested.iter().any(|nested| nested.as_ref() == kind)
    }

    /// Its parameters, each with the kind of clause that it takes.
    fn typed_params(&self) -> impl Iterator<Item = (&ParamInfo, &Option<String>)> {
        self.signature.params.iter().zip(&self.nested)
    }
}

/// What is called, as a message names it.
fn written_name(callee: &tree::Expr) -> &str {
    if let ExprKind::Name(name) = &callee.kind { name } else { "this" }
}

/// What others call a clause of a scenario: a vehicle has none of these.
fn foreign_clause(name: &str, standing: Standing) -> Option<&'static str> {
    other_languages::clause(name).filter(|_| standing == Standing::Line)
}
