//! What a payload answers is a part of the run: the same seed gives the same answers, and a machine that is fed with a journal does the same again.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use crate::sink::Sink;
use albacore_machine::{Event, Heard, Machine};
use albacore_session::{Outcome, Plan, PlanError, Run, Script, Source, load_text};
use albacore_trace::journal::Journal;
use std::sync::Arc;

/// A minute northward, beside which a camera is asked once a second, and answers as it likes.
const ASKS: &str = "
payload camera { shoot() -> Bool }

overlay pictures {
    loop { ask camera.shoot() within 500 ms; wait for 500 ms }
}

mission asks in moody within 10 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s, pictures()
    steer north for 2 min
}

scenario moody = calm with { payload(\"camera\", after: 200 ms, refuses: 30 %, silent: 30 %) }
";

fn script(text: &str) -> Script {
    let script = load_text(Source { name: "asks.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:?}", script.findings);
    script
}

fn journal(seed: u64) -> (Plan, Journal) {
    let plan = Plan::new(&script(ASKS), "asks.alb", None, None).unwrap();
    let sink = Sink::default();
    let mut run = Run::new(&plan, seed).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    assert_eq!(run.to_end(), Outcome::Completed);
    let journal = Journal::read(&sink.bytes()).unwrap();
    (plan, journal)
}

fn heard(journal: &Journal) -> Vec<Heard> {
    let events = journal.ticks.iter().flat_map(|record| &record.events);
    events.filter_map(|event| if let Event::Answered(_, heard) = event { Some(*heard) } else { None }).collect()
}

#[test]
fn a_machine_fed_with_the_answers_does_the_same_again() {
    let (plan, journal) = journal(1);
    let all = heard(&journal);
    for kind in [Heard::Value(true), Heard::Refused, Heard::Nothing] {
        let count = all.iter().filter(|heard| **heard == kind).count();
        assert!(count > all.len() / 6, "{kind:?}: {count} of {}", all.len());
    }
    let mut machine = Machine::new(Arc::clone(&plan.program), &journal.header.measurements).unwrap();
    for record in &journal.ticks {
        assert_eq!(machine.step(&record.snapshot), record.command, "tick {}", record.tick);
        assert_eq!(machine.events(), record.events, "tick {}", record.tick);
    }
}

#[test]
fn the_seed_tells_what_is_answered() {
    let [first, again, other] = [1, 1, 2].map(|seed| heard(&journal(seed).1));
    assert_eq!(first, again);
    assert_ne!(first, other);
}

/// The dialects have no message for it: it is said before a vehicle is called.
#[test]
fn a_mission_that_asks_is_refused_on_a_link() {
    let refused = Plan::on_link(&script(ASKS), "asks.alb", None, "udp:vehicle:1?dialect=recon");
    let Err(PlanError::Asked(message, Some(_))) = refused else { unreachable!("it is refused") };
    assert_eq!(message, "the mission `asks` asks `camera.shoot` of a payload, and no link carries that");
    let silent = ASKS.replace("ask camera.shoot() within 500 ms; ", "");
    assert!(Plan::on_link(&script(&silent), "asks.alb", None, "udp:vehicle:1?dialect=recon").is_ok());
}
