//! Nothing lies on anything, whatever the table.

use super::{Layout, Point, Rect, Size, Wire, layout};

/// Numbers below a limit that look like any others.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % limit
    }

    fn size(&mut self) -> Size {
        Size { width: 40.0 + self.below(200) as f64, height: 20.0 + self.below(80) as f64 }
    }
}

/// So many boxes that the start leads to, and lines between any of them: back, twice, to themselves.
fn table(seed: u64, boxes: usize, more: usize) -> (Vec<Size>, Vec<Wire>) {
    let mut numbers = Numbers(seed);
    let sizes: Vec<Size> = (0..boxes).map(|_| numbers.size()).collect();
    let mut wires: Vec<Wire> =
        (1..boxes).map(|b| Wire { source: numbers.below(b), target: b, label: numbers.size() }).collect();
    for _ in 0..more {
        let (source, target) = (numbers.below(boxes), numbers.below(boxes));
        // Of lines from a box to itself there is one at most: they are merged.
        if source != target || !wires.iter().any(|w| (w.source, w.target) == (source, target)) {
            wires.push(Wire { source, target, label: numbers.size() });
        }
    }
    (sizes, wires)
}

fn overlap(a: Rect, b: Rect) -> bool {
    a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
}

/// Points along a curve.
fn along(curve: &[Point; 4]) -> impl Iterator<Item = Point> {
    let [a, b, c, d] = *curve;
    (0..=20).map(move |i| {
        let t = f64::from(i) / 20.0;
        let u = 1.0 - t;
        let mix =
            |a: f64, b: f64, c: f64, d: f64| u * u * u * a + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * d;
        (mix(a.0, b.0, c.0, d.0), mix(a.1, b.1, c.1, d.1))
    })
}

#[track_caller]
fn check(sizes: &[Size], wires: &[Wire], what: &str) -> Layout {
    let layout = layout(sizes, wires, 0).unwrap();
    let page = Rect { left: -0.1, top: -0.1, right: layout.size.width + 0.1, bottom: layout.size.height + 0.1 };
    let mut all: Vec<Rect> = layout.nodes.clone();
    all.extend(layout.routes.iter().map(|route| route.label));
    for (i, a) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|b| !overlap(*a, *b)), "{what}: {i} lies on another one");
        assert!(a.left >= page.left && a.right <= page.right && a.top >= page.top && a.bottom <= page.bottom, "{what}");
    }
    for (size, area) in sizes.iter().zip(&layout.nodes) {
        assert!(area.right - area.left >= size.width - 1e-9 && (area.bottom - area.top - size.height).abs() < 1e-9);
    }
    for (route, wire) in layout.routes.iter().zip(wires) {
        let (first, last) = (route.curves[0][0], route.curves[route.curves.len() - 1][3]);
        assert!(touches(layout.nodes[wire.source], first) && touches(layout.nodes[wire.target], last), "{what}");
        for (x, y) in route.curves.iter().flat_map(along) {
            let inside = |r: &Rect| x > r.left + 0.5 && x < r.right - 0.5 && y > r.top + 0.5 && y < r.bottom - 0.5;
            assert!(!all.iter().any(inside), "{what}: the line {} -> {} meets something", wire.source, wire.target);
            assert!(x >= page.left && x <= page.right && y >= page.top && y <= page.bottom, "{what}");
        }
    }
    layout
}

/// Whether a point lies on the rim of a rectangle.
fn touches(r: Rect, (x, y): Point) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let within = x >= r.left && x <= r.right && y >= r.top - 1e-6 && y <= r.bottom + 1e-6;
    within && (near(x, r.right) || near(y, r.top) || near(y, r.bottom))
}

#[test]
fn no_label_lies_on_a_box_or_another_label_and_no_line_meets_any() {
    for seed in 0..40 {
        let boxes = 1 + seed as usize % 12;
        let (sizes, wires) = table(seed, boxes, seed as usize % 25);
        check(&sizes, &wires, &format!("table {seed}"));
    }
}

#[test]
fn any_behavior_to_the_same_one_and_pairs_there_and_back() {
    let size = Size { width: 100.0, height: 40.0 };
    let wire = |source, target| Wire { source, target, label: Size { width: 80.0, height: 20.0 } };
    let mut wires: Vec<Wire> = (1..12).flat_map(|b| [wire(b - 1, b), wire(b, b - 1)]).collect();
    wires.extend((0..11).map(|b| wire(b, 11)));
    wires.extend((0..12).map(|b| wire(b, b)));
    let layout = check(&[size; 12], &wires, "a ladder");
    // Each is below the one before, since the start leads down to it over all the others.
    assert!(layout.nodes.windows(2).all(|pair| pair[0].bottom < pair[1].top));
}

#[test]
fn a_single_box_and_a_very_long_table() {
    check(&[Size { width: 100.0, height: 40.0 }], &[], "a single box");
    let (sizes, wires) = table(7, 60, 120);
    check(&sizes, &wires, "a long table");
}

#[test]
fn a_line_down_a_row_of_boxes_is_straight() {
    let size = Size { width: 100.0, height: 40.0 };
    let wire = |source, target| Wire { source, target, label: Size { width: 80.0, height: 20.0 } };
    let layout = check(&[size; 3], &[wire(0, 1), wire(1, 2)], "a row");
    let x = layout.routes[0].curves[0][0].0;
    let straight = |route: &super::Route| route.curves.iter().flatten().all(|p| (p.0 - x).abs() < 0.05);
    assert!(layout.routes.iter().all(straight));
}
