//! Switching tables to code: for each behavior its guards, and for each rule what happens when it fires.

use super::Lowering;
use super::watch::rhythms;
use crate::hir::{self, Block, Decl, Expr, ExprKind, InputPart, VarId, VarKind, children, mentions_done};
use crate::types::Type;
use albacore_program::{Body, Entry, Exit, Op, Rule, Shape, Table, Target, Valued, Watched, WatchedCode};
use std::collections::{BTreeMap, BTreeSet};

impl<'a> Lowering<'a> {
    pub(super) fn table(&mut self, id: usize, start: usize, behaviors: &[usize], rules: &[hir::Rule]) -> Body {
        let indices: Vec<u32> = behaviors.iter().map(|&b| self.activity(b, 1)).collect();
        let first_rule = self.program.rules.len() as u32;
        for rule in rules {
            let lowered = self.rule(id, rule, behaviors);
            self.program.rules.push(lowered);
        }
        let mut entries = Vec::new();
        for (&index, leaving) in indices.iter().zip(hir::leaving(rules, behaviors.len())) {
            let owner = self.program.activities[index as usize].header;
            let leaving: Vec<(usize, &hir::Rule)> = leaving.into_iter().map(|i| (i, &rules[i])).collect();
            // The same guard may serve several sources: each has its own timers.
            let timers = self.place_timers(leaving.iter().map(|(_, r)| &r.on));
            let arm = self.here();
            self.reset_timers(&timers);
            self.update_timers(&timers, owner, None);
            self.emit(Op::Return);
            let watch = self.here();
            self.update_timers(&timers, owner, None);
            self.emit(Op::Return);
            let exits = leaving
                .into_iter()
                .map(|(i, rule)| {
                    let (guard, terms) = (self.code(&rule.on), self.terms(id, &rule.on));
                    self.frame.done = true;
                    let done = mentions_done(&rule.on).then(|| (self.code(&rule.on), self.terms(id, &rule.on)));
                    self.frame.done = false;
                    let (guard_done, terms_done) = done.map_or((None, None), |(code, terms)| (Some(code), terms));
                    let watched = self.watched(id, &rule.on);
                    Exit { rule: first_rule + i as u32, guard, guard_done, watched, terms, terms_done }
                })
                .collect();
            entries.push(Entry { activity: index, arm, watch, exits });
        }
        Body::Table(Table { start: start as u32, behaviors: entries })
    }

    fn rule(&mut self, id: usize, rule: &hir::Rule, behaviors: &[usize]) -> Rule {
        let mut aborting = None;
        let effect = match (&rule.effect, &rule.target) {
            (None, target) if !matches!(target, hir::Target::Abort(_)) && rhythms(&rule.on).is_empty() => None,
            (effect, target) => {
                let entry = self.here();
                self.renew_rhythms(&rule.on);
                if let Some(block) = effect {
                    self.stmts(&block.stmts);
                    self.remembered(id, block);
                }
                if let hir::Target::Abort(why) = target {
                    aborting = Some(self.text(why));
                }
                self.emit(Op::Return);
                Some(entry)
            }
        };
        let (target, to) = match &rule.target {
            hir::Target::Behavior(to) => {
                (Target::Behavior(*to as u32), self.hir.activities[behaviors[*to]].name.clone())
            }
            hir::Target::Abort(_) => (Target::Abort(aborting.unwrap_or(0)), "abort".to_string()),
            hir::Target::Finish(value) => {
                let code = value.as_ref().map(|e| {
                    let entry = self.here();
                    let to = self.frame.result;
                    self.scratch(|l| l.expr_into(e, to));
                    self.emit(Op::Return);
                    entry
                });
                (Target::Finish(code), "finish".to_string())
            }
        };
        let guard = self.sources.text(rule.on_span);
        Rule {
            text: format!("-> {to} on {guard}"),
            place: self.sources.place(rule.span),
            target,
            back: rule.back,
            effect,
        }
    }

    /// Tells the trace of the memories that an effect assigns.
    fn remembered(&mut self, id: usize, effect: &Block) {
        let mut vars = effect.assigned();
        vars.sort_unstable();
        vars.dedup();
        let unit = self.owner_of(id);
        for var in vars {
            let declared = &self.hir.activities[unit].vars[var];
            if declared.kind != VarKind::Memory {
                continue;
            }
            let value = Valued { slot: self.frame.vars[var], shape: self.shape(&declared.ty) };
            self.program.memories.push(Watched { name: declared.name.clone(), value });
            let memory = self.program.memories.len() as u32 - 1;
            self.emit(Op::Changed { memory });
        }
    }

    pub(super) fn owner_of(&self, id: usize) -> usize {
        self.hir.activities[id].owner.unwrap_or(id)
    }

    /// What the trace prints of a guard: its names, and for each signal the readings that it is made of.
    pub(super) fn watched(&mut self, id: usize, guard: &Expr) -> Vec<WatchedCode> {
        self.leaves(id, guard)
            .into_iter()
            .map(|(name, e)| {
                let code = self.code(&e);
                let shape: Shape = self.shape(&e.ty);
                WatchedCode { name, code, shape }
            })
            .collect()
    }

    /// The readings and names in a guard, in their order. Signals may be made of one another in a long chain: it is followed without
    /// going down.
    fn leaves(&self, id: usize, guard: &Expr) -> Vec<(String, Expr)> {
        let signal = |decl: &'a Decl| match decl {
            Decl::Signal(var, e) => Some((*var, e)),
            _ => None,
        };
        let signals: BTreeMap<VarId, &Expr> =
            self.hir.activities[self.owner_of(id)].decls.iter().filter_map(signal).collect();
        let mut seen = BTreeSet::new();
        let mut out = Vec::new();
        let mut ahead = vec![guard];
        while let Some(e) = ahead.pop() {
            let is_shown = match &e.kind {
                ExprKind::Var(_) | ExprKind::Input(..) => !matches!(e.ty, Type::Area | Type::List(..) | Type::Map(..)),
                ExprKind::Part(inner, _) => matches!(inner.kind, ExprKind::Var(_)),
                _ => false,
            };
            if !is_shown {
                let first = ahead.len();
                children(e, &mut |child| ahead.push(child));
                ahead[first..].reverse();
                continue;
            }
            let name = self.sources.text(e.span);
            // Its own readings are there already: signals of signals would be gone through once for each way to them.
            if !seen.insert(name) {
                continue;
            }
            out.push((name.to_string(), e.clone()));
            match &e.kind {
                ExprKind::Input(_, InputPart::Hits(limit, _)) => ahead.push(limit),
                ExprKind::Var(var) => ahead.extend(signals.get(var)),
                _ => {}
            }
        }
        out
    }
}
