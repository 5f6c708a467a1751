//! Inputs that are read without a script's asking, by the names that the standard library declares them with: those of the measurements
//! that bring them.

use albacore_vehicle::measurements;

/// Where the vehicle believes to be.
pub const POSITION: &str = measurements::name(measurements::POSITION);
/// Its direction over ground.
pub const COURSE: &str = measurements::name(measurements::COURSE);
/// Where its nose points.
pub const HEADING: &str = measurements::name(measurements::HEADING);
/// Its depth.
pub const DEPTH: &str = measurements::name(measurements::DEPTH);
/// Its height above the bottom.
pub const ALTITUDE: &str = measurements::name(measurements::ALTITUDE);
/// The depth of the water.
pub const WATER_DEPTH: &str = measurements::name(measurements::WATER_DEPTH);
/// The current.
pub const FLOW: &str = measurements::name(measurements::FLOW);
/// What is left in the battery.
pub const BATTERY: &str = measurements::name(measurements::BATTERY);
/// Who drives: told with every snapshot, and by no measurement.
pub const CONTROL: &str = "control";
/// How long the mission has lasted: counted by the machine, and told by no measurement.
pub const ELAPSED: &str = "elapsed";
/// Inputs that are there in every tick, whatever the vehicle measures.
pub const ALWAYS_THERE: [&str; 2] = [CONTROL, ELAPSED];
/// What the vehicle's own mission is about.
pub const VEHICLE_MODE: &str = measurements::name(measurements::VEHICLE_MODE);
