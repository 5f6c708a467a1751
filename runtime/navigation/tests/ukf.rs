//! The unscented Kalman filter against what must hold of any filter.

#![expect(clippy::unwrap_used, reason = "a test whose filter cannot be made has failed")]

mod ukf {
    pub mod linear;
    pub mod random;
}
