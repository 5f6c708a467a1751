//! Blocks and the statements in them.

use super::capacities::{Capacities, Declared, takes_quantity};
use super::expr::article;
use super::{Checker, Driving, Setting, flow};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Block, Expr, Stmt, StmtKind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, Action, Clause, ClauseKind};
use crate::types::Type;
use albacore_program::seen::is_unseen;
use std::collections::BTreeSet;

impl<'t> Checker<'t> {
    pub(super) fn check_fn(&mut self, m: usize, f: &'t tree::Function) {
        let Some(&super::Def::Fn(id)) = self.names[m].get(&f.name.node) else { return };
        let capacities = self.nominal_capacities(id);
        let is_several = !capacities.is_empty();
        self.as_declared(Declared::Fn(id), is_several, |c| c.fn_body(id, m, f, capacities));
    }

    /// The body of a function, by its signature.
    pub(super) fn fn_body(&mut self, id: usize, m: usize, f: &'t tree::Function, capacities: Capacities) {
        let signature = self.fn_signatures[id].clone();
        let (is_nominal, takes_quantity) = (self.takes_any_capacity(id), takes_quantity(f));
        let scope = super::Scope { capacities, is_nominal, takes_quantity, ..super::Scope::new(m, Setting::Function) };
        let result = signature.result.clone().unwrap_or(Type::Unknown);
        let (body, scope) = self.within(scope, |c| {
            c.declare_params(&f.params, &signature.params);
            let mut body = c.value_block(&f.body, Some(&result));
            match body.value.take() {
                Some(value) => {
                    let what = format!("the result of `{}`", f.name.node);
                    body.value = Some(Box::new(c.coerce(*value, &result, &what)));
                }
                None => c.report(
                    Diagnostic::error(
                        Code::TypesResult,
                        f.name.span,
                        format!("`{}` ends without a value", f.name.node),
                    )
                    .help("end its body with an expression: that is its result"),
                ),
            }
            body
        });
        let function = &mut self.hir.fns[id];
        function.vars = scope.vars;
        function.params = signature.params.len();
        function.result = result;
        function.body = body;
    }

    pub(super) fn declare_params(&mut self, params: &[tree::Param], infos: &[super::ParamInfo]) {
        let mut names = BTreeSet::new();
        for (param, info) in params.iter().zip(infos).filter(|(_, info)| info.behavior.is_none()) {
            // That two have one name has been told.
            let is_second = !names.insert(&param.name.node);
            let id = if is_second {
                self.declare_hidden(param.name.node.clone(), VarKind::Param, info.ty.clone(), param.name.span)
            } else {
                self.declare(&param.name, VarKind::Param, info.ty.clone())
            };
            if let Some(range) = info.range {
                self.scope.vars[id].range = range;
            }
        }
    }

    /// A block of statements.
    pub(super) fn block(&mut self, block: &tree::Block) -> Block {
        let clauses: Vec<&Clause> = block.clauses.iter().collect();
        let stmts = self.stmts(&clauses);
        Block { stmts, value: None }
    }

    /// A block whose last expression is its value.
    pub(super) fn value_block(&mut self, block: &tree::Block, expected: Option<&Type>) -> Block {
        let (last, before) = match block.clauses.split_last() {
            Some((Clause { kind: ClauseKind::Timed(timed), .. }, before)) if !timed.is_modified() => {
                (Some(timed), before)
            }
            _ => (None, &block.clauses[..]),
        };
        let before: Vec<&Clause> = before.iter().collect();
        let mut stmts = self.stmts(&before);
        let value = match last.map(|timed| &timed.action) {
            Some(Action::Expr(e)) => {
                self.scope.tail = Some(e.span);
                Some(Box::new(self.expr(e, expected)))
            }
            Some(_) => {
                stmts.extend(block.clauses.last().into_iter().flat_map(|c| self.stmt(c)));
                None
            }
            None => None,
        };
        Block { stmts, value }
    }

    pub(super) fn stmts(&mut self, clauses: &[&Clause]) -> Vec<Stmt> {
        let mut stmts = Vec::with_capacity(clauses.len());
        let mut left_at: Option<Span> = None;
        for (i, clause) in clauses.iter().enumerate() {
            if let Some(span) = left_at.take() {
                let finding = Diagnostic::error(Code::FlowUnreachable, clause.span, "this is never reached")
                    .label(span, "nothing goes on after this");
                let endless = matches!(&stmts.last(), Some(Stmt { kind: StmtKind::Timed(_), .. }));
                self.report(if endless {
                    finding.help("it never ends by itself: bound it with `for T` or `until X`")
                } else {
                    finding
                });
            }
            if let ClauseKind::With(items) = &clause.kind {
                // `with` holds to the end of its block: the rest of it is its own.
                let with = self.with_items(items);
                if self.scope.setting != Setting::Body {
                    self.report(
                        Diagnostic::error(
                            Code::TimeWith,
                            clause.span,
                            "`with` holds while time goes by, and here none does",
                        )
                        .help("write it in a body or beside the declarations"),
                    );
                }
                let rest = self.in_block(|c| c.stmts(&clauses[i + 1..]));
                let body = Block { stmts: rest, value: None };
                stmts.push(Stmt { kind: StmtKind::With(with, body), span: clause.span });
                break;
            }
            let stmt = self.stmt(clause);
            let ends_here = matches!(clause.kind, ClauseKind::Finish(_) | ClauseKind::Abort { on: None, .. });
            if ends_here || stmt.as_ref().is_some_and(flow::never_goes_on) {
                left_at = Some(clause.span);
            }
            stmts.extend(stmt);
        }
        stmts
    }

    fn stmt(&mut self, clause: &Clause) -> Option<Stmt> {
        let span = clause.span;
        let kind = match &clause.kind {
            ClauseKind::Let { name, ty, value } => return self.let_stmt(name, ty.as_ref(), value, span),
            ClauseKind::Var { name, ty, value } => self.var_stmt(name, ty.as_ref(), value, span),
            ClauseKind::Assign { name, index: None, value } => self.assignment(name, value)?,
            ClauseKind::Assign { name, index: Some(index), value } => self.element_assigned(name, index, value)?,
            ClauseKind::For { name, place, over, block } => {
                return self.for_stmt((name, place.as_ref()), over, block, span);
            }
            ClauseKind::While { condition, block } => return self.while_stmt(condition, block, span),
            ClauseKind::Loop(block) => {
                self.enter_loop();
                let body = self.in_block(|c| c.block(block));
                self.loop_takes_time(&body, span, "loop");
                StmtKind::Loop(body)
            }
            ClauseKind::Timed(timed) => return self.timed_stmt(timed, None, span),
            ClauseKind::Finish(value) => return self.finish(value.as_ref(), span),
            ClauseKind::Abort { why, on: None } => {
                self.body_only(span, "`abort`");
                StmtKind::Abort(self.told(why))
            }
            ClauseKind::Report { name, value, fields } => self.report_stmt(name, value, fields, span),
            ClauseKind::Log(text) => {
                self.effects_allowed(span, "`log`");
                StmtKind::Log(self.told(text))
            }
            other => {
                if let Some((message, help)) = no_statement(other) {
                    self.misplaced(span, &message, help);
                }
                return None;
            }
        };
        Some(Stmt { kind, span })
    }

    fn var_stmt(&mut self, name: &tree::Name, ty: Option<&tree::Ty>, value: &tree::Expr, span: Span) -> StmtKind {
        let value = match ty {
            Some(ty) => {
                let ty = self.kept_type(self.scope.module, ty);
                self.expr_as(value, &ty, &format!("`{}`", name.node))
            }
            None => {
                let value = self.expr(value, None);
                self.definite(value, &name.node)
            }
        };
        if self.scope.setting == Setting::Body {
            let help = match self.known_at_prompt() {
                Some(_) => "declare it on a line of its own, before this one",
                None => "declare a `memory` of the behavior: it is kept while time goes by",
            };
            self.report(Diagnostic::error(Code::TimeVar, span, "a `var` lives in instantaneous code only").help(help));
        }
        let id = self.declare(name, VarKind::Var, value.ty.clone());
        if let Some(ty) = ty {
            self.list_order(id, ty);
        }
        StmtKind::Set(id, value)
    }

    fn assignment(&mut self, name: &tree::Name, value: &tree::Expr) -> Option<StmtKind> {
        // What can only be walked has no name: that is the mistake, whatever stands before it.
        let id = if is_walked(value) { None } else { self.assignable(name) };
        let ty = id.map_or(Type::Unknown, |id| self.scope.vars[id].ty.clone());
        let value = self.expr_as(value, &ty, &format!("`{}`", name.node));
        let id = id?;
        self.assigned_in_range(id, &value);
        self.scope.facts.forget(id);
        Some(StmtKind::Set(id, value))
    }

    fn report_stmt(
        &mut self,
        name: &tree::Expr,
        value: &tree::Expr,
        fields: &[(tree::Name, tree::Expr)],
        span: Span,
    ) -> StmtKind {
        let mut checked = vec![(String::new(), self.expr(value, None))];
        for (nth, (label, value)) in fields.iter().enumerate() {
            if let Some((first, _)) = fields[..nth].iter().find(|(before, _)| before.node == label.node) {
                let message = format!("`{}` is reported twice at once", label.node);
                let finding = Diagnostic::error(Code::ArgsTwice, label.span, message).label(first.span, "the first");
                self.report(finding.help("give each value a label of its own"));
            }
            checked.push((label.node.clone(), self.expr(value, None)));
        }
        for (_, value) in &mut checked {
            if value.ty.is_optional() {
                let finding = self.absent(value);
                self.report(finding);
            }
        }
        self.effects_allowed(span, "`report`");
        StmtKind::Report { name: self.report_name(name), fields: checked }
    }

    pub(super) fn misplaced(&mut self, span: Span, message: &str, help: &str) {
        self.report(Diagnostic::error(Code::SyntaxMisplaced, span, message).help(help));
    }

    fn effects_allowed(&mut self, span: Span, what: &str) {
        if self.is_done_in_value(span) {
            return;
        }
        if self.scope.setting == Setting::Function {
            self.report(
                Diagnostic::error(Code::FunctionsPure, span, format!("a function is pure: {what} cannot stand in it"))
                    .help("return what the caller needs to say it"),
            );
        }
    }

    fn body_only(&mut self, span: Span, what: &str) {
        if self.is_done_in_value(span) {
            return;
        }
        if self.scope.setting != Setting::Body {
            self.report(
                Diagnostic::error(Code::TimeBody, span, format!("{what} stands in the body of a behavior or mission"))
                    .help("in a switching table write `A -> abort \"why\" on X`; beside declarations `abort \"why\" on X`"),
            );
        }
    }

    /// A text without holes.
    /// The name of a report: it stands in a line of the trace and over a column of a table.
    fn report_name(&mut self, text: &tree::Expr) -> String {
        let name = self.plain_text(text);
        let has_holes = matches!(&text.kind, tree::ExprKind::Text(parts)
            if parts.iter().any(|part| matches!(part, tree::TextPart::Hole(_))));
        let wrong = match &name {
            // Told already.
            _ if has_holes => return name,
            name if name.trim().is_empty() => "a report has a name",
            name if name.chars().any(is_unseen) => "a name is one line, without characters that cannot be seen",
            _ => return name,
        };
        self.report(
            Diagnostic::error(Code::TypesName, text.span, wrong)
                .help("tests and tables look for it: write it such as `report \"end\": position`"),
        );
        name
    }

    /// A name in quotes.
    pub(super) fn plain_text(&mut self, text: &tree::Expr) -> String {
        let tree::ExprKind::Text(parts) = &text.kind else {
            let finding = Diagnostic::error(Code::TypesName, text.span, "a name is a text");
            self.report(finding.help("write it in quotes: `\"source\"`"));
            return String::new();
        };
        let mut plain = String::new();
        for part in parts {
            match part {
                tree::TextPart::Literal(literal) => plain.push_str(literal),
                tree::TextPart::Hole(hole) => {
                    let finding = Diagnostic::error(Code::TypesName, hole.span, "a name cannot have holes");
                    self.report(finding.help("tests and tables look for it: write it out"));
                }
            }
        }
        plain
    }

    fn let_stmt(&mut self, name: &tree::Name, ty: Option<&tree::Ty>, timed: &tree::Timed, span: Span) -> Option<Stmt> {
        let takes_time = match &timed.action {
            Action::Expr(e) => self.called_activity(e).is_some(),
            _ => true,
        };
        if takes_time {
            return self.timed_stmt(timed, Some((name, ty)), span);
        }
        let Action::Expr(e) = &timed.action else { return None };
        let told = self.findings.len();
        let value = match ty {
            Some(ty) => {
                let ty = self.written_type(self.scope.module, ty);
                self.expr_as(e, &ty, &format!("`{}`", name.node))
            }
            None => {
                let value = self.expr(e, None);
                self.definite(value, &name.node)
            }
        };
        // What is called may be misspelt: then nobody knows whether it takes time.
        if timed.is_modified() && self.findings.len() == told {
            self.report(
                Diagnostic::error(Code::TimeModifier, timed.span, "this takes no time: nothing to end or to cut off")
                    .help("`for`, `until`, `within` and `at` belong to statements that take time"),
            );
        }
        let range = value.range;
        let id = self.declare(name, VarKind::Let, value.ty.clone());
        self.scope.vars[id].range = range;
        Some(Stmt { kind: StmtKind::Set(id, value), span })
    }

    /// A value whose type is settled: `none` alone is of every optional type.
    fn definite(&mut self, value: Expr, name: &str) -> Expr {
        if value.ty == Type::None {
            // What the prompt calls the value of a line is no name: it can only be given one.
            let named = if name.contains(' ') { "let NAME" } else { name };
            self.report(
                Diagnostic::error(Code::TypesNone, value.span, format!("of what type is `{name}` when it is present?"))
                    .help(format!("write it: `{named}: Point? = none`")),
            );
            return Expr { ty: Type::Unknown, ..value };
        }
        value
    }

    fn finish(&mut self, value: Option<&tree::Expr>, span: Span) -> Option<Stmt> {
        self.body_only(span, "`finish`");
        if let Some(Driving::Override(outer)) = self.scope.driving {
            self.report(
                Diagnostic::error(
                    Code::FlowFinish,
                    span,
                    "an `override` ends with its block: nothing is finished in it",
                )
                .label(outer, "in this block")
                .help("set a `memory` in the block, and finish after it"),
            );
            return None;
        }
        let wanted = self.scope.finish.clone();
        let value = match (wanted, value) {
            (None, _) => {
                self.report(
                    Diagnostic::error(Code::FlowFinish, span, "nothing can be finished here")
                        .help("leave it out: `finish` ends a behavior, a strategy or a mission"),
                );
                return None;
            }
            (Some(Some(ty)), Some(value)) => Some(self.expr_as(value, &ty, "the result")),
            (Some(None), Some(value)) => {
                self.report(
                    Diagnostic::error(Code::FlowResult, value.span, "this finishes with a value, and none is declared")
                        .help("declare it: `behavior NAME(…) -> TYPE { … }`"),
                );
                return None;
            }
            (Some(Some(ty)), None) => {
                let ty = self.type_name(&ty);
                self.report(
                    Diagnostic::error(
                        Code::FlowResult,
                        span,
                        format!("this finishes without its result, {}", article(&ty)),
                    )
                    .help("write `finish VALUE`"),
                );
                return None;
            }
            (Some(None), None) => None,
        };
        Some(Stmt { kind: StmtKind::Finish(value), span })
    }

    /// `if` and `match` as statements, and calls that change a list.
    pub(super) fn expr_stmt(&mut self, e: &tree::Expr, span: Span) -> Option<Stmt> {
        use tree::ExprKind as K;
        let kind = match &e.kind {
            K::If { condition, then, otherwise } => return self.if_stmt(condition, then, otherwise.as_ref(), span),
            K::Match { on, arms } => {
                let (on, arms, otherwise) = self.match_arms(on, arms, None, false, span);
                StmtKind::Match(on, arms, otherwise)
            }
            K::Call(callee, args) => match &callee.kind {
                K::Member(base, member) if e.list_changed().is_some() => {
                    return self.list_change(base, &member.node, args, span);
                }
                _ => {
                    let value = self.expr(e, None);
                    if value.ty != Type::Unknown {
                        self.unused(span, "name it with `let`, or remove it");
                    }
                    return None;
                }
            },
            _ => {
                let value = self.expr(e, None);
                if value.ty != Type::Unknown {
                    let help = if begins_with_sign(e) {
                        "to go on with the line before, end that line with the operator"
                    } else {
                        "name it with `let`, or remove it"
                    };
                    self.unused(span, help);
                }
                return None;
            }
        };
        Some(Stmt { kind, span })
    }

    fn unused(&mut self, span: Span, help: &str) {
        self.report(Diagnostic::error(Code::FlowUnused, span, "this computes a value that nobody reads").help(help));
    }
}

/// Whether an expression begins with `+` or `-`: it may have been meant to go on with the line before.
fn begins_with_sign(e: &tree::Expr) -> bool {
    match &e.kind {
        tree::ExprKind::Unary(op, _) => matches!(op.node, tree::Unary::Pos | tree::Unary::Neg),
        tree::ExprKind::Binary(_, left, _) => begins_with_sign(left),
        _ => false,
    }
}

/// `op.rows(20 m)` and `op.edges`.
fn is_walked(value: &tree::Expr) -> bool {
    match &value.kind {
        tree::ExprKind::Call(callee, _) => {
            matches!(&callee.kind, tree::ExprKind::Member(_, member) if member.node == "rows")
        }
        tree::ExprKind::Member(_, member) => member.node == "edges",
        _ => false,
    }
}

/// What is said of a clause that is no statement, and where it belongs.
fn no_statement(kind: &ClauseKind) -> Option<(String, &'static str)> {
    let (message, help) = match kind {
        ClauseKind::Memory { name, .. } | ClauseKind::Signal { name, .. } => {
            let help =
                "declarations stand at the top of a behavior, strategy, overlay or mission, outside other blocks";
            return Some((format!("`{}` is declared too late", name.node), help));
        }
        ClauseKind::Rule(_) | ClauseKind::Start(_) => {
            ("a switching table stands in a strategy or a mission", "move the rule out of this block")
        }
        ClauseKind::Behavior(_) => {
            ("a behavior is declared in a file, a strategy or a mission", "move it out of this block")
        }
        ClauseKind::Reaction { .. } | ClauseKind::Abort { .. } => {
            ("a reaction stands beside the declarations", "move it out of this block, to the top of the behavior")
        }
        ClauseKind::Amend(_) => (
            "`amend` stands in an overlay that amends the course",
            "write `overlay NAME amends course { amend { … } }`",
        ),
        ClauseKind::Recording { .. } => (
            "what is recorded stands beside the declarations",
            "move it out of this block, to the top of the mission, strategy or behavior",
        ),
        ClauseKind::Area { .. } | ClauseKind::Limits(_) | ClauseKind::Requires(_) | ClauseKind::Recovery { .. } => {
            ("this stands in a mission only, beside its declarations", "move it to the top of the mission")
        }
        _ => return None,
    };
    Some((message.to_string(), help))
}
