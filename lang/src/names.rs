//! The names of a program: where each is declared, and where it is used.

use crate::hir::VarKind;
use crate::source::Span;
use std::collections::BTreeMap;

/// Every name that a script declares and that could be resolved, by places. What the language itself knows has none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// By the place of the name in its declaration.
    definitions: BTreeMap<Span, Definition>,
    /// By the place of a use, the place of the name in its declaration.
    uses: BTreeMap<Span, Span>,
}

/// A name that is declared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// What it names, as messages say it: `a constant`.
    pub what: &'static str,
}

impl Names {
    pub(crate) fn define(&mut self, place: Span, name: &str, what: &'static str) {
        self.definitions.entry(place).or_insert_with(|| Definition { name: name.to_string(), what });
    }

    pub(crate) fn refer(&mut self, place: Span, definition: Span) {
        if place != definition {
            self.uses.insert(place, definition);
        }
    }

    /// What is declared, in the order of files and places.
    pub fn definitions(&self) -> impl Iterator<Item = (Span, &Definition)> {
        self.definitions.iter().map(|(place, definition)| (*place, definition))
    }

    /// The declaration of the name that stands at a place: a use of it, or the declaration itself.
    pub fn declared_at(&self, place: Span) -> Option<(Span, &Definition)> {
        let declared = self.uses.get(&place).copied().unwrap_or(place);
        self.definitions.get(&declared).map(|definition| (declared, definition))
    }

    /// Where a name is used that is declared at a place.
    pub fn uses_of(&self, declared: Span) -> impl Iterator<Item = Span> {
        self.uses.iter().filter(move |(_, definition)| **definition == declared).map(|(place, _)| *place)
    }
}

/// What a variable is, as messages say it.
pub(crate) fn what_of(kind: VarKind) -> &'static str {
    match kind {
        VarKind::Param => "a parameter",
        VarKind::Let | VarKind::Var | VarKind::Loop => "a variable",
        VarKind::Memory => "a memory",
        VarKind::Signal => "a signal",
        VarKind::Area => "an area",
    }
}
