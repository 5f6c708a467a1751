//! How long it takes until what was said is known to have been heard: the round trip over the link. What the vehicle says is
//! no older than that beyond its stamp, and what it is told comes no later.
//!
//! What comes back as it was said, on any link on which a vehicle tells what it holds, is the heading goal: in its states, and in
//! the echo of a command where there is one. So its last decimal is a mark: about once a second, when the last mark
//! has come back, another is sent, no more than 0.1 degrees beside the course. A mark that comes back proves that what was sent
//! until then was heard; one that has not come back counts for as long as it has waited.
//!
//! Times are taken in the vehicle's time, by the stamps that are heard, and by the host's clock: the longer one counts.
//!
//! Echoes may be prompt and states late. A state is as old as the host's clock has come to be further ahead of the stamps than it was
//! with a fresh one; but no older than the oldest mark that no state has told, or than the last was that one told. A vehicle that
//! protects itself tells none, one whose clock is slow tells all: neither is late. States that are late from the first on look fresh.

use albacore_geometry::Heading;
use albacore_vehicle::TICK_S;
use std::collections::VecDeque;
use std::time::Duration;

/// Ticks between marks, while they come back.
const MARK_TICKS: u64 = 10;
/// Marks that are remembered; more than wait on any link that can be driven over.
const MARKS_MAX: usize = 256;
/// What comes may be so old while no round trip is known, ticks: 2 s. Over a longer one no mission drives, unless it says so.
const UNDER_WAY_TICKS: u64 = 20;
/// Tenths of a degree in a turn.
const TURN: u16 = 3600;

/// A moment, by both clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moment {
    /// The last tick of the vehicle's time that was heard.
    pub tick: u64,
    /// The host's time.
    pub host: Duration,
}

/// Where the vehicle tells a heading goal.
#[derive(Clone, Copy, Debug)]
pub enum GoalSource {
    /// In a state: it holds it.
    State,
    /// In the echo of a command: it has heard it, whether it holds it or protects itself.
    Echo,
}

/// A heading goal as it stands on the wire, tenths of a degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Mark(u16);

impl Mark {
    fn of(heading: Heading) -> Self {
        Mark((heading.degrees() * 10.0).round() as u16 % TURN)
    }

    fn heading(self) -> Heading {
        Heading::from_degrees(f64::from(self.0) / 10.0)
    }

    /// The three that are no further from a course than 0.1 degrees and what rounding makes, the nearest first.
    fn beside(course: Heading) -> [Self; 3] {
        let Mark(nearest) = Mark::of(course);
        [0, 1, TURN - 1].map(|beside| Mark((nearest + beside) % TURN))
    }
}

/// What has come back in one way.
#[derive(Clone, Copy, Debug, Default)]
struct Back {
    /// What was told last.
    last: Option<Mark>,
    /// So many of the marks that were sent were told, or were sent before one that was.
    heard: usize,
    /// The time that the newest of these took, ticks.
    took: u64,
}

/// Measures round trips.
#[derive(Clone, Debug)]
pub struct RoundTrip {
    rate: f64,
    /// The mark that is asked for.
    mark: Option<Mark>,
    /// Each that was sent, and when first, oldest first; later by all the time in which nothing was commanded since.
    sent: VecDeque<(Mark, Moment)>,
    /// Since when nothing is commanded.
    paused: Option<Moment>,
    /// What has come back, by where the vehicle told it: the one way may be ahead of the other.
    back: [Back; 2],
    /// The time that the newest took that has come back, ticks.
    last: u64,
    /// By how much the host's clock is ahead of the stamp of a state that has just been made, ticks, as far as it is known.
    ahead: Option<i64>,
    /// The least time that a mark took that a state told, ticks: of what `ahead` is, so much at most is the way to the host.
    quickest: Option<u64>,
}

impl RoundTrip {
    /// For a vehicle that runs so many times faster than real time.
    pub fn new(rate: f64) -> Self {
        RoundTrip {
            rate,
            mark: None,
            sent: VecDeque::new(),
            paused: None,
            back: Default::default(),
            last: 0,
            ahead: None,
            quickest: None,
        }
    }

    /// A new override: what was measured before it tells nothing.
    pub fn begin(&mut self) {
        (self.mark, self.paused, self.last) = (None, None, 0);
        self.sent.clear();
        self.back.iter_mut().for_each(|back| (back.heard, back.took) = (0, 0));
    }

    /// Nothing is commanded for a while. What was sent may never come back, so that this time is not waited; but it goes on to wait
    /// when commands go on, else a vehicle that stands us still now and then would hide how long it takes.
    pub fn pause(&mut self, now: Moment) {
        self.mark = None;
        self.paused.get_or_insert(now);
    }

    /// Commands go on.
    fn resume(&mut self, now: Moment) {
        let Some(since) = self.paused.take() else { return };
        for (_, when) in &mut self.sent {
            when.tick += now.tick.saturating_sub(since.tick);
            when.host += now.host.saturating_sub(since.host);
        }
    }

    /// What was said in this moment was not sent.
    pub fn take_back(&mut self, now: Moment) {
        self.mark = None;
        while self.sent.back().is_some_and(|(_, when)| when.tick >= now.tick) {
            self.sent.pop_back();
        }
        self.back.iter_mut().for_each(|back| back.heard = back.heard.min(self.sent.len()));
    }

    /// The heading goal to send for a course.
    pub fn marked(&mut self, course: Heading, now: Moment) -> Heading {
        self.resume(now);
        let beside = Mark::beside(course);
        if let Some(mark) = self.mark.filter(|mark| beside.contains(mark) && self.is_good(*mark, now)) {
            return mark.heading();
        }
        let newest = self.sent.back().map(|(mark, _)| *mark);
        // One that was sent a while ago is the least likely to come back late.
        let mark = (beside.into_iter())
            .filter(|mark| !self.is_reported(*mark) && newest != Some(*mark))
            .min_by_key(|mark| self.sent.iter().rposition(|(sent, _)| sent == mark).map_or(0, |at| at + 1))
            .unwrap_or(beside[0]);
        self.mark = Some(mark);
        mark.heading()
    }

    /// Whether a mark is still the one to ask for: it was not sent, or is waited for, or came back less than a second after it
    /// was sent. One that the vehicle tells anyway can't come back.
    fn is_good(&self, mark: Mark, now: Moment) -> bool {
        match self.sent.back().filter(|(sent, _)| *sent == mark) {
            Some((_, when)) if self.heard() == self.sent.len() => self.between(*when, now) < MARK_TICKS,
            _ => !self.is_reported(mark),
        }
    }

    fn is_reported(&self, mark: Mark) -> bool {
        self.back.iter().any(|back| back.last == Some(mark))
    }

    /// So many of the marks that were sent are known to have been heard.
    fn heard(&self) -> usize {
        self.back.iter().map(|back| back.heard).max().unwrap_or(0)
    }

    /// A heading goal was sent.
    pub fn sent(&mut self, heading: Heading, now: Moment) {
        let mark = Mark::of(heading);
        if self.sent.back().is_some_and(|(newest, _)| *newest == mark) {
            return;
        }
        if self.sent.len() == MARKS_MAX {
            // Where nothing has come back, the oldest tells for how long.
            if self.heard() == 0 {
                return;
            }
            self.sent.pop_front();
            self.back.iter_mut().for_each(|back| back.heard = back.heard.saturating_sub(1));
        }
        self.sent.push_back((mark, now));
    }

    /// The vehicle has told a heading goal. What it told before as well tells nothing; of those that were sent alike it may be the
    /// oldest.
    pub fn reported(&mut self, heading: Heading, by: GoalSource, now: Moment) {
        if let GoalSource::State = by {
            let ahead = self.ahead_of(now);
            self.ahead = Some(self.ahead.map_or(ahead, |least| least.min(ahead)));
        }
        let (mark, known) = (Mark::of(heading), self.heard());
        let back = &mut self.back[by as usize];
        if back.last.replace(mark) == Some(mark) {
            return;
        }
        let waiting = self.sent.iter().enumerate().skip(back.heard);
        let Some((at, (_, when))) = { waiting }.find(|(_, (sent, _))| *sent == mark) else { return };
        let took = self.between(*when, self.paused.unwrap_or(now));
        self.back[by as usize] = Back { last: Some(mark), heard: at + 1, took };
        if at >= known {
            self.last = took;
        }
        if let GoalSource::State = by {
            // It was made when the mark had been heard.
            let fresh = self.ahead_of(now) - took as i64;
            self.quickest = Some(self.quickest.map_or(took, |least| least.min(took)));
            self.ahead = self.ahead.map(|ahead| ahead.max(fresh));
        }
    }

    /// The round trip, as far as it is known, in ticks; a mark that has not come back counts for as long as it has waited, and a state
    /// that is older for its age.
    pub fn ticks(&self, now: Moment) -> u64 {
        self.waits(now).max(self.last).max(self.state_age(now))
    }

    /// How old the last state is, ticks.
    fn state_age(&self, now: Moment) -> u64 {
        let Back { heard, took, .. } = self.back[GoalSource::State as usize];
        let age = self.ahead.map_or(0, |ahead| self.ahead_of(now) - ahead);
        self.since(heard, now).max(took).min(age.max(0) as u64)
    }

    /// Whether a state with this stamp was made after a time of the host's clock, as far as the two clocks are known. What comes through
    /// a buffer after a pause is older than it looks, and all by a link's delay, which is no more than the quickest round trip.
    pub fn made_after(&self, tick: u64, host: Duration) -> bool {
        let Some(ahead) = self.ahead else { return false };
        let under_way = self.quickest.unwrap_or(UNDER_WAY_TICKS) as i64;
        tick as i64 + ahead - under_way >= host_ticks(host, self.rate) as i64
    }

    /// By how much the host's clock is ahead of the stamps, ticks.
    fn ahead_of(&self, now: Moment) -> i64 {
        host_ticks(now.host, self.rate) as i64 - now.tick as i64
    }

    /// For so many ticks the oldest mark that has not come back has waited.
    pub fn waits(&self, now: Moment) -> u64 {
        self.since(self.heard(), now).max(self.held_up(now))
    }

    /// For so many ticks a state tells an older mark than it was sent since: it has not heard that one, whatever an echo says, for that may
    /// come from this end of the line. One that tells no mark of ours may protect itself.
    fn held_up(&self, now: Moment) -> u64 {
        let Back { last, heard, .. } = self.back[GoalSource::State as usize];
        let told = heard.checked_sub(1).and_then(|newest| self.sent.get(newest));
        if told.is_some_and(|(mark, _)| last == Some(*mark)) { self.since(heard, now) } else { 0 }
    }

    /// The ticks since one of the marks was sent, if it was.
    fn since(&self, mark: usize, now: Moment) -> u64 {
        self.sent.get(mark).map_or(0, |(_, when)| self.between(*when, self.paused.unwrap_or(now)))
    }

    /// The ticks from one moment to another, by the clock that counts more.
    pub fn between(&self, from: Moment, to: Moment) -> u64 {
        let by_host = host_ticks(to.host.saturating_sub(from.host), self.rate);
        by_host.max(to.tick.saturating_sub(from.tick))
    }
}

/// So much of the host's time in ticks of a vehicle's that runs so many times faster than real time. One that may run faster
/// need not, for its computer may be busy: the host's clock then counts as in real time, and the vehicle's stamps tell the rest.
pub fn host_ticks(time: Duration, rate: f64) -> u64 {
    // A part of a tick is one, but what floating point makes of a whole one is not.
    (time.as_secs_f64() * rate.min(1.0) / TICK_S - 1e-6).ceil() as u64
}

#[cfg(test)]
mod tests;
