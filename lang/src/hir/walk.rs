//! Walks over the checked program: the statements of a block, the expressions of anything.

use super::{
    Action, Activity, ActivityId, Block, Body, Decl, Expr, ExprKind, FnId, Hir, InputPart, Kind, RowPlan, Stmt,
    StmtKind, Target, TextPart, With,
};
use crate::source::Span;
use crate::types::Type;
use std::collections::{BTreeMap, BTreeSet};

impl Hir {
    /// An activity and all to which it leads: its own behaviors, what it calls, the overlays that it puts on.
    pub fn called_from(&self, activity: ActivityId) -> BTreeSet<ActivityId> {
        let mut called = BTreeSet::new();
        let mut ahead = vec![activity];
        while let Some(id) = ahead.pop() {
            if called.insert(id) {
                ahead.extend(self.activities[id].calls());
            }
        }
        called
    }

    /// What a mission and all that it calls report, by name: for each place that does the labels, of which the first is empty, with the types
    /// of what stands behind them.
    pub fn reports(&self, mission: ActivityId) -> BTreeMap<String, Vec<BTreeMap<String, Type>>> {
        let mut types = BTreeMap::<String, Vec<BTreeMap<String, Type>>>::new();
        self.each_report(mission, &mut |name, fields| {
            let labelled = fields.iter().map(|(label, value)| (label.clone(), value.ty.clone()));
            types.entry(name.to_string()).or_default().push(labelled.collect());
        });
        types
    }

    /// What a mission and all that it calls ask of payloads, each with the first place where they do.
    pub fn asks(&self, mission: ActivityId) -> BTreeMap<String, Span> {
        let mut asks = BTreeMap::new();
        for block in self.called_from(mission).into_iter().flat_map(|id| self.activities[id].blocks()) {
            block.each(&mut |stmt| {
                if let StmtKind::Timed(timed) = &stmt.kind
                    && let Action::Ask(payload, action) = timed.action
                {
                    asks.entry(self.payloads[payload].action(action)).or_insert(stmt.span);
                }
            });
        }
        asks
    }

    /// The names of the inputs that a mission and all that it calls record, each once.
    pub fn recorded(&self, mission: ActivityId) -> Vec<String> {
        let recordings = self.called_from(mission).into_iter().flat_map(|id| &self.activities[id].recordings);
        let names =
            recordings.flat_map(|recording| &recording.inputs).map(|(input, _)| self.inputs[*input].name.clone());
        names.collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// Why a mission and all that it calls may abort it, as far as they say so.
    pub fn abort_reasons(&self, mission: ActivityId) -> Vec<&[TextPart]> {
        let mut reasons = Vec::new();
        for activity in self.called_from(mission).into_iter().map(|id| &self.activities[id]) {
            reasons.extend(activity.aborts.iter().map(|(why, _)| why.as_slice()));
            if let Body::Table { rules, .. } = &activity.body {
                let targets = rules.iter().map(|rule| &rule.target);
                reasons.extend(
                    targets.filter_map(|to| if let Target::Abort(why) = to { Some(why.as_slice()) } else { None }),
                );
            }
            for block in activity.blocks() {
                block.each(&mut |stmt| {
                    if let StmtKind::Abort(why) = &stmt.kind {
                        reasons.push(why);
                    }
                });
            }
        }
        reasons
    }

    /// Calls `f` on the name and the labelled values of every report of a mission and of all that it calls.
    pub fn each_report<'h>(&'h self, mission: ActivityId, f: &mut dyn FnMut(&'h str, &'h [(String, Expr)])) {
        for id in self.called_from(mission) {
            for block in self.activities[id].blocks() {
                block.each(&mut |stmt| {
                    if let StmtKind::Report { name, fields } = &stmt.kind {
                        f(name, fields);
                    }
                });
            }
        }
    }
}

impl Activity {
    /// The conditions of its reactions and rules: of what fires.
    pub fn conditions_that_fire(&self) -> impl Iterator<Item = &Expr> {
        let rules: &[super::Rule] = if let Body::Table { rules, .. } = &self.body { rules } else { &[] };
        self.reactions.iter().map(|(on, _)| on).chain(rules.iter().map(|rule| &rule.on))
    }

    /// Its own blocks of statements: reactions, body, what rules do, recovery.
    pub fn blocks(&self) -> Vec<&Block> {
        let mut blocks: Vec<&Block> = self.reactions.iter().map(|(_, block)| block).collect();
        match &self.body {
            Body::Sequence(block) | Body::Amend { block, .. } => blocks.push(block),
            Body::Table { rules, .. } => blocks.extend(rules.iter().filter_map(|rule| rule.effect.as_ref())),
        }
        blocks.extend(self.mission.iter().filter_map(|m| m.recovery.as_ref()).map(|(_, block)| block));
        blocks
    }

    /// Visits every expression of its own, as [`Expr::visit`] does.
    pub fn visit<'e>(&'e self, f: &mut dyn FnMut(&'e Expr) -> bool) {
        activity_children(self, &mut |e| e.visit(f));
    }

    /// Whether its name tells what it does: it is a behavior of a single statement that takes time, and does that once.
    pub fn is_told_by_name(&self) -> bool {
        let does_one_thing = matches!(&self.body, Body::Sequence(block) if block.beginnings() <= 1);
        self.kind == Kind::Behavior && does_one_thing
    }

    /// The activities that it names itself.
    pub fn calls(&self) -> Vec<ActivityId> {
        let mut calls: Vec<ActivityId> = self.calls_with_args().into_iter().map(|(id, _)| id).collect();
        if let Body::Table { behaviors, .. } = &self.body {
            calls.extend(behaviors);
        }
        calls
    }

    /// The arguments that it gives to an activity, call by call.
    pub fn calls_of(&self, called: ActivityId) -> Vec<&[Expr]> {
        self.calls_with_args().into_iter().filter(|(id, _)| *id == called).map(|(_, args)| args).collect()
    }

    /// Its calls, and the overlays that it puts on, each with its arguments.
    pub fn calls_with_args(&self) -> Vec<(ActivityId, &[Expr])> {
        let mut calls = Vec::new();
        let mut blocks: Vec<&Block> = Vec::new();
        if let Body::Sequence(block) | Body::Amend { block, .. } = &self.body {
            blocks.push(block);
        }
        blocks.extend(self.mission.iter().filter_map(|m| m.recovery.as_ref()).map(|(_, block)| block));
        for decl in &self.decls {
            if let Decl::With(items) = decl {
                calls.extend(overlays(items));
            }
        }
        for block in blocks {
            block.each(&mut |stmt| match &stmt.kind {
                StmtKind::With(items, _) => calls.extend(overlays(items)),
                StmtKind::Timed(timed) => {
                    if let Action::Call(id, args) = &timed.action {
                        calls.push((*id, args.as_slice()));
                    }
                }
                _ => {}
            });
        }
        calls
    }
}

/// The functions that a block calls.
pub fn calls_in(block: &Block) -> Vec<FnId> {
    let mut calls = Vec::new();
    block.visit(&mut |e| {
        if let ExprKind::Call(id, _) = e.kind {
            calls.push(id);
        }
        true
    });
    calls
}

/// The overlays among what `with` puts in force.
fn overlays(items: &[With]) -> impl Iterator<Item = (ActivityId, &[Expr])> {
    items.iter().filter_map(|item| match item {
        With::Overlay(id, args, _) => Some((*id, args.as_slice())),
        With::Setpoint(..) => None,
    })
}

impl StmtKind {
    /// Whether what is inside it may begin again.
    fn is_loop(&self) -> bool {
        use StmtKind::{ForEdges, ForList, ForRange, ForRows, Loop, While};
        matches!(self, ForRange { .. } | ForList { .. } | ForEdges { .. } | ForRows { .. } | While { .. } | Loop(_))
    }
}

impl Stmt {
    /// The blocks directly inside it.
    pub fn blocks(&self) -> Vec<&Block> {
        match &self.kind {
            StmtKind::If(_, a, b) => vec![a, b],
            StmtKind::Match(_, arms, otherwise) => arms.iter().map(|(_, b)| b).chain(otherwise).collect(),
            StmtKind::With(_, body)
            | StmtKind::Loop(body)
            | StmtKind::ForRange { body, .. }
            | StmtKind::ForList { body, .. }
            | StmtKind::ForEdges { body, .. }
            | StmtKind::ForRows { body, .. }
            | StmtKind::While { body, .. } => vec![body],
            StmtKind::Timed(timed) => match &timed.action {
                Action::Override(o) => vec![&o.block],
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }
}

impl Block {
    /// How many statements in it take time; more than one where a single one may begin again.
    pub fn beginnings(&self) -> usize {
        let of = |stmt: &Stmt| {
            let inside: usize = stmt.blocks().into_iter().map(Block::beginnings).sum();
            match &stmt.kind {
                StmtKind::Timed(_) => 1 + inside,
                kind if kind.is_loop() => inside.saturating_mul(2),
                _ => inside,
            }
        };
        self.stmts.iter().map(of).sum()
    }

    /// Calls `f` on every statement, each before those of the blocks inside it.
    pub fn each<'e>(&'e self, f: &mut dyn FnMut(&'e Stmt)) {
        for stmt in &self.stmts {
            f(stmt);
            stmt.blocks().into_iter().for_each(|block| block.each(f));
        }
    }

    /// Visits every expression of its statements, and of the blocks inside them, as [`Expr::visit`] does.
    pub fn visit<'e>(&'e self, f: &mut dyn FnMut(&'e Expr) -> bool) {
        block_children(self, &mut |e| e.visit(f));
    }

    /// The variables that its statements assign.
    pub fn assigned(&self) -> Vec<usize> {
        self.assignments().into_iter().map(|(var, _)| var).collect()
    }

    /// The variables that its statements assign, each with the number that it then is, where that is always the same.
    pub fn assignments(&self) -> Vec<(usize, Option<f64>)> {
        let mut assigned = Vec::new();
        self.each(&mut |stmt| match &stmt.kind {
            StmtKind::Set(var, value) => {
                let number = if let ExprKind::Number(x) = value.kind { Some(x) } else { value.range.constant() };
                assigned.push((*var, number));
            }
            StmtKind::Insert(var, _) | StmtKind::Remove(var, _) | StmtKind::Clear(var) | StmtKind::Replace(var, ..) => {
                assigned.push((*var, None))
            }
            _ => {}
        });
        assigned
    }
}

impl Expr {
    /// Visits it and what is inside it, outer expressions first; not what is inside one for which `f` gives `false`.
    pub fn visit<'e>(&'e self, f: &mut dyn FnMut(&'e Expr) -> bool) {
        if f(self) {
            children(self, &mut |child| child.visit(f));
        }
    }

    /// Whether it is such, or something inside it.
    pub fn contains(&self, is_such: impl Fn(&Expr) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |e| {
            found |= is_such(e);
            !found
        });
        found
    }

    /// How many parts it has: itself, and those of each in it.
    pub fn parts(&self) -> usize {
        let mut parts = 0;
        self.visit(&mut |_| {
            parts += 1;
            true
        });
        parts
    }

    /// Whether it has no more parts than so many: it is one, and so is each in it.
    pub fn is_within(&self, most: usize) -> bool {
        fn count(e: &Expr, left: &mut usize) {
            if let Some(less) = left.checked_sub(1) {
                *left = less;
                children(e, &mut |child| count(child, left));
            } else {
                *left = 0;
            }
        }
        // One more than there may be: then none is left exactly where there are too many.
        let mut left = most.saturating_add(1);
        count(self, &mut left);
        left > 0
    }
}

/// Calls `f` on the expressions directly inside one.
pub fn children<'e>(e: &'e Expr, f: &mut dyn FnMut(&'e Expr)) {
    match &e.kind {
        ExprKind::Present(a)
        | ExprKind::Unwrap(a)
        | ExprKind::IsPresent(a)
        | ExprKind::Part(a, _)
        | ExprKind::Becomes(a)
        | ExprKind::After(a)
        | ExprKind::Every(a) => f(a),
        ExprKind::Else(a, b) | ExprKind::HeldFor(a, b) => {
            f(a);
            f(b);
        }
        ExprKind::Do(_, list) | ExprKind::Call(_, list) | ExprKind::Record(list) | ExprKind::List(list) => {
            list.iter().for_each(f);
        }
        ExprKind::Changed(whole, fields) => {
            f(whole);
            fields.iter().for_each(|(_, e)| f(e));
        }
        ExprKind::If(condition, a, b) => {
            f(condition);
            block_children(a, f);
            block_children(b, f);
        }
        ExprKind::Match(on, arms, otherwise) => {
            f(on);
            for block in arms.iter().map(|(_, b)| b).chain(otherwise) {
                block_children(block, f);
            }
        }
        ExprKind::Input(_, InputPart::Hits(limit, _)) => f(limit),
        ExprKind::Text(parts) => text_children(parts, f),
        _ => {}
    }
}

fn text_children<'e>(parts: &'e [TextPart], f: &mut dyn FnMut(&'e Expr)) {
    for part in parts {
        if let TextPart::Hole(e) = part {
            f(e);
        }
    }
}

/// Calls `f` on every expression that stands directly in a block or in the blocks inside it.
pub fn block_children<'e>(block: &'e Block, f: &mut dyn FnMut(&'e Expr)) {
    for stmt in &block.stmts {
        match &stmt.kind {
            StmtKind::Set(_, e) | StmtKind::Insert(_, e) | StmtKind::Remove(_, e) => f(e),
            StmtKind::Replace(_, index, e) => {
                f(index);
                f(e);
            }
            StmtKind::If(e, a, b) => {
                f(e);
                block_children(a, f);
                block_children(b, f);
            }
            StmtKind::Match(e, arms, otherwise) => {
                f(e);
                for block in arms.iter().map(|(_, b)| b).chain(otherwise) {
                    block_children(block, f);
                }
            }
            StmtKind::ForRange { first, last, body, .. } => {
                f(first);
                f(last);
                block_children(body, f);
            }
            StmtKind::ForList { list: e, body, .. } | StmtKind::ForEdges { area: e, body, .. } => {
                f(e);
                block_children(body, f);
            }
            StmtKind::ForRows { rows, body, .. } => {
                let RowPlan { area, step, along, near } = &**rows;
                f(area);
                f(step);
                along.iter().for_each(&mut *f);
                f(near);
                block_children(body, f);
            }
            StmtKind::While { condition, body, .. } => {
                f(condition);
                block_children(body, f);
            }
            StmtKind::Loop(body) => block_children(body, f),
            StmtKind::With(items, body) => {
                with_children(items, f);
                block_children(body, f);
            }
            StmtKind::Timed(timed) => {
                match &timed.action {
                    Action::Guide(_, args) | Action::Call(_, args) => args.iter().for_each(&mut *f),
                    Action::Keep(_, e) => f(e),
                    Action::Watch | Action::Ask(..) => {}
                    Action::Override(o) => {
                        o.answer.iter().for_each(&mut *f);
                        block_children(&o.block, f);
                    }
                }
                [&timed.duration, &timed.until, &timed.within].into_iter().flatten().for_each(&mut *f);
                timed.at.iter().for_each(|(_, e)| f(e));
            }
            StmtKind::Finish(Some(e)) => f(e),
            StmtKind::Abort(parts) | StmtKind::Log(parts) => text_children(parts, f),
            StmtKind::Report { fields, .. } => fields.iter().for_each(|(_, e)| f(e)),
            StmtKind::Finish(None) | StmtKind::Clear(_) => {}
        }
    }
    if let Some(value) = &block.value {
        f(value);
    }
}

fn with_children<'e>(items: &'e [With], f: &mut dyn FnMut(&'e Expr)) {
    for item in items {
        match item {
            With::Setpoint(_, e) => f(e),
            With::Overlay(_, args, _) => args.iter().for_each(&mut *f),
        }
    }
}

/// Calls `f` on every expression of an activity, outermost ones only.
pub fn activity_children<'e>(activity: &'e Activity, f: &mut dyn FnMut(&'e Expr)) {
    for decl in &activity.decls {
        match decl {
            Decl::With(items) => with_children(items, f),
            Decl::Signal(_, e) | Decl::Area(_, e) | Decl::Memory(_, Some(e)) => f(e),
            Decl::Memory(_, None) => {}
        }
    }
    for (why, condition) in &activity.aborts {
        text_children(why, f);
        f(condition);
    }
    for (condition, block) in &activity.reactions {
        f(condition);
        block_children(block, f);
    }
    for var in &activity.vars {
        if let Some(order) = &var.order {
            f(&order.key);
        }
    }
    match &activity.body {
        Body::Sequence(block) | Body::Amend { block, .. } => block_children(block, f),
        Body::Table { rules, .. } => {
            for rule in rules {
                f(&rule.on);
                match &rule.target {
                    Target::Finish(Some(e)) => f(e),
                    Target::Abort(why) => text_children(why, f),
                    _ => {}
                }
                if let Some(effect) = &rule.effect {
                    block_children(effect, f);
                }
            }
        }
    }
    if let Some(mission) = &activity.mission {
        mission.within.iter().for_each(&mut *f);
        mission.limits.iter().for_each(|(_, _, e)| f(e));
        mission.turn_rate.iter().chain(&mission.latency).for_each(&mut *f);
        for require in &mission.requires {
            f(&require.fresh);
            require.at_first.iter().chain(&require.hold_for).for_each(&mut *f);
        }
        if let Some((within, block)) = &mission.recovery {
            within.iter().for_each(&mut *f);
            block_children(block, f);
        }
    }
}
