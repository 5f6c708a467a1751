//! Statements tell when they begin, and how far the loops around them are.

use crate::Event;
use crate::compute::place;
use crate::state::Run;
use albacore_program::{Program, ROUND_WORDS, Rounds, Slot};

impl Run {
    /// What overlays do is told by what they change.
    pub fn tell_beginning(&mut self, p: &Program, statement: u32, base: Slot) {
        if self.in_overlay {
            return;
        }
        let loops = &p.statements[statement as usize].loops;
        let words = loops.iter().flat_map(|around| self.round(around.rounds, base)).collect();
        self.events.push(Event::Began(statement, words));
    }

    fn round(&self, rounds: Rounds, base: Slot) -> [f64; ROUND_WORDS] {
        let get = |slot: Slot| self.get(place(slot, base));
        match rounds {
            Rounds::Begun(begun) => [get(begun), 0.0, 0.0],
            Rounds::Behind(behind, count) => [get(behind) + 1.0, get(count), 0.0],
            Rounds::Range { at, first, end, inclusive } => {
                let rounds = get(end) - get(first) + f64::from(u8::from(inclusive));
                [get(at) - get(first) + 1.0, rounds, get(at)]
            }
        }
    }
}
