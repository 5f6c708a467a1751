//! The pictures of the page.

use crate::chart::{Axis, COLOURS, Chart};
use crate::measure::{self, Aged, THRESHOLD};
use albacore_formats::recording::Recording;
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::probe::{Band, SAMPLE_M};
use albacore_sim::{RecordedPlume, Scenario, Simulator, Still};
use albacore_svg::Svg;
use std::error::Error;
use std::sync::Arc;

/// Of the filaments of a map at most so many are drawn.
const DRAWN_MAX: usize = 2_500;

/// What an independent simulator measured with the same numbers, and what may differ: on-fraction and median gap (s) in the
/// four bands.
pub const WANTED: [(f64, f64); 4] = [(0.68, 0.6), (0.66, 0.8), (0.67, 1.0), (0.65, 1.1)];
pub const ON_MAY_DIFFER: f64 = 0.07;
pub const GAP_MAY_DIFFER: f64 = 0.3;

/// A plume with a name.
pub type Named = (&'static str, Vec<Band>);

/// Two plumes from above, their flow to the right: ours, and the recorded one.
pub fn map(flat: &Scenario, recording: &Arc<Recording>) -> Result<String, Box<dyn Error>> {
    let mut svg = Svg::new(940.0, 780.0);
    let simulator = Simulator::new(flat, 1)?;
    let ours: Vec<(Point, f64)> = simulator.filaments().collect();
    let toward = flat.environment.flow.mean.toward();
    one_map(
        &mut svg,
        40.0,
        "duck_2003_flat, seed 1: a filament a second",
        &ours,
        toward,
        flat.environment.sources[0].at,
    );
    let theirs: Vec<(Point, f64)> = recording.alive(0.0).map(|(place, r2)| (place, r2.sqrt())).collect();
    let title = "the recorded plume, by an independent model: one every two seconds";
    one_map(&mut svg, 420.0, title, &theirs, Heading::from_degrees(180.0), recording.source());
    Ok(svg.finish())
}

fn one_map(svg: &mut Svg, top: f64, title: &str, plume: &[(Point, f64)], toward: Heading, source: Point) {
    let mut chart = Chart {
        svg,
        left: 60.0,
        top,
        width: 850.0,
        height: 285.0,
        x: Axis::linear("down-flow (m)", -547.0, 547.0, 200.0, 0),
        y: Axis::linear("across (m)", -183.5, 183.5, 100.0, 0),
    };
    chart.draw_axes(title);
    let scale = chart.width / 1094.0;
    let shown = plume.len().min(DRAWN_MAX);
    let place = |p: Point| {
        let d = p - Point::ORIGIN;
        (60.0 + scale * (547.0 + d.along(toward)), top + scale * (183.5 + d.right_of(toward)))
    };
    chart.svg.raw("<g fill=\"#b08d2f\" fill-opacity=\"0.75\">");
    for i in 0..shown {
        let (p, radius) = plume[i * plume.len() / shown];
        let d = p - Point::ORIGIN;
        if d.along(toward).abs() < 547.0 && d.right_of(toward).abs() < 183.5 {
            chart.svg.circle(place(p), (scale * radius).max(1.1), "");
        }
    }
    chart.svg.raw("</g>");
    chart.svg.circle(place(source), 5.0, "fill=\"none\" stroke=\"#7a0019\" stroke-width=\"2\"");
}

/// A minute of what the probe reads near the source and far from it, in ours and in the recorded plume.
pub fn readings(flat: &Scenario, recording: &Arc<Recording>) -> Result<String, Box<dyn Error>> {
    let mut svg = Svg::new(940.0, 660.0);
    let simulator = Simulator::new(flat, 1)?;
    let survey = simulator.survey();
    let ours: Vec<(Point, f64)> = simulator.filaments().collect();
    let still = Still::new(&RecordedPlume::new(Arc::clone(recording)), 0.0);
    let theirs: Vec<(Point, f64)> = recording.alive(0.0).collect();
    let (toward, source) = (flat.environment.flow.mean.toward(), flat.environment.sources[0].at);
    let south = Heading::from_degrees(180.0);
    for (row, from) in [(0, 100.0), (1, 800.0)] {
        for (column, name) in ["duck_2003_flat", "the recorded plume"].into_iter().enumerate() {
            let read: Vec<f64> = if column == 0 {
                way(&ours, source, toward, from).into_iter().map(|p| survey.concentration(p, 2.0)).collect()
            } else {
                way(&theirs, recording.source(), south, from).into_iter().map(|p| still.reading(p)).collect()
            };
            let points: Vec<(f64, f64)> =
                (0..).map(|i| 0.1 * f64::from(i)).zip(read.iter().map(|c| c / THRESHOLD)).collect();
            let y = Axis { label: "reading / threshold", low: 0.01, high: 100.0, step: None, decimals: 0 };
            let mut chart = Chart {
                svg: &mut svg,
                left: 60.0 + 460.0 * column as f64,
                top: 40.0 + 320.0 * f64::from(row),
                width: 390.0,
                height: 220.0,
                x: Axis::linear("time of a 2 m/s probe (s)", 0.0, 60.0, 10.0, 0),
                y,
            };
            chart.draw_axes(&format!("{name}, {:.0} to {:.0} m down-flow", from, from + 120.0));
            chart.line(&points, COLOURS[1], "stroke-width=\"1\"");
            chart.line(&[(0.0, 1.0), (60.0, 1.0)], COLOURS[2], "stroke-width=\"1.2\" stroke-dasharray=\"6 4\"");
        }
    }
    Ok(svg.finish())
}

/// The samples of a minute towards the source on the centreline, from 120 m beyond a distance to it.
fn way(plume: &[(Point, f64)], source: Point, toward: Heading, distance: f64) -> Vec<Point> {
    let across = (toward + PI / 2.0).unit();
    (0..600)
        .map(|i| {
            let here = distance + 120.0 - SAMPLE_M * f64::from(i);
            // The centreline: the mean of the filaments within 10 m.
            let near = plume.iter().map(|(p, _)| *p - source).filter(|d| (d.along(toward) - here).abs() < 10.0);
            let (sum, n) = near.fold((0.0, 0.0), |(sum, n), d: Vector| (sum + d.right_of(toward), n + 1.0));
            source + here * toward.unit() + (sum / f64::max(n, 1.0)) * across
        })
        .collect()
}

/// On-fraction and median gap by band, and what is wanted of the first plume.
pub fn bands(plumes: &[Named]) -> String {
    let mut svg = Svg::new(940.0, 400.0);
    let x = Axis::linear("distance from the source (m)", 0.0, 1000.0, 200.0, 0);
    let colours: Vec<(&str, &str)> = plumes.iter().zip(COLOURS).map(|((name, _), colour)| (*name, colour)).collect();
    for (left, title, y) in [
        (60.0, "share of samples above the threshold", Axis::linear("on-fraction", 0.0, 1.0, 0.2, 1)),
        (520.0, "median gap between detections", Axis::linear("seconds", 0.0, 3.5, 0.5, 1)),
    ] {
        let (width, height) = (400.0, 310.0);
        let mut chart = Chart { svg: &mut svg, left, top: 40.0, width, height, x: x.clone(), y };
        let on = left < 100.0;
        if let Some((_, first)) = plumes.first() {
            for (band, (wanted_on, wanted_gap)) in first.iter().zip(WANTED) {
                let (low, high) = if on {
                    (wanted_on - ON_MAY_DIFFER, wanted_on + ON_MAY_DIFFER)
                } else {
                    (wanted_gap * (1.0 - GAP_MAY_DIFFER), wanted_gap * (1.0 + GAP_MAY_DIFFER))
                };
                chart.allowed((band.from, band.to), low, high);
            }
        }
        chart.draw_axes(title);
        for ((_, bands), colour) in plumes.iter().zip(COLOURS) {
            let value = |b: &Band| if on { b.on_fraction() } else { b.gap(0.5) };
            let points: Vec<(f64, f64)> = bands.iter().map(|b| (0.5 * (b.from + b.to), value(b))).collect();
            chart.line(&points, colour, "stroke-width=\"1.5\"");
            points.iter().for_each(|&(x, y)| chart.dot(x, y, colour));
        }
        if !on {
            chart.legend((14.0, 18.0), &colours);
        }
    }
    svg.finish()
}

/// The law of the gaps at several steps of the plume: the share that lasts longer, at two ranges.
pub fn steps(steps: &[(String, Vec<Band>)]) -> String {
    let mut svg = Svg::new(940.0, 400.0);
    let names: Vec<String> = steps.iter().map(|(step, _)| format!("steps of {step}")).collect();
    let colours: Vec<(&str, &str)> = names.iter().map(String::as_str).zip(COLOURS).collect();
    for (left, band) in [(60.0, 1), (520.0, 3)] {
        let Some(example) = steps.first().and_then(|(_, bands)| bands.get(band)) else { continue };
        let title = format!("{} to {} m from the source", example.from, example.to);
        let mut chart = Chart {
            svg: &mut svg,
            left,
            top: 40.0,
            width: 400.0,
            height: 310.0,
            x: Axis::linear("gap between detections (s)", 0.0, 8.0, 1.0, 0),
            y: Axis { label: "share of gaps that last longer", low: 0.01, high: 1.0, step: None, decimals: 2 },
        };
        chart.draw_axes(&title);
        for ((_, bands), colour) in steps.iter().zip(COLOURS) {
            let gaps = &bands[band].gaps;
            let longer = |gap: u32| gaps.iter().filter(|&&g| g > gap).count() as f64 / gaps.len().max(1) as f64;
            let points: Vec<(f64, f64)> = (1..=80).map(|gap| (0.1 * f64::from(gap), longer(gap))).collect();
            chart.line(&points, colour, "stroke-width=\"1.5\"");
        }
        if band == 1 {
            chart.legend((200.0, 18.0), &colours);
        }
    }
    svg.finish()
}

/// Relative diffusion: variances of filaments about their mean way, over their age.
pub fn spread(aged: &[Aged], diffusivity: f64) -> String {
    let mut svg = Svg::new(560.0, 400.0);
    let mut chart = Chart {
        svg: &mut svg,
        left: 66.0,
        top: 40.0,
        width: 470.0,
        height: 310.0,
        x: Axis::linear("age of the filaments (s)", 0.0, 10_000.0, 2_000.0, 0),
        y: Axis::linear("variance (m2)", 0.0, 600.0, 100.0, 0),
    };
    chart.draw_axes("relative diffusion in a uniform flow");
    chart.line(&[(0.0, 0.0), (10_000.0, 2.0 * diffusivity * 10_000.0)], COLOURS[0], "stroke-width=\"1.2\"");
    for class in aged {
        chart.ring(class.age, class.along, COLOURS[1]);
        chart.dot(class.age, class.across, COLOURS[2]);
    }
    chart.legend((14.0, 20.0), &[("2 K t", COLOURS[0]), ("along the flow", COLOURS[1]), ("across it", COLOURS[2])]);
    svg.finish()
}

/// The direction of the flow in the middle of the region, over hours.
pub fn flow(flat: &Scenario, recording: &Recording) -> Result<String, Box<dyn Error>> {
    let mut svg = Svg::new(940.0, 330.0);
    let mut chart = Chart {
        svg: &mut svg,
        left: 60.0,
        top: 40.0,
        width: 850.0,
        height: 230.0,
        x: Axis::linear("time (h)", 0.0, 6.0, 1.0, 0),
        y: Axis::linear("off the mean direction (deg)", -6.0, 6.0, 2.0, 0),
    };
    chart.draw_axes("direction of the flow in the middle of the region");
    for (seed, colour) in [1, 2, 3].into_iter().zip(&COLOURS[1..]) {
        chart.line(&measure::directions(flat, seed, 6.0 * 3600.0)?, colour, "stroke-width=\"1.3\"");
    }
    chart.line(&measure::recorded_directions(recording), COLOURS[0], "stroke-width=\"1.6\"");
    let names = ["the record, 90 minutes", "seed 1", "seed 2", "seed 3"];
    let legend: Vec<(&str, &str)> = names.into_iter().zip([COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[3]]).collect();
    chart.legend((690.0, 16.0), &legend);
    Ok(svg.finish())
}
