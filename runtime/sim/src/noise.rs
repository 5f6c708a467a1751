//! Random numbers as a pure function of seed, stream and index, so that any draw can be made at any time in any order.

use crate::normal::inverse_normal;

/// 2^64 over the golden ratio, odd: the increment of SplitMix64.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Set in the number of every named stream, and of no other.
const NAMED: u64 = 1 << 63;

/// What a stream of random numbers is used for: one each, so that a new sensor changes no other's noise.
///
/// The numbers are part of every recorded run. Never renumber. What comes new has a [name](Noise::named) instead, where it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub enum Stream {
    /// Coloured noise at the corners of the flow grid.
    FlowCorners = 1,
    /// Times between releases; one sub-stream a source.
    Release = 2,
    /// Diffusion of filaments; one sub-stream a source.
    Diffusion = 3,
    /// Vertical diffusion of young filaments; one sub-stream a source.
    VerticalDiffusion = 4,
    /// Altitude wobble of the vehicle.
    AltitudeJitter = 5,
    /// Noise of the chemical sensor.
    Fluorometer = 6,
    /// False alarms of the chemical sensor.
    FalseAlarm = 7,
    /// Noise of the acoustic Doppler current profiler.
    Adcp = 8,
    /// Noise of the velocity over ground that dead reckoning integrates.
    GroundVelocity = 9,
    /// Noise of the acoustic position fixes.
    Lbl = 10,
    /// Noise of the echo sounder.
    Sounder = 11,
    /// Where the vehicle starts.
    Start = 12,
    /// Phases of surface waves.
    Waves = 20,
    /// Where along a leak its filaments are released; one sub-stream a source.
    Leak = 21,
    /// Where the filaments of a patch are; one sub-stream a patch.
    Patch = 22,
    /// What faulty sensors tell; one sub-stream a fault.
    Fault = 60,
    /// Where wrong positions and flows are off; one sub-stream a fault.
    FaultDirection = 61,
    /// Noise of the compass.
    Compass = 62,
    /// Noise of the pressure gauge.
    Pressure = 63,
    /// Which echoes of the sounder are lost.
    SounderDropout = 64,
    /// Which acoustic fixes are outliers, and where they lie.
    LblOutlier = 65,
    /// Noise of satellite fixes.
    Gps = 66,
    /// Noise of the Doppler log.
    Dvl = 67,
    /// The moment at which a recorded plume is begun.
    RecordStart = 80,
    /// Noise of the temperature of the CTD.
    CtdTemperature = 90,
    /// Noise of the salinity of the CTD.
    CtdSalinity = 91,
    /// Noise of the battery's gauge.
    Battery = 92,
}

/// One stream of random numbers of one run: a counter-based generator.
///
/// Draw `i` is SplitMix64's finaliser over `key + (i + 1) * 0x9E3779B97F4A7C15` (Steele, Lea & Flood, OOPSLA 2014), where the
/// key is a mixing of the run's seed with the stream: a stream is SplitMix64 begun at a random place of its period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Noise {
    key: u64,
}

impl Noise {
    /// The stream of a run.
    pub fn new(seed: u64, stream: Stream) -> Self {
        Noise::sub(seed, stream, 0)
    }

    /// The stream of a run that has this name, and no other place draws from. The name is part of every recorded run.
    pub fn named(seed: u64, name: &str) -> Self {
        Noise::keyed(seed, NAMED | u64::from(name_hash(name)))
    }

    /// One of several like streams of a run: one for each source, say.
    pub fn sub(seed: u64, stream: Stream, number: u32) -> Self {
        Noise::keyed(seed, (stream as u64) << 32 | u64::from(number))
    }

    fn keyed(seed: u64, stream: u64) -> Self {
        Noise { key: mix(mix(seed.wrapping_add(GOLDEN)) ^ mix(stream.wrapping_mul(GOLDEN))) }
    }

    /// 64 random bits.
    #[inline]
    pub fn bits(self, index: u64) -> u64 {
        mix(self.key.wrapping_add(index.wrapping_add(1).wrapping_mul(GOLDEN)))
    }

    /// Uniform in [0, 1): the top 53 bits.
    #[inline]
    pub fn uniform(self, index: u64) -> f64 {
        (self.bits(index) >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Gaussian of mean 0 and standard deviation 1: the inverse normal distribution function of one uniform draw.
    pub fn gaussian(self, index: u64) -> f64 {
        // The middle of each of the 2^53 intervals, so that neither end of the line is ever drawn.
        inverse_normal(((self.bits(index) >> 11) as f64 + 0.5) * (1.0 / 9_007_199_254_740_992.0))
    }

    /// Three nearly Gaussian numbers of mean 0 and variance 1 from a single draw, for where millions are needed.
    ///
    /// Each is a sum of three times seven bits, scaled: bounded by 2.98, excess kurtosis -0.4, on a lattice of 1/64. A filament sums
    /// many of them, and the excess kurtosis of a sum of n is -0.4/n.
    #[inline]
    pub fn nearly_gaussian_triple(self, index: u64) -> [f64; 3] {
        /// Seven bits of each 21.
        const SEVEN: u64 = 0x7F | 0x7F << 21 | 0x7F << 42;
        let bits = self.bits(index);
        let sums = (bits & SEVEN) + (bits >> 7 & SEVEN) + (bits >> 14 & SEVEN);
        // Seven bits have mean 63.5 and variance (128^2 - 1) / 12.
        const SCALE: f64 = 0.015_625_476_858_987_19;
        let unit = |sum: u64| (f64::from((sum & 0x1FF) as u32) - 190.5) * SCALE;
        [unit(sums), unit(sums >> 21), unit(sums >> 42)]
    }
}

/// FNV-1a (Fowler, Noll & Vo), 32 bits: two of a thousand names are alike once in eight thousand times.
fn name_hash(name: &str) -> u32 {
    name.bytes().fold(0x811C_9DC5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// SplitMix64's finaliser: Stafford's mix 13.
#[inline]
fn mix(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SplitMix64 begun at 0 has published first outputs: index i of key 0 must be its i-th.
    #[test]
    fn the_generator_is_splitmix64() {
        let zero = Noise { key: 0 };
        assert_eq!(zero.bits(0), 0xE220_A839_7B1D_CDAF);
        assert_eq!(zero.bits(1), 0x6E78_9E6A_A1B9_65F4);
        assert_eq!(zero.bits(2), 0x06C4_5D18_8009_454F);
    }

    /// The first draws of a run's stream, for ever: they fix how the key is mixed. (Computed with another program.)
    #[test]
    fn first_draws_of_a_stream() {
        let noise = Noise::new(1, Stream::Adcp);
        assert_eq!((noise.bits(0), noise.bits(1)), (0xF60F_1037_BF2A_1436, 0x827B_9DAF_3675_3877));
        assert_eq!(noise.uniform(0).to_bits(), 0x3FEE_C1E2_06F7_E542);
        assert_eq!(noise.gaussian(0).to_bits(), 0x3FFC_3AF7_79B7_A884);
        assert_eq!(Noise::sub(1, Stream::Diffusion, 1).bits(7), 0x80D9_4FC3_61FD_EFF2);
        // FNV-1a has published values.
        assert_eq!((name_hash(""), name_hash("a"), name_hash("foobar")), (0x811C_9DC5, 0xE40C_292C, 0xBF9C_F968));
        assert_eq!(Noise::named(1, "foobar").bits(0), 0x022B_0ECE_644A_9931);
    }

    #[test]
    fn moments_of_both_gaussians() {
        let noise = Noise::new(3, Stream::Lbl);
        let n = 200_000;
        let moments = |draw: &dyn Fn(u64) -> f64| {
            let power = |p: u32| (0..n).map(|i| (0..p).fold(1.0, |x, _| x * draw(i))).sum::<f64>() / n as f64;
            (power(1), power(2), power(3), power(4))
        };
        for (draw, kurtosis) in [
            (&(|i| noise.gaussian(i)) as &dyn Fn(u64) -> f64, 3.0),
            (&|i| noise.nearly_gaussian_triple(i)[0], 2.6),
            (&|i| noise.nearly_gaussian_triple(i)[1], 2.6),
            (&|i| noise.nearly_gaussian_triple(i)[2], 2.6),
            (&|i| noise.nearly_gaussian_triple(i)[0] * noise.nearly_gaussian_triple(i)[1], 6.76),
            (&|i| noise.nearly_gaussian_triple(i)[0] * noise.nearly_gaussian_triple(i)[2], 6.76),
            (&|i| noise.nearly_gaussian_triple(i)[1] * noise.nearly_gaussian_triple(i)[2], 6.76),
        ] {
            let (mean, variance, skew, fourth) = moments(draw);
            assert!(mean.abs() < 0.01, "mean {mean}");
            assert!((variance - 1.0).abs() < 0.015, "variance {variance}");
            assert!(skew.abs() < 0.05, "skewness {skew}");
            assert!((fourth - kurtosis).abs() < 0.04 * kurtosis, "kurtosis {fourth} not {kurtosis}");
        }
    }

    #[test]
    fn streams_seeds_and_indices_are_unrelated() {
        let n = 20_000;
        let streams = [
            Noise::new(1, Stream::Adcp),
            Noise::new(2, Stream::Adcp),
            Noise::new(1, Stream::Lbl),
            Noise::sub(1, Stream::Adcp, 1),
            Noise::named(1, "light"),
            Noise::named(1, "sound"),
        ];
        for (i, a) in streams.iter().enumerate() {
            for b in &streams[i + 1..] {
                let correlation = (0..n).map(|k| a.gaussian(k) * b.gaussian(k)).sum::<f64>() / n as f64;
                assert!(correlation.abs() < 0.03, "{correlation}");
            }
            let next = (0..n).map(|k| a.gaussian(k) * a.gaussian(k + 1)).sum::<f64>() / n as f64;
            assert!(next.abs() < 0.03, "{next}");
        }
    }
}
