//! That a vehicle lies on the bottom: the dialect's state has no flag for it, so errors of our own numbers say it.

use super::message::FromVehicle;

const AGROUND: u32 = 4;
const FREE_AGAIN: u32 = 5;
const AGROUND_TEXT: &str = "aground";
const FREE_AGAIN_TEXT: &str = "free of the bottom again";
/// A vehicle that lies on the bottom says so again after so many ticks: a line may be lost.
pub(super) const AGAIN_TICKS: u64 = 10;
/// Who has not heard it again for so many ticks takes the vehicle to be free.
const FORGOTTEN_TICKS: u64 = 5 * AGAIN_TICKS;

/// How a vehicle says that it has run aground, or has come free.
pub(super) fn told(aground: bool) -> FromVehicle {
    let (code, text) = if aground { (AGROUND, AGROUND_TEXT) } else { (FREE_AGAIN, FREE_AGAIN_TEXT) };
    FromVehicle::Error(code, text.to_string())
}

/// What the controller has heard of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Grounding {
    /// Until which tick the vehicle is taken to lie on the bottom.
    until: Option<u64>,
}

impl Grounding {
    /// An error was heard in a tick: whether it is no more than what was said before.
    pub fn hear(&mut self, code: u32, text: &str, tick: u64) -> bool {
        match (code, text) {
            (AGROUND, AGROUND_TEXT) => {
                let known = self.is_aground(tick);
                self.until = Some(tick + FORGOTTEN_TICKS);
                known
            }
            (FREE_AGAIN, FREE_AGAIN_TEXT) => {
                self.until = None;
                false
            }
            _ => false,
        }
    }

    /// Whether the vehicle lies on the bottom in a tick.
    pub fn is_aground(&self, tick: u64) -> bool {
        self.until.is_some_and(|until| tick < until)
    }
}
