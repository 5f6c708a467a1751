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

    /// The same with other operands: each slot as `at` gives it.
    pub fn with_slots(self, at: impl Fn(Slot) -> Slot) -> Self {
        use Compute as C;
        match self {
            C::Const { to, value } => C::Const { to: at(to), value },
            C::Copy { to, from } => C::Copy { to: at(to), from: at(from) },
            C::CopyMany { to, from, words } => C::CopyMany { to: at(to), from: at(from), words },
            C::Clear { to, words } => C::Clear { to: at(to), words },
            C::One { operator, to, a } => C::One { operator, to: at(to), a: at(a) },
            C::Two { operator, to, a, b } => C::Two { operator, to: at(to), a: at(a), b: at(b) },
            C::Quotient { to, a, b } => C::Quotient { to: at(to), a: at(a), b: at(b) },
            C::Lt { to, a, b } => C::Lt { to: at(to), a: at(a), b: at(b) },
            C::Le { to, a, b } => C::Le { to: at(to), a: at(a), b: at(b) },
            C::Eq { to, a, b, words } => C::Eq { to: at(to), a: at(a), b: at(b), words },
            C::Not { to, a } => C::Not { to: at(to), a: at(a) },
            C::And { to, a, b } => C::And { to: at(to), a: at(a), b: at(b) },
            C::Or { to, a, b } => C::Or { to: at(to), a: at(a), b: at(b) },
            C::AddVector { to, a, b } => C::AddVector { to: at(to), a: at(a), b: at(b) },
            C::SubVector { to, a, b } => C::SubVector { to: at(to), a: at(a), b: at(b) },
            C::Scale { to, vector, by } => C::Scale { to: at(to), vector: at(vector), by: at(by) },
            C::Toward { to, length, heading } => C::Toward { to: at(to), length: at(length), heading: at(heading) },
            C::Direction { to, vector } => C::Direction { to: at(to), vector: at(vector) },
            C::Dot { to, a, b } => C::Dot { to: at(to), a: at(a), b: at(b) },
            C::Along { to, vector, heading } => C::Along { to: at(to), vector: at(vector), heading: at(heading) },
            C::EdgeAt { to, area, index } => C::EdgeAt { to: at(to), area: at(area), index: at(index) },
            C::EdgeGap { to, edge, point } => C::EdgeGap { to: at(to), edge: at(edge), point: at(point) },
            C::HeldFor { to, x, since, ticks, owner } => {
                C::HeldFor { to: at(to), x: at(x), since: at(since), ticks: at(ticks), owner: at(owner) }
            }
            C::Becomes { to, x, before } => C::Becomes { to: at(to), x: at(x), before: at(before) },
            C::Elapsed { to, from, ticks, owner } => {
                C::Elapsed { to: at(to), from: at(from), ticks: at(ticks), owner: at(owner) }
            }
            C::Now { to, owner } => C::Now { to: at(to), owner: at(owner) },
            C::Jump { to, when } => C::Jump { to, when: when.with_slots(at) },
        }
    }
}

impl When {
    fn with_slots(self, at: impl Fn(Slot) -> Slot) -> Self {
        match self {
            When::Always => When::Always,
            When::True(word) => When::True(at(word)),
            When::False(word) => When::False(at(word)),
            When::Less(a, b) => When::Less(at(a), at(b)),
            When::NotLess(a, b) => When::NotLess(at(a), at(b)),
            When::AtMost(a, b) => When::AtMost(at(a), at(b)),
            When::NotAtMost(a, b) => When::NotAtMost(at(a), at(b)),
        }
    }
}
