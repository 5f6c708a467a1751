//! A campaign: missions in scenarios with many seeds, on all cores, its results in the order of the seeds.

mod cell;
mod columns;
mod navigation_columns;
mod order;
mod paired;
mod picture;
mod report_columns;
mod statistics;
mod tally;

pub use cell::plain;
pub use columns::{Columns, Row};
pub use order::RowOrder;
pub use paired::{MEDIAN_INTERVAL, PairedDifference, PairedShare, SHARE_INTERVAL, TEST};
pub use picture::{CASES_MAX, CampaignPicture, CasePicture};
pub use report_columns::tells_places;
pub use statistics::{INTERVAL, QUANTILE, Quantiles, Share};
pub use tally::{Missed, Tallies, Tally, WITHIN_M, Within};

use crate::plan::{Plan, PlanError};
use crate::recorders::results::Results;
use crate::run::Driver;
use crate::summary::Summary;
use albacore_program::Program;
use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::Duration;

/// So many runs a thread may be ahead of the oldest that is not over yet: enough that no core waits for a long run, and
/// a bound to what is kept for later.
const AHEAD_PER_THREAD: usize = 32;

/// So long nothing is delivered at most while rows are awaited.
const QUIET: Duration = Duration::from_millis(250);

/// What a campaign delivers.
pub enum Delivery {
    /// The next row.
    Row(Row),
    /// No row: a moment in which what was written before may go to the disk.
    Nothing,
}

/// What is run with each seed: a mission in a scenario, with what a sweep changes of them.
pub struct Case {
    /// The mission and its world.
    pub plan: Plan,
    /// What the sweep changes, a cell for each of its columns.
    pub swept: Vec<String>,
}

/// Cases to be run with many seeds: the same seeds in each.
pub struct Campaign {
    cases: Vec<Case>,
    columns: Columns,
    order: RowOrder,
}

impl Campaign {
    /// A campaign of cases, whose rows begin with the first seed. `swept` names the columns of what a sweep changes; of each report's name
    /// there are columns for so many.
    pub fn new(cases: Vec<Case>, swept: &[String], reports: usize, first_seed: u64) -> Self {
        let is_inertial = |case: &Case| case.plan.scenario.instruments.inertial().is_some();
        let programs: Vec<(&Program, bool)> =
            cases.iter().map(|case| (&*case.plan.program, is_inertial(case))).collect();
        let columns = Columns::new(&programs, swept, reports);
        let order = RowOrder { first_seed, cases: cases.len() as u64 };
        Campaign { cases, columns, order }
    }

    /// The columns of its table.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Its cases.
    pub fn cases(&self) -> &[Case] {
        &self.cases
    }

    /// Runs what rows are of, by their numbers from 0, and delivers them: in the order in which they are given, each as soon as it and all
    /// before it are over, so that the rows do not depend on the number of threads, and some times a second at least nothing. Without
    /// `threads` there is one for each core. Whoever raises `stop`, or breaks off, gets no further row. Gives whether all were delivered.
    pub fn run(
        &self,
        rows: impl Iterator<Item = u64> + Clone,
        threads: Option<usize>,
        stop: &AtomicBool,
        mut deliver: impl FnMut(Delivery) -> ControlFlow<()>,
    ) -> Result<bool, String> {
        let pool = crate::threads::pool(threads);
        let pool = pool.map_err(|error| error.to_string())?;
        let ahead = AHEAD_PER_THREAD * pool.current_num_threads();
        let (sender, receiver) = mpsc::channel();
        let all = pool.in_place_scope(|scope| {
            let start = |number: u64| {
                let sender = sender.clone();
                // Nobody listens any more when the campaign was broken off.
                scope.spawn(move |_| drop(sender.send((number, self.row(number, stop)))));
            };
            let mut later = rows.clone();
            later.by_ref().take(ahead).for_each(&start);
            let mut early: BTreeMap<u64, Option<Row>> = BTreeMap::new();
            for number in rows {
                let row = loop {
                    if let Some(row) = early.remove(&number) {
                        break row;
                    }
                    // `start` holds a sender: there is always someone to hear from.
                    early.extend(receiver.recv_timeout(QUIET).ok());
                    if deliver(Delivery::Nothing).is_break() {
                        stop.store(true, Ordering::Relaxed);
                        return false;
                    }
                };
                let Some(row) = row else { return false };
                if deliver(Delivery::Row(row)).is_break() {
                    stop.store(true, Ordering::Relaxed);
                    return false;
                }
                later.next().into_iter().for_each(&start);
            }
            true
        });
        Ok(all)
    }

    /// The row with a number; `None` when the campaign was stopped before its run's end.
    fn row(&self, number: u64, stop: &AtomicBool) -> Option<Row> {
        let (seed, at) = self.order.run(number);
        let case = self.cases.get(at)?;
        let cells = match contained(|| summary(&case.plan, seed, stop)) {
            Ok(summary) => self.columns.cells(at, &case.swept, &summary?),
            Err(why) => self.columns.failed(at, case, seed, &why),
        };
        Some(Row { number, seed, cells })
    }
}

/// Runs one seed to its end, unless it is stopped.
fn summary(plan: &Plan, seed: u64, stop: &AtomicBool) -> Result<Option<Summary>, String> {
    let (mut driver, start) = Driver::simulated(plan, seed).map_err(|error| match error {
        PlanError::Asked(what, _) => what,
        PlanError::Script(findings, _) => findings.into_iter().map(|f| f.message).collect::<Vec<_>>().join("; "),
    })?;
    let mut results = Results::new(plan, seed, Some(start));
    Ok(driver.fold(&mut results, stop).map(|_| results.summary(0.0)))
}

/// A run that panics has found a fault of the interpreter; that must not cost the other runs of a night.
fn contained<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(format!("panicked: {}", said(panic.as_ref()))))
}

fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no words")
}

#[cfg(test)]
mod tests {
    use super::contained;

    #[test]
    fn a_panic_becomes_a_reason() {
        assert_eq!(contained(|| Ok(7)), Ok(7));
        assert_eq!(contained::<()>(|| panic!("out of water")), Err("panicked: out of water".to_string()));
        assert_eq!(contained::<()>(|| panic!("at {} m", 3)), Err("panicked: at 3 m".to_string()));
    }
}
