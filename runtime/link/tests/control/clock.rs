//! The vehicle's time stamps: what leaps, and why.

use crate::vehicle::Vehicle;
use albacore_vehicle::Control;
use std::time::Duration;

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
