//! The standard library does what its pages say: scripts in `tests/library`, each with the tests that it must pass.

use std::process::{Command, Stdio};

#[test]
fn what_the_library_promises_holds() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["test", "tests/library"]).current_dir(env!("CARGO_MANIFEST_DIR"));
    let output = command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{said}");
}
