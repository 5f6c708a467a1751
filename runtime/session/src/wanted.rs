//! What of a script is wanted, and what is changed for it.

use albacore_lang::Where;

/// What of a script is wanted, and what is changed for it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// The mission; else the one named like the file, else the only one.
    pub mission: Option<&'a str>,
    /// The scenario, by its name or as `file.alb#name`; else the mission's own.
    pub scenario: Option<&'a str>,
    /// Parameters that are changed: `lambda=6s` of the mission or its scenario, `cpt_2005.beta=30deg` of a declaration.
    pub set: &'a [String],
}

impl Wanted<'_> {
    /// The changes of the script itself, and those of a scenario that lies in another file: `name.parameter=value`.
    pub(crate) fn parted(&self) -> (Vec<String>, Vec<String>) {
        let elsewhere = self.scenario.and_then(|scenario| scenario.split_once('#'));
        let is_elsewhere = |text: &String| {
            let owner = text.split('=').next().and_then(|place| place.trim().rsplit_once('.'));
            owner.map(|(owner, _)| owner) == elsewhere.map(|(_, name)| name) && elsewhere.is_some()
        };
        let (other, own) = self.set.iter().cloned().partition(is_elsewhere);
        (own, other)
    }

    /// The same for a script that is read: `own` are the changes of [`Wanted::parted`].
    pub(crate) fn of_script<'b>(&'b self, own: &'b [String]) -> albacore_lang::Wanted<'b> {
        let scenario = match self.scenario {
            None => Where::Own,
            Some(name) if name.contains('#') => Where::Elsewhere,
            Some(name) => Where::Named(name),
        };
        albacore_lang::Wanted { mission: self.mission, scenario, set: own }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_of_a_scenario_elsewhere_go_there() {
        let set = ["depth=3m", "cold.layer=3.5 m", "cpt.beta=30deg", " cold.age = 1 h"].map(String::from);
        let wanted = Wanted { scenario: Some("worlds.alb#cold"), set: &set, ..Wanted::default() };
        let (own, other) = wanted.parted();
        assert_eq!(own, ["depth=3m", "cpt.beta=30deg"]);
        assert_eq!(other, ["cold.layer=3.5 m", " cold.age = 1 h"]);
        assert_eq!(Wanted { scenario: Some("cold"), ..wanted }.parted().0, set, "it is in the script itself");
    }
}
