//! Where everything of a diagram is: boxes in layers from top to bottom, lines between the layers, and a label on each line.
//!
//! It knows sizes only, no texts. A label takes a place in a layer of its own, between those of boxes, and a line that goes
//! past a layer takes a place in it. Lines bend between layers only, and within a layer go straight down at the place that
//! they have there. So no line meets a box or a label, and no label another.

mod order;
mod place;
mod ranks;
mod route;
#[cfg(test)]
mod tests;

/// A point of the page, in pixels right and down.
pub type Point = (f64, f64);

/// Room that lines which only go past a layer take in it, to each side.
const BEND: f64 = 6.0;
/// How far the line from a box to itself goes out.
pub const LOOP: f64 = 28.0;
/// Between two lines that meet the same side of a box.
const PORT: f64 = 20.0;
/// From the side of a box to the next line that meets it.
const CORNER: f64 = 14.0;

/// So much can take a place in a diagram that is laid out: more than one can read, and it takes seconds.
const PLACES_MAX: usize = 20_000;

/// A width and a height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    pub width: f64,
    pub height: f64,
}

/// A rectangle on the page.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

/// A line to be laid out: the boxes it joins, and the size of its label.
#[derive(Clone, Copy, Debug)]
pub struct Wire {
    pub source: usize,
    pub target: usize,
    pub label: Size,
}

/// Where a line goes.
#[derive(Clone, Debug, Default)]
pub struct Route {
    /// From source to target: pieces of Bézier curves, each with its two ends and between them its two handles. They join
    /// but for the gap that the label fills.
    pub curves: Vec<[Point; 4]>,
    /// Its label.
    pub label: Rect,
}

/// Where everything is.
#[derive(Clone, Debug)]
pub struct Layout {
    /// All that is drawn lies between nothing and this.
    pub size: Size,
    /// The boxes, perhaps wider than asked for.
    pub nodes: Vec<Rect>,
    /// The lines.
    pub routes: Vec<Route>,
}

/// Something that has a place in a layer: a box, a label, or a line that goes past.
#[derive(Clone, Copy, Debug)]
struct Item {
    layer: usize,
    /// Room to the left of its middle.
    left: f64,
    /// Room to the right of its middle.
    right: f64,
    height: f64,
}

/// A line without its direction.
#[derive(Clone, Debug)]
struct Chain {
    /// The box above, what the line passes in the layers below it, and the box at its lower end. Of a line from a box to
    /// itself only the box.
    items: Vec<usize>,
    /// The item that is its label; `None` for a line from a box to itself.
    label: Option<usize>,
    /// It goes up.
    up: bool,
}

/// All that has a place. The first items are the boxes.
struct Layers {
    items: Vec<Item>,
    chains: Vec<Chain>,
    /// The items of each layer from left to right: boxes in the even ones, labels in the odd ones.
    rows: Vec<Vec<usize>>,
}

/// Lays a diagram out. `start` is the box at the top, from which the lines lead to all others. None: more of it takes a place
/// than [`PLACES_MAX`].
pub fn layout(nodes: &[Size], wires: &[Wire], start: usize) -> Option<Layout> {
    if nodes.len() + wires.len() > PLACES_MAX {
        return None;
    }
    let ranked = ranks::ranks(nodes.len(), wires, start);
    let rank = |node: usize| ranked.ranks[node];
    let passed = |wire: &Wire| (2 * rank(wire.source).abs_diff(rank(wire.target))).saturating_sub(1);
    if nodes.len() + wires.iter().map(passed).sum::<usize>() > PLACES_MAX {
        return None;
    }
    let mut layers = Layers::new(nodes, wires, &ranked);
    order::arrange(&mut layers);
    let places = place::places(&layers);
    Some(route::draw(&layers, nodes, wires, &places))
}

impl Layers {
    fn new(nodes: &[Size], wires: &[Wire], ranked: &ranks::Ranked) -> Self {
        let items = nodes.iter().zip(&ranked.ranks).map(|(size, rank)| {
            let half = size.width / 2.0;
            Item { layer: 2 * rank, left: half, right: half, height: size.height }
        });
        let depth = ranked.ranks.iter().max().map_or(0, |rank| 2 * rank + 1);
        let mut layers = Layers { items: items.collect(), chains: Vec::new(), rows: vec![Vec::new(); depth] };
        for (wire, &up) in wires.iter().zip(&ranked.up) {
            let chain = layers.chain(wire, up);
            layers.chains.push(chain);
        }
        layers.widen();
        for (i, wire) in wires.iter().enumerate() {
            if layers.chains[i].label.is_none() {
                let item = &mut layers.items[wire.source];
                item.right += LOOP + wire.label.width;
                item.height = item.height.max(wire.label.height);
            }
        }
        for (i, item) in layers.items.iter().enumerate() {
            layers.rows[item.layer].push(i);
        }
        layers
    }

    /// A line through the layers. Its label stands next to the box that it leaves: there one looks for what comes next.
    fn chain(&mut self, wire: &Wire, up: bool) -> Chain {
        if wire.source == wire.target {
            return Chain { items: vec![wire.source], label: None, up };
        }
        let (above, below) = if up { (wire.target, wire.source) } else { (wire.source, wire.target) };
        let (first, last) = (self.items[above].layer + 1, self.items[below].layer - 1);
        let labelled = if up { last } else { first };
        let mut items = vec![above];
        let mut label = None;
        for layer in first..=last {
            let id = self.items.len();
            items.push(id);
            self.items.push(if layer == labelled {
                label = Some(id);
                let half = wire.label.width / 2.0;
                Item { layer, left: half, right: half, height: wire.label.height }
            } else {
                Item { layer, left: BEND, right: BEND, height: 0.0 }
            });
        }
        items.push(below);
        Chain { items, label, up }
    }

    /// Makes boxes as wide as the lines need that meet them.
    fn widen(&mut self) {
        let mut met = vec![(0_u32, 0_u32); self.items.len()];
        for (above, below) in self.joints() {
            met[above].1 += 1;
            met[below].0 += 1;
        }
        for (item, (above, below)) in self.items.iter_mut().zip(met).filter(|(item, _)| item.layer % 2 == 0) {
            let half = f64::from(above.max(below).saturating_sub(1)) * PORT / 2.0 + CORNER;
            (item.left, item.right) = (item.left.max(half), item.right.max(half));
        }
    }

    /// What a line joins from one layer to the next.
    fn joints(&self) -> impl Iterator<Item = (usize, usize)> {
        self.chains.iter().flat_map(|chain| chain.items.windows(2).map(|pair| (pair[0], pair[1])))
    }
}
