//! A map from slots, kept in their order: copied in one piece, and searched by halves.

use crate::Slot;
use std::ops::Range;

/// What is known of some slots.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slots<T>(Vec<(Slot, T)>);

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Slots(Vec::new())
    }
}

impl<T> Slots<T> {
    fn place(&self, slot: Slot) -> Result<usize, usize> {
        self.0.binary_search_by_key(&slot, |(of, _)| *of)
    }

    pub fn get(&self, slot: Slot) -> Option<&T> {
        self.place(slot).ok().and_then(|at| self.0.get(at)).map(|(_, value)| value)
    }

    pub fn contains(&self, slot: Slot) -> bool {
        self.place(slot).is_ok()
    }

    /// The value of a slot is this from here on.
    pub fn insert(&mut self, slot: Slot, value: T) {
        match self.place(slot) {
            Ok(at) => self.0[at].1 = value,
            Err(at) => self.0.insert(at, (slot, value)),
        }
    }

    /// A slot behind all others.
    pub fn push(&mut self, slot: Slot, value: T) {
        self.0.push((slot, value));
    }

    /// The slots of a range.
    pub fn range(&self, slots: Range<Slot>) -> &[(Slot, T)] {
        &self.0[self.places(&slots)]
    }

    pub fn remove(&mut self, slots: Range<Slot>) {
        self.0.drain(self.places(&slots));
    }

    pub fn retain(&mut self, mut keeps: impl FnMut(Slot, &mut T) -> bool) {
        self.0.retain_mut(|(slot, value)| keeps(*slot, value));
    }

    pub fn iter(&self) -> std::slice::Iter<'_, (Slot, T)> {
        self.0.iter()
    }

    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, (Slot, T)> {
        self.0.iter_mut()
    }

    fn places(&self, slots: &Range<Slot>) -> Range<usize> {
        let before = |slot: Slot| self.0.partition_point(|(of, _)| *of < slot);
        let begin = before(slots.start);
        begin..before(slots.end).max(begin)
    }
}

/// All slots of two maps, each once, in their order.
pub(super) fn of_both<A, B>(a: &Slots<A>, b: &Slots<B>) -> Vec<Slot> {
    let (mut a, mut b) = (a.iter().map(|(slot, _)| *slot).peekable(), b.iter().map(|(slot, _)| *slot).peekable());
    let mut slots = Vec::with_capacity(a.len().max(b.len()));
    while let Some(next) = a.peek().into_iter().chain(b.peek()).min().copied() {
        a.next_if_eq(&next);
        b.next_if_eq(&next);
        slots.push(next);
    }
    slots
}
