//! The columns of what an inertial navigator was off by, once a second: degrees, all else SI.

use super::columns::{Head, Key, Kind};
use super::sensed::Sensed;
use albacore_geometry::math::degrees;
use albacore_vehicle::{NAVIGATION_STATES, NavigationErrors};

/// What each state is called, and its unit.
const STATES: [(&str, &str); NAVIGATION_STATES] = [
    ("roll", "deg"),
    ("pitch", "deg"),
    ("yaw", "deg"),
    ("gyro_bias.x", "deg/s"),
    ("gyro_bias.y", "deg/s"),
    ("gyro_bias.z", "deg/s"),
    ("north", "m"),
    ("east", "m"),
    ("down", "m"),
    ("velocity.x", "m/s"),
    ("velocity.y", "m/s"),
    ("velocity.z", "m/s"),
    ("accelerometer_bias.x", "m/s2"),
    ("accelerometer_bias.y", "m/s2"),
    ("accelerometer_bias.z", "m/s2"),
];
/// What innovations are of.
const INNOVATIONS: [&str; 4] = ["attitude", "pressure", "velocity", "arrival"];

impl Sensed {
    /// Adds what a navigator was off by.
    pub(super) fn navigation(&mut self, row: usize, errors: &NavigationErrors) {
        let mut at = 0;
        let mut tell = |name: String, unit: &'static str, meaning: String, value: Option<f64>| {
            let head = || Head { name, unit, meaning, role: None, standard_name: None, kind: Kind::Number };
            if let Some(value) = value {
                self.columns.number(Key::Navigation(at), row, value, head);
            }
            at += 1;
        };
        for (i, (state, unit)) in STATES.into_iter().enumerate() {
            let shown = |x: f64| if unit.starts_with("deg") { degrees(x) } else { x };
            let (error, sigma) = (shown(errors.error[i]), shown(errors.sigma[i]));
            let meaning = format!("{state} as it is believed less as it is, known in simulation alone");
            tell(format!("navigation.error.{state}"), unit, meaning, Some(error));
            let meaning = "standard deviation of that, as the navigator expects it".to_string();
            tell(format!("navigation.sigma.{state}"), unit, meaning, Some(sigma));
        }
        let normal = "1 on average where the navigator is right";
        tell(
            "navigation.nees".into(),
            "",
            format!("square of the error by its covariance: {normal}"),
            Some(errors.nees),
        );
        for (what, nis) in INNOVATIONS.into_iter().zip(errors.nis) {
            let meaning = format!("square of the innovation by its covariance: {normal}");
            tell(format!("navigation.nis.{what}"), "", meaning, nis);
        }
    }
}
