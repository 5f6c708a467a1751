//! The reference holds what it says: its examples are checked as scripts are, its tables against the language.

#![expect(clippy::unwrap_used, reason = "a test that cannot read the reference has failed")]

use crate::examples::{Example, OF_A_FRAGMENT, examples, findings, folder};
use albacore_program::{Guide, Omitted, ParamKind};
use albacore_session::{Faults, run_test};
use std::collections::BTreeSet;
use std::path::Path;

const REFERENCE: &str = "docs/language.md";

/// ```` ```alb ```` is a script or declarations; with `statements` the body of a mission; with `wrong` and a code it has
/// that mistake and no other.
fn holds(example: &Example) -> Result<(), String> {
    let marks: Vec<&str> = example.marks[1..].iter().map(String::as_str).collect();
    let marks = marks.strip_prefix(&["statements"]).unwrap_or(&marks);
    let mut found = example.findings();
    found.retain(|(code, _)| !OF_A_FRAGMENT.contains(code));
    let expected = match marks {
        [] => None,
        ["wrong", code] => Some(*code),
        _ => return Err(format!("{}: what does `{}` mean?", example.place, example.marks.join(","))),
    };
    let as_expected = match expected {
        None => found.is_empty(),
        // Whoever reads the page sees no words after a fence.
        Some(code) => {
            example.text.starts_with(&format!("// wrong: {code}\n"))
                && !found.is_empty()
                && found.iter().all(|(c, _)| *c == code)
        }
    };
    if as_expected { Ok(()) } else { Err(format!("{}: {found:#?}", example.place)) }
}

#[track_caller]
fn all_hold(page: &str, least: usize) {
    let examples = examples(page);
    assert!(examples.len() >= least, "{page} has {} examples", examples.len());
    let wrong: Vec<String> = examples.iter().filter_map(|e| holds(e).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_examples_of_the_reference_are_checked() {
    all_hold(REFERENCE, 20);
    all_hold("docs/files.md", 1);
}

#[test]
fn the_answers_of_the_cookbook_are_checked() {
    all_hold("docs/cookbook.md", 20);
    all_hold("docs/moos-ivp.md", 1);
}

/// A test that is shown passes, but for its snapshot, which a page cannot hold.
#[test]
fn the_tests_of_the_examples_pass() {
    let folder = folder("examples-run");
    let mut run = 0;
    let pages = [REFERENCE, "docs/cookbook.md"].into_iter().flat_map(examples);
    for example in pages.filter(|e| e.text.lines().any(|line| line.starts_with("test \""))) {
        let path = folder.join("example.alb");
        std::fs::write(&path, &example.text).unwrap();
        let script = albacore_session::load(&path, None, &[]).unwrap();
        for test in script.tests() {
            let result = run_test(&script, &test.unwrap(), &Faults::default());
            let Ok(result) = result else { panic!("{}: its test cannot be run", example.place) };
            assert!(result.failures.is_empty(), "{}: {:#?}", example.place, result.failures);
            run += 1;
        }
    }
    assert!(run > 0, "the reference shows no test");
}

#[test]
fn the_examples_of_the_front_page_are_checked() {
    all_hold("README.md", 1);
}

/// The cells of the rows of all tables of the reference.
fn rows() -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect();
    text.lines().filter(|line| line.starts_with('|')).map(cells).collect()
}

/// One of each unit is as many of its SI unit as the table says, or the checker finds it outside the range.
#[test]
fn the_table_of_units_is_true() {
    let mut script = String::new();
    for row in rows() {
        let [unit, ty, si] = row.as_slice() else { continue };
        let Ok(si) = si.parse::<f64>() else { continue };
        let unit = unit.trim_matches('`');
        let base = match ty.as_str() {
            "Ratio" => "",
            "Length" => "m",
            "Duration" => "s",
            "Angle" => "rad",
            "Speed" => "m/s",
            "Frequency" => "Hz",
            "Temperature" => "degC",
            "Salinity" => "psu",
            _ => "kg",
        };
        let (low, high) = (si * (1.0 - 1e-9), si * (1.0 + 1e-9));
        let n = script.lines().count();
        script.push_str(&format!(
            "behavior b{n}(x: {ty} = 1 {unit} in {low:.18} {base}..{high:.18} {base}) {{ wait for 1 s }}\n"
        ));
    }
    assert_eq!(script.lines().count(), 27, "every unit, each on a row:\n{script}");
    let mut found = findings("units", &script, false);
    found.retain(|(code, _)| !OF_A_FRAGMENT.contains(code));
    assert_eq!(found, []);
}

/// The arguments of guidance are those of the table of laws, each on a row.
#[test]
fn the_table_of_arguments_is_true() {
    let shown = |kind: ParamKind, value: f64| match kind {
        ParamKind::Bool => (value == 1.0).to_string(),
        ParamKind::Length => format!("{value} m"),
        _ => value.to_string(),
    };
    let mut expected = Vec::new();
    for law in Guide::ALL.into_iter().map(Guide::law) {
        for param in law.params {
            let omitted = match param.omitted {
                Omitted::Refused => "not allowed".to_string(),
                Omitted::Is(value) => shown(param.kind, value),
                Omitted::TightestTurn => "the tightest turn".to_string(),
            };
            let range =
                param.range.map_or("any".to_string(), |range| format!("{} or more", shown(param.kind, range.low)));
            let argument = format!("`{}: {:?}`", param.name, param.kind);
            expected.push(vec![format!("`{}`", law.verb), argument, omitted, range, param.meaning.to_string()]);
        }
    }
    let is_verb = |word: &str| Guide::takes_arguments(word.trim_matches('`'));
    let mut written: Vec<Vec<String>> = rows().into_iter().filter(|row| row.len() == 5 && is_verb(&row[0])).collect();
    expected.sort();
    written.sort();
    assert_eq!(written, expected);
}

/// Every script that shows a rule of time, and its trace, is linked; and what is linked is there.
#[test]
fn every_rule_leads_to_its_traces() {
    let shown = std::fs::read_to_string("tests/rules/README.md").unwrap();
    for entry in std::fs::read_dir("tests/rules").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "alb") {
            let name = path.file_name().unwrap().to_str().unwrap();
            let rule = name.split('_').next().unwrap().trim_start_matches('0');
            let of_rule =
                shown.split(&format!("\n## Rule {rule}: ")).nth(1).and_then(|rest| rest.split("\n## ").next());
            let of_rule = of_rule.unwrap_or_default();
            assert!(of_rule.contains(&format!("({name})")), "{name} is not linked under its rule");
            assert!(
                of_rule.contains(&format!("scripts__rules__rules@{name}.snap)")),
                "the trace of {name} is not linked"
            );
        }
    }
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
        assert!(file.is_empty() || Path::new("docs").join(file).exists(), "`{link}` leads nowhere");
        assert!(!file.is_empty() || headings(&text).contains(&anchor.to_string()), "`{link}` leads to no heading");
    }
}

/// The anchors that a page's headings make.
fn headings(text: &str) -> Vec<String> {
    let anchor = |heading: &str| {
        let kept: String = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-')).collect();
        kept.to_lowercase().replace(' ', "-")
    };
    text.lines().filter_map(|line| line.strip_prefix("## ")).map(anchor).collect()
}

/// The clauses of a module of the standard library by name, and of what kind of value they are, if they are one.
fn clauses(module: &str) -> Vec<(String, Option<String>)> {
    let declared = std::fs::read_to_string(format!("stdlib/{module}.alb")).unwrap();
    let ends = |line: &&str| line.starts_with(')') || line.starts_with("clause ") && !line.ends_with('(');
    let mut lines = declared.lines();
    let mut found = Vec::new();
    while let Some(head) = lines.find(|line| line.starts_with("clause ")) {
        let name = head["clause ".len()..].split(['(', ' ']).next().unwrap();
        let end = if ends(&head) { head } else { lines.find(ends).unwrap() };
        found.push((name.to_string(), end.split_once("-> ").map(|(_, kind)| kind.to_string())));
    }
    found
}

#[test]
fn the_protocols_of_the_standard_library_are_the_table_of_dialects() {
    let protocols = clauses("craft").into_iter().filter(|(_, kind)| kind.as_deref() == Some("protocol"));
    assert_eq!(protocols.map(|(name, _)| name).collect::<Vec<_>>(), albacore_link::Dialect::names());
}

/// The codes between backquotes in a stretch of the reference.
fn quoted<'t>(page: &'t str, from: &str, to: &str) -> BTreeSet<&'t str> {
    let stretch = page.split(from).nth(1).and_then(|rest| rest.split(to).next()).unwrap_or_default();
    stretch.split('`').skip(1).step_by(2).collect()
}

/// The list of warnings is that of the warnings which some snapshot shows.
#[test]
fn every_warning_is_listed() {
    let mut shown = BTreeSet::new();
    for entry in std::fs::read_dir("tests/snapshots").unwrap() {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        let code = |at: usize| at.checked_sub(2).and_then(|at| lines.get(at)).filter(|code| code.contains("::"));
        shown.extend(
            (0..lines.len()).filter(|at| lines[*at].starts_with('⚠')).filter_map(code).map(|code| code.to_string()),
        );
    }
    let page = std::fs::read_to_string(REFERENCE).unwrap();
    let listed: BTreeSet<String> = quoted(&page, "\nWarnings are ", ".\n").into_iter().map(str::to_string).collect();
    assert_eq!(listed, shown);
}

/// Whoever adds a guidance law finds all places of the reference that name them.
#[test]
fn every_guidance_law_is_named_where_they_are() {
    let page = std::fs::read_to_string(REFERENCE).unwrap();
    let rule_3 = quoted(&page, "**Rule 3. ", "and calls of");
    let verbs = page.split("\nVERB ").nth(1).and_then(|rest| rest.lines().next()).unwrap();
    let reserved = page.split("**Reserved words**").nth(1).and_then(|rest| rest.split("\n\n").nth(1)).unwrap();
    for guide in Guide::ALL {
        let verb = guide.law().verb;
        assert!(rule_3.contains(verb), "rule 3: {verb}");
        assert!(reserved.split(|c: char| !c.is_alphabetic()).any(|word| word == verb), "reserved words: {verb}");
        assert!(!Guide::takes_arguments(verb) || verbs.contains(&format!("\"{verb}\"")), "VERB: {verb}");
    }
}
