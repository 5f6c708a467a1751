//! What a seed does to a link, and to the controller.

use albacore_link::LinkFault;
use std::fmt;
use std::time::Duration;

const MISSIONS: [&str; 3] = ["sweep", "there_and_back", "guest"];

/// What becomes of the controller.
#[derive(Clone, Copy, Debug)]
pub enum Fate {
    /// It runs to its end.
    Runs,
    /// Somebody interrupts it, after so many steps.
    Interrupted(usize),
    /// It dies, after so many steps.
    Killed(usize),
}

/// An attack.
pub struct Weather {
    pub mission: &'static str,
    pub faults: Vec<LinkFault>,
    pub fate: Fate,
}

impl Weather {
    pub fn of(seed: u64) -> Self {
        let mut random = Random(seed ^ 0x5EA5_0F7E);
        let mut faults = vec![steady(&mut random)];
        for _ in 0..random.below(4) {
            faults.push(passing(&mut random));
        }
        let fate = match random.below(8) {
            0 => Fate::Interrupted(random.below(900) as usize),
            1 => Fate::Killed(random.below(900) as usize),
            _ => Fate::Runs,
        };
        Weather { mission: MISSIONS[random.below(3) as usize], faults, fate }
    }
}

/// All the while: half of the faults, each weak, medium or strong.
fn steady(random: &mut Random) -> LinkFault {
    let mut share = || if random.below(2) == 0 { 0.0 } else { [0.01, 0.05, 0.2][random.below(3) as usize] };
    let [loss, corrupt, split, repeat, reorder] = std::array::from_fn(|_| share());
    let delay = if random.below(2) == 0 { 0 } else { [100, 300, 1000, 3000][random.below(4) as usize] };
    LinkFault { loss, corrupt, split, repeat, reorder, delay: Duration::from_millis(delay), ..LinkFault::default() }
}

/// For a while: a cut, a storm, or a wire that is slow.
fn passing(random: &mut Random) -> LinkFault {
    let from = Duration::from_millis(random.below(80_000));
    let longest = [2_000, 6_000, 15_000][random.below(3) as usize];
    let to = Some(from + Duration::from_millis(200 + random.below(longest)));
    let fault = LinkFault { from, to, ..LinkFault::default() };
    match random.below(4) {
        0 => LinkFault { corrupt: 0.9, ..fault },
        1 => LinkFault { delay: Duration::from_millis(100 + random.below(4_000)), ..fault },
        _ => LinkFault { loss: 1.0, ..fault },
    }
}

impl fmt::Display for Weather {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {:?}", self.mission, self.fate)?;
        for LinkFault { loss, corrupt, split, repeat, reorder, delay, from, to } in &self.faults {
            write!(f, "; loss: {loss}, corrupt: {corrupt}, split: {split}, repeat: {repeat}, reorder: {reorder}, ")?;
            write!(f, "delay: {delay:?}, from: {from:?}, to: {to:?}")?;
        }
        Ok(())
    }
}

/// A linear congruential generator (Knuth's MMIX), of which the upper bits are taken.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
}
