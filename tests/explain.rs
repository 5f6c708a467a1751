//! Every code has its page, each page a wrong example that gives its code and a mended one, and each code is shown by
//! a message that somebody has read.

#![expect(clippy::unwrap_used, reason = "a test that cannot read its pages or start the binary has failed")]

use crate::examples::{OF_A_FRAGMENT, examples};
use albacore_session::Code;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// A page is read between two waves.
const PAGE_LINES_MAX: usize = 40;
const PAGE_COLUMNS_MAX: usize = 80;

/// What no single script can show: several files, the command line, the prompt, or a script longer than a page.
const IN_WORDS: [&str; 17] = [
    "areas::file",
    "areas::swapped",
    "imports::cycle",
    "imports::many",
    "imports::twice",
    "limits::calls",
    "limits::capacities",
    "limits::instructions",
    "limits::missions",
    "limits::rules",
    "prompt::misplaced",
    "prompt::value",
    "set::form",
    "set::given",
    "set::unknown",
    "set::unreached",
    "syntax::nesting",
];

fn page_of(code: Code) -> String {
    format!("docs/explain/{}.md", code.name().replace("::", "/"))
}

/// All files below a folder.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path.to_str().unwrap().replace('\\', "/"));
        }
    }
    found
}

#[test]
fn codes_are_in_order_and_each_is_known_by_its_name() {
    assert!(Code::ALL.is_sorted_by_key(|code| code.name()), "a list is read in order");
    assert!(Code::ALL.iter().all(|code| Code::named(code.name()) == Some(*code)));
}

/// That each code has a page the compiler sees to.
#[test]
fn every_page_has_its_code() {
    let pages: BTreeSet<String> = files(Path::new("docs/explain")).into_iter().collect();
    let codes: BTreeSet<String> = Code::ALL.iter().map(|code| page_of(*code)).collect();
    assert_eq!(pages, codes);
}

#[test]
fn pages_are_short_and_have_a_title() {
    for code in Code::ALL {
        let lines: Vec<&str> = code.page().lines().collect();
        assert!(lines[0].starts_with("# ") && lines[1].is_empty(), "{code}: the title comes first");
        assert!(lines.len() <= PAGE_LINES_MAX, "{code}: {} lines", lines.len());
        let mut in_example = false;
        for line in lines {
            in_example ^= line.starts_with("```");
            assert!(in_example || line.chars().count() <= PAGE_COLUMNS_MAX, "{code}: too wide: {line}");
        }
    }
}

/// The first example of a page gives its code and no other, the second nothing at all.
#[test]
fn the_examples_of_the_pages_are_checked() {
    let mut wrong = Vec::new();
    for code in Code::ALL {
        let examples = examples(&page_of(*code));
        if examples.is_empty() && IN_WORDS.contains(&code.name()) {
            continue;
        }
        let [bad, mended] = examples.as_slice() else {
            wrong.push(format!("{code}: a wrong example and a mended one are wanted"));
            continue;
        };
        let is_marked = bad.marks.last().is_some_and(|mark| mark == "wrong");
        let own = |(found, _): &(&str, String)| *found == code.name() || !OF_A_FRAGMENT.contains(found);
        let mut found = bad.findings();
        found.retain(own);
        if !is_marked || found.is_empty() || found.iter().any(|(found, _)| *found != code.name()) {
            wrong.push(format!("{}: {found:#?}", bad.place));
        }
        let mut found = mended.findings();
        found.retain(own);
        if !found.is_empty() {
            wrong.push(format!("{}: {found:#?}", mended.place));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_code_is_shown_in_a_snapshot() {
    let snapshots: Vec<String> =
        files(Path::new("tests/snapshots")).iter().map(|path| std::fs::read_to_string(path).unwrap()).collect();
    let shown: BTreeSet<&str> = snapshots.iter().flat_map(|text| text.lines()).map(str::trim).collect();
    let missing: Vec<&str> = Code::ALL.iter().map(|code| code.name()).filter(|name| !shown.contains(name)).collect();
    assert!(missing.is_empty(), "write a script for each in tests/diagnostics: {missing:?}");
}

/// Between a code and the next there is a place in a file.
#[test]
fn every_message_has_a_place() {
    for path in files(Path::new("tests/snapshots")).iter().filter(|path| path.contains("/diagnostics__")) {
        let text = std::fs::read_to_string(path).unwrap();
        let mut has_place = true;
        for line in text.lines().skip(4) {
            let is_code = Code::named(line.trim()).is_some();
            assert!(!is_code || has_place, "{path}: the message before `{line}` has no place");
            has_place = !is_code && (has_place || line.contains(".alb:"));
        }
        assert!(has_place, "{path}: the last message has no place");
    }
}

/// What `albacore explain` says, and how it ends.
fn explain(args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_albacore")).arg("explain").args(args).output().unwrap();
    let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    format!("{said}ends with {:?}\n", output.status.code())
}

#[test]
fn all_codes_are_listed() {
    let said = explain(&[]);
    for code in Code::ALL {
        assert!(said.lines().any(|line| line.starts_with(&format!("{code} "))), "{code} is not listed");
    }
}

#[test]
fn a_code_is_explained_a_group_listed_and_an_unknown_one_told() {
    let asked = ["units::unknown", "units", "unit::unknown", "endless", "nothing::such"];
    let said: Vec<String> = asked.iter().map(|name| format!("> explain {name}\n{}", explain(&[name]))).collect();
    insta::assert_snapshot!(said.join("\n"));
}
