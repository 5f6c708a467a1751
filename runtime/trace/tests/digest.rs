//! The digest of a run.

use albacore_geometry::Heading;
use albacore_machine::Event;
use albacore_program::Channel;
use albacore_trace::Digest;
use albacore_vehicle::{Command, Vertical};

fn of(words: &[u64]) -> u64 {
    let mut digest = Digest::new();
    words.iter().for_each(|&word| digest.word(word));
    digest.value()
}

/// A digest in an old trace must mean the same for ever.
#[test]
fn the_digest_of_known_words_never_changes() {
    let mut digest = Digest::new();
    assert_eq!(digest.to_string(), "406c65b315c79af9");
    digest.word(1);
    digest.numbers(&[1.5, -0.25, f64::INFINITY]);
    digest.text("albacore 36°");
    assert_eq!(digest.to_string(), "d8539820b9295e45");
    assert_eq!(format!("{:016x}", digest.value()), digest.to_string());
}

#[test]
fn every_bit_of_every_word_counts() {
    let words: Vec<u64> = (0..32).map(|i: u64| (i as f64 * 0.1).to_bits()).collect();
    let mut seen = std::collections::BTreeSet::from([of(&words)]);
    for at in 0..words.len() {
        for bit in 0..64 {
            let mut other = words.clone();
            other[at] ^= 1 << bit;
            assert!(seen.insert(of(&other)), "word {at}, bit {bit}");
        }
    }
}

/// One flipped bit of the input flips about half of the digest.
#[test]
fn small_changes_are_large_ones_in_the_digest() {
    let flips: u32 = (0..64).map(|bit| (of(&[7, 1 << bit]) ^ of(&[7, 0])).count_ones()).sum();
    assert!((24 * 64..40 * 64).contains(&flips), "{} of 64 on average", flips / 64);
}

#[test]
fn order_and_count_matter() {
    assert_ne!(of(&[1, 2]), of(&[2, 1]));
    assert_ne!(of(&[0]), of(&[0, 0]));
    assert_ne!(of(&[]), of(&[0]));
    let texts = |a: &str, b: &str| {
        let mut digest = Digest::new();
        digest.text(a);
        digest.text(b);
        digest
    };
    assert_ne!(texts("ab", "c"), texts("a", "bc"));
    assert_ne!(texts("a\0", ""), texts("a", "\0"));
}

#[test]
fn one_number_has_one_digest() {
    let number = |x: f64| {
        let mut digest = Digest::new();
        digest.number(x);
        digest
    };
    assert_eq!(number(0.0), number(-0.0));
    assert_eq!(number(f64::NAN), number(-f64::NAN));
    assert_ne!(number(1.0), number(-1.0));
}

/// The form of values in a digest never changes either: depths and altitudes, zeros of either sign, and what is absent are told apart
/// or not as it says.
#[test]
fn the_form_of_values_never_changes() {
    let of = |command: Option<Command>| {
        let mut digest = Digest::new();
        let events = vec![Event::Logged("36°".into()), Event::Limited(Channel::Depth, 9.0, -0.0), Event::TimedOut];
        digest.value_of(&(7_u64, command, &events)).unwrap();
        digest.to_string()
    };
    let told = |vertical| Some(Command::new(Heading::from_degrees(90.0), 1.5, vertical));
    let given = [None, told(Vertical::Depth(3.0)), told(Vertical::Altitude(3.0)), told(Vertical::Depth(-3.0))].map(of);
    assert_eq!(given, ["c08043fabcd32637", "46142c91067bce1c", "39f3c6169d606a9c", "fec612bfa2a786cd"]);
    assert_eq!(of(told(Vertical::Depth(0.0))), of(told(Vertical::Depth(-0.0))));
}
