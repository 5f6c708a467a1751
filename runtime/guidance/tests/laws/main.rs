//! The guidance laws, each on a vehicle that follows as it can.

mod commands;
mod dubins;
mod goto;
mod lines;
mod loiter;
mod nonsense;
mod poses;
mod vehicle;
