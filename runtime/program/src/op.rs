//! The machine's instructions: three-address code over slots of words.

mod area;
mod compute;
mod list;
mod map;

pub use area::AreaOp;
pub use compute::{Compute, When};
pub use list::ListOp;
pub use map::MapOp;

use crate::{Addr, Cause, Channel, Guide, Slot};
use serde::{Deserialize, Serialize};

/// One instruction. `to` is where the result goes; booleans are 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum Op {
    /// What needs nothing but words.
    Compute(Compute),
    /// On areas.
    Area(AreaOp),
    /// On lists.
    List(ListOp),
    /// On maps.
    Map(MapOp),
    // ---- inputs
    /// Seconds since the latest sample.
    Age { to: Slot, input: u32 },
    /// Whether a sample has come in this tick.
    IsNew { to: Slot, input: u32 },
    /// How many of the last `of` samples reached a limit.
    Hits { to: Slot, input: u32, limit: Slot, of: u32 },
    // ---- flow of control
    /// Runs a function whose frame begins at `base`.
    Call { code: Addr, base: Slot },
    /// A piece of code has come to its end.
    Return,
    // ---- statements that take time
    /// Gives the tick away; the body goes on after this instruction.
    Yield,
    /// Begins guidance: makes its state from its arguments.
    Begin { guide: Guide, args: Slot, state: Slot, setpoints: Slot },
    /// One tick of guidance: sets the command; `ended` tells whether it came to its own end.
    Guide { guide: Guide, args: Slot, state: Slot, setpoints: Slot, ended: Slot },
    /// Enters what a call site calls.
    Enter { call: u32 },
    /// Steps it; `ended` tells whether it came to its own end.
    Step { call: u32, ended: Slot },
    /// Leaves it before its end.
    Cut { call: u32, cause: Cause },
    /// Asks the vehicle to let us drive, or waits until it offers.
    Ask { offered: bool },
    /// Whether the vehicle lets us drive now, and whether it has said that it will not.
    Answer { ours: Slot, refused: Slot, offered: bool },
    /// The vehicle is ours: from here on commands are sent.
    Take,
    /// Whether the vehicle that was ours does not listen for a while, and whether it is ours no longer.
    Driven { suspended: Slot, lost: Slot },
    /// The run ends if an override that nobody reads ended otherwise than by itself: its end, as [`crate::OverrideEnd`] numbers them.
    Desert { end: Slot },
    /// Asks a payload for what is at an index into [`crate::Program::asks`]; `id` gets the number of the question.
    AskPayload { action: u32, id: Slot },
    /// Whether the answer has come. Then `answer` gets its end, as [`crate::OverrideEnd`] numbers it, and its value.
    Heard { id: Slot, answer: Slot, ended: Slot },
    /// It is awaited no longer.
    Unanswered { id: Slot },
    /// Puts an overlay on.
    PutOn { overlay: u32 },
    /// Takes it off.
    TakeOff { overlay: u32 },
    /// In an overlay that sets a channel: the setpoint.
    Keep { channel: Channel, value: Slot },
    /// The body has come to its end.
    End,
    /// The activity is finished, its result stored.
    Finish,
    /// The mission ends.
    Abort { why: u32 },
    // ---- what the world hears
    /// A statement begins: index into [`crate::Program::statements`].
    Tell { statement: u32 },
    /// A result.
    Report { site: u32 },
    /// A line of the trace.
    Log { text: u32 },
    /// A memory may have been changed by a rule: index into [`crate::Program::memories`].
    Changed { memory: u32 },
}

impl Op {
    /// Where it may jump to.
    pub fn jump(&self) -> Option<Addr> {
        match *self {
            Op::Compute(Compute::Jump { to, .. }) => Some(to),
            _ => None,
        }
    }

    /// Whether the instruction after it is never reached from it.
    pub fn ends(&self) -> bool {
        matches!(
            self,
            Op::Return
                | Op::End
                | Op::Finish
                | Op::Abort { .. }
                | Op::Compute(Compute::Jump { when: When::Always, .. })
        )
    }

    /// The same, to be set once it is known.
    pub fn jump_mut(&mut self) -> Option<&mut Addr> {
        match self {
            Op::Compute(Compute::Jump { to, .. }) => Some(to),
            _ => None,
        }
    }
}

impl From<Compute> for Op {
    fn from(op: Compute) -> Self {
        Op::Compute(op)
    }
}

impl From<AreaOp> for Op {
    fn from(op: AreaOp) -> Self {
        Op::Area(op)
    }
}

impl From<ListOp> for Op {
    fn from(op: ListOp) -> Self {
        Op::List(op)
    }
}

impl From<MapOp> for Op {
    fn from(op: MapOp) -> Self {
        Op::Map(op)
    }
}
