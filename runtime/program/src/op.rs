//! The machine's instructions: three-address code over slots of words.

use crate::{Addr, Cause, Channel, Guide, Slot};
use serde::{Deserialize, Serialize};

/// One instruction. `to` is where the result goes; booleans are 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the operands of each instruction are named by what they are")]
pub enum Op {
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
    // ---- arithmetic on one word
    Add {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Sub {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Mul {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    /// The compiler has shown that `b` is not zero; should it be all the same, the result is 0.
    Div {
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
    /// Of whole numbers, which end at 2^53.
    AddInt {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    SubInt {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    MulInt {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Min {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Max {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Pow {
        to: Slot,
        a: Slot,
        b: Slot,
    },
    Neg {
        to: Slot,
        a: Slot,
    },
    Abs {
        to: Slot,
        a: Slot,
    },
    Sqrt {
        to: Slot,
        a: Slot,
    },
    Floor {
        to: Slot,
        a: Slot,
    },
    Ceil {
        to: Slot,
        a: Slot,
    },
    Round {
        to: Slot,
        a: Slot,
    },
    Sin {
        to: Slot,
        a: Slot,
    },
    Cos {
        to: Slot,
        a: Slot,
    },
    /// Wraps into [0, 2 pi).
    WrapHeading {
        to: Slot,
        a: Slot,
    },
    /// Wraps into (-pi, pi].
    WrapAngle {
        to: Slot,
        a: Slot,
    },
    /// Seconds to whole ticks, rounded up, at least one.
    Ticks {
        to: Slot,
        a: Slot,
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
    Length {
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
    // ---- areas
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
    /// The edge of an index.
    EdgeAt {
        to: Slot,
        area: Slot,
        index: Slot,
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
    EdgeGap {
        to: Slot,
        edge: Slot,
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
    // ---- lists: a count, then room for `capacity` elements of `words`
    /// Adds at the end; when full the oldest, the first, goes.
    Push {
        list: Slot,
        item: Slot,
        words: u32,
        capacity: u32,
    },
    /// Puts elements in the order of their keys, which `key` computes from the element at `it`; ties keep their order.
    Sort {
        list: Slot,
        words: u32,
        it: Slot,
        key: Addr,
        value: Slot,
        most: bool,
    },
    /// Adds an element and sorts; when full the last in order goes.
    PushSorted {
        list: Slot,
        item: Slot,
        words: u32,
        capacity: u32,
        sort: Addr,
    },
    /// Removes the first element equal to `item`.
    Remove {
        list: Slot,
        item: Slot,
        words: u32,
    },
    /// The element of an index: `to` is 1 and the element follows, or 0.
    At {
        to: Slot,
        list: Slot,
        index: Slot,
        words: u32,
    },
    /// The first `count` elements of a list, as a list.
    Top {
        to: Slot,
        list: Slot,
        count: Slot,
        words: u32,
    },
    /// The greatest less the smallest coordinate of a list of points along a heading; 0 for an empty list.
    Spread {
        to: Slot,
        list: Slot,
        heading: Slot,
    },
    // ---- inputs
    /// Seconds since the latest sample.
    Age {
        to: Slot,
        input: u32,
    },
    /// How many of the last `of` samples reached a limit.
    Hits {
        to: Slot,
        input: u32,
        limit: Slot,
        of: u32,
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
    },
    JumpIf {
        if_: Slot,
        to: Addr,
    },
    JumpUnless {
        unless: Slot,
        to: Addr,
    },
    /// A comparison and the jump that it decides.
    JumpIfLess {
        a: Slot,
        b: Slot,
        to: Addr,
    },
    JumpUnlessLess {
        a: Slot,
        b: Slot,
        to: Addr,
    },
    JumpIfAtMost {
        a: Slot,
        b: Slot,
        to: Addr,
    },
    JumpUnlessAtMost {
        a: Slot,
        b: Slot,
        to: Addr,
    },
    /// Runs a function whose frame begins at `base`.
    Call {
        code: Addr,
        base: Slot,
    },
    Return,
    // ---- statements that take time
    /// Gives the tick away; the body goes on after this instruction.
    Yield,
    /// Begins guidance: makes its state from its arguments.
    Begin {
        guide: Guide,
        args: Slot,
        state: Slot,
        setpoints: Slot,
    },
    /// One tick of guidance: sets the command; `ended` tells whether it came to its own end.
    Guide {
        guide: Guide,
        args: Slot,
        state: Slot,
        setpoints: Slot,
        ended: Slot,
    },
    /// Enters what a call site calls.
    Enter {
        call: u32,
    },
    /// Steps it; `ended` tells whether it came to its own end.
    Step {
        call: u32,
        ended: Slot,
    },
    /// Leaves it before its end.
    Cut {
        call: u32,
        cause: Cause,
    },
    /// Asks the vehicle to let us drive, or waits until it offers.
    Ask {
        offered: bool,
    },
    /// Whether the vehicle lets us drive now, and whether it has said that it will not.
    Answer {
        ours: Slot,
        refused: Slot,
        offered: bool,
    },
    /// The vehicle is ours: from here on commands are sent.
    Take,
    /// Whether the vehicle that was ours does not listen for a while, and whether it is ours no longer.
    Driven {
        suspended: Slot,
        lost: Slot,
    },
    /// The run ends if an override that nobody reads ended otherwise than by itself: its end, as [`crate::OverrideEnd`] numbers them.
    Desert {
        end: Slot,
    },
    /// Puts an overlay on.
    PutOn {
        overlay: u32,
    },
    /// Takes it off.
    TakeOff {
        overlay: u32,
    },
    /// In an overlay that sets a channel: the setpoint.
    Keep {
        channel: Channel,
        value: Slot,
    },
    /// The body has come to its end.
    End,
    /// The activity is finished, its result stored.
    Finish,
    /// The mission ends.
    Abort {
        why: u32,
    },
    // ---- what the world hears
    Report {
        site: u32,
    },
    Log {
        text: u32,
    },
    /// A memory may have been changed by a rule: index into [`crate::Program::memories`].
    Changed {
        memory: u32,
    },
}
