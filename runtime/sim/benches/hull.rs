//! What a second of a hull costs, autopilot included: `cargo bench -p albacore-sim --bench hull`.
//!
//! The items are seconds simulated: so many a second are so many times real time on one core.

#![expect(clippy::print_stdout, reason = "a benchmark tells what it measured")]

use albacore_geometry::{Heading, Vector};
use albacore_sim::hull::{Crossflow, Hull};
use albacore_sim::{HullSetup, KinematicHull, SubmersibleHull, VehicleSetup};
use albacore_vehicle::{Command, Vertical};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

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
}

impl Kind {
    fn hull(self) -> Hull {
        let hull = match self {
            Kind::Kinematic => HullSetup::Kinematic(KinematicHull::default()),
            Kind::Fossen => HullSetup::Fossen(SubmersibleHull::fossen()),
            Kind::Prestero => HullSetup::Prestero(SubmersibleHull::prestero(), Crossflow::Corrected),
        };
        Hull::new(&VehicleSetup { hull, depth: 5.0, ..VehicleSetup::default() }, Vector::ZERO, 1)
    }
}

fn main() {
    for kind in [Kind::Kinematic, Kind::Fossen, Kind::Prestero] {
        let bytes = match kind.hull() {
            Hull::Kinematic(hull) => size_of_val(&hull),
            Hull::Fossen(hull) => size_of_val(&*hull),
            Hull::Prestero(hull) => size_of_val(&*hull),
        };
        println!("{kind:?}: {bytes} bytes of state");
    }
    divan::main();
}

/// A second on a zigzag that dives and climbs, in a current. Samples are short, so that what else the machine does disturbs few of
/// them and the median little.
#[divan::bench(args = [Kind::Kinematic, Kind::Fossen, Kind::Prestero], sample_count = 4000, sample_size = 1)]
fn second(bencher: Bencher, kind: Kind) {
    let mut hull = kind.hull();
    let flow = Vector::new(0.1, -0.2);
    let mut tick = 0;
    bencher.counter(ItemsCount::new(1_usize)).bench_local(|| {
        for _ in 0..TICKS {
            let odd = tick / LEG_TICKS % 2 == 1;
            let heading = Heading::from_degrees(if odd { 120.0 } else { 30.0 });
            let vertical = Vertical::Depth(if odd { 8.0 } else { 5.0 });
            let command = Command { heading, speed: 2.0, vertical };
            assert!(hull.step(tick, black_box(Some(&command)), flow, |_| 20.0).is_ok());
            tick += 1;
        }
    });
}
