//! Files and functions of this repository that a person can take in: none is longer than a page or two.

#![expect(clippy::unwrap_used, reason = "a test that cannot read the repository has failed")]

use std::path::PathBuf;

/// Lines of a file.
const FILE_MAX: usize = 500;
/// Lines of a function, its head and its last brace among them.
const FUNCTION_MAX: usize = 80;

/// Every file of Rust in the workspace.
fn files() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = ["src", "lang", "runtime", "tests", "benches"].map(PathBuf::from).into();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The name of the function whose head begins on a line.
fn head(line: &str) -> Option<&str> {
    let words = line.trim_start();
    let (before, after) = words.strip_prefix("fn ").map(|after| ("", after)).or_else(|| words.split_once(" fn "))?;
    let is_head = before.split([' ', '(', ')']).all(|word| {
        matches!(word, "" | "pub" | "crate" | "super" | "in" | "const" | "async" | "unsafe") || word.contains("::")
    });
    is_head.then(|| after.split(['(', '<']).next().unwrap_or(after))
}

/// Where a function ends whose head begins on a line, by its margin: the layout of all files is that of `cargo fmt`.
fn end(lines: &[&str], head: usize) -> usize {
    let margin = &lines[head][..lines[head].len() - lines[head].trim_start().len()];
    let closes = |line: &&str| line.strip_prefix(margin).is_some_and(|rest| rest.starts_with('}'));
    let declared =
        |line: &&str| line.strip_prefix(margin).is_some_and(|rest| !rest.starts_with(' ') && rest.ends_with(';'));
    match lines[head].ends_with([';', '}']) {
        true => head,
        false => (head + 1..lines.len()).find(|&i| closes(&lines[i]) || declared(&lines[i])).unwrap_or(head),
    }
}

#[test]
fn files_and_functions_can_be_taken_in() {
    let files = files();
    let (mut functions, mut long) = (0, Vec::new());
    for path in &files {
        let text = std::fs::read_to_string(path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        if lines.len() > FILE_MAX {
            long.push(format!("{}: {} lines", path.display(), lines.len()));
        }
        for (at, name) in lines.iter().enumerate().filter_map(|(at, line)| Some((at, head(line)?))) {
            functions += 1;
            let length = end(&lines, at) - at + 1;
            if length > FUNCTION_MAX {
                long.push(format!("{}:{}: `{name}` has {length} lines", path.display(), at + 1));
            }
        }
    }
    assert!(files.len() > 400 && functions > 4000, "{} files, {functions} functions", files.len());
    assert!(long.is_empty(), "at most {FILE_MAX} lines a file, {FUNCTION_MAX} a function:\n{}", long.join("\n"));
}
