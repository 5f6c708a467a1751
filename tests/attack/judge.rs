//! What an attack must not have brought about.

use crate::desk::{Desk, Sent};
use crate::weather::Fate;
use albacore_link::ServerEvent;
use albacore_link::recon::{SpeedGoal, ToVehicle};
use albacore_session::Outcome;
use albacore_trace::TickRecord;
use albacore_trace::journal::{Ending, Journal};
use albacore_vehicle::{Command, Vertical};
use std::collections::BTreeMap;

/// The limits of every mission of `attack.alb`: m, m, m/s.
const MISSION: (f64, f64, f64) = (12.0, 3.0, 1.6);
/// Those of its vehicle: m, m/s. What it holds is told as turns of the propeller.
const VEHICLE: (f64, f64) = (14.0, 2.0);
const RPM_AT_1_MPS: f64 = 1500.0 / 2.6;
/// Numbers on the wire are rounded, those of goals inward.
const ROUNDED: f64 = 0.011;
/// Dived at its limit, the vehicle overshoots a little, m.
const OVERSHOOT: f64 = 1.0;
/// A heading bears a mark that measures the round trip, degrees: a tenth, beside what rounding makes.
const MARK: f64 = 0.1 + 0.06;
/// So many ticks old may a goal be that is sent: it waits for its turn among three.
const AGE_TICKS: u64 = 3;
/// So many goals may be sent in one tick of the vehicle's.
const AT_ONCE: usize = 3;

/// Each thing that is not as it must be.
pub fn broken(desk: &Desk, journal: &[u8], outcome: Option<Outcome>, fate: Fate) -> Vec<String> {
    let mut broken = Vec::new();
    if outcome.is_none() && !matches!(fate, Fate::Killed(_)) {
        broken.push("the run does not end".to_string());
    }
    if desk.is_driven() {
        broken.push("the vehicle is driven long after the run".to_string());
    }
    let mut driven = false;
    for happening in &desk.happenings {
        match happening {
            ServerEvent::Taken(..) => driven = true,
            ServerEvent::Released | ServerEvent::TimedOut(_) | ServerEvent::TakenBack | ServerEvent::GivenUp => {
                driven = false
            }
            _ => {}
        }
    }
    if driven {
        broken.push("no release and no time-out follow the last override".to_string());
    }
    broken.extend(desk.states.iter().find_map(beyond).map(|what| format!("the vehicle {what}")));
    match Journal::read(journal) {
        Ok(journal) => {
            broken.extend(sent(&desk.sent, &journal.ticks));
            let complete = matches!(&journal.ending, Ending::Complete(end) if end.ending().map(|ending| ending.outcome) == outcome);
            let cut = matches!(&journal.ending, Ending::CutShort(_)) && outcome.is_none();
            if !(complete || cut) {
                broken.push(format!("the journal ends with {:?}", journal.ending));
            }
        }
        Err(error) => broken.push(format!("the journal: {error}")),
    }
    broken
}

/// What a vehicle says of itself that is beyond its limits.
fn beyond(state: &albacore_link::recon::State) -> Option<String> {
    let (depth, speed) = VEHICLE;
    if state.depth_goal > depth + ROUNDED || state.depth_goal < -ROUNDED {
        return Some(format!("holds a depth of {} m", state.depth_goal));
    }
    if state.depth > depth + OVERSHOOT {
        return Some(format!("is {} m deep", state.depth));
    }
    let held = state.rpm_goal / RPM_AT_1_MPS;
    (held > speed + ROUNDED || held < -ROUNDED).then(|| format!("holds a speed of {held} m/s"))
}

/// What of that which was sent should not have been: the first of each kind.
fn sent(sent: &[Sent], records: &[TickRecord]) -> Vec<String> {
    let goals = || sent.iter().filter_map(|s| Some((s, goal(s.message.as_ref()?)?)));
    let mut broken = Vec::new();
    if sent.iter().any(|s| s.message.is_none()) {
        broken.push("something was sent that is no message".to_string());
    }
    let outside = goals().find(|(_, goal)| !goal.is_within());
    broken.extend(outside.map(|(s, goal)| format!("tick {}: sent {goal:?}, outside the mission's limits", s.at)));
    let old = goals().find(|(s, goal)| !is_new(records, s.mission_tick, *goal));
    broken.extend(old.map(|(s, goal)| format!("tick {}: sent {goal:?}, which the mission does not command", s.at)));
    let mut in_tick: BTreeMap<u64, usize> = BTreeMap::new();
    goals().for_each(|(s, _)| *in_tick.entry(s.at).or_default() += 1);
    let burst = in_tick.into_iter().find(|(_, count)| *count > AT_ONCE);
    broken.extend(burst.map(|(tick, count)| format!("tick {tick}: {count} goals were sent at once")));
    broken
}

#[derive(Clone, Copy, Debug)]
enum Goal {
    /// Degrees.
    Heading(f64),
    Speed(f64),
    Depth(f64),
    Altitude(f64),
}

fn goal(message: &ToVehicle) -> Option<Goal> {
    Some(match message {
        ToVehicle::Heading(heading) => Goal::Heading(heading.degrees()),
        ToVehicle::Speed(SpeedGoal::MetresPerSecond(speed) | SpeedGoal::Knots(speed)) => Goal::Speed(*speed),
        ToVehicle::Speed(SpeedGoal::Rpm(rpm)) => Goal::Speed(rpm / RPM_AT_1_MPS),
        ToVehicle::Depth(depth) => Goal::Depth(*depth),
        ToVehicle::Altitude(altitude) => Goal::Altitude(*altitude),
        _ => return None,
    })
}

impl Goal {
    fn is_within(self) -> bool {
        let (depth, altitude, speed) = MISSION;
        match self {
            Goal::Heading(degrees) => degrees.is_finite(),
            Goal::Speed(asked) => (-ROUNDED..=speed).contains(&asked),
            Goal::Depth(asked) => (-ROUNDED..=depth).contains(&asked),
            Goal::Altitude(asked) => asked.is_finite() && asked >= altitude,
        }
    }

    fn is_of(self, command: &Command) -> bool {
        match (self, command.vertical) {
            (Goal::Heading(degrees), _) => {
                let off = (degrees - command.heading.degrees()).rem_euclid(360.0);
                off.min(360.0 - off) < MARK
            }
            (Goal::Speed(speed), _) => (speed - command.speed).abs() < ROUNDED,
            (Goal::Depth(asked), Vertical::Depth(depth)) => (asked - depth).abs() < ROUNDED,
            (Goal::Altitude(asked), Vertical::Altitude(altitude)) => (asked - altitude).abs() < ROUNDED,
            _ => false,
        }
    }
}

/// Whether a goal that was sent before a tick of the mission's is what it commanded then.
fn is_new(records: &[TickRecord], tick: u64, goal: Goal) -> bool {
    // Records have no gaps: each is at the place of its tick.
    let end = records.len().min(tick as usize + 1);
    let of = &records[end.min(tick.saturating_sub(AGE_TICKS) as usize)..end];
    of.iter().filter_map(|record| record.command).any(|command| goal.is_of(&command))
}
