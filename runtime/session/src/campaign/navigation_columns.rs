//! The columns of how good an inertial navigator was, which the runs of a scenario with one fill.

use crate::summary::NavigationSummary;
use albacore_program::number;

/// How many decimals are worth telling.
const DECIMALS: u8 = 4;

/// A column: its name, and what stands in it.
type Column = (&'static str, fn(&NavigationSummary) -> Option<f64>);

/// All of them. Errors are of once a second, from 30 s on but for the place; `nees` and `nis` are of each number, 1 where the filter is right.
const COLUMNS: [Column; 25] = [
    ("position_error_mean_m", |n| Some(n.position_error_mean_m)),
    ("position_error_max_m", |n| Some(n.position_error_max_m)),
    ("depth_error_rms_m", |n| Some(n.depth_error_rms_m)),
    ("depth_error_max_m", |n| Some(n.depth_error_max_m)),
    ("roll_error_99_deg", |n| Some(n.roll_error_99_deg)),
    ("pitch_error_99_deg", |n| Some(n.pitch_error_99_deg)),
    ("yaw_error_99_deg", |n| Some(n.yaw_error_99_deg)),
    ("gyro_bias_error_max_deg_s", |n| Some(n.gyro_bias_error_max_deg_s)),
    ("accelerometer_bias_error_max_m_s2", |n| Some(n.accelerometer_bias_error_max_m_s2)),
    ("attitude_within_3_sigma", |n| Some(n.within_3_sigma[0])),
    ("gyro_bias_within_3_sigma", |n| Some(n.within_3_sigma[1])),
    ("position_within_3_sigma", |n| Some(n.within_3_sigma[2])),
    ("velocity_within_3_sigma", |n| Some(n.within_3_sigma[3])),
    ("nees", |n| Some(n.nees[0])),
    ("nees_within_95", |n| Some(n.nees[1])),
    ("nis_attitude", |n| n.nis[0].map(|nis| nis[0])),
    ("nis_attitude_within_95", |n| n.nis[0].map(|nis| nis[1])),
    ("nis_pressure", |n| n.nis[1].map(|nis| nis[0])),
    ("nis_pressure_within_95", |n| n.nis[1].map(|nis| nis[1])),
    ("nis_velocity", |n| n.nis[2].map(|nis| nis[0])),
    ("nis_velocity_within_95", |n| n.nis[2].map(|nis| nis[1])),
    ("nis_arrival", |n| n.nis[3].map(|nis| nis[0])),
    ("nis_arrival_within_95", |n| n.nis[3].map(|nis| nis[1])),
    ("beyond_s", |n| Some(n.beyond_s)),
    ("unnoticed_s", |n| Some(n.unnoticed_s)),
];

/// Their names.
pub fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(name, _)| *name)
}

/// The cells of a run.
pub fn cells(navigation: Option<&NavigationSummary>) -> impl Iterator<Item = String> + '_ {
    COLUMNS.iter().map(move |(_, value)| {
        navigation.and_then(value).map(|value| number::fixed(value, DECIMALS)).unwrap_or_default()
    })
}
