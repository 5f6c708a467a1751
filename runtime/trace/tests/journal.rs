//! The journal: what is written comes back, and whatever happens to the file is noticed.

#![expect(clippy::unwrap_used, reason = "a journal that cannot be written to memory has failed the test")]

use albacore_geometry::{Heading, Point};
use albacore_machine::{Event, Outcome};
use albacore_program::Cause;
use albacore_trace::journal::*;
use albacore_trace::{Release, Step, TickRecord};
use albacore_vehicle::{Command, Control, Measurement, Snapshot, Truth, Vertical};

fn header() -> JournalHeader {
    JournalHeader {
        program_version: 1,
        mission: "box".into(),
        scenario: "tidal_stream".into(),
        seed: 7,
        tick_s: 0.1,
        sources: vec![SourceDigest { name: "missions/box.alb".into(), digest: 0x1234_5678_9abc_def0 }],
        set: vec!["patience=3min".into()],
        measurements: vec![
            Measurement { name: "position".into(), width: 2 },
            Measurement { name: "chemical".into(), width: 1 },
        ],
        start: Some(Point::new(3.0, -4.0)),
        scripts: vec![KeptScript {
            name: "box.alb".into(),
            module: "missions/box".into(),
            text: "mission box {}".into(),
        }],
        world: World::Scenario { called: "tidal_stream".into(), scripts: Vec::new() },
    }
}

fn records() -> Vec<TickRecord> {
    let tick = |tick| TickRecord { tick, step: Step::Tick, ..TickRecord::default() };
    let snapshot = |readings: &[(u16, &[f64])]| {
        let mut snapshot = Snapshot { control: Control::InControl, ..Snapshot::default() };
        readings.iter().for_each(|(measurement, numbers)| snapshot.push(*measurement, numbers));
        snapshot
    };
    let command = |speed| Command::new(Heading::from_degrees(270.0), speed, Vertical::Depth(3.0));
    vec![
        TickRecord { notices: vec!["heard".into()], ..tick(0) },
        TickRecord {
            snapshot: snapshot(&[(0, &[12.5, -0.0]), (1, &[0.0, 0.0, 0.0, 1e300]), (1, &[])]),
            command: Some(command(1.8)),
            events: vec![Event::Control(Control::InControl), Event::Entered(0), Event::Logged("under way".into())],
            areas: vec![1.0, 2.0, 3.0, 0.0, 1.0],
            ..tick(1)
        },
        TickRecord {
            snapshot: snapshot(&[(0, &[f64::INFINITY, 4.0]), (0, &[0.0, 1.0])]),
            command: Some(command(2.0)),
            events: vec![
                Event::Switched { rule: 1, from: 2, exit: 0, values: vec![0.25, 1.0] },
                Event::Left(2, Cause::Done),
            ],
            truth: Some(Truth { depth: 3.0, ..Truth::default() }),
            ..tick(2)
        },
    ]
}

fn end() -> TickRecord {
    let (outcome, release) = (Outcome::Interrupted, Release::Failed);
    let trouble = Some("the port is gone".into());
    let ending = albacore_trace::Ending { outcome, reason: "interrupted".into(), release, trouble, digest: 42 };
    let events = vec![Event::Ended(Outcome::Interrupted)];
    TickRecord { tick: 3, step: Step::End(ending), events, ..TickRecord::default() }
}

/// The bytes of a small journal, and where its records end, the header's first.
fn journal() -> (Vec<u8>, Vec<usize>) {
    let mut bytes = Vec::new();
    let mut ends = Vec::new();
    // One sink a step, so that the vector can be measured between them.
    struct Part<'a>(&'a std::cell::RefCell<Vec<Vec<u8>>>);
    impl std::io::Write for Part<'_> {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.borrow_mut().push(bytes.to_vec());
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let writes = std::cell::RefCell::new(Vec::new());
    let mut writer = Writer::new(Part(&writes), &header()).unwrap();
    records().iter().chain([&end()]).for_each(|record| writer.step(record).unwrap());
    assert_eq!(writes.borrow().len(), 2 + records().len(), "one write call a record");
    for write in writes.into_inner() {
        bytes.extend(write);
        ends.push(bytes.len());
    }
    (bytes, ends)
}

#[test]
fn what_is_written_comes_back() {
    let (bytes, _) = journal();
    let read = Journal::read(&bytes).unwrap();
    assert_eq!((read.header, &read.ticks), (header(), &records()));
    assert_eq!(read.ending, Ending::Complete(Box::new(end())));
    let zero = read.ticks[1].snapshot.samples[0].reading[1];
    assert!(zero == 0.0 && zero.is_sign_negative(), "numbers come back bit for bit");
}

#[test]
fn cut_anywhere_it_is_a_valid_prefix() {
    let (bytes, ends) = journal();
    for cut in 0..bytes.len() {
        let whole = ends.iter().take_while(|&&end| end <= cut).count();
        match Journal::read(&bytes[..cut]) {
            Err(Unreadable::CutShort(flaw)) => assert!(whole == 0 && flaw.at <= cut, "cut at {cut}: {flaw}"),
            Err(other) => panic!("cut at {cut}: {other}"),
            Ok(read) => {
                assert_eq!(read.ticks, records()[..whole - 1], "cut at {cut}");
                let Ending::CutShort(flaw) = read.ending else { panic!("cut at {cut}: {:?}", read.ending) };
                assert_eq!(flaw.at, ends[whole - 1], "cut at {cut}");
            }
        }
    }
}

#[test]
fn every_byte_that_is_not_as_written_is_noticed() {
    let (good, ends) = journal();
    for at in 0..good.len() {
        for flip in 1..=255 {
            let mut bytes = good.clone();
            bytes[at] ^= flip;
            let whole = ends.iter().take_while(|&&end| end <= at).count();
            match Journal::read(&bytes) {
                Err(Unreadable::Damaged(_) | Unreadable::Version(_)) => assert_eq!(whole, 0, "byte {at} ^ {flip}"),
                Err(other) => panic!("byte {at} ^ {flip}: {other}"),
                Ok(read) => {
                    assert_eq!(read.ticks, records()[..(whole - 1).min(3)], "byte {at} ^ {flip}");
                    let Ending::Damaged(flaw) = read.ending else { panic!("byte {at} ^ {flip}: {:?}", read.ending) };
                    assert_eq!(flaw.at, ends[whole - 1], "byte {at} ^ {flip}");
                }
            }
        }
    }
}

#[test]
fn what_is_repeated_left_out_or_added_is_noticed() {
    let (good, ends) = journal();
    let header = &good[..ends[0]];
    let record = |i: usize| &good[ends[i]..ends[i + 1]];
    let damage = |parts: &[&[u8]]| match Journal::read(&parts.concat()).unwrap().ending {
        Ending::Damaged(flaw) => flaw.to_string(),
        other => panic!("{other:?}"),
    };
    let second = ends[1];
    let expected = format!("at byte {second}: expected the record of tick 1");
    assert_eq!(damage(&[header, record(0), record(0)]), expected);
    assert_eq!(damage(&[header, record(0), record(2)]), expected);
    assert_eq!(damage(&[header, record(0), &header[8..]]), expected);
    let end = good.len();
    let expected = format!("at byte {end}: expected nothing more, behind the end of the run");
    assert_eq!(damage(&[&good, record(0)]), expected);
    // What a disk leaves that lost its power.
    assert!(damage(&[&good[..second], &[0; 4096]]).contains("a length that agrees with its check"));
}

#[test]
fn what_is_no_journal_is_said_to_be_none() {
    let said = |bytes: &[u8]| Journal::read(bytes).unwrap_err().to_string();
    assert_eq!(said(b""), "the journal is cut short at byte 0: expected the beginning of a journal");
    assert!(said(b"mission box").starts_with("this is no journal, or a damaged one: at byte 0"));
    let expected = "the journal has the form of version 8, and this albacore reads version 7 alone: read it with the albacore that wrote it";
    assert_eq!(said(b"ALBJ\x08\0\0\0"), expected);
    // The form before delays, withheld samples and gaps: its records would be read as something else.
    let (good, _) = journal();
    let older = [b"ALBJ\x01\0\0\0", &good[8..]].concat();
    assert_eq!(said(&older), expected.replace("version 8", "version 1"));
}

#[test]
fn any_bytes_at_all_can_be_read() {
    let (good, ends) = journal();
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    };
    for _ in 0..10_000 {
        let mut bytes = good.clone();
        for _ in 0..1 + random() % 4 {
            let at = random() % bytes.len();
            bytes[at] = random() as u8;
        }
        bytes.truncate(ends[0] + random() % (bytes.len() - ends[0]));
        let _ = Journal::read(&bytes);
    }
    // Payloads that are nonsense, sealed as if they were not: only the decoding stands between them and the reader.
    for _ in 0..10_000 {
        let length = random() % 40;
        let [a, b, c, _] = (length as u32).to_le_bytes();
        let mut record = vec![a, b, c, a ^ b ^ c ^ 0xa5];
        record.extend((0..length).map(|_| if random() % 3 == 0 { 0xff } else { random() as u8 % 24 }));
        record.extend(crc32fast::hash(&record).to_le_bytes());
        let _ = Journal::read(&[&good[..ends[0]], &record].concat());
        let _ = Journal::read(&[&good[..8], &record].concat());
    }
}
