//! The seeds of a campaign as they are written: `7`, `1..100` with both ends, `1..<100` without the last.

use albacore_session::campaign::RowOrder;
use std::fmt;
use std::str::FromStr;

/// A campaign has this many runs at most: what is made of its rows is held in memory.
pub const RUNS_MAX: u64 = 1_000_000;

/// Seeds without a gap, at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seeds {
    /// The first.
    pub first: u64,
    /// The last, which is one of them.
    pub last: u64,
}

impl Seeds {
    /// How many there are.
    pub fn count(self) -> u64 {
        self.last - self.first + 1
    }

    /// What they are called: `seed 7`, `seeds 1..100`.
    pub fn named(self) -> String {
        format!("{} {self}", if self.count() == 1 { "seed" } else { "seeds" })
    }
}

impl FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (first, last) = match text.split_once("..") {
            None => (seed(text)?, seed(text)?),
            Some((first, last)) => match last.strip_prefix('<') {
                None => (seed(first)?, seed(last)?),
                // What leaves out 0 ends before every seed.
                Some(end) => match seed(end)?.checked_sub(1) {
                    Some(last) => (seed(first)?, last),
                    None => return Err("it has no seeds: it ends before 0".to_string()),
                },
            },
        };
        if last < first {
            return Err("it has no seeds: the smaller comes first, as in `1..100`".to_string());
        }
        if last - first >= RUNS_MAX {
            return Err(format!("a campaign has {RUNS_MAX} runs at most"));
        }
        Ok(Seeds { first, last })
    }
}

/// The rows of a table: for each seed one of each case.
#[derive(Clone, Copy, Debug)]
pub struct Rows {
    /// The seeds.
    pub seeds: Seeds,
    /// How many cases are run with each, one at least.
    pub cases: u64,
}

impl Rows {
    /// How many there are.
    pub fn count(self) -> u64 {
        self.seeds.count() * self.cases
    }

    /// Which run stands in which.
    pub fn order(self) -> RowOrder {
        RowOrder { first_seed: self.seeds.first, cases: self.cases }
    }
}

/// A part of the seeds: the `i`th of so many that are as long as one another, or longer by one seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    i: u64,
    of: u64,
}

impl Shard {
    /// Its seeds; none where there are more shards than seeds.
    pub fn of(self, seeds: Seeds) -> Option<Seeds> {
        let begins = |shard: u64| (u128::from(seeds.count()) * u128::from(shard) / u128::from(self.of)) as u64;
        let (begin, end) = (begins(self.i - 1), begins(self.i));
        (begin < end).then(|| Seeds { first: seeds.first + begin, last: seeds.first + end - 1 })
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a shard is one of so many, such as `3/8`";
        let (i, of) = text.split_once('/').ok_or(form)?;
        let (i, of) = (number(i, form)?, number(of, form)?);
        match (1..=of).contains(&i) && of <= RUNS_MAX {
            true => Ok(Shard { i, of }),
            false => Err(format!("{form}: from `1/{of}` to `{of}/{of}`, and {RUNS_MAX} at most")),
        }
    }
}

fn seed(text: &str) -> Result<u64, String> {
    number(text, "seeds are whole numbers from 0 on: `7`, `1..100`, or `1..<100` without the last")
}

/// The seed of one run, as `--seed` has it.
pub fn one(text: &str) -> Result<u64, String> {
    number(text, "a seed is a whole number from 0 on, such as `7`")
}

fn number(text: &str, form: &str) -> Result<u64, String> {
    let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    match text.parse() {
        Ok(seed) if digits => Ok(seed),
        _ if digits => Err(format!("a seed is {} at most", u64::MAX)),
        _ => Err(form.to_string()),
    }
}

impl fmt::Display for Seeds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.first == self.last { write!(f, "{}", self.first) } else { write!(f, "{}..{}", self.first, self.last) }
    }
}

#[cfg(test)]
mod tests {
    use super::{Seeds, Shard};

    #[test]
    fn shards_are_all_of_the_seeds_each_once() {
        let all: Seeds = "5..104".parse().unwrap();
        for of in [1, 2, 3, 7, 99, 100] {
            let shards = (1..=of).map(|i| format!("{i}/{of}").parse::<Shard>().unwrap().of(all).unwrap());
            let seeds: Vec<u64> = shards.flat_map(|shard| shard.first..=shard.last).collect();
            assert_eq!(seeds, (5..=104).collect::<Vec<_>>(), "{of}");
        }
        assert_eq!("1/2".parse::<Shard>().unwrap().of("7".parse().unwrap()), None);
        assert!(
            ["0/3", "4/3", "1", "1/0", "a/b", "1/2/3", "-1/2", "1/2000000"]
                .iter()
                .all(|text| text.parse::<Shard>().is_err())
        );
    }

    fn read(text: &str) -> Option<(u64, u64)> {
        text.parse::<Seeds>().ok().map(|seeds| (seeds.first, seeds.last))
    }

    #[test]
    fn seeds_are_written_as_in_the_language() {
        assert_eq!(read("7"), Some((7, 7)));
        assert_eq!(read("1..100"), Some((1, 100)));
        assert_eq!(read("1..<100"), Some((1, 99)));
        assert_eq!(read("0..0"), Some((0, 0)));
        assert_eq!(read("18446744073709551615"), Some((u64::MAX, u64::MAX)));
    }

    #[test]
    fn what_is_no_seed_is_refused() {
        for text in ["", "..", "1..", "..3", "1-3", "a..b", "-1..3", "+1..3", "1...3", "1..=3", "1.5", "1 .. 3", "1..<"]
        {
            assert_eq!(read(text), None, "{text}");
        }
        for text in ["3..1", "5..<5", "0..<0", "1..1000001", "0..18446744073709551615", "18446744073709551616"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
