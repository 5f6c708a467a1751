//! A wire between a controller and a vehicle that loses, changes, repeats and delays what it carries.

use std::collections::VecDeque;

/// A generator for tests (SplitMix64): what goes wrong is the same in every run.
pub struct Chance(pub u64);

impl Chance {
    pub fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.draw() % n as u64) as usize
    }

    pub fn happens(&mut self, share: f64) -> bool {
        (self.draw() >> 11) as f64 / (1_u64 << 53) as f64 <= share && share > 0.0
    }
}

/// A wire that loses lines, changes bytes, repeats lines and adds noise, each with the same share of lines.
pub struct Wire {
    pub chance: Chance,
    pub share: f64,
}

/// What is under way on a wire, one portion for each tick that it takes.
#[derive(Default)]
pub struct Delay(VecDeque<Vec<u8>>);

impl Delay {
    pub fn of(ticks: usize) -> Self {
        Delay(std::iter::repeat_n(Vec::new(), ticks).collect())
    }

    /// Puts in what is sent in a tick, and gives what arrives in it.
    pub fn carry(&mut self, bytes: Vec<u8>) -> Vec<u8> {
        self.0.push_back(bytes);
        self.0.pop_front().unwrap_or_default()
    }

    /// The wire becomes longer by some ticks.
    pub fn lengthen(&mut self, ticks: usize) {
        (0..ticks).for_each(|_| self.0.push_front(Vec::new()));
    }
}

impl Wire {
    pub fn carry(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut out = Vec::new();
        for line in bytes.split_inclusive(|b| *b == b'\n') {
            let mut line = line.to_vec();
            if self.chance.happens(self.share) {
                continue;
            }
            if self.chance.happens(self.share) {
                let at = self.chance.below(line.len());
                line[at] = self.chance.draw() as u8;
            }
            if self.chance.happens(self.share) {
                for _ in 0..self.chance.below(40) {
                    out.push(self.chance.draw() as u8);
                }
            }
            if self.chance.happens(self.share) {
                out.extend_from_slice(&line);
            }
            out.extend_from_slice(&line);
        }
        out
    }
}
