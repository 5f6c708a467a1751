//! From the concrete tree to the tree of what is said: files, items and blocks.

use super::Rule;
use super::build_block::block;
use super::build_expr::{cond, expr, name, path, text};
use super::concrete::Node;
use super::tree::*;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{Span, Spanned};
use std::iter::Peekable;

/// What is gathered while a tree is built.
pub(super) struct Builder<'t> {
    /// The source, with blanks for its comments.
    pub prepared: &'t str,
    /// The stretches that could not be read.
    pub bad: Vec<Bad>,
    /// What is read and still refused.
    pub refused: Vec<Diagnostic>,
    /// How deep the deepest of the expressions built so far is nested, in the one around them.
    pub height: usize,
}

/// A stretch that the grammar could not read, and what was expected there.
pub(super) struct Bad {
    pub span: Span,
    pub place: Place,
    /// The declaration in which it stands.
    pub item: Option<Span>,
}

/// Where a bad stretch stands, which tells how to look at it again.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Place {
    Item,
    /// A declaration up to its `{`: its block could be read.
    Head,
    Clause,
    TestClause,
}

impl<'t> Builder<'t> {
    pub fn new(prepared: &'t str) -> Self {
        Builder { prepared, bad: Vec::new(), refused: Vec::new(), height: 0 }
    }

    pub fn bad(&mut self, node: Node, place: Place) {
        self.bad.push(Bad { span: node.span(), place, item: None });
    }
}

/// Takes the next child when it is of a kind.
pub(super) fn take<'a>(nodes: &mut Peekable<impl Iterator<Item = Node<'a>>>, rule: Rule) -> Option<Node<'a>> {
    nodes.next_if(|p| p.rule() == rule)
}

pub(super) fn file(b: &mut Builder, root: Node) -> File {
    let mut file = File::default();
    let mut nodes = root.inner().peekable();
    while let Some(node) = nodes.next() {
        match node.rule() {
            Rule::bad_item => b.bad(node, Place::Item),
            Rule::headless => file.items.extend(within_item(b, node, headless)),
            Rule::crowded => {
                let at = node.span();
                let word = nodes.peek().and_then(|next| next.text().split_whitespace().next()).unwrap_or("");
                let span = Span { end: at.start + word.len() as u32, ..at };
                b.refused.push(
                    Diagnostic::error(Code::LayoutLine, span, "this declaration begins on the line of another")
                        .help("begin each declaration on a line of its own"),
                );
            }
            _ => file.items.extend(within_item(b, node, item)),
        }
    }
    file
}

/// Builds an item; what is unreadable in it stands in it.
fn within_item(b: &mut Builder, node: Node, build: impl FnOnce(&mut Builder, Node) -> Option<Item>) -> Option<Item> {
    let (span, before) = (node.span(), b.bad.len());
    let built = build(b, node);
    b.bad[before..].iter_mut().for_each(|bad| bad.item = Some(span));
    built
}

/// An item whose block can be read, and not what stands before it. Nobody can name it: with what it is called is unknown.
fn headless(b: &mut Builder, node: Node) -> Option<Item> {
    let mut inner = node.inner();
    let (head, body) = (inner.next()?, inner.next()?);
    let at = head.span();
    b.bad.push(Bad { span: Span { end: body.span().start + 1, ..at }, place: Place::Head, item: None });
    let mut words = head.text().split(|c: char| !c.is_alphanumeric() && c != '_');
    let word = words.next()?;
    let name = Name { node: format!("{}…", words.next().unwrap_or("")), span: at };
    let body = block(b, body);
    let kind = match word {
        "scenario" => return Some(Item::Scenario { name, params: Vec::new(), base: None, body }),
        "mission" => ActivityKind::Mission { scenario: None, within: None },
        "strategy" => ActivityKind::Strategy { base: None },
        _ => ActivityKind::Behavior,
    };
    Some(Item::Activity(Activity { kind, name, params: Vec::new(), result: None, body }))
}

fn item(b: &mut Builder, node: Node) -> Option<Item> {
    let rule = node.rule();
    let span = node.span();
    let mut inner = node.parts().peekable();
    Some(match rule {
        Rule::use_item => Item::Use(inner.map(path).collect()),
        Rule::const_item => Item::Const(Const {
            name: name(inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: expr(b, inner.next()?),
        }),
        Rule::enum_item => Item::Enum { name: name(inner.next()?), variants: inner.map(name).collect() },
        Rule::record_item => {
            Item::Record { name: name(inner.next()?), fields: inner.filter_map(|p| field(b, p)).collect() }
        }
        Rule::unit_item => Item::Unit { name: name(inner.next()?), value: expr(b, inner.next()?) },
        Rule::input_item => Item::Input {
            name: name(inner.next()?),
            ty: ty(b, inner.next()?),
            fields: inner.filter_map(|p| field(b, p)).collect(),
        },
        Rule::clause_item => Item::Clause {
            name: name(inner.next()?),
            params: take(&mut inner, Rule::clause_params).map(|p| params(b, p)).unwrap_or_default(),
            result: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            of_vehicle: take(&mut inner, Rule::of_vehicle).is_some(),
        },
        Rule::fn_item => Item::Fn(Function {
            name: name(inner.next()?),
            params: params(b, inner.next()?),
            result: ty(b, inner.next()?),
            body: block(b, inner.next()?),
        }),
        Rule::signal => Item::Signal {
            name: name(inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: cond(b, inner.next()?),
        },
        Rule::behavior | Rule::strategy | Rule::overlay | Rule::mission => Item::Activity(activity(b, rule, inner)?),
        Rule::scenario => Item::Scenario {
            name: name(inner.next()?),
            params: take(&mut inner, Rule::params).map(|p| params(b, p)).unwrap_or_default(),
            base: take(&mut inner, Rule::derived_from).and_then(|p| p.parts().next()).map(path),
            body: block(b, inner.next()?),
        },
        Rule::vehicle => Item::Vehicle {
            name: name(inner.next()?),
            base: take(&mut inner, Rule::derived_from).and_then(|p| p.parts().next()).map(path),
            body: block(b, inner.next()?),
        },
        Rule::payload_item => {
            Item::Payload { name: name(inner.next()?), actions: inner.filter_map(|p| payload_action(b, p)).collect() }
        }
        Rule::test_item => {
            Item::Test(Test { name: text(b, inner.next()?), clauses: test_block(b, inner.next()?), span })
        }
        _ => return None,
    })
}

pub(super) fn activity<'a>(b: &mut Builder, rule: Rule, inner: impl Iterator<Item = Node<'a>>) -> Option<Activity> {
    let mut inner = inner.peekable();
    let name = name(inner.next()?);
    let params = take(&mut inner, Rule::params).map(|p| params(b, p)).unwrap_or_default();
    let result = take(&mut inner, Rule::ty).map(|p| ty(b, p));
    let kind = match rule {
        Rule::strategy => ActivityKind::Strategy {
            base: take(&mut inner, Rule::derived_from).and_then(|p| p.parts().next()).map(path),
        },
        Rule::overlay => {
            let mut does = take(&mut inner, Rule::overlay_kind).into_iter().flat_map(Node::inner);
            ActivityKind::Overlay {
                does: does.next().zip(does.next()).map(|(verb, channel)| (self::name(verb), self::name(channel))),
            }
        }
        Rule::mission => ActivityKind::Mission {
            scenario: take(&mut inner, Rule::in_scenario).and_then(|p| p.parts().next()).map(path),
            within: take(&mut inner, Rule::mod_within).and_then(|p| p.parts().next()).map(|p| expr(b, p)),
        },
        _ => ActivityKind::Behavior,
    };
    Some(Activity { kind, name, params, result, body: block(b, inner.next()?) })
}

fn field(b: &mut Builder, node: Node) -> Option<Field> {
    if node.rule() != Rule::field {
        return None;
    }
    let mut inner = node.inner();
    Some(Field { name: name(inner.next()?), ty: ty(b, inner.next()?) })
}

fn payload_action(b: &mut Builder, node: Node) -> Option<PayloadAction> {
    let mut inner = node.parts();
    Some(PayloadAction { name: name(inner.next()?), result: ty(b, inner.next()?) })
}

pub(super) fn params(b: &mut Builder, node: Node) -> Vec<Param> {
    node.parts().filter_map(|p| param(b, p)).collect()
}

fn param(b: &mut Builder, node: Node) -> Option<Param> {
    let mut inner = node.parts().peekable();
    Some(Param {
        name: name(inner.next()?),
        ty: ty(b, inner.next()?),
        default: take(&mut inner, Rule::default).and_then(|p| p.inner().next()).map(|p| expr(b, p)),
        range: take(&mut inner, Rule::within_range).and_then(|p| p.parts().next()).and_then(|p| range(b, p)),
    })
}

pub(super) fn range(b: &mut Builder, node: Node) -> Option<Range> {
    let mut inner = node.inner();
    let first = expr(b, inner.next()?);
    let inclusive = is_inclusive(inner.next()?);
    Some(Range { first, last: expr(b, inner.next()?), inclusive })
}

/// Whether a range holds its end: `..<` does not.
pub(super) fn is_inclusive(range_op: Node) -> bool {
    range_op.text() == ".."
}

fn behavior_ty(b: &mut Builder, node: Node) -> TyKind {
    let is_result = node.inner().any(|part| part.rule() == Rule::arrow);
    let mut types: Vec<Ty> = node.parts().map(|part| ty(b, part)).collect();
    let result = if is_result { types.pop() } else { None };
    TyKind::Behavior(types, result.map(Box::new))
}

pub(super) fn ty(b: &mut Builder, node: Node) -> Ty {
    let span = node.span();
    let mut kind = TyKind::Named { path: Path { parts: Vec::new(), span }, factors: Vec::new() };
    let mut optional = false;
    for part in node.inner() {
        match part.rule() {
            Rule::maybe => optional = true,
            Rule::list_ty => kind = list_ty(b, part).unwrap_or(kind),
            Rule::map_ty => kind = map_ty(b, part).unwrap_or(kind),
            Rule::behavior_ty => kind = behavior_ty(b, part),
            _ => kind = name_ty(part),
        }
    }
    Ty { kind, optional, span }
}

fn list_ty(b: &mut Builder, node: Node) -> Option<TyKind> {
    let mut inner = node.inner();
    let element = Box::new(ty(b, inner.next()?));
    let capacity = Box::new(expr(b, inner.next()?));
    let order = inner.next().and_then(|order| {
        let most = order.inner().any(|word| word.rule() == Rule::w_most);
        Some((most, Box::new(expr(b, order.parts().next()?))))
    });
    Some(TyKind::List { element, capacity, order })
}

fn map_ty(b: &mut Builder, node: Node) -> Option<TyKind> {
    let mut parts = node.parts();
    let element = Box::new(ty(b, parts.next()?));
    Some(TyKind::Map { element, cells: Box::new(expr(b, parts.next()?)) })
}

fn name_ty(node: Node) -> TyKind {
    let span = node.span();
    let mut path_ = Path { parts: Vec::new(), span };
    let mut factors = Vec::new();
    let mut divide = false;
    for part in node.inner() {
        match part.rule() {
            Rule::path => path_ = path(part),
            Rule::dim_op => divide = part.text() == "/",
            // The path stands for its first power.
            Rule::number => {
                let power = part.text().parse().unwrap_or(1.0);
                factors.extend(path_.parts.first().map(|name| (name.clone(), power - 1.0)));
            }
            _ => {
                let mut inner = part.inner();
                let Some(factor) = inner.next().map(name) else { continue };
                let power: f64 = inner.next().and_then(|p| p.text().parse().ok()).unwrap_or(1.0);
                factors.push((factor, if divide { -power } else { power }));
            }
        }
    }
    TyKind::Named { path: path_, factors }
}

fn test_block(b: &mut Builder, node: Node) -> Vec<Spanned<TestClause>> {
    let mut clauses = Vec::new();
    for node in node.inner() {
        let span = node.span();
        if node.rule() == Rule::bad {
            b.bad(node, Place::TestClause);
        } else {
            clauses.extend(test_clause(b, node).map(|node| Spanned { node, span }));
        }
    }
    clauses
}

fn test_clause(b: &mut Builder, node: Node) -> Option<TestClause> {
    let rule = node.rule();
    let mut inner = node.parts().peekable();
    Some(match rule {
        Rule::run_clause => TestClause::Run {
            mission: path(inner.next()?),
            args: take(&mut inner, Rule::args).map(|p| super::build_expr::args(b, p)).unwrap_or_default(),
            scenario: path(inner.next()?),
            seeds: range(b, inner.next()?)?,
        },
        Rule::row_clause => TestClause::Row {
            args: inner
                .filter_map(|labelled| {
                    let mut parts = labelled.inner();
                    Some(Arg { label: Some(name(parts.next()?)), value: expr(b, parts.next()?) })
                })
                .collect(),
        },
        Rule::expect_clause => {
            let has = |mode: Rule| node.inner().any(|word| word.rule() == mode);
            if let Some(behavior) = take(&mut inner, Rule::path).map(path) {
                return Some(TestClause::Expect { mode: ExpectMode::While(behavior), holds: expr(b, inner.next()?) });
            }
            let first = expr(b, inner.next()?);
            let (mode, holds) = match inner.next() {
                Some(holds) => (ExpectMode::ShareOfRuns(first), expr(b, holds)),
                None if has(Rule::w_always) => (ExpectMode::Always, first),
                None if has(Rule::w_once) => (ExpectMode::Once, first),
                None => (ExpectMode::EveryRun, first),
            };
            TestClause::Expect { mode, holds }
        }
        _ => TestClause::SnapshotSwitches { seed: inner.next()?.text().parse().ok()? },
    })
}
