//! The switching tables that ran, drawn so that a page can show what is active.

use super::data::RunDiagram;
use super::recorder::RunTable;
use albacore_diagram::{Diagram, marked_svg};
use albacore_program::{Body, Program};

/// More tables are not drawn.
const DIAGRAMS_MAX: usize = 20;

/// The diagrams of strategies that ran, of all that a script knows.
pub(super) fn of_run(known: &[Diagram], program: &Program, ran: &[RunTable]) -> Vec<RunDiagram> {
    let drawn = |(id, index, behaviors): &RunTable| {
        let activity = program.activities.get(*id as usize)?;
        let Body::Table(table) = &activity.body else { return None };
        let name = |entry: &albacore_program::Entry| program.activities.get(entry.activity as usize).map(|of| &of.name);
        let names: Vec<_> = table.behaviors.iter().map(name).collect();
        let is_same = |diagram: &&Diagram| {
            diagram.name == activity.name && diagram.behaviors.iter().map(Some).eq(names.iter().copied())
        };
        let diagram = known.iter().find(is_same)?;
        Some(RunDiagram { activity: *index, behaviors: behaviors.clone(), svg: marked_svg(diagram) })
    };
    ran.iter().take(DIAGRAMS_MAX).filter_map(drawn).collect()
}
