//! The order within each layer: few crossings.

use super::Layers;

/// So many times the layers are gone through, down and up by turns.
const SWEEPS: usize = 24;

/// Which items of the layer above, and of the layer below, each item is joined to.
struct Joined {
    above: Vec<Vec<usize>>,
    below: Vec<Vec<usize>>,
}

/// Orders the rows: from both an order and its mirror image, since neither is better to begin with.
pub fn arrange(layers: &mut Layers) {
    let mut joined =
        Joined { above: vec![Vec::new(); layers.items.len()], below: vec![Vec::new(); layers.items.len()] };
    for (above, below) in layers.joints() {
        joined.below[above].push(below);
        joined.above[below].push(above);
    }
    let mirrored = layers.rows.iter().map(|row| row.iter().rev().copied().collect()).collect();
    let mut best: Option<(usize, Vec<Vec<usize>>)> = None;
    for first in [std::mem::take(&mut layers.rows), mirrored] {
        let mut rows: Vec<Vec<usize>> = first;
        for sweep in 0..SWEEPS {
            sweep_once(&mut rows, &joined, sweep % 2 == 0);
            transpose(&mut rows, &joined);
            let crossings = crossings(&rows, &joined);
            if best.as_ref().is_none_or(|(least, _)| crossings < *least) {
                best = Some((crossings, rows.clone()));
            }
        }
    }
    layers.rows = best.map(|(_, rows)| rows).unwrap_or_default();
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
            sum += pair[0][i + 1..].iter().map(|&b| inverted(&joined.below[a], &joined.below[b], &place)).sum::<usize>();
        }
    }
    sum
}

/// How often lines from the left one of two items end to the right of lines from the other.
fn inverted(left: &[usize], right: &[usize], place: &[usize]) -> usize {
    left.iter().map(|&l| right.iter().filter(|&&r| place[l] > place[r]).count()).sum()
}
