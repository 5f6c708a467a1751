//! What is in force in a world though its scenario does not say it.

use crate::scenario;
use albacore_lang::source::Source;
use albacore_lang::{ScenarioClause, ScenarioProgram, doc};
use albacore_sim::Scenario;

/// What every world has, of the clauses that cannot be said without a number.
const NEEDED: [&str; 3] = [
    "flow(0 m/s toward 0 deg)",
    "bottom(from: 20 m, to: 20 m)",
    "vehicle(kinematic, start: point(north: 0 m, east: 0 m))",
];

/// The clauses of the standard library, as they are when nobody says them.
pub(super) struct Unsaid {
    /// Those that stand on a line of their own, in order.
    pub names: Vec<String>,
    /// The words that their arguments point into.
    pub words: Vec<f64>,
    /// Each as it is when it is given nothing, or what it needs.
    probe: Option<ScenarioProgram>,
}

impl Unsaid {
    /// Asks the library's own words, through the same steps as any scenario.
    pub fn read() -> Self {
        let everywhere = crate::standard_modules().filter(|module| crate::is_known_everywhere(module));
        let scripts = everywhere.filter_map(|module| crate::load_or_module(module.as_ref()).ok());
        let pages = scripts.filter_map(|script| script.sources.iter().next().and_then(doc::page));
        let declared: Vec<doc::Declaration> = pages.flat_map(|page| page.declarations).collect();
        let clauses = || declared.iter().filter(|d| d.word == "clause");
        // What needs no number can be left to itself; the kinds of other clauses may be left out.
        let kinds: Vec<&String> = clauses().filter_map(|d| d.result.as_ref()).collect();
        let alone = |d: &&doc::Declaration| d.params.iter().all(|p| p.default.is_some() || kinds.contains(&&p.ty));
        let alone = clauses().filter(alone).filter(|d| d.result.is_none()).map(|d| format!("{}()", d.name));
        let lines: String = alone.chain(NEEDED.map(String::from)).map(|line| format!("    {line}\n")).collect();
        let text = format!("scenario defaults {{\n{lines}}}\n");
        let script = crate::load_text(Source { name: "defaults.alb".into(), text: text.into() });
        let probe = script.scenario("defaults", None).and_then(Result::ok);
        let words = probe.as_ref().map_or_else(Vec::new, scenario::words);
        Unsaid { names: clauses().filter(|d| d.result.is_none()).map(|d| d.name.clone()).collect(), words, probe }
    }

    /// A clause as it is when nobody says it, if to say it so would change nothing of a world: then it is in force there.
    pub fn in_force(&self, name: &str, world: &Scenario) -> Option<&ScenarioClause> {
        let clause = self.probe.as_ref()?.clauses.iter().find(|clause| clause.name == name)?;
        scenario::changes_nothing(world, clause, &self.words).then_some(clause)
    }
}
