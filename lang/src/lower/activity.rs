//! Activities to code: the pieces that the machine runs at each point of a tick.

use super::watch::Timer;
use super::{Lowering, SortedBy, Sorter, slot};
use crate::hir::{self, Block, Decl, Expr, ExprKind, Kind, Var, children};
use crate::types::Type;
use albacore_program::{
    Abort, Activity, ActivityKind, Addr, Body, Code, Compute, Limits, ListOp, NamedArea, Op, Recording, Recovery,
    Require, Slot, Valued, header,
};

/// The words that are compared, at most, before a list is put in order anew.
const COMPARED_WORDS_MAX: u64 = 8;

impl<'a> Lowering<'a> {
    /// Lowers a mission; gives the words that it needs.
    pub(super) fn mission(&mut self, id: usize) -> u64 {
        let activity = &self.hir.activities[id];
        self.origin = activity.origin().or(self.origin);
        self.inputs();
        self.keep_samples(id);
        self.claim_inputs();
        self.constants_at = Some(slot(self.input_words()));
        let unit = self.unit(id);
        let base = self.input_words().saturating_add(self.program.constants.len() as u64);
        // What a mission says comes before what is said by what it calls.
        self.program.recordings.sort_by_key(|recording| recording.activity != unit.activity);
        let mission = &mut self.program.mission;
        mission.name = activity.name.clone();
        mission.activity = unit.activity;
        mission.base = slot(base);
        mission.guest = self.hir.first_watch(id).is_some();
        mission.origin = self.origin;
        let words = base.saturating_add(unit.words);
        self.program.words = slot(words);
        words
    }

    /// The subroutines that put ordered lists in order.
    pub(super) fn sorters(&mut self, vars: &[Var]) {
        for (id, var) in vars.iter().enumerate() {
            let (Some(order), Type::List(inner, _)) = (&var.order, &var.ty) else { continue };
            let value = self.lasting(1);
            let key = self.here();
            self.scratch(|l| l.expr_into(&order.key, value));
            self.emit(Op::Return);
            let sorter = self.here();
            let (list, it) = (self.frame.vars[id], self.frame.vars[order.it]);
            let words = self.words(inner);
            self.emit(ListOp::Sort { list, words, it, key, value, most: order.most });
            self.typed(it, inner);
            let reads = self.key_reads(order);
            let sorted_by: Option<Vec<SortedBy>> = reads.map(|reads| {
                reads.into_iter().map(|(read, words)| SortedBy { read, words, then: self.lasting(words) }).collect()
            });
            for by in sorted_by.iter().flatten() {
                self.copy(by.then, by.read, by.words);
            }
            self.emit(Op::Return);
            let element = (**inner).clone();
            self.frame.sorters.insert(id, Sorter { entry: sorter, it, element, sorted_by });
        }
    }

    /// What a key is made of beside the element; none when that cannot be compared with what it was.
    fn key_reads(&self, order: &hir::Order) -> Option<Vec<(Slot, u32)>> {
        let mut reads = Vec::new();
        let comparable = self.reads(&order.key, order.it, &mut reads);
        (comparable && reads.iter().map(|(_, words)| u64::from(*words)).sum::<u64>() <= COMPARED_WORDS_MAX)
            .then_some(reads)
    }

    fn reads(&self, e: &Expr, it: usize, out: &mut Vec<(Slot, u32)>) -> bool {
        match &e.kind {
            ExprKind::Var(id) if *id == it => {}
            ExprKind::Var(id) => out.push((self.frame.vars[*id], self.words(&e.ty))),
            ExprKind::Number(_) | ExprKind::Do(..) | ExprKind::Part(..) => {}
            _ => return false,
        }
        let mut comparable = true;
        children(e, &mut |child| comparable &= self.reads(child, it, out));
        comparable
    }

    /// An ordered list is put in order at the start of a tick if what its key is made of has changed since it was last put
    /// in order: an insertion or an assignment puts it in order itself.
    fn refresh_order(&mut self, var: usize) {
        let Some(sorter) = self.frame.sorters.get(&var).cloned() else { return };
        let Some(sorted_by) = &sorter.sorted_by else { return self.sort_by(&sorter) };
        let mut changed = Vec::new();
        for by in sorted_by {
            self.scratch(|l| {
                let same = l.temp(1);
                l.emit(Compute::Eq { to: same, a: by.read, b: by.then, words: by.words });
                changed.push(l.emit(Compute::jump_unless(same, 0)));
            });
        }
        let in_order = self.emit(Compute::jump(0));
        self.land_all(changed);
        self.sort_by(&sorter);
        self.land(in_order);
    }

    /// Puts an ordered list in order. What its key found last is an element.
    pub(super) fn sort_by(&mut self, sorter: &Sorter) {
        self.emit(Op::Call { code: sorter.entry, base: 0 });
        self.typed(sorter.it, &sorter.element);
    }

    /// One activity; gives its index in the program.
    pub(super) fn activity(&mut self, id: usize, _depth: u32) -> u32 {
        let activity = &self.hir.activities[id];
        let outer = (self.frame.header, self.frame.result, std::mem::take(&mut self.frame.overlays));
        let outer_declared = std::mem::take(&mut self.frame.declared_overlays);
        let at = self.lasting(header::WORDS);
        let result =
            activity.result.as_ref().map(|ty| Valued { slot: self.lasting(self.words(ty)), shape: self.shape(ty) });
        self.frame.header = at;
        self.frame.result = result.as_ref().map_or(at, |r| r.slot);

        let signal_timers: Vec<Vec<Timer>> = activity
            .decls
            .iter()
            .map(|decl| match decl {
                Decl::Signal(_, e) => self.place_timers([e]),
                _ => Vec::new(),
            })
            .collect();
        let rhythms = self.place_rhythms(activity);
        let conditions = activity.aborts.iter().map(|(_, c)| c).chain(activity.reactions.iter().map(|(c, _)| c));
        let condition_timers = self.place_timers(conditions);

        if activity.kind == Kind::Mission {
            self.mission_params(&activity.defaults);
        }
        let entry = self.here();
        signal_timers.iter().for_each(|timers| self.reset_timers(timers));
        self.reset_timers(&condition_timers);
        for last in rhythms {
            self.emit(Compute::Const { to: last, value: 0.0 });
        }
        for (decl, timers) in activity.decls.iter().zip(&signal_timers) {
            self.declaration(decl, timers, at);
        }
        self.update_timers(&condition_timers, at, None);
        self.emit(Op::Return);

        let refresh = self.here();
        for (decl, timers) in activity.decls.iter().zip(&signal_timers) {
            self.refresh(decl, timers, at);
        }
        self.update_timers(&condition_timers, at, None);
        self.emit(Op::Return);

        let aborts = activity.aborts.iter().map(|(why, condition)| self.abort(id, why, condition)).collect();
        let reactions = self.reactions(&activity.reactions);
        let body = self.activity_body(id, &activity.body);
        if let Some(mission) = &activity.mission {
            self.mission_parts(mission);
        }
        // Overlays beside the declarations are the outermost.
        let declared = std::mem::replace(&mut self.frame.declared_overlays, outer_declared);
        let mut overlays = std::mem::replace(&mut self.frame.overlays, outer.2);
        overlays.extend(declared);
        (self.frame.header, self.frame.result) = (outer.0, outer.1);
        self.program.activities.push(Activity {
            name: activity.name.clone(),
            place: self.sources.place(activity.span),
            kind: match activity.kind {
                Kind::Behavior => ActivityKind::Behavior,
                Kind::Strategy => ActivityKind::Strategy,
                Kind::AmendsCourse => ActivityKind::AmendsCourse,
                Kind::Beside => ActivityKind::Beside,
                Kind::Sets(axis) => ActivityKind::Sets(axis),
                Kind::Mission => ActivityKind::Mission,
            },
            header: at,
            entry,
            refresh,
            aborts,
            reactions,
            body,
            overlays,
            result,
        });
        let index = self.recorded(&activity.recordings);
        self.activities.insert(id, index);
        index
    }

    /// What is recorded while the activity is active that was lowered last; gives the index of that.
    fn recorded(&mut self, recordings: &[hir::Recording]) -> u32 {
        let activity = self.program.activities.len() as u32 - 1;
        for hir::Recording { inputs, rate } in recordings {
            let labels = |input: usize| self.hir.inputs[input].fields.iter().map(|(label, _)| label.clone()).collect();
            let inputs = inputs.iter().map(|&(input, _)| (input as u32, labels(input))).collect();
            self.program.recordings.push(Recording { activity, inputs, rate: *rate });
        }
        activity
    }

    fn reactions(&mut self, reactions: &[(Expr, Block)]) -> Addr {
        let entry = self.here();
        for (condition, block) in reactions {
            let unless = self.jumps_unless(condition);
            self.renew_rhythms(condition);
            self.stmts(&block.stmts);
            self.land_all(unless);
        }
        self.emit(Op::Return);
        entry
    }

    /// Nobody calls a mission: its parameters have their defaults, which `--set` may have changed.
    fn mission_params(&mut self, defaults: &[Option<Expr>]) {
        self.program.mission.params = self.here();
        for (param, default) in defaults.iter().enumerate() {
            let given = self.mission_args.and_then(|args| args.get(param));
            if let Some(e) = given.or(default.as_ref()) {
                let to = self.frame.vars[param];
                self.scratch(|l| l.expr_into(e, to));
            }
        }
        self.emit(Op::Return);
    }

    fn activity_body(&mut self, id: usize, body: &hir::Body) -> Body {
        match body {
            hir::Body::Sequence(block) => {
                let body = self.here();
                self.frame.told_by_name = self.hir.activities[id].is_told_by_name();
                self.stmts(&block.stmts);
                self.frame.told_by_name = false;
                self.emit(Op::End);
                Body::Sequence(body)
            }
            hir::Body::Amend { asked, block } => {
                let value = self.lasting(1);
                let entry = self.here();
                self.block_into(block, value);
                self.emit(Op::Return);
                Body::Amend { asked: self.frame.vars[*asked], amended: Code { entry, value } }
            }
            hir::Body::Table { start, behaviors, rules } => self.table(id, *start, behaviors, rules),
        }
    }

    /// A declaration, on each tick after the entry.
    fn refresh(&mut self, decl: &Decl, timers: &[Timer], at: Slot) {
        match decl {
            Decl::Signal(var, e) => {
                self.update_timers(timers, at, None);
                let to = self.frame.vars[*var];
                self.scratch(|l| l.expr_into(e, to));
            }
            Decl::Memory(var, _) => self.refresh_order(*var),
            _ => {}
        }
    }

    /// A declaration, at entry.
    fn declaration(&mut self, decl: &Decl, timers: &[Timer], at: Slot) {
        match decl {
            Decl::With(items) => {
                let worn = self.put_on(items);
                self.frame.declared_overlays.extend(worn);
            }
            Decl::Signal(var, e) => {
                self.update_timers(timers, at, None);
                let to = self.frame.vars[*var];
                self.scratch(|l| l.expr_into(e, to));
            }
            Decl::Area(var, e) => {
                let to = self.frame.vars[*var];
                let name = self.vars[*var].name.clone();
                self.program.mission.areas.push(NamedArea { name, at: to });
                self.scratch(|l| l.expr_into(e, to));
            }
            Decl::Memory(var, init) => {
                let to = self.frame.vars[*var];
                // Nothing is known of its order: no number that a key can read is this one.
                let sorted_by = self.frame.sorters.get(var).and_then(|sorter| sorter.sorted_by.clone());
                for by in sorted_by.iter().flatten() {
                    self.emit(Compute::Const { to: by.then, value: f64::MAX });
                }
                match init {
                    Some(e) => {
                        self.scratch(|l| l.expr_into(e, to));
                        self.sort(*var);
                    }
                    None => {
                        let words = self.words(&self.vars[*var].ty);
                        self.emit(Compute::Clear { to, words });
                    }
                }
            }
        }
    }

    fn abort(&mut self, id: usize, why: &[hir::TextPart], condition: &Expr) -> Abort {
        let value = self.lasting(1);
        let entry = self.here();
        self.scratch(|l| l.expr_into(condition, value));
        let why = self.text(why);
        self.emit(Op::Return);
        Abort {
            text: self.sources.text(condition.span).to_string(),
            place: self.sources.place(condition.span),
            condition: Code { entry, value },
            watched: self.watched(id, condition),
            terms: self.terms(id, condition),
            why,
        }
    }

    fn mission_parts(&mut self, mission: &hir::Mission) {
        let within = mission.within.as_ref().map(|e| self.ticks_code(e));
        let mut limits = Limits::default();
        for (channel, least, e) in &mission.limits {
            let code = Some(self.code(e));
            let bounds = &mut limits.setpoints[*channel as usize];
            *(if *least { &mut bounds.least } else { &mut bounds.greatest }) = code;
        }
        limits.turn_rate_max = mission.turn_rate.as_ref().map(|e| self.code(e));
        limits.latency_max = mission.latency.as_ref().map(|e| self.ticks_code(e));
        let mut requires = Vec::new();
        for require in &mission.requires {
            requires.push(Require {
                input: require.input as u32,
                fresh: self.ticks_code(&require.fresh),
                at_first: require.at_first.as_ref().map(|e| self.code(e)),
                hold_for: require.hold_for.as_ref().map(|e| self.ticks_code(e)),
            });
        }
        let recovery = mission.recovery.as_ref().map(|(within, block)| {
            let within = within.as_ref().map(|e| self.ticks_code(e));
            let activity = self.block_activity("recovery", ActivityKind::Recovery, |l, _| l.stmts(&block.stmts));
            Recovery { activity, within }
        });
        let lowered = &mut self.program.mission;
        lowered.within = within;
        lowered.limits = limits;
        lowered.requires = requires;
        lowered.recovery = recovery;
    }

    /// A block that is an activity of its own, in the frame of what it stands in: it can be entered, stand still and be left
    /// like any other.
    pub(super) fn block_activity(&mut self, name: &str, kind: ActivityKind, body: impl FnOnce(&mut Self, Slot)) -> u32 {
        let outer = (self.frame.header, self.frame.result, std::mem::take(&mut self.frame.overlays));
        let at = self.lasting(header::WORDS);
        (self.frame.header, self.frame.result) = (at, at);
        let nothing = self.emit(Op::Return);
        let entry = self.here();
        body(self, at);
        self.emit(Op::End);
        let overlays = std::mem::replace(&mut self.frame.overlays, outer.2);
        (self.frame.header, self.frame.result) = (outer.0, outer.1);
        self.program.activities.push(Activity {
            name: name.to_string(),
            place: String::new(),
            kind,
            header: at,
            entry: nothing,
            refresh: nothing,
            aborts: Vec::new(),
            reactions: nothing,
            body: Body::Sequence(entry),
            overlays,
            result: None,
        });
        self.program.activities.len() as u32 - 1
    }
}
