//! A mission that writes without end: what is written stays small, what is not is counted, and what a run is judged by is kept.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_machine::{LINES_A_TICK_MAX, LINES_AT_ONCE_MAX};
use albacore_session::{Outcome, PICTURE, Plan, Run, Source, load_text};

/// Ticks on which the mission's reactions run: a minute, and the tick on which its end is found.
const TICKS: u64 = 601;

/// A minute northward with more declarations in the mission.
fn run(more: &str) -> Run {
    let text = format!(
        "mission flood in calm within 20 min {{
            area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
            limits {{ altitude >= 2 m, speed <= 2.5 m/s }}
            requires {{ position, course, heading fresh 5 s, else abort }}
            recovery within 5 min {{ goto op.center }}
            with depth 3 m, speed 1.8 m/s
            {more}
            steer north for 1 min
            report \"last\": position
        }}"
    );
    let script = load_text(Source { name: "flood.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{:?}", script.findings);
    let mut run = Run::new(&Plan::new(&script, "flood.alb", None, None).unwrap(), 1).unwrap();
    assert_eq!(run.to_end(), Outcome::Completed);
    run
}

/// The lines of a trace that a verb begins, and what is counted as not written.
fn written(run: &Run, verb: &str) -> (u64, u64) {
    let trace = run.trace().to_string();
    let count = trace.lines().filter(|line| line.contains(&format!(" s  {verb}"))).count() as u64;
    let more = |line: &str| line.strip_suffix(" more not written")?.rsplit(' ').next()?.parse::<u64>().ok();
    (count, trace.lines().filter_map(more).sum())
}

#[test]
fn what_is_logged_too_fast_is_counted() {
    let run = run("on true { for n in 1..10000 { log \"n = {n}\" } }");
    let (logged, more) = written(&run, "log");
    assert_eq!(logged + more, 10_000 * TICKS, "nothing is lost in silence");
    let most = LINES_AT_ONCE_MAX + TICKS as i64 * LINES_A_TICK_MAX;
    assert!(logged <= most as u64, "{logged} lines");
    assert!(logged > LINES_AT_ONCE_MAX as u64, "it goes on after a while");
}

#[test]
fn what_is_logged_on_every_tick_is_written() {
    assert_eq!(written(&run("on true { log \"{position}\" }"), "log"), (TICKS, 0));
}

#[test]
fn a_long_text_counts_as_several_lines_and_is_cut() {
    let run = run("memory places: [Point; 1024]
            on true { for n in 1..100 { places.insert(position) } }
            on true { log \"{places}\" }");
    let trace = run.trace().to_string();
    assert!(trace.len() < 400_000, "{} bytes", trace.len());
    assert!(trace.lines().all(|line| line.len() < 11_000), "a line that nobody can read");
}

/// Tests and campaigns ask for the first report of a name, and whether there was one.
#[test]
fn the_first_report_of_each_place_is_always_written() {
    let run = run("on true { for n in 1..5000 { report \"many\": n } }");
    let (reported, more) = written(&run, "report");
    assert_eq!(reported + more, 5_000 * TICKS + 1);
    let summary = run.summary(0.0);
    assert_eq!(summary.reports.len() as u64, reported);
    assert_eq!(summary.reports[0].t_s, 0.1);
    assert!(summary.reports.iter().any(|report| report.name == "last" && report.t_s > 60.0), "the last is a first");
}

#[test]
fn the_picture_of_many_reports_is_small() {
    let svg = run("on true { for n in 1..100 { report \"here\": op.center + n * 1 m toward (north + n * 10 deg) } }")
        .file(&PICTURE);
    assert!(svg.len() < 60_000, "{} bytes", svg.len());
    assert!(svg.contains("more reports, in the trace"));
}
