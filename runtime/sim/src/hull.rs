//! Hulls.
mod actuators;
mod fossen;
mod mass;
mod prestero;
mod six_dof;
pub use actuators::*;
pub use fossen::*;
pub use prestero::*;
pub use six_dof::*;
