//! `albacore graph`: what it draws, in each format, and what it says when there is nothing to draw.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Fig. 2 of Farrell, Pang & Li (2005) as the paper's text gives its edges: from, to, and on what, in the figure's symbols
/// (d: chemical is detected; no d: the behavior ends without; S: the source is declared) and as the script says it. A rule
/// is tried after those above it, so what these have taken needs no words: `detection` below a rule for S is d and no S.
///
/// Go-To is no part of the strategy: it is used "at the start of a mission" and "at the end" (Sec. III-A.1), and so is the
/// mission's here. Where the paper goes on to postdeclaration maneuvers (Sec. III-D) the strategy ends with the source.
const FIG_2: [(&str, &str, &str, &str); 7] = [
    // Sec. III-A.2: "If odor is detected, then the behavior switches to Track-In."
    ("find", "track_in", "d", "detection"),
    // Sec. III-A.3: "If the AUV fails to detect chemical for lambda seconds, then AMP [...] switches to Track-Out."
    ("track_in", "track_out", "no d", "no detection for lambda"),
    // Sec. III-A.4: "Track-Out ends either when chemical is detected or the AUV arrives [...]. In either case the BBP checks
    // whether it can declare a source location [...]. If the source is declared, then postdeclaration maneuvering begins."
    ("track_out", "finish source", "S", "(detection or done) and source"),
    // "If chemical is detected and the source location cannot be declared, then the behavior switches to Track-In."
    ("track_out", "track_in", "d and no S", "detection"),
    // "If the AUV arrives at the commanded point without detecting and the source location cannot be declared, then the
    // behavior switches to Reacquire."
    ("track_out", "reacquire", "no d and no S", "done"),
    // Sec. III-A.5: "A detection at any time switches the behavior to Track-In."
    ("reacquire", "track_in", "d", "detection"),
    // "If the list becomes empty, then the AUV reverts to the Find behavior."
    ("reacquire", "find", "no d", "done"),
];

/// Every kind of edge, and texts that each format must take care of.
const EDGES: &str = r#"
mission edges within 5 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 400 m, width: 200 m)
    limits { altitude >= 2 m, speed <= 2.5 m/s }
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 5 min { goto op.center }
    with depth 3 m, speed 1 m/s
    memory tries: Int = 0

    behavior go { steer 0 deg for 10 s }
    behavior look { steer 90 deg for 10 s }
    behavior end { steer 180 deg for 10 s }

    start go
    go       -> go    on done and                 // once more
                         tries * 2 < 4            do { tries = tries + 1 }
    go       -> look  on becomes after 5 s then back
    go       -> end   on done
    go       -> end   on after 1 min
    end      -> abort "\"far\" & <deep> #1" on tries > 3
    look,end -> finish on tries > 5
    end      -> finish on done
    any      -> end   on after 2 min
}
"#;

/// An empty folder of a test's own, with scripts.
fn folder(name: &str, scripts: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("graph-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for (file, text) in scripts {
        std::fs::write(folder.join(file), text).unwrap();
    }
    folder
}

/// What `albacore graph` ends with, prints and says.
fn graph_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.arg("graph").args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// What it draws, where there is no file.
#[track_caller]
fn drawn(arguments: &[&str]) -> String {
    // Tests run side by side, and each empties its folder first: one of its own for each.
    let test = std::thread::current().name().unwrap_or("main").to_string();
    let (code, printed, said) = graph_in(&folder(&test, &[]), arguments);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    printed
}

/// What it says and ends with, instead.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let (code, printed, said) = graph_in(folder, arguments);
    assert_eq!(printed, "");
    (code, said)
}

/// The edges of a diagram for Graphviz: from, to and label.
fn edges(dot: &str) -> Vec<(String, String, String)> {
    let edge = |line: &str| {
        let (ends, label) = line.trim().split_once(" [label=\"")?;
        let (from, to) = ends.split_once(" -> ")?;
        let (label, _) = label.split_once('"')?;
        let bare = |name: &str| name.trim_matches('"').to_string();
        Some((bare(from), bare(to), label.replace("\\n", " ")))
    };
    dot.lines().filter_map(edge).collect()
}

#[test]
fn the_strategy_of_2005_has_the_edges_of_fig_2() {
    let drawn = edges(&drawn(&["cpt", "cpt_2005", "--format", "dot"]));
    let edge = |(i, (from, to, _, on)): (usize, (&str, &str, &str, &str))| {
        (from.to_string(), to.to_string(), format!("{}: {on}", i + 1))
    };
    assert_eq!(drawn, FIG_2.into_iter().enumerate().map(edge).collect::<Vec<_>>());
}

#[test]
fn the_strategy_of_2005_for_graphviz() {
    insta::assert_snapshot!(drawn(&["cpt", "cpt_2005", "--format", "dot"]));
}

#[test]
fn the_strategy_of_2005_for_mermaid() {
    insta::assert_snapshot!(drawn(&["cpt", "cpt_2005", "--format", "mermaid"]));
}

#[test]
fn the_picture_in_the_documents_is_the_one_that_is_drawn() {
    let kept = include_str!("../docs/cpt_2005.svg");
    assert!(drawn(&["cpt", "cpt_2005"]) == kept, "look at it: albacore graph cpt cpt_2005 > docs/cpt_2005.svg");
}

/// The texts of a picture that stand one beneath the other, joined.
fn texts(svg: &str) -> String {
    let text = |line: &str| Some(line.strip_prefix("<text ")?.split_once('>')?.1.strip_suffix("</text>")?.to_string());
    svg.lines().filter_map(text).collect::<Vec<_>>().join(" ")
}

#[test]
fn every_behavior_and_every_guard_is_in_the_picture() {
    let svg = drawn(&["cpt", "trace_plume"]);
    let texts = texts(&svg);
    for name in ["find", "track_in", "track_out", "scan", "ride", "weigh", "regain"] {
        assert!(texts.contains(name), "{name}");
    }
    let guards = [
        "1 late",
        "2 contact and leads_out(area, position, upflow, edge)",
        "3 contact",
        "4 no contact for lambda",
        "5 contact",
        "6 done",
        "7 beside",
        "8 farther",
        "9 done",
        "10 farther",
        "11 done and contacts.count &lt; 5",
        "12 done and not fresh",
        "13 done",
        "14 done and counted &gt;= looks",
        "15 done and late and contacts.first",
        "16 done and late",
        "17 done",
        "18 contact",
        "19 done",
    ];
    for guard in guards {
        assert!(texts.contains(guard), "{guard}\n{texts}");
    }
    assert!(
        texts.contains("finish Source(at: area.exit(position, toward: upflow), radius: edge, finding: at_edge)"),
        "{texts}"
    );
    assert!(
        svg.contains("<title>find -&gt; track_in on contact do { side = side_of(course, current.toward) }</title>")
    );
    assert!(!svg.contains("href") && !svg.contains("url("), "it needs nothing else");
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "a coordinate is no number");
}

#[test]
fn every_kind_of_edge_in_every_format() {
    let folder = folder("edges", &[("edges.alb", EDGES)]);
    let draw = |format: &str| {
        let (code, printed, said) = graph_in(&folder, &["edges.alb", "--format", format]);
        assert_eq!((code, said.as_str()), (Some(0), ""));
        printed
    };
    insta::assert_snapshot!("every_kind_of_edge_for_graphviz", draw("dot"));
    insta::assert_snapshot!("every_kind_of_edge_for_mermaid", draw("mermaid"));
    let svg = draw("svg");
    assert!(svg.contains("stroke-dasharray") && svg.contains(">then back<"));
    // A rule without its comment, two lines of a box that say the same, and what XML must not read.
    assert!(svg.contains("<title>go -&gt; go on done and tries * 2 &lt; 4 do { tries = tries + 1 }"));
    assert!(
        svg.contains("<title>go -&gt; end on done; go -&gt; end on after 1 min; go -&gt; end on after 2 min</title>")
    );
    assert!(svg.contains("&quot;far&quot; &amp; &lt;deep&gt; #1"), "{svg}");
}

#[test]
fn a_file_is_written_where_it_is_asked_for() {
    let folder = folder("out", &[("edges.alb", EDGES)]);
    let (code, printed, _) = graph_in(&folder, &["edges.alb", "edges", "--out", "edges.svg"]);
    assert_eq!((code, printed.as_str()), (Some(0), ""));
    let (_, printed, _) = graph_in(&folder, &["edges.alb"]);
    let written = std::fs::read_to_string(folder.join("edges.svg")).unwrap();
    let mark = written.strip_prefix(printed.as_str()).unwrap();
    assert!(mark.starts_with("<!-- Made by Albacore: ") && mark.ends_with(" -->\n"), "{mark}");
    let (code, said) = refused(&folder, &["edges.alb", "--out", "no/such/folder.svg"]);
    assert_eq!(code, Some(4));
    assert!(said.contains("`no/such/folder.svg` cannot be written"), "{said}");
}

#[test]
fn a_strategy_of_a_module_by_the_name_that_the_script_has_for_it() {
    let missions = Path::new(env!("CARGO_MANIFEST_DIR")).join("missions");
    let (code, printed, said) = graph_in(&missions, &["duck_single.alb", "cpt.trace_plume"]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    assert_eq!(printed, drawn(&["cpt", "trace_plume"]));
}

#[test]
fn what_cannot_be_drawn_is_said_with_what_can() {
    let bare = "fn half(a: Length) -> Length { a / 2 }\n";
    let wrong = "fn share(a: Length, b: Length) -> Ratio { a / b }\n";
    let importing = "use cpt\n";
    let folder = folder(
        "refused",
        &[("bare.alb", bare), ("wrong.alb", wrong), ("importing.alb", importing), ("cpt2.alb", bare)],
    );
    let mut said = String::new();
    for arguments in [
        &["cpt"][..],
        &["cpt", "trace_plum"],
        &["cpt", "nothing_like_it"],
        &["cpt", "search.find"],
        &["bare.alb"],
        &["importing.alb"],
        &["importing.alb", "trace_plume"],
        &["cpl"],
        &["cpt2"],
        &["no_such_module"],
        &["bar.alb"],
        &["wrong.alb"],
    ] {
        let (code, message) = refused(&folder, arguments);
        said.push_str(&format!("> graph {} ends with {}\n{message}\n", arguments.join(" "), code.unwrap()));
    }
    insta::assert_snapshot!(said);
}
