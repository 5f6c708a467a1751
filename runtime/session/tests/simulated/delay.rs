//! A run over a link on which every byte is under way for a while: no operating system, no clock of the wall's. The vehicle is
//! driven to and fro at 2 m/s, and tells at its own end where it was.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

use albacore_geometry::{Heading, Point};
use albacore_link::{LinkError, LinkVehicle, Route, Server, Transport, Url, recon};
use albacore_session::{Outcome, Plan, Rows, Run, Source, load_text};
use albacore_sim::{Scenario, Simulator, VehicleSetup};
use albacore_vehicle::Vertical;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The half of the area's side, m.
const HALF: f64 = 60.0;
const BOX: &str = "
mission there_and_back within 20 min {
    area op = rectangle(center: 36°10.8'N 75°44.4'W, along: 0 deg, length: 120 m, width: 120 m)
    limits { speed <= 2 m/s }
    requires { position, heading, depth fresh 15 s, else abort }
    recovery within 1 min { steer north for 1 s }
    with depth 4 m, speed 2 m/s
    for leg in 1..3 {
        goto point(north: 50 m, east: 0 m), radius: 5 m
        goto point(north: -50 m, east: 0 m), radius: 5 m
    }
}
";

/// How a vehicle and its wire are, and how far the vehicle has been from the middle, north or east, m.
struct Desk {
    vehicle: Server<Simulator>,
    there: VecDeque<Vec<u8>>,
    back: VecDeque<Vec<u8>>,
    sent: Vec<u8>,
    come: Vec<u8>,
    seen: Arc<Mutex<Seen>>,
    /// The host's time in a tick of the vehicle's, and when the last was.
    period: Duration,
    ticked: Duration,
}

#[derive(Default)]
struct Seen {
    now: Duration,
    farthest: f64,
}

impl Transport for Desk {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        let mut seen = self.seen.lock().unwrap();
        seen.now += wait;
        while self.ticked + self.period <= seen.now {
            self.ticked += self.period;
            self.there.push_back(std::mem::take(&mut self.sent));
            self.vehicle.tick(&self.there.pop_front().unwrap_or_default()).unwrap();
            self.back.push_back(self.vehicle.take_output());
            self.come.extend(self.back.pop_front().unwrap_or_default());
            let Point { north, east } = self.vehicle.position();
            seen.farthest = seen.farthest.max(north.abs()).max(east.abs());
        }
        into.append(&mut self.come);
        Ok(())
    }

    fn send(&mut self, lines: &[u8]) -> Result<(), LinkError> {
        self.sent.extend_from_slice(lines);
        Ok(())
    }
}

/// How a run ends over a wire that takes so many ticks each way, why, how far the vehicle came, and the host's time.
fn run(script: &str, delay: usize, slowness: f64) -> (Outcome, String, f64, Duration) {
    let script = load_text(Source { name: "box.alb".into(), text: script.into() });
    let plan = Plan::on_link(&script, "box.alb", None, "desk").unwrap();
    let frame = plan.frame().unwrap();
    let setup = VehicleSetup { depth: 4.0, ..VehicleSetup::default() };
    let simulator = Simulator::new(&Scenario { vehicle: setup, ..Scenario::default() }, 1).unwrap();
    let start = (Point::ORIGIN, Heading::NORTH);
    let seen = Arc::new(Mutex::new(Seen::default()));
    // Rows of its own that keep it near the middle, for as long as nobody drives it.
    let rows: Route = "10x10x40".parse::<Rows>().unwrap().into();
    let mut vehicle = Server::new(recon::server(), simulator, frame, &rows, start, Vertical::Depth(4.0));
    let mut said = |_| {
        vehicle.tick(b"").unwrap();
        vehicle.take_output()
    };
    let desk = Desk {
        back: (0..delay).map(&mut said).collect(),
        vehicle,
        there: std::iter::repeat_n(Vec::new(), delay).collect(),
        sent: Vec::new(),
        come: Vec::new(),
        seen: Arc::clone(&seen),
        period: Duration::from_millis(100).mul_f64(slowness),
        ticked: Duration::ZERO,
    };
    let clock = Arc::clone(&seen);
    let now = Box::new(move || clock.lock().unwrap().now);
    let url = Url::parse("serial:/dev/desk?dialect=recon").unwrap();
    let vehicle = LinkVehicle::new(url, Box::new(desk), frame, 1.0, now).unwrap();
    let mut run = Run::on_link(&plan, 1, Box::new(vehicle)).unwrap();
    let outcome = run.to_end();
    assert!(!run.release_failed(), "the answer is waited for as long as the link takes");
    let seen = seen.lock().unwrap();
    (outcome, run.summary(0.0).reason, seen.farthest, seen.now)
}

#[test]
fn a_link_without_delay_is_driven_over() {
    let (outcome, reason, farthest, _) = run(BOX, 0, 1.0);
    assert_eq!(outcome, Outcome::Completed, "{reason}");
    assert!(farthest < HALF, "{farthest}");
}

/// The attack: it ended `completed`, and the vehicle had been 20 m outside.
#[test]
fn a_link_with_ten_seconds_of_delay_is_an_abort_with_its_cause() {
    let (outcome, reason, farthest, now) = run(BOX, 50, 1.0);
    assert_eq!(outcome, Outcome::Aborted, "{reason}");
    let told = reason.strip_prefix("the link's round trip takes 1").filter(|rest| rest.ends_with("more than 2.0 s"));
    assert!(told.is_some(), "{reason}");
    assert!(farthest < HALF, "{farthest}");
    assert!(now < Duration::from_secs(60), "soon: {now:?}");
}

#[test]
fn who_allows_so_long_a_delay_gets_what_comes_of_it() {
    let careless = BOX.replace("speed <= 2 m/s", "speed <= 2 m/s, latency <= 1 min").replace("15 s", "1 min");
    let (outcome, reason, farthest, _) = run(&careless, 50, 1.0);
    assert_eq!(outcome, Outcome::Completed, "{reason}");
    assert!(farthest > HALF, "that is what the limit is for: {farthest}");
}

#[test]
fn a_mission_that_allows_the_delay_is_stopped_by_the_age_of_its_inputs() {
    let patient = BOX.replace("speed <= 2 m/s", "speed <= 2 m/s, latency <= 1 min");
    let (outcome, reason, ..) = run(&patient, 100, 1.0);
    assert_eq!((outcome, reason.as_str()), (Outcome::Aborted, "no fresh `position`"));
}

/// A vehicle whose clock runs at a fifth: its own time would never be up within an hour of ours.
#[test]
fn the_hosts_clock_bounds_a_mission_on_a_vehicle_with_a_slow_one() {
    let short = BOX.replace("within 20 min", "within 2 min").replace("1..3", "1..100");
    let (outcome, reason, _, now) = run(&short, 0, 5.0);
    assert_eq!(outcome, Outcome::TimedOut, "{reason}");
    assert!(reason.starts_with("time limit by the host's clock: 19"), "{reason}");
    assert!(now < Duration::from_secs(330), "192 s, and a recovery: {now:?}");
}
