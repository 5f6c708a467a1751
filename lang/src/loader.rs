//! Reads a script and the modules that it imports, each once.

use crate::Library;
use crate::check::Module;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::prelude::ReadSource;
use crate::source::{Source, Sources};
use crate::syntax::Unread;
use crate::syntax::tree::{self, Item};
use std::collections::BTreeMap;

/// A script imports this many modules at most, all in all.
const MODULES_MAX: usize = 256;

/// Reads modules, each once.
pub struct Loader<'a> {
    pub library: &'a dyn Library,
    pub sources: Sources,
    pub modules: Vec<Module>,
    pub known: BTreeMap<String, usize>,
    pub findings: Vec<Diagnostic>,
    /// What could not be read, in all of them.
    pub unread: Vec<Unread>,
}

impl<'a> Loader<'a> {
    pub fn new(library: &'a dyn Library) -> Self {
        let (sources, modules, known) = (Sources::default(), Vec::new(), BTreeMap::new());
        Loader { library, sources, modules, known, findings: Vec::new(), unread: Vec::new() }
    }

    /// Reads a script, all it imports, and what every script knows.
    pub fn read_all(&mut self, entry: Source) {
        let prelude = self.library.prelude();
        // A file of the prelude is checked as what it is: what it declares is known everywhere.
        let is_prelude = prelude.modules().any(|module| module.source.name == entry.name);
        let entry = self.read(entry);
        // Their ids are those with which they were read.
        for module in prelude.modules() {
            self.sources.reserve(module.source.clone());
        }
        self.take(entry, String::new(), is_prelude, &mut Vec::new());
        for module in prelude.modules() {
            if !self.known.contains_key(&*module.source.name) {
                self.take(module.clone(), module_name(&module.source.name), true, &mut Vec::new());
            }
        }
    }

    /// Reads a source as one more file.
    pub fn read(&mut self, source: Source) -> ReadSource {
        let file = self.sources.reserve(source.clone());
        ReadSource::new(file, source)
    }

    /// Takes what was read as a module, and all it imports.
    pub fn take(&mut self, read: ReadSource, name: String, prelude: bool, path: &mut Vec<String>) -> usize {
        let ReadSource { file, source, tree, findings, unread } = read;
        self.sources.list(file);
        let index = self.modules.len();
        self.known.insert(source.name.to_string(), index);
        self.findings.extend(findings);
        self.unread.extend(unread);
        path.push(source.name.to_string());
        let uses: Vec<tree::Path> = tree
            .items
            .iter()
            .filter_map(|item| if let Item::Use(paths) = item { Some(paths.clone()) } else { None })
            .flatten()
            .collect();
        self.modules.push(Module { name, tree, prelude, ..Module::default() });
        for wanted in uses {
            if let Some(imported) = self.import(&source, &wanted, path) {
                let name = wanted.parts.last().map(|p| p.node.clone()).unwrap_or_default();
                let earlier = self.modules[index].imports.insert(name.clone(), imported);
                if earlier.is_some_and(|earlier| earlier != imported) {
                    let message = format!("two modules would be called `{name}` here");
                    let finding = Diagnostic::error(Code::ImportsTwice, wanted.span, message);
                    self.findings.push(finding.help("give one of the files another name"));
                }
            }
        }
        path.pop();
        index
    }

    fn import(&mut self, importer: &Source, wanted: &tree::Path, path: &mut Vec<String>) -> Option<usize> {
        let parts: Vec<String> = wanted.parts.iter().map(|p| p.node.clone()).collect();
        let source = match self.library.module(importer, &parts) {
            Ok(source) => source,
            Err(help) => {
                let message = format!("there is no module `{}`", wanted.text());
                self.findings.push(Diagnostic::error(Code::ImportsUnknown, wanted.span, message).help(help));
                self.unread.push(Unread { span: wanted.span, item: None });
                return None;
            }
        };
        if let Some(start) = path.iter().position(|p| *p == *source.name) {
            let mut chain: Vec<&str> = path[start..].iter().map(String::as_str).collect();
            chain.push(&source.name);
            let message = format!("this import leads back to its beginning: {}", chain.join(" -> "));
            self.findings.push(
                Diagnostic::error(Code::ImportsCycle, wanted.span, message)
                    .help("move what both need into a module that neither of them imports from"),
            );
            self.unread.push(Unread { span: wanted.span, item: None });
            return None;
        }
        if let Some(&index) = self.known.get(&*source.name) {
            return Some(index);
        }
        if self.modules.len() >= MODULES_MAX {
            let message = format!("more than {MODULES_MAX} modules are imported");
            let finding = Diagnostic::error(Code::ImportsMany, wanted.span, message);
            self.findings.push(finding.help("declare in one module what several of them hold"));
            self.unread.push(Unread { span: wanted.span, item: None });
            return None;
        }
        let name = parts.last().cloned().unwrap_or_default();
        // Who imports what every script knows has it once.
        let prelude = self.library.prelude().module(&source).cloned();
        let is_prelude = prelude.is_some();
        let read = prelude.unwrap_or_else(|| self.read(source));
        Some(self.take(read, name, is_prelude, path))
    }
}

/// What a module of a file is called: the file's name without its folders.
pub fn module_name(file: &str) -> String {
    let stem = file.rsplit(['/', '\\', ':']).next().unwrap_or(file);
    stem.trim_end_matches(".alb").trim_end_matches('>').to_string()
}
