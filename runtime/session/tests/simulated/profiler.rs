//! The clauses of the Doppler profiler, from a script to where a vehicle goes that follows the flow.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::{Plan, Run, Source, load_text};

/// Southward until the flow is known, then with it: toward the north if it is that of the upper layer, toward the east if it is
/// that of the lower.
const SCRIPT: &str = "mission downstream in w within 10 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 1000 m, width: 1000 m)
    requires {
        position, course, heading fresh 5 s, else abort
        flow fresh 30 s, at first 1 cm/s toward 270 deg, else hold for 60 s then abort
    }
    recovery within 1 min { wait for 1 s }
    with altitude 2 m, speed 2 m/s
    steer 180 deg for 2 min
    steer flow.toward for 2 min
}
scenario w {
    flow(10 cm/s toward 90 deg)
    upper_layer(10 cm/s toward 0 deg, above: 2.5 m)
    bottom(from: 10 m, to: 10 m)
    vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 8 m)
    ADCP
}
";

/// The bytes of a run, and its direction from two minutes on in degrees.
fn followed(adcp: &str) -> (String, f64) {
    let text = SCRIPT.replace("ADCP", adcp);
    let script = load_text(Source { name: "downstream.alb".into(), text: text.into() });
    assert!(script.is_sound(), "{adcp}: {:#?}", script.findings);
    let mut run = Run::new(&Plan::new(&script, "downstream.alb", None, None).unwrap(), 1).unwrap();
    while run.tick() < 1400 {
        run.step();
    }
    let from = run.true_position();
    while run.tick() < 2200 {
        run.step();
    }
    (run.summary(0.0).digest, (run.true_position() - from).toward().degrees())
}

fn is_toward(adcp: &str, expected: f64) {
    let (_, toward) = followed(adcp);
    let off = (toward - expected + 180.0).rem_euclid(360.0) - 180.0;
    assert!(off.abs() < 12.0, "`{adcp}` leads toward {toward} deg");
}

#[test]
fn it_is_told_where_to_look() {
    is_toward("", 0.0);
    is_toward("adcp(looks: up)", 0.0);
    is_toward("adcp(looks: down)", 90.0);
    is_toward("adcp(looks: both)", 45.0);
}

#[test]
fn each_of_its_numbers_has_its_place() {
    is_toward("adcp(noise: 0 m/s, looks: down)", 90.0);
    // Bins of 10 cm from near the vehicle on: below the boundary, half a metre above it, are one, or four, or four of sixteen.
    is_toward("adcp(blanking: 0.2 m, bin: 0.1 m)", 90.0);
    is_toward("adcp(blanking: 0.1 m, bin: 0.1 m, count: 4)", 90.0);
    is_toward("adcp(blanking: 0.1 m, bin: 0.1 m, count: 16)", 18.4);
    // Nothing can be measured in the 2 m below; the flow stays as it was said to be at first.
    is_toward("adcp(blanking: 1.8 m, looks: down)", 270.0);
    // On its way south it takes 5 cm/s ahead for flow: with the true 10 cm/s toward the east, 117 deg. Later it is less.
    let (_, toward) = followed("adcp(bias: -5 cm/s, noise: 0 m/s, looks: down)");
    assert!((98.0..118.0).contains(&toward), "{toward}");
}

#[test]
fn what_is_left_out_is_as_the_paper_has_it() {
    let (said, _) = followed("adcp(noise: 0.05 m/s, bias: 0 m/s, blanking: 0.75 m, bin: 0.5 m, count: 1, looks: up)");
    assert_eq!(said, followed("").0);
    assert_eq!(said, followed("adcp()").0);
}
