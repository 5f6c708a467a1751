//! The scaled unscented Kalman filter, for any state and any measurements of fixed sizes, and the 15 states of inertial navigation with it.
//!
//! [`Ukf`] predicts with a process function and takes measurements one after the other, each with its own function of the state;
//! [`Component`] says which numbers are angles. [`History`] keeps filters of a short while, so that what is late is taken at its time.
//! [`Ins15`] is the filter of Jayasiri, Gosine, Mann and McGuire, AUV-Based Plume Tracking: A Simulation Study, 2016.
//!
//! Source: E. A. Wan and R. van der Merwe, The Unscented Kalman Filter for Nonlinear Estimation, 2000, and R. van der Merwe's
//! thesis, 2004, with sigma points drawn anew before every step. Sizes are those of types: a step allocates nothing.

mod component;
mod factor;
mod filter;
mod history;
mod image;
mod ins15;
mod spread;

pub use component::Component;
pub use filter::{Innovation, Measurement, Ukf, UkfError};
pub use history::History;
pub use ins15::{Aided, Aiding, Imu, Ins15, Ins15Gates, Ins15Setup, InsState, Velocity};
pub use spread::Spread;
