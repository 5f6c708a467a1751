//! Code that must not be run is found, and code that may be is let through.

#![allow(missing_docs, reason = "each test says what it shows")]

use albacore_program::{ABSOLUTE, Op, Program};

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
    ops.push(Op::AddInt { to: 0, a: 0, b: ONE });
    ops.push(Op::JumpIfLess { a: 0, b: 1, to: 0 });
    ops.push(Op::Return);
    ops
}

#[test]
fn a_round_takes_time_or_is_counted() {
    assert_eq!(why(vec![Op::Jump { to: 0 }]), ROUND);
    assert_eq!(why(vec![Op::Yield, Op::Jump { to: 0 }]), None);
    assert_eq!(why(vec![Op::JumpIf { if_: 3, to: 2 }, Op::Yield, Op::Jump { to: 0 }]), ROUND);
    assert_eq!(why(counted(vec![Op::Copy { to: 2, from: 3 }])), None);
}

#[test]
fn a_count_goes_toward_an_end_that_stands() {
    assert_eq!(why(counted(vec![Op::Copy { to: 0, from: 3 }])), ROUND, "the counter is set back");
    assert_eq!(why(counted(vec![Op::Copy { to: 1, from: 0 }])), ROUND, "the end moves");
    assert_eq!(why(counted(vec![Op::Clear { to: 0, words: 4 }])), ROUND, "both are cleared");
    let no_end = vec![Op::AddInt { to: 0, a: 0, b: ONE }, Op::JumpIfLess { a: 2, b: 1, to: 0 }, Op::Return];
    assert_eq!(why(no_end), ROUND, "another word is looked at");
    let by_two = vec![Op::AddInt { to: 0, a: 0, b: 3 }, Op::JumpIfLess { a: 0, b: 1, to: 0 }, Op::Return];
    assert_eq!(why(by_two), ROUND, "what is added may be nothing");
    let unlooked = vec![
        Op::AddInt { to: 0, a: 0, b: ONE },
        Op::JumpIf { if_: 3, to: 0 },
        Op::JumpIfLess { a: 0, b: 1, to: 0 },
        Op::Return,
    ];
    assert_eq!(why(unlooked), ROUND, "a round is counted that nobody looks at");
    // A loop in a counted loop has a counter of its own.
    assert_eq!(why(counted(vec![Op::JumpIf { if_: 3, to: 0 }])), ROUND);
}

#[test]
fn places_are_there() {
    assert_eq!(why(vec![Op::Jump { to: 7 }]), Some("it leads to where there is no code"));
    assert_eq!(why(vec![Op::Copy { to: ABSOLUTE, from: 0 }]), Some("it writes among inputs and constants"));
    assert_eq!(why(vec![Op::Clear { to: 5, words: 4 }]), Some("it writes beyond the words of a run"));
    assert_eq!(why(vec![Op::Log { text: 0 }]), Some("it names what is not there"));
}
