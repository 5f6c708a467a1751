//! The report of a run: all that a page shows of it, as one value that is folded from the records of its journal.

pub mod data;
mod diagrams;
mod happenings;
pub(crate) mod live;
mod recorder;
mod series;
mod spans;
mod world;

use crate::past::PastRun;
use crate::picture;
use crate::plan::Plan;
use crate::recorders::WorldAtEnd;
use crate::summary::Summary;
use crate::why::explain;
use albacore_lang::Script;
use albacore_program::seen::one_line;
use albacore_trace::journal::{Ending, Reader, Unreadable, World};
use data::{Head, ReportData, ReportedRow};
use recorder::Fold;

/// Reports that a page lists; of more it says how many.
const REPORTS_MAX: usize = 1000;

/// The report of a run.
pub struct RunReport {
    /// All that the page shows.
    pub data: ReportData,
    /// The picture of the run as SVG, for who has no scripts.
    pub picture: String,
    /// Where the journal ends before the run has, if it does.
    pub cut: Option<String>,
}

/// The report of a run by its script, its plan and its journal, as far as that is whole. `first_tick` is when its clock was at 0.
pub fn report(
    script: &Script,
    plan: &Plan,
    journal: &[u8],
    first_tick: Option<String>,
) -> Result<RunReport, Unreadable> {
    let (past, fold) = PastRun::read_with(plan, journal, |header| Fold::new(plan, header))?;
    let cut = match past.ending() {
        Ending::Complete(_) => None,
        Ending::CutShort(flaw) => Some(format!("the journal is cut short {flaw}")),
        Ending::Damaged(flaw) => Some(format!("the journal is damaged {flaw}")),
    };
    // A mission that its vehicle cannot have, since the journal is of another version of it, has no conditions.
    let decisions = explain(Reader::new(journal)?, plan, None).map(|told| told.decisions).unwrap_or_default();
    let (header, memory) = (past.header(), past.memory());
    let summary = past.summary();
    let is_link = matches!(header.world, World::Link);
    let mut folded = fold.finish(summary.ticks);
    happenings::add_tried(&mut folded.happenings, &decisions);
    let results = &memory.results;
    let extent = world::extent(results, folded.reach, past.in_simulation());
    let plume = if is_link { None } else { world::plume(plan, header.seed, summary.ticks, extent) };
    let at_end = plume.as_ref().map(|plume| plume.at_end.clone()).unwrap_or_default();
    let picture = picture::of_run(memory, &WorldAtEnd { in_simulation: past.in_simulation(), plume: at_end });
    let data = ReportData {
        head: head(&summary, header.seed, &header.set, is_link, &cut, first_tick),
        reports: summary.reports.iter().take(REPORTS_MAX).map(ReportedRow::new).collect(),
        more_reports: summary.reports_beyond(REPORTS_MAX),
        world: world::known(
            results,
            extent,
            past.in_simulation(),
            world::bottom(results, extent, past.in_simulation()),
        ),
        plume: plume.map(|plume| plume.data),
        detection: folded.detection,
        every_s: folded.every_s,
        series: folded.series,
        colours: folded.colours,
        activities: folded.activities,
        spans: folded.spans,
        diagrams: diagrams::of_run(&script.diagrams().collect::<Vec<_>>(), &plan.program, &folded.tables),
        happenings: folded.happenings,
        happenings_left_out: folded.left_out,
    };
    Ok(RunReport { data, picture, cut })
}

fn head(
    summary: &Summary,
    seed: u64,
    set: &[String],
    is_link: bool,
    cut: &Option<String>,
    first_tick: Option<String>,
) -> Head {
    Head {
        mission: one_line(&summary.mission),
        scenario: one_line(&summary.scenario),
        is_link,
        seed,
        set: set.iter().map(|set| one_line(set)).collect(),
        outcome: match cut {
            Some(_) if summary.digest.is_empty() => "end not known".to_string(),
            _ => summary.outcome.replace('_', " "),
        },
        reason: one_line(&summary.reason),
        ticks: summary.ticks,
        time_s: summary.sim_time_s,
        path_m: summary.path_length_m,
        switches: summary.switches,
        holds: summary.holds,
        origin: summary.origin.map(|origin| origin.to_string()),
        digest: summary.digest.clone(),
        cut: cut.clone(),
        first_tick: first_tick.map(|moment| one_line(&moment)),
    }
}
