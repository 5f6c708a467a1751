//! Broken scripts: whatever is cut off or left out, checking says something and never panics.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_lang::source::FileId;
use albacore_lang::syntax::parse;
use albacore_session::{Files, Script, Source};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// One token of so many.
const SAMPLED: usize = 293;

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

/// The concrete tree of a text: what stands in no leaf is blank, and no two leaves overlap.
fn assert_nothing_is_lost(name: &str, text: &str) {
    let mut at = 0;
    let is_blank = |text: &str| text.chars().all(|c| c.is_whitespace() || c == '\u{feff}');
    for leaf in parse(FileId(0), text).concrete.leaves() {
        let (start, end) = (leaf.start as usize, leaf.end as usize);
        assert!(at <= start && is_blank(&text[at..start]), "{name}, from byte {at} to {start}:\n{text}");
        at = end;
    }
    assert!(is_blank(&text[at..]), "{name}, from byte {at}:\n{text}");
}

#[test]
fn every_word_of_a_script_is_in_its_concrete_tree() {
    for path in scripts() {
        let (name, text) = (path.display().to_string(), std::fs::read_to_string(&path).unwrap());
        assert_nothing_is_lost(&name, &text);
        for (i, (start, end)) in tokens(&text).into_iter().enumerate() {
            if i.is_multiple_of(SAMPLED) {
                assert_nothing_is_lost(&name, &text[..end]);
                assert_nothing_is_lost(&name, &format!("{}{}", &text[..start], &text[end..]));
            }
        }
    }
    for text in
        ["\u{feff}// a\n/* b */ const c = 1 m /* d\ne */\n-- f", "goto (\n\n}", "mission é { \"", "a\rb // c\rd"]
    {
        assert_nothing_is_lost("a text", text);
    }
}

/// Scripts cut off after a token, and without it: of one token of so many, and with `SPOIL_ONE_OF=1` of every.
#[test]
fn scripts_cut_off_at_a_token_and_without_it_are_checked() {
    let one_of = std::env::var("SPOIL_ONE_OF").ok().and_then(|n| n.parse().ok()).unwrap_or(SAMPLED);
    let texts = scripts().into_iter().map(|path| (std::fs::read_to_string(&path).unwrap(), path));
    let texts: Vec<(String, PathBuf)> = texts.collect();
    let all: Vec<_> =
        texts.iter().flat_map(|(text, path)| tokens(text).into_iter().map(move |token| (path, text, token))).collect();
    let count = all.len();
    let sampled: Vec<_> = all.into_iter().skip(one_of - 1).step_by(one_of).collect();
    let share = sampled.len().div_ceil(std::thread::available_parallelism().unwrap().get());
    std::thread::scope(|scope| {
        for part in sampled.chunks(share) {
            scope.spawn(move || {
                for (path, text, (start, end)) in part {
                    check(path, &text[..*end]);
                    check(path, &format!("{}{}", &text[..*start], &text[*end..]));
                }
            });
        }
    });
    assert!(count > 10_000, "{count} tokens");
}

fn check_text(text: &str) -> Script {
    check(Path::new("made.alb"), text)
}

#[test]
fn ten_thousand_unknown_names_are_all_found() {
    let lines: String = (0..10_000).map(|i| format!("    let a{i} = nothing_{i} + 1\n")).collect();
    let script = check_text(&format!("mission m within 10 min {{\n{lines}}}\n"));
    let unknown = script.findings.iter().filter(|f| f.code.name() == "names::unknown").count();
    assert_eq!(unknown, 10_000);
}

/// Whatever nests without end is refused, with one error, before it reaches the end of a stack.
#[test]
fn nesting_without_end_is_refused() {
    let many = 30_000;
    let expression = |before: &str, inner: &str, after: &str| {
        format!("    let x = {}{inner}{}", before.repeat(many), after.repeat(many))
    };
    let wide = (0..60).fold("1".to_string(), |inner, _| format!("({inner}{})", " + 1".repeat(120)));
    let bodies = [
        format!("    let x = if true {{ 1 }}{} else {{ 0 }}", " else if true { 2 }".repeat(many)),
        format!("    if true {{ hold }}{}", "\n    else if true { hold }".repeat(many)),
        format!("    log \"{{{}1{}}}\"", "(".repeat(many), ")".repeat(many)),
        format!("    log \"{{if true {{ 1 }}{} else {{ 0 }}}}\"", " else if true { 2 }".repeat(many)),
        expression("(", "1", ")"),
        expression("not ", "true", ""),
        expression("", "position", ".north"),
        expression("", "position", "[0]"),
        expression("", "position", "(1)"),
        expression("", "1", " + 1"),
        format!("    let x = {wide}"),
        "    with depth 3 m\n".repeat(many),
    ];
    for body in bodies {
        let script = check_text(&format!("mission m within 10 min {{\n{body}\n}}\n"));
        let nesting = script.findings.iter().filter(|f| f.code.name() == "syntax::nesting").count();
        assert_eq!(nesting, 1, "{}…: {:?}", &body[..60], script.findings.first());
    }
}

/// What leads on from declaration to declaration without end is refused too, and so is what leads back.
#[test]
fn chains_without_end_are_refused() {
    let chain = |line: &dyn Fn(usize) -> String, end: &str| (0..3_000).map(line).collect::<String>() + end;
    let behaviors = chain(&|i| format!("behavior b{i} {{ b{}() }}\n", i + 1), "behavior b3000 { wait for 1 s }");
    let fns = chain(&|i| format!("fn f{i}(x: Int) -> Int {{ f{}(x) }}\n", i + 1), "fn f3000(x: Int) -> Int { x }");
    let consts = chain(&|i| format!("const A{i} = A{} + 1\n", i + 1), "const A3000 = 1");
    let ring = "const A = B\nconst B = A\n".to_string();
    let codes = ["limits::calls", "limits::calls", "limits::constants", "names::recursive"];
    for (text, code) in [behaviors, fns, consts, ring].iter().zip(codes) {
        let script = check_text(text);
        assert!(script.findings.iter().any(|f| f.code.name() == code), "{code}: {:?}", script.findings.first());
    }
}

/// A constant that holds another many times is refused before memory is full, and so is one that is read by many.
#[test]
fn constants_that_grow_with_each_level_are_refused() {
    let doubled = |i: usize| format!("const A{} = [A{i}, A{i}]\n", i + 1);
    let nested = "const A0 = [1, 2]\n".to_string() + &(0..20).map(doubled).collect::<String>();
    let list = |of: &str, count: usize| format!("[{}]", vec![of; count].join(", "));
    let wide = format!("const A = {}\nconst B = {}\n", list("1", 4_000), list("A", 10_000));
    for text in [nested, wide] {
        let script = check_text(&text);
        let codes: BTreeSet<&str> = script.findings.iter().map(|f| f.code.name()).collect();
        assert_eq!(codes, BTreeSet::from(["limits::constants"]), "{:?}", script.findings.first());
    }
    let long = check_text(&format!("const A = {}\nconst B = A\n", list("1.5 m", 1_000)));
    assert!(long.is_sound(), "{:?}", long.findings);
}

/// What is as deep as allowed is checked on the small stack of a test's thread.
#[test]
fn what_is_just_not_too_deep_is_checked() {
    let chain = " else if true { 2 }".repeat(60);
    let sum = "(".repeat(60) + "1" + &") + 1 + 1".repeat(60);
    for value in [format!("if true {{ 1 }}{chain} else {{ 0 }}"), sum, "1".to_string() + &" + 1".repeat(120)] {
        let script = check_text(&format!("fn f() -> Int {{\n    {value}\n}}\n"));
        assert!(script.is_sound(), "{:?}", script.findings);
    }
}
