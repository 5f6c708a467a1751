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
mod export;
mod faults;
mod fmt;
mod graph;
mod imports;
mod lag;
mod library;
mod mixups;
mod names;
mod new;
mod pages;
mod past;
mod recorded;
mod reference;
mod repl;
mod report;
mod resilience;
mod rules;
mod runs;
mod scenario;
mod set;
mod sizes;
mod syntax;
mod test_verb;
mod thermocline;
mod tutorial;
mod unseen;
mod waiting;
mod whole_program;
mod writers;
mod zoom;

mod examples;
mod shell;

/// A file that is no module of a binary would be a test that never runs.
#[test]
fn every_file_of_tests_is_in_a_binary() {
    for (folder, binaries) in [
        ("tests", &["scripts", "live"][..]),
        ("runtime/guidance/tests/laws", &["main"]),
        ("runtime/session/tests/simulated", &["main"]),
    ] {
        let text = |name: &&str| std::fs::read_to_string(format!("{folder}/{name}.rs")).unwrap_or_default();
        let listed: String = binaries.iter().map(text).collect();
        let names = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name());
        let names: Vec<String> =
            names.filter_map(|name| Some(name.to_str()?.strip_suffix(".rs")?.to_owned())).collect();
        assert!(names.len() > binaries.len(), "{folder}: {names:?}");
        for name in names.iter().filter(|name| !binaries.contains(&&***name)) {
            let is_in = listed.contains(&format!("\nmod {name};\n"));
            assert!(is_in, "{folder}/{name}.rs is in no binary: add `mod {name};` to {folder}/{}.rs", binaries[0]);
        }
    }
}
