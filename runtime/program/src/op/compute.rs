//! The instructions that need nothing but words: most of what a tick executes.

use crate::{Addr, Slot};
use albacore_arithmetic::Operator;
use serde::{Deserialize, Serialize};

/// An instruction that needs nothing but words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum Compute {
    // ---- moves
    Const {
        to: Slot,
        value: f64,
    },
    Copy {
        to: Slot,
        from: Slot,
    },
    CopyMany {
        to: Slot,
        from: Slot,
        words: u32,
    },
    /// Zeros: an absent value, an empty list.
    Clear {
        to: Slot,
        words: u32,
    },
    // ---- arithmetic
    /// An operation on one word.
    One {
        operator: Operator,
        to: Slot,
        a: Slot,
    },
    /// An operation on two words. Where the compiler has shown that it has a result, and it has none all the same, the result is
    /// the operation's stand-in.
    Two {
        operator: Operator,
        to: Slot,
        a: Slot,
        b: Slot,
    },
    /// `to` is 1 and the quotient follows, or both are 0 where `b` is zero.
    Quotient {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    // ---- tests
    Lt {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Le {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Eq {
        to: Slot,
        a: Slot,
        b: Slot,
        words: u32,
    },
    Not {
        to: Slot,
        a: Slot,
    },
    And {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Or {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    // ---- north/east plane; vectors and points are two words
    AddVector {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    SubVector {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    /// A vector times a number.
    Scale {
        to: Slot,
        vector: Slot,
        by: Slot,
    },
    /// The vector of a length along a heading.
    Toward {
        to: Slot,
        length: Slot,
        heading: Slot,
    },
    /// The direction of a vector.
    Direction {
        to: Slot,
        vector: Slot,
    },
    Dot {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    /// The component of a vector, or the coordinate of a point, along a heading.
    Along {
        to: Slot,
        vector: Slot,
        heading: Slot,
    },
    /// The edge of an index.
    EdgeAt {
        to: Slot,
        area: Slot,
        index: Slot,
    },
    EdgeGap {
        to: Slot,
        edge: Slot,
        point: Slot,
    },
    // ---- time, by the age of the activity whose header is at `owner`
    /// `X for T`: `since` holds the age since which X has held, or -1; `to` whether that is `ticks` ago.
    HeldFor {
        to: Slot,
        x: Slot,
        since: Slot,
        ticks: Slot,
        owner: Slot,
    },
    /// `becomes X`: `before` holds X of the tick before.
    Becomes {
        to: Slot,
        x: Slot,
        before: Slot,
    },
    /// Whether `ticks` have gone by since entry, or since the age in `from`.
    Elapsed {
        to: Slot,
        from: Slot,
        ticks: Slot,
        owner: Slot,
    },
    /// The age now.
    Now {
        to: Slot,
        owner: Slot,
    },
    // ---- flow of control
    Jump {
        to: Addr,
        when: When,
    },
}

/// When a jump is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum When {
    /// Whenever it is reached.
    Always,
    /// A word is not 0.
    True(Slot),
    /// A word is 0.
    False(Slot),
    /// The first word is less than the second.
    Less(Slot, Slot),
    /// It is not.
    NotLess(Slot, Slot),
    /// The first word is the second at most.
    AtMost(Slot, Slot),
    /// It is not.
    NotAtMost(Slot, Slot),
}

impl Compute {
    /// An operation on two words.
    pub fn two(operator: Operator, to: Slot, a: Slot, b: Slot) -> Self {
        Compute::Two { operator, to, a, b }
    }

    /// A jump that is taken whenever it is reached.
    pub fn jump(to: Addr) -> Self {
        Compute::Jump { to, when: When::Always }
    }

    /// A jump that is taken when a word is not 0.
    pub fn jump_if(word: Slot, to: Addr) -> Self {
        Compute::Jump { to, when: When::True(word) }
    }

    /// A jump that is taken when a word is 0.
    pub fn jump_unless(word: Slot, to: Addr) -> Self {
        Compute::Jump { to, when: When::False(word) }
    }
}
