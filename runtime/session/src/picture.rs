//! What the picture of a run is made of, gathered while it goes.

use crate::summary::Summary;
use albacore_geometry::Point;
use albacore_program::number;
use albacore_trace::Picture;

/// The track, the detections and what was declared.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sketch {
    track: Vec<(Point, u16)>,
    behaviors: Vec<String>,
    detections: Vec<Point>,
    declared: Vec<(String, Point)>,
}

impl Sketch {
    pub fn track(&mut self, at: Point, behavior: String) {
        let index = self.behaviors.iter().position(|b| *b == behavior).unwrap_or_else(|| {
            self.behaviors.push(behavior);
            self.behaviors.len() - 1
        });
        self.track.push((at, index as u16));
    }

    pub fn detection(&mut self, at: Point) {
        self.detections.push(at);
    }

    pub fn declared(&mut self, name: &str, at: Point) {
        self.declared.push((name.to_string(), at));
    }

    /// The picture of all that was gathered, in the world that is known.
    pub fn svg(&self, summary: &Summary, world: Picture) -> String {
        let mut subtitle = vec![format!(
            "scenario {}, seed {}: {} after {}",
            summary.scenario,
            summary.seed,
            summary.outcome.replace('_', " "),
            number::seconds(summary.ticks).trim()
        )];
        for report in &summary.reports {
            let error = report.error_m.zip(report.error_from);
            let error = error.map(|(e, from)| format!(", {} from {from}", number::metres(e))).unwrap_or_default();
            subtitle.push(format!("{} declared at {} s{error}", report.name, number::fixed(report.t_s, 1)));
        }
        Picture {
            title: summary.mission.clone(),
            subtitle,
            track: self.track.clone(),
            behaviors: self.behaviors.clone(),
            detections: self.detections.clone(),
            declared: self.declared.clone(),
            ..world
        }
        .svg()
    }
}
