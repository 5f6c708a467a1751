//! What the vehicle's payload answers to what it is asked.

use crate::noise::Noise;
use crate::scenario::{Scenario, ScenarioIssues};
use albacore_vehicle::{Answer, TICK_S};
use serde::Deserialize;

/// How it answers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Payload {
    /// What it is asked: an action, such as `camera.start`, or all of a payload, `camera`.
    pub action: String,
    /// How long an answer takes, s.
    pub after: f64,
    /// Its value.
    pub answers: bool,
    /// So many questions are refused.
    pub refuses: f64,
    /// So many are never answered.
    pub silent: f64,
    /// When this begins, s.
    pub from: f64,
    /// When it is over, s; none: never.
    pub to: Option<f64>,
}

impl Payload {
    /// Whether it answers to an action.
    pub fn is_of(&self, action: &str) -> bool {
        self.action == action || action.split_once('.').is_some_and(|(payload, _)| payload == self.action)
    }

    fn holds_at(&self, time: f64) -> bool {
        self.from <= time && self.to.is_none_or(|to| time < to)
    }
}

/// What cannot be.
pub(crate) fn check(scenario: &Scenario, objections: &mut ScenarioIssues) {
    for (nth, payload) in scenario.payloads.iter().enumerate() {
        let mut of = objections.nth("payload", nth);
        of.unless(
            Some("action"),
            !payload.action.is_empty(),
            "this names nothing that could be asked",
            "write what is asked: `payload(\"camera.start\")`, or `payload(\"camera\")` for all that it does",
        );
        of.unless(
            Some("silent"),
            payload.refuses + payload.silent <= 1.0,
            "more questions are refused or not answered than are asked",
            "let `refuses` and `silent` come to 100 % together at most",
        );
    }
}

/// The payload aboard.
#[derive(Clone, Debug)]
pub(crate) struct PayloadBay {
    payloads: Vec<Payload>,
    chance: Noise,
    /// How many questions there were.
    asked: u64,
    /// Answers on their way, with the ticks of their coming.
    coming: Vec<(u64, Answer)>,
}

impl PayloadBay {
    pub fn new(payloads: &[Payload], seed: u64) -> Self {
        PayloadBay { payloads: payloads.to_vec(), chance: Noise::named(seed, "payload"), asked: 0, coming: Vec::new() }
    }

    /// A question at a tick. Of several clauses that hold the last does; where none does there is no answer.
    pub fn ask(&mut self, tick: u64, id: u64, action: &str) {
        let chance = self.chance.uniform(self.asked);
        self.asked += 1;
        let time = tick as f64 * TICK_S;
        let answers = |payload: &&Payload| payload.is_of(action) && payload.holds_at(time);
        let Some(payload) = self.payloads.iter().rev().find(answers) else { return };
        if chance >= payload.refuses && chance < payload.refuses + payload.silent {
            return;
        }
        let value = (chance >= payload.refuses).then_some(payload.answers);
        let ticks = (payload.after / TICK_S).ceil().max(1.0) as u64;
        self.coming.push((tick + ticks, Answer { id, value }));
    }

    /// Adds the answers that have come by a tick.
    pub fn answer(&mut self, tick: u64, answers: &mut Vec<Answer>) {
        answers.extend(self.coming.extract_if(.., |(due, _)| *due <= tick).map(|(_, answer)| answer));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn payload(action: &str) -> Payload {
        Payload { action: action.into(), after: 0.0, answers: true, refuses: 0.0, silent: 0.0, from: 0.0, to: None }
    }

    /// What comes of questions, one a tick: their ticks, and the values.
    fn answers(payloads: &[Payload], action: &str, questions: u64) -> Vec<(u64, u64, Option<bool>)> {
        let mut bay = PayloadBay::new(payloads, 1);
        let mut heard = Vec::new();
        for tick in 0..questions + 100 {
            let mut now = Vec::new();
            bay.answer(tick, &mut now);
            heard.extend(now.iter().map(|answer| (answer.id, tick, answer.value)));
            if tick < questions {
                bay.ask(tick, tick, action);
            }
        }
        heard
    }

    #[test]
    fn an_answer_takes_a_tick_at_least() {
        assert_eq!(answers(&[payload("camera.start")], "camera.start", 1), [(0, 1, Some(true))]);
        let late = Payload { after: 1.05, answers: false, ..payload("camera") };
        assert_eq!(answers(&[late], "camera.start", 1), [(0, 11, Some(false))]);
    }

    #[test]
    fn the_last_clause_that_holds_answers() {
        let [all, stop] =
            [payload("camera"), Payload { refuses: 1.0, from: 0.2, to: Some(0.4), ..payload("camera.stop") }];
        let heard = answers(&[all.clone(), stop], "camera.stop", 5);
        let values: Vec<_> = heard.iter().map(|(_, _, value)| *value).collect();
        assert_eq!(values, [Some(true), Some(true), None, None, Some(true)]);
        assert!(answers(&[all], "sonar.start", 5).is_empty(), "what is not there answers nothing");
        assert!(answers(&[payload("camera.start")], "camera.stop", 5).is_empty());
    }

    #[test]
    fn as_many_are_refused_and_unanswered_as_is_said() {
        let heard = answers(&[Payload { refuses: 0.25, silent: 0.5, ..payload("camera") }], "camera.start", 10_000);
        let refused = heard.iter().filter(|(_, _, value)| value.is_none()).count();
        assert!(heard.len().abs_diff(5000) < 200 && refused.abs_diff(2500) < 200, "{} {refused}", heard.len());
    }
}
