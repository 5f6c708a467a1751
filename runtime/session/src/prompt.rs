//! The interactive vehicle: a simulated one that does what is typed, line by line, and whose time goes back as well as on.
//!
//! Between two lines no time goes by: the vehicle has sensed a tick and waits to be told what to do in it. A statement is
//! driven to its end as fast as the machine can; one that never ends by itself is begun, and goes on with `run` and `step`.

mod asked;
mod changed;
mod command;
mod complete;
mod linked;
mod moment;
mod opening;
mod plot;
mod saved;
mod time;
mod timeline;
mod until;
mod vehicle;

pub use complete::WordKind;
pub use opening::{OpenError, Opening, PastTicks};

use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::prompt::{Drive, Left, Line, Named, is_hidden};
use albacore_lang::source::Sources;
use albacore_machine::{Event, Machine, Outcome};
use albacore_program::{Program, number, senses};
use albacore_sim::Scenario;
use albacore_vehicle::{Control, Snapshot, measurements};
use command::{Command, HELP, TICKS_MAX};
use moment::{Moment, Past, Task};
use opening::Loaded;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use timeline::Fork;
use until::Until;

/// A mission that waits for its inputs has them by then: 20 s.
const LOOK_AHEAD_TICKS: u64 = 200;

/// What the prompt has to say.
pub enum Say<'a> {
    /// A line of text.
    Text(&'a str),
    /// Errors and warnings of what was typed or loaded.
    Findings(&'a [Diagnostic], &'a Sources),
    /// An error that is in no source: message and help.
    Error(&'a str, Option<&'a str>),
    /// A file that is wanted: its path and its text.
    File(&'a str, &'a str),
    /// The page of a code of messages is wanted.
    Page(&'a str),
}

/// Who hears it.
pub type Listener<'a> = dyn FnMut(Say) + 'a;

/// What came of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It was done.
    Done,
    /// It was wrong, which has been said.
    Wrong,
    /// The person wants to leave.
    Quit,
}

/// A session at the prompt.
pub struct Prompt {
    /// What it was opened with, and what has been set since.
    opening: Opening,
    /// The script, and the mission that `start` begins.
    loaded: Loaded,
    /// The lines that have declared something, or put something in force.
    entered: Vec<String>,
    /// What the mission that `start` begins calls its parameters and area, before it begins.
    ahead: Vec<Named>,
    now: Moment,
    past: Past,
    /// What the present is called among the forks.
    here: String,
    forks: BTreeMap<String, Fork>,
    /// The person has interrupted what was being done.
    stopped: bool,
    /// The vehicle at the end of the link is not heard any more.
    has_lost_link: bool,
}

impl Prompt {
    /// What is loaded, in one line.
    pub fn greeting(&self) -> String {
        if self.now.vehicle.is_past() {
            let (name, seed) = (&self.loaded.scenario_name, self.opening.seed);
            let mission = self.loaded.mission.as_ref().map_or("", |program| &program.mission.name);
            return format!(
                "a run of {mission} in {name}, seed {seed}, at its beginning: `run`, `run until X`, `why`; `help` tells the rest"
            );
        }
        if let Some(link) = &self.opening.link {
            let mission = self.loaded.mission.as_ref().map_or("", |program| &program.mission.name);
            return format!(
                "mission {mission} (begin it with `start`), vehicle at {link}, which drives itself: a statement takes control, `release` \
                 and `quit` give it back; `help` tells what can be typed"
            );
        }
        let mission = match &self.loaded.mission {
            Some(program) => format!("mission {} (begin it with `start`), ", program.mission.name),
            None => String::new(),
        };
        format!(
            "{mission}world {}, seed {}; `help` tells what can be typed",
            self.loaded.scenario_name, self.opening.seed
        )
    }

    /// Whether a text wants another line before it can be entered. Two blank lines end it: whoever forgot a
    /// bracket is told so.
    pub fn goes_on(text: &str) -> bool {
        !text.ends_with("\n\n\n") && albacore_lang::syntax::goes_on(text)
    }

    /// Does what was typed, one statement after the other, until one is wrong. A raised flag stops the vehicle and what would
    /// have come after, and is lowered again.
    pub fn enter(&mut self, text: &str, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        self.stopped = false;
        for statement in albacore_lang::syntax::statements(text) {
            let answer = match command::of(statement) {
                Some(command) => self.command(command, interrupted, say),
                None => self.line(statement, interrupted, say),
            };
            if answer != Answer::Done || self.stopped {
                return answer;
            }
        }
        Answer::Done
    }

    /// Whether the person has interrupted what was entered last.
    pub fn was_stopped(&self) -> bool {
        self.stopped
    }

    fn command(&mut self, command: Command, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        match command {
            Command::Help => say(Say::Text(HELP)),
            Command::Quit => return Answer::Quit,
            Command::Behavior => say(Say::Text(&self.active())),
            Command::Names => self.tell_names(say),
            Command::Start => return self.start(say),
            Command::Stop => self.stop(say),
            Command::Release => return self.release(say),
            Command::Step(_) | Command::Run(_) if self.has_lost_link => {
                self.is_beyond_reach(say);
                return Answer::Wrong;
            }
            Command::Step(ticks) => self.drive(ticks, Until::Over, interrupted, say),
            Command::RunUntil(condition) => return self.run_until(condition, interrupted, say),
            Command::Why(time) => return self.why(time, say),
            Command::Set(name, value) => return self.set(name, value, interrupted, say),
            Command::Unset(name) => return self.unset(name, interrupted, say),
            Command::Reload => return self.reload(interrupted, say),
            Command::Fork(name) => return self.fork(name, say),
            Command::SwitchTo(name) => return self.switch_to(name, say),
            Command::Forks => self.tell_forks(say),
            Command::Compare(name) => return self.compare(name, say),
            Command::Plot(what, file) => return self.plot(what, file, say),
            Command::SaveTest(name, file) => return self.save_test(name, file, say),
            Command::Explain(code) => say(Say::Page(code)),
            Command::Misused(what, help) => {
                say(Say::Error(what, Some(help)));
                return Answer::Wrong;
            }
            Command::Run(None) if self.now.task.is_none() => {
                let help = "`run 30 s` lets time go by; a statement or `start` gives the vehicle something to do";
                say(Say::Error("nothing is under way", Some(help)));
                return Answer::Wrong;
            }
            Command::Run(None) => self.drive(TICKS_MAX, Until::Over, interrupted, say),
            Command::Run(Some(text)) => match self.ticks(text, say) {
                Some(ticks) => self.drive(ticks, Until::Over, interrupted, say),
                None => return Answer::Wrong,
            },
            Command::Back(text) => match self.ticks(text, say) {
                Some(ticks) => return self.back(ticks, say),
                None => return Answer::Wrong,
            },
        }
        Answer::Done
    }

    fn line(&mut self, text: &str, interrupted: &AtomicBool, say: &mut Listener) -> Answer {
        // The first moment of a vehicle at the end of a link need not tell all that its mission waits for.
        if self.ahead.is_empty() && self.is_on_link() {
            self.look_ahead();
        }
        if let Some(answer) = self.told(text, say) {
            return answer;
        }
        let known = self.known();
        let read = self.loaded.lines.read(&*self.loaded.files, text, &known, self.origin());
        if !read.findings.is_empty() {
            say(Say::Findings(&read.findings, self.loaded.lines.sources()));
        }
        match read.line {
            None => return Answer::Wrong,
            Some(Line::Declared(names)) => {
                self.entered.push(text.to_string());
                say(Say::Text(&format!("declared {}", names.join(", "))));
            }
            Some(Line::With(in_force)) => {
                let values: Result<Vec<_>, _> = in_force.values.iter().map(|drive| self.value(drive, &known)).collect();
                match values {
                    Ok(values) => values.into_iter().for_each(|(_, value)| self.name(value)),
                    Err(what) => return wrong(&what, say),
                }
                self.loaded.lines.put_in_force(in_force);
                self.entered.push(text.to_string());
            }
            Some(Line::Value(drive)) => match self.value(&drive, &known) {
                Ok((program, value)) => {
                    let text = number::brief(&program.texts, &value.shape, &value.words);
                    if value.name.is_empty() {
                        let lost = if self.has_lost_link { "  (told before the link was lost)" } else { "" };
                        say(Say::Text(&format!("{text}{lost}")));
                    } else {
                        say(Say::Text(&format!("{} = {text}", value.name)));
                        self.name(value);
                    }
                }
                Err(what) => return wrong(&what, say),
            },
            Some(Line::Statements(drive)) => return self.begin(text, drive, &known, interrupted, say),
        }
        Answer::Done
    }

    /// Gives a value its name, and keeps that it has got it now; a tick that has been decided follows from earlier ones.
    fn name(&mut self, value: Named) {
        if self.is_on_link() && self.now.is_decided() {
            self.past.note_name(self.now.tick + 1, value.clone());
            return self.now.name(value);
        }
        self.now.name(value);
        self.past.pin(&self.now);
    }

    /// The values that a line can name: what the running mission knows, innermost first, then what was named at the prompt.
    fn known(&self) -> Vec<Named> {
        let (mut known, mut names) = (Vec::new(), BTreeSet::new());
        let mut add = |named: Named| {
            if names.insert(named.name.clone()) {
                known.push(named);
            }
        };
        if let Some(task) = self.now.task.as_ref().filter(|task| task.left.is_none()) {
            self.names_of(&task.machine).into_iter().for_each(&mut add);
        }
        self.now.names().iter().cloned().for_each(&mut add);
        if self.now.task.is_none() {
            self.ahead.iter().cloned().for_each(&mut add);
        }
        known
    }

    /// What a machine calls what it knows, innermost first.
    fn names_of(&self, machine: &Machine) -> Vec<Named> {
        let words = &machine.state().words;
        let frames = machine.frames();
        let of = |(at, &(id, base)): (usize, &(u32, u32))| {
            let outer = at.checked_sub(1).map(|outer| frames[outer].0);
            let frame = words.get(base as usize..).unwrap_or(&[]);
            self.loaded.script.names_of(machine.program(), outer, id, frame)
        };
        frames.iter().enumerate().rev().flat_map(of).collect()
    }

    /// Finds out what the mission calls its parameters and area before it begins: as it would begin now.
    fn look_ahead(&mut self) {
        self.ahead.clear();
        let Some(mut machine) = self.loaded.mission.clone().and_then(|program| self.machine_for(program).ok()) else {
            return;
        };
        let mut moment = self.now.clone();
        for _ in 0..LOOK_AHEAD_TICKS {
            machine.step(&Snapshot { control: Control::InControl, ..moment.snapshot.clone() });
            if let Some(&(id, base)) = machine.frames().first() {
                let frame = machine.state().words.get(base as usize..).unwrap_or(&[]);
                self.ahead = self.loaded.script.names_of(machine.program(), None, id, frame);
                return;
            }
            if moment.step(&mut |_| {}).is_err() {
                return;
            }
        }
    }

    /// Computes an expression on what is sensed now. Nothing is commanded and no time goes by.
    fn value(&self, drive: &Drive, known: &[Named]) -> Result<(Arc<Program>, Named), String> {
        self.value_in(&self.now, drive, known)
    }

    /// The same in another moment.
    fn value_in(&self, moment: &Moment, drive: &Drive, known: &[Named]) -> Result<(Arc<Program>, Named), String> {
        let mut machine = self.machine_in(moment, Arc::new(drive.program.clone()))?;
        put(&mut machine, drive, known);
        if let Some(unheard) = drive.reads.iter().find(|&&input| !machine.has_sample(input)) {
            return Err(self.unsensed(&machine.program().inputs[*unheard as usize].name));
        }
        // It is the prompt that asks, whoever drives.
        machine.step(&Snapshot { control: Control::InControl, ..moment.snapshot.clone() });
        if let Some(why) = aborted(machine.events()) {
            return Err(why);
        }
        let left = drive.value.as_ref().ok_or("this has no value")?;
        Ok((Arc::clone(machine.program()), left.taken(&machine.state().words)))
    }

    /// Why nothing is known of an input.
    fn unsensed(&self, name: &str) -> String {
        let delivered = self.now.vehicle.measurements();
        if senses::ALWAYS_THERE.contains(&name) || delivered.iter().any(|measurement| measurement.name == name) {
            return match self.is_on_link() {
                true => linked::untold(name),
                false => format!("`{name}` has not been sensed yet; let time go by with `run 30 s`"),
            };
        }
        match measurements::ALL.iter().find(|row| row.name == name).and_then(|row| row.instrument) {
            _ if self.is_on_link() => format!("this vehicle does not tell `{name}` over its link"),
            Some(clause) => format!("this vehicle does not tell `{name}`: its scenario has no clause `{clause}`"),
            None => format!("no simulated vehicle tells `{name}`"),
        }
    }

    /// A machine for a line, which knows what was sensed lately and what has a name.
    fn machine(&self, drive: &Drive, known: &[Named]) -> Result<Machine, String> {
        let mut machine = self.machine_for(Arc::new(drive.program.clone()))?;
        put(&mut machine, drive, known);
        Ok(machine)
    }

    fn machine_for(&self, program: Arc<Program>) -> Result<Machine, String> {
        self.machine_in(&self.now, program)
    }

    /// A machine that begins in a moment, and knows what was sensed lately.
    fn machine_in(&self, moment: &Moment, program: Arc<Program>) -> Result<Machine, String> {
        let machine = Machine::new(program, moment.vehicle.measurements()).map_err(|missing| missing.to_string())?;
        let mut machine = machine.with_chart(self.loaded.chart.clone());
        // The mission of a run that is over begins with the run, whoever drives then.
        if !(moment.vehicle.is_past() && moment.tick == 0) {
            machine.begin_at(moment.tick, moment.recent());
        }
        Ok(machine)
    }

    /// Begins statements, and drives them to their end unless they have none.
    fn begin(
        &mut self,
        text: &str,
        drive: Drive,
        known: &[Named],
        interrupted: &AtomicBool,
        say: &mut Listener,
    ) -> Answer {
        if let Some(answer) = self.is_lost(say) {
            return answer;
        }
        let machine = match self.machine(&drive, known) {
            Ok(machine) => machine,
            Err(what) => return wrong(&what, say),
        };
        if let Some(what) = self.cannot_begin(&machine) {
            return wrong(&what, say);
        }
        let left = drive.value.unwrap_or_else(Left::nothing);
        self.now.put(Some(Task::line(machine, left, drive.vars, text)));
        self.past.pin(&self.now);
        if drive.endless {
            self.drive(1, Until::Over, interrupted, say);
            say(Say::Text(match self.is_on_link() {
                true => "goes on while you type: `stop` ends it",
                false => "goes on: `run 30 s` or `step` lets time go by, `stop` ends it",
            }));
        } else {
            self.drive(TICKS_MAX, Until::Over, interrupted, say);
        }
        Answer::Done
    }

    /// Begins the mission of the script.
    fn start(&mut self, say: &mut Listener) -> Answer {
        let Some(program) = self.loaded.mission.clone() else {
            let help = "open the prompt with a script: `albacore repl MISSION.alb`";
            say(Say::Error("no mission is loaded", Some(help)));
            return Answer::Wrong;
        };
        if let Some(answer) = self.is_lost(say) {
            return answer;
        }
        let name = program.mission.name.clone();
        match self.machine_for(program) {
            Ok(machine) => {
                self.now.put(Some(Task::mission(machine, &name)));
                self.past.pin(&self.now);
                say(Say::Text(&match self.is_on_link() {
                    true => {
                        format!("{name} begins, and goes on while you type: `run` waits for its end, `stop` ends it")
                    }
                    false => format!("{name} begins: `run 5 min` or `step` lets time go by"),
                }));
                Answer::Done
            }
            Err(what) => wrong(&what, say),
        }
    }

    /// A vehicle that has taken control back, for a leak, does nothing more that it is told.
    fn is_lost(&self, say: &mut Listener) -> Option<Answer> {
        if self.now.vehicle.is_past() {
            let help = "`run`, `back`, `why`, `plot` and expressions tell of it; `set lambda = 4 s` tells what else the mission would have done";
            say(Say::Error("this run is over: its vehicle does nothing more that it is told", Some(help)));
            return Some(Answer::Wrong);
        }
        if self.is_on_link() {
            return self.is_beyond_reach(say);
        }
        if self.now.snapshot.control == Control::InControl {
            return None;
        }
        let help = "`back 30 s` goes back in time, to where it still heeds you";
        say(Say::Error("the vehicle has taken control back", Some(help)));
        Some(Answer::Wrong)
    }

    fn stop(&mut self, say: &mut Listener) {
        if self.is_on_link() {
            return self.stop_on_link(say);
        }
        self.now.put(None);
        self.past.pin(&self.now);
        say(Say::Text(&format!("{}  stopped", self.now.place())));
    }

    fn active(&self) -> String {
        self.now.task.as_ref().map_or_else(|| "nothing is under way".to_string(), Prompt::active_in)
    }

    /// What is active, from outside in.
    fn active_in(task: &Task) -> String {
        let program = task.machine.program();
        let first = usize::from(task.left.is_some());
        let active = task.machine.active().into_iter().skip(first);
        let names: Vec<&str> = active.map(|id| program.activities[id as usize].name.as_str()).collect();
        let own = task.left.is_some().then(|| task.text.lines().next().unwrap_or_default());
        own.into_iter().chain(names).collect::<Vec<_>>().join(" > ")
    }

    fn tell_names(&self, say: &mut Listener) {
        let known = self.known();
        let known: Vec<_> = known.iter().filter(|named| !is_hidden(&named.name)).collect();
        let texts = self.now.task.as_ref().map_or(&[][..], |task| &task.machine.program().texts);
        for named in &known {
            say(Say::Text(&format!("{} = {}", named.name, number::brief(texts, &named.shape, &named.words))));
        }
        if known.is_empty() {
            say(Say::Text("nothing has a name yet; `let x = 3 m` gives one"));
        }
    }

    fn origin(&self) -> Option<albacore_geometry::Geodetic> {
        self.loaded.mission.as_ref().and_then(|program| program.mission.origin)
    }

    /// The world that the vehicle is in.
    pub fn scenario(&self) -> &Scenario {
        &self.loaded.scenario
    }
}

/// Puts the values in place that a line can name.
fn put(machine: &mut Machine, drive: &Drive, known: &[Named]) {
    for (slot, named) in drive.known.iter().zip(known) {
        machine.put(*slot, &named.words);
    }
}

fn wrong(what: &str, say: &mut Listener) -> Answer {
    say(Say::Error(what, None));
    Answer::Wrong
}

fn aborted(events: &[Event]) -> Option<String> {
    events.iter().find_map(|event| match event {
        Event::Aborted(why) => Some(why.clone()),
        Event::Ended(Outcome::Failed) => Some("this cannot be computed".to_string()),
        _ => None,
    })
}
