//! `cpt.cpt_2005`: the strategy as printed.

use super::guided::Led;
use super::maneuver::Bowtie;
use super::search::Find;
use super::senses::Senses;
use albacore_geometry::math::radians;
use albacore_geometry::{Area, Heading, Point, Vector};
use albacore_guidance::parameters::{ARRIVAL_RADIUS, TURN_RATE_MAX};
use albacore_guidance::{Goto, Law, turning_radius_in_flow};

/// Contacts remembered at most.
const LOST_MAX: usize = 6;
const SOURCE_CONTACTS: usize = 3;
const SOURCE_SPREAD: f64 = 4.0;

#[derive(Clone)]
pub struct Parameters {
    pub area: Area,
    pub cruise: f64,
    pub threshold: f64,
    pub lambda_ticks: u32,
    pub beta: f64,
    pub advance: f64,
    pub cross: f64,
    pub bowties: u32,
}

#[derive(Clone)]
pub struct Cpt {
    parameters: Parameters,
    /// +1: the plume is expected to be left on its left, looking up-flow.
    side: f64,
    /// Where the chemical was last detected.
    last: Point,
    /// Where contact was lost, most up-flow first.
    lost: Vec<Point>,
    doing: Behavior,
}

#[derive(Clone)]
enum Behavior {
    Find(Find),
    /// The course held, the ticks since entry, and since which of them nothing is detected.
    TrackIn {
        course: Heading,
        age: u32,
        quiet_since: Option<u32>,
    },
    TrackOut(Goto),
    /// Round a lost contact: which bowtie.
    Reacquire {
        point: Point,
        number: u32,
        bowtie: Bowtie,
    },
}

/// What the strategy makes of a tick's samples.
struct Now<'a> {
    senses: &'a Senses,
    detection: bool,
    down: Heading,
    up: Heading,
    /// Unit vectors up the flow and across it.
    upflow: Vector,
    crossflow: Heading,
}

impl Cpt {
    /// Gives the course of its first tick as well.
    pub fn enter(parameters: Parameters, senses: &Senses) -> (Self, Heading) {
        let find = Find::enter(&parameters.area, senses.position, senses.flow.toward());
        let course = find.course();
        let lost = Vec::with_capacity(LOST_MAX);
        (Cpt { parameters, side: 1.0, last: senses.position, lost, doing: Behavior::Find(find) }, course)
    }

    /// The course of a tick; none when the source is declared.
    pub fn step(&mut self, senses: &Senses) -> Option<Heading> {
        let down = senses.flow.toward();
        let up = down + radians(180.0);
        let now = Now {
            senses,
            detection: senses.chemical_peak >= self.parameters.threshold,
            down,
            up,
            upflow: up.unit(),
            crossflow: down + radians(90.0),
        };
        self.sort(&now);
        match &mut self.doing {
            Behavior::Find(find) => {
                if now.detection {
                    self.side = side_of(senses.course, down);
                    return Some(self.track_in(&now));
                }
                Some(find.step(senses.position, down))
            }
            Behavior::TrackIn { course, age, quiet_since } => {
                *age += 1;
                if now.detection {
                    *quiet_since = None;
                    *course = up + self.side * self.parameters.beta;
                    self.side = side_of(senses.course, down);
                    self.last = senses.position;
                    return Some(*course);
                }
                let since = *quiet_since.get_or_insert(*age);
                if *age - since < self.parameters.lambda_ticks {
                    return Some(*course);
                }
                self.lose(&now);
                Some(self.track_out(&now))
            }
            Behavior::TrackOut(goto) => {
                if now.detection {
                    return if self.source(&now) { None } else { Some(self.track_in(&now)) };
                }
                let guidance = goto.step(senses.position, senses.course);
                if !guidance.arrived {
                    return Some(guidance.course);
                }
                if self.source(&now) { None } else { Some(self.reacquire(&now)) }
            }
            Behavior::Reacquire { .. } if now.detection => Some(self.track_in(&now)),
            Behavior::Reacquire { point, number, bowtie } => {
                if let Some(course) = bowtie.step(senses) {
                    return Some(course);
                }
                let (point, number) = (*point, *number + 1);
                if number < self.parameters.bowties {
                    return Some(self.bowtie(point, number, &now));
                }
                if let Some(at) = self.lost.iter().position(|lost| *lost == point) {
                    self.lost.remove(at);
                }
                Some(self.reacquire(&now))
            }
        }
    }

    /// The law that leads the vehicle.
    pub fn led(&self) -> Led {
        match &self.doing {
            Behavior::Find(_) | Behavior::TrackIn { .. } => Led::Course,
            Behavior::TrackOut(goto) => Led::Goto(*goto),
            Behavior::Reacquire { bowtie, .. } => Led::Line(bowtie.line()),
        }
    }

    /// Contacts in their order along the flow as it is now; equals as they were. Few, and nearly in order.
    fn sort(&mut self, now: &Now) {
        let key = |p: &Point| (*p - Point::ORIGIN).dot(now.upflow);
        self.lost.sort_by(|a, b| key(b).total_cmp(&key(a)));
    }

    /// Remembers where contact was lost; when all places are taken the least up-flow is forgotten.
    fn lose(&mut self, now: &Now) {
        self.lost.push(self.last);
        self.sort(now);
        self.lost.truncate(LOST_MAX);
    }

    /// Table II: whether the most up-flow contacts lie close together along the flow.
    fn source(&self, now: &Now) -> bool {
        let Some(top) = self.lost.get(..SOURCE_CONTACTS) else { return false };
        let along = top.iter().map(|p| (*p - Point::ORIGIN).dot(now.upflow));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low < SOURCE_SPREAD
    }

    /// Table I.
    fn track_in(&mut self, now: &Now) -> Heading {
        let course = now.up + self.side * self.parameters.beta;
        if now.detection {
            self.side = side_of(now.senses.course, now.down);
            self.last = now.senses.position;
        }
        let quiet_since = if now.detection { None } else { Some(0) };
        self.doing = Behavior::TrackIn { course, age: 0, quiet_since };
        course
    }

    /// Table II.
    fn track_out(&mut self, now: &Now) -> Heading {
        let p = &self.parameters;
        let from = self.lost.first().copied().unwrap_or(self.last);
        let goal = from + p.advance * now.upflow - (self.side * p.cross) * now.crossflow.unit();
        let flow = now.senses.flow.length();
        let mut goto = Goto::new(goal, ARRIVAL_RADIUS, turning_radius_in_flow(p.cruise, flow, TURN_RATE_MAX));
        let course = goto.step(now.senses.position, now.senses.course).course;
        self.doing = Behavior::TrackOut(goto);
        course
    }

    /// Table III, or finding anew when there is nothing left to reacquire.
    fn reacquire(&mut self, now: &Now) -> Heading {
        if let Some(&point) = self.lost.first() {
            return self.bowtie(point, 0, now);
        }
        let find = Find::enter(&self.parameters.area, now.senses.position, now.down);
        let course = find.course();
        self.doing = Behavior::Find(find);
        course
    }

    fn bowtie(&mut self, point: Point, number: u32, now: &Now) -> Heading {
        let (n, all) = (f64::from(number), f64::from(self.parameters.bowties));
        let centre = point + (10.0 * (all - 1.0 - n) / (all - 1.0)) * now.upflow;
        let (bowtie, course) = Bowtie::enter(centre, self.parameters.cruise, now.senses);
        self.doing = Behavior::Reacquire { point, number, bowtie };
        course
    }
}

fn side_of(going: Heading, down: Heading) -> f64 {
    if going - down > 0.0 { 1.0 } else { -1.0 }
}
