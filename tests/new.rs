//! `albacore new`: what it makes is sound, passes its tests and runs; and where it makes nothing, it leaves nothing.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("new-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What the program ends with and says, in a folder.
fn albacore(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
}

/// The names in a folder, hidden ones too.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Makes a project and does with it what its README says.
fn lives(folder: &Path, name: &str, mission: &str) {
    let (code, said) = albacore(folder, &["new", name]);
    assert_eq!(code, Some(0), "{said}");
    let project = folder.join(name);
    let script = format!("{mission}.alb");
    let mut files = [".gitignore", "README.md", "albacore.toml", &script, "snapshots"];
    files.sort_unstable();
    assert_eq!(names(&project), files);
    let sound = format!("{script}: no errors (mission {mission})\n");
    assert_eq!(albacore(&project, &["check", &script]), (Some(0), sound));
    assert_eq!(albacore(&project, &["fmt", "--check"]), (Some(0), String::new()));
    let (code, said) = albacore(&project, &["test"]);
    assert_eq!((code, said.ends_with("1 passed, 0 failed\n")), (Some(0), true), "{said}");
    let (code, said) = albacore(&project, &["run", &script, "--no-out"]);
    assert_eq!((code, said.starts_with(&format!("{mission} in practice_bay, seed 1: completed"))), (Some(0), true));
    assert_eq!(albacore(&project, &["graph", &script]).0, Some(0));
    assert_eq!(names(&project), files);
    for file in ["albacore.toml", "README.md", &script] {
        let text = std::fs::read_to_string(project.join(file)).unwrap();
        assert!(text.contains(mission) && !text.replace(mission, "").contains("NAME"), "{file}: {text}");
    }
}

#[test]
fn a_new_project_is_sound_and_passes_its_tests() {
    let folder = empty("sound");
    lives(&folder, "reef", "reef");
    lives(&folder, "my-survey", "my_survey");
    assert_eq!(names(&folder), ["my-survey", "reef"]);
}

/// Names that the script's own parts have too, one with the templates' word for the name in it, and the longest there is.
#[test]
fn it_lives_under_many_names() {
    let folder = empty("names");
    let longest = "a".repeat(40);
    for name in
        ["rows", "home", "op", "area", "circle", "limit", "practice", "survey", "depth", "Snow_1", "RENAMED", &longest]
    {
        lives(&folder, name, name);
    }
}

#[test]
fn it_says_what_to_do_next() {
    let folder = empty("next");
    std::fs::create_dir(folder.join("surveys")).unwrap();
    let (code, said) = albacore(&folder, &["new", "surveys/north-coast/"]);
    assert_eq!(code, Some(0), "{said}");
    for line in ["cd surveys/north-coast", "albacore run north_coast.alb", "albacore test"] {
        assert!(said.contains(line), "{said}");
    }
    assert_eq!(albacore(&folder.join("surveys/north-coast"), &["test"]).0, Some(0));
}

#[test]
fn a_changed_behavior_fails_until_it_is_accepted() {
    let folder = empty("changed");
    lives(&folder, "reef", "reef");
    let script = folder.join("reef/reef.alb");
    let text = std::fs::read_to_string(&script).unwrap();
    std::fs::write(&script, text.replace("turns: 1", "turns: 2")).unwrap();
    let project = folder.join("reef");
    let (code, said) = albacore(&project, &["test"]);
    assert_eq!((code, said.contains("albacore test --accept")), (Some(1), true), "{said}");
    assert_eq!(albacore(&project, &["test", "--accept"]).0, Some(0));
    assert_eq!(albacore(&project, &["test"]).0, Some(0));
}

/// Each is refused with a reason and a fix, and nothing is left of it.
#[test]
fn what_cannot_be_a_project_is_refused() {
    let folder = empty("refused");
    std::fs::write(folder.join("taken"), "mine").unwrap();
    std::fs::create_dir(folder.join("there")).unwrap();
    let long = "a".repeat(41);
    let refused = [
        ("taken", "already something called `taken`", "choose another name"),
        ("there", "already something called `there`", "choose another name"),
        ("there/", "already something called `there/`", "choose another name"),
        ("watch", "it means something else already", "try `watch_survey`"),
        ("position", "it means something else already", "try `position_survey`"),
        ("point", "it means something else already", "try `point_survey`"),
        ("practice_bay", "it means something else already", "try `practice_bay_survey`"),
        ("search", "a module of the standard library", "try `search_survey`"),
        ("north coast", "letters from a to z", "try `north_coast`"),
        ("./2005-survey", "must begin with a letter", "try `survey_2005_survey`"),
        ("_", "must begin with a letter", "try `coast_survey`"),
        ("récif", "letters from a to z", "try `r_cif`"),
        ("a\u{1b}[31mb", r"`a\u{1b}[31mb` cannot be", "try `a_31mb`"),
        ("..", "letters from a to z", "try `coast_survey`"),
        (".", "letters from a to z", "try `coast_survey`"),
        ("reef.alb", "letters from a to z", "try `reef_alb`"),
        (&long, "longer than 40 letters", "try `aaaa"),
        ("nowhere/reef", "there is no folder `nowhere`", "make it first"),
        ("taken/reef", "there is no folder `taken`", "make it first"),
        ("", "value is required", "--help"),
    ];
    for (name, why, fix) in refused {
        let (code, said) = albacore(&folder, &["new", name]);
        assert_eq!(code, Some(2), "{name}: {said}");
        assert!(said.contains(why) && said.contains(fix), "{name}: {said}");
        assert_eq!(names(&folder), ["taken", "there"], "{name}");
    }
    assert!(names(&folder.join("there")).is_empty());
}

/// Below `/proc` not even root makes a folder.
#[cfg(target_os = "linux")]
#[test]
fn where_nothing_can_be_written_that_is_said() {
    let (code, said) = albacore(&empty("unwritable"), &["new", "/proc/reef"]);
    assert_eq!((code, said.starts_with("error: `/proc/reef` cannot be written: ")), (Some(4), true), "{said}");
    assert!(said.contains("choose a folder where you may write"), "{said}");
}
