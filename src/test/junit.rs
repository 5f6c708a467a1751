//! `--junit`: the results as an XML file in the form of JUnit, a suite for each script. It holds no time: the same results are the same bytes.

use super::results::{MARGIN, Outcome, Results};
use crate::disk;
use crate::made::{Comment, Made};
use albacore_session::seen::one_line;
use std::io;
use std::path::Path;

/// Writes the file, where none is or one that was made so.
pub fn write(path: &Path, results: &Results) -> io::Result<()> {
    disk::remake(path, &Made::new(text(results), Comment::Markup))
}

/// The suites, in the order in which the scripts were read.
fn text(results: &Results) -> String {
    let mut scripts: Vec<&str> = Vec::new();
    for script in results.tests.iter().map(|test| &test.script).chain(&results.scripts_with_errors) {
        if !scripts.contains(&script.as_str()) {
            scripts.push(script);
        }
    }
    let all: Vec<&Outcome> = results.tests.iter().collect();
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    out.push_str(&format!("<testsuites{}>\n", counts(&all, results.scripts_with_errors.len())));
    for script in scripts {
        let tests: Vec<&Outcome> = all.iter().copied().filter(|test| test.script == script).collect();
        let errors = results.scripts_with_errors.iter().filter(|wrong| *wrong == script).count();
        out.push_str(&format!("  <testsuite name=\"{}\"{}>\n", escaped(script), counts(&tests, errors)));
        tests.iter().for_each(|test| case(&mut out, test));
        if errors > 0 {
            out.push_str(&format!("    <testcase name=\"{0}\" classname=\"{0}\">\n", escaped(script)));
            out.push_str("      <error message=\"the script has errors: `albacore check` tells them\"/>\n");
            out.push_str("    </testcase>\n");
        }
        out.push_str("  </testsuite>\n");
    }
    out.push_str("</testsuites>\n");
    out
}

fn counts(tests: &[&Outcome], errors: usize) -> String {
    let skipped = tests.iter().filter(|test| test.left_out.is_some()).count();
    let failures = tests.iter().filter(|test| !test.passed && test.left_out.is_none()).count();
    let all = tests.len() + errors;
    format!(" tests=\"{all}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"{skipped}\"")
}

fn case(out: &mut String, test: &Outcome) {
    let (name, class) = (escaped(&test.name), escaped(&disk::stem(Path::new(&test.script))));
    let head = format!("    <testcase name=\"{name}\" classname=\"{class}\"");
    if test.passed {
        out.push_str(&format!("{head}/>\n"));
        return;
    }
    out.push_str(&format!("{head}>\n"));
    if let Some(why) = test.left_out {
        out.push_str(&format!("      <skipped message=\"{}\"/>\n", escaped(why)));
    } else {
        let mut lines: Vec<String> =
            test.failures.iter().flat_map(|wrong| wrong.text.split('\n')).map(escaped).collect();
        let kept = test.kept.iter().flat_map(|kept| kept.lines());
        lines.extend(kept.map(|line| escaped(line.strip_prefix(MARGIN).unwrap_or(&line))));
        let (place, first) = (escaped(&test.place), lines.first().map_or("", String::as_str));
        // What is said of an `expect` begins with its own place.
        let script = place.rsplit_once(':').map_or("", |(script, _)| script);
        let has_place = !script.is_empty() && first.strip_prefix(script).is_some_and(|rest| rest.starts_with(':'));
        let message = if has_place { first.to_string() } else { format!("{place}  {first}") };
        let text = lines.join("\n");
        out.push_str(&format!("      <failure message=\"{}\">{text}</failure>\n", message.trim_end()));
    }
    out.push_str("    </testcase>\n");
}

/// A text on one line in which nothing is unseen and nothing is markup.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c => out.push(c),
        }
    }
    out
}
