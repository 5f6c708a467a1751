//! The switching table: which behavior follows which, and that none is forgotten.

use super::ends::{Known, can_end};
use super::expr::article;
use super::stray::{NO_STATEMENTS, alone};
use super::{Checker, Setting, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Body, Rule, Target, mentions_done, same_condition};
use crate::source::Span;
use crate::syntax::tree::{self, Clause, ClauseKind};
use crate::types::Type;
use std::collections::{BTreeMap, BTreeSet};

/// Rules by which a behavior is left at most, those of `any` among them: each is compared with all before it.
const RULES_MAX: usize = 256;
/// Rules of a table at most, each as often as it has sources: it is written out for each.
const EXITS_MAX: usize = 65_536;
/// Of the rules that shadow another so many are shown.
const SHOWN: usize = 3;

/// Words with which other tables end.
const ENDS: [&str; 9] = ["end", "complete", "completed", "stop", "exit", "quit", "success", "finished", "terminate"];

impl<'t> Checker<'t> {
    pub(super) fn table(
        &mut self,
        id: usize,
        a: &'t tree::Activity,
        result: Option<&Type>,
        clauses: &[&'t Clause],
    ) -> Body {
        if self.is_no_table(a, clauses) {
            return Body::Sequence(hir::Block::default());
        }
        let mut names = Names::default();
        let mut behaviors = Vec::new();
        let mut start = None;
        let mut unstarted = None;
        let (mut written, mut stray) = (Vec::new(), Vec::new());
        for clause in clauses {
            match &clause.kind {
                ClauseKind::Behavior(b) => {
                    if let Some(earlier) = names.index(&b.name.node).map(|i| names.all[i]) {
                        let message = format!("there are two behaviors `{}`", b.name.node);
                        let finding = Diagnostic::error(Code::NamesTwice, b.name.span, message);
                        self.report(finding.label(earlier.span, "the first"));
                    }
                    self.names_used.define(&b.name, "a behavior");
                    names.push(&b.name);
                    behaviors.push(self.in_part(clause.span, |c| c.nested(id, b)));
                }
                ClauseKind::Start(name) => {
                    if start.replace(name).is_some() {
                        self.report(Diagnostic::error(Code::RulesStart, clause.span, "a table has one `start`"));
                    }
                }
                ClauseKind::Rule(rule) => written.push(rule),
                _ if alone(clause).is_some() && unstarted.is_none() => unstarted = alone(clause),
                _ => stray.push(*clause),
            }
        }
        self.stray_statements(&stray);
        if let Some((name, span)) = unstarted {
            if start.is_none() {
                start = names.index(name).map(|i| names.all[i]);
            }
            let help = format!("write `start {name}`, if it begins with that behavior");
            self.misplaced(span, NO_STATEMENTS, &help);
        }
        let mut room = Room::of(&names);
        let mut rules = Vec::new();
        for rule in &written {
            let sources = self.in_part(rule.sources_span, |c| c.sources(rule, &names));
            // A table that is too large is not looked at further: what it lacks may be among what was left out.
            if let Some(message) = room.lacks(&sources, &names) {
                self.report(
                    Diagnostic::error(Code::LimitsRules, rule.sources_span, message)
                        .help("make several tables of it, each a strategy of its own"),
                );
                return Body::Sequence(hir::Block::default());
            }
            rules.extend(self.in_part(rule.sources_span, |c| c.rule(rule, sources, &names, result)));
        }
        let start = match start {
            Some(name) => self.behavior_named(name, &names),
            None => {
                self.no_start(a, &names, written.is_empty());
                None
            }
        };
        match start {
            Some(start) if !behaviors.is_empty() => Body::Table { start, behaviors, rules },
            _ => Body::Sequence(hir::Block::default()),
        }
    }

    /// A table that says not where it begins.
    fn no_start(&mut self, a: &tree::Activity, names: &Names, has_no_rules: bool) {
        let name = &a.name.node;
        // A brace in the wrong place.
        let inner = names.all.first().filter(|_| matches!(a.kind, tree::ActivityKind::Behavior) && has_no_rules);
        self.report(match inner {
            Some(inner) => {
                let message = format!("the behavior `{}` stands inside the behavior `{name}`", inner.node);
                let help = "before it; what holds behaviors is a `strategy`, with `start NAME` and rules";
                Diagnostic::error(Code::RulesStart, inner.span, message)
                    .label(a.name.span, "which is open here")
                    .help(format!("close `{name}` {help}"))
            }
            None => {
                let message = format!("with which behavior does `{name}` begin?");
                Diagnostic::error(Code::RulesStart, a.name.span, message).help("write `start NAME`")
            }
        });
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

    fn behavior_named(&mut self, name: &tree::Name, names: &Names) -> Option<usize> {
        let found = names.index(&name.node);
        if let Some(index) = found {
            self.names_used.refer(name.span, names.all[index].span);
        } else {
            let known = || names.all.iter().map(|n| n.node.as_str());
            let finding =
                Diagnostic::error(Code::RulesUnknown, name.span, format!("there is no behavior `{}` here", name.node));
            let finding = match self.suggestion(&name.node, known()) {
                _ if ENDS.contains(&name.node.as_str()) => finding.help("write `finish`: it ends the strategy"),
                Some(help) => finding.help(help),
                None => finding,
            };
            self.report(finding);
            // What was probably meant stands in for it, so that the table is not found wanting a second time.
            return self.nearest(&name.node, known()).and_then(|meant| names.index(meant));
        }
        found
    }

    /// The behaviors that a rule leaves.
    fn sources(&mut self, rule: &tree::SwitchingRule, names: &Names) -> Vec<usize> {
        if rule.sources.is_empty() {
            // `any -> C`: all but C.
            let to = match &rule.target {
                tree::Target::Behavior(name) => names.index(&name.node),
                _ => None,
            };
            (0..names.all.len()).filter(|&i| to != Some(i)).collect()
        } else {
            rule.sources.iter().filter_map(|name| self.behavior_named(name, names)).collect()
        }
    }

    fn rule(
        &mut self,
        rule: &tree::SwitchingRule,
        sources: Vec<usize>,
        names: &Names,
        result: Option<&Type>,
    ) -> Option<Rule> {
        let to = match &rule.target {
            tree::Target::Behavior(name) => Some(self.behavior_named(name, names)),
            _ => None,
        };
        let on = self.rule_condition(&rule.on);
        let facts = self.shown(&on, true);
        let (target, effect) = self.with_setting(Setting::Instant, |c| {
            c.in_block(|c| {
                c.learn(facts);
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
    pub(super) fn check_table(
        &mut self,
        hir: &hir::Hir,
        known_ends: &mut Known,
        strategy: &hir::Activity,
        (behaviors, start, rules): (&[usize], usize, &[Rule]),
    ) {
        let names: Vec<tree::Name> = behaviors
            .iter()
            .map(|&b| tree::Name { node: hir.activities[b].name.clone(), span: hir.activities[b].span })
            .collect();
        let leaving = hir::leaving(rules, behaviors.len());
        let reached = reached(rules, &leaving, start);
        // Whether a rule leads there that does not come back.
        let mut entered = vec![false; names.len()];
        for rule in rules {
            if let Target::Behavior(to) = rule.target {
                entered[to] |= !rule.back;
            }
        }
        let mut known = BTreeSet::new();
        let aborts_anyway = may_abort(strategy);
        for (i, name) in names.iter().enumerate() {
            if !known.insert(&name.node) {
                continue;
            }
            if !reached[i] {
                self.report(
                    Diagnostic::error(Code::RulesUnreachable, name.span, format!("`{}` is never entered", name.node))
                        .help(format!("add a rule `… -> {} on …`, or remove it", name.node)),
                );
                continue;
            }
            let only_back = !entered[i] && i != start;
            let ends = can_end(behaviors[i], hir, known_ends);
            let leaving: Vec<&Rule> = leaving[i].iter().map(|&rule| &rules[rule]).collect();
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
                if leaving.is_empty() && !may_abort(&hir.activities[behaviors[i]]) && !aborts_anyway {
                    self.report(
                        Diagnostic::error(Code::RulesForever, name.span, format!("`{}` is never left", name.node))
                            .help(format!("add `{} -> … on …`", name.node)),
                    );
                }
            }
        }
        self.comes_back(hir, known_ends, behaviors, rules, &leaving);
        self.shadowed(rules, &leaving, &names);
    }

    /// `then back` comes back when what it led to is done: not from what never ends, nor from what a rule leads on from when it is done.
    fn comes_back(
        &mut self,
        hir: &hir::Hir,
        known_ends: &mut Known,
        behaviors: &[usize],
        rules: &[Rule],
        leaving: &[Vec<usize>],
    ) {
        for rule in rules.iter().filter(|rule| rule.back) {
            let Target::Behavior(to) = rule.target else { continue };
            let behavior = &hir.activities[behaviors[to]];
            let done = leaving[to].iter().map(|&rule| &rules[rule]).find(|rule| Self::is_just_done(&rule.on));
            let warning = |at, message| Diagnostic::warning(Code::RulesBack, at, message);
            let finding = match done {
                _ if !can_end(behaviors[to], hir, known_ends) => {
                    warning(rule.span, format!("`{}` never ends: nothing comes back from it", behavior.name))
                        .label(behavior.span, "declared here")
                }
                Some(on) => {
                    warning(on.span, format!("when `{}` is done this leads on: nothing comes back", behavior.name))
                        .label(rule.span, "to what waits here")
                }
                None => continue,
            };
            self.report(finding.help(
                "a rule that leads on leaves for good what waits: leave out `then back`, or make a strategy of all that comes between",
            ));
        }
    }

    /// A rule after one of the same source that holds whenever it does is never reached. One with `done` is tried at other times than one
    /// without: after the body, which may have assigned a memory, and in the tick in which a suspended behavior goes on.
    fn shadowed(&mut self, rules: &[Rule], leaving: &[Vec<usize>], names: &[tree::Name]) {
        for (k, later) in rules.iter().enumerate() {
            // A rule of many behaviors is compared once with each other one.
            let mut compared: BTreeMap<usize, bool> = BTreeMap::new();
            let mut shadows = |earlier: usize| {
                *compared.entry(earlier).or_insert_with(|| {
                    let earlier = &rules[earlier];
                    earlier.sources.len() >= later.sources.len()
                        && same_condition(&earlier.on, &later.on)
                        && (mentions_done(&earlier.on) || !mentions_done(&later.on))
                })
            };
            let mut left: Vec<(&str, &Rule)> = Vec::new();
            for &source in &later.sources {
                let shadow =
                    leaving[source].iter().take_while(|earlier| **earlier < k).find(|earlier| shadows(**earlier));
                left.extend(shadow.map(|&earlier| (names[source].node.as_str(), &rules[earlier])));
            }
            let Some(((first, _), others)) = left.split_first() else { continue };
            let of = match others {
                [] => format!("`{first}`"),
                [(second, _)] => format!("`{first}` and `{second}`"),
                _ => format!("`{first}` and {} others", others.len()),
            };
            let message = format!("this rule of {of} is never reached");
            let finding = Diagnostic::error(Code::RulesShadowed, later.on_span, message);
            let finding = finding.help(if left.len() < later.sources.len() {
                "leave that out of its sources, or put it first"
            } else {
                "remove it, or put it first"
            });
            let before: BTreeSet<Span> = left.iter().map(|(_, earlier)| earlier.on_span).collect();
            let label =
                |finding: Diagnostic, span| finding.label(span, "this one holds whenever it does, and comes first");
            self.report(before.into_iter().take(SHOWN).fold(finding, label));
        }
    }
}

/// Whether an activity can abort the mission by itself.
fn may_abort(activity: &hir::Activity) -> bool {
    let in_reactions = activity.reactions.iter().any(|(_, block)| flow::aborts(block).is_some());
    let in_body = matches!(&activity.body, Body::Sequence(block) if flow::aborts(block).is_some());
    !activity.aborts.is_empty() || in_reactions || in_body
}

/// The behaviors of a table by their names; of two of one name the first.
#[derive(Default)]
struct Names<'n> {
    all: Vec<&'n tree::Name>,
    places: BTreeMap<&'n str, usize>,
}

impl<'n> Names<'n> {
    fn push(&mut self, name: &'n tree::Name) {
        self.places.entry(&name.node).or_insert(self.all.len());
        self.all.push(name);
    }

    fn index(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }
}

/// How many rules leave each behavior of a table, and all of them together.
struct Room {
    each: Vec<usize>,
    all: usize,
}

impl Room {
    fn of(names: &Names) -> Self {
        Room { each: vec![0; names.all.len()], all: 0 }
    }

    /// Counts a rule by the behaviors that it leaves; tells where it is one too many.
    fn lacks(&mut self, sources: &[usize], names: &Names) -> Option<String> {
        for &source in sources {
            self.each[source] += 1;
            if self.each[source] > RULES_MAX {
                return Some(format!("`{}` has more than {RULES_MAX} rules", names.all[source].node));
            }
        }
        self.all += sources.len();
        (self.all > EXITS_MAX).then(|| format!("the behaviors of this table have more than {EXITS_MAX} rules together"))
    }
}

/// Which behaviors rules lead to from the first, each rule as often as it has sources.
fn reached(rules: &[Rule], leaving: &[Vec<usize>], start: usize) -> Vec<bool> {
    let mut reached = vec![false; leaving.len()];
    let mut todo = vec![start];
    while let Some(at) = todo.pop() {
        if std::mem::replace(&mut reached[at], true) {
            continue;
        }
        for &rule in &leaving[at] {
            if let Target::Behavior(to) = rules[rule].target {
                todo.push(to);
            }
        }
    }
    reached
}
