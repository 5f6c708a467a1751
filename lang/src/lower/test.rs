//! Tests to code: each expectation, and what is printed of it when it fails.

use super::{Lowered, Lowering, slot};
use crate::cost::limits;
use crate::diagnostic::Diagnostic;
use crate::hir::{Builtin, Expect, Expr, ExprKind, Hir, Row, Test, TestNames, VarId, When, children, test_file_name};
use crate::source::Sources;
use crate::types::Type;
use crate::types::TypeTable;
use albacore_program::{ActivityId, Code, Program, Shape, Slot};
use std::collections::{BTreeMap, BTreeSet};

/// A test, ready to run.
#[derive(Clone, Debug)]
pub struct TestProgram {
    /// What it is called.
    pub name: String,
    /// Its name as that of a file.
    pub file_name: String,
    /// `file:line`.
    pub place: String,
    /// What it runs: the mission once, or for each row of its table.
    pub rows: Vec<RowProgram>,
    /// The source in which the mission is declared.
    pub mission_source: String,
    /// The scenario, by the name that the script calls it.
    pub scenario: String,
    /// The seeds, both ends included.
    pub seeds: (u64, u64),
    /// What must hold.
    pub expects: Vec<ExpectProgram>,
    /// The seeds whose switches are compared with a snapshot.
    pub snapshots: Vec<u64>,
    /// The code of the expectations.
    pub program: Program,
    /// Where the expectations find what they speak of.
    pub slots: TestSlots,
}

/// The mission as a test runs it.
#[derive(Clone, Debug)]
pub struct RowProgram {
    /// Its row of the table as it is written, `with leg: 30 s`; empty without a table.
    pub text: String,
    /// The mission, with what it is given.
    pub mission: Program,
    /// What it is given, as the texts of `--set`: `east_leg.leg=30 s`.
    pub set: Vec<String>,
    /// The values of the parameters that expectations speak of, where they are put, and their words.
    pub params: Vec<(Code, Slot, u32)>,
}

/// Where expectations find what they speak of. Positions are two words; what was reported begins with its presence.
pub type TestSlots = TestNames<Slot>;

/// An expectation.
#[derive(Clone, Debug)]
pub struct ExpectProgram {
    /// As it is written.
    pub text: String,
    /// `file:line`.
    pub place: String,
    /// When it must hold.
    pub when: When<ActivityId>,
    /// The points whose true water depth it asks for, in order, and where the answers go.
    pub depths: Vec<(Code, Slot)>,
    /// The condition.
    pub holds: Code,
    /// What it takes for granted: where the presence stands, and what to say without it.
    pub needs: Vec<(Slot, String)>,
    /// Named values for the message of a failure.
    pub watched: Vec<NamedValue>,
}

/// A value that is told when an expectation does not hold.
#[derive(Clone, Debug)]
pub struct NamedValue {
    /// As it is written.
    pub name: String,
    /// The value.
    pub code: Code,
    /// Its shape.
    pub shape: Shape,
    /// Where the presence of each thing stands that it is made of: without one there is no value.
    pub needs: Vec<Slot>,
}

/// A value as it is written, with what it takes.
fn named<'a>(l: &mut Lowering<'a>, e: &'a Expr) -> NamedValue {
    NamedValue {
        name: on_one_line(l.sources.text(e.span)),
        code: l.code(e),
        shape: l.shape(&e.ty),
        needs: taken_for_present(e).into_iter().map(|id| l.frame.vars[id]).collect(),
    }
}

/// The names of optionals whose values an expression reads.
fn taken_for_present(e: &Expr) -> Vec<VarId> {
    let mut names = Vec::new();
    e.visit(&mut |e| {
        if let ExprKind::Unwrap(inner) = &e.kind
            && let ExprKind::Var(id) = inner.kind
        {
            names.push(id);
        }
        true
    });
    names
}

/// Lowers a test.
pub fn test(hir: &Hir, types: &TypeTable, sources: &Sources, index: usize) -> Result<TestProgram, Vec<Diagnostic>> {
    let test = &hir.tests[index];
    if let Some(finding) = limits::test_steps(hir, types, index) {
        return Err(vec![finding]);
    }
    let mut missions: Vec<Lowered> = Vec::new();
    // What the missions report is compared with texts of the test.
    let mut texts = BTreeMap::new();
    for row in &test.rows {
        let mission = super::mission_with(hir, types, sources, (test.mission, &row.args), &texts)?;
        texts.clone_from(&mission.texts);
        missions.push(mission);
    }
    let mut lowering = Lowering::new(hir, types, sources).with_texts(&texts);
    lowering.origin = missions.first().and_then(|mission| mission.program.mission.origin);
    // What the mission is given changes no activity's place.
    let place = |id| missions.first().and_then(|mission| mission.activities.get(&id).copied());
    for expect in &test.expects {
        lowering.prepare(&expect.holds);
    }
    for (point, _) in &test.depths {
        lowering.prepare(point);
    }
    for (param, _) in &test.params {
        test.rows.iter().for_each(|row| lowering.prepare(&row.args[*param]));
    }
    let lowered = std::cell::RefCell::new((Vec::new(), Vec::new(), None));
    let words = lowering.twice(&test.vars, |l| {
        let at = |id: usize| l.frame.vars[id];
        let known = &test.known;
        let slots = known.map(at);
        let expects = test.expects.iter().map(|expect| expectation(l, test, expect, &place)).collect();
        let params: Vec<_> = test.rows.iter().map(|row| given(l, test, row)).collect();
        lowered.replace((expects, params, Some(slots)));
    });
    let mut findings = std::mem::take(&mut lowering.findings);
    findings.extend(limits::of_values(test.span, "the test", &test.name, words, lowering.emitted));
    let (expects, params, slots) = lowered.into_inner();
    let Some(slots) = slots.filter(|_| findings.is_empty()) else {
        crate::diagnostic::settle(&mut findings);
        return Err(findings);
    };
    let mut program = lowering.program;
    program.words = slot(words);
    let mut claims = lowering.claims;
    for expect in &expects {
        let depths = expect.depths.iter().map(|(point, _)| point);
        let watched = expect.watched.iter().map(|value| &value.code);
        claims.pieces.extend(depths.chain(watched).chain([&expect.holds]).map(|code| code.entry));
    }
    claims.pieces.extend(params.iter().flatten().map(|(code, ..)| code.entry));
    debug_assert_eq!(program.verify(), Ok(()));
    debug_assert_eq!(program.verify_ranges(&claims), Ok(()));
    let rows = test.rows.iter().zip(missions).zip(params).map(|((row, mission), params)| RowProgram {
        text: row.span.map_or(String::new(), |span| on_one_line(sources.text(span))),
        mission: mission.program,
        set: set(hir, sources, test, row),
        params,
    });
    let rows = rows.collect();
    Ok(TestProgram {
        name: test.name.clone(),
        file_name: test_file_name(&test.name),
        place: sources.place(test.span),
        rows,
        mission_source: sources.get(hir.activities[test.mission].span.file).name.to_string(),
        scenario: hir.scenarios[test.scenario].path.clone(),
        seeds: test.seeds,
        expects,
        snapshots: test.snapshots.clone(),
        program,
        slots,
    })
}

/// An expectation; `place` tells where an activity stands among the mission's.
fn expectation<'a>(
    l: &mut Lowering<'a>,
    test: &'a Test,
    expect: &'a Expect,
    place: &impl Fn(usize) -> Option<ActivityId>,
) -> ExpectProgram {
    let mut asked = Vec::new();
    depths(&expect.holds, &test.depths, &mut asked);
    let mut sides = Vec::new();
    compared(&expect.holds, l.sources, &mut sides);
    // What is compared twice is told once.
    let mut told = BTreeSet::new();
    sides.retain(|e| told.insert(l.sources.text(e.span)));
    let watched = sides.into_iter().map(|e| named(l, e)).collect();
    ExpectProgram {
        text: on_one_line(l.sources.text(expect.span)),
        place: l.sources.place(expect.span),
        when: match expect.when {
            When::AtTheEnd(share) => When::AtTheEnd(share),
            When::Always => When::Always,
            When::Once => When::Once,
            // What is not lowered with the mission is never entered.
            When::While(id) => When::While(place(id).unwrap_or(ActivityId::MAX)),
        },
        depths: asked.into_iter().map(|(point, to)| (l.code(point), l.frame.vars[*to])).collect(),
        holds: l.code(&expect.holds),
        needs: expect.needs.iter().map(|(id, without)| (l.frame.vars[*id], without.clone())).collect(),
        watched,
    }
}

/// The values that a row gives to the parameters which expectations speak of.
fn given<'a>(l: &mut Lowering<'a>, test: &'a Test, row: &'a Row) -> Vec<(Code, Slot, u32)> {
    let value = |(param, to): &(usize, VarId)| {
        let e = &row.args[*param];
        (l.code(e), l.frame.vars[*to], l.words(&e.ty))
    };
    test.params.iter().map(value).collect()
}

/// What the mission is given in a row, beside its defaults, as the texts of `--set`.
fn set(hir: &Hir, sources: &Sources, test: &Test, row: &Row) -> Vec<String> {
    let mission = &hir.activities[test.mission];
    let given = |(param, value): (usize, &Expr)| {
        let is_default = mission.defaults.get(param)?.as_ref().is_some_and(|default| default.span == value.span);
        let text = on_one_line(sources.text(value.span));
        (!is_default).then(|| format!("{}.{}={text}", mission.name, mission.vars[param].name))
    };
    row.args.iter().enumerate().filter_map(given).collect()
}

/// What is written on several lines, without their comments.
fn on_one_line(text: &str) -> String {
    // In a text between quotes nothing is a comment.
    let is_open = |before: &str| before.matches('"').count() % 2 == 1;
    let said = |line: &'_ str| line.match_indices("//").map(|(at, _)| at).find(|at| !is_open(&line[..*at]));
    let lines = text.lines().map(|line| said(line).map_or(line, |end| &line[..end]));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

/// The true depths that an expression asks for, those that they are asked with before them.
fn depths<'e>(e: &Expr, known: &'e [(Expr, VarId)], out: &mut Vec<&'e (Expr, VarId)>) {
    if let ExprKind::Var(id) = e.kind
        && let Some(asked) = known.iter().find(|(_, answer)| *answer == id)
    {
        depths(&asked.0, known, out);
        out.push(asked);
    }
    children(e, &mut |child| depths(child, known, out));
}

/// Both sides of the comparisons of a condition, but for numbers and texts that it spells out.
fn compared<'e>(e: &'e Expr, sources: &Sources, out: &mut Vec<&'e Expr>) {
    let is_spelt_out = |side: &Expr| {
        let text = sources.text(side.span).trim_start_matches(['-', '+', ' ']);
        let is_number = side.range.constant().is_some() && text.starts_with(|c: char| c.is_ascii_digit());
        is_number || side.literal_text().is_some()
    };
    match &e.kind {
        // A comparison that is written as one value, such as `area.contains(place)`.
        ExprKind::Do(Builtin::Lt | Builtin::Le | Builtin::Eq, sides) if sides.iter().any(|s| s.span == e.span) => {
            out.push(e);
        }
        ExprKind::Do(Builtin::Lt | Builtin::Le | Builtin::Eq, sides) => {
            out.extend(sides.iter().filter(|side| !is_spelt_out(side)));
        }
        // Whether the mission has ended so, or something was reported.
        ExprKind::Var(_) if e.ty == Type::Bool => out.push(e),
        ExprKind::IsPresent(_) => out.push(e),
        _ => children(e, &mut |child| compared(child, sources, out)),
    }
}
