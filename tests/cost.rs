//! `check --cost`: what a mission costs at most, and where it comes from; and what costs too much.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[test]
fn cost() {
    insta::glob!("cost/*.alb", |path| insta::assert_snapshot!(told(path)));
}

fn told(path: &Path) -> String {
    let path = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_albacore"))
        .args(["check", "--cost"])
        .arg(path)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap()
}

/// A script of a mission, with declarations before it and a body.
fn script(declarations: &str, body: &str) -> String {
    format!(
        "{declarations}
mission large in calm within 20 min {{
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 400 m)
    limits {{ altitude >= 2 m, speed <= 2.5 m/s }}
    requires {{ position, course, heading, depth, altitude fresh 500 s, else abort }}
    recovery within 5 min {{ goto op.center }}
    with depth 3 m, speed 1.5 m/s
    {body}
}}
"
    )
}

fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(|i| line(i) + "\n").collect()
}

/// What takes about a second where its cost grows with the script takes this long and much longer where it grows with its square, s.
const TIME: u32 = 10;

/// Where the script of a test is while that runs: tests run beside one another, and two may have the same name for it.
fn file_of(name: &str) -> PathBuf {
    let test = std::thread::current().name().unwrap_or_default().replace(':', "-");
    std::env::temp_dir().join(format!("albacore-{}-{test}-{name}.alb", std::process::id()))
}

/// Runs `albacore` on a script. It is ended, and the test fails, once it has computed for TIME: its own time, however busy
/// the machine is, and no other program's. `stack`: what it may take of it, KiB.
fn run_within(arguments: &[&str], name: &str, script: &str, stack: Option<u32>) -> (Output, String) {
    let file = file_of(name);
    std::fs::write(&file, script).unwrap();
    let stack = stack.map_or_else(String::new, |kib| format!("ulimit -s {kib}; "));
    let output = Command::new("sh")
        .args(["-c", &format!("{stack}ulimit -t {TIME}; exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_albacore")])
        .args(arguments)
        .arg(&file)
        .output()
        .unwrap();
    std::fs::remove_file(&file).unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code().is_some(), "{name}: ended by {} (more than {TIME} s?): {told:.2000}", output.status);
    (output, told)
}

#[test]
fn large_scripts_are_checked_in_time() {
    let alone = script("", "wait for 1 s");
    let scripts = [
        (
            "scenarios",
            script(&lines(16_000, |i| format!("scenario s{i} {{ bottom(from: 8 m, to: 12 m) }}")), "wait for 1 s"),
        ),
        ("missions", lines(1600, |i| alone.replace("mission large", &format!("mission m{i}")))),
        (
            "tests",
            alone.clone()
                + &lines(8000, |i| format!("test \"a{i}\" {{ run large in calm seeds 1..1\n expect completed }}")),
        ),
        (
            "rings",
            format!(
                "strategy rings(x: Length, b: Bool) {{ start b0\n{}signal s = {}\n{}{}b19 -> finish on b\n}}\n{alone}",
                lines(30, |i| format!("signal s{i} = {}x > {i} * x", "x + ".repeat(60))),
                (0..30).map(|i| format!("s{i}")).collect::<Vec<_>>().join(" and "),
                lines(20, |i| format!("behavior b{i} {{ steer north }}")),
                lines(400, |i| match (i / 20, i % 20) {
                    (from, to) if from < to => format!("b{from} -> b{to} on s or (becomes b)"),
                    _ => String::new(),
                }),
            ),
        ),
        (
            "variants",
            format!(
                "enum Many {{ {} }}\nfn which(e: Many) -> Int {{ match e {{ {} }} }}\n{alone}",
                lines(20_000, |i| format!("v{i},")),
                lines(20_000, |i| format!("v{i} {{ {i} }}"))
            ),
        ),
        (
            "given_variants",
            script(
                &format!("enum Many {{ {} }}", lines(20_000, |i| format!("v{i},"))),
                &format!(
                    "memory e: Many = v0\nmatch e {{ {} else {{}} }}\nwait for 1 s",
                    lines(3000, |i| format!("v{i} {{ e = v{} }}", i + 1))
                ),
            ),
        ),
        (
            "any",
            script(
                &format!(
                    "strategy any_of() {{ start b0\n{}{}}}",
                    lines(8000, |i| format!("behavior b{i} {{ steer north }}")),
                    lines(8000, |i| format!("any -> b{i} on depth > {} m", i % 100))
                ),
                "any_of()",
            ),
        ),
    ];
    for (name, script) in scripts {
        let (output, told) = run_within(&["check"], name, &script, None);
        let refused = told.contains("limits::rules");
        assert!(output.status.code() == Some(0) || name == "any" && refused, "{name}: {told:.2000}");
    }
}

/// A table that nobody could read as a picture is drawn as none.
#[test]
fn tables_are_drawn_in_time() {
    let table = |behaviors| {
        let declared = lines(behaviors, |i| format!("behavior b{i} {{ steer north }}"));
        let rules = lines(behaviors, |i| format!("any -> b{i} on becomes depth > {i} m then back"));
        format!("strategy all_to_all() {{\nstart b0\n{declared}{rules}}}\n")
    };
    let too_large = "the diagram of `all_to_all` is too large to be drawn: 3540 lines";
    for (behaviors, is_drawn) in [(16, true), (60, false)] {
        let (output, told) = run_within(&["graph"], "graph", &table(behaviors), None);
        assert_eq!((output.status.code() == Some(0), told.contains(too_large)), (is_drawn, !is_drawn), "{told:.2000}");
        let (output, told) = run_within(&["graph", "--format", "dot"], "dot", &table(behaviors), None);
        assert_eq!((output.status.code(), told.matches("[label=").count()), (Some(0), behaviors * (behaviors - 1)));
        let (output, told) = run_within(&["doc", "--format", "html"], "html", &table(behaviors), None);
        assert_eq!((output.status.code(), told.contains("<svg")), (Some(0), is_drawn));
        assert_eq!(told.contains("<p>The table is too large for a diagram.</p>"), !is_drawn);
    }
}

/// What many missions and tests share is looked at for each of them: beyond a limit they are refused, before anything is made of them.
#[test]
fn what_missions_share_is_checked_so_often_at_most() {
    let large =
        format!("behavior large() {{ {} }}", lines(200, |i| format!("if depth > {i} m {{ goto point({i} m, 2 m) }}")));
    let missions =
        |count| lines(count, |i| script("", "large()").replace("mission large", &format!("mission m{i}"))) + &large;
    let reports = lines(1000, |i| format!("report \"r{i}\": 1 m")) + "wait for 1 s";
    let tests = |count| {
        script("", &reports)
            + &lines(count, |i| {
                let asked = i % 1000;
                format!("test \"a{i}\" {{ run large in calm seeds 1..1\n expect has_reported(\"r{asked}\") }}")
            })
    };
    for (name, few, many) in [("shared", missions(2), missions(4000)), ("asked", tests(2), tests(20_000))] {
        let (output, told) = run_within(&["check"], name, &few, None);
        assert_eq!(output.status.code(), Some(0), "{name}: {told:.2000}");
        let (output, told) = run_within(&["check"], name, &many, None);
        assert_eq!(output.status.code(), Some(3), "{name}: {told:.2000}");
        insta::assert_snapshot!(
            format!("too_much_{name}"),
            told.replace(&file_of(name).display().to_string(), "large.alb")
        );
    }
}

/// Declarations one on the other, and many of a kind in one: what they take grows with them, however deep they go.
#[test]
fn long_chains_are_checked_in_time_and_on_a_small_stack() {
    let body = "log \"{last}\"\nwait for 1 s";
    let chain =
        |first: &str, next: &dyn Fn(usize) -> String, last: &str| format!("{first}\n{}{last}", lines(9000, next));
    let scripts = [
        (
            "lets",
            script(
                "",
                &format!(
                    "{}\n{body}",
                    chain("let a0 = 1", &|i| format!("let a{} = a{i} + 1", i + 1), "let last = a9000")
                ),
            ),
        ),
        (
            "consts",
            script(&chain("const c0 = 1 m", &|i| format!("const c{} = c{i} + 1 m", i + 1), "const last = c9000"), body),
        ),
        (
            "records",
            script(
                &chain("record R0 { x: Length }", &|i| format!("record R{} {{ r: R{i} }}", i + 1), ""),
                "wait for 1 s",
            ),
        ),
        ("fields", script(&chain("record Many {", &|i| format!("x{i}: Int,"), "}"), "wait for 1 s")),
        ("blanks", script(&"   \n".repeat(200_000), "wait for 1 s")),
        ("params", script(&chain("fn many(", &|i| format!("x{i}: Int,"), ") -> Int { x0 }"), "wait for 1 s")),
    ];
    for (name, script) in scripts {
        let (output, told) = run_within(&["check"], name, &script, Some(2048));
        let is_refused = told.contains("limits::record") && output.status.code() == Some(3);
        assert!(output.status.code() == Some(0) || is_refused, "{name}: {told:.2000}");
    }
}

/// Each byte, or nearly, of one long line is a mistake: where it stands is not looked for through the whole line.
#[test]
fn a_line_full_of_mistakes_is_checked_in_time() {
    let lines = [
        ("closers", "}".repeat(400_000)),
        ("crossed", "(]".repeat(200_000)),
        ("blanks", "\u{a0}".repeat(400_000)),
        ("wide", "\u{ff41} ".repeat(400_000)),
        ("turned", "\u{202e}".repeat(400_000)),
        ("text", format!("const c = \"{}\"", "\u{200b}".repeat(400_000))),
        ("escapes", format!("const c = \"{}\"", "\\q".repeat(200_000))),
        ("tabs", "\t}".repeat(200_000)),
    ];
    for (name, line) in lines {
        let (output, told) = run_within(&["check"], name, &line, None);
        assert!(output.status.code() == Some(3) && told.contains("more"), "{name}: {told:.2000}");
    }
}

/// Nobody looks through all declarations for each of so many names.
#[test]
fn names_that_nothing_has_are_told_in_time() {
    let lines = |line: &dyn Fn(usize) -> String| (0..40_000).map(line).collect::<String>();
    let scripts = [
        ("constants", lines(&|i| format!("const c{i}: Int = y{i}\n"))),
        ("body", format!("mission m {{\n{}}}\n", lines(&|i| format!("let a{i} = b{i}\n")))),
    ];
    for (name, script) in scripts {
        let (output, told) = run_within(&["check"], name, &script, None);
        assert!(output.status.code() == Some(3) && told.contains("more"), "{name}: {told:.2000}");
    }
}

/// What is never closed is not looked for once more by each block that it stands in: at 40 levels that would take years.
#[test]
fn brackets_that_do_not_fit_are_told_in_time() {
    let mission = |text: String| format!("mission m {{\n{text}");
    let levels = |open: &str| open.repeat(40);
    let scripts = [
        ("loops", mission(levels("loop {\n"))),
        ("cut", mission((0..40).map(|level| "  ".repeat(level + 1) + "loop {\n").collect())),
        ("few", mission(levels("loop {\n") + &"}\n".repeat(39))),
        ("more", mission(levels("loop {\n") + &"}\n".repeat(43))),
        ("arms", mission("match a {\n x {\n".repeat(30))),
        ("values", mission("let y = (if a {".repeat(30))),
        ("elses", mission("let y = (if a {".repeat(10) + &"if a { b }\nelse {\nif a {".repeat(10))),
        ("limits", mission("limits { depth <= if a {\n".repeat(30))),
        ("lists", mission(levels("for i in if a {\n") + "x" + &"\n} { }".repeat(40) + "\n}\n")),
        ("behaviors", format!("strategy s() {{\n{}", levels("behavior a {\n"))),
        ("holes", mission(format!("let x = \"{{{}\"{}}}\"\n}}\n", "if a { loop {".repeat(20), "} }".repeat(20)))),
    ];
    for (name, script) in scripts {
        for verb in ["check", "fmt"] {
            let (output, told) = run_within(&[verb], name, &script, None);
            // One is nested twice as a value and as a list, and well formed.
            let well = verb == "fmt" && name == "lists";
            assert_eq!(output.status.code(), Some(if well { 0 } else { 3 }), "{verb} {name}: {told:.2000}");
        }
    }
}

/// The attack: an `if` behind `else` was read as its branch and, where that failed, as the value of `else` once more, at each level.
#[test]
fn a_mistake_within_nested_ifs_is_told_in_time() {
    for (name, before, after, leaf) in [
        ("value", "let x = ", "", "1 1"),
        ("condition", "if ", " { wait }", "a a"),
        ("missing", "let x = ", "", ""),
        ("operator", "let x = a else ", "", "1 1"),
    ] {
        let nested =
            (0..40).fold(leaf.to_owned(), |inner, _| format!("if a {{ 1 }} else if {inner} {{ 2 }} else {{ 3 }}"));
        let script = format!("mission m {{\n{before}{nested}{after}\n}}\n");
        let (output, told) = run_within(&["check"], name, &script, None);
        assert_eq!(output.status.code(), Some(3), "{name}: {told:.2000}");
    }
}

/// What the vehicle's sensors look through at each sample is bounded, and told before anything else is made of it.
#[test]
fn a_scenario_has_so_many_clauses_of_one_name_at_most() {
    let pits = |count| {
        let pit = |i| format!("pit(\"p{i}\", at: point(north: {i} m, east: 0 m), depth: 1 m, radius: 9 m)");
        format!("scenario holes {{ bottom(from: 9 m, to: 9 m)\n{} }}", lines(count, pit))
    };
    let told = |count: usize| run_within(&["check"], &format!("pits{count}"), &pits(count), None).1;
    assert!(told(1024).contains("no errors"), "{}", told(1024));
    let many = told(20_000);
    assert!(many.contains("20000 clauses `pit`: 1024 are the most") && many.contains("1 error"), "{many:.2000}");
}

/// The attacks: rows were computed from the area anew, each on its own, large elements of a list that is turned round moved past
/// one another one by one, and all edges of a star of spikes held against one another by their ends. Each took ten times what its steps
/// allow and more, here half a minute.
#[test]
fn what_counts_few_steps_takes_little_time() {
    // On a parabola: none of them is inside of the others.
    let corners = lines(16, |i| format!("point({} m, {} m),", 10 * i, i * i));
    let rows = format!(
        "memory walked: Area = polygon([{corners}]) else op
         memory mown: Length = 0 m
         on true {{ for i in 1..20 {{ for row in walked.rows(0.01 m) {{ mown = row.length }} }} }}
         wait for 35 s"
    );
    let turned = "memory way: Length = 1 m
         memory rank: Length = 1 m
         memory places: [Place; 500] by least it.rank * way
         on true {
             way = 0 m - way
             rank = rank + 1 m
             places.insert(Place(rank: rank, a: op, b: op, c: op, d: op))
         }
         wait for 55 s";
    let record = "record Place { rank: Length, a: Area, b: Area, c: Area, d: Area }";
    // Spikes about one middle: of no two of them are the boxes apart.
    let tip = |i: usize| {
        let out = if i.is_multiple_of(2) { 300 } else { 40 };
        format!("point(0 m, 0 m) + {out} m toward (north + {i} * 0.36 deg),")
    };
    let star = format!("const star: [Point; 1000] = [{}]", lines(1000, tip));
    let spikes = "memory made: Int = 0
         on true { for i in 1..3 { if polygon(star) != none { made = i } } }
         wait for 60 s
         log \"{made}\"";
    for (name, script) in
        [("rows", script("", &rows)), ("turned", script(record, turned)), ("spikes", script(&star, spikes))]
    {
        let (output, told) = run_within(&["run", "--no-out"], name, &script, None);
        assert_eq!(output.status.code(), Some(0), "{name}: {told:.2000}");
    }
}

/// Names of the same letters pass every test that is quicker than a comparison, and comparing takes the product of two lengths.
#[test]
fn long_names_are_not_compared_with_one_another() {
    let names = |letters: fn(usize) -> String, line: fn(&str, usize) -> String| lines(1000, |i| line(&letters(i), i));
    let known = names(|i| format!("x{}{i:0>4}", "y".repeat(245)), |name, _| format!("let {name} = 1 m"));
    let unknown = names(|i| format!("x{}y{i:0>4}", "y".repeat(243)), |name, i| format!("let w{i} = {name}"));
    let (output, told) = run_within(&["check"], "names", &script("", &(known + &unknown)), None);
    assert_eq!(output.status.code(), Some(3), "{told:.2000}");
}

/// A line at the prompt takes no longer than what has been named before it makes it.
#[test]
fn lines_at_the_prompt_are_read_in_time() {
    let named = lines(1000, |i| format!("let x{i} = {i}"));
    let unclosed = format!("fn f() -> Int {{\n{}", "1\n".repeat(3_000));
    for (name, typed) in [("named", named), ("unclosed", unclosed)] {
        let input = file_of(name);
        std::fs::write(&input, typed).unwrap();
        let output = Command::new("sh")
            .args(["-c", &format!("ulimit -t {TIME}; exec \"$0\" repl < \"$1\"")])
            .args([Path::new(env!("CARGO_BIN_EXE_albacore")), &input])
            .output()
            .unwrap();
        std::fs::remove_file(&input).unwrap();
        assert!(output.status.code().is_some(), "{name}: ended after {TIME} s");
    }
}

#[test]
fn long_scripts_are_laid_out_in_time() {
    let statements = lines(30_000, |i| format!("if depth>{}m{{log \"deep\" }} // {i}", i % 9));
    let (output, told) = run_within(&["fmt", "--check"], "long", &script("", &statements), None);
    assert_eq!(output.status.code(), Some(1), "{told:.2000}");
}
