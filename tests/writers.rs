//! What is written is written whole, under names that nobody chose, and through no link; and only `src/disk.rs` writes.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

use crate::shell::behind;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Laid out otherwise than `fmt` does.
const PLAN: &str = "const  a=1 m\n";
const LAID_OUT: &str = "const a = 1 m\n";

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("writers").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn command(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(words.split(' ')).current_dir(folder).stdin(Stdio::null());
    command
}

fn albacore(folder: &Path, words: &str) -> (Option<i32>, String) {
    said(&command(folder, words).output().unwrap())
}

fn said(output: &Output) -> (Option<i32>, String) {
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Every verb that writes a file, in a folder that holds `plan.alb` and `box.alb`.
const VERBS: [&str; 6] = [
    "fmt plan.alb",
    "graph cpt cpt_2005 --out g.svg",
    "run box.alb --out out",
    "campaign box.alb --seeds 1..2 --out t.csv",
    "scenario show box.alb --out s.svg",
    "doc cpt --out out",
];
/// Those that need the run or the table of another.
const LATER_VERBS: [&str; 3] =
    ["export out --csv --kml", "report out --out report.html", "campaign plot t.csv --out p.svg"];

/// Names that a temporary file could have, and had.
const NEIGHBOURS: [&str; 12] = [
    "plan.part",
    "g.part",
    "s.part",
    "t.part",
    "t.csv.origin.part",
    "p.part",
    "report.part",
    "out/journal.part",
    "out/trace.part",
    "out/run.part",
    "out/cpt.part",
    "out/export.part",
];

fn sources(folder: &Path) {
    std::fs::create_dir(folder.join("out")).unwrap();
    std::fs::write(folder.join("plan.alb"), PLAN).unwrap();
    std::fs::copy("missions/box.alb", folder.join("box.alb")).unwrap();
}

#[test]
fn neighbours_of_what_is_written_stay_as_they_are() {
    for linked in [false, true] {
        let folder = empty(if linked { "links" } else { "files" });
        let mine = folder.join("mine");
        std::fs::write(&mine, "mine").unwrap();
        sources(&folder);
        for name in NEIGHBOURS {
            if linked {
                symlink(&mine, folder.join(name)).unwrap();
            } else {
                std::fs::write(folder.join(name), "mine").unwrap();
            }
        }
        for words in VERBS.into_iter().chain(LATER_VERBS) {
            assert_eq!(albacore(&folder, words).0, Some(0), "{words}");
        }
        for name in NEIGHBOURS {
            assert_eq!(std::fs::read_to_string(folder.join(name)).ok().as_deref(), Some("mine"), "{name}");
            assert_eq!(folder.join(name).is_symlink(), linked, "{name}");
        }
        assert_eq!(std::fs::read_to_string(folder.join("plan.alb")).unwrap(), LAID_OUT);
        let out = folder.join("out");
        let hidden: Vec<_> = names(&folder).into_iter().chain(names(&out)).filter(|n| n.starts_with('.')).collect();
        assert!(hidden.is_empty(), "{hidden:?}");
    }
}

#[test]
fn what_a_link_leads_to_is_left_alone() {
    let folder = empty("targets");
    sources(&folder);
    std::fs::write(folder.join("mine"), "mine").unwrap();
    let targets = ["g.svg", "s.svg", "out/cpt.md", "out/index.md"];
    for name in targets {
        symlink(folder.join("mine"), folder.join(name)).unwrap();
    }
    for words in [VERBS[1], VERBS[4], VERBS[5]] {
        let (code, said) = albacore(&folder, words);
        assert!(code == Some(4) && said.contains("it is a link, which is left as it is"), "{words}: {code:?} {said}");
    }
    assert_eq!(std::fs::read_to_string(folder.join("mine")).unwrap(), "mine");
    for name in targets {
        assert!(folder.join(name).is_symlink(), "{name}");
    }
    // Only the script that a link stands for is meant when the link is named.
    symlink("plan.alb", folder.join("link.alb")).unwrap();
    assert_eq!(albacore(&folder, "fmt link.alb").0, Some(0));
    assert!(folder.join("link.alb").is_symlink());
    assert_eq!(std::fs::read_to_string(folder.join("plan.alb")).unwrap(), LAID_OUT);
}

/// A file is written whole by taking the place of the one before: its other names would lead to that, and nobody would know.
#[test]
fn who_lays_out_a_file_of_several_names_is_told() {
    let folder = empty("names");
    for (others, said_of_them) in [(1, "had another name (a hard link), which keeps"), (2, "had 2 other names")] {
        let _ = std::fs::remove_file(folder.join("plan.alb"));
        std::fs::write(folder.join("plan.alb"), PLAN).unwrap();
        let names: Vec<PathBuf> = (0..others).map(|i| folder.join(format!("other-{others}-{i}"))).collect();
        names.iter().for_each(|name| std::fs::hard_link(folder.join("plan.alb"), name).unwrap());
        let (code, said) = albacore(&folder, "fmt --check plan.alb");
        assert_eq!((code, said.as_str()), (Some(1), ""));
        let (code, said) = albacore(&folder, "fmt plan.alb");
        assert!(code == Some(0) && said.contains(&format!("warning: `plan.alb` {said_of_them}")), "{code:?} {said}");
        assert_eq!(std::fs::read_to_string(folder.join("plan.alb")).unwrap(), LAID_OUT);
        assert!(names.iter().all(|name| std::fs::read_to_string(name).unwrap() == PLAN));
        assert_eq!(albacore(&folder, "fmt plan.alb"), (Some(0), String::new()));
    }
}

#[test]
fn a_table_is_begun_through_no_link() {
    let folder = empty("table");
    sources(&folder);
    symlink("mine", folder.join("t.csv")).unwrap();
    let (code, said) = albacore(&folder, VERBS[3]);
    assert!(code == Some(2) && said.contains("`t.csv` is there already"), "{code:?} {said}");
    assert!(!folder.join("mine").exists());
}

#[test]
fn what_is_no_file_is_not_replaced() {
    let folder = empty("pipes");
    assert!(Command::new("mkfifo").arg(folder.join("g.svg")).status().unwrap().success());
    let (code, said) = albacore(&folder, VERBS[1]);
    assert!(code == Some(4) && said.contains("`g.svg` cannot be written: it is no ordinary file"), "{code:?} {said}");
    assert_eq!(names(&folder), ["g.svg"]);
    // A stream is none either, where the output goes to a file.
    let file = std::fs::File::create(folder.join("stdout")).unwrap();
    let output = command(&folder, "graph cpt cpt_2005 --out /dev/stdout").stdout(file).output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(Path::new("/dev/stdout").is_symlink());
}

/// What a person can mend is said in words, and not by the number of an error.
#[test]
fn a_path_that_leads_nowhere_is_told() {
    let folder = empty("nowhere");
    sources(&folder);
    std::fs::write(folder.join("f"), "").unwrap();
    symlink("nowhere", folder.join("albacore-runs")).unwrap();
    let beneath = "`f/x` cannot be written: `f` is a file, and no folder";
    for (words, why) in [
        ("run box.alb --out f", "`f` cannot be written: there is a file of that name"),
        ("run box.alb --out f/x", beneath),
        ("doc cpt --out f/x", beneath),
        ("graph cpt cpt_2005 --out f/x", beneath),
        ("scenario show box.alb --out f/x", beneath),
        ("campaign box.alb --seeds 1..2 --out f/x", beneath),
        ("campaign box.alb --seeds 1..2 --out no/x", "`no/x` cannot be written: there is no folder `no`"),
        ("graph cpt cpt_2005 --out no/x", "`no/x` cannot be written: there is no folder `no`"),
        ("campaign box.alb --seeds 1..2 --out q/", "`q/` cannot be written: its name ends as a folder's does"),
        ("campaign box.alb --seeds 1..2 --out q/ --resume", "`q/` cannot be written: its name ends as a folder's does"),
        ("graph cpt cpt_2005 --out q/", "`q/` cannot be written: its name ends as a folder's does"),
        ("scenario show box.alb --out f/", "`f/` cannot be written: its name ends as a folder's does"),
        ("campaign box.alb --seeds 1..2 --out out/", "`out/` cannot be written: it is a folder"),
        ("run box.alb", "`albacore-runs/box` cannot be written: `albacore-runs` is a link that leads nowhere"),
        ("scenario show box.alb", "cannot be written: `albacore-runs` is a link that leads nowhere"),
        ("run box.alb --out albacore-runs/x", "cannot be written: `albacore-runs` is a link that leads nowhere"),
        ("doc cpt --out albacore-runs", "cannot be written: `albacore-runs` is a link that leads nowhere"),
        ("graph cpt cpt_2005 --out albacore-runs/x", "cannot be written: `albacore-runs` is a link that leads nowhere"),
    ] {
        let (code, said) = albacore(&folder, words);
        assert!(code.is_some_and(|code| code > 0) && said.contains(why), "{words}: {code:?} {said}");
        assert!(!said.contains("os error"), "{words}: {said}");
    }
}

#[test]
fn permissions_stay_and_what_is_read_only_is_refused() {
    let folder = empty("permissions");
    let plan = folder.join("plan.alb");
    for mode in [0o600, 0o664, 0o755] {
        std::fs::write(&plan, PLAN).unwrap();
        std::fs::set_permissions(&plan, std::fs::Permissions::from_mode(mode)).unwrap();
        assert_eq!(albacore(&folder, "fmt plan.alb").0, Some(0));
        assert_eq!(std::fs::metadata(&plan).unwrap().permissions().mode() & 0o777, mode);
    }
    std::fs::write(&plan, PLAN).unwrap();
    std::fs::set_permissions(&plan, std::fs::Permissions::from_mode(0o444)).unwrap();
    let (code, said) = albacore(&folder, "fmt plan.alb");
    assert!(code == Some(4) && said.contains("`plan.alb` cannot be written: it is read-only"), "{code:?} {said}");
    assert_eq!(std::fs::read_to_string(&plan).unwrap(), PLAN);
    // A new file is as readable as every other.
    assert_eq!(albacore(&folder, VERBS[1]).0, Some(0));
    std::fs::write(folder.join("other"), "").unwrap();
    let mode = |name: &str| std::fs::metadata(folder.join(name)).unwrap().permissions().mode();
    assert_eq!(mode("g.svg"), mode("other"));
}

#[test]
fn a_disk_that_is_full_leaves_nothing_behind() {
    let folder = empty("full");
    sources(&folder);
    // Who does not ignore the signal that comes with a limit has the same.
    for limit in ["ulimit -f 0", "trap '' XFSZ; ulimit -f 0"] {
        let verbs = ["fmt plan.alb", "fmt plan.alb -", "new reef", "test box.alb --accept"];
        for words in VERBS[1..].iter().chain(&verbs).copied() {
            let mut limited = behind(limit, &command(&folder, words));
            let (code, said) = said(&limited.stdin(Stdio::null()).stdout(Stdio::null()).output().unwrap());
            if words.starts_with("test") {
                std::fs::remove_dir(folder.join("snapshots")).unwrap();
            } else {
                assert!(code == Some(4) && said.contains("cannot be written: "), "{words}: {code:?} {said}");
            }
            assert!(!said.contains(".part"), "{words}: {said}");
            assert_eq!(names(&folder), ["box.alb", "out", "plan.alb"], "{words}: {said}");
            assert!(names(&folder.join("out")).is_empty(), "{words}");
        }
    }
    assert_eq!(std::fs::read_to_string(folder.join("plan.alb")).unwrap(), PLAN);
}

#[test]
fn who_interrupts_finds_a_whole_project_or_none() {
    let folder = empty("interrupted");
    let mut child = command(&folder, "new reef").stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while names(&folder).is_empty() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let code = child.wait().unwrap().code();
    assert!(matches!(code, Some(0 | 1)), "{code:?}");
    assert_eq!(names(&folder), if code == Some(0) { vec!["reef"] } else { Vec::new() });
}

#[test]
fn who_interrupts_a_campaign_finds_no_temporary_file() {
    for round in 0..20 {
        let folder = empty("stopped");
        std::fs::copy("missions/box.alb", folder.join("box.alb")).unwrap();
        let mut campaign = command(&folder, "campaign box.alb --seeds 1..3000 --out t.csv");
        let mut child = campaign.stderr(Stdio::null()).spawn().unwrap();
        while names(&folder).len() < 2 + round % 3 && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
        child.wait().unwrap();
        let left = names(&folder);
        assert!(left.iter().all(|name| !name.starts_with('.')), "{left:?}");
    }
}

#[test]
fn what_somebody_else_wrote_is_not_replaced() {
    let folder = empty("others");
    sources(&folder);
    for (name, text) in [("README.alb", "const a = 1 m\n"), ("README.md", "# Mine\n"), ("mine.svg", "mine")] {
        std::fs::write(folder.join("out").join(name), text).unwrap();
    }
    let all = || names(&folder.join("out")).into_iter().map(|n| std::fs::read(folder.join("out").join(n)).unwrap());
    let before: Vec<_> = all().collect();
    let box_before = std::fs::read(folder.join("box.alb")).unwrap();
    for words in [
        "graph cpt cpt_2005 --out box.alb",
        "graph cpt cpt_2005 --format dot --out box.alb",
        "scenario show box.alb --out box.alb",
        "scenario show box.alb --out out/mine.svg",
        "doc out --out out",
    ] {
        let (code, said) = albacore(&folder, words);
        assert!(
            code == Some(4) && said.contains("it is there already, and is not as Albacore made it"),
            "{words}: {code:?} {said}"
        );
    }
    assert_eq!(all().collect::<Vec<_>>(), before);
    assert_eq!(std::fs::read(folder.join("box.alb")).unwrap(), box_before);
    // What was made so is made again.
    for words in ["doc out --out pages", "graph cpt cpt_2005 --out g.svg", "scenario show box.alb --out g.svg"] {
        assert_eq!(albacore(&folder, words).0, Some(0), "{words}");
        assert_eq!(albacore(&folder, words).0, Some(0), "{words}");
    }
    // The list of pages would stand in the place of this one.
    std::fs::write(folder.join("out/index.alb"), "const a = 1 m\n").unwrap();
    let (code, said) = albacore(&folder, "doc out --out list");
    assert!(code == Some(2) && said.contains("`index.alb` can have no page"), "{code:?} {said}");
    assert!(!folder.join("list").exists());
}

/// What looks like what is made, and what was made and edited since, is somebody's own.
/// The attack: a diagram took the place of a run's trace, and of its picture.
#[test]
fn what_a_run_left_is_not_replaced() {
    let folder = empty("left");
    std::fs::copy("missions/box.alb", folder.join("box.alb")).unwrap();
    assert_eq!(albacore(&folder, "run box.alb --out r").0, Some(0));
    let trace = std::fs::read(folder.join("r/trace.txt")).unwrap();
    for words in
        ["graph box.alb --out r/trace.txt", "graph box.alb --out r/run.svg", "scenario show box.alb --out r/run.svg"]
    {
        let (code, said) = albacore(&folder, words);
        assert!(code == Some(4) && said.contains("it is a file of the run in this folder"), "{words}: {code:?} {said}");
    }
    assert_eq!(std::fs::read(folder.join("r/trace.txt")).unwrap(), trace);
    assert_eq!(albacore(&folder, "graph box.alb --out r/graph.svg").0, Some(0));
    assert_eq!(albacore(&folder, "run box.alb --out r --replace").0, Some(0));
}

#[test]
fn what_was_edited_is_not_replaced() {
    let folder = empty("edited");
    std::fs::copy("missions/box.alb", folder.join("box.alb")).unwrap();
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\"><path d=\"M0 0\"/></svg>\n";
    for (words, file, own) in [
        ("graph cpt cpt_2005 --out g.svg", "g.svg", svg),
        ("graph cpt cpt_2005 --format dot --out g.dot", "g.dot", "digraph thesis {\n  a -> b;\n}\n"),
        ("graph cpt cpt_2005 --format mermaid --out g.mmd", "g.mmd", "flowchart TD\n    mine --> yours\n"),
        ("scenario show calm --out s.svg", "s.svg", svg),
        ("scenario show calm", "albacore-runs/calm-1/scenario.svg", svg),
        ("doc cpt --out out", "out/cpt.md", "# cpt\n\n<!-- Made by `albacore doc`. -->\n"),
        ("doc cpt --format html --out out", "out/cpt.html", "<!DOCTYPE html>\n<html></html>\n"),
    ] {
        let path = folder.join(file);
        assert_eq!(albacore(&folder, words).0, Some(0), "{words}");
        let made = std::fs::read_to_string(&path).unwrap();
        assert_eq!(albacore(&folder, words).0, Some(0), "{words}: what was made is made again");
        let half = made.char_indices().nth(made.chars().count() / 2).unwrap().0;
        let edited = [&made[..half], " ", &made[half..]].concat();
        for theirs in [own, &edited, &made[..half], &format!("{made}{own}"), &format!("{own}{made}")] {
            std::fs::write(&path, theirs).unwrap();
            let (code, said) = albacore(&folder, words);
            assert!(code == Some(4) && said.contains("is not as Albacore made it"), "{words}: {code:?} {said}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), theirs, "{words}");
        }
        std::fs::rename(&path, folder.join("elsewhere")).unwrap();
        std::os::unix::fs::symlink(folder.join("elsewhere"), &path).unwrap();
        let (code, said) = albacore(&folder, words);
        assert!(code == Some(4) && said.contains("it is a link"), "{words}: {code:?} {said}");
        assert!(path.is_symlink());
    }
}

/// Nothing else in the program opens a file to write it, moves it or removes it.
#[test]
fn only_one_place_writes() {
    let raw = ["fs::write", "File::create", "File::options", "OpenOptions", "rename(", "fs::copy", "hard_link"];
    let removers = ["remove_file", "remove_dir"];
    let mut scripts = Vec::new();
    let mut folders: Vec<PathBuf> =
        ["src", "lang/src", "lang/grammar/src", "lang/syntax/src"].map(PathBuf::from).into();
    folders.extend(std::fs::read_dir("runtime").unwrap().map(|e| e.unwrap().path().join("src")));
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                scripts.push(path);
            }
        }
    }
    assert!(scripts.len() > 300);
    let mut writers = Vec::new();
    for path in scripts.iter().filter(|path| !path.ends_with("src/disk.rs")) {
        let text = std::fs::read_to_string(path).unwrap();
        let text = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines = text.lines().enumerate().filter(|(_, line)| raw.iter().chain(&removers).any(|w| line.contains(w)));
        writers.extend(lines.map(|(i, line)| format!("{}:{}: {}", path.display(), i + 1, line.trim())));
    }
    assert!(writers.is_empty(), "write through src/disk.rs instead:\n{}", writers.join("\n"));
}
