//! The mode byte of `#S`: what the vehicle is doing, and whether a guest drives.

use crate::status::{Phase, Status};

/// The mode byte. Its two low bits are a number, the [`Phase`]; the others are flags.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mode(pub u8);

impl Mode {
    /// Override is enabled: the controller's wish was heard.
    pub const ENABLED: u8 = 0x04;
    /// Override is active: the controller drives.
    pub const ACTIVE: u8 = 0x08;
    /// After the override the vehicle returns to the closest point of its track, and not to where it left it.
    pub const CLOSEST_POINT: u8 = 0x20;
    /// Override is not allowed now.
    pub const NOT_ALLOWED: u8 = 0x80;

    /// Bits for a phase, and flags.
    pub fn new(phase: Phase, flags: u8) -> Self {
        Mode((flags & !0x03) | phase.number())
    }

    /// The two low bits, read as a number and not as two flags.
    pub fn phase(self) -> Phase {
        match self.0 & 0x03 {
            0 => Phase::PreLaunch,
            1 => Phase::InMission,
            2 => Phase::Suspended,
            _ => Phase::Over,
        }
    }

    /// Whether a flag is set.
    pub fn has(self, flag: u8) -> bool {
        self.0 & flag != 0
    }
}

impl From<Mode> for Status {
    fn from(mode: Mode) -> Self {
        Status {
            phase: mode.phase(),
            is_enabled: mode.has(Mode::ENABLED),
            is_active: mode.has(Mode::ACTIVE),
            is_forbidden: mode.has(Mode::NOT_ALLOWED),
        }
    }
}

impl From<Status> for Mode {
    fn from(status: Status) -> Self {
        let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
        let flags = flag(status.is_enabled, Mode::ENABLED)
            | flag(status.is_active, Mode::ACTIVE)
            | flag(status.is_forbidden, Mode::NOT_ALLOWED);
        Mode::new(status.phase, flags)
    }
}
