//! Whether an instrument lives: what it measures has noise, and never stays the same to the bit.

use super::notice;

/// So many samples that are the same: it is stuck.
const STUCK_SAMPLES: u32 = 5;
/// The life of an instrument with `N` numbers a sample.
#[derive(Clone, Debug)]
pub struct Liveliness<const N: usize> {
    name: &'static str,
    last: [f64; N],
    /// How often the last sample has come again.
    same: u32,
    /// When something came last that can be believed, s.
    heard: f64,
    /// After so long silence is told of, s; none: never.
    silent_s: Option<f64>,
    /// Whether it measures without noise: then it may stay the same.
    is_exact: bool,
    /// What is told of it now.
    told: Option<&'static str>,
}

impl<const N: usize> Liveliness<N> {
    /// Of an instrument; `is_exact` says that it has no noise. Of one whose silence matters it is told after so many seconds.
    pub fn of(name: &'static str, is_exact: bool, silent_s: Option<f64>) -> Self {
        Liveliness { name, last: [f64::NAN; N], same: 0, heard: 0.0, silent_s, is_exact, told: None }
    }

    /// Whether something is told of it now.
    pub fn is_told_of(&self) -> bool {
        self.told.is_some()
    }

    /// A sample that can be believed, or none, at a time, s.
    pub fn believed(&mut self, sample: Option<[f64; N]>, now: f64, notices: &mut Vec<String>) -> Option<[f64; N]> {
        let sample = sample.filter(|sample| sample.iter().all(|x| x.is_finite()));
        if let Some(sample) = sample {
            let is_same = sample == self.last && !self.is_exact;
            self.same = if is_same { self.same.saturating_add(1) } else { 0 };
            self.last = sample;
        }
        let believed = sample.filter(|_| self.same < STUCK_SAMPLES);
        let away = now - self.heard;
        if believed.is_some() {
            self.heard = now;
            // What comes now and then is silent between.
            if self.silent_s.is_none_or(|silent_s| away <= silent_s) {
                notices.extend(self.told.take().map(|how| notice(false, self.name, how)));
            }
        } else if self.told.is_none() {
            let is_stuck = self.same >= STUCK_SAMPLES;
            let is_silent = self.silent_s.is_some_and(|silent_s| away > silent_s);
            self.told = if is_stuck { Some("stuck") } else { is_silent.then_some("silent") };
            notices.extend(self.told.map(|how| notice(true, self.name, how)));
        }
        believed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(life: &mut Liveliness<1>, samples: impl Iterator<Item = Option<f64>>) -> (usize, Vec<String>) {
        let mut notices = Vec::new();
        let mut now = 0.0;
        let believed = samples.filter(|sample| {
            now += 0.1;
            life.believed(sample.map(|x| [x]), now, &mut notices).is_some()
        });
        (believed.count(), notices)
    }

    #[test]
    fn what_stays_the_same_is_stuck_and_what_moves_again_is_well() {
        let mut life = Liveliness::of("pressure", false, None);
        let (believed, notices) = told(&mut life, (0..30).map(|i| Some(if i < 20 { 7.0 } else { f64::from(i) })));
        assert_eq!(believed, 5 + 10);
        assert_eq!(notices, ["detected: navigation: pressure stuck", "again well: navigation: pressure stuck"]);
        let (believed, notices) = told(&mut Liveliness::of("pressure", true, None), (0..30).map(|_| Some(7.0)));
        assert_eq!((believed, notices.len()), (30, 0), "an exact one may stay the same");
    }

    #[test]
    fn silence_is_told_of_what_all_depends_on() {
        let seldom = |i: i32| (i < 20 || i % 15 == 0 || i > 100).then_some(f64::from(i));
        let (_, notices) = told(&mut Liveliness::of("gyroscope", false, Some(1.0)), (0..130).map(seldom));
        assert_eq!(notices, ["detected: navigation: gyroscope silent", "again well: navigation: gyroscope silent"]);
        assert!(told(&mut Liveliness::of("transponder", false, None), (0..130).map(seldom)).1.is_empty());
    }
}
