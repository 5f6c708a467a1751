//! Goals: when they are sent, and what tells that they are taken up.

use crate::vehicle::Vehicle;
use albacore_geometry::Heading;
use albacore_link::recon::seal;
use albacore_vehicle::{Command, Vertical};

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
