//! `albacore new`: the project that it makes is sound, and what it refuses leaves nothing behind.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("new-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What `albacore` ends with, prints and says.
fn albacore(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The names of all that stands in a folder.
fn listed(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_new_project_is_checked_tested_formatted_and_run() {
    let folder = folder("whole");
    // The longest name that is taken, and the one that stands in the template.
    for name in ["a_survey_of_the_northern_harbour_in_2026", "first_dive"] {
        let (code, out, err) = albacore(&folder, &["new", name]);
        assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
        assert!(out.contains("albacore test"), "{out}");
        let project = folder.join(name);
        assert_eq!(listed(&project), [".gitignore", "README.md", "albacore.toml", "missions"]);
        let script = format!("missions/{name}.alb");
        let nothing = (Some(0), String::new(), String::new());
        assert_eq!(albacore(&project, &["check", &script]), nothing);
        assert_eq!(albacore(&project, &["fmt", "--check"]), nothing);
        let (code, out, err) = albacore(&project, &["test"]);
        assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
        assert!(out.ends_with("1 passed, 0 failed\n"), "{out}");
        let (code, _, err) = albacore(&project, &["run", &script, "--json"]);
        assert_eq!(code, Some(0), "{err}");
        assert_eq!(listed(&project.join("albacore-runs")), [format!("{name}-1")]);
        for file in ["README.md", "albacore.toml"] {
            assert!(std::fs::read_to_string(project.join(file)).unwrap().contains(name), "{file}");
        }
    }
    assert_eq!(listed(&folder).len(), 2, "nothing is left beside the projects");
}

#[track_caller]
fn refused(folder: &Path, name: &str, code: i32, said: &str) {
    let before = listed(folder);
    let (found, out, err) = albacore(folder, &["new", name]);
    assert_eq!((found, out.as_str()), (Some(code), ""), "{err}");
    assert!(err.contains(said), "{err}");
    assert_eq!(listed(folder), before);
}

#[test]
fn names_that_no_mission_can_have_are_refused() {
    let folder = folder("names");
    refused(&folder, "harbour-survey", 2, "begins with a letter: `harbour_survey`");
    refused(&folder, "../elsewhere", 2, "begins with a letter: `elsewhere`");
    refused(&folder, "3rd", 2, "begins with a letter: `rd`");
    refused(&folder, "", 2, "is no good name");
    refused(&folder, "hafen_ä", 2, "is no good name");
    refused(&folder, "mission", 2, "`mission` is no good name for a mission: ");
    refused(&folder, "harbour", 2, "`harbour` is no good name for a mission: ");
    refused(&folder, &"a".repeat(41), 2, "longer than 40");
}

#[test]
fn what_is_there_stays() {
    let folder = folder("there");
    std::fs::create_dir(folder.join("trial")).unwrap();
    refused(&folder, "trial", 2, "`trial` is there already");
    std::fs::write(folder.join("note"), "text").unwrap();
    refused(&folder, "note", 2, "`note` is there already");
    std::fs::create_dir(folder.join(".dive.part")).unwrap();
    refused(&folder, "dive", 2, "`.dive.part` is there already");
}
