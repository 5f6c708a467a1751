//! Which declarations have an error in them: the others can be looked at as if all were well.

use crate::check::Module;
use crate::hir::{ActivityId, Hir};
use crate::source::{FileId, Span};
use crate::syntax::tree::Item;
use std::collections::{BTreeMap, BTreeSet};

/// The declarations in which there is an error.
pub struct Broken {
    /// The places of their names.
    names: BTreeSet<Span>,
    /// The activities that have one or lead to one that has.
    reaching: BTreeSet<ActivityId>,
    /// There is an error in what anything may be made of: a function, a constant, a type, a stretch that nothing could read.
    pub everywhere: bool,
}

impl Broken {
    /// Puts each error with the declaration in which it stands.
    pub fn of(modules: &[Module], errors: &[Span], hir: &Hir) -> Self {
        let mut names = BTreeSet::new();
        let mut everywhere = false;
        // Declarations lie beside one another: the one of a place is the last that begins no later.
        let mut whole: BTreeMap<(FileId, u32), (Option<Span>, Span)> = BTreeMap::new();
        let mut add = |name: Option<Span>, span: Span| whole.insert((span.file, span.start), (name, span));
        for item in modules.iter().flat_map(|module| &module.tree.items) {
            match item {
                Item::Activity(a) => _ = add(Some(a.name.span), a.name.span.to(a.body.span)),
                Item::Scenario { name, body, .. } | Item::Vehicle { name, body, .. } => {
                    add(Some(name.span), name.span.to(body.span));
                }
                // Nothing is made of a test.
                Item::Test(test) => _ = add(None, test.span),
                _ => {}
            }
        }
        for error in errors {
            let before = whole.range(..=(error.file, error.start)).next_back().map(|(_, found)| found);
            match before.filter(|(_, span)| span.holds(*error)) {
                Some((name, _)) => names.extend(*name),
                None => everywhere = true,
            }
        }
        // What is nested where nothing may be has an owner that is none.
        let reaching = reaching(hir, |id| hir.activities.get(id).is_some_and(|a| names.contains(&a.span)));
        Broken { names, reaching, everywhere }
    }

    /// Whether an error stands in a declaration, by the place of its name.
    pub fn holds(&self, name: Span) -> bool {
        self.everywhere || self.names.contains(&name)
    }

    /// Whether an error stands in an activity or in what it calls.
    pub fn reaches(&self, activity: ActivityId) -> bool {
        self.everywhere || self.reaching.contains(&activity)
    }
}

/// The activities that are broken, those nested in such a one, and all that lead to any of them.
fn reaching(hir: &Hir, is_broken: impl Fn(ActivityId) -> bool) -> BTreeSet<ActivityId> {
    let mut leading: BTreeMap<ActivityId, Vec<ActivityId>> = BTreeMap::new();
    for (id, activity) in hir.activities.iter().enumerate() {
        for called in activity.calls() {
            leading.entry(called).or_default().push(id);
        }
    }
    let mut reaching = BTreeSet::new();
    let is_broken = |id: &ActivityId| is_broken(*id) || hir.activities[*id].owner.is_some_and(&is_broken);
    let mut ahead: Vec<ActivityId> = (0..hir.activities.len()).filter(is_broken).collect();
    while let Some(id) = ahead.pop() {
        if reaching.insert(id) {
            ahead.extend(leading.get(&id).into_iter().flatten());
        }
    }
    reaching
}
