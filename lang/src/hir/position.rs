//! Positions on the globe that are written in expressions, and what lies in the middle of them.

use super::{Activity, ClauseArg, ClauseUse, Decl, Expr, ExprKind};
use albacore_geometry::{Geodetic, longitude_beside, longitude_within};

/// A latitude and a longitude as they are written, degrees.
pub type Degrees = (f64, f64);

impl Expr {
    /// The position on the globe that it is, if it is one.
    pub fn position(&self) -> Option<Degrees> {
        match self.kind {
            ExprKind::Geodetic { latitude_deg, longitude_deg } => Some((latitude_deg, longitude_deg)),
            _ => None,
        }
    }

    /// Those that stand in it.
    pub fn positions(&self) -> Vec<Degrees> {
        let mut found = Vec::new();
        self.visit(&mut |e| {
            found.extend(e.position());
            true
        });
        found
    }
}

impl Activity {
    /// The areas of a mission as they are written, the operating area first.
    pub fn areas(&self) -> impl Iterator<Item = &Expr> {
        self.decls.iter().filter_map(|decl| match decl {
            Decl::Area(_, e) => Some(e),
            _ => None,
        })
    }

    /// Where the local frame of a mission touches the globe: in the middle of the positions that its first area is made of that has any. Of a
    /// rectangle that is the centre.
    pub fn origin(&self) -> Option<Geodetic> {
        self.areas().find_map(|area| middle(&area.positions()))
    }
}

impl ClauseUse {
    /// Those that stand in a clause of a scenario.
    pub fn positions(&self) -> Vec<Degrees> {
        let args = self.args.iter().map(|(_, arg)| match arg {
            ClauseArg::Value(e) => e.positions(),
            ClauseArg::Nested(inner) => inner.positions(),
        });
        args.flatten().collect()
    }
}

/// The middle of some positions, each by the turn of longitude that is nearest to the first. About it lies the frame of an area
/// that is made of them.
pub fn middle(positions: &[Degrees]) -> Option<Geodetic> {
    let (_, first) = *positions.first()?;
    let n = positions.len() as f64;
    let sum = positions.iter().fold((0.0, 0.0), |(a, b), (lat, lon)| (a + lat, b + longitude_beside(*lon, first)));
    Some(Geodetic::from_degrees(sum.0 / n, longitude_within(sum.1 / n)))
}
