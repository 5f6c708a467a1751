//! Code that must not be run is found, and code that may be is let through.

#![allow(missing_docs, reason = "each test says what it shows")]

use albacore_arithmetic::{Interval, Operator};
use albacore_program::{ABSOLUTE, Addr, Claim, Claims, Compute, Guide, Op, Program, Slot, Unit, When};

fn one(operator: Operator, to: Slot, a: Slot) -> Op {
    Compute::One { operator, to, a }.into()
}

fn two(operator: Operator, to: Slot, a: Slot, b: Slot) -> Op {
    Compute::two(operator, to, a, b).into()
}

fn set(to: Slot, value: f64) -> Op {
    Compute::Const { to, value }.into()
}

fn copy(to: Slot, from: Slot) -> Op {
    Compute::Copy { to, from }.into()
}

fn jump(to: Addr) -> Op {
    Compute::jump(to).into()
}

fn jump_if(word: Slot, to: Addr) -> Op {
    Compute::jump_if(word, to).into()
}

fn jump_unless(word: Slot, to: Addr) -> Op {
    Compute::jump_unless(word, to).into()
}

fn jump_when(when: When, to: Addr) -> Op {
    Compute::Jump { to, when }.into()
}

fn of(ops: Vec<Op>) -> Program {
    Program { ops, constants: vec![1.0], words: 8, ..Program::default() }
}

fn why(ops: Vec<Op>) -> Option<&'static str> {
    of(ops).verify().err().map(|unsound| unsound.why)
}

const ONE: u32 = ABSOLUTE;
const ROUND: Option<&str> = Some("it goes round without taking time");

/// Counter in 0, end in 1; each round passes what is given.
fn counted(within: Vec<Op>) -> Vec<Op> {
    let mut ops = within;
    ops.push(two(Operator::AddInt, 0, 0, ONE));
    ops.push(jump_when(When::Less(0, 1), 0));
    ops.push(Op::Return);
    ops
}

#[test]
fn a_round_takes_time_or_is_counted() {
    assert_eq!(why(vec![jump(0)]), ROUND);
    assert_eq!(why(vec![Op::Yield, jump(0)]), None);
    assert_eq!(why(vec![jump_if(3, 2), Op::Yield, jump(0)]), ROUND);
    assert_eq!(why(counted(vec![copy(2, 3)])), None);
}

#[test]
fn a_count_goes_toward_an_end_that_stands() {
    assert_eq!(why(counted(vec![copy(0, 3)])), ROUND, "the counter is set back");
    assert_eq!(why(counted(vec![copy(1, 0)])), ROUND, "the end moves");
    assert_eq!(why(counted(vec![Op::Compute(Compute::Clear { to: 0, words: 4 })])), ROUND, "both are cleared");
    let no_end = vec![two(Operator::AddInt, 0, 0, ONE), jump_when(When::Less(2, 1), 0), Op::Return];
    assert_eq!(why(no_end), ROUND, "another word is looked at");
    let by_two = vec![two(Operator::AddInt, 0, 0, 3), jump_when(When::Less(0, 1), 0), Op::Return];
    assert_eq!(why(by_two), ROUND, "what is added may be nothing");
    let unlooked = vec![two(Operator::AddInt, 0, 0, ONE), jump_if(3, 0), jump_when(When::Less(0, 1), 0), Op::Return];
    assert_eq!(why(unlooked), ROUND, "a round is counted that nobody looks at");
    // A loop in a counted loop has a counter of its own.
    assert_eq!(why(counted(vec![jump_if(3, 0)])), ROUND);
}

#[test]
fn places_are_there() {
    assert_eq!(why(vec![jump(7)]), Some("it leads to where there is no code"));
    assert_eq!(why(vec![copy(ABSOLUTE, 0)]), Some("it writes among inputs and constants"));
    assert_eq!(why(vec![Op::Compute(Compute::Clear { to: 5, words: 4 })]), Some("it writes beyond the words of a run"));
    assert_eq!(why(vec![Op::Log { text: 0 }]), Some("it names what is not there"));
}

/// A unit of all the code, of which words 0 and 1 are claimed to lie in 0..10, and word 2 to be a whole number from 1 to 5.
fn claims(ops: &[Op]) -> Claims {
    let claim = |slot, range, is_whole| Claim { slot, range, is_whole, present: None, is_param: false };
    let ten = Interval::new(0.0, 10.0);
    let claims = vec![claim(0, ten, false), claim(1, ten, false), claim(2, Interval::new(1.0, 5.0), true)];
    let unit = Unit { code: 0..ops.len() as u32, words: 8, claims, ..Unit::default() };
    Claims { units: vec![unit], pieces: vec![0], ..Claims::default() }
}

fn why_by_range(ops: Vec<Op>) -> Option<&'static str> {
    let claims = claims(&ops);
    of(ops).verify_ranges(&claims).err().map(|unsound| unsound.why)
}

const BY_ZERO: Option<&str> = Some("it may divide by zero");
const CLAIMED: Option<&str> = Some("a variable may be outside the range that is claimed of it");

#[test]
fn what_has_no_value_is_found() {
    assert_eq!(why_by_range(vec![two(Operator::Div, 4, 0, 1), Op::Return]), BY_ZERO);
    assert_eq!(why_by_range(vec![two(Operator::Div, 4, 0, 2), Op::Return]), None);
    assert_eq!(why_by_range(vec![two(Operator::Div, 4, 0, 5), Op::Return]), BY_ZERO, "of which nothing is known");
    let difference = |then| vec![two(Operator::Sub, 4, 0, 1), then, Op::Return];
    let root = Some("it may take the root of a negative number");
    assert_eq!(why_by_range(difference(one(Operator::Sqrt, 4, 4))), root);
    assert_eq!(why_by_range(difference(one(Operator::Sqrt, 4, 0))), None);
    assert_eq!(why_by_range(difference(one(Operator::Ticks, 4, 4))), Some("a time may be negative"));
    assert_eq!(why_by_range(difference(one(Operator::Ticks, 4, 1))), None);
    let circle = |radius, turns| {
        let begin = Op::Begin { guide: Guide::Loiter, args: 4, state: 8, setpoints: 0 };
        vec![copy(6, radius), copy(7, turns), begin, Op::Return]
    };
    let argument = Some("an argument of guidance may be outside its range");
    assert_eq!(why_by_range(circle(0, 1)), argument, "a radius of 0");
    assert_eq!(why_by_range(circle(2, 3)), argument, "turns of which nothing is known");
    assert_eq!(why_by_range(circle(2, 1)), None);
}

#[test]
fn what_a_jump_shows_is_known_behind_it_and_nowhere_else() {
    let guarded = |between: Vec<Op>, at| {
        let mut ops = vec![jump_when(When::NotLess(ABSOLUTE | 1, 0), 0)];
        ops.extend(between);
        ops.extend([two(Operator::Div, 4, 1, at), Op::Return]);
        let end = ops.len() as u32 - 1;
        ops[0] = jump_when(When::NotLess(ABSOLUTE | 1, 0), end);
        let claims = claims(&ops);
        let program = Program { ops, constants: vec![1.0, 0.0], words: 48, ..Program::default() };
        program.verify_ranges(&claims).err().map(|unsound| unsound.why)
    };
    assert_eq!(guarded(vec![], 0), None);
    assert_eq!(guarded(vec![], 1), BY_ZERO, "another word");
    assert_eq!(guarded(vec![copy(0, 1)], 0), BY_ZERO, "it is written behind the jump");
    assert_eq!(guarded(vec![copy(5, 0)], 5), None, "a copy of it");
    // The other side of a test that is kept in a word.
    let kept = |negated: bool| {
        let ops = vec![
            Op::Compute(Compute::Lt { to: 5, a: ABSOLUTE | 1, b: 0 }),
            if negated { Op::Compute(Compute::Not { to: 5, a: 5 }) } else { copy(6, 5) },
            jump_unless(if negated { 5 } else { 6 }, 4),
            two(Operator::Div, 4, 1, 0),
            Op::Return,
        ];
        let claims = claims(&ops);
        let program = Program { ops, constants: vec![1.0, 0.0], words: 48, ..Program::default() };
        program.verify_ranges(&claims).err().map(|unsound| unsound.why)
    };
    assert_eq!(kept(false), None);
    assert_eq!(kept(true), BY_ZERO);
}

#[test]
fn claims_are_kept_wherever_others_could_read() {
    let times = |end| vec![two(Operator::Add, 0, 0, 1), two(Operator::Min, 0, 0, 2), end];
    assert_eq!(why_by_range(times(Op::Return)), None, "it is mended before anybody reads it");
    assert_eq!(why_by_range(vec![two(Operator::Add, 0, 0, 1), Op::Return]), CLAIMED);
    assert_eq!(why_by_range(vec![two(Operator::Add, 0, 0, 1), Op::Yield, set(0, 1.0), Op::Return]), CLAIMED);
    assert_eq!(why_by_range(vec![set(2, 0.0), Op::Return]), CLAIMED);
}

#[test]
fn what_grows_from_round_to_round_is_known_to() {
    // A counter of so many rounds as word 2 says: it stays below its end, and 10 stays above it.
    let rounds = |bound: f64, end: Op| {
        let ops = vec![
            set(5, 0.0),
            set(6, bound),
            two(Operator::SubInt, 7, 6, 5),
            two(Operator::Div, 4, 1, 7),
            two(Operator::AddInt, 5, 5, ONE),
            end,
            Op::Return,
        ];
        why_by_range(ops)
    };
    let counted = jump_when(When::Less(5, 2), 2);
    assert_eq!(rounds(5.0, counted), None);
    assert_eq!(rounds(4.0, counted), BY_ZERO, "in the fifth round");
    assert_eq!(rounds(5.0, jump_if(3, 2)), BY_ZERO, "of rounds without an end");
}

#[test]
fn who_calls_keeps_to_what_a_parameter_claims() {
    let call = |given: f64| {
        let ops =
            vec![set(4, given), Op::Call { code: 3, base: 4 }, Op::Return, two(Operator::Div, 1, 1, 0), Op::Return];
        let range = Interval::new(1.0, 2.0);
        let claim = Claim { slot: 0, range, is_whole: false, present: None, is_param: true };
        let caller = Unit { code: 0..3, words: 8, ..Unit::default() };
        let called = Unit { code: 3..5, words: 2, claims: vec![claim], ..Unit::default() };
        let claims = Claims { units: vec![caller, called], pieces: vec![0], ..Claims::default() };
        of(ops).verify_ranges(&claims).err().map(|unsound| unsound.why)
    };
    assert_eq!(call(1.5), None);
    assert_eq!(call(0.0), Some("an argument may be outside the range of its parameter"));
}
