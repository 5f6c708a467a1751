//! The instructions on areas, their edges and their rows.

use crate::Slot;
use serde::{Deserialize, Serialize};

/// An instruction on an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum AreaOp {
    /// From a centre, the heading of the long side, length and width. `room`: for how many corners the area has, like any of its program.
    Rectangle {
        to: Slot,
        room: u32,
        center: Slot,
        along: Slot,
        length: Slot,
        width: Slot,
    },
    /// From a list of points; `ok` tells whether they make an area.
    Polygon {
        to: Slot,
        room: u32,
        points: Slot,
        ok: Slot,
    },
    /// The least area without dents that holds one.
    Hull {
        to: Slot,
        room: u32,
        area: Slot,
    },
    Center {
        to: Slot,
        area: Slot,
    },
    /// Metres to the nearest edge, negative outside.
    Gap {
        to: Slot,
        area: Slot,
        point: Slot,
    },
    /// The corner that lies farthest along a heading; of equals the one nearest to a point.
    Corner {
        to: Slot,
        area: Slot,
        heading: Slot,
        near: Slot,
    },
    /// The rows that lie `step` metres apart, along a heading or the longest edge, and begin at the end nearest to `near`.
    Rows {
        to: Slot,
        area: Slot,
        step: Slot,
        along: Option<Slot>,
        near: Slot,
    },
    /// The row of an index. Three words at `place` tell whether there is one, and on which line and as which of its pieces the next
    /// is; all are 0 before the first.
    RowAt {
        to: Slot,
        place: Slot,
        rows: Slot,
        area: Slot,
        index: Slot,
    },
    /// Metres to the nearest place of an edge.
    EdgeDistance {
        to: Slot,
        edge: Slot,
        point: Slot,
    },
    NearestEdge {
        to: Slot,
        area: Slot,
        point: Slot,
    },
    /// The direction along an edge that is nearest to a heading.
    EdgeTangent {
        to: Slot,
        edge: Slot,
        heading: Slot,
    },
    /// The place of an index among those that are scattered over the area.
    Scattered {
        to: Slot,
        area: Slot,
        index: Slot,
        seed: Slot,
    },
    /// Where a ray from a point leaves the area: the point itself from outside.
    Exit {
        to: Slot,
        area: Slot,
        point: Slot,
        heading: Slot,
    },
}
