//! What a page tells of each kind of declaration.

use super::comments::Comments;
use super::written::Written;
use super::{Behavior, Declaration, Param};
use crate::source::Span;
use crate::tree::{self, Activity, ActivityKind, Block, Clause, ClauseKind, Item};

/// What is told of an item; nothing of imports and tests.
pub fn declaration(item: &Item, span: Span, written: &Written, comments: &mut Comments) -> Option<Declaration> {
    // The comment belongs to the item in any case.
    let text = comments.above(span.start);
    let mut told = match item {
        Item::Use(_) | Item::Test(_) => return None,
        Item::Const(c) => whole("const", &c.name, span, written),
        Item::Unit { name, .. } => whole("unit", name, span, written),
        Item::Signal { name, .. } => whole("signal", name, span, written),
        Item::Enum { name, variants } => {
            variants.iter().for_each(|variant| drop(comments.above(variant.span.start)));
            whole("enum", name, span, written)
        }
        Item::Record { name, fields } => {
            fields.iter().for_each(|field| drop(comments.above(field.name.span.start)));
            whole("record", name, span, written)
        }
        Item::Payload { name, actions } => {
            actions.iter().for_each(|action| drop(comments.above(action.name.span.start)));
            whole("payload", name, span, written)
        }
        Item::Input { name, fields, .. } => {
            fields.iter().for_each(|field| drop(comments.above(field.name.span.start)));
            whole("input", name, span, written)
        }
        Item::Clause { name, params, result, .. } => Declaration {
            params: self::params(params, written, comments),
            result: result.as_ref().map(|ty| written.of(ty.span)),
            ..whole("clause", name, span, written)
        },
        Item::Fn(f) => Declaration {
            written: written.head(span, &f.body),
            params: params(&f.params, written, comments),
            result: Some(written.of(f.result.span)),
            ..whole("fn", &f.name, span, written)
        },
        Item::Scenario { name, params, body, .. } => {
            body.clauses.iter().for_each(|clause| drop(comments.above(clause.span.start)));
            Declaration { params: self::params(params, written, comments), ..whole("scenario", name, span, written) }
        }
        Item::Vehicle { name, body, .. } => {
            body.clauses.iter().for_each(|clause| drop(comments.above(clause.span.start)));
            whole("vehicle", name, span, written)
        }
        Item::Activity(a) => activity(a, span, written, comments),
    };
    told.text = text;
    Some(told)
}

/// A declaration that is told as a whole.
fn whole(word: &'static str, name: &tree::Name, span: Span, written: &Written) -> Declaration {
    Declaration { word, name: name.node.clone(), written: written.lines(span), ..Declaration::default() }
}

fn activity(a: &Activity, span: Span, written: &Written, comments: &mut Comments) -> Declaration {
    let word = match a.kind {
        ActivityKind::Behavior => "behavior",
        ActivityKind::Strategy { .. } => "strategy",
        ActivityKind::Overlay { .. } => "overlay",
        ActivityKind::Mission { .. } => "mission",
    };
    let params = params(&a.params, written, comments);
    let behaviors = behaviors(&a.body, comments);
    belonging(&a.body, comments);
    let lines = |wanted: fn(&ClauseKind) -> bool| -> Option<String> {
        let clauses: Vec<String> =
            a.body.clauses.iter().filter(|c| wanted(&c.kind)).map(|c| written.lines(c.span)).collect();
        (!clauses.is_empty()).then(|| clauses.join("\n"))
    };
    let rules = lines(|kind| matches!(kind, ClauseKind::Start(_) | ClauseKind::Rule(_)));
    let signals = lines(|kind| matches!(kind, ClauseKind::Signal { .. }));
    Declaration {
        word,
        name: a.name.node.clone(),
        written: written.head(span, &a.body),
        params,
        result: a.result.as_ref().map(|ty| written.of(ty.span)),
        terms: if word == "mission" { lines(is_term) } else { None },
        behaviors,
        table: rules.map(|rules| signals.map(|signals| format!("{signals}\n\n{rules}")).unwrap_or(rules)),
        ..Declaration::default()
    }
}

/// What a mission says before it does anything.
fn is_term(kind: &ClauseKind) -> bool {
    use ClauseKind::{Area, Limits, Recording, Recovery, Requires};
    matches!(kind, Area { .. } | Limits(_) | Requires(_) | Recovery { .. } | Recording { .. })
}

fn behaviors(body: &Block, comments: &mut Comments) -> Vec<Behavior> {
    let declared = |clause: &Clause| {
        let ClauseKind::Behavior(behavior) = &clause.kind else { return None };
        let above = comments.above(clause.span.start);
        let text = if above.is_empty() { comments.behind(behavior.body.span.start) } else { above };
        Some(Behavior { name: behavior.name.node.clone(), text })
    };
    body.clauses.iter().filter_map(declared).collect()
}

/// Comments above a clause at the top of an activity belong to that, though no page shows them.
fn belonging(body: &Block, comments: &mut Comments) {
    for clause in &body.clauses {
        let _ = comments.above(clause.span.start);
        if let ClauseKind::Behavior(behavior) = &clause.kind {
            belonging(&behavior.body, comments);
        }
    }
}

fn params(params: &[tree::Param], written: &Written, comments: &mut Comments) -> Vec<Param> {
    let told = |(i, param): (usize, &tree::Param)| {
        let start = param.name.span.start;
        let range = param.range.as_ref().map(|range| Span { end: range.last.span.end, ..range.first.span });
        // What stands behind several parameters is of none of them.
        let is_alone = |other: Option<&tree::Param>, before: bool| {
            other.is_none_or(|other| {
                let at = other.name.span.start;
                let between = if before { written.between(at, start) } else { written.between(start, at) };
                between.contains('\n')
            })
        };
        let before = i.checked_sub(1).and_then(|i| params.get(i));
        let above = comments.above(start);
        let text = if above.is_empty() && is_alone(before, true) && is_alone(params.get(i + 1), false) {
            comments.behind(range.map_or(param.ty.span.end, |range| range.end))
        } else {
            above
        };
        Param {
            name: param.name.node.clone(),
            ty: written.of(param.ty.span),
            default: param.default.as_ref().map(|default| written.of(default.span)),
            range: range.map(|range| written.of(range)),
            text,
        }
    };
    params.iter().enumerate().map(told).collect()
}
