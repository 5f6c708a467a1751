//! Taking a guidance state apart into plain numbers and putting it together again.

use albacore_geometry::{Heading, Point};

/// Writes a state into its words, first field first.
pub(crate) struct Writer<const N: usize> {
    words: [f64; N],
    at: usize,
}

/// Reads a state from its words in the order they were written; zero past the end.
pub(crate) struct Reader<'a> {
    words: &'a [f64],
}

impl<const N: usize> Writer<N> {
    #[inline]
    pub(crate) fn new() -> Self {
        Writer { words: [0.0; N], at: 0 }
    }

    #[inline]
    pub(crate) fn number(&mut self, x: f64) -> &mut Self {
        debug_assert!(self.at < N, "a state writes as many words as it declares");
        if let Some(word) = self.words.get_mut(self.at) {
            *word = x;
        }
        self.at += 1;
        self
    }

    #[inline]
    pub(crate) fn flag(&mut self, set: bool) -> &mut Self {
        self.number(if set { 1.0 } else { 0.0 })
    }

    #[inline]
    pub(crate) fn point(&mut self, p: Point) -> &mut Self {
        self.number(p.north).number(p.east)
    }

    #[inline]
    pub(crate) fn heading(&mut self, heading: Heading) -> &mut Self {
        self.number(heading.radians())
    }

    #[inline]
    pub(crate) fn numbers(&mut self, numbers: &[f64]) -> &mut Self {
        for &x in numbers {
            self.number(x);
        }
        self
    }

    #[inline]
    pub(crate) fn finish(&self) -> [f64; N] {
        debug_assert!(self.at == N, "a state writes as many words as it declares");
        self.words
    }
}

impl<'a> Reader<'a> {
    #[inline]
    pub(crate) fn new(words: &'a [f64]) -> Self {
        Reader { words }
    }

    #[inline]
    pub(crate) fn number(&mut self) -> f64 {
        match self.words {
            [first, rest @ ..] => {
                self.words = rest;
                *first
            }
            [] => 0.0,
        }
    }

    #[inline]
    pub(crate) fn flag(&mut self) -> bool {
        self.number() != 0.0
    }

    #[inline]
    pub(crate) fn point(&mut self) -> Point {
        Point { north: self.number(), east: self.number() }
    }

    #[inline]
    pub(crate) fn heading(&mut self) -> Heading {
        Heading::from_radians(self.number())
    }

    #[inline]
    pub(crate) fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }
}
