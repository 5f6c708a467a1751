//! A scenario as a person looks at it: every number in force, those of the library's defaults too, and a picture.

mod clause_formatter;
mod record;
mod samples;
mod view;

use crate::plan::PlanError;
use crate::scenario::{self, DEFAULTS};
use albacore_geometry::TangentFrame;
use albacore_lang::{Script, doc};
use albacore_sim::{Ground, Simulator};
use clause_formatter::ClauseFormatter;

/// A scenario, laid open.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Its name.
    pub name: String,
    /// The scenarios that it is like, the nearest first.
    pub bases: Vec<String>,
    /// What it says, in order, and after it what holds without being said.
    pub clauses: Vec<ShownClause>,
    /// Clauses of which there is none.
    pub absent: Vec<String>,
    /// Filaments alive when the run begins; none without a plume.
    pub filaments: Option<usize>,
    /// The world at the start of a run, as SVG.
    pub svg: String,
}

/// A clause and its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShownClause {
    /// Its name; of a value of another clause, both: `vehicle kinematic`.
    pub name: String,
    /// Why it is in force.
    pub source: ValueSource,
    /// Its parameters, their values (of an area each corner, of a list each item on a line), and why they have them.
    pub values: Vec<(String, String, ValueSource)>,
}

/// Why something is in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueSource {
    /// The scenario says it.
    Said,
    /// Nobody says it: it is so by default.
    Default,
    /// The recorded plume brings it.
    Record,
}

impl Shown {
    /// A scenario that the script knows, by its name, else the only one of its own or the one that its mission runs in; its
    /// picture is that of a seed.
    pub fn new(script: &Script, file: &str, wanted: Option<&str>, seed: u64) -> Result<Self, PlanError> {
        let wanted = chosen(script, file, wanted)?;
        let (lowered, understood) = scenario::named(script, &wanted, scenario::place_of(script, &wanted)?)?;
        let world = understood.world;
        let simulator = Simulator::new(&world, seed).map_err(|error| scenario::cannot_begin(&error))?;
        let mut clauses = Vec::new();
        let words = scenario::words(&lowered);
        let formatter = ClauseFormatter { words: &words, frame: lowered.origin.map(|origin| TangentFrame { origin }) };
        let mut played = world.instruments.played.iter();
        for clause in &lowered.clauses {
            formatter.push_clause(clause, "", ValueSource::Said, &mut clauses);
            match (clause.name.as_str(), clauses.last_mut()) {
                ("bottom_grid", Some(told)) => {
                    if let Ground::Grid(grid) = &world.environment.bottom.ground {
                        told.values.extend(formatter.survey(grid));
                    }
                }
                ("played", Some(told)) => {
                    // What is listed is told in few words too.
                    told.values.retain(|(name, _, source)| {
                        *source == ValueSource::Said && name != "times" && name != "values"
                    });
                    told.values.extend(played.next().into_iter().flat_map(samples::values));
                }
                ("recorded_plume", _) => record::push_recorded(&world, &formatter, &mut clauses),
                _ => {}
            }
        }
        let formatter = ClauseFormatter { words: &DEFAULTS.words, ..formatter };
        let mut absent = Vec::new();
        for name in clause_names() {
            match DEFAULTS.in_force(&name, &world) {
                _ if clauses.iter().any(|told| told.name == name) => {}
                Some(clause) => formatter.push_clause(clause, "", ValueSource::Default, &mut clauses),
                None => absent.push(name),
            }
        }
        let filaments = world.has_filaments().then(|| simulator.filaments().count());
        let svg = view::svg(&lowered.name, &world, &simulator, seed);
        Ok(Shown { name: lowered.name, bases: lowered.bases, clauses, absent, filaments, svg })
    }
}

/// The clauses of the standard library that stand on a line of their own, in order.
fn clause_names() -> impl Iterator<Item = String> {
    let everywhere = crate::standard_modules().filter(|module| crate::is_known_everywhere(module));
    let scripts = everywhere.filter_map(|module| crate::load_or_module(module.as_ref()).ok());
    let pages = scripts.filter_map(|script| script.sources.iter().next().and_then(doc::page));
    let declared = pages.flat_map(|page| page.declarations);
    declared.filter(|d| d.word == "clause" && d.result.is_none()).map(|d| d.name)
}

/// Which scenario of a script is meant.
fn chosen(script: &Script, file: &str, wanted: Option<&str>) -> Result<String, PlanError> {
    let own: Vec<&str> = script.own_scenarios().collect();
    let of_mission = || script.missions().find_map(|mission| mission.scenario.clone());
    let only = || if let [only] = own.as_slice() { Some((*only).to_string()) } else { None };
    wanted.map(str::to_string).or_else(only).or_else(of_mission).ok_or_else(|| {
        let help = format!("name it: `{file}#NAME`; there is {}", script.scenarios().collect::<Vec<_>>().join(", "));
        PlanError::Asked(format!("which scenario of `{file}` is to be shown?"), Some(help))
    })
}
