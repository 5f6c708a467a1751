//! What the machine says of a tick, in the words of the evaluator: names for numbers, and values to the last bit.

use crate::evaluator::exactly;
use albacore_machine::{Event, Heard};
use albacore_program::{Body, Program, Shape, Text};

/// One line an event.
pub fn lines(program: &Program, events: &[Event]) -> Vec<String> {
    events.iter().map(|event| line(program, event)).collect()
}

fn line(p: &Program, event: &Event) -> String {
    let name = |id: u32| p.activities[id as usize].name.as_str();
    let input = |id: u32| p.inputs[id as usize].name.as_str();
    match event {
        Event::Control(control) => format!("control {control:?}"),
        Event::Entered(id) => format!("enter {}", name(*id)),
        Event::Finished(id, words) => {
            let result = p.activities[*id as usize].result.as_ref();
            let told = result.map(|result| exactly(&p.texts, name(*id), &result.shape, words));
            format!("finish {}", told.unwrap_or_default())
        }
        Event::Left(id, cause) => format!("leave {} {cause:?}", name(*id)),
        Event::Suspended(id) => format!("suspend {}", name(*id)),
        Event::Resumed(id) => format!("resume {}", name(*id)),
        Event::Switched { rule, from, exit, values } => {
            let entries = p.activities.iter().filter_map(|activity| match &activity.body {
                Body::Table(table) => Some(&table.behaviors),
                _ => None,
            });
            let watched = entries
                .flatten()
                .find(|entry| entry.activity == *from)
                .map_or(&[][..], |entry| &entry.exits[*exit as usize].watched);
            let mut said =
                named(&p.texts, watched.iter().map(|watched| (watched.name.as_str(), &watched.shape)), values);
            let words: u32 = watched.iter().map(|watched| watched.shape.words()).sum();
            if let Some(done) = values.get(words as usize) {
                said += &format!("; done {done}");
            }
            format!("switch {} {} [{said}]", name(*from), p.rules[*rule as usize].place)
        }
        Event::Remembered(memory, words) => {
            let memory = &p.memories[*memory as usize];
            format!("memory {}", exactly(&p.texts, &memory.name, &memory.value.shape, words))
        }
        Event::Reported(site, words) => {
            let site = &p.reports[*site as usize];
            let fields = site.fields.iter().map(|(label, field)| (label.as_str(), &field.shape));
            format!("report {}: {}", site.name, named(&p.texts, fields, words))
        }
        Event::Began(statement, words) => {
            let rounds = words.chunks(3).map(|round| format!(" {} of {} at {}", round[0], round[1], round[2]));
            format!("begin {}{}", p.statements[*statement as usize].place, rounds.collect::<String>())
        }
        Event::Logged(text) => format!("log {text}"),
        Event::Amending(id, asked, given) => format!("amend {} {asked:?} {given:?}", name(*id)),
        Event::AmendingEnded(id) => format!("amend {} no more", name(*id)),
        Event::Limited(channel, asked, given) => format!("limit {channel:?} {asked:?} {given:?}"),
        Event::LimitedEnded(channel) => format!("limit {channel:?} no more"),
        Event::Awaited(id) => format!("wait {}", input(*id)),
        Event::Stale(id) => format!("stale {}", input(*id)),
        Event::Fresh(id) => format!("fresh {}", input(*id)),
        Event::Aborted(why) => format!("abort {why}"),
        Event::TimedOut => "timeout".to_string(),
        Event::Lagging(takes, may_take) => format!("lagging {takes} {may_take}"),
        Event::LaggingEnded => "lagging no more".to_string(),
        Event::HostTimeUp(host, vehicle) => format!("timeout by host {host} {vehicle}"),
        Event::Adrift(adrift) => format!("adrift {adrift}"),
        Event::Silenced => "silenced".to_string(),
        Event::Unwritten(lines) => format!("unwritten {lines}"),
        Event::BottomLost(deepest) => format!("bottom lost {:?}", deepest + 0.0),
        Event::Lifted(speed) => format!("lifted {speed:?}"),
        Event::LiftedInVain => "lifted_in_vain".to_string(),
        Event::Risen => "risen".to_string(),
        Event::BottomFound => "bottom found".to_string(),
        Event::Restless(rule) => format!("restless {}", p.rules[*rule as usize].place),
        Event::Settled => "settled".to_string(),
        Event::Asked(action) => format!("ask {}", p.asks[*action as usize]),
        Event::Answered(action, Heard::Value(value)) => format!("answer {} {value}", p.asks[*action as usize]),
        Event::Answered(action, Heard::Refused) => format!("answer {} refused", p.asks[*action as usize]),
        Event::Answered(action, Heard::Nothing) => format!("answer {} none", p.asks[*action as usize]),
        Event::Ended(outcome) => format!("end {}", outcome.name()),
    }
}

fn named<'a>(texts: &[Text], fields: impl Iterator<Item = (&'a str, &'a Shape)>, words: &[f64]) -> String {
    let mut at = 0;
    let said = fields.map(|(name, shape)| {
        let words = &words[at..];
        at += shape.words() as usize;
        exactly(texts, name, shape, words)
    });
    said.collect::<Vec<_>>().join(", ")
}
