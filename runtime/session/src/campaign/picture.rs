//! The picture of a campaign: where the first reports lie from what there was to be found, how far off and how late they are, and how the
//! runs ended.

mod bars;
mod panel;
mod places;

use super::tally::WITHIN_M;
use albacore_program::number::fixed;
use albacore_svg::{self as svg, PALETTE, Svg};
use panel::{Line, Panel};
use std::collections::BTreeMap;

/// So many cases are told apart by colour at most.
pub const CASES_MAX: usize = PALETTE.len();

/// Margins of the page, in pixels.
const EDGE: f64 = 20.0;
const TOP: f64 = 52.0;
const SUBTITLE_LINE: f64 = 18.0;
/// Where the panels begin beneath the heading, in pixels.
const GAP: f64 = 34.0;
/// The width of the panels on the right, and the height of each, in pixels.
const RIGHT_WIDTH: f64 = 360.0;
const RIGHT_HEIGHT: f64 = 150.0;
/// Room for the numbers of an axis at the left of a panel, and for those beneath it with the title of the next, in pixels.
const NUMBERS: f64 = 58.0;
const BENEATH: f64 = 82.0;

/// What is shown of the runs of a case. A number that is not there is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CasePicture {
    /// What the legend calls it.
    pub name: String,
    /// How many runs there are.
    pub runs: usize,
    /// How they ended, and how many did.
    pub outcomes: BTreeMap<String, usize>,
    /// What they finished with, and how many did.
    pub results: BTreeMap<String, usize>,
    /// Metres from what was reported first to what there was to be found.
    pub errors: Vec<f64>,
    /// The same, north and east.
    pub on_map: Vec<(f64, f64)>,
    /// The same, down-flow and to the right of the flow.
    pub in_flow: Vec<(f64, f64)>,
    /// Seconds until the first report.
    pub report_s: Vec<f64>,
    /// Seconds until the end.
    pub end_s: Vec<f64>,
}

/// All that the picture shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CampaignPicture {
    /// The heading.
    pub title: String,
    /// Lines beneath it.
    pub subtitle: Vec<String>,
    /// One or more, [`CASES_MAX`] at most.
    pub cases: Vec<CasePicture>,
}

impl CampaignPicture {
    /// The picture as an SVG document. The same picture gives the same bytes on every machine.
    pub fn svg(&self) -> String {
        let top = TOP + SUBTITLE_LINE * self.subtitle.len() as f64 + GAP;
        let places = places::Places::new(&self.cases);
        let table = Table { cases: &self.cases };
        let under = top + places.as_ref().map_or(-GAP / 2.0, |_| places::SIZE + 60.0);
        let left_end = under + table.height();
        let right = if places.is_some() { EDGE + NUMBERS + places::SIZE + 24.0 + NUMBERS } else { EDGE + NUMBERS };
        let first = if places.is_some() { top } else { left_end + GAP + 8.0 };
        let panels = self.panels(right, first);
        let bars_top = first + panels.len() as f64 * (RIGHT_HEIGHT + BENEATH) - 8.0;
        let bars = bars::Bars::new(&self.cases);
        let width = right + RIGHT_WIDTH.max(if places.is_some() { 0.0 } else { table.width() - NUMBERS }) + EDGE + 14.0;
        let mut svg = Svg::new(width, (bars_top + bars.height()).max(left_end) + EDGE);
        self.heading(&mut svg, width - 2.0 * EDGE);
        if let Some(places) = &places {
            places.draw(&mut svg, (EDGE + NUMBERS, top));
        }
        table.draw(&mut svg, (if places.is_some() { EDGE + NUMBERS } else { EDGE }, under));
        panels.iter().for_each(|panel| panel.draw(&mut svg));
        bars.draw(&mut svg, (right - NUMBERS + 8.0, bars_top), RIGHT_WIDTH + NUMBERS - 8.0);
        svg.finish()
    }

    fn heading(&self, svg: &mut Svg, room: f64) {
        let bold = "font-size=\"20\" font-weight=\"bold\" fill=\"#1a1a1a\"";
        svg.text((EDGE, 36.0), bold, &svg::shortened(&self.title, room, 21.0));
        for (i, line) in self.subtitle.iter().enumerate() {
            let y = 57.0 + SUBTITLE_LINE * i as f64;
            svg.text((EDGE, y), "font-size=\"13\" fill=\"#555\"", &svg::shortened(line, room, 13.0));
        }
    }

    /// How many are how near, and how many are how early.
    fn panels(&self, left: f64, top: f64) -> Vec<Panel> {
        let cumulated = |of: &dyn Fn(&CasePicture) -> Vec<f64>| -> Vec<Line> {
            let line = |(i, case): (usize, &CasePicture)| Line::new(PALETTE[i % CASES_MAX], of(case), case.runs);
            self.cases.iter().enumerate().map(line).collect()
        };
        let any = |of: &dyn Fn(&CasePicture) -> &Vec<f64>| self.cases.iter().any(|case| !of(case).is_empty());
        let mut panels = Vec::new();
        let mut add = |title: &str, unit: &str, span: f64, lines: Vec<Line>, marks: &[f64]| {
            let top = top + panels.len() as f64 * (RIGHT_HEIGHT + BENEATH);
            let corners = (left, top, RIGHT_WIDTH, RIGHT_HEIGHT);
            panels.push(Panel { corners, title: title.into(), unit: unit.into(), span, lines, marks: marks.to_vec() });
        };
        if any(&|case| &case.errors) {
            let largest = self.cases.iter().flat_map(|case| &case.errors).copied().fold(0.0, f64::max);
            let span = places::window(self.cases.iter().flat_map(|case| case.errors.iter().copied()), largest);
            add(
                "how far off the first report is",
                "error (m)",
                span,
                cumulated(&|case| case.errors.clone()),
                &WITHIN_M,
            );
        }
        let reported = any(&|case| &case.report_s);
        let times: fn(&CasePicture) -> &Vec<f64> = if reported { |case| &case.report_s } else { |case| &case.end_s };
        if any(&times) {
            let last = self.cases.iter().flat_map(times).copied().fold(0.0, f64::max);
            let (unit, scale) = if last < 180.0 { ("time (s)", 1.0) } else { ("time (min)", 60.0) };
            let lines = cumulated(&|case| times(case).iter().map(|t| t / scale).collect());
            let title = if reported { "when the first report came" } else { "when the run ended" };
            add(title, unit, (1.04 * last / scale).max(1e-3), lines, &[]);
        }
        panels
    }
}

/// What the cases come to, in the colours of the cases.
struct Table<'a> {
    cases: &'a [CasePicture],
}

impl Table<'_> {
    /// The columns after the name: each so wide, in pixels.
    const COLUMN: f64 = 62.0;
    const LINE: f64 = 19.0;

    fn has_errors(&self) -> bool {
        self.cases.iter().any(|case| !case.errors.is_empty())
    }

    fn columns(&self) -> Vec<String> {
        let mut columns = vec!["runs".to_string(), "reported".to_string()];
        if self.has_errors() {
            columns.extend(WITHIN_M.map(|m| format!("≤ {m} m")));
        }
        columns
    }

    fn names(&self) -> f64 {
        let room = if self.has_errors() { places::SIZE - 5.0 * Self::COLUMN } else { 260.0 };
        if self.cases.len() > 1 { room } else { 0.0 }
    }

    fn width(&self) -> f64 {
        self.names() + Self::COLUMN * self.columns().len() as f64
    }

    /// Whether a name is so long that it has a line of its own.
    fn is_tall(&self) -> bool {
        let room = self.names() - 22.0;
        self.cases.len() > 1 && self.cases.iter().any(|case| svg::text_width(&case.name, 12.0) > room)
    }

    fn height(&self) -> f64 {
        let lines = if self.is_tall() { 2 } else { 1 };
        Self::LINE * (lines * self.cases.len() + 1) as f64
    }

    fn draw(&self, svg: &mut Svg, (left, top): (f64, f64)) {
        let x = |column: usize| left + self.names() + Self::COLUMN * (column as f64 + 1.0) - 6.0;
        let cell = |svg: &mut Svg, column: usize, y: f64, colour: &str, text: &str| {
            svg.text((x(column), y), &format!("font-size=\"12\" text-anchor=\"end\" fill=\"{colour}\""), text);
        };
        for (i, name) in self.columns().iter().enumerate() {
            cell(svg, i, top + 4.0, "#555", name);
        }
        for (i, case) in self.cases.iter().enumerate() {
            let lines = if self.is_tall() { 2.0 } else { 1.0 };
            let y = top + 4.0 + Self::LINE * (lines * (i as f64 + 1.0));
            if self.cases.len() > 1 {
                let (y, room) = if self.is_tall() { (y - Self::LINE, self.width()) } else { (y, self.names()) };
                svg.circle((left + 5.0, y - 4.0), 4.5, &format!("fill=\"{}\"", PALETTE[i % CASES_MAX]));
                let name = svg::shortened(&case.name, room - 22.0, 12.0);
                svg.text((left + 16.0, y), "font-size=\"12\" fill=\"#222\"", &name);
            }
            let share = |count: usize| percent(count, case.runs);
            let near = WITHIN_M.map(|m| share(case.errors.iter().filter(|error| **error <= m).count()));
            let cells = [case.runs.to_string(), share(case.report_s.len())].into_iter().chain(near);
            for (column, text) in cells.take(self.columns().len()).enumerate() {
                cell(svg, column, y, "#222", &text);
            }
        }
    }
}

/// A share of runs.
fn percent(count: usize, of: usize) -> String {
    format!("{} %", fixed(100.0 * count as f64 / of.max(1) as f64, 1))
}

#[cfg(test)]
mod tests {
    use super::{CampaignPicture, CasePicture};

    fn case(name: &str, places: &[(f64, f64)]) -> CasePicture {
        let errors = places.iter().map(|(up, right)| (up * up + right * right).sqrt()).collect();
        CasePicture {
            name: name.into(),
            runs: places.len() + 1,
            outcomes: [("completed".to_string(), places.len()), ("timed_out".to_string(), 1)].into(),
            results: [("place".to_string(), places.len())].into(),
            errors,
            on_map: places.to_vec(),
            in_flow: places.to_vec(),
            report_s: places.iter().map(|(up, _)| 600.0 + up).collect(),
            end_s: vec![900.0; places.len() + 1],
        }
    }

    fn svg(cases: Vec<CasePicture>) -> String {
        let picture = CampaignPicture { title: "a <mission>".into(), subtitle: vec!["seeds 1..9".into()], cases };
        let svg = picture.svg();
        assert!(
            svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf") && !svg.contains('?'),
            "{svg}"
        );
        assert_eq!(svg, picture.svg());
        svg
    }

    #[test]
    fn misses_far_off_are_counted_at_the_edge_toward_them() {
        let near = [(3.0, 1.0), (20.0, -2.0), (-4.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
        let svg = svg(vec![case("", &[&near[..], &[(800.0, 10.0), (900.0, -20.0), (70.0, 3_000.0)]].concat())]);
        assert!(svg.contains("8 runs, of which 3 beyond the edge"), "{svg}");
        assert_eq!(svg.matches("r=\"2.4\"").count(), near.len());
        // Two up-flow together, one to the right.
        assert_eq!(svg.matches("paint-order=\"stroke\">2</text>").count(), 1, "{svg}");
        assert_eq!(svg.matches("paint-order=\"stroke\">1</text>").count(), 1, "{svg}");
        assert!(
            svg.contains("15 m: 44.4 %") && svg.contains("50 m: 55.6 %"),
            "of all runs, not of those that reported: {svg}"
        );
        assert!(svg.contains("a &lt;mission&gt;") && svg.contains(">timed out</text>"), "{svg}");
    }

    #[test]
    fn without_a_flow_north_is_up_and_without_places_there_are_times_alone() {
        let still = CasePicture { in_flow: Vec::new(), ..case("", &[(1.0, 2.0)]) };
        let drawn = svg(vec![still.clone()]);
        assert!(drawn.contains(">north (m)</text>") && !drawn.contains("down-flow"), "{drawn}");
        let blind = CasePicture { on_map: Vec::new(), errors: Vec::new(), ..still };
        let drawn = svg(vec![blind.clone()]);
        assert!(!drawn.contains("north (m)") && !drawn.contains("error (m)"), "{drawn}");
        assert!(drawn.contains("when the first report came"), "{drawn}");
        let drawn = svg(vec![CasePicture { report_s: Vec::new(), ..blind }]);
        assert!(drawn.contains("when the run ended"), "{drawn}");
        svg(vec![CasePicture::default()]);
    }

    #[test]
    fn each_case_has_a_colour_and_its_whole_name() {
        let name = "2: a_mission_of_a_long_name in a_scenario --set lambda=6s";
        let drawn = svg(vec![case("1: lambda=2s", &[(1.0, 2.0)]), case(name, &[(5.0, 2.0)])]);
        assert!(drawn.contains(name) && drawn.contains("1: lambda=2s"), "{drawn}");
        assert!(drawn.contains("fill=\"#0072b2\"") && drawn.contains("fill=\"#d55e00\""), "{drawn}");
    }

    #[test]
    fn a_large_campaign_is_a_small_picture() {
        let place = |i: u32| (f64::from(i % 977) / 10.0 - 48.0, f64::from(i % 1_009) / 10.0 - 50.0);
        let svg = svg(vec![case("", &(0..200_000).map(place).collect::<Vec<_>>())]);
        assert!(svg.len() < 200_000, "{} bytes", svg.len());
    }
}
