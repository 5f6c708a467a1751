//! Tables that are not as they were written: torn, damaged on the disk, or written into by somebody else. What a campaign wrote is mended,
//! and what it did not write is told and kept.

use crate::{
    ABORTING, BOX, FOREVER, REPORTING, SWAPPED, command, empty, refused, rows, script, shell, stderr, table, under_way,
};
use albacore_trace::Digest;
use serde_json::Value;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

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

/// What the checksums of a table hold of its origin.
fn key(out: &Path) -> String {
    let origin: Value = serde_json::from_slice(&std::fs::read(out.with_extension("csv.origin")).unwrap()).unwrap();
    let digests = |scripts: &Value| -> Vec<Value> {
        let scripts = scripts.as_array().cloned().unwrap_or_else(|| vec![scripts.clone()]);
        scripts.iter().map(|script| script["digest"].clone()).filter(|digest| !digest.is_null()).collect()
    };
    let case = |case: &Value| {
        let told = ["mission", "scenario", "set", "scripts"].map(|name| case[name].clone());
        Value::Array(told.into_iter().chain([digests(&case["scenario_script"]).into()]).collect())
    };
    let cases: Vec<Value> = origin["cases"].as_array().unwrap().iter().map(case).collect();
    let told = ["albacore", "first_seed", "fault"].map(|name| origin[name].clone());
    let told = told.into_iter().chain([digests(&origin["sources"]).into(), cases.into()]);
    let mut digest = Digest::new();
    digest.bytes(Value::Array(told.collect()).to_string().as_bytes());
    digest.to_string()
}

/// Writes the checksums of a table as if it had been written so.
fn sums(out: &Path) {
    let text = std::fs::read_to_string(out).unwrap();
    let key = key(out);
    let sum = |line: &str| {
        let mut digest = Digest::new();
        digest.bytes(key.as_bytes());
        digest.bytes(line.as_bytes());
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
    refused(BOX, "1..5", &out, &["--resume"], 2, "line 2: this is no row of this campaign");
    std::fs::remove_file(out.with_extension("csv.sums")).unwrap();
    refused(BOX, "1..5", &out, &["--resume"], 2, "no `.sums` beside it");
}

/// Neither an origin nor a table with its checksums fits another campaign: no row of that is taken for one of this.
#[test]
fn no_row_of_another_campaign_is_gone_on_with() {
    let folder = empty("swapped");
    let mission = script(&folder, "reporting.alb", SWAPPED);
    let (here, there) = (folder.join("a.csv"), folder.join("b.csv"));
    let short = ["--set", "long=10 s", "--resume"];
    let other = table(&mission, "1..4", &here, &[]);
    let own = table(&mission, "1..4", &there, &short[..2]);
    assert_ne!(other, own);
    let beside = |table: &Path, what: &str| table.with_extension(format!("csv.{what}"));
    std::fs::copy(beside(&there, "origin"), beside(&here, "origin")).unwrap();
    assert_eq!(table(&mission, "1..4", &here, &short), own, "the origin of another");
    assert!(folder.join("a.csv.found").exists() && folder.join("a.csv.found.sums").exists());
    std::fs::write(&there, &other).unwrap();
    let mended = table(&mission, "1..4", &there, &short);
    assert_eq!(mended, own, "the table of another");
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
    refused(BOX, "1..2", &out, &[], 2, "nothing is left of its table");
    refused(BOX, "1..3", &out, &["--resume", "--set", "round.patience=9min"], 2, "was begun with `no --set`");
    assert_eq!(std::fs::read(out.with_extension("csv.origin")).unwrap(), origin);
    // The fix that is offered works.
    assert_eq!(rows(&table(BOX, "1..2", &out, &["--resume"])), 2);
    [&out, &out.with_extension("csv.origin")].into_iter().for_each(|of| std::fs::remove_file(of).unwrap());
    let alone = "t.csv.sums` is there already, and nothing is left of its table and its `.origin`";
    refused(BOX, "1..2", &out, &[], 2, alone);
    refused(BOX, "1..2", &out, &["--resume"], 2, alone);
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
        ("text", Some("my notes"), &[(".sums", "")], "no `.origin` beside it"),
        ("no-sums", Some("my notes"), &[(".origin", "")], "no `.sums` beside it"),
    ] {
        let folder = empty(&format!("theirs-{name}"));
        let out = folder.join("t.csv");
        head.iter().for_each(|head| std::fs::write(&out, head).unwrap());
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
        ("sums-added", "t.csv.sums", &|path: &Path| append(path, "mine\n"), changed),
        ("sums-removed", "t.csv.sums", &|path: &Path| std::fs::remove_file(path).unwrap(), gone),
        ("overwritten", "t.csv", &|path: &Path| std::fs::write(path, "mine\nand all of it\n").unwrap(), changed),
    ] {
        let folder = empty(&format!("under-way-{name}"));
        let child = under_way(&folder.join("t.csv"), FOREVER, 3);
        change(&folder.join(file));
        let output = child.wait_with_output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{name}: {said}");
        assert!(said.contains(why) && said.contains("--resume") && !said.contains("room"), "{name}: {said}");
        assert!(output.stdout.is_empty(), "{name}: a summary of what is no table");
        // The fix that is offered works.
        let (out, away) = (folder.join("t.csv"), folder.join(file).with_extension("away"));
        if away.exists() {
            assert_eq!(std::fs::read_to_string(folder.join(file)).unwrap(), "user\n", "{name}");
            std::fs::rename(away, folder.join(file)).unwrap();
        }
        let lines = |file: &str| rows(&std::fs::read_to_string(folder.join(file)).unwrap_or_default());
        let seeds = format!("1..{}", lines("t.csv").max(lines("t.csv.sums")) + 5);
        let anew = table(BOX, &seeds, &folder.join("anew.csv"), &[]);
        if name == "sums-removed" {
            refused(BOX, &seeds, &out, &["--resume"], 2, "or begin anew with another `--out`");
        } else {
            assert_eq!(table(BOX, &seeds, &out, &["--resume"]), anew, "{name}");
        }
    }
}

/// Without it nobody could go on with the table, or read what it was of.
#[test]
fn an_origin_that_is_removed_or_changed_under_way_is_written_again() {
    for theirs in [None, Some("mine\n"), Some("{}\n")] {
        let name = format!("under-way-origin-{}", theirs.map_or(0, str::len));
        let is_early = |seeds: &&str| {
            let out = empty(&name).join("t.csv");
            let origin = out.with_extension("csv.origin");
            let mut child = under_way(&out, seeds, 0);
            let written = std::fs::read(&origin).unwrap();
            match theirs {
                Some(text) => std::fs::write(&origin, text).unwrap(),
                None => std::fs::remove_file(&origin).unwrap(),
            }
            let is_early = child.try_wait().unwrap().is_none();
            let output = child.wait_with_output().unwrap();
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(0), "{said}");
            if is_early {
                assert_eq!(std::fs::read(&origin).unwrap(), written);
                let kept = std::fs::read_to_string(out.with_extension("csv.found.origin")).ok();
                assert_eq!(kept.as_deref(), theirs);
                assert_eq!(said.contains("t.csv.origin` was changed since it was written"), theirs.is_some(), "{said}");
                table(BOX, seeds, &out, &["--resume"]);
            }
            is_early
        };
        // A campaign that ends before the file is changed shows nothing: then one of more runs.
        assert!(["1..60", "1..600", "1..6000"].iter().any(is_early), "no campaign was under way");
    }
}

/// Who gives the name of another file by mistake is not led to go on with it.
#[test]
fn what_no_campaign_wrote_is_not_offered_to_go_on_with() {
    let out = empty("no-table").join("notes.csv");
    std::fs::write(&out, "my,notes\n").unwrap();
    let output = command(BOX, "1..3", &out, &[]).output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("is there already") && !said.contains("--resume"), "{said}");
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "my,notes\n");
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
        let found = folder.join("t.csv.found");
        assert_eq!(std::fs::read_to_string(&found).unwrap(), format!("{four}{added}"));
        std::fs::remove_file(&found).unwrap();
        std::fs::remove_file(found.with_extension("found.sums")).unwrap();
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

const FULL: &str = "trap '' XFSZ; ulimit -f 0";

/// The files of a table of five rows, in an empty folder.
fn five_rows(name: &str) -> [PathBuf; 3] {
    let out = empty(name).join("t.csv");
    table(BOX, "1..5", &out, &[]);
    ["csv", "csv.sums", "csv.origin"].map(|extension| out.with_extension(extension))
}

/// Nothing is said of a row that was not held against its checksum, and the fix fits what is wrong.
#[test]
fn of_a_table_that_cannot_be_written_only_what_was_verified_is_told() {
    let whole = "its first 5 rows are as they were written; ";
    let forged = "it or its `.sums` was changed since it was written: line 3; ";
    let (room, leave) =
        ("when there is room again", "when you may write it, its `.origin`, its `.sums` and their folder");
    for (name, is_forged, is_full, known, fix) in [
        ("full", false, true, whole, room),
        ("full-forged", true, true, forged, room),
        ("read-only-forged", true, false, forged, leave),
    ] {
        let [out, sums, origin] = five_rows(&format!("unwritable-{name}"));
        if is_forged {
            let text = std::fs::read_to_string(&out).unwrap();
            std::fs::write(&out, text.replacen("stream,2,completed", "stream,2,aborted", 1)).unwrap();
        }
        let before = std::fs::read(&out).unwrap();
        let files = [&out, &sums, &origin];
        let modes = |mode| files.map(|file| std::fs::set_permissions(file, PermissionsExt::from_mode(mode)).unwrap());
        modes(if is_full { 0o644 } else { 0o444 });
        let setting = if is_full { FULL } else { "true" };
        let output = shell::behind(setting, &command(BOX, "1..6", &out, &["--resume"])).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(4), "{name}: {said}");
        assert!(said.contains(&format!("help: {known}{fix}")), "{name}: {said}");
        assert_eq!(std::fs::read(&out).unwrap(), before, "{name}");
        // The fix that is offered works.
        modes(0o644);
        let anew = table(BOX, "1..6", &out.with_file_name("anew.csv"), &[]);
        assert_eq!(table(BOX, "1..6", &out, &["--resume"]), anew, "{name}");
    }
}

/// Who may only read a table that is complete has its summary: there is nothing to write.
#[test]
fn into_a_table_that_is_complete_nothing_is_written() {
    let files = five_rows("complete");
    let before =
        files.each_ref().map(|file| (std::fs::read(file).unwrap(), file.metadata().unwrap().modified().unwrap()));
    for (mode, setting) in [(0o444, "true"), (0o644, FULL)] {
        files.iter().for_each(|file| std::fs::set_permissions(file, PermissionsExt::from_mode(mode)).unwrap());
        let output = shell::behind(setting, &command(BOX, "1..5", &files[0], &["--resume"])).output().unwrap();
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
        assert!(String::from_utf8_lossy(&output.stdout).contains("seeds 1..5: 5 completed"));
        let after =
            files.each_ref().map(|file| (std::fs::read(file).unwrap(), file.metadata().unwrap().modified().unwrap()));
        assert!(after == before);
    }
}

/// An attack: a backup by hard links (`cp -al`) grew with the table that it was to keep.
#[test]
fn a_table_of_several_names_is_not_gone_on_with() {
    let files = five_rows("linked");
    let backups =
        files.each_ref().map(|file| file.with_file_name(format!("backup-{}", file.file_name().unwrap().display())));
    let before = files.each_ref().map(|file| std::fs::read(file).unwrap());
    for (file, backup) in files.iter().zip(&backups) {
        std::fs::hard_link(file, backup).unwrap();
        let output = command(BOX, "1..8", &files[0], &["--resume"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains("has another name (a hard link)"), "{}", stderr(&output));
        assert_eq!(files.each_ref().map(|file| std::fs::read(file).unwrap()), before);
        std::fs::remove_file(backup).unwrap();
    }
    let output = command(BOX, "1..8", &files[0], &["--resume"]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

/// A campaign that ends at any moment of its beginning, and then at any of its being taken up again, has changed nothing of its own.
#[test]
fn a_table_that_was_cut_at_its_first_line_was_not_changed() {
    let [out, sums, origin] = five_rows("cut");
    let (whole, all) = (std::fs::read_to_string(&out).unwrap(), std::fs::read_to_string(&sums).unwrap());
    let head = whole.find('\n').unwrap() + 1;
    for (line, sum) in [(head, Some(17)), (head, Some(5)), (head, Some(0)), (5, Some(0)), (0, Some(0)), (0, None)] {
        let case = format!("{line} bytes of the table, {sum:?} of its sums");
        std::fs::write(&out, &whole[..line]).unwrap();
        match sum {
            Some(sum) => std::fs::write(&sums, &all[..sum]).unwrap(),
            None => std::fs::remove_file(&sums).unwrap(),
        }
        for read_only in [&origin, &sums] {
            // It ends as soon as it writes anything, or this file.
            for setting in [FULL, "true"] {
                let _ = std::fs::set_permissions(read_only, PermissionsExt::from_mode(0o444));
                let output = shell::behind(setting, &command(BOX, "1..5", &out, &["--resume"])).output().unwrap();
                assert!(!stderr(&output).contains("changed"), "{case}: {}", stderr(&output));
                let _ = std::fs::set_permissions(read_only, PermissionsExt::from_mode(0o644));
            }
        }
        let output = command(BOX, "1..5", &out, &["--resume"]).output().unwrap();
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{case}");
        assert_eq!(std::fs::read_to_string(&out).unwrap(), whole, "{case}");
        assert!(!out.with_extension("csv.found.sums").exists(), "{case}");
    }
}
