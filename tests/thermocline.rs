//! The mission that finds a thermocline finds it where it is, whatever its depth and the noise; a vehicle without a CTD is refused
//! before it begins.

#![expect(clippy::unwrap_used, reason = "a test whose mission cannot run has failed")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

const MISSION: &str = "missions/thermocline.alb";

fn run(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["run", MISSION]).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR"));
    command.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap()
}

/// The depth that the mission reports, m.
fn found(thermocline: u32, seed: u32) -> f64 {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("thermocline");
    let _ = std::fs::remove_dir_all(&folder);
    let (set, seed, out) = (format!("thermocline={thermocline}m"), seed.to_string(), folder.to_str().unwrap());
    let output = run(&["--set", "lasting=1min", "--set", &set, "--seed", &seed, "--out", out]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let trace = std::fs::read_to_string(folder.join("trace.txt")).unwrap();
    let report = trace.lines().find(|line| line.contains("report   thermocline")).unwrap();
    let depth = report.split("depth = ").nth(1).and_then(|rest| rest.split(' ').next());
    depth.unwrap().parse().unwrap()
}

#[test]
fn a_thermocline_is_found_where_it_is() {
    for (thermocline, seed) in [(10, 1), (10, 2), (18, 3), (18, 4), (26, 5), (26, 6)] {
        let depth = found(thermocline, seed);
        assert!((depth - f64::from(thermocline)).abs() < 1.2, "{depth} m instead of {thermocline} m, seed {seed}");
    }
}

#[test]
fn a_vehicle_without_a_ctd_is_refused_at_once() {
    let output = run(&["--in", "calm", "--no-out"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("the vehicle of `calm` has no sensor for `temperature`"), "{said}");
}
