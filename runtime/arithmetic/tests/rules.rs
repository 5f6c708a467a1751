//! Each rule against its execution: what is executed on numbers out of some ranges lies in the range that the rule gives.
//!
//! A million of each with `ARITHMETIC_COUNT=1000000 cargo test --release -p albacore-arithmetic`; others with `ARITHMETIC_SEED=7`.

#![allow(clippy::panic, missing_docs, reason = "a test that finds a wrong result has failed")]

use albacore_arithmetic::{INT_MAX, Interval, LARGEST, Operator};

/// Trials of each operation in an ordinary `cargo test`.
const FEW: u64 = 20_000;

/// Numbers at which something changes, of either sign.
const UGLY: [f64; 22] = [
    0.0,
    f64::from_bits(1),
    1e-320,
    f64::MIN_POSITIVE,
    1e-200,
    1e-150,
    1e-12,
    0.1,
    0.5,
    0.9999999999999999,
    1.0,
    1.5,
    2.0,
    std::f64::consts::PI,
    std::f64::consts::TAU,
    1e9,
    INT_MAX - 1.0,
    INT_MAX,
    1e100,
    1e149,
    1e149 * 9.99,
    LARGEST,
];

/// Random numbers by their count alone (splitmix64).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of any magnitude, the ugly ones often.
    fn number(&mut self) -> f64 {
        let x = match self.below(5) {
            0 | 1 => UGLY[self.below(UGLY.len() as u64) as usize],
            2 => self.unit() * 20.0,
            3 => self.below(20) as f64,
            _ => f64::from_bits(self.bits() & (u64::MAX >> 1)),
        };
        let x = match self.below(4) {
            0 => x.next_up(),
            1 => x.next_down(),
            _ => x,
        };
        let x = if x.is_finite() { x.clamp(-LARGEST, LARGEST) } else { 1.0 };
        if self.below(2) == 0 { -x } else { x }
    }

    fn range(&mut self) -> Interval {
        let (a, b) = (self.number(), self.number());
        let range = match self.below(8) {
            0 => return Interval::exactly(a),
            1 => Interval::ANY,
            2 => return Interval::SIGN,
            3 => Interval::new(a.min(a * 0.9999999), a.max(a * 0.9999999)),
            _ => Interval::new(a.min(b), a.max(b)),
        };
        match self.below(3) {
            // Zero is left out, and perhaps more.
            0 => range.without_below((self.number() * self.unit()).abs().min(range.low.abs().max(range.high.abs()))),
            _ => range,
        }
    }

    /// A number of a range, its ends often.
    fn among(&mut self, range: Interval) -> f64 {
        for _ in 0..8 {
            let x = match self.below(9) {
                0 => range.low,
                1 => range.high,
                2 => range.least,
                3 => -range.least,
                4 => range.low.next_up(),
                5 => range.high.next_down(),
                6 => range.low + self.unit() * (range.high - range.low),
                7 => range.least + self.unit() * range.least,
                _ => self.number(),
            };
            if range.holds(x) {
                return x;
            }
        }
        [range.low, range.high, range.least].into_iter().find(|x| range.holds(*x)).unwrap_or(range.high)
    }
}

fn from_environment(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(otherwise)
}

/// Holds trials of every operation against a law, which tells what is wrong.
fn trials(law: impl Fn(Operator, &[Interval], &[f64]) -> Option<String>) {
    let seed = from_environment("ARITHMETIC_SEED", 1);
    let mut wrong = Vec::new();
    for (stream, &operator) in Operator::ALL.iter().enumerate() {
        let mut random = Random(seed.wrapping_mul(1_000_003).wrapping_add(stream as u64) << 20);
        for _ in 0..from_environment("ARITHMETIC_COUNT", FEW) {
            let ranges: Vec<Interval> = (0..operator.operands()).map(|_| random.range()).collect();
            let operands: Vec<f64> = ranges.iter().map(|range| random.among(*range)).collect();
            if !ranges.iter().zip(&operands).all(|(range, x)| range.holds(*x)) {
                continue;
            }
            if let Some(why) = law(operator, &ranges, &operands) {
                wrong.push(format!("{operator:?} of {operands:?} in {ranges:?}: {why}"));
                break;
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn results_lie_in_the_range_of_the_rule() {
    trials(|operator, ranges, operands| {
        let (result, rule) = (operator.execute(operands), operator.rule(ranges));
        (!rule.holds(result)).then(|| format!("{result:e} is not in {rule:?}"))
    });
}

#[test]
fn results_are_numbers_of_the_magnitude_that_is_kept() {
    trials(|operator, _, operands| {
        let result = operator.execute(operands);
        (!Interval::ANY.holds(result)).then(|| format!("{result:e}"))
    });
}

/// What can be only one number is that number: so the checker calculates with constants.
#[test]
fn rules_of_constants_are_the_execution() {
    trials(|operator, _, operands| {
        let constants: Vec<Interval> = operands.iter().map(|x| Interval::exactly(*x)).collect();
        let (result, rule) = (operator.execute(operands), operator.rule(&constants));
        (operator.is_defined(&constants) && rule.constant() != Some(result))
            .then(|| format!("{result:e}, by the rule {rule:?}"))
    });
}

/// More is known of a narrower range.
#[test]
fn rules_of_narrower_ranges_are_narrower() {
    trials(|operator, ranges, operands| {
        let constants: Vec<Interval> = operands.iter().map(|x| Interval::exactly(*x)).collect();
        let (narrow, wide) = (operator.rule(&constants), operator.rule(ranges));
        (operator.is_defined(ranges) && !wide.covers(narrow)).then(|| format!("{narrow:?} of one, {wide:?} of all"))
    });
}

#[test]
fn whole_numbers_end_where_they_can_be_counted() {
    for (operator, operands) in [
        (Operator::AddInt, vec![INT_MAX, 1.0]),
        (Operator::SubInt, vec![INT_MAX, -5.0]),
        (Operator::MulInt, vec![INT_MAX, INT_MAX]),
        (Operator::Floor, vec![LARGEST]),
        (Operator::Ceil, vec![1e17]),
        (Operator::Round, vec![LARGEST]),
    ] {
        assert_eq!(operator.execute(&operands), INT_MAX, "{operator:?} of {operands:?}");
    }
}

#[test]
fn a_time_is_a_tick_at_least() {
    for seconds in [-LARGEST, -1.0, 0.0, 1e-300, 0.1, 0.1 + 1e-9] {
        assert_eq!(Operator::Ticks.execute(&[seconds]), 1.0, "{seconds} s");
    }
    assert_eq!(Operator::Ticks.execute(&[0.3001]), 4.0);
}

/// What the checker may conclude, and what it may not.
#[test]
fn zero_is_excluded_by_magnitudes_alone() {
    let small = Interval::new(1e-12, 1.0);
    let product = |n: usize| (1..n).fold(small, |product, _| Operator::Mul.rule(&[product, small]));
    assert!(product(20).excludes_zero());
    assert!(!product(30).excludes_zero());
    let unknown = Interval::NOT_ZERO;
    assert!(Operator::Mul.rule(&[unknown, Interval::exactly(2.0)]).excludes_zero());
    assert!(!Operator::Mul.rule(&[unknown, Interval::exactly(0.5)]).excludes_zero());
    assert!(!Operator::Div.rule(&[unknown, Interval::exactly(3.0)]).excludes_zero());
    assert!(Operator::Max.rule(&[Interval::ANY, Interval::exactly(0.1)]).excludes_zero());
    assert!(!Operator::Div.is_defined(&[small, Interval::new(0.0, 1.0)]));
    assert!(!Operator::Sqrt.is_defined(&[Interval::new(-1e-300, 1.0)]));
}
