//! `albacore completions`: each shell's script knows every verb.

#![expect(clippy::unwrap_used, reason = "a test that cannot start the binary has failed")]

use std::process::{Command, Stdio};

fn albacore(args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let output = command.args(args).env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
    (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
}

/// The verbs that `--help` lists.
fn verbs() -> Vec<String> {
    let (_, help) = albacore(&["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // A description that goes on is indented deeper than a verb.
    let verbs = lines.filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')));
    verbs.filter_map(|line| line.split_whitespace().next().map(str::to_string)).collect()
}

#[test]
fn every_shell_knows_every_verb() {
    let verbs = verbs();
    assert!(verbs.len() > 9 && verbs.iter().any(|verb| verb == "completions"), "{verbs:?}");
    // Where a verb's options begin: its bare name may stand in any description.
    let shells = [
        ("bash", "albacore,VERB)"),
        ("zsh", "(VERB)"),
        ("fish", "-a \"VERB\""),
        ("elvish", "'albacore;VERB'"),
        ("powershell", "'albacore;VERB'"),
    ];
    for (shell, place) in shells {
        let (code, script) = albacore(&["completions", shell]);
        assert_eq!(code, Some(0), "{shell}: {script}");
        for verb in &verbs {
            assert!(script.contains(&place.replace("VERB", verb)), "{shell} does not know `{verb}`");
        }
    }
}

#[test]
fn a_shell_that_is_none_is_told_which_there_are() {
    let (code, said) = albacore(&["completions", "tcsh"]);
    assert_eq!((code, said.contains("bash, elvish, fish, powershell, zsh")), (Some(2), true), "{said}");
}
