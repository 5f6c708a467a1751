//! Source text to checked program. Pure: no files, no clock, no vehicle.
//!
//! [`load`] reads a file and all it imports (`syntax`), checks them (`check`: names, types, dimensions, rules), and gives a
//! [`Script`], from which missions and scenarios are lowered (`lower`) to what the machine executes.

mod broken;
mod cascade;
mod check;
pub mod cost;
pub mod diagram;
pub mod dimension;
pub mod hir;
mod loader;
mod lower;
pub mod names;
mod prelude;
pub mod prompt;
mod rules;
pub mod types;

pub use albacore_syntax as syntax;
pub use albacore_syntax::{code, diagnostic, doc, fmt, source};
pub use lower::{
    ExpectProgram, NamedValue, RowProgram, SAME_PLANE_M, ScenarioArg, ScenarioClause, ScenarioProgram, ScenarioValue,
    TestProgram, TestSlots,
};
pub use prelude::Prelude;
pub use rules::{FAR_M, hemisphere};

use crate::code::Code;
pub use albacore_formats::FileFault;
use albacore_geometry::Geodetic;
use albacore_program::{Channel, Program, Shape};
use broken::Broken;
use cascade::Cascades;
use check::{Checked, Override};
use cost::Cost;
use diagnostic::Diagnostic;
use loader::{Loader, module_name};
use rules::RunIn;
use source::{FileId, Source, Sources, Span};
use std::collections::BTreeMap;
use syntax::tree::{self, ActivityKind, Item};

/// Where imported modules come from.
pub trait Library {
    /// The modules whose names every script knows.
    fn prelude(&self) -> &Prelude;
    /// The module that `use a.b` in a file means; else a message that names what exists.
    fn module(&self, importer: &Source, path: &[String]) -> Result<Source, String>;
    /// The bytes of a file of the project that holds data, `bytes_max` of them at most. Its path counts from the project's
    /// folder, and does not lead out of it.
    fn data_file(&self, path: &str, bytes_max: u64) -> Result<Vec<u8>, FileFault>;
}

/// A mission of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissionInfo {
    /// Its name.
    pub name: String,
    /// The scenario that it names.
    pub scenario: Option<String>,
}

/// A script with all it imports, read and checked.
pub struct Script {
    /// The sources, the script's own file first.
    pub sources: Sources,
    /// What is wrong, in source order.
    pub findings: Vec<Diagnostic>,
    hir: hir::Hir,
    types: types::TypeTable,
    missions: Vec<(MissionInfo, usize)>,
    /// Where missions stand among these, and scenarios among all, by their names.
    mission_places: BTreeMap<String, usize>,
    scenario_ids: BTreeMap<String, usize>,
    names: names::Names,
    overrides: Vec<Override>,
    broken: Broken,
}

/// What of a script is meant, and changed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// The mission, when there are several.
    pub mission: Option<&'a str>,
    /// The scenario.
    pub scenario: Where<'a>,
    /// Parameters that are changed: `lambda=6s` of the mission or its scenario, `cpt_2005.beta=30deg` of a declaration.
    pub set: &'a [String],
}

/// The scenario that is meant.
#[derive(Clone, Copy, Debug, Default)]
pub enum Where<'a> {
    /// The mission's own.
    #[default]
    Own,
    /// Another one that the script knows.
    Named(&'a str),
    /// One of another script, where its parameters are changed.
    Elsewhere,
}

/// Reads and checks a script, with what is wanted of it.
pub fn load_for(entry: Source, library: &dyn Library, wanted: &Wanted) -> Script {
    let mut loader = Loader::new(library);
    loader.read_all(entry);
    finish(&mut loader, wanted)
}

/// The same for a mission in its own scenario.
pub fn load(entry: Source, library: &dyn Library, mission: Option<&str>, set: &[String]) -> Script {
    load_for(entry, library, &Wanted { mission, set, ..Wanted::default() })
}

/// Checks what was read.
fn finish(loader: &mut Loader, wanted: &Wanted) -> Script {
    let Loader { sources, modules, unread, .. } = loader;
    let mut findings = std::mem::take(&mut loader.findings);
    let main = &modules[MAIN].tree;
    let chosen = chosen_mission(main, &sources.get(ENTRY).name.clone(), wanted.mission);
    let overrides = overrides(sources, wanted, main, chosen.as_ref(), &mut findings);
    let checked = check::check(modules, loader.library, overrides.clone());
    let echoes = Cascades::of(unread, sources);
    let later = checked.findings.into_iter().filter(|f| !echoes.holds_back(f, sources));
    let declared_below = |finding| declared_below(finding, sources, &modules[MAIN].tree, &checked.names);
    findings.extend(later.enumerate().map(|(before, finding)| match before < check::HELPED_MAX {
        true => declared_below(missing_use(finding, sources, loader.library)),
        false => finding,
    }));
    for file in checked.files {
        sources.add(file);
    }
    let of_missions = checked.hir.activities.iter().enumerate().filter(|(_, a)| a.kind == hir::Kind::Mission);
    // The first of a name: a second is an error.
    let all_missions: BTreeMap<&str, usize> = of_missions.rev().map(|(id, a)| (a.full_name.as_str(), id)).collect();
    let mut missions = Vec::new();
    for item in &main.items {
        if let Item::Activity(a) = item
            && let ActivityKind::Mission { scenario, .. } = &a.kind
        {
            let info = MissionInfo { name: a.name.node.clone(), scenario: scenario.as_ref().map(tree::Path::text) };
            let id = all_missions.get(info.name.as_str());
            missions.extend(id.map(|id| (info, *id)));
        }
    }
    let is_error = |f: &&Diagnostic| f.severity == diagnostic::Severity::Error;
    let errors: Vec<Span> = findings.iter().filter(is_error).map(Diagnostic::span).collect();
    findings.extend(checked.unused.into_iter().filter(|f| !errors.iter().any(|e| e.file == f.span().file)));
    // A mission is looked at as a whole when its parts are sound: half-understood parts would be found wanting twice.
    let mut broken = Broken::of(modules, &errors, &checked.hir);
    // The first of a name: a script's own come before those that every script knows.
    let scenarios = checked.hir.scenarios.iter().enumerate().rev();
    let scenario_ids: BTreeMap<String, usize> = scenarios.map(|(id, scenario)| (scenario.path.clone(), id)).collect();
    let scenario = |name: &String| scenario_ids.get(name).map(|id| &checked.hir.scenarios[*id]);
    let with_scenarios: Vec<_> =
        missions.iter().map(|(info, id)| (*id, info.scenario.as_ref().and_then(scenario))).collect();
    if let Some(too_much) = cost::together::check(&checked.hir, ENTRY, &with_scenarios) {
        findings.push(too_much);
        broken.everywhere = true;
    }
    findings.extend(of_sound_parts(&checked.hir, &checked.types, &broken, missions.iter().map(|(_, id)| *id)));
    let meant: Vec<usize> = missions
        .iter()
        .filter(|(info, _)| chosen.as_ref().is_none_or(|chosen| chosen.name.node == info.name))
        .map(|(_, id)| *id)
        .collect();
    let of_chosen = || missions.iter().find(|(info, _)| chosen.as_ref().is_some_and(|c| c.name.node == info.name));
    let run_in = match wanted.scenario {
        Where::Named(name) => scenario_ids.get(name).map(|id| RunIn::One(*id)),
        Where::Own => of_chosen().and_then(|(info, _)| Some(RunIn::One(*scenario_ids.get(info.scenario.as_ref()?)?))),
        Where::Elsewhere => Some(RunIn::Elsewhere),
    };
    let unreached = rules::overrides(&checked.hir, &meant, run_in, &checked.overrides).into_iter();
    // A value that is wrong has been told of: that it would change nothing is no second mistake.
    findings.extend(unreached.filter(|f| is_error(&f) || !errors.iter().any(|e| e.file == f.span().file)));
    diagnostic::settle(&mut findings);
    let mission_places = missions.iter().enumerate().map(|(i, (info, _))| (info.name.clone(), i)).collect();
    let Checked { hir, types, names, .. } = checked;
    Script {
        sources: sources.clone(),
        findings,
        hir,
        types,
        missions,
        mission_places,
        scenario_ids,
        names,
        overrides,
        broken,
    }
}

/// What the rules for whole missions, tables and tests find in those of the script's own file that have no error.
fn of_sound_parts(
    hir: &hir::Hir,
    types: &types::TypeTable,
    broken: &Broken,
    missions: impl Iterator<Item = usize>,
) -> Vec<Diagnostic> {
    let of_missions = missions.filter(|id| !broken.reaches(*id)).flat_map(|id| rules::check(hir, types, id));
    let own = |id: &usize| hir.activities[*id].span.file == ENTRY && !broken.reaches(*id);
    let of_tables = (0..hir.activities.len()).filter(own).flat_map(|id| rules::livelocks(hir, id));
    let tests = hir.tests.iter().filter(|test| test.span.file == ENTRY && !broken.reaches(test.mission));
    let of_tests = tests.flat_map(|test| rules::tests_reports(hir, test));
    of_missions.chain(of_tables).chain(of_tests).collect()
}

impl Script {
    /// Whether it can run.
    pub fn is_sound(&self) -> bool {
        self.findings.iter().all(|f| f.severity != diagnostic::Severity::Error)
    }

    /// What is worth knowing and nothing wrong: rules of the script's own file that can hold in the same tick.
    pub fn notes(&self) -> Vec<Diagnostic> {
        let own = |id: &usize| self.hir.activities[*id].span.file == ENTRY && !self.broken.reaches(*id);
        (0..self.hir.activities.len()).filter(own).flat_map(|id| rules::overlaps(&self.hir, id)).collect()
    }

    /// Whether a mission has no error, nor anything that it calls: it can be looked at although others have some.
    pub fn mission_is_sound(&self, name: &str) -> bool {
        self.mission_id(name).is_some_and(|id| !self.broken.reaches(id))
    }

    /// Whether a scenario has no error.
    pub fn scenario_is_sound(&self, name: &str) -> bool {
        self.scenario_ids.get(name).is_some_and(|id| {
            let scenarios = &self.hir.scenarios;
            let mut lineage = std::iter::successors(Some(*id), |id| scenarios[*id].base);
            !lineage.any(|id| self.broken.holds(scenarios[id].span))
        })
    }

    /// The names that the script and its modules declare, and where each is used.
    pub fn names(&self) -> &names::Names {
        &self.names
    }

    /// The missions of the script's own file.
    pub fn missions(&self) -> impl Iterator<Item = &MissionInfo> {
        self.missions.iter().map(|(info, _)| info)
    }

    /// The scenarios that the script knows, by the names that it calls them.
    pub fn scenarios(&self) -> impl Iterator<Item = &str> {
        self.scenario_ids.keys().map(String::as_str)
    }

    /// The scenarios of the script's own file.
    pub fn own_scenarios(&self) -> impl Iterator<Item = &str> {
        self.hir.scenarios.iter().filter(|s| s.span.file == ENTRY).map(|s| s.name.as_str())
    }

    fn named_mission(&self, name: &str) -> Option<&(MissionInfo, hir::ActivityId)> {
        self.missions.get(*self.mission_places.get(name)?)
    }

    fn mission_id(&self, name: &str) -> Option<hir::ActivityId> {
        self.named_mission(name).map(|(_, id)| *id)
    }

    /// The scenario that a mission names as its own.
    pub fn own_scenario(&self, mission: &str) -> Option<&str> {
        self.named_mission(mission)?.0.scenario.as_deref()
    }

    /// The area of a mission, in its local frame, and where it is written; none where it is not made of constants.
    pub fn operating_area(&self, mission: &str) -> Option<(albacore_geometry::Area, source::Span)> {
        let id = self.mission_id(mission)?;
        rules::operating_area(&self.hir, id)
    }

    /// The finding for a mission whose area is of a file that has the latitude first, as far as places of its scenario show it.
    pub fn swapped_area(&self, mission: &str, places: &[Geodetic]) -> Option<Diagnostic> {
        let id = self.mission_id(mission)?;
        rules::swapped(&self.hir, id, places)
    }

    /// The inputs that a mission requires, each with the place where it says so.
    pub fn requirements(&self, mission: &str) -> Vec<(&str, source::Span)> {
        self.requires(mission).map(|require| (self.hir.inputs[require.input].name.as_str(), require.span)).collect()
    }

    /// Those of them for whose first sample the mission waits before it begins.
    pub fn awaited(&self, mission: &str) -> Vec<(&str, source::Span)> {
        let awaited = self.requires(mission).filter(|require| require.at_first.is_none());
        awaited.map(|require| (self.hir.inputs[require.input].name.as_str(), require.span)).collect()
    }

    fn requires(&self, mission: &str) -> impl Iterator<Item = &hir::Require> {
        let parts = self.mission_id(mission).and_then(|id| self.hir.activities[id].mission.as_ref());
        parts.into_iter().flat_map(|parts| &parts.requires)
    }

    /// The inputs that a mission records, each with the place where it says so first.
    pub fn recorded(&self, mission: &str) -> Vec<(&str, source::Span)> {
        let recorded = self.mission_id(mission).map(|id| rules::inputs_recorded(&self.hir, id)).unwrap_or_default();
        recorded.into_iter().map(|(input, span)| (self.hir.inputs[input].name.as_str(), span)).collect()
    }

    /// The shape of an input, and of its further fields by their labels.
    pub fn input_shapes(&self, name: &str) -> Option<(Shape, Vec<(&str, Shape)>)> {
        let input = self.hir.inputs.iter().find(|input| input.name == name)?;
        let fields = input.fields.iter().map(|(label, ty)| (label.as_str(), self.types.shape(ty)));
        Some((self.types.shape(&input.ty), fields.collect()))
    }

    /// What a mission asks of payloads, such as `camera.start`, each with the place where it does so first.
    pub fn asked(&self, mission: &str) -> Vec<(String, source::Span)> {
        self.mission_id(mission).map(|id| self.hir.asks(id)).unwrap_or_default().into_iter().collect()
    }

    /// For how many corners its areas have room.
    pub(crate) fn area_room(&self) -> u32 {
        self.types.area_room
    }

    /// The checked program, its types, and where a mission stands in it.
    pub fn checked(&self, mission: &str) -> Option<(&hir::Hir, &types::TypeTable, hir::ActivityId)> {
        let id = self.mission_id(mission)?;
        Some((&self.hir, &self.types, id))
    }

    /// A mission, ready for the machine.
    pub fn mission(&self, name: &str) -> Option<Result<Program, Vec<Diagnostic>>> {
        let id = self.mission_id(name)?;
        Some(lower::mission(&self.hir, &self.types, &self.sources, id))
    }

    /// What a mission costs.
    pub fn cost(&self, name: &str) -> Option<Result<Cost, Vec<Diagnostic>>> {
        let id = self.mission_id(name)?;
        Some(cost::of(&self.hir, &self.types, &self.sources, id))
    }

    /// The tests of the script's own file, ready to run.
    pub fn tests(&self) -> Vec<Result<TestProgram, Vec<Diagnostic>>> {
        let own = (0..self.hir.tests.len()).filter(|&i| self.hir.tests[i].span.file == ENTRY);
        own.map(|i| lower::test(&self.hir, &self.types, &self.sources, i)).collect()
    }

    /// A scenario, ready to be computed, in the frame about `origin`.
    pub fn scenario(&self, name: &str, origin: Option<Geodetic>) -> Option<Result<ScenarioProgram, Vec<Diagnostic>>> {
        let id = self.scenario_ids.get(name)?;
        Some(lower::scenario(&self.hir, &self.types, &self.sources, *id, origin))
    }
}

/// A name that stands before its declaration in the same activity.
fn declared_below(finding: Diagnostic, sources: &Sources, main: &tree::File, names: &names::Names) -> Diagnostic {
    let span = finding.span();
    if finding.code != Code::NamesUnknown || finding.help.is_some() {
        return finding;
    }
    let name = sources.text(span);
    let around = main.items.iter().find_map(|item| match item {
        Item::Activity(a) if a.body.span.holds(span) => Some(a.body.span),
        _ => None,
    });
    let is_below = |place: Span| place.start > span.end && around.is_some_and(|around| around.holds(place));
    let below = names.definitions().find(|(place, definition)| definition.name == name && is_below(*place));
    match below {
        Some((place, _)) => finding.label(place, "declared here").help("a declaration is known behind it: move it up"),
        None => finding,
    }
}

/// `maneuver.bowtie(…)` where nothing is named `maneuver`: there may be such a module to import.
fn missing_use(finding: Diagnostic, sources: &Sources, library: &dyn Library) -> Diagnostic {
    let span = finding.span();
    let source = sources.get(span.file);
    let is_head = source.text.get(span.end as usize..).is_some_and(|after| after.starts_with('.'));
    let name = sources.text(span);
    if finding.code != Code::NamesUnknown || !is_head {
        return finding;
    }
    if library.module(source, &[name.to_string()]).is_ok() {
        let help = format!("write `use {name}` at the top of the file");
        return finding.help(help);
    }
    if finding.help.is_none() {
        finding.help("before a dot stands a value, or a module that `use` names")
    } else {
        finding
    }
}

/// The mission that is meant: the one asked for, else the one named like the file, else the only one.
fn chosen_mission(tree: &tree::File, file: &str, asked: Option<&str>) -> Option<tree::Activity> {
    let missions: Vec<&tree::Activity> = tree
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Activity(a) if matches!(a.kind, ActivityKind::Mission { .. }) => Some(a),
            _ => None,
        })
        .collect();
    let by_name = |name: &str| missions.iter().find(|m| m.name.node == name);
    match asked {
        Some(name) => by_name(name).copied().cloned(),
        None => by_name(&module_name(file))
            .copied()
            .or(if missions.len() == 1 { missions.first().copied() } else { None })
            .cloned(),
    }
}

/// Reads `--set` texts, each as a source of its own, so that messages can point into it.
fn overrides(
    sources: &mut Sources,
    wanted: &Wanted,
    main: &tree::File,
    mission: Option<&tree::Activity>,
    findings: &mut Vec<Diagnostic>,
) -> Vec<Override> {
    let mut overrides = Vec::new();
    for text in wanted.set {
        let source = Source { name: format!("--set {text}").into(), text: text.as_str().into() };
        let Some((place, value)) = text.split_once('=') else {
            let file = sources.add(source);
            let span = Span { file, start: 0, end: text.len() as u32 };
            findings.push(
                Diagnostic::error(Code::SetForm, span, "`--set` takes NAME=VALUE")
                    .help("for example `--set lambda=6s`"),
            );
            continue;
        };
        // The value keeps its place in the text: what stands before it becomes blanks.
        let blanked = format!("{}{value}", " ".repeat(place.len() + 1));
        let file = sources.add(source);
        match syntax::parse_expression(file, &blanked) {
            Ok(value) => {
                let (declarations, param) = match place.trim().rsplit_once('.') {
                    Some((declaration, param)) => (vec![declaration.to_string()], param.to_string()),
                    None => (owners_of(place.trim(), wanted, main, mission), place.trim().to_string()),
                };
                let place = Span { file, start: 0, end: place.trim_end().len() as u32 };
                overrides.push(Override { declarations, param, place, value, found: None });
            }
            Err(finding) => findings.push(finding),
        }
    }
    overrides
}

/// A plain name is a parameter of the mission, or else of the scenario that it runs in; in a script without missions of the
/// only scenario.
fn owners_of(param: &str, wanted: &Wanted, main: &tree::File, mission: Option<&tree::Activity>) -> Vec<String> {
    let own = mission.and_then(|mission| match &mission.kind {
        ActivityKind::Mission { scenario: Some(path), .. } => Some(path.text()),
        _ => None,
    });
    let scenario = match wanted.scenario {
        Where::Named(name) => Some(name.to_string()),
        Where::Own if mission.is_none() => only_scenario(main),
        Where::Own => own,
        Where::Elsewhere => None,
    };
    let has_it = mission.is_some_and(|mission| mission.params.iter().any(|p| p.name.node == param));
    let mission = mission.map(|mission| mission.name.node.clone());
    mission.into_iter().chain(scenario.filter(|_| !has_it)).collect()
}

fn only_scenario(main: &tree::File) -> Option<String> {
    let mut scenarios = main.items.iter().filter_map(|item| match item {
        Item::Scenario { name, .. } => Some(name.node.clone()),
        _ => None,
    });
    scenarios.next().filter(|_| scenarios.next().is_none())
}

/// The file that is run is always the first.
pub const ENTRY: FileId = FileId(0);
/// And so is its module.
const MAIN: usize = 0;

/// Whether a word names a setpoint, as `depth` in `at depth 3 m`.
pub fn is_setpoint(word: &str) -> bool {
    Channel::named(word).is_some()
}
