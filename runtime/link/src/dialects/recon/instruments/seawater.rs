//! What follows from temperature and salinity: a CTD derives salinity from conductivity, and the speed of sound.

/// The speed of sound, m/s (Mackenzie 1981, J. Acoust. Soc. Am. 70, 807-812, nine terms: 2 to 30 degrees, salinities of 25 to
/// 40, to 8000 m).
pub fn sound_speed(temperature: f64, salinity: f64, depth: f64) -> f64 {
    let (t, s, d) = (temperature, salinity - 35.0, depth);
    let of_temperature = polynomial(t, &[1448.96, 4.591, -5.304e-2, 2.374e-4]);
    let of_depth = d * (1.630e-2 + d * 1.675e-7);
    of_temperature + 1.340 * s + of_depth - 1.025e-2 * t * s - 7.139e-13 * t * d * d * d
}

/// The conductivity that the practical salinity scale derives a salinity from (PSS-78: UNESCO Technical Papers in Marine Science
/// 44, 1983, pp. 6-12), S/m, at a temperature (degrees Celsius) and a pressure (decibars). A depth in metres goes for the pressure: it is
/// 1 % off at most above 1000 m.
pub fn conductivity(temperature: f64, salinity: f64, pressure: f64) -> f64 {
    STANDARD * ratio(temperature, salinity, pressure)
}

/// Conductivity over that of standard sea water, salinity 35, at 15 degrees and the surface: the scale turned round.
fn ratio(temperature: f64, salinity: f64, pressure: f64) -> f64 {
    let t = temperature;
    // Salinity grows with its conductivity: between these roots of R_t lies every salinity that there is.
    let (mut low, mut high) = (0.0, 1.5);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if scale(middle, t) < salinity { low = middle } else { high = middle }
    }
    let root = 0.5 * (low + high);
    let r_t = polynomial(t, &[0.676_609_7, 2.005_64e-2, 1.104_259e-4, -6.969_8e-7, 1.003_1e-9]);
    let at_surface = root * root * r_t;
    // R = at_surface (1 + c / (a + b R)): a quadratic equation in R.
    let a = polynomial(t, &[1.0, 3.426e-2, 4.464e-4]);
    let b = 4.215e-1 - 3.107e-3 * t;
    let c = pressure * polynomial(pressure, &[2.070e-5, -6.370e-10, 3.989e-15]);
    let linear = a - b * at_surface;
    ((linear * linear + 4.0 * b * at_surface * (a + c)).sqrt() - linear) / (2.0 * b)
}

/// The practical salinity of a root of R_t at a temperature.
fn scale(root: f64, temperature: f64) -> f64 {
    let off = temperature - 15.0;
    polynomial(root, &[0.0080, -0.1692, 25.3851, 14.0941, -7.0261, 2.7081])
        + off / (1.0 + 0.0162 * off) * polynomial(root, &[0.0005, -0.0056, -0.0066, -0.0375, 0.0636, -0.0144])
}

fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Conductivity of standard sea water, salinity 35, at 15 degrees and the surface, S/m (Culkin & Smith 1980).
const STANDARD: f64 = 4.2914;
/// Halvings after which a double cannot be halved further.
const HALVINGS: u32 = 60;

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn close(value: f64, expected: f64, within: f64) {
        assert!((value - expected).abs() < within, "{value}, not {expected}");
    }

    /// The check values that the papers print.
    #[test]
    fn the_papers_check_values() {
        close(sound_speed(25.0, 35.0, 1000.0), 1550.744, 5e-4);
        close(ratio(15.0, 35.0, 0.0), 1.0, 1e-6);
        close(ratio(40.0, 40.0, 10_000.0), 1.888_091, 1e-6);
    }

    #[test]
    fn water_without_salt_does_not_conduct_and_salinity_is_found_again() {
        close(conductivity(10.0, 0.0, 0.0), 0.0, 1e-3);
        for (t, s) in [(-2.0, 33.0), (10.0, 35.0), (25.0, 5.0), (40.0, 42.0)] {
            let r_t = polynomial(t, &[0.676_609_7, 2.005_64e-2, 1.104_259e-4, -6.969_8e-7, 1.003_1e-9]);
            close(scale((ratio(t, s, 0.0) / r_t).sqrt(), t), s, 1e-9);
        }
    }
}
