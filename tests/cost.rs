//! `check --cost`: what a mission costs at most, and where it comes from; and what costs too much.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use std::path::Path;
use std::process::Command;

#[test]
fn cost() {
    insta::glob!("cost/*.alb", |path| insta::assert_snapshot!(told(path)));
}

fn told(path: &Path) -> String {
    let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
        .args(["check", "--cost"])
        .arg(path)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap()
}
