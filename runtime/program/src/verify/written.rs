//! Where code leads and what it writes.

use crate::{AREA_WORDS, Addr, EDGE_WORDS, GUIDANCE_WORDS, Op, ROWS_WORDS, Slot};

/// Where an instruction may jump to.
pub(super) fn jump(op: &Op) -> Option<Addr> {
    match *op {
        Op::Jump { to }
        | Op::JumpIf { to, .. }
        | Op::JumpUnless { to, .. }
        | Op::JumpIfLess { to, .. }
        | Op::JumpUnlessLess { to, .. }
        | Op::JumpIfAtMost { to, .. }
        | Op::JumpUnlessAtMost { to, .. } => Some(to),
        _ => None,
    }
}

/// Whether the next instruction may be executed after this one, in the same tick or a later one.
pub(super) fn goes_on(op: &Op) -> bool {
    !matches!(op, Op::Jump { .. } | Op::Return | Op::End | Op::Finish | Op::Abort { .. })
}

/// The words that an instruction itself writes. Functions and activities that it calls have frames of their own.
pub(super) fn written(op: &Op) -> impl Iterator<Item = (Slot, u32)> {
    let one = |to| [Some((to, 1)), None];
    let both = |a, b| [Some(a), Some(b)];
    let written = match *op {
        Op::CopyMany { to, words, .. } | Op::Clear { to, words } => [Some((to, words)), None],
        Op::Quotient { to, .. }
        | Op::AddVector { to, .. }
        | Op::SubVector { to, .. }
        | Op::Scale { to, .. }
        | Op::Toward { to, .. }
        | Op::Center { to, .. }
        | Op::Corner { to, .. }
        | Op::Exit { to, .. } => [Some((to, 2)), None],
        Op::Rectangle { to, .. } => [Some((to, AREA_WORDS)), None],
        Op::Polygon { to, ok, .. } => both((to, AREA_WORDS), (ok, 1)),
        Op::EdgeAt { to, .. } | Op::NearestEdge { to, .. } => [Some((to, EDGE_WORDS)), None],
        Op::Rows { to, .. } => [Some((to, ROWS_WORDS)), None],
        Op::RowAt { to, there, .. } => both((to, 4), (there, 1)),
        Op::Push { list, words, capacity, .. } | Op::PushSorted { list, words, capacity, .. } => {
            [Some((list, words.saturating_mul(capacity).saturating_add(1))), None]
        }
        Op::Remove { list, words, .. } => [Some((list, words.saturating_add(1))), None],
        Op::Sort { list, words, it, .. } => both((list, words.saturating_add(1)), (it, words)),
        Op::At { to, words, .. } | Op::Top { to, words, .. } => [Some((to, words.saturating_add(1))), None],
        Op::Begin { state, .. } => [Some((state, GUIDANCE_WORDS)), None],
        // What keeps its course has one word of its own: whether it does.
        Op::Guide { guide: crate::Guide::Keep, state, ended, .. } => both((state, 1), (ended, 1)),
        Op::Guide { state, ended, .. } => both((state, GUIDANCE_WORDS), (ended, 1)),
        Op::Step { ended, .. } => one(ended),
        Op::Answer { ours, refused, .. } => both((ours, 1), (refused, 1)),
        Op::Driven { suspended, lost } => both((suspended, 1), (lost, 1)),
        Op::HeldFor { to, since, .. } => both((to, 1), (since, 1)),
        Op::Becomes { to, before, .. } => both((to, 1), (before, 1)),
        Op::Const { to, .. }
        | Op::Copy { to, .. }
        | Op::Add { to, .. }
        | Op::Sub { to, .. }
        | Op::Mul { to, .. }
        | Op::Div { to, .. }
        | Op::AddInt { to, .. }
        | Op::SubInt { to, .. }
        | Op::MulInt { to, .. }
        | Op::Min { to, .. }
        | Op::Max { to, .. }
        | Op::Pow { to, .. }
        | Op::Neg { to, .. }
        | Op::Abs { to, .. }
        | Op::Sqrt { to, .. }
        | Op::Floor { to, .. }
        | Op::Ceil { to, .. }
        | Op::Round { to, .. }
        | Op::Sin { to, .. }
        | Op::Cos { to, .. }
        | Op::WrapHeading { to, .. }
        | Op::WrapAngle { to, .. }
        | Op::Ticks { to, .. }
        | Op::Lt { to, .. }
        | Op::Le { to, .. }
        | Op::Eq { to, .. }
        | Op::Not { to, .. }
        | Op::And { to, .. }
        | Op::Or { to, .. }
        | Op::Direction { to, .. }
        | Op::Length { to, .. }
        | Op::Dot { to, .. }
        | Op::Along { to, .. }
        | Op::Gap { to, .. }
        | Op::EdgeGap { to, .. }
        | Op::EdgeTangent { to, .. }
        | Op::Spread { to, .. }
        | Op::Age { to, .. }
        | Op::Hits { to, .. }
        | Op::Elapsed { to, .. }
        | Op::Now { to, .. } => one(to),
        Op::Jump { .. }
        | Op::JumpIf { .. }
        | Op::JumpUnless { .. }
        | Op::JumpIfLess { .. }
        | Op::JumpUnlessLess { .. }
        | Op::JumpIfAtMost { .. }
        | Op::JumpUnlessAtMost { .. }
        | Op::Call { .. }
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
        | Op::Report { .. }
        | Op::Log { .. }
        | Op::Changed { .. } => [None, None],
    };
    written.into_iter().flatten()
}
