//! The switching table: which behavior follows which, and that none is forgotten.

use super::expr::article;
use super::{Checker, Setting, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Body, Rule, Target, mentions_done, same_condition};
use crate::source::Span;
use crate::syntax::tree::{self, Clause, ClauseKind};
use crate::types::Type;
use std::collections::BTreeMap;

impl<'t> Checker<'t> {
    pub(super) fn table(
        &mut self,
        id: usize,
        a: &'t tree::Activity,
        result: Option<&Type>,
        clauses: &[&'t Clause],
    ) -> Body {
        let mut names: Vec<&tree::Name> = Vec::new();
        let mut behaviors = Vec::new();
        let mut start = None;
        let mut unstarted = None;
        let mut written = Vec::new();
        for clause in clauses {
            match &clause.kind {
                ClauseKind::Behavior(b) => {
                    if let Some(earlier) = names.iter().find(|n| n.node == b.name.node) {
                        let finding = Diagnostic::error(
                            Code::NamesTwice,
                            b.name.span,
                            format!("there are two behaviors `{}`", b.name.node),
                        )
                        .label(earlier.span, "the first");
                        self.report(finding);
                    }
                    names.push(&b.name);
                    behaviors.push(self.nested(id, b));
                }
                ClauseKind::Start(name) => {
                    if start.replace(name).is_some() {
                        self.report(Diagnostic::error(Code::RulesStart, clause.span, "a table has one `start`"));
                    }
                }
                ClauseKind::Rule(rule) => written.push(rule),
                _ if alone(clause).is_some() && unstarted.is_none() => unstarted = alone(clause),
                _ => self.misplaced(
                    clause.span,
                    "a switching table has no statements",
                    "move it into a behavior, and name that behavior in the table",
                ),
            }
        }
        if let Some((name, span)) = unstarted {
            if start.is_none() {
                start = names.iter().find(|n| n.node == name).copied();
            }
            let help = format!("write `start {name}`, if it begins with that behavior");
            self.misplaced(span, "a switching table has no statements", &help);
        }
        let mut rules = Vec::new();
        for rule in &written {
            rules.extend(self.rule(rule, &names, result));
        }
        let start = match start {
            Some(name) => self.behavior_named(name, &names),
            None => {
                let name = &a.name.node;
                // A brace in the wrong place.
                let inner =
                    names.first().filter(|_| matches!(a.kind, tree::ActivityKind::Behavior) && written.is_empty());
                self.report(match inner {
                    Some(inner) => Diagnostic::error(
                        Code::RulesStart,
                        inner.span,
                        format!("the behavior `{}` stands inside the behavior `{name}`", inner.node),
                    )
                    .label(a.name.span, "which is open here")
                    .help(format!(
                        "close `{name}` before it; what holds behaviors is a `strategy`, with `start NAME` and rules"
                    )),
                    None => Diagnostic::error(
                        Code::RulesStart,
                        a.name.span,
                        format!("with which behavior does `{name}` begin?"),
                    )
                    .help("write `start NAME`"),
                });
                None
            }
        };
        if behaviors.is_empty() || start.is_none() {
            return Body::Sequence(hir::Block::default());
        }
        let start = start.unwrap_or(0);
        Body::Table { start, behaviors, rules }
    }

    fn nested(&mut self, owner: usize, b: &'t tree::Activity) -> usize {
        if let Some(param) = b.params.first() {
            self.report(
                Diagnostic::error(
                    Code::RulesParams,
                    param.name.span,
                    format!("`{}` is entered by a rule, which gives no arguments", b.name.node),
                )
                .help("it sees the strategy's parameters, memory and signals"),
            );
        }
        if let Some(result) = &b.result {
            self.report(
                Diagnostic::error(
                    Code::RulesResult,
                    result.span,
                    format!("`{}` ends in a table, where nobody reads a result", b.name.node),
                )
                .help("set a `memory` of the strategy"),
            );
        }
        let outer = self.scope.finish.take();
        let activity = self.in_block(|c| c.with_setting(Setting::Body, |c| c.activity(usize::MAX, b, Some(owner))));
        self.scope.finish = outer;
        self.hir.activities.push(activity);
        self.hir.activities.len() - 1
    }

    fn behavior_named(&mut self, name: &tree::Name, names: &[&tree::Name]) -> Option<usize> {
        let found = names.iter().position(|n| n.node == name.node);
        if found.is_none() {
            let finding =
                Diagnostic::error(Code::RulesUnknown, name.span, format!("there is no behavior `{}` here", name.node));
            let finding = match self.suggestion(&name.node, names.iter().map(|n| n.node.as_str())) {
                Some(help) => finding.help(help),
                None => finding,
            };
            self.report(finding);
            // What was probably meant stands in for it, so that the table is not found wanting a second time.
            let meant = self.nearest(&name.node, names.iter().map(|n| n.node.as_str()));
            return names.iter().position(|n| Some(n.node.as_str()) == meant);
        }
        found
    }

    fn rule(&mut self, rule: &tree::SwitchingRule, names: &[&tree::Name], result: Option<&Type>) -> Option<Rule> {
        let to = match &rule.target {
            tree::Target::Behavior(name) => Some(self.behavior_named(name, names)),
            _ => None,
        };
        let sources: Vec<usize> = if rule.sources.is_empty() {
            // `any -> C`: all but C.
            (0..names.len()).filter(|&i| to.flatten() != Some(i)).collect()
        } else {
            rule.sources.iter().filter_map(|name| self.behavior_named(name, names)).collect()
        };
        let on = self.rule_condition(&rule.on);
        let facts = self.shown(&on, true);
        let (target, effect) = self.with_setting(Setting::Instant, |c| {
            c.in_block(|c| {
                c.scope.facts.learn(facts);
                // The result is computed before `do` runs: what the guard has shown holds.
                let target = match &rule.target {
                    tree::Target::Behavior(_) => to.flatten().map(Target::Behavior),
                    tree::Target::Finish(value, span) => c.rule_result(value.as_ref(), *span, result),
                    tree::Target::Abort(why, _) => Some(Target::Abort(c.told(why))),
                };
                let effect = rule.effect.as_ref().map(|b| c.in_block(|c| c.block(b)));
                (target, effect)
            })
        });
        if let (Some(back), false) = (rule.back, matches!(rule.target, tree::Target::Behavior(_))) {
            self.report(
                Diagnostic::error(Code::RulesBack, back, "nothing comes back from here")
                    .help("`then back` belongs to `A -> B`"),
            );
        }
        let target = target?;
        if let Target::Behavior(to) = target
            && sources.contains(&to)
            && rule.back.is_some()
        {
            self.report(Diagnostic::error(Code::RulesBack, rule.sources_span, "a behavior cannot wait for itself"));
        }
        let span = rule.sources_span;
        Some(Rule { sources, target, on, back: rule.back.is_some(), effect, span, on_span: rule.on.span })
    }

    fn rule_result(
        &mut self,
        value: Option<&tree::Expr>,
        span: crate::source::Span,
        result: Option<&Type>,
    ) -> Option<Target> {
        match (value, result) {
            (Some(value), Some(ty)) => Some(Target::Finish(Some(self.expr_as(value, ty, "the result")))),
            (None, None) => Some(Target::Finish(None)),
            (Some(value), None) => {
                self.report(
                    Diagnostic::error(Code::FlowResult, value.span, "this finishes with a value, and none is declared")
                        .help("declare it: `strategy NAME(…) -> TYPE { … }`"),
                );
                // The rule stands all the same: it leads away from its source.
                Some(Target::Finish(None))
            }
            (None, Some(ty)) => {
                let ty = self.type_name(ty);
                self.report(
                    Diagnostic::error(
                        Code::FlowResult,
                        span,
                        format!("this finishes without its result, {}", article(&ty)),
                    )
                    .help("write `-> finish VALUE`"),
                );
                Some(Target::Finish(None))
            }
        }
    }

    /// What the table promises: every behavior reachable, every ending answered, every rule alive.
    pub(super) fn check_table(&mut self, hir: &hir::Hir, behaviors: &[usize], start: usize, rules: &[Rule]) {
        let names: Vec<tree::Name> = behaviors
            .iter()
            .map(|&b| tree::Name { node: hir.activities[b].name.clone(), span: hir.activities[b].span })
            .collect();
        let mut reached = vec![false; names.len()];
        let mut todo = vec![start];
        while let Some(at) = todo.pop() {
            if std::mem::replace(&mut reached[at], true) {
                continue;
            }
            for rule in rules.iter().filter(|r| r.sources.contains(&at)) {
                if let Target::Behavior(to) = rule.target {
                    todo.push(to);
                }
            }
        }
        for (i, name) in names.iter().enumerate() {
            if names[..i].iter().any(|earlier| earlier.node == name.node) {
                continue;
            }
            if !reached[i] {
                self.report(
                    Diagnostic::error(Code::RulesUnreachable, name.span, format!("`{}` is never entered", name.node))
                        .help(format!("add a rule `… -> {} on …`, or remove it", name.node)),
                );
                continue;
            }
            let only_back =
                rules.iter().all(|r| !matches!(r.target, Target::Behavior(to) if to == i) || r.back) && i != start;
            let ends = match &hir.activities[behaviors[i]].body {
                Body::Sequence(block) => can_end(block, hir, &mut BTreeMap::new()),
                _ => false,
            };
            let leaving: Vec<&Rule> = rules.iter().filter(|r| r.sources.contains(&i)).collect();
            let answered = leaving.iter().any(|r| Self::is_just_done(&r.on));
            if ends && !answered && !only_back {
                self.report(
                    Diagnostic::error(
                        Code::RulesEnding,
                        name.span,
                        format!("`{}` can end, and no rule says what then", name.node),
                    )
                    .help(format!("add `{} -> … on done`", name.node)),
                );
            }
            if !ends {
                for rule in &leaving {
                    if mentions_done(&rule.on) && rule.sources.len() == 1 {
                        self.report(
                            Diagnostic::error(
                                Code::RulesDone,
                                rule.on_span,
                                format!("`{}` never ends: it is never `done`", name.node),
                            )
                            .label(name.span, "declared here")
                            .help(format!(
                                "bound what it does, such as `for 1 min`, or leave it on a condition: `{} -> … on after 1 min`",
                                name.node
                            )),
                        );
                    }
                }
                if leaving.is_empty() && !only_back {
                    self.report(
                        Diagnostic::error(Code::RulesForever, name.span, format!("`{}` is never left", name.node))
                            .help(format!("add `{} -> … on …`", name.node)),
                    );
                }
            }
        }
        self.shadowed(rules, &names);
    }

    /// A rule after one of the same source whose guard always holds is never tried.
    fn shadowed(&mut self, rules: &[Rule], names: &[tree::Name]) {
        for (k, later) in rules.iter().enumerate() {
            let shares = |earlier: &Rule| earlier.sources.iter().any(|source| later.sources.contains(source));
            let shadows: Vec<&Rule> = rules[..k]
                .iter()
                .filter(|earlier| earlier.sources.len() >= later.sources.len() && shares(earlier))
                .filter(|earlier| same_condition(&earlier.on, &later.on))
                .collect();
            for source in &later.sources {
                let (Some(name), Some(earlier)) =
                    (names.get(*source), shadows.iter().find(|earlier| earlier.sources.contains(source)))
                else {
                    continue;
                };
                self.report(
                    Diagnostic::error(
                        Code::RulesShadowed,
                        later.on_span,
                        format!("this rule of `{}` is never reached", name.node),
                    )
                    .label(earlier.on_span, "this one holds whenever it does, and comes first")
                    .help("remove it, or put it first"),
                );
            }
        }
    }
}

/// Whether a mission's statements never come to their end by themselves.
pub fn never_ends(hir: &hir::Hir, mission: usize) -> bool {
    match &hir.activities[mission].body {
        Body::Sequence(block) => !can_end(block, hir, &mut BTreeMap::new()),
        _ => false,
    }
}

/// The activities of which is known whether they never end, those that are being asked among them: recursion is an error of
/// its own.
type Known = BTreeMap<usize, bool>;

/// Whether a body can come to its end.
fn can_end(block: &hir::Block, hir: &hir::Hir, known: &mut Known) -> bool {
    if flow::leaves(block) {
        return finishes(block);
    }
    !block.stmts.iter().any(|stmt| match &stmt.kind {
        // A statement that never ends by itself and is not bounded.
        hir::StmtKind::Timed(timed) => endless(timed, hir, known),
        hir::StmtKind::With(_, body) => !can_end(body, hir, known),
        hir::StmtKind::Loop(_) => true,
        _ => false,
    })
}

fn finishes(block: &hir::Block) -> bool {
    block.stmts.iter().any(|stmt| match &stmt.kind {
        hir::StmtKind::Finish(_) => true,
        hir::StmtKind::If(_, a, b) => finishes(a) || finishes(b),
        hir::StmtKind::With(_, b) | hir::StmtKind::Loop(b) => finishes(b),
        _ => false,
    })
}

fn endless(timed: &hir::Timed, hir: &hir::Hir, known: &mut Known) -> bool {
    match &timed.action {
        _ if timed.duration.is_some() || timed.until.is_some() || timed.within.is_some() => false,
        hir::Action::Guide(..) | hir::Action::Keep(..) | hir::Action::Watch | hir::Action::Override(_) => {
            flow::endless(timed)
        }
        hir::Action::Call(id, _) => match &hir.activities[*id].body {
            Body::Sequence(block) => match known.get(id) {
                Some(endless) => *endless,
                None => {
                    known.insert(*id, false);
                    let endless = !can_end(block, hir, known);
                    known.insert(*id, endless);
                    endless
                }
            },
            // A strategy ends by a rule alone.
            Body::Table { behaviors, rules, .. } => {
                !behaviors.is_empty() && !rules.iter().any(|rule| matches!(rule.target, Target::Finish(_)))
            }
            _ => false,
        },
    }
}

/// A name that stands alone, as after a `start` that was left out.
fn alone(clause: &Clause) -> Option<(&str, Span)> {
    match &clause.kind {
        ClauseKind::Timed(timed) if !timed.is_modified() => match &timed.action {
            tree::Action::Expr(tree::Expr { kind: tree::ExprKind::Name(name), .. }) => Some((name, clause.span)),
            _ => None,
        },
        _ => None,
    }
}
