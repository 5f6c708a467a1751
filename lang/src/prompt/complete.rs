//! What can stand at a place of a line that is being typed.

use super::{Named, Prompt, VALUE, instant};
use crate::check::member_names;
use crate::source::Source;
use crate::syntax::{self, tree};
use crate::{Library, dimension};

/// What every input has after a dot.
const INPUT_PARTS: [&str; 2] = ["age", "peak"];

impl Prompt {
    /// The names that stand alone: what is declared in the script and by lines, the modules that are imported, what every script
    /// knows, and the words of the language.
    pub fn names(&self) -> Vec<String> {
        let (top, module) = self.top();
        let own = std::iter::successors(Some(top), |&m| self.modules[m].extends);
        let known = own.chain((0..self.modules.len()).filter(|&m| self.modules[m].prelude));
        let declared = known.flat_map(|m| self.modules[m].tree.items.iter().flat_map(super::declared));
        let modules = module.imports.keys().cloned();
        let words = syntax::words::every().map(String::from);
        declared.chain(modules).chain(words).filter(|name| !name.contains(' ')).collect()
    }

    /// The units that every script knows, and those of the script.
    pub fn units(&self) -> Vec<String> {
        let own = self.modules.iter().flat_map(|module| &module.tree.items).filter_map(|item| match item {
            tree::Item::Unit { name, .. } => Some(name.node.clone()),
            _ => None,
        });
        dimension::UNITS.iter().map(|(unit, ..)| (*unit).to_string()).chain(own).collect()
    }

    /// What stands after the dot behind a name, or behind an expression that is made of names and dots.
    pub fn members(&mut self, library: &dyn Library, base: &str, known: &[Named]) -> Vec<String> {
        if let Some(module) = self.top().1.imports.get(base) {
            return self.modules[*module].tree.items.iter().flat_map(super::declared).collect();
        }
        // What is only looked at is no line of the session.
        let sources = self.sources.clone();
        let file = self.sources.add(Source { name: "<completion>".into(), text: base.into() });
        let (block, findings) = syntax::parse_lines(file, base);
        let mut names = Vec::new();
        if let ([tree::Clause { kind: tree::ClauseKind::Timed(timed), span }], true) =
            (block.clauses.as_slice(), findings.is_empty())
            && let tree::Action::Expr(e) = &timed.action
        {
            let name = tree::Name { node: VALUE.to_string(), span: *span };
            let kind = tree::ClauseKind::Let { name, ty: None, value: instant(e.clone()) };
            let clause = tree::Clause { kind, span: *span };
            if let Ok(checked) = self.checked(library, vec![clause], block.span, known) {
                let vars = &checked.hir.activities[checked.mission].vars;
                let value = vars.iter().rfind(|var| var.name == VALUE);
                names.extend(value.into_iter().flat_map(|var| member_names(&checked.types, &var.ty)));
                if let Some(input) = checked.hir.inputs.iter().find(|input| input.name == base) {
                    names.extend(input.fields.iter().map(|(name, _)| name.clone()));
                    names.extend(INPUT_PARTS.map(String::from));
                }
            }
        }
        self.sources = sources;
        names
    }

    /// The parameters of what a name or a path calls.
    pub fn parameters(&self, callee: &str) -> Vec<String> {
        let (top, module) = self.top();
        let (modules, name): (Vec<usize>, &str) = match callee.rsplit_once('.') {
            Some((path, name)) => (module.imports.get(path).copied().into_iter().collect(), name),
            None => {
                let own = std::iter::successors(Some(top), |&m| self.modules[m].extends);
                (own.chain((0..self.modules.len()).filter(|&m| self.modules[m].prelude)).collect(), callee)
            }
        };
        let items = modules.into_iter().flat_map(|m| self.modules[m].tree.items.iter());
        let params = items.filter_map(|item| match item {
            tree::Item::Activity(activity) if activity.name.node == name => Some(&activity.params),
            tree::Item::Fn(function) if function.name.node == name => Some(&function.params),
            tree::Item::Scenario { name: given, params, .. } if given.node == name => Some(params),
            _ => None,
        });
        params.flatten().map(|param| param.name.node.clone()).collect()
    }
}
