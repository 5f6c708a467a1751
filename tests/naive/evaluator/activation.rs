//! An activation: a behavior, strategy, overlay, mission or recovery that is active, with all that is inside it.

use super::body::{Stop, Todo, advance, at_once, rounds_under_way};
use super::control::{Place, unread};
use super::expr::{Frame, Scope, block, exactly, holds, text, value};
use super::table::Table;
use super::timed::{Doing, End, Setpoints, Underway};
use super::value::Value;
use super::watch::{Rhythms, Watch};
use super::world::World;
use albacore_geometry::Heading;
use albacore_lang::hir::{Action, Activity, ActivityId, Block, Body, Decl, Hir, Kind, Stmt, StmtKind, Timed, With};
use albacore_lang::types::Type;
use albacore_program::{Axis, Cause, TURN_RATE_MIN};

/// Why the mission is aborted.
pub struct Aborted {
    pub why: String,
    /// Rule 18: what the run ends as where nobody has read how an override ended.
    pub ends_as: Option<&'static str>,
}

impl Aborted {
    pub fn because(why: String) -> Self {
        Aborted { why, ends_as: None }
    }
}

pub struct Activation<'p> {
    pub activity: &'p Activity,
    pub frame: Frame<'p>,
    /// Ticks lived: none on the tick of entry. Stands still while it waits, and with it every timer (rule 12).
    pub age: u64,
    pub setpoints: Setpoints,
    pub is_overlay: bool,
    /// What it finished with.
    pub result: Option<Value>,
    /// Conditions over time: of each declaration, and of aborts and reactions.
    signals: Vec<Watch<'p>>,
    conditions: Watch<'p>,
    /// Of its reactions, and of its rules.
    pub rhythms: Rhythms,
    /// Overlays by the `with` that put them on, inner ones last; those of the declarations are the first.
    worn: Vec<Worn<'p>>,
    pub inside: Inside<'p>,
    /// It began and has not been left.
    pub is_active: bool,
    /// An overlay: its place among those that are worn.
    place: Place,
    /// The block of an override: the rounds of the loops around that.
    pub rounds: String,
}

struct Worn<'p> {
    overlays: Vec<Activation<'p>>,
    /// The setpoints that come back into force when the `with` ends.
    before: Setpoints,
    count: u64,
}

pub enum Inside<'p> {
    Sequence(Vec<Todo<'p>>),
    Table(Table<'p>),
    Amend,
}

impl<'p> Activation<'p> {
    pub fn new(activity: &'p Activity, frame: Frame<'p>, setpoints: Setpoints, is_overlay: bool) -> Self {
        let inside = match &activity.body {
            Body::Sequence(_) => Inside::Sequence(Vec::new()),
            Body::Table { .. } => Inside::Table(Table::default()),
            Body::Amend { .. } => Inside::Amend,
        };
        Activation {
            activity,
            frame,
            age: 0,
            setpoints,
            is_overlay,
            result: None,
            signals: Vec::new(),
            conditions: Watch::default(),
            rhythms: Rhythms::default(),
            worn: Vec::new(),
            inside,
            is_active: false,
            place: Place::default(),
            rounds: String::new(),
        }
    }

    fn open_with(&mut self, w: &mut World<'p>) {
        w.withs += 1;
        self.worn.push(Worn { overlays: Vec::new(), before: self.setpoints, count: w.withs });
    }

    fn title(&self) -> String {
        self.activity.name.clone()
    }

    /// Rule 9: declarations in the order of the text, reactions, body. Aborts and rules are first tried on the next tick.
    pub fn begin(&mut self, w: &mut World<'p>) -> Result<(), Aborted> {
        let activity = self.activity;
        w.say(format!("enter {}", self.title()));
        self.is_active = true;
        self.open_with(w);
        let frame = self.frame.clone();
        for decl in &activity.decls {
            let condition = if let Decl::Signal(_, e) = decl { vec![e] } else { Vec::new() };
            let watch = Watch::begin(w, &frame, &condition, self.age);
            let s = Scope { frame: &frame, watch: Some(&watch), done: false };
            match decl {
                Decl::With(items) => self.put_on(w, items)?,
                Decl::Signal(var, e) | Decl::Area(var, e) | Decl::Memory(var, Some(e)) => {
                    let value = match value(w, s, e) {
                        Value::List(list) => Value::List(super::expr::sorted(w, &frame, *var, list)),
                        other => other,
                    };
                    frame.set(*var, value);
                }
                Decl::Memory(var, None) => {
                    let nothing = Value::nothing(&w.shape(&frame.declared[*var].ty));
                    frame.set(*var, nothing);
                }
            }
            self.signals.push(watch);
        }
        if let Some(limit) = activity.mission.as_ref().and_then(|mission| mission.turn_rate.as_ref()) {
            let rate = super::expr::number(w, Scope::of(&frame), limit);
            w.turn_rate = rate.max(TURN_RATE_MIN);
        }
        let aborts = activity.aborts.iter().map(|(_, condition)| condition);
        let conditions: Vec<_> = aborts.chain(activity.reactions.iter().map(|(condition, _)| condition)).collect();
        self.conditions = Watch::begin(w, &frame, &conditions, self.age);
        self.conditions.update_rhythms(w, &frame, &self.rhythms, self.age);
        self.react(w);
        match &activity.body {
            // Rule 6: a body that ends without having taken time ends on the next tick.
            Body::Sequence(block) => self.begin_body(w, block),
            Body::Table { start, .. } => self.in_table(|owner, table| table.enter(w, owner, *start)),
            Body::Amend { .. } => Ok(()),
        }
    }

    pub fn begin_body(&mut self, w: &mut World<'p>, block: &'p Block) -> Result<(), Aborted> {
        self.inside = Inside::Sequence(vec![Todo::Stmts(&block.stmts)]);
        self.go_on(w).map(|_| ())
    }

    /// Rule 2: signals and timers; aborts; (overlays;) rules; reactions; body. Tells whether it came to its own end.
    pub fn step(&mut self, w: &mut World<'p>) -> Result<bool, Aborted> {
        self.age += 1;
        w.steps += 1;
        self.refresh(w);
        self.test_aborts(w)?;
        self.step_overlays(w)?;
        let fired = match self.inside {
            Inside::Table(_) => self.in_table(|owner, table| table.try_rules(w, owner, false))?,
            _ => None,
        };
        if fired.is_some_and(|fired| fired.finishes) {
            return Ok(true);
        }
        self.react(w);
        match self.inside {
            // A rule of the behavior that was just entered is first tried on the next tick, and its body has begun (rule 9).
            Inside::Table(_) if fired.is_some() => Ok(false),
            Inside::Table(_) => self.in_table(|owner, table| table.step(w, owner)),
            Inside::Sequence(_) => self.go_on(w),
            Inside::Amend => Ok(false),
        }
    }

    /// Signals in the order of the text; lists that are kept in order are so as of this tick.
    pub fn refresh(&mut self, w: &mut World<'p>) {
        let frame = &self.frame;
        for (decl, watch) in self.activity.decls.iter().zip(&mut self.signals) {
            match decl {
                Decl::Signal(var, e) => {
                    watch.update(w, frame, self.age);
                    let value = value(w, Scope { frame, watch: Some(watch), done: false }, e);
                    frame.set(*var, value);
                }
                Decl::Memory(var, _) if matches!(frame.declared[*var].ty, Type::List(..)) => {
                    let list = frame.get(*var).list().to_vec();
                    let list = super::expr::sorted(w, frame, *var, list);
                    frame.set(*var, Value::List(list));
                }
                _ => {}
            }
        }
        self.conditions.update(w, frame, self.age);
        self.conditions.update_rhythms(w, frame, &self.rhythms, self.age);
    }

    fn scope(&self) -> Scope<'_, 'p> {
        Scope { frame: &self.frame, watch: Some(&self.conditions), done: false }
    }

    fn test_aborts(&mut self, w: &mut World<'p>) -> Result<(), Aborted> {
        for (why, condition) in &self.activity.aborts {
            if !w.is_recovering && holds(w, self.scope(), condition) {
                return Err(Aborted::because(text(w, self.scope(), why)));
            }
        }
        Ok(())
    }

    /// Rule 10: on every tick on which the condition holds.
    fn react(&mut self, w: &mut World<'p>) {
        for (condition, block) in &self.activity.reactions {
            if holds(w, self.scope(), condition) {
                self.rhythms.fire(condition, self.age);
                at_once(w, &self.frame, block);
            }
        }
    }

    pub fn in_table<T>(&mut self, work: impl FnOnce(&mut Self, &mut Table<'p>) -> T) -> T {
        let Inside::Table(table) = &mut self.inside else { panic!("`{}` has no table", self.activity.name) };
        let mut table = std::mem::take(table);
        let result = work(self, &mut table);
        self.inside = Inside::Table(table);
        result
    }

    /// The body goes on until it gives the tick away; tells whether it came to its end.
    fn go_on(&mut self, w: &mut World<'p>) -> Result<bool, Aborted> {
        let Inside::Sequence(todo) = &mut self.inside else { return Ok(false) };
        let mut todo = std::mem::take(todo);
        let result = self.run(w, &mut todo);
        self.inside = Inside::Sequence(todo);
        result
    }

    fn run(&mut self, w: &mut World<'p>, todo: &mut Vec<Todo<'p>>) -> Result<bool, Aborted> {
        let frame = self.frame.clone();
        loop {
            match advance(w, &frame, todo) {
                Stop::End => return Ok(true),
                Stop::Timed(timed, span) => {
                    let rounds = format!("{}{}", self.rounds, rounds_under_way(&frame, todo));
                    if self.tells(timed, &rounds) {
                        w.say(format!("begin {}{rounds}", w.sources.place(span)));
                    }
                    let mut underway = Underway::new(w, self, timed, rounds);
                    let begun = underway.first(w, &frame, self.is_overlay);
                    todo.push(Todo::Timed(Box::new(underway)));
                    return begun.map(|()| false);
                }
                Stop::Underway(mut underway) => match underway.step(w, &frame, self.age, self.is_overlay) {
                    Ok(Some(end)) => self.end_statement(w, *underway, &end)?,
                    unfinished => {
                        todo.push(Todo::Timed(underway));
                        return unfinished.map(|_| false);
                    }
                },
                Stop::With(items, body) => {
                    todo.push(Todo::EndWith);
                    todo.push(Todo::Stmts(&body.stmts));
                    self.open_with(w);
                    self.put_on(w, items)?;
                }
                Stop::EndWith => self.end_with(w, Cause::Done),
                Stop::Finish(e) => {
                    self.result = e.map(|e| value(w, Scope::of(&frame), e));
                    todo.clear();
                    return Ok(true);
                }
                Stop::Abort(why) => return Err(Aborted::because(text(w, Scope::of(&frame), why))),
            }
        }
    }

    /// Whether a statement is told when it begins: not beside what is active, and not what is told by another event. Of a call that is what
    /// it enters, but for the rounds.
    fn tells(&self, timed: &Timed, rounds: &str) -> bool {
        let is_told = match timed.action {
            Action::Ask(..) | Action::Override(_) => false,
            Action::Call(..) => !rounds.is_empty(),
            Action::Guide(..) | Action::Keep(..) | Action::Watch => true,
        };
        let does_one_thing = self.activity.kind == Kind::Behavior
            && matches!(&self.activity.body, Body::Sequence(block) if times(block) < 2);
        is_told && !self.is_overlay && !does_one_thing
    }

    fn end_statement(&mut self, w: &mut World<'p>, mut underway: Underway<'p>, end: &End) -> Result<(), Aborted> {
        let outcome = underway.outcome(w, end);
        if let (Doing::Ask(action, ..), End::Cut(_)) = (&underway.doing, end) {
            w.say(format!("answer {action} none"));
        }
        underway.doing.leave(w, if let End::Cut(cause) = end { *cause } else { Cause::Done });
        match (underway.timed.result, &underway.doing) {
            (Some(var), _) => self.frame.set(var, outcome),
            (None, Doing::Override(_)) => unread(outcome.number())?,
            (None, _) => {}
        }
        Ok(())
    }

    /// Setpoints and overlays in force, to the end of the innermost `with`.
    fn put_on(&mut self, w: &mut World<'p>, items: &'p [With]) -> Result<(), Aborted> {
        for item in items {
            match item {
                With::Setpoint(channel, e) => {
                    let value = super::expr::number(w, Scope::of(&self.frame), e);
                    self.setpoints.set(*channel, value);
                }
                With::Overlay(id, args, _) => {
                    let activity = &w.hir.activities[*id];
                    let args = super::expr::values(w, Scope::of(&self.frame), args);
                    let frame = Frame::new(w, &activity.vars, args);
                    let overlay = Activation::new(activity, frame, Setpoints::default(), true);
                    let Some(worn) = self.worn.last_mut() else { continue };
                    let place = Place::new(worn.count, worn.overlays.len());
                    worn.overlays.push(Activation { place, ..overlay });
                    if let Some(overlay) = worn.overlays.last_mut() {
                        overlay.begin(w)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn end_with(&mut self, w: &mut World<'p>, cause: Cause) {
        if let Some(worn) = self.worn.pop() {
            self.setpoints = worn.before;
            for mut overlay in worn.overlays {
                overlay.take_off(w, cause);
            }
        }
    }

    /// Overlays from inner to outer; of several in one `with` the later is the outer one.
    fn overlays(&mut self) -> impl Iterator<Item = &mut Activation<'p>> {
        self.worn.iter_mut().rev().flat_map(|worn| &mut worn.overlays)
    }

    pub fn step_overlays(&mut self, w: &mut World<'p>) -> Result<(), Aborted> {
        for overlay in self.overlays() {
            overlay.step(w)?;
        }
        Ok(())
    }

    fn take_off(&mut self, w: &mut World<'p>, cause: Cause) {
        self.fall_silent(w);
        self.leave(w, cause);
    }

    /// It leaves the course alone, and keeps nothing in this tick.
    fn fall_silent(&mut self, w: &mut World<'p>) {
        self.end_amending(w);
        if let (Kind::Sets(axis), true) = (self.activity.kind, self.is_active) {
            match axis {
                Axis::Vertical => w.kept.vertical = None,
                Axis::Speed => w.kept.speed = None,
            }
        }
    }

    fn end_amending(&mut self, w: &mut World<'p>) {
        if let Some(name) = w.amending.remove(&self.place) {
            w.say(format!("amend {name} no more"));
        }
    }

    /// Rules 9 and 13: innermost first, each with its one cause. What is inside did not choose to end.
    pub fn leave(&mut self, w: &mut World<'p>, cause: Cause) {
        if !self.is_active {
            return;
        }
        let inner = inner_cause(cause);
        self.leave_inside(w, inner);
        for overlay in self.overlays() {
            overlay.take_off(w, inner);
        }
        self.worn.clear();
        self.is_active = false;
        if let (Cause::Done, Some(ty)) = (cause, &self.activity.result) {
            let shape = w.shape(ty);
            let words = self.result.clone().unwrap_or_else(|| Value::nothing(&shape)).words(&shape);
            w.say(format!("finish {}", exactly(&w.texts, &self.title(), &shape, &words)));
        }
        w.say(format!("leave {} {cause:?}", self.title()));
    }

    /// Leaves what the body has entered.
    pub fn leave_inside(&mut self, w: &mut World<'p>, cause: Cause) {
        match &mut self.inside {
            Inside::Sequence(todo) => {
                for todo in std::mem::take(todo) {
                    if let Todo::Timed(mut underway) = todo {
                        underway.doing.leave(w, cause);
                    }
                }
            }
            Inside::Table(table) => table.leave(w, cause),
            Inside::Amend => {}
        }
    }

    /// Ends each `with` of the body: what the mission's declarations put in force stays for the recovery (rule 17).
    pub fn end_withs(&mut self, w: &mut World<'p>, cause: Cause) {
        while self.worn.len() > 1 {
            self.end_with(w, cause);
        }
    }

    /// Rule 2: the course after all overlays of the active chain, from inner to outer.
    pub fn amended(&mut self, w: &mut World<'p>, asked: Heading) -> Heading {
        let mut course = self.called().map_or(asked, |called| called.amended(w, asked));
        for overlay in self.overlays() {
            course = overlay.amend(w, course);
        }
        course
    }

    fn amend(&mut self, w: &mut World<'p>, asked: Heading) -> Heading {
        let (Kind::AmendsCourse, Body::Amend { asked: var, block: amend }) = (self.activity.kind, &self.activity.body)
        else {
            return asked;
        };
        self.frame.set(*var, Value::Number(asked.radians()));
        let given = block(w, Scope::of(&self.frame), amend).heading();
        // An amendment smaller than this is not worth a line of trace; it ends below half of it.
        const TOLD_RAD: f64 = 0.02;
        let change = (given - asked).abs();
        if change > TOLD_RAD && !w.amending.contains_key(&self.place) {
            w.amending.insert(self.place, self.activity.name.clone());
            w.say(format!("amend {} {:?} {:?}", self.activity.name, asked.radians(), given.radians()));
        } else if change < TOLD_RAD / 2.0 {
            self.end_amending(w);
        }
        // What was computed of the course that was asked is that course, but for rounding.
        if change > 1e-9 { given } else { asked }
    }

    /// Rule 12: the overlays of what is about to wait amend nothing until that goes on; from inner to outer.
    pub fn pause_overlays(&mut self, w: &mut World<'p>) {
        if let Some(called) = self.called() {
            called.pause_overlays(w);
        }
        for overlay in self.overlays() {
            overlay.fall_silent(w);
        }
    }

    /// What its body has called, or the active behavior of its table.
    fn called(&mut self) -> Option<&mut Activation<'p>> {
        match &mut self.inside {
            Inside::Sequence(todo) => match todo.last_mut() {
                Some(Todo::Timed(underway)) => underway.doing.called(),
                _ => None,
            },
            Inside::Table(table) => table.active(),
            Inside::Amend => None,
        }
    }
}

/// Why what is inside is left when something outside is left.
pub fn inner_cause(cause: Cause) -> Cause {
    if cause == Cause::Aborted { Cause::Aborted } else { Cause::Preempted }
}

/// What a mission does after a time-out or an abort, as an activity of its own.
pub fn recovery(hir: &Hir, mission: ActivityId) -> Activity {
    let activity = &hir.activities[mission];
    let block = activity.mission.as_ref().and_then(|m| m.recovery.as_ref()).map(|(_, block)| block.clone());
    // It is a part of its mission, and no behavior whose name tells what it does.
    let body = Body::Sequence(block.unwrap_or_default());
    Activity { kind: Kind::Mission, body, ..Activity::empty("recovery", activity.span) }
}

/// How many times something in a block can begin that takes time: more than once in a loop.
fn times(block: &Block) -> usize {
    let of = |stmt: &Stmt| {
        let inside: usize = stmt.blocks().into_iter().map(times).sum();
        match stmt.kind {
            StmtKind::Timed(_) => 1 + inside,
            StmtKind::While { .. } | StmtKind::Loop(_) => 2 * inside,
            StmtKind::ForRange { .. } | StmtKind::ForList { .. } => 2 * inside,
            StmtKind::ForEdges { .. } | StmtKind::ForRows { .. } => 2 * inside,
            _ => inside,
        }
    };
    block.stmts.iter().map(of).sum()
}
