//! A mission that waits for the first sample of what it requires: what is commanded meanwhile, and that it then begins. In the
//! simulator every sensor speaks at once, so the samples are given by hand.

use albacore_machine::{Event, Machine};
use albacore_session::{Plan, load};
use albacore_vehicle::{Command, Control, Measurement, Snapshot, Vertical};
use std::path::Path;

/// The measurements that the test speaks on.
const HEADING: u16 = 0;
const DEPTH: u16 = 1;
const FLOW: u16 = 2;

#[test]
fn it_keeps_still_until_the_last_input_has_come_and_then_begins() {
    let path = Path::new("tests/rules/17_limit_while_awaiting.alb");
    let plan = Plan::new(&load(path, None, &[]).unwrap(), &path.display().to_string(), None, None).unwrap();
    let measurement = |name: &str, width| Measurement { name: name.into(), width };
    let measurements = [measurement("heading", 1), measurement("depth", 1), measurement("flow", 2)];
    let mut machine = Machine::new(plan.program, &measurements).unwrap();
    let mut tick = |samples: &[(u16, &[f64])]| -> (Option<Command>, Vec<Event>) {
        let mut snapshot = Snapshot { control: Control::InControl, ..Snapshot::default() };
        samples.iter().for_each(|(measurement, numbers)| snapshot.push(*measurement, numbers));
        (machine.step(&snapshot), machine.events().to_vec())
    };
    let begun = |events: &[Event]| events.iter().any(|e| matches!(e, Event::Entered(_)));

    // Nothing is known of the vehicle: nothing can be asked of it.
    let (command, events) = tick(&[]);
    assert_eq!(command, None);
    assert!(events.iter().any(|e| matches!(e, Event::Awaited(_))));
    // The first depth may be wrong: nothing is asked before a second one agrees.
    assert_eq!(tick(&[(HEADING, &[1.5]), (DEPTH, &[11.0])]), (None, Vec::new()));
    assert_eq!(tick(&[(DEPTH, &[4.0])]), (None, Vec::new()));
    // What it does already, at no speed.
    let (command, events) = tick(&[(DEPTH, &[4.0])]);
    let command = command.unwrap();
    assert_eq!((command.heading.radians(), command.speed, command.vertical), (1.5, 0.0, Vertical::Depth(4.0)));
    assert!(events.is_empty(), "{events:?}");
    // What is asked is asked until then, though the vehicle sinks, and anew when its depth leaps.
    let vertical = |depth: f64, (command, _): (Option<Command>, Vec<Event>)| {
        assert_eq!(command.unwrap().vertical, Vertical::Depth(depth))
    };
    vertical(4.0, tick(&[(DEPTH, &[4.5])]));
    assert_eq!(tick(&[(DEPTH, &[9.0])]), (None, Vec::new()));
    vertical(9.0, tick(&[(DEPTH, &[9.0])]));
    // It begins on the tick of the sample.
    let (command, events) = tick(&[(FLOW, &[0.1, 0.0])]);
    assert!(command.is_some() && begun(&events), "{events:?}");
}
