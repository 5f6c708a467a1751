//! Where in its layer an item is: lines as straight as the order and the sizes allow.

use super::Layers;

/// Between two items of a layer.
const GAP: f64 = 16.0;
/// So many times the layers are gone through.
const ROUNDS: usize = 400;
/// Differences of less than this, in pixels, are as good as none.
const NEAR_FIRST: f64 = 4096.0;
const NEAR_LAST: f64 = 1.0;

/// The middle of every item.
///
/// What is made small is the sum of the sideways ways of all lines. Each layer in turn is put where the others want it,
/// which is a problem of least squares; weights that fall with the way itself turn squares into lengths, little by little.
/// Lengths leave a few long bends, where squares would leave many short ones.
pub fn places(layers: &Layers) -> Vec<f64> {
    let mut joined: Vec<Vec<(usize, f64)>> = vec![Vec::new(); layers.items.len()];
    for chain in &layers.chains {
        for (i, pair) in chain.items.windows(2).enumerate() {
            // Boxes have room for a line beside their middle: what a line passes on its way is to be in line first.
            let inner = i > 0 && i + 2 < chain.items.len();
            let weight = if inner { 4.0 } else { 1.0 };
            joined[pair[0]].push((pair[1], weight));
            joined[pair[1]].push((pair[0], weight));
        }
    }
    let mut at = vec![0.0; layers.items.len()];
    let mut near = NEAR_FIRST;
    for round in 0..ROUNDS {
        near = (near * 0.97_f64).max(NEAR_LAST);
        for step in 0..layers.rows.len() {
            let row = &layers.rows[if round % 2 == 0 { step } else { layers.rows.len() - 1 - step }];
            let wanted: Vec<(f64, f64)> = row.iter().map(|&i| wanted(i, &joined[i], &at, near)).collect();
            let apart: Vec<f64> = row
                .windows(2)
                .map(|pair| layers.items[pair[0]].right + GAP + layers.items[pair[1]].left)
                .collect();
            for (&i, x) in row.iter().zip(spread(&wanted, &apart)) {
                at[i] = x;
            }
        }
    }
    at
}

/// Where an item wants to be, and how much.
fn wanted(item: usize, joined: &[(usize, f64)], at: &[f64], near: f64) -> (f64, f64) {
    let (mut sum, mut weights) = (0.0, 0.0);
    for &(other, weight) in joined {
        let weight = weight / (at[other] - at[item]).abs().max(near);
        sum += weight * at[other];
        weights += weight;
    }
    if weights > 0.0 { (sum / weights, weights) } else { (at[item], 1.0) }
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
