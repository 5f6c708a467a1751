//! The boxes: behaviors, and the ends that a strategy can come to.

use super::{BLUE, BOLD, CODE, CODE_LINE, CODE_SIZE, CODE_WIDTH, GREEN, INK, LETTERS, RED};
use crate::graph::Node;
use crate::layout::{Rect, Size};
use crate::wrap::wrapped;
use albacore_svg::{Svg, px, text_width};

const NAME_SIZE: f64 = 14.0;
const WIDTH_MIN: f64 = 120.0;
/// Without lines beneath the word.
const HEIGHT: f64 = 40.0;

/// How a box looks.
pub struct Shape {
    /// A behavior's name, `finish` or `abort`.
    word: String,
    /// What is said beneath it.
    lines: Vec<String>,
    is_end: bool,
    /// Colours: of the rim, of the word, and between them.
    rim: &'static str,
    ink: &'static str,
    fill: &'static str,
}

impl Shape {
    /// The shape of a box.
    pub fn new(node: &Node) -> Self {
        let end = |word: &str, lines, colour, fill| {
            let word = word.to_string();
            Shape { word, lines, is_end: true, rim: colour, ink: colour, fill }
        };
        match node {
            Node::Behavior(name) => {
                let (word, lines) = (name.clone(), Vec::new());
                Shape { word, lines, is_end: false, rim: BLUE, ink: "#123", fill: "#eaf3fa" }
            }
            Node::Finish(result) => {
                let lines = result.as_ref().map(|result| wrapped(result, LETTERS)).unwrap_or_default();
                end("finish", lines, GREEN, "#e8f5f0")
            }
            Node::Abort(why) => end("abort", wrapped(why, LETTERS), RED, "#fdf0e8"),
        }
    }

    /// The room that it needs.
    pub fn size(&self) -> Size {
        let letters = self.lines.iter().map(|line| line.chars().count()).max().unwrap_or(0) as f64;
        let text = (text_width(&self.word, NAME_SIZE) * BOLD).max(letters * CODE_SIZE * CODE_WIDTH);
        let margin = if self.is_end { 36.0 } else { 32.0 };
        let height = HEIGHT + CODE_LINE * self.lines.len() as f64;
        Size { width: (text + margin).max(WIDTH_MIN).ceil(), height }
    }

    /// Draws it where it has its place. An end has a double rim.
    pub fn draw(&self, svg: &mut Svg, area: Rect) {
        let Shape { rim, ink, fill, .. } = self;
        if self.is_end {
            rectangle(svg, area, 0.0, 18.0, &format!("fill=\"#fff\" stroke=\"{rim}\" stroke-width=\"1.4\""));
            rectangle(svg, area, 3.5, 14.5, &format!("fill=\"{fill}\" stroke=\"{rim}\" stroke-width=\"1.4\""));
        } else {
            rectangle(svg, area, 0.0, 8.0, &format!("fill=\"{fill}\" stroke=\"{rim}\" stroke-width=\"1.6\""));
        }
        let (x, middle) = ((area.left + area.right) / 2.0, (area.top + area.bottom) / 2.0);
        let y = middle + NAME_SIZE * 0.35 - CODE_LINE * self.lines.len() as f64 / 2.0;
        let bold = format!("font-size=\"{NAME_SIZE}\" font-weight=\"bold\" text-anchor=\"middle\" fill=\"{ink}\"");
        svg.text((x, y), &bold, &self.word);
        for (i, line) in self.lines.iter().enumerate() {
            let at = (x, y + CODE_LINE * (i + 1) as f64 + 1.0);
            svg.text(at, &format!("{CODE} text-anchor=\"middle\" fill=\"{INK}\""), line);
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
