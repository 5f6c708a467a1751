//! Which numbers of a state or of a measurement are angles.

use albacore_geometry::wrap_angle;

/// How differences and means of one number are taken.
///
/// The mean of angles is their intrinsic mean on the circle: that about which the weighted differences, each within half a turn, add
/// up to 0. It is the plain mean as long as no sigma point is half a turn from the central one. The direction of the weighted sum of
/// unit vectors is no alternative: the central weight may be -100, and that sum then points backwards from a standard deviation of
/// some 1.4 rad on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Component {
    /// A plain number: differences and means are plain. Also an angle that is to be counted on beyond whole turns.
    #[default]
    Line,
    /// An angle, rad: differences and means lie within half a turn, in (-pi, pi].
    Circle,
}

impl Component {
    /// By how much one number is ahead of another, or where on its line or circle a number is.
    #[inline]
    pub fn reduced(self, x: f64) -> f64 {
        match self {
            Component::Line => x,
            Component::Circle => wrap_angle(x),
        }
    }
}
