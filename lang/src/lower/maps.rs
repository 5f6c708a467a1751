//! Maps to code: a grid, then the list of what its cells hold.

use super::Lowering;
use crate::hir::Expr;
use crate::types::Type;
use albacore_program::{GRID_WORDS, ListOp, MapOp, Slot};

impl<'a> Lowering<'a> {
    /// A map over an area that holds the same value everywhere.
    pub(super) fn lay_map(&mut self, to: Slot, area: Slot, value: Slot, ty: &Type) {
        let Type::Map(inner, cells) = ty else { return };
        self.emit(MapOp::Lay { to, area, value, words: self.words(inner), capacity: *cells });
        self.typed(to, ty);
    }

    /// What a map holds at a point, or none.
    pub(super) fn cell(&mut self, to: Slot, map: Slot, point: Slot, ty: &Type) {
        let Type::Map(inner, _) = ty else { return };
        let index = self.temp(1);
        self.emit(MapOp::CellOf { to: index, map, point });
        self.element(to, map.saturating_add(GRID_WORDS), index, inner);
    }

    /// The index of the cell of a point.
    pub(super) fn cell_of(&mut self, map: Slot, point: &Expr) -> Slot {
        let point = self.expr(point);
        let index = self.temp(1);
        self.emit(MapOp::CellOf { to: index, map, point });
        index
    }

    /// An element of a list, or none. Of a list of optionals it is the element itself, which may be absent: an optional of an optional is one.
    pub(super) fn element(&mut self, to: Slot, list: Slot, index: Slot, inner: &Type) {
        let words = self.words(inner);
        let found = if inner.is_optional() { self.temp(words.saturating_add(1)) } else { to };
        self.emit(ListOp::At { to: found, list, index, words });
        self.typed(found.saturating_add(1), inner);
        if found != to {
            self.copy(to, found.saturating_add(1), words);
        }
    }
}
