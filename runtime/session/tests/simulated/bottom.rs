//! Surveyed bottoms and no-go zones, from a script to what is told of a run.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Diagnostic, Outcome, PICTURE, Plan, PlanError, Run, Severity, Source, findings, load_text};
use std::path::{Path, PathBuf};

const MISSION: &str = "mission north in w within 10 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { wait for 1 s }
    with depth 4 m, speed 2 m/s
    steer 0 deg for 25 s
    with depth 1 m
    steer 0 deg for 10 s
}
";

/// A folder with an empty project in it, for the files of a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bottom").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("albacore.toml"), "").unwrap();
    folder
}

fn missions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions")
}

fn plan(folder: &Path, clauses: &str) -> Result<Plan, PlanError> {
    let text = format!("{MISSION}scenario w {{\n{clauses}\n}}\n");
    let script = load_text(Source { name: folder.join("script.alb").display().to_string().into(), text: text.into() });
    assert!(script.is_sound(), "{:#?}", script.findings);
    // What a run refuses, `check` finds.
    let plan = Plan::new(&script, "script.alb", None, None);
    assert_eq!(plan.is_err(), findings(&script).iter().any(|finding| finding.severity == Severity::Error));
    plan
}

fn refused(folder: &Path, clauses: &str) -> Vec<Diagnostic> {
    match plan(folder, clauses) {
        Err(PlanError::Script(findings, _)) => findings,
        other => unreachable!("{other:?}"),
    }
}

/// What was told of the vehicle, and when, without its own mission.
fn told(plan: &Plan) -> (Outcome, Vec<String>) {
    let mut run = Run::new(plan, 1).unwrap();
    let outcome = run.to_end();
    let trace = run.trace().to_string();
    (outcome, trace.lines().filter(|line| line.contains("  vehicle  ")).map(str::to_string).collect())
}

#[test]
fn a_run_over_a_surveyed_bottom_grounds_and_comes_free() {
    let folder = folder("shoal");
    std::fs::write(folder.join("shoal.csv"), "# east -1..1 n=2 north -1..1 n=2 metres\n-12,-12\n8,8\n").unwrap();
    let clauses = "bottom_grid(\"shoal.csv\", at: point(north: 0 m, east: 0 m), scale: 100, depth_scale: 0.5)
        vehicle(kinematic, start: point(north: -50 m, east: 0 m), depth: 1 m)";
    let plan = plan(&folder, clauses).unwrap();
    assert_eq!(plan.scenario.environment.bottom.depth_at(albacore_geometry::Point::new(-100.0, 7.0)), 6.0);
    assert_eq!(plan.sources.last().unwrap().name, "shoal.csv", "a campaign does not go on over another bottom");
    // Half as deep, 200 m wide: 3.5 m deep where it starts, and 5 cm less each metre northward.
    let (outcome, told) = told(&plan);
    // Half a minute on the bottom is more than a touch.
    assert_eq!(outcome, Outcome::Aground);
    assert!(
        matches!(told.as_slice(), [first, free] if first.contains("grounded at ") && free.contains("came free of the bottom at ")),
        "{told:#?}"
    );
}

#[test]
fn the_cuts_of_etopo5_can_be_laid_out() {
    let clauses =
        "bottom_grid(\"bathymetry/mariana.csv\", at: point(north: 100 m, east: 50 m), scale: 1 %, depth_scale: 1 %)
        pit(\"deeper\", at: point(north: 100 m, east: 50 m), depth: 2 m, radius: 10 m)
        vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 1 m)";
    let bottom = plan(&missions(), clauses).unwrap().scenario.environment.bottom.clone();
    let middle = bottom.depth_at(albacore_geometry::Point::new(100.0, 50.0));
    assert!((middle - (30.64 + 2.0)).abs() < 1e-9, "the middle of row 25, cells 30 and 31, and the pit: {middle}");
}

#[test]
fn all_that_is_wrong_with_a_survey_is_told_at_its_clause() {
    let folder = folder("wrong");
    std::fs::write(folder.join("bad.csv"), "# east 0..1 n=2 north 0..1 n=2 metres\n1,nan\n1\n").unwrap();
    let found = refused(&folder, "bottom_grid(\"bad.csv\")");
    let messages: Vec<&str> = found.iter().map(|f| f.message.as_str()).collect();
    let expected =
        ["`bad.csv`: line 2, cell 2: `nan` is no data", "`bad.csv`: line 3 has 1 cell, and the head says n=2"];
    assert_eq!(messages, expected);
    assert!(found.iter().all(|f| f.help.is_some()));

    // In the order of the file, and the rest last.
    let many: String = (2..=30).map(|line| format!("x{line},-1\n")).collect();
    std::fs::write(folder.join("many.csv"), format!("# east 0..1 n=2 north 0..28 n=29 metres\n{many}")).unwrap();
    let messages: Vec<String> =
        refused(&folder, "bottom_grid(\"many.csv\")").into_iter().map(|finding| finding.message).collect();
    assert!(messages.len() == 1 && messages[0].contains("line 2,"), "{messages:#?}");
    assert!(messages[0].ends_with("and 26 more such"), "{messages:#?}");

    let found = refused(&folder, "bottom_grid(\"../../../Cargo.toml\")");
    assert!(found[0].message.contains("does not lie in the project's folder"), "{found:#?}");
    let found = refused(&missions(), "bottom_grid(\"bathymetry/mariana.csv\")");
    assert!(found[0].message.contains("the scenario has no place there"), "{found:#?}");
    let grid = "bottom_grid(\"bathymetry/mariana.csv\", at: point(north: 0 m, east: 0 m))";
    let found = refused(&missions(), &format!("bottom(from: 20 m, to: 20 m)\n{grid}"));
    assert!(found[0].message.contains("one `bottom` or one `bottom_grid`"), "{found:#?}");
}

#[test]
fn a_survey_that_lies_elsewhere_is_no_level_bottom() {
    let folder = folder("elsewhere");
    let utm = "# north 4000000..4000500 n=2 east 350000..350500 n=2 metres\n-10,-12\n-14,-16\n";
    std::fs::write(folder.join("utm.csv"), utm).unwrap();
    std::fs::write(folder.join("far.csv"), "# lon 100..101 n=2 lat -36..-35 n=2 metres\n-2,-3\n-4,-5\n").unwrap();
    let start = |place: &str| format!("    vehicle(kinematic, start: {place})");
    let at_origin = start("point(north: 0 m, east: 0 m)");
    let found = refused(&folder, &format!("bottom_grid(\"utm.csv\")\n{at_origin}"));
    let expected = "the vehicle starts 4015 km outside this survey, which lies 4000000 to 4000500 m north and 350000 to \
        350500 m east";
    assert_eq!((found.len(), found[0].message.as_str()), (1, expected));
    assert!(found[0].help.as_ref().unwrap().contains("`at: point(north: 0 m, east: 0 m)`"), "{found:#?}");
    let laid = "bottom_grid(\"utm.csv\", at: point(north: 0 m, east: 0 m))";
    assert!(plan(&folder, &format!("{laid}\n{at_origin}")).is_ok());
    let edge = start("point(north: 250 m, east: -250 m)");
    assert!(plan(&folder, &format!("{laid}\n{edge}")).is_ok(), "its corner is part of it");
    let found = refused(&folder, &format!("{laid}\n{}", start("point(north: 250 m, east: -251.5 m)")));
    assert!(found[0].message.starts_with("the vehicle starts 1.5 m outside this survey"), "{found:#?}");
    assert!(found[0].help.as_ref().unwrap().starts_with("move the one to the other"), "{found:#?}");
    std::fs::write(folder.join("deep.csv"), "# north 0..500 n=2 east 0..500 n=2 metres\n-10,-12\n-14,-160\n").unwrap();
    let found = refused(&folder, "bottom_grid(\"deep.csv\", at: point(north: 0 m, east: 0 m), depth_scale: 100)");
    assert!(found[0].message.starts_with("this survey is 16000 m deep"), "{found:#?}");
    let duck = MISSION.replace("center: point(north: 0 m, east: 0 m)", "center: 36°10.8'N 75°44.4'W");
    let text = format!("{duck}scenario w {{\nbottom_grid(\"far.csv\")\n{at_origin}\n}}\n");
    let script = load_text(Source { name: folder.join("s.alb").display().to_string().into(), text: text.into() });
    let found = findings(&script);
    assert!(found.len() == 1 && found[0].message.contains(" km outside this survey"), "{found:#?}");
}

#[test]
fn entering_a_no_go_zone_is_told_and_drawn() {
    let clauses = "bottom(from: 20 m, to: 20 m)
        no_go(\"wreck\", rectangle(center: point(north: 50 m, east: 0 m), along: 0 deg, length: 20 m, width: 20 m))
        vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 1 m)";
    let plan = plan(&missions(), clauses).unwrap();
    let (outcome, told) = told(&plan);
    assert_eq!(outcome, Outcome::Completed, "it is told, and forbids nothing");
    let expected = ["entered the no-go zone `wreck` at 40.", "left the no-go zone `wreck` at 60."];
    assert!(told.len() == 2 && told.iter().zip(expected).all(|(line, expected)| line.contains(expected)), "{told:#?}");
    let mut run = Run::new(&plan, 1).unwrap();
    run.to_end();
    assert!(run.file(&PICTURE).contains(">wreck</text>"));
}

#[test]
fn an_area_that_was_not_surveyed_is_told() {
    let folder = folder("unsurveyed");
    std::fs::write(folder.join("flat.csv"), "# east -1..1 n=2 north -1..1 n=2 metres\n-12,-12\n-12,-12\n").unwrap();
    let told = |scale: u32| {
        let place = "point(north: 0 m, east: 0 m)";
        let grid = format!("bottom_grid(\"flat.csv\", at: {place}, scale: {scale})");
        let clauses = format!("{grid}\nvehicle(kinematic, start: {place}, depth: 1 m)");
        let text = format!("{MISSION}scenario w {{\n{clauses}\n}}\n");
        let name = folder.join("script.alb").display().to_string();
        let found = findings(&load_text(Source { name: name.into(), text: text.into() }));
        found.into_iter().map(|finding| (finding.severity, finding.message)).collect::<Vec<_>>()
    };
    // The area is 400 m wide, about the origin; the survey at a scale of 100 half as wide.
    assert_eq!(told(200), []);
    let beyond = "the area of the mission `north` reaches 141 m beyond the survey of `w`".to_string();
    assert_eq!(told(100), [(Severity::Warning, beyond)]);
}
