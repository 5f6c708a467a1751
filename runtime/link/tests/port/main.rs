//! The vehicle at the end of a link as a run sees it: through the port, with a wire and a clock of the test's own.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

mod wire;

use albacore_front_seat::Handover;
use albacore_geometry::{Geodetic, Heading, Point, TangentFrame};
use albacore_link::{LinkVehicle, Route, Server, Url, recon};
use albacore_sim::{Scenario, Simulator, VehicleSetup};
use albacore_vehicle::{Command, Control, Snapshot, Vehicle, Vertical};
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;
use wire::{Desk, STOPPED, STOPPING, TICK, Wire};

fn vehicle() -> (LinkVehicle, Arc<Wire>) {
    answering(Handover::default())
}

fn answering(handover: Handover) -> (LinkVehicle, Arc<Wire>) {
    let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
    let hull = VehicleSetup { depth: 3.0, ..VehicleSetup::default() };
    let simulator = Simulator::new(&Scenario { vehicle: hull, ..Scenario::default() }, 1).unwrap();
    let start = (Point::ORIGIN, Heading::NORTH);
    let far_end = Server::new(recon::server(), simulator, frame, &Route::default(), start, Vertical::Depth(3.0))
        .answering(handover);
    let wire = Arc::new(Wire::default());
    let desk = Desk {
        wire: Arc::clone(&wire),
        far_end,
        to_vehicle: Vec::new(),
        under_way: VecDeque::new(),
        from_vehicle: VecDeque::new(),
        ticked: Duration::ZERO,
    };
    let clock = Arc::clone(&wire);
    STOPPED.set(Arc::clone(&wire));
    let url = Url { dialect: &STOPPING, ..Url::parse("serial:/dev/desk?dialect=recon").unwrap() };
    (LinkVehicle::new(url, Box::new(desk), frame, 1.0, Box::new(move || clock.now.get())).unwrap(), wire)
}

const AHEAD: Command = Command::new(Heading::NORTH, 2.0, Vertical::Depth(5.0));

/// A vehicle that is driven.
fn driven() -> (LinkVehicle, Arc<Wire>, Snapshot) {
    driven_with_delay(0)
}

/// A vehicle that is driven, and is heard so many ticks late.
fn driven_with_delay(delay: u32) -> (LinkVehicle, Arc<Wire>, Snapshot) {
    let (mut vehicle, wire) = vehicle();
    wire.delay.set(TICK * delay);
    let mut snapshot = Snapshot::default();
    vehicle.sense(&mut snapshot).unwrap();
    assert_eq!(snapshot.control, Control::Monitoring);
    vehicle.take_over().unwrap();
    for _ in 0..20 + delay {
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.command(&AHEAD).unwrap();
    }
    assert_eq!(snapshot.control, Control::InControl);
    (vehicle, wire, snapshot)
}

#[test]
fn the_release_is_the_last_that_is_sent() {
    let (mut vehicle, wire, _) = driven();
    vehicle.release().unwrap();
    let sent = wire.sent.borrow();
    assert!(sent.contains("#E,1,*1B\n") && sent.contains("#C,Depth,Depth,5.00,"), "{sent}");
    assert!(sent.ends_with("#E,0,*1A\n"), "{sent}");
}

#[test]
fn a_guest_gives_control_back_listens_on_and_may_have_it_again() {
    let (mut vehicle, wire, mut snapshot) = driven();
    vehicle.give_back().unwrap();
    let controls: Vec<Control> = (0..20)
        .map(|_| {
            vehicle.sense(&mut snapshot).unwrap();
            snapshot.control
        })
        .collect();
    assert!(controls.iter().all(|control| *control == Control::Monitoring), "{controls:?}");
    assert!(snapshot.samples.len() > 3, "it hears on");
    let sent = wire.sent.take();
    assert!(sent.ends_with("#E,0,*1A\n") && sent.matches("#E,0").count() < 5, "{sent}");
    vehicle.take_over().unwrap();
    (0..10).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
    assert_eq!(snapshot.control, Control::InControl);
}

#[test]
fn a_vehicle_that_falls_silent_while_a_guest_looks_on_is_lost() {
    let (mut vehicle, wire, mut snapshot) = driven();
    vehicle.give_back().unwrap();
    (0..20).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
    wire.silent.set(true);
    vehicle.sense(&mut snapshot).unwrap();
    assert_eq!(snapshot.control, Control::TimedOut);
}

#[test]
fn a_vehicle_that_falls_silent_before_it_lets_us_drive_or_after_it_refused_is_lost() {
    let silent = Handover { silent: true, ..Handover::default() };
    for (ticks, then) in [(20, Control::Requesting), (400, Control::Refused)] {
        let (mut vehicle, wire) = answering(silent.clone());
        let mut snapshot = Snapshot::default();
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.take_over().unwrap();
        (0..ticks).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        assert_eq!(snapshot.control, then);
        vehicle.notices();
        wire.silent.set(true);
        vehicle.sense(&mut snapshot).unwrap();
        assert_eq!(snapshot.control, Control::TimedOut);
        let told = vehicle.notices().join("; ");
        assert!(told.contains("no state (`#S`) with a running clock came from") && told.contains("for 5 s"), "{told}");
    }
}

#[test]
fn a_vehicle_that_falls_silent_while_we_drive_is_lost_after_five_seconds() {
    let (mut vehicle, wire, mut snapshot) = driven();
    let since = wire.now.get();
    wire.silent.set(true);
    vehicle.sense(&mut snapshot).unwrap();
    assert_eq!((snapshot.control, snapshot.samples.len()), (Control::TimedOut, 0));
    assert_eq!(wire.now.get() - since, Duration::from_secs(5));
    assert!(vehicle.notices().iter().any(|n| n.contains("for 5 s")));
    let error = vehicle.sense(&mut snapshot).unwrap_err().to_string();
    assert!(error.contains("before the mission began"), "who goes on all the same waits in vain: {error}");
    let error = vehicle.release().unwrap_err().to_string();
    assert!(error.contains("did not say that it has taken control back"), "{error}");
    assert!(wire.now.get() - since < Duration::from_secs(9), "and the release is not waited for for ever");
}

#[test]
fn silence_before_we_drive_is_an_error_that_says_what_to_look_at() {
    let (mut vehicle, wire) = vehicle();
    wire.silent.set(true);
    let error = vehicle.sense(&mut Snapshot::default()).unwrap_err().to_string();
    assert!(error.contains("nothing came from `serial:/dev/desk?dialect=recon` in 5 s"), "{error}");
    assert!(error.contains("57600 baud") && error.contains("the cable"), "{error}");
    assert!(vehicle.release().is_ok(), "nothing was taken");
    let sent = wire.sent.borrow();
    assert_eq!((sent.matches("#V,albacore").count(), sent.matches('#').count()), (5, 5), "greetings only: {sent}");
}

#[test]
fn a_vehicle_that_does_not_hear_us_refuses() {
    let (mut vehicle, wire) = vehicle();
    let mut snapshot = Snapshot::default();
    vehicle.sense(&mut snapshot).unwrap();
    wire.deaf.set(true);
    vehicle.take_over().unwrap();
    for _ in 0..303 {
        vehicle.sense(&mut snapshot).unwrap();
    }
    assert_eq!(snapshot.control, Control::Refused);
}

#[test]
fn a_line_that_is_cut_is_an_error_and_who_comes_back_is_given_back() {
    let (mut vehicle, wire, mut snapshot) = driven();
    wire.cut.set(5);
    let error = vehicle.sense(&mut snapshot).unwrap_err().to_string();
    assert_eq!(error, "the line is gone: plug it in");
    vehicle.release().unwrap();
    assert!(wire.sent.borrow().ends_with("#E,0,*1A\n"));
}

#[test]
fn what_is_no_number_is_not_sent() {
    let (mut vehicle, wire, _) = driven();
    let before = wire.sent.borrow().len();
    assert!(vehicle.command(&Command { speed: f64::NAN, ..AHEAD }).is_err());
    assert!(vehicle.command(&Command { vertical: Vertical::Altitude(f64::INFINITY), ..AHEAD }).is_err());
    assert_eq!(wire.sent.borrow().len(), before);
}

/// Who drives, by turns, when somebody asks after a second and commands as long as he may: each with the tick on which it begins.
fn turns(handover: Handover, ticks: u32) -> Vec<(u32, Control)> {
    let (mut vehicle, _) = answering(handover);
    let (mut snapshot, mut turns) = (Snapshot::default(), Vec::new());
    for tick in 0..ticks {
        vehicle.sense(&mut snapshot).unwrap();
        if turns.last().is_none_or(|(_, last)| *last != snapshot.control) {
            turns.push((tick, snapshot.control));
        }
        if matches!(snapshot.control, Control::Released | Control::Refused) {
            break;
        }
        if tick == 10 {
            vehicle.take_over().unwrap();
        }
        if snapshot.control == Control::InControl {
            vehicle.command(&AHEAD).unwrap();
        }
    }
    turns
}

/// The simulator's own computer answers so without a link (`tests/rules/water/guest.alb`).
#[test]
fn the_front_seat_answers_as_its_scenario_says() {
    use Control::{InControl, Monitoring, Offered, Refused, Released, Requesting, Suspended};
    let handover = Handover::default();
    for (handover, expected) in [
        (handover.clone(), &[Monitoring, InControl][..]),
        (Handover { after: 2.0, ..handover.clone() }, &[Monitoring, Requesting, InControl]),
        (Handover { refuses: true, ..handover.clone() }, &[Monitoring, Requesting, Refused]),
        (Handover { silent: true, ..handover.clone() }, &[Monitoring, Requesting, Refused]),
        (
            Handover { suspends: Some(4.0), lasting: Some(2.0), ..handover.clone() },
            &[Monitoring, InControl, Suspended, InControl],
        ),
        (Handover { takes_back: Some(5.0), ..handover.clone() }, &[Monitoring, InControl, Released]),
        (Handover { offers: Some(0.5), ..handover.clone() }, &[Monitoring, Offered, InControl]),
    ] {
        let turns = turns(handover.clone(), 400);
        let controls: Vec<Control> = turns.iter().map(|(_, control)| *control).collect();
        assert_eq!(controls, expected, "{handover:?}: {turns:?}");
        let driven = turns.iter().find(|(_, control)| *control == InControl);
        if handover.after > 0.0 {
            assert!(driven.is_some_and(|(tick, _)| (30..36).contains(tick)), "{turns:?}");
        }
    }
}

/// What it offers again, who gave it back has seen it take.
#[test]
fn a_vehicle_that_offers_takes_control_back_before_it_offers_again() {
    let (mut vehicle, _) = answering(Handover { offers: Some(0.5), ..Handover::default() });
    let mut snapshot = Snapshot::default();
    for _ in 0..2 {
        (0..100).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        assert_eq!(snapshot.control, Control::Offered);
        vehicle.take_over().unwrap();
        (0..10).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        assert_eq!(snapshot.control, Control::InControl);
        vehicle.give_back().unwrap();
        (0..10).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        assert_eq!(snapshot.control, Control::Monitoring);
    }
    vehicle.take_over().unwrap();
    (0..10).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
    vehicle.release().unwrap();
}

/// The commands of the ticks that came while nobody looked, and of the next: each asks for a heading of its own. The vehicle is heard
/// so many ticks late from the first on, or from when it is driven.
fn after_a_pause(ticks: u32, room: usize, (delay, later): (u32, u32)) -> Vec<(Control, String)> {
    let (mut vehicle, wire, mut snapshot) = driven_with_delay(delay);
    wire.delay.set(TICK * (delay + later));
    // The vehicle has taken up what it was asked for: nothing has to be said again.
    (0..60).for_each(|_| {
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.command(&AHEAD).unwrap();
    });
    wire.room.set(room);
    said_after_a_pause(&mut vehicle, &wire, ticks)
}

/// What is said in each tick after a pause of so many, until the vehicle has left.
fn said_after_a_pause(vehicle: &mut LinkVehicle, wire: &Wire, ticks: u32) -> Vec<(Control, String)> {
    let mut snapshot = Snapshot::default();
    wire.now.set(wire.now.get() + TICK * ticks);
    wire.sent.take();
    let mut said = Vec::new();
    for i in 0..ticks + 30 {
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.command(&Command { heading: Heading::from_degrees(f64::from(i)), ..AHEAD }).unwrap();
        said.push((snapshot.control, wire.sent.take()));
        if snapshot.control == Control::Released {
            break;
        }
    }
    said
}

#[test]
fn after_a_pause_the_newest_command_alone_is_sent() {
    let said = after_a_pause(40, 0, (0, 0));
    let late = said.iter().take_while(|(_, sent)| sent.is_empty()).count();
    assert!((38..=41).contains(&late), "{late} late ticks in silence: {said:?}");
    let newest = &said[late].1;
    assert!(newest.starts_with(&format!("#C,Heading,Goal,{late}.0,")) && newest.lines().count() == 1, "{newest}");
    assert!(said.iter().all(|(control, _)| *control == Control::InControl));
}

/// The attack: what a pause of ours adds to a mark that comes back after it is no delay of the link. Where it was taken for one, the
/// silence went on for as long again, and the vehicle left.
#[test]
fn a_pause_on_a_slow_link_is_as_long_as_it_is() {
    for delay in [(0, 1), (0, 5), (0, 10), (1, 0), (5, 0), (10, 0)] {
        let said = after_a_pause(30, 0, delay);
        assert!(said.iter().all(|(control, _)| *control == Control::InControl), "{delay:?}");
        let late = said.iter().take_while(|(_, sent)| sent.is_empty()).count();
        assert!(late <= 32 + (delay.0 + delay.1) as usize, "{delay:?}: {late} late ticks in silence");
    }
}

#[test]
fn after_a_pause_nothing_is_sent_to_a_vehicle_that_has_left_override() {
    // It leaves who is silent for 5 s.
    // ... and of which the system may have kept what it said before that alone.
    // ... or what it said before that may be under way still, as all that it says may be.
    let kept = [5000, 2000, 400].map(|room| (60, room, (0, 0)));
    let late = [(0, 0), (0, 5), (0, 18), (3, 0), (9, 0), (18, 0)];
    let late = late.into_iter().flat_map(|delay| [53, 60, 66].map(|ticks| (ticks, 0, delay)));
    for (ticks, room, delay) in kept.into_iter().chain(late) {
        let said = after_a_pause(ticks, room, delay);
        assert_eq!(said.last().unwrap().0, Control::Released, "{ticks}, {room}, {delay:?}");
        assert!(said.iter().all(|(_, sent)| sent.is_empty()), "{ticks}, {room}, {delay:?}: {said:?}");
    }
}

/// The attack: before any heading has come back nobody knows how old what comes is, and what was said before a pause that began
/// with the question for control was taken for the vehicle's word after it.
#[test]
fn a_pause_that_begins_with_the_question_for_control_is_a_pause() {
    let asked = |ticks: u32, delay: u32| {
        let (mut vehicle, wire) = vehicle();
        wire.delay.set(TICK * delay);
        let mut snapshot = Snapshot::default();
        (0..delay + 2).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        vehicle.take_over().unwrap();
        (0..3).for_each(|_| vehicle.sense(&mut snapshot).unwrap());
        said_after_a_pause(&mut vehicle, &wire, ticks)
    };
    for (ticks, delay) in [55, 60, 66].into_iter().flat_map(|ticks| [(ticks, 5), (ticks, 9), (ticks, 18)]) {
        let said = asked(ticks, delay);
        let spoken = said.iter().any(|(_, sent)| sent.contains("#C,"));
        assert!(!spoken, "{ticks}, {delay}: {said:?}");
    }
    let said = asked(20, 9);
    assert!(said.iter().any(|(_, sent)| sent.contains("#C,Heading")), "a short one is got over: {said:?}");
}

/// A run under load was stopped between what it had heard and what it said of it: that was sent as soon as it went on.
#[test]
fn what_was_to_be_said_before_a_pause_is_not_said_after_it() {
    let (mut vehicle, wire, mut snapshot) = driven();
    let mut headings = (0..).map(|degrees| Command { heading: Heading::from_degrees(f64::from(degrees)), ..AHEAD });
    wire.stop.set(TICK * 60);
    while wire.stop.get() > Duration::ZERO {
        vehicle.sense(&mut snapshot).unwrap();
        wire.sent.take();
        vehicle.command(&headings.next().unwrap()).unwrap();
    }
    assert_eq!(wire.sent.take(), "");
    while snapshot.control == Control::InControl {
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.command(&headings.next().unwrap()).unwrap();
    }
    assert_eq!((snapshot.control, wire.sent.take().as_str()), (Control::Released, ""));
}

/// What was not said is said when it is known that the vehicle still hears us.
#[test]
fn a_pause_while_we_speak_costs_no_more_than_itself() {
    let (mut vehicle, wire, mut snapshot) = driven();
    let east = Command { heading: Heading::from_degrees(90.0), ..AHEAD };
    wire.stop.set(TICK * 20);
    for _ in 0..40 {
        vehicle.sense(&mut snapshot).unwrap();
        vehicle.command(&east).unwrap();
    }
    assert!(wire.sent.take().contains("#C,Heading,Goal,90"));
    assert_eq!(snapshot.control, Control::InControl);
}

#[test]
fn a_pause_of_ours_is_no_silence_of_the_vehicle() {
    let (mut vehicle, wire, mut snapshot) = driven();
    wire.silent.set(true);
    wire.now.set(wire.now.get() + Duration::from_secs(60));
    vehicle.ready().unwrap();
    wire.silent.set(false);
    while snapshot.control == Control::InControl {
        vehicle.sense(&mut snapshot).unwrap();
    }
    assert_eq!(snapshot.control, Control::Released, "it was heard again: {:?}", vehicle.notices());
}

/// What is told of a computer that takes so long to compute each tick, or every second one, until the vehicle has left it.
fn computing(ticks: [Duration; 2]) -> Vec<String> {
    let (mut vehicle, wire, mut snapshot) = driven();
    vehicle.notices();
    let mut told = Vec::new();
    for tick in (0..1000).map(|i| ticks[i % 2]) {
        vehicle.sense(&mut snapshot).unwrap();
        told.extend(vehicle.notices());
        if snapshot.control == Control::Released {
            return told;
        }
        wire.now.set(wire.now.get() + tick);
        vehicle.command(&AHEAD).unwrap();
        told.extend(vehicle.notices());
    }
    told.push("it has not left".to_string());
    told
}

/// The attack: all that was told was that the vehicle had left.
#[test]
fn a_computer_that_is_too_slow_is_told_why_the_vehicle_leaves() {
    let ms = Duration::from_millis;
    let left = "the vehicle has left override by itself: the commands of its last ";
    // Nor is the vehicle's clock to blame.
    for (ticks, mean) in [([150, 150], "0.15"), ([300, 300], "0.30"), ([2000, 2000], "2.00"), ([301, 19], "0.16")] {
        let told = computing(ticks.map(ms));
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(
            told[0].starts_with("a tick takes ") && told[0].contains(" s to compute here, and lasts 0.10 s"),
            "{told:?}"
        );
        assert!(told[0].contains("`albacore check --cost`"), "{told:?}");
        let because = format!("came too late to be sent: a tick takes {mean} s to compute here");
        assert!(told[1].starts_with(left) && told[1].contains(&because), "{told:?}");
    }
    let quick = computing([ms(60), ms(90)]);
    assert_eq!(quick, ["it has not left"]);
}
