//! What a world lacks of what a mission needs is told before the mission runs, in whatever world it is to run.

use albacore_session::{Plan, PlanError, Script, Severity, Source, findings, load_text};

fn script() -> Script {
    let text = "mission m in calm_bay within 5 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires {
        position, course, heading fresh 5 s, else abort
        flow fresh 60 s, at first 10 cm/s toward 0 deg, else abort
        temperature fresh 10 s, else abort
    }
    recovery within 1 min { goto op.center at speed 1 m/s }
    with depth 3 m, speed 2 m/s
    goto op.corner(toward: flow.toward) until temperature > 20 degC
}
scenario calm_bay { vehicle(kinematic, start: point(north: 0 m, east: 0 m)); ctd(above: 0 m) }
scenario race {
    flow(45 cm/s toward 90 deg)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m))
    ctd(above: 0 m)
}
scenario layered {
    flow(10 cm/s toward 90 deg)
    upper_layer(60 cm/s toward 90 deg, above: 10 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m))
    ctd(above: 0 m)
}
scenario known_race {
    flow(45 cm/s toward 90 deg)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m))
    adcp(fastest: 1 m/s)
    ctd(above: 0 m)
}
scenario bare { vehicle(kinematic, start: point(north: 0 m, east: 0 m)) }
";
    load_text(Source { name: "m.alb".into(), text: text.into() })
}

fn plan(scenario: &str) -> Result<Plan, PlanError> {
    Plan::new(&script(), "m.alb", None, Some(scenario))
}

#[test]
fn a_flow_beyond_the_profiler_is_warned_of_wherever_the_mission_is_to_run() {
    assert_eq!(findings(&script()), [], "in its own world all is well");
    let warned = |scenario: &str| {
        let warnings = plan(scenario).map(|plan| plan.warnings).unwrap_or_default();
        assert!(warnings.iter().all(|warning| warning.severity == Severity::Warning && warning.help.is_some()));
        warnings.into_iter().map(|warning| warning.message).collect::<Vec<_>>()
    };
    for (scenario, flow) in [("race", "0.45 m/s"), ("layered", "0.60 m/s")] {
        let told = warned(scenario);
        let begins =
            format!("the flow of `{scenario}` is {flow}, and its profiler takes 0.35 m/s and more for an error");
        assert!(told.len() == 1 && told[0].starts_with(&begins), "{told:?}");
    }
    assert_eq!(warned("calm_bay"), [""; 0]);
    assert_eq!(warned("known_race"), [""; 0]);
}

#[test]
fn a_missing_sensor_is_an_error_at_the_requirement() {
    let Err(PlanError::Script(errors, _)) = plan("bare") else { unreachable!("it can be run") };
    let told: Vec<&str> = errors.iter().map(|error| error.message.as_str()).collect();
    assert_eq!(told, ["the vehicle of `bare` has no sensor for `temperature`"]);
}
