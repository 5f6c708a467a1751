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
