//! Section 8: after a rise the least water of the last 20 to 40 s counts.

/// The water since a rise.
#[derive(Default)]
pub struct Rise {
    /// The last tick in which a rise was asked for.
    last: Option<u64>,
    /// The least water, m, by spans of 20 s, and when each began.
    spans: Vec<(u64, Option<f64>)>,
}

impl Rise {
    pub fn asked(&mut self, tick: u64) {
        if !self.counts(tick) {
            self.spans = vec![(tick, None)];
        }
        self.last = Some(tick);
    }

    pub fn told(&mut self, tick: u64, water: f64) {
        if !self.counts(tick) {
            return;
        }
        if self.spans.last().is_none_or(|(begun, _)| tick - begun >= 200) {
            self.spans.push((tick, None));
        }
        if let Some((_, least)) = self.spans.last_mut() {
            *least = Some(least.map_or(water, |least| least.min(water)));
        }
    }

    /// The least water, m, in this span and in the one before.
    pub fn least(&self, tick: u64) -> Option<f64> {
        let spans = self.spans.iter().rev().take(2).filter(|_| self.counts(tick));
        spans.filter_map(|(_, least)| *least).reduce(f64::min)
    }

    fn counts(&self, tick: u64) -> bool {
        self.last.is_some_and(|last| tick - last <= 400)
    }
}
