//! Whether we have asked a vehicle to let us drive: as a machine wishes, and no longer.

use albacore_machine::{ControlRequest, Machine};
use albacore_vehicle::{Vehicle, VehicleError};

/// Whether the vehicle has been asked to let us drive, and not been given back since.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControlClaim {
    is_asked: bool,
}

impl ControlClaim {
    /// Whether control was asked for, and not given back since.
    pub fn is_asked(self) -> bool {
        self.is_asked
    }

    /// Asks for control when a mission wants it, and gives it back when a guest's override has ended. At the end of a mission nothing changes.
    pub fn follow(&mut self, machine: &Machine, vehicle: &mut dyn Vehicle) -> Result<(), VehicleError> {
        let wants = machine.wish() != ControlRequest::Listen;
        if wants == self.is_asked || machine.outcome().is_some() {
            return Ok(());
        }
        self.is_asked = wants;
        if wants { vehicle.take_over() } else { vehicle.give_back() }
    }

    /// One override follows another in the same tick, and the vehicle has left the first or has not answered it: it is asked again.
    pub fn ask_anew(&mut self, machine: &Machine, vehicle: &mut dyn Vehicle) -> Result<(), VehicleError> {
        if machine.asks_anew() { self.give_back(vehicle) } else { Ok(()) }
    }

    /// Gives control back, and listens on.
    pub fn give_back(&mut self, vehicle: &mut dyn Vehicle) -> Result<(), VehicleError> {
        if std::mem::take(&mut self.is_asked) { vehicle.give_back() } else { Ok(()) }
    }
}
