//! Tests: a mission run in a scenario over seeds, and what must hold of it.

use super::foregone::{Empty, Expectations};
use super::{Checker, Def, Scope, Setting, Signature};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expect, Expr, Row, Test, When, test_file_name};
use crate::source::Span;
use crate::syntax::tree::{self, ExpectMode, TestClause};
use crate::types::Type;
use albacore_arithmetic::INT_MAX;

/// A test runs this many seeds at most, those of all its rows together.
const SEEDS_MAX: f64 = 1_000_000.0;

impl<'t> Checker<'t> {
    pub(super) fn check_test(&mut self, m: usize, test: &'t tree::Test) {
        let name = self.plain_text(&test.name);
        self.test_is_told_apart(m, test, &name);
        let run = test.clauses.iter().find_map(|c| match &c.node {
            TestClause::Run { mission, args, scenario, seeds } => Some((c.span, mission, args, scenario, seeds)),
            _ => None,
        });
        let Some((run_span, mission, args, scenario, seeds)) = run else {
            self.report(
                Diagnostic::error(Code::TestsRun, test.name.span, format!("the test \"{name}\" runs nothing"))
                    .help("write `run MISSION in SCENARIO seeds 1..20`"),
            );
            return;
        };
        let runs = test.clauses.iter().filter(|c| matches!(c.node, TestClause::Run { .. }));
        for again in runs.skip(1) {
            self.report(
                Diagnostic::error(Code::TestsRun, again.span, "a test runs one mission").label(run_span, "the first"),
            );
        }
        if !test.clauses.iter().any(|c| !matches!(c.node, TestClause::Run { .. } | TestClause::Row { .. })) {
            self.report(
                Diagnostic::error(Code::TestsNothing, test.name.span, format!("the test \"{name}\" expects nothing"))
                    .help("write what must hold, such as `expect completed`"),
            );
        }
        let Some(id) = self.mission_named(m, mission) else { return };
        let signature = self.activity_signatures[id].clone();
        let (setup, _) = self.within(Scope::new(m, Setting::Constant), |c| {
            let rows = c.rows(test, &signature, args, run_span);
            let first = c.expr_as(&seeds.first, &Type::Int, "a seed");
            let last = c.expr_as(&seeds.last, &Type::Int, "a seed");
            (rows, c.scenario_named(scenario), first, last)
        });
        let (rows, scenario, first, last) = setup;
        let Some(seeds) = self.seeds(&first, &last, seeds.inclusive, rows.as_ref().map_or(1, Vec::len)) else { return };
        let (checked, scope) = self.within(Scope::new(m, Setting::Constant), |c| {
            c.test_scope(id);
            let mut expects = Vec::new();
            let mut snapshots = Vec::new();
            for clause in &test.clauses {
                match &clause.node {
                    TestClause::Expect { mode, holds } => expects.push(c.expect(mode, holds, clause.span)),
                    TestClause::SnapshotSwitches { seed } if seed.fract() == 0.0 && *seed <= INT_MAX => {
                        snapshots.push(*seed as u64);
                    }
                    TestClause::SnapshotSwitches { .. } => {
                        let finding = Diagnostic::error(Code::TestsSeeds, clause.span, "a seed is a whole number");
                        c.report(finding.help("for example `snapshot switches of seed 1`"));
                    }
                    TestClause::Run { .. } | TestClause::Row { .. } => {}
                }
            }
            (expects, snapshots, c.test.take())
        });
        let (expects, snapshots, known) = checked;
        for seed in snapshots.iter().filter(|seed| **seed < seeds.0 || **seed > seeds.1) {
            let message = format!("seed {seed} is not among those that are run");
            let finding = Diagnostic::error(Code::TestsSeeds, test.name.span, message);
            self.report(finding.help("take the snapshot of a seed that `run` names"));
        }
        let (Some(rows), Some(scenario), Some(known)) = (rows, scenario, known) else { return };
        self.hir.tests.push(Test {
            name,
            span: test.name.span,
            mission: id,
            rows,
            params: known.params,
            scenario,
            seeds,
            expects,
            snapshots,
            vars: scope.vars,
            known: known.names,
            depths: known.depths,
        });
    }

    /// What the mission is given in each row, or at once where there is no table. The row's values come beside those of `run`.
    fn rows(&mut self, test: &tree::Test, of: &Signature, given: &[tree::Arg], run: Span) -> Option<Vec<Row>> {
        let mut checked = |args: &[tree::Arg], span: Option<Span>| {
            let args = self.arguments(&of.name, &of.params, args, span.unwrap_or(run), Some(of.span))?;
            Some(Row { span, args })
        };
        let rows = test.clauses.iter().filter_map(|clause| match &clause.node {
            TestClause::Row { args } => Some((args, clause.span)),
            _ => None,
        });
        // Each is looked at, whatever is wrong with another.
        let rows: Vec<Option<Row>> =
            rows.map(|(args, span)| checked(&[given, args.as_slice()].concat(), Some(span))).collect();
        match rows.is_empty() {
            true => Some(vec![checked(given, None)?]),
            false => rows.into_iter().collect(),
        }
    }

    /// The first seed and the last, of each of so many rows.
    fn seeds(&mut self, first: &Expr, last: &Expr, is_inclusive: bool, rows: usize) -> Option<(u64, u64)> {
        let without_last = if is_inclusive { 0.0 } else { 1.0 };
        match (first.range.constant(), last.range.constant().map(|last| last - without_last)) {
            (Some(a), Some(b)) if a >= 0.0 && a <= b && (b - a + 1.0) * rows as f64 <= SEEDS_MAX => {
                Some((a as u64, b as u64))
            }
            (Some(a), Some(b)) if a >= 0.0 && a <= b => {
                let message = "a test has a million runs at most, those of all its rows together";
                let finding = Diagnostic::error(Code::TestsSeeds, first.span.to(last.span), message);
                self.report(finding.help("take fewer seeds, or fewer rows"));
                None
            }
            _ => {
                let message = "seeds are two whole numbers, the smaller first";
                let finding = Diagnostic::error(Code::TestsSeeds, first.span.to(last.span), message);
                self.report(finding.help("for example `seeds 1..20`"));
                None
            }
        }
    }

    /// Snapshots are kept under the names of their tests.
    fn test_is_told_apart(&mut self, m: usize, test: &'t tree::Test, name: &str) {
        let Some(earlier) = self.tests_named.insert((m, test_file_name(name)), test.name.span) else { return };
        self.report(
            Diagnostic::error(Code::TestsName, test.name.span, format!("the test \"{name}\" has the name of another"))
                .label(earlier, "this one")
                .help("give it another: a test is known by the letters and digits (a to z, 0 to 9) of its name"),
        );
    }

    fn mission_named(&mut self, m: usize, path: &tree::Path) -> Option<usize> {
        match self.resolve(m, path) {
            Some(&Def::Activity(id)) if self.mission_ids.contains(&id) => Some(id),
            _ => {
                let known: Vec<String> =
                    self.mission_ids.iter().map(|&id| self.activity_signatures[id].name.clone()).collect();
                let finding =
                    Diagnostic::error(Code::TestsMission, path.span, format!("there is no mission `{}`", path.text()));
                let finding = match self.suggestion(&path.text(), known.iter().map(String::as_str)) {
                    Some(help) => finding.help(help),
                    None => {
                        finding.help("declare it in this file, or name the module that has it: `run MODULE.NAME(…)`")
                    }
                };
                self.report(finding);
                None
            }
        }
    }

    fn expect(&mut self, mode: &ExpectMode, holds: &tree::Expr, span: Span) -> Expect {
        let holds = self.in_block(|c| c.condition(holds));
        let needs = self.test.as_mut().map(|test| std::mem::take(&mut test.needs)).unwrap_or_default();
        if needs.is_empty()
            && let Some(empty) = self.says_nothing(&holds)
        {
            let message = match empty {
                Empty::Holds => "this holds whatever the mission does",
                Empty::Constant => "this reads nothing of a run: it is the same whatever the mission does",
            };
            self.report(
                Diagnostic::error(Code::TestsNothing, holds.span, message)
                    .help("write what must hold of the run, such as `expect completed`, or leave it out"),
            );
        }
        let when = match mode {
            ExpectMode::EveryRun => When::AtTheEnd(1.0),
            ExpectMode::Always => When::Always,
            ExpectMode::Once => When::Once,
            ExpectMode::While(behavior) => {
                self.asks_no_ending(&holds);
                // One that is not understood has been told: the test is not run.
                self.behavior_of_the_tested(behavior).map_or(When::Always, When::While)
            }
            ExpectMode::ShareOfRuns(share) => {
                let value = self.expr_as(share, &Type::Quantity(Dimension::NONE), "a share of the runs");
                match value.range.constant() {
                    Some(x) if x > 0.0 && x <= 1.0 => When::AtTheEnd(x),
                    _ => {
                        self.report(
                            Diagnostic::error(
                                Code::TestsShare,
                                share.span,
                                "a share of the runs is a constant above 0 % and up to 100 %",
                            )
                            .help("for example `expect in 95 % of runs: …`"),
                        );
                        When::AtTheEnd(1.0)
                    }
                }
            }
        };
        Expect { when, holds, needs, span }
    }

    fn says_nothing(&self, holds: &Expr) -> Option<Empty> {
        let names = &self.test.as_ref()?.names;
        Expectations { names, kind: &|id| self.scope.vars[id].kind }.empty(holds)
    }
}
