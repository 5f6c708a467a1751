//! The picture of a table.

use crate::account::SEEKING;
use crate::{SWAPPED, empty, script, stderr, table};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn plot(table: &Path, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["campaign", "plot"]).arg(table).arg("--out").arg(out).args(more);
    command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap()
}

/// Draws a table, which must go well; gives the picture.
#[track_caller]
fn drawn(table: &Path, more: &[&str]) -> String {
    let out = table.with_extension("svg");
    let output = plot(table, &out, more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(String::from_utf8_lossy(&output.stdout), format!("picture {}\n", out.display()));
    std::fs::read_to_string(out).unwrap()
}

#[track_caller]
fn refused(table: &Path, out: &Path, more: &[&str], code: i32, said: &str) {
    let before = std::fs::read(out).ok();
    let output = plot(table, out, more);
    assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
    assert!(stderr(&output).contains(said), "`{said}` is not in: {}", stderr(&output));
    assert_eq!(std::fs::read(out).ok(), before, "the file was changed");
}

#[test]
fn a_table_is_drawn_with_its_places_times_and_outcomes() {
    let folder = empty("plot");
    let mission = script(&folder, "seeking.alb", SEEKING);
    let good = folder.join("good.csv");
    table(&mission, "3..12", &good, &[]);
    let svg = drawn(&good, &[]);
    for told in [
        ">seeking in stream</text>",
        ">seeds 3..12: 10 runs, table good.csv</text>",
        ">down-flow (m)</text>",
        ">error (m)</text>",
        ">time (s)</text>",
        ">completed</text>",
        ">place</text>",
    ] {
        assert!(svg.contains(told), "`{told}` is not in: {svg}");
    }
    // Made again it is the same, and what somebody drew into it stays.
    assert_eq!(drawn(&good, &[]), svg);
    let out = folder.join("mine.svg");
    std::fs::write(&out, svg.replace("seeking", "mine")).unwrap();
    refused(&good, &out, &[], 4, "it is there already, and is not as Albacore made it");
    refused(&good, &folder.join("no/such.svg"), &[], 4, "cannot be written");
}

#[test]
fn of_a_mission_that_reports_nothing_times_and_outcomes_are_drawn() {
    let folder = empty("plot_blind");
    let mission = script(&folder, "lasting.alb", SWAPPED);
    let lasting = folder.join("lasting.csv");
    table(&mission, "1..4", &lasting, &[]);
    let svg = drawn(&lasting, &[]);
    assert!(svg.contains("when the run ended") && svg.contains(">completed</text>"), "{svg}");
    assert!(!svg.contains("error (m)") && !svg.contains("north (m)") && !svg.contains("down-flow"), "{svg}");
}

#[test]
fn each_case_has_its_colour_and_more_than_there_are_colours_are_refused() {
    let folder = empty("plot_cases");
    let mission = script(&folder, "lasting.alb", SWAPPED);
    let (few, many) = (folder.join("few.csv"), folder.join("many.csv"));
    table(&mission, "1..2", &few, &["--sweep", "long=2s,4s"]);
    let svg = drawn(&few, &[]);
    for told in
        [">lasting in still</text>", "seeds 1..2: 4 runs of 2 cases", ">1: long=2s</text>", ">2: long=4s</text>"]
    {
        assert!(svg.contains(told), "`{told}` is not in: {svg}");
    }
    table(&mission, "1..2", &many, &["--sweep", "long=1s,2s,3s,4s,5s,6s,7s,8s,9s"]);
    let out = folder.join("many.svg");
    refused(&many, &out, &[], 2, "name those to be drawn with `--case`, such as `--case 1 --case 2`");
    refused(&many, &out, &["--case", "10"], 2, "has no case 10");
    refused(&many, &out, &["--case", "0"], 2, "it has the cases 1 to 9");
    let svg = drawn(&many, &["--case", "9", "--case", "2"]);
    assert!(svg.contains("4 runs of 2 of 9 cases") && svg.contains(">9: long=9s</text>"), "{svg}");
    let svg = drawn(&many, &["--case", "9"]);
    assert!(
        svg.contains(">lasting in still --set long=9s</text>") && svg.contains("2 runs of one of 9 cases"),
        "{svg}"
    );
}

#[test]
fn what_is_no_table_is_refused() {
    let folder = empty("plot_refused");
    let out = folder.join("t.svg");
    refused(&folder.join("none.csv"), &out, &[], 2, "cannot be read");
    std::fs::write(folder.join("plain.csv"), "seed,outcome\n1,completed\n").unwrap();
    refused(&folder.join("plain.csv"), &out, &[], 2, "there is no `");
    let mission = script(&folder, "lasting.alb", SWAPPED);
    let changed = folder.join("changed.csv");
    let text = table(&mission, "1..2", &changed, &[]);
    std::fs::write(&changed, text.replace("completed", "abandoned")).unwrap();
    refused(&changed, &out, &[], 2, "was changed since it was written");
    assert!(!out.exists());
}
