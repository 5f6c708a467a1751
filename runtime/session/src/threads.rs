//! The program's threads: each has the stack that it needs, and there are as many for many runs as there are cores, whatever the
//! environment says.

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::num::NonZero;
use std::thread::{Builder, available_parallelism};

/// The stack of a thread, bytes: what the standard library gives. A variable of the environment makes it larger, but not smaller.
const STACK: usize = 2 << 20;

/// A thread by its name, which a debugger shows, to be started.
#[expect(clippy::disallowed_methods, reason = "this is where threads are made")]
pub fn thread(name: &str) -> Builder {
    Builder::new().name(name.to_string()).stack_size(stack())
}

/// So many threads, else one for each core, to share the work of many runs. Fails where the system does not start them.
#[expect(clippy::disallowed_methods, reason = "this is where threads are made")]
pub fn pool(threads: Option<usize>) -> Result<ThreadPool, ThreadPoolBuildError> {
    let threads = threads.unwrap_or_else(|| available_parallelism().map_or(1, NonZero::get));
    ThreadPoolBuilder::new().num_threads(threads).stack_size(stack()).build()
}

fn stack() -> usize {
    let asked = std::env::var("RUST_MIN_STACK").ok().and_then(|bytes| bytes.parse().ok());
    asked.map_or(STACK, |bytes: usize| bytes.max(STACK))
}
