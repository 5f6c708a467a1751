//! The controller's end of a link: a state machine of what the vehicle says and of the ticks that are taken from it. What is said, and
//! what that means, is its dialect's to know.
//!
//! It has no clock: the host's time is told to it, and measures nothing but the round trip. The vehicle's time stamps make the
//! ticks, so that the same bytes give the same samples however late they are read. What is sent is sent in the newest of them
//! alone: a tick that is late asks for what the vehicle is past.

mod allowance;
mod goal;
mod judge;
mod late;
mod received;
mod round_trip;
mod side;
mod speak;
mod vehicle_time;

pub use received::{Count, Received};
pub(crate) use round_trip::host_ticks;
pub use side::{ControllerMessage, ControllerSide};
pub(crate) use vehicle_time::DAY_MS;

use crate::grounding::Grounding;
use crate::set_point::SetPoint;
use crate::status::{Phase, Status};
use albacore_geometry::TangentFrame;
use albacore_navigation::Navigator;
use albacore_vehicle::measurements::{self, MeasurementInfo, VEHICLE_MODE};
use albacore_vehicle::{Control, Lag, Measurement, Sample, Snapshot};
use allowance::Allowance;
use goal::{Goal, Held};
use late::Late;
use received::Fact;
use round_trip::{GoalSource, Moment, RoundTrip};
use std::collections::VecDeque;
use std::mem::discriminant;
use std::time::Duration;
use vehicle_time::Stamp;

/// States that wait for their tick, and samples for their state; of states the oldest are given up.
const WAITING_MAX: usize = 4096;
/// A tick of the vehicle's time.
const TICK: Duration = Duration::from_millis(100);
/// Notices that wait to be read.
const NOTICES_MAX: usize = 128;
/// After a pause states from before it may come for as long as it was, and for so long more.
const AWAY_MORE: Duration = Duration::from_secs(5);

/// What the host wants of the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Want {
    Listen,
    Drive {
        since: Moment,
    },
    /// To listen, once the vehicle drives itself; or to drive again.
    GiveBack {
        given: Given,
        again: bool,
    },
    Leave(Given),
}

/// Control that was given back, or that is not asked for any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Given {
    since: Moment,
    /// Whether the vehicle has let us drive. Until it has, its word that nobody drives may be older than our question.
    driven: bool,
}

/// What the vehicle said up to a tick.
struct Heard {
    tick: u64,
    status: Status,
    holds: Vec<SetPoint>,
    samples: Vec<Sample>,
}

/// The controller's end of a link.
pub struct Controller {
    side: Box<dyn ControllerSide>,
    measurements: Vec<Measurement>,
    received: Received,
    heard: VecDeque<Heard>,
    /// Samples that belong to the next state.
    gathered: Vec<Sample>,
    latest_tick: Option<u64>,
    next_tick: u64,
    status: Status,
    control: Control,
    want: Want,
    lost: bool,
    /// States in which the vehicle has said that nobody drives it, one after the other.
    left: u64,
    /// ... and that its mission is over.
    over: u64,
    /// States in which it has said that we drive it, since we asked or ask again.
    ours: u64,
    goals: [Goal; SetPoint::PLACES],
    /// What has to be said before the first set-point may not have been sent.
    begins_again: bool,
    /// Ticks whose commands came too late to be sent, since the last that was.
    late: Late,
    /// It has been said that a tick takes longer to compute than it lasts.
    has_warned: bool,
    /// How long the command that comes next took to compute.
    computed: Duration,
    /// How long a tick of the vehicle lasts by the host's clock.
    tick: Duration,
    /// Whether the tick that was taken last was late.
    was_late: bool,
    /// We were away, and no state has come that was made since then: what was heard last is from before.
    away: Option<Away>,
    grounding: Grounding,
    round_trip: RoundTrip,
    /// The host's time, as it was told last.
    host: Duration,
    /// The tick in which something was said last.
    spoke: u64,
    /// ... and in which nothing was said last, for a command to come first.
    gave_way: u64,
    out: Vec<u8>,
    notices: Vec<String>,
    /// What the vehicle may still bring about of them.
    allowance: Allowance,
    told: String,
}

/// Until when we were away, by the host's clock, and how long states from before may come.
#[derive(Clone, Copy, Debug)]
struct Away {
    until: Duration,
    longest: Duration,
}

impl Controller {
    /// Hears a vehicle that speaks so, in the mission's frame; nothing is sent before [`Controller::take_over`].
    pub fn new(side: Box<dyn ControllerSide>, frame: TangentFrame) -> Self {
        let can_tell =
            |row: &MeasurementInfo| measurements::number(row.name).is_some_and(|number| side.can_tell(number));
        let measurements = measurements::delivered(can_tell);
        Controller {
            side,
            measurements,
            received: Received::new(frame),
            heard: VecDeque::new(),
            gathered: Vec::new(),
            latest_tick: None,
            next_tick: 0,
            status: Status::default(),
            control: Control::Disconnected,
            want: Want::Listen,
            lost: false,
            left: 0,
            over: 0,
            ours: 0,
            goals: Default::default(),
            begins_again: false,
            late: Late::default(),
            has_warned: false,
            computed: Duration::ZERO,
            tick: TICK,
            was_late: false,
            away: None,
            round_trip: RoundTrip::new(1.0),
            host: Duration::ZERO,
            grounding: Grounding::default(),
            spoke: 0,
            gave_way: 0,
            out: Vec::new(),
            notices: Vec::new(),
            allowance: Allowance::default(),
            told: String::new(),
        }
    }

    /// The same, of a vehicle that runs so many times faster than real time.
    pub fn at_rate(self, rate: f64) -> Self {
        Controller { round_trip: RoundTrip::new(rate), tick: TICK.div_f64(rate.max(0.01)), ..self }
    }

    /// The same, with positions that a navigator of ours makes of those that the vehicle tells; else they are as they are told.
    pub fn navigated(mut self, navigator: Box<dyn Navigator>) -> Self {
        self.received.navigator = navigator;
        self
    }

    /// The host's time now, since any moment.
    pub fn tell_time(&mut self, host: Duration) {
        self.host = host;
    }

    /// How long it took by the host's clock to compute the command that comes next, from what was sensed.
    pub fn tell_computed(&mut self, time: Duration) {
        self.computed = time;
    }

    /// What the vehicle measures.
    pub fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    /// Who drives.
    pub fn control(&self) -> Control {
        self.control
    }

    /// What a person was told last: why the vehicle is no longer driven, when it is not.
    pub fn why(&self) -> &str {
        &self.told
    }

    /// How much came.
    pub fn count(&self) -> Count {
        self.received.count
    }

    /// What is to be sent; taken once.
    pub fn take_output(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.out)
    }

    /// What a person should hear of; taken once.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }

    /// Whether the vehicle's time has come to the next tick.
    pub fn is_due(&self) -> bool {
        self.lost || self.latest_tick.is_some_and(|latest| self.next_tick <= latest)
    }

    /// How many ticks of the vehicle's time were heard and wait to be taken.
    pub fn waiting(&self) -> u64 {
        self.latest_tick.map_or(0, |latest| (latest + 1).saturating_sub(self.next_tick))
    }

    /// All that came while nobody looked, for so long, has been heard: it is old, and a state that is made from now on is the vehicle's
    /// word.
    pub fn was_away(&mut self, time: Duration) {
        self.away = Some(Away { until: self.host, longest: self.host + time + AWAY_MORE });
    }

    /// Whether the vehicle's time has gone on since the tick that was taken last, or may have.
    fn is_late(&self) -> bool {
        !self.lost && (self.away.is_some() || self.is_due())
    }

    /// Whether it is the vehicle's last word, of this tick or a later one, that we drive it.
    fn is_ours(&self) -> bool {
        let status = self.heard.back().map_or(self.status, |heard| heard.status);
        self.control == Control::InControl && status.is_driven()
    }

    /// Whether the vehicle lies on the bottom, by its last word.
    pub fn is_aground(&self) -> bool {
        self.grounding.is_aground(self.next_tick)
    }

    /// Takes in bytes, however they are cut.
    pub fn hear(&mut self, bytes: &[u8]) {
        self.received.count.bytes += bytes.len() as u64;
        self.side.hear(bytes, &mut self.received);
        for fact in self.received.take_facts() {
            self.take_in(fact);
        }
    }

    fn take_in(&mut self, fact: Fact) {
        match fact {
            Fact::Time(stamp) => self.take_in_time(stamp),
            Fact::Sample(sample) => self.gather(sample),
            Fact::State(status, holds) => self.take_in_state(status, holds),
            Fact::Accepted(set_point) => self.goals[set_point.place()].held = Some(Held::SetPoint(set_point)),
            Fact::OtherSpeed(text) => self.goals[SetPoint::Speed(0.0).place()].held = Some(Held::Other(text)),
            Fact::HeadingHeard(heading) => self.round_trip.reported(heading, GoalSource::Echo, self.moment()),
            Fact::Aground(aground, _) if self.grounding.hear(aground, self.next_tick) => {}
            Fact::Aground(_, text) | Fact::Notice(text) => self.notice_of_vehicle(text),
        }
    }

    fn take_in_time(&mut self, stamp: Stamp) {
        let tick = match stamp {
            Stamp::Doubtful => return,
            Stamp::Tick(tick) => tick,
            Stamp::ClockSet(tick) => {
                // Who has lost the vehicle hears later what it said meanwhile: that tells nothing of its clock.
                if !self.lost && !matches!(self.want, Want::Leave(_)) {
                    let why = match self.away {
                        Some(_) => "what it said while this computer was stopped is lost",
                        None => "its clock was set",
                    };
                    self.notice_of_vehicle(format!("the vehicle's time leapt: {why}; the mission's time goes on"));
                }
                tick
            }
        };
        self.latest_tick = Some(tick);
        let is_of_now = |away: &Away| self.round_trip.made_after(tick, away.until) || self.host > away.longest;
        self.away = self.away.filter(|away| !is_of_now(away));
    }

    fn take_in_state(&mut self, status: Status, holds: Vec<SetPoint>) {
        for set_point in &holds {
            if let SetPoint::Heading(heading) = set_point {
                self.round_trip.reported(*heading, GoalSource::State, self.moment());
            }
        }
        self.gather(Sample { measurement: VEHICLE_MODE, reading: [f64::from(status.phase.number()), 0.0, 0.0, 0.0] });
        let samples = std::mem::take(&mut self.gathered);
        if self.heard.len() == WAITING_MAX {
            self.heard.pop_front();
        }
        let tick = self.latest_tick.unwrap_or(0);
        self.heard.push_back(Heard { tick, status, holds, samples });
    }

    /// What the vehicle says that it holds. Its depth goal is the vehicle's own affair while it is asked for an altitude.
    fn take_in_goals(&mut self, holds: &[SetPoint]) {
        for held in holds {
            let goal = &mut self.goals[held.place()];
            if goal.asked.is_some_and(|asked| discriminant(&asked) == discriminant(held)) {
                goal.held = Some(Held::SetPoint(*held));
            }
        }
    }

    fn gather(&mut self, sample: Sample) {
        if self.gathered.len() < WAITING_MAX {
            self.gathered.push(sample);
        }
    }

    /// One tick: what was heard up to it, who drives, and what has to be said besides commands.
    pub fn sense(&mut self, snapshot: &mut Snapshot) {
        let tick = self.next_tick;
        self.next_tick += 1;
        snapshot.samples.clear();
        snapshot.answers.clear();
        self.notices.extend(self.allowance.tick(tick));
        let until = self.heard.iter().take_while(|heard| heard.tick <= tick).count();
        let heard: Vec<Heard> = self.heard.drain(..until).collect();
        for heard in heard {
            let status = heard.status;
            self.status = status;
            (self.left, self.ours) = if status.is_left() { (self.left + 1, self.ours) } else { (0, self.ours + 1) };
            self.over = if status.phase == Phase::Over { self.over + 1 } else { 0 };
            self.take_in_goals(&heard.holds);
            snapshot.samples.extend(heard.samples);
        }
        let before = self.control;
        self.control = self.judge(tick);
        if self.control == Control::InControl && before != Control::InControl {
            self.say(&ControllerMessage::Begin);
            self.goals = Default::default();
        } else if self.control != Control::InControl {
            self.round_trip.pause(self.moment());
        }
        snapshot.control = self.control;
        let round_trip = if self.drives() { self.round_trip.ticks(self.moment()) } else { 0 };
        snapshot.lag = Lag { round_trip, host: None };
        snapshot.aground = self.grounding.is_aground(tick);
        let is_late = self.is_late();
        let was_late = std::mem::replace(&mut self.was_late, is_late);
        if is_late {
            return;
        }
        match (self.want, self.control) {
            _ if self.waits_for_answer(tick) => {}
            // Who asks again when it was given back has just asked.
            (Want::Drive { .. }, Control::Requesting) if self.spoke < tick => self.say(&ControllerMessage::TakeOver),
            (Want::GiveBack { .. }, _) => self.say(&ControllerMessage::GiveBack),
            (Want::Drive { .. }, Control::InControl | Control::Suspended) if self.spoke < tick && self.left == 0 => {
                self.keep_alive(tick, was_late);
            }
            _ => {}
        }
    }

    fn drives(&self) -> bool {
        matches!(self.control, Control::InControl | Control::Suspended)
    }

    /// Whether the vehicle has let us drive, now or before it left us.
    fn has_driven(&self) -> bool {
        self.drives() || self.control == Control::Released
    }

    fn moment(&self) -> Moment {
        Moment { tick: self.latest_tick.unwrap_or(0), host: self.host }
    }

    /// The host has heard nothing for too long: the next tick says so.
    pub fn lose(&mut self, why: String) {
        self.lost = true;
        self.notice(why);
    }

    /// What the vehicle brings about, which may be anything, and as much as it likes.
    fn notice_of_vehicle(&mut self, text: String) {
        if self.told != text
            && let Some(text) = self.allowance.admit(text)
        {
            self.notice(text);
        }
    }

    /// What was told last is not told again.
    fn notice(&mut self, text: String) {
        if self.notices.len() < NOTICES_MAX && self.told != text {
            self.told.clone_from(&text);
            self.notices.push(text);
        }
    }
}
