//! Strategies that are derived from others: `strategy b(…) = a with { … }` is what `a` is, but for what it says itself.
//!
//! Each is written whole before anything is checked: a tree of which parts stand in the base. What a part names is looked up in the module in
//! which it stands.

use super::derived::{Bases, Lineage};
use super::{Checker, Module};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use crate::syntax::tree::{Activity, ActivityKind, Block, Clause, ClauseKind, Item, Param, Path, Target, WithItem};
use albacore_program::Channel;
use albacore_wording::{help, nearest};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What is said where a strategy names its base, of what is wrong with that only here.
const OF_BASE: &str = "with what this strategy says itself";
/// Bytes of text that strategies have of others, in all of a script.
const INHERITED_BYTES_MAX: usize = 1 << 20;

/// A strategy by its place: its module, and which item of that it is.
type Place = (usize, usize);

/// Modules in which every strategy is written whole.
pub(super) struct Whole<'m> {
    pub modules: Cow<'m, [Module]>,
    /// In which module the parts of strategies stand, by their files; empty where nothing is derived.
    pub homes: BTreeMap<FileId, usize>,
    /// The places of the names of those whose base is none.
    pub baseless: BTreeSet<Span>,
    pub findings: Vec<Diagnostic>,
}

/// Writes the strategies of all modules whole.
pub(super) fn strategies(modules: &[Module]) -> Whole<'_> {
    let is_derived = |item: &Item| matches!(strategy(item), Some((_, Some(_))));
    if !modules.iter().any(|module| module.tree.items.iter().any(is_derived)) {
        let (homes, baseless, findings) = (BTreeMap::new(), BTreeSet::new(), Vec::new());
        return Whole { modules: Cow::Borrowed(modules), homes, baseless, findings };
    }
    let known = Strategies::of(modules);
    let mut findings = Vec::new();
    let bases = known.all.iter().map(|&(m, i)| {
        let (own, base) = strategy(&modules[m].tree.items[i])?;
        known.named(m, base?).or_else(|| {
            let (finding, meant) = known.unknown(m, &own.name.node, base?);
            findings.push(finding);
            meant
        })
    });
    let bases = bases.collect();
    let names = known.all.iter().filter_map(|&(m, i)| strategy(&modules[m].tree.items[i]));
    let names = names.map(|(own, base)| (&own.name, base)).collect();
    let (Lineage { order, bases }, unsound) = Bases { code: Code::RulesDerived, names, bases }.lineage();
    findings.extend(unsound);
    let mut whole = modules.to_vec();
    let mut room = INHERITED_BYTES_MAX;
    let mut baseless = BTreeSet::new();
    for id in order {
        let (m, i) = known.all[id];
        let Some((own, Some(path))) = strategy(&modules[m].tree.items[i]) else { continue };
        let base = bases[id].map(|base| known.all[base]).filter(|&(m, i)| {
            strategy(&modules[m].tree.items[i]).is_some_and(|(base, _)| !baseless.contains(&base.name.span))
        });
        let Some((base, _)) = base.and_then(|(m, i)| strategy(&whole[m].tree.items[i])) else {
            baseless.insert(own.name.span);
            continue;
        };
        let taken: usize = base.body.clauses.iter().map(|clause| (clause.span.end - clause.span.start) as usize).sum();
        let Some(left) = room.checked_sub(taken) else {
            let message =
                format!("with this, strategies have more than {} MiB of text of others", INHERITED_BYTES_MAX >> 20);
            findings.push(
                Diagnostic::error(Code::RulesDerived, path.span, message)
                    .help("derive fewer, or let what they share be behaviors of a module, which they call"),
            );
            baseless.insert(own.name.span);
            continue;
        };
        room = left;
        let derived = derive(base, own);
        if let Some(item) = Arc::make_mut(&mut whole[m].tree).items.get_mut(i) {
            *item = Item::Activity(derived);
        }
    }
    let places =
        known.all.iter().filter_map(|&(m, i)| Some((strategy(&modules[m].tree.items[i])?.0.name.span.file, m)));
    Whole { modules: Cow::Owned(whole), homes: places.collect(), baseless, findings }
}

/// A strategy, and what it is derived from.
fn strategy(item: &Item) -> Option<(&Activity, Option<&Path>)> {
    match item {
        Item::Activity(activity) => match &activity.kind {
            ActivityKind::Strategy { base } => Some((activity, base.as_ref())),
            _ => None,
        },
        _ => None,
    }
}

/// All strategies, and which of them a name is.
struct Strategies<'m> {
    modules: &'m [Module],
    all: Vec<Place>,
    named: BTreeMap<(usize, &'m str), usize>,
}

impl<'m> Strategies<'m> {
    fn of(modules: &'m [Module]) -> Self {
        let mut strategies = Strategies { modules, all: Vec::new(), named: BTreeMap::new() };
        for (m, module) in modules.iter().enumerate() {
            for (i, item) in module.tree.items.iter().enumerate() {
                if let Some((activity, _)) = strategy(item) {
                    strategies.named.entry((m, &activity.name.node)).or_insert(strategies.all.len());
                    strategies.all.push((m, i));
                }
            }
        }
        strategies
    }

    /// The modules whose names a module knows as its own.
    fn known_in(&self, module: usize) -> impl Iterator<Item = usize> {
        let own = std::iter::successors(Some(module), |&m| self.modules[m].extends);
        own.chain((0..self.modules.len()).filter(|&m| self.modules[m].prelude))
    }

    fn named(&self, module: usize, path: &Path) -> Option<usize> {
        match path.parts.as_slice() {
            [name] => self.known_in(module).find_map(|m| self.named.get(&(m, name.node.as_str()))).copied(),
            [from, name] => {
                let imported = *self.modules[module].imports.get(&from.node)?;
                self.named.get(&(imported, name.node.as_str())).copied()
            }
            _ => None,
        }
    }

    /// What is said of a path that names no strategy, and the one that was probably meant, which stands in for it.
    fn unknown(&self, module: usize, own: &str, path: &Path) -> (Diagnostic, Option<usize>) {
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        let known_in: BTreeSet<usize> = self.known_in(module).collect();
        for (&(m, name), &id) in self.named.iter().filter(|((_, name), _)| *name != own) {
            if known_in.contains(&m) {
                known.insert(name.to_string(), id);
            }
            for (import, _) in self.modules[module].imports.iter().filter(|(_, imported)| **imported == m) {
                known.insert(format!("{import}.{name}"), id);
            }
        }
        let text = path.text();
        let message = match self.activity_named(module, path) {
            Some(activity) => format!("`{text}` is {}, no strategy", what(&activity.kind)),
            None => format!("there is no strategy `{text}`"),
        };
        let finding = Diagnostic::error(Code::RulesDerived, path.span, message);
        let last = path.parts.last().map_or("", |name| name.node.as_str());
        let elsewhere = known.keys().find(|known| known.ends_with(&format!(".{last}")));
        let finding = match (elsewhere, help(&text, known.keys().map(String::as_str))) {
            (Some(elsewhere), _) => finding.help(format!("did you mean `{elsewhere}`?")),
            (None, Some(help)) => finding.help(help),
            (None, None) => finding.help("`use` the module of the strategy, and write `= MODULE.STRATEGY with { … }`"),
        };
        let meant = elsewhere.map(String::as_str).or_else(|| nearest(&text, known.keys().map(String::as_str)));
        (finding, meant.and_then(|meant| known.get(meant)).copied())
    }

    fn activity_named(&self, module: usize, path: &Path) -> Option<&'m Activity> {
        let (m, name) = match path.parts.as_slice() {
            [name] => (module, name),
            [from, name] => (*self.modules[module].imports.get(&from.node)?, name),
            _ => return None,
        };
        self.modules[m].tree.items.iter().find_map(|item| match item {
            Item::Activity(activity) if activity.name.node == name.node => Some(activity),
            _ => None,
        })
    }
}

fn what(kind: &ActivityKind) -> &'static str {
    match kind {
        ActivityKind::Behavior => "a behavior",
        ActivityKind::Strategy { .. } => "a strategy",
        ActivityKind::Overlay { .. } => "an overlay",
        ActivityKind::Mission { .. } => "a mission",
    }
}

/// A strategy with all that it has of its base. A declaration of a name that the base has stands in the place of the base's, and what is written
/// before such ones, and is new, before the first of them; the rest of what is new comes after the base's declarations, and new behaviors after its behaviors. A table is
/// one: who writes a rule writes it whole, and behaviors of the base that it does not name are left out.
fn derive(base: &Activity, own: &Activity) -> Activity {
    let (mine, my_table): (Vec<&Clause>, Vec<&Clause>) =
        own.body.clauses.iter().partition(|clause| !is_of_table(clause));
    let (theirs, their_table): (Vec<&Clause>, Vec<&Clause>) =
        base.body.clauses.iter().partition(|clause| !is_of_table(clause));
    let named: Option<BTreeSet<&str>> =
        (!my_table.is_empty()).then(|| my_table.iter().flat_map(|clause| named_in_table(clause)).collect());
    let owned: Vec<&str> = mine.iter().flat_map(|clause| channels(clause)).collect();
    let recorded: Vec<&str> = mine.iter().flat_map(|clause| recorded(clause)).collect();
    let mut places: BTreeMap<(&str, bool), usize> = BTreeMap::new();
    for (at, clause) in theirs.iter().enumerate() {
        places.extend(subject(clause).map(|subject| (subject, at)));
    }
    let (mut new, mut new_behaviors) = (Vec::new(), Vec::new());
    let mut before: Vec<Vec<&Clause>> = vec![Vec::new(); theirs.len()];
    let mut instead: Vec<Option<&Clause>> = vec![None; theirs.len()];
    // The first place of what follows on a clause, of declarations and of behaviors.
    let mut next: [Option<usize>; 2] = [None, None];
    for clause in mine.into_iter().rev() {
        let next = &mut next[usize::from(is_behavior(clause))];
        match (subject(clause).and_then(|subject| places.remove(&subject)), *next) {
            (Some(at), following) => {
                instead[at] = Some(clause);
                *next = Some(following.map_or(at, |following| following.min(at)));
            }
            (None, Some(following)) => before[following].insert(0, clause),
            (None, None) if is_behavior(clause) => new_behaviors.insert(0, clause),
            (None, None) => new.insert(0, clause),
        }
    }
    let mut clauses: Vec<Clause> = Vec::with_capacity(base.body.clauses.len() + own.body.clauses.len());
    for ((their, before), instead) in theirs.into_iter().zip(before).zip(instead) {
        if is_behavior(their) {
            clauses.extend(new.drain(..).cloned());
        }
        clauses.extend(before.into_iter().cloned());
        match instead {
            Some(mine) => clauses.push(mine.clone()),
            None if is_left_out(their, named.as_ref()) => {}
            None => clauses.extend(without(their, &owned, &recorded)),
        }
    }
    clauses.extend(new.into_iter().chain(new_behaviors).cloned());
    clauses.extend(if my_table.is_empty() { their_table } else { my_table }.into_iter().cloned());
    Activity {
        kind: own.kind.clone(),
        name: own.name.clone(),
        params: params(base, own),
        result: own.result.clone().or_else(|| base.result.clone()),
        body: Block { clauses, span: own.body.span },
    }
}

/// The parameters of the base and its own. One of a name that the base has stands in the place of the base's: it has another default or range.
fn params(base: &Activity, own: &Activity) -> Vec<Param> {
    let mut params = base.params.clone();
    for (nth, param) in own.params.iter().enumerate() {
        let is_first = own.params[..nth].iter().all(|before| before.name.node != param.name.node);
        match base.params.iter().position(|theirs| theirs.name.node == param.name.node) {
            Some(at) if is_first => params[at] = param.clone(),
            _ => params.push(param.clone()),
        }
    }
    params
}

/// `start` and the rules.
fn is_of_table(clause: &Clause) -> bool {
    matches!(clause.kind, ClauseKind::Start(_) | ClauseKind::Rule(_))
}

fn is_behavior(clause: &Clause) -> bool {
    matches!(clause.kind, ClauseKind::Behavior(_))
}

/// The behaviors that a clause of a table names.
fn named_in_table(clause: &Clause) -> Vec<&str> {
    match &clause.kind {
        ClauseKind::Start(name) => vec![&name.node],
        ClauseKind::Rule(rule) => {
            let target = if let Target::Behavior(name) = &rule.target { Some(name) } else { None };
            rule.sources.iter().chain(target).map(|name| name.node.as_str()).collect()
        }
        _ => Vec::new(),
    }
}

/// Whether a clause is a behavior that a table does not name.
fn is_left_out(clause: &Clause, named: Option<&BTreeSet<&str>>) -> bool {
    match &clause.kind {
        ClauseKind::Behavior(behavior) => named.is_some_and(|named| !named.contains(behavior.name.node.as_str())),
        _ => false,
    }
}

/// What a clause declares, and whether that is a behavior: a signal may have the name of one.
fn subject(clause: &Clause) -> Option<(&str, bool)> {
    match &clause.kind {
        ClauseKind::Signal { name, .. } | ClauseKind::Memory { name, .. } => Some((&name.node, false)),
        ClauseKind::Behavior(behavior) => Some((&behavior.name.node, true)),
        _ => None,
    }
}

/// The axes on which a `with` holds a channel.
fn channels(clause: &Clause) -> Vec<&'static str> {
    match &clause.kind {
        ClauseKind::With(items) => items.iter().filter_map(axis).collect(),
        _ => Vec::new(),
    }
}

fn axis(item: &WithItem) -> Option<&'static str> {
    match item {
        WithItem::Setpoint(setpoint) => Some(Channel::named(&setpoint.channel.node)?.row().axis.name()),
        WithItem::Overlay(_) => None,
    }
}

/// The inputs that a clause records.
fn recorded(clause: &Clause) -> Vec<&str> {
    match &clause.kind {
        ClauseKind::Recording { inputs, .. } => inputs.iter().map(|input| input.node.as_str()).collect(),
        _ => Vec::new(),
    }
}

/// A clause but for what others say: a `with` keeps what is not on the axes that they hold, a `record` what they do not record.
fn without(clause: &Clause, held: &[&str], recorded: &[&str]) -> Option<Clause> {
    match &clause.kind {
        ClauseKind::With(items) => {
            let left: Vec<WithItem> =
                items.iter().filter(|item| axis(item).is_none_or(|axis| !held.contains(&axis))).cloned().collect();
            (!left.is_empty()).then_some(Clause { kind: ClauseKind::With(left), span: clause.span })
        }
        ClauseKind::Recording { inputs, rate } => {
            let left = inputs.iter().filter(|input| !recorded.contains(&input.node.as_str()));
            let (inputs, rate): (Vec<_>, _) = (left.cloned().collect(), rate.clone());
            (!inputs.is_empty()).then_some(Clause { kind: ClauseKind::Recording { inputs, rate }, span: clause.span })
        }
        _ => Some(clause.clone()),
    }
}

/// A strategy that is derived, while it is checked.
pub(super) struct Derived {
    /// Where it stands itself.
    own: Span,
    /// Where it names its base.
    base: Span,
    /// The modules in which its parts stand: a name of any of them cannot be declared in it.
    pub homes: Vec<usize>,
}

impl<'t> Checker<'t> {
    /// A strategy that has parts of another, and what it is derived from.
    pub(super) fn derived(&mut self, a: &Activity) -> Option<Derived> {
        let ActivityKind::Strategy { base: Some(base) } = &a.kind else { return None };
        let parts = a.body.clauses.iter().map(|clause| clause.span).chain(a.params.iter().map(|param| param.name.span));
        let homes: BTreeSet<usize> = parts.filter_map(|part| self.homes.get(&part.file)).copied().collect();
        let own = a.name.span.to(a.body.span);
        self.derived_strategies.insert(a.name.span, (own, base.span));
        Some(Derived { own, base: base.span, homes: homes.into_iter().collect() })
    }

    /// The module in which a part of a declaration of a module stands.
    pub(super) fn home(&self, part: Span, module: usize) -> usize {
        self.homes.get(&part.file).copied().unwrap_or(module)
    }

    /// Works on a part of an activity. One that a strategy has of its base is looked at where it stands: names are those of that module, and what is
    /// wrong only here is told where the base is named.
    pub(super) fn in_part<T>(&mut self, part: Span, work: impl FnOnce(&mut Self) -> T) -> T {
        let Some(base) = self.scope.derived.as_ref().filter(|derived| !derived.own.holds(part)).map(|d| d.base) else {
            return work(self);
        };
        let home = self.home(part, self.scope.module);
        let outer = std::mem::replace(&mut self.scope.module, home);
        let (before, was_inherited) = (self.findings.len(), self.names_used.inherit(true));
        let result = work(self);
        self.names_used.inherit(was_inherited);
        self.scope.module = outer;
        self.inherited_findings.extend(self.findings.drain(before..).map(|finding| (finding, base, OF_BASE)));
        result
    }

    /// Works on a strategy as a whole, by the place of its name: what is wrong with parts of its base is told where that is named.
    pub(super) fn in_strategy(&mut self, name: Span, work: impl FnOnce(&mut Self)) {
        let before = self.findings.len();
        work(self);
        let Some(&(own, base)) = self.derived_strategies.get(&name) else { return };
        let found: Vec<Diagnostic> = self.findings.drain(before..).collect();
        for finding in found {
            match own.holds(finding.span()) {
                true => self.findings.push(finding),
                false => self.inherited_findings.push((finding, base, OF_BASE)),
            }
        }
    }

    /// Tells what is wrong with what was declared elsewhere only as it is used here, unless that has been told the same.
    pub(super) fn tell_inherited(&mut self) {
        let told: BTreeSet<(Span, &str)> = self.findings.iter().map(|f| (f.span(), f.message.as_str())).collect();
        let inherited = std::mem::take(&mut self.inherited_findings);
        let new = inherited.into_iter().filter(|(finding, ..)| !told.contains(&(finding.span(), &finding.message)));
        let new: Vec<Diagnostic> = new.map(|(finding, place, with)| told_at(finding, place, with)).collect();
        self.findings.extend(new);
    }
}

/// A finding of a part of something declared elsewhere, told where that is named.
fn told_at(mut finding: Diagnostic, place: Span, with: &str) -> Diagnostic {
    if let Some((_, said)) = finding.labels.first_mut().filter(|(_, said)| said.is_empty()) {
        *said = "in this part of it".to_string();
    }
    finding.labels.insert(0, (place, with.to_string()));
    finding
}
