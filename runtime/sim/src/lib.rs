//! The world of a simulated run: water that flows and meanders, a chemical plume, a bottom, a vehicle and its sensors.
//!
//! A [`Scenario`] states the world in plain numbers, a [`Simulator`] runs it behind the one port of `albacore-vehicle`.
//! Metres, seconds, radians; points in the north/east tangent frame; depths positive down. The same scenario and seed give
//! the same bits in debug and release: every random number is a pure function of seed, stream and index ([`Noise`]).

mod craft;
mod noise;
mod normal;
pub mod probe;
mod scenario;
mod simulator;
mod world;

pub use craft::fault::{Fault, FaultKind, Sensor, SensorFault};
pub use craft::hull;
pub use craft::payload::Payload;
pub use craft::sensors::{
    Adcp, AttitudeSensor, Battery, Compass, Ctd, Dvl, Fluorometer, Gps, Imu, InstrumentSetting, InstrumentSetup,
    InvertedUsbl, Lbl, Looks, Navigation, Played, PlayedSample, Pressure, Sounder, Usbl,
};
pub use craft::setup::{HullSetup, KinematicHull, OwnMission, SubmersibleHull, VehicleSetup};
pub use noise::{Noise, Stream};
pub use scenario::{IssueCause, Scenario, ScenarioError, ScenarioIssue, Setting};
pub use simulator::Simulator;
pub use world::beacon::Beacon;
pub use world::bottom::{Bottom, Grid, Ground, NoGo, Pit, Plane};
pub use world::front::Front;
pub use world::plume::{Patch, Plume, Source, Times};
pub use world::recorded::{Playback, RecordedPlume, Still};
pub use world::spill::{Outline, Slick, Spill};
pub use world::stratification::Stratification;
pub use world::survey::Survey;
pub use world::transponder::Transponder;
pub use world::water::{Flow, Meander, Tide, UpperFlow, Waves};
pub use world::{Environment, EnvironmentSetting, World};
