//! How long it takes until what was said is known to have been heard: the round trip over the link. What the vehicle says is
//! no older than that beyond its stamp, and what it is told comes no later.
//!
//! Two things tell it. A question that every vehicle can answer (`#v`) is asked about once a second; its answers have no
//! numbers, and belong to the questions in their order. And a goal that has changed stands in `#S` once the vehicle holds it.
//! Times are taken in the vehicle's time, by the stamps that are heard, and by the host's clock: the longer one counts.

use super::message::ToVehicle;
use albacore_geometry::Heading;
use albacore_vehicle::TICK_S;
use std::collections::VecDeque;
use std::time::Duration;

/// Ticks between questions, while they are answered.
const ASK_TICKS: u64 = 10;
/// ... and while one is not: a line may be lost.
const AGAIN_TICKS: u64 = 5;
/// Questions that wait for an answer.
const WAITING_MAX: usize = 64;
/// What a goal has told counts for so many ticks.
const COUNTS_TICKS: u64 = 50;
/// Goals that the vehicle has not shown yet, each of which is another than the one before.
const GOALS_MAX: usize = 256;

/// A moment, by both clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// The last tick of the vehicle's time that was heard.
    pub tick: u64,
    /// The host's time.
    pub host: Duration,
}

/// Measures round trips.
#[derive(Clone, Debug)]
pub struct RoundTrip {
    rate: f64,
    /// When each question was asked that has no answer yet.
    asked: VecDeque<Moment>,
    last_asked: Option<u64>,
    /// Some of them were answered: the others are on their way, or lost.
    some_answered: bool,
    /// What the last answer told, ticks.
    by_answer: Option<u64>,
    headings: Shown,
    depths: Shown,
    /// What the last goal told, ticks, and when.
    by_goal: Option<(u64, Moment)>,
}

impl RoundTrip {
    /// For a vehicle that runs so many times faster than real time.
    pub fn new(rate: f64) -> Self {
        RoundTrip {
            rate,
            asked: VecDeque::new(),
            last_asked: None,
            some_answered: false,
            by_answer: None,
            headings: Shown::default(),
            depths: Shown::default(),
            by_goal: None,
        }
    }

    /// A new override: what was asked before it tells nothing. The first goals go before the first question.
    pub fn begin(&mut self, now: Moment) {
        *self = RoundTrip { last_asked: Some(now.tick), ..RoundTrip::new(self.rate) };
    }

    /// Whether it is time for a question.
    pub fn is_due(&mut self, now: Moment) -> bool {
        let Some(last) = self.last_asked else { return true };
        let waited = now.tick.saturating_sub(last);
        // The rest of the answers should have come as soon as the first did: they are lost.
        if self.some_answered && waited > self.by_answer.unwrap_or(0) + AGAIN_TICKS {
            self.asked.clear();
            self.some_answered = false;
        }
        match self.asked.is_empty() {
            true => waited >= ASK_TICKS,
            false => !self.some_answered && waited >= AGAIN_TICKS && self.asked.len() < WAITING_MAX,
        }
    }

    /// A question was asked.
    pub fn ask(&mut self, now: Moment) {
        self.last_asked = Some(now.tick);
        self.asked.push_back(now);
    }

    /// An answer has come. One that nobody waits for is no answer.
    pub fn answered(&mut self, now: Moment) {
        let Some(asked) = self.asked.pop_front() else { return };
        self.by_answer = Some(self.between(asked, now));
        self.some_answered = !self.asked.is_empty();
    }

    /// A goal was sent.
    pub fn sent(&mut self, goal: &ToVehicle, now: Moment) {
        match goal {
            ToVehicle::Heading(_) => self.headings.sent(goal.to_string(), now),
            ToVehicle::Depth(_) => self.depths.sent(goal.to_string(), now),
            _ => {}
        }
    }

    /// The vehicle has said what it holds.
    pub fn shown(&mut self, heading: Heading, depth: f64, now: Moment) {
        let heading = self.headings.shown(&ToVehicle::Heading(heading).to_string());
        let depth = self.depths.shown(&ToVehicle::Depth(depth).to_string());
        // The two may tell of different moments: the longer way counts.
        if let Some(ticks) = [heading, depth].into_iter().flatten().map(|sent| self.between(sent, now)).max() {
            self.by_goal = Some((ticks, now));
        }
    }

    /// The round trip, as far as it is known, in ticks; a question without an answer counts for as long as it has waited.
    pub fn ticks(&self, now: Moment) -> u64 {
        let by_goal = self.by_goal.filter(|(_, when)| now.tick.saturating_sub(when.tick) <= COUNTS_TICKS);
        // Who has never answered a question may not know it, but shows by a goal that it hears us.
        let hears = |asked: &Moment| {
            self.by_answer.is_none() && self.by_goal.is_some_and(|(_, when)| when.tick > asked.tick.max(AGAIN_TICKS))
        };
        let waits = self.asked.front().filter(|_| !self.some_answered).filter(|asked| !hears(asked));
        let of_wait = waits.map_or(0, |asked| self.between(*asked, now));
        of_wait.max(self.by_answer.unwrap_or(0)).max(by_goal.map_or(0, |(ticks, _)| ticks))
    }

    fn between(&self, from: Moment, to: Moment) -> u64 {
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

/// Goals of one kind, on their way to the vehicle and back.
#[derive(Clone, Debug, Default)]
struct Shown {
    /// What was sent, oldest first, each when it was sent first.
    sent: VecDeque<(String, Moment)>,
    /// What the vehicle has shown last.
    last: String,
}

impl Shown {
    fn sent(&mut self, goal: String, now: Moment) {
        if self.sent.back().map_or(&self.last, |(last, _)| last) == &goal {
            return;
        }
        if self.sent.len() == GOALS_MAX {
            self.sent.pop_front();
        }
        self.sent.push_back((goal, now));
    }

    /// When that was sent which the vehicle shows now for the first time. What was sent twice, or is what it held anyway, tells
    /// nothing.
    fn shown(&mut self, goal: &str) -> Option<Moment> {
        let mut same = self.sent.iter().enumerate().filter(|(_, (sent, _))| sent == goal);
        let (Some((at, (_, when))), None) = (same.next(), same.next()) else { return None };
        let when = (self.last != goal).then_some(*when);
        self.sent.drain(..=at);
        goal.clone_into(&mut self.last);
        when
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(tick: u64) -> Moment {
        Moment { tick, host: Duration::ZERO }
    }

    /// A link with so many ticks of delay in all, on which some questions are lost: what is measured in each tick.
    fn measured(delay: u64, ticks: u64, is_lost: impl Fn(u64) -> bool) -> Vec<u64> {
        let mut trip = RoundTrip::new(1.0);
        let (mut answers, mut count) = (VecDeque::new(), 0);
        (0..ticks)
            .map(|tick| {
                while answers.front().is_some_and(|due| *due <= tick) {
                    answers.pop_front();
                    trip.answered(at(tick));
                }
                if trip.is_due(at(tick)) {
                    trip.ask(at(tick));
                    if !is_lost(count) {
                        answers.push_back(tick + delay);
                    }
                    count += 1;
                }
                trip.ticks(at(tick))
            })
            .collect()
    }

    #[test]
    fn a_constant_delay_is_known_once_it_has_passed_and_never_taken_for_less() {
        for delay in [1, 3, 7, 20, 100, 250] {
            let measured = measured(delay, 1000, |_| false);
            let first = delay as usize;
            assert!(measured[first..].iter().all(|ticks| (delay..=delay + 10).contains(ticks)), "{delay}");
            assert!(
                measured[..first].iter().enumerate().all(|(tick, ticks)| *ticks == tick as u64),
                "it waits: {delay}"
            );
        }
    }

    #[test]
    fn a_lost_question_costs_half_a_second() {
        let every = |n: u64| move |count: u64| count % n == n - 1;
        for n in [2, 3, 5, 10] {
            let measured = measured(1, 2000, every(n));
            assert!(measured.iter().all(|ticks| *ticks <= 7), "every {n}th: {:?}", measured.iter().max());
        }
        assert!(measured(1, 300, |count| count < 3).iter().all(|ticks| *ticks <= 17), "three in a row");
    }

    #[test]
    fn no_answer_at_all_is_a_round_trip_that_grows() {
        assert_eq!(measured(1, 500, |_| true).last(), Some(&499));
    }

    #[test]
    fn the_longer_of_the_two_clocks_counts() {
        let mut trip = RoundTrip::new(1.0);
        trip.ask(at(100));
        trip.answered(Moment { tick: 103, host: Duration::from_millis(10_200) });
        assert_eq!(trip.ticks(at(103)), 102, "the vehicle's clock runs slow");
        trip.ask(Moment { tick: 110, host: Duration::from_secs(20) });
        trip.answered(Moment { tick: 150, host: Duration::from_secs(21) });
        assert_eq!(trip.ticks(at(150)), 40);
        let mut slow = RoundTrip::new(0.1);
        slow.ask(at(0));
        slow.answered(Moment { tick: 1, host: Duration::from_secs(3) });
        assert_eq!(slow.ticks(at(1)), 3, "3 s of the host's are 0.3 s of the vehicle's");
    }

    fn heading(degrees: f64) -> ToVehicle {
        ToVehicle::Heading(Heading::from_degrees(degrees))
    }

    #[test]
    fn a_goal_that_the_vehicle_shows_tells_how_long_it_took() {
        let mut trip = RoundTrip::new(1.0);
        let show = |trip: &mut RoundTrip, degrees: f64, tick| {
            trip.shown(Heading::from_degrees(degrees), 3.0, at(tick));
            trip.ticks(at(tick))
        };
        for tick in 0..100 {
            trip.sent(&heading(tick as f64), at(tick));
        }
        assert_eq!(show(&mut trip, 200.0, 100), 0, "nobody has asked for that");
        assert_eq!(show(&mut trip, 7.0, 107), 100);
        assert_eq!(show(&mut trip, 7.0, 130), 100, "that was told");
        assert_eq!(show(&mut trip, 90.0, 131), 41);
        assert_eq!(trip.ticks(at(131 + 51)), 0, "it counts for 5 s");
        for (tick, degrees) in [(200, 10.0), (210, 20.0), (220, 10.0)] {
            trip.sent(&heading(degrees), at(tick));
        }
        assert_eq!(show(&mut trip, 10.0, 230), 0, "the one or the other");
        assert_eq!(show(&mut trip, 20.0, 240), 30);
    }

    #[test]
    fn who_answers_no_question_may_show_by_its_goals_that_it_hears() {
        let mut trip = RoundTrip::new(1.0);
        trip.ask(at(1));
        assert_eq!(trip.ticks(at(60)), 59);
        trip.sent(&heading(5.0), at(60));
        trip.shown(Heading::from_degrees(5.0), 3.0, at(62));
        assert_eq!(trip.ticks(at(70)), 2);
    }
}
