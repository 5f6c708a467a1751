//! How far calls lead. All that comes after the checks goes down along calls by calling itself: no chain of them may be
//! longer than any stack holds.

use super::Checker;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::calls_in;

/// Calls lead this deep at most.
const CALLS_MAX: usize = 128;

impl<'t> Checker<'t> {
    /// Reports a chain of calls that is too long; tells whether there is one.
    pub(super) fn calls_too_deep(&mut self) -> bool {
        let activities = too_deep(self.hir.activities.len(), &|id| self.hir.activities[id].calls());
        let fns = too_deep(self.hir.fns.len(), &|id| calls_in(&self.hir.fns[id].body));
        let spans = [activities.map(|id| self.hir.activities[id].span), fns.map(|id| self.fn_signatures[id].span)];
        for span in spans.into_iter().flatten() {
            self.report(
                Diagnostic::error(
                    Code::LimitsCalls,
                    span,
                    format!("this is called through more than {CALLS_MAX} others"),
                )
                .help("call what is needed from nearer the mission"),
            );
        }
        activities.is_some() || fns.is_some()
    }
}

/// Something at the end of a chain that is too long.
fn too_deep(count: usize, calls: &dyn Fn(usize) -> Vec<usize>) -> Option<usize> {
    let mut heights = vec![None; count];
    (0..count).find_map(|id| height(id, 0, calls, &mut heights).err())
}

/// How deep calls lead from here, where they lead back nowhere; an error where they lead too deep.
fn height(
    id: usize,
    depth: usize,
    calls: &dyn Fn(usize) -> Vec<usize>,
    heights: &mut Vec<Option<usize>>,
) -> Result<usize, usize> {
    if depth > CALLS_MAX {
        return Err(id);
    }
    if let Some(known) = heights[id] {
        return if depth + known > CALLS_MAX { Err(id) } else { Ok(known) };
    }
    heights[id] = Some(0);
    let mut deepest = 0;
    for called in calls(id) {
        deepest = deepest.max(height(called, depth + 1, calls, heights)? + 1);
    }
    heights[id] = Some(deepest);
    Ok(deepest)
}
