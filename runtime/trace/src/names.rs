//! What the numbers in events stand for: activities, rules, the seats of behaviors in their tables.

use albacore_program::{ActivityId, ActivityKind, Body, Entry, Program, Target};

/// The tables of a program, and where to find a behavior in them.
#[derive(Clone, Debug)]
pub struct Names {
    /// The program without its code.
    pub program: Program,
    /// Where each activity stands in a table: the strategy, and the index of its entry.
    seats: Vec<Option<(ActivityId, usize)>>,
}

impl Names {
    /// The names of a program.
    pub fn new(program: &Program) -> Self {
        let program = Program { ops: Vec::new(), ..program.clone() };
        let mut seats = vec![None; program.activities.len()];
        for (strategy, activity) in (0..).zip(&program.activities) {
            let Body::Table(table) = &activity.body else { continue };
            for (at, entry) in table.behaviors.iter().enumerate() {
                if let Some(seat) = seats.get_mut(entry.activity as usize) {
                    *seat = Some((strategy, at));
                }
            }
        }
        Names { program, seats }
    }

    /// Every switch that there can be, as it is printed.
    pub fn switch_labels(&self) -> impl Iterator<Item = String> {
        let behaviors = (0..).zip(&self.seats).filter(|(_, seat)| seat.is_some()).map(|(id, _)| id);
        behaviors.flat_map(move |id| {
            let exits = self.entry(id).map_or(&[][..], |entry| &entry.exits);
            exits.iter().map(move |exit| self.switch_label(id, exit.rule))
        })
    }

    /// What a rule does, as a reader of the table would say it: `find -> track_in`.
    pub fn switch_label(&self, from: ActivityId, rule: u32) -> String {
        let rule_of = self.program.rules.get(rule as usize);
        let to = match rule_of.map(|rule| rule.target) {
            Some(Target::Finish(_)) => "finish",
            Some(Target::Abort(_)) => "abort",
            Some(Target::Behavior(_)) => self.target(from, rule).map_or("?", |to| self.name(to)),
            None => "?",
        };
        let back = if rule_of.is_some_and(|rule| rule.back) { " then back" } else { "" };
        format!("{} -> {to}{back}", self.name(from))
    }

    /// The behavior that a rule enters from another.
    pub fn target(&self, from: ActivityId, rule: u32) -> Option<ActivityId> {
        let Target::Behavior(at) = self.program.rules.get(rule as usize)?.target else { return None };
        let (strategy, _) = (*self.seats.get(from as usize)?)?;
        Some(self.table_entry(strategy, at as usize)?.activity)
    }

    /// Where a behavior stands in its table.
    pub fn entry(&self, behavior: ActivityId) -> Option<&Entry> {
        let (strategy, at) = (*self.seats.get(behavior as usize)?)?;
        self.table_entry(strategy, at)
    }

    fn table_entry(&self, strategy: ActivityId, at: usize) -> Option<&Entry> {
        match &self.program.activities.get(strategy as usize)?.body {
            Body::Table(table) => table.behaviors.get(at),
            _ => None,
        }
    }

    /// Whether two behaviors are of one table.
    pub fn share_table(&self, a: ActivityId, b: ActivityId) -> bool {
        let strategy = |id: ActivityId| self.seats.get(id as usize).copied().flatten().map(|(strategy, _)| strategy);
        a != b && strategy(a).is_some() && strategy(a) == strategy(b)
    }

    /// An activity's name.
    pub fn name(&self, id: ActivityId) -> &str {
        self.program.activities.get(id as usize).map_or("?", |activity| &activity.name)
    }

    /// An activity's name, and that it is an overlay.
    pub fn titled(&self, id: ActivityId) -> String {
        if self.is_overlay(id) { format!("overlay {}", self.name(id)) } else { self.name(id).to_string() }
    }

    /// Whether an activity runs beside the chain rather than in it.
    pub fn is_overlay(&self, id: ActivityId) -> bool {
        is_overlay(&self.program, id)
    }

    /// What is asked of a payload.
    pub fn ask(&self, action: u32) -> &str {
        self.program.asks.get(action as usize).map_or("?", String::as_str)
    }

    /// An input's name.
    pub fn input(&self, id: u32) -> &str {
        self.program.inputs.get(id as usize).map_or("?", |input| &input.name)
    }
}

/// Whether an activity runs beside the chain rather than in it.
pub fn is_overlay(program: &Program, id: ActivityId) -> bool {
    use ActivityKind::{AmendsCourse, Beside, Sets};
    let kind = program.activities.get(id as usize).map(|activity| activity.kind);
    matches!(kind, Some(AmendsCourse | Beside | Sets(_)))
}

/// Whether an activity is an overlay, or a behavior in the table of one: what runs beside the chain.
pub fn runs_beside(program: &Program, id: ActivityId) -> bool {
    let table = |of: ActivityId| match &program.activities.get(of as usize)?.body {
        Body::Table(table) => Some(table),
        _ => None,
    };
    let is_in =
        |of: ActivityId| table(of).is_some_and(|table| table.behaviors.iter().any(|entry| entry.activity == id));
    is_overlay(program, id) || program.overlays.iter().any(|site| is_in(site.activity))
}
