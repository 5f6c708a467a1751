//! What scripts do, and the verbs that read them: one binary, which links in the time of one. `cargo test --test scripts rules::` runs a
//! part of it.

mod aground;
mod areas;
mod by_hand;
mod completions;
mod cost;
mod diagnostics;
mod doc;
mod duck;
mod explain;
mod faults;
mod fmt;
mod graph;
mod imports;
mod lag;
mod mixups;
mod new;
mod reference;
mod repl;
mod resilience;
mod rules;
mod runs;
mod scenario;
mod set;
mod syntax;
mod test_verb;
mod thermocline;
mod unseen;
mod waiting;
mod whole_program;
mod writers;

mod examples;
mod shell;

/// A file that is no module of a binary would be a test that never runs.
#[test]
fn every_file_of_tests_is_in_a_binary() {
    let listed = [include_str!("scripts.rs"), include_str!("live.rs")].concat();
    let names = std::fs::read_dir("tests").into_iter().flatten().flatten().map(|entry| entry.file_name());
    let names: Vec<String> = names.filter_map(|name| Some(name.to_str()?.strip_suffix(".rs")?.to_owned())).collect();
    assert!(names.len() > 30, "{names:?}");
    for name in names {
        let is_in = listed.contains(&format!("\nmod {name};\n")) || ["scripts", "live"].contains(&&*name);
        assert!(is_in, "tests/{name}.rs is in no binary: add `mod {name};` to tests/scripts.rs");
    }
}
