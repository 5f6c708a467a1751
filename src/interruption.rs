//! The system's requests to end: Ctrl-C, and every other signal that can be caught and ends a program.

use crate::clock::now;
use albacore_session::threads::thread;
use signal_hook::consts as signal;
use signal_hook::iterator::Signals;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError, mpsc};
use std::time::Duration;

/// Who asks again sooner than this has not asked twice: a terminal that is closed sends several signals at once.
const AGAIN: Duration = Duration::from_millis(300);

/// Signals that end no program by themselves, that only stop one, that a library of the system keeps for
/// itself, or that the system itself sends for an error of the disk ([`hear_faults`] hears who else sends it).
#[cfg(target_os = "linux")]
const OTHERS: [i32; 12] = [
    signal::SIGPIPE,
    signal::SIGCHLD,
    signal::SIGCONT,
    signal::SIGSTOP,
    signal::SIGTSTP,
    signal::SIGTTIN,
    signal::SIGTTOU,
    signal::SIGURG,
    signal::SIGWINCH,
    signal::SIGXFSZ,
    32,
    33,
];
/// Those that cannot be caught, and those that tell of a fault of the program's own: a handler would return to it at once
/// ([`hear_faults`]).
#[cfg(target_os = "linux")]
const FATAL: [i32; 5] = [signal::SIGKILL, signal::SIGILL, signal::SIGFPE, signal::SIGSEGV, signal::SIGBUS];
/// The last of those that have no name.
#[cfg(target_os = "linux")]
const LAST: i32 = 64;

/// What asks a program to end: every signal that ends one and can be caught.
#[cfg(target_os = "linux")]
fn requests() -> impl Iterator<Item = i32> {
    (1..=LAST).filter(|request| !OTHERS.contains(request) && !FATAL.contains(request))
}
#[cfg(all(unix, not(target_os = "linux")))]
fn requests() -> impl Iterator<Item = i32> {
    use signal::*;
    let ends =
        [SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGABRT, SIGTRAP, SIGSYS];
    ends.into_iter().chain(LIMITS)
}
#[cfg(not(unix))]
fn requests() -> impl Iterator<Item = i32> {
    [signal::SIGINT, signal::SIGTERM].into_iter()
}

/// What the system sends by itself, and again: a limit on time was reached.
#[cfg(unix)]
const LIMITS: [i32; 1] = [signal::SIGXCPU];
#[cfg(not(unix))]
const LIMITS: [i32; 0] = [];

/// What was asked of the program, and what it is about. There is one program, and so one of these.
#[derive(Default)]
struct Heard {
    /// The first request, and when it came.
    first: Option<(i32, Duration)>,
    /// Whether somebody looks at the flag, and ends in good order.
    is_looked_at: bool,
    /// So many files are in the making, and would be left behind.
    in_the_making: usize,
}

static HEARD: LazyLock<Mutex<Heard>> = LazyLock::new(Mutex::default);
static RAISED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

fn heard() -> MutexGuard<'static, Heard> {
    HEARD.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Heard {
    /// The request that nobody else sees to.
    fn left_alone(&self) -> Option<i32> {
        let waits = self.is_looked_at || self.in_the_making > 0;
        self.first.filter(|_| !waits).map(|(request, _)| request)
    }
}

/// A flag that any of them raises. A second ends the program at once, whatever it is about: one that comes 0.3 s after the first or
/// later, and is none that the system sends by itself.
pub fn flag() -> Arc<AtomicBool> {
    heard().is_looked_at = true;
    let _ = listen();
    Arc::clone(&RAISED)
}

/// The work is done, and only its result is to be shown: who does not want to see it ends the program with the first request. One
/// that came before is being seen to.
pub fn nobody_looks() {
    let mut heard = heard();
    heard.is_looked_at &= heard.first.is_some();
}

/// While it lives, a temporary file is in the making: a request to end waits for it, and then does what it does without us, unless
/// somebody looks at the flag.
pub struct Held(());

/// Begins to hold.
pub fn held() -> Held {
    heard().in_the_making += 1;
    let _ = listen();
    Held(())
}

impl Drop for Held {
    fn drop(&mut self) {
        let mut heard = heard();
        heard.in_the_making -= 1;
        if let Some(request) = heard.left_alone() {
            end(request);
        }
    }
}

/// Lets every signal come, whatever the program that began this one has blocked, and lets Ctrl-C and the request to terminate end it
/// where they were ignored: call it first of all. Any other that nobody wants to come is ignored, as by `nohup`, not blocked.
#[cfg(unix)]
pub fn unblock() {
    let ignored = ignored();
    for (request, ends) in ALWAYS_HEARD.into_iter().zip(ENDS.iter()) {
        if ignored >> (request - 1) & 1 == 1 {
            let _ = signal_hook::flag::register_conditional_default(request, Arc::clone(ends));
        }
    }
    let _ = nix::sys::signal::SigSet::all().thread_unblock();
}

/// There is no such thing.
#[cfg(not(unix))]
pub fn unblock() {}

/// What no program is deaf to: a shell ignores the first for what it begins in the background.
const ALWAYS_HEARD: [i32; 2] = [signal::SIGINT, signal::SIGTERM];

/// Whether each of them, if it was ignored, ends the program at once: as long as nobody else hears it.
static ENDS: LazyLock<[Arc<AtomicBool>; 2]> = LazyLock::new(|| [(); 2].map(|()| Arc::new(AtomicBool::new(true))));

/// A file that has reached a limit of size is an error of the disk, and no request: the program does not end of it.
#[cfg(unix)]
pub fn survive_file_limits() {
    // Without a handler the limit ends the program at once, as it ends any other.
    if is_heard(signal::SIGXFSZ, ignored()) {
        let _ = signal_hook::flag::register(signal::SIGXFSZ, Arc::default());
    }
}

/// There is no such thing.
#[cfg(not(unix))]
pub fn survive_file_limits() {}

/// Whether Ctrl-C means something else than the end of the program.
static CTRL_C_IS_TAKEN: AtomicBool = AtomicBool::new(false);

/// The same flag, which every request to end raises too: what is done is stopped by either.
pub fn ctrl_c_and_requests() -> Arc<AtomicBool> {
    let interrupted = ctrl_c();
    let ignored = ignored();
    for request in requests().filter(|request| *request != signal::SIGINT && is_heard(*request, ignored)) {
        let _ = signal_hook::flag::register(request, Arc::clone(&interrupted));
    }
    interrupted
}

/// A flag that Ctrl-C raises alone; whoever raises it lowers it again.
pub fn ctrl_c() -> Arc<AtomicBool> {
    CTRL_C_IS_TAKEN.store(true, Ordering::Relaxed);
    let interrupted = Arc::new(AtomicBool::new(false));
    // Without a handler Ctrl-C ends the program at once; nothing else is lost by its absence.
    if signal_hook::flag::register(signal::SIGINT, Arc::clone(&interrupted)).is_ok() {
        ENDS[0].store(false, Ordering::Relaxed);
    }
    interrupted
}

/// A flag that Ctrl-Z raises, which then stops nothing. Nor does a terminal that lets nobody write from the background (`stty
/// tostop`): call it before the threads begin that write.
#[cfg(unix)]
pub fn ctrl_z() -> Arc<AtomicBool> {
    use nix::sys::signal::{SigSet, Signal};
    let (asked, by_terminal) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
    let _ = signal_hook::flag::register(signal::SIGTSTP, Arc::clone(&asked));
    let mut of_terminal = SigSet::empty();
    for request in [Signal::SIGTTIN, Signal::SIGTTOU] {
        // Whoever sends it stops nothing, and who blocks it may write.
        let _ = signal_hook::flag::register(request as i32, Arc::clone(&by_terminal));
        of_terminal.add(request);
    }
    let _ = of_terminal.thread_block();
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

/// Whether a request is heard.
fn is_heard(request: i32, ignored: u64) -> bool {
    ALWAYS_HEARD.contains(&request) || ignored >> (request - 1) & 1 == 0
}

/// Hears requests from now on; why not, where the system has no thread or no file for it. Who drives a vehicle may not be deaf.
pub fn hears() -> Result<(), &'static str> {
    listen().as_ref().copied().map_err(String::as_str)
}

/// Hears requests from now on, in a thread that waits for them and does nothing else: it must not write, for a terminal may hold
/// who writes.
fn listen() -> &'static Result<(), String> {
    static LISTENING: OnceLock<Result<(), String>> = OnceLock::new();
    LISTENING.get_or_init(|| {
        // No handler is there before who waits for it: without handlers a signal ends the program at once, as it does any other.
        let (give, given) = mpsc::sync_channel::<Signals>(1);
        let waiting = thread("signals").spawn(move || {
            given.into_iter().for_each(|mut signals| signals.forever().for_each(hear));
        });
        waiting.map_err(|error| error.to_string())?;
        let signals = Signals::new([0; 0]).map_err(|error| error.to_string())?;
        let (handle, ignored) = (signals.handle(), ignored());
        // One that the system does not have is none.
        requests().filter(|request| is_heard(*request, ignored)).for_each(|request| _ = handle.add_signal(request));
        ENDS.iter().for_each(|ends| ends.store(false, Ordering::Relaxed));
        let _ = give.send(signals);
        Ok(())
    })
}

/// A request has come.
fn hear(request: i32) {
    if request == signal::SIGINT && CTRL_C_IS_TAKEN.load(Ordering::Relaxed) {
        return;
    }
    RAISED.store(true, Ordering::Relaxed);
    let mut heard = heard();
    let (_, begun) = *heard.first.get_or_insert_with(|| (request, now()));
    let is_second = now().saturating_sub(begun) >= AGAIN && !LIMITS.contains(&request);
    if is_second || heard.left_alone().is_some() {
        end(request);
    }
}

/// Hears what tells of a fault of the program's own, where somebody else sends it: call it before any other thread begins. No handler
/// may return from a fault; but one that is blocked waits for who asks for it when it was sent, and ends the program as ever when it is met.
/// What is lost is the word of an overflown stack. So with the limit of a file's size: the system tells it to the thread that writes,
/// where it stays blocked, and everybody else tells the program.
#[cfg(unix)]
pub fn hear_faults() {
    use nix::sys::signal::{SigSet, Signal};
    let mut faults = SigSet::empty();
    [Signal::SIGILL, Signal::SIGFPE, Signal::SIGSEGV, Signal::SIGBUS].into_iter().for_each(|fault| faults.add(fault));
    // Elsewhere the system may tell it to the program.
    if cfg!(target_os = "linux") && is_heard(signal::SIGXFSZ, ignored()) {
        faults.add(Signal::SIGXFSZ);
    }
    if faults.thread_block().is_err() {
        return;
    }
    let hearing = thread("faults").spawn(move || {
        while let Ok(fault) = faults.wait() {
            hear(fault as i32);
        }
    });
    if hearing.is_err() {
        let _ = faults.thread_unblock();
    }
}

/// There is no such thing.
#[cfg(not(unix))]
pub fn hear_faults() {}

/// Ends the program as a signal does that nobody hears.
fn end(request: i32) {
    let _ = signal_hook::low_level::emulate_default_handler(request);
    signal_hook::low_level::exit(128 + request);
}
