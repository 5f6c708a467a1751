//! Areas of files whose positions have the latitude first: they lie somewhere on the globe, and nothing shows it but what else
//! the script says of places.

use super::places::written_area;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Builtin, Expr, ExprKind, Hir};
use albacore_formats::area::SWAPPED;
use albacore_geometry::Geodetic;

/// What is within this, m, of the places of a script is meant to lie there.
const NEAR_M: f64 = 100_000.0;

/// The finding for a mission whose area would lie near the places that its statements name if its file had the longitude first. Those
/// of files are not counted.
pub(super) fn check(hir: &Hir, mission: usize) -> Option<Diagnostic> {
    let mut places = Vec::new();
    hir.activities[mission].visit(&mut |e| {
        places.extend(e.position().map(|(latitude, longitude)| Geodetic::from_degrees(latitude, longitude)));
        !of_file(e)
    });
    of_mission(hir, mission, &places)
}

/// The same for places that are known from elsewhere.
pub fn of_mission(hir: &Hir, mission: usize, places: &[Geodetic]) -> Option<Diagnostic> {
    let area = written_area(hir, mission)?;
    would_be_near(area, places).then(|| {
        let message = format!("no place of the mission `{}` is near its area", hir.activities[mission].name);
        Diagnostic::error(Code::AreasSwapped, area.span, message).help(SWAPPED)
    })
}

/// What to ask of a place far from another that would lie near it on the other side of the equator, of Greenwich, or of both.
pub fn hemisphere(place: Geodetic, other: Geodetic) -> Option<String> {
    let letters = |is_negative: bool, [positive, negative]: [&'static str; 2]| {
        if is_negative { (positive, negative) } else { (negative, positive) }
    };
    let (lat, lon) = (place.latitude_rad, place.longitude_rad);
    let (north, east) = (letters(lat < 0.0, ["N", "S"]), letters(lon < 0.0, ["E", "W"]));
    let sides =
        [(lat, lon, vec![]), (-lat, lon, vec![north]), (lat, -lon, vec![east]), (-lat, -lon, vec![north, east])];
    let meant = sides.into_iter().find(|&(latitude_rad, longitude_rad, _)| {
        Geodetic { latitude_rad, longitude_rad }.great_circle(other) < NEAR_M
    });
    let letters: Vec<String> =
        meant?.2.into_iter().map(|(meant, written)| format!("`{meant}` for `{written}`")).collect();
    (!letters.is_empty()).then(|| format!("did you mean {}?", letters.join(" and ")))
}

/// Whether an area of a file is far from all places, and would be near one if its positions were exchanged.
pub(super) fn would_be_near(area: &Expr, places: &[Geodetic]) -> bool {
    let Some(middle) = of_file(area).then(|| hir::middle(&area.positions())).flatten() else { return false };
    let exchanged = Geodetic { latitude_rad: middle.longitude_rad, longitude_rad: middle.latitude_rad };
    let is_near = |at: Geodetic| places.iter().any(|place| place.great_circle(at) < NEAR_M);
    exchanged.latitude_deg().abs() <= 90.0 && !is_near(middle) && is_near(exchanged)
}

/// Whether an area is one of a file: all its corners stand where it stands itself.
fn of_file(area: &Expr) -> bool {
    match &area.kind {
        ExprKind::Unwrap(inner) => of_file(inner),
        ExprKind::Do(Builtin::Polygon, operands) => match operands.as_slice() {
            [Expr { kind: ExprKind::List(corners), .. }] => {
                corners.first().is_some_and(|corner| corner.span == area.span)
            }
            _ => false,
        },
        _ => false,
    }
}
