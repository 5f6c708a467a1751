//! Both ends of a link in one process: a vehicle that lives a tick whenever its controller waits for bytes.

use albacore_link::recon::{self, Deframer, FromVehicle, State, ToVehicle};
use albacore_link::{Faulty, LinkError, LinkFault, ServerEvent, Transport};
use albacore_session::FarEnd;
use std::sync::{Arc, Mutex};
use std::time::Duration;

const TICK: Duration = Duration::from_millis(100);

/// A message that the controller sent.
pub struct Sent {
    /// The vehicle's tick.
    pub at: u64,
    /// The mission's tick that was next.
    pub mission_tick: u64,
    /// None where it was no message.
    pub message: Option<ToVehicle>,
}

/// The vehicle, and all that went over the wire at either end of it.
pub struct Desk {
    far_end: FarEnd,
    to_vehicle: Vec<u8>,
    /// The mission's tick that is next.
    pub mission_tick: u64,
    /// What the controller sent.
    pub sent: Vec<Sent>,
    /// What the vehicle said of itself.
    pub states: Vec<State>,
    /// What happened to it.
    pub happenings: Vec<ServerEvent>,
}

impl Desk {
    pub fn new(far_end: FarEnd) -> Self {
        Desk {
            far_end,
            to_vehicle: Vec::new(),
            mission_tick: 0,
            sent: Vec::new(),
            states: Vec::new(),
            happenings: Vec::new(),
        }
    }

    pub fn now(&self) -> Duration {
        TICK * self.far_end.ticks() as u32
    }

    pub fn is_driven(&self) -> bool {
        self.far_end.is_driven()
    }

    fn tick(&mut self) -> Vec<u8> {
        self.far_end.tick(&std::mem::take(&mut self.to_vehicle)).unwrap();
        self.happenings.extend(self.far_end.take_happenings());
        let said = self.far_end.take_output();
        let states = &mut self.states;
        Deframer::default().push(&said, |frame| {
            if let Ok(FromVehicle::State(state)) = FromVehicle::parse(frame.unwrap()) {
                states.push(state);
            }
        });
        said
    }

    fn take_down(&mut self, lines: &[u8]) {
        let (at, mission_tick) = (self.far_end.ticks(), self.mission_tick);
        let sent = &mut self.sent;
        Deframer::default().push(lines, |frame| {
            let message = frame.ok().and_then(|body| ToVehicle::parse(body).ok());
            sent.push(Sent { at, mission_tick, message });
        });
    }
}

/// The vehicle's end of the wire.
struct End(Arc<Mutex<Desk>>);

impl Transport for End {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        // Who does not wait takes what is there; time goes by for who does.
        if !wait.is_zero() {
            into.extend(self.0.lock().unwrap().tick());
        }
        Ok(())
    }

    fn send(&mut self, lines: &[u8]) -> Result<(), LinkError> {
        self.0.lock().unwrap().to_vehicle.extend_from_slice(lines);
        Ok(())
    }
}

/// The controller's end.
#[derive(Clone)]
pub struct Line {
    desk: Arc<Mutex<Desk>>,
    link: Arc<Mutex<Faulty<End>>>,
}

impl Line {
    pub fn new(desk: &Arc<Mutex<Desk>>, faults: Vec<LinkFault>, seed: u64) -> Self {
        let link = Faulty::new(End(Arc::clone(desk)), &recon::DIALECT.framing, faults, seed);
        Line { desk: Arc::clone(desk), link: Arc::new(Mutex::new(link)) }
    }

    /// A tick in which nobody is at this end any more.
    pub fn wait(&self) {
        self.clone().receive(&mut Vec::new(), TICK).unwrap();
    }
}

impl Transport for Line {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        let now = self.desk.lock().unwrap().now();
        let mut link = self.link.lock().unwrap();
        link.pass(now);
        link.receive(into, wait)
    }

    fn send(&mut self, lines: &[u8]) -> Result<(), LinkError> {
        let now = {
            let mut desk = self.desk.lock().unwrap();
            desk.take_down(lines);
            desk.now()
        };
        let mut link = self.link.lock().unwrap();
        link.pass(now);
        link.send(lines)
    }
}
