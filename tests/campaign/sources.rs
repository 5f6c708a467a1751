//! What a table was begun with, and what of it was changed since.

use crate::{empty, refused, script, table};

/// An attack: a table that was begun in the `bay` of another file was gone on with in the script's own, and told of nothing.
#[test]
fn two_worlds_of_one_name_are_told_apart() {
    let folder = empty("two_worlds");
    let out = folder.join("t.csv");
    let world = |fault: &str| {
        format!(
            "scenario bay {{\n    bottom(from: 9 m, to: 9 m)\n    vehicle(kinematic, start: point(north: 9 m, east: 0 m))\n{fault}}}\n"
        )
    };
    script(&folder, "late.alb", &world("    fault(heading, wrong, from: 2 s)\n"));
    let mission = "mission m in bay within 5 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1.5 m/s
    goto op.center
}
";
    let own = script(&folder, "m.alb", &format!("use late\n{}{mission}", world("")));
    let late = format!("{}#bay", folder.join("late.alb").display());
    table(&own, "1..3", &out, &["--in", &late]);
    refused(&own, "1..5", &out, &["--resume"], 2, "was begun with the scenario `bay` of `");
    assert_eq!(table(&own, "1..5", &out, &["--in", &late, "--resume"]).lines().count(), 6);
}

/// A module of the world's script that is like one of the mission's is a source all the same: it may be changed alone.
#[test]
fn a_copy_of_a_module_is_a_source_of_its_own() {
    let folder = empty("copies");
    let out = folder.join("t.csv");
    script(&folder, "late.alb", "const t: Duration = 600 s\n");
    script(&folder, "current.alb", "const t: Duration = 600 s\n");
    let world = "use current
scenario bay {
    bottom(from: 9 m, to: 9 m)
    vehicle(kinematic, start: point(north: 9 m, east: 0 m))
    fault(heading, off, from: current.t)
}
";
    script(&folder, "world.alb", world);
    let mission = "use late
mission m within 5 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    limits { altitude >= 2 m, speed <= 1.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1.5 m/s
    if late.t > 5 s { goto op.center }
}
";
    let own = script(&folder, "m.alb", mission);
    let bay = format!("{}#bay", folder.join("world.alb").display());
    table(&own, "1..3", &out, &["--in", &bay]);
    script(&folder, "current.alb", "const t: Duration = 1 s\n");
    refused(&own, "1..5", &out, &["--in", &bay, "--resume"], 2, "was changed");
}
