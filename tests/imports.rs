//! Imports that no script of one folder can show: too many modules, and links that lead out of the project.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its scripts has failed")]

use albacore_session::Source;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// An empty folder of its own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("imports").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What `check` says of `main.alb` in a folder.
fn told(folder: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["check", "main.alb"]).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    String::from_utf8(command.output().unwrap().stderr).unwrap()
}

#[test]
fn more_modules_than_can_be_imported() {
    let folder = folder("many");
    let names: Vec<String> = (1..=256).map(|n| format!("m{n}")).collect();
    for name in &names {
        std::fs::write(folder.join(format!("{name}.alb")), format!("const of_{name} = 1 m\n")).unwrap();
    }
    let lines: Vec<String> = names.iter().map(|name| format!("use {name}\n")).collect();
    std::fs::write(folder.join("main.alb"), lines.concat()).unwrap();
    insta::assert_snapshot!(told(&folder));
}

#[test]
#[cfg(unix)]
fn a_link_leads_out_of_the_project() {
    let folder = folder("link");
    let project = folder.join("project");
    std::fs::create_dir(&project).unwrap();
    std::fs::write(folder.join("coast.alb"), "const near = 5 m\n").unwrap();
    std::os::unix::fs::symlink(folder.join("coast.alb"), project.join("coast.alb")).unwrap();
    std::fs::write(project.join("main.alb"), "use coast\nconst far = 2 * coast.near\n").unwrap();
    insta::assert_snapshot!(told(&project));
}

/// However long the chain is, what a module imports is known before it: nothing waits for what is declared later.
#[test]
fn constants_and_signals_of_a_long_chain_of_modules() {
    let folder = folder("chain");
    for n in 0..100 {
        let text = format!("use m{0}, base\nconst x = m{0}.x + base.one\nsignal deep = m{0}.deep\n", n + 1);
        std::fs::write(folder.join(format!("m{n}.alb")), text).unwrap();
    }
    std::fs::write(folder.join("m100.alb"), "const x = 1\nsignal deep = depth > 1 m\n").unwrap();
    std::fs::write(folder.join("base.alb"), "const one = 1\n").unwrap();
    let main = "use base, m0\nconst all = m0.x + base.one\nfn f() -> Int { all }\n\
        behavior b() { wait until m0.deep and f() > 0 }\n";
    std::fs::write(folder.join("main.alb"), main).unwrap();
    assert!(told(&folder).contains("no errors"), "{}", told(&folder));
}

/// A project may have a script with the name of a module of the standard library, which goes on to be made of its own.
#[test]
fn the_standard_library_imports_its_own() {
    let folder = folder("standard");
    std::fs::write(folder.join("search.alb"), "const ours = 1\n").unwrap();
    std::fs::write(
        folder.join("main.alb"),
        "use cpt, search\nfn f(s: cpt.Source) -> Int { if s.radius > 0 m { search.ours } else { 0 } }\n",
    )
    .unwrap();
    assert!(told(&folder).contains("no errors"), "{}", told(&folder));
}

/// What every script knows is read before all scripts: it is listed where it was taken, and once.
#[test]
fn the_sources_of_a_script_are_listed_once() {
    let listed = |name: &str, text: &str| {
        let script = albacore_session::load_text(Source { name: name.into(), text: text.into() });
        let names: Vec<String> = script.sources.iter().map(|source| source.name.to_string()).collect();
        names.join(" ").replace("stdlib/", "").replace(".alb", "")
    };
    assert_eq!(listed("m.alb", "use search\n"), "m search inputs scenarios world craft instruments faults");
    assert_eq!(listed("m.alb", "use faults, search\n"), "m faults search inputs scenarios world craft instruments");
    let inputs = "inputs scenarios world craft instruments faults";
    assert_eq!(listed("stdlib/inputs.alb", include_str!("../stdlib/inputs.alb")), inputs);
    assert_eq!(listed("stdlib/inputs.alb", "const x = 1\n"), inputs);
}

/// A file of a project may be called like one that every script knows: what counts is what it says.
#[test]
fn a_file_called_like_one_of_the_standard_library_is_read() {
    let folder = folder("namesake");
    let project = folder.join("stdlib");
    std::fs::create_dir(&project).unwrap();
    std::fs::write(project.join("faults.alb"), "const ours = 1\n\nconst theirs = nothing\n").unwrap();
    std::fs::write(project.join("main.alb"), "use faults\n\nconst x = faults.ours\n").unwrap();
    let (code, told) = run(&folder, &["check", "stdlib/main.alb"]);
    assert!(code == Some(3) && told.contains("stdlib/faults.alb:3:16"), "{told}");
    assert!(told.contains("1 error") && !told.contains("main.alb:"), "{told}");
}

/// A script with scenarios in a module of its project: what it says of the bottom, and its vehicle.
fn with_worlds(name: &str, worlds: &str, scenario: &str) -> PathBuf {
    let folder = folder(name);
    std::fs::write(folder.join("wb.alb"), worlds).unwrap();
    let mission = format!(
        "use wb
mission m in {scenario} within 5 min {{
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    limits {{ altitude >= 2 m, speed <= 2.5 m/s }}
    requires {{ position, course, heading fresh 5 s, else abort }}
    recovery within 5 min {{ goto op.center }}
    with depth 3 m, speed 1.5 m/s
    goto op.center
}}
"
    );
    std::fs::write(folder.join("main.alb"), mission).unwrap();
    folder
}

fn run(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap())
}

/// What `run` refuses, `check` finds, wherever the scenario stands.
#[test]
fn what_cannot_be_in_a_scenario_of_a_module_is_told() {
    let (bottom, vehicle) = ("bottom(from: 9 m, to: 9 m)", "vehicle(kinematic, start: point(north: 50 m, east: 0 m))");
    for (clauses, said) in [
        ("bottom_grid(\"nix.csv\")".to_string(), "nix.csv"),
        (format!("{bottom}\n{vehicle}\nsource(\"a\", at: point(north: 0 m, east: 0 m))"), "plume"),
        (format!("{bottom}\n{vehicle}\nfault(position, off, from: 20 s, to: 10 s)"), "make `to` later than `from`"),
        (format!("{bottom}\nvehicle(kinematic, depth: 12 m)"), "12 m"),
    ] {
        let folder = with_worlds("worlds", &format!("scenario deep {{\n{clauses}\n}}\n"), "wb.deep");
        for args in [&["check", "main.alb"][..], &["run", "main.alb", "--no-out"]] {
            let (code, told) = run(&folder, args);
            assert!(code == Some(3) && told.contains(said) && told.contains("wb.alb:"), "{args:?} {clauses}: {told}");
        }
    }
    let folder = with_worlds("worlds", &format!("scenario deep {{\n{bottom}\n{vehicle}\n}}\n"), "wb.deep");
    assert_eq!(run(&folder, &["check", "main.alb"]).0, Some(0), "{}", told(&folder));
}

/// A name alone is never that of an imported scenario, and one with its module always is.
#[test]
fn scenarios_of_modules_are_called_by_their_names() {
    let bottom = "bottom(from: 9 m, to: 9 m)";
    let worlds = format!(
        "scenario calm {{\n{bottom}\nvehicle(kinematic, start: point(north: 50 m, east: 0 m))\n}}
scenario late {{\n{bottom}\n}}\n"
    );
    let folder = with_worlds("calm", &worlds, "calm");
    let lasts = |script: &str, args: &[&str]| {
        let (code, told) = run(&folder, &[&["run", script, "--no-out", "--json"], args].concat());
        assert_eq!(code, Some(0), "{args:?}: {told}");
        let json = &told[told.find('{').unwrap()..=told.rfind('}').unwrap()];
        serde_json::from_str::<serde_json::Value>(json).unwrap()["sim_time_s"].as_f64().unwrap()
    };
    let calm = lasts("main.alb", &[]);
    assert!(calm < 10.0 && lasts("main.alb", &["--in", "calm"]) == calm, "it starts in the middle of the area: {calm}");
    assert!(lasts("main.alb", &["--in", "wb.calm"]) > 20.0, "it starts 50 m from there");
    // A script's own hides one that every script knows.
    let own = std::fs::read_to_string(folder.join("main.alb")).unwrap() + &worlds.replace("50 m", "90 m");
    std::fs::write(folder.join("own.alb"), own).unwrap();
    assert!(lasts("own.alb", &[]) > 55.0, "it starts 90 m from there");
    let (code, told) = run(&folder, &["run", "main.alb", "--no-out", "--in", "late"]);
    assert!(code == Some(2) && told.contains("and `wb.late`"), "{told}");
}

/// Two modules have a mission of one name: an expectation means the area of the one that its test runs.
#[test]
fn an_expectation_means_the_area_of_the_mission_that_is_run() {
    let folder = folder("areas");
    for (module, area) in [("one", "sea"), ("two", "bay")] {
        let script = format!(
            "mission round {{
    area {area} = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 400 m)
    goto {area}.center
}}\n"
        );
        std::fs::write(folder.join(module).with_extension("alb"), script).unwrap();
    }
    let expecting = |module: &str, area: &str| {
        let main = format!(
            "use one\nuse two\ntest \"inside\" {{
    run {module}.round() in calm seeds 1..1
    expect always {area}.gap(truth.position) > 0 m\n}}\n"
        );
        std::fs::write(folder.join("main.alb"), main).unwrap();
        run(&folder, &["test", "main.alb"])
    };
    for (module, area) in
        [("one", "round.sea"), ("two", "round.bay"), ("one", "one.round.sea"), ("two", "two.round.bay")]
    {
        let (code, told) = expecting(module, area);
        assert_eq!(code, Some(0), "{module} {area}: {told}");
    }
    for (module, area) in [("one", "round.bay"), ("two", "round.sea"), ("one", "one.round.bay")] {
        let (code, told) = expecting(module, area);
        assert!(code == Some(3) && told.contains("the mission has no area"), "{module} {area}: {told}");
    }
    let (code, told) = expecting("one", "two.round.bay");
    assert!(code == Some(3) && told.contains("this test runs `round`, not this mission"), "{told}");
}
