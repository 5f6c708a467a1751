//! Section 8: how fast a vehicle sinks that is deeper than it is told, and where it will be in 40 s.

/// The depths, m, one a tick, since it became more than a metre deeper than it is told.
#[derive(Default)]
pub struct Sinking(Vec<f64>);

impl Sinking {
    pub fn tell(&mut self, depth: f64, is_deeper_than_told: bool) {
        if !is_deeper_than_told {
            self.0.clear();
        }
        self.0.push(depth);
    }

    /// By how much deeper it will be, m: by the slower of the last two spans of 4 s, where that is 10 cm/s or more, 60 cm/s at most.
    pub fn ahead(&self) -> f64 {
        let ends: Vec<f64> = self.0.iter().step_by(40).copied().collect();
        let [.., first, second, third] = ends[..] else { return 0.0 };
        let rate = ((second - first) / 4.0).min((third - second) / 4.0);
        if rate < 0.1 { 0.0 } else { 40.0 * rate.min(0.6) }
    }
}
