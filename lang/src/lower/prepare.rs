//! Callees before callers: whatever is called is lowered ahead of what calls it.

use super::{Lowering, UnitCode};
use crate::hir::{self, Action, Block, Decl, Expr, ExprKind, StmtKind, activity_children, block_children, children};

impl<'a> Lowering<'a> {
    /// A declaration of the left margin with its own frame, lowered when first needed.
    pub(super) fn unit(&mut self, id: usize) -> UnitCode {
        if let Some(unit) = self.units.get(&id) {
            return *unit;
        }
        let activity = &self.hir.activities[id];
        self.prepare_activity(id);
        let index = std::cell::Cell::new(0);
        let before = self.emitted;
        let words = self.twice(&activity.vars, |l| {
            l.sorters(&activity.vars);
            index.set(l.activity(id, 0));
        });
        let unit = UnitCode { activity: index.get(), words, ops: self.emitted - before };
        self.units.insert(id, unit);
        unit
    }

    /// Lowers all that an activity calls, ahead of it.
    fn prepare_activity(&mut self, id: usize) {
        let activity = &self.hir.activities[id];
        let mut exprs: Vec<&Expr> = Vec::new();
        activity_children(activity, &mut |e| exprs.push(e));
        for e in exprs {
            self.prepare(e);
        }
        for decl in &activity.decls {
            if let Decl::With(items) = decl {
                self.prepare_with(items);
            }
        }
        match &activity.body {
            hir::Body::Sequence(block) | hir::Body::Amend { block, .. } => self.prepare_units(block),
            hir::Body::Table { behaviors, .. } => {
                for &behavior in behaviors {
                    self.prepare_activity(behavior);
                }
            }
        }
        if let Some((_, block)) = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()) {
            self.prepare_units(block);
        }
    }

    /// Lowers the functions that an expression calls.
    pub(super) fn prepare(&mut self, e: &Expr) {
        let mut inner: Vec<&Expr> = Vec::new();
        children(e, &mut |child| inner.push(child));
        for child in inner {
            self.prepare(child);
        }
        if let ExprKind::Call(id, _) = e.kind {
            self.function(id);
        }
    }

    pub(super) fn prepare_block(&mut self, block: &Block) {
        let mut exprs: Vec<&Expr> = Vec::new();
        block_children(block, &mut |e| exprs.push(e));
        for e in exprs {
            self.prepare(e);
        }
    }

    fn prepare_with(&mut self, items: &[hir::With]) {
        for item in items {
            if let hir::With::Overlay(id, ..) = item {
                self.unit(*id);
            }
        }
    }

    fn prepare_units(&mut self, block: &Block) {
        block.each(&mut |stmt| match &stmt.kind {
            StmtKind::Timed(timed) => {
                if let Action::Call(id, _) = timed.action {
                    self.unit(id);
                }
            }
            StmtKind::With(items, _) => self.prepare_with(items),
            _ => {}
        });
    }
}
