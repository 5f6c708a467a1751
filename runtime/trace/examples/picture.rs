//! Draws plausible runs into a folder: `cargo run -p albacore-trace --example picture [FOLDER]`.

use albacore_geometry::{Area, Heading, Point, math};
use albacore_trace::{Digest, Picture};
use std::{error::Error, fs, io::Write, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    fs::create_dir_all(&folder)?;
    let pictures = [
        ("tall", tall()?),
        ("square", square()?),
        ("several", several()?),
        ("empty", Picture::default()),
        ("far", far()),
        ("dot", dot()),
    ];
    for (name, picture) in pictures {
        let path = folder.join(format!("{name}.svg"));
        fs::write(&path, picture.svg())?;
        writeln!(std::io::stdout(), "{}", path.display())?;
    }
    Ok(())
}

const FLOW_DEG: f64 = 140.0;

/// A search down a long area, the plume traced up-flow, bow-ties, a source declared.
fn tall() -> Result<Picture, Box<dyn Error>> {
    let area = Area::rectangle(Point::new(-310.0, 240.0), Heading::from_degrees(320.0), 1094.0, 367.0);
    chase("duck_single", &area, Point::new(0.0, 0.0), Point::new(13.0, 2.0), 45.0, 780.0)
}

/// The same in a small square.
fn square() -> Result<Picture, Box<dyn Error>> {
    let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 200.0, 200.0);
    chase("harbour <square> & \"quotes\"", &area, Point::new(45.0, -40.0), Point::new(47.0, -37.5), 12.0, 110.0)
}

/// A plume that meanders down-flow from its source, as far as is looked for it.
struct Plume {
    source: Point,
    swing: f64,
    reach: f64,
}

impl Plume {
    fn down() -> Heading {
        Heading::from_degrees(FLOW_DEG)
    }

    fn across() -> Heading {
        Plume::down() + math::PI / 2.0
    }

    /// Its middle so many metres down-flow.
    fn axis(&self, along: f64) -> Point {
        let meander = self.swing * (1.0 + along / 400.0) * math::sin(along / (3.0 * self.swing));
        self.source + along * Plume::down().unit() + meander * Plume::across().unit()
    }

    fn filaments(&self) -> Vec<(Point, f64)> {
        let scatter = |n: u32| {
            let mut digest = Digest::new();
            digest.word(u64::from(n));
            (digest.value() >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        let filament = |i: u32| {
            let along = self.reach * 1.3 * f64::from(i) / 9_000.0;
            let wide = 1.0 + along * 0.07;
            let aside = (scatter(i) * wide) * Plume::across().unit();
            let p = self.axis(along) + aside + (scatter(i + 100_000) * wide) * Plume::down().unit();
            (p, 0.3 + along * 0.004)
        };
        (0..9_000).map(filament).collect()
    }
}

/// A drive through a plume: where the vehicle is, where it was, and where it detected something.
struct Drive<'p> {
    plume: &'p Plume,
    at: Point,
    track: Vec<(Point, u16)>,
    detections: Vec<Point>,
}

impl Drive<'_> {
    fn go(&mut self, to: Point, behavior: u16) {
        let steps = (self.at.distance(to) / 0.2).ceil().max(1.0) as u32;
        let from = self.at;
        for i in 0..=steps {
            let p = from + (f64::from(i) / f64::from(steps)) * (to - from);
            self.track.push((p, behavior));
            let along = (p - self.plume.source).along(Plume::down());
            if along > 0.0 && i % 7 == 0 && p.distance(self.plume.axis(along)) < 0.6 + along * 0.03 {
                self.detections.push(p);
            }
        }
        self.at = to;
    }

    /// Finds the plume, follows it up-flow, and crosses its source in bow-ties.
    fn chase(&mut self) {
        let Plume { source, swing, reach } = *self.plume;
        let across = Plume::across().unit();
        let mut along = reach;
        for i in 0..3 {
            let side = if i % 2 == 0 { 2.2 } else { -2.2 };
            self.go(self.plume.axis(along) + (side * swing) * across, 0);
            along -= reach * 0.03;
        }
        while along > swing * 0.5 {
            for (i, behavior) in [(0, 1), (1, 1), (2, 2)] {
                along -= swing * 0.24;
                let side = if i == 2 { -0.45 } else { 0.3 };
                self.go(self.plume.axis(along) + (side * (0.4 * swing + along * 0.03)) * across, behavior);
            }
        }
        for n in [2.0, 1.0, 0.0] {
            let centre = source + (swing * 0.2 * n) * Plume::down().unit();
            let half = swing * 0.6;
            for lean in [0.25, -0.25] {
                let leg = Plume::down().reverse() + lean;
                self.go(centre + (-half) * leg.unit(), 3);
                self.go(centre + half * leg.unit(), 3);
            }
        }
    }
}

fn chase(
    title: &str,
    area: &Area,
    source: Point,
    declared: Point,
    swing: f64,
    reach: f64,
) -> Result<Picture, Box<dyn Error>> {
    let plume = Plume { source, swing, reach };
    let start = source + (reach * 1.02) * Plume::down().unit() + (-2.5 * swing) * Plume::across().unit();
    let mut drive = Drive { plume: &plume, at: start, track: Vec::new(), detections: Vec::new() };
    drive.chase();
    drive.go(declared, 4);
    drive.go(area.center(), 5);
    let behaviors = ["find", "track_in", "track_out", "reacquire", "confirm", "goto center"];
    Ok(Picture {
        title: title.to_string(),
        subtitle: vec![
            "scenario duck_2003, seed 7: completed after 1830.4 s".to_string(),
            "source declared 13.2 m from the true one".to_string(),
        ],
        area: area.corners().to_vec(),
        plume: plume.filaments(),
        track: drive.track,
        behaviors: behaviors.map(String::from).to_vec(),
        detections: drive.detections,
        reports: vec![("declared, 13.2 m off".to_string(), declared)],
        sources: vec![("dye".to_string(), source)],
        start: Some(start),
        flows: vec![("flow".into(), 0.125 * Plume::down().unit())],
        ..Picture::default()
    })
}

/// A narrow area with marks close together and at its edge.
fn several() -> Result<Picture, Box<dyn Error>> {
    let area = Area::rectangle(Point::new(500.0, 100.0), Heading::NORTH, 1094.0, 367.0);
    let named = |name: &str, north: f64, east: f64| (name.to_string(), Point::new(north, east));
    let declared = vec![
        named("first, 13.2 m off", 313.0, 2.0),
        named("second, 4.1 m off", 330.0, 20.0),
        named("third, 9.9 m off", 1030.0, 280.0),
    ];
    let sources =
        vec![named("dye", 300.0, 0.0), named("second dye", 333.0, 22.0), named("the one in the corner", 1040.0, 279.0)];
    let mut track = Vec::new();
    for row in 0..12_u32 {
        for i in 0..=160_u32 {
            let along = if row % 2 == 0 { i } else { 160 - i };
            let p = Point::new(f64::from(row) * 85.0 + 10.0, f64::from(along) * 2.0 - 60.0);
            track.push((p, if row == 4 { 1 } else { 0 }));
        }
    }
    Ok(Picture {
        title: "duck_multi".to_string(),
        area: area.corners().to_vec(),
        start: track.first().map(|(p, _)| *p),
        track,
        behaviors: vec!["survey".to_string(), "track_in".to_string()],
        reports: declared,
        sources,
        flows: vec![("flow".into(), Heading::from_degrees(359.9).unit())],
        ..Picture::default()
    })
}

/// A long way along one line, far from the origin, with more behaviors than colours.
fn far() -> Picture {
    let track = (0..60_000_u32).map(|i| {
        let along = f64::from(i) * 2.0;
        (Point::new(-7_000_000.0 + along, 2_000_000.0 + 50.0 * math::sin(along / 700.0)), (i / 3_000) as u16)
    });
    let names = (0..20).map(|i| format!("a behavior with a rather long name {i}"));
    Picture { title: "transit".to_string(), track: track.collect(), behaviors: names.collect(), ..Picture::default() }
}

/// A vehicle that never moved, and coordinates that are none.
fn dot() -> Picture {
    let here = Point::new(3.0, 4.0);
    let nowhere = Point::new(f64::NAN, f64::INFINITY);
    Picture {
        title: "moored".to_string(),
        track: vec![(here, 0), (nowhere, 0), (here, 0)],
        behaviors: vec!["hold".to_string()],
        start: Some(here),
        detections: vec![nowhere],
        ..Picture::default()
    }
}
