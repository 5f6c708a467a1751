//! The controller's side: a state machine of the bytes that come from the vehicle and the ticks that are taken from it.
//!
//! It has no clock: the host's time is told to it, and measures nothing but the round trip. The vehicle's time stamps make the
//! ticks, so that the same bytes give the same samples however late they are read. What is sent is sent in the newest of them
//! alone: a tick that is late asks for what the vehicle is past.

mod judge;
mod late;
mod speak;

use super::allowance::Allowance;
use super::frame::Deframer;
use super::goal::Goal;
use super::grounding::Grounding;
use super::message::{Adcp, FromVehicle, State, ToVehicle};
use super::mode::{Mode, Phase};
use super::round_trip::{GoalSource, Moment, RoundTrip};
use super::vehicle_time::{Stamp, VehicleTime};
use albacore_geometry::math::atan2;
use albacore_geometry::{Heading, TangentFrame, Vector};
use albacore_vehicle::channels::{
    self, ALTITUDE, BATTERY, CHEMICAL, COURSE, DEPTH, FLOW, HEADING, POSITION, SALINITY, SPEED, TEMPERATURE,
    VEHICLE_MODE, WATER_DEPTH,
};
use albacore_vehicle::{Channel, Control, Lag, Sample, Snapshot};
use judge::is_left;
use late::Late;
use std::collections::VecDeque;
use std::time::Duration;

/// The dialect does not say how well the vehicle knows its position. Ours: what dead reckoning between acoustic fixes of
/// 2 m comes to, m an axis.
const POSITION_SIGMA: f64 = 3.0;
/// The fluorometer's full scale: 5 V, as the 2003 trials' Seapoint gives. The sources give no unit.
pub(super) const FULL_SCALE_VOLTS: f64 = 5.0;
/// The course over ground is the heading and a drift angle that `#A` tells; older than this it is not known, ticks.
const DRIFT_TICKS: u64 = 50;
/// A vehicle that goes no faster than this by its own word is at rest, m/s: a profiler that tells 0 then is in order, and one
/// that tells 0 of a vehicle under way is not.
const AT_REST: f64 = 0.05;
/// Frames that wait for their tick; the oldest are given up.
const WAITING_MAX: usize = 4096;
/// A tick of the vehicle's time.
const TICK: Duration = Duration::from_millis(100);
/// Notices that wait to be read.
const NOTICES_MAX: usize = 128;
/// After a pause states from before it may come for as long as it was, and for so long more.
const AWAY_MORE: Duration = Duration::from_secs(5);

/// The places of the goals.
const HEADING_GOAL: usize = 0;
const SPEED_GOAL: usize = 1;
const VERTICAL_GOAL: usize = 2;

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
    mode: Mode,
    heading_goal: Heading,
    depth_goal: f64,
    samples: Vec<Sample>,
}

/// How much came, and how much of it made sense.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Bytes.
    pub bytes: u64,
    /// Lines that were messages.
    pub messages: u64,
    /// Lines that were none.
    pub unreadable: u64,
}

/// The controller's side of the dialect.
pub struct Controller {
    channels: Vec<Channel>,
    frame: TangentFrame,
    deframer: Deframer,
    time: VehicleTime,
    heard: VecDeque<Heard>,
    /// Samples of messages that belong to the next `#S`.
    gathered: Vec<Sample>,
    /// How far the course is clockwise of the heading, rad, and the tick that it is of.
    drift: Option<(f64, u64)>,
    /// By the last state, m/s.
    speed: f64,
    latest_tick: Option<u64>,
    next_tick: u64,
    mode: Mode,
    control: Control,
    want: Want,
    lost: bool,
    /// Lines in which the vehicle has said that nobody drives it, one after the other.
    left: u64,
    /// ... and that its mission is over.
    over: u64,
    /// Lines in which it has said that we drive it, since we asked or ask again.
    ours: u64,
    goals: [Goal; 3],
    /// Ticks whose commands came too late to be sent, since the last that was.
    late: Late,
    /// It was told that a tick takes longer to compute than it lasts.
    told_slow: bool,
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
    out: Vec<u8>,
    count: Count,
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
    /// Hears a vehicle, in the mission's frame; nothing is sent before [`Controller::take_over`].
    pub fn new(frame: TangentFrame) -> Self {
        Controller {
            channels: channels::all(),
            frame,
            deframer: Deframer::default(),
            time: VehicleTime::default(),
            heard: VecDeque::new(),
            gathered: Vec::new(),
            drift: None,
            speed: 0.0,
            latest_tick: None,
            next_tick: 0,
            mode: Mode::default(),
            control: Control::Disconnected,
            want: Want::Listen,
            lost: false,
            left: 0,
            over: 0,
            ours: 0,
            goals: Default::default(),
            late: Late::default(),
            told_slow: false,
            computed: Duration::ZERO,
            tick: TICK,
            was_late: false,
            away: None,
            round_trip: RoundTrip::new(1.0),
            host: Duration::ZERO,
            grounding: Grounding::default(),
            spoke: 0,
            out: Vec::new(),
            count: Count::default(),
            notices: Vec::new(),
            allowance: Allowance::default(),
            told: String::new(),
        }
    }

    /// The same, of a vehicle that runs so many times faster than real time.
    pub fn at_rate(self, rate: f64) -> Self {
        Controller { round_trip: RoundTrip::new(rate), tick: TICK.div_f64(rate.max(0.01)), ..self }
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
    pub fn channels(&self) -> &[Channel] {
        &self.channels
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
        self.count
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
        let mode = self.heard.back().map_or(self.mode, |heard| heard.mode);
        self.control == Control::InControl
            && mode.phase() == Phase::InMission
            && mode.has(Mode::ACTIVE)
            && !mode.has(Mode::NOT_ALLOWED)
    }

    /// Takes in bytes, however they are cut.
    pub fn hear(&mut self, bytes: &[u8]) {
        self.count.bytes += bytes.len() as u64;
        let mut deframer = std::mem::take(&mut self.deframer);
        deframer.push(bytes, |frame| {
            // A line that is no frame and a frame that is no message come to the same: noise.
            if let Some(message) = frame.ok().and_then(|body| FromVehicle::parse(body).ok()) {
                self.count.messages += 1;
                self.take_in(message);
            } else {
                self.count.unreadable += 1;
            }
        });
        self.deframer = deframer;
    }

    fn take_in(&mut self, message: FromVehicle) {
        match message {
            FromVehicle::State(state) => self.take_in_state(&state),
            FromVehicle::Adcp(adcp) => self.take_in_adcp(&adcp),
            FromVehicle::Fluorometer { value, .. } => self.gather(CHEMICAL, &[value / FULL_SCALE_VOLTS]),
            FromVehicle::Battery { percent, .. } => self.gather(BATTERY, &[percent / 100.0]),
            FromVehicle::Accepted(text) => self.take_in_echo(&text),
            FromVehicle::Error(code, text) if self.grounding.hear(code, &text, self.next_tick) => {}
            FromVehicle::Error(code, text) => {
                let comma = if text.is_empty() { "" } else { ", " };
                self.notice_of_vehicle(format!("the vehicle says: error {code}{comma}{text}"));
            }
            FromVehicle::Ctd(ctd) => {
                self.gather(TEMPERATURE, &[ctd.temperature]);
                self.gather(SALINITY, &[ctd.salinity]);
            }
            FromVehicle::Version(_) | FromVehicle::Other(_) => {}
        }
    }

    fn take_in_state(&mut self, state: &State) {
        let tick = match self.time.hear(state.time_ms) {
            Stamp::Doubtful => return,
            Stamp::Tick(tick) => tick,
            Stamp::ClockSet(tick) => {
                // Who has lost the vehicle hears later what it said meanwhile: that tells nothing of its clock.
                if !self.lost && !matches!(self.want, Want::Leave(_)) {
                    self.notice_of_vehicle(
                        "the vehicle's time leapt: its clock was set; the mission's time goes on".to_string(),
                    );
                }
                tick
            }
        };
        self.latest_tick = Some(tick);
        let is_of_now = |away: &Away| self.round_trip.made_after(tick, away.until) || self.host > away.longest;
        self.away = self.away.filter(|away| !is_of_now(away));
        self.round_trip.told(state.heading_goal, GoalSource::State, self.moment());
        self.speed = state.speed;
        let position = self.frame.to_point(state.position);
        self.gather(POSITION, &[position.north, position.east, POSITION_SIGMA]);
        if let Some((angle, _)) = self.drift.filter(|(_, of)| tick.saturating_sub(*of) <= DRIFT_TICKS) {
            self.gather(COURSE, &[(state.heading + angle).radians()]);
        }
        self.gather(HEADING, &[state.heading.radians()]);
        self.gather(SPEED, &[state.speed]);
        self.gather(DEPTH, &[state.depth]);
        if let Some(altitude) = state.altitude {
            self.gather(ALTITUDE, &[altitude]);
            self.gather(WATER_DEPTH, &[state.depth + altitude]);
        }
        self.gather(VEHICLE_MODE, &[f64::from(state.mode.0 & 0x03)]);
        let samples = std::mem::take(&mut self.gathered);
        if self.heard.len() == WAITING_MAX {
            self.heard.pop_front();
        }
        let State { mode, heading_goal, depth_goal, .. } = *state;
        self.heard.push_back(Heard { tick, mode, heading_goal, depth_goal, samples });
    }

    /// An echo is no acceptance, but it was heard: what `#S` tells of the goals, it tells better. Of speed and altitude it tells
    /// nothing.
    fn take_in_echo(&mut self, text: &str) {
        match ToVehicle::parse(&format!("C,{text}")) {
            Ok(speed @ ToVehicle::Speed(_)) => self.goals[SPEED_GOAL].held = Some(speed),
            Ok(altitude @ ToVehicle::Altitude(_)) => self.goals[VERTICAL_GOAL].held = Some(altitude),
            Ok(ToVehicle::Heading(heading)) => self.round_trip.told(heading, GoalSource::Echo, self.moment()),
            _ => {}
        }
    }

    /// What the vehicle says that it holds. Its depth goal is the vehicle's own affair while it is asked for an altitude.
    fn take_in_goals(&mut self, heading: Heading, depth: f64) {
        self.goals[HEADING_GOAL].held = Some(ToVehicle::Heading(heading));
        let vertical = &mut self.goals[VERTICAL_GOAL];
        if matches!(vertical.asked, Some(ToVehicle::Depth(_))) {
            vertical.held = Some(ToVehicle::Depth(depth));
        }
    }

    fn take_in_adcp(&mut self, adcp: &Adcp) {
        let tick = self.latest_tick.unwrap_or(0);
        if adcp.ahead != 0.0 || adcp.starboard != 0.0 {
            self.drift = Some((atan2(adcp.starboard, adcp.ahead), tick));
        } else if self.speed < AT_REST {
            // At rest any direction is that of the course: no instrument is missing. The last one goes on.
            self.drift = Some((self.drift.map_or(0.0, |(angle, _)| angle), tick));
        }
        if let Some((ahead, starboard)) = adcp.current {
            let unit = adcp.heading.unit();
            let flow =
                Vector::new(ahead * unit.north - starboard * unit.east, ahead * unit.east + starboard * unit.north);
            self.gather(FLOW, &[flow.north, flow.east]);
        }
    }

    fn gather(&mut self, channel: u16, numbers: &[f64]) {
        let mut reading = [0.0; 4];
        reading[..numbers.len()].copy_from_slice(numbers);
        if self.gathered.len() < WAITING_MAX {
            self.gathered.push(Sample { channel, reading });
        }
    }

    /// One tick: what was heard up to it, who drives, and what has to be said besides commands.
    pub fn sense(&mut self, snapshot: &mut Snapshot) {
        let tick = self.next_tick;
        self.next_tick += 1;
        snapshot.samples.clear();
        self.notices.extend(self.allowance.tick(tick));
        let until = self.heard.iter().take_while(|heard| heard.tick <= tick).count();
        let heard: Vec<Heard> = self.heard.drain(..until).collect();
        for heard in heard {
            self.mode = heard.mode;
            (self.left, self.ours) = if is_left(heard.mode) { (self.left + 1, self.ours) } else { (0, self.ours + 1) };
            self.over = if heard.mode.phase() == Phase::Over { self.over + 1 } else { 0 };
            self.take_in_goals(heard.heading_goal, heard.depth_goal);
            snapshot.samples.extend(heard.samples);
        }
        let before = self.control;
        self.control = self.judge(tick);
        if self.control == Control::InControl && before != Control::InControl {
            // The first commands of the first override are accepted after a question only.
            self.say(&ToVehicle::Query("Depth".into()));
            self.goals = Default::default();
        } else if self.control != Control::InControl {
            self.round_trip.pause();
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
            (Want::Drive { .. }, Control::Requesting) if self.spoke < tick => self.say(&ToVehicle::Override(true)),
            (Want::GiveBack { .. }, _) => self.say(&ToVehicle::Override(false)),
            // After late ticks a command comes first.
            (Want::Drive { .. }, Control::InControl | Control::Suspended)
                if self.spoke < tick && !was_late && self.left == 0 =>
            {
                self.keep_alive(tick);
            }
            _ => {}
        }
    }

    fn drives(&self) -> bool {
        matches!(self.control, Control::InControl | Control::Suspended)
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
