//! The far end of a link as a program of its own, and what it says.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot start its own programs has failed")]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

pub const EXCURSION: &str = "tests/link/excursion.alb";
pub const RATE: [&str; 2] = ["--rate", "50"];
/// Where a bound of the mission's own decides: at [`RATE`] 10 s are 0.2 s of a computer that may have other things to do.
pub const SLOW_RATE: [&str; 2] = ["--rate", "5"];

pub fn albacore(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(args).current_dir(env!("CARGO_MANIFEST_DIR")).env("NO_COLOR", "1").stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

/// An empty folder of a test's own.
pub fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("link-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Asks again and again, for minutes.
#[track_caller]
pub fn eventually<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    for _ in 0..24_000 {
        if let Some(answer) = ask() {
            return answer;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("in vain: {what}");
}

/// Waits until a file has so many bytes: the mission of its journal is then well under way.
#[track_caller]
pub fn grown(path: &Path, bytes: u64) {
    eventually("a journal", || std::fs::metadata(path).ok().filter(|m| m.len() > bytes));
}

/// The far end, and what it says.
pub struct Vehicle {
    pub child: Child,
    pub log: PathBuf,
    /// Where the other end finds it.
    pub link: String,
    rate: [&'static str; 2],
}

impl Vehicle {
    #[track_caller]
    pub fn serve(link: &str, folder: &Path) -> Self {
        Vehicle::serve_world(&format!("{EXCURSION}#bay"), link, folder)
    }

    #[track_caller]
    pub fn serve_world(world: &str, link: &str, folder: &Path) -> Self {
        Vehicle::serve_at(RATE, world, link, folder)
    }

    /// At another rate, at which its missions are run too.
    #[track_caller]
    pub fn serve_at(rate: [&'static str; 2], world: &str, link: &str, folder: &Path) -> Self {
        let log = folder.join("vehicle.log");
        let file = std::fs::File::create(&log).unwrap();
        let mut command = albacore(&["vehicle", world, "--link", link, "--rows", "400x30x50"]);
        let child = command.args(rate).stderr(file).spawn().unwrap();
        let mut vehicle = Vehicle { child, log, link: String::new(), rate };
        vehicle.says("link open at ");
        vehicle.says("leg 1 of 50");
        let said = vehicle.said();
        vehicle.link = said.split("link open at ").nth(1).unwrap().lines().next().unwrap().to_string();
        vehicle
    }

    pub fn said(&self) -> String {
        std::fs::read_to_string(&self.log).unwrap()
    }

    /// Waits until it has said this.
    #[track_caller]
    pub fn says(&self, what: &str) {
        eventually(&format!("{what}, in {}", self.log.display()), || self.said().contains(what).then_some(()));
    }

    pub fn mission(&self, more: &[&str]) -> Command {
        let mut command = albacore(&["run", EXCURSION, "--link", &self.link]);
        command.args(self.rate).args(more);
        command
    }

    /// A mission that does not end by itself, once it drives the vehicle.
    #[track_caller]
    pub fn driven(&self, more: &[&str]) -> Child {
        self.driven_by("stay", more)
    }

    #[track_caller]
    pub fn driven_by(&self, mission: &str, more: &[&str]) -> Child {
        let run = self.mission(&["--mission", mission]).args(more).spawn().unwrap();
        self.says("override taken");
        run
    }

    /// Ctrl-C.
    pub fn stop(mut self) -> (Option<i32>, String) {
        send("-INT", &self.child);
        (self.child.wait().unwrap().code(), self.said())
    }
}

/// A test that fails leaves no vehicle behind.
impl Drop for Vehicle {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
