//! Temporal operators: each has a place in the frame, is set back when its watch begins and updated at every tick.

use super::Lowering;
use crate::hir::{self, Block, ClauseArg, Expr, ExprKind, Hir, InputPart, StmtKind, TextPart, With};
use albacore_program::{Op, Slot};

/// A temporal operator in place.
pub(super) enum Timer<'e> {
    HeldFor { node: &'e Expr, since: Slot, value: Slot },
    Becomes { node: &'e Expr, before: Slot, value: Slot },
    After { node: &'e Expr, value: Slot },
}

impl<'a> Lowering<'a> {
    /// Gives every temporal operator of some expressions its place. Inner ones come first.
    pub(super) fn place_timers<'e>(&mut self, conditions: impl IntoIterator<Item = &'e Expr>) -> Vec<Timer<'e>> {
        let mut nodes = Vec::new();
        for condition in conditions {
            temporal_nodes(condition, &mut nodes);
        }
        let mut timers = Vec::new();
        for node in nodes {
            let value = self.lasting(1);
            self.frame.timers.insert(std::ptr::from_ref(node) as usize, value);
            timers.push(match &node.kind {
                ExprKind::HeldFor(..) => Timer::HeldFor { node, since: self.lasting(1), value },
                ExprKind::Becomes(_) => Timer::Becomes { node, before: self.lasting(1), value },
                _ => Timer::After { node, value },
            });
        }
        timers
    }

    /// Code that sets timers back: nothing has held yet, and nothing has just become true.
    pub(super) fn reset_timers(&mut self, timers: &[Timer]) {
        for timer in timers {
            match timer {
                Timer::HeldFor { since, .. } => _ = self.emit(Op::Const { to: *since, value: -1.0 }),
                Timer::Becomes { before, .. } => _ = self.emit(Op::Const { to: *before, value: 1.0 }),
                Timer::After { .. } => {}
            }
        }
    }

    /// Code that updates timers. They count by the age of the activity whose header is `owner`; `after` counts from
    /// `from`, or from entry.
    pub(super) fn update_timers(&mut self, timers: &[Timer], owner: Slot, from: Option<Slot>) {
        for timer in timers {
            self.scratch(|l| match timer {
                Timer::HeldFor { node, since, value } => {
                    let ExprKind::HeldFor(holds, duration) = &node.kind else { return };
                    let x = l.expr(holds);
                    let ticks = l.ticks(duration);
                    l.emit(Op::HeldFor { to: *value, x, since: *since, ticks, owner });
                }
                Timer::Becomes { node, before, value } => {
                    let ExprKind::Becomes(holds) = &node.kind else { return };
                    let x = l.expr(holds);
                    l.emit(Op::Becomes { to: *value, x, before: *before });
                }
                Timer::After { node, value } => {
                    let ExprKind::After(duration) = &node.kind else { return };
                    let ticks = l.ticks(duration);
                    let from = from.unwrap_or_else(|| {
                        let zero = l.temp(1);
                        l.emit(Op::Const { to: zero, value: 0.0 });
                        zero
                    });
                    l.emit(Op::Elapsed { to: *value, from, ticks, owner });
                }
            });
        }
    }

    /// A duration in whole ticks.
    pub(super) fn ticks(&mut self, duration: &Expr) -> Slot {
        let seconds = self.expr(duration);
        let ticks = self.temp(1);
        self.emit(Op::Ticks { to: ticks, a: seconds });
        ticks
    }
}

/// The temporal operators of an expression, inner ones first.
fn temporal_nodes<'e>(e: &'e Expr, out: &mut Vec<&'e Expr>) {
    children(e, &mut |child| temporal_nodes(child, out));
    if matches!(e.kind, ExprKind::HeldFor(..) | ExprKind::Becomes(_) | ExprKind::After(_)) {
        out.push(e);
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
        | ExprKind::After(a) => f(a),
        ExprKind::Else(a, b) | ExprKind::HeldFor(a, b) => {
            f(a);
            f(b);
        }
        ExprKind::Do(_, list) | ExprKind::Call(_, list) | ExprKind::Record(list) | ExprKind::List(list) => {
            list.iter().for_each(f);
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
pub(super) fn block_children<'e>(block: &'e Block, f: &mut dyn FnMut(&'e Expr)) {
    for stmt in &block.stmts {
        match &stmt.kind {
            StmtKind::Set(_, e) | StmtKind::Insert(_, e) | StmtKind::Remove(_, e) => f(e),
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
            StmtKind::ForRows { area, step, body, .. } => {
                f(area);
                f(step);
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
                    hir::Action::Guide(_, args) | hir::Action::Call(_, args) => args.iter().for_each(&mut *f),
                    hir::Action::Keep(_, e) => f(e),
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
            With::Overlay(_, args) => args.iter().for_each(&mut *f),
        }
    }
}

/// Calls `f` on every expression of an activity, outermost ones only.
pub fn activity_children<'e>(activity: &'e hir::Activity, f: &mut dyn FnMut(&'e Expr)) {
    for decl in &activity.decls {
        match decl {
            hir::Decl::With(items) => with_children(items, f),
            hir::Decl::Signal(_, e) | hir::Decl::Area(_, e) | hir::Decl::Memory(_, Some(e)) => f(e),
            hir::Decl::Memory(_, None) => {}
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
        hir::Body::Sequence(block) | hir::Body::Amend { block, .. } => block_children(block, f),
        hir::Body::Table { rules, .. } => {
            for rule in rules {
                f(&rule.on);
                match &rule.target {
                    hir::Target::Finish(Some(e)) => f(e),
                    hir::Target::Abort(why) => text_children(why, f),
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

/// For each input the most samples that any `hits` counts back.
pub(super) fn samples_counted(hir: &Hir, kept: &mut [u32]) {
    fn walk(e: &Expr, kept: &mut [u32]) {
        if let ExprKind::Input(id, InputPart::Hits(_, of)) = &e.kind {
            kept[*id] = kept[*id].max(*of);
        }
        children(e, &mut |child| walk(child, kept));
    }
    for activity in &hir.activities {
        activity_children(activity, &mut |e| walk(e, kept));
    }
}

/// The first geodetic positions of an expression, to find the origin of a frame.
pub(super) fn positions(e: &Expr, out: &mut Vec<(f64, f64)>) {
    if let ExprKind::Geodetic { latitude_deg, longitude_deg } = e.kind {
        out.push((latitude_deg, longitude_deg));
    }
    children(e, &mut |child| positions(child, out));
}

/// All geodetic positions of a scenario.
pub(super) fn scenario_positions(clauses: &[hir::ClauseUse], out: &mut Vec<(f64, f64)>) {
    for clause in clauses {
        for (_, arg) in &clause.args {
            match arg {
                ClauseArg::Value(e) => positions(e, out),
                ClauseArg::Nested(inner) => scenario_positions(std::slice::from_ref(inner), out),
            }
        }
    }
}
