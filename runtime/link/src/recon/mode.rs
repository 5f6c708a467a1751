//! The mode byte of `#S`: what the vehicle is doing, and whether a guest drives.

/// The mode byte. Its two low bits are a number, the [`Phase`]; the others are flags.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mode(pub u8);

/// The life of the vehicle's own mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Before the launch.
    PreLaunch,
    /// In its mission; override can be had.
    InMission,
    /// Its mission is suspended (a fix at the surface, a fault): override commands are ignored.
    Suspended,
    /// Its mission is over.
    Over,
}

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
        let number = match phase {
            Phase::PreLaunch => 0,
            Phase::InMission => 1,
            Phase::Suspended => 2,
            Phase::Over => 3,
        };
        Mode((flags & !0x03) | number)
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
