//! Vehicles: what belongs to one hull, wherever it swims. A scenario that names one has its hull, and says what it does not
//! say itself: sensors, limits.

use super::derived::{Declared, Said, derived};
use super::names::Found;
use super::scenario::Standing;
use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{ClauseArg, ClauseUse};
use crate::source::{FileId, Source, Span};
use crate::syntax;
use crate::syntax::tree::{self, ExprKind, Item};
use crate::types::Type;
use albacore_wording::{listed, nearest};

/// The clause with which a scenario names a vehicle.
pub(super) const CLAUSE: &str = "vehicle";

/// The module of the standard library that holds vehicles.
const LIBRARY: &str = "vehicles";

/// A vehicle, as far as it is checked.
#[derive(Clone, Debug)]
pub(super) struct VehicleInfo {
    name: String,
    /// What the scenario's own clause takes of it, each with its kind: how it moves.
    values: Vec<(String, ClauseUse)>,
    /// What else it says.
    clauses: Vec<ClauseUse>,
}

impl<'t> Checker<'t> {
    pub(super) fn declare_vehicle(&mut self, m: usize, name: &'t tree::Name) {
        self.vehicles.push(VehicleInfo { name: name.node.clone(), values: Vec::new(), clauses: Vec::new() });
        self.define(m, name, Def::Vehicle(self.vehicles.len() - 1));
    }

    /// Scenarios take from vehicles, so that these come first.
    pub(super) fn check_vehicles(&mut self) {
        let all = self.vehicle_items.clone();
        let lineage = self.lineage(&all, |c, path| c.vehicle_of_path(path));
        for id in lineage.order {
            let Declared { module, name, .. } = all[id];
            if matches!(self.names[module].get(&name.node), Some(Def::Vehicle(known)) if *known == id) {
                self.check_vehicle(module, id, &all[id], lineage.bases[id]);
            }
        }
    }

    fn check_vehicle(&mut self, m: usize, id: usize, written: &Declared<'t>, base: Option<usize>) {
        let Declared { name, body, .. } = *written;
        let (mut clauses, _) =
            self.within(Scope::new(m, Setting::Constant), |c| c.clause_lines(body, Standing::Vehicle));
        self.clauses_once(&clauses);
        clauses.retain(|used| {
            let is_own = !self.stands_alone(&used.name) || self.is_of_vehicle(&used.name);
            if !is_own {
                let message = format!("`{}` belongs in a scenario, not in a vehicle", used.name);
                let finding = Diagnostic::error(Code::ScenariosClause, used.span, message);
                self.report(finding.help("move it there: a vehicle says how it moves, its instruments, its limits"));
            }
            is_own
        });
        // What is unknown of the other is told already.
        let is_whole = clauses.len() == body.clauses.len() && written.base.is_some() == base.is_some();
        let kind = |c: &Self, used: &ClauseUse| {
            let info = c.clauses.iter().find(|info| info.signature.name == used.name && info.kind.is_some());
            info.and_then(|info| info.kind.clone()).filter(|_| !c.stands_alone(&used.name))
        };
        let (mut values, mut rest) = (Vec::new(), Vec::new());
        for used in clauses {
            match kind(self, &used) {
                Some(kind) => values.push((kind, used)),
                None => rest.push(used),
            }
        }
        for (i, (kind, used)) in values.iter().enumerate() {
            if let Some((_, first)) = values[..i].iter().find(|(earlier, _)| earlier == kind) {
                let message = format!("a vehicle has one {kind}");
                let finding = Diagnostic::error(Code::ScenariosTwice, used.span, message);
                self.report(finding.label(first.span, "the first").help("leave one of them out"));
            }
        }
        if let Some(base) = base.map(|base| self.vehicles[base].clone()) {
            let is_said = |kind: &String| values.iter().any(|(own, _)| own == kind);
            let inherited: Vec<_> = base.values.into_iter().filter(|(kind, _)| !is_said(kind)).collect();
            values.splice(..0, inherited);
            rest = derived(Said { own: base.clauses, ..Said::default() }, Said { own: rest, ..Said::default() }).own;
        }
        if values.is_empty() && is_whole {
            let kinds = self.vehicle_kinds().join(" or ");
            let message = format!("the vehicle `{}` has no {kinds}", name.node);
            let finding = Diagnostic::error(Code::ScenariosClause, name.span, message);
            self.report(finding.help("say how it moves: `kinematic()`, for example"));
        }
        (self.vehicles[id].values, self.vehicles[id].clauses) = (values, rest);
    }

    /// The kinds of values that a vehicle may hold on a line of their own: those that a scenario's clause takes from it.
    pub(super) fn vehicle_kinds(&self) -> Vec<String> {
        let clause = self.clauses.iter().find(|clause| clause.signature.name == CLAUSE);
        clause.map_or_else(Vec::new, |clause| clause.nested.iter().flatten().cloned().collect())
    }

    /// Whether a clause of this name stands on a line of its own.
    fn stands_alone(&self, name: &str) -> bool {
        self.clauses.iter().any(|clause| clause.signature.name == name && clause.kind.is_none())
    }

    /// Whether that clause is one that a vehicle may say.
    fn is_of_vehicle(&self, name: &str) -> bool {
        self.clauses.iter().any(|clause| clause.signature.name == name && clause.of_vehicle)
    }

    /// The vehicle that an expression names.
    pub(super) fn vehicle_named(&self, e: &tree::Expr) -> Option<usize> {
        let def = match &e.kind {
            ExprKind::Name(name) => {
                self.refer_to(e.span, self.scope.module, name, |def| matches!(def, Def::Vehicle(_)));
                self.lookup_if(self.scope.module, name, |def| matches!(def, Def::Vehicle(_))).cloned()
            }
            _ => match self.find(e) {
                Found::Def(def) => Some(def),
                Found::Nothing => None,
            },
        };
        match def {
            Some(Def::Vehicle(id)) => Some(id),
            _ => None,
        }
    }

    /// What may be meant by a name that neither a hull nor a vehicle has here: a vehicle of a module, or one that can be imported.
    pub(super) fn help_with_vehicle(&self, written: &str, hulls: &[&str]) -> Option<String> {
        let imports = &self.modules[self.scope.module].imports;
        let known = self.vehicle_paths();
        let library = if imports.contains_key(LIBRARY) { Vec::new() } else { self.library_vehicles() };
        let names = known.iter().map(|(_, name)| name.as_str());
        let near = nearest(written, hulls.iter().copied().chain(names).chain(library.iter().map(String::as_str)));
        let path = near.and_then(|near| known.iter().find(|(_, name)| name == near)).map(|(path, _)| path);
        Some(match (near, path) {
            (_, Some(path)) => format!("did you mean `{path}`?"),
            (Some(near), None) if hulls.contains(&near) => format!("did you mean `{near}`?"),
            (Some(near), None) => {
                format!("write `use {LIBRARY}` at the top of the file, and `{LIBRARY}.{near}` here")
            }
            (None, None) => {
                let paths = known.iter().map(|(path, _)| path.as_str());
                let all: Vec<&str> = hulls.iter().copied().chain(paths).collect();
                let paths: Vec<String> = library.iter().map(|name| format!("{LIBRARY}.{name}")).collect();
                let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
                let more =
                    if paths.is_empty() { "" } else { &format!(", and with `use {LIBRARY}` {}", listed(&paths)) };
                format!("there is {}{more}", listed(&all))
            }
        })
    }

    /// The vehicles that can be named here: how, and their names.
    pub(super) fn vehicle_paths(&self) -> Vec<(String, String)> {
        let own = self.vehicles_of(self.scope.module).into_iter().map(|name| (name.clone(), name));
        let imported = self.modules[self.scope.module].imports.iter().flat_map(|(module, &at)| {
            self.vehicles_of(at).into_iter().map(move |name| (format!("{module}.{name}"), name))
        });
        own.chain(imported).collect()
    }

    /// The vehicles that a module declares.
    fn vehicles_of(&self, module: usize) -> Vec<String> {
        let items = self.modules[module].tree.items.iter();
        items.filter_map(vehicle_name).collect()
    }

    /// Those of the standard library, for who has not imported them.
    fn library_vehicles(&self) -> Vec<String> {
        let nowhere = Source { name: "".into(), text: "".into() };
        let Ok(source) = self.library.module(&nowhere, &[LIBRARY.to_string()]) else { return Vec::new() };
        let parsed = syntax::parse(FileId(0), &source.text);
        parsed.file.items.iter().filter_map(vehicle_name).collect()
    }

    /// Whether `module.name` stands for nothing at all, which is told: it would be taken for another argument.
    pub(super) fn misses_vehicle(&mut self, e: &tree::Expr) -> bool {
        let is_member = matches!(e.kind, ExprKind::Member(..));
        is_member && matches!(self.find(e), Found::Nothing) && self.expr(e, None).ty == Type::Unknown
    }

    /// What a vehicle gives to the clause that names it: a value for each parameter whose kind it has.
    pub(super) fn of_vehicle(
        &mut self,
        id: usize,
        at: Span,
        params: &[super::ParamInfo],
        nested: &[Option<String>],
    ) -> Vec<(String, ClauseArg)> {
        let vehicle = self.vehicles[id].clone();
        self.fitted.extend(vehicle.clauses);
        let mut given = Vec::new();
        for (param, kind) in params.iter().zip(nested) {
            let value = vehicle.values.iter().find(|(has, _)| Some(has) == kind.as_ref());
            given.extend(value.map(|(_, used)| (param.name.clone(), ClauseArg::Nested(used.clone()))));
        }
        if given.is_empty() && !vehicle.values.is_empty() {
            let message = format!("the vehicle `{}` cannot stand here", vehicle.name);
            let help = format!("a scenario names it in its `{CLAUSE}({}, start: …)`", vehicle.name);
            self.report(Diagnostic::error(Code::ScenariosClause, at, message).help(help));
        }
        given
    }
}

fn vehicle_name(item: &Item) -> Option<String> {
    if let Item::Vehicle { name, .. } = item { Some(name.node.clone()) } else { None }
}
