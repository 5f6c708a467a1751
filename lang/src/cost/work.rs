//! The most work of one tick.

use super::bill::Bill;
use super::places;
use super::weight::{capacity, in_order, weight};
use crate::check::takes_time;
use crate::hir::{
    self, Action, Activity, ActivityId, Block, Body, Builtin, ClauseArg, ClauseUse, Decl, Expr, ExprKind, FnId, Hir,
    InputPart, RowPlan, Stmt, StmtKind, Target, TextPart, Timed, Var, With, children,
};
use crate::source::{Sources, Span};
use crate::types::{Type, TypeTable};
use albacore_geometry::ROWS_MAX;
use std::collections::BTreeMap;

/// So many words are copied in the 10 ns that a million steps to a tick leave room for ten times over.
const WORDS_A_STEP: u64 = 8;
/// The edges of an area are gone through so often before its first row: for the longest, for the width, for the outermost rows, and
/// to count the rows on the lines, whose number may be halved ten times.
const ACROSS: u64 = 4 + 11;
/// And so often for each row: which of them its line crosses, and where, in which order.
const A_ROW: u64 = 2;

/// A loop that goes round within a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Round {
    /// Where it stands, `file:line`.
    pub place: String,
    /// And in the source.
    pub span: Span,
    /// The most rounds.
    pub rounds: u64,
    /// The steps of all of them.
    pub steps: u64,
}

/// What an activity takes.
#[derive(Clone, Default)]
struct Costs {
    /// To be entered.
    begin: Bill,
    /// To be stepped, once it is.
    tick: Bill,
}

struct Work<'a> {
    hir: &'a Hir,
    types: &'a TypeTable,
    fns: BTreeMap<FnId, u64>,
    activities: BTreeMap<ActivityId, Costs>,
    loops: BTreeMap<Span, (u64, u64)>,
}

/// What was counted.
pub(super) struct Tally {
    /// The steps of the dearest tick.
    pub bill: Bill,
    /// The steps of what no activity computes: a scenario, a test.
    pub apart: u64,
    /// The loops that go round within a tick, the dearest first.
    pub loops: Vec<Round>,
    /// The functions that are called, and what a call of each takes; the dearest first.
    pub functions: Vec<(FnId, u64)>,
}

/// The bill of the dearest tick, and the loops in it.
pub(super) fn of_mission(hir: &Hir, types: &TypeTable, sources: &Sources, mission: ActivityId) -> Tally {
    let mut work = Work::new(hir, types);
    let Costs { begin, tick } = work.activity(mission);
    let (recovery_begins, recovery_goes_on) = work.recovery(mission);
    // In one tick a mission begins, or goes on and may begin its recovery, or is recovering.
    let begin = begin.and(&Bill::of(mission, work.numbers(mission)));
    let bill = begin.or(tick.and(&recovery_begins)).or(recovery_goes_on);
    work.tally(bill, 0, |span| sources.place(span))
}

/// What it takes to compute a scenario.
pub(super) fn of_scenario(hir: &Hir, types: &TypeTable, scenario: usize) -> Tally {
    let mut work = Work::new(hir, types);
    let scenario = &hir.scenarios[scenario];
    let mut steps = work.exprs(scenario.defaults.iter().flatten());
    for clause in &scenario.clauses {
        steps = steps.saturating_add(work.clause(clause));
    }
    work.tally(Bill::default(), steps, |_| String::new())
}

/// What it takes to look at the expectations of a test.
pub(super) fn of_test(hir: &Hir, types: &TypeTable, test: usize) -> Tally {
    let mut work = Work::new(hir, types);
    let test = &hir.tests[test];
    let exprs = test.expects.iter().map(|expect| &expect.holds).chain(test.depths.iter().map(|(point, _)| point));
    let steps = work.exprs(exprs);
    work.tally(Bill::default(), steps, |_| String::new())
}

impl<'a> Work<'a> {
    fn new(hir: &'a Hir, types: &'a TypeTable) -> Self {
        Work { hir, types, fns: BTreeMap::new(), activities: BTreeMap::new(), loops: BTreeMap::new() }
    }

    fn tally(self, bill: Bill, apart: u64, place: impl Fn(Span) -> String) -> Tally {
        let round = |(span, (rounds, steps)): (Span, (u64, u64))| Round { place: place(span), span, rounds, steps };
        let mut loops: Vec<Round> = self.loops.into_iter().map(round).collect();
        loops.sort_by(|a, b| b.steps.cmp(&a.steps).then_with(|| a.span.cmp(&b.span)));
        let mut functions: Vec<(FnId, u64)> = self.fns.into_iter().collect();
        functions.sort_by_key(|(id, steps)| (std::cmp::Reverse(*steps), *id));
        Tally { bill, apart, loops, functions }
    }

    fn clause(&mut self, clause: &'a ClauseUse) -> u64 {
        clause.args.iter().fold(1, |steps: u64, (_, arg)| {
            steps.saturating_add(match arg {
                ClauseArg::Value(e) => self.expr(e),
                ClauseArg::Nested(inner) => self.clause(inner),
            })
        })
    }

    /// For how many corners areas have room.
    fn corners(&self) -> u64 {
        u64::from(self.types.area_room)
    }

    /// What it takes to move a value about: large ones are copied.
    fn moved(&self, ty: &Type) -> u64 {
        u64::from(self.types.words(ty)) / WORDS_A_STEP
    }

    /// What a mission computes once, as it begins: its parameters, its limits, what it requires.
    fn numbers(&mut self, mission: ActivityId) -> u64 {
        let activity = &self.hir.activities[mission];
        let mut steps = self.exprs(activity.defaults.iter().flatten());
        if let Some(parts) = &activity.mission {
            steps = sum([
                steps,
                self.exprs(&parts.within),
                self.exprs(parts.limits.iter().map(|(_, _, e)| e).chain(&parts.turn_rate).chain(&parts.latency)),
            ]);
            for require in &parts.requires {
                let asked = [&require.at_first, &require.hold_for].into_iter().flatten();
                // Once while the first samples are awaited, and once more at the start.
                steps = sum([steps, self.exprs(asked.chain([&require.fresh])).saturating_mul(2)]);
            }
        }
        steps
    }

    fn expr(&mut self, e: &'a Expr) -> u64 {
        match &e.kind {
            // Only one of the two ways is gone.
            ExprKind::If(condition, a, b) => {
                let dearer = self.value(a, &[]).max(self.value(b, &[]));
                sum([1, self.expr(condition), dearer])
            }
            ExprKind::Match(on, arms, otherwise) => {
                let arms = arms.iter().map(|(_, block)| block).chain(otherwise);
                let dearest = arms.map(|block| self.value(block, &[])).max().unwrap_or(0);
                sum([1, self.expr(on), dearest])
            }
            ExprKind::Call(id, args) => {
                let args: u64 = args.iter().map(|arg| self.expr(arg)).fold(0, u64::saturating_add);
                sum([1, args, self.function(*id), self.moved(&e.ty)])
            }
            kind => {
                let weight = match kind {
                    // Grids of each number of rows are tried.
                    ExprKind::Do(Builtin::Map, _) => 1 + self.corners() + capacity(Some(&e.ty)),
                    ExprKind::Do(op, operands) => weight(*op, operands, self.corners()),
                    ExprKind::Input(_, InputPart::Hits(_, of)) => 1 + u64::from(*of),
                    _ => 1,
                };
                let mut inside = Vec::new();
                children(e, &mut |child| inside.push(child));
                let weight = weight.saturating_add(self.moved(&e.ty));
                inside.into_iter().fold(weight, |steps, child| steps.saturating_add(self.expr(child)))
            }
        }
    }

    fn exprs(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) -> u64 {
        exprs.into_iter().fold(0, |steps, e| steps.saturating_add(self.expr(e)))
    }

    fn text(&mut self, parts: &'a [TextPart]) -> u64 {
        parts.iter().fold(0, |steps, part| match part {
            TextPart::Literal(_) => steps + 1,
            TextPart::Hole(e) => steps.saturating_add(self.expr(e)),
        })
    }

    fn function(&mut self, id: FnId) -> u64 {
        if let Some(known) = self.fns.get(&id) {
            return *known;
        }
        let function = &self.hir.fns[id];
        let steps = self.value(&function.body, &function.vars);
        self.fns.insert(id, steps);
        steps
    }

    /// A block and its value.
    fn value(&mut self, block: &'a Block, vars: &'a [Var]) -> u64 {
        let value = block.value.as_ref().map_or(0, |e| self.expr(e));
        self.instant(block, vars).saturating_add(value)
    }

    /// What is instantaneous in a block: in a tick none of it is done more often than once for each round of its loops.
    fn instant(&mut self, block: &'a Block, vars: &'a [Var]) -> u64 {
        block.stmts.iter().fold(0, |steps, stmt| steps.saturating_add(self.stmt(stmt, vars)))
    }

    fn stmt(&mut self, stmt: &'a Stmt, vars: &'a [Var]) -> u64 {
        let steps = match &stmt.kind {
            StmtKind::Set(var, e) => sum([self.expr(e), self.sort(*var, vars)]),
            StmtKind::Insert(var, e) | StmtKind::Remove(var, e) => {
                let list = vars.get(*var).map(|v| &v.ty);
                // A list that is full is put in order before its last goes, and after.
                let times = if matches!(stmt.kind, StmtKind::Insert(..)) { 2 } else { 1 };
                let sorted = self.sort(*var, vars).saturating_mul(times);
                sum([self.expr(e), capacity(list), list.map_or(0, |ty| self.moved(ty)), sorted])
            }
            StmtKind::Clear(_) => 0,
            StmtKind::Replace(var, index, e) => sum([self.exprs([index, e]), self.moved(&e.ty), self.sort(*var, vars)]),
            StmtKind::If(condition, a, b) => {
                let dearer = self.instant(a, vars).max(self.instant(b, vars));
                sum([self.expr(condition), dearer])
            }
            StmtKind::Match(on, arms, otherwise) => {
                let arms = arms.iter().map(|(_, block)| block).chain(otherwise);
                let dearest = arms.map(|block| self.instant(block, vars)).max().unwrap_or(0);
                sum([self.expr(on), dearest])
            }
            StmtKind::ForRange { first, last, inclusive, body, .. } => {
                let rounds = last.range.high - first.range.low + if *inclusive { 1.0 } else { 0.0 };
                let rounds = if rounds.is_finite() { rounds.max(0.0) as u64 } else { u64::MAX };
                sum([self.exprs([first, last]), self.rounds(stmt.span, rounds, 0, body, vars)])
            }
            StmtKind::ForList { list, body, .. } => {
                let held = capacity(Some(&list.ty));
                // An element is looked up, and becomes the value of the loop's name.
                let element = list.ty.element().map_or(0, |inner| self.moved(inner).saturating_mul(2));
                sum([self.expr(list), held, self.rounds(stmt.span, held, element, body, vars)])
            }
            StmtKind::ForEdges { area, body, .. } => {
                sum([self.expr(area), self.rounds(stmt.span, self.corners(), 0, body, vars)])
            }
            StmtKind::ForRows { rows, body, .. } => {
                let RowPlan { area, step, along, near } = &**rows;
                let across = ACROSS * (self.corners() + u64::from(ROWS_MAX) / WORDS_A_STEP);
                let rows = self.rounds(stmt.span, u64::from(ROWS_MAX), A_ROW * self.corners(), body, vars);
                sum([self.exprs([area, step, near].into_iter().chain(along)), across, rows])
            }
            // Each round takes time: in a tick one ends and the next begins.
            StmtKind::While { condition, body, .. } => {
                sum([self.expr(condition).saturating_mul(2), self.instant(body, vars)])
            }
            StmtKind::Loop(body) => self.instant(body, vars),
            StmtKind::With(items, body) => {
                let items = self.with(items);
                sum([items, self.instant(body, vars)])
            }
            // What takes time is counted where it begins and where it goes on.
            StmtKind::Timed(_) => 0,
            StmtKind::Finish(value) => value.as_ref().map_or(0, |e| self.expr(e)),
            StmtKind::Abort(parts) | StmtKind::Log(parts) => self.text(parts),
            StmtKind::Report { fields, .. } => self.exprs(fields.iter().map(|(_, e)| e)),
        };
        steps.saturating_add(1)
    }

    /// The rounds of a loop within a tick: one, when each takes time. Each takes so much to find what it is about.
    fn rounds(&mut self, span: Span, rounds: u64, finding: u64, body: &'a Block, vars: &'a [Var]) -> u64 {
        let round = sum([1, finding, self.instant(body, vars)]);
        if takes_time(body) {
            return round;
        }
        let steps = round.saturating_mul(rounds);
        self.loops.insert(span, (rounds, steps));
        steps
    }

    /// Putting an ordered list in order.
    fn sort(&mut self, var: usize, vars: &'a [Var]) -> u64 {
        let Some(var) = vars.get(var) else { return 0 };
        let Some(order) = &var.order else { return 0 };
        let held = capacity(Some(&var.ty));
        let compared = in_order(held);
        // Each element is put where its key finds it, and back; and all of them are put where they belong.
        let moved = self.moved(&var.ty).saturating_mul(4);
        // The keys are computed to see whether there is anything to do, and to do it.
        let keys = held.saturating_mul(self.expr(&order.key)).saturating_mul(2);
        sum([keys, compared, moved])
    }

    /// The arguments and setpoints of `with`; what the overlays do is their own.
    fn with(&mut self, items: &'a [With]) -> u64 {
        items.iter().fold(0, |steps, item| match item {
            With::Setpoint(_, e) => sum([steps, 1, self.expr(e)]),
            With::Overlay(_, args, _) => sum([steps, 1, self.exprs(args)]),
        })
    }

    /// The update of the temporal operators in a condition, and the condition.
    fn watched(&mut self, condition: &'a Expr) -> u64 {
        self.expr(condition).saturating_mul(2)
    }

    fn activity(&mut self, id: ActivityId) -> Costs {
        if let Some(known) = self.activities.get(&id) {
            return known.clone();
        }
        let activity = &self.hir.activities[id];
        let vars = self.unit_vars(activity);
        let mut entry = 1;
        let mut each_tick = 1;
        for decl in &activity.decls {
            match decl {
                Decl::With(items) => entry = sum([entry, self.with(items)]),
                Decl::Signal(_, e) => {
                    let steps = self.watched(e).saturating_add(1);
                    entry = sum([entry, steps]);
                    each_tick = sum([each_tick, steps]);
                }
                Decl::Memory(var, init) => {
                    let sort = self.sort(*var, vars);
                    let init = init.as_ref().map_or(1, |e| sum([self.expr(e), 1, sort]));
                    entry = sum([entry, init]);
                    each_tick = sum([each_tick, sort]);
                }
                Decl::Area(_, e) => entry = sum([entry, 1, self.expr(e)]),
            }
        }
        for (why, condition) in &activity.aborts {
            let steps = sum([self.watched(condition), self.text(why)]);
            (entry, each_tick) = (sum([entry, steps]), sum([each_tick, steps]));
        }
        for (condition, block) in &activity.reactions {
            let steps = sum([self.watched(condition), self.instant(block, vars)]);
            (entry, each_tick) = (sum([entry, steps]), sum([each_tick, steps]));
        }
        let required = activity.mission.as_ref().map_or(0, |m| m.requires.len() as u64);
        let mut costs = Costs { begin: Bill::of(id, entry), tick: Bill::of(id, each_tick.saturating_add(required)) };
        // All that may be worn at once; each is entered once at most.
        for overlay in places::overlays(activity) {
            let worn = self.activity(overlay);
            costs.begin = costs.begin.and(&worn.begin);
            costs.tick = costs.tick.and(&worn.begin).and(&worn.tick);
        }
        match &activity.body {
            Body::Sequence(block) => {
                let (begins, goes_on) = self.body(id, block, vars);
                costs.begin = costs.begin.and(&begins);
                costs.tick = costs.tick.and(&goes_on);
            }
            Body::Amend { block, .. } => {
                // The command of the tick in which it is put on is amended too.
                let value = Bill::of(id, self.value(block, vars));
                costs.begin = costs.begin.and(&value);
                costs.tick = costs.tick.and(&value);
            }
            Body::Table { start, behaviors, .. } => {
                let first = behaviors.get(*start).map(|&b| self.activity(b).begin).unwrap_or_default();
                costs.begin = costs.begin.and(&first);
                costs.tick = costs.tick.and(&self.table(id, activity, vars));
            }
        }
        self.activities.insert(id, costs.clone());
        costs
    }

    /// The variables that an activity's code sees: those of the unit that it is nested in.
    fn unit_vars(&self, activity: &'a Activity) -> &'a [Var] {
        let mut unit = activity;
        while let Some(owner) = unit.owner {
            unit = &self.hir.activities[owner];
        }
        &unit.vars
    }

    /// A body of statements: what it takes to begin it, and to go on with it in a tick. Then one statement that takes time
    /// goes on, and may end; what is instantaneous after it is done; and the next begins.
    fn body(&mut self, id: ActivityId, block: &'a Block, vars: &'a [Var]) -> (Bill, Bill) {
        let straight = Bill::of(id, self.instant(block, vars));
        let (mut begins, mut goes_on) = (Bill::default(), Bill::default());
        let mut timed = Vec::new();
        outer_timed(block, &mut timed);
        for timed in timed {
            let (begin, tick) = self.timed(id, timed, vars);
            begins = begins.or(begin);
            goes_on = goes_on.or(tick);
        }
        (straight.clone().and(&begins), straight.and(&begins).and(&goes_on))
    }

    /// A statement that takes time: to begin it, and to go on with it.
    fn timed(&mut self, id: ActivityId, timed: &'a Timed, vars: &'a [Var]) -> (Bill, Bill) {
        let until = timed.until.as_ref().map_or(0, |e| self.watched(e));
        let frozen = self.exprs(timed.duration.iter().chain(&timed.within).chain(timed.at.iter().map(|(_, e)| e)));
        let (args, again, inside) = match &timed.action {
            Action::Guide(_, args) => {
                let args = self.exprs(args);
                (args, args, None)
            }
            Action::Keep(_, e) => {
                let e = self.expr(e);
                (e, e, None)
            }
            Action::Call(callee, args) => (self.exprs(args), 0, Some(self.activity(*callee))),
            Action::Watch => (0, 0, None),
            Action::Ask(..) => (1, 1, None),
            Action::Override(o) => {
                let answer = self.exprs(&o.answer);
                // The block begins on the tick of the answer.
                let (begin, tick) = self.body(id, &o.block, vars);
                (answer, 2, Some(Costs { begin: Bill::default(), tick: tick.or(begin) }))
            }
        };
        let inside = inside.unwrap_or_default();
        let begin = Bill::of(id, sum([1, until, frozen, args])).and(&inside.begin);
        (begin, Bill::of(id, sum([1, until, again])).and(&inside.tick))
    }

    /// A switching table: the rules of a behavior, tried before it and when it is done; the behavior; a switch.
    fn table(&mut self, id: ActivityId, activity: &'a Activity, vars: &'a [Var]) -> Bill {
        let Body::Table { behaviors, rules, .. } = &activity.body else { return Bill::default() };
        let returns = rules.iter().any(|rule| rule.back);
        let (mut dearest, mut all, mut dearest_switch) = (Bill::default(), Bill::default(), Bill::default());
        for (&behavior, leaving) in behaviors.iter().zip(hir::leaving(rules, behaviors.len())) {
            let mut guards: u64 = 0;
            let mut switch = Bill::default();
            for rule in leaving.into_iter().map(|i| &rules[i]) {
                guards = sum([guards, self.watched(&rule.on), self.expr(&rule.on)]);
                let effect = rule.effect.as_ref().map_or(0, |block| self.instant(block, vars));
                let fired = match &rule.target {
                    Target::Behavior(to) => match behaviors.get(*to) {
                        Some(&to) => self.activity(to).begin,
                        None => Bill::default(),
                    },
                    Target::Finish(value) => Bill::of(id, self.exprs(value)),
                    Target::Abort(why) => Bill::of(id, self.text(why)),
                };
                switch = switch.or(fired.and(&Bill::of(id, effect.saturating_add(1))));
            }
            let stepped = Bill::of(id, guards).and(&self.activity(behavior).tick);
            all = all.and(&stepped);
            dearest_switch = dearest_switch.or(switch.clone());
            dearest = dearest.or(stepped.and(&switch));
        }
        // Of behaviors that wait for one another each may be done and the next go on in one tick (rule 12).
        if returns { all.and(&dearest_switch) } else { dearest }
    }

    /// The recovery of a mission: to begin it, and to go on with it, with the mission's signals and overlays.
    fn recovery(&mut self, mission: ActivityId) -> (Bill, Bill) {
        let activity = &self.hir.activities[mission];
        let Some((within, block)) = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()) else {
            return (Bill::default(), Bill::default());
        };
        let (begins, goes_on) = self.body(mission, block, &activity.vars);
        let mut around = Bill::of(mission, self.exprs(within));
        for decl in &activity.decls {
            if let Decl::Signal(_, e) = decl {
                around = around.and(&Bill::of(mission, self.watched(e).saturating_add(1)));
            }
        }
        for overlay in places::overlays(activity) {
            around = around.and(&self.activity(overlay).tick);
        }
        (begins, goes_on.and(&around))
    }
}

/// The statements that take time in a block and the blocks inside it, but for those of overrides, which are inside one.
fn outer_timed<'a>(block: &'a Block, found: &mut Vec<&'a Timed>) {
    for stmt in &block.stmts {
        match &stmt.kind {
            StmtKind::Timed(timed) => found.push(timed),
            _ => stmt.blocks().into_iter().for_each(|block| outer_timed(block, found)),
        }
    }
}

fn sum<const N: usize>(steps: [u64; N]) -> u64 {
    steps.into_iter().fold(0, u64::saturating_add)
}
