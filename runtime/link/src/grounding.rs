//! That a vehicle lies on the bottom: one end of a link says so now and then, the other takes it to be so for a while.

/// A vehicle that lies on the bottom says so again after so many ticks: a message may be lost.
pub(crate) const AGAIN_TICKS: u64 = 10;
/// Who has not heard it again for so many ticks takes the vehicle to be free.
const FORGOTTEN_TICKS: u64 = 5 * AGAIN_TICKS;

/// What the controller has heard of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Grounding {
    /// Until which tick the vehicle is taken to lie on the bottom.
    until: Option<u64>,
}

impl Grounding {
    /// The vehicle says in a tick whether it lies on the bottom: whether that is no more than what it said before.
    pub fn hear(&mut self, aground: bool, tick: u64) -> bool {
        let known = aground && self.is_aground(tick);
        self.until = aground.then_some(tick + FORGOTTEN_TICKS);
        known
    }

    /// Whether the vehicle lies on the bottom in a tick.
    pub fn is_aground(&self, tick: u64) -> bool {
        self.until.is_some_and(|until| tick < until)
    }
}
