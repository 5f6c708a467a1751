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

/// Names that nobody can read to their end are shortened, wherever they are quoted.
#[test]
fn long_names_make_no_long_messages() {
    let [a, b, c] = ["a", "b", "c"].map(|letter| letter.repeat(100_000));
    let script = format!("behavior {a}() {{\n    goto {b}\n    {c}()\n    wait for 1 {c}\n}}\nuse {a}\n");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("long_names.alb");
    std::fs::write(&path, script).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_albacore")).arg("check").arg(&path).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("nothing is named `bbbbbbbb") && said.contains("`cccccccc"), "{said}");
    assert!(said.lines().all(|line| line.chars().count() < 300), "{said}");
}

/// What a goal is made of is followed through names and functions, as far as any stack holds.
#[cfg(unix)]
#[test]
fn a_goal_behind_a_long_chain_of_names_ends_no_check() {
    let lets: String = (0..3000).map(|i| format!("    let p{} = p{i} + 1 m toward north\n", i + 1)).collect();
    let sum = " + 1 m toward north".repeat(30);
    let fns: String = (0..100).map(|i| format!("fn f{}(p: Point) -> Point {{ f{i}(p{sum}){sum} }}\n", i + 1)).collect();
    let script = format!(
        "mission deep in calm within 1 h {{
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 500 m, width: 500 m)
    limits {{ altitude >= 2 m, speed <= 2 m/s }}
    requires {{ position, course, heading fresh 5 s, else abort }}
    recovery within 1 min {{ goto op.center }}
    with depth 3 m, speed 1 m/s
    let p0 = op.center\n{lets}    goto p3000\n    goto f100(op.center)\n}}\nfn f0(p: Point) -> Point {{ p }}\n{fns}"
    );
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("long_chain.alb");
    std::fs::write(&path, script).unwrap();
    let limited = "ulimit -s 2048; exec \"$0\" check \"$1\"";
    let mut shell = Command::new("sh");
    shell.args(["-c", limited, env!("CARGO_BIN_EXE_albacore")]).arg(&path);
    let output = shell.stdin(Stdio::null()).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(0) && said.contains("no errors"), "{said}");
}

/// A file in another encoding is one mistake, not one for each of its bytes.
#[test]
fn what_is_no_text_is_told_once() {
    let script = "// Tiefe 3 m, öffnet nichts.\nconst shoal: Depth = 3 m\n";
    let wide = |order: fn(u16) -> [u8; 2]| script.encode_utf16().flat_map(order).collect::<Vec<u8>>();
    let marked = |mark: [u8; 2], bytes: Vec<u8>| [mark.to_vec(), bytes].concat();
    let four = |order: fn(u32) -> [u8; 4]| script.chars().map(u32::from).flat_map(order).collect::<Vec<u8>>();
    let utf32 = "is UTF-32\n  help: save it as UTF-8\n";
    let utf16 = "is UTF-16\n  help: save it as UTF-8\n";
    let cases = [
        ("little", wide(u16::to_le_bytes), utf16),
        ("big", wide(u16::to_be_bytes), utf16),
        ("little-marked", marked([0xFF, 0xFE], wide(u16::to_le_bytes)), utf16),
        ("big-marked", marked([0xFE, 0xFF], wide(u16::to_be_bytes)), utf16),
        ("four-little", four(u32::to_le_bytes), utf32),
        ("four-big", four(u32::to_be_bytes), utf32),
        ("four-little-marked", [vec![0xFF, 0xFE, 0, 0], four(u32::to_le_bytes)].concat(), utf32),
        ("four-big-marked", [vec![0, 0, 0xFE, 0xFF], four(u32::to_be_bytes)].concat(), utf32),
        ("zeros", vec![0; 4096], "is no text: it is full of bytes that are zero\n  help: save it as UTF-8\n"),
    ];
    for (name, bytes, expected) in cases {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("no-text-{name}.alb"));
        std::fs::write(&path, bytes).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_albacore")).arg("check").arg(&path).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(said, format!("error: `{}` {expected}", path.display()));
    }
}
