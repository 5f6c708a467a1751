//! Who drives, as the controller concludes it from mode bytes that no front seat of ours sends.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

use albacore_geometry::math::degrees;
use albacore_geometry::{Geodetic, Heading, Point, TangentFrame};
use albacore_link::Controller;
use albacore_link::recon::{self, Adcp, FromVehicle, Mode, State, seal};
use albacore_navigation::{DeadReckoning, Estimate, Fix, Navigator, Sensed};
use albacore_vehicle::measurements::{COURSE, POSITION};
use albacore_vehicle::{Command, Control, Snapshot, Vertical};
use std::time::Duration;

struct Vehicle {
    controller: Controller,
    snapshot: Snapshot,
    time_ms: u32,
    /// What it says that it holds.
    heading_goal: Heading,
    depth_goal: f64,
    speed: f64,
}

impl Vehicle {
    fn new() -> Self {
        let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
        Vehicle {
            controller: Controller::new(recon::controller(), frame),
            snapshot: Snapshot::default(),
            time_ms: 0,
            heading_goal: Heading::NORTH,
            depth_goal: 3.0,
            speed: 0.0,
        }
    }

    /// One state with this mode; who drives then, and what was sent.
    fn says(&mut self, mode: u8) -> (Control, String) {
        assert!(self.hear(mode));
        self.controller.sense(&mut self.snapshot);
        (self.snapshot.control, String::from_utf8(self.controller.take_output()).unwrap())
    }

    /// One state with this mode, a tick later; whether it makes a tick.
    fn hear(&mut self, mode: u8) -> bool {
        self.time_ms += 100;
        let state = State {
            time_ms: self.time_ms,
            position: Geodetic::from_degrees(36.18, -75.74),
            depth: 3.0,
            depth_goal: self.depth_goal,
            altitude: None,
            pitch: 0.0,
            roll: 0.0,
            rpm: 0.0,
            rpm_goal: 0.0,
            speed: self.speed,
            heading: Heading::NORTH,
            heading_rate: 0.0,
            heading_goal: self.heading_goal,
            mode: Mode(mode),
            leg: None,
        };
        self.controller.hear(seal(&state.to_string()).as_bytes());
        self.controller.is_due()
    }

    /// A message of the profiler, which belongs to the next state.
    fn profiles(&mut self, ahead: f64, starboard: f64) {
        let heading = Heading::NORTH;
        let adcp = Adcp { ahead, starboard, vertical: 0.0, altitude: None, heading, current: None, look: 'U' };
        self.controller.hear(seal(&FromVehicle::Adcp(adcp).to_string()).as_bytes());
    }

    /// The course of the last tick, in degrees.
    fn course(&self) -> Option<f64> {
        let sample = self.snapshot.samples.iter().find(|sample| sample.measurement == COURSE)?;
        Some((degrees(sample.reading[0]) * 10.0).round() / 10.0)
    }

    fn driven() -> Self {
        let mut vehicle = Vehicle::new();
        vehicle.says(0x01);
        vehicle.controller.take_over();
        (0..3).for_each(|_| assert_eq!(vehicle.says(0x0D).0, Control::InControl));
        vehicle
    }
}

#[test]
fn nothing_is_sent_before_control_is_wanted_and_asking_goes_on_until_the_mode_shows_it() {
    let mut vehicle = Vehicle::new();
    assert_eq!(vehicle.controller.control(), Control::Disconnected);
    assert_eq!(vehicle.says(0x01), (Control::Monitoring, String::new()));
    vehicle.controller.take_over();
    assert_eq!(vehicle.controller.take_output(), b"#E,1,*1B\n");
    assert_eq!(vehicle.says(0x01), (Control::Requesting, "#E,1,*1B\n".into()));
    assert_eq!(vehicle.says(0x05), (Control::Requesting, "#E,1,*1B\n".into()), "enabled, not yet active");
    assert_eq!(vehicle.says(0x0D), (Control::InControl, "#Q,Depth,*EB\n".into()));
    assert_eq!(vehicle.says(0x0D), (Control::InControl, String::new()));
}

/// The vehicle may be programmed to ask for a guest.
#[test]
fn an_override_that_the_vehicle_began_is_taken() {
    let mut vehicle = Vehicle::new();
    assert_eq!(vehicle.says(0x0D).0, Control::Offered);
    vehicle.controller.take_over();
    assert_eq!(vehicle.says(0x0D).0, Control::InControl);
}

#[test]
fn a_vehicle_that_suspends_its_mission_is_waited_for_and_kept_alive() {
    let mut vehicle = Vehicle::driven();
    for mode in [0x0E, 0x02, 0x8D] {
        assert_eq!(vehicle.says(mode).0, Control::Suspended, "{mode:02X}");
    }
    let sent: String = (0..20).map(|_| vehicle.says(0x02).1).collect();
    assert_eq!(sent.matches("#V,albacore").count(), 2, "{sent}");
    assert!(!sent.contains("#E"));
    assert_eq!(vehicle.says(0x0D).0, Control::InControl);
}

/// States that come five times a second, or once, or ten at once: every tick that speaks follows others that are late.
#[test]
fn a_vehicle_that_says_little_is_kept_alive_whether_it_suspends_us_or_we_wait() {
    for mode in [0x02, 0x0D] {
        for every in [2, 10, 20] {
            let mut vehicle = Vehicle::driven();
            let mut spoke = 0;
            for tick in (0..300).step_by(every) {
                vehicle.time_ms += 100 * (every as u32 - 1);
                assert!(vehicle.hear(mode));
                while vehicle.controller.is_due() {
                    vehicle.controller.sense(&mut vehicle.snapshot);
                }
                let sent = String::from_utf8(vehicle.controller.take_output()).unwrap();
                spoke = if sent.contains("#V,albacore") { tick } else { spoke };
                assert!(tick - spoke < 45, "{mode:02X}, every {every} ticks: nothing for {} ticks", tick - spoke);
            }
        }
    }
}

/// Who was left has driven: the vehicle's word that nobody drives it is no old one.
#[test]
fn a_vehicle_that_has_left_us_is_released_by_its_next_word() {
    for every in [1, 8, 15, 20] {
        let mut vehicle = Vehicle::driven();
        while vehicle.snapshot.control != Control::Released {
            vehicle.time_ms += 100 * (every - 1);
            assert!(vehicle.hear(0x01));
            while vehicle.controller.is_due() {
                vehicle.controller.sense(&mut vehicle.snapshot);
                vehicle.controller.command(&Command::still(Heading::NORTH, 3.0));
            }
        }
        assert_eq!(vehicle.controller.why(), "the vehicle has left override by itself", "every {every} ticks");
        assert!(!vehicle.controller.release());
        vehicle.hear(0x01);
        assert!(vehicle.controller.release(), "every {every} ticks");
    }
}

#[test]
fn a_vehicle_that_takes_control_back_has_released_itself_from_us() {
    for mode in [0x01, 0x03, 0x00, 0x05] {
        let mut vehicle = Vehicle::driven();
        assert_eq!(vehicle.says(mode).0, Control::InControl, "{mode:02X}: one line may be wrong");
        assert_eq!(vehicle.says(0x0D).0, Control::InControl);
        let controls = [mode; 3].map(|mode| vehicle.says(mode).0);
        assert_eq!(controls, [Control::InControl, Control::InControl, Control::Released], "{mode:02X}");
        assert_eq!(vehicle.says(0x0D).0, Control::Released, "and that is final");
    }
}

/// One wrong line neither refuses nor gives control.
#[test]
fn one_wrong_line_before_control_is_had_ends_nothing() {
    for wrong in [0x03, 0x07, 0x8F, 0x0D, 0x8D] {
        let mut vehicle = Vehicle::new();
        vehicle.says(0x01);
        vehicle.controller.take_over();
        vehicle.says(wrong);
        let last = (0..10).map(|_| vehicle.says(0x05).0).last();
        assert_eq!(last, Some(Control::Requesting), "{wrong:02X}");
        assert_eq!(vehicle.says(0x0D).0, Control::InControl, "{wrong:02X}");
        assert_eq!([0x01; 6].map(|mode| vehicle.says(mode).0).last(), Some(&Control::Requesting));
        assert_eq!([0x03; 3].map(|mode| vehicle.says(mode).0).last(), Some(&Control::Refused));
    }
}

/// One wrong line passes the sum, and those after it are lost: three ticks of one word.
#[test]
fn lost_lines_after_a_wrong_one_are_no_word_of_the_vehicles() {
    let mut vehicle = Vehicle::driven();
    vehicle.says(0x01);
    vehicle.time_ms += 400;
    assert!(vehicle.hear(0x0D));
    while vehicle.controller.is_due() {
        vehicle.controller.sense(&mut vehicle.snapshot);
        assert_eq!(vehicle.snapshot.control, Control::InControl);
    }
    assert_eq!(vehicle.controller.take_notices(), [""; 0]);
}

/// Its own clock makes a tick of 3 s of the host's.
#[test]
fn a_vehicle_with_a_slow_clock_that_never_lets_us_drive_refuses_after_half_a_minute_of_the_hosts() {
    let mut vehicle = Vehicle::new();
    vehicle.says(0x01);
    vehicle.controller.take_over();
    let controls: Vec<Control> = (1..=11)
        .map(|tick| {
            vehicle.controller.tell_time(Duration::from_secs(3 * tick));
            vehicle.says(0x01).0
        })
        .collect();
    assert!(controls[..10].iter().all(|control| *control == Control::Requesting), "{controls:?}");
    assert_eq!(controls[10], Control::Refused);
}

#[test]
fn a_vehicle_that_says_too_much_is_counted_and_not_written() {
    let mut vehicle = Vehicle::driven();
    let (mut said, mut told) = (0, Vec::new());
    for _ in 0..1000 {
        for _ in 0..60 {
            said += 1;
            vehicle.controller.hear(seal(&format!("E,7,{said} {}", "x".repeat(900))).as_bytes());
        }
        vehicle.says(0x0D);
        told.append(&mut vehicle.controller.take_notices());
    }
    assert!(told.concat().len() < 100_000 && told.len() > 20, "{} lines", told.len());
    assert!(told.iter().any(|text| text.starts_with("the vehicle says too much")));
    vehicle.controller.release();
    told.append(&mut vehicle.controller.take_notices());
    let untold = told.iter().filter_map(|text| text.strip_suffix(" more notices of the vehicle were not written"));
    let untold: usize = untold.map(|count| count.parse::<usize>().unwrap()).sum();
    let written = told.iter().filter(|text| text.starts_with("the vehicle says: error 7")).count();
    assert_eq!(written + untold, said, "each is written or counted");
}

#[test]
fn a_vehicle_that_never_lets_us_drive_refuses_after_half_a_minute() {
    for (mode, why) in [(0x00, "not launched"), (0x81, "not allowed"), (0x02, "suspended"), (0x01, "goes on")] {
        let mut vehicle = Vehicle::new();
        vehicle.says(mode);
        vehicle.controller.take_over();
        assert!((0..300).all(|_| vehicle.says(mode).0 == Control::Requesting), "{mode:02X}");
        assert_eq!((0..3).map(|_| vehicle.says(mode).0).last(), Some(Control::Refused), "{mode:02X}");
        let notices = vehicle.controller.take_notices().join("\n");
        assert!(notices.contains(why), "{notices}");
    }
}

/// A tick in which something is commanded; what was sent.
fn commanded(vehicle: &mut Vehicle, command: &Command) -> String {
    vehicle.says(0x0D);
    vehicle.controller.command(command);
    String::from_utf8(vehicle.controller.take_output()).unwrap()
}

const HEADING: &str = "#C,Heading,Goal,270.0,*6A\n";
const MARKED: &str = "#C,Heading,Goal,270.1,*6B\n";
const SPEED: &str = "#C,Speed,1.50 meters/sec,*E3\n";
const ALTITUDE: &str = "#C,Depth,Altitude,4.00,*33\n";

fn west() -> Command {
    Command::new(Heading::from_degrees(270.0), 1.5, Vertical::Altitude(4.0))
}

#[test]
fn goals_are_sent_one_a_tick_when_they_change_are_not_taken_up_and_twice_a_second() {
    let mut vehicle = Vehicle::driven();
    let sent = [0; 6].map(|_| commanded(&mut vehicle, &west()));
    assert_eq!(sent, [HEADING, SPEED, ALTITUDE, HEADING, SPEED, ALTITUDE], "again until they are taken up");
    vehicle.heading_goal = west().heading;
    for body in ["C,Speed,1.5 meters/sec", "C,Depth,Altitude,4"] {
        vehicle.controller.hear(seal(body).as_bytes());
    }
    let answered = [0; 11].map(|_| commanded(&mut vehicle, &west()));
    let twice = "twice a second: it leaves who is silent; once a second with another mark";
    assert_eq!(answered[2..], [HEADING, SPEED, ALTITUDE, MARKED, "", "", SPEED, ALTITUDE, MARKED], "{twice}");
    let turned = Command { heading: Heading::from_degrees(271.04), ..west() };
    assert_eq!(commanded(&mut vehicle, &turned), seal("C,Heading,Goal,271.0"));
}

#[test]
fn the_question_that_goes_before_the_first_goal_has_a_tick_of_its_own() {
    let mut vehicle = Vehicle::new();
    vehicle.says(0x01);
    vehicle.controller.take_over();
    vehicle.controller.take_output();
    assert_eq!([0; 2].map(|_| commanded(&mut vehicle, &west())), ["", HEADING]);
}

/// What it does not read waits in a queue, of which all but the last lines are old when it reads on. A line a second says that we are here.
#[test]
fn a_vehicle_that_reads_nothing_finds_a_fifth_of_a_minutes_lines_when_it_reads_on() {
    let asks = |vehicle: &mut Vehicle, minute: &[u8]| -> Vec<String> {
        minute.iter().map(|mode| vehicle.says(*mode).1).collect()
    };
    let mut vehicle = Vehicle::new();
    vehicle.says(0x01);
    vehicle.controller.take_over();
    let requests = asks(&mut vehicle, &[0x01; 290]);
    let mut vehicle = Vehicle::driven();
    vehicle.controller.give_back();
    let returns = asks(&mut vehicle, &[0x0D; 600]);
    let mut vehicle = Vehicle::driven();
    let turning = |tick: u32| Command { heading: Heading::from_degrees(f64::from(tick)), ..west() };
    let goals: Vec<String> = (0..600).map(|tick| commanded(&mut vehicle, &turning(tick))).collect();
    for (sent, what) in [(&requests, "#E,1,"), (&returns, "#E,0,"), (&goals, "#C,")] {
        let at: Vec<usize> = (0..).zip(sent).filter(|(_, lines)| !lines.is_empty()).map(|(tick, _)| tick).collect();
        assert!(sent.iter().all(|lines| lines.is_empty() || lines.contains(what)), "{sent:?}");
        assert!(at.len() <= 50 + sent.len() / 9 + 2, "{what} {} times", at.len());
        assert!(at.windows(2).all(|pair| pair[1] - pair[0] <= 10), "{what}: silent for too long, {at:?}");
    }
    // The three goals that come last are as they were asked for when they were sent, and it is spoken to as before when it answers.
    let last = goals.iter().rposition(|lines| lines.contains("Heading")).unwrap();
    assert!(last >= 600 - 30 && goals[last].contains(&format!(",{}.", last % 360)), "{}", goals[last]);
    let mut answering = |tick| {
        let sent = commanded(&mut vehicle, &turning(tick));
        vehicle.controller.hear(sent.as_bytes());
        sent
    };
    let answered: Vec<String> = (600..700).map(&mut answering).collect();
    assert!(answered[40..].iter().all(|lines| !lines.is_empty()), "{answered:?}");
}

/// Echoes all that is said to it.
fn echoed(vehicle: &mut Vehicle, command: &Command) {
    let sent = commanded(vehicle, command);
    vehicle.controller.hear(sent.as_bytes());
}

#[test]
fn an_echo_is_no_acceptance() {
    let mut vehicle = Vehicle::driven();
    (0..30).for_each(|_| echoed(&mut vehicle, &west()));
    assert!(vehicle.controller.take_notices().is_empty());
    (0..80).for_each(|_| echoed(&mut vehicle, &west()));
    let told = vehicle.controller.take_notices();
    let wanted = "the vehicle does not follow `#C,Heading,Goal,270.0` and says `#C,Heading,Goal,0.0`";
    assert!(told.len() == 1 && told[0].starts_with(wanted), "told once: {told:?}");
    let deep = Command { vertical: Vertical::Depth(9.0), ..west() };
    (0..40).for_each(|_| echoed(&mut vehicle, &deep));
    assert!(
        vehicle.controller.take_notices().concat().contains("`#C,Depth,Depth,9.00` and says `#C,Depth,Depth,3.00`")
    );
    vehicle.heading_goal = deep.heading;
    vehicle.depth_goal = 9.0;
    (0..10).for_each(|_| echoed(&mut vehicle, &deep));
    vehicle.heading_goal = Heading::NORTH;
    (0..40).for_each(|_| echoed(&mut vehicle, &deep));
    assert_eq!(vehicle.controller.take_notices().len(), 1, "and again when it stops to follow");
}

#[test]
fn a_heading_that_turns_is_followed_late_or_told() {
    let mut vehicle = Vehicle::driven();
    let turning = |tick: u32| Command { heading: Heading::from_degrees(f64::from(tick)), ..west() };
    for tick in 0..200_u32 {
        vehicle.heading_goal = turning(tick.saturating_sub(5)).heading;
        echoed(&mut vehicle, &turning(tick));
    }
    assert_eq!(vehicle.controller.take_notices(), [""; 0], "half a second late");
    vehicle.heading_goal = Heading::NORTH;
    (0..60).for_each(|tick| echoed(&mut vehicle, &turning(150 + tick)));
    assert!(vehicle.controller.take_notices().concat().contains("does not follow `#C,Heading,Goal,"));
}

/// Of speed and altitude the state tells no goal.
#[test]
fn a_goal_that_the_state_does_not_tell_is_told_when_nothing_echoes_it() {
    let mut vehicle = Vehicle::driven();
    vehicle.heading_goal = west().heading;
    (0..40).for_each(|_| drop(commanded(&mut vehicle, &west())));
    let told = vehicle.controller.take_notices().join("\n");
    assert!(told.contains("`#C,Speed,1.50 meters/sec`;") && told.contains("`#C,Depth,Altitude,4.00`;"), "{told}");
}

#[test]
fn an_error_without_a_text_is_told_and_what_a_modem_says_is_no_noise() {
    let mut vehicle = Vehicle::driven();
    vehicle.controller.hear(seal("E,107").as_bytes());
    vehicle.controller.hear(b"#p,$CCMPC,0,1*7C\n");
    assert_eq!(vehicle.controller.take_notices(), ["the vehicle says: error 107"]);
    assert_eq!(vehicle.controller.count().unreadable, 0);
}

#[test]
fn a_release_is_asked_for_until_a_later_mode_shows_it_and_nothing_follows() {
    let mut vehicle = Vehicle::driven();
    assert!(!vehicle.controller.release());
    assert_eq!(vehicle.controller.take_output(), b"#E,0,*1A\n");
    assert!(!vehicle.controller.release(), "nothing was heard since");
    vehicle.controller.take_output();
    vehicle.controller.take_over();
    assert!(vehicle.controller.take_output().is_empty());
    let mut untaken = Vehicle::new();
    untaken.says(0x01);
    assert!(untaken.controller.release(), "who never asked has nothing to give back");
    assert!(untaken.controller.take_output().is_empty());
}

/// A clock that is corrected by 40 s, or a bad line that passes the sum, is no 40 s in which nothing was sensed.
#[test]
fn a_stamp_that_leaps_costs_no_time_and_is_told_only_when_others_agree() {
    let mut vehicle = Vehicle::driven();
    vehicle.time_ms += 40_000;
    assert!(!vehicle.hear(0x0D));
    vehicle.time_ms -= 40_100;
    assert_eq!(vehicle.says(0x0D).0, Control::InControl);
    assert!(vehicle.controller.take_notices().is_empty());
    vehicle.time_ms += 40_000;
    assert_eq!([0; 3].map(|_| vehicle.hear(0x0D)), [false, false, true]);
    vehicle.controller.sense(&mut vehicle.snapshot);
    assert!(!vehicle.snapshot.samples.is_empty() && !vehicle.controller.is_due(), "one tick, with what was sensed");
    assert!(vehicle.controller.take_notices().concat().contains("its clock was set"));
}

/// An attack: the system keeps the oldest of what comes while the process is stopped. What is lost after that is no clock that was set.
#[test]
fn a_stamp_that_leaps_after_a_pause_is_told_as_what_was_lost() {
    let mut vehicle = Vehicle::driven();
    vehicle.controller.tell_time(Duration::from_secs(40));
    (0..100).for_each(|_| drop(vehicle.says(0x0D)));
    vehicle.controller.take_notices();
    vehicle.controller.was_away(Duration::from_secs(30));
    vehicle.time_ms += 20_000;
    assert_eq!([0; 3].map(|_| vehicle.hear(0x0D)), [false, false, true]);
    let told = vehicle.controller.take_notices().concat();
    assert!(told.contains("while this computer was stopped is lost") && !told.contains("clock was set"), "{told}");
}

/// Who has lost the vehicle and gives it back hears it again: the time between was no clock that was set.
#[test]
fn a_vehicle_that_is_heard_again_after_it_was_lost_did_not_set_its_clock() {
    let mut vehicle = Vehicle::driven();
    vehicle.controller.lose("silence".into());
    vehicle.controller.release();
    vehicle.time_ms += 250_000;
    (0..5).for_each(|_| drop(vehicle.says(0x0D)));
    assert_eq!(vehicle.controller.take_notices(), ["silence"]);
}

/// A hold stops the vehicle: that must not be what makes an input of it missing. A profiler that tells 0 of a vehicle that goes is
/// out of order, and so is one that tells nothing.
#[test]
fn a_vehicle_at_rest_has_a_course_and_one_whose_profiler_fails_has_none() {
    let has_course = |speed: f64, profiler: Option<(f64, f64)>| {
        let mut vehicle = Vehicle::driven();
        vehicle.profiles(1.0, 1.0);
        vehicle.says(0x0D);
        vehicle.speed = speed;
        (0..100).for_each(|_| {
            profiler.inspect(|(ahead, starboard)| vehicle.profiles(*ahead, *starboard));
            vehicle.says(0x0D);
        });
        vehicle.course()
    };
    assert_eq!(has_course(0.0, Some((0.0, 0.0))), Some(45.0), "the last one goes on");
    assert_eq!(has_course(0.0, Some((0.0, 0.1))), Some(90.0), "it drifts");
    assert_eq!(has_course(1.5, Some((0.0, 0.0))), None);
    assert_eq!(has_course(0.0, None), None);
    let mut never = Vehicle::driven();
    never.profiles(0.0, 0.0);
    never.says(0x0D);
    assert_eq!(never.course(), Some(0.0), "the heading, where none has come before");
}

/// A navigator is used on a link as in simulation: a gate on what the vehicle tells of its position lets no leap through.
#[test]
fn a_navigator_of_ours_makes_the_position_of_what_the_vehicle_tells() {
    #[derive(Clone, Debug)]
    struct Gated(DeadReckoning);
    impl Navigator for Gated {
        fn predict(&mut self, sensed: &Sensed, time: f64) {
            self.0.predict(sensed, time);
        }
        fn update(&mut self, fix: &Fix) -> bool {
            self.0.update(&Fix { gate: 100.0, ..*fix })
        }
        fn estimate(&self) -> Estimate {
            self.0.estimate()
        }
        fn boxed(&self) -> Box<dyn Navigator> {
            Box::new(self.clone())
        }
    }
    let north = |navigator: Option<Gated>| {
        let mut vehicle = Vehicle::new();
        if let Some(navigator) = navigator {
            vehicle.controller = vehicle.controller.navigated(Box::new(navigator));
        }
        vehicle.speed = 2.0;
        for _ in 0..50 {
            vehicle.profiles(2.0, 0.0);
            vehicle.says(0x01);
        }
        vehicle.snapshot.samples.iter().find(|sample| sample.measurement == POSITION).unwrap().reading[0]
    };
    assert_eq!(north(None), 0.0, "the vehicle says that it stands at the origin");
    let reckoned = north(Some(Gated(DeadReckoning::new(Point::ORIGIN, 0.05))));
    // 49 ticks after the first state; that had no speed before it.
    assert!((reckoned - 9.8).abs() < 1e-6, "{reckoned}");
}
