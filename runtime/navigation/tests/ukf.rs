//! The unscented Kalman filter against series that other software computed (`tests/ukf/`), and against what must hold of any filter.
//!
//! A long run of the filter of 15 states: `UKF_STEPS=10000000 cargo test --release -p albacore-navigation --test ukf long_run`.

#![expect(clippy::unwrap_used, reason = "a test whose filter cannot be made has failed")]

mod ukf {
    pub mod linear;
    pub mod long_run;
    pub mod random;
    pub mod series;
    pub mod steps;
}
