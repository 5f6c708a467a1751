//! What a second of a hull costs, autopilot included: `cargo bench -p albacore-sim --bench hull`.

#![expect(clippy::print_stdout, reason = "a benchmark tells what it measured")]
#![expect(clippy::unwrap_used, reason = "a benchmark without a clock has nothing to measure")]

mod common;

use albacore_geometry::{Heading, Vector};
use albacore_sim::hull::{Controller, Crossflow, Hull, LqrGains};
use albacore_sim::{HullSetup, KinematicHull, SubmersibleHull, VehicleSetup};
use albacore_vehicle::{Command, Vertical};
use common::{cost, stretches};
use std::hint::black_box;

/// Ticks of a second.
const TICKS: u64 = 10;
/// So long one heading and one depth are kept, ticks: the hull always turns, climbs or dives.
const LEG_TICKS: u64 = 200;

/// Every hull; those in six degrees of freedom at 100 Hz.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Kinematic,
    Fossen,
    Prestero,
    /// The same with fins that are moved at every step.
    Regulated,
}

impl Kind {
    fn hull(self) -> Hull {
        let hull = match self {
            Kind::Kinematic => HullSetup::Kinematic(KinematicHull::default()),
            Kind::Fossen => HullSetup::Fossen(SubmersibleHull::fossen()),
            Kind::Prestero => HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected),
            Kind::Regulated => {
                let controller = Controller::Lqr2016(LqrGains::default());
                HullSetup::Prestero(SubmersibleHull { controller, ..SubmersibleHull::prestero() }, Crossflow::Corrected)
            }
        };
        Hull::new(&VehicleSetup { hull, depth: 5.0, ..VehicleSetup::default() }, Vector::ZERO, 1)
    }
}

fn main() {
    for kind in [Kind::Kinematic, Kind::Fossen, Kind::Prestero, Kind::Regulated] {
        let bytes = match kind.hull() {
            Hull::Kinematic(hull) => size_of_val(&hull),
            Hull::Fossen(hull) => size_of_val(&*hull),
            Hull::Prestero(hull) => size_of_val(&*hull),
        };
        let [second_ns] = cost([&mut || zigzag(kind)]);
        let (us, times) = (second_ns / 1e3, 1e9 / second_ns);
        println!(
            "{:10} {us:6.2} µs a second: {times:8.0} times real time; {bytes} bytes of state",
            format!("{kind:?}")
        );
    }
}

/// Seconds on a zigzag that dives and climbs, in a current.
fn zigzag(kind: Kind) -> Vec<f64> {
    let mut hull = kind.hull();
    let flow = Vector::new(0.1, -0.2);
    let mut tick = 0;
    stretches(10, 100, || {
        for _ in 0..TICKS {
            let odd = tick / LEG_TICKS % 2 == 1;
            let heading = Heading::from_degrees(if odd { 120.0 } else { 30.0 });
            let vertical = Vertical::Depth(if odd { 8.0 } else { 5.0 });
            let command = Command::new(heading, 2.0, vertical);
            assert!(hull.step(tick, black_box(Some(&command)), flow, |_| 20.0, None).is_ok());
            tick += 1;
        }
    })
}
