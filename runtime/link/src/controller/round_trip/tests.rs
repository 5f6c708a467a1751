//! A link in numbers: what is under way on it, and the round trip as it is beside the round trip as it is measured.

use super::*;

fn at(tick: u64) -> Moment {
    Moment { tick, host: Duration::ZERO }
}

/// A generator for tests (SplitMix64).
struct Chance(u64);

impl Chance {
    fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.draw() % n
    }

    fn happens(&mut self, percent: u64) -> bool {
        self.below(100) < percent
    }
}

/// One direction of a link. Nothing overtakes; what is lost never arrives, and what is repeated arrives twice.
struct Way<T> {
    under_way: VecDeque<(u64, T)>,
    last_due: u64,
    lost: u64,
    repeated: u64,
}

impl<T: Clone> Way<T> {
    fn new(lost: u64, repeated: u64) -> Self {
        Way { under_way: VecDeque::new(), last_due: 0, lost, repeated }
    }

    fn send(&mut self, what: T, now: u64, delay: u64, chance: &mut Chance) {
        self.last_due = self.last_due.max(now + delay);
        if !chance.happens(self.lost) {
            self.under_way.push_back((self.last_due, what.clone()));
        }
        if chance.happens(self.repeated) {
            self.under_way.push_back((self.last_due, what));
        }
    }

    fn arrived(&mut self, now: u64) -> Vec<T> {
        let count = self.under_way.iter().take_while(|(due, _)| *due <= now).count();
        self.under_way.drain(..count).map(|(_, what)| what).collect()
    }
}

struct Link {
    lost: u64,
    repeated: u64,
    /// The vehicle echoes what it hears, and shows what it holds.
    echoes: bool,
    shows: bool,
}

const SOUND: Link = Link { lost: 0, repeated: 0, echoes: true, shows: true };

/// What is measured, and what is so, in each tick: the age of the newest moment of ours of which the vehicle tells.
fn measured(
    link: &Link,
    seed: u64,
    ticks: u64,
    delay: impl Fn(u64) -> (u64, u64),
    course: impl Fn(u64) -> f64,
) -> Vec<(u64, u64)> {
    let mut chance = Chance(seed);
    let mut trip = RoundTrip::new(1.0);
    // Beside the goals a moment goes over the link in each tick, which is never lost: it tells what is so.
    let (mut there, mut back) = (Way::new(link.lost, link.repeated), Way::new(link.lost, link.repeated));
    let (mut moments, mut told) = (Way::new(0, 0), Way::new(0, 0));
    let (mut held, mut newest, mut known, mut spoke) = (mark(200.0), 0, 0, (Heading::NORTH, 0));
    trip.reported(held, GoalSource::State, at(0));
    (1..=ticks)
        .map(|now| {
            let (to, from) = delay(now);
            for heading in there.arrived(now) {
                held = heading;
                if link.echoes {
                    back.send((heading, GoalSource::Echo), now, from, &mut chance);
                }
            }
            newest = moments.arrived(now).last().copied().unwrap_or(newest);
            if link.shows {
                back.send((held, GoalSource::State), now, from, &mut chance);
            }
            // A state that comes twice is of no new tick, and told nobody.
            told.send(newest, now, from, &mut chance);
            back.last_due = back.last_due.max(told.last_due);
            told.last_due = back.last_due;
            back.arrived(now).into_iter().for_each(|(heading, by)| trip.reported(heading, by, at(now)));
            known = told.arrived(now).last().copied().unwrap_or(known);
            let measured = trip.ticks(at(now));
            let heading = trip.marked(Heading::from_degrees(course(now)), at(now));
            // A goal that changes is sent in the tick or the two after it, and twice a second anyway.
            let changes = Mark::of(heading) != Mark::of(spoke.0) && chance.happens(60);
            if changes || now - spoke.1 >= 5 {
                spoke = (heading, now);
                trip.sent(heading, at(now));
                there.send(heading, now, to, &mut chance);
                moments.last_due = moments.last_due.max(there.last_due);
            }
            moments.send(now, now, to, &mut chance);
            there.last_due = moments.last_due;
            (measured, now - known)
        })
        .collect()
}

/// How a course goes on: straight, turning, weaving, and trembling.
fn courses() -> [fn(u64) -> f64; 4] {
    [
        |_| 90.0,
        |tick| tick as f64 % 360.0,
        |tick| if tick / 20 % 2 == 0 { 10.0 } else { 11.0 },
        |tick| 359.9 + (tick * 7919 % 7) as f64 / 10.0,
    ]
}

#[test]
fn a_constant_delay_is_known_once_it_has_passed_and_never_taken_for_less() {
    for course in courses() {
        for (to, from) in [(0, 1), (1, 2), (7, 0), (0, 20), (50, 50), (250, 0)] {
            let measured = measured(&SOUND, 1, 1500, |_| (to, from), course);
            let settled = &measured[(to + from + 25) as usize..];
            for (measured, so) in settled {
                assert!((*so..=so + 15).contains(measured), "{to} + {from}, {}: {measured}, {so}", course(7));
            }
        }
    }
}

/// Never shorter: what comes back was heard. Between two marks the link may become slower.
#[test]
fn on_no_link_is_the_round_trip_taken_for_shorter_than_it_is_for_longer_than_until_the_next_mark() {
    for seed in 0..300 {
        let mut chance = Chance(seed * 77);
        let (lost, repeated) = ([0, 5, 30][chance.below(3) as usize], [0, 30, 100][chance.below(3) as usize]);
        let (shows, echoes) = [(true, true), (true, false), (false, true)][chance.below(3) as usize];
        let link = Link { lost, repeated, echoes, shows };
        let (most, period, shift) = (1 + chance.below(80), 1 + chance.below(200), chance.below(200));
        // Grows, falls back, and grows again, in each direction at other times.
        let delay = |tick: u64| {
            (tick % period * most / period, (tick + shift) / 50 % 2 * (most / 2) + Chance(tick).below(1 + most / 4))
        };
        let course = courses()[chance.below(4) as usize];
        for (tick, (measured, so)) in measured(&link, seed, 1500, delay, course).into_iter().enumerate() {
            let until_next = measured.max(MARK_TICKS) + 6;
            assert!(so <= measured + until_next, "seed {seed}, tick {tick}: {so} is taken for {measured}");
        }
    }
}

#[test]
fn a_link_without_delay_is_never_taken_for_a_slow_one() {
    for seed in 0..100 {
        let link = Link { lost: seed % 5, repeated: seed % 3 * 50, ..SOUND };
        for course in courses() {
            let measured = measured(&link, seed, 1500, |_| (0, 1), course);
            assert!(measured.iter().all(|(ticks, _)| *ticks <= 20), "seed {seed}: {:?}", measured.iter().max());
        }
    }
}

#[test]
fn nothing_that_comes_back_is_a_round_trip_that_grows() {
    let deaf = Link { shows: false, echoes: false, ..SOUND };
    assert!(measured(&deaf, 1, 500, |_| (0, 0), |_| 90.0).last().is_some_and(|(ticks, _)| *ticks > 490));
}

fn mark(degrees: f64) -> Heading {
    Heading::from_degrees(degrees)
}

#[test]
fn the_longer_of_the_two_clocks_counts() {
    let mut trip = RoundTrip::new(1.0);
    trip.sent(mark(5.0), at(100));
    trip.reported(mark(5.0), GoalSource::State, Moment { tick: 103, host: Duration::from_millis(10_200) });
    assert_eq!(trip.ticks(at(103)), 102, "the vehicle's clock runs slow");
    trip.sent(mark(6.0), Moment { tick: 110, host: Duration::from_secs(20) });
    trip.reported(mark(6.0), GoalSource::State, Moment { tick: 150, host: Duration::from_secs(21) });
    assert_eq!(trip.ticks(at(150)), 40);
    let mut slow = RoundTrip::new(0.1);
    slow.sent(mark(5.0), at(0));
    slow.reported(mark(5.0), GoalSource::Echo, Moment { tick: 1, host: Duration::from_secs(3) });
    assert_eq!(slow.ticks(at(1)), 3, "3 s of the host's are 0.3 s of the vehicle's");
}

#[test]
fn what_the_vehicle_tells_anyway_proves_nothing() {
    let mut trip = RoundTrip::new(1.0);
    trip.reported(mark(90.0), GoalSource::State, at(1));
    assert_eq!(Mark::of(trip.marked(mark(90.0), at(1))), Mark(901), "that can be told from what it holds");
    trip.sent(mark(90.1), at(1));
    for (tick, told) in [(2, 90.0), (3, 200.0), (4, 90.0)] {
        trip.reported(mark(told), GoalSource::State, at(tick));
    }
    assert_eq!(trip.ticks(at(40)), 39);
    for (tick, goal) in [(50, 80.0), (60, 90.1)] {
        trip.sent(mark(goal), at(tick));
    }
    trip.reported(mark(90.1), GoalSource::State, at(61));
    assert_eq!(trip.ticks(at(61)), 60, "the first of the two, as far as anybody knows");
}

/// What is measured at last of a vehicle that echoes at once, and whose states are so many ticks late; for some time it holds a heading of
/// its own, and does not live at all.
fn of_late_states(late: impl Fn(u64) -> u64, protects: impl Fn(u64) -> bool, stops: impl Fn(u64) -> bool) -> Vec<u64> {
    let mut trip = RoundTrip::new(1.0);
    let (mut held, mut stamp, mut told) = (mark(200.0), 0, 0);
    let mut states = VecDeque::new();
    (1..=1800)
        .map(|now| {
            if !stops(now) {
                stamp += 1;
                states.push_back((now + late(now), stamp, if protects(now) { mark(200.0) } else { held }));
            }
            let moment = |tick: u64| Moment { tick, host: Duration::from_millis(100 * now) };
            while let Some((_, stamp, heading)) = states.pop_front_if(|(due, ..)| *due <= now) {
                told = stamp;
                trip.reported(heading, GoalSource::State, moment(told));
            }
            let heading = trip.marked(mark(90.0), moment(told));
            trip.sent(heading, moment(told));
            if !stops(now) {
                held = heading;
                trip.reported(held, GoalSource::Echo, moment(told));
            }
            trip.ticks(moment(told))
        })
        .collect()
}

#[test]
fn states_that_grow_old_count_however_soon_an_echo_comes() {
    let never = |_: u64| false;
    let late = of_late_states(|now| now.saturating_sub(300) / 10, never, never);
    for (now, measured) in (0..).zip(&late).skip(400) {
        let so = (now - 300) / 11;
        assert!((so..=so + 15).contains(measured), "{now}: {measured}, {so}");
    }
    let recovered = of_late_states(|now| if now < 900 { now.saturating_sub(300).min(120) } else { 0 }, never, never);
    // Nothing overtakes: what was late goes before.
    assert!(recovered[899] >= 110 && recovered[1040] <= 15, "{} and {}", recovered[899], recovered[1040]);
}

#[test]
fn a_vehicle_that_protects_itself_or_stood_still_is_not_late() {
    let protects = of_late_states(|_| 1, |now| now > 300, |_| false);
    assert!(protects.iter().all(|measured| *measured <= 15), "{:?}", protects.iter().max());
    let stood = of_late_states(|_| 1, |now| now > 600, |now| (300..330).contains(&now));
    assert!(stood[350..].iter().all(|measured| *measured <= 15), "{:?}", stood[350..].iter().max());
}

/// The attack: a modem at this end echoed what it was to send, and the way up grew to half a minute unseen.
#[test]
fn an_echo_at_this_end_of_the_line_hides_no_delay_of_it() {
    let mut trip = RoundTrip::new(1.0);
    let mut way_up = std::collections::VecDeque::new();
    for tick in 0..400 {
        let now = at(tick);
        let heading = trip.marked(Heading::from_degrees(90.0), now);
        trip.sent(heading, now);
        trip.reported(heading, GoalSource::Echo, now);
        way_up.push_back(heading);
        // From tick 100 on each comes two ticks later than the one before.
        if tick < 100 || tick % 3 == 0 {
            trip.reported(way_up.pop_front().unwrap(), GoalSource::State, now);
        }
        let late = way_up.len() as u64;
        assert!(trip.ticks(now) + 2 * MARK_TICKS >= late, "{} of {late} in tick {tick}", trip.ticks(now));
    }
    assert!(way_up.len() > 190);
}

/// The attack: one state in a second and a half said that the mission stands still, and each began the waiting anew.
#[test]
fn a_vehicle_that_stands_us_still_now_and_then_hides_no_delay() {
    let mut trip = RoundTrip::new(1.0);
    let mut way_there = VecDeque::new();
    let mut held = mark(200.0);
    for tick in 0..600 {
        let now = at(tick);
        let late = tick.saturating_sub(100) / 2;
        while way_there.pop_front_if(|(due, _)| *due <= tick).is_some_and(|(_, heading)| {
            held = heading;
            true
        }) {}
        trip.reported(held, GoalSource::State, now);
        if tick % 15 == 0 {
            trip.pause(now);
            continue;
        }
        let heading = trip.marked(Heading::from_degrees(90.0), now);
        trip.sent(heading, now);
        way_there.push_back((tick + late, heading));
        // What is held now was said so long ago; nothing is waited while it stands still.
        let so = late.min(tick.saturating_sub(100) / 3);
        assert!(trip.ticks(now) * 15 / 14 + 2 * MARK_TICKS >= so, "{} of {so} in tick {tick}", trip.ticks(now));
    }
}

/// What it was told before it stood still may never come back, and is not waited for all that time.
#[test]
fn a_vehicle_that_stood_still_is_not_late() {
    let mut trip = RoundTrip::new(1.0);
    for tick in 0..900 {
        let now = at(tick);
        if (300..600).contains(&tick) {
            trip.reported(mark(200.0), GoalSource::State, now);
            trip.pause(now);
        } else {
            let heading = trip.marked(Heading::from_degrees(90.0), now);
            trip.sent(heading, now);
            // The last before it stood still was not heard.
            if tick != 299 {
                trip.reported(heading, GoalSource::State, now);
            }
        }
        assert!(trip.ticks(now) <= 2, "{} in tick {tick}", trip.ticks(now));
    }
}
