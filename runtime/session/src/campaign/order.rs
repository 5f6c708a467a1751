//! The order of a table's rows: all cases of the first seed, then all of the next, so that more seeds are more rows at its end.

/// Which run stands in which row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowOrder {
    /// The seed of the first row.
    pub first_seed: u64,
    /// How many cases are run with each seed, one at least.
    pub cases: u64,
}

impl RowOrder {
    /// The seed and the case, from 0, of a row by its number from 0.
    pub fn run(self, number: u64) -> (u64, usize) {
        (self.first_seed + number / self.cases, (number % self.cases) as usize)
    }

    /// The row of a run, if it has one.
    pub fn number(self, seed: u64, case: usize) -> Option<u64> {
        let seeds_before = seed.checked_sub(self.first_seed)?;
        let is_case = (case as u64) < self.cases;
        seeds_before.checked_mul(self.cases)?.checked_add(case as u64).filter(|_| is_case)
    }
}

#[cfg(test)]
mod tests {
    use super::RowOrder;

    #[test]
    fn each_run_has_one_row() {
        let order = RowOrder { first_seed: 7, cases: 3 };
        assert_eq!([0, 1, 2, 3, 7].map(|number| order.run(number)), [(7, 0), (7, 1), (7, 2), (8, 0), (9, 1)]);
        assert!((0..30).all(|number| {
            let (seed, case) = order.run(number);
            order.number(seed, case) == Some(number)
        }));
        assert_eq!((order.number(6, 0), order.number(7, 3), order.number(u64::MAX, 0)), (None, None, None));
    }
}
