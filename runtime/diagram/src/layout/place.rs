//! Where in its layer an item is: lines as straight as the order and the sizes allow.

use super::{CORNER, Chain, Layers};

/// Between two items of a layer.
const GAP: f64 = 16.0;
/// So many times the layers are gone through,
const ROUNDS: usize = 1200;
/// or fewer, so that no more items than these are placed, all in all: more than enough for any table that one can read.
const PLACINGS_MAX: usize = 20_000_000;
/// Ways of less than this, in pixels, are as good as none: much at first, then less and less.
const NEAR_FIRST: f64 = 4096.0;
const NEARER: f64 = 0.99;
const NEAR_LAST: f64 = 0.1;
/// How much more a line is to be straight between what it passes than at its ends.
const INNER: f64 = 8.0;
/// And how much more when it leads down, as a diagram is read.
const DOWN: f64 = 2.0;
/// How much lines want to meet boxes at their middle, where they need not.
const MIDDLE: f64 = 0.3;
/// A line that only just meets its box straight is to do so for certain.
const SLACK: f64 = 2.0;
/// A line that goes sideways by less than this, in pixels, looks crooked, and goes straight if there is nearly room.
const CROOKED: f64 = 10.0;

/// The middle of every item.
///
/// What is made small is how far lines go sideways. Each layer in turn is put where the others want it, which is a problem
/// of least squares; weights that fall with the way itself turn its square into its root, little by little. Squares would
/// give each line many short bends; roots leave it one long one.
pub fn places(layers: &Layers) -> Vec<f64> {
    let joined = joined(layers);
    let room = |pair: &[usize]| layers.items[pair[0]].right + GAP + layers.items[pair[1]].left;
    let apart: Vec<Vec<f64>> = layers.rows.iter().map(|row| row.windows(2).map(room).collect()).collect();
    let mut at = vec![0.0; layers.items.len()];
    let mut wanted_places = Vec::new();
    let mut near = NEAR_FIRST;
    let stride = (ROUNDS * layers.items.len()).div_ceil(PLACINGS_MAX).max(1);
    for round in 0..ROUNDS / stride {
        near = (0..stride).fold(near, |near, _| near * NEARER).max(NEAR_LAST);
        for step in 0..layers.rows.len() {
            let layer = if round % 2 == 0 { step } else { layers.rows.len() - 1 - step };
            let row = &layers.rows[layer];
            wanted_places.clear();
            wanted_places.extend(row.iter().map(|&i| wanted(at[i], &joined[i], &at, near)));
            for (&i, x) in row.iter().zip(spread(&wanted_places, &apart[layer])) {
                at[i] = x;
            }
        }
    }
    for chain in &layers.chains {
        straighten(layers, chain, &mut at);
    }
    at
}

/// Takes small steps out of a line between its boxes: from its label on, what it passes goes where it comes from.
fn straighten(layers: &Layers, chain: &Chain, at: &mut [f64]) {
    let Some(inner) = chain.items.len().checked_sub(1).and_then(|last| chain.items.get(1..last)) else { return };
    let mut inner = inner.to_vec();
    if chain.up {
        inner.reverse();
    }
    for pair in inner.windows(2) {
        let (to, item) = (at[pair[0]], pair[1]);
        let row = &layers.rows[layers.items[item].layer];
        let place = row.iter().position(|i| *i == item).unwrap_or(0);
        let clear =
            |a: usize, b: usize, ax: f64, bx: f64| ax + layers.items[a].right + GAP / 2.0 <= bx - layers.items[b].left;
        let left = place.checked_sub(1).is_none_or(|left| clear(row[left], item, at[row[left]], to));
        let right = row.get(place + 1).is_none_or(|&right| clear(item, right, to, at[right]));
        if (at[item] - to).abs() < CROOKED && left && right {
            at[item] = to;
        }
    }
}

/// How an item is joined to another one.
struct Joint {
    to: usize,
    weight: f64,
    /// So far sideways the line needs no bend, since it meets a box beside its middle.
    reach: f64,
}

fn joined(layers: &Layers) -> Vec<Vec<Joint>> {
    let mut joined: Vec<Vec<Joint>> = layers.items.iter().map(|_| Vec::new()).collect();
    for chain in &layers.chains {
        for (i, pair) in chain.items.windows(2).enumerate() {
            let is_first = i == 0;
            let is_last = i + 2 == chain.items.len();
            let inner = if is_first || is_last { 1.0 } else { INNER };
            let weight = if chain.up { inner } else { inner * DOWN };
            let item = pair[usize::from(is_last)];
            let reach = if is_first || is_last { (layers.items[item].left - CORNER - SLACK).max(0.0) } else { 0.0 };
            joined[pair[0]].push(Joint { to: pair[1], weight, reach });
            joined[pair[1]].push(Joint { to: pair[0], weight, reach });
        }
    }
    joined
}

/// Where an item wants to be, and how much.
fn wanted(x: f64, joined: &[Joint], at: &[f64], near: f64) -> (f64, f64) {
    let (mut sum, mut weights) = (0.0, 0.0);
    let mut pull = |to: f64, weight: f64| {
        let way = (to - x).abs().max(near);
        let weight = weight / (way * way.sqrt());
        sum += weight * to;
        weights += weight;
    };
    for joint in joined {
        let to = at[joint.to];
        pull(x.clamp(to - joint.reach, to + joint.reach), joint.weight);
        pull(to, joint.weight * MIDDLE);
    }
    if weights > 0.0 { (sum / weights, weights) } else { (x, 1.0) }
}

/// Places in order, with distances between them of at least `apart`, and as near as possible to where each is wanted, by
/// the weights of each.
pub fn spread(wanted: &[(f64, f64)], apart: &[f64]) -> Vec<f64> {
    // Without the distances they need only be in order, and those that are not share their mean.
    let mut before = 0.0;
    let mut shifts = Vec::with_capacity(wanted.len());
    let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
    for (i, &(x, weight)) in wanted.iter().enumerate() {
        before += i.checked_sub(1).and_then(|gap| apart.get(gap)).copied().unwrap_or(0.0);
        shifts.push(before);
        let mut block = (x - before, weight, 1);
        while let Some(&(x, weight, count)) = blocks.last().filter(|last| last.0 > block.0) {
            let weights = weight + block.1;
            block = ((x * weight + block.0 * block.1) / weights, weights, count + block.2);
            blocks.pop();
        }
        blocks.push(block);
    }
    let places = blocks.iter().flat_map(|&(x, _, count)| std::iter::repeat_n(x, count));
    places.zip(shifts).map(|(x, shift)| x + shift).collect()
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn what_has_room_stays_and_what_has_none_shares_it() {
        assert_eq!(spread(&[(0.0, 1.0), (50.0, 1.0)], &[10.0]), [0.0, 50.0]);
        assert_eq!(spread(&[(0.0, 1.0), (0.0, 1.0)], &[10.0]), [-5.0, 5.0]);
        assert_eq!(spread(&[(0.0, 3.0), (0.0, 1.0)], &[8.0]), [-2.0, 6.0]);
    }
}
