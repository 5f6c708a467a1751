//! Which declarations have an error in them: the others can be looked at as if all were well.

use crate::check::Module;
use crate::hir::Hir;
use crate::source::Span;
use crate::syntax::tree::Item;
use std::collections::BTreeSet;

/// The declarations in which there is an error.
pub struct Broken {
    /// The places of their names.
    names: BTreeSet<Span>,
    /// There is an error in what anything may be made of: a function, a constant, a type, a stretch that nothing could read.
    everywhere: bool,
}

impl Broken {
    /// Puts each error with the declaration in which it stands.
    pub fn of(modules: &[Module], errors: &[Span], hir: &Hir) -> Self {
        let mut broken = Broken { names: BTreeSet::new(), everywhere: false };
        let mut whole: Vec<(Span, Span)> = Vec::new();
        let mut apart: Vec<Span> = Vec::new();
        for item in modules.iter().flat_map(|module| &module.tree.items) {
            match item {
                Item::Activity(a) => whole.push((a.name.span, a.name.span.to(a.body.span))),
                Item::Scenario { name, body, .. } | Item::Vehicle { name, body } => {
                    whole.push((name.span, name.span.to(body.span)))
                }
                // Nothing is made of a test.
                Item::Test(test) => apart.push(test.span),
                _ => {}
            }
        }
        for error in errors {
            match whole.iter().find(|(_, span)| span.holds(*error)) {
                Some((name, _)) => _ = broken.names.insert(*name),
                None => broken.everywhere |= !apart.iter().any(|span| span.holds(*error)),
            }
        }
        // A behavior of a table is broken with its strategy.
        let is_broken = |owner: usize| hir.activities.get(owner).is_some_and(|o| broken.names.contains(&o.span));
        let owned = hir.activities.iter().filter(|a| a.owner.is_some_and(is_broken));
        let owned: Vec<Span> = owned.map(|a| a.span).collect();
        broken.names.extend(owned);
        broken
    }

    /// Whether an error stands in a declaration, by the place of its name.
    pub fn holds(&self, name: Span) -> bool {
        self.everywhere || self.names.contains(&name)
    }

    /// Whether an error stands in an activity or in what it calls.
    pub fn reaches(&self, hir: &Hir, activity: usize) -> bool {
        self.everywhere || hir.called_from(activity).iter().any(|&id| self.names.contains(&hir.activities[id].span))
    }
}
