//! A link that lags behind its vehicle, and a vehicle whose clock runs slow: what a mission makes of what it is told of them. The
//! link itself is tested in `runtime/link`; here its word is given by hand.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test whose mission cannot run, or never ends, has failed")]

use albacore_machine::{Event, Machine, Outcome};
use albacore_session::{Plan, Source, load, load_text};
use albacore_vehicle::{Control, Lag, Measurement, Snapshot};
use std::path::Path;

/// A mission under way on a vehicle of which heading and depth are heard in every tick.
struct Mission {
    machine: Machine,
    tick: u64,
    told: Vec<(u64, Event)>,
}

impl Mission {
    fn new(name: &str) -> Self {
        let path = Path::new("tests/link/lag.alb");
        let plan =
            Plan::new(&load(path, None, &[]).unwrap(), &path.display().to_string(), Some(name), Some("calm")).unwrap();
        let measurement = |name: &str| Measurement { name: name.into(), width: 1 };
        let machine = Machine::new(plan.program, &[measurement("heading"), measurement("depth")]).unwrap();
        Mission { machine, tick: 0, told: Vec::new() }
    }

    /// A tick with a round trip in ticks, and so many ticks of the host's clock in one of the vehicle's; the speed commanded.
    fn tick(&mut self, round_trip: u64, host: f64) -> Option<f64> {
        let lag = Lag { round_trip, host: Some((self.tick as f64 * host) as u64) };
        let mut snapshot = Snapshot { control: Control::InControl, lag, ..Snapshot::default() };
        snapshot.push(0, &[0.5]);
        snapshot.push(1, &[4.0]);
        let command = self.machine.step(&snapshot);
        self.told.extend(self.machine.events().iter().map(|event| (self.tick, event.clone())));
        self.tick += 1;
        command.map(|command| command.speed)
    }

    /// Ticks until the mission is over, and how it ended.
    #[track_caller]
    fn end(&mut self, round_trip: u64, host: f64) -> (Outcome, u64) {
        for _ in 0..20_000 {
            self.tick(round_trip, host);
            if let Some(outcome) = self.machine.outcome() {
                return (outcome, self.tick - 1);
            }
        }
        panic!("it never ends: {:?}", self.told);
    }

    fn when(&self, what: impl Fn(&Event) -> bool) -> Vec<u64> {
        self.told.iter().filter(|(_, event)| what(event)).map(|(tick, _)| *tick).collect()
    }

    fn aborted(&self) -> &str {
        let why = self.told.iter().find_map(|(_, event)| match event {
            Event::Aborted(why) => Some(why.as_str()),
            _ => None,
        });
        why.unwrap_or_default()
    }
}

#[test]
fn a_link_that_lags_holds_the_mission_and_lets_it_go_on() {
    let mut mission = Mission::new("plain");
    (0..20).for_each(|_| _ = mission.tick(20, 1.0));
    assert_eq!(mission.tick(20, 1.0), Some(1.5), "2 s are allowed");
    assert_eq!(mission.tick(21, 1.0), Some(0.0), "more are not");
    assert_eq!(mission.tick(90, 1.0), Some(0.0));
    assert_eq!(mission.tick(5, 1.0), Some(1.5));
    assert_eq!(mission.when(|event| *event == Event::Lagging(2.1, 2.0)), [21]);
    assert_eq!(mission.when(|event| *event == Event::LaggingEnded), [23]);
}

#[test]
fn a_link_that_lags_for_ten_seconds_ends_the_mission_and_says_why() {
    let mut mission = Mission::new("plain");
    (0..20).for_each(|_| _ = mission.tick(3, 1.0));
    assert_eq!(mission.end(102, 1.0), (Outcome::Aborted, 120), "10 s after it was found out");
    assert_eq!(mission.aborted(), "the link's round trip takes 10.2 s, more than 2.0 s");
}

/// It held and went on for the whole mission.
#[test]
fn a_link_that_lags_by_turns_ends_the_mission_too() {
    let flaps = |lags: u64, period: u64| {
        let mut mission = Mission::new("unhurried");
        while mission.machine.outcome().is_none() && mission.tick < 3000 {
            let round_trip = if mission.tick % period < lags { 45 } else { 3 };
            mission.tick(round_trip, 1.0);
        }
        (mission.machine.outcome(), mission.tick - 1)
    };
    assert_eq!(flaps(25, 45), (Some(Outcome::Aborted), 290), "10 s beyond, less half of those within");
    assert_eq!(flaps(10, 45).0, None, "a burst now and then is borne");
}

#[test]
fn the_round_trip_counts_into_the_age_of_an_input() {
    let mut mission = Mission::new("fresh_for_a_second");
    (0..20).for_each(|_| _ = mission.tick(10, 1.0));
    assert!(mission.aborted().is_empty(), "{:?}", mission.told);
    assert_eq!(mission.end(11, 1.0), (Outcome::Aborted, 20));
    assert_eq!(mission.aborted(), "no fresh `heading`");
    let mut mission = Mission::new("fresh_for_a_second");
    assert_eq!(mission.end(30, 1.0).0, Outcome::Aborted);
    assert_eq!(mission.aborted(), "no fresh `heading`: the link's round trip takes 3.0 s, more than 2.0 s");
}

#[test]
fn a_mission_may_allow_more_or_less() {
    let mut mission = Mission::new("patient");
    (0..200).for_each(|_| _ = mission.tick(150, 1.0));
    assert!(mission.when(|event| matches!(event, Event::Lagging(..))).is_empty(), "{:?}", mission.told);
    mission.tick(151, 1.0);
    assert_eq!(mission.when(|event| *event == Event::Lagging(15.1, 15.0)), [200]);
}

#[test]
fn the_hosts_clock_bounds_a_mission_whose_vehicle_has_a_slow_one() {
    // 20 s of the vehicle's time, or a tenth and a minute more of the host's.
    assert_eq!(Mission::new("plain").end(0, 1.0), (Outcome::TimedOut, 200));
    assert_eq!(Mission::new("plain").end(0, 4.0), (Outcome::TimedOut, 200), "82 s have not passed");
    let mut slow = Mission::new("plain");
    assert_eq!(slow.end(0, 50.0), (Outcome::TimedOut, 17));
    assert_eq!(slow.when(|event| *event == Event::HostTimeUp(85.0, 1.7)), [17]);
}

#[test]
fn the_recovery_has_a_time_of_its_own_by_both_clocks() {
    let mut mission = Mission::new("with_recovery");
    assert_eq!(mission.end(0, 50.0), (Outcome::TimedOut, 17 + 15), "71 s of the host's, not 10 s of the vehicle's");
    assert_eq!(mission.when(|event| *event == Event::HostTimeUp(85.0, 1.7)), [17]);
}

/// Over a link no sample is younger than the round trip.
#[test]
fn the_thermocline_is_found_over_a_link_too() {
    let path = Path::new("missions/thermocline.alb");
    let script = load(path, None, &[]).unwrap();
    let plan = Plan::new(&script, &path.display().to_string(), Some("thermocline"), Some("summer_shelf")).unwrap();
    let names = ["position", "course", "heading", "depth", "water_depth", "temperature", "altitude", "salinity"];
    let measurements =
        names.map(|name| Measurement { name: name.into(), width: if name == "position" { 3 } else { 1 } });
    let mut machine = Machine::new(plan.program, &measurements).unwrap();
    let lag = Lag { round_trip: 4, host: None };
    let mut reported = false;
    for tick in 0..900 {
        let depth = 2.0 + 0.04 * f64::from(tick);
        let temperature = if depth < 18.0 { 20.0 } else { 10.0 };
        let samples = [0.0, 1.5, 1.5, depth, 40.0, temperature, 40.0 - depth, 32.0];
        let mut snapshot = Snapshot { control: Control::InControl, lag, ..Snapshot::default() };
        (0..).zip(samples).for_each(|(measurement, sample)| snapshot.push(measurement, &[sample, 0.0, 1.0]));
        machine.step(&snapshot);
        reported |= machine.events().iter().any(|event| format!("{event:?}").starts_with("Reported"));
    }
    assert!(reported && machine.outcome().is_none(), "{:?}", machine.outcome());
}

/// The attack: a recovery went on for minutes by the last position that had come, and over a link on which its commands were late.
#[test]
fn a_recovery_keeps_still_while_it_does_not_know_where_it_is() {
    let text = "mission home in calm within 10 min {
        area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
        limits { altitude >= 2 m, speed <= 2 m/s }
        requires { position, course, heading fresh 5 s, else abort }
        recovery within 5 min { goto op.center + 100 m toward south }
        with depth 3 m, speed 1.5 m/s
        goto op.center + 100 m toward north
    }";
    let script = load_text(Source { name: "home.alb".into(), text: text.into() });
    let plan = Plan::new(&script, "home.alb", None, None).unwrap();
    let names = ["course", "heading", "depth", "altitude", "position"];
    let measurements =
        names.map(|name| Measurement { name: name.into(), width: if name == "position" { 3 } else { 1 } });
    let mut machine = Machine::new(plan.program, &measurements).unwrap();
    let mut speed_after = |ticks: u32, is_placed: bool, round_trip: u64| {
        let mut speed = None;
        for _ in 0..ticks {
            let lag = Lag { round_trip, host: None };
            let mut snapshot = Snapshot { control: Control::InControl, lag, ..Snapshot::default() };
            (0..).zip([0.0, 0.0, 3.0, 20.0]).for_each(|(measurement, sample)| snapshot.push(measurement, &[sample]));
            if is_placed {
                snapshot.push(4, &[0.0, 0.0, 1.0]);
            }
            speed = machine.step(&snapshot).map(|command| command.speed);
        }
        speed
    };
    assert_eq!(speed_after(20, true, 0), Some(1.5));
    assert_eq!(speed_after(60, false, 0), Some(0.0), "it is aborted, and its recovery does not know where it is");
    assert_eq!(speed_after(20, true, 0), Some(1.5), "it goes home");
    assert_eq!(speed_after(20, true, 30), Some(0.0), "over a link that is too slow");
    assert_eq!(speed_after(20, true, 0), Some(1.5));
}
