//! How late commands come at 10 Hz over a pseudo terminal, on a machine that has other things to do: `cargo bench --bench jitter`.
//!
//! The far end says its state every 100 ms and waits for the command that answers it. Meanwhile each core has a busy process, the
//! terminal of `albacore run` is frozen (Ctrl-S), and the thread that writes its journal is stopped where it is, as a stalled disk
//! stops it. Beside it the same line with a process at its end that does nothing but answer: what is left is the system's.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark that cannot run or print has failed")]
#![expect(clippy::disallowed_methods, reason = "it measures the wall's time")]

use albacore_session::{FarEnd, ServedVehicle, Transport, Url, load, serve};
use nix::fcntl::OFlag;
use nix::pty::{PtyMaster, grantpt, posix_openpt, ptsname_r, unlockpt};
use nix::sys::ptrace;
use nix::unistd::Pid;
use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SCRIPT: &str = "benches/jitter/turning.alb";
const PERIOD: Duration = Duration::from_millis(100);
const PERIODS: usize = 600;
/// What the bare peer answers with: a goal, as long as others.
const ANSWER: &[u8] = b"#C,Heading,Goal,123.4,*00\n";

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.get(1).map(String::as_str) {
        Some("--spin") => spin(),
        Some("--answer") => answer(&arguments[2]),
        _ => compare(),
    }
}

fn spin() {
    let mut x = 1_u64;
    loop {
        x = std::hint::black_box(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
    }
}

/// Answers each line with a goal.
fn answer(path: &str) {
    let mut line = File::options().read(true).write(true).custom_flags(OFlag::O_NOCTTY.bits()).open(path).unwrap();
    let mut part = [0; 4096];
    while let Ok(count @ 1..) = line.read(&mut part) {
        if part[..count].contains(&b'\n') {
            line.write_all(ANSWER).unwrap();
        }
    }
}

fn compare() {
    let cores = std::thread::available_parallelism().unwrap().get();
    println!("{PERIODS} periods of {} ms, {cores} cores, each with a busy process", PERIOD.as_millis());
    println!("{:44} {:>8} {:>8} {:>8} {:>8}", "", "p50 ms", "p99 ms", "max ms", "missed");
    let spinners: Vec<Child> = (0..cores).map(|_| own(&["--spin"]).spawn().unwrap()).collect();
    told("albacore, terminal and disk stalled", &albacore());
    told("a line and a process that answers", &raw());
    for mut spinner in spinners {
        spinner.kill().unwrap();
        spinner.wait().unwrap();
    }
}

fn own(arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(arguments).stdin(Stdio::null());
    command
}

fn told(what: &str, answers: &[Option<Duration>]) {
    let mut came: Vec<f64> = answers.iter().flatten().map(|late| late.as_secs_f64() * 1e3).collect();
    came.sort_by(f64::total_cmp);
    let at = |share: f64| came[((came.len() - 1) as f64 * share).round() as usize];
    let missed = answers.len() - came.iter().filter(|late| **late <= PERIOD.as_secs_f64() * 1e3).count();
    println!("{what:44} {:>8.2} {:>8.2} {:>8.2} {missed:>8}", at(0.5), at(0.99), at(1.0));
}

/// The far end, and where the other finds it.
fn far_end() -> (FarEnd, Box<dyn Transport + Send>, String) {
    let script = load(Path::new(SCRIPT), None, &[]).unwrap();
    let url = Url::parse("pty:?dialect=recon").unwrap();
    let far_end = ServedVehicle::new(&script, SCRIPT, None).unwrap().far_end(&url, 1, None).unwrap();
    let (transport, at) = serve(&url).unwrap();
    (far_end, transport, at)
}

fn raw() -> Vec<Option<Duration>> {
    let (mut far_end, mut transport, at) = far_end();
    let path = at.trim_start_matches("serial:").split('?').next().unwrap().to_string();
    let mut peer = own(&["--answer", &path]).spawn().unwrap();
    // Until it has opened the line.
    periods(&mut far_end, transport.as_mut(), 20, false);
    let answers = periods(&mut far_end, transport.as_mut(), PERIODS, false);
    peer.kill().unwrap();
    peer.wait().unwrap();
    answers
}

fn albacore() -> Vec<Option<Duration>> {
    let (mut far_end, mut transport, at) = far_end();
    let (mut person, line) = terminal();
    let out = std::env::temp_dir().join(format!("albacore-jitter-{}", std::process::id()));
    let mut run = Command::new(env!("CARGO_BIN_EXE_albacore"));
    run.args(["run", SCRIPT, "--link", &at, "--replace", "--out"]).arg(&out).stdin(Stdio::null());
    let mut run = run.stdout(line.try_clone().unwrap()).stderr(line).spawn().unwrap();
    // Until it drives, and its terminal and its disk have begun to be written.
    periods(&mut far_end, transport.as_mut(), 50, true);
    assert!(far_end.is_driven(), "nobody drives");
    person.write_all(b"\x13").unwrap();
    let journal = thread_named(run.id(), "journal");
    ptrace::seize(journal, ptrace::Options::empty()).unwrap();
    ptrace::interrupt(journal).unwrap();
    periods(&mut far_end, transport.as_mut(), 20, true);
    let answers = periods(&mut far_end, transport.as_mut(), PERIODS, true);
    ptrace::detach(journal, None).unwrap();
    run.kill().unwrap();
    run.wait().unwrap();
    std::fs::remove_dir_all(out).unwrap();
    answers
}

/// The first line of each period, counted from when the state was sent.
fn periods(far_end: &mut FarEnd, transport: &mut dyn Transport, count: usize, hears: bool) -> Vec<Option<Duration>> {
    let mut heard = Vec::new();
    let begun = Instant::now();
    let period = |k: usize| {
        std::thread::sleep((begun + PERIOD * k as u32).saturating_duration_since(Instant::now()));
        far_end.tick(if hears { &heard } else { &[] }).unwrap();
        heard.clear();
        transport.send(&far_end.take_output()).unwrap();
        let sent = Instant::now();
        let mut answered = None;
        // The rest of the period is left for the far end's own work.
        let until = begun + PERIOD * (k as u32 + 1) - Duration::from_millis(2);
        while Instant::now() < until {
            let before = heard.len();
            transport.receive(&mut heard, until.saturating_duration_since(Instant::now())).unwrap();
            if answered.is_none() && heard[before..].contains(&b'\n') {
                answered = Some(sent.elapsed());
            }
        }
        answered
    };
    (0..count).map(period).collect()
}

/// A terminal: the person's end, and the program's.
fn terminal() -> (PtyMaster, File) {
    let person = posix_openpt(OFlag::O_RDWR | OFlag::O_NOCTTY).unwrap();
    grantpt(&person).unwrap();
    unlockpt(&person).unwrap();
    let path = ptsname_r(&person).unwrap();
    let line = File::options().read(true).write(true).custom_flags(OFlag::O_NOCTTY.bits()).open(path).unwrap();
    (person, line)
}

fn thread_named(process: u32, name: &str) -> Pid {
    let threads = PathBuf::from(format!("/proc/{process}/task"));
    let mut threads = std::fs::read_dir(threads).unwrap().map(|thread| thread.unwrap().path());
    let thread = threads.find(|thread| std::fs::read_to_string(thread.join("comm")).unwrap().trim() == name).unwrap();
    Pid::from_raw(thread.file_name().unwrap().to_string_lossy().parse().unwrap())
}
