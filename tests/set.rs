//! `--set`: values from outside go through the checks of those in the script, and one that would change nothing is refused.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_session::load;
use std::path::Path;
use std::process::{Command, Stdio};

/// The codes of what is wrong with a mission when something is set.
fn codes(set: &str) -> Vec<&'static str> {
    let script = load(Path::new("missions/duck_single.alb"), None, &[set.to_string()]).unwrap();
    script.findings.iter().map(|f| f.code.name()).collect()
}

#[test]
fn values_from_outside_are_checked() {
    for (set, expected) in [
        ("lambda=6s", &[][..]),
        ("lambda=-6s", &["ranges::negative"]),
        ("lambda=1e300 s", &["types::number"]),
        ("lambda=6 m", &["types::mismatch"]),
        ("trace_plume.threshold=9007199254740993.0", &["types::number"]),
        ("trace_plume.lambda=-6s", &["ranges::negative"]),
        ("cage.band=3m", &[]),
        ("cage.band=300m", &["ranges::outside"]),
        ("cpt_2005.lambda=6s", &["set::unreached"]),
        ("trace_plume.lambda=6s", &["set::given"]),
        ("trace_plume.threshold=5%", &[]),
        ("nothing.lambda=6s", &["set::unknown"]),
        ("duck_2003.step=2s", &[]),
        ("sci_2002.step=2s", &["set::unreached"]),
    ] {
        assert_eq!(codes(set), expected, "{set}");
    }
}

/// A scenario that replaces the clause which reads a parameter has that parameter still, and a behavior of its name is no scenario.
#[test]
fn what_no_clause_reads_is_not_set() {
    let script = |mission: &str| {
        format!(
            "scenario water(current: Speed = 20 cm/s in 0 cm/s..2 m/s) = still_water with {{ flow(current toward south) }}
scenario fast = water with {{ flow(70 cm/s toward south) }}
behavior stay {{ wait for 3 s }}
strategy other {{
    behavior water {{ stay() }}
    start water
    water -> finish on done
}}
mission m in {mission} within 10 min {{
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits {{ altitude >= 2 m, speed <= 2.5 m/s }}
    requires {{ position, course, heading, depth fresh 5 s, else abort }}
    recovery within 5 min {{ goto op.center at depth 3 m, speed 1 m/s }}
    with depth 3 m, speed 1 m/s
    stay()
    if depth > 1 km {{ other() }}
}}
"
        )
    };
    let codes = |scenario: &str, set: &str| -> Vec<&'static str> {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("unread-{scenario}.alb"));
        std::fs::write(&path, script(scenario)).unwrap();
        let told = load(&path, None, &[set.to_string()]).unwrap();
        told.findings.iter().map(|finding| finding.code.name()).filter(|code| code.starts_with("set")).collect()
    };
    for set in ["current=1 m/s", "water.current=1 m/s"] {
        assert_eq!(codes("water", set), [""; 0], "{set}");
    }
    for set in ["current=1 m/s", "fast.current=1 m/s", "water.current=1 m/s"] {
        assert_eq!(codes("fast", set), ["set::unreached"], "{set}");
    }
}

/// What a person reads when a value from outside is wrong.
#[test]
fn wrong_values_are_told() {
    let wrong: [&[&str]; 7] = [
        &["lambda:6s"],
        &["lamda=6s"],
        &["lambda=6"],
        &["cpt_2005.lambda=6s"],
        &["trace_plume.lambda=6s"],
        &["lambda=6s", "lambda=7s"],
        &["sci_2002.step=2s"],
    ];
    let told = wrong.map(|sets| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
        command.args(["check", "missions/duck_single.alb"]).env("NO_COLOR", "1").stdin(Stdio::null());
        command.args(sets.iter().flat_map(|set| ["--set", set]));
        String::from_utf8(command.output().unwrap().stderr).unwrap()
    });
    insta::assert_snapshot!(told.join("\n"));
}
