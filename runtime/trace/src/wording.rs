//! What each event has to say: one line, in columns.

use crate::active::Active;
use crate::beginnings::AT_ONCE_TICKS;
use crate::names::Names;
use crate::words::{INDENT, cause_name, control_name, indented};
use albacore_geometry::{Point, TangentFrame};
use albacore_machine::{Event, Heard, LINES_A_TICK_MAX, LINES_AT_ONCE_MAX};
use albacore_program::number;
use albacore_program::seen::one_line;
use albacore_program::{ActivityId, Cause, Program, ROUND_WORDS, ReportSite, Rule, Setpoint, Shape, Statement};
use albacore_vehicle::TICK_S;

/// The widest that the column of what happened gets by itself.
const WHAT_WIDTH_MAX: usize = 48;
/// ... and the widest that statements make it, beside which switches are to be read too.
const STATEMENT_WIDTH_MAX: usize = 32;
/// The column of positions: `at (-1094.0, -1094.0) m`.
const WHERE_WIDTH: usize = 24;

/// Turns events into lines.
#[derive(Clone, Debug)]
pub struct Wording {
    /// What the numbers in events stand for.
    pub names: Names,
    what_width: usize,
    place_width: usize,
}

impl Wording {
    /// The wording for a program, its columns as wide as its longest switch and place.
    pub fn new(program: &Program) -> Self {
        let names = Names::new(program);
        let switches = names.switch_labels().map(|label| label.chars().count());
        let statements = program.statements.iter().filter(|statement| !statement.is_call).map(width);
        let longest = switches.chain(statements).max().unwrap_or(0);
        // Most tables are in a strategy that is called by a mission: two levels down.
        let what_width = (longest + 2 * INDENT).min(WHAT_WIDTH_MAX);
        let place_width = program.rules.iter().map(|rule| rule.place.chars().count()).max().unwrap_or(0);
        Wording { names, what_width, place_width }
    }

    /// What an event has to say, and under which verb. Verbs have at most seven letters: two blanks end every column.
    ///
    /// `all` are the events of the same tick, of which it is that `at` this place; `active` is what was active before it.
    pub fn line(
        &self,
        at: usize,
        all: &[Event],
        active: &Active,
        position: Option<Point>,
    ) -> Option<(&'static str, String)> {
        let (event, inner) = (all.get(at)?, active.chain().len());
        Some(match event {
            Event::Control(control) => ("control", control_name(*control).to_string()),
            Event::Entered(id) => {
                ("enter", self.entered(*id, inner, at.checked_sub(1).and_then(|before| all.get(before))))
            }
            Event::Began(statement, words) => ("begin", self.begun(*statement, words, inner, position)?),
            Event::Left(id, cause) => {
                let what = indented(active.depth(*id), &self.names.titled(*id));
                ("leave", self.columns(&what, None, "", cause_name(*cause)))
            }
            Event::Suspended(id) => ("suspend", indented(active.depth(*id), self.names.name(*id))),
            Event::Resumed(id) => {
                let what = indented(active.depth(*id), &self.resumed(*id, all));
                ("resume", self.columns(&what, Some(position), "", ""))
            }
            Event::Switched { rule, from, exit, values } => {
                let what = indented(active.depth(*from), &self.names.switch_label(*from, *rule));
                let rule = self.names.program.rules.get(*rule as usize);
                let done = all.contains(&Event::Left(*from, Cause::Done));
                let why = self.guard(rule, *from, *exit, done, values);
                ("switch", self.columns(&what, Some(position), rule.map_or("?", |rule| &rule.place), &why))
            }
            Event::Remembered(memory, words) => {
                let memory = self.names.program.memories.get(*memory as usize)?;
                let value = self.value(&memory.value.shape, words);
                ("memory", indented(inner, &format!("{} = {value}", memory.name)))
            }
            Event::Reported(site, words) => {
                let site = self.names.program.reports.get(*site as usize)?;
                let labels = site.fields.iter().map(|(label, field)| {
                    (if label.is_empty() { site.name.as_str() } else { label.as_str() }, &field.shape)
                });
                ("report", format!("{}{}", self.values(labels, words), self.on_globe(site, words)))
            }
            Event::Logged(text) => ("log", one_line(text)),
            Event::Amending(id, asked, given) => {
                let (asked, given) = (number::compass(*asked), number::heading(*given));
                ("amend", format!("{}  course {asked} -> {given}", self.names.name(*id)))
            }
            Event::AmendingEnded(id) => ("amend", format!("{}  no more", self.names.name(*id))),
            Event::Awaited(input) => ("wait", format!("for the first {}", self.names.input(*input))),
            Event::Stale(input) => ("stale", self.names.input(*input).to_string()),
            Event::Fresh(input) => ("fresh", self.names.input(*input).to_string()),
            Event::Aborted(why) => ("abort", self.columns(&one_line(why), Some(position), "", "")),
            Event::TimedOut => ("timeout", self.columns("the mission's time is up", Some(position), "", "")),
            Event::Silenced => {
                let (once, second) = (LINES_AT_ONCE_MAX, LINES_A_TICK_MAX as f64 / TICK_S);
                ("limit", format!("log and report  more than {once} lines at once and {second:.0} a second"))
            }
            Event::Unwritten(lines) => ("limit", format!("log and report  {lines} more not written")),
            Event::Restless(rule) => {
                let place = self.names.program.rules.get(*rule as usize).map_or("?", |rule| rule.place.as_str());
                ("rules", format!("switch without rest, the last at {place}: what they leave gets no time"))
            }
            Event::Settled => ("rules", "no longer switch without rest".to_string()),
            Event::Ended(outcome) => ("end", outcome.name().to_string()),
            Event::Asked(action) => ("ask", indented(inner, self.names.ask(*action))),
            Event::Answered(action, heard) => {
                let heard = match heard {
                    Heard::Value(value) => value.to_string(),
                    Heard::Refused => "refused".to_string(),
                    Heard::Nothing => "no answer".to_string(),
                };
                ("answer", indented(inner, &format!("{}  {heard}", self.names.ask(*action))))
            }
            of_vehicle => return Self::of_vehicle(of_vehicle),
        })
    }

    /// What is held back, and what became of the vehicle and its link.
    fn of_vehicle(event: &Event) -> Option<(&'static str, String)> {
        Some(match event {
            Event::Limited(channel, asked, given) => {
                let Setpoint { name, print, .. } = channel.row();
                ("limit", format!("{name}  {} -> {}", print(*asked), print(*given)))
            }
            Event::LimitedEnded(channel) => ("limit", format!("{}  no more", channel.row().name)),
            Event::Adrift(true) => ("hold", "adrift: carried off although it goes back to its place".to_string()),
            Event::Adrift(false) => ("hold", "adrift no more".to_string()),
            Event::BottomLost(deepest) => {
                ("limit", format!("altitude unknown: no deeper than {}", number::metres(*deepest)))
            }
            Event::Lifted(speed) => {
                ("limit", format!("too deep and does not rise: makes way, {}", number::metres_per_second(*speed)))
            }
            Event::Risen => ("limit", "no longer too deep".to_string()),
            Event::LiftedInVain => ("limit", "does not rise by way: makes no more".to_string()),
            Event::BottomFound => ("limit", "altitude known again".to_string()),
            Event::Lagging(takes, may_take) => ("link", format!("round trip {takes:.1} s, more than {may_take:.1} s")),
            Event::LaggingEnded => ("link", "round trip within its limit again".to_string()),
            Event::HostTimeUp(host, vehicle) => {
                let what = format!("by the host's clock: {host:.0} s of it, {vehicle:.0} s of the vehicle's");
                ("timeout", what)
            }
            // The others are worded in `line`. Named one by one: an event that is added has to be worded somewhere.
            Event::Control(_)
            | Event::Entered(_)
            | Event::Began(..)
            | Event::Finished(..)
            | Event::Left(..)
            | Event::Suspended(_)
            | Event::Resumed(_)
            | Event::Switched { .. }
            | Event::Remembered(..)
            | Event::Reported(..)
            | Event::Logged(_)
            | Event::Amending(..)
            | Event::AmendingEnded(_)
            | Event::Stale(_)
            | Event::Fresh(_)
            | Event::Aborted(_)
            | Event::TimedOut
            | Event::Ended(_)
            | Event::Awaited(_)
            | Event::Silenced
            | Event::Unwritten(_)
            | Event::Restless(_)
            | Event::Asked(_)
            | Event::Answered(..)
            | Event::Settled => return None,
        })
    }

    /// What is entered; by a call in a loop, which rounds that tells just before.
    fn entered(&self, id: ActivityId, depth: usize, before: Option<&Event>) -> String {
        let rounds = match before {
            Some(Event::Began(statement, words)) => self.statement(*statement, true).map(|call| call.told(words)),
            _ => None,
        };
        let what = indented(depth, &self.names.titled(id));
        self.columns(&what, None, "", &one_line(&rounds.unwrap_or_default()))
    }

    /// A statement that begins. That of a call is told by what it enters.
    fn begun(&self, statement: u32, words: &[f64], depth: usize, position: Option<Point>) -> Option<String> {
        let statement = self.statement(statement, false)?;
        let what = indented(depth, &one_line(&statement.told(words)));
        Some(self.columns(&what, Some(position), &statement.place, ""))
    }

    fn statement(&self, at: u32, is_call: bool) -> Option<&Statement> {
        self.names.program.statements.get(at as usize).filter(|statement| statement.is_call == is_call)
    }

    /// A statement that has begun again and again, so often without a line of its own.
    pub fn begun_again(&self, statement: u32, count: u64, depth: usize) -> String {
        let Some(statement) = self.statement(statement, false) else { return String::new() };
        let what = indented(depth, &one_line(&statement.told(&[])));
        format!("{what}  {count} more, less than {:.0} s apart", AT_ONCE_TICKS as f64 * TICK_S)
    }

    /// What goes on, and after what of the same table, if that was left in this tick.
    fn resumed(&self, id: ActivityId, all: &[Event]) -> String {
        let after = all.iter().find_map(|event| match event {
            Event::Left(left, _) if self.names.share_table(*left, id) => Some(self.names.name(*left)),
            _ => None,
        });
        let name = self.names.name(id);
        after.map_or_else(|| name.to_string(), |after| format!("{after} -> {name}"))
    }

    /// What, where, by which rule, and why.
    fn columns(&self, what: &str, position: Option<Option<Point>>, place: &str, why: &str) -> String {
        let mut line = format!("{what:<width$}", width = self.what_width);
        if let Some(position) = position {
            let at = format!("at {}", position.map_or_else(|| "?".to_string(), number::point));
            line += &format!("  {at:<WHERE_WIDTH$}");
        }
        if !place.is_empty() {
            line += &format!("  {place:<width$}", width = self.place_width);
        }
        if !why.is_empty() {
            line += &format!("  {why}");
        }
        line
    }

    /// The values that a rule's guard looked at; the guard as written when there are none. `done` tells whether the behavior
    /// had come to its end.
    fn guard(&self, rule: Option<&Rule>, from: ActivityId, exit: u32, done: bool, values: &[f64]) -> String {
        let exit = self.names.entry(from).and_then(|entry| entry.exits.get(exit as usize));
        let watched = exit.map_or(&[][..], |exit| &exit.watched);
        if watched.is_empty() {
            let guard = rule.and_then(|rule| rule.text.split_once(" on "));
            return guard.map(|(_, guard)| format!("on {}", one_line(guard))).unwrap_or_default();
        }
        let asks_done = exit.is_some_and(|exit| exit.guard_done.is_some());
        // Who waits to go on is not left, and the event says it.
        let words: usize = watched.iter().map(|watched| watched.shape.words() as usize).sum();
        let done = values.get(words).map_or(done, |said: &f64| *said != 0.0);
        let done = if asks_done { format!("done = {done}, ") } else { String::new() };
        done + &self.values(watched.iter().map(|watched| (watched.name.as_str(), &watched.shape)), values)
    }

    /// Named values with as many digits as they take: one that just reaches another is to be seen.
    pub(crate) fn values_in_full<'a>(
        &self,
        named: impl Iterator<Item = (&'a str, &'a Shape)>,
        words: &[f64],
    ) -> String {
        let mut at = 0;
        let values = named.map(|(name, shape)| {
            let value = number::brief(&self.names.program.texts, shape, words.get(at..).unwrap_or(&[]));
            at += shape.words() as usize;
            format!("{name} = {}", one_line(&value))
        });
        values.collect::<Vec<_>>().join(", ")
    }

    /// Named values, one after the other.
    pub(crate) fn values<'a>(&self, named: impl Iterator<Item = (&'a str, &'a Shape)>, words: &[f64]) -> String {
        let mut at = 0;
        let values = named.map(|(name, shape)| {
            let value = self.value(shape, words.get(at..).unwrap_or(&[]));
            at += shape.words() as usize;
            format!("{name} = {value}")
        });
        values.collect::<Vec<_>>().join(", ")
    }

    /// Where on the globe the place of a report is, if it has one and the mission's frame lies there.
    fn on_globe(&self, site: &ReportSite, words: &[f64]) -> String {
        let place = || {
            let at = site.fields.first()?.1.shape.first_point()?;
            let point = Point::new(*words.get(at)?, *words.get(at + 1)?);
            let origin = self.names.program.mission.origin?;
            Some(format!(", {}", TangentFrame { origin }.to_geodetic(point)))
        };
        place().unwrap_or_default()
    }

    fn value(&self, shape: &Shape, words: &[f64]) -> String {
        one_line(&number::value_with(&self.names.program.texts, shape, words))
    }
}

/// The column that a statement takes where its loops have no more rounds than most have.
fn width(statement: &Statement) -> usize {
    let told = statement.told(&vec![99.0; statement.loops.len() * ROUND_WORDS]);
    told.chars().count().min(STATEMENT_WIDTH_MAX)
}
