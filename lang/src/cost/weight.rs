//! The steps of operations that walk what they are given.

use crate::hir::{Builtin, Expr};
use crate::types::Type;
use albacore_geometry::HALVINGS;

/// So many pairs of edges are held against one another in a step: nearly all are told apart by a comparison.
const PAIRS_A_STEP: u64 = 2;

/// The steps of an operation itself. Areas have room for so many corners.
pub(super) fn weight(op: Builtin, operands: &[Expr], corners: u64) -> u64 {
    let held = capacity(operands.first().map(|e| &e.ty));
    1 + match op {
        Builtin::Top | Builtin::Spread => held,
        // Each edge is held against each other one; before, the corners are put in order for the hull.
        Builtin::Polygon => held.saturating_mul(held) / 2 / PAIRS_A_STEP + in_order(held),
        Builtin::Hull => corners + in_order(corners),
        // How far the edges are, and which of them lie to the east.
        Builtin::Gap => 2 * corners,
        // What lies to the south of a line, for each halving of where it is.
        Builtin::Scattered => u64::from(HALVINGS + 2) * corners,
        // And which of them a ray leaves over.
        Builtin::Exit | Builtin::Run => 3 * corners,
        Builtin::Center | Builtin::Corner | Builtin::NearestEdge => corners,
        _ => 0,
    }
}

/// The comparisons that put so many in order.
pub(super) fn in_order(count: u64) -> u64 {
    count.saturating_mul(u64::from(count.max(1).ilog2() + 1))
}

/// How many a list holds at most.
pub(super) fn capacity(ty: Option<&Type>) -> u64 {
    match ty {
        Some(Type::List(_, capacity) | Type::Map(_, capacity)) => u64::from(*capacity),
        _ => 0,
    }
}
