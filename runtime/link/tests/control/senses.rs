//! What the controller makes of what the vehicle measures.

use crate::vehicle::Vehicle;
use albacore_geometry::Point;
use albacore_navigation::{DeadReckoning, Estimate, Fix, Navigator, Sensed};
use albacore_vehicle::measurements::POSITION;

/// A hold stops the vehicle: that must not be what makes an input of it missing. A profiler that tells 0 of a vehicle that goes is
/// out of order, and so is one that tells nothing.
#[test]
fn a_vehicle_at_rest_has_a_course_and_one_whose_profiler_fails_has_none() {
    let has_course = |speed: f64, profiler: Option<(f64, f64)>| {
        let mut vehicle = Vehicle::driven();
        vehicle.profiles(1.0, 1.0);
        vehicle.says(0x0D);
        vehicle.speed = speed;
        (0..100).for_each(|_| {
            profiler.inspect(|(ahead, starboard)| vehicle.profiles(*ahead, *starboard));
            vehicle.says(0x0D);
        });
        vehicle.course()
    };
    assert_eq!(has_course(0.0, Some((0.0, 0.0))), Some(45.0), "the last one goes on");
    assert_eq!(has_course(0.0, Some((0.0, 0.1))), Some(90.0), "it drifts");
    assert_eq!(has_course(1.5, Some((0.0, 0.0))), None);
    assert_eq!(has_course(0.0, None), None);
    let mut never = Vehicle::driven();
    never.profiles(0.0, 0.0);
    never.says(0x0D);
    assert_eq!(never.course(), Some(0.0), "the heading, where none has come before");
}

/// A navigator is used on a link as in simulation: a gate on what the vehicle tells of its position lets no leap through.
#[test]
fn a_navigator_of_ours_makes_the_position_of_what_the_vehicle_tells() {
    #[derive(Clone, Debug)]
    struct Gated(DeadReckoning);
    impl Navigator for Gated {
        fn predict(&mut self, sensed: &Sensed, time: f64) {
            self.0.predict(sensed, time);
        }
        fn update(&mut self, fix: &Fix) -> bool {
            self.0.update(&Fix { gate: 100.0, ..*fix })
        }
        fn estimate(&self) -> Estimate {
            self.0.estimate()
        }
        fn boxed(&self) -> Box<dyn Navigator> {
            Box::new(self.clone())
        }
    }
    let north = |navigator: Option<Gated>| {
        let mut vehicle = Vehicle::new();
        if let Some(navigator) = navigator {
            vehicle.controller = vehicle.controller.navigated(Box::new(navigator));
        }
        vehicle.speed = 2.0;
        for _ in 0..50 {
            vehicle.profiles(2.0, 0.0);
            vehicle.says(0x01);
        }
        vehicle.snapshot.samples.iter().find(|sample| sample.measurement == POSITION).unwrap().reading[0]
    };
    assert_eq!(north(None), 0.0, "the vehicle says that it stands at the origin");
    let reckoned = north(Some(Gated(DeadReckoning::new(Point::ORIGIN, 0.05))));
    // 49 ticks after the first state; that had no speed before it.
    assert!((reckoned - 9.8).abs() < 1e-6, "{reckoned}");
}
