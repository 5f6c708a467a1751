//! Scenarios: clauses with typed arguments. What a clause means is for the simulator; its parameters are declared in
//! the standard library like those of any function.

use super::names::Found;
use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{ClauseArg, ClauseUse};
use crate::syntax::tree::{self, Action, ClauseKind, TyKind};
use crate::types::Type;
use crate::{other_languages, suggest};

/// Where a clause stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Standing {
    /// On a line of a scenario.
    Line,
    /// As an argument of another clause.
    Value,
    /// On a line of a vehicle.
    Vehicle,
}

impl Standing {
    /// What it is in.
    fn whole(self) -> &'static str {
        if self == Standing::Vehicle { "vehicle" } else { "scenario" }
    }
}

impl<'t> Checker<'t> {
    pub(super) fn declare_clause(&mut self, m: usize, id: usize, params: &'t [tree::Param]) {
        // A parameter whose type is the kind of other clauses takes one of those as its value.
        let mut nested = Vec::new();
        for param in params {
            let kind = match &param.ty.kind {
                TyKind::Named { path, .. } => {
                    let name = path.text();
                    self.clauses.iter().any(|c| c.kind.as_ref() == Some(&name)).then_some(name)
                }
                TyKind::List { .. } => None,
            };
            nested.push(kind);
        }
        let mut infos = Vec::new();
        for (param, nested) in params.iter().zip(&nested) {
            if nested.is_some() {
                self.names_used.define(&param.name, "a parameter");
                infos.push(super::ParamInfo {
                    name: param.name.node.clone(),
                    ty: Type::Unknown,
                    default: None,
                    range: None,
                    span: param.name.span,
                });
            } else {
                infos.extend(self.params(m, std::slice::from_ref(param), None));
            }
        }
        self.clauses[id].otherwise = params.iter().map(|param| param.default.as_ref()).collect();
        self.clauses[id].signature.params = infos;
        self.clauses[id].nested = nested;
    }

    pub(super) fn scenario_named(&mut self, path: &tree::Path) -> Option<usize> {
        match self.resolve(self.scope.module, path).cloned() {
            Some(Def::Scenario(id)) => Some(id),
            // A scenario may also be chosen on the command line: what is missing here is reported where it is run.
            Some(def) => {
                self.report(Diagnostic::error(
                    Code::ScenariosUnknown,
                    path.span,
                    format!("`{}` is {}, no scenario", path.text(), def.what()),
                ));
                None
            }
            None => {
                let known: Vec<String> = self.hir.scenarios.iter().map(|s| s.path.clone()).collect();
                let finding = Diagnostic::error(
                    Code::ScenariosUnknown,
                    path.span,
                    format!("there is no scenario `{}`", path.text()),
                );
                let finding = match self.suggestion(&path.text(), known.iter().map(String::as_str)) {
                    Some(help) => finding.help(help),
                    None => finding,
                };
                self.report(finding);
                None
            }
        }
    }

    pub(super) fn check_scenario(&mut self, m: usize, id: usize, body: &'t tree::Block) {
        let mut scope = Scope::new(m, Setting::Constant);
        for var in self.hir.scenarios[id].vars.clone() {
            self.names_used.declare(&tree::Name { node: var.name.clone(), span: var.span }, var.kind);
            scope.visible.push(var.name.clone(), scope.vars.len());
            scope.vars.push(var);
        }
        let (mut clauses, scope) = self.within(scope, |c| c.clause_lines(body, Standing::Line));
        self.clauses_once(&clauses);
        self.fit_out(&mut clauses);
        self.hir.scenarios[id].clauses = clauses;
        self.hir.scenarios[id].vars = scope.vars;
    }

    /// The clauses of a block, each on a line of its own.
    pub(super) fn clause_lines(&mut self, body: &'t tree::Block, standing: Standing) -> Vec<ClauseUse> {
        let mut clauses = Vec::new();
        for clause in &body.clauses {
            match &clause.kind {
                ClauseKind::Timed(timed) if !timed.is_modified() => {
                    if let Action::Expr(e) = &timed.action {
                        clauses.extend(self.clause_use(e, standing));
                        continue;
                    }
                    self.misplaced(
                        clause.span,
                        &format!("a {} says what is, not what is done", standing.whole()),
                        "move this into a mission",
                    );
                }
                _ => {
                    let message = format!("a {} holds clauses such as `limits(…)`", standing.whole());
                    self.misplaced(clause.span, &message, "move this elsewhere");
                }
            }
        }
        clauses
    }

    /// A clause whose first parameter is a name may stand several times: each is another thing. So may one of what happens
    /// from a time to another. All others stand once.
    pub(super) fn clauses_once(&mut self, clauses: &[ClauseUse]) {
        let time = Type::Quantity(Dimension::TIME);
        let is_time = |(_, arg): &(String, ClauseArg)| matches!(arg, ClauseArg::Value(value) if value.ty == time);
        for (i, clause) in clauses.iter().enumerate() {
            let first = clauses[..i].iter().find(|c| c.name == clause.name);
            let has_name = clause.args.first().is_some_and(|(param, _)| param == "name");
            let arg = |name: &str| clause.args.iter().find(|(param, _)| param == name);
            let happens = arg("from").is_some_and(is_time) && arg("to").is_some();
            if let Some(first) = first.filter(|_| !has_name && !happens) {
                let message = format!("a scenario has one `{}`", clause.name);
                let finding = Diagnostic::error(Code::ScenariosTwice, clause.span, message);
                self.report(finding.label(first.span, "the first").help("leave one of them out"));
            }
        }
    }

    /// `flow(12 cm/s toward 140 deg, meander: 8 deg)`, or as an argument `lbl(every: 120 s)`.
    fn clause_use(&mut self, e: &'t tree::Expr, standing: Standing) -> Option<ClauseUse> {
        let as_value = standing == Standing::Value;
        use tree::ExprKind as K;
        let (callee, args): (&'t tree::Expr, &'t [tree::Arg]) = match &e.kind {
            K::Call(callee, args) => (callee, args),
            K::Name(_) | K::Member(..) => (e, &[]),
            _ => {
                self.misplaced(e.span, "a scenario holds clauses such as `flow(…)`", "write `NAME(…)`");
                return None;
            }
        };
        let Some(id) = self
            .clause_of_kind(callee, |kind| kind.is_some() == as_value)
            .or_else(|| self.clause_of_kind(callee, |_| true))
        else {
            let name = match &callee.kind {
                K::Name(name) => name.clone(),
                _ => "this".to_string(),
            };
            let finding = Diagnostic::error(
                Code::ScenariosClause,
                callee.span,
                format!("`{name}` is no clause of a {}", standing.whole()),
            );
            let may_stand = |kind: Option<&String>| kind.is_some() == as_value || self.is_line_of(standing, kind);
            let known = self.clauses.iter().filter(|c| may_stand(c.kind.as_ref()));
            let foreign = foreign_clause(&name, standing).map(str::to_string);
            let finding = match foreign.or_else(|| self.suggestion(&name, known.map(|c| c.signature.name.as_str()))) {
                Some(help) => finding.help(help),
                None => finding,
            };
            self.report(finding);
            return None;
        };
        let (name, params, nested, otherwise) = {
            let clause = &self.clauses[id];
            let signature = &clause.signature;
            (signature.name.clone(), signature.params.clone(), clause.nested.clone(), clause.otherwise.clone())
        };
        let kind = self.clauses[id].kind.as_ref();
        if kind.is_some() != as_value && !self.is_line_of(standing, kind) {
            let takes =
                self.clauses.iter().find(|c| c.nested.iter().any(|nested| nested.is_some() && nested.as_ref() == kind));
            let help = match takes {
                _ if let Some(help) = foreign_clause(&name, standing) => help.to_string(),
                Some(clause) => format!("it is a value of another clause: `{}({name}…)`", clause.signature.name),
                None => "it stands on a line of its own".to_string(),
            };
            self.report(
                Diagnostic::error(Code::ScenariosClause, e.span, format!("`{name}` cannot stand here")).help(help),
            );
            return None;
        }
        // Clauses as arguments are taken out first: the rest are arguments like any.
        let mut values: Vec<(String, ClauseArg)> = Vec::new();
        let mut plain_args = Vec::new();
        let mut failed = false;
        for arg in args {
            if let Some(label) = &arg.label
                && let Some(param) = params.iter().find(|param| param.name == label.node)
            {
                self.names_used.refer(label.span, param.span);
            }
            let head = match &arg.value.kind {
                K::Call(callee, _) => callee.as_ref(),
                _ => &arg.value,
            };
            if let Some(vehicle) = self.vehicle_named(head) {
                let given = self.of_vehicle(vehicle, head.span, &params, &nested);
                // What is wrong with a vehicle that gives nothing has been told.
                failed |= given.is_empty();
                values.extend(given);
                continue;
            }
            if nested.iter().any(Option::is_some) && self.misses_vehicle(head) {
                failed = true;
                continue;
            }
            let takes = |kind: Option<&String>| kind.is_some() && nested.iter().any(|n| n.as_ref() == kind);
            // A parameter of the scenario goes before a clause of its name, but where just such a clause is wanted.
            let is_local = matches!(&head.kind, K::Name(name) if self.local(name).is_some());
            let any = |_: Option<&String>| !is_local;
            if let Some(inner) = self.clause_of_kind(head, takes).or_else(|| self.clause_of_kind(head, any)) {
                let inner_name = self.clauses[inner].signature.name.clone();
                // Where it goes: the parameter of its label, else the first whose type it is.
                let kind = self.clauses[inner].kind.clone();
                let place = params
                    .iter()
                    .zip(&nested)
                    .find(|(p, n)| n.is_some() && **n == kind && arg.label.as_ref().is_none_or(|l| l.node == p.name));
                let given = place.and_then(|(param, _)| values.iter().find(|(given, _)| *given == param.name));
                match place {
                    Some((param, _)) if let Some((_, first)) = given => {
                        let message = format!("`{}` of `{name}` is given twice", param.name);
                        let mut finding = Diagnostic::error(Code::ArgsTwice, arg.value.span, message);
                        if let ClauseArg::Nested(first) = first {
                            finding = finding.label(first.span, "the first");
                        }
                        self.report(finding.help(format!("leave one of them out, or write a `{name}` for each")));
                        failed = true;
                    }
                    Some((param, _)) => {
                        let param = param.name.clone();
                        if let Some(used) = self.clause_use(&arg.value, Standing::Value) {
                            values.push((param, ClauseArg::Nested(used)));
                        }
                    }
                    None => self.report(Diagnostic::error(
                        Code::ScenariosClause,
                        arg.value.span,
                        format!("`{name}` takes no `{inner_name}`"),
                    )),
                }
            } else if let Some(kind) = self.misspelt_clause(head, arg, &params, &nested) {
                failed = true;
                let written = match &head.kind {
                    K::Name(name) => name.as_str(),
                    _ => "this",
                };
                let or_vehicle = if name == super::vehicle::CLAUSE { " and no vehicle" } else { "" };
                let message = format!("there is no {kind}{or_vehicle} named `{written}`");
                let finding = Diagnostic::error(Code::ScenariosClause, head.span, message);
                let finding = match self.help_with_value(&name, &kind, written) {
                    Some(help) => finding.help(help),
                    None => finding,
                };
                self.report(finding);
            } else {
                plain_args.push(arg.clone());
            }
        }
        for ((param, nested), otherwise) in params.iter().zip(&nested).zip(otherwise) {
            let is_given = values.iter().any(|(given, _)| *given == param.name);
            if let Some(otherwise) = otherwise.filter(|_| nested.is_some() && !is_given && !failed) {
                let used = self.clause_use(otherwise, Standing::Value);
                values.extend(used.map(|used| (param.name.clone(), ClauseArg::Nested(used))));
            }
        }
        let plain: Vec<super::ParamInfo> =
            params.iter().zip(&nested).filter(|(_, n)| n.is_none()).map(|(p, _)| p.clone()).collect();
        // What is no clause fits nothing where only clauses do.
        if let (true, [arg, ..]) = (plain.is_empty() && !nested.is_empty(), plain_args.as_slice()) {
            let kinds: Vec<String> = nested.iter().flatten().cloned().collect();
            let fits = self.clauses.iter().filter(|c| c.kind.as_ref().is_some_and(|kind| kinds.contains(kind)));
            let fits: Vec<&str> = fits.map(|c| c.signature.name.as_str()).collect();
            let message = format!("`{name}` takes no such thing: it takes a {}", kinds.join(" or a "));
            let finding = Diagnostic::error(Code::ScenariosClause, arg.value.span, message);
            self.report(finding.help(format!("there is {}", suggest::listed(&fits))));
            return None;
        }
        let checked = self.arguments(&name, &plain, &plain_args, e.span, None).filter(|_| !failed)?;
        values.extend(plain.into_iter().map(|p| p.name).zip(checked.into_iter().map(ClauseArg::Value)));
        Some(ClauseUse { name, span: e.span, args: values })
    }

    /// Whether what is else the value of a clause stands on a line there: a vehicle says how it moves.
    fn is_line_of(&self, standing: Standing, kind: Option<&String>) -> bool {
        standing == Standing::Vehicle && kind.is_some_and(|kind| self.vehicle_kinds().contains(kind))
    }

    /// What may be meant by a name that no value of a clause has.
    fn help_with_value(&self, clause: &str, kind: &str, written: &str) -> Option<String> {
        let of_kind = |c: &&super::ClauseInfo| c.kind.as_deref() == Some(kind);
        let known: Vec<&str> = self.clauses.iter().filter(of_kind).map(|c| c.signature.name.as_str()).collect();
        if clause == super::vehicle::CLAUSE && self.vehicle_kinds().iter().any(|k| k == kind) {
            self.help_with_vehicle(written, &known)
        } else {
            self.suggestion(written, known)
        }
    }

    /// The clause that an expression names, of a kind that fits: `flow` is a clause, and in `fault(flow, off)` a sensor.
    fn clause_of_kind(&self, e: &tree::Expr, fits: impl Fn(Option<&String>) -> bool) -> Option<usize> {
        let tree::ExprKind::Name(name) = &e.kind else {
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
    fn misspelt_clause(
        &self,
        head: &tree::Expr,
        arg: &tree::Arg,
        params: &[super::ParamInfo],
        nested: &[Option<String>],
    ) -> Option<String> {
        let tree::ExprKind::Name(name) = &head.kind else { return None };
        if self.local(name).is_some() || self.lookup(self.scope.module, name).is_some() {
            return None;
        }
        let fits = |p: &super::ParamInfo| arg.label.as_ref().is_none_or(|label| label.node == p.name);
        let kinds: Vec<&String> =
            params.iter().zip(nested).filter(|(p, _)| fits(p)).filter_map(|(_, k)| k.as_ref()).collect();
        let fitting = self.clauses.iter().filter(|c| c.kind.as_ref().is_some_and(|kind| kinds.contains(&kind)));
        let near = self.nearest(name, fitting.clone().map(|c| c.signature.name.as_str()));
        let nearest = near.and_then(|near| fitting.clone().find(|c| c.signature.name == near)?.kind.clone());
        nearest.or_else(|| kinds.first().map(|kind| (*kind).clone()))
    }
}

/// What others call a clause of a scenario: a vehicle has none of these.
fn foreign_clause(name: &str, standing: Standing) -> Option<&'static str> {
    other_languages::clause(name).filter(|_| standing == Standing::Line)
}
