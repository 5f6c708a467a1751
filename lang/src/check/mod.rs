//! Names, types, dimensions and frames: from trees to the checked program, with every mistake of every file.

mod activity;
mod advice;
mod area_file;
mod args;
mod body;
mod capacities;
mod choice;
mod clause;
mod convert;
mod declare;
mod depth;
mod derived;
mod ends;
mod expr;
mod facts;
mod flow;
mod foregone;
mod formulas;
mod given_behaviors;
mod globe;
mod hidden;
mod lazy;
mod lists;
mod loops;
mod maps;
mod members;
mod mission;
mod names;
mod operators;
mod overlay;
mod params;
mod payload;
mod plausibility;
mod polygon;
mod quantity;
mod questions;
mod recording;
mod records;
mod recursion;
mod result_range;
mod room;
mod scenario;
mod stray;
mod table;
mod test;
mod timed;
mod truth;
mod type_syntax;
mod units;
mod unknown_calls;
mod unused;
mod value;
mod vehicle;
mod visible;
mod while_active;
mod whole;

pub use ends::never_ends;
pub(crate) use flow::{goes_round, least_time, takes_time};
pub(crate) use members::member_names;
pub use params::Override;
pub(crate) use plausibility::range_of_var;
pub use room::{check, too_large};

use crate::Library;
use crate::diagnostic::Diagnostic;
use crate::dimension::Unit;
use crate::hir::{self, Hir, Interval};
use crate::names::Names;
use crate::prompt::Known;
use crate::source::{FileId, Source, Span};
use crate::syntax::tree;
use crate::types::{EnumId, RecordId, Type, TypeTable};
use albacore_formats::FileFault;
use derived::{Declared, Lineage};
use facts::Facts;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;
use units::UnitsAhead;
use visible::Visible;

/// Beyond this many findings no name is searched for what it may have meant: each search looks at all names, and nobody
/// reads so far.
pub(crate) const HELPED_MAX: usize = 200;

/// A file with the name by which others import it.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// `cpt`, or empty for the file that is run.
    pub name: String,
    /// Its tree.
    pub tree: Arc<tree::File>,
    /// Where each imported name leads: index into the modules.
    pub imports: BTreeMap<String, usize>,
    /// Its names are known everywhere without being imported.
    pub prelude: bool,
    /// A line of the prompt: the module whose names it knows as its own.
    pub extends: Option<usize>,
    /// A line of statements at the prompt: names whose values are put in place before its mission begins.
    pub known: Option<Vec<Known>>,
}

/// What a name of a module stands for.
#[derive(Clone, Debug)]
enum Def {
    Const(usize),
    Enum(EnumId),
    Variant(EnumId, usize),
    Record(RecordId),
    Unit(Unit),
    Input(usize),
    Clause(usize),
    Fn(usize),
    Signal(usize),
    Activity(usize),
    Scenario(usize),
    Vehicle(usize),
    Payload(usize),
}

impl Def {
    fn can_be_called(&self) -> bool {
        matches!(self, Def::Fn(_) | Def::Record(_) | Def::Clause(_) | Def::Activity(_))
    }

    /// A value may have the same name: one before `(` is looked up among what can be called, any other among values.
    fn shares_its_name(&self) -> bool {
        self.can_be_called() || matches!(self, Def::Scenario(_) | Def::Vehicle(_) | Def::Payload(_))
    }

    fn what(&self) -> &'static str {
        match self {
            Def::Const(_) => "a constant",
            Def::Enum(_) => "an enum",
            Def::Variant(..) => "a variant",
            Def::Record(_) => "a record",
            Def::Unit(_) => "a unit",
            Def::Input(_) => "an input",
            Def::Clause(_) => "a clause of scenarios",
            Def::Fn(_) => "a function",
            Def::Signal(_) => "a signal",
            Def::Activity(_) => "a behavior, strategy, overlay or mission",
            Def::Scenario(_) => "a scenario",
            Def::Vehicle(_) => "a vehicle",
            Def::Payload(_) => "a payload",
        }
    }
}

/// What a parameter of anything callable is.
#[derive(Clone, Debug)]
struct ParamInfo {
    name: String,
    ty: Type,
    default: Option<hir::Expr>,
    range: Option<Interval>,
    /// What is known of one that is a behavior.
    behavior: Option<given_behaviors::BehaviorType>,
    span: Span,
}

/// What is known of a callable before its body is looked at.
#[derive(Clone, Debug)]
struct Signature {
    name: String,
    span: Span,
    params: Vec<ParamInfo>,
    result: Option<Type>,
}

impl Signature {
    /// Of what has been declared, its parameters unread as yet.
    fn named(name: &tree::Name) -> Self {
        Signature { name: name.node.clone(), span: name.span, params: Vec::new(), result: None }
    }
}

/// A clause that scenarios may hold.
#[derive(Clone)]
struct ClauseInfo<'t> {
    signature: Signature,
    /// For each parameter the kind of clause that is its value, when it takes a clause.
    nested: Vec<Option<String>>,
    /// And the clause that it is when none is given.
    otherwise: Vec<Option<&'t tree::Expr>>,
    /// A clause of a kind is the value of another clause's parameter, not a clause of its own.
    kind: Option<String>,
    /// A vehicle may say it, and brings it to whatever scenario it swims in.
    of_vehicle: bool,
}

/// Where code stands, which tells what it may do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Setting {
    /// Constants, defaults: nothing of a vehicle.
    Constant,
    /// A function: its parameters and its own variables.
    Function,
    /// Reactions, `do`, `amend`: may assign memory, takes no time.
    Instant,
    /// A body: statements may take time.
    Body,
}

/// Which temporal operators may stand here.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Temporal {
    /// None.
    No,
    /// `X for T`, `becomes`, `after`.
    Yes,
    /// These and `every`.
    Reaction,
    /// These and `done`.
    Rule,
}

/// A block of a mission in which the vehicle is ours for certain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Driving {
    /// That of an `override`, which stands here.
    Override(Span),
    /// The recovery of a mission.
    Recovery,
}

/// The names that code can see.
struct Scope {
    module: usize,
    setting: Setting,
    temporal: Temporal,
    /// In what a temporal operator watches, or behind `not`.
    is_watched: bool,
    vars: Vec<hir::Var>,
    visible: Visible,
    facts: Facts,
    /// What was known where the condition begins that is being looked at.
    standing: Facts,
    /// What `finish` must give: none where it cannot stand.
    finish: Option<Option<Type>>,
    /// The block in which the vehicle is ours already: neither `watch` nor `override` can stand there.
    driving: Option<Driving>,
    /// In a block that is a value: the first variable that is its own.
    value_from: Option<usize>,
    /// The last expression of a block, whose value is the block's.
    tail: Option<Span>,
    /// A strategy that is derived: what it says itself, and the modules in which its parts stand.
    derived: Option<whole::Derived>,
    /// In a body that is looked at by itself, with what stands in for what it is given.
    is_nominal: bool,
    /// The parameters that are behaviors.
    behaviors: Vec<given_behaviors::GivenBehavior>,
    /// What names of capacities stand for, in a function of lists of any; and whether it is one of any quantity.
    capacities: capacities::Capacities,
    takes_quantity: bool,
}

impl Scope {
    fn new(module: usize, setting: Setting) -> Self {
        Scope {
            module,
            setting,
            temporal: Temporal::No,
            is_watched: false,
            vars: Vec::new(),
            visible: Visible::default(),
            facts: Facts::default(),
            standing: Facts::default(),
            finish: None,
            driving: None,
            value_from: None,
            tail: None,
            derived: None,
            is_nominal: false,
            behaviors: Vec::new(),
            capacities: Vec::new(),
            takes_quantity: false,
        }
    }
}

/// Checks modules.
pub struct Checker<'t> {
    modules: &'t [Module],
    /// In which module the parts of strategies stand, by their files; empty where none is derived.
    homes: BTreeMap<FileId, usize>,
    /// The places of the names of strategies that are derived from none.
    baseless: BTreeSet<Span>,
    library: &'t dyn Library,
    /// The files of data that the scripts name, each read once.
    files: BTreeMap<String, Result<Vec<u8>, FileFault>>,
    holed: area_file::Holed,
    names: Vec<BTreeMap<String, Def>>,
    /// The preludes that define a name. Most names of a script are of a prelude, and there are many.
    preludes_with: BTreeMap<String, Vec<usize>>,
    /// Where each module declares what it does, and its imports, by their names.
    places: Vec<BTreeMap<String, Span>>,
    import_places: Vec<BTreeMap<String, Span>>,
    consts: Vec<lazy::Lazy<'t>>,
    signals: Vec<lazy::Lazy<'t>>,
    /// How many constants and signals wait for others.
    waiting: usize,
    /// Parts of constants that have been read.
    parts_read: usize,
    clauses: Vec<ClauseInfo<'t>>,
    vehicles: Vec<vehicle::VehicleInfo>,
    /// Scenarios and vehicles as they are written, by their numbers.
    scenario_items: Vec<Declared<'t>>,
    vehicle_items: Vec<Declared<'t>>,
    scenario_lineage: Lineage,
    /// What vehicles bring into the scenario that is being checked.
    fitted: Vec<hir::ClauseUse>,
    fn_signatures: Vec<Signature>,
    templates: capacities::Templates<'t>,
    /// What is wrong with such ones as they are declared, with what stands in for what they are given: of a function or of an activity.
    nominal_findings: Vec<(capacities::Declared, Diagnostic)>,
    activity_templates: given_behaviors::ActivityTemplates<'t>,
    /// Units whose turn comes yet.
    units_ahead: UnitsAhead<'t>,
    /// The functions whose signatures are not read yet.
    fns_ahead: BTreeMap<usize, (usize, &'t tree::Function)>,
    activity_signatures: Vec<Signature>,
    overlay_ids: BTreeSet<usize>,
    mission_ids: BTreeSet<usize>,
    overrides: Vec<Override>,
    types: TypeTable,
    hir: Hir,
    scope: Scope,
    /// The tests of each module, by their names as those of files.
    tests_named: BTreeMap<(usize, String), Span>,
    /// What the mission of the last test reports.
    reports: Option<(usize, Rc<truth::Reports>)>,
    /// The test that is being checked, while its expectations are.
    test: Option<truth::TestScope>,
    findings: Vec<Diagnostic>,
    /// By the places of their names, where strategies that are derived stand, and where they name their bases.
    derived_strategies: BTreeMap<Span, (Span, Span)>,
    /// What is wrong with parts of a base where another strategy has them, or with a behavior by what it is given; where, and what to say.
    inherited_findings: Vec<(Diagnostic, Span, &'static str)>,
    /// What was declared, and what of it was read.
    names_used: unused::NamesUsed,
}

/// What checking gives.
pub struct Checked {
    /// The program, as far as it could be understood.
    pub hir: Hir,
    /// Its declared types.
    pub types: TypeTable,
    /// What was set from outside, and where it went.
    pub overrides: Vec<Override>,
    /// What is wrong with it.
    pub findings: Vec<Diagnostic>,
    /// What its names stand for.
    pub names: Names,
    /// Names that nobody uses. In a file with an error nobody can tell: what uses them may be what could not be understood.
    pub unused: Vec<Diagnostic>,
    /// The files of data that were read.
    pub files: Vec<Source>,
}

/// Checks all modules, where areas have room for so many corners.
pub fn check_with_room(modules: &[Module], library: &dyn Library, overrides: Vec<Override>, area_room: u32) -> Checked {
    let whole::Whole { modules, homes, baseless, findings } = whole::strategies(modules);
    let modules = modules.as_ref();
    let mut checker = Checker {
        modules,
        homes,
        baseless,
        library,
        files: BTreeMap::new(),
        holed: area_file::Holed::default(),
        names: modules.iter().map(|_| BTreeMap::new()).collect(),
        preludes_with: BTreeMap::new(),
        places: modules.iter().map(|_| BTreeMap::new()).collect(),
        import_places: modules.iter().map(|_| BTreeMap::new()).collect(),
        consts: Vec::new(),
        signals: Vec::new(),
        waiting: 0,
        parts_read: 0,
        clauses: Vec::new(),
        vehicles: Vec::new(),
        scenario_items: Vec::new(),
        vehicle_items: Vec::new(),
        scenario_lineage: Lineage::default(),
        fitted: Vec::new(),
        fn_signatures: Vec::new(),
        templates: capacities::Templates::default(),
        activity_templates: given_behaviors::ActivityTemplates::default(),
        nominal_findings: Vec::new(),
        units_ahead: UnitsAhead::default(),
        fns_ahead: BTreeMap::new(),
        activity_signatures: Vec::new(),
        overlay_ids: BTreeSet::new(),
        mission_ids: BTreeSet::new(),
        overrides,
        types: TypeTable::new(area_room),
        hir: Hir::default(),
        scope: Scope::new(0, Setting::Constant),
        tests_named: BTreeMap::new(),
        reports: None,
        test: None,
        findings,
        derived_strategies: BTreeMap::new(),
        inherited_findings: Vec::new(),
        names_used: unused::NamesUsed::default(),
    };
    checker.run();
    let unused = checker.unused_names();
    let files = checker.files_read();
    Checked {
        hir: checker.hir,
        types: checker.types,
        overrides: checker.overrides,
        findings: checker.findings,
        names: checker.names_used.into_names(),
        unused,
        files,
    }
}

impl<'t> Checker<'t> {
    fn report(&mut self, finding: Diagnostic) {
        self.findings.push(finding);
    }

    /// The name that was probably meant.
    fn nearest<'n>(&self, name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
        if self.findings.len() < HELPED_MAX { albacore_wording::nearest(name, known) } else { None }
    }

    /// "did you mean `x`?", or else what there is.
    fn suggestion<'n>(&self, name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<String> {
        if self.findings.len() < HELPED_MAX { albacore_wording::help(name, known) } else { None }
    }

    fn type_name(&self, ty: &Type) -> String {
        self.types.name(ty)
    }

    /// Works in another scope, and comes back.
    fn within<T>(&mut self, scope: Scope, work: impl FnOnce(&mut Self) -> T) -> (T, Scope) {
        let outer = std::mem::replace(&mut self.scope, scope);
        let result = work(self);
        (result, std::mem::replace(&mut self.scope, outer))
    }

    /// Works in a block: its names and what it learns are forgotten at its end, and so is what it changes.
    fn in_block<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let (visible, outside) = (self.scope.visible.len(), self.scope.facts.enter());
        let result = work(self);
        self.scope.visible.truncate(visible);
        self.scope.facts.leave(outside);
        result
    }

    /// Works on what is computed on later ticks too, or on others: nothing is known there of what can change by then.
    fn on_later_ticks<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.scope.facts.enter();
        self.time_passes();
        let result = work(self);
        self.scope.facts = before;
        result
    }

    /// Takes in what a test has shown.
    fn learn(&mut self, facts: Vec<facts::Fact>) {
        self.scope.facts.learn(facts, &self.scope.vars);
    }

    /// What is known when a condition holds, or when it does not.
    fn shown(&self, condition: &hir::Expr, holds: bool) -> Vec<facts::Fact> {
        facts::shown(condition, holds, &self.scope.vars)
    }

    /// Works where other temporal operators are allowed. They watch from the beginning of their condition: what is known there
    /// is what they know.
    fn with_temporal<T>(&mut self, temporal: Temporal, work: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.scope.temporal, temporal);
        let standing = std::mem::replace(&mut self.scope.standing, self.scope.facts.known());
        let result = work(self);
        self.scope.temporal = outer;
        self.scope.standing = standing;
        result
    }

    /// Works in another setting.
    fn with_setting<T>(&mut self, setting: Setting, work: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.scope.setting, setting);
        let result = work(self);
        self.scope.setting = outer;
        result
    }
}
