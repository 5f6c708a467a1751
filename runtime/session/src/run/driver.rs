//! What decides a command: the vehicle's port, the machine, the watch over what is sensed, and the release. A step of it waits
//! for the vehicle alone, and gives a record; whoever keeps the records is no concern of it.

use super::Running;
use crate::control_claim::ControlClaim;
use crate::plan::{Plan, PlanError};
use crate::recorders::Recorder;
use crate::recorders::digest::RunDigest;
use crate::run_vehicle::RunVehicle;
use crate::scenario;
use albacore_geometry::Point;
use albacore_machine::{Event, Machine, Outcome};
use albacore_navigation::Trust;
use albacore_program::{NamedArea, area_words};
use albacore_sim::Simulator;
use albacore_trace::{Ending, Release, Step, TickRecord};
use albacore_vehicle::VehicleError;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A run takes this many ticks at most: ten days.
const TICKS_MAX: u64 = 8_640_000;

/// Ticks between looks at the navigation: a second.
const NAVIGATION_TICKS: u64 = 10;

/// Drives a vehicle through a mission.
pub(crate) struct Driver {
    machine: Machine,
    vehicle: RunVehicle,
    trust: Trust,
    digest: RunDigest,
    claim: ControlClaim,
    /// Why the mission ends, when that is known.
    reason: String,
    /// The tick in which that was said.
    reason_tick: u64,
    /// What the vehicle or its link gave notice of last.
    last_notice: String,
    knows_areas: bool,
    next: Next,
}

/// What the next step is.
enum Next {
    Tick,
    /// The last one: the mission is over, or this ends it.
    End(Cause),
    Nothing(Outcome),
}

/// Why a run ends.
enum Cause {
    /// The mission has said so in its last tick.
    Mission(Outcome),
    /// A person, or a vehicle that failed.
    Outside(Outcome, String),
}

impl Cause {
    fn failure(error: &VehicleError) -> Self {
        Cause::Outside(Outcome::Failed, error.to_string())
    }
}

impl Driver {
    /// Before the first tick.
    pub fn new(plan: &Plan, vehicle: RunVehicle) -> Result<Self, PlanError> {
        let machine = Machine::new(Arc::clone(&plan.program), vehicle.measurements())
            .map_err(|missing| PlanError::Asked(missing.to_string(), None))?
            .with_chart(plan.chart());
        Ok(Driver {
            machine,
            vehicle,
            trust: Trust::default(),
            digest: RunDigest::default(),
            claim: ControlClaim::default(),
            reason: String::new(),
            reason_tick: 0,
            last_notice: String::new(),
            knows_areas: false,
            next: Next::Tick,
        })
    }

    /// In the plan's world with a seed; and where the vehicle starts.
    pub fn simulated(plan: &Plan, seed: u64) -> Result<(Self, Point), PlanError> {
        let simulator = Simulator::new(&plan.scenario, seed).map_err(|error| scenario::cannot_begin(&error))?;
        let start = simulator.truth().position;
        Ok((Driver::new(plan, RunVehicle::Simulated(Box::new(simulator)))?, start))
    }

    /// Steps to the end while a recorder folds over the records. None: it was stopped before.
    pub fn fold(&mut self, recorder: &mut dyn Recorder, stop: &AtomicBool) -> Option<Outcome> {
        let mut record = TickRecord::default();
        loop {
            let running = self.step(&mut record);
            recorder.take(&record);
            match running {
                Running::Over(outcome) => return Some(outcome),
                Running::On if stop.load(Ordering::Relaxed) => return None,
                Running::On => {}
            }
        }
    }

    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    pub fn vehicle(&self) -> &RunVehicle {
        &self.vehicle
    }

    /// The digest of the run so far.
    pub fn digest(&self) -> u64 {
        self.digest.value()
    }

    /// Whether the vehicle's time has come to the next tick; on a link it waits some hundredths of a second for that.
    pub fn is_heard(&mut self) -> Result<bool, VehicleError> {
        self.vehicle.port().ready()
    }

    /// The tick that comes next.
    pub fn tick(&self) -> u64 {
        self.machine.state().tick
    }

    /// Whether the next step is the last: that is due at once, whatever the time.
    pub fn is_ending(&self) -> bool {
        matches!(self.next, Next::End(_))
    }

    /// Lets the next step end the run because the person says so, or nothing is left to go on with.
    pub fn interrupt(&mut self, why: &str) {
        if matches!(self.next, Next::Tick) {
            self.next = Next::End(Cause::Outside(Outcome::Interrupted, why.into()));
        }
    }

    /// Lets the next step end the run, whose machine may be in any state.
    pub fn fail(&mut self, reason: &str) {
        self.reason = reason.to_string();
        self.next = Next::End(Cause::Mission(Outcome::Failed));
    }

    /// One step: a look for the vehicle's next tick, the tick, or the end. On a link some hundredths of a second go by in it at
    /// most, and some seconds in the end.
    pub fn step(&mut self, record: &mut TickRecord) -> Running {
        record.clear(self.tick());
        let cause = match std::mem::replace(&mut self.next, Next::Tick) {
            Next::Nothing(outcome) => {
                self.next = Next::Nothing(outcome);
                return Running::Over(outcome);
            }
            Next::End(cause) => cause,
            Next::Tick if record.tick >= TICKS_MAX => {
                Cause::Outside(Outcome::Failed, "the run is longer than ten days".into())
            }
            Next::Tick => match self.go(record) {
                Ok(()) => return Running::On,
                Err(error) => Cause::failure(&error),
            },
        };
        Running::Over(self.end(cause, record))
    }

    /// A tick, if the vehicle's time has come to it.
    fn go(&mut self, record: &mut TickRecord) -> Result<(), VehicleError> {
        if !self.vehicle.port().ready()? {
            self.hear(record);
            return Ok(());
        }
        self.vehicle.port().sense(&mut record.snapshot)?;
        self.follow_wish()?;
        let doubts = self.trust.look(record.tick, &mut record.snapshot, self.machine.state().command.as_ref());
        record.command = self.machine.step(&record.snapshot);
        let sent = record.command.map_or(Ok(()), |command| self.vehicle.port().command(&command));
        let sent = sent
            .and_then(|()| self.ask_payload())
            .and_then(|()| self.claim.ask_anew(&self.machine, self.vehicle.port()))
            .and_then(|()| self.follow_wish());
        record.step = Step::Tick;
        self.note_events(record);
        self.digest.take(record);
        self.hear(record);
        record.notices.extend(doubts);
        self.describe(record);
        if let Err(error) = sent {
            self.next = Next::End(Cause::failure(&error));
        } else if let Some(outcome) = self.machine.outcome() {
            self.next = Next::End(Cause::Mission(outcome));
        }
        record.is_last = self.is_ending();
        Ok(())
    }

    /// Asks for control when the mission wants it. At the end of the mission comes the release.
    fn follow_wish(&mut self) -> Result<(), VehicleError> {
        self.claim.follow(&self.machine, self.vehicle.port())
    }

    /// Hands on what the mission asks of payloads.
    fn ask_payload(&mut self) -> Result<(), VehicleError> {
        self.machine.requests().try_for_each(|(id, action)| self.vehicle.port().ask(id, action))
    }

    /// Ends the run. The release is always the last act; then it is only written down.
    fn end(&mut self, cause: Cause, record: &mut TickRecord) -> Outcome {
        record.clear(record.tick);
        let from_outside = matches!(cause, Cause::Outside(..));
        let outcome = match cause {
            Cause::Mission(outcome) => outcome,
            Cause::Outside(outcome, reason) => {
                self.machine.end(outcome);
                self.reason = reason;
                // What was sensed last belongs to the tick before, or to none.
                self.note_events(record);
                outcome
            }
        };
        self.describe(record);
        record.areas = self.areas();
        let heard = matches!(outcome, Outcome::Refused | Outcome::ReleasedByVehicle | Outcome::LinkLost);
        if heard && !from_outside {
            self.vehicle_left(record);
        }
        let released = self.vehicle.port().release();
        self.hear(record);
        let aground = if self.vehicle.port().is_aground() { self.machine.end_aground() } else { None };
        if aground.is_some() {
            self.note_events(record);
        }
        let outcome = aground.unwrap_or(outcome);
        let guest = self.machine.program().mission.guest;
        let (release, trouble) = match released {
            Err(error) => (Release::Failed, Some(error.to_string())),
            Ok(()) if guest && !self.claim.is_asked() => (Release::NotOurs, None),
            Ok(()) => (Release::Done, None),
        };
        let reason = self.reason.clone();
        let ending = Ending { outcome, reason, release, trouble, digest: 0 };
        record.step = Step::End(ending.clone());
        self.digest.take(record);
        record.step = Step::End(Ending { digest: self.digest.value(), ..ending });
        self.next = Next::Nothing(outcome);
        outcome
    }

    /// The vehicle drives itself again: why, as it said, and why the recovery was under way if it was.
    fn vehicle_left(&mut self, record: &TickRecord) {
        let told = if record.truth.is_none() { self.last_notice.as_str() } else { "" };
        let before = std::mem::take(&mut self.reason);
        self.reason = match (told, before.as_str()) {
            (told, "") => told.to_string(),
            // An abort of this very moment is the vehicle's leaving, in the mission's words.
            (_, before) if record.tick <= self.reason_tick + 1 => before.to_string(),
            ("", before) => format!("in the recovery after an abort: {before}"),
            (told, before) => format!("{told}, in the recovery after an abort: {before}"),
        };
    }

    /// What the vehicle gave notice of: no part of the digest, for when it comes is no matter of the run.
    fn hear(&mut self, record: &mut TickRecord) {
        record.notices.extend(self.vehicle.port().notices());
        if let Some(last) = record.notices.last() {
            self.last_notice.clone_from(last);
        }
    }

    /// What happened, and why the mission ends if it does.
    fn note_events(&mut self, record: &mut TickRecord) {
        record.events.extend_from_slice(self.machine.events());
        for event in &record.events {
            let ends = matches!(event, Event::Aborted(_) | Event::TimedOut | Event::HostTimeUp(..));
            self.reason_tick = if ends { record.tick } else { self.reason_tick };
            match event {
                Event::Aborted(why) => self.reason.clone_from(why),
                Event::TimedOut => self.reason = "time limit".to_string(),
                Event::HostTimeUp(host, vehicle) => {
                    self.reason = format!(
                        "time limit by the host's clock: {host:.0} s of it, {vehicle:.0} s heard of the vehicle's"
                    );
                }
                _ => {}
            }
        }
    }

    /// How things are after the step.
    fn describe(&mut self, record: &mut TickRecord) {
        record.truth = self.vehicle.truth();
        if record.tick == 1 || record.tick.is_multiple_of(NAVIGATION_TICKS) {
            record.navigation = self.vehicle.navigation().map(Box::new);
        }
        record.believed = self.machine.position();
        record.active = self.machine.active();
        if !self.knows_areas {
            record.areas = self.areas();
            self.knows_areas = !record.areas.is_empty();
        }
    }

    /// The words of the mission's areas, one after another, once it has them.
    fn areas(&self) -> Vec<f64> {
        let mission = &self.machine.program().mission;
        let area = |area: &NamedArea| {
            let words = self.machine.state().words.get((mission.base + area.at) as usize..)?;
            let corners = words.first().map(|corners| *corners as u32).filter(|corners| *corners > 0)?;
            words.get(..area_words(corners) as usize)
        };
        let areas: Option<Vec<&[f64]>> = mission.areas.iter().map(area).collect();
        areas.unwrap_or_default().concat()
    }
}
