//! Snapshots that `albacore test` keeps: which are accepted, and which are left as they are.

use super::{Project, SCRIPT};
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn a_snapshot_that_cannot_be_read_is_said() {
    let project = Project::new("unreadable", "20 s", "30 m");
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let no_file = "cannot be read: it is no ordinary file";
    std::fs::write(&file, b"\xff\xfe").unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains("cannot be read: it is no text in UTF-8"), "{said}");
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(1) && said.contains("is there already, and it is no text in UTF-8"), "{said}");
    assert_eq!(std::fs::read(&file).unwrap(), b"\xff\xfe");
    std::fs::remove_file(&file).unwrap();
    assert!(Command::new("mkfifo").arg(&file).status().unwrap().success());
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains(no_file), "{said}");
    std::fs::remove_file(&file).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &file).unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains(no_file) && !said.contains("there is no snapshot"), "{said}");
}

#[test]
fn what_was_accepted_passes() {
    let project = Project::new("accepted", "10 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("wrote ./snapshots/north-goes_north-2.trace"), "{said}");
    assert!(project.snapshot().unwrap().contains("report"));
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("1 passed, 0 failed"), "{said}");
}

/// A file's name cannot be as long as a test's may be.
#[test]
fn a_test_with_a_long_name_has_its_snapshot() {
    let project = Project::new("long", "10 s", "5 m");
    for (first, second, script) in [("a", "b", "north.alb"), ("c", "d", "LONG.alb")] {
        let long = "a very long name ".repeat(20);
        let text = SCRIPT.replace("SECONDS", "10 s").replace("METRES", "5 m");
        let (head, test) = text.split_once("test \"goes north\"").unwrap();
        let both = format!("{head}test \"{long}{first}\"{test}");
        let both = format!("{both}\ntest \"{long}{second}\"{test}");
        let _ = std::fs::remove_dir_all(project.0.join("snapshots"));
        std::fs::remove_file(project.0.join("north.alb")).unwrap_or_default();
        std::fs::write(project.0.join(script.replace("LONG", &"ö".repeat(120))), both).unwrap();
        let (code, said) = project.test(&["--accept"]);
        assert!(code == Some(0) && said.contains("2 passed"), "{said}");
        assert_eq!(std::fs::read_dir(project.0.join("snapshots")).unwrap().count(), 2);
        assert_eq!(project.test(&[]).0, Some(0));
    }
}

/// What has the name of a snapshot and is none is somebody's own.
#[test]
fn what_is_no_trace_is_not_written_over() {
    let project = Project::new("theirs", "10 s", "5 m");
    std::fs::create_dir(project.0.join("snapshots")).unwrap();
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    std::fs::write(&file, "my notes").unwrap();
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(1) && said.contains("is there already, and its line 1 is none of a trace"), "{said}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "my notes");
}

/// A file that begins like a snapshot may be somebody's notes on it; one that a merge left with its marks is a snapshot.
#[test]
fn what_somebody_wrote_into_a_snapshot_is_not_written_over() {
    let project = Project::new("annotated", "10 s", "5 m");
    project.test(&["--accept"]);
    let accepted = project.snapshot().unwrap();
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let (head, rest) = accepted.split_once('\n').unwrap();
    let stale = rest.replace("end", "END").replace("0.1 s", "0.2 s");
    for (text, line) in [
        (format!("{head}\nmy notes\n"), Some(2)),
        (format!("{accepted}# it turns too late\n"), Some(accepted.lines().count() + 1)),
        (format!("{head}\n    1.x s  at\n"), Some(2)),
        (format!("{head}\n{stale}"), None),
        (format!("{head}\n<<<<<<< ours\n{rest}||||||| base\n=======\n{stale}>>>>>>> theirs\n"), None),
        (format!("<<<<<<< ours\r\n{head}\r\n=======\r\n{head}1\r\n>>>>>>> theirs\r\n\r\n{rest}"), None),
        (String::new(), None),
    ] {
        std::fs::write(&file, &text).unwrap();
        // Nobody is advised to do what is refused.
        let (code, said) = project.test(&[]);
        let same = text.starts_with(&accepted);
        if let Some(line) = line {
            let what = format!("line {line} of `./snapshots/north-goes_north-2.trace` is none of a trace");
            assert!(code == Some(1) && said.contains(&what) && !said.contains("--accept"), "{text}: {said}");
            assert_eq!(said.contains("behaved differently"), !same, "{text}: {said}");
            assert!(!said.contains("numerically different"), "{text}: {said}");
        }
        let (code, said) = project.test(&["--accept"]);
        match line {
            Some(line) => {
                let why = format!("is there already, and its line {line} is none of a trace");
                assert!(code == Some(1) && said.contains(&why) && said.contains("move it away"), "{text}: {said}");
                assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
                std::fs::rename(&file, file.with_extension("mine")).unwrap();
                assert_eq!(project.test(&["--accept"]).0, Some(0), "the fix that is offered works");
            }
            None => assert_eq!(code, Some(0), "{text}: {said}"),
        }
        assert_eq!(project.snapshot().as_deref(), Some(accepted.as_str()), "{text}");
    }
}

#[test]
fn the_snapshot_of_a_test_that_fails_is_not_accepted() {
    let project = Project::new("accept-fails", "10 s", "10 cm");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!((code, said.contains("what fails is not accepted")), (Some(1), true), "{said}");
    assert_eq!(project.snapshot(), None);
    // Nor does it replace one that was accepted.
    project.write("10 s", "5 m");
    project.test(&["--accept"]);
    let accepted = project.snapshot();
    project.write("11 s", "10 cm");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(1), "{said}");
    assert_eq!((project.snapshot().is_some(), project.snapshot()), (true, accepted));
    // Nor is that advised.
    let (code, said) = project.test(&[]);
    let advised = said.contains("albacore test --accept");
    assert_eq!((code, advised, said.contains("mend the test or the mission first")), (Some(1), false, true), "{said}");
}

/// A comment above a table moves its rules, and nothing else.
#[test]
fn rules_on_other_lines_are_told_as_such() {
    let project = Project::new("lines", "10 s", "5 m");
    let table = "\nstrategy s() {\n    behavior a { steer north for 1 s at depth 3 m, speed 1 m/s }\n    start a\n    a -> finish on done\n}\n";
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    let script = script.replacen("    steer", "    s()\n    steer", 1) + table;
    std::fs::write(project.0.join("north.alb"), &script).unwrap();
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    std::fs::write(project.0.join("north.alb"), format!("// {}\n{script}", "a comment\n// ".repeat(90))).unwrap();
    let (code, said) = project.test(&[]);
    assert!(code == Some(1) && said.contains("same behavior, by rules on other lines"), "{said}");
}

/// Version control may write other line ends than these, and an editor may leave the last one out.
#[test]
fn the_ends_of_lines_are_no_part_of_a_snapshot() {
    let project = Project::new("line-ends", "10 s", "5 m");
    project.test(&["--accept"]);
    let file = project.0.join("snapshots/north-goes_north-2.trace");
    let accepted = project.snapshot().unwrap();
    let short = accepted.trim_end().to_string();
    for text in [accepted.replace('\n', "\r\n"), short.replace('\n', "\r\n"), short] {
        std::fs::write(&file, &text).unwrap();
        let (code, said) = project.test(&[]);
        assert_eq!(code, Some(0), "{said}");
    }
    // What else differs is shown, though it be a blank line.
    std::fs::write(&file, format!("{accepted}\n")).unwrap();
    let (code, said) = project.test(&[]);
    assert!(
        code == Some(1)
            && said.contains("the same, but for blank lines")
            && said.contains("- (an empty line)")
            && said.contains("+ (nothing more)"),
        "{said}"
    );
}

/// The command that a message gives accepts what the message is of, typed as it stands, and nothing else: whatever the paths are
/// called, and wherever they are.
#[test]
fn the_command_that_is_given_accepts_what_was_looked_at() {
    let project = Project::new("advice", "10 s", "5 m");
    let script = std::fs::read_to_string(project.0.join("north.alb")).unwrap();
    let odd = "o'er $HOME `there`";
    for folder in ["missions", "other", odd, "-x"] {
        std::fs::create_dir(project.0.join(folder)).unwrap();
        std::fs::write(project.0.join(folder).join("fast.alb"), &script).unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_albacore"));
    let run = |mut command: Command| {
        let output = command.current_dir(&project.0).env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        (output.status.code(), said)
    };
    let test = |arguments: &[&str]| {
        let mut command = Command::new(program);
        command.arg("test").args(arguments);
        run(command)
    };
    let snapshot = |folder: &str| project.0.join(folder).join("snapshots/fast-goes_north-2.trace");
    // A regression that nobody has looked at.
    assert_eq!(test(&["missions", "--accept"]).0, Some(0));
    let accepted = std::fs::read_to_string(snapshot("missions")).unwrap().replace("enter", "ENTER");
    std::fs::write(snapshot("missions"), &accepted).unwrap();
    for (arguments, folder, words) in [
        (&["other/fast.alb"][..], "other", "other/fast.alb"),
        (&[odd], odd, r"'o'\''er $HOME `there`'"),
        (&["--filter", "goes north", "other/fast.alb"], "other", "--filter='goes north' other/fast.alb"),
        (&["--", "-x"], "-x", "-- -x"),
    ] {
        for is_there in [false, true] {
            match is_there {
                false => drop(std::fs::remove_dir_all(snapshot(folder).parent().unwrap())),
                true => std::fs::write(snapshot(folder), accepted.replace("ENTER", "leave")).unwrap(),
            }
            let (code, said) = test(arguments);
            let before = if is_there { "when this is right: `" } else { "look at the run, then `" };
            let advice = said.lines().find_map(|line| line.trim().strip_prefix(before)).unwrap_or_default();
            let advice = advice.strip_suffix('`').unwrap_or_default();
            assert_eq!((code, advice), (Some(1), format!("albacore test --accept {words}").as_str()), "{said}");
            let mut shell = Command::new("sh");
            let path = std::env::join_paths([program.parent().unwrap(), Path::new("/usr/bin"), Path::new("/bin")]);
            shell.args(["-c", advice]).env("PATH", path.unwrap());
            let (code, said) = run(shell);
            assert_eq!(code, Some(0), "{advice}: {said}");
            assert_eq!(test(arguments).0, Some(0), "{advice}");
            assert_eq!(std::fs::read_to_string(snapshot("missions")).unwrap(), accepted, "{advice}");
        }
    }
    // Where nothing was named nothing is.
    let (code, said) = test(&[]);
    assert!(code == Some(1) && said.contains("when this is right: `albacore test --accept`\n"), "{said}");
    // What a terminal obeys is written so that a shell reads it.
    std::fs::rename(project.0.join("-x"), project.0.join("e\u{1b}'")).unwrap();
    std::fs::remove_dir_all(project.0.join("e\u{1b}'/snapshots")).unwrap();
    let (code, said) = test(&["e\u{1b}'"]);
    assert!(code == Some(1) && said.contains(r"`albacore test --accept $'e\x1b\''`"), "{said}");
}

/// A snapshot may be kept elsewhere: what a link leads to is the snapshot, and the link stays.
#[test]
fn a_snapshot_behind_a_link_is_accepted_behind_it() {
    let project = Project::new("linked", "10 s", "5 m");
    project.test(&["--accept"]);
    let (file, kept) = (project.0.join("snapshots/north-goes_north-2.trace"), project.0.join("kept.trace"));
    std::fs::rename(&file, &kept).unwrap();
    std::os::unix::fs::symlink("../kept.trace", &file).unwrap();
    project.write("11 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(file.is_symlink() && std::fs::read_to_string(&kept).unwrap().contains("11.1 s  report"), "{said}");
    assert_eq!(project.test(&[]).0, Some(0));
    // One that leads nowhere is left, and so is another name of the file before.
    std::fs::hard_link(&kept, project.0.join("named.trace")).unwrap();
    project.write("10 s", "5 m");
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(0) && said.contains("trace` had another name (a hard link)"), "{said}");
    assert!(std::fs::read_to_string(project.0.join("named.trace")).unwrap().contains("11.1 s  report"));
    std::fs::remove_file(&kept).unwrap();
    let (code, said) = project.test(&["--accept"]);
    assert!(code == Some(4) && said.contains("is a link that leads nowhere") && file.is_symlink(), "{said}");
}

/// Each row has its snapshots.
#[test]
fn the_snapshots_of_rows_are_told_apart() {
    let project = Project::new("rows-kept", "10 s", "5 m");
    let with_rows = |rows: &str| {
        let script = include_str!("rows.alb");
        let test =
            format!("test \"kept\" {{\n    run legs in still seeds 1..1\n{rows}    snapshot switches of seed 1\n}}\n");
        std::fs::write(project.0.join("north.alb"), script.split("test ").next().unwrap().to_string() + &test).unwrap();
    };
    with_rows("    with lasting: 10 s\n    with lasting: 20 s\n");
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    let kept =
        |row: &str| std::fs::read_to_string(project.0.join(format!("snapshots/north-kept.{row}-1.trace"))).unwrap();
    assert_ne!(kept("1"), kept("2"));
    assert_eq!(project.test(&[]).0, Some(0));
    with_rows("    with lasting: 10 s\n    with lasting: 30 s\n");
    let (code, said) = project.test(&[]);
    assert_eq!((code, said.contains("seed 1 with lasting: 30 s: numerically different")), (Some(1), true), "{said}");
}

/// An attack: the second row of a test of `a.alb` had the snapshot of a test of `a-t.alb`, and `--accept` wrote one over the other.
#[test]
fn no_two_scripts_share_a_snapshot() {
    let project = Project::new("shared", "10 s", "5 m");
    std::fs::remove_file(project.0.join("north.alb")).unwrap();
    let mission = include_str!("rows.alb").split("test ").next().unwrap();
    let snapshot = "    snapshot switches of seed 1\n}\n";
    let run = "    run legs in still seeds 1..1\n";
    let rows = format!("{mission}test \"t\" {{\n{run}    with lasting: 10 s\n    with lasting: 20 s\n{snapshot}");
    std::fs::write(project.0.join("a.alb"), rows).unwrap();
    std::fs::write(project.0.join("a-t.alb"), format!("{mission}test \"2\" {{\n{run}{snapshot}")).unwrap();
    assert_eq!(project.test(&["--accept"]).0, Some(0));
    assert_eq!(std::fs::read_dir(project.0.join("snapshots")).unwrap().count(), 3);
    let (code, said) = project.test(&[]);
    assert_eq!(code, Some(0), "{said}");
}
