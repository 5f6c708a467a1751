//! `check --cost`: what a mission costs at most, and where it comes from.

use std::process::Command;

#[test]
fn the_cost_of_a_mission() {
    let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
        .args(["check", "--cost", "tests/cost/soundings.alb"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the program that was just built starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    insta::assert_snapshot!("soundings", String::from_utf8_lossy(&output.stdout));
}
