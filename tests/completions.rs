//! `albacore completions`: each shell is told of every verb.

#![expect(clippy::unwrap_used, reason = "a test that cannot run the program has failed")]

use std::process::{Command, Stdio};

fn albacore(arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let output = command.args(arguments).stdin(Stdio::null()).output().unwrap();
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_shell_completes_every_verb() {
    let help = albacore(&["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // A line that goes on is indented further.
    let verbs: Vec<&str> =
        lines.filter(|l| !l.starts_with("   ")).filter_map(|l| l.split_whitespace().next()).collect();
    assert!(verbs.contains(&"run") && verbs.contains(&"completions"), "{verbs:?}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = albacore(&["completions", shell]);
        for verb in &verbs {
            let told = script.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == *verb);
            assert!(told, "{shell} is not told of `{verb}`");
        }
    }
}
