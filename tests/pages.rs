//! Pages lead where they say: links to files and headings that are there, and paths of the tree that exist.

#![expect(clippy::unwrap_used, reason = "a test that cannot read the pages has failed")]

use std::path::{Path, PathBuf};

/// The folders whose paths a page may name.
const FOLDERS: [&str; 8] = ["benches/", "docs/", "lang/", "missions/", "runtime/", "src/", "stdlib/", "tests/"];

fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match path.extension() {
            _ if path.is_dir() => pages(&path, found),
            Some(ending) if ending == "md" => found.push(path),
            _ => {}
        }
    }
}

/// What stands between two signs on a line, again and again.
fn between<'a>(mut line: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    let mut found = Vec::new();
    while let Some((inside, rest)) = line.split_once(from).and_then(|(_, rest)| rest.split_once(to)) {
        found.push(inside);
        line = rest;
    }
    found
}

/// The anchor of a heading, as a reader of Markdown makes it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

fn has_heading(page: &Path, wanted: &str) -> bool {
    let text = std::fs::read_to_string(page).unwrap();
    let headings = text.lines().filter_map(|line| line.strip_prefix('#'));
    headings.map(|heading| anchor(heading.trim_start_matches('#'))).any(|heading| heading == wanted)
}

/// Whether a link of a page leads somewhere. What is on the web is not looked at.
fn leads(page: &Path, link: &str) -> bool {
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    let there = if file.is_empty() { page.to_path_buf() } else { page.parent().unwrap().join(file) };
    link.starts_with("http") || there.exists() && (heading.is_empty() || has_heading(&there, heading))
}

/// Whether a word in backquotes is a path of the tree, which then has to be there.
fn is_there(path: &str) -> bool {
    let is_path = FOLDERS.iter().any(|folder| path.starts_with(folder))
        && path.chars().all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c));
    !is_path || Path::new(path).exists()
}

#[test]
fn links_and_paths_lead_somewhere() {
    let mut all =
        vec![PathBuf::from("README.md"), PathBuf::from("CONTRIBUTING.md"), PathBuf::from("tests/rules/README.md")];
    pages(Path::new("docs"), &mut all);
    let (mut links, mut paths, mut wrong) = (0, 0, Vec::new());
    for page in &all {
        let text = std::fs::read_to_string(page).unwrap();
        for line in text.split("```").step_by(2).flat_map(str::lines) {
            let (linked, quoted) = (between(line, "](", ")"), between(line, "`", "`"));
            links += linked.len();
            paths += quoted.iter().filter(|word| FOLDERS.iter().any(|folder| word.starts_with(folder))).count();
            let lost = linked.into_iter().filter(|link| !leads(page, link));
            let lost = lost.chain(quoted.into_iter().filter(|path| !is_there(path)));
            wrong.extend(lost.map(|what| format!("{}: {what}", page.display())));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(links > 400 && paths > 90, "{links} links, {paths} paths");
}
