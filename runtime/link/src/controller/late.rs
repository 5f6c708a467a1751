//! Ticks whose commands came too late to be sent, and whether our own computing is why.

use albacore_vehicle::TICK_S;
use std::time::Duration;

/// So many late ticks one after the other are told.
const TICKS_REPORTED: u64 = 10;
/// ... and sooner, when it took so long to compute them.
const COMPUTED_REPORTED: Duration = Duration::from_secs(1);

/// Late ticks one after the other, up to now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Late {
    ticks: u64,
    /// How long it took from what was heard to the commands, by the host's clock; ...
    computed: Duration,
    /// ... of the tick that took longest.
    longest: Duration,
}

impl Late {
    /// One more, that took so long to compute.
    pub fn add(&mut self, computed: Duration) {
        self.ticks += 1;
        self.computed += computed;
        self.longest = self.longest.max(computed);
    }

    /// What there is to tell of them when they are over.
    pub fn summary(self) -> Option<String> {
        let seconds = self.ticks as f64 * TICK_S;
        (self.ticks >= TICKS_REPORTED)
            .then(|| format!("this computer or the link was {seconds:.1} s late: the commands of that time were left out, up to the newest"))
    }

    /// What there is to tell of them when the vehicle has left us meanwhile.
    pub fn cost_us_the_vehicle(self, tick: Duration) -> Option<String> {
        let seconds = self.ticks as f64 * TICK_S;
        let why = if self.is_slow(tick) { format!(": {}", self.slow(tick)) } else { String::new() };
        (self.ticks >= TICKS_REPORTED)
            .then(|| format!("the commands of its last {seconds:.1} s came too late to be sent{why}"))
    }

    /// What there is to tell while they go on: they are late because they take longer to compute than they last.
    pub fn slow_warning(self, tick: Duration, timeout_ticks: u64) -> Option<String> {
        let timeout = timeout_ticks as f64 * TICK_S;
        (self.computed >= COMPUTED_REPORTED && self.is_slow(tick)).then(|| {
            format!(
                "{}: commands come too late to be sent, and a vehicle that hears nothing for {timeout} s takes control back; use a \
                 faster computer, or do less in a tick (`albacore check --cost` shows what it does)",
                self.slow(tick)
            )
        })
    }

    /// One that took long is a pause: we were stopped in it.
    fn is_slow(self, tick: Duration) -> bool {
        self.computed - self.longest > tick.mul_f64(self.ticks.saturating_sub(1) as f64)
    }

    fn slow(self, tick: Duration) -> String {
        let mean = self.computed.as_secs_f64() / self.ticks.max(1) as f64;
        format!("a tick takes {mean:.2} s to compute here, and lasts {:.2} s", tick.as_secs_f64())
    }
}
