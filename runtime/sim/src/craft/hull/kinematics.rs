//! How the vehicle moves: heading, speed and depth follow the command within limits on their rates, and the water carries it.

use super::{Motion, StartPose, Track};
use crate::craft::setup::KinematicHull;
use crate::noise::{Noise, Stream};
use albacore_geometry::math::exp;
use albacore_geometry::{Heading, Point, Vector};
use albacore_vehicle::{Command, TICK_S, Vertical};

/// A vehicle without forces.
#[derive(Clone, Debug)]
pub struct Kinematics {
    settings: KinematicHull,
    motion: Motion,
    /// Where a rudder is stuck: a share of its greatest deflection, positive to starboard.
    pub stuck_rudder: Option<f64>,
    jitter: Jitter,
    /// How fast it sank in the last tick, m/s.
    sinks: f64,
}

impl Kinematics {
    /// At rest in water that moves with `flow`.
    pub fn new(settings: &KinematicHull, berth: &StartPose, seed: u64) -> Self {
        let jitter = Jitter::new(settings, seed);
        Kinematics { settings: settings.clone(), motion: berth.motion(), stuck_rudder: None, jitter, sinks: 0.0 }
    }

    /// Where it is and how it moves.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Lets one tick go by, in water that moves with `flow`. Without a command the propeller stops and the vehicle drifts at
    /// its depth. `water_depth` tells the depth of the water at a point.
    ///
    /// Where it would come to lie on the bottom, or in it, it is aground: it stays where it was, at rest, until what is
    /// commanded leads up or away.
    pub fn step(
        &mut self,
        tick: u64,
        command: Option<&Command>,
        flow: Vector,
        water_depth: impl Fn(Point) -> f64,
        track: Option<&mut Track>,
    ) {
        let v = self.motion;
        let wanted_heading = command.map_or(v.heading, |c| c.heading);
        let wanted_speed = command.map_or(0.0, |c| c.speed.clamp(0.0, self.settings.speed_max));

        // Midpoint rule: half the turn, the whole displacement, the other half.
        let middle = self.turned(v.heading, wanted_heading, TICK_S / 2.0);
        self.motion.speed = approached(v.speed, wanted_speed, self.settings.acceleration * TICK_S);
        let ground_velocity = 0.5 * (v.speed + self.motion.speed) * middle.unit() + flow;
        let reached = v.position + TICK_S * ground_velocity;
        self.motion.heading = self.turned(middle, wanted_heading, TICK_S / 2.0);

        let wobble = self.jitter.step(tick);
        let depth_after = |time: f64, water: f64| {
            let wanted = match command.map(|c| c.vertical) {
                Some(Vertical::Depth(depth)) => depth,
                Some(Vertical::Altitude(altitude)) => water - altitude + wobble,
                None => v.depth,
            };
            approached(v.depth, wanted, self.settings.depth_rate * time).max(0.0)
        };
        let mut water = water_depth(reached);
        let mut aground = depth_after(TICK_S, water) >= water;
        if v.aground {
            let ahead = water_depth(v.position + CLEARS_S * (wanted_speed * middle.unit() + flow));
            aground = aground || depth_after(CLEARS_S, ahead) >= ahead;
            water = water.min(ahead);
        }
        let depth = depth_after(TICK_S, water);
        self.motion = if aground {
            let depth = depth.min(water_depth(v.position));
            Motion { speed: 0.0, ground_velocity: Vector::ZERO, depth, aground, ..self.motion }
        } else {
            Motion { position: reached, ground_velocity, depth, aground, ..self.motion }
        };
        let sank = std::mem::replace(&mut self.sinks, (self.motion.depth - v.depth) / TICK_S);
        if let Some(track) = track {
            track.level(&v, &self.motion, [sank, self.sinks]);
        }
    }

    /// The heading after `time` seconds. A stuck rudder turns at its share of the greatest rate at full speed, and at slower
    /// speeds in proportion: without way it turns nothing.
    fn turned(&self, from: Heading, to: Heading, time: f64) -> Heading {
        match self.stuck_rudder {
            None => turned(from, to, &self.settings, time),
            Some(share) => from + share * self.settings.turn_rate * self.motion.speed / self.settings.speed_max * time,
        }
    }
}

/// A vehicle that is aground goes on when what it is told leads clear of the bottom for so long at the speed that it is told, s:
/// from rest it would creep up to where it struck, and strike again.
const CLEARS_S: f64 = 1.0;

/// The heading after `time` seconds of turning: at the rate limit while the error is large, then closing it exponentially.
/// Exact, so that two half steps are one whole step.
fn turned(from: Heading, to: Heading, settings: &KinematicHull, time: f64) -> Heading {
    let error = to - from;
    let linear = settings.turn_rate * KinematicHull::HEADING_TIME_S;
    let saturated = ((error.abs() - linear) / settings.turn_rate).clamp(0.0, time);
    let turn = settings.turn_rate * saturated;
    let rest = (error.abs() - turn) * (1.0 - exp(-(time - saturated) / KinematicHull::HEADING_TIME_S));
    from + if error < 0.0 { -(turn + rest) } else { turn + rest }
}

/// `value` moved toward `goal` by `step` at most.
fn approached(value: f64, goal: f64, step: f64) -> f64 {
    value + (goal - value).clamp(-step, step)
}

/// The wobble about a commanded altitude: an Ornstein-Uhlenbeck process, clipped.
#[derive(Clone, Debug)]
struct Jitter {
    noise: Noise,
    keep: f64,
    kick: f64,
    limit: f64,
    value: f64,
}

impl Jitter {
    fn new(settings: &KinematicHull, seed: u64) -> Self {
        // The exact transition over one tick: its stationary deviation is the one asked for.
        let keep = exp(-TICK_S / settings.altitude_jitter_time);
        let kick = settings.altitude_jitter * (1.0 - keep * keep).sqrt();
        Jitter {
            noise: Noise::new(seed, Stream::AltitudeJitter),
            keep,
            kick,
            limit: settings.altitude_jitter_max,
            value: 0.0,
        }
    }

    fn step(&mut self, tick: u64) -> f64 {
        if self.kick > 0.0 {
            self.value = self.keep * self.value + self.kick * self.noise.gaussian(tick);
        }
        self.value.clamp(-self.limit, self.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(heading_deg: f64, speed: f64, vertical: Vertical) -> Command {
        Command::new(Heading::from_degrees(heading_deg), speed, vertical)
    }

    fn at_rest(settings: &KinematicHull, depth: f64, flow: Vector) -> Kinematics {
        Kinematics::new(settings, &StartPose { depth, flow, ..StartPose::default() }, 7)
    }

    fn run(v: &mut Kinematics, ticks: u64, command: Option<&Command>, flow: Vector) {
        (1..=ticks).for_each(|tick| v.step(tick, command, flow, |_| 20.0, None));
    }

    #[test]
    fn turns_at_ten_degrees_a_second_the_short_way() {
        let mut v = at_rest(&KinematicHull::default(), 0.0, Vector::ZERO);
        run(&mut v, 50, Some(&command(270.0, 0.0, Vertical::Depth(0.0))), Vector::ZERO);
        assert!((v.motion.heading.degrees() - 310.0).abs() < 1e-9, "{}", v.motion.heading.degrees());
        run(&mut v, 70, Some(&command(270.0, 0.0, Vertical::Depth(0.0))), Vector::ZERO);
        assert!((v.motion.heading.degrees() - 270.0).abs() < 1e-3);
    }

    #[test]
    fn a_steady_turn_is_a_circle() {
        let settings = KinematicHull::default();
        let mut v = at_rest(&settings, 0.0, Vector::ZERO);
        run(&mut v, 200, Some(&command(0.0, 2.0, Vertical::Depth(0.0))), Vector::ZERO);
        let start = v.motion.position;
        for tick in 0..180 {
            let ahead = v.motion.heading.degrees() + 90.0;
            v.step(tick, Some(&command(ahead, 2.0, Vertical::Depth(0.0))), Vector::ZERO, |_| 20.0, None);
        }
        // Half a turn in 18 s: across the circle of radius v / rate = 11.46 m.
        assert!((v.motion.position.distance(start) - 2.0 * 2.0 / settings.turn_rate).abs() < 0.01);
    }

    #[test]
    fn speed_and_depth_follow_within_their_limits() {
        let mut v = at_rest(&KinematicHull::default(), 0.0, Vector::ZERO);
        run(&mut v, 40, Some(&command(0.0, 2.0, Vertical::Altitude(2.0))), Vector::ZERO);
        assert!((v.motion.speed - 1.0).abs() < 1e-9 && (v.motion.depth - 2.0).abs() < 1e-9);
        run(&mut v, 400, Some(&command(0.0, 9.0, Vertical::Altitude(2.0))), Vector::ZERO);
        assert!((v.motion.speed - 2.6).abs() < 1e-9 && (v.motion.depth - 18.0).abs() < 1e-9);
    }

    #[test]
    fn without_a_command_it_drifts() {
        let flow = Vector::new(-0.1, 0.05);
        let mut v = at_rest(&KinematicHull::default(), 0.0, flow);
        run(&mut v, 6000, None, flow);
        assert!(v.motion.position.distance(Point::new(-60.0, 30.0)) < 1e-9);
    }

    #[test]
    fn a_stuck_rudder_turns_steadily_whatever_is_asked_for() {
        let mut v = at_rest(&KinematicHull::default(), 0.0, Vector::ZERO);
        run(&mut v, 200, Some(&command(0.0, 1.3, Vertical::Depth(0.0))), Vector::ZERO);
        v.stuck_rudder = Some(-0.5);
        run(&mut v, 100, Some(&command(90.0, 1.3, Vertical::Depth(0.0))), Vector::ZERO);
        let now = v.motion.heading.degrees();
        assert!((now - 335.0).abs() < 1e-9, "a quarter of 10 deg/s for 10 s: {now}");
    }

    /// A bottom that rises by a metre every ten to the north, from 20 m at the origin to a shore at 200 m.
    fn beach(p: Point) -> f64 {
        (20.0 - 0.1 * p.north).max(0.0)
    }

    #[test]
    fn a_slope_stops_it_and_it_comes_free_upward_or_away() {
        let aground = || {
            let mut v = at_rest(&KinematicHull::default(), 15.0, Vector::ZERO);
            for tick in 1..=600 {
                v.step(tick, Some(&command(0.0, 2.0, Vertical::Depth(15.0))), Vector::new(0.1, 0.0), beach, None);
            }
            v
        };
        let stuck = aground();
        assert!(stuck.motion.aground && stuck.motion.speed == 0.0 && stuck.motion.ground_velocity == Vector::ZERO);
        assert!(
            (49.7..50.0).contains(&stuck.motion.position.north) && stuck.motion.depth == 15.0,
            "{:?}",
            stuck.motion.position
        );

        let mut up = aground();
        for tick in 601..=700 {
            up.step(tick, Some(&command(0.0, 2.0, Vertical::Depth(12.0))), Vector::ZERO, beach, None);
        }
        assert!(
            !up.motion.aground && up.motion.depth == 12.0 && up.motion.position.north > 52.0,
            "{:?}",
            up.motion.position
        );

        let mut away = aground();
        for tick in 601..=900 {
            away.step(tick, Some(&command(180.0, 2.0, Vertical::Depth(15.0))), Vector::ZERO, beach, None);
        }
        assert!(
            !away.motion.aground && away.motion.speed == 2.0 && away.motion.position.north < 45.0,
            "{:?}",
            away.motion.position
        );
    }

    #[test]
    fn it_lies_on_a_level_bottom_and_does_not_drive_ashore() {
        let mut v = at_rest(&KinematicHull::default(), 0.0, Vector::ZERO);
        run(&mut v, 600, Some(&command(0.0, 2.0, Vertical::Depth(30.0))), Vector::ZERO);
        assert!(v.motion.aground && v.motion.depth == 20.0 && v.motion.ground_velocity == Vector::ZERO);
        let lain = v.motion.position;
        run(&mut v, 100, Some(&command(90.0, 2.0, Vertical::Depth(30.0))), Vector::new(0.2, 0.0));
        assert_eq!(v.motion.position, lain, "who pushes in is not carried off");

        // An altitude that the water does not have is the surface: there the shore stops it.
        let mut v = at_rest(&KinematicHull::default(), 0.0, Vector::ZERO);
        for tick in 1..=2000 {
            v.step(tick, Some(&command(0.0, 2.0, Vertical::Altitude(3.0))), Vector::ZERO, beach, None);
        }
        assert!(
            v.motion.aground && v.motion.depth == 0.0 && (199.7..=200.0).contains(&v.motion.position.north),
            "{:?}",
            v.motion.position
        );
    }

    #[test]
    fn altitude_wobbles_as_told() {
        let settings = KinematicHull { altitude_jitter: 0.3, ..KinematicHull::default() };
        let mut v = at_rest(&settings, 18.0, Vector::ZERO);
        let (mut sum, mut n) = (0.0, 0.0);
        for tick in 0..100_000 {
            v.step(tick, Some(&command(0.0, 2.0, Vertical::Altitude(2.0))), Vector::ZERO, |_| 20.0, None);
            let error = 20.0 - v.motion.depth - 2.0;
            assert!(error.abs() <= 0.7 + 1e-9);
            sum += error * error;
            n += 1.0;
        }
        assert!(((sum / n).sqrt() - 0.3).abs() < 0.03, "{}", (sum / n).sqrt());
    }
}
