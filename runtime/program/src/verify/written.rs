//! Where code leads and what it writes.

use crate::{
    ANSWER_WORDS, AreaOp, Compute, EDGE_WORDS, GRID_WORDS, GUIDANCE_WORDS, Guide, ListOp, MapOp, Op, ROW_PLACE_WORDS,
    ROWS_WORDS, Slot, When, area_words,
};

/// Whether the next instruction may be executed after this one, in the same tick or a later one.
pub(super) fn goes_on(op: &Op) -> bool {
    let ends = matches!(op, Op::Return | Op::End | Op::Finish | Op::Abort { .. });
    !ends && !matches!(op, Op::Compute(Compute::Jump { when: When::Always, .. }))
}

/// Rows of words: from a slot on, so many.
type Rows = [Option<(Slot, u32)>; 2];

/// The words that an instruction itself writes. Functions and activities that it calls have frames of their own.
pub(super) fn written(op: &Op) -> impl Iterator<Item = (Slot, u32)> {
    let written = match *op {
        Op::Compute(op) => computed(op),
        Op::Area(op) => of_area(op),
        Op::List(op) => of_list(op),
        Op::Map(op) => of_map(op),
        Op::Age { to, .. } | Op::IsNew { to, .. } | Op::Hits { to, .. } => one((to, 1)),
        Op::Begin { state, .. } => one((state, GUIDANCE_WORDS)),
        // What keeps its course has one word of its own: whether it does.
        Op::Guide { guide: Guide::Keep, state, ended, .. } => both((state, 1), (ended, 1)),
        Op::Guide { state, ended, .. } => both((state, GUIDANCE_WORDS), (ended, 1)),
        Op::Step { ended, .. } => one((ended, 1)),
        Op::Answer { ours, refused, .. } => both((ours, 1), (refused, 1)),
        Op::Driven { suspended, lost } => both((suspended, 1), (lost, 1)),
        Op::AskPayload { id, .. } => one((id, 1)),
        Op::Heard { answer, ended, .. } => both((answer, ANSWER_WORDS), (ended, 1)),
        Op::Call { .. }
        | Op::Unanswered { .. }
        | Op::Return
        | Op::Yield
        | Op::Enter { .. }
        | Op::Cut { .. }
        | Op::Ask { .. }
        | Op::Take
        | Op::Desert { .. }
        | Op::PutOn { .. }
        | Op::TakeOff { .. }
        | Op::Keep { .. }
        | Op::End
        | Op::Finish
        | Op::Abort { .. }
        | Op::Tell { .. }
        | Op::Report { .. }
        | Op::Log { .. }
        | Op::Changed { .. } => [None, None],
    };
    written.into_iter().flatten()
}

fn one(row: (Slot, u32)) -> Rows {
    [Some(row), None]
}

fn both(a: (Slot, u32), b: (Slot, u32)) -> Rows {
    [Some(a), Some(b)]
}

fn computed(op: Compute) -> Rows {
    match op {
        Compute::CopyMany { to, words, .. } | Compute::Clear { to, words } => one((to, words)),
        Compute::Quotient { to, .. }
        | Compute::AddVector { to, .. }
        | Compute::SubVector { to, .. }
        | Compute::Scale { to, .. }
        | Compute::Toward { to, .. } => one((to, 2)),
        Compute::EdgeAt { to, .. } => one((to, EDGE_WORDS)),
        Compute::HeldFor { to, since, .. } => both((to, 1), (since, 1)),
        Compute::Becomes { to, before, .. } => both((to, 1), (before, 1)),
        Compute::Const { to, .. }
        | Compute::Copy { to, .. }
        | Compute::One { to, .. }
        | Compute::Two { to, .. }
        | Compute::Lt { to, .. }
        | Compute::Le { to, .. }
        | Compute::Eq { to, .. }
        | Compute::Not { to, .. }
        | Compute::And { to, .. }
        | Compute::Or { to, .. }
        | Compute::Direction { to, .. }
        | Compute::Dot { to, .. }
        | Compute::Along { to, .. }
        | Compute::EdgeGap { to, .. }
        | Compute::Elapsed { to, .. }
        | Compute::Now { to, .. } => one((to, 1)),
        Compute::Jump { .. } => [None, None],
    }
}

fn of_area(op: AreaOp) -> Rows {
    match op {
        AreaOp::Rectangle { to, room, .. } | AreaOp::Hull { to, room, .. } => one((to, area_words(room))),
        AreaOp::Polygon { to, room, ok, .. } => both((to, area_words(room)), (ok, 1)),
        AreaOp::Center { to, .. }
        | AreaOp::Corner { to, .. }
        | AreaOp::Scattered { to, .. }
        | AreaOp::Exit { to, .. } => one((to, 2)),
        AreaOp::NearestEdge { to, .. } => one((to, EDGE_WORDS)),
        AreaOp::Rows { to, .. } => one((to, ROWS_WORDS)),
        AreaOp::RowAt { to, place, .. } => both((to, 4), (place, ROW_PLACE_WORDS)),
        AreaOp::Gap { to, .. } | AreaOp::EdgeDistance { to, .. } | AreaOp::EdgeTangent { to, .. } => one((to, 1)),
    }
}

fn of_list(op: ListOp) -> Rows {
    match op {
        ListOp::Push { list, words, capacity, .. } | ListOp::PushSorted { list, words, capacity, .. } => {
            one((list, words.saturating_mul(capacity).saturating_add(1)))
        }
        ListOp::Remove { list, words, .. } | ListOp::Replace { list, words, .. } => {
            one((list, words.saturating_add(1)))
        }
        ListOp::Sort { list, words, it, .. } => both((list, words.saturating_add(1)), (it, words)),
        ListOp::At { to, words, .. } | ListOp::Top { to, words, .. } => one((to, words.saturating_add(1))),
        ListOp::Spread { to, .. } => one((to, 1)),
    }
}

fn of_map(op: MapOp) -> Rows {
    match op {
        MapOp::Lay { to, words, capacity, .. } => {
            one((to, words.saturating_mul(capacity).saturating_add(1 + GRID_WORDS)))
        }
        MapOp::CellOf { to, .. } => one((to, 1)),
        MapOp::CenterOf { to, .. } => one((to, 2)),
    }
}
