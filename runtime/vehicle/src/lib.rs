//! The one port between a mission and the water: what a vehicle senses, what it can be told, who has control.
//!
//! The simulator, a vehicle at the end of a serial line and the replay of a journal are all a [`Vehicle`]. The machine that
//! executes a program sees nothing else of them.

mod command;
mod limits;
pub mod measurements;
mod navigation_errors;
mod quantity;
pub mod rate;
mod truth;

pub use command::{COMMANDED, Command, Commanded, Vertical};
pub use limits::{Beyond, LimitWatch, Limits};
pub use navigation_errors::{NAVIGATION_STATES, NavigationErrors};
pub use quantity::Quantity;
pub use truth::Truth;

use serde::{Deserialize, Serialize};

/// The control period: one tick, in seconds.
pub const TICK_S: f64 = 0.1;

/// How long so many ticks are, s, as near as a number can be: 41 of them are 4.1 s, where `41.0 * TICK_S` is a little more.
pub fn seconds(ticks: u64) -> f64 {
    ticks as f64 / (1.0 / TICK_S)
}

/// A vehicle that does not let drive who asks for so many ticks has refused, whatever it answers.
pub const REQUEST_TICKS: u64 = 300;

/// The numbers of one sample, in SI units; what each means is the measurement's to say.
pub type Reading = [f64; 4];

/// A kind of measurement that a vehicle delivers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measurement {
    /// Its name, which an `input` of the same name reads.
    pub name: String,
    /// How many numbers of a [`Reading`] it uses.
    pub width: usize,
}

/// One measurement, taken since the last tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Index into [`Vehicle::measurements`]; of a sample that is withheld beyond its end.
    pub measurement: u16,
    /// Its numbers; unused ones are zero.
    pub reading: Reading,
}

/// Who drives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Control {
    /// Nothing has been heard of the vehicle.
    #[default]
    Disconnected,
    /// The vehicle drives itself; we listen.
    Monitoring,
    /// The vehicle hands over of its own accord, and waits for us to take it.
    Offered,
    /// We have asked to drive.
    Requesting,
    /// We drive.
    InControl,
    /// We have given the vehicle back, or it has taken itself back.
    Released,
    /// The vehicle would not let us drive.
    Refused,
    /// The vehicle has stopped listening for a while.
    Suspended,
    /// The vehicle did not answer.
    TimedOut,
}

/// How a link lags behind the vehicle, in ticks of the vehicle's time. A simulated vehicle has no link.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lag {
    /// The round trip over the link: beyond their stamps samples are no older than this.
    pub round_trip: u64,
    /// What has passed since tick 0 by the host's clock; none where there is no time but the vehicle's.
    pub host: Option<u64>,
}

/// Marks the measurement of a sample that is not believed: it is kept for whoever reads the journal, and no input takes it.
const WITHHELD: u16 = 0x8000;
/// Marks the measurement of an altitude that may be no echo of the bottom, or of a position that may be elsewhere: inputs take it, and no
/// limit goes by it.
const DOUBTED: u16 = 0x4000;

impl Sample {
    /// The same, not to be believed.
    pub fn withhold(&mut self) {
        self.measurement |= WITHHELD;
    }

    /// The same, and no limit is to go by it.
    pub fn doubt(&mut self) {
        self.measurement |= DOUBTED;
    }

    /// Whether no limit is to go by it.
    pub fn is_doubted(&self) -> bool {
        self.measurement & (WITHHELD | DOUBTED) != 0
    }

    /// The measurement that it came on, believed or not.
    pub fn origin(&self) -> u16 {
        self.measurement & !(WITHHELD | DOUBTED)
    }

    /// The measurement of one that inputs take.
    pub fn input_measurement(&self) -> u16 {
        self.measurement & !DOUBTED
    }

    /// Whether it is of a measurement and not to be believed.
    pub fn is_withheld_of(&self, measurement: u16) -> bool {
        self.measurement == WITHHELD | measurement
    }

    /// Whether it is not to be believed.
    pub fn is_withheld(&self) -> bool {
        self.measurement & WITHHELD != 0
    }
}

/// What became of something that a payload was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answer {
    /// The number of the question.
    pub id: u64,
    /// Its value; none where the payload has refused.
    pub value: Option<bool>,
}

/// All that came from the vehicle in one tick.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// The samples since the last tick, oldest first.
    pub samples: Vec<Sample>,
    /// Who drives now.
    pub control: Control,
    /// How far behind that is.
    pub lag: Lag,
    /// Whether the vehicle lies on the bottom, and says so.
    pub aground: bool,
    /// What its payload has answered since the last tick.
    pub answers: Vec<Answer>,
}

impl Snapshot {
    /// Adds a sample; numbers beyond the fourth are not carried.
    #[inline]
    pub fn push(&mut self, measurement: u16, numbers: &[f64]) {
        let mut reading = Reading::default();
        match numbers {
            // Most are one number, which is copied sooner than a copy of any length is called.
            [number] => reading[0] = *number,
            _ => reading.iter_mut().zip(numbers).for_each(|(slot, number)| *slot = *number),
        }
        self.samples.push(Sample { measurement, reading });
    }
}

/// Why a vehicle can no longer be driven.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct VehicleError(pub String);

/// A vehicle, real or simulated, in steps of one tick.
pub trait Vehicle {
    /// What it measures, in a fixed order.
    fn measurements(&self) -> &[Measurement];

    /// Whether the next tick has come. A simulated one always has; a vehicle that lives in time of its own may wait here for
    /// some hundredths of a second, and is asked again.
    fn ready(&mut self) -> Result<bool, VehicleError> {
        Ok(true)
    }

    /// Lets one tick go by and gives what was sensed in it. The first call gives the state at tick 0.
    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError>;

    /// Asks for control; [`Snapshot::control`] tells how that went. A guest may do so again after it has given
    /// control back.
    fn take_over(&mut self) -> Result<(), VehicleError>;

    /// Gives a command, in force until the next.
    fn command(&mut self, command: &Command) -> Result<(), VehicleError>;

    /// Asks its payload for an action, such as `camera.start`, by a number: [`Snapshot::answers`] tells what became of it. One that carries no
    /// such questions never answers.
    fn ask(&mut self, _id: u64, _action: &str) -> Result<(), VehicleError> {
        Ok(())
    }

    /// An override has ended: the vehicle is to drive itself again, and we listen on. It may be asked again.
    fn give_back(&mut self) -> Result<(), VehicleError>;

    /// Gives control back. Always the last act of a mission.
    fn release(&mut self) -> Result<(), VehicleError>;

    /// Whether it lies on the bottom by its last word, which may have come after the last tick. A simulated one says all in its ticks.
    fn is_aground(&self) -> bool {
        false
    }

    /// Its own limits, its hull's speed among them.
    fn limits(&self) -> Limits {
        Limits::default()
    }

    /// What of a command is beyond its own limits, by all that it knows of itself and of the water.
    fn clamp_command(&self, asked: &Command, report: &mut dyn FnMut(Beyond)) {
        self.limits().clamp_command(asked, None, report);
    }

    /// What it does now: the command that it follows, as far as its own limits let it, whoever gave it. None when it follows
    /// none, or cannot tell.
    fn held(&self) -> Option<Command> {
        None
    }

    /// What a person should hear of the link since they were last told. No mission can read it.
    fn notices(&mut self) -> Vec<String> {
        Vec::new()
    }
}
