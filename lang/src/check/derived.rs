//! Scenarios and vehicles that are derived from others: `scenario rough = duck with { … }` says what `duck` says, but for what it says itself.

use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{ClauseArg, ClauseUse};
use crate::syntax::tree;
use crate::types::Type;
use std::collections::BTreeMap;

/// What is derived is so from what is derived, and so on, so often at most.
const GENERATIONS_MAX: usize = 16;
/// Clauses and parameters that are had from others, in all of a script: a line may bring a thousand.
const INHERITED_MAX: usize = 1 << 16;

/// A scenario or a vehicle as it is written.
#[derive(Clone, Copy)]
pub(super) struct Declared<'t> {
    pub module: usize,
    pub name: &'t tree::Name,
    pub params: &'t [tree::Param],
    pub base: Option<&'t tree::Path>,
    pub body: &'t tree::Block,
}

/// What a scenario or a vehicle says, apart from what it has of vehicles that it names.
#[derive(Clone, Debug, Default)]
pub(super) struct Said {
    pub own: Vec<ClauseUse>,
    pub fitted: Vec<ClauseUse>,
}

/// All of one kind, in an order in which each comes after what it is derived from; and what that is.
#[derive(Default)]
pub(super) struct Lineage {
    pub order: Vec<usize>,
    pub bases: Vec<Option<usize>>,
}

/// Declarations of one kind, each with the path of its base and with the one that this names.
pub(super) struct Bases<'t> {
    /// The code of what cannot be.
    pub code: Code,
    pub names: Vec<(&'t tree::Name, Option<&'t tree::Path>)>,
    pub bases: Vec<Option<usize>>,
}

impl Bases<'_> {
    /// In what order they come, and those that are derived from themselves or through too many others.
    pub fn lineage(self) -> (Lineage, Vec<Diagnostic>) {
        let Bases { code, names, mut bases } = self;
        let mut findings = Vec::new();
        for (id, &(tree::Name { node: name, .. }, base)) in names.iter().enumerate() {
            let ancestors = std::iter::successors(bases[id], |base| bases[*base]).take(GENERATIONS_MAX + 1);
            let ancestors: Vec<usize> = ancestors.collect();
            let goes_round = |id: &usize| ancestors.iter().filter(|other| *other == id).count() > 1;
            let finding = if !ancestors.contains(&id) && ancestors.last().is_some_and(goes_round) {
                // Whoever it is derived from is derived from itself, and told so.
                None
            } else if ancestors.contains(&id) {
                let message = format!("`{name}` is derived from itself");
                Some((message, "derive one of them from another, or write it whole"))
            } else if ancestors.len() > GENERATIONS_MAX {
                let message = format!("`{name}` is derived through more than {GENERATIONS_MAX} others");
                Some((message, "derive it from one that is written whole"))
            } else {
                None
            };
            if let (Some((message, help)), Some(base)) = (finding, base) {
                findings.push(Diagnostic::error(code, base.span, message).help(help));
                bases[id] = None;
            }
        }
        let mut order: Vec<usize> = (0..names.len()).collect();
        order.sort_by_key(|id| std::iter::successors(bases[*id], |base| bases[*base]).count());
        (Lineage { order, bases }, findings)
    }
}

impl<'t> Checker<'t> {
    /// What each of these is derived from.
    pub(super) fn lineage(
        &mut self,
        all: &[Declared<'t>],
        named: impl Fn(&mut Self, &tree::Path) -> Option<usize>,
    ) -> Lineage {
        let bases = all.iter().map(|declared| {
            let base = declared.base?;
            self.within(Scope::new(declared.module, Setting::Constant), |c| named(c, base)).0
        });
        let bases = bases.collect();
        let names = all.iter().map(|declared| (declared.name, declared.base)).collect();
        let (lineage, unsound) = Bases { code: Code::ScenariosDerived, names, bases }.lineage();
        self.findings.extend(unsound);
        lineage
    }

    /// The parameters of all scenarios: each has those of what it is derived from, and then its own.
    pub(super) fn scenario_params(&mut self) {
        let all = self.scenario_items.clone();
        let mut lineage = self.lineage(&all, |c, path| c.scenario_named(path));
        let mut inherited = 0;
        for id in &lineage.order {
            let Declared { module, name, params, .. } = all[*id];
            let is_known = matches!(self.names[module].get(&name.node), Some(Def::Scenario(known)) if known == id);
            if !is_known {
                continue;
            }
            let brought = lineage.bases[*id].map_or(0, |base| self.hir.scenarios[base].vars.len());
            if self.is_too_much(&mut inherited, brought, &all[*id]) {
                lineage.bases[*id] = None;
            }
            if let Some(base) = lineage.bases[*id] {
                let (vars, defaults) =
                    (self.hir.scenarios[base].vars.clone(), self.hir.scenarios[base].defaults.clone());
                for (var, default) in vars.into_iter().zip(defaults) {
                    let set = self.inherited_default(module, &name.node, &var);
                    self.hir.scenarios[*id].defaults.push(set.or(default));
                    self.hir.scenarios[*id].vars.push(var);
                }
            }
            self.own_scenario_params(module, *id, name, params);
        }
        self.scenario_lineage = lineage;
    }

    /// The clauses of all scenarios.
    pub(super) fn check_scenarios(&mut self) {
        let mut said: Vec<Said> = vec![Said::default(); self.scenario_items.len()];
        let mut inherited = 0;
        for id in self.scenario_lineage.order.clone() {
            let Declared { module, name, body, .. } = self.scenario_items[id];
            if !matches!(self.names[module].get(&name.node), Some(Def::Scenario(known)) if *known == id) {
                continue;
            }
            let own = self.scenario_clauses(module, id, body);
            let brought = self.scenario_lineage.bases[id].map_or(0, |base| said[base].own.len());
            let written = self.scenario_items[id];
            if self.is_too_much(&mut inherited, brought, &written) {
                self.scenario_lineage.bases[id] = None;
            }
            let all = match self.scenario_lineage.bases[id] {
                Some(base) => derived(said[base].clone(), own),
                None => own,
            };
            self.hir.scenarios[id].base = self.scenario_lineage.bases[id];
            self.hir.scenarios[id].clauses = all.whole();
            said[id] = all;
        }
    }

    /// Counts what is had from another, and tells once that it is too much.
    fn is_too_much(&mut self, inherited: &mut usize, brought: usize, written: &Declared<'t>) -> bool {
        let had = *inherited <= INHERITED_MAX;
        *inherited = inherited.saturating_add(brought);
        if brought == 0 || *inherited <= INHERITED_MAX {
            return false;
        }
        if let Some(base) = written.base.filter(|_| had) {
            let message = format!("with this more than {INHERITED_MAX} clauses or parameters are had from others");
            let finding = Diagnostic::error(Code::ScenariosDerived, base.span, message);
            self.report(
                finding.help("derive fewer, or keep what many of them share in fewer clauses: a grid for pits"),
            );
        }
        true
    }

    /// The vehicle that a path names, to derive another from it.
    pub(super) fn vehicle_of_path(&mut self, path: &tree::Path) -> Option<usize> {
        match self.resolve(self.scope.module, path).cloned() {
            Some(Def::Vehicle(id)) => Some(id),
            found => {
                let what = found.map_or_else(
                    || format!("there is no vehicle `{}`", path.text()),
                    |def| format!("`{}` is {}, no vehicle", path.text(), def.what()),
                );
                let known = self.vehicle_paths();
                let known: Vec<&str> = known.iter().map(|(path, _)| path.as_str()).collect();
                let finding = Diagnostic::error(Code::ScenariosUnknown, path.span, what);
                let finding = match self.suggestion(&path.text(), known) {
                    Some(help) => finding.help(help),
                    None => finding,
                };
                self.report(finding);
                None
            }
        }
    }
}

impl Said {
    /// All of it. What a vehicle brings stands where nothing else says the same.
    pub fn whole(&self) -> Vec<ClauseUse> {
        let is_said = |clause: &&ClauseUse| self.own.iter().any(|own| own.name == clause.name);
        self.own.iter().chain(self.fitted.iter().filter(|clause| !is_said(clause))).cloned().collect()
    }
}

/// What is said by who is derived from another: a clause of the same name, and of the same thing where there may be several, stands in
/// the place of the other's.
pub(super) fn derived(base: Said, own: Said) -> Said {
    let mut all = base.own;
    let names_vehicle = own.own.iter().any(|clause| clause.name == super::vehicle::CLAUSE);
    let subject = |clause: &ClauseUse| (clause.name.clone(), thing(clause));
    // What happens in a time stands beside what else happens.
    let mut places = BTreeMap::new();
    for (at, clause) in all.iter().enumerate().filter(|(_, clause)| !happens(clause)) {
        places.entry(subject(clause)).or_insert(at);
    }
    for clause in own.own {
        match places.get(&subject(&clause)) {
            Some(&at) => all[at] = clause,
            None => all.push(clause),
        }
    }
    Said { own: all, fitted: if names_vehicle { own.fitted } else { base.fitted } }
}

/// Whether a clause is of what happens from a time to another: there may be several.
pub(super) fn happens(clause: &ClauseUse) -> bool {
    let time = Type::Quantity(crate::dimension::Dimension::TIME);
    let arg = |name: &str| clause.args.iter().find(|(param, _)| param == name).map(|(_, arg)| arg);
    let is_time = |arg: &ClauseArg| matches!(arg, ClauseArg::Value(value) if value.ty == time);
    arg("from").is_some_and(is_time) && arg("to").is_some()
}

/// The name of the thing that a clause is about, where there may be several.
fn thing(clause: &ClauseUse) -> Option<String> {
    let (_, ClauseArg::Value(name)) = clause.args.first().filter(|(param, _)| param == "name")? else { return None };
    name.literal_text()
}
