//! The examples of pages, checked as scripts are.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Script, Severity, load};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// What a body of statements stands in: a mission that knows its position and has its setpoints.
const BEFORE: &str = "\
use maneuver, search
mission example in calm within 1 h {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 800 m, width: 400 m)
    limits { turn_rate <= 10 deg/s }
    requires {
        position, course, heading, speed, depth, altitude, water_depth, battery, chemical fresh 1 min, else abort
        flow fresh 1 min, at first 10 cm/s toward east, else abort
    }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
";

/// The folders that have their files.
static READY: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// What is no fault of an example: it shows one thing, and reads little of what it declares and of what stands around it.
pub const OF_A_FRAGMENT: [&str; 2] = ["names::unused", "missions::unread"];

/// An example: the words after its fence, where it stands, and its text.
pub struct Example {
    pub marks: Vec<String>,
    pub place: String,
    pub text: String,
}

impl Example {
    /// What is wrong with it: code and message of each finding.
    pub fn findings(&self) -> Vec<(&'static str, String)> {
        let in_body = self.marks.get(1).is_some_and(|mark| mark == "statements");
        let text = if in_body { format!("{BEFORE}{}}}\n", self.text) } else { self.text.clone() };
        let notes = self.marks.iter().any(|mark| mark == "notes");
        findings(&self.place.replace(|c: char| !c.is_alphanumeric(), "_"), &text, notes)
    }
}

/// The fenced blocks of a page that are scripts.
pub fn examples(page: &str) -> Vec<Example> {
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

/// A folder for examples, with the files of data that they name: written once, for tests beside one another read them.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut ready = READY.lock().unwrap();
    if ready.insert(folder.clone()) {
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("dive_12.csv"), include_str!("dive_12.csv")).unwrap();
    }
    folder
}

/// Loads a script that stands in no file, with all that `check` says of it, or `check --notes`: code and message of each
/// finding.
pub fn findings(name: &str, text: &str, notes: bool) -> Vec<(&'static str, String)> {
    let path = folder("examples").join(format!("{name}.alb"));
    std::fs::write(&path, text).unwrap();
    let script: Script = load(&path, None, &[]).unwrap();
    let mut found = script.findings.clone();
    if script.is_sound() {
        found.extend(albacore_session::findings(&script));
        found.extend(script.tests().into_iter().filter_map(Result::err).flatten());
    }
    if notes {
        found.extend(script.notes());
    }
    let kind = |severity| if severity == Severity::Error { "error" } else { "warning" };
    found.into_iter().map(|f| (f.code.name(), format!("{}: {}", kind(f.severity), f.message))).collect()
}
