//! What a piece of work costs, with what else the machine does kept out: in CPU time of this thread, and of rounds of the same work
//! the fastest.

use nix::time::{ClockId, clock_gettime};

/// How often the same work is done.
const ROUNDS: usize = 40;
/// Of the rounds of a stretch this many count, the fastest: others share caches and clock with somebody.
const FASTEST: usize = ROUNDS / 10;

/// One round of a piece of work: the CPU time of each stretch, ns a call. Every round begins with the same state and does the same.
pub type Round<'a> = &'a mut dyn FnMut() -> Vec<f64>;

/// A round of so many stretches of so many calls: so many that reading the clock is little beside them.
pub fn stretches(count: usize, calls: usize, mut call: impl FnMut()) -> Vec<f64> {
    let stretch = |_| {
        let begin = cpu_ns();
        (0..calls).for_each(|_| call());
        (cpu_ns() - begin) / calls as f64
    };
    (0..count).map(stretch).collect()
}

/// What pieces of work cost that take turns, ns a call: of each stretch the mean of its fastest rounds, over all stretches.
pub fn cost<const N: usize>(mut works: [Round; N]) -> [f64; N] {
    let mut rounds = [const { Vec::new() }; N];
    for _ in 0..ROUNDS {
        works.iter_mut().zip(&mut rounds).for_each(|(work, rounds)| rounds.push(work()));
    }
    rounds.map(|rounds: Vec<Vec<f64>>| {
        let count = rounds[0].len();
        let of_stretch = |stretch: usize| {
            let mut times: Vec<f64> = rounds.iter().map(|round| round[stretch]).collect();
            times.sort_by(f64::total_cmp);
            times[..FASTEST].iter().sum::<f64>() / FASTEST as f64
        };
        (0..count).map(of_stretch).sum::<f64>() / count as f64
    })
}

/// The CPU time of this thread, ns.
fn cpu_ns() -> f64 {
    let time = clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).unwrap();
    time.tv_sec() as f64 * 1e9 + time.tv_nsec() as f64
}
