//! Who drives, as the controller concludes it from mode bytes that no front seat of ours sends.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

mod clock;
mod goals;
mod senses;
mod vehicle;

use albacore_geometry::Heading;
use albacore_link::recon::seal;
use albacore_vehicle::{Command, Control};
use std::time::Duration;
use vehicle::Vehicle;

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
