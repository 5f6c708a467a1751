//! Names: what each stands for, who may be declared, read and assigned.

use super::facts::Place;
use super::result_range::of_type;
use super::{Checker, Def, Setting};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension;
use crate::hir::{self, Expr, ExprKind, InputPart, Interval, VarId, VarKind};
use crate::prompt::{Held, Known};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_program::senses;
use albacore_syntax::other_languages;
use albacore_wording::listed;

/// What a path of names leads to.
pub(super) enum Found {
    Def(Def),
    Nothing,
}

impl<'t> Checker<'t> {
    /// A name that a module defines, or that everyone knows.
    pub(super) fn lookup(&self, module: usize, name: &str) -> Option<&Def> {
        self.lookup_if(module, name, |_| true)
    }

    /// The same among the definitions of some kind: a name before `(` is looked up among what can be called.
    pub(super) fn lookup_if(&self, module: usize, name: &str, wanted: impl Fn(&Def) -> bool) -> Option<&Def> {
        self.known_in(module, name).filter_map(|m| self.names[m].get(name)).find(|def| wanted(def))
    }

    /// The modules in which a name of a module is looked up: itself, what it extends, and the preludes that define it.
    fn known_in(&self, module: usize, name: &str) -> impl Iterator<Item = usize> {
        let own = std::iter::successors(Some(module), |&m| self.modules[m].extends);
        own.chain(self.preludes_with.get(name).into_iter().flatten().copied())
    }

    /// The name at a place is one of those among which [`Checker::lookup_if`] looks.
    pub(super) fn refer_to(&self, at: Span, module: usize, name: &str, wanted: impl Fn(&Def) -> bool) {
        let of = self.known_in(module, name).find(|&m| self.names[m].get(name).is_some_and(&wanted));
        if let Some(place) = of.and_then(|m| self.places[m].get(name)) {
            self.names_used.refer(at, *place);
        }
    }

    /// What a module of its imports defines under a name.
    fn imported(&self, module: usize, (from, at): (&str, Span), name: &tree::Name) -> Option<&Def> {
        let imported = self.import(module, from, at)?;
        self.defined_in(imported, name)
    }

    /// Where an imported name leads.
    pub(super) fn import(&self, module: usize, name: &str, at: Span) -> Option<usize> {
        let imported = *self.modules[module].imports.get(name)?;
        self.names_used.import(module, name);
        if let Some(place) = self.import_places[module].get(name) {
            self.names_used.refer(at, *place);
        }
        Some(imported)
    }

    /// What a module defines under a name.
    pub(super) fn defined_in(&self, module: usize, name: &tree::Name) -> Option<&Def> {
        self.names_used.mention(module, &name.node);
        if let Some(place) = self.places[module].get(&name.node) {
            self.names_used.refer(name.span, *place);
        }
        self.names[module].get(&name.node)
    }

    /// What `name` or `module.name` stands for where a path is written.
    pub(super) fn resolve(&self, module: usize, path: &tree::Path) -> Option<&Def> {
        match path.parts.as_slice() {
            [name] => {
                self.names_used.mention(module, &name.node);
                self.refer_to(name.span, module, &name.node, |_| true);
                self.lookup(module, &name.node)
            }
            [from, name] => self.imported(module, (&from.node, from.span), name),
            _ => None,
        }
    }

    pub(super) fn local(&self, name: &str) -> Option<VarId> {
        self.scope.visible.get(name)
    }

    /// Says where a name would hide another, and how to mend that.
    pub(super) fn name_is_new(&mut self, name: &tree::Name, help: &str) {
        let earlier = self.local(&name.node).map(|id| self.scope.vars[id].span);
        let finding = |what: &str| {
            Diagnostic::error(Code::NamesShadowed, name.span, format!("`{}` is the name of {what} already", name.node))
                .here("nothing can be shadowed")
                .help(help)
        };
        let given = self.given_behavior(&name.node).map(|given| given.span());
        if let Some(span) = earlier.or(given) {
            self.report(finding("something").label(span, "declared here"));
        } else if self.capacity_named(&name.node).is_some() {
            self.report(finding("a capacity"));
        } else {
            let homes = self.scope.derived.iter().flat_map(|derived| &derived.homes);
            let mut known = homes.chain([&self.scope.module]).filter_map(|&m| self.lookup(m, &name.node));
            let hidden = known.find(|def| !def.shares_its_name()).map(|def| match def {
                Def::Variant(of, _) => finding(&format!("a variant of `{}`", self.types.enums[*of].name)),
                def => finding(def.what()),
            });
            self.findings.extend(hidden);
        }
    }

    /// Makes a variable known from here on.
    pub(super) fn declare(&mut self, name: &tree::Name, kind: VarKind, ty: Type) -> VarId {
        self.name_is_new(name, "choose another name");
        self.names_used.declare(name, kind);
        self.declare_hidden(name.node.clone(), kind, ty, name.span)
    }

    pub(super) fn declare_hidden(&mut self, name: String, kind: VarKind, ty: Type, span: Span) -> VarId {
        let id = self.scope.vars.len();
        let range = of_type(&ty);
        self.scope.vars.push(hir::Var {
            name: name.clone(),
            kind,
            ty,
            span,
            range,
            walks_constants: false,
            is_momentary: false,
            order: None,
        });
        self.scope.visible.push(name, id);
        id
    }

    pub(super) fn name(&mut self, name: &str, span: Span) -> Expr {
        if let Some(id) = self.local(name) {
            let declared = self.scope.vars[id].span;
            self.names_used.read(declared);
            self.names_used.refer(span, declared);
            return self.variable(id, span);
        }
        if self.use_given(name, span).is_some() {
            let finding = Diagnostic::error(Code::TypesBehavior, span, format!("`{name}` is a behavior, no value"));
            self.report(
                finding.help(format!("call it as a statement, `{name}(…)`, or give it to a behavior that takes one")),
            );
            return self.unknown(span);
        }
        if let Some(capacity) = self.capacity_named(name) {
            return self.make(ExprKind::Number(f64::from(capacity)), Type::Int, span);
        }
        // What can only be called is no value: a behavior `flow` leaves the input `flow` what it is.
        let value = self.lookup_if(self.scope.module, name, |def| !def.can_be_called());
        let is_value = value.is_some();
        let found = value.or_else(|| self.lookup(self.scope.module, name)).cloned();
        match found {
            Some(def) => {
                self.names_used.mention(self.scope.module, name);
                self.refer_to(span, self.scope.module, name, |def| !is_value || !def.can_be_called());
                self.def_value(&def, name, span)
            }
            // What was refused has no name, and has been told.
            None if name.is_empty() => self.unknown(span),
            None => {
                self.unknown_name(name, span);
                self.unknown(span)
            }
        }
    }

    /// The value that a module's name stands for.
    pub(super) fn def_value(&mut self, def: &Def, name: &str, span: Span) -> Expr {
        match def {
            Def::Const(id) => Expr { span, ..self.constant(*id) },
            Def::Signal(id) => {
                let value = self.module_signal(*id);
                if self.scope.setting == Setting::Function || self.scope.setting == Setting::Constant {
                    self.no_inputs_here(name, span);
                    return self.unknown(span);
                }
                Expr { span, ..value }
            }
            Def::Variant(id, variant) => {
                Expr { kind: ExprKind::Number(*variant as f64), ty: Type::Enum(*id), span, range: Interval::ANY }
            }
            Def::Input(id) => {
                if self.scope.setting == Setting::Function || self.scope.setting == Setting::Constant {
                    self.no_inputs_here(name, span);
                    return self.unknown(span);
                }
                let input = &self.hir.inputs[*id];
                // No sample is held to the two values of a sign: what an input tells is a whole number.
                let of_type = match of_type(&input.ty) {
                    _ if input.ty == Type::Sign => Interval::INT,
                    _ if input.name == senses::ELAPSED => hir::ELAPSED,
                    range => range,
                };
                let range = self.scope.facts.narrowed(Place::Input(*id), of_type);
                Expr { kind: ExprKind::Input(*id, InputPart::Value), ty: input.ty.clone(), span, range }
            }
            other => {
                let what = other.what();
                let finding = Diagnostic::error(Code::NamesValue, span, format!("`{name}` is {what}, no value"));
                let finding = match other {
                    Def::Fn(_) | Def::Record(_) => finding.help(format!("write `{name}(…)`")),
                    Def::Activity(_) => finding.help(format!("call it as a statement: `{name}(…)`")),
                    Def::Payload(_) => finding.help(format!("ask it: `ask {name}.ACTION() within 10 s`")),
                    Def::Enum(id) => {
                        let variants: Vec<&str> = self.types.enums[*id].variants.iter().map(String::as_str).collect();
                        finding.help(format!("its variants are written alone: {}", listed(&variants)))
                    }
                    _ => finding,
                };
                self.report(finding);
                self.unknown(span)
            }
        }
    }

    fn no_inputs_here(&mut self, name: &str, span: Span) {
        let finding = if self.scope.setting == Setting::Function {
            Diagnostic::error(Code::NamesInput, span, format!("a function cannot read the input `{name}`"))
                .help("give the function a parameter, and pass the input as its argument")
        } else if self.test.is_some() {
            let message = format!("a test cannot read the input `{name}`");
            Diagnostic::error(Code::NamesInput, span, message).help(match name {
                "position" => "where the vehicle truly is stands in `truth.position`".to_string(),
                _ => format!("let the mission report it, `report \"{name}\": {name}`, and look at what was reported"),
            })
        } else {
            Diagnostic::error(Code::NamesInput, span, format!("`{name}` is known only when the vehicle moves"))
                .here("a constant is needed here")
        };
        self.report(finding);
    }

    fn unknown_name(&mut self, name: &str, span: Span) {
        let finding = self.unknown_name_finding(name, span);
        self.report(finding);
    }

    /// Whether nothing is named so here.
    pub(super) fn is_unknown(&self, name: &str) -> bool {
        self.local(name).is_none() && self.lookup(self.scope.module, name).is_none()
    }

    /// A word that is no name, where a text is usual.
    pub(super) fn bare_text(&mut self, word: &str, span: Span) {
        let finding = self.unknown_name_finding(word, span);
        let is_near = finding.help.is_some();
        self.report(if is_near {
            finding
        } else {
            finding.help(format!("a text stands between quotes: `\"{word}\"`"))
        });
    }

    /// What is assigned and was never declared.
    fn undeclared(&mut self, name: &tree::Name) {
        let finding = self.unknown_name_finding(&name.node, name.span);
        let help = match self.scope.setting {
            _ if name.node == "area" => "the area of a mission has a name: `area op = rectangle(…)`".to_string(),
            Setting::Body if self.known_at_prompt().is_some() => format!("declare it: `var {} = …`", name.node),
            Setting::Body => {
                format!(
                    "declare it: `memory {0}: TYPE = …` at the top, or `let {0} = …` here if it never changes",
                    name.node
                )
            }
            _ => format!("declare it: `var {0} = …` here, or `memory {0}: TYPE = …` to keep it", name.node),
        };
        // Of one or two letters everything is near.
        let declare = finding.help.is_none() || name.node.chars().count() <= 2;
        self.report(if declare { finding.help(help) } else { finding });
    }

    fn unknown_name_finding(&self, name: &str, span: Span) -> Diagnostic {
        let finding = Diagnostic::error(Code::NamesUnknown, span, format!("nothing is named `{name}` here"));
        if self.modules[self.scope.module].imports.contains_key(name) {
            Diagnostic::error(Code::NamesModule, span, format!("`{name}` is a module, no value"))
                .help(format!("write `{name}.NAME`"))
        } else if let Some(help) = self.test.as_ref().and_then(|_| other_languages::end_of_run(name)) {
            finding.help(help)
        } else if let Some(mission) = self.tested_that_has(name) {
            finding.help(format!("the mission `{mission}` has one: write `{mission}.{name}`"))
        } else if let Some(help) = other_languages::help(name) {
            finding.help(help)
        } else if dimension::unit(name, &|_| None).is_some() {
            finding.help(format!("`{name}` is a unit: a number stands before it, such as `10 {name}`"))
        } else if let Some(near) = self.nearest(name, self.known_names()) {
            finding.help(format!("did you mean `{near}`?"))
        } else if let Some((known, rest)) = self.run_together(name) {
            finding.help(format!("a sign is missing between `{known}` and `{rest}`, if these are two"))
        } else if let Some(module) = self.import_with(self.scope.module, name, |_| true) {
            finding.help(format!("the module `{module}` has one: write `{module}.{name}`"))
        } else {
            finding
        }
    }

    /// Two words between which something was left out: the longest known name with which a name begins, and the rest.
    fn run_together<'n>(&self, name: &'n str) -> Option<(&'n str, &'n str)> {
        let ends = name.char_indices().map(|(at, _)| at).skip(2).collect::<Vec<_>>();
        let known =
            |at: &usize| self.local(&name[..*at]).is_some() || self.lookup(self.scope.module, &name[..*at]).is_some();
        ends.into_iter().rev().find(known).map(|at| name.split_at(at)).filter(|(_, rest)| !rest.starts_with('_'))
    }

    /// The import of a module under whose name such a definition is found.
    pub(super) fn import_with(&self, m: usize, name: &str, is_such: impl Fn(&Def) -> bool) -> Option<&'t str> {
        let has = |i: usize| self.names[i].get(name).is_some_and(&is_such);
        self.modules[m].imports.iter().find(|(_, i)| has(**i)).map(|(module, _)| module.as_str())
    }

    fn known_names(&self) -> impl Iterator<Item = &str> {
        let module = self.scope.module;
        let modules = (0..self.modules.len()).filter(move |&m| m == module || self.modules[m].prelude);
        let values = modules.flat_map(|m| {
            self.names[m].iter().filter(|(_, d)| {
                !matches!(d, Def::Scenario(_) | Def::Vehicle(_) | Def::Payload(_) | Def::Clause(_) | Def::Unit(_))
            })
        });
        self.scope.visible.names().chain(values.map(|(n, _)| n.as_str()))
    }

    /// What can be called without a module's name before it.
    pub(super) fn callable_names(&self) -> impl Iterator<Item = &str> {
        let module = self.scope.module;
        let modules = (0..self.modules.len()).filter(move |&m| m == module || self.modules[m].prelude);
        modules.flat_map(|m| {
            let callable = |d: &Def| matches!(d, Def::Fn(_) | Def::Record(_) | Def::Activity(_));
            self.names[m].iter().filter(move |(_, d)| callable(d)).map(|(n, _)| n.as_str())
        })
    }

    /// What `module.name` or `name` before parentheses leads to, when its head is no variable.
    pub(super) fn find(&self, e: &tree::Expr) -> Found {
        use tree::ExprKind as K;
        match &e.kind {
            K::Name(name) => {
                self.names_used.mention(self.scope.module, name);
                self.refer_to(e.span, self.scope.module, name, Def::can_be_called);
                let callable = self.lookup_if(self.scope.module, name, Def::can_be_called);
                callable.cloned().map_or(Found::Nothing, Found::Def)
            }
            K::Member(base, member) => match &base.kind {
                K::Name(module) if self.local(module).is_none() => {
                    let def = self.imported(self.scope.module, (module, base.span), member);
                    def.cloned().map_or(Found::Nothing, Found::Def)
                }
                _ => Found::Nothing,
            },
            _ => Found::Nothing,
        }
    }

    /// The module that a name stands for, when it is no value.
    pub(super) fn module_named(&self, e: &tree::Expr) -> Option<usize> {
        match &e.kind {
            tree::ExprKind::Name(name) if self.local(name).is_none() => self.import(self.scope.module, name, e.span),
            _ => None,
        }
    }

    /// The names that a line of statements at the prompt begins with: its first variables.
    pub(super) fn known_at_prompt(&self) -> Option<&'t [Known]> {
        self.modules[self.scope.module].known.as_deref()
    }

    /// Whether a variable may be assigned here.
    pub(super) fn assignable(&mut self, name: &tree::Name) -> Option<usize> {
        let Some(id) = self.local(&name.node) else {
            match self.lookup(self.scope.module, &name.node) {
                Some(def) => {
                    let what = def.what();
                    let help = match other_languages::command(&name.node, "") {
                        Some(help) => help,
                        None if def.shares_its_name() => format!("write `let {} = …` to name a value", name.node),
                        None => "give the value a name of its own: `let NAME = …`".to_string(),
                    };
                    let message = format!("`{}` is {what} and cannot be assigned", name.node);
                    self.report(Diagnostic::error(Code::NamesAssign, name.span, message).help(help));
                }
                None => {
                    self.undeclared(name);
                    // From here on it is known: what reads it is no second mistake.
                    self.declare_hidden(name.node.clone(), VarKind::Var, Type::Unknown, name.span);
                }
            }
            return None;
        };
        let var = self.scope.vars[id].clone();
        self.names_used.refer(name.span, var.span);
        if var.kind != VarKind::Memory
            && let Some(known) = self.known_at_prompt().and_then(|known| known.get(id))
        {
            let (what, help) = match known.held {
                Held::Mission => {
                    ("a name of the mission that is under way", "give a name of your own: `var NAME = …`".to_string())
                }
                _ => (
                    "fixed",
                    format!(
                        "`let {0} = …` gives the name to another value, `var {0} = …` to one that can be assigned",
                        name.node
                    ),
                ),
            };
            let message = format!("`{}` is {what}: it cannot be assigned", name.node);
            self.report(Diagnostic::error(Code::NamesAssign, name.span, message).help(help));
            return None;
        }
        let (what, help) = match var.kind {
            VarKind::Memory if self.scope.setting == Setting::Function => {
                ("a memory, and functions are pure", "return the new value")
            }
            VarKind::Memory | VarKind::Var if self.is_assigned_in_value(id, name.span) => return None,
            VarKind::Memory | VarKind::Var => return Some(id),
            VarKind::Let => ("fixed where it stands", "declare it with `memory`, or with `var` in instantaneous code"),
            VarKind::Param => ("a parameter", "declare a `memory` that begins with its value"),
            VarKind::Signal => ("a signal, computed anew at every tick", "declare a `memory`"),
            VarKind::Loop => ("set by its loop", "declare a `memory`"),
            VarKind::Area => ("the mission's area", "declare a `memory`"),
        };
        let finding = Diagnostic::error(
            Code::NamesAssign,
            name.span,
            format!("`{}` is {what}: it cannot be assigned", name.node),
        )
        .label(var.span, "declared here")
        .help(help);
        self.report(finding);
        None
    }
}
