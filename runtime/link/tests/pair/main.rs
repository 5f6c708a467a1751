//! Controller and front seat, joined by two queues of bytes on which things go wrong: no operating system, no clock.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test whose vehicle cannot be made has failed")]

mod wire;

use albacore_geometry::{Geodetic, Heading, Point, TangentFrame};
use albacore_link::{Controller, Milestone, Rows, Server, ServerEvent, recon};
use albacore_sim::{Bottom, Ctd, Environment, Scenario, Simulator, Stratification, VehicleSetup};
use albacore_vehicle::measurements::{SALINITY, TEMPERATURE};
use albacore_vehicle::{Command, Control, Limits, Snapshot, Vertical};
use wire::{Chance, Delay, Wire};

/// The vehicle leaves a guest who is silent for so long.
const TIMED_OUT: ServerEvent = ServerEvent::TimedOut(recon::DIALECT.timeout_ticks);

fn frame() -> TangentFrame {
    TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) }
}

fn still_water() -> Scenario {
    Scenario { vehicle: VehicleSetup { depth: 3.0, ..VehicleSetup::default() }, ..Scenario::default() }
}

struct Pair {
    vehicle: Server<Simulator>,
    controller: Controller,
    wire: Wire,
    there: Delay,
    back: Delay,
    to_vehicle: Vec<u8>,
    snapshot: Snapshot,
    /// Every change of control that the controller saw, and what happened at the vehicle.
    controls: Vec<Control>,
    happenings: Vec<ServerEvent>,
}

impl Pair {
    fn new(rows: &str, seed: u64, share: f64) -> Self {
        Pair::of(&still_water(), rows, seed, share)
    }

    fn of(scenario: &Scenario, rows: &str, seed: u64, share: f64) -> Self {
        let rows: Rows = rows.parse().unwrap();
        let simulator = Simulator::new(scenario, seed).unwrap();
        let start = (Point::ORIGIN, Heading::NORTH);
        Pair {
            vehicle: Server::new(recon::server(), simulator, frame(), &rows.into(), start, Vertical::Depth(3.0)),
            controller: Controller::new(recon::controller(), frame()),
            wire: Wire { chance: Chance(seed), share },
            there: Delay::default(),
            back: Delay::default(),
            to_vehicle: Vec::new(),
            snapshot: Snapshot::default(),
            controls: Vec::new(),
            happenings: Vec::new(),
        }
    }

    /// A tick of the vehicle, and those of the controller that come of it.
    fn tick(&mut self, command: Option<&Command>) {
        let bytes = self.there.carry(std::mem::take(&mut self.to_vehicle));
        self.vehicle.tick(&bytes).unwrap();
        self.happenings.extend(self.vehicle.take_happenings());
        let bytes = self.back.carry(self.vehicle.take_output());
        self.controller.hear(&self.wire.carry(&bytes));
        while self.controller.is_due() {
            self.controller.sense(&mut self.snapshot);
            if self.controls.last() != Some(&self.snapshot.control) {
                self.controls.push(self.snapshot.control);
            }
            if let Some(command) = command {
                self.controller.command(command);
            }
        }
        self.send();
    }

    fn send(&mut self) {
        let out = self.controller.take_output();
        self.to_vehicle.extend(self.wire.carry(&out));
    }

    fn ticks(&mut self, count: usize, command: Option<&Command>) {
        (0..count).for_each(|_| self.tick(command));
    }

    /// Ticks until something has happened, and how many there were.
    #[track_caller]
    fn until(&mut self, most: usize, what: impl Fn(&ServerEvent) -> bool) -> usize {
        for count in 0..most {
            if self.happenings.iter().any(&what) {
                return count;
            }
            self.tick(None);
        }
        panic!("not within {most} ticks: {:?}", self.happenings);
    }

    fn release(&mut self, most: usize) -> bool {
        for _ in 0..most {
            if self.controller.release() {
                return true;
            }
            self.send();
            let bytes = std::mem::take(&mut self.to_vehicle);
            self.vehicle.tick(&bytes).unwrap();
            self.happenings.extend(self.vehicle.take_happenings());
            let bytes = self.vehicle.take_output();
            self.controller.hear(&self.wire.carry(&bytes));
        }
        false
    }
}

const EAST: Command = Command::new(Heading::NORTH, 2.0, Vertical::Depth(5.0));

fn east() -> Command {
    Command { heading: Heading::from_degrees(90.0), ..EAST }
}

/// Drives away from the first row for half a minute, gives the vehicle back, and sees it return and go on.
fn excursion(seed: u64, share: f64) -> Pair {
    let mut pair = Pair::new("100x20x2", seed, share);
    pair.ticks(200, None);
    pair.controller.take_over();
    pair.send();
    pair.ticks(300, Some(&east()));
    pair
}

#[test]
fn takes_control_drives_releases_and_the_vehicle_resumes_its_rows() {
    let mut pair = excursion(1, 0.0);
    let Some(ServerEvent::Taken(break_off, 1)) = pair.happenings.last().cloned() else {
        panic!("{:?}", pair.happenings)
    };
    assert!((20.0..35.0).contains(&break_off.north), "20 s at 1.5 m/s: {break_off:?}");
    assert!(pair.vehicle.position().distance(break_off) > 50.0);
    let depth = pair.snapshot.samples.iter().find(|s| s.measurement == 4).unwrap().reading[0];
    assert!((depth - 5.0).abs() < 0.011, "{depth}");
    assert!(pair.release(10));
    assert_eq!(pair.controller.control(), Control::Released);
    assert_eq!(pair.controls, [Control::Monitoring, Control::InControl], "the answer comes within the tick");
    pair.until(1500, |h| matches!(h, ServerEvent::Plan(Milestone::Resumed(at, 1)) if *at == break_off));
    assert!(pair.vehicle.position().distance(break_off) < 12.0);
    pair.until(3000, |h| *h == ServerEvent::Plan(Milestone::Over));
    assert!(!pair.happenings.contains(&TIMED_OUT));
}

#[test]
fn the_controller_sees_what_the_vehicle_believes_as_fine_as_the_dialect_says() {
    let pair = excursion(2, 0.0);
    let sample =
        |measurement: u16| pair.snapshot.samples.iter().find(|s| s.measurement == measurement).unwrap().reading;
    let [north, east, ..] = sample(0);
    assert!(Point::new(north, east).distance(pair.vehicle.position()) < 0.15, "half of 0.0001 minutes each way");
    assert!((sample(1)[0] - sample(2)[0]).abs() < 0.01, "no current: the course is the heading");
    assert!((sample(2)[0] - Heading::from_degrees(90.0).radians()).abs() < 0.002);
    assert!((sample(6)[0] - 20.0).abs() < 0.02, "the water's depth");
}

#[test]
fn temperature_and_salinity_come_of_a_vehicle_that_has_a_ctd() {
    let stratification =
        Stratification { surface: 18.0, bottom: 8.0, surface_salinity: 31.0, thermocline: 3.0, ..Default::default() };
    let mut scenario =
        Scenario { environment: Environment { stratification, ..still_water().environment }, ..still_water() };
    scenario.instruments.ctd = Some(Ctd::default());
    let mut pair = Pair::of(&scenario, "100x30x2", 1, 0.0);
    let mut came = Vec::new();
    for _ in 0..100 {
        pair.tick(None);
        let of =
            |measurement| pair.snapshot.samples.iter().find(|s| s.measurement == measurement).map(|s| s.reading[0]);
        came.extend(of(TEMPERATURE).zip(of(SALINITY)));
    }
    assert_eq!(came, [(13.0, 33.0); 10], "the middle of the thermocline, once a second");
    let mut without = Pair::new("100x30x2", 1, 0.0);
    without.ticks(100, None);
    assert!(without.snapshot.samples.iter().all(|s| s.measurement != TEMPERATURE && s.measurement != SALINITY));
}

#[test]
fn a_bad_wire_costs_time_and_nothing_else() {
    for share in [0.01, 0.05, 0.3] {
        for seed in 1..=20 {
            let mut pair = excursion(seed, share);
            assert!(pair.release(300), "seed {seed}, {share}");
            assert!(pair.controls.contains(&Control::InControl), "seed {seed}, {share}: {:?}", pair.controls);
            assert!(pair.vehicle.position().distance(Point::ORIGIN) > 50.0, "seed {seed}, {share}");
            pair.until(1500, |h| matches!(h, ServerEvent::Plan(Milestone::Resumed(_, 1))));
            let count = pair.controller.count();
            assert!(count.unreadable > 0 && count.messages > count.unreadable, "seed {seed}: {count:?}");
        }
    }
}

#[test]
fn who_falls_silent_loses_control_after_five_seconds_exactly() {
    let mut pair = excursion(1, 0.0);
    pair.to_vehicle.clear();
    pair.vehicle.tick(b"#v,*EF\n").unwrap();
    assert!(!pair.vehicle.waits_for_guest());
    for tick in 1..=50 {
        assert!(!pair.happenings.contains(&TIMED_OUT), "tick {tick}");
        assert_eq!(pair.vehicle.waits_for_guest(), tick > 10);
        pair.vehicle.tick(b"").unwrap();
        pair.happenings.extend(pair.vehicle.take_happenings());
    }
    assert!(pair.happenings.contains(&TIMED_OUT));
    pair.ticks(3, None);
    assert_eq!(pair.snapshot.control, Control::Released, "and the controller, back again, is told");
    pair.until(1500, |h| matches!(h, ServerEvent::Plan(Milestone::Resumed(_, 1))));
}

#[test]
fn who_commands_nothing_stays_in_control() {
    let mut pair = excursion(1, 0.0);
    pair.ticks(300, None);
    assert!(!pair.happenings.contains(&TIMED_OUT));
    assert_eq!(pair.controls.last(), Some(&Control::InControl));
}

#[test]
fn a_keep_alive_every_five_seconds_is_enough() {
    let mut pair = excursion(1, 0.0);
    for tick in 0..500 {
        pair.vehicle.tick(if tick % 50 == 0 { b"#V,0.000000,*79\n" } else { b"" }).unwrap();
    }
    assert!(!pair.vehicle.take_happenings().contains(&TIMED_OUT));
}

#[test]
fn commands_beyond_the_scenarios_limits_are_held_at_them_and_noticed() {
    let limits = Some(Limits { depth: Some(6.0), ..Limits::default() });
    let mut pair = Pair::of(&Scenario { limits, ..still_water() }, "100x20x2", 1, 0.0);
    pair.ticks(10, None);
    pair.controller.take_over();
    pair.send();
    let deep = Command { vertical: Vertical::Depth(400.0), ..east() };
    pair.ticks(100, Some(&deep));
    let told = ServerEvent::Notice("is asked to go deeper than 6.00 m: it stays there".into());
    assert!(pair.happenings.contains(&told), "{:?}", pair.happenings);
    let notices = pair.controller.take_notices();
    assert!(notices.iter().any(|n| n.contains("error 2, is asked to go deeper than 6.00 m")), "{notices:?}");
    let ignored = "does not follow `#C,Depth,Depth,400.00` and says `#C,Depth,Depth,6.00`";
    assert!(notices.iter().any(|n| n.contains(ignored)), "{notices:?}");
    let depth = pair.snapshot.samples.iter().find(|s| s.measurement == 4).unwrap().reading[0];
    assert!((depth - 6.0).abs() < 0.011, "it holds what it may: {depth}");
}

#[test]
fn a_vehicle_that_runs_aground_says_so_and_that_it_came_free() {
    let mut pair = Pair::of(
        &Scenario {
            environment: Environment { bottom: Bottom::flat(4.0), ..still_water().environment },
            ..still_water()
        },
        "100x20x2",
        1,
        0.0,
    );
    pair.controller.take_over();
    pair.send();
    let mut told = Vec::new();
    for depth in [5.0, 2.0] {
        pair.ticks(100, Some(&Command { vertical: Vertical::Depth(depth), ..EAST }));
        told.push(pair.controller.take_notices());
    }
    let says = |told: &[String], what: &str| told.iter().filter(|notice| notice.as_str() == what).count();
    let (aground, free) = ("the vehicle says: error 4, aground", "the vehicle says: error 5, free of the bottom again");
    assert_eq!((says(&told[0], aground), says(&told[0], free)), (1, 0), "{told:?}");
    assert_eq!((says(&told[1], aground), says(&told[1], free)), (0, 1), "{told:?}");
}

#[test]
fn a_mission_that_is_over_cannot_be_overridden() {
    let mut pair = Pair::new("10x5x1", 1, 0.0);
    pair.until(1000, |h| *h == ServerEvent::Plan(Milestone::Over));
    pair.controller.take_over();
    pair.send();
    pair.ticks(3, None);
    assert_eq!(pair.controls.last(), Some(&Control::Refused));
    assert!(pair.controller.take_notices().iter().any(|n| n.contains("mission is over")));
}

#[test]
fn a_guest_that_comes_back_on_the_way_does_not_move_the_break_off_point() {
    let mut pair = excursion(1, 0.0);
    let Some(ServerEvent::Taken(first, _)) = pair.happenings.last().cloned() else { panic!("{:?}", pair.happenings) };
    assert!(pair.release(10));
    pair.ticks(20, None);
    pair.controller = Controller::new(recon::controller(), frame());
    pair.tick(None);
    pair.controller.take_over();
    pair.send();
    pair.ticks(100, Some(&east()));
    assert_eq!(pair.controls.last(), Some(&Control::InControl));
    assert!(pair.release(10));
    pair.until(2000, |h| matches!(h, ServerEvent::Plan(Milestone::Resumed(at, 1)) if *at == first));
}

#[test]
fn the_closest_point_of_the_row_can_be_asked_for() {
    let mut pair = excursion(1, 0.0);
    pair.to_vehicle.extend_from_slice(b"#c,1,*39\n");
    let north = Command { heading: Heading::NORTH, ..east() };
    pair.ticks(150, Some(&north));
    assert!(pair.release(10));
    let closest = |h: &ServerEvent| matches!(h, ServerEvent::Plan(Milestone::Resumed(at, 1)) if at.east.abs() < 0.5 && at.north > 45.0);
    pair.until(1500, closest);
}

#[test]
fn no_bytes_whatever_make_either_side_fail() {
    let mut chance = Chance(7);
    let mut pair = excursion(3, 0.0);
    let letters = b"#SAFEBCcVvQ,*0123456789ABCDEF.-\nLATONDGHRMTl";
    for round in 0..2000 {
        let noise: Vec<u8> = (0..500)
            .map(|_| if round % 2 == 0 { chance.draw() as u8 } else { letters[chance.below(letters.len())] })
            .collect();
        pair.controller.hear(&noise);
        pair.vehicle.tick(&noise).unwrap();
        pair.vehicle.take_output();
        pair.vehicle.take_happenings();
        while pair.controller.is_due() {
            pair.controller.sense(&mut pair.snapshot);
        }
    }
    assert!(pair.controller.count().unreadable > 1000 && pair.vehicle.unreadable() > 1000);
}

/// Drives for a while over a wire that takes so many ticks each way; the round trip as it was known in each tick of ours.
fn delayed(there: usize, back: usize, seed: u64, share: f64, ticks: usize, course: impl Fn(usize) -> f64) -> Vec<u64> {
    let mut pair = Pair::new("400x20x2", seed, share);
    (pair.there, pair.back) = (Delay::of(there), Delay::of(back));
    pair.ticks(20 + back, None);
    pair.controller.take_over();
    pair.send();
    let mut known = Vec::new();
    for tick in 0..ticks {
        let heading = Heading::from_degrees(course(tick));
        pair.tick(Some(&Command { heading, ..EAST }));
        if pair.controls.last() == Some(&Control::InControl) {
            known.push(pair.snapshot.lag.round_trip);
        }
    }
    assert!(known.len() > ticks / 2, "it drove: {:?}", pair.controls);
    known
}

#[test]
fn the_delay_of_the_link_is_known_and_never_taken_for_less() {
    for (there, back) in [(0, 0), (0, 1), (5, 5), (100, 0), (0, 100), (50, 50)] {
        let delay = (there + back) as u64;
        let steady = delayed(there, back, 1, 0.0, 700, |_| 90.0);
        let settled = &steady[(delay as usize + 20).min(steady.len() - 1)..];
        assert!(settled.iter().all(|known| (delay..=delay + 12).contains(known)), "{there} + {back}: {settled:?}");
        // Longer than 2 s it is within 3 s, whoever measures.
        assert!(delay < 20 || steady[31] > 20, "{there} + {back}: {:?}", &steady[..40]);
        let turning = delayed(there, back, 1, 0.0, 700, |tick| (tick / 3) as f64 % 360.0);
        let settled = &turning[(delay as usize + 20).min(turning.len() - 1)..];
        assert!(settled.iter().all(|known| (delay..=delay + 20).contains(known)), "{there} + {back}: {settled:?}");
    }
}

/// A wire that loses one line in a hundred is no wire that lags.
#[test]
fn a_bad_wire_is_not_taken_for_a_slow_one() {
    for seed in 1..=5 {
        let known = delayed(0, 0, seed, 0.01, 2000, |tick| (tick / 10) as f64 % 360.0);
        assert!(known.iter().all(|known| *known <= 20), "seed {seed}: {:?}", known.iter().max());
    }
}

#[test]
fn a_link_that_becomes_slow_is_found_out_before_its_answer_comes() {
    let mut pair = excursion(1, 0.0);
    assert!(pair.snapshot.lag.round_trip <= 2, "{:?}", pair.snapshot.lag);
    pair.there.lengthen(40);
    pair.ticks(35, Some(&east()));
    assert!(pair.snapshot.lag.round_trip > 20, "{:?}", pair.snapshot.lag);
    pair.ticks(100, Some(&east()));
    assert!((40..=52).contains(&pair.snapshot.lag.round_trip), "{:?}", pair.snapshot.lag);
}

/// The run of the controller is a function of the bytes, however they are cut and however late they are read.
#[test]
fn how_bytes_are_cut_and_when_they_are_read_changes_nothing() {
    let mut simulator = Pair::new("100x20x2", 5, 0.0);
    let mut bytes = Vec::new();
    for _ in 0..30 {
        simulator.vehicle.tick(b"").unwrap();
        bytes.extend(simulator.vehicle.take_output());
    }
    let run = |cuts: &[usize]| {
        let mut controller = Controller::new(recon::controller(), frame());
        let (mut snapshot, mut seen, mut from) = (Snapshot::default(), Vec::new(), 0);
        for &to in cuts.iter().chain([&bytes.len()]) {
            controller.hear(&bytes[from..to]);
            from = to;
            while controller.is_due() {
                controller.sense(&mut snapshot);
                seen.push(snapshot.clone());
            }
        }
        seen
    };
    let whole = run(&[]);
    assert_eq!(whole.len(), 30);
    for cut in 0..bytes.len() {
        assert!(run(&[cut]) == whole, "cut at {cut}");
    }
    let single: Vec<usize> = (0..bytes.len()).collect();
    assert!(run(&single) == whole, "a byte at a time");
}

/// Asks for control over a wire that takes 8 ticks each way, and gives up after so many, again and again.
fn impatient(patience: usize, times: usize) -> Pair {
    let mut pair = Pair::new("400x20x2", 1, 0.0);
    (pair.there, pair.back) = (Delay::of(8), Delay::of(8));
    pair.ticks(40, None);
    for _ in 0..times {
        pair.controller.take_over();
        pair.send();
        pair.ticks(patience, Some(&east()));
        pair.controller.give_back();
        pair.send();
        pair.ticks(patience, None);
    }
    pair.ticks(100, None);
    pair
}

/// An attack: the vehicle lets us drive when we have given up, and was taken to offer what we had asked for.
#[test]
fn the_late_answer_to_a_question_of_our_own_is_no_offer() {
    for (patience, times) in [(10, 1), (14, 1), (12, 4), (7, 4), (20, 4)] {
        let pair = impatient(patience, times);
        let Pair { controls, happenings, .. } = &pair;
        assert!(happenings.iter().any(|h| matches!(h, ServerEvent::Taken(..))), "{happenings:?}");
        assert!(!happenings.contains(&TIMED_OUT), "{happenings:?}");
        for wrong in [Control::Offered, Control::Released, Control::Refused] {
            assert!(!controls.contains(&wrong), "{patience} ticks, {times} times: {controls:?}");
        }
        assert_eq!(controls.last(), Some(&Control::Monitoring));
    }
}

/// An attack: who gave up while the answer was on its way ended before it knew that it was heard, and left the vehicle in override.
#[test]
fn a_question_that_is_still_under_way_is_released_until_it_is_heard() {
    let mut pair = Pair::new("400x20x2", 1, 0.0);
    (pair.there, pair.back) = (Delay::of(3), Delay::of(3));
    pair.ticks(40, None);
    pair.controller.take_over();
    pair.send();
    pair.ticks(1, None);
    let mut is_released = false;
    for round in 0..60 {
        is_released |= pair.controller.release();
        // The first word of it is lost.
        let said = pair.controller.take_output();
        if round > 0 {
            pair.to_vehicle.extend(said);
        }
        let bytes = pair.there.carry(std::mem::take(&mut pair.to_vehicle));
        pair.vehicle.tick(&bytes).unwrap();
        pair.happenings.extend(pair.vehicle.take_happenings());
        let bytes = pair.back.carry(pair.vehicle.take_output());
        pair.controller.hear(&bytes);
        if is_released {
            break;
        }
    }
    assert!(is_released);
    pair.to_vehicle.clear();
    pair.until(80, |h| *h == ServerEvent::Released);
    assert!(!pair.happenings.contains(&TIMED_OUT), "{:?}", pair.happenings);
}
