//! The acoustic Doppler current profiler, which looks up and down by turns, and the flow estimate fed by it.

use super::delay::Delay;
use super::{AtRest, Instrument, Surroundings};
use crate::noise::{Noise, Stream};
use crate::scenario::number;
use albacore_geometry::{Heading, Vector};
use albacore_navigation::{AdcpMessage, BodyVelocity, FlowEstimate, FlowGates};
use albacore_vehicle::Snapshot;
use albacore_vehicle::measurements::{FLOW, FLOW_BELOW};
use albacore_vehicle::rate::{is_due, sample};
use serde::Deserialize;

/// The flow sensor: an acoustic Doppler current profiler that looks up and down by turns. Its defaults are those of the
/// 2005 paper's Appendix B.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Adcp {
    /// Standard deviation of each component of the velocity of one bin, m/s. Default 0.05.
    pub noise: f64,
    /// Its constant error, m/s: so much too fast through the water, ahead. Default 0.
    pub bias: f64,
    /// It measures nothing nearer than this, m: it is still ringing. Default 0.75.
    pub blanking: f64,
    /// The thickness of a bin, m. Default 0.5.
    pub bin: f64,
    /// The flow is averaged over so many bins, the nearest that are valid. Default 1.
    pub count: u32,
    /// Which looks the flow is estimated from. Default upward.
    #[serde(default)]
    pub looks: Looks,
    /// Looks a second. Default 1.
    pub rate: f64,
    /// Between a look and the estimate that it enters, s. Default 0.
    pub delay: f64,
    /// What a look must be to enter the estimate. Default that of the 2005 paper.
    #[serde(flatten)]
    pub gates: FlowGates,
}

impl Default for Adcp {
    fn default() -> Self {
        let gates = FlowGates::default();
        Adcp {
            noise: 0.05,
            bias: 0.0,
            blanking: 0.75,
            bin: 0.5,
            count: 1,
            looks: Looks::Up,
            rate: 1.0,
            delay: 0.0,
            gates,
        }
    }
}

impl Adcp {
    /// Why a vehicle at rest has no flow.
    pub(super) fn silence(&self, lies: &AtRest) -> Option<String> {
        let gates = &self.gates;
        // A flow that is taken for an error carries no sample either.
        let is_slow = lies.drift.min(gates.fastest) <= gates.over_ground;
        let is_out = is_slow || lies.depth <= gates.depth || lies.altitude <= gates.altitude;
        is_out.then(|| {
            format!(
                "its profiler measures where it swims: faster than {} m/s over ground, deeper than {} m and more than {} m above \
                 the bottom",
                number(gates.over_ground),
                number(gates.depth),
                number(gates.altitude)
            )
        })
    }
}

/// The flow below the vehicle, told beside the flow: what the downward looks of a profiler see. Its settings are those of an [`Adcp`], whose `looks`
/// are downward whatever they say.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct LowerAdcp(Adcp);

impl LowerAdcp {
    /// Why a vehicle at rest has no sample of it.
    pub(super) fn silence(&self, lies: &AtRest) -> Option<String> {
        self.0.silence(lies)
    }
}

/// The looks of the profiler that the flow is estimated from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Looks {
    /// Upward: every other one, as the 2005 paper has it.
    #[default]
    Up,
    /// Downward: every other one.
    Down,
    /// Both.
    Both,
}

/// Near the bottom the echo of the side lobes, which go straight down, drowns that of the beams, which go 20 degrees aslant: the
/// last 1 - cos 20 deg of the altitude cannot be measured (Teledyne RD Instruments, Principles of Operation, 2011).
const SIDE_LOBE_SHARE: f64 = 0.06;

/// What the profiler sees of the vehicle.
#[derive(Clone, Copy, Debug)]
struct View {
    /// Velocity over ground, m/s.
    ground_velocity: Vector,
    /// Where the nose points.
    heading: Heading,
    /// Where the compass says that it points: the estimate turns by it.
    compass: Heading,
    /// Depth, m.
    depth: f64,
    /// Height above the bottom, m.
    altitude: f64,
}

/// Where the profiler looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    Up,
    Down,
}

/// The profiler.
#[derive(Clone, Debug)]
pub struct Profiler {
    settings: Adcp,
    /// What it tells.
    measurement: u16,
    /// Of each bin, one stream.
    noise: Vec<Noise>,
    estimate: FlowEstimate,
    delay: Delay<Vector>,
    /// The latest that it told.
    told: Vector,
}

impl Profiler {
    /// The profiler of a run.
    pub fn new(settings: &Adcp, seed: u64) -> Self {
        let noise = (0..settings.count).map(|bin| Noise::sub(seed, Stream::Adcp, bin)).collect();
        Profiler::of(settings.clone(), FLOW, noise)
    }

    /// The one of a run that looks below the vehicle.
    pub fn below(LowerAdcp(settings): &LowerAdcp, seed: u64) -> Self {
        let noise = (0..settings.count).map(|bin| Noise::named(seed, &format!("lower adcp, bin {bin}"))).collect();
        Profiler::of(Adcp { looks: Looks::Down, ..settings.clone() }, FLOW_BELOW, noise)
    }

    fn of(settings: Adcp, measurement: u16, noise: Vec<Noise>) -> Self {
        let estimate = FlowEstimate::new(settings.gates.clone());
        let delay = Delay::new(settings.delay);
        Profiler { settings, measurement, noise, estimate, delay, told: Vector::ZERO }
    }

    /// The flow that it told last, m/s toward; none at first.
    pub fn last_sample(&self) -> Vector {
        self.told
    }

    /// The mean flow that it tells at a tick, m/s toward; `flow_at` is the velocity of the water at a height above the bottom (m).
    fn sample(&mut self, tick: u64, view: &View, flow_at: impl Fn(f64) -> Vector) -> Option<Vector> {
        let mean = self.mean(tick, view, flow_at);
        self.delay.pass(tick, mean)
    }

    /// The mean flow, m/s toward, if a message comes at this tick and enough have been heard.
    ///
    /// All noise is put on the velocity through the water: a flow sample is the difference of both, so no more can be told
    /// from it. A look without a valid bin tells an exact zero, which the estimate takes for a missing value: the mean stays.
    fn mean(&mut self, tick: u64, view: &View, flow_at: impl Fn(f64) -> Vector) -> Option<Vector> {
        let look = self.look(tick)?;
        self.estimate.hear(&AdcpMessage {
            over_ground: BodyVelocity::of_tangent(view.ground_velocity, view.heading),
            through_water: self.through_water(tick, look, view, flow_at).unwrap_or_default(),
            heading: view.compass,
            depth: view.depth,
            altitude: view.altitude,
        });
        self.estimate.mean()
    }

    /// Where it looks at this tick, if a message comes and is listened to: of the upward and of the downward look by turns (the
    /// 2005 paper, App. B).
    fn look(&self, tick: u64) -> Option<Look> {
        let turn = is_due(self.settings.rate, tick).then_some(sample(self.settings.rate, tick))?;
        let look = if turn.is_multiple_of(2) { Look::Up } else { Look::Down };
        let is_heard = match self.settings.looks {
            Looks::Up => look == Look::Up,
            Looks::Down => look == Look::Down,
            Looks::Both => true,
        };
        is_heard.then_some(look)
    }

    /// The velocity through the water, the mean of the valid bins; none if there are none.
    fn through_water(
        &self,
        tick: u64,
        look: Look,
        view: &View,
        flow_at: impl Fn(f64) -> Vector,
    ) -> Option<BodyVelocity> {
        let Adcp { noise: deviation, bias, blanking, bin, .. } = self.settings;
        let mut sum = (Vector::ZERO, 0.0, 0.0);
        let mut count = 0;
        for (number, noise) in (0_u32..).zip(&self.noise) {
            let middle = blanking + (f64::from(number) + 0.5) * bin;
            let height = match look {
                // The paper's own condition on its bin, 1 m above: depth > 1 m.
                Look::Up if middle < view.depth => view.altitude + middle,
                Look::Down if middle + 0.5 * bin <= (1.0 - SIDE_LOBE_SHARE) * view.altitude => view.altitude - middle,
                // Those beyond are invalid too.
                _ => break,
            };
            let noise = |component: u64| deviation * noise.gaussian(2 * tick + component);
            sum = (sum.0 + flow_at(height), sum.1 + noise(0), sum.2 + noise(1));
            count += 1;
        }
        if count == 0 {
            return None;
        }
        let share = 1.0 / f64::from(count);
        let (flow, ahead, starboard) = (share * sum.0, share * sum.1, share * sum.2);
        let through_water = BodyVelocity::of_tangent(view.ground_velocity - flow, view.heading);
        Some(BodyVelocity { ahead: through_water.ahead + ahead + bias, starboard: through_water.starboard + starboard })
    }
}

impl Instrument for Profiler {
    fn measure(&mut self, around: &mut Surroundings, snapshot: &mut Snapshot) {
        let truth = around.truth;
        let view = View {
            ground_velocity: around.ground_velocity,
            heading: truth.heading,
            compass: around.compass,
            depth: truth.depth,
            altitude: truth.altitude,
        };
        let flow_at = |height| around.world.flow(truth.position, height, around.time_s()) + around.current;
        if let Some(flow) = self.sample(around.tick, &view, flow_at) {
            self.told = flow;
            snapshot.push(self.measurement, &[flow.north, flow.east]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without noise, 2 m above the bottom of 8 m of water, at 2 m/s toward the east.
    fn view() -> View {
        let heading = Heading::from_degrees(90.0);
        View { ground_velocity: 2.0 * heading.unit(), heading, compass: heading, depth: 6.0, altitude: 2.0 }
    }

    fn quiet(looks: Looks) -> Adcp {
        Adcp { noise: 0.0, looks, ..Adcp::default() }
    }

    /// The flow that is estimated in 40 s where a flow toward north grows with the height above the bottom, 0.1 m/s a metre: its
    /// northward component over that tells the height at which it was measured.
    fn height(settings: &Adcp, view: &View) -> Option<f64> {
        let mut profiler = Profiler::new(settings, 1);
        let heard = (0..400).filter_map(|tick| profiler.mean(tick, view, |height| Vector::new(0.1 * height, 0.0)));
        heard.last().map(|flow| flow.north / 0.1)
    }

    fn is_about(height: Option<f64>, expected: f64) -> bool {
        height.is_some_and(|height| (height - expected).abs() < 1e-9)
    }

    #[test]
    fn the_first_bin_is_a_metre_above_or_below() {
        assert!(is_about(height(&quiet(Looks::Up), &view()), 3.0));
        assert!(is_about(height(&quiet(Looks::Down), &view()), 1.0));
        assert!(is_about(height(&quiet(Looks::Both), &view()), 2.0), "as many of the one as of the other");
        let far = Adcp { blanking: 0.2, bin: 0.8, ..quiet(Looks::Down) };
        assert!(is_about(height(&far, &view()), 2.0 - 0.6));
    }

    #[test]
    fn what_is_below_is_told_beside_what_is_above() {
        let mut below = Profiler::below(&LowerAdcp(quiet(Looks::Up)), 1);
        let shear = |height: f64| Vector::new(0.1 * height, 0.0);
        let heard = (0..400).filter_map(|tick| below.mean(tick, &view(), shear)).last();
        assert!(is_about(heard.map(|flow| flow.north / 0.1), 1.0));
        assert_eq!(below.measurement, FLOW_BELOW);
    }

    #[test]
    fn the_looks_take_turns_of_a_second() {
        let ticks = |looks| {
            let profiler = Profiler::new(&quiet(looks), 1);
            (0..60).filter_map(|tick| Some((tick, profiler.look(tick)?))).collect::<Vec<_>>()
        };
        assert_eq!(ticks(Looks::Up), [(0, Look::Up), (20, Look::Up), (40, Look::Up)]);
        assert_eq!(ticks(Looks::Down), [(10, Look::Down), (30, Look::Down), (50, Look::Down)]);
        let mut both = [ticks(Looks::Up), ticks(Looks::Down)].concat();
        both.sort_by_key(|(tick, _)| *tick);
        assert_eq!(ticks(Looks::Both), both);
    }

    /// The first bin ends 1.25 m below: 94 % of 1.3298 m.
    #[test]
    fn a_bin_that_the_bottom_drowns_is_invalid() {
        let down = quiet(Looks::Down);
        assert_eq!(height(&down, &View { altitude: 1.32, ..view() }), None);
        assert!(is_about(height(&down, &View { altitude: 1.34, ..view() }), 0.34));
        assert_eq!(height(&down, &View { altitude: 1.2, ..view() }), None, "below dead zone and bin");
        let both = quiet(Looks::Both);
        assert!(is_about(height(&both, &View { altitude: 1.32, ..view() }), 2.32), "what is above is left");
    }

    #[test]
    fn a_bin_above_the_surface_is_invalid() {
        let far = Adcp { blanking: 2.0, ..quiet(Looks::Up) };
        assert_eq!(height(&far, &View { depth: 2.2, ..view() }), None);
        assert!(is_about(height(&far, &View { depth: 2.3, altitude: 1.1, ..view() }), 1.1 + 2.25));
    }

    /// Of 2 m below, bins end at 1.25 and 1.75 m before the lowest 12 cm, and the third does not.
    #[test]
    fn several_bins_are_averaged_as_far_as_they_are_valid() {
        let down = |count| height(&Adcp { count, ..quiet(Looks::Down) }, &view());
        assert!(is_about(down(2), 2.0 - 1.25));
        assert!(is_about(down(5), 2.0 - 1.25), "as far as they are valid");
        // The third is 2 m above, which is above the surface.
        let up = |count| height(&Adcp { count, ..quiet(Looks::Up) }, &View { depth: 1.9, altitude: 1.1, ..view() });
        assert!(is_about(up(1), 1.1 + 1.0) && is_about(up(9), 1.1 + 1.25));
    }

    #[test]
    fn a_look_without_a_valid_bin_leaves_the_mean_as_it_was() {
        let mut profiler = Profiler::new(&quiet(Looks::Down), 1);
        let flow = Vector::new(0.0, 0.1);
        (0..400).for_each(|tick| _ = profiler.mean(tick, &view(), |_| flow));
        let low = View { altitude: 1.3, ..view() };
        let last = profiler.mean(410, &low, |_| -1.0 * flow).unwrap();
        assert!((last - flow).length() < 1e-12);
    }

    #[test]
    fn each_bin_has_noise_of_its_own_and_all_share_the_bias() {
        let spread = |count| {
            let profiler = Profiler::new(&Adcp { count, bias: 0.02, ..Adcp::default() }, 1);
            let still = |_| Vector::ZERO;
            let errors: Vec<BodyVelocity> = (0..2000)
                .filter_map(|i| profiler.through_water(20 * i, Look::Up, &view(), still))
                .map(|v| BodyVelocity { ahead: v.ahead - 2.0, ..v })
                .collect();
            assert_eq!(errors.len(), 2000);
            let mean = |part: fn(&BodyVelocity) -> f64| errors.iter().map(part).sum::<f64>() / 2000.0;
            let (ahead, starboard) = (mean(|e| e.ahead), mean(|e| e.starboard));
            assert!((ahead - 0.02).abs() < 0.004 && starboard.abs() < 0.004, "{ahead} {starboard}");
            mean(|e| e.starboard * e.starboard).sqrt()
        };
        assert!((spread(1) - 0.05).abs() < 0.003);
        assert!((spread(4) - 0.025).abs() < 0.0015);
    }
}
