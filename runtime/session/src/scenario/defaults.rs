//! What is in force in a world though its scenario does not say it: a scenario of the standard library says that.

use super::{Clause, read, words};
use crate::files::{Files, load_library};
use crate::scenario::Understood;
use albacore_lang::{ScenarioClause, ScenarioProgram};
use albacore_sim::Scenario;
use std::path::Path;
use std::sync::LazyLock;

/// Its name.
const NAME: &str = "still_water";

/// What every world has.
pub(crate) struct Defaults {
    said: Option<ScenarioProgram>,
    /// The words that its arguments point into.
    pub words: Vec<f64>,
    /// The world that it makes.
    pub world: Scenario,
}

/// It is the same in every run, and read once.
pub(crate) static DEFAULTS: LazyLock<Defaults> = LazyLock::new(|| {
    let said = load_library(NAME, &[]).scenario(NAME, None).and_then(Result::ok);
    let words = said.as_ref().map_or_else(Vec::new, words);
    let mut understood = Understood { world: Scenario::default(), dialect: None, files: Vec::new() };
    let files = Files::around(Path::new(""));
    for clause in said.iter().flat_map(|said| &said.clauses) {
        let read = read(&mut understood, Clause { clause, words: &words }, &files, None);
        debug_assert!(read.is_ok(), "the standard library's own `{}`", clause.name);
    }
    Defaults { said, words, world: understood.world }
});

impl Defaults {
    /// A clause of it, if to say it so would change nothing of a world that has a use for it: then it is in force there.
    pub fn in_force(&self, name: &str, world: &Scenario) -> Option<&ScenarioClause> {
        let clause = self.said.as_ref()?.clauses.iter().find(|clause| clause.name == name)?;
        let mut said = Understood { world: world.clone(), dialect: None, files: Vec::new() };
        let read = read(&mut said, Clause { clause, words: &self.words }, &Files::around(Path::new("")), None);
        (read.is_ok() && said.world == *world && world.instruments.uses(name)).then_some(clause)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the simulator's own tests begin from is what scripts begin from.
    #[test]
    fn what_nobody_says_is_the_simulators_own_default() {
        assert!(DEFAULTS.said.is_some());
        assert_eq!(DEFAULTS.world, Scenario::default());
    }
}
