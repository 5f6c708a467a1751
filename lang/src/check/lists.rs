//! Lists that are changed and kept in order.

use super::Checker;
use super::expr::article;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, ExprKind, Order, Stmt, StmtKind, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, TyKind};
use crate::types::Type;

/// What the element of a list is called in the key by which the list is ordered.
const ELEMENT: &str = "it";

impl<'t> Checker<'t> {
    /// `[Point; 6] by most KEY`: the key is a function of `it`.
    pub(super) fn list_order(&mut self, id: usize, ty: &tree::Ty) {
        let TyKind::List { order: Some((most, key)), .. } = &ty.kind else { return };
        let Type::List(inner, _) = self.scope.vars[id].ty.clone() else { return };
        let span = key.span;
        let element = tree::Name { node: ELEMENT.to_string(), span };
        self.name_is_new(&element, "in this key `it` is the list's element: give what is declared another name");
        let (it, key) = self.in_block(|c| {
            // It is computed whenever the list changes, and on every tick.
            c.time_passes();
            let it = c.declare_hidden(element.node, VarKind::Let, *inner, span);
            let key = c.expr(key, None);
            (it, key)
        });
        if !matches!(key.ty, Type::Int | Type::Quantity(_) | Type::Depth | Type::Altitude | Type::Date | Type::Unknown)
        {
            let name = self.type_name(&key.ty);
            self.report(
                Diagnostic::error(
                    Code::TypesKey,
                    span,
                    format!("a list is ordered by a number, not by {}", article(&name)),
                )
                .help("for example `by most it.along(upflow)`"),
            );
        }
        let reads_itself = key.contains(|e| matches!(e.kind, ExprKind::Var(read) if read == id));
        if reads_itself {
            let message = "a list cannot be ordered by itself";
            let finding = Diagnostic::error(Code::TypesKey, span, message);
            self.report(finding.help("order it by the element, `it`, and by what is declared before the list"));
        }
        self.scope.vars[id].order = Some(Order { most: *most, it, key: Box::new(key) });
    }

    pub(super) fn list_change(
        &mut self,
        base: &tree::Expr,
        what: &str,
        args: &[tree::Arg],
        span: Span,
    ) -> Option<Stmt> {
        let tree::ExprKind::Name(name) = &base.kind else {
            self.report(
                Diagnostic::error(Code::NamesAssign, base.span, "only a list that has a name can be changed")
                    .help("keep it in a `memory`"),
            );
            return None;
        };
        let name = tree::Name { node: name.clone(), span: base.span };
        let id = self.assignable(&name)?;
        let inner = self.elements_of(id, &name, &format!("`{what}` changes a list"))?;
        self.scope.facts.forget(id);
        let kind = if what == "clear" {
            self.positional::<0>("clear", args, span)?;
            StmtKind::Clear(id)
        } else {
            let [item] = self.positional::<1>(what, args, span)?;
            let item = self.expr_as(&item, &inner, "an element of this list");
            if what == "insert" { StmtKind::Insert(id, item) } else { StmtKind::Remove(id, item) }
        };
        Some(Stmt { kind, span })
    }

    /// `list[index] = value`.
    pub(super) fn element_assigned(
        &mut self,
        name: &tree::Name,
        index: &tree::Expr,
        value: &tree::Expr,
    ) -> Option<StmtKind> {
        let id = self.assignable(name);
        if let Some(id) = id
            && let Type::Map(inner, _) = self.scope.vars[id].ty.clone()
        {
            let place = self.expr_as(index, &Type::Point, "the place in a map");
            let value = self.expr_as(value, &inner, &format!("a cell of `{}`", name.node));
            self.scope.facts.forget(id);
            return Some(StmtKind::Replace(id, place, value));
        }
        let inner = id.and_then(|id| self.elements_of(id, name, "only a list or a map has elements that are assigned"));
        let index = match &inner {
            Some(_) => self.index_of_element(index),
            None => self.expr(index, None),
        };
        let what = format!("an element of `{}`", name.node);
        let value = self.expr_as(value, &inner.clone().unwrap_or(Type::Unknown), &what);
        let id = id.filter(|_| inner.is_some())?;
        let Type::List(_, capacity) = self.scope.vars[id].ty else { return None };
        if index.range.low >= f64::from(capacity) {
            let message = format!("`{}` never has such an element: it holds {capacity} at most", name.node);
            let finding = Diagnostic::error(Code::TypesIndex, index.span, message);
            self.report(finding.help(format!(
                "they are counted from 0: the last may be `{}[{}]`",
                name.node,
                capacity - 1
            )));
        }
        self.scope.facts.forget(id);
        Some(StmtKind::Replace(id, index, value))
    }

    /// What a variable holds whose elements are changed: it must be a list.
    fn elements_of(&mut self, id: usize, name: &tree::Name, why: &str) -> Option<Type> {
        match self.scope.vars[id].ty.clone() {
            Type::List(inner, _) => Some(*inner),
            Type::Unknown => None,
            other => {
                let ty = self.type_name(&other);
                let message = format!("{why}, this is {}", article(&ty));
                let finding = Diagnostic::error(Code::TypesList, name.span, message).here(format!("`{ty}`"));
                let help = match other {
                    Type::Map(..) => format!("a cell is set by its place: `{}[position] = VALUE`", name.node),
                    _ => format!("another value is replaced as a whole: `{} = VALUE`", name.node),
                };
                self.report(finding.help(help));
                None
            }
        }
    }

    /// Which element of a list is meant.
    pub(super) fn index_of_element(&mut self, index: &tree::Expr) -> Expr {
        let index = self.expr_as(index, &Type::Int, "an index");
        if index.ty != Type::Unknown && index.range.high < 0.0 {
            let finding = Diagnostic::error(Code::TypesIndex, index.span, "no element has a negative index");
            self.report(
                finding.help("they are counted from 0, which is the first; the last is `list[list.count - 1]`"),
            );
        }
        index
    }
}
