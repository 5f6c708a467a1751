//! The switching table as a diagram: behaviors, and the edges that lead from one to another, in the script's own words.

use crate::hir::{self, Activity, Block, Body, Hir, TextPart};
use crate::source::{Sources, Span};
use crate::syntax;
use crate::{ENTRY, Script};
use albacore_wording::{listed, nearest};
use std::collections::BTreeMap;

/// A strategy, or a mission whose body is a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagram {
    /// Its name.
    pub name: String,
    /// Index of the behavior that is entered first.
    pub start: usize,
    /// The behaviors' names, as declared.
    pub behaviors: Vec<String>,
    /// Edges, by the first rule that each stands for, then by source.
    pub edges: Vec<Edge>,
}

/// All rules that lead from one behavior to one target, and come back or do not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Index of the behavior that is left.
    pub source: usize,
    /// Where it leads.
    pub target: Target,
    /// `then back`.
    pub back: bool,
    /// The rules, in the order in which they are tried.
    pub guards: Vec<Guard>,
}

/// Where an edge leads.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// To a behavior: its index.
    Behavior(usize),
    /// To the end, with a result if there is one.
    Finish(Option<String>),
    /// To the mission's abort: why.
    Abort(String),
}

/// A rule, as an edge is labelled with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guard {
    /// Which rule of the table, counted from 1: rules are tried in this order. One that leaves several behaviors stands on
    /// as many edges.
    pub rule: usize,
    /// What follows `on`.
    pub on: String,
    /// What stands in `do { }`.
    pub effect: Option<String>,
}

/// Why there is no diagram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoDiagram {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
}

impl Script {
    /// The diagram of a strategy or mission by the name that the script has for it, else of the only table that stands in
    /// the script's own file.
    pub fn diagram(&self, name: Option<&str>) -> Result<Diagram, NoDiagram> {
        let file = &self.sources.get(ENTRY).name;
        let tables: Vec<&Activity> =
            self.hir.activities.iter().filter(|a| matches!(a.body, Body::Table { .. })).collect();
        let names = |own: bool| -> Vec<&str> {
            tables.iter().filter(|a| (a.span.file == ENTRY) == own).map(|a| a.full_name.as_str()).collect()
        };
        let chosen = match (name, names(true).as_slice()) {
            (Some(name), _) => name,
            (None, [only]) => only,
            (None, []) => {
                let message = format!("`{file}` declares no switching table");
                return Err(NoDiagram { message, help: imported(&names(false)) });
            }
            (None, several) => {
                let message = format!("`{file}` has several switching tables");
                return Err(NoDiagram { message, help: Some(format!("name one of {}", listed(several))) });
            }
        };
        if let Some(found) = self.hir.activities.iter().find(|a| a.owner.is_none() && a.full_name == chosen) {
            return diagram(found, &self.hir, &self.sources).ok_or_else(|| {
                let is_sequence = matches!(found.body, Body::Sequence(_));
                let help = is_sequence.then(|| "its statements run one after the other".to_string());
                NoDiagram { message: format!("`{chosen}` has no switching table"), help }
            });
        }
        let all: Vec<&str> = names(true).into_iter().chain(names(false)).collect();
        let message = format!("`{file}` knows no strategy or mission `{chosen}`");
        // Of an imported strategy, the module is soon forgotten.
        let last = |name: &str| name.rsplit('.').next().unwrap_or_default().to_string();
        let help = match nearest(chosen, all.iter().copied()).or(all.iter().copied().find(|n| last(n) == last(chosen)))
        {
            Some(near) => Some(format!("did you mean `{near}`?")),
            None => (!all.is_empty()).then(|| format!("switching tables are {}", listed(&all))),
        };
        Err(NoDiagram { message, help })
    }
}

impl Script {
    /// The diagrams of all tables that the script knows: its own, those of its modules, and those that were made of a strategy for what it
    /// was given.
    pub fn diagrams(&self) -> impl Iterator<Item = Diagram> {
        self.hir.activities.iter().filter_map(|activity| diagram(activity, &self.hir, &self.sources))
    }
}

/// What an importing script may have meant.
fn imported(names: &[&str]) -> Option<String> {
    (!names.is_empty()).then(|| format!("name one that it imports: {}", listed(names)))
}

/// The diagram of an activity, if it has a table.
fn diagram(activity: &Activity, hir: &Hir, sources: &Sources) -> Option<Diagram> {
    let Body::Table { start, behaviors, rules } = &activity.body else { return None };
    let mut edges: Vec<Edge> = Vec::new();
    let mut places = BTreeMap::new();
    for (i, rule) in rules.iter().enumerate() {
        let target = match &rule.target {
            hir::Target::Behavior(to) => Target::Behavior(*to),
            hir::Target::Finish(result) => Target::Finish(result.as_ref().map(|e| written(e.span, sources))),
            hir::Target::Abort(why) => Target::Abort(text(why, sources)),
        };
        let effect = rule.effect.as_ref().map(|block| statements(block, sources)).filter(|text| !text.is_empty());
        let guard = Guard { rule: i + 1, on: written(rule.on_span, sources), effect };
        for &source in &rule.sources {
            let place = *places.entry((source, target.clone(), rule.back)).or_insert(edges.len());
            if place == edges.len() {
                edges.push(Edge { source, target: target.clone(), back: rule.back, guards: Vec::new() });
            }
            edges[place].guards.push(guard.clone());
        }
    }
    Some(Diagram {
        name: activity.name.clone(),
        start: *start,
        behaviors: behaviors.iter().map(|&b| hir.activities[b].name.clone()).collect(),
        edges,
    })
}

/// A stretch of the source on one line, without its comments.
fn written(span: Span, sources: &Sources) -> String {
    let text = syntax::uncommented(span.file, sources.text(span));
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The statements of a block as if they stood on one line.
fn statements(block: &Block, sources: &Sources) -> String {
    let texts: Vec<String> = block.stmts.iter().map(|stmt| written(stmt.span, sources)).collect();
    texts.join("; ")
}

/// A text as the script has it, with what stands in its holes.
fn text(parts: &[TextPart], sources: &Sources) -> String {
    let part = |part: &TextPart| match part {
        TextPart::Literal(text) => text.clone(),
        TextPart::Hole(e) => format!("{{{}}}", written(e.span, sources)),
    };
    parts.iter().map(part).collect()
}
