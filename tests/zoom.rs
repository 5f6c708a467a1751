//! `run --zoom`: the picture of a time of a run.

use std::path::Path;
use std::process::{Command, Stdio};

/// The picture shows that time alone, and a time after the end is told.
#[test]
fn a_picture_shows_the_time_that_is_asked_for() {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("zoom");
    let ran = |words: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.args(["run", "missions/box.alb"]).args(words).current_dir(env!("CARGO_MANIFEST_DIR"));
        let output = command.stdin(Stdio::null()).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let picture = |words: &[&str]| {
        let _ = std::fs::remove_dir_all(&out);
        let (code, told) = ran(&[&["--out", out.to_str().unwrap()], words].concat());
        assert_eq!(code, Some(0), "{told}");
        (std::fs::read_to_string(out.join("run.svg")).unwrap(), told)
    };
    let (whole, _) = picture(&[]);
    let (part, told) = picture(&["--zoom", "10s..30s"]);
    assert!(part.contains("shown: 10.0 s to 30.0 s") && part.len() < whole.len(), "{part}");
    assert!(!told.contains("warning"), "{told}");
    // The depth is that of the same time, and the end is not in it.
    for (picture, ends, last) in [(&whole, true, ">9</text>"), (&part, false, ">0.50</text>")] {
        assert!(picture.contains(">depth (m)</text>") && picture.contains(last), "{picture}");
        assert_eq!(picture.matches(">true bottom</text>").count(), 1, "{picture}");
        assert_eq!(picture.contains("stroke-linejoin=\"round\"/>\n<circle"), ends, "{picture}");
    }
    let (empty, told) = picture(&["--zoom", "1h..2h"]);
    assert!(empty.contains("the run was over before") && !empty.contains(">depth (m)</text>"), "{empty}");
    assert!(told.contains("warning: nothing is in the picture: the run was over after"), "{told}");
    let (code, told) = ran(&["--no-out", "--zoom", "1s..2s"]);
    assert_eq!(code, Some(2), "{told}");
}
