//! The order within each layer: few crossings.

use super::Layers;

/// So many times the layers are gone through, down and up by turns, from each order that is tried.
const SWEEPS: usize = 12;
/// Pairs of neighbours that are looked at, all in all: more than enough for any table that one can read.
const COST_MAX: usize = 1_000_000;

/// Which items of the layer above, and of the layer below, each item is joined to.
struct Joined {
    above: Vec<Vec<usize>>,
    below: Vec<Vec<usize>>,
}

/// Orders the rows. What is tried from is an order and its mirror image, since neither is better to begin with, and then
/// the best so far with one whole line moved to the left or to the right of everything: a line that is on the wrong side of
/// a box in several layers gets away from there in no smaller step.
pub fn arrange(layers: &mut Layers) {
    let mut joined =
        Joined { above: vec![Vec::new(); layers.items.len()], below: vec![Vec::new(); layers.items.len()] };
    for (above, below) in layers.joints() {
        joined.below[above].push(below);
        joined.above[below].push(above);
    }
    let mut best = Best { crossings: usize::MAX, rows: Vec::new() };
    let rows = std::mem::take(&mut layers.rows);
    best.improve(rows.iter().map(|row| row.iter().rev().copied().collect()).collect(), &joined);
    best.improve(rows, &joined);
    // What a try costs grows with the square of the rows.
    let cost: usize = best.rows.iter().map(|row| row.len() * row.len()).sum();
    let mut tries = COST_MAX / cost.max(1);
    loop {
        let before = best.crossings;
        for chain in layers.chains.iter().filter(|chain| chain.items.len() > 3) {
            let moved = |i: &usize| chain.items[1..chain.items.len() - 1].contains(i);
            for to_right in [false, true] {
                if best.crossings == 0 || tries == 0 {
                    break;
                }
                tries -= 1;
                let mut rows = best.rows.clone();
                rows.iter_mut().for_each(|row| row.sort_by_key(|i| moved(i) == to_right));
                best.improve(rows, &joined);
            }
        }
        if best.crossings == before {
            break;
        }
    }
    layers.rows = best.rows;
}

/// The best order so far.
struct Best {
    crossings: usize,
    rows: Vec<Vec<usize>>,
}

impl Best {
    /// Keeps the best order to which sweeps lead from another one.
    fn improve(&mut self, mut rows: Vec<Vec<usize>>, joined: &Joined) {
        for sweep in 0..SWEEPS {
            transpose(&mut rows, joined);
            let crossings = crossings(&rows, joined);
            if crossings < self.crossings {
                *self = Best { crossings, rows: rows.clone() };
            }
            sweep_once(&mut rows, joined, sweep % 2 == 0);
        }
    }
}

/// Puts each item of a layer to the mean place of those that it is joined to in the layer before.
fn sweep_once(rows: &mut [Vec<usize>], joined: &Joined, down: bool) {
    let neighbours = if down { &joined.above } else { &joined.below };
    let count = rows.len();
    let mut place = places(rows, neighbours.len());
    for step in 1..count {
        let at = if down { step } else { count - 1 - step };
        let mean = |i: usize, own: usize| match neighbours[i].as_slice() {
            [] => own as f64,
            them => them.iter().map(|&n| place[n] as f64).sum::<f64>() / them.len() as f64,
        };
        let mut keyed: Vec<(f64, usize)> = rows[at].iter().enumerate().map(|(own, &i)| (mean(i, own), i)).collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows[at] = keyed.into_iter().map(|(_, i)| i).collect();
        rows[at].iter().enumerate().for_each(|(own, &i)| place[i] = own);
    }
}

/// Exchanges neighbours as long as that saves crossings.
fn transpose(rows: &mut [Vec<usize>], joined: &Joined) {
    let mut place = places(rows, joined.above.len());
    // Rows that were exchanged in, or are next to one that was, since they were last gone through.
    let mut stale = vec![true; rows.len()];
    while stale.contains(&true) {
        for (at, row) in rows.iter_mut().enumerate() {
            let mut improved = false;
            for i in (1..row.len()).filter(|_| stale[at]) {
                let (a, b) = (row[i - 1], row[i]);
                let cost = |a: usize, b: usize| {
                    inverted(&joined.above[a], &joined.above[b], &place)
                        + inverted(&joined.below[a], &joined.below[b], &place)
                };
                if cost(b, a) < cost(a, b) {
                    row.swap(i - 1, i);
                    (place[a], place[b]) = (i, i - 1);
                    improved = true;
                }
            }
            stale[at] = improved;
            for next in [at.wrapping_sub(1), at + 1] {
                if let Some(next) = stale.get_mut(next) {
                    *next |= improved;
                }
            }
        }
    }
}

/// Where in its row each item is.
fn places(rows: &[Vec<usize>], items: usize) -> Vec<usize> {
    let mut places = vec![0; items];
    rows.iter().flat_map(|row| row.iter().enumerate()).for_each(|(place, &i)| places[i] = place);
    places
}

/// How many lines cross.
fn crossings(rows: &[Vec<usize>], joined: &Joined) -> usize {
    let place = places(rows, joined.below.len());
    let mut ends = Vec::new();
    let mut sum = 0;
    for pair in rows.windows(2) {
        ends.clear();
        for &item in &pair[0] {
            let first = ends.len();
            ends.extend(joined.below[item].iter().map(|&below| place[below]));
            ends[first..].sort_unstable();
        }
        sum += inversions(&ends, pair[1].len());
    }
    sum
}

/// How many pairs of numbers below a limit are in falling order.
fn inversions(numbers: &[usize], limit: usize) -> usize {
    // How many of the numbers so far are in each of the ranges that a number's binary digits name (Fenwick 1994).
    let mut counts = vec![0; limit + 1];
    let mut sum = 0;
    for (before, &number) in numbers.iter().enumerate() {
        let mut not_greater = 0;
        let mut at = number + 1;
        while at > 0 {
            not_greater += counts[at];
            at &= at - 1;
        }
        sum += before - not_greater;
        at = number + 1;
        while at <= limit {
            counts[at] += 1;
            at += at & at.wrapping_neg();
        }
    }
    sum
}

/// How often lines from the left one of two items end to the right of lines from the other.
fn inverted(left: &[usize], right: &[usize], place: &[usize]) -> usize {
    left.iter().map(|&l| right.iter().filter(|&&r| place[l] > place[r]).count()).sum()
}

#[cfg(test)]
mod tests {
    use super::inversions;

    #[test]
    fn each_pair_in_falling_order_counts_once() {
        assert_eq!(inversions(&[0, 1, 1, 2], 3), 0);
        assert_eq!(inversions(&[2, 1, 1, 0], 3), 5);
        assert_eq!(inversions(&[3, 0, 2, 1], 4), 4);
        assert_eq!(inversions(&[], 0), 0);
    }
}
