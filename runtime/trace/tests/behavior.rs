//! The behavior trace, and when two of them tell of the same behavior.

use albacore_geometry::{Heading, Point};
use albacore_machine::{Event, Outcome};
use albacore_program::*;
use albacore_trace::{BehaviorTrace, Digest, Header, Release, first_difference, same_behavior};
use albacore_vehicle::Control;

const MISSION: u32 = 0;
const CAGE: u32 = 1;
const TRACE_PLUME: u32 = 2;
const FIND: u32 = 3;
const TRACK_IN: u32 = 4;
const FIX: u32 = 5;
const SEARCH: u32 = 6;

fn activity(name: &str, kind: ActivityKind, body: Body) -> Activity {
    Activity {
        name: name.into(),
        place: "cpt.alb:1".into(),
        kind,
        header: 0,
        entry: 0,
        refresh: 0,
        aborts: vec![],
        reactions: 0,
        body,
        overlays: vec![],
        result: None,
    }
}

fn rule(text: &str, line: u32, target: Target, back: bool) -> Rule {
    Rule { text: text.into(), place: format!("cpt.alb:{line}"), target, back, effect: None }
}

fn exit(rule: u32, watched: &[(&str, Shape)]) -> Exit {
    let code = Code { entry: 0, value: 0 };
    let watched = watched
        .iter()
        .map(|(name, shape)| WatchedCode { name: name.to_string(), code, shape: shape.clone() })
        .collect();
    Exit { rule, guard: code, guard_done: None, watched, terms: None, terms_done: None }
}

/// A mission with a cage that calls a strategy of three behaviors, the first of which calls another.
fn program(first_line: u32) -> Program {
    use ActivityKind::*;
    let percent = Shape::Quantity(Display { unit: "%".into(), scale: 0.01, decimals: 1 });
    let sequence = Body::Sequence(0);
    let entry = |activity, exits| Entry { activity, arm: 0, watch: 0, exits };
    let table = Table {
        start: 0,
        behaviors: vec![
            entry(FIND, vec![exit(0, &[("detection", Shape::Bool), ("chemical.peak", percent)]), exit(3, &[])]),
            entry(TRACK_IN, vec![exit(1, &[]), exit(2, &[("at", Shape::Point)])]),
            entry(FIX, vec![]),
        ],
    };
    let valued = |shape| Valued { slot: 0, shape };
    Program {
        activities: vec![
            activity("duck_single", Mission, sequence.clone()),
            activity("cage", AmendsCourse, sequence.clone()),
            activity("trace_plume", Strategy, Body::Table(table)),
            activity("find", Behavior, sequence.clone()),
            activity("track_in", Behavior, sequence.clone()),
            activity("fix", Behavior, sequence.clone()),
            activity("search.find", Behavior, sequence),
        ],
        rules: vec![
            rule("-> track_in on detection", first_line, Target::Behavior(1), false),
            rule("-> find on done", first_line + 1, Target::Behavior(0), false),
            rule("-> finish last on after 5 min", first_line + 2, Target::Finish(None), false),
            rule("-> fix on becomes position.sigma > 15 m then back", first_line + 3, Target::Behavior(2), true),
        ],
        memories: vec![Watched { name: "lhs".into(), value: valued(Shape::Int) }],
        reports: vec![ReportSite {
            name: "source".into(),
            fields: vec![(String::new(), valued(Shape::Point)), ("at_edge".into(), valued(Shape::Bool))],
        }],
        inputs: vec![Input { name: "chemical".into(), at: 0, width: 1, kept: 0, shape: Shape::Int, fields: vec![] }],
        ..Program::default()
    }
}

fn header() -> Header {
    Header { mission: "duck_single".into(), scenario: "duck_2003".into(), seed: 7, tick_s: 0.1 }
}

/// A run with every kind of event in it, everything shifted by some metres.
fn run(program: &Program, shift: f64) -> BehaviorTrace {
    let mut trace = BehaviorTrace::new(program, &header());
    let at = |n: f64, e: f64| Some(Point::new(n + shift, e));
    let heading = Some(Heading::from_degrees(291.0));
    let switched = |rule, from, exit, values: &[f64]| Event::Switched { rule, from, exit, values: values.to_vec() };
    let steps: Vec<(u64, Option<Point>, Vec<Event>)> = vec![
        (0, at(0.0, 0.0), vec![Event::Control(Control::InControl), Event::Entered(MISSION), Event::Entered(CAGE)]),
        (962, at(10.0, 5.0), vec![Event::Entered(TRACE_PLUME), Event::Entered(FIND), Event::Entered(SEARCH)]),
        (1000, None, vec![Event::Stale(0), Event::Limited(Channel::Speed, 3.0, 2.6)]),
        (1100, None, vec![Event::Fresh(0), Event::LimitedEnded(Channel::Speed), Event::Logged("two\nlines".into())]),
        (2000, at(-300.0, 100.0), vec![switched(3, FIND, 1, &[]), Event::Suspended(FIND), Event::Entered(FIX)]),
        (2400, at(-301.0, 100.0), vec![Event::Left(FIX, Cause::Done), Event::Resumed(FIND)]),
        (
            4123,
            at(-412.0, 118.4),
            vec![
                switched(0, FIND, 0, &[1.0, 0.052 + shift / 1e4]),
                Event::Left(SEARCH, Cause::Preempted),
                Event::Left(FIND, Cause::Rule),
                Event::Remembered(0, vec![1.0]),
                Event::Entered(TRACK_IN),
            ],
        ),
        (4310, at(-400.0, 110.0), vec![Event::Amending(CAGE, 5.0789, 4.6845)]),
        (4400, at(-390.0, 110.0), vec![Event::AmendingEnded(CAGE)]),
        (
            9000,
            at(410.0, -240.0),
            vec![
                switched(2, TRACK_IN, 1, &[414.2 + shift, -242.1]),
                Event::Left(TRACK_IN, Cause::Rule),
                Event::Left(TRACE_PLUME, Cause::Done),
                Event::Reported(0, vec![414.2 + shift, -242.1, 0.0]),
            ],
        ),
        (9500, at(0.0, 0.0), vec![Event::TimedOut]),
        (9501, at(0.0, 0.0), vec![Event::Aborted("battery at 21 %".into()), Event::Left(MISSION, Cause::Aborted)]),
        (9600, at(0.0, 0.0), vec![Event::Ended(Outcome::Completed)]),
    ];
    for (tick, position, events) in steps {
        trace.tick(tick, position, &events);
        trace.sample(tick, position, heading, Some(2.0));
    }
    trace.finish(Outcome::Completed, Release::Done, 9600, Digest::new().value());
    trace
}

const EXPECTED: &str = "\
mission duck_single  scenario duck_2003  seed 7  tick 0.1 s
    0.0 s  control  in control
    0.0 s  enter    duck_single
    0.0 s  enter      overlay cage
    0.0 s  at       (0.0, 0.0) m           heading 291.0 deg  depth   2.0 m  duck_single
   96.2 s  enter      trace_plume
   96.2 s  enter        find
   96.2 s  enter          search.find
   96.2 s  at       (10.0, 5.0) m          heading 291.0 deg  depth   2.0 m  trace_plume > find > search.find
  100.0 s  stale    chemical
  100.0 s  limit    speed  3.00 m/s -> 2.60 m/s
  110.0 s  fresh    chemical
  110.0 s  limit    speed  no more
  110.0 s  log      two lines
  200.0 s  switch       find -> fix then back  at (-300.0, 100.0) m      cpt.alb:50  on becomes position.sigma > 15 m then back
  200.0 s  at       (-300.0, 100.0) m      heading 291.0 deg  depth   2.0 m  trace_plume > fix
  240.0 s  resume       fix -> find            at (-301.0, 100.0) m
  412.3 s  switch       find -> track_in       at (-412.0, 118.4) m      cpt.alb:47  detection = true, chemical.peak = 5.2 %
  412.3 s  leave          search.find          pre-empted
  412.3 s  memory       lhs = 1
  412.3 s  at       (-412.0, 118.4) m      heading 291.0 deg  depth   2.0 m  trace_plume > track_in
  431.0 s  amend    cage  course 291.0 -> 268.4 deg
  440.0 s  amend    cage  no more
  900.0 s  switch       track_in -> finish     at (410.0, -240.0) m      cpt.alb:49  at = (414.2, -242.1) m
  900.0 s  leave      trace_plume              done
  900.0 s  report   source = (414.2, -242.1) m, at_edge = false
  900.0 s  at       (410.0, -240.0) m      heading 291.0 deg  depth   2.0 m  duck_single
  950.0 s  timeout  the mission's time is up   at (0.0, 0.0) m
  950.1 s  abort    battery at 21 %            at (0.0, 0.0) m
  950.1 s  leave    duck_single                aborted
  960.0 s  end      completed
  960.0 s  at       (0.0, 0.0) m           heading 291.0 deg  depth   2.0 m
  960.0 s  control  released
digest 406c65b315c79af9  9600 ticks
";

#[test]
fn a_run_reads_down_the_page() {
    let trace = run(&program(47), 0.0).to_string();
    assert!(trace == EXPECTED, "the trace is now\n{trace}");
}

#[test]
fn event_lines_are_without_header_samples_and_digest() {
    let trace = run(&program(47), 0.0);
    let switches = trace.switches();
    let left_out: Vec<String> =
        trace.to_string().lines().filter(|line| !switches.contains(line)).map(String::from).collect();
    assert!(
        left_out
            .iter()
            .all(|line| { line.starts_with("mission ") || line.starts_with("digest ") || line.contains(" s  at ") })
    );
    assert!(!switches.contains("digest") && switches.contains("find -> track_in"));
}

#[test]
fn other_numbers_are_the_same_behavior() {
    let (a, b) = (run(&program(47), 0.0), run(&program(47), 3.3));
    assert_ne!(a.switches(), b.switches());
    assert!(same_behavior(&a.to_string(), &b.to_string()));
    assert!(same_behavior(&a.to_string(), &b.switches()), "with or without samples");
}

#[test]
fn a_rule_that_moved_down_the_file_is_still_the_same_rule() {
    assert!(same_behavior(&run(&program(47), 0.0).switches(), &run(&program(50), 0.0).switches()));
}

#[test]
fn another_switch_another_rule_and_a_missing_end_are_other_behavior() {
    let a = run(&program(47), 0.0).switches();
    let other_source = a.replace("-> finish", "-> fix   ");
    let difference = first_difference(&a, &other_source).unwrap();
    assert!(difference.left.unwrap().contains("track_in -> finish"));
    assert!(difference.right.unwrap().contains("track_in -> fix"));

    // Twice by one rule is not once by it and once by another.
    let line = a.lines().find(|line| line.contains("find -> track_in")).unwrap();
    let (same, other) = (format!("{line}\n{line}\n"), format!("{line}\n{}\n", line.replace(":47", ":99")));
    assert!(!same_behavior(&same, &other));
    assert!(!same_behavior(&other, &same));

    let cut = a.rsplit_once("  end").unwrap().0;
    assert_eq!(first_difference(&a, cut).unwrap().right, None);
    assert!(!same_behavior(&a, &a.replace("pre-empted", "done")), "the cause of leaving counts");
}

#[test]
fn logs_and_memories_are_no_behavior() {
    let a = run(&program(47), 0.0).switches();
    assert!(same_behavior(&a, &a.replace("two lines", "  412.3 s  switch   a -> b").replace("lhs = 1", "lhs = -1")));
}

#[test]
fn the_end_is_told_once_and_always() {
    let mut trace = BehaviorTrace::new(&program(47), &header());
    trace.finish(Outcome::LinkLost, Release::Failed, 77, Digest::new().value());
    let not_released = "    7.7 s  control  not released: the vehicle could not be told\n";
    assert_eq!(trace.switches(), format!("    7.7 s  end      link_lost\n{not_released}"));
    assert_eq!(run(&program(47), 0.0).to_string().matches("completed").count(), 1);
}

#[test]
fn what_a_vehicle_gives_notice_of_is_a_line_and_no_behavior() {
    let mut trace = BehaviorTrace::new(&program(47), &header());
    trace.vehicle(42, "error 107,\nIllegal depth");
    assert_eq!(trace.switches(), "    4.2 s  vehicle  error 107, Illegal depth\n");
    assert!(same_behavior(&trace.switches(), ""));
}

#[test]
fn samples_come_at_their_interval_and_can_be_turned_off() {
    let count = |every: u64| {
        let mut trace = BehaviorTrace::new(&program(47), &header()).with_samples_every(every);
        (0..3001).for_each(|tick| trace.sample(tick, None, None, None));
        trace.to_string().lines().count() - 1
    };
    assert_eq!([count(600), count(1000), count(0)], [6, 4, 0]);
}

/// The machine may tell of leavings before or after the switch that caused them.
#[test]
fn a_switch_says_what_it_implies_whatever_the_order() {
    let mut trace = BehaviorTrace::new(&program(47), &header());
    let switched = Event::Switched { rule: 1, from: TRACK_IN, exit: 0, values: vec![] };
    let entered = [Event::Entered(TRACK_IN)];
    trace.tick(0, None, &entered);
    trace.tick(1, None, &[Event::Left(TRACK_IN, Cause::Done), switched, Event::Entered(FIND)]);
    assert_eq!(trace.switches().lines().count(), 2);
    assert!(trace.switches().contains("track_in -> find"));
    assert!(trace.switches().contains("cpt.alb:48  on done"), "{}", trace.switches());
}

#[test]
fn events_of_no_such_program_are_no_reason_to_fail() {
    let mut trace = BehaviorTrace::new(&Program::default(), &header());
    let events = [
        Event::Entered(9),
        Event::Switched { rule: 9, from: 9, exit: 9, values: vec![1.0] },
        Event::Left(9, Cause::Until),
        Event::Suspended(8),
        Event::Resumed(8),
        Event::Remembered(9, vec![]),
        Event::Reported(9, vec![]),
        Event::Stale(9),
        Event::Amending(9, f64::NAN, 0.0),
    ];
    trace.tick(0, None, &events);
    assert!(trace.switches().contains("switch   ? -> ?"), "{}", trace.switches());
}
