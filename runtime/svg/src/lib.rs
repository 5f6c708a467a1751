//! The bytes of an SVG: elements, coordinates with one decimal, and texts without danger.

pub mod scale;

use albacore_program::number::fixed;
use albacore_program::seen::one_line;
use std::fmt::Write;

/// Colours of lines and dots (Okabe and Ito's, less yellow, plus wine and grey): told apart by the colour-blind and on white paper.
pub const PALETTE: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#882255", "#6b6b6b"];

/// The width of an average letter, in parts of its size: that of the widest of the fonts asked for.
const LETTER_WIDTH: f64 = 0.58;

/// A document that grows element by element.
pub struct Svg {
    out: String,
}

impl Svg {
    /// An empty white page of a size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        let (w, h) = (px(width.ceil()), px(height.ceil()));
        let mut svg = Svg { out: String::new() };
        svg.raw(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">"
        ));
        svg.raw(&format!("<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>"));
        svg
    }

    /// A line of the document, as it is.
    pub fn raw(&mut self, line: &str) {
        self.out.push_str(line);
        self.out.push('\n');
    }

    /// A text, whatever is in it.
    pub fn text(&mut self, at: (f64, f64), attributes: &str, text: &str) {
        self.raw(&format!("<text x=\"{}\" y=\"{}\" {attributes}>{}</text>", px(at.0), px(at.1), escaped(text)));
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), attributes: &str) {
        let (x1, y1, x2, y2) = (px(from.0), px(from.1), px(to.0), px(to.1));
        self.raw(&format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {attributes}/>"));
    }

    /// A circle.
    pub fn circle(&mut self, at: (f64, f64), radius: f64, attributes: &str) {
        let blank = if attributes.is_empty() { "" } else { " " };
        self.raw(&format!("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{blank}{attributes}/>", px(at.0), px(at.1), px(radius)));
    }

    /// A path through points, of which `closed` tells whether it comes back.
    pub fn path(&mut self, points: &[(f64, f64)], closed: bool, attributes: &str) {
        let end = if closed { "Z" } else { "" };
        self.raw(&format!("<path d=\"{}{end}\" {attributes}/>", moves(points)));
    }

    /// Open paths as one element.
    pub fn paths<'a>(&mut self, lines: impl Iterator<Item = &'a [(f64, f64)]>, attributes: &str) {
        self.raw(&format!("<path d=\"{}\" {attributes}/>", lines.map(moves).collect::<String>()));
    }

    /// Elements that tell a text to whoever points at them.
    pub fn titled(&mut self, text: &str, attributes: &str, draw: impl FnOnce(&mut Svg)) {
        self.raw(&format!("<g {attributes}><title>{}</title>", escaped(text)));
        draw(self);
        self.raw("</g>");
    }

    /// The document.
    pub fn finish(mut self) -> String {
        self.raw("</svg>");
        self.out
    }
}

/// The data of an open path.
fn moves(points: &[(f64, f64)]) -> String {
    let mut d = String::new();
    for (i, (x, y)) in points.iter().enumerate() {
        let letter = ["M", "L", " "][i.min(2)];
        // Writing to a string cannot fail.
        let _ = write!(d, "{letter}{} {}", px(*x), px(*y));
    }
    d
}

/// A coordinate in pixels: `12.5`, and `12` rather than `12.0`.
pub fn px(x: f64) -> String {
    let text = fixed(x, 1);
    text.strip_suffix(".0").map(str::to_string).unwrap_or(text)
}

/// A text as XML takes it, with whatever cannot be seen, and what XML forbids, written out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in one_line(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// The room that a text takes at most, in pixels.
pub fn text_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * LETTER_WIDTH
}

/// A text cut to the room there is.
pub fn shortened(text: &str, room: f64, size: f64) -> String {
    if text_width(text, size) <= room {
        return text.to_string();
    }
    let letters = (room / (size * LETTER_WIDTH)) as usize;
    let cut: String = text.chars().take(letters.saturating_sub(1)).collect();
    format!("{}…", cut.trim_end())
}
