//! What reading and checking a script costs: `cargo bench --bench check`.

use albacore_grammar::{Grammar, Rule};
use albacore_lang::load;
use albacore_session::{Files, Source};
use divan::Bencher;
use pest::Parser;
use std::path::Path;

const CPT: &str = include_str!("../stdlib/cpt.alb");
const LINES: usize = 10_000;
/// What `cpt.alb` declares, and so what each copy of its declarations must name anew.
const NAMES: [&str; 4] = ["cpt_2005", "trace_plume", "side_of", "Source"];

fn main() {
    divan::main();
}

#[divan::bench]
fn cpt(bencher: Bencher) {
    check(bencher, CPT);
}

#[divan::bench]
fn ten_thousand_lines(bencher: Bencher) {
    check(bencher, &repeated());
}

/// The same text read by the grammar alone: `check` is held to four times that.
#[divan::bench]
fn ten_thousand_lines_by_the_grammar_alone(bencher: Bencher) {
    let prepared = albacore_lang::syntax::prepared(&repeated());
    assert!(Grammar::parse(Rule::file, &prepared).is_ok(), "the script has errors");
    bencher.bench(|| Grammar::parse(Rule::file, &prepared).map(Iterator::count));
}

/// As `albacore check` does, all imports included, without the terminal.
fn check(bencher: Bencher, text: &str) {
    let source = Source { name: "stdlib/cpt.alb".into(), text: text.into() };
    let files = Files::around(Path::new("stdlib/cpt.alb"));
    assert!(load(source.clone(), &files, None, &[]).is_sound(), "the script has errors");
    bencher.bench(|| load(source.clone(), &files, None, &[]));
}

/// The declarations of `cpt.alb` again and again, under other names each time.
fn repeated() -> String {
    let begin = CPT.find("\nrecord ").unwrap_or(0);
    let begin = CPT[..begin].rfind("\n///").unwrap_or(begin);
    let (head, declarations) = CPT.split_at(begin);
    let mut text = head.to_string();
    for copy in 0.. {
        if text.lines().count() >= LINES {
            break;
        }
        text +=
            &NAMES.iter().fold(declarations.to_string(), |part, name| part.replace(name, &format!("{name}_{copy}")));
    }
    text
}
