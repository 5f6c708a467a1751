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
    for step in 1..count {
        let (at, before) = if down { (step, step - 1) } else { (count - 1 - step, count - step) };
        let place = places(&rows[before], neighbours.len());
        let mean = |i: usize, own: usize| match neighbours[i].as_slice() {
            [] => own as f64,
            them => them.iter().map(|&n| place[n] as f64).sum::<f64>() / them.len() as f64,
        };
        let mut keyed: Vec<(f64, usize)> = rows[at].iter().enumerate().map(|(own, &i)| (mean(i, own), i)).collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows[at] = keyed.into_iter().map(|(_, i)| i).collect();
    }
}

/// Exchanges neighbours as long as that saves crossings.
fn transpose(rows: &mut [Vec<usize>], joined: &Joined) {
    let mut improved = true;
    while improved {
        improved = false;
        for at in 0..rows.len() {
            let above = at.checked_sub(1).map(|above| places(&rows[above], joined.above.len())).unwrap_or_default();
            let below = rows.get(at + 1).map(|row| places(row, joined.below.len())).unwrap_or_default();
            for i in 1..rows[at].len() {
                let (a, b) = (rows[at][i - 1], rows[at][i]);
                let cost = |a: usize, b: usize| {
                    inverted(&joined.above[a], &joined.above[b], &above)
                        + inverted(&joined.below[a], &joined.below[b], &below)
                };
                if cost(b, a) < cost(a, b) {
                    rows[at].swap(i - 1, i);
                    improved = true;
                }
            }
        }
    }
}

/// Where in a row each item is.
fn places(row: &[usize], items: usize) -> Vec<usize> {
    let mut places = vec![0; items];
    row.iter().enumerate().for_each(|(place, &i)| places[i] = place);
    places
}

fn crossings(rows: &[Vec<usize>], joined: &Joined) -> usize {
    let mut sum = 0;
    for pair in rows.windows(2) {
        let place = places(&pair[1], joined.below.len());
        for (i, &a) in pair[0].iter().enumerate() {
            sum +=
                pair[0][i + 1..].iter().map(|&b| inverted(&joined.below[a], &joined.below[b], &place)).sum::<usize>();
        }
    }
    sum
}

/// How often lines from the left one of two items end to the right of lines from the other.
fn inverted(left: &[usize], right: &[usize], place: &[usize]) -> usize {
    left.iter().map(|&l| right.iter().filter(|&&r| place[l] > place[r]).count()).sum()
}
