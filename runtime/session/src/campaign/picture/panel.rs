//! A panel with cumulative shares: how many of all runs came to a number at most.

use albacore_program::number::fixed;
use albacore_svg::{Svg, px, scale, text_width};

/// Numbers that share a pixel are one step.
const PIXEL: f64 = 1.0;

/// The numbers of a case.
pub struct Line {
    colour: &'static str,
    sorted: Vec<f64>,
    runs: usize,
}

impl Line {
    /// Numbers of some of so many runs.
    pub fn new(colour: &'static str, mut numbers: Vec<f64>, runs: usize) -> Self {
        numbers.sort_by(f64::total_cmp);
        Line { colour, sorted: numbers, runs }
    }

    /// The share of all runs whose number is at most this.
    fn share(&self, most: f64) -> f64 {
        self.sorted.partition_point(|x| *x <= most) as f64 / self.runs.max(1) as f64
    }
}

/// A panel.
pub struct Panel {
    /// Left, top, width and height, in pixels.
    pub corners: (f64, f64, f64, f64),
    /// What stands above it.
    pub title: String,
    /// What the numbers are.
    pub unit: String,
    /// The axis goes from 0 to this.
    pub span: f64,
    /// The cases.
    pub lines: Vec<Line>,
    /// Numbers that are told.
    pub marks: Vec<f64>,
}

impl Panel {
    fn x(&self, number: f64) -> f64 {
        self.corners.0 + (number / self.span).clamp(0.0, 1.0) * self.corners.2
    }

    fn y(&self, share: f64) -> f64 {
        self.corners.1 + (1.0 - share) * self.corners.3
    }

    /// Draws it.
    pub fn draw(&self, svg: &mut Svg) {
        let (left, top, width, height) = self.corners;
        let (right, bottom) = (left + width, top + height);
        let raised = if self.marks.is_empty() { 10.0 } else { 24.0 };
        svg.text((left, top - raised), "font-size=\"13\" font-weight=\"bold\" fill=\"#1a1a1a\"", &self.title);
        let rect = |attributes: &str| {
            let (x, y, w, h) = (px(left), px(top), px(width), px(height));
            format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" {attributes}/>")
        };
        svg.raw(&rect("fill=\"#f6f9fb\""));
        let (step, numbers) = scale::marks((0.0, self.span), width, 50.0);
        let (grid, told) = ("stroke=\"#dfe5ea\" stroke-width=\"1\"", "font-size=\"11\" fill=\"#444\"");
        for number in numbers {
            svg.line((self.x(number), top), (self.x(number), bottom), grid);
            let text = fixed(number, scale::decimals(step));
            svg.text((self.x(number), bottom + 15.0), &format!("text-anchor=\"middle\" {told}"), &text);
        }
        for quarter in 0..=4 {
            let y = self.y(f64::from(quarter) / 4.0);
            svg.line((left, y), (right, y), grid);
            svg.text((left - 6.0, y + 4.0), &format!("text-anchor=\"end\" {told}"), &(25 * quarter).to_string());
        }
        self.draw_marks(svg);
        for line in &self.lines {
            let attributes = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"", line.colour);
            svg.path(&self.steps(line), false, &attributes);
        }
        svg.raw(&rect("fill=\"none\" stroke=\"#333\" stroke-width=\"1\""));
        let label = "font-size=\"12\" text-anchor=\"middle\" fill=\"#444\"";
        svg.text(((left + right) / 2.0, bottom + 33.0), label, &self.unit);
        let at = (left - 40.0, (top + bottom) / 2.0);
        svg.text(at, &format!("{label} transform=\"rotate(-90 {} {})\"", px(at.0), px(at.1)), "of all runs (%)");
    }

    /// The marks, with the share of an only case: each that has room.
    fn draw_marks(&self, svg: &mut Svg) {
        let (left, top, width, height) = self.corners;
        let mut free = left - 40.0;
        for mark in self.marks.iter().copied().filter(|mark| *mark < self.span) {
            let x = self.x(mark);
            let dashed = "stroke=\"#8a97a3\" stroke-width=\"1\" stroke-dasharray=\"5 4\"";
            svg.line((x, top), (x, top + height), dashed);
            let name = format!("{mark} m");
            let text = match self.lines.as_slice() {
                [only] => format!("{name}: {} %", fixed(100.0 * only.share(mark), 1)),
                _ => name,
            };
            let half = text_width(&text, 11.0) / 2.0;
            if free < x - half && x + half < left + width + 30.0 {
                svg.text((x, top - 6.0), "font-size=\"11\" text-anchor=\"middle\" fill=\"#55606a\"", &text);
                free = x + half + 6.0;
            }
        }
    }

    /// The corners of a line of steps.
    fn steps(&self, line: &Line) -> Vec<(f64, f64)> {
        let count = line.runs.max(1) as f64;
        let first = line.sorted.first().copied().unwrap_or_default();
        let mut last = (self.x(first) - 2.0 * PIXEL, self.y(0.0));
        let mut corners = vec![(self.x(first), self.y(0.0))];
        for (i, number) in line.sorted.iter().enumerate().filter(|(_, number)| **number <= self.span) {
            let (x, y) = (self.x(*number), self.y((i + 1) as f64 / count));
            match corners.len() {
                // What is one step with the one before raises it.
                more if x - last.0 < PIXEL => corners[more - 1].1 = y,
                _ => {
                    corners.extend([(x, last.1), (x, y)]);
                    last.0 = x;
                }
            }
            last.1 = y;
        }
        corners.push((self.x(self.span), last.1));
        corners
    }
}
