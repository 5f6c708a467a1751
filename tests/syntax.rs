//! Broken scripts: whatever is cut off or left out, checking says something and never panics.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Files, Script, Source};
use std::path::{Path, PathBuf};

/// Scripts up to this size lose each of their tokens in turn; longer ones are only cut off.
const DELETED_BYTES_MAX: usize = 2_000;

fn scripts() -> Vec<PathBuf> {
    let mut scripts: Vec<PathBuf> = ["stdlib", "missions", "tests/rules", "tests/diagnostics"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "alb"))
        .collect();
    scripts.sort();
    assert!(scripts.len() > 30);
    scripts
}

/// Where tokens begin and end: words, and every other character by itself.
fn tokens(text: &str) -> Vec<(usize, usize)> {
    let mut tokens: Vec<(usize, usize)> = Vec::new();
    let mut in_word = false;
    for (at, c) in text.char_indices() {
        let word = c.is_alphanumeric() || c == '_';
        if c.is_whitespace() {
            in_word = false;
        } else if let (true, true, Some(last)) = (word, in_word, tokens.last_mut()) {
            last.1 = at + c.len_utf8();
        } else {
            tokens.push((at, at + c.len_utf8()));
            in_word = word;
        }
    }
    tokens
}

/// Checks a text as if it stood in a file, and lowers its missions when it is sound.
fn check(path: &Path, text: &str) -> Script {
    let source = Source { name: path.display().to_string().into(), text: text.into() };
    let script = albacore_lang::load(source, &Files::around(path), None, &[]);
    if script.is_sound() {
        let names: Vec<String> = script.missions().map(|m| m.name.clone()).collect();
        names.iter().for_each(|name| drop(script.mission(name)));
    }
    script
}

#[test]
fn scripts_cut_off_at_each_token_are_checked() {
    for path in scripts() {
        let text = std::fs::read_to_string(&path).unwrap();
        for (_, end) in tokens(&text) {
            check(&path, &text[..end]);
        }
    }
}

#[test]
fn scripts_without_one_of_their_tokens_are_checked() {
    for path in scripts() {
        let text = std::fs::read_to_string(&path).unwrap();
        if text.len() > DELETED_BYTES_MAX {
            continue;
        }
        for (start, end) in tokens(&text) {
            let without = format!("{}{}", &text[..start], &text[end..]);
            check(&path, &without);
        }
    }
}
