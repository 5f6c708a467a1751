//! The first pass: what every module declares, before any body is looked at.

use super::derived::Declared;
use super::lazy::Lazy;
use super::units::UnitsAhead;
use super::{Checker, ClauseInfo, Def, Module, Signature, ends};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir;
use crate::source::Span;
use crate::syntax::tree::{self, ActivityKind, Item, TyKind};
use crate::types::{EnumInfo, RecordInfo, Type};
use std::collections::{BTreeMap, BTreeSet};

/// Fields of a record at most, with those of the records that it holds.
const PARTS_MAX: usize = 256;

/// The place of each module in an order in which what a module knows comes before it: what every script knows, and what it
/// imports. No import leads back to its beginning.
fn imported_first(modules: &[Module]) -> Vec<usize> {
    let mut ranks = vec![None; modules.len()];
    let mut next = 0;
    let prelude = (0..modules.len()).filter(|&m| modules[m].prelude);
    for first in prelude.chain(0..modules.len()) {
        let mut ahead = vec![first];
        while let Some(&m) = ahead.last() {
            let known = modules[m].imports.values().chain(&modules[m].extends);
            let before = ahead.len();
            ahead.extend(known.copied().filter(|&other| ranks[other].is_none()));
            if ahead.len() == before {
                ahead.pop();
                if ranks[m].is_none() {
                    ranks[m] = Some(next);
                    next += 1;
                }
            }
        }
    }
    ranks.into_iter().flatten().collect()
}

/// What modules declare, in the order of the modules and then of the declarations.
fn in_order(declared: &[Lazy], ranks: &[usize]) -> Vec<usize> {
    let rank = |i: &usize| match &declared[*i] {
        Lazy::Unchecked { module, .. } => ranks[*module],
        // It is known already, and takes nothing more.
        Lazy::InProgress(_) | Lazy::Done(_) => 0,
    };
    let mut order: Vec<usize> = (0..declared.len()).collect();
    order.sort_by_key(rank);
    order
}

impl<'t> Checker<'t> {
    pub(super) fn run(&mut self) {
        let modules = self.modules;
        self.units_ahead = UnitsAhead::of(modules);
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.declare_item(m, item);
            }
        }
        self.nothing_is_hidden();
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.declare_types(m, item);
            }
        }
        self.records_are_small(modules);
        // Constants call functions, and the defaults and ranges of all else read constants: in their order, none waits for another
        // because a parameter asks for it first.
        let ranks = imported_first(modules);
        for id in 0..self.fn_signatures.len() {
            self.fn_signature(id);
        }
        for i in in_order(&self.consts, &ranks) {
            self.constant(i);
        }
        for (m, module) in modules.iter().enumerate() {
            module.tree.items.iter().for_each(|item| self.declare_signature(m, item));
        }
        self.scenario_params();
        for unused in self.overrides.clone().into_iter().filter(|o| o.found.is_none()) {
            self.unknown_override(&unused);
        }
        self.make_room();
        for i in in_order(&self.signals, &ranks) {
            self.module_signal(i);
        }
        self.check_vehicles();
        self.check_scenarios();
        self.payloads_are_declared();
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.check_item(m, item);
            }
        }
        // What a test asks of a behavior, or of a report, may stand in one that is made of another.
        self.check_made_activities();
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                if let Item::Test(test) = item {
                    self.check_test(m, test);
                }
            }
        }
        self.check_made_functions();
        self.tell_nominal();
        self.holes_are_read();
        if self.recursion() || self.calls_too_deep() {
            return;
        }
        // Whether a behavior can end depends on what it calls, and so does what an overlay does: these come when all bodies are known.
        let hir = std::mem::take(&mut self.hir);
        let mut known_ends = ends::Known::new();
        self.calls_go_on(&hir, &mut known_ends);
        self.overlays_do_one_thing(&hir, &mut known_ends);
        // One that is several by what it is given is looked at as it is called.
        let of_calls = |(id, _): &(usize, &hir::Activity)| !self.is_made_of(*id);
        let activities: Vec<&hir::Activity> =
            hir.activities.iter().enumerate().filter(of_calls).map(|(_, a)| a).collect();
        for activity in activities {
            if let hir::Body::Table { start, behaviors, rules } = &activity.body {
                self.in_strategy(activity.span, |c| {
                    c.check_table(&hir, &mut known_ends, activity, (behaviors, *start, rules));
                });
            }
        }
        self.tell_inherited();
        self.hir = hir;
    }

    /// Every declaration gets its index before any body is checked: bodies refer to one another.
    fn make_room(&mut self) {
        for signature in &self.fn_signatures {
            self.hir.fns.push(hir::Function::empty(&signature.name, signature.span));
        }
        for signature in &self.activity_signatures {
            self.hir.activities.push(hir::Activity::empty(&signature.name, signature.span));
        }
    }

    pub(super) fn define(&mut self, module: usize, name: &tree::Name, def: Def) {
        if let Some(earlier) = self.names[module].get(&name.node) {
            let finding = Diagnostic::error(
                Code::NamesTwice,
                name.span,
                format!("`{}` is declared already, as {}", name.node, earlier.what()),
            )
            .help("choose another name");
            self.report(finding);
            return;
        }
        self.names_used.define(name, def.what());
        self.places[module].insert(name.node.clone(), name.span);
        if self.modules[module].prelude {
            self.preludes_with.entry(name.node.clone()).or_default().push(module);
        }
        self.names[module].insert(name.node.clone(), def);
    }

    fn declare_item(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Use(paths) => {
                for name in paths.iter().filter_map(|path| path.parts.last()) {
                    self.names_used.define(name, "a module");
                    self.import_places[m].insert(name.node.clone(), name.span);
                }
            }
            Item::Test(_) => {}
            Item::Const(c) => {
                self.consts.push(Lazy::Unchecked { module: m, name: &c.name, ty: c.ty.as_ref(), value: &c.value });
                self.define(m, &c.name, Def::Const(self.consts.len() - 1));
            }
            Item::Enum { name, variants } => {
                let id = self.types.enums.len();
                let module = self.modules[m].name.clone();
                let names = variants.iter().map(|v| v.node.clone()).collect();
                self.types.enums.push(EnumInfo { name: name.node.clone(), module, variants: names });
                self.define(m, name, Def::Enum(id));
                for (i, variant) in variants.iter().enumerate() {
                    self.define(m, variant, Def::Variant(id, i));
                }
            }
            Item::Record { name, .. } => {
                let (name_text, module) = (name.node.clone(), self.modules[m].name.clone());
                let (fields, places) = (Vec::new(), Vec::new());
                self.types.records.push(RecordInfo { name: name_text, module, fields, places });
                self.define(m, name, Def::Record(self.types.records.len() - 1));
            }
            Item::Unit { name, value } => self.declare_unit(m, name, value),
            Item::Input { name, .. } => {
                let (fields, places) = (Vec::new(), Vec::new());
                self.hir.inputs.push(hir::Input { name: name.node.clone(), ty: Type::Unknown, fields, places });
                self.define(m, name, Def::Input(self.hir.inputs.len() - 1));
            }
            Item::Payload { name, actions } => self.declare_payload(m, name, actions),
            Item::Clause { name, result, of_vehicle, .. } => {
                let kind = result.as_ref().and_then(|ty| match &ty.kind {
                    TyKind::Named { path, .. } => Some(path.text()),
                    TyKind::List { .. } | TyKind::Map { .. } | TyKind::Behavior(..) => None,
                });
                let (signature, of_vehicle) = (Signature::named(name), *of_vehicle);
                let (nested, otherwise) = (Vec::new(), Vec::new());
                self.clauses.push(ClauseInfo { signature, nested, otherwise, kind, of_vehicle });
                self.define(m, name, Def::Clause(self.clauses.len() - 1));
            }
            Item::Fn(f) => {
                let id = self.fn_signatures.len();
                self.fn_signatures.push(Signature::named(&f.name));
                self.fns_ahead.insert(id, (m, f));
                self.define(m, &f.name, Def::Fn(id));
            }
            Item::Signal { name, ty, value } => {
                self.signals.push(Lazy::Unchecked { module: m, name, ty: ty.as_ref(), value });
                self.define(m, name, Def::Signal(self.signals.len() - 1));
            }
            Item::Activity(a) => {
                self.activity_signatures.push(Signature::named(&a.name));
                let id = self.activity_signatures.len() - 1;
                match a.kind {
                    ActivityKind::Overlay { .. } => _ = self.overlay_ids.insert(id),
                    ActivityKind::Mission { .. } => _ = self.mission_ids.insert(id),
                    _ => {}
                }
                self.define(m, &a.name, Def::Activity(id));
            }
            Item::Scenario { name, params, base, body } => {
                self.scenario_items.push(Declared { module: m, name, params, base: base.as_ref(), body });
                self.declare_scenario(m, name);
            }
            Item::Vehicle { name, base, body } => {
                self.vehicle_items.push(Declared { module: m, name, params: &[], base: base.as_ref(), body });
                self.declare_vehicle(m, name);
            }
        }
    }

    fn declare_scenario(&mut self, m: usize, name: &'t tree::Name) {
        self.hir.scenarios.push(hir::Scenario {
            name: name.node.clone(),
            full_name: self.full_name(m, &name.node),
            path: self.path_from_script(m, &name.node),
            span: name.span,
            vars: Vec::new(),
            defaults: Vec::new(),
            base: None,
            clauses: Vec::new(),
        });
        self.define(m, name, Def::Scenario(self.hir.scenarios.len() - 1));
    }

    fn declare_types(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Record { name, fields } => {
                self.fields_once(fields);
                let places = fields.iter().map(|f| f.name.span).collect();
                let fields = fields.iter().map(|f| (f.name.node.clone(), self.written_type(m, &f.ty))).collect();
                if let Some(&Def::Record(id)) = self.names[m].get(&name.node) {
                    self.types.records[id].places = places;
                    self.types.records[id].fields = fields;
                    if self.holds_itself(id) {
                        self.types.records[id].fields.clear();
                        let message = format!("the record `{}` would hold itself", name.node);
                        let finding = Diagnostic::error(Code::TypesRecursive, name.span, message);
                        self.report(finding.help("leave out the field that leads back to it"));
                    }
                }
            }
            Item::Input { name, ty, fields } => {
                self.fields_once(fields);
                let places = fields.iter().map(|f| f.name.span).collect();
                let ty = self.written_type(m, ty);
                let fields = fields.iter().map(|f| (f.name.node.clone(), self.written_type(m, &f.ty))).collect();
                if let Some(&Def::Input(id)) = self.names[m].get(&name.node) {
                    self.hir.inputs[id].ty = ty;
                    self.hir.inputs[id].fields = fields;
                    self.hir.inputs[id].places = places;
                }
            }
            Item::Payload { actions, .. } => self.payload_answers(m, actions),
            _ => {}
        }
    }

    fn fields_once(&mut self, fields: &[tree::Field]) {
        let mut firsts: BTreeMap<&str, Span> = BTreeMap::new();
        for tree::Field { name, .. } in fields {
            self.names_used.define(name, "a field");
            let first = *firsts.entry(&name.node).or_insert(name.span);
            if first != name.span {
                let finding =
                    Diagnostic::error(Code::NamesTwice, name.span, format!("there are two fields `{}`", name.node));
                self.report(finding.label(first, "the first").help("choose another name, or leave it out"));
            }
        }
    }

    /// Whether a record is found again in what it holds. One with too many parts is not looked through: it is refused anyway.
    fn holds_itself(&self, id: usize) -> bool {
        let mut seen = BTreeSet::new();
        let mut ahead = vec![id];
        let mut left = PARTS_MAX;
        while let Some(record) = ahead.pop() {
            for (_, ty) in &self.types.records[record].fields {
                let Some(fewer) = left.checked_sub(1) else { return false };
                left = fewer;
                let mut ty = ty;
                while let Type::Optional(inner) | Type::List(inner, _) | Type::Map(inner, _) = ty {
                    ty = inner;
                }
                match ty {
                    Type::Record(inner) if *inner == id => return true,
                    Type::Record(inner) if seen.insert(*inner) => ahead.push(*inner),
                    _ => {}
                }
            }
        }
        false
    }

    /// Records of records grow with each level: what is made of too many parts keeps none, so that no walk over a type is
    /// long.
    fn records_are_small(&mut self, modules: &'t [Module]) {
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                if let Item::Record { name, .. } = item
                    && let Some(&Def::Record(id)) = self.names[m].get(&name.node)
                    // With the record itself.
                    && !self.types.has_parts_at_most(&Type::Record(id), PARTS_MAX + 1)
                {
                    self.types.records[id].fields.clear();
                    let message = format!("the record `{}` has more than {PARTS_MAX} parts", name.node);
                    self.report(
                        Diagnostic::error(Code::LimitsRecord, name.span, message)
                            .here("with those of the records that it holds")
                            .help("hold fewer records in one another, or keep several of a kind in a list"),
                    );
                }
            }
        }
    }

    fn declare_signature(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Activity(a) => {
                if let Some(&Def::Activity(id)) = self.names[m].get(&a.name.node) {
                    let params = self.activity_params(id, m, a);
                    let result = a.result.as_ref().map(|ty| self.written_type(self.home(ty.span, m), ty));
                    if let ActivityKind::Strategy { base: Some(base) } = &a.kind {
                        self.resolve(m, base);
                    }
                    if matches!(a.kind, ActivityKind::Mission { .. }) {
                        self.mission_params(a);
                    }
                    let name = &self.modules[m].name;
                    let full = if name.is_empty() { a.name.node.clone() } else { format!("{name}.{}", a.name.node) };
                    let signature = &mut self.activity_signatures[id];
                    signature.params = params;
                    signature.result = result;
                    signature.name = full;
                }
            }
            Item::Clause { name, params, .. } => {
                if let Some(&Def::Clause(id)) = self.names[m].get(&name.node) {
                    self.clause_is_new(m, name);
                    self.declare_clause(m, id, params);
                }
            }
            _ => {}
        }
    }

    /// The simulator goes by the ranges of the clauses that every script knows: none can be declared anew, with others.
    fn clause_is_new(&mut self, m: usize, name: &tree::Name) {
        let mut preludes = self.preludes_with.get(&name.node).into_iter().flatten();
        let is_known = preludes.any(|&m| matches!(self.names[m].get(&name.node), Some(Def::Clause(_))));
        if is_known && !self.modules[m].prelude {
            let message = format!("`{}` is the name of a clause already", name.node);
            let finding = Diagnostic::error(Code::NamesShadowed, name.span, message);
            self.report(finding.here("nothing can be shadowed").help("choose another name"));
        }
    }

    fn check_item(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Fn(f) => self.check_fn(m, f),
            Item::Activity(a) => {
                if let Some(&Def::Activity(id)) = self.names[m].get(&a.name.node) {
                    self.check_activity(m, id, a);
                }
            }
            _ => {}
        }
    }

    /// The parameters that a scenario declares itself.
    pub(super) fn own_scenario_params(&mut self, m: usize, id: usize, name: &tree::Name, params: &'t [tree::Param]) {
        let infos = self.params(m, params, Some(&name.node));
        for info in infos.iter().filter(|info| info.default.is_none() && info.ty != Type::Unknown) {
            let message = format!("`{}` of a scenario needs a value", info.name);
            let finding = Diagnostic::error(Code::ArgsMissing, info.span, message);
            self.report(finding.help("give it a default, which `--set` changes"));
        }
        let inherited = self.hir.scenarios[id].vars.len();
        for info in infos {
            let var = hir::Var {
                name: info.name,
                kind: hir::VarKind::Param,
                ty: info.ty.clone(),
                span: info.span,
                range: info.range.unwrap_or_else(|| super::result_range::of_type(&info.ty)),
                walks_constants: false,
                is_momentary: false,
                order: None,
            };
            let replaced = self.hir.scenarios[id].vars[..inherited].iter().position(|theirs| theirs.name == var.name);
            let fits = replaced.is_none_or(|at| self.fits_in_place_of(&var, self.hir.scenarios[id].vars[at].clone()));
            if replaced.is_some() {
                // The base's clauses read it.
                self.names_used.read(var.span);
            }
            let scenario = &mut self.hir.scenarios[id];
            match replaced {
                Some(at) if fits => (scenario.vars[at], scenario.defaults[at]) = (var, info.default),
                Some(_) => {}
                None => {
                    scenario.vars.push(var);
                    scenario.defaults.push(info.default);
                }
            }
        }
    }

    /// Whether a parameter can stand in the place of one that a scenario has of its base. The base's clauses were checked with that: they hold for
    /// what is of its type and in its range.
    fn fits_in_place_of(&mut self, own: &hir::Var, theirs: hir::Var) -> bool {
        let name = &own.name;
        let (message, help) = if own.ty != theirs.ty {
            let ty = self.type_name(&theirs.ty);
            (
                format!("`{name}` is a parameter of the base, of the type {ty}"),
                "give it that type, or choose another name".to_string(),
            )
        } else if own.range.low < theirs.range.low || own.range.high > theirs.range.high {
            let [low, high] = [theirs.range.low, theirs.range.high].map(|x| self.shown_number(x, &theirs.ty));
            (
                format!("`{name}` may be more or less than in the base"),
                format!("write a range that lies within that of the base: `in {low}..{high}`"),
            )
        } else {
            return true;
        };
        let finding =
            Diagnostic::error(Code::ScenariosDerived, own.span, message).label(theirs.span, "that of the base");
        self.report(finding.help(help));
        false
    }
}
