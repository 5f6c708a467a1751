//! A beacon that is heard under water, such as that of a dock or of another vehicle: where it is, and what of that cannot be.

use crate::scenario::{Scenario, ScenarioIssues};
use albacore_geometry::Point;
use serde::Deserialize;

/// A beacon that rests, or goes along a track. No water carries it.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beacon {
    /// Where it is at the beginning of a run.
    pub at: Point,
    /// Where it goes from there, in order.
    pub points: Vec<Point>,
    /// When it is at each of them, s of the run.
    pub times: Vec<f64>,
}

impl Beacon {
    /// Where it is at a time, s of the run: on the straight way between two points, and after the last one there.
    pub fn position(&self, time: f64) -> Point {
        let (mut from, mut left) = (self.at, 0.0);
        for (&to, &reached) in self.points.iter().zip(&self.times) {
            if time < reached {
                return from + ((time - left) / (reached - left)).max(0.0) * (to - from);
            }
            (from, left) = (to, reached);
        }
        from
    }
}

/// What of it cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    let Some(beacon) = &scenario.environment.beacon else { return };
    let (points, times) = (beacon.points.len(), beacon.times.len());
    let mut of = objections.of("beacon");
    of.unless(
        Some("times"),
        points == times,
        format!("`points` holds {points} of the beacon, and `times` {times}"),
        "give a time for each point",
    );
    let begins = std::iter::once(&0.0);
    of.unless(
        Some("times"),
        begins.chain(&beacon.times).zip(&beacon.times).all(|(before, time)| before < time),
        "the times of the beacon do not grow from each to the next, the first from 0 s",
        "let each be later than the one before",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_from_point_to_point_and_stays_at_the_last() {
        let to = |north, east| Point::new(north, east);
        let beacon =
            Beacon { at: to(0.0, 10.0), points: vec![to(10.0, 10.0), to(10.0, 30.0)], times: vec![10.0, 15.0] };
        let told = [-1.0, 0.0, 5.0, 10.0, 12.5, 15.0, 1e6].map(|time| beacon.position(time));
        let expected = [
            to(0.0, 10.0),
            to(0.0, 10.0),
            to(5.0, 10.0),
            to(10.0, 10.0),
            to(10.0, 20.0),
            to(10.0, 30.0),
            to(10.0, 30.0),
        ];
        assert_eq!(told, expected);
        assert_eq!(Beacon { at: to(3.0, 4.0), ..Beacon::default() }.position(100.0), to(3.0, 4.0));
    }
}
