//! Loops: what they walk, and that every tick ends.

use super::expr::article;
use super::flow::takes_time;
use super::{Checker, Def, Setting, Temporal};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Block, Expr, ExprKind, Interval, RowPlan, Stmt, StmtKind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, Condition, ForOver};
use crate::types::{Type, is_number};
use albacore_arithmetic::INT_MAX;
use albacore_program::senses;

/// A loop that takes no time goes round this often at most: every tick must end, and soon.
const ROUNDS_MAX: f64 = 10_000.0;

impl<'t> Checker<'t> {
    pub(super) fn for_stmt(
        &mut self,
        (name, place): (&tree::Name, Option<&tree::Name>),
        over: &ForOver,
        block: &tree::Block,
        span: Span,
    ) -> Option<Stmt> {
        if let Some(place) = place {
            return self.for_map(name, place, over, block, span);
        }
        let written = match over {
            ForOver::Range(range) => return Some(self.for_range(name, range, block, span)),
            ForOver::List(written) => written,
        };
        // `area.edges` is walked without being made a list.
        if let tree::ExprKind::Member(base, member) = &written.kind
            && member.node == "edges"
            && self.module_named(base).is_none()
        {
            let area = self.expr(base, None);
            if area.ty == Type::Area {
                self.enter_loop();
                let (var, body) = self.in_block(|c| (c.declare(name, VarKind::Loop, Type::Edge), c.block(block)));
                return Some(Stmt { kind: StmtKind::ForEdges { var, area, body }, span });
            }
        }
        if let Some(kind) = self.for_rows(name, written, block) {
            return Some(Stmt { kind, span });
        }
        let list = self.expr(written, None);
        let element = match &list.ty {
            Type::List(inner, _) | Type::Map(inner, _) => (**inner).clone(),
            Type::Unknown => Type::Unknown,
            other => {
                let ty = self.type_name(other);
                self.report(
                    Diagnostic::error(
                        Code::TypesFor,
                        written.span,
                        format!("`for` walks a list, a map or a range, this is {}", article(&ty)),
                    )
                    .help(help_where_nothing_is_walked(&name.node, written, &list)),
                );
                Type::Unknown
            }
        };
        self.enter_loop();
        let constants =
            matches!(&list.kind, ExprKind::List(elements) if elements.iter().all(|e| e.range.constant().is_some()));
        let range = match &list.kind {
            ExprKind::List(elements) if is_number(&element) => elements.iter().map(|e| e.range).reduce(Interval::or),
            _ => None,
        };
        let (var, body) = self.in_block(|c| {
            let var = c.declare(name, VarKind::Loop, element);
            c.scope.vars[var].walks_constants = constants;
            // A copy is walked: its elements stay as they are.
            if let Some(range) = range {
                c.scope.vars[var].range = range;
            }
            (var, c.block(block))
        });
        Some(Stmt { kind: StmtKind::ForList { var, place: None, list, body }, span })
    }

    /// `for i in 1..n`.
    fn for_range(&mut self, name: &tree::Name, range: &tree::Range, block: &tree::Block, span: Span) -> Stmt {
        let first = self.expr_as(&range.first, &Type::Int, "the beginning of the range");
        let last = self.expr_as(&range.last, &Type::Int, "the end of the range");
        self.range_holds_something(range, &first, &last);
        self.enter_loop();
        let end = if range.inclusive { last.range.high } else { last.range.high - 1.0 };
        let (var, body) = self.in_block(|c| {
            let var = c.declare(name, VarKind::Loop, Type::Int);
            c.scope.vars[var].range = Interval::new(first.range.low, end);
            (var, c.block(block))
        });
        // Written so that a bound that is no number counts as none.
        let exact = first.range.low.abs().max(end.abs()) < INT_MAX;
        let counts = end - first.range.low < ROUNDS_MAX;
        let bounded = exact && counts;
        // A bound that is wrong has been told of.
        if !bounded && first.ty != Type::Unknown && last.ty != Type::Unknown {
            let help = if counts && first.range.constant().is_some() && last.range.constant().is_some() {
                format!("whole numbers end at {INT_MAX}: count to less, and add in the loop")
            } else {
                format!(
                    "hold it to {ROUNDS_MAX} rounds: a range, such as a parameter `n: Int in 1..10`, or `min(n, 10)`"
                )
            };
            self.bounded_or_takes_time(&body, range.last.span, help);
        }
        let kind = StmtKind::ForRange { var, first, last, inclusive: range.inclusive, body };
        Stmt { kind, span }
    }

    /// `for row in area.rows(step)`: the lines of a lawn-mower, computed one by one.
    fn for_rows(&mut self, name: &tree::Name, written: &tree::Expr, block: &tree::Block) -> Option<StmtKind> {
        let tree::ExprKind::Call(callee, args) = &written.kind else { return None };
        let tree::ExprKind::Member(base, member) = &callee.kind else { return None };
        if member.node != "rows" || self.module_named(base).is_some() {
            return None;
        }
        let area = self.expr_as(base, &Type::Area, "what is walked in rows");
        let rows = self.row_plan(area, args, written.span);
        let step = &rows.step;
        if step.range.low <= 0.0 && step.ty != Type::Unknown {
            self.report(
                Diagnostic::error(Code::RangesStep, step.span, "rows must lie farther apart than nothing")
                    .help("use a positive constant, or a parameter with a range such as `in 5 m..100 m`"),
            );
        }
        self.enter_loop();
        let (var, body) = self.in_block(|c| (c.declare(name, VarKind::Loop, Type::Line), c.block(block)));
        Some(StmtKind::ForRows { var, rows: Box::new(rows), body })
    }

    /// How far rows lie apart, their heading, and the point that they begin nearest to: where nothing else is said, the input
    /// `position`.
    fn row_plan(&mut self, area: Expr, args: &[tree::Arg], span: Span) -> RowPlan {
        let all = [("step", Type::Quantity(Dimension::LENGTH)), ("near", Type::Point), ("along", Type::Heading)];
        let labels = || args.iter().filter_map(|arg| arg.label.as_ref());
        let without_label = args.iter().filter(|arg| arg.label.is_none()).count();
        // A label that there is not is told beside all that there are.
        let is_other = labels().any(|label| all.iter().all(|(name, _)| label.node != *name));
        let says = |n: usize| is_other || without_label > n || labels().any(|label| label.node == all[n].0);
        let (says_near, says_along) = (says(1), says(2));
        let params: Vec<_> = (0..all.len()).filter(|n| *n == 0 || says(*n)).map(|n| all[n].clone()).collect();
        let mut given = self.simple_args("rows", &params, args, span).unwrap_or_default().into_iter();
        let mut next = |c: &Self| given.next().unwrap_or_else(|| c.unknown(span));
        let step = next(self);
        let near = if says_near { next(self) } else { self.position_for_rows(span) };
        let along = says_along.then(|| next(self));
        RowPlan { area, step, along, near }
    }

    fn position_for_rows(&mut self, span: Span) -> Expr {
        if self.scope.setting == Setting::Function {
            self.report(
                Diagnostic::error(
                    Code::NamesInput,
                    span,
                    "`rows` begins at the end nearest to `position`, and a function cannot read an input",
                )
                .help("give the function a point as a parameter, and say it: `area.rows(step, near: point)`"),
            );
            return self.unknown(span);
        }
        match self.hir.inputs.iter().position(|input| input.name == senses::POSITION) {
            Some(id) => self.def_value(&Def::Input(id), senses::POSITION, span),
            None => self.unknown(span),
        }
    }

    /// A range that runs backwards: a loop over it would never go round.
    fn range_holds_something(&mut self, range: &tree::Range, first: &Expr, last: &Expr) {
        let end = if range.inclusive { last.range.high } else { last.range.high - 1.0 };
        if end >= first.range.low {
            return self.range_counts_up(range, first, last);
        }
        let finding =
            Diagnostic::error(Code::RangesEmpty, range.first.span.to(range.last.span), "this range holds nothing");
        let finding = match (first.range.constant(), last.range.constant()) {
            (Some(first), Some(last)) if first > last => {
                finding.help(format!("write `{last}..{first}`; to count down take `{} - i` in the loop", first + last))
            }
            _ => finding.help("`a..b` holds both ends, `a..<b` all but the last; the smaller end comes first"),
        };
        self.report(finding);
    }

    /// `n..1` is meant to count down: it holds what is between only where that is one number.
    fn range_counts_up(&mut self, range: &tree::Range, first: &Expr, last: &Expr) {
        let is_down = last.range.constant().is_some_and(|last| last <= 1.0 && first.range.high > last);
        if first.range.constant().is_some() || first.range.low < 0.0 || !is_down {
            return;
        }
        let span = range.first.span.to(range.last.span);
        let finding = Diagnostic::warning(
            Code::RangesEmpty,
            span,
            "a range counts up: where its first number is the larger one it holds nothing",
        );
        self.report(finding.help("to count down from `n` to 1 write `1..n`, and take `n + 1 - i` in the loop"));
    }

    pub(super) fn while_stmt(&mut self, condition: &Condition, block: &tree::Block, span: Span) -> Option<Stmt> {
        self.enter_loop();
        let (condition, bind, body) = match condition {
            Condition::Holds(e) => {
                let condition = self.with_temporal(Temporal::No, |c| c.condition(e));
                let facts = self.shown(&condition, true);
                let body = self.in_block(|c| {
                    c.learn(facts);
                    c.block(block)
                });
                (condition, None, body)
            }
            Condition::Let { name, value } => {
                let value = self.expr(value, None);
                let (bind, body) = self.in_block(|c| {
                    let bind = c.bind_present(name, &value);
                    (bind, c.block(block))
                });
                (value, Some(bind), body)
            }
        };
        self.loop_takes_time(&body, span, "while");
        Some(Stmt { kind: StmtKind::While { condition, bind, body }, span })
    }

    /// In a loop nothing holds of what its body may change.
    pub(super) fn enter_loop(&mut self) {
        self.scope.facts.forget_changeable();
    }

    /// Time goes by: memory, signals and inputs may have changed.
    pub(super) fn time_passes(&mut self) {
        self.enter_loop();
    }

    pub(super) fn loop_takes_time(&mut self, body: &Block, span: Span, word: &str) {
        if !takes_time(body) {
            self.report(
                Diagnostic::error(Code::TimeInstantLoop, span, format!("this `{word}` can go round without taking time"))
                    .here("every tick must end")
                    .help("put a statement that takes time on every path through it, such as `wait for 1 s`, or walk a list or a range with `for`"),
            );
        }
    }

    fn bounded_or_takes_time(&mut self, body: &Block, range: Span, help: String) {
        if !takes_time(body) {
            self.report(
                Diagnostic::error(
                    Code::TimeInstantLoop,
                    range,
                    "this `for` may go round too often without taking time",
                )
                .here("how large can this be?")
                .help(help),
            );
        }
    }
}

/// What is said of a value that `for` does not walk.
fn help_where_nothing_is_walked(name: &str, written: &tree::Expr, value: &Expr) -> String {
    let method = match &written.kind {
        tree::ExprKind::Call(callee, _) => match &callee.kind {
            tree::ExprKind::Member(_, member) => member.node.as_str(),
            _ => "",
        },
        _ => "",
    };
    match (&value.ty, value.range.constant(), method) {
        (Type::Point, _, "scattered") => {
            format!("it gives one place for each number: `for i in 1..12 {{ let {name} = op.scattered(i) … }}`")
        }
        (Type::Area, ..) => format!("walk its rows, `for {name} in AREA.rows(20 m)`, or its edges, `AREA.edges`"),
        (Type::Int, Some(n), _) if (1.0..=ROUNDS_MAX).contains(&n) => {
            format!("to do it {n} times write `for {name} in 1..{n}`")
        }
        _ => "ranges are `0..<n` and `1..n`".to_string(),
    }
}
