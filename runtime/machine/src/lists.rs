//! Bounded lists in words: a count, then the elements.

use crate::state::Run;
use albacore_arithmetic::{Operation, Spread, bounded};
use albacore_geometry::Vector;
use albacore_program::{Addr, ListOp, Op, Program, Slot};
use std::cmp::Ordering;

/// The order of a list: `key` computes the word at `value` from the element at `it`.
#[derive(Clone, Copy)]
pub(crate) struct Order {
    pub it: Slot,
    pub key: Addr,
    pub value: Slot,
    pub most: bool,
}

impl Order {
    /// Which of two elements comes first, by their keys.
    fn compare(self, a: f64, b: f64) -> Ordering {
        let by_size = a.partial_cmp(&b).unwrap_or(Ordering::Equal);
        if self.most { by_size.reverse() } else { by_size }
    }
}

impl Run {
    fn count(&self, list: Slot) -> u32 {
        self.get(list) as u32
    }

    pub fn push(&mut self, list: Slot, item: Slot, words: u32, capacity: u32) {
        let mut count = self.count(list);
        if count == capacity {
            // Full: the oldest, which is the first, goes.
            self.copy(list + 1, list + 1 + words, (count - 1) * words);
            count -= 1;
        }
        self.copy(list + 1 + count * words, item, words);
        self.set(list, f64::from(count + 1));
    }

    /// Adds to a list in order; when full the last in order goes, which may be the new element.
    pub fn push_sorted(
        &mut self,
        program: &Program,
        list: Slot,
        item: Slot,
        words: u32,
        capacity: u32,
        sorter: (u32, Slot),
    ) {
        let count = self.count(list);
        if count < capacity {
            self.copy(list + 1 + count * words, item, words);
            self.set(list, f64::from(count + 1));
            self.execute(program, sorter.0, sorter.1);
            return;
        }
        // No room to sort one more: the new element takes the place of the last in order, by the key as it is now, if it comes before it.
        // Its words may be temporaries, which a key has too.
        let added: Vec<f64> = self.slice(item, words).to_vec();
        self.execute(program, sorter.0, sorter.1);
        let last = list + 1 + (count - 1) * words;
        let kept: Vec<f64> = self.slice(last, words).to_vec();
        let before = self.keys(program, sorter, &[&kept, &added]);
        if let Some((kept_key, added_key, most)) = before {
            let comes_first = if most { added_key > kept_key } else { added_key < kept_key };
            if comes_first {
                self.state.words[last as usize..(last + words) as usize].copy_from_slice(&added);
            }
        }
        self.execute(program, sorter.0, sorter.1);
    }

    /// The keys of two elements, by the `Sort` instruction that a sorter begins with.
    fn keys(&mut self, program: &Program, sorter: (u32, Slot), elements: &[&[f64]; 2]) -> Option<(f64, f64, bool)> {
        let Op::List(ListOp::Sort { it, key, value, most, .. }) = program.ops[sorter.0 as usize] else {
            return None;
        };
        let mut keys = [0.0; 2];
        for (out, element) in keys.iter_mut().zip(elements) {
            let at = (sorter.1 + it) as usize;
            self.state.words[at..at + element.len()].copy_from_slice(element);
            self.execute(program, key, sorter.1);
            *out = self.get(sorter.1 + value);
        }
        Some((keys[0], keys[1], most))
    }

    /// Stable, so that ties keep the older first. Elements may be large: each is moved once.
    pub fn sort(&mut self, program: &Program, base: Slot, list: Slot, words: u32, by: Order) {
        if self.in_order(program, base, list, words, by) {
            return;
        }
        let elements = (0..self.count(list)).map(|i| list + 1 + i * words);
        let mut keyed: Vec<(f64, Slot)> =
            elements.map(|element| (self.key(program, base, element, words, by), element - list - 1)).collect();
        keyed.sort_by(|(a, _), (b, _)| by.compare(*a, *b));
        let unsorted = self.slice(list + 1, keyed.len() as u32 * words).to_vec();
        for ((_, from), to) in keyed.into_iter().zip((list as usize + 1..).step_by(words.max(1) as usize)) {
            let (from, words) = (from as usize, words as usize);
            self.state.words[to..to + words].copy_from_slice(&unsorted[from..from + words]);
        }
    }

    /// Whether a list is in order, as it is on nearly every tick: then nothing is kept and nothing allocated.
    fn in_order(&mut self, program: &Program, base: Slot, list: Slot, words: u32, by: Order) -> bool {
        let count = self.count(list);
        if count < 2 {
            return true;
        }
        let mut before = self.key(program, base, list + 1, words, by);
        (1..count).all(|i| {
            let key = self.key(program, base, list + 1 + i * words, words, by);
            by.compare(std::mem::replace(&mut before, key), key) != Ordering::Greater
        })
    }

    fn key(&mut self, program: &Program, base: Slot, element: Slot, words: u32, by: Order) -> f64 {
        self.copy(by.it, element, words);
        self.execute(program, by.key, base);
        self.get(by.value)
    }

    /// Another element in the place of one; nothing where there is none.
    pub fn replace(&mut self, list: Slot, index: Slot, item: Slot, words: u32) {
        let index = self.get(index);
        if index >= 0.0 && index < self.get(list) {
            self.copy(list + 1 + index as u32 * words, item, words);
        }
    }

    pub fn remove(&mut self, list: Slot, item: Slot, words: u32) {
        let count = self.count(list);
        let found = (0..count).find(|i| self.slice(list + 1 + i * words, words) == self.slice(item, words));
        if let Some(i) = found {
            self.copy(list + 1 + i * words, list + 1 + (i + 1) * words, (count - i - 1) * words);
            self.set(list, f64::from(count - 1));
            // Lists are compared word by word: what is beyond their count is always zero.
            let end = (list + 1 + count * words) as usize;
            self.state.words[end - words as usize..end].fill(0.0);
        }
    }

    pub fn element(&mut self, to: Slot, list: Slot, index: Slot, words: u32) {
        let index = self.get(index);
        if index >= 0.0 && index < self.get(list) {
            self.copy(to + 1, list + 1 + index as u32 * words, words);
            self.set(to, 1.0);
        } else {
            self.state.words[to as usize..(to + 1 + words) as usize].fill(0.0);
        }
    }

    pub fn top(&mut self, to: Slot, list: Slot, count: Slot, words: u32) {
        let count = self.get(count).clamp(0.0, self.get(list)) as u32;
        self.copy(to + 1, list + 1, count * words);
        self.set(to, f64::from(count));
    }

    pub fn spread(&self, list: Slot, unit: Vector) -> f64 {
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for i in 0..self.count(list) {
            let at = list + 1 + 2 * i;
            let along = bounded(self.vector(at).dot(unit));
            low = low.min(along);
            high = high.max(along);
        }
        Spread::execute([low, high])
    }
}
