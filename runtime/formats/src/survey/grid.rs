//! A survey that was read: depths on a grid, and where that comes to lie in a mission's plane.

use crate::fault::{Fault, Faults, compact};
use crate::survey::axis::Axis;
use crate::survey::{CELLS_MAX, CUT_IT};
use albacore_geometry::math::{PI, TAU, radians};
use albacore_geometry::{Point, TangentFrame, metres_per_radian};

/// Nothing on earth is deeper, m: the Challenger Deep has 10,935.
const DEEPEST_M: f64 = 11_500.0;
/// And no land higher, m: Everest has 8,849.
const HIGHEST_M: f64 = 9_000.0;
/// No projection of the earth counts farther, m: half its girth is 20,037,508.
const FARTHEST_M: f64 = 2.1e7;

/// And no survey is finer, m.
const FINEST_M: f64 = 1e-3;

/// What the axes of a survey are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Latitude and longitude, rad.
    Geodetic,
    /// Metres north and east of a point that only the survey knows.
    Local,
}

/// Depths on an even grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// What its axes are.
    pub kind: Kind,
    /// From south to north.
    pub north: Axis,
    /// From west to east.
    pub east: Axis,
    /// Depths of the water, m, positive down, land negative: row after row from the south, each from the west.
    pub depths: Vec<f64>,
}

/// Where a survey is to lie in a mission's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Where its chosen point comes to lie; none: the survey lies where it was made.
    pub at: Option<Point>,
    /// Which point that is: its share of the way from the southern edge to the northern, and from the western to the eastern.
    pub share: (f64, f64),
    /// By how much its sides are scaled.
    pub scale: f64,
}

/// The part of the plane that a survey covers: the places of its south-western and north-eastern cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its south-western cell.
    pub south_west: Point,
    /// Its north-eastern cell.
    pub north_east: Point,
}

impl Survey {
    /// The part of a mission's plane that the survey covers; `frame` ties that plane to the globe, if anything does.
    ///
    /// A geodetic grid becomes an even one in metres with the radii of curvature at the point that is placed, or at the
    /// frame's origin: true there, and bent away from it, for parallels bend and meridians converge. Against the frame's own
    /// projection a corner `d` metres north and east of that point is off by `1.12 d^2 tan(latitude) / R`: at 36 degrees of
    /// latitude 0.13 m for 1 km, 13 m for 10 km and 1.3 km for 100 km; at 60 degrees 2.4 times as much. `scale` scales it too.
    /// No survey is too large for it: a whole globe is accepted, laid by its middle on the equator, and then off by 165 km 30
    /// degrees east of that and by 8,906 km at the poles, 80 degrees east. Depths stay in the order of their cells.
    pub fn extent(&self, placing: &Placing, frame: Option<TangentFrame>) -> Result<Extent, Fault> {
        let (at, from, scale) = match placing.at {
            Some(at) => {
                let from = (self.north.at_share(placing.share.0), self.east.at_share(placing.share.1));
                (at, from, placing.scale)
            }
            None => (Point::ORIGIN, self.origin(placing.scale, frame)?, 1.0),
        };
        let (per_north, per_east) = match self.kind {
            Kind::Geodetic => metres_per_radian(from.0),
            Kind::Local => (1.0, 1.0),
        };
        let laid = |north: f64, east: f64| {
            at + scale * (Point::new((north - from.0) * per_north, (east - from.1) * per_east) - Point::ORIGIN)
        };
        Ok(Extent {
            south_west: laid(self.north.first, self.east.first),
            north_east: laid(self.north.last, self.east.last),
        })
    }

    /// Where on its axes the mission's origin is, for a survey that lies where it was made.
    fn origin(&self, scale: f64, frame: Option<TangentFrame>) -> Result<(f64, f64), Fault> {
        if scale != 1.0 {
            let message = format!("a survey scaled by {scale} lies nowhere by itself");
            return Err(Fault::new(message, "say where its middle is to lie: `at: point(north: 0 m, east: 0 m)`"));
        }
        match (self.kind, frame) {
            (Kind::Local, _) => Ok((0.0, 0.0)),
            (Kind::Geodetic, Some(TangentFrame { origin })) => {
                // Longitudes may be counted from 0 to 360 or from -180 to 180: the turn that is nearest is meant.
                let turns = ((origin.longitude_rad - self.east.at_share(0.5)) / TAU).round();
                Ok((origin.latitude_rad, origin.longitude_rad - turns * TAU))
            }
            (Kind::Geodetic, None) => {
                let message = "the survey lies on the globe, and the scenario has no place there";
                Err(Fault::new(message, "say where its middle is to lie: `at: point(north: 0 m, east: 0 m)`"))
            }
        }
    }
}

/// Longitudes, degrees, whose count begins anew on the way eastward, at 180 or at 360, as going on. Those that go on beyond 360 are
/// counted from 0 there.
pub(crate) fn going_on(longitudes: &mut [f64]) {
    let mut turned = 0.0;
    for i in 1..longitudes.len() {
        // What falls by less than half a turn descends.
        if longitudes[i - 1] - (longitudes[i] + turned) > 180.0 {
            turned += 360.0;
        }
        longitudes[i] += turned;
    }
    let ends = longitudes.first().copied().zip(longitudes.last().copied());
    if ends.is_some_and(|(first, last)| first < 360.0 && last > 360.0 && last - first <= 360.0) {
        longitudes.iter_mut().for_each(|longitude| *longitude -= 360.0);
    }
}

/// Whether any cell is water; `turned` tells how a file says that its numbers count the other way.
pub(crate) fn check_water(depths: &[f64], are_depths: bool, turned: &str, faults: &mut Faults) {
    if faults.count() == 0 && depths.iter().all(|depth| *depth <= 0.0) {
        let help = match are_depths {
            true => format!("depths are positive there: if these are elevations, {turned}"),
            false => format!("elevations are negative there: if these are depths, {turned}"),
        };
        faults.add("no cell lies under water", help);
    }
}

/// The axes of a geodetic survey from those in degrees.
pub(crate) fn on_the_globe(latitude: Axis, longitude: Axis, faults: &mut Faults) -> Option<(Axis, Axis)> {
    let (north, east) = (latitude.times(PI / 180.0), longitude.times(PI / 180.0));
    let before = faults.count();
    if north.first < -radians(90.0) || north.last > radians(90.0) {
        let message = format!("latitudes run from {} to {} degrees", compact(latitude.first), compact(latitude.last));
        faults.add(message, "they lie between -90 and 90: are the axes exchanged, or in metres?");
    }
    if east.first < -TAU || east.last > TAU || east.last - east.first > TAU {
        let message =
            format!("longitudes run from {} to {} degrees", compact(longitude.first), compact(longitude.last));
        faults.add(message, "they lie between -360 and 360, once round at most: are they in metres?");
    }
    (faults.count() == before).then_some((north, east))
}

/// The axes of a survey in metres.
pub(crate) fn on_a_plane(north: Axis, east: Axis, faults: &mut Faults) -> Option<(Axis, Axis)> {
    let before = faults.count();
    for (name, axis) in [("northward", north), ("eastward", east)] {
        if axis.first < -FARTHEST_M || axis.last > FARTHEST_M {
            let message =
                format!("the survey runs {name} from {} to {} metres", compact(axis.first), compact(axis.last));
            faults.add(message, "the earth is smaller: are they millimetres?");
        } else if axis.step() < FINEST_M {
            let message = format!("the survey's places lie {} m apart {name}", compact(axis.step()));
            faults.add(message, "no survey is as fine: are they kilometres?");
        }
    }
    (faults.count() == before).then_some((north, east))
}

/// Whether a grid of this size may be read.
pub(crate) fn check_size(rows: u64, columns: u64) -> Result<u64, Fault> {
    match rows.checked_mul(columns) {
        Some(cells) if cells <= CELLS_MAX => Ok(cells),
        _ => {
            let message = format!("the grid has {rows} rows of {columns} cells: {CELLS_MAX} cells are read at most");
            Err(Fault::new(message, CUT_IT))
        }
    }
}

/// Whether a depth, m, is one that water on earth can have, or a height of land.
pub(crate) fn is_on_earth(depth: f64) -> bool {
    (-HIGHEST_M..=DEEPEST_M).contains(&depth)
}
