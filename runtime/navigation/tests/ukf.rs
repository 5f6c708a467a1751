//! The unscented Kalman filter against series that other software computed (`tests/ukf/`), and against what must hold of any filter.

#![expect(clippy::unwrap_used, reason = "a test whose filter cannot be made has failed")]

mod ukf {
    pub mod linear;
    pub mod random;
    pub mod series;
    pub mod steps;
}
