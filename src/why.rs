//! `albacore why`: what a run decided, by which rule, and what it was made of.

use crate::exit::Exit;
use crate::message;
use crate::moment::Moment;
use crate::output::{self, Lines};
use crate::past::PastJournal;
use crate::plan::refused;
use albacore_session::journal::Ending;
use albacore_session::{Decision, Explanation, InputAge, TriedCondition, explain};
use std::path::PathBuf;

/// Explain what a run decided: every switch, hold and abort, or what held at a time.
#[derive(clap::Args)]
pub struct Why {
    /// The folder of the run, or its journal.
    run: PathBuf,
    /// The time: `751s` or `12min31s` of the run, or `14:31` of the clock (UTC).
    #[arg(long, value_name = "TIME", value_parser = Moment::parse)]
    at: Option<Moment>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    /// The folder of the project, where files of data are that the script reads; else where it was run.
    #[arg(long, value_name = "FOLDER")]
    project: Option<PathBuf>,
}

impl Why {
    /// Explains it.
    pub fn run(&self) -> Exit {
        self.explain().unwrap_or_else(|exit| exit)
    }

    fn explain(&self) -> Result<Exit, Exit> {
        let past = PastJournal::open(&self.run)?;
        let (_, plan) = past.plan(self.project.as_deref())?;
        past.warn_of_changes(&plan);
        let ticks = match self.at.map(|at| at.ticks(past.first_tick)) {
            Some(None) => {
                let help = "give it as time of the run, such as `751s`";
                message::error("no clock is known of this run: no `run.json` beside the journal tells it", Some(help));
                return Err(Exit::Usage);
            }
            ticks => ticks.flatten(),
        };
        let explanation = explain(past.reader()?, &plan, ticks.clone()).map_err(|error| refused(&error))?;
        // Of a moment in which nothing was decided the clock is told, too.
        if self.at.is_some_and(|at| at.is_of_clock() || explanation.decisions.is_empty()) {
            past.warn_of_clock();
        }
        if let Some(ticks) = &ticks
            && *ticks.start() >= explanation.ticks
        {
            let lasted = explanation.ticks as f64 / 10.0;
            let is_whole = matches!(explanation.ending, Ending::Complete(_));
            let (what, help) = match past.first_tick.filter(|_| self.at.is_some_and(Moment::is_of_clock)) {
                Some(first) => {
                    let [from, to] = [0.0, lasted].map(|at| first.after(at).time_of_day());
                    let told = if is_whole { "the run went" } else { "the journal, which is not whole, goes" };
                    (format!("{told} from {from} to {to} (UTC)"), "choose a time between")
                }
                None if is_whole => {
                    (format!("the run was over by then: it lasted {lasted:.1} s"), "choose an earlier time")
                }
                None => {
                    let what = format!("the journal ends before: it holds {lasted:.1} s, and is not whole");
                    (what, "choose an earlier time")
                }
            };
            message::error(&what, Some(help));
            return Err(Exit::Usage);
        }
        if let Some(tick) = explanation.differs_at {
            let what = format!("from {:.1} s on the journal does not hold what its scripts do", tick as f64 / 10.0);
            message::warning(
                &what,
                "what is told of conditions from there on is not of the run; `albacore replay` tells more",
            );
        }
        match self.json {
            true => output::print_json(&explanation),
            false => self.tell(&past, &explanation),
        }
        match &explanation.ending {
            Ending::Complete(_) => Ok(Exit::Well),
            _ if ticks.is_some() && explanation.after.is_some() => Ok(Exit::Well),
            ending => {
                past.warn_of_end(ending);
                Ok(Exit::Well)
            }
        }
    }

    fn tell(&self, past: &PastJournal, explanation: &Explanation) {
        let mut lines = Lines::default();
        if let (Some(moment), true) = (&explanation.moment, explanation.decisions.is_empty()) {
            let clock = past.first_tick.map(|first| first.after(moment.tick as f64 / 10.0).time_of_day());
            let clock = clock.map_or_else(String::new, |clock| format!("  {clock}"));
            let held = if moment.held { "  (held: something that the mission requires is too old)" } else { "" };
            let under_way = moment.under_way.join(" > ");
            lines.add(&format!("at {:.1} s{clock}: {under_way}{held}", moment.tick as f64 / 10.0));
            lines.add("nothing was decided then");
            let told = [("before", &explanation.before), ("after", &explanation.after)];
            for (when, line) in told.into_iter().filter_map(|(when, line)| Some((when, line.as_ref()?))) {
                lines.add(&format!("  {when:<6}  {line}"));
            }
            lines.add("");
            match moment.conditions.is_empty() {
                true => lines.add("no rule was there to be tried"),
                false => lines.add("tried, in this order:"),
            }
            tell_conditions(&moment.conditions, &mut lines);
            lines.add("");
            tell_inputs(&moment.inputs, &mut lines);
            if let Some(command) = &moment.command {
                lines.add(&format!("commanded  {command}"));
            }
        }
        // Who asks for a time wants to see what did not fire, too.
        let whole = self.at.is_some();
        for (at, decision) in explanation.decisions.iter().enumerate() {
            if at > 0 && whole {
                lines.add("");
            }
            tell_decision(decision, whole, &mut lines);
        }
        lines.print();
    }
}

fn tell_decision(decision: &Decision, whole: bool, lines: &mut Lines) {
    let conditions: Vec<TriedCondition> =
        decision.conditions.iter().filter(|condition| whole || condition.holds).cloned().collect();
    for line in &decision.lines {
        // The values of the trace stand with the condition, which has all their digits.
        let place = conditions.iter().filter(|c| c.holds && !c.place.is_empty()).find_map(|c| {
            let end = line.find(&c.place)? + c.place.len();
            line.get(..end)
        });
        lines.add(place.unwrap_or(line));
    }
    tell_conditions(&conditions, lines);
    if whole || !conditions.is_empty() || decision.inputs.iter().any(InputAge::is_stale) {
        tell_inputs(&decision.inputs, lines);
    }
}

/// Tells conditions that were tried, each with its terms and values.
pub fn tell_conditions(conditions: &[TriedCondition], lines: &mut Lines) {
    conditions.iter().flat_map(TriedCondition::lines).for_each(|line| lines.add(&line));
}

fn tell_inputs(inputs: &[InputAge], lines: &mut Lines) {
    let came = inputs.iter().filter_map(|input| Some((input, input.value.as_ref()?, input.age_s?)));
    for (input, value, age) in came {
        let fresh = match input.fresh_s {
            Some(fresh) if input.is_stale() => format!(": too old, {fresh:.1} s at most"),
            _ => String::new(),
        };
        lines.add(&format!("  input  {} = {value}, {age:.1} s old{fresh}", input.name));
    }
    let missing: Vec<&str> = inputs.iter().filter(|input| input.value.is_none()).map(|input| &*input.name).collect();
    if !missing.is_empty() {
        lines.add(&format!("  never came  {}", missing.join(", ")));
    }
}
