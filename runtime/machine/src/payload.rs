//! What is asked of payloads. A question has a number; its answer waits until the statement that asked looks for it, so that one that stands
//! still meanwhile has it when it goes on.

use crate::execute::truth;
use crate::state::Run;
use crate::{Event, Heard};
use albacore_program::{OverrideEnd, Slot};
use albacore_vehicle::Answer;
use serde::{Deserialize, Serialize};

/// Bits of a question's number that tell it from others of its tick.
const OF_TICK: u32 = 16;

/// A question that has been asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Question {
    /// Where the statement keeps its number: each has one question at a time.
    at: Slot,
    id: u64,
    /// Index into the program's `asks`.
    action: u32,
    /// What has come, once it has.
    answer: Option<Answer>,
}

/// A question as it is put to the vehicle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    pub id: u64,
    pub action: u32,
}

impl Run {
    /// Asks, and keeps the question's number at a place.
    pub fn ask_payload(&mut self, action: u32, at: Slot) {
        // No number of a run, nor of one that begins later on the same vehicle, is given twice.
        let id = (self.state.tick << OF_TICK) + self.requests.len() as u64;
        self.set(at, id as f64);
        self.state.questions.retain(|question| question.at != at);
        self.state.questions.push(Question { at, id, action, answer: None });
        self.requests.push(Request { id, action });
        self.events.push(Event::Asked(action));
    }

    /// Takes in what has been answered.
    pub fn hear_answers(&mut self, answers: &[Answer]) {
        for answer in answers {
            let is_asked = |question: &&mut Question| question.id == answer.id && question.answer.is_none();
            if let Some(question) = self.state.questions.iter_mut().find(is_asked) {
                question.answer = Some(*answer);
            }
        }
    }

    /// Writes whether the answer has come to the question whose number is at a place, and if so the answer; the question is none any more then.
    pub fn hear(&mut self, at: Slot, answer: Slot, ended: Slot) {
        let has_come = |question: &Question| question.at == at && question.answer.is_some();
        let index = self.state.questions.iter().position(has_come);
        self.set(ended, truth(index.is_some()));
        let Some(Question { action, answer: Some(Answer { value, .. }), .. }) =
            index.map(|index| self.state.questions.remove(index))
        else {
            return;
        };
        let end = if value.is_some() { OverrideEnd::Completed } else { OverrideEnd::Refused };
        self.set(answer, end.number());
        self.set(answer + 1, truth(value == Some(true)));
        self.events.push(Event::Answered(action, value.map_or(Heard::Refused, Heard::Value)));
    }

    /// The answer to the question whose number is at a place is awaited no longer.
    pub fn unanswered(&mut self, at: Slot) {
        if let Some(index) = self.state.questions.iter().position(|question| question.at == at) {
            let Question { action, .. } = self.state.questions.remove(index);
            self.events.push(Event::Answered(action, Heard::Nothing));
        }
    }
}
