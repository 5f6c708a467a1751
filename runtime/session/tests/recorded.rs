//! Scenarios that name a recorded plume: what they bring into the world, and what is said of those that cannot be.

use albacore_session::{Plan, PlanError, Run, Source, findings, load_text};

/// A mission in a scenario of such clauses, as if it lay beside `missions/recorded.alb`.
fn plan(clauses: &str) -> Result<Plan, String> {
    let text = format!(
        "mission m in here within 5 min {{
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 1094 m, width: 367 m)
    limits {{ altitude >= 2 m, speed <= 2.5 m/s }}
    requires {{ position, course, heading fresh 5 s, else abort }}
    with depth 3 m, speed 2 m/s
    recovery within 1 min {{ goto op.center }}
    goto op.center
}}
scenario here {{
    vehicle(kinematic, start: point(north: 0 m, east: 0 m))
    {clauses}
}}
"
    );
    let name = concat!(env!("CARGO_MANIFEST_DIR"), "/../../missions/such.alb");
    let script = load_text(Source { name: name.into(), text: text.into() });
    if let Some(finding) = findings(&script).first() {
        return Err(finding.message.clone());
    }
    Plan::new(&script, "such.alb", None, None).map_err(|error| match error {
        PlanError::Asked(message, help) => format!("{message}: {}", help.unwrap_or_default()),
        PlanError::Script(findings, _) => findings[0].message.clone(),
    })
}

#[test]
fn a_record_brings_flow_plume_source_and_region() {
    let plan = plan("recorded_plume(\"recorded/case_a.json\", kernel: flat, start: 1 min)").unwrap();
    let world = &plan.scenario;
    let recorded = world.recording.as_ref().unwrap();
    assert_eq!((recorded.start, recorded.start_spread, recorded.threshold), (60.0, 0.0, 0.04));
    assert_eq!(format!("{:?}", recorded.kernel), "Flat");
    assert_eq!((world.sources.len(), world.sources[0].name.as_str()), (1, "case_a"));
    assert_eq!((world.sources[0].at.north, world.sources[0].rate), (431.7, 0.5));
    assert!((world.flow.mean.north + 0.12448).abs() < 1e-4 && world.region.is_some());
    assert!(
        plan.sources.iter().any(|source| source.name == "recorded/case_a.json"),
        "the journal tells which record it was"
    );
    let mut run = Run::new(&plan, 1).unwrap();
    run.step();
    assert!(run.svg().contains("case_a"), "the picture shows the source");
}

#[test]
fn records_that_cannot_be_are_told_with_their_file() {
    for (clauses, expected) in [
        ("recorded_plume(\"recorded/case_b.json\")", "there is no file `recorded/case_b.json`"),
        ("recorded_plume(\"../README.md\")", "does not lie in the project's folder"),
        ("recorded_plume(\"/etc/hostname\")", "does not lie in the project's folder"),
        ("recorded_plume(\"recorded\")", "`recorded` is a folder"),
        ("recorded_plume(\"recorded/case_a.bin\")", "`recorded/case_a.bin` has 9.0 MB: 4.194304 MB are read at most"),
        ("recorded_plume(\"box.alb\")", "`box.alb`: the header is not one of a recorded plume"),
        ("recorded_plume(\"recorded/case_a.json\", start: 2 h)", "`recorded_plume.start` is up to 7200 s"),
        (
            "recorded_plume(\"recorded/case_a.json\")\n    flow(10 cm/s toward 90 deg)",
            "the record brings its own `flow`",
        ),
        ("plume(growth: 1e-4 m2/s)\n    recorded_plume(\"recorded/case_a.json\")", "the record brings its own `plume`"),
    ] {
        let said = plan(clauses).map_or_else(|said| said, |_| String::from("sound"));
        assert!(said.contains(expected), "{clauses}: {said}");
    }
}
