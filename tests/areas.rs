//! Areas of files: a mission that works in one and keeps out of another, and what of the files is kept with the run.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

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

#[test]
fn corners_of_a_file_are_those_that_a_script_would_write() {
    let folder = project("written");
    let of_file = plan(&folder);
    for written in [
        "area_file(\"bay.geojson\", named: \"wreck\")",
        "polygon([36.1804°N 75.7398°W, 36.1804°N 75.7396°W, 36.1806°N 75.7397°W]) else area_file(\"wreck.kml\")",
    ] {
        edit(&project("written"), FILES[0], "area_file(\"wreck.kml\")", written);
        let zones = |plan: &Plan| plan.scenario.no_go.clone();
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
    assert_eq!((holed.scenario.no_go.len(), &holed.scenario.no_go), (1, &whole.scenario.no_go));
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
