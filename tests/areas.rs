//! Areas of files: a mission that works in one and keeps out of another, and what of the files is kept with the run.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use albacore_geometry::math::{TAU, cos, sin};
use albacore_session::{Plan, load};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const FILES: [&str; 3] = ["from_files.alb", "bay.geojson", "wreck.kml"];

/// A folder of a test's own with the mission and its files.
fn project(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("areas-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for file in FILES {
        std::fs::copy(Path::new("tests/areas").join(file), folder.join(file)).unwrap();
    }
    folder
}

/// Puts something else for a piece of a file.
fn edit(folder: &Path, file: &str, old: &str, new: &str) {
    let text = std::fs::read_to_string(folder.join(file)).unwrap();
    assert!(text.contains(old), "{old}");
    std::fs::write(folder.join(file), text.replace(old, new)).unwrap();
}

fn plan(folder: &Path) -> Plan {
    let script = load(&folder.join(FILES[0]), None, &[]).unwrap();
    assert_eq!(script.findings, []);
    Plan::new(&script, FILES[0], None, None).unwrap()
}

/// What the program ends with and says, in a folder.
fn albacore(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
}

#[test]
fn a_mission_runs_in_the_area_of_a_file_and_round_another() {
    let folder = project("run");
    let (status, told) = albacore(&folder, &["run", FILES[0], "--no-out"]);
    assert!(status == Some(0) && told.contains("completed"), "{told}");
}

/// The outline of a harbour with three bays, its shore a zigzag, in GeoJSON.
fn harbour(corners: u32) -> String {
    let corner = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(corners);
        let zigzag = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
        let out = 200.0 + 80.0 * cos(3.0 * angle) + zigzag;
        format!("[{}, {}]", -75.74 + out * sin(angle) / 89_870.0, 36.18 + out * cos(angle) / 110_950.0)
    };
    let ring: Vec<String> = (0..corners).map(corner).collect();
    format!("{{\"type\": \"Polygon\", \"coordinates\": [[{}]]}}", ring.join(", "))
}

/// An attack: cages with sharp corners and with slots let vehicles out, and a vehicle that was told to turn away from a zone turned through it.
#[test]
fn corners_slots_and_turns_are_kept() {
    let (status, told) = albacore(Path::new("tests/areas"), &["test", "corners.alb", "regions.alb"]);
    assert!(status == Some(0) && told.contains("6 passed"), "{told}");
}

#[test]
fn a_search_stays_in_an_area_of_hundreds_of_corners_with_dents() {
    let folder = project("harbour");
    std::fs::copy("tests/areas/harbour.alb", folder.join("harbour.alb")).unwrap();
    std::fs::write(folder.join("harbour.geojson"), harbour(300)).unwrap();
    let (status, told) = albacore(&folder, &["test", "harbour.alb"]);
    assert!(status == Some(0) && told.contains("1 passed"), "{told}");
    // Whoever asks for more at once than a tick has room for is told before the launch.
    std::fs::write(folder.join("harbour.geojson"), harbour(1025)).unwrap();
    let (status, told) = albacore(&folder, &["check", "harbour.alb"]);
    assert!(status == Some(3) && told.contains("has 1025 corners, and an area has at most 1024"), "{told}");
}

#[test]
fn a_zone_with_a_basin_is_gone_round() {
    let (status, told) = albacore(Path::new("tests/areas"), &["test", "pier.alb"]);
    assert!(status == Some(0) && told.contains("1 passed"), "{told}");
}

#[test]
fn corners_of_a_file_are_those_that_a_script_would_write() {
    let folder = project("written");
    let of_file = plan(&folder);
    for written in [
        "area_file(\"bay.geojson\", named: \"wreck\")",
        "polygon([36.1804°N 75.7398°W, 36.1804°N 75.7396°W, 36.1806°N 75.7397°W]) else area_file(\"wreck.kml\")",
    ] {
        edit(&project("written"), FILES[0], "area_file(\"wreck.kml\")", written);
        let zones = |plan: &Plan| plan.scenario.environment.no_go.clone();
        assert_eq!(zones(&plan(&folder)), zones(&of_file));
        assert_eq!(zones(&of_file).len(), 1);
    }
}

#[test]
fn a_polygon_with_a_hole_is_an_area_where_the_hole_is_read_too() {
    let (folder, holed) = (project("whole"), project("holed"));
    let ring = "[[-75.7398, 36.1804], [-75.7396, 36.1804], [-75.7397, 36.1806], [-75.7398, 36.1804]]";
    edit(&holed, "bay.geojson", "36.182], [-75.742, 36.178]]]", &format!("36.182], [-75.742, 36.178]], {ring}]"));
    let script = load(&holed.join(FILES[0]), None, &[]).unwrap();
    let found: Vec<&str> = script.findings.iter().map(|finding| finding.code.name()).collect();
    assert_eq!(found, ["areas::file"], "nothing knows of the hole");
    edit(&holed, FILES[0], "area_file(\"wreck.kml\")", "area_file(\"bay.geojson\", named: \"box\", hole: 1)");
    let (whole, holed) = (plan(&folder), plan(&holed));
    assert_eq!(
        (holed.scenario.environment.no_go.len(), &holed.scenario.environment.no_go),
        (1, &whole.scenario.environment.no_go)
    );
    assert_eq!(holed.frame().unwrap().origin, whole.frame().unwrap().origin);
}

#[test]
fn a_start_outside_the_area_of_a_file_is_told() {
    let folder = project("outside");
    edit(&folder, FILES[0], "36°10.74'N", "36°12.74'N");
    let script = load(&folder.join(FILES[0]), None, &[]).unwrap();
    let found: Vec<&str> = script.findings.iter().map(|finding| finding.code.name()).collect();
    assert_eq!(found, ["scenarios::outside"]);
}

#[test]
fn a_run_keeps_the_digests_of_the_files_that_it_was_made_from() {
    let folder = project("digest");
    let digest = |plan: &Plan, file: &str| plan.sources.iter().find(|s| s.name == file).unwrap().digest;
    let before = plan(&folder);
    edit(&folder, "bay.geojson", "36.182", "36.183");
    let after = plan(&folder);
    assert_ne!(digest(&before, "bay.geojson"), digest(&after, "bay.geojson"));
    assert_eq!(digest(&before, "wreck.kml"), digest(&after, "wreck.kml"));
}

/// What every verb says before the first tick, and that it says the same.
#[test]
fn a_scenario_elsewhere_is_told_before_the_first_tick() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mission = "missions/duck_single.alb";
    let told = |args: &[&str]| {
        let (status, told) = albacore(root, args);
        assert_eq!(status, Some(3), "{args:?}: {told}");
        told
    };
    let check = told(&["check", mission, "--in", "sci_2002"]);
    assert!(check.contains("`sci_2002` lies 3903 km from the area of the mission `duck_single`"), "{check}");
    assert!(check.contains("`--in duck_2003`"), "{check}");
    assert_eq!(told(&["run", mission, "--in", "sci_2002", "--no-out"]), check);
    let table = Path::new(env!("CARGO_TARGET_TMPDIR")).join("areas-elsewhere.csv");
    assert_eq!(
        told(&["campaign", mission, "--in", "sci_2002", "--seeds", "1..2", "--out", table.to_str().unwrap()]),
        check
    );
    assert!(!table.exists());
    let (status, well) = albacore(root, &["check", mission, "--in", "duck_2003_flat"]);
    assert_eq!(status, Some(0), "{well}");
    let (status, misspelt) = albacore(root, &["check", mission, "--in", "sci_202"]);
    assert!(status == Some(2) && misspelt.contains("did you mean `sci_2002`?"), "{misspelt}");
}

/// A no-go zone far from the area keeps the mission from nothing, in a scenario that is named on the command line too.
#[test]
fn a_no_go_zone_far_away_is_told_in_any_scenario() {
    let folder = project("far-zone");
    let zone = "rectangle(center: 36.18°N 70.0°W, along: 0 deg, length: 40 m, width: 40 m)";
    let text = std::fs::read_to_string(folder.join(FILES[0])).unwrap();
    let scenario = text.lines().find_map(|line| line.strip_prefix("scenario ")).unwrap();
    let name = scenario.split([' ', '(']).next().unwrap();
    let (_, rest) = text.split_once("\nscenario ").unwrap();
    let (block, _) = rest.split_once("\n}").unwrap();
    let copy = format!("\nscenario {block}\n}}\n").replacen(name, "other", 1);
    let copy = copy.replacen('{', &format!("{{\n    no_go(\"far\", {zone})"), 1);
    std::fs::write(folder.join(FILES[0]), text + &copy).unwrap();
    let (_, told) = albacore(&folder, &["check", FILES[0], "--in", "other"]);
    assert!(told.contains("the no-go zone \"far\" of `other` is 51"), "{told}");
}

/// A file that has the latitude first lies somewhere else on the globe: what the scenario says of places shows it.
#[test]
fn a_file_with_the_latitude_first_is_told() {
    let folder = project("swapped");
    let bay = std::fs::read_to_string(folder.join("bay.geojson")).unwrap();
    let swapped = bay.replace("-75.742, 36.178", "36.178, -75.742").replace("-75.738, 36.178", "36.178, -75.738");
    let swapped = swapped.replace("-75.738, 36.182", "36.182, -75.738").replace("-75.742, 36.182", "36.182, -75.742");
    std::fs::write(folder.join("bay.geojson"), swapped).unwrap();
    for args in [&["check", FILES[0]][..], &["run", FILES[0], "--no-out"]] {
        let (status, told) = albacore(&folder, args);
        assert!(status == Some(3) && told.contains("areas::swapped"), "{told}");
        assert!(told.contains("latitude and longitude seem to be swapped"), "{told}");
    }
}

/// The origin of a mission across the 180th meridian lies in its middle, and what it reports has longitudes as people write them.
#[test]
fn a_mission_runs_across_the_180th_meridian() {
    let folder = project("antimeridian");
    let bay = "{\"type\": \"Polygon\", \"coordinates\": \
               [[[179.998, -17.002], [-179.998, -17.002], [-179.998, -16.998], [179.998, -16.998]]]}";
    std::fs::write(folder.join("taveuni.geojson"), bay).unwrap();
    let mission = "mission taveuni in strait within 30 min {\n\
        area op = area_file(\"taveuni.geojson\")\n\
        limits { altitude >= 2 m, speed <= 2.5 m/s }\n\
        requires { position, course, heading fresh 5 s, else abort }\n\
        recovery within 5 min { goto op.center }\n\
        with depth 3 m, speed 1.5 m/s\n\
        goto 17°0.0'S 179°59.95'W\n\
        report \"east\": position\n\
        goto 17°0.0'S 179°59.95'E\n\
        report \"west\": position\n\
    }\n\
    scenario strait { vehicle(kinematic, start: 17°0.0'S 179°59.95'E, depth: 3 m) }\n";
    std::fs::write(folder.join("taveuni.alb"), mission).unwrap();
    let (status, told) = albacore(&folder, &["check", "taveuni.alb"]);
    assert!(status == Some(0) && told.contains("no errors"), "{told}");
    let (status, told) = albacore(&folder, &["run", "taveuni.alb", "--out", "run", "--replace"]);
    assert!(status == Some(0) && told.contains("completed"), "{told}");
    let trace = std::fs::read_to_string(folder.join("run/trace.txt")).unwrap();
    let picture = std::fs::read_to_string(folder.join("run/run.svg")).unwrap().replace("&#39;", "'");
    for text in [&told, &trace, &picture] {
        assert!(text.contains("17°0.000'S 179°59.9") && text.contains("'W") && text.contains("'E"), "{text}");
    }
    assert!(picture.contains("origin (0, 0) at 17°0.000'S 180°0.000'"), "{picture}");
    let (_, json) = albacore(&folder, &["run", "taveuni.alb", "--no-out", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let longitude = |i: usize| json["reports"][i]["longitude_deg"].as_f64().unwrap();
    assert!(longitude(0) < -179.99 && longitude(1) > 179.99, "{json}");
    assert!(json["reports"][0]["latitude_deg"].as_f64().unwrap() < -16.99);
}

/// Where a start lies that is too far away, not where the region does.
#[test]
fn a_start_far_away_is_told_with_its_place() {
    let folder = project("far-start");
    edit(&folder, FILES[0], "36°10.74'N", "37°10.74'N");
    let region = "region(rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 900 m, width: 900 m))";
    edit(&folder, FILES[0], "    no_go(", &format!("    {region}\n    no_go("));
    let (_, told) = albacore(&folder, &["check", FILES[0]]);
    assert!(told.contains("the start about 37°10.740'N"), "{told}");
}
