//! Drag of the water that flows across a hull as it sways and yaws.

/// Drag coefficient of a section: Hoerner's curve at half the breadth over the draught, 0.5, between its points
/// (0.4933, 1.2108) and (0.5585, 1.0836).
const SECTION_DRAG: f64 = 1.2108 + (0.5 - 0.4933) / (0.5585 - 0.4933) * (1.0836 - 1.2108);
/// Strips on either side of the middle one; the outermost are centred on the ends of the hull.
const STRIPS: f64 = 10.0;

/// Strip theory: (Y, N) = sum of c |v + x r| (v + x r) (1, x) over 21 strips.
#[derive(Clone, Copy, Debug)]
pub struct CrossFlow {
    /// Drag of one strip at 1 m/s, N.
    strip: f64,
    /// From one strip to the next, m.
    spacing: f64,
}

impl CrossFlow {
    /// Of a cylinder: density in kg/m3, length and diameter in m.
    pub fn new(density: f64, length: f64, diameter: f64) -> Self {
        let spacing = length / (2.0 * STRIPS);
        CrossFlow { strip: 0.5 * density * diameter * SECTION_DRAG * spacing, spacing }
    }

    /// What slows sway (N) and yaw (N m), at a sway in m/s and a rate of yaw in rad/s.
    ///
    /// The sum in closed form. Of the strips at +-k the water comes from the same side where k t <= |v|, t being the speed of
    /// turning one strip off the middle, and from both sides further out; what they do together is a polynomial in k, the
    /// sums of which are known.
    #[inline]
    pub fn drag(&self, v: f64, r: f64) -> (f64, f64) {
        let turn = self.spacing * r;
        let (speed, t) = (v.abs(), turn.abs());
        // So many strips to either side; a hull that does not turn has all of them.
        let same = if speed < STRIPS * t { (speed / t).floor() } else { STRIPS };
        let sums = |n: f64| {
            let first = 0.5 * n * (n + 1.0);
            (first, first * (2.0 * n + 1.0) / 3.0, first * first)
        };
        let (first, second, third) = sums(same);
        let (all_first, _, all_third) = const { (55.0, 385.0, 3025.0) };
        let sway =
            v * speed + (2.0 * (same * v * v + second * turn * turn)).copysign(v) + 4.0 * v * t * (all_first - first);
        let yaw = 4.0 * speed * turn * second
            + (2.0 * (v * v * (all_first - first) + turn * turn * (all_third - third))).copysign(turn);
        (self.strip * sway, self.strip * self.spacing * yaw)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_the_sum_over_the_strips() {
        let hull = CrossFlow::new(1026.0, 1.6, 0.19);
        let strips = |v: f64, r: f64| {
            (-10..=10).fold((0.0, 0.0), |(sway, yaw), i| {
                let x = f64::from(i) * 0.08;
                let drag = hull.strip * (v + x * r).abs() * (v + x * r);
                (sway + drag, yaw + x * drag)
            })
        };
        for (v, r) in [(0.0, 0.0), (0.3, 0.0), (-0.3, 0.0), (0.0, 0.2), (0.0, -0.2), (0.05, 0.2), (-0.05, 0.3)]
            .into_iter()
            .chain((0..400).map(|i| (0.01 * f64::from(i % 41 - 20), 0.02 * f64::from(i / 20 - 10))))
        {
            let ((sway, yaw), (expected_sway, expected_yaw)) = (hull.drag(v, r), strips(v, r));
            assert!((sway - expected_sway).abs() < 1e-12, "{v} {r}: {sway} {expected_sway}");
            assert!((yaw - expected_yaw).abs() < 1e-12, "{v} {r}: {yaw} {expected_yaw}");
        }
    }

    #[test]
    fn the_section_is_the_published_one() {
        assert!((SECTION_DRAG - 1.197_728_834_355_828_3).abs() < 1e-15);
    }
}
