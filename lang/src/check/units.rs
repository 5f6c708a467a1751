//! Units that files declare, each after those that it is made of, wherever they stand.

use super::{Checker, Def, Module};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::{self, Unit};
use crate::source::Span;
use crate::syntax::tree::{self, Item};
use std::collections::{BTreeMap, BTreeSet};

/// Units that are not declared yet: by module and name, the first of that name.
#[derive(Default)]
pub(super) struct UnitsAhead<'t> {
    by_name: BTreeMap<(usize, &'t str), (&'t tree::Name, &'t tree::Expr)>,
    read: BTreeSet<Span>,
}

impl<'t> UnitsAhead<'t> {
    pub fn of(modules: &'t [Module]) -> Self {
        let mut by_name: BTreeMap<_, (&'t tree::Name, &'t tree::Expr)> = BTreeMap::new();
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                if let Item::Unit { name, value } = item {
                    by_name.entry((m, name.node.as_str())).or_insert((name, value));
                }
            }
        }
        UnitsAhead { by_name, read: BTreeSet::new() }
    }

    /// A unit that one is made of and that is not declared yet.
    fn base(&self, m: usize, value: &tree::Expr) -> Option<(&'t tree::Name, &'t tree::Expr)> {
        let tree::ExprKind::Number { unit: Some(unit), .. } = &value.kind else { return None };
        let known = |word: &&str| dimension::UNITS.iter().any(|(name, ..)| name == word);
        dimension::words(&unit.node).filter(|word| !known(word)).find_map(|word| self.by_name.get(&(m, word)).copied())
    }
}

impl<'t> Checker<'t> {
    /// Declares a unit, and before it those that it is made of.
    pub(super) fn declare_unit(&mut self, m: usize, name: &'t tree::Name, value: &'t tree::Expr) {
        let mut row = vec![(name, value)];
        while let Some(&(name, value)) = row.last() {
            if self.units_ahead.read.contains(&name.span) {
                row.pop();
                continue;
            }
            match self.units_ahead.base(m, value) {
                Some((base, _)) if row.iter().any(|(waiting, _)| waiting.span == base.span) => {
                    let message = format!("the unit `{}` is made of itself", base.node);
                    let finding = Diagnostic::error(Code::UnitsDeclaration, value.span, message);
                    self.report(finding.help("declare one of them by a unit that is known: `unit fathom = 1.8288 m`"));
                    for (unit, _) in row.drain(..) {
                        self.unit_is_read(m, unit);
                    }
                }
                Some(base) => row.push(base),
                None => {
                    if let Some(unit) = self.declared_unit(m, name, value) {
                        self.define(m, name, Def::Unit(unit));
                    }
                    self.unit_is_read(m, name);
                    row.pop();
                }
            }
        }
    }

    fn unit_is_read(&mut self, m: usize, name: &'t tree::Name) {
        self.units_ahead.read.insert(name.span);
        let key = (m, name.node.as_str());
        if self.units_ahead.by_name.get(&key).is_some_and(|(first, _)| first.span == name.span) {
            self.units_ahead.by_name.remove(&key);
        }
    }

    fn declared_unit(&mut self, m: usize, name: &tree::Name, value: &tree::Expr) -> Option<Unit> {
        if name.node.contains('_') {
            // Behind a number a unit ends there.
            let message = "the name of a unit is letters and digits alone";
            let help = format!("write `{}`", name.node.split('_').collect::<String>());
            self.report(Diagnostic::error(Code::UnitsDeclaration, name.span, message).help(help));
            return None;
        }
        let tree::ExprKind::Number { value: number, unit: Some(unit), .. } = &value.kind else {
            self.report(
                Diagnostic::error(Code::UnitsDeclaration, value.span, "a unit is declared by a quantity")
                    .help("for example `unit fathom = 1.8288 m`"),
            );
            return None;
        };
        let base = self.unit(m, unit)?;
        self.sensible_quantity(base.scale * number, value.span).then_some(())?;
        Some(Unit { dimension: base.dimension, scale: base.scale * number })
    }

    /// The unit that a module declares by a name.
    pub(super) fn own_unit(&self, module: usize, name: &str) -> Option<Unit> {
        match self.lookup(module, name) {
            Some(Def::Unit(unit)) => Some(*unit),
            _ => None,
        }
    }
}
