//! Scenarios: clauses with typed arguments. What a clause means is for the simulator; its parameters are declared in
//! the standard library like those of any function.

use super::derived::{Said, happens};
use super::quantity::names_quantity;
use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::ClauseUse;
use crate::syntax::tree::{self, Action, ClauseKind, TyKind};
use crate::types::Type;

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
    pub(super) fn whole(self) -> &'static str {
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
                TyKind::List { .. } | TyKind::Map { .. } | TyKind::Behavior(..) => None,
            };
            nested.push(kind);
        }
        let mut infos = Vec::new();
        let takes_quantity = params.iter().any(|param| names_quantity(&param.ty));
        let outer = std::mem::replace(&mut self.scope.takes_quantity, takes_quantity);
        for (param, nested) in params.iter().zip(&nested) {
            if nested.is_some() {
                self.names_used.define(&param.name, "a parameter");
                infos.push(super::ParamInfo {
                    name: param.name.node.clone(),
                    ty: Type::Unknown,
                    default: None,
                    behavior: None,
                    range: None,
                    span: param.name.span,
                });
            } else {
                infos.extend(self.params(m, std::slice::from_ref(param), None));
            }
        }
        self.scope.takes_quantity = outer;
        self.clauses[id].otherwise = params.iter().map(|param| param.default.as_ref()).collect();
        self.clauses[id].signature.params = infos;
        self.clauses[id].nested = nested;
    }

    pub(super) fn scenario_named(&mut self, path: &tree::Path) -> Option<usize> {
        match self.resolve(self.scope.module, path).cloned() {
            Some(Def::Scenario(id)) => Some(id),
            // A scenario may also be chosen on the command line: what is missing here is reported where it is run.
            found => {
                let known: Vec<String> = self.hir.scenarios.iter().map(|s| s.path.clone()).collect();
                let message = match found {
                    Some(def) => format!("`{}` is {}, no scenario", path.text(), def.what()),
                    None => format!("there is no scenario `{}`", path.text()),
                };
                let finding = Diagnostic::error(Code::ScenariosUnknown, path.span, message);
                let finding = match self.suggestion(&path.text(), known.iter().map(String::as_str)) {
                    Some(help) => finding.help(help),
                    None => finding,
                };
                self.report(finding);
                None
            }
        }
    }

    /// The clauses of a scenario's own block.
    pub(super) fn scenario_clauses(&mut self, m: usize, id: usize, body: &'t tree::Block) -> Said {
        let mut scope = Scope::new(m, Setting::Constant);
        for var in self.hir.scenarios[id].vars.clone() {
            self.names_used.declare(&tree::Name { node: var.name.clone(), span: var.span }, var.kind);
            scope.visible.push(var.name.clone(), scope.vars.len());
            scope.vars.push(var);
        }
        let (own, scope) = self.within(scope, |c| c.clause_lines(body, Standing::Line));
        self.clauses_once(&own);
        self.hir.scenarios[id].vars = scope.vars;
        Said { own, fitted: std::mem::take(&mut self.fitted) }
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

    /// A clause that has a name may stand several times: each is another thing. So may one of what happens
    /// from a time to another. All others stand once.
    pub(super) fn clauses_once(&mut self, clauses: &[ClauseUse]) {
        for (i, clause) in clauses.iter().enumerate() {
            let first = clauses[..i].iter().find(|c| c.name == clause.name);
            let has_name = clause.args.iter().any(|(param, _)| param == "name");
            if let Some(first) = first.filter(|_| !has_name && !happens(clause)) {
                let message = format!("a scenario has one `{}`", clause.name);
                let finding = Diagnostic::error(Code::ScenariosTwice, clause.span, message);
                self.report(finding.label(first.span, "the first").help("leave one of them out"));
            }
        }
    }
}
