//! The page of a run that goes on: what it is told adds up to the report of the finished run, nobody who asks holds the run or changes it,
//! and nobody but a browser of this machine is answered.
//!
//! Nothing is timed: what is waited for is waited for long.

#![expect(clippy::unwrap_used, reason = "a test that cannot start its own programs has failed")]
#![cfg(target_os = "linux")]

use crate::far_end::*;
use crate::held::Terminal;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::Child;

/// A run whose page is served.
struct Looked {
    run: Child,
    log: PathBuf,
    port: u16,
}

impl Looked {
    /// Begins a run of these words, and waits until its page is there.
    fn begin(folder: &Path, words: &[&str]) -> Self {
        let log = folder.join("run.log");
        let mut command = albacore(&["run"]);
        command.args(words).arg("--live").stderr(std::fs::File::create(&log).unwrap());
        let run = command.stdout(std::fs::File::create(folder.join("run.out")).unwrap()).spawn().unwrap();
        let said = || std::fs::read_to_string(&log).unwrap();
        let port = eventually("the address of the page", || {
            let said = said();
            let (_, after) = said.split_once("live at http://127.0.0.1:")?;
            after.split_once('/')?.0.parse().ok()
        });
        Looked { run, log, port }
    }

    fn said(&self) -> String {
        std::fs::read_to_string(&self.log).unwrap()
    }

    fn connect(&self) -> TcpStream {
        TcpStream::connect(("127.0.0.1", self.port)).unwrap()
    }

    /// What is answered to a request that is written so; nothing where the connection is closed without a word.
    fn says(&self, request: &[u8]) -> String {
        let mut stream = self.connect();
        // Who refuses need not read to the end.
        let _ = stream.write_all(request);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn get(&self, target: &str) -> String {
        self.says(format!("GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\r\n", self.port).as_bytes())
    }

    /// What is new to a page.
    fn data(&self, since: &str) -> Value {
        let answer = self.get(&format!("/data?page=7&since={since}"));
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with("HTTP/1.1 200 OK\r\n"), "{head}");
        serde_json::from_str(body).unwrap()
    }

    /// How it ends, and what it says.
    fn ends(mut self) -> (Option<i32>, String) {
        let status = eventually("the end of the run", || self.run.try_wait().unwrap());
        (status.code(), self.said())
    }
}

/// A test that fails leaves no run behind.
impl Drop for Looked {
    fn drop(&mut self) {
        let _ = self.run.kill();
        let _ = self.run.wait();
    }
}

/// What a page makes of the increments that it is told.
#[derive(Default)]
struct Known {
    series: BTreeMap<String, Vec<Option<i64>>>,
    colours: Vec<Option<i64>>,
    spans: Vec<[u64; 3]>,
    ticks: Vec<Option<u64>>,
    activities: Vec<Value>,
    happenings: Vec<Value>,
    reports: Value,
    diagrams: Value,
    world: Value,
    increments: usize,
}

fn numbers(list: &Value) -> Vec<Option<i64>> {
    let mut sum = 0;
    let list = list.as_array().unwrap().iter();
    list.map(|step| {
        sum += step.as_i64()?;
        Some(sum)
    })
    .collect()
}

fn put(values: &mut Vec<Option<i64>>, slot: usize, list: &Value) {
    values.resize(values.len().max(slot), None);
    values.truncate(slot);
    values.extend(numbers(list));
}

fn listed(list: &Value) -> Vec<u64> {
    list.as_array().unwrap().iter().map(|number| number.as_u64().unwrap()).collect()
}

impl Known {
    fn take(&mut self, more: &Value) {
        if more["anew"] == true {
            *self = Known { increments: self.increments, ..Known::default() };
        }
        self.increments += 1;
        let slot = more["slot"].as_u64().unwrap() as usize;
        for series in more["series"].as_array().unwrap() {
            let known = self.series.entry(series["name"].as_str().unwrap().to_string()).or_default();
            put(known, slot, &series["values"]);
        }
        put(&mut self.colours, slot, &more["colours"]);
        self.activities.extend_from_slice(more["activities"].as_array().unwrap());
        self.happenings.extend_from_slice(more["happenings"].as_array().unwrap());
        let [activity, level, from] = ["activity", "level", "from"].map(|part| listed(&more["spans"][part]));
        self.spans
            .extend(activity.iter().zip(level).zip(from).map(|((activity, level), from)| [*activity, level, from]));
        self.ticks.resize(self.spans.len(), None);
        for closed in more["spans"]["closed"].as_array().unwrap() {
            self.ticks[closed[0].as_u64().unwrap() as usize] = closed[1].as_u64();
        }
        for (known, part) in
            [(&mut self.reports, "reports"), (&mut self.diagrams, "diagrams"), (&mut self.world, "world")]
        {
            if !more[part].is_null() {
                *known = more[part].clone();
            }
        }
    }

    /// Whether it is what the report of the run holds.
    #[track_caller]
    fn is_that_of(&self, report: &Value) {
        for series in report["series"].as_array().unwrap() {
            let name = series["name"].as_str().unwrap();
            assert_eq!(self.series[name], numbers(&series["values"]), "{name}");
        }
        assert_eq!(self.series.len(), report["series"].as_array().unwrap().len());
        assert_eq!(self.colours, numbers(&report["colours"]));
        assert_eq!(json!(self.activities), report["activities"]);
        assert_eq!(json!(self.happenings), report["happenings"]);
        let [activity, level, from, ticks] =
            ["activity", "level", "from", "ticks"].map(|part| listed(&report["spans"][part]));
        let firsts = from.iter().scan(0, |tick, step| {
            *tick += step;
            Some(*tick)
        });
        let spans: Vec<[u64; 3]> =
            activity.iter().zip(level).zip(firsts).map(|((activity, level), from)| [*activity, level, from]).collect();
        assert_eq!(self.spans, spans);
        assert_eq!(self.ticks, ticks.into_iter().map(Some).collect::<Vec<_>>());
        for (known, part) in [(&self.reports, "reports"), (&self.diagrams, "diagrams"), (&self.world, "world")] {
            assert_eq!(*known, report[part], "{part}");
        }
    }
}

/// Asks until the run has ended: what was told, and the last of it.
fn to_the_end(run: &Looked) -> (Known, Value) {
    let (mut known, mut cursor) = (Known::default(), String::new());
    let last = eventually("the end of the run", || {
        let more = run.data(&cursor);
        cursor = more["cursor"].as_str().unwrap().to_string();
        known.take(&more);
        (more["ended"] == true).then_some(more)
    });
    (known, last)
}

/// The data in the report of a run in a folder.
fn report_of(folder: &Path) -> Value {
    let output = albacore(&["report"]).arg(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    let (_, after) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn increments_add_up_to_the_report_of_the_finished_run() {
    for (mission, rate) in [("missions/box.alb", "200"), ("missions/duck_single.alb", "1000")] {
        let folder = empty("live-adds-up");
        let out = folder.join("run");
        let run = Looked::begin(&folder, &[mission, "--rate", rate, "--out", out.to_str().unwrap()]);
        let (known, last) = to_the_end(&run);
        assert_eq!((run.ends().0, last["missed"].as_u64()), (Some(0), Some(0)));
        assert!(known.increments > 3, "{} increments", known.increments);
        let mut report = report_of(&out);
        // A page is no journal: it does not know when the clock stood at 0.
        report["head"]["first_tick"] = Value::Null;
        // Which conditions were tried is asked of a journal, and of no run that goes on.
        for happening in report["happenings"].as_array_mut().unwrap() {
            if let Some(why) = happening.get_mut("why").and_then(Value::as_object_mut) {
                why.remove("tried");
            }
        }
        assert_eq!(last["head"], report["head"]);
        assert!(last["head_html"].as_str().unwrap().contains(report["head"]["digest"].as_str().unwrap()));
        known.is_that_of(&report);
        let [mission, scenario] = ["mission", "scenario"].map(|name| report["head"][name].as_str().unwrap());
        assert_eq!(last["title"], json!(format!("{mission} in {scenario}, seed 1: completed")));
    }
}

#[test]
fn a_run_on_a_link_is_looked_at_too() {
    let folder = empty("live-link");
    let vehicle = Vehicle::serve("udp:127.0.0.1:0?dialect=recon", &folder);
    let out = folder.join("run");
    let words = [EXCURSION, "--link", &vehicle.link, RATE[0], RATE[1], "--out", out.to_str().unwrap()];
    let run = Looked::begin(&folder, &words);
    let (known, last) = to_the_end(&run);
    let (code, said) = run.ends();
    assert_eq!(code, Some(0), "{said}");
    assert_eq!((&last["head"]["is_link"], &last["head"]["outcome"]), (&json!(true), &json!("completed")));
    assert!(!said.contains("altitude"), "where there is no terminal nothing tells how it stands: {said}");
    let report = report_of(&out);
    assert_eq!(last["head"]["ticks"], report["head"]["ticks"]);
    known.is_that_of(&report);
}

#[test]
fn whoever_is_no_browser_of_this_machine_is_refused_and_disturbs_nothing() {
    let folder = empty("live-hostile");
    let run = Looked::begin(&folder, &[EXCURSION, "--mission", "stay", "--rate", "50", "--no-out"]);
    let port = run.port;
    let host = format!("Host: 127.0.0.1:{port}\r\n");
    let page = run.get("/");
    assert!(page.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\n"), "{page}");
    for told in ["X-Content-Type-Options: nosniff", "frame-ancestors 'none'", "Cache-Control: no-store"] {
        assert!(page.contains(told), "{told}");
    }
    assert!(!page.contains("Access-Control-"), "{page}");
    let long = format!("GET / HTTP/1.1\r\n{host}X: {}\r\n\r\n", "x".repeat(100_000));
    let wide = format!("GET /{} HTTP/1.1\r\n{host}\r\n", "x".repeat(100_000));
    for (request, status) in [
        (format!("POST / HTTP/1.1\r\n{host}Content-Length: 5\r\n\r\nhello"), "405"),
        (format!("HEAD / HTTP/1.1\r\n{host}\r\n"), "405"),
        (format!("OPTIONS /data HTTP/1.1\r\n{host}Origin: http://evil.example\r\n\r\n"), "405"),
        (format!("GET / HTTP/1.1\r\nHost: evil.example:{port}\r\n\r\n"), "403"),
        ("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".to_string(), "403"),
        ("GET / HTTP/1.1\r\n\r\n".to_string(), "400"),
        (format!("GET /../../etc/passwd HTTP/1.1\r\n{host}\r\n"), "404"),
        (format!("GET /%2e%2e/journal HTTP/1.1\r\n{host}\r\n"), "404"),
        (format!("GET http://evil.example/ HTTP/1.1\r\n{host}\r\n"), "404"),
        (format!("GET /data?since=1.2 HTTP/1.1\r\n{host}\r\n"), "400"),
        (format!("GET /data HTTP/1.1\r\n{host}Sec-Fetch-Site: cross-site\r\n\r\n"), "403"),
        ("\u{0}\u{1}\u{2}\r\n\r\n".to_string(), "400"),
        (long, "431"),
        (wide, "431"),
        // It never comes to its end.
        ("GET / HT".to_string(), "408"),
    ] {
        let answer = run.says(request.as_bytes());
        let shown = &request[..request.len().min(80)];
        assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{shown:?}: {answer}");
    }
    // A cursor of another run, or of nobody, is told everything.
    let foreign = run.data("1.99999999.9.9.9.9.9.9");
    assert_eq!((&foreign["anew"], &foreign["slot"]), (&json!(true), &json!(0)));
    // Many who say nothing: they lose their places, and the page is served again.
    let silent: Vec<TcpStream> = (0..100).map(|_| run.connect()).collect();
    eventually("the page", || run.get("/").starts_with("HTTP/1.1 200").then_some(()));
    drop(silent);
    let ticks = |more: &Value| more["head"]["ticks"].as_u64().unwrap();
    let before = ticks(&run.data(""));
    let later = eventually("a later tick", || Some(run.data("")).filter(|more| ticks(more) > before + 100));
    assert_eq!(later["missed"], 0);
    send("-INT", &run.run);
    let (code, said) = run.ends();
    assert_eq!(code, Some(1), "{said}");
}

/// The run is over when it is over, whoever holds on to its page.
#[test]
fn who_holds_a_connection_does_not_hold_the_end() {
    let folder = empty("live-held");
    let run = Looked::begin(&folder, &["missions/box.alb", "--rate", "400", "--no-out"]);
    let request = format!("GET /data?page=1 HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", run.port);
    let mut held: Vec<TcpStream> = (0..8).map(|_| run.connect()).collect();
    held.iter_mut().step_by(2).for_each(|stream| stream.write_all(request.as_bytes()).unwrap());
    assert_eq!(run.ends().0, Some(0));
    assert_eq!(held.len(), 8, "they are held to here");
}

#[test]
fn who_looks_changes_no_byte() {
    let folder = empty("live-bytes");
    let run_of = |name: &str| folder.join(name);
    let plain = albacore(&["run", "missions/box.alb", "--json", "--out"]).arg(run_of("plain")).output().unwrap();
    assert_eq!(plain.status.code(), Some(0), "{}", stderr(&plain));
    let out = run_of("looked");
    let run = Looked::begin(&folder, &["missions/box.alb", "--rate", "400", "--json", "--out", out.to_str().unwrap()]);
    to_the_end(&run);
    assert_eq!(run.ends().0, Some(0));
    for file in ["journal", "trace.txt", "run.svg"] {
        let [plain, looked] = ["plain", "looked"].map(|name| std::fs::read(run_of(name).join(file)).unwrap());
        assert!(plain == looked, "{file}");
    }
    let printed = std::fs::read_to_string(folder.join("run.out")).unwrap();
    let [mut plain, mut looked]: [Value; 2] =
        [&*String::from_utf8_lossy(&plain.stdout), &printed].map(|text| serde_json::from_str(text).unwrap());
    for result in [&mut plain, &mut looked] {
        result["wall_s"] = Value::Null;
        result["folder"] = Value::Null;
    }
    assert_eq!(plain, looked);
    let files = |name: &str| std::fs::read_dir(run_of(name)).unwrap().count();
    assert_eq!(files("plain"), files("looked"));
}

#[test]
fn a_port_that_is_taken_costs_nobody_a_run() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let out = empty("live-taken").join("run");
    let mut run = albacore(&["run", "missions/box.alb", "--live", "--port", &port, "--out"]);
    let output = run.arg(&out).output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot be served at 127.0.0.1:") && stderr(&output).contains("--port"));
    assert!(!out.exists());
    let output = albacore(&["run", "missions/box.alb", "--port", "0"]).output().unwrap();
    assert_eq!((output.status.code(), stderr(&output).contains("--live")), (Some(2), true), "{}", stderr(&output));
}

/// On one line, of a simulated run and of one on a link.
#[test]
fn a_terminal_is_told_how_a_run_stands() {
    let folder = empty("live-status");
    let mut terminal = Terminal::new();
    let mut run = albacore(&["run", "missions/box.alb", "--live", "--rate", "20", "--no-out"]);
    let mut run = run.stderr(terminal.line()).env("TERM", "xterm").spawn().unwrap();
    terminal.says(" m  altitude ");
    send("-INT", &run);
    assert_eq!(eventually("the end", || run.try_wait().unwrap()).code(), Some(1));
    let vehicle = Vehicle::serve("udp:127.0.0.1:0?dialect=recon", &folder);
    let mut terminal = Terminal::new();
    let mut run = vehicle.mission(&["--mission", "stay", "--no-out"]);
    let mut run = run.stderr(terminal.line()).env("TERM", "xterm").spawn().unwrap();
    terminal.says(" m  depth ");
    send("-INT", &run);
    assert_eq!(eventually("the end", || run.try_wait().unwrap()).code(), Some(1));
}
