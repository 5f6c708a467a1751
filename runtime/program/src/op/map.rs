//! The instructions on maps: a grid, then the list of its cells.

use crate::Slot;
use serde::{Deserialize, Serialize};

/// An instruction on a map. What it holds is the list behind its grid, at [`crate::GRID_WORDS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum MapOp {
    /// The finest grid over an area that has no more cells than there is room for, and the same value in each.
    Lay { to: Slot, area: Slot, value: Slot, words: u32, capacity: u32 },
    /// The index of the cell that a point lies in; -1 outside.
    CellOf { to: Slot, map: Slot, point: Slot },
    /// The middle of the cell of an index.
    CenterOf { to: Slot, map: Slot, index: Slot },
}
