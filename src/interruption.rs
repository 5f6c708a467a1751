//! The system's requests to end: Ctrl-C, and every other signal that can be caught and ends a program.

use crate::clock::now;
use signal_hook::consts as signal;
use signal_hook::iterator::Signals;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Builder;
use std::time::Duration;

/// Who asks again sooner than this has not asked twice: a terminal that is closed sends several signals at once.
const AGAIN: Duration = Duration::from_millis(300);

/// What asks a program to end. Those that tell of a fault of its own cannot be survived, and are left out.
#[cfg(unix)]
const REQUESTS: [i32; 13] = [
    signal::SIGINT,
    signal::SIGTERM,
    signal::SIGQUIT,
    signal::SIGHUP,
    signal::SIGUSR1,
    signal::SIGUSR2,
    signal::SIGALRM,
    signal::SIGVTALRM,
    signal::SIGPROF,
    signal::SIGIO,
    signal::SIGABRT,
    signal::SIGXCPU,
    signal::SIGXFSZ,
];
#[cfg(not(unix))]
const REQUESTS: [i32; 2] = [signal::SIGINT, signal::SIGTERM];

/// What the system sends by itself, and again: a limit on time or on a file's size was reached.
#[cfg(unix)]
const LIMITS: [i32; 2] = [signal::SIGXCPU, signal::SIGXFSZ];
#[cfg(not(unix))]
const LIMITS: [i32; 0] = [];

/// A flag that any of them raises. The second ends the program at once, whatever it is about.
pub fn flag() -> Arc<AtomicBool> {
    raised_by(&REQUESTS)
}

/// A flag that Ctrl-C raises alone; whoever raises it lowers it again.
pub fn ctrl_c() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    // Without a handler Ctrl-C ends the program at once; nothing else is lost by its absence.
    let _ = signal_hook::flag::register(signal::SIGINT, Arc::clone(&interrupted));
    interrupted
}

/// A flag that Ctrl-Z raises, which then stops nothing.
#[cfg(unix)]
pub fn ctrl_z() -> Arc<AtomicBool> {
    let asked = Arc::new(AtomicBool::new(false));
    let _ = signal_hook::flag::register(signal::SIGTSTP, Arc::clone(&asked));
    asked
}

/// There is no such thing.
#[cfg(not(unix))]
pub fn ctrl_z() -> Arc<AtomicBool> {
    Arc::new(AtomicBool::new(false))
}

/// The signals that whoever began the program wants it to be deaf to, as `nohup` does: a bit for each.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Whether a request is heard. Ctrl-C and the request to terminate always are: a shell ignores the first for what it begins in
/// the background.
fn is_heard(request: i32, ignored: u64) -> bool {
    matches!(request, signal::SIGINT | signal::SIGTERM) || ignored >> (request - 1) & 1 == 0
}

fn raised_by(requests: &[i32]) -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let ignored = ignored();
    // Without handlers a signal ends the program at once, as it does any other.
    let Ok(mut signals) = Signals::new(requests.iter().filter(|request| is_heard(**request, ignored))) else {
        return interrupted;
    };
    let flag = Arc::clone(&interrupted);
    let handle = signals.handle();
    // This thread waits for signals and for nothing else: it must not write, for a terminal may hold who writes.
    let heard = Builder::new().name("signals".into()).spawn(move || {
        let mut first = None;
        for request in signals.forever() {
            flag.store(true, Ordering::Relaxed);
            let begun = *first.get_or_insert_with(now);
            if now().duration_since(begun) >= AGAIN && !LIMITS.contains(&request) {
                signal_hook::low_level::exit(128 + request);
            }
        }
    });
    if heard.is_err() {
        handle.close();
    }
    interrupted
}
