//! A vehicle at the end of a link: the controller's state machine, a transport, and the host's clock.

mod clocks;

use crate::controller::{Controller, host_ticks};
use crate::error::LinkError;
use crate::transport::Transport;
use crate::url::{Place, Url};
use albacore_geometry::TangentFrame;
use albacore_vehicle::{Command, Control, Measurement, Snapshot, TICK_S, Vehicle, VehicleError};
use clocks::Clocks;
use std::time::Duration;

/// The host's time since any moment. Only the command line may read a clock; a test gives what it likes.
pub type HostClock = Box<dyn FnMut() -> Duration + Send>;

/// How long a look for bytes waits, so that who waits can do something else now and then.
const LOOK: Duration = Duration::from_millis(10);
/// Who has not looked for this long was stopped, or its machine slept: much of what comes then is old.
const PAUSE: Duration = Duration::from_millis(500);
/// After a pause all is there when nothing has come for this long: a terminal gives what waits in parts.
const QUIET: Duration = Duration::from_millis(30);
/// ... and in so many looks at most, because a vehicle at a high rate is never quiet.
const LOOKS_MAX: u32 = 64;
/// After this much of the host's time without a tick of the vehicle's time the link is lost.
const SILENCE: Duration = Duration::from_secs(5);
/// Until the vehicle is heard, it is greeted this often: a datagram has to come from somewhere to be answered.
const HELLO: Duration = Duration::from_secs(1);
/// The vehicle has this long to say that it has taken control back, and twice the round trip, which may not
/// be known in full yet, up to a limit.
const RELEASE: Duration = Duration::from_secs(3);
const RELEASE_TICKS_MAX: u64 = 300;
/// ... and is told again this often.
const RELEASE_AGAIN: Duration = Duration::from_millis(100);

/// A vehicle at the end of a link, whatever it speaks.
pub struct LinkVehicle {
    controller: Controller,
    transport: Box<dyn Transport + Send>,
    clock: HostClock,
    url: Url,
    silence: Duration,
    /// When the last tick of the vehicle's time came.
    ticked: Duration,
    /// When we looked last for what has come.
    looked: Duration,
    /// There was a pause before that, of so long.
    paused: Option<Duration>,
    greeted: Option<Duration>,
    /// When what was heard for the last tick was handed on.
    sensed: Option<Duration>,
    /// When the first tick was taken.
    begun: Option<Duration>,
    rate: f64,
    /// The round trip in the last tick, ticks.
    round_trip: u64,
    clocks: Clocks,
    notices: Vec<String>,
}

impl LinkVehicle {
    /// A vehicle behind a transport, in the frame of a mission. `rate` is how many times faster than real time it runs: one
    /// that runs slower may be silent for longer. An error says which setting of its dialect cannot be.
    pub fn new(
        url: Url,
        transport: Box<dyn Transport + Send>,
        frame: TangentFrame,
        rate: f64,
        mut clock: HostClock,
    ) -> Result<Self, LinkError> {
        let side = (url.dialect.controller)(&url.settings)?;
        let ticked = clock();
        let silence = SILENCE.div_f64(rate.clamp(0.01, 1.0));
        Ok(LinkVehicle {
            controller: Controller::new(side, frame).at_rate(rate),
            transport,
            clock,
            url,
            silence,
            ticked,
            looked: ticked,
            paused: None,
            greeted: None,
            sensed: None,
            begun: None,
            rate,
            round_trip: 0,
            clocks: Clocks::new(rate),
            notices: Vec::new(),
        })
    }

    /// Looks once for bytes; whether any came. Only time in which we listened counts as silence.
    fn look(&mut self, wait: Duration) -> Result<bool, VehicleError> {
        let mut bytes = Vec::new();
        let received = self.transport.receive(&mut bytes, wait);
        let now = (self.clock)();
        let away = now.saturating_sub(self.looked);
        if away >= PAUSE {
            self.paused = Some(away + self.paused.unwrap_or_default());
            self.ticked = (self.ticked + away).min(now);
        }
        self.looked = now;
        self.controller.tell_time(now);
        if let Some(time) = self.paused {
            self.controller.was_away(time);
        }
        self.controller.hear(&bytes);
        received?;
        Ok(!bytes.is_empty())
    }

    /// Takes in all that has come, so that the last word is known before we speak. After a pause what is still on its way
    /// through the system is waited for; the system keeps no more than its room allows, and that is the oldest. So no word is the
    /// last before the next has come.
    fn catch_up(&mut self) -> Result<(), VehicleError> {
        for _ in 0..LOOKS_MAX {
            let wait = if self.paused.is_some() { QUIET } else { Duration::ZERO };
            if !self.look(wait)? && (wait == QUIET || self.paused.is_none()) {
                break;
            }
        }
        if let Some(time) = self.paused.take() {
            self.controller.was_away(time);
        }
        Ok(())
    }

    /// Sends what is to be said. Who was stopped since the last look does not know whether the vehicle still listens: it is not
    /// sent then, and said anew when that is known.
    fn send(&mut self) -> Result<(), VehicleError> {
        let out = self.controller.take_output();
        if out.is_empty() {
            return Ok(());
        }
        if (self.clock)().saturating_sub(self.looked) >= PAUSE {
            self.controller.take_back();
            return Ok(());
        }
        Ok(self.transport.send(&out)?)
    }

    /// What the system said of what we sent last, for whoever looks for the reason of a silence.
    fn trouble(&self) -> String {
        let told = |why| format!("; the system did not send what we said last: {why}");
        self.transport.trouble().map(told).unwrap_or_default()
    }

    /// Why nothing was heard, as far as it can be told from here, and what to look at.
    fn diagnosis(&self) -> VehicleError {
        let (url, count) = (&self.url, self.controller.count());
        let seconds = self.silence.as_secs_f64();
        let baud = match &url.place {
            Place::Serial(_, baud) => format!("that the line runs at {baud} baud, "),
            _ => String::new(),
        };
        let place = match &url.place {
            Place::Udp { .. } => "the address and the port, and that no other controller drives it",
            _ => "the cable and the device",
        };
        let dialect = url.dialect;
        let what = if count.bytes == 0 {
            format!("nothing came from `{url}` in {seconds} s: check that the vehicle is on, {baud}and {place}")
        } else if count.messages == 0 {
            format!(
                "{} bytes came from `{url}` in {} lines, and none of them can be read as `{dialect}`: check {baud}and that \
                 the vehicle speaks `{dialect}`",
                count.bytes, count.unreadable
            )
        } else {
            format!(
                "{} messages came from `{url}`, but no state (`{}`) with a running clock in the last {seconds} s: check that \
                 the vehicle sends it",
                count.messages, dialect.state
            )
        };
        VehicleError(what + &self.trouble())
    }
}

impl Vehicle for LinkVehicle {
    fn measurements(&self) -> &[Measurement] {
        self.controller.measurements()
    }

    fn ready(&mut self) -> Result<bool, VehicleError> {
        // That was told, and a mission that is under way ends of it. One that is not would wait for ever.
        if self.controller.control() == Control::TimedOut {
            return Err(VehicleError(format!("before the mission began: {}", self.controller.why())));
        }
        self.catch_up()?;
        if !self.controller.is_due() {
            self.look(LOOK)?;
            // We may have been stopped while we waited.
            if self.paused.is_some() {
                self.catch_up()?;
            }
        }
        let now = (self.clock)();
        if self.controller.is_due() {
            self.ticked = now;
            return Ok(true);
        }
        if self.controller.control() == Control::Disconnected
            && self.greeted.is_none_or(|last| now.saturating_sub(last) >= HELLO)
        {
            self.greeted = Some(now);
            self.controller.hello();
            self.send()?;
        }
        if now.saturating_sub(self.ticked) < self.silence {
            return Ok(false);
        }
        // Nothing was ever heard of it: what to look at is told. One that was heard is lost, whoever drives.
        if self.controller.control() == Control::Disconnected {
            return Err(self.diagnosis());
        }
        self.controller.lose(format!(
            "no state (`{}`) with a running clock came from `{}` for {} s; a vehicle that hears nothing of us leaves override \
             by itself{}",
            self.url.dialect.state,
            self.url,
            self.silence.as_secs_f64(),
            self.trouble()
        ));
        Ok(true)
    }

    fn sense(&mut self, snapshot: &mut Snapshot) -> Result<(), VehicleError> {
        while !self.ready()? {}
        let now = (self.clock)();
        self.controller.tell_time(now);
        self.controller.sense(snapshot);
        self.round_trip = snapshot.lag.round_trip;
        let begun = *self.begun.get_or_insert(now);
        let host = host_ticks(now.saturating_sub(begun), self.rate);
        snapshot.lag.host = Some(host);
        self.notices.extend(self.clocks.tick(host, self.controller.waiting()));
        let sent = self.send();
        self.sensed = Some((self.clock)());
        sent
    }

    fn take_over(&mut self) -> Result<(), VehicleError> {
        self.controller.take_over();
        self.send()
    }

    fn command(&mut self, command: &Command) -> Result<(), VehicleError> {
        if !command.is_finite() {
            return Err(VehicleError("a command that is no finite number was not sent to the vehicle".into()));
        }
        let now = (self.clock)();
        let computed = now.saturating_sub(self.sensed.unwrap_or(now));
        self.catch_up()?;
        self.controller.tell_computed(computed);
        self.controller.command(command);
        self.send()
    }

    fn give_back(&mut self) -> Result<(), VehicleError> {
        self.controller.give_back();
        self.send()
    }

    /// Waits until the vehicle's status says that it has control, a few seconds at most, on a line that failed too: it may come
    /// back. It leaves override by itself when nothing is heard of us, so that a failure here is told, and no more can be done.
    fn release(&mut self) -> Result<(), VehicleError> {
        let begun = (self.clock)();
        let under_way = TICK_S * (2 * self.round_trip).min(RELEASE_TICKS_MAX) as f64 / self.rate.clamp(0.01, 1.0);
        let patience = RELEASE + Duration::from_secs_f64(under_way);
        let mut asked: Option<Duration> = None;
        loop {
            let now = (self.clock)();
            if asked.is_none_or(|last| now.saturating_sub(last) >= RELEASE_AGAIN) {
                asked = Some(now);
                if self.controller.release() {
                    return Ok(());
                }
            }
            if now.saturating_sub(begun) >= patience {
                let timeout = self.url.dialect.timeout_ticks as f64 * TICK_S;
                return Err(VehicleError(format!(
                    "the vehicle did not say that it has taken control back: it leaves override by itself when nothing is \
                     heard for {timeout} s"
                )));
            }
            if self.send().and_then(|()| self.look(LOOK)).is_err() {
                std::thread::sleep(LOOK);
            }
        }
    }

    fn is_aground(&self) -> bool {
        self.controller.is_aground()
    }

    fn notices(&mut self) -> Vec<String> {
        let mut notices = self.controller.take_notices();
        notices.append(&mut self.notices);
        notices
    }
}
