//! From places to the page: how high each layer is, where a line meets its boxes, and how it bends on its way.

use super::{CORNER, Chain, Item, LOOP, Layers, Layout, PORT, Point, Rect, Route, Size, Wire, place};

/// Between two layers, at least.
const BETWEEN: f64 = 28.0;
/// So much more for each pixel that a line goes sideways there, up to a limit: a bend needs room.
const SLANT: f64 = 0.2;
const BETWEEN_MAX: f64 = 84.0;
/// Straight at each end of a line: room for an arrow.
const STRAIGHT: f64 = 12.0;

/// What was placed, on the page.
pub fn draw(layers: &Layers, nodes: &[Size], wires: &[Wire], places: &[f64]) -> Layout {
    let left = layers.items.iter().zip(places).map(|(item, x)| x - item.left).fold(f64::INFINITY, f64::min);
    let x: Vec<f64> = places.iter().map(|x| x - left).collect();
    let ways = ways(layers, nodes.len(), &x);
    let bands = bands(layers, &ways);
    let width = layers.items.iter().zip(&x).map(|(item, x)| x + item.right).fold(0.0, f64::max);
    let height = bands.last().map_or(0.0, |band| band.1);
    let page = Page { layers, x, bands };
    let routes = layers.chains.iter().zip(wires).zip(&ways);
    Layout {
        size: Size { width, height },
        nodes: (0..nodes.len()).map(|node| page.area(node, nodes[node].height)).collect(),
        routes: routes.map(|((chain, wire), way)| page.route(chain, wire.label, nodes, way)).collect(),
    }
}

/// Where each line is in each layer that it meets: in those of its two boxes, where it meets these.
fn ways(layers: &Layers, nodes: usize, x: &[f64]) -> Vec<Vec<f64>> {
    let way = |chain: &Chain| chain.items.iter().map(|&item| x[item]).collect();
    let mut ways: Vec<Vec<f64>> = layers.chains.iter().map(way).collect();
    for node in 0..nodes {
        for at_top in [false, true] {
            let mut met: Vec<(usize, f64)> = Vec::new();
            for (i, chain) in layers.chains.iter().enumerate() {
                let (end, next) = match (chain.items.as_slice(), at_top) {
                    ([end, next, ..], false) | ([.., next, end], true) => (end, next),
                    _ => continue,
                };
                if *end == node {
                    met.push((i, x[*next]));
                }
            }
            met.sort_by(|a, b| a.1.total_cmp(&b.1));
            for (line, x) in ports(&met, x[node], layers.items[node].left) {
                let way = &mut ways[line];
                let end = if at_top { way.len() - 1 } else { 0 };
                way[end] = x;
            }
        }
    }
    ways
}

/// Where lines from left to right meet a side of a box: each right below or above what it passes next, if the box is so
/// wide, and beside its neighbours.
fn ports(lines: &[(usize, f64)], middle: f64, half: f64) -> Vec<(usize, f64)> {
    let gaps = lines.len().saturating_sub(1);
    let reach = (half - CORNER).max(0.0);
    let apart = if gaps > 0 { PORT.min(2.0 * reach / gaps as f64) } else { 0.0 };
    let wanted: Vec<(f64, f64)> = lines.iter().map(|&(_, x)| (x - middle, 1.0)).collect();
    let spread = place::spread(&wanted, &vec![apart; gaps]);
    let bounded = spread.iter().enumerate().map(|(i, x)| {
        let shift = i as f64 * apart;
        middle + shift + (x - shift).min(reach - gaps as f64 * apart).max(-reach)
    });
    lines.iter().map(|(line, _)| *line).zip(bounded).collect()
}

/// Top and bottom of each layer: as high as what stands in it, and as far from the next as the bends between them need.
fn bands(layers: &Layers, ways: &[Vec<f64>]) -> Vec<(f64, f64)> {
    let mut between = vec![BETWEEN; layers.rows.len()];
    for (chain, way) in layers.chains.iter().zip(ways) {
        for (i, pair) in way.windows(2).enumerate() {
            let gap = &mut between[layers.items[chain.items[i]].layer];
            *gap = gap.max((BETWEEN + SLANT * (pair[1] - pair[0]).abs()).min(BETWEEN_MAX));
        }
    }
    let mut top = 0.0;
    let mut bands = Vec::with_capacity(layers.rows.len());
    for (row, between) in layers.rows.iter().zip(between) {
        let bottom = top + row.iter().map(|&item| layers.items[item].height).fold(0.0, f64::max);
        bands.push((top, bottom));
        top = bottom + between;
    }
    bands
}

struct Page<'a> {
    layers: &'a Layers,
    x: Vec<f64>,
    bands: Vec<(f64, f64)>,
}

impl Page<'_> {
    /// A box or a label, in the middle of its layer's height.
    fn area(&self, item: usize, height: f64) -> Rect {
        let Item { layer, left: half, .. } = self.layers.items[item];
        let (top, bottom) = self.bands[layer];
        let (x, y) = (self.x[item], (top + bottom) / 2.0);
        Rect { left: x - half, top: y - height / 2.0, right: x + half, bottom: y + height / 2.0 }
    }

    fn route(&self, chain: &Chain, label: Size, nodes: &[Size], way: &[f64]) -> Route {
        let (Some(label), [first, inner @ .., last]) = (chain.label, chain.items.as_slice()) else {
            return self.round(chain.items[0], label, nodes);
        };
        let area = |item: usize| self.area(item, nodes.get(item).map_or(0.0, |size| size.height));
        let label_area = self.area(label, self.layers.items[label].height);
        let mut pen = Pen { at: (way[0], area(*first).bottom), curves: Vec::new() };
        pen.down(self.bands[self.layers.items[*first].layer].1 + STRAIGHT);
        for (&item, &x) in inner.iter().zip(&way[1..]) {
            let (top, bottom) = self.bands[self.layers.items[item].layer];
            pen.curve((x, top));
            if item == label {
                pen.down(label_area.top);
                pen.at = (x, label_area.bottom);
            }
            pen.down(bottom);
        }
        let end = area(*last).top;
        pen.curve((way[way.len() - 1], self.bands[self.layers.items[*last].layer].0 - STRAIGHT));
        pen.down(end);
        let mut curves = pen.curves;
        if chain.up {
            curves.reverse();
            curves.iter_mut().for_each(|curve| curve.reverse());
        }
        Route { curves, label: label_area }
    }

    /// A line from a box to itself, at its right side.
    fn round(&self, node: usize, label: Size, nodes: &[Size]) -> Route {
        let area = self.area(node, nodes[node].height);
        let (x, y) = (area.right, (area.top + area.bottom) / 2.0);
        let far = x + LOOP - 6.0;
        let out = [(x, y - 8.0), (x + 12.0, y - 16.0), (far, y - 14.0), (far, y)];
        let home = [(far, y), (far, y + 12.0), (far - 2.0, y + 8.0), (x, y + 8.0)];
        let (left, half) = (x + LOOP, label.height / 2.0);
        let label = Rect { left, top: y - half, right: left + label.width, bottom: y + half };
        Route { curves: vec![out, home], label }
    }
}

/// Draws a line downwards.
struct Pen {
    at: Point,
    curves: Vec<[Point; 4]>,
}

impl Pen {
    /// Straight down.
    fn down(&mut self, y: f64) {
        self.curve((self.at.0, y));
    }

    /// To a point, straight down at both ends.
    fn curve(&mut self, to: Point) {
        let middle = (self.at.1 + to.1) / 2.0;
        if self.at.1 < to.1 {
            self.curves.push([self.at, (self.at.0, middle), (to.0, middle), to]);
        }
        self.at = to;
    }
}
