//! Two tables of one world, compared seed by seed.

use crate::account::SEEKING;
use crate::{command, empty, script, stderr, table};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn compare(a: &Path, b: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["campaign", "compare"]).args([a, b]).args(more);
    command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap()
}

#[test]
fn tables_of_one_world_are_compared_seed_by_seed() {
    let folder = empty("compare");
    let mission = script(&folder, "seeking.alb", SEEKING);
    let [good, bad, near] = ["good.csv", "bad.csv", "near.csv"].map(|name| folder.join(name));
    table(&mission, "1..20", &good, &[]);
    table(&mission, "3..12", &bad, &["--set", "luck=bad"]);
    let output = compare(&good, &bad, &["--json"]);
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let told = &told["comparisons"][0];
    assert_eq!((&told["pairs"], &told["a"]["left_out"], &told["b"]["left_out"]), (&10.into(), &10.into(), &0.into()));
    assert_eq!(told["b"]["of"], "seeking in stream --set luck=bad");
    let reported = &told["shares"][1];
    assert_eq!(
        (&reported["what"], &reported["only_a"], &reported["only_b"]),
        (&"reported".into(), &10.into(), &0.into())
    );
    assert_eq!((&reported["difference"], &reported["p"]), (&(-1.0).into(), &(2.0 / 1024.0).into()));
    // Nothing is reported on both sides: there are no errors to compare. Both take as long.
    let quantities: Vec<_> = told["differences"].as_array().unwrap().iter().map(|d| d["what"].clone()).collect();
    assert_eq!(quantities, ["end", "over ground", "switches"]);
    assert_eq!(told["differences"][0]["difference"], 0.0);
    // Looked for from farther east, it is farther off: by as much in every run.
    let east = SEEKING.replace("after 10 s", "after 15 s").replace("strategy seek", "// later\nstrategy seek");
    let later = script(&folder, "later.alb", &east);
    table(&later, "1..20", &near, &[]);
    let output = compare(&good, &near, &[]);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(text.contains("20 seeds in both; the scripts differ\n"), "{text}");
    assert!(text.contains("  end               13.2      18.2  s +5.0 (+5.0 to +5.0)\n"), "{text}");
    assert!(
        text.contains("  reported       100.0 %   100.0 %    +0.0 % (-16.1 to +16.1)          0        0  1.000\n"),
        "{text}"
    );
}

/// Worlds like that of the mission.
const MORE: &str = "
scenario brook = stream with { flow(5 cm/s toward 90 deg) }
scenario other_hull = stream with { vehicle(fossen, start: point(north: 0 m, east: 0 m), depth: 3 m) }
";

#[test]
fn tables_that_are_not_comparable_are_refused() {
    let folder = empty("compare_refused");
    let drifting = "scenario stream(drift: Speed = 10 cm/s in 1 cm/s..1 m/s) {";
    let seeking = SEEKING.replace("scenario stream {", drifting).replace("flow(10 cm/s", "flow(drift");
    let mission = script(&folder, "seeking.alb", &(seeking + MORE));
    let [a, brook, slow, hull, late] =
        ["a.csv", "brook.csv", "slow.csv", "hull.csv", "late.csv"].map(|name| folder.join(name));
    table(&mission, "1..3", &a, &[]);
    table(&mission, "1..3", &brook, &["--in", "brook"]);
    table(&mission, "1..3", &slow, &["--set", "stream.drift=5cm/s"]);
    table(&mission, "1..3", &hull, &["--in", "other_hull"]);
    table(&mission, "7..8", &late, &[]);
    let refused = |b: &Path, said: &str| {
        let output = compare(&a, b, &[]);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(said), "`{said}` is not in: {}", stderr(&output));
    };
    refused(&brook, "one is of the scenario `stream`, the other of `brook`, and their worlds differ");
    // By whatever the water was changed; another vehicle in it can be compared.
    refused(&slow, "the water, the bottom or the plume of `stream` is another in the one than in the other");
    assert!(compare(&a, &hull, &[]).status.success());
    refused(&late, "no seed in common: 1..3, and 7..8");
    refused(&folder.join("none.csv"), "cannot be read");
    std::fs::write(folder.join("plain.csv"), "seed,outcome\n1,completed\n").unwrap();
    refused(&folder.join("plain.csv"), "there is no `");
    // A campaign is no table, and a table none.
    let output = command(&mission, "1", &folder.join("t.csv"), &["compare"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}
