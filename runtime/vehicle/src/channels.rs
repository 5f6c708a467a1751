//! The channels of the vehicles that we know: simulated ones and those at the end of a link deliver the same, so that a mission
//! runs on either.

use crate::Channel;

/// What is measured, in the order of the channel numbers: name, and how many numbers.
const CHANNELS: [(&str, usize); 13] = [
    ("position", 3),     // m north, m east, standard deviation in m an axis
    ("course", 1),       // rad over ground
    ("heading", 1),      // rad
    ("speed", 1),        // m/s over ground
    ("depth", 1),        // m
    ("altitude", 1),     // m above the bottom
    ("water_depth", 1),  // m
    ("flow", 2),         // m/s toward north and east
    ("chemical", 1),     // ratio of full scale
    ("battery", 1),      // ratio
    ("vehicle_mode", 1), // the place in the library's `enum VehicleMode`
    ("temperature", 1),  // degrees Celsius
    ("salinity", 1),     // practical salinity
];

/// Where the vehicle believes to be.
pub const POSITION: u16 = 0;
/// Its direction over ground.
pub const COURSE: u16 = 1;
/// Where its nose points.
pub const HEADING: u16 = 2;
/// Its speed over ground.
pub const SPEED: u16 = 3;
/// Its depth.
pub const DEPTH: u16 = 4;
/// Its height above the bottom.
pub const ALTITUDE: u16 = 5;
/// The depth of the water.
pub const WATER_DEPTH: u16 = 6;
/// The current.
pub const FLOW: u16 = 7;
/// The chemical sensor.
pub const CHEMICAL: u16 = 8;
/// What is left in the battery.
pub const BATTERY: u16 = 9;
/// What the vehicle's own mission is about.
pub const VEHICLE_MODE: u16 = 10;
/// The temperature of the water, degrees Celsius.
pub const TEMPERATURE: u16 = 11;
/// The practical salinity of the water.
pub const SALINITY: u16 = 12;

/// All of them.
pub fn all() -> Vec<Channel> {
    CHANNELS.iter().map(|&(name, width)| Channel { name: name.to_owned(), width }).collect()
}

/// Those of a vehicle without a CTD. A mission that requires what it does not measure is refused before it begins.
pub fn without_ctd() -> Vec<Channel> {
    let mut channels = all();
    channels.truncate(usize::from(TEMPERATURE));
    channels
}
