//! Campaigns through the binary: the same table on any number of threads and after any interruption, never a mixed one.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot write its own files has failed")]
#![cfg(unix)]

mod shell;

use albacore_trace::Digest;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

const BOX: &str = "missions/box.alb";

/// A mission that reports under two names, one of them three times in each run, and depends on its seed.
const REPORTING: &str = r#"
mission reporting(leg: Duration = 10 s) in choppy within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    with depth 3 m, speed 1 m/s
    for bearing in [0 deg, 90 deg, 180 deg] {
        steer bearing for leg
        report "turn": position
    }
    report "end, of \"all\"": position
}

scenario choppy {
    bottom(from: 20 m, to: 20 m)
    region(rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m))
    flow(10 cm/s toward 90 deg)
    plume(growth: 1e-4 m2/s)
    source("vent", at: point(north: 30 m, east: 0 m))
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
    navigation(dead_reckoning(walk: 0.1 m/s^0.5))
}
"#;

/// A mission that ends badly, for a reason that no table likes, but on which no run is lost.
const ABORTING: &str = "
mission aborting in still within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 200 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position fresh 5 s, else abort }
    with depth 3 m, speed 1 m/s
    wait for 1 s
    abort \"no, \\\"never\\\"\" on true
    wait for 1 min
}

scenario still {
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
}
";

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaign").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn command(script: &str, seeds: &str, out: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["campaign", script, "--seeds", seeds, "--out"]).arg(out).args(more);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs a campaign that must end well; gives its table.
#[track_caller]
fn table(script: &str, seeds: &str, out: &Path, more: &[&str]) -> String {
    let output = command(script, seeds, out, more).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    std::fs::read_to_string(out).unwrap()
}

/// Runs a campaign that must not, and leave the file as it is.
#[track_caller]
fn refused(script: &str, seeds: &str, out: &Path, more: &[&str], code: i32, said: &str) {
    let before = std::fs::read(out).ok();
    let output = command(script, seeds, out, more).output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{seeds} {more:?}: {text}");
    assert!(text.contains(said), "{seeds} {more:?} should say `{said}`: {text}");
    assert_eq!(std::fs::read(out).ok(), before, "{seeds} {more:?}: the file was changed");
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Writes a script into a folder.
fn script(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// Starts a campaign that takes its time, and comes back when its table has some rows.
fn under_way(out: &Path, rows: usize) -> Child {
    let child = command(BOX, "1..3000", out, &["--threads", "2"]).spawn().unwrap();
    for _ in 0..20_000 {
        if std::fs::read(out).is_ok_and(|text| text.iter().filter(|b| **b == b'\n').count() > rows) {
            return child;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the table does not grow: {}", stderr(&child.wait_with_output().unwrap()));
}

/// How many whole rows a table has.
fn rows(text: &str) -> usize {
    text.matches('\n').count().saturating_sub(1)
}

#[test]
fn the_box_with_three_seeds() {
    insta::assert_snapshot!(table(BOX, "1..3", &empty("box").join("box.csv"), &[]));
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let folder = empty("threads");
    let one = table(BOX, "1..40", &folder.join("one.csv"), &["--threads", "1"]);
    assert_eq!(rows(&one), 40);
    assert_eq!(one, table(BOX, "1..40", &folder.join("two.csv"), &["--threads", "2"]));
    assert_eq!(one, table(BOX, "1..<41", &folder.join("seven.csv"), &["--threads", "7"]));
    assert_eq!(one.lines().nth(7), table(BOX, "7", &folder.join("seed.csv"), &[]).lines().nth(1));
}

#[test]
fn who_kills_a_campaign_and_resumes_it_has_the_same_bytes() {
    let folder = empty("killed");
    for kept in [0, 1, 25] {
        let out = folder.join(format!("{kept}.csv"));
        let mut child = under_way(&out, kept);
        child.kill().unwrap();
        child.wait().unwrap();
        let prefix = std::fs::read_to_string(&out).unwrap();
        let seeds = format!("1..{}", rows(&prefix) + 5);
        let resumed = table(BOX, &seeds, &out, &["--resume"]);
        assert!(resumed.starts_with(&prefix));
        assert_eq!(resumed, table(BOX, &seeds, &folder.join(format!("{kept}-whole.csv")), &[]));
        // Once more there is nothing to do.
        assert_eq!(resumed, table(BOX, &seeds, &out, &["--resume"]));
    }
}

#[test]
fn who_interrupts_a_campaign_is_told_how_to_go_on() {
    for signal in ["-INT", "-TERM"] {
        let out = empty(&format!("interrupted{signal}")).join("box.csv");
        let child = under_way(&out, 5);
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{signal}: {said}");
        let text = std::fs::read_to_string(&out).unwrap();
        assert!(text.ends_with('\n'), "{signal}: the last row is torn");
        assert!(said.contains(&format!("has {} of 3000 runs", rows(&text))) && said.contains("--resume"), "{said}");
    }
}

#[test]
fn a_torn_last_line_is_made_whole() {
    let folder = empty("torn");
    let out = folder.join("box.csv");
    let whole = table(BOX, "1..4", &out, &[]);
    let header = whole.find('\n').unwrap();
    for end in [0, 5, header, header + 1, header + 10, whole.len() - 1, whole.len()] {
        std::fs::write(&out, &whole[..end]).unwrap();
        assert_eq!(table(BOX, "1..4", &out, &["--resume"]), whole, "cut at {end}");
    }
    std::fs::remove_file(&out).unwrap();
    assert_eq!(table(BOX, "1..4", &out, &["--resume"]), whole);
}

#[test]
fn a_table_holds_one_campaign() {
    let folder = empty("one");
    let (out, other) = (folder.join("a.csv"), folder.join("b.csv"));
    let mission = script(&folder, "reporting.alb", REPORTING);
    let set = ["--resume", "--set", "leg=5s"];
    table(&mission, "1..3", &out, &[]);
    refused(&mission, "1..5", &out, &[], 2, "--resume");
    refused(&mission, "1..5", &out, &set, 2, "was begun with `no --set`, not `--set leg=5s`");
    refused(&mission, "1..5", &out, &["--resume", "--reports", "2"], 2, "has other columns");
    refused(&mission, "1..5", &out, &["--resume", "--in", "duck_2003"], 2, "the scenario `choppy`, not `duck_2003`");
    refused(BOX, "1..5", &out, &["--resume"], 2, "the mission `reporting`, not `box`");
    refused(&mission, "2..5", &out, &["--resume"], 2, "line 2: this has seed 1");
    refused(&mission, "1..2", &out, &["--resume"], 2, "line 4: this has seed 3");
    std::fs::copy(&out, &other).unwrap();
    refused(&mission, "1..5", &other, &["--resume"], 2, "`.origin`");
    script(&folder, "reporting.alb", &REPORTING.replace("speed 1 m/s", "speed 1.1 m/s"));
    refused(&mission, "1..5", &out, &["--resume"], 2, "reporting.alb` was changed");
}

/// A scenario of the mission's own file is the same one when it is named by that file.
#[test]
fn a_campaign_knows_its_scenario_by_either_name() {
    let folder = empty("named");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let named = ["--resume", "--in", &format!("{mission}#choppy")];
    let whole = table(&mission, "1..4", &folder.join("whole.csv"), &[]);
    let out = folder.join("a.csv");
    table(&mission, "1..2", &out, &[]);
    assert_eq!(table(&mission, "1..4", &out, &named), whole);
    let out = folder.join("b.csv");
    table(&mission, "1..2", &out, &named[1..]);
    assert_eq!(table(&mission, "1..4", &out, &["--resume"]), whole);
    // Text that another file adds is another origin.
    let other = script(&folder, "other.alb", &REPORTING.replace("mission reporting", "mission other"));
    refused(&mission, "1..4", &out, &["--resume", "--in", &format!("{other}#choppy")], 2, "was begun");
}

#[test]
fn no_two_columns_have_one_name() {
    let folder = empty("columns");
    let report = "report \"=1\": position\n    report \"'=1\": position\n    report \"a b\": position";
    let mission =
        script(&folder, "columns.alb", &REPORTING.replace("report \"end, of \\\"all\\\"\": position", report));
    let table = table(&mission, "1", &folder.join("t.csv"), &[]);
    let mut names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert_eq!(names.len(), 11 + 2 * 4, "{names:?}");
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 11 + 2 * 4, "{names:?}");
}

/// Writes the checksums of a table as if it had been written so.
fn sums(out: &Path) {
    let text = std::fs::read_to_string(out).unwrap();
    let sum = |line: &str| {
        let mut digest = Digest::new();
        digest.text(line);
        format!("{digest}\n")
    };
    let sums: String = text.split_inclusive('\n').map(sum).collect();
    std::fs::write(out.with_extension("csv.sums"), sums).unwrap();
}

#[test]
fn a_row_that_comes_out_otherwise_is_said() {
    let out = empty("otherwise").join("box.csv");
    let whole = table(BOX, "1..2", &out, &[]);
    sums(&out);
    refused(BOX, "1..5", &out, &[], 2, "--resume");
    std::fs::write(&out, whole.replace(",578.0,", ",577.0,").replace(",577.9,", ",576.9,")).unwrap();
    sums(&out);
    refused(BOX, "1..5", &out, &["--resume"], 2, "seed 2 gives another row today");
    std::fs::write(&out, whole.replace(",completed,", ",")).unwrap();
    sums(&out);
    refused(BOX, "1..5", &out, &["--resume"], 2, "line 2: this is no row");
    std::fs::remove_file(out.with_extension("csv.sums")).unwrap();
    refused(BOX, "1..5", &out, &["--resume"], 2, "no `.sums` beside it");
}

/// A disk that forgets bits, at forty places of a table and its checksums: each is told with its line, and mended.
#[test]
fn a_bit_that_changed_on_the_disk_is_told_and_mended() {
    let folder = empty("bits");
    let mission = script(&folder, "aborting.alb", ABORTING);
    let (out, beside) = (folder.join("t.csv"), folder.join("t.csv.sums"));
    let resumed = table(&mission, "1..12", &folder.join("whole.csv"), &[]);
    table(&mission, "1..8", &out, &[]);
    let files = [out.clone(), beside.clone()];
    let before = files.clone().map(|file| std::fs::read(file).unwrap());
    for round in 0..40 {
        for (file, bytes) in files.iter().zip(&before) {
            std::fs::write(file, bytes).unwrap();
        }
        let of = usize::from(round % 4 == 3);
        let (mut bytes, at) = (before[of].clone(), (round * 7919 + 13) % before[of].len());
        bytes[at] ^= 1 << (round % 8);
        std::fs::write(&files[of], &bytes).unwrap();
        let line = before[of][..at].iter().filter(|b| **b == b'\n').count() + 1;
        let output = command(&mission, "1..12", &out, &["--resume"]).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(0), "byte {at} of {of}: {said}");
        assert!(said.contains("was changed since it was written: line"), "byte {at} of {of}: {said}");
        let told = said.split("written: line").nth(1).unwrap().lines().next().unwrap();
        let numbers = told.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok());
        assert!(numbers.collect::<Vec<usize>>().contains(&line), "byte {at} of {of} is in line {line}: {said}");
        assert_eq!(std::fs::read_to_string(&out).unwrap(), resumed, "byte {at} of {of}");
        // Then all is well.
        if round % 10 == 0 {
            let output = command(&mission, "1..12", &out, &["--resume"]).output().unwrap();
            assert!(!stderr(&output).contains("changed"), "{}", stderr(&output));
        }
    }
}

/// Several rows at once, one of them gone; a campaign that is interrupted in between loses nothing.
#[test]
fn rows_that_were_changed_are_run_again() {
    let folder = empty("mended");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let out = folder.join("t.csv");
    let whole = table(&mission, "1..9", &out, &[]);
    let mut lines: Vec<&str> = whole.split_inclusive('\n').collect();
    let changed = lines[2].replace("completed", "Completed");
    lines[2] = &changed;
    lines.remove(5);
    lines.swap(5, 6);
    std::fs::write(&out, lines.concat()).unwrap();
    let output = command(&mission, "1..9", &out, &["--resume"]).output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("lines 3, 6") && said.contains("run again"), "{said}");
    assert_eq!(std::fs::read_to_string(&out).unwrap(), whole);
}

/// What lies beside a table is read with a bound, and only from ordinary files.
#[test]
fn a_neighbour_of_a_table_that_is_no_file_is_said() {
    let out = empty("neighbours").join("t.csv");
    table(BOX, "1..2", &out, &[]);
    for (suffix, bytes) in [(".origin", "csv.origin"), (".sums", "csv.sums")] {
        let beside = out.with_extension(bytes);
        let whole = std::fs::read(&beside).unwrap();
        std::fs::remove_file(&beside).unwrap();
        assert!(Command::new("mkfifo").arg(&beside).status().unwrap().success());
        refused(BOX, "1..3", &out, &["--resume"], 2, &format!("t.csv{suffix}`, which tells"));
        std::fs::remove_file(&beside).unwrap();
        std::os::unix::fs::symlink("/dev/zero", &beside).unwrap();
        refused(BOX, "1..3", &out, &["--resume"], 2, "cannot be read: it is no ordinary file");
        std::fs::remove_file(&beside).unwrap();
        std::fs::write(&beside, whole).unwrap();
    }
    // What is damaged is not taken for another campaign.
    let sums = std::fs::read(out.with_extension("csv.sums")).unwrap();
    for damaged in [&b"nothing"[..], &sums[17..]] {
        std::fs::write(out.with_extension("csv.sums"), damaged).unwrap();
        let output = command(BOX, "1..2", &out, &["--resume"]).output().unwrap();
        assert!(!stderr(&output).contains("other columns"), "{}", stderr(&output));
    }
}

/// All that may be left of a table is not overwritten by the next.
#[test]
fn what_is_left_of_another_table_stays() {
    let folder = empty("left");
    let out = folder.join("t.csv");
    table(BOX, "1..2", &out, &[]);
    std::fs::remove_file(&out).unwrap();
    let origin = std::fs::read(out.with_extension("csv.origin")).unwrap();
    refused(BOX, "1..3", &out, &["--set", "round.patience=9min"], 2, "t.csv.origin` is there already");
    refused(BOX, "1..2", &out, &[], 2, "belongs to another table");
    refused(BOX, "1..3", &out, &["--resume", "--set", "round.patience=9min"], 2, "was begun with `no --set`");
    assert_eq!(std::fs::read(out.with_extension("csv.origin")).unwrap(), origin);
    let link = folder.join("link.csv");
    std::os::unix::fs::symlink("nowhere.csv", &link).unwrap();
    for more in [&[][..], &["--resume"]] {
        refused(BOX, "1..3", &link, more, 2, "link.csv` is there already: a link that leads nowhere");
    }
}

/// What lies beside a table that is gone, or empty, is overwritten only where a campaign left it.
#[test]
fn nothing_of_somebody_else_is_taken_for_what_a_campaign_left() {
    let folder = empty("theirs");
    let whole = folder.join("whole.csv");
    table(BOX, "1..2", &whole, &[]);
    for (name, head, beside, taken) in [
        ("sums", None, &[(".sums", "mine")][..], "t.csv.sums` is there already"),
        ("origin", None, &[(".origin", "mine")], "t.csv.origin`, which tells"),
        ("empty", Some(""), &[(".origin", "mine")], "t.csv.origin`, which tells"),
        ("empty-sums", Some(""), &[(".sums", "mine")], "t.csv.sums` is there already"),
        ("ours-sums", None, &[(".origin", ""), (".sums", "mine")], "t.csv.sums` is there already"),
        ("text", Some("my notes"), &[(".origin", ""), (".sums", "")], "is damaged"),
        ("torn-sums", Some("mission"), &[(".origin", ""), (".sums", "mine")], "is damaged"),
        ("head-sums", Some("mission,HEAD"), &[(".origin", ""), (".sums", "mine, all of it")], "is damaged"),
    ] {
        let folder = empty(&format!("theirs-{name}"));
        let out = folder.join("t.csv");
        let first = std::fs::read_to_string(&whole).unwrap().lines().next().unwrap().to_string() + "\n";
        head.iter().for_each(|head| {
            std::fs::write(&out, if head.ends_with("HEAD") { first.as_str() } else { *head }).unwrap();
        });
        for (suffix, text) in beside {
            let at = folder.join(format!("t.csv{suffix}"));
            if text.is_empty() {
                std::fs::copy(folder.join(format!("../theirs/whole.csv{suffix}")), at).unwrap();
            } else {
                std::fs::write(at, text).unwrap();
            }
        }
        refused(BOX, "1..2", &out, &["--resume"], 2, taken);
        for (suffix, text) in beside.iter().filter(|(_, text)| !text.is_empty()) {
            let left = std::fs::read_to_string(folder.join(format!("t.csv{suffix}"))).unwrap();
            assert_eq!(left, *text, "{name}");
        }
    }
}

/// A table that others write into, move away or empty, while it grows, is no table of this campaign any more.
#[test]
fn a_table_that_is_changed_under_way_is_said() {
    let append = |path: &Path, text: &str| {
        let text = std::fs::read_to_string(path).unwrap() + text;
        let mut file = std::fs::OpenOptions::new().write(true).open(path).unwrap();
        std::io::Write::write_all(&mut file, text.as_bytes()).unwrap();
    };
    let swap = |path: &Path| {
        std::fs::rename(path, path.with_extension("away")).unwrap();
        std::fs::write(path, "user\n").unwrap();
    };
    let gone = "is not this campaign's any more: it was removed or replaced";
    let changed = "was changed by another program while the campaign went on";
    for (name, file, change, why) in [
        ("swapped", "t.csv", &swap as &dyn Fn(&Path), gone),
        ("removed", "t.csv", &|path: &Path| std::fs::remove_file(path).unwrap(), gone),
        ("emptied", "t.csv", &|path: &Path| std::fs::write(path, "").unwrap(), changed),
        ("added", "t.csv", &|path: &Path| append(path, "my,note\n"), changed),
        ("sums-swapped", "t.csv.sums", &swap, gone),
        ("sums-emptied", "t.csv.sums", &|path: &Path| std::fs::write(path, "").unwrap(), changed),
    ] {
        let folder = empty(&format!("under-way-{name}"));
        let child = under_way(&folder.join("t.csv"), 3);
        change(&folder.join(file));
        let output = child.wait_with_output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{name}: {said}");
        assert!(said.contains(why) && said.contains("--resume") && !said.contains("room"), "{name}: {said}");
        assert!(output.stdout.is_empty(), "{name}: a summary of what is no table");
        if why == gone && name != "removed" {
            assert_eq!(std::fs::read_to_string(folder.join(file)).unwrap(), "user\n", "{name}");
        }
    }
}

/// What somebody wrote into a table is taken out of it, and not lost.
#[test]
fn a_table_that_was_changed_is_kept_as_it_was_found() {
    let folder = empty("found");
    let out = folder.join("t.csv");
    let whole = table(BOX, "1..3", &out, &[]);
    for (text, lines, found) in [
        (format!("n1\nn2\n{whole}"), "lines 1..2", "t.csv.found"),
        (whole.replacen('\n', "\n# mine\n", 1), "line 2", "t.csv.found-2"),
    ] {
        std::fs::write(&out, &text).unwrap();
        let output = command(BOX, "1..3", &out, &["--resume"]).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.contains(&format!("since it was written: {lines}\n")) && said.contains(found), "{said}");
        assert_eq!(std::fs::read_to_string(&out).unwrap(), whole);
        assert_eq!(std::fs::read_to_string(folder.join(found)).unwrap(), text);
    }
}

/// Of one line behind the others nobody knows before whether it is a row without its checksum, or another's.
#[test]
fn a_line_that_was_added_is_told() {
    let folder = empty("added");
    let whole = table(BOX, "1..6", &folder.join("whole.csv"), &[]);
    let four: String = whole.split_inclusive('\n').take(5).collect();
    let sixth = whole.lines().nth(6).unwrap();
    let out = folder.join("t.csv");
    table(BOX, "1..4", &out, &[]);
    for (added, more) in
        [("5,mine\n", "1..4"), ("5,mine\n", "1..6"), ("mine", "1..6"), (sixth, "1..6"), ("a\nb\n", "1..6")]
    {
        std::fs::write(&out, format!("{four}{added}")).unwrap();
        std::fs::write(out.with_extension("csv.sums"), "").unwrap();
        sums(&out);
        let written = std::fs::read(out.with_extension("csv.sums")).unwrap();
        std::fs::write(out.with_extension("csv.sums"), &written[..5 * 17]).unwrap();
        let output = command(BOX, more, &out, &["--resume"]).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(0), "{added}: {said}");
        assert!(said.contains("was changed since it was written: line") && said.contains('6'), "{added}: {said}");
    }
    // A row that was being written when its campaign ended is none.
    let fifth = whole.split_inclusive('\n').nth(5).unwrap();
    for end in [1, fifth.len() / 2, fifth.len()] {
        std::fs::write(&out, format!("{four}{}", &fifth[..end])).unwrap();
        sums(&out);
        let written = std::fs::read(out.with_extension("csv.sums")).unwrap();
        std::fs::write(out.with_extension("csv.sums"), &written[..5 * 17]).unwrap();
        let output = command(BOX, "1..6", &out, &["--resume"]).output().unwrap();
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{end}");
        assert_eq!(std::fs::read_to_string(&out).unwrap(), whole);
    }
}

#[test]
fn two_campaigns_do_not_write_one_table() {
    let out = empty("two").join("box.csv");
    let mut child = under_way(&out, 1);
    let output = command(BOX, "1..3000", &out, &["--resume"]).output().unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("another campaign is writing"), "{}", stderr(&output));
}

#[test]
fn further_reports_have_columns_of_their_own() {
    let folder = empty("reports");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let out = folder.join("all.csv");
    let output = command(&mission, "1..2", &out, &["--reports", "3", "--json"]).output().unwrap();
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    insta::assert_snapshot!(std::fs::read_to_string(out).unwrap());
    // With fewer columns it is said that there were more.
    let output = command(&mission, "1..2", &folder.join("few.csv"), &[]).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let said = "warning: 2 of 2 runs reported more often than the table has columns for";
    assert!(stderr(&output).contains(said), "{}", stderr(&output));
}

#[test]
fn the_summary_is_of_all_rows() {
    let folder = empty("summary");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let out = folder.join("table.csv");
    table(&mission, "1..2", &out, &[]);
    let output = command(&mission, "1..8", &out, &["--resume", "--json"]).output().unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&summary["runs"], &summary["outcomes"]["completed"]), (&8.into(), &8.into()));
    assert_eq!((&summary["reported"]["count"], &summary["within"][1]["m"]), (&8.into(), &30.0.into()));
    assert!(summary["error_m"]["median"].as_f64().unwrap() <= summary["error_m"]["p90"].as_f64().unwrap());
    let text = String::from_utf8(command(&mission, "1..8", &out, &["--resume"]).output().unwrap().stdout).unwrap();
    assert!(text.contains("reporting in choppy, seeds 1..8: 8 completed"), "{text}");
    assert!(text.contains("reported      8 of 8: 100.0 % (67.6 to 100.0)"), "{text}");
}

#[test]
fn runs_that_end_badly_are_rows_too() {
    let folder = empty("badly");
    let mission = script(&folder, "aborting.alb", ABORTING);
    let text = table(&mission, "0..1", &folder.join("table.csv"), &[]);
    let row = text.lines().nth(1).unwrap();
    assert!(row.starts_with(r#"still,0,aborted,"no, ""never""",,,"#), "{row}");
}

#[test]
fn what_cannot_be_is_said_before_a_file_is_begun() {
    let folder = empty("usage");
    let out = folder.join("table.csv");
    for seeds in ["3..1", "5..<5", "1-3", "", "1..", "one", "1..2000000", "18446744073709551616"] {
        refused(BOX, seeds, &out, &[], 2, "--seeds");
    }
    refused(BOX, "1", &out, &["--threads", "0"], 2, "--threads");
    refused(BOX, "1", &out, &["--in", "tidal_steam"], 2, "did you mean `tidal_stream`?");
    refused("missions/bix.alb", "1", &out, &[], 2, "did you mean `missions/box.alb`?");
    refused("tests/diagnostics/ten_mistakes.alb", "1", &out, &[], 3, "10 errors");
    refused("missions/duck_single.alb", "1", &out, &["--in", "tidal_steam"], 2, "tidal_steam");
    assert!(std::fs::read_dir(&folder).unwrap().next().is_none());
}

#[test]
fn a_disk_that_fails_is_said_at_once() {
    refused(BOX, "1..3", Path::new("Cargo.toml/table.csv"), &[], 4, "`Cargo.toml/table.csv` cannot be written");
    refused(
        BOX,
        "1..3",
        Path::new("Cargo.toml/table.csv"),
        &["--resume"],
        4,
        "`Cargo.toml/table.csv` cannot be written",
    );
    refused(BOX, "1..3", &empty("nowhere").join("no/table.csv"), &[], 4, "cannot be written");
    let folder = empty("folder");
    let output = command(BOX, "1", &folder, &["--resume"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("no ordinary file"), "{}", stderr(&output));
}

#[test]
fn a_disk_that_is_full_leaves_rows_that_can_be_gone_on_with() {
    let folder = empty("full");
    let whole = table(BOX, "1..100", &folder.join("whole.csv"), &[]);
    for blocks in [3, 4, 5] {
        let out = folder.join(format!("table-{blocks}.csv"));
        let limit = format!("trap '' XFSZ; ulimit -f {blocks}");
        let output = shell::behind(&limit, &command(BOX, "1..100", &out, &[])).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{said}");
        assert_eq!(said.matches("error: ").count(), 1, "{said}");
        assert!(said.contains(".csv` cannot be written: ") && said.contains("--resume"), "{said}");
        // A row that is cut looks real, and what it says is wrong.
        let left = std::fs::read_to_string(&out).unwrap();
        assert!(rows(&left) > 1 && left.ends_with('\n') && whole.starts_with(&left), "{left}");
        assert_eq!(table(BOX, "1..100", &out, &["--resume"]), whole);
    }
}

#[test]
fn a_closed_pipe_is_silent() {
    let out = empty("pipe").join("table.csv");
    let mut child = command(BOX, "1..3", &out, &["--json"]).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    assert_eq!(output.status.code(), Some(0));
}
