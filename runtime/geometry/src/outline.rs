//! What can be said of a polygon's outline: which way it goes round, whether it meets itself, what it encloses, its hull.

use crate::area::{Edge, ON_EDGE_M, SEPARATION_M};
use crate::plane::{Line, Point, Vector};

/// The area of the parallelogram of two vectors, positive if the second lies clockwise of the first.
fn wedge(u: Vector, v: Vector) -> f64 {
    u.north * v.east - u.east * v.north
}

/// Twice the surface that corners go round, m2: positive where they do so clockwise.
pub fn surface(corners: &[Point]) -> f64 {
    let Some(&first) = corners.first() else { return 0.0 };
    corners.windows(2).map(|pair| wedge(pair[0] - first, pair[1] - first)).sum()
}

/// The first two edges that meet elsewhere than at a corner that they share, by the corners where they begin.
pub fn meeting(corners: &[Point]) -> Option<(usize, usize)> {
    let n = corners.len();
    let side = |i: usize| Line { start: corners[i], end: corners[(i + 1) % n] };
    for i in 0..n {
        let edge = side(i);
        // The next edge may lead back along this one.
        let (next, after) = ((i + 1) % n, corners[(i + 2) % n]);
        if distance(edge, after) < SEPARATION_M || distance(side(next), edge.start) < SEPARATION_M {
            return Some((i.min(next), i.max(next)));
        }
        let others = i + 2..if i == 0 { n - 1 } else { n };
        if let Some(j) = others.into_iter().find(|&j| meet(edge, side(j))) {
            return Some((i, j));
        }
    }
    None
}

/// Whether two lines cross, or come so near that they might.
fn meet(a: Line, b: Line) -> bool {
    let apart = |a: (f64, f64), b: (f64, f64)| {
        a.0.min(a.1) > b.0.max(b.1) + SEPARATION_M || b.0.min(b.1) > a.0.max(a.1) + SEPARATION_M
    };
    if apart((a.start.north, a.end.north), (b.start.north, b.end.north))
        || apart((a.start.east, a.end.east), (b.start.east, b.end.east))
    {
        return false;
    }
    if is_beside(a, b) || is_beside(b, a) {
        return false;
    }
    let divides = |line: Line, other: Line| off(line, other.start) * off(line, other.end) < 0.0;
    let ends = [distance(a, b.start), distance(a, b.end), distance(b, a.start), distance(b, a.end)];
    (divides(a, b) && divides(b, a)) || ends.iter().any(|end| *end < SEPARATION_M)
}

/// Whether all of another line lies to one side of that which goes on where a line ends: that tells most pairs apart.
fn is_beside(line: Line, other: Line) -> bool {
    let (start, end, least) = (off(line, other.start), off(line, other.end), SEPARATION_M * line.length());
    start.min(end) > least || start.max(end) < -least
}

/// How far a point is to the right of a line, m, times the length of that.
fn off(line: Line, p: Point) -> f64 {
    wedge(line.end - line.start, p - line.start)
}

/// Metres from a point to the nearest place of a line.
fn distance(line: Line, p: Point) -> f64 {
    let side = line.end - line.start;
    let share = ((p - line.start).dot(side) / side.dot(side)).clamp(0.0, 1.0);
    p.distance(line.start + share * side)
}

/// Whether an edge is met by who goes east from a point. Of edges that go round it an odd number is.
pub fn passes_east_of(edge: Edge, p: Point) -> bool {
    let Line { start, end } = edge.line;
    let leads_north = end.north > start.north;
    (start.north > p.north) != (end.north > p.north) && (wedge(end - start, p - start) < 0.0) == leads_north
}

/// What of the line through a point, along a ray, lies inside edges, piece by piece as the ray goes. Which corners lie beyond the line
/// is the caller's to say.
pub fn chords(
    edges: impl Iterator<Item = Edge>,
    ray: Vector,
    through: Point,
    is_beyond: impl Fn(Point) -> bool,
) -> Vec<Line> {
    let crossed = |edge: &Edge| is_beyond(edge.line.start) != is_beyond(edge.line.end);
    let mut places: Vec<f64> = edges.filter(crossed).map(|edge| crossing(edge, ray, through)).collect();
    places.sort_by(f64::total_cmp);
    let line = |pair: &[f64]| Line { start: through + pair[0] * ray, end: through + pair[1] * ray };
    places.chunks_exact(2).map(line).collect()
}

/// How far along a ray from a point it crosses the line of an edge, m.
fn crossing(edge: Edge, ray: Vector, through: Point) -> f64 {
    let outward = ray.dot(edge.normal);
    // An edge along the ray is crossed wherever it is.
    if outward == 0.0 { (edge.line.start - through).dot(ray) } else { edge.gap(through) / outward }
}

/// The middles of the stretches into which edges cut a line.
pub fn stretches(line: Line, edges: impl Iterator<Item = Edge>) -> impl Iterator<Item = Point> {
    let (side, length) = (line.end - line.start, line.length());
    let share = |p: Point| (p - line.start).dot(side) / side.dot(side);
    let mut shares = vec![0.0, 1.0];
    for edge in edges {
        let ends = [edge.line.start, edge.line.end];
        shares.extend(ends.into_iter().filter(|end| distance(line, *end) < ON_EDGE_M).map(share));
        let off = |p: Point| wedge(side, p - line.start);
        let (a, b) = (off(ends[0]), off(ends[1]));
        if a * b < 0.0 {
            shares.push(share(ends[0] + (a / (a - b)) * (ends[1] - ends[0])));
        }
    }
    shares.retain(|share| (0.0..=1.0).contains(share));
    shares.sort_by(f64::total_cmp);
    let pairs: Vec<(f64, f64)> = shares.windows(2).map(|pair| (pair[0], pair[1])).collect();
    let long = pairs.into_iter().filter(move |(a, b)| (b - a) * length > ON_EDGE_M);
    long.map(move |(a, b)| line.start + 0.5 * (a + b) * side)
}

/// The corners of the hull, clockwise, the southernmost first, without those that lie between others (Andrew's monotone chain).
pub fn hull(corners: &[Point]) -> Vec<Point> {
    let mut sorted = corners.to_vec();
    sorted.sort_by(|a, b| a.north.total_cmp(&b.north).then(a.east.total_cmp(&b.east)));
    // West of the line from the first to the last on the way there, east of it on the way back.
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && wedge(b - a, p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

/// The least distance of two parallels between which corners lie, m: one of them goes along an edge of the hull (rotating calipers).
pub fn width(corners: &[Point]) -> f64 {
    let hull = hull(corners);
    let n = hull.len();
    let (mut least, mut far) = (f64::INFINITY, 1);
    for i in 0..n {
        let (start, side) = (hull[i], hull[(i + 1) % n] - hull[i]);
        let off = |k: usize| wedge(side, hull[k % n] - start);
        for _ in 0..n {
            if off(far + 1) < off(far) {
                break;
            }
            far = (far + 1) % n;
        }
        least = least.min(off(far) / side.length());
    }
    if n < 3 { 0.0 } else { least }
}
