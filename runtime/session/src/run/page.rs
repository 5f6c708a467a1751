//! The way from a driver to what keeps records in memory: a queue that has a bound, and what finds no room in it is counted. And the
//! thread that keeps the report of a run that goes on.

use super::live::WAITING_BYTES;
use super::queue::{Feed, Intake, queue};
use crate::report::live::LiveReport;
use crate::threads::thread;
use albacore_trace::{Step, TickRecord};
use std::io;
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

/// How long one look for a record takes.
const LOOK: Duration = Duration::from_millis(200);

/// A record, and how many ticks before it found no room.
pub(super) type Counted = (u64, Arc<TickRecord>);

/// The end of the way at which records are handed on.
pub(super) struct Kept {
    feed: Feed<Counted>,
    /// Ticks since the last that found room.
    unseen: u64,
}

impl Kept {
    pub fn new(feed: Feed<Counted>) -> Self {
        Kept { feed, unseen: 0 }
    }

    /// Hands a record on, if there is room; the end finds room always.
    pub fn hand(&mut self, bytes: usize, record: &Arc<TickRecord>) {
        if record.ending().is_some() || self.feed.has_room(bytes) {
            self.feed.put(bytes, (std::mem::take(&mut self.unseen), Arc::clone(record)));
        } else {
            self.unseen += 1;
        }
    }

    /// The same with a record that its owner keeps.
    pub fn hand_copy(&mut self, record: &TickRecord) {
        if is_empty_wait(record) {
            return;
        }
        let bytes = record.bytes();
        if record.ending().is_some() || self.feed.has_room(bytes) {
            self.hand(bytes, &Arc::new(record.clone()));
        } else {
            self.unseen += 1;
        }
    }
}

/// Whether nothing happened in a step.
pub(super) fn is_empty_wait(record: &TickRecord) -> bool {
    matches!(record.step, Step::Wait) && record.notices.is_empty()
}

/// Begins the thread that keeps a report. It ends when nobody can hand on anything any more.
pub(super) fn begin(report: Arc<LiveReport>) -> io::Result<Kept> {
    let (feed, records) = queue(WAITING_BYTES);
    thread("report").spawn(move || keep(&report, &records))?;
    Ok(Kept::new(feed))
}

fn keep(report: &LiveReport, records: &Intake<Counted>) {
    loop {
        match records.take(LOOK) {
            Ok((unseen, record)) => report.take(unseen, &record),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Kept, queue};
    use crate::{Increment, LiveReport, Plan, Run, Source, load_text};
    use albacore_geometry::Point;
    use albacore_trace::{Ending, Release, Step, TickRecord};
    use std::time::Duration;

    const MISSION: &str = r#"
mission still in calm within 10 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    limits { speed <= 2 m/s }
    with depth 3 m, speed 1 m/s
    steer 0 deg for 3 s
}
"#;

    fn numbers(more: &Increment) -> usize {
        more.parts.series.iter().map(|series| series.values.len()).max().unwrap_or(0)
    }

    fn take(report: &LiveReport, seconds: std::ops::Range<u64>) {
        for second in seconds {
            let believed = Some(Point::new(second as f64, 0.0));
            report.take(0, &TickRecord { tick: 10 * second, step: Step::Tick, believed, ..TickRecord::default() });
        }
    }

    /// Nobody waits for who does not take what is handed on: it is counted, and the end is handed on all the same.
    #[test]
    fn what_finds_no_room_is_counted() {
        let tick = |tick| TickRecord { tick, step: Step::Tick, ..TickRecord::default() };
        let (feed, taken) = queue(2 * tick(0).bytes());
        let mut kept = Kept::new(feed);
        (0..10).for_each(|at| kept.hand_copy(&tick(at)));
        kept.hand_copy(&TickRecord { tick: 10, ..TickRecord::default() });
        let ending = Ending {
            outcome: crate::Outcome::Completed,
            reason: String::new(),
            release: Release::Done,
            trouble: None,
            digest: 0,
        };
        kept.hand_copy(&TickRecord { tick: 10, step: Step::End(ending), ..TickRecord::default() });
        drop(kept);
        let taken: Vec<(u64, u64)> = std::iter::from_fn(|| taken.take(Duration::ZERO).ok())
            .map(|(unseen, record)| (unseen, record.tick))
            .collect();
        assert_eq!(taken, [(0, 0), (0, 1), (8, 10)]);
    }

    /// A run of days has no more numbers than one of hours, and who has been told them is told that there are half as many.
    #[test]
    fn a_long_run_has_numbers_within_bounds() {
        let script = load_text(Source { name: "still.alb".into(), text: MISSION.into() });
        let plan = Plan::new(&script, "still.alb", None, None).unwrap();
        let report = Run::new(&plan, 1).unwrap().watched(&script, &[]).unwrap();
        take(&report, 0..19_999);
        let before = report.since(None);
        assert_eq!((before.every_s, numbers(&before)), (1, 19_999));
        let cursor = before.cursor.parse().ok();
        let nothing_new = report.since(cursor);
        assert_eq!((nothing_new.anew, nothing_new.slot, numbers(&nothing_new)), (false, 19_998, 1));
        take(&report, 19_999..100_000);
        let after = report.since(cursor);
        assert_eq!((after.anew, after.every_s, after.slot, numbers(&after)), (true, 8, 0, 12_501));
        let north = &after.parts.series[0];
        assert_eq!((north.name.as_str(), &north.values[..3]), ("north", &[Some(0), Some(80), Some(80)][..]));
    }
}
