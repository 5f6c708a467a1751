//! What the names of a script stand for: where each is declared, and where it is used.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_lang::source::FileId;
use albacore_lang::syntax::parse;
use albacore_session::{Files, Script, Source};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn load(path: &Path) -> Script {
    let name = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap_or(path).display().to_string();
    let source = Source { name: name.into(), text: std::fs::read_to_string(path).unwrap().into() };
    albacore_lang::load(source, &Files::around(path), None, &[])
}

#[test]
fn names_are_found_where_they_are_declared_and_used() {
    insta::glob!("names/*.alb", |path| {
        let script = load(path);
        let at = |span| {
            let (line, column) = script.sources.line_column(span);
            format!("{line}:{column}")
        };
        let own = script.names().definitions().filter(|(place, _)| place.file == FileId(0));
        let lines = own.map(|(place, definition)| {
            let uses: Vec<String> = script.names().uses_of(place).map(at).collect();
            format!("{:>5} {} `{}`: {}\n", at(place), definition.what, definition.name, uses.join(", "))
        });
        insta::assert_snapshot!(lines.collect::<String>());
    });
}

/// The names that nothing declares are those that the language knows: functions, types, members, labels of statements.
#[test]
fn only_names_of_the_language_are_declared_nowhere() {
    let folders = ["stdlib", "missions", "tests/rules", "tests/names"];
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
    let scripts: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "alb")).collect();
    let mut undeclared = BTreeSet::new();
    for path in scripts {
        let script = load(&path);
        if !script.is_sound() {
            continue;
        }
        let text = script.sources.get(FileId(0)).text.clone();
        let names = parse(FileId(0), &text).concrete.names().collect::<Vec<_>>();
        let without = names.into_iter().filter(|place| script.names().declared_at(*place).is_none());
        undeclared.extend(without.map(|place| script.sources.text(place).to_string()));
    }
    insta::assert_snapshot!(undeclared.into_iter().collect::<Vec<_>>().join("\n"));
}
