//! Coverage: which behaviors the runs of tests enter, and which of the transitions of their tables fire, by their places in the scripts.

use crate::files::is_standard;
use crate::recorders::covered::Covered;
use albacore_lang::Script;
use albacore_program::{Activity, ActivityKind, Body, Program, Table};
use serde::Serialize;
use std::collections::BTreeMap;

/// A place of a script: the name of the source, the line, and what is declared there.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Site {
    source: String,
    line: u32,
    name: String,
}

/// What tests have come to of the missions that they run.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    units: BTreeMap<Site, CoveredUnit>,
    /// The missions under which behaviors are counted that stand in no table: each is counted once.
    homes: BTreeMap<Site, Site>,
}

/// A mission, with the behaviors that it calls, a strategy with its table, or a behavior of the standard library.
#[derive(Clone, Debug, Serialize)]
pub struct CoveredUnit {
    /// `mission`, `strategy` or `behavior`.
    pub kind: &'static str,
    /// Its name.
    pub name: String,
    /// `file:line`.
    pub place: String,
    /// Whether it is of the standard library.
    #[serde(skip)]
    pub is_standard: bool,
    #[serde(skip)]
    behaviors: BTreeMap<Site, CoveredBehavior>,
    #[serde(skip)]
    transitions: BTreeMap<(Site, Site, String), CoveredTransition>,
}

/// A behavior or a strategy, and whether any run entered it.
#[derive(Clone, Debug, Serialize)]
pub struct CoveredBehavior {
    /// Its name.
    pub name: String,
    /// `file:line`.
    pub place: String,
    /// Whether it was entered.
    pub entered: bool,
}

/// A rule as it applies to one behavior, and whether it fired there in any run.
#[derive(Clone, Debug, Serialize)]
pub struct CoveredTransition {
    /// The behavior that it leaves.
    pub from: String,
    /// The rule, `-> lost on after 10 s`.
    pub rule: String,
    /// `file:line` of the rule.
    pub place: String,
    /// Whether it fired.
    pub fired: bool,
}

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// How many.
    pub count: u64,
    /// Of how many.
    pub of: u64,
}

impl Part {
    /// In tenths of a per cent, rounded down: of what is not whole it is never all. Of nothing it is all.
    pub fn per_mille(self) -> u64 {
        (self.count * 1000).checked_div(self.of).unwrap_or(1000)
    }

    /// Whether so many per cent are reached.
    pub fn reaches(self, percent: u64) -> bool {
        self.count * 100 >= percent * self.of
    }

    fn add(self, other: Part) -> Part {
        Part { count: self.count + other.count, of: self.of + other.of }
    }
}

impl CoveredUnit {
    /// Its behaviors, in the order in which they are written.
    pub fn behaviors(&self) -> impl Iterator<Item = &CoveredBehavior> {
        self.behaviors.values()
    }

    /// Its transitions, in the order in which the behaviors and their rules are written.
    pub fn transitions(&self) -> impl Iterator<Item = &CoveredTransition> {
        self.transitions.values()
    }

    /// How many of its behaviors were entered.
    pub fn entered(&self) -> Part {
        Part {
            count: self.behaviors().filter(|behavior| behavior.entered).count() as u64,
            of: self.behaviors.len() as u64,
        }
    }

    /// How many of its transitions fired.
    pub fn fired(&self) -> Part {
        Part {
            count: self.transitions().filter(|transition| transition.fired).count() as u64,
            of: self.transitions.len() as u64,
        }
    }
}

impl Coverage {
    /// Missions and strategies in which there is anything to count, in the order of their files and lines.
    pub fn units(&self) -> impl Iterator<Item = &CoveredUnit> {
        self.units.values().filter(|unit| !unit.behaviors.is_empty() || !unit.transitions.is_empty())
    }

    /// How many behaviors were entered and how many transitions fired, of those that are counted.
    pub fn total(&self, is_counted: impl Fn(&CoveredUnit) -> bool) -> (Part, Part) {
        let counted = self.units().filter(|unit| is_counted(unit));
        counted.fold(<(Part, Part)>::default(), |(entered, fired), unit| {
            (entered.add(unit.entered()), fired.add(unit.fired()))
        })
    }

    /// Adds what other runs have come to.
    pub fn add(&mut self, other: &Coverage) {
        for (site, unit) in &other.units {
            self.unit(site, unit);
            for (at, behavior) in &unit.behaviors {
                self.behavior(site, at, behavior.clone(), unit.kind == MISSION);
            }
            for (at, transition) in &unit.transitions {
                self.transition(site, at, transition.clone());
            }
        }
    }

    /// Adds what the runs of a program have come to together.
    pub(crate) fn add_runs(&mut self, script: &Script, program: &Program, runs: &Covered) {
        let sites = Sites::new(script);
        let behavior = |id: usize, activity: &Activity| CoveredBehavior {
            name: activity.name.clone(),
            place: activity.place.clone(),
            entered: runs.entered.contains(&(id as u32)),
        };
        let mut is_in_a_table = vec![false; program.activities.len()];
        for activity in &program.activities {
            let Body::Table(table) = &activity.body else { continue };
            let site = sites.site(&activity.place, &activity.name);
            self.unit(&site, &sites.unit(activity));
            for entry in &table.behaviors {
                let id = entry.activity as usize;
                if let Some(inner) = program.activities.get(id) {
                    is_in_a_table[id] = true;
                    self.behavior(&site, &sites.site(&inner.place, &inner.name), behavior(id, inner), false);
                }
            }
            self.table(&sites, &site, (program, table), runs);
        }
        let Some(mission) = program.activities.get(program.mission.activity as usize) else { return };
        let own = sites.site(&mission.place, &mission.name);
        self.unit(&own, &sites.unit(mission));
        for (id, activity) in program.activities.iter().enumerate() {
            if is_in_a_table[id] || !is_behavior(activity.kind) {
                continue;
            }
            let site = sites.site(&activity.place, &activity.name);
            // What the library calls by itself is counted with the library.
            let home = if sites.is_standard(&activity.place) { site.clone() } else { own.clone() };
            if home == site {
                self.unit(&home, &sites.unit(activity));
            }
            self.behavior(&home, &site, behavior(id, activity), home == own);
        }
    }

    fn table(&mut self, sites: &Sites, site: &Site, (program, table): (&Program, &Table), runs: &Covered) {
        for entry in &table.behaviors {
            let Some(from) = program.activities.get(entry.activity as usize) else { continue };
            let left = sites.site(&from.place, &from.name);
            for (exit, rule) in (0..).zip(entry.exits.iter().map(|exit| program.rules.get(exit.rule as usize))) {
                let Some(rule) = rule else { continue };
                let at = sites.site(&rule.place, "");
                let transition = CoveredTransition {
                    from: from.name.clone(),
                    rule: rule.text.clone(),
                    place: rule.place.clone(),
                    fired: runs.fired.contains(&(entry.activity, exit)),
                };
                self.transition(site, &(left.clone(), at, rule.text.clone()), transition);
            }
        }
    }

    fn unit(&mut self, site: &Site, unit: &CoveredUnit) {
        let empty = || CoveredUnit { behaviors: BTreeMap::new(), transitions: BTreeMap::new(), ..unit.clone() };
        self.units.entry(site.clone()).or_insert_with(empty);
    }

    fn behavior(&mut self, unit: &Site, at: &Site, behavior: CoveredBehavior, is_called: bool) {
        let home = if is_called { self.homes.entry(at.clone()).or_insert_with(|| unit.clone()) } else { unit };
        let Some(unit) = self.units.get_mut(home) else { return };
        let entered = behavior.entered;
        unit.behaviors.entry(at.clone()).or_insert(behavior).entered |= entered;
    }

    fn transition(&mut self, unit: &Site, at: &(Site, Site, String), transition: CoveredTransition) {
        let Some(unit) = self.units.get_mut(unit) else { return };
        let fired = transition.fired;
        unit.transitions.entry(at.clone()).or_insert(transition).fired |= fired;
    }
}

/// Whether a script is a module of the standard library.
pub fn is_of_library(script: &Script) -> bool {
    script.sources.iter().next().is_some_and(is_standard)
}

const MISSION: &str = "mission";
const STRATEGY: &str = "strategy";
const BEHAVIOR: &str = "behavior";

/// Whether an activity is a behavior to who writes tests. Overlays are put on with what wears them, and a recovery is no behavior.
fn is_behavior(kind: ActivityKind) -> bool {
    match kind {
        ActivityKind::Behavior | ActivityKind::Strategy | ActivityKind::Override => true,
        ActivityKind::AmendsCourse
        | ActivityKind::Beside
        | ActivityKind::Sets(_)
        | ActivityKind::Mission
        | ActivityKind::Recovery => false,
    }
}

/// Where the places of a program lie: they have no folders, and a source's name has.
struct Sites {
    /// The sources by their names without folders, and whether each is of the standard library.
    sources: BTreeMap<String, (String, bool)>,
}

impl Sites {
    fn new(script: &Script) -> Self {
        let mut sources: BTreeMap<String, (String, bool)> = BTreeMap::new();
        for source in script.sources.iter() {
            let file = source.name.rsplit(['/', '\\']).next().unwrap_or_default();
            let is_standard = is_standard(source);
            // A file of the project hides a module of the library.
            match sources.get(file) {
                Some((_, false)) => {}
                _ => _ = sources.insert(file.to_string(), (source.name.to_string(), is_standard)),
            }
        }
        Sites { sources }
    }

    fn site(&self, place: &str, name: &str) -> Site {
        let (file, line) = place.rsplit_once(':').unwrap_or((place, ""));
        let source = self.sources.get(file).map_or(file, |(source, _)| source);
        Site { source: source.to_string(), line: line.parse().unwrap_or(0), name: name.to_string() }
    }

    fn is_standard(&self, place: &str) -> bool {
        let file = place.rsplit_once(':').map_or(place, |(file, _)| file);
        self.sources.get(file).is_some_and(|(_, is_standard)| *is_standard)
    }

    fn unit(&self, activity: &Activity) -> CoveredUnit {
        CoveredUnit {
            kind: match activity.kind {
                ActivityKind::Mission => MISSION,
                ActivityKind::Strategy => STRATEGY,
                _ => BEHAVIOR,
            },
            name: activity.name.clone(),
            place: activity.place.clone(),
            is_standard: self.is_standard(&activity.place),
            behaviors: BTreeMap::new(),
            transitions: BTreeMap::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Part;

    #[test]
    fn what_is_not_whole_is_never_all() {
        let part = |count, of| Part { count, of };
        assert_eq!(part(1999, 2000).per_mille(), 999);
        assert!(!part(1999, 2000).reaches(100) && part(2000, 2000).reaches(100));
        assert!(part(4, 5).reaches(80) && !part(4, 5).reaches(81));
        assert_eq!(part(0, 0).per_mille(), 1000);
        assert!(part(0, 0).reaches(100), "nothing is missing of nothing");
    }
}
