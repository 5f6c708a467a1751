//! What a person reads when a script is wrong: one script for each kind of mistake, its messages the snapshot.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn diagnostics() {
    insta::glob!("diagnostics/*.alb", |path| insta::assert_snapshot!(told(path, &[])));
}

/// What is told only when it is asked for.
#[test]
fn notes() {
    insta::glob!("diagnostics/notes/*.alb", |path| {
        let told_without = told(path, &[]);
        assert!(told_without.contains(": no errors"), "a note is no finding: {told_without}");
        insta::assert_snapshot!(told(path, &["--notes"]));
    });
}

fn told(path: &Path, options: &[&str]) -> String {
    let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
        .arg("check")
        .args(options)
        .arg(path)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("NO_COLOR", "1")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert!(output.stdout.is_empty(), "findings go to standard error");
    String::from_utf8(output.stderr).unwrap()
}
