//! From the concrete tree to the tree of what is said: expressions, by precedence climbing over the flat list that the grammar gives.

use super::Rule;
use super::build::Builder;
use super::build_block::{block, modified};
use super::concrete::Node;
use super::tree::*;
use super::{errors, places};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{Span, Spanned};
use albacore_program::calendar;

/// An expression has this many operands and operators at most, and an operand this many suffixes.
const TERMS_MAX: usize = 256;

/// An expression is nested this deep at most, by whatever nests it: all that comes after goes down by calling itself.
const HEIGHT_MAX: usize = 256;

pub(super) fn name(node: Node) -> Name {
    Spanned { node: node.text().to_string(), span: node.span() }
}

pub(super) fn path(node: Node) -> Path {
    let span = node.span();
    Path { parts: node.inner().map(|p| name(p)).collect(), span }
}

pub(super) fn cond(b: &mut Builder, node: Node) -> Expr {
    let span = node.span();
    let mut inner = node.parts();
    let holds = inner.next().map(|p| expr(b, p));
    let duration = inner.next().map(|p| expr(b, p));
    match (holds, duration) {
        (Some(holds), Some(duration)) => Expr { kind: ExprKind::HasHeldFor(Box::new(holds), Box::new(duration)), span },
        (Some(holds), None) => holds,
        (None, _) => Expr { kind: ExprKind::None, span },
    }
}

pub(super) fn condition(b: &mut Builder, node: Node) -> Option<Condition> {
    let mut inner = node.parts();
    let first = inner.next()?;
    Some(if first.rule() == Rule::name {
        Condition::Let { name: name(first), value: expr(b, inner.next()?) }
    } else {
        Condition::Holds(cond(b, first))
    })
}

pub(super) fn expr_stmt(b: &mut Builder, node: Node) -> Option<Timed> {
    let span = node.span();
    let mut inner = node.inner();
    let value = expr(b, inner.next()?);
    Some(modified(b, Action::Expr(value), inner, span))
}

pub(super) fn args(b: &mut Builder, node: Node) -> Vec<Arg> {
    node.inner().filter_map(|p| arg(b, p)).collect()
}

pub(super) fn arg(b: &mut Builder, node: Node) -> Option<Arg> {
    let mut inner = node.inner().peekable();
    let label = inner.next_if(|p| p.rule() == Rule::label).map(|p| name(p));
    Some(Arg { label, value: expr(b, inner.next()?) })
}

/// How tightly an operator binds; `None` for what is no infix operator.
fn infix(rule: Rule) -> Option<(Binary, u8)> {
    Some(match rule {
        Rule::op_else => (Binary::Else, 1),
        Rule::op_or => (Binary::Or, 2),
        Rule::op_and => (Binary::And, 3),
        Rule::op_eq => (Binary::Eq, 5),
        Rule::op_ne => (Binary::Ne, 5),
        Rule::op_le => (Binary::Le, 5),
        Rule::op_ge => (Binary::Ge, 5),
        Rule::op_lt => (Binary::Lt, 5),
        Rule::op_gt => (Binary::Gt, 5),
        Rule::op_add => (Binary::Add, 6),
        Rule::op_sub => (Binary::Sub, 6),
        Rule::op_toward => (Binary::Toward, 7),
        Rule::op_mul => (Binary::Mul, 8),
        Rule::op_div => (Binary::Div, 8),
        Rule::op_pow => (Binary::Pow, 10),
        _ => return None,
    })
}

/// How tightly what follows a prefix operator is held.
fn prefix(rule: Rule) -> Option<(Unary, u8)> {
    Some(match rule {
        Rule::not => (Unary::Not, 4),
        Rule::no => (Unary::No, 4),
        Rule::becomes => (Unary::Becomes, 4),
        Rule::after => (Unary::After, 4),
        Rule::every => (Unary::Every, 4),
        Rule::new => (Unary::New, 4),
        Rule::neg => (Unary::Neg, 9),
        Rule::pos => (Unary::Pos, 9),
        _ => return None,
    })
}

pub(super) fn expr(b: &mut Builder, node: Node) -> Expr {
    let span = node.span();
    let nodes: Vec<Node> = node.inner().collect();
    if nodes.len() > TERMS_MAX {
        return refused(b, span, format!("this expression has more than {TERMS_MAX} parts"));
    }
    let mut at = 0;
    let outer = std::mem::take(&mut b.height);
    let built = climb(b, &nodes, &mut at, 0);
    if b.height > HEIGHT_MAX {
        b.height = outer;
        return refused(b, span, format!("this expression is nested deeper than {HEIGHT_MAX} levels"));
    }
    b.height = outer.max(b.height);
    built
}

/// Whether a quantity has a direction for its unit: `36.18N`.
fn is_direction(quantity: Node) -> bool {
    let unit = quantity.text().trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    matches!(unit.trim_start().trim_start_matches('°'), "N" | "S" | "E" | "W")
}

/// Refuses a comma for a decimal point, where it can be read as one between two values: `with speed 1,5 m/s`.
fn refuse_comma(b: &mut Builder, decimals: Node) -> bool {
    let Some(before) = b.prepared[..decimals.start()].strip_suffix(',') else { return false };
    let head = before.trim_end_matches(|c: char| c.is_ascii_digit());
    let follows_word = head.ends_with([' ', '\t']) && head.trim_end().ends_with(|c: char| c.is_alphabetic());
    let decimals_text = decimals.text();
    if !follows_word || head.len() == before.len() || decimals_text.ends_with(|c: char| c.is_ascii_digit()) {
        return false;
    }
    let span = Span { start: head.len() as u32, ..decimals.span() };
    let quantity = format!("{}.{decimals_text}", &before[head.len()..]);
    b.refused.push(
        Diagnostic::error(Code::SyntaxExpected, span, "decimals follow a point, not a comma")
            .help(format!("write `{quantity}`")),
    );
    true
}

/// Refuses a position as others write it, once for both of its halves; gives whether it is one.
fn refused_position(b: &mut Builder, half: Node) -> bool {
    let span = half.span();
    if b.refused.last().is_some_and(|f| f.span().start <= span.start && span.end <= f.span().end) {
        return true;
    }
    let (text, start) = (b.prepared, half.start());
    // A sign before the first half is an operator to the grammar.
    let start = if text[..start].ends_with('-') { start - 1 } else { start };
    let Some((length, ours)) = places::position(&text[start..]) else { return false };
    let span = Span { start: start as u32, end: (start + length) as u32, ..span };
    b.refused.push(places::finding(span, &ours));
    true
}

/// What is refused becomes a name that nobody has: it is unknown, and that is told once.
fn refused(b: &mut Builder, span: Span, message: String) -> Expr {
    let is_part = |f: &Diagnostic| span.start <= f.span().start && f.span().end <= span.end;
    if !b.refused.last().is_some_and(is_part) {
        b.refused.push(Diagnostic::error(Code::SyntaxNesting, span, message).help("name parts of it with `let`"));
    }
    Expr { kind: ExprKind::Name(String::new()), span }
}

/// Precedence climbing; leaves the height of what it built. The grammar never gives an operator without its operand, so
/// `at` always finds one.
fn climb(b: &mut Builder, nodes: &[Node], at: &mut usize, least: u8) -> Expr {
    let first = nodes[*at];
    *at += 1;
    let mut left = match prefix(first.rule()) {
        Some((unary, binds)) => {
            let op = Spanned { node: unary, span: first.span() };
            let operand = climb(b, nodes, at, binds);
            let span = op.span.to(operand.span);
            b.height += 1;
            Expr { kind: ExprKind::Unary(op, Box::new(operand)), span }
        }
        None => operand(b, first),
    };
    while let Some((binary, binds)) = nodes.get(*at).and_then(|p| infix(p.rule())) {
        if binds < least {
            break;
        }
        let op = Spanned { node: binary, span: nodes[*at].span() };
        *at += 1;
        // `^` and `else` group to the right, all others to the left.
        let right_least = if matches!(binary, Binary::Pow | Binary::Else) { binds } else { binds + 1 };
        let height = b.height;
        let right = climb(b, nodes, at, right_least);
        b.height = b.height.max(height) + 1;
        let span = left.span.to(right.span);
        left = Expr { kind: ExprKind::Binary(op, Box::new(left), Box::new(right)), span };
    }
    left
}

fn operand(b: &mut Builder, node: Node) -> Expr {
    let mut inner = node.inner();
    let Some(first) = inner.next() else { return Expr { kind: ExprKind::None, span: node.span() } };
    b.height = 0;
    let mut value = primary(b, first);
    b.height += 1;
    for (i, suffix) in inner.enumerate() {
        let span = value.span.to(suffix.span());
        if i == TERMS_MAX {
            b.height = 0;
            return refused(b, span, format!("more than {TERMS_MAX} of these follow one another"));
        }
        let kind = match suffix.rule() {
            Rule::args => ExprKind::Call(Box::new(value), args(b, suffix)),
            Rule::changed => {
                let fields = suffix.parts().last().map(|fields| args(b, fields)).unwrap_or_default();
                ExprKind::Changed(Box::new(value), fields)
            }
            Rule::member => match suffix.inner().next() {
                Some(label) if label.rule() == Rule::label => ExprKind::Member(Box::new(value), name(label)),
                _ => return half_typed(b, value, suffix),
            },
            _ => match suffix.inner().next() {
                Some(at) => ExprKind::Index(Box::new(value), Box::new(expr(b, at))),
                None => continue,
            },
        };
        value = Expr { kind, span };
        b.height += 1;
    }
    value
}

/// `op.`: the value before the dot is read, so that it is known what may follow.
fn half_typed(b: &mut Builder, value: Expr, member: Node) -> Expr {
    let blanks = b.prepared[member.end()..].bytes().take_while(|byte| matches!(byte, b' ' | b'\t' | b'\r')).count();
    let at = member.end() + blanks;
    b.refused.push(errors::unexpected(member.span().file, b.prepared, 0, at, "a name"));
    let span = value.span.to(member.span());
    let missing = Spanned { node: String::new(), span: Span { start: at as u32, end: at as u32, ..span } };
    Expr { kind: ExprKind::Member(Box::new(value), missing), span }
}

/// The whole number that a number is written as, told by its digits: what is held of it may have been rounded.
fn whole(text: &str) -> Option<u64> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{before}{after}");
    let leading = digits.len() - digits.trim_start_matches('0').len();
    let digits = digits.trim_matches('0');
    if digits.is_empty() {
        return Some(0);
    }
    // An exponent too large to be read is as good as the largest.
    let largest = if exponent.starts_with('-') { i64::MIN } else { i64::MAX };
    let places = exponent.parse().unwrap_or(largest).saturating_add(before.len() as i64 - leading as i64);
    if places < digits.len() as i64 {
        return None;
    }
    let most = u64::MAX.ilog10() as usize + 1;
    let zeros = usize::try_from(places).unwrap_or(most).min(most).saturating_sub(digits.len());
    Some(format!("{digits}{}", "0".repeat(zeros)).parse().unwrap_or(u64::MAX))
}

fn primary(b: &mut Builder, node: Node) -> Expr {
    let span = node.span();
    let kind = match node.rule() {
        Rule::quantity => {
            if is_direction(node) && refused_position(b, node) {
                return Expr { kind: ExprKind::Name(String::new()), span };
            }
            if refuse_comma(b, node) {
                return Expr { kind: ExprKind::Name(String::new()), span };
            }
            let mut inner = node.inner();
            let text = inner.next().map_or("0", |number| number.text());
            let unit = inner.next().map(|u| name(u));
            let is_counted = text.bytes().all(|b| b.is_ascii_digit());
            ExprKind::Number { value: text.parse().unwrap_or(0.0), whole: whole(text), is_counted, unit }
        }
        Rule::geodetic => {
            let mut halves = node.inner().map(|half| degrees(b, half));
            ExprKind::Geodetic {
                latitude_deg: halves.next().unwrap_or(0.0),
                longitude_deg: halves.next().unwrap_or(0.0),
            }
        }
        Rule::date => match calendar::read(node.text()) {
            Ok(seconds) => ExprKind::Date(seconds),
            Err(why) => {
                let finding = Diagnostic::error(Code::TypesDate, span, "this is no date");
                b.refused.push(finding.help(why));
                ExprKind::Name(String::new())
            }
        },
        Rule::text => return text(b, node),
        Rule::list => ExprKind::List(node.inner().map(|p| expr(b, p)).collect()),
        Rule::paren => match node.inner().next() {
            Some(inside) => ExprKind::Paren(Box::new(cond(b, inside))),
            None => ExprKind::None,
        },
        Rule::if_expr => if_expr(b, node).unwrap_or(ExprKind::None),
        Rule::match_expr => match_expr(b, node).unwrap_or(ExprKind::None),
        Rule::v_done => ExprKind::Done,
        Rule::v_true => ExprKind::Bool(true),
        Rule::v_false => ExprKind::Bool(false),
        Rule::v_none => ExprKind::None,
        _ => ExprKind::Name(node.text().to_string()),
    };
    Expr { kind, span }
}

fn if_expr(b: &mut Builder, node: Node) -> Option<ExprKind> {
    let mut inner = node.parts();
    let condition = Box::new(condition(b, inner.next()?)?);
    let then = block(b, inner.next()?);
    let otherwise = match inner.next() {
        // `else if` is a block of one expression.
        Some(chained) if chained.rule() == Rule::if_expr => {
            let span = chained.span();
            let value = primary(b, chained);
            let only = Timed {
                action: Action::Expr(value),
                duration: None,
                until: None,
                within: None,
                at: Vec::new(),
                repeated: None,
                span,
            };
            Some(Block { clauses: vec![Clause { kind: ClauseKind::Timed(only), span }], span })
        }
        Some(other) => Some(block(b, other)),
        None => None,
    };
    Some(ExprKind::If { condition, then, otherwise })
}

fn match_expr(b: &mut Builder, node: Node) -> Option<ExprKind> {
    let mut inner = node.parts();
    let on = Box::new(expr(b, inner.next()?));
    let mut arms = Vec::new();
    let mut crowded = false;
    for arm in inner {
        if arm.rule() == Rule::crowded_arm {
            crowded = true;
            continue;
        }
        let span = arm.span();
        if std::mem::take(&mut crowded) {
            b.refused.push(
                Diagnostic::error(Code::LayoutLine, span, "this arm begins on the line of another")
                    .help("begin each arm on a line of its own, or after `;`"),
            );
        }
        let mut names = Vec::new();
        for part in arm.parts() {
            if part.rule() == Rule::name {
                names.push(name(part));
            } else {
                arms.push(MatchArm { names: std::mem::take(&mut names), block: block(b, part), span });
            }
        }
    }
    Some(ExprKind::Match { on, arms })
}

/// Degrees, and minutes when written; south and west are negative.
fn degrees(b: &mut Builder, node: Node) -> f64 {
    let span = node.span();
    let mut value = 0.0;
    let mut unit = 1.0;
    for part in node.inner() {
        match part.text() {
            "S" | "W" => value = -value,
            number => {
                let number = number.parse::<f64>().unwrap_or(0.0);
                if unit > 1.0 && number >= 60.0 {
                    b.refused.push(
                        Diagnostic::error(Code::TypesPosition, span, format!("{number}' is more than a degree"))
                            .help("minutes of arc are less than 60: has a digit slipped?"),
                    );
                }
                value += number / unit;
                unit *= 60.0;
            }
        }
    }
    value
}

pub(super) fn text(b: &mut Builder, node: Node) -> Expr {
    let span = node.span();
    let mut text = Vec::new();
    for part in node.inner() {
        if part.rule() == Rule::text_part {
            text.push(TextPart::Literal(unescape(b, part)));
        } else if let Some(hole) = part.inner().next().and_then(|p| p.inner().next()) {
            text.push(TextPart::Hole(expr(b, hole)));
        }
    }
    Expr { kind: ExprKind::Text(text), span }
}

/// A piece of a text as it is meant.
fn unescape(b: &mut Builder, part: Node) -> String {
    let written = part.text();
    let mut out = String::with_capacity(written.len());
    let mut chars = written.char_indices();
    while let Some((at, c)) = chars.next() {
        if c != '\\' {
            out.push(c);
            continue;
        }
        match chars.next() {
            Some((_, 'n')) => out.push('\n'),
            Some((_, 't')) => out.push('\t'),
            Some((_, c @ ('"' | '\\' | '{' | '}'))) => out.push(c),
            Some((_, other)) => {
                let start = part.span().start + at as u32;
                let span = Span { start, end: start + 1 + other.len_utf8() as u32, ..part.span() };
                b.refused.push(Diagnostic::error(Code::SyntaxText, span, format!("a text has no `\\{other}`")).help(
                    "there are `\\\"`, `\\\\`, `\\{`, `\\}`, `\\n` and `\\t`; a backslash itself is written `\\\\`",
                ));
            }
            None => {}
        }
    }
    out
}
