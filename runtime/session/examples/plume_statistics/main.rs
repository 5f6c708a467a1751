//! Measures the plumes, writes the figures into `docs/plume.md` and draws the pictures of `docs/plume/`:
//! `cargo run --release -p albacore-session --example plume_statistics`. Some minutes; the same bytes every time.

mod chart;
#[path = "../../tests/library/mod.rs"]
mod library;
mod measure;
mod page;
mod pictures;

use albacore_formats::recording::{RecordedKernel, Recording, RecordingHeader};
use albacore_geometry::{Area, Heading, Point};
use albacore_sim::probe::Band;
use albacore_sim::{Environment, Flow, Meander, Plume, Scenario, Source};
use library::scenario;
use page::{Page, table};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io::Write};

/// Seeds of the figures by band.
const SEEDS: u64 = 24;
/// Seeds of those by step, each probed at four times.
const STEP_SEEDS: u64 = 8;
/// Steps of the plume, s.
const STEPS: [f64; 5] = [0.1, 0.5, 1.0, 2.0, 5.0];

/// Two more plumes that were measured independently: filaments as thin as they come, and few and large ones.
const OTHERS: [&str; 2] = ["sparse", "farrell_scaled"];

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let recording = record(&root)?;
    let flat = scenario("duck_2003_flat")?;
    let mut page = Page::new(root.join("docs/plume.md"));
    let draw = |name: &str, svg: String| -> Result<(), Box<dyn Error>> {
        let path: PathBuf = root.join("docs/plume").join(name);
        fs::create_dir_all(root.join("docs/plume"))?;
        fs::write(&path, svg)?;
        writeln!(std::io::stdout(), "docs/plume/{name}")?;
        Ok(())
    };

    draw("map.svg", pictures::map(&flat, &recording)?)?;
    draw("readings.svg", pictures::readings(&flat, &recording)?)?;

    let plumes = [
        ("duck_2003_flat", measure::bands(&flat, SEEDS)?),
        ("ours at half the rate", measure::bands(&half_rate(&recording), SEEDS)?),
        ("record, flat kernel", measure::recorded_bands(&recording, RecordedKernel::Flat)),
        ("record, its own kernel", measure::recorded_bands(&recording, RecordedKernel::Pompy)),
        ("duck_2003", measure::bands(&scenario("duck_2003")?, SEEDS)?),
    ];
    page.put("wanted", wanted(&plumes[0].1));
    page.put("bands", by_band(plumes.iter().map(|(name, bands)| (String::from(*name), bands))));
    draw("bands.svg", pictures::bands(&plumes))?;

    let others = OTHERS.map(|name| Ok((String::from(name), measure::bands(&scenario(name)?, SEEDS)?)));
    let others: Vec<(String, Vec<Band>)> = others.into_iter().collect::<Result<_, Box<dyn Error>>>()?;
    page.put("others", by_band(others.iter().map(|(name, bands)| (name.clone(), bands))));

    let diffusivity = Plume::default().diffusivity;
    let aged = measure::scatter(8, 10)?;
    page.put("spread", spread(&aged, diffusivity));
    draw("spread.svg", pictures::spread(&aged, diffusivity))?;
    page.put("mass", mass()?);

    page.put("flow", flow(&flat, &recording)?);
    draw("flow.svg", pictures::flow(&flat, &recording)?)?;

    let even = STEPS.map(|step| (format!("{step} s"), step, false));
    let graded = (String::from("strides"), 1.0, true);
    let measured = even.into_iter().chain([graded]).map(|(name, step, graded)| {
        let plume = flat.environment.plume.clone().map(|plume| Plume { step, graded, ..plume });
        Ok((
            name,
            measure::bands_under_way(
                &Scenario { environment: Environment { plume, ..flat.environment.clone() }, ..flat.clone() },
                STEP_SEEDS,
            )?,
        ))
    });
    let steps: Vec<(String, Vec<Band>)> = measured.collect::<Result<_, Box<dyn Error>>>()?;
    page.put("steps", by_band(steps.iter().map(|(name, bands)| (name.clone(), bands))));
    draw("steps.svg", pictures::steps(&steps))?;
    page.write()?;
    writeln!(std::io::stdout(), "docs/plume.md")?;
    Ok(())
}

fn record(root: &Path) -> Result<Arc<Recording>, Box<dyn Error>> {
    let folder = root.join("missions/recorded");
    let header = RecordingHeader::read(&fs::read_to_string(folder.join("case_a.json"))?)?;
    let binary = fs::read(folder.join(header.binary()))?;
    Ok(Arc::new(header.decode(&binary)?))
}

/// Our own plume with the record's numbers: `own_plume_a` of `missions/recorded.alb`.
fn half_rate(recording: &Recording) -> Scenario {
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, Heading::NORTH, 1094.0, 367.0)),
            flow: Flow {
                mean: 0.125 * Heading::from_degrees(180.0).unit(),
                meander: Some(Meander::default()),
                ..Flow::default()
            },
            plume: Some(Plume::default()),
            sources: vec![Source { at: recording.source(), rate: 0.5, ..Source::default() }],
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// The first plume against what is wanted of it.
fn wanted(bands: &[Band]) -> String {
    let head = ["band", "on-fraction", "wanted", "median gap", "wanted", ""];
    let rows = bands.iter().zip(pictures::WANTED).map(|(band, (on, gap))| {
        let (found_on, found_gap) = (band.on_fraction(), band.gap(0.5));
        let within = (found_on - on).abs() <= pictures::ON_MAY_DIFFER
            && (found_gap / gap - 1.0).abs() <= pictures::GAP_MAY_DIFFER + 1e-9;
        vec![
            format!("{}-{} m", band.from, band.to),
            format!("{found_on:.3}"),
            format!("{on} ± {}", pictures::ON_MAY_DIFFER),
            format!("{found_gap:.1} s"),
            format!("{gap} s ± {:.0} %", 100.0 * pictures::GAP_MAY_DIFFER),
            String::from(if within { "within" } else { "**outside**" }),
        ]
    });
    table(&head, rows)
}

/// On-fraction; median, 90 % and 99 % gap in each band.
fn by_band<'a>(plumes: impl Iterator<Item = (String, &'a Vec<Band>)>) -> String {
    let head = ["", "20-100 m", "100-300 m", "300-600 m", "600-950 m"];
    let cell = |b: &Band| format!("{:.2}; {:.1} {:.1} {:.1}", b.on_fraction(), b.gap(0.5), b.gap(0.9), b.gap(0.99));
    table(&head, plumes.map(|(name, bands)| std::iter::once(name).chain(bands.iter().map(cell)).collect()))
}

fn spread(aged: &[measure::Aged], diffusivity: f64) -> String {
    let plume = Plume::default();
    let head = ["age", "2 K t", "along the flow", "across", "r2 by the law", "r2"];
    let rows = aged.iter().step_by(3).map(|class| {
        let (theory, r2) =
            (2.0 * diffusivity * class.age, plume.initial_radius * plume.initial_radius + plume.growth * class.age);
        vec![
            format!("{:.0} s", class.age),
            format!("{theory:.1} m2"),
            format!("{:.1} m2 ({:+.1} %)", class.along, 100.0 * (class.along / theory - 1.0)),
            format!("{:.1} m2 ({:+.1} %)", class.across, 100.0 * (class.across / theory - 1.0)),
            format!("{r2:.4} m2"),
            format!("{:.4} m2", class.squared_radius),
        ]
    });
    table(&head, rows)
}

fn mass() -> Result<String, Box<dyn Error>> {
    let head = ["plume", "filaments", "ages", "amount over the law's, least", "greatest"];
    let row = |name: &str, amounts: Vec<(f64, f64)>| {
        let least = |of: &dyn Fn(&(f64, f64)) -> f64| amounts.iter().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: &dyn Fn(&(f64, f64)) -> f64| amounts.iter().map(of).fold(0.0, f64::max);
        vec![
            String::from(name),
            amounts.len().to_string(),
            format!("{:.0} to {:.0} s", least(&|a| a.0), most(&|a| a.0)),
            format!("{:.4}", least(&|a| a.1)),
            format!("{:.4}", most(&|a| a.1)),
        ]
    };
    let rows = [row("flat", measure::amounts(None)?), row("in a layer of 3.5 m", measure::amounts(Some(3.5))?)];
    Ok(table(&head, rows.into_iter()))
}

fn flow(flat: &Scenario, recording: &Recording) -> Result<String, Box<dyn Error>> {
    let found = measure::meanders(flat, 200)?;
    let sigma =
        flat.environment.flow.meander.as_ref().map_or(0.0, |m| m.direction_sd) * flat.environment.flow.mean.length();
    let root = 0.5_f64.sqrt();
    let mm = |v: f64| format!("{:.1} mm/s", 1000.0 * v);
    let both = |(u, v): (f64, f64)| vec![mm(u), mm(v)];
    let head = ["where", "theory", "along the flow", "across"];
    let row = |name: &str, theory: String, found: Vec<String>| [vec![String::from(name), theory], found].concat();
    let (u, v) = recorded_deviation(recording);
    let rows = [
        row("at the corners", mm(sigma), both(found.corners)),
        row("in the middles of the edges", mm(sigma * root), both(found.edges)),
        row("within the region", String::from("less: it is damped"), both(found.inside)),
        row("the record, within its region", String::new(), both((u, v))),
    ];
    Ok(format!(
        "{}\nThe direction within the region has a deviation of {:.1} deg.\n",
        table(&head, rows.into_iter()),
        found.direction
    ))
}

/// Deviations of the record's flow over its area and all its time, along its mean and across, m/s.
fn recorded_deviation(recording: &Recording) -> (f64, f64) {
    let mean = recording.mean_flow();
    let (mut along, mut across, mut n) = (0.0, 0.0, 0.0);
    for time in (0..=5400).step_by(60) {
        for (i, j) in (0..10).flat_map(|i| (0..6).map(move |j| (i, j))) {
            let p = Point::new(-500.0 + 111.0 * f64::from(i), -150.0 + 60.0 * f64::from(j));
            let off = recording.flow(p, f64::from(time)) - mean;
            along += off.north * off.north;
            across += off.east * off.east;
            n += 1.0;
        }
    }
    ((along / n).sqrt(), (across / n).sqrt())
}
