//! Several cases in one table: all combinations of what is swept, or those of a list, with the same seeds in each.

use crate::account::SEEKING;
use crate::{REPORTING, command, empty, refused, rows, script, stderr, table};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

type Row = BTreeMap<String, String>;

/// The rows of a table, by the names of its columns.
fn read(text: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let cells = |row: &csv::StringRecord| row.iter().map(str::to_string).collect::<Vec<_>>();
    let row = |row: &csv::StringRecord| names.iter().map(str::to_string).zip(cells(row)).collect();
    reader.records().map(|record| row(&record.unwrap())).collect()
}

fn seeking(folder: &Path) -> String {
    script(folder, "seeking.alb", &(SEEKING.to_string() + WORLDS))
}

/// Another world, and a parameter of it.
const WORLDS: &str = "
scenario brook(drift: Speed = 5 cm/s in 1 cm/s..1 m/s) = stream with { flow(drift toward 90 deg) }
";

#[test]
fn each_case_has_the_rows_of_its_own_campaign() {
    let folder = empty("sweep");
    let mission = seeking(&folder);
    let more = ["--sweep", "luck=good,bad", "--in", "brook", "--sweep", "brook.drift=2cm/s,4.5 cm/s,0.1m/s"];
    let text = table(&mission, "3..5", &folder.join("sweep.csv"), &more);
    let all = read(&text);
    let told: Vec<String> = all.iter().map(|row| format!("{} {} {}", row["case"], row["luck"], row["seed"])).collect();
    let of_seed =
        |seed: u64| (1..7).map(move |case| format!("{case} {} {seed}", if case < 4 { "good" } else { "bad" }));
    assert_eq!(told, (3..6).flat_map(of_seed).collect::<Vec<_>>());
    assert!(text.starts_with("case,mission,luck,brook.drift,scenario,seed,outcome,"), "{text}");
    // Values of several units stay as they are written.
    assert_eq!(all[1]["brook.drift"], "4.5 cm/s");
    let one = folder.join("one.csv");
    let alone = table(&mission, "3..5", &one, &["--in", "brook", "--set", "luck=bad", "--set", "brook.drift=4.5cm/s"]);
    let of_case: Vec<&Row> = all.iter().filter(|row| row["case"] == "5").collect();
    for (of_case, alone) in of_case.iter().zip(read(&alone)) {
        assert!(alone.iter().all(|(name, cell)| of_case[name] == *cell), "{of_case:?} {alone:?}");
    }
    // The same with fewer threads, and after an interruption.
    let threads = [&more[..], &["--threads", "1"]].concat();
    assert_eq!(table(&mission, "3..5", &folder.join("threads.csv"), &threads), text);
    let part = folder.join("part.csv");
    table(&mission, "3", &part, &more);
    let cut = std::fs::read_to_string(&part).unwrap();
    let kept = cut.split_inclusive('\n').take(4).collect::<String>();
    std::fs::write(&part, &kept[..kept.len() - 7]).unwrap();
    let sums = std::fs::read_to_string(folder.join("part.csv.sums")).unwrap();
    std::fs::write(folder.join("part.csv.sums"), sums.split_inclusive('\n').take(3).collect::<String>()).unwrap();
    let resume = [&more[..], &["--resume"]].concat();
    assert_eq!(table(&mission, "3..5", &part, &resume), text);
}

#[test]
fn who_changes_a_row_of_a_sweep_has_it_run_again() {
    let folder = empty("sweep_changed");
    let mission = seeking(&folder);
    let out = folder.join("t.csv");
    let more = ["--sweep", "luck=good,bad,none_yet", "--resume"];
    let whole = table(&mission, "1..4", &out, &more);
    std::fs::write(&out, whole.replacen("\n2,seeking,bad,stream,2,", "\n2,seeking,bad,stream,7,", 1)).unwrap();
    let output = command(&mission, "1..4", &out, &more).output().unwrap();
    assert!(stderr(&output).contains("was changed since it was written: line 6\n"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(&out).unwrap(), whole);
    // A table holds one campaign.
    refused(&mission, "1..4", &out, &["--resume"], 2, "was begun with 3 cases, not 1 case");
    let other = ["--sweep", "luck=good,none_yet,bad", "--resume"];
    refused(&mission, "1..4", &out, &other, 2, "was begun with `--set luck=bad`, not `--set luck=none_yet`, in case 2");
    refused(&mission, "1..3", &out, &more, 2, "this has seed 4");
}

#[test]
fn shards_of_a_sweep_are_put_together() {
    let folder = empty("sweep_merge");
    let mission = seeking(&folder);
    let more = ["--sweep", "luck=good,bad"];
    let whole = table(&mission, "1..5", &folder.join("whole.csv"), &more);
    let part = |i: usize| {
        let part = folder.join(format!("part{i}.csv"));
        table(&mission, "1..5", &part, &[&more[..], &["--shard", &format!("{i}/2")]].concat());
        part
    };
    let parts: Vec<PathBuf> = (1..=2).map(part).collect();
    let merge = |name: &str| {
        let mut merge = Command::new(env!("CARGO_BIN_EXE_albacore"));
        merge.args(["campaign", "merge", "--seeds", "1..5", "--out"]).arg(folder.join(name)).args(&parts);
        merge.stdin(Stdio::null()).output().unwrap()
    };
    let output = merge("merged.csv");
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(folder.join("merged.csv")).unwrap(), whole);
    // Half a seed is no seed.
    let cut = |suffix: &str| {
        let path = folder.join(format!("part2.csv{suffix}"));
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.split_inclusive('\n').collect();
        std::fs::write(&path, lines[..lines.len() - 1].concat()).unwrap();
    };
    cut("");
    cut(".sums");
    let output = merge("half.csv");
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("part2.csv` ends before it has all cases of seed 5"), "{}", stderr(&output));
}

#[test]
fn several_missions_share_the_columns_that_they_call_alike() {
    let folder = empty("sweep_missions");
    let (one, other) = (seeking(&folder), script(&folder, "reporting.alb", REPORTING));
    let out = folder.join("t.csv");
    let mut both = command(&one, "1..2", &out, &["--json"]);
    let output = both.arg(&other).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let all = read(&std::fs::read_to_string(&out).unwrap());
    let told: Vec<&str> = all.iter().map(|row| row["mission"].as_str()).collect();
    assert_eq!(told, ["seeking", "reporting", "seeking", "reporting"]);
    assert!(all.iter().all(|row| row["recovery_s"] == "0.0"));
    assert_eq!((all[0]["look_s"].as_str(), all[1]["look_s"].as_str(), all[0]["turn_t_s"].as_str()), ("10.0", "", ""));
    assert_eq!(all[1]["turn_t_s"], all[1]["report_t_s"]);
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let cases: Vec<_> =
        told["cases"].as_array().unwrap().iter().map(|c| (c["mission"].clone(), c["runs"].clone())).collect();
    assert_eq!(cases, [("seeking".into(), 2.into()), ("reporting".into(), 2.into())]);
    // How many reports have no columns is counted by what each mission has.
    assert!(stderr(&output).contains("warning: 2 of 4 runs reported more often"), "{}", stderr(&output));
    // Missions of one script, each in several worlds.
    let (start, end) = (SEEKING.find("mission seeking").unwrap(), SEEKING.find("scenario").unwrap());
    let later = SEEKING[start..end].replace("mission seeking", "mission later");
    let two = script(&folder, "two.alb", &[SEEKING, &later, WORLDS].concat());
    let more = ["--mission", "later", "--mission", "seeking", "--in", "brook", "--in", "stream"];
    let all = read(&table(&two, "7", &folder.join("two.csv"), &more));
    let told: Vec<_> = all.iter().map(|row| format!("{} {}", row["mission"], row["scenario"])).collect();
    assert_eq!(told, ["later brook", "later stream", "seeking brook", "seeking stream"]);
}

#[test]
fn cases_are_read_from_a_list() {
    let folder = empty("sweep_list");
    let mission = seeking(&folder);
    script(&folder, "reporting.alb", REPORTING);
    let list = |text: &str| {
        std::fs::write(folder.join("cases.csv"), text).unwrap();
        folder.join("cases.csv").display().to_string()
    };
    let cases = list("scenario, luck, brook.drift, script\nbrook,bad,3cm/s,\n,,,\nbrook,,4 cm/s,\n,,,reporting.alb\n");
    let all = read(&table(&mission, "1..2", &folder.join("t.csv"), &["--cases", &cases]));
    let told =
        |row: &Row| format!("{} {} {} {}", row["mission"], row["scenario"], row["luck"], row["brook.drift_cm_s"]);
    let told: Vec<String> = all.iter().take(4).map(told).collect();
    assert_eq!(told, ["seeking brook bad 3", "seeking stream  ", "seeking brook  4", "reporting choppy  "]);
    // A scenario of another file is found beside the list, wherever one is.
    std::fs::create_dir_all(folder.join("lists")).unwrap();
    let world = SEEKING.split("scenario stream").nth(1).unwrap().replacen(" {", "scenario elsewhere {", 1);
    script(&folder.join("lists"), "worlds.alb", &world);
    std::fs::write(folder.join("lists/cases.csv"), "scenario\nworlds.alb#elsewhere\n").unwrap();
    let list = folder.join("lists/cases.csv").display().to_string();
    let beside = read(&table(&mission, "1", &folder.join("beside.csv"), &["--cases", &list]));
    assert_eq!(beside[0]["scenario"], "elsewhere");
    let list = |text: &str| {
        std::fs::write(folder.join("cases.csv"), text).unwrap();
        folder.join("cases.csv").display().to_string()
    };
    let out = folder.join("none.csv");
    for (text, said) in [
        ("luck\n", "there are no cases"),
        ("luck,luck\ngood,bad\n", "the column `luck` is given twice"),
        ("luck,\ngood,bad\n", "its column 2 has no name"),
        ("luck\ngood,bad\n", "cannot be read: "),
        ("luck\ngood\nbed\n", "case 2 cannot be run: "),
        ("depth\n3 m\n", "has a parameter `depth`"),
        ("script\nnone.alb\n", "none.alb"),
        ("", "there are no cases"),
        ("scenario;luck\nbrook;bad\n", "its columns are not parted by commas"),
        ("Scenario,luck\nbrook,bad\n", "its column `Scenario` is called `scenario`"),
        (&("luck\n".to_string() + &"good\n".repeat(1001)), "the list has more than 1000 cases"),
    ] {
        let cases = list(text);
        let output = command(&mission, "1", &out, &["--cases", &cases]).output().unwrap();
        let told = stderr(&output);
        assert!(
            matches!(output.status.code(), Some(2 | 3)) && told.contains(said),
            "{text:?} should say `{said}`: {told}"
        );
        assert!(!out.exists(), "{text:?}");
    }
    refused(&mission, "1", &out, &["--cases", "nowhere.csv"], 2, "`nowhere.csv` cannot be read");
    refused(&mission, "1", &out, &["--cases", &cases, "--sweep", "luck=good"], 2, "cannot be used with");
}

#[test]
fn what_cannot_be_swept_is_said_before_a_file_is_begun() {
    let folder = empty("sweep_refused");
    let mission = seeking(&folder);
    let out = folder.join("t.csv");
    for (more, said) in [
        (&["--sweep", "luck"][..], "a sweep is `NAME=A,B,…`"),
        (&["--sweep", "luck=good,good"], "the value `good` is given twice"),
        (&["--sweep", "luck=good,", "--threads", "1"], "a sweep is"),
        (&["--sweep", "luck=good,bad", "--sweep", "luck=bad"], "the sweep of `luck` is given twice"),
        (&["--sweep", "luck=good,bad", "--set", "luck=bad"], "`luck` is set twice"),
        (&["--sweep", "luck=good,bed"], "case 2 cannot be run: "),
        (&["--sweep", "lick=good,bad"], "did you mean `luck`?"),
        (&["--in", "stream", "--in", "stream"], "the scenario `stream` is given twice"),
        (&["--in", "stream", "--in", "streem"], "did you mean `stream`?"),
    ] {
        let output = command(&mission, "1", &out, more).output().unwrap();
        assert!(matches!(output.status.code(), Some(2 | 3)), "{more:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{more:?} should say `{said}`: {}", stderr(&output));
        assert!(!out.exists(), "{more:?}");
    }
    let many: Vec<String> = (0..1001).map(|i| format!("{}mm/s", 10 + i)).collect();
    let many = format!("brook.drift={}", many.join(","));
    refused(&mission, "1", &out, &["--in", "brook", "--sweep", &many], 2, "1001 cases are more than 1000");
    refused(&mission, "1..600000", &out, &["--sweep", "luck=good,bad"], 2, "more than the 1000000 runs");
    let output = command(&mission, "1", &out, &["--mission", "seeking", &mission]).output().unwrap();
    assert!(stderr(&output).contains("`--mission` chooses of one script"), "{}", stderr(&output));
}

#[test]
fn a_sweep_is_summed_up_case_by_case_and_compared() {
    let folder = empty("sweep_summary");
    let mission = seeking(&folder);
    let out = folder.join("t.csv");
    let more = ["--sweep", "luck=good,bad"];
    let output = command(&mission, "1..4", &out, &more).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    insta::assert_snapshot!(text.replace(&folder.display().to_string(), "FOLDER"));
    let compare = |tables: &[&PathBuf]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.args(["campaign", "compare", "--json"]).args(tables).env("NO_COLOR", "1");
        command.stdin(Stdio::null()).output().unwrap()
    };
    let told = |tables: &[&PathBuf]| {
        let output = compare(tables);
        assert!(output.status.success(), "{}", stderr(&output));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let side = |side: &serde_json::Value| format!("{} {}", side["of"].as_str().unwrap(), side["case"]);
        let told = told["comparisons"].as_array().unwrap().clone();
        told.iter().map(|told| format!("{} | {}", side(&told["a"]), side(&told["b"]))).collect::<Vec<_>>()
    };
    let (good, bad) = ("seeking in stream --set luck=good", "seeking in stream --set luck=bad");
    assert_eq!(told(&[&out]), [format!("{good} 1 | {bad} 2")]);
    let one = folder.join("one.csv");
    table(&mission, "2..9", &one, &[]);
    assert_eq!(
        told(&[&one, &out]),
        [format!("seeking in stream null | {good} 1"), format!("seeking in stream null | {bad} 2")]
    );
    assert_eq!(told(&[&out, &out]), [format!("{good} 1 | {good} 1"), format!("{bad} 2 | {bad} 2")]);
    // Each world has a first case of its own.
    let worlds = folder.join("worlds.csv");
    table(&mission, "1..2", &worlds, &["--in", "stream", "--in", "brook", "--sweep", "luck=good,bad"]);
    let brook = |luck: &str| format!("seeking in brook --set luck={luck}");
    assert_eq!(told(&[&worlds]), [format!("{good} 1 | {bad} 2"), format!("{} 3 | {} 4", brook("good"), brook("bad"))]);
    let refused = |tables: &[&PathBuf], said: &str| {
        let output = compare(tables);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(said), "`{said}` is not in: {}", stderr(&output));
    };
    refused(&[&one], "has one case, and nothing to compare it with");
    refused(&[&out, &worlds], "have other cases");
    let drifts = folder.join("drifts.csv");
    table(&mission, "1", &drifts, &["--in", "brook", "--sweep", "brook.drift=2cm/s,3cm/s"]);
    refused(&[&drifts], "are of one world");
    assert_eq!(rows(&std::fs::read_to_string(&drifts).unwrap()), 2);
}

/// What a person reads has the columns of the table, whatever they are called, and what is computed is no number with a unit.
#[test]
fn the_summary_has_the_columns_of_the_table() {
    let folder = empty("sweep_names");
    let named = SEEKING
        .replace("mission seeking(", "mission seeking(seed: Int = 1, lambda: Duration = 1 s, lambda_s: Int = 1, ");
    let mission = script(&folder, "named.alb", &named);
    let out = folder.join("t.csv");
    let more = ["--json", "--sweep", "seed=1,2", "--sweep", "lambda=2s,4s", "--sweep", "lambda_s=3,4"];
    let output = command(&mission, "1", &out, &more).output().unwrap();
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let swept = serde_json::json!({ "seed_": "2", "lambda_s": "4", "lambda_s_": "3" });
    assert_eq!(told["cases"][6]["swept"], swept);
    assert!(std::fs::read_to_string(&out).unwrap().starts_with("case,mission,seed_,lambda_s,lambda_s_,scenario,"));
    let more = ["--sweep", "lambda=2*3s,10s/2,7s-4s"];
    let rows = read(&table(&mission, "1", &folder.join("computed.csv"), &more));
    assert_eq!(rows.iter().map(|row| row["lambda"].as_str()).collect::<Vec<_>>(), ["2*3s", "10s/2", "7s-4s"]);
}
