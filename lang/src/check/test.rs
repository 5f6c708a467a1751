//! Tests: a mission run in a scenario over seeds, and what must hold of it.

use super::{Checker, Def, Scope, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expect, Expr, ExprKind, Interval, Test, TestNames, VarKind, When};
use crate::source::Span;
use crate::suggest;
use crate::syntax::tree::{self, ActivityKind, ClauseKind, ExpectMode, Item, TestClause};
use crate::types::Type;

/// A test runs this many seeds at most.
const SEEDS_MAX: f64 = 1_000_000.0;

/// What stands after `truth`.
const TRUTHS: [&str; 5] = ["position", "nearest_source", "start", "deepest", "depth_at"];

/// The test whose expectations are being checked.
pub(super) struct TestScope {
    /// The mission that it runs.
    mission: usize,
    /// What its expectations speak of.
    names: TestNames<usize>,
    /// The points whose true water depth they ask for, and the variables of the answers.
    depths: Vec<(Expr, usize)>,
}

impl<'t> Checker<'t> {
    pub(super) fn check_test(&mut self, m: usize, test: &'t tree::Test) {
        let name = self.plain_text(&test.name);
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
        let Some(id) = self.mission_named(m, mission) else { return };
        let signature = self.activity_signatures[id].clone();
        let (setup, _) = self.within(Scope::new(m, Setting::Constant), |c| {
            let args = c.arguments(&signature.name, &signature.params, args, run_span, Some(signature.span));
            let first = c.expr_as(&seeds.first, &Type::Int, "a seed");
            let last = c.expr_as(&seeds.last, &Type::Int, "a seed");
            (args, c.scenario_named(scenario), first, last)
        });
        let (args, scenario, first, last) = setup;
        let without_last = if seeds.inclusive { 0.0 } else { 1.0 };
        let seeds = match (first.range.constant(), last.range.constant().map(|last| last - without_last)) {
            (Some(a), Some(b)) if a >= 0.0 && a <= b && b - a < SEEDS_MAX => (a as u64, b as u64),
            _ => {
                self.report(
                    Diagnostic::error(
                        Code::TestsSeeds,
                        first.span.to(last.span),
                        "seeds are two whole numbers, the smaller first",
                    )
                    .help("for example `seeds 1..20`"),
                );
                return;
            }
        };
        let (checked, scope) = self.within(Scope::new(m, Setting::Constant), |c| {
            c.test_scope(id);
            let mut expects = Vec::new();
            let mut snapshots = Vec::new();
            for clause in &test.clauses {
                match &clause.node {
                    TestClause::Expect { mode, holds } => expects.push(c.expect(mode, holds, clause.span)),
                    TestClause::SnapshotSwitches { seed } => snapshots.push(*seed as u64),
                    TestClause::Run { .. } => {}
                }
            }
            (expects, snapshots, c.test.take())
        });
        let (expects, snapshots, known) = checked;
        for seed in &snapshots {
            if *seed < seeds.0 || *seed > seeds.1 {
                self.report(
                    Diagnostic::error(
                        Code::TestsSeeds,
                        test.name.span,
                        format!("seed {seed} is not among those that are run"),
                    )
                    .help("take the snapshot of a seed that `run` names"),
                );
            }
        }
        let (Some(args), Some(scenario), Some(known)) = (args, scenario, known) else { return };
        self.hir.tests.push(Test {
            name,
            span: test.name.span,
            mission: id,
            args,
            scenario,
            seeds,
            expects,
            snapshots,
            vars: scope.vars,
            known: known.names,
            depths: known.depths,
        });
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

    /// The names that only tests know.
    fn test_scope(&mut self, mission: usize) {
        let span = self.activity_signatures[mission].span;
        let var = |c: &mut Self, name: &str, ty: Type| c.declare_hidden(name.to_string(), VarKind::Signal, ty, span);
        let vars = TestNames {
            position: var(self, "truth.position", Type::Point),
            nearest_source: var(self, "truth.nearest_source", Type::Point),
            start: var(self, "truth.start", Type::Point),
            deepest: var(self, "truth.deepest", Type::Point),
            time: var(self, "time", Type::Quantity(Dimension::TIME)),
            completed: var(self, "completed", Type::Bool),
            area: var(self, "the mission's area", Type::Area),
            reported: Vec::new(),
            reported_at: Vec::new(),
        };
        self.test = Some(TestScope { mission, names: vars, depths: Vec::new() });
    }

    fn expect(&mut self, mode: &ExpectMode, holds: &tree::Expr, span: Span) -> Expect {
        let holds = self.condition(holds);
        let when = match mode {
            ExpectMode::EveryRun => When::AtTheEnd(1.0),
            ExpectMode::Always => When::Always,
            ExpectMode::ShareOfRuns(share) => {
                let value = self.expr_as(share, &Type::Quantity(Dimension::NONE), "a share of the runs");
                match value.range.constant() {
                    Some(x) if (0.0..=1.0).contains(&x) => When::AtTheEnd(x),
                    _ => {
                        self.report(
                            Diagnostic::error(
                                Code::TestsShare,
                                share.span,
                                "a share of the runs is a constant from 0 % to 100 %",
                            )
                            .help("for example `expect in 95 % of runs: …`"),
                        );
                        When::AtTheEnd(1.0)
                    }
                }
            }
        };
        Expect { when, holds, span }
    }

    /// `truth.position` and the like, and the area of the mission by the mission's name.
    pub(super) fn test_member(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let test = self.test.as_ref()?;
        let tree::ExprKind::Name(name) = &base.kind else { return None };
        let id = match (name.as_str(), member.node.as_str()) {
            ("truth", "position") => test.names.position,
            ("truth", "nearest_source") => test.names.nearest_source,
            ("truth", "start") => test.names.start,
            ("truth", "deepest") => test.names.deepest,
            ("truth", other) => {
                let finding =
                    Diagnostic::error(Code::TestsTruth, member.span, format!("there is no `truth.{other}` to ask for"));
                let finding = match self.nearest(other, TRUTHS) {
                    Some(near) => finding.help(format!("did you mean `truth.{near}`?")),
                    None => finding.help(format!("there is {}", suggest::listed(&TRUTHS))),
                };
                self.report(finding);
                return Some(self.unknown(span));
            }
            _ => {
                let full = &self.activity_signatures[test.mission].name;
                let mission = full.rsplit('.').next().unwrap_or(full);
                let own = name == mission && self.area_name(mission).as_deref() == Some(&member.node);
                own.then_some(test.names.area)?
            }
        };
        Some(self.variable(id, span))
    }

    /// `truth.depth_at(p)`: how deep the water truly is at a point.
    pub(super) fn test_method(
        &mut self,
        base: &tree::Expr,
        member: &tree::Name,
        args: &[tree::Arg],
        span: Span,
    ) -> Option<Expr> {
        self.test.as_ref()?;
        let is_truth = matches!(&base.kind, tree::ExprKind::Name(name) if name == "truth");
        if !is_truth || member.node != "depth_at" {
            return None;
        }
        let Some(given) = self.simple_args("depth_at", &[("point", Type::Point)], args, span) else {
            return Some(self.unknown(span));
        };
        let id = self.declare_hidden("truth.depth_at".into(), VarKind::Signal, Type::Quantity(Dimension::LENGTH), span);
        if let Some(test) = &mut self.test {
            test.depths.extend(given.into_iter().map(|point| (point, id)));
        }
        Some(self.variable(id, span))
    }

    /// The name that a mission gives its operating area.
    fn area_name(&self, mission: &str) -> Option<String> {
        self.modules.iter().flat_map(|m| &m.tree.items).find_map(|item| match item {
            Item::Activity(a) if matches!(a.kind, ActivityKind::Mission { .. }) && a.name.node == mission => {
                a.body.clauses.iter().find_map(|c| match &c.kind {
                    ClauseKind::Area { name, .. } => Some(name.node.clone()),
                    _ => None,
                })
            }
            _ => None,
        })
    }

    /// `reported("source")`: where that was first reported, `reported_at("source")`: when. Without such a report the
    /// expectation fails, and says so. `has_reported("source")` tells whether there is one.
    pub(super) fn test_call(&mut self, name: &str, args: &[tree::Arg], span: Span) -> Option<Expr> {
        self.test.as_ref()?;
        let when = match name {
            "reported" => false,
            // What was reported may be no place: it was reported all the same.
            "reported_at" | "has_reported" => true,
            _ => return None,
        };
        let Some([text]) = self.positional::<1>(name, args, span) else { return Some(self.unknown(span)) };
        let what = self.plain_text(&text);
        let ty = if when { Type::Quantity(Dimension::TIME) } else { Type::Point };
        let id = self.report_var(&what, when, &ty, span);
        let value = self.variable(id, span);
        Some(if name == "has_reported" {
            self.truth(value)
        } else {
            Expr { kind: ExprKind::Unwrap(Box::new(value)), ty, span, range: Interval::ANY }
        })
    }

    /// The variable that holds where or when something was reported: one for each name.
    fn report_var(&mut self, what: &str, when: bool, ty: &Type, span: Span) -> usize {
        let known = self.test.as_ref().and_then(|test| {
            let table = if when { &test.names.reported_at } else { &test.names.reported };
            table.iter().find(|(name, _)| name == what).map(|(_, id)| *id)
        });
        if let Some(id) = known {
            return id;
        }
        let hidden = format!("report \"{what}\" {}", if when { "at" } else { "place" });
        let id = self.declare_hidden(hidden, VarKind::Signal, Type::Optional(Box::new(ty.clone())), span);
        if let Some(TestScope { names, .. }) = &mut self.test {
            let table = if when { &mut names.reported_at } else { &mut names.reported };
            table.push((what.to_string(), id));
        }
        id
    }
}
