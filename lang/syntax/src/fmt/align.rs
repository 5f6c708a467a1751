//! What stands under one another: declarations that follow one another where the author has begun to align them, and the
//! comments beside the lines.

use super::document::Clause;
use super::print::{Line, width};
use std::collections::BTreeMap;

/// A word that would stand so much farther right than the leftmost of its column is left where it is.
const REACH: usize = 32;

/// Words farther right than this are not aligned.
const ALIGNED_MAX: usize = super::WIDTH;

/// Blanks before a comment beside a line, at least.
const COMMENT_GAP: usize = 2;

/// A line that ends farther right does not move the comments of other lines.
const COMMENTED_MAX: usize = 88;

/// Aligns declarations of one kind on lines that follow one another, in every place where the author has padded one.
pub fn declarations(lines: &mut [Line]) {
    let alike = |a: &Line, b: &Line| alone(a).is_some() && alone(a) == alone(b) && !b.blank;
    for run in lines.chunk_by_mut(alike).filter(|run| run.len() > 1) {
        for members in places(run) {
            align(run, &members);
        }
    }
}

/// The declaration or statement that is all of a line.
fn alone<'a>(line: &Line<'a>) -> Option<Clause<'a>> {
    line.clause.filter(|(clause, whole)| *whole && !clause.row).map(|(clause, _)| clause)
}

/// The places to be aligned, from left to right, each with its line and word.
fn places(run: &[Line]) -> Vec<Vec<(usize, usize)>> {
    let mut numbers: BTreeMap<(usize, &str, usize), usize> = BTreeMap::new();
    let mut places: Vec<(bool, Vec<(usize, usize)>)> = Vec::new();
    for (at, line) in run.iter().enumerate() {
        let mut counts: BTreeMap<(usize, &str), usize> = BTreeMap::new();
        let (mut depth, mut before, mut column) = (0_usize, "", line.indent);
        for (index, word) in line.words.iter().enumerate() {
            // What follows a comma or colon has its place from that; other words are told by themselves.
            let sign = if matches!(before, "," | ":") { before } else { word.text };
            let count = counts.entry((depth, sign)).or_default();
            let number = *numbers.entry((depth, sign, *count)).or_insert(places.len());
            *count += 1;
            if places.len() == number {
                places.push((false, Vec::new()));
            }
            // Two words without a blank between them stay as close: `flow. toward` would not be a field.
            if index > 0
                && word.blanks > 0
                && column <= ALIGNED_MAX
                && let Some((padded, members)) = places.get_mut(number)
            {
                *padded |= word.padded;
                members.push((at, index));
            }
            match word.text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.saturating_sub(1),
                _ => {}
            }
            before = word.text;
            column += width(word);
        }
    }
    places.into_iter().filter(|(padded, _)| *padded).map(|(_, members)| members).collect()
}

fn align(run: &mut [Line], members: &[(usize, usize)]) {
    let end =
        |&(line, word): &(usize, usize)| run[line].indent + run[line].words[..word].iter().map(width).sum::<usize>();
    let ends: Vec<usize> = members.iter().map(end).collect();
    let Some(least) = ends.iter().min() else { return };
    let within: Vec<usize> = (0..ends.len()).filter(|&i| ends[i] <= least + REACH).collect();
    let begin = within.iter().map(|&i| ends[i]).max().unwrap_or(0);
    for i in within {
        let ((line, word), blanks) = (members[i], begin - ends[i]);
        // A line that would become too long stays as it is.
        if run[line].width() + blanks <= super::WIDTH {
            run[line].words[word].blanks += blanks;
        }
    }
}

/// Puts the comments beside lines in columns. Comments on lines that follow one another share one, and so do those of a
/// declaration that shared one in the source.
pub fn comments(lines: &mut [Line]) {
    let beside = |line: &Line| line.comment.is_some() && !line.words.is_empty();
    let mut runs: Vec<Vec<usize>> = Vec::new();
    for at in (0..lines.len()).filter(|&at| beside(&lines[at])) {
        match runs.last_mut() {
            Some(run) if run.last() == Some(&at.wrapping_sub(1)) && !lines[at].blank => run.push(at),
            _ => runs.push(vec![at]),
        }
    }
    let mut columns: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for run in runs {
        let column = run.iter().filter_map(|&at| lines[at].comment).map(|c| c.column).min().unwrap_or(0);
        let item = run.first().map_or(0, |&at| lines[at].item);
        columns.entry((item, column)).or_default().extend(run);
    }
    for ((_, column), members) in columns {
        let needed = members.iter().map(|&at| lines[at].width()).filter(|&width| width <= COMMENTED_MAX).max();
        let column = column.max(needed.map_or(0, |width| width + COMMENT_GAP));
        for at in members {
            lines[at].comment_blanks = column.saturating_sub(lines[at].width()).max(COMMENT_GAP);
        }
    }
    continued(lines);
}

/// A comment that stood alone under one beside a line goes on from it, and stays under it.
fn continued(lines: &mut [Line]) {
    let mut above: Option<(usize, usize)> = None;
    for line in lines {
        let Some(comment) = line.comment else {
            above = None;
            continue;
        };
        if line.words.is_empty() {
            above = above.filter(|&(source, _)| source == comment.column && source > line.indent && !line.blank);
            line.comment_blanks = above.map_or(0, |(_, column)| column.saturating_sub(line.indent));
        } else {
            above = Some((comment.column, line.width() + line.comment_blanks));
        }
    }
}
