//! The scaled unscented Kalman filter, for any state and any measurements of fixed sizes.
//!
//! [`Ukf`] predicts with a process function and takes measurements one after the other, each with its own function of the state;
//! [`Component`] says which numbers are angles. [`History`] keeps filters of a short while, so that what is late is taken at its time.
//!
//! Source: E. A. Wan and R. van der Merwe, The Unscented Kalman Filter for Nonlinear Estimation, 2000, and R. van der Merwe's
//! thesis, 2004, with sigma points drawn anew before every step. Sizes are those of types: a step allocates nothing.

mod component;
mod factor;
mod filter;
mod history;
mod image;
mod spread;

pub use component::Component;
pub use filter::{Innovation, Measurement, Ukf, UkfError};
pub use history::History;
pub use spread::Spread;
