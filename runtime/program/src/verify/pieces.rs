//! Where the machine begins to execute.

use crate::{Activity, Addr, Body, Code, ListOp, Op, Program, Target, Terms, WatchedCode};
use std::collections::BTreeSet;

impl Program {
    /// Every piece of code that is executed on its own but the effects of rules, which follow on their guards.
    pub(super) fn pieces(&self) -> BTreeSet<Addr> {
        let mission = &self.mission;
        let limits = &mission.limits;
        let mut codes: Vec<Option<Code>> = vec![
            mission.within,
            limits.turn_rate_max,
            limits.latency_max,
            mission.recovery.and_then(|recovery| recovery.within),
        ];
        codes.extend(limits.setpoints.iter().flat_map(|bounds| [bounds.least, bounds.greatest]));
        for require in &mission.requires {
            codes.extend([Some(require.fresh), require.at_first, require.hold_for]);
        }
        let mut pieces: BTreeSet<Addr> = codes.into_iter().flatten().map(|code| code.entry).collect();
        pieces.insert(mission.params);
        self.activities.iter().for_each(|activity| pieces_of(activity, &mut pieces));
        for op in &self.ops {
            match *op {
                Op::Call { code, .. } => _ = pieces.insert(code),
                Op::List(ListOp::Sort { key, .. }) => _ = pieces.insert(key),
                Op::List(ListOp::PushSorted { sort, .. }) => _ = pieces.insert(sort),
                _ => {}
            }
        }
        pieces
    }

    /// What follows on the guard of a rule: its effect, and what the strategy finishes with.
    pub(super) fn follow(&self, rule: u32) -> impl Iterator<Item = Addr> {
        let rule = self.rules.get(rule as usize);
        let finish = rule.and_then(|rule| match rule.target {
            Target::Finish(code) => code,
            _ => None,
        });
        rule.and_then(|rule| rule.effect).into_iter().chain(finish)
    }
}

fn pieces_of(activity: &Activity, pieces: &mut BTreeSet<Addr>) {
    pieces.extend([activity.entry, activity.refresh, activity.reactions]);
    for abort in &activity.aborts {
        pieces.insert(abort.condition.entry);
        pieces.extend(told(&abort.watched, &abort.terms));
    }
    match &activity.body {
        Body::Sequence(at) => _ = pieces.insert(*at),
        Body::Amend { amended, .. } => _ = pieces.insert(amended.entry),
        Body::Table(table) => {
            for behavior in &table.behaviors {
                pieces.extend([behavior.arm, behavior.watch]);
                for exit in &behavior.exits {
                    pieces.extend(told(&exit.watched, &exit.terms).chain(told(&[], &exit.terms_done)));
                }
            }
        }
    }
}

/// What is only told of a condition.
fn told<'a>(watched: &'a [WatchedCode], terms: &'a Option<Terms>) -> impl Iterator<Item = Addr> + 'a {
    watched.iter().map(|watched| watched.code.entry).chain(terms.iter().map(|terms| terms.code.entry))
}
