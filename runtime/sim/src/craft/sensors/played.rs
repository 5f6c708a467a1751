//! Samples that were recorded, told again at their times in place of what an instrument would tell. The truth is as ever.

use super::{InstrumentSetup, water_depth};
use crate::scenario::ScenarioIssues;
use albacore_vehicle::measurements::{WATER_DEPTH, info};
use albacore_vehicle::{Reading, Sample};
use std::sync::Arc;

/// A measurement that is played: it tells these samples, and no others.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    measurement: u16,
    samples: Arc<[PlayedSample]>,
}

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlayedSample {
    /// The tick at which it comes.
    pub tick: u64,
    /// What it tells, in SI units.
    pub reading: Reading,
}

impl Played {
    /// A measurement with its samples, in the order of their times; none where it is in no unit, or is made of others.
    pub fn new(measurement: u16, samples: Vec<PlayedSample>) -> Option<Self> {
        Played::can_be(measurement).then(|| Played { measurement, samples: samples.into() })
    }

    /// Whether a measurement can be played: `water_depth` is the sum of what is told of depth and altitude, played or not.
    pub fn can_be(measurement: u16) -> bool {
        measurement != WATER_DEPTH && info(measurement).quantity.is_measured()
    }

    /// What is played.
    pub fn name(&self) -> &'static str {
        info(self.measurement).name
    }

    /// Its samples, in the order of their times.
    pub fn samples(&self) -> &[PlayedSample] {
        &self.samples
    }
}

/// What of them cannot be.
pub(super) fn check(setup: &InstrumentSetup, issues: &mut ScenarioIssues) {
    let names: Vec<&str> = setup.played.iter().map(Played::name).collect();
    for (nth, name) in names.iter().enumerate() {
        issues.nth("played", nth).unless(
            Some("name"),
            !names[..nth].contains(name),
            format!("`{name}` is played already"),
            "leave one of the two out: they would tell of the same at the same time",
        );
    }
}

/// Plays them.
#[derive(Clone, Debug)]
pub(super) struct Player(Vec<Playing>);

/// One of them, and how many of its samples were told.
#[derive(Clone, Debug)]
struct Playing {
    played: Played,
    told: usize,
}

impl Player {
    pub fn new(played: &[Played]) -> Self {
        Player(played.iter().map(|played| Playing { played: played.clone(), told: 0 }).collect())
    }

    /// Puts what is played at a tick in the place of what was measured.
    pub fn play(&mut self, tick: u64, samples: &mut Vec<Sample>) {
        if self.0.is_empty() {
            return;
        }
        for playing in &mut self.0 {
            playing.play(tick, samples);
        }
        let is_played = |measurement| self.0.iter().any(|playing| playing.played.measurement == measurement);
        if info(WATER_DEPTH).sources.iter().any(|source| is_played(*source)) {
            samples.retain(|sample| sample.measurement != WATER_DEPTH);
            samples.extend(water_depth(samples).map(|depth| sample(WATER_DEPTH, [depth, 0.0, 0.0, 0.0])));
        }
        // A depth comes before an altitude, whoever tells it: in the order of the table of measurements.
        samples.sort_by_key(|sample| sample.measurement);
    }
}

impl Playing {
    fn play(&mut self, tick: u64, samples: &mut Vec<Sample>) {
        let measurement = self.played.measurement;
        samples.retain(|sample| sample.measurement != measurement);
        let left = self.played.samples.get(self.told..).unwrap_or_default();
        let due = left.iter().take_while(|sample| sample.tick <= tick);
        samples.extend(due.clone().map(|played| sample(measurement, played.reading)));
        self.told += due.count();
    }
}

fn sample(measurement: u16, reading: Reading) -> Sample {
    Sample { measurement, reading }
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_vehicle::measurements::{
        ALTITUDE, BEACON, CHEMICAL, COURSE, DEPTH, FLOW, POSITION, UTC, VEHICLE_MODE,
    };

    fn played(measurement: u16, samples: &[(u64, f64)]) -> Played {
        let samples = samples.iter().map(|&(tick, x)| PlayedSample { tick, reading: [x, 0.0, 0.0, 0.0] }).collect();
        Played::new(measurement, samples).unwrap()
    }

    /// What comes in ticks that an instrument would fill with `measured`.
    fn told(all: &[Played], measured: &[(u16, f64)], ticks: u64) -> Vec<Vec<(u16, f64)>> {
        let mut player = Player::new(all);
        let tick = |tick| {
            let mut samples: Vec<Sample> =
                measured.iter().map(|&(measurement, x)| sample(measurement, [x, 0.0, 0.0, 0.0])).collect();
            player.play(tick, &mut samples);
            samples.iter().map(|s| (s.measurement, s.reading[0])).collect()
        };
        (0..ticks).map(tick).collect()
    }

    #[test]
    fn samples_come_at_their_ticks_and_no_others_do() {
        let series = played(CHEMICAL, &[(1, 0.1), (3, 0.2), (3, 0.3)]);
        let told = told(&[series], &[(DEPTH, 2.0), (CHEMICAL, 0.9)], 5);
        let alone = vec![(DEPTH, 2.0)];
        assert_eq!(told[0], alone);
        assert_eq!(told[1], [(DEPTH, 2.0), (CHEMICAL, 0.1)]);
        assert_eq!(told[2], alone);
        assert_eq!(told[3], [(DEPTH, 2.0), (CHEMICAL, 0.2), (CHEMICAL, 0.3)]);
        assert_eq!(told[4], alone);
    }

    #[test]
    fn the_depth_of_the_water_is_the_sum_of_what_is_told() {
        let measured = [(DEPTH, 2.0), (ALTITUDE, 5.0), (WATER_DEPTH, 7.0)];
        let told = told(&[played(ALTITUDE, &[(1, 6.0)])], &measured, 2);
        assert_eq!(told[0], [(DEPTH, 2.0)]);
        assert_eq!(told[1], [(DEPTH, 2.0), (ALTITUDE, 6.0), (WATER_DEPTH, 8.0)]);
    }

    #[test]
    fn only_numbers_that_are_made_of_no_others_can_be_played() {
        assert!([UTC, VEHICLE_MODE, WATER_DEPTH].iter().all(|&other| !Played::can_be(other)));
        assert!(
            [POSITION, FLOW, BEACON, COURSE, DEPTH, ALTITUDE, CHEMICAL].iter().all(|&number| Played::can_be(number))
        );
    }

    #[test]
    fn a_vehicle_tells_what_it_has_no_instrument_for_and_of_two_one_is_too_many() {
        use albacore_vehicle::measurements::{SALINITY, TEMPERATURE};
        let twice = vec![played(TEMPERATURE, &[]), played(TEMPERATURE, &[])];
        let setup = InstrumentSetup { played: twice, ..InstrumentSetup::default() };
        let tells = |measurement: u16| setup.measurements().iter().any(|m| m.name == info(measurement).name);
        assert!(tells(TEMPERATURE) && !tells(SALINITY));
        let mut issues = ScenarioIssues::default();
        check(&setup, &mut issues);
        assert_eq!(issues.0.iter().map(|issue| issue.nth).collect::<Vec<_>>(), [1]);
    }
}
