//! Imports that no script of one folder can show: too many modules, and links that lead out of the project.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its scripts has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// An empty folder of its own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("imports").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What `check` says of `main.alb` in a folder.
fn told(folder: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["check", "main.alb"]).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    String::from_utf8(command.output().unwrap().stderr).unwrap()
}

#[test]
fn more_modules_than_can_be_imported() {
    let folder = folder("many");
    let names: Vec<String> = (1..=256).map(|n| format!("m{n}")).collect();
    for name in &names {
        std::fs::write(folder.join(format!("{name}.alb")), format!("const of_{name} = 1 m\n")).unwrap();
    }
    let lines: Vec<String> = names.iter().map(|name| format!("use {name}\n")).collect();
    std::fs::write(folder.join("main.alb"), lines.concat()).unwrap();
    insta::assert_snapshot!(told(&folder));
}

#[test]
#[cfg(unix)]
fn a_link_leads_out_of_the_project() {
    let folder = folder("link");
    let project = folder.join("project");
    std::fs::create_dir(&project).unwrap();
    std::fs::write(folder.join("coast.alb"), "const near = 5 m\n").unwrap();
    std::os::unix::fs::symlink(folder.join("coast.alb"), project.join("coast.alb")).unwrap();
    std::fs::write(project.join("main.alb"), "use coast\nconst far = 2 * coast.near\n").unwrap();
    insta::assert_snapshot!(told(&project));
}

/// However long the chain is, what a module imports is known before it: nothing waits for what is declared later.
#[test]
fn constants_and_signals_of_a_long_chain_of_modules() {
    let folder = folder("chain");
    for n in 0..100 {
        let text = format!("use m{0}, base\nconst x = m{0}.x + base.one\nsignal deep = m{0}.deep\n", n + 1);
        std::fs::write(folder.join(format!("m{n}.alb")), text).unwrap();
    }
    std::fs::write(folder.join("m100.alb"), "const x = 1\nsignal deep = depth > 1 m\n").unwrap();
    std::fs::write(folder.join("base.alb"), "const one = 1\n").unwrap();
    let main = "use base, m0\nconst all = m0.x + base.one\nfn f() -> Int { all }\n\
        behavior b() { wait until m0.deep and f() > 0 }\n";
    std::fs::write(folder.join("main.alb"), main).unwrap();
    assert!(told(&folder).contains("no errors"), "{}", told(&folder));
}

/// A project may have a script with the name of a module of the standard library, which goes on to be made of its own.
#[test]
fn the_standard_library_imports_its_own() {
    let folder = folder("standard");
    std::fs::write(folder.join("search.alb"), "const ours = 1\n").unwrap();
    std::fs::write(
        folder.join("main.alb"),
        "use cpt, search\nfn f(s: cpt.Source) -> Int { if s.at_edge { search.ours } else { 0 } }\n",
    )
    .unwrap();
    assert!(told(&folder).contains("no errors"), "{}", told(&folder));
}
