//! What a person reads when a script is wrong: one script for each kind of mistake, its messages the snapshot.

use std::process::{Command, Stdio};

#[test]
fn diagnostics() {
    insta::glob!("diagnostics/*.alb", |path| {
        let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
            .arg("check")
            .arg(path)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .env("NO_COLOR", "1")
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(output.stdout.is_empty(), "findings go to standard error");
        insta::assert_snapshot!(String::from_utf8(output.stderr).unwrap());
    });
}
