//! Names that are declared and that nobody uses: often the other half of a slip, such as the wrong name read elsewhere.

use super::Checker;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::VarKind;
use crate::names::{Names, what_of};
use crate::source::Span;
use crate::syntax::tree::{ActivityKind, File, Item, Name};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// What was declared, and what of it was read.
#[derive(Default)]
pub(super) struct NamesUsed {
    declared: Vec<(Name, VarKind)>,
    /// What every name stands for.
    names: RefCell<Names>,
    /// The variables that were read, by the places of their declarations.
    read: BTreeSet<Span>,
    /// The names by which a module's declarations were asked for. Looking a name up changes nothing else: hence the cells.
    mentioned: RefCell<BTreeSet<(usize, String)>>,
    imported: RefCell<BTreeSet<(usize, String)>>,
    /// What is looked at stands in the base of a strategy: its names have been seen to there.
    inherited: bool,
}

impl NamesUsed {
    pub fn declare(&mut self, name: &Name, kind: VarKind) {
        self.define(name, what_of(kind));
        if !self.inherited {
            self.declared.push((name.clone(), kind));
        }
    }

    /// Whether what comes stands in the base of a strategy; gives what was so before.
    pub fn inherit(&mut self, inherited: bool) -> bool {
        std::mem::replace(&mut self.inherited, inherited)
    }

    pub fn define(&self, name: &Name, what: &'static str) {
        self.names.borrow_mut().define(name.span, &name.node, what);
    }

    /// The name at a place is the one that is declared at another.
    pub fn refer(&self, place: Span, declared: Span) {
        if !self.inherited {
            self.names.borrow_mut().refer(place, declared);
        }
    }

    pub fn into_names(self) -> Names {
        self.names.into_inner()
    }

    pub fn read(&mut self, declared: Span) {
        self.read.insert(declared);
    }

    pub fn mention(&self, module: usize, name: &str) {
        self.mentioned.borrow_mut().insert((module, name.to_string()));
    }

    pub fn import(&self, module: usize, name: &str) {
        self.imported.borrow_mut().insert((module, name.to_string()));
    }
}

impl Checker<'_> {
    /// A warning for each name that nobody uses.
    pub(super) fn unused_names(&self) -> Vec<Diagnostic> {
        let variables = self.names_used.declared.iter().filter(|(name, _)| !self.names_used.read.contains(&name.span));
        let mut findings: Vec<Diagnostic> = variables.filter_map(|(name, kind)| unread(name, *kind)).collect();
        for (m, module) in self.modules.iter().enumerate() {
            findings.extend(module.tree.items.iter().flat_map(|item| self.unused_imports(m, item)));
            if m == crate::MAIN && is_whole(&module.tree) {
                findings.extend(module.tree.items.iter().filter_map(|item| self.unused_item(m, item)));
            }
        }
        findings.retain(|finding| !finding.message.starts_with("`_"));
        findings
    }

    fn unused_imports(&self, m: usize, item: &Item) -> Vec<Diagnostic> {
        let Item::Use(paths) = item else { return Vec::new() };
        let imported = self.names_used.imported.borrow();
        // What could not be imported has been told.
        let unused = paths.iter().filter_map(|path| path.parts.last()).filter(|name| {
            self.modules[m].imports.contains_key(&name.node) && !imported.contains(&(m, name.node.clone()))
        });
        unused.map(|name| finding(name, "imported and never used", "leave it out of `use`")).collect()
    }

    fn unused_item(&self, m: usize, item: &Item) -> Option<Diagnostic> {
        let mentioned = self.names_used.mentioned.borrow();
        let is_unused = |name: &Name| !mentioned.contains(&(m, name.node.clone()));
        let (name, what, help) = match item {
            Item::Const(c) => (&c.name, "never read", "read it, or remove it"),
            Item::Signal { name, .. } => (name, "never read", "read it, or remove it"),
            Item::Fn(f) => (&f.name, "never called", "call it, or remove it"),
            Item::Activity(a) => match a.kind {
                ActivityKind::Behavior | ActivityKind::Strategy { .. } => {
                    (&a.name, "never called", "call it from the mission, or remove it")
                }
                ActivityKind::Overlay { .. } => (&a.name, "never put on", "put it on: `with NAME(…)`, or remove it"),
                ActivityKind::Mission { .. } => return None,
            },
            _ => return None,
        };
        is_unused(name).then(|| finding(name, what, &help.replace("NAME", &name.node)))
    }
}

/// Whether a file is a whole program: what another declares is there for those that import it.
fn is_whole(file: &File) -> bool {
    file.items.iter().any(|item| matches!(item, Item::Activity(a) if matches!(a.kind, ActivityKind::Mission { .. })))
}

/// The finding for a variable that nobody reads. A loop may count its rounds only, and an area bounds the mission.
fn unread(name: &Name, kind: VarKind) -> Option<Diagnostic> {
    let (what, help) = match kind {
        VarKind::Param => ("a parameter that nothing reads", "read it, or leave it out here and in the calls"),
        VarKind::Let => ("never read", "read it, or leave out `let` and the name"),
        VarKind::Var => ("never read", "read it, or remove it"),
        VarKind::Memory => ("a memory that nothing reads", "read it, or remove it with what assigns it"),
        VarKind::Signal => ("a signal that nothing reads", "read it, in a rule or a condition, or remove it"),
        VarKind::Loop | VarKind::Area => return None,
    };
    Some(finding(name, what, &format!("{help}; a name that begins with `_` is meant to stay unread")))
}

fn finding(name: &Name, what: &str, help: &str) -> Diagnostic {
    Diagnostic::warning(Code::NamesUnused, name.span, format!("`{}` is {what}", name.node)).help(help)
}
