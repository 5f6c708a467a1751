//! The track as polylines, one for each stretch of one behavior, with no more corners than the eye can see.

use super::{frame::Frame, is_place};
use albacore_geometry::Point;

/// A corner nearer to the line than this, in pixels, is not seen.
const TOLERANCE_PX: f64 = 0.4;
/// The tolerance is not raised beyond this, in pixels: the eye would see it.
const TOLERANCE_MAX_PX: f64 = 3.0;
/// Points in all, beyond which the tolerance is raised: what keeps the file small.
const POINTS_MAX: usize = 16_000;
/// The longest stretch that is thinned at once: the work grows with its square at worst.
const STRETCH_MAX: usize = 2_000;

/// A stretch of the track in one behavior, on the page.
pub struct Run {
    /// Which behavior.
    pub behavior: u16,
    /// Its corners, in pixels.
    pub points: Vec<(f64, f64)>,
}

/// The track in stretches. Each begins where the one before ends.
pub fn runs(track: &[(Point, u16)], frame: &Frame) -> Vec<Run> {
    let places = track.iter().filter(|(p, _)| is_place(*p)).map(|(p, behavior)| (frame.place(*p), *behavior));
    stretches(places, POINTS_MAX)
}

/// Places on the page in stretches of one behavior, with so many corners at most. Each begins where the one before ends.
pub fn stretches(places: impl Iterator<Item = ((f64, f64), u16)>, most: usize) -> Vec<Run> {
    let mut whole: Vec<Run> = Vec::new();
    for (at, behavior) in places {
        match whole.last_mut() {
            Some(run) if run.behavior == behavior => run.points.push(at),
            Some(run) => {
                run.points.push(at);
                whole.push(Run { behavior, points: vec![at] });
            }
            None => whole.push(Run { behavior, points: vec![at] }),
        }
    }
    thin(whole, TOLERANCE_PX, most)
}

/// Stretches with no more corners than are seen at a tolerance, and so many at most.
pub fn thin(whole: Vec<Run>, mut tolerance: f64, most: usize) -> Vec<Run> {
    loop {
        let thin: Vec<Run> = whole
            .iter()
            .map(|run| Run { behavior: run.behavior, points: thinned(&run.points, tolerance) })
            .filter(|run| run.points.len() > 1)
            .collect();
        let count: usize = thin.iter().map(|run| run.points.len()).sum();
        if count <= most {
            return thin;
        }
        if TOLERANCE_MAX_PX < tolerance {
            return decimated(thin, count.div_ceil(most), most);
        }
        tolerance *= 2.0;
    }
}

/// The last resort, for a track that is all corners: of each stretch every so manieth point and its last; of stretches too
/// when there are too many of them.
fn decimated(runs: Vec<Run>, step: usize, most: usize) -> Vec<Run> {
    let keep = runs.len().div_ceil(most / 4);
    let thin = |run: Run| {
        let last = run.points.len() - 1;
        let kept = run.points.into_iter().enumerate().filter(|(i, _)| i % step == 0 || *i == last);
        Run { behavior: run.behavior, points: kept.map(|(_, p)| p).collect() }
    };
    runs.into_iter().step_by(keep.max(1)).map(thin).collect()
}

/// Without the points that lie on the line between their neighbours: first those that hardly move, then Douglas-Peucker.
fn thinned(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let mut sparse: Vec<(f64, f64)> = Vec::new();
    for (i, &p) in points.iter().enumerate() {
        let last = i + 1 == points.len();
        if last || sparse.last().is_none_or(|&q| distance_squared(p, q) >= tolerance * tolerance) {
            sparse.push(p);
        }
    }
    let mut kept = vec![false; sparse.len()];
    let mut stretches: Vec<(usize, usize)> = Vec::new();
    let mut from = 0;
    while from < sparse.len() {
        let to = (from + STRETCH_MAX).min(sparse.len() - 1);
        (kept[from], kept[to]) = (true, true);
        stretches.push((from, to));
        from = to.max(from + 1);
    }
    while let Some((a, b)) = stretches.pop() {
        let off = |i: usize| distance_to_segment_squared(sparse[i], sparse[a], sparse[b]);
        let farthest = (a + 1..b).max_by(|&i, &j| off(i).total_cmp(&off(j)));
        if let Some(i) = farthest.filter(|&i| off(i) > tolerance * tolerance) {
            kept[i] = true;
            stretches.extend([(a, i), (i, b)]);
        }
    }
    sparse.into_iter().zip(kept).filter_map(|(p, kept)| kept.then_some(p)).collect()
}

fn distance_squared(p: (f64, f64), q: (f64, f64)) -> f64 {
    let (dx, dy) = (p.0 - q.0, p.1 - q.1);
    dx * dx + dy * dy
}

fn distance_to_segment_squared(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length_squared = dx * dx + dy * dy;
    let along = if length_squared > 0.0 { ((p.0 - a.0) * dx + (p.1 - a.1) * dy) / length_squared } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    distance_squared(p, (a.0 + along * dx, a.1 + along * dy))
}
