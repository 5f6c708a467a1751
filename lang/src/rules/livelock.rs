//! Rules that undo each other: a table that switches to and fro, or round in a ring, on what goes on to hold gets nowhere.

use super::levels::{Level, RING_MAX, Signals, Way};
use crate::check::{least_time, never_ends, takes_time};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{
    Action, ActivityId, Block, Body, Expr, ExprKind, Hir, Rule, Stmt, StmtKind, Target, VarId, leaving, mentions_done,
};
use std::cell::Cell;
use std::collections::BTreeSet;

/// The most work that is done in one table, in comparisons: beyond, nothing is said of the rest.
const WORK: usize = 1 << 23;
/// ... of which a look at all that is assigned on a way takes so much.
const WAY_WORK: usize = 1 << 10;

/// Calls within calls that are followed for how long a behavior takes.
const CALLS_MAX: usize = 4;

/// The warnings on a switching table.
pub fn check(hir: &Hir, activity: ActivityId) -> Vec<Diagnostic> {
    let strategy = &hir.activities[activity];
    let Body::Table { behaviors, rules, .. } = &strategy.body else { return Vec::new() };
    let signals = Signals::of(strategy);
    let work = Work(Cell::new(WORK));
    let levels = |on| if work.is_left() { work.counted(signals.levels(on)) } else { Vec::new() };
    let table = Table {
        hir,
        activity,
        behaviors,
        rules,
        leaving: leaving(rules, behaviors.len()),
        is_instant: behaviors.iter().map(|behavior| is_instant(hir, *behavior)).collect(),
        at_once: [Level::default()],
        levels: rules.iter().map(|rule| levels(&rule.on)).collect(),
        aborts: strategy.aborts.iter().flat_map(|(_, on)| levels(on)).collect(),
        signals,
        work,
    };
    let comes_again = rules.iter().filter_map(|rule| table.comes_again(rule).or_else(|| table.starves(rule)));
    comes_again.chain(table.rings().into_iter().map(|ring| table.undoes(&ring))).collect()
}

/// What a sequence surely ends with: the condition after the `until` of its last statement.
fn until(hir: &Hir, behavior: ActivityId) -> Option<&Expr> {
    let Body::Sequence(block) = &hir.activities[behavior].body else { return None };
    // What takes no time comes in the same tick.
    let takes_time = |stmt: &&Stmt| {
        !matches!(
            stmt.kind,
            StmtKind::Log(_)
                | StmtKind::Report { .. }
                | StmtKind::Set(..)
                | StmtKind::Insert(..)
                | StmtKind::Remove(..)
                | StmtKind::Clear(_)
                | StmtKind::Replace(..)
        )
    };
    let mut last = block.stmts.iter().rfind(takes_time)?;
    while let StmtKind::With(_, inner) = &last.kind {
        last = inner.stmts.iter().rfind(takes_time)?;
    }
    match &last.kind {
        StmtKind::Timed(timed) if timed.within.is_none() && !matches!(timed.action, Action::Call(..)) => {
            timed.until.as_ref()
        }
        _ => None,
    }
}

/// Whether a behavior may be done in the tick in which it is entered, and ends no mission.
fn is_instant(hir: &Hir, behavior: ActivityId) -> bool {
    let Body::Sequence(block) = &hir.activities[behavior].body else { return false };
    let mut aborts = false;
    block.each(&mut |stmt| aborts |= matches!(stmt.kind, StmtKind::Abort(_)));
    !aborts && !takes_time(block)
}

/// What is left of the work.
struct Work(Cell<usize>);

impl Work {
    fn is_left(&self) -> bool {
        self.0.get() > 0
    }

    /// Takes some of it; whether there was so much.
    fn takes(&self, work: usize) -> bool {
        self.0.set(self.0.get().saturating_sub(work));
        self.is_left()
    }

    /// Levels whose making is counted.
    fn counted<'h>(&self, levels: Vec<Level<'h>>) -> Vec<Level<'h>> {
        self.takes(levels.iter().map(|level| level.work(level)).sum());
        levels
    }
}

struct Table<'h> {
    hir: &'h Hir,
    activity: ActivityId,
    behaviors: &'h [ActivityId],
    rules: &'h [Rule],
    leaving: Vec<Vec<usize>>,
    /// Of each behavior, whether it may be done in the tick in which it is entered.
    is_instant: Vec<bool>,
    /// What `done` demands there: nothing.
    at_once: [Level<'h>; 1],
    /// Of each rule, the ways in which its guard can go on to hold.
    levels: Vec<Vec<Level<'h>>>,
    /// The same of what aborts the strategy, which comes before its rules.
    aborts: Vec<Level<'h>>,
    signals: Signals<'h>,
    work: Work,
}

/// Rules that lead from a behavior back to it, each with the behavior that it leaves.
type Ring = Vec<(usize, usize)>;

impl<'h> Table<'h> {
    /// A condition that may still hold when the behavior it leads to is done, and lead there again.
    fn comes_again(&self, rule: &'h Rule) -> Option<Diagnostic> {
        let Target::Behavior(to) = rule.target else { return None };
        let behavior = self.behaviors[to];
        // One that has a rule for its end does not go back.
        if self.leaving[to].iter().any(|&rule| matches!(self.rules[rule].on.kind, ExprKind::Done)) {
            return None;
        }
        let way = rule.sources.iter().map(|&source| (source, rule)).chain([(to, rule)]);
        if !rule.back || never_ends(self.hir, behavior) || !self.lasts(&rule.on, until(self.hir, behavior), way) {
            return None;
        }
        let name = &self.hir.activities[behavior].name;
        let message = format!("this may hold again as soon as `{name}` is done, and switch on every other tick");
        let finding = Diagnostic::warning(Code::RulesLivelock, rule.on_span, message);
        Some(finding.help(if mentions_done(&rule.on) {
            "what was done when it was suspended is done at once when it goes on: leave out `then back`, or let `do { … }` change what is \
             asked beside `done`"
        } else if mentions_after(&rule.on) {
            "time goes on counting from the entry: write `every T`, which counts anew when the rule fires, or `becomes after T` for once in each stay"
        } else {
            "write `becomes …`, or let the behavior end only when the condition no longer holds: `… until not …`"
        }))
    }

    /// A rhythm that is over before what it leads to is done: what it left goes on for one tick of each round.
    fn starves(&self, rule: &'h Rule) -> Option<Diagnostic> {
        let Target::Behavior(to) = rule.target else { return None };
        let least = least_time(self.hir, self.behaviors[to], CALLS_MAX);
        let is_over = |way: &Way<'h>| match &way.0.kind {
            ExprKind::Every(time) => way.1 && least < f64::INFINITY && time.range.high <= least,
            _ => false,
        };
        if !rule.back || !self.signals.ways(&rule.on).iter().any(is_over) {
            return None;
        }
        let name = &self.hir.activities[self.behaviors[to]].name;
        let message =
            format!("this is due again before `{name}` is done: what it leaves goes on for one tick at a time");
        let finding = Diagnostic::warning(Code::RulesLivelock, rule.on_span, message);
        Some(finding.help("the rhythm goes on meanwhile: write a longer one, or let the behavior take less"))
    }

    /// Whether a guard may still hold when what it led to is done: it has a way without an edge that neither the end of that
    /// behavior nor what is assigned on the way excludes.
    fn lasts(&self, guard: &'h Expr, end: Option<&'h Expr>, way: impl Iterator<Item = (usize, &'h Rule)>) -> bool {
        if !self.work.takes(WAY_WORK) {
            return false;
        }
        let assigned = self.assigned(way);
        let ends = end.and_then(|end| self.signals.moments(end)).map(|ends| self.work.counted(ends));
        self.signals.ways(guard).into_iter().any(|way| {
            let mut read = BTreeSet::new();
            self.signals.reads(way.0, &mut read);
            let lasts = || match (&ends, self.signals.moment(way)) {
                (Some(ends), Some(now)) => {
                    ends.iter().any(|end| self.work.takes(now.work(end)) && now.and(end).is_some())
                }
                _ => true,
            };
            self.signals.outlasts(way) && !assigned.iter().any(|change| ends_by(way, &read, *change)) && lasts()
        })
    }

    /// The variables that are assigned where a way leads through, and to what: in the behaviors, by the effects of the rules, and by
    /// what the table does in any of them.
    fn assigned(&self, way: impl Iterator<Item = (usize, &'h Rule)>) -> Vec<(VarId, Option<f64>)> {
        let reactions = |id: ActivityId| self.hir.activities[id].reactions.iter().map(|(_, block)| block);
        let mut blocks: Vec<&Block> = reactions(self.activity).collect();
        for (behavior, rule) in way {
            blocks.extend(&rule.effect);
            // A behavior has the variables of its strategy; what else is called has its own.
            for id in self.hir.called_from(self.behaviors[behavior]) {
                let called = &self.hir.activities[id];
                if called.owner == Some(self.activity) {
                    blocks.extend(called.blocks());
                }
            }
        }
        blocks.into_iter().flat_map(Block::assignments).collect()
    }

    /// The ways in which the guard of a rule can go on to hold where a behavior is left by it.
    fn levels_from(&self, rule: usize, source: usize) -> &[Level<'h>] {
        let is_done = matches!(self.rules[rule].on.kind, ExprKind::Done);
        if is_done && self.is_instant[source] { &self.at_once } else { &self.levels[rule] }
    }

    /// Rings of rules that hold at once and go on to hold, no rule in two of them: the shortest first.
    fn rings(&self) -> Vec<Ring> {
        let mut rings: Vec<Ring> = Vec::new();
        let mut told = BTreeSet::new();
        for (length, first) in (1..=RING_MAX).flat_map(|length| (0..self.rules.len()).map(move |rule| (length, rule))) {
            for &source in &self.rules[first].sources {
                let ring = self.levels_from(first, source).iter().find_map(|level| {
                    let mut ring = vec![(first, source)];
                    self.goes_round(level, level, &mut ring, length).then_some(ring)
                });
                let Some(mut ring) = ring else { continue };
                ring.sort_unstable();
                if ring.iter().all(|(rule, _)| !told.contains(rule)) {
                    told.extend(ring.iter().map(|(rule, _)| *rule));
                    rings.push(ring);
                }
            }
        }
        rings
    }

    /// Whether others of whose conditions the first speaks lead on from the last rule of a way back to where it began, in a
    /// state in which all hold, so many rules at most.
    fn goes_round(&self, first: &Level<'h>, state: &Level<'h>, way: &mut Ring, most: usize) -> bool {
        let Some(&(rule, _)) = way.last() else { return false };
        let Target::Behavior(to) = self.rules[rule].target else { return false };
        if self.rules[rule].back {
            return false;
        }
        if to == way[0].1 {
            return self.work.takes(WAY_WORK)
                && state.holds_after(way.len())
                && self.is_undisturbed(way)
                && way.iter().all(|step| self.is_tried(*step, state));
        }
        if way.len() == most || way.iter().any(|(_, been)| *been == to) {
            return false;
        }
        for &next in &self.leaving[to] {
            for level in self.levels_from(next, to) {
                if !self.work.takes(first.work(level) + state.work(level)) {
                    return false;
                }
                if !first.covers(level) {
                    continue;
                }
                let Some(both) = state.and(level) else { continue };
                way.push((next, to));
                if self.goes_round(first, &both, way, most) {
                    return true;
                }
                way.pop();
            }
        }
        false
    }

    /// Whether no abort and no rule before this one surely leads elsewhere.
    fn is_tried(&self, (rule, source): (usize, usize), state: &Level<'h>) -> bool {
        let earlier = self.leaving[source].iter().take_while(|other| **other < rule);
        let mut elsewhere = earlier.flat_map(|&other| &self.levels[other]).chain(&self.aborts);
        !elsewhere.any(|other| state.implies(other))
    }

    /// Whether nothing that a ring's rules read is assigned on it.
    fn is_undisturbed(&self, ring: &Ring) -> bool {
        let mut read = BTreeSet::new();
        ring.iter().for_each(|(rule, _)| self.signals.reads(&self.rules[*rule].on, &mut read));
        // What is counted where no time goes by is counted for whatever leads out.
        if ring.iter().any(|step| self.is_at_once(step)) {
            let out = ring.iter().flat_map(|(_, source)| &self.leaving[*source]).map(|&rule| &self.rules[rule].on);
            let aborts = self.hir.activities[self.activity].aborts.iter().map(|(_, on)| on);
            out.chain(aborts).for_each(|on| self.signals.reads(on, &mut read));
        }
        let way = ring.iter().map(|&(rule, source)| (source, &self.rules[rule]));
        read.is_empty() || !self.assigned(way).iter().any(|(var, _)| read.contains(var))
    }

    /// Whether a behavior of a ring may be left as soon as it was entered, because it may take no time.
    fn is_at_once(&self, (rule, source): &(usize, usize)) -> bool {
        matches!(self.rules[*rule].on.kind, ExprKind::Done) && self.is_instant[*source]
    }

    fn undoes(&self, ring: &Ring) -> Diagnostic {
        let on = |(rule, _): &(usize, usize)| self.rules[*rule].on_span;
        let (last, others) = match ring.split_last() {
            Some((last, others)) => (on(last), others),
            None => (self.hir.activities[self.activity].span, ring.as_slice()),
        };
        let instant = ring.iter().find(|step| self.is_at_once(step));
        let message = match others.len() {
            0 => "this rule leads back at once, again and again".to_string(),
            1 => "this rule undoes another at once".to_string(),
            _ => format!("these {} rules lead round in as many ticks, again and again", ring.len()),
        };
        let finding = Diagnostic::warning(Code::RulesLivelock, last, message);
        let finding =
            others.iter().fold(finding, |finding, other| finding.label(on(other), "which can hold at the same time"));
        if let Some((_, source)) = instant {
            let name = &self.hir.activities[self.behaviors[*source]].name;
            return finding.help(format!(
                "`{name}` may be done as soon as it is entered: let it take time on every path, such as `wait for 1 s`"
            ));
        }
        finding.help(if ring.iter().any(|(rule, _)| is_timed(&self.rules[*rule].on)) {
            "a time of one tick, 0.1 s, is over whenever a rule is tried, and a rhythm goes on in all behaviors: write longer ones"
        } else {
            "write `becomes …` in each, or conditions that exclude each other, with room between: `> 4 m` and `< 2 m`"
        })
    }
}

/// Whether a way in which a condition holds may end by an assignment: not by one that makes so again what already is.
fn ends_by((e, holds): Way, read: &BTreeSet<VarId>, (var, value): (VarId, Option<f64>)) -> bool {
    let is_itself = matches!(e.kind, ExprKind::Var(id) if id == var);
    read.contains(&var) && !(is_itself && value == Some(f64::from(u8::from(holds))))
}

fn is_timed(e: &Expr) -> bool {
    e.contains(|e| matches!(e.kind, ExprKind::After(_) | ExprKind::Every(_) | ExprKind::HeldFor(..)))
}

fn mentions_after(e: &Expr) -> bool {
    e.contains(|e| matches!(e.kind, ExprKind::After(_)))
}
