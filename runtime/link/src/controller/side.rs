//! What a dialect does for a controller: it reads what a vehicle says, and writes what is said to it.

use super::Received;
use crate::dialect::Dialect;
use crate::set_point::SetPoint;
use albacore_vehicle::Command;

/// The controller's side of a dialect: a function of bytes, without a clock and without a view of who drives.
pub trait ControllerSide: Send {
    /// The dialect that it is of.
    fn dialect(&self) -> &'static Dialect;

    /// Whether there is a message that tells a measurement.
    fn can_tell(&self, measurement: u16) -> bool;

    /// Takes in bytes, however they were cut on their way, and gives `received` what they say, in the order in which it came.
    fn hear(&mut self, bytes: &[u8], received: &mut Received);

    /// Adds the messages to `out` that say something to the vehicle.
    fn say(&mut self, what: &ControllerMessage, out: &mut Vec<u8>);

    /// A set-point as it stands on the wire, for people. Those with the same text are the same to the vehicle.
    fn text(&self, set_point: SetPoint) -> String;
}

/// What is said to a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControllerMessage {
    /// We want to drive: said again until its status shows that we do.
    TakeOver,
    /// It is to drive itself: said again until its status shows that it does.
    GiveBack,
    /// We are here: said while nothing is commanded, and until the vehicle is heard for the first time.
    KeepAlive,
    /// It has let us drive: what has to be said before the first set-point.
    Begin,
    /// A set-point that is new, was not taken up, or is half a second old; and the command that it is of, for messages that say
    /// all of one.
    SetPoint(SetPoint, Command),
}
