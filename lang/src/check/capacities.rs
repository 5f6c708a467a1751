//! Functions that are declared once for much that they may be given: for lists of any capacity, `fn room(of: [Point; n]) -> Int`, and for any
//! quantity. For each capacity that one is called with there is a function of its own, which is checked like any other: in it `n` is a number.

use super::args::Given;
use super::quantity::{is_empty_list, is_of_quantity, names_quantity};
use super::type_syntax::LIST_CAPACITY_MAX;
use super::{Checker, ParamInfo, Signature};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Expr, ExprKind};
use crate::source::Span;
use crate::syntax::tree::{self, TyKind};
use crate::types::Type;
use std::collections::{BTreeMap, BTreeSet};

/// The functions that are made of those of any capacity at most, by all scripts together; and the behaviors that are made of others.
pub(super) const INSTANCES_MAX: usize = 256;
/// The capacity with which such a function is checked though nobody calls it.
pub(super) const NOMINAL: u32 = 8;

/// Names of capacities, and what they are.
pub(super) type Capacities = Vec<(String, u32)>;

/// What is declared once, and is several by what it is given: by its number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Declared {
    Fn(usize),
    Activity(usize),
}

/// A function of lists of any capacity, of any quantity, or both.
#[derive(Clone)]
struct Template<'t> {
    module: usize,
    function: &'t tree::Function,
    /// What it calls the capacities, in the order in which they come.
    names: Vec<String>,
}

/// The functions that are declared so, and those that are made of them.
#[derive(Default)]
pub(super) struct Templates<'t> {
    of: BTreeMap<usize, Template<'t>>,
    made: BTreeMap<(usize, Vec<u32>), usize>,
    /// Those whose bodies are still to be checked, by the function that they are made of.
    ahead: Vec<(usize, usize, Vec<u32>)>,
}

impl<'t> Checker<'t> {
    /// The parameters and the result of a function as it is declared.
    pub(super) fn take_template(
        &mut self,
        id: usize,
        m: usize,
        function: &'t tree::Function,
    ) -> (Vec<ParamInfo>, Type) {
        let names = self.capacity_names(m, &function.params);
        let nominal: Vec<u32> = names.iter().map(|_| NOMINAL).collect();
        let template = Template { module: m, function, names };
        if !nominal.is_empty() || takes_quantity(function) {
            self.templates.of.insert(id, template.clone());
        }
        self.signature_for(&template, &nominal)
    }

    /// The names in parameters that are no constants, in the order in which they come.
    pub(super) fn capacity_names(&self, m: usize, params: &[tree::Param]) -> Vec<String> {
        let declared: BTreeSet<&str> = params.iter().map(|param| param.name.node.as_str()).collect();
        let mut names: Vec<String> = Vec::new();
        for name in params.iter().filter_map(|param| capacity(&param.ty)) {
            let is_new = !names.iter().any(|known| known == name) && !declared.contains(name);
            if is_new && self.lookup(m, name).is_none() {
                names.push(name.to_string());
            }
        }
        names
    }

    /// A list or a map that is given for one of any capacity, and how many it may hold.
    pub(super) fn of_any_capacity(&mut self, written: &tree::Expr, ty: &Type) -> (Expr, u32) {
        // A list that is written out may hold any number, until it is known what it is written for, and of any quantity.
        let widest = match ty {
            Type::List(inner, _) if !is_of_quantity(inner) => Some(Type::List(inner.clone(), LIST_CAPACITY_MAX)),
            _ => None,
        };
        let value = self.expr(written, widest.as_ref());
        let capacity = if let Type::List(_, n) | Type::Map(_, n) = value.ty { n } else { 1 };
        (value, capacity)
    }

    /// The capacities in the body of a function that is checked as it is declared.
    pub(super) fn nominal_capacities(&self, id: usize) -> Capacities {
        let names = self.templates.of.get(&id).map(|template| template.names.clone()).unwrap_or_default();
        names.into_iter().map(|name| (name, NOMINAL)).collect()
    }

    pub(super) fn is_template(&self, id: usize) -> bool {
        self.templates.of.contains_key(&id)
    }

    pub(super) fn takes_any_capacity(&self, id: usize) -> bool {
        self.templates.of.get(&id).is_some_and(|template| !template.names.is_empty())
    }

    /// A capacity by its name.
    pub(super) fn capacity_named(&self, name: &str) -> Option<u32> {
        self.scope.capacities.iter().find(|(known, _)| known == name).map(|(_, capacity)| *capacity)
    }

    /// A call of a function that is declared so: that for what it is given.
    pub(super) fn call_of_template(&mut self, id: usize, args: &[tree::Arg], span: Span) -> Expr {
        let Some(template) = self.templates.of.get(&id).cloned() else { return self.unknown(span) };
        let signature = self.fn_signatures[id].clone();
        let (written, failed) = self.by_parameter(&signature.name, &signature.params, args, true);
        let mut capacities: Vec<u32> = template.names.iter().map(|_| 1).collect();
        let mut given: Vec<Option<Given>> = Vec::new();
        for ((written, param), declared) in written.iter().zip(&signature.params).zip(&template.function.params) {
            let place = capacity(&declared.ty).and_then(|name| template.names.iter().position(|known| known == name));
            given.push(match (place, written, &param.ty) {
                // Of what an empty list is empty the others say.
                (_, Some(written), _) if is_empty_list(written) => Some(Given::Written(written)),
                (Some(place), Some(written), Type::List(..) | Type::Map(..)) => {
                    let (value, capacity) = self.of_any_capacity(written, &param.ty);
                    capacities[place] = capacities[place].max(capacity);
                    Some(Given::Known(value))
                }
                (_, written, ty) => written.map(|written| self.given_for(written, ty)),
            });
        }
        let (made, params, result) = if template.names.is_empty() {
            (id, signature.params.clone(), signature.result.clone().unwrap_or(Type::Unknown))
        } else if self.scope.is_nominal {
            // Who calls it is looked at by itself: nothing is made for that.
            let (params, result) = self.signature_for(&template, &capacities);
            (id, params, result)
        } else {
            let Some(made) = self.made_of(id, &template, capacities, span) else { return self.unknown(span) };
            let Signature { params, result, .. } = self.fn_signatures[made].clone();
            (made, params, result.unwrap_or(Type::Unknown))
        };
        let quantity = self.quantity_given(&params, &given);
        let Some((params, result)) = self.signature_of_quantity(params, result, quantity, span) else {
            return self.unknown(span);
        };
        let told = self.findings.len();
        match self.values(&signature.name, &params, given, failed, (span, Some(signature.span))) {
            Some(values) if quantity.is_none() && takes_quantity(template.function) => {
                // What is unknown has been told.
                if self.findings.len() == told && values.iter().all(|value| value.ty != Type::Unknown) {
                    self.quantity_not_given(&signature.name, &params, span);
                }
                self.unknown(span)
            }
            Some(values) => self.make(ExprKind::Call(made, values), result, span),
            None => self.unknown(span),
        }
    }

    /// The function that is made of another for some capacities.
    fn made_of(&mut self, id: usize, template: &Template<'t>, capacities: Vec<u32>, span: Span) -> Option<usize> {
        let key = (id, capacities);
        if let Some(made) = self.templates.made.get(&key) {
            return Some(*made);
        }
        if self.templates.made.len() >= INSTANCES_MAX {
            let message = format!("functions are called with lists of more than {INSTANCES_MAX} capacities");
            let finding = Diagnostic::error(Code::LimitsCapacities, span, message);
            self.report(finding.help("declare lists that are given to one function with one capacity"));
            return None;
        }
        let made = self.fn_signatures.len();
        self.templates.made.insert(key.clone(), made);
        self.templates.ahead.push((made, id, key.1.clone()));
        let named = Signature::named(&template.function.name);
        self.fn_signatures.push(named);
        let (params, result) = self.signature_for(template, &key.1);
        let signature = &mut self.fn_signatures[made];
        (signature.params, signature.result) = (params, Some(result));
        // Before there is room for any it gets its own with the others.
        if self.hir.fns.len() == made {
            let signature = &self.fn_signatures[made];
            self.hir.fns.push(hir::Function::empty(&signature.name, signature.span));
        }
        Some(made)
    }

    fn signature_for(&mut self, template: &Template<'t>, capacities: &[u32]) -> (Vec<ParamInfo>, Type) {
        let named = template.names.iter().cloned().zip(capacities.iter().copied()).collect();
        let outer = std::mem::replace(&mut self.scope.capacities, named);
        let takes_quantity = std::mem::replace(&mut self.scope.takes_quantity, takes_quantity(template.function));
        let params = self.params(template.module, &template.function.params, None);
        let result = self.written_type(template.module, &template.function.result);
        (self.scope.capacities, self.scope.takes_quantity) = (outer, takes_quantity);
        (params, result)
    }

    /// The bodies of functions that calls have made.
    pub(super) fn check_made_functions(&mut self) {
        while let Some((made, id, capacities)) = self.templates.ahead.pop() {
            let Some(template) = self.templates.of.get(&id).cloned() else { continue };
            let named = template.names.iter().cloned().zip(capacities).collect();
            self.fn_body(made, template.module, template.function, named);
        }
    }

    /// Works on a body as it is declared: what is wrong with it there is kept until it is known how it is called.
    pub(super) fn as_declared(&mut self, declared: Declared, is_several: bool, work: impl FnOnce(&mut Self)) {
        let before = self.findings.len();
        work(self);
        if is_several {
            let found: Vec<Diagnostic> = self.findings.drain(before..).collect();
            self.nominal_findings.extend(found.into_iter().map(|finding| (declared, finding)));
        }
    }

    /// Tells what is wrong with what is several by what it is given: as it is declared where nobody calls it, else what is wrong as it is called.
    pub(super) fn tell_nominal(&mut self) {
        let is_called = |c: &Self, declared: Declared| match declared {
            Declared::Fn(id) => c.templates.made.keys().any(|(of, _)| *of == id),
            Declared::Activity(id) => c.is_made_of(id),
        };
        for (declared, finding) in std::mem::take(&mut self.nominal_findings) {
            let is_same = |other: &Diagnostic| other.code == finding.code && other.span() == finding.span();
            let recurs =
                self.findings.iter().any(is_same) || self.inherited_findings.iter().any(|(other, ..)| is_same(other));
            if recurs || !is_called(self, declared) {
                self.report(finding);
            }
        }
    }
}

/// Whether a function is one of any quantity.
pub(super) fn takes_quantity(function: &tree::Function) -> bool {
    function.params.iter().any(|param| names_quantity(&param.ty))
}

/// The name that stands for the capacity of a list.
pub(super) fn capacity(ty: &tree::Ty) -> Option<&str> {
    match &ty.kind {
        TyKind::List { capacity, .. } | TyKind::Map { cells: capacity, .. } => match &capacity.kind {
            tree::ExprKind::Name(name) => Some(name),
            _ => None,
        },
        TyKind::Named { .. } | TyKind::Behavior(..) => None,
    }
}
