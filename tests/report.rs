//! `albacore report`: the page of a run, which needs nothing else and says what the run's journal says.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use albacore_session::journal::Journal;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A page of a mission of 40 minutes has fewer bytes.
const BYTES_MAX: usize = 2_000_000;

/// What others could write into a report: an end of the data's element, a comment, an end of an attribute, and a place to be filled in.
const HOSTILE: &str = r#"</script><script>alert(1)</script><!-- \" onload=alert(2) \{\{data}}"#;

fn mission(name: &str) -> String {
    r#"
mission north in calm within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    limits { speed <= 2 m/s }
    with depth 3 m, speed 1 m/s
    steer 0 deg for 3 s
    report "NAME": position
    log "NAME"
    abort "NAME"
}
"#
    .replace("NAME", name)
}

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("report-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What the program ends with, prints and says.
fn albacore(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A run of one of the repository's missions, in a folder `run` of a test's own: that folder's parent, and its result.
fn run_of(name: &str, mission: &str) -> (PathBuf, Value) {
    run_script(name, &Path::new("missions").join(mission))
}

/// The same of any of the repository's scripts.
fn run_script(name: &str, script: &Path) -> (PathBuf, Value) {
    let folder = folder(name);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join(script);
    let (code, printed, said) = albacore(&folder, &["run", script.to_str().unwrap(), "--json", "--out", "run"]);
    assert_eq!(code, Some(0), "{said}");
    (folder, serde_json::from_str(&printed).unwrap())
}

fn page_of(folder: &Path) -> String {
    let (code, _, said) = albacore(folder, &["report", "run"]);
    assert_eq!((code, said.contains("wrote ")), (Some(0), true), "{said}");
    std::fs::read_to_string(folder.join("run").join("report.html")).unwrap()
}

/// The data that is embedded in a page.
fn data_of(page: &str) -> Value {
    let (_, after) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    let (data, _) = after.split_once("</script>").unwrap();
    serde_json::from_str(data).unwrap()
}

#[test]
fn a_page_needs_nothing_else() {
    let (folder, _) = run_of("alone", "duck_single.alb");
    let page = page_of(&folder);
    assert!(page.len() < BYTES_MAX, "{} bytes", page.len());
    let without_names = page
        .replace("xmlns=\"http://www.w3.org/2000/svg\"", "")
        .replace("xmlns=\\\"http://www.w3.org/2000/svg\\\"", "");
    // The clips of the picture itself are in it.
    let without_names = without_names.replace("url(#chart)", "").replace("url(#profile)", "");
    for outside in ["http:", "https:", " src=", "url(", "@import", "fetch(", "XMLHttpRequest", "WebSocket", "import("] {
        assert!(!without_names.contains(outside), "{outside}");
    }
    assert!(!page.contains("href"), "it links to nothing");
    // What a browser is told not to fetch, and what is there for one without scripts.
    assert!(page.contains("default-src 'none'") && page.contains("<noscript>"));
    let plain = page.split_once("<noscript>").unwrap().1.split_once("</noscript>").unwrap().0;
    assert!(plain.contains("<svg ") && plain.contains("find -&gt; track_in"), "a picture, and what happened");
    // Two of each: the elements of data and script.
    assert_eq!((page.matches("<script").count(), page.matches("</script>").count()), (2, 2));
}

#[test]
fn a_page_says_what_the_journal_says() {
    let (folder, result) = run_of("agrees", "duck_single.alb");
    let page = page_of(&folder);
    let data = data_of(&page);
    for (told, known) in [
        ("mission", "mission"),
        ("seed", "seed"),
        ("switches", "switches"),
        ("holds", "holds"),
        ("time_s", "sim_time_s"),
        ("path_m", "path_length_m"),
        ("digest", "digest"),
    ] {
        assert_eq!(data["head"][told], result[known], "{told}");
    }
    let of = |verb: &str| data["happenings"].as_array().unwrap().iter().filter(|line| line["verb"] == verb).count();
    assert_eq!(of("switch") as u64, result["switches"].as_u64().unwrap());
    assert_eq!(data["reports"].as_array().unwrap().len(), result["reports"].as_array().unwrap().len());
    assert_eq!(data["reports"][0]["north"], result["reports"][0]["north_m"]);
    let first = data["happenings"].as_array().unwrap().iter().find(|line| line["verb"] == "switch").unwrap();
    assert_eq!(first["why"]["rule"], "find -> track_in on contact");
    assert!(first["why"]["place"].as_str().unwrap().starts_with("cpt.alb:"), "{first}");
    assert_eq!(first["why"]["values"][0], serde_json::json!(["contact", "true"]));

    let journal = Journal::read(&std::fs::read(folder.join("run").join("journal")).unwrap()).unwrap();
    let series = |name: &str| {
        let series = data["series"].as_array().unwrap().iter().find(|series| series["name"] == name).unwrap();
        let mut sum = 0;
        let steps = series["values"].as_array().unwrap().iter();
        steps
            .map(|step| {
                step.as_i64().map(|step| {
                    sum += step;
                    sum
                })
            })
            .collect::<Vec<_>>()
    };
    let (north, chemical, least) = (series("true_north"), series("chemical"), series("chemical_least"));
    for tick in (0..journal.ticks.len()).step_by(6000) {
        let truth = journal.ticks[tick].truth.unwrap();
        assert_eq!(north[tick / 10], Some((truth.position.north * 10.0).round() as i64), "tick {tick}");
    }
    // Of a second the greatest and the least reading.
    let place = journal.header.measurements.iter().position(|measurement| measurement.name == "chemical").unwrap();
    for second in [400, 600] {
        let ticks = &journal.ticks[10 * second - 9..=10 * second];
        let samples = ticks.iter().flat_map(|tick| &tick.snapshot.samples);
        let readings: Vec<f64> =
            samples.filter(|s| usize::from(s.input_measurement()) == place).map(|s| s.reading[0]).collect();
        let whole = |x: f64| Some((x * 1e4).round() as i64);
        assert_eq!(chemical[second], whole(readings.iter().copied().fold(f64::MIN, f64::max)), "{second} s");
        assert_eq!(least[second], whole(readings.iter().copied().fold(f64::MAX, f64::min)), "{second} s");
    }
    assert!(data["diagrams"][0]["svg"].as_str().unwrap().contains("data-behavior=\"0\""));
    assert!(data["plume"]["frames"].as_array().unwrap().len() > 100);
}

/// Numbers that are told as differences, each so many times as large.
fn unpacked(list: &Value, scale: f64) -> Vec<f64> {
    let steps = list.as_array().unwrap().iter().map(|step| step.as_f64().unwrap());
    let sums = steps.scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum / scale)
    });
    sums.collect()
}

/// A page has each corner where the run began and how fast it moves; the picture has the outline as it was in the end.
#[test]
fn true_outlines_are_shown_as_they_move_beside_the_areas_that_were_reported() {
    let (folder, result) = run_script("spills", Path::new("tests/report/spills.alb"));
    let page = page_of(&folder);
    let data = data_of(&page);
    let world = &data["world"];
    let names = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap().to_string()).collect()
    };
    assert_eq!(names(&world["true_outlines"]), ["oil", "dye", "slick"]);
    assert_eq!(names(&world["outlines"]), ["dye", "guess.outline"]);
    let of = |spill: usize, what: &str, scale: f64| {
        [0, 1].map(|axis| unpacked(&world["true_outlines"][spill][what][axis], scale))
    };
    let ([north, east], [oil_north, oil_east]) = (of(1, "at", 10.0), of(0, "at", 10.0));
    assert_eq!((north.len(), north[0], east[0]), (360, -30.0, -40.0), "an ellipse of 60 m, its centre 60 m south");
    assert_eq!(of(1, "moves", 1e6), [vec![0.0; 360], vec![0.0; 360]]);
    // Sheared along 30 degrees: what lies across moves with it, and all of it drifts east.
    let [moves_north, moves_east] = of(0, "moves", 1e6);
    let (cos, sin) = (0.75f64.sqrt(), 0.5);
    for i in 0..360 {
        let across = 0.01 * (oil_east[i] * cos - (oil_north[i] - 20.0) * sin);
        assert!((moves_north[i] - across * cos).abs() < 2e-3, "{i}");
        assert!((moves_east[i] - 0.5 - across * sin).abs() < 2e-3, "{i}");
    }
    assert_eq!(
        (&world["true_outlines"][0]["half_life_s"], &world["true_outlines"][1]["half_life_s"]),
        (&60.0.into(), &Value::Null)
    );
    // It begins within the area and ends beyond it; of what is far away nothing is on the map.
    let east = world["extent"]["east"].as_f64().unwrap();
    assert!(east > 105.0 && east < 150.0, "{east}");
    assert!(data["plume"].is_null(), "nothing has filaments");
    assert!(result["reports"][0]["true_surface_m2"].is_number());
    let picture = std::fs::read_to_string(folder.join("run").join("run.svg")).unwrap();
    for text in ["true outline", "true outline at the start", "oil, 50 % left", "dye", "reported area", "guess.outline"]
    {
        assert!(picture.contains(&format!(">{text}</text>")), "no {text}");
    }
    assert!(!picture.contains(">slick<") && page.contains("guess.outline"));
    let plain = page.split_once("<noscript>").unwrap().1;
    assert!(plain.contains("oil, 50 % left"), "the picture of who has no scripts");
}

#[test]
fn a_page_is_made_again_with_the_same_bytes_and_overwrites_nothing_else() {
    let (folder, _) = run_of("again", "box.alb");
    let first = page_of(&folder);
    assert_eq!(page_of(&folder), first);
    let (code, _, said) = albacore(&folder, &["report", "run/journal", "--out", "other.html"]);
    assert_eq!(code, Some(0), "{said}");
    assert_eq!(std::fs::read_to_string(folder.join("other.html")).unwrap(), first);
    // Somebody's own, and one of ours that somebody has edited.
    for text in ["mine".to_string(), first.replace("<h2>Map</h2>", "<h2>My map</h2>")] {
        std::fs::write(folder.join("run").join("report.html"), &text).unwrap();
        let (code, _, said) = albacore(&folder, &["report", "run"]);
        assert_eq!(code, Some(4), "{said}");
        assert!(
            said.contains("report.html` cannot be written: it is there already") && said.contains("--out"),
            "{said}"
        );
        assert_eq!(std::fs::read_to_string(folder.join("run").join("report.html")).unwrap(), text);
    }
    let (code, _, said) = albacore(&folder, &["report", "run", "--out", "run/run.svg"]);
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("it is a file of the run in this folder"), "{said}");
}

/// Beside the next run it would be taken for a page of that.
#[test]
fn a_run_that_is_replaced_takes_its_page_with_it() {
    let (folder, _) = run_of("replaced", "box.alb");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("missions").join("box.alb");
    let replace = || albacore(&folder, &["run", script.to_str().unwrap(), "--out", "run", "--replace"]);
    let page = page_of(&folder);
    assert_eq!(replace().0, Some(0));
    let path = folder.join("run").join("report.html");
    assert!(!path.exists());
    std::fs::write(&path, page + "mine").unwrap();
    assert_eq!(replace().0, Some(0));
    assert!(path.exists(), "what somebody has edited stays");
}

#[test]
fn what_is_no_run_is_said_with_what_is() {
    let (folder, _) = run_of("refused", "box.alb");
    std::fs::write(folder.join("text"), "no journal").unwrap();
    for (arguments, expected, told) in [
        (&["report", "no_such"][..], 2, "cannot be read"),
        (&["report", "."], 2, "did you mean `./run`?"),
        (&["report", "text"], 4, "this is no journal"),
        (&["report", "run", "--out", "no/such/folder.html"], 4, "there is no folder `no/such`"),
        (&["report"], 2, "<RUN>"),
    ] {
        let (code, printed, said) = albacore(&folder, arguments);
        assert_eq!((code, printed.as_str()), (Some(expected), ""), "{arguments:?}: {said}");
        assert!(said.contains(told), "{arguments:?}: {said}");
    }
}

#[test]
fn what_others_wrote_is_shown_and_ends_nothing() {
    let folder = folder("hostile");
    std::fs::write(folder.join("north.alb"), mission(HOSTILE)).unwrap();
    let (_, _, said) = albacore(&folder, &["run", "north.alb", "--out", "run"]);
    let page = page_of(&folder);
    assert_eq!((page.matches("<script").count(), page.matches("</script>").count()), (2, 2), "{said}");
    assert!(!page.contains("<script>alert") && !page.contains("<!-- \""), "{said}");
    let data = data_of(&page);
    let name = data["reports"][0]["name"].as_str().unwrap();
    assert!(name.starts_with("</script><script>alert(1)</script><!-- \" onload=alert(2) {{data}}"), "{name}");
    assert!(page.contains("<td>&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!-- &quot; onload"));
    assert_eq!(page.matches("id=\"data\"").count(), 1, "nothing is filled in twice");
}

#[test]
fn a_journal_that_is_cut_short_is_shown_as_far_as_it_goes() {
    let (folder, result) = run_of("cut", "box.alb");
    let path = folder.join("run").join("journal");
    let whole = std::fs::read(&path).unwrap();
    std::fs::create_dir(folder.join("part")).unwrap();
    std::fs::write(folder.join("part").join("journal"), &whole[..whole.len() / 2]).unwrap();
    let (code, _, said) = albacore(&folder, &["report", "part"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("warning: the journal is cut short at byte "), "{said}");
    let page = std::fs::read_to_string(folder.join("part").join("report.html")).unwrap();
    assert!(page.contains("This run is not shown to its end: the journal is cut short at byte "));
    let head = &data_of(&page)["head"];
    assert_eq!((&head["outcome"], &head["digest"]), (&Value::from("end not known"), &Value::from("")));
    let (part, all) = (head["time_s"].as_f64().unwrap(), result["sim_time_s"].as_f64().unwrap());
    assert!(0.3 * all < part && part < 0.7 * all, "{part} of {all} s");
    // One in whose middle a byte was changed.
    let mut damaged = whole.clone();
    damaged[whole.len() / 2] ^= 1;
    std::fs::write(folder.join("part").join("journal"), &damaged).unwrap();
    let (code, _, said) = albacore(&folder, &["report", "part"]);
    assert_eq!((code, said.contains("warning: the journal is damaged at byte ")), (Some(0), true), "{said}");
}
