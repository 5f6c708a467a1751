//! Whether the corners of a polygon make an area: on the globe, once round, not too many; what is wrong is told by the corner.

use super::{Position, fault};
use crate::FileFault;
use albacore_geometry::{
    AREA_CORNERS_MAX, AREA_REACH_MAX_M, AREA_WIDTH_MIN_M, Area, AreaError, Geodetic, Point, TangentFrame, Vector,
    goes_round_a_pole, longitude_beside,
};
use albacore_wording::distance;

/// What is thinner than this, in metres, is no area but a point or a line.
const THICKNESS_M: f64 = 1e-3;

/// What the corners of a file may be rounded to, in degrees: about a metre.
const ROUNDED_DEG: f64 = 1e-5;

/// Whether corners make an area; else all that is wrong with them. `what` they are, messages say.
pub(super) fn sound(corners: &[Position], what: &str) -> Result<(), Vec<FileFault>> {
    let mut faults = Vec::new();
    if corners.len() < 3 {
        let corners = if corners.len() == 1 { "1 corner".to_string() } else { format!("{} corners", corners.len()) };
        let message = format!("{what} has {corners}, and an area needs at least 3");
        faults.push(fault(message, "add what is missing, or export it again"));
    }
    if corners.len() > AREA_CORNERS_MAX {
        let message = format!("{what} has {} corners, and an area has at most {AREA_CORNERS_MAX}", corners.len());
        faults.push(fault(message, "simplify its outline"));
    }
    faults.extend(beyond(corners, what));
    if faults.is_empty() {
        faults.extend(misshapen(&together(corners, corners), what));
    }
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// The first corner that is nowhere on the globe.
fn beyond(corners: &[Position], what: &str) -> Option<FileFault> {
    let on_globe = |c: &Position| c.latitude_deg.abs() <= 90.0 && c.longitude_deg.abs() <= 180.0;
    if let Some(i) = corners.iter().position(|c| !on_globe(c)) {
        let Position { latitude_deg, longitude_deg } = corners[i];
        let exchanged = Position { latitude_deg: longitude_deg, longitude_deg: latitude_deg };
        let help = if on_globe(&exchanged) {
            super::SWAPPED
        } else {
            "positions are degrees on WGS 84, the longitude first: export the area in these"
        };
        let message = format!("corner {} of {what} has latitude {latitude_deg} and longitude {longitude_deg}", i + 1);
        return Some(fault(message, help));
    }
    None
}

/// Corners with their longitudes by the turn that is nearest to the first of others: beside 179.9 stands 180.1 for -179.9.
fn together(corners: &[Position], others: &[Position]) -> Vec<Position> {
    let first = others.first().map_or(0.0, |first| first.longitude_deg);
    corners.iter().map(|c| Position { longitude_deg: longitude_beside(c.longitude_deg, first), ..*c }).collect()
}

/// What keeps corners on the globe from making an area.
fn misshapen(corners: &[Position], what: &str) -> Option<FileFault> {
    let n = corners.len();
    if goes_round_a_pole(&corners.iter().map(|c| c.longitude_deg).collect::<Vec<f64>>()) {
        let message = format!("{what} goes round a pole, where no longitude is its middle");
        return Some(fault(message, "cut it into areas that have no pole in them"));
    }
    let sum = corners.iter().fold((0.0, 0.0), |s, c| (s.0 + c.latitude_deg, s.1 + c.longitude_deg));
    let frame = TangentFrame { origin: Geodetic::from_degrees(sum.0 / n as f64, sum.1 / n as f64) };
    let place = |c: &Position| frame.to_point(Geodetic::from_degrees(c.latitude_deg, c.longitude_deg));
    let points: Vec<Point> = corners.iter().map(place).collect();
    let side = |i: usize| points[(i + 1) % n] - points[i % n];
    // To `Area::polygon` two corners within a millimetre are one.
    if let Some(i) = (0..n).find(|&i| side(i).length() < THICKNESS_M) {
        let message = format!("corners {} and {} of {what} are in one place", i + 1, (i + 1) % n + 1);
        return Some(fault(message, "leave one of them out"));
    }
    match Area::polygon(&points) {
        Ok(area) if area.reach() > AREA_REACH_MAX_M => {
            let (far, most) = (distance(area.reach()), distance(AREA_REACH_MAX_M));
            let message =
                format!("a corner of {what} lies {far} from its middle, and no plane reaches farther than {most}");
            Some(fault(
                message,
                "look for a sign or a digit that is wrong in its corners, or cut it into smaller areas",
            ))
        }
        Err(AreaError::TooThin(width)) if width < THICKNESS_M => {
            Some(fault(format!("the corners of {what} lie on one line"), "draw it as a polygon"))
        }
        Err(AreaError::TooThin(width)) => {
            let message = format!(
                "{what} is {width:.2} m wide where it is thinnest, and no area is thinner than {AREA_WIDTH_MIN_M} m",
            );
            Some(fault(message, "look for corners that are nearly in one place or on one line"))
        }
        Err(AreaError::Crossed(a, b)) => {
            let message = format!("the outline of {what} crosses itself, after corners {} and {}", a + 1, b + 1);
            Some(fault(message, "put its corners in their order round it"))
        }
        Ok(_) => None,
        Err(error) => Some(fault(format!("{what} is no area: {error}"), "draw it as a polygon")),
    }
}

/// The first corner of a hole that is neither within an outline nor on it. Between corners a side is straight in degrees.
pub(super) fn outside(hole: &[Position], outline: &[Position]) -> Option<usize> {
    let (hole, outline) = (together(hole, outline), together(outline, outline));
    let place = |c: &Position| Point::new(c.latitude_deg, c.longitude_deg);
    let sides = || (0..outline.len()).map(|i| (place(&outline[i]), place(&outline[(i + 1) % outline.len()])));
    let is_on = |p: Point, (from, to): (Point, Point)| {
        let (side, there) = (to - from, p - from);
        let share = if from == to { 0.0 } else { (there.dot(side) / side.dot(side)).clamp(0.0, 1.0) };
        (there - share * side).length() < ROUNDED_DEG
    };
    let is_south_of = |p: Point, (from, to): (Point, Point)| {
        (from.east > p.east) != (to.east > p.east) && (wedge(to - from, p - from) > 0.0) == (from.east < to.east)
    };
    let is_outside = |p: Point| {
        let to_the_north = sides().filter(|side| is_south_of(p, *side)).count();
        to_the_north % 2 == 0 && !sides().any(|side| is_on(p, side))
    };
    hole.iter().position(|corner| is_outside(place(corner)))
}

/// The area of the parallelogram of two vectors, positive if the second lies clockwise of the first.
fn wedge(u: Vector, v: Vector) -> f64 {
    u.north * v.east - u.east * v.north
}
