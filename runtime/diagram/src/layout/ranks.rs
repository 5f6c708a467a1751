//! In which layer a box is: below all from which lines lead down to it.

use super::Wire;

/// Ranks of boxes, and directions of lines.
pub struct Ranked {
    /// For each box, how many boxes are above it on the longest way down to it.
    pub ranks: Vec<usize>,
    /// For each line, whether it leads back up.
    pub up: Vec<bool>,
}

/// Ranks from the lines. A line leads up if it closes a ring, as one sees who follows the lines from the start, each box's
/// in their order.
pub fn ranks(count: usize, wires: &[Wire], start: usize) -> Ranked {
    let mut walk = Walk { wires, states: vec![State::New; count], up: vec![false; wires.len()], left: Vec::new() };
    walk.follow(start);
    // Every behavior can be reached, but nothing here depends on it.
    (0..count).for_each(|node| walk.follow(node));
    let Walk { up, left, .. } = walk;
    let mut ranks = vec![0; count];
    for &node in left.iter().rev() {
        for (wire, up) in wires.iter().zip(&up) {
            if wire.source == node && !up && wire.target != node {
                ranks[wire.target] = ranks[wire.target].max(ranks[node] + 1);
            }
        }
    }
    Ranked { ranks, up }
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Entered,
    Left,
}

struct Walk<'a> {
    wires: &'a [Wire],
    states: Vec<State>,
    up: Vec<bool>,
    /// Boxes in the order in which they were left: each after all below it.
    left: Vec<usize>,
}

impl Walk<'_> {
    fn follow(&mut self, start: usize) {
        // A stack of our own: a table may have more behaviors in a row than the thread's stack has room for.
        let mut ahead = vec![(start, 0)];
        while let Some((node, wire)) = ahead.pop() {
            if wire == 0 {
                if self.states[node] != State::New {
                    continue;
                }
                self.states[node] = State::Entered;
            }
            let Some(next) = (wire..self.wires.len()).find(|&i| self.wires[i].source == node) else {
                self.states[node] = State::Left;
                self.left.push(node);
                continue;
            };
            ahead.push((node, next + 1));
            match self.states[self.wires[next].target] {
                State::New => ahead.push((self.wires[next].target, 0)),
                State::Entered => self.up[next] = self.wires[next].target != node,
                State::Left => {}
            }
        }
    }
}
