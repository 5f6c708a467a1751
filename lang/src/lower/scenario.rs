//! Scenarios to code that computes their numbers, and a description of what each number is.

use super::{Lowering, slot};
use crate::cost::limits;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, ClauseArg, ClauseUse, ExprKind, Hir, without_holes};
use crate::source::{Sources, Span};
use crate::types::{Type, TypeTable};
use albacore_geometry::Geodetic;
use albacore_program::{Op, Program, Shape, Slot};

/// A scenario no place of which is within this of a mission's origin, m, lies elsewhere: they share no plane.
pub const SAME_PLANE_M: f64 = 50_000.0;

/// A scenario, ready to be computed: run the program's code from 0, then read the slots.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioProgram {
    /// Its name.
    pub name: String,
    /// The scenarios that it is like, the nearest first, by their names.
    pub bases: Vec<String>,
    /// Where it is declared.
    pub span: Span,
    /// Where the local frame touches the globe.
    pub origin: Option<Geodetic>,
    /// Its own positions on the globe, if it has any: where it lies, whatever frame it is computed in.
    pub places: Vec<Geodetic>,
    /// The code, and nothing else.
    pub program: Program,
    /// What it says, in order.
    pub clauses: Vec<ScenarioClause>,
}

/// A clause of a scenario: `flow`, `source`, …
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioClause {
    /// Its name.
    pub name: String,
    /// `file:line`.
    pub place: String,
    /// Where it stands.
    pub span: Span,
    /// Its arguments, defaults included.
    pub args: Vec<ScenarioArg>,
}

/// An argument of a clause.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioArg {
    /// The name of its parameter.
    pub name: String,
    /// What it is.
    pub value: ScenarioValue,
    /// Where it stands.
    pub span: Span,
    /// Whether the scenario says nothing of it.
    pub is_default: bool,
}

/// What an argument of a clause is.
#[derive(Clone, Debug, PartialEq)]
pub enum ScenarioValue {
    /// Words in a slot.
    Words(Slot, Shape),
    /// A text.
    Text(String),
    /// Another clause.
    Clause(ScenarioClause),
}

/// Lowers a scenario, its frame about `origin`, else about the middle of its own positions.
pub fn scenario(
    hir: &Hir,
    types: &TypeTable,
    sources: &Sources,
    id: usize,
    origin: Option<Geodetic>,
) -> Result<ScenarioProgram, Vec<Diagnostic>> {
    let scenario = &hir.scenarios[id];
    if let Some(finding) = limits::scenario_steps(hir, types, id) {
        return Err(vec![finding]);
    }
    let mut lowering = Lowering::new(hir, types, sources);
    let positions: Vec<_> = scenario.clauses.iter().flat_map(hir::ClauseUse::positions).collect();
    let places: Vec<_> = positions.iter().map(|(lat, lon)| Geodetic::from_degrees(*lat, *lon)).collect();
    // About an origin far away nothing would keep its shape: it is computed where it lies, and told to lie elsewhere.
    let is_near =
        |origin: &Geodetic| places.is_empty() || places.iter().any(|place| place.great_circle(*origin) <= SAME_PLANE_M);
    lowering.origin = origin.filter(is_near).or_else(|| hir::middle(&positions));
    for clause in &scenario.clauses {
        lowering.prepare_clause(clause);
    }
    let entry = lowering.here();
    let clauses = std::cell::RefCell::new(Vec::new());
    let words = lowering.twice(&scenario.vars, |l| {
        for (default, to) in scenario.defaults.iter().zip(l.frame.vars.clone()) {
            if let Some(e) = default {
                l.scratch(|l| l.expr_into(e, to));
            }
        }
        let lowered = scenario.clauses.iter().map(|c| l.clause(c)).collect();
        clauses.replace(lowered);
        l.emit(Op::Return);
    });
    let too_large = limits::of_values(scenario.span, "the scenario", &scenario.name, words, lowering.emitted);
    lowering.findings.extend(too_large);
    if !lowering.findings.is_empty() {
        return Err(lowering.findings);
    }
    let mut program = lowering.program;
    program.words = slot(words);
    program.mission.activity = entry;
    Ok(ScenarioProgram {
        name: scenario.name.clone(),
        bases: std::iter::successors(scenario.base, |id| hir.scenarios[*id].base)
            .map(|id| hir.scenarios[id].name.clone())
            .collect(),
        span: scenario.span,
        origin: lowering.origin,
        places,
        program,
        clauses: clauses.into_inner(),
    })
}

impl<'a> Lowering<'a> {
    fn prepare_clause(&mut self, clause: &ClauseUse) {
        for (_, arg) in &clause.args {
            match arg {
                ClauseArg::Value(e) => self.prepare(e),
                ClauseArg::Nested(inner) => self.prepare_clause(inner),
            }
        }
    }

    fn clause(&mut self, clause: &ClauseUse) -> ScenarioClause {
        let mut args = Vec::new();
        for (name, arg) in &clause.args {
            let value = match arg {
                ClauseArg::Nested(inner) => ScenarioValue::Clause(self.clause(inner)),
                ClauseArg::Value(e) => match text(e) {
                    Some(text) => ScenarioValue::Text(text),
                    None => {
                        let valued = self.valued(e);
                        ScenarioValue::Words(valued.slot, valued.shape)
                    }
                },
            };
            let span = match arg {
                ClauseArg::Nested(inner) => inner.span,
                ClauseArg::Value(e) => e.span,
            };
            // A default stands where the clause is declared.
            let is_default = span.file != clause.span.file;
            args.push(ScenarioArg { name: name.clone(), value, span, is_default });
        }
        ScenarioClause { name: clause.name.clone(), place: self.sources.place(clause.span), span: clause.span, args }
    }
}

/// A text that is written out, for a parameter that may be absent too.
fn text(e: &hir::Expr) -> Option<String> {
    match &e.kind {
        ExprKind::Text(parts) if e.ty == Type::Text => without_holes(parts),
        ExprKind::Present(inner) => text(inner),
        _ => None,
    }
}
