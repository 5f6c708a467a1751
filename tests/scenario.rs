//! `albacore scenario show`: every number in force, and a picture.

#![expect(clippy::unwrap_used, reason = "a test whose files cannot be written has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// An empty folder of its own for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("scenario-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn show(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["scenario", "show"]).args(arguments).current_dir(folder);
    command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap()
}

fn listed(arguments: &[&str]) -> String {
    let output = show(Path::new(env!("CARGO_MANIFEST_DIR")), arguments);
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

/// What a scenario says, what the vehicle that it names says, and what holds without being said.
#[test]
fn every_number_is_listed_with_where_it_comes_from() {
    insta::assert_snapshot!(listed(&["tests/scenario/ocean.alb", "--no-out"]));
    let set = listed(&["tests/scenario/ocean.alb#ocean", "--no-out", "--set", "ocean.age=30min"]);
    assert!(set.contains("age               1800 s\n"), "{set}");
}

/// What a world has though nobody says it is no less in force: its water, its bottom, and a vehicle with its hull.
#[test]
fn what_nobody_says_is_listed_too() {
    insta::assert_snapshot!(listed(&["tests/scenario/nothing.alb", "--no-out"]));
    let bay = listed(&["tests/scenario/bay.alb", "--no-out"]);
    assert!(!bay.contains("bottom  (not said)"), "where the bottom was surveyed, the plane is not in force: {bay}");
    let absent = bay.lines().find_map(|line| line.strip_prefix("none of: ")).unwrap();
    assert!(absent.split(", ").any(|name| name == "bottom"), "{absent}");
}

/// A record brings its own water, plume and source.
#[test]
fn what_a_record_brings_is_listed_as_its_own() {
    let listing = listed(&["missions/recorded.alb#recorded_plume_a", "--no-out"]);
    let (record, rest) = listing.split_once("\n\nbottom").unwrap();
    insta::assert_snapshot!(record);
    let absent = rest.lines().find_map(|line| line.strip_prefix("none of: ")).unwrap();
    assert!(
        ["region", "flow", "plume", "source"].iter().all(|name| absent.split(", ").all(|a| a != *name)),
        "{absent}"
    );
}

/// What is derived says what the other says, but for what it says itself: an order that stays, parameters and all.
#[test]
fn what_is_derived_is_listed_whole() {
    let world = "tests/scenario/derived.alb#ours_in_it";
    insta::assert_snapshot!(listed(&[world, "--no-out"]));
    let set = listed(&[world, "--no-out", "--set", "depth=8m", "--set", "ours_in_it.speed=3cm/s"]);
    assert!(set.contains("from              8 m\n") && set.contains("0.06 m/s toward 90 deg\n"), "{set}");
    let refused = |value: &str, why: &str| {
        let output = show(Path::new(env!("CARGO_MANIFEST_DIR")), &[world, "--no-out", "--set", value]);
        let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert!(output.status.code() == Some(3) && said.contains(why), "{value}: {said}");
    };
    // A parameter in the place of the base's has another default and range.
    let faster = listed(&["tests/scenario/derived.alb#faster", "--no-out"]);
    assert!(faster.contains("0.15 m/s toward 90 deg\n"), "{faster}");
    refused("depth=80m", "is outside the range of `depth`");
    refused("deeper.speed=3cm/s", "what runs is `ours_in_it`");
}

/// A world that is derived is the one that is written whole, to the last number.
#[test]
fn what_is_derived_is_what_is_written_whole() {
    let folder = folder("whole");
    let library = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/stdlib/scenarios.alb")).unwrap();
    let duck = library.split("scenario duck_2003(").nth(1).and_then(|rest| rest.split("\n}").next()).unwrap();
    let whole = format!("scenario whole({}\n}}\n", duck.replace("sigma: 2 m", "sigma: 10 m"));
    std::fs::write(folder.join("whole.alb"), whole).unwrap();
    let (derived, whole) = (show(&folder, &["duck_2003_rough", "--no-out"]), show(&folder, &["whole.alb", "--no-out"]));
    let text = |output: Output| String::from_utf8(output.stdout).unwrap();
    assert_eq!(text(derived).replace("duck_2003_rough  (like duck_2003)", "whole"), text(whole));
}

/// Of a survey more than its file: where it lies, how large it is and how deep.
#[test]
fn a_surveyed_bottom_is_listed_as_it_came_to_lie() {
    let listing = listed(&["tests/scenario/bay.alb", "--no-out"]);
    insta::assert_snapshot!(listing.split("\n\nvehicle").next().unwrap());
}

/// Of what is played more than its file: how many samples there are of each, when they come and what they tell.
#[test]
fn what_is_played_is_listed_as_it_comes() {
    let listing = listed(&["tests/scenario/played.alb", "--no-out"]);
    let played: Vec<&str> = listing.split("\n\n").filter(|clause| clause.starts_with("played\n")).collect();
    insta::assert_snapshot!(played.join("\n\n"));
}

/// The library's scenarios can all be, and those of the trial differ where they say so.
#[test]
fn the_library_has_worlds_that_can_be() {
    let library = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/stdlib/scenarios.alb")).unwrap();
    let names = library.lines().filter_map(|line| line.strip_prefix("scenario ")?.split(['(', ' ']).next());
    let shown: Vec<String> = names.map(|name| listed(&[name, "--no-out"])).collect();
    assert!(shown.len() >= 9, "{}", shown.len());
    let rough = shown.iter().find(|text| text.starts_with("scenario duck_2003_rough  (like duck_2003)\n")).unwrap();
    assert!(rough.contains("sigma             10 m\n"), "{rough}");
}

#[test]
fn the_picture_is_a_file_of_its_own() {
    let folder = folder("picture");
    let output = show(&folder, &["duck_2003", "--seed", "3"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.ends_with("picture albacore-runs/duck_2003-3/scenario.svg\n"), "{said}");
    let picture = std::fs::read_to_string(folder.join("albacore-runs/duck_2003-3/scenario.svg")).unwrap();
    for word in ["scenario duck_2003", "seed 3", "region", "dye", "plume", "start", "depth, every 0.5 m"] {
        assert!(picture.contains(word), "no {word}");
    }
    assert_eq!(show(&folder, &["duck_2003", "--out", "mine.svg"]).status.code(), Some(0));
    assert_ne!(std::fs::read_to_string(folder.join("mine.svg")).unwrap(), picture, "another seed");
}

fn drawn(name: &str, scenario: &str) -> String {
    let path = folder(name).join("scenario.svg");
    listed(&[scenario, "--out", path.to_str().unwrap()]);
    std::fs::read_to_string(path).unwrap()
}

/// The coordinates on the axes, and the length of the scale bar, tell how much of the world is seen.
#[test]
fn the_picture_shows_all_of_a_survey_or_the_water_near_by() {
    let maine = drawn("maine", "missions/deepest_real.alb#gulf_of_maine");
    for word in ["survey", "depth, every 20.0 m", ">1 km<", ">-2000<", ">1000<"] {
        assert!(maine.contains(word), "no {word}");
    }
    let bay = drawn("bay", "tests/scenario/bay.alb");
    for word in ["survey", "depth, every 1.0 m", ">600<", ">-400<", ">400<"] {
        assert!(bay.contains(word), "no {word}");
    }
    let nothing = drawn("nothing", "tests/scenario/nothing.alb");
    assert!(nothing.contains(">-100<") && nothing.contains(">100<") && !nothing.contains("survey"));
}

/// Each layer's flow by its name, first that which carries the plume; waves carry nothing.
#[test]
fn the_picture_tells_the_flow_of_each_layer() {
    let layers = drawn("layers", "duck_2003_two_layers");
    let carries = layers.find("lower layer: 12.1 cm/s").unwrap();
    assert!(carries < layers.find("above 3.2 m: 22.5 cm/s").unwrap());
    let folder = folder("waves");
    let waves = "scenario wavy {\n    flow(10 cm/s toward 90 deg)\n    waves(height: 2 m)\n}\n";
    std::fs::write(folder.join("wavy.alb"), waves).unwrap();
    assert_eq!(show(&folder, &["wavy.alb", "--out", "wavy.svg"]).status.code(), Some(0));
    let picture = std::fs::read_to_string(folder.join("wavy.svg")).unwrap();
    assert!(picture.contains("flow 10.0 cm/s") && picture.contains("toward 90°"));
}

#[test]
fn a_leak_is_drawn_as_the_line_that_it_is() {
    let picture = drawn("leak", "tests/scenario/ocean.alb");
    assert!(picture.contains(">leak</text>") && picture.matches(">pipe</text>").count() == 1);
}

/// Each of them with its name and whole, however far away it is.
#[test]
fn spills_are_drawn_as_they_are_when_a_run_begins() {
    let picture = drawn("spills", "tests/report/spills.alb#oil_and_dye");
    for word in [">oil<", ">dye<", ">slick<", ">true outline<", ">2 km<"] {
        assert!(picture.contains(word), "no {word}");
    }
    assert!(!picture.contains("at the start") && !picture.contains("% left"));
    let listing = listed(&["tests/report/spills.alb#oil_and_dye", "--no-out"]);
    assert!(listing.matches("\nspill\n").count() == 3 && !listing.contains("filaments when"), "{listing}");
}

/// A folder that is named must be there, as for the table of a campaign.
#[test]
fn a_picture_for_no_folder_is_refused() {
    let folder = folder("nowhere");
    let output = show(&folder, &["duck_2003", "--out", "no/mine.svg"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(said.starts_with("error: `no/mine.svg` cannot be written: "), "{said}");
    assert!(said.contains("choose another file with `--out`") && !folder.join("no").exists(), "{said}");
}

/// The points that a vehicle swims to by itself are listed, drawn, and swum to.
#[test]
fn a_mission_of_waypoints_is_shown_and_swum() {
    let script = "tests/scenario/waypoints.alb";
    let said = listed(&[script, "--no-out"]);
    assert!(said.contains("points            36°10.881'N 75°44.400'W (150.0, 0.0) m\n"), "{said}");
    assert!(said.contains("                  36°10.789'N 75°44.320'W (-20.0, 120.0) m\n"), "{said}");
    let picture = folder("waypoints").join("lagoon.svg");
    assert_eq!(
        show(Path::new(env!("CARGO_MANIFEST_DIR")), &[script, "--out", picture.to_str().unwrap()]).status.code(),
        Some(0)
    );
    assert!(std::fs::read_to_string(picture).unwrap().contains("its own mission"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["test", script]).current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1");
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(String::from_utf8_lossy(&output.stdout).contains("2 passed, 0 failed"));
}

#[test]
fn what_cannot_be_shown_is_said() {
    let folder = folder("refused");
    std::fs::write(folder.join("none.alb"), "const one = 1\n").unwrap();
    std::fs::write(folder.join("wet.alb"), "scenario dry { tide(\"M2\", 20 m/s toward 0 deg) }\n").unwrap();
    std::fs::write(folder.join("fresh.alb"), "scenario dead_sea { stratification(surface_salinity: 340 psu) }\n")
        .unwrap();
    std::fs::write(folder.join("both.alb"), "scenario both {\n    rows()\n    waypoints([point(1 m, 2 m)])\n}\n")
        .unwrap();
    std::fs::write(folder.join("nowhere.alb"), "scenario nowhere { waypoints([]) }\n").unwrap();
    for (arguments, code, expected) in [
        (&["duk_2003"][..], 2, "did you mean `duck_2003`?"),
        (&["elsewhere.alb"], 2, "there is no file `elsewhere.alb`"),
        (&["none.alb"], 2, "which scenario of `none.alb` is to be shown?"),
        (&["fresh.alb"], 3, "`surface_salinity` is in 0 psu..42 psu"),
        (&["both.alb"], 3, "a scenario has one `rows` or one `waypoints`"),
        (&["nowhere.alb"], 3, "there is nowhere to swim to"),
        (&["wet.alb"], 3, "it must be 10 m/s at most"),
    ] {
        let output = show(&folder, arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(code), 0), "{said}");
        assert!(said.contains(expected), "{said}");
    }
}

/// A world with a parameter that makes it impossible, and one that is none of its own.
const RACE: &str = "scenario race(speed: Speed = 20 m/s) {
    flow(speed toward 90 deg)
    bottom(from: 20 m, to: 20 m)
    vehicle(kinematic, start: point(north: -60 m, east: -40 m), depth: 3 m)
}
scenario pond { vehicle(kinematic, start: point(north: 0 m, east: 0 m)) }
";

fn albacore(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    command.output().unwrap()
}

/// A folder with [`RACE`] and a mission.
fn raced(name: &str) -> PathBuf {
    let folder = folder(name);
    std::fs::write(folder.join("worlds.alb"), RACE).unwrap();
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/missions/box.alb"), folder.join("box.alb")).unwrap();
    folder
}

/// Whoever runs a mission in a world that cannot be is told as `check` tells: file, line, place and mend.
#[test]
fn an_impossible_world_is_told_alike_by_every_verb() {
    let folder = raced("alike");
    let told = |arguments: &[&str]| {
        let output = albacore(&folder, arguments);
        assert_eq!(output.status.code(), Some(3), "{arguments:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let checked = told(&["check", "worlds.alb"]);
    insta::assert_snapshot!(checked);
    for arguments in [
        &["run", "box.alb", "--in", "worlds.alb#race", "--no-out"][..],
        &["campaign", "box.alb", "--in", "worlds.alb#race", "--seeds", "1..2", "--out", "table.csv"],
        &["repl", "box.alb", "--in", "worlds.alb#race"],
        &["vehicle", "worlds.alb#race", "--link", "pty:?dialect=recon"],
        &["scenario", "show", "worlds.alb#race", "--no-out"],
    ] {
        assert_eq!(told(arguments), checked, "{arguments:?}");
    }
    // A test runs in a scenario of its own file.
    let both = std::fs::read_to_string(folder.join("box.alb"))
        .unwrap()
        .replace("25 cm/s toward 90 deg)", "20 m/s toward 90 deg)");
    std::fs::write(folder.join("box.alb"), both).unwrap();
    assert_eq!(told(&["test", "box.alb"]), told(&["check", "box.alb"]));
}

/// `--set` reaches the scenario that is named, in whatever file it is.
#[test]
fn parameters_of_the_world_that_is_named_are_set() {
    let folder = raced("set");
    let ends = |arguments: &[&str], code: i32, expected: &str| {
        let output = albacore(&folder, arguments);
        let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    };
    let elsewhere = ["run", "box.alb", "--no-out", "--in", "worlds.alb#race", "--set"];
    ends(&[&elsewhere[..], &["race.speed=10 cm/s"]].concat(), 0, "completed");
    ends(&[&elsewhere[..], &["race.speed=3 m"]].concat(), 3, "is a Length");
    ends(&[&elsewhere[..], &["race.sped=3 m/s"]].concat(), 3, "did you mean `speed`?");
    ends(&[&elsewhere[..], &["speed=10 cm/s"]].concat(), 3, "`--set DECLARATION.PARAMETER=VALUE`");
    ends(&["run", "box.alb", "--no-out", "--in", "duck_2003", "--set", "stp=2s"], 3, "did you mean `step`?");
    ends(&["scenario", "show", "worlds.alb#race", "--no-out", "--set", "speed=10 cm/s"], 0, "0.1 m/s toward 90 deg");
    ends(&["scenario", "show", "duck_2003", "--no-out", "--set", "step=2s"], 0, "step              2 s");
    let campaign = ["campaign", "box.alb", "--in", "worlds.alb#race", "--seeds", "1", "--out", "table.csv", "--set"];
    ends(&[&campaign[..], &["race.speed=10 cm/s"]].concat(), 0, "1 completed");
}
