//! Shards of a campaign, and the table that is put together of them.

use crate::{REPORTING, command, empty, script, stderr, table};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The three files of a table.
fn files(table: &Path) -> [Vec<u8>; 3] {
    ["", ".origin", ".sums"].map(|suffix| {
        let mut name = table.as_os_str().to_owned();
        name.push(suffix);
        std::fs::read(name).unwrap()
    })
}

fn merge(parts: &[&PathBuf], out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["campaign", "merge", "--out"]).arg(out).args(more).args(parts);
    command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap()
}

/// A mission and its shards, so many of seeds 11 to 20.
fn shards(name: &str, of: usize) -> (PathBuf, String, Vec<PathBuf>) {
    let folder = empty(name);
    let mission = script(&folder, "reporting.alb", REPORTING);
    let shard = |i: usize| {
        let part = folder.join(format!("part{i}.csv"));
        table(&mission, "11..20", &part, &["--shard", &format!("{i}/{of}")]);
        part
    };
    let parts = (1..=of).map(shard).collect();
    (folder, mission, parts)
}

#[test]
fn shards_that_are_merged_have_the_bytes_of_one_campaign() {
    let (folder, mission, parts) = shards("merge", 3);
    let (whole, merged) = (folder.join("whole.csv"), folder.join("merged.csv"));
    table(&mission, "11..20", &whole, &[]);
    let output = merge(&[&parts[2], &parts[0], &parts[1]], &merged, &["--seeds", "11..20"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(files(&merged), files(&whole));
    // It is a table like any other.
    table(&mission, "11..22", &merged, &["--resume"]);
    table(&mission, "11..22", &whole, &["--resume"]);
    assert_eq!(files(&merged), files(&whole));
}

#[test]
fn parts_that_do_not_fit_are_refused_and_nothing_is_written() {
    let (folder, mission, parts) = shards("merge_refused", 3);
    let out = folder.join("merged.csv");
    let [first, second, third] = [&parts[0], &parts[1], &parts[2]];
    let refused = |parts: &[&PathBuf], more: &[&str], said: &str| {
        let output = merge(parts, &out, more);
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(said), "`{said}` is not in: {told}");
        assert!(["merged.csv", "merged.csv.origin", "merged.csv.sums"].iter().all(|left| !folder.join(left).exists()));
    };
    refused(&[first, third], &[], "seeds 14..16 are in no part, between");
    refused(&[first, second, second], &[], "seeds 14..16 are in");
    refused(&[first, second], &["--seeds", "11..20"], "seeds 17..20 are in no part");
    refused(&[second, third], &["--seeds", "11..20"], "seeds 11..13 are in no part");
    refused(&[first, second, third], &["--seeds", "12..19"], "the parts have seeds 11..20, not 12..19");
    refused(&[first, &folder.join("nothing.csv")], &[], "cannot be read");
    // Of another parameter, of another number of reports, and one that was changed.
    let other = folder.join("other.csv");
    table(&mission, "14..16", &other, &["--set", "leg=12s"]);
    refused(&[first, &other, third], &[], "was begun with `--set leg=12s`, not `no --set`");
    let wider = folder.join("wider.csv");
    table(&mission, "14..16", &wider, &["--reports", "2"]);
    refused(&[first, &wider, third], &[], "has other columns than");
    let text = std::fs::read_to_string(second).unwrap();
    std::fs::write(second, text.replacen("completed", "aborted", 1)).unwrap();
    refused(&[first, second, third], &[], "was changed since it was written: line 2");
}

/// Whoever takes out a row and its checksum leaves a table whose sums are right.
#[test]
fn a_row_that_was_taken_out_is_missed() {
    let (folder, _, parts) = shards("merge_taken", 2);
    let mut sums = parts[1].clone().into_os_string();
    sums.push(".sums");
    for file in [parts[1].as_os_str(), &sums] {
        let text = std::fs::read_to_string(file).unwrap();
        let kept: String =
            text.split_inclusive('\n').enumerate().filter(|(i, _)| *i != 2).map(|(_, line)| line).collect();
        std::fs::write(file, kept).unwrap();
    }
    let output = merge(&[&parts[0], &parts[1]], &folder.join("merged.csv"), &[]);
    assert!(stderr(&output).contains("has seed 18 where seed 17 is due"), "{}", stderr(&output));
}

/// Two merges to one name: one writes, the other touches nothing.
#[test]
fn of_two_merges_one_writes() {
    let (folder, _, parts) = shards("merge_twice", 2);
    for round in 0..10 {
        let out = folder.join(format!("{round}.csv"));
        let outputs: Vec<Output> = std::thread::scope(|scope| {
            let both: Vec<_> = (0..2).map(|_| scope.spawn(|| merge(&[&parts[0], &parts[1]], &out, &[]))).collect();
            both.into_iter().map(|merge| merge.join().unwrap()).collect()
        });
        assert_eq!(outputs.iter().filter(|output| output.status.success()).count(), 1);
        assert!(files(&out).iter().all(|file| !file.is_empty()));
    }
}

#[test]
fn a_table_that_is_there_is_left_alone() {
    let (folder, _, parts) = shards("merge_there", 2);
    let out = folder.join("merged.csv");
    std::fs::write(&out, "mine").unwrap();
    let output = merge(&[&parts[0], &parts[1]], &out, &[]);
    assert!(stderr(&output).contains("merged.csv` is there already"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "mine");
}

#[test]
fn more_shards_than_seeds_are_told() {
    let folder = empty("merge_few");
    let mission = script(&folder, "reporting.alb", REPORTING);
    let output = command(&mission, "1..2", &folder.join("t.csv"), &["--shard", "1/3"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("too few for so many shards"), "{}", stderr(&output));
    let output = command(&mission, "1..9", &folder.join("t.csv"), &["--shard", "4/3"]).output().unwrap();
    assert!(stderr(&output).contains("from `1/3` to `3/3`"), "{}", stderr(&output));
}
