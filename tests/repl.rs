//! `albacore repl`, its lines from a pipe: what a session answers, good lines and wrong ones in one stream.

#![expect(clippy::unwrap_used, reason = "a test that cannot start the binary has failed")]

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// A session at the root of the repository, both its outputs in one file, as on a terminal.
fn session(args: &[&str], out: &Path) -> Command {
    let both = std::fs::File::create(out).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.arg("repl").args(args).current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1");
    command.stdin(Stdio::piped()).stdout(both.try_clone().unwrap()).stderr(both);
    command
}

fn out(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("repl-{name}.txt"))
}

/// What a session answers to the lines of `tests/repl/NAME.txt`, and with what it ends.
fn answers(name: &str, args: &[&str]) -> (Option<i32>, String) {
    let lines = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/repl").join(name).with_extension("txt");
    let out = out(name);
    let mut child = session(args, &out).spawn().unwrap();
    child.stdin.take().unwrap().write_all(&std::fs::read(lines).unwrap()).unwrap();
    let code = child.wait().unwrap().code();
    (code, std::fs::read_to_string(out).unwrap())
}

#[test]
fn drives_goes_back_and_drives_again() {
    let (code, answers) = answers("drives", &[]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(0));
}

#[test]
fn a_mission_is_driven_and_looked_into() {
    let (code, answers) = answers("mission", &["missions/duck_single.alb"]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(0));
}

#[test]
fn time_is_travelled_and_two_ways_are_compared() {
    let (code, answers) = answers("travels", &["missions/duck_single.alb"]);
    insta::assert_snapshot!(answers);
    // Some of its lines are refused.
    assert_eq!(code, Some(3));
}

/// Traces a plume, goes back to before a turn, changes a parameter, forks, compares, and saves what it did as a test, which passes.
#[test]
fn a_session_becomes_a_test_that_passes() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("repl-saved");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::copy("missions/duck_single.alb", folder.join("duck_single.alb")).unwrap();
    let lines = "start\nrun until track_out\nfork before\nback 5 s\nset lambda = 4 s\nrun\ncompare before\n\
                 plot chemical, depth to series.svg\nsave test \"with 4 s\" to saved.alb\nsave test \"again\" to saved.alb\n";
    let out = out("saved");
    let mut child = session(&["duck_single.alb"], &out).current_dir(&folder).spawn().unwrap();
    child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
    let code = child.wait().unwrap().code();
    let answers = std::fs::read_to_string(out).unwrap();
    assert_eq!(code, Some(0), "{answers}");
    assert!(answers.contains("end      completed") && answers.contains("written to saved.alb"), "{answers}");
    assert!(answers.contains("could not be written") || answers.contains("choose another file"), "{answers}");
    let saved = std::fs::read_to_string(folder.join("saved.alb")).unwrap();
    assert!(saved.contains("run duck_single.duck_single(lambda: 4 s) in duck_2003 seeds 1..1"), "{saved}");
    assert!(std::fs::read_to_string(folder.join("series.svg")).unwrap().starts_with("<svg"));
    let mut test = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let tested = test.args(["test", "saved.alb"]).current_dir(&folder).output().unwrap();
    assert_eq!(tested.status.code(), Some(0), "{saved}\n{}", String::from_utf8_lossy(&tested.stderr));
}

/// A run that is over is gone through at the prompt: its journal holds all of it.
#[test]
fn a_run_that_is_over_is_gone_through() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("repl-past");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::copy("tests/past/patrol.alb", folder.join("patrol.alb")).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_albacore"));
    let ran = run.args(["run", "patrol.alb", "--out", "dive"]).current_dir(&folder).output().unwrap();
    assert_eq!(ran.status.code(), Some(0));
    std::fs::remove_file(folder.join("patrol.alb")).unwrap();
    let lines = "run until back\nwhy\nposition\nlegs\nlet home = op.center\nrun 10 s\ndistance(position, home)\nback 20 s\n\
                 goto home\nstart\nset patience = 12 s\nfork kept\nreload\nplot altitude\nwhy 5 s\nrun\nwhy\nrun\n\
                 switch to kept\nset patience = 60 s\nrun\nwhy\nset patience = 5 s\nwhy 25 s\nsave test \"x\" to x.alb\n";
    for named in ["dive", "dive/journal"] {
        let out = out("past");
        let mut child = session(&[named], &out).current_dir(&folder).spawn().unwrap();
        child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(3), "some lines are refused");
        insta::assert_snapshot!("a_run_that_is_over", std::fs::read_to_string(out).unwrap());
    }
}

/// A script that is edited while its mission is under way is read again.
#[test]
fn an_edited_script_is_read_again() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("repl-reload");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let script = std::fs::read_to_string("tests/past/patrol.alb").unwrap();
    std::fs::write(folder.join("patrol.alb"), &script).unwrap();
    let out = out("reload");
    let mut child = session(&["patrol.alb"], &out).current_dir(&folder).spawn().unwrap();
    let mut lines = child.stdin.take().unwrap();
    let answers = |text: &str| {
        // What was typed has been answered when this stands there.
        while !std::fs::read_to_string(&out).unwrap().contains(text) {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
    };
    lines.write_all(b"let far = 30 m\nwith depth 4 m\nstart\nrun 30 s\n").unwrap();
    answers("   30.1 s  at");
    std::fs::write(folder.join("patrol.alb"), script.replace("= 20 s in", "= 10 s in")).unwrap();
    lines.write_all(b"reload\nfar\n\"asked\"\n").unwrap();
    answers("asked");
    std::fs::write(folder.join("patrol.alb"), "mission").unwrap();
    lines.write_all(b"reload\nbehavior\n").unwrap();
    drop(lines);
    assert_eq!(child.wait().unwrap().code(), Some(3));
    let answers = std::fs::read_to_string(&out).unwrap();
    assert!(answers.contains("run again from its start") && answers.contains("10.0 s earlier"), "{answers}");
    assert!(
        answers.contains("30 m") && answers.contains("mission needs a name") || answers.contains("1 error"),
        "{answers}"
    );
    assert!(answers.trim_end().ends_with("patrol > out") || answers.trim_end().ends_with("patrol > back"), "{answers}");
}

#[test]
fn what_is_declared_is_known() {
    let (code, answers) = answers("declares", &[]);
    insta::assert_snapshot!(answers);
    // Some of its lines are refused.
    assert_eq!(code, Some(3));
}

#[test]
fn what_var_names_is_assigned_as_in_a_script() {
    let (code, answers) = answers("assigns", &[]);
    insta::assert_snapshot!(answers);
    // Some of its lines are refused.
    assert_eq!(code, Some(3));
}

#[test]
fn several_statements_of_a_line_are_done_in_order() {
    let (code, answers) = answers("several", &[]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(3));
}

#[test]
fn what_is_put_in_force_is_computed_once() {
    let (code, answers) = answers("in_force", &[]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(3));
}

#[test]
fn edges_belong_to_their_area() {
    let (code, answers) = answers("edges", &[]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(0));
}

#[test]
fn an_area_at_the_prompt_has_as_many_corners_as_there_is_room_for() {
    let corner = |i: u32| format!("point({} m, {} m)", i * i, 10 * i);
    let polygon = |n: u32| format!("let a{n} = polygon([{}])\n", (0..n).map(corner).collect::<Vec<_>>().join(", "));
    let out = out("room");
    let mut child = session(&[], &out).spawn().unwrap();
    child.stdin.take().unwrap().write_all((polygon(5) + &polygon(17) + "a5\n").as_bytes()).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(3));
    let said = std::fs::read_to_string(&out).unwrap();
    assert!(said.contains("an area may have 17 corners here, and those of this session have 16 at most"), "{said}");
    assert!(said.ends_with("area of 5 corners\n"), "{said}");
}

#[test]
fn bytes_that_are_no_text_are_left_out() {
    let out = out("bytes");
    let mut child = session(&[], &out).spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"1 m + 1 m\nlet \xb0 = 3 m\n3 m + 4 m\n").unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(3));
    let said = std::fs::read_to_string(&out).unwrap();
    assert!(
        said.contains("2 m\n") && said.contains("line 2 of standard input is no text") && said.ends_with("7 m\n"),
        "{said}"
    );
}

#[test]
fn wrong_lines_are_told_and_change_nothing() {
    let (code, answers) = answers("wrong", &[]);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(3));
}

#[test]
fn what_goes_wrong_is_told_and_a_vehicle_that_leaks_is_lost() {
    let faults = ["--fault", "fault(altitude, off, from: 10 s, to: 15 s)", "--fault", "leak, from: 30 s"];
    let (code, answers) = answers("faults", &faults);
    insta::assert_snapshot!(answers);
    assert_eq!(code, Some(3));
}

#[test]
fn a_fault_that_is_none_opens_no_session() {
    for (fault, code, why) in
        [("leek", 3, "did you mean `leak`?"), ("leak, from: 9 s, to: 8 s", 3, "make `to` later than `from`")]
    {
        let out = out("no-fault");
        let mut child = session(&["--fault", fault], &out).spawn().unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(code), "{fault}");
        let said = std::fs::read_to_string(&out).unwrap();
        assert!(said.contains(why), "{fault}: {said}");
    }
}

#[test]
#[cfg(unix)]
fn an_interruption_stops_the_vehicle_and_not_the_session() {
    let out = out("interrupted");
    let mut child = session(&["missions/duck_single.alb"], &out).spawn().unwrap();
    let mut lines = child.stdin.take().unwrap();
    // Its answer to the first line shows that it listens. What comes then takes a quarter of an hour of ours: whenever the
    // interruption comes, it comes in the middle, and all that would have followed on the line is left out too.
    lines.write_all(b"1 m + 1 m\n").unwrap();
    lines.write_all(format!("{}\n", ["steer 90 deg for 9 h"; 200].join("; ")).as_bytes()).unwrap();
    let mut said = String::new();
    while !said.contains("2 m") {
        assert_eq!(child.try_wait().unwrap(), None, "{said}");
        std::thread::sleep(std::time::Duration::from_millis(10));
        said.clear();
        std::fs::File::open(&out).unwrap().read_to_string(&mut said).unwrap();
    }
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupt.success());
    lines.write_all(b"behavior\n3 m + 4 m\n").unwrap();
    drop(lines);
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let said = std::fs::read_to_string(&out).unwrap();
    assert!(said.contains("stopped\nnothing is under way\n7 m\n"), "{said}");
}
