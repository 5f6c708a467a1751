//! What stands on a line: its rules, each with its number.

use super::{BLUE, CODE_LINE, CODE_SIZE, CODE_WIDTH, LETTERS};
use crate::graph::Link;
use crate::layout::{Rect, Size};
use crate::wrap::wrapped;
use albacore_svg::Svg;

/// What stands beneath the guards of a line that comes back.
const BACK: &str = "then back";

/// A label: for each guard its number and its lines.
pub struct Label {
    guards: Vec<(usize, Vec<String>)>,
    back: bool,
    /// The room of the numbers.
    indent: f64,
    /// The room that it takes.
    pub size: Size,
}

impl Label {
    /// The label of a line.
    pub fn new(link: &Link) -> Self {
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
    /// Draws it where it has its place.
    pub fn draw(&self, svg: &mut Svg, area: Rect) {
        let mut y = area.top + 3.0 + CODE_LINE * 0.76;
        let (number_x, text_x) = (area.left + 4.0, area.left + 4.0 + self.indent);
        for (rule, lines) in &self.guards {
            svg.text((number_x, y), &format!("fill=\"{BLUE}\" font-weight=\"bold\""), &rule.to_string());
            for line in lines {
                svg.text((text_x, y), "fill=\"#1a1a1a\"", line);
                y += CODE_LINE;
            }
        }
        if self.back {
            svg.text((text_x, y), "fill=\"#666\" font-style=\"italic\"", BACK);
        }
    }
}
