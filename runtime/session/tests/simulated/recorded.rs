//! Scenarios that name a recorded plume: what they bring into the world, and what is said of those that cannot be.

use albacore_session::{PICTURE, Plan, PlanError, Run, Script, Severity, Source, findings, load_text};

/// A mission in a scenario of such clauses, as if it lay beside `missions/recorded.alb`. Its area lies about `center`, and is as large as the record's.
fn script(center: &str, clauses: &str) -> Script {
    let text = format!(
        "mission m in here within 5 min {{
    area op = rectangle(center: {center}, along: 0 deg, length: 1094 m, width: 367 m)
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
    load_text(Source { name: name.into(), text: text.into() })
}

fn plan(clauses: &str) -> Result<Plan, String> {
    let script = script("point(north: 0 m, east: 0 m)", clauses);
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
    let recorded = world.environment.recording.as_ref().unwrap();
    assert_eq!((recorded.start, recorded.start_spread, recorded.threshold), (60.0, 0.0, 0.04));
    assert_eq!(format!("{:?}", recorded.kernel), "Flat");
    assert_eq!((world.environment.sources.len(), world.environment.sources[0].name.as_str()), (1, "case_a"));
    assert_eq!((world.environment.sources[0].at.north, world.environment.sources[0].rate), (431.7, 0.5));
    assert!((world.environment.flow.mean.north + 0.12448).abs() < 1e-4 && world.environment.region.is_some());
    assert!(
        plan.sources.iter().any(|source| source.name == "recorded/case_a.json"),
        "the journal tells which record it was"
    );
    let mut run = Run::new(&plan, 1).unwrap();
    run.step();
    assert!(run.file(&PICTURE).contains("case_a"), "the picture shows the source");
}

/// A header says where the source is, and more: one that was changed is another record, though its binary is the same.
#[test]
fn a_header_that_was_changed_is_another_record() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("changed_header");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let missions = concat!(env!("CARGO_MANIFEST_DIR"), "/../../missions/recorded/");
    let header = std::fs::read_to_string(format!("{missions}case_a.json")).unwrap();
    for file in std::fs::read_dir(missions).unwrap() {
        let file = file.unwrap();
        std::fs::copy(file.path(), folder.join(file.file_name())).unwrap();
    }
    let mut digests = Vec::new();
    for north in ["431.7", "433.7"] {
        let changed = header.replace("\"north_m\": 431.7", &format!("\"north_m\": {north}"));
        std::fs::write(folder.join("case_a.json"), changed).unwrap();
        let text = script("point(north: 0 m, east: 0 m)", "recorded_plume(\"case_a.json\")")
            .sources
            .iter()
            .next()
            .unwrap()
            .text
            .clone();
        let name = folder.join("such.alb").display().to_string();
        let script = load_text(Source { name: name.into(), text });
        let plan = Plan::new(&script, "such.alb", None, None).unwrap_or_else(|_| panic!("{:?}", findings(&script)));
        assert_eq!(format!("{}", plan.scenario.environment.sources[0].at.north), north);
        digests.extend(plan.sources.iter().filter(|source| source.name == "case_a.json").map(|source| source.digest));
    }
    assert!(digests.len() == 2 && digests[0] != digests[1], "{digests:?}");
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
        ("recorded_plume(\"recorded/case_a.json\", start: 2 h)", "the run begins up to 7200 s into the record"),
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

/// A record whose binary is a byte too long, and one whose header says what cannot be: each fault has its mend.
#[test]
fn a_record_that_does_not_fit_together_is_told_with_its_mend() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded");
    let missions = concat!(env!("CARGO_MANIFEST_DIR"), "/../../missions/recorded");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("albacore.toml"), "").unwrap();
    let header = std::fs::read_to_string(format!("{missions}/case_a.json")).unwrap();
    let binary = std::fs::read(format!("{missions}/case_a.bin")).unwrap();
    let told = |header: &str, binary: &[u8]| {
        std::fs::write(folder.join("case_a.json"), header).unwrap();
        std::fs::write(folder.join("case_a.bin"), binary).unwrap();
        let text = "scenario s {\n    recorded_plume(\"case_a.json\")\n    \
            vehicle(kinematic, start: point(north: 0 m, east: 0 m))\n}\n";
        let name = folder.join("s.alb").display().to_string();
        findings(&load_text(Source { name: name.into(), text: text.into() }))
    };
    assert_eq!(told(&header, &binary), []);
    let longer = told(&header, &[&binary[..], &[0]].concat());
    let (given, known) = (binary.len() + 1, binary.len());
    let expected = format!("`case_a.json`: `case_a.bin` has {given} bytes: the header knows of {known}");
    assert_eq!((longer.len(), longer[0].message.as_str()), (1, expected.as_str()));
    let spoilt = header.replace("\"quantum_m\": 0.03125", "\"quantum_m\": 1e20");
    let spoilt = spoilt.replace("\"byte_order\": \"little\"", "\"byte_order\": \"big\"");
    let found = told(&spoilt, &binary);
    assert!(found.len() == 2 && longer.iter().chain(&found).all(|finding| finding.help.is_some()), "{found:#?}");
}

const RECORD: &str = "recorded_plume(\"recorded/case_a.json\")";

#[test]
fn an_area_where_nothing_was_recorded_is_told() {
    for center in ["point(north: 0 m, east: 368 m)", "point(north: -5 km, east: 0 m)"] {
        let script = script(center, RECORD);
        let found = findings(&script);
        assert_eq!((found.len(), found[0].severity, found[0].code.name()), (1, Severity::Error, "scenarios::outside"));
        let Err(PlanError::Script(refused, _)) = Plan::new(&script, "such.alb", None, None) else {
            unreachable!("it can be run")
        };
        let (message, help) = (refused[0].message.clone(), refused[0].help.clone().unwrap());
        assert_eq!(message, "no part of the area of the mission `m` lies in the record of `here`");
        assert!(help.contains("-547 m to 547 m north and -184 m to 184 m east of the origin"), "{help}");
        assert_eq!((&found[0].message, found[0].help.as_ref()), (&message, Some(&help)));
    }
}

#[test]
fn an_area_that_reaches_beyond_the_record_is_warned_of_and_can_be_run_in() {
    for (center, said) in [
        ("point(north: 0 m, east: 366 m)", Some("reaches 366 m beyond the record of `here`")),
        ("point(north: 12 m, east: 3 m)", Some("reaches 12 m beyond the record of `here`")),
        ("point(north: 0.1 m, east: 0 m)", None),
        // Degrees: the record lies about the middle of the area, wherever that is.
        ("36°10.8'N 75°44.4'W", None),
    ] {
        let script = script(center, RECORD);
        let found = findings(&script);
        assert!(found.iter().all(|finding| finding.severity == Severity::Warning), "{center}");
        let message = found.first().map(|finding| finding.message.as_str());
        assert!(
            message.is_some() == said.is_some() && message.is_none_or(|m| m.contains(said.unwrap())),
            "{message:?}"
        );
        // Whoever runs it is told, too.
        let plan = Plan::new(&script, "such.alb", None, None).unwrap();
        assert_eq!(plan.warnings.len(), usize::from(said.is_some()), "{center}");
    }
}
