//! `check --cost`: what a mission costs at most, and where it comes from.

#![expect(clippy::unwrap_used, reason = "a test that cannot start its own program has failed")]

use std::process::Command;

#[test]
fn the_costs_of_missions() {
    insta::glob!("cost/*.alb", |path| {
        let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
            .args(["check", "--cost"])
            .arg(path)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap());
    });
}
