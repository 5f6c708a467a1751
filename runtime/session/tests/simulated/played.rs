//! What one run recorded is played in another, which then records the same.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use crate::sink::Sink;
use albacore_session::{Faults, PastRun, Plan, RECORDED, Run, Source, load_text, run_test};
use std::path::{Path, PathBuf};

/// What can be recorded and played and is one number, but for what the vehicle tells of itself.
const NUMBERS: [&str; 9] =
    ["chemical", "temperature", "salinity", "battery", "depth", "altitude", "speed", "heading", "course"];
/// What is several numbers, and the columns of a table that records these.
const SEVERAL: [&str; 3] = ["position", "flow", "beacon"];
const OF_SEVERAL: [&str; 8] =
    ["north", "east", "position.sigma", "flow.north", "flow.east", "beacon.north", "beacon.east", "beacon.sigma"];
const MISSION: &str = "mission north in w within 10 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    requires { position, heading, course fresh 5 s, else abort }
    recovery within 1 min { wait for 1 s }
    record chemical, temperature, salinity, battery, depth, altitude, speed, heading, course, position, flow, beacon at 1 Hz
    with speed 1.5 m/s
    steer 10 deg at depth 6 m for 1 min
}
";
/// A sea in which each of them goes up and down.
const SEA: &str = "still_water with {
    vehicle(kinematic, start: point(-60 m, 0 m))
    bottom(from: 10 m, to: 20 m, toward: 0 deg)
    flow(10 cm/s toward 180 deg)
    region(area: rectangle(center: point(0 m, 0 m), along: 0 deg, length: 300 m, width: 100 m))
    plume()
    source(\"dye\", at: point(0 m, 0 m))
    stratification(surface: 18 degC, bottom: 9 degC, surface_salinity: 31 psu, bottom_salinity: 35 psu, thermocline: 4 m)
    ctd(temperature_noise: 0.1 degC, salinity_noise: 0.1 psu)
    fluorometer(noise: 1 %)
    compass(noise: 1 deg)
    pressure(noise: 5 cm)
    sounder(noise: 5 cm, dropouts: 20 %)
    dvl(noise: 2 cm/s)
    battery(noise: 1 %)
    navigation(dead_reckoning(0.5 m/s^0.5))
    beacon(at: point(40 m, 20 m), points: [point(60 m, 90 m)], times: [1 min])
    usbl(noise: 50 cm, dropouts: 20 %)
    fault(position, off, from: 30 s, to: 33 s)
}";

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("played").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("albacore.toml"), "").unwrap();
    folder
}

fn plan(folder: &Path, world: &str) -> Plan {
    let text = format!("{MISSION}scenario w = {world}\n");
    let script = load_text(Source { name: folder.join("script.alb").display().to_string().into(), text: text.into() });
    assert!(script.is_sound(), "{:#?}", script.findings);
    Plan::new(&script, "script.alb", None, None).unwrap()
}

/// What a run records.
fn recorded(plan: &Plan) -> String {
    let mut run = Run::new(plan, 1).unwrap();
    run.to_end();
    run.file(&RECORDED)
}

/// A column of a table by what it is of: each cell, the head first.
fn column<'a>(table: &'a str, name: &str) -> Vec<&'a str> {
    let is_of = |head: &str| head.split(" (").next() == Some(name);
    let place = table.lines().next().unwrap().split(',').position(is_of).unwrap();
    table.lines().map(|line| line.split(',').nth(place).unwrap()).collect()
}

/// Still water, where nothing is as it was, and clauses that play it all.
fn playing(more: &str) -> String {
    let clauses: String =
        NUMBERS.iter().chain(&SEVERAL).map(|name| format!("    played(\"{name}\", file: \"dive.csv\")\n")).collect();
    format!("still_water with {{\n{clauses}{more}\n}}")
}

#[test]
fn what_was_recorded_is_recorded_again_when_it_is_played() {
    let folder = folder("again");
    let before = recorded(&plan(&folder, SEA));
    assert!(before.lines().count() > 55, "{before}");
    std::fs::write(folder.join("dive.csv"), &before).unwrap();
    let plan = plan(&folder, &playing(""));
    assert_eq!(plan.sources.last().unwrap().name, "dive.csv", "no campaign goes on with another file");
    let again = recorded(&plan);
    for name in std::iter::once("time").chain(NUMBERS).chain(OF_SEVERAL) {
        let (before, again) = (column(&before, name), column(&again, name));
        let differs = before.iter().zip(&again).find(|(before, again)| before != again);
        assert_eq!((differs, before.len()), (None, again.len()), "{name}");
        let told: std::collections::BTreeSet<&&str> = before.iter().skip(1).filter(|cell| !cell.is_empty()).collect();
        assert!(told.len() > 1, "{name}: nothing is shown by what never changes: {told:?}");
    }
}

/// A fault acts on what is played, and a journal of it gives the same again, without the file.
#[test]
fn what_is_played_fails_as_what_is_sensed_does() {
    let folder = folder("fails");
    std::fs::write(folder.join("dive.csv"), recorded(&plan(&folder, SEA))).unwrap();
    let plan = plan(&folder, &playing("fault(chemical, off, from: 20 s, to: 30 s)"));
    let sink = Sink::default();
    let mut run = Run::new(&plan, 1).unwrap();
    run.with_journal(Box::new(sink.clone()), &[]);
    run.to_end();
    let table = run.file(&RECORDED);
    let silent = column(&table, "time").into_iter().zip(column(&table, "chemical")).filter(|(_, cell)| cell.is_empty());
    let times: Vec<f64> = silent.map(|(time, _)| time.parse().unwrap()).collect();
    assert_eq!(times, (20..30).map(f64::from).collect::<Vec<_>>());
    std::fs::remove_file(folder.join("dive.csv")).unwrap();
    assert_eq!(PastRun::read(&plan, &sink.bytes()).unwrap().file(&RECORDED), table);
}

/// The vehicle swims by the sensors that it has, and a test asks for what is so.
#[test]
fn the_truth_is_as_ever() {
    let folder = folder("truth");
    let rows: String = (0..=60).map(|second| format!("{second},1\n")).collect();
    std::fs::write(folder.join("dive.csv"), format!("time (s),depth (m)\n{rows}")).unwrap();
    let world = "still_water with { played(\"depth\", file: \"dive.csv\"); ctd(); usbl() }";
    let table = recorded(&plan(&folder, world));
    assert!(column(&table, "depth").iter().skip(1).all(|cell| *cell == "1"), "{table}");
    held(&folder, world, "truth.depth > 5.9 m");
}

/// Asks what is so at the end.
fn held(folder: &Path, world: &str, expected: &str) {
    let test = format!("test \"so\" {{\n run north in w seeds 1..1\n expect {expected}\n}}\n");
    let name = folder.join("script.alb").display().to_string();
    let script = load_text(Source { name: name.into(), text: format!("{MISSION}scenario w = {world}\n{test}").into() });
    let test = script.tests().pop().unwrap().unwrap();
    let result = run_test(&script, &test, &Faults::default());
    let Ok(result) = result else { unreachable!("its test cannot be run") };
    assert!(result.failures.is_empty(), "{:#?}", result.failures);
}

/// What stands in a row since an earlier one is no sample of it: where a position was silent, it is silent again.
#[test]
fn a_position_that_was_silent_is_played_silent() {
    let folder = folder("silent");
    let silent = |table: &str| {
        let cells = column(table, "north").into_iter().zip(column(table, "position.sigma"));
        let silent = column(table, "time").into_iter().zip(cells).filter(|(_, (_, sigma))| sigma.is_empty());
        silent.map(|(time, (north, _))| (time.to_string(), !north.is_empty())).collect::<Vec<_>>()
    };
    let table = recorded(&plan(&folder, SEA));
    let a_place_stands_there = true;
    assert_eq!(silent(&table), ["31.0", "32.0"].map(|time| (time.to_string(), a_place_stands_there)));
    std::fs::write(folder.join("dive.csv"), &table).unwrap();
    assert_eq!(silent(&recorded(&plan(&folder, &playing("")))), silent(&table));
}

/// Who tells no sigma is taken to be exact.
#[test]
fn a_position_without_a_sigma_is_exact_and_the_vehicle_is_elsewhere() {
    let folder = folder("exact");
    let rows: String = (0..=60).map(|second| format!("{second},{second},-7.5\n")).collect();
    std::fs::write(folder.join("dive.csv"), format!("time (s),north (m),east (m)\n{rows}")).unwrap();
    let world = "still_water with { played(\"position\", file: \"dive.csv\"); ctd(); usbl() }";
    let table = recorded(&plan(&folder, world));
    let told = |name: &str| column(&table, name).into_iter().skip(1).collect::<std::collections::BTreeSet<_>>();
    assert_eq!((told("east"), told("position.sigma")), (["-7.50"].into(), ["0"].into()));
    held(&folder, world, "distance(truth.position, north.op.center + 90 m toward 10 deg) < 15 m");
}

#[test]
fn a_campaign_knows_a_file_by_what_it_holds() {
    let folder = folder("digest");
    let digest = |number: &str| {
        std::fs::write(folder.join("dive.csv"), format!("time (s),temperature (degC)\n1,{number}\n")).unwrap();
        plan(&folder, "still_water with { played(\"temperature\", file: \"dive.csv\"); ctd(); usbl() }")
            .sources
            .pop()
            .unwrap()
    };
    assert_ne!(digest("12"), digest("13"));
    assert_eq!(digest("12"), digest("12"));
}
