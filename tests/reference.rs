//! The reference holds what it says: its examples are checked as scripts are, its tables against the language.

#![expect(clippy::unwrap_used, reason = "a test that cannot read the reference has failed")]

use albacore_session::{Script, Severity, load};
use std::path::Path;

const REFERENCE: &str = "docs/language.md";

/// What a body of statements stands in: a mission that knows its position and has its setpoints.
const BEFORE: &str = "\
use maneuver, search
mission example in calm within 1 h {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 800 m, width: 400 m)
    requires {
        position, course, heading, speed, depth, altitude, water_depth, battery, chemical fresh 1 min, else abort
        flow fresh 1 min, at first 10 cm/s toward east, else abort
    }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
";

/// What is no fault of an example: it shows one thing, and reads little of what it declares and of what stands around it.
const OF_A_FRAGMENT: [&str; 2] = ["names::unused", "missions::unread"];

/// An example: the words after its fence, where it stands, and its text.
struct Example {
    marks: Vec<String>,
    place: String,
    text: String,
}

/// The fenced blocks of a page that are scripts.
fn examples(page: &str) -> Vec<Example> {
    let text = std::fs::read_to_string(page).unwrap();
    let mut examples: Vec<Example> = Vec::new();
    let mut open = None;
    for (i, line) in text.lines().enumerate() {
        match (line.strip_prefix("```"), open) {
            (Some(info), None) => {
                let marks: Vec<String> = info.split(',').map(|mark| mark.trim().to_string()).collect();
                open = Some(marks[0] == "alb");
                if marks[0] == "alb" {
                    examples.push(Example { marks, place: format!("{page}:{}", i + 1), text: String::new() });
                }
            }
            (Some(_), Some(_)) => open = None,
            (None, Some(true)) => examples.last_mut().unwrap().text.push_str(&format!("{line}\n")),
            (None, _) => {}
        }
    }
    assert_eq!(open, None, "{page}: a block that is not closed");
    examples
}

/// Loads a script that stands in no file, with all that `check` says of it: code and message of each finding.
fn findings(name: &str, text: &str) -> Vec<(&'static str, String)> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{name}.alb"));
    std::fs::write(&path, text).unwrap();
    let script: Script = load(&path, None, &[]).unwrap();
    let mut found = script.findings.clone();
    if script.is_sound() {
        let missions: Vec<String> = script.missions().map(|m| m.name.clone()).collect();
        found.extend(missions.iter().filter_map(|m| script.mission(m)).filter_map(Result::err).flatten());
        found.extend(script.tests().into_iter().filter_map(Result::err).flatten());
    }
    found
        .into_iter()
        .filter(|f| !OF_A_FRAGMENT.contains(&f.code))
        .map(|f| {
            (f.code, format!("{}: {}", if f.severity == Severity::Error { "error" } else { "warning" }, f.message))
        })
        .collect()
}

/// ```` ```alb ```` is a script or declarations; with `statements` the body of a mission; with `wrong` and a code it has
/// that mistake and no other.
fn holds(example: &Example) -> Result<(), String> {
    let marks: Vec<&str> = example.marks[1..].iter().map(String::as_str).collect();
    let (in_body, marks) = match marks.as_slice() {
        ["statements", rest @ ..] => (true, rest),
        all => (false, all),
    };
    let text = if in_body { format!("{BEFORE}{}}}\n", example.text) } else { example.text.clone() };
    let name = example.place.replace(|c: char| !c.is_alphanumeric(), "_");
    let found = findings(&name, &text);
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
            _ => "kg",
        };
        let (low, high) = (si * (1.0 - 1e-9), si * (1.0 + 1e-9));
        let n = script.lines().count();
        script.push_str(&format!(
            "behavior b{n}(x: {ty} = 1 {unit} in {low:.18} {base}..{high:.18} {base}) {{ wait for 1 s }}\n"
        ));
    }
    assert_eq!(script.lines().count(), 24, "every unit, each on a row:\n{script}");
    assert_eq!(findings("units", &script), []);
}

/// Every script that shows a rule of time, and its trace, is linked; and what is linked is there.
#[test]
fn every_rule_leads_to_its_traces() {
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    for entry in std::fs::read_dir("tests/rules").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "alb") {
            let name = path.file_name().unwrap().to_str().unwrap();
            assert!(text.contains(&format!("(../tests/rules/{name})")), "{name} is not linked");
            assert!(text.contains(&format!("rules__rules@{name}.snap)")), "the trace of {name} is not linked");
        }
    }
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

/// What a scenario can say is declared in the standard library: every clause and parameter stands in the table.
#[test]
fn the_table_of_clauses_is_whole() {
    let world = std::fs::read_to_string("stdlib/world.alb").unwrap();
    let rows = rows();
    let in_table = |cell: &str| rows.iter().any(|row| row.iter().take(2).any(|c| *c == format!("`{cell}`")));
    for line in world.lines().filter(|line| !line.starts_with("//")) {
        let words = line.strip_prefix("clause ").unwrap_or(line);
        for word in words.split(['(', ',']) {
            let name = word.split(':').next().unwrap().trim();
            if !name.is_empty() && name.chars().all(|c| c.is_ascii_lowercase() || c == '_') {
                assert!(in_table(name), "`{name}` is in no table");
            }
        }
    }
}
