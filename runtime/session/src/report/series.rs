//! Numbers over time, one a second, packed as whole numbers.

use serde::Serialize;

/// More numbers than these are not kept of a series: neighbours become one.
pub(super) const SLOTS_MAX: usize = 20_000;
/// Seconds: no run is longer, and what a journal says beyond is not shown.
pub(super) const SECONDS_END: u64 = 2_000_000;

/// What is kept of several numbers of one second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keep {
    Last,
    Least,
    Greatest,
}

/// A series as a page has it.
#[derive(Clone, Debug, Serialize)]
pub struct Series {
    /// What it is called.
    pub name: String,
    /// Its unit, as it is shown.
    pub unit: &'static str,
    /// Decimals: the whole numbers are so many powers of ten larger.
    pub decimals: u8,
    /// Whole numbers, each the difference from the last one before it that is there.
    pub values: Vec<Option<i64>>,
}

/// A series in the making.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub name: String,
    pub unit: &'static str,
    pub decimals: u8,
    keep: Keep,
    values: Vec<f64>,
}

impl Column {
    pub fn new(name: impl Into<String>, unit: &'static str, decimals: u8) -> Self {
        Column { name: name.into(), unit, decimals, keep: Keep::Last, values: Vec::new() }
    }

    pub fn keeping(self, keep: Keep) -> Self {
        Column { keep, ..self }
    }

    /// Takes in a number at a slot.
    pub fn set(&mut self, slot: usize, x: f64) {
        if !x.is_finite() || slot >= SLOTS_MAX {
            return;
        }
        if self.values.len() <= slot {
            self.values.resize(slot + 1, f64::NAN);
        }
        if let Some(value) = self.values.get_mut(slot) {
            *value = joined(self.keep, *value, x);
        }
    }

    /// Whether there is a number in it.
    pub fn is_there(&self) -> bool {
        !self.values.is_empty()
    }

    /// Half as many numbers.
    pub fn halve(&mut self) {
        let pair = |pair: &[f64]| match *pair {
            [a, b] => joined(self.keep, a, b),
            [a] => a,
            _ => f64::NAN,
        };
        // A number stands for the time up to it: the first for 0 alone.
        let (first, rest) = self.values.split_at(self.values.len().min(1));
        self.values = first.iter().copied().chain(rest.chunks(2).map(pair)).collect();
    }

    /// The series as a page has it.
    pub fn finish(self) -> Series {
        self.since(0)
    }

    /// Whether there is a number at a slot or after it.
    pub fn is_there_since(&self, slot: usize) -> bool {
        self.values.len() > slot
    }

    /// What of it stands at a slot and after it.
    pub fn since(&self, slot: usize) -> Series {
        let scale = [1.0, 10.0, 100.0, 1e3, 1e4].get(usize::from(self.decimals)).copied().unwrap_or(1.0);
        let whole = |x: &f64| (!x.is_nan()).then(|| (x * scale).round() as i64);
        let values = packed(self.values.iter().skip(slot).map(whole));
        Series { name: self.name.clone(), unit: self.unit, decimals: self.decimals, values }
    }
}

/// One number of two, of which each may be missing.
fn joined(keep: Keep, before: f64, after: f64) -> f64 {
    match keep {
        _ if after.is_nan() => before,
        _ if before.is_nan() => after,
        Keep::Last => after,
        Keep::Least => before.min(after),
        Keep::Greatest => before.max(after),
    }
}

/// Each number as the difference from the last one before it that is there.
pub(super) fn packed(values: impl Iterator<Item = Option<i64>>) -> Vec<Option<i64>> {
    let mut before = 0i64;
    values
        .map(|value| {
            value.map(|value| {
                let step = value.saturating_sub(before);
                before = value;
                step
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Column, Keep, packed};

    #[test]
    fn numbers_are_packed_as_differences_and_what_is_missing_stays_missing() {
        assert_eq!(packed([Some(5), None, Some(3), Some(3)].into_iter()), [Some(5), None, Some(-2), Some(0)]);
    }

    #[test]
    fn of_a_second_the_greatest_is_kept_where_that_is_asked_for() {
        let mut column = Column::new("chemical", "", 2).keeping(Keep::Greatest);
        for (second, x) in [(0, 0.5), (2, 0.1), (2, 0.9), (2, 0.2), (3, f64::NAN), (4, 0.3)] {
            column.set(second, x);
        }
        assert_eq!(column.clone().finish().values, [Some(50), None, Some(40), None, Some(-60)]);
        column.halve();
        assert_eq!(column.finish().values, [Some(50), Some(40), Some(-60)]);
    }
}
