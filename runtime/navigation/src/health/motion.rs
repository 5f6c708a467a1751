//! The measurements of motion against one another: positions against course and speed, heading against the way through the water.

use super::{Anomalies, Anomaly, Heard};
use albacore_geometry::math::PI;
use albacore_geometry::{Heading, Point, Vector};
use albacore_vehicle::measurements::{FLOW, POSITION};
use albacore_vehicle::{Reading, TICK_S};

/// Positions and velocities are compared over about so long, s.
const WINDOW_S: f64 = 60.0;
/// ... once the vehicle has gone so far in it, m.
const WAY_MIN: f64 = 30.0;
/// They may differ by this share of the way, and by so much, m: the random walk of dead reckoning comes to half a metre in a minute.
const SHARE_MAX: f64 = 0.1;
const DIFFERENCE_MAX: f64 = 2.0;
/// A step of positions that differs by more than this from the velocity is a fix, m: no matter of this comparison.
const FIX_MIN: f64 = 0.5;
/// Positions are further apart in time than this: nothing is known of the way between, ticks.
const GAP_MAX: u64 = 10;
/// Below this speed nothing is said of directions, m/s.
const SPEED_MIN: f64 = 0.5;
/// The nose may point so far from the way through the water, rad, and further for so many ticks: 10 s.
const DRIFT_MAX: f64 = 40.0 * PI / 180.0;
const DRIFT_TICKS: u64 = 100;
/// A flow is known for so many ticks: 30 s.
const FLOW_TICKS: u64 = 300;
/// A vehicle that moves has another position after so many ticks: 5 s.
const POSITION_SAME: u64 = 50;
/// A mean flow changes within so many ticks under way: 70 s.
const FLOW_SAME: u64 = 700;
/// The profiler measures while the vehicle is faster than this, deeper and higher: m/s, m, m (the 2005 paper, App. B).
const PROFILER_SPEED: f64 = 0.6;
const PROFILER_DEPTH: f64 = 1.2;
const PROFILER_ALTITUDE: f64 = 1.2;

/// What is remembered of the motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    position: Option<(u64, Point)>,
    /// What the positions moved more than the velocity tells, along the course and to the right of it, and the way, each over
    /// the window, m.
    along: f64,
    right: f64,
    way: f64,
    flow: Option<(u64, Vector)>,
    /// For how many ticks the nose has pointed elsewhere.
    drifts: u64,
    /// For how many ticks the profiler has been able to measure.
    measures: u64,
    speed: f64,
    depth: f64,
    altitude: f64,
}

impl Motion {
    /// The speed that was told last, m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    pub fn look(&mut self, heard: &Heard, anomalies: &mut Anomalies) {
        let number = |told: Option<super::Credible>, before: f64| told.map_or(before, |t| t.reading[0]);
        self.speed = number(heard.speed, self.speed);
        self.depth = number(heard.depth, self.depth);
        self.altitude = number(heard.altitude, self.altitude);
        self.look_at_flow(heard, anomalies);
        if heard.position.is_some_and(|p| p.same >= POSITION_SAME && self.speed > SPEED_MIN) {
            anomalies.see(Anomaly::Stuck(POSITION));
        }
        let velocity = heard.course.zip(heard.speed);
        let ahead = |course: Reading| Heading::from_radians(course[0]).unit();
        let velocity = velocity.map(|(course, speed)| (ahead(course.reading), speed.reading[0]));
        self.compare_with_positions(heard, velocity, anomalies);
        let Some((ahead, speed)) = velocity else { return };
        self.compare_with_heading(heard, speed * ahead, anomalies);
    }

    /// The velocity is the unit vector of the course, and the speed, m/s.
    fn compare_with_positions(&mut self, heard: &Heard, velocity: Option<(Vector, f64)>, anomalies: &mut Anomalies) {
        let Some(told) = heard.position else { return };
        let here = Point::new(told.reading[0], told.reading[1]);
        let before = self.position.replace((heard.tick, here));
        let (Some((tick, there)), Some((ahead, speed))) = (before, velocity) else { return };
        let ticks = heard.tick.saturating_sub(tick);
        if ticks == 0 || ticks > GAP_MAX || anomalies.sees(Anomaly::Stuck(POSITION)) {
            return;
        }
        let time = ticks as f64 * TICK_S;
        let more = (here - there) - time * speed * ahead;
        let keep = (1.0 - time / WINDOW_S).max(0.0);
        (self.along, self.right, self.way) = (keep * self.along, keep * self.right, keep * self.way);
        if more.length() > FIX_MIN + SPEED_MIN * time {
            return;
        }
        self.along += more.dot(ahead);
        self.right += more.right_of_unit(ahead);
        self.way += (time * speed).max((here - there).length());
        let most = SHARE_MAX * self.way + DIFFERENCE_MAX;
        if self.way > WAY_MIN && self.along.abs() > most {
            anomalies.see(Anomaly::SpeedAgainstPosition);
        }
        if self.way > WAY_MIN && self.right.abs() > most {
            anomalies.see(Anomaly::CourseAgainstPosition);
        }
    }

    fn compare_with_heading(&mut self, heard: &Heard, over_ground: Vector, anomalies: &mut Anomalies) {
        let (Some((tick, flow)), Some(heading)) = (self.flow, heard.heading) else { return };
        let through_water = over_ground - flow;
        if heard.tick > tick + FLOW_TICKS || through_water.length() < SPEED_MIN {
            self.drifts = 0;
            return;
        }
        let drift = through_water.toward() - Heading::from_radians(heading.reading[0]);
        self.drifts = if drift.abs() > DRIFT_MAX { self.drifts + 1 } else { 0 };
        if self.drifts > DRIFT_TICKS {
            anomalies.see(Anomaly::HeadingAgainstMotion);
        }
    }

    fn look_at_flow(&mut self, heard: &Heard, anomalies: &mut Anomalies) {
        let measures = self.speed > PROFILER_SPEED && self.depth > PROFILER_DEPTH && self.altitude > PROFILER_ALTITUDE;
        self.measures = if measures { self.measures + 1 } else { 0 };
        let Some(told) = heard.flow else { return };
        self.flow = Some((heard.tick, Vector::new(told.reading[0], told.reading[1])));
        if told.lively && told.same.min(self.measures) > FLOW_SAME {
            anomalies.see(Anomaly::Stuck(FLOW));
        }
    }
}
