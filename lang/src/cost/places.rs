//! The places where an activity begins another: statements that take time, and what `with` puts on.

use crate::hir::{Activity, Block, Body, Decl, Hir, StmtKind, With};

/// The overlays that an activity puts on, in its declarations and in its statements, each as often as it stands there.
pub(super) fn overlays(activity: &Activity) -> Vec<usize> {
    let mut found = Vec::new();
    let mut take = |items: &[With]| {
        found.extend(items.iter().filter_map(|item| match item {
            With::Overlay(id, ..) => Some(*id),
            With::Setpoint(..) => None,
        }));
    };
    for decl in &activity.decls {
        if let Decl::With(items) = decl {
            take(items);
        }
    }
    for block in blocks(activity) {
        block.each(&mut |stmt| {
            if let StmtKind::With(items, _) = &stmt.kind {
                take(items);
            }
        });
    }
    found
}

/// The blocks of an activity whose statements may take time.
pub(super) fn blocks(activity: &Activity) -> Vec<&Block> {
    let body = match &activity.body {
        Body::Sequence(block) => Some(block),
        Body::Table { .. } | Body::Amend { .. } => None,
    };
    body.into_iter()
        .chain(activity.mission.iter().filter_map(|m| m.recovery.as_ref()).map(|(_, block)| block))
        .collect()
}

/// All that an activity and the behaviors nested in it begin, each as often as it stands there: what has a frame of its own.
pub(super) fn begun(hir: &Hir, id: usize) -> Vec<usize> {
    let activity = &hir.activities[id];
    let nested: &[usize] = match &activity.body {
        Body::Table { behaviors, .. } => behaviors,
        _ => &[],
    };
    let own = activity.calls().into_iter().filter(|called| !nested.contains(called));
    own.chain(nested.iter().flat_map(|&behavior| begun(hir, behavior))).collect()
}
