//! Maps: a grid over an area, and what each of its cells holds.

use super::Checker;
use super::expr::article;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Builtin, Expr, Stmt, StmtKind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, ForOver};
use crate::types::Type;

/// A map has this many cells at most: 64 x 64.
pub(super) const MAP_CELLS_MAX: u32 = 4096;

impl Checker<'_> {
    /// `map(over: AREA, each: VALUE)`. How many cells it has is known from where it is kept.
    pub(super) fn map_call(&mut self, args: &[tree::Arg], span: Span, expected: Option<&Type>) -> Expr {
        let Some(Type::Map(inner, cells)) = expected.map(Type::present) else {
            self.simple_args("map", &[("over", Type::Area), ("each", Type::Unknown)], args, span);
            if expected != Some(&Type::Unknown) {
                let finding = Diagnostic::error(Code::TypesEmpty, span, "of how many cells is this map?");
                self.report(finding.help(
                    "say it where the map is named: `memory belief: Map[Ratio; 900] = map(over: op, each: 0)` has 900 cells at most",
                ));
            }
            return self.unknown(span);
        };
        let params = [("over", Type::Area), ("each", (**inner).clone())];
        match self.simple_args("map", &params, args, span) {
            Some(values) => self.operation(Builtin::Map, values, Type::Map(inner.clone(), *cells), span),
            None => self.unknown(span),
        }
    }

    /// `for chance at place in belief { … }`: what each cell of a map holds, and its middle.
    pub(super) fn for_map(
        &mut self,
        name: &tree::Name,
        place: &tree::Name,
        over: &ForOver,
        block: &tree::Block,
        span: Span,
    ) -> Option<Stmt> {
        let map = match over {
            ForOver::List(written) => self.expr(written, None),
            ForOver::Range(range) => self.unknown(range.first.span.to(range.last.span)),
        };
        let element = match &map.ty {
            Type::Map(inner, _) => (**inner).clone(),
            Type::Unknown if matches!(over, ForOver::List(_)) => Type::Unknown,
            other => {
                let what = if matches!(over, ForOver::Range(_)) {
                    "a range".to_string()
                } else {
                    article(&self.type_name(other))
                };
                let finding =
                    Diagnostic::error(Code::TypesFor, map.span, format!("only a map has places, this is {what}"));
                let place = &place.node;
                self.report(finding.help(match other {
                    Type::List(_, n) => format!("leave `at {place}` out; to number them write `for {place} in 0..<{n}`, and `list[{place}]` in it"),
                    _ => format!("leave `at {place}` out"),
                }));
                Type::Unknown
            }
        };
        self.enter_loop();
        let (var, place, body) = self.in_block(|c| {
            let var = c.declare(name, VarKind::Loop, element);
            let place = c.declare(place, VarKind::Loop, Type::Point);
            (var, place, c.block(block))
        });
        Some(Stmt { kind: StmtKind::ForList { var, place: Some(place), list: map, body }, span })
    }
}
