//! What every script knows, read once for all of them.

use crate::ENTRY;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Source};
use crate::syntax::{self, Unread, tree};
use std::sync::Arc;

/// The modules whose names every script knows. In each script their files follow the script's own, so that the places in
/// them are the same whatever it imports.
#[derive(Clone, Debug)]
pub struct Prelude {
    modules: Vec<ReadSource>,
}

/// A source file that was read.
#[derive(Clone, Debug)]
pub(crate) struct ReadSource {
    /// Its place among the sources.
    pub file: FileId,
    pub source: Source,
    /// What it says.
    pub tree: Arc<tree::File>,
    /// All of it that could not be read.
    pub findings: Vec<Diagnostic>,
    /// Where that stands.
    pub unread: Vec<Unread>,
}

impl Prelude {
    /// Reads the modules: for as many scripts as there are.
    pub fn read(sources: Vec<Source>) -> Self {
        let files = (ENTRY.0 + 1..).map(FileId);
        Prelude { modules: files.zip(sources).map(|(file, source)| ReadSource::new(file, source)).collect() }
    }

    pub(crate) fn modules(&self) -> impl Iterator<Item = &ReadSource> {
        self.modules.iter()
    }

    /// The module that a source is, unless it only has its name.
    pub(crate) fn module(&self, source: &Source) -> Option<&ReadSource> {
        self.modules.iter().find(|module| module.source.name == source.name && module.source.text == source.text)
    }
}

impl ReadSource {
    pub fn new(file: FileId, source: Source) -> Self {
        let parsed = syntax::parse(file, &source.text);
        ReadSource { file, source, tree: parsed.file.into(), findings: parsed.findings, unread: parsed.unread }
    }
}
