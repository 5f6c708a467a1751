//! The diagram as a picture.

mod label;
mod shape;

use crate::graph::{Graph, Link};
use crate::layout::{Point, Rect, Route, Size, Wire, layout};
use albacore_lang::diagram::{Diagram, Guard};
use albacore_svg::{Svg, px, text_width};
use label::Label;
use shape::Shape;

/// Around the drawing.
const EDGE: f64 = 24.0;
/// Above the drawing, with the title and the mark of the start.
const TOP: f64 = 92.0;
/// Beneath it, with the key.
const BOTTOM: f64 = 56.0;

/// Letters of a script have one width: that of the widest of the fonts asked for, in parts of their size.
const CODE: &str = "font-family=\"Menlo, Consolas, 'DejaVu Sans Mono', monospace\" font-size=\"11.5\"";
const CODE_SIZE: f64 = 11.5;
const CODE_WIDTH: f64 = 0.61;
const CODE_LINE: f64 = 15.0;
/// Bold letters are wider than others.
const BOLD: f64 = 1.16;
/// Guards and results are broken after so many letters.
const LETTERS: usize = 28;

const INK: &str = "#333";
const BLUE: &str = "#0072b2";
const GREEN: &str = "#00805f";
const RED: &str = "#b84c00";

/// The picture as an SVG document. Whoever points at a line is told its rules in full, with what they do. None: it is too
/// large to be read, and takes long to be laid out.
pub fn svg(diagram: &Diagram) -> Option<String> {
    drawn(diagram, false)
}

/// The same, for a page that shows what is active: the box of a behavior is a group with its index in the diagram (`data-behavior`), a line
/// one with those of both its ends (`data-from`, `data-to`; the ends of a strategy come after its behaviors).
pub fn marked_svg(diagram: &Diagram) -> Option<String> {
    drawn(diagram, true)
}

fn drawn(diagram: &Diagram, is_marked: bool) -> Option<String> {
    let graph = Graph::new(diagram);
    let shapes: Vec<Shape> = graph.nodes.iter().map(Shape::new).collect();
    let labels: Vec<Label> = graph.links.iter().map(Label::new).collect();
    let wire = |(link, label): (&Link, &Label)| Wire { source: link.source, target: link.target, label: label.size };
    let wires: Vec<Wire> = graph.links.iter().zip(&labels).map(wire).collect();
    let sizes: Vec<Size> = shapes.iter().map(Shape::size).collect();
    let layout = layout(&sizes, &wires, diagram.start)?;

    let keys = key(&graph);
    let key_width = text_width(&keys, 12.0);
    let title_width = text_width(&diagram.name, 20.0) * BOLD;
    let width = layout.size.width.max(key_width).max(title_width) + 2.0 * EDGE;
    let height = layout.size.height + TOP + BOTTOM;
    let left = ((width - layout.size.width) / 2.0).floor();
    let page = Placed { left, top: TOP };

    let mut svg = Svg::new(width, height);
    svg.text((EDGE, 38.0), "font-size=\"20\" font-weight=\"bold\" fill=\"#1a1a1a\"", &diagram.name);
    for ((link, label), route) in graph.links.iter().zip(&labels).zip(&layout.routes) {
        let mark = if is_marked {
            format!(" data-from=\"{}\" data-to=\"{}\"", link.source, link.target)
        } else {
            String::new()
        };
        svg.titled(&spelt(&graph, link), &format!("{CODE}{mark}"), |svg| {
            page.line(svg, link, route);
            label.draw(svg, page.area(route.label));
        });
    }
    for (i, (shape, area)) in shapes.iter().zip(&layout.nodes).enumerate() {
        if is_marked {
            svg.raw(&format!("<g data-behavior=\"{i}\">"));
        }
        shape.draw(&mut svg, page.area(*area));
        if is_marked {
            svg.raw("</g>");
        }
    }
    page.start(&mut svg, layout.nodes[diagram.start]);
    svg.text((EDGE, height - 22.0), "font-size=\"12\" fill=\"#666\"", &keys);
    Some(svg.finish())
}

/// What the picture does not say by itself.
fn key(graph: &Graph) -> String {
    let mut key = String::from("Rules are tried in the order of their numbers.");
    if graph.links.iter().any(|link| link.back) {
        key.push_str(" Dashed: and back, when done.");
    }
    key
}

/// A line's rules in full.
fn spelt(graph: &Graph, link: &Link) -> String {
    let (source, target) = (graph.nodes[link.source].text(), graph.nodes[link.target].text());
    let back = if link.back { " then back" } else { "" };
    let rule = |guard: &Guard| {
        let effect = guard.effect.as_ref().map(|effect| format!(" do {{ {effect} }}")).unwrap_or_default();
        format!("{source} -> {target} on {}{back}{effect}", guard.on)
    };
    link.guards.iter().map(rule).collect::<Vec<_>>().join("; ")
}

/// The drawing's place on the page.
struct Placed {
    left: f64,
    top: f64,
}

impl Placed {
    fn at(&self, (x, y): Point) -> Point {
        (x + self.left, y + self.top)
    }

    fn area(&self, area: Rect) -> Rect {
        let ((left, top), (right, bottom)) = (self.at((area.left, area.top)), self.at((area.right, area.bottom)));
        Rect { left, top, right, bottom }
    }

    /// A dot from which an arrow leads to the first behavior.
    fn start(&self, svg: &mut Svg, area: Rect) {
        let area = self.area(area);
        let (x, y) = ((area.left + area.right) / 2.0, area.top);
        svg.circle((x, y - 30.0), 5.5, "fill=\"#1a1a1a\"");
        svg.line((x, y - 30.0), (x, y - 6.0), "stroke=\"#1a1a1a\" stroke-width=\"1.5\"");
        arrow(svg, (x, y), (0.0, 1.0), "fill=\"#1a1a1a\"");
    }

    fn line(&self, svg: &mut Svg, link: &Link, route: &Route) {
        let (Some(first), Some(last)) = (route.curves.first(), route.curves.last()) else { return };
        let mut data = String::new();
        let mut curves = route.curves.iter().map(|curve| curve.map(|point| self.at(point))).peekable();
        let mut pen = None;
        while let Some([from, c, d, to]) = curves.next() {
            if pen != Some(from) {
                data.push_str(&format!("M{}", pair(from)));
            }
            pen = Some(to);
            let goes_on = curves.peek().is_some_and(|[next, .., end]| *next == to && next.0 == end.0);
            if from.0 != to.0 {
                data.push_str(&format!("C{} {} {}", pair(c), pair(d), pair(to)));
            } else if !goes_on {
                data.push_str(&format!("L{}", pair(to)));
            }
        }
        let dashes = if link.back { " stroke-dasharray=\"6 4\"" } else { "" };
        svg.raw(&format!("<path d=\"{data}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.4\"{dashes}/>"));
        arrow(svg, self.at(last[3]), direction(last[2], last[3]), &format!("fill=\"{INK}\""));
        if link.back {
            let hollow = format!("fill=\"#fff\" stroke=\"{INK}\" stroke-width=\"1.2\"");
            arrow(svg, self.at(first[0]), direction(first[1], first[0]), &hollow);
        }
    }
}

/// An arrowhead whose tip is at a point.
fn arrow(svg: &mut Svg, tip: Point, (dx, dy): (f64, f64), attributes: &str) {
    let back = |along: f64, across: f64| (tip.0 - along * dx - across * dy, tip.1 - along * dy + across * dx);
    svg.path(&[tip, back(10.0, 4.0), back(10.0, -4.0)], true, attributes);
}

/// The direction of a line that ends.
fn direction(from: Point, to: Point) -> (f64, f64) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = (dx * dx + dy * dy).sqrt();
    if length > 0.0 { (dx / length, dy / length) } else { (0.0, 1.0) }
}

fn pair((x, y): Point) -> String {
    format!("{} {}", px(x), px(y))
}
