//! Whether the altitude is an echo of the bottom: the altitude of one becomes less as the vehicle dives, and grows as it rises.
//!
//! A sounder that tells the same however deep the vehicle is hears nothing, or itself, or a layer that moves with it; what it tells
//! scatters all the same. While the vehicle is told to go deeper and does, an altitude that hardly becomes less is not believed any
//! more, until it has grown with a rise. Over a bottom that falls away as fast as the vehicle dives it is true all the same, and
//! the next rise shows it. So it does of an echo that comes after a silence in which the vehicle dived: it may be late by as much, and
//! follows the dive all the same. What a vehicle keeps, by altitude or by the limit of one, may well stay the same: nothing is said of it.
//!
//! Echoes scatter, so none is compared with another: a line is laid through all of a dive ([`Line`]), and its slope is the share of
//! the dive that the altitude follows: 1 over level ground, 0 of what hears itself, and over a bottom that falls away at 1 in 4
//! below a vehicle that dives at 1 in 3 still 0.25. At 10 Hz and 0.6 m/s a scatter of 0.3 m leaves an error of 0.14 in a dive of 1.5 m.
//! A dive with a larger error than 0.125 is looked at for longer, to 3 m at most: there 1 Hz and 0.3 m leave an error of 0.15, five of
//! them between the true share and the least. What passes once by chance does not pass twice: from its second look on the whole dive
//! counts too, whose error becomes less with the power 1.5 of its length.

use albacore_vehicle::{Command, Vertical};

/// A dive of so many metres tells whether the altitude follows it.
const DIVE_M: f64 = 1.5;
/// ... by this share of it at least.
const FOLLOWS_SHARE: f64 = 0.25;
/// What failed is believed again by a rise of so many metres: more than the dive that it takes to fail, so that one that passes and
/// fails by turns leads no deeper.
const RISE_M: f64 = 2.0;
/// ... or by one of so many to this depth, from where there is no more to rise.
const RISE_TO_SURFACE_M: f64 = 1.0;
const SURFACE_M: f64 = 0.5;
/// ... and this share of it, which no slow wave of what it tells (0.5 m in 40 s) makes, and not by chance.
const REGAINS_SHARE: f64 = 0.5;
const CHANCE_ERRORS: f64 = 2.0;
/// A share is known well enough with this standard error, and has to be once the way is so many times as long.
const ERROR_MAX: f64 = 0.125;
const LONGER: f64 = 2.0;
/// Whoever takes more ticks than this for the way, 60 s, has the bottom change below rather than the depth.
const SLOW_TICKS: u64 = 600;
/// A vehicle that is told to go deeper by no more than this, m, keeps what it has.
const KEEPS_M: f64 = 0.5;
/// ... by the altitudes of about so many ticks: 1 s.
const SMOOTH_TICKS: f64 = 10.0;
/// An echo that comes after a dive of more metres than this without any, and after more than so many of the sounder's periods, has to
/// follow a rise.
const UNHEARD_M: f64 = 1.0;
const SILENT_PERIODS: f64 = 3.0;
/// The period is the longest of late: with each echo it counts for this share of what it did.
const FORGETS: f64 = 0.9;
/// A sounder sits no higher above the bottom than this, m, when the vehicle lies on it.
const LYING_M: f64 = 1.0;

/// What is known of the echoes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sounding {
    depth: Option<f64>,
    echo: Option<Echo>,
    /// The altitude without most of its scatter, m, and when it was taken.
    smooth: Option<(f64, u64)>,
    dive: Option<Dive>,
    /// While it is not believed, what it tells of a rise.
    disbelieved: Option<Line>,
    event: Option<EchoState>,
}

/// The last echo: when it came, the least depth of the vehicle since, m, and the ticks from one echo to the next.
#[derive(Clone, Copy, Debug)]
struct Echo {
    tick: u64,
    shallowest: f64,
    period: Option<f64>,
}

/// A dive under way: what is told in all of it, and since it was looked at last.
#[derive(Clone, Copy, Debug)]
struct Dive {
    whole: Line,
    recent: Line,
}

/// What is told of the echoes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum EchoState {
    NoLess(f64),
    Unheard(f64),
    Lying(f64),
    Follows(f64),
}

impl Sounding {
    /// Takes in a depth that is believed.
    pub fn dive(&mut self, depth: f64) {
        self.depth = Some(depth);
        if let Some(echo) = &mut self.echo {
            echo.shallowest = echo.shallowest.min(depth);
        }
    }

    /// Whether an altitude can be an echo, `command` being what the vehicle follows, which may lie on the bottom.
    pub fn believes(&mut self, tick: u64, altitude: f64, command: Option<&Command>, aground: bool) -> bool {
        let Some(depth) = self.depth.filter(|_| altitude.is_finite()) else { return true };
        let unheard = self.hear(tick, depth);
        let event = if let Some(line) = &mut self.disbelieved {
            line.rise(tick, depth, altitude).then_some(EchoState::Follows(line.from - depth))
        } else if aground && altitude > LYING_M {
            Some(EchoState::Lying(altitude))
        } else if let Some(dived) = unheard {
            Some(EchoState::Unheard(dived))
        } else {
            let dives = self.dives(tick, depth, altitude, command);
            self.dive = self.dive.filter(|_| dives);
            dives.then(|| self.follow(tick, depth, altitude)).flatten().map(EchoState::NoLess)
        };
        self.event = self.event.or(event);
        match event {
            Some(EchoState::Follows(_)) => self.disbelieved = None,
            Some(_) => (self.dive, self.disbelieved) = (None, Some(Line::begin(tick, depth, altitude))),
            None => {}
        }
        self.disbelieved.is_none()
    }

    /// Takes in that there is an echo, and gives how far the vehicle has dived without one, if that was long: one that is late may tell of any
    /// depth since the last, and tells of too much water below where that was less than now.
    fn hear(&mut self, tick: u64, depth: f64) -> Option<f64> {
        let now = Echo { tick, shallowest: depth, period: None };
        let before = self.echo.replace(now)?;
        let gap = tick.saturating_sub(before.tick) as f64;
        let dived = depth - before.shallowest;
        let was_silent = before.period.is_some_and(|period| gap > SILENT_PERIODS * period);
        let period = before.period.map_or(gap, |period| if was_silent { period } else { gap.max(FORGETS * period) });
        self.echo = Some(Echo { period: Some(period), ..now });
        (was_silent && dived > UNHEARD_M).then_some(dived)
    }

    /// Whether the vehicle is told to go deeper than it is.
    fn dives(&mut self, tick: u64, depth: f64, altitude: f64, command: Option<&Command>) -> bool {
        let smooth = self.smooth.map_or(altitude, |(smooth, before)| {
            smooth + (altitude - smooth) * (tick.saturating_sub(before) as f64 / SMOOTH_TICKS).min(1.0)
        });
        self.smooth = Some((smooth, tick));
        match command.map(|command| command.vertical) {
            Some(Vertical::Depth(goal)) => goal - depth > KEEPS_M,
            Some(Vertical::Altitude(goal)) => smooth - goal > KEEPS_M,
            None => false,
        }
    }

    /// Takes in what is told in a dive, and gives how deep it was if the altitude did not follow it.
    fn follow(&mut self, tick: u64, depth: f64, altitude: f64) -> Option<f64> {
        let Some(dive) = self.dive.as_mut().filter(|dive| dive.recent.goes_on(tick) && depth >= dive.whole.from) else {
            let line = Line::begin(tick, depth, altitude);
            self.dive = Some(Dive { whole: line, recent: line });
            return None;
        };
        dive.whole.add(depth, altitude);
        dive.recent.add(depth, altitude);
        let dived = depth - dive.recent.from;
        if dived < DIVE_M || !dive.recent.is_known() && dived < LONGER * DIVE_M {
            return None;
        }
        let share = dive.recent.share().min(dive.whole.share());
        // What follows is looked at anew: it may fail in the middle of a dive.
        dive.recent = Line::begin(tick, depth, altitude);
        (share < FOLLOWS_SHARE).then_some(dived)
    }

    /// What is to be told of it, since this was last asked.
    pub fn take_event(&mut self) -> Option<String> {
        self.event.take().map(|event| match event {
            EchoState::NoLess(dived) => format!("rejected: altitude, no less after a dive of {dived:.1} m"),
            EchoState::Unheard(dived) => format!("rejected: altitude, silent in a dive of {dived:.1} m"),
            EchoState::Lying(altitude) => format!("rejected: altitude, {altitude:.1} m of a vehicle on the bottom"),
            EchoState::Follows(risen) => format!("believed: altitude, grows in a rise of {risen:.1} m"),
        })
    }
}

/// The straight line through altitudes over depths, by least squares.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// When, and how deep, it begins.
    since: u64,
    from: f64,
    count: f64,
    /// Means, and sums of the products of what differs from them: of depths, of altitudes, of both.
    depth: f64,
    altitude: f64,
    depths: f64,
    altitudes: f64,
    both: f64,
}

impl Line {
    fn begin(since: u64, depth: f64, altitude: f64) -> Self {
        Line { since, from: depth, count: 1.0, depth, altitude, depths: 0.0, altitudes: 0.0, both: 0.0 }
    }

    fn add(&mut self, depth: f64, altitude: f64) {
        self.count += 1.0;
        let (of_depth, of_altitude) = (depth - self.depth, altitude - self.altitude);
        self.depth += of_depth / self.count;
        self.altitude += of_altitude / self.count;
        self.depths += of_depth * (depth - self.depth);
        self.altitudes += of_altitude * (altitude - self.altitude);
        self.both += of_depth * (altitude - self.altitude);
    }

    fn goes_on(&self, tick: u64) -> bool {
        tick <= self.since + SLOW_TICKS
    }

    /// The share of a change of depth that the altitude follows.
    fn share(&self) -> f64 {
        if self.depths > 0.0 { -self.both / self.depths } else { 0.0 }
    }

    /// The standard error of that.
    fn error(&self) -> f64 {
        if self.count < 3.0 || self.depths <= 0.0 {
            return f64::INFINITY;
        }
        let rest = (self.altitudes - self.both * self.both / self.depths).max(0.0);
        (rest / (self.count - 2.0) / self.depths).sqrt()
    }

    fn is_known(&self) -> bool {
        self.error() <= ERROR_MAX
    }

    /// Takes in what is told in a rise, which begins anew where it goes deeper: whether the altitude has followed it.
    fn rise(&mut self, tick: u64, depth: f64, altitude: f64) -> bool {
        if depth > self.from || !self.goes_on(tick) {
            *self = Line::begin(tick, depth, altitude);
            return false;
        }
        self.add(depth, altitude);
        let risen = self.from - depth;
        let is_up = depth <= SURFACE_M && risen >= RISE_TO_SURFACE_M;
        if risen < RISE_M && !is_up || !self.is_known() && risen < LONGER * RISE_M {
            return false;
        }
        let share = self.share();
        let follows = share >= REGAINS_SHARE && share - CHANCE_ERRORS * self.error() >= FOLLOWS_SHARE;
        if !follows {
            *self = Line::begin(tick, depth, altitude);
        }
        follows
    }
}

#[cfg(test)]
mod tests;
