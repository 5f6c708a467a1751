//! The same with the real programs: `run --link` against `vehicle --link-faults`, over a pseudo terminal and over UDP.

use albacore_trace::journal::{Ending, Journal};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

const RATE: [&str; 2] = ["--rate", "20"];
const STEADY: &str = "loss: 5 %, corrupt: 5 %, split: 5 %, repeat: 5 %, reorder: 5 %, delay: 200 ms";
const CUT: &str = "loss: 100 %, from: 25 s, to: 27 s";

fn albacore(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1").stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("attack").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Asks again and again, for minutes.
#[track_caller]
fn eventually<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    for _ in 0..24_000 {
        if let Some(answer) = ask() {
            return answer;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    unreachable!("in vain: {what}");
}

/// A served vehicle; it ends with its test.
struct Served(Child);

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[track_caller]
fn is_survived(link: &str, name: &str) {
    let folder = empty(name);
    let log = folder.join("vehicle.log");
    let world = format!("{}#bay", super::ATTACK);
    let mut vehicle = albacore(&["vehicle", &world, "--link", link, "--link-faults", STEADY, "--link-faults", CUT]);
    let _served = Served(vehicle.args(RATE).stderr(std::fs::File::create(&log).unwrap()).spawn().unwrap());
    let said = || std::fs::read_to_string(&log).unwrap();
    let at = eventually("a link", || Some(said().split_once("link open at ")?.1.split_once('\n')?.0.to_string()));
    let out = folder.join("out");
    let run = ["run", super::ATTACK, "--mission", "there_and_back", "--link", &at, "--out"];
    let output = albacore(&run).arg(&out).args(RATE).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    // Which way it ends is the link's to say.
    assert!(matches!(output.status.code(), Some(0 | 1 | 4)), "{:?}: {told}", output.status);
    let journal = Journal::read(&std::fs::read(out.join("journal")).unwrap()).unwrap();
    assert!(matches!(journal.ending, Ending::Complete(_)), "{:?}: {told}", journal.ending);
    let ends = ["override released", "override timed out", "override taken back", "given up"];
    eventually("the vehicle drives itself again", || {
        let said = said();
        let after = said.rsplit_once("override taken at").map_or("given up", |(_, after)| after);
        ends.iter().any(|end| after.contains(end)).then_some(())
    });
}

#[test]
fn a_bad_line_is_survived() {
    is_survived("pty:?dialect=recon", "pty");
}

#[test]
fn a_bad_network_is_survived() {
    is_survived("udp:127.0.0.1:0?dialect=recon", "udp");
}

#[test]
fn what_is_no_fault_of_a_link_is_told() {
    let cases = [
        ("loss: 5", "5 is outside the range of `loss`"),
        ("lost: 5 %", "`lost`"),
        ("delay: 200 m", "is a Duration, this is a Length"),
        ("link_fault(loss: 5)", "5 is outside the range of `loss`"),
        ("", "nothing goes wrong here"),
        ("from: 5 s", "nothing goes wrong here"),
        ("loss: 5 %, from: 60 s, to: 30 s", "make `to` later than `from`"),
        ("loss: 5 %)\n    flow(1 m/s toward 0 deg", "not `flow`"),
    ];
    for (text, said) in cases {
        let link = ["--link", "pty:?dialect=recon", "--link-faults", text];
        let output = albacore(&["vehicle", &format!("{}#bay", super::ATTACK)]).args(link).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(3) && told.contains(said), "{text}: {told}");
    }
}
