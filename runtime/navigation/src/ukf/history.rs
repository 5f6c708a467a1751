//! Measurements that come late: filters of a short while, from which what came after is run once more.

use std::collections::VecDeque;

/// A filter `F` that is given events `E`, such as samples of its instruments, each at its time, also those that come late.
///
/// Of each event it keeps the filter as it was before. One that is late begins there, and all later ones follow again: the filter is then,
/// to the bit, what it would be had everything come in time. A late event costs as many steps as have been taken since its time.
/// Room is made once, when the history begins: for each event once the size of the filter, 4 kB for 15 states.
#[derive(Clone, Debug)]
pub struct History<F, E> {
    now: F,
    steps: VecDeque<Step<F, E>>,
    length: usize,
}

/// An event, and the filter before it.
#[derive(Clone, Debug)]
struct Step<F, E> {
    /// s.
    time: f64,
    before: F,
    event: E,
}

impl<F: Clone, E> History<F, E> {
    /// Keeps so many events; one at least.
    pub fn new(filter: F, length: usize) -> Self {
        let length = length.max(1);
        History { now: filter, steps: VecDeque::with_capacity(length), length }
    }

    /// The filter after all events.
    pub fn filter(&self) -> &F {
        &self.now
    }

    /// Takes an event of a time, s: after those of the same time. `run` is what an event does to a filter, to this one and then to
    /// those after it; the result is what it gave for this one. None: the event is older than all that is kept, or its time is no
    /// number, and nothing has changed.
    pub fn apply<R>(&mut self, time: f64, event: E, mut run: impl FnMut(&mut F, &E) -> R) -> Option<R> {
        let mut place = self.steps.partition_point(|step| step.time <= time);
        if !time.is_finite() || (place == 0 && !self.steps.is_empty()) {
            return None;
        }
        // Of what is forgotten nothing is later than the event.
        if self.steps.len() == self.length {
            self.steps.pop_front();
            place -= 1;
        }
        if let Some(step) = self.steps.get(place) {
            self.now.clone_from(&step.before);
        }
        let before = self.now.clone();
        let result = run(&mut self.now, &event);
        self.steps.insert(place, Step { time, before, event });
        for step in self.steps.range_mut(place + 1..) {
            step.before.clone_from(&self.now);
            run(&mut self.now, &step.event);
        }
        Some(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A "filter" that remembers what it was given, in which order.
    fn told(events: &[(f64, u32)], length: usize) -> (Vec<u32>, Vec<Option<u32>>) {
        let mut history = History::new(Vec::new(), length);
        let take = |(time, event): &(f64, u32)| {
            history.apply(*time, *event, |list: &mut Vec<u32>, event| {
                list.push(*event);
                *event
            })
        };
        let results = events.iter().map(take).collect();
        (history.filter().clone(), results)
    }

    #[test]
    fn a_late_event_is_put_in_its_place() {
        let (all, results) = told(&[(0.0, 1), (1.0, 2), (2.0, 4), (3.0, 5), (1.0, 3)], 10);
        assert_eq!(all, [1, 2, 3, 4, 5]);
        assert_eq!(results.last(), Some(&Some(3)));
    }

    #[test]
    fn what_is_older_than_all_that_is_kept_is_refused() {
        let (all, results) = told(&[(0.0, 1), (1.0, 2), (2.0, 3), (0.5, 9), (1.0, 4), (f64::NAN, 9), (0.9, 9)], 2);
        assert_eq!(all, [1, 2, 4, 3]);
        assert_eq!(results, [Some(1), Some(2), Some(3), None, Some(4), None, None]);
    }
}
