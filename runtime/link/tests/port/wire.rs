//! A wire with a clock of the test's own, a vehicle at its other end, and a controller that can be stopped in the middle of a word.

use albacore_link::{
    ControllerMessage, ControllerSide, Dialect, Framing, LinkError, Received, Server, SetPoint, Settings, Transport,
    recon,
};
use albacore_sim::Simulator;
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

/// What the test and the vehicle's driver both hold.
#[derive(Default)]
pub struct Shared<T>(Mutex<T>);

impl<T: Default> Shared<T> {
    pub fn borrow(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap()
    }

    pub fn set(&self, value: T) {
        *self.borrow() = value;
    }

    pub fn take(&self) -> T {
        std::mem::take(&mut self.borrow())
    }
}

impl<T: Copy + Default> Shared<T> {
    pub fn get(&self) -> T {
        *self.borrow()
    }
}

/// How the wire is, and what went over it.
#[derive(Default)]
pub struct Wire {
    pub now: Shared<Duration>,
    pub silent: Shared<bool>,
    pub deaf: Shared<bool>,
    /// In so many looks the line is gone.
    pub cut: Shared<u32>,
    /// The bytes for which there is room in the system: what comes then is lost. 0: as many as come.
    pub room: Shared<usize>,
    /// So long what the vehicle says is on its way.
    pub delay: Shared<Duration>,
    /// So long the host is stopped while it says something next.
    pub stop: Shared<Duration>,
    pub sent: Shared<String>,
}

/// The most that one look gives, as a terminal does: some states.
pub const LOOK_BYTES: usize = 1000;
/// A tick of the vehicle.
pub const TICK: Duration = Duration::from_millis(100);

/// A wire with a vehicle at its other end, whose time is that of who looks, and goes on while nobody does.
pub struct Desk {
    pub wire: Arc<Wire>,
    pub far_end: Server<Simulator>,
    pub to_vehicle: Vec<u8>,
    pub under_way: VecDeque<(Duration, Vec<u8>)>,
    pub from_vehicle: VecDeque<u8>,
    pub ticked: Duration,
}

impl Desk {
    pub fn live(&mut self) {
        while self.ticked + TICK <= self.wire.now.get() {
            self.ticked += TICK;
            self.far_end.tick(&std::mem::take(&mut self.to_vehicle)).unwrap();
            self.under_way.push_back((self.ticked + self.wire.delay.get(), self.far_end.take_output()));
            if self.under_way.front().is_some_and(|(due, _)| *due > self.ticked) {
                continue;
            }
            let Some((_, said)) = self.under_way.pop_front() else { continue };
            let room = self.wire.room.get();
            if !self.wire.silent.get() && (room == 0 || self.from_vehicle.len() + said.len() <= room) {
                self.from_vehicle.extend(said);
            }
        }
    }
}

impl Transport for Desk {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        if self.wire.cut.get() > 0 {
            self.wire.cut.set(self.wire.cut.get() - 1);
            return Err(LinkError::new("the line is gone", "plug it in"));
        }
        self.live();
        if self.from_vehicle.is_empty() {
            self.wire.now.set(self.wire.now.get() + wait);
            self.live();
        }
        let most = self.from_vehicle.len().min(LOOK_BYTES);
        into.extend(self.from_vehicle.drain(..most));
        Ok(())
    }

    fn send(&mut self, lines: &[u8]) -> Result<(), LinkError> {
        self.wire.sent.borrow().push_str(&String::from_utf8_lossy(lines));
        if !self.wire.deaf.get() {
            self.to_vehicle.extend_from_slice(lines);
        }
        Ok(())
    }
}

/// A dialect whose controller can be stopped between what it has heard and what it says.
pub static STOPPING: Dialect =
    Dialect { controller: stopping, framing: Framing { ..recon::DIALECT.framing }, ..recon::DIALECT };

thread_local! {
    pub static STOPPED: RefCell<Arc<Wire>> = RefCell::default();
}

pub struct Stopping(Box<dyn ControllerSide>, Arc<Wire>);

pub fn stopping(settings: &Settings) -> Result<Box<dyn ControllerSide>, LinkError> {
    let wire = STOPPED.with_borrow(Arc::clone);
    Ok(Box::new(Stopping((recon::DIALECT.controller)(settings)?, wire)))
}

impl ControllerSide for Stopping {
    fn dialect(&self) -> &'static Dialect {
        &STOPPING
    }

    fn can_tell(&self, measurement: u16) -> bool {
        self.0.can_tell(measurement)
    }

    fn hear(&mut self, bytes: &[u8], received: &mut Received) {
        self.0.hear(bytes, received);
    }

    fn say(&mut self, what: &ControllerMessage, out: &mut Vec<u8>) {
        self.0.say(what, out);
        self.1.now.set(self.1.now.get() + self.1.stop.take());
    }

    fn text(&self, set_point: SetPoint) -> String {
        self.0.text(set_point)
    }
}
