//! From the concrete tree to the tree of what is said: blocks and their clauses.

use super::build::{Builder, Place, activity, is_inclusive, take, ty};
use super::build_expr::{cond, expr, expr_stmt, name, text};
use super::concrete::Node;
use super::tree::*;
use super::{NESTING_MAX, Rule};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use std::iter::Peekable;

/// A block, or the lines of a prompt, which have no braces.
pub(super) fn block(b: &mut Builder, node: Node) -> Block {
    let span = node.span();
    // A clause is large, and most blocks hold few: a vector that grows would take room for more than there are.
    let mut clauses = Vec::with_capacity(node.inner().count());
    for node in node.inner() {
        match node.rule() {
            Rule::bad => b.bad(node, Place::Clause),
            _ => {
                let span = node.span();
                clauses.extend(clause(b, node).map(|kind| Clause { kind, span }));
            }
        }
    }
    // Each `with` holds what comes after it: so many of them nest as deep as so many brackets.
    let is_with = |c: &&Clause| matches!(c.kind, ClauseKind::With(_));
    if let Some(at) = clauses.iter().filter(is_with).nth(NESTING_MAX).map(|c| c.span) {
        b.refused.push(
            Diagnostic::error(Code::SyntaxNesting, at, format!("more than {NESTING_MAX} `with` stand in this block"))
                .help("write what holds together in one `with`, between commas"),
        );
        clauses.truncate(NESTING_MAX);
    }
    Block { clauses, span }
}

fn clause(b: &mut Builder, node: Node) -> Option<ClauseKind> {
    let rule = node.rule();
    let span = node.span();
    if rule == Rule::guided {
        return Some(ClauseKind::Timed(guided(b, node)?));
    }
    if rule == Rule::expr_stmt {
        return Some(ClauseKind::Timed(expr_stmt(b, node)?));
    }
    let mut inner = node.parts().peekable();
    Some(match rule {
        Rule::behavior => ClauseKind::Behavior(activity(b, rule, inner)?),
        Rule::with => ClauseKind::With(inner.filter_map(|p| with_item(b, p)).collect()),
        Rule::signal => ClauseKind::Signal {
            name: name(inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: cond(b, inner.next()?),
        },
        Rule::memory => ClauseKind::Memory {
            name: name(inner.next()?),
            ty: ty(b, inner.next()?),
            init: inner.next().map(|p| expr(b, p)),
        },
        Rule::let_stmt => ClauseKind::Let {
            name: name(inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: {
                let value = inner.next()?;
                if value.rule() == Rule::guided { guided(b, value)? } else { expr_stmt(b, value)? }
            },
        },
        Rule::var_stmt => ClauseKind::Var {
            name: name(inner.next()?),
            ty: take(&mut inner, Rule::ty).map(|p| ty(b, p)),
            value: expr(b, inner.next()?),
        },
        Rule::assign => assign(b, node)?,
        Rule::reaction => ClauseKind::Reaction { on: cond(b, inner.next()?), block: block(b, inner.next()?) },
        Rule::start => ClauseKind::Start(name(inner.next()?)),
        Rule::area => ClauseKind::Area { name: name(inner.next()?), value: expr(b, inner.next()?) },
        Rule::limits => ClauseKind::Limits(inner.map(|p| expr(b, p)).collect()),
        Rule::requires => ClauseKind::Requires(inner.filter_map(|p| require(b, p)).collect()),
        Rule::recovery => ClauseKind::Recovery {
            within: take(&mut inner, Rule::mod_within).and_then(|p| p.parts().next()).map(|p| expr(b, p)),
            block: block(b, inner.next()?),
        },
        Rule::recording => recording(b, &mut inner)?,
        Rule::amend => ClauseKind::Amend(block(b, inner.next()?)),
        Rule::abort => ClauseKind::Abort { why: text(b, inner.next()?), on: inner.next().map(|p| cond(b, p)) },
        Rule::finish => ClauseKind::Finish(inner.find(|p| p.rule() == Rule::expr).map(|p| expr(b, p))),
        Rule::report => ClauseKind::Report {
            name: text(b, inner.next()?),
            value: expr(b, inner.next()?),
            fields: inner
                .filter_map(|p| {
                    let mut field = p.inner();
                    Some((name(field.next()?), expr(b, field.next()?)))
                })
                .collect(),
        },
        Rule::log => ClauseKind::Log(expr(b, inner.next()?)),
        Rule::for_stmt => {
            let element = name(inner.next()?);
            let place = inner.next_if(|next| next.rule() == Rule::name).map(name);
            let first = expr(b, inner.next()?);
            let over = match inner.next_if(|next| next.rule() == Rule::range_op) {
                Some(op) => ForOver::Range(Range { first, inclusive: is_inclusive(op), last: expr(b, inner.next()?) }),
                None => ForOver::List(first),
            };
            ClauseKind::For { name: element, place, over, block: block(b, inner.next()?) }
        }
        Rule::while_stmt => ClauseKind::While {
            condition: super::build_expr::condition(b, inner.next()?)?,
            block: block(b, inner.next()?),
        },
        Rule::loop_stmt => ClauseKind::Loop(block(b, inner.next()?)),
        Rule::switching => ClauseKind::Rule(switching_rule(b, inner, span)?),
        _ => return None,
    })
}

fn recording<'a>(b: &mut Builder, inner: &mut Peekable<impl Iterator<Item = Node<'a>>>) -> Option<ClauseKind> {
    let inputs = std::iter::from_fn(|| take(inner, Rule::name)).map(name).collect();
    Some(ClauseKind::Recording { inputs, rate: expr(b, inner.next()?) })
}

fn with_item(b: &mut Builder, node: Node) -> Option<WithItem> {
    let item = node.inner().next()?;
    Some(if item.rule() == Rule::setpoint {
        WithItem::Setpoint(setpoint(b, item)?)
    } else {
        WithItem::Overlay(expr(b, item))
    })
}

fn setpoint(b: &mut Builder, node: Node) -> Option<Setpoint> {
    let span = node.span();
    let mut inner = node.inner();
    Some(Setpoint { channel: name(inner.next()?), value: expr(b, inner.next()?), span })
}

fn require(b: &mut Builder, node: Node) -> Option<Require> {
    let mut require = None;
    let mut inputs = Vec::new();
    for part in node.parts() {
        match part.rule() {
            Rule::name => inputs.push(name(part)),
            Rule::expr => {
                let inputs = std::mem::take(&mut inputs);
                require =
                    Some(Require { inputs, fresh: expr(b, part), at_first: None, hold_for: None, answered: false });
            }
            Rule::at_first => require.as_mut()?.at_first = part.parts().next().map(|p| expr(b, p)),
            _ => {
                let hold_for = part.inner().find(|p| p.rule() == Rule::expr).map(|p| expr(b, p));
                let require = require.as_mut()?;
                require.hold_for = hold_for;
                require.answered = true;
            }
        }
    }
    require
}

fn switching_rule<'a>(b: &mut Builder, inner: impl Iterator<Item = Node<'a>>, span: Span) -> Option<SwitchingRule> {
    let mut rule = SwitchingRule {
        sources: Vec::new(),
        sources_span: span,
        target: Target::Finish(None, span),
        on: Expr { kind: ExprKind::Bool(false), span },
        back: None,
        effect: None,
    };
    for part in inner {
        let span = part.span();
        match part.rule() {
            Rule::sources => {
                rule.sources_span = span;
                rule.sources = part.inner().filter(|p| p.rule() == Rule::name).map(name).collect();
            }
            Rule::target => {
                let words: Vec<Node> = part.inner().collect();
                let value = words.get(1).copied();
                rule.target = match words.first()?.rule() {
                    Rule::kw_finish => Target::Finish(value.map(|p| expr(b, p)), span),
                    Rule::kw_abort => Target::Abort(text(b, value?), span),
                    _ => Target::Behavior(name(*words.first()?)),
                };
            }
            Rule::cond => rule.on = cond(b, part),
            Rule::then_back => rule.back = Some(span),
            _ => rule.effect = part.parts().next().map(|p| block(b, p)),
        }
    }
    Some(rule)
}

fn guided(b: &mut Builder, node: Node) -> Option<Timed> {
    let span = node.span();
    let mut inner = node.inner().peekable();
    let first = inner.next()?;
    let action = match first.rule() {
        Rule::verb => {
            let verb = name(first);
            let mut args = Vec::new();
            while let Some(arg) = take(&mut inner, Rule::arg) {
                args.extend(super::build_expr::arg(b, arg));
            }
            Action::Guide { verb, args }
        }
        Rule::kw_keep => Action::Keep(setpoint(b, inner.next()?)?),
        Rule::kw_hold => Action::Hold,
        Rule::kw_wait => Action::Wait,
        Rule::watch => Action::Watch,
        Rule::ask => Action::Ask(ask(first.parts().next()?)?),
        _ => Action::Override(override_block(b, first)?),
    };
    Some(modified(b, action, inner, span))
}

fn ask(node: Node) -> Option<Ask> {
    let Path { mut parts, span } = super::build_expr::path(node);
    let action = parts.pop()?;
    let end = parts.last()?.span.end;
    Some(Ask { payload: Path { parts, span: Span { end, ..span } }, action })
}

fn override_block(b: &mut Builder, node: Node) -> Option<Override> {
    let mut inner = node.parts().peekable();
    let offered = take(&mut inner, Rule::when_offered).is_some();
    let answer = take(&mut inner, Rule::mod_within).and_then(|p| p.parts().next()).map(|p| expr(b, p));
    Some(Override { offered, answer, block: block(b, inner.next()?) })
}

fn assign(b: &mut Builder, node: Node) -> Option<ClauseKind> {
    let mut inner = node.parts().peekable();
    let name = name(inner.next()?);
    let index = take(&mut inner, Rule::index).and_then(|index| Some(expr(b, index.inner().next()?)));
    Some(ClauseKind::Assign { name, index, value: expr(b, inner.next()?) })
}

/// Reads the modifiers of a statement, each once at most.
pub(super) fn modified<'a>(
    b: &mut Builder,
    action: Action,
    pairs: impl Iterator<Item = Node<'a>>,
    span: Span,
) -> Timed {
    let mut timed = Timed { action, duration: None, until: None, within: None, at: Vec::new(), repeated: None, span };
    for node in pairs {
        let place = node.span();
        let rule = node.rule();
        let mut inner = node.parts().peekable();
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
