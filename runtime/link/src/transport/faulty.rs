//! A wire on which things go wrong, by seed: what becomes of a message is a function of the seed, of the messages before it and
//! of the times that are given. It reads no clock.

use super::Transport;
use crate::dialect::Framing;
use crate::error::LinkError;
use serde::{Deserialize, Deserializer, de};
use std::collections::BTreeMap;
use std::time::Duration;

/// A message that comes in two parts has the second one so much later: a tick.
const PART: Duration = Duration::from_millis(100);
/// A message that is overtaken comes at most so much later.
const OVERTAKEN: Duration = Duration::from_secs(1);
/// So many bits of a corrupt message are wrong at most.
const BITS_MAX: u64 = 3;
/// Messages that are under way on a wire at most; further ones are lost. A vehicle sends some ten in a tick.
const UNDER_WAY_MAX: usize = 100_000;

/// What goes wrong with the messages that are sent within a time. Shares are from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkFault {
    /// So many are lost.
    pub loss: f64,
    /// In so many a few bits are wrong.
    pub corrupt: f64,
    /// So many come in two parts.
    pub split: f64,
    /// So many come twice.
    pub repeat: f64,
    /// So many are overtaken by later ones.
    pub reorder: f64,
    /// All come so late.
    #[serde(deserialize_with = "seconds")]
    pub delay: Duration,
    /// When it begins.
    #[serde(deserialize_with = "seconds")]
    pub from: Duration,
    /// When it is over; none is never.
    #[serde(deserialize_with = "seconds_or_none")]
    pub to: Option<Duration>,
}

fn seconds<'de, D: Deserializer<'de>>(from: D) -> Result<Duration, D::Error> {
    Duration::try_from_secs_f64(f64::deserialize(from)?).map_err(de::Error::custom)
}

fn seconds_or_none<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Duration>, D::Error> {
    let seconds: Option<f64> = Option::deserialize(from)?;
    seconds.map(|seconds| Duration::try_from_secs_f64(seconds).map_err(de::Error::custom)).transpose()
}

impl LinkFault {
    fn is_active(&self, now: Duration) -> bool {
        self.from <= now && self.to.is_none_or(|to| now < to)
    }
}

/// A transport on which things go wrong, both ways.
pub struct Faulty<T> {
    inner: T,
    faults: Vec<LinkFault>,
    now: Duration,
    coming: Wire,
    going: Wire,
}

impl<T> Faulty<T> {
    /// What goes wrong with a transport on which messages are told apart so, at time 0.
    pub fn new(inner: T, framing: &'static Framing, faults: Vec<LinkFault>, seed: u64) -> Self {
        let wire = |way: u64| Wire::new(framing, seed.wrapping_mul(2).wrapping_add(way));
        Faulty { inner, faults, now: Duration::ZERO, coming: wire(0), going: wire(1) }
    }

    /// The transport itself.
    pub fn inner(&mut self) -> &mut T {
        &mut self.inner
    }

    /// It is so late now, by whatever clock the faults go by.
    pub fn pass(&mut self, now: Duration) {
        self.now = now;
    }
}

impl<T: Transport> Transport for Faulty<T> {
    fn receive(&mut self, into: &mut Vec<u8>, wait: Duration) -> Result<(), LinkError> {
        let mut came = Vec::new();
        let received = self.inner.receive(&mut came, wait);
        self.coming.put(&came, self.now, &self.faults);
        self.coming.take(self.now, into);
        received.and_then(|()| self.send(&[]))
    }

    fn send(&mut self, messages: &[u8]) -> Result<(), LinkError> {
        self.going.put(messages, self.now, &self.faults);
        let mut gone = Vec::new();
        self.going.take(self.now, &mut gone);
        if gone.is_empty() { Ok(()) } else { self.inner.send(&gone) }
    }

    fn trouble(&self) -> Option<&str> {
        self.inner.trouble()
    }

    fn hold(&mut self, held: bool) {
        self.inner.hold(held);
    }
}

/// One way of a link.
struct Wire {
    framing: &'static Framing,
    random: Random,
    /// The beginning of a message whose end has not been sent.
    begun: Vec<u8>,
    /// What is under way, by when it arrives and by the order in which it was sent.
    under_way: BTreeMap<(Duration, u64), Vec<u8>>,
    sent: u64,
    /// Nothing arrives before what was sent before it, unless that is overtaken.
    not_before: Duration,
}

impl Wire {
    fn new(framing: &'static Framing, seed: u64) -> Self {
        Wire {
            framing,
            random: Random(seed),
            begun: Vec::new(),
            under_way: BTreeMap::new(),
            sent: 0,
            not_before: Duration::ZERO,
        }
    }

    /// Sends bytes, however they are cut.
    fn put(&mut self, bytes: &[u8], now: Duration, faults: &[LinkFault]) {
        self.begun.extend_from_slice(bytes);
        let begun = std::mem::take(&mut self.begun);
        for message in self.framing.messages(&begun) {
            let is_whole = (self.framing.first)(message).is_some();
            if is_whole || message.len() >= self.framing.longest {
                self.send(message.to_vec(), now, faults);
            } else {
                self.begun = message.to_vec();
            }
        }
    }

    /// Takes what has arrived.
    fn take(&mut self, now: Duration, into: &mut Vec<u8>) {
        while let Some(first) = self.under_way.first_entry().filter(|first| first.key().0 <= now) {
            into.extend(first.remove());
        }
    }

    fn send(&mut self, mut message: Vec<u8>, now: Duration, faults: &[LinkFault]) {
        let (mut delay, mut overtaken, mut times, mut parted) = (Duration::ZERO, Duration::ZERO, 1, None);
        for fault in faults.iter().filter(|fault| fault.is_active(now)) {
            if self.random.happens(fault.loss) {
                return;
            }
            if self.random.happens(fault.corrupt) {
                self.corrupt(&mut message);
            }
            if self.random.happens(fault.split) {
                parted = Some(self.random.below(message.len() as u64) as usize);
            }
            if self.random.happens(fault.repeat) {
                times += 1;
            }
            if self.random.happens(fault.reorder) {
                let ms = OVERTAKEN.as_millis() as u64;
                overtaken += Duration::from_millis(1 + self.random.below(ms));
            }
            delay += fault.delay;
        }
        let due = self.not_before.max(now + delay);
        if overtaken.is_zero() {
            self.not_before = due;
        }
        for _ in 0..times {
            match parted {
                Some(at) => {
                    let rest = message[at..].to_vec();
                    self.arrive(due + overtaken, message[..at].to_vec());
                    self.arrive(due + overtaken + PART, rest);
                    // On a line the rest comes before all that was sent later.
                    self.not_before = self.not_before.max(due + PART);
                }
                None => self.arrive(due + overtaken, message.clone()),
            }
        }
    }

    fn arrive(&mut self, due: Duration, bytes: Vec<u8>) {
        if self.under_way.len() < UNDER_WAY_MAX {
            self.under_way.insert((due, self.sent), bytes);
            self.sent += 1;
        }
    }

    fn corrupt(&mut self, message: &mut [u8]) {
        let bits = 8 * message.len() as u64;
        for _ in 0..1 + self.random.below(BITS_MAX) {
            let bit = self.random.below(bits);
            if let Some(byte) = message.get_mut((bit / 8) as usize) {
                *byte ^= 1 << (bit % 8);
            }
        }
    }
}

/// SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// With a probability; every draw is made, whatever that is, so that one fault changes nothing of another's.
    fn happens(&mut self, share: f64) -> bool {
        ((self.next() >> 11) as f64) < share * (1_u64 << 53) as f64
    }

    /// A number from 0 to below a limit; 0 where there is none.
    fn below(&mut self, limit: u64) -> u64 {
        self.next().checked_rem(limit).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hundred messages, one every tenth of a second, and when each line arrives, tenths of a second.
    fn sent(fault: LinkFault, seed: u64) -> Vec<(u64, String)> {
        let mut wire = Wire::new(&crate::recon::DIALECT.framing, seed);
        let mut arrived = Vec::new();
        for tick in 0..400 {
            let now = Duration::from_millis(100 * tick);
            if tick < 100 {
                wire.put(format!("{tick:02}\n").as_bytes(), now, &[fault]);
            }
            let mut came = Vec::new();
            wire.take(now, &mut came);
            if !came.is_empty() {
                arrived.push((tick, String::from_utf8_lossy(&came).into_owned()));
            }
        }
        arrived
    }

    fn text(arrived: &[(u64, String)]) -> String {
        arrived.iter().map(|(_, text)| text.as_str()).collect()
    }

    fn numbers(arrived: &[(u64, String)]) -> Vec<u64> {
        text(arrived).lines().map(|line| line.parse().unwrap()).collect()
    }

    #[test]
    fn without_a_fault_all_arrives_at_once() {
        let arrived = sent(LinkFault::default(), 1);
        assert!(arrived.iter().all(|(tick, text)| *text == format!("{tick:02}\n")));
        assert_eq!(arrived.len(), 100);
    }

    #[test]
    fn the_same_seed_is_the_same_link() {
        let share = 0.2;
        let fault = LinkFault {
            loss: share,
            corrupt: share,
            split: share,
            repeat: share,
            reorder: share,
            ..LinkFault::default()
        };
        assert_eq!(sent(fault, 7), sent(fault, 7));
        assert_ne!(sent(fault, 7), sent(fault, 8));
    }

    #[test]
    fn a_cut_loses_all_while_it_lasts() {
        let (from, to) = (Duration::from_secs(2), Some(Duration::from_secs(3)));
        let arrived = numbers(&sent(LinkFault { loss: 1.0, from, to, ..LinkFault::default() }, 1));
        assert_eq!(arrived, (0..20).chain(30..100).collect::<Vec<_>>());
    }

    #[test]
    fn each_fault_does_what_it_says() {
        let fault = LinkFault::default();
        let lost = numbers(&sent(LinkFault { loss: 0.3, ..fault }, 1));
        assert!((50..90).contains(&lost.len()) && lost.is_sorted(), "{lost:?}");
        let late = sent(LinkFault { delay: Duration::from_millis(1500), ..fault }, 1);
        assert!(late.iter().all(|(tick, text)| *text == format!("{:02}\n", tick - 15)));
        let twice = numbers(&sent(LinkFault { repeat: 1.0, ..fault }, 1));
        assert_eq!(twice, (0..100).flat_map(|n| [n, n]).collect::<Vec<_>>());
        let mut moved = numbers(&sent(LinkFault { reorder: 0.2, ..fault }, 1));
        assert!(!moved.is_sorted());
        moved.sort();
        assert_eq!(moved, (0..100).collect::<Vec<_>>());
        let parted = sent(LinkFault { split: 0.5, ..fault }, 1);
        assert_eq!(numbers(&parted), (0..100).collect::<Vec<_>>());
        assert!(parted.iter().any(|(_, text)| !text.ends_with('\n')));
        let whole = sent(fault, 1);
        let wrong = sent(LinkFault { corrupt: 0.3, ..fault }, 1);
        let changed = wrong.iter().zip(&whole).filter(|(a, b)| a != b).count();
        assert!((10..50).contains(&changed) && text(&wrong).len() >= text(&whole).len(), "{changed}");
    }
}
