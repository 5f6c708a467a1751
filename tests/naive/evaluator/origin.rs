//! Where the local frame lies.

use albacore_geometry::TangentFrame;
use albacore_lang::hir::{Activity, Decl, Expr, ExprKind, children};

/// The local frame lies about the mean of the positions that the mission's first area is made of that has any.
pub fn of(mission: &Activity) -> Option<TangentFrame> {
    fn positions(e: &Expr, found: &mut Vec<(f64, f64)>) {
        if let ExprKind::Geodetic { latitude_deg, longitude_deg } = e.kind {
            found.push((latitude_deg, longitude_deg));
        }
        children(e, &mut |child| positions(child, found));
    }
    let mut found = Vec::new();
    for decl in &mission.decls {
        match decl {
            Decl::Area(_, e) if found.is_empty() => positions(e, &mut found),
            _ => {}
        }
    }
    let n = found.len() as f64;
    // By the turn of longitude that is nearest to the first: some may lie beyond the 180th meridian.
    let (_, first) = *found.first()?;
    let beside = |lon: f64| {
        if lon - first > 180.0 {
            lon - 360.0
        } else if lon - first < -180.0 {
            lon + 360.0
        } else {
            lon
        }
    };
    let (latitude, mut longitude) = found.iter().fold((0.0, 0.0), |(a, b), (lat, lon)| (a + lat, b + beside(*lon)));
    if longitude / n > 180.0 {
        longitude -= 360.0 * n;
    } else if longitude / n <= -180.0 {
        longitude += 360.0 * n;
    }
    let origin = albacore_geometry::Geodetic::from_degrees(latitude / n, longitude / n);
    Some(TangentFrame { origin })
}
