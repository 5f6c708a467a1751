//! Rules 3 to 5: a statement that takes time, from its beginning to its end.

use super::activation::{Aborted, Activation};
use super::control::Overriding;
use super::expr::{Frame, Scope, holds, number, values};
use super::value::Value;
use super::watch::Watch;
use super::world::{World, ticks};
use albacore_geometry::Heading;
use albacore_guidance::{Guidance, LawOverWords, Start, Station, Whereabouts, turning_radius_in_flow};
use albacore_lang::hir::{Action, Expr, Timed};
use albacore_program::{Cause, Channel, Guide, OverrideEnd, ParamKind, Steering};
use albacore_vehicle::Vertical;

/// The vertical and the speed in force; none where nobody has set them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Setpoints {
    pub vertical: Option<Vertical>,
    pub speed: Option<f64>,
}

impl Setpoints {
    pub fn set(&mut self, channel: Channel, value: f64) {
        match channel {
            Channel::Depth => self.vertical = Some(Vertical::Depth(value)),
            Channel::Altitude => self.vertical = Some(Vertical::Altitude(value)),
            Channel::Speed => self.speed = Some(value),
        }
    }
}

pub struct Underway<'p> {
    pub timed: &'p Timed,
    /// Rule 4: frozen when it begins, in ticks of its activation.
    began: u64,
    duration: Option<u64>,
    within: Option<u64>,
    setpoints: Setpoints,
    until: Watch<'p>,
    pub doing: Doing<'p>,
}

pub enum Doing<'p> {
    Guide(Guide, Vec<Value>, Law),
    Keep(Channel, &'p Expr),
    Call(Box<Activation<'p>>),
    /// Rule 18: nothing is sent.
    Watch,
    Override(Box<Overriding<'p>>),
    /// What is asked, the number of the question once it is, and the answer once it has come.
    Ask(String, Option<u64>, Option<Option<bool>>),
}

impl<'p> Doing<'p> {
    /// What is inside it, and active.
    pub fn called(&mut self) -> Option<&mut Activation<'p>> {
        match self {
            Doing::Call(called) => Some(called),
            Doing::Override(overriding) => Some(&mut overriding.block),
            _ => None,
        }
    }

    pub fn leave(&mut self, w: &mut World<'p>, cause: Cause) {
        match self {
            Doing::Call(called) => called.leave(w, cause),
            Doing::Override(overriding) => overriding.leave(w, cause),
            _ => {}
        }
    }
}

/// A guidance law that has begun.
pub enum Law {
    /// With its state in words.
    Leading(LawOverWords, Vec<f64>),
    Station(Station),
    /// Nothing to remember.
    None,
}

/// How a statement ended.
pub enum End {
    ByItself,
    Cut(Cause),
}

impl<'p> Underway<'p> {
    /// All is frozen, in the order of the text; what is called is entered afterwards, by [`Underway::first`].
    pub fn new(w: &mut World<'p>, wearer: &Activation<'p>, timed: &'p Timed, rounds: String) -> Self {
        let (frame, age) = (&wearer.frame, wearer.age);
        let s = Scope::of(frame);
        let mut setpoints = wearer.setpoints;
        for (channel, e) in &timed.at {
            setpoints.set(*channel, number(w, s, e));
        }
        let mut frozen = |e: &Option<Expr>| e.as_ref().map(|e| ticks(number(w, s, e)));
        let (duration, within) = (frozen(&timed.duration), frozen(&timed.within));
        let until = Watch::begin(w, frame, &timed.until.iter().collect::<Vec<_>>(), age);
        let doing = match &timed.action {
            Action::Guide(guide, args) => {
                let args = values(w, s, args);
                let law = law(w, *guide, &args, setpoints);
                Doing::Guide(*guide, args, law)
            }
            Action::Keep(channel, e) => Doing::Keep(*channel, e),
            Action::Ask(payload, action) => Doing::Ask(w.hir.payloads[*payload].action(*action), None, None),
            Action::Watch => Doing::Watch,
            Action::Override(o) => Doing::Override(Box::new(Overriding::new(w, wearer, o, setpoints, rounds))),
            Action::Call(id, args) => {
                let activity = &w.hir.activities[*id];
                let args = values(w, s, args);
                let frame = Frame::new(w, &activity.vars, args);
                Doing::Call(Box::new(Activation::new(activity, frame, setpoints, wearer.is_overlay)))
            }
        };
        Underway { timed, began: age, duration, within, setpoints, until, doing }
    }

    /// The tick on which it begins: rule 3, its end is not tested.
    pub fn first(&mut self, w: &mut World<'p>, frame: &Frame<'p>, in_overlay: bool) -> Result<(), Aborted> {
        match &mut self.doing {
            Doing::Call(called) => called.begin(w),
            Doing::Override(overriding) => overriding.begin(w),
            _ => self.act(w, frame, in_overlay).map(|_| ()),
        }
    }

    /// Every later tick: its own end first, so that an end on the very tick of the cut is its own; then `for` and `until`,
    /// then `within` (rule 5).
    pub fn step(
        &mut self,
        w: &mut World<'p>,
        frame: &Frame<'p>,
        age: u64,
        in_overlay: bool,
    ) -> Result<Option<End>, Aborted> {
        self.until.update(w, frame, age);
        // Rule 4: `steer` reads its course at every tick.
        if let (Doing::Guide(guide, args, _), Action::Guide(_, written)) = (&mut self.doing, &self.timed.action)
            && guide.law().reads_arguments_anew()
        {
            *args = values(w, Scope::of(frame), written);
        }
        if self.act(w, frame, in_overlay)? {
            return Ok(Some(End::ByItself));
        }
        let gone = |limit: Option<u64>| limit.is_some_and(|limit| age - self.began >= limit);
        let scope = Scope { frame, watch: Some(&self.until), done: false };
        if self.timed.until.as_ref().is_some_and(|until| holds(w, scope, until)) || gone(self.duration) {
            return Ok(Some(End::Cut(Cause::Until)));
        }
        Ok(gone(self.within).then_some(End::Cut(Cause::TimedOut)))
    }

    /// One tick of what it does; tells whether that came to its own end.
    fn act(&mut self, w: &mut World<'p>, frame: &Frame<'p>, in_overlay: bool) -> Result<bool, Aborted> {
        let (position, course) = (w.position(), w.course());
        let guidance: Guidance = match &mut self.doing {
            Doing::Call(called) => return called.step(w),
            Doing::Override(overriding) => return overriding.step(w),
            Doing::Watch => return Ok(false),
            Doing::Ask(action, asked, answer) => {
                let Some(id) = asked else {
                    *asked = Some(w.question());
                    w.say(format!("ask {action}"));
                    return Ok(false);
                };
                *answer = w.answers.get(id).copied();
                let said = answer.map(|value| value.map_or("refused".to_string(), |value| value.to_string()));
                said.iter().for_each(|said| w.say(format!("answer {action} {said}")));
                return Ok(said.is_some());
            }
            Doing::Keep(channel, e) => {
                let kept = number(w, Scope::of(frame), e);
                if in_overlay {
                    w.kept.set(*channel, kept);
                } else {
                    let mut setpoints = self.setpoints;
                    setpoints.set(*channel, kept);
                    ask(w, w.asked.course, w.asked.over_ground, setpoints);
                }
                return Ok(false);
            }
            // What an overlay does not `keep` it leaves as it is.
            Doing::Guide(..) if in_overlay => return Ok(false),
            Doing::Guide(guide, args, law) => match law {
                Law::Leading(law, state) => (law.step)(state, position, course),
                Law::Station(law) => {
                    ask(w, w.asked.course, w.asked.over_ground, self.setpoints);
                    w.asked.speed = 0.0;
                    let most = w.fastest;
                    let at = Whereabouts { position: w.known_position(), course };
                    let stay = law.step(at, self.setpoints.speed.unwrap_or(most));
                    w.way_back = stay.way;
                    if let Some(adrift) = stay.adrift {
                        w.say(format!("adrift {adrift}"));
                    }
                    return Ok(false);
                }
                Law::None => {
                    if let Steering::Along { over_ground } = guide.law().steering {
                        ask(w, args[0].heading(), over_ground, self.setpoints);
                    }
                    return Ok(false);
                }
            },
        };
        ask(w, guidance.course, true, self.setpoints);
        w.is_lost |= w.known_position().is_none();
        Ok(guidance.arrived)
    }

    /// What `let x = …` gets: of a call with a result that result, or none when it was cut; else whether `within` did not
    /// cut it off (rule 5).
    pub fn outcome(&self, w: &World<'p>, end: &End) -> Value {
        if let Doing::Ask(_, _, answer) = &self.doing {
            let end = match answer {
                Some(Some(_)) => OverrideEnd::Completed,
                Some(None) => OverrideEnd::Refused,
                None => OverrideEnd::NoAnswer,
            };
            let value = Value::truth(*answer == Some(Some(true)));
            return Value::Parts(vec![Value::Number(end.number()), value]);
        }
        if let Doing::Override(overriding) = &self.doing {
            return Value::Number(overriding.end(end).number());
        }
        let Doing::Call(called) = &self.doing else { return Value::truth(!matches!(end, End::Cut(Cause::TimedOut))) };
        let Some(ty) = &self.timed.value else {
            return Value::truth(!matches!(end, End::Cut(Cause::TimedOut)));
        };
        let can_be_cut = self.duration.is_some() || self.within.is_some() || self.timed.until.is_some();
        let result = called.result.clone().unwrap_or_else(|| Value::nothing(&w.shape(ty)));
        match end {
            End::Cut(_) => Value::Maybe(None),
            End::ByItself if can_be_cut && !ty.is_optional() => result.present(),
            End::ByItself => result,
        }
    }
}

fn ask(w: &mut World<'_>, course: Heading, over_ground: bool, setpoints: Setpoints) {
    w.asked.course = course;
    w.asked.over_ground = over_ground;
    w.asked.speed = setpoints.speed.unwrap_or(w.asked.speed);
    w.asked.vertical = setpoints.vertical.unwrap_or(w.asked.vertical);
}

/// A guidance law from its frozen arguments.
fn law(w: &World<'_>, guide: Guide, args: &[Value], setpoints: Setpoints) -> Law {
    // Speeds below 0.1 m/s turn in no circle worth planning with.
    let speed = setpoints.speed.unwrap_or(w.asked.speed).max(0.1);
    match guide.law().steering {
        Steering::Law(law) => {
            let turning_radius = turning_radius_in_flow(speed, w.flow().length(), w.turn_rate);
            let start = Start { position: w.position(), course: w.course(), speed, turning_radius };
            let args: Vec<f64> = guide.law().params.iter().zip(args).flat_map(|(p, arg)| words(p.kind, arg)).collect();
            let mut state = vec![0.0; law.words];
            (law.begin)(&args, &start, &mut state);
            Law::Leading(law, state)
        }
        Steering::Station => Law::Station(Station::new(w.known_position())),
        Steering::Along { .. } | Steering::AsBefore | Steering::Nothing => Law::None,
    }
}

/// An argument as a law reads it.
fn words(kind: ParamKind, arg: &Value) -> Vec<f64> {
    match kind {
        ParamKind::Point => vec![arg.point().north, arg.point().east],
        ParamKind::Line => [arg.line().start, arg.line().end].iter().flat_map(|p| [p.north, p.east]).collect(),
        ParamKind::Bool => vec![f64::from(u8::from(arg.holds()))],
        ParamKind::Heading | ParamKind::Length | ParamKind::Number => vec![arg.number()],
    }
}
