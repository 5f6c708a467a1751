//! The instructions on areas, their edges and their rows.

use crate::Slot;
use serde::{Deserialize, Serialize};

/// An instruction on an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum AreaOp {
    /// From a centre, the heading of the long side, length and width.
    Rectangle {
        to: Slot,
        center: Slot,
        along: Slot,
        length: Slot,
        width: Slot,
    },
    /// From a list of points; `ok` tells whether they make a convex polygon.
    Polygon {
        to: Slot,
        points: Slot,
        ok: Slot,
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
    /// The rows that lie `step` metres apart and begin at the end nearest to `near`.
    Rows {
        to: Slot,
        area: Slot,
        step: Slot,
        near: Slot,
    },
    /// The row of an index; `there` tells whether there is one.
    RowAt {
        to: Slot,
        there: Slot,
        rows: Slot,
        area: Slot,
        index: Slot,
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
    /// Where a ray from a point leaves the area: the point itself from outside.
    Exit {
        to: Slot,
        area: Slot,
        point: Slot,
        heading: Slot,
    },
}
