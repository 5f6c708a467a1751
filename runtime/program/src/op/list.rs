//! The instructions on lists: a count, then room for `capacity` elements of `words`.

use crate::{Addr, Slot};
use serde::{Deserialize, Serialize};

/// An instruction on a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ListOp {
    /// Adds at the end; when full the oldest, the first, goes.
    Push {
        /// The list.
        list: Slot,
        /// What is added.
        item: Slot,
        /// The words of an element.
        words: u32,
        /// How many elements there is room for.
        capacity: u32,
    },
    /// Puts elements in the order of their keys, which `key` computes from the element at `it`; ties keep their order.
    Sort {
        /// The list.
        list: Slot,
        /// The words of an element.
        words: u32,
        /// Where `key` reads its element.
        it: Slot,
        /// The code of the key.
        key: Addr,
        /// Where that leaves its value.
        value: Slot,
        /// The greatest comes first.
        most: bool,
    },
    /// Adds an element and sorts; when full the last in order goes.
    PushSorted {
        /// The list.
        list: Slot,
        /// What is added.
        item: Slot,
        /// The words of an element.
        words: u32,
        /// How many elements there is room for.
        capacity: u32,
        /// The code that sorts.
        sort: Addr,
    },
    /// Another element in the place of one, if there is one there.
    Replace {
        /// The list.
        list: Slot,
        /// Which element.
        index: Slot,
        /// What takes its place.
        item: Slot,
        /// The words of an element.
        words: u32,
    },
    /// Removes the first element equal to `item`.
    Remove {
        /// The list.
        list: Slot,
        /// What is removed.
        item: Slot,
        /// The words of an element.
        words: u32,
    },
    /// The element of an index: `to` is 1 and the element follows, or 0.
    At {
        /// Where the element goes.
        to: Slot,
        /// The list.
        list: Slot,
        /// The index.
        index: Slot,
        /// The words of an element.
        words: u32,
    },
    /// The first `count` elements of a list, as a list.
    Top {
        /// Where they go.
        to: Slot,
        /// The list.
        list: Slot,
        /// How many.
        count: Slot,
        /// The words of an element.
        words: u32,
    },
    /// The greatest less the smallest coordinate of a list of points along a heading; 0 for an empty list.
    Spread {
        /// Where it goes.
        to: Slot,
        /// The list.
        list: Slot,
        /// The heading.
        heading: Slot,
    },
}
