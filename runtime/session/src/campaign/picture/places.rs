//! Where first reports lie, seen from what there was to be found.

use super::{CASES_MAX, CasePicture, WITHIN_M};
use albacore_svg::{PALETTE, Svg, px, scale, text_width};
use std::collections::{BTreeMap, BTreeSet};

/// The panel is a square with sides so long, in pixels.
pub const SIZE: f64 = 440.0;
/// Half of the side, in metres: the smallest in which all lie, 60 m where half of them do, else the smallest in which half do.
const WINDOWS: [f64; 7] = [20.0, 36.0, 60.0, 150.0, 500.0, 2_000.0, 10_000.0];
/// The window that shows all rings.
const USUAL: f64 = 60.0;
/// Dots of a case nearer to each other than this, in pixels, are one.
const CELL: f64 = 1.5;
/// At most so many dots, of all cases together.
const DOTS_MAX: usize = 3_000;
/// Those outside are gathered along so much of the edge, in pixels.
const EDGE_CELL: f64 = 44.0;

/// How far a picture reaches for some distances, the largest of which is given.
pub fn window(distances: impl Iterator<Item = f64>, largest: f64) -> f64 {
    let mut sorted: Vec<f64> = distances.collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len().saturating_sub(1) / 2).copied().unwrap_or_default();
    let all = WINDOWS.into_iter().take_while(|window| *window <= USUAL).find(|window| largest <= 0.95 * window);
    let half = || WINDOWS.into_iter().find(|window| USUAL <= *window && median <= *window);
    all.or_else(half).unwrap_or(WINDOWS[WINDOWS.len() - 1])
}

/// The panel.
pub struct Places<'a> {
    /// Up and right, m, of each case.
    cases: Vec<&'a [(f64, f64)]>,
    is_in_flow: bool,
    /// Half of the side, m.
    window: f64,
}

impl<'a> Places<'a> {
    /// The panel of some cases, where there are any places: along the flow, where all have one.
    pub fn new(cases: &'a [CasePicture]) -> Option<Self> {
        let is_in_flow = cases.iter().all(|case| case.in_flow.len() == case.on_map.len());
        let cases: Vec<&[(f64, f64)]> =
            cases.iter().map(|case| if is_in_flow { &case.in_flow } else { &case.on_map }.as_slice()).collect();
        let distance = |(up, right): &(f64, f64)| (up * up + right * right).sqrt();
        let distances = || cases.iter().flat_map(|places| places.iter()).map(distance);
        distances().next()?;
        let window = window(distances(), distances().fold(0.0, f64::max));
        Some(Places { cases, is_in_flow, window })
    }

    /// Pixels from the middle, for metres up and right.
    fn offset(&self, (up, right): (f64, f64)) -> (f64, f64) {
        let scale = SIZE / 2.0 / self.window;
        (right * scale, -up * scale)
    }

    /// Draws it with its upper left corner there.
    pub fn draw(&self, svg: &mut Svg, (left, top): (f64, f64)) {
        let middle = (left + SIZE / 2.0, top + SIZE / 2.0);
        let bold = "font-size=\"13\" font-weight=\"bold\" fill=\"#1a1a1a\"";
        svg.text((left, top - 24.0), bold, "where the first report is, from what there was to be found");
        svg.text((left, top - 7.0), "font-size=\"11\" fill=\"#55606a\"", &self.counted());
        let (x, y, size) = (px(left), px(top), px(SIZE));
        let rect =
            |attributes: &str| format!("<rect x=\"{x}\" y=\"{y}\" width=\"{size}\" height=\"{size}\"{attributes}/>");
        svg.raw(&format!("<clipPath id=\"places\">{}</clipPath>", rect("")));
        svg.raw(&rect(" fill=\"#f6f9fb\""));
        self.axes(svg, middle);
        svg.raw("<g clip-path=\"url(#places)\">");
        self.rings(svg, middle);
        self.dots(svg, middle);
        svg.raw("</g>");
        svg.raw(&rect(" fill=\"none\" stroke=\"#333\" stroke-width=\"1\""));
        self.outside(svg, middle);
        self.ring_names(svg, middle);
    }

    /// How many lie where.
    fn counted(&self) -> String {
        let all = || self.cases.iter().flat_map(|places| places.iter()).map(|at| self.offset(*at));
        let (count, outside) = (all().count(), all().filter(|at| !is_inside(*at)).count());
        let runs = if count == 1 { "1 run".to_string() } else { format!("{count} runs") };
        match outside {
            0 => runs,
            _ => format!("{runs}, of which {outside} beyond the edge"),
        }
    }

    fn axes(&self, svg: &mut Svg, middle: (f64, f64)) {
        let (left, right, top, bottom) =
            (middle.0 - SIZE / 2.0, middle.0 + SIZE / 2.0, middle.1 - SIZE / 2.0, middle.1 + SIZE / 2.0);
        let (step, marks) = scale::marks((-self.window, 2.0 * self.window), SIZE, 50.0);
        let decimals = scale::decimals(step);
        let metres = SIZE / 2.0 / self.window;
        let grid = "stroke=\"#dfe5ea\" stroke-width=\"1\"";
        let numbers = "font-size=\"11\" fill=\"#444\"";
        for mark in marks {
            let (x, y) = (middle.0 + mark * metres, middle.1 - mark * metres);
            let text = albacore_program::number::fixed(mark, decimals);
            svg.line((x, top), (x, bottom), grid);
            svg.line((left, y), (right, y), grid);
            svg.text((x, bottom + 15.0), &format!("text-anchor=\"middle\" {numbers}"), &text);
            svg.text((left - 6.0, y + 4.0), &format!("text-anchor=\"end\" {numbers}"), &text);
        }
        let (along, across) =
            if self.is_in_flow { ("down-flow (m)", "to the right of the flow (m)") } else { ("north (m)", "east (m)") };
        let label = "font-size=\"12\" text-anchor=\"middle\" fill=\"#444\"";
        svg.text((middle.0, bottom + 33.0), label, across);
        let at = (left - 44.0, middle.1);
        svg.text(at, &format!("{label} transform=\"rotate(-90 {} {})\"", px(at.0), px(at.1)), along);
    }

    /// Those that have room for their names.
    fn shown_rings(&self) -> impl Iterator<Item = (f64, f64)> {
        let scale = SIZE / 2.0 / self.window;
        WITHIN_M.into_iter().map(move |m| (m, m * scale)).filter(|(_, radius)| *radius < SIZE / 2.0)
    }

    fn rings(&self, svg: &mut Svg, middle: (f64, f64)) {
        for (_, radius) in self.shown_rings() {
            svg.circle(middle, radius, "fill=\"none\" stroke=\"#8a97a3\" stroke-width=\"1\" stroke-dasharray=\"5 4\"");
        }
    }

    fn ring_names(&self, svg: &mut Svg, middle: (f64, f64)) {
        // North-east of the middle, where a ring is farthest from both axes.
        let halo = "font-size=\"11\" text-anchor=\"middle\" fill=\"#55606a\" stroke=\"#fff\" stroke-width=\"3\" \
                    stroke-linejoin=\"round\" paint-order=\"stroke\"";
        let mut before = 0.0;
        for (m, radius) in self.shown_rings().filter(|(_, radius)| *radius > 24.0) {
            if radius - before > 20.0 {
                let aside = radius * std::f64::consts::FRAC_1_SQRT_2;
                svg.text((middle.0 + aside, middle.1 - aside + 4.0), halo, &format!("{m} m"));
                before = radius;
            }
        }
    }

    fn dots(&self, svg: &mut Svg, middle: (f64, f64)) {
        let arm = 7.0;
        let cross = "stroke=\"#111\" stroke-width=\"1.2\"";
        let mut apart: Vec<Vec<(f64, f64)>> = Vec::new();
        for places in &self.cases {
            let mut cells = BTreeSet::new();
            let inside = places.iter().map(|at| self.offset(*at)).filter(|at| is_inside(*at));
            apart.push(inside.filter(|(x, y)| cells.insert(((x / CELL) as i64, (y / CELL) as i64))).collect());
        }
        let count: usize = apart.iter().map(Vec::len).sum();
        let step = count.div_ceil(DOTS_MAX).max(1);
        for (i, dots) in apart.iter().enumerate().filter(|(_, dots)| !dots.is_empty()) {
            svg.raw(&format!("<g fill=\"{}\" fill-opacity=\"0.65\">", PALETTE[i % CASES_MAX]));
            for (x, y) in dots.iter().step_by(step) {
                svg.circle((middle.0 + x, middle.1 + y), 2.4, "");
            }
            svg.raw("</g>");
        }
        svg.line((middle.0 - arm, middle.1), (middle.0 + arm, middle.1), cross);
        svg.line((middle.0, middle.1 - arm), (middle.0, middle.1 + arm), cross);
    }

    /// What lies outside, at the edge toward it, with how many they are.
    fn outside(&self, svg: &mut Svg, middle: (f64, f64)) {
        // By the side of the square and the place along it.
        let mut gathered: BTreeMap<(u8, i64), (usize, BTreeSet<usize>)> = BTreeMap::new();
        for (case, places) in self.cases.iter().enumerate() {
            for (x, y) in places.iter().map(|at| self.offset(*at)).filter(|at| !is_inside(*at)) {
                let (side, along) = match (x.abs() > y.abs(), x > 0.0, y > 0.0) {
                    (true, true, _) => (0, y / x.abs()),
                    (true, false, _) => (1, y / x.abs()),
                    (false, _, true) => (2, x / y.abs()),
                    (false, _, false) => (3, x / y.abs()),
                };
                // No two of them meet in a corner.
                let most = SIZE / 2.0 / EDGE_CELL - 1.0;
                let cell = (along * SIZE / 2.0 / EDGE_CELL).clamp(-most, most).round() as i64;
                let entry = gathered.entry((side, cell)).or_default();
                entry.0 += 1;
                entry.1.insert(case);
            }
        }
        for ((side, cell), (count, cases)) in gathered {
            let (along, out) = (cell as f64 * EDGE_CELL, SIZE / 2.0 - 3.0);
            let (dx, dy): (f64, f64) = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)][usize::from(side)];
            let (x, y) = (middle.0 + dx * out + dy.abs() * along, middle.1 + dy * out + dx.abs() * along);
            let colour = match cases.first() {
                Some(case) if cases.len() == 1 => PALETTE[case % CASES_MAX],
                _ => "#333",
            };
            let base = |across: f64| (x - 9.0 * dx + across * dy, y - 9.0 * dy + across * dx);
            svg.path(&[(x, y), base(5.0), base(-5.0)], true, &format!("fill=\"{colour}\""));
            let text = count.to_string();
            let aside = 12.0 + if dx == 0.0 { 5.0 } else { text_width(&text, 11.0) / 2.0 };
            let at = (x - aside * dx, y - aside * dy + 4.0);
            let halo = format!(
                "font-size=\"11\" text-anchor=\"middle\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"3\" \
                 stroke-linejoin=\"round\" paint-order=\"stroke\""
            );
            svg.text(at, &halo, &text);
        }
    }
}

/// Whether a place on the panel is seen, by its pixels from the middle.
fn is_inside((x, y): (f64, f64)) -> bool {
    x.abs().max(y.abs()) <= SIZE / 2.0 - 3.0
}
