//! What the missions and tests of a script are together. Each is checked and compiled with all that it calls, however many share
//! it: work that grows with their number times what they share.

use super::grouped;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{ActivityId, ClauseArg, ClauseUse, Expr, ExprKind, FnId, Hir, Scenario, Test};
use crate::source::FileId;
use std::collections::BTreeSet;

/// The parts of all that they reach, each counted for every one of them. Some seconds of work.
pub const TOGETHER_MAX: usize = 4_000_000;

/// The finding for a script whose missions, each with the scenario that it names, and tests are more.
pub(crate) fn check(hir: &Hir, script: FileId, missions: &[(ActivityId, Option<&Scenario>)]) -> Option<Diagnostic> {
    let mut known = Known { activities: vec![None; hir.activities.len()], fns: vec![None; hir.fns.len()] };
    let mut sum = 0_usize;
    let mut over = |parts: usize| {
        sum = sum.saturating_add(parts);
        sum > TOGETHER_MAX
    };
    let in_scenario = |scenario: Option<&Scenario>| scenario.map_or(0, |s| s.clauses.iter().map(of_clause).sum());
    let own_tests = hir.tests.iter().filter(|test| test.span.file == script);
    let missions = missions.iter().map(|(id, scenario)| (hir.activities[*id].span, *id, in_scenario(*scenario)));
    let once = |(span, id, own)| (span, id, own, 1);
    let tests = own_tests.map(|test| (test.span, test.mission, of_test(test), test.rows.len()));
    let mut reached = |id, times: usize| known.reached(hir, id).saturating_mul(times);
    let (span, ..) =
        missions.map(once).chain(tests).find(|(_, mission, own, times)| over(own + reached(*mission, *times)))?;
    let message = "the missions and tests of this script are too much to check";
    Some(
        Diagnostic::error(Code::LimitsMissions, span, message)
            .here(format!("with this one they reach more than {} parts", grouped(TOGETHER_MAX as u64)))
            .help(
                "all that a mission calls counts for each mission and each test of it: move some of them into another \
                 script",
            ),
    )
}

/// What something is itself, and what it calls.
#[derive(Clone)]
struct Own {
    parts: usize,
    activities: Vec<ActivityId>,
    fns: BTreeSet<FnId>,
}

/// What has been counted.
struct Known {
    activities: Vec<Option<Own>>,
    fns: Vec<Option<Own>>,
}

impl Known {
    /// The parts of an activity and of all that it calls, each once.
    fn reached(&mut self, hir: &Hir, activity: ActivityId) -> usize {
        let (mut parts, mut activities, mut fns) = (0_usize, BTreeSet::new(), BTreeSet::<FnId>::new());
        let (mut ahead, mut fns_ahead) = (vec![activity], Vec::<FnId>::new());
        while let Some(id) = ahead.pop() {
            if activities.insert(id) {
                let own = self.activities[id].get_or_insert_with(|| of_activity(hir, id));
                parts = parts.saturating_add(own.parts);
                ahead.extend(&own.activities);
                fns_ahead.extend(&own.fns);
            }
        }
        while let Some(id) = fns_ahead.pop() {
            if fns.insert(id) {
                let own = self.fns[id].get_or_insert_with(|| of_fn(hir, id));
                parts = parts.saturating_add(own.parts);
                fns_ahead.extend(&own.fns);
            }
        }
        parts
    }
}

fn of_activity(hir: &Hir, id: ActivityId) -> Own {
    let activity = &hir.activities[id];
    let mut own = Own { parts: 1 + activity.vars.len(), activities: activity.calls(), fns: BTreeSet::new() };
    activity.visit(&mut |e| own.expr(e));
    for block in activity.blocks() {
        block.each(&mut |_| own.parts += 1);
    }
    own
}

fn of_fn(hir: &Hir, id: FnId) -> Own {
    let function = &hir.fns[id];
    let mut own = Own { parts: 1 + function.vars.len(), activities: Vec::new(), fns: BTreeSet::new() };
    function.body.visit(&mut |e| own.expr(e));
    function.body.each(&mut |_| own.parts += 1);
    own
}

impl Own {
    fn expr(&mut self, e: &Expr) -> bool {
        self.parts += 1;
        if let ExprKind::Call(id, _) = e.kind {
            self.fns.insert(id);
        }
        true
    }
}

fn of_test(test: &Test) -> usize {
    let expects = test.expects.iter().map(|expect| expect.holds.parts());
    let depths = test.depths.iter().map(|(point, _)| point.parts());
    let args = test.rows.iter().flat_map(|row| &row.args).map(Expr::parts);
    1 + test.vars.len() + expects.chain(depths).chain(args).sum::<usize>()
}

fn of_clause(clause: &ClauseUse) -> usize {
    let of_arg = |(_, arg): &(String, ClauseArg)| match arg {
        ClauseArg::Value(value) => value.parts(),
        ClauseArg::Nested(clause) => of_clause(clause),
    };
    1 + clause.args.iter().map(of_arg).sum::<usize>()
}
