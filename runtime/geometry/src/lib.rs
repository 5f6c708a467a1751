//! The frame everything else speaks: headings, points and vectors in the north/east tangent plane, areas, and positions on
//! the globe.
//!
//! Metres, seconds, radians. Headings are clockwise from north, depth is positive down, and there is no other convention.

mod area;
mod attitude;
mod ellipsoid;
mod geodetic;
mod globe;
mod grid;
mod heading;
mod likeness;
pub mod math;
mod mercator;
mod outline;
mod plane;
mod rows;
mod scatter;

pub use area::{
    AREA_CORNERS_MAX, AREA_REACH_MAX_M, AREA_WIDTH_MIN_M, Area, AreaError, Edge, OUTLINE_CORNERS, PLACE_MAX_M,
    farthest_corner, gap, is_convex, nearest_edge, run,
};
pub use attitude::Attitude;
pub use ellipsoid::metres_per_radian;
pub use geodetic::{Geodetic, TangentFrame};
pub use globe::{goes_round_a_pole, longitude_beside, longitude_within};
pub use grid::Grid;
pub use heading::{Heading, wrap_angle};
pub use plane::{Line, Point, Vector};
pub use rows::{Place, ROWS_MAX, Rows};
pub use scatter::{HALVINGS, scattered};
