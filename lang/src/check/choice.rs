//! `if` and `match`, as statements and as values.

use super::expr::article;
use super::facts::Fact;
use super::{Checker, Def, Temporal, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Block, Expr, ExprKind, Stmt, StmtKind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, Condition};
use crate::types::Type;
use albacore_wording::listed;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

impl<'t> Checker<'t> {
    pub(super) fn if_stmt(
        &mut self,
        condition: &Condition,
        then: &tree::Block,
        otherwise: Option<&tree::Block>,
        span: Span,
    ) -> Option<Stmt> {
        match condition {
            Condition::Holds(e) => {
                let condition = self.with_temporal(Temporal::No, |c| c.condition(e));
                let known = |c: &mut Self, holds: bool, block: &tree::Block| {
                    let facts = c.shown(&condition, holds);
                    c.in_block(|c| {
                        c.learn(facts);
                        c.block(block)
                    })
                };
                let then = known(self, true, then);
                let otherwise = otherwise.map(|b| known(self, false, b)).unwrap_or_default();
                // After `if not x { finish }` x is known, unless the way that goes on changes it.
                if flow::leaves(&then) {
                    self.learn(self.shown(&condition, false));
                    self.changes(&otherwise);
                } else if flow::leaves(&otherwise) {
                    self.learn(self.shown(&condition, true));
                    self.changes(&then);
                }
                Some(Stmt { kind: StmtKind::If(condition, then, otherwise), span })
            }
            Condition::Let { name, value } => {
                let value = self.expr(value, None);
                let present = self.make(ExprKind::IsPresent(Box::new(value.clone())), Type::Bool, value.span);
                let then = self.in_block(|c| {
                    let bind = c.bind_present(name, &value);
                    let mut block = c.block(then);
                    block.stmts.insert(0, Stmt { kind: StmtKind::Set(bind, value.unwrapped()), span });
                    block
                });
                let otherwise = otherwise.map(|b| self.in_block(|c| c.block(b))).unwrap_or_default();
                Some(Stmt { kind: StmtKind::If(present, then, otherwise), span })
            }
        }
    }

    /// Forgets what a block changes.
    fn changes(&mut self, block: &Block) {
        if flow::may_take_time(block) {
            self.time_passes();
        }
        for var in block.assigned() {
            self.scope.facts.forget(var);
        }
    }

    /// The name of `if let` and `while let`.
    pub(super) fn bind_present(&mut self, name: &tree::Name, value: &Expr) -> usize {
        let ty = match &value.ty {
            Type::Optional(inner) => (**inner).clone(),
            Type::Unknown => Type::Unknown,
            other => {
                let ty = self.type_name(other);
                self.report(
                    Diagnostic::error(
                        Code::AbsentLet,
                        value.span,
                        format!("this is never absent: it is {}", article(&ty)),
                    )
                    .help("name it with a plain `let`"),
                );
                Type::Unknown
            }
        };
        self.declare(name, VarKind::Let, ty)
    }

    /// `if` as a value: both blocks must end in one.
    pub(super) fn if_value(
        &mut self,
        condition: &Condition,
        then: &tree::Block,
        otherwise: Option<&tree::Block>,
        expected: Option<&Type>,
        span: Span,
    ) -> Expr {
        let is_tail = self.scope.tail == Some(span);
        let Some(otherwise) = otherwise else {
            self.report(
                Diagnostic::error(Code::TypesIfValue, span, "this `if` has no value when its condition does not hold")
                    .help("add `else { … }`"),
            );
            return self.unknown(span);
        };
        let Condition::Holds(condition) = condition else {
            self.report(
                Diagnostic::error(Code::TypesIfLet, span, "`if let` is a statement, no value")
                    .help("name the optional with `let` before, and test it with `if NAME`"),
            );
            return self.unknown(span);
        };
        let condition = self.with_temporal(Temporal::No, |c| c.condition(condition));
        let (mut then_block, mut else_block) = self.as_value(is_tail, |c| {
            let then = c.block_knowing(c.shown(&condition, true), then, expected);
            (then, c.block_knowing(c.shown(&condition, false), otherwise, expected))
        });
        let ty = self.join(&mut then_block, &mut else_block, expected, span);
        self.make(ExprKind::If(Box::new(condition), then_block, else_block), ty, span)
    }

    /// A block as a value, with what its condition has shown.
    pub(super) fn block_knowing(&mut self, facts: Vec<Fact>, block: &tree::Block, expected: Option<&Type>) -> Block {
        self.in_block(|c| {
            c.learn(facts);
            c.value_block(block, expected)
        })
    }

    /// Makes two blocks end in values of one type.
    fn join(&mut self, a: &mut Block, b: &mut Block, expected: Option<&Type>, span: Span) -> Type {
        let (Some(x), Some(y)) = (a.value.take(), b.value.take()) else {
            self.report(
                Diagnostic::error(Code::TypesIfValue, span, "both blocks must end in a value")
                    .help("end each block with an expression"),
            );
            return Type::Unknown;
        };
        let ty = common_type([&*x, &*y], expected);
        a.value = Some(Box::new(self.coerce(*x, &ty, "the value of the other block")));
        b.value = Some(Box::new(self.coerce(*y, &ty, "the value of the other block")));
        ty
    }

    pub(super) fn match_value(
        &mut self,
        on: &tree::Expr,
        arms: &[tree::MatchArm],
        expected: Option<&Type>,
        span: Span,
    ) -> Expr {
        let is_tail = self.scope.tail == Some(span);
        let (on, mut arms, mut otherwise) = self.as_value(is_tail, |c| c.match_arms(on, arms, expected, true, span));
        let values = arms.iter().map(|(_, b)| b).chain(&otherwise).filter_map(|b| b.value.as_deref());
        let ty = common_type(values, expected);
        for block in arms.iter_mut().map(|(_, b)| b).chain(otherwise.iter_mut()) {
            match block.value.take() {
                Some(value) => {
                    block.value = Some(Box::new(self.coerce(*value, &ty, "the value of the other blocks")));
                }
                None => self.report(
                    Diagnostic::error(Code::TypesIfValue, span, "every block of this `match` must end in a value")
                        .help("end each block with an expression"),
                ),
            }
        }
        self.make(ExprKind::Match(Box::new(on), arms, otherwise), ty, span)
    }

    /// The arms of a `match` over an enum: each variant once, none forgotten.
    #[allow(clippy::type_complexity, reason = "the three parts of a match, taken apart at once by both callers")]
    pub(super) fn match_arms(
        &mut self,
        on: &tree::Expr,
        arms: &[tree::MatchArm],
        expected: Option<&Type>,
        as_value: bool,
        span: Span,
    ) -> (Expr, Vec<(Vec<usize>, Block)>, Option<Block>) {
        let on = self.expr(on, None);
        let variants = self.variants(&on);
        let by_name: BTreeMap<&str, usize> = variants.iter().enumerate().map(|(i, v)| (v.as_str(), i)).collect();
        let mut seen = BTreeSet::new();
        let mut checked = Vec::new();
        let mut otherwise = None;
        for arm in arms {
            let mut indices = Vec::new();
            for name in &arm.names {
                self.refer_to(name.span, self.scope.module, &name.node, |def| matches!(def, Def::Variant(..)));
                match by_name.get(name.node.as_str()).copied() {
                    Some(i) if !seen.insert(i) => self.report(Diagnostic::error(
                        Code::TypesMatch,
                        name.span,
                        format!("`{}` is matched already", name.node),
                    )),
                    Some(i) => indices.push(i),
                    None if variants.is_empty() => {}
                    None => {
                        let finding = Diagnostic::error(
                            Code::TypesMatch,
                            name.span,
                            format!("there is no variant `{}`", name.node),
                        );
                        let finding = match self.suggestion(&name.node, variants.iter().map(String::as_str)) {
                            Some(help) => finding.help(help),
                            None => finding,
                        };
                        self.report(finding);
                    }
                }
            }
            let block =
                self.in_block(|c| if as_value { c.value_block(&arm.block, expected) } else { c.block(&arm.block) });
            if !arm.names.is_empty() {
                checked.push((indices, block));
            } else if otherwise.replace(block).is_some() {
                let finding = Diagnostic::error(Code::TypesMatch, arm.span, "this `match` has an `else` already");
                self.report(finding.help("keep one of them"));
            }
        }
        self.covered(arms, &variants, &seen, span);
        (on, checked, otherwise)
    }

    /// The variants that a `match` chooses between.
    fn variants(&mut self, on: &Expr) -> Arc<[String]> {
        match &on.ty {
            Type::Enum(id) => self.types.enums[*id].variants.clone(),
            Type::Unknown => Arc::default(),
            other => {
                let message = format!(
                    "`match` chooses between the variants of an enum, this is {}",
                    article(&self.type_name(other))
                );
                self.report(Diagnostic::error(Code::TypesMatch, on.span, message).help("use `if`"));
                Arc::default()
            }
        }
    }

    /// Reports the variants that no arm of a `match` names, and an `else` that none is left for.
    fn covered(&mut self, arms: &[tree::MatchArm], variants: &[String], seen: &BTreeSet<usize>, span: Span) {
        let missing: Vec<&str> =
            variants.iter().enumerate().filter(|(i, _)| !seen.contains(i)).map(|(_, v)| v.as_str()).collect();
        match arms.iter().find(|arm| arm.names.is_empty()) {
            None if !missing.is_empty() => {
                let message = format!("this `match` says nothing of {}", listed(&missing));
                let finding = Diagnostic::error(Code::TypesMatch, span, message);
                self.report(finding.help("add an arm for each, or `else { … }`"));
            }
            Some(arm) if missing.is_empty() && !variants.is_empty() => {
                let finding = Diagnostic::error(Code::FlowUnreachable, arm.span, "this is never reached");
                self.report(finding.help("each variant has an arm of its own: leave `else` out"));
            }
            _ => {}
        }
    }
}

/// The type that the values of all blocks can have. Constants become the depth, altitude or heading that is expected, each by itself, and
/// so do lists that are written out.
fn common_type<'e>(values: impl IntoIterator<Item = &'e Expr> + Clone, expected: Option<&Type>) -> Type {
    let is_one = |v: &Expr| v.ty == Type::Int && v.range.constant().is_some_and(|n| n.abs() == 1.0);
    let is_sign = |v: &Expr| v.ty == Type::Sign || is_one(v);
    if values.clone().into_iter().all(is_sign) {
        return Type::Sign;
    }
    let given = expected.map(Type::present).filter(|given| {
        values.clone().into_iter().all(|v| match (&v.ty, given) {
            (Type::None, _) => true,
            (Type::Quantity(_), Type::Depth | Type::Altitude | Type::Heading) => v.range.constant().is_some(),
            (Type::List(..), Type::List(..)) => matches!(v.kind, ExprKind::List(_)),
            _ => false,
        })
    });
    values.into_iter().map(|v| v.ty.clone()).chain(given.cloned()).reduce(wider).unwrap_or(Type::Unknown)
}

/// Of two types the one that values of both can have; the first where there is none.
pub(super) fn wider(x: Type, y: Type) -> Type {
    match (x, y) {
        (Type::None, other) | (other, Type::None) => other.optional(),
        (Type::Optional(x), Type::Optional(y)) => wider(*x, *y).optional(),
        (Type::Optional(x), y) => wider(*x, y).optional(),
        (x, Type::Optional(y)) => wider(x, *y).optional(),
        (Type::Int | Type::Sign, y @ Type::Quantity(_)) => y,
        (Type::Int | Type::Sign | Type::Quantity(_), y @ (Type::Heading | Type::Depth | Type::Altitude)) => y,
        (Type::Quantity(x), Type::Quantity(y)) => Type::Quantity(if x == y { x.beside(y) } else { x }),
        (Type::Sign, Type::Int) => Type::Int,
        (Type::List(x, n), Type::List(y, m)) => Type::List(Box::new(wider(*x, *y)), n.max(m)),
        (x, _) => x,
    }
}
