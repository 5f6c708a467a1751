//! Time limits by two clocks, and the link that lags behind the vehicle: what a mission makes of a vehicle whose time, or whose
//! words, cannot be relied on.

use crate::Event;
use crate::state::{Requirement, Run};
use albacore_vehicle::TICK_S;

/// The host's clock ends a mission that the vehicle's would let go on, when it has counted this share more than the time limit,
/// and so many ticks: a tenth and a minute. No clock in order is that far off, and a link may stand still for a while.
const HOST_SHARE: f64 = 1.1;
const HOST_TICKS: f64 = 600.0;

/// A tick is a tenth of a second: divided by ten, seconds come out as they are written.
fn seconds(ticks: f64) -> f64 {
    ticks / (1.0 / TICK_S)
}

impl Run {
    /// Time limits count from this tick.
    pub fn begin_to_count(&mut self) {
        self.state.began = self.state.tick;
        self.state.host_began = self.state.lag.host.unwrap_or(0);
    }

    /// Whether the time limit is reached, by the vehicle's clock, or well beyond it by the host's.
    pub fn time_is_up(&self) -> bool {
        let Some(within) = self.state.within else { return false };
        let by_host = self.host_lived().is_some_and(|lived| lived > within * HOST_SHARE + HOST_TICKS);
        self.lived() >= within || by_host
    }

    /// Tells that it is, and by which clock.
    pub fn tell_time_is_up(&mut self) {
        self.events.push(Event::TimedOut);
        if let (Some(within), Some(host)) = (self.state.within, self.host_lived())
            && self.lived() < within
        {
            self.events.push(Event::HostTimeUp(seconds(host), seconds(self.lived())));
        }
    }

    fn lived(&self) -> f64 {
        (self.state.tick - self.state.began) as f64
    }

    fn host_lived(&self) -> Option<f64> {
        self.state.lag.host.map(|host| host.saturating_sub(self.state.host_began) as f64)
    }

    /// What is wrong with the link, if its round trip takes too long; an event when that begins and when it ends.
    pub fn lagging(&mut self) -> Option<String> {
        let round_trip = self.state.lag.round_trip as f64;
        let Requirement { fresh, stale, .. } = self.state.link;
        let lags = round_trip > fresh;
        let (takes, may_take) = (seconds(round_trip), seconds(fresh));
        // A link that is slow and quick by turns is no better than a slow one.
        let lagged = self.state.lagged;
        self.state.lagged = if lags && stale { lagged + 2 } else { lagged.saturating_sub(1) };
        if lags != stale {
            self.state.link.stale = lags;
            self.state.link.since = self.state.tick;
            self.events.push(if lags { Event::Lagging(takes, may_take) } else { Event::LaggingEnded });
        }
        lags.then(|| format!("the link's round trip takes {takes:.1} s, more than {may_take:.1} s"))
    }

    /// The cause of an abort, when the link has lagged for too long.
    pub fn lost_link(&self, lagging: Option<&str>) -> Option<String> {
        let lost = self.state.lagged as f64 >= 2.0 * self.state.link.patience.unwrap_or(0.0);
        lagging.filter(|_| lost).map(str::to_string)
    }
}
