//! What the vehicle believes of its position: a navigator that is given a noisy velocity, and noisy fixes.

use super::InstrumentSetup;
use super::delay::Delay;
use super::raw::{RawSample, RawSensor};
use crate::noise::{Noise, Stream};
use crate::scenario::ScenarioIssues;
use albacore_geometry::math::TAU;
use albacore_geometry::{Heading, Point, Vector};
use albacore_navigation::{Departure, Estimate, Fix, Inertial, Navigator, NavigatorSetup, Sensed};
use albacore_vehicle::TICK_S;
use serde::Deserialize;

/// How the vehicle knows its position: a navigator that begins at a known start, and acoustic fixes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Navigation {
    /// What makes a position of what is sensed. Default dead reckoning whose error grows by 0.05 m/s^0.5.
    #[serde(default, rename = "filter")]
    pub navigator: NavigatorSetup,
    /// Long-baseline fixes. Default none.
    #[serde(rename = "fixes")]
    pub lbl: Option<Lbl>,
}

/// Long-baseline acoustic fixes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lbl {
    /// Time between fixes, s; the first comes after one such time. Default 120.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 2.
    pub sigma: f64,
    /// A fix is taken only if it disagrees with the estimate by more than this, m. Default 0: always.
    pub gate: f64,
    /// The share of fixes that are outliers: reflections, heard for the direct way. Default 0.
    pub outliers: f64,
    /// How far an outlier is off, m, in any direction. Default 50.
    pub outlier: f64,
    /// The transponders drift with this velocity, m/s, and all fixes with them. Default none.
    pub drift: Vector,
    /// Between a fix's moment and its coming, s. Default 0.
    pub delay: f64,
}

impl Default for Lbl {
    fn default() -> Self {
        Lbl { every: 120.0, sigma: 2.0, gate: 0.0, outliers: 0.0, outlier: 50.0, drift: Vector::ZERO, delay: 0.0 }
    }
}

/// Satellite fixes at the surface.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gps {
    /// Time between fixes, s. Default 1.
    pub every: f64,
    /// Standard deviation of a fix, m an axis. Default 5.
    pub sigma: f64,
    /// The antenna is out of the water above this depth, m. Default 0.3.
    pub above: f64,
    /// The constant error of its fixes, m. Default none.
    pub bias: Vector,
    /// Between a fix's moment and its coming, s. Default 0.
    pub delay: f64,
}

impl Default for Gps {
    fn default() -> Self {
        Gps { every: 1.0, sigma: 5.0, above: 0.3, bias: Vector::ZERO, delay: 0.0 }
    }
}

/// The vehicle's own navigation, or the truth where a scenario has none.
#[derive(Clone, Debug)]
pub struct Positioning(Option<Navigated>);

#[derive(Clone, Debug)]
struct Navigated {
    navigator: Box<dyn Navigator>,
    /// Standard deviation of the measured velocity, m/s an axis.
    deviation: f64,
    velocity_noise: Noise,
    lbl: Option<Lbl>,
    fix_noise: Noise,
    outliers: Noise,
    gps: Option<Gps>,
    gps_noise: Noise,
    /// Fixes on their way.
    lbl_fixes: Delay<Point>,
    gps_fixes: Delay<Point>,
    /// The velocity that the Doppler log told last, m/s.
    velocity: Vector,
}

impl Positioning {
    /// Begins at the true start: the last thing a vehicle had before it dived was a satellite fix.
    pub fn new(navigation: Option<&Navigation>, gps: Option<&Gps>, departure: &Departure, seed: u64) -> Self {
        Positioning(navigation.map(|navigation| Navigated {
            navigator: navigation.navigator.begin(departure),
            // White noise of this deviation, held over a tick, integrates to the random walk.
            deviation: navigation.navigator.velocity_walk() / TICK_S.sqrt(),
            velocity_noise: Noise::new(seed, Stream::GroundVelocity),
            lbl: navigation.lbl.clone(),
            fix_noise: Noise::new(seed, Stream::Lbl),
            outliers: Noise::new(seed, Stream::LblOutlier),
            gps: gps.cloned(),
            gps_noise: Noise::new(seed, Stream::Gps),
            lbl_fixes: Delay::new(navigation.lbl.as_ref().map_or(0.0, |lbl| lbl.delay)),
            gps_fixes: Delay::new(gps.map_or(0.0, |gps| gps.delay)),
            velocity: Vector::ZERO,
        }))
    }

    /// Lets one tick go by, in which the vehicle measured a velocity over ground (m/s), if it could, and its heading.
    pub fn reckon(&mut self, tick: u64, measured: Option<Vector>, heading: Heading) {
        let Some(own) = &mut self.0 else { return };
        let velocity = measured.unwrap_or(own.velocity);
        own.velocity = velocity;
        let ground_velocity =
            if own.deviation > 0.0 { velocity + own.deviation * pair(own.velocity_noise, tick) } else { velocity };
        own.navigator.predict(&Sensed { ground_velocity, heading }, TICK_S);
    }

    /// The fixes that come at a tick, of a vehicle at a point and a depth, m.
    pub fn measure(&mut self, tick: u64, position: Point, depth: f64, raw: &mut Vec<RawSample>) {
        let Some(own) = &mut self.0 else { return };
        let fix = |sensor, at: Point| RawSample::new(sensor, 0, [at.north, at.east]);
        if let Some(lbl) = &own.lbl {
            let ticks = ((lbl.every / TICK_S).round() as u64).max(1);
            let told = || position + lbl.sigma * pair(own.fix_noise, tick) + lbl_error(lbl, tick, own.outliers);
            let came = own.lbl_fixes.pass(tick, tick.is_multiple_of(ticks).then(told));
            raw.extend(came.map(|at| fix(RawSensor::AcousticFixes, at)));
        }
        if let Some(gps) = &own.gps {
            let ticks = ((gps.every / TICK_S).round() as u64).max(1);
            let told = || position + gps.sigma * pair(own.gps_noise, tick) + gps.bias;
            let hears = depth < gps.above && tick.is_multiple_of(ticks);
            let came = own.gps_fixes.pass(tick, hears.then(told));
            raw.extend(came.map(|at| fix(RawSensor::SatelliteFixes, at)));
        }
    }

    /// Takes the fixes that came.
    pub fn take(&mut self, raw: &[RawSample]) {
        let Some(own) = &mut self.0 else { return };
        for sample in raw {
            let (sigma, gate) = match (sample.sensor, &own.lbl, &own.gps) {
                (RawSensor::AcousticFixes, Some(lbl), _) => (lbl.sigma, lbl.gate),
                (RawSensor::SatelliteFixes, _, Some(gps)) => (gps.sigma, 0.0),
                _ => continue,
            };
            let [north, east] = sample.array();
            if north.is_finite() && east.is_finite() {
                own.navigator.update(&Fix { position: Point::new(north, east), sigma, gate });
            }
        }
    }

    /// What makes a position of what is sensed; none where the truth is known.
    pub fn navigator(&mut self) -> Option<&mut (dyn Navigator + 'static)> {
        self.0.as_mut().map(|own| own.navigator.as_mut())
    }

    /// The same, where it is an inertial one.
    pub fn inertial(&self) -> Option<&Inertial> {
        self.0.as_ref().and_then(|own| own.navigator.inertial())
    }

    /// Where the vehicle believes it is.
    pub fn belief(&self, truth: Point) -> Estimate {
        self.0.as_ref().map_or(Estimate { position: truth, sigma: 0.0 }, |own| own.navigator.estimate())
    }
}

/// Two numbers of a stream at a tick.
fn pair(noise: Noise, tick: u64) -> Vector {
    Vector::new(noise.gaussian(2 * tick), noise.gaussian(2 * tick + 1))
}

/// What a fix is off by beside its noise, m: the way of the transponders, and now and then a reflection.
fn lbl_error(lbl: &Lbl, tick: u64, outliers: Noise) -> Vector {
    let drifted = tick as f64 * TICK_S * lbl.drift;
    let is_outlier = lbl.outliers > 0.0 && outliers.uniform(2 * tick) < lbl.outliers;
    if !is_outlier {
        return drifted;
    }
    drifted + lbl.outlier * Heading::from_radians(TAU * outliers.uniform(2 * tick + 1)).unit()
}

/// What of it cannot be.
pub(super) fn check(setup: &InstrumentSetup, issues: &mut ScenarioIssues) {
    if let Some(lbl) = setup.navigation.as_ref().and_then(|navigation| navigation.lbl.as_ref()) {
        issues.of("lbl").at_most("drift", lbl.drift.length(), LBL_DRIFT_MAX);
    }
    if let Some(gps) = &setup.gps {
        let mut of = issues.of("gps");
        of.at_most("bias", gps.bias.length(), GPS_BIAS_MAX);
        of.unless(
            None,
            setup.navigation.is_some(),
            "`gps` needs a `navigation`: without one the vehicle knows its position exactly",
            "add `navigation(dead_reckoning())` to the scenario, or leave `gps` out",
        );
    }
}

/// Transponders drift no faster than this, m/s.
const LBL_DRIFT_MAX: f64 = 1.0;
/// No constant error of a fix is larger, m.
const GPS_BIAS_MAX: f64 = 1000.0;

#[cfg(test)]
mod tests {
    use super::super::inertial::departure;
    use super::*;
    use crate::craft::hull::StartPose;
    use crate::scenario::Scenario;
    use crate::world::World;

    /// Dead reckoning with a perfect velocity.
    const PERFECT: NavigatorSetup = NavigatorSetup::DeadReckoning { walk: 0.0 };

    /// Begins at the origin.
    fn begun(navigation: &Navigation, gps: Option<&Gps>, seed: u64) -> Positioning {
        let world = World::new(&Scenario::default(), seed);
        let departure = departure(&InstrumentSetup::default(), &world, &StartPose::default(), 1.0, seed);
        Positioning::new(Some(navigation), gps, &departure, seed)
    }

    /// A tick.
    fn step(own: &mut Positioning, tick: u64, measured: Option<Vector>, position: Point, depth: f64) {
        let mut raw = Vec::new();
        own.reckon(tick, measured, Heading::NORTH);
        own.measure(tick, position, depth, &mut raw);
        own.take(&raw);
    }

    /// Over many runs: the error before the first fix is the walk's, after it the fix's, and sigma tells both.
    #[test]
    fn sigma_is_the_error_to_expect() {
        let navigation = Navigation { lbl: Some(Lbl::default()), ..Navigation::default() };
        let mut errors = [0.0; 2];
        let mut sigmas = [0.0; 2];
        for seed in 0..400 {
            let mut own = begun(&navigation, None, seed);
            let velocity = Vector::new(2.0, 0.0);
            for tick in 1..=1200 {
                let truth = Point::new(0.2 * tick as f64, 0.0);
                step(&mut own, tick, Some(velocity), truth, 3.0);
                if tick >= 1199 {
                    let Estimate { position, sigma } = own.belief(truth);
                    let error = position - truth;
                    errors[tick as usize - 1199] += error.dot(error) / 800.0;
                    sigmas[tick as usize - 1199] = sigma;
                }
            }
        }
        for (error, sigma) in errors.into_iter().zip(sigmas) {
            assert!((f64::sqrt(error) / sigma - 1.0).abs() < 0.08, "{} where {sigma} is expected", f64::sqrt(error));
        }
        assert!((sigmas[0] - 0.5475).abs() < 0.001 && sigmas[1] == 2.0);
    }

    /// Where a vehicle at rest believes to be after each fix.
    fn believed(lbl: Option<Lbl>, gps: Option<&Gps>, depth: f64) -> Vec<Vector> {
        let mut own = begun(&Navigation { navigator: PERFECT, lbl }, gps, 5);
        let fixes = (1..=60_000).filter_map(|tick| {
            step(&mut own, tick, Some(Vector::ZERO), Point::ORIGIN, depth);
            (tick % 10 == 0).then(|| own.belief(Point::ORIGIN).position - Point::ORIGIN)
        });
        fixes.collect()
    }

    #[test]
    fn outliers_come_as_often_and_lie_as_far_as_told_and_transponders_drift() {
        let exact = Lbl { every: 1.0, sigma: 0.0, ..Lbl::default() };
        let far = believed(Some(Lbl { outliers: 0.1, outlier: 80.0, ..exact.clone() }), None, 3.0);
        let outliers: Vec<&Vector> = far.iter().filter(|error| error.length() > 1.0).collect();
        assert!(outliers.iter().all(|error| (error.length() - 80.0).abs() < 1e-9));
        assert!((540..660).contains(&outliers.len()), "one in ten of 6000: {}", outliers.len());
        let drifted = believed(Some(Lbl { drift: Vector::new(0.01, 0.0), ..exact }), None, 3.0);
        assert!((drifted[5999].north - 60.0).abs() < 1e-9);
    }

    /// A late fix tells where the vehicle was, and takes it back by its way since.
    #[test]
    fn a_late_fix_is_of_where_the_vehicle_was() {
        let lbl = Lbl { every: 10.0, sigma: 0.0, delay: 2.0, ..Lbl::default() };
        let mut own = begun(&Navigation { navigator: PERFECT, lbl: Some(lbl) }, None, 1);
        let at = |tick: u64| Point::new(0.2 * tick as f64, 0.0);
        let errors: Vec<f64> = (1..=130)
            .map(|tick| {
                step(&mut own, tick, Some(Vector::new(2.0, 0.0)), at(tick), 3.0);
                (own.belief(at(tick)).position - at(tick)).north
            })
            .collect();
        assert!(errors[118].abs() < 1e-9 && (errors[119] + 4.0).abs() < 1e-9, "{:?}", &errors[115..]);
    }

    #[test]
    fn satellites_are_heard_at_the_surface_only() {
        let gps = Gps::default();
        let errors = believed(None, Some(&gps), 0.1);
        let deviation = (errors.iter().map(|e| e.dot(*e)).sum::<f64>() / 12_000.0).sqrt();
        assert!((deviation - 5.0).abs() < 0.2, "{deviation}");
        let off = believed(None, Some(&Gps { sigma: 0.0, bias: Vector::new(3.0, -2.0), ..gps.clone() }), 0.1);
        assert_eq!(off[100], Vector::new(3.0, -2.0));
        assert!(believed(None, Some(&gps), 0.4).iter().all(|error| *error == Vector::ZERO));
    }

    #[test]
    fn without_a_velocity_the_last_one_holds() {
        let mut own = begun(&Navigation { navigator: PERFECT, lbl: None }, None, 1);
        (1..=10).for_each(|tick| step(&mut own, tick, Some(Vector::new(2.0, 0.0)), Point::ORIGIN, 3.0));
        (11..=20).for_each(|tick| step(&mut own, tick, None, Point::ORIGIN, 3.0));
        assert!(own.belief(Point::ORIGIN).position.distance(Point::new(4.0, 0.0)) < 1e-9);
    }
}
