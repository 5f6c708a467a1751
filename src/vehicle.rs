//! `albacore vehicle`: serves a simulated vehicle at the far end of a link.

use crate::campaign::seeds;
use crate::clock::{self, Pace};
use crate::exit::Exit;
use crate::plan::{Faults, refused, scenario_script, sound};
use crate::speaker::{Speaker, hears_requests, no_thread};
use crate::{interruption, message};
use albacore_session::{FarEnd, Faulty, LinkError, LinkFault, Rows, ServedVehicle, Transport, WrittenUrl};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The longest wait for bytes: who interrupts does not wait longer.
const LOOK: Duration = Duration::from_millis(50);

/// Serve a simulated vehicle at the far end of a link: it swims its own mission until another takes over.
#[derive(clap::Args)]
pub struct Vehicle {
    /// The world: a scenario that every script knows, or one of a script.
    #[arg(value_name = "SCENARIO | SCRIPT.alb[#SCENARIO]")]
    scenario: String,
    /// Where to serve it: `pty:?dialect=recon`, `udp:0.0.0.0:23456?dialect=recon`, `serial:/dev/ttyUSB0?dialect=recon`. `dialect`
    /// may be left out where the vehicle of the scenario says it.
    #[arg(long, value_name = "URL")]
    link: String,
    /// How many times faster than real time; give `run --link` the same.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clock::rate, allow_negative_numbers = true)]
    rate: f64,
    /// The vehicle's own mission: rows from where it starts, along its heading, each to the right of the last [default: the
    /// mission of the scenario, else 200x30x6].
    #[arg(long, value_name = "LENGTHxSPACINGxCOUNT")]
    rows: Option<Rows>,
    /// The seed of all that is random.
    #[arg(long, default_value_t = 1, value_parser = seeds::one, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    faults: Faults,
    /// Inject faults into the link, on each message and both ways: `loss: 5 %, corrupt: 1 %, split: 5 %, repeat: 1 %,
    /// reorder: 1 %, delay: 200 ms`, `loss: 100 %, from: 60 s, to: 65 s`, by the vehicle's time and the seed.
    #[arg(long, value_name = "CLAUSE")]
    link_faults: Vec<String>,
    /// Change a parameter of the script.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

impl Vehicle {
    /// Serves until the person interrupts.
    pub fn run(&self) -> Exit {
        interruption::hear_faults();
        // A terminal that holds who writes must not hold the vehicle.
        let speaker = match Speaker::new() {
            Ok(speaker) => speaker,
            Err(error) => return no_thread(&error),
        };
        if let Err(exit) = hears_requests() {
            return exit;
        }
        let url = match WrittenUrl::parse(&self.link) {
            Ok(url) => url,
            Err(error) => return told(&error, Exit::Usage),
        };
        let vehicle = match self.vehicle() {
            Ok(vehicle) => vehicle,
            Err(exit) => return exit,
        };
        let url = match url.of_vehicle(vehicle.dialect) {
            Ok(url) => url,
            Err(error) => return told(&error, Exit::Usage),
        };
        let mut far_end = match vehicle.far_end(&url, self.seed, self.rows) {
            Ok(far_end) => far_end,
            Err(error) => return refused(&error),
        };
        let faults = match self.link_faults() {
            Ok(faults) => faults,
            Err(exit) => return exit,
        };
        let (transport, at) = match albacore_session::serve(&url) {
            Ok(open) => open,
            Err(error) => return told(&error, Exit::Failed),
        };
        let mut transport = Faulty::new(transport, &url.dialect.framing, faults, self.seed);
        say(&far_end, &format!("link open at {at}"));
        let interrupted = interruption::flag();
        let served = self.serve(&mut far_end, &mut transport, &interrupted);
        if far_end.unreadable() > 0 {
            say(&far_end, &format!("{} lines could not be read", far_end.unreadable()));
        }
        if let Err(error) = &served {
            message::error(&error.message, Some(&error.help));
        }
        let all_said = speaker.end();
        if served.is_ok() && all_said { Exit::Well } else { Exit::Failed }
    }

    /// The vehicle that is served.
    fn vehicle(&self) -> Result<ServedVehicle, Exit> {
        let (script, file, name) = scenario_script(&self.scenario, &self.set)?;
        let refused = |error| refused(&error);
        let vehicle = ServedVehicle::new(&script, file, name).map_err(refused)?;
        vehicle.with_faults(&self.faults.read()?).map_err(refused)
    }

    /// What goes wrong on the link.
    fn link_faults(&self) -> Result<Vec<LinkFault>, Exit> {
        let script = sound(Ok(albacore_session::load_link_faults(&self.link_faults)))?;
        albacore_session::link_faults(&script).map_err(|error| refused(&error))
    }

    /// Ticks at the rate that was asked for, but in real time while a guest that drives is silent: it may only be late, and
    /// the time that it has is the vehicle's.
    fn serve(
        &self,
        far_end: &mut FarEnd,
        transport: &mut Faulty<impl Transport>,
        interrupted: &AtomicBool,
    ) -> Result<(), LinkError> {
        let mut pace = Pace::new(self.rate);
        let mut bytes = Vec::new();
        while !interrupted.load(Ordering::Relaxed) {
            transport.receive(&mut bytes, Duration::ZERO)?;
            let left = pace.left(far_end.waits_for_guest() && bytes.is_empty());
            if left >= Duration::from_millis(1) {
                transport.receive(&mut bytes, left.min(LOOK))?;
                continue;
            }
            // No wait for bytes is this short.
            std::thread::sleep(left);
            pace.begin();
            transport.pass(clock::TICK * far_end.ticks() as u32);
            far_end.tick(&bytes).map_err(|error| LinkError::new(error.to_string(), "report this: it should not be"))?;
            bytes.clear();
            transport.hold(far_end.is_driven());
            transport.send(&far_end.take_output())?;
            for happening in far_end.take_happenings() {
                say(far_end, &happening.to_string());
            }
        }
        Ok(())
    }
}

/// A line with the vehicle's time.
fn say(far_end: &FarEnd, what: &str) {
    message::write(&message::line(&format!("{:8.1} s  {what}", far_end.ticks() as f64 / 10.0)));
}

/// Tells what is wrong with the link.
pub fn told(error: &LinkError, exit: Exit) -> Exit {
    message::error(&error.message, Some(&error.help));
    exit
}
