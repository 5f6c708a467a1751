//! A plain chart: two axes, lines, dots and a legend.

use albacore_geometry::math::ln;
use albacore_program::number::fixed;
use albacore_svg::{Svg, px};

/// Colours that stay apart on paper and for the colour-blind (Okabe & Ito 2008).
pub const COLOURS: [&str; 6] = ["#111111", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00"];

/// A scale of numbers.
#[derive(Clone)]
pub struct Axis {
    pub label: &'static str,
    pub low: f64,
    pub high: f64,
    /// Between ticks; none: the axis is logarithmic, with a tick at every decade.
    pub step: Option<f64>,
    /// Of the ticks' numbers.
    pub decimals: u8,
}

/// A chart on a page.
pub struct Chart<'a> {
    pub svg: &'a mut Svg,
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: Axis,
    pub y: Axis,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: &'static str, low: f64, high: f64, step: f64, decimals: u8) -> Self {
        Axis { label, low, high, step: Some(step), decimals }
    }

    /// The share of the way along the axis.
    fn share(&self, value: f64) -> f64 {
        match self.step {
            Some(_) => (value - self.low) / (self.high - self.low),
            None => ln(value.max(1e-300) / self.low) / ln(self.high / self.low),
        }
    }

    fn ticks(&self) -> Vec<f64> {
        let mut ticks = Vec::new();
        match self.step {
            Some(step) => {
                // Multiples of the step.
                let (first, last) = ((self.low / step - 1e-9).ceil() as i32, (self.high / step + 1e-9).floor() as i32);
                ticks.extend((first..=last).map(|i| f64::from(i) * step));
            }
            None => {
                let mut tick = self.low;
                while tick <= self.high * 1.001 {
                    ticks.push(tick);
                    tick *= 10.0;
                }
            }
        }
        ticks
    }

    fn written(&self, tick: f64) -> String {
        match self.step {
            Some(_) => fixed(tick, self.decimals),
            None if tick < 0.05 => fixed(tick, 2),
            None if tick < 0.5 => fixed(tick, 1),
            None => fixed(tick, 0),
        }
    }
}

impl Chart<'_> {
    /// Frame, grid, numbers and names.
    pub fn draw_axes(&mut self, title: &str) {
        let (left, top, right, bottom) = (self.left, self.top, self.left + self.width, self.top + self.height);
        self.svg.text((left, top - 9.0), "font-size=\"13\" font-weight=\"bold\" fill=\"#111\"", title);
        for tick in self.x.ticks() {
            let x = self.place(tick, self.y.low).0;
            self.svg.line((x, top), (x, bottom), "stroke=\"#e2e7ec\"");
            let written = self.x.written(tick);
            self.svg.text((x, bottom + 16.0), "text-anchor=\"middle\" font-size=\"11\" fill=\"#444\"", &written);
        }
        for tick in self.y.ticks() {
            let y = self.place(self.x.low, tick).1;
            self.svg.line((left, y), (right, y), "stroke=\"#e2e7ec\"");
            let written = self.y.written(tick);
            self.svg.text((left - 6.0, y + 4.0), "text-anchor=\"end\" font-size=\"11\" fill=\"#444\"", &written);
        }
        let (w, h) = (px(self.width), px(self.height));
        self.svg.raw(&format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{w}\" height=\"{h}\" fill=\"none\" stroke=\"#333\"/>",
            px(left),
            px(top)
        ));
        let label = "text-anchor=\"middle\" font-size=\"12\" fill=\"#222\"";
        self.svg.text((0.5 * (left + right), bottom + 34.0), label, self.x.label);
        let (x, y) = (left - 42.0, 0.5 * (top + bottom));
        let turned = format!("{label} transform=\"rotate(-90 {} {})\"", px(x), px(y));
        self.svg.text((x, y), &turned, self.y.label);
    }

    /// A line through points, cut off at the frame's top and bottom.
    pub fn line(&mut self, points: &[(f64, f64)], colour: &str, attributes: &str) {
        let (low, high) = (self.y.low, self.y.high);
        let places: Vec<_> = points.iter().map(|&(x, y)| self.place(x, y.clamp(low, high))).collect();
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-linejoin=\"round\" {attributes}");
        self.svg.path(&places, false, &style);
    }

    /// A dot.
    pub fn dot(&mut self, x: f64, y: f64, colour: &str) {
        let place = self.place(x, y);
        self.svg.circle(place, 4.0, &format!("fill=\"{colour}\" stroke=\"#fff\""));
    }

    /// A ring, within which a dot is seen.
    pub fn ring(&mut self, x: f64, y: f64, colour: &str) {
        let place = self.place(x, y);
        self.svg.circle(place, 6.5, &format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\""));
    }

    /// What is allowed, from `low` to `high` over an interval of x.
    pub fn allowed(&mut self, (from, to): (f64, f64), low: f64, high: f64) {
        let ((left, bottom), (right, top)) = (self.place(from, low), self.place(to, high));
        self.svg.path(&[(left, bottom), (left, top), (right, top), (right, bottom)], true, "fill=\"#d9ead3\"");
    }

    /// Names of colours, from a place in the frame downwards.
    pub fn legend(&mut self, at: (f64, f64), names: &[(&str, &str)]) {
        for (row, (name, colour)) in names.iter().enumerate() {
            let (x, y) = (self.left + at.0, self.top + at.1 + 17.0 * row as f64);
            self.svg.line((x, y), (x + 18.0, y), &format!("stroke=\"{colour}\" stroke-width=\"3\""));
            self.svg.text((x + 24.0, y + 4.0), "font-size=\"12\" fill=\"#222\"", name);
        }
    }

    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        (self.left + self.width * self.x.share(x), self.top + self.height * (1.0 - self.y.share(y)))
    }
}
