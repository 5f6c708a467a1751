//! What a vehicle says of its own mission, and of who drives it.

/// What a vehicle says of who drives, in one state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Status {
    /// The life of its own mission.
    pub phase: Phase,
    /// It has heard that a guest wants to drive.
    pub is_enabled: bool,
    /// A guest drives, or may.
    pub is_active: bool,
    /// It lets nobody drive now.
    pub is_forbidden: bool,
}

/// The life of the vehicle's own mission.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Phase {
    /// Before the launch.
    #[default]
    PreLaunch,
    /// In its mission; a guest may drive.
    InMission,
    /// Its mission is suspended (a fix at the surface, a fault): nobody is listened to.
    Suspended,
    /// Its mission is over.
    Over,
}

impl Phase {
    /// Its place in the library's `enum VehicleMode`.
    pub fn number(self) -> u8 {
        match self {
            Phase::PreLaunch => 0,
            Phase::InMission => 1,
            Phase::Suspended => 2,
            Phase::Over => 3,
        }
    }
}

impl Status {
    /// Whether a vehicle that says this does what its guest asks.
    pub(crate) fn is_driven(self) -> bool {
        self.phase == Phase::InMission && self.is_active && !self.is_forbidden
    }

    /// Whether it has suspended its mission, and whoever drives it.
    pub(crate) fn is_suspended(self) -> bool {
        self.phase == Phase::Suspended || self.is_forbidden && self.phase != Phase::Over
    }

    /// Whether it is driven by nobody.
    pub(crate) fn is_left(self) -> bool {
        !(self.is_suspended() || self.is_active && self.phase == Phase::InMission)
    }

    /// Whether it has no guest, and knows of none.
    pub(crate) fn is_free(self) -> bool {
        !self.is_active && !self.is_enabled
    }
}
