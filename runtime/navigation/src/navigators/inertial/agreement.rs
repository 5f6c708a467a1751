//! Whether an instrument and the filter agree, sample by sample.

/// Disagreement of so long, s, is told. A sample that the gate lets through takes a tenth of its time off again.
const DISAGREES_S: f64 = 5.0;
const FORGIVES: f64 = 0.1;
/// A sample stands for the time since the one before, but for no longer than this, s.
const SAMPLE_S_MAX: f64 = 2.0;
/// Over so long, s, normalised innovations are averaged ...
const AVERAGED_S: f64 = 60.0;
/// ... and so many of its own standard deviations above 1 their mean may be.
const MEAN_DEVIATIONS: f64 = 6.0;

/// The agreement of one instrument with the filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Numbers of a sample.
    freedoms: f64,
    /// When the last sample came, s.
    last: Option<f64>,
    /// For how long samples have been held back, s, less what was forgiven since.
    disagreed: f64,
    /// The mean of the normalised innovation squared of each number, 1 where the filter is right, and the sum of the squares of the
    /// weights that it is made with.
    mean: f64,
    weights: f64,
    disagrees: bool,
    /// Whether it has disagreed for long enough, since this was last told.
    persists: f64,
}

/// What a sample did to the agreement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// It is as it was.
    Same,
    /// It has begun to disagree.
    Disagrees,
    /// It agrees again.
    Agrees,
}

impl Agreement {
    /// Of an instrument with so many numbers a sample.
    pub fn of(freedoms: u8) -> Self {
        Agreement {
            freedoms: f64::from(freedoms),
            last: None,
            disagreed: 0.0,
            mean: 1.0,
            weights: 0.0,
            disagrees: false,
            persists: 0.0,
        }
    }

    /// A sample of a time, s, with its normalised innovation squared, and whether it was held back. One that is no number at all has
    /// none.
    pub fn take(&mut self, time: f64, nis: Option<f64>, held_back: bool) -> Turn {
        let since = self.last.map_or(SAMPLE_S_MAX, |last| (time - last).clamp(0.0, SAMPLE_S_MAX));
        self.last = Some(time);
        if held_back {
            self.disagreed = (self.disagreed + since).min(2.0 * DISAGREES_S);
            self.persists += since;
        } else {
            self.disagreed = (self.disagreed - FORGIVES * since).max(0.0);
            self.persists = (self.persists - FORGIVES * since).max(0.0);
        }
        if let Some(nis) = nis {
            let share = (since / AVERAGED_S).min(1.0);
            // One sample in a thousand is beyond the gate where all is well: it counts, but not for more than ten.
            let told = (nis / self.freedoms).min(10.0);
            self.mean += share * (told - self.mean);
            self.weights = (1.0 - share) * (1.0 - share) * self.weights + share * share;
        }
        // The variance of chi-square over its degrees of freedom is 2 / freedoms.
        let deviation = (2.0 / self.freedoms * self.weights).sqrt();
        let scatters = self.mean > 1.0 + MEAN_DEVIATIONS * deviation;
        if !self.disagrees && (self.disagreed >= DISAGREES_S || scatters) {
            self.disagrees = true;
            Turn::Disagrees
        } else if self.disagrees && self.disagreed == 0.0 && !scatters {
            self.disagrees = false;
            Turn::Agrees
        } else {
            Turn::Same
        }
    }

    /// Whether samples have been held back for so long that the filter may be the one that is wrong; then it begins to count anew.
    pub fn has_persisted(&mut self) -> bool {
        let persists = self.persists >= DISAGREES_S;
        if persists {
            self.persists = 0.0;
        }
        persists
    }

    /// Whether it disagrees now.
    pub fn disagrees(&self) -> bool {
        self.disagrees
    }

    /// Whether its last sample is no older than this at a time, s, and it agrees.
    pub fn agrees_lately(&self, time: f64, age: f64) -> bool {
        !self.disagrees && self.disagreed == 0.0 && self.last.is_some_and(|last| time - last <= age)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples at 5 Hz with the same innovation each, held back beyond a gate: the turns, each with its time.
    fn turns(agreement: &mut Agreement, from: f64, seconds: f64, nis: impl Fn(u32) -> f64) -> Vec<(f64, Turn)> {
        let samples = (0..(seconds * 5.0) as u32).map(|i| (from + f64::from(i) / 5.0, nis(i)));
        let turn = |(time, nis): (f64, f64)| (time, agreement.take(time, Some(nis), nis > 16.27));
        samples.map(turn).filter(|(_, turn)| *turn != Turn::Same).collect()
    }

    #[test]
    fn it_is_told_after_five_seconds_and_over_when_as_much_has_agreed() {
        let mut dvl = Agreement::of(3);
        assert_eq!(turns(&mut dvl, 0.0, 600.0, |_| 3.0), []);
        let told = turns(&mut dvl, 600.0, 20.0, |_| 100.0);
        assert!(matches!(told[..], [(time, Turn::Disagrees)] if (time - 604.8).abs() < 0.3), "{told:?}");
        assert!(dvl.has_persisted() && !dvl.has_persisted());
        let told = turns(&mut dvl, 620.0, 400.0, |_| 3.0);
        assert!(matches!(told[..], [(time, Turn::Agrees)] if time > 660.0), "{told:?}");
    }

    #[test]
    fn what_the_gate_lets_through_but_is_too_much_on_average_is_told() {
        let mut dvl = Agreement::of(3);
        assert!(turns(&mut dvl, 0.0, 600.0, |i| if i % 3 == 0 { 6.0 } else { 1.5 }).is_empty());
        assert_eq!(turns(&mut dvl, 600.0, 120.0, |_| 9.0).len(), 1);
    }

    #[test]
    fn one_sample_in_ten_that_is_held_back_is_forgiven() {
        let mut dvl = Agreement::of(3);
        assert_eq!(turns(&mut dvl, 0.0, 3600.0, |i| if i % 1000 == 0 { 20.0 } else { 3.0 }), []);
    }
}
