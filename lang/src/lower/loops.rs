//! `for` to code: what is walked is fixed when the loop begins.

use super::Lowering;
use crate::check::goes_round;
use crate::hir::{self, Block, Expr, RowPlan};
use crate::types::Type;
use albacore_arithmetic::INT_MAX;
use albacore_arithmetic::Operator;
use albacore_program::{AreaOp, Compute, GRID_WORDS, ListOp, MapOp, ROW_PLACE_WORDS, ROWS_WORDS, Rounds, Slot, When};

impl<'a> Lowering<'a> {
    pub(super) fn for_range(&mut self, var: usize, first: &Expr, last: &Expr, inclusive: bool, body: &Block) {
        let (counter, end) = (self.lasting(1), self.lasting(1));
        self.scratch(|l| {
            l.expr_into(first, counter);
            l.expr_into(last, end);
        });
        let first_round = (body.beginnings() > 0).then(|| {
            let first = self.lasting(1);
            self.copy(first, counter, 1);
            first
        });
        let goes_on = |to| {
            match inclusive {
                true => [When::NotAtMost(counter, end), When::AtMost(counter, end)],
                false => [When::NotLess(counter, end), When::Less(counter, end)],
            }
            .map(|when| Compute::Jump { to, when })
        };
        // A loop may rely on it that this one takes time. Then there is no way past its first round, whatever the numbers are.
        let none = (!goes_round(first, last, inclusive)).then(|| self.emit(goes_on(0)[0]));
        let top = self.here();
        let to = self.frame.vars[var];
        self.copy(to, counter, 1);
        match first_round {
            Some(first) => self.walking(var, Rounds::Range { at: to, first, end, inclusive }, body),
            None => self.body(body),
        }
        let mut leaves: Vec<_> = none.into_iter().collect();
        if inclusive && last.range.high >= INT_MAX {
            // Where counting may come to its own end, nothing lies beyond the last: it is looked for before one is added.
            leaves.push(self.emit(Compute::Jump { to: 0, when: When::NotLess(counter, end) }));
            self.count_up(counter);
            self.emit(Compute::jump(top));
        } else {
            self.count_up(counter);
            self.emit(goes_on(top)[1]);
        }
        self.land_all(leaves);
    }

    pub(super) fn count_up(&mut self, counter: Slot) {
        self.scratch(|l| {
            let one = l.number(1.0);
            l.emit(Compute::two(Operator::AddInt, counter, counter, one));
        });
    }

    /// Walks a copy of the list or map, made at the start.
    pub(super) fn for_list(&mut self, (var, place): (usize, Option<usize>), list: &Expr, body: &Block) {
        let (inner, grid) = match &list.ty {
            Type::List(inner, _) => (inner, 0),
            Type::Map(inner, _) => (inner, GRID_WORDS),
            _ => return,
        };
        let (words, element) = (self.words(&list.ty), self.words(inner));
        let copy = self.lasting(words);
        let (counter, found) = (self.lasting(1), self.lasting(element.saturating_add(1)));
        self.scratch(|l| l.expr_into(list, copy));
        self.emit(Compute::Const { to: counter, value: 0.0 });
        // A loop may rely on it that one over a list that is written out takes time: there is no way past its first round.
        let end = match &list.kind {
            hir::ExprKind::List(elements) if !elements.is_empty() => {
                let end = self.lasting(1);
                self.emit(Compute::Const { to: end, value: elements.len() as f64 });
                Some(end)
            }
            _ => None,
        };
        let top = self.here();
        let cells = copy.saturating_add(grid);
        self.emit(ListOp::At { to: found, list: cells, index: counter, words: element });
        self.typed(found.saturating_add(1), inner);
        let done = end.is_none().then(|| self.emit(Compute::jump_unless(found, 0)));
        let to = self.frame.vars[var];
        self.copy(to, found + 1, element);
        if let Some(place) = place {
            let to = self.frame.vars[place];
            self.emit(MapOp::CenterOf { to, map: copy, index: counter });
        }
        self.walking(var, Rounds::Behind(counter, cells), body);
        self.count_up(counter);
        self.emit(match end {
            Some(end) => Compute::Jump { to: top, when: When::Less(counter, end) },
            None => Compute::jump(top),
        });
        self.land_all(done.into_iter().collect());
    }

    /// An area that cannot change while it is walked stays where it is; any other is copied.
    fn walked_area(&mut self, area: &Expr) -> Slot {
        match area.kind {
            hir::ExprKind::Var(id) if self.vars[id].kind.is_fixed() => self.frame.vars[id],
            _ => {
                let copy = self.lasting(self.words(&Type::Area));
                self.scratch(|l| l.expr_into(area, copy));
                copy
            }
        }
    }

    /// What all rows have in common is computed at the start, each row when its turn comes, until there are none left.
    pub(super) fn for_rows(&mut self, var: usize, plan: &RowPlan, body: &Block) {
        let area = self.walked_area(&plan.area);
        let (rows, place, counter) = (self.lasting(ROWS_WORDS), self.lasting(ROW_PLACE_WORDS), self.lasting(1));
        self.scratch(|l| {
            let step = l.expr(&plan.step);
            let along = plan.along.as_ref().map(|along| l.expr(along));
            let near = l.expr(&plan.near);
            l.emit(AreaOp::Rows { to: rows, area, step, along, near });
        });
        self.emit(Compute::Clear { to: place, words: ROW_PLACE_WORDS });
        self.emit(Compute::Const { to: counter, value: 0.0 });
        let top = self.here();
        let to = self.frame.vars[var];
        self.emit(AreaOp::RowAt { to, place, rows, area, index: counter });
        let done = self.emit(Compute::jump_unless(place, 0));
        self.walking(var, Rounds::Behind(counter, rows), body);
        self.count_up(counter);
        self.emit(Compute::jump(top));
        self.land(done);
    }

    pub(super) fn for_edges(&mut self, var: usize, area: &Expr, body: &Block) {
        let area = self.walked_area(area);
        let counter = self.lasting(1);
        self.emit(Compute::Const { to: counter, value: 0.0 });
        let top = self.here();
        let to = self.frame.vars[var];
        self.emit(Compute::EdgeAt { to, area, index: counter });
        self.walking(var, Rounds::Behind(counter, area), body);
        self.count_up(counter);
        // An area has an edge: there is no way past the first round.
        self.emit(Compute::Jump { to: top, when: When::Less(counter, area) });
    }
}
