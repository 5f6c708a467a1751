//! How fast sound is in sea water.

/// The speed of sound, m/s, in water of a temperature (degrees Celsius) and a practical salinity at a depth (m): the equation of nine
/// terms of K. V. Mackenzie, J. Acoust. Soc. Am. 70, 807-812, 1981.
pub fn sound_speed(temperature: f64, salinity: f64, depth: f64) -> f64 {
    let (t, s, d) = (temperature, salinity - 35.0, depth);
    let of_temperature = 1448.96 + t * (4.591 + t * (-5.304e-2 + t * 2.374e-4));
    let of_depth = d * (1.630e-2 + d * (1.675e-7 - 7.139e-13 * t * d));
    of_temperature + of_depth + s * (1.340 - 1.025e-2 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published check value is 1550.744 m/s.
    #[test]
    fn the_published_value_is_met() {
        assert!((sound_speed(25.0, 35.0, 1000.0) - 1550.744).abs() < 0.001);
    }
}
