//! Whether an instrument and the filter agree, sample by sample.

/// Disagreement of so long, s, is told. A sample that the gate lets through takes a tenth of its time off again.
const DISAGREES_S: f64 = 5.0;
const FORGIVES: f64 = 0.1;
/// An instrument that has disagreed agrees again when nothing spoke against it for so long, s.
const CALM_S: f64 = 60.0;
/// A sample stands for the time since the one before, but for no longer than this, s.
const SAMPLE_S_MAX: f64 = 2.0;
/// Over so long, s, normalised innovations are averaged, and for so long before anything is said of their mean ...
const AVERAGED_S: f64 = 60.0;
const FIRST_S: f64 = 20.0;
/// ... which may be so many of its own standard deviations above 1.
const MEAN_DEVIATIONS: f64 = 6.0;
/// No sample counts for more in that mean than this: what is farther off is held back, and counts there.
const TOLD_MAX: f64 = 10.0;

/// The agreement of one instrument with the filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Numbers of a sample.
    freedoms: f64,
    /// When the first and the last sample came, s.
    first: Option<f64>,
    last: f64,
    /// For how long samples have been held back, s, less what was forgiven since.
    disagreed: f64,
    /// The same since the filter last became unsure of itself.
    persists: f64,
    /// For how long nothing has spoken against it, s.
    calm: f64,
    /// The mean of the normalised innovation squared of each number, 1 where the filter is right, and the sum of the squares of the
    /// weights that it is made with.
    mean: f64,
    weights: f64,
    disagrees: bool,
    /// Whether it has disagreed: that it agrees since proves nothing, for the filter may have followed it.
    has_disagreed: bool,
}

/// What a sample did to the agreement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// It is as it was.
    Same,
    /// It has begun to disagree.
    Disagrees,
    /// It agrees again: which of both was wrong is not known.
    Agrees,
}

impl Agreement {
    /// Of an instrument with so many numbers a sample.
    pub fn of(freedoms: u8) -> Self {
        Agreement {
            freedoms: f64::from(freedoms),
            first: None,
            last: 0.0,
            disagreed: 0.0,
            persists: 0.0,
            calm: 0.0,
            mean: 1.0,
            weights: 0.0,
            disagrees: false,
            has_disagreed: false,
        }
    }

    /// A sample of a time, s, with its normalised innovation squared, and whether it was held back. One that is no number at all has
    /// none.
    pub fn take(&mut self, time: f64, nis: Option<f64>, held_back: bool) -> Turn {
        let since = self.first.map_or(0.0, |_| (time - self.last).clamp(0.0, SAMPLE_S_MAX));
        let lasting = time - *self.first.get_or_insert(time);
        self.last = time;
        for score in [&mut self.disagreed, &mut self.persists] {
            *score = if held_back { *score + since } else { (*score - FORGIVES * since).max(0.0) };
        }
        self.disagreed = self.disagreed.min(DISAGREES_S);
        self.average(nis, since);
        // The variance of chi-square over its degrees of freedom is 2 / freedoms.
        let deviation = (2.0 / self.freedoms * self.weights).sqrt();
        let scatters = lasting > FIRST_S && self.mean > 1.0 + MEAN_DEVIATIONS * deviation;
        self.calm = if self.disagreed > 0.5 * DISAGREES_S || scatters { 0.0 } else { self.calm + since };
        if !self.disagrees && (self.disagreed >= DISAGREES_S || scatters) {
            (self.disagrees, self.has_disagreed) = (true, true);
            Turn::Disagrees
        } else if self.disagrees && self.calm > CALM_S {
            self.disagrees = false;
            Turn::Agrees
        } else {
            Turn::Same
        }
    }

    fn average(&mut self, nis: Option<f64>, since: f64) {
        let share = since / AVERAGED_S;
        let told = nis.map_or(TOLD_MAX, |nis| (nis / self.freedoms).min(TOLD_MAX));
        self.mean += share * (told - self.mean);
        self.weights = (1.0 - share) * (1.0 - share) * self.weights + share * share;
    }

    /// Whether samples have been held back for so long that the filter may be the one that is wrong, and gives way; then it begins to count anew.
    pub fn has_persisted(&mut self) -> bool {
        let persists = self.persists >= DISAGREES_S;
        if persists {
            self.persists = 0.0;
        }
        persists
    }

    /// Whether it disagrees, or has since the position was last confirmed.
    pub fn is_doubtful(&self) -> bool {
        self.has_disagreed
    }

    /// The position is confirmed by others. Whether it was doubtful, and is not any more.
    pub fn confirm(&mut self) -> bool {
        !self.disagrees && std::mem::take(&mut self.has_disagreed)
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
    fn it_is_told_after_five_seconds_and_over_after_a_minute_of_calm() {
        let mut dvl = Agreement::of(3);
        assert_eq!(turns(&mut dvl, 0.0, 600.0, |_| 3.0), []);
        let told = turns(&mut dvl, 600.0, 20.0, |_| 100.0);
        assert!(matches!(told[..], [(time, Turn::Disagrees)] if time <= 605.1), "{told:?}");
        assert!(dvl.has_persisted() && !dvl.has_persisted());
        let told = turns(&mut dvl, 620.0, 800.0, |_| 3.0);
        assert!(matches!(told[..], [(time, Turn::Agrees)] if time > 680.0), "{told:?}");
        assert!(dvl.is_doubtful() && dvl.confirm() && !dvl.is_doubtful());
    }

    #[test]
    fn what_the_gate_lets_through_but_is_too_much_on_average_is_told() {
        let mut dvl = Agreement::of(3);
        assert!(turns(&mut dvl, 0.0, 600.0, |i| if i % 3 == 0 { 6.0 } else { 1.5 }).is_empty());
        assert_eq!(turns(&mut dvl, 600.0, 120.0, |_| 9.0).len(), 1);
    }

    #[test]
    fn one_sample_in_a_thousand_that_is_held_back_is_forgiven() {
        let mut dvl = Agreement::of(3);
        assert_eq!(turns(&mut dvl, 0.0, 3600.0, |i| if i % 1000 == 0 { 20.0 } else { 3.0 }), []);
    }
}
