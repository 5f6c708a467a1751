//! Columns of a switching table: `->` under `->`, `on` under `on`, and `do` under `do` where the author has begun to.

use super::document::Column;
use super::print::{Line, width};
use std::collections::BTreeMap;

/// A cell wider than this sticks out of its column and does not widen it: sources and targets, and guards.
const CELL_MAX: usize = 20;
const GUARD_MAX: usize = 40;

/// Aligns the rows of each table: all rules of one block, whatever stands between them.
pub fn align(lines: &mut [Line]) {
    let mut tables: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (at, line) in lines.iter().enumerate() {
        if let Some((clause, _)) = line.clause
            && clause.row
        {
            tables.entry(clause.block).or_default().push(at);
        }
    }
    for mut rows in tables.into_values() {
        let do_is_padded = |&row: &usize| find(&lines[row], Column::Do).is_some_and(|at| lines[row].words[at].padded);
        let begun = rows.iter().any(do_is_padded);
        column(lines, &mut rows, Column::Arrow, CELL_MAX);
        column(lines, &mut rows, Column::On, CELL_MAX);
        if begun {
            column(lines, &mut rows, Column::Do, GUARD_MAX);
        }
    }
}

fn find(line: &Line, column: Column) -> Option<usize> {
    line.words.iter().position(|word| word.column == Some(column))
}

/// The width of the cell before a column, from the word that begins it on, and where the column would begin by itself.
fn cell(line: &Line, end: Option<usize>) -> (usize, usize) {
    let end = end.unwrap_or(line.words.len());
    let begin = line.words[..end].iter().rposition(|word| word.column.is_some()).unwrap_or(0);
    let cell: usize = line.words[begin..end].iter().map(width).sum();
    let before = line.words.get(begin).map_or(0, |word| word.blanks);
    (cell - before, line.indent + line.words[..end].iter().map(width).sum::<usize>())
}

/// Aligns a column. A row that sticks out, or goes on on another line, is left out of it and of those to its right.
fn column(lines: &mut [Line], rows: &mut Vec<usize>, column: Column, cell_max: usize) {
    let mut begin = 0;
    rows.retain(|&row| {
        let line = &lines[row];
        let found = find(line, column);
        let ends_here = column == Column::Do && line.clause.is_some_and(|(_, whole)| whole);
        let (cell, end) = cell(line, found);
        let within = cell <= cell_max && (found.is_some() || ends_here);
        if within {
            begin = begin.max(end);
        }
        within
    });
    for &row in rows.iter() {
        let found = find(&lines[row], column);
        let (_, end) = cell(&lines[row], found);
        if let Some(word) = found.and_then(|at| lines[row].words.get_mut(at)) {
            word.blanks = 1 + begin - end;
        }
    }
}
