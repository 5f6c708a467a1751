//! Rule 18: who drives, and overrides from their beginning to their end.

use super::activation::{Aborted, Activation, Inside};
use super::body::Todo;
use super::expr::{Scope, number};
use super::timed::{End, Setpoints};
use super::world::{Asked, World, ticks};
use albacore_guidance::CommandFilter;
use albacore_lang::hir::{Action, Activity, ActivityId, Block, Body, Hir, Kind, Override, StmtKind};
use albacore_program::{Cause, Channel, OverrideEnd};
use albacore_vehicle::{Control, Vertical};
use std::cmp::Reverse;

/// What is asked of the vehicle itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    TakeOver,
    GiveBack,
    Release,
}

/// What a mission has of its vehicle.
#[derive(Clone, Copy, PartialEq)]
enum Hold {
    /// The vehicle runs its own plan.
    None,
    /// It has been asked for control.
    Asked,
    /// It is driven.
    Driven,
}

pub struct Controlled {
    pub is_guest: bool,
    /// What the vehicle says of this tick.
    pub shown: Control,
    hold: Hold,
    /// In this tick an override has begun that asks for control.
    asks: bool,
    /// The vehicle has been taken over by the last tick, or has been asked for that.
    was_held: bool,
}

/// What a vehicle says to who has asked it for control.
enum Answer {
    Ours,
    Refused,
    NotYet,
}

impl Controlled {
    pub fn new(is_guest: bool) -> Self {
        let hold = if is_guest { Hold::None } else { Hold::Driven };
        Controlled { is_guest, shown: Control::Disconnected, hold, asks: false, was_held: false }
    }

    /// Whether there is anybody to obey a command.
    pub fn drives(&self) -> bool {
        self.hold == Hold::Driven && self.shown == Control::InControl
    }

    /// Also where the override has not begun its block yet.
    pub fn is_ours(&self) -> bool {
        self.hold != Hold::None && self.shown == Control::InControl
    }

    pub fn go_on_driving(&mut self) {
        self.hold = Hold::Driven;
    }

    /// `when offered` does not ask before the vehicle hands over of its own accord.
    fn answer(&mut self, offered: bool) -> Answer {
        match (self.hold, self.shown) {
            (Hold::None, Control::Offered) if offered => {
                self.hold = Hold::Asked;
                Answer::NotYet
            }
            (Hold::None, _) => Answer::NotYet,
            (_, Control::InControl) => Answer::Ours,
            (_, Control::Refused) => Answer::Refused,
            _ => Answer::NotYet,
        }
    }

    /// What is asked of the vehicle after a tick. Of two overrides that follow one another in it the second takes over from the first;
    /// what the vehicle has taken back, or not given, it is asked for anew.
    pub fn requests(&mut self, is_over: bool) -> Vec<Request> {
        if is_over {
            return vec![Request::Release];
        }
        let has_it = matches!(self.shown, Control::InControl | Control::Suspended);
        let is_held = self.hold != Hold::None;
        let anew = std::mem::take(&mut self.asks) && !has_it;
        let mut requests = Vec::new();
        if self.was_held && (anew || !is_held) {
            requests.push(Request::GiveBack);
        }
        if is_held && (anew || !self.was_held) {
            requests.push(Request::TakeOver);
        }
        self.was_held = is_held;
        requests
    }
}

impl World<'_> {
    /// The vehicle says who drives.
    pub fn hear_control(&mut self, control: Control) {
        if control != self.control.shown {
            self.control.shown = control;
            self.say(format!("control {control:?}"));
        }
    }

    /// Rule 6: at the very start the present heading and depth, at speed 0.
    pub fn stand(&mut self) {
        let (course, depth) = (self.heading(), self.depth().unwrap_or(0.0));
        self.filter = CommandFilter::new(course);
        self.asked = Asked { course, over_ground: false, speed: 0.0, vertical: Vertical::Depth(depth) };
    }

    /// From here on nothing is amended and nothing limited.
    fn give_back(&mut self) {
        self.control.hold = Hold::None;
        for name in std::mem::take(&mut self.amending).into_values() {
            self.say(format!("amend {name} no more"));
        }
        for channel in Channel::ALL {
            if std::mem::take(&mut self.limited[channel as usize]) {
                self.say(format!("limit {channel:?} no more"));
            }
        }
    }
}

/// An override under way.
pub struct Overriding<'p> {
    written: &'p Override,
    pub block: Activation<'p>,
    /// How long it waits for an answer.
    patience: Option<u64>,
    is_given: bool,
    /// As long as nothing else becomes of it.
    end: OverrideEnd,
}

impl<'p> Overriding<'p> {
    pub fn new(
        w: &mut World<'p>,
        wearer: &Activation<'p>,
        written: &'p Override,
        setpoints: Setpoints,
        rounds: String,
    ) -> Self {
        let patience = written.answer.as_ref().map(|e| ticks(number(w, Scope::of(&wearer.frame), e)));
        let mut block = Activation::new(w.override_block, wearer.frame.clone(), setpoints, false);
        block.rounds = rounds;
        Overriding { written, block, patience, is_given: false, end: OverrideEnd::Completed }
    }

    pub fn begin(&mut self, w: &mut World<'p>) -> Result<(), Aborted> {
        self.block.begin(w)?;
        if !self.written.offered {
            w.control.hold = Hold::Asked;
            w.control.asks = true;
        }
        Ok(())
    }

    /// A tick: whether it has come to its end.
    pub fn step(&mut self, w: &mut World<'p>) -> Result<bool, Aborted> {
        if self.is_given {
            return match w.control.shown {
                Control::InControl => self.block.step(w),
                // The block stands still, and its time with it.
                Control::Suspended => Ok(false),
                _ => Ok(self.ends(OverrideEnd::TakenBack)),
            };
        }
        match w.control.answer(self.written.offered) {
            Answer::Ours => {
                self.is_given = true;
                w.control.hold = Hold::Driven;
                w.stand();
                self.block.inside = Inside::Sequence(vec![Todo::Stmts(&self.written.block.stmts)]);
                return self.block.step(w);
            }
            Answer::Refused => return Ok(self.ends(OverrideEnd::Refused)),
            Answer::NotYet => {}
        }
        self.block.age += 1;
        let age = self.block.age;
        Ok(self.patience.is_some_and(|patience| age >= patience) && self.ends(OverrideEnd::NoAnswer))
    }

    fn ends(&mut self, end: OverrideEnd) -> bool {
        self.end = end;
        true
    }

    /// What `let end = …` gets.
    pub fn end(&self, end: &End) -> OverrideEnd {
        match end {
            End::ByItself => self.end,
            End::Cut(Cause::TimedOut) => OverrideEnd::TimedOut,
            // It has asked, and nobody has answered.
            End::Cut(_) if !self.is_given && !self.written.offered => OverrideEnd::NoAnswer,
            End::Cut(_) => OverrideEnd::Completed,
        }
    }

    /// Control is given back however it ends. Rule 13: an override may have causes of its own.
    pub fn leave(&mut self, w: &mut World<'p>, cause: Cause) {
        let cause = match (cause, self.end) {
            (Cause::Done, OverrideEnd::Refused) => Cause::Refused,
            (Cause::Done, OverrideEnd::NoAnswer) => Cause::NoAnswer,
            (Cause::Done, OverrideEnd::TakenBack) => Cause::TakenBack,
            (cause, _) => cause,
        };
        if self.block.is_active {
            self.block.leave(w, cause);
            w.give_back();
        }
    }
}

/// Nobody reads how an override has ended: what the run ends as, unless that is `completed`.
pub fn unread(end: f64) -> Result<(), Aborted> {
    let (why, outcome) = match OverrideEnd::from_number(end) {
        OverrideEnd::Completed => return Ok(()),
        OverrideEnd::Refused => ("the vehicle would not be overridden", "refused"),
        OverrideEnd::NoAnswer => ("no answer to an override", "link_lost"),
        OverrideEnd::TakenBack => ("the vehicle took control back", "released_by_vehicle"),
        OverrideEnd::TimedOut => ("an override was cut off", "timed_out"),
    };
    Err(Aborted { why: why.to_string(), ends_as: Some(outcome) })
}

/// Where an overlay stands among those that are worn: inner ones first, which are those of a later `with`; in one `with` the later is the
/// outer one.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place(Reverse<u64>, usize);

impl Place {
    pub fn new(with: u64, of_it: usize) -> Self {
        Place(Reverse(with), of_it)
    }
}

/// The activity that an override's block is: it declares nothing, and is no behavior whose name tells what it does.
pub fn override_block(hir: &Hir, mission: ActivityId) -> Activity {
    Activity { kind: Kind::Mission, ..Activity::empty("override", hir.activities[mission].span) }
}

/// Whether `watch` or `override` stands in a mission, or in what it calls.
pub fn is_guest(hir: &Hir, mission: ActivityId) -> bool {
    let (mut ahead, mut seen) = (vec![mission], Vec::new());
    while let Some(id) = ahead.pop() {
        if seen.contains(&id) {
            continue;
        }
        seen.push(id);
        match &hir.activities[id].body {
            Body::Sequence(block) if controls(block, &mut ahead) => return true,
            Body::Table { behaviors, .. } => ahead.extend(behaviors),
            _ => {}
        }
    }
    false
}

fn controls(block: &Block, called: &mut Vec<ActivityId>) -> bool {
    let mut found = false;
    for stmt in &block.stmts {
        if let StmtKind::Timed(timed) = &stmt.kind {
            match &timed.action {
                Action::Watch | Action::Override(_) => found = true,
                Action::Call(id, _) => called.push(*id),
                _ => {}
            }
        }
        found |= stmt.blocks().into_iter().any(|block| controls(block, called));
    }
    found
}
