//! Inputs that are read without a script's asking, by the names that the standard library declares them with: those of the channels
//! that bring them.

use albacore_vehicle::channels;

/// Where the vehicle believes to be.
pub const POSITION: &str = channels::name(channels::POSITION);
/// Its direction over ground.
pub const COURSE: &str = channels::name(channels::COURSE);
/// Where its nose points.
pub const HEADING: &str = channels::name(channels::HEADING);
/// Its depth.
pub const DEPTH: &str = channels::name(channels::DEPTH);
/// Its height above the bottom.
pub const ALTITUDE: &str = channels::name(channels::ALTITUDE);
/// The depth of the water.
pub const WATER_DEPTH: &str = channels::name(channels::WATER_DEPTH);
/// The current.
pub const FLOW: &str = channels::name(channels::FLOW);
/// What is left in the battery.
pub const BATTERY: &str = channels::name(channels::BATTERY);
/// Who drives: told with every snapshot, and by no channel.
pub const CONTROL: &str = "control";
/// What the vehicle's own mission is about.
pub const VEHICLE_MODE: &str = channels::name(channels::VEHICLE_MODE);
