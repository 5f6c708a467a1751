//! Step responses.

use super::*;
use crate::hull::{Fossen, Prestero};
use albacore_geometry::math::degrees;
use albacore_vehicle::Vertical;

fn fossen() -> Submersible<Fossen> {
    let plant = Fossen::new();
    let settings = Settings { steps: 10, speed_max: 2.5, limits: ActuatorLimits::default(), gains: Gains::FOSSEN };
    let body = plant.body();
    Submersible::new(plant, &body, &settings, &Berth { depth: 5.0, ..Berth::default() })
}

fn prestero() -> Submersible<Prestero> {
    let plant = Prestero::default();
    let limits = ActuatorLimits { rpm: 2500.0, ..ActuatorLimits::default() };
    let settings = Settings { steps: 10, speed_max: 2.5, limits, gains: Gains::PRESTERO };
    let body = plant.body();
    Submersible::new(plant, &body, &settings, &Berth { depth: 5.0, ..Berth::default() })
}

fn show<P: Plant>(name: &str, hull: &mut Submersible<P>, speed: f64) {
    println!("== {name} {speed}");
    let c = |h: f64, v: Vertical| Command { heading: Heading::from_degrees(h), speed, vertical: v };
    let mut run = |what: &str, c: Option<Command>, seconds: usize, every: usize, bottom: &dyn Fn(Point) -> f64| {
        println!("-- {what}");
        for i in 0..seconds * 10 {
            hull.step(c.as_ref(), Vector::ZERO, bottom);
            if (i + 1) % (every * 10) == 0 {
                let m = hull.motion();
                let a = &hull.actuators.now;
                println!(
                    "{:4} head {:7.2} depth {:7.3} pitch {:6.2} roll {:6.2} speed {:.3} rud {:6.2} stern {:6.2} rpm {:.0}",
                    (i + 1) / 10,
                    degrees(wrap_angle(m.heading.radians())),
                    m.depth,
                    degrees(m.pitch),
                    degrees(m.roll),
                    m.speed,
                    degrees(a.rudder),
                    degrees(a.stern),
                    a.rpm
                );
            }
        }
    };
    let flat = |_: Point| 50.0;
    run("speed", Some(c(0.0, Vertical::Depth(5.0))), 60, 5, &flat);
    run("heading", Some(c(90.0, Vertical::Depth(5.0))), 60, 3, &flat);
    run("depth", Some(c(90.0, Vertical::Depth(15.0))), 120, 5, &flat);
    run("altitude", Some(c(90.0, Vertical::Altitude(2.0))), 240, 20, &|p| 20.0 + 0.03 * p.east);
    run("up", Some(c(90.0, Vertical::Depth(0.0))), 240, 20, &flat);
    run("none", None, 20, 5, &flat);
}

#[test]
fn show_all() {
    for speed in [2.0, 1.5, 1.2] {
        show("fossen", &mut fossen(), speed);
        show("prestero", &mut prestero(), speed);
    }
}
