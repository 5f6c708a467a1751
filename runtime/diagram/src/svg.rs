//! The diagram as a picture.

use crate::graph::{Graph, Link, Node};
use crate::layout::{Layout, Point, Rect, Route, Size, Wire, layout};
use crate::wrap::wrapped;
use albacore_lang::diagram::{Diagram, Guard};
use albacore_svg::{Svg, px, text_width};

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
const NAME_SIZE: f64 = 14.0;
/// Guards and results are broken after so many letters.
const LETTERS: usize = 28;

const INK: &str = "#333";
const BLUE: &str = "#0072b2";
const GREEN: &str = "#00805f";
const RED: &str = "#b84c00";

/// The picture as an SVG document. Whoever points at a line is told its rules in full, with what they do.
pub fn svg(diagram: &Diagram) -> String {
    let graph = Graph::new(diagram);
    let (labels, layout) = laid_out(&graph, diagram.start);
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
        svg.titled(&spelt(&graph, link), CODE, |svg| {
            page.line(svg, link, route);
            page.label(svg, label, route.label);
        });
    }
    for (node, area) in graph.nodes.iter().zip(&layout.nodes) {
        page.node(&mut svg, node, *area);
    }
    page.start(&mut svg, layout.nodes[diagram.start]);
    svg.text((EDGE, height - 22.0), "font-size=\"12\" fill=\"#666\"", &keys);
    svg.finish()
}

/// What the picture does not say by itself.
fn key(graph: &Graph) -> String {
    let mut key = String::from("Rules are tried in the order of their numbers.");
    if graph.links.iter().any(|link| link.back) {
        key.push_str(" Dashed: and back, when done.");
    }
    key
}

/// A label: for each guard its number and its lines.
struct Label {
    guards: Vec<(usize, Vec<String>)>,
    back: bool,
    /// The room of the numbers.
    indent: f64,
    size: Size,
}

impl Label {
    fn new(link: &Link) -> Self {
        let guards: Vec<(usize, Vec<String>)> =
            link.guards.iter().map(|guard| (guard.rule, wrapped(&guard.on, LETTERS))).collect();
        let widest = |texts: &mut dyn Iterator<Item = String>| {
            texts.map(|text| text.chars().count()).max().unwrap_or(0) as f64 * CODE_SIZE * CODE_WIDTH
        };
        let indent = widest(&mut guards.iter().map(|(rule, _)| rule.to_string())) + 7.0;
        let back = link.back.then(|| BACK.to_string());
        let text = widest(&mut guards.iter().flat_map(|(_, lines)| lines.clone()).chain(back));
        let lines = guards.iter().map(|(_, lines)| lines.len()).sum::<usize>() + usize::from(link.back);
        let size = Size { width: indent + text + 8.0, height: lines as f64 * CODE_LINE + 6.0 };
        Label { guards, back: link.back, indent, size }
    }
}

/// What stands beneath the guards of a line that comes back.
const BACK: &str = "then back";

/// Labels and places.
fn laid_out(graph: &Graph, start: usize) -> (Vec<Label>, Layout) {
    let labels: Vec<Label> = graph.links.iter().map(Label::new).collect();
    let wires: Vec<Wire> = graph
        .links
        .iter()
        .zip(&labels)
        .map(|(link, label)| Wire { source: link.source, target: link.target, label: label.size })
        .collect();
    let sizes: Vec<Size> = graph.nodes.iter().map(size).collect();
    let layout = layout(&sizes, &wires, start);
    (labels, layout)
}

/// The word of an end, and the lines beneath it.
fn end(node: &Node) -> (&'static str, Vec<String>) {
    match node {
        Node::Behavior(_) | Node::Finish(None) => ("finish", Vec::new()),
        Node::Finish(Some(result)) => ("finish", wrapped(result, LETTERS)),
        Node::Abort(why) => ("abort", wrapped(why, LETTERS)),
    }
}

fn size(node: &Node) -> Size {
    let bold = |text: &str| text_width(text, NAME_SIZE) * BOLD;
    match node {
        Node::Behavior(name) => Size { width: (bold(name) + 32.0).max(120.0).ceil(), height: 40.0 },
        _ => {
            let (word, lines) = end(node);
            let letters = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0) as f64;
            let width = bold(word).max(letters * CODE_SIZE * CODE_WIDTH) + 36.0;
            Size { width: width.max(120.0).ceil(), height: 40.0 + CODE_LINE * lines.len() as f64 }
        }
    }
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

    fn node(&self, svg: &mut Svg, node: &Node, area: Rect) {
        let area = self.area(area);
        let (x, y) = ((area.left + area.right) / 2.0, (area.top + area.bottom) / 2.0);
        let bold = |colour: &str| {
            format!("font-size=\"{NAME_SIZE}\" font-weight=\"bold\" text-anchor=\"middle\" fill=\"{colour}\"")
        };
        if let Node::Behavior(name) = node {
            rectangle(svg, area, 0.0, 8.0, &format!("fill=\"#eaf3fa\" stroke=\"{BLUE}\" stroke-width=\"1.6\""));
            svg.text((x, y + NAME_SIZE * 0.35), &bold("#123"), name);
            return;
        }
        let (colour, fill) = if let Node::Abort(_) = node { (RED, "#fdf0e8") } else { (GREEN, "#e8f5f0") };
        rectangle(svg, area, 0.0, 18.0, &format!("fill=\"#fff\" stroke=\"{colour}\" stroke-width=\"1.4\""));
        rectangle(svg, area, 3.5, 14.5, &format!("fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.4\""));
        let (word, lines) = end(node);
        let first = y + NAME_SIZE * 0.35 - CODE_LINE * lines.len() as f64 / 2.0;
        svg.text((x, first), &bold(colour), word);
        for (i, line) in lines.iter().enumerate() {
            let at = (x, first + CODE_LINE * (i + 1) as f64 + 1.0);
            svg.text(at, &format!("{CODE} text-anchor=\"middle\" fill=\"{INK}\""), line);
        }
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

    fn label(&self, svg: &mut Svg, label: &Label, area: Rect) {
        let area = self.area(area);
        let mut y = area.top + 3.0 + CODE_LINE * 0.76;
        for (rule, lines) in &label.guards {
            let number = format!("fill=\"{BLUE}\" font-weight=\"bold\"");
            svg.text((area.left + 4.0, y), &number, &rule.to_string());
            for line in lines {
                svg.text((area.left + 4.0 + label.indent, y), "fill=\"#1a1a1a\"", line);
                y += CODE_LINE;
            }
        }
        if label.back {
            svg.text((area.left + 4.0 + label.indent, y), "fill=\"#666\" font-style=\"italic\"", BACK);
        }
    }
}

fn rectangle(svg: &mut Svg, area: Rect, inset: f64, radius: f64, attributes: &str) {
    let (x, y) = (px(area.left + inset), px(area.top + inset));
    let (width, height) = (px(area.right - area.left - 2.0 * inset), px(area.bottom - area.top - 2.0 * inset));
    svg.raw(&format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"{}\" {attributes}/>",
        px(radius)
    ));
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
