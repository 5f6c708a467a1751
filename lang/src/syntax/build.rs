//! From the grammar's pairs to the tree: files, items and blocks.

use super::Rule;
use super::build_block::block;
use super::build_expr::{cond, expr, name, path, text};
use super::tree::*;
use super::words::is_word;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span, Spanned};
use pest::iterators::{Pair, Pairs};

/// What building needs to know: which file, and where unreadable clauses are gathered.
pub(super) struct Builder {
    pub file: FileId,
    /// Where in the file the text begins that is being read.
    pub base: usize,
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

pub(super) type P<'a> = Pair<'a, Rule>;

impl Builder {
    pub fn new(file: FileId) -> Self {
        Builder { file, base: 0, bad: Vec::new(), refused: Vec::new(), height: 0 }
    }

    pub fn span(&self, pair: &P) -> Span {
        let span = pair.as_span();
        Span {
            file: self.file,
            start: (self.base + span.start()) as u32,
            end: (self.base + span.start() + span.as_str().trim_end().len()) as u32,
        }
    }

    pub fn bad(&mut self, pair: &P, place: Place) {
        let span = self.span(pair);
        self.bad.push(Bad { span, place, item: None });
    }
}

/// The children that are no keywords.
pub(super) fn parts(pair: P) -> impl Iterator<Item = P> {
    pair.into_inner().filter(|p| !is_word(p.as_rule()))
}

/// Takes the next child when it is of a kind.
pub(super) fn take<'a>(pairs: &mut std::iter::Peekable<impl Iterator<Item = P<'a>>>, rule: Rule) -> Option<P<'a>> {
    pairs.next_if(|p| p.as_rule() == rule)
}

pub(super) fn file(b: &mut Builder, pairs: Pairs<Rule>) -> File {
    let mut file = File::default();
    let mut pairs = pairs.flat_map(Pair::into_inner).peekable();
    while let Some(pair) = pairs.next() {
        match pair.as_rule() {
            Rule::EOI => {}
            Rule::bad_item => b.bad(&pair, Place::Item),
            Rule::headless => file.items.extend(within_item(b, pair, headless)),
            Rule::crowded => {
                let at = b.span(&pair);
                let word = pairs.peek().and_then(|next| next.as_str().split_whitespace().next()).unwrap_or("");
                let span = Span { end: at.start + word.len() as u32, ..at };
                b.refused.push(
                    Diagnostic::error(Code::LayoutLine, span, "this declaration begins on the line of another")
                        .help("begin each declaration on a line of its own"),
                );
            }
            _ => file.items.extend(within_item(b, pair, item)),
        }
    }
    file
}

/// Builds an item; what is unreadable in it stands in it.
fn within_item(b: &mut Builder, pair: P, build: impl FnOnce(&mut Builder, P) -> Option<Item>) -> Option<Item> {
    let (span, before) = (b.span(&pair), b.bad.len());
    let built = build(b, pair);
    b.bad[before..].iter_mut().for_each(|bad| bad.item = Some(span));
    built
}

/// An item whose block can be read, and not what stands before it. Nobody can name it: with what it is called is unknown.
fn headless(b: &mut Builder, pair: P) -> Option<Item> {
    let mut inner = pair.into_inner();
    let (head, body) = (inner.next()?, inner.next()?);
    let at = b.span(&head);
    b.bad.push(Bad { span: Span { end: b.span(&body).start + 1, ..at }, place: Place::Head, item: None });
    let mut words = head.as_str().split(|c: char| !c.is_alphanumeric() && c != '_');
    let word = words.next()?;
    let name = Name { node: format!("{}…", words.next().unwrap_or("")), span: at };
    let body = block(b, body);
    let kind = match word {
        "scenario" => return Some(Item::Scenario { name, params: Vec::new(), body }),
        "mission" => ActivityKind::Mission { scenario: None, within: None },
        "strategy" => ActivityKind::Strategy,
        _ => ActivityKind::Behavior,
    };
    Some(Item::Activity(Activity { kind, name, params: Vec::new(), result: None, body }))
}

fn item(b: &mut Builder, pair: P) -> Option<Item> {
    let rule = pair.as_rule();
    let span = b.span(&pair);
    let mut inner = parts(pair).peekable();
    Some(match rule {
        Rule::use_item => Item::Use(inner.map(|p| path(b, p)).collect()),
        Rule::const_item => Item::Const(Const {
            name: name(b, inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: expr(b, inner.next()?),
        }),
        Rule::enum_item => Item::Enum { name: name(b, inner.next()?), variants: inner.map(|p| name(b, p)).collect() },
        Rule::record_item => {
            Item::Record { name: name(b, inner.next()?), fields: inner.filter_map(|p| field(b, p)).collect() }
        }
        Rule::unit_item => Item::Unit { name: name(b, inner.next()?), value: expr(b, inner.next()?) },
        Rule::input_item => Item::Input {
            name: name(b, inner.next()?),
            ty: ty(b, inner.next()?),
            fields: inner.filter_map(|p| field(b, p)).collect(),
        },
        Rule::clause_item => Item::Clause {
            name: name(b, inner.next()?),
            params: take(&mut inner, Rule::clause_params).map(|p| params(b, p)).unwrap_or_default(),
            result: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            of_vehicle: take(&mut inner, Rule::of_vehicle).is_some(),
        },
        Rule::fn_item => Item::Fn(Function {
            name: name(b, inner.next()?),
            params: params(b, inner.next()?),
            result: ty(b, inner.next()?),
            body: block(b, inner.next()?),
        }),
        Rule::signal => Item::Signal {
            name: name(b, inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: cond(b, inner.next()?),
        },
        Rule::behavior | Rule::strategy | Rule::overlay | Rule::mission => Item::Activity(activity(b, rule, inner)?),
        Rule::scenario => Item::Scenario {
            name: name(b, inner.next()?),
            params: take(&mut inner, Rule::params).map(|p| params(b, p)).unwrap_or_default(),
            body: block(b, inner.next()?),
        },
        Rule::vehicle => Item::Vehicle { name: name(b, inner.next()?), body: block(b, inner.next()?) },
        Rule::test_item => {
            Item::Test(Test { name: text(b, inner.next()?), clauses: test_block(b, inner.next()?), span })
        }
        _ => return None,
    })
}

pub(super) fn activity<'a>(b: &mut Builder, rule: Rule, inner: impl Iterator<Item = P<'a>>) -> Option<Activity> {
    let mut inner = inner.peekable();
    let name = name(b, inner.next()?);
    let params = take(&mut inner, Rule::params).map(|p| params(b, p)).unwrap_or_default();
    let result = take(&mut inner, Rule::ty).map(|p| ty(b, p));
    let kind = match rule {
        Rule::strategy => ActivityKind::Strategy,
        Rule::overlay => {
            let mut kind = inner.next()?.into_inner();
            ActivityKind::Overlay { verb: self::name(b, kind.next()?), channel: self::name(b, kind.next()?) }
        }
        Rule::mission => ActivityKind::Mission {
            scenario: take(&mut inner, Rule::in_scenario).and_then(|p| parts(p).next()).map(|p| path(b, p)),
            within: take(&mut inner, Rule::mod_within).and_then(|p| parts(p).next()).map(|p| expr(b, p)),
        },
        _ => ActivityKind::Behavior,
    };
    Some(Activity { kind, name, params, result, body: block(b, inner.next()?) })
}

fn field(b: &mut Builder, pair: P) -> Option<Field> {
    if pair.as_rule() != Rule::field {
        return None;
    }
    let mut inner = pair.into_inner();
    Some(Field { name: name(b, inner.next()?), ty: ty(b, inner.next()?) })
}

pub(super) fn params(b: &mut Builder, pair: P) -> Vec<Param> {
    parts(pair).filter_map(|p| param(b, p)).collect()
}

fn param(b: &mut Builder, pair: P) -> Option<Param> {
    let mut inner = parts(pair).peekable();
    Some(Param {
        name: name(b, inner.next()?),
        ty: ty(b, inner.next()?),
        default: take(&mut inner, Rule::default).and_then(|p| p.into_inner().next()).map(|p| expr(b, p)),
        range: take(&mut inner, Rule::within_range).and_then(|p| parts(p).next()).and_then(|p| range(b, p)),
    })
}

pub(super) fn range(b: &mut Builder, pair: P) -> Option<Range> {
    let mut inner = pair.into_inner();
    let first = expr(b, inner.next()?);
    let inclusive = is_inclusive(&inner.next()?);
    Some(Range { first, last: expr(b, inner.next()?), inclusive })
}

/// Whether a range holds its end: `..<` does not.
pub(super) fn is_inclusive(range_op: &P) -> bool {
    range_op.as_str() == ".."
}

pub(super) fn ty(b: &mut Builder, pair: P) -> Ty {
    let span = b.span(&pair);
    let mut kind = TyKind::Named { path: Path { parts: Vec::new(), span }, factors: Vec::new() };
    let mut optional = false;
    for part in pair.into_inner() {
        match part.as_rule() {
            Rule::maybe => optional = true,
            Rule::list_ty => kind = list_ty(b, part).unwrap_or(kind),
            _ => kind = name_ty(b, part),
        }
    }
    Ty { kind, optional, span }
}

fn list_ty(b: &mut Builder, pair: P) -> Option<TyKind> {
    let mut inner = pair.into_inner();
    let element = Box::new(ty(b, inner.next()?));
    let capacity = Box::new(expr(b, inner.next()?));
    let order = inner.next().and_then(|order| {
        let mut words = parts(order);
        let most = words.next()?.as_rule() == Rule::w_most;
        Some((most, Box::new(expr(b, words.next()?))))
    });
    Some(TyKind::List { element, capacity, order })
}

fn name_ty(b: &mut Builder, pair: P) -> TyKind {
    let span = b.span(&pair);
    let mut path_ = Path { parts: Vec::new(), span };
    let mut factors = Vec::new();
    let mut divide = false;
    for part in pair.into_inner() {
        match part.as_rule() {
            Rule::path => path_ = path(b, part),
            Rule::dim_op => divide = part.as_str() == "/",
            // The path stands for its first power.
            Rule::number => {
                let power = part.as_str().parse().unwrap_or(1.0);
                factors.extend(path_.parts.first().map(|name| (name.clone(), power - 1.0)));
            }
            _ => {
                let mut inner = part.into_inner();
                let Some(factor) = inner.next().map(|p| name(b, p)) else { continue };
                let power: f64 = inner.next().and_then(|p| p.as_str().parse().ok()).unwrap_or(1.0);
                factors.push((factor, if divide { -power } else { power }));
            }
        }
    }
    TyKind::Named { path: path_, factors }
}

fn test_block(b: &mut Builder, pair: P) -> Vec<Spanned<TestClause>> {
    let mut clauses = Vec::new();
    for pair in pair.into_inner() {
        let span = b.span(&pair);
        if pair.as_rule() == Rule::bad {
            b.bad(&pair, Place::TestClause);
        } else {
            clauses.extend(test_clause(b, pair).map(|node| Spanned { node, span }));
        }
    }
    clauses
}

fn test_clause(b: &mut Builder, pair: P) -> Option<TestClause> {
    let rule = pair.as_rule();
    let mut inner = parts(pair).peekable();
    Some(match rule {
        Rule::run_clause => TestClause::Run {
            mission: path(b, inner.next()?),
            args: take(&mut inner, Rule::args).map(|p| super::build_expr::args(b, p)).unwrap_or_default(),
            scenario: path(b, inner.next()?),
            seeds: range(b, inner.next()?)?,
        },
        Rule::expect_clause => {
            let first = inner.next()?;
            match (first.as_rule(), inner.next()) {
                (Rule::w_all, Some(holds)) => TestClause::Expect { mode: ExpectMode::Always, holds: expr(b, holds) },
                (_, Some(holds)) => {
                    let share = expr(b, first);
                    TestClause::Expect { mode: ExpectMode::ShareOfRuns(share), holds: expr(b, holds) }
                }
                (_, None) => TestClause::Expect { mode: ExpectMode::EveryRun, holds: expr(b, first) },
            }
        }
        _ => TestClause::SnapshotSwitches { seed: inner.next()?.as_str().parse().ok()? },
    })
}
