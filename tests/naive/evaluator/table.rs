//! Switching tables: rules 7 to 9, 11 and 12.

use super::activation::{Aborted, Activation, inner_cause};
use super::body::at_once;
use super::expr::{Frame, Scope, exactly, holds, text, value};
use super::watch::Watch;
use super::world::World;
use albacore_lang::hir::{ActivityId, Body, Decl, Expr, ExprKind, InputPart, Rule, Target, VarKind, children};
use albacore_lang::types::Type;
use albacore_program::Cause;

/// The behaviors that have been entered: the last is active, each other waits for the next to be done (rule 12).
#[derive(Default)]
pub struct Table<'p> {
    row: Vec<Seat<'p>>,
}

struct Seat<'p> {
    which: usize,
    activation: Activation<'p>,
    /// The conditions over time of the rules that may leave it: they watch from its entry, and stand still while it waits.
    rules: Watch<'p>,
}

/// What a rule led to.
#[derive(Clone, Copy)]
pub struct Fired {
    pub finishes: bool,
}

impl<'p> Table<'p> {
    pub fn active(&mut self) -> Option<&mut Activation<'p>> {
        self.row.last_mut().map(|seat| &mut seat.activation)
    }

    pub fn enter(&mut self, w: &mut World<'p>, owner: &Activation<'p>, which: usize) -> Result<(), Aborted> {
        let (behaviors, rules) = parts(owner);
        let guards: Vec<&Expr> = rules.iter().filter(|rule| rule.sources.contains(&which)).map(|r| &r.on).collect();
        let mut rules = Watch::begin(w, &owner.frame, &guards, 0);
        rules.update_rhythms(w, &owner.frame, &owner.rhythms, owner.age);
        let activity = &w.hir.activities[behaviors[which]];
        let activation = Activation::new(activity, owner.frame.clone(), owner.setpoints, owner.is_overlay);
        self.row.push(Seat { which, activation, rules });
        self.active().map_or(Ok(()), |active| active.begin(w))
    }

    /// Rule 7: in the order of the text, the first that holds fires. `done`: the body came to its end in this tick (rule 8).
    pub fn try_rules(
        &mut self,
        w: &mut World<'p>,
        owner: &mut Activation<'p>,
        done: bool,
    ) -> Result<Option<Fired>, Aborted> {
        let Some(seat) = self.row.last_mut() else { return Ok(None) };
        if !done {
            // Before its own step: the tick that it is about to live.
            seat.rules.update(w, &owner.frame, seat.activation.age + 1);
            seat.rules.update_rhythms(w, &owner.frame, &owner.rhythms, owner.age);
        }
        for rule in parts(owner).1.iter().filter(|rule| rule.sources.contains(&seat.which)) {
            let scope = Scope { frame: &owner.frame, watch: Some(&seat.rules), done };
            if (!done || mentions_done(&rule.on)) && holds(w, scope, &rule.on) {
                return self.switch(w, owner, rule, done).map(Some);
            }
        }
        Ok(None)
    }

    /// Rule 9: what is active is left, innermost first; the `do`; the target is entered.
    fn switch(
        &mut self,
        w: &mut World<'p>,
        owner: &mut Activation<'p>,
        rule: &'p Rule,
        done: bool,
    ) -> Result<Fired, Aborted> {
        let Some(seat) = self.row.last() else { return Ok(Fired { finishes: false }) };
        let (from, name) = (seat.which, seat.activation.activity.name.clone());
        let scope = Scope { frame: &owner.frame, watch: Some(&seat.rules), done };
        let mut watched = Vec::new();
        for (name, e) in leaves(w, owner, &rule.on) {
            let words = value(w, scope, e).words(&w.shape(&e.ty));
            watched.push(exactly(&w.texts, &name, &w.shape(&e.ty), &words));
        }
        let mut said = watched.join(", ");
        let back = rule.back && !matches!(rule.target, Target::Behavior(to) if to == from);
        if back && mentions_done(&rule.on) {
            said += &format!("; done {}", u8::from(done));
        }
        w.say(format!("switch {name} {} [{}]", w.sources.place(rule.span), said));
        // Rule 11: the result is computed before the `do`.
        if let Target::Finish(Some(e)) = &rule.target {
            owner.result = Some(value(w, scope, e));
        }
        if back {
            w.say(format!("suspend {name}"));
            if let Some(active) = self.active() {
                active.pause_overlays(w);
            }
        } else {
            self.leave(w, if done { Cause::Done } else { Cause::Rule });
        }
        owner.rhythms.fire(&rule.on, owner.age);
        if let Some(effect) = &rule.effect {
            at_once(w, &owner.frame, effect);
            remembered(w, &owner.frame, effect.assigned());
        }
        match &rule.target {
            Target::Behavior(to) => {
                // Rule 12: entering a suspended behavior afresh leaves it first; what waits for it waits for the next.
                if let Some(at) = self.row.iter().position(|seat| seat.which == *to) {
                    self.row.remove(at).activation.leave(w, Cause::Rule);
                }
                self.enter(w, owner, *to)?;
                Ok(Fired { finishes: false })
            }
            Target::Finish(_) => Ok(Fired { finishes: true }),
            Target::Abort(why) => Err(Aborted::because(text(w, Scope::of(&owner.frame), why))),
        }
    }

    /// The active behavior; when it is done its `done` rules; without one that holds, what waits goes on in this same tick,
    /// and may itself be done in it (rules 8 and 12). Tells whether the strategy is finished.
    pub fn step(&mut self, w: &mut World<'p>, owner: &mut Activation<'p>) -> Result<bool, Aborted> {
        while let Some(active) = self.active() {
            if !active.step(w)? {
                return Ok(false);
            }
            if let Some(fired) = self.try_rules(w, owner, true)? {
                return Ok(fired.finishes);
            }
            if self.row.len() < 2 {
                return Ok(false);
            }
            if let Some(mut done) = self.row.pop() {
                done.activation.leave(w, Cause::Done);
            }
            if let Some(seat) = self.row.last_mut() {
                w.say(format!("resume {}", seat.activation.activity.name));
                // It lives this tick, and with it the timers of its rules.
                seat.rules.update(w, &owner.frame, seat.activation.age + 1);
                seat.rules.update_rhythms(w, &owner.frame, &owner.rhythms, owner.age);
            }
        }
        Ok(false)
    }

    /// Leaves the active behavior, and those that wait for it.
    pub fn leave(&mut self, w: &mut World<'p>, cause: Cause) {
        let mut cause = cause;
        while let Some(mut seat) = self.row.pop() {
            seat.activation.leave(w, cause);
            cause = inner_cause(cause);
        }
    }
}

fn parts<'p>(owner: &Activation<'p>) -> (&'p [ActivityId], &'p [Rule]) {
    match &owner.activity.body {
        Body::Table { behaviors, rules, .. } => (behaviors, rules),
        _ => (&[], &[]),
    }
}

fn mentions_done(e: &Expr) -> bool {
    let mut found = matches!(e.kind, ExprKind::Done);
    children(e, &mut |child| found |= mentions_done(child));
    found
}

/// The trace has the memories that a `do` assigns.
fn remembered(w: &mut World<'_>, frame: &Frame<'_>, mut assigned: Vec<usize>) {
    assigned.sort_unstable();
    assigned.dedup();
    for id in assigned {
        let var = &frame.declared[id];
        if var.kind == VarKind::Memory {
            let shape = w.shape(&var.ty);
            let words = frame.get(id).words(&shape);
            w.say(format!("memory {}", exactly(&w.texts, &var.name, &shape, &words)));
        }
    }
}

/// What the trace has of a guard: its names and readings, and for each signal the readings that it is made of.
fn leaves<'p>(w: &World<'p>, owner: &Activation<'p>, guard: &'p Expr) -> Vec<(String, &'p Expr)> {
    let mut found: Vec<(String, &Expr)> = Vec::new();
    let mut ahead = vec![guard];
    while let Some(e) = ahead.pop() {
        let mut inside = Vec::new();
        let is_named = |e: &Expr| matches!(e.kind, ExprKind::Var(_));
        let shown = match &e.kind {
            ExprKind::Var(_) | ExprKind::Input(..) => !matches!(e.ty, Type::Area | Type::List(..) | Type::Map(..)),
            ExprKind::Part(inner, _) => is_named(inner),
            _ => false,
        };
        if shown {
            let name = w.written(e);
            if found.iter().all(|(other, _)| *other != name) {
                found.push((name, e));
            }
            let unit = owner.activity;
            match &e.kind {
                ExprKind::Input(_, InputPart::Hits(limit, _)) => inside.push(&**limit),
                ExprKind::Var(var) => inside.extend(unit.decls.iter().find_map(|decl| match decl {
                    Decl::Signal(signal, e) if signal == var => Some(e),
                    _ => None,
                })),
                _ => {}
            }
        } else {
            children(e, &mut |child| inside.push(child));
        }
        ahead.extend(inside.into_iter().rev());
    }
    found
}
