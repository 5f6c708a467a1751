//! `save test`: the mission as it was run at the prompt, as a test of a script of its own.

use super::moment::Ended;
use super::{Answer, Listener, Prompt, Say};
use crate::files::Files;
use albacore_lang::diagnostic::has_error;
use albacore_lang::source::Source;
use albacore_machine::{Event, Outcome};
use std::path::Path;

/// How far off a reported place may be, m: a run of the test begins a tick earlier than the prompt does.
const PLACE_M: f64 = 10.0;
/// A mission that was begun by this tick was begun before all else.
const FIRST_TICK: u64 = 1;

impl Prompt {
    pub(super) fn save_test(&mut self, name: &str, file: &str, say: &mut Listener) -> Answer {
        let text = match self.test(name, Path::new(file)) {
            Ok(text) => text,
            Err((what, help)) => {
                say(Say::Error(&what, Some(help)));
                return Answer::Wrong;
            }
        };
        let source = Source { name: file.into(), text: text.as_str().into() };
        let script = albacore_lang::load(source, &Files::around(Path::new(file)), None, &[]);
        if has_error(&script.findings) {
            say(Say::Findings(&script.findings, &script.sources));
            say(Say::Error("what was done here cannot be said as a test", Some("nothing was written")));
            return Answer::Wrong;
        }
        say(Say::File(file, &text));
        Answer::Done
    }

    /// The text of a test that runs the mission as it was run here, and expects what came of it.
    fn test(&self, name: &str, file: &Path) -> Result<String, (String, &'static str)> {
        let wrong = |what: &str, help| (what.to_string(), help);
        if self.opening.past.is_some() {
            let help = "open the prompt with its script, `albacore repl MISSION.alb`, and `start`";
            return Err(wrong("a run that is over is no test", help));
        }
        if self.opening.link.is_some() {
            let help = "a test runs in a simulated world: open the prompt without `--link`, and `start`";
            return Err(wrong("what a vehicle at the end of a link did is no test", help));
        }
        let Some(script) = &self.opening.script else {
            return Err(wrong(
                "there is no mission to be tested",
                "open the prompt with a script: `albacore repl MISSION.alb`",
            ));
        };
        let Some(ended) = self.now.ended.as_ref().filter(|_| self.now.task.is_none()) else {
            return Err(wrong("the mission has not come to an end", "`run` lets it, once `start` has begun it"));
        };
        if ended.began > FIRST_TICK {
            let help = "open the prompt anew, and begin with `start`";
            return Err(wrong("the vehicle did something else before the mission, which a test does not know", help));
        }
        let other = self.opening.set.iter().find(|set| set.split('=').next().is_some_and(|name| name.contains('.')));
        if let Some(other) = other {
            let what = format!("`{other}` changes no parameter of the mission, and a test gives those alone");
            return Err((what, "give the mission a parameter, and hand it on"));
        }
        let mission = self.loaded.mission.as_ref().map_or("", |program| program.mission.name.as_str());
        let root = Files::around(file).root().to_path_buf();
        let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let Ok(inside) = absolute(script).strip_prefix(absolute(&root)).map(|inside| inside.with_extension("")) else {
            let what = format!("`{}` lies in another project than `{}`", file.display(), script.display());
            return Err((what, "save it beside the script, or in another folder of its project"));
        };
        let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).filter(|part| part != ".").collect();
        let module = parts.last().map_or("", |name| name);
        let set = self.opening.set.iter().map(|set| set.replacen('=', ": ", 1)).collect::<Vec<_>>().join(", ");
        let arguments = if set.is_empty() { String::new() } else { format!("({set})") };
        let scenario = &self.loaded.scenario_name;
        // A scenario of the script is known by the script's name, one of the library by its own.
        let is_of_script = self.loaded.script.own_scenarios().any(|own| own == scenario);
        let scenario = if is_of_script { format!("{module}.{scenario}") } else { scenario.clone() };
        let seed = self.opening.seed;
        let mut text = format!("//! As it was run at the prompt.\n\nuse {}\n\n", parts.join("."));
        text +=
            &format!("test \"{name}\" {{\n    run {module}.{mission}{arguments} in {scenario} seeds {seed}..{seed}\n");
        expectations(ended).iter().for_each(|line| text += &format!("    expect {line}\n"));
        Ok(text + "}\n")
    }
}

/// What came of the mission.
fn expectations(ended: &Ended) -> Vec<String> {
    let mut out = vec![match ended.outcome {
        Outcome::Completed => "completed".to_string(),
        outcome => outcome.name().to_string(),
    }];
    for (site, words) in &ended.reported {
        let Some(site) = ended.sites.get(*site as usize) else { continue };
        let name = &site.name;
        let first = site.fields.first().map(|(_, field)| &field.shape);
        let told = format!("has_reported(\"{name}\")");
        if out.iter().any(|line| line.starts_with(&told)) {
            continue;
        }
        let place = first.filter(|shape| matches!(shape, albacore_program::Shape::Point)).and_then(|_| words.get(..2));
        out.push(match place {
            Some(place) => format!(
                "{told} and distance(reported(\"{name}\"), point(north: {:.1} m, east: {:.1} m)) < {PLACE_M} m",
                place[0], place[1]
            ),
            None => told,
        });
    }
    out
}

/// A report of an event: its site and its words.
pub(super) fn reported(event: &Event) -> Option<(u32, Vec<f64>)> {
    match event {
        Event::Reported(site, words) => Some((*site, words.clone())),
        _ => None,
    }
}
