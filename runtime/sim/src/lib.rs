//! The world of a simulated run: water that flows and meanders, a chemical plume, a bottom, a vehicle and its sensors.
//!
//! A [`Scenario`] states the world in plain numbers, a [`Simulator`] runs it behind the one port of `albacore-vehicle`.
//! Metres, seconds, radians; points in the north/east tangent frame; depths positive down. The same scenario and seed give
//! the same bits in debug and release: every random number is a pure function of seed, stream and index ([`Noise`]).

mod bottom;
mod deepest;
mod fault;
pub mod hull;
mod incidents;
mod noise;
mod normal;
mod plume;
pub mod presets;
pub mod probe;
mod recorded;
mod scenario;
mod sensors;
mod simulated;
mod simulator;
mod start;
mod survey;
mod water;
mod world;

pub use fault::{Fault, FaultKind, Sensor, SensorFault};
pub use noise::{Noise, Stream};
pub use recorded::{Playback, RecordedKernel, RecordedPlume, Recording, RecordingError, RecordingHeader, Still};
pub use scenario::{
    Bottom, Flow, Grid, Ground, HullSetup, KinematicHull, Meander, NoGo, OwnMission, Patch, Pit, Plane, Plume,
    Scenario, ScenarioError, ScenarioIssue, Setting, Source, Stratification, SubmersibleHull, Tide, Times, UpperFlow,
    VehicleSetup, Waves, Why,
};
pub use sensors::{
    Adcp, Battery, Compass, Ctd, Dvl, Fluorometer, Gps, InstrumentSetup, Lbl, Looks, Navigation, Pressure, Sounder,
};
pub use simulator::Simulator;
pub use survey::Survey;
