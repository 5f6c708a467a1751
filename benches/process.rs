//! What `albacore check` costs as a process, from start to exit, in CPU time: `cargo bench --bench process`.
//!
//! Worst inputs come in three sizes: the ratios tell whether the cost grows with the size and no faster.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark that cannot run or print has failed")]

use nix::sys::resource::{UsageWho, getrusage};
use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Stdio};

const CPT: &str = include_str!("../stdlib/cpt.alb");
/// What `cpt.alb` declares, and so what each copy of its declarations must name anew.
const NAMES: [&str; 4] = ["cpt_2005", "trace_plume", "side_of", "Source"];
const RUNS: usize = 20;
const WORST_RUNS: usize = 5;
/// How many lines, signs or levels the smallest of the worst inputs has.
const WORST: usize = 10_000;

fn main() {
    let folder = std::env::temp_dir().join(format!("albacore-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    println!("{:32} {:>8} ms", "stdlib/cpt.alb", rounded(median(Path::new("stdlib/cpt.alb"), RUNS)));
    println!("{:32} {:>8} ms", "10,000 lines", rounded(of_text(&folder, &repeated(10_000), RUNS)));
    for (name, make) in WORST_INPUTS {
        let times = [1, 2, 4].map(|times| of_text(&folder, &make(WORST * times), WORST_RUNS));
        let [one, two, four] = times;
        let ratios = format!("x{:.1} x{:.1}", two / one, four / one);
        println!("{name:32} {:>8} ms {:>8} ms {:>8} ms   {ratios}", rounded(one), rounded(two), rounded(four));
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

fn rounded(milliseconds: f64) -> String {
    format!("{milliseconds:.1}")
}

fn of_text(folder: &Path, text: &str, runs: usize) -> f64 {
    let file = folder.join("script.alb");
    std::fs::write(&file, text).unwrap();
    median(&file, runs)
}

/// The median of the CPU time, user's and system's, of `albacore check FILE`, in milliseconds.
fn median(file: &Path, runs: usize) -> f64 {
    let mut times: Vec<f64> = (0..runs)
        .map(|_| {
            let before = children();
            let albacore = env!("CARGO_BIN_EXE_albacore");
            Command::new(albacore).arg("check").arg(file).stderr(Stdio::null()).status().unwrap();
            children() - before
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[runs / 2]
}

fn children() -> f64 {
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).unwrap();
    let time = |t: nix::sys::time::TimeVal| t.tv_sec() as f64 * 1e3 + t.tv_usec() as f64 / 1e3;
    time(usage.user_time()) + time(usage.system_time())
}

/// The declarations of `cpt.alb` again and again, under other names each time.
fn repeated(lines: usize) -> String {
    let begin = CPT.find("\nrecord ").unwrap_or(0);
    let begin = CPT[..begin].rfind("\n///").unwrap_or(begin);
    let (head, declarations) = CPT.split_at(begin);
    let mut text = head.to_string();
    for copy in 0..lines.div_ceil(declarations.lines().count()) {
        text +=
            &NAMES.iter().fold(declarations.to_string(), |part, name| part.replace(name, &format!("{name}_{copy}")));
    }
    text
}

type Make = fn(usize) -> String;

const WORST_INPUTS: [(&str, Make); 14] = [
    ("sound declarations", repeated),
    ("unknown names", |n| body(n, |i| format!("let a{i} = nothing_{i} + 1"))),
    ("unknown units", |n| body(n, |i| format!("let a{i} = {i} mx"))),
    ("undeclared assignments", |n| body(n, |i| format!("a{i} = {i}"))),
    ("broken statements", |n| body(n, |i| format!("let a{i} = = {i}"))),
    ("broken declarations", |n| each(n, |i| format!("const A{i} = = {i}\n"))),
    ("unclosed brackets", |n| each(n, |i| format!("behavior b{i} {{ goto (position\n"))),
    ("warnings", |n| each(n, |i| format!("fn f{i}(x: Int) -> Int {{ let y = x; x }}\n"))),
    ("else if", |n| format!("fn f() -> Int {{ if true {{ 1 }}{} }}\n", " else if true { 2 }".repeat(n))),
    ("nested to the limit", |n| each(n / 100, |i| format!("const A{i} = {}1{}\n", "(".repeat(60), ")".repeat(60)))),
    ("one long line", |n| format!("const A = [{}1]\n", "1, ".repeat(n))),
    ("a text without end", |n| body(1, |_| format!("log \"{}", "x ".repeat(n)))),
    ("comments without end", |n| each(n, |_| "/* x y\n".to_string())),
    ("blank lines and comments", |n| each(n, |_| "// nothing\n\n".to_string())),
];

fn each(lines: usize, line: impl Fn(usize) -> String) -> String {
    (0..lines).map(line).collect()
}

fn body(lines: usize, line: impl Fn(usize) -> String) -> String {
    (0..lines).fold("mission m within 10 min {\n".to_string(), |mut text, i| {
        let _ = writeln!(text, "    {}", line(i));
        text
    }) + "}\n"
}
