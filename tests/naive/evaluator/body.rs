//! Statements one after the other: what is still to be done is a stack, so that a body can stop where time goes by.

use super::expr::{Frame, Scope, exactly, holds, insert, number, sorted, text, value};
use super::timed::Underway;
use super::value::Value;
use super::world::World;
use albacore_geometry::{Heading, Rows};
use albacore_lang::hir::{Block, Expr, RowPlan, Stmt, StmtKind, TextPart, Timed, With};
use albacore_lang::source::Span;

/// What a body has still to do, the next last.
pub enum Todo<'p> {
    Stmts(&'p [Stmt]),
    /// A `while` or `loop` once more, after so many rounds.
    Again(&'p Stmt, u64),
    /// The rounds of a `for` that are left, the next last: rule 16, a copy made at its start.
    Rounds(Walk<'p>, Vec<Value>),
    /// The end of a `with`.
    EndWith,
    /// A statement that takes time, under way.
    Timed(Box<Underway<'p>>),
}

/// A `for` under way.
#[derive(Clone, Copy)]
pub struct Walk<'p> {
    var: usize,
    /// Of a map: its places, which come behind what its cells hold.
    place: Option<usize>,
    body: &'p Block,
    /// All its rounds.
    of: usize,
    /// It counts through a range.
    counts: bool,
}

/// Where a body stops for its activation to do something.
pub enum Stop<'p> {
    End,
    Timed(&'p Timed, Span),
    Underway(Box<Underway<'p>>),
    With(&'p [With], &'p Block),
    EndWith,
    Finish(Option<&'p Expr>),
    Abort(&'p [TextPart]),
}

/// Instantaneous code: it stops nowhere but at its end.
pub fn at_once(w: &mut World<'_>, frame: &Frame<'_>, block: &Block) {
    let mut todo = vec![Todo::Stmts(&block.stmts)];
    assert!(matches!(advance(w, frame, &mut todo), Stop::End), "instantaneous code took time");
}

/// Goes on to the next stop.
pub fn advance<'b>(w: &mut World<'_>, frame: &Frame<'_>, todo: &mut Vec<Todo<'b>>) -> Stop<'b> {
    while let Some(next) = todo.pop() {
        let mut behind = 0;
        let stmt = match next {
            Todo::Stmts([]) => continue,
            Todo::Stmts([stmt, rest @ ..]) => {
                todo.push(Todo::Stmts(rest));
                stmt
            }
            Todo::Again(stmt, rounds) => {
                behind = rounds;
                stmt
            }
            Todo::Rounds(walk, mut left) => {
                if let Some(round) = left.pop() {
                    match (walk.place, &round) {
                        (Some(place), Value::Parts(both)) => {
                            frame.set(walk.var, both[0].clone());
                            frame.set(place, both[1].clone());
                        }
                        _ => frame.set(walk.var, round),
                    }
                    todo.push(Todo::Rounds(walk, left));
                    todo.push(Todo::Stmts(&walk.body.stmts));
                }
                continue;
            }
            Todo::EndWith => return Stop::EndWith,
            Todo::Timed(underway) => return Stop::Underway(underway),
        };
        w.steps += 1;
        let s = Scope::of(frame);
        match &stmt.kind {
            StmtKind::If(condition, then, otherwise) => {
                let chosen = if holds(w, s, condition) { then } else { otherwise };
                todo.push(Todo::Stmts(&chosen.stmts));
            }
            StmtKind::Match(on, arms, otherwise) => {
                let variant = number(w, s, on) as usize;
                let arm = arms.iter().find(|(variants, _)| variants.contains(&variant)).map(|(_, block)| block);
                todo.extend(arm.or(otherwise.as_ref()).map(|block| Todo::Stmts(&block.stmts)));
            }
            StmtKind::While { condition, bind, body } => {
                let found = value(w, s, condition);
                if found.holds() {
                    if let (Some(var), Value::Maybe(Some(value))) = (bind, found) {
                        frame.set(*var, *value);
                    }
                    todo.push(Todo::Again(stmt, behind + 1));
                    todo.push(Todo::Stmts(&body.stmts));
                }
            }
            StmtKind::Loop(body) => {
                todo.push(Todo::Again(stmt, behind + 1));
                todo.push(Todo::Stmts(&body.stmts));
            }
            StmtKind::With(items, body) => return Stop::With(items, body),
            StmtKind::Timed(timed) => return Stop::Timed(timed, stmt.span),
            StmtKind::Finish(result) => return Stop::Finish(result.as_ref()),
            StmtKind::Abort(why) => return Stop::Abort(why),
            _ => match rounds(w, s, stmt) {
                Some((var, mut rounds, body)) => {
                    rounds.reverse();
                    let counts = matches!(stmt.kind, StmtKind::ForRange { .. });
                    let place = if let StmtKind::ForList { place, .. } = stmt.kind { place } else { None };
                    todo.push(Todo::Rounds(Walk { var, place, body, of: rounds.len(), counts }, rounds));
                }
                None => perform(w, s, stmt),
            },
        }
    }
    Stop::End
}

/// Of each loop around a statement that begins the round, of how many, and the number that it counts; of what has still to be done
/// those loops are a part.
pub fn rounds_under_way(frame: &Frame<'_>, todo: &[Todo<'_>]) -> String {
    let mut said = String::new();
    for around in todo {
        match around {
            Todo::Again(_, rounds) => said += &format!(" {rounds} of 0 at 0"),
            Todo::Rounds(walk, left) => {
                let at = if walk.counts { frame.get(walk.var).number() } else { 0.0 };
                said += &format!(" {} of {} at {at}", walk.of - left.len(), walk.of);
            }
            _ => {}
        }
    }
    said
}

/// What a `for` walks.
fn rounds<'b>(w: &mut World<'_>, s: Scope<'_, '_>, stmt: &'b Stmt) -> Option<(usize, Vec<Value>, &'b Block)> {
    Some(match &stmt.kind {
        StmtKind::ForRange { var, first, last, inclusive, body } => {
            let (mut next, last) = (number(w, s, first), number(w, s, last));
            let mut rounds = Vec::new();
            while next < last || (*inclusive && next == last) {
                rounds.push(Value::Number(next));
                // Beyond 2^53 there is no next one.
                if next + 1.0 == next {
                    break;
                }
                next += 1.0;
            }
            (*var, rounds, body)
        }
        StmtKind::ForList { var, place, list, body } => {
            let rounds = match value(w, s, list) {
                Value::Map(grid, cells) => {
                    let centers = (0..).map(|i| Value::of_point(grid.center(i)));
                    let both = |(cell, center): (Value, Value)| match place {
                        Some(_) => Value::Parts(vec![cell, center]),
                        None => cell,
                    };
                    cells.into_iter().zip(centers).map(both).collect()
                }
                list => list.list().to_vec(),
            };
            (*var, rounds, body)
        }
        StmtKind::ForEdges { var, area, body } => {
            (*var, value(w, s, area).edges().iter().map(|edge| Value::of_edge(*edge)).collect(), body)
        }
        StmtKind::ForRows { var, rows, body } => {
            let RowPlan { area, step, along, near } = &**rows;
            let (area, step) = (value(w, s, area), number(w, s, step));
            let along = along.as_ref().map(|along| Heading::from_radians(number(w, s, along)));
            let near = value(w, s, near).point();
            let across = Rows::across(area.edges().iter().copied(), step, along, near);
            let rows = across.into_iter().flat_map(|rows| rows.rows(area.edges().iter().copied()));
            (*var, rows.map(Value::of_line).collect(), body)
        }
        _ => return None,
    })
}

/// The statements that only do something.
fn perform(w: &mut World<'_>, s: Scope<'_, '_>, stmt: &Stmt) {
    match &stmt.kind {
        StmtKind::Set(var, e) => {
            let value = match value(w, s, e) {
                Value::List(list) => Value::List(sorted(w, s.frame, *var, list)),
                value => value,
            };
            s.frame.set(*var, value);
        }
        StmtKind::Insert(var, e) => {
            let element = value(w, s, e);
            insert(w, s.frame, *var, element);
        }
        StmtKind::Remove(var, e) => {
            let element = value(w, s, e);
            let mut list = s.frame.get(*var).list().to_vec();
            if let Some(at) = list.iter().position(|other| *other == element) {
                list.remove(at);
            }
            s.frame.set(*var, Value::List(list));
        }
        StmtKind::Replace(var, place, e) if matches!(s.frame.get(*var), Value::Map(..)) => {
            let (place, cell) = (value(w, s, place).point(), value(w, s, e));
            let Value::Map(grid, mut cells) = s.frame.get(*var) else { return };
            if let Some(index) = grid.index_of(place) {
                cells[index as usize] = cell;
            }
            s.frame.set(*var, Value::Map(grid, cells));
        }
        StmtKind::Replace(var, index, e) => {
            let (index, element) = (number(w, s, index), value(w, s, e));
            let mut list = s.frame.get(*var).list().to_vec();
            if let Some(place) = (index >= 0.0).then(|| list.get_mut(index as usize)).flatten() {
                *place = element;
            }
            s.frame.set(*var, Value::List(sorted(w, s.frame, *var, list)));
        }
        StmtKind::Clear(var) => s.frame.set(*var, Value::List(Vec::new())),
        StmtKind::Report { name, fields } => {
            if !w.may_report(stmt) {
                return;
            }
            let (mut said, mut bytes) = (Vec::new(), 0);
            for (label, e) in fields {
                let words = value(w, s, e).words(&w.shape(&e.ty));
                bytes += size_of_val(words.as_slice());
                said.push(exactly(&w.texts, label, &w.shape(&e.ty), &words));
            }
            w.pay(bytes);
            w.say(format!("report {name}: {}", said.join(", ")));
        }
        StmtKind::Log(parts) => {
            let line = text(w, s, parts);
            if !w.may_write() {
                return;
            }
            w.pay(line.len());
            w.say(format!("log {line}"));
        }
        _ => {}
    }
}
