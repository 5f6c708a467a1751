//! What a file's declarations may not hide: the values, units, types and functions that every script knows. A script that
//! gives `north` or `m` another meaning reads like any other, and leads somewhere else.

use super::args::BUILTINS;
use super::type_syntax::is_type;
use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension;
use crate::syntax::tree::{Item, Name};

impl<'t> Checker<'t> {
    /// Looks at the declarations of all modules but those whose names everyone knows.
    pub(super) fn nothing_is_hidden(&mut self) {
        for module in self.modules.iter().filter(|m| !m.prelude) {
            for item in &module.tree.items {
                self.hides_nothing(item);
            }
        }
    }

    fn hides_nothing(&mut self, item: &Item) {
        match item {
            Item::Const(c) => self.hides_no_value(&c.name),
            Item::Input { name, .. } | Item::Signal { name, .. } | Item::Payload { name, .. } => {
                self.hides_no_value(name)
            }
            Item::Enum { name, variants } => {
                self.hides_no_type(name);
                variants.iter().for_each(|variant| self.hides_no_value(variant));
            }
            Item::Record { name, .. } => {
                self.hides_no_type(name);
                self.hides_no_function(name);
            }
            Item::Unit { name, .. } => {
                self.hides_no_value(name);
                if dimension::unit(&name.node, &|_| None).is_some() {
                    self.hidden(name, "a unit");
                }
            }
            Item::Fn(f) => self.hides_no_function(&f.name),
            // A behavior is called as a statement and a function is a value: `round(area)` and `round(2.5)` differ in sight.
            Item::Use(_) | Item::Activity(_) | Item::Clause { .. } | Item::Test(_) => {}
            Item::Scenario { .. } => {}
            Item::Vehicle { name, .. } => {
                if let Some(Def::Clause(_)) = self.lookup_if(0, &name.node, |def| matches!(def, Def::Clause(_))) {
                    self.hidden(name, "a clause of scenarios");
                }
            }
        }
    }

    fn hides_no_value(&mut self, name: &Name) {
        let preludes = self.preludes_with.get(&name.node).into_iter().flatten();
        let known = preludes.filter_map(|&m| self.names[m].get(&name.node)).find_map(|def| match def {
            Def::Const(_) | Def::Variant(..) | Def::Unit(_) | Def::Input(_) | Def::Signal(_) => Some(def.what()),
            _ => None,
        });
        if let Some(what) = known {
            self.hidden(name, what);
        }
    }

    fn hides_no_type(&mut self, name: &Name) {
        if is_type(&name.node) {
            self.hidden(name, "a type");
        }
    }

    fn hides_no_function(&mut self, name: &Name) {
        if BUILTINS.contains(&name.node.as_str()) {
            self.hidden(name, "a function");
        }
    }

    fn hidden(&mut self, name: &Name, what: &str) {
        self.report(
            Diagnostic::error(
                Code::NamesShadowed,
                name.span,
                format!("`{}` is the name of {what} that every script knows", name.node),
            )
            .here("nothing can be shadowed")
            .help("choose another name"),
        );
    }
}
