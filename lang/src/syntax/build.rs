//! From the grammar's pairs to the tree: files, items and blocks.

use super::Rule;
use super::build_expr::{cond, expr, expr_stmt, name, path, text};
use super::tree::*;
use crate::source::{FileId, Span, Spanned};
use pest::iterators::{Pair, Pairs};

/// What building needs to know: which file, and where unreadable clauses are gathered.
pub(super) struct Builder {
    pub file: FileId,
    pub bad: Vec<Bad>,
    /// Expressions that are too long.
    pub long: Vec<Span>,
}

/// A stretch that the grammar could not read, and what was expected there.
pub(super) struct Bad {
    pub span: Span,
    pub place: Place,
}

/// Where a bad stretch stands, which tells how to look at it again.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Place {
    Item,
    Clause,
    TestClause,
}

type P<'a> = Pair<'a, Rule>;

impl Builder {
    pub fn span(&self, pair: &P) -> Span {
        let span = pair.as_span();
        Span {
            file: self.file,
            start: span.start() as u32,
            end: (span.start() + span.as_str().trim_end().len()) as u32,
        }
    }

    pub fn bad(&mut self, pair: &P, place: Place) {
        let span = self.span(pair);
        self.bad.push(Bad { span, place });
    }
}

/// The children that are no keywords.
pub(super) fn parts(pair: P) -> impl Iterator<Item = P> {
    pair.into_inner().filter(|p| !is_word(p.as_rule()))
}

fn is_word(rule: Rule) -> bool {
    use Rule::*;
    matches!(
        rule,
        kw_abort
            | kw_after
            | kw_and
            | kw_at
            | kw_becomes
            | kw_behavior
            | kw_by
            | kw_const
            | kw_do
            | kw_else
            | kw_enum
            | kw_fn
            | kw_for
            | kw_if
            | kw_in
            | kw_keep
            | kw_let
            | kw_log
            | kw_loop
            | kw_match
            | kw_memory
            | kw_mission
            | kw_no
            | kw_not
            | kw_of
            | kw_on
            | kw_or
            | kw_overlay
            | kw_record
            | kw_report
            | kw_scenario
            | kw_signal
            | kw_start
            | kw_strategy
            | kw_test
            | kw_then
            | kw_toward
            | kw_until
            | kw_use
            | kw_var
            | kw_while
            | kw_with
            | kw_within
            | w_amend
            | w_area
            | w_back
            | w_clause
            | w_expect
            | w_first
            | w_fresh
            | w_input
            | w_limits
            | w_recovery
            | w_requires
            | w_run
            | w_runs
            | w_seed
            | w_seeds
            | w_snapshot
            | w_switches
            | w_unit
            | arrow
            | entry_end
    )
}

/// Takes the next child when it is of a kind.
fn take<'a>(pairs: &mut std::iter::Peekable<impl Iterator<Item = P<'a>>>, rule: Rule) -> Option<P<'a>> {
    pairs.next_if(|p| p.as_rule() == rule)
}

pub(super) fn file(b: &mut Builder, pairs: Pairs<Rule>) -> File {
    let mut file = File::default();
    for pair in pairs.flat_map(Pair::into_inner) {
        match pair.as_rule() {
            Rule::EOI => {}
            Rule::bad_item => b.bad(&pair, Place::Item),
            _ => file.items.extend(item(b, pair)),
        }
    }
    file
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
        Rule::test_item => {
            Item::Test(Test { name: text(b, inner.next()?), clauses: test_block(b, inner.next()?), span })
        }
        _ => return None,
    })
}

fn activity<'a>(b: &mut Builder, rule: Rule, inner: impl Iterator<Item = P<'a>>) -> Option<Activity> {
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

fn range(b: &mut Builder, pair: P) -> Option<Range> {
    let mut inner = pair.into_inner();
    let first = expr(b, inner.next()?);
    let inclusive = inner.next()?.as_str() == "..";
    Some(Range { first, last: expr(b, inner.next()?), inclusive })
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

/// A block, or the lines of a prompt, which have no braces.
pub(super) fn block(b: &mut Builder, pair: P) -> Block {
    let span = b.span(&pair);
    let mut clauses = Vec::new();
    for pair in pair.into_inner() {
        match pair.as_rule() {
            Rule::EOI => {}
            Rule::bad => b.bad(&pair, Place::Clause),
            _ => {
                let span = b.span(&pair);
                clauses.extend(clause(b, pair).map(|kind| Clause { kind, span }));
            }
        }
    }
    Block { clauses, span }
}

fn clause(b: &mut Builder, pair: P) -> Option<ClauseKind> {
    let rule = pair.as_rule();
    let span = b.span(&pair);
    if rule == Rule::guided {
        return Some(ClauseKind::Timed(guided(b, pair)?));
    }
    if rule == Rule::expr_stmt {
        return Some(ClauseKind::Timed(expr_stmt(b, pair)?));
    }
    let mut inner = parts(pair).peekable();
    Some(match rule {
        Rule::behavior => ClauseKind::Behavior(activity(b, rule, inner)?),
        Rule::with => ClauseKind::With(inner.filter_map(|p| with_item(b, p)).collect()),
        Rule::signal => ClauseKind::Signal {
            name: name(b, inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: cond(b, inner.next()?),
        },
        Rule::memory => ClauseKind::Memory {
            name: name(b, inner.next()?),
            ty: ty(b, inner.next()?),
            init: inner.next().map(|p| expr(b, p)),
        },
        Rule::let_stmt => ClauseKind::Let {
            name: name(b, inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: {
                let value = inner.next()?;
                if value.as_rule() == Rule::guided { guided(b, value)? } else { expr_stmt(b, value)? }
            },
        },
        Rule::var_stmt => ClauseKind::Var {
            name: name(b, inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: expr(b, inner.next()?),
        },
        Rule::assign => ClauseKind::Assign { name: name(b, inner.next()?), value: expr(b, inner.next()?) },
        Rule::reaction => ClauseKind::Reaction { on: cond(b, inner.next()?), block: block(b, inner.next()?) },
        Rule::start => ClauseKind::Start(name(b, inner.next()?)),
        Rule::area => ClauseKind::Area { name: name(b, inner.next()?), value: expr(b, inner.next()?) },
        Rule::limits => ClauseKind::Limits(inner.map(|p| expr(b, p)).collect()),
        Rule::requires => ClauseKind::Requires(inner.filter_map(|p| require(b, p)).collect()),
        Rule::recovery => ClauseKind::Recovery {
            within: take(&mut inner, Rule::mod_within).and_then(|p| parts(p).next()).map(|p| expr(b, p)),
            block: block(b, inner.next()?),
        },
        Rule::amend => ClauseKind::Amend(block(b, inner.next()?)),
        Rule::abort => ClauseKind::Abort { why: text(b, inner.next()?), on: inner.next().map(|p| cond(b, p)) },
        Rule::finish => {
            let value = inner.find(|p| p.as_rule() == Rule::expr).map(|p| expr(b, p));
            ClauseKind::Finish(value)
        }
        Rule::report => ClauseKind::Report {
            name: text(b, inner.next()?),
            value: expr(b, inner.next()?),
            fields: inner
                .filter_map(|p| {
                    let mut field = p.into_inner();
                    Some((name(b, field.next()?), expr(b, field.next()?)))
                })
                .collect(),
        },
        Rule::log => ClauseKind::Log(expr(b, inner.next()?)),
        Rule::for_stmt => ClauseKind::For {
            name: name(b, inner.next()?),
            over: {
                let over = inner.next()?;
                if over.as_rule() == Rule::range {
                    ForOver::Range(range(b, over)?)
                } else {
                    ForOver::List(expr(b, over))
                }
            },
            block: block(b, inner.next()?),
        },
        Rule::while_stmt => ClauseKind::While {
            condition: super::build_expr::condition(b, inner.next()?)?,
            block: block(b, inner.next()?),
        },
        Rule::loop_stmt => ClauseKind::Loop(block(b, inner.next()?)),
        Rule::switching => ClauseKind::Rule(switching_rule(b, inner, span)?),
        _ => return None,
    })
}

fn with_item(b: &mut Builder, pair: P) -> Option<WithItem> {
    let item = pair.into_inner().next()?;
    Some(if item.as_rule() == Rule::setpoint {
        WithItem::Setpoint(setpoint(b, item)?)
    } else {
        WithItem::Overlay(expr(b, item))
    })
}

fn setpoint(b: &mut Builder, pair: P) -> Option<Setpoint> {
    let span = b.span(&pair);
    let mut inner = pair.into_inner();
    Some(Setpoint { channel: name(b, inner.next()?), value: expr(b, inner.next()?), span })
}

fn require(b: &mut Builder, pair: P) -> Option<Require> {
    let mut require = None;
    let mut inputs = Vec::new();
    for part in parts(pair) {
        match part.as_rule() {
            Rule::name => inputs.push(name(b, part)),
            Rule::expr => {
                let inputs = std::mem::take(&mut inputs);
                require =
                    Some(Require { inputs, fresh: expr(b, part), at_first: None, hold_for: None, answered: false });
            }
            Rule::at_first => require.as_mut()?.at_first = parts(part).next().map(|p| expr(b, p)),
            _ => {
                let hold_for = part.into_inner().find(|p| p.as_rule() == Rule::expr).map(|p| expr(b, p));
                let require = require.as_mut()?;
                require.hold_for = hold_for;
                require.answered = true;
            }
        }
    }
    require
}

fn switching_rule<'a>(b: &mut Builder, inner: impl Iterator<Item = P<'a>>, span: Span) -> Option<SwitchingRule> {
    let mut rule = SwitchingRule {
        sources: Vec::new(),
        sources_span: span,
        target: Target::Finish(None, span),
        on: Expr { kind: ExprKind::Bool(false), span },
        back: None,
        effect: None,
    };
    for part in inner {
        let span = b.span(&part);
        match part.as_rule() {
            Rule::sources => {
                rule.sources_span = span;
                rule.sources = part.into_inner().filter(|p| p.as_rule() == Rule::name).map(|p| name(b, p)).collect();
            }
            Rule::target => {
                let words: Vec<P> = part.into_inner().collect();
                let value = words.get(1).cloned();
                rule.target = match words.first()?.as_rule() {
                    Rule::kw_finish => Target::Finish(value.map(|p| expr(b, p)), span),
                    Rule::kw_abort => Target::Abort(text(b, value?), span),
                    _ => Target::Behavior(name(b, words.first()?.clone())),
                };
            }
            Rule::cond => rule.on = cond(b, part),
            Rule::then_back => rule.back = Some(span),
            _ => rule.effect = parts(part).next().map(|p| block(b, p)),
        }
    }
    Some(rule)
}

fn guided(b: &mut Builder, pair: P) -> Option<Timed> {
    let span = b.span(&pair);
    let mut inner = pair.into_inner().peekable();
    let first = inner.next()?;
    let action = match first.as_rule() {
        Rule::verb => {
            let verb = name(b, first);
            let mut args = Vec::new();
            while let Some(arg) = take(&mut inner, Rule::arg) {
                args.extend(super::build_expr::arg(b, arg));
            }
            Action::Guide { verb, args }
        }
        Rule::kw_keep => Action::Keep(setpoint(b, inner.next()?)?),
        Rule::kw_hold => Action::Hold,
        Rule::kw_wait => Action::Wait,
        _ if first.as_str().starts_with("watch") => Action::Watch,
        _ => Action::Override,
    };
    Some(modified(b, action, inner, span))
}

/// Reads the modifiers of a statement, each once at most.
pub(super) fn modified<'a>(b: &mut Builder, action: Action, pairs: impl Iterator<Item = P<'a>>, span: Span) -> Timed {
    let mut timed = Timed { action, duration: None, until: None, within: None, at: Vec::new(), repeated: None, span };
    for pair in pairs {
        let place = b.span(&pair);
        let rule = pair.as_rule();
        let mut inner = parts(pair).peekable();
        let taken = match rule {
            Rule::mod_for => inner.next().and_then(|p| timed.duration.replace(expr(b, p))).is_some(),
            Rule::mod_until => inner.next().and_then(|p| timed.until.replace(cond(b, p))).is_some(),
            Rule::mod_within => inner.next().and_then(|p| timed.within.replace(expr(b, p))).is_some(),
            _ => {
                let twice = !timed.at.is_empty();
                timed.at.extend(inner.filter_map(|p| setpoint(b, p)));
                twice
            }
        };
        if taken {
            timed.repeated = Some(place);
        }
    }
    timed
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
